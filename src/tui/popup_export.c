/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page, the screen or the command to a file; what the view says to the clipboard. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/language.h"
#include "base/must.h"
#include "io/emit.h"
#include "io/file.h"
#include "popup.h"
#include "popups.h"
#include "screen.h"
#include "view/figures.h"
#include "view/html.h"
#include "view/page.h"
#include "view/svg.h"

/* The command that gives the same figures; `how`: as what. */
static void append_command(struct app *app, struct text *text, const char *how)
{
    struct document *d = &app->document;
    const struct ceduo_arrivals *shown = ceduo_app_shown(app);
    uint64_t rocks = shown ? shown->released : d->file.scene.simulation.rocks;
    ceduo_text_format(text, "ceduo %s -n %llu ", how, (unsigned long long)rocks);
    ceduo_text_quoted(text, d->path ? d->path : "scene.yaml");
}

/* More rocks may fall while it is read. */
static void show_command(struct app *app, struct popup *p, const char *value)
{
    const struct ceduo_arrivals *shown = ceduo_app_shown(app);
    (void)value;
    ceduo_text_free(&p->text);
    append_command(app, &p->text, "--batch");
    ceduo_text_char(&p->text, '\n');
    if (shown)
        ceduo_text_format(&p->text,
                          app->live.busy ? _("\nThe figures on the screen are of %llu rocks; more are falling.\n")
                                         : _("\nThe figures on the screen are of %llu rocks.\n"),
                          (unsigned long long)shown->released);
    else
        ceduo_text_put(&p->text, _("\nThere are no figures yet: -n is what the scene says.\n"));
    if (ceduo_document_unsaved(&app->document))
        ceduo_text_put(&p->text, _("\nThere is unsaved work: s saves it first.\n"));
}

/* How sure it is, where that is known already, is part of the page. */
static void put_page(struct app *app, struct text *text)
{
    struct ceduo_report report = ceduo_app_report(app);
    struct ceduo_doubt_report doubt;
    if (ceduo_app_doubt(app, &doubt))
        report.doubt = &doubt;
    ceduo_report_short(text, &report, app->charset == CEDUO_CHARSET_ASCII);
}

static void put_table(struct app *app, struct text *text)
{
    struct ceduo_report report = ceduo_app_report(app);
    ceduo_report_table(text, &report, app->charset == CEDUO_CHARSET_ASCII);
}

static void put_csv(struct app *app, struct text *text)
{
    struct ceduo_report report = ceduo_app_report(app);
    ceduo_csv_head(text, &ceduo_control_csv);
    ceduo_csv_rows(text, &ceduo_control_csv, &(struct ceduo_place){.report = &report});
}

static void put_json(struct app *app, struct text *text)
{
    struct ceduo_report report = ceduo_app_report(app);
    ceduo_figures_json(text, ceduo_result_figures, &(struct ceduo_place){.report = &report}, report.details);
}

/* Whether all that will be known of doubt is. */
static bool is_sure(const struct app *app)
{
    const struct uncertainty *known = ceduo_live_uncertainty(&app->live, &app->document.file);
    return known && known->last;
}

/* Of the figures as they are, and without doubt where that is not known yet: nobody waits while a screen is to be used. */
static void put_report(struct app *app, struct text *text)
{
    struct ceduo_doubt_report doubt;
    bool sure =
        is_sure(app) && app->live.result->wooded && !ceduo_page_says_nothing(app->live.result) && ceduo_app_doubt(app, &doubt);
    const struct ceduo_scene *scene = &app->document.file.scene;
    struct ceduo_years **years = ceduo_arena_take(app->scratch, scene->options_count * sizeof *years);
    struct ceduo_report report = ceduo_app_report(app);
    struct ceduo_html html = {.text = text};
    struct ceduo_page page = {.width = CEDUO_PAGE_REPORT_WIDTH};
    struct text command = {0};
    for (size_t i = 0; i < scene->options_count; i++)
        years[i] = ceduo_live_years(&app->live, scene, i);
    append_command(app, &command, "--report report.html");
    const struct ceduo_chapter chapter = {.report = &report,
                                          .snapshot = ceduo_live_snapshot(&app->live, scene),
                                          .years = years,
                                          .doubt = sure ? &doubt : NULL,
                                          .command = ceduo_app_kept(app, &command)};
    doubt.over = false;
    ceduo_page_chapter(&page, &chapter);
    ceduo_page_html_begin(&html, ceduo_in_language(scene->title, scene->title_it));
    ceduo_page_html(&html, &page, 1);
    ceduo_page_html_end(&html);
    ceduo_page_free(&page);
}

