/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 8: observed and simulated values, and a fit that runs in the background. */
#include <math.h>
#include <string.h>

#include "app.h"
#include "base/language.h"
#include "popup.h"
#include "study/observe.h"
#include "view/page_parts.h"
#include "view/report.h"
#include "view/value_text.h"

#define PICTURE_MIN 8
#define RANGE       "\xe2\x80\x93"

/* ---- rows: observed, simulated with its interval ---- */

static void append_number(struct text *text, const struct scene_file *file, const struct ceduo_predicted *p, double value)
{
    if (file->observations[p->observation].kind == CEDUO_OBSERVED_PASSED)
        ceduo_text_format(text, "%.0f", value);
    else
        ceduo_words_number(text, ceduo_observed_shown(file, p, value), 3);
}

static void add_rows(struct ceduo_page *page, const struct scene_file *file, const struct ceduo_predicted *predicted)
{
    static const struct ceduo_page_column columns[] = {{N_("mean or count"), 13, 0, COL_GROW | COL_WRAP},
                                                       {N_("observed"), -8, 1, COL_SHRINK},
                                                       {N_("sim., 95 %"), -11, 1, COL_SHRINK},
                                                       {"", 10, 1, COL_SHRINK}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t i = 0; i < file->observations_count; i++) {
        const struct ceduo_predicted *p = &predicted[i];
        const struct ceduo_observation *o = &file->observations[p->observation];
        const char *unit = ceduo_observed_quantity(o->kind)->unit;
        struct text *name = ceduo_page_text(page);
        ceduo_text_append_escaped(name, o->name);
        if (o->use == CEDUO_OBSERVED_USE_CHECK)
            ceduo_text_format(name, " %s", _("(check)"));
        struct text *observed = ceduo_page_text(page);
        append_number(observed, file, p, p->observed);
        ceduo_text_append_joined(observed, " ", "%s", unit);
        struct text *band = ceduo_page_text(page);
        if (isnan(p->lo)) {
            ceduo_text_append_char(band, '-');
        } else {
            append_number(band, file, p, p->lo);
            ceduo_text_append(band, RANGE);
            append_number(band, file, p, p->hi);
        }
        ceduo_page_cell_format(page, "%s",
                               !p->inside ? _("OUTSIDE")
                               : p->p_value < CEDUO_MISFIT
                                   ? _("mean only") /* the distribution is rejected below, not the mean */
                                   : _("inside"));
    }
    ceduo_page_add(page, CEDUO_PAGE_GAP);
}

/* ---- words ---- */

/* Describe how the current scene fits. The p-value of a list tests its distribution, too. */
static void append_comparison(struct app *app, struct ceduo_page *page)
{
    const struct scene_file *file = &app->document.file;
    const struct comparison *s = ceduo_live_comparison(&app->live, file);
    LOCAL_TEXT(misfits);
    if (!s) {
        ceduo_page_note(page, _("not computed yet"));
        return;
    }
    add_rows(page, file, s->predicted);
    for (size_t i = 0; i < file->observations_count; i++) {
        const struct ceduo_predicted *p = &s->predicted[i];
        if (p->p_value >= CEDUO_MISFIT && p->inside)
            continue;
        ceduo_text_append(&misfits, misfits.length > 0 ? "; " : "");
        ceduo_text_append_escaped(&misfits, file->observations[i].name);
        const char *chance = p->p_value < 0.001 ? "<.001" : SIG(p->p_value, 2);
        if (isnan(p->p_value))
            ceduo_text_format(&misfits, " (%s)", _("no simulated rock does this"));
        else
            ceduo_text_format(&misfits,
                              p->inside                    ? _(" (mean fits, distribution does not: p %s)")
                              : p->p_value >= CEDUO_MISFIT ? _(" (mean outside: p %s)")
                                                           : " (p %s)",
                              chance);
    }
    if (misfits.length > 0)
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("The scene does not reproduce: %s."), misfits.bytes);
    else
        ceduo_page_note(page, _("The scene reproduces all observations."));
    if (ceduo_fit_has_observations(file))
        ceduo_page_note(page, _("c fits the ground to the observations. Only a fit shows which values they determine."));
    ceduo_page_para(page, CEDUO_PAGE_NOTE, _("Simulated: %llu rocks."), (unsigned long long)s->rocks);
}

