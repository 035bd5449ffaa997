/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "app.h"
#include "scene/derived.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "view/value_text.h"

/* ---- strings ---- */

char *ceduo_app_format(const struct app *app, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *string = ceduo_arena_vformat(app->scratch, format, args);
    va_end(args);
    return string;
}

const char *ceduo_app_path(const struct app *app, const char *path)
{
    LOCAL_TEXT(words);
    ceduo_format_path(path, &words);
    return ceduo_arena_string(app->scratch, ceduo_text_string(&words));
}

const char *ceduo_app_scalar(const struct app *app, const char *text)
{
    LOCAL_TEXT(yaml);
    ceduo_emit_scalar(&yaml, text, true);
    return ceduo_arena_string(app->scratch, yaml.bytes);
}

void ceduo_app_show_problem(struct app *app, bool bad, const char *format, ...)
{
    LOCAL_TEXT(safe);
    va_list args;
    va_start(args, format);
    ceduo_text_append_escaped(&safe, ceduo_arena_vformat(app->scratch, format, args));
    va_end(args);
    snprintf(app->message, sizeof app->message, "%s", ceduo_text_string(&safe));
    app->message_is_warning = bad;
}

/* Return the field of a path, which may begin at a stand or at the slope; NULL if there is none. */
static const struct field *find_field(struct app *app, const char *path, const char *key, size_t n)
{
    static const char *const roots[] = {"", "forest[0].stand.", "slope."};
    const struct field *f = NULL;
    for (size_t i = 0; !f && i < sizeof roots / sizeof roots[0]; i++)
        f = ceduo_schema_row(
            ceduo_app_format(app, "%s%s%s%.*s", roots[i], path, path[0] && n > 0 ? "." : "", (int)n, n > 0 ? key : ""));
    return f && f->shown.label ? f : NULL;
}

/* Show the first of a list of problems. Keys have the names of the form. `in_file`: name its place in a file that was not
 * opened; otherwise the cursor shows the place. */
static void show_first_problem(struct app *app, const struct problem_list *list, bool in_file)
{
    const struct problem *p = list->items;
    LOCAL_TEXT(text);
    if (list->n == 0)
        return;
    if (in_file)
        ceduo_text_format(&text, "%s ", _("nothing was opened:"));
    if (in_file && p->place[0])
        ceduo_text_format(&text, "%s: ", p->place);
    const char *words = ceduo_app_path(app, p->path), *from = p->message, *end;
    const struct field *place = strcmp(words, p->path) == 0 ? find_field(app, p->path, NULL, 0) : NULL;
    ceduo_text_format(&text, "%s%s", place ? _(place->shown.label) : words, p->path[0] ? ": " : "");
    for (const char *quote; (quote = strchr(from, '\'')) && (end = strchr(quote + 1, '\''));) {
        const struct field *f = find_field(app, p->path, quote + 1, (size_t)(end - quote - 1));
        ceduo_text_append_n(&text, from, (size_t)((f ? quote + 1 : end) - from)); /* `end` may begin another quote */
        ceduo_text_append(&text, f ? _(f->shown.label) : "");
        ceduo_text_append(&text, f ? "'" : "");
        from = f ? end + 1 : end;
    }
    ceduo_text_append(&text, from);
    ceduo_app_warn(app, "%s", ceduo_text_string(&text));
}

/* ---- what is shown ---- */

struct view_state *ceduo_app_state(struct app *app)
{
    return &app->views[app->view];
}

void *ceduo_app_private_state(const struct app *app)
{
    return app->views[app->view].private_state;
}

struct form *ceduo_app_form(struct app *app)
{
    return &ceduo_app_state(app)->form;
}

const struct ceduo_option *ceduo_app_option(const struct app *app)
{
    return &app->document.file.scene.options[app->option];
}

const struct ceduo_belt *ceduo_app_belt(const struct app *app)
{
    const struct ceduo_option *o = ceduo_app_option(app);
    return app->belt < o->belts_count ? &o->belts[app->belt] : NULL;
}

const struct ceduo_arrivals *ceduo_app_arrivals(const struct app *app)
{
    const struct ceduo_result *r = app->live.result;
    const struct ceduo_arrivals *forested = r ? ceduo_result_wooded(r, app->option, r->last_control) : NULL;
    return forested || !r ? forested : &r->bare.arrivals[r->last_control];
}

const char *ceduo_app_forest(const struct app *app)
{
    bool options = ceduo_node_get(app->document.file.root, "options");
    return options ? ceduo_app_format(app, "options[%zu].forest", app->option) : "forest";
}

const char *ceduo_app_stand(const struct app *app)
{
    return ceduo_app_format(app, "%s[%zu].stand", ceduo_app_forest(app), app->belt);
}

