/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Write tables of figures as JSON and CSV. Sentences are English in every language. */
#include "figures.h"
#include "core/runs/statistics.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/json.h"
#include "base/language.h"
#include "scene/schema.h"

static double combine_scale(const struct ceduo_figure *f, double scale)
{
    return f->scale > 0 ? scale * f->scale : scale;
}

/* Return the object of a row; NULL: none. */
static const void *get_source(const struct ceduo_figure *f, const void *object)
{
    return object && f->from ? f->from(object) : object;
}

static const void *get_nested(const struct ceduo_figure *f, const void *object)
{
    const void *from = get_source(f, object);
    return from ? (const char *)from + f->offset : NULL;
}

static struct ceduo_value read_value(const struct ceduo_figure *f, const void *object, double scale)
{
    const void *from = get_source(f, object);
    struct ceduo_value v = from ? f->value->read(f, from) : (struct ceduo_value){.kind = CEDUO_NULL};
    if (v.kind == CEDUO_VALUE_NUMBER)
        v.number *= combine_scale(f, scale);
    if ((v.kind == CEDUO_VALUE_NUMBER && !isfinite(v.number)) || (v.kind == CEDUO_VALUE_TEXT && !v.text))
        v.kind = CEDUO_NULL;
    return v;
}

static void report_sentences(const struct ceduo_figure *f, const struct ceduo_place *place, ceduo_sentence_sink *to,
                             void *context)
{
    ceduo_language_set_data(true);
    f->sentences(place, to, context);
    ceduo_language_set_data(false);
}

bool ceduo_figures_need_years(const char *paths)
{
    return strstr(paths, "window.") || strstr(paths, "worst.") || strstr(paths, "verdict.");
}

/* ---- JSON ---- */

struct writer {
    struct json json;
    bool details;
    const char *key; /* key of a sentence; NULL: item of a list */
};

static void write_sentence(void *context, const char *sentence)
{
    struct writer *w = context;
    ceduo_json_string(&w->json, w->key, sentence);
}

static void write_value(struct json *j, const char *key, struct ceduo_value v)
{
    if (v.kind == CEDUO_VALUE_NUMBER)
        ceduo_json_number(j, key, v.number);
    else if (v.kind == CEDUO_VALUE_COUNT)
        ceduo_json_count(j, key, v.count);
    else if (v.kind == CEDUO_VALUE_FLAG)
        ceduo_json_flag(j, key, v.flag);
    else
        ceduo_json_string(j, key, v.kind == CEDUO_VALUE_TEXT ? v.text : NULL);
}

static void write_figures(struct writer *w, const struct ceduo_figure *f, const void *object, double scale);

/* Write an object. `brackets` false: its figures belong to the enclosing object. */
static void write_json_object(struct writer *w, const char *key, const struct ceduo_figure *table, const void *object,
                              double scale, bool brackets)
{
    if (brackets)
        ceduo_json_open(&w->json, key, '{');
    write_figures(w, table, object, scale);
    if (brackets)
        ceduo_json_close(&w->json, '}');
}

/* Return item i of a list; NULL after the last. */
static const void *get_item(const struct ceduo_figure *f, const void *object, size_t i, struct ceduo_place *place)
{
    if (f->item)
        return f->item(object, i);
    *place = *(const struct ceduo_place *)object;
    return f->enter(place, i) ? place : NULL;
}

static void write_list(struct writer *w, const struct ceduo_figure *f, const void *object, double scale)
{
    struct ceduo_place place;
    const void *item = get_item(f, object, 0, &place);
    if (f->details ? !w->details : f->null && !item) {
        ceduo_json_string(&w->json, f->key, NULL);
        return;
    }
    ceduo_json_open(&w->json, f->key, '[');
    for (size_t i = 1; item; item = get_item(f, object, i++, &place))
        write_json_object(w, NULL, f->table, item, f->item ? scale : 1, !f->plain);
    ceduo_json_close(&w->json, ']');
}

