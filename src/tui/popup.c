/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Popups: text, list, fields. A popup is closed before its callback runs, because the callback may open another. */
#include "popup.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "base/must.h"
#include "base/utf8.h"
#include "view/typed.h"

/* ---- creating ---- */

static struct popup *open_popup(struct app *app, enum popup_kind kind, const char *title, const char *path)
{
    ceduo_popup_close(app);
    struct popup *p = ceduo_check_memory(calloc(1, sizeof *p));
    p->kind = kind;
    p->title = ceduo_arena_string(&p->arena, title);
    p->path = ceduo_arena_string(&p->arena, path);
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

struct popup *ceduo_popup_list(struct app *app, const char *title, const char *path, popup_call *chosen)
{
    struct popup *p = open_popup(app, POPUP_LIST, title, path);
    p->chosen = chosen;
    return p;
}

struct popup *ceduo_popup_text(struct app *app, const char *title)
{
    return open_popup(app, POPUP_TEXT, title, "");
}

struct popup *ceduo_popup_fields(struct app *app, const char *title, const char *path, popup_check *filled)
{
    struct popup *p = open_popup(app, POPUP_FIELDS, title, path);
    p->filled = filled;
    return p;
}

void ceduo_popup_item(struct popup *p, const char *text, const char *value)
{
    ceduo_picker_add(&p->picker, text, text, value, false);
}

void ceduo_popup_answer(struct popup *p, char key, const char *text, const char *value)
{
    char line[256];
    assert((key >= '1' && key <= '9') || (key >= 'a' && key <= 'z')); /* only 1 to 9 */
    snprintf(line, sizeof line, "%c  %s", key, text);
    p->asks = true;
    ceduo_popup_item(p, line, value);
}

struct popup_field *ceduo_popup_field(struct popup *p, const char *label, const char *value)
{
    assert(p->fields_count < POPUP_FIELDS_MAX);
    struct popup_field *field = &p->fields[p->fields_count++];
    snprintf(field->label, sizeof field->label, "%s", label);
    ceduo_line_set(&field->line, value);
    return field;
}

struct popup_field *ceduo_popup_choice(struct popup *p, const char *label, const char *value, popup_call *offer)
{
    struct popup_field *field = ceduo_popup_field(p, label, value);
    field->offer = offer;
    return field;
}

const struct field ceduo_popup_amount = {
    .key = "", .type = FIELD_NUMBER, .unit = "", .scale = 1, .hi = INFINITY, .shown = {.per = 1, .most = INFINITY}};

struct field *ceduo_popup_value(struct popup *p, const char *label, const char *value, const struct field *kind)
{
    struct popup_field *field = ceduo_popup_field(p, label, value);
    struct field *own = ceduo_check_memory(ceduo_arena_alloc(&p->arena, sizeof *own));
    *own = *kind;
    own->shown.label = field->label;
    field->value = own;
    return own;
}

/* ---- input ---- */

bool ceduo_popup_confirm_unusual(struct app *app, const struct field *field, struct line *line)
{
    LOCAL_TEXT(why);
    bool good = ceduo_typed_in_range(field, line->text, &why);
    bool asks = good && !line->asked && ceduo_typed_unusual(field, line->text, &why);
    line->asked |= asks;
    if (why.bytes)
        ceduo_app_warn(app, "%s", why.bytes);
    return good && !asks;
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
            ceduo_app_warn(app, _("%s: it is needed; %s"), label, _(field->meaning));
        return !needed;
    }
    ceduo_typed_value(field, line->text, value);
    const char *written = ceduo_text_string(value);
    if (list ? written[0] == '[' : written[0] == '{' || ceduo_number_read(written, &number) == CEDUO_NUMBER_GOOD)
        return true;
    ceduo_app_warn(app, list ? _("%s: numbers with blanks between them, not '%s'") : _("%s: '%s' is not a number"), label,
                   line->text);
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

bool ceduo_popup_may_write(struct app *app, struct popup *p)
{
    struct line *line = &p->fields[0].line;
    if (access(line->text, F_OK) != 0 || line->asked)
        return true;
    line->asked = true;
    ceduo_app_warn(app, "%s", _("there is such a file already; Enter once more replaces it"));
    return false;
}

/* ---- completion ---- */

/* List the items for the text in the line under the cursor. */
static void offer(struct app *app, struct popup *p)
{
    const struct popup_field *field = &p->fields[p->at];
    const struct line *line = &field->line;
    p->ready = true;
    p->moved = false;
    if (field->offer || p->kind == POPUP_FIELDS)
        ceduo_picker_clear(&p->picker);
    if (field->offer)
        field->offer(app, p);
    ceduo_picker_filter(&p->picker, line->fresh ? "" : line->text);
    if (line->fresh)
        ceduo_picker_go_to(&p->picker, line->text);
    bool named = p->endings && ceduo_picker_is_file(line->text, p->endings);
    if (!line->fresh && field->offer && !p->typed_wins && named && !ceduo_picker_at(&p->picker) &&
        access(line->text, F_OK) != 0)
        ceduo_app_warn(app, _("there is no file '%.180s'"), line->text); /* not after the last question */
}

static void go_to_field(struct app *app, struct popup *p, size_t field)
{
    p->at = field;
    ceduo_line_set(&p->fields[field].line, p->fields[field].line.text);
    offer(app, p);
}

/* ---- keys ---- */

/* Return the number of lines that a key moves by; 0: none. `letters`: letters move, too, because nothing is typed. */
static int lines_of(int key, bool letters)
{
    static const int lines[ACTION_COUNT] = {[ACTION_UP] = -1,        [ACTION_DOWN] = 1,         [ACTION_PAGE_UP] = -10,
                                            [ACTION_PAGE_DOWN] = 10, [ACTION_TOP] = -ALL_LINES, [ACTION_BOTTOM] = ALL_LINES};
    enum action action = ceduo_action_find(key);
    return action != ACTION_NONE && (letters || ceduo_actions[action].key == key) ? lines[action] : 0;
}

static void text_key(struct app *app, struct popup *p, int key)
{
    int by = lines_of(key, true);
    viewport_scroll(&p->lines, by);
    if (by == 0)
        ceduo_popup_close(app);
}

/* Choose the item under the cursor. Detach the popup first: the callback may open another. */
static void choose(struct app *app, struct popup *p)
{
    const struct pick *pick = ceduo_picker_at(&p->picker);
    p->value = pick ? pick->value : p->endings && p->fields[0].line.text[0] ? p->fields[0].line.text : NULL;
    if (!p->value)
        return;
    app->popup = NULL;
    p->chosen(app, p);
    free_popup(p);
}

static void list_key(struct app *app, struct popup *p, int key)
{
    struct line *line = &p->fields[0].line;
    int by = lines_of(key, false);
    app->message[0] = '\0';
    if (key == K_ESCAPE) {
        ceduo_popup_close(app);
    } else if (key == K_ENTER) {
        choose(app, p);
    } else if (by != 0) {
        viewport_move(&p->picker.lines, by);
    } else if (p->asks) {
        for (size_t i = 0; i < p->picker.matches; i++)
            if (p->picker.picks[p->picker.order[i]].text[0] == key) {
                p->picker.lines.selected = (int)i;
                choose(app, p);
                return;
            }
    } else if (key == K_TAB ? ceduo_picker_complete(&p->picker, line) : ceduo_line_key(line, key)) {
        offer(app, p);
    }
}

static void submit(struct app *app, struct popup *p)
{
    app->popup = NULL;
    if (p->filled(app, p)) {
        free_popup(p);
        return;
    }
    ceduo_popup_close(app); /* the callback may have opened another */
    app->popup = p;
}

static void fields_key(struct app *app, struct popup *p, int key)
{
    struct popup_field *field = &p->fields[p->at];
    struct line *line = &field->line;
    bool last = p->at + 1 >= p->fields_count, listed = field->offer && p->picker.matches > 0;
    bool vertical = key == K_UP || key == K_DOWN || key == K_PAGE_UP || key == K_PAGE_DOWN;
    app->message[0] = '\0';
    ceduo_jobs_stop(app->live.jobs, JOB_SEARCH); /* stop the search of these fields */
    if (key == K_ESCAPE && p->at == 0) {
        ceduo_popup_close(app);
    } else if (key == K_ESCAPE || key == K_SHIFT_TAB || (key == K_UP && !listed)) {
        go_to_field(app, p, p->at > 0 ? p->at - 1 : 0);
    } else if (listed && vertical) {
        viewport_move(&p->picker.lines, lines_of(key, false));
        p->moved = true;
    } else if (key == K_TAB && p->endings && field->offer && ceduo_picker_complete(&p->picker, line)) {
        offer(app, p);
    } else if (key == K_TAB || key == K_DOWN || key == K_ENTER) {
        const struct pick *pick = field->offer ? ceduo_picker_at(&p->picker) : NULL;
        LOCAL_TEXT(value);
        if (pick && (p->moved || !(p->typed_wins || line->fresh)) && strcmp(line->text, pick->value) != 0)
            ceduo_line_set(line, pick->value); /* the matching item replaces the typed text */
        if (last && key == K_ENTER)
            submit(app, p);
        else if (!last && (!field->value || ceduo_popup_read(app, field->value, line, &value)) &&
                 (!p->check || p->check(app, p)))
            go_to_field(app, p, p->at + 1);
    } else if (ceduo_line_key(line, key)) {
        offer(app, p);
    }
}

/* Handle a key in a field of the form. */
static void field_key(struct app *app, struct popup *p, int key)
{
    bool enters = key == K_ENTER || key == K_TAB;
    app->message[0] = '\0';
    if (!enters)
        ceduo_line_key(&p->fields[0].line, key);
    if (key == K_ESCAPE || (enters && p->filled(app, p)))
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
    ceduo_app_text(app, (struct ceduo_area){r.left + 2, r.top, r.width - 4, 1}, CEDUO_ROLE_TITLE, title, 0);
}

/* Draw marks on the frame for lines above or below. */
static void draw_more(struct app *app, const struct popup *p, const struct viewport *lines)
{
    const struct ceduo_area *r = &p->box;
    const char *words[] = {_("more above"), _("more below")};
    for (int i = 0; i < 2; i++)
        if (i == 0 ? lines->first > 0 : viewport_has_more(lines))
            ceduo_app_label(app, r->left + r->width - 4 - (int)ceduo_utf8_width(words[i]),
                            i == 0 ? r->top : r->top + r->height - 1, CEDUO_ROLE_TITLE, " %s ", words[i]);
}

#define NOTE_LINES 6
#define LINES_MIN  6 /* min. lines below the note, if needed */

/* Draw a frame in the middle of the screen, with the note in its first lines. Return the area below the note. */
static struct ceduo_area draw_frame(struct app *app, struct popup *p, int lines, int note_lines)
{
    int width = app->width - 2 < 84 ? app->width - 2 : 84,
        wanted = ceduo_app_text_lines(app, ceduo_text_string(&p->text), width - 4);
    if (p->kind == POPUP_FIELDS) /* as high as the note; over a list the note changes with the cursor */
        note_lines = wanted < note_lines ? wanted : note_lines;
    note_lines = p->text.bytes || p->preview ? note_lines : 0;
    int max = app->height - 2, height = lines + note_lines + 2;
    note_lines = height > max && note_lines > max - 2 - LINES_MIN ? max - 2 - LINES_MIN : note_lines;
    height = height > max ? max : height;
    struct ceduo_area r = {(app->width - width) / 2, (app->height - height) / 2, width, height};
    struct ceduo_area in = {r.left + 2, r.top + 1, r.width - 4, r.height - 2};
    p->box = r;
    draw_box(app, r, p->title);
    LOCAL_TEXT(note);
    ceduo_text_append(&note, note_lines > 0 ? ceduo_text_string(&p->text) : "");
    ceduo_app_set_cursor(app, cut_top(&in, note_lines), CEDUO_ROLE_DIM, &note);
    return in;
}

static void draw_text(struct app *app, struct popup *p)
{
    struct ceduo_area in = draw_frame(app, p, app->height, 0);
    viewport_fit(&p->lines, in.height, ceduo_app_text_lines(app, ceduo_text_string(&p->text), in.width));
    ceduo_app_text(app, in, CEDUO_ROLE_TEXT, ceduo_text_string(&p->text), p->lines.first);
    draw_more(app, p, &p->lines);
}

static void draw_picks(struct app *app, struct popup *p, struct ceduo_area area)
{
    ceduo_picker_draw(&p->picker, app->cells, area);
    draw_more(app, p, &p->picker.lines);
}

/* Draw an input line, scrolled to its end. */
static void draw_line(struct app *app, const struct line *line, int x, int y, int width, bool cursor)
{
    int n = ceduo_cells_put_end(app->cells, x, y, width - 1, cursor ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, line->text);
    if (cursor)
        ceduo_cells_label(app->cells, x + n, y, CEDUO_ROLE_CURSOR, "_");
}

static void draw_list(struct app *app, struct popup *p)
{
    int lines = p->picker.count > 2 ? (int)p->picker.count : 2;
    struct ceduo_area in = draw_frame(app, p, lines + !p->asks, NOTE_LINES);
    if (!p->asks) {
        ceduo_app_label(app, in.left, in.top, CEDUO_ROLE_DIM, "%s", _("search:"));
        int x = in.left + (int)ceduo_utf8_width(_("search:")) + 1;
        draw_line(app, &p->fields[0].line, x, cut_top(&in, 1).top, in.left + in.width - x, true);
    }
    if (app->message[0] && !p->asks)
        ceduo_app_text(app, in, CEDUO_ROLE_WARN, app->message, 0);
    else if (p->picker.matches == 0 && !p->asks)
        ceduo_app_text(app, in, CEDUO_ROLE_DIM, _("nothing matches"), 0);
    else
        draw_picks(app, p, in);
}

#define FOOT_MIN      2  /* min. lines below the fields, for a message or items */
#define PICKS_SHOWN   6  /* items below the fields */
#define PICTURE_SHOWN 16 /* lines of a picture in place of items */

static void draw_fields(struct app *app, struct popup *p)
{
    int picks = 0;
    for (size_t i = 0; i < p->fields_count; i++)
        picks = p->fields[i].offer ? PICKS_SHOWN : picks;
    int below = p->picture ? PICTURE_SHOWN : picks;
    struct ceduo_area in = draw_frame(app, p, (int)p->fields_count + 2 + below, app->height);
    int x = in.left + 32, width = in.width - 32, n = (int)p->fields_count, at = (int)p->at;
    viewport_fit(&p->lines, n <= in.height - FOOT_MIN ? n : in.height - FOOT_MIN, n);
    viewport_show(&p->lines, at, at);
    for (int i = p->lines.first; i < p->lines.first + p->lines.rows; i++) {
        struct ceduo_area line = cut_top(&in, 1);
        ceduo_canvas_draw_text(&app->cells->canvas, line.left, line.top, 31, CEDUO_ROLE_DIM, p->fields[i].label);
        draw_line(app, &p->fields[i].line, x, line.top, width, i == at);
    }
    draw_more(app, p, &p->lines);
    struct ceduo_area first = {in.left, in.top, in.width, in.height < 2 ? in.height : 2};
    ceduo_app_text(app, first, CEDUO_ROLE_WARN, app->message, 0);
    if (p->picture && (!p->fields[p->at].offer || p->picker.matches == 0) && !app->message[0])
        p->picture(app, p, (struct ceduo_area){in.left, in.top + 1, in.width, in.height - 1});
    else if (!app->message[0])
        draw_picks(app, p, (struct ceduo_area){in.left + 2, in.top + 1, in.width - 2, in.height - 1});
}

/* ---- the open popup ---- */

static const struct {
    void (*key)(struct app *app, struct popup *popup, int key);
    void (*draw)(struct app *app, struct popup *popup);
    const char *bar;
} kinds[] = {[POPUP_TEXT] = {text_key, draw_text, N_("Up Down PgUp PgDn read on  any other key closes")},
             [POPUP_FIELD] = {field_key, NULL, N_("Enter takes the value  Esc leaves it as it was  empty: the default")},
             [POPUP_LIST] = {list_key, draw_list, N_("type to search  Enter choose  Esc cancel  Tab completes  Up Down move")},
             [POPUP_FIELDS] = {fields_key, draw_fields, N_("Enter next, at the last one done  Esc one back  Tab completes")}};

void ceduo_popup_key(struct app *app, int key)
{
    kinds[app->popup->kind].key(app, app->popup, key);
}

bool ceduo_popup_paste(struct app *app, const char *text)
{
    struct popup *p = app->popup;
    if (p->kind == POPUP_TEXT || p->asks)
        return false;
    if (p->kind == POPUP_FIELDS)
        ceduo_jobs_stop(app->live.jobs, JOB_SEARCH); /* as a key does */
    if (ceduo_line_paste(&p->fields[p->at].line, text))
        offer(app, p);
    else
        ceduo_app_warn(app, "%s", _("what was pasted is too long for this line, which stays as it was"));
    return true;
}

const char *ceduo_popup_bar(const struct app *app)
{
    return app->popup->asks ? _("a letter, or Up Down and Enter  Esc cancel") : _(kinds[app->popup->kind].bar);
}

/* Rebuild the note. */
static void preview(struct app *app, struct popup *p)
{
    ceduo_text_free(&p->text);
    p->preview(app, p);
}

void ceduo_popup_browse(struct app *app)
{
    struct popup *p = app->popup;
    if (!p->ready)
        offer(app, p);
    const struct pick *pick = ceduo_picker_at(&p->picker);
    if (p->kind == POPUP_TEXT || !p->preview || !pick || p->value == pick->value)
        return;
    p->value = pick->value;
    p->ahead_known = false;
    preview(app, p);
}

void ceduo_popup_previewed(struct app *app, const struct preview *ahead)
{
    struct popup *p = app->popup;
    if (!p || p->kind == POPUP_TEXT || !p->preview || !p->value)
        return;
    p->ahead = *ahead;
    p->ahead_known = true;
    preview(app, p);
}

void ceduo_popup_draw(struct app *app)
{
    struct popup *p = app->popup;
    if (p->kind == POPUP_TEXT && p->preview)
        preview(app, p);
    if (kinds[p->kind].draw)
        kinds[p->kind].draw(app, p);
}
