/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profile from a table: distance and elevation, or a line on the map with elevations, as columns, WKT or the output of GRASS
 * and GMT. Reads the points, then chooses and checks one line, then converts walls and overhangs so that x rises. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "bind.h"
#include "csv.h"
#include "file.h"

#define BEGINNING    4096 /* bytes that are searched for the mark of a format */
#define LAYERS_MAX   1000
#define LINE_MIN     1    /* m; a shorter line on the map is in degrees */
#define LENGTH_MIN   0.1  /* m of a profile */
#define WALL_RUN     0.01 /* m between the edge and the foot of a vertical step */
#define OVERHANG_MAX 10   /* m; a line that goes back farther turns round (assumed) */
#define SPIKE_RISE   200  /* m to both neighbours, */
#define SPIKE_RUN    50   /* within m: an error of the terrain model (assumed) */
#define JUMP_RISE    50   /* m to 0 or 9999, */
#define JUMP_SLOPE   6    /* and times the run: no data (assumed) */
#define TURN_STEP    0.1  /* m; shorter steps have no direction */
#define CROSSINGS    2000 /* points that are checked for crossings */

enum column { DISTANCE, ELEVATION, EAST, NORTH, LAYER, WKT, LABEL, COLUMNS };

/* Names of a column, preferred first. */
#define METRES "m|mt|metri|metro|metres|meters|meter|m slm|m sm|m asl|m amsl|m \xc3\xbcm|m \xc3\xbc nn|m nn|m nhn"
static const struct csv_head heads[COLUMNS] = {
    [DISTANCE] = {"distance",
                  "distanza|dist|chainage|progressiva|distanza progressiva|progr|entfernung|distanz|station|stazione",
                  .units = METRES},
    [ELEVATION] = {"elevation", "quota|altitude|altitudine|elevazione|alt|height|h\xc3\xb6he|hoehe|z|value|quota terreno|elev",
                   .units = METRES},
    [EAST] = {"x", "est|east|easting|e", .units = METRES},
    [NORTH] = {"y", "nord|north|northing|n", .units = METRES},
    [LAYER] = {"layer", .also = "layer name|livello|nome layer|line|linea|line id|profile|profilo|track"},
    [WKT] = {"wkt", .also = "wkt_geom|geometry|geom|the_geom|shape"},
    [LABEL] = {"name", .also = "nome|id|fid"},
};

/* A point in the file. */
struct raw {
    double along, x, y, z; /* m: distance, coordinates on the map, height */
    size_t layer, line;
};

struct reader {
    struct csv csv;
    struct arena *arena;
    struct problems *problems;
    size_t columns[COLUMNS];
    bool map; /* x and y are coordinates; there is no distance */
    struct raw *raw;
    size_t n, capacity;
    const char *layers[LAYERS_MAX];
    size_t layers_count;
    struct text notes;   /* changes to the points */
    const char *several; /* names of the lines if the user must choose one; else NULL */
};

static bool reject_at(struct reader *r, const struct raw *raw, const char *reason)
{
    return ceduo_problem(r->problems, r->csv.source, raw->line, 1, "%s", reason);
}

/* ---- points ---- */

/* Return the index of a layer; add it if it is new. A layer without a name gets its number as name. */
static size_t get_layer(struct reader *r, const char *name, size_t n)
{
    char number[32];
    if (n == 0) {
        n = (size_t)snprintf(number, sizeof number, "%zu", r->layers_count + 1);
        name = number;
    }
    for (size_t i = r->layers_count; i-- > 0;)
        if (strlen(r->layers[i]) == n && memcmp(r->layers[i], name, n) == 0)
            return i;
    if (r->layers_count == LAYERS_MAX)
        return LAYERS_MAX; /* no line has its points */
    r->layers[r->layers_count] = ceduo_arena_copy(r->arena, name, n);
    return r->layers[r->layers_count] ? r->layers_count++ : 0;
}

static void add_point(struct reader *r, struct raw raw)
{
    r->raw = ceduo_arena_grow(r->arena, r->raw, r->n, 1, &r->capacity, sizeof *r->raw);
    if (r->raw)
        r->raw[r->n++] = raw;
    else
        r->n = r->capacity = 0;
}

