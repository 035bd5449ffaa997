/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Popups of three kinds: text to read, a list to choose from, fields to fill. One that is done with is taken off before
 * what it leads to, which may open another. */
#include "popup.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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
    if (!p)
        return;
    if (p->items_count == p->items_room) {
        size_t room = p->items_room ? 2 * p->items_room : 32;
        struct popup_item *items = realloc(p->items, room * sizeof *items);
        if (!items)
            return;
        p->items = items;
        p->items_room = room;
    }
    struct text safe = {0};
    ceduo_text_safe(&safe, text);
    const char *shown = ceduo_arena_string(&p->arena, safe.bytes ? safe.bytes : "");
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

static void text_key(struct app *app, int key)
{
    struct popup *p = app->popup;
    switch (ceduo_action_of(key)) {
    case ACTION_UP: p->top -= p->top > 0; break;
    case ACTION_DOWN: p->top++; break;
    case ACTION_PAGE_UP: p->top = p->top > 10 ? p->top - 10 : 0; break;
    case ACTION_PAGE_DOWN: p->top += 10; break;
    case ACTION_TOP: p->top = 0; break;
    case ACTION_BOTTOM: p->top = 10000; break;
    default: ceduo_popup_close(app); break;
    }
}

static void list_key(struct app *app, int key)
{
    struct popup *p = app->popup;
    if (key == K_ESCAPE || key == 'q') {
        ceduo_popup_close(app);
        return;
    }
    if (key == K_ENTER && p->items_count > 0) {
        app->popup = NULL;
        p->chosen(app, p, p->items[p->at].value);
        free_popup(p);
        return;
    }
    switch (ceduo_action_of(key)) {
    case ACTION_UP: move(p, -1, p->items_count); break;
    case ACTION_DOWN: move(p, 1, p->items_count); break;
    case ACTION_PAGE_UP: move(p, -10, p->items_count); break;
    case ACTION_PAGE_DOWN: move(p, 10, p->items_count); break;
    case ACTION_TOP: p->at = 0; break;
    case ACTION_BOTTOM: move(p, 100000, p->items_count); break;
    default: break;
    }
}

