/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The column of figures that stands still beside every view, in the words of the paper; the energy that is left, in which the
 * paper's method ends; and what an option and its uncertainty mean in words. */
#include <math.h>

#include "base/language.h"
#include "page_parts.h"
#include "pane.h"
#include "plot.h"
#include "report.h"

#define WIDE       34 /* columns with room for intervals */
#define HEIGHT_MIN 18 /* lines with room for what is seen elsewhere, too, … */
#define HEIGHT_ALL 24 /* … and for everything */
#define HEIGHT_LOW 15 /* with fewer the tests go before what becomes of the others and what energies arrive */

/* ---- what falls on what ---- */

static void add_scene(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_scene *s = &pane->report->file->scene;
    struct ceduo_rock rock = ceduo_rock_mean(&s->rock);
    double min = INFINITY, max = 0, per_year = 0;
    for (size_t i = 0; i < s->blocks_count; i++) {
        min = fmin(min, s->blocks[i].volumes[0]);
        max = fmax(max, s->blocks[i].volumes[1]);
        per_year += s->blocks[i].per_year;
    }
    if (s->options_count > 1)
        ceduo_page_para_role(page, CEDUO_ROLE_TITLE, "%s", s->options[pane->option].name);
    if (s->blocks_count > 0) /* no single size stands for them */
        ceduo_page_para_role(page, CEDUO_ROLE_TEXT, _("Blocks %.3g\xe2\x80\x93%.3g m\xc2\xb3, %.3g/year"), min, max, per_year);
    else if (!isnan(rock.mass) && pane->height >= HEIGHT_MIN)
        ceduo_page_para_role(page, CEDUO_ROLE_TEXT, _("Rock %.3g m, %.4g kg%s"), rock.mean_diameter, rock.mass,
                             ceduo_notes_print(pane->report->file->notes, "assumed", "rock") ? "*" : "");
}

/* ---- what arrives ---- */

/* Of the rocks of the scene with its wood, or in a year of it; NULL: not known yet, or never (index). */
static const struct ceduo_arrivals *wood_of(const struct ceduo_pane *pane)
{
    const struct ceduo_result *r = pane->report->result;
    if (!pane->year)
        return ceduo_result_wooded(r, pane->option, r->last_control);
    return pane->year->wooded.rocks > 0 ? &pane->year->wooded.arrivals[r->last_control] : NULL;
}

/* A row: a share with the error of the rocks, an energy or a height with three digits. */
static void add_row(struct ceduo_page *page, struct ceduo_measure wood, struct ceduo_measure bare)
{
    ceduo_page_cell_format(page, "%s", NAMED(bare, CEDUO_ROW));
    if (wood.digits > 0)
        ceduo_page_number(page, wood.value, 3);
    else
        ceduo_page_cell_format(page, "%s", page->width >= WIDE ? INTERVAL(wood) : WITH_ERROR(wood, ""));
    if (bare.digits > 0)
        ceduo_page_number(page, bare.value, 3);
    else
        ceduo_page_cell_format(page, "%s", VALUE_OF(bare));
}

static void add_arrivals(struct ceduo_page *page, const struct ceduo_pane *pane, const struct ceduo_control *c, bool nothing)
{
#define OF_1000 N_("of 1000"), 13, 0, 0
#define BARE    N_("bare"), -5, 1, 0
    static const struct ceduo_page_column narrow[] = {{OF_1000}, {N_("wood"), -8, 0, 0}, {BARE}},
                                          wide[] = {{OF_1000}, {N_("wood"), -16, 0, 0}, {BARE}};
    static const enum ceduo_end ends[] = {CEDUO_STOPPED_BY_STEMS, CEDUO_AT_REST, CEDUO_LEFT_SLOPE, CEDUO_UNFINISHED};
    const struct ceduo_arrivals *bare = &pane->report->result->bare.arrivals[pane->report->result->last_control],
                                *wood = wood_of(pane);
    bool blocks = !isnan(bare->hazard.per_year);
    ceduo_page_table(page, page->width >= WIDE ? wide : narrow, 3);
    add_row(page, ceduo_measure_arriving(wood), ceduo_measure_arriving(bare));
    if (!isnan(c->accepted) && !nothing)
        add_row(page, ceduo_measure_exceeding(c, wood), ceduo_measure_exceeding(c, bare));
    struct ceduo_measure judged = ceduo_measure_exceeding(c, wood);
    if (wood && !pane->year && !nothing) /* by the index it would be of the rocks without forest */
        ceduo_measure_uncertainty(&judged, pane->report->uncertainty, pane->option, pane->report->result->last_control);
    if (!isnan(judged.may_lo)) {
        ceduo_page_cell_format(page, "  %s", _("may be"));
        ceduo_page_cell_format(page, "%s", MAY_BE(judged));
        ceduo_page_cell_format(page, "%s", "");
    }
    if (blocks && !nothing) { /* years from one dangerous rock to the next: what matters where blocks of all sizes come down */
        ceduo_page_cell_format(page, "%s", _("years apart"));
        ceduo_page_cell_format(page, "%s", wood ? EVERY(ceduo_hazard_feared(&wood->hazard)) : "-");
        ceduo_page_cell_format(page, "%s", EVERY(ceduo_hazard_feared(&bare->hazard)));
    }
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        bool any = (wood && wood->ended[ends[i]] > 0) || bare->ended[ends[i]] > 0;
        if (pane->height >= HEIGHT_LOW && (i == 0 || (i == 1 ? pane->height >= HEIGHT_MIN : any)))
            add_row(page, ceduo_measure_stopped(wood, ends[i]), ceduo_measure_stopped(bare, ends[i]));
    }
    if (nothing || pane->height < HEIGHT_LOW)
        return;
    if (blocks) { /* of them the large arrive: a mean of those would read as if the wood did harm */
        add_row(page, ceduo_energy_released(wood), ceduo_energy_released(bare));
        return;
    }
    add_row(page, ceduo_mean_energy(wood), ceduo_mean_energy(bare));
    add_row(page, ceduo_energy_p95(wood), ceduo_energy_p95(bare));
    if (pane->height >= HEIGHT_ALL)
        add_row(page, ceduo_height_p95(wood), ceduo_height_p95(bare));
}

