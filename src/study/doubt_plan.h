/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOUBT_PLAN_H
#define CEDUO_DOUBT_PLAN_H

#include "ceduo/doubt.h"

/* The evaluations of a doubt, in items that threads take one by one: item 0 is the scene with one group at each end of its
 * range, of `ends` groups; then one for each base point: A, B, and A with each group from B. */
struct plan {
    struct ceduo_design design;
    size_t rows, ends;
    double *u;                   /* a row of inputs for each evaluation: those of the design, then the ends */
    struct ceduo_halves *values; /* a row of figures for each */
};

/* Figures of one evaluation: for each option and kind, then the differences of all options but the first. */
size_t ceduo_plan_figures(const struct ceduo_scene *scene);
size_t ceduo_plan_figure(size_t options, size_t option, enum ceduo_doubt_kind kind, bool difference);

/* Fills the inputs of a plan whose design and ends are set; release it in any case. */
enum ceduo_status ceduo_plan_fill(const struct ceduo_doubt_def *def, struct plan *plan);
void ceduo_plan_release(struct plan *plan);

size_t ceduo_plan_evaluations(const struct plan *plan); /* of all items */

/* Computes items from `from` on. For the progress of all calls together `*done` of `all` evaluations came before; it is moved on. */
enum ceduo_status ceduo_plan_run(const struct ceduo_doubt_def *def, struct plan *plan, size_t from, uint64_t *done,
                                 uint64_t all);

/* Values of one figure in the order of the design. */
void ceduo_plan_column(const struct plan *plan, size_t figures, size_t figure, struct ceduo_halves *column);

#endif
