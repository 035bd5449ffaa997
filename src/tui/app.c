/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "app.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "io/emit.h"
#include "base/intl.h"
#include "base/utf8.h"
#include "model/alternatives.h"
#include "now.h"

const struct app_view *const ceduo_views[VIEWS] = {&ceduo_view_slope, &ceduo_view_stand, &ceduo_view_rock,
                                                   &ceduo_view_results, &ceduo_view_compare, &ceduo_view_rotation};

/* ---- saying things ---- */

__attribute__((format(printf, 3, 0))) static void say(struct app *app, bool bad, const char *format, va_list args)
{
    struct text text = {0}, safe = {0};
    va_list again;
    va_copy(again, args);
    ceduo_text_vformat(&text, format, args);
    ceduo_text_safe(&safe, text.bytes ? text.bytes : "");
    if (text.failed || safe.failed) { /* said even so: of it ASCII is safe */
        vsnprintf(app->message, sizeof app->message, format, again);
        for (char *p = app->message; *p; p++)
            *p = *p >= ' ' && *p <= '~' ? *p : '?';
    } else {
        snprintf(app->message, sizeof app->message, "%s", safe.bytes ? safe.bytes : "");
    }
    va_end(again);
    app->message_bad = bad;
    ceduo_text_free(&text);
    ceduo_text_free(&safe);
}

void ceduo_app_say(struct app *app, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(app, false, format, args);
    va_end(args);
}

void ceduo_app_warn(struct app *app, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    say(app, true, format, args);
    va_end(args);
}

/* The first problem's message, without the place, which the cursor shows. */
static void say_problem(struct app *app, struct problems *problems)
{
    const char *text = problems->text.bytes ? problems->text.bytes : _("out of memory\n");
    char first[400];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(text, "\n"), text);
    const char *colon = strstr(first, ": ");
    snprintf(app->message, sizeof app->message, "%s", colon ? colon + 2 : first);
    app->message_bad = true;
}

/* ---- figures ---- */

const struct ceduo_option *ceduo_app_option(const struct app *app)
{
    return &app->document.file.scene.options[app->option];
}

const struct ceduo_option_result *ceduo_app_found(const struct app *app)
{
    return app->result ? &app->result->options[app->option] : NULL;
}

const struct ceduo_arrivals *ceduo_app_shown(const struct app *app)
{
    const struct ceduo_result *r = app->result;
    const struct ceduo_arrivals *wood = r ? ceduo_result_wooded(r, app->option, r->last_control) : NULL;
    return wood || !r ? wood : &r->bare.arrivals[r->last_control];
}

void ceduo_app_forest(const struct app *app, char *path, size_t size)
{
    if (ceduo_node_get(app->document.file.root, "options"))
        snprintf(path, size, "options[%zu].forest", app->option);
    else
        snprintf(path, size, "forest");
}

/* Whether what was flown is of a scene like this one: an edit may have added a control or an option. */
static bool outlook_fits(const struct app *app)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    return app->outlook && app->outlook->controls == s->controls_count;
}

/* Years have figures for as many controls as there were when they were asked for. */
static bool years_fit(const struct app *app)
{
    return app->years && app->years->scene.controls_count == app->document.file.scene.controls_count;
}

struct ceduo_picture ceduo_app_picture(const struct app *app)
{
    return (struct ceduo_picture){.scene = &app->document.file.scene,
                                  .outlook = outlook_fits(app) ? app->outlook : NULL,
                                  .option = app->option,
                                  .belt = app->belt,
                                  .control = ceduo_plot_last_control(&app->document.file.scene),
                                  .selected = app->steps.trail.n > 0 ? &app->steps.trail : NULL,
                                  .stems = ceduo_steps_stems(&app->steps) > 0 ? app->steps.stems : NULL,
                                  .stems_count = ceduo_steps_stems(&app->steps),
                                  .years = years_fit(app) && app->years_option == app->option ? app->years : NULL,
                                  .year = app->year};
}

/* Assesses the scene as it is now by the newest run, if that is its run. */
static void refresh_result(struct app *app)
{
    ceduo_result_free(app->result);
    app->result = NULL;
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct ceduo_outlook *o = app->outlook;
    if (!outlook_fits(app) || !o->bare)
        return;
    size_t n = scene->options_count, controls = scene->controls_count;
    const struct ceduo_flown **wooded = calloc(n + 1, sizeof *wooded);
    struct ceduo_difference *differences = calloc(n * controls + 1, sizeof *differences);
    bool in_order = o->options == n;
    for (size_t i = 0; wooded && i < n; i++) {
        const struct ceduo_sight *sight = ceduo_outlook_sight(o, scene, i);
        wooded[i] = sight ? &sight->flown : NULL;
        in_order = in_order && sight == o->wooded[i];
    }
    const struct ceduo_paired unknown = {NAN, NAN};
    for (size_t i = 0; differences && i < n * controls; i++)
        differences[i] = in_order ? o->differences[i] : (struct ceduo_difference){unknown, unknown, unknown};
    if (!wooded || !differences ||
        ceduo_result_assess(scene, &o->bare->flown, wooded, differences, &app->result) != CEDUO_OK)
        app->result = NULL;
    free(differences);
    free(wooded);
    if (years_fit(app))
        ceduo_years_assess(app->years, scene, &o->bare->flown);
}

