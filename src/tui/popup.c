/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Implements popups of three kinds: text to read, a list to choose from, fields to fill. A popup is closed before its
 * callback runs, because that may open another. */
#include "popup.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/grow.h"
#include "base/intl.h"
#include "base/utf8.h"

/* ---- making ---- */

static struct popup *open_popup(struct app *app, enum popup_kind kind, const char *title)
{
    ceduo_popup_close(app);
    struct popup *p = calloc(1, sizeof *p);
    if (!p) {
        ceduo_app_warn(app, "%s", _("out of memory"));
        return NULL;
    }
    p->kind = kind;
    snprintf(p->title, sizeof p->title, "%s", title);
    app->popup = p;
    return p;
}

static void free_popup(struct popup *p)
{
    ceduo_arena_free(&p->arena);
    free(p->items);
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
    if (p)
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
    if (p)
        p->filled = filled;
    return p;
}

void ceduo_popup_item(struct popup *p, const char *text, const char *value)
{
    struct popup_item *items = p ? ceduo_grow(p->items, p->items_count, &p->items_room, sizeof *items) : NULL;
    if (!items)
        return;
    p->items = items;
    struct text safe = {0};
    ceduo_text_safe(&safe, text);
    const char *shown = ceduo_arena_string(&p->arena, ceduo_text_string(&safe));
    const char *kept = ceduo_arena_string(&p->arena, value);
    ceduo_text_free(&safe);
    if (shown && kept)
        p->items[p->items_count++] = (struct popup_item){shown, kept};
}

void ceduo_popup_field(struct popup *p, const char *label, const char *value)
{
    if (!p || p->fields_count == POPUP_FIELDS_MOST)
        return;
    snprintf(p->labels[p->fields_count], sizeof p->labels[0], "%s", label);
    ceduo_line_set(&p->fields[p->fields_count++], value);
}

bool ceduo_popup_may_write(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].text;
    if (access(path, F_OK) != 0 || (p->kept && strcmp(p->kept, path) == 0))
        return true;
    free(p->kept);
    p->kept = strdup(path);
    ceduo_app_warn(app, "%s", _("there is such a file already; Enter once more replaces it"));
    return false;
}

/* ---- keys ---- */

static void move(struct popup *p, int by, size_t n)
{
    long at = (long)p->at + by;
    at = at < 0 ? 0 : at >= (long)n ? (long)n - 1 : at;
    p->at = n > 0 ? (size_t)at : 0;
}

/* Returns how many lines a key moves by; 0 if it does not move. */
static int lines_of(int key)
{
    switch (ceduo_action_of(key)) {
    case ACTION_UP: return -1;
    case ACTION_DOWN: return 1;
    case ACTION_PAGE_UP: return -10;
    case ACTION_PAGE_DOWN: return 10;
    case ACTION_TOP: return -100000;
    case ACTION_BOTTOM: return 100000;
    default: return 0;
    }
}

static void text_key(struct app *app, struct popup *p, int key)
{
    int by = lines_of(key);
    p->top = p->top + by > 0 ? p->top + by : 0;
    if (by == 0)
        ceduo_popup_close(app);
}

static void list_key(struct app *app, struct popup *p, int key)
{
    if (key == K_ESCAPE || key == 'q') {
        ceduo_popup_close(app);
    } else if (key == K_ENTER && p->items_count > 0) {
        app->popup = NULL;
        p->chosen(app, p, p->items[p->at].value);
        free_popup(p);
    } else {
        move(p, lines_of(key), p->items_count);
    }
}

static void fields_key(struct app *app, struct popup *p, int key)
{
    bool last = p->at + 1 >= p->fields_count;
    p->message[0] = '\0';
    ceduo_jobs_stop_seek(app->figures.jobs); /* that these fields asked for */
    if (key == K_ESCAPE) {
        ceduo_popup_close(app);
    } else if (key == K_UP || key == K_SHIFT_TAB) {
        move(p, -1, p->fields_count);
    } else if (key == K_DOWN || key == K_TAB || (key == K_ENTER && !last)) {
        move(p, 1, p->fields_count);
    } else if (key == K_ENTER) {
        app->message[0] = '\0';
        app->popup = NULL;
        if (p->filled(app, p)) {
            free_popup(p);
            return;
        }
        app->popup = p;
        snprintf(p->message, sizeof p->message, "%.*s", (int)sizeof p->message - 1, app->message);
    } else {
        ceduo_line_key(&p->fields[p->at], key);
    }
}

/* ---- drawing ---- */

