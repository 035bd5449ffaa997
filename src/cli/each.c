/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rows of --each. A column whose head is a path of --set changes the scene; other columns are copied to the output. The table
 * is read twice: the first pass finds the rows and reports their errors, the second reads their cells. */
#include "each.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"
#include "messages.h"

#define NAMES_MAX 10 /* failed scenes in a message */
#define LABEL_MAX 20 /* bytes */

/* ---- the table ---- */

bool ceduo_each_is_copied(const struct each *e, size_t column)
{
    const struct each_head *head = &e->heads[column];
    return head->name[0] && (head->sets == PATH_UNKNOWN || column == e->key);
}

bool ceduo_each_is_shown(const struct each *e, size_t column)
{
    return ceduo_each_is_copied(e, column) && (e->key == NO_COLUMN || column == e->key);
}

static bool is_set(const struct each_head *head)
{
    return head->name[0] && head->sets != PATH_UNKNOWN;
}

/* Append the names of the columns that are set (`set`) or copied. */
static void append_names(const struct each *e, bool set, struct text *text)
{
    size_t n = 0;
    for (size_t i = 0; i < e->heads_count; i++)
        if (set ? is_set(&e->heads[i]) : ceduo_each_is_copied(e, i))
            ceduo_csv_append_name(text, &n, e->heads[i].name, strlen(e->heads[i].name));
    ceduo_csv_append_rest(text, n);
    if (n == 0)
        ceduo_text_append(text, _("none"));
}

/* Print the names of the columns that are set, and of the copied columns. */
static void print_columns(const struct each *e)
{
    LOCAL_TEXT(set);
    LOCAL_TEXT(copied);
    LOCAL_TEXT(line);
    append_names(e, true, &set);
    append_names(e, false, &copied);
    ceduo_text_format(&line, _("columns that are set: %s; copied: %s"), ceduo_text_string(&set), ceduo_text_string(&copied));
    if (!e->given->quiet)
        ceduo_print_message(e->table.source->name, ceduo_text_string(&line));
}

/* Find the column of --key. */
static bool find_key(struct each *e)
{
    const char *key = e->given->key;
    LOCAL_TEXT(names);
    for (size_t i = 0; key && i < e->heads_count; i++)
        if (strcmp(e->heads[i].name, key) == 0)
            e->key = i;
    if (!key || e->key != NO_COLUMN)
        return true;
    ceduo_csv_append_heads(&e->table, &names);
    return ceduo_problem(e->table.problems, e->table.source, e->table.head_place.line, 1,
                         _("no column '%s' for --key; the columns are: %s"), key, ceduo_text_string(&names));
}

static bool read_heads(struct each *e)
{
    const struct csv *t = &e->table;
    e->heads_count = t->heads_count;
    e->heads = ceduo_arena_alloc(&e->arena, (t->heads_count + 1) * sizeof *e->heads);
    e->cells = ceduo_arena_alloc(&e->arena, (t->heads_count + 1) * sizeof *e->cells);
    if (!ceduo_each_heads(t, &e->arena, e->heads))
        return false;
    size_t set = 0;
    for (size_t i = 0; i < e->heads_count; i++) {
        set += is_set(&e->heads[i]);
        e->names_files |= e->heads[i].sets == PATH_FILE || e->heads[i].sets == PATH_OTHER;
    }
    if (set == 0)
        return ceduo_problem(t->problems, t->source, t->head_place.line, 1,
                             _("no column changes the scene; name one after a path of --set"));
    return find_key(e) && (e->given->format != CEDUO_GEOJSON || ceduo_geometry_find(e));
}

/* True if a cell is a YAML mapping or list: {mean: 1, spread: 0.2}. */
static bool is_yaml(struct csv_cell cell)
{
    return cell.n > 0 && (cell.p[0] == '{' || cell.p[0] == '[');
}

