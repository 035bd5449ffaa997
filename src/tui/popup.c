/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Implements popups of three kinds: text to read, a list to choose from, fields to fill. A popup is closed before its
 * callback runs, because that may open another. */
#include "popup.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/language.h"
#include "base/must.h"
#include "base/utf8.h"
#include "view/typed.h"

/* ---- making ---- */

static struct popup *open_popup(struct app *app, enum popup_kind kind, const char *title)
{
    ceduo_popup_close(app);
    struct popup *p = ceduo_must(calloc(1, sizeof *p));
    p->kind = kind;
    snprintf(p->title, sizeof p->title, "%s", title);
    app->popup = p;
    return p;
}

static void free_popup(struct popup *p)
{
    ceduo_arena_free(&p->arena);
    ceduo_picker_clear(&p->picker);
    ceduo_text_free(&p->text);
    free(p->kept);
    free(p);
}

void ceduo_popup_close(struct app *app)
{
    if (app->popup)
        free_popup(app->popup);
    app->popup = NULL;
}

struct popup *ceduo_popup_list(struct app *app, const char *title, popup_chosen *chosen)
{
    struct popup *p = open_popup(app, POPUP_LIST, title);
    p->chosen = chosen;
    return p;
}

struct popup *ceduo_popup_text(struct app *app, const char *title)
{
    return open_popup(app, POPUP_TEXT, title);
}

struct popup *ceduo_popup_fields(struct app *app, const char *title, popup_filled *filled)
{
    struct popup *p = open_popup(app, POPUP_FIELDS, title);
    p->filled = filled;
    return p;
}

void ceduo_popup_item(struct popup *p, const char *text, const char *value)
{
    ceduo_picker_add(&p->picker, text, value, false);
}

void ceduo_popup_answer(struct popup *p, char key, const char *text, const char *value)
{
    char line[256];
    snprintf(line, sizeof line, "%c  %s", key, text);
    p->asks = true;
    ceduo_popup_item(p, line, value);
}

void ceduo_popup_field(struct popup *p, const char *label, const char *value)
{
    ceduo_popup_choice(p, label, value, NULL);
}

void ceduo_popup_choice(struct popup *p, const char *label, const char *value, popup_offer *offer)
{
    if (p->fields_count == POPUP_FIELDS_MAX)
        return;
    snprintf(p->labels[p->fields_count], sizeof p->labels[0], "%s", label);
    p->offers[p->fields_count] = offer;
    ceduo_line_set(&p->fields[p->fields_count++], value);
}

bool ceduo_popup_number(struct app *app, const struct popup *p, size_t field, double *value)
{
    if (ceduo_typed_number(p->fields[field].text, value) == CEDUO_NUMBER_GOOD)
        return true;
    ceduo_app_warn(app, _("%s: '%s' is not a number"), p->labels[field], p->fields[field].text);
    return false;
}

bool ceduo_popup_value(struct app *app, const struct field *field, const char *typed, double *value)
{
    struct text written = {0}, why = {0};
    bool good = !field || ceduo_typed_in_range(field, typed, &why);
    if (!good)
        ceduo_app_warn(app, "%s", ceduo_text_string(&why));
    ceduo_typed_value(field, typed, &written);
    good = good && ceduo_number_read(ceduo_text_string(&written), value) == CEDUO_NUMBER_GOOD;
    ceduo_text_free(&written);
    ceduo_text_free(&why);
    return good;
}

bool ceduo_popup_may_write(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].text;
    if (access(path, F_OK) != 0 || (p->kept && strcmp(p->kept, path) == 0))
        return true;
    free(p->kept);
    p->kept = ceduo_must(strdup(path));
    ceduo_app_warn(app, "%s", _("there is such a file already; Enter once more replaces it"));
    return false;
}

/* ---- what is offered ---- */

/* Shows in the popup what was said. */
static void take_message(struct app *app, struct popup *p)
{
    snprintf(p->message, sizeof p->message, "%.*s", (int)sizeof p->message - 1, app->message);
}

