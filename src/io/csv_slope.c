/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A profile from a CSV file: the header names the columns, each row is checked against the one before. */
#include "derive.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "file.h"

/* A line of the file, and a field of it. */
struct span {
    const char *p;
    size_t n;
};

static bool next_line(const struct source *s, size_t *at, struct span *line)
{
    if (*at >= s->length)
        return false;
    const char *from = s->bytes + *at, *end = memchr(from, '\n', s->length - *at);
    line->p = from;
    line->n = end ? (size_t)(end - from) : s->length - *at;
    *at += line->n + 1;
    if (line->n > 0 && line->p[line->n - 1] == '\r')
        line->n--;
    return true;
}

static struct span trim(struct span f)
{
    while (f.n > 0 && (f.p[0] == ' ' || f.p[0] == '"')) {
        f.p++;
        f.n--;
    }
    while (f.n > 0 && (f.p[f.n - 1] == ' ' || f.p[f.n - 1] == '"'))
        f.n--;
    return f;
}

/* Where a field that begins at p ends: at the separator, but not at one in quotes. */
static const char *field_end(const char *p, const char *end, char separator)
{
    bool quoted = false;
    for (; p < end && (quoted || *p != separator); p++)
        quoted ^= *p == '"';
    return p;
}

/* Takes the first field off what is left of a line; false where nothing is left. A line without a byte has one field. */
static bool next_field(struct span *left, char separator, struct span *field)
{
    if (!left->p)
        return false;
    const char *end = left->p + left->n, *stop = field_end(left->p, end, separator);
    *field = (struct span){left->p, (size_t)(stop - left->p)};
    *left = stop == end ? (struct span){NULL, 0} : (struct span){stop + 1, (size_t)(end - stop) - 1};
    return true;
}

/* Field number `which` of a line; false where it has fewer. */
static bool field_of(struct span line, char separator, size_t which, struct span *field)
{
    for (size_t i = 0; i <= which; i++)
        if (!next_field(&line, separator, field))
            return false;
    *field = trim(*field);
    return true;
}

static bool is_word(struct span f, const char *word)
{
    return strlen(word) == f.n && strncasecmp(f.p, word, f.n) == 0;
}

struct columns {
    char separator;
    size_t x, z;
    char decimal; /* ',' or '.', once a number has shown it; '\0' before */
};

/* Names of a column, the better ones first; in other languages as their spreadsheets have them. */
static const char *const distances[] = {"distance", "distanza", "progressiva", "entfernung", "distanz", "x", NULL};
static const char *const elevations[] = {"elevation", "quota", "elevazione", "h\xc3\xb6he", "hoehe", "z", NULL};

/* The column of the first name that there is. SIZE_MAX: none, SIZE_MAX - 1: two of them. */
static size_t column_of(struct span line, char separator, const char *const *names)
{
    for (int k = 0; names[k]; k++) {
        size_t found = SIZE_MAX;
        struct span left = line, f;
        for (size_t i = 0; next_field(&left, separator, &f); i++)
            if (is_word(trim(f), names[k]))
                found = found == SIZE_MAX ? i : SIZE_MAX - 1;
        if (found != SIZE_MAX)
            return found;
    }
    return SIZE_MAX;
}

static bool read_header(const struct source *s, struct span line, struct columns *c, struct problems *problems)
{
    c->decimal = '\0';
    c->separator = memchr(line.p, ';', line.n) ? ';' : memchr(line.p, '\t', line.n) ? '\t' : ',';
    c->x = column_of(line, c->separator, distances);
    c->z = column_of(line, c->separator, elevations);
    if (c->x < SIZE_MAX - 1 && c->z < SIZE_MAX - 1)
        return true;
    if (c->x == SIZE_MAX || c->z == SIZE_MAX)
        ceduo_problem(problems, s, 1, 1, _("the first line must name the columns 'distance' and 'elevation'"));
    else
        ceduo_problem(problems, s, 1, 1, _("a column is named twice; rename all but one"));
    return false;
}

/* Where commas do not separate they may stand for the decimals, in all numbers of a file or in none: a dot beside them
 * would be one of thousands. False where a number has the other. */
