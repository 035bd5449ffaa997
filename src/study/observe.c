/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares simulated rocks with observations. Observations with the same rock, release and option form a setting and share
 * its rocks. A setting is simulated by a run whose controls are the observed places, or rock by rock (record.c) if a run
 * does not keep the observed quantity. This yields one value per observation and rock; NaN: the rock has no value. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/parallel.h"
#include "check_study.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "observe.h"

#define IMPOSSIBLE (-1e4) /* log-likelihood of an observation that no simulated rock reproduces */

struct setting {
    const struct ceduo_rock_def *rock;
    const struct ceduo_release *release;
    size_t option;
    size_t controls_count, stretches_count;
    struct ceduo_control *controls;
    struct ceduo_stretch *stretches;
    bool needs_record; /* simulate rock by rock */
    bool blows;        /* record impacts on stems */
};

/* Comparison of one observation. */
struct plan {
    const struct ceduo_observation *observation;
    const struct ceduo_observed_row *row;
    size_t setting, control, stretch;
    size_t bounds_count;
    double bounds[CEDUO_CLASSES_MAX]; /* upper ends of classes, inclusive, without the last */
    size_t classes;
    double counts[CEDUO_CLASSES_MAX];
};

struct ceduo_observer {
    struct arena arena;
    size_t n, settings_count;
    struct plan *plans;
    struct setting *settings;
};

/* ---- preparation ---- */