/* The scene has changed: what the rocks meet is asked for anew, the rest follows at once. */
static void refresh(struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    if (app->option >= scene->options_count)
        app->option = scene->options_count - 1;
    const struct ceduo_option *o = ceduo_app_option(app);
    if (app->belt >= o->belts_count)
        app->belt = o->belts_count > 0 ? o->belts_count - 1 : 0;
    bool years = app->view == VIEW_ROTATION;
    uint64_t key = years ? ceduo_worker_years_key(scene, app->option) : ceduo_worker_key(scene);
    if (key != app->outlook_key) {
        ceduo_worker_request(app->worker, scene, app->option, years);
        app->outlook_key = key;
        app->busy = true;
    }
    refresh_result(app);
    for (int v = 0; v < VIEWS; v++) {
        ceduo_form_clear(&app->forms[v]);
        if (v == (int)app->view && ceduo_views[v]->build) {
            ceduo_views[v]->build(app, &app->forms[v]);
            ceduo_form_settle(&app->forms[v]);
        }
    }
}

bool ceduo_app_edited(struct app *app, bool good, struct problems *problems)
{
    ceduo_problems_close(problems);
    if (!good)
        say_problem(app, problems);
    ceduo_problems_free(problems);
    if (good)
        refresh(app);
    return good;
}

bool ceduo_app_news(struct app *app)
{
    struct worker_news news = ceduo_worker_news(app->worker);
    bool changed = news.busy != app->busy || news.outlook;
    app->busy = news.busy;
    if (news.outlook) {
        ceduo_outlook_free(app->outlook);
        app->outlook = news.outlook;
        app->shown_key = news.key;
        app->seconds = news.seconds;
    }
    if (news.years) {
        ceduo_years_free(app->years);
        app->years = news.years;
        app->years_option = news.years_option;
        app->year = app->year < app->years->count ? app->year : 0;
        changed = true;
    }
    if (news.outlook || news.years)
        refresh_result(app);
    if (news.failed)
        ceduo_app_warn(app, "%s", _("out of memory: the figures are not up to date"));
    return changed || news.failed;
}

/* ---- opening and closing ---- */

static void show_view(struct app *app, enum view_number view)
{
    app->view = view;
    app->pane = 0;
    app->scroll = 0;
    refresh(app);
}

static void offer_recovery(struct app *app)
{
    char *file = NULL, *text = app->no_recovery ? NULL : ceduo_document_left_behind(app->document.path, &file);
    bool without_file = !text && !app->no_recovery && app->document.path;
    if (without_file)
        text = ceduo_document_left_behind(NULL, &file);
    if (text)
        ceduo_popup_recover(app, text, file, without_file);
}

static void took_document(struct app *app)
{
    if (app->no_recovery) {
        ceduo_document_forget(&app->document);
        free(app->document.recovery);
        app->document.recovery = NULL;
    }
    app->option = app->belt = 0;
    app->rock = 0;
    app->outlook_key = 0;
    app->editing = false;
    ceduo_outlook_free(app->outlook);
    app->outlook = NULL;
    ceduo_years_free(app->years);
    app->years = NULL;
    app->year = 0;
    for (int v = 0; v < VIEWS; v++)
        app->forms[v].row = app->forms[v].column = app->forms[v].top = 0;
    show_view(app, app->view);
    offer_recovery(app);
}

bool ceduo_app_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads,
                      bool no_recovery, struct problems *problems)
{
    *app = (struct app){.charset = charset, .no_recovery = no_recovery};
    if (!ceduo_document_open(&app->document, path ? path : "paper-site", problems))
        return false;
    app->worker = ceduo_worker_create(threads);
    if (!app->worker) {
        ceduo_problem_memory(problems);
        ceduo_document_close(&app->document);
        return false;
    }
    took_document(app);
    return true;
}

void ceduo_app_free(struct app *app)
{
    ceduo_popup_close(app);
    ceduo_worker_free(app->worker);
    ceduo_result_free(app->result);
    ceduo_outlook_free(app->outlook);
    ceduo_years_free(app->years);
    for (int v = 0; v < VIEWS; v++)
        ceduo_form_free(&app->forms[v]);
    ceduo_steps_free(&app->steps);
    ceduo_canvas_free(app->canvas);
    ceduo_document_close(&app->document);
    *app = (struct app){0};
}

/* Puts another document in place of this one. The worker reads the old one's memory: it is let go first. */
static bool replace_document(struct app *app, struct document *next)
{
    struct worker *worker = ceduo_worker_create(ceduo_worker_threads(app->worker));
    if (!worker) {
        ceduo_document_close(next);
        ceduo_app_warn(app, "%s", _("out of memory"));
        return false;
    }
    ceduo_worker_free(app->worker);
    app->worker = worker;
    ceduo_result_free(app->result);
    app->result = NULL;
    ceduo_document_forget(&app->document);
    ceduo_document_close(&app->document);
    app->document = *next;
    took_document(app);
    return true;
}

