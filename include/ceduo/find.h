/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIND_H
#define CEDUO_FIND_H

#include <stdbool.h>

#include "flag.h"
#include "status.h"

/* Inverse search: find the value for which a goal stays at or below its target. The search depends on nothing but the goals
 * that were evaluated, and evaluates no value twice. */

#define CEDUO_FIND_SCAN      8    /* interior values, evaluated if both ends pass or both fail */
#define CEDUO_FIND_TOLERANCE 1e-9 /* share of hi - lo */

struct ceduo_find_def {
    double lo, hi; /* finite, lo <= hi */
    bool whole;    /* only whole values; |lo|, |hi| <= 2^53 */
    double target; /* a value passes if its goal is <= target; may be infinite; a goal of NaN never passes */
    /* Set *goal for a value. Any status but CEDUO_OK ends the search. Equal values must have equal goals. */
    enum ceduo_status (*goal)(void *context, double value, double *goal);
    void *context;
    double tolerance;         /* share of hi - lo; not used for whole values; 0: CEDUO_FIND_TOLERANCE */
    const ceduo_flag *cancel; /* may be NULL; if set, the search returns after the current evaluation */
};

/* From 0 to 1, target 0. The caller sets `goal`. */
struct ceduo_find_def ceduo_find_def_default(void);

enum ceduo_side { CEDUO_SMALLEST, CEDUO_LARGEST };

struct ceduo_found {
    bool found;
    bool whole_range;                /* every evaluated value passes */
    double value, goal_at_value;     /* evaluated, and passes; NaN if not found */
    enum ceduo_side side;            /* `value` is the smallest or the largest that passes */
    bool monotone;                   /* the evaluated goals only rise or only fall with the value */
    double nearest, goal_at_nearest; /* smallest evaluated goal; NaN if all goals are NaN */
    unsigned evaluations;
};

/* Find the value in [lo, hi] at which the goal crosses its target: both ends pass   lo (smallest) if all interior values
 * pass, too. Otherwise the smallest value above which all evaluated values pass; not monotone only hi passes   the smallest
 * value that passes only lo passes   the largest value that passes neither passes   if an interior value passes, the
 * crossing below the first such value; not monotone. Otherwise not found The value passes. The next whole number beyond the
 * crossing, or a value within the tolerance, was evaluated and fails. A goal that is not monotone may have further
 * crossings. Changes of the goal below 1e-12 of it count as rounding. Without a whole number in [lo, hi] nothing is
 * evaluated. Bisection takes at most 55 evaluations for whole values up to 10^12 and for the default tolerance. Return
 * CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or the status of the goal. Unless CEDUO_OK, *found covers
 * the evaluated values only. */
enum ceduo_status ceduo_find(const struct ceduo_find_def *def, struct ceduo_found *found);

#endif
