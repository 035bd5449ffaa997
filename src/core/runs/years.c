/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "base/random.h"
#include "check.h"
#include "core/stand/rotation.h"
#include "hazard.h"
#include "pool.h"
#include "result.h"
#include "run.h"
#include "scene/derived.h"
#include "scene/schema.h"
#include "statistics.h"
#include "variants.h"
#include "weighted.h"
#include "year_runs.h"

/* ---- windows ---- */

struct ceduo_window ceduo_window_compute(const struct ceduo_option *option)
{
    struct ceduo_window w = {.kind = CEDUO_WINDOW_CONSTANT, .step = 1};
    unsigned period = 1;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        unsigned first = ceduo_first_cut(&belt->stand, belt->cut_year);
        if (first == CEDUO_NEVER) {
            if (w.kind == CEDUO_WINDOW_CONSTANT && ceduo_stand_grows(&belt->stand))
                w.kind = CEDUO_WINDOW_AHEAD;
            continue;
        }
        w.kind = CEDUO_WINDOW_ROTATION;
        w.first = first > w.first ? first : w.first;
        unsigned rotation = belt->stand.cutting.rotation, common = period; /* least common multiple */
        while (common <= CEDUO_PERIOD_MAX && common % rotation > 0)
            common += period;
        period = common <= CEDUO_PERIOD_MAX ? common : period > rotation ? period : rotation;
    }
    if (w.kind == CEDUO_WINDOW_AHEAD)
        return (struct ceduo_window){w.kind, 1, CEDUO_YEARS_AHEAD_MIN, 1};
    w.last = w.first + period - 1;
    return w;
}

struct ceduo_window ceduo_window_thinned(struct ceduo_window w, unsigned max)
{
    unsigned count = (w.last - w.first) / w.step + 1;
    w.step *= (count + max - 1) / max;
    return w;
}

static struct ceduo_window window_ahead(const struct ceduo_scene *scene)
{
    struct ceduo_window w = {CEDUO_WINDOW_AHEAD, 1, CEDUO_YEARS_AHEAD_MIN, 1};
    bool identical = true;
    for (size_t i = 0; i < scene->options_count; i++)
        for (size_t k = 0; k < scene->options[i].belts_count; k++) {
            const struct ceduo_belt *belt = &scene->options[i].belts[k];
            unsigned rotation = belt->stand.cutting.rotation;
            if (ceduo_first_cut(&belt->stand, belt->cut_year) != CEDUO_NEVER)
                w.last = rotation > w.last ? rotation : w.last;
            else if (!ceduo_stand_grows(&belt->stand))
                continue;
            identical = false;
        }
    w.last = w.last < CEDUO_AHEAD_MAX ? w.last : CEDUO_AHEAD_MAX;
    return identical ? (struct ceduo_window){CEDUO_WINDOW_CONSTANT, 0, 0, 1} : w;
}

struct ceduo_window ceduo_scene_window(const struct ceduo_scene *scene)
{
    struct ceduo_window w = window_ahead(scene);
    double first = scene->year_first, last = scene->year_last;
    if (isnan(first) && isnan(last))
        return w;
    unsigned period = w.last - w.first;
    w.kind = CEDUO_WINDOW_GIVEN;
    w.first = !isnan(first) ? (unsigned)first : last < w.first ? (unsigned)last : w.first;
    w.last = isnan(last) ? w.first + period : (unsigned)last;
    w.last = w.last < w.first ? w.first : w.last;
    return ceduo_window_thinned(w, CEDUO_YEARS_MAX);
}

/* ---- growing ---- */

static enum ceduo_status grow_year(const struct ceduo_option *option, size_t controls, struct ceduo_year *y)
{
    size_t n = option->belts_count;
    enum ceduo_status status = CEDUO_OK;
    y->option.name = option->name;
    y->option.name_given = option->name_given;
    y->option.belts = calloc(n + 1, sizeof *y->option.belts);
    y->grown = calloc(n + 1, sizeof *y->grown);
    y->stands = calloc(n + 1, sizeof *y->stands);
    y->controls = calloc(controls + 1, sizeof *y->controls);
    if (!y->option.belts || !y->grown || !y->stands || !y->controls)
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        struct ceduo_belt *to = &y->option.belts[i];
        status = ceduo_stand_at(&belt->stand, belt->cut_year, y->year, &y->grown[i]);
        *to = *belt;
        to->stand = y->grown[i].stand;
        to->felled = ceduo_stand_is_cut_year(&belt->stand, belt->cut_year, y->year);
        y->cut |= to->felled;
        y->option.belts_count = i + 1;
    }
    return status;
}

