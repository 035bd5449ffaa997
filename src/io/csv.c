/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records, heads and rows of a table. */
#include "csv.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "base/utf8.h"

#define FOLDED_MAX 128  /* bytes of a head that are compared */
#define HEAD_MAX   500  /* bytes of a known head */
#define TITLE_MAX  20   /* lines that may contain the head */
#define HEADS_MAX  1000 /* heads of a table with known heads */
#define NAMES_MAX  10   /* names in a list of a message */

#define BLANKS " \t"

/* ---- records ---- */

static void trim(struct csv_cell *cell)
{
    const char *end = cell->p + cell->n;
    for (size_t n; (n = ceduo_utf8_blank(cell->p, (size_t)(end - cell->p))) > 0;)
        cell->p += n;
    while (end > cell->p) {
        const char *last = ceduo_utf8_back(cell->p, end);
        if (ceduo_utf8_blank(last, (size_t)(end - last)) == 0)
            break;
        end = last;
    }
    cell->n = (size_t)(end - cell->p);
}

static bool is_end_of_line(const char *p, const char *end)
{
    return p == end || *p == '\n' || (*p == '\r' && p + 1 < end && p[1] == '\n');
}

static bool is_separator(const struct csv *csv, const char *p)
{
    return csv->separator == ' ' ? *p == ' ' || *p == '\t' : *p == csv->separator;
}

static void mark_bad(struct csv *csv, const char *begin, const char *reason)
{
    if (!csv->bad)
        ceduo_csv_error(csv, (struct csv_cell){.begin = begin}, "%s", reason);
    csv->bad = true;
}

/* Read a quoted cell. Return the byte after its closing quote. */
static const char *read_quoted(struct csv *csv, const char *p, const char *end, struct csv_cell *cell)
{
    size_t doubled = 0, lines = 0, inside = 0; /* inside: separators */
    const char *from = p + 1, *to = from;
    while (to < end && !(*to == '"' && !(to + 1 < end && to[1] == '"'))) {
        doubled += *to == '"';
        lines += *to == '\n';
        inside += is_separator(csv, to);
        to += *to == '"' ? 2 : 1;
    }
    *cell = (struct csv_cell){.p = from, .n = (size_t)(to - from), .begin = p, .quoted = true};
    if (to == end)
        mark_bad(csv, p, _("this quote is not closed; close it, or remove it"));
    else if (lines > 0 && csv->heads_count > 1 && inside + 1 >= csv->heads_count) /* a row may be inside */
        mark_bad(csv, p, _("this quoted cell contains a whole row; remove the quote, or the line breaks in the cell"));
    char *copy = doubled > 0 ? ceduo_arena_copy(csv->arena, from, cell->n) : NULL;
    if (copy) {
        size_t n = 0;
        for (size_t i = 0; i < cell->n; i++) {
            copy[n++] = from[i];
            i += from[i] == '"';
        }
        cell->p = copy;
        cell->n = n;
    }
    return to < end ? to + 1 : end;
}

static const char *read_cell(struct csv *csv, const char *p, const char *end, struct csv_cell *cell)
{
    if (p < end && *p == '"') {
        p = read_quoted(csv, p, end, cell);
        for (size_t n; p < end && !is_separator(csv, p) && (n = ceduo_utf8_blank(p, (size_t)(end - p))) > 0;)
            p += n;
        if (!is_end_of_line(p, end) && !is_separator(csv, p))
            mark_bad(csv, p, _("text after a closing quote; double the quotes within a cell"));
    } else {
        *cell = (struct csv_cell){.p = p, .begin = p};
    }
    const char *from = p;
    while (!is_end_of_line(p, end) && !is_separator(csv, p))
        p++;
    if (!cell->quoted)
        cell->n = (size_t)(p - from);
    trim(cell);
    return p;
}

/* Read the record at csv->next. */
static bool read_record(struct csv *csv)
{
    const char *bytes = csv->source->bytes, *end = bytes + csv->source->length, *p = bytes + csv->next.offset;
    bool more = true, blanks = csv->separator == ' ';
    if (csv->next.offset >= csv->source->length)
        return false;
    csv->place = csv->next;
    csv->cells_count = 0;
    csv->bad = false;
    for (p += blanks ? strspn(p, BLANKS) : 0; more;) {
        csv->cells = ceduo_arena_grow(csv->arena, csv->cells, csv->cells_count, 1, &csv->cells_capacity, sizeof *csv->cells);
        if (!csv->cells) {
            csv->cells_count = csv->cells_capacity = 0;
            return false;
        }
        p = read_cell(csv, p, end, &csv->cells[csv->cells_count++]);
        p += blanks ? strspn(p, BLANKS) : 0;
        more = !is_end_of_line(p, end);
        p += more && !blanks;
    }
    p += p < end && *p == '\r';
    p += p < end;
    for (const char *q = bytes + csv->place.offset; q < p; q++)
        csv->next.line += *q == '\n';
    csv->next.offset = (size_t)(p - bytes);
    return true;
}