/* The items for what is typed into the line under the cursor. */
static void offer(struct app *app, struct popup *p)
{
    p->ready = true;
    p->moved = false;
    const struct line *line = &p->fields[p->at];
    popup_offer *fill = p->offers[p->at];
    if (fill || p->kind == POPUP_FIELDS)
        ceduo_picker_clear(&p->picker);
    if (fill)
        fill(app, p, line->text);
    ceduo_picker_filter(&p->picker, line->fresh ? "" : line->text);
    if (line->fresh)
        ceduo_picker_go_to(&p->picker, line->text);
    size_t n = strlen(line->text), end = p->endings ? strlen(p->endings) : 0;
    bool named = n > end && end > 0 && strcmp(line->text + n - end, p->endings) == 0;
    if (!line->fresh && fill && !p->typed_wins && named && !ceduo_picker_at(&p->picker) && access(line->text, F_OK) != 0)
        snprintf(p->message, sizeof p->message, _("there is no file '%.180s'"), line->text); /* not after the last question */
}

static void go_to_field(struct app *app, struct popup *p, size_t field)
{
    p->at = field;
    ceduo_line_set(&p->fields[field], p->fields[field].text);
    offer(app, p);
}

/* ---- keys ---- */

/* Returns how many lines a key moves by, letters only where nothing is typed; 0 if it does not move. */
static int lines_of(int key, bool letters)
{
    static const struct {
        int key, letter, lines;
    } keys[] = {{K_UP, 'k', -1},      {K_DOWN, 'j', 1},       {K_PAGE_UP, 0, -10},
                {K_PAGE_DOWN, 0, 10}, {K_HOME, 'g', -100000}, {K_END, 'G', 100000}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (key == keys[i].key || (letters && key != 0 && key == keys[i].letter))
            return keys[i].lines;
    return 0;
}

static void text_key(struct app *app, struct popup *p, int key)
{
    int by = lines_of(key, true);
    p->top = p->top + by > 0 ? p->top + by : 0;
    if (by == 0)
        ceduo_popup_close(app);
}

/* Takes the popup off the screen for its callback, which may open another. */
static void choose(struct app *app, struct popup *p)
{
    const struct pick *pick = ceduo_picker_at(&p->picker);
    const char *value = pick ? pick->value : p->endings && p->fields[0].text[0] ? p->fields[0].text : NULL;
    if (!value)
        return;
    app->popup = NULL;
    p->chosen(app, p, value);
    free_popup(p);
}

static void list_key(struct app *app, struct popup *p, int key)
{
    int by = lines_of(key, false);
    p->message[0] = '\0';
    if (key == K_ESCAPE) {
        ceduo_popup_close(app);
    } else if (key == K_ENTER) {
        choose(app, p);
    } else if (by != 0) {
        ceduo_picker_move(&p->picker, by);
    } else if (p->asks) {
        for (size_t i = 0; i < p->picker.matches; i++)
            if (p->picker.picks[p->picker.order[i]].text[0] == key) {
                p->picker.at = i;
                choose(app, p);
                return;
            }
    } else if (key == K_TAB) {
        if (ceduo_picker_complete(&p->picker, &p->fields[0]))
            offer(app, p);
    } else if (ceduo_line_key(&p->fields[0], key)) {
        offer(app, p);
    }
}

/* Goes on, unless something is wrong with the field. */
static void leave_field(struct app *app, struct popup *p)
{
    app->message[0] = '\0';
    if (!p->check || p->check(app, p, p->at))
        go_to_field(app, p, p->at + 1);
    else
        take_message(app, p);
    app->message[0] = '\0';
}

static void submit(struct app *app, struct popup *p)
{
    app->message[0] = '\0';
    app->popup = NULL;
    if (p->filled(app, p)) {
        free_popup(p);
        return;
    }
    ceduo_popup_close(app); /* it may have opened another */
    app->popup = p;
    take_message(app, p);
}

static void fields_key(struct app *app, struct popup *p, int key)
{
    bool last = p->at + 1 >= p->fields_count, listed = p->offers[p->at] && p->picker.matches > 0;
    int by = lines_of(key, false);
    bool vertical = key == K_UP || key == K_DOWN || key == K_PAGE_UP || key == K_PAGE_DOWN;
    p->message[0] = '\0';
    ceduo_jobs_stop(app->live.jobs, JOB_SEARCH); /* that these fields asked for */
    if (key == K_ESCAPE && p->at == 0) {
        ceduo_popup_close(app);
    } else if (key == K_ESCAPE || key == K_SHIFT_TAB || (key == K_UP && !listed)) {
        go_to_field(app, p, p->at > 0 ? p->at - 1 : 0);
    } else if (listed && vertical) {
        ceduo_picker_move(&p->picker, by);
        p->moved = true;
    } else if (key == K_TAB && p->endings && p->offers[p->at] && ceduo_picker_complete(&p->picker, &p->fields[p->at])) {
        offer(app, p);
    } else if (key == K_TAB || key == K_DOWN || key == K_ENTER) {
        const struct pick *pick = p->offers[p->at] ? ceduo_picker_at(&p->picker) : NULL;
        struct line *line = &p->fields[p->at];
        if (pick && (p->moved || !(p->typed_wins || line->fresh))) /* what matches takes the place of what was typed */
            ceduo_line_set(line, pick->value);
        if (!last)
            leave_field(app, p);
        else if (key == K_ENTER)
            submit(app, p);
    } else if (ceduo_line_key(&p->fields[p->at], key)) {
        offer(app, p);
    }
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
            if (!upright && !level)
                continue;
            ceduo_cells_label(app->cells, r.left + x, r.top + y, CEDUO_ROLE_AXIS, c);
        }
    ceduo_app_text(app, (struct ceduo_area){r.left + 2, r.top, r.width - 4, 1}, CEDUO_ROLE_TITLE, title, NULL);
}