/* What was opened takes the place of this document, or the reason why not is shown. */
static bool take_opened(struct app *app, struct document *next, bool good, struct problems *problems)
{
    if (good)
        good = replace_document(app, next);
    else
        say_problem(app, problems);
    ceduo_problems_free(problems);
    return good;
}

bool ceduo_app_open(struct app *app, const char *path)
{
    struct document next;
    struct problems problems = {0};
    return take_opened(app, &next, ceduo_document_open(&next, path, &problems), &problems);
}

bool ceduo_app_open_text(struct app *app, const char *text)
{
    struct document next;
    struct problems problems = {0};
    return take_opened(app, &next, ceduo_document_new(&next, text, &problems), &problems);
}

static bool save_to(struct app *app, const char *path)
{
    bool anew;
    if (ceduo_document_is_shipped(path)) {
        ceduo_app_warn(app, _("%s belongs to the program and is never written over; choose another name"), path);
        return false;
    }
    char from[256] = ""; /* the file of before, where it is another */
    const char *old = app->document.path, *slash = old ? strrchr(old, '/') : NULL;
    if (old && strcmp(old, path) != 0)
        snprintf(from, sizeof from, "%s", slash ? slash + 1 : old);
    if (!ceduo_document_save(&app->document, path, &anew)) {
        int why = errno;
        ceduo_app_warn(app, "%s: %s", path, strerror(why));
        errno = why;
        return false;
    }
    if (anew && from[0])
        ceduo_app_say(app, _("saved %s; laid out anew, without the comments of %s"), path, from);
    else if (anew)
        ceduo_app_say(app, _("saved %s; laid out anew, the old file is %s.bak"), path, path);
    else
        ceduo_app_say(app, _("saved %s"), path);
    app->quit |= app->quit_once_saved;
    return true;
}

bool ceduo_app_save_to(struct app *app, const char *path)
{
    char *copy = strdup(path); /* it may be the document's own, which saving makes anew */
    bool good = copy && save_to(app, copy);
    int why = errno;
    if (!copy)
        ceduo_app_warn(app, "%s: %s", path, strerror(why));
    free(copy);
    errno = why;
    return good;
}

void ceduo_app_write(struct app *app)
{
    if (!ceduo_app_save_to(app, app->document.path))
        ceduo_popup_save_as(app, strerror(errno));
}

void ceduo_app_save(struct app *app)
{
    if (!app->document.path || app->document.shipped)
        ceduo_popup_save_as(app, NULL);
    else if (ceduo_document_changed_on_disk(&app->document))
        ceduo_popup_changed_on_disk(app);
    else
        ceduo_app_write(app);
}

/* ---- editing fields ---- */

static struct form *form_of(struct app *app)
{
    return &app->forms[app->view];
}

bool ceduo_app_set(struct app *app, const char *path, const char *value)
{
    struct problems problems = {0};
    struct text said = {0};
    bool good = ceduo_document_set_alone(&app->document, path, value, &said, &problems);
    good = ceduo_app_edited(app, good, &problems);
    if (good && said.bytes)
        ceduo_app_say(app, "%s", said.bytes);
    ceduo_text_free(&said);
    return good;
}

static bool set_value(struct app *app, const struct form_cell *cell, const char *value)
{
    struct problems problems = {0};
    char path[FORM_PATH];
    snprintf(path, sizeof path, "%s", cell->path); /* the form is made anew below */
    if (value[0] == '\0') /* nothing: back to the default */
        return ceduo_app_edited(app, ceduo_document_delete(&app->document, path, &problems), &problems);
    struct text quoted = {0};
    if (cell->field && cell->field->type == FIELD_TEXT)
        ceduo_emit_scalar(&quoted, value, true);
    bool good = ceduo_app_set(app, path, quoted.bytes ? quoted.bytes : value);
    ceduo_text_free(&quoted);
    return good;
}

/* The whole value as it is typed: what is shown may be cut or put in other words. */
static void start_editing(struct app *app)
{
    struct form_cell *cell = ceduo_form_cell(form_of(app));
    if (!cell || !cell->field)
        return;
    if (cell->field->type == FIELD_CHOICE || (cell->field->flags & FIELD_FOLLOWS)) {
        ceduo_popup_choices(app, cell);
        return;
    }
    const struct node *node = ceduo_document_node(&app->document, cell->path);
    struct text text = {0};
    if (node && node->kind == NODE_SCALAR)
        ceduo_text_put(&text, node->text);
    else if (node)
        ceduo_emit_flow(&text, node);
    else
        ceduo_text_put(&text, cell->text);
    ceduo_line_set(&app->line, text.bytes ? text.bytes : "");
    ceduo_text_free(&text);
    app->editing = true;
}

static void editing_key(struct app *app, int key)
{
    struct form_cell *cell = ceduo_form_cell(form_of(app));
    if (key == K_ESCAPE || !cell) {
        app->editing = false;
    } else if (key == K_ENTER || key == K_TAB) {
        if (set_value(app, cell, app->line.text)) {
            app->editing = false;
            if (key == K_TAB)
                ceduo_form_move(form_of(app), 0, 1);
        }
    } else {
        ceduo_line_key(&app->line, key);
    }
}