/* True if a record has only blanks and separators of any kind. */
static bool is_blank_record(const struct csv *csv)
{
    bool blank = true;
    for (size_t i = 0; i < csv->cells_count && blank; i++)
        blank = strspn(csv->cells[i].p, " \t,;|") >= csv->cells[i].n;
    return blank;
}

/* Read the next record that is neither blank nor a comment, whatever its number of cells. */
static bool read_filled(struct csv *csv)
{
    while (read_record(csv)) {
        bool comment = csv->comments && csv->cells[0].n > 0 && strchr("#>", csv->cells[0].p[0]);
        if ((!comment && !is_blank_record(csv)) || csv->bad)
            return true;
    }
    return false;
}

/* ---- heads ---- */

bool ceduo_csv_matches(const char *p, size_t n, const char *words)
{
    char given[FOLDED_MAX], one[FOLDED_MAX];
    ceduo_utf8_fold(p, n, given, sizeof given);
    for (size_t length; *words; words += length, words += *words == '|') {
        length = strcspn(words, "|");
        if (strcmp(ceduo_utf8_fold(words, length, one, sizeof one), given) == 0)
            return true;
    }
    return false;
}

/* False if a head cannot begin with the first letter of a folded name. Saves the folding of most heads. */
static bool can_begin(struct csv_cell head, char letter)
{
    size_t i = 0;
    while (i < head.n && (unsigned char)head.p[i] < 0x80 && !isalnum((unsigned char)head.p[i]) && head.p[i] != '%')
        i++;
    unsigned char first = i < head.n ? (unsigned char)head.p[i] : 0;
    return first >= 0x80 || (unsigned char)letter >= 0x80 || tolower(first) == letter;
}

/* True if a head is a name of n bytes, alone or with a unit. `wanted`: the folded name. */
static bool is_head(struct csv_cell head, const char *name, size_t length, const char *wanted, const char *units)
{
    char given[FOLDED_MAX];
    size_t before = 0;
    if (head.n > HEAD_MAX || !can_begin(head, wanted[0]))
        return false;
    while (before < head.n && head.p[before] != '(' && head.p[before] != '[')
        before++;
    ceduo_utf8_fold(head.p, before, given, sizeof given);
    size_t n = strlen(wanted);
    if (head.n == length && strncasecmp(head.p, name, length) == 0)
        return true;
    if (n == 0 || strncmp(given, wanted, n) != 0)
        return false;
    if (before < head.n && units)
        return !given[n] && ceduo_csv_matches(head.p + before, head.n - before, units);
    return !given[n] || (units && ceduo_csv_matches(given + n, strlen(given + n), units));
}

/* Find the column with a name of n bytes, like ceduo_csv_column(). */
static size_t find_name(const struct csv *csv, const char *name, size_t n, const char *units)
{
    char wanted[FOLDED_MAX];
    size_t found = CEDUO_CSV_NOT_FOUND;
    ceduo_utf8_fold(name, n, wanted, sizeof wanted);
    for (size_t i = 0; i < csv->heads_count; i++)
        if (is_head(csv->heads[i], name, n, wanted, units))
            found = found == CEDUO_CSV_NOT_FOUND ? i : CEDUO_CSV_DUPLICATE;
    return found;
}

size_t ceduo_csv_column(const struct csv *csv, const struct csv_head *head, const char *units)
{
    size_t found = head->name ? find_name(csv, head->name, strlen(head->name), units) : CEDUO_CSV_NOT_FOUND;
    for (const char *also = head->also ? head->also : ""; *also && found == CEDUO_CSV_NOT_FOUND; also += *also == '|') {
        size_t n = strcspn(also, "|");
        found = find_name(csv, also, n, units);
        also += n;
    }
    return found;
}

