/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "core/runs/assess.h"
#include "core/runs/fence.h"
#include "core/runs/hazard.h"
#include "core/runs/statistics.h"
#include "report.h"
#include "scene/derived.h"
#include "words.h"

static struct ceduo_measure make_share(struct ceduo_mean_share share, double lo, double hi)
{
    return (struct ceduo_measure){.value = 1000 * share.mean,
                                  .lo = floor(1000 * lo),
                                  .hi = ceil(1000 * hi),
                                  .half_width = 1000 * share.half,
                                  .p5 = NAN,
                                  .p95 = NAN,
                                  .names = {N_("of 1000 arrive"), N_("arrive"), N_("arrive"), N_("arrive")}};
}

struct ceduo_measure ceduo_measure_share(struct ceduo_mean_share share)
{
    return make_share(share, fmax(0, share.mean - share.half), fmin(1, share.mean + share.half));
}

struct ceduo_measure ceduo_measure_arriving(const struct ceduo_arrivals *a)
{
    return make_share(ceduo_share_arriving(a), a ? a->reach.lo : NAN, a ? a->reach.hi : NAN);
}

struct ceduo_measure ceduo_measure_exceeding(const struct ceduo_control *c, const struct ceduo_arrivals *a)
{
    if (isnan(c->accepted))
        return ceduo_measure_arriving(a);
    struct ceduo_measure m = make_share(ceduo_share_exceeding(a), a ? a->exceed.lo : NAN, a ? a->exceed.hi : NAN);
    m.limit = ceduo_words_accepted(c);
    m.names[CEDUO_HEAD] = N_("of 1000 > %s kJ");
    m.names[CEDUO_SHORT_HEAD] = N_("> %s kJ");
    m.names[CEDUO_ROW] = N_("above %s kJ");
    m.names[CEDUO_PHRASE] = N_("arrive with more than %s kJ");
    return m;
}

void ceduo_measure_range(struct ceduo_measure *m, const struct ceduo_surface_fit *fit, double scale)
{
    bool known = !isnan(fit->p5), whole = m->digits == 0; /* the range is not rounded outside the value */
    m->p5 = known ? fmin(whole ? round(fit->p5 * scale) : fit->p5 * scale, m->value) : NAN;
    m->p95 = known ? fmax(whole ? round(fit->p95 * scale) : fit->p95 * scale, m->value) : NAN;
}

static void set_uncertainty(struct ceduo_measure *m, const struct ceduo_uncertainty_report *uncertainty, size_t option,
                            enum ceduo_uncertainty_kind kind)
{
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(uncertainty->answer, option, kind, false);
    ceduo_measure_range(m, &f->fit, 1000);
}

void ceduo_measure_uncertainty(struct ceduo_measure *m, const struct ceduo_uncertainty_report *uncertainty, size_t option,
                               size_t control)
{
    if (uncertainty && uncertainty->answer && control == ceduo_scene_last_control(&uncertainty->file->scene))
        set_uncertainty(m, uncertainty, option, m->limit > 0 ? CEDUO_UNCERTAINTY_EXCEED : CEDUO_UNCERTAINTY_REACH);
}

void ceduo_measure_mean_uncertainty(struct ceduo_measure *m, const struct ceduo_uncertainty_report *uncertainty, size_t option)
{
    if (uncertainty && uncertainty->answer && uncertainty->answer->rotation)
        set_uncertainty(m, uncertainty, option, CEDUO_UNCERTAINTY_MEAN);
}

