/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options side by side at the last control. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "study/verdict.h"

static void add_simulated(struct ceduo_page *page, const struct ceduo_result *r, size_t i)
{
    const struct ceduo_arrivals *a = ceduo_result_wooded(r, i, r->last_control);
    struct ceduo_portion share = ceduo_share_at(a);
    struct ceduo_paired to_first = ceduo_share_to_first(r, i);
    ceduo_page_per_1000(page, share.mean, share.half, false);
    if (to_first.below > 0)
        ceduo_text_format(ceduo_page_text(page), "< %.0f", ceil(to_first.below * 1000));
    else if (i > 0 && to_first.mean == 0 && to_first.se == 0)
        ceduo_text_put(ceduo_page_text(page), _("the same"));
    else
        ceduo_page_per_1000(page, i == 0 ? NAN : to_first.mean, CEDUO_Z95 * to_first.se, true);
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

/* What arrives with more than is withstood comes first. */
static void add_row(struct ceduo_page *page, const struct ceduo_result *r, size_t i)
{
    const struct ceduo_index *s = ceduo_result_last_index(r, i);
    ceduo_text_put(ceduo_page_text(page), r->scene->options[i].name);
    if (r->wooded)
        add_simulated(page, r, i);
    ceduo_page_number(page, s->worst_adc, 3);
    ceduo_page_verdict(page, s->contact);
    ceduo_page_percent(page, s->worst_free_run);
    ceduo_page_verdict(page, s->free_run);
    if (!r->wooded)
        add_by_index(page, s);
}

#define OPTION                                                                                                                 \
    {                                                                                                                          \
        N_("option"), 23, 2, 0                                                                                                 \
    }
#define BY_CONTACT                                                                                                             \
    {N_("ADC m"), -7, 0, 0}, {"", 5, 1, 0},                                                                                    \
    {                                                                                                                          \
        NP_("head", "free run"), -7, 0, CEDUO_SPAN                                                                             \
    }

static void add_table(struct ceduo_page *page, const struct ceduo_result *r)
{
    static const struct ceduo_page_column wooded[] = {
        OPTION,     {NULL, -10, 0, 0}, {NP_("head", "to first"), -11, 0, 0}, {NP_("head", "energy"), 6, 2, 0},
        BY_CONTACT, {"", 0, 1, 0}};
    static const struct ceduo_page_column by_index[] = {
        OPTION, BY_CONTACT, {"", 5, 1, 0}, {N_("kJ/100 m"), -10, 0, 0}, {NP_("head", "left kJ"), -10, 0, 0}};
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
static void say_separation(struct ceduo_page *page, const struct ceduo_result *r, size_t light, const char *all,
                           const char *none)
{
    size_t n = r->scene->options_count, pass = 0;
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_index *s = ceduo_result_last_index(r, i);
        const enum ceduo_light lights[] = {s->contact, s->free_run, s->energy};
        pass += lights[light] == CEDUO_PASS;
    }
    if (pass == n || (pass == 0 && ceduo_result_last_index(r, 0)->contact != CEDUO_UNKNOWN))
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE), pass == n ? all : none);
}

/* ---- over the years ---- */

/* `known`: false also where nothing can be said. */
static void add_fails(struct ceduo_page *page, const struct ceduo_choice *c, size_t fails, bool known)
{
    struct text *text = ceduo_page_text(page);
    if (known)
        ceduo_text_format(text, "%zu/%zu", fails, c->years);
    else
        ceduo_text_char(text, '-');
}

static void add_choice(struct ceduo_page *page, const char *name, const struct ceduo_choice *c)
{
    ceduo_text_put(ceduo_page_text(page), name);
    if (c->flown > 0) {
        ceduo_page_per_1000(page, c->mean.mean, c->mean.half, false);
        ceduo_text_format(ceduo_page_text(page), "%.0f (%u)", c->worst.mean * 1000, c->worst_year);
    } else {
        struct text *worst = ceduo_page_text(page);
        ceduo_words_number(worst, c->worst.mean, 3);
        ceduo_text_format(worst, " (%u)", c->worst_year);
    }
    add_fails(page, c, c->no_contact, !c->nothing);
    add_fails(page, c, c->free_runs, !c->nothing);
    if (c->flown > 0)
        add_fails(page, c, c->too_much, c->energy_known);
    ceduo_page_number(page, c->yield.cut_per_year, 2);
    ceduo_page_number(page, c->yield.standing, 3);
}

