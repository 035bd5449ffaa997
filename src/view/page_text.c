/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Print a page at a width, or draw it on a canvas. Paragraphs are wrapped, columns aligned, numbers shortened to fit. To
 * draw, text is collected in a piece until the line, role or bar ends, then drawn. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "canvas.h"
#include "cells.h"
#include "page.h"
#include "words.h"

#define MARGIN   4 /* columns at the left of a printed page; a pane has none */
#define TAIL_MIN 8 /* columns for text shortened in the middle */

/* Target of drawing, and the current piece. */
struct drawing {
    struct ceduo_canvas *canvas;
    struct ceduo_area area;
    int first, column; /* top line of the area; start column of the piece */
    enum ceduo_role role;
    const struct ceduo_page_bar *bar; /* the piece is a bar; NULL: text */
};

struct printer {
    struct text *text;
    size_t width;
    bool plain;              /* ASCII only */
    struct drawing *drawing; /* NULL: print */
    int line;                /* finished lines */
};

static void draw_page_bar(const struct drawing *d, int column, int row, int width)
{
    const struct ceduo_page_bar *b = d->bar;
    int lo = (int)(b->error_lo * (width - 1)), hi = (int)(b->error_hi * (width - 1));
    for (int x = lo; b->error_hi >= b->error_lo && x <= hi; x++)
        ceduo_canvas_label(d->canvas, column + x, row, CEDUO_ROLE_MEAN,
                           x == lo   ? "\xe2\x94\x9c"
                           : x == hi ? "\xe2\x94\xa4"
                                     : "\xe2\x94\x80");
    if (b->from > 0)
        for (int x = (int)(b->from * (width - 1)); x <= (int)(b->to * (width - 1)); x++)
            ceduo_canvas_bar(d->canvas, column + x, row, 1, 1, d->role);
    else
        ceduo_canvas_bar(d->canvas, column, row, width, b->to, d->role);
    if (b->limit >= 0 && b->limit <= 1)
        ceduo_canvas_label(d->canvas, column + (int)fmin(round(b->limit * width), width - 1), row, b->limit_role,
                           "\xe2\x94\x82");
}

/* Draw a piece in at most `width` columns; leading and trailing blanks only if reversed by the cursor role. */
static void draw_piece(const struct drawing *d, int column, int row, int available, struct text *piece)
{
    char *string = piece->bytes, *end = string + piece->length;
    size_t blanks = d->role == CEDUO_ROLE_CURSOR ? 0 : strspn(string, " ");
    while (d->role != CEDUO_ROLE_CURSOR && end > string + blanks && end[-1] == ' ')
        *--end = '\0';
    if (string[blanks])
        ceduo_canvas_draw_text(d->canvas, column + (int)blanks, row, available - (int)blanks, d->role, string + blanks);
}

/* Draw the previous piece, if drawing. Start a text or bar in a role. */
static void begin_piece(struct printer *p, enum ceduo_role role, const struct ceduo_page_bar *bar)
{
    struct drawing *d = p->drawing;
    if (!d)
        return;
    const struct ceduo_area *a = &d->area;
    int x = a->left + d->column, row = p->line - d->first;
    int width = ceduo_canvas_label_width(d->canvas, ceduo_text_string(p->text)), available = a->left + a->width - x;
    if (width > 0 && row >= 0 && row < a->height && !d->bar)
        draw_piece(d, x, a->top + row, available, p->text);
    else if (width > 0 && row >= 0 && row < a->height && !d->canvas->text_only && width <= available)
        draw_page_bar(d, x, a->top + row, width);
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
        ceduo_text_append_char(p->text, '\n');
    }
    p->line++;
}

static void append_blanks(struct text *text, size_t n)
{
    ceduo_text_format(text, "%*s", (int)n, "");
}

void ceduo_page_powers(struct text *text, const char *string)
{
    for (const char *c = string; *c; c++) {
        if (ceduo_is_power(string, c))
            ceduo_text_append(text, *c == '2' ? "\xc2\xb2" : "\xc2\xb3");
        else
            ceduo_text_append_char(text, *c);
    }
}

/* Append printable text: without control characters, and ASCII only if `plain`, so that its width is known. */
static void append_printable(const struct printer *p, struct text *to, const char *string)
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

/* Prefix, indent of continuation lines, and role of each kind of block. */
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

/* Collapse blanks; remove trailing ones. */
static void collapse_blanks(struct text *text)
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

