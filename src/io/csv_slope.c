/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profile from a CSV file: the header names the columns, each row is checked against the one before. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "bind.h"
#include "csv.h"

#define BEGINNING 4096 /* bytes of a file in which it says what it is */
#define LINE_MIN  1    /* m: a shorter line on the map is in degrees */

enum column { DISTANCE, ELEVATION, EAST, NORTH, COLUMNS };

/* Names of a column, the better ones first; in other languages as their spreadsheets have them. */
#define METRES "m|mt|metri|metres|meters|m slm|m asl"
static const struct csv_head heads[COLUMNS] = {
    [DISTANCE] = {{"distance", "distanza", "progressiva", "entfernung", "distanz"}, METRES},
    [ELEVATION] = {{"elevation", "quota", "elevazione", "altitudine", "höhe", "hoehe", "z"}, METRES},
    [EAST] = {{"x", "est", "east", "easting"}, METRES},
    [NORTH] = {{"y", "nord", "north", "northing"}, METRES},
};

/* What is no table, by what it begins with. */
static bool check_table(const struct csv *csv, struct problems *problems)
{
    static const struct {
        const char *mark, *name;
    } kinds[] = {{"<gpx", "GPX"}, {"<LandXML", "LandXML"}, {"<kml", "KML"}, {"<", "XML"}};
    const struct source *s = csv->source;
    size_t i = 0, mark = ceduo_source_mark(s), n = s->length - mark < BEGINNING ? s->length - mark : BEGINNING;
    while (s->bytes[mark] == '<' && !memmem(s->bytes + mark, n, kinds[i].mark, strlen(kinds[i].mark)))
        i++;
    if (s->bytes[mark] == '<')
        ceduo_problem_at(
            problems, (struct problem_place){.source = s, .own = true},
            _("%s is no profile; make one in QGIS: add the file and a terrain model with elevation to the map, open "
              "View > Elevation Profile, click the line with Capture Curve from Feature, and export the "
              "distance/elevation table as CSV"),
            kinds[i].name);
    return s->bytes[mark] != '<';
}

struct reader {
    struct csv csv;
    size_t columns[COLUMNS];
    bool drawn;         /* a line on the map: distances are along it */
    double east, north; /* of the point before, m */
};

static bool read_number(struct csv *csv, struct csv_span field, double *value)
{
    const struct field *vertex = ceduo_schema_field(ceduo_schema_slope(), "vertices_m");
    return ceduo_csv_number(csv, field, vertex->lo, vertex->hi, "m", value);
}

static void read_row(struct reader *r, struct points *points)
{
    struct csv *csv = &r->csv;
    struct csv_span first, second = {0}, height;
    double x, north = 0, z, before = points->n > 0 ? points->x[points->n - 1] : -INFINITY;
    if (!ceduo_csv_field(csv, r->columns[r->drawn ? EAST : DISTANCE], &first) ||
        !ceduo_csv_field(csv, r->columns[ELEVATION], &height) ||
        (r->drawn && !ceduo_csv_field(csv, r->columns[NORTH], &second))) {
        ceduo_problem(csv->problems, csv->source, csv->number, 1, _("too few columns"));
        return;
    }
    if (!read_number(csv, first, &x) || !read_number(csv, height, &z) || (r->drawn && !read_number(csv, second, &north)))
        return;
    if (r->drawn) {
        double east = x;
        x = points->n > 0 ? before + hypot(east - r->east, north - r->north) : 0;
        r->east = east;
        r->north = north;
    }
    if (!(x > before)) {
        ceduo_csv_complain(csv, first, _("distance %s does not lie beyond %s; distances must rise"), NUMERAL(x),
                           NUMERAL(before));
        return;
    }
    points->x[points->n] = x;
    points->z[points->n++] = z;
}

bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems)
{
    size_t before = problems->met;
    struct reader r = {.drawn = false};
    if (!ceduo_csv_open(&r.csv, arena, path, problems) || !check_table(&r.csv, problems))
        return false;
    const struct source *source = r.csv.source;
    size_t *columns = r.columns, rows = ceduo_csv_lines(&r.csv);
    ceduo_csv_find(&r.csv, heads, COLUMNS, columns);
    r.drawn = columns[DISTANCE] == CEDUO_CSV_NONE && columns[EAST] < CEDUO_CSV_TWICE && columns[NORTH] < CEDUO_CSV_TWICE;
    if (columns[DISTANCE] == CEDUO_CSV_NONE && !r.drawn) /* x may be along the slope */
        columns[DISTANCE] = columns[EAST];
    points->x = ceduo_arena_take(arena, rows * sizeof(double));
    points->z = ceduo_arena_take(arena, rows * sizeof(double));
    size_t x = r.drawn ? columns[EAST] : columns[DISTANCE], z = columns[ELEVATION];
    if (x == CEDUO_CSV_NONE || z == CEDUO_CSV_NONE)
        ceduo_problem(problems, source, 1, 1, _("the first line must name the columns 'distance' and 'elevation'"));
    if (!points->x || !points->z || problems->met > before)
        return false;
    while (ceduo_csv_next(&r.csv))
        read_row(&r, points);
    if (r.drawn && points->n > 1 && points->x[points->n - 1] < LINE_MIN && problems->met == before)
        ceduo_problem(problems, source, r.csv.header_number, 1,
                      _("the line is %.2g m long on the map: x and y must be in metres, not in degrees; export it in the "
                        "coordinates of a map, such as UTM"),
                      points->x[points->n - 1]);
    points->commas = r.csv.decimal == ',';
    return problems->met == before;
}
