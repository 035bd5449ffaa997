/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the law asks of the stands of an option, in sentences. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"

typedef const struct ceduo_regulation_item item;

static const char *note_of(const struct ceduo_regulation *rules, struct text *text)
{
    if (rules->note)
        ceduo_text_format(text, _("%s: check the text in force; %s."), rules->name,
                          ceduo_in_language(rules->note, rules->note_it));
    else
        ceduo_text_format(text, _("%s: check the text in force."), rules->name);
    return text->bytes;
}

/* The number of standards or the turn of a belt. */
static void say_rule(struct ceduo_page *page, const struct ceduo_belt *belt, const struct ceduo_compliance *c, bool turn,
                     bool all)
{
    item *asked = turn ? c->turn_item : c->standards_item;
    bool met = turn ? c->turn_met : c->standards_met;
    size_t count;
    LOCAL_TEXT(sentence);
    LOCAL_TEXT(wanted);
    if (!all && (!asked || met))
        return;
    if (!asked) {
        ceduo_text_format(&sentence,
                          turn ? _("%s: the rules of %s as filed name no rotation for this species (%s); none is checked.")
                               : _("%s: the rules of %s as filed name no number of standards for this species (%s); none is "
                                   "checked."),
                          belt->name, c->of->name, _(ceduo_species_list(&count)[belt->stand.species].common));
        ceduo_page_once(page, CEDUO_PAGE_SENTENCE, sentence.bytes);
        return;
    }
    if (isnan(asked->most))
        ceduo_text_format(&wanted, "\xe2\x89\xa5 %s", SHORTEST(asked->least));
    else
        ceduo_text_format(&wanted, "%s\xe2\x80\x93%s", SHORTEST(asked->least), SHORTEST(asked->most));
    ceduo_text_format(&sentence,
                      turn ? _("%s: %s asks for a rotation of %s years (%s, %u); shoots are cut at %.4g: %s.")
                           : _("%s: %s asks for %s standards a hectare (%s, %u); %.4g are kept: %s."),
                      belt->name, c->of->name, wanted.bytes, asked->article, asked->year, turn ? c->turn : c->standards,
                      met ? _("met") : _("NOT met"));
    ceduo_page_once(page, met ? CEDUO_PAGE_SENTENCE : CEDUO_PAGE_WARNING, sentence.bytes);
}

void ceduo_page_stand_rules(struct ceduo_page *page, const struct ceduo_result *r, size_t option, bool all)
{
    const struct ceduo_option *o = &r->scene->options[option];
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_belt *belt = &o->belts[i];
        const struct ceduo_compliance *c = &r->options[option].stands[i].rules;
        LOCAL_TEXT(sentence);
        LOCAL_TEXT(note);
        if (!c->of)
            continue;
        if (belt->stand.species >= 0) {
            say_rule(page, belt, c, false, all);
            if (!c->turn_item || !isnan(c->turn))
                say_rule(page, belt, c, true, all);
        } else if (all) {
            ceduo_text_format(&sentence, _("%s: the stand names no species; nothing that %s asks is checked."), belt->name,
                              c->of->name);
            ceduo_page_once(page, CEDUO_PAGE_SENTENCE, sentence.bytes);
        }
        if (all)
            ceduo_page_once(page, CEDUO_PAGE_SENTENCE, note_of(c->of, &note));
    }
}
