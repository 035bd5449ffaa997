/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Export of the page, the screen or the command to a file; copy of the view to the clipboard. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"
#include "popup.h"
#include "view/figures.h"
#include "view/page.h"
#include "view/svg.h"

/* Append the command that gives the same figures; `mode`: option of its output. */
static void append_command(struct app *app, struct text *text, const char *mode)
{
    struct document *d = &app->document;
    const struct ceduo_arrivals *shown = ceduo_app_arrivals(app);
    uint64_t rocks = shown ? ceduo_rocks_released(shown) : d->file.scene.simulation.rocks;
    ceduo_text_format(text, "ceduo %s -n %llu ", mode, (unsigned long long)rocks);
    ceduo_text_append_quoted(text, d->path ? d->path : "scene.yaml");
}

/* Drawn again as rocks fall. */
static void show_command(struct app *app, struct popup *p)
{
    const struct ceduo_arrivals *shown = ceduo_app_arrivals(app);
    append_command(app, &p->text, "--batch");
    ceduo_text_append_char(&p->text, '\n');
    if (shown)
        ceduo_text_format(&p->text,
                          app->live.busy ? _("\nThe figures on the screen are from %llu rocks; the simulation continues.\n")
                                         : _("\nThe figures on the screen are from %llu rocks.\n"),
                          (unsigned long long)ceduo_rocks_released(shown));
    else
        ceduo_text_append(&p->text, _("\nThere are no figures yet: -n is the number of rocks in the scene.\n"));
    if (ceduo_document_unsaved(&app->document))
        ceduo_text_append(&p->text, _("\nThere are unsaved changes: save them first (s).\n"));
}

/* True if the last level of uncertainty is computed. */
static bool is_uncertainty_done(const struct app *app)
{
    const struct uncertainty *known = ceduo_live_uncertainty(&app->live, &app->document.file);
    return known && known->last;
}

/* Append the report as HTML. Omit the uncertainty if it is not computed yet. */
static void append_html(struct app *app, struct ceduo_report *report, struct text *text)
{
    struct ceduo_uncertainty_report uncertainty;
    bool done = is_uncertainty_done(app) && report->result->wooded && !ceduo_page_is_unassessable(report->result) &&
                ceduo_app_uncertainty(app, &uncertainty);
    const struct ceduo_scene *scene = &app->document.file.scene;
    struct ceduo_html html = {.text = text};
    LOCAL_PAGE(page, CEDUO_PAGE_REPORT_WIDTH);
    LOCAL_TEXT(command);
    append_command(app, &command, "--report report.html");
    uncertainty.rotation_mean = false;
    report->uncertainty = done ? &uncertainty : NULL;
    report->command = command.bytes;
    ceduo_page_chapter(&page, report);
    ceduo_page_html_begin(&html, ceduo_in_language(scene->title, scene->title_it));
    ceduo_page_html(&html, &page, 1);
    ceduo_page_html_end(&html);
}

enum export_kind { EXPORT_PAGE, EXPORT_TABLE, EXPORT_SCREEN, EXPORT_CSV, EXPORT_JSON, EXPORT_REPORT, EXPORT_COMMAND, EXPORTS };

static const struct {
    const char *file, *label; /* file NULL: shown, not written */
} exports[EXPORTS] = {{"ceduo.txt", N_("the page, as text")},
                      {"ceduo-details.txt", N_("the whole page with all figures, as text")},
                      {"ceduo-screen.txt", N_("this screen, with its picture, as text")},
                      {"ceduo.csv", N_("CSV, a row for each option and control")},
                      {"ceduo.json", N_("JSON")},
                      {"ceduo.html", N_("a report, as HTML")},
                      {NULL, N_("the batch command for these figures")}};

static void append_export(struct app *app, enum export_kind kind, struct text *text)
{
    struct ceduo_report *report = ceduo_app_report(app);
    bool ascii = app->charset == CEDUO_CHARSET_ASCII;
    if (kind != EXPORT_PAGE) /* only the page shows uncertainty */
        report->uncertainty = NULL;
    if (kind == EXPORT_SCREEN) {
        ceduo_screen_draw(app); /* the popup is closed already */
        char *screen = ceduo_cells_dump(app->cells);
        ceduo_text_append(text, screen ? screen : "");
        free(screen);
    } else if (!app->live.result) {
        return;
    } else if (kind == EXPORT_PAGE || kind == EXPORT_TABLE) {
        ceduo_report_page(text, report, kind == EXPORT_TABLE, ascii);
    } else if (kind == EXPORT_CSV) {
        ceduo_csv_head(text, &ceduo_control_csv);
        ceduo_csv_rows(text, &ceduo_control_csv, &(struct ceduo_place){.report = report});
    } else if (kind == EXPORT_JSON) {
        ceduo_figures_json(text, ceduo_result_figures, &(struct ceduo_place){.report = report}, report->details);
    } else {
        append_html(app, report, text);
    }
}

static bool submit_export(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].line.text;
    enum export_kind kind = (enum export_kind)atoi(p->target);
    LOCAL_TEXT(text);
    if (kind == EXPORT_REPORT && !ceduo_file_is_html(path)) {
        ceduo_app_warn(app, _("'%s' does not end in .html or .htm"), path);
        return false;
    }
    if (!ceduo_popup_confirm_overwrite(app, p, false))
        return false;
    append_export(app, kind, &text);
    bool good = text.bytes && ceduo_file_write(path, text.bytes, text.length);
    if (!text.bytes)
        ceduo_app_warn(app, "%s", _("nothing is computed yet"));
    else if (!good)
        ceduo_app_warn(app, "%s: %s", path, ceduo_error_text(errno));
    else
        ceduo_app_show_message(app,
                               kind == EXPORT_REPORT && !is_uncertainty_done(app)
                                   ? _("written: %s; without uncertainty, which is not computed yet")
                                   : _("written: %s"),
                               path);
    return good;
}

