/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of fitted values and observations, the draws, and the page of --calibrate. It compares observations with
 * predictions. It reports fitted values with their ranges, unidentified values, values at a bound, and misfit. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "page_parts.h"
#include "report.h"
#include "study/observe.h"
#include "study/predict.h"

#define CORRELATED  0.7 /* correlation from which a pair is reported */
#define GROUND_PATH "slope.materials["

void ceduo_calibration_name(struct text *text, const char *path)
{
    const char *name = path + sizeof GROUND_PATH - 1, *bracket = strchr(path, '[');
    ceduo_text_append(text, _(ceduo_schema_fitted(path)->shown.label));
    if (strncmp(path, GROUND_PATH, sizeof GROUND_PATH - 1) == 0)
        ceduo_text_format(text, ", %.*s", (int)strcspn(name, "]"), name);
    else if (bracket && bracket[1] != '*')
        ceduo_text_format(text, " [%.*s]", (int)strcspn(bracket + 1, "]"), bracket + 1);
}

void ceduo_calibration_names(struct text *text, const struct ceduo_input *inputs, size_t n, const bool *selected)
{
    bool empty = true;
    for (size_t i = 0; i < n; i++)
        if (!selected || selected[i]) {
            ceduo_text_append(text, empty ? "" : ", ");
            ceduo_calibration_name(text, inputs[i].path);
            empty = false;
        }
}

/* Convert to the display unit. */
static double to_display_unit(const char *path, double value)
{
    return value * ceduo_schema_fitted(path)->shown.per;
}

void ceduo_calibration_number(struct text *text, const char *path, double value)
{
    ceduo_words_number(text, to_display_unit(path, value), 3);
}

double ceduo_observed_shown(const struct scene_file *file, const struct ceduo_predicted *p, double value)
{
    const enum ceduo_observed_kind kind = file->observations[p->observation].kind;
    bool place = ceduo_observed_row(kind)->quantity == CEDUO_QUANTITY_PLACE;
    return place ? value + file->scene.slope.origin_x : value * (1 / ceduo_observed_quantity(kind)->scale);
}

const struct ceduo_observation *ceduo_observed_find(const struct ceduo_calibration_report *r, const struct ceduo_predicted *p)
{
    return &r->files[p->scene].observations[p->observation];
}

size_t ceduo_observed_number(const struct ceduo_observation *o)
{
    return o->kind == CEDUO_OBSERVED_PASSED ? (size_t)o->released_count : o->n;
}

void ceduo_calibration_sources(struct text *text, const struct ceduo_calibration_report *r)
{
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        const struct ceduo_fitted *f = &r->answer->parameters[i];
        const char *between = i > 0 ? "; " : "";
        for (size_t k = 0; k < r->answer->predicted_count; k++) {
            const struct ceduo_observation *o = ceduo_observed_find(r, &r->answer->predicted[k]);
            if (o->use != CEDUO_OBSERVED_USE_FIT)
                continue;
            ceduo_text_append(text, between);
            if (o->kind == CEDUO_OBSERVED_PASSED)
                ceduo_text_format(text, "%llu of ", (unsigned long long)o->count);
            ceduo_text_format(text, "%zu ", ceduo_observed_number(o));
            ceduo_text_append_escaped(text, o->name_given);
            between = ", ";
        }
        ceduo_text_format(text, "; %s 95 %% %s\xe2\x80\x93%s%s", ceduo_schema_fitted(r->inputs[i].path)->key, SIG(f->p2_5, 3),
                          SIG(f->p97_5, 3), f->identified ? "" : "; not determined");
    }
}

/* Append the head of a column: the path of a ground of the library, because its stretches change with the profile; else the
 * places. */
static void append_head(struct text *text, const struct scene_file *file, const struct ceduo_input *input)
{
    LOCAL_TEXT(places);
    if (ceduo_input_is_library_ground(&file->scene, input))
        ceduo_text_append(&places, input->path);
    else
        ceduo_text_join(&places, input->places, input->places_count, " ");
    ceduo_text_append_csv(text, places.bytes);
}

void ceduo_calibration_draws(struct text *text, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    const char *comma = "";
    for (size_t i = 0; i < a->parameters_count; i++)
        if (r->inputs[i].places_count > 0) {
            ceduo_text_append(text, comma);
            append_head(text, &r->files[0], &r->inputs[i]);
            comma = ",";
        }
    for (size_t k = 0; k < a->draws_count; k++) {
        comma = "\n";
        for (size_t i = 0; i < a->parameters_count; i++)
            if (r->inputs[i].places_count > 0) {
                ceduo_text_format(text, "%s%s", comma, ROUNDTRIP(a->draws[k * a->parameters_count + i]));
                comma = ",";
            }
    }
    ceduo_text_append_char(text, '\n');
}

