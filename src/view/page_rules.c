/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rules for the stands of all options: a table with a row per stand and the articles below; the same as sentences. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"

typedef const struct ceduo_regulation_item item;

static const char *append_note(const struct ceduo_regulation *rules, struct text *text)
{
    ceduo_text_format(text, _("%s: check the text in force"), rules->name);
    ceduo_text_append_joined(text, rules->note ? "; " : "", "%s.",
                             rules->note ? ceduo_in_language(rules->note, rules->note_it) : "");
    return text->bytes;
}

/* Append "≥ 50" or "20–30". */
static void append_limits(struct text *text, item *rule)
{
    ceduo_text_format(text, isnan(rule->max) ? "\xe2\x89\xa5 %s" : "%s\xe2\x80\x93%s", LOCALIZED(rule->min),
                      LOCALIZED(rule->max));
}

/* Append the rule of standards or of the rotation of a belt. */
static void add_rule_sentence(struct ceduo_page *page, const struct ceduo_belt *belt, const struct ceduo_compliance *c,
                              bool turn, bool all)
{
    item *rule = turn ? c->turn_item : c->standards_item;
    bool met = turn ? c->turn_met : c->standards_met;
    size_t count;
    LOCAL_TEXT(limits);
    if (!all && (!rule || met))
        return;
    if (!rule) {
        ceduo_page_once(
            page, CEDUO_PAGE_SENTENCE,
            turn ? _("%s: the rules of %s give no rotation for this species (%s). The rotation is not checked.")
                 : _("%s: the rules of %s give no number of standards for this species (%s). The number is not checked."),
            belt->name, c->regulation->name, _(ceduo_species_list(&count)[belt->stand.species].common));
        return;
    }
    append_limits(&limits, rule);
    ceduo_page_once(page, met ? CEDUO_PAGE_SENTENCE : CEDUO_PAGE_WARNING,
                    turn ? _("%s: %s asks for a rotation of %s years (%s, %u); shoots are cut at %.4g: %s.")
                         : _("%s: %s asks for %s standards a hectare (%s, %u); %.4g are kept: %s."),
                    belt->name, c->regulation->name, limits.bytes, rule->article, rule->year, turn ? c->turn : c->standards,
                    met ? _("met") : _("NOT met"));
}

void ceduo_page_stand_rules(struct ceduo_page *page, const struct ceduo_result *r, size_t option, bool all)
{
    const struct ceduo_option *o = &r->scene->options[option];
    for (size_t i = 0; i < o->belts_count; i++) {
        const struct ceduo_belt *belt = &o->belts[i];
        const struct ceduo_compliance *c = &r->options[option].stands[i].rules;
        LOCAL_TEXT(note);
        if (!c->regulation)
            continue;
        if (belt->stand.species >= 0) {
            add_rule_sentence(page, belt, c, false, all);
            if (!c->turn_item || !isnan(c->turn))
                add_rule_sentence(page, belt, c, true, all);
        } else if (all) {
            ceduo_page_once(page, CEDUO_PAGE_SENTENCE, _("%s: the stand has no species, so the rules of %s are not checked."),
                            belt->name, c->regulation->name);
        }
        if (all)
            ceduo_page_once(page, CEDUO_PAGE_SENTENCE, "%s", append_note(c->regulation, &note));
    }
}

/* ---- the table ---- */

/* Append the value of the stand, the rule, and whether it is met. */
static void add_rule_cells(struct ceduo_page *page, double value, item *rule, bool met, bool species)
{
    if (isnan(value))
        ceduo_page_cell_format(page, "-");
    else
        ceduo_page_cell_format(page, "%s", SIG_TRIMMED(value, 4));
    if (!rule)
        ceduo_page_cell_format(page, "%s", species ? _("not named") : _("no species"));
    else
        append_limits(ceduo_page_text(page), rule);
    if (!rule || isnan(value))
        ceduo_page_cell_format(page, "-");
    else
        ceduo_page_yes_no(page, met);
}

static void add_source(struct text *sources, item *rule)
{
    LOCAL_TEXT(source);
    if (!rule)
        return;
    ceduo_text_format(&source, "%s (%u)", rule->article, rule->year);
    if (!strstr(ceduo_text_string(sources), source.bytes))
        ceduo_text_format(sources, sources->length > 0 ? "; %s" : "%s", source.bytes);
}

void ceduo_page_rules(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("stand"), 26, 2, COL_WRAP}, {N_("standards/ha"), -13, 0, 0}, {N_("asked for"), -13, 0, 0}, {N_("kept"), 5, 1, 0},
        {N_("rotation, y"), -12, 0, 0}, {N_("asked for"), -13, 0, 0},    {N_("kept"), 0, 1, 0}};
    const struct ceduo_regulation *rules = NULL;
    LOCAL_TEXT(sources);
    LOCAL_TEXT(note);
    for (size_t i = 0; i < r->scene->options_count; i++)
        for (size_t k = 0; k < r->scene->options[i].belts_count; k++) {
            const struct ceduo_compliance *c = &r->options[i].stands[k].rules;
            if (!c->regulation)
                continue;
            if (!rules) {
                rules = c->regulation;
                ceduo_page_para(page, CEDUO_PAGE_SECTION, _("Rules of %s"), rules->name);
                CEDUO_PAGE_TABLE_OF(page, columns);
            }
            bool listed = false; /* an earlier belt has the same stand */
            for (size_t a = 0; a <= i; a++)
                for (size_t b = 0; b < (a < i ? r->scene->options[a].belts_count : k); b++)
                    listed |= strcmp(r->scene->options[a].belts[b].name, r->scene->options[i].belts[k].name) == 0;
            if (listed)
                continue;
            bool species = r->scene->options[i].belts[k].stand.species >= 0;
            ceduo_page_cell_format(page, "%s", r->scene->options[i].belts[k].name);
            add_rule_cells(page, c->standards, c->standards_item, c->standards_met, species);
            add_rule_cells(page, c->turn, c->turn_item, c->turn_met, species);
            add_source(&sources, c->standards_item);
            add_source(&sources, isnan(c->turn) ? NULL : c->turn_item);
        }
    if (!rules)
        return;
    if (sources.length > 0)
        ceduo_page_para(page, CEDUO_PAGE_DETAIL, _("Sources: %s."), ceduo_text_string(&sources));
    ceduo_page_note(page, append_note(rules, &note));
}