static bool take_decimal(struct columns *c, char *room)
{
    char *comma = c->separator == ',' ? NULL : strchr(room, ',');
    bool dot = strchr(room, '.') != NULL;
    if ((comma && (dot || c->decimal == '.')) || (dot && c->decimal == ','))
        return false;
    if (comma)
        *comma = '.';
    c->decimal = comma ? ',' : dot ? '.' : c->decimal;
    return true;
}

static bool read_value(const struct source *s, struct columns *c, struct span f, size_t line, const char *start,
                       double *value, struct problems *problems)
{
    char room[512];
    size_t column = (size_t)(f.p - start) + 1;
    bool fits = f.n < sizeof room;
    if (fits) {
        memcpy(room, f.p, f.n);
        room[f.n] = '\0';
    }
    bool one_decimal = !fits || take_decimal(c, room);
    enum ceduo_number_reading reading = fits && one_decimal && !memchr(room, '\0', f.n)
                                            ? ceduo_number_read(room, value)
                                            : CEDUO_NUMBER_NONE;
    const struct field *vertex = ceduo_schema_field(ceduo_schema_slope(), "vertices_m");
    if (reading == CEDUO_NUMBER_GOOD && *value <= vertex->hi && *value >= vertex->lo)
        return true;
    if (f.n == 0)
        ceduo_problem(problems, s, line, column, _("a value is missing; remove the line"));
    else if (reading != CEDUO_NUMBER_NONE)
        ceduo_problem(problems, s, line, column, _("beyond %g m"), vertex->hi);
    else if (!one_decimal)
        ceduo_problem(problems, s, line, column, _("'%s': decimals stand after a comma or after a dot, not both"),
                      room);
    else if (fits && strchr(room, ','))
        ceduo_problem(problems, s, line, column, _("'%s' is not a number; write a dot for the decimals"), room);
    else
        ceduo_problem(problems, s, line, column, _("'%s' is not a number"), fits ? room : "…");
    return false;
}

static size_t count_lines(const struct source *s)
{
    size_t n = 1;
    for (size_t i = 0; i < s->length; i++)
        n += s->bytes[i] == '\n';
    return n;
}

static bool is_blank(struct span line)
{
    for (size_t i = 0; i < line.n; i++)
        if (line.p[i] != ' ' && line.p[i] != '\t' && line.p[i] != ',' && line.p[i] != ';')
            return false;
    return true;
}

static void read_row(const struct source *s, struct columns *c, struct span line, size_t number,
                     struct points *points, struct problems *problems)
{
    struct span fx, fz;
    double x, z;
    if (!field_of(line, c->separator, c->x, &fx) || !field_of(line, c->separator, c->z, &fz)) {
        ceduo_problem(problems, s, number, 1, _("too few columns"));
        return;
    }
    if (!read_value(s, c, fx, number, line.p, &x, problems) || !read_value(s, c, fz, number, line.p, &z, problems))
        return;
    if (points->n > 0 && !(x > points->x[points->n - 1])) {
        char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
        ceduo_problem(problems, s, number, (size_t)(fx.p - line.p) + 1,
                      _("distance %s does not lie beyond %s; distances must rise"), ceduo_number_shortest(x, a),
                      ceduo_number_shortest(points->x[points->n - 1], b));
        return;
    }
    points->x[points->n] = x;
    points->z[points->n++] = z;
}

bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems)
{
    size_t before = problems->met;
    const struct source *s = ceduo_file_read(arena, path, CSV_BYTES_MOST, problems);
    if (!s)
        return false;
    size_t rows = count_lines(s), at = ceduo_source_mark(s);
    points->x = ceduo_arena_take(arena, rows * sizeof(double));
    points->z = ceduo_arena_take(arena, rows * sizeof(double));
    if (!points->x || !points->z) {
        ceduo_problem_memory(problems);
        return false;
    }
    struct span line;
    struct columns columns;
    if (!next_line(s, &at, &line)) {
        ceduo_problem(problems, s, 0, 0, _("the file is empty"));
        return false;
    }
    if (!read_header(s, line, &columns, problems))
        return false;
    for (size_t number = 2; next_line(s, &at, &line); number++)
        if (!is_blank(line))
            read_row(s, &columns, line, number, points, problems);
    points->commas = columns.decimal == ',';
    return problems->met == before;
}
