/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be said of a control, and why: yes, no, not decided, or nothing. */
#include <math.h>

#include "base/language.h"
#include "base/utf8.h"
#include "measure.h"
#include "plot_parts.h"
#include "words.h"

/* What files and people call it. */
static const struct {
    const char *word, *verdict;
    enum ceduo_light light;
} judgements[] = {[CEDUO_UNANSWERED] = {NULL, NULL, CEDUO_UNKNOWN},
                  [CEDUO_YES] = {"yes", N_("YES"), CEDUO_PASS},
                  [CEDUO_NO] = {"no", N_("NO"), CEDUO_FAIL},
                  [CEDUO_NOT_DECIDED] = {"not-decided", N_("NOT DECIDED"), CEDUO_UNKNOWN},
                  [CEDUO_DEPENDS] = {"depends", N_("IT DEPENDS"), CEDUO_UNKNOWN},
                  [CEDUO_NOTHING] = {"nothing", N_("NOTHING CAN BE SAID"), CEDUO_UNKNOWN}};

const char *ceduo_words_judgement(enum ceduo_judgement judgement)
{
    return judgements[judgement].word;
}

/* ---- nothing ---- */

void ceduo_words_nothing(struct text *text, const struct ceduo_result *r, size_t control)
{
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control];
    LOCAL_TEXT(where);
    ceduo_plot_control_name(&where, &r->scene->controls[control]);
    ceduo_text_format(text, _("Nothing can be said of the wood above %s: of %llu rocks %llu arrive, even without forest."),
                      ceduo_text_string(&where), (unsigned long long)bare->released, (unsigned long long)bare->reached);
    /* where rocks start without forest, and how far they come */
    const struct ceduo_slope *s = &r->scene->slope;
    double start = r->scene->release.x.mean, falls = atan(ceduo_slope_fall(s, start)) * 180 / M_PI;
    double farthest = r->bare.ends.stop_max, way = farthest - start; /* NaN: none comes to rest */
    double face = ceduo_slope_face(s);
    ceduo_text_then(text, " ",
                    falls < 0 ? _("They start at %.10g m, where the ground rises by %.0f\xc2\xb0.")
                              : _("They start at %.10g m, where the ground falls by %.0f\xc2\xb0."),
                    start + s->origin_x, fabs(falls));
    if (r->scene->release.x_assumed)
        ceduo_text_then(text, " ", "%s", _("That is where the profile begins: release.x_m is not given."));
    if (!isnan(way))
        ceduo_text_then(text, " ", _("They come to rest within %s m of it."), WRITTEN(way < 0.05 ? 0 : way, 2));
    if (falls < 0)
        ceduo_text_then(text, " ", "%s", _("The profile may have been drawn upward."));
    /* what to do: a face that they do not reach is where they should start */
    if (face > start && !(farthest > face))
        ceduo_text_then(
            text, " ",
            _("The ground is steeper than 45\xc2\xb0 from %.10g m on: if they start there, write release.x_m: %.10g."),
            face + s->origin_x, face + s->origin_x);
    else if (ceduo_terrain(bare) == CEDUO_TERRAIN_CONTRADICTS)
        ceduo_words_contradiction(text, bare);
    else if (!(farthest > s->x[ceduo_slope_segment(s, start) + 1]))
        ceduo_text_then(text, " ", "%s",
                        _("Write where they start (release.x_m), or what sets them in motion (release.height_m, vx_m_s)."));
    else
        ceduo_text_then(text, " ", "%s", _("If release and ground are right, rocks do not come as far as this place."));
}

void ceduo_words_still(const struct ceduo_result *r, ceduo_words_say *say, void *context)
{
    for (size_t c = 0; c < r->scene->controls_count; c++) {
        LOCAL_TEXT(sentence);
        if (!ceduo_says_nothing(&r->bare.arrivals[c]))
            continue;
        ceduo_words_nothing(&sentence, r, c);
        say(context, ceduo_text_string(&sentence));
        return; /* what lies behind it is not reached either */
    }
}

/* ---- why ---- */

void ceduo_words_because(struct text *text, const struct ceduo_result *r, size_t control, const struct ceduo_arrivals *wooded)
{
    const struct ceduo_control *c = &r->scene->controls[control];
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control];
    enum ceduo_judgement judgement = ceduo_judge(bare, wooded);
    bool also_bare = ceduo_judge(bare, NULL) == CEDUO_YES;
    if (judgement == CEDUO_NOTHING) {
        ceduo_words_nothing(text, r, control);
        return;
    }
    if (judgement == CEDUO_UNANSWERED) {
        ceduo_text_put(text, isnan(c->accepted) ? _("It is not said what the place withstands (accepted_kJ).")
                             : !r->wooded       ? _("The index alone says nothing of single rocks (contact_model: index).")
                                                : _("Not computed yet."));
        return;
    }
    const struct ceduo_arrivals *shown = wooded ? wooded : bare;
    ceduo_text_format(text, _("%s of 1000 arrive with more than %g kJ (%.0f are allowed)."),
                      WRITTEN_OF_1000(shown->exceed_probability, shown->exceed_lo, shown->exceed_hi), ceduo_words_accepted(c),
                      CEDUO_EXCEED_MOST * 1000);
    if (ceduo_energy_light(shown) == CEDUO_UNKNOWN)
        ceduo_text_then(text, " ", _("%llu rocks never came to an end, and may arrive."),
                        (unsigned long long)shown->unfinished);
    else if (judgement == CEDUO_NOT_DECIDED)
        ceduo_text_then(text, " ", _("So many rocks do not decide it (%llu): more do."), (unsigned long long)shown->released);
    else if (also_bare)
        ceduo_text_then(text, " ", "%s", _("The slope keeps to that without the wood, too."));
}

