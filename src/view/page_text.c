/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints a page for a terminal: paragraphs are wrapped, cells set below one another, numbers written with as many digits as
 * their column has room for. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/utf8.h"
#include "page.h"
#include "words.h"

#define SMALLEST 1e-290 /* a number below it is written as 0: powers of ten with more digits than it has do not exist */

struct printer {
    struct text *text;
    size_t width;
    bool plain; /* ASCII alone */
};

static void put_blanks(struct text *text, size_t n)
{
    while (n-- > 0)
        ceduo_text_char(text, ' ');
}

/* What may be printed: no control characters, and the signs of a page in ASCII where the terminal knows no other. */
static void put_safe(const struct printer *p, struct text *to, const char *string)
{
    static const char *const signs[][2] = {{"\xe2\x80\x93", "-"}, {"\xe2\x88\x92", "-"}, {"\xc2\xb1", "+-"}};
    struct text safe = {0};
    ceduo_text_safe(&safe, string);
    for (const char *at = ceduo_text_string(&safe); *at;) {
        size_t i = 0, n = 1;
        while (i < 3 && strncmp(at, signs[i][0], n = strlen(signs[i][0])) != 0)
            i++;
        if (i < 3 && p->plain)
            ceduo_text_put(to, signs[i][1]);
        else
            ceduo_text_add(to, at, n = i < 3 ? n : 1);
        at += n;
    }
    ceduo_text_free(&safe);
}

/* ---- paragraphs ---- */

/* How a kind of block begins, and how far its other lines are indented. */
static const struct {
    const char *first;
    size_t indent;
} styles[] = {[CEDUO_PAGE_TITLE] = {"", 0},        [CEDUO_PAGE_FACT] = {"", 9},        [CEDUO_PAGE_SECTION] = {"", 2},
              [CEDUO_PAGE_PLACE] = {"  ", 4},      [CEDUO_PAGE_CAPTION] = {"    ", 4}, [CEDUO_PAGE_SENTENCE] = {"    ", 6},
              [CEDUO_PAGE_DETAIL] = {"      ", 8}, [CEDUO_PAGE_NOTE] = {"  ", 2},      [CEDUO_PAGE_ITEM] = {"  ", 4},
              [CEDUO_PAGE_WARNING] = {"    ! ", 6}};

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
static void put_wrapped(const struct printer *p, const char *string, size_t column, size_t indent)
{
    for (const char *at = string, *next; *at; at = next) {
        size_t n = ceduo_utf8_wrap(at, p->width > column ? p->width - column : 1, &next);
        if (at > string) {
            ceduo_text_char(p->text, '\n');
            put_blanks(p->text, indent);
        }
        ceduo_text_add(p->text, at, n);
        column = indent;
    }
}

static void put_paragraph(const struct printer *p, const struct ceduo_page_block *block)
{
    size_t indent = styles[block->kind].indent, column;
    struct text first = {0}, rest = {0};
    ceduo_text_put(&first, block->label ? block->label : styles[block->kind].first);
    if (block->label && ceduo_utf8_width(ceduo_text_string(&first)) < indent)
        put_blanks(&first, indent - ceduo_utf8_width(ceduo_text_string(&first)));
    put_safe(p, &rest, ceduo_text_string(&block->text));
    squeeze(&rest);
    if (block->kind == CEDUO_PAGE_SECTION)
        ceduo_text_char(p->text, '\n');
    ceduo_text_put(p->text, ceduo_text_string(&first));
    column = ceduo_utf8_width(ceduo_text_string(&first));
    put_wrapped(p, ceduo_text_string(&rest), column, indent);
    ceduo_text_char(p->text, '\n');
    ceduo_text_free(&first);
    ceduo_text_free(&rest);
}

/* ---- cells ---- */

/* Set into so many columns and cut where it is longer; negative: to the right; 0: as it comes. */
static void put_padded(const struct printer *p, const char *string, int width)
{
    size_t want = (size_t)abs(width), have = ceduo_utf8_width(string);
    if (width < 0 && have < want)
        put_blanks(p->text, want - have);
    if (have <= want || want == 0) {
        ceduo_text_put(p->text, string);
    } else {
        size_t n = ceduo_utf8_cut(string, want - 1);
        ceduo_text_add(p->text, string, n);
        ceduo_text_put(p->text, p->plain ? "~" : "\xe2\x80\xa6");
        have = ceduo_utf8_width_of(string, n) + 1;
    }
    if (width > 0 && have < want)
        put_blanks(p->text, want - have);
}

/* Whether it has room in a column, with a blank before it. */
static bool fits(const struct text *cell, size_t width)
{
    return ceduo_utf8_width(ceduo_text_string(cell)) < width;
}

/* As short as can be: 3e26, 7e-3; where that has no more room either, what is small as 0.00. */
static void write_shortest(struct text *cell, double value, size_t width)
{
    char power[16];
    snprintf(power, sizeof power, "%.0e", value);
    ceduo_text_free(cell);
    ceduo_text_format(cell, "%.*se%ld", (int)strcspn(power, "e"), power, strtol(strchr(power, 'e') + 1, NULL, 10));
    if (fabs(value) < 1 && !fits(cell, width)) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.*f", (int)width - (value < 0 ? 4 : 3), value);
    }
}