enum ceduo_status ceduo_years_create(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                     struct ceduo_window window, struct ceduo_years **out)
{
    *out = NULL;
    enum ceduo_status status = ceduo_check_window(window);
    if (status == CEDUO_OK)
        status = ceduo_check_stands(option);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_years *years = calloc(1, sizeof *years);
    size_t n = (window.last - window.first) / window.step + 1;
    if (years)
        years->years = calloc(n, sizeof *years->years);
    status = years && years->years ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK) {
        years->scene = *scene;
        years->window = window;
        years->last_control = ceduo_scene_last_control(scene);
    }
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        years->years[i].year = window.first + (unsigned)i * window.step;
        years->count = i + 1;
        status = grow_year(option, scene->controls_count, &years->years[i]);
    }
    if (status == CEDUO_OK)
        *out = years;
    else
        ceduo_years_free(years);
    return status;
}

void ceduo_years_free(struct ceduo_years *years)
{
    if (!years)
        return;
    for (size_t i = 0; i < years->count; i++) {
        struct ceduo_year *y = &years->years[i];
        for (size_t k = 0; y->grown && k < y->option.belts_count; k++)
            ceduo_grown_stand_release(&y->grown[k]);
        free(y->grown);
        free(y->option.belts);
        free(y->stands);
        free(y->controls);
        ceduo_simulated_release(&y->wooded);
    }
    free(years->years);
    free(years->marks);
    free(years->weights);
    free(years);
}

/* ---- simulating ---- */

void ceduo_years_assess(struct ceduo_years *years, const struct ceduo_scene *scene, const struct ceduo_simulated *bare)
{
    years->scene = *scene;
    for (size_t i = 0; i < years->count; i++) {
        struct ceduo_year *y = &years->years[i];
        ceduo_result_read(scene, &y->option, bare, &y->wooded, y->stands, y->controls);
    }
}

/* Years as variants of a scene that differ in their forests. */
struct years_run {
    struct ceduo_years *years;
    struct ceduo_pool *pool;
    const struct ceduo_simulated *bare;
    uint64_t rocks;           /* 0: no simulation */
    struct ceduo_run_def def; /* for years with independent rocks */
    struct ceduo_run **runs;  /* likewise, one per year */
    struct talk talk;
};

static void read_year(const struct years_run *r, struct ceduo_year *y)
{
    ceduo_simulated_compare(&y->wooded, r->bare);
    ceduo_result_read(&r->years->scene, &y->option, r->bare, &y->wooded, y->stands, y->controls);
    if (r->pool)
        ceduo_pool_trim(r->pool);
}

static enum ceduo_status make_year(void *context, size_t i, struct ceduo_variant *variant)
{
    struct years_run *r = context;
    struct ceduo_year *y = &r->years->years[i];
    variant->run.option = &y->option;
    variant->rocks = r->rocks;
    variant->skip = r->rocks == 0;
    if (variant->skip)
        read_year(r, y);
    return CEDUO_OK;
}

/* True if a rock exceeds the accepted energy at the last control, or reaches it if none is given. */
static bool is_marked(const struct ceduo_years *years, double energy)
{
    double accepted = years->scene.controls[years->last_control].accepted;
    return isnan(accepted) ? !isnan(energy) : energy > accepted;
}

