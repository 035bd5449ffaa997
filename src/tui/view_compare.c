/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 5: the silvicultural options side by side, today and over the years. */
#include "base/language.h"
#include "popup.h"
#include "view/page_parts.h"

static void build_compare(struct app *app, struct form *form)
{
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_form_table(form, "options", NULL, "name");
    else
        ceduo_form_note(form, _("Only one option. Press a to add a preset, y to copy."));
    form->row = app->option + 1; /* below the column heads */
}

enum { PANE_TABLE, PANE_AHEAD, PANE_COMPARE, PANE_TRADEOFF, PANES };

#define HEADS            3   /* lines above the table */
#define WORDS_MIN        4   /* min. lines of the text below */
#define AHEAD_MIN        12  /* min. lines of the curves below the text */
#define HEIGHT_BOTH      28  /* lines for table, text and curves */
#define TRADEOFF_MIN     11  /* min. lines of the picture of protection against yield */
#define SIDE_BY_SIDE_MIN 128 /* columns for pictures next to table and text */
#define TABLE_WIDTH      84

static void draw_compare_picture(struct app *app, enum ceduo_plot plot, struct ceduo_area area)
{
    struct ceduo_picture p = ceduo_app_picture(app);
    p.no_legend = ceduo_app_state(app)->pane == PANE_TABLE; /* the table has names and numbers */
    ceduo_app_draw_plot(app, plot, area, &p);
}

static void select_option(struct app *app, long i)
{
    struct viewport v = {.count = (int)app->document.file.scene.options_count};
    viewport_move(&v, (int)i);
    ceduo_app_show_option(app, (size_t)v.selected);
}

static void step_option(struct app *app, int step)
{
    select_option(app, (long)app->option + step);
}

/* Select the next option: the wheel moves by one. */
static void step_options(struct app *app, int lines)
{
    step_option(app, lines < 0 ? -1 : 1);
}

static void click_option(struct app *app, int column, int option)
{
    (void)column;
    ceduo_app_show_option(app, (size_t)option);
}

/* Let the mouse act on the last `shown` of `lines` lines. A click on the selected option renames it, as Enter does. */
static void add_option_hits(struct app *app, struct ceduo_area area, int lines, int first, int shown)
{
    cut_top(&area, lines - shown);
    area.height = shown;
    ceduo_app_add_hit(app, (struct hit){.area = area, .click = click_option, .first = first, .wheel = step_options});
    cut_top(&area, (int)app->option - first);
    area.height = 1;
    ceduo_app_add_hit(app, (struct hit){.area = area, .key = K_ENTER, .wheel = step_options});
}

/* Add the text below the table. */
static void add_words(struct app *app, struct ceduo_page *page, int width)
{
    struct ceduo_pane pane = ceduo_app_pane(app, 0);
    page->width = (size_t)width - 2;
    ceduo_pane_message(page, &pane);
}

/* Draw the table around the option under the cursor, and the text below it. */
static void draw_options(struct app *app, struct ceduo_area area)
{
    struct ceduo_pane pane = ceduo_app_pane(app, area.height);
    struct ceduo_page table = {.width = (size_t)area.width}, text = {0};
    size_t n = app->live.verdict.n,
           max_rows = area.height > HEADS + WORDS_MIN + 1 ? (size_t)(area.height - HEADS - WORDS_MIN - 1) : 1;
    size_t shown = n <= max_rows ? n : max_rows - (max_rows > 1);
    size_t first = app->option >= shown ? app->option - shown + 1 : 0;
    ceduo_page_shares(&table, pane.report, true);
    ceduo_page_options(&table, pane.report, CEDUO_OPTIONS_PANE, pane.report->result->last_control, app->option, first, shown);
    if (table.last->cells_count == (shown + 1) * table.last->columns_count) /* head and options */
        add_option_hits(app, area, ceduo_page_draw(&table, &app->cells->canvas, (struct ceduo_area){0}, 0), (int)first,
                        (int)shown);
    if (shown < n)
        ceduo_page_para(&table, CEDUO_PAGE_NOTE, _("%zu\xe2\x80\x93%zu of %zu options; up, down: the others"), first + 1,
                        first + shown, n);
    cut_top(&area, ceduo_page_draw(&table, &app->cells->canvas, area, 0) + 1);
    ceduo_page_free(&table);
    add_words(app, &text, area.width);
    area.width -= 2;
    ceduo_app_draw_page(app, area, &text);
}

/* Return the lines of the curves below table and text: the rest, or some if the text has to scroll. */
static int curve_lines(struct app *app, struct ceduo_area area)
{
    struct ceduo_page text = {0};
    int table = (int)app->live.verdict.n + HEADS;
    add_words(app, &text, area.width);
    int rest = area.height - table - ceduo_page_draw(&text, &app->cells->canvas, (struct ceduo_area){0}, 0) - 1;
    ceduo_page_free(&text);
    int scrolled = area.height - table - WORDS_MIN - 2, half = area.height / 2;
    scrolled = scrolled < AHEAD_MIN ? AHEAD_MIN : scrolled < half ? scrolled : half;
    return rest > scrolled ? rest : scrolled;
}

