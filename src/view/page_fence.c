/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fences: which fence is enough, and design values. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "core/runs/run.h"
#include "page_parts.h"
#include "scene/derived.h"

/* ---- which fence is enough ---- */

/* Append "5 m of class 2 (500 kJ)". `choice` NULL: no class of any height is enough. */
static void append_choice(struct text *text, const struct ceduo_fence_choice *choice)
{
    if (!choice)
        ceduo_text_append(text, _("no fence up to 8 m"));
    else if (choice->class_index == CEDUO_FENCE_CLASSES - 1)
        ceduo_text_format(text, _("%u m of class 8 (up to %s kJ)"), choice->height, SIG(choice->energy * J_TO_KJ, 3));
    else
        ceduo_text_format(text, _("%u m of class %d (%.0f kJ)"), choice->height, choice->class_index, choice->energy * J_TO_KJ);
}

static bool is_equal(const struct ceduo_fence_choice *a, const struct ceduo_fence_choice *b)
{
    return a == b || (a && b && a->height == b->height && a->class_index == b->class_index);
}

/* Append "; over the years 5 m of class 1 (250 kJ), because of years 1–6". */
static void append_years(struct text *text, const struct ceduo_fence_years *y, const struct ceduo_fence_choice *today)
{
    const struct ceduo_fence_choice *all = ceduo_fence_smallest(y->enough);
    LOCAL_TEXT(choice);
    append_choice(&choice, all);
    if (is_equal(all, today)) {
        ceduo_text_append(text, _(", also over the years"));
        return;
    }
    ceduo_text_format(text, _("; over the years %s"), choice.bytes);
    if (y->exceptions == 1)
        ceduo_text_format(text, _(", because of year %u"), y->first_exception);
    else if (y->exceptions > 1 && y->last_exception - y->first_exception + 1 == y->exceptions)
        ceduo_text_format(text, _(", because of years %u\xe2\x80\x93%u"), y->first_exception, y->last_exception);
    else if (y->exceptions > 1)
        ceduo_text_format(text, _(", because of %zu of %zu years"), y->exceptions, y->years);
}

/* Append "Enough without forest: 5 m of class 2 (500 kJ); with forest: today 4 m of class 0 (100 kJ); over the years …". */
static void append_enough(struct text *text, const struct ceduo_subject *s, const struct ceduo_fence_years *years)
{
    const struct ceduo_fence_arrivals *wooded = ceduo_fence_find(s->wooded);
    const struct ceduo_fence_choice *bare = ceduo_fence_smallest(ceduo_fence_find(s->bare)->enough);
    bool several = s->report->result->scene->options_count > 1, undecided = bare && !bare->decided;
    LOCAL_TEXT(choice);
    append_choice(&choice, bare);
    ceduo_text_format(text, _("Enough without forest: %s"), choice.bytes);
    if (wooded) {
        const struct ceduo_fence_choice *today = ceduo_fence_smallest(wooded->enough);
        ceduo_text_cut(&choice, 0);
        ceduo_text_append(&choice, years ? _("today ") : "");
        append_choice(&choice, today);
        if (several)
            ceduo_text_format(text, _("; with '%s': %s"), s->report->result->scene->options[s->option].name, choice.bytes);
        else
            ceduo_text_format(text, _("; with forest: %s"), choice.bytes);
        undecided |= today && !today->decided;
        if (years)
            append_years(text, years, today);
    }
    ceduo_text_append_char(text, '.');
    if (undecided)
        ceduo_text_append_joined(text, " ", "%s", _("More rocks may change a class."));
}