/* Return the years of each option; an element is NULL until they are known. */
static struct ceduo_years **find_years(const struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    struct ceduo_years **years = ceduo_check_memory(ceduo_arena_alloc(app->scratch, scene->options_count * sizeof *years));
    for (size_t i = 0; i < scene->options_count; i++)
        years[i] = ceduo_live_years(&app->live, scene, i);
    return years;
}

struct ceduo_picture ceduo_app_picture(const struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    size_t stems = ceduo_rock_trajectory_stems(&app->trajectory);
    return (struct ceduo_picture){.scene = scene,
                                  .snapshot = ceduo_live_snapshot(&app->live, scene),
                                  .option = app->option,
                                  .belt = app->belt,
                                  .control = ceduo_scene_last_control(scene),
                                  .selected = app->trajectory.line.n > 0 ? &app->trajectory.line : NULL,
                                  .stems = stems > 0 ? app->trajectory.stems : NULL,
                                  .stems_count = stems,
                                  .years = ceduo_live_years(&app->live, scene, app->option),
                                  .years_of_options = find_years(app),
                                  .verdict = app->live.verdict.n > 0 ? &app->live.verdict : NULL,
                                  .year = app->year};
}

bool ceduo_app_uncertainty(const struct app *app, struct ceduo_uncertainty_report *report)
{
    const struct uncertainty *d = ceduo_live_uncertainty(&app->live, &app->document.file);
    struct uncertainty *own = (struct uncertainty *)(uintptr_t)d; /* the report only reads the scene */
    if (!d)
        return false;
    *report = (struct ceduo_uncertainty_report){.file = &own->file,
                                                .inputs = &own->inputs,
                                                .answer = own->inputs.n > 0 ? &own->answer : NULL,
                                                .points = own->answer.points,
                                                .rocks = own->answer.rocks,
                                                .finer = app->live.result,
                                                .years = &app->live.verdict,
                                                .rotation_mean = app->rotation_mean && app->view == VIEW_UNCERTAINTY &&
                                                                 own->answer.rotation};
    return true;
}

struct ceduo_report *ceduo_app_report(const struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    struct ceduo_report *report = ceduo_check_memory(ceduo_arena_alloc(app->scratch, sizeof *report));
    struct ceduo_uncertainty_report *uncertainty = ceduo_check_memory(ceduo_arena_alloc(app->scratch, sizeof *uncertainty));
    *report = (struct ceduo_report){.file = &app->document.file,
                                    .result = app->live.result,
                                    .verdict = app->live.verdict.n > 0 ? &app->live.verdict : NULL,
                                    .uncertainty = ceduo_app_uncertainty(app, uncertainty) ? uncertainty : NULL,
                                    .years_ahead = find_years(app),
                                    .snapshot = ceduo_live_snapshot(&app->live, scene),
                                    .remarks = {.ground_assumed = app->document.file.ground_assumed},
                                    .seconds = app->live.results.snapshot ? app->live.results.snapshot->seconds : 0,
                                    .busy = app->live.busy};
    return report;
}

struct ceduo_pane ceduo_app_pane(const struct app *app, int height)
{
    const struct ceduo_years *shown = ceduo_live_years(&app->live, &app->document.file.scene, app->option);
    bool in_year = app->view == VIEW_ROTATION && shown && app->year < shown->count;
    return (struct ceduo_pane){.report = ceduo_app_report(app),
                               .year = in_year ? &shown->years[app->year] : NULL,
                               .option = app->option,
                               .height = height};
}

void ceduo_app_refresh(struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct view *view = ceduo_views[app->view];
    if (app->option >= scene->options_count)
        app->option = scene->options_count - 1;
    size_t belts = ceduo_app_option(app)->belts_count;
    if (app->belt >= belts)
        app->belt = belts > 0 ? belts - 1 : 0;
    app->uncertainty_on |= view->uncertainty;
    ceduo_live_update(&app->live, &app->document.file, app->option, app->uncertainty_on ? UNCERTAINTY_LEVELS : 0,
                      view->observed && app->document.file.observations_count > 0 ? COMPARISON_LEVELS : 0);
    for (int v = 0; v < VIEW_COUNT; v++)
        ceduo_form_clear(&app->views[v].form, &app->document);
    if (view->build) {
        view->build(app, ceduo_app_form(app));
        ceduo_form_clamp(ceduo_app_form(app));
    }
}

void ceduo_app_show(struct app *app, enum view_number view)
{
    app->view = view;
    ceduo_app_state(app)->pane = 0;
    ceduo_app_state(app)->text.first = 0;
    ceduo_app_refresh(app);
}

void ceduo_app_show_option(struct app *app, size_t option)
{
    app->option = option;
    app->belt = 0;
    ceduo_app_refresh(app);
}