static void step_value(struct app *app, int direction)
{
    struct form_cell *cell = ceduo_form_cell(form_of(app));
    struct text value = {0};
    if (!cell || !ceduo_form_step(&app->document, cell, direction, &value) || !value.bytes)
        ceduo_app_say(app, "%s", _("this field has no steps; Enter edits it"));
    else if (strcmp(value.bytes, cell->text) == 0)
        ceduo_app_say(app, "%s", _("the limit of its range"));
    else
        set_value(app, cell, value.bytes);
    ceduo_text_free(&value);
}

/* What a new item of a list begins as where there is none to copy. */
static const char *first_item(const char *list)
{
    const char *dot = strrchr(list, '.');
    const char *key = dot ? dot + 1 : list;
    if (strcmp(key, "forest") == 0)
        return NULL; /* needs to know where */
    if (strcmp(key, "trees") == 0)
        return "{per_ha: 60, dbh_m: 0.2, height_m: 12}";
    if (strcmp(key, "shoots") == 0)
        return "{per_ha: 6000, dbh_m: 0.06, height_m: 6}";
    return NULL;
}

/* A first cohort of shoots needs stools to stand on. */
static bool add_first_shoots(struct app *app, const char *list, struct problems *problems)
{
    char stools[FORM_PATH + 64], shoots[FORM_PATH + 64];
    int n = (int)strlen(list) - (int)strlen("shoots");
    snprintf(stools, sizeof stools, "%.*sstools={per_ha: 2500, spacing_m: 0.35}", n, list);
    snprintf(shoots, sizeof shoots, "%s=[{per_ha: 7500, dbh_m: 0.07, height_m: 8}]", list);
    const char *const sets[] = {stools, shoots};
    return ceduo_document_set_all(&app->document, sets, 2, list, problems);
}

/* The first stretch without forest, and the belt that it lies before; false where the forest fills the slope. */
static bool free_stretch(const struct app *app, double *from, double *to, size_t *index)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(app);
    double origin = app->document.file.origin_x, end = s->slope.x[s->slope.vertices - 1];
    double at = s->release.x.mean;
    for (size_t i = 0; i <= o->belts_count; i++) {
        double next = i < o->belts_count ? o->belts[i].from : end;
        if (next - at > 0.5) {
            *from = at + origin;
            *to = next + origin;
            *index = i;
            return true;
        }
        at = i < o->belts_count ? o->belts[i].to : at;
    }
    return false;
}

static bool add_belt(struct app *app, const char *list, struct problems *problems)
{
    double from, to;
    size_t index;
    char item[256];
    if (!free_stretch(app, &from, &to, &index)) {
        ceduo_app_warn(app, "%s", _("the belts fill the slope; shorten one, or y splits one in two"));
        return false;
    }
    snprintf(item, sizeof item, "{from_m: %.10g, to_m: %.10g, stand: simple-coppice}", from, to);
    return ceduo_document_insert(&app->document, list, index, item, problems);
}

static bool add_control(struct app *app, const char *list, struct problems *problems)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    double last = s->controls[0].x, end = s->slope.x[s->slope.vertices - 1];
    for (size_t i = 1; i < s->controls_count; i++)
        last = s->controls[i].x > last ? s->controls[i].x : last;
    double start = s->release.x.mean + s->release.x.spread * 3;
    double x = last < end ? (last + end) / 2 : (start + s->controls[0].x) / 2;
    char item[64];
    snprintf(item, sizeof item, "{x_m: %.6g}", x + app->document.file.origin_x);
    return ceduo_document_insert(&app->document, list, 1000000, item, problems);
}

static void add_item(struct app *app)
{
    struct form_row *row = ceduo_form_row(form_of(app));
    struct problems problems = {0};
    if (!row || !row->list[0]) {
        ceduo_app_say(app, "%s", _("a adds to a list: put the cursor on one"));
        return;
    }
    char list[FORM_PATH];
    snprintf(list, sizeof list, "%s", row->list);
    const char *dot = strrchr(list, '.');
    const char *key = dot ? dot + 1 : list;
    bool good;
    if (strcmp(key, "forest") == 0)
        good = add_belt(app, list, &problems);
    else if (strcmp(key, "controls") == 0)
        good = add_control(app, list, &problems);
    else if (strcmp(key, "shoots") == 0 && row->n == 0)
        good = add_first_shoots(app, list, &problems);
    else if (row->n > 0)
        good = ceduo_document_duplicate(&app->document, list, row->index, &problems);
    else
        good = first_item(list) && ceduo_document_insert(&app->document, list, 0, first_item(list), &problems);
    if (good || problems.count > 0 || problems.memory)
        ceduo_app_edited(app, good, &problems);
    ceduo_problems_free(&problems);
    if (good)
        ceduo_form_move(form_of(app), 1, 0);
}

/* The cursor must not slip into the next list, where another d would delete what nobody meant. */
static void stay_in_list(struct app *app, const char *list)
{
    struct form_row *row = ceduo_form_row(form_of(app));
    if (row && strcmp(row->list, list) != 0)
        ceduo_form_move(form_of(app), -1, 0);
}

