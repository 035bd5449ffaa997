/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene is computed at points of what may be true (points.c). At each point the goal is that of the worst control; over a
 * rotation shares of the rocks are means over the years, and what hangs on the index alone is that of the worst year. */
#include "sure.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/gsl_errors.h"
#include "ceduo/assess.h"
#include "points.h"

#define GROUPS CEDUO_SURFACE_GROUPS

struct sure {
    const struct reliability_def *def;
    size_t slots; /* of each point and control: today, or years */
    struct ceduo_replicates *values;
};

static struct ceduo_replicates *values_of(const struct sure *s, size_t row, size_t control)
{
    return s->values + (row * s->def->uncertainty.scene->controls_count + control) * s->slots;
}

/* An ADC has no end where nothing stands; its inverse has. The other goals are as they are. */
static double scaled(enum ceduo_goal goal, double value)
{
    return goal == CEDUO_GOAL_ADC ? -1 / value : value;
}

/* The mean energy of what arrives, in kJ, of all the groups' rocks; groups differ by what they bring to that mean. By the index it is
 * what this leaves of the mean. */
static struct ceduo_replicates energy_of(const struct point *point, const struct ceduo_control *control,
                                         const struct ceduo_group_means *briefs)
{
    struct ceduo_replicates y = {{0}};
    double reach = 0, energy = 0;
    for (size_t g = 0; g < GROUPS; g++) {
        reach += briefs[g].reach_probability / GROUPS;
        energy += briefs[g].energy_per_released / GROUPS;
    }
    double mean = energy / reach, left = mean; /* NaN where none arrives */
    if (point->scene->simulation.contact_model == CEDUO_INDEX)
        left = ceduo_assess_index(point->scene, point->forest, control, mean).residual;
    for (size_t g = 0; g < GROUPS && left > 0; g++)
        y.value[g] = (left + (briefs[g].energy_per_released - mean * briefs[g].reach_probability) / reach) * 1e-3;
    return y;
}

/* The goal at a control. */
static struct ceduo_replicates value_of(enum ceduo_goal goal, const struct point *point, const struct ceduo_control *at,
                                        const struct ceduo_group_means *briefs)
{
    struct ceduo_replicates y;
    if (goal == CEDUO_GOAL_ENERGY)
        return energy_of(point, at, briefs);
    struct ceduo_index index = {0};
    if (!briefs)
        index = ceduo_assess_index(point->scene, point->forest, at, NAN);
    for (size_t g = 0; g < GROUPS; g++)
        y.value[g] = goal == CEDUO_GOAL_ADC            ? scaled(goal, index.worst_adc)
                     : goal == CEDUO_GOAL_FREE_RUN     ? index.worst_free_run
                     : ceduo_goal_needs_accepted(goal) ? briefs[g].exceed_probability
                                                       : briefs[g].reach_probability;
    return y;
}

static void read_point(void *context, const struct point *point, const struct control_means *at)
{
    const struct sure *s = context;
    for (size_t c = 0; c < s->def->uncertainty.scene->controls_count; c++)
        values_of(s, point->row, c)[point->slot > 0 ? point->slot - 1 : 0] =
            value_of(s->def->goal, point, &point->scene->controls[c], at ? at[c].group : NULL);
}

static double mean_of(const struct ceduo_replicates *y)
{
    double mean = 0;
    for (size_t g = 0; g < GROUPS; g++)
        mean += y->value[g] / GROUPS;
    return mean;
}

/* The mean of the years, or the worst of them, for a goal without noise of the rocks. */
static struct ceduo_replicates over_years(const struct sure *s, const struct ceduo_replicates *years)
{
    struct ceduo_replicates y = years[0];
    for (size_t k = 1; k < s->slots && !ceduo_goal_is_mean(s->def->goal); k++)
        y = mean_of(&years[k]) > mean_of(&y) ? years[k] : y;
    for (size_t g = 0; g < GROUPS && ceduo_goal_is_mean(s->def->goal); g++) {
        y.value[g] = 0;
        for (size_t k = 0; k < s->slots; k++)
            y.value[g] += years[k].value[g] / (double)s->slots;
    }
    return y;
}

/* Shares of few rocks in the worst year. The largest of many noisy shares is too large, so that each year is read from its
 * surface, as far as there is one. `y`: the control at all points. */
static enum ceduo_status read_worst(const struct sure *s, struct ceduo_surface *surface, size_t points, size_t control,
                                    struct ceduo_replicates *y)
{
    size_t n = s->slots * points;
    struct ceduo_replicates *years = malloc(2 * n * sizeof *years), *changes = years + n;
    double *values = malloc(n * sizeof *values);
    enum ceduo_status status = years && values ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; status == CEDUO_OK && i < n; i++)
        years[i] = values_of(s, i % points, control)[i / points];
    const struct ceduo_surface_figure figure = {.y = years, .hi = 1, .limit = NAN};
    if (status == CEDUO_OK)
        status = ceduo_surface_values(surface, &figure, s->slots, values, changes);
    for (size_t p = 0; status == CEDUO_OK && p < points; p++) {
        size_t worst = p;
        for (size_t i = p; i < n; i += points)
            worst = values[i] > values[worst] ? i : worst;
        ceduo_replicates_from_half_samples(&y[p], values[worst], changes[worst].value);
    }
    free(years);
    free(values);
    return status;
}

