/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulated rocks beside those that were seen. Observations of the same rock, release and option share their rocks: a
 * setting. Of a setting a run is made, whose controls are the places of the observations; or, where something is asked for
 * that a run does not keep, its rocks are followed one by one (record.c). Of every observation this gives one value for each
 * rock, NaN where it has none, and those are compared with what was seen. */
#include "ceduo/observe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/parallel.h"
#include "ceduo/record.h"
#include "ceduo/run.h"
#include "check_study.h"

#define IMPOSSIBLE (-1e4) /* log-likelihood of what no simulated rock does at all */

/* What is asked of one setting. */
struct setting {
    const struct ceduo_rock_def *rock;
    const struct ceduo_release *release;
    size_t option;
    size_t controls_count, stretches_count;
    struct ceduo_control *controls;
    struct ceduo_stretch *stretches;
    bool follows; /* rocks one by one */
    bool blows;
};

/* How an observation is compared. */
struct plan {
    const struct ceduo_observation *seen;
    const struct ceduo_observed_row *row;
    size_t setting, control, stretch;
    size_t bounds_count;
    double bounds[CEDUO_CLASSES_MAX]; /* between classes: a value on a bound is below it */
    size_t classes;
    double counts[CEDUO_CLASSES_MAX];
};

struct ceduo_observer {
    struct arena arena;
    size_t n, settings_count;
    struct plan *plans;
    struct setting *settings;
};

/* ---- making ready ---- */

