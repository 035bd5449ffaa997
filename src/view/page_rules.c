/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the law asks of the stands of all options: a row for each stand, the articles below. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "words.h"

typedef const struct ceduo_regulation_item item;

static void put_asked(struct ceduo_page *page, item *asked, bool species)
{
    struct text *cell = ceduo_page_text(page);
    if (!asked)
        ceduo_text_put(cell, species ? _("not named") : _("no species"));
    else if (isnan(asked->most))
        ceduo_text_format(cell, "\xe2\x89\xa5 %g", asked->least);
    else
        ceduo_text_format(cell, "%g\xe2\x80\x93%g", asked->least, asked->most);
}

/* What is, what is asked for, and whether it is kept. */
static void put_rule(struct ceduo_page *page, double is, item *asked, bool met, bool species)
{
    struct text *cell = ceduo_page_text(page);
    if (isnan(is))
        ceduo_text_char(cell, '-');
    else
        ceduo_text_format(cell, "%.4g", is);
    put_asked(page, asked, species);
    ceduo_text_put(ceduo_page_text(page), !asked || isnan(is) ? "-" : met ? _("yes") : _("NO"));
}

/* Whether an earlier belt of any option has the same stand. */
static bool is_listed(const struct ceduo_result *r, size_t option, size_t belt)
{
    const char *name = r->scene->options[option].belts[belt].name;
    for (size_t i = 0; i <= option; i++)
        for (size_t k = 0; k < (i < option ? r->scene->options[i].belts_count : belt); k++)
            if (strcmp(r->scene->options[i].belts[k].name, name) == 0)
                return true;
    return false;
}

static void put_source(struct text *sources, item *asked)
{
    struct text source = {0};
    if (!asked)
        return;
    ceduo_text_format(&source, "%s (%u)", asked->article, asked->year);
    if (source.bytes && !strstr(ceduo_text_string(sources), source.bytes))
        ceduo_text_format(sources, sources->length > 0 ? "; %s" : "%s", source.bytes);
    ceduo_text_free(&source);
}

static void put_rows(struct ceduo_page *page, const struct ceduo_result *r, struct text *sources)
{
    for (size_t i = 0; i < r->scene->options_count; i++)
        for (size_t k = 0; k < r->scene->options[i].belts_count; k++) {
            const struct ceduo_compliance *c = &r->options[i].stands[k].rules;
            if (!c->of || is_listed(r, i, k))
                continue;
            bool species = r->scene->options[i].belts[k].stand.species >= 0;
            ceduo_text_put(ceduo_page_text(page), r->scene->options[i].belts[k].name);
            put_rule(page, c->standards, c->standards_item, c->standards_met, species);
            put_rule(page, c->turn, c->turn_item, c->turn_met, species);
            put_source(sources, c->standards_item);
            put_source(sources, isnan(c->turn) ? NULL : c->turn_item);
        }
}

static const struct ceduo_regulation *regulation_of(const struct ceduo_result *r)
{
    for (size_t i = 0; i < r->scene->options_count; i++)
        for (size_t k = 0; k < r->scene->options[i].belts_count; k++)
            if (r->options[i].stands[k].rules.of)
                return r->options[i].stands[k].rules.of;
    return NULL;
}

void ceduo_page_rules(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("stand"), 26, 2, CEDUO_WHOLE}, {N_("standards/ha"), -13, 0, 0}, {N_("asked for"), -13, 0, 0}, {N_("kept"), 5, 1, 0},
        {N_("turn, years"), -12, 0, 0},    {N_("asked for"), -13, 0, 0},    {N_("kept"), 0, 1, 0}};
    const struct ceduo_regulation *rules = regulation_of(r);
    struct text sources = {0};
    if (!rules)
        return;
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_SECTION), _("What the rules of %s ask"), rules->name);
    ceduo_page_table(page, columns, sizeof columns / sizeof columns[0]);
    put_rows(page, r, &sources);
    if (sources.length > 0)
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_DETAIL), _("Sources: %s."), ceduo_text_string(&sources));
    if (rules->note)
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE), _("%s: check the text in force; %s."), rules->name,
                          ceduo_words_shipped(rules->note));
    else
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE), _("%s: check the text in force."), rules->name);
    page->failed |= sources.failed;
    ceduo_text_free(&sources);
}