/* ---- the page ---- */

static void append_range(struct text *t, double lo, double hi)
{
    if (isnan(lo) || isnan(hi))
        ceduo_text_append_char(t, '-');
    else
        ceduo_text_format(t, "%s\xe2\x80\x93%s", SIG(lo, 3), SIG(hi, 3));
}

/* Append the name of an observation, with its scene if there are several scenes. */
static void append_observation_name(struct text *name, const struct ceduo_calibration_report *r,
                                    const struct ceduo_predicted *p)
{
    ceduo_text_append_escaped(name, ceduo_observed_find(r, p)->name);
    if (r->scenes_count > 1)
        ceduo_text_append_joined(name, ", ", _("scene %zu"), p->scene + 1);
}

/* ---- sentences ---- */

static void add_value_warnings(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        const struct ceduo_fitted *f = &r->answer->parameters[i];
        LOCAL_TEXT(name);
        ceduo_calibration_name(&name, r->inputs[i].path);
        if (!f->identified)
            ceduo_page_para(page, CEDUO_PAGE_WARNING, _("%s is not identifiable: almost any value within the bounds fits."),
                            name.bytes);
        if (f->at_bound)
            ceduo_page_para(
                page, CEDUO_PAGE_WARNING,
                _("%s is at a bound: the best value may lie beyond it. Widen the bounds, or check what the model lacks."),
                name.bytes);
    }
    for (size_t i = 0; i < r->answer->parameters_count; i++)
        for (size_t k = 0; k < i; k++) {
            LOCAL_TEXT(a);
            LOCAL_TEXT(b);
            double c = r->answer->correlation[i][k];
            if (!(fabs(c) >= CORRELATED))
                continue;
            ceduo_calibration_name(&a, r->inputs[k].path);
            ceduo_calibration_name(&b, r->inputs[i].path);
            ceduo_page_para(page, CEDUO_PAGE_ITEM,
                            _("%s and %s are correlated (%.2f): the observations do not tell them apart."),
                            ceduo_text_string(&a), ceduo_text_string(&b), c);
        }
}

static void add_misfits(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    for (size_t i = 0; i < a->predicted_count; i++) {
        const struct ceduo_predicted *p = &a->predicted[i];
        const struct ceduo_observation *o = ceduo_observed_find(r, p);
        const struct scene_file *file = &r->files[p->scene];
        LOCAL_TEXT(name);
        append_observation_name(&name, r, p);
        if (p->p_value < CEDUO_MISFIT)
            ceduo_page_para(page, CEDUO_PAGE_WARNING,
                            o->use != CEDUO_OBSERVED_USE_FIT
                                ? _("The fit does not reproduce the observations held back to check it: %s.")
                            : p->inside ? _("The model reproduces the observed mean, but not the spread of the values: %s.")
                                        : _("The model cannot reproduce %s."),
                            ceduo_text_string(&name));
        if (o->use == CEDUO_OBSERVED_USE_CHECK && o->values && !isnan(p->one_lo)) {
            LOCAL_TEXT(range); /* 95 % range of single rocks, compared with observations held back */
            append_range(&range, ceduo_observed_shown(file, p, p->one_lo), ceduo_observed_shown(file, p, p->one_hi));
            ceduo_page_para(page, CEDUO_PAGE_ITEM,
                            _("%s: %zu of %zu values lie within the 95 %% range predicted for single rocks, %s."),
                            ceduo_text_string(&name), p->one_inside, o->n, ceduo_text_string(&range));
        }
        if (o->kind == CEDUO_OBSERVED_SCARS && o->released_count > 0 && isnan(o->share_seen))
            ceduo_page_para(page, CEDUO_PAGE_WARNING,
                            _("A survey misses some scars, and %s gives no share_seen, the share that it found: the number of "
                              "impacts is underestimated."),
                            ceduo_text_string(&name));
    }
    if (!a->misfit)
        ceduo_page_note(page, _("The model reproduces all fitted observations."));
}

