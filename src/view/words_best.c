/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Best option in sentences, and the effect of the other energy law. */
#include <math.h>

#include "base/language.h"
#include "core/runs/result.h"
#include "report.h"
#include "scene/choices.h"
#include "scene/stand.h"
#include "words.h"

/* ---- compared years ---- */

/* Return the window, which is common to all options. */
static const struct ceduo_window *get_window(const struct ceduo_verdict *v)
{
    return &v->choices[0].window;
}

void ceduo_words_window(struct text *text, const struct ceduo_option *option)
{
    const struct ceduo_belt *standing = NULL;
    enum ceduo_window_kind kind = ceduo_window_compute(option).kind;
    for (size_t i = 0; i < option->belts_count; i++)
        if (!standing && !ceduo_stand_is_bare(&option->belts[i].stand))
            standing = &option->belts[i];
    if (kind == CEDUO_WINDOW_AHEAD)
        ceduo_text_format(text, _("'%s' grows and is never cut."), NAME_OF(option));
    else if (kind == CEDUO_WINDOW_CONSTANT && !standing)
        ceduo_text_format(text, _("'%s' does not change: it has no stems."), NAME_OF(option));
    else if (kind == CEDUO_WINDOW_CONSTANT)
        ceduo_text_format(text,
                          standing->stand.cutting.rotation > 0
                              ? _("'%s' does not change: stand '%s' has no growth data for its stems.")
                              : _("'%s' does not change: stand '%s' has no growth and cutting data."),
                          NAME_OF(option), NAME_OF(standing));
}

void ceduo_words_windows(const struct ceduo_scene *scene, ceduo_sentence_sink *sink, void *context)
{
    for (size_t i = 0; i < scene->options_count; i++) {
        LOCAL_TEXT(sentence);
        ceduo_words_window(&sentence, &scene->options[i]);
        if (sentence.length > 0)
            sink(context, sentence.bytes);
    }
}

void ceduo_words_years_summary(struct text *text, const struct ceduo_result *r, const struct ceduo_years *years)
{
    const struct ceduo_years_summary s = ceduo_years_summarize(years, r->last_control);
    const struct ceduo_window *w = &years->window;
    bool has_energy = !isnan(s.exceed.mean);
    if (w->kind == CEDUO_WINDOW_CONSTANT)
        ceduo_text_append(text, _("Each:"));
    else
        ceduo_text_format(text, _("Years %u to %u:"), w->first, w->last);
    const char *share = WITH_ERROR(ceduo_measure_share(ceduo_share_over_years(years, &s)), " ");
    if (s.simulated > 0)
        ceduo_text_append_joined(text, " ", _("mean %s of 1000, worst %.0f (year %u)."), share, s.worst * 1000, s.worst_year);
    else if (!s.nothing)
        ceduo_text_append_joined(text, " ", _("the ADC is largest in year %u."), s.worst_year);
    if (s.nothing)
        ceduo_text_append_joined(text, " ", "%s", _("The forest cannot be assessed: no rock arrives, even without forest."));
    else if (s.simulated > 0 && has_energy)
        ceduo_text_append_joined(text, " ", _("Years that fail: energy %zu, contact %zu, free run %zu of %zu."),
                                 s.unprotected_energy, s.unprotected_contact, s.unprotected_free_run, s.years);
    else
        ceduo_text_append_joined(text, " ", _("Years that fail: contact %zu, free run %zu of %zu."), s.unprotected_contact,
                                 s.unprotected_free_run, s.years);
    if (s.thick_contact > s.unprotected_contact || s.thick_free_run > s.unprotected_free_run)
        ceduo_text_append_joined(text, " ", _("If only stems from %g cm on count: contact %zu, free run %zu."),
                                 CEDUO_THICK_DBH * 100, s.thick_contact, s.thick_free_run);
    if (!isnan(s.passes_per_year) && !isnan(s.exceeds_per_year))
        ceduo_text_append_joined(text, " ", _("Expected per year: %s rocks pass, %s with too much energy."),
                                 SIG(s.passes_per_year, 2), SIG(s.exceeds_per_year, 2));
    else if (!isnan(s.passes_per_year))
        ceduo_text_append_joined(text, " ", _("Expected per year: %s rocks pass."), SIG(s.passes_per_year, 2));
}