/* True if a height is a no-data value of terrain models. */
static bool is_no_data(double z)
{
    static const double values[] = {-9999, -32768, -32767, -99999, -10000};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        if (z == values[i])
            return true;
    return fabs(z) >= 1e30;
}

static bool read_coordinate(struct reader *r, enum column c, double *value)
{
    const struct field *vertex = ceduo_schema_field(ceduo_schema_slope(), "vertices_m");
    struct csv_cell cell = ceduo_csv_next_cell(&r->csv, r->columns[c]);
    bool none = ceduo_csv_is_empty(cell);
    if (c == ELEVATION && cell.n > 0 && none)
        return ceduo_csv_error(&r->csv, cell, _("'%.*s' is not a height; remove the row, or fill the gap in the terrain model"),
                               (int)cell.n, cell.p);
    char text[CSV_NUMERAL_CAPACITY];
    if (c == ELEVATION && ceduo_csv_normalize_number(&r->csv, cell, text) == CSV_NUMERAL_GOOD &&
        (ceduo_number_read(text, value) == CEDUO_NUMBER_TOO_LARGE || is_no_data(*value)))
        return ceduo_csv_error(&r->csv, cell,
                               _("'%s' marks missing data; remove the row, or fill the gap in the terrain model"), text);
    return ceduo_csv_number(&r->csv, cell, vertex->lo, vertex->hi, "m", value);
}

/* True if rows have coordinates on the map, with or without distances. */
static bool has_coordinates(const struct reader *r)
{
    return r->map || (r->csv.headless && r->columns[EAST] != CEDUO_CSV_NOT_FOUND);
}

static void read_row(struct reader *r, size_t layer)
{
    struct csv *csv = &r->csv;
    struct raw raw = {.layer = layer};
    bool good = r->map || read_coordinate(r, DISTANCE, &raw.along);
    if (has_coordinates(r)) {
        good = read_coordinate(r, EAST, &raw.x) && good;
        good = read_coordinate(r, NORTH, &raw.y) && good;
    }
    good = read_coordinate(r, ELEVATION, &raw.z) && good;
    raw.line = ceduo_csv_line(csv, ceduo_csv_next_cell(csv, r->columns[r->map ? EAST : DISTANCE]));
    if (good)
        add_point(r, raw);
}

/* ---- WKT ---- */

static bool is_wkt(const char *p, size_t n)
{
    static const char *const words[] = {"LINESTRING", "MULTILINESTRING", "SRID="};
    for (size_t i = 0; i < 3; i++)
        if (n > strlen(words[i]) && strncasecmp(p, words[i], strlen(words[i])) == 0)
            return true;
    return false;
}

/* Read one tuple of WKT, up to a comma or bracket. Return the number of values; 0: not a tuple. */
static size_t read_tuple(const char **p, const char *end, double values[4])
{
    size_t n = 0;
    while (*p < end && !strchr(",()", **p)) {
        char number[CSV_NUMERAL_CAPACITY];
        size_t length = strcspn(*p, " ,()\r\n\t");
        if (length == 0) {
            ++*p;
            continue;
        }
        if (n == 4 || length >= sizeof number || *p + length > end)
            return 0;
        memcpy(number, *p, length);
        number[length] = '\0';
        if (ceduo_number_read(number, &values[n++]) != CEDUO_NUMBER_GOOD)
            return 0;
        *p += length;
    }
    return n;
}

