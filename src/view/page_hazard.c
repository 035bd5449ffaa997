/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frequency and energy of scenes with blocks: sentences, energies of return periods, and the matrix of intensity and return
 * period, for all options and without forest. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "core/runs/hazard.h"
#include "page_parts.h"
#include "plot.h"

/* Return the hazard without forest (item 0) or of option item - 1; NULL: unknown. */
static const struct ceduo_hazard *get_hazard(const struct ceduo_result *r, size_t item, size_t control)
{
    return ceduo_hazard_find(item == 0 ? &r->bare.arrivals[control] : ceduo_result_wooded(r, item - 1, control));
}

static const char *get_name(const struct ceduo_result *r, size_t item)
{
    return item == 0 ? _("without forest") : r->scene->options_count == 1 ? _("with forest") : r->scene->options[item - 1].name;
}

/* ---- return periods as text ---- */

const char *ceduo_words_return_period(struct ceduo_estimate rate, char buffer[CEDUO_WORDS_SIZE])
{
    if (isnan(rate.mean) || rate.mean > 0)
        return ceduo_words_sig(1 / rate.mean, 2, buffer);
    snprintf(buffer, CEDUO_WORDS_SIZE, "> %s", SIG(1 / rate.hi, 2));
    return buffer;
}

const char *ceduo_words_return_period_range(struct ceduo_estimate rate, char buffer[CEDUO_WORDS_SIZE])
{
    const char *lo = SIG(1 / rate.hi, 2), *hi = SIG(1 / rate.lo, 2), *every = RETURN_PERIOD(rate);
    if (rate.mean > 0 && !(rate.lo > 0))
        snprintf(buffer, CEDUO_WORDS_SIZE, "%s (> %s)", every, lo);
    else
        snprintf(buffer, CEDUO_WORDS_SIZE, rate.mean > 0 && strcmp(lo, hi) != 0 ? "%s (%s\xe2\x80\x93%s)" : "%s", every, lo,
                 hi);
    return buffer;
}

/* ---- energies of return periods ---- */

void ceduo_page_return(struct ceduo_page *page, const struct ceduo_hazard *h, size_t i)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    const struct ceduo_estimate e = h ? h->returns[i].energy : CEDUO_NO_ESTIMATE;
    struct text *const texts[] = {&cell->text, &cell->shorter};
    int power = e.mean > 0 ? (int)floor(log10(e.mean * J_TO_KJ)) : 0;
    for (int k = 0; k < (isnan(e.mean) ? 0 : 2); k++) { /* short form: 1.2 (1.1–1.3)e7 */
        double scale = J_TO_KJ / (k == 0 ? 1 : pow(10, power));
        int digits = 3 - k;
        ceduo_text_append(texts[k], SIG(e.mean * scale, digits));
        if (isnan(e.hi))
            ceduo_text_format(texts[k], " (> %s)", SIG(isnan(e.lo) ? 0 : e.lo * scale, digits));
        else
            ceduo_text_format(texts[k], " (%s\xe2\x80\x93%s)", SIG(isnan(e.lo) ? 0 : e.lo * scale, digits),
                              SIG(e.hi * scale, digits));
    }
    if (isnan(e.mean))
        ceduo_text_append(&cell->text, _("none"));
    else
        ceduo_text_format(&cell->shorter, "e%d", power);
}

/* ---- matrix ---- */

static void add_matrix(struct ceduo_page *page, const struct ceduo_result *r, size_t control)
{
    static const struct ceduo_page_column columns[] = {
        {NP_("head", "intensity"), 26, 4, COL_WRAP}, {"", 15, 0, COL_WRAP}, {"", 15, 0, COL_WRAP}, {"", 0, 0, 0}};
    static const char *const rows[] = {N_("none arrives"), N_("weak, below 30 kJ"), N_("medium, 30 to 300 kJ"),
                                       N_("strong, above 300 kJ")};
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, _("Intensity by return period, in the classes of Swiss practice (BAFU 2016):"));
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t t = 1; t < CEDUO_RETURNS; t++)
        ceduo_text_format(&page->last->cells[t].text, _("to %u years"), ceduo_return_years[t]);
    for (int i = CEDUO_INTENSITIES - 1; i >= -1; i--) { /* -1: none arrives within the return period */
        ceduo_page_cell_format(page, "%s", _(rows[i + 1]));
        for (size_t t = 1; t < CEDUO_RETURNS; t++) {
            struct text *cell = ceduo_page_text(page); /* numbers of the options in this class */
            for (size_t k = 0; k <= r->scene->options_count; k++) {
                const struct ceduo_hazard *h = get_hazard(r, k, control);
                const struct ceduo_estimate energy = h ? h->returns[t].energy : CEDUO_NO_ESTIMATE;
                if (h && ceduo_intensity_find(energy.mean) == i)
                    ceduo_text_format(cell, cell->length > 0 ? " %zu" : "%zu", k);
            }
            ceduo_text_append(cell, cell->length == 0 ? "\xc2\xb7" : "");
        }
    }
    struct text *names = ceduo_page_add(page, CEDUO_PAGE_SENTENCE);
    for (size_t i = 0; i <= r->scene->options_count; i++)
        if (get_hazard(r, i, control))
            ceduo_text_format(names, i == 0 ? "%zu %s" : ", %zu %s", i, get_name(r, i));
    ceduo_text_append_char(names, '.');
}

/* ---- at each control ---- */

void ceduo_page_hazard(struct ceduo_page *page, const struct ceduo_report *report, size_t c, bool first)
{
    const struct ceduo_result *r = report->result;
    const struct ceduo_control *control = &r->scene->controls[c];
    if (!ceduo_report_has_hazard(report))
        return;
    ceduo_page_para(page, CEDUO_PAGE_SECTION, _("How often, at %s m%s%s"), LOCALIZED(control->x_given),
                    control->name ? ", " : "", control->name ? control->name : "");
    if (first)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE,
                        _("%g blocks fall per year. Rare large blocks were simulated as often as small ones, and weighted: "
                          "%llu rocks count as %.0f (effective sample size)."),
                        get_hazard(r, 0, c)->per_year, (unsigned long long)r->bare.rocks, get_hazard(r, 0, c)->effective);
    ceduo_page_para(
        page, CEDUO_PAGE_CAPTION,
        _("Return period of such a rock, years, and rocks that arrive by intensity, in %% of those without forest:"));
    ceduo_page_options(page, report, CEDUO_OPTIONS_RATES, c, SIZE_MAX, 0, SIZE_MAX);
    ceduo_page_para(page, CEDUO_PAGE_CAPTION, "%s",
                    _("Energy reached or exceeded once per return period, kJ (95 % interval):"));
    ceduo_page_options(page, report, CEDUO_OPTIONS_RETURNS, c, SIZE_MAX, 0, SIZE_MAX);
    add_matrix(page, r, c);
}

bool ceduo_report_has_hazard(const struct ceduo_report *report)
{
    return report->result->scene->blocks_count > 0 && report->result->bare.rocks > 0;
}