static void delete_item(struct app *app)
{
    struct form_row *row = ceduo_form_row(form_of(app));
    struct problems problems = {0};
    if (!row || !row->list[0] || row->n == 0) {
        ceduo_app_say(app, "%s", _("d deletes an item of a list: put the cursor on one"));
        return;
    }
    char path[FORM_PATH + 32];
    const char *dot = strrchr(row->list, '.');
    const char *key = dot ? dot + 1 : row->list;
    const struct node *list = ceduo_document_node(&app->document, row->list);
    bool shoots = strcmp(key, "shoots") == 0 && list && list->n == 1;
    snprintf(path, sizeof path, "%s[%zu]", row->list, row->index);
    bool good;
    if (strcmp(row->list, "slope.segments") == 0) {
        good = ceduo_document_join_segments(&app->document, row->index, &problems);
    } else if (shoots) { /* the stools go with their last shoots */
        char stand[FORM_PATH];
        snprintf(stand, sizeof stand, "%.*s", (int)(dot - row->list), row->list);
        good = ceduo_document_delete_both(&app->document, stand, "stools", "shoots", &problems);
    } else {
        good = ceduo_document_delete(&app->document, path, &problems);
    }
    char list_path[FORM_PATH];
    snprintf(list_path, sizeof list_path, "%s", row->list);
    if (ceduo_app_edited(app, good, &problems)) {
        stay_in_list(app, list_path);
        ceduo_app_say(app, _("deleted %s; u brings it back"), path);
    }
}

/* A belt is duplicated by splitting it: two cannot stand in one place. */
static bool split_belt(struct app *app, const char *list, size_t i, struct problems *problems)
{
    const struct ceduo_belt *b = &ceduo_app_option(app)->belts[i];
    char first[FORM_PATH + 64], second[FORM_PATH + 64];
    double middle = (b->from_given + b->to_given) / 2;
    snprintf(first, sizeof first, "%s[%zu].to_m=%.10g", list, i, middle);
    snprintf(second, sizeof second, "%s[%zu].from_m=%.10g", list, i + 1, middle);
    return ceduo_document_split(&app->document, list, i, first, second, problems);
}

/* A segment is split in two of the same ground. */
static bool split_segment(struct app *app, size_t i, struct problems *problems)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    char vertex[96];
    if (!ceduo_document_node(&app->document, "slope.vertices_m"))
        return false;
    snprintf(vertex, sizeof vertex, "[%.10g, %.10g]", (s->x[i] + s->x[i + 1]) / 2 + s->origin_x,
             (s->z[i] + s->z[i + 1]) / 2 + s->origin_z);
    return ceduo_document_split_segment(&app->document, i, vertex, problems);
}

static void duplicate_item(struct app *app)
{
    struct form_row *row = ceduo_form_row(form_of(app));
    struct problems problems = {0};
    if (!row || !row->list[0] || row->n == 0) {
        ceduo_app_say(app, "%s", _("y duplicates an item of a list: put the cursor on one"));
        return;
    }
    char list[FORM_PATH];
    size_t index = row->index;
    snprintf(list, sizeof list, "%s", row->list);
    const char *dot = strrchr(list, '.');
    const char *key = dot ? dot + 1 : list;
    bool good;
    if (strcmp(key, "forest") == 0)
        good = split_belt(app, list, index, &problems);
    else if (strcmp(key, "segments") == 0)
        good = split_segment(app, index, &problems);
    else if (strcmp(key, "controls") == 0)
        good = add_control(app, list, &problems);
    else
        good = ceduo_document_duplicate(&app->document, list, index, &problems);
    if (ceduo_app_edited(app, good, &problems))
        ceduo_form_move(form_of(app), 1, 0);
}

static void move_item(struct app *app, int by)
{
    struct form_row *row = ceduo_form_row(form_of(app));
    struct problems problems = {0};
    if (!row || !row->list[0] || row->n == 0 || (by < 0 && row->index == 0))
        return;
    char list[FORM_PATH];
    snprintf(list, sizeof list, "%s", row->list);
    if (ceduo_app_edited(app, ceduo_document_move(&app->document, list, row->index, row->index + (size_t)by, &problems),
                         &problems))
        ceduo_form_move(form_of(app), by, 0);
}

/* ---- other actions ---- */

static void undo_or_redo(struct app *app, bool redo)
{
    struct document *d = &app->document;
    const char *what = redo ? (d->at + 1 < d->count ? d->states[d->at + 1].what : "") : d->states[d->at].what;
    char line[200];
    snprintf(line, sizeof line, "%s", what);
    if (!(redo ? ceduo_document_redo(d) : ceduo_document_undo(d))) {
        ceduo_app_say(app, "%s", redo ? _("nothing to redo") : _("nothing to undo"));
        return;
    }
    refresh(app);
    if (redo)
        ceduo_app_say(app, _("again: %s"), line);
    else
        ceduo_app_say(app, _("undone: %s"), line);
}

