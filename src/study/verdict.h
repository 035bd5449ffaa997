/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VERDICT_H
#define CEDUO_VERDICT_H

#include "base/arena.h"
#include "ceduo/uncertainty.h"
#include "core/runs/fence.h"

/* Comparison of the options at the last control: today, over the same future years, and their yield. The judged share is the
 * share of released rocks that arrive with too much energy; without an accepted energy the share that arrives. All options have
 * the same rocks, so a difference has its own, smaller error.
 *
 * Two options differ clearly if their difference exceeds CEDUO_CLEAR standard errors. The threshold is high because several
 * options are compared repeatedly while rocks are added: a verdict, once shown, should not be reversed. */
#define CEDUO_CLEAR 3.0

/* Share of released rocks, and half the width of its 95 % interval; NaN: unknown (yet). */
struct ceduo_mean_share {
    double mean, half;
};
struct ceduo_mean_share ceduo_share_judged(const struct ceduo_arrivals *arrivals); /* may be NULL */

/* Return the share that arrives, or that arrives with more than the accepted energy. `arrivals` may be NULL. */
struct ceduo_mean_share ceduo_share_arriving(const struct ceduo_arrivals *arrivals);
struct ceduo_mean_share ceduo_share_exceeding(const struct ceduo_arrivals *arrivals);

/* Return a share of the released with the half width of its interval. `arrivals` may be NULL. */
struct ceduo_mean_share ceduo_share_of(const struct ceduo_arrivals *arrivals, struct ceduo_estimate share);

/* Return the mean over the years of the judged share at the last control, from its summary. */
struct ceduo_mean_share ceduo_share_over_years(const struct ceduo_years *years, const struct ceduo_years_summary *summary);

/* Return the judged share of an option minus that of the first option; NaN: unknown, or different numbers of rocks. */
struct ceduo_estimate ceduo_share_to_first(const struct ceduo_result *result, size_t option);

/* Results of one option. */
struct ceduo_choice {
    struct ceduo_mean_share today, worst, mean;     /* worst, mean: over the years */
    const struct ceduo_years_summary *summaries;    /* over the years, for each control; NULL: unknown */
    const struct ceduo_years_summary *last_summary; /* at the last control; years 0: unknown */
    const struct ceduo_fence_years *fences;         /* over the years, for each control; NULL: unknown */
    struct ceduo_mean_share rotation;               /* mean over a rotation, ceduo_window_compute(); NaN: unknown */
    uint64_t rocks;                                 /* per year, perhaps fewer than today */
    bool energy_known;                              /* the number of failing years is known */
    /* another option is better: its yield is not lower and its share clearly lower, or its yield is higher and its share not
     * higher */
    bool beaten;
    struct ceduo_window window;
    unsigned cut; /* year of the first cut if it is at most CEDUO_CUT_SOON; otherwise 0 */
    struct ceduo_yield yield;
};

#define CEDUO_CUT_SOON 5 /* years within which a cut is due */

/* The best option; known: all options have their figure. */
struct ceduo_leader {
    bool known;
    size_t best;
    size_t rivals; /* options that it does not clearly beat */
    bool *rival;   /* for each option */
    bool equal;    /* the best and its rivals have equal forests */
    bool uneven;   /* the options have different numbers of rocks (still computing): none is called best */
};

/* Two options whose order today depends on the energy law (alternative_law.h): clear under one law, and reversed by more than
 * one standard error under the other. */
struct ceduo_rank_reversal {
    size_t better, worse; /* under the law of the scene; reversed under the other law */
};

struct ceduo_verdict {
    struct arena memory;
    bool wooded, accepted; /* rocks are simulated with forest; an accepted energy is given */
    bool too_few_arrivals; /* ceduo_too_few_arrivals(): no option is best, no year fails */
    size_t n;
    struct ceduo_choice *choices;
    struct ceduo_leader today, rotation;
    size_t reversals_count;
    struct ceduo_rank_reversal *reversals;
};

/* Judgement of an option at a control. */
struct ceduo_outcome {
    enum ceduo_judgement answer; /* over the window if `over_years`, otherwise of today */
    enum ceduo_judgement today;
    bool over_years; /* the window has years that differ from today, and they are known */
    bool also_bare;  /* today the limit is met without forest, too */
    bool impossible; /* a stand is impossibly dense: CEDUO_JUDGEMENT_YES is not allowed */
    /* years above the limit, with the 90 % range over uncertain inputs, otherwise the sampling interval */
    double failing, failing_lo, failing_hi;
    bool uncertain;             /* the range is over uncertain inputs */
    struct ceduo_estimate rate; /* per year, with both errors; NaN: no blocks */
};

/* Judge an option at a control. `verdict` may be NULL (today only), and `uncertainty`, too (sampling error only).
 *
 * Over the window: CEDUO_JUDGEMENT_YES if no year is above the limit and the upper end of the range is 0. CEDUO_JUDGEMENT_NO if
 * the lower end is at least 1. Otherwise CEDUO_JUDGEMENT_DEPENDS if uncertain inputs leave it open, CEDUO_JUDGEMENT_NOT_DECIDED
 * if only sampling error does. With blocks the mean rate over the window is compared with the accepted return period: yes if
 * its upper end is below the limit, no if its lower end is above. */
struct ceduo_uncertainty_result;
struct ceduo_outcome ceduo_outcome_compute(const struct ceduo_result *result, const struct ceduo_verdict *verdict,
                                           const struct ceduo_uncertainty_result *uncertainty, size_t option, size_t control);

/* Add to a request the years of ceduo_scene_window(), by which options are judged, with few rocks each. */
void ceduo_verdict_add_years(struct ceduo_request *request);
/* Class of a judgement, for maps: the larger, the worse; the last one is not judged. */
enum ceduo_class {
    CEDUO_CLASS_NOT_REACHED,    /* hardly a rock arrives even without forest */
    CEDUO_CLASS_WITHOUT_FOREST, /* CEDUO_JUDGEMENT_YES, today also without forest */
    CEDUO_CLASS_FOREST,         /* CEDUO_JUDGEMENT_YES */
    CEDUO_CLASS_OPEN,
    CEDUO_CLASS_NO,
    CEDUO_CLASS_NOT_JUDGED /* no rock moves, or the scene cannot be computed */
};

#define CEDUO_MOVES_MIN 1.0 /* m from the release; if all rocks stop before, the profile or the release is wrong */

/* Return the class of a judgement, and set *why to its reason in a word. `why` NULL: no answer, and no class. */
enum ceduo_class ceduo_outcome_classify(const struct ceduo_result *result, const struct ceduo_outcome *outcome, size_t control,
                                        const char **why);

/* Compare the options of a result, with their years and rotations. `years`, `rotations` and each item of them may be NULL.
 * Return CEDUO_OK, or CEDUO_NO_MEMORY, with nothing to free. */
enum ceduo_status ceduo_compare_options(const struct ceduo_result *result, struct ceduo_years *const *years,
                                        struct ceduo_years *const *rotations, struct ceduo_verdict *verdict);
void ceduo_verdict_release(struct ceduo_verdict *verdict);

#endif
