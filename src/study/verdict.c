/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict.h"
#include "base/language.h"
#include "core/runs/assess.h"
#include "core/runs/hazard.h"
#include "core/runs/key.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "core/runs/year_runs.h"
#include "core/stand/rotation.h"
#include "scene/derived.h"

#include <math.h>

/* The interval depends on weights if the rocks have weights. */
struct ceduo_mean_share ceduo_share_of(const struct ceduo_arrivals *a, struct ceduo_estimate share)
{
    if (!a)
        return (struct ceduo_mean_share){NAN, NAN};
    double p = share.mean, half = isnan(a->hazard.per_year)
                                      ? ceduo_share_half_width(p, ceduo_share_se(p, (double)a->released), a->released)
                                      : (share.hi - share.lo) / 2;
    return (struct ceduo_mean_share){p, half};
}

struct ceduo_mean_share ceduo_share_arriving(const struct ceduo_arrivals *a)
{
    return ceduo_share_of(a, a ? a->reach : CEDUO_NO_ESTIMATE);
}

struct ceduo_mean_share ceduo_share_exceeding(const struct ceduo_arrivals *a)
{
    return ceduo_share_of(a, a ? a->exceed : CEDUO_NO_ESTIMATE);
}

struct ceduo_mean_share ceduo_share_judged(const struct ceduo_arrivals *a)
{
    return ceduo_share_of(a, a ? ceduo_judged_share(a) : CEDUO_NO_ESTIMATE);
}

static struct ceduo_estimate judged_difference(const struct ceduo_result *r, const struct ceduo_difference *d)
{
    return isnan(r->scene->controls[r->last_control].accepted) ? d->reach : d->exceed;
}

struct ceduo_estimate ceduo_share_to_first(const struct ceduo_result *r, size_t option)
{
    return judged_difference(r, &r->options[option].differences[r->last_control]);
}

/* ---- ranking ---- */

/* Return a figure of one option minus that of another, with its standard error. */
typedef struct ceduo_estimate difference_of(const void *context, size_t option, size_t less);

static bool is_clearly_worse(difference_of *difference, const void *context, size_t option, size_t than)
{
    struct ceduo_estimate d = difference(context, option, than);
    return d.mean > CEDUO_CLEAR * d.se;
}

static void find_best(difference_of *difference, const void *context, size_t n, struct ceduo_leader *leader)
{
    leader->best = leader->rivals = 0;
    for (size_t i = 1; i < n; i++)
        if (difference(context, i, leader->best).mean < 0)
            leader->best = i;
    for (size_t i = 0; i < n; i++) {
        leader->rival[i] = i != leader->best && !is_clearly_worse(difference, context, i, leader->best);
        leader->rivals += leader->rival[i];
    }
}

/* Return the difference of two differences to the first option. If no pair differs, the error is unknown and taken as 0. */
static struct ceduo_estimate subtract_differences(struct ceduo_estimate a, struct ceduo_estimate b)
{
    double se = hypot(ceduo_pairs_are_equal(&a) ? 0 : a.se, ceduo_pairs_are_equal(&b) ? 0 : b.se);
    return (struct ceduo_estimate){a.mean - b.mean, se, NAN, NAN};
}

/* Uses the differences to the first option, which overstates the error. */
static struct ceduo_estimate difference_today(const void *context, size_t option, size_t less)
{
    struct ceduo_estimate a = ceduo_share_to_first(context, option), b = ceduo_share_to_first(context, less);
    return subtract_differences(a, b);
}

static struct ceduo_estimate difference_by_alternative_law(const void *context, size_t option, size_t less)
{
    const struct ceduo_result *r = context;
    const struct ceduo_alternative_energy *one = &r->options[option].alternatives[r->last_control];
    const struct ceduo_alternative_energy *two = &r->options[less].alternatives[r->last_control];
    if (!one->known || !two->known || (one->model != two->model && one->stems && two->stems))
        return CEDUO_NO_ESTIMATE;
    return subtract_differences(judged_difference(r, &one->to_first), judged_difference(r, &two->to_first));
}

static struct ceduo_estimate difference_over_years(const void *context, size_t option, size_t less)
{
    struct ceduo_years *const *years = context;
    return ceduo_years_difference(years[option], years[less]);
}

/* ---- one option ---- */

struct ceduo_mean_share ceduo_share_over_years(const struct ceduo_years *years, const struct ceduo_years_summary *s)
{
    struct ceduo_estimate mean = isnan(s->exceed.mean) ? s->reach : s->exceed;
    return (struct ceduo_mean_share){mean.mean, ceduo_share_half_width(mean.mean, mean.se, years->rocks)};
}