static void add_years_table(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_verdict *v)
{
    static const struct ceduo_page_column flown[] = {{N_("option"), 22, 2, 0},
                                                     {NULL, -10, 0, 0},
                                                     {NP_("head", "worst year"), -11, 0, 0},
                                                     {NP_("head", "contact"), -8, 0, 0},
                                                     {NP_("head", "free run"), -9, 0, 0},
                                                     {NP_("head", "energy"), -7, 0, 0},
                                                     {NP_("head", "m3/y"), -5, 0, 0},
                                                     {N_("m3"), -6, 0, 0}};
    static const struct ceduo_page_column by_index[] = {
        {N_("option"), 23, 2, 0},           {NP_("head", "ADC m, worst"), -14, 0, 0},
        {NP_("head", "contact"), -8, 0, 0}, {NP_("head", "free run"), -9, 0, 0},
        {NP_("head", "m3/y"), -6, 0, 0},    {N_("m3"), -7, 0, 0}};
    struct text *caption = ceduo_page_add(page, CEDUO_PAGE_CAPTION);
    struct text span = {0};
    ceduo_words_span(&span, v);
    if (v->wooded)
        ceduo_text_format(
            caption,
            _("Over %s: of 1000 released, in the mean and in the worst of these years, counted from today, with %llu "
              "rocks in each; years in which a test fails; wood felled per hectare and year, and standing:"),
            ceduo_text_string(&span), (unsigned long long)v->choices[0].rocks);
    else
        ceduo_text_format(
            caption,
            _("Over %s: the worst year, counted from today; years in which a test fails; wood felled per hectare and "
              "year, and standing:"),
            ceduo_text_string(&span));
    caption->failed |= span.failed;
    ceduo_text_free(&span);
    if (v->choices[0].flown > 0) {
        ceduo_page_table(page, flown, sizeof flown / sizeof flown[0]);
        ceduo_page_limit(page, &r->scene->controls[r->last_control], _("arrive"));
    } else {
        ceduo_page_table(page, by_index, sizeof by_index / sizeof by_index[0]);
    }
    for (size_t i = 0; i < v->n; i++)
        add_choice(page, r->scene->options[i].name, &v->choices[i]);
}

static void add_note(void *page, const char *sentence)
{
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE), sentence);
}

/* What a yield leaves out. */
static void say_yield(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_verdict *v)
{
    bool known = false;
    for (size_t i = 0; i < v->n; i++) {
        known |= !isnan(v->choices[i].yield.cut_per_year);
        if (v->choices[i].yield.space > 1)
            ceduo_text_format(
                ceduo_page_add(page, CEDUO_PAGE_NOTE),
                _("'%s' keeps more standards than the ground bears (%.0f %% of the growing space): its yield is not computed."),
                r->scene->options[i].name, 100 * v->choices[i].yield.space);
    }
    if (known)
        add_note(page, _("Yield: standards take growing space from the shoots (assumed). Side light, roots and the quality of "
                         "the wood are not modelled."));
}

static void say_best(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_verdict *v)
{
    struct text best = {0};
    ceduo_words_best(&best, r->scene, v);
    char *second = best.bytes ? strchr(best.bytes, '\n') : NULL;
    if (second)
        *second++ = '\0';
    if (best.length > 0)
        add_note(page, best.bytes);
    if (second)
        add_note(page, second);
    page->failed |= best.failed;
    ceduo_text_free(&best);
    ceduo_words_turned(r, v, add_note, page);
    if (v->choices[0].years > 0)
        ceduo_words_windows(r->scene, v, add_note, page);
    if (v->wooded && !v->accepted)
        add_note(page, _("What the place withstands is not given (accepted_kJ): energy is not judged."));
}

void ceduo_page_comparison(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_verdict *v = report->verdict;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_SECTION),
                      r->wooded ? _("Side by side, up to %s m: the same rocks through each wood, of 1000 released")
                                : _("Side by side, up to %s m (kJ per 100 m and left: by the rule named above)"),
                      ceduo_number_shortest(c->x_given, room));
    ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_CAPTION), _("Today:"));
    add_table(page, r);
    say_separation(page, r, 0, _("Today all options pass the test of contact: it does not separate them."),
                   _("Today no option passes the test of contact: it does not separate them."));
    say_separation(page, r, 1, _("Today all options pass the test of free run: it does not separate them."),
                   _("Today no option passes the test of free run: it does not separate them."));
    if (r->wooded && !isnan(c->accepted))
        say_separation(page, r, 2, _("Today all options pass the test of energy: it does not separate them."),
                       _("Today no option passes the test of energy: it does not separate them."));
    if (v && v->choices[0].years > 0) {
        add_years_table(page, r, v);
        say_yield(page, r, v);
    }
    if (v)
        say_best(page, r, v);
    if (!r->wooded)
        ceduo_text_put(ceduo_page_add(page, CEDUO_PAGE_NOTE),
                       _("Without forest every option sees the same rocks: what arrives does not separate them. The index "
                         "says what stems could take, not what a rock loses; no column decides alone."));
}
