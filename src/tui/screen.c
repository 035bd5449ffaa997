/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "popup.h"

const struct view *const ceduo_views[VIEW_COUNT] = {
#define V(NAME, name, key, word, help) &ceduo_view_##name,
    VIEWS(V)
#undef V
};

#define WIDTH_MIN  60
#define HEIGHT_MIN 16

#define MARKS_MORE    2   /* extra columns of the verdict's signs in ASCII */
#define WIDE          100 /* columns for an extra blank between the titles of views */
#define NAME_MIN      3   /* min. columns of the title of a closed view */
#define NAME_SHORT    5   /* the same if the scene's title then fits */
#define NAME_WANTED   20  /* wanted columns of it */
#define TITLE_MIN     10  /* min. columns of the scene's title */
#define SCENE_GAP     1   /* columns before the scene's title */
#define UNSAVED       "* "
#define UNSAVED_WIDTH 2

/* Return the scene's title, with "* " if it is unsaved. */
static const char *scene_title(struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    LOCAL_TEXT(safe);
    ceduo_text_append(&safe, ceduo_document_unsaved(&app->document) ? UNSAVED : "");
    ceduo_text_append_escaped(&safe, ceduo_in_language(scene->title, scene->title_it));
    return ceduo_arena_string(app->scratch, ceduo_text_string(&safe));
}

/* Return the columns of a view's title: number, blanks, and at most `max` columns of a closed view's name. */
static int name_columns(const struct app *app, int view, int max)
{
    int name = (int)ceduo_utf8_width(ceduo_translate_in(ceduo_actions[ACTION_VIEW_SLOPE + view].help));
    return (view == (int)app->view || name < max ? name : max) + (app->width < WIDE ? 3 : 4);
}

/* Return the columns of the titles of all views. */
static int all_columns(const struct app *app, int max)
{
    int total = 0;
    for (int v = 0; v < VIEW_COUNT; v++)
        total += name_columns(app, v, max);
    return total;
}

/* Return the columns of the scene's title in the first line: cut to those next to short titles of views; 0 if they are few. */
static int scene_columns(const struct app *app, const char *title)
{
    int width = ceduo_cells_label_width(app->charset, title),
        unsaved = ceduo_document_unsaved(&app->document) ? 0 : UNSAVED_WIDTH;
    int max = app->width - all_columns(app, NAME_SHORT) - SCENE_GAP - unsaved;
    return max < TITLE_MIN && max < width ? 0 : width < max ? width : max;
}

/* Return the columns to which names of closed views are shortened, so that all titles and the scene's fit. */
static int fit_names(const struct app *app, int scene)
{
    int max = NAME_WANTED;
    if (scene > 0) /* space for the mark of unsaved work, which may come */
        scene += SCENE_GAP + (ceduo_document_unsaved(&app->document) ? 0 : UNSAVED_WIDTH);
    while (max > NAME_MIN && all_columns(app, max) + (max > NAME_SHORT ? scene : 0) > app->width)
        max--;
    return max;
}

/* Draw the titles of the views, and the scene's. Return true if there is one. */
static bool draw_title(struct app *app)
{
    const char *title = scene_title(app);
    int x = 0, scene = scene_columns(app, title), max = fit_names(app, scene);
    for (int v = 0; v < VIEW_COUNT; v++) {
        int columns = name_columns(app, v, max);
        ceduo_canvas_draw_text(&app->cells->canvas, x, 0, columns, v == (int)app->view ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_DIM,
                               ceduo_app_format(app, app->width < WIDE ? " %d %s" : " %d %s ", v + 1,
                                                ceduo_translate_in(ceduo_actions[ACTION_VIEW_SLOPE + v].help)));
        ceduo_app_add_hit(app, (struct hit){.area = {x, 0, columns, 1}, .key = ceduo_actions[ACTION_VIEW_SLOPE + v].key});
        x += columns;
    }
    ceduo_canvas_draw_text(&app->cells->canvas, app->width - scene, 0, scene, CEDUO_ROLE_TITLE, title);
    return scene > 0;
}

/* Return the progress for the end of the answer's line, the only place that shows it. `share`: computed share of the
 * uncertainty; NaN: only figures are refined. */
