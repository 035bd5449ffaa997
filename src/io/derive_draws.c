/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a calibration left open: a table with a column for each fitted value, whose head is its path, or several with blanks
 * between them. Each row is one draw; all values of a row belong together. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "csv.h"
#include "derive.h"
#include "resolve.h"

struct draws {
    struct deriver *d;
    struct csv csv;
    size_t columns, rows, places_count, room;
    double **values;     /* [column][row] */
    const char **places;
    const double **of;   /* of each place its column */
};

static bool complain_no_value(struct draws *t, const char *path)
{
    ceduo_node_problem(t->d->problems, t->d->draws, "doubt.draws", _("the table has a column '%s', which is no value of this scene"), path);
    return false;
}

static bool add_places(struct draws *t, const struct ceduo_input *found, const double *values)
{
    struct deriver *d = t->d;
    size_t n = t->places_count, more = found->places_count, room = t->room;
    t->places = ceduo_bind_room(d->arena, t->places, n, more, &room, sizeof *t->places, d->problems);
    t->of = ceduo_bind_room(d->arena, t->of, n, more, &t->room, sizeof *t->of, d->problems);
    for (size_t i = 0; t->places && t->of && i < more; i++) {
        t->of[n + i] = values;
        t->places[n + i] = found->places[i];
    }
    t->places_count += more;
    return t->places && t->of;
}

/* The places that one column sets, by its head; it must name one. */
static bool take_places(struct draws *t, size_t column, struct csv_span field)
{
    char *head = ceduo_arena_copy(t->d->arena, field.p, field.n), *rest = head;
    char *path = head ? strtok_r(head, " ", &rest) : NULL;
    if (head && !path)
        return complain_no_value(t, head);
    for (; path; path = strtok_r(NULL, " ", &rest)) {
        struct ceduo_input found;
        if (!ceduo_derive_find(t->d, path, t->d->ground_assumed, &found) || found.places_count == 0)
            return complain_no_value(t, path);
        if (!add_places(t, &found, t->values[column]))
            return false;
    }
    return head != NULL;
}

static bool take_header(struct draws *t)
{
    struct csv_span left = t->csv.header, field;
    for (size_t c = 0; ceduo_csv_step(&t->csv, &left, &field); c++)
        if (!take_places(t, c, field))
            return false;
    return true;
}

static void read_rows(struct draws *t)
{
    struct csv_span field;
    while (ceduo_csv_next(&t->csv)) {
        struct csv_span left = t->csv.line;
        size_t c = 0;
        for (; c < t->columns && ceduo_csv_step(&t->csv, &left, &field); c++)
            ceduo_csv_number(&t->csv, field, -1e12, 1e12, "", &t->values[c][t->rows], t->d->problems);
        if (c < t->columns)
            ceduo_problem(t->d->problems, t->csv.source, t->csv.number, 1, _("too few columns"));
        t->rows++;
    }
}

static bool read_table(struct draws *t, const char *path)
{
    struct deriver *d = t->d;
    struct text names = {0};
    if (!ceduo_csv_open(&t->csv, d->arena, path, d->problems))
        return false;
    size_t before = d->problems->met, lines = ceduo_csv_lines(&t->csv);
    t->columns = ceduo_csv_columns(&t->csv, &names);
    ceduo_text_free(&names);
    if (!(t->values = ceduo_bind_take(d->arena, t->columns, sizeof *t->values, d->problems)))
        return false;
    for (size_t c = 0; c < t->columns; c++)
        if (!(t->values[c] = ceduo_bind_take(d->arena, lines, sizeof **t->values, d->problems)))
            return false;
    read_rows(t);
    if (!take_header(t))
        return false;
    if (t->rows == 0)
        ceduo_node_problem(d->problems, d->draws, "doubt.draws", _("the table has no row"));
    return d->problems->met == before;
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
