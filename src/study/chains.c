/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains go in rounds: each walks some steps by itself, on whatever thread; then all are looked at together, the proposal is
 * renewed, and it is asked whether they agree. */
#include "chains.h"

#include <gsl/gsl_linalg.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "sequence.h"

#define WANTED 0.28 /* share of accepted steps */
#define INNER  100  /* steps that the guess decides, for one that the density decides */
#define PLAIN  8    /* every such step goes without the guess, so that nobody is lost where it is wrong */
#define RIDGE  1e-6 /* of the variances, so that the covariance has a root */

struct walk {
    struct sequence sequence;
    gsl_rng random;
    double density, guess; /* their logarithms, here */
    double moved;          /* share of accepted steps, summed over this round */
};

struct work {
    const struct chains_def *def;
    struct chains *chains;
    struct walk walks[CEDUO_CHAINS_MAX];
    gsl_matrix *root;               /* lower triangle: of the covariance of steps */
    gsl_matrix *proposals, *trials; /* a row for each chain */
    double factor;                  /* in the root */
    bool guessing;
    size_t rounds, learnt; /* those that the guess has learnt from */
};

static double *draw_at(const struct chains *c, size_t chain, size_t step)
{
    return c->x + (step * c->chains + chain) * c->dimensions;
}

/* ---- one chain ---- */

/* A normal step from `from` to `to`. */
static void propose(struct work *w, size_t chain, const double *from, double *to)
{
    size_t d = w->def->dimensions;
    gsl_vector_const_view here = gsl_vector_const_view_array(from, d);
    gsl_vector_view there = gsl_vector_view_array(to, d);
    gsl_ran_multivariate_gaussian(&w->walks[chain].random, &here.vector, w->root, &there.vector);
}

/* Many steps by the guess alone, to `to`; returns the guess there. */
static double wander(struct work *w, size_t chain, const double *from, double *to)
{
    const struct chains_def *def = w->def;
    struct walk *walk = &w->walks[chain];
    double *trial = gsl_matrix_ptr(w->trials, chain, 0), here = walk->guess;
    memcpy(to, from, def->dimensions * sizeof *to);
    for (int i = 0; i < INNER; i++) {
        propose(w, chain, to, trial);
        double chance = log(gsl_rng_uniform_pos(&walk->random)), there = def->guess(def->context, trial);
        if (!(chance < there - here))
            continue;
        memcpy(to, trial, def->dimensions * sizeof *to);
        here = there;
        walk->moved += 1. / INNER;
    }
    return here;
}

/* One step from the draw before; the next draw is the new place or the same once more. */
static enum ceduo_status step_on(struct work *w, size_t chain, size_t step)
{
    const struct chains_def *def = w->def;
    struct walk *walk = &w->walks[chain];
    const double *here = draw_at(w->chains, chain, step - 1);
    double *to = gsl_matrix_ptr(w->proposals, chain, 0), density, guess = 0;
    bool plain = !w->guessing || step % PLAIN == 0;
    if (plain)
        propose(w, chain, here, to);
    else
        guess = wander(w, chain, here, to);
    double chance = log(gsl_rng_uniform_pos(&walk->random));
    enum ceduo_status status = def->density(def->context, chain, to, &density);
    if (status != CEDUO_OK)
        return status;
    bool taken = chance < density - walk->density - (plain ? 0 : guess - walk->guess);
    size_t tried = (step - 1) * def->chains + chain, bytes = def->dimensions * sizeof *to;
    memcpy(draw_at(w->chains, chain, step), taken ? to : here, bytes);
    memcpy(w->chains->tried + tried * def->dimensions, to, bytes);
    w->chains->tried_density[tried] = density;
    walk->moved += plain && taken;
    if (taken) {
        walk->density = density;
        walk->guess = !w->guessing ? 0 : plain ? def->guess(def->context, to) : guess;
    }
    return CEDUO_OK;
}

static int walk_chain(void *context, size_t c, size_t worker)
{
    struct work *w = context;
    enum ceduo_status status = CEDUO_OK;
    (void)worker;
    for (size_t i = 0; i < CEDUO_CHAINS_ROUND && status == CEDUO_OK; i++)
        status = step_on(w, c, w->chains->steps + i);
    return (int)status;
}

/* ---- all chains ---- */

