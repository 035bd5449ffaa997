/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains run in rounds, in parallel. After a round the proposal is adapted and convergence is checked. */
#include "chains.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "sequence.h"

#define TARGET_ACCEPTANCE 0.28
#define SURROGATE_STEPS   100  /* steps by the surrogate for one evaluation of the density */
#define BYPASS_EVERY      8    /* steps; such a step bypasses the surrogate, so a wrong one cannot trap chains */
#define RIDGE             1e-6 /* relative to the variances; keeps the covariance positive definite */

struct walk {
    struct sequence sequence;
    gsl_rng random;
    double density, surrogate; /* log-density of the last draw, by the density and by the surrogate */
    double accepted;           /* accepted steps of this round; a surrogate step counts 1/SURROGATE_STEPS */
};

struct work {
    const struct chains_def *def;
    struct chains *chains;
    struct walk walks[CEDUO_CHAINS_MAX];
    gsl_matrix *root;               /* Cholesky factor of the proposal covariance, lower triangle, times `factor` */
    gsl_matrix *proposals, *trials; /* a row for each chain */
    double factor;
    bool has_surrogate;
    size_t rounds, trained; /* trained: rounds that the surrogate was trained with */
};

static double *draw_at(const struct chains *c, size_t chain, size_t step)
{
    return c->x + (step * c->chains + chain) * c->dimensions;
}

/* ---- one chain ---- */

/* Set `to` to a normal step from `from`. */
static void propose(struct work *w, size_t chain, const double *from, double *to)
{
    size_t d = w->def->dimensions;
    gsl_vector_const_view mean = gsl_vector_const_view_array(from, d);
    gsl_vector_view proposal = gsl_vector_view_array(to, d);
    gsl_ran_multivariate_gaussian(&w->walks[chain].random, &mean.vector, w->root, &proposal.vector);
}

/* Set `to` to the end of SURROGATE_STEPS steps accepted by the surrogate alone. Return the surrogate there. */
static double run_surrogate(struct work *w, size_t chain, const double *from, double *to)
{
    const struct chains_def *def = w->def;
    struct walk *walk = &w->walks[chain];
    double *trial = gsl_matrix_ptr(w->trials, chain, 0), current = walk->surrogate;
    memcpy(to, from, def->dimensions * sizeof *to);
    for (int i = 0; i < SURROGATE_STEPS; i++) {
        propose(w, chain, to, trial);
        double chance = log(gsl_rng_uniform_pos(&walk->random)), index = def->surrogate(def->context, trial);
        if (!(chance < index - current))
            continue;
        memcpy(to, trial, def->dimensions * sizeof *to);
        current = index;
        walk->accepted += 1. / SURROGATE_STEPS;
    }
    return current;
}

/* Take one step: the next draw is the accepted proposal, or the last draw again. */
static enum ceduo_status advance(struct work *w, size_t chain, size_t step)
{
    const struct chains_def *def = w->def;
    struct walk *walk = &w->walks[chain];
    const double *last = draw_at(w->chains, chain, step - 1);
    double *to = gsl_matrix_ptr(w->proposals, chain, 0), density, surrogate = 0;
    bool bypass = !w->has_surrogate || step % BYPASS_EVERY == 0;
    if (bypass)
        propose(w, chain, last, to);
    else
        surrogate = run_surrogate(w, chain, last, to);
    double chance = log(gsl_rng_uniform_pos(&walk->random));
    enum ceduo_status status = def->density(def->context, chain, to, &density);
    if (status != CEDUO_OK)
        return status;
    bool is_accepted = chance < density - walk->density - (bypass ? 0 : surrogate - walk->surrogate);
    size_t index = (step - 1) * def->chains + chain, bytes = def->dimensions * sizeof *to;
    memcpy(draw_at(w->chains, chain, step), is_accepted ? to : last, bytes);
    memcpy(w->chains->proposed + index * def->dimensions, to, bytes);
    w->chains->proposed_density[index] = density;
    walk->accepted += bypass && is_accepted;
    if (is_accepted) {
        walk->density = density;
        walk->surrogate = !w->has_surrogate ? 0 : bypass ? def->surrogate(def->context, to) : surrogate;
    }
    return CEDUO_OK;
}

static int run_chain(void *context, size_t c, size_t worker)
{
    struct work *w = context;
    enum ceduo_status status = CEDUO_OK;
    (void)worker;
    for (size_t i = 0; i < CEDUO_CHAINS_ROUND && status == CEDUO_OK; i++)
        status = advance(w, c, w->chains->steps + i);
    return (int)status;
}

