/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_NUMBER_H
#define CEDUO_NUMBER_H

#include <stdbool.h>

#define CEDUO_SPREAD_KINDS(X)                                                                                                  \
    X(NORMAL, "normal")                                                                                                        \
    X(UNIFORM, "uniform")

enum ceduo_spread_kind {
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_SPREAD_KINDS(X)
#undef X
};

/* A number that may differ from rock to rock. `spread` is the standard deviation of a normal law, which is cut at three
 * of them, or the half-width of a uniform one; 0: every rock has `mean`. */
struct ceduo_number {
    double mean;
    double spread;
    enum ceduo_spread_kind kind;
};

/* A number without spread. */
struct ceduo_number ceduo_number(double mean);

/* The smallest and the largest value that can be drawn. */
double ceduo_number_lowest(struct ceduo_number n);
double ceduo_number_highest(struct ceduo_number n);

/* The value of quantile u (0 < u < 1), the law cut at [lo, hi] as well: what drawing again until the value lies inside
 * gives, in one draw. [lo, hi] must reach into the range of the law. */
double ceduo_number_draw(struct ceduo_number n, double u, double lo, double hi);

#endif