/* ---- the three tests ---- */

static const char *than(enum ceduo_light light, const char *good, const char *bad)
{
    return light == CEDUO_PASS ? good : bad;
}

/* The option over the years ahead; NULL also in a year. */
static const struct ceduo_choice *choice_ahead(const struct ceduo_pane *pane)
{
    return pane->year ? NULL : ceduo_report_ahead(pane->report, pane->option);
}

/* Beside the sign of today that of the worst year ahead: fail if the test fails in any. */
static void add_light(struct ceduo_page *page, const struct ceduo_pane *pane, enum ceduo_light today, size_t fails, bool known)
{
    const struct ceduo_choice *c = choice_ahead(pane);
    ceduo_page_light(page, today);
    if (c)
        ceduo_page_light(page, !known || c->last_summary->nothing ? CEDUO_UNKNOWN : fails > 0 ? CEDUO_FAIL : CEDUO_PASS);
    else
        ceduo_page_cell_format(page, "%s", "");
}

static void add_tests(struct ceduo_page *page, const struct ceduo_pane *pane, const struct ceduo_index *index)
{
    static const struct ceduo_page_column columns[] = {{"", 23, 0, 0}, {"", -1, 1, 0}, {"", -1, 0, 0}};
    const struct ceduo_arrivals *wood = wood_of(pane);
    const struct ceduo_choice none = {0}, *c = pane->report->verdict && pane->option < pane->report->verdict->n
                                                   ? &pane->report->verdict->choices[pane->option]
                                                   : &none;
    double threshold = pane->report->result->scene->simulation.threshold;
    bool gap = index->length > 0 && index->longest_gap > threshold; /* the reason in the page, too */
    CEDUO_PAGE_TABLE_OF(page, columns);
    if (gap)
        ceduo_page_cell_format(page, _("gap %s m > %g"), ROUNDED(index->longest_gap, 6), threshold);
    else if (isinf(index->worst_adc))
        ceduo_page_cell_format(page, "%s", _("ADC: no stems"));
    else
        ceduo_page_cell_format(page, _("ADC %s m %s %g"), BESIDE(index->worst_adc, 3, threshold),
                               than(index->contact, "<", "\xe2\x89\xa5"), threshold);
    add_light(page, pane, index->contact, c->last_summary->unprotected_contact, true);
    ceduo_page_cell_format(page, _("%g m free %s %% %s %g"), threshold, PERCENT(index->worst_free_run, CEDUO_FREE_RUN_MAX),
                           index->worst_free_run <= CEDUO_FREE_RUN_MAX ? "\xe2\x89\xa4" : ">", CEDUO_FREE_RUN_MAX * 100);
    add_light(page, pane, index->free_run, c->last_summary->unprotected_free_run, true);
    if (index->energy != CEDUO_UNKNOWN && wood)
        ceduo_page_cell_format(page, _("energy %s %% %s %s"), PERCENT(wood->exceed.mean, wood->limit),
                               than(index->energy, "\xe2\x89\xa4", ">"), ROUNDED(wood->limit * 100, 3));
    else
        ceduo_page_cell_format(page, "%s",
                               wood || !pane->report->result->wooded ? _("energy: not judged") : _("energy \xe2\x80\xa6"));
    add_light(page, pane, index->energy, c->last_summary->unprotected_energy, c->energy_known);
    if (pane->height >= HEIGHT_ALL && choice_ahead(pane))
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", _("signs: today, worst year"));
}