static void put_drawing(struct app *app, struct text *text)
{
    ceduo_screen_draw(app);
    ceduo_svg_screen(text, app->cells, app->document.file.scene.title);
}

static void put_screen(struct app *app, struct text *text)
{
    ceduo_screen_draw(app); /* without the popup, which is off already */
    char *screen = ceduo_cells_dump(app->cells);
    ceduo_text_put(text, screen ? screen : "");
    free(screen);
}

static const struct {
    const char *name, *file, *what;
    void (*put)(struct app *app, struct text *text); /* NULL: it is shown, not written */
} exports[] = {{"page", "ceduo.txt", N_("the page, as text"), put_page},
               {"table", "ceduo-details.txt", N_("the whole page with all figures, as text"), put_table},
               {"picture", "ceduo-screen.txt", N_("this screen, with its picture, as text"), put_screen},
               {"csv", "ceduo.csv", N_("CSV, a row for each option and control"), put_csv},
               {"json", "ceduo.json", N_("JSON"), put_json},
               {"report", "ceduo.html", N_("a page to hand in, as HTML"), put_report},
               {"drawing", "ceduo-screen.svg", N_("this screen as a drawing, SVG"), put_drawing},
               {"command", "", N_("the batch command that gives the same"), NULL}};
#define EXPORTS (sizeof exports / sizeof exports[0])

static size_t export_of(const char *name)
{
    size_t i = 0;
    while (i + 1 < EXPORTS && strcmp(exports[i].name, name) != 0)
        i++;
    return i;
}

static bool filled_export(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].text;
    struct text text = {0};
    bool good = false;
    if (!ceduo_popup_may_write(app, p))
        return false;
    size_t i = export_of(p->path);
    if (app->live.result || exports[i].put == put_screen || exports[i].put == put_drawing)
        exports[i].put(app, &text);
    if (!text.bytes) {
        ceduo_app_warn(app, "%s", _("nothing is computed yet"));
    } else if (!ceduo_file_write(path, text.bytes, text.length)) {
        ceduo_app_warn(app, "%s: %s", path, strerror(errno));
    } else {
        ceduo_app_say(app,
                      exports[i].put == put_report && !is_sure(app)
                          ? _("written: %s; how sure it is was not known yet: write it again in a moment")
                          : _("written: %s"),
                      path);
        good = true;
    }
    ceduo_text_free(&text);
    return good;
}

static void ask_for_file(struct app *app, size_t i)
{
    /* the report says how sure it is, over the rotation as well: that is computed while its file is named; a head is an edit */
    ceduo_live_doubt(&app->live, &app->document.file, app->option, UNCERTAINTY_ROTATION);
    struct popup *q = ceduo_popup_fields(app, _("Export to a file"), filled_export);
    snprintf(q->path, sizeof q->path, "%s", exports[i].name);
    q->endings = strrchr(exports[i].file, '.');
    q->typed_wins = true;
    ceduo_popup_choice(q, _("file"), exports[i].file, ceduo_popup_offer_files);
}

/* What was typed is the scene's from then on, as one edit. */
static bool filled_head(struct app *app, struct popup *p)
{
    const struct object *page = ceduo_schema_field(ceduo_schema_scene(), "page")->object;
    LOCAL_TEXT(head);
    for (size_t i = 0; i < p->fields_count; i++)
        if (p->fields[i].text[0]) {
            ceduo_text_format(&head, "%s%s: ", head.length > 0 ? ", " : "{", page->fields[i].key);
            ceduo_emit_scalar(&head, p->fields[i].text, true);
        }
    if (head.length > 0) {
        ceduo_text_char(&head, '}');
        if (!ceduo_app_edited(app, ceduo_document_set(&app->document, "page", head.bytes, &app->problems)))
            return false;
    }
    ask_for_file(app, export_of(p->path));
    return true;
}

