/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Popups: text, list, fields. A popup is closed before its callback runs, because the callback may open another. */
#include "popup.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "io/file.h"
#include "view/value_text.h"

/* ---- creating ---- */

static struct popup *create_popup(struct app *app, enum popup_kind kind, const char *title, const char *target)
{
    ceduo_popup_close(app);
    struct popup *p = ceduo_check_memory(calloc(1, sizeof *p));
    p->kind = kind;
    p->title = ceduo_arena_string(&p->arena, title);
    p->target = ceduo_arena_string(&p->arena, target);
    app->popup = p;
    return p;
}

static void free_popup(struct popup *p)
{
    ceduo_arena_free(&p->arena);
    ceduo_picker_clear(&p->picker);
    ceduo_text_free(&p->text);
    free(p);
}

void ceduo_popup_close(struct app *app)
{
    if (app->popup)
        free_popup(app->popup);
    app->popup = NULL;
}

struct popup *ceduo_popup_list(struct app *app, const char *title, const char *target, popup_call *on_select)
{
    struct popup *p = create_popup(app, POPUP_LIST, title, target);
    p->on_select = on_select;
    return p;
}

struct popup *ceduo_popup_text(struct app *app, const char *title)
{
    return create_popup(app, POPUP_TEXT, title, "");
}

struct popup *ceduo_popup_fields(struct app *app, const char *title, const char *target, popup_check *on_submit)
{
    struct popup *p = create_popup(app, POPUP_FIELDS, title, target);
    p->on_submit = on_submit;
    return p;
}

void ceduo_popup_add_item(struct popup *p, const char *text, const char *value)
{
    ceduo_picker_add(&p->picker, text, text, value, false);
}

void ceduo_popup_add_menu_item(struct popup *p, char key, const char *text, const char *value)
{
    char line[256];
    assert((key >= '1' && key <= '9') || (key >= 'a' && key <= 'z') || key == ' '); /* only 1 to 9 */
    snprintf(line, sizeof line, "%c  %s", key, text);
    p->is_menu = true;
    ceduo_popup_add_item(p, line, value);
}

struct popup_field *ceduo_popup_add_field(struct popup *p, const char *label, const char *value)
{
    assert(p->fields_count < POPUP_FIELDS_MAX);
    struct popup_field *field = &p->fields[p->fields_count++];
    snprintf(field->label, sizeof field->label, "%s", label);
    ceduo_line_set(&field->line, value);
    return field;
}

struct popup_field *ceduo_popup_add_choice(struct popup *p, const char *label, const char *value, popup_call *complete)
{
    struct popup_field *field = ceduo_popup_add_field(p, label, value);
    field->complete = complete;
    return field;
}

const struct field ceduo_popup_amount = {
    .key = "", .type = FIELD_NUMBER, .unit = "", .scale = 1, .hi = INFINITY, .shown = {.per = 1, .usual_max = INFINITY}};

struct field *ceduo_popup_add_value(struct popup *p, const char *label, const char *value, const struct field *kind)
{
    struct popup_field *field = ceduo_popup_add_field(p, label, value);
    struct field *own = ceduo_check_memory(ceduo_arena_alloc(&p->arena, sizeof *own));
    *own = *kind;
    own->shown.label = field->label;
    field->value = own;
    return own;
}

/* ---- input ---- */

bool ceduo_popup_confirm_unusual(struct app *app, const struct field *field, struct line *line)
{
    LOCAL_TEXT(reason);
    bool good = ceduo_input_is_in_range(field, line->text, &reason);
    bool must_confirm = good && !line->confirmed && ceduo_input_is_unusual(field, line->text, &reason);
    line->confirmed |= must_confirm;
    if (reason.bytes)
        ceduo_app_warn(app, "%s", reason.bytes);
    return good && !must_confirm;
}

bool ceduo_popup_read(struct app *app, const struct field *field, struct line *line, struct text *value)
{
    const char *label = _(field->shown.label);
    bool list = field->type == FIELD_NUMBERS, needed = field->flags & FIELD_REQUIRED;
    double number;
    if (!ceduo_popup_confirm_unusual(app, field, line))
        return false;
    if (line->text[0] == '\0') {
        if (needed)
            ceduo_app_warn(app, _("%s: required; %s"), label, _(field->meaning));
        return !needed;
    }
    ceduo_input_parse_value(field, line->text, value);
    const char *written = ceduo_text_string(value);
    if (list ? written[0] == '[' : written[0] == '{' || ceduo_number_read(written, &number) == CEDUO_NUMBER_GOOD)
        return true;
    ceduo_app_warn(app,
                   list ? _("%s: '%s' is not a list of numbers; separate them with blanks") : _("%s: '%s' is not a number"),
                   label, line->text);
    return false;
}