/* ---- all chains ---- */

/* Adapt the proposal to the covariance of the draws after burn-in, and its scale to the acceptance rate, in decreasing
 * steps. */
static void adapt(struct work *w)
{
    const struct chains_def *def = w->def;
    double accepted = 0, before = w->factor;
    for (size_t c = 0; c < def->chains; c++) {
        accepted += w->walks[c].accepted / (double)(CEDUO_CHAINS_ROUND * def->chains);
        w->walks[c].accepted = 0;
    }
    w->factor *= exp((accepted - TARGET_ACCEPTANCE) * 2 / sqrt((double)++w->rounds));
    if (w->rounds < 2) {
        gsl_matrix_scale(w->root, w->factor / before);
        return;
    }
    const double *x = ceduo_chains_draw(w->chains, 0);
    size_t d = def->dimensions, n = ceduo_chains_draws(w->chains);
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k <= i; k++)
            gsl_matrix_set(w->root, i, k,
                           gsl_stats_covariance(x + i, d, x + k, d, n) * (i == k ? 1 + RIDGE : 1) + (i == k) * 1e-8);
    gsl_linalg_cholesky_decomp1(w->root);
    gsl_matrix_scale(w->root, w->factor);
}

/* Train the surrogate whenever the rounds have grown by an eighth. Training less often traps chains if an early surrogate is
 * too low. */
static enum ceduo_status train(struct work *w)
{
    const struct chains_def *def = w->def;
    if (!def->surrogate || w->rounds - w->trained < w->trained / 8)
        return CEDUO_OK;
    w->trained = w->rounds;
    enum ceduo_status status =
        def->train(def->context, w->chains->proposed, w->chains->proposed_density, w->chains->proposed_count);
    w->has_surrogate = true;
    for (size_t c = 0; c < def->chains && status == CEDUO_OK; c++)
        w->walks[c].surrogate = def->surrogate(def->context, draw_at(w->chains, c, w->chains->steps - 1));
    return status;
}

/* Resize *array to n rows of `columns` numbers. */
static bool resize(double **array, size_t n, size_t columns)
{
    double *grown = realloc(*array, n * columns * sizeof *grown);
    *array = grown ? grown : *array;
    return grown;
}

static bool grow(struct chains *c, size_t steps)
{
    if (steps <= c->capacity)
        return true;
    size_t n = 2 * steps * c->chains;
    c->capacity = 2 * steps;
    return resize(&c->x, n, c->dimensions) && resize(&c->proposed, n, c->dimensions) && resize(&c->proposed_density, n, 1);
}

static void diagnose(struct chains *c, const atomic_bool *cancel)
{
    c->rhat = 1;
    c->effective_size = INFINITY;
    for (size_t i = 0; i < c->dimensions && !ceduo_cancelled(cancel); i++) {
        double rhat, size;
        ceduo_chains_diagnose(c, i, &rhat, &size);
        c->rhat = rhat > c->rhat || isnan(rhat) ? rhat : c->rhat;
        c->effective_size = fmin(c->effective_size, size);
    }
}

static bool is_done(struct work *w)
{
    const struct chains_def *def = w->def;
    struct chains *c = w->chains;
    if (w->rounds >= 4)
        diagnose(c, def->cancel);
    c->converged = c->steps >= def->steps_min && c->rhat < def->rhat_max && c->effective_size >= def->effective_min;
    /* Hopeless if the effective size, extrapolated to steps_max, is too small: less than a quarter of effective_min after an
     * eighth of the steps, less than half from a quarter on. */
    double progress = (double)c->steps / (double)def->steps_max;
    bool hopeless =
        def->stop_early && progress >= 0.125 && c->effective_size / progress < fmin(0.5, 2 * progress) * def->effective_min;
    bool continues = !def->round || def->round(def->context, c->steps, c->rhat, c->effective_size);
    return c->converged || c->steps >= def->steps_max || hopeless || !continues;
}