static void next_option(struct app *app, int by)
{
    size_t n = app->document.file.scene.options_count;
    app->option = (app->option + (by > 0 ? 1 : n - 1)) % n;
    app->belt = 0;
    refresh(app);
    ceduo_app_say(app, _("option %zu of %zu: %s"), app->option + 1, n, ceduo_app_option(app)->name);
}

static void say_steps(struct app *app)
{
    struct text text = {0};
    ceduo_steps_say(&app->steps, &app->document.file.scene, app->document.file.origin_x, &text);
    if (text.bytes)
        ceduo_app_say(app, "%s", text.bytes);
    ceduo_text_free(&text);
}

void ceduo_app_follow_belt(struct app *app)
{
    struct form_row *row = ceduo_form_row(form_of(app));
    char forest[64];
    ceduo_app_forest(app, forest, sizeof forest);
    if (!row || row->n == 0 || strcmp(row->list, forest) != 0 || row->index == app->belt)
        return;
    app->belt = row->index;
    struct problems none = {0};
    ceduo_app_edited(app, true, &none);
}

bool ceduo_app_follow(struct app *app, uint64_t rock)
{
    uint64_t key = app->outlook_key ^ (uint64_t)(app->option + 1) * 1099511628211u;
    bool good = ceduo_steps_follow(&app->steps, &app->document.file.scene, ceduo_app_option(app), key, rock);
    if (!good)
        ceduo_steps_free(&app->steps);
    return good;
}

void ceduo_app_show_rock(struct app *app, uint64_t rock)
{
    app->rock = rock;
    if (ceduo_app_follow(app, rock))
        say_steps(app);
}

void ceduo_app_step_rock(struct app *app, int by)
{
    ceduo_steps_move(&app->steps, by);
    say_steps(app);
}

/* The first cell of a row that matches, by the row's name, its own or what it holds. */
static bool matches(const struct form_row *row, const char *what, size_t *column)
{
    *column = 0;
    if (strcasestr(row->label, what))
        return true;
    for (size_t k = 0; k < row->n; k++)
        if (strcasestr(row->cells[k].text, what) || strcasestr(row->cells[k].path, what)) {
            *column = k;
            return true;
        }
    return false;
}

static void search_again(struct app *app)
{
    struct form *form = form_of(app);
    for (size_t i = 1; app->search[0] && i <= form->n; i++) {
        size_t at = (form->row + i) % form->n;
        size_t column;
        if (form->rows[at].kind == FORM_FIELDS && matches(&form->rows[at], app->search, &column)) {
            form->row = at;
            form->column = column;
            app->pane = 0;
            ceduo_form_settle(form);
            return;
        }
    }
    ceduo_app_say(app, _("'%s' is not found in this view"), app->search);
}

static void scroll_by(struct app *app, int lines)
{
    app->scroll += lines;
    if (app->scroll < 0)
        app->scroll = 0;
}

static void move_cursor(struct app *app, int lines, int columns)
{
    if (app->pane == 0 && form_of(app)->n > 0)
        ceduo_form_move(form_of(app), lines, columns);
    else
        scroll_by(app, lines);
}

static void ask_to_quit(struct app *app)
{
    if (ceduo_document_unsaved(&app->document))
        ceduo_popup_quit(app);
    else
        app->quit = true;
}

static void act(struct app *app, enum action action)
{
    int page = app->height > 12 ? app->height / 2 : 5;
    switch (action) {
    case ACTION_UP: move_cursor(app, -1, 0); break;
    case ACTION_DOWN: move_cursor(app, 1, 0); break;
    case ACTION_LEFT: move_cursor(app, 0, -1); break;
    case ACTION_RIGHT: move_cursor(app, 0, 1); break;
    case ACTION_TOP: move_cursor(app, -100000, 0); break;
    case ACTION_BOTTOM: move_cursor(app, app->pane == 0 ? 100000 : 50, 0); break;
    case ACTION_PAGE_UP: move_cursor(app, -page, 0); break;
    case ACTION_PAGE_DOWN: move_cursor(app, page, 0); break;
    case ACTION_EDIT: start_editing(app); break;
    case ACTION_MORE: step_value(app, 1); break;
    case ACTION_LESS: step_value(app, -1); break;
    case ACTION_ADD: add_item(app); break;
    case ACTION_DELETE: delete_item(app); break;
    case ACTION_DUPLICATE: duplicate_item(app); break;
    case ACTION_EARLIER: move_item(app, -1); break;
    case ACTION_LATER: move_item(app, 1); break;
    case ACTION_UNDO: undo_or_redo(app, false); break;
    case ACTION_REDO: undo_or_redo(app, true); break;
    case ACTION_PRESETS: ceduo_popup_presets(app, false); break;
    case ACTION_COUNTS: ceduo_popup_counts(app); break;
    case ACTION_NEXT_PANE: app->pane = (app->pane + 1) % ceduo_views[app->view]->panes; break;
    case ACTION_LAST_PANE:
        app->pane = (app->pane + ceduo_views[app->view]->panes - 1) % ceduo_views[app->view]->panes;
        break;
    case ACTION_VIEW_1: show_view(app, VIEW_SLOPE); break;
    case ACTION_VIEW_2: show_view(app, VIEW_STAND); break;
    case ACTION_VIEW_3: show_view(app, VIEW_ROCK); break;
    case ACTION_VIEW_4: show_view(app, VIEW_RESULTS); break;
    case ACTION_VIEW_5: show_view(app, VIEW_COMPARE); break;
    case ACTION_VIEW_6: show_view(app, VIEW_ROTATION); break;
    case ACTION_FIND: ceduo_popup_find(app); break;
    case ACTION_NEXT_OPTION: next_option(app, 1); break;
    case ACTION_LAST_OPTION: next_option(app, -1); break;
    case ACTION_NEXT_ROCK: ceduo_app_show_rock(app, app->rock + 1); break;
    case ACTION_LAST_ROCK: ceduo_app_show_rock(app, app->rock > 0 ? app->rock - 1 : 0); break;
    case ACTION_SEARCH: ceduo_popup_search(app); break;
    case ACTION_AGAIN: search_again(app); break;
    case ACTION_NEW: ceduo_popup_new(app); break;
    case ACTION_OPEN: ceduo_popup_open(app); break;
    case ACTION_SAVE: ceduo_app_save(app); break;
    case ACTION_SAVE_AS: ceduo_popup_save_as(app, NULL); break;
    case ACTION_EXPORT: ceduo_popup_export(app); break;
    case ACTION_CHARSET:
        app->charset = (enum ceduo_charset)((app->charset + 1) % 3);
        ceduo_app_resize(app, app->width, app->height);
        break;
    case ACTION_THEME: app->theme = (app->theme + 1) % 3; break;
    case ACTION_REDRAW: app->redraw = true; break;
    case ACTION_HELP: ceduo_popup_help(app); break;
    case ACTION_QUIT: ask_to_quit(app); break;
    default: break;
    }
}

