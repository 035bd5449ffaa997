/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Column of figures next to every view, and texts about an option and its uncertainty. The column follows the terms of the
 * paper. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "pane.h"
#include "plot.h"
#include "report.h"

#define HEIGHT_MIN    18 /* min lines for figures that other views show, too … */
#define HEIGHT_ALL    24 /* … and for all figures */
#define HEIGHT_ORDERS 30 /* min lines for the order of all options */

/* True if the uncertainty of the figures is known. */
static bool has_answer(const struct ceduo_pane *pane)
{
    return pane->report->uncertainty && pane->report->uncertainty->answer;
}

/* ---- rock ---- */

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
    if (s->blocks_count > 0) /* no single size is representative */
        ceduo_page_para_role(page, CEDUO_ROLE_TEXT, _("Blocks %.3g\xe2\x80\x93%.3g m\xc2\xb3, %.3g/year"), min, max, per_year);
    else if (!isnan(rock.mass) && pane->height >= HEIGHT_MIN)
        ceduo_page_para_role(page, CEDUO_ROLE_TEXT, _("Rock %.3g m, %.4g kg%s"), rock.mean_diameter, rock.mass,
                             ceduo_notes_print(pane->report->file->notes, "assumed", "rock") ? "*" : "");
}

/* ---- column ---- */

size_t ceduo_pane_column(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_result *r = pane->report->result;
    add_scene(page, pane);
    if (!r) {
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", _("the first rocks are falling \xe2\x80\xa6"));
        return 0;
    }
    const struct ceduo_subject s = pane->year ? ceduo_subject_find_year(pane->report, pane->option, pane->year)
                                              : ceduo_subject_find(pane->report, pane->option, r->last_control);
    const struct ceduo_control *c = s.place;
    bool nothing = ceduo_page_is_unassessable(r); /* the reason is printed below */
    if (pane->year)
        ceduo_page_para_role(page, CEDUO_ROLE_TITLE, pane->year->cut ? _("Year %u, just cut") : _("Year %u"), pane->year->year);
    ceduo_page_para_role(page, CEDUO_ROLE_TITLE, _("At %g m%s%s"), c->x_given, c->name ? ", " : "", c->name ? c->name : "");
    if (pane->height >= HEIGHT_ALL) {
        LOCAL_TEXT(angles);
        ceduo_words_topography(&angles, ceduo_topography_find(s.bare), true);
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", ceduo_text_string(&angles));
    }
    ceduo_page_arrivals(page, &s, pane->height, true);
    if (!nothing)
        ceduo_page_tests(page, &s, pane->height);
    if (!nothing && s.choice && ceduo_report_years_ahead(pane->report, pane->option) && pane->height >= HEIGHT_ALL)
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", _("signs: today, worst year"));
    ceduo_page_para_role(page, CEDUO_ROLE_DIM, pane->report->busy ? _("%llu rocks so far") : _("finished, %llu rocks"),
                         (unsigned long long)ceduo_rocks_released(s.wooded ? s.wooded : s.bare));
    bool uncertainty = pane->height >= HEIGHT_ALL && !nothing && has_answer(pane) && !pane->year;
    for (size_t i = 0; i < 3 && uncertainty; i++) { /* causes of a change of light in plausible cases */
        LOCAL_TEXT(causes);
        if (ceduo_uncertainty_causes(&causes, pane->report->uncertainty, pane->option, ceduo_uncertainty_lights[i]))
            ceduo_page_para_role(page, CEDUO_ROLE_WARN, _("%s depends on %s"), _(ceduo_light_names[i]),
                                 ceduo_text_string(&causes));
    }
    const struct ceduo_page_block *last = page->last;
    size_t warnings = 0;
    ceduo_words_warn_no_answer(r, ceduo_page_warn, page);
    ceduo_uncertainty_warn_outside(pane->report->uncertainty, ceduo_page_warn, page);
    ceduo_page_stand_warnings(page, r, pane->option);
    ceduo_words_run_warnings(r, &pane->report->remarks, ceduo_page_warn, page);
    ceduo_page_stand_rules(page, r, pane->option, true);
    while ((last = last->next))
        warnings++;
    return warnings;
}

/* ---- texts of views 4 and 7 ---- */

void ceduo_pane_words(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_report *report = pane->report;
    if (report->result->scene->options_count > 1)
        ceduo_page_para(page, CEDUO_PAGE_TITLE, "%s", report->result->scene->options[pane->option].name);
    ceduo_page_option(page, report, pane->option, true);
    ceduo_words_warn_no_answer(report->result, ceduo_page_warn, page);
    ceduo_words_run_warnings(report->result, &report->remarks, ceduo_page_warn, page);
}

void ceduo_pane_uncertainty(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_uncertainty_report *r = pane->report->uncertainty;
    if (!r || !r->answer || isnan(ceduo_uncertainty_main(r, pane->option)->fit.p5))
        return;
    ceduo_uncertainty_warn_outside(r, ceduo_page_warn, page);
    ceduo_uncertainty_advice(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, ceduo_uncertainty_main(r, pane->option), 1);
    for (size_t i = 0; i < r->answer->orders_count; i++)
        if (pane->height >= HEIGHT_ORDERS || r->answer->orders[i].better == pane->option ||
            r->answer->orders[i].than == pane->option)
            ceduo_uncertainty_order_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, i);
    for (size_t i = 0; i < 3 && !r->rotation_mean; i++)
        ceduo_uncertainty_light_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), r, pane->option, i);
}

/* ---- options ---- */

/* True if the 90 % range of the mean over the years is known; otherwise that of today is shown. */
static bool has_rotation(const struct ceduo_pane *pane)
{
    return has_answer(pane) && pane->report->uncertainty->answer->rotation && pane->report->verdict->wooded;
}

void ceduo_pane_message(struct ceduo_page *page, const struct ceduo_pane *pane)
{
    const struct ceduo_result *r = pane->report->result;
    const struct ceduo_verdict *v = pane->report->verdict;
    if (v->n < 2) {
        ceduo_page_note(page, _("Only one option. Press a to add a preset, y to copy."));
    } else {
        LOCAL_TEXT(best);
        ceduo_words_best(&best, r->scene, v);
        for (size_t i = 0; has_rotation(pane) && i < pane->report->uncertainty->answer->orders_count; i++)
            ceduo_uncertainty_order_words(ceduo_page_add(page, CEDUO_PAGE_NOTE), pane->report->uncertainty, i);
        for (char *line = best.bytes ? strtok(best.bytes, "\n") : NULL; line; line = strtok(NULL, "\n"))
            ceduo_page_note(page, line);
        if (!has_rotation(pane)) /* otherwise the energy law is one of the uncertain inputs */
            ceduo_words_rank_reversals(r, v, ceduo_page_note, page);
    }
    ceduo_uncertainty_warn_outside(pane->report->uncertainty, ceduo_page_note, page);
    ceduo_words_windows(r->scene, ceduo_page_note, page);
    ceduo_words_thin_stems(r, ceduo_page_note, page);
    if (v->wooded && !v->accepted)
        ceduo_page_note(page, _(ceduo_words_unjudged));
    if (!r->wooded)
        ceduo_page_note(page, _(ceduo_words_by_index));
    if (v->n > 1 && r->wooded && v->accepted && r->scene->blocks_count == 0)
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("fail: years in which more than %.0f of 1000 rocks exceed the limit."),
                        CEDUO_EXCEED_MAX * 1000);
    if (v->rotation.known && !v->rotation.uneven)
        ceduo_words_year_numbering(ceduo_page_add(page, CEDUO_PAGE_NOTE), v->choices[0].rocks);
}
