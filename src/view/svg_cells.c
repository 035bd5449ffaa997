/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells as vectors: runs of characters become text; lines of boxes, blocks, dots and signs become paths, so that no
 * font needs to have them. One path for each role and kind keeps the file small. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "svg.h"
#include "svg_parts.h"

enum { CELL = SVG_CELL, HIGH = 2 * SVG_CELL, BASELINE = 12 };

enum kind { LINES, HEAVY, FILLS, DOTS, KINDS };

struct painter {
    const struct ceduo_cells *cells;
    const struct ceduo_svg_theme *theme;
    struct text paths[CEDUO_ROLE_COUNT][KINDS];
    struct text texts;
    struct ceduo_html words; /* writes to texts */
};

void ceduo_svg_number(struct text *text, double value)
{
    long tenths = (long)(value * 10 + (value < 0 ? -0.5 : 0.5));
    ceduo_text_format(text, "%s%ld", tenths < 0 ? "-" : "", labs(tenths) / 10);
    if (labs(tenths) % 10 > 0)
        ceduo_text_format(text, ".%ld", labs(tenths) % 10);
}

void ceduo_svg_stroke(struct ceduo_html *html, const struct ceduo_svg_look *look, const struct text *path, const char *extra,
                      const char *value)
{
    struct text width = {0};
    html->text->failed |= path->failed;
    if (path->length == 0)
        return;
    ceduo_svg_number(&width, look->width);
    ceduo_html_empty(html, "path", "fill", "none", "stroke", look->colour, "stroke-width", ceduo_text_string(&width), "d",
                     path->bytes, extra, value, NULL);
    ceduo_text_free(&width);
}

/* ---- pictures among the characters ---- */

enum { UP = 1, RIGHT = 2, DOWN = 4, LEFT = 8 };