/* Read the lines of a WKT text; each innermost pair of brackets is a line. */
static bool read_wkt(struct reader *r, const char *p, const char *end, size_t line, struct csv_cell name)
{
    struct raw raw = {.line = line};
    const char *semicolon = memchr(p, ';', (size_t)(end - p)); /* after SRID=… */
    p = semicolon ? semicolon + 1 : p;
    const char *open = memchr(p, '(', (size_t)(end - p)), *tag = open ? open : end;
    while (tag > p && tag[-1] == ' ')
        tag--;
    bool inside = false,
         measured = tag > p + 1 && toupper((unsigned char)tag[-1]) == 'M' && toupper((unsigned char)tag[-2]) != 'Z';
    for (p = open ? open : end; p < end;) {
        double values[4];
        if (strchr("() ,\r\n\t", *p)) {
            inside &= *p++ != ')';
            continue;
        }
        raw.layer = inside ? raw.layer : get_layer(r, name.p, name.n);
        inside = true;
        size_t n = read_tuple(&p, end, values);
        if (n < 2)
            return reject_at(r, &raw, _("this is not WKT; write LINESTRING Z (x y z, x y z, …)"));
        if (n < (measured ? 4 : 3))
            return reject_at(
                r, &raw,
                _("the line has no heights; drape it over the terrain model (in QGIS: Drape) to make it a LINESTRING Z"));
        if (is_no_data(values[2]))
            return reject_at(r, &raw, _("a height of the line marks missing data; fill the gap in the terrain model"));
        raw.x = values[0];
        raw.y = values[1];
        raw.z = values[2];
        add_point(r, raw);
    }
    return true;
}

/* ---- tables ---- */

/* Refuse other formats, recognized by their first bytes. */
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
        ceduo_problem_at(problems, (struct problem_place){.source = s, .own = true},
                         _("%s is not a profile; make one in QGIS: add the file and a terrain model with elevation to the map, "
                           "open View > Elevation Profile, click the line with Capture Curve from Feature, and export the "
                           "distance/elevation table as CSV"),
                         kinds[i].name);
    return s->bytes[mark] != '<';
}

/* True if all cells of the present record are numbers, possibly ambiguous ones. */
static bool are_numbers(const struct csv *csv)
{
    char text[CSV_NUMERAL_CAPACITY];
    double value;
    bool good = true;
    for (size_t i = 0; good && i < csv->cells_count; i++) {
        enum csv_numeral numeral = ceduo_csv_normalize_number(csv, csv->cells[i], text);
        good = numeral == CSV_NUMERAL_GOOD ? ceduo_number_read(text, &value) == CEDUO_NUMBER_GOOD : numeral != CSV_NUMERAL_NONE;
    }
    return good;
}

/* Begin a table without a head if its first record has numbers only. GMT begins comments with # and lines with >. */
static bool find_headless(struct reader *r, struct csv_place begin)
{
    struct csv *csv = &r->csv;
    for (const char *s = ";\t| ,"; *s; s++) {
        struct problems *problems = csv->problems;
        csv->next = begin;
        csv->problems = NULL;
        ceduo_csv_begin_headless(csv, *s);
        ceduo_csv_scan(csv);
        bool good = ceduo_csv_next_row(csv) && csv->cells_count >= 2 && are_numbers(csv);
        csv->problems = problems;
        csv->next = begin;
        if (!good)
            continue;
        csv->source->foreign = false;
        if (csv->cells_count == 2 || csv->cells_count == 4) {
            r->columns[DISTANCE] = csv->cells_count - 2;
            r->columns[ELEVATION] = csv->cells_count - 1;
            r->columns[EAST] = csv->cells_count == 4 ? 0 : CEDUO_CSV_NOT_FOUND;
            r->columns[NORTH] = csv->cells_count == 4 ? 1 : CEDUO_CSV_NOT_FOUND;
            return true;
        }
        return ceduo_problem(
            r->problems, csv->source, csv->place.line, 1,
            _("%zu columns without a head; add a first line with their names, such as x,y,z or distance,elevation"),
            csv->cells_count);
    }
    csv->headless = false;
    return ceduo_problem(r->problems, csv->source, 1, 1,
                         _("the line of heads must name the columns 'distance' and 'elevation'"));
}

/* Report a head with a unit other than metres. */
static bool check_units(struct reader *r)
{
    bool good = true;
    for (enum column c = DISTANCE; c <= ELEVATION; c++) {
        size_t column = r->columns[c] == CEDUO_CSV_NOT_FOUND ? ceduo_csv_column(&r->csv, &heads[c], NULL) : CEDUO_CSV_NOT_FOUND;
        if (column >= CEDUO_CSV_DUPLICATE || (c == DISTANCE && r->columns[EAST] != CEDUO_CSV_NOT_FOUND))
            continue;
        r->csv.source->foreign = false;
        good = ceduo_csv_error(&r->csv, r->csv.heads[column], _("this column must be in %s; convert it and name it '%s'"), "m",
                               heads[c].name);
    }
    return good;
}

