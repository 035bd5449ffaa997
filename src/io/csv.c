/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "csv.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <uniconv.h>
#include <unistr.h>

#include "base/language.h"
#include "base/must.h"
#include "base/utf8.h"
#include "file.h"

#define FOLDED_MOST 128 /* bytes of the head of a column that are compared */
#define TITLE_MOST  20  /* lines that may stand above the heads */

/* ---- encodings ---- */

/* What spreadsheets write that do not write UTF-8, as UTF-8: UTF-16 by its mark or its zeros, otherwise Windows-1252. What cannot
 * be read so stays as it is. False without memory. */
static bool recode(struct arena *arena, struct source *s)
{
    const unsigned char *p = (const unsigned char *)s->bytes;
    size_t n = s->length, length;
    bool marked = n >= 2 && ((p[0] == 0xff && p[1] == 0xfe) || (p[0] == 0xfe && p[1] == 0xff));
    bool wide = n % 2 == 0 &&
                (marked || (n >= 4 && (p[0] == 0) != (p[1] == 0) && (p[2] == 0) == (p[0] == 0) && (p[3] == 0) == (p[1] == 0)));
    bool big = wide && (marked ? p[0] == 0xfe : p[0] == 0);
    if (!wide && !u8_check(p, n))
        return true;
    size_t skip = wide && marked ? 2 : 0;
    uint8_t *bytes =
        u8_conv_from_encoding(wide ? big ? "UTF-16BE" : "UTF-16LE" : "CP1252", /* of which each byte is a sign */
                              wide ? iconveh_error : iconveh_question_mark, s->bytes + skip, n - skip, NULL, NULL, &length);
    bool lost = !bytes && errno == ENOMEM;
    const char *kept = bytes ? ceduo_arena_copy(arena, (const char *)bytes, length) : s->bytes;
    s->length = bytes ? length : n;
    s->bytes = kept;
    free(bytes);
    return kept && !lost;
}

/* ---- lines and fields ---- */

static bool next_line(struct csv *csv)
{
    size_t from, to;
    bool good = ceduo_source_next(csv->source, &csv->at, &from, &to);
    if (good)
        csv->line = (struct csv_span){csv->source->bytes + from, to - from};
    return good;
}

static struct csv_span trim(struct csv_span f)
{
    for (; f.n > 0 && (f.p[0] == ' ' || f.p[0] == '"'); f.n--)
        f.p++;
    while (f.n > 0 && (f.p[f.n - 1] == ' ' || f.p[f.n - 1] == '"'))
        f.n--;
    return f;
}

bool ceduo_csv_cell(struct csv_span *left, char separator, struct csv_span *field)
{
    if (!left->p)
        return false;
    const char *end = left->p + left->n, *stop = left->p;
    for (bool quoted = false; stop < end && (quoted || *stop != separator); stop++) /* one in quotes ends nothing */
        quoted ^= *stop == '"';
    *field = (struct csv_span){left->p, (size_t)(stop - left->p)};
    *left = stop == end ? (struct csv_span){NULL, 0} : (struct csv_span){stop + 1, (size_t)(end - stop) - 1};
    return true;
}

bool ceduo_csv_is(struct csv_span f, const char *word)
{
    return strlen(word) == f.n && strncasecmp(f.p, word, f.n) == 0;
}

/* The present line is the header. */
static void take_header(struct csv *csv, size_t number)
{
    csv->header = csv->line;
    csv->header_number = csv->number = number;
    csv->separator = memchr(csv->line.p, ';', csv->line.n) ? ';' : memchr(csv->line.p, '\t', csv->line.n) ? '\t' : ',';
}

bool ceduo_csv_open(struct csv *csv, struct arena *arena, const char *path, struct problems *problems)
{
    *csv = (struct csv){.source = (struct source *)(uintptr_t)ceduo_file_read(arena, path, CSV_BYTES_MOST, problems),
                        .problems = problems};
    if (!csv->source)
        return false;
    if (csv->source->length > 4 && /* xlsx and ods, xls */
        (memcmp(csv->source->bytes, "PK\3\4", 4) == 0 || memcmp(csv->source->bytes, "\xd0\xcf\x11\xe0", 4) == 0))
        return ceduo_problem_at(problems, (struct problem_place){.source = csv->source, .own = true},
                                _("this is a workbook; open it and save its sheet as CSV (File, Save as)"));
    if (!recode(arena, csv->source)) {
        ceduo_no_memory();
        return false;
    }
    csv->at = ceduo_source_mark(csv->source);
    if (!next_line(csv))
        return ceduo_problem(problems, csv->source, 0, 0, _("the file is empty"));
    take_header(csv, 1);
    return true;
}

static bool is_among(const char *word, const char *words)
{
    char one[FOLDED_MOST];
    for (size_t n; *words; words += n, words += *words == '|') {
        n = strcspn(words, "|");
        if (strcmp(ceduo_utf8_fold(words, n, one, sizeof one), word) == 0)
            return true;
    }
    return false;
}

