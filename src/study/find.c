/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Search for the value at which a goal crosses its target. Evaluates both ends; if they agree, some values between them, too.
 * Bisection then narrows the bracket around one crossing. All samples are kept, sorted: no value is evaluated twice, and they
 * show if the goal turns. */

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "check_study.h"

#define SAMPLES_MAX 128   /* bisection needs at most 54, the ends and the scan 10 */
#define ROUNDING    1e-12 /* relative; smaller changes of a goal are not turns */

struct sample {
    double value, goal;
};

struct search {
    const struct ceduo_find_def *def;
    double lo, hi;
    enum ceduo_status status; /* unless CEDUO_OK, nothing is evaluated any longer */
    size_t count;
    struct sample samples[SAMPLES_MAX]; /* sorted by value */
};

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

/* Bisect between a sample that passes and one that fails. Return the last that passes. */
static struct sample bisect(struct search *h, struct sample pass, struct sample fail)
{
    double tolerance = h->def->tolerance > 0 ? fmax(h->def->tolerance, DBL_EPSILON) : CEDUO_FIND_TOLERANCE;
    double width = h->def->whole ? 1 : tolerance * (h->hi - h->lo), goal;
    for (double distance; (distance = fabs(pass.value - fail.value)) > width;) {
        double lo = fmin(fail.value, pass.value), value = lo + (h->def->whole ? floor(distance / 2) : distance / 2);
        if (!(value > lo && value < lo + distance) || !evaluate(h, value, &goal))
            break;
        *(passes(h, goal) ? &pass : &fail) = (struct sample){value, goal};
    }
    return pass;
}

static void find_crossing(struct search *h, struct ceduo_found *found)
{
    double goal_lo, goal_hi;
    if (!evaluate(h, h->lo, &goal_lo) || !evaluate(h, h->hi, &goal_hi))
        return;
    bool lo = passes(h, goal_lo), hi = passes(h, goal_hi);
    for (int i = 1; lo == hi && i <= CEDUO_FIND_SCAN; i++) {
        double value = h->lo + (h->hi - h->lo) * i / (CEDUO_FIND_SCAN + 1), goal;
        evaluate(h, h->def->whole ? round(value) : value, &goal);
    }
    size_t failing = h->count, first = 0; /* samples up to the last that fails; the first that passes */
    while (failing > 0 && passes(h, h->samples[failing - 1].goal))
        failing--;
    while (first < h->count && !passes(h, h->samples[first].goal))
        first++;
    if (h->status != CEDUO_OK || first == h->count)
        return;
    const struct sample *crossing = &h->samples[lo && hi && failing > 0 ? failing : first];
    struct sample pass = *crossing;
    found->side = lo && !hi ? CEDUO_SIDE_LARGEST : CEDUO_SIDE_SMALLEST;
    found->whole_range = failing == 0;
    if (!found->whole_range)
        pass = bisect(h, pass, lo && !hi ? crossing[1] : crossing[-1]);
    if (h->status != CEDUO_OK)
        return;
    found->found = true;
    found->monotone = lo != hi || found->whole_range;
    found->value = pass.value;
    found->goal_at_value = pass.goal;
}

/* Set if the goal is monotone, and its smallest sample. */
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
    return (struct ceduo_find_def){.size = sizeof(struct ceduo_find_def), .hi = 1};
}

enum ceduo_status ceduo_find(const struct ceduo_find_def *def, struct ceduo_found *found)
{
    *found = (struct ceduo_found){.value = NAN, .goal_at_value = NAN, .monotone = true, .nearest = NAN, .goal_at_nearest = NAN};
    enum ceduo_status status = ceduo_check_find_def(def);
    if (status != CEDUO_OK)
        return status;
    struct search h = {.def = def, .lo = def->whole ? ceil(def->lo) : def->lo, .hi = def->whole ? floor(def->hi) : def->hi};
    if (h.lo <= h.hi)
        find_crossing(&h, found);
    read_samples(&h, found);
    return h.status;
}