/* Use the present record as the head. */
static void set_heads(struct csv *csv)
{
    csv->head_place = csv->place;
    csv->heads_count = csv->cells_count;
    csv->heads = ceduo_arena_alloc(csv->arena, (csv->cells_count + 1) * sizeof *csv->heads);
    if (csv->heads)
        memcpy(csv->heads, csv->cells, csv->cells_count * sizeof *csv->heads);
    else
        csv->heads_count = 0;
}

/* Copy the reader. The copy reports nothing and does not change the present record. */
static struct csv try_separator(const struct csv *csv, char separator)
{
    struct csv trial = *csv;
    trial.problems = NULL;
    trial.separator = separator;
    trial.cells = NULL;
    trial.cells_capacity = 0;
    return trial;
}

static size_t count_known(const struct csv *csv, const struct csv_head *heads, size_t n)
{
    size_t known = 0;
    for (size_t i = 0; i < n; i++)
        known += ceduo_csv_column(csv, &heads[i], heads[i].units) != CEDUO_CSV_NOT_FOUND;
    return known;
}

/* Rate a line and a separator as the head by the number of known heads, then by equal length of the next record. 0: not a head.
 * With blanks as separators at least half of the words must be known heads. */
static size_t rate_head(struct csv *trial, struct csv_place line, const struct csv_head *heads, size_t n)
{
    trial->next = line;
    if (!read_record(trial) || trial->cells_count > HEADS_MAX)
        return 0;
    trial->heads = trial->cells;
    trial->heads_count = trial->cells_count;
    size_t known = count_known(trial, heads, n), cells = trial->cells_count;
    if (known == 0 || (trial->separator == ' ' && 2 * known < cells))
        return 0;
    return 2 * known + (read_filled(trial) && trial->cells_count == cells);
}

/* Set the line and the separator with the best rate. */
static void find_head(struct csv *csv, const struct csv_head *heads, size_t n)
{
    const char given[] = {csv->separator, '\0'}, *all = csv->separator ? given : csv->blanks ? ";\t,| " : ";\t,|";
    struct csv trial = try_separator(csv, 0);
    struct csv_place line = csv->next, best_line = csv->next;
    size_t max = 0, from, to;
    char best = csv->separator ? csv->separator : ',';
    for (size_t k = 0; k < TITLE_MAX && line.offset < csv->source->length; k++) {
        const bool comment = csv->comments && csv->source->bytes[line.offset] == '#'; /* may contain the heads */
        const struct csv_place head = {line.offset + comment, line.line};
        for (const char *s = all; *s; s++) {
            trial.separator = *s;
            size_t rate = rate_head(&trial, head, heads, n);
            if (rate > max) {
                max = rate;
                best = *s;
                best_line = head;
            }
        }
        ceduo_source_next(csv->source, &line.offset, &from, &to);
        line.line++;
    }
    csv->next = best_line;
    csv->separator = best;
    csv->cells = trial.cells; /* reuse the grown list */
    csv->cells_capacity = trial.cells_capacity;
}

/* Units in a row below the head. */
#define UNITS                                                                                                                  \
    "m|m2|m\xc2\xb2|mq|cm|mm|km|ft|in|m/s|m s-1|km/h|j|kj|\xc2\xb0|deg|degrees|gradi|grad|%|n|nr|cod|m slm|m asl|m \xc3\xbcm"

/* Append the units of a row below the head to the heads. */
static void append_units(struct csv *csv)
{
    struct csv row = try_separator(csv, csv->separator);
    size_t found = 0;
    bool units = read_record(&row) && !is_blank_record(&row) && row.cells_count <= csv->heads_count;
    for (size_t i = 0; units && i < row.cells_count; i++) {
        bool none = ceduo_csv_is_empty(row.cells[i]);
        units = none || ceduo_csv_matches(row.cells[i].p, row.cells[i].n, UNITS);
        found += !none;
    }
    if (!units || found == 0)
        return;
    csv->next = row.next;
    for (size_t i = 0; i < row.cells_count; i++) {
        struct csv_cell *head = &csv->heads[i], unit = row.cells[i];
        if (ceduo_csv_is_empty(unit))
            continue;
        bool bare = unit.p[0] != '(' && unit.p[0] != '[';
        const char *whole = ceduo_arena_format(csv->arena, "%.*s %s%.*s%s", (int)head->n, head->p, bare ? "(" : "", (int)unit.n,
                                               unit.p, bare ? ")" : "");
        if (whole) /* untaken: memory */
            *head = (struct csv_cell){.p = whole, .n = strlen(whole), .begin = head->begin, .quoted = head->quoted};
    }
}