/* Report ambiguous numbers in the present record. The scene checks other text, because a place may be end-10. */
static bool check_numbers(const struct each *e)
{
    bool good = true;
    char number[CSV_NUMERAL_CAPACITY];
    for (size_t i = 0; i < e->heads_count; i++) {
        struct csv_cell cell = ceduo_csv_next_cell(&e->table, i);
        if (e->heads[i].sets != PATH_NUMBER || is_yaml(cell) || ceduo_csv_is_empty(cell))
            continue;
        enum csv_numeral numeral = ceduo_csv_normalize_number(&e->table, cell, number);
        if (numeral != CSV_NUMERAL_GOOD && numeral != CSV_NUMERAL_NONE)
            good = ceduo_csv_report_number(&e->table, cell, numeral);
    }
    return good;
}

/* Check the present record; its line of an earlier row with the same key is known. */
static bool check_row(const struct each *e, size_t repeats)
{
    const struct csv *t = &e->table;
    struct csv_cell key = {0};
    if (e->key != NO_COLUMN && !t->bad)
        key = ceduo_csv_next_cell(t, e->key);
    bool good = !t->bad && check_numbers(e);
    if (good && e->key != NO_COLUMN && key.n == 0)
        good = ceduo_csv_error(t, key, _("the key '%s' is empty; name each row"), e->given->key);
    if (good && e->given->format == CEDUO_GEOJSON)
        good = ceduo_geometry_check(e);
    if (repeats > 0)
        good = ceduo_problem(t->problems, t->source, t->place.line, 1,
                             _("the key '%.*s' is also that of line %zu; give each row its own"), (int)key.n, key.p, repeats);
    return good;
}

struct row_key {
    uint64_t hash;
    size_t row;
};

static int compare_keys(const void *a, const void *b)
{
    const struct row_key *x = a, *y = b;
    int order = (x->hash > y->hash) - (x->hash < y->hash);
    return order != 0 ? order : (x->row > y->row) - (x->row < y->row);
}

/* Find rows with the key of an earlier row. Reports them by line. */
static void find_repeated(struct each *e, struct row_key *keys, size_t n)
{
    if (n > 1)
        qsort(keys, n, sizeof *keys, compare_keys);
    for (size_t i = 1, first = 0; i < n; i++) {
        first = keys[i].hash == keys[first].hash ? first : i;
        if (first < i)
            e->rows[keys[i].row].repeats = e->rows[keys[first].row].place.line;
    }
    for (size_t i = 0; i < e->rows_count; i++) {
        struct each_row *row = &e->rows[i];
        if (row->repeats == 0)
            continue;
        ceduo_csv_reread(&e->table, row->place);
        check_row(e, row->repeats);
        row->bad = e->bad_rows = true;
        ceduo_arena_free(&e->row_arena);
    }
}

/* Find the rows and report errors in them. */
static bool read_rows(struct each *e)
{
    struct csv *t = &e->table;
    for (size_t i = 0; i < e->heads_count; i++)
        t->heads[i].numeric |= e->heads[i].sets == PATH_NUMBER;
    ceduo_csv_scan(t);
    if (t->rows == 0)
        return ceduo_problem(t->problems, t->source, 0, 0, _("the table has no row"));
    e->rows = ceduo_arena_alloc(&e->arena, t->rows * sizeof *e->rows);
    struct row_key *keys = ceduo_check_memory(calloc(t->rows, sizeof *keys));
    size_t n = 0;
    t->arena = &e->row_arena; /* the list of cells has its final size after the scan */
    while (ceduo_csv_next_row(t)) {
        bool bad = !check_row(e, 0);
        e->bad_rows |= bad;
        if (!bad && e->key != NO_COLUMN) {
            struct csv_cell key = ceduo_csv_next_cell(t, e->key);
            keys[n++] = (struct row_key){hash_bytes(key.p, key.n), e->rows_count};
        }
        e->rows[e->rows_count++] = (struct each_row){t->place, bad, 0};
        ceduo_arena_free(&e->row_arena);
    }
    find_repeated(e, keys, n);
    free(keys);
    return true;
}

