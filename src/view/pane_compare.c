/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options side by side: today, over the same years ahead, and what they yield. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "page_parts.h"
#include "pane.h"
#include "plot.h"

/* Columns behind the name; without rocks among stems two of them are of the index. */
enum column { NAME, TODAY, MAY_BE, MEAN, WORST, FAILS, YIELD, MARK, CONTACT, FREE_RUN, ENERGY, YEARS, COLUMNS };

static const struct ceduo_page_column columns[COLUMNS] = {
    [NAME] = {"", 12, 0, CEDUO_FILLS},
    [TODAY] = {"", -5, 1, CEDUO_FITS},
    [MAY_BE] = {"", -1, 1, CEDUO_FITS | CEDUO_KEPT | CEDUO_DROPPED(4)},
    [MEAN] = {"", -5, 1, CEDUO_FITS | CEDUO_KEPT | CEDUO_DROPPED(1)},
    [WORST] = {N_("worst"), -5, 1, CEDUO_FITS | CEDUO_DROPPED(6)},
    [FAILS] = {"", -4, 1, CEDUO_FITS | CEDUO_KEPT | CEDUO_DROPPED(2)},
    [YIELD] = {N_("m\xc2\xb3/ha y"), -4, 1, CEDUO_FITS | CEDUO_KEPT | CEDUO_DROPPED(3)},
    [MARK] = {"", 1, 1, CEDUO_FITS | CEDUO_DROPPED(8)},
    [CONTACT] = {"C", 1, 2, CEDUO_DROPPED(7)},
    [FREE_RUN] = {"F", 1, 0, CEDUO_DROPPED(7)},
    [ENERGY] = {"E", 1, 0, CEDUO_DROPPED(7)},
    [YEARS] = {"", 1, 2, CEDUO_FITS | CEDUO_DROPPED(9)}};

#define YEARS_MAX 26 /* columns of the years at a glance */

#define PENDING "\xe2\x80\xa6"

static void add_share(struct ceduo_page *page, struct ceduo_measure share)
{
    ceduo_page_cell_format(page, "%s", isnan(share.value) ? PENDING : WITH_ERROR(share, ""));
}

/* The years at a glance: a column for each, or of several that share one the worst; as high as what gets through. */
static void add_years(struct ceduo_page *page, const struct ceduo_years *years)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    cell->role = CEDUO_ROLE_MEAN;
    int n = years ? (int)years->count : 0, shown = n < YEARS_MAX ? n : YEARS_MAX;
    for (int x = 0; x < shown; x++) {
        double max = 0;
        for (int k = x * n / shown; k < (x + 1) * n / shown; k++)
            if (years->years[k].wooded.rocks > 0)
                max = fmax(max, ceduo_judged_share(&years->years[k].wooded.arrivals[years->last_control]).mean);
        char bytes[4]; /* a block of eighths, U+2581 … U+2588 */
        uint32_t eighths = (uint32_t)fmin(8, ceil(max * 8));
        ceduo_text_add(&cell->text, bytes, ceduo_utf8_encode(eighths > 0 ? 0x2580 + eighths : ' ', bytes));
    }
}

/* True if the uncertainty of the mean over the years is known. Then it stands beside that, otherwise today's beside today. */
static bool knows_rotation(const struct ceduo_pane *pane)
{
    return pane->report->uncertainty && pane->report->uncertainty->answer && pane->report->uncertainty->answer->rotation &&
           pane->report->verdict->wooded;
}

/* With blocks the options are judged by the years from one rock above the limit to the next. */
static bool has_rates(const struct ceduo_pane *pane)
{
    return pane->report->result->wooded && pane->report->result->scene->blocks_count > 0 && pane->report->verdict->accepted;
}

static void add_option(struct ceduo_page *page, const struct ceduo_pane *pane, size_t i)
{
    const struct ceduo_result *r = pane->report->result;
    const struct ceduo_verdict *v = pane->report->verdict;
    const struct ceduo_choice *c = &v->choices[i];
    const struct ceduo_subject s = ceduo_subject_find(pane->report, i, r->last_control);
    bool years = c->last_summary->years > 0, rates = has_rates(pane), rotation = knows_rotation(pane);
    ceduo_page_cell_role(page, i == pane->option ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, r->scene->options[i].name);
    if (rates)
        ceduo_page_cell_format(page, "%s", s.wooded ? EVERY(ceduo_hazard_feared(&s.wooded->hazard)) : "-");
    else if (v->wooded)
        add_share(page, ceduo_share(c->today)); /* its error is right if rocks have weights, too */
    else
        ceduo_page_cell_format(page, "%s", BESIDE(s.index->worst_adc, 3, r->scene->simulation.threshold));
    ceduo_page_cell_format(page, "%s", isnan(s.today.may_lo) || rotation || rates ? "" : MAY_BE(s.today));
    if (rates)
        ceduo_page_cell_format(page, "%s", years ? YEARS(s.outcome.rate) : PENDING);
    else if (v->wooded && rotation && !isnan(s.mean.value) && !isnan(s.mean.may_lo)) /* "296±7 (219–327)" */
        ceduo_page_cell_format(page, "%s (%s)", WITH_ERROR(s.mean, ""), MAY_BE(s.mean));
    else if (v->wooded)
        add_share(page, s.mean);
    else
        ceduo_page_number(page, s.index->per_100m * J_TO_KJ, 3);
    if (!years)
        ceduo_page_cell_format(page, PENDING);
    else if (rates)
        ceduo_page_cell_format(page, "%s (%u)", WRITTEN(1 / (c->worst.mean * s.bare->hazard.per_year), 2),
                               c->last_summary->worst_year);
    else if (v->wooded)
        ceduo_page_worst(page, c);
    else
        ceduo_page_number(page, c->worst.mean, 3);
    if (!years || rates)
        ceduo_page_cell_format(page, "%s", years ? DECISION(s.outcome.answer) : PENDING);
    else
        ceduo_page_fails(page, c, v->wooded ? c->last_summary->unprotected_energy : c->last_summary->unprotected_contact,
                         v->wooded ? c->energy_known : !c->last_summary->nothing);
    ceduo_page_number(page, c->yield.cut_per_year, 2);
    /* "best" for an option that is clearly better than all others over the years, "worst" for one that is worse than all */
    bool known = v->rotation.known && !v->rotation.uneven && v->rotation.rivals + 1 < v->n, worst = known;
    bool best = known && i == v->rotation.best && v->rotation.rivals == 0;
    for (size_t k = 0; k < v->n; k++)
        worst &= k == i || v->choices[k].mean.mean + v->choices[k].mean.half < c->mean.mean - c->mean.half;
    ceduo_page_cell_role(page, best ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD, best ? _("best") : worst ? _("worst") : "");
    ceduo_page_light(page, s.index->contact);
    ceduo_page_light(page, s.index->free_run);
    ceduo_page_light(page, s.index->energy);
    add_years(page, v->wooded ? pane->report->ahead[i] : NULL);
}

