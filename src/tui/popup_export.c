/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page, the screen or the command to a file; what the view says to the clipboard. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/language.h"
#include "base/must.h"
#include "io/file.h"
#include "popup.h"
#include "view/figures.h"
#include "view/page.h"
#include "view/svg.h"

/* The command that gives the same figures; `how`: as what. */
static void append_command(struct app *app, struct text *text, const char *how)
{
    struct document *d = &app->document;
    const struct ceduo_arrivals *shown = ceduo_app_shown(app);
    uint64_t rocks = shown ? ceduo_released(shown) : d->file.scene.simulation.rocks;
    ceduo_text_format(text, "ceduo %s -n %llu ", how, (unsigned long long)rocks);
    ceduo_text_quoted(text, d->path ? d->path : "scene.yaml");
}

/* More rocks may fall while it is read. */
static void show_command(struct app *app, struct popup *p)
{
    const struct ceduo_arrivals *shown = ceduo_app_shown(app);
    append_command(app, &p->text, "--batch");
    ceduo_text_char(&p->text, '\n');
    if (shown)
        ceduo_text_format(&p->text,
                          app->live.busy ? _("\nThe figures on the screen are of %llu rocks; more are falling.\n")
                                         : _("\nThe figures on the screen are of %llu rocks.\n"),
                          (unsigned long long)ceduo_released(shown));
    else
        ceduo_text_append(&p->text, _("\nThere are no figures yet: -n is what the scene says.\n"));
    if (ceduo_document_unsaved(&app->document))
        ceduo_text_append(&p->text, _("\nThere is unsaved work: s saves it first.\n"));
}

/* Whether all that will be known of uncertainty is. */
static bool is_sure(const struct app *app)
{
    const struct uncertainty *known = ceduo_live_uncertainty(&app->live, &app->document.file);
    return known && known->last;
}

/* Of the figures as they are, and without uncertainty where that is not known yet: nobody waits while a screen is to be used. */
static void put_html(struct app *app, struct ceduo_report *report, struct text *text)
{
    struct ceduo_uncertainty_report uncertainty;
    bool sure = is_sure(app) && report->result->wooded && !ceduo_page_is_unassessable(report->result) &&
                ceduo_app_uncertainty(app, &uncertainty);
    const struct ceduo_scene *scene = &app->document.file.scene;
    struct ceduo_html html = {.text = text};
    LOCAL_PAGE(page, CEDUO_PAGE_REPORT_WIDTH);
    LOCAL_TEXT(command);
    append_command(app, &command, "--report report.html");
    uncertainty.over = false;
    report->uncertainty = sure ? &uncertainty : NULL;
    report->command = command.bytes;
    ceduo_page_chapter(&page, report);
    ceduo_page_html_begin(&html, ceduo_in_language(scene->title, scene->title_it));
    ceduo_page_html(&html, &page, 1);
    ceduo_page_html_end(&html);
}

enum export { EXPORT_PAGE, EXPORT_TABLE, EXPORT_SCREEN, EXPORT_CSV, EXPORT_JSON, EXPORT_REPORT, EXPORT_COMMAND, EXPORTS };

static const struct {
    const char *file, *what; /* file NULL: it is shown, not written */
} exports[EXPORTS] = {{"ceduo.txt", N_("the page, as text")},
                      {"ceduo-details.txt", N_("the whole page with all figures, as text")},
                      {"ceduo-screen.txt", N_("this screen, with its picture, as text")},
                      {"ceduo.csv", N_("CSV, a row for each option and control")},
                      {"ceduo.json", N_("JSON")},
                      {"ceduo.html", N_("a page to hand in, as HTML")},
                      {NULL, N_("the batch command that gives the same")}};

static void append_export(struct app *app, enum export export, struct text *text)
{
    struct ceduo_report *report = ceduo_app_report(app);
    bool ascii = app->charset == CEDUO_CHARSET_ASCII;
    if (export != EXPORT_PAGE) /* how sure it is, if that is known already, is part of the page alone */
        report->uncertainty = NULL;
    if (export == EXPORT_SCREEN) {
        ceduo_screen_draw(app); /* without the popup, which is off already */
        char *screen = ceduo_cells_dump(app->cells);
        ceduo_text_append(text, screen ? screen : "");
        free(screen);
    } else if (!app->live.result) {
        return;
    } else if (export == EXPORT_PAGE || export == EXPORT_TABLE) {
        ceduo_report_page(text, report, export == EXPORT_TABLE, ascii);
    } else if (export == EXPORT_CSV) {
        ceduo_csv_head(text, &ceduo_control_csv);
        ceduo_csv_rows(text, &ceduo_control_csv, &(struct ceduo_place){.report = report});
    } else if (export == EXPORT_JSON) {
        ceduo_figures_json(text, ceduo_result_figures, &(struct ceduo_place){.report = report}, report->details);
    } else {
        put_html(app, report, text);
    }
}