/* Whether the head of a column is a name, alone or with a unit. */
static bool is_head(struct csv_span head, const char *name, const char *units)
{
    char said[FOLDED_MOST], wanted[FOLDED_MOST], unit[FOLDED_MOST];
    size_t before = 0;
    while (before < head.n && head.p[before] != '(' && head.p[before] != '[')
        before++;
    ceduo_utf8_fold(head.p, before, said, sizeof said);
    size_t n = strlen(ceduo_utf8_fold(name, strlen(name), wanted, sizeof wanted));
    if (ceduo_csv_is(head, name))
        return true;
    if (n == 0 || strncmp(said, wanted, n) != 0)
        return false;
    if (before < head.n && units)
        return !said[n] && is_among(ceduo_utf8_fold(head.p + before, head.n - before, unit, sizeof unit), units);
    return !said[n] || (units && is_among(said + n, units));
}

size_t ceduo_csv_column(const struct csv *csv, const char *const *names, const char *units)
{
    for (int k = 0; names[k]; k++) {
        size_t found = CEDUO_CSV_NONE;
        struct csv_span left = csv->header, f;
        for (size_t i = 0; ceduo_csv_cell(&left, csv->separator, &f); i++)
            if (is_head(trim(f), names[k], units))
                found = found == CEDUO_CSV_NONE ? i : CEDUO_CSV_TWICE;
        if (found != CEDUO_CSV_NONE)
            return found;
    }
    return CEDUO_CSV_NONE;
}

void ceduo_csv_find(struct csv *csv, const struct csv_head *heads, size_t n, size_t *columns)
{
    struct csv best = *csv, line = *csv;
    size_t most = 0;
    do {
        size_t found = 0;
        for (size_t i = 0; i < n; i++)
            found += ceduo_csv_column(&line, heads[i].names, heads[i].units) != CEDUO_CSV_NONE;
        if (found > most)
            best = line;
        most = found > most ? found : most;
        if (!ceduo_csv_next(&line))
            break;
        take_header(&line, line.number);
    } while (line.number <= TITLE_MOST);
    *csv = best;
    for (size_t i = 0; i < n; i++) {
        columns[i] = ceduo_csv_column(csv, heads[i].names, heads[i].units);
        csv->source->foreign &= columns[i] == CEDUO_CSV_NONE;
    }
    for (size_t i = 0; i < n; i++)
        if (columns[i] == CEDUO_CSV_TWICE)
            ceduo_problem(csv->problems, csv->source, csv->header_number, 1,
                          _("the column '%s' is there twice; rename all but one"), _(heads[i].names[0]));
}

size_t ceduo_csv_columns(const struct csv *csv, struct text *names)
{
    struct csv_span left = csv->header, f;
    size_t n = 0;
    for (; ceduo_csv_step(csv, &left, &f); n++) {
        ceduo_text_put(names, n > 0 ? ", " : "");
        ceduo_text_safe_n(names, f.p, f.n);
    }
    size_t shown = csv->source->foreign ? ceduo_utf8_cut(ceduo_text_string(names), CEDUO_FOREIGN_MOST) : names->length;
    if (shown < names->length) {
        ceduo_text_cut(names, shown);
        ceduo_text_put(names, "\xe2\x80\xa6");
    }
    return n;
}

bool ceduo_csv_next(struct csv *csv)
{
    static const char blanks[] = {' ', '\t', ',', ';'};
    while (next_line(csv)) {
        size_t blank = 0;
        while (blank < csv->line.n && memchr(blanks, csv->line.p[blank], sizeof blanks))
            blank++;
        csv->number++;
        if (blank < csv->line.n)
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
    size_t i = 0;
    while (ceduo_csv_step(csv, &left, field))
        if (i++ == column)
            return true;
    return false;
}

bool ceduo_csv_complain(const struct csv *csv, struct csv_span field, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(csv->problems,
                    (struct problem_place){csv->source, csv->number, (size_t)(field.p - csv->line.p) + 1, NULL, false}, format,
                    args);
    va_end(args);
    return false;
}

bool ceduo_csv_number(struct csv *csv, struct csv_span f, double lo, double hi, const char *unit, double *value)
{
    char room[512];
    bool fits = f.n < sizeof room;
    if (fits) {
        memcpy(room, f.p, f.n);
        room[f.n] = '\0';
    }
    /* where commas do not separate they may stand for the decimals, in all numbers of a file or in none: a dot beside them would
     * be one of thousands */
    char *comma = fits && csv->separator != ',' ? strchr(room, ',') : NULL;
    bool dot = fits && strchr(room, '.');
    bool one_decimal = !(comma && (dot || csv->decimal == '.')) && !(dot && csv->decimal == ',');
    if (one_decimal && comma)
        *comma = '.';
    if (one_decimal && (comma || dot))
        csv->decimal = comma ? ',' : '.';
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