void ceduo_csv_find_head(struct csv *csv, const struct csv_head *heads, size_t n, size_t *columns)
{
    find_head(csv, heads, n);
    if (read_record(csv))
        set_heads(csv);
    append_units(csv);
    for (size_t i = 0; i < n; i++) {
        columns[i] = ceduo_csv_column(csv, &heads[i], heads[i].units);
        csv->source->foreign &= columns[i] == CEDUO_CSV_NOT_FOUND;
    }
    for (size_t i = 0; i < n; i++)
        if (columns[i] == CEDUO_CSV_DUPLICATE)
            ceduo_problem(csv->problems, csv->source, csv->head_place.line, 1, _("the column '%s' occurs twice; rename one"),
                          _(heads[i].name));
}

bool ceduo_csv_read_head(struct csv *csv)
{
    size_t max = 1;
    char best = csv->separator ? csv->separator : ',';
    for (const char *s = csv->separator ? "" : ";\t|,"; *s; s++) { /* the most cells win, then the first */
        struct csv trial = try_separator(csv, *s);
        if (read_filled(&trial) && !trial.bad && trial.cells_count > max) {
            max = trial.cells_count;
            best = *s;
        }
    }
    csv->separator = best;
    if (!read_filled(csv))
        return ceduo_problem(csv->problems, csv->source, 0, 0, _("the file is empty"));
    set_heads(csv);
    return !csv->bad && csv->heads;
}

void ceduo_csv_begin_headless(struct csv *csv, char separator)
{
    struct csv_place begin = csv->next;
    csv->separator = separator;
    csv->headless = true;
    if (!read_filled(csv))
        return;
    csv->heads = ceduo_arena_alloc(csv->arena, (csv->cells_count + 1) * sizeof *csv->heads);
    csv->heads_count = csv->heads ? csv->cells_count : 0; /* untaken: memory */
    csv->head_place = csv->place;
    csv->next = begin;
}

void ceduo_csv_append_heads(const struct csv *csv, struct text *names)
{
    size_t begin = names->length;
    for (size_t i = 0; i < csv->heads_count; i++) {
        ceduo_text_append(names, i > 0 ? ", " : "");
        ceduo_text_append_escaped_n(names, csv->heads[i].p, csv->heads[i].n);
    }
    if (!csv->source->foreign)
        return;
    size_t shown = begin + ceduo_utf8_cut(ceduo_text_string(names) + begin, CEDUO_FOREIGN_MAX);
    if (shown < names->length) {
        ceduo_text_cut(names, shown);
        ceduo_text_append(names, "\xe2\x80\xa6");
    }
}

void ceduo_csv_append_name(struct text *names, size_t *n, const char *name, size_t length)
{
    if (++*n > NAMES_MAX)
        return;
    ceduo_text_append(names, *n > 1 ? ", " : "");
    ceduo_text_append_escaped_n(names, name, length);
}

void ceduo_csv_append_rest(struct text *names, size_t n)
{
    if (n > NAMES_MAX)
        ceduo_text_format(names, _(" and %zu more"), n - NAMES_MAX);
}

void ceduo_csv_describe(const struct csv *csv, const size_t *used, size_t n, const char *notes, struct text *line)
{
    LOCAL_TEXT(names);
    size_t unused = 0;
    for (size_t i = 0; i < csv->heads_count; i++) {
        bool needed = csv->heads[i].n == 0;
        for (size_t k = 0; k < n; k++)
            needed |= used[k] == i;
        if (!needed)
            ceduo_csv_append_name(&names, &unused, csv->heads[i].p, csv->heads[i].n);
    }
    ceduo_csv_append_rest(&names, unused);
    if (csv->decimal == ',')
        ceduo_text_append(line, _("; decimal commas"));
    ceduo_text_append(line, notes);
    if (unused > 0)
        ceduo_text_format(line, _("; not used: %s"), ceduo_text_string(&names));
}

/* ---- rows ---- */

void ceduo_csv_scan(struct csv *csv)
{
    struct csv_place begin = csv->next;
    struct problems *problems = csv->problems;
    size_t filled = csv->heads_count, max = 0, head_width = csv->heads_count;
    while (filled > 0 && !csv->headless && csv->heads[filled - 1].n == 0)
        filled--;
    csv->problems = NULL;
    csv->rows = 0;
    while (read_filled(csv)) {
        csv->rows++;
        max = csv->cells_count > max ? csv->cells_count : max;
        ceduo_csv_note_decimal(csv);
    }
    csv->width = max > filled ? head_width : filled;
    csv->longer = csv->longer_by_one = 0;
    csv->next = begin;
    while (max > csv->width && read_filled(csv)) {
        csv->longer += csv->cells_count > csv->width;
        csv->longer_by_one += csv->cells_count == csv->width + 1;
    }
    csv->next = begin;
    csv->problems = problems;
}