static void add_index(struct ceduo_page *page, const struct ceduo_pane *pane, const struct ceduo_index *index)
{
    const char *taken = WRITTEN(index->dissipated * J_TO_KJ, 3), *left = WRITTEN(index->residual * J_TO_KJ, 3);
    bool known = !isnan(index->residual); /* rocks arrive without forest */
    if (known && index->exhausted)
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, _("taken %s kJ: all of it"), taken);
    else if (known)
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, _("taken %s left %s kJ"), taken, left);
    if (!isnan(index->measured) && pane->height >= HEIGHT_ALL)
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, _("measured %s kJ (one rock)"), WRITTEN(index->measured * J_TO_KJ, 3));
}

/* ---- all ---- */

size_t ceduo_pane_column(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_result *r = pane->report->result;
    add_scene(page, pane);
    if (!r) {
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", _("the first rocks are falling \xe2\x80\xa6"));
        return 0;
    }
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    bool nothing = ceduo_too_few_arrivals(&r->bare.arrivals[r->last_control]); /* why stands below, and takes the room */
    if (pane->year)
        ceduo_page_para_role(page, CEDUO_ROLE_TITLE, pane->year->cut ? _("Year %u, just cut") : _("Year %u"), pane->year->year);
    ceduo_page_para_role(page, CEDUO_ROLE_TITLE, _("At %g m%s%s"), c->x_given, c->name ? ", " : "", c->name ? c->name : "");
    if (pane->height >= HEIGHT_ALL) {
        LOCAL_TEXT(angles);
        ceduo_words_topography(&angles, &r->bare.arrivals[r->last_control].topography, true);
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", ceduo_text_string(&angles));
    }
    add_arrivals(page, pane, c, nothing);
    const struct ceduo_index *index =
        pane->year ? &pane->year->controls[r->last_control] : ceduo_result_last_index(r, pane->option);
    if (!nothing) {
        add_tests(page, pane, index);
        add_index(page, pane, index);
    }
    const struct ceduo_arrivals *wood = wood_of(pane);
    ceduo_page_para_role(page, CEDUO_ROLE_DIM, pane->report->busy ? _("computing, %llu rocks") : _("finished, %llu rocks"),
                         (unsigned long long)(wood ? wood : &r->bare.arrivals[r->last_control])->released);
    bool uncertainty =
        pane->height >= HEIGHT_ALL && !nothing && pane->report->uncertainty && pane->report->uncertainty->answer && !pane->year;
    for (size_t i = 0; i < 3 && uncertainty; i++) { /* what turns a test within what may be true */
        LOCAL_TEXT(causes);
        if (ceduo_uncertainty_causes(&causes, pane->report->uncertainty, pane->option, ceduo_uncertainty_lights[i]))
            ceduo_page_para_role(page, CEDUO_ROLE_WARN, _("%s depends on %s"), _(ceduo_light_names[i]),
                                 ceduo_text_string(&causes));
    }
    const struct ceduo_page_block *last = page->last;
    size_t warnings = 0;
    ceduo_words_still_moving(r, ceduo_page_warn, page);
    ceduo_page_stand_warnings(page, r, pane->option);
    ceduo_words_run_warnings(r, &pane->report->remarks, ceduo_page_warn, page);
    ceduo_page_stand_rules(page, r, pane->option, true);
    while ((last = last->next))
        warnings++;
    return warnings;
}

/* ---- tables and words of views 4 and 7 ---- */

void ceduo_pane_belts(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    static const struct ceduo_page_column columns[] = {
        {N_("ADC"), 10, 0, CEDUO_FILLS}, {"", 1, 2, CEDUO_FITS | CEDUO_DROPPED(1)}, {"", -6, 1, CEDUO_FITS}, {"", 1, 1, 0}};
    const struct ceduo_option *option = &pane->report->result->scene->options[pane->option];
    double threshold = pane->report->result->scene->simulation.threshold;
    if (option->belts_count == 0)
        return;
    CEDUO_PAGE_TABLE_OF(page, columns);
    ceduo_text_format(&page->last->cells[2].text, _("< %s m"), SHORTEST(threshold));
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        const struct ceduo_stand_result *r = &pane->report->result->options[pane->option].stands[i];
        LOCAL_TEXT(name);
        ceduo_plot_belt_name(&name, belt);
        ceduo_page_cell_role(page, CEDUO_ROLE_BELT, ceduo_text_string(&name));
        ceduo_page_cell_format(page, "%s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
        ceduo_page_cell_format(page, isfinite(r->adc_m) ? _("%s m") : "%s", BESIDE(r->adc_m, 3, threshold));
        ceduo_page_light(page, r->passes_threshold ? CEDUO_PASS : CEDUO_FAIL);
    }
    ceduo_page_add(page, CEDUO_PAGE_GAP);
}