/* ---- in one line ---- */

enum ceduo_judgement ceduo_words_judge(const struct ceduo_result *r, size_t option, size_t control,
                                       const struct ceduo_doubt_report *doubt)
{
    const struct ceduo_arrivals *wooded = ceduo_result_wooded(r, option, control);
    struct ceduo_measure m = ceduo_judged(&r->scene->controls[control], wooded);
    enum ceduo_judgement judgement = ceduo_judge(&r->bare.arrivals[control], wooded);
    if (judgement == CEDUO_NOTHING || judgement == CEDUO_UNANSWERED || !wooded)
        return judgement;
    ceduo_measure_doubt(&m, doubt, option, control);
    bool open = isnan(m.may_lo) ? r->options[option].others[control].judgement == CEDUO_DEPENDS
                                : m.may_lo <= 1000 * CEDUO_EXCEED_MOST && m.may_hi > 1000 * CEDUO_EXCEED_MOST;
    return open ? CEDUO_DEPENDS : judgement;
}

void ceduo_words_decision(struct text *text, enum ceduo_judgement judgement)
{
    if (judgement != CEDUO_UNANSWERED)
        ceduo_text_format(text, "%s %s", ceduo_plot_light_mark(judgements[judgement].light), _(judgements[judgement].verdict));
}

/* What is said, from the widest to the narrowest. */
static const struct answer_form {
    enum ceduo_measure_name name;
    bool accepted, doubt;
} forms[] = {
    {CEDUO_PHRASE, true, true}, {CEDUO_PHRASE, false, true}, {CEDUO_SHORT_HEAD, false, true}, {CEDUO_SHORT_HEAD, false, false}};

/* "479 of 1000 arrive with more than 50 kJ (50 accepted); may be 234–748" */
static void say_form(struct text *text, const struct ceduo_measure *m, const struct ceduo_measure *bare,
                     const struct answer_form *form)
{
    LOCAL_TEXT(value);
    LOCAL_TEXT(name);
    LOCAL_TEXT(span);
    ceduo_measure_value(&value, m);
    ceduo_measure_name(&name, m, form->name);
    ceduo_text_format(text, _("%s of 1000 %s"), ceduo_text_string(&value), ceduo_text_string(&name));
    if (form->accepted && m->limit > 0)
        ceduo_text_format(text, _(" (%.0f accepted)"), 1000 * CEDUO_EXCEED_MOST);
    else if (form->accepted && bare)
        ceduo_text_format(text, _(" (%.0f without the wood)"), bare->value);
    bool doubted = !isnan(m->may_lo);
    if (!form->doubt)
        return;
    if (doubted)
        ceduo_measure_may_be(&span, m);
    else
        ceduo_measure_span(&span, m, m->lo, m->hi);
    ceduo_text_format(text, doubted ? _("; may be %s") : _("; %s by the rocks"), ceduo_text_string(&span));
}

/* What follows the verdict, in so many columns; nothing where it has no room. */
static void say_reason(struct text *text, const struct ceduo_result *r, size_t option, size_t control,
                       const struct ceduo_doubt_report *doubt, enum ceduo_judgement judgement, size_t width)
{
    const struct ceduo_control *c = &r->scene->controls[control];
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control], *wooded = ceduo_result_wooded(r, option, control);
    struct ceduo_measure m = ceduo_judged(c, wooded ? wooded : bare), without = ceduo_judged(c, bare);
    if (wooded)
        ceduo_measure_doubt(&m, doubt, option, control);
    const char *left = WRITTEN(r->options[option].controls[control].residual * J_TO_KJ, 3);
    const char *mean = WRITTEN(bare->energy.mean * J_TO_KJ, 3);
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        ceduo_text_free(text);
        if (judgement == CEDUO_NOTHING)
            ceduo_text_format(text, _("of %llu rocks %llu arrive, even without the wood"), (unsigned long long)bare->released,
                              (unsigned long long)bare->reached);
        else if (!wooded && r->wooded)
            ceduo_text_put(text, _("not computed yet"));
        else if (!wooded && judgement != CEDUO_YES)
            ceduo_text_format(text,
                              i == 0 ? _("the index leaves %s of %s kJ in the mean; it knows no single rocks")
                                     : _("the index leaves %s of %s kJ"),
                              left, mean);
        else
            say_form(text, &m, ceduo_plot_has_stems(&r->scene->options[option]) ? &without : NULL, &forms[i]);
        if (ceduo_utf8_width(text->bytes) <= width)
            return;
    }
    ceduo_text_free(text);
}

void ceduo_words_answer(struct text *text, const struct ceduo_result *r, size_t option, size_t control,
                        const struct ceduo_doubt_report *doubt, size_t width)
{
    enum ceduo_judgement judgement = ceduo_words_judge(r, option, control, doubt);
    LOCAL_TEXT(verdict);
    LOCAL_TEXT(reason);
    ceduo_words_decision(&verdict, judgement);
    size_t taken = verdict.length > 0 ? ceduo_utf8_width(verdict.bytes) + 2 : 0;
    say_reason(&reason, r, option, control, doubt, judgement, width > taken ? width - taken : 0);
    ceduo_text_put(text, ceduo_text_string(&verdict));
    if (reason.length > 0)
        ceduo_text_format(text, "%s%s", verdict.length > 0 ? ": " : "", reason.bytes);
}
