/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

/* A share with its 95 % interval. */
static void set_share(struct ceduo_rate rate, double *share, double *lo, double *hi)
{
    *share = rate.rate;
    *lo = rate.lo;
    *hi = rate.hi;
}

/* Of n rocks; the upper end of its interval counts the unfinished in. */
static struct ceduo_rate share_of(uint64_t hits, uint64_t unfinished, uint64_t n)
{
    return ceduo_wilson((double)hits / (double)n, (double)(hits + unfinished) / (double)n, (double)n);
}

/* ---- rocks with weights ---- */

static struct released released_of(const struct ceduo_run *run, double missing)
{
    struct released all = {.n = (double)run->rocks, .per_year = run->ready.sizes.per_year, .missing = missing};
    for (uint64_t r = 0; r < run->rocks; r++) {
        double w = run->weights[r];
        all.w += w;
        all.ww += w * w;
    }
    return all;
}

/* The largest energies that the rocks could have: of how they are released, and of falling to the lowest ground. */
static void bound_energies(const struct ceduo_run *run, struct weighted *could)
{
    const struct ceduo_scene *scene = &run->ready.scene;
    const struct ceduo_release *start = &scene->release;
    const struct ceduo_number moves[] = {start->vx, start->vz, start->spin};
    double squares[3], low = INFINITY;
    for (size_t i = 0; i < 3; i++) {
        double fastest = fmax(fabs(ceduo_number_lowest(moves[i])), fabs(ceduo_number_highest(moves[i])));
        squares[i] = fastest * fastest;
    }
    for (size_t i = 0; i < scene->slope.vertices; i++)
        low = fmin(low, scene->slope.z[i]);
    double drop = fmax(ceduo_slope_height(&scene->slope, ceduo_number_lowest(start->x)),
                       ceduo_slope_height(&scene->slope, ceduo_number_highest(start->x))) +
                  ceduo_number_highest(start->height) - low;
    for (uint64_t r = 0; r < run->rocks; r++) {
        struct ceduo_rock rock = {0};
        ceduo_prepared_rock(&run->ready, r, &rock);
        double mass_energy = scene->simulation.gravity * drop + 0.5 * (squares[0] + squares[1]);
        could[r] = (struct weighted){rock.mass * mass_energy + 0.5 * rock.moment * squares[2], run->weights[r]};
    }
    ceduo_weighted_bound(could, (size_t)run->rocks);
}

/* The values of a column that are there, with the weights of their rocks. */
static size_t gather_weighted(const struct ceduo_run *run, const double *column, struct weighted *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = (struct weighted){column[r], run->weights[r]};
    return n;
}

/* Height of the top of a rock whose underside has this height; NaN stays. The rock was drawn for the run, so it can be drawn. */
static double top_of(const struct ceduo_run *run, uint64_t number, double height)
{
    struct ceduo_rock rock = {0};
    if (!isnan(height))
        ceduo_prepared_rock(&run->ready, number, &rock);
    return height + rock.mean_diameter;
}

