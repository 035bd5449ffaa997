/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines of CSV: the copied cells of --each, the state of the row, then the cells of the result. --columns chooses among
 * them. */
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "each.h"
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

/* ---- choice ---- */

/* Add a column to the chosen ones. `name`: its head. */
static void choose(struct columns *c, size_t column, const char *name)
{
    c->chosen[c->chosen_count++] = (struct chosen_column){column, name};
}

/* Choose the copied cells without the geometry of a feature, with --key only the key. With --each also choose the state of the
 * row, except `run`. Choose all of the result. */
static void choose_usual(struct columns *c)
{
    const struct each *e = c->each;
    size_t n = 0;
    for (size_t i = 0; i < e->heads_count; i++) {
        bool geometry = e->given->format == CEDUO_GEOJSON && (e->wkt == NO_COLUMN ? i == e->x || i == e->y : i == e->wkt);
        if (ceduo_each_is_shown(e, i) && (e->key != NO_COLUMN || !geometry))
            choose(c, n, c->names[n]);
        n += ceduo_each_is_copied(e, i);
    }
    for (size_t i = c->copied_count; e->rows && i < c->result_begin; i++)
        if (strcmp(c->names[i], "run") != 0)
            choose(c, i, c->names[i]);
    for (size_t i = c->result_begin; i < c->count; i++)
        choose(c, i, c->names[i]);
}

static enum exit_status report_unknown(const struct columns *c, const char *name)
{
    const char *near = ceduo_text_nearest(name, c->names, c->count);
    return near ? ceduo_usage_error("columns", _("no column '%s'; did you mean '%s'?"), name, near)
                : ceduo_usage_error("columns", _("no column '%s'; --list-columns names all"), name);
}

/* Choose the columns of --columns, PATH or NAME=PATH, among `count` sorted names. */
static enum exit_status choose_listed(struct columns *c, const struct named_column *sorted)
{
    struct arena *arena = &c->each->arena;
    const char *word = c->each->given->columns;
    do { /* an empty list names no column */
        size_t length = strcspn(word, ",");
        struct named_column wanted = {ceduo_arena_copy(arena, word, length), 0};
        const char *name = wanted.name, *equals = strchr(name, '=');
        const struct named_column *found = bsearch(&wanted, sorted, c->count, sizeof *sorted, compare_names);
        if (!found && equals) {
            name = ceduo_arena_copy(arena, name, (size_t)(equals - name));
            wanted.name = equals + 1;
            found = bsearch(&wanted, sorted, c->count, sizeof *sorted, compare_names);
        }
        if (!found)
            return report_unknown(c, wanted.name);
        if (!name[0])
            return ceduo_usage_error("columns", _("'=%s' has no name; write NAME=%s"), wanted.name, wanted.name);
        choose(c, found->column, name);
        word += length + (word[length] == ',');
    } while (*word);
    return EXIT_DONE;
}

/* Report two chosen columns with one head. */
static enum exit_status check_heads(const struct columns *c)
{
    struct named_column *sorted = ceduo_arena_alloc(&c->each->arena, (c->chosen_count + 1) * sizeof *sorted);
    for (size_t i = 0; i < c->chosen_count; i++)
        sorted[i] = (struct named_column){c->chosen[i].name, i};
    qsort(sorted, c->chosen_count, sizeof *sorted, compare_names);
    for (size_t i = 1; i < c->chosen_count; i++)
        if (strcmp(sorted[i - 1].name, sorted[i].name) == 0)
            return ceduo_usage_error("columns", _("two columns are called '%s'; rename one: NAME=%s"), sorted[i].name,
                                     c->names[c->chosen[sorted[i].column].column]);
    return EXIT_DONE;
}

/* ---- all columns ---- */

/* Append the columns of a table from number `from` on. Return the number after the last. */
static size_t add_columns(struct columns *c, const struct ceduo_figure *figures, size_t from)
{
    LOCAL_TEXT(list);
    ceduo_figures_columns(&list, figures, false);
    for (const char *p = ceduo_text_string(&list); *p; p += strcspn(p, "\n") + 1) {
        size_t n = strcspn(p, "\t");
        c->names = ceduo_arena_grow(&c->each->arena, c->names, from, 1, &c->capacity, sizeof *c->names);
        c->texts = ceduo_arena_grow(&c->each->arena, c->texts, from, 1, &c->texts_capacity, sizeof *c->texts);
        c->names[from] = ceduo_arena_copy(&c->each->arena, p, n);
        c->texts[from++] = strncmp(p + n + 1, "string", 6) == 0;
    }
    return from;
}

/* Find the cells of the result that a failed row has. */
static void make_failed(struct columns *c)
{
    const struct ceduo_csv failed = {.columns = ceduo_failed_columns};
    LOCAL_TEXT(head);
    LOCAL_TEXT(line);
    struct csv_span names[8], cells[8];
    ceduo_csv_head(&head, &failed);
    ceduo_csv_rows(&line, &failed, &(struct ceduo_row_state){.reason = ""});
    size_t n = split_line(head.bytes, head.length - 1, names, 8);
    split_line(line.bytes, line.length - 1, cells, 8);
    for (size_t i = c->result_begin; i < c->count; i++) {
        for (size_t k = 0; k < n; k++)
            if (strlen(c->names[i]) == names[k].n && memcmp(c->names[i], names[k].p, names[k].n) == 0)
                ceduo_text_append_n(&c->failed, cells[k].p, cells[k].n);
        ceduo_text_append(&c->failed, i + 1 < c->count ? "," : "\n");
    }
}