/* Print a text from `column` on; continuation lines are indented. */
static void print_wrapped(struct printer *p, const char *string, size_t column, size_t indent)
{
    for (const char *line = string, *next; *line; line = next) {
        size_t n = ceduo_utf8_wrap(line, p->width > column ? p->width - column : 1, &next);
        if (line > string) {
            end_line(p);
            append_blanks(p->text, indent);
        }
        ceduo_text_append_n(p->text, line, n);
        column = indent;
    }
}

static void print_paragraph(struct printer *p, const struct ceduo_page_block *block)
{
    const char *begin = styles[block->kind].first, *text = ceduo_text_string(&block->text);
    size_t indent = styles[block->kind].indent, margin = p->drawing ? strspn(begin, " ") : 0; /* panes have no margin */
    size_t label = block->kind == CEDUO_PAGE_FACT || block->kind == CEDUO_PAGE_POINT ? strcspn(text, "\t") : 0;
    LOCAL_TEXT(first);
    LOCAL_TEXT(rest);
    margin = margin > MARGIN ? MARGIN : margin;
    indent -= margin;
    ceduo_text_append(&first, begin + margin);
    ceduo_text_append_n(&first, text, label);
    size_t column = ceduo_utf8_width(ceduo_text_string(&first));
    if (label > 0) {
        append_blanks(&first, column < indent ? indent - column : 2);
        column = ceduo_utf8_width(first.bytes);
    }
    append_printable(p, &rest, text + label + (label > 0));
    collapse_blanks(&rest);
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

#define ANY_WIDTH 400 /* no limit */

/* True if a cell fits in a column with a blank before it. */
static bool cell_fits(const struct text *cell, size_t width)
{
    return ceduo_utf8_width(ceduo_text_string(cell)) < width;
}

/* Append a number. If it does not fit, use powers of 1000 (134e3), then fewer digits. */
static void write_number(struct text *cell, double value, int digits, size_t width)
{
    ceduo_words_number(cell, value, digits);
    for (int e = 3; e <= 9 && isfinite(value) && fabs(value) >= 1e3 && !cell_fits(cell, width); e += 3) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.0fe%d", value / pow(10, e), e);
    }
    while (digits > 1 && !cell_fits(cell, width)) {
        ceduo_text_free(cell);
        ceduo_words_number(cell, value, --digits);
    }
    if (!isfinite(value) || cell_fits(cell, width))
        return;
    /* shortest form: 3e26, 7e-3; if it does not fit, small values as 0.00 */
    char power[16];
    snprintf(power, sizeof power, "%.0e", value);
    ceduo_text_free(cell);
    ceduo_text_format(cell, "%.*se%ld", (int)strcspn(power, "e"), power, strtol(strchr(power, 'e') + 1, NULL, 10));
    if (fabs(value) < 1 && !cell_fits(cell, width)) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.*f", (int)width - (value < 0 ? 4 : 3), value);
    }
}

static void write_cell(const struct printer *p, struct text *to, const struct ceduo_page_cell *cell, size_t width)
{
    if (cell->kind == CEDUO_CELL_NUMBER)
        write_number(to, cell->value, cell->digits, width);
    else
        append_printable(p, to, ceduo_text_string(&cell->text));
    if (cell->kind != CEDUO_CELL_TEXT && to->bytes)
        ceduo_number_localize(to->bytes);
    if (cell->shorter.length > 0 && !cell_fits(to, width)) {
        ceduo_text_free(to);
        append_printable(p, to, ceduo_text_string(&cell->shorter));
    }
}

/* Two parts of a name that are kept, as bytes: [a, a_end) and [b, b_end). */
struct parts {
    const char *name;
    size_t n, a, a_end, b, b_end;
};

/* Return the columns of the parts, with a mark for each gap. */
static size_t parts_width(const struct parts *k)
{
    return (k->a > 0) + ceduo_utf8_char_width(k->name + k->a, k->a_end - k->a) + (k->a_end < k->b) +
           ceduo_utf8_char_width(k->name + k->b, k->b_end - k->b) + (k->b_end < k->n);
}

/* Make the parts longer by a character: both to the right, otherwise one to the front. Return false if nothing fits. */
static bool grow_parts(struct parts *k, size_t columns)
{
    bool grown = false;
    for (int end = 0; end < 4 && !(grown && end >= 2); end++) {
        struct parts longer = *k;
        if (end == 0 && k->a_end < k->b)
            longer.a_end += ceduo_utf8_step(k->name + k->a_end);
        else if (end == 1 && k->b_end < k->n)
            longer.b_end += ceduo_utf8_step(k->name + k->b_end);
        else if (end == 2 && k->a_end < k->b)
            longer.b = (size_t)(ceduo_utf8_back(k->name, k->name + k->b) - k->name);
        else if (end == 3 && k->a > 0)
            longer.a = (size_t)(ceduo_utf8_back(k->name, k->name + k->a) - k->name);
        else
            continue;
        if (parts_width(&longer) > columns)
            continue;
        *k = longer;
        grown = true;
    }
    return grown;
}

