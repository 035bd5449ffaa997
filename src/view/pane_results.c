/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table that the paper's method ends in: the energy that is left, without forest, by the index, and simulated. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"
#include "pane.h"
#include "plot_parts.h"

static void add_simulated(struct ceduo_page *page, const char *name, const struct ceduo_control *c,
                          const struct ceduo_arrivals *a)
{
    const struct ceduo_measure p95 = ceduo_energy_p95(a), judged = ceduo_judged(c, a);
    ceduo_page_write(page, "%s", name);
    ceduo_page_mean(page, a);
    ceduo_page_number(page, p95.value, p95.digits);
    ceduo_page_interval(page, &judged);
}

/* A mean alone. */
static void add_mean(struct ceduo_page *page, const char *name, const char *mean)
{
    ceduo_page_write(page, "%s", name);
    ceduo_page_write(page, "%s", mean);
    ceduo_page_write(page, "-");
    ceduo_page_write(page, "-");
}

void ceduo_pane_residual(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    static const struct ceduo_page_column columns[] = {
        {"", 14, 0, CEDUO_FILLS}, {NULL, -6, 1, CEDUO_FITS}, {"", -5, 1, CEDUO_FITS}, {"", -7, 2, CEDUO_FITS}};
    const struct ceduo_result *r = pane->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    const struct ceduo_arrivals *bare = &r->bare.arrivals[r->last_control],
                                *wood = ceduo_result_wooded(r, pane->option, r->last_control);
    const struct ceduo_index *index = ceduo_result_last_index(r, pane->option);
    const struct ceduo_measure mean = ceduo_mean_energy(bare), judged = ceduo_judged(c, bare);
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *heads = page->last->cells;
    ceduo_text_format(&heads[0].text, _("energy left at %g m"), c->x_given);
    ceduo_text_format(&heads[0].shorter, _("left at %g m"), c->x_given);
    ceduo_measure_name(&heads[1].text, &mean, CEDUO_SHORT_HEAD);
    ceduo_text_put(&heads[2].text, _("95 %"));
    ceduo_measure_name(&heads[3].text, &judged, CEDUO_SHORT_HEAD);
    add_simulated(page, _("without forest"), c, bare);
    if (r->scene->options[pane->option].belts_count > 0)
        add_mean(page, _("index (Eq. 5)"), index->exhausted ? _("used up") : WRITTEN(index->residual * J_TO_KJ, 3));
    if (wood && r->scene->options[pane->option].belts_count > 0)
        add_simulated(page, _("simulated"), c, wood);
    if (!isnan(index->measured))
        add_mean(page, _("measured"), WRITTEN(index->measured * J_TO_KJ, 3));
}

void ceduo_pane_words(struct ceduo_page *page, const struct ceduo_report *report, size_t option)
{
    if (report->result->scene->options_count > 1)
        ceduo_page_say(page, CEDUO_PAGE_TITLE, "%s", report->result->scene->options[option].name);
    ceduo_page_option(page, report, option, true);
    ceduo_words_run_warnings(report->result, &report->remarks, ceduo_page_warn, page);
}

void ceduo_pane_doubt(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    static const enum ceduo_doubt_kind lights[] = {CEDUO_DOUBT_CONTACT, CEDUO_DOUBT_FREE_RUN, CEDUO_DOUBT_EXCEED};
    const struct ceduo_doubt_report *r = pane->coarse;
    if (!r || !r->answer)
        return;
    ceduo_doubt_both(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option);
    ceduo_doubt_advice(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option, 0);
    const struct ceduo_doubt_ranking *ranking = ceduo_doubt_verdict(r->answer);
    for (size_t i = 0; i < ranking->count; i++)
        if (ranking->orders[i].better == pane->option || ranking->orders[i].than == pane->option)
            ceduo_doubt_order_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, i);
    for (size_t i = 0; i < 3; i++)
        ceduo_doubt_light_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option, lights[i]);
}
