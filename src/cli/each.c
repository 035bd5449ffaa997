/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of --each, and the lines of CSV that are printed of it: the cells that are copied, then those of the result; with
 * --columns some of both. With --resume the rows whose copied cells stand in the output are not computed again. The last of them
 * may be there in part: it is taken out and computed. */
#include "each.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/json.h"
#include "base/language.h"
#include "io/file.h"
#include "options.h"
#include "output.h"
#include "say.h"
#include "scene/schema.h"

#define NAMES_SHOWN 10 /* of scenes that failed */
#define LABEL_MOST  20 /* bytes */

struct each_head {
    const char *name, *printed; /* printed: in CSV */
    const struct field *field;  /* of the value that it sets; NULL: of none, or of a part of a scene such as slope */
    bool sets;
};

static bool is_copied(const struct each_head *head)
{
    return !head->sets && head->name[0];
}

struct each_row {
    size_t line;
    const char **cells; /* NULL: the row is bad, or done */
    bool done;          /* its lines stand in the output */
};

/* ---- the table ---- */

/* What a cell says, without blanks around it and the quotes of CSV. */
static const char *cell_of(struct each *e, struct csv_span f)
{
    for (; f.n > 0 && f.p[0] == ' '; f.p++)
        f.n--;
    for (; f.n > 0 && f.p[f.n - 1] == ' '; f.n--)
        ;
    bool quoted = f.n > 1 && f.p[0] == '"' && f.p[f.n - 1] == '"';
    char *cell = ceduo_arena_copy(&e->arena, f.p + quoted, f.n - (quoted ? 2 : 0)), *to = cell;
    for (const char *p = cell; *p; p++) {
        *to++ = *p;
        p += quoted && p[0] == '"' && p[1] == '"';
    }
    *to = '\0';
    return cell;
}

static bool read_heads(struct each *e)
{
    struct csv_span left = e->table.header, f;
    LOCAL_TEXT(names);
    e->heads = ceduo_arena_take(&e->arena, ceduo_csv_columns(&e->table, &names) * sizeof *e->heads);
    while (ceduo_csv_cell(&left, e->table.separator, &f)) {
        const char *name = cell_of(e, f);
        char *first = ceduo_arena_copy(&e->arena, name, strcspn(name, ".["));
        bool sets = ceduo_schema_field(ceduo_schema_scene(), first) != NULL;
        for (size_t i = 0; i < e->heads_count; i++)
            if (name[0] && strcmp(e->heads[i].name, name) == 0) {
                ceduo_problem(e->table.problems, e->table.source, 1, (size_t)(f.p - e->table.header.p) + 1,
                              _("'%s' is given twice"), name);
                return false;
            }
        e->heads[e->heads_count++] = (struct each_head){name, name, sets ? ceduo_schema_at(name) : NULL, sets};
    }
    return true;
}

static void read_rows(struct each *e)
{
    e->rows = ceduo_arena_take(&e->arena, (ceduo_csv_lines(&e->table) + 1) * sizeof *e->rows);
    while (ceduo_csv_next(&e->table)) {
        struct csv_span left = e->table.line, f;
        const char **cells = ceduo_arena_take(&e->arena, e->heads_count * sizeof *cells);
        size_t n = 0;
        for (; n < e->heads_count && ceduo_csv_cell(&left, e->table.separator, &f); n++)
            cells[n] = cell_of(e, f);
        bool more = n == e->heads_count && left.p;
        for (; n < e->heads_count; n++)
            cells[n] = "";
        e->bad_rows |= more;
        if (more)
            ceduo_csv_complain(&e->table, left, _("more columns than the first line has"));
        e->rows[e->rows_count++] = (struct each_row){.line = e->table.number, .cells = more ? NULL : cells};
    }
}

static enum exit_status read_table(struct each *e)
{
    struct problems problems = {0};
    bool good = ceduo_csv_open(&e->table, &e->arena, e->given->each, &problems);
    if (good) {
        e->table.source->foreign = false; /* its name was given for this */
        good = read_heads(e);
    }
    if (good)
        read_rows(e);
    ceduo_problems_close(&problems);
    ceduo_say(&problems.text);
    ceduo_problems_free(&problems);
    e->table.problems = NULL;
    return good ? EXIT_DONE : EXIT_INPUT;
}

/* ---- lines of CSV ---- */

/* The cells of a row that are copied, or their heads, each with a comma behind it. */
static void append_copied(const struct each *e, const char *const *cells, struct text *line)
{
    for (size_t i = 0; i < e->heads_count; i++)
        if (is_copied(&e->heads[i])) {
            ceduo_text_csv(line, cells ? cells[i] : e->heads[i].printed);
            ceduo_text_char(line, ',');
        }
}