/* Marks on the edge of the box that there is more above or below. */
static void draw_more(struct app *app, const struct popup *p, bool above, bool below)
{
    const struct ceduo_area *r = &p->box;
    const char *words[] = {_("more above"), _("more below")};
    for (int i = 0; i < 2; i++)
        if (i == 0 ? above : below)
            ceduo_app_label(app, r->left + r->width - 4 - (int)ceduo_utf8_width(words[i]),
                            i == 0 ? r->top : r->top + r->height - 1, CEDUO_ROLE_TITLE, " %s ", words[i]);
}

#define NOTE_LINES 5
#define LINES_MIN  6 /* below it, where there are so many */

/* Draws a box in the middle of the screen, with its note in the first lines. Returns the area below the note. */
static struct ceduo_area draw_frame(struct app *app, struct popup *p, int lines, int note_lines)
{
    int width = app->width - 2 < 84 ? app->width - 2 : 84, wanted = note_lines;
    if (p->kind == POPUP_FIELDS && p->text.bytes) /* no more than it takes; over a list it changes with the cursor */
        ceduo_app_text(app, (struct ceduo_area){0, 0, width - 4, 0}, CEDUO_ROLE_DIM, p->text.bytes, &wanted);
    note_lines = p->text.bytes ? wanted : 0;
    int max = app->height - 2, height = lines + note_lines + 2;
    note_lines = height > max && note_lines > max - 2 - LINES_MIN ? max - 2 - LINES_MIN : note_lines;
    height = height > max ? max : height;
    struct ceduo_area r = {(app->width - width) / 2, (app->height - height) / 2, width, height};
    struct ceduo_area in = {r.left + 2, r.top + 1, r.width - 4, note_lines};
    p->box = r;
    draw_box(app, r, p->title);
    LOCAL_TEXT(note);
    ceduo_text_put(&note, note_lines > 0 ? p->text.bytes : "");
    ceduo_app_put(app, in, CEDUO_ROLE_DIM, &note);
    in.top += note_lines;
    in.height = r.height - 2 - note_lines;
    return in;
}

static void draw_text(struct app *app, struct popup *p)
{
    struct ceduo_area in = draw_frame(app, p, app->height, 0);
    bool more = ceduo_app_text(app, in, CEDUO_ROLE_TEXT, ceduo_text_string(&p->text), &p->top);
    draw_more(app, p, p->top > 0, more);
}

static void draw_picks(struct app *app, struct popup *p, struct ceduo_area area)
{
    int more = ceduo_picker_draw(&p->picker, app->cells, area);
    draw_more(app, p, more & 1, more & 2);
}

