/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An option year by year. */
#include <math.h>

#include "base/language.h"
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
    ceduo_text_format(ceduo_page_text(page), "%4u %s", y->year, y->cut ? P_("head", "cut") : "");
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
    static const struct ceduo_page_column columns[] = {{N_("year"), 9, 4, 0},
                                                       {N_("ADC m"), -7, 0, 0},
                                                       {"", 5, 1, 0},
                                                       {NP_("head", "free run"), -7, 0, CEDUO_SPAN},
                                                       {"", 5, 1, 0},
                                                       {N_("kJ/100 m"), -9, 0, 0},
                                                       {NULL, -16, 0, 0},
                                                       {NP_("head", "arr. kJ"), -8, 0, 0},
                                                       {NP_("head", "energy"), 0, 2, 0}};
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
    ceduo_text_then(line, " ", _("With %g rocks a year %s a year are to be expected to pass"), scene->rocks_per_year,
                    WRITTEN(s->passes_per_year, 2));
    if (says)
        ceduo_text_then(line, ", ", _("%s of them with too much energy"), WRITTEN(s->exceeds_per_year, 2));
    if (says)
        ceduo_text_then(line, "; ", _("in all %zu years %s and %s"), s->years,
                        WRITTEN(s->passes_per_year * (double)s->years, 2), WRITTEN(s->exceeds_per_year * (double)s->years, 2));
    else
        ceduo_text_then(line, "; ", _("in all %zu years %s"), s->years, WRITTEN(s->passes_per_year * (double)s->years, 2));
    ceduo_text_char(line, '.');
}

void ceduo_page_years_words(struct ceduo_page *page, const struct ceduo_result *r, const struct ceduo_years *years)
{
    const struct ceduo_years_summary s = ceduo_years_sum(years, r->last_control);
    bool says = !isnan(last_control(r)->accepted);
    struct text *line = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
    if (s.nothing) {
        ceduo_text_format(line,
                          ngettext("Of this %zu year nothing can be said.", "Of these %zu years nothing can be said.", s.years),
                          s.years);
        return;
    }
    ceduo_text_format(line,
                      ngettext("Of this %zu year: without contact %zu, with long free runs %zu",
                               "Of these %zu years: without contact %zu, with long free runs %zu", s.years),
                      s.years, s.unprotected_contact, s.unprotected_free_run);
    if (s.flown > 0 && says)
        ceduo_text_then(line, ", ", _("with too much energy %zu"), s.unprotected_energy);
    ceduo_text_put(line, ". ");
    if (s.thick_contact > s.unprotected_contact || s.thick_free_run > s.unprotected_free_run)
        ceduo_text_format(line, _("Counting only stems from %g cm on, contact fails in %zu and free run in %zu. "),
                          CEDUO_THICK_DBH * 100, s.thick_contact, s.thick_free_run);
    struct ceduo_paired mean = says ? s.exceed : s.reach;
    if (s.flown > 0 && isnan(mean.se)) /* of one rock */
        ceduo_text_format(line,
                          says ? _("In the mean %.0f of 1000 arrive with too much energy, at worst %.0f in year %u.")
                               : _("In the mean %.0f of 1000 arrive, at worst %.0f in year %u."),
                          mean.mean * 1000, s.worst * 1000, s.worst_year);
    else if (s.flown > 0)
        ceduo_text_format(
            line,
            says ? _("In the mean %.0f \xc2\xb1%.0f of 1000 arrive with too much energy, at worst %.0f in year %u.")
                 : _("In the mean %.0f \xc2\xb1%.0f of 1000 arrive, at worst %.0f in year %u."),
            mean.mean * 1000, ceil(mean.se * CEDUO_Z95 * 1000), s.worst * 1000, s.worst_year);
    else
        ceduo_text_format(line, _("The ADC is largest in year %u."), s.worst_year);
    if (r->scene->options_count < 2) { /* otherwise it stands below the table of all */
        ceduo_text_char(line, ' ');
        ceduo_words_counted(line, years->rocks);
    }
    if (s.flown > 0 && !isnan(r->scene->rocks_per_year))
        say_expected(line, r->scene, &s, says);
    double felled = ceduo_years_felled(years);
    if (felled > 0)
        ceduo_text_then(line, " ", _("Felled: %g m of forest along the slope."), felled);
}

void ceduo_page_years(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    if (page->width < CEDUO_PAGE_WIDTH)
        return;
    add_years_table(page, report->result, report->years[option]);
    ceduo_page_years_words(page, report->result, report->years[option]);
}