static void ask_for_head(struct app *app, const char *export)
{
    const struct object *page = ceduo_schema_field(ceduo_schema_scene(), "page")->object;
    struct popup *p = ceduo_popup_fields(app, _("Head of the report"), filled_head);
    char today[32];
    time_t now = time(NULL);
    struct tm local;
    /* Translators: a date, as strftime() writes it. */
    strftime(today, sizeof today, _("%Y-%m-%d"), localtime_r(&now, &local));
    snprintf(p->path, sizeof p->path, "%s", export);
    ceduo_text_put(&p->text, _("Each line may stay empty. What is written here is kept in the scene, as 'page'."));
    for (size_t i = 0; i < page->n; i++)
        ceduo_popup_field(p, _(page->fields[i].shown.label), strcmp(page->fields[i].key, "date") == 0 ? today : "");
}

static void chose_export(struct app *app, struct popup *p, const char *value)
{
    size_t i = export_of(value);
    (void)p;
    if (!exports[i].put)
        ceduo_popup_text(app, _("The batch command that gives the same"))->preview = show_command;
    else if (exports[i].put == put_report && !ceduo_document_node(&app->document, "page"))
        ask_for_head(app, value);
    else
        ask_for_file(app, i);
}

/* ---- the clipboard ---- */

#define COPY_WIDTH 78 /* of a letter */

/* The view drawn by itself, long enough for all of it, its pictures left blank; runs of blank lines are one. Returns how many others there are. */
static size_t append_view(struct app *app, struct text *text)
{
    struct view_state *state = ceduo_app_state(app), kept = *state;
    struct ceduo_cells *screen = app->cells;
    app->cells = ceduo_must(ceduo_cells_create(COPY_WIDTH, CEDUO_CANVAS_MAX_HEIGHT, app->charset));
    app->cells->canvas.words_alone = true;
    state->pane = 0;
    ceduo_views[app->view]->draw(app, (struct ceduo_area){0, 0, COPY_WIDTH, CEDUO_CANVAS_MAX_HEIGHT});
    char *lines = ceduo_cells_dump(app->cells);
    size_t count = 0;
    bool gap = true;
    for (char *line = lines, *end; (end = strchr(line, '\n')); line = end + 1) {
        bool blank = line + strspn(line, " ") == end;
        if (!blank)
            ceduo_text_format(text, "%s%.*s\n", gap ? "\n" : "", (int)(end - line), line);
        count += !blank;
        gap = blank;
    }
    free(lines);
    ceduo_cells_free(app->cells);
    app->cells = screen;
    *state = kept;
    return count;
}

void ceduo_popup_copy(struct app *app)
{
    struct text text = {0};
    if (!app->copy) {
        ceduo_app_warn(app, "%s", _("this terminal has no clipboard that a program may write; w writes to a file"));
        return;
    }
    if (ceduo_views[app->view]->result && !app->live.result) {
        ceduo_app_warn(app, "%s", _("nothing is computed yet"));
        return;
    }
    const struct ceduo_scene *scene = &app->document.file.scene;
    ceduo_text_safe(&text, ceduo_in_language(scene->title, scene->title_it));
    ceduo_text_format(&text, ": %s\n", ceduo_app_option(app)->name);
    struct ceduo_doubt_report doubt;
    const struct ceduo_result *r = app->live.result;
    if (r && scene->controls_count > 0) {
        ceduo_words_answer(&text, r, app->option, r->last_control, ceduo_app_doubt(app, &doubt) ? &doubt : NULL, COPY_WIDTH);
        ceduo_text_char(&text, '\n');
    }
    size_t lines = append_view(app, &text);
    if (app->copy(text.bytes))
        ceduo_app_say(
            app, ngettext("copied: %zu line of what this view says", "copied: %zu lines of what this view says", lines), lines);
    else
        ceduo_app_warn(app, "%s", _("this view says too much for a clipboard; w writes it to a file"));
    ceduo_text_free(&text);
}

void ceduo_popup_export(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Export"), chose_export);
    for (size_t i = 0; i < EXPORTS; i++)
        ceduo_popup_item(p, _(exports[i].what), exports[i].name);
}
