/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains go in rounds: each walks some steps by itself, on whatever thread; then all are looked at together, the proposal is
 * renewed, and it is asked whether they agree. */
#include "chains.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/cancel.h"
#include "base/parallel.h"

#define WANTED 0.28 /* share of accepted steps */
#define INNER  100  /* steps that the guess decides, for one that the density decides */
#define PLAIN  8    /* every such step goes without the guess, so that nobody is lost where it is wrong */
#define RIDGE  1e-6 /* of the variances, so that the covariance has a root */

struct walk {
    gsl_rng *random;
    double density, guess; /* their logarithms, here */
    double moved;          /* share of accepted steps, summed over this round */
};

struct work {
    const struct chains_def *def;
    struct chains *chains;
    struct walk walks[CEDUO_CHAINS_MOST];
    gsl_matrix *root;                         /* lower triangle: of the covariance of steps */
    gsl_matrix *proposals, *normals, *trials; /* a row for each chain */
    double factor;
    bool guessing;
    size_t rounds;
};

static double *draw_at(const struct chains *c, size_t chain, size_t step)
{
    return c->x + (chain * c->room + step) * c->dimensions;
}

/* ---- one chain ---- */

/* A normal step from `from` to `to`. */
static void propose(struct work *w, size_t chain, const double *from, double *to)
{
    gsl_vector_view z = gsl_matrix_row(w->normals, chain);
    size_t d = w->def->dimensions;
    for (size_t i = 0; i < d; i++)
        gsl_vector_set(&z.vector, i, w->factor * gsl_ran_ugaussian(w->walks[chain].random));
    gsl_blas_dtrmv(CblasLower, CblasNoTrans, CblasNonUnit, w->root, &z.vector);
    for (size_t i = 0; i < d; i++)
        to[i] = from[i] + gsl_vector_get(&z.vector, i);
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
        double chance = log(gsl_rng_uniform_pos(walk->random)), there = def->guess(def->context, trial);
        if (!(chance < there - here))
            continue;
        memcpy(to, trial, def->dimensions * sizeof *to);
        here = there;
        walk->moved += 1. / INNER;
    }
    return here;
}

/* One step from the draw before; the next draw is the new place or the same once more. */
static enum ceduo_status step_on(struct work *w, size_t chain, size_t step, double *tried)
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
    double chance = log(gsl_rng_uniform_pos(walk->random));
    enum ceduo_status status = def->density(def->context, chain, to, &density);
    if (status != CEDUO_OK)
        return status;
    bool taken = chance < density - walk->density - (plain ? 0 : guess - walk->guess);
    memcpy(draw_at(w->chains, chain, step), taken ? to : here, def->dimensions * sizeof *to);
    memcpy(w->chains->tried + (size_t)(tried - w->chains->tried_density) * def->dimensions, to, def->dimensions * sizeof *to);
    *tried = density;
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
        status =
            step_on(w, c, w->chains->steps + i, w->chains->tried_density + w->chains->tried_count + c * CEDUO_CHAINS_ROUND + i);
    return (int)status;
}

/* ---- all chains ---- */

/* The covariance of all draws from the second half on, in the lower triangle of `to`. */
static void covariance_of(const struct chains *c, gsl_matrix *to)
{
    size_t n = ceduo_chains_draws(c), d = c->dimensions;
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k <= i; k++) {
            double mean_i = 0, mean_k = 0, sum = 0;
            for (size_t s = 0; s < n; s++) {
                mean_i += ceduo_chains_draw(c, s)[i] / (double)n;
                mean_k += ceduo_chains_draw(c, s)[k] / (double)n;
            }
            for (size_t s = 0; s < n; s++)
                sum += (ceduo_chains_draw(c, s)[i] - mean_i) * (ceduo_chains_draw(c, s)[k] - mean_k);
            gsl_matrix_set(to, i, k, sum / (double)(n - 1));
            gsl_matrix_set(to, k, i, sum / (double)(n - 1));
        }
}

/* The proposal of the next round; the older the chains, the less it changes. */
static void adapt(struct work *w)
{
    const struct chains_def *def = w->def;
    double accepted = 0;
    for (size_t c = 0; c < def->chains; c++) {
        accepted += w->walks[c].moved / (double)(CEDUO_CHAINS_ROUND * def->chains);
        w->walks[c].moved = 0;
    }
    w->factor *= exp((accepted - WANTED) * 2 / sqrt((double)++w->rounds));
    if (w->rounds < 2)
        return;
    covariance_of(w->chains, w->root);
    for (size_t i = 0; i < def->dimensions; i++)
        gsl_matrix_set(w->root, i, i, gsl_matrix_get(w->root, i, i) * (1 + RIDGE) + 1e-8);
    gsl_linalg_cholesky_decomp1(w->root);
}

/* The older the chains, the seldomer. */
static enum ceduo_status learn(struct work *w)
{
    const struct chains_def *def = w->def;
    bool now = w->rounds < 8 || (w->rounds & (w->rounds - 1)) == 0;
    if (!def->guess || !now)
        return CEDUO_OK;
    enum ceduo_status status = def->learn(def->context, w->chains->tried, w->chains->tried_density, w->chains->tried_count);
    w->guessing = true;
    for (size_t c = 0; c < def->chains && status == CEDUO_OK; c++)
        w->walks[c].guess = def->guess(def->context, draw_at(w->chains, c, w->chains->steps - 1));
    return status;
}