static void fields_key(struct app *app, int key)
{
    struct popup *p = app->popup;
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

void ceduo_popup_key(struct app *app, int key)
{
    switch (app->popup->kind) {
    case POPUP_TEXT:
        text_key(app, key);
        break;
    case POPUP_LIST:
        list_key(app, key);
        break;
    case POPUP_FIELDS:
        fields_key(app, key);
        break;
    }
}

/* ---- drawing ---- */

static void draw_box(struct app *app, struct ceduo_area r, const char *title)
{
    for (int y = r.top; y < r.top + r.height; y++)
        for (int x = r.left; x < r.left + r.width; x++) {
            bool top = y == r.top, bottom = y == r.top + r.height - 1;
            bool left = x == r.left, right = x == r.left + r.width - 1;
            const char *c = top && left       ? "\xe2\x94\x8c"
                            : top && right    ? "\xe2\x94\x90"
                            : bottom && left  ? "\xe2\x94\x94"
                            : bottom && right ? "\xe2\x94\x98"
                            : top || bottom   ? "\xe2\x94\x80"
                            : left || right   ? "\xe2\x94\x82"
                                              : " ";
            ceduo_cells_label(app->cells, x, y, CEDUO_ROLE_AXIS, c);
        }
    struct ceduo_area head = {r.left + 2, r.top, r.width - 4, 1};
    ceduo_app_text(app, head, CEDUO_ROLE_TITLE, title, 0);
}

/* Says on the edge of a box that what is in it goes on. */
static void draw_more(struct app *app, struct ceduo_area r, bool above, bool below)
{
    const char *words[] = {_(" more above "), _(" more below ")};
    for (int i = 0; i < 2; i++)
        if (i == 0 ? above : below)
            ceduo_app_label(app, r.left + r.width - 2 - (int)ceduo_utf8_width(words[i]), i == 0 ? r.top : r.top + r.height - 1,
                            CEDUO_ROLE_TITLE, "%s", words[i]);
}

/* A rectangle in the middle, as large as the screen allows. */
static struct ceduo_area middle(const struct app *app, int width, int height)
{
    width = width > app->width - 2 ? app->width - 2 : width;
    height = height > app->height - 2 ? app->height - 2 : height;
    return (struct ceduo_area){(app->width - width) / 2, (app->height - height) / 2, width, height};
}

static void draw_text(struct app *app, struct popup *p)
{
    if (p->preview)
        p->preview(app, p, "");
    struct ceduo_area r = middle(app, 84, app->height - 2);
    draw_box(app, r, p->title);
    struct ceduo_area in = {r.left + 2, r.top + 1, r.width - 4, r.height - 2};
    const char *text = p->text.bytes ? p->text.bytes : "";
    struct ceduo_area none = {0, 0, in.width, 0};
    int lines = ceduo_app_text(app, none, CEDUO_ROLE_TEXT, text, 0);
    int most = lines > in.height ? lines - in.height : 0;
    p->top = (int)p->top > most ? (size_t)most : p->top;
    ceduo_app_text(app, in, CEDUO_ROLE_TEXT, text, (int)p->top);
    draw_more(app, r, p->top > 0, (int)p->top < most);
}

static void draw_list(struct app *app, struct popup *p)
{
    if (p->preview && p->items_count > 0)
        p->preview(app, p, p->items[p->at].value);
    int note_lines = p->text.bytes ? 3 : 0;
    struct ceduo_area r = middle(app, 84, (int)p->items_count + 2 + note_lines);
    draw_box(app, r, p->title);
    size_t room = (size_t)(r.height - 2 - note_lines);
    if (p->at < p->top)
        p->top = p->at;
    if (p->at >= p->top + room)
        p->top = p->at + 1 - room;
    for (size_t i = 0; i < room && p->top + i < p->items_count; i++) {
        bool here = p->top + i == p->at;
        ceduo_cells_put(app->cells, r.left + 2, r.top + 1 + note_lines + (int)i, r.width - 4,
                       here ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, p->items[p->top + i].text);
    }
    draw_more(app, r, p->top > 0, p->top + room < p->items_count);
    struct ceduo_area note = {r.left + 2, r.top + 1, r.width - 4, note_lines};
    if (p->text.bytes)
        ceduo_app_text(app, note, CEDUO_ROLE_DIM, p->text.bytes, 0);
}

static void draw_fields(struct app *app, struct popup *p)
{
    int note_lines = p->text.bytes ? 4 : 0;
    struct ceduo_area r = middle(app, 84, (int)p->fields_count + 4 + note_lines);
    draw_box(app, r, p->title);
    struct ceduo_area note = {r.left + 2, r.top + 1, r.width - 4, note_lines};
    if (p->text.bytes)
        ceduo_app_text(app, note, CEDUO_ROLE_DIM, p->text.bytes, 0);
    for (size_t i = 0; i < p->fields_count; i++) {
        int y = r.top + 1 + note_lines + (int)i, x = r.left + 34;
        struct ceduo_area label = {r.left + 2, y, 31, 1}, value = {x, y, r.width - 36, 1};
        ceduo_app_text(app, label, CEDUO_ROLE_DIM, p->labels[i], 0);
        const char *text = ceduo_utf8_end(p->fields[i].text, value.width > 1 ? (size_t)value.width - 1 : 0);
        ceduo_cells_label(app->cells, value.left, y, i == p->at ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT, text);
        if (i == p->at)
            ceduo_cells_label(app->cells, value.left + (int)ceduo_utf8_width(text), y, CEDUO_ROLE_CURSOR, "_");
    }
    struct ceduo_area foot = {r.left + 2, r.top + r.height - 2, r.width - 4, 1};
    if (p->message[0])
        ceduo_app_text(app, foot, CEDUO_ROLE_WARN, p->message, 0);
}

const char *ceduo_popup_bar(const struct app *app)
{
    static const char *const bars[] = {[POPUP_TEXT] = N_("Up Down PgUp PgDn read on  any other key closes"),
                                       [POPUP_LIST] = N_("Up Down move  Enter choose  Esc never mind"),
                                       [POPUP_FIELDS] = N_("Enter next, at the last one done  Up back  Esc never mind")};
    return _(bars[app->popup->kind]);
}

void ceduo_popup_draw(struct app *app)
{
    struct popup *p = app->popup;
    switch (p->kind) {
    case POPUP_TEXT:
        draw_text(app, p);
        break;
    case POPUP_LIST:
        draw_list(app, p);
        break;
    case POPUP_FIELDS:
        draw_fields(app, p);
        break;
    }
}