struct ceduo_measure ceduo_measure_figure(enum ceduo_measure_kind kind, const struct ceduo_arrivals *arrivals)
{
    static const struct {
        const char *name, *phrase;
    } names[CEDUO_MEASURE_KINDS] = {[CEDUO_STOPPED] = {N_("stems stop"), N_("stopped by stems before it")},
                                    [CEDUO_RESTED] = {N_("at rest"), N_("at rest before it")},
                                    [CEDUO_GONE] = {N_("left the slope"), N_("left the slope before it")},
                                    [CEDUO_ENDLESS] = {N_("unfinished"), N_("still moving at the end")},
                                    [CEDUO_MEAN_KJ] = {N_("mean kJ"), N_("mean energy of those that arrive, kJ")},
                                    [CEDUO_P95_KJ] = {N_("95 % below kJ"), N_("95 % stay below, kJ")},
                                    [CEDUO_RELEASED_KJ] = {N_("kJ a rock"), N_("energy per released rock, kJ")},
                                    [CEDUO_P95_HEIGHT] = {N_("95 % below m"), N_("95 % stay below, m above ground")},
                                    [CEDUO_SPEED] = {N_("mean m/s"), N_("mean speed of those that arrive, m/s")},
                                    [CEDUO_STEMS_HIT] = {N_("stems hit"), N_("stems hit per arriving rock")}};
    static const struct ceduo_arrivals none;
    const struct ceduo_arrivals *a = arrivals ? arrivals : &none;
    const double half_widths[CEDUO_MEASURE_KINDS] = {[CEDUO_MEAN_KJ] = J_TO_KJ * ceduo_half_width(a->energy.se, a->reached),
                                                     [CEDUO_RELEASED_KJ] =
                                                         J_TO_KJ * ceduo_half_width(a->energy_per_released.se, a->released),
                                                     [CEDUO_SPEED] = ceduo_half_width(a->speed.se, a->reached)};
    const double values[CEDUO_MEASURE_KINDS] = {[CEDUO_STOPPED] = 1000 * a->missed[CEDUO_END_STOPPED_BY_STEMS],
                                                [CEDUO_RESTED] = 1000 * a->missed[CEDUO_END_AT_REST],
                                                [CEDUO_GONE] = 1000 * a->missed[CEDUO_END_LEFT_SLOPE],
                                                [CEDUO_ENDLESS] = 1000 * a->missed[CEDUO_END_UNFINISHED],
                                                [CEDUO_MEAN_KJ] = J_TO_KJ * a->energy.mean,
                                                [CEDUO_P95_KJ] = J_TO_KJ * a->energy.p95,
                                                [CEDUO_RELEASED_KJ] = J_TO_KJ * a->energy_per_released.mean,
                                                [CEDUO_P95_HEIGHT] = a->height.p95,
                                                [CEDUO_SPEED] = a->speed.mean,
                                                [CEDUO_STEMS_HIT] = a->contacts.mean};
    double value = a->released > 0 ? values[kind] : NAN, half_width = half_widths[kind] > 0 ? half_widths[kind] : NAN;
    return (struct ceduo_measure){.value = value,
                                  .lo = value - half_width,
                                  .hi = value + half_width,
                                  .half_width = half_width,
                                  .p5 = NAN,
                                  .p95 = NAN,
                                  .digits = kind < CEDUO_MEAN_KJ ? 0 : 3,
                                  .names = {names[kind].name, names[kind].name, names[kind].name, names[kind].phrase}};
}

const struct ceduo_fence_arrivals *ceduo_fence_find(const struct ceduo_arrivals *a)
{
    return a && a->fence && !isnan(a->fence->defeated.mean) ? a->fence : NULL;
}

struct ceduo_measure ceduo_measure_fence(enum ceduo_fence_share what, const struct ceduo_arrivals *a)
{
    static const struct {
        const char *name, *phrase;
    } names[CEDUO_FENCE_SHARES] = {[CEDUO_FENCE_ABOVE] = {N_("over the fence"), N_("pass above the fence")},
                                   [CEDUO_FENCE_THROUGH] = {N_("through it"), N_("have more energy than it holds")},
                                   [CEDUO_FENCE_BOTH] = {N_("over and through"), N_("both above and too much energy")},
                                   [CEDUO_FENCE_DEFEATED] = {N_("fence beaten"), N_("defeat the fence")},
                                   [CEDUO_FENCE_WORN] = {N_("wear it"), N_("held, with over a third of its energy")}};
    const struct ceduo_fence_arrivals *found = ceduo_fence_find(a), f = found ? *found : ceduo_fence_none();
    const struct ceduo_estimate shares[] = {f.above, f.through, f.both, f.defeated, f.worn}, share = shares[what];
    struct ceduo_measure m = make_share(ceduo_share_of(a, share), share.lo, share.hi);
    m.names[CEDUO_HEAD] = m.names[CEDUO_SHORT_HEAD] = m.names[CEDUO_ROW] = names[what].name;
    m.names[CEDUO_PHRASE] = names[what].phrase;
    return m;
}

/* Factors in UNI 11211-4: 1.02 for a good survey or a fitted model, otherwise 1.10. */
#define FACTOR(good) ((good) ? 1.02 : 1.10)

bool ceduo_designs_compute(const struct ceduo_report *report, size_t option, size_t control,
                           const struct ceduo_arrivals *wooded, struct ceduo_designs *to)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_design_values *d = &r->scene->design;
    const struct ceduo_fence_years *years = ceduo_report_fence_years(report, option, control);
    to->calibrated = ceduo_notes_print(report->file->notes, "calibrated", "slope");
    to->factors = (struct ceduo_fence_factors){.survey = FACTOR(d->survey == CEDUO_QUALITY_GOOD),
                                               .model = FACTOR(to->calibrated),
                                               .blocks = FACTOR(d->blocks == CEDUO_QUALITY_GOOD),
                                               .energy = d->fence_factor > 0 ? d->fence_factor : NAN};
    const struct ceduo_fence_arrivals none = ceduo_fence_none(), *bare = r->bare.arrivals[control].fence,
                                      *through = wooded && wooded->fence ? wooded->fence : &none;
    const struct ceduo_fence_load *const loads[CEDUO_DESIGN_KINDS] = {
        [CEDUO_DESIGN_BARE] = bare ? &bare->arriving : &none.arriving,
        [CEDUO_DESIGN_ARRIVING] = &through->arriving,
        [CEDUO_DESIGN_SYSTEM] = &through->system,
        [CEDUO_DESIGN_WORST_ARRIVING] = years ? &years->arriving : &none.arriving,
        [CEDUO_DESIGN_WORST_SYSTEM] = years ? &years->system : &none.system};
    for (size_t i = 0; i < CEDUO_DESIGN_KINDS; i++)
        to->values[i] = ceduo_fence_design(loads[i], &to->factors);
    return ceduo_design_is_requested(d);
}