static void append_best(struct text *text, const char *path, double best)
{
    ceduo_calibration_name(text, path);
    ceduo_text_append_char(text, ' ');
    ceduo_calibration_number(text, path, best);
}

static void append_progress(const struct live *live, struct ceduo_page *page)
{
    const struct fit *f = live->results.fit; /* NULL: no progress yet */
    const struct ceduo_calibration_state *s = f ? &f->state : NULL;
    ceduo_page_note(page, _("Fitting. Esc cancels and discards the fit."));
    if (!s || s->evaluations == 0)
        return;
    if (s->stage == CEDUO_CALIBRATION_STAGE_CHAINS && isfinite(s->rhat))
        ceduo_page_para(page, CEDUO_PAGE_NOTE,
                        _("%llu scenes; R-hat %.3f (target: at most 1.05), effective size %.0f (target: 200)."),
                        (unsigned long long)s->evaluations, s->rhat, s->effective_size);
    else
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("%llu scenes; log-likelihood %.2f."), (unsigned long long)s->evaluations,
                        s->log_likelihood);
    ceduo_page_note(page, _("Best values now:"));
    for (size_t i = 0; i < f->request.n; i++)
        append_best(ceduo_page_add(page, CEDUO_PAGE_ITEM), f->request.values[i].path, s->best[i]);
}

static struct ceduo_calibration_report make_report(const struct fit *f)
{
    return (struct ceduo_calibration_report){.scenes_count = 1,
                                             .files = &f->file,
                                             .inputs = f->inputs,
                                             .rocks = f->request.rocks,
                                             .answer = &f->answer,
                                             .fix_named = f->undetermined_count > 0};
}

static void append_fit(const struct fit *f, struct ceduo_page *page)
{
    const struct ceduo_calibration_report r = make_report(f);
    ceduo_page_note(page,
                    _("Fitted. Enter applies these values, Esc discards them. The picture shows the scene without them."));
    LOCAL_TEXT(undetermined);
    ceduo_calibration_names(&undetermined, f->inputs, f->request.n, f->undetermined);
    if (f->undetermined_count > 0)
        ceduo_page_para(page, CEDUO_PAGE_NOTE,
                        _("The observations do not determine all %zu values, so the ranges are rough: fix %s, or observe more. "
                          "c fits without it, which is faster."),
                        f->request.n, ceduo_text_string(&undetermined));
    for (size_t i = 0; i < f->request.n; i++) {
        const struct ceduo_fitted *fitted = &f->answer.parameters[i];
        struct text *text = ceduo_page_add(page, CEDUO_PAGE_ITEM);
        const char *path = f->inputs[i].path;
        append_best(text, path, fitted->best);
        ceduo_text_append(text, " (");
        ceduo_calibration_number(text, path, fitted->p2_5);
        ceduo_text_append(text, RANGE);
        ceduo_calibration_number(text, path, fitted->p97_5);
        ceduo_text_append(text, ")");
        if (!fitted->identified)
            ceduo_text_format(text, ", %s", _("not determined"));
    }
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    add_rows(page, &f->file, f->answer.predicted);
    ceduo_calibration_words(page, &r);
    ceduo_page_add(page, CEDUO_PAGE_GAP);
    /* the draws are not kept; print the command that writes them */
    ceduo_page_note(page, _("Enter writes the best values into the scene, with these ranges as their source. It does not write "
                            "the draws, all plausible values. After saving the scene as SCENE.yaml, this command writes them "
                            "to FITTED.draws.csv, and a scene FITTED.yaml that uses them:"));
    struct text *command = ceduo_page_add(page, CEDUO_PAGE_NOTE);
    ceduo_text_append(command, "ceduo");
    for (size_t i = 0; i < f->request.n; i++) {
        LOCAL_TEXT(value);
        ceduo_text_format(&value, "%s=%s:%s", f->inputs[i].path, ROUNDTRIP(f->inputs[i].lo), ROUNDTRIP(f->inputs[i].hi));
        ceduo_text_append(command, " --calibrate ");
        ceduo_text_append_quoted(command, value.bytes);
    }
    ceduo_text_format(command, " -n %llu -o FITTED.yaml SCENE.yaml", (unsigned long long)f->request.rocks);
}

