/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cells.h"

#include <ctype.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base/oom.h"
#include "base/text.h"
#include "base/utf8.h"

/* ---- Grid ---- */

static size_t cell_count(const struct ceduo_cells *cells)
{
    return (size_t)cells->width * (size_t)cells->height;
}

size_t ceduo_cells_dots(const struct ceduo_cells *cells)
{
    return cell_count(cells) * (size_t)(cells->canvas.dots_x * cells->canvas.dots_y);
}

struct ceduo_cells *ceduo_cells_create(int width, int height, enum ceduo_charset charset)
{
    if (width < 1 || width > CEDUO_CANVAS_MAX_WIDTH || height < 1 || height > CEDUO_CANVAS_MAX_HEIGHT)
        return NULL;
    struct ceduo_cells *cells = ceduo_check_memory(calloc(1, sizeof *cells));
    cells->width = width;
    cells->height = height;
    cells->charset = charset;
    cells->canvas = (struct ceduo_canvas){.surface = &ceduo_cells_surface,
                                          .cells = cells,
                                          .to = cells,
                                          .dots_x = charset == CEDUO_CHARSET_ASCII ? 1 : 2,
                                          .dots_y = charset == CEDUO_CHARSET_BRAILLE ? 4 : 2};
    cells->cell = ceduo_check_memory(calloc(cell_count(cells), sizeof *cells->cell));
    return cells;
}

void ceduo_cells_free(struct ceduo_cells *cells)
{
    if (cells == NULL)
        return;
    free(cells->density);
    free(cells->cell);
    free(cells);
}

void ceduo_cells_clear(struct ceduo_cells *cells)
{
    memset(cells->cell, 0, cell_count(cells) * sizeof *cells->cell);
    if (cells->density != NULL)
        memset(cells->density, 0, ceduo_cells_dots(cells) * sizeof *cells->density);
}

void ceduo_cells_clear_area(struct ceduo_cells *cells, struct ceduo_area area)
{
    for (int y = area.top; y < area.top + area.height; y++)
        for (int x = area.left; x < area.left + area.width; x++) {
            struct ceduo_cell *cell = ceduo_cells_at(cells, x, y);
            if (cell)
                *cell = (struct ceduo_cell){0};
        }
}

struct ceduo_cell *ceduo_cells_at(const struct ceduo_cells *cells, int column, int row)
{
    if (column < 0 || column >= cells->width || row < 0 || row >= cells->height)
        return NULL;
    return &cells->cell[(size_t)row * (size_t)cells->width + (size_t)column];
}

const uint8_t ceduo_role_ranks[CEDUO_ROLE_COUNT] = {
#define X(NAME, letter, rank) [CEDUO_ROLE_##NAME] = rank,
    CEDUO_ROLES(X)
#undef X
};

void ceduo_cells_set_dot(struct ceduo_cells *cells, int x, int y, enum ceduo_role role)
{
    if (x < 0 || y < 0 || role == CEDUO_ROLE_BLANK)
        return;
    int across = cells->canvas.dots_x, down = cells->canvas.dots_y;
    struct ceduo_cell *cell = ceduo_cells_at(cells, x / across, y / down);
    if (cell == NULL)
        return;
    unsigned bit = (unsigned)(y % down * across + x % across);
    cell->dots = (uint8_t)(cell->dots | 1U << bit);
    if (cell->code == 0 && ceduo_role_ranks[role] > ceduo_role_ranks[cell->role])
        cell->role = (uint8_t)role;
}

void ceduo_cells_set_code(struct ceduo_cells *cells, int column, int row, enum ceduo_role role, uint32_t code)
{
    struct ceduo_cell *cell = ceduo_cells_at(cells, column, row);
    if (cell == NULL || role == CEDUO_ROLE_BLANK)
        return;
    cell->code = code;
    cell->role = (uint8_t)role;
}

/* ---- Text ---- */