void ceduo_app_key(struct app *app, int key)
{
    enum action action = ceduo_action_of(key);
    if (app->popup) {
        ceduo_popup_key(app, key);
    } else if (app->editing) {
        app->message[0] = '\0';
        editing_key(app, key);
    } else {
        const struct app_view *view = ceduo_views[app->view];
        app->message[0] = '\0';
        app->quit_once_saved = false;
        if (action != ACTION_NONE && !(view->act && view->act(app, action)))
            act(app, action);
    }
    if (!app->quit && ceduo_views[app->view]->follow)
        ceduo_views[app->view]->follow(app);
}

void ceduo_app_click(struct app *app, int x, int y)
{
    struct form *form = form_of(app);
    const struct ceduo_area *a = &app->form_area;
    size_t row, column;
    if (app->popup || app->editing)
        return;
    if (y == 0) {
        for (int v = 0, at = 0; v < VIEWS; v++) {
            int n = (int)ceduo_utf8_width(_(ceduo_views[v]->name)) + 4;
            if (x >= at && x < at + n)
                show_view(app, (enum view_number)v);
            at += n;
        }
    } else if (ceduo_form_hit(form, a->left, a->top, a->width, a->height, x, y, &row, &column)) {
        bool again = form->row == row && form->column == column && app->pane == 0;
        form->row = row;
        form->column = column;
        app->pane = 0;
        ceduo_form_settle(form);
        if (again)
            start_editing(app);
    }
}

void ceduo_app_wheel(struct app *app, int lines)
{
    if (app->popup)
        ceduo_popup_key(app, lines < 0 ? K_UP : K_DOWN);
    else if (!app->editing)
        move_cursor(app, lines, 0);
}

void ceduo_app_resize(struct app *app, int width, int height)
{
    width = width < 1 ? 1 : width > CEDUO_CANVAS_MAX_WIDTH ? CEDUO_CANVAS_MAX_WIDTH : width;
    height = height < 1 ? 1 : height > CEDUO_CANVAS_MAX_HEIGHT ? CEDUO_CANVAS_MAX_HEIGHT : height;
    struct ceduo_canvas *canvas = ceduo_canvas_create(width, height, app->charset);
    if (!canvas) {
        app->stopped = app->canvas == NULL;
        return;
    }
    ceduo_canvas_free(app->canvas);
    app->canvas = canvas;
    app->width = width;
    app->height = height;
}

/* ---- drawing ---- */

void ceduo_app_label(struct app *app, int x, int y, enum ceduo_role role, const char *format, ...)
{
    struct text text = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    if (text.bytes)
        ceduo_canvas_label(app->canvas, x, y, role, text.bytes);
    ceduo_text_free(&text);
}

/* One line of at most `columns`, broken at a blank where it can be; the bytes it takes. */
static size_t line_length(const char *text, int columns)
{
    size_t n = 0, blank = 0;
    int width = 0;
    for (; text[n] && text[n] != '\n'; n++) {
        if (((unsigned char)text[n] & 0xc0) == 0x80)
            continue;
        if (width == columns)
            return blank > 0 ? blank : n;
        if (text[n] == ' ')
            blank = n;
        width++;
    }
    return n;
}