static void add_heads(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_result *r = pane->report->result;
    struct ceduo_page_cell *heads = page->last->cells;
    ceduo_text_append(&heads[TODAY].text, r->wooded ? _("today") : _("ADC m"));
    ceduo_text_append(&heads[MEAN].text, r->wooded ? _("mean") : _("kJ/100 m"));
    ceduo_text_append(&heads[FAILS].text, has_rates(pane) ? _("accepted") : _("fail"));
    if (has_rates(pane))
        return;
    if (knows_rotation(pane))
        ceduo_text_format(&heads[MEAN].text, ", %s", _("may be"));
    else if (pane->report->uncertainty && pane->report->uncertainty->answer)
        ceduo_text_append(&heads[MAY_BE].text, _("may be"));
}

void ceduo_pane_options(struct ceduo_page *page, const struct ceduo_pane *pane, size_t first, size_t rows)
{
    const struct ceduo_result *r = pane->report->result;
    const struct ceduo_control *control = &r->scene->controls[r->last_control];
    const char *name = NAMED(ceduo_measure_exceeding(control, NULL), CEDUO_SHORT_HEAD);
    if (has_rates(pane))
        ceduo_page_para(page, CEDUO_PAGE_TITLE, _("Years between two rocks %s at %.6g m (accepted: %s)"), name,
                        control->x_given, SHORTEST(ceduo_accepted_return(control)));
    else if (r->wooded)
        ceduo_page_para(page, CEDUO_PAGE_TITLE, _("Of 1000 rocks: %s at %.6g m"), name, control->x_given);
    else
        ceduo_page_para(page, CEDUO_PAGE_TITLE, _("At %s m"), ROUNDED(control->x_given, 6));
    ceduo_page_table(page, columns, COLUMNS);
    add_heads(page, pane);
    for (size_t i = first; i < pane->report->verdict->n && i < first + rows; i++)
        add_option(page, pane, i);
}

/* ---- what is to be said of them ---- */

void ceduo_pane_message(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_result *r = pane->report->result;
    const struct ceduo_verdict *v = pane->report->verdict;
    if (r->scene->blocks_count > 0 && r->scene->controls_count > 0)
        ceduo_words_hazard(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option, r->last_control);
    if (v->n < 2) {
        ceduo_page_note(page, _("One way to treat this forest so far. a adds another, y a copy of this one."));
    } else {
        LOCAL_TEXT(best);
        ceduo_words_best(&best, r->scene, v);
        for (size_t i = 0; knows_rotation(pane) && i < pane->report->uncertainty->answer->orders_count; i++)
            ceduo_uncertainty_order_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), pane->report->uncertainty, i);
        for (char *line = best.bytes ? strtok(best.bytes, "\n") : NULL; line; line = strtok(NULL, "\n"))
            ceduo_page_note(page, line);
        if ((!v->rotation.known || v->rotation.uneven) && v->wooded)
            ceduo_page_note(page, _("The years ahead are being computed."));
        if (!knows_rotation(pane)) /* of which the energy law is a part */
            ceduo_words_rank_reversals(r, v, ceduo_page_note, page);
    }
    ceduo_words_windows(r->scene, ceduo_page_note, page);
    ceduo_words_thin_stems(r, ceduo_page_note, page);
    if (v->wooded && !v->accepted)
        ceduo_page_note(page, _(ceduo_words_unjudged));
    if (!r->wooded)
        ceduo_page_note(page, _(ceduo_words_by_index));
    if (pane->report->busy)
        ceduo_page_note(page, _("Computing: the figures become finer."));
    if (v->n > 1 && r->wooded && v->accepted && !has_rates(pane))
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("fail: years in which more than %.0f of 1000 bring too much."),
                        CEDUO_EXCEED_MAX * 1000);
    if (v->rotation.known && !v->rotation.uneven)
        ceduo_words_year_numbering(ceduo_page_add(page, CEDUO_PAGE_NOTE), v->choices[0].rocks);
}