/* A line that is typed into, its end in sight. */
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
    if (p->asks) {
        draw_picks(app, p, in);
        return;
    }
    ceduo_app_label(app, in.left, in.top, CEDUO_ROLE_DIM, "%s", _("search:"));
    int x = in.left + (int)ceduo_utf8_width(_("search:")) + 1;
    draw_line(app, &p->fields[0], x, in.top, in.left + in.width - x, true);
    in.top++;
    in.height--;
    if (p->message[0])
        ceduo_app_text(app, in, CEDUO_ROLE_WARN, p->message, NULL);
    else if (p->picker.matches == 0)
        ceduo_app_text(app, in, CEDUO_ROLE_DIM, _("nothing matches"), NULL);
    else
        draw_picks(app, p, in);
}

#define FOOT_MIN      2  /* lines below the fields, of a message or of what is offered */
#define PICKS_SHOWN   6  /* below the fields */
#define PICTURE_SHOWN 16 /* or a picture instead */

static void draw_fields(struct app *app, struct popup *p)
{
    int picks = 0;
    for (size_t i = 0; i < p->fields_count; i++)
        picks = p->offers[i] ? PICKS_SHOWN : picks;
    int below = p->picture ? PICTURE_SHOWN : picks;
    struct ceduo_area in = draw_frame(app, p, (int)p->fields_count + 2 + below, app->height);
    int x = in.left + 32, width = in.width - 32, n = (int)p->fields_count, at = (int)p->at;
    int shown = n <= in.height - FOOT_MIN ? n : in.height - FOOT_MIN;
    p->top = at < p->top ? at : at >= p->top + shown ? at + 1 - shown : p->top;
    for (int i = p->top; i < p->top + shown; i++, in.top++, in.height--) {
        ceduo_canvas_put(&app->cells->canvas, in.left, in.top, 31, CEDUO_ROLE_DIM, p->labels[i]);
        draw_line(app, &p->fields[i], x, in.top, width, i == at);
    }
    if (shown < n)
        draw_more(app, p, p->top > 0, p->top + shown < n);
    struct ceduo_area first = {in.left, in.top, in.width, in.height < 2 ? in.height : 2};
    ceduo_app_text(app, first, CEDUO_ROLE_WARN, p->message, NULL);
    if (p->picture && (!p->offers[p->at] || p->picker.matches == 0) && !p->message[0])
        p->picture(app, p, (struct ceduo_area){in.left, in.top + 1, in.width, in.height - 1});
    else if (!p->message[0])
        draw_picks(app, p, (struct ceduo_area){in.left + 2, in.top + 1, in.width - 2, in.height - 1});
}

/* ---- the one that is open ---- */

static const struct {
    void (*key)(struct app *app, struct popup *popup, int key);
    void (*draw)(struct app *app, struct popup *popup);
    const char *bar;
} kinds[] = {[POPUP_TEXT] = {text_key, draw_text, N_("Up Down PgUp PgDn read on  any other key closes")},
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
    p->message[0] = '\0';
    if (ceduo_line_paste(&p->fields[p->at], text))
        offer(app, p);
    else
        snprintf(p->message, sizeof p->message, "%s", _(CEDUO_LINE_FULL));
    return true;
}

const char *ceduo_popup_bar(const struct app *app)
{
    return app->popup->asks ? _("a letter, or Up Down and Enter  Esc cancel") : _(kinds[app->popup->kind].bar);
}

void ceduo_popup_look(struct app *app)
{
    struct popup *p = app->popup;
    if (!p->ready)
        offer(app, p);
    const struct pick *pick = ceduo_picker_at(&p->picker);
    if (p->kind == POPUP_TEXT || !p->preview || !pick || strcmp(p->previewed, pick->value) == 0)
        return;
    snprintf(p->previewed, sizeof p->previewed, "%s", pick->value);
    p->ahead_known = false;
    p->preview(app, p, pick->value);
}

void ceduo_popup_previewed(struct app *app, const struct preview *preview)
{
    struct popup *p = app->popup;
    if (!p || p->kind == POPUP_TEXT || !p->preview || !p->previewed[0])
        return;
    p->ahead = *preview;
    p->ahead_known = true;
    p->preview(app, p, p->previewed);
}

void ceduo_popup_draw(struct app *app)
{
    struct popup *p = app->popup;
    if (p->kind == POPUP_TEXT && p->preview)
        p->preview(app, p, "");
    kinds[p->kind].draw(app, p);
}