static bool find_columns(struct reader *r)
{
    struct csv *csv = &r->csv;
    const struct csv_place begin = csv->next;
    size_t before = r->problems->met, *columns = r->columns;
    csv->blanks = csv->comments = true;
    ceduo_csv_find_head(csv, heads, COLUMNS, columns);
    if (r->problems->met > before)
        return false;
    if (columns[WKT] != CEDUO_CSV_NOT_FOUND)
        return true;
    r->map = columns[DISTANCE] == CEDUO_CSV_NOT_FOUND && columns[EAST] != CEDUO_CSV_NOT_FOUND &&
             columns[NORTH] != CEDUO_CSV_NOT_FOUND;
    bool none = columns[ELEVATION] == CEDUO_CSV_NOT_FOUND && columns[DISTANCE] == CEDUO_CSV_NOT_FOUND;
    if (!check_units(r))
        return false;
    if (none)
        return find_headless(r, begin);
    if (columns[DISTANCE] == CEDUO_CSV_NOT_FOUND && !r->map) /* x may be the distance */
        columns[DISTANCE] = columns[EAST];
    if ((!r->map && columns[DISTANCE] == CEDUO_CSV_NOT_FOUND) || columns[ELEVATION] == CEDUO_CSV_NOT_FOUND)
        return ceduo_problem(r->problems, csv->source, csv->head_place.line, 1,
                             _("the line of heads must name the columns 'distance' and 'elevation'"));
    return true;
}

/* Find the name, after '>', of a line of GMT that begins between two records; NULL: none begins. */
static const char *find_gmt_line(const struct csv *csv, size_t from, size_t *n)
{
    const char *bytes = csv->source->bytes, *p = bytes + from, *end = bytes + csv->place.offset, *name = NULL;
    for (; p < end; p += strcspn(p, "\n") + 1)
        name = *p == '>' ? p + 1 : name;
    if (!name)
        return NULL;
    name += strspn(name, " \t");
    name += strncmp(name, "-L", 2) == 0 ? 2 : 0;
    name += *name == '"';
    *n = strcspn(name, "\"\r\n");
    return name;
}

/* True if a new line begins: the distance of the present record equals that of the first point after distances have risen. */
static bool begins_again(const struct reader *r)
{
    double x;
    return !r->map && r->n > 1 && ceduo_csv_value(&r->csv, ceduo_csv_next_cell(&r->csv, r->columns[DISTANCE]), &x) &&
           x == r->raw[0].along && r->raw[r->n - 1].along > x && r->raw[1].along > x;
}

static bool read_rows(struct reader *r)
{
    struct csv *csv = &r->csv;
    size_t before = r->problems->met, layer = 0, length = 0;
    for (enum column c = DISTANCE; c <= NORTH; c++)
        if (c == ELEVATION || (c == DISTANCE ? !r->map : has_coordinates(r)))
            ceduo_csv_mark_numeric(csv, r->columns[c]);
    ceduo_csv_scan(csv);
    for (size_t from = csv->next.offset; ceduo_csv_next_row(csv); from = csv->next.offset) {
        const struct csv_cell name = ceduo_csv_next_cell(csv, r->columns[LAYER]);
        const char *gmt = find_gmt_line(csv, from, &length);
        if (csv->bad)
            continue;
        if (r->columns[WKT] != CEDUO_CSV_NOT_FOUND) {
            const struct csv_cell wkt = ceduo_csv_next_cell(csv, r->columns[WKT]),
                                  label = ceduo_csv_next_cell(csv, r->columns[LABEL]);
            r->map = true;
            if (is_wkt(wkt.p, wkt.n))
                read_wkt(r, wkt.p, wkt.p + wkt.n, ceduo_csv_line(csv, wkt), name.n > 0 ? name : label);
            else if (!csv->headless)
                ceduo_csv_error(csv, wkt, _("this is not WKT; write LINESTRING Z (x y z, x y z, …)"));
            continue;
        }
        if (r->columns[LAYER] != CEDUO_CSV_NOT_FOUND)
            layer = get_layer(r, name.p, name.n);
        else if (gmt || begins_again(r) || r->layers_count == 0)
            layer = get_layer(r, gmt, gmt ? length : 0);
        read_row(r, layer);
    }
    return r->problems->met == before;
}