bool ceduo_popup_number(struct app *app, struct popup *p, size_t i, double *number)
{
    LOCAL_TEXT(value);
    if (!ceduo_popup_read(app, p->fields[i].value, &p->fields[i].line, &value))
        return false;
    ceduo_number_read(ceduo_text_string(&value), number);
    return true;
}

/* True if the scene is read from a file, such as its profile. */
static bool is_read_file(const struct document *d, const char *path, bool without_scene)
{
    bool found = false;
    for (const struct source *s = d->file.arena.sources; s && !found; s = s->before)
        found =
            s->path && ceduo_file_is_same(path, s->path) && !(without_scene && d->path && ceduo_file_is_same(s->path, d->path));
    return found;
}

bool ceduo_popup_confirm_overwrite(struct app *app, struct popup *p, bool saves_scene)
{
    struct line *line = &p->fields[0].line;
    struct stat st;
    if (stat(line->text, &st) != 0)
        return true;
    if (S_ISDIR(st.st_mode))
        ceduo_app_warn(app, "%s: %s", line->text, ceduo_error_text(EISDIR));
    else if (is_read_file(&app->document, line->text, saves_scene))
        ceduo_app_warn(app, "%s", _("the scene is read from this file; choose another name"));
    else if (line->confirmed)
        return true;
    else
        ceduo_app_warn(app, "%s", _("the file exists; Enter again replaces it"));
    line->confirmed = true;
    return false;
}

/* ---- completion ---- */

/* List the items for the text in the line under the cursor. */
static void update_items(struct app *app, struct popup *p)
{
    const struct popup_field *field = &p->fields[p->current];
    const struct line *line = &field->line;
    p->listed = true;
    p->cursor_moved = false;
    if (field->complete || p->kind == POPUP_FIELDS)
        ceduo_picker_clear(&p->picker);
    if (field->complete)
        field->complete(app, p);
    ceduo_picker_filter(&p->picker, line->unedited ? "" : line->text);
    if (line->unedited)
        ceduo_picker_go_to(&p->picker, line->text);
    bool is_file = p->endings && ceduo_picker_is_file(line->text, p->endings);
    if (!line->unedited && field->complete && !p->keep_input && is_file && !ceduo_picker_selected(&p->picker) &&
        access(line->text, F_OK) != 0)
        ceduo_app_warn(app, _("there is no file '%.180s'"), line->text); /* not after the last question */
}

static void go_to_field(struct app *app, struct popup *p, size_t field)
{
    p->current = field;
    ceduo_line_set(&p->fields[field].line, p->fields[field].line.text);
    update_items(app, p);
}

/* ---- keys ---- */

/* Return the number of lines that a key moves by; 0: none. `letters`: letters move, too, because nothing is typed. */
static int key_lines(int key, bool letters)
{
    static const int lines[ACTION_COUNT] = {[ACTION_UP] = -1,        [ACTION_DOWN] = 1,         [ACTION_PAGE_UP] = -10,
                                            [ACTION_PAGE_DOWN] = 10, [ACTION_TOP] = -ALL_LINES, [ACTION_BOTTOM] = ALL_LINES};
    enum action action = ceduo_action_find(key);
    return action != ACTION_NONE && (letters || ceduo_actions[action].key == key) ? lines[action] : 0;
}

/* Find the next place that contains the search text; after the last place begin again. */
static void search_text(struct app *app, struct popup *p)
{
    const char *text = ceduo_text_string(&p->text), *from = text + (p->found < p->text.length ? p->found : 0);
    const char *place = strcasestr(from, app->search);
    place = place ? place : strcasestr(text, app->search);
    p->found = place && app->search[0] ? (size_t)(place - text) + 1 : 0;
    p->show_found = p->found > 0;
    if (!p->show_found)
        ceduo_app_warn(app, _("'%s' not found"), app->search);
}

#define TEXT_FRAME 4 /* lines of the screen around a long text */

