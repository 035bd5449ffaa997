/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_POINTS_H
#define CEDUO_POINTS_H

#include <stdatomic.h>

#include "ceduo/run.h"
#include "ceduo/uncertainty.h"
#include "ceduo/years.h"

/* A scene at many points of what may be true: each row of inputs is a scene; of each its options are simulated, today and year
 * by year, and read. The rows are shared among threads; what is read does not depend on them. */

/* What is read: an option in a row; slot 0 is today, the others are its years. */
struct point {
    size_t row, option, slot;
    const struct ceduo_scene *scene;
    const struct ceduo_option *forest; /* of the scene; of a year as it stands then */
};

/* What each group of the rocks brings to a control. */
struct control_means {
    struct ceduo_group_means of[CEDUO_SURFACE_GROUPS];
};

struct points {
    /* The scene, its inputs, which options and years are asked for, and how many rocks; 0: none is simulated, and nothing is
     * control_means. Slots 1… are there where a rotation is asked for, at most ceduo_points_years() of each option. */
    const struct ceduo_uncertainty_def *def;
    const double *u; /* rows of inputs */
    bool today;      /* slot 0 is asked for */
    /* Called by several threads at once, each with points of its own rows. `at`: one for each control, NULL if no rocks are
     * simulated. May be NULL. */
    void (*read)(void *context, const struct point *point, const struct control_means *at);
    void (*done)(void *context); /* a row is done; may be NULL; by several threads at once */
    void *context;
    uint64_t *effort; /* set to ceduo_points_met() of all rows; may be NULL */
};

/* Rows from…to - 1; the first `together` of them by one thread and today alone, as they have most of their forests in
 * common. In each year other rocks come down, as they say more of a mean over the years, but in every row the same. If the window
 * has more years, or in another row another number of them, each is the middle of a part.
 * CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY or what ceduo_scene_check() says. */
enum ceduo_status ceduo_points_run(const struct points *points, size_t from, size_t to, size_t together);

/* Effort of what rocks met: a stem that is hit takes the time of three contacts. */
static inline uint64_t ceduo_points_met(uint64_t contacts, struct ceduo_stem_counts stems)
{
    return contacts + stems.drawn + 2 * stems.hit;
}

/* Number of years that are simulated at each point, at most def->years_max; and of the whole window. */
size_t ceduo_points_years(const struct ceduo_uncertainty_def *def);
size_t ceduo_points_window(const struct ceduo_uncertainty_def *def);

/* Insert an index into an order of n others, after those whose values are no larger. */
void ceduo_insert_index(const double *values, size_t index, size_t n, size_t *order);

/* Of groups that may differ by a rock. */
double ceduo_groups_mean(const struct ceduo_replicates *groups, uint64_t rocks);

#endif