/* ---- observations, to edit ---- */

/* Return the next kind of observation after a field of the schema (NULL: the first): a group with numbers. NULL at the end. */
static const struct field *next_kind(const struct field *f)
{
    const struct object *o = ceduo_schema_row("observed")->object;
    for (f = f ? f + 1 : o->fields; f < o->fields + o->n; f++)
        for (size_t k = 0; f->object && k < f->object->n; k++)
            if (f->object->fields[k].type == FIELD_NUMBERS || f->object->fields[k].type == FIELD_COUNT)
                return f;
    return NULL;
}

/* Return the group of the first item that has it, with the key (NULL: any); NULL: none. */
static const struct node *first_with(const struct node *rows, const char *group, const char *key)
{
    const struct node *found = NULL;
    for (size_t i = 0; i < rows->n && !(found && (!key || ceduo_node_get(found, key))); i++)
        found = ceduo_node_get(rows->items[i], group);
    return found && (!key || ceduo_node_get(found, key)) ? found : NULL;
}

static void build_observed(struct app *app, struct form *form)
{
    const struct node *rows = ceduo_document_node(&app->document, "observed");
    if (!rows || rows->kind != NODE_LIST || rows->n == 0)
        return;
    for (const struct field *kind = next_kind(NULL); kind; kind = next_kind(kind)) {
        const struct object *object = kind->object;
        LOCAL_TEXT(keys); /* hide keys of a table of values if no item has one */
        if (!first_with(rows, kind->key, NULL))
            continue;
        for (size_t k = 0; k < object->n; k++)
            if (object->fields[k].type > FIELD_FILE || first_with(rows, kind->key, object->fields[k].key))
                ceduo_text_append_joined(&keys, keys.length > 0 ? " " : "", "%s", object->fields[k].key);
        ceduo_form_heading(form, _(kind->meaning));
        ceduo_form_table(form, "observed", kind->key, ceduo_text_string(&keys));
    }
    ceduo_form_heading(form, _("All observations"));
    ceduo_form_table(form, "observed", NULL, "name use option");
}

static void select_kind(struct app *app, struct popup *p)
{
    ceduo_popup_new_item(app, "observed", p->value, NULL, 0);
}

static void ask_observation(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("New observation"), "", select_kind);
    char key = '1';
    for (const struct field *kind = next_kind(NULL); kind; kind = next_kind(kind))
        ceduo_popup_add_menu_item(p, key++, _(kind->meaning), kind->key);
}

/* ---- drawing ---- */

enum { PANE_FORM, PANE_TEXT, PANES };

static void draw_observed(struct app *app, struct ceduo_area area)
{
    const struct scene_file *file = &app->document.file;
    const struct live *f = &app->live;
    const struct comparison *c = ceduo_live_comparison(f, file);
    const struct ceduo_observed_stops *stops = NULL; /* stops of the option shown, otherwise the first */
    const struct ceduo_observation *observed = c ? c->file.observations : NULL;
    for (size_t i = 0; c && i < c->file.observations_count; i++)
        if (c->stops[i].known &&
            (!stops || (observed[i].option == app->option && observed[stops - c->stops].option != app->option)))
            stops = &c->stops[i];
    struct view_state *state = ceduo_app_state(app);
    bool fit = f->fitting || ceduo_live_fitted(f);
    if (fit)
        state->pane = PANE_TEXT;
    int lines = state->pane == PANE_TEXT ? 0 : (int)state->form.n, form = area.height / 3 < lines ? area.height / 3 : lines;
    ceduo_app_draw_form(app, cut_bottom(&area, form + (form > 0)));
    area.width -= 2; /* columns for the mark that the text continues */
    struct ceduo_page page = {.width = (size_t)area.width};
    if (file->observations_count == 0) {
        ceduo_page_note(&page, _("This scene has no observations."));
        ceduo_page_add(&page, CEDUO_PAGE_GAP);
        ceduo_page_note(&page, _("a adds observations: stop positions, numbers of passages, speeds, heights, scars on stems. A "
                                 "table of values is named in the scene's file, see man ceduo-scene."));
        ceduo_page_add(&page, CEDUO_PAGE_GAP);
        ceduo_page_note(&page, _("They are compared with simulated rocks here, and c fits the ground to them."));
    } else if (f->fitting)
        append_progress(f, &page);
    else if (fit)
        append_fit(ceduo_live_fitted(f), &page);
    else
        append_comparison(app, &page);
    int max = area.height - ceduo_page_draw(&page, &app->cells->canvas, (struct ceduo_area){0}, 0) - 1;
    int height = max > area.height / 2 ? max : area.height / 2;
    if (file->observations_count == 0 && max >= PICTURE_MIN) { /* the rocks that would be compared */
        struct ceduo_picture picture = ceduo_app_picture(app);
        ceduo_app_draw_plot(app, CEDUO_PLOT_PROFILE, cut_bottom(&area, max), &picture);
    } else if (stops && height >= PICTURE_MIN) {
        struct ceduo_area top = cut_top(&area, height);
        ceduo_plot_observed(&app->cells->canvas, &top, stops, file->scene.slope.origin_x);
        cut_top(&area, 1);
    }
    ceduo_app_draw_page(app, area, &page);
}