void ceduo_words_year_numbering(struct text *text, uint64_t rocks)
{
    if (rocks > 0)
        ceduo_text_format(text,
                          ngettext("Years are counted from today, with %lu rock in each; the worst is that of these years.",
                                   "Years are counted from today, with %lu rocks in each; the worst is that of these years.",
                                   (unsigned long)rocks),
                          (unsigned long)rocks);
    else
        ceduo_text_append(text, _("Years are counted from today."));
}

/* ---- best option ---- */

static double get_mean(const struct ceduo_verdict *v, bool rotation, size_t i)
{
    return 1000 * (rotation ? v->choices[i].mean.mean : v->choices[i].today.mean);
}

/* Append the best option and its rivals in order: names, "'large reserves' and 'selection coppice'", or numbers. */
static void append_leaders(struct text *text, const struct ceduo_scene *scene, const struct ceduo_verdict *v,
                           const struct ceduo_leader *leader, bool rotation, bool names)
{
    LOCAL_TEXT(list);
    size_t remaining = leader->rivals + 1;
    for (size_t i = 0; i < v->n; i++) {
        LOCAL_TEXT(one);
        if (i != leader->best && !leader->rival[i])
            continue;
        if (names)
            ceduo_text_format(&one, "'%s'", NAME_OF(&scene->options[i]));
        else
            ceduo_text_format(&one, "%.0f", get_mean(v, rotation, i));
        if (--remaining > 0 || leader->rivals == 0)
            ceduo_text_format(&list, "%s%s", list.length > 0 ? ", " : "", ceduo_text_string(&one));
        else
            ceduo_text_format(text, _("%s and %s"), ceduo_text_string(&list), ceduo_text_string(&one));
    }
    if (leader->rivals == 0)
        ceduo_text_append(text, ceduo_text_string(&list));
}

/* Append "In years 1 to 25 'large reserves' lets the fewest dangerous rocks through: 314 of 1000." */
static void append_best(struct text *text, const struct ceduo_scene *scene, const struct ceduo_verdict *v, bool rotation,
                        const char *period_name)
{
    const struct ceduo_leader *leader = rotation ? &v->rotation : &v->today;
    const char *rocks = v->accepted ? _("dangerous rocks") : _("rocks");
    double mean = get_mean(v, rotation, leader->best);
    LOCAL_TEXT(names);
    LOCAL_TEXT(numbers);
    ceduo_text_format(text, "%s ", period_name);
    append_leaders(&names, scene, v, leader, rotation, true);
    append_leaders(&numbers, scene, v, leader, rotation, false);
    if (leader->rivals + 1 == v->n && leader->equal)
        ceduo_text_format(text, _("all options are equal: %.0f of 1000."), mean);
    else if (leader->rivals + 1 == v->n)
        ceduo_text_append(text, _("no option is clearly better than the others."));
    else if (leader->rivals == 0)
        ceduo_text_format(text, _("%s lets the fewest %s through: %s of 1000."), names.bytes, rocks, numbers.bytes);
    else if (leader->equal)
        ceduo_text_format(text, _("%s are equal and let the fewest %s through: %.0f of 1000."), names.bytes, rocks, mean);
    else
        ceduo_text_format(text, _("%s let the fewest %s through and cannot be told apart: %s of 1000."), names.bytes, rocks,
                          numbers.bytes);
}

void ceduo_words_best(struct text *text, const struct ceduo_scene *scene, const struct ceduo_verdict *v)
{
    if (v->too_few_arrivals)
        ceduo_text_append(text, _("The forest cannot be assessed: no rock arrives, even without forest."));
    LOCAL_TEXT(period);
    ceduo_text_format(&period, _("In years %u to %u"), get_window(v)->first, get_window(v)->last);
    const char *period_name = period.bytes;
    bool years = v->rotation.known && !v->rotation.uneven && get_window(v)->kind != CEDUO_WINDOW_CONSTANT;
    bool today = v->today.known && !v->today.uneven;
    const struct ceduo_leader *a = &v->rotation, *b = &v->today;
    if (years && today && a->best == b->best && a->rivals == 0 && b->rivals == 0) {
        /* one option is clearly best over the years and today */
        ceduo_text_format(text, _("%s '%s' lets the fewest %s through, as it does today: %.0f and %.0f of 1000."), period_name,
                          NAME_OF(&scene->options[a->best]), v->accepted ? _("dangerous rocks") : _("rocks"),
                          get_mean(v, true, a->best), get_mean(v, false, a->best));
        return;
    }
    if (years)
        append_best(text, scene, v, true, period_name);
    if (years && today)
        ceduo_text_append_char(text, '\n');
    if (today)
        append_best(text, scene, v, false, _("Today"));
}