static void read_fences(const struct ceduo_result *r, const struct ceduo_years *years, size_t option, struct arena *memory,
                        struct ceduo_choice *c)
{
    size_t controls = years->scene.controls_count;
    struct ceduo_fence_years *fences = ceduo_arena_alloc(memory, controls * sizeof *fences);
    if (!fences || !ceduo_result_wooded(r, option, 0)) /* untaken: memory */
        return;
    for (size_t k = 0; k < controls; k++)
        fences[k] = ceduo_years_fence(years, k, ceduo_result_wooded(r, option, k));
    c->fences = fences;
}

static void read_years(const struct ceduo_years *years, struct arena *memory, struct ceduo_choice *c)
{
    size_t controls = years->scene.controls_count;
    struct ceduo_years_summary *summaries = ceduo_arena_alloc(memory, controls * sizeof *summaries);
    if (!summaries) /* untaken: memory */
        return;
    for (size_t k = 0; k < controls; k++)
        summaries[k] = ceduo_years_summarize(years, k);
    c->summaries = summaries;
    c->last_summary = &summaries[years->last_control];
    c->rocks = years->rocks;
    c->energy_known &= !c->last_summary->nothing;
    c->worst.mean = c->last_summary->worst; /* with the index an ADC, which has no error */
    for (size_t i = 0; i < years->count; i++)
        if (years->years[i].year == c->last_summary->worst_year && years->years[i].wooded.rocks > 0)
            c->worst = ceduo_share_judged(&years->years[i].wooded.arrivals[years->last_control]);
    c->mean = ceduo_share_over_years(years, c->last_summary);
}

/* Return the year of the next cut if it is due within CEDUO_CUT_SOON, otherwise 0. */
static unsigned due_cut(const struct ceduo_option *option)
{
    unsigned due = 0;
    for (size_t i = 0; i < option->belts_count; i++) {
        unsigned first = ceduo_first_cut(&option->belts[i].stand, option->belts[i].cut_year);
        if (first <= CEDUO_CUT_SOON && first > 0 && (due == 0 || first < due))
            due = first;
    }
    return due;
}

static enum ceduo_status read_choice(const struct ceduo_result *r, const struct ceduo_years *years,
                                     const struct ceduo_years *full, size_t option, struct arena *memory,
                                     struct ceduo_choice *c)
{
    static const struct ceduo_years_summary no_years;
    const struct ceduo_mean_share unknown = {NAN, NAN};
    const struct ceduo_option *o = &r->scene->options[option];
    struct ceduo_window rotation = ceduo_window_compute(o);
    *c = (struct ceduo_choice){
        .today = unknown, .worst = unknown, .mean = unknown, .rotation = unknown, .last_summary = &no_years, .cut = due_cut(o)};
    c->window = years ? years->window : ceduo_scene_window(r->scene);
    if (r->scene->controls_count > 0) {
        c->today = ceduo_share_judged(ceduo_result_wooded(r, option, r->last_control));
        c->energy_known = r->wooded && !isnan(r->scene->controls[r->last_control].accepted);
        if (years)
            read_years(years, memory, c);
        if (years && c->window.kind != CEDUO_WINDOW_CONSTANT)
            read_fences(r, years, option, memory, c);
        if (full) {
            const struct ceduo_years_summary s = ceduo_years_summarize(full, full->last_control);
            c->rotation = ceduo_share_over_years(full, &s);
        }
    }
    unsigned end = rotation.last + 1, max = end + CEDUO_PERIOD_MAX;
    unsigned last = c->window.last < end ? end : c->window.last < max ? c->window.last : max;
    return ceduo_yield_compute(o, last, &c->yield);
}

/* ---- all options ---- */

static bool is_beaten(struct ceduo_years *const *years, const struct ceduo_verdict *v, size_t option)
{
    double yield = v->choices[option].yield.cut_per_year;
    for (size_t i = 0; i < v->n; i++) {
        double rival_yield = v->choices[i].yield.cut_per_year;
        bool clear = is_clearly_worse(difference_over_years, years, option, i);
        if (i != option && rival_yield >= yield &&
            (clear || (rival_yield > yield && difference_over_years(years, option, i).mean >= 0)))
            return true;
    }
    return false;
}

/* Return by how many standard errors an option is worse than `better`. */
static double errors_worse(difference_of *difference, const void *context, size_t option, size_t better)
{
    struct ceduo_estimate d = difference(context, option, better);
    return d.mean / d.se;
}

