/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the probability of reaching a goal under uncertain inputs, from plausible scenes (points.c). The goal of a scene
 * is that of its worst control. Over a rotation shares of rocks are means over the years; other goals are those of the worst
 * year. */
#include "reliability.h"
#include "core/runs/assess.h"
#include "core/runs/statistics.h"
#include "surface.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/gsl_errors.h"
#include "points.h"

#define GROUPS CEDUO_SURFACE_GROUPS

struct reliability {
    const struct reliability_def *def;
    size_t slots;                    /* per point and control: 1 for today, or the years */
    struct ceduo_replicates *values; /* [point][control][slot] */
};

static struct ceduo_replicates *find_values(const struct reliability *s, size_t row, size_t control)
{
    return s->values + (row * s->def->uncertainty.scene->controls_count + control) * s->slots;
}

/* Return the negative reciprocal of an ADC, which is finite without stems; other goals unchanged. */
static double transform(enum ceduo_goal goal, double value)
{
    return goal == CEDUO_GOAL_ADC ? -1 / value : value;
}

/* Return the mean energy of arriving rocks, kJ, as linearized replicates: each group has the common mean plus its
 * contribution to it. With contact_model: index the mean is the energy left by the index. */
static struct ceduo_replicates compute_energy(const struct point *point, const struct ceduo_control *control,
                                              const struct ceduo_group_means *means)
{
    struct ceduo_replicates y = {{0}};
    double reach = 0, energy = 0;
    for (size_t g = 0; g < GROUPS; g++) {
        reach += means[g].reach_probability / GROUPS;
        energy += means[g].energy_per_released / GROUPS;
    }
    double mean = energy / reach, residual = mean; /* NaN: no rock arrives */
    if (point->scene->simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX)
        residual = ceduo_assess_index(point->scene, point->forest, control, mean).residual;
    for (size_t g = 0; g < GROUPS && residual > 0; g++)
        y.value[g] = (residual + (means[g].energy_per_released - mean * means[g].reach_probability) / reach) * 1e-3;
    return y;
}

/* Return the goal at a control. */
static struct ceduo_replicates compute_goal(enum ceduo_goal goal, const struct point *point,
                                            const struct ceduo_control *control, const struct ceduo_group_means *means)
{
    struct ceduo_replicates y;
    if (goal == CEDUO_GOAL_ENERGY)
        return compute_energy(point, control, means);
    struct ceduo_index index = {0};
    if (!means)
        index = ceduo_assess_index(point->scene, point->forest, control, NAN);
    for (size_t g = 0; g < GROUPS; g++)
        y.value[g] = goal == CEDUO_GOAL_ADC            ? transform(goal, index.worst_adc)
                     : goal == CEDUO_GOAL_FREE_RUN     ? index.worst_free_run
                     : ceduo_goal_needs_accepted(goal) ? means[g].exceed_probability
                                                       : means[g].reach_probability;
    return y;
}

static void read_point(void *context, const struct point *point, const struct control_means *means)
{
    const struct reliability *s = context;
    for (size_t c = 0; c < s->def->uncertainty.scene->controls_count; c++)
        find_values(s, point->row, c)[point->slot > 0 ? point->slot - 1 : 0] =
            compute_goal(s->def->goal, point, &point->scene->controls[c], means ? means[c].group : NULL);
}

static double replicates_mean(const struct ceduo_replicates *y)
{
    double mean = 0;
    for (size_t g = 0; g < GROUPS; g++)
        mean += y->value[g] / GROUPS;
    return mean;
}

/* Return the mean of the years, or the worst year if the goal has no sampling noise. */
static struct ceduo_replicates combine_years(const struct reliability *s, const struct ceduo_replicates *years)
{
    struct ceduo_replicates y = years[0];
    for (size_t k = 1; k < s->slots && !ceduo_goal_is_mean(s->def->goal); k++)
        y = replicates_mean(&years[k]) > replicates_mean(&y) ? years[k] : y;
    for (size_t g = 0; g < GROUPS && ceduo_goal_is_mean(s->def->goal); g++) {
        y.value[g] = 0;
        for (size_t k = 0; k < s->slots; k++)
            y.value[g] += years[k].value[g] / (double)s->slots;
    }
    return y;
}

/* Set the share in the worst year at each point. The maximum of noisy shares is biased upward, so the shares are read from
 * the surfaces of the years. */