static const char *progress_words(const struct app *app, double share)
{
    if (!isnan(share))
        return ceduo_app_format(app, _(" uncertainty %.0f %%"), floor(100 * share));
    return app->live.busy ? _(" refining \xe2\x80\xa6") : "";
}

/* Draw the answer for the option shown, and what is being computed. */
static void draw_verdict(struct app *app)
{
    const struct ceduo_result *r = app->live.result;
    LOCAL_TEXT(answer);
    if (!r || r->scene->controls_count == 0)
        return;
    struct ceduo_subject subject = ceduo_subject_find(ceduo_app_report(app), app->option, r->last_control);
    enum ceduo_judgement judgement = subject.outcome.answer;
    bool open = judgement != CEDUO_JUDGEMENT_CANNOT_JUDGE && judgement != CEDUO_JUDGEMENT_UNANSWERED; /* to the uncertainty */
    double share = open ? ceduo_live_uncertainty_progress(&app->live, &app->document.file, app->option) : NAN;
    const char *progress = progress_words(app, share);
    subject.preliminary = !isnan(share);
    ceduo_words_answer(&answer, &subject, (size_t)app->width - 1 - MARKS_MORE - ceduo_utf8_width(progress));
    ceduo_canvas_draw_text(&app->cells->canvas, 1, 1, app->width - 1,
                           judgement == CEDUO_JUDGEMENT_UNANSWERED ? CEDUO_ROLE_TITLE
                           : judgement == CEDUO_JUDGEMENT_YES      ? CEDUO_ROLE_GOOD
                           : judgement == CEDUO_JUDGEMENT_NO       ? CEDUO_ROLE_BAD
                                                                   : CEDUO_ROLE_WARN,
                           answer.bytes);
    ceduo_canvas_label_right(&app->cells->canvas, app->width - 1, 1, CEDUO_ROLE_DIM, progress);
}

/* ---- stale figures ---- */

/* Dim an area, or replace it by the dimmed cells of `from`. */
static void dim_area(struct app *app, struct ceduo_area area, const struct ceduo_cells *from)
{
    for (int y = area.top; y < area.top + area.height; y++)
        for (int x = area.left; x < area.left + area.width; x++) {
            struct ceduo_cell *cell = ceduo_cells_at(app->cells, x, y);
            if (cell && from)
                *cell = *ceduo_cells_at(from, x, y);
            if (cell && cell->role != CEDUO_ROLE_BLANK)
                cell->role = CEDUO_ROLE_DIM;
        }
}

/* Dim stale figures; without figures, show those of the last screen. The answer is that of the last screen. */
static void dim_figures(struct app *app, struct ceduo_area column)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct ceduo_result *r = app->live.result;
    struct last_screen *last_screen = &app->last_screen;
    if (!ceduo_live_is_stale(&app->live, scene, app->option)) {
        if (!last_screen->cells)
            last_screen->cells = ceduo_check_memory(ceduo_cells_create(app->width, app->height, app->charset));
        memcpy(last_screen->cells->cell, app->cells->cell, (size_t)app->width * (size_t)app->height * sizeof *app->cells->cell);
        *last_screen = (struct last_screen){last_screen->cells, app->view, app->option, app->year};
        return;
    }
    bool same = last_screen->cells && last_screen->option == app->option &&
                (last_screen->year == app->year || last_screen->view != VIEW_ROTATION);
    bool known = r && (!r->wooded || ceduo_result_wooded(r, app->option, r->last_control));
    const struct ceduo_cells *old = same && !known ? last_screen->cells : NULL;
    dim_area(app, (struct ceduo_area){0, 1, app->width, 1}, same ? last_screen->cells : NULL);
    dim_area(app, column, old);
    for (size_t i = 0; i < app->pictures_count; i++)
        dim_area(app, app->pictures[i], last_screen->view == app->view ? old : NULL);
    if (r || same)
        ceduo_canvas_label_right(&app->cells->canvas, app->width - 1, 1, CEDUO_ROLE_TEXT, _(" computing \xe2\x80\xa6"));
}