static void handle_text_key(struct app *app, struct popup *p, int key)
{
    enum action action = ceduo_action_find(key);
    int page = app->height - TEXT_FRAME - 1; /* keep a line in view; keys may precede drawing */
    int step = key == ' ' || action == ACTION_PAGE_DOWN ? page : action == ACTION_PAGE_UP ? -page : key_lines(key, true);
    struct line *line = &p->fields[0].line;
    app->message[0] = '\0';
    if (p->typing && (key == K_ENTER || key == K_ESCAPE)) {
        p->typing = false;
        if (key == K_ENTER) {
            ceduo_app_set_search(app, line->text);
            search_text(app, p);
        }
    } else if (p->typing) {
        ceduo_line_handle_key(line, key);
    } else if (action == ACTION_SEARCH) {
        p->typing = true;
        ceduo_line_set(line, app->search);
    } else if (action == ACTION_SEARCH_NEXT) {
        search_text(app, p);
    } else if (step != 0) {
        viewport_scroll(&p->lines, step);
    } else {
        ceduo_popup_close(app);
    }
}

/* Choose the item under the cursor. Detach the popup first: the callback may open another. */
static void choose_item(struct app *app, struct popup *p)
{
    const struct picker_item *item = ceduo_picker_selected(&p->picker);
    p->value = item ? item->value : p->endings && p->fields[0].line.text[0] ? p->fields[0].line.text : NULL;
    if (!p->value)
        return;
    app->popup = NULL;
    p->on_select(app, p);
    free_popup(p);
}

static void handle_list_key(struct app *app, struct popup *p, int key)
{
    struct line *line = &p->fields[0].line;
    int step = key_lines(key, false);
    app->message[0] = '\0';
    if (key == K_ESCAPE) {
        ceduo_popup_close(app);
    } else if (key == K_ENTER) {
        choose_item(app, p);
    } else if (step != 0) {
        viewport_move(&p->picker.lines, step);
    } else if (p->is_menu) {
        for (size_t i = 0; i < p->picker.matches; i++)
            if (key != ' ' && p->picker.items[p->picker.order[i]].text[0] == key) {
                p->picker.lines.selected = (int)i;
                choose_item(app, p);
                return;
            }
    } else if (key == K_TAB ? ceduo_picker_complete(&p->picker, line) : ceduo_line_handle_key(line, key)) {
        update_items(app, p);
    }
}

static void submit_fields(struct app *app, struct popup *p)
{
    app->popup = NULL;
    if (p->on_submit(app, p)) {
        free_popup(p);
        return;
    }
    ceduo_popup_close(app); /* the callback may have opened another */
    app->popup = p;
}

static void handle_fields_key(struct app *app, struct popup *p, int key)
{
    struct popup_field *field = &p->fields[p->current];
    struct line *line = &field->line;
    bool last = p->current + 1 >= p->fields_count, listed = field->complete && p->picker.matches > 0;
    bool vertical = key == K_UP || key == K_DOWN || key == K_PAGE_UP || key == K_PAGE_DOWN;
    app->message[0] = '\0';
    ceduo_jobs_stop(app->live.jobs, JOB_SEARCH); /* stop the search of these fields */
    if (key == K_ESCAPE && p->current == 0) {
        ceduo_popup_close(app);
    } else if (key == K_ESCAPE || key == K_SHIFT_TAB || (key == K_UP && !listed)) {
        go_to_field(app, p, p->current > 0 ? p->current - 1 : 0);
    } else if (listed && vertical) {
        viewport_move(&p->picker.lines, key_lines(key, false));
        p->cursor_moved = true;
    } else if (key == K_TAB && p->endings && field->complete && ceduo_picker_complete(&p->picker, line)) {
        update_items(app, p);
    } else if (key == K_TAB || key == K_DOWN || key == K_ENTER) {
        const struct picker_item *item = field->complete ? ceduo_picker_selected(&p->picker) : NULL;
        LOCAL_TEXT(value);
        if (item && (p->cursor_moved || !(p->keep_input || line->unedited)) && strcmp(line->text, item->value) != 0)
            ceduo_line_set(line, item->value); /* the matching item replaces the typed text */
        if (last && key == K_ENTER)
            submit_fields(app, p);
        else if (!last && (!field->value || ceduo_popup_read(app, field->value, line, &value)) &&
                 (!p->validate || p->validate(app, p)))
            go_to_field(app, p, p->current + 1);
    } else if (ceduo_line_handle_key(line, key)) {
        update_items(app, p);
    }
}

