/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints a page at a width, or draws it on a canvas: paragraphs are wrapped, cells set below one another, numbers written with as
 * many digits as their column has room for. Of a page that is drawn a piece is printed, up to where a line, a role or a bar ends,
 * and put on the canvas. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "canvas.h"
#include "cells.h"
#include "page.h"
#include "words.h"

#define MARGIN   4 /* columns at the left of a page that a pane does without */
#define TAIL_MIN 8 /* columns that hold a beginning and an end */

/* Where a page is drawn, and the piece that is being printed. */
struct drawing {
    struct ceduo_canvas *canvas;
    struct ceduo_area area;
    int first, column; /* the line at the top of the area; where the piece begins */
    enum ceduo_role role;
    const struct ceduo_page_bar *bar; /* that the piece is; NULL: text */
};

struct printer {
    struct text *text;
    size_t width;
    bool plain;              /* ASCII alone */
    struct drawing *drawing; /* NULL: it is printed */
    int line;                /* how many have ended */
};

static void draw_bar(const struct drawing *d, int column, int row, int width)
{
    const struct ceduo_page_bar *b = d->bar;
    int least = (int)(b->least * (width - 1)), most = (int)(b->most * (width - 1));
    for (int x = least; b->most >= b->least && x <= most; x++)
        ceduo_canvas_label(d->canvas, column + x, row, CEDUO_ROLE_MEAN,
                           x == least  ? "\xe2\x94\x9c"
                           : x == most ? "\xe2\x94\xa4"
                                       : "\xe2\x94\x80");
    if (b->from > 0)
        for (int x = (int)(b->from * (width - 1)); x <= (int)(b->to * (width - 1)); x++)
            ceduo_canvas_bar(d->canvas, column + x, row, 1, 1, d->role);
    else
        ceduo_canvas_bar(d->canvas, column, row, width, b->to, d->role);
    if (b->limit >= 0 && b->limit <= 1)
        ceduo_canvas_label(d->canvas, column + (int)fmin(round(b->limit * width), width - 1), row, b->own, "\xe2\x94\x82");
}

/* In `room` columns; blanks at its ends are drawn only where they are seen. */
static void draw_text(const struct drawing *d, int column, int row, int room, struct text *piece)
{
    char *string = piece->bytes, *end = string + piece->length;
    size_t blanks = d->role == CEDUO_ROLE_CURSOR ? 0 : strspn(string, " ");
    while (d->role != CEDUO_ROLE_CURSOR && end > string + blanks && end[-1] == ' ')
        *--end = '\0';
    if (string[blanks])
        ceduo_canvas_draw_text(d->canvas, column + (int)blanks, row, room - (int)blanks, d->role, string + blanks);
}

/* Draws the piece that was printed, if that is to be done; the next one is a text, or a bar, in a role. */
static void begin_piece(struct printer *p, enum ceduo_role role, const struct ceduo_page_bar *bar)
{
    struct drawing *d = p->drawing;
    if (!d)
        return;
    const struct ceduo_area *a = &d->area;
    int x = a->left + d->column, row = p->line - d->first;
    int width = ceduo_canvas_label_width(d->canvas, ceduo_text_string(p->text)), room = a->left + a->width - x;
    if (width > 0 && row >= 0 && row < a->height && !d->bar)
        draw_text(d, x, a->top + row, room, p->text);
    else if (width > 0 && row >= 0 && row < a->height && !d->canvas->words_alone && width <= room)
        draw_bar(d, x, a->top + row, width);
    d->column += width;
    d->role = role;
    d->bar = bar;
    ceduo_text_cut(p->text, 0);
}

static void end_line(struct printer *p)
{
    if (p->drawing) {
        begin_piece(p, p->drawing->role, p->drawing->bar);
        p->drawing->column = 0;
    } else {
        ceduo_text_char(p->text, '\n');
    }
    p->line++;
}

static void append_blanks(struct text *text, size_t n)
{
    ceduo_text_format(text, "%*s", (int)n, "");
}