void ceduo_app_show_hint(struct app *app, const char *text)
{
    if (!app->message[0] && (!app->popup || app->popup->kind == POPUP_FIELD))
        ceduo_app_show_message(app, "%s", text);
}

static void draw_explanation(struct app *app)
{
    LOCAL_TEXT(text);
    LOCAL_TEXT(safe);
    enum ceduo_role role = CEDUO_ROLE_TEXT;
    struct ceduo_area lines = {0, app->height - 3, app->width, 2};
    if (app->message[0] && !(app->popup && app->popup->kind >= POPUP_LIST && !app->popup->is_menu)) { /* the popup shows it */
        ceduo_text_append(&text, app->message);
        role = app->message_is_warning ? CEDUO_ROLE_WARN : CEDUO_ROLE_GOOD;
    } else if (ceduo_app_state(app)->pane == 0) {
        ceduo_form_explain(ceduo_app_form(app), &text);
    }
    ceduo_text_append_escaped(&safe, ceduo_text_string(&text));
    ceduo_app_shorten(app, &safe, lines.width, lines.height);
    const char *shown = ceduo_text_string(&safe);
    if ((int)ceduo_utf8_width(shown) > app->width) {
        ceduo_cells_clear_area(app->cells, lines); /* also the position of a text above */
        ceduo_app_draw_wrapped(app, lines, role, shown, 0);
    } else
        ceduo_canvas_draw_text(&app->cells->canvas, 0, app->height - 2, app->width, role, shown);
}

static int bar_width(enum action action, const char *word)
{
    return (int)ceduo_utf8_width(ceduo_actions[action].word) + (int)ceduo_utf8_width(_(word)) + 3;
}

/* Draw a key in the bar. Return false if it does not fit. */
static bool draw_key(struct app *app, int *x, enum action action, const char *word, int *space)
{
    const char *key = ceduo_actions[action].word;
    int width = bar_width(action, word);
    if (width > *space)
        return false;
    ceduo_app_draw_label(app, *x, app->height - 1, CEDUO_ROLE_TITLE, "%s", key);
    ceduo_app_draw_label(app, *x + (int)ceduo_utf8_width(key) + 1, app->height - 1, CEDUO_ROLE_DIM, "%s", _(word));
    ceduo_app_add_hit(app, (struct hit){.area = {*x, app->height - 1, width - 2, 1}, .key = ceduo_actions[action].key});
    *x += width;
    *space -= width;
    return true;
}

/* Draw the keys of the popup, separated by two blanks. Only they and the popup react to the mouse. */
static void draw_popup_bar(struct app *app)
{
    const char *help = ceduo_popup_key_help(app);
    ceduo_canvas_draw_text(&app->cells->canvas, 0, app->height - 1, app->width, CEDUO_ROLE_DIM, help);
    app->hits_count = 0;
    for (const char *part = help, *end; *part; part = end + strspn(end, " ")) {
        int x = (int)ceduo_utf8_width(ceduo_app_format(app, "%.*s", (int)(part - help), help));
        int key = ceduo_key_find(ceduo_app_format(app, "%.*s", (int)strcspn(part, " "), part));
        bool text = app->popup->kind == POPUP_TEXT;
        end = strstr(part, "  ");
        end = end ? end : part + strlen(part);
        key = key == K_NONE && text ? K_ESCAPE : key;
        int width = (int)ceduo_utf8_width(ceduo_app_format(app, "%.*s", (int)(end - part), part));
        if (key < (text ? K_SPECIAL : ' ')) /* "a letter" is no key */
            ceduo_app_add_hit(app, (struct hit){.area = {x, app->height - 1, width, 1}, .key = key});
    }
}

/* True if the bar may list a common key: some keys act only on a line of a form. */
static bool is_usable(struct app *app, enum action action)
{
    bool needs_form = action == ACTION_EDIT || action == ACTION_ADD || action == ACTION_FIND;
    return !needs_form || ceduo_app_form(app)->n > 0;
}

/* True if the bar lists a key as the view's own. */
static bool is_own(const struct app *app, enum action action)
{
    const struct view *view = ceduo_views[app->view];
    int k = 0;
    while (view->bar[k].word && view->bar[k].action != action)
        k++;
    return view->bar[k].word && (!view->is_listed || view->is_listed(app, action));
}

