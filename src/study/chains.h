/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHAINS_H
#define CEDUO_CHAINS_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ceduo/status.h"

/* Adaptive Metropolis chains (Haario, Saksman and Tamminen 2001) that draw from a density in R^d. Their steps are normal, with
 * the covariance of all that the chains have drawn so far, times 2.38²/d and a factor that follows the share of accepted
 * steps. Where a cheap guess of the density is at hand, most proposals come from many steps that the guess alone decides, and
 * the density decides where the guess was wrong (delayed acceptance: Liu 2001, 9.4.3; Christen and Fox 2005). The draws of the
 * first half are not read. Bits do not depend on the number of threads. */

#define CEDUO_CHAINS_MAX   8
#define CEDUO_CHAINS_ROUND 50 /* steps between two looks at all chains */

struct chains_def {
    size_t dimensions, chains;
    const double *starts; /* [chain][dimension] */
    double first_step;    /* the standard deviation of the first steps, in each dimension */
    uint64_t seed;
    unsigned threads;
    size_t steps_min, steps_max; /* of each chain */
    double rhat_max, effective_min;
    bool stop_early; /* whether chains that would have far less than effective_least at their end are ended early */
    /* The logarithm of the density; -INFINITY where it is 0. `chain` is the caller's: one thread at a time asks for it. */
    enum ceduo_status (*density)(void *context, size_t chain, const double *x, double *log_density);
    /* The guess, up to a constant; learns between rounds from n places, in rows, and their densities. NULL: none. */
    double (*guess)(void *context, const double *x);
    enum ceduo_status (*learn)(void *context, const double *x, const double *log_densities, size_t n);
    const atomic_bool *cancel; /* ends a look at all chains; `density` and `learn` look themselves. May be NULL */
    bool (*round)(void *context, size_t steps, double rhat, double effective_size); /* false ends them; may be NULL */
    void *context;
};

struct chains {
    size_t dimensions, chains, steps, capacity;
    double *x; /* [step][chain][dimension] */
    size_t tried_count;
    double *tried, *tried_density; /* proposals likewise: all but the starts */
    double rhat, effective_size;   /* the worst of all dimensions; NaN before two rounds */
    bool converged;
};

/* CEDUO_NO_MEMORY, or what `density` or `learn` says: what was drawn before stays. Release it in any case. */
enum ceduo_status ceduo_chains_run(const struct chains_def *def, struct chains *chains);
void ceduo_chains_release(struct chains *chains);

/* Draws that are read: the second half of each chain; draw i of all chains, in turn. */
size_t ceduo_chains_draws(const struct chains *chains);
const double *ceduo_chains_draw(const struct chains *chains, size_t i);

/* Split R-hat and the effective size of one dimension (Gelman et al. 2013, 11.4 and 11.5). */
void ceduo_chains_diagnose(const struct chains *chains, size_t dimension, double *rhat, double *effective_size);

#endif