/* Handle a key in a field of the form. */
static void handle_field_key(struct app *app, struct popup *p, int key)
{
    bool submits = key == K_ENTER || key == K_TAB;
    app->message[0] = '\0';
    if (!submits)
        ceduo_line_handle_key(&p->fields[0].line, key);
    if (key == K_ESCAPE || (submits && p->on_submit(app, p)))
        ceduo_popup_close(app);
    if (key == K_TAB && !app->popup)
        ceduo_form_move(ceduo_app_form(app), 0, 1);
}

/* ---- drawing ---- */

static void draw_box(struct app *app, struct ceduo_area r, const char *title)
{
    static const char *const corners[2][2] = {{"\xe2\x94\x8c", "\xe2\x94\x90"}, {"\xe2\x94\x94", "\xe2\x94\x98"}};
    ceduo_cells_clear_area(app->cells, r);
    for (int y = 0; y < r.height; y++)
        for (int x = 0; x < r.width; x++) {
            bool upright = x == 0 || x == r.width - 1, level = y == 0 || y == r.height - 1;
            const char *c = upright && level ? corners[y > 0][x > 0] : level ? "\xe2\x94\x80" : "\xe2\x94\x82";
            if (upright || level)
                ceduo_cells_label(app->cells, r.left + x, r.top + y, CEDUO_ROLE_AXIS, c);
        }
    ceduo_app_draw_wrapped(app, (struct ceduo_area){r.left + 2, r.top, r.width - 4, 1}, CEDUO_ROLE_TITLE, title, 0);
}

/* Draw the position on the frame, at its top or bottom. */
static void draw_position(struct app *app, const struct popup *p, bool top, const struct viewport *lines, int line)
{
    const char *position = ceduo_app_position(app, lines, line);
    if (position[0])
        ceduo_canvas_label_right(&app->cells->canvas, p->box.left + p->box.width - 3,
                                 p->box.top + (top ? 0 : p->box.height - 1), CEDUO_ROLE_TITLE,
                                 ceduo_app_format(app, " %s ", position));
}

#define NOTE_LINES 6
#define LINES_MIN  6 /* min. lines below the note, if needed */

/* Draw a frame in the middle of the screen, with the note in its first lines. Return the area below the note. */
static struct ceduo_area draw_frame(struct app *app, struct popup *p, int lines, int note_lines)
{
    int width = app->width < 88 ? app->width : 84, wanted = ceduo_app_count_lines(app, ceduo_text_string(&p->text), width - 4);
    if (p->kind == POPUP_FIELDS) /* as high as the note; over a list the note changes with the cursor */
        note_lines = wanted < note_lines ? wanted : note_lines;
    note_lines = p->text.bytes || p->update_note ? note_lines : 0;
    int max = app->height - 2, height = lines + note_lines + 2;
    note_lines = height > max && note_lines > max - 2 - LINES_MIN ? max - 2 - LINES_MIN : note_lines;
    height = height > max ? max : height;
    struct ceduo_area r = {(app->width - width) / 2, (app->height - height) / 2, width, height};
    struct ceduo_area inner = {r.left + 2, r.top + 1, r.width - 4, r.height - 2};
    p->box = r;
    draw_box(app, r, p->title);
    LOCAL_TEXT(note);
    ceduo_text_append(&note, note_lines > 0 ? ceduo_text_string(&p->text) : "");
    ceduo_app_draw_text(app, cut_top(&inner, note_lines), CEDUO_ROLE_DIM, &note);
    return inner;
}

/* Draw an input line, scrolled to its end. */
static void draw_input(struct app *app, const struct line *line, int x, int y, int width, bool cursor)
{
    int n = ceduo_cells_label_end(app->cells, x, y, width - 1, cursor ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, line->text);
    if (cursor)
        ceduo_cells_label(app->cells, x + n, y, CEDUO_ROLE_CURSOR, "_");
}

/* Draw the line of the search text. */
static void draw_search(struct app *app, struct popup *p, struct ceduo_area area)
{
    int label = (int)ceduo_utf8_width(_("search:")) + 1;
    ceduo_app_draw_label(app, area.left, area.top, CEDUO_ROLE_DIM, "%s", _("search:"));
    draw_input(app, &p->fields[0].line, area.left + label, area.top, area.width - label, true);
}

static void scroll_text(struct app *app, int lines)
{
    viewport_scroll(&app->popup->lines, lines);
}

