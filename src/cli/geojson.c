/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --format geojson: a feature for each line of the output (RFC 7946). Its geometry is a copied cell of --each: WKT, or x and y.
 * Coordinates are written as they are given. */
#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "each.h"

/* ---- geometry ---- */

/* Geometries of WKT. Depth: levels of lists around a point. */
static const struct {
    const char *word, *type;
    int depth;
} geometries[] = {{"POINT", "Point", 0}, {"LINESTRING", "LineString", 1}, {"MULTILINESTRING", "MultiLineString", 2}};

static void skip_blanks(const char **p)
{
    *p += strspn(*p, " \t\r\n");
}

/* Read a word of letters; false unless it is `word`, in any case. */
static bool read_word(const char **p, const char *word)
{
    size_t n = strlen(word);
    skip_blanks(p);
    if (strncasecmp(*p, word, n) != 0)
        return false;
    *p += n;
    return true;
}

/* Append a point of two to four numbers, without its fourth and, if `measured`, its third one. */
static bool append_point(const char **p, bool measured, struct text *out)
{
    size_t n = 0;
    double value;
    ceduo_text_append_char(out, '[');
    for (skip_blanks(p); n < 4 && strchr("+-.0123456789", **p) && **p; skip_blanks(p), n++) {
        LOCAL_TEXT(number);
        size_t length = strspn(*p, "+-.0123456789eE");
        ceduo_text_append_n(&number, *p + (**p == '+'), length - (**p == '+'));
        *p += length;
        if (ceduo_number_read(ceduo_text_string(&number), &value) != CEDUO_NUMBER_GOOD)
            return false;
        if (n < (measured ? 2 : 3))
            ceduo_text_format(out, "%s%s", n > 0 ? ", " : "", ROUNDTRIP(value));
    }
    ceduo_text_append_char(out, ']');
    return n >= 2;
}

static bool append_list(const char **p, int depth, bool measured, struct text *out);

/* Append the items of a list up to its closing bracket. A line has at least two points. */
static bool append_items(const char **p, int depth, bool measured, struct text *out)
{
    size_t n = 0;
    ceduo_text_append_char(out, '[');
    do {
        ceduo_text_append(out, n++ > 0 ? ", " : "");
        if (!(depth > 1 ? append_list(p, depth - 1, measured, out) : append_point(p, measured, out)))
            return false;
        skip_blanks(p);
    } while (*(*p)++ == ',');
    ceduo_text_append_char(out, ']');
    return (*p)[-1] == ')' && (depth > 1 || n > 1);
}

static bool append_list(const char **p, int depth, bool measured, struct text *out)
{
    skip_blanks(p);
    if (*(*p)++ != '(')
        return false;
    if (depth > 0)
        return append_items(p, depth, measured, out);
    bool good = append_point(p, measured, out);
    skip_blanks(p);
    return good && *(*p)++ == ')';
}

/* Append WKT or EWKT as GeoJSON. False if it is another geometry, or broken. */
static bool append_wkt(const char *wkt, struct text *out)
{
    const char *p = strncasecmp(wkt, "SRID=", 5) == 0 && strchr(wkt, ';') ? strchr(wkt, ';') + 1 : wkt;
    for (size_t i = 0; i < sizeof geometries / sizeof geometries[0]; i++) {
        const char *rest = p;
        if (!read_word(&rest, geometries[i].word))
            continue;
        bool z = read_word(&rest, "Z"), measured = read_word(&rest, "M") && !z;
        ceduo_text_format(out, "{\"type\": \"%s\", \"coordinates\": ", geometries[i].type);
        bool good = append_list(&rest, geometries[i].depth, measured, out);
        ceduo_text_append_char(out, '}');
        skip_blanks(&rest);
        return good && !*rest;
    }
    return false;
}

