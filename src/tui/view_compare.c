/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 5: the silvicultural options side by side, today and over one whole rotation of each. */
#include "base/language.h"
#include "popup.h"
#include "view/page_parts.h"

static void build(struct app *app, struct form *form)
{
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_form_table(form, "options", NULL, "name");
    else
        ceduo_form_note(form, _("Only one option. Press a to add a preset, y to copy."));
    form->row = app->option + 1; /* below the names of the columns */
}

enum { PANE_TABLE, PANE_COMPARE, PANE_TRADEOFF, PANES };

#define HEADS        3   /* lines above the table */
#define WORDS_MIN    4   /* lines of what is said below it, where there are so many options */
#define TRADEOFF_MIN 11  /* lines of the picture of protection against yield */
#define BESIDE_MIN   128 /* columns that hold the table and a picture beside it */
#define TABLE_WIDTH  84

static void draw_picture(struct app *app, enum ceduo_plot plot, struct ceduo_area area)
{
    struct ceduo_picture p = ceduo_app_picture(app);
    ceduo_app_plot(app, plot, area, &p);
}

/* The table around the option under the cursor; below it words, which scroll, and a picture if there is room. */
static void draw_table(struct app *app, struct ceduo_area area)
{
    struct ceduo_pane pane = ceduo_app_pane(app, area.height);
    struct ceduo_page table = {.width = (size_t)area.width}, said = {.width = (size_t)area.width - 2};
    size_t n = app->live.verdict.n,
           room = area.height > HEADS + WORDS_MIN + 1 ? (size_t)(area.height - HEADS - WORDS_MIN - 1) : 1;
    size_t shown = n <= room ? n : room - (room > 1);
    size_t first = app->option >= shown ? app->option - shown + 1 : 0;
    ceduo_page_shares(&table, pane.report, true);
    ceduo_page_options(&table, pane.report, CEDUO_OPTIONS_PANE, pane.report->result->last_control, app->option, first, shown);
    if (shown < n)
        ceduo_page_para(&table, CEDUO_PAGE_NOTE, _("%zu\xe2\x80\x93%zu of %zu options; up, down: the others"), first + 1,
                        first + shown, n);
    cut_top(&area, ceduo_page_draw(&table, &app->cells->canvas, area, 0) + 1);
    ceduo_page_free(&table);
    ceduo_pane_message(&said, &pane);
    int lines = ceduo_page_draw(&said, &app->cells->canvas, (struct ceduo_area){0}, 0);
    struct ceduo_area words = cut_top(&area, lines < area.height ? lines : area.height);
    words.width -= 2;
    ceduo_app_page(app, words, &said);
    cut_top(&area, 1);
    if (n > 1 && area.height >= TRADEOFF_MIN)
        draw_picture(app, CEDUO_PLOT_TRADEOFF, area);
}

/* The table with the picture that has room beside it, or one picture alone. */
static void draw(struct app *app, struct ceduo_area area)
{
    int pane = ceduo_app_state(app)->pane;
    bool beside = area.width >= BESIDE_MIN && app->live.verdict.n > 1;
    struct ceduo_area table = area, picture = area;
    if (pane != PANE_TABLE)
        ceduo_app_hint(app, pane == PANE_COMPARE ? _("Tab: protection against yield; up, down: another option")
                                                 : _("Tab: back to the table; up, down: another option"));
    if (pane == PANE_TABLE && beside) {
        table.width = TABLE_WIDTH;
        picture.left += TABLE_WIDTH + 2;
        picture.width -= TABLE_WIDTH + 2;
    }
    if (pane != PANE_TABLE || beside)
        draw_picture(app, pane == PANE_TRADEOFF ? CEDUO_PLOT_TRADEOFF : CEDUO_PLOT_COMPARE, picture);
    if (pane == PANE_TABLE)
        draw_table(app, table);
}

static void choose(struct app *app, long i)
{
    struct viewport v = {.count = (int)app->document.file.scene.options_count};
    viewport_move(&v, (int)i);
    ceduo_app_show_option(app, (size_t)v.selected);
}

static void next_option(struct app *app, int by)
{
    choose(app, (long)app->option + by);
}

static void copy_option(struct app *app)
{
    if (ceduo_app_edited(app, ceduo_document_duplicate(&app->document, "options", app->option, NULL)))
        choose(app, (long)app->option + 1);
}

static void delete_option(struct app *app)
{
    const char *path = ceduo_app_format(app, "options[%zu]", app->option);
    const char *name = ceduo_app_format(app, "%s", ceduo_app_option(app)->name);
    if (app->document.file.scene.options_count < 2)
        ceduo_app_show_message(app, "%s", _("the only option stays"));
    else if (ceduo_app_edited(app, ceduo_document_delete(&app->document, path)))
        ceduo_app_show_message(app, _("deleted: %s; u brings it back"), name);
}

static void move_option(struct app *app, int by)
{
    size_t to = app->option + (size_t)by; /* before the first it is larger than any */
    if (to < app->document.file.scene.options_count &&
        ceduo_app_edited(app, ceduo_document_move(&app->document, "options", app->option, to)))
        choose(app, (long)to);
}

static bool filled_name(struct app *app, struct popup *p)
{
    return ceduo_app_edited(app, ceduo_document_rename_option(&app->document, app->option, p->fields[0].line.text));
}

static void rename_option(struct app *app)
{
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_popup_field(ceduo_popup_fields(app, _("Name of this option"), "", filled_name), _("name"),
                          ceduo_app_option(app)->name);
}

static const struct act acts[] = {KEY(UP, .function = next_option, .by = -1),
                                  KEY(DOWN, .function = next_option, .by = 1),
                                  KEY(TOP, .function = next_option, .by = -ALL_LINES),
                                  KEY(BOTTOM, .function = next_option, .by = ALL_LINES),
                                  KEY(PAGE_UP, .function = ceduo_app_continue_form, .by = -4),
                                  KEY(PAGE_DOWN, .function = ceduo_app_continue_form, .by = 4),
                                  KEY(ADD, .plain = ceduo_popup_new_option),
                                  KEY(DUPLICATE, .plain = copy_option),
                                  KEY(DELETE, .plain = delete_option),
                                  KEY(EARLIER, .function = move_option, .by = -1),
                                  KEY(LATER, .function = move_option, .by = 1),
                                  KEY(EDIT, .plain = rename_option),
                                  {0}};

const struct view ceduo_view_compare = {.panes = PANES,
                                        .result = true,
                                        .build = build,
                                        .draw = draw,
                                        .acts = {acts, acts, acts},
                                        .bar = {KEY(ADD, N_("add")), KEY(NEXT_PANE, N_("picture")), KEY(DUPLICATE, N_("copy")),
                                                KEY(DELETE, N_("delete")), KEY(EDIT, N_("name")),
                                                KEY(PAGE_DOWN, N_("read on"))}};
