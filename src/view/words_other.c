/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the other energy law of stems makes of the same rocks. */
#include <math.h>

#include "base/language.h"
#include "scene/choices.h"
#include "words.h"

#define TURNED_MOST 3 /* pairs of options that are named */

void ceduo_words_other(struct text *text, const struct ceduo_result *r, size_t option, size_t control)
{
    const struct ceduo_other_energy *o = &r->options[option].others[control];
    const char *law = ceduo_energy_words.names[o->model];
    if (!o->known || !o->stems)
        return;
    if (isnan(o->energy)) {
        ceduo_text_format(text, _("With the energy law %s no rock arrives."), law);
        return;
    }
    const char *mean = WRITTEN(o->energy * J_TO_KJ, 3);
    const char *half = WRITTEN(ceduo_half_width(o->energy_se, o->reached) * J_TO_KJ, 2);
    const char *reach = WRITTEN_OF_1000(o->reach_probability, o->reach_lo, o->reach_hi);
    if (isnan(o->exceed_probability))
        ceduo_text_format(text, _("With the energy law %s: %s of 1000 arrive; their mean is %s \xc2\xb1%s kJ."), law, reach,
                          mean, half);
    else
        ceduo_text_format(text,
                          _("With the energy law %s: %s of 1000 arrive, %s with more than it withstands; the mean of those "
                            "that arrive is %s \xc2\xb1%s kJ."),
                          law, reach, WRITTEN_OF_1000(o->exceed_probability, o->exceed_lo, o->exceed_hi), mean, half);
    if (o->rocks < ceduo_result_rocks(r))
        ceduo_text_then(text, " ", _("Under this law the first %llu rocks alone were simulated."),
                        (unsigned long long)o->rocks);
}

static double of_1000(const struct ceduo_result *r, size_t option, bool other)
{
    size_t c = r->last_control;
    return 1000 * (other ? ceduo_share_by_other_law(&r->options[option].others[c])
                         : ceduo_share_at(ceduo_result_wooded(r, option, c)).mean);
}

void ceduo_words_turned(const struct ceduo_result *r, const struct ceduo_verdict *v, ceduo_words_say *say, void *context)
{
    for (size_t i = 0; i < v->turned_count; i++) {
        size_t a = v->turned[i].better, b = v->turned[i].than, left = v->turned_count - i;
        LOCAL_TEXT(sentence);
        if (i >= TURNED_MOST) {
            ceduo_text_format(&sentence,
                              ngettext("The order of %zu other pair of options depends on the energy law, too.",
                                       "The order of %zu other pairs of options depends on the energy law, too.", left),
                              left);
            i = v->turned_count;
        } else {
            bool stems = r->options[a].others[r->last_control].stems;
            const struct ceduo_other_energy *o = &r->options[stems ? a : b].others[r->last_control];
            ceduo_text_format(&sentence,
                              _("'%s' or '%s' is undecided: the order depends on the energy law. As the scene has it %.0f "
                                "and %.0f of 1000, with %s %.0f and %.0f."),
                              r->scene->options[a].name, r->scene->options[b].name, of_1000(r, a, false), of_1000(r, b, false),
                              ceduo_energy_words.names[o->model], of_1000(r, a, true), of_1000(r, b, true));
        }
        if (sentence.bytes)
            say(context, sentence.bytes);
    }
}