/* Sets the goal at the worst control of each point. `surface` NULL: there is one point. */
static enum ceduo_status fill_column(const struct sure *s, struct ceduo_surface *surface, size_t points,
                                     struct ceduo_replicates *column)
{
    bool worst = surface && s->slots > 1 && ceduo_goal_is_worst(s->def->goal);
    struct ceduo_replicates *y = malloc(points * sizeof *y);
    enum ceduo_status status = y ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t c = 0; c < s->def->uncertainty.scene->controls_count && status == CEDUO_OK; c++) {
        for (size_t p = 0; p < points && !worst; p++)
            y[p] = over_years(s, values_of(s, p, c));
        if (worst)
            status = read_worst(s, surface, points, c, y);
        for (size_t p = 0; p < points && status == CEDUO_OK; p++)
            if (c == 0 || mean_of(&y[p]) > mean_of(&column[p]))
                column[p] = y[p];
    }
    free(y);
    return status;
}

static double quantile_above(const struct ceduo_surface_fit *fit, size_t points, double share, double limit)
{
    return ceduo_quantile(fit->values, points, fmin(1, fmax(0, share))) - limit;
}

/* What the values of a surface say. */
static enum ceduo_status read_surface(const struct reliability_def *def, struct ceduo_surface *surface, size_t points,
                                      const struct ceduo_replicates *column, struct reliability_result *answer)
{
    struct ceduo_surface_fit fit = {0};
    bool inverse = def->goal == CEDUO_GOAL_ADC; /* below 0, as nothing else is */
    const struct ceduo_surface_figure figure = {.y = column,
                                                .lo = inverse ? -INFINITY : 0,
                                                .hi = inverse                          ? 0
                                                      : ceduo_goal_is_share(def->goal) ? 1
                                                                                       : INFINITY,
                                                .limit = scaled(def->goal, def->target)};
    enum ceduo_status status = ceduo_surface_fit(surface, &figure, &fit);
    if (status == CEDUO_OK) {
        double half =
            fmax(CEDUO_Z95 * fit.share_below.se, 2 / (double)points); /* a share and its quantile have steps of a point */
        gsl_sort(fit.values, 1, points);
        *answer = (struct reliability_result){fit.share_below, quantile_above(&fit, points, def->sure, figure.limit),
                                              quantile_above(&fit, points, def->sure - half, figure.limit),
                                              quantile_above(&fit, points, def->sure + half, figure.limit)};
    }
    ceduo_surface_release(&fit);
    return status;
}

enum ceduo_status ceduo_reliability_compute(const struct reliability_def *def, struct reliability_result *answer)
{
    GSL_RETURNS_ERRORS;
    struct ceduo_uncertainty_def of = def->uncertainty;
    const struct ceduo_scene *scene = of.scene;
    size_t points = of.inputs_count > 0 ? of.points : 1, n = of.inputs_count;
    struct sure s = {.def = def, .slots = 1};
    if (of.rotation)
        s.slots = ceduo_points_years(&of);
    of.alone = true;
    of.rocks = !ceduo_goals[def->goal].needs_rocks ? 0 : of.rocks > GROUPS ? of.rocks : GROUPS;
    double *u = malloc((points * n + 1) * sizeof *u);
    struct ceduo_replicates *column = malloc(points * sizeof *column);
    struct ceduo_surface *surface = NULL;
    s.values = malloc(points * scene->controls_count * s.slots * sizeof *s.values + 1);
    enum ceduo_status status = u && column && s.values ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK && n > 0)
        status = ceduo_surface_points(scene->simulation.seed, points, n, u);
    if (status == CEDUO_OK)
        status = ceduo_points_run(
            &(const struct points){.def = &of, .u = u, .today = !of.rotation, .read = read_point, .context = &s}, 0, points, 0);
    if (status == CEDUO_OK && n > 0)
        status = ceduo_surface_open(of.inputs, n, u, points, &surface);
    if (status == CEDUO_OK)
        status = fill_column(&s, surface, points, column);
    if (status == CEDUO_OK && n > 0) {
        status = read_surface(def, surface, points, column, answer);
    } else if (status == CEDUO_OK) {
        double above = mean_of(column) - scaled(def->goal, def->target);
        *answer = (struct reliability_result){{above <= 0, 0}, above, above, above};
    }
    ceduo_surface_free(surface);
    free(u);
    free(column);
    free(s.values);
    return status;
}
