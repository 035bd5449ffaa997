/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "report.h"
#include "words.h"

static struct ceduo_measure of_1000(struct ceduo_mean_share share, double lo, double hi)
{
    return (struct ceduo_measure){.value = 1000 * share.mean,
                                  .lo = floor(1000 * lo),
                                  .hi = ceil(1000 * hi),
                                  .half = 1000 * share.half,
                                  .may_lo = NAN,
                                  .may_hi = NAN,
                                  .names = {N_("of 1000 arrive"), N_("arrive"), N_("arrive"), N_("arrive")}};
}

struct ceduo_measure ceduo_share(struct ceduo_mean_share share)
{
    return of_1000(share, fmax(0, share.mean - share.half), fmin(1, share.mean + share.half));
}

struct ceduo_measure ceduo_measure_arriving(const struct ceduo_arrivals *a)
{
    return of_1000(ceduo_share_arriving(a), a ? a->reach.lo : NAN, a ? a->reach.hi : NAN);
}

struct ceduo_measure ceduo_measure_exceeding(const struct ceduo_control *c, const struct ceduo_arrivals *a)
{
    if (isnan(c->accepted))
        return ceduo_measure_arriving(a);
    struct ceduo_measure m = of_1000(ceduo_share_exceeding(a), a ? a->exceed.lo : NAN, a ? a->exceed.hi : NAN);
    m.limit = ceduo_words_accepted(c);
    m.names[CEDUO_HEAD] = N_("of 1000 > %s kJ");
    m.names[CEDUO_SHORT_HEAD] = N_("> %s kJ");
    m.names[CEDUO_ROW] = N_("above %s kJ");
    m.names[CEDUO_PHRASE] = N_("arrive with more than %s kJ");
    return m;
}