static enum ceduo_status begin(struct work *w)
{
    const struct chains_def *def = w->def;
    size_t d = def->dimensions;
    enum ceduo_status status = CEDUO_OK;
    w->root = gsl_matrix_calloc(d, d);
    w->proposals = gsl_matrix_calloc(def->chains, d);
    w->trials = gsl_matrix_calloc(def->chains, d);
    if (!w->root || !w->proposals || !w->trials || !grow(w->chains, CEDUO_CHAINS_ROUND)) /* untaken 3: gsl */
        return CEDUO_NO_MEMORY;
    w->factor = 2.38 / sqrt((double)d);
    for (size_t i = 0; i < d; i++)
        gsl_matrix_set(w->root, i, i, w->factor * def->first_step);
    memcpy(w->chains->x, def->starts, def->chains * d * sizeof *w->chains->x);
    for (size_t c = 0; c < def->chains && status == CEDUO_OK; c++) {
        w->walks[c].random = ceduo_sequence_begin(&w->walks[c].sequence, def->seed, c);
        status = def->density(def->context, c, def->starts + c * d, &w->walks[c].density);
    }
    w->chains->steps = 1;
    return status == CEDUO_OK ? train(w) : status;
}

enum ceduo_status ceduo_chains_run(const struct chains_def *def, struct chains *chains)
{
    struct work w = {.def = def, .chains = chains};
    *chains = (struct chains){.dimensions = def->dimensions, .chains = def->chains, .rhat = NAN, .effective_size = NAN};
    const struct parallel round = {def->chains, def->threads, run_chain, &w};
    enum ceduo_status status = begin(&w);
    for (bool done = false; status == CEDUO_OK && !done;) {
        status = grow(chains, chains->steps + CEDUO_CHAINS_ROUND) ? (enum ceduo_status)ceduo_parallel(&round) : CEDUO_NO_MEMORY;
        if (status != CEDUO_OK)
            break;
        chains->steps += CEDUO_CHAINS_ROUND;
        chains->proposed_count += CEDUO_CHAINS_ROUND * def->chains;
        adapt(&w);
        status = train(&w);
        done = status == CEDUO_OK && is_done(&w);
    }
    gsl_matrix_free(w.root);
    gsl_matrix_free(w.proposals);
    gsl_matrix_free(w.trials);
    return status;
}

void ceduo_chains_release(struct chains *c)
{
    free(c->x);
    free(c->proposed);
    free(c->proposed_density);
    *c = (struct chains){0};
}

/* ---- reading ---- */

size_t ceduo_chains_draws(const struct chains *c)
{
    return c->chains * (c->steps - c->steps / 2);
}

const double *ceduo_chains_draw(const struct chains *c, size_t i)
{
    return draw_at(c, i % c->chains, c->steps / 2 + i / c->chains);
}

/* Return the mean squared difference of draws `lag` steps apart, over half chains. */
static double variogram(const struct chains *c, size_t i, size_t n, size_t lag)
{
    double sum = 0;
    for (size_t p = 0; p < 2 * c->chains; p++) {
        size_t from = c->steps - (p % 2 + 1) * n;
        for (size_t s = lag; s < n; s++) {
            double d = draw_at(c, p / 2, from + s)[i] - draw_at(c, p / 2, from + s - lag)[i];
            sum += d * d;
        }
    }
    return sum / (double)(2 * c->chains * (n - lag));
}

void ceduo_chains_diagnose(const struct chains *c, size_t i, double *rhat, double *effective_size)
{
    size_t n = (c->steps - c->steps / 2) / 2, halves = 2 * c->chains, stride = c->chains * c->dimensions;
    double means[2 * CEDUO_CHAINS_MAX], variances[2 * CEDUO_CHAINS_MAX], sum = 0, total = (double)(halves * n);
    for (size_t p = 0; p < halves; p++) { /* half chains */
        const double *x = draw_at(c, p / 2, c->steps - (p % 2 + 1) * n) + i;
        means[p] = gsl_stats_mean(x, stride, n);
        variances[p] = gsl_stats_variance_m(x, stride, n, means[p]);
    }
    double variance_within = gsl_stats_mean(variances, 1, halves);
    double all = variance_within * ((double)n - 1) / (double)n + gsl_stats_variance(means, 1, halves);
    *rhat = variance_within > 0 ? sqrt(all / variance_within) : NAN;
    for (size_t lag = 1; lag + 1 < n; lag += 2) { /* initial positive sequence (Geyer 1992) */
        double pair = 2 - (variogram(c, i, n, lag) + variogram(c, i, n, lag + 1)) / (2 * all);
        if (!(pair > 0))
            break;
        sum += pair;
    }
    *effective_size = total / (1 + 2 * sum); /* at most the number of draws: pairs are positive */
}
