/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An option year by year, and the options side by side over the years. */
#include <math.h>
#include <stdlib.h>

#include "base/intl.h"
#include "page_parts.h"

static const struct ceduo_control *last_control(const struct ceduo_result *r)
{
    return &r->scene->controls[r->last_control];
}

/* ---- one option ---- */

static void add_year(struct ceduo_page *page, const struct ceduo_year *y, size_t control)
{
    const struct ceduo_index *s = &y->controls[control];
    const struct ceduo_arrivals *a = y->wooded.rocks > 0 ? &y->wooded.arrivals[control] : NULL;
    ceduo_text_format(ceduo_page_text(page), "%4u %s", y->year, y->cut ? _("cut") : "");
    ceduo_page_number(page, s->worst_adc, 3);
    ceduo_page_verdict(page, s->contact);
    ceduo_page_percent(page, s->worst_free_run);
    ceduo_page_verdict(page, s->free_run);
    ceduo_page_number(page, s->per_100m * KILO, 3);
    ceduo_page_share(page, a);
    ceduo_page_number(page, a ? a->energy.mean * KILO : NAN, 3);
    ceduo_page_verdict(page, s->energy);
}

static void add_years_table(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_years *years)
{
    static const struct ceduo_page_column columns[] = {
        {N_("year"), 9, 4, 0}, {N_("ADC m"), -7, 0, 0},    {"", 5, 1, 0},    {N_("free run"), -7, 0, CEDUO_SPAN},
        {"", 5, 1, 0},         {N_("kJ/100 m"), -9, 0, 0}, {NULL, -16, 0, 0}, {N_("mean kJ"), -8, 0, 0},
        {N_("energy"), 0, 2, 0}};
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(ceduo_page_add(page, CEDUO_PAGE_CAPTION), _("Year by year, up to %s m:"),
                      ceduo_number_shortest(last_control(r)->x_given, room));
    ceduo_page_table(page, columns, sizeof columns / sizeof columns[0]);
    ceduo_page_limit(page, last_control(r), _("of 1000 arrive"));
    for (size_t i = 0; i < years->count; i++)
        add_year(page, &years->years[i], r->last_control);
}

/* How many rocks are to be expected, where the scene says how many come down. */
static void say_expected(struct text *line, const struct ceduo_scene *scene, const struct ceduo_years_summary *s, bool says)
{
    ceduo_text_format(line, _(" With %g rocks a year %.3g a year are to be expected to pass"), scene->rocks_per_year,
                      s->passes_per_year);
    if (says)
        ceduo_text_format(line, _(", %.3g of them with too much energy"), s->exceeds_per_year);
    ceduo_text_format(line, _("; in all %zu years %.3g"), s->years, s->passes_per_year * (double)s->years);
    if (says)
        ceduo_text_format(line, _(" and %.3g"), s->exceeds_per_year * (double)s->years);
    ceduo_text_char(line, '.');
}

/* The years together. */
static void say_years(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_years *years)
{
    const struct ceduo_years_summary s = ceduo_years_sum(years, r->last_control);
    bool says = !isnan(last_control(r)->accepted);
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
    ceduo_text_format(line, ngettext("Of this %zu year: without contact %zu, with long free runs %zu",
                                     "Of these %zu years: without contact %zu, with long free runs %zu", s.years),
                      s.years, s.unprotected_contact, s.unprotected_free_run);
    if (s.flown > 0 && says)
        ceduo_text_format(line, _(", with too much energy %zu"), s.unprotected_energy);
    ceduo_text_put(line, ". ");
    struct ceduo_paired mean = says ? s.exceed : s.reach;
    if (s.flown > 0)
        ceduo_text_format(line,
                          says ? _("In the mean %.0f \xc2\xb1%.0f of 1000 arrive with too much energy, at worst %.0f in year %u.")
                               : _("In the mean %.0f \xc2\xb1%.0f of 1000 arrive, at worst %.0f in year %u."),
                          mean.mean * 1000, ceil(mean.se * CEDUO_Z95 * 1000), s.worst * 1000, s.worst_year);
    else
        ceduo_text_format(line, _("The ADC is largest in year %u."), s.worst_year);
    if (s.flown > 0 && !isnan(r->scene->rocks_per_year))
        say_expected(line, r->scene, &s, says);
    double felled = ceduo_years_felled(years);
    if (felled > 0)
        ceduo_text_format(line, _(" Felled: %g m of forest along the slope."), felled);
}

void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    if (page->width < CEDUO_PAGE_WIDTH)
        return;
    add_years_table(page, report->result, report->years[option]);
    say_years(page, report->result, report->years[option]);
}

/* ---- options side by side ---- */