bool ceduo_geometry_find(struct each *e)
{
    e->wkt = e->x = e->y = NO_COLUMN;
    for (size_t i = 0; i < e->heads_count; i++) {
        const char *name = e->heads[i].name;
        size_t *column = strcasecmp(name, "wkt") == 0 ? &e->wkt : strcasecmp(name, "x") == 0 ? &e->x : &e->y;
        if (column != &e->y || strcasecmp(name, "y") == 0)
            *column = i;
    }
    for (size_t i = 0; i < e->heads_count; i++)
        e->table.heads[i].numeric |= e->wkt == NO_COLUMN && (i == e->x || i == e->y);
    return e->wkt != NO_COLUMN || (e->x != NO_COLUMN && e->y != NO_COLUMN) ||
           ceduo_problem(e->table.problems, e->table.source, e->table.head_place.line, 1,
                         _("--format geojson needs a geometry: a column 'wkt', or 'x' and 'y'"));
}

/* Append the number of a cell. False if it is none. */
static bool append_coordinate(const struct each *e, size_t column, struct text *out)
{
    double value;
    if (!ceduo_csv_value(&e->table, ceduo_csv_next_cell(&e->table, column), &value))
        return false;
    ceduo_text_append(out, ROUNDTRIP(value));
    return true;
}

bool ceduo_geometry_print(const struct each *e, struct text *out)
{
    if (e->wkt != NO_COLUMN) {
        LOCAL_TEXT(wkt);
        const struct csv_cell cell = ceduo_csv_next_cell(&e->table, e->wkt);
        ceduo_text_append_n(&wkt, cell.p, cell.n);
        return append_wkt(ceduo_text_string(&wkt), out);
    }
    ceduo_text_append(out, "{\"type\": \"Point\", \"coordinates\": [");
    bool good = append_coordinate(e, e->x, out);
    ceduo_text_append(out, ", ");
    good = append_coordinate(e, e->y, out) && good;
    ceduo_text_append(out, "]}");
    return good;
}

bool ceduo_geometry_check(const struct each *e)
{
    LOCAL_TEXT(geometry);
    if (ceduo_geometry_print(e, &geometry))
        return true;
    struct csv_cell cell = ceduo_csv_next_cell(&e->table, e->wkt != NO_COLUMN ? e->wkt : e->x);
    return ceduo_csv_error(&e->table, cell,
                           e->wkt != NO_COLUMN ? _("no geometry: write POINT (x y) or LINESTRING (x y, x y)")
                                               : _("no geometry: x and y need a number each"));
}

/* ---- features ---- */

/* Append a cell of the result as a property. `text`: its quotes are removed. */
static void append_cell(struct json *j, const char *name, struct csv_span cell, bool text)
{
    LOCAL_TEXT(value);
    bool quoted = cell.n > 1 && cell.p[0] == '"';
    for (size_t i = quoted; i + quoted < cell.n; i++) {
        ceduo_text_append_char(&value, cell.p[i]);
        i += quoted && cell.p[i] == '"';
    }
    double number;
    if (cell.n == 0)
        ceduo_json_string(j, name, NULL);
    else if (text)
        ceduo_json_string(j, name, ceduo_text_string(&value));
    else if (ceduo_number_read(ceduo_text_string(&value), &number) == CEDUO_NUMBER_GOOD)
        ceduo_json_number(j, name, number);
    else
        ceduo_json_flag(j, name, strcmp(ceduo_text_string(&value), "true") == 0);
}

void ceduo_geojson_print(const struct columns *c, void *out)
{
    const struct each *e = c->each;
    struct json j = {.text = out};
    LOCAL_TEXT(geometry);
    bool known = ceduo_geometry_print(e, &geometry);
    ceduo_text_format(
        out, "{\"type\": \"Feature\", \"geometry\": %s, \"properties\": ", known ? ceduo_text_string(&geometry) : "null");
    ceduo_json_open(&j, NULL, '{');
    for (size_t k = 0; k < c->chosen_count; k++) {
        size_t column = c->chosen[k].column;
        if (column < c->copied_count)
            ceduo_each_json_cell(&j, c->chosen[k].name, e->cells[c->copied[column]]);
        else
            append_cell(&j, c->chosen[k].name, c->cells[column], c->texts[column]);
    }
    ceduo_json_close(&j, '}');
    ceduo_text_append(out, "},\n");
}