/* Draw table and text, with the curves of the years below them, and the other pictures next to them, if there is space. */
static void draw_all(struct app *app, struct ceduo_area area)
{
    bool wide = area.width >= SIDE_BY_SIDE_MIN && app->live.verdict.n > 1;
    struct ceduo_area text = area;
    if (wide)
        text.width = TABLE_WIDTH;
    if (area.height >= HEIGHT_BOTH) {
        int lines = curve_lines(app, text);
        draw_compare_picture(app, CEDUO_PLOT_AHEAD, cut_bottom(&area, lines));
        cut_bottom(&area, 1); /* position of the text */
        text.height = area.height;
    }
    if (wide) {
        int rows = (int)app->live.verdict.n + 2, rest = area.height - rows - 1;
        area.left += TABLE_WIDTH + 2;
        area.width -= TABLE_WIDTH + 2;
        if (rest >= TRADEOFF_MIN)
            draw_compare_picture(app, CEDUO_PLOT_TRADEOFF, cut_bottom(&area, rest));
        draw_compare_picture(app, CEDUO_PLOT_COMPARE, area);
    }
    draw_options(app, text);
}

/* Draw everything that fits around the table, or one picture. */
static void draw_compare(struct app *app, struct ceduo_area area)
{
    static const enum ceduo_plot plots[PANES] = {CEDUO_PLOT_NONE, CEDUO_PLOT_AHEAD, CEDUO_PLOT_COMPARE, CEDUO_PLOT_TRADEOFF};
    int pane = ceduo_app_state(app)->pane;
    if (pane == PANE_TABLE) {
        draw_all(app, area);
        return;
    }
    ceduo_app_show_hint(app, pane == PANE_AHEAD     ? _("Tab: the options today; up, down: another option")
                             : pane == PANE_COMPARE ? _("Tab: protection against yield; up, down: another option")
                                                    : _("Tab: back to the table; up, down: another option"));
    draw_compare_picture(app, plots[pane], area);
}

static void copy_option(struct app *app)
{
    if (ceduo_app_finish_edit(app, ceduo_document_duplicate(&app->document, "options", app->option, NULL)))
        select_option(app, (long)app->option + 1);
}

static void delete_option(struct app *app)
{
    const char *path = ceduo_app_format(app, "options[%zu]", app->option);
    const char *name = ceduo_app_format(app, "%s", ceduo_app_option(app)->name);
    if (app->document.file.scene.options_count < 2)
        ceduo_app_show_message(app, "%s", _("the only option cannot be deleted"));
    else if (ceduo_app_finish_edit(app, ceduo_document_delete(&app->document, path)))
        ceduo_app_show_message(app, _("deleted: %s; u undoes"), name);
}

static void move_option(struct app *app, int step)
{
    size_t to = app->option + (size_t)step; /* wraps around before the first option */
    if (to < app->document.file.scene.options_count &&
        ceduo_app_finish_edit(app, ceduo_document_move(&app->document, "options", app->option, to)))
        select_option(app, (long)to);
}

/* Rename the option. An unchanged name is no edit. In Italian only its Italian name changes, if it has one. */
static bool submit_option_name(struct app *app, struct popup *p)
{
    const char *name = p->fields[0].line.text;
    const char *italian = ceduo_app_format(app, "options[%zu].name_it", app->option);
    if (strcmp(name, ceduo_app_option(app)->name) == 0)
        return true;
    if (ceduo_document_node(&app->document, italian) && ceduo_in_language(NULL, italian))
        return name[0] ? ceduo_app_set(app, italian, ceduo_app_scalar(app, name))
                       : ceduo_app_finish_edit(app, ceduo_document_delete(&app->document, italian));
    return ceduo_app_finish_edit(app, ceduo_document_rename_option(&app->document, app->option, name));
}

static void rename_option(struct app *app)
{
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_popup_add_field(ceduo_popup_fields(app, _("Name of this option"), "", submit_option_name), _("name"),
                              ceduo_app_option(app)->name);
}

static const struct key_binding compare_bindings[] = {KEY(UP, .handler = step_option, .step = -1),
                                                      KEY(DOWN, .handler = step_option, .step = 1),
                                                      KEY(TOP, .handler = step_option, .step = -ALL_LINES),
                                                      KEY(BOTTOM, .handler = step_option, .step = ALL_LINES),
                                                      KEY(PAGE_UP, .handler = ceduo_app_scroll_text, .step = -4),
                                                      KEY(PAGE_DOWN, .handler = ceduo_app_scroll_text, .step = 4),
                                                      KEY(ADD, .plain = ceduo_popup_new_option),
                                                      KEY(DUPLICATE, .plain = copy_option),
                                                      KEY(DELETE, .plain = delete_option),
                                                      KEY(MOVE_UP, .handler = move_option, .step = -1),
                                                      KEY(MOVE_DOWN, .handler = move_option, .step = 1),
                                                      KEY(EDIT, .plain = rename_option),
                                                      {0}};

const struct view ceduo_view_compare = {.panes = PANES,
                                        .result = true,
                                        .build = build_compare,
                                        .draw = draw_compare,
                                        .bindings = {compare_bindings, compare_bindings, compare_bindings, compare_bindings},
                                        .bar = {KEY(ADD, N_("add")), KEY(NEXT_PANE, N_("picture")), KEY(DUPLICATE, N_("copy")),
                                                KEY(DELETE, N_("delete")), KEY(EDIT, N_("name")),
                                                KEY(PAGE_DOWN, N_("scroll"))}};