/* Read the run of a year, and count the marks of its rocks. */
static enum ceduo_status add_year(void *context, size_t i, struct ceduo_run *run, uint64_t *rocks)
{
    struct years_run *r = context;
    struct ceduo_years *years = r->years;
    struct ceduo_year *y = &years->years[i];
    (void)rocks;
    ceduo_simulated_release(&y->wooded);
    enum ceduo_status status = ceduo_simulated_read(run, &years->scene, r->bare, &y->wooded);
    if (status != CEDUO_OK)
        return status;
    ceduo_simulated_set_no_contacts(&y->wooded);
    r->rocks = ceduo_run_rocks(run) < r->rocks ? ceduo_run_rocks(run) : r->rocks;
    const double *weights = ceduo_run_samples(run, 0, CEDUO_SAMPLE_WEIGHT);
    const double *energies = ceduo_run_samples(run, years->last_control, CEDUO_SAMPLE_ENERGY);
    if (weights && !years->weights) {
        if (!(years->weights = malloc((size_t)r->rocks * sizeof *weights)))
            return CEDUO_NO_MEMORY;
        memcpy(years->weights, weights, (size_t)r->rocks * sizeof *weights);
    }
    for (uint64_t k = 0; energies && k < r->rocks; k++)
        years->marks[k] = (uint16_t)(years->marks[k] + is_marked(years, energies[k]));
    read_year(r, y);
    return CEDUO_OK;
}

static bool clear_marks(struct ceduo_years *years, uint64_t rocks)
{
    free(years->marks);
    free(years->weights);
    years->weights = NULL;
    years->rocks = 0;
    years->marks = calloc((size_t)rocks + 1, sizeof *years->marks);
    return years->marks;
}

enum ceduo_status ceduo_years_simulate(struct ceduo_years *years, struct ceduo_pool *pool, const struct ceduo_simulated *bare,
                                       uint64_t rocks)
{
    struct years_run r = {.years = years, .pool = pool, .bare = bare};
    r.rocks = years->scene.simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX ? rocks : 0;
    if (r.rocks > 0 && !clear_marks(years, rocks))
        return CEDUO_NO_MEMORY;
    enum ceduo_status status = ceduo_variants_run(
        &(const struct ceduo_variants){.n = years->count, .make = make_year, .read = add_year, .pool = pool, .context = &r});
    years->rocks = status == CEDUO_OK ? r.rocks : years->rocks;
    return status;
}

/* ---- independent rocks ---- */

/* Called from several threads. */
static void report_year(void *context, uint64_t rocks)
{
    struct years_run *r = context;
    if (!ceduo_guard_try_enter(&r->talk))
        return;
    r->def.progress(r->def.context, rocks);
    ceduo_guard_leave(&r->talk);
}

/* Options have the same rocks in years of the same index, so that their differences are caused by the forests. */
static int simulate_independent(void *context, size_t i, size_t worker)
{
    struct years_run *r = context;
    struct ceduo_scene scene = r->years->scene;
    struct ceduo_run_def def = r->def;
    (void)worker;
    scene.simulation.seed = random_seed(scene.simulation.seed, VARIANT_YEAR, i);
    def.scene = &scene;
    def.option = &r->years->years[i].option;
    def.threads = 1;
    def.rocks_max = r->rocks;
    def.progress = r->def.progress ? report_year : NULL;
    def.context = r;
    enum ceduo_status status = ceduo_run_create(&def, &r->runs[i]);
    return (int)(status == CEDUO_OK ? ceduo_run_extend(r->runs[i], r->rocks) : status);
}

enum ceduo_status ceduo_years_simulate_independent(struct ceduo_years *years, const struct ceduo_run_def *def,
                                                   const struct ceduo_simulated *bare, uint64_t rocks)
{
    struct years_run r = {.years = years, .bare = bare, .rocks = rocks, .def = *def};
    r.runs = calloc(years->count, sizeof *r.runs);
    enum ceduo_status status = r.runs && clear_marks(years, rocks) ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status =
            (enum ceduo_status)ceduo_parallel(&(const struct parallel){years->count, def->threads, simulate_independent, &r});
    for (size_t i = 0; i < years->count && status == CEDUO_OK; i++)
        status = add_year(&r, i, r.runs[i], &rocks);
    for (size_t i = 0; r.runs && i < years->count; i++)
        ceduo_run_free(r.runs[i]);
    free(r.runs);
    years->rocks = status == CEDUO_OK ? r.rocks : years->rocks;
    return status;
}