static void add_simulated(struct ceduo_page *page, const char *name, const struct ceduo_control *c,
                          const struct ceduo_arrivals *a)
{
    ceduo_page_cell_format(page, "%s", name);
    ceduo_page_mean(page, a);
    ceduo_page_number(page, a->energy.p95 * J_TO_KJ, 3);
    ceduo_page_cell_format(page, "%s", INTERVAL(ceduo_measure_exceeding(c, a)));
}

/* A mean alone. */
static void add_mean(struct ceduo_page *page, const char *name, const char *mean)
{
    ceduo_page_cell_format(page, "%s", name);
    ceduo_page_cell_format(page, "%s", mean);
    ceduo_page_cell_format(page, "-");
    ceduo_page_cell_format(page, "-");
}

void ceduo_pane_residual(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    static const struct ceduo_page_column columns[] = {
        {"", 14, 0, CEDUO_FILLS}, {"", -6, 1, CEDUO_FITS}, {N_("95 %"), -5, 1, CEDUO_FITS}, {"", -7, 1, CEDUO_FITS}};
    const struct ceduo_result *r = pane->report->result;
    const struct ceduo_control *c = &r->scene->controls[r->last_control];
    const struct ceduo_arrivals *bare = &r->bare.arrivals[r->last_control],
                                *wood = ceduo_result_wooded(r, pane->option, r->last_control);
    const struct ceduo_index *index = ceduo_result_last_index(r, pane->option);
    CEDUO_PAGE_TABLE_OF(page, columns);
    struct ceduo_page_cell *heads = page->last->cells;
    ceduo_text_format(&heads[0].text, _("energy left at %g m"), c->x_given);
    ceduo_text_format(&heads[0].shorter, _("left at %g m"), c->x_given);
    ceduo_text_append(&heads[1].text, NAMED(ceduo_mean_energy(bare), CEDUO_SHORT_HEAD));
    ceduo_text_append(&heads[3].text, NAMED(ceduo_measure_exceeding(c, bare), CEDUO_SHORT_HEAD));
    add_simulated(page, _("without forest"), c, bare);
    if (r->scene->options[pane->option].belts_count > 0)
        add_mean(page, _("index (Eq. 5)"), index->exhausted ? _("used up") : WRITTEN(index->residual * J_TO_KJ, 3));
    if (wood && r->scene->options[pane->option].belts_count > 0)
        add_simulated(page, _("simulated"), c, wood);
    if (!isnan(index->measured))
        add_mean(page, _("measured"), WRITTEN(index->measured * J_TO_KJ, 3));
}

void ceduo_pane_words(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_report *report = pane->report;
    if (report->result->scene->options_count > 1)
        ceduo_page_para(page, CEDUO_PAGE_TITLE, "%s", report->result->scene->options[pane->option].name);
    ceduo_page_option(page, report, pane->option, true);
    ceduo_words_still_moving(report->result, ceduo_page_warn, page);
    ceduo_words_run_warnings(report->result, &report->remarks, ceduo_page_warn, page);
}

void ceduo_pane_uncertainty(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_uncertainty_report *r = pane->report->uncertainty;
    if (!r || !r->answer || isnan(ceduo_uncertainty_main(r, pane->option)->fit.p5))
        return;
    ceduo_uncertainty_both(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option);
    ceduo_uncertainty_advice(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, ceduo_uncertainty_main(r, pane->option), 1);
    for (size_t i = 0; i < r->answer->orders_count; i++)
        if (r->answer->orders[i].better == pane->option || r->answer->orders[i].than == pane->option)
            ceduo_uncertainty_order_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, i);
    const struct ceduo_uncertainty_figure *failing =
        ceduo_uncertainty_find_figure(r->answer, pane->option, CEDUO_UNCERTAINTY_FAILING, false);
    if (r->over && !isnan(failing->fit.p5))
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("Years that fail: %.0f, may be %.0f\xe2\x80\x93%.0f."), failing->value,
                        floor(failing->fit.p5), ceil(failing->fit.p95)); /* outwards */
    for (size_t i = 0; i < 3 && !r->over; i++)
        ceduo_uncertainty_light_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option, i);
}