/* The cells of a line at n places, each with a comma behind it. */
static void append_cells(struct csv_span line, const size_t *at, size_t n, struct text *to)
{
    for (size_t k = 0; k < n; k++) {
        struct csv_span left = line, f = {"", 0};
        for (size_t i = 0; i <= at[k]; i++)
            if (!ceduo_csv_cell(&left, ',', &f))
                f.n = 0;
        ceduo_text_add(to, f.p, f.n);
        ceduo_text_char(to, ',');
    }
}

/* A whole line, or the cells of it that --columns names. */
static void append_line(const struct each *e, const char *line, size_t n, struct text *out)
{
    if (e->columns)
        append_cells((struct csv_span){line, n}, e->columns, e->columns_count, out);
    else
        ceduo_text_add(out, line, n);
    out->length -= e->columns_count > 0; /* the last comma */
    ceduo_text_char(out, '\n');
}

static size_t place_of(const char *const *names, size_t n, const char *name)
{
    size_t i = 0;
    while (i < n && strcmp(names[i], name) != 0)
        i++;
    return i;
}

/* Names the copied columns as the table does, with row. in front of what the result has a column of its own for; then finds
 * those of --columns. */
static enum exit_status choose_columns(struct each *e, const struct text *header)
{
    struct csv_span left = {header->bytes, header->length > 0 ? header->length - 1 : 0}, f;
    size_t own = 0, n = 0, commas = 1;
    for (size_t i = 0; i < header->length; i++)
        commas += header->bytes[i] == ',';
    const char **owns = ceduo_arena_take(&e->arena, commas * sizeof *owns);
    const char **names = ceduo_arena_take(&e->arena, (e->heads_count + commas) * sizeof *names);
    while (ceduo_csv_cell(&left, ',', &f))
        owns[own++] = cell_of(e, f);
    for (size_t i = 0; i < e->heads_count; i++) {
        struct each_head *head = &e->heads[i];
        if (place_of(owns, own, head->name) < own)
            head->printed = ceduo_arena_format(&e->arena, "row.%s", head->name);
        if (is_copied(head))
            names[n++] = head->printed;
    }
    for (size_t i = 0; i < own; i++)
        names[n++] = owns[i];
    if (!e->given->columns)
        return EXIT_DONE;
    e->columns = ceduo_arena_take(&e->arena, (strlen(e->given->columns) + 1) * sizeof *e->columns);
    for (const char *word = e->given->columns; *word;) {
        size_t length = strcspn(word, ",");
        const char *wanted = ceduo_arena_copy(&e->arena, word, length);
        size_t i = e->columns[e->columns_count++] = place_of(names, n, wanted);
        if (i == n) {
            const char *near = ceduo_text_nearest(wanted, names, n);
            return near ? ceduo_usage("columns", _("no column '%s'; did you mean '%s'?"), wanted, near)
                        : ceduo_usage("columns", _("no column '%s'; --list-columns names all"), wanted);
        }
        word += length + (word[length] == ',');
    }
    return EXIT_DONE;
}

/* ---- what stands in the output already ---- */

/* The places of the copied cells in the lines that are printed; false where one is not printed. */
static bool find_copied(const struct each *e, size_t *at, size_t *n)
{
    size_t copied = 0;
    for (size_t i = 0; i < e->heads_count; i++)
        copied += is_copied(&e->heads[i]);
    for (*n = 0; *n < copied; ++*n) {
        at[*n] = *n;
        for (size_t k = 0; e->columns && (at[*n] = k) < e->columns_count && e->columns[k] != *n; k++)
            ;
        if (e->columns && at[*n] == e->columns_count)
            return false;
    }
    return copied > 0;
}

