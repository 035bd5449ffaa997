/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VERDICT_H
#define CEDUO_VERDICT_H

#include "base/arena.h"
#include "ceduo/result.h"
#include "ceduo/years.h"
#include "ceduo/yield.h"

/* The options side by side at the last control: today, over the same years ahead, and what they yield. One
 * figure is compared throughout: of the rocks released the share that arrives with too much energy, or where no
 * accepted energy is given the share that arrives. Every option has the same rocks, so each difference has an error
 * of its own.
 *
 * Two options are told apart only if they differ by CEDUO_CLEAR standard errors. That many, because the answer is
 * looked at again and again while rocks are added, among several options: what is called clear shall not be taken
 * back. */
#define CEDUO_CLEAR 3.0

/* A share of the released and half the width of its 95 % interval; NaN: not known (yet). */
struct ceduo_mean_share {
    double mean, half;
};
struct ceduo_mean_share ceduo_share_at(const struct ceduo_arrivals *arrivals); /* may be NULL */

/* Share that arrives, and share that arrives with more than the accepted energy. `arrivals` may be NULL. */
struct ceduo_mean_share ceduo_share_arriving(const struct ceduo_arrivals *arrivals);
struct ceduo_mean_share ceduo_share_exceeding(const struct ceduo_arrivals *arrivals);

/* Mean over the years at the last control of the share that is compared, from its summary. */
struct ceduo_mean_share ceduo_share_over_years(const struct ceduo_years *years, const struct ceduo_years_summary *summary);

/* The same of an option less that of the first option; NaN also where the two have not as many rocks. */
struct ceduo_estimate ceduo_share_to_first(const struct ceduo_result *result, size_t option);

/* What is known of one option. */
struct ceduo_choice {
    struct ceduo_mean_share today, worst, mean; /* worst and mean: of the years */
    const struct ceduo_years_summary *ahead;    /* of the years, at each control; NULL: not known */
    const struct ceduo_years_summary *over;     /* at the last control; years 0: not known */
    struct ceduo_mean_share rotation;           /* mean over a whole rotation, ceduo_window_compute(); NaN: not known */
    uint64_t rocks;                             /* in each of them, which may be fewer than today */
    bool energy_known;                          /* in how many of them the light of energy fails */
    bool beaten; /* another option yields as much and lets clearly fewer rocks through, or yields more and lets no more
                  * through */
    struct ceduo_window window;
    unsigned cut; /* year of the first cut if it is at most CEDUO_CUT_SOON; otherwise 0 */
    struct ceduo_yield yield;
};

#define CEDUO_CUT_SOON 5 /* years: a cut that is due */

/* Which option is best; known: all have their figure. It is judged by the rocks that all have. */
struct ceduo_leader {
    bool known;
    size_t best;
    size_t rivals; /* others that it does not clearly beat */
    bool *rival;   /* which: one for each option */
    bool equal;    /* the best and its rivals have the same forests: copies */
    bool uneven;   /* the options have different numbers of rocks: they are still computed, and none is called best */
};

/* Two options whose order today depends on the energy law (other.h): clear under one of the two laws, and the other way
 * round, by more than a standard error, under the other. */
struct ceduo_rank_reversal {
    size_t better, than; /* under the law of the scene; under the other law it is the other way round */
};

struct ceduo_verdict {
    struct arena memory;
    bool wooded, accepted; /* rocks fly through the forests; an accepted energy is given */
    bool nothing;          /* nothing can be said of any forest (ceduo_too_few_arrivals()): no option is best, no year fails */
    size_t n;
    struct ceduo_choice *choices;
    struct ceduo_leader today, rotation;
    size_t turned_count;
    struct ceduo_rank_reversal *turned;
};

/* What is said of an option at a control. */
struct ceduo_outcome {
    enum ceduo_judgement answer; /* over the window; of today if `ahead` is false */
    enum ceduo_judgement today;
    bool ahead;      /* the window has other years than today, and they are known */
    bool also_bare;  /* the slope keeps within the limit without forest, today */
    bool impossible; /* a stand has more stems than a forest can hold: it supports no yes */
    double failing, failing_lo,
        failing_hi;             /* years above the limit: 90 % range over uncertain inputs, otherwise of the rocks */
    bool uncertain;             /* the range is of uncertain inputs */
    struct ceduo_estimate rate; /* with blocks: a year, with both errors; otherwise NaN */
};

/* Judge an option at a control. `verdict` may be NULL (today alone), and `uncertainty` NULL (sampling error alone).
 *
 * Over the window: yes if no year is above the limit and the upper end of the range is 0, no if the lower end is at least 1,
 * CEDUO_DEPENDS if uncertain inputs leave it open, CEDUO_NOT_DECIDED if only the number of rocks does. With blocks by the mean rate
 * over the window against the accepted return period: yes if its upper end is within it, no if its lower end is above. */
struct ceduo_uncertainty_result;
struct ceduo_outcome ceduo_outcome_compute(const struct ceduo_result *result, const struct ceduo_verdict *verdict,
                                           const struct ceduo_uncertainty_result *uncertainty, size_t option, size_t control);

/* What a result says, and the years of each option as far as they are there: `years`, and each of them, may be NULL; `rotations`
 * likewise. CEDUO_NO_MEMORY, with nothing to free, or CEDUO_OK. */
enum ceduo_status ceduo_compare_options(const struct ceduo_result *result, struct ceduo_years *const *years,
                                        struct ceduo_years *const *rotations, struct ceduo_verdict *verdict);
void ceduo_verdict_release(struct ceduo_verdict *verdict);

#endif