#define WORD_MAX 8 /* bytes of a word that is kept from its start */

static bool is_word(char c)
{
    return c && !strchr(" ,", c);
}

/* Return the start of the word at this position, or of the next word. */
static size_t word_start(const char *name, size_t position)
{
    size_t start = position;
    while (name[start] && !is_word(name[start]))
        start++;
    while (is_word(name[position]) && start > 0 && is_word(name[start - 1]) && position - start < WORD_MAX)
        start--;
    return start > 0 && is_word(name[start]) && is_word(name[start - 1]) ? position : start; /* within a long word */
}

/* Append a name of a column, without parts that other names have, too. It keeps the first and the last difference to another
 * name. Return false if no name differs. */
static bool print_distinct(struct printer *p, const struct ceduo_page_block *table, size_t column, const char *name,
                           size_t columns)
{
    size_t first = SIZE_MAX, last = 0, n = strlen(name);
    const char *mark = p->plain ? "~" : "\xe2\x80\xa6";
    for (size_t i = table->columns_count + column; i < table->cells_count; i += table->columns_count) {
        LOCAL_TEXT(cell);
        write_cell(p, &cell, &table->cells[i], ANY_WIDTH);
        size_t same = 0;
        while (same < n && name[same] == ceduo_text_string(&cell)[same])
            same++;
        if (same == n && cell.length == n)
            continue;
        while (same > 0 && ceduo_utf8_is_continuation(name[same]))
            same--;
        first = same < first ? same : first;
        last = same > last ? same : last;
    }
    if (first == SIZE_MAX || columns < TAIL_MIN)
        return false;
    first = word_start(name, first);
    last = word_start(name, last);
    struct parts k = {name, n, first, first, last > first ? last : first, last > first ? last : first};
    while (grow_parts(&k, columns))
        ;
    ceduo_text_append(p->text, k.a > 0 ? mark : "");
    ceduo_text_append_n(p->text, name + k.a, k.a_end - k.a);
    ceduo_text_append(p->text, k.a_end < k.b ? mark : "");
    ceduo_text_append_n(p->text, name + k.b, k.b_end - k.b);
    ceduo_text_append(p->text, k.b_end < n ? mark : "");
    append_blanks(p->text, columns - parts_width(&k));
    return true;
}

/* Pad or truncate to `width` columns, at the end or in the middle; negative: right-aligned; 0: unlimited. */
static void print_padded(struct printer *p, const char *string, int width, bool ends)
{
    size_t target = (size_t)abs(width), current = ceduo_utf8_width(string);
    if (width < 0 && current < target)
        append_blanks(p->text, target - current);
    if (current <= target || target == 0) {
        ceduo_text_append(p->text, string);
    } else {
        size_t tail = ends && target >= TAIL_MIN ? (target - 1) / 2 : 0;
        const char *end = string;
        while (ceduo_utf8_width(end) > tail)
            end += ceduo_utf8_step(end);
        size_t n = ceduo_utf8_cut(string, target - 1 - ceduo_utf8_width(end));
        ceduo_text_append_n(p->text, string, n);
        ceduo_text_append(p->text, p->plain ? "~" : "\xe2\x80\xa6");
        ceduo_text_append(p->text, end);
        current = ceduo_utf8_char_width(string, n) + 1 + ceduo_utf8_width(end);
    }
    if (width > 0 && current < target)
        append_blanks(p->text, target - current);
}

void ceduo_page_write_cell(struct text *to, const struct ceduo_page_cell *cell, size_t width, bool plain)
{
    write_cell(&(struct printer){.plain = plain}, to, cell, width);
}