/* True if an empty cell beyond the head may result from a doubled cell or a removed head: one record, or each, has one cell
 * more. */
static bool is_uncertain(const struct csv *csv)
{
    bool one = csv->cells_count == csv->width + 1 && csv->longer_by_one == csv->longer;
    return one && (csv->longer == 1 || csv->longer == csv->rows);
}

/* Mark a record bad if its number of cells is wrong. Empty cells beyond the head are ignored unless they are uncertain. */
static void check_width(struct csv *csv)
{
    const size_t n = csv->cells_count, width = csv->width;
    size_t filled = n;
    while (filled > 0 && csv->cells[filled - 1].n == 0)
        filled--;
    bool ignored = n > width && filled <= width && csv->separator != ' ' && !is_uncertain(csv);
    if (csv->bad || n == width || ignored)
        return;
    csv->bad = true;
    struct csv_cell cell = csv->cells[n > width ? width : n - 1];
    if (n < width)
        ceduo_csv_error(csv, cell, _("too few columns: %zu, the head has %zu"), n, width);
    else if (csv->separator == ',')
        ceduo_csv_error(csv, cell,
                        _("more columns than the first line has: %zu instead of %zu; if commas stand for decimals, separate "
                          "the columns by semicolons"),
                        n, width);
    else
        ceduo_csv_error(csv, cell, _("more columns than the first line has: %zu instead of %zu"), n, width);
}

bool ceduo_csv_next_row(struct csv *csv)
{
    if (!read_filled(csv))
        return false;
    check_width(csv);
    return true;
}

void ceduo_csv_reread(struct csv *csv, struct csv_place place)
{
    csv->next = place;
    read_record(csv);
}

/* ---- cells ---- */

struct csv_cell ceduo_csv_next_cell(const struct csv *csv, size_t column)
{
    if (column < csv->cells_count)
        return csv->cells[column];
    const char *row = csv->source->bytes + csv->place.offset;
    /* untaken: memory */
    return (struct csv_cell){.p = "", .begin = csv->cells_count > 0 ? csv->cells[csv->cells_count - 1].begin : row};
}

bool ceduo_csv_equals(struct csv_cell cell, const char *word)
{
    return strlen(word) == cell.n && strncasecmp(cell.p, word, cell.n) == 0;
}

int ceduo_csv_compare(struct csv_cell a, struct csv_cell b)
{
    if (a.n != b.n)
        return a.n < b.n ? -1 : 1;
    return memcmp(a.p, b.p, a.n);
}

bool ceduo_csv_is_empty(struct csv_cell cell)
{
    static const char *const words[] = {
        "",   "-",  ".",    "NA",   "N/A", "NaN",          "NULL",         "n.d.",        "n.r.",
        "nd", "nr", "#N/A", "#N/D", "#NV", "\xe2\x80\x93", "\xe2\x80\x94", "\xe2\x88\x92"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (ceduo_csv_equals(cell, words[i]))
            return true;
    return false;
}

bool ceduo_csv_has_stray_quote(struct csv_cell cell)
{
    return !cell.quoted && cell.n > 0 && memchr(cell.p, '"', cell.n);
}

size_t ceduo_csv_line(const struct csv *csv, struct csv_cell cell)
{
    const char *bytes = csv->source->bytes;
    struct csv_place from = cell.begin < bytes + csv->place.offset ? csv->head_place : csv->place;
    for (const char *p = bytes + from.offset; p < cell.begin; p++)
        from.line += *p == '\n';
    return from.line;
}

bool ceduo_csv_error(const struct csv *csv, struct csv_cell cell, const char *format, ...)
{
    if (!csv->problems)
        return false;
    va_list args;
    size_t column = 1;
    const char *begin = csv->source->bytes + ceduo_source_mark(csv->source);
    for (const char *p = cell.begin; p > begin && p[-1] != '\n'; p--)
        column += !ceduo_utf8_is_continuation(p[-1]);
    va_start(args, format);
    ceduo_problem_v(csv->problems,
                    (struct problem_place){.source = csv->source, .line = ceduo_csv_line(csv, cell), .column = column}, format,
                    args);
    va_end(args);
    return false;
}
