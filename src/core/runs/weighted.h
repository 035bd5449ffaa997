/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WEIGHTED_H
#define CEDUO_WEIGHTED_H

#include "ceduo/hazard.h"
#include "ceduo/statistics.h"

/* Statistics of rocks that have weights, which are 1 on the mean (prepared.h). A share or a mean is that of the weights, over
 * the sum of all weights, so that nothing is above 1. Its error is that of the regression on the weights, whose mean is
 * known (Cochran 1977): what only says that heavy rocks were drawn a little too often is no error. Where all weights are
 * equal, these are the plain statistics. */

/* One percentile of a distribution. */
#define PERCENTILES 3
struct percentile {
    double p, *value, *lo, *hi;
};
struct percentile ceduo_percentile_compute(struct ceduo_distribution *distribution, size_t k);

/* All rocks released. */
struct released {
    double n, w, ww; /* the sums of weights and of their squares */
    double per_year; /* blocks a year; NaN: only shares are asked for */
    double missing;  /* weights of the unfinished, which might have arrived */
    /* Of each rock the largest energy that it could have, rising, and the weights of it and of all above it; NULL: no bound is
     * known. */
    const struct weighted *could;
};

struct weighted {
    double value, weight;
};

/* Something that is summed over all rocks, of each its weight times a value; rocks of value 0 need not be added. */
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

/* The standard error of such a sum over the sum of all weights. */
double ceduo_weighted_se(const struct released *all, const struct weighted_sum *sum);

/* The same of a sum of differences between pairs, as in ceduo_estimate_of_pairs(). */
struct ceduo_estimate ceduo_weighted_paired(const struct released *all, const struct weighted_sum *sum);

/* Sorts n rocks with the largest energies that they could have, and sums their weights: for `could`. */
void ceduo_weighted_bound(struct weighted *rocks, size_t n);

/* The share of those with more than an energy (-1: of all that arrive), of which `ones` holds 1, with its 95 % interval by Wilson
 * at the number of equal rocks that would have the same error. The upper end counts the unfinished in. It is nowhere below that of
 * none of the rocks that could have so much energy, as if all of them were as likely to: so it does not rise when fewer rocks
 * arrive, and a few large ones do not bound what small ones do, of which each stands for many. */
struct ceduo_estimate ceduo_weighted_share(const struct released *all, const struct weighted_sum *ones, double energy);

/* Of n values, which are sorted. Percentiles have intervals after Woodruff (1952). */
struct ceduo_distribution ceduo_weighted_distribution(const struct released *all, struct weighted *values, size_t n);

/* How many of sorted values are not above one. */
size_t ceduo_weighted_upto(const struct weighted *sorted, size_t n, double value);

/* The quantile p of sorted values. */
double ceduo_weighted_quantile(const struct weighted *values, size_t n, double p);

void ceduo_weighted_sort(struct weighted *values, size_t n);

/* The hazard from the energies of the n rocks that arrive, which are sorted. `curve` may be NULL. False without memory. */
bool ceduo_hazard_read(const struct released *all, struct weighted *energies, size_t n, double accepted,
                       struct ceduo_hazard *hazard, struct ceduo_hazard_curve *curve);

#endif