/* From the samples, in the order of the rocks, and from sums of the weights by the ways that rocks end. */
static enum ceduo_status read_weighted(const struct ceduo_run *run, size_t control, const struct sums *s,
                                       struct ceduo_arrivals *a)
{
    struct released all = released_of(run, s->missed[CEDUO_UNFINISHED]);
    const double accepted = run->ready.scene.controls[control].accepted, *height = samples_of(run, control, HEIGHT);
    struct ceduo_distribution *const to[QUANTITIES] = {
        [SPEED] = &a->speed, [HEIGHT] = &a->height, [ENERGY] = &a->energy, [TRANSLATION] = &a->translation};
    struct weighted_sum reach = {0}, exceed = {0}, energy = {0};
    struct weighted *values = malloc(2 * ((size_t)run->rocks + 1) * sizeof *values);
    size_t n = 0;
    if (!values)
        return CEDUO_NO_MEMORY;
    struct weighted *could = values + run->rocks + 1;
    bound_energies(run, could);
    all.could = could;
    a->exact = true;
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = s->missed[e] / all.w;
    for (int q = 0; q < QUANTITIES; q++)
        *to[q] = ceduo_weighted_distribution(&all, values, gather_weighted(run, samples_of(run, control, q), values));
    for (uint64_t r = 0; r < run->rocks && run->ready.scene.design.survey >= 0; r++) {
        double top = top_of(run, r, height[r]);
        if (!isnan(top))
            values[n++] = (struct weighted){top, run->weights[r]};
    }
    ceduo_weighted_sort(values, n);
    a->top_p95 = ceduo_weighted_quantile(values, n, 0.95);
    n = gather_weighted(run, samples_of(run, control, ENERGY), values);
    bool good = ceduo_hazard_read(&all, values, n, accepted, &a->hazard); /* which sorts them */
    a->hazard.accepted_return = isnan(accepted) ? NAN : ceduo_accepted_return(&run->ready.scene.controls[control]);
    for (size_t i = 0; i < n; i++) {
        weighted_sum_add(&reach, values[i].weight, 1);
        weighted_sum_add(&exceed, values[i].weight, values[i].value > accepted);
        weighted_sum_add(&energy, values[i].weight, values[i].value);
    }
    set_share(ceduo_weighted_share(&all, &reach, -1), &a->reach_probability, &a->reach_lo, &a->reach_hi);
    if (!isnan(accepted))
        set_share(ceduo_weighted_share(&all, &exceed, accepted), &a->exceed_probability, &a->exceed_lo, &a->exceed_hi);
    a->energy_per_released = energy.t / all.w;
    a->energy_per_released_se = ceduo_weighted_se(&all, &energy);
    if (!run->ready.wood.bare && n > 0) { /* no sample is kept of stems hit, but sums */
        double mean = a->contacts = s->hits.t / reach.t;
        struct weighted_sum about = {.tt = s->hits.tt - mean * (2 * s->hits.tw - mean * reach.tt),
                                     .tw = s->hits.tw - mean * reach.tt};
        a->contacts_se = n > 1 ? ceduo_weighted_se(&all, &about) * all.w / reach.t : NAN;
    }
    free(values);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

static struct ceduo_difference weighted_difference(const struct ceduo_run *run, const struct ceduo_run *baseline,
                                                   size_t control)
{
    const struct ceduo_run *shorter = run->rocks < baseline->rocks ? run : baseline;
    const struct released all = released_of(shorter, 0);
    const double *a = samples_of(run, control, ENERGY), *b = samples_of(baseline, control, ENERGY);
    double accepted = run->ready.scene.controls[control].accepted;
    struct weighted_sum reach = {0}, exceed = {0}, energy = {0};
    for (uint64_t r = 0; r < shorter->rocks; r++) {
        double w = run->weights[r];
        weighted_sum_add(&reach, w, (double)!isnan(a[r]) - (double)!isnan(b[r]));
        weighted_sum_add(&exceed, w, (double)(a[r] > accepted) - (double)(b[r] > accepted));
        weighted_sum_add(&energy, w, (isnan(a[r]) ? 0 : a[r]) - (isnan(b[r]) ? 0 : b[r]));
    }
    struct ceduo_difference d = {ceduo_weighted_paired(&all, &reach), ceduo_weighted_paired(&all, &exceed),
                                 ceduo_weighted_paired(&all, &energy)};
    if (isnan(accepted))
        d.exceed_probability = CEDUO_NOT_PAIRED;
    return d;
}

/* ---- arrivals ---- */

/* The values of a column that are there, in the order of the rocks. */
static size_t gather(const struct ceduo_run *run, const double *column, double *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = column[r];
    return n;
}

static struct ceduo_distribution distribution(const struct ceduo_run *run, size_t control, int q, const struct ceduo_moments *m,
                                              double *scratch)
{
    if (!run->exact)
        return ceduo_distribution_binned(bins_of(run->bins, run, control, q), m);
    size_t n = run->room > 0 ? gather(run, samples_of(run, control, q), scratch) : 0;
    return ceduo_distribution_exact(scratch, n, m);
}

/* ---- what is read ---- */

/* The 95th percentile of the heights of the tops of the rocks that arrive, where each is as large as it was drawn. */
static double top_p95(const struct ceduo_run *run, size_t control, double height_p95, double *scratch)
{
    const struct ceduo_scene *scene = &run->ready.scene;
    const double *height = samples_of(run, control, HEIGHT);
    struct ceduo_moments m = {0};
    size_t n = 0;
    if (scene->design.survey < 0 || scene->design.blocks < 0)
        return NAN;
    if (!ceduo_scene_rock_varies(scene))
        return height_p95 + run->ready.mean.mean_diameter;
    for (uint64_t r = 0; run->exact && run->room > 0 && r < run->rocks; r++) {
        double top = top_of(run, r, height[r]);
        if (isnan(top))
            continue;
        scratch[n++] = top;
        ceduo_moments_add(&m, top);
    }
    return n > 0 ? ceduo_distribution_exact(scratch, n, &m).p95 : NAN;
}

double ceduo_exceed_limit(const struct ceduo_scene *scene, const struct ceduo_control *control)
{
    double per_year = 0;
    for (size_t i = 0; i < scene->blocks_count; i++)
        per_year += scene->blocks[i].per_year;
    return scene->blocks_count > 0 ? 1 / (ceduo_accepted_return(control) * per_year) : CEDUO_EXCEED_MOST;
}

enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a)
{
    *a = (struct ceduo_arrivals){0};
    if (control >= run->controls)
        return CEDUO_BAD_ARGUMENT;
    struct sums s = ceduo_run_sums_at(run, control);
    *a = (struct ceduo_arrivals){.released = run->rocks,
                                 .reached = s.of[SPEED].n,
                                 .exceeded = s.exceeded,
                                 .unfinished = s.ended[CEDUO_UNFINISHED],
                                 .exceed_probability = NAN,
                                 .exceed_lo = NAN,
                                 .exceed_hi = NAN,
                                 .limit = ceduo_exceed_limit(&run->ready.scene, &run->ready.scene.controls[control]),
                                 .contacts = NAN,
                                 .contacts_se = NAN,
                                 .hazard = ceduo_hazard_none(),
                                 .topography = ceduo_prepared_topography(&run->ready, control),
                                 .exact = run->exact};
    memcpy(a->ended, s.ended, sizeof a->ended);
    if (run->sized)
        return read_weighted(run, control, &s, a);
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = (double)s.ended[e] / (double)run->rocks;
    set_share(share_of(a->reached, a->unfinished, run->rocks), &a->reach_probability, &a->reach_lo, &a->reach_hi);
    if (!isnan(run->ready.scene.controls[control].accepted))
        set_share(share_of(a->exceeded, a->unfinished, run->rocks), &a->exceed_probability, &a->exceed_lo, &a->exceed_hi);
    const struct ceduo_moments *energy = &s.of[ENERGY]; /* of all released rocks; a rock that does not arrive counts as 0 */
    double n = (double)run->rocks, arrived = (double)energy->n / n;
    double m2 = energy->m2 + energy->mean * energy->mean * (double)energy->n * (1 - arrived);
    a->energy_per_released = energy->mean * arrived;
    a->energy_per_released_se = run->rocks < 2 ? NAN : sqrt(m2 / (n - 1) / n);
    if (!run->ready.wood.bare && s.contacts.n > 0) {
        a->contacts = s.contacts.mean;
        a->contacts_se = ceduo_moments_se(&s.contacts);
    }
    double *scratch = malloc(((size_t)run->rocks + 1) * sizeof(double));
    if (!scratch)
        return CEDUO_NO_MEMORY;
    a->speed = distribution(run, control, SPEED, &s.of[SPEED], scratch);
    a->height = distribution(run, control, HEIGHT, &s.of[HEIGHT], scratch);
    if (run->kept == QUANTITIES) {
        a->energy = distribution(run, control, ENERGY, &s.of[ENERGY], scratch);
        a->translation = distribution(run, control, TRANSLATION, &s.of[TRANSLATION], scratch);
    } else {
        /* one mass and no spin make energy follow from speed */
        struct ceduo_distribution d = a->speed;
        double *const quantiles[] = {&d.p50, &d.p50_lo, &d.p50_hi, &d.p95, &d.p95_lo, &d.p95_hi, &d.p99, &d.p99_lo, &d.p99_hi};
        for (size_t i = 0; i < sizeof quantiles / sizeof quantiles[0]; i++)
            *quantiles[i] = 0.5 * run->ready.mean.mass * (*quantiles[i] * *quantiles[i]);
        d.se = ceduo_moments_se(energy);
        d.sd = ceduo_moments_sd(energy);
        d.mean = energy->n > 0 ? energy->mean : NAN;
        d.max = energy->n > 0 ? energy->max : NAN;
        a->energy = a->translation = d;
    }
    a->top_p95 = top_p95(run, control, a->height.p95, scratch);
    free(scratch);
    return CEDUO_OK;
}