/* Find pairs whose order is clear under one energy law, and reversed by more than one standard error under the other. */
static void find_reversals(const struct ceduo_result *r, struct ceduo_verdict *v)
{
    size_t capacity = 0;
    for (size_t i = 0; i < v->n; i++)
        for (size_t k = 0; k < v->n; k++) {
            double current = errors_worse(difference_today, r, k, i),
                   reversed = errors_worse(difference_by_alternative_law, r, i, k);
            if (i == k || !(current > 1 && reversed > 1 && fmax(current, reversed) > CEDUO_CLEAR)) /* NaN: not comparable */
                continue;
            v->reversals = ceduo_arena_grow(&v->memory, v->reversals, v->reversals_count, 1, &capacity, sizeof *v->reversals);
            if (v->memory.failed) /* untaken: memory */
                return;
            v->reversals[v->reversals_count++] = (struct ceduo_rank_reversal){i, k};
        }
}

static uint64_t count_rocks(const struct ceduo_result *r, struct ceduo_years *const *years, size_t option)
{
    return years ? years[option]->rocks : r->options[option].wooded.rocks;
}

/* `years` NULL: today. */
static void find_leader(const struct ceduo_result *r, struct ceduo_years *const *years, const struct ceduo_verdict *v,
                        struct ceduo_leader *leader)
{
    leader->known = v->n > 1;
    for (size_t i = 0; i < v->n && leader->known; i++)
        leader->known = !isnan(years ? v->choices[i].mean.mean : v->choices[i].today.mean);
    for (size_t i = 0; i < v->n && leader->known; i++) {
        leader->known = years || !isnan(difference_today(r, i, 0).mean);
        leader->uneven |= count_rocks(r, years, i) != count_rocks(r, years, 0);
    }
    if (!leader->known)
        return;
    difference_of *difference = years ? difference_over_years : difference_today;
    const void *context = years ? (const void *)years : r;
    find_best(difference, context, v->n, leader);
    leader->equal = leader->rivals > 0;
    for (size_t i = 0; i < v->n; i++) { /* equal forests, today or in all years */
        const struct ceduo_option *one = &r->scene->options[i], *best = &r->scene->options[leader->best];
        bool same = years ? ceduo_years_key(one) == ceduo_years_key(best)
                          : ceduo_option_key(r->scene, one) == ceduo_option_key(r->scene, best);
        leader->equal &= !leader->rival[i] || (same && difference(context, i, leader->best).mean == 0);
    }
}

/* ---- one option at one control ---- */

/* Judge today, by the sampling error and the 90 % range of uncertain inputs. */
static enum ceduo_judgement judge_today(const struct ceduo_result *r, const struct ceduo_uncertainty_result *uncertainty,
                                        size_t option, size_t control)
{
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control], *wooded = ceduo_result_wooded(r, option, control);
    enum ceduo_judgement judgement = ceduo_judge_control(bare, wooded);
    if (judgement == CEDUO_JUDGEMENT_CANNOT_JUDGE || judgement == CEDUO_JUDGEMENT_UNANSWERED || !wooded || !uncertainty ||
        control != r->last_control)
        return judgement;
    const struct ceduo_surface_fit *fit =
        &ceduo_uncertainty_find_figure(uncertainty, option, CEDUO_UNCERTAINTY_EXCEED, false)->fit;
    double share = wooded->exceed.mean; /* the range includes it */
    return fmin(fit->p5, share) <= wooded->limit && fmax(fit->p95, share) > wooded->limit ? CEDUO_JUDGEMENT_DEPENDS : judgement;
}

/* Judge the years by the number of years above the limit. */
static enum ceduo_judgement judge_years(const struct ceduo_years_summary *s, const struct ceduo_outcome *o)
{
    if (o->uncertain && o->failing_lo < 1 && o->failing_hi >= 1)
        return CEDUO_JUDGEMENT_DEPENDS;
    return s->failing_hi == 0 ? CEDUO_JUDGEMENT_YES : s->failing_lo > 0 ? CEDUO_JUDGEMENT_NO : CEDUO_JUDGEMENT_NOT_DECIDED;
}

