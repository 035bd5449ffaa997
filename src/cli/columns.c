/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of CSV: the copied cells of --each, then the cells of the result; with --columns, only chosen ones. */
#include "each.h"

#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "messages.h"

struct named_column {
    const char *name;
    size_t column;
};

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const struct named_column *)a)->name, ((const struct named_column *)b)->name);
}

/* Split a line of the program's CSV into at most `max` cells. */
static size_t split_line(const char *line, size_t length, struct csv_span *cells, size_t max)
{
    const char *p = line, *end = line + length;
    size_t n = 0;
    for (bool more = true; more && n < max; p++) {
        const char *from = p;
        bool quoted = false;
        for (; p < end && (quoted || *p != ','); p++)
            quoted ^= *p == '"';
        cells[n++] = (struct csv_span){from, (size_t)(p - from)};
        more = p < end;
    }
    return n;
}

/* Append the copied cells of the current row, or their heads, each with a comma. */
static void append_copied(const struct each *e, bool heads, struct text *line)
{
    for (size_t i = 0; i < e->heads_count; i++)
        if (ceduo_each_is_copied(&e->heads[i])) {
            ceduo_text_append_csv(line, heads ? e->heads[i].printed : e->cells[i]);
            ceduo_text_append_char(line, ',');
        }
}

/* Append the chosen columns of a line. */
static void append_line(const struct columns *c, const struct text *line, struct text *out)
{
    if (!c->chosen) {
        ceduo_text_append_n(out, line->bytes, line->length);
    } else {
        size_t n = split_line(line->bytes, line->length, c->cells, c->count);
        for (size_t k = 0; k < c->chosen_count; k++) {
            ceduo_text_append(out, k > 0 ? "," : "");
            if (c->chosen[k] < n)
                ceduo_text_append_n(out, c->cells[c->chosen[k]].p, c->cells[c->chosen[k]].n);
        }
    }
    ceduo_text_append_char(out, '\n');
}

/* Find the columns of --columns among n sorted names. */
static enum exit_status choose_columns(struct columns *c, const struct named_column *names, size_t n)
{
    const char *list = c->each->given->columns;
    size_t length;
    c->chosen = ceduo_arena_alloc(&c->each->arena, (strlen(list) + 1) * sizeof *c->chosen);
    for (const char *word = list; *word; word += length + (word[length] == ',')) {
        length = strcspn(word, ",");
        const struct named_column wanted = {ceduo_arena_copy(&c->each->arena, word, length), 0};
        const struct named_column *found = bsearch(&wanted, names, n, sizeof *names, compare_names);
        if (found) {
            c->chosen[c->chosen_count++] = found->column;
            continue;
        }
        const char **all = ceduo_arena_alloc(&c->each->arena, (n + 1) * sizeof *all);
        for (size_t i = 0; i < n; i++)
            all[i] = names[i].name;
        const char *near = ceduo_text_nearest(wanted.name, all, n);
        return near ? ceduo_usage_error("columns", _("no column '%s'; did you mean '%s'?"), wanted.name, near)
                    : ceduo_usage_error("columns", _("no column '%s'; --list-columns names all"), wanted.name);
    }
    return EXIT_DONE;
}

enum exit_status ceduo_columns_open(struct columns *c, struct each *e, const struct text *header)
{
    *c = (struct columns){.each = e};
    size_t max = 1, length = header->length > 0 ? header->length - 1 : 0; /* without the line end */
    for (size_t i = 0; i < length; i++)
        max += header->bytes[i] == ',';
    struct csv_span *own = ceduo_arena_alloc(&e->arena, max * sizeof *own);
    size_t own_count = length > 0 ? split_line(header->bytes, length, own, max) : 0, n = 0;
    struct named_column *names = ceduo_arena_alloc(&e->arena, (own_count + e->heads_count + 1) * sizeof *names);
    for (size_t i = 0; i < own_count; i++)
        names[i] = (struct named_column){ceduo_arena_copy(&e->arena, own[i].p, own[i].n), i};
    qsort(names, own_count, sizeof *names, compare_names);
    for (size_t i = 0; i < e->heads_count; i++) {
        struct each_head *head = &e->heads[i];
        if (!ceduo_each_is_copied(head))
            continue;
        if (bsearch(&(struct named_column){head->name, 0}, names, own_count, sizeof *names, compare_names))
            head->printed = ceduo_arena_format(&e->arena, "row.%s", head->name);
        names[own_count + n] = (struct named_column){head->printed, n};
        n++;
    }
    for (size_t i = 0; i < own_count; i++)
        names[i].column += n;
    c->count = own_count + n;
    qsort(names, c->count, sizeof *names, compare_names);
    c->cells = ceduo_arena_alloc(&e->arena, (c->count + 1) * sizeof *c->cells);
    return e->given->columns ? choose_columns(c, names, c->count) : EXIT_DONE;
}

void ceduo_columns_head(const struct columns *c, const struct text *header, struct text *out)
{
    LOCAL_TEXT(line);
    append_copied(c->each, true, &line);
    ceduo_text_append_n(&line, header->bytes, header->length - 1);
    append_line(c, &line, out);
}

void ceduo_columns_lines(const struct columns *c, const struct text *lines, struct text *out)
{
    for (const char *p = ceduo_text_string(lines), *end; (end = strchr(p, '\n')); p = end + 1) {
        LOCAL_TEXT(line);
        append_copied(c->each, false, &line);
        ceduo_text_append_n(&line, p, (size_t)(end - p));
        append_line(c, &line, out);
    }
}