void ceduo_page_powers(struct text *text, const char *string)
{
    for (const char *at = string; *at; at++) {
        if (ceduo_is_power(string, at))
            ceduo_text_append(text, *at == '2' ? "\xc2\xb2" : "\xc2\xb3");
        else
            ceduo_text_char(text, *at);
    }
}

/* What may be printed: no control characters, and where the terminal knows no other ASCII alone, so that its width is known. */
static void append_safe(const struct printer *p, struct text *to, const char *string)
{
    LOCAL_TEXT(powers);
    LOCAL_TEXT(safe);
    if (!p->plain && !p->drawing) {
        ceduo_page_powers(&powers, string);
        string = ceduo_text_string(&powers);
    }
    ceduo_text_append_escaped(&safe, string);
    if (p->plain)
        ceduo_cells_ascii(to, ceduo_text_string(&safe));
    else
        ceduo_text_append(to, ceduo_text_string(&safe));
}

/* ---- paragraphs ---- */

/* How a kind of block begins, how far its other lines are indented, and its role. */
static const struct {
    const char *first;
    size_t indent;
    enum ceduo_role role;
} styles[] = {
    [CEDUO_PAGE_TITLE] = {"", 0, CEDUO_ROLE_TITLE},      [CEDUO_PAGE_FACT] = {"", 9, CEDUO_ROLE_TEXT},
    [CEDUO_PAGE_SECTION] = {"", 2, CEDUO_ROLE_TITLE},    [CEDUO_PAGE_PLACE] = {"  ", 4, CEDUO_ROLE_TITLE},
    [CEDUO_PAGE_CAPTION] = {"    ", 4, CEDUO_ROLE_DIM},  [CEDUO_PAGE_SENTENCE] = {"    ", 6, CEDUO_ROLE_TEXT},
    [CEDUO_PAGE_DETAIL] = {"      ", 8, CEDUO_ROLE_DIM}, [CEDUO_PAGE_NOTE] = {"  ", 2, CEDUO_ROLE_TEXT},
    [CEDUO_PAGE_ITEM] = {"  ", 4, CEDUO_ROLE_TEXT},      [CEDUO_PAGE_WARNING] = {"    ! ", 6, CEDUO_ROLE_WARN},
    [CEDUO_PAGE_QUESTION] = {"", 0, CEDUO_ROLE_TITLE},   [CEDUO_PAGE_ANSWER] = {"  ", CEDUO_ANSWER_INDENT, CEDUO_ROLE_TEXT},
    [CEDUO_PAGE_POINT] = {"", 10, CEDUO_ROLE_TEXT}};

/* Of several blanks one is left, of those at the end none. */
static void squeeze(struct text *text)
{
    size_t n = 0;
    for (size_t i = 0; i < text->length; i++) {
        char next = text->bytes[i + 1];
        if (text->bytes[i] != ' ' || (next && next != ' '))
            text->bytes[n++] = text->bytes[i];
    }
    text->length = n;
    if (text->bytes)
        text->bytes[n] = '\0';
}

/* A text that begins at `column`; its other lines are indented. */
static void print_wrapped(struct printer *p, const char *string, size_t column, size_t indent)
{
    for (const char *at = string, *next; *at; at = next) {
        size_t n = ceduo_utf8_wrap(at, p->width > column ? p->width - column : 1, &next);
        if (at > string) {
            end_line(p);
            append_blanks(p->text, indent);
        }
        ceduo_text_add(p->text, at, n);
        column = indent;
    }
}