static int by_key(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* The keys of the rows, in their order; NULL where two have the same, which is told. */
static const char **row_keys(struct each *e)
{
    const char **keys = ceduo_arena_take(&e->arena, (e->rows_count + 1) * sizeof *keys);
    const char **sorted = ceduo_arena_take(&e->arena, (e->rows_count + 1) * sizeof *sorted);
    for (size_t r = 0; r < e->rows_count; r++) {
        LOCAL_TEXT(key);
        if (e->rows[r].cells)
            append_copied(e, e->rows[r].cells, &key);
        else
            ceduo_text_format(&key, "%zu", r);
        keys[r] = ceduo_arena_string(&e->arena, ceduo_text_string(&key));
    }
    memcpy(sorted, keys, e->rows_count * sizeof *keys);
    qsort(sorted, e->rows_count, sizeof *sorted, by_key);
    for (size_t r = 1; r < e->rows_count; r++)
        if (strcmp(sorted[r - 1], sorted[r]) == 0) {
            ceduo_say_why(e->given->each, _("two rows have the same copied cells, so that --resume cannot tell them apart"));
            return NULL;
        }
    return keys;
}

/* Leaves out the rows that the output holds, but for the last of them, and takes that off the output. */
static enum exit_status resume(struct each *e, const struct text *header)
{
    size_t n, count = 0, start, lines = 1;
    size_t *at = ceduo_arena_take(&e->arena, (e->heads_count + 1) * sizeof *at);
    if (!find_copied(e, at, &n))
        return ceduo_usage("resume", _("print a column of --each that changes nothing: it says which row a line is of"));
    const char **keys = row_keys(e);
    if (!keys)
        return EXIT_INPUT;
    if (access(e->given->output, F_OK) != 0 && errno == ENOENT)
        return EXIT_DONE;
    struct problems problems = {0};
    const struct source *old = ceduo_file_read(&e->arena, e->given->output, CSV_BYTES_MOST, &problems);
    ceduo_say(&problems.text);
    ceduo_problems_free(&problems);
    LOCAL_TEXT(first);
    ceduo_each_header(e, header, &first);
    if (!old)
        return EXIT_OUTPUT;
    if (old->length > 0 && (old->length < first.length || memcmp(old->bytes, first.bytes, first.length) != 0)) {
        ceduo_say_why(e->given->output, _("it has other columns than these; write elsewhere, or remove it"));
        return EXIT_OUTPUT;
    }
    e->resumed = old->length > 0;
    for (size_t i = 0; i < old->length; i++)
        lines += old->bytes[i] == '\n';
    const char **done = ceduo_arena_take(&e->arena, lines * sizeof *done);
    start = first.length;
    for (const char *line = old->bytes + first.length, *end = line;
         e->resumed && (end = memchr(line, '\n', (size_t)(old->bytes + old->length - line))); line = end + 1) {
        LOCAL_TEXT(key);
        append_cells((struct csv_span){line, (size_t)(end - line)}, at, n, &key);
        if (count == 0 || strcmp(done[count - 1], ceduo_text_string(&key)) != 0) {
            done[count++] = ceduo_arena_string(&e->arena, ceduo_text_string(&key));
            start = (size_t)(line - old->bytes);
        }
    }
    if (e->resumed && truncate(e->given->output, (off_t)start) != 0) {
        ceduo_say_why(e->given->output, strerror(errno));
        return EXIT_OUTPUT;
    }
    count -= count > 0; /* of the last a line may be missing */
    qsort(done, count, sizeof *done, by_key);
    for (size_t r = 0; r < e->rows_count; r++)
        if (bsearch(&keys[r], done, count, sizeof *done, by_key))
            e->rows[r] = (struct each_row){.done = true};
    return EXIT_DONE;
}

/* ---- scene by scene ---- */

enum exit_status ceduo_each_open(struct each *e, const struct arguments *a, const struct text *header)
{
    *e = (struct each){.arguments = *a, .given = a};
    enum exit_status status = a->each ? read_table(e) : EXIT_DONE;
    if (status == EXIT_DONE && (a->each || a->columns))
        status = choose_columns(e, header);
    if (status == EXIT_DONE && a->resume)
        status = resume(e, header);
    e->count = a->scenes_count * (a->each ? e->rows_count : 1);
    e->arguments.sets.items = ceduo_arena_take(&e->arena, (a->sets.n + e->heads_count + 1) * sizeof *a->sets.items);
    memcpy(e->arguments.sets.items, a->sets.items, a->sets.n * sizeof *a->sets.items);
    return status;
}

/* The change that a cell asks for, PATH=VALUE. Texts are quoted as YAML has it; a decimal comma becomes a dot. */
static const char *change_of(struct each *e, const struct each_head *head, const char *cell)
{
    const struct field *f = head->field;
    LOCAL_TEXT(change);
    ceduo_text_format(&change, "%s=", head->name);
    bool text = !f || f->type == FIELD_TEXT || f->type == FIELD_FILE;
    bool number = f && (f->type == FIELD_NUMBER || f->type == FIELD_SPREAD) && e->table.separator != ',' && !strchr(cell, '.');
    ceduo_text_put(&change, text ? "'" : "");
    for (const char *p = cell; *p; p++)
        ceduo_text_add(&change, text && *p == '\'' ? "''" : number && *p == ',' ? "." : p, text && *p == '\'' ? 2 : 1);
    ceduo_text_put(&change, text ? "'" : "");
    return ceduo_arena_string(&e->arena, ceduo_text_string(&change));
}

/* What people call a row: the first of its copied cells that is short, which a geometry is not; else its line. */
static const char *label_of(const struct each *e, const struct each_row *row)
{
    for (size_t i = 0; row && row->cells && i < e->heads_count; i++)
        if (is_copied(&e->heads[i]) && row->cells[i][0] && strlen(row->cells[i]) <= LABEL_MOST)
            return row->cells[i];
    return row ? e->name : NULL;
}

bool ceduo_each_next(struct each *e)
{
    size_t scenes = e->given->scenes_count;
    const struct each_row *row = NULL;
    do {
        if (e->at == e->count)
            return false;
        row = e->rows ? &e->rows[e->at / scenes] : NULL;
        e->path = e->given->scenes[e->at++ % scenes];
        e->name = row ? ceduo_arena_format(&e->arena, "%s:%zu", e->given->each, row->line) : e->path;
        e->arguments.label = label_of(e, row);
        if (row && !row->cells && !row->done)
            ceduo_each_fail(e);
    } while (row && !row->cells);
    e->arguments.called = row || e->count > 1 ? e->name : NULL;
    struct word_list *sets = &e->arguments.sets;
    sets->n = e->given->sets.n;
    for (size_t i = 0; row && i < e->heads_count; i++)
        if (e->heads[i].sets && row->cells[i][0])
            sets->items[sets->n++] = change_of(e, &e->heads[i], row->cells[i]);
    e->arguments.cells = sets->n - e->given->sets.n;
    return true;
}

void ceduo_each_header(const struct each *e, const struct text *header, struct text *out)
{
    LOCAL_TEXT(line);
    if (header->length == 0 || e->resumed)
        return;
    append_copied(e, NULL, &line);
    ceduo_text_add(&line, header->bytes, header->length - 1);
    append_line(e, ceduo_text_string(&line), line.length, out);
}

/* "row": what is copied, as numbers where they are, in front of what an object of JSON holds. */
static void add_object(const struct each *e, const char *const *cells, const struct text *answer, struct text *out)
{
    struct json json = {.text = out};
    double number;
    ceduo_json_open(&json, NULL, '{');
    ceduo_json_open(&json, "row", '{');
    for (size_t i = 0; i < e->heads_count; i++)
        if (is_copied(&e->heads[i])) {
            if (ceduo_number_read(cells[i], &number) == CEDUO_NUMBER_GOOD)
                ceduo_json_number(&json, e->heads[i].name, number);
            else
                ceduo_json_string(&json, e->heads[i].name, cells[i][0] ? cells[i] : NULL);
        }
    ceduo_json_close(&json, '}');
    ceduo_text_put(out, ", ");
    ceduo_text_put(out, ceduo_text_string(answer) + 1);
}

void ceduo_each_add(const struct each *e, const struct text *answer, struct text *out)
{
    const struct each_row *row = e->rows ? &e->rows[(e->at - 1) / e->given->scenes_count] : NULL;
    if (e->given->format == CEDUO_CSV && (row || e->columns)) {
        for (const char *line = ceduo_text_string(answer), *end; (end = strchr(line, '\n')); line = end + 1) {
            LOCAL_TEXT(whole);
            append_copied(e, row ? row->cells : NULL, &whole);
            ceduo_text_add(&whole, line, (size_t)(end - line));
            append_line(e, ceduo_text_string(&whole), whole.length, out);
        }
    } else if (e->given->format == CEDUO_JSON && row) {
        add_object(e, row->cells, answer, out);
    } else {
        if (row)
            ceduo_text_safe(out, e->name);
        for (size_t i = 0; row && i < e->heads_count; i++)
            if (!e->heads[i].sets && row->cells[i][0]) {
                ceduo_text_put(out, " \xc2\xb7 ");
                ceduo_text_safe(out, row->cells[i]);
            }
        ceduo_text_put(out, row ? "\n" : "");
        ceduo_text_put(out, ceduo_text_string(answer));
    }
}

void ceduo_each_fail(struct each *e)
{
    const char *label = e->arguments.label;
    if (e->failures++ < NAMES_SHOWN)
        ceduo_text_format(&e->failed, label && label != e->name ? "%s%s (%s)" : "%s%s", e->failures > 1 ? ", " : "", e->name,
                          label);
    else if (e->failures == NAMES_SHOWN + 1)
        ceduo_text_put(&e->failed, ", \xe2\x80\xa6");
}

void ceduo_each_close(struct each *e)
{
    if (e->count > 1 && e->failures > 0) {
        LOCAL_TEXT(line);
        ceduo_text_format(&line, ngettext("%zu of %zu failed: %s", "%zu of %zu failed: %s", e->failures), e->failures, e->count,
                          ceduo_text_string(&e->failed));
        ceduo_say_why("ceduo", ceduo_text_string(&line));
    }
    ceduo_text_free(&e->failed);
    ceduo_arena_free(&e->arena);
}