/* A number; in thousands or millions (134e3) where it has no room, or with fewer digits. */
static void write_number(struct text *cell, double value, int digits, size_t width)
{
    ceduo_words_number(cell, value, digits);
    for (int e = 3; e <= 9 && fabs(value) >= 1e3 && !fits(cell, width); e += 3) {
        ceduo_text_free(cell);
        ceduo_text_format(cell, "%.0fe%d", value / pow(10, e), e);
    }
    while (digits > 1 && !fits(cell, width)) {
        ceduo_text_free(cell);
        ceduo_words_number(cell, value, --digits);
    }
    if (isfinite(value) && !fits(cell, width))
        write_shortest(cell, value, width);
}

/* A mean and its error with so many digits; false where the mean has none after so few. */
static bool write_digits(struct text *text, double mean, double half, int digits, const char *sign)
{
    ceduo_text_free(text);
    ceduo_words_number(text, mean, digits);
    if (digits == 4 || isnan(half)) {
        ceduo_text_format(text, " %s", sign);
        ceduo_words_number(text, half, 2);
        return true;
    }
    if (strchr(ceduo_text_string(text), 'e'))
        return false;
    /* the error up to whole units of the mean's last place */
    const char *point = strchr(ceduo_text_string(text), '.');
    int places = point ? (int)strlen(point + 1) : 0;
    double unit = pow(10, -places);
    ceduo_text_format(text, "%s%.*f", sign, places, ceil(half / unit) * unit);
    return true;
}

/* A mean and its error, with as many digits as have room; (2.0±0.3)e6 where no other way has. */
static void write_mean(struct text *text, double mean, double half, size_t width, const char *sign)
{
    if (mean < SMALLEST) {
        mean = 0;
        half = isnan(half) ? half : 0;
    }
    for (int digits = 4; digits > 0 && write_digits(text, mean, half, digits, sign); digits--)
        if (fits(text, width))
            return;
    int e = mean > 0 ? (int)floor(log10(mean)) : 0;
    for (int places = 1; places >= 0; places--) {
        double unit = pow(10, e - places);
        ceduo_text_free(text);
        if (isnan(half)) /* of one rock */
            ceduo_text_format(text, "%.*fe%d %s-", places, mean / pow(10, e), e, sign);
        else
            ceduo_text_format(text, "(%.*f%s%.*f)e%d", places, mean / pow(10, e), sign, places,
                              ceil(half / unit) * pow(10, -places), e);
        if (fits(text, width))
            return;
    }
}

void ceduo_page_write_cell(struct text *to, const struct ceduo_page_cell *cell, size_t width, bool plain)
{
    const struct printer p = {.plain = plain};
    if (cell->kind == CEDUO_CELL_NUMBER)
        write_number(to, cell->value, cell->digits, width);
    else if (cell->kind == CEDUO_CELL_MEAN)
        write_mean(to, cell->value, cell->half, width, plain ? "+-" : "\xc2\xb1");
    else
        put_safe(&p, to, ceduo_text_string(&cell->text));
    if (cell->shorter.length > 0 && !fits(to, width)) {
        ceduo_text_free(to);
        put_safe(&p, to, ceduo_text_string(&cell->shorter));
    }
}

static void put_cell(const struct printer *p, const struct ceduo_page_column *column, const struct ceduo_page_cell *cell,
                     int width)
{
    struct text text = {0};
    put_blanks(p->text, (size_t)column->gap);
    ceduo_page_write_cell(&text, cell, (size_t)abs(width), p->plain);
    if ((column->flags & CEDUO_WHOLE) && !fits(&text, (size_t)width)) {
        put_wrapped(p, ceduo_text_string(&text), (size_t)column->gap, (size_t)column->gap);
        ceduo_text_char(p->text, '\n');
        put_blanks(p->text, (size_t)(column->gap + width));
    } else {
        put_padded(p, ceduo_text_string(&text), width);
    }
    ceduo_text_free(&text);
}

static void put_table(const struct printer *p, const struct ceduo_page_block *table)
{
    size_t n = table->columns_count;
    for (size_t row = 0; row + n <= table->cells_count; row += n) {
        for (size_t i = 0; i < n; i++) {
            const struct ceduo_page_column *c = &table->columns[i];
            bool spans = row == 0 && (c->flags & CEDUO_SPAN);
            int width = c->width;
            if (spans)
                width = abs(width) + c[1].gap + c[1].width;
            else if (row == 0 && i == n - 1 && width > 0) /* the last head is never cut */
                width = 0;
            put_cell(p, c, &table->cells[row + i], width);
            i += spans;
        }
        ceduo_text_char(p->text, '\n');
    }
}

void ceduo_page_print(struct text *text, const struct ceduo_page *page, bool plain)
{
    const struct printer p = {text, page->width, plain};
    text->failed |= ceduo_page_failed(page);
    for (const struct ceduo_page_block *block = page->first; block; block = block->next) {
        if (block->kind == CEDUO_PAGE_TABLE)
            put_table(&p, block);
        else if (block->kind == CEDUO_PAGE_GAP)
            ceduo_text_char(text, '\n');
        else if (block->kind <= CEDUO_PAGE_WARNING)
            put_paragraph(&p, block);
    }
}