static void print_paragraph(struct printer *p, const struct ceduo_page_block *block)
{
    const char *begin = styles[block->kind].first, *text = ceduo_text_string(&block->text);
    size_t indent = styles[block->kind].indent, margin = p->drawing ? strspn(begin, " ") : 0; /* panes are narrow */
    size_t label = block->kind == CEDUO_PAGE_FACT || block->kind == CEDUO_PAGE_POINT ? strcspn(text, "\t") : 0;
    LOCAL_TEXT(first);
    LOCAL_TEXT(rest);
    margin = margin > MARGIN ? MARGIN : margin;
    indent -= margin;
    ceduo_text_append(&first, begin + margin);
    ceduo_text_add(&first, text, label);
    size_t column = ceduo_utf8_width(ceduo_text_string(&first));
    if (label > 0) {
        append_blanks(&first, column < indent ? indent - column : 2);
        column = ceduo_utf8_width(first.bytes);
    }
    append_safe(p, &rest, text + label + (label > 0));
    squeeze(&rest);
    if (p->drawing && rest.length == 0)
        return;
    if (block->kind == CEDUO_PAGE_SECTION && (!p->drawing || p->line > 0))
        end_line(p);
    begin_piece(p, block->role ? block->role : styles[block->kind].role, NULL);
    ceduo_text_append(p->text, ceduo_text_string(&first));
    print_wrapped(p, ceduo_text_string(&rest), column, indent);
    end_line(p);
}

/* ---- cells ---- */

/* Set into so many columns and cut where it is longer, at its end or in its middle; negative: to the right; 0: as it comes. */
static void print_padded(struct printer *p, const char *string, int width, bool ends)
{
    size_t want = (size_t)abs(width), have = ceduo_utf8_width(string);
    if (width < 0 && have < want)
        append_blanks(p->text, want - have);
    if (have <= want || want == 0) {
        ceduo_text_append(p->text, string);
    } else {
        size_t tail = ends && want >= TAIL_MIN ? (want - 1) / 2 : 0;
        const char *end = string;
        while (ceduo_utf8_width(end) > tail)
            end += ceduo_utf8_step(end);
        size_t n = ceduo_utf8_cut(string, want - 1 - ceduo_utf8_width(end));
        ceduo_text_add(p->text, string, n);
        ceduo_text_append(p->text, p->plain ? "~" : "\xe2\x80\xa6");
        ceduo_text_append(p->text, end);
        have = ceduo_utf8_char_width(string, n) + 1 + ceduo_utf8_width(end);
    }
    if (width > 0 && have < want)
        append_blanks(p->text, want - have);
}

/* Whether it has room in a column, with a blank before it. */
static bool fits(const struct text *cell, size_t width)
{
    return ceduo_utf8_width(ceduo_text_string(cell)) < width;
}

/* A number; in thousands or millions (134e3) where it has no room, or with fewer digits. */
static void write_number(struct text *cell, double value, int digits, size_t width)
{
    ceduo_words_number(cell, value, digits);
    for (int e = 3; e <= 9 && isfinite(value) && fabs(value) >= 1e3 && !fits(cell, width); e += 3) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.0fe%d", value / pow(10, e), e);
    }
    while (digits > 1 && !fits(cell, width)) {
        ceduo_text_free(cell);
        ceduo_words_number(cell, value, --digits);
    }
    if (!isfinite(value) || fits(cell, width))
        return;
    /* as short as can be: 3e26, 7e-3; where that has no more room either, what is small as 0.00 */
    char power[16];
    snprintf(power, sizeof power, "%.0e", value);
    ceduo_text_free(cell);
    ceduo_text_format(cell, "%.*se%ld", (int)strcspn(power, "e"), power, strtol(strchr(power, 'e') + 1, NULL, 10));
    if (fabs(value) < 1 && !fits(cell, width)) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.*f", (int)width - (value < 0 ? 4 : 3), value);
    }
}

static void write_cell(const struct printer *p, struct text *to, const struct ceduo_page_cell *cell, size_t width)
{
    if (cell->kind == CEDUO_CELL_NUMBER)
        write_number(to, cell->value, cell->digits, width);
    else
        append_safe(p, to, ceduo_text_string(&cell->text));
    if (cell->kind != CEDUO_CELL_TEXT && to->bytes)
        ceduo_number_spoken(to->bytes);
    if (cell->shorter.length > 0 && !fits(to, width)) {
        ceduo_text_free(to);
        append_safe(p, to, ceduo_text_string(&cell->shorter));
    }
}