static void draw_text(struct app *app, struct popup *p)
{
    const char *text = ceduo_text_string(&p->text);
    struct ceduo_area inner = draw_frame(app, p, app->height, 0);
    if (p->typing)
        draw_search(app, p, cut_top(&inner, 1));
    else if (app->message[0])
        ceduo_app_draw_wrapped(app, cut_top(&inner, 1), CEDUO_ROLE_WARN, app->message, 0);
    viewport_fit(&p->lines, inner.height, ceduo_app_count_lines(app, text, inner.width));
    int found = p->found > 0 ? ceduo_app_find_line(text, inner.width, text + p->found - 1) : -1;
    int below = found + p->lines.rows / 2, last = below < p->lines.count ? below : p->lines.count - 1;
    if (p->show_found)
        viewport_show(&p->lines, found, last);
    p->show_found = false;
    ceduo_app_draw_wrapped(app, inner, CEDUO_ROLE_TEXT, text, p->lines.first);
    if (found >= p->lines.first) { /* draw the text again into the area of this line */
        struct ceduo_area line = {inner.left, inner.top + found - p->lines.first, inner.width,
                                  found - p->lines.first < inner.height};
        ceduo_app_draw_wrapped(app, line, CEDUO_ROLE_CURSOR, text, found);
    }
    draw_position(app, p, false, &p->lines, p->lines.first + p->lines.rows - 1);
    ceduo_app_add_hit(app, (struct hit){.area = inner, .wheel = scroll_text});
}

static void click_item(struct app *app, int x, int line)
{
    (void)x;
    if ((size_t)line < app->popup->picker.matches)
        app->popup->picker.lines.selected = line;
    app->popup->cursor_moved = true;
}

static void move_item(struct app *app, int lines)
{
    ceduo_popup_key(app, lines < 0 ? K_UP : K_DOWN);
}

/* Draw the items. A click on the selected one chooses it; below fields only if the cursor was moved there. */
static void draw_items(struct app *app, struct popup *p, struct ceduo_area area)
{
    const struct viewport *v = &p->picker.lines;
    ceduo_picker_draw(&p->picker, app->cells, area);
    if (p->picker.matches == 0)
        return;
    draw_position(app, p, false, v, v->selected);
    ceduo_app_add_hit(app, (struct hit){.area = area, .click = click_item, .first = v->first, .wheel = move_item});
    if (p->kind == POPUP_LIST || p->cursor_moved)
        ceduo_app_add_hit(app, (struct hit){.area = {area.left, area.top + v->selected - v->first, area.width, 1},
                                            .key = K_ENTER,
                                            .wheel = move_item});
}

static void draw_list(struct app *app, struct popup *p)
{
    int lines = p->picker.count > 2 ? (int)p->picker.count : 2;
    struct ceduo_area inner = draw_frame(app, p, lines + !p->is_menu, NOTE_LINES);
    if (!p->is_menu)
        draw_search(app, p, cut_top(&inner, 1));
    if (app->message[0] && !p->is_menu)
        ceduo_app_draw_wrapped(app, inner, CEDUO_ROLE_WARN, app->message, 0);
    else if (p->picker.matches == 0 && !p->is_menu)
        ceduo_app_draw_wrapped(app, inner, CEDUO_ROLE_DIM, _("nothing matches"), 0);
    else
        draw_items(app, p, inner);
}

#define FOOT_MIN      2  /* min. lines below the fields, for a message or items */
#define ITEMS_SHOWN   6  /* items below the fields */
#define PICTURE_SHOWN 16 /* lines of a picture in place of items */

/* Go to a field as keys do: each field on the way down is checked. */
static void click_field(struct app *app, int x, int line)
{
    struct popup *p = app->popup;
    (void)x;
    /* NOLINTNEXTLINE(clang-analyzer-unix.Malloc): false positive: no key submits the form, because a field follows */
    for (size_t last = SIZE_MAX; app->popup == p && p->current != (size_t)line && p->current != last;) {
        last = p->current;
        handle_fields_key(app, p, (size_t)line < last ? K_SHIFT_TAB : K_ENTER);
    }
}