void ceduo_app_show_belt(struct app *app, size_t belt)
{
    if (belt == app->belt)
        return;
    app->belt = belt;
    ceduo_app_refresh(app);
}

void ceduo_app_sync_belt(struct app *app)
{
    struct form_row *row = ceduo_form_row(ceduo_app_form(app));
    if (row && row->n > 0 && strcmp(row->list, ceduo_app_forest(app)) == 0)
        ceduo_app_show_belt(app, row->index);
}

/* ---- edits ---- */

bool ceduo_app_finish_edit(struct app *app, bool good)
{
    if (!good)
        show_first_problem(app, &app->document.problems.wrong, false);
    else
        ceduo_app_refresh(app);
    return good;
}

bool ceduo_app_set(struct app *app, const char *path, const char *value)
{
    LOCAL_TEXT(notes);
    bool good = ceduo_app_finish_edit(app, ceduo_document_set_and_follow(&app->document, path, value, &notes));
    if (good && notes.length > 0)
        ceduo_app_show_message(app, "%s", notes.bytes);
    return good;
}

void ceduo_app_set_search(struct app *app, const char *text)
{
    snprintf(app->search, sizeof app->search, "%.*s", (int)sizeof app->search - 1, text);
}

/* ---- opening and closing ---- */

/* Replace the document. The figures use its memory, so they are freed first. Report an unusual value. False: no thread. */
static bool replace_document(struct app *app, struct document *next, unsigned threads)
{
    struct live live;
    if (!ceduo_live_create(&live, threads)) {
        ceduo_document_close(next);
        return false;
    }
    ceduo_live_free(&app->live);
    ceduo_recovery_delete(&app->document.recovery);
    ceduo_document_close(&app->document);
    app->live = live;
    app->document = *next;
    ceduo_cells_free(app->last_screen.cells);
    app->last_screen.cells = NULL;
    if (app->no_recovery) {
        ceduo_recovery_delete(&app->document.recovery);
        ceduo_recovery_end(&app->document.recovery);
    }
    app->option = app->belt = app->year = 0;
    app->rock = 0;
    app->just_opened = true;
    for (int v = 0; v < VIEW_COUNT; v++) {
        struct view_state *state = &app->views[v];
        state->form.row = state->form.column = 0;
        state->form.lines.first = 0;
        free(state->private_state);
        state->private_state = ceduo_check_memory(calloc(1, ceduo_views[v]->private_size + 1));
    }
    ceduo_app_show(app, app->view);
    show_first_problem(app, &app->document.problems.unusual, false);
    return true;
}

bool ceduo_app_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery)
{
    struct document document;
    *app = (struct app){.charset = charset, .no_recovery = no_recovery, .uncertainty_on = !no_recovery};
    app->scratch = ceduo_check_memory(calloc(1, sizeof *app->scratch));
    if (!ceduo_document_open(&document, path ? path : "paper-site", NULL, 0)) {
        app->document = document;
        return false;
    }
    app->document.problems.memory = !replace_document(app, &document, threads);
    return !app->document.problems.memory;
}

void ceduo_app_free(struct app *app)
{
    ceduo_popup_close(app);
    ceduo_live_free(&app->live);
    for (int v = 0; v < VIEW_COUNT; v++) {
        free(app->views[v].form.rows);
        ceduo_arena_free(&app->views[v].form.arena);
        free(app->views[v].private_state);
    }
    ceduo_rock_trajectory_free(&app->trajectory);
    ceduo_cells_free(app->cells);
    ceduo_cells_free(app->last_screen.cells);
    ceduo_document_close(&app->document);
    ceduo_arena_free(app->scratch);
    free(app->scratch);
    *app = (struct app){0};
}

bool ceduo_app_open(struct app *app, const char *path, const char *text)
{
    struct document next;
    bool good = path ? ceduo_document_open(&next, path, NULL, 0) : ceduo_document_new(&next, text);
    if (!good) {
        show_first_problem(app, &next.problems.wrong, path != NULL);
        ceduo_document_close(&next);
    } else if (!replace_document(app, &next, app->live.threads)) {
        ceduo_app_warn(app, "%s", _("out of memory"));
        good = false;
    }
    return good;
}

void ceduo_app_resize(struct app *app, int width, int height)
{
    width = width < 1 ? 1 : width > CEDUO_CANVAS_MAX_WIDTH ? CEDUO_CANVAS_MAX_WIDTH : width;
    height = height < 1 ? 1 : height > CEDUO_CANVAS_MAX_HEIGHT ? CEDUO_CANVAS_MAX_HEIGHT : height;
    struct ceduo_cells *cells = ceduo_check_memory(ceduo_cells_create(width, height, app->charset));
    ceduo_cells_free(app->cells);
    ceduo_cells_free(app->last_screen.cells);
    app->last_screen.cells = NULL;
    app->cells = cells;
    app->width = width;
    app->height = app->tour.step ? height - TOUR_LINES : height;
    app->drawn = false;
}