const struct ceduo_observed_row *ceduo_observed_row(enum ceduo_observed_kind kind)
{
    static const struct ceduo_observed_row rows[] = {
#define X(NAME, path, list, location, quantity)                                                                                \
    [CEDUO_OBSERVED_##NAME] = {path, list, CEDUO_LOCATION_##location, CEDUO_QUANTITY_##quantity},
        CEDUO_OBSERVED_LIST(X)
#undef X
    };
    return &rows[kind];
}

const struct ceduo_quantity_row *ceduo_observed_quantity(enum ceduo_observed_kind kind)
{
#define METRES "m|mt|metri|metro|metres|meters|meter"
    static const struct ceduo_quantity_row rows[] = {
        [CEDUO_QUANTITY_PLACE] = {"m", METRES, 1, "x_m", "distance|distanza|progressiva|dist|chainage|entfernung|distanz|x"},
        [CEDUO_QUANTITY_COUNT] = {"", "", 1, NULL, NULL},
        [CEDUO_QUANTITY_SPEED] = {"m/s", "m/s|m s-1|m·s-1|m s⁻¹|m·s⁻¹|m/sec", 1, "speed_m_s", "speed|velocity|velocit\xc3\xa0"},
        [CEDUO_QUANTITY_HEIGHT] = {"m", METRES, 1, "height_m", "height|altezza|h"},
        [CEDUO_QUANTITY_ENERGY] = {"kJ", "kJ", 1000, "energy_kJ", "energy|energia"}};
#undef METRES
    return &rows[ceduo_observed_row(kind)->quantity];
}

static struct setting *find_setting(struct ceduo_observer *o, const struct ceduo_observation *observation, size_t *index)
{
    for (*index = 0; *index < o->settings_count; ++*index) {
        struct setting *s = &o->settings[*index];
        if (s->rock == observation->rock && s->release == observation->release && s->option == observation->option)
            return s;
    }
    struct setting *s = &o->settings[o->settings_count++];
    *s = (struct setting){.rock = observation->rock, .release = observation->release, .option = observation->option};
    s->controls = ceduo_arena_alloc(&o->arena, (o->n + 1) * sizeof *s->controls);
    s->stretches = ceduo_arena_alloc(&o->arena, (o->n + 1) * sizeof *s->stretches);
    return o->arena.failed ? NULL : s;
}

static size_t find_control(struct setting *s, double x)
{
    size_t i = 0;
    while (i < s->controls_count && s->controls[i].x != x)
        i++;
    if (i == s->controls_count)
        s->controls[s->controls_count++] = (struct ceduo_control){.x = x, .x_given = x, .accepted = NAN, .measured_speed = NAN};
    return i;
}

static size_t find_class(const struct plan *p, double value)
{
    size_t c = 0;
    while (c < p->bounds_count && value > p->bounds[c])
        c++;
    return c;
}

/* Bin a sorted list at its own quantiles. Bounds lie halfway between two values. */
static void make_classes(struct plan *p)
{
    const struct ceduo_observation *observation = p->observation;
    size_t n = observation->n, k = n / 5 < CEDUO_CLASSES_MAX - 1 ? n / 5 : CEDUO_CLASSES_MAX - 1;
    k = k < 2 ? 2 : k;
    for (size_t c = 1; c < k; c++) {
        size_t rank = (c * n + k / 2) / k;
        double bound = rank == n ? observation->values[n - 1] : (observation->values[rank - 1] + observation->values[rank]) / 2;
        if (p->bounds_count == 0 || bound > p->bounds[p->bounds_count - 1])
            p->bounds[p->bounds_count++] = bound;
    }
    p->classes = p->bounds_count + 1;
    for (size_t i = 0; i < n; i++)
        p->counts[find_class(p, observation->values[i])]++;
    if (observation->kind == CEDUO_OBSERVED_STOPS && observation->released_count > 0)
        p->counts[p->classes++] = (double)(observation->released_count - n);
}

static bool make_plan(struct ceduo_observer *o, const struct ceduo_observation *observation, struct plan *p)
{
    struct setting *s = find_setting(o, observation, &p->setting);
    if (!s)
        return false;
    p->observation = observation;
    p->row = ceduo_observed_row(observation->kind);
    if (p->row->location == CEDUO_LOCATION_AT_PLACE)
        p->control = find_control(s, observation->x);
    if (p->row->location == CEDUO_LOCATION_ALONG) {
        p->stretch = s->stretches_count++;
        s->stretches[p->stretch] = (struct ceduo_stretch){observation->from, observation->to};
    }
    s->needs_record |= p->row->location >= CEDUO_LOCATION_LARGEST;
    s->blows |= p->row->location == CEDUO_LOCATION_ON_STEMS;
    if (observation->values) {
        make_classes(p);
    } else if (observation->kind == CEDUO_OBSERVED_PASSED) {
        p->classes = 2;
        p->counts[0] = (double)observation->count;
        p->counts[1] = (double)(observation->released_count - observation->count);
    }
    return true;
}

struct ceduo_observation ceduo_observation_default(void)
{
    return (struct ceduo_observation){.x = NAN, .from = NAN, .to = NAN, .n = 1, .mean = NAN, .sd = NAN, .share_seen = NAN};
}

enum ceduo_status ceduo_observer_create(const struct ceduo_observation *observations, size_t n,
                                        struct ceduo_observer **observer)
{
    *observer = NULL;
    enum ceduo_status status = ceduo_check_observations(observations, n, 0);
    if (status != CEDUO_OK)
        return status;
    struct ceduo_observer *o = *observer = calloc(1, sizeof *o);
    if (!o)
        return CEDUO_NO_MEMORY;
    o->n = n;
    o->plans = ceduo_arena_alloc(&o->arena, (n + 1) * sizeof *o->plans);
    o->settings = ceduo_arena_alloc(&o->arena, (n + 1) * sizeof *o->settings);
    bool good = o->plans && o->settings;
    for (size_t i = 0; good && i < n; i++)
        good = make_plan(o, &observations[i], &o->plans[i]);
    if (good)
        return CEDUO_OK;
    ceduo_observer_free(o);
    *observer = NULL;
    return CEDUO_NO_MEMORY;
}

void ceduo_observer_free(struct ceduo_observer *o)
{
    if (!o)
        return;
    ceduo_arena_free(&o->arena);
    free(o);
}

/* ---- rocks ---- */

/* The rocks of one setting, as a run or a record. */
struct simulated_setting {
    const struct setting *setting;
    struct ceduo_scene scene;
    uint64_t rocks;
    struct ceduo_run *run;
    struct ceduo_record record;
};

static enum ceduo_status simulate_setting(const struct setting *s, const struct ceduo_scene *scene, uint64_t rocks,
                                          const atomic_bool *cancel, struct simulated_setting *f)
{
    *f = (struct simulated_setting){.setting = s, .scene = *scene, .rocks = rocks};
    f->scene.rock = s->rock ? *s->rock : scene->rock;
    f->scene.blocks_count = 0; /* an observation is of one rock */
    f->scene.release = s->release ? *s->release : scene->release;
    f->scene.releases_count = s->release ? 0 : scene->releases_count;
    f->scene.controls_count = s->controls_count;
    f->scene.controls = s->controls;
    if (s->option >= scene->options_count || rocks == 0 || rocks > CEDUO_ROCKS_MAX)
        return CEDUO_BAD_ARGUMENT;
    const struct ceduo_option *option = &f->scene.options[s->option];
    bool bare = scene->simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX;
    enum ceduo_status status = ceduo_scene_check(&f->scene, NULL);
    if (status == CEDUO_OK && s->needs_record) {
        struct ceduo_record_def def = {.size = sizeof def,
                                       .scene = &f->scene,
                                       .option = bare ? NULL : option,
                                       .rocks = rocks,
                                       .stretches_count = s->stretches_count,
                                       .stretches = s->stretches,
                                       .blows = s->blows,
                                       .cancel = cancel};
        return ceduo_record(&def, &f->record);
    }
    struct ceduo_run_def def = ceduo_run_def_default(&f->scene);
    def.option = bare ? NULL : option;
    def.rocks_max = rocks;
    def.cancel = cancel;
    status = status == CEDUO_OK ? ceduo_run_create(&def, &f->run) : status;
    return status == CEDUO_OK ? ceduo_run_extend(f->run, rocks) : status;
}

static void release_simulated(struct simulated_setting *f)
{
    ceduo_run_free(f->run);
    ceduo_record_release(&f->record);
}

/* Return the value of a recorded rock; NaN: none. */
static double read_record(const struct simulated_setting *f, uint64_t rock, const struct plan *p)
{
    const struct ceduo_rock_record *r = &f->record.rocks[rock];
    const struct ceduo_stretch_means *m = &f->record.means[rock * f->setting->stretches_count + p->stretch];
    const struct ceduo_crossing *c = &f->record.crossings[rock * f->setting->controls_count + p->control];
    enum ceduo_quantity quantity = p->row->quantity;
    if (p->row->location == CEDUO_LOCATION_AT_REST)
        return r->stop_x;
    if (p->row->location == CEDUO_LOCATION_LARGEST)
        return quantity == CEDUO_QUANTITY_HEIGHT ? r->largest_height : r->largest_speed;
    if (p->row->location == CEDUO_LOCATION_ALONG)
        return quantity == CEDUO_QUANTITY_HEIGHT ? m->height : quantity == CEDUO_QUANTITY_ENERGY ? m->energy : m->speed;
    if (!c->reached || quantity == CEDUO_QUANTITY_HEIGHT)
        return c->reached ? c->height : NAN;
    double speed2 = c->vx * c->vx + c->vz * c->vz;
    return quantity == CEDUO_QUANTITY_ENERGY ? (r->mass * speed2 + r->moment * (c->spin * c->spin)) / 2 : sqrt(speed2);
}

static bool is_on_stretch(const struct ceduo_stem_impact *b, const struct plan *p)
{
    return b->x >= p->observation->from && b->x <= p->observation->to;
}

/* Return the n simulated values of one observation. The caller frees them. NULL on failure. */
static double *collect_values(const struct simulated_setting *f, const struct plan *p, size_t *n)
{
    bool is_impact = p->row->location == CEDUO_LOCATION_ON_STEMS;
    size_t capacity = is_impact ? f->record.blows_count : (size_t)f->rocks;
    enum ceduo_quantity quantity = p->row->quantity;
    double *values = malloc((capacity + 1) * sizeof *values);
    *n = is_impact || !values ? 0 : capacity;
    for (size_t i = 0; values && is_impact && i < capacity; i++)
        if (is_on_stretch(&f->record.blows[i], p))
            values[(*n)++] = f->record.blows[i].height;
    const double *samples = f->run ? ceduo_run_samples(f->run, p->control,
                                                       p->row->location == CEDUO_LOCATION_AT_REST ? CEDUO_SAMPLE_STOP
                                                       : quantity == CEDUO_QUANTITY_HEIGHT        ? CEDUO_SAMPLE_HEIGHT
                                                       : quantity == CEDUO_QUANTITY_ENERGY        ? CEDUO_SAMPLE_ENERGY
                                                                                                  : CEDUO_SAMPLE_SPEED)
                                   : NULL;
    for (size_t i = 0; i < *n && !is_impact; i++) {
        values[i] = samples ? samples[i] : read_record(f, i, p);
        if (p->row->location == CEDUO_LOCATION_AT_REST && values[i] < p->observation->from)
            values[i] = NAN;
    }
    return values;
}

/* ---- comparison ---- */

/* Return the denominator of class shares: at least CEDUO_CLASS_ROCKS_MIN rocks per class, plus the half rock that is added
 * to each class so that none has probability 0. */
static double count_class_rocks(const double *simulated, size_t classes)
{
    double rocks = 0;
    for (size_t i = 0; i < classes; i++)
        rocks += simulated[i];
    return fmax(rocks, CEDUO_CLASS_ROCKS_MIN * (double)classes) + (double)classes / 2;
}

double ceduo_classes_deviance(const double *observed, const double *simulated, size_t classes)
{
    double rocks = count_class_rocks(simulated, classes), n = 0, deviance = 0;
    for (size_t i = 0; i < classes; i++)
        n += observed[i];
    for (size_t i = 0; i < classes; i++)
        if (observed[i] > 0)
            deviance += 2 * observed[i] * log(observed[i] * rocks / (n * (simulated[i] + 0.5)));
    return deviance;
}

/* Add the normal log-likelihood and deviance of a difference. */
static void compare_normal(struct ceduo_observation_fit *c, double difference, double variance)
{
    double z2 = difference * difference / variance;
    bool known = isfinite(z2);
    c->log_likelihood += known ? -z2 / 2 - log(2 * M_PI * variance) / 2 : IMPOSSIBLE;
    c->deviance += known ? z2 : -2 * IMPOSSIBLE;
}

static void sum_values(const struct plan *p, const double *values, size_t n, struct ceduo_observation_fit *c)
{
    struct ceduo_moments m = {0};
    bool rest = p->classes > p->bounds_count + 1; /* the last class is for rocks without a value */
    for (size_t i = 0; i < n; i++) {
        if (!isnan(values[i]))
            ceduo_moments_add(&m, values[i]);
        if (!isnan(values[i]) && c->sample_count < CEDUO_SAMPLE_VALUES)
            c->sample[c->sample_count++] = values[i];
        if (p->classes > 0 && !isnan(values[i]))
            c->count[p->observation->kind == CEDUO_OBSERVED_PASSED ? 0 : find_class(p, values[i])]++;
        else if (p->classes > 0 && rest)
            c->count[p->classes - 1]++;
    }
    c->rocks = rest ? (uint64_t)n : m.n;
    c->mean = m.n > 0 ? m.mean : NAN;
    c->sd = ceduo_moments_sd(&m);
}

/* Compare the number of scars with that expected for the released rocks. The number varies from rock to rock, and the survey
 * finds only a share. Return false on failure of memory. */
static bool compare_scars(const struct plan *p, const struct simulated_setting *f, struct ceduo_observation_fit *c)
{
    const struct ceduo_observation *observation = p->observation;
    double share = isnan(observation->share_seen) ? 1 : observation->share_seen, released = (double)observation->released_count,
           n = (double)f->rocks;
    double *scars_per_rock = calloc((size_t)f->rocks + 1, sizeof *scars_per_rock);
    struct ceduo_moments m = {0};
    if (!scars_per_rock)
        return false;
    for (size_t i = 0; i < f->record.blows_count; i++)
        scars_per_rock[f->record.blows[i].rock] += is_on_stretch(&f->record.blows[i], p);
    for (uint64_t i = 0; i < f->rocks; i++)
        ceduo_moments_add(&m, scars_per_rock[i]);
    free(scars_per_rock);
    double variance = m.m2 / (n - 1); /* NaN for one rock */
    c->scars = released * m.mean * share;
    c->scars_variance = share * share * variance * released * (1 + released / n) + released * m.mean * share * (1 - share);
    compare_normal(c, (double)observation->n - c->scars, c->scars_variance);
    return true;
}

/* Return false on failure of memory. */
static bool compare(const struct plan *p, const struct simulated_setting *f, const double *values, size_t n,
                    struct ceduo_observation_fit *c)
{
    const struct ceduo_observation *observation = p->observation;
    double sum = 0;
    for (size_t i = 0; observation->values && i < observation->n; i++)
        sum += observation->values[i];
    *c = (struct ceduo_observation_fit){.classes = p->classes,
                                        .observed_mean = observation->values ? sum / (double)observation->n : observation->mean,
                                        .scars = NAN,
                                        .scars_variance = NAN};
    memcpy(c->observed, p->counts, sizeof c->observed);
    sum_values(p, values, n, c);
    c->variance = observation->sd * observation->sd / (double)observation->n + c->sd * c->sd / (double)c->rocks;
    if (p->classes > 0) { /* multinomial */
        double rocks = count_class_rocks(c->count, c->classes), all = 0;
        for (size_t i = 0; i < c->classes; i++) {
            all += c->observed[i];
            c->log_likelihood += c->observed[i] * log((c->count[i] + 0.5) / rocks) - lgamma(c->observed[i] + 1);
        }
        c->log_likelihood += lgamma(all + 1);
        c->deviance += ceduo_classes_deviance(c->observed, c->count, c->classes);
    } else {
        compare_normal(c, c->observed_mean - c->mean, c->variance);
    }
    return observation->kind != CEDUO_OBSERVED_SCARS || observation->released_count == 0 || compare_scars(p, f, c);
}

enum ceduo_status ceduo_observer_simulate(const struct ceduo_observer *o, const struct ceduo_scene *scene, uint64_t rocks,
                                          const atomic_bool *cancel, struct ceduo_observation_fit *to)
{
    enum ceduo_status status = CEDUO_OK;
    for (size_t s = 0; s < o->settings_count && status == CEDUO_OK; s++) {
        struct simulated_setting f;
        status = simulate_setting(&o->settings[s], scene, rocks, cancel, &f);
        for (size_t i = 0; i < o->n && status == CEDUO_OK; i++) {
            const struct plan *p = &o->plans[i];
            if (p->setting != s)
                continue;
            size_t n;
            double *values = collect_values(&f, p, &n);
            bool good = values && compare(p, &f, values, n, &to[i]);
            free(values);
            status = !good ? CEDUO_NO_MEMORY : ceduo_cancelled(cancel) ? CEDUO_CANCELLED : CEDUO_OK; /* untaken: race */
        }
        release_simulated(&f);
    }
    return status;
}

enum ceduo_status ceduo_observer_values(const struct ceduo_observer *o, const struct ceduo_scene *scene, size_t which,
                                        uint64_t rocks, double **values, size_t *n)
{
    *values = NULL;
    *n = 0;
    if (which >= o->n)
        return CEDUO_BAD_ARGUMENT;
    const struct plan *p = &o->plans[which];
    struct simulated_setting f;
    enum ceduo_status status = simulate_setting(&o->settings[p->setting], scene, rocks, NULL, &f);
    if (status == CEDUO_OK)
        *values = collect_values(&f, p, n);
    release_simulated(&f);
    return status == CEDUO_OK && !*values ? CEDUO_NO_MEMORY : status;
}