static void draw_box(struct app *app, struct ceduo_area r, const char *title)
{
    static const char *const corners[2][2] = {{"\xe2\x94\x8c", "\xe2\x94\x90"}, {"\xe2\x94\x94", "\xe2\x94\x98"}};
    for (int y = 0; y < r.height; y++)
        for (int x = 0; x < r.width; x++) {
            bool upright = x == 0 || x == r.width - 1, level = y == 0 || y == r.height - 1;
            const char *c = upright && level ? corners[y > 0][x > 0]
                            : level          ? "\xe2\x94\x80"
                            : upright        ? "\xe2\x94\x82"
                                             : " ";
            ceduo_cells_label(app->cells, r.left + x, r.top + y, CEDUO_ROLE_AXIS, c);
        }
    ceduo_app_text(app, (struct ceduo_area){r.left + 2, r.top, r.width - 4, 1}, CEDUO_ROLE_TITLE, title, NULL);
}

/* Marks on the edge of the box that there is more above or below. */
static void draw_more(struct app *app, const struct popup *p, bool above, bool below)
{
    const struct ceduo_area *r = &p->box;
    const char *words[] = {_(" more above "), _(" more below ")};
    for (int i = 0; i < 2; i++)
        if (i == 0 ? above : below)
            ceduo_app_label(app, r->left + r->width - 2 - (int)ceduo_utf8_width(words[i]),
                            i == 0 ? r->top : r->top + r->height - 1, CEDUO_ROLE_TITLE, "%s", words[i]);
}

/* Draws a box in the middle of the screen, with its note in the first lines. Returns the area below the note. */
static struct ceduo_area draw_frame(struct app *app, struct popup *p, int lines, int note_lines)
{
    note_lines = p->text.bytes ? note_lines : 0;
    int width = app->width - 2 < 84 ? app->width - 2 : 84, height = lines + note_lines + 2;
    height = height > app->height - 2 ? app->height - 2 : height;
    struct ceduo_area r = {(app->width - width) / 2, (app->height - height) / 2, width, height};
    struct ceduo_area in = {r.left + 2, r.top + 1, r.width - 4, note_lines};
    p->box = r;
    draw_box(app, r, p->title);
    if (note_lines > 0)
        ceduo_app_text(app, in, CEDUO_ROLE_DIM, p->text.bytes, NULL);
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

static void draw_list(struct app *app, struct popup *p)
{
    struct ceduo_area in = draw_frame(app, p, (int)p->items_count, 3);
    int at = (int)p->at, n = (int)p->items_count;
    p->top = at < p->top ? at : at >= p->top + in.height ? at + 1 - in.height : p->top;
    for (int i = p->top; i < p->top + in.height && i < n; i++)
        ceduo_canvas_put(&app->cells->canvas, in.left, in.top + i - p->top, in.width,
                         i == at ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, p->items[i].text);
    draw_more(app, p, p->top > 0, p->top + in.height < n);
}

static void draw_fields(struct app *app, struct popup *p)
{
    struct ceduo_area in = draw_frame(app, p, (int)p->fields_count + 2, 4);
    int x = in.left + 32, width = in.width - 32;
    for (size_t i = 0; i < p->fields_count; i++) {
        int y = in.top + (int)i;
        ceduo_app_text(app, (struct ceduo_area){in.left, y, 31, 1}, CEDUO_ROLE_DIM, p->labels[i], NULL);
        int n = ceduo_cells_put_end(app->cells, x, y, width - 1, i == p->at ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT,
                                    p->fields[i].text);
        if (i == p->at)
            ceduo_cells_label(app->cells, x + n, y, CEDUO_ROLE_CURSOR, "_");
    }
    in.top += in.height - 1;
    in.height = 1;
    ceduo_app_text(app, in, CEDUO_ROLE_WARN, p->message, NULL);
}

/* ---- the one that is open ---- */

static const struct {
    void (*key)(struct app *app, struct popup *popup, int key);
    void (*draw)(struct app *app, struct popup *popup);
    const char *bar;
} kinds[] = {
    [POPUP_TEXT] = {text_key, draw_text, N_("Up Down PgUp PgDn read on  any other key closes")},
    [POPUP_LIST] = {list_key, draw_list, N_("Up Down move  Enter choose  Esc never mind")},
    [POPUP_FIELDS] = {fields_key, draw_fields, N_("Enter next, at the last one done  Up back  Esc never mind")}};

void ceduo_popup_key(struct app *app, int key)
{
    kinds[app->popup->kind].key(app, app->popup, key);
}

const char *ceduo_popup_bar(const struct app *app)
{
    return _(kinds[app->popup->kind].bar);
}

void ceduo_popup_draw(struct app *app)
{
    struct popup *p = app->popup;
    if (p->preview && (p->kind != POPUP_LIST || p->items_count > 0))
        p->preview(app, p, p->kind == POPUP_LIST ? p->items[p->at].value : "");
    kinds[p->kind].draw(app, p);
}
