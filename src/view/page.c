/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "svg.h"

static struct ceduo_page_block *add_block(struct ceduo_page *page, enum ceduo_page_kind kind)
{
    struct ceduo_page_block *block = ceduo_check_memory(calloc(1, sizeof *block));
    block->kind = kind;
    *(page->last ? &page->last->next : &page->first) = block;
    page->last = block;
    return block;
}

struct text *ceduo_page_add(struct ceduo_page *page, enum ceduo_page_kind kind)
{
    return &add_block(page, kind)->text;
}

void ceduo_page_para(struct ceduo_page *page, enum ceduo_page_kind kind, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(ceduo_page_add(page, kind), format, args);
    va_end(args);
}

void ceduo_page_para_role(struct ceduo_page *page, enum ceduo_role role, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(ceduo_page_add(page, CEDUO_PAGE_NOTE), format, args);
    va_end(args);
    page->last->role = role;
}

struct text *ceduo_page_item(struct ceduo_page *page, enum ceduo_page_kind kind, const char *label)
{
    struct text *text = ceduo_page_add(page, kind);
    ceduo_text_format(text, "%s\t", label);
    return text;
}

void ceduo_page_table(struct ceduo_page *page, const struct ceduo_page_column *columns, size_t n)
{
    struct ceduo_page_block *table = add_block(page, CEDUO_PAGE_TABLE);
    table->columns = ceduo_check_memory(malloc((n + 1) * sizeof *columns));
    memcpy(table->columns, columns, n * sizeof *columns);
    table->columns_count = n;
    for (size_t i = 0; i < n; i++) {
        const char *head = columns[i].head && columns[i].head[0] ? ceduo_translate_in(columns[i].head) : "";
        size_t short_length = strcspn(head, "|");
        struct ceduo_page_cell *cell = ceduo_page_cell(page);
        ceduo_text_append_n(&cell->text, head, short_length);
        ceduo_text_append(&cell->long_text, head + short_length + (head[short_length] != '\0'));
    }
}

struct ceduo_page_cell *ceduo_page_head(struct ceduo_page *page)
{
    size_t i = 0;
    while (page->last->columns[i].head)
        i++;
    return &page->last->cells[i];
}

struct ceduo_page_cell *ceduo_page_cell(struct ceduo_page *page)
{
    struct ceduo_page_block *table = page->last;
    table->cells =
        ceduo_check_memory(ceduo_grow(table->cells, table->cells_count, &table->cells_capacity, sizeof *table->cells));
    table->cells[table->cells_count] = (struct ceduo_page_cell){.kind = CEDUO_CELL_TEXT};
    return &table->cells[table->cells_count++];
}

struct text *ceduo_page_text(struct ceduo_page *page)
{
    return &ceduo_page_cell(page)->text;
}

void ceduo_page_cell_format(struct ceduo_page *page, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(ceduo_page_text(page), format, args);
    va_end(args);
}

void ceduo_page_number(struct ceduo_page *page, double value, int digits)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    cell->kind = CEDUO_CELL_NUMBER;
    cell->value = value;
    cell->digits = digits;
}

struct ceduo_page_bar *ceduo_page_bar(struct ceduo_page *page, double value, enum ceduo_role role)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    cell->kind = CEDUO_CELL_BAR;
    cell->role = role;
    cell->bar =
        (struct ceduo_page_bar){.to = value, .error_lo = NAN, .error_hi = NAN, .limit = NAN, .limit_role = CEDUO_ROLE_CONTROL};
    return &cell->bar;
}

void ceduo_page_scale(struct ceduo_page *page, size_t column, double lo, double hi)
{
    const struct ceduo_page_block *table = page->last;
    for (size_t i = column; i < table->cells_count; i += table->columns_count) {
        struct ceduo_page_bar *b = &table->cells[i].bar;
        double *const ends[] = {&b->from, &b->to, &b->error_lo, &b->error_hi, &b->limit};
        for (size_t k = 0; k < sizeof ends / sizeof ends[0]; k++) {
            double value = *ends[k], share = lo > 0 && isfinite(value) ? log(value / lo) / log(hi / lo) : value / hi;
            bool limit = ends[k] == &b->limit; /* a limit beyond the scale is not clamped, so it is not drawn */
            if (!isnan(value))
                *ends[k] = limit ? share : fmin(1, fmax(0, share));
        }
    }
}

void ceduo_page_cell_role(struct ceduo_page *page, enum ceduo_role role, const char *string)
{
    struct ceduo_page_cell *cell = ceduo_page_cell(page);
    cell->role = role;
    ceduo_text_append(&cell->text, string);
}

struct ceduo_page_block *ceduo_page_picture(struct ceduo_page *page, struct ceduo_svg *svg, bool side_by_side)
{
    struct ceduo_page_block *block = add_block(page, CEDUO_PAGE_PICTURE);
    block->svg = svg;
    block->side_by_side = side_by_side;
    return block;
}

static void free_cell(struct ceduo_page_cell *cell)
{
    ceduo_text_free(&cell->text);
    ceduo_text_free(&cell->shorter);
    ceduo_text_free(&cell->long_text);
}

void ceduo_page_trim(struct ceduo_page *page)
{
    struct ceduo_page_block *t = page->last;
    for (size_t i = t->columns_count; i-- > 0;) {
        size_t n = t->columns_count, kept = 0;
        bool empty = true;
        for (size_t k = n + i; k < t->cells_count; k += n) {
            const char *text = ceduo_text_string(&t->cells[k].text);
            empty =
                empty && (t->cells[k].kind == CEDUO_CELL_BAR ? isnan(t->cells[k].bar.to) : strspn(text, "-?") == strlen(text));
        }
        for (size_t k = 0; empty && k < t->cells_count; k++)
            if (k % n == i)
                free_cell(&t->cells[k]);
            else
                t->cells[kept++] = t->cells[k];
        if (empty) {
            memmove(&t->columns[i], &t->columns[i + 1], (n - i - 1) * sizeof *t->columns);
            t->columns_count--;
            t->cells_count = kept;
        }
    }
}

static void free_block(struct ceduo_page_block *block)
{
    for (size_t i = 0; i < block->cells_count; i++)
        free_cell(&block->cells[i]);
    free(block->cells);
    free(block->columns);
    ceduo_svg_free(block->svg);
    ceduo_text_free(&block->description);
    ceduo_text_free(&block->text);
    free(block);
}

void ceduo_page_drop(struct ceduo_page *page)
{
    struct ceduo_page_block *prev = NULL, *last = page->first;
    for (; last->next; last = last->next)
        prev = last;
    *(prev ? &prev->next : &page->first) = NULL;
    page->last = prev;
    free_block(last);
}

void ceduo_page_free(struct ceduo_page *page)
{
    for (struct ceduo_page_block *block = page->first, *next; block; block = next) {
        next = block->next;
        free_block(block);
    }
    *page = (struct ceduo_page){.width = page->width};
}