void ceduo_run_briefs(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_brief *briefs)
{
    bool known = control < run->controls;
    double accepted = known ? run->ready.scene.controls[control].accepted : NAN;
    for (size_t g = 0; g < groups; g++) {
        if (!known) {
            briefs[g] = (struct ceduo_brief){NAN, NAN, NAN, NAN};
            continue;
        }
        double all = 0, reached = 0, exceeded = 0, sum = 0;
        for (uint64_t r = run->rocks * g / groups; r < run->rocks * (g + 1) / groups; r++) {
            double energy = ceduo_run_sample_energy(run, control, r), w = run->sized ? run->weights[r] : 1;
            all += w;
            reached += isnan(energy) ? 0 : w;
            exceeded += energy > accepted ? w : 0;
            sum += isnan(energy) ? 0 : w * energy;
        }
        briefs[g] = (struct ceduo_brief){.reach_probability = reached / all,
                                         .exceed_probability = isnan(accepted) ? NAN : exceeded / all,
                                         .energy = reached > 0 ? sum / reached : NAN,
                                         .energy_per_released = sum / all};
    }
}

void ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached, double *mean, double *se)
{
    *reached = 0;
    *mean = *se = NAN;
    if (control >= run->controls)
        return;
    const struct sums s = ceduo_run_sums_at(run, control);
    *reached = s.of[ENERGY].n;
    *mean = *reached > 0 ? s.of[ENERGY].mean : NAN;
    *se = ceduo_moments_se(&s.of[ENERGY]);
    if (!run->sized)
        return;
    const struct released all = released_of(run, 0);
    const double *energy = samples_of(run, control, ENERGY);
    struct weighted_sum ones = {0}, sum = {0}, about = {0};
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(energy[r])) {
            weighted_sum_add(&ones, run->weights[r], 1);
            weighted_sum_add(&sum, run->weights[r], energy[r]);
        }
    *mean = *reached > 0 ? sum.t / ones.t : NAN;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(energy[r]))
            weighted_sum_add(&about, run->weights[r], energy[r] - *mean);
    *se = *reached > 1 ? ceduo_weighted_se(&all, &about) * all.w / ones.t : NAN;
}

