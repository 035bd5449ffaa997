/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>

#include "fence.h"
#include "run.h"
#include "run_state.h"
#include "scene/derived.h"
#include "scene/slope.h"

#define SERVICE (1 / 3.0) /* service energy level (SEL) over maximum energy level (MEL) of a class */

/* A rock at a fence. */
struct passing {
    double speed, energy, top, middle, weight;
};

/* Return the cosine of the inclination of the ground that ends at x. */
static double cosine_before(const struct ceduo_slope *s, double x)
{
    size_t j = ceduo_slope_segment(s, x);
    if (j > 0 && s->x[j] >= x)
        j--;
    return (s->x[j + 1] - s->x[j]) / hypot(s->x[j + 1] - s->x[j], s->z[j + 1] - s->z[j]);
}

/* Samples of a control. */
struct samples {
    const struct ceduo_run *run;
    const double *speed, *height, *energy;
    double cosine;
    bool varies; /* rocks differ in size */
};

static struct samples find_samples(const struct ceduo_run *run, size_t control, double x)
{
    return (struct samples){.run = run,
                            .speed = get_samples(run, control, SPEED),
                            .height = get_samples(run, control, HEIGHT),
                            .energy = get_samples(run, control, run->quantities == QUANTITIES ? TRANSLATION : ENERGY),
                            .cosine = cosine_before(&run->prepared.scene.slope, x),
                            .varies = ceduo_scene_rock_varies(&run->prepared.scene)};
}

/* Read a rock. False if it does not arrive. */
static bool read_passing(const struct samples *s, uint64_t rock_number, struct passing *p)
{
    struct ceduo_rock rock = s->run->prepared.mean;
    if (isnan(s->speed[rock_number]))
        return false;
    if (s->varies) /* was drawn for the run, so it can be drawn again */
        ceduo_prepared_rock(&s->run->prepared, rock_number, &rock);
    double underside = s->height[rock_number] * s->cosine, diameter = rock.mean_diameter;
    *p = (struct passing){.speed = s->speed[rock_number],
                          .energy = s->energy[rock_number],
                          .top = underside + diameter,
                          .middle = underside + diameter / 2,
                          .weight = get_weight(s->run, rock_number)};
    return true;
}

void ceduo_run_group_defeats(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_group_means *briefs)
{
    const struct ceduo_control *place = &run->prepared.scene.controls[control];
    const struct samples samples = find_samples(run, control, place->x);
    for (size_t g = 0; g < groups; g++) {
        double total = 0, defeated = 0;
        struct passing p;
        for (uint64_t r = run->rocks * g / groups; r < run->rocks * (g + 1) / groups; r++) {
            total += get_weight(run, r);
            if (read_passing(&samples, r, &p) && (p.top > place->fence.height || p.energy > place->fence.energy))
                defeated += p.weight;
        }
        briefs[g].defeated_probability = defeated / total;
    }
}

/* ---- shares ---- */

static struct ceduo_estimate estimate_share(const struct ceduo_run *run, const struct weight_totals *totals,
                                            uint64_t unfinished, const struct weighted_sum *sum)
{
    return run->weighted ? ceduo_weighted_share(totals, sum, -1) : ceduo_run_share((uint64_t)sum->t, unfinished, run->rocks);
}

static void add_sum(struct weighted_sum *to, const struct weighted_sum *sum)
{
    to->t += sum->t;
    to->tt += sum->tt;
    to->tw += sum->tw;
}