/* Return the replacement of a character in ASCII. A degree sign becomes a blank, because "35o" reads as 350. */
static const char *find_ascii(uint32_t code)
{
    static const struct {
        uint16_t first, last;
        char text[4];
    } table[] = {
        {0xA0, 0xA0, " "},      {0xAB, 0xAB, "\""},     {0xB0, 0xB0, " "},       {0xB1, 0xB1, "+-"},
        {0xB2, 0xB2, "2"},      {0xB3, 0xB3, "3"},      {0xB5, 0xB5, "u"},       {0xB7, 0xB7, "."},
        {0xBB, 0xBB, "\""},     {0xC0, 0xC3, "A"},      {0xC4, 0xC4, "Ae"},      {0xC5, 0xC5, "A"},
        {0xC6, 0xC6, "AE"},     {0xC7, 0xC7, "C"},      {0xC8, 0xCB, "E"},       {0xCC, 0xCF, "I"},
        {0xD1, 0xD1, "N"},      {0xD2, 0xD5, "O"},      {0xD6, 0xD6, "Oe"},      {0xD7, 0xD7, "x"},
        {0xD8, 0xD8, "O"},      {0xD9, 0xDB, "U"},      {0xDC, 0xDC, "Ue"},      {0xDD, 0xDD, "Y"},
        {0xDF, 0xDF, "ss"},     {0xE0, 0xE3, "a"},      {0xE4, 0xE4, "ae"},      {0xE5, 0xE5, "a"},
        {0xE6, 0xE6, "ae"},     {0xE7, 0xE7, "c"},      {0xE8, 0xEB, "e"},       {0xEC, 0xEF, "i"},
        {0xF1, 0xF1, "n"},      {0xF2, 0xF5, "o"},      {0xF6, 0xF6, "oe"},      {0xF7, 0xF7, "/"},
        {0xF8, 0xF8, "o"},      {0xF9, 0xFB, "u"},      {0xFC, 0xFC, "ue"},      {0xFD, 0xFD, "y"},
        {0xFF, 0xFF, "y"},      {0x2002, 0x200A, " "},  {0x2010, 0x2015, "-"},   {0x2018, 0x2019, "'"},
        {0x201C, 0x201E, "\""}, {0x2022, 0x2022, "*"},  {0x2026, 0x2026, "..."}, {0x202F, 0x202F, " "},
        {0x2032, 0x2032, "'"},  {0x2190, 0x2190, "<-"}, {0x2191, 0x2191, "^"},   {0x2192, 0x2192, "->"},
        {0x2193, 0x2193, "v"},  {0x2205, 0x2205, "O"},  {0x2212, 0x2212, "-"},   {0x221E, 0x221E, "inf"},
        {0x2248, 0x2248, "~"},  {0x2260, 0x2260, "!="}, {0x2264, 0x2264, "<="},  {0x2265, 0x2265, ">="},
        {0x2500, 0x2501, "-"},  {0x2502, 0x2503, "|"},  {0x250C, 0x254B, "+"},   {0x2550, 0x2550, "="},
        {0x2551, 0x2551, "|"},  {0x2552, 0x2570, "+"},  {0x2580, 0x2590, "#"},   {0x2591, 0x2591, "."},
        {0x2592, 0x2592, ":"},  {0x2593, 0x2593, "#"},  {0x25A0, 0x25A0, "#"},   {0x25B2, 0x25B3, "^"},
        {0x25B6, 0x25B8, ">"},  {0x25BC, 0x25BD, "v"},  {0x25C0, 0x25C2, "<"},   {0x25C6, 0x25C7, "*"},
        {0x25CB, 0x25CB, "o"},  {0x25CF, 0x25CF, "o"},  {0x2660, 0x2660, "Y"},   {0x2663, 0x2663, "Y"},
        {0x26A0, 0x26A0, "!"},  {0x2713, 0x2714, "+"},  {0x2717, 0x2718, "x"},
    };
    for (size_t i = 0; i < sizeof table / sizeof table[0]; ++i)
        if (code >= table[i].first && code <= table[i].last)
            return table[i].text;
    return "?";
}

/* Iterator over a text, one cell at a time. */
struct reader {
    enum ceduo_charset charset;
    const char *begin, *text;
    const char *pending; /* rest of an ASCII replacement, in a constant table */
};

bool ceduo_is_power(const char *string, const char *digit)
{
    return (*digit == '2' || *digit == '3') && digit > string && digit[-1] == 'm' &&
           (digit == string + 1 || strchr(" /(", digit[-2])) && !isalnum((unsigned char)digit[1]) &&
           !(digit[1] && strchr("_.=[", digit[1]) && digit[2] > ' ');
}

#define DEGREE 0xB0

/* Return the next code point; 0 at the end. */
static uint32_t next_code(struct reader *reader)
{
    if (*reader->pending != '\0')
        return (uint32_t)*reader->pending++;
    if (*reader->text == '\0')
        return 0;
    if (reader->charset != CEDUO_CHARSET_ASCII && ceduo_is_power(reader->begin, reader->text))
        return *reader->text++ == '2' ? 0xB2 : 0xB3;
    if (*reader->text >= ' ' && *reader->text <= '~') /* fast path */
        return (uint32_t)*reader->text++;
    uint32_t code;
    size_t n = ceduo_utf8_decode(reader->text, strnlen(reader->text, 4), &code);
    reader->text += n > 0 ? n : 1;
    if (n == 0 || !ceduo_utf8_printable(code) || ceduo_utf8_columns(code) != 1)
        return '?';
    if (reader->charset != CEDUO_CHARSET_ASCII || code < 0x80)
        return code;
    if (code == DEGREE && *reader->text && strchr(",.;:)", *reader->text)) /* no blank before punctuation */
        return (uint32_t)*reader->text++;
    reader->pending = find_ascii(code);
    return (uint32_t)*reader->pending++;
}

