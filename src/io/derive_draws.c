/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a calibration left open: a table with a column for each fitted value, whose head is its path, or several with blanks
 * between them. Each row is one draw; all values of a row belong together. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "csv.h"
#include "derive.h"
#include "resolve.h"

#define PLACES_MOST 10000

struct draws {
    struct deriver *d;
    struct csv csv;
    size_t columns, rows, places_count;
    double **values;     /* [column][row] */
    const char **places;
    const double **of;   /* of each place its column */
};

/* The head of a column, as a string. */
static const char *head_of(struct draws *t, size_t column)
{
    struct csv header = t->csv;
    struct csv_span field = {"", 0};
    header.line = t->csv.header;
    ceduo_csv_field(&header, column, &field);
    return ceduo_derive_text(t->d, "%.*s", (int)field.n, field.p);
}

static bool complain_no_value(struct draws *t, const char *path)
{
    ceduo_node_problem(t->d->problems, t->d->draws, "doubt.draws", _("the table has a column '%s', which is no value of this scene"), path);
    return false;
}

/* The places that one column sets; it must name one. */
static bool take_places(struct draws *t, size_t column)
{
    char *head = ceduo_arena_string(t->d->arena, head_of(t, column)), *rest = head;
    char *path = head ? strtok_r(head, " ", &rest) : NULL;
    if (head && !path)
        return complain_no_value(t, head);
    for (; path; path = strtok_r(NULL, " ", &rest)) {
        struct ceduo_input found;
        if (!ceduo_derive_find(t->d, path, t->d->ground_assumed, &found) || found.places_count == 0)
            return complain_no_value(t, path);
        for (size_t i = 0; i < found.places_count && t->places_count < PLACES_MOST; i++) {
            t->of[t->places_count] = t->values[column];
            t->places[t->places_count++] = found.places[i];
        }
    }
    return head != NULL;
}

static void read_rows(struct draws *t)
{
    struct csv_span field;
    while (ceduo_csv_next(&t->csv)) {
        for (size_t c = 0; c < t->columns; c++)
            if (!ceduo_csv_field(&t->csv, c, &field))
                ceduo_problem(t->d->problems, t->csv.source, t->csv.number, 1, _("too few columns"));
            else
                ceduo_csv_number(&t->csv, field, -1e12, 1e12, "", &t->values[c][t->rows], t->d->problems);
        t->rows++;
    }
}

static bool read_table(struct draws *t, const char *path)
{
    struct deriver *d = t->d;
    size_t before = d->problems->met;
    struct text names = {0};
    if (!ceduo_csv_open(&t->csv, d->arena, path, d->problems))
        return false;
    t->columns = ceduo_csv_columns(&t->csv, &names);
    ceduo_text_free(&names);
    t->values = ceduo_bind_take(d->arena, t->columns, sizeof *t->values, d->problems);
    t->places = ceduo_bind_take(d->arena, PLACES_MOST, sizeof *t->places, d->problems);
    t->of = ceduo_bind_take(d->arena, PLACES_MOST, sizeof *t->of, d->problems);
    for (size_t c = 0; t->values && c < t->columns; c++)
        if (!(t->values[c] = ceduo_bind_take(d->arena, ceduo_csv_lines(&t->csv), sizeof **t->values, d->problems)))
            return false;
    if (!t->values || !t->places || !t->of)
        return false;
    read_rows(t);
    for (size_t c = 0; c < t->columns; c++)
        if (!take_places(t, c))
            return false;
    if (t->rows == 0)
        ceduo_node_problem(d->problems, d->draws, "doubt.draws", _("the table has no row"));
    return d->problems->met == before && t->rows > 0;
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
    if (!path || !read_table(&t, path))
        return false;
    *input = (struct ceduo_input){.path = "draws",
                                  .kind = CEDUO_INPUT_DRAWS,
                                  .lo = NAN,
                                  .hi = NAN,
                                  .places_count = t.places_count,
                                  .places = t.places,
                                  .draws_count = t.rows,
                                  .draws = (const double *const *)t.of};
    return true;
}
