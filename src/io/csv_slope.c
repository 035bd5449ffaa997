/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profile from a CSV file: the header names the columns, each row is checked against the one before. */
#include "csv_slope.h"
#include "base/language.h"
#include "csv.h"

#include "bind.h"

/* Names of a column, the better ones first; in other languages as their spreadsheets have them. */
static const char *const distances[] = {"distance", "distanza", "progressiva", "entfernung", "distanz", "x", NULL};
static const char *const elevations[] = {"elevation", "quota", "elevazione", "h\xc3\xb6he", "hoehe", "z", NULL};

struct columns {
    size_t x, z;
};

static bool find_columns(struct csv *csv, struct columns *c, struct problems *problems)
{
    c->x = ceduo_csv_column(csv, distances);
    c->z = ceduo_csv_column(csv, elevations);
    csv->source->foreign = c->x == CEDUO_CSV_NONE && c->z == CEDUO_CSV_NONE;
    if (c->x < CEDUO_CSV_TWICE && c->z < CEDUO_CSV_TWICE)
        return true;
    if (c->x == CEDUO_CSV_NONE || c->z == CEDUO_CSV_NONE)
        ceduo_problem(problems, csv->source, 1, 1, _("the first line must name the columns 'distance' and 'elevation'"));
    else
        ceduo_problem(problems, csv->source, 1, 1, _("a column is named twice; rename all but one"));
    return false;
}

static void read_row(struct csv *csv, const struct columns *c, struct points *points, struct problems *problems)
{
    const struct field *vertex = ceduo_schema_field(ceduo_schema_slope(), "vertices_m");
    struct csv_span fx, fz;
    double x, z;
    if (!ceduo_csv_field(csv, c->x, &fx) || !ceduo_csv_field(csv, c->z, &fz)) {
        ceduo_problem(problems, csv->source, csv->number, 1, _("too few columns"));
        return;
    }
    if (!ceduo_csv_number(csv, fx, vertex->lo, vertex->hi, "m", &x) ||
        !ceduo_csv_number(csv, fz, vertex->lo, vertex->hi, "m", &z))
        return;
    if (points->n > 0 && !(x > points->x[points->n - 1])) {
        char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
        ceduo_csv_complain(csv, fx, _("distance %s does not lie beyond %s; distances must rise"), ceduo_number_shortest(x, a),
                           ceduo_number_shortest(points->x[points->n - 1], b));
        return;
    }
    points->x[points->n] = x;
    points->z[points->n++] = z;
}

bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems)
{
    size_t before = problems->met;
    struct csv csv;
    struct columns columns;
    if (!ceduo_csv_open(&csv, arena, path, problems))
        return false;
    size_t rows = ceduo_csv_lines(&csv);
    points->x = ceduo_arena_take(arena, rows * sizeof(double));
    points->z = ceduo_arena_take(arena, rows * sizeof(double));
    if (!points->x || !points->z) {
        ceduo_problem_memory(problems);
        return false;
    }
    if (!find_columns(&csv, &columns, problems))
        return false;
    while (ceduo_csv_next(&csv))
        read_row(&csv, &columns, points, problems);
    points->commas = csv.decimal == ',';
    return problems->met == before;
}