static void write_figures(struct writer *w, const struct ceduo_figure *f, const void *object, double scale)
{
    for (; !ceduo_figure_is_end(f); f++) {
        const void *nested = get_nested(f, object);
        if (f->value) {
            write_value(&w->json, f->key, read_value(f, object, scale));
        } else if (f->enter || f->item) {
            write_list(w, f, object, combine_scale(f, scale));
        } else if (f->table && !nested) {
            ceduo_json_string(&w->json, f->key, NULL);
        } else if (f->table) {
            write_json_object(w, f->key, f->table, nested, combine_scale(f, scale), f->key != NULL);
        } else {
            w->key = f->single ? f->key : NULL;
            if (!f->single)
                ceduo_json_open(&w->json, f->key, '[');
            report_sentences(f, object, write_sentence, w);
            if (!f->single)
                ceduo_json_close(&w->json, ']');
        }
    }
}

void ceduo_figures_json(struct text *text, const struct ceduo_figure *figures, const void *object, bool details)
{
    struct writer w = {.json = {.text = text}, .details = details};
    write_json_object(&w, NULL, figures, object, 1, true);
    ceduo_text_append_char(text, '\n');
}

/* ---- CSV ---- */

static void append_csv_value(struct text *text, struct ceduo_value v)
{
    char buffer[CEDUO_NUMBER_SIZE];
    if (v.kind == CEDUO_VALUE_NUMBER)
        ceduo_text_append(text, ceduo_number_shortest(v.number, buffer));
    else if (v.kind == CEDUO_VALUE_COUNT)
        ceduo_text_format(text, "%" PRIu64, v.count);
    else if (v.kind == CEDUO_VALUE_FLAG)
        ceduo_text_append(text, v.flag ? "true" : "false");
    else if (v.kind == CEDUO_VALUE_TEXT)
        ceduo_text_append_csv(text, v.text);
}

/* Append a sentence, separated by "; ". */
static void append_sentence(void *context, const char *sentence)
{
    struct text *all = context;
    ceduo_text_append(all, all->length > 0 ? "; " : "");
    ceduo_text_append(all, sentence);
}

/* Append a cell and a comma. */
static void append_cell(struct text *row, const struct ceduo_figure *f, const void *object, double scale)
{
    LOCAL_TEXT(all);
    if (f->value) {
        append_csv_value(row, read_value(f, object, scale));
    } else {
        report_sentences(f, object, append_sentence, &all);
        if (all.bytes)
            ceduo_text_append_csv(row, all.bytes);
    }
    ceduo_text_append_char(row, ',');
}

/* Append cells in the order of ceduo_figures_columns(). `object` NULL: empty cells. */
static void append_cells(struct text *row, const struct ceduo_figure *f, const void *object, double scale)
{
    for (; !ceduo_figure_is_end(f); f++) {
        double inner = combine_scale(f, scale);
        if (!f->table)
            append_cell(row, f, object, scale);
        for (size_t i = 0; i < f->columns; i++)
            append_cells(row, f->table, object ? f->item(object, i) : NULL, inner);
        if (f->table && !f->item)
            append_cells(row, f->table, get_nested(f, object), inner);
    }
}

void ceduo_csv_head(struct text *text, const struct ceduo_csv *csv)
{
    ceduo_figures_columns(text, csv->columns, true);
    text->length--; /* the last comma */
    ceduo_text_append_char(text, '\n');
}

static void append_rows(struct text *text, const struct ceduo_csv *csv, const void *object, size_t level)
{
    if (level < CEDUO_CSV_LEVELS && csv->enter[level]) {
        struct ceduo_place place = *(const struct ceduo_place *)object;
        for (size_t i = 0; csv->enter[level](&place, i); i++)
            append_rows(text, csv, &place, level + 1);
        return;
    }
    append_cells(text, csv->columns, object, 1);
    text->length--;
    ceduo_text_append_char(text, '\n');
}

void ceduo_csv_rows(struct text *text, const struct ceduo_csv *csv, const void *object)
{
    append_rows(text, csv, object, 0);
}

/* ---- one figure ---- */

/* A row of a table that is read for an object. */
struct cell {
    const struct ceduo_figure *row;
    const void *object; /* NULL: the object is null */
    double scale;
};