/* ---- all years together ---- */

/* Return the share of years in which a rock is marked. */
static double marked_share(const struct ceduo_years *years, uint64_t rock)
{
    return (double)years->marks[rock] / (double)years->count;
}

/* Return the weighted mean of these shares, minus those of `less` (may be NULL). */
static struct ceduo_estimate weighted_difference(const struct ceduo_years *years, const struct ceduo_years *less,
                                                 uint64_t rocks)
{
    struct weight_totals totals = {.n = (double)rocks};
    struct weighted_sum sum = {0};
    for (uint64_t r = 0; r < rocks; r++) {
        double w = years->weights[r];
        totals.w += w;
        totals.ww += w * w;
        weighted_sum_add(&sum, w, marked_share(years, r) - (less ? marked_share(less, r) : 0));
    }
    return ceduo_weighted_paired(&totals, &sum);
}

struct ceduo_years_summary ceduo_years_summarize(const struct ceduo_years *years, size_t control)
{
    struct ceduo_years_summary s = {.years = years->count, .worst = NAN};
    if (control >= years->scene.controls_count) {
        s.nothing = true;
        return s;
    }
    bool simulates = years->scene.simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    for (size_t i = 0; i < years->count; i++) {
        const struct ceduo_year *y = &years->years[i];
        const struct ceduo_index *index = &y->controls[control];
        s.nothing |= index->contact == CEDUO_LIGHT_UNKNOWN;
        s.unprotected_contact += index->contact == CEDUO_LIGHT_FAIL;
        s.unprotected_free_run += index->free_run == CEDUO_LIGHT_FAIL;
        s.thick_contact += index->thick.contact == CEDUO_LIGHT_FAIL;
        s.thick_free_run += index->thick.free_run == CEDUO_LIGHT_FAIL;
        s.unprotected_energy += index->energy == CEDUO_LIGHT_FAIL;
        if (y->wooded.rocks > 0) {
            const struct ceduo_arrivals *a = &y->wooded.arrivals[control];
            double n = isnan(a->hazard.per_year) ? (double)a->released : a->hazard.effective;
            double share = ceduo_judged_share(a).mean;
            struct ceduo_estimate rate = ceduo_hazard_judged_rate(&a->hazard);
            s.simulated++;
            s.failing_lo += a->exceed.lo > a->limit;
            s.failing_hi += a->exceed.hi > a->limit;
            s.rate.mean += rate.mean;
            s.rate.lo += rate.lo;
            s.rate.hi += rate.hi;
            s.reach.mean += a->reach.mean;
            s.reach.se += ceduo_share_se(a->reach.mean, n);
            s.exceed.mean += a->exceed.mean;
            s.exceed.se += ceduo_share_se(a->exceed.mean, n);
            s.energy_per_released.mean += a->energy_per_released.mean;
            s.energy_per_released.se += a->energy_per_released.se;
            if (isnan(s.worst) || share > s.worst) {
                s.worst = share;
                s.worst_year = y->year;
            }
        } else if (!simulates && !(index->worst_adc <= s.worst)) {
            s.worst = index->worst_adc;
            s.worst_year = y->year;
        }
    }
    struct ceduo_estimate *const means[] = {&s.reach, &s.exceed, &s.energy_per_released};
    for (size_t i = 0; i < 3; i++) { /* NaN without simulated years */
        means[i]->mean /= (double)s.simulated;
        means[i]->se /= (double)s.simulated;
    }
    s.rate.mean /= (double)s.simulated;
    s.rate.lo /= (double)s.simulated;
    s.rate.hi /= (double)s.simulated;
    if (years->rocks > 0 && control == years->last_control) { /* every rock is simulated in all years: its mean is one sample */
        struct ceduo_moments m = {0};
        for (uint64_t r = 0; r < years->rocks && !years->weights; r++)
            ceduo_moments_add(&m, marked_share(years, r));
        double se = years->weights ? weighted_difference(years, NULL, years->rocks).se
                                   : ceduo_moments_sd(&m) / sqrt((double)years->rocks);
        (isnan(s.exceed.mean) ? &s.reach : &s.exceed)->se = se;
    }
    s.passes_per_year = s.reach.mean * years->scene.rocks_per_year;
    s.exceeds_per_year = s.exceed.mean * years->scene.rocks_per_year;
    return s;
}

