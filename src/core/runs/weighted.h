/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WEIGHTED_H
#define CEDUO_WEIGHTED_H

#include "ceduo/simulate.h"

/* Statistics of rocks with weights of mean 1 (prepared.h). Shares and means are weighted, and divided by the sum of all
 * weights, so that no share exceeds 1. The error is that of the regression estimator on the weights, whose mean is known
 * (Cochran 1977); it excludes the part caused by drawing heavy rocks too often. Equal weights give plain statistics. */

/* Totals of all released rocks. */
struct weight_totals {
    double n, w, ww; /* n; sums of weights and of squared weights */
    double per_year; /* blocks per year; NaN: only shares are computed */
    double missing;  /* sum of weights of unfinished rocks, which might have arrived */
    /* Upper bound of the energy of each rock, sorted, with the cumulative weight from the largest down; NULL: unknown. */
    const struct weighted *max_energies;
};

struct weighted {
    double value, weight;
};

/* A sum over all rocks of weight × value; rocks of value 0 need not be added. */
struct weighted_sum {
    double t, tt, tw;
};

static inline void weighted_sum_add(struct weighted_sum *s, double weight, double value)
{
    double t = weight * value;
    s->t += t;
    s->tt += t * t;
    s->tw += t * weight;
}

/* Return the standard error of a sum divided by the sum of all weights. */
double ceduo_weighted_se(const struct weight_totals *totals, const struct weighted_sum *sum);

/* Return the estimate of a mean difference between pairs, as ceduo_estimate_from_pairs(). */
struct ceduo_estimate ceduo_weighted_paired(const struct weight_totals *totals, const struct weighted_sum *sum);

/* Sort n upper bounds of energies and accumulate their weights, for `max_energies`. */
void ceduo_weighted_bound(struct weighted *rocks, size_t n);

/* Return the share of rocks above an energy (-1: all that arrive); `ones` is the sum of value 1 over them. Its Wilson interval
 * uses the number of equal rocks with the same error. The upper limit counts unfinished rocks. It is at least the limit for
 * none of the rocks that could exceed the energy. So it does not rise if fewer rocks arrive, and heavy, rare rocks cannot
 * narrow the bound of frequent small ones. */
struct ceduo_estimate ceduo_weighted_share(const struct weight_totals *totals, const struct weighted_sum *ones, double energy);

/* Compute the distribution of n values, which are sorted in place. Intervals of percentiles after Woodruff (1952). */
struct ceduo_distribution ceduo_weighted_distribution(const struct weight_totals *totals, struct weighted *values, size_t n);

/* Return the number of sorted values that are <= value. */
size_t ceduo_weighted_upto(const struct weighted *sorted, size_t n, double value);

/* Return quantile p of sorted values. */
double ceduo_weighted_quantile(const struct weighted *values, size_t n, double p);

void ceduo_weighted_sort(struct weighted *values, size_t n);

/* Compute the hazard from the energies of n arriving rocks, sorted in place. `curve` may be NULL. False without memory. */
bool ceduo_hazard_read(const struct weight_totals *totals, struct weighted *energies, size_t n, double accepted,
                       struct ceduo_hazard *hazard, struct ceduo_hazard_curve *curve);

#endif
