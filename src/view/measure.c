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

static struct ceduo_measure energy(double mean, double half, int digits, const char *head, const char *phrase)
{
    return (struct ceduo_measure){.value = mean * J_TO_KJ,
                                  .lo = (mean - half) * J_TO_KJ,
                                  .hi = (mean + half) * J_TO_KJ,
                                  .half = NAN,
                                  .may_lo = NAN,
                                  .may_hi = NAN,
                                  .digits = digits,
                                  .names = {head, head, head, phrase}};
}

struct ceduo_measure ceduo_mean_energy(const struct ceduo_arrivals *a)
{
    return energy(a ? a->energy.mean : NAN, a ? ceduo_half_width(a->energy.se, a->reached) : NAN, 4, N_("mean kJ"),
                  N_("mean energy of those that arrive, kJ"));
}

struct ceduo_measure ceduo_energy_p95(const struct ceduo_arrivals *a)
{
    return energy(a ? a->energy.p95 : NAN, NAN, 3, N_("95 % below kJ"), N_("95 % of those stay below, kJ"));
}

struct ceduo_measure ceduo_energy_released(const struct ceduo_arrivals *a)
{
    return energy(a ? a->energy_per_released.mean : NAN, a ? ceduo_half_width(a->energy_per_released.se, a->released) : NAN, 3,
                  N_("kJ a rock"), N_("energy of a rock that starts, kJ"));
}

struct ceduo_measure ceduo_measure_stopped(const struct ceduo_arrivals *a, enum ceduo_end end)
{
    static const char *const names[CEDUO_ENDS] = {[CEDUO_STOPPED_BY_STEMS] = N_("stems stop"),
                                                  [CEDUO_AT_REST] = N_("at rest"),
                                                  [CEDUO_LEFT_SLOPE] = N_("left the slope"),
                                                  [CEDUO_UNFINISHED] = N_("unfinished")};
    struct ceduo_measure m = of_1000((struct ceduo_mean_share){a && a->released > 0 ? a->missed[end] : NAN, NAN}, NAN, NAN);
    for (int i = 0; i < CEDUO_MEASURE_NAMES; i++)
        m.names[i] = names[end];
    return m;
}

struct ceduo_measure ceduo_height_p95(const struct ceduo_arrivals *a)
{
    return energy(a ? a->height.p95 / J_TO_KJ : NAN, NAN, 3, N_("95 % below m"), N_("95 % of those stay below, m"));
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
    bool known = !isnan(m.value) && !isnan(m.half);
    snprintf(room, CEDUO_WORDS_ROOM, known ? "%s%s\xc2\xb1%.0f" : "%s", VALUE_OF(m), between, ceil(m.half));
    return room;
}

const char *ceduo_measure_interval(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM])
{
    bool known = !isnan(m.value) && !isnan(m.lo) && !isnan(m.hi);
    snprintf(room, CEDUO_WORDS_ROOM, known ? "%s (%s)" : "%s", VALUE_OF(m), SPAN(m, m.lo, m.hi));
    return room;
}
