/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIND_H
#define CEDUO_FIND_H

#include <stdbool.h>

#include "flag.h"
#include "status.h"

/* The inverse search: for which value does a goal stay at or below its target? It depends on nothing but the goals that
 * it sees, and asks for no value twice. */

#define CEDUO_FIND_SCAN      8    /* evenly spaced values between the ends that are looked at where both ends agree */
#define CEDUO_FIND_TOLERANCE 1e-9 /* of hi - lo */

struct ceduo_find_def {
    double lo, hi; /* finite, lo <= hi */
    bool whole;    /* only whole values; |lo|, |hi| <= 2^53 */
    double target; /* a value passes where its goal is <= target, which may be infinite; NaN never passes */
    /* Sets *goal for a value; anything but CEDUO_OK ends the search. The same value must give the same goal. */
    enum ceduo_status (*goal)(void *context, double value, double *goal);
    void *context;
    double tolerance;         /* of values that are not whole, as a share of hi - lo; 0: CEDUO_FIND_TOLERANCE */
    const ceduo_flag *cancel; /* may be NULL; raised by another thread: the call returns after the value it is at */
};

/* From 0 to 1, target 0; the goal is the caller's to set. */
struct ceduo_find_def ceduo_find_def_default(void);

enum ceduo_side { CEDUO_SMALLEST, CEDUO_LARGEST };

struct ceduo_found {
    bool found;
    bool whole_range;                /* every value that was looked at passes */
    double value, goal_at_value;     /* looked at, and passes; NaN where not found */
    enum ceduo_side side;            /* it is the smallest or the largest that passes, see ceduo_find() */
    bool monotone;                   /* the goals that were seen only rise or only fall along the values */
    double nearest, goal_at_nearest; /* of all seen the smallest goal; NaN where none is a number */
    unsigned evaluations;
};

/* Looks for the value in [lo, hi] where the goal crosses its target:
 *   both ends pass   lo, smallest, if the scan between them passes too. Otherwise the smallest value from which on all
 *                    that is seen up to hi passes; not monotone
 *   only hi passes   the smallest value that passes
 *   only lo passes   the largest one
 *   neither passes   if some value of the scan does, the smallest value of that kind: the crossing below the first of
 *                    them; not monotone. Otherwise nothing is found
 * The value passes itself; the next whole number on the other side of the crossing, or a value there within the
 * tolerance, was seen to fail. Where the goal is not monotone there may be crossings that are not seen. Turns of the
 * goal by less than 1e-12 of it count as rounding. No whole number in [lo, hi]: nothing is found, nothing looked at.
 * The crossing is bisected: at most 55 evaluations of whole values up to 10^12, and of others within the default tolerance.
 * CEDUO_OK, CEDUO_CANCELLED, CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or what the goal returned: then *found tells only what was seen. */
enum ceduo_status ceduo_find(const struct ceduo_find_def *def, struct ceduo_found *found);

#endif