/* ---- drawing ---- */

void ceduo_app_add_hit(struct app *app, struct hit hit)
{
    if (app->hits_count < HITS_MAX)
        app->hits[app->hits_count++] = hit;
}

const char *ceduo_app_position(const struct app *app, const struct viewport *lines, int line)
{
    bool above = lines->first > 0, below = viewport_has_more(lines);
    return above || below ? ceduo_app_format(app, "%d/%d %s%s", line + 1, lines->count, above ? "\xe2\x96\xb2" : "",
                                             below ? "\xe2\x96\xbc" : "")
                          : "";
}

void ceduo_app_draw_plot(struct app *app, enum ceduo_plot plot, struct ceduo_area area, const struct ceduo_picture *picture)
{
    if (app->pictures_count < PICTURES_MAX)
        app->pictures[app->pictures_count++] = area;
    ceduo_plot_draw(plot, &app->cells->canvas, &area, picture);
}

void ceduo_app_draw_label(struct app *app, int x, int y, enum ceduo_role role, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_cells_label(app->cells, x, y, role, ceduo_arena_vformat(app->scratch, format, args));
    va_end(args);
}

/* Return the length of the first line of a text. Set *next to the second line. */
static size_t wrap_line(const char *text, int columns, const char **next)
{
    size_t width = columns > 0 ? (size_t)columns : 0;
    bool continues = ceduo_utf8_char_width(text, strcspn(text, "\n")) > width; /* keep the last column free */
    return ceduo_utf8_wrap(text, continues && width > 0 ? width - 1 : width, next);
}

int ceduo_app_find_line(const char *text, int width, const char *place)
{
    int line = 0;
    for (const char *next; *text; text = next, line++) {
        wrap_line(text, width, &next);
        if (next > place)
            break;
    }
    return line;
}

int ceduo_app_draw_wrapped(struct app *app, struct ceduo_area area, enum ceduo_role role, const char *text, int skip)
{
    int lines = 0;
    for (const char *next; *text; text = next, lines++) {
        size_t n = wrap_line(text, area.width, &next);
        if (lines >= skip && lines - skip < area.height)
            ceduo_app_draw_label(app, area.left, area.top + lines - skip, role, "%.*s", (int)n, text);
    }
    return lines;
}

int ceduo_app_count_lines(struct app *app, const char *text, int width)
{
    return ceduo_app_draw_wrapped(app, (struct ceduo_area){.width = width}, CEDUO_ROLE_TEXT, text, 0);
}

void ceduo_app_shorten(struct app *app, struct text *text, int width, int lines)
{
    bool fits = text->length == 0 || ceduo_app_count_lines(app, text->bytes, width) <= lines;
    if (fits)
        return;
    for (size_t end = text->length; !fits; end = text->length) {
        ceduo_text_append(text, " ..."); /* as wide as the sign in ASCII */
        fits = ceduo_app_count_lines(app, text->bytes, width) <= lines;
        while (!fits && end > 0 && text->bytes[end - 1] != ' ' && text->bytes[end - 1] != '\n') /* drop the last word, */
            end--;
        if (!fits && end == 0)
            return;
        ceduo_text_cut(text, end - !fits); /* and the blank before it */
    }
    ceduo_text_append(text, " \xe2\x80\xa6");
}

void ceduo_app_draw_text(struct app *app, struct ceduo_area area, enum ceduo_role role, struct text *text)
{
    ceduo_app_shorten(app, text, area.width, area.height);
    if (text->bytes)
        ceduo_app_draw_wrapped(app, area, role, text->bytes, 0);
    ceduo_text_free(text);
}

void ceduo_app_scroll_text(struct app *app, int step)
{
    viewport_scroll(&ceduo_app_state(app)->text, step);
}

void ceduo_app_draw_page(struct app *app, struct ceduo_area area, struct ceduo_page *page)
{
    struct ceduo_canvas *canvas = &app->cells->canvas;
    struct viewport *v = &ceduo_app_state(app)->text;
    viewport_fit(v, area.height, ceduo_page_draw(page, canvas, (struct ceduo_area){0}, 0));
    ceduo_page_draw(page, canvas, area, v->first);
    ceduo_canvas_label_right(canvas, area.left + area.width + 1, area.top + area.height, CEDUO_ROLE_TITLE,
                             ceduo_app_position(app, v, v->first + v->rows - 1));
    ceduo_app_add_hit(app, (struct hit){.area = area, .wheel = ceduo_app_scroll_text});
    ceduo_page_free(page);
}