static enum exit_status read_table(struct each *e)
{
    struct problems problems = {0};
    bool good = ceduo_csv_open(&e->table, &e->arena, e->given->each, &problems);
    if (good) {
        e->table.source->foreign = false; /* the user named it as a table */
        good = ceduo_csv_read_head(&e->table) && read_heads(e);
    }
    if (good)
        print_columns(e);
    good = good && read_rows(e);
    ceduo_print_problems(&problems);
    e->table.problems = NULL;
    return good ? EXIT_DONE : EXIT_INPUT;
}

enum exit_status ceduo_each_open(struct each *e, const struct arguments *a)
{
    *e = (struct each){.arguments = *a, .given = a, .key = NO_COLUMN};
    enum exit_status status = a->each ? read_table(e) : EXIT_DONE;
    e->count = a->scenes_count * (a->each ? e->rows_count : 1);
    e->arguments.sets.items = ceduo_arena_alloc(&e->arena, (a->sets.n + e->heads_count + 1) * sizeof *a->sets.items);
    memcpy(e->arguments.sets.items, a->sets.items, a->sets.n * sizeof *a->sets.items);
    return status;
}

/* ---- scene by scene ---- */

/* Append a text as a quoted YAML scalar. */
static void append_quoted(struct text *change, const char *cell)
{
    ceduo_text_append_char(change, '\'');
    for (const char *p = cell; *p; p++)
        ceduo_text_append(change, *p == '\'' ? "''" : (char[]){*p, '\0'});
    ceduo_text_append_char(change, '\'');
}

/* Return the change of a cell of the present record, PATH=VALUE; NULL: none. */
static const char *make_change(struct each *e, size_t column)
{
    const struct each_head *head = &e->heads[column];
    struct csv_cell cell = ceduo_csv_next_cell(&e->table, column);
    char number[CSV_NUMERAL_CAPACITY];
    if (cell.n == 0 || (head->sets == PATH_NUMBER && ceduo_csv_is_empty(cell)))
        return NULL;
    LOCAL_TEXT(change);
    ceduo_text_format(&change, "%s=", head->name);
    if (head->sets == PATH_TEXT || (head->sets == PATH_FILE && !is_yaml(cell)))
        append_quoted(&change, e->cells[column]);
    else if (head->sets == PATH_NUMBER && !is_yaml(cell) &&
             ceduo_csv_normalize_number(&e->table, cell, number) == CSV_NUMERAL_GOOD)
        ceduo_text_append(&change, number);
    else
        ceduo_text_append(&change, e->cells[column]);
    return ceduo_arena_string(&e->row_arena, ceduo_text_string(&change));
}

/* Read the cells of a row, its name and its changes. */
static void read_row(struct each *e, const struct each_row *row)
{
    struct word_list *sets = &e->arguments.sets;
    ceduo_csv_reread(&e->table, row->place);
    for (size_t i = e->heads_count; i-- > 0;) {
        struct csv_cell cell = ceduo_csv_next_cell(&e->table, i);
        e->cells[i] = ceduo_arena_copy(&e->row_arena, cell.p, cell.n);
        if (ceduo_each_is_copied(e, i) && cell.n > 0 &&
            cell.n <= LABEL_MAX) /* the first short cell, because a geometry is long */
            e->arguments.label = e->cells[i];
    }
    e->name = ceduo_arena_format(&e->row_arena, "%s:%zu", e->given->each, row->place.line);
    if (e->key != NO_COLUMN && e->cells[e->key][0]) {
        e->name = ceduo_arena_format(&e->row_arena, "%s (%s)", e->name, e->cells[e->key]);
        e->arguments.label = e->cells[e->key];
    }
    for (size_t i = 0; i < e->heads_count && !row->bad; i++) {
        const char *change = is_set(&e->heads[i]) ? make_change(e, i) : NULL;
        if (change)
            sets->items[sets->n++] = change;
    }
}