/* ---- differences ---- */

/* Of the rocks whose energies are known. */
static uint64_t paired_rocks(const struct ceduo_run *run)
{
    return run->exact || run->rocks < run->pairs_room ? run->rocks : run->pairs_room;
}

static double paired_energy(const struct ceduo_run *run, size_t control, uint64_t rock)
{
    return run->exact ? ceduo_run_sample_energy(run, control, rock) : run->pairs[control * run->pairs_room + rock];
}

struct ceduo_difference ceduo_no_difference(double accepted)
{
    const struct ceduo_paired none = {0, 0, 0};
    return (struct ceduo_difference){none, isnan(accepted) ? CEDUO_NOT_PAIRED : none, none};
}

struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control)
{
    bool alike = run && baseline && run->rocks == baseline->rocks;
    if (!run || !baseline || run->rocks == 0 || baseline->rocks == 0 || control >= run->controls ||
        control >= baseline->controls || (!alike && !(run->exact && baseline->exact)))
        return (struct ceduo_difference){CEDUO_NOT_PAIRED, CEDUO_NOT_PAIRED, CEDUO_NOT_PAIRED};
    const struct ceduo_control *at = &run->ready.scene.controls[control];
    if (alike && (run == baseline || (run->stems_from >= at->x && baseline->stems_from >= at->x)))
        return ceduo_no_difference(at->accepted);
    if (run->sized)
        return weighted_difference(run, baseline, control);
    uint64_t a = paired_rocks(run), b = paired_rocks(baseline), paired = a < b ? a : b; /* rocks that both have */
    struct ceduo_moments reach = {0}, exceed = {0}, energy = {0};                       /* of their differences */
    for (uint64_t r = 0; r < paired; r++) {
        double e = paired_energy(run, control, r), f = paired_energy(baseline, control, r);
        ceduo_moments_add(&reach, (double)!isnan(e) - (double)!isnan(f));
        ceduo_moments_add(&exceed, (double)(e > at->accepted) - (double)(f > at->accepted));
        ceduo_moments_add(&energy, (isnan(e) ? 0 : e) - (isnan(f) ? 0 : f));
    }
    uint64_t rocks = alike ? run->rocks : paired;
    struct ceduo_difference d = {ceduo_paired_of(reach.mean, &reach, rocks), ceduo_paired_of(exceed.mean, &exceed, rocks),
                                 ceduo_paired_of(energy.mean, &energy, rocks)};
    if (alike) { /* the means of all rocks, where only the first are paired */
        struct sums s = ceduo_run_sums_at(run, control), t = ceduo_run_sums_at(baseline, control);
        const struct ceduo_moments *e = &s.of[ENERGY], *f = &t.of[ENERGY];
        double n = (double)run->rocks;
        d.reach_probability.mean = ((double)e->n - (double)f->n) / n;
        d.exceed_probability.mean = ((double)s.exceeded - (double)t.exceeded) / n;
        d.energy_per_released.mean = (e->mean * (double)e->n - f->mean * (double)f->n) / n;
    }
    if (isnan(at->accepted))
        d.exceed_probability = CEDUO_NOT_PAIRED;
    return d;
}

