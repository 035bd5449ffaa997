/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <inttypes.h>
#include <stdio.h>

#include "base/language.h"
#include "figures.h"

/* A row, or the header that names its cells: the same tables make both. */
struct row {
    struct text *text;
    bool header, more;
    const struct path *group; /* the objects that the cell lies in */
};

struct path {
    const struct path *before;
    const char *key;
};

static void put_path(struct text *text, const struct path *path)
{
    if (!path)
        return;
    put_path(text, path->before);
    ceduo_text_format(text, "%s.", path->key);
}

static void put_value(struct text *text, struct ceduo_value v)
{
    char room[CEDUO_NUMBER_ROOM];
    switch (v.kind) {
    case CEDUO_VALUE_NUMBER:
        ceduo_text_put(text, ceduo_number_shortest(v.number, room));
        break;
    case CEDUO_VALUE_COUNT:
        ceduo_text_format(text, "%" PRIu64, v.count);
        break;
    case CEDUO_VALUE_FLAG:
        ceduo_text_put(text, v.flag ? "true" : "false");
        break;
    case CEDUO_VALUE_TEXT:
        ceduo_text_csv(text, v.text);
        break;
    case CEDUO_NULL:
        break;
    }
}

/* Sentences joined by "; ". */
static void join(void *context, const char *sentence)
{
    struct text *all = context;
    if (all->length > 0)
        ceduo_text_put(all, "; ");
    ceduo_text_put(all, sentence);
}

static void put_cell(struct row *row, const struct ceduo_figure *f, const void *object, double scale)
{
    struct text all = {0};
    if (row->more)
        ceduo_text_char(row->text, ',');
    row->more = true;
    if (row->header) {
        put_path(row->text, row->group);
        ceduo_text_put(row->text, f->key);
    } else if (f->value) {
        put_value(row->text, ceduo_figure_value(f, object, scale));
    } else {
        ceduo_language_of_data(true);
        f->say(object, join, &all);
        ceduo_language_of_data(false);
        put_value(row->text, (struct ceduo_value){.kind = all.bytes ? CEDUO_VALUE_TEXT : CEDUO_NULL, .text = all.bytes});
        ceduo_text_free(&all);
    }
}

static void put_cells(struct row *row, const struct ceduo_figure *f, const void *object, double scale);

/* The items of a list, each with the name of its columns. */
static void put_items(struct row *row, const struct ceduo_figure *f, const void *object, double scale)
{
    const struct path *group = row->group, list = {group, f->key};
    for (size_t i = 0; f->columns && f->columns[i]; i++) {
        const struct path item = {&list, f->columns[i]};
        row->group = &item;
        put_cells(row, f->of, object ? f->item(object, i) : NULL, ceduo_figure_scale(f, scale));
    }
    row->group = group;
}

/* `object` NULL: empty cells. */
static void put_cells(struct row *row, const struct ceduo_figure *f, const void *object, double scale)
{
    const struct path *group = row->group;
    for (; !ceduo_figure_is_end(f); f++) {
        if (!f->of) {
            put_cell(row, f, object, scale);
            continue;
        }
        if (f->item) {
            put_items(row, f, object, scale);
            continue;
        }
        const struct path path = {group, f->key};
        row->group = f->key ? &path : group;
        put_cells(row, f->of, ceduo_figure_object(f, object), ceduo_figure_scale(f, scale));
        row->group = group;
    }
}

static void put_row(struct row *row, const struct ceduo_figure *columns, const void *object)
{
    put_cells(row, columns, object, 1);
    ceduo_text_char(row->text, '\n');
    row->more = false;
}

void ceduo_report_csv_header(struct text *text, bool stands, bool years)
{
    struct row row = {.text = text, .header = true};
    put_row(&row, stands ? ceduo_stand_columns : years ? ceduo_year_columns : ceduo_control_columns, NULL);
}

/* Rows of the option, or of one of its years. */
static void put_rows(struct row *row, const struct ceduo_place *place, const struct ceduo_figure *columns)
{
    const struct ceduo_report *report = place->report;
    struct ceduo_place p = *place;
    bool stands = columns == ceduo_stand_columns;
    size_t n = stands ? report->result->scene->options[p.option].belts_count : report->result->scene->controls_count;
    for (size_t i = 0; i < n; i++) {
        *(stands ? &p.belt : &p.control) = i;
        put_row(row, columns, &p);
    }
}

void ceduo_report_csv(struct text *text, const struct ceduo_report *report, bool stands)
{
    struct row row = {.text = text};
    struct ceduo_place p = {.report = report};
    for (; p.option < report->result->scene->options_count; p.option++) {
        if (stands || !report->years)
            put_rows(&row, &p, stands ? ceduo_stand_columns : ceduo_control_columns);
        for (size_t y = 0; !stands && report->years && y < report->years[p.option]->count; y++) {
            p.year = &report->years[p.option]->years[y];
            put_rows(&row, &p, ceduo_year_columns);
        }
        p.year = NULL;
    }
}

void ceduo_find_csv_header(struct text *text)
{
    put_row(&(struct row){.text = text, .header = true}, ceduo_find_columns, NULL);
}

void ceduo_find_csv(struct text *text, const struct ceduo_find_report *report)
{
    put_row(&(struct row){.text = text}, ceduo_find_columns, report);
}
