/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be said of a control, and why: yes, no, not decided, or nothing. */
#include <math.h>

#include "base/language.h"
#include "plot_parts.h"
#include "words.h"

const char *ceduo_words_judgement(enum ceduo_judgement judgement)
{
    static const char *const words[] = {
        [CEDUO_UNANSWERED] = NULL,           [CEDUO_YES] = "yes",         [CEDUO_NO] = "no",
        [CEDUO_NOT_DECIDED] = "not-decided", [CEDUO_DEPENDS] = "depends", [CEDUO_NOTHING] = "nothing"};
    return words[judgement];
}

/* ---- nothing ---- */

/* Where rocks start without forest, and how far they come. */
static void say_how_far(struct text *text, const struct ceduo_result *r)
{
    const struct ceduo_slope *s = &r->scene->slope;
    double start = r->scene->release.x.mean, falls = atan(ceduo_slope_fall(s, start)) * 180 / M_PI;
    double way = r->bare.ends.stop_max - start; /* NaN: none comes to rest */
    ceduo_text_then(text, " ",
                    falls < 0 ? _("They start at %.4g m, where the ground rises by %.0f\xc2\xb0.")
                              : _("They start at %.4g m, where the ground falls by %.0f\xc2\xb0."),
                    start + s->origin_x, fabs(falls));
    if (r->scene->release.x_assumed)
        ceduo_text_then(text, " ", "%s", _("That is where the profile begins: release.x_m is not given."));
    if (way >= 0.05)
        ceduo_text_then(text, " ", _("They come to rest within %s m of it."), WRITTEN(way, 2));
    else if (!isnan(way))
        ceduo_text_then(text, " ", "%s", _("They rest there."));
    if (falls < 0)
        ceduo_text_then(text, " ", "%s", _("The profile may have been drawn upward."));
}

/* A face that they do not reach is where they should start. */
static void say_what_to_do(struct text *text, const struct ceduo_result *r)
{
    const struct ceduo_slope *s = &r->scene->slope;
    double start = r->scene->release.x.mean, face = ceduo_slope_face(s), farthest = r->bare.ends.stop_max;
    if (face > start && !(farthest > face))
        ceduo_text_then(
            text, " ", _("The ground is steeper than 45\xc2\xb0 from %.4g m on: if they start there, write release.x_m: %.4g."),
            face + s->origin_x, face + s->origin_x);
    else if (!(farthest > s->x[ceduo_slope_segment(s, start) + 1]))
        ceduo_text_then(text, " ", "%s",
                        _("Write where they start (release.x_m), or what sets them in motion (release.height_m, vx_m_s)."));
    else
        ceduo_text_then(text, " ", "%s", _("If release and ground are right, rocks do not come as far as this place."));
}

void ceduo_words_nothing(struct text *text, const struct ceduo_result *r, size_t control)
{
    const struct ceduo_arrivals *bare = &r->bare.arrivals[control];
    LOCAL_TEXT(where);
    ceduo_plot_control_name(&where, &r->scene->controls[control]);
    ceduo_text_format(text,
                      bare->reached == 0
                          ? _("Nothing can be said of the wood above %s: of %llu rocks none arrives, even without forest.")
                          : _("Nothing can be said of the wood above %s: of %llu rocks %llu arrive, even without forest."),
                      ceduo_text_string(&where), (unsigned long long)bare->released, (unsigned long long)bare->reached);
    say_how_far(text, r);
    say_what_to_do(text, r);
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
    if (judgement == CEDUO_NOT_DECIDED)
        ceduo_text_then(text, " ", _("So many rocks do not decide it (%llu): more do."), (unsigned long long)shown->released);
    else if (also_bare)
        ceduo_text_then(text, " ", "%s", _("The slope keeps to that without the wood, too."));
}