bool ceduo_each_next(struct each *e)
{
    const struct arguments *given = e->given;
    if (e->current == e->count)
        return false;
    size_t scenes = given->scenes_count;
    ceduo_arena_free(&e->row_arena);
    e->arguments.number = e->current;
    e->row = e->rows ? &e->rows[e->current / scenes] : NULL;
    e->path = given->scenes[e->current++ % scenes];
    e->name = e->path;
    e->arguments.label = NULL;
    e->arguments.sets.n = given->sets.n;
    if (e->row)
        read_row(e, e->row);
    e->arguments.called = e->row || e->count > 1 ? e->name : NULL;
    e->arguments.cells = e->arguments.sets.n - given->sets.n;
    return true;
}

void ceduo_each_reason(struct each *e, struct text *reason)
{
    if (!e->row || !e->row->bad)
        return;
    LOCAL_PROBLEMS(problems);
    problems.brief = true;
    e->table.problems = &problems;
    e->table.next = e->row->place;
    ceduo_language_set_data(true);
    ceduo_csv_next_row(&e->table); /* reports a broken row */
    check_row(e, e->row->repeats);
    ceduo_language_set_data(false);
    e->table.problems = NULL;
    if (problems.wrong.n > 0)
        ceduo_text_append(reason, problems.wrong.items[0].message);
}

uint64_t ceduo_each_hash(const struct each *e)
{
    uint64_t hash = hash_bytes(e->path, strlen(e->path));
    for (size_t i = 0; i < e->heads_count; i++)
        if (e->heads[i].name[0])
            hash_count(&hash, hash_bytes(e->cells[i], strlen(e->cells[i])));
    return hash;
}

/* ---- answers and failures ---- */

void ceduo_each_json_cell(struct json *json, const char *name, const char *cell)
{
    double number;
    if (ceduo_number_read(cell, &number) == CEDUO_NUMBER_GOOD && strcmp(ROUNDTRIP(number), cell) == 0)
        ceduo_json_number(json, name, number);
    else
        ceduo_json_string(json, name, cell[0] ? cell : NULL);
}

void ceduo_each_json(const struct each *e, struct json *json)
{
    ceduo_json_open(json, "row", '{');
    for (size_t i = 0; i < e->heads_count; i++)
        if (ceduo_each_is_shown(e, i))
            ceduo_each_json_cell(json, e->heads[i].name, e->cells[i]);
    ceduo_json_close(json, '}');
}

void ceduo_each_page(const struct each *e, struct text *page)
{
    ceduo_text_append_escaped(page, e->name);
    for (size_t i = 0; i < e->heads_count; i++)
        if (ceduo_each_is_shown(e, i) && e->cells[i][0]) {
            ceduo_text_append(page, " \xc2\xb7 ");
            ceduo_text_append_escaped(page, e->cells[i]);
        }
    ceduo_text_append_char(page, '\n');
}

void ceduo_each_note_failed(struct each *e)
{
    const char *label = e->arguments.label;
    if (e->failures++ < NAMES_MAX) {
        ceduo_text_format(&e->failed, e->failures > 1 ? ", %s" : "%s", e->name);
        if (label && e->key == NO_COLUMN)
            ceduo_text_format(&e->failed, " (%s)", label);
    } else if (e->failures == NAMES_MAX + 1) {
        ceduo_text_append(&e->failed, ", \xe2\x80\xa6");
    }
}

void ceduo_each_close(struct each *e)
{
    if (e->count > 1 && e->failures > 0) {
        LOCAL_TEXT(line);
        ceduo_text_format(&line, ngettext("%zu of %zu failed: %s", "%zu of %zu failed: %s", e->failures), e->failures, e->count,
                          ceduo_text_string(&e->failed));
        ceduo_print_message("ceduo", ceduo_text_string(&line));
    }
    ceduo_text_free(&e->failed);
    ceduo_arena_free(&e->row_arena);
    ceduo_arena_free(&e->arena);
}