int ceduo_app_text(struct app *app, struct ceduo_area area, enum ceduo_role role, const char *text, int skip)
{
    int lines = 0;
    while (*text) {
        size_t n = line_length(text, area.width);
        char copy[1024];
        size_t kept = n < sizeof copy - 1 ? n : sizeof copy - 1;
        memcpy(copy, text, kept);
        copy[kept] = '\0';
        if (lines >= skip && lines - skip < area.height)
            ceduo_canvas_label(app->canvas, area.left, area.top + lines - skip, role, copy);
        lines++;
        text += n;
        if (*text == '\n' || *text == ' ')
            text++;
    }
    return lines;
}

static void draw_title(struct app *app)
{
    int x = 0;
    for (int v = 0; v < VIEWS; v++) {
        bool here = v == (int)app->view;
        ceduo_app_label(app, x, 0, here ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_DIM, " %d %s ", v + 1, _(ceduo_views[v]->name));
        x += (int)ceduo_utf8_width(_(ceduo_views[v]->name)) + 4;
    }
    struct text title = {0};
    ceduo_text_format(&title, "%s", ceduo_document_unsaved(&app->document) ? "* " : "");
    ceduo_text_safe(&title, app->document.file.scene.title);
    int room = app->width - x - 1;
    if (title.bytes && room > 4) {
        int columns = (int)ceduo_utf8_width(title.bytes);
        ceduo_form_cut(app->canvas, columns < room ? app->width - columns : x + 1, 0, room, CEDUO_ROLE_TITLE,
                       title.bytes);
    }
    ceduo_text_free(&title);
}

static void draw_explanation(struct app *app)
{
    struct text text = {0}, safe = {0};
    struct form_cell *cell = ceduo_form_cell(form_of(app));
    enum ceduo_role role = CEDUO_ROLE_TEXT;
    if (app->message[0]) {
        ceduo_text_put(&text, app->message);
        role = app->message_bad ? CEDUO_ROLE_WARN : CEDUO_ROLE_GOOD;
    } else if (cell && app->pane == 0) {
        ceduo_form_explain(&app->document, cell, &text);
    }
    ceduo_text_safe(&safe, text.bytes ? text.bytes : "");
    bool two_lines = safe.bytes && app->message[0] && (int)ceduo_utf8_width(safe.bytes) > app->width;
    struct ceduo_area lines = {0, app->height - 3, app->width, 2};
    if (two_lines)
        ceduo_app_text(app, lines, role, safe.bytes, 0);
    else if (safe.bytes)
        ceduo_form_cut(app->canvas, 0, app->height - 2, app->width, role, safe.bytes);
    ceduo_text_free(&text);
    ceduo_text_free(&safe);
}

static int bar_width(const struct action_row *a)
{
    return (int)ceduo_utf8_width(a->word) + (int)ceduo_utf8_width(_(a->help)) + 3;
}

static void draw_bar(struct app *app)
{
    int x = 0;
    if (app->popup || app->editing) {
        ceduo_app_label(app, 0, app->height - 1, CEDUO_ROLE_DIM, "%s",
                        app->popup ? ceduo_popup_bar(app)
                                   : _("Enter takes the value  Esc leaves it as it was  empty: the default"));
        return;
    }
    int room = app->width + 2;
    for (int i = 0; i < ACTION_COUNT; i++)
        room -= ceduo_actions[i].bar == 2 ? bar_width(&ceduo_actions[i]) : 0;
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_row *a = &ceduo_actions[i];
        const char *help = _(a->help);
        int n = bar_width(a);
        if (!a->bar || (a->bar == 1 && n > room))
            continue;
        room -= a->bar == 1 ? n : 0;
        ceduo_app_label(app, x, app->height - 1, CEDUO_ROLE_TITLE, "%s", a->word);
        ceduo_app_label(app, x + (int)ceduo_utf8_width(a->word) + 1, app->height - 1, CEDUO_ROLE_DIM, "%s", help);
        x += n;
    }
}

void ceduo_app_draw(struct app *app)
{
    if (!app->canvas)
        return;
    ceduo_canvas_clear(app->canvas);
    if (app->width < APP_WIDTH_LEAST || app->height < APP_HEIGHT_LEAST) {
        struct ceduo_area all = {0, 0, app->width, app->height};
        char text[128];
        snprintf(text, sizeof text, _("ceduo needs a window of %d x %d; this one is %d x %d. Make it larger; q quits."),
                 APP_WIDTH_LEAST, APP_HEIGHT_LEAST, app->width, app->height);
        ceduo_app_text(app, all, CEDUO_ROLE_WARN, text, 0);
        return;
    }
    int side = app->width >= 140 ? 44 : app->width >= 100 ? 36 : 28;
    struct ceduo_area now = {app->width - side + 1, 2, side - 1, app->height - 5};
    struct ceduo_area body = {0, 2, app->width - side - 2, app->height - 5};
    draw_title(app);
    for (int y = now.top; y < now.top + now.height; y++)
        ceduo_canvas_label(app->canvas, now.left - 2, y, CEDUO_ROLE_AXIS, "\xe2\x94\x82");
    ceduo_now_draw(app, now);
    ceduo_views[app->view]->draw(app, body);
    draw_explanation(app);
    draw_bar(app);
    if (app->popup)
        ceduo_popup_draw(app);
}