/* Draw the view's own keys, then the common ones. The most important keys always fit. */
static void draw_bar(struct app *app)
{
    const struct view *view = ceduo_views[app->view];
    int x = 0, space = app->width + 2;
    if (app->popup) {
        draw_popup_bar(app);
        return;
    }
    for (int i = 0; i < ACTION_COUNT; i++)
        space -= ceduo_actions[i].bar == 2 ? bar_width((enum action)i, ceduo_actions[i].help) : 0;
    bool fits = true;
    for (int k = 0; view->bar[k].word && fits; k++)
        fits = !is_own(app, view->bar[k].action) || draw_key(app, &x, view->bar[k].action, view->bar[k].word, &space);
    for (int rank = 1; rank <= 2; rank++) {
        for (int i = 0; i < ACTION_COUNT; i++)
            if (ceduo_actions[i].bar == rank && !is_own(app, (enum action)i) && is_usable(app, (enum action)i))
                draw_key(app, &x, (enum action)i, ceduo_actions[i].help, &space);
        space = app->width;
    }
}

/* ---- the form ---- */

static void click_form(struct app *app, int x, int line)
{
    ceduo_form_click(ceduo_app_form(app), x, line);
}

static void move_form(struct app *app, int lines)
{
    ceduo_form_move(ceduo_app_form(app), lines, 0);
}

/* Return the belt and the option shown if there are several, and the position in the form. */
static const char *form_head(struct app *app)
{
    const struct form *form = ceduo_app_form(app);
    size_t belts = ceduo_app_option(app)->belts_count, options = app->document.file.scene.options_count;
    const char *forest = ceduo_app_forest(app);
    bool has_belts = false;
    LOCAL_TEXT(head);
    for (size_t i = 0; i < form->n; i++)
        has_belts |= strcmp(form->rows[i].list, forest) == 0;
    if (has_belts && belts > 1)
        ceduo_text_format(&head, _("belt %zu of %zu"), app->belt + 1, belts);
    if (options > 1)
        ceduo_text_append_joined(&head, head.length > 0 ? " \xc2\xb7 " : "", _("option %zu of %zu"), app->option + 1, options);
    const char *position = ceduo_app_position(app, &form->lines, (int)form->row);
    if (position[0])
        ceduo_text_append_joined(&head, head.length > 0 ? " \xc2\xb7 " : "", "%s", position);
    return ceduo_arena_string(app->scratch, ceduo_text_string(&head));
}

/* Draw the head at the right end of a heading in the first line of the form. Return false if there is no space for it. */
static bool draw_head_beside(struct app *app, struct ceduo_area area)
{
    const struct form *form = ceduo_app_form(app);
    const struct form_row *row = (size_t)form->lines.first < form->n ? &form->rows[form->lines.first] : NULL;
    const char *head = form_head(app);
    int width = ceduo_cells_label_width(app->charset, head);
    if (!row || row->kind != FORM_HEADING || ceduo_cells_label_width(app->charset, row->label) + 2 + width > area.width)
        return false;
    ceduo_canvas_label_right(&app->cells->canvas, area.left + area.width - 1, area.top, CEDUO_ROLE_TITLE, head);
    return true;
}

void ceduo_app_draw_form(struct app *app, struct ceduo_area area)
{
    const struct popup *p = app->popup && app->popup->kind == POPUP_FIELD ? app->popup : NULL;
    struct form *form = ceduo_app_form(app);
    struct ceduo_area cell;
    if (area.height <= 0)
        return;
    ceduo_form_scroll(form, area);
    if (!draw_head_beside(app, area)) { /* a line of its own */
        struct ceduo_area head = cut_top(&area, 1);
        ceduo_form_scroll(form, area);
        ceduo_canvas_draw_text(&app->cells->canvas, head.left, head.top, head.width, CEDUO_ROLE_TITLE, form_head(app));
    }
    ceduo_form_draw(form, app->cells, area, p ? p->fields[0].line.text : NULL);
    if (area.height <= 0)
        return;
    ceduo_app_add_hit(app, (struct hit){.area = area, .click = click_form, .first = form->lines.first, .wheel = move_form});
    if (ceduo_form_find_cell(form, &cell))
        ceduo_app_add_hit(app, (struct hit){.area = cell, .key = K_ENTER, .wheel = move_form});
}