/* ---- values to fit, with bounds ---- */

#define FILLED 4 /* values offered with bounds; more take long */

static void append_bounds(struct text *text, const struct fit_value *value)
{
    const struct field *field = ceduo_schema_fitted(value->path);
    char lo[CEDUO_NUMBER_SIZE], hi[CEDUO_NUMBER_SIZE];
    ceduo_text_format(text, "%s:%s", ceduo_format_number(field, value->lo, lo), ceduo_format_number(field, value->hi, hi));
}

/* Read both bounds in the displayed unit. Return false and report if they are invalid. */
static bool read_bounds(struct app *app, const char *typed, struct fit_value *value)
{
    const char *colon = strchr(typed, ':');
    struct line line;
    for (int i = 0; i < 2; i++) {
        LOCAL_TEXT(end);
        double *to = i == 0 ? &value->lo : &value->hi;
        *to = NAN;
        ceduo_line_set(&line, i == 0 ? ceduo_app_format(app, "%.*s", (int)strcspn(typed, ":"), typed) : colon ? colon + 1 : "");
        line.confirmed = true; /* no bound is unusual */
        if (!ceduo_popup_read(app, ceduo_schema_fitted(value->path), &line, &end))
            return false;
        ceduo_number_read(ceduo_text_string(&end), to);
    }
    if (!(value->lo < value->hi))
        ceduo_app_warn(app, "%s", _("two bounds are needed, the smaller first"));
    return value->lo < value->hi;
}

/* Move the values to fit to the front. */
static bool submit_fit(struct app *app, struct popup *p)
{
    struct fit_request request;
    ceduo_fit_offer(&app->document.file, &request);
    struct fit_request selected = {.rocks = request.rocks};
    for (size_t i = 0; i < request.n; i++) {
        if (p->fields[i].line.text[0] == '\0')
            continue;
        if (!read_bounds(app, p->fields[i].line.text, &request.values[i]))
            return false;
        selected.values[selected.n++] = request.values[i];
    }
    if (selected.n == 0)
        ceduo_app_warn(app, "%s", _("no value to fit: give at least one its bounds, such as 0.3:0.4"));
    else
        ceduo_live_fit(&app->live, &app->document.file, &selected);
    return selected.n > 0;
}

/* True if the last fit determines the value; set its bounds from the fit. */
static bool is_determined(const struct fit *last, struct fit_value *value)
{
    for (size_t i = 0; i < last->request.n; i++)
        if (strcmp(last->request.values[i].path, value->path) == 0 && !last->undetermined[i]) {
            *value = last->request.values[i];
            return true;
        }
    return false;
}

_Static_assert(CEDUO_CALIBRATION_MAX <= POPUP_FIELDS_MAX, "one popup asks for the bounds of all values that can be fitted");