const struct ceduo_observed_row *ceduo_observed_row(enum ceduo_observed_kind kind)
{
    static const struct ceduo_observed_row rows[] = {
#define X(NAME, path, list, where, quantity)                                                                                   \
    [CEDUO_OBSERVED_##NAME] = {path, list, CEDUO_WHERE_##where, CEDUO_QUANTITY_##quantity},
        CEDUO_OBSERVED_LIST(X)
#undef X
    };
    return &rows[kind];
}

const struct ceduo_quantity_row *ceduo_observed_quantity(enum ceduo_observed_kind kind)
{
    static const struct ceduo_quantity_row rows[] = {
        [CEDUO_QUANTITY_PLACE] = {"m", 1, "x_m", "distance|distanza|progressiva|dist|chainage|entfernung|distanz|x"},
        [CEDUO_QUANTITY_COUNT] = {"", 1, NULL, NULL},
        [CEDUO_QUANTITY_SPEED] = {"m/s", 1, "speed_m_s", "speed|velocity|velocit\xc3\xa0"},
        [CEDUO_QUANTITY_HEIGHT] = {"m", 1, "height_m", "height|altezza|h"},
        [CEDUO_QUANTITY_ENERGY] = {"kJ", 1000, "energy_kJ", "energy|energia"}};
    return &rows[ceduo_observed_row(kind)->quantity];
}

static struct setting *setting_of(struct ceduo_observer *o, const struct ceduo_observation *seen, size_t *index)
{
    for (*index = 0; *index < o->settings_count; ++*index) {
        struct setting *s = &o->settings[*index];
        if (s->rock == seen->rock && s->release == seen->release && s->option == seen->option)
            return s;
    }
    struct setting *s = &o->settings[o->settings_count++];
    *s = (struct setting){.rock = seen->rock, .release = seen->release, .option = seen->option};
    s->controls = ceduo_arena_alloc(&o->arena, (o->n + 1) * sizeof *s->controls);
    s->stretches = ceduo_arena_alloc(&o->arena, (o->n + 1) * sizeof *s->stretches);
    return o->arena.failed ? NULL : s;
}

static size_t control_of(struct setting *s, double x)
{
    size_t i = 0;
    while (i < s->controls_count && s->controls[i].x != x)
        i++;
    if (i == s->controls_count)
        s->controls[s->controls_count++] = (struct ceduo_control){.x = x, .x_given = x, .accepted = NAN, .measured_speed = NAN};
    return i;
}

static size_t class_of(const struct plan *p, double value)
{
    size_t c = 0;
    while (c < p->bounds_count && value > p->bounds[c])
        c++;
    return c;
}

/* Classes between a list's own quantiles, halfway between two values. Values are sorted. */
static void make_classes(struct plan *p)
{
    const struct ceduo_observation *seen = p->seen;
    size_t n = seen->n, k = n / 5 < CEDUO_CLASSES_MAX - 1 ? n / 5 : CEDUO_CLASSES_MAX - 1;
    k = k < 2 ? 2 : k;
    for (size_t c = 1; c < k; c++) {
        size_t rank = (c * n + k / 2) / k;
        double bound = rank == n ? seen->values[n - 1] : (seen->values[rank - 1] + seen->values[rank]) / 2;
        if (p->bounds_count == 0 || bound > p->bounds[p->bounds_count - 1])
            p->bounds[p->bounds_count++] = bound;
    }
    p->classes = p->bounds_count + 1;
    for (size_t i = 0; i < n; i++)
        p->counts[class_of(p, seen->values[i])]++;
    if (seen->kind == CEDUO_OBSERVED_STOPS && seen->released > 0)
        p->counts[p->classes++] = (double)(seen->released - n);
}

static bool make_plan(struct ceduo_observer *o, const struct ceduo_observation *seen, struct plan *p)
{
    struct setting *s = setting_of(o, seen, &p->setting);
    if (!s)
        return false;
    p->seen = seen;
    p->row = ceduo_observed_row(seen->kind);
    if (p->row->where == CEDUO_WHERE_AT_PLACE)
        p->control = control_of(s, seen->x);
    if (p->row->where == CEDUO_WHERE_ALONG) {
        p->stretch = s->stretches_count++;
        s->stretches[p->stretch] = (struct ceduo_stretch){seen->from, seen->to};
    }
    s->follows |= p->row->where >= CEDUO_WHERE_LARGEST;
    s->blows |= p->row->where == CEDUO_WHERE_ON_STEMS;
    if (seen->values) {
        make_classes(p);
    } else if (seen->kind == CEDUO_OBSERVED_PASSED) {
        p->classes = 2;
        p->counts[0] = (double)seen->count;
        p->counts[1] = (double)(seen->released - seen->count);
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

/* The rocks of one setting: a run, or a record. */
struct flown {
    const struct setting *setting;
    struct ceduo_scene scene;
    uint64_t rocks;
    struct ceduo_run *run;
    struct ceduo_record record;
};

static enum ceduo_status fly(const struct setting *s, const struct ceduo_scene *scene, uint64_t rocks,
                             const atomic_bool *cancel, struct flown *f)
{
    *f = (struct flown){.setting = s, .scene = *scene, .rocks = rocks};
    f->scene.rock = s->rock ? *s->rock : scene->rock;
    f->scene.blocks_count = 0; /* what is seen is seen of one rock */
    f->scene.release = s->release ? *s->release : scene->release;
    f->scene.controls_count = s->controls_count;
    f->scene.controls = s->controls;
    if (s->option >= scene->options_count || rocks == 0 || rocks > CEDUO_ROCKS_MAX)
        return CEDUO_BAD_ARGUMENT;
    const struct ceduo_option *option = &f->scene.options[s->option];
    bool bare = scene->simulation.contact_model == CEDUO_INDEX;
    enum ceduo_status status = ceduo_scene_check(&f->scene, NULL);
    if (status == CEDUO_OK && s->follows) {
        struct ceduo_record_def def = {.scene = &f->scene,
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
    def.rocks_most = rocks;
    def.cancel = cancel;
    status = status == CEDUO_OK ? ceduo_run_create(&def, &f->run) : status;
    return status == CEDUO_OK ? ceduo_run_extend(f->run, rocks) : status;
}

static void land(struct flown *f)
{
    ceduo_run_free(f->run);
    ceduo_record_release(&f->record);
}

/* The value of a rock that was followed; NaN: it has none. */
static double of_record(const struct flown *f, uint64_t rock, const struct plan *p)
{
    const struct ceduo_rock_record *r = &f->record.rocks[rock];
    const struct ceduo_stretch_means *m = &f->record.means[rock * f->setting->stretches_count + p->stretch];
    const struct ceduo_crossing *c = &f->record.crossings[rock * f->setting->controls_count + p->control];
    enum ceduo_quantity quantity = p->row->quantity;
    if (p->row->where == CEDUO_WHERE_AT_REST)
        return r->stop_x;
    if (p->row->where == CEDUO_WHERE_LARGEST)
        return quantity == CEDUO_QUANTITY_HEIGHT ? r->largest_height : r->largest_speed;
    if (p->row->where == CEDUO_WHERE_ALONG)
        return quantity == CEDUO_QUANTITY_HEIGHT ? m->height : quantity == CEDUO_QUANTITY_ENERGY ? m->energy : m->speed;
    if (!c->reached || quantity == CEDUO_QUANTITY_HEIGHT)
        return c->reached ? c->height : NAN;
    double speed2 = c->vx * c->vx + c->vz * c->vz;
    return quantity == CEDUO_QUANTITY_ENERGY ? (r->mass * speed2 + r->moment * (c->spin * c->spin)) / 2 : sqrt(speed2);
}

static bool on_stretch(const struct ceduo_stem_impact *b, const struct plan *p)
{
    return b->x >= p->seen->from && b->x <= p->seen->to;
}

/* The n values of one observation, which are the caller's to free; NULL without memory. */
static double *values_of(const struct flown *f, const struct plan *p, size_t *n)
{
    bool of_blows = p->row->where == CEDUO_WHERE_ON_STEMS;
    size_t all = of_blows ? f->record.blows_count : (size_t)f->rocks;
    enum ceduo_quantity quantity = p->row->quantity;
    double *values = malloc((all + 1) * sizeof *values);
    *n = of_blows || !values ? 0 : all;
    for (size_t i = 0; values && of_blows && i < all; i++)
        if (on_stretch(&f->record.blows[i], p))
            values[(*n)++] = f->record.blows[i].height;
    const double *samples = f->run ? ceduo_run_samples(f->run, p->control,
                                                       p->row->where == CEDUO_WHERE_AT_REST ? CEDUO_SAMPLE_STOP
                                                       : quantity == CEDUO_QUANTITY_HEIGHT  ? CEDUO_SAMPLE_HEIGHT
                                                       : quantity == CEDUO_QUANTITY_ENERGY  ? CEDUO_SAMPLE_ENERGY
                                                                                            : CEDUO_SAMPLE_SPEED)
                                   : NULL;
    for (size_t i = 0; i < *n && !of_blows; i++) {
        values[i] = samples ? samples[i] : of_record(f, i, p);
        if (p->row->where == CEDUO_WHERE_AT_REST && values[i] < p->seen->from)
            values[i] = NAN;
    }
    return values;
}

/* ---- comparing ---- */

/* Of simulated classes half a rock more in each than there are, so that none is impossible. Where few rocks do what was seen,
 * the classes do not get what the missing ones would bring. */
static double rocks_of_classes(const double *simulated, size_t classes)
{
    double rocks = 0;
    for (size_t i = 0; i < classes; i++)
        rocks += simulated[i];
    return fmax(rocks, CEDUO_CLASS_ROCKS_MIN * (double)classes) + (double)classes / 2;
}

double ceduo_classes_deviance(const double *seen, const double *simulated, size_t classes)
{
    double rocks = rocks_of_classes(simulated, classes), n = 0, deviance = 0;
    for (size_t i = 0; i < classes; i++)
        n += seen[i];
    for (size_t i = 0; i < classes; i++)
        if (seen[i] > 0)
            deviance += 2 * seen[i] * log(seen[i] * rocks / (n * (simulated[i] + 0.5)));
    return deviance;
}

/* A normal law of a difference. */
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
    bool rest = p->classes > p->bounds_count + 1; /* of a list that has no class for it none */
    for (size_t i = 0; i < n; i++) {
        if (!isnan(values[i]))
            ceduo_moments_add(&m, values[i]);
        if (!isnan(values[i]) && c->sample_count < CEDUO_SOME_VALUES)
            c->sample[c->sample_count++] = values[i];
        if (p->classes > 0 && !isnan(values[i]))
            c->count[p->seen->kind == CEDUO_OBSERVED_PASSED ? 0 : class_of(p, values[i])]++;
        else if (p->classes > 0 && rest)
            c->count[p->classes - 1]++;
    }
    c->rocks = rest ? (uint64_t)n : m.n;
    c->mean = m.n > 0 ? m.mean : NAN;
    c->sd = ceduo_moments_sd(&m);
}

/* How many scars the rocks released leave: their number differs from rock to rock, and the survey finds a share. */
static bool compare_scars(const struct plan *p, const struct flown *f, struct ceduo_observation_fit *c)
{
    const struct ceduo_observation *seen = p->seen;
    double share = isnan(seen->share_seen) ? 1 : seen->share_seen, of = (double)seen->released, n = (double)f->rocks;
    double *each = calloc((size_t)f->rocks + 1, sizeof *each);
    struct ceduo_moments m = {0};
    if (!each)
        return false;
    for (size_t i = 0; i < f->record.blows_count; i++)
        each[f->record.blows[i].rock] += on_stretch(&f->record.blows[i], p);
    for (uint64_t i = 0; i < f->rocks; i++)
        ceduo_moments_add(&m, each[i]);
    free(each);
    double variance = m.m2 / (n - 1); /* NaN of one rock */
    c->scars = of * m.mean * share;
    c->scars_variance = share * share * variance * of * (1 + of / n) + of * m.mean * share * (1 - share);
    compare_normal(c, (double)seen->n - c->scars, c->scars_variance);
    return true;
}

/* False without memory. */
static bool compare(const struct plan *p, const struct flown *f, const double *values, size_t n,
                    struct ceduo_observation_fit *c)
{
    const struct ceduo_observation *seen = p->seen;
    double sum = 0;
    for (size_t i = 0; seen->values && i < seen->n; i++)
        sum += seen->values[i];
    *c = (struct ceduo_observation_fit){.classes = p->classes,
                                        .observed_mean = seen->values ? sum / (double)seen->n : seen->mean,
                                        .scars = NAN,
                                        .scars_variance = NAN};
    memcpy(c->observed, p->counts, sizeof c->observed);
    sum_values(p, values, n, c);
    c->variance = seen->sd * seen->sd / (double)seen->n + c->sd * c->sd / (double)c->rocks;
    if (p->classes > 0) { /* a multinomial sample */
        double rocks = rocks_of_classes(c->count, c->classes), all = 0;
        for (size_t i = 0; i < c->classes; i++) {
            all += c->observed[i];
            c->log_likelihood += c->observed[i] * log((c->count[i] + 0.5) / rocks) - lgamma(c->observed[i] + 1);
        }
        c->log_likelihood += lgamma(all + 1);
        c->deviance += ceduo_classes_deviance(c->observed, c->count, c->classes);
    } else {
        compare_normal(c, c->observed_mean - c->mean, c->variance);
    }
    return seen->kind != CEDUO_OBSERVED_SCARS || seen->released == 0 || compare_scars(p, f, c);
}

enum ceduo_status ceduo_observer_simulate(const struct ceduo_observer *o, const struct ceduo_scene *scene, uint64_t rocks,
                                          const atomic_bool *cancel, struct ceduo_observation_fit *to)
{
    enum ceduo_status status = CEDUO_OK;
    for (size_t s = 0; s < o->settings_count && status == CEDUO_OK; s++) {
        struct flown f;
        status = fly(&o->settings[s], scene, rocks, cancel, &f);
        for (size_t i = 0; i < o->n && status == CEDUO_OK; i++) {
            const struct plan *p = &o->plans[i];
            if (p->setting != s)
                continue;
            size_t n;
            double *values = values_of(&f, p, &n);
            bool good = values && compare(p, &f, values, n, &to[i]);
            free(values);
            status = !good ? CEDUO_NO_MEMORY : ceduo_cancelled(cancel) ? CEDUO_CANCELLED : CEDUO_OK; /* untaken: race */
        }
        land(&f);
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
    struct flown f;
    enum ceduo_status status = fly(&o->settings[p->setting], scene, rocks, NULL, &f);
    if (status == CEDUO_OK)
        *values = values_of(&f, p, n);
    land(&f);
    return status == CEDUO_OK && !*values ? CEDUO_NO_MEMORY : status;
}