static void draw_fields(struct app *app, struct popup *p)
{
    int items = 0;
    for (size_t i = 0; i < p->fields_count; i++)
        items = p->fields[i].complete ? ITEMS_SHOWN : items;
    int below = p->picture ? PICTURE_SHOWN : items;
    struct ceduo_area inner = draw_frame(app, p, (int)p->fields_count + 2 + below, app->height);
    int x = inner.left + 32, width = inner.width - 32, n = (int)p->fields_count, current = (int)p->current;
    viewport_fit(&p->lines, n <= inner.height - FOOT_MIN ? n : inner.height - FOOT_MIN, n);
    viewport_show(&p->lines, current, current);
    ceduo_app_add_hit(app, (struct hit){.area = {inner.left, inner.top, inner.width, p->lines.rows},
                                        .click = click_field,
                                        .first = p->lines.first});
    for (int i = p->lines.first; i < p->lines.first + p->lines.rows; i++) {
        struct ceduo_area line = cut_top(&inner, 1);
        ceduo_canvas_draw_text(&app->cells->canvas, line.left, line.top, 31, CEDUO_ROLE_DIM, p->fields[i].label);
        draw_input(app, &p->fields[i].line, x, line.top, width, i == current);
    }
    draw_position(app, p, true, &p->lines, current);
    struct ceduo_area first = {inner.left, inner.top, inner.width, inner.height < 2 ? inner.height : 2};
    ceduo_app_draw_wrapped(app, first, CEDUO_ROLE_WARN, app->message, 0);
    if (p->picture && (!p->fields[p->current].complete || p->picker.matches == 0) && !app->message[0])
        p->picture(app, p, (struct ceduo_area){inner.left, inner.top + 1, inner.width, inner.height - 1});
    else if (!app->message[0])
        draw_items(app, p, (struct ceduo_area){inner.left + 2, inner.top + 1, inner.width - 2, inner.height - 1});
}

/* ---- the open popup ---- */

static const struct {
    void (*key)(struct app *app, struct popup *popup, int key);
    void (*draw)(struct app *app, struct popup *popup);
    const char *bar;
} popup_kinds[] = {
    [POPUP_TEXT] = {handle_text_key, draw_text, N_("Space page  / search  Up Down scroll  any other key closes")},
    [POPUP_FIELD] = {handle_field_key, NULL, N_("Enter accept  Esc cancel  empty: default")},
    [POPUP_LIST] = {handle_list_key, draw_list, N_("type to search  Enter choose  Esc cancel  Tab complete  Up Down move")},
    [POPUP_FIELDS] = {handle_fields_key, draw_fields, N_("Enter next field, on the last one done  Esc back  Tab complete")}};

void ceduo_popup_key(struct app *app, int key)
{
    popup_kinds[app->popup->kind].key(app, app->popup, key);
}

bool ceduo_popup_paste(struct app *app, const char *text)
{
    struct popup *p = app->popup;
    if ((p->kind == POPUP_TEXT && !p->typing) || p->is_menu)
        return false;
    if (p->kind == POPUP_FIELDS)
        ceduo_jobs_stop(app->live.jobs, JOB_SEARCH); /* as a key does */
    if (ceduo_line_paste(&p->fields[p->current].line, text))
        update_items(app, p);
    else
        ceduo_app_warn(app, "%s", _("the pasted text is too long for this line"));
    return true;
}

const char *ceduo_popup_key_help(const struct app *app)
{
    return app->popup->typing    ? _("Enter search  Esc cancel")
           : app->popup->is_menu ? _("a letter, or Up Down and Enter  Esc cancel")
                                 : _(popup_kinds[app->popup->kind].bar);
}

/* Rebuild the note. */
static void rebuild_note(struct app *app, struct popup *p)
{
    ceduo_text_free(&p->text);
    p->update_note(app, p);
}

void ceduo_popup_update_note(struct app *app)
{
    struct popup *p = app->popup;
    if (!p->listed)
        update_items(app, p);
    const struct picker_item *item = ceduo_picker_selected(&p->picker);
    if (p->kind == POPUP_TEXT || !p->update_note || !item || p->value == item->value)
        return;
    p->value = item->value;
    p->has_preview = false;
    rebuild_note(app, p);
}

void ceduo_popup_on_preview(struct app *app, const struct preview *effect)
{
    struct popup *p = app->popup;
    if (!p || p->kind == POPUP_TEXT || !p->update_note || !p->value)
        return;
    p->preview = *effect;
    p->has_preview = true;
    rebuild_note(app, p);
}

void ceduo_popup_draw(struct app *app)
{
    struct popup *p = app->popup;
    if (p->kind == POPUP_TEXT && p->update_note)
        rebuild_note(app, p);
    if (popup_kinds[p->kind].draw)
        popup_kinds[p->kind].draw(app, p);
}
