/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search for the value at which a goal crosses its target. Both ends are evaluated; where they agree, so are some values
 * between them. Then the bracket around one crossing is narrowed by Brent's method, and by bisection where that does not help.
 * All samples are kept, sorted: none is evaluated twice, and they tell whether the goal turns. */
#include "ceduo/find.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "check_study.h"

#define SAMPLES_MAX 128   /* bisection alone needs at most 54, the ends and the scan 10 */
#define BRENT_MAX   12    /* values for Brent's method, then bisection has to do the rest */
#define PROBE       0.9   /* of the tolerance: a step across the root */
#define ROUNDING    1e-12 /* relative: no turn of a goal */

struct sample {
    double value, goal;
};

struct search {
    const struct ceduo_find_def *def;
    double lo, hi;
    enum ceduo_status status; /* once it is not CEDUO_OK nothing more is evaluated */
    size_t count;
    struct sample samples[SAMPLES_MAX]; /* by value */
};

/* A value that fails and one that passes, between which the goal crosses its target. */
struct bracket {
    struct sample fail, pass;
};

/* ---- evaluating ---- */

static bool passes(const struct search *h, double goal)
{
    return goal <= h->def->target;
}

static bool evaluate(struct search *h, double value, double *goal)
{
    size_t i = 0;
    while (i < h->count && h->samples[i].value < value)
        i++;
    if (i < h->count && h->samples[i].value == value) {
        *goal = h->samples[i].goal;
        return true;
    }
    if (h->status == CEDUO_OK && ceduo_cancelled(h->def->cancel))
        h->status = CEDUO_CANCELLED;
    if (h->status != CEDUO_OK || h->count == SAMPLES_MAX)
        return false;
    *goal = NAN;
    h->status = h->def->goal(h->def->context, value, goal);
    if (h->status != CEDUO_OK)
        return false;
    memmove(&h->samples[i + 1], &h->samples[i], (h->count - i) * sizeof h->samples[0]);
    h->samples[i] = (struct sample){value, *goal};
    h->count++;
    return true;
}

/* Evaluates a value, and narrows the bracket if it lies strictly inside; false if that failed or it does not. */
static bool narrow(struct search *h, struct bracket *b, double value)
{
    double lo = fmin(b->fail.value, b->pass.value), hi = fmax(b->fail.value, b->pass.value), goal;
    if (!evaluate(h, value, &goal) || !(value > lo && value < hi))
        return false;
    *(passes(h, goal) ? &b->pass : &b->fail) = (struct sample){value, goal};
    return true;
}

static double width_of(const struct bracket *b)
{
    return fabs(b->pass.value - b->fail.value);
}

/* ---- narrowing ---- */

struct brent {
    struct search *search;
    struct bracket *bracket;
    bool broken; /* what GSL was told last is made up */
};

/* GSL aborts the program where a function is not finite, so it never sees such a value. */
static double brent_goal(double value, void *context)
{
    struct brent *b = context;
    double goal = NAN;
    if (evaluate(b->search, value, &goal))
        narrow(b->search, b->bracket, value);
    double above = goal - b->search->def->target;
    if (isfinite(above))
        return above;
    b->broken = true;
    return 1;
}

/* Until the bracket is as narrow as `width`, the steps `left` are used up, or it gets no further. The solver is made by
 * hand because GSL's own allocation aborts the program without memory. */
static void brent(struct search *h, struct bracket *b, double width, unsigned *left)
{
    struct brent context = {.search = h, .bracket = b};
    gsl_function function = {.function = brent_goal, .params = &context};
    gsl_root_fsolver solver = {.type = gsl_root_fsolver_brent, .state = calloc(1, gsl_root_fsolver_brent->size)};
    if (!solver.state) {
        h->status = CEDUO_NO_MEMORY;
        return;
    }
    gsl_root_fsolver_set(&solver, &function, fmin(b->fail.value, b->pass.value), fmax(b->fail.value, b->pass.value));
    double before = NAN;
    while (*left > 0 && width_of(b) > width) {
        --*left;
        gsl_root_fsolver_iterate(&solver); /* fails only where a function is not finite */
        if (context.broken)
            break;
        if (fabs(solver.root - before) < width) { /* it comes from one side: a step across closes the bracket */
            double other = solver.root == b->pass.value ? b->fail.value : b->pass.value;
            narrow(h, b, solver.root + copysign(PROBE * width, other - solver.root));
            *left -= *left > 0;
            break;
        }
        before = solver.root;
    }
    free(solver.state);
}

