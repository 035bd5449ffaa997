/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VARIATES_H
#define CEDUO_VARIATES_H

#include <stdbool.h>

#include "ceduo/run.h"
#include "variate_sums.h"

/* The regression on the control variates of variate_sums.h. */

const struct variates_kernel *ceduo_variates_kernel(enum ceduo_kernel kernel);

/* A rock that does not arrive. */
void ceduo_variates_add_ended(struct varied_sums *to, enum ceduo_end end, const struct variate_row *row);

void ceduo_variates_merge(struct variate_sums *into, const struct variate_sums *from);
void ceduo_varied_merge(struct varied_sums *into, const struct varied_sums *from);

/* The variates of n rocks made independent of each other. */
struct variate_fit {
    double n, sums[VARIATES];
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

/* Of `which`, whose sum is y. */
struct varied_sum ceduo_variates_sum(const struct variate_fit *fit, const struct varied_sums *s, enum varied which, double y);
struct varied_sum ceduo_varied_less(struct varied_sum a, double times, struct varied_sum b); /* a less so many times b */

/* Its mean over all rocks, adjusted; and the variance of that, of squares `square` about the plain mean. */
double ceduo_varied_mean(const struct variate_fit *fit, const struct varied_sum *y);
double ceduo_varied_variance(const struct variate_fit *fit, const struct varied_sum *y, double square);

/* The slopes of the regression. */
void ceduo_varied_slopes(const struct variate_fit *fit, const struct varied_sum *y, double slopes[VARIATES]);

#endif
