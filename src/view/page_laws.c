/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One energy law of stems against the other, at the last control. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"
#include "scene/words.h"

static bool is_known(const struct ceduo_other_energy *other)
{
    return other->known && other->stems;
}

static bool any_is_known(const struct ceduo_result *r)
{
    for (size_t i = 0; r->wooded && i < r->scene->options_count; i++)
        if (is_known(&r->options[i].others[r->last_control]))
            return true;
    return false;
}

/* The law of the scene, or that its stands have several. */
static const char *law_of(const struct ceduo_option *option)
{
    const char *law = NULL;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        if (ceduo_stand_is_bare(stand))
            continue;
        const char *here = ceduo_energy_words.names[stand->energy];
        if (law && law != here)
            return _("several");
        law = here;
    }
    return law ? law : "-";
}

static void put_option(struct ceduo_page *page, const struct ceduo_result *r, size_t i)
{
    const struct ceduo_arrivals *a = ceduo_result_wooded(r, i, r->last_control);
    const struct ceduo_other_energy *other = &r->options[i].others[r->last_control];
    ceduo_text_put(ceduo_page_text(page), r->scene->options[i].name);
    ceduo_text_put(ceduo_page_text(page), law_of(&r->scene->options[i]));
    ceduo_text_format(ceduo_page_text(page), "%.0f", 1000 * ceduo_share_at(a).mean);
    ceduo_page_number(page, a->energy.mean * KILO, 3);
    ceduo_text_put(ceduo_page_text(page), is_known(other) ? ceduo_energy_words.names[other->model] : "-");
    if (is_known(other))
        ceduo_text_format(ceduo_page_text(page), "%.0f", 1000 * ceduo_share_by_other_law(other));
    else
        ceduo_text_put(ceduo_page_text(page), "-");
    ceduo_page_number(page, is_known(other) ? other->energy * KILO : NAN, 3);
}

static void put_table(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("option"), 23, 2, 0},           {NP_("head", "law of the scene"), 16, 1, 0}, {NP_("head", "of 1000"), -8, 0, 0},
        {NP_("head", "mean kJ"), -8, 0, 0}, {NP_("head", "other law"), 11, 2, 0},        {NP_("head", "of 1000"), -8, 0, 0},
        {NP_("head", "mean kJ"), -8, 0, 0}};
    ceduo_page_table(page, columns, sizeof columns / sizeof columns[0]);
    for (size_t i = 0; i < r->scene->options_count; i++)
        put_option(page, r, i);
}

void ceduo_page_laws(struct ceduo_page *page, const struct ceduo_result *r)
{
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    char x[CEDUO_NUMBER_ROOM], accepted[CEDUO_NUMBER_ROOM];
    if (!any_is_known(r))
        return;
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_SECTION), _("One energy law against the other"));
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                   _("Two published laws disagree about what thin stems take from a rock (Brauner et al. 2005; Dorren et al. "
                     "2006), and nobody knows yet which of them holds there. What differs here, more rocks cannot decide."));
    ceduo_number_shortest(c->x_given, x);
    struct text *caption = ceduo_page_add(page, CEDUO_PAGE_CAPTION);
    if (isnan(c->accepted))
        ceduo_text_format(caption, _("The same rocks at %s m: how many of 1000 arrive, and their mean energy:"), x);
    else
        ceduo_text_format(
            caption,
            _("The same rocks at %s m: how many of 1000 arrive with more than %s kJ, and the mean energy of those "
              "that arrive:"),
            x, ceduo_number_shortest(ceduo_words_accepted(c), accepted));
    put_table(page, r);
}