uint64_t ceduo_run_mark(const struct ceduo_run *run, size_t control, uint16_t *marks, uint64_t max)
{
    if (control >= run->controls)
        return 0;
    double accepted = run->ready.scene.controls[control].accepted;
    uint64_t rocks = paired_rocks(run);
    rocks = rocks < max ? rocks : max;
    for (uint64_t r = 0; r < rocks; r++) {
        double energy = paired_energy(run, control, r);
        marks[r] = (uint16_t)(marks[r] + (isnan(accepted) ? !isnan(energy) : energy > accepted));
    }
    return rocks;
}

/* ---- ends, envelopes, energies ---- */

enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends)
{
    *ends = (struct ceduo_ends){.stop_p50 = NAN, .stop_p95 = NAN, .stop_max = NAN};
    if (run->def.arrivals_only)
        return CEDUO_OK;
    const struct released all = run->sized ? released_of(run, 0) : (struct released){0};
    ends->stop_x = run->whole.stop_x;
    ends->uphill = run->whole.uphill + run->tail.uphill;
    ends->early = run->whole.early + run->tail.early;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        ends->count[e] = run->whole.ends[e] + run->tail.ends[e];
        ends->share[e] = (double)ends->count[e] / (double)run->rocks;
        if (run->sized && run->rocks > 0)
            ends->share[e] = (run->whole.ended[e] + run->tail.ended[e]) / all.w;
    }
    ceduo_moments_merge(&ends->stop_x, &run->tail.stop_x);
    size_t n = (size_t)ends->stop_x.n;
    if (n == 0)
        return CEDUO_OK;
    ends->stop_max = ends->stop_x.max;
    if (!run->exact) {
        const struct histogram *h = &run->bins[run->columns - 1];
        ends->stop_p50 = ceduo_histogram_value(h, ceduo_quantile_rank(n, 0.5));
        ends->stop_p95 = ceduo_histogram_value(h, ceduo_quantile_rank(n, 0.95));
        return CEDUO_OK;
    }
    struct weighted *stops = malloc((n + 1) * sizeof *stops);
    double *scratch = (double *)stops;
    if (!stops)
        return CEDUO_NO_MEMORY;
    if (run->sized) {
        n = gather_weighted(run, stops_of(run), stops);
        ceduo_weighted_sort(stops, n);
        ends->stop_p50 = ceduo_weighted_quantile(stops, n, 0.5);
        ends->stop_p95 = ceduo_weighted_quantile(stops, n, 0.95);
    } else {
        gather(run, stops_of(run), scratch);
        struct ceduo_distribution d = ceduo_distribution_exact(scratch, n, &ends->stop_x);
        ends->stop_p50 = d.p50;
        ends->stop_p95 = d.p95;
    }
    free(stops);
    return CEDUO_OK;
}

const double *ceduo_run_weights(const struct ceduo_run *run)
{
    return run->weights;
}

size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t max)
{
    double all = 0, before = 0;
    size_t reached = 0, n = 0;
    uint64_t rocks = run->room > 0 && control < run->controls ? run->rocks : 0;
    for (uint64_t r = 0; r < rocks; r++)
        if (!isnan(ceduo_run_sample_energy(run, control, r))) {
            all += run->sized ? run->weights[r] : 1;
            reached++;
        }
    max = reached < max ? reached : max;
    for (uint64_t r = 0; n < max && r < rocks; r++) { /* untaken: rounding */
        double energy = ceduo_run_sample_energy(run, control, r);
        if (isnan(energy))
            continue;
        if (!run->sized)
            to[n++] = energy;
        else /* at even steps of the sum of their weights: light rocks are left out, heavy ones taken several times */
            for (before += run->weights[r]; n < max && ((double)n + 0.5) * all <= before * (double)max; n++)
                to[n] = energy;
    }
    return n;
}

bool ceduo_run_values(const struct ceduo_run *run, size_t control, enum ceduo_sample what, double *to)
{
    if (what != CEDUO_SAMPLE_STOP && control >= run->controls)
        return false;
    const double *kept =
        what == CEDUO_SAMPLE_STOP ? stops_of(run) : samples_of(run, control, what == CEDUO_SAMPLE_HEIGHT ? HEIGHT : SPEED);
    for (uint64_t r = 0; run->exact && r < run->rocks; r++)
        to[r] = what == CEDUO_SAMPLE_ENERGY ? ceduo_run_sample_energy(run, control, r) : kept[r];
    return run->exact;
}
