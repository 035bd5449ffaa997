/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One energy law of stems against the other, at the last control. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"
#include "scene/choices.h"

static bool is_known(const struct ceduo_other_energy *other)
{
    return other->known && other->stems;
}

/* In the terminal program the figures by the other law may be there before those of the scene's own. */
static bool is_compared(const struct ceduo_result *r, size_t option)
{
    return is_known(&r->options[option].others[r->last_control]) && ceduo_result_wooded(r, option, r->last_control);
}

/* The law of the scene, or that its stands have several. */
static const char *law_of(const struct ceduo_option *option)
{
    const char *law = NULL;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_stand *stand = &option->belts[i].stand;
        const char *here = ceduo_stand_is_bare(stand) ? law : ceduo_energy_words.names[stand->energy];
        if (law && law != here)
            return _("several");
        law = here;
    }
    return law ? law : "-";
}

static void add_option(struct ceduo_page *page, const struct ceduo_result *r, size_t i)
{
    const struct ceduo_arrivals *a = ceduo_result_wooded(r, i, r->last_control);
    const struct ceduo_other_energy *other = &r->options[i].others[r->last_control];
    bool known = is_known(other);
    ceduo_page_write(page, "%s", r->scene->options[i].name);
    ceduo_page_write(page, "%s", law_of(&r->scene->options[i]));
    ceduo_page_write(page, "%.0f", 1000 * ceduo_share_at(a).mean);
    ceduo_page_number(page, a->energy.mean * J_TO_KJ, 3);
    ceduo_page_write(page, "%s", known ? ceduo_energy_words.names[other->model] : "-");
    ceduo_page_write(page, "%s", known ? WRITTEN(1000 * ceduo_share_by_other_law(other), 0) : "-");
    ceduo_page_number(page, known ? other->energy * J_TO_KJ : NAN, 3);
}

void ceduo_page_laws(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column columns[] = {
        {N_("option"), 23, 2, 0},           {NP_("head", "law of the scene"), 16, 1, 0}, {NP_("head", "of 1000"), -8, 0, 0},
        {NP_("head", "mean kJ"), -8, 0, 0}, {NP_("head", "other law"), 11, 2, 0},        {NP_("head", "of 1000"), -8, 0, 0},
        {NP_("head", "mean kJ"), -8, 0, 0}};
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    bool any = false;
    for (size_t i = 0; r->wooded && i < r->scene->options_count; i++)
        any |= is_compared(r, i);
    if (!any)
        return;
    ceduo_page_say(page, CEDUO_PAGE_SECTION, _("One energy law against the other"));
    ceduo_page_note(page,
                    _("Two published laws disagree about what thin stems take from a rock (Brauner et al. 2005; Dorren et "
                      "al. 2006), and nobody knows yet which of them holds there. What differs here, more rocks cannot "
                      "decide."));
    const struct ceduo_measure judged = ceduo_judged(c, NULL);
    LOCAL_TEXT(phrase);
    ceduo_measure_name(&phrase, &judged, CEDUO_PHRASE);
    ceduo_page_say(page, CEDUO_PAGE_CAPTION,
                   _("The same rocks at %s m: how many of 1000 %s, and the mean energy of those that arrive:"),
                   SHORTEST(c->x_given), ceduo_text_string(&phrase));
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < r->scene->options_count; i++)
        if (ceduo_result_wooded(r, i, r->last_control))
            add_option(page, r, i);
}