const struct ceduo_fence_years *ceduo_report_fence_years(const struct ceduo_report *report, size_t option, size_t control)
{
    const struct ceduo_choice *c = ceduo_report_years_ahead(report, option);
    const struct ceduo_fence_years *years = c && c->fences ? &c->fences[control] : NULL;
    return years && years->years > 0 ? years : NULL;
}

uint64_t ceduo_rocks_released(const struct ceduo_arrivals *a)
{
    return a ? a->released : 0;
}

uint64_t ceduo_rocks_reached(const struct ceduo_arrivals *a)
{
    return a ? a->reached : 0;
}

uint64_t ceduo_rocks_unfinished(const struct ceduo_arrivals *a)
{
    return a->unfinished;
}

const struct ceduo_distribution *ceduo_arrival_distribution(enum ceduo_spread kind, const struct ceduo_arrivals *a)
{
    return kind == CEDUO_ARRIVAL_SPEED ? &a->speed : kind == CEDUO_ARRIVAL_ENERGY ? &a->energy : &a->height;
}

bool ceduo_is_close_call(const struct ceduo_arrivals *a)
{
    return a && a->exceed.lo <= a->limit && a->exceed.hi > a->limit && ceduo_energy_light(a) != CEDUO_LIGHT_UNKNOWN;
}

const struct ceduo_topography *ceduo_topography_find(const struct ceduo_arrivals *a)
{
    return &a->topography;
}

const struct ceduo_hazard *ceduo_hazard_find(const struct ceduo_arrivals *a)
{
    return a && !isnan(a->hazard.per_year) ? &a->hazard : NULL;
}

struct ceduo_estimate ceduo_judged_rate(const struct ceduo_arrivals *a)
{
    return ceduo_hazard_find(a) ? ceduo_hazard_judged_rate(&a->hazard) : CEDUO_NO_ESTIMATE;
}

const char *ceduo_measure_name(struct ceduo_measure m, enum ceduo_measure_name name, char buffer[CEDUO_WORDS_SIZE])
{
    LOCAL_TEXT(text);
    ceduo_text_append_with(&text, _(m.names[name]), LOCALIZED(m.limit));
    snprintf(buffer, CEDUO_WORDS_SIZE, "%s", text.bytes);
    return buffer;
}

const char *ceduo_measure_value(struct ceduo_measure m, char buffer[CEDUO_WORDS_SIZE])
{
    if (isnan(m.value) || m.digits > 0)
        return ceduo_words_sig(m.value, m.digits, buffer);
    snprintf(buffer, CEDUO_WORDS_SIZE, "%.0f", m.value);
    return buffer;
}

const char *ceduo_measure_span(struct ceduo_measure m, double lo, double hi, char buffer[CEDUO_WORDS_SIZE])
{
    struct ceduo_measure from = m, to = m;
    from.value = lo;
    to.value = hi;
    bool known = !isnan(lo) || !isnan(hi);
    snprintf(buffer, CEDUO_WORDS_SIZE, known ? "%s\xe2\x80\x93%s" : "-", MEASURE_VALUE(from), MEASURE_VALUE(to));
    return buffer;
}

const char *ceduo_measure_plausible_range(struct ceduo_measure m, char buffer[CEDUO_WORDS_SIZE])
{
    return ceduo_measure_span(m, fmin(fmin(m.value, m.lo), m.p5), fmax(fmax(m.value, m.hi), m.p95), buffer);
}

const char *ceduo_measure_error(struct ceduo_measure m, const char *between, char buffer[CEDUO_WORDS_SIZE])
{
    bool known = !isnan(m.value) && !isnan(m.half_width);
    struct ceduo_measure error = m;
    error.value = m.digits > 0 ? m.half_width : ceil(m.half_width);
    error.digits = m.digits > 0 ? 2 : 0;
    snprintf(buffer, CEDUO_WORDS_SIZE, known ? "%s%s\xc2\xb1%s" : "%s", MEASURE_VALUE(m), between, MEASURE_VALUE(error));
    return buffer;
}

const char *ceduo_measure_interval(struct ceduo_measure m, char buffer[CEDUO_WORDS_SIZE])
{
    bool known = !isnan(m.value) && !isnan(m.lo) && !isnan(m.hi);
    snprintf(buffer, CEDUO_WORDS_SIZE, known ? "%s (%s)" : "%s", MEASURE_VALUE(m), SPAN(m, m.lo, m.hi));
    return buffer;
}