void ceduo_page_write_cell(struct text *to, const struct ceduo_page_cell *cell, size_t width, bool plain)
{
    write_cell(&(struct printer){.plain = plain}, to, cell, width);
}

static void print_cell(struct printer *p, const struct ceduo_page_column *column, const struct ceduo_page_cell *cell, int gap,
                       int width, enum ceduo_role role)
{
    LOCAL_TEXT(text);
    begin_piece(p, CEDUO_ROLE_TEXT, NULL);
    append_blanks(p->text, (size_t)gap);
    if (cell->kind == CEDUO_CELL_BAR) {
        begin_piece(p, cell->role, &cell->bar);
        append_blanks(p->text, (size_t)width);
        return;
    }
    size_t room = (size_t)abs(width) + ((column->flags & (CEDUO_FITS | CEDUO_FILLS)) != 0);
    write_cell(p, &text, cell, room);
    if (p->width >= CEDUO_PAGE_WIDE && !p->drawing && cell->written.length > 0 && (width == 0 || fits(&cell->written, room))) {
        ceduo_text_free(&text);
        append_safe(p, &text, cell->written.bytes);
    }
    begin_piece(p, cell->role ? cell->role : role, NULL);
    if ((column->flags & CEDUO_WHOLE) && !fits(&text, room)) {
        print_wrapped(p, ceduo_text_string(&text), (size_t)gap, (size_t)gap);
        end_line(p);
        append_blanks(p->text, (size_t)(gap + width));
    } else {
        print_padded(p, ceduo_text_string(&text), width, column->flags & CEDUO_FILLS);
    }
}

#define COLUMNS_MAX 24
#define ANY_WIDTH   400 /* a cell without limits */

/* The widest cell of a column; `*bars`: there is a bar in it. */
static int widest_cell(const struct printer *p, const struct ceduo_page_block *table, size_t column, bool *bars)
{
    int widest = 0;
    for (size_t i = column; i < table->cells_count; i += table->columns_count) {
        LOCAL_TEXT(text);
        *bars |= table->cells[i].kind == CEDUO_CELL_BAR;
        write_cell(p, &text, &table->cells[i], ANY_WIDTH);
        int width = (int)ceduo_utf8_width(ceduo_text_string(&text));
        widest = width > widest ? width : widest;
    }
    return widest;
}

/* A pane has no margin. */
static int gap_of(const struct printer *p, const struct ceduo_page_column *column, size_t i)
{
    return i == 0 && p->drawing ? 0 : column->gap;
}