/* The proposal of the next round, from the covariance of all draws that are read; the older the chains, the less it changes. */
static void adapt(struct work *w)
{
    const struct chains_def *def = w->def;
    double accepted = 0, before = w->factor;
    for (size_t c = 0; c < def->chains; c++) {
        accepted += w->walks[c].moved / (double)(CEDUO_CHAINS_ROUND * def->chains);
        w->walks[c].moved = 0;
    }
    w->factor *= exp((accepted - WANTED) * 2 / sqrt((double)++w->rounds));
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

/* Whenever there is an eighth more to learn from. Seldomer, and chains are stuck wherever an early guess is too low. */
static enum ceduo_status learn(struct work *w)
{
    const struct chains_def *def = w->def;
    if (!def->guess || w->rounds - w->learnt < w->learnt / 8)
        return CEDUO_OK;
    w->learnt = w->rounds;
    enum ceduo_status status = def->learn(def->context, w->chains->tried, w->chains->tried_density, w->chains->tried_count);
    w->guessing = true;
    for (size_t c = 0; c < def->chains && status == CEDUO_OK; c++)
        w->walks[c].guess = def->guess(def->context, draw_at(w->chains, c, w->chains->steps - 1));
    return status;
}

/* Room in *array for n rows of so many numbers. */
static bool make_room(double **array, size_t n, size_t numbers)
{
    double *grown = realloc(*array, n * numbers * sizeof *grown);
    *array = grown ? grown : *array;
    return grown;
}

static bool grow(struct chains *c, size_t steps)
{
    if (steps <= c->capacity)
        return true;
    size_t n = 2 * steps * c->chains;
    c->capacity = 2 * steps;
    return make_room(&c->x, n, c->dimensions) && make_room(&c->tried, n, c->dimensions) && make_room(&c->tried_density, n, 1);
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
    /* chains that go so slowly that they would have far from enough draws at their end: from an eighth of the way on less than a
     * quarter, from a quarter on less than half of what is wanted */
    double way = (double)c->steps / (double)def->steps_max;
    bool hopeless = def->stop_early && way >= 0.125 && c->effective_size / way < fmin(0.5, 2 * way) * def->effective_min;
    bool goes_on = !def->round || def->round(def->context, c->steps, c->rhat, c->effective_size);
    return c->converged || c->steps >= def->steps_max || hopeless || !goes_on;
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
        w->walks[c].random = ceduo_sequence(&w->walks[c].sequence, def->seed, c);
        status = def->density(def->context, c, def->starts + c * d, &w->walks[c].density);
    }
    w->chains->steps = 1;
    return status == CEDUO_OK ? learn(w) : status;
}

enum ceduo_status ceduo_chains_run(const struct chains_def *def, struct chains *chains)
{
    struct work w = {.def = def, .chains = chains};
    *chains = (struct chains){.dimensions = def->dimensions, .chains = def->chains, .rhat = NAN, .effective_size = NAN};
    const struct parallel round = {def->chains, def->threads, walk_chain, &w};
    enum ceduo_status status = begin(&w);
    for (bool done = false; status == CEDUO_OK && !done;) {
        status = grow(chains, chains->steps + CEDUO_CHAINS_ROUND) ? (enum ceduo_status)ceduo_parallel(&round) : CEDUO_NO_MEMORY;
        if (status != CEDUO_OK)
            break;
        chains->steps += CEDUO_CHAINS_ROUND;
        chains->tried_count += CEDUO_CHAINS_ROUND * def->chains;
        adapt(&w);
        status = learn(&w);
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
    free(c->tried);
    free(c->tried_density);
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

/* Mean squared difference of draws that lie `lag` steps apart, of chains cut in two. */
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
    size_t n = (c->steps - c->steps / 2) / 2, pieces = 2 * c->chains, stride = c->chains * c->dimensions;
    double means[2 * CEDUO_CHAINS_MAX], variances[2 * CEDUO_CHAINS_MAX], sum = 0, total = (double)(pieces * n);
    for (size_t p = 0; p < pieces; p++) { /* each chain cut in two */
        const double *x = draw_at(c, p / 2, c->steps - (p % 2 + 1) * n) + i;
        means[p] = gsl_stats_mean(x, stride, n);
        variances[p] = gsl_stats_variance_m(x, stride, n, means[p]);
    }
    double within = gsl_stats_mean(variances, 1, pieces);
    double all = within * ((double)n - 1) / (double)n + gsl_stats_variance(means, 1, pieces);
    *rhat = within > 0 ? sqrt(all / within) : NAN;
    for (size_t lag = 1; lag + 1 < n; lag += 2) { /* until two neighbours no longer agree (Geyer 1992) */
        double pair = 2 - (variogram(c, i, n, lag) + variogram(c, i, n, lag + 1)) / (2 * all);
        if (!(pair > 0))
            break;
        sum += pair;
    }
    *effective_size = total / (1 + 2 * sum); /* at most the number of draws: only sums above 0 are added */
}