static void print_cell(struct printer *p, const struct ceduo_page_block *table, size_t index, int gap, int width,
                       enum ceduo_role role)
{
    const struct ceduo_page_column *column = &table->columns[index % table->columns_count];
    const struct ceduo_page_cell *cell = &table->cells[index];
    LOCAL_TEXT(text);
    begin_piece(p, CEDUO_ROLE_TEXT, NULL);
    append_blanks(p->text, (size_t)gap);
    if (cell->kind == CEDUO_CELL_BAR) {
        begin_piece(p, cell->role, &cell->bar);
        append_blanks(p->text, (size_t)width);
        return;
    }
    size_t available = (size_t)abs(width) + ((column->flags & (COL_SHRINK | COL_GROW)) != 0);
    write_cell(p, &text, cell, available);
    if (p->width >= CEDUO_PAGE_WIDE && !p->drawing && cell->long_text.length > 0 &&
        (width == 0 || cell_fits(&cell->long_text, available))) {
        ceduo_text_free(&text);
        append_printable(p, &text, cell->long_text.bytes);
    }
    begin_piece(p, cell->role ? cell->role : role, NULL);
    if ((column->flags & COL_WRAP) && !cell_fits(&text, available)) {
        print_wrapped(p, ceduo_text_string(&text), (size_t)gap, (size_t)gap);
        end_line(p);
        append_blanks(p->text, (size_t)(gap + width));
    } else if (!(column->flags & COL_GROW) || index < table->columns_count || width <= 0 ||
               (int)ceduo_utf8_width(ceduo_text_string(&text)) <= width ||
               !print_distinct(p, table, index % table->columns_count, ceduo_text_string(&text), (size_t)width)) {
        print_padded(p, ceduo_text_string(&text), width, column->flags & COL_GROW);
    }
}

#define COLUMNS_MAX 24

/* Return the width of the widest cell in a column; set `*bars` if it has a bar. */
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

/* Return the gap before a column; a pane has no left margin. */
static int get_gap(const struct printer *p, const struct ceduo_page_column *column, size_t i)
{
    return i == 0 && p->drawing ? 0 : column->gap;
}

/* Set the width of each column; 0: dropped. */
static void set_widths(const struct printer *p, const struct ceduo_page_block *table, int *widths)
{
    size_t n = table->columns_count;
    int rest = (int)p->width, natural[COLUMNS_MAX], bars = 0, names = 0;
    bool has_bars[COLUMNS_MAX] = {false};
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_page_column *c = &table->columns[i];
        int share = (int)p->width / 2; /* max width of a name: truncate names before dropping columns */
        natural[i] = c->flags & (COL_SHRINK | COL_GROW) ? widest_cell(p, table, i, &has_bars[i]) : 0;
        widths[i] = c->flags & COL_SHRINK ? natural[i] : 0;
        if (c->flags & COL_GROW && !has_bars[i])
            widths[i] = natural[i] < share ? natural[i] : share;
        widths[i] = widths[i] > abs(c->width) ? widths[i] : abs(c->width);
        names += c->flags & COL_GROW ? widths[i] - abs(c->width) : 0; /* columns that truncating names can save */
        rest -= get_gap(p, c, i) + widths[i];
    }
    for (size_t rank = 9; rest < 0 && rank > 0; rank--) {
        bool dropped = rank >= COL_MINOR || rest + names < 0;
        for (size_t i = 0; i < n; i++)
            if (dropped && table->columns[i].flags >> 8 == rank) {
                rest += get_gap(p, &table->columns[i], i) + widths[i];
                widths[i] = 0;
            }
    }
    for (size_t i = 0; i < n; i++)
        bars += has_bars[i] && widths[i] > 0;
    for (size_t i = 0; i < n; i++) { /* names absorb the deficit, or the surplus if no bar does */
        int more = rest < natural[i] - widths[i] ? rest : natural[i] - widths[i],
            shrink_max = abs(table->columns[i].width) - widths[i];
        if (!(table->columns[i].flags & COL_GROW) || widths[i] == 0 || has_bars[i] || (rest > 0 && bars > 0))
            continue;
        more = more > shrink_max ? more : shrink_max;
        widths[i] += more;
        rest -= more;
    }
    for (size_t i = 0; i < n && p->width >= CEDUO_PAGE_WIDE && !p->drawing; i++) { /* long heads, if they fit */
        int more = (int)ceduo_utf8_width(ceduo_text_string(&table->cells[i].long_text)) + 1 - widths[i];
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
    set_widths(p, table, widths);
    for (size_t row = heads ? 0 : n; row + n <= table->cells_count; row += n) {
        for (size_t i = 0; i < n; i++) {
            const struct ceduo_page_column *c = &table->columns[i];
            int width = widths[i];
            if (width == 0 && c->width != 0)
                continue;
            if (c->width < 0)
                width = -width;
            else if (row == 0 && i == n - 1 && c->width > 0) /* the last head is never truncated */
                width = 0;
            print_cell(p, table, row + i, get_gap(p, c, i), width, row == 0 ? CEDUO_ROLE_AXIS : CEDUO_ROLE_TEXT);
        }
        while (!p->drawing && p->text->length > 0 && p->text->bytes[p->text->length - 1] == ' ')
            p->text->bytes[--p->text->length] = '\0';
        end_line(p);
    }
}

/* Print or draw all blocks; return the number of lines. */
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