/* ---- one line ---- */

#define NAMED 10 /* lines in a message */

/* Keep the points of one line. */
static bool choose_layer(struct reader *r, const char *wanted)
{
    LOCAL_TEXT(names);
    size_t found = wanted || r->layers_count == 1 ? 0 : SIZE_MAX, n = 0;
    ceduo_text_join(&names, (const char *const *)r->layers, r->layers_count < NAMED ? r->layers_count : NAMED, ", ");
    ceduo_text_append(&names, r->layers_count > NAMED ? ", \xe2\x80\xa6" : "");
    while (wanted && found < r->layers_count && strcmp(r->layers[found], wanted) != 0)
        found++;
    if (wanted && found == r->layers_count)
        return ceduo_problem(r->problems, r->csv.source, 0, 0, _("no line '%s'; the file has: %s"), wanted,
                             ceduo_text_string(&names));
    if (found == SIZE_MAX && r->layers_count > 1) /* untaken: memory */
        r->several = ceduo_arena_string(r->arena, ceduo_text_string(&names));
    if (r->several)
        return ceduo_problem(r->problems, r->csv.source, 0, 0,
                             _("the file has %zu lines: %s; name one in the slope, such as 'layer: %s'"), r->layers_count,
                             ceduo_text_string(&names), r->layers[0]);
    for (size_t i = 0; i < r->n; i++)
        if (r->raw[i].layer == found)
            r->raw[n++] = r->raw[i];
    r->n = n;
    return true;
}

/* Return the distance on the map between two points. */
static double step_between(const struct raw *a, const struct raw *b)
{
    return hypot(b->x - a->x, b->y - a->y);
}

/* Check that the distances in a table of four columns (r.profile -g of GRASS) match its coordinates. */
static bool check_distances(struct reader *r)
{
    double along = 0;
    for (size_t i = 0; i < r->n; i++) {
        along += i > 0 ? step_between(&r->raw[i - 1], &r->raw[i]) : 0;
        if (fabs(r->raw[i].along - r->raw[0].along - along) > 0.01 * along + 0.5)
            return reject_at(
                r, &r->raw[i],
                _("four columns without a head; add a first line with their names, such as x,y,distance,elevation"));
    }
    return true;
}

/* Refuse coordinates in degrees and in Web Mercator. `length`: of the line on the map. */
static bool check_coordinates(struct reader *r, double length)
{
    double west = INFINITY, south = INFINITY, east = -INFINITY, north = -INFINITY;
    for (size_t i = 0; i < r->n; i++) {
        west = fmin(west, r->raw[i].x);
        south = fmin(south, r->raw[i].y);
        east = fmax(east, r->raw[i].x);
        north = fmax(north, r->raw[i].y);
    }
    if (length < LINE_MIN && length > 0)
        return ceduo_problem(
            r->problems, r->csv.source, r->csv.head_place.line, 1,
            _("the line is %.2g m long on the map: x and y must be in metres, not in degrees; export it in the "
              "coordinates of a map, such as UTM"),
            length);
    /* Web Mercator from Spain to Romania, but outside the grids used there: UTM, Gauss-Boaga, Lambert-93 */
    bool mercator = west > 840e3 && east < 2.3e6 && south > 4.16e6 && north < 6.3e6;
    bool boaga = west > 1.3e6 && east < 1.85e6 && north < 5.23e6;
    bool lambert = east < 1.3e6 && south > 6e6;
    if (mercator && !boaga && !lambert)
        return ceduo_problem(r->problems, r->csv.source, r->csv.head_place.line, 1,
                             _("the coordinates look like EPSG:3857 (Web Mercator), which makes lengths too long by a third; "
                               "set the project to UTM and export the line again"));
    if (mercator && boaga)
        ceduo_text_append(&r->notes, _("; x and y taken as metres on the ground, not as EPSG:3857"));
    return true;
}