enum exit_status ceduo_columns_open(struct columns *c, struct each *e, const struct ceduo_figure *figures)
{
    *c = (struct columns){.each = e};
    if (!figures)
        return EXIT_DONE;
    struct arena *arena = &e->arena;
    size_t own = add_columns(c, ceduo_row_figures, 0);
    size_t row_columns = own, n = 0;
    own = add_columns(c, figures, own);
    const char **names = ceduo_arena_alloc(arena, (own + e->heads_count + 1) * sizeof *names);
    bool *texts = ceduo_arena_alloc(arena, (own + e->heads_count + 1) * sizeof *texts);
    c->copied = ceduo_arena_alloc(arena, (e->heads_count + 1) * sizeof *c->copied);
    struct named_column *sorted = ceduo_arena_alloc(arena, (own + e->heads_count + 1) * sizeof *sorted);
    for (size_t i = 0; i < own; i++)
        sorted[i] = (struct named_column){c->names[i], i};
    qsort(sorted, own, sizeof *sorted, compare_names);
    for (size_t i = 0; i < e->heads_count; i++) {
        const char *name = e->heads[i].name;
        if (!ceduo_each_is_copied(e, i))
            continue;
        bool taken = bsearch(&(struct named_column){name, 0}, sorted, own, sizeof *sorted, compare_names);
        c->copied[n] = i;
        names[n++] = taken ? ceduo_arena_format(arena, "row.%s", name) : name;
    }
    memcpy(names + n, c->names, own * sizeof *names);
    memcpy(texts + n, c->texts, own * sizeof *texts);
    c->names = names;
    c->texts = texts;
    c->copied_count = n;
    c->result_begin = n + row_columns;
    c->count = n + own;
    for (size_t i = 0; i < c->count; i++)
        sorted[i] = (struct named_column){names[i], i};
    qsort(sorted, c->count, sizeof *sorted, compare_names);
    c->cells = ceduo_arena_alloc(arena, (c->count + 1) * sizeof *c->cells);
    c->chosen =
        ceduo_arena_alloc(arena, (c->count + strlen(e->given->columns ? e->given->columns : "") + 1) * sizeof *c->chosen);
    make_failed(c);
    if (!e->given->columns)
        choose_usual(c);
    enum exit_status status = e->given->columns ? choose_listed(c, sorted) : EXIT_DONE;
    for (size_t i = 0; i < c->chosen_count; i++)
        c->run_wanted |= strcmp(c->names[c->chosen[i].column], "run") == 0;
    return status == EXIT_DONE ? check_heads(c) : status;
}

void ceduo_columns_close(struct columns *c)
{
    ceduo_text_free(&c->failed);
}

/* ---- lines ---- */

void ceduo_columns_head(const struct columns *c, struct text *out)
{
    for (size_t k = 0; k < c->chosen_count; k++) {
        ceduo_text_append(out, k > 0 ? "," : "");
        ceduo_text_append_csv(out, c->chosen[k].name);
    }
    ceduo_text_append_char(out, '\n');
}

void ceduo_columns_visit(struct columns *c, const struct text *lines, const struct ceduo_row_state *state,
                         void (*visit)(const struct columns *c, void *context), void *context)
{
    LOCAL_TEXT(front);
    const struct each *e = c->each;
    for (size_t i = 0; i < e->heads_count; i++)
        if (ceduo_each_is_copied(e, i)) {
            ceduo_text_append_csv(&front, e->cells[i]);
            ceduo_text_append_char(&front, ',');
        }
    ceduo_csv_rows(&front, &(struct ceduo_csv){.columns = ceduo_row_figures}, state);
    front.bytes[front.length - 1] = ',';
    for (const char *p = ceduo_text_string(state->reason ? &c->failed : lines), *end; (end = strchr(p, '\n')); p = end + 1) {
        LOCAL_TEXT(line);
        ceduo_text_append_n(&line, front.bytes, front.length);
        ceduo_text_append_n(&line, p, (size_t)(end - p));
        size_t n = split_line(line.bytes, line.length, c->cells, c->count);
        memset(c->cells + n, 0, (c->count - n) * sizeof *c->cells);
        visit(c, context);
    }
}

void ceduo_columns_print(const struct columns *c, void *out)
{
    for (size_t k = 0; k < c->chosen_count; k++) {
        const struct csv_span cell = c->cells[c->chosen[k].column];
        ceduo_text_append(out, k > 0 ? "," : "");
        if (cell.n > 0)
            ceduo_text_append_n(out, cell.p, cell.n);
    }
    ceduo_text_append_char(out, '\n');
}