/* Append "The fence of 3 m and 500 kJ is defeated by 12 (8–19) of 1000, without forest by 210; by 31 in year 1." */
static void append_defeated(struct text *text, const struct ceduo_subject *s, const struct ceduo_fence_years *years, bool brief)
{
    const struct ceduo_fence *fence = &s->place->fence;
    const struct ceduo_fence_arrivals *f = ceduo_fence_find(s->wooded);
    const struct ceduo_measure bare = ceduo_measure_fence(CEDUO_FENCE_DEFEATED, s->bare),
                               wooded = ceduo_measure_fence(CEDUO_FENCE_DEFEATED, s->wooded);
    ceduo_text_append_joined(text, " ", _("Of 1000 rocks %s defeat the fence of %s m and %s kJ"), INTERVAL(f ? wooded : bare),
                             LOCALIZED(fence->height), SIG_TRIMMED(fence->energy * J_TO_KJ, 6));
    if (f && years)
        ceduo_text_format(text, _(", %.0f in year %u"), 1000 * years->worst.mean, years->worst_year);
    if (f)
        ceduo_text_format(text, _("; %s without forest"), MEASURE_VALUE(bare));
    ceduo_text_append_char(text, '.');
    double rate = years ? years->per_year : f ? f->per_year : NAN, chance = years ? years->in_life : f ? f->in_life : NAN;
    if (!isnan(rate) && !brief)
        ceduo_text_append_joined(text, " ", _("That is %s a year; in %s years it happens with a chance of %s %%."),
                                 SIG(rate, 2), LOCALIZED(ceduo_fence_life(fence)), SIG(100 * chance, 2));
    LOCAL_TEXT(causes);
    const struct ceduo_uncertainty_report *u = s->report->uncertainty;
    if (f && u && u->answer && s->control == s->report->result->last_control &&
        ceduo_uncertainty_causes(&causes, u, s->option, CEDUO_UNCERTAINTY_DEFEATED))
        ceduo_text_append_joined(text, " ", _("It depends on %s if it is enough."), ceduo_text_string(&causes));
}

void ceduo_page_fence_answer(struct ceduo_page *page, const struct ceduo_report *report, bool brief)
{
    const struct ceduo_result *r = report->result;
    size_t option = ceduo_result_best(r, report->verdict);
    for (size_t k = 0; k < r->scene->controls_count; k++) {
        const struct ceduo_subject s = ceduo_subject_find(report, option, k);
        if (!ceduo_fence_find(s.bare) || ceduo_rocks_reached(s.bare) == 0)
            continue;
        const struct ceduo_fence_years *years = ceduo_report_fence_years(report, option, k);
        struct text *text = ceduo_page_item(page, CEDUO_PAGE_POINT, _("FENCE"));
        if (r->scene->controls_count > 1) {
            ceduo_words_place(text, s.place);
            ceduo_text_append(text, ": ");
        }
        append_enough(text, &s, years);
        append_defeated(text, &s, years, brief);
    }
}

/* Append the class of a choice with its energy and the rocks of 1000 that would defeat it. */
static void add_choice(struct ceduo_page *page, const struct ceduo_fence_choice *choices, size_t i)
{
    const struct ceduo_fence_choice *c = choices ? &choices[i] : NULL;
    const char *sign = c && !c->decided ? "?" : "";
    if (!c || c->class_index == CEDUO_FENCE_CLASSES)
        ceduo_page_cell_format(page, "%s", c ? _("none") : "-");
    else
        ceduo_page_cell_format(page, "%d%s (%s kJ) %.0f", c->class_index, sign, SIG_TRIMMED(c->energy * J_TO_KJ, 4),
                               1000 * c->defeated);
}

void ceduo_page_fence(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control)
{
    static const struct ceduo_page_column columns[] = {{NP_("head", "height"), 8, 4, 0},
                                                       {N_("without forest"), -19, 1, COL_SHRINK},
                                                       {N_("with forest today"), -19, 1, COL_SHRINK},
                                                       {N_("in all years"), -19, 1, COL_SHRINK}};
    const struct ceduo_subject s = ceduo_subject_find(report, option, control);
    const struct ceduo_fence_arrivals *bare = ceduo_fence_find(s.bare), *wooded = ceduo_fence_find(s.wooded);
    const struct ceduo_fence_years *years = ceduo_report_fence_years(report, option, control);
    if (!bare)
        return;
    ceduo_page_para(page, CEDUO_PAGE_CAPTION,
                    _("Smallest class of a fence that at most %s of 1000 defeat, by its height, with their number:"),
                    SIG_TRIMMED(1000 * ceduo_exceed_limit(report->result->scene, s.place), 3));
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < CEDUO_FENCE_HEIGHTS; i++) {
        ceduo_page_cell_format(page, "%u m", bare->enough[i].height);
        add_choice(page, bare->enough, i);
        add_choice(page, wooded ? wooded->enough : NULL, i);
        add_choice(page, years ? years->enough : NULL, i);
    }
    ceduo_page_trim(page);
}