/* Refuse a line that turns back. */
static bool check_turns(struct reader *r)
{
    for (size_t i = 1; i + 1 < r->n; i++) {
        const struct raw *a = &r->raw[i - 1], *b = &r->raw[i], *c = &r->raw[i + 1];
        double one = step_between(a, b), two = step_between(b, c);
        double cosine = ((b->x - a->x) * (c->x - b->x) + (b->y - a->y) * (c->y - b->y)) / (one * two);
        if (one > TURN_STEP && two > TURN_STEP && cosine < -M_SQRT1_2)
            return reject_at(r, b,
                             _("the line turns back here; sort its points as numbers, or draw it again along the fall line"));
    }
    return true;
}

/* Return twice the area of a triangle on the map. Its sign shows on which side of the line from a to b point c lies. */
static double cross_product(const struct raw *a, const struct raw *b, const struct raw *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

/* Refuse a line that crosses itself. Skips points if there are many. */
static bool check_crossings(struct reader *r)
{
    size_t step = r->n / CROSSINGS + 1;
    for (size_t i = step; i < r->n; i += step)
        for (size_t k = i + 2 * step; k < r->n; k += step) {
            const struct raw *a = &r->raw[i - step], *b = &r->raw[i], *c = &r->raw[k - step], *d = &r->raw[k];
            if (cross_product(a, b, c) * cross_product(a, b, d) < 0 && cross_product(c, d, a) * cross_product(c, d, b) < 0)
                return reject_at(r, d, _("the line crosses itself here; draw it again along the fall line"));
        }
    return true;
}

/* Compute distances along a line on the map. */
static bool measure_line(struct reader *r)
{
    for (size_t i = 1; i < r->n; i++)
        r->raw[i].along = r->raw[i - 1].along + step_between(&r->raw[i - 1], &r->raw[i]);
    /* untaken: memory */
    return check_coordinates(r, r->n > 0 ? r->raw[r->n - 1].along : 0) && check_turns(r) && check_crossings(r);
}

/* ---- heights ---- */

static bool is_jump(const struct raw *a, const struct raw *b)
{
    double rise = fabs(b->z - a->z);
    return b->along != a->along && rise > JUMP_RISE && rise > JUMP_SLOPE * fabs(b->along - a->along);
}

/* Refuse impossible heights: single values of 0 or 9999, spikes. */
static bool check_heights(struct reader *r)
{
    size_t before = r->problems->met;
    for (size_t i = 0, last; i < r->n; i = last + 1) { /* a run of equal heights */
        for (last = i; last + 1 < r->n && r->raw[last + 1].z == r->raw[i].z;)
            last++;
        bool suspicious = (r->raw[i].z == 0 || r->raw[i].z == 9999) && !(i == 0 && last + 1 == r->n);
        bool jumps = suspicious && (i == 0 || is_jump(&r->raw[i - 1], &r->raw[i])) &&
                     (last + 1 == r->n || is_jump(&r->raw[last], &r->raw[last + 1]));
        for (size_t k = i; jumps && k <= last; k++)
            reject_at(
                r, &r->raw[k],
                _("a single height of 0 or 9999 marks missing data; remove the row, or fill the gap in the terrain model"));
        if (i == 0 || last != i || i + 1 == r->n)
            continue;
        double up = r->raw[i].z - r->raw[i - 1].z, down = r->raw[i].z - r->raw[i + 1].z;
        bool near = fabs(r->raw[i].along - r->raw[i - 1].along) <= SPIKE_RUN &&
                    fabs(r->raw[i + 1].along - r->raw[i].along) <= SPIKE_RUN;
        if (near && fmin(fabs(up), fabs(down)) > SPIKE_RISE && up * down > 0 && !jumps)
            reject_at(r, &r->raw[i],
                      _("this height is more than 200 m from both neighbours; remove the row, or mend the terrain model"));
    }
    return r->problems->met == before;
}

/* ---- x that rises ---- */

/* True if the distances are sorted as text instead of numbers. */
static bool is_text_order(const struct reader *r)
{
    size_t i = 1;
    char a[CEDUO_NUMBER_SIZE], b[CEDUO_NUMBER_SIZE];
    while (i < r->n && strcmp(ceduo_number_shortest(r->raw[i - 1].along, a), ceduo_number_shortest(r->raw[i].along, b)) <= 0)
        i++;
    return i == r->n;
}

static bool refuse_order(struct reader *r, const struct raw *raw, double before)
{
    if (is_text_order(r))
        return reject_at(r, raw, _("the rows are sorted as text; sort them by distance, as numbers"));
    return ceduo_problem(r->problems, r->csv.source, raw->line, 1,
                         _("distances must rise, but %s follows %s; sort the rows by distance"), ROUNDTRIP(raw->along),
                         ROUNDTRIP(before));
}

static void add_vertex(struct points *p, double x, double z)
{
    p->x[p->n] = p->n > 0 ? fmax(x, p->x[p->n - 1] + WALL_RUN / 10) : x;
    p->z[p->n++] = z;
}

/* Make points with rising x, from the top down. Drops repeated points; a vertical step becomes a wall, an overhang its outer
 * envelope. `sign`: 1, or -1 for a profile drawn uphill. */
static bool make_rising(struct reader *r, struct points *p, double sign)
{
    size_t repeated = 0, walls = 0, overhangs = 0, n = r->n;
    double wall = NAN, overhang = NAN, edge = -INFINITY; /* edge: largest x so far */
    for (size_t i = 0; i < n; i++) {
        const struct raw *now = &r->raw[sign > 0 ? i : n - 1 - i], *last = i > 0 ? &r->raw[sign > 0 ? i - 1 : n - i] : now;
        double x = sign * now->along, z = now->z, x_last = sign * last->along;
        if (i > 0 && x == x_last && z == last->z) {
            repeated++;
        } else if (x > edge && x_last < edge) { /* end of an overhang */
            double t = (edge - x_last) / (x - x_last);
            add_vertex(p, edge + WALL_RUN, last->z + t * (z - last->z));
            add_vertex(p, x, z);
        } else if (x > edge) {
            add_vertex(p, x, z);
        } else if (x == edge && x_last == edge) {
            add_vertex(p, edge + WALL_RUN, z);
            wall = walls++ == 0 ? sign * edge : wall;
        } else {
            if (z >= last->z || edge - x > OVERHANG_MAX || i + 1 == n)
                return refuse_order(r, sign > 0 ? now : last, (sign > 0 ? last : now)->along);
            overhang = x_last == edge && overhangs++ == 0 ? sign * edge : overhang;
            if (x == edge)
                add_vertex(p, edge + WALL_RUN, z);
        }
        edge = fmax(edge, x);
    }
    if (repeated > 0)
        ceduo_text_format(&r->notes, ngettext("; %zu repeated point dropped", "; %zu repeated points dropped", repeated),
                          repeated);
    if (walls > 0)
        ceduo_text_format(
            &r->notes,
            ngettext("; %zu vertical step, at %s m, made a wall", "; %zu vertical steps, the first at %s m, made walls", walls),
            walls, ROUNDTRIP(wall));
    if (overhangs > 0)
        ceduo_text_format(&r->notes,
                          ngettext("; %zu overhang, at %s m, replaced by its outer envelope",
                                   "; %zu overhangs, the first at %s m, replaced by their outer envelope", overhangs),
                          overhangs, ROUNDTRIP(overhang));
    return true;
}

static bool make_points(struct reader *r, struct points *p)
{
    p->x = ceduo_arena_alloc(r->arena, (2 * r->n + 1) * sizeof *p->x);
    p->z = ceduo_arena_alloc(r->arena, (2 * r->n + 1) * sizeof *p->z);
    if (!p->x || !p->z)
        return false;
    bool upward = r->n > 1 && r->raw[r->n - 1].z > r->raw[0].z;
    size_t falling = 0;
    for (size_t i = 1; i < r->n; i++)
        falling += r->raw[i].along < r->raw[i - 1].along;
    if (r->n > 1 && falling + 1 == r->n)
        return refuse_order(r, &r->raw[1], r->raw[0].along);
    if (!make_rising(r, p, upward ? -1 : 1))
        return false;
    if (p->n > 1 && fabs(p->x[p->n - 1] - p->x[0]) < LENGTH_MIN)
        return reject_at(r, &r->raw[r->n - 1], _("all points lie at the same distance; a profile must have a length"));
    for (size_t i = 0; upward && i < (p->n + 1) / 2; i++) {
        size_t k = p->n - 1 - i;
        double x = p->x[i], z = p->z[i];
        p->x[i] = -p->x[k];
        p->z[i] = p->z[k];
        p->x[k] = -x;
        p->z[k] = z;
    }
    return true;
}

/* ---- reading ---- */

static void describe_table(struct reader *r, struct points *p, const char *path)
{
    LOCAL_TEXT(line);
    const struct csv *csv = &r->csv;
    const bool wkt = r->columns[WKT] != CEDUO_CSV_NOT_FOUND, table = !csv->headless;
    size_t used[5] = {r->columns[wkt ? WKT : r->map ? EAST : DISTANCE]}, n = 1;
    double rise = p->z[p->n - 1] - p->z[0];
    if (!wkt && r->map)
        used[n++] = r->columns[NORTH];
    if (!wkt)
        used[n++] = r->columns[ELEVATION];
    ceduo_text_append_escaped(&line, ceduo_file_name(path));
    ceduo_text_format(&line,
                      rise > 0 ? _(": %zu points, %.4g m long, rises %.4g m") : _(": %zu points, %.4g m long, falls %.4g m"),
                      p->n, p->x[p->n - 1] - p->x[0], fabs(rise));
    if (r->layers_count > 1)
        ceduo_text_format(&line, _("; line '%.100s' of %zu"), r->layers[r->raw[0].layer], r->layers_count);
    if (csv->headless && !wkt)
        ceduo_text_append(&line, _("; no head: taken as distance and elevation"));
    for (size_t i = 0; table && i < n; i++) {
        ceduo_text_append(&line, i > 0 ? ", " : n > 1 ? _("; columns ") : _("; column "));
        ceduo_text_append_escaped_n(&line, csv->heads[used[i]].p, csv->heads[used[i]].n);
    }
    used[n++] = r->columns[LAYER];
    if (wkt)
        used[n++] = r->columns[LABEL];
    ceduo_csv_describe(csv, used, n, ceduo_text_string(&r->notes), &line);
    p->understood = ceduo_arena_string(r->arena, ceduo_text_string(&line));
}

/* Read the points of all lines. */
static bool read_points(struct reader *r)
{
    const struct source *s = r->csv.source;
    const char *begin = s->bytes + r->csv.next.offset, *end = s->bytes + s->length;
    while (begin < end && isspace((unsigned char)*begin))
        begin++;
    if (!is_wkt(begin, (size_t)(end - begin)))
        return find_columns(r) && read_rows(r);
    for (size_t c = 0; c < COLUMNS; c++)
        r->columns[c] = c == WKT ? 0 : CEDUO_CSV_NOT_FOUND;
    r->csv.source->foreign = false;
    ceduo_csv_begin_headless(&r->csv, '\n'); /* each line is one cell */
    return read_rows(r);
}

bool ceduo_csv_slope_read(struct arena *arena, const char *path, const char *layer, struct points *points,
                          struct problems *problems)
{
    struct reader *r = ceduo_arena_alloc(arena, sizeof *r);
    *points = (struct points){0};
    if (!r)
        return false;
    *r = (struct reader){.arena = arena, .problems = problems};
    bool good = ceduo_csv_open(&r->csv, arena, path, problems) && check_table(&r->csv, problems) && read_points(r) &&
                (r->n == 0 || (choose_layer(r, layer) &&
                               (r->map ? measure_line(r) : !has_coordinates(r) || check_distances(r)) && check_heights(r))) &&
                make_points(r, points);
    points->lines = r->several;
    if (good && points->n > 0)
        describe_table(r, points, path);
    ceduo_text_free(&r->notes);
    return good;
}
