/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the law asks, in sentences. */
#include <math.h>

#include "base/language.h"
#include "words.h"

__attribute__((format(printf, 4, 5))) static void say_format(ceduo_words_rule *say, void *context, bool met, const char *format,
                                                             ...)
{
    struct text text = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    if (text.bytes)
        say(context, met, text.bytes);
    ceduo_text_free(&text);
}

static const char *species_of(const struct ceduo_belt *belt)
{
    size_t count;
    return _(ceduo_species_list(&count)[belt->stand.species].common);
}

static void say_standards(const struct ceduo_belt *belt, const struct ceduo_compliance *c, ceduo_words_rule *say, void *context)
{
    const struct ceduo_regulation_item *item = c->standards_item;
    if (!item)
        say_format(say, context, true,
                   _("%s: the rules of %s as filed name no number of standards for this species (%s); none is checked."),
                   belt->name, c->of->name, species_of(belt));
    else if (isnan(item->most))
        say_format(say, context, c->standards_met,
                   c->standards_met ? _("%s: %s asks for %g standards a hectare at least (%s, %u); %.4g are kept: met.")
                                    : _("%s: %s asks for %g standards a hectare at least (%s, %u); %.4g are kept: NOT met."),
                   belt->name, c->of->name, item->least, item->article, item->year, c->standards);
    else
        say_format(say, context, c->standards_met,
                   c->standards_met ? _("%s: %s asks for %g to %g standards a hectare (%s, %u); %.4g are kept: met.")
                                    : _("%s: %s asks for %g to %g standards a hectare (%s, %u); %.4g are kept: NOT met."),
                   belt->name, c->of->name, item->least, item->most, item->article, item->year, c->standards);
}

static void say_turn(const struct ceduo_belt *belt, const struct ceduo_compliance *c, ceduo_words_rule *say, void *context)
{
    const struct ceduo_regulation_item *item = c->turn_item;
    if (!item) {
        say_format(say, context, true, _("%s: the rules of %s as filed name no turn for this species (%s); none is checked."),
                   belt->name, c->of->name, species_of(belt));
        return;
    }
    if (isnan(c->turn))
        return;
    if (isnan(item->most))
        say_format(say, context, c->turn_met,
                   c->turn_met ? _("%s: %s asks for a turn of %g years at least (%s, %u); shoots are cut at %.4g: met.")
                               : _("%s: %s asks for a turn of %g years at least (%s, %u); shoots are cut at %.4g: NOT met."),
                   belt->name, c->of->name, item->least, item->article, item->year, c->turn);
    else
        say_format(say, context, c->turn_met,
                   c->turn_met ? _("%s: %s asks for a turn of %g to %g years (%s, %u); shoots are cut at %.4g: met.")
                               : _("%s: %s asks for a turn of %g to %g years (%s, %u); shoots are cut at %.4g: NOT met."),
                   belt->name, c->of->name, item->least, item->most, item->article, item->year, c->turn);
}

void ceduo_words_rules(const struct ceduo_belt *belt, const struct ceduo_compliance *c, ceduo_words_rule *say, void *context)
{
    if (!c->of)
        return;
    if (belt->stand.species < 0) {
        say_format(say, context, true, _("%s: the stand names no species; nothing that %s asks is checked."), belt->name,
                   c->of->name);
    } else {
        say_standards(belt, c, say, context);
        say_turn(belt, c, say, context);
    }
    if (c->of->note)
        say_format(say, context, true, _("%s: check the text in force; %s."), c->of->name, ceduo_words_shipped(c->of->note));
    else
        say_format(say, context, true, _("%s: check the text in force."), c->of->name);
}