/* What is compared over the years: the mean share of the released with too much energy, or where that is not said that
 * arrives. */
static struct ceduo_paired mean_of_years(const struct ceduo_result *r, const struct ceduo_years_summary *s)
{
    return isnan(last_control(r)->accepted) ? s->reach : s->exceed;
}

static void add_count(struct ceduo_page *page, size_t count)
{
    ceduo_text_format(ceduo_page_text(page), "%zu", count);
}

static void add_rotation(struct ceduo_page *page, const struct ceduo_result *r, size_t i, const struct ceduo_years_summary *s)
{
    struct ceduo_paired mean = mean_of_years(r, s);
    ceduo_text_put(ceduo_page_text(page), r->scene->options[i].name);
    add_count(page, s->unprotected_contact);
    add_count(page, s->unprotected_free_run);
    if (s->flown > 0) {
        add_count(page, s->unprotected_energy);
        ceduo_page_per_1000(page, mean.mean, mean.se * CEDUO_Z95, false);
        ceduo_text_format(ceduo_page_text(page), "%.0f (%u)", s->worst * 1000, s->worst_year);
    } else {
        struct text *worst = ceduo_page_text(page);
        ceduo_words_number(worst, s->worst, 3);
        ceduo_text_format(worst, " (%u)", s->worst_year);
    }
}

static void add_rotations_table(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_years_summary *sums)
{
    static const struct ceduo_page_column flown[] = {
        {N_("option"), 23, 2, 0}, {N_("contact"), -8, 0, 0}, {N_("free run"), -9, 0, 0},
        {N_("energy"), -7, 0, 0}, {NULL, -13, 0, 0},         {N_("worst (year)"), -14, 0, 0}};
    static const struct ceduo_page_column by_index[] = {
        {N_("option"), 23, 2, 0}, {N_("contact"), -8, 0, 0}, {N_("free run"), -9, 0, 0}, {N_("ADC m (year)"), -14, 0, 0}};
    if (sums[0].flown > 0) {
        ceduo_page_table(page, flown, sizeof flown / sizeof flown[0]);
        ceduo_page_limit(page, last_control(r), _("arrive"));
    } else {
        ceduo_page_table(page, by_index, sizeof by_index / sizeof by_index[0]);
    }
    for (size_t i = 0; i < r->scene->options_count; i++)
        add_rotation(page, r, i, &sums[i]);
}

/* Which option lets the fewest through over the years. The same rocks fly in all of them, so errors go together, and two
 * standard errors as of independent figures are rather too many. */
static void say_best_rotation(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_years_summary *sums)
{
    size_t n = r->scene->options_count, best = 0, worse = 0;
    for (size_t i = 1; i < n; i++)
        if (mean_of_years(r, &sums[i]).mean < mean_of_years(r, &sums[best]).mean)
            best = i;
    struct ceduo_paired least = mean_of_years(r, &sums[best]);
    for (size_t i = 0; i < n; i++) {
        struct ceduo_paired mean = mean_of_years(r, &sums[i]);
        worse += mean.mean - least.mean > 2 * hypot(mean.se, least.se);
    }
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_NOTE);
    if (worse == 0)
        ceduo_text_put(line, _("In the mean of these years no option is clearly better by energy."));
    else
        ceduo_text_format(line, worse == n - 1 ? _("In the mean of these years '%s' lets the fewest through.")
                                               : _("In the mean of these years '%s' lets the fewest through, though not "
                                                   "clearly before all others."), r->scene->options[best].name);
}

void ceduo_page_rotations(struct ceduo_page *page, const struct ceduo_report *report)
{
    const struct ceduo_result *r = report->result;
    size_t n = r->scene->options_count;
    struct ceduo_years_summary *sums = calloc(n, sizeof *sums);
    char room[CEDUO_NUMBER_ROOM];
    page->failed |= !sums;
    if (!sums)
        return;
    for (size_t i = 0; i < n; i++)
        sums[i] = ceduo_years_sum(report->years[i], r->last_control);
    struct text *head = ceduo_page_add(page, CEDUO_PAGE_SECTION);
    ceduo_text_format(head, ngettext("Side by side over %zu year, up to %s m: years in which a test fails",
                                     "Side by side over %zu years, up to %s m: years in which a test fails", sums[0].years),
                      sums[0].years, ceduo_number_shortest(last_control(r)->x_given, room));
    if (sums[0].flown > 0)
        ceduo_text_put(head, _("; of 1000 released, in the mean and in the worst year"));
    add_rotations_table(page, r, sums);
    if (sums[0].flown > 0)
        say_best_rotation(page, r, sums);
    free(sums);
}