void ceduo_measure_range(struct ceduo_measure *m, const struct ceduo_surface_fit *fit, double scale)
{
    bool known = !isnan(fit->p5), whole = m->digits == 0; /* without its value the range stays as it is */
    m->may_lo = known ? fmin(whole ? round(fit->p5 * scale) : fit->p5 * scale, m->value) : NAN;
    m->may_hi = known ? fmax(whole ? round(fit->p95 * scale) : fit->p95 * scale, m->value) : NAN;
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

void ceduo_measure_uncertainty_over(struct ceduo_measure *m, const struct ceduo_uncertainty_report *uncertainty, size_t option)
{
    if (uncertainty && uncertainty->answer && uncertainty->answer->rotation)
        set_uncertainty(m, uncertainty, option, CEDUO_UNCERTAINTY_MEAN);
}

struct ceduo_measure ceduo_measured(enum ceduo_measured what, const struct ceduo_arrivals *arrivals)
{
    static const struct {
        const char *name, *phrase;
    } names[CEDUO_MEASURED] = {[CEDUO_STOPPED] = {N_("stems stop"), N_("stopped by stems before")},
                               [CEDUO_RESTED] = {N_("at rest"), N_("at rest before")},
                               [CEDUO_GONE] = {N_("left the slope"), N_("left the slope before")},
                               [CEDUO_ENDLESS] = {N_("unfinished"), N_("never come to an end")},
                               [CEDUO_MEAN_KJ] = {N_("mean kJ"), N_("mean energy of those that arrive, kJ")},
                               [CEDUO_P95_KJ] = {N_("95 % below kJ"), N_("95 % stay below, kJ")},
                               [CEDUO_RELEASED_KJ] = {N_("kJ a rock"), N_("energy per released rock, kJ")},
                               [CEDUO_P95_HEIGHT] = {N_("95 % below m"), N_("95 % stay below, m above ground")},
                               [CEDUO_SPEED] = {N_("mean m/s"), N_("mean speed of those that arrive, m/s")},
                               [CEDUO_STEMS_HIT] = {N_("stems hit"), N_("stems hit by one that arrives")}};
    static const struct ceduo_arrivals none;
    const struct ceduo_arrivals *a = arrivals ? arrivals : &none;
    const double halves[CEDUO_MEASURED] = {[CEDUO_MEAN_KJ] = J_TO_KJ * ceduo_half_width(a->energy.se, a->reached),
                                           [CEDUO_RELEASED_KJ] =
                                               J_TO_KJ * ceduo_half_width(a->energy_per_released.se, a->released),
                                           [CEDUO_SPEED] = ceduo_half_width(a->speed.se, a->reached)};
    const double values[CEDUO_MEASURED] = {[CEDUO_STOPPED] = 1000 * a->missed[CEDUO_STOPPED_BY_STEMS],
                                           [CEDUO_RESTED] = 1000 * a->missed[CEDUO_AT_REST],
                                           [CEDUO_GONE] = 1000 * a->missed[CEDUO_LEFT_SLOPE],
                                           [CEDUO_ENDLESS] = 1000 * a->missed[CEDUO_UNFINISHED],
                                           [CEDUO_MEAN_KJ] = J_TO_KJ * a->energy.mean,
                                           [CEDUO_P95_KJ] = J_TO_KJ * a->energy.p95,
                                           [CEDUO_RELEASED_KJ] = J_TO_KJ * a->energy_per_released.mean,
                                           [CEDUO_P95_HEIGHT] = a->height.p95,
                                           [CEDUO_SPEED] = a->speed.mean,
                                           [CEDUO_STEMS_HIT] = a->contacts.mean,
                                           [CEDUO_P95_TOP] = a->top_p95};
    double value = a->released > 0 ? values[what] : NAN, half = halves[what] > 0 ? halves[what] : NAN;
    return (struct ceduo_measure){.value = value,
                                  .lo = value - half,
                                  .hi = value + half,
                                  .half = half,
                                  .may_lo = NAN,
                                  .may_hi = NAN,
                                  .digits = what < CEDUO_MEAN_KJ ? 0 : 3,
                                  .names = {names[what].name, names[what].name, names[what].name, names[what].phrase}};
}

uint64_t ceduo_released(const struct ceduo_arrivals *a)
{
    return a ? a->released : 0;
}

uint64_t ceduo_reached(const struct ceduo_arrivals *a)
{
    return a ? a->reached : 0;
}

uint64_t ceduo_unfinished(const struct ceduo_arrivals *a)
{
    return a->unfinished;
}

const struct ceduo_distribution *ceduo_spread(enum ceduo_spread what, const struct ceduo_arrivals *a)
{
    return what == CEDUO_SPREAD_SPEED ? &a->speed : what == CEDUO_SPREAD_ENERGY ? &a->energy : &a->height;
}

bool ceduo_is_close_call(const struct ceduo_arrivals *a)
{
    return a && a->exceed.lo <= a->limit && a->exceed.hi > a->limit && ceduo_energy_light(a) != CEDUO_UNKNOWN;
}

const struct ceduo_topography *ceduo_topography_at(const struct ceduo_arrivals *a)
{
    return &a->topography;
}

const struct ceduo_hazard *ceduo_hazard_at(const struct ceduo_arrivals *a)
{
    return a && !isnan(a->hazard.per_year) ? &a->hazard : NULL;
}

struct ceduo_estimate ceduo_feared(const struct ceduo_arrivals *a)
{
    return ceduo_hazard_at(a) ? ceduo_hazard_feared(&a->hazard) : CEDUO_NO_ESTIMATE;
}

const char *ceduo_measure_name(struct ceduo_measure m, enum ceduo_measure_name name, char room[CEDUO_WORDS_ROOM])
{
    LOCAL_TEXT(text);
    ceduo_append_with(&text, _(m.names[name]), SHORTEST(m.limit));
    snprintf(room, CEDUO_WORDS_ROOM, "%s", text.bytes);
    return room;
}

const char *ceduo_measure_value(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM])
{
    if (isnan(m.value) || m.digits > 0)
        return ceduo_words_shown(m.value, m.digits, room);
    snprintf(room, CEDUO_WORDS_ROOM, "%.0f", m.value);
    return room;
}

const char *ceduo_measure_span(struct ceduo_measure m, double lo, double hi, char room[CEDUO_WORDS_ROOM])
{
    struct ceduo_measure from = m, to = m;
    from.value = lo;
    to.value = hi;
    bool known = !isnan(lo) || !isnan(hi);
    snprintf(room, CEDUO_WORDS_ROOM, known ? "%s\xe2\x80\x93%s" : "-", VALUE_OF(from), VALUE_OF(to));
    return room;
}

const char *ceduo_measure_plausible_range(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM])
{
    return ceduo_measure_span(m, fmin(fmin(m.value, m.lo), m.may_lo), fmax(fmax(m.value, m.hi), m.may_hi), room);
}

const char *ceduo_measure_error(struct ceduo_measure m, const char *between, char room[CEDUO_WORDS_ROOM])
{
    bool known = !isnan(m.value) && !isnan(m.half) && m.digits == 0;
    snprintf(room, CEDUO_WORDS_ROOM, known ? "%s%s\xc2\xb1%.0f" : "%s", VALUE_OF(m), between, ceil(m.half));
    return room;
}

const char *ceduo_measure_interval(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM])
{
    bool known = !isnan(m.value) && !isnan(m.lo) && !isnan(m.hi);
    snprintf(room, CEDUO_WORDS_ROOM, known ? "%s (%s)" : "%s", VALUE_OF(m), SPAN(m, m.lo, m.hi));
    return room;
}
