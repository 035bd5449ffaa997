/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POINTS_H
#define CEDUO_POINTS_H

#include <stdatomic.h>

#include "ceduo/uncertainty.h"
#include "core/runs/run.h"

/* Simulates plausible scenes. Each row of input quantiles is a scene; its options are simulated today and year by year. The
 * result does not depend on the number of threads. */

/* An option in a row; slot 0: today; slots 1…: its years. */
struct point {
    size_t row, option, slot;
    const struct ceduo_scene *scene;
    const struct ceduo_option *forest; /* the option, or its forest in that year */
};

/* Means of each group of the rocks at a control. */
struct control_means {
    struct ceduo_group_means group[CEDUO_SURFACE_GROUPS];
};

struct points {
    /* Scene, inputs, options, years and rocks; 0 rocks: nothing is simulated. With `rotation` each option has
     * ceduo_points_years() slots for years. */
    const struct ceduo_uncertainty_def *def;
    const double *u; /* rows of input quantiles, 0…1 */
    bool today;      /* include slot 0 */
    /* Read a point. `means`: one for each control; NULL: no rocks are simulated. Called by several threads at once, each
     * with its own rows. May be NULL. */
    void (*read)(void *context, const struct point *point, const struct control_means *means);
    void (*done)(void *context); /* called after each row, by several threads at once; may be NULL */
    void *context;
    uint64_t *effort; /* set to the sum of ceduo_points_met(); may be NULL */
};

/* Simulate rows from…to - 1. The first `shared_rows` rows share most of their forests: one thread simulates them, today only.
 * Each year has its own rocks, the same in all rows, which reduces the error of a mean over years. If the window has more
 * years than slots, each slot is the middle year of an equal part. Return CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY or the
 * status of ceduo_scene_check(). */
enum ceduo_status ceduo_points_run(const struct points *points, size_t from, size_t to, size_t shared_rows);

/* Return the effort of contacts and stems. A stem that is hit costs three contacts. */
static inline uint64_t ceduo_points_met(uint64_t contacts, struct ceduo_stem_counts stems)
{
    return contacts + stems.drawn + 2 * stems.hit;
}

/* Return the number of years simulated at each point, at most def->years_max, and that of the whole window. */
size_t ceduo_points_years(const struct ceduo_uncertainty_def *def);
size_t ceduo_points_window(const struct ceduo_uncertainty_def *def);

/* Insert an index into a sorted order of n indices, after all values that are not larger. */
void ceduo_insert_index(const double *values, size_t index, size_t n, size_t *order);

/* Return the mean of groups, weighted by their rocks: sizes may differ by one. */
double ceduo_groups_mean(const struct ceduo_replicates *groups, uint64_t rocks);

#endif