/* Judge by the rate: the mean over the years, or today's. */
static enum ceduo_judgement judge_rate(const struct ceduo_result *r, const struct ceduo_surface_fit *fit, size_t control,
                                       struct ceduo_outcome *o)
{
    double limit = 1 / ceduo_accepted_return(&r->scene->controls[control]);
    double per_year = limit / ceduo_exceed_limit(r->scene, &r->scene->controls[control]);
    if (fit && !isnan(fit->p5)) {
        o->uncertain = true;
        o->rate.lo = fmin(o->rate.lo, per_year * fit->p5);
        o->rate.hi = fmax(o->rate.hi, per_year * fit->p95);
        if (per_year * fit->p5 <= limit && per_year * fit->p95 > limit)
            return CEDUO_JUDGEMENT_DEPENDS;
    }
    return o->rate.hi <= limit ? CEDUO_JUDGEMENT_YES : o->rate.lo > limit ? CEDUO_JUDGEMENT_NO : CEDUO_JUDGEMENT_NOT_DECIDED;
}

static bool has_impossible_stand(const struct ceduo_result *r, size_t option, size_t control)
{
    bool impossible = false;
    for (size_t i = 0; i < r->scene->options[option].belts_count; i++)
        if (r->scene->options[option].belts[i].from < r->scene->controls[control].x)
            impossible |= (r->options[option].stands[i].warnings & (CEDUO_WARNING_BASAL_AREA | CEDUO_WARNING_MANY_SHOOTS)) != 0;
    return impossible;
}

struct ceduo_outcome ceduo_outcome_compute(const struct ceduo_result *r, const struct ceduo_verdict *v,
                                           const struct ceduo_uncertainty_result *uncertainty, size_t option, size_t control)
{
    const struct ceduo_choice *c = v && option < v->n && v->choices[option].summaries ? &v->choices[option] : NULL;
    const struct ceduo_years_summary *s = c ? &c->summaries[control] : NULL;
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, control);
    bool blocks = r->scene->blocks_count > 0, last = control == r->last_control;
    enum ceduo_judgement today = judge_today(r, uncertainty, option, control);
    struct ceduo_outcome o = {.answer = today,
                              .today = today,
                              .over_years = s && s->simulated > 0 && c->window.kind != CEDUO_WINDOW_CONSTANT,
                              .also_bare = ceduo_judge_control(&r->bare.arrivals[control], NULL) == CEDUO_JUDGEMENT_YES,
                              .rate = CEDUO_NO_ESTIMATE};
    bool years = last && uncertainty && uncertainty->rotation;
    if (today == CEDUO_JUDGEMENT_UNANSWERED || today == CEDUO_JUDGEMENT_CANNOT_JUDGE)
        return o;
    if (o.over_years) {
        const struct ceduo_surface_fit *fit =
            years ? &ceduo_uncertainty_find_figure(uncertainty, option, CEDUO_UNCERTAINTY_FAILING, false)->fit : NULL;
        o.uncertain = fit && !isnan(fit->p5);
        o.failing = (double)s->unprotected_energy;
        o.failing_lo = fmin(o.failing, o.uncertain ? round(fit->p5) : (double)s->failing_lo);
        o.failing_hi = fmax(o.failing, o.uncertain ? round(fit->p95) : (double)s->failing_hi);
        o.answer = judge_years(s, &o);
    }
    if (blocks && wooded) {
        enum ceduo_uncertainty_kind kind = o.over_years ? CEDUO_UNCERTAINTY_MEAN : CEDUO_UNCERTAINTY_EXCEED;
        o.rate = o.over_years ? s->rate : ceduo_hazard_judged_rate(&wooded->hazard);
        o.answer = judge_rate(r,
                              last && uncertainty && (years || !o.over_years)
                                  ? &ceduo_uncertainty_find_figure(uncertainty, option, kind, false)->fit
                                  : NULL,
                              control, &o);
    }
    o.impossible = o.answer == CEDUO_JUDGEMENT_YES && has_impossible_stand(r, option, control);
    o.answer = o.impossible ? CEDUO_JUDGEMENT_CANNOT_JUDGE : o.answer;
    o.today = o.impossible && !o.over_years ? CEDUO_JUDGEMENT_CANNOT_JUDGE : today;
    return o;
}

/* ---- classes ---- */

/* True if every rock without forest rests near the release. */
static bool hardly_moves(const struct ceduo_result *r)
{
    const struct ceduo_ends *ends = &r->bare.ends;
    return ends->count[CEDUO_END_AT_REST] == r->bare.rocks &&
           ends->stop_max - ceduo_scene_release_last(r->scene) < CEDUO_MOVES_MIN;
}

