/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options side by side at the last control. */
#include <math.h>

#include "base/intl.h"
#include "page_parts.h"
#include "study/compare.h"

static void add_simulated(struct ceduo_page *page, const struct ceduo_result *r, size_t i)
{
    double half, half_of_difference, difference = ceduo_compare_difference(r, i, &half_of_difference);
    double share = ceduo_compare_share(r, i, &half);
    ceduo_page_per_1000(page, share, half, false);
    ceduo_page_per_1000(page, i == 0 ? NAN : difference, half_of_difference, true);
    ceduo_page_verdict(page, ceduo_result_last_index(r, i)->energy);
}

static void add_by_index(struct ceduo_page *page, const struct ceduo_index *s)
{
    ceduo_page_number(page, s->per_100m * KILO, 3);
    if (s->exhausted)
        ceduo_text_put(ceduo_page_text(page), _("used up"));
    else
        ceduo_page_number(page, s->residual * KILO, 3);
}

static void add_row(struct ceduo_page *page, const struct ceduo_result *r, size_t i)
{
    const struct ceduo_index *s = ceduo_result_last_index(r, i);
    ceduo_text_put(ceduo_page_text(page), r->scene->options[i].name);
    ceduo_page_number(page, s->worst_adc, 3);
    ceduo_page_verdict(page, s->contact);
    ceduo_page_percent(page, s->worst_free_run);
    ceduo_page_verdict(page, s->free_run);
    if (r->wooded)
        add_simulated(page, r, i);
    else
        add_by_index(page, s);
}

#define BY_CONTACT \
    {N_("option"), 23, 2, 0}, {N_("ADC m"), -7, 0, 0}, {"", 5, 1, 0}, {N_("free run"), -7, 0, CEDUO_SPAN}, {"", 5, 1, 0}

static void add_table(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column wooded[] = {
        BY_CONTACT, {NULL, -10, 0, 0}, {N_("to first"), -11, 0, 0}, {N_("energy"), 4, 2, 0}};
    static const struct ceduo_page_column by_index[] = {
        BY_CONTACT, {N_("kJ/100 m"), -10, 0, 0}, {N_("left kJ"), -10, 0, 0}};
    if (r->wooded) {
        ceduo_page_table(page, wooded, sizeof wooded / sizeof wooded[0]);
        ceduo_page_limit(page, &r->scene->controls[r->last_control], _("arrive"));
    } else {
        ceduo_page_table(page, by_index, sizeof by_index / sizeof by_index[0]);
    }
    for (size_t i = 0; i < r->scene->options_count; i++)
        add_row(page, r, i);
}

/* A test that all options pass, or none, says nothing about which to choose. */
static void say_separation(struct ceduo_page *page, const struct ceduo_result *r, const char *test, size_t light)
{
    size_t n = r->scene->options_count, pass = 0;
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_index *s = ceduo_result_last_index(r, i);
        const enum ceduo_light lights[] = {s->contact, s->free_run, s->energy};
        pass += lights[light] == CEDUO_PASS;
    }
    if (pass == n)
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                          _("All options pass the test of %s: it does not separate them."), test);
    else if (pass == 0)
        ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                          _("No option passes the test of %s: it does not separate them."), test);
}

static void say_best(struct ceduo_page *page, const struct ceduo_result *r)
{
    struct text best = {0};
    ceduo_words_best(&best, r);
    if (best.length > 0)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE), best.bytes);
    page->failed |= best.failed;
    ceduo_text_free(&best);
}

void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_result *r)
{
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_SECTION),
                      r->wooded ? _("Side by side, up to %s m: the same rocks through each wood, of 1000 released")
                                : _("Side by side, up to %s m (kJ per 100 m and left: by the rule named above)"),
                      ceduo_number_shortest(c->x_given, room));
    add_table(page, r);
    say_separation(page, r, _("contact"), 0);
    say_separation(page, r, _("free run"), 1);
    if (r->wooded && !isnan(c->accepted))
        say_separation(page, r, _("energy"), 2);
    say_best(page, r);
    if (!r->wooded)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                       _("Without forest every option sees the same rocks: what arrives does not separate them. The index "
                         "says what stems could take, not what a rock loses; no column decides alone."));
}