int ceduo_cells_label(struct ceduo_cells *cells, int column, int row, enum ceduo_role role, const char *text)
{
    struct reader reader = {cells->charset, text, text, ""};
    int count = 0;
    uint32_t code;
    while (count < INT_MAX && (code = next_code(&reader)) != 0) {
        if (column < cells->width)
            ceduo_cells_set_code(cells, column++, row, role, code);
        ++count;
    }
    return count;
}

int ceduo_cells_label_end(struct ceduo_cells *cells, int column, int row, int max, enum ceduo_role role, const char *text)
{
    const char *mark = cells->charset == CEDUO_CHARSET_ASCII ? "~" : "\xe2\x80\xa6";
    bool cut = max > 0 && ceduo_cells_label_width(cells->charset, text) > max;
    int mark_width = cut ? ceduo_cells_label(cells, column, row, role, mark) : 0;
    while (*text && ceduo_cells_label_width(cells->charset, text) > max - mark_width)
        text += ceduo_utf8_step(text);
    return mark_width + ceduo_cells_label(cells, column + mark_width, row, role, text);
}

void ceduo_cells_ascii(struct text *text, const char *string)
{
    struct reader reader = {CEDUO_CHARSET_ASCII, string, string, ""};
    for (uint32_t code; (code = next_code(&reader)) != 0;)
        ceduo_text_append_char(text, (char)code);
}

int ceduo_cells_label_width(enum ceduo_charset charset, const char *text)
{
    struct reader reader = {charset, text, text, ""};
    int count = 0;
    while (count < INT_MAX && next_code(&reader) != 0)
        ++count;
    return count;
}

/* ---- Output ---- */

uint32_t ceduo_cells_glyph(const struct ceduo_cells *cells, int column, int row)
{
    /* Unicode Braille: the upper six dots column by column, then the lowest two. */
    static const uint8_t braille[8] = {0x01, 0x08, 0x02, 0x10, 0x04, 0x20, 0x40, 0x80};
    /* Bits: 1 upper left, 2 upper right, 4 lower left, 8 lower right. */
    static const uint16_t blocks[16] = {' ',    0x2598, 0x259D, 0x2580, 0x2596, 0x258C, 0x259E, 0x259B,
                                        0x2597, 0x259A, 0x2590, 0x259C, 0x2584, 0x2599, 0x259F, 0x2588};
    const struct ceduo_cell *cell = ceduo_cells_at(cells, column, row);
    uint32_t code = 0x2800;
    if (cell && cell->code != 0)
        return cell->code;
    if (!cell || cell->dots == 0)
        return ' ';
    if (cells->charset != CEDUO_CHARSET_BRAILLE)
        return cells->charset == CEDUO_CHARSET_BLOCK ? blocks[cell->dots & 15U] : (uint32_t) " '.:"[cell->dots & 3U];
    for (unsigned i = 0; i < 8; ++i)
        code |= cell->dots >> i & 1U ? braille[i] : 0;
    return code;
}

enum ceduo_role ceduo_cells_role(const struct ceduo_cells *cells, int column, int row)
{
    const struct ceduo_cell *cell = ceduo_cells_at(cells, column, row);
    return cell == NULL ? CEDUO_ROLE_BLANK : (enum ceduo_role)cell->role;
}

void ceduo_cells_text(const struct ceduo_cells *cells, int row, struct text *text)
{
    int end = cells->width;
    while (end > 0 && ceduo_cells_glyph(cells, end - 1, row) == ' ')
        --end;
    for (int column = 0; column < end; ++column) {
        char bytes[4];
        ceduo_text_append_n(text, bytes, ceduo_utf8_encode(ceduo_cells_glyph(cells, column, row), bytes));
    }
}

char *ceduo_cells_dump(const struct ceduo_cells *cells)
{
    struct text text = {0};
    for (int row = 0; row < cells->height; ++row) {
        ceduo_cells_text(cells, row, &text);
        ceduo_text_append_char(&text, '\n');
    }
    return text.bytes;
}

char *ceduo_cells_roles(const struct ceduo_cells *cells)
{
    static const char letters[] = {
#define X(NAME, letter, rank) letter,
        CEDUO_ROLES(X)
#undef X
    };
    char *roles = ceduo_check_memory(malloc(((size_t)cells->width + 1) * (size_t)cells->height + 1)), *to = roles;
    for (int row = 0; row < cells->height; ++row) {
        char *end = to;
        for (int column = 0; column < cells->width; ++column) {
            *to++ = letters[ceduo_cells_role(cells, column, row)];
            end = to[-1] == ' ' ? end : to;
        }
        to = end;
        *to++ = '\n';
    }
    *to = '\0';
    return roles;
}