static bool filled_export(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].line.text;
    enum export export = (enum export)atoi(p->path);
    LOCAL_TEXT(text);
    if (!ceduo_popup_may_write(app, p))
        return false;
    append_export(app, export, &text);
    bool good = text.bytes && ceduo_file_write(path, text.bytes, text.length);
    if (!text.bytes)
        ceduo_app_warn(app, "%s", _("nothing is computed yet"));
    else if (!good)
        ceduo_app_warn(app, "%s: %s", path, strerror(errno));
    else
        ceduo_app_show_message(app,
                               export == EXPORT_REPORT && !is_sure(app)
                                   ? _("written: %s; how sure it is was not known yet: write it again in a moment")
                                   : _("written: %s"),
                               path);
    return good;
}

/* `export`: its number. */
static void ask_for_file(struct app *app, const char *export)
{
    /* the report says how sure it is: that is computed while its file is named; a head is an edit */
    app->live.busy |= ceduo_jobs_ask(
        app->live.jobs, &(struct job_request){JOB_UNCERTAINTY, &app->document.file, app->option, .levels = UNCERTAINTY_LEVELS});
    struct popup *p = ceduo_popup_fields(app, _(exports[atoi(export)].what), export, filled_export);
    const char *file = exports[atoi(export)].file;
    p->endings = strrchr(file, '.');
    p->typed_wins = true;
    ceduo_popup_choice(p, _("file"), file, ceduo_popup_offer_files);
}

/* What was typed is the scene's from then on, as one edit. */
static bool filled_head(struct app *app, struct popup *p)
{
    const struct object *page = ceduo_schema_row("page")->object;
    LOCAL_TEXT(head);
    for (size_t i = 0; i < p->fields_count; i++)
        if (p->fields[i].line.text[0]) {
            ceduo_text_format(&head, "%s%s: ", head.length > 0 ? ", " : "{", page->fields[i].key);
            ceduo_emit_scalar(&head, p->fields[i].line.text, true);
        }
    if (head.length > 0) {
        ceduo_text_char(&head, '}');
        if (!ceduo_app_edited(app, ceduo_document_set(&app->document, "page", head.bytes)))
            return false;
    }
    ask_for_file(app, p->path);
    return true;
}

static void chose_export(struct app *app, struct popup *p)
{
    enum export export = (enum export)atoi(p->value);
    if (export == EXPORT_COMMAND) {
        ceduo_popup_text(app, _(exports[export].what))->preview = show_command;
        return;
    }
    if (export != EXPORT_REPORT || ceduo_document_node(&app->document, "page")) {
        ask_for_file(app, p->value);
        return;
    }
    const struct object *page = ceduo_schema_row("page")->object;
    struct popup *head = ceduo_popup_fields(app, _("Head of the report"), p->value, filled_head);
    char today[32];
    time_t now = time(NULL);
    struct tm local;
    /* Translators: a date, as strftime() writes it. */
    strftime(today, sizeof today, _("%Y-%m-%d"), localtime_r(&now, &local));
    ceduo_text_append(&head->text, _("Each line may stay empty. What is written here is kept in the scene, as 'page'."));
    for (size_t i = 0; i < page->n; i++)
        ceduo_popup_field(head, _(page->fields[i].shown.label), strcmp(page->fields[i].key, "date") == 0 ? today : "");
}

/* ---- the clipboard ---- */

#define COPY_WIDTH 78 /* of a letter */

void ceduo_popup_copy(struct app *app)
{
    const struct ceduo_result *r = app->live.result;
    const struct ceduo_scene *scene = &app->document.file.scene;
    LOCAL_TEXT(text);
    if (!app->copy) {
        ceduo_app_warn(app, "%s", _("this terminal has no clipboard that a program may write; w writes to a file"));
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
        ceduo_text_char(&text, '\n');
    }
    /* the view drawn by itself, long enough for all of it, its pictures left blank; runs of blank lines are one */
    struct view_state *state = ceduo_app_state(app), kept = *state;
    struct ceduo_cells *screen = app->cells;
    app->cells = ceduo_check_memory(ceduo_cells_create(COPY_WIDTH, CEDUO_CANVAS_MAX_HEIGHT, app->charset));
    app->cells->canvas.words_alone = true;
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
    *state = kept;
    if (app->copy(text.bytes))
        ceduo_app_show_message(
            app, ngettext("copied: %zu line of what this view says", "copied: %zu lines of what this view says", lines), lines);
    else
        ceduo_app_warn(app, "%s", _("this view says too much for a clipboard; w writes it to a file"));
}

void ceduo_popup_export(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Export"), "", chose_export);
    for (int i = 0; i < EXPORTS; i++)
        ceduo_popup_item(p, _(exports[i].what), ceduo_app_format(app, "%d", i));
}
