/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VARIATES_H
#define CEDUO_VARIATES_H

#include <stdbool.h>
#include <stdint.h>

#include "ceduo/trajectory.h"

/* Control variates. At each contact the facet's turn less its mean, multiplied by what is known before it is drawn, has mean
 * 0 whatever came before: so have its sums along a rock's way, up to any place where the rock comes to (a stopped martingale).
 * They tell in part which rocks drew luck, and a regression on them takes that part out of means and shares. */
#define VARIATES 10

/* What is summed of the rocks at a control beside their number: as many means are adjusted. */
enum varied {
    VARIED_REACHED,  /* 1 for a rock that arrives, otherwise 0 */
    VARIED_EXCEEDED, /* likewise with more than is accepted */
    VARIED_SPEED, VARIED_HEIGHT, VARIED_ENERGY, VARIED_TRANSLATION, /* what it brings, 0 where it does not arrive */
    VARIED_ENDED,    /* and from here on 1 for a rock that did not arrive, by how it ended */
    VARIED = VARIED_ENDED + CEDUO_ENDS
};

#define VARIATE_PAIRS (VARIATES * (VARIATES + 1) / 2)

struct variate_sums {
    double x[VARIATES], xx[VARIATE_PAIRS]; /* xx: by rows, up to the diagonal */
    double xy[VARIED][VARIATES];
};

void ceduo_variates_add(struct variate_sums *s, const double x[VARIATES]);
void ceduo_variates_add_with(double xy[VARIATES], double y, const double x[VARIATES]);
void ceduo_variates_merge(struct variate_sums *into, const struct variate_sums *from);

/* The variates of n rocks made independent of each other. */
struct variate_fit {
    double n;
    double used;                   /* variates that tell anything, counted */
    double root[VARIATE_PAIRS];    /* the Cholesky factor of their centred products */
    double chance[VARIATES];       /* their means in these terms: what chance made of them */
    double chance_square;
};

/* A sum over all rocks in the same terms. */
struct varied_sum {
    double y, along[VARIATES];
};

/* False where nothing varies, or the sums are no numbers. */
bool ceduo_variates_fit(const struct variate_sums *s, double n, struct variate_fit *fit);

/* The sum `y` of what was summed with the variates as `xy`. */
struct varied_sum ceduo_variates_sum(const struct variate_fit *fit, const struct variate_sums *s, double y,
                                     const double xy[VARIATES]);
struct varied_sum ceduo_varied_less(struct varied_sum a, double times, struct varied_sum b); /* a less so many times b */

/* Its mean over all rocks, adjusted; and the variance of that, of squares `square` about the plain mean. */
double ceduo_varied_mean(const struct variate_fit *fit, const struct varied_sum *y);
double ceduo_varied_variance(const struct variate_fit *fit, const struct varied_sum *y, double square);

/* The slopes of the regression. */
void ceduo_varied_slopes(const struct variate_fit *fit, const struct varied_sum *y, double slopes[VARIATES]);

#endif