static bool find_row(const struct ceduo_figure *f, const void *object, double scale, const struct path_step *step,
                     struct cell *cell)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (f->key && ceduo_path_is(step, f->key)) {
            *cell = (struct cell){f, object, scale};
            return true;
        }
        if (!f->key && find_row(f->table, get_nested(f, object), combine_scale(f, scale), step, cell))
            return true;
    }
    return false;
}

static bool has_name(const struct ceduo_figure *table, const void *object, const struct path_step *name)
{
    static const struct path_step key = {"name", 4, false};
    struct cell cell;
    if (!find_row(table, object, 1, &key, &cell) || !cell.row->value)
        return false;
    struct ceduo_value v = read_value(cell.row, cell.object, 1);
    return v.kind == CEDUO_VALUE_TEXT && ceduo_path_is(name, v.text);
}

/* Return the item of a list that a step in brackets selects; NULL: none. */
static const void *find_item(const struct cell *list, const struct path_step *step, struct ceduo_place *place)
{
    size_t index = SIZE_MAX;
    bool number = ceduo_path_index(step, &index);
    const void *item = list->object ? get_item(list->row, list->object, 0, place) : NULL;
    for (size_t i = 0; item; item = get_item(list->row, list->object, ++i, place))
        if (number ? i == index : has_name(list->row->table, item, step))
            break;
    return item;
}

static double get_number(const struct cell *cell, const struct ceduo_figure *row)
{
    struct ceduo_value v = read_value(row, cell->object, cell->scale);
    return v.kind == CEDUO_VALUE_NUMBER  ? v.number
           : v.kind == CEDUO_VALUE_COUNT ? (double)v.count
           : v.kind == CEDUO_VALUE_FLAG  ? v.flag
                                         : NAN;
}

/* True if a row has the key `end`, or one that ends in _`end`. */
static bool is_end(const struct ceduo_figure *f, const char *end)
{
    size_t n = f->key ? strlen(f->key) : 0, m = strlen(end);
    return f->value && n >= m && strcmp(f->key + n - m, end) == 0 && (n == m || f->key[n - m - 1] == '_');
}

/* Read a value with its interval: in a table the ends of an interval, or the standard error, follow the value. */
static enum ceduo_figure_found get_with_interval(const struct cell *cell, double value[3])
{
    const struct ceduo_figure *f = cell->row;
    if (!f->value || f->value->kind == CEDUO_VALUE_TEXT)
        return CEDUO_NOT_A_NUMBER;
    value[0] = get_number(cell, f);
    value[1] = value[2] = NAN;
    if (is_end(f + 1, "lo") && is_end(f + 2, "hi")) {
        value[1] = get_number(cell, f + 1);
        value[2] = get_number(cell, f + 2);
    } else if (is_end(f + 1, "se")) {
        double half = CEDUO_Z95 * get_number(cell, f + 1);
        value[1] = value[0] - half;
        value[2] = value[0] + half;
    }
    return CEDUO_FIGURE_FOUND;
}

enum ceduo_figure_found ceduo_figures_get(const struct ceduo_figure *figures, const void *object, const char *path,
                                          double value[3])
{
    size_t offset = 0, length = strlen(path), n = 0;
    struct path_step step;
    struct ceduo_place places[2]; /* one is read while the other is filled */
    struct cell cell = {NULL, object, 1};
    while (ceduo_path_next(path, length, &offset, &step)) {
        const struct ceduo_figure *row = cell.row;
        bool list = row && (row->enter || row->item);
        if (step.bracket != list || (row && !row->table))
            return CEDUO_NO_FIGURE;
        figures = row ? row->table : figures;
        if (list) {
            cell = (struct cell){.object = find_item(&cell, &step, &places[n]), .scale = row->item ? cell.scale : 1};
            n = 1 - n;
            if (!cell.object)
                return CEDUO_NO_ITEM;
            continue;
        }
        if (row)
            cell = (struct cell){.object = get_nested(row, cell.object), .scale = combine_scale(row, cell.scale)};
        if (!find_row(figures, cell.object, cell.scale, &step, &cell))
            return CEDUO_NO_FIGURE;
    }
    if (length == 0 || offset < length)
        return CEDUO_NO_FIGURE;
    return cell.row ? get_with_interval(&cell, value) : CEDUO_NOT_A_NUMBER;
}