static enum ceduo_status read_worst(const struct reliability *s, struct ceduo_surface *surface, size_t points, size_t control,
                                    struct ceduo_replicates *y)
{
    size_t n = s->slots * points;
    struct ceduo_replicates *years = malloc(2 * n * sizeof *years), *changes = years + n;
    double *values = malloc(n * sizeof *values);
    enum ceduo_status status = years && values ? CEDUO_OK : CEDUO_NO_MEMORY; /* untaken 2: memory */
    for (size_t i = 0; status == CEDUO_OK && i < n; i++)                     /* untaken: memory */
        years[i] = find_values(s, i % points, control)[i / points];
    const struct ceduo_surface_figure figure = {.y = years, .hi = 1, .limit = NAN};
    if (status == CEDUO_OK) /* untaken: memory */
        status = ceduo_surface_values(surface, &figure, s->slots, values, changes);
    for (size_t p = 0; status == CEDUO_OK && p < points; p++) { /* untaken: memory */
        size_t worst = p;
        for (size_t i = p; i < n; i += points)
            worst = values[i] > values[worst] ? i : worst;
        ceduo_replicates_from_half_samples(&y[p], values[worst], changes[worst].value);
    }
    free(years);
    free(values);
    return status;
}

/* Set the goal at the worst control of each point. `surface` NULL: there is one point. */
static enum ceduo_status fill_column(const struct reliability *s, struct ceduo_surface *surface, size_t points,
                                     struct ceduo_replicates *column)
{
    bool worst = surface && s->slots > 1 && ceduo_goal_is_worst(s->def->goal);
    struct ceduo_replicates *y = malloc(points * sizeof *y);
    enum ceduo_status status = y ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t c = 0; c < s->def->uncertainty.scene->controls_count && status == CEDUO_OK; c++) {
        for (size_t p = 0; p < points && !worst; p++)
            y[p] = combine_years(s, find_values(s, p, c));
        if (worst)
            status = read_worst(s, surface, points, c, y);
        for (size_t p = 0; p < points && status == CEDUO_OK; p++) /* untaken: memory */
            if (c == 0 || replicates_mean(&y[p]) > replicates_mean(&column[p]))
                column[p] = y[p];
    }
    free(y);
    return status;
}

static double quantile_above(const struct ceduo_surface_fit *fit, size_t points, double share, double limit)
{
    return ceduo_quantile(fit->values, points, fmin(1, fmax(0, share))) - limit;
}

/* Set the share and the quantile from a surface through the goal. */
static enum ceduo_status read_surface(const struct reliability_def *def, struct ceduo_surface *surface, size_t points,
                                      const struct ceduo_replicates *column, struct reliability_result *answer)
{
    struct ceduo_surface_fit fit = {0};
    bool inverse = def->goal == CEDUO_GOAL_ADC; /* then values are negative */
    const struct ceduo_surface_figure figure = {.y = column,
                                                .lo = inverse ? -INFINITY : 0,
                                                .hi = inverse                          ? 0
                                                      : ceduo_goal_is_share(def->goal) ? 1
                                                                                       : INFINITY,
                                                .limit = transform(def->goal, def->target)};
    enum ceduo_status status = ceduo_surface_fit(surface, &figure, &fit);
    if (status == CEDUO_OK) {
        double half =
            fmax(CEDUO_Z95 * fit.share_below.se, 2 / (double)points); /* at least two points: the resolution of a quantile */
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
    struct ceduo_uncertainty_def one_option_def = def->uncertainty;
    const struct ceduo_scene *scene = one_option_def.scene;
    size_t points = one_option_def.inputs_count > 0 ? one_option_def.points : 1, n = one_option_def.inputs_count;
    struct reliability s = {.def = def, .slots = 1};
    if (one_option_def.rotation)
        s.slots = ceduo_points_years(&one_option_def);
    one_option_def.one_option = true;
    one_option_def.rocks = !ceduo_goals[def->goal].needs_rocks ? 0
                           : one_option_def.rocks > GROUPS     ? one_option_def.rocks
                                                               : GROUPS;
    double *u = malloc((points * n + 1) * sizeof *u);
    struct ceduo_replicates *column = malloc(points * sizeof *column);
    struct ceduo_surface *surface = NULL;
    s.values = malloc(points * scene->controls_count * s.slots * sizeof *s.values + 1);
    enum ceduo_status status = u && column && s.values ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK && n > 0)
        status = ceduo_surface_points(scene->simulation.seed, points, n, u);
    if (status == CEDUO_OK)
        status = ceduo_points_run(
            &(const struct points){
                .def = &one_option_def, .u = u, .today = !one_option_def.rotation, .read = read_point, .context = &s},
            0, points, 0);
    if (status == CEDUO_OK && n > 0)
        status = ceduo_surface_open(one_option_def.inputs, n, u, points, &surface);
    if (status == CEDUO_OK)
        status = fill_column(&s, surface, points, column);
    if (status == CEDUO_OK && n > 0) {
        status = read_surface(def, surface, points, column, answer);
    } else if (status == CEDUO_OK) {
        double above = replicates_mean(column) - transform(def->goal, def->target);
        *answer = (struct reliability_result){{above <= 0, 0}, above, above, above};
    }
    ceduo_surface_free(surface);
    free(u);
    free(column);
    free(s.values);
    return status;
}