/* The arms of a line of a box; 0 where it is none. */
static unsigned arms_of(uint32_t code)
{
    static const struct {
        uint16_t code;
        uint8_t arms;
    } table[] = {{0x2500, LEFT | RIGHT},
                 {0x2501, LEFT | RIGHT},
                 {0x2502, UP | DOWN},
                 {0x2503, UP | DOWN},
                 {0x250C, RIGHT | DOWN},
                 {0x2510, LEFT | DOWN},
                 {0x2514, UP | RIGHT},
                 {0x2518, UP | LEFT},
                 {0x251C, UP | RIGHT | DOWN},
                 {0x2524, UP | LEFT | DOWN},
                 {0x252C, LEFT | RIGHT | DOWN},
                 {0x2534, LEFT | RIGHT | UP},
                 {0x253C, UP | RIGHT | DOWN | LEFT},
                 {0x254C, LEFT | RIGHT},
                 {0x2550, LEFT | RIGHT}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        if (table[i].code == code)
            return table[i].arms;
    return 0;
}

static void add_box(struct painter *p, unsigned role, uint32_t code, int x, int y)
{
    bool heavy = code == 0x2501 || code == 0x2503;
    unsigned arms = arms_of(code);
    struct text *path = &p->paths[role][heavy ? HEAVY : LINES];
    int across = x + CELL / 2, down = y + HIGH / 2;
    if (code == 0x254C)
        ceduo_text_format(path, "M%d %dh2m3 0h2", x, down);
    else if (arms & (LEFT | RIGHT))
        ceduo_text_format(path, "M%d %dH%d", arms & LEFT ? x : across, down, arms & RIGHT ? x + CELL : across);
    if (arms & (UP | DOWN))
        ceduo_text_format(path, "M%d %dV%d", across, arms & UP ? y : down, arms & DOWN ? y + HIGH : down);
}

static void add_rectangle(struct text *path, int x, int y, int width, int height)
{
    ceduo_text_format(path, "M%d %dh%dv%dh%dz", x, y, width, height, -width);
}

/* Full, lower and left blocks to an eighth, quadrants, shades as bands. False for another character. */
static bool add_block(struct text *path, uint32_t code, int x, int y)
{
    static const uint8_t quadrants[] = {4, 8, 1, 1 | 4 | 8, 1 | 8, 1 | 2 | 4, 1 | 2 | 8, 2, 2 | 4, 2 | 4 | 8};
    if (code == 0x2580) {
        add_rectangle(path, x, y, CELL, HIGH / 2);
    } else if (code >= 0x2581 && code <= 0x2588) {
        int height = (int)(code - 0x2580) * 2;
        add_rectangle(path, x, y + HIGH - height, CELL, height);
    } else if (code >= 0x2589 && code <= 0x258F) {
        add_rectangle(path, x, y + 1, (int)(0x2590 - code), HIGH - 2);
    } else if (code == 0x2590) {
        add_rectangle(path, x + CELL / 2, y, CELL / 2, HIGH);
    } else if (code >= 0x2591 && code <= 0x2593) {
        int height = (int)(code - 0x2590) * 4;
        add_rectangle(path, x, y + (HIGH - height) / 2, CELL, height);
    } else if (code >= 0x2596 && code <= 0x259F) {
        for (int i = 0; i < 4; i++)
            if (quadrants[code - 0x2596] >> i & 1)
                add_rectangle(path, x + i % 2 * CELL / 2, y + i / 2 * HIGH / 2, CELL / 2, HIGH / 2);
    } else {
        return false;
    }
    return true;
}

/* Triangles, ticks and crosses. False for another character. */
static bool add_sign(struct painter *p, unsigned role, uint32_t code, int x, int y)
{
    static const struct {
        uint16_t code;
        bool filled;
        const char *path; /* from the corner of the cell */
    } signs[] = {{0x2713, false, "m1 9 2 3 4-8"},         {0x2714, false, "m1 9 2 3 4-8"},
                 {0x2717, false, "m1.5 4.5 5 7m0-7-5 7"}, {0x2718, false, "m1.5 4.5 5 7m0-7-5 7"},
                 {0x25B2, true, "m4 3.5 4 9h-8z"},        {0x25BC, true, "m0 4h8l-4 9z"},
                 {0x25B6, true, "m.5 4 7.5 4-7.5 4z"},    {0x25C0, true, "m7.5 4-7.5 4 7.5 4z"}};
    for (size_t i = 0; i < sizeof signs / sizeof signs[0]; i++) {
        if (signs[i].code != code)
            continue;
        ceduo_text_format(&p->paths[role][signs[i].filled ? FILLS : HEAVY], "M%d %d%s", x, y, signs[i].path);
        return true;
    }
    return false;
}

static void add_dots(struct painter *p, const struct ceduo_cell *cell, int x, int y)
{
    int across = p->cells->canvas.dots_x, down = p->cells->canvas.dots_y;
    struct text *path = &p->paths[cell->role][DOTS];
    for (int i = 0; i < across * down; i++)
        if (cell->dots >> i & 1U)
            ceduo_text_format(path, "M%d %dh0", x + (2 * (i % across) + 1) * CELL / (2 * across),
                              y + (2 * (i / across) + 1) * HIGH / (2 * down));
}

/* ---- text ---- */

/* Whether it stands as text: a line after a parenthesis explains a line elsewhere. */
static bool is_text(const struct painter *p, const struct ceduo_cell *cell, int column)
{
    struct text ignored = {0};
    uint32_t code = cell->code;
    if (code == 0 || code == SVG_DRAWN)
        return false;
    if (code < 0x2190)
        return true;
    if (code == 0x2502 && column > 0 && cell[-1].code == '(' && !p->theme->spaced)
        return true;
    bool block = add_block(&ignored, code, 0, 0);
    ceduo_text_free(&ignored);
    bool sign = code == 0x2713 || code == 0x2714 || code == 0x2717 || code == 0x2718 || code == 0x25B2 || code == 0x25BC ||
                code == 0x25B6 || code == 0x25C0;
    return !block && !sign && arms_of(code) == 0;
}

/* Where the run of text that begins in a column ends: at another role, a picture, or two blanks. */
static int run_end(const struct painter *p, const struct ceduo_cell *row, int column)
{
    int end = column, width = p->cells->width;
    for (; end < width && is_text(p, &row[end], end) && row[end].role == row[column].role; end++)
        if (row[column].role != CEDUO_ROLE_CURSOR && row[end].code == ' ' && end + 1 < width && row[end + 1].code == ' ')
            break;
    return end;
}

/* The cells from..end of a row, blanks at both ends left out. */
static void put_run(struct painter *p, const struct ceduo_cell *row, int y, int from, int end)
{
    const struct ceduo_svg_look *look = &p->theme->looks[row[from].role];
    bool turned = row[from].role == CEDUO_ROLE_CURSOR;
    char x[16], down[16], length[16];
    struct text word = {0};
    if (turned)
        add_rectangle(&p->paths[CEDUO_ROLE_CURSOR][FILLS], from * CELL, y, (end - from) * CELL, HIGH);
    while (from < end && row[from].code == ' ')
        from++;
    while (end > from && row[end - 1].code == ' ')
        end--;
    for (int i = from; i < end; i++) {
        char bytes[4];
        ceduo_text_add(&word, bytes, ceduo_utf8_encode(row[i].code, bytes));
    }
    snprintf(x, sizeof x, "%d", from * CELL);
    snprintf(down, sizeof down, "%d", y + BASELINE);
    snprintf(length, sizeof length, "%d", (end - from) * CELL);
    if (word.length > 0)
        ceduo_html_leaf(&p->words, "text", word.bytes, "x", x, "y", down, "fill",
                        turned && p->theme->paper ? p->theme->paper
                        : turned                  ? "#fff"
                                                  : look->colour,
                        "font-weight", look->weight, p->theme->spaced ? "textLength" : NULL, length, NULL);
    p->texts.failed |= word.failed;
    ceduo_text_free(&word);
}

/* ---- all ---- */

static void add_row(struct painter *p, int y)
{
    const struct ceduo_cell *row = ceduo_cells_at(p->cells, 0, y);
    for (int i = 0; i < p->cells->width; i++) {
        uint32_t code = row[i].code;
        if (is_text(p, &row[i], i)) {
            int end = run_end(p, row, i);
            end = end > i ? end : i + 1;
            put_run(p, row, y * HIGH, i, end);
            i = end - 1;
        } else if (code == 0 && p->theme->dots) {
            add_dots(p, &row[i], i * CELL, y * HIGH);
        } else if (arms_of(code)) {
            add_box(p, row[i].role, code, i * CELL, y * HIGH);
        } else if (code != 0 && !add_block(&p->paths[row[i].role][FILLS], code, i * CELL, y * HIGH)) {
            add_sign(p, row[i].role, code, i * CELL, y * HIGH);
        }
    }
}

static void put_paths(struct painter *p, struct ceduo_html *html, unsigned role)
{
    static const double widths[KINDS] = {[LINES] = 1, [HEAVY] = 2, [DOTS] = 3};
    const struct ceduo_svg_look *look = &p->theme->looks[role];
    struct text *paths = p->paths[role];
    if (paths[FILLS].length > 0)
        ceduo_html_empty(html, "path", "fill", look->colour, "d", paths[FILLS].bytes, NULL);
    for (int kind = 0; kind < KINDS; kind++) {
        const struct ceduo_svg_look pen = {.colour = look->colour, .width = widths[kind]};
        if (kind != FILLS)
            ceduo_svg_stroke(html, &pen, &paths[kind], kind == DOTS ? "stroke-linecap" : NULL, "round");
        html->text->failed |= paths[kind].failed;
        ceduo_text_free(&paths[kind]);
    }
}

void ceduo_svg_cells(struct ceduo_html *html, const struct ceduo_cells *cells, const struct ceduo_svg_theme *theme)
{
    struct painter p = {.cells = cells, .theme = theme, .words = {.text = NULL}};
    p.words.text = &p.texts;
    for (int y = 0; y < cells->height; y++)
        add_row(&p, y);
    for (unsigned role = 0; role < CEDUO_ROLE_COUNT; role++)
        put_paths(&p, html, role);
    ceduo_text_add(html->text, ceduo_text_string(&p.texts), p.texts.length);
    html->text->failed |= p.texts.failed;
    ceduo_text_free(&p.texts);
}

/* ---- a screen ---- */

/* As a dark terminal shows the roles; text has a contrast of 4.5 to the paper at least. */
static const struct ceduo_svg_theme terminal = {
    .paper = "#15181c",
    .font = "monospace",
    .spaced = true,
    .dots = true,
    .looks = {[CEDUO_ROLE_BLANK] = {"#d6dbe1", 1, NULL},  [CEDUO_ROLE_TEXT] = {"#d6dbe1", 1, NULL},
              [CEDUO_ROLE_DIM] = {"#8d96a0", 1, NULL},    [CEDUO_ROLE_TITLE] = {"#f2f5f8", 1, "bold"},
              [CEDUO_ROLE_AXIS] = {"#8d96a0", 1, NULL},   [CEDUO_ROLE_GROUND] = {"#d9b45b", 1, NULL},
              [CEDUO_ROLE_CLOUD] = {"#56b6c2", 1, NULL},  [CEDUO_ROLE_ENVELOPE] = {"#7aa7f0", 1, NULL},
              [CEDUO_ROLE_MEAN] = {"#f2f5f8", 1, "bold"}, [CEDUO_ROLE_WAY] = {"#e08ce0", 1, "bold"},
              [CEDUO_ROLE_STEM] = {"#7ec46b", 1, NULL},   [CEDUO_ROLE_STOOL] = {"#7ec46b", 1, NULL},
              [CEDUO_ROLE_BELT] = {"#7ec46b", 1, NULL},   [CEDUO_ROLE_CONTROL] = {"#f2777a", 1, NULL},
              [CEDUO_ROLE_GOOD] = {"#8fd97a", 1, "bold"}, [CEDUO_ROLE_BAD] = {"#ff8a85", 1, "bold"},
              [CEDUO_ROLE_WARN] = {"#d9b45b", 1, NULL},   [CEDUO_ROLE_BARE] = {"#56b6c2", 1, NULL},
              [CEDUO_ROLE_WOOD] = {"#7ec46b", 1, NULL},   [CEDUO_ROLE_CURSOR] = {"#d6dbe1", 1, NULL}}};

void ceduo_svg_screen(struct text *text, const struct ceduo_cells *cells, const char *title)
{
    enum { MARGIN = CELL };
    struct ceduo_html html = {.text = text};
    char box[64], width[16], height[16];
    snprintf(box, sizeof box, "%d %d %d %d", -MARGIN, -MARGIN, cells->width * CELL + 2 * MARGIN,
             cells->height * HIGH + 2 * MARGIN);
    snprintf(width, sizeof width, "%d", cells->width * CELL + 2 * MARGIN);
    snprintf(height, sizeof height, "%d", cells->height * HIGH + 2 * MARGIN);
    ceduo_html_open(&html, "svg", "xmlns", "http://www.w3.org/2000/svg", "width", width, "height", height, "viewBox", box,
                    "role", "img", NULL);
    ceduo_html_leaf(&html, "title", title, NULL);
    ceduo_html_empty(&html, "rect", "x", "-8", "y", "-8", "width", width, "height", height, "rx", "6", "fill", terminal.paper,
                     NULL);
    ceduo_html_open(&html, "g", "font-family", terminal.font, "font-size", "13", NULL);
    ceduo_svg_cells(&html, cells, &terminal);
    ceduo_html_close(&html);
    ceduo_html_close(&html);
}
