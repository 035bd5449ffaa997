/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHAINS_H
#define CEDUO_CHAINS_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "ceduo/scene.h"

/* Adaptive Metropolis chains (Haario, Saksman and Tamminen 2001) that draw from a density in R^d. Proposals are normal.
 * Their covariance is that of the draws times 2.38²/d and a factor, which adapts to the acceptance rate. With a cheap
 * surrogate of the density most proposals come from many steps accepted by the surrogate alone. The density then corrects
 * its error (delayed acceptance: Liu 2001, 9.4.3; Christen and Fox 2005). The first half of each chain is burn-in. The
 * result does not depend on the number of threads, bit for bit. */

#define CEDUO_CHAINS_MAX   8
#define CEDUO_CHAINS_ROUND 50 /* steps between two adaptations */

struct chains_def {
    size_t dimensions, chains;
    const double *starts; /* [chain][dimension] */
    double first_step;    /* standard deviation of the first proposals, in each dimension */
    uint64_t seed;
    unsigned threads;
    size_t steps_min, steps_max; /* per chain */
    double rhat_max, effective_min;
    bool stop_early; /* stop if effective_min is out of reach within steps_max */
    /* Set the log-density; -INFINITY: 0. A `chain` is evaluated by one thread at a time. */
    enum ceduo_status (*density)(void *context, size_t chain, const double *x, double *log_density);
    /* Return the log-density of the surrogate, up to a constant. NULL: no surrogate. It is trained between rounds with n
     * points, in rows, and their log-densities. */
    double (*surrogate)(void *context, const double *x);
    enum ceduo_status (*train)(void *context, const double *x, const double *log_densities, size_t n);
    const atomic_bool *cancel; /* stops diagnostics only: `density` and `train` must check it themselves; may be NULL */
    bool (*round)(void *context, size_t steps, double rhat, double effective_size); /* return false to stop; may be NULL */
    void *context;
};

struct chains {
    size_t dimensions, chains, steps, capacity;
    double *x; /* [step][chain][dimension] */
    size_t proposed_count;
    double *proposed, *proposed_density; /* proposals and their log-densities, without the starts */
    double rhat, effective_size;         /* worst dimension; NaN before the fourth round */
    bool converged;
};

/* Return CEDUO_OK, CEDUO_NO_MEMORY or the status of `density` or `train`. Earlier draws are kept. The caller releases
 * *chains in any case. */
enum ceduo_status ceduo_chains_run(const struct chains_def *def, struct chains *chains);
void ceduo_chains_release(struct chains *chains);

/* Number of draws after burn-in, and draw i of them. The chains take turns. */
size_t ceduo_chains_draws(const struct chains *chains);
const double *ceduo_chains_draw(const struct chains *chains, size_t i);

/* Set split R-hat and the effective sample size of one dimension (Gelman et al. 2013, 11.4 and 11.5). */
void ceduo_chains_diagnose(const struct chains *chains, size_t dimension, double *rhat, double *effective_size);

#endif