/* Draw the newest figures. Warnings that do not fit are only counted. `titled`: with the scene's title. */
static void draw_column(struct app *app, struct ceduo_area area, bool titled)
{
    struct ceduo_canvas *canvas = &app->cells->canvas;
    struct ceduo_page page = {.width = (size_t)area.width};
    struct ceduo_pane pane = ceduo_app_pane(app, area.height);
    if (titled) {
        static const struct ceduo_page_column columns[] = {{"", 8, 0, COL_GROW}};
        CEDUO_PAGE_TABLE_OF(&page, columns);
        ceduo_page_cell_role(&page, CEDUO_ROLE_TITLE, scene_title(app));
    }
    size_t warnings = ceduo_pane_column(&page, &pane), hidden = 0;
    for (; hidden < warnings; hidden++) {
        if (ceduo_page_draw(&page, canvas, (struct ceduo_area){0}, 0) + (hidden > 0) <= area.height)
            break;
        ceduo_page_drop(&page);
    }
    if (hidden > 0)
        ceduo_page_para(&page, CEDUO_PAGE_WARNING, ngettext("%zu more remark: view 4", "%zu more remarks: view 4", hidden),
                        hidden);
    if (ceduo_page_draw(&page, canvas, area, 0) > area.height)
        ceduo_canvas_label_right(canvas, app->width - 1, area.top + area.height - 1, CEDUO_ROLE_TITLE, " \xe2\x80\xa6");
    ceduo_page_free(&page);
}

bool ceduo_screen_is_too_small(const struct app *app)
{
    return app->width < WIDTH_MIN || app->height < HEIGHT_MIN;
}

/* Draw the needed size and the effect of q in place of the screen. */
static void draw_size(struct app *app)
{
    struct ceduo_area whole = {0, 0, app->width, app->cells->height};
    LOCAL_TEXT(text);
    ceduo_text_format(&text, _("The window (%d x %d) is too small: at least %d x %d is needed."), app->width,
                      app->cells->height, WIDTH_MIN, HEIGHT_MIN + app->cells->height - app->height);
    ceduo_text_format(&text, " %s",
                      app->tour.step                           ? _("q ends the tour.")
                      : ceduo_document_unsaved(&app->document) ? _("Unsaved changes: enlarge the window to quit.")
                                                               : _("q quits."));
    ceduo_app_draw_wrapped(app, whole, CEDUO_ROLE_WARN, ceduo_text_string(&text), 0);
}

void ceduo_screen_draw(struct app *app)
{
    ceduo_cells_clear(app->cells);
    app->pictures_count = app->hits_count = 0;
    app->drawn = true;
    if (ceduo_screen_is_too_small(app)) {
        draw_size(app);
        return;
    }
    int side = app->width >= 140 ? 44 : app->width >= 100 ? 36 : 28;
    struct ceduo_area column = {app->width - side + 1, 2, side - 1, app->height - 5};
    struct ceduo_area body = {0, 2, app->width - side - 2, app->height - 5};
    bool titled = draw_title(app);
    draw_verdict(app);
    for (int y = column.top; y < column.top + column.height; y++)
        ceduo_cells_label(app->cells, column.left - 2, y, CEDUO_ROLE_AXIS, "\xe2\x94\x82");
    draw_column(app, column, !titled);
    if (ceduo_views[app->view]->result && !app->live.result) {
        ceduo_app_draw_wrapped(app, body, CEDUO_ROLE_DIM, _("the first rocks are falling \xe2\x80\xa6"), 0);
        app->pictures[app->pictures_count++] = body;
    } else
        ceduo_views[app->view]->draw(app, body);
    dim_figures(app, column);
    draw_explanation(app);
    draw_bar(app);
    if (app->popup)
        ceduo_popup_draw(app);
    ceduo_tour_draw(app);
}