/* Sets the width of each column: 0 for one that has no room. */
static void place_columns(const struct printer *p, const struct ceduo_page_block *table, int *widths)
{
    size_t n = table->columns_count;
    int rest = (int)p->width, natural[COLUMNS_MAX], bars = 0, names = 0;
    bool has_bars[COLUMNS_MAX] = {false};
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_page_column *c = &table->columns[i];
        int share = (int)p->width / 2; /* that a name may take of the page: rather it is cut than columns are left out */
        natural[i] = c->flags & (CEDUO_FITS | CEDUO_FILLS) ? widest_cell(p, table, i, &has_bars[i]) : 0;
        widths[i] = c->flags & CEDUO_FITS ? natural[i] : 0;
        if (c->flags & CEDUO_FILLS && !has_bars[i])
            widths[i] = natural[i] < share ? natural[i] : share;
        widths[i] = widths[i] > abs(c->width) ? widths[i] : abs(c->width);
        names += c->flags & CEDUO_FILLS ? widths[i] - abs(c->width) : 0; /* what they can be cut by */
        rest -= gap_of(p, c, i) + widths[i];
    }
    for (size_t rank = 9; rest < 0 && rank > 0; rank--) {
        bool dropped = rank >= CEDUO_MINOR || rest + names < 0;
        for (size_t i = 0; i < n; i++)
            if (dropped && table->columns[i].flags >> 8 == rank) {
                rest += gap_of(p, &table->columns[i], i) + widths[i];
                widths[i] = 0;
            }
    }
    for (size_t i = 0; i < n; i++)
        bars += has_bars[i] && widths[i] > 0;
    for (size_t i = 0; i < n; i++) { /* names take what is missing, or what is left where there is no bar */
        int more = rest < natural[i] - widths[i] ? rest : natural[i] - widths[i],
            least = abs(table->columns[i].width) - widths[i];
        if (!(table->columns[i].flags & CEDUO_FILLS) || widths[i] == 0 || has_bars[i] || (rest > 0 && bars > 0))
            continue;
        more = more > least ? more : least;
        widths[i] += more;
        rest -= more;
    }
    for (size_t i = 0; i < n && p->width >= CEDUO_PAGE_WIDE && !p->drawing;
         i++) { /* heads that are written out, as far as they have room */
        int more = (int)ceduo_utf8_width(ceduo_text_string(&table->cells[i].written)) + 1 - widths[i];
        if (widths[i] == 0 || more <= 0 || more > rest)
            continue;
        widths[i] += more;
        rest -= more;
    }
    for (size_t i = 0; i < n && rest > 0; i++)
        if (has_bars[i] && widths[i] > 0) {
            widths[i] += rest / bars;
            rest -= rest / bars--;
        }
}

static void print_table(struct printer *p, const struct ceduo_page_block *table)
{
    size_t n = table->columns_count;
    int widths[COLUMNS_MAX];
    bool heads = false;
    for (size_t i = 0; i < n; i++)
        heads |= table->cells[i].text.length > 0;
    place_columns(p, table, widths);
    for (size_t row = heads ? 0 : n; row + n <= table->cells_count; row += n) {
        for (size_t i = 0; i < n; i++) {
            const struct ceduo_page_column *c = &table->columns[i];
            int width = widths[i];
            if (width == 0 && c->width != 0)
                continue;
            if (c->width < 0)
                width = -width;
            else if (row == 0 && i == n - 1 && c->width > 0) /* the last head is never cut */
                width = 0;
            print_cell(p, c, &table->cells[row + i], gap_of(p, c, i), width, row == 0 ? CEDUO_ROLE_AXIS : CEDUO_ROLE_TEXT);
        }
        while (!p->drawing && p->text->length > 0 && p->text->bytes[p->text->length - 1] == ' ')
            p->text->bytes[--p->text->length] = '\0';
        end_line(p);
    }
}

/* Returns the number of lines. */
static int print_page(const struct ceduo_page *page, struct text *text, bool plain, struct drawing *drawing)
{
    struct printer p = {.text = text, .width = page->width, .plain = plain, .drawing = drawing};
    for (const struct ceduo_page_block *block = page->first; block; block = block->next) {
        if (block->kind == CEDUO_PAGE_TABLE)
            print_table(&p, block);
        else if (block->kind == CEDUO_PAGE_GAP)
            end_line(&p);
        else if (block->kind < CEDUO_PAGE_PICTURE)
            print_paragraph(&p, block);
    }
    return p.line;
}

size_t ceduo_page_lines(const struct ceduo_page *page)
{
    LOCAL_TEXT(text);
    return (size_t)print_page(page, &text, false, NULL);
}

void ceduo_page_print(struct text *text, const struct ceduo_page *page, bool plain)
{
    print_page(page, text, plain, NULL);
}

int ceduo_page_draw(const struct ceduo_page *page, struct ceduo_canvas *canvas, struct ceduo_area area, int first)
{
    LOCAL_TEXT(piece);
    struct drawing drawing = {.canvas = canvas, .area = area, .first = first};
    return print_page(page, &piece, ceduo_canvas_label_width(canvas, "\xe2\x80\xa6") > 1, &drawing);
}