/* Ask for the file of an export; `kind`: its number. */
static void ask_export_file(struct app *app, const char *kind)
{
    /* compute the uncertainty for the report while its file is named */
    app->live.busy |= ceduo_jobs_request(
        app->live.jobs, &(struct job_request){JOB_UNCERTAINTY, &app->document.file, app->option, .levels = UNCERTAINTY_LEVELS});
    struct popup *p = ceduo_popup_fields(app, _(exports[atoi(kind)].label), kind, submit_export);
    const char *file = exports[atoi(kind)].file;
    p->endings = strrchr(file, '.');
    p->keep_input = true;
    ceduo_popup_add_choice(p, _("file"), file, ceduo_popup_offer_files);
}

/* Store the typed text in the scene, as one edit. */
static bool submit_head(struct app *app, struct popup *p)
{
    const struct object *page = ceduo_schema_row("page")->object;
    LOCAL_TEXT(head);
    for (size_t i = 0; i < p->fields_count; i++)
        if (p->fields[i].line.text[0]) {
            ceduo_text_format(&head, "%s%s: ", head.length > 0 ? ", " : "{", page->fields[i].key);
            ceduo_emit_scalar(&head, p->fields[i].line.text, true);
        }
    if (head.length > 0) {
        ceduo_text_append_char(&head, '}');
        if (!ceduo_app_finish_edit(app, ceduo_document_set(&app->document, "page", head.bytes)))
            return false;
    }
    ask_export_file(app, p->target);
    return true;
}

static void select_export(struct app *app, struct popup *p)
{
    enum export_kind kind = (enum export_kind)atoi(p->value);
    if (kind == EXPORT_COMMAND) {
        ceduo_popup_text(app, _(exports[kind].label))->update_note = show_command;
        return;
    }
    if (kind != EXPORT_REPORT || ceduo_document_node(&app->document, "page")) {
        ask_export_file(app, p->value);
        return;
    }
    const struct object *page = ceduo_schema_row("page")->object;
    struct popup *head = ceduo_popup_fields(app, _("Head of the report"), p->value, submit_head);
    char today[32];
    time_t time_now = time(NULL);
    struct tm local;
    /* Translators: a date, as strftime() writes it. */
    strftime(today, sizeof today, _("%Y-%m-%d"), localtime_r(&time_now, &local));
    ceduo_text_append(&head->text, _("All lines are optional. They are stored in the scene, as 'page'."));
    for (size_t i = 0; i < page->n; i++)
        ceduo_popup_add_field(head, _(page->fields[i].shown.label), strcmp(page->fields[i].key, "date") == 0 ? today : "");
}

/* ---- the clipboard ---- */

#define COPY_WIDTH 78 /* columns of a letter */

void ceduo_popup_copy(struct app *app)
{
    const struct ceduo_result *r = app->live.result;
    const struct ceduo_scene *scene = &app->document.file.scene;
    LOCAL_TEXT(text);
    if (!app->copy) {
        ceduo_app_warn(app, "%s", _("this terminal gives programs no clipboard; w writes a file"));
        return;
    }
    if (ceduo_views[app->view]->result && !r) {
        ceduo_app_warn(app, "%s", _("nothing is computed yet"));
        return;
    }
    ceduo_text_append_escaped(&text, ceduo_in_language(scene->title, scene->title_it));
    ceduo_text_format(&text, ": %s\n", ceduo_app_option(app)->name);
    if (r && scene->controls_count > 0) {
        const struct ceduo_subject subject = ceduo_subject_find(ceduo_app_report(app), app->option, r->last_control);
        ceduo_words_answer(&text, &subject, COPY_WIDTH);
        ceduo_text_append_char(&text, '\n');
    }
    /* draw the view with all its lines but without pictures; collapse blank lines */
    struct view_state *state = ceduo_app_state(app), saved_state = *state;
    struct ceduo_cells *screen = app->cells;
    app->cells = ceduo_check_memory(ceduo_cells_create(COPY_WIDTH, CEDUO_CANVAS_MAX_HEIGHT, app->charset));
    app->cells->canvas.text_only = true;
    state->pane = 0;
    ceduo_views[app->view]->draw(app, (struct ceduo_area){0, 0, COPY_WIDTH, CEDUO_CANVAS_MAX_HEIGHT});
    char *drawn = ceduo_cells_dump(app->cells);
    size_t lines = 0;
    bool gap = true;
    for (char *line = drawn, *end; (end = strchr(line, '\n')); line = end + 1) {
        bool blank = line + strspn(line, " ") == end;
        if (!blank)
            ceduo_text_format(&text, "%s%.*s\n", gap ? "\n" : "", (int)(end - line), line);
        lines += !blank;
        gap = blank;
    }
    free(drawn);
    ceduo_cells_free(app->cells);
    app->cells = screen;
    *state = saved_state;
    if (app->copy(text.bytes))
        ceduo_app_show_message(app, ngettext("copied: %zu line", "copied: %zu lines", lines), lines);
    else
        ceduo_app_warn(app, "%s", _("the text is too long for the clipboard; w writes it to a file"));
}

void ceduo_popup_export(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Export"), "", select_export);
    for (int i = 0; i < EXPORTS; i++)
        ceduo_popup_add_item(p, _(exports[i].label), ceduo_app_format(app, "%d", i));
}