/* Report which values to fix because the chains have not converged. */
static void add_unconverged(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    bool unidentified[CEDUO_CALIBRATION_MAX];
    LOCAL_TEXT(all);
    LOCAL_TEXT(fixed);
    if (a->parameters_count == 1 || a->draws_count == 0) {
        ceduo_page_warn(page, _("The chains have not converged, so the ranges are rough: fit fewer values, or observe more."));
        return;
    }
    ceduo_calibration_unidentified(a, unidentified);
    ceduo_calibration_names(&all, r->inputs, a->parameters_count, NULL);
    ceduo_calibration_names(&fixed, r->inputs, a->parameters_count, unidentified);
    ceduo_page_para(page, CEDUO_PAGE_WARNING,
                    _("The observations do not determine %s; the ranges are rough. Fix %s, or observe more."), all.bytes,
                    ceduo_text_string(&fixed));
}

void ceduo_calibration_words(struct ceduo_page *page, const struct ceduo_calibration_report *r)
{
    const struct ceduo_calibration *a = r->answer;
    add_misfits(page, r);
    add_value_warnings(page, r);
    if (!a->converged && !r->fix_named)
        add_unconverged(page, r);
    ceduo_page_note(page, _("A fitted ground holds for this profile. A neighbouring profile may need another ground."));
    ceduo_page_para(page, CEDUO_PAGE_NOTE,
                    _("%llu scenes were computed with %llu rocks each; R-hat %.3f, effective size %.0f."),
                    (unsigned long long)a->evaluations, (unsigned long long)r->rocks, a->rhat, a->effective_size);
}

void ceduo_calibration_page(struct text *text, const struct ceduo_calibration_report *r, bool plain)
{
    static const struct ceduo_page_column fitted[] = {
        {N_("fitted"), 26, 2, 0}, {N_("between"), -13, 2, 0}, {N_("best"), -8, 2, 0}, {N_("not refuted, 95 %"), -18, 2, 0}};
    static const struct ceduo_page_column observed[] = {{N_("seen"), 24, 2, 0},       {N_("use"), 5, 2, 0},
                                                        {N_("rocks"), -7, 2, 0},      {N_("mean"), -8, 2, 0},
                                                        {N_("fit, 95 %"), -15, 2, 0}, {N_("p"), -5, 2, 0}};
    LOCAL_PAGE(page, CEDUO_PAGE_WIDTH);
    for (size_t s = 0; s < r->scenes_count; s++) {
        struct text *title = ceduo_page_add(&page, CEDUO_PAGE_TITLE);
        if (r->scenes_count > 1)
            ceduo_text_format(title, "%zu ", s + 1);
        ceduo_text_append_escaped(title, ceduo_in_language(r->files[s].scene.title, r->files[s].scene.title_it));
    }
    ceduo_page_para(&page, CEDUO_PAGE_SECTION, _("Fitted to observations"));
    CEDUO_PAGE_TABLE_OF(&page, fitted);
    for (size_t i = 0; i < r->answer->parameters_count; i++) {
        const struct ceduo_fitted *f = &r->answer->parameters[i];
        const char *path = r->inputs[i].path;
        ceduo_calibration_name(ceduo_page_text(&page), path);
        append_range(ceduo_page_text(&page), to_display_unit(path, f->lo), to_display_unit(path, f->hi));
        ceduo_calibration_number(ceduo_page_text(&page), path, f->best);
        append_range(ceduo_page_text(&page), to_display_unit(path, f->p2_5), to_display_unit(path, f->p97_5));
    }
    ceduo_page_add(&page, CEDUO_PAGE_GAP);
    CEDUO_PAGE_TABLE_OF(&page, observed);
    for (size_t i = 0; i < r->answer->predicted_count; i++) {
        const struct ceduo_predicted *p = &r->answer->predicted[i];
        const struct ceduo_observation *o = ceduo_observed_find(r, p);
        const struct scene_file *file = &r->files[p->scene];
        append_observation_name(ceduo_page_text(&page), r, p);
        ceduo_page_cell_format(&page, "%s", o->use == CEDUO_OBSERVED_USE_FIT ? _("fit") : _("check"));
        ceduo_page_cell_format(&page, "%zu", ceduo_observed_number(o));
        ceduo_page_cell_format(&page, "%s", SIG(ceduo_observed_shown(file, p, p->observed), 3));
        append_range(ceduo_page_text(&page), ceduo_observed_shown(file, p, p->lo), ceduo_observed_shown(file, p, p->hi));
        if (isnan(p->p_value) || p->p_value < 0.001)
            ceduo_page_cell_format(&page, "%s", isnan(p->p_value) ? "-" : "<.001");
        else
            ceduo_page_cell_format(&page, _("%.*f"), p->p_value < 0.1 ? 3 : 2, p->p_value);
    }
    ceduo_page_add(&page, CEDUO_PAGE_GAP);
    ceduo_calibration_words(&page, r);
    ceduo_page_print(text, &page, plain);
}