enum ceduo_class ceduo_outcome_classify(const struct ceduo_result *r, const struct ceduo_outcome *o, size_t control,
                                        const char **why)
{
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control];
    const struct {
        bool applies;
        enum ceduo_class class;
        const char *why;
    } classes[] = {
        {o->answer == CEDUO_JUDGEMENT_UNANSWERED, CEDUO_CLASS_NOT_JUDGED, NULL},
        {o->impossible, CEDUO_CLASS_OPEN, N_("impossible-stand")},
        {o->answer == CEDUO_JUDGEMENT_CANNOT_JUDGE && hardly_moves(r), CEDUO_CLASS_NOT_JUDGED, N_("no-rock-moves")},
        {o->answer == CEDUO_JUDGEMENT_CANNOT_JUDGE && ceduo_terrain(bare) == CEDUO_TERRAIN_CONTRADICTS, CEDUO_CLASS_OPEN,
         N_("contradicts-terrain")},
        {o->answer == CEDUO_JUDGEMENT_CANNOT_JUDGE, CEDUO_CLASS_NOT_REACHED, N_("not-reached")},
        {o->answer == CEDUO_JUDGEMENT_NOT_DECIDED, CEDUO_CLASS_OPEN, N_("sampling-error")},
        {o->answer == CEDUO_JUDGEMENT_DEPENDS, CEDUO_CLASS_OPEN, N_("uncertain-inputs")},
        {o->answer == CEDUO_JUDGEMENT_NO && o->today == CEDUO_JUDGEMENT_YES, CEDUO_CLASS_NO, N_("exceeds-later")},
        {o->answer == CEDUO_JUDGEMENT_NO, CEDUO_CLASS_NO, N_("exceeds")},
        {ceduo_judge_control(bare, NULL) == CEDUO_JUDGEMENT_YES, CEDUO_CLASS_WITHOUT_FOREST, N_("without-forest")},
        {true, CEDUO_CLASS_FOREST, N_("forest")},
    };
    size_t i = 0;
    while (!classes[i].applies)
        i++;
    *why = classes[i].why;
    return classes[i].class;
}

/* ---- comparison ---- */

#define YEAR_ROCKS 1000 /* of each year: the error of a share near the limit is 14 of 1000 */
#define YEARS_MAX  60   /* of a longer window, only some years are simulated */

void ceduo_verdict_add_years(struct ceduo_request *request)
{
    request->years = request->years_independent = true;
    request->year_rocks = YEAR_ROCKS;
    request->years_max = YEARS_MAX;
}

enum ceduo_status ceduo_compare_options(const struct ceduo_result *r, struct ceduo_years *const *years,
                                        struct ceduo_years *const *rotations, struct ceduo_verdict *v)
{
    size_t n = r->options_count;
    *v = (struct ceduo_verdict){
        .wooded = r->wooded && r->scene->controls_count > 0,
        .accepted = r->scene->controls_count > 0 && !isnan(r->scene->controls[r->last_control].accepted),
        .too_few_arrivals = r->scene->controls_count > 0 && ceduo_too_few_arrivals(&r->bare.arrivals[r->last_control]),
    };
    v->choices = ceduo_arena_alloc(&v->memory, (n + 1) * sizeof *v->choices);
    v->today.rival = ceduo_arena_alloc(&v->memory, (n + 1) * sizeof *v->today.rival);
    v->rotation.rival = ceduo_arena_alloc(&v->memory, (n + 1) * sizeof *v->rotation.rival);
    enum ceduo_status status = v->memory.failed ? CEDUO_NO_MEMORY : CEDUO_OK;
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        status = read_choice(r, years ? years[i] : NULL, rotations ? rotations[i] : NULL, i, &v->memory, &v->choices[i]);
        v->n = i + 1;
    }
    if (status == CEDUO_OK && !v->too_few_arrivals) {
        find_leader(r, NULL, v, &v->today);
        if (years)
            find_leader(r, years, v, &v->rotation);
        for (size_t i = 0; i < n && v->rotation.known; i++)
            v->choices[i].beaten = is_beaten(years, v, i);
        if (v->wooded)
            find_reversals(r, v);
    }
    if (v->memory.failed)
        status = CEDUO_NO_MEMORY;
    if (status != CEDUO_OK)
        ceduo_verdict_release(v);
    return status;
}

void ceduo_verdict_release(struct ceduo_verdict *v)
{
    for (size_t i = 0; i < v->n; i++)
        ceduo_yield_release(&v->choices[i].yield);
    ceduo_arena_free(&v->memory);
    *v = (struct ceduo_verdict){0};
}