/* ---- design values ---- */

/* Append a class; "no fence" if fewer rocks arrive than the percentile counts. */
static void add_class(struct ceduo_page *page, const struct ceduo_fence_design *d, int class_index)
{
    if (class_index >= 0)
        ceduo_page_cell_format(page, "%d", class_index);
    else
        ceduo_page_cell_format(page, "%s", d->energy == 0 ? _("no fence") : "-");
}

void ceduo_page_design(struct ceduo_page *page, const struct ceduo_report *report, size_t option, size_t control)
{
    static const struct ceduo_page_column columns[] = {{"", 20, 4, COL_GROW},
                                                       {N_("m/s"), -6, 1, COL_SHRINK},
                                                       {N_("kJ"), -6, 1, COL_SHRINK},
                                                       {NP_("head", "m high"), -6, 1, COL_SHRINK},
                                                       {NP_("head", "class"), -6, 1, COL_SHRINK},
                                                       {NULL, -6, 1, COL_SHRINK}};
    static const char *const names[CEDUO_DESIGN_KINDS] = {[CEDUO_DESIGN_BARE] = N_("without forest"),
                                                          [CEDUO_DESIGN_ARRIVING] = N_("with forest: arrivals"),
                                                          [CEDUO_DESIGN_SYSTEM] = N_("with forest: one system"),
                                                          [CEDUO_DESIGN_WORST_ARRIVING] = N_("worst year: arrivals"),
                                                          [CEDUO_DESIGN_WORST_SYSTEM] = N_("worst year: one system")};
    const struct ceduo_subject s = ceduo_subject_find(report, option, control);
    struct ceduo_designs d;
    if (!ceduo_designs_compute(report, option, control, s.wooded, &d) || ceduo_rocks_reached(s.bare) == 0)
        return;
    ceduo_page_para(
        page, CEDUO_PAGE_CAPTION, "%s",
        _("Design values of a fence by UNI 11211-4: 95th percentiles with factors. One system: of the rocks that arrive "
          "without forest; one that the forest stops counts as 0."));
    CEDUO_PAGE_TABLE_OF(page, columns);
    if (!isnan(d.factors.energy))
        ceduo_text_format(&ceduo_page_head(page)->text, _("class at factor %.4g"), d.factors.energy);
    for (enum ceduo_design_kind i = 0; i < CEDUO_DESIGN_KINDS; i++) {
        const struct ceduo_fence_design *v = &d.values[i];
        if (isnan(v->energy))
            continue;
        ceduo_page_cell_format(page, "%s", _(names[i]));
        ceduo_page_cell_format(page, "%s", SIG(v->speed, 3));
        ceduo_page_cell_format(page, "%s", SIG(v->energy * J_TO_KJ, 3));
        ceduo_page_cell_format(page, "%s", SIG(v->height, 3));
        add_class(page, v, v->class_index);
        if (isnan(d.factors.energy))
            ceduo_page_cell_format(page, "%s", "");
        else
            add_class(page, v, v->class_factored);
    }
    ceduo_page_trim(page);
    if (d.values[CEDUO_DESIGN_SYSTEM].energy == 0)
        ceduo_page_para(page, CEDUO_PAGE_SENTENCE, _("As one system no fence is needed by this rule; %s of 1000 still arrive."),
                        MEASURE_VALUE(ceduo_measure_arriving(s.wooded)));
    ceduo_page_para(
        page, CEDUO_PAGE_DETAIL,
        _("Speed: times %.2f for the survey of the ground and %.2f for the model, %s. Energy, of translation: times the "
          "square of both and %.2f for the survey of the blocks. Height: the middle of the rock and 0.5 m, or its top "
          "if that is higher, perpendicular to the ground, without a factor."),
        d.factors.survey, d.factors.model, d.calibrated ? _("fitted to observations") : _("not fitted here"), d.factors.blocks);
    ceduo_page_para(page, CEDUO_PAGE_DETAIL, "%s",
                    _("Not judged: end spans, overlaps, elongation, posts and anchors, several hits, filling, corrosion."));
}
