/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "csv.h"

#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "base/utf8.h"
#include "file.h"

static bool next_line(const struct source *s, size_t *at, struct csv_span *line)
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

static struct csv_span trim(struct csv_span f)
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

bool ceduo_csv_cell(struct csv_span *left, char separator, struct csv_span *field)
{
    if (!left->p)
        return false;
    const char *end = left->p + left->n, *stop = field_end(left->p, end, separator);
    *field = (struct csv_span){left->p, (size_t)(stop - left->p)};
    *left = stop == end ? (struct csv_span){NULL, 0} : (struct csv_span){stop + 1, (size_t)(end - stop) - 1};
    return true;
}

bool ceduo_csv_is(struct csv_span f, const char *word)
{
    return strlen(word) == f.n && strncasecmp(f.p, word, f.n) == 0;
}

bool ceduo_csv_open(struct csv *csv, struct arena *arena, const char *path, struct problems *problems)
{
    *csv = (struct csv){.source = (struct source *)(uintptr_t)ceduo_file_read(arena, path, CSV_BYTES_MOST, problems),
                        .problems = problems};
    if (!csv->source)
        return false;
    csv->at = ceduo_source_mark(csv->source);
    if (!next_line(csv->source, &csv->at, &csv->header)) {
        ceduo_problem(problems, csv->source, 0, 0, _("the file is empty"));
        return false;
    }
    csv->number = 1;
    csv->line = csv->header;
    csv->separator = memchr(csv->line.p, ';', csv->line.n) ? ';' : memchr(csv->line.p, '\t', csv->line.n) ? '\t' : ',';
    return true;
}

size_t ceduo_csv_column(const struct csv *csv, const char *const *names)
{
    for (int k = 0; names[k]; k++) {
        size_t found = CEDUO_CSV_NONE;
        struct csv_span left = csv->header, f;
        for (size_t i = 0; ceduo_csv_cell(&left, csv->separator, &f); i++)
            if (ceduo_csv_is(trim(f), names[k]))
                found = found == CEDUO_CSV_NONE ? i : CEDUO_CSV_TWICE;
        if (found != CEDUO_CSV_NONE)
            return found;
    }
    return CEDUO_CSV_NONE;
}

size_t ceduo_csv_columns(const struct csv *csv, struct text *names)
{
    struct csv_span left = csv->header, f;
    size_t n = 0;
    for (; ceduo_csv_cell(&left, csv->separator, &f); n++) {
        f = trim(f);
        ceduo_text_put(names, n > 0 ? ", " : "");
        ceduo_text_safe_n(names, f.p, f.n);
    }
    size_t shown = csv->source->foreign ? ceduo_utf8_cut(ceduo_text_string(names), CEDUO_FOREIGN_MOST) : names->length;
    if (shown < names->length) {
        names->length = shown;
        ceduo_text_put(names, "\xe2\x80\xa6");
    }
    return n;
}

static bool is_blank(struct csv_span line)
{
    for (size_t i = 0; i < line.n; i++)
        if (line.p[i] != ' ' && line.p[i] != '\t' && line.p[i] != ',' && line.p[i] != ';')
            return false;
    return true;
}

bool ceduo_csv_next(struct csv *csv)
{
    while (next_line(csv->source, &csv->at, &csv->line)) {
        csv->number++;
        if (!is_blank(csv->line))
            return true;
    }
    return false;
}

size_t ceduo_csv_lines(const struct csv *csv)
{
    const struct source *s = csv->source;
    size_t n = 1;
    for (size_t i = 0; i < s->length; i++)
        n += s->bytes[i] == '\n';
    return n;
}

bool ceduo_csv_step(const struct csv *csv, struct csv_span *left, struct csv_span *field)
{
    if (!ceduo_csv_cell(left, csv->separator, field))
        return false;
    *field = trim(*field);
    return true;
}

bool ceduo_csv_field(const struct csv *csv, size_t column, struct csv_span *field)
{
    struct csv_span left = csv->line;
    for (size_t i = 0; i <= column; i++)
        if (!ceduo_csv_cell(&left, csv->separator, field))
            return false;
    *field = trim(*field);
    return true;
}

bool ceduo_csv_complain(const struct csv *csv, struct csv_span field, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(csv->problems, (struct problem_place){csv->source, csv->number, (size_t)(field.p - csv->line.p) + 1, NULL},
                    format, args);
    va_end(args);
    return false;
}

/* Where commas do not separate they may stand for the decimals, in all numbers of a file or in none: a dot beside them
 * would be one of thousands. False where a number has the other. */
static bool take_decimal(struct csv *c, char *room)
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

bool ceduo_csv_number(struct csv *csv, struct csv_span f, double lo, double hi, const char *unit, double *value)
{
    char room[512];
    bool fits = f.n < sizeof room;
    if (fits) {
        memcpy(room, f.p, f.n);
        room[f.n] = '\0';
    }
    bool one_decimal = !fits || take_decimal(csv, room);
    enum ceduo_number_reading reading =
        fits && one_decimal && !memchr(room, '\0', f.n) ? ceduo_number_read(room, value) : CEDUO_NUMBER_NONE;
    if (reading == CEDUO_NUMBER_GOOD && *value <= hi && *value >= lo)
        return true;
    if (f.n == 0)
        ceduo_csv_complain(csv, f, _("a value is missing; remove the line"));
    else if (reading == CEDUO_NUMBER_GOOD && *value < lo && lo > -hi)
        ceduo_csv_complain(csv, f, _("'%s' is below %g %s"), room, lo, unit);
    else if (reading != CEDUO_NUMBER_NONE)
        ceduo_csv_complain(csv, f, _("beyond %g %s"), hi, unit);
    else if (!one_decimal)
        ceduo_csv_complain(csv, f, _("'%s': decimals stand after a comma or after a dot, not both"), room);
    else if (fits && strchr(room, ','))
        ceduo_csv_complain(csv, f, _("'%s' is not a number; write a dot for the decimals"), room);
    else
        ceduo_csv_complain(csv, f, _("'%s' is not a number"), fits ? room : "…");
    return false;
}