static void widen_load(struct ceduo_fence_load *load, const struct ceduo_fence_load *other_load)
{
    load->speed = fmax(load->speed, other_load->speed);
    load->energy = fmax(load->energy, other_load->energy);
    load->top = fmax(load->top, other_load->top);
    load->middle = fmax(load->middle, other_load->middle);
}

struct ceduo_fence_years ceduo_years_fence(const struct ceduo_years *years, size_t control, const struct ceduo_arrivals *today)
{
    const struct ceduo_fence_arrivals none = ceduo_fence_none(), *now = today->fence ? today->fence : &none;
    const struct ceduo_fence_choice *choice = ceduo_fence_smallest(now->enough);
    struct ceduo_fence_grid all = now->grid;
    struct ceduo_fence_years s = {.worst = CEDUO_NO_ESTIMATE, .arriving = none.arriving, .system = none.system};
    double per_year = 0;
    for (size_t i = 0; i < years->count; i++) {
        const struct ceduo_year *y = &years->years[i];
        if (y->wooded.rocks == 0 || !y->wooded.fences)
            continue;
        const struct ceduo_fence_arrivals *f = &y->wooded.fences[control];
        s.years++;
        widen_load(&s.arriving, &f->arriving);
        widen_load(&s.system, &f->system);
        s.mean.mean += f->defeated.mean;
        s.mean.lo += f->defeated.lo;
        s.mean.hi += f->defeated.hi;
        per_year += f->per_year;
        s.failing += f->defeated.mean > y->wooded.arrivals[control].limit;
        if (!(f->defeated.mean <= s.worst.mean)) {
            s.worst = f->defeated;
            s.worst_year = y->year;
        }
        for (size_t h = 0; h < CEDUO_FENCE_HEIGHTS; h++) {
            for (size_t k = 0; k < CEDUO_FENCE_CLASSES; k++)
                if (f->grid.defeated[h][k].mean > all.defeated[h][k].mean)
                    all.defeated[h][k] = f->grid.defeated[h][k];
            all.energy[h] = fmax(all.energy[h], f->grid.energy[h]);
        }
        if (choice && f->enough[choice - now->enough].class_index > choice->class_index) {
            s.first_exception = s.exceptions++ == 0 ? y->year : s.first_exception;
            s.last_exception = y->year;
        }
    }
    double n = (double)s.years;
    s.mean = (struct ceduo_estimate){s.mean.mean / n, NAN, s.mean.lo / n, s.mean.hi / n}; /* NaN without years */
    s.per_year = per_year / n;
    s.in_life = -expm1(-s.per_year * ceduo_fence_life(&years->scene.controls[control].fence));
    ceduo_fence_choose(&all, ceduo_exceed_limit(&years->scene, &years->scene.controls[control]), s.enough);
    return s;
}

struct ceduo_estimate ceduo_years_difference(const struct ceduo_years *years, const struct ceduo_years *less)
{
    if (years->rocks == 0 || less->rocks == 0 || years->scene.controls_count == 0)
        return CEDUO_NO_ESTIMATE;
    uint64_t rocks = less->rocks < years->rocks ? less->rocks : years->rocks;
    if (years->weights)
        return weighted_difference(years, less, rocks);
    struct ceduo_moments m = {0};
    for (uint64_t r = 0; r < rocks; r++)
        ceduo_moments_add(&m, marked_share(years, r) - marked_share(less, r));
    return ceduo_estimate_from_pairs(m.mean, &m, rocks);
}

double ceduo_years_felled(const struct ceduo_years *years)
{
    double metres = 0;
    for (size_t i = 0; i < years->count; i++) {
        const struct ceduo_year *y = &years->years[i];
        for (size_t k = 0; k < y->option.belts_count; k++)
            if (y->option.belts[k].felled)
                metres += y->option.belts[k].to - y->option.belts[k].from;
    }
    return metres;
}
