/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the effort of an uncertainty analysis. Contacts and stems of a rock are estimated by a pilot: a few points of a few
 * rocks. All other parts follow from the scene. Their weights were measured. */
#include "effort.h"
#include "surface.h"

#include <math.h>
#include <stdlib.h>

#include "base/parallel.h"
#include "points.h"

#define PER_ROCK    24.      /* start and read a rock */
#define PER_RUN     3300.    /* prepare a forest */
#define PER_VERTEX  15.      /* prepare a vertex of the simplified profile, per run */
#define PER_POINT   .7       /* simplify a point of the profile of the file, per run */
#define PER_PASS    .17      /* roll past a vertex, per rock */
#define PER_FIT     6e5      /* fit a figure at CEDUO_UNCERTAINTY_POINTS points */
#define FITS        3        /* figures of an option today */
#define FITS_YEARS  2        /* figures of its rotation; and half of one per year */
#define PLANNED     (2. / 3) /* share of the bound; later points may need more than the pilot */
#define PILOT       8        /* points */
#define PILOT_YEARS 4        /* several, as the number of stems changes over a rotation */
#define ROCKS_MIN   100      /* per point, unless fewer are requested */
#define YEARS_MIN   8

double ceduo_effort_compute(const struct ceduo_scene *scene, const struct ceduo_work *work)
{
    double vertices = (double)scene->slope.vertices, rocks = (double)work->rocks, runs = (double)work->runs;
    return (double)ceduo_points_met(work->contacts, work->stems) + rocks * (PER_ROCK + PER_PASS * vertices) +
           runs * (PER_RUN + PER_VERTEX * vertices + PER_POINT * (double)scene->slope.points);
}

struct plan {
    const struct ceduo_uncertainty_def *def;
    double met, max; /* contacts and stems of one rock of each option in all runs of a point; the bound */
};

static double estimate_effort(const struct plan *plan, double met)
{
    const struct ceduo_uncertainty_def *def = plan->def;
    double options = (double)def->scene->options_count, years = def->rotation ? options * (double)ceduo_points_years(def) : 0;
    double rocks = options * (double)def->rocks + years * CEDUO_UNCERTAINTY_YEAR_ROCKS, points = (double)def->points;
    struct ceduo_work work = {.rocks = (uint64_t)(points * rocks), .runs = (uint64_t)(points * (options + years))};
    double fits =
        options * FITS + (def->rotation ? options * FITS_YEARS + years / 2 : 0) + (def->rotation ? 2 : 1) * (options - 1);
    return points * rocks * met / options + ceduo_effort_compute(def->scene, &work) +
           fits * PER_FIT * pow(points / CEDUO_UNCERTAINTY_POINTS, 2);
}

/* Set the number of points that the bound allows, at most `points`. */
static size_t reduce_points(const struct plan *plan, struct ceduo_uncertainty_def *def, size_t points)
{
    def->points = points;
    while (def->points > 0 && estimate_effort(plan, plan->met) > PLANNED * plan->max)
        def->points--;
    return def->points;
}

/* Reduce points to a quarter of `points`, then rocks and points equally, then years, then points alone. From about 64 points
 * on the sampling error of the rocks dominates the error of a range. Return false if too few points remain. */
static bool reduce(const struct plan *plan, struct ceduo_uncertainty_def *def, size_t points, uint64_t rocks)
{
    uint64_t rocks_min = rocks < ROCKS_MIN ? rocks : ROCKS_MIN;
    size_t points_min = points / 4;
    def->years_max = 0;
    for (def->rocks = rocks; reduce_points(plan, def, points) < points_min && def->rocks > rocks_min; points_min /= 2)
        def->rocks = def->rocks / 2 > rocks_min ? def->rocks / 2 : rocks_min;
    if (def->points < points / 4 && def->rotation) {
        def->years_max = YEARS_MIN;
        reduce_points(plan, def, points);
    }
    return def->points >= CEDUO_UNCERTAINTY_MIN;
}

/* Set the mean of plan->met over a few points. */
static enum ceduo_status run_pilot(const struct ceduo_uncertainty_def *def, struct plan *plan)
{
    struct ceduo_uncertainty_def pilot = *def;
    uint64_t effort = 0;
    double *u = malloc(PILOT * def->inputs_count * sizeof *u + 1);
    pilot.rocks = CEDUO_SURFACE_GROUPS;
    pilot.years_max = PILOT_YEARS;
    pilot.one_option = false;
    double rocks =
        (double)pilot.rocks + (pilot.rotation ? (double)(ceduo_points_years(&pilot) * CEDUO_UNCERTAINTY_YEAR_ROCKS) : 0);
    pilot.effort_max = (uint64_t)((1 - PLANNED) * plan->max);
    enum ceduo_status status = CEDUO_NO_MEMORY;
    if (u) /* untaken: memory */
        status = ceduo_surface_points(def->scene->simulation.seed, PILOT, def->inputs_count, u);
    if (status == CEDUO_OK) /* untaken: memory */
        status = ceduo_points_run(&(const struct points){.def = &pilot, .u = u, .today = true, .effort = &effort}, 0, PILOT, 0);
    plan->met = (double)effort / (PILOT * rocks);
    free(u);
    return status;
}

enum ceduo_status ceduo_effort_bound(struct ceduo_uncertainty_def *def, const struct ceduo_work *own)
{
    size_t points = def->points;
    uint64_t rocks = def->rocks > CEDUO_SURFACE_GROUPS ? def->rocks : CEDUO_SURFACE_GROUPS;
    double own_effort = own ? ceduo_effort_compute(def->scene, own) : INFINITY;
    struct plan plan = {.def = def, .max = fmin(CEDUO_EFFORT_MAX, fmax(CEDUO_EFFORT_MIN, CEDUO_EFFORT_TIMES * own_effort))};
    enum ceduo_status status = run_pilot(def, &plan);
    bool too_much = status == CEDUO_CANCELLED && !ceduo_cancelled(def->cancel);
    if (status != CEDUO_OK && !too_much)
        return status;
    bool enough = !too_much && reduce(&plan, def, points, rocks);
    if (!enough && !too_much && def->rotation) {
        def->rotation = false;
        enough = reduce(&plan, def, points, rocks);
    }
    def->points = def->points_max = enough ? def->points : 0;
    def->effort_max = (uint64_t)(plan.max - estimate_effort(&plan, 0));
    return CEDUO_OK;
}