static void close_in(struct search *h, struct bracket *b)
{
    double share = h->def->tolerance > 0 ? fmax(h->def->tolerance, DBL_EPSILON) : CEDUO_FIND_TOLERANCE;
    double width = h->def->whole ? 1 : share * (h->hi - h->lo);
    unsigned left = h->def->whole ? 0 : BRENT_MAX;
    while (h->status == CEDUO_OK && width_of(b) > width) {
        double fail = b->fail.goal - h->def->target, pass = b->pass.goal - h->def->target;
        if (left > 0 && isfinite(fail) && isfinite(pass) && b->pass.goal != h->def->target)
            brent(h, b, width, &left);
        double half = h->def->whole ? floor(width_of(b) / 2) : width_of(b) / 2;
        if (width_of(b) > width && !narrow(h, b, fmin(b->fail.value, b->pass.value) + half))
            break;
    }
}

/* ---- the search ---- */

static void find_crossing(struct search *h, struct ceduo_found *found)
{
    double at_lo, at_hi;
    if (!evaluate(h, h->lo, &at_lo) || !evaluate(h, h->hi, &at_hi))
        return;
    bool lo = passes(h, at_lo), hi = passes(h, at_hi);
    for (int i = 1; lo == hi && i <= CEDUO_FIND_SCAN; i++) {
        double value = h->lo + (h->hi - h->lo) * i / (CEDUO_FIND_SCAN + 1), goal;
        evaluate(h, h->def->whole ? round(value) : value, &goal);
    }
    size_t failing = h->count, first = 0; /* up to the last sample that fails; the first that passes */
    while (failing > 0 && passes(h, h->samples[failing - 1].goal))
        failing--;
    while (first < h->count && !passes(h, h->samples[first].goal))
        first++;
    if (h->status != CEDUO_OK || first == h->count)
        return;
    struct bracket b = {.pass = h->samples[0]};
    found->side = lo && !hi ? CEDUO_LARGEST : CEDUO_SMALLEST;
    found->whole_range = failing == 0;
    if (!found->whole_range) {
        if (lo && !hi)
            b.fail = h->samples[h->count - 1];
        else if (lo)
            b = (struct bracket){.fail = h->samples[failing - 1], .pass = h->samples[failing]};
        else
            b = (struct bracket){.fail = h->samples[first - 1], .pass = h->samples[first]};
        close_in(h, &b);
    }
    if (h->status != CEDUO_OK)
        return;
    found->found = true;
    found->monotone = lo != hi || found->whole_range;
    found->value = b.pass.value;
    found->goal_at_value = b.pass.goal;
}

/* Whether the goal turns, and where it is least. */
static void read_samples(const struct search *h, struct ceduo_found *found)
{
    bool rises = false, falls = false;
    found->evaluations = (unsigned)h->count;
    for (size_t i = 0; i < h->count; i++) {
        double before = h->samples[i > 0 ? i - 1 : 0].goal, now = h->samples[i].goal;
        double rounding = isfinite(before) && isfinite(now) ? ROUNDING * fmax(fabs(before), fabs(now)) : 0;
        rises |= isnan(now) || now > before + rounding;
        falls |= isnan(now) || now < before - rounding;
        if (isnan(now) || now >= found->goal_at_nearest)
            continue;
        found->nearest = h->samples[i].value;
        found->goal_at_nearest = now;
    }
    found->monotone = found->monotone && !(rises && falls);
}

struct ceduo_find_def ceduo_find_def_default(void)
{
    return (struct ceduo_find_def){.hi = 1};
}

enum ceduo_status ceduo_find(const struct ceduo_find_def *def, struct ceduo_found *found)
{
    GSL_RETURNS_ERRORS;
    *found = (struct ceduo_found){.value = NAN, .goal_at_value = NAN, .monotone = true, .nearest = NAN, .goal_at_nearest = NAN};
    struct search h = {.def = def, .lo = def->whole ? ceil(def->lo) : def->lo, .hi = def->whole ? floor(def->hi) : def->hi};
    h.status = ceduo_check_find_def(def);
    if (h.lo <= h.hi && h.status == CEDUO_OK)
        find_crossing(&h, found);
    read_samples(&h, found);
    return h.status;
}
