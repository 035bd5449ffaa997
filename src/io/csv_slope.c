/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profile from a CSV file: the header names the columns, each row is checked against the one before. */
#include "csv_slope.h"

#include <math.h>

#include "base/language.h"
#include "bind.h"
#include "csv.h"

/* Names of a column, the better ones first; in other languages as their spreadsheets have them. */
static const char *const distances[] = {"distance", "distanza", "progressiva", "entfernung", "distanz", "x", NULL};
static const char *const elevations[] = {"elevation", "quota", "elevazione", "höhe", "hoehe", "z", NULL};

static void read_row(struct csv *csv, size_t column_x, size_t column_z, struct points *points)
{
    const struct field *vertex = ceduo_schema_field(ceduo_schema_slope(), "vertices_m");
    struct csv_span fx, fz;
    double x, z, before = points->n > 0 ? points->x[points->n - 1] : -INFINITY;
    if (!ceduo_csv_field(csv, column_x, &fx) || !ceduo_csv_field(csv, column_z, &fz)) {
        ceduo_problem(csv->problems, csv->source, csv->number, 1, _("too few columns"));
        return;
    }
    if (!ceduo_csv_number(csv, fx, vertex->lo, vertex->hi, "m", &x) ||
        !ceduo_csv_number(csv, fz, vertex->lo, vertex->hi, "m", &z))
        return;
    if (!(x > before)) {
        char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
        ceduo_csv_complain(csv, fx, _("distance %s does not lie beyond %s; distances must rise"), ceduo_number_shortest(x, a),
                           ceduo_number_shortest(before, b));
        return;
    }
    points->x[points->n] = x;
    points->z[points->n++] = z;
}

bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems)
{
    size_t before = problems->met;
    struct csv csv;
    if (!ceduo_csv_open(&csv, arena, path, problems))
        return false;
    size_t rows = ceduo_csv_lines(&csv), x = ceduo_csv_column(&csv, distances), z = ceduo_csv_column(&csv, elevations);
    points->x = ceduo_arena_take(arena, rows * sizeof(double));
    points->z = ceduo_arena_take(arena, rows * sizeof(double));
    csv.source->foreign = x == CEDUO_CSV_NONE && z == CEDUO_CSV_NONE;
    problems->memory |= !points->x || !points->z;
    if (x == CEDUO_CSV_NONE || z == CEDUO_CSV_NONE)
        ceduo_problem(problems, csv.source, 1, 1, _("the first line must name the columns 'distance' and 'elevation'"));
    else if (x == CEDUO_CSV_TWICE || z == CEDUO_CSV_TWICE)
        ceduo_problem(problems, csv.source, 1, 1, _("a column is named twice; rename all but one"));
    if (!points->x || !points->z || problems->met > before)
        return false;
    while (ceduo_csv_next(&csv))
        read_row(&csv, x, z, points);
    points->commas = csv.decimal == ',';
    return problems->met == before;
}