static bool grow(struct chains *c, size_t steps)
{
    if (steps <= c->room)
        return true;
    size_t room = 2 * steps;
    double *tried = realloc(c->tried, c->chains * room * c->dimensions * sizeof *tried);
    c->tried = tried ? tried : c->tried;
    double *density = realloc(c->tried_density, c->chains * room * sizeof *density);
    c->tried_density = density ? density : c->tried_density;
    double *x = tried && density ? calloc(c->chains * room * c->dimensions, sizeof *x) : NULL;
    if (!x)
        return false;
    for (size_t k = 0; k < c->chains && c->x; k++)
        memcpy(x + k * room * c->dimensions, draw_at(c, k, 0), c->steps * c->dimensions * sizeof *x);
    free(c->x);
    c->x = x;
    c->room = room;
    return true;
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

/* Whether chains go so slowly that they would have far from enough draws at their end: from an eighth of the way on less than a
 * quarter, from a quarter on less than half of what is wanted. */
static bool is_hopeless(const struct work *w)
{
    const struct chains_def *def = w->def;
    double way = (double)w->chains->steps / (double)def->steps_most;
    return def->hopeless && way >= 0.125 && w->chains->effective_size / way < fmin(0.5, 2 * way) * def->effective_least;
}

static bool is_done(struct work *w)
{
    const struct chains_def *def = w->def;
    struct chains *c = w->chains;
    if (w->rounds >= 4)
        diagnose(c, def->cancel);
    c->settled = c->steps >= def->steps_least && c->rhat < def->rhat_most && c->effective_size >= def->effective_least;
    bool goes_on = !def->round || def->round(def->context, c->steps, c->rhat, c->effective_size);
    return c->settled || c->steps >= def->steps_most || is_hopeless(w) || !goes_on;
}

static enum ceduo_status begin(struct work *w)
{
    const struct chains_def *def = w->def;
    size_t d = def->dimensions;
    enum ceduo_status status = CEDUO_OK;
    w->root = gsl_matrix_calloc(d, d);
    w->proposals = gsl_matrix_calloc(def->chains, d);
    w->normals = gsl_matrix_calloc(def->chains, d);
    w->trials = gsl_matrix_calloc(def->chains, d);
    if (!w->root || !w->proposals || !w->normals || !w->trials || !grow(w->chains, CEDUO_CHAINS_ROUND)) /* untaken 4: gsl */
        return CEDUO_NO_MEMORY;
    for (size_t i = 0; i < d; i++)
        gsl_matrix_set(w->root, i, i, def->scales[i]);
    w->factor = 2.38 / sqrt((double)d);
    for (size_t c = 0; c < def->chains && status == CEDUO_OK; c++) {
        if (!(w->walks[c].random = gsl_rng_alloc(gsl_rng_mt19937))) /* untaken: gsl */
            return CEDUO_NO_MEMORY;
        gsl_rng_set(w->walks[c].random, (unsigned long)(def->seed * CEDUO_CHAINS_MOST + c + 1));
        memcpy(draw_at(w->chains, c, 0), def->starts + c * d, d * sizeof(double));
        status = def->density(def->context, c, def->starts + c * d, &w->walks[c].density);
    }
    w->chains->steps = 1;
    return status == CEDUO_OK ? learn(w) : status;
}

static enum ceduo_status end(struct work *w, enum ceduo_status status)
{
    for (size_t c = 0; c < w->def->chains; c++)
        if (w->walks[c].random)
            gsl_rng_free(w->walks[c].random);
    gsl_matrix_free(w->root);
    gsl_matrix_free(w->proposals);
    gsl_matrix_free(w->normals);
    gsl_matrix_free(w->trials);
    return status;
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
    return end(&w, status);
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

/* Of chains cut in two: the mean of their variances W, and the variance of all estimated with that between them. */
static void variances(const struct chains *c, size_t i, size_t n, double *within, double *all)
{
    double means[2 * CEDUO_CHAINS_MOST] = {0}, mean = 0, between = 0, m = 2 * (double)c->chains;
    *within = 0;
    for (size_t p = 0; p < 2 * c->chains; p++) {
        size_t from = c->steps - (p % 2 + 1) * n;
        double variance = 0;
        for (size_t s = 0; s < n; s++)
            means[p] += draw_at(c, p / 2, from + s)[i] / (double)n;
        for (size_t s = 0; s < n; s++) {
            double d = draw_at(c, p / 2, from + s)[i] - means[p];
            variance += d * d / (double)(n - 1);
        }
        *within += variance / m;
        mean += means[p] / m;
    }
    for (size_t p = 0; p < 2 * c->chains; p++)
        between += (means[p] - mean) * (means[p] - mean) / (m - 1);
    *all = *within * ((double)n - 1) / (double)n + between;
}

/* Mean squared difference of draws that lie `lag` steps apart. */
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
    size_t n = (c->steps - c->steps / 2) / 2;
    double within, all, sum = 0, total = (double)(2 * c->chains * n);
    variances(c, i, n, &within, &all);
    *rhat = within > 0 ? sqrt(all / within) : NAN;
    for (size_t lag = 1; lag + 1 < n; lag += 2) { /* until two neighbours no longer agree (Geyer 1992) */
        double pair = 2 - (variogram(c, i, n, lag) + variogram(c, i, n, lag + 1)) / (2 * all);
        if (!(pair > 0))
            break;
        sum += pair;
    }
    *effective_size = fmin(total / (1 + 2 * sum), total);
}
