/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a calibration left open: a table with a column for each fitted value, whose head is its path, or several with blanks
 * between them. Each row is one draw; all values of a row belong together. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "csv.h"
#include "derive.h"
#include "resolve.h"

/* A place, and the draws of its column. */
struct drawn {
    const char *place;
    const double *values;
};

/* What the draws of a column are. */
struct head {
    size_t column;
    const struct field *field;
};

struct draws {
    struct deriver *d;
    struct csv csv;
    size_t columns, rows;
    double **values; /* [column][row] */
    size_t heads_count, heads_room, places_count, places_room;
    struct head *heads; /* column by column */
    struct drawn *places;
};

/* ---- the first line ---- */

/* Of a foreign table only the beginning is told. */
static bool complain_no_value(struct draws *t, char *path)
{
    if (t->csv.source->foreign)
        path[ceduo_utf8_cut(path, CEDUO_FOREIGN_MOST)] = '\0';
    ceduo_node_problem(t->d->problems, t->d->draws, "doubt.draws",
                       _("the table has a column '%s', which is no value of this scene"), path);
    return false;
}

static bool add_head(struct draws *t, size_t column, const struct field *field)
{
    const struct head *last = t->heads_count > 0 ? &t->heads[t->heads_count - 1] : NULL;
    if (last && last->column == column && last->field == field) /* as of the items of a list */
        return true;
    t->heads = ceduo_bind_room(t->d->arena, t->heads, t->heads_count, 1, &t->heads_room, sizeof *t->heads, t->d->problems);
    if (t->heads)
        t->heads[t->heads_count++] = (struct head){column, field};
    return t->heads != NULL;
}

static bool add_places(struct draws *t, size_t column, const struct ceduo_input *found)
{
    size_t n = found->places_count;
    t->places = ceduo_bind_room(t->d->arena, t->places, t->places_count, n, &t->places_room, sizeof *t->places, t->d->problems);
    for (size_t i = 0; t->places && i < n; i++)
        t->places[t->places_count++] = (struct drawn){found->places[i], t->values[column]};
    return t->places != NULL;
}

/* The places that one column sets, by its head; it must name one. */
static bool take_head(struct draws *t, size_t column, struct csv_span field)
{
    char *head = ceduo_arena_copy(t->d->arena, field.p, field.n), *rest = head;
    char *path = head ? strtok_r(head, " ", &rest) : NULL;
    if (head && !path)
        return complain_no_value(t, head);
    for (; path; path = strtok_r(NULL, " ", &rest)) {
        struct ceduo_input found;
        const struct field *f = ceduo_derive_find(t->d, path, t->d->ground_assumed, &found);
        t->csv.source->foreign &= f == NULL;
        if (!f || found.places_count == 0)
            return complain_no_value(t, path);
        if (!add_head(t, column, f) || !add_places(t, column, &found))
            return false;
    }
    return head != NULL;
}

static int by_place(const void *a, const void *b)
{
    return strcmp(((const struct drawn *)a)->place, ((const struct drawn *)b)->place);
}

/* Sorts the places, of which none may be there twice. */
static void sort_places(struct draws *t)
{
    qsort(t->places, t->places_count, sizeof *t->places, by_place);
    for (size_t i = 1; i < t->places_count; i++)
        if (by_place(&t->places[i - 1], &t->places[i]) == 0)
            ceduo_problem(t->d->problems, t->csv.source, 1, 1, _("'%s' is given twice"), t->places[i].place);
}

static bool take_header(struct draws *t)
{
    struct csv_span left = t->csv.header, field;
    for (size_t c = 0; ceduo_csv_step(&t->csv, &left, &field); c++)
        if (!take_head(t, c, field))
            return false;
    sort_places(t);
    return true;
}

/* ---- rows ---- */

static void check_range(struct draws *t, struct csv_span field, const struct field *f, double value)
{
    struct text range = {0};
    char room[CEDUO_NUMBER_ROOM];
    if (ceduo_schema_in_range(f, value))
        return;
    ceduo_schema_range_text(f, &range);
    ceduo_csv_complain(&t->csv, field, t->d->problems, _("%s is outside the range of %s: %s"),
                       ceduo_number_shortest(value, room), f->key, ceduo_text_string(&range));
    ceduo_text_free(&range);
}

static void read_row(struct draws *t)
{
    struct csv_span left = t->csv.line, field;
    size_t c = 0, h = 0;
    for (; c < t->columns && ceduo_csv_step(&t->csv, &left, &field); c++) {
        double *to = &t->values[c][t->rows];
        bool good = ceduo_csv_number(&t->csv, field, -1e12, 1e12, "", to, t->d->problems);
        for (; h < t->heads_count && t->heads[h].column == c; h++)
            if (good)
                check_range(t, field, t->heads[h].field, *to);
    }
    if (c < t->columns)
        ceduo_problem(t->d->problems, t->csv.source, t->csv.number, 1, _("too few columns"));
    else if (ceduo_csv_step(&t->csv, &left, &field))
        ceduo_csv_complain(&t->csv, field, t->d->problems, _("more columns than the first line has"));
    t->rows++;
}

/* ---- all ---- */

static bool make_room(struct draws *t)
{
    struct text names = {0};
    size_t lines = ceduo_csv_lines(&t->csv);
    t->columns = ceduo_csv_columns(&t->csv, &names);
    ceduo_text_free(&names);
    t->values = ceduo_bind_take(t->d->arena, t->columns, sizeof *t->values, t->d->problems);
    bool good = t->values != NULL;
    for (size_t c = 0; good && c < t->columns; c++)
        good = (t->values[c] = ceduo_bind_take(t->d->arena, lines, sizeof **t->values, t->d->problems)) != NULL;
    return good;
}

static bool read_table(struct draws *t, const char *path)
{
    struct problems *problems = t->d->problems;
    size_t before = problems->met;
    if (!ceduo_csv_open(&t->csv, t->d->arena, path, problems) || !make_room(t) || !take_header(t))
        return false;
    while (ceduo_csv_next(&t->csv))
        read_row(t);
    if (t->rows == 0)
        ceduo_node_problem(problems, t->d->draws, "doubt.draws", _("the table has no row"));
    return problems->met == before;
}

static bool fill_input(const struct draws *t, struct ceduo_input *input)
{
    struct deriver *d = t->d;
    const char **places = ceduo_bind_take(d->arena, t->places_count, sizeof *places, d->problems);
    const double **draws = ceduo_bind_take(d->arena, t->places_count, sizeof *draws, d->problems);
    for (size_t i = 0; places && draws && i < t->places_count; i++) {
        places[i] = t->places[i].place;
        draws[i] = t->places[i].values;
    }
    *input = (struct ceduo_input){.path = "draws",
                                  .kind = CEDUO_INPUT_DRAWS,
                                  .lo = NAN,
                                  .hi = NAN,
                                  .places_count = t->places_count,
                                  .places = places,
                                  .draws_count = t->rows,
                                  .draws = draws};
    return places && draws;
}

bool ceduo_derive_draws(struct deriver *d, struct ceduo_input *input)
{
    struct draws t = {.d = d};
    if (d->draws->kind != NODE_SCALAR) {
        ceduo_node_problem(d->problems, d->draws, "doubt.draws", _("expected the path of a table"));
        return false;
    }
    const char *path = ceduo_resolve_path(d->arena, d->draws, "scenes");
    if (!path)
        ceduo_node_problem(d->problems, d->draws, "doubt.draws", _("cannot find '%s' beside this file"), d->draws->text);
    return path && read_table(&t, path) && fill_input(&t, input);
}