/* ---- other energy law ---- */

void ceduo_words_alternative_law(struct text *text, const struct ceduo_result *r, size_t option, size_t control)
{
    const struct ceduo_alternative_energy *o = &r->options[option].alternatives[control];
    const struct ceduo_arrivals *a = &o->arrivals;
    const char *law = ceduo_words_law(ceduo_energy_words.names[o->model]);
    if (!o->known || !o->stems)
        return;
    const struct ceduo_measure energy = ceduo_measure_figure(CEDUO_MEAN_KJ, a);
    if (isnan(energy.value)) {
        ceduo_text_format(text, _("With the energy law %s no rock arrives."), law);
        return;
    }
    const char *mean = WITH_ERROR(energy, " "), *reach = INTERVAL(ceduo_measure_arriving(a));
    const struct ceduo_control *c = &r->scene->controls[control];
    if (isnan(c->accepted))
        ceduo_text_format(text, _("With the energy law %s: %s of 1000 arrive; their mean is %s kJ."), law, reach, mean);
    else
        ceduo_text_format(text,
                          _("With the energy law %s: %s of 1000 arrive, %s with more than the accepted energy; their mean is "
                            "%s kJ."),
                          law, reach, INTERVAL(ceduo_measure_exceeding(c, a)), mean);
    if (ceduo_rocks_released(a) < ceduo_result_rocks(r))
        ceduo_text_append_joined(text, " ", _("Under this law the first %llu rocks alone were simulated."),
                                 (unsigned long long)ceduo_rocks_released(a));
}

static double get_share(const struct ceduo_result *r, size_t option, bool by_alternative_law)
{
    const struct ceduo_alternative_energy *o = &r->options[option].alternatives[r->last_control];
    const struct ceduo_arrivals *other_arrivals = o->known ? &o->arrivals : NULL;
    return 1000 *
           ceduo_share_judged(by_alternative_law ? other_arrivals : ceduo_result_wooded(r, option, r->last_control)).mean;
}

/* True if the order of an option and another one depends on the energy law. */
static bool is_reversed(const struct ceduo_result *r, const struct ceduo_verdict *v, size_t option)
{
    bool reversed = false;
    for (size_t i = 0; i < v->reversals_count && !reversed; i++) {
        size_t a = v->reversals[i].better, b = v->reversals[i].worse;
        reversed = (a == option || b == option) && !isnan(get_share(r, a, true) + get_share(r, b, true));
    }
    return reversed;
}

void ceduo_words_rank_reversals(const struct ceduo_result *r, const struct ceduo_verdict *v, ceduo_sentence_sink *sink,
                                void *context)
{
    LOCAL_TEXT(options);
    LOCAL_TEXT(sentence);
    const char *law = "";
    size_t n = 0;
    for (size_t i = 0; i < v->n; i++) {
        if (!is_reversed(r, v, i))
            continue;
        const struct ceduo_alternative_energy *o = &r->options[i].alternatives[r->last_control];
        ceduo_text_append_joined(&options, n > 0 ? "; " : "", _("'%s' %.0f and %.0f"), NAME_OF(&r->scene->options[i]),
                                 get_share(r, i, false), get_share(r, i, true));
        law = o->stems ? ceduo_words_law(ceduo_energy_words.names[o->model]) : law;
        n++;
    }
    if (n == 0)
        return;
    ceduo_text_format(&sentence,
                      _("The order of %zu options depends on the energy law. Of 1000 by the law of the scene, and by %s: %s."),
                      n, law, options.bytes);
    sink(context, sentence.bytes);
}