static void read_shares(const struct ceduo_run *run, const struct ceduo_scene *scene, size_t control, const struct passing *p,
                        size_t n, struct ceduo_fence_arrivals *f)
{
    const struct ceduo_fence *fence = &scene->controls[control].fence;
    const struct sums s = ceduo_run_sums_at(run, control);
    struct weight_totals totals = {.n = (double)run->rocks, .w = (double)run->rocks, .ww = (double)run->rocks};
    if (run->weighted)
        totals = ceduo_run_weight_totals(run, s.end_weights[CEDUO_END_UNFINISHED]);
    struct weighted_sum above = {0}, through = {0}, both = {0}, defeated = {0}, worn = {0};
    struct weighted_sum cells[CEDUO_FENCE_HEIGHTS + 1][CEDUO_FENCE_CLASSES] = {{{0}}}; /* by lowest height and needed class */
    double held[CEDUO_FENCE_CLASSES] = {0}, higher = 0;                                /* by the height of the fence */
    for (size_t r = 0; r < n; r++) {
        bool is_above = p[r].top > fence->height, is_through = p[r].energy > fence->energy;
        int needed = ceduo_fence_class(p[r].energy);
        size_t h = (size_t)fmin(CEDUO_FENCE_HEIGHTS, fmax(0, ceil(p[r].top) - CEDUO_FENCE_LOWEST));
        weighted_sum_add(&above, p[r].weight, is_above);
        weighted_sum_add(&through, p[r].weight, is_through);
        weighted_sum_add(&both, p[r].weight, is_above && is_through);
        weighted_sum_add(&defeated, p[r].weight, is_above || is_through);
        weighted_sum_add(&worn, p[r].weight, !is_above && !is_through && p[r].energy > SERVICE * fence->energy);
        weighted_sum_add(&cells[h][needed], p[r].weight, 1);
        *(is_above ? &higher : &held[needed]) += p[r].weight;
        for (; h < CEDUO_FENCE_HEIGHTS; h++)
            f->grid.energy[h] = fmax(f->grid.energy[h], p[r].energy);
    }
    const struct weighted_sum *const sums[] = {&above, &through, &both, &defeated, &worn};
    struct ceduo_estimate *const to[] = {&f->above, &f->through, &f->both, &f->defeated, &f->worn};
    for (size_t i = 0; i < 5; i++)
        *to[i] = estimate_share(run, &totals, s.end_counts[CEDUO_END_UNFINISHED], sums[i]);
    struct weighted_sum highest = {0};
    for (size_t h = CEDUO_FENCE_HEIGHTS; h-- > 0;) { /* rocks above the height, and those below that need a larger class */
        for (size_t i = 0; i < CEDUO_FENCE_CLASSES; i++)
            add_sum(&highest, &cells[h + 1][i]);
        struct weighted_sum all = highest;
        for (size_t i = CEDUO_FENCE_CLASSES; i-- > 0;) {
            f->grid.defeated[h][i] = estimate_share(run, &totals, s.end_counts[CEDUO_END_UNFINISHED], &all);
            for (size_t k = 0; k <= h; k++)
                add_sum(&all, &cells[k][i]);
        }
    }
    for (size_t i = CEDUO_FENCE_CLASSES; i-- > 0; higher += held[i])
        f->by_class[i] = higher / totals.w;
    ceduo_fence_choose(&f->grid, ceduo_exceed_limit(scene, &scene->controls[control]), f->enough);
    if (!run->weighted)
        return;
    f->per_year = totals.per_year * f->defeated.mean;
    f->in_life = -expm1(-f->per_year * ceduo_fence_life(fence));
}

/* ---- loads ---- */

/* Set the 95th percentiles: of the rocks that arrive, and together with `stopped` rocks that the forest stops. */
static void read_loads(const struct passing *p, size_t n, double stopped, struct weighted *scratch,
                       struct ceduo_fence_arrivals *f)
{
    static const size_t members[] = {offsetof(struct passing, speed), offsetof(struct passing, energy),
                                     offsetof(struct passing, top), offsetof(struct passing, middle)};
    double *const arriving[] = {&f->arriving.speed, &f->arriving.energy, &f->arriving.top, &f->arriving.middle};
    double *const system[] = {&f->system.speed, &f->system.energy, &f->system.top, &f->system.middle};
    for (size_t i = 0; i < sizeof members / sizeof members[0]; i++) {
        scratch[0] = (struct weighted){0, stopped};
        for (size_t r = 0; r < n; r++)
            scratch[r + 1] = (struct weighted){*(const double *)(const void *)((const char *)&p[r] + members[i]), p[r].weight};
        ceduo_weighted_sort(scratch + 1, n);
        *arriving[i] = ceduo_weighted_quantile(scratch + 1, n, 0.95);
        *system[i] = stopped + (double)n > 0 ? ceduo_weighted_quantile(scratch, n + 1, 0.95) : NAN;
    }
}

enum ceduo_status ceduo_run_fence(const struct ceduo_run *run, const struct ceduo_scene *scene, size_t control,
                                  const struct ceduo_arrivals *bare, struct ceduo_fence_arrivals *f)
{
    *f = ceduo_fence_none();
    if (control >= run->controls || control >= scene->controls_count)
        return CEDUO_BAD_ARGUMENT;
    bool stands = ceduo_fence_stands(&scene->controls[control].fence), designed = ceduo_design_is_requested(&scene->design);
    if (run->rocks == 0 || (!stands && !designed))
        return CEDUO_OK;
    struct passing *p = calloc((size_t)run->rocks + 1, sizeof *p);
    struct weighted *scratch = designed ? malloc(((size_t)run->rocks + 2) * sizeof *scratch) : NULL;
    bool good = p && (scratch || !designed);
    if (good) {
        const struct samples samples = find_samples(run, control, scene->controls[control].x);
        double arrive = 0, all = 0;
        size_t n = 0;
        for (uint64_t r = 0; r < run->rocks; r++) {
            all += get_weight(run, r);
            if (read_passing(&samples, r, &p[n]))
                arrive += p[n++].weight;
        }
        if (stands)
            read_shares(run, scene, control, p, n, f);
        if (designed)
            read_loads(p, n, bare && !isnan(bare->reach.mean) ? fmax(0, all * bare->reach.mean - arrive) : 0, scratch, f);
    }
    free(p);
    free(scratch);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}