static void ask_fit_values(struct app *app)
{
    struct fit_request request;
    const struct fit *last = app->live.results.fit; /* running or finished; may be NULL */
    ceduo_fit_offer(&app->document.file, &request);
    struct popup *p = ceduo_popup_fields(app, _("Values to fit to the observations"), "", submit_fit);
    ceduo_text_format(&p->text,
                      _("Each value is fitted within its bounds; an empty field is not fitted. Each trial has %llu rocks."),
                      (unsigned long long)request.rocks);
    for (size_t i = FILLED; i < request.n; i++) {
        if (i == FILLED)
            ceduo_text_format(&p->text, " %s ", _("Usual bounds of other values:"));
        ceduo_text_append(&p->text, i == FILLED ? "" : "; ");
        ceduo_calibration_name(&p->text, request.values[i].path);
        ceduo_text_append_char(&p->text, ' ');
        append_bounds(&p->text, &request.values[i]);
    }
    for (size_t i = 0; i < request.n; i++) {
        LOCAL_TEXT(label);
        LOCAL_TEXT(bounds);
        ceduo_calibration_name(&label, request.values[i].path);
        if (last && last->undetermined_count > 0 ? is_determined(last, &request.values[i]) : i < FILLED)
            append_bounds(&bounds, &request.values[i]);
        ceduo_popup_add_field(p, label.bytes, ceduo_text_string(&bounds));
    }
}

/* ---- keys ---- */

static void start_fit(struct app *app)
{
    if (app->document.file.observations_count == 0)
        ceduo_app_warn(app, "%s", _("no observations; a adds one"));
    else if (!ceduo_fit_has_observations(&app->document.file))
        ceduo_app_warn(app, "%s", _("all observations are for checking; mark those to fit with 'use: fit'"));
    else
        ask_fit_values(app);
}

/* Write the best values into the scene, as one edit. */
static void apply_fit(struct app *app)
{
    const struct fit *f = ceduo_live_fitted(&app->live);
    if (!f && !app->live.fitting && ceduo_app_state(app)->pane == PANE_FORM && ceduo_app_form(app)->n > 0)
        ceduo_edit_start(app);
    else if (!f)
        ceduo_app_show_message(app, "%s",
                               app->live.fitting ? _("the fit is still running; Esc cancels it")
                                                 : _("c fits the ground to the observations"));
    if (!f)
        return;
    const struct ceduo_calibration_report r = make_report(f);
    LOCAL_TEXT(source);
    ceduo_calibration_sources(&source, &r);
    const struct fit_values values = {&f->answer, f->inputs, ceduo_text_string(&source), NULL};
    if (ceduo_app_finish_edit(app, ceduo_apply_fit(&app->document, &values)))
        ceduo_app_show_message(app, "%s", _("values and ranges written to the scene, without the draws; u undoes"));
}

static void stop_fit(struct app *app)
{
    if (app->live.fitting || ceduo_live_fitted(&app->live))
        ceduo_app_show_message(app, "%s", _("fit discarded; the scene is unchanged"));
    ceduo_live_drop_fit(&app->live);
}

static const struct key_binding observed_bindings[] = {KEY(COUNTS, .plain = start_fit),
                                                       KEY(EDIT, .plain = apply_fit),
                                                       KEY(ADD, .plain = ask_observation),
                                                       KEY(STOP, .plain = stop_fit),
                                                       {0}};

/* True unless a key needs a fit and there is none. */
static bool is_key_listed(const struct app *app, enum action action)
{
    bool fitted = ceduo_live_fitted(&app->live);
    return action == ACTION_EDIT ? fitted : action == ACTION_STOP ? fitted || app->live.fitting : true;
}

const struct view ceduo_view_observed = {.panes = PANES,
                                         .observed = true,
                                         .build = build_observed,
                                         .draw = draw_observed,
                                         .bindings = {observed_bindings, observed_bindings},
                                         .bar = {KEY(ADD, N_("add")), KEY(COUNTS, N_("fit")), KEY(EDIT, N_("apply")),
                                                 KEY(STOP, N_("discard")), KEY(NEXT_PANE, N_("scroll")),
                                                 KEY(NEXT_OPTION, N_("next option"))},
                                         .is_listed = is_key_listed};
