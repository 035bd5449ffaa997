/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a table: decimal comma or dot, thousands separators, units. A table has one decimal sign. */
#include <stdio.h>
#include <string.h>
#include <unictype.h>

#include "base/language.h"
#include "base/utf8.h"
#include "csv.h"

/* Meaning of the dots and commas of a number. */
enum signs {
    SIGNS_NONE,          /* digits only */
    SIGNS_DECIMAL,       /* one decimal sign */
    SIGNS_TWO_WAYS,      /* one sign between one to three digits and three: decimals or thousands */
    SIGNS_GROUPS,        /* several equal signs: thousands */
    SIGNS_GROUPS_DECIMAL /* thousands, then decimals */
};

struct numeral {
    char text[CSV_NUMERAL_CAPACITY]; /* without blanks and apostrophes */
    enum signs signs;
    char sign; /* the only sign, or the last */
};

/* Return the bytes of a thousands separator that is neither a dot nor a comma; 0: none. Requires p < end. */
static size_t measure_spacer(const char *p, const char *end)
{
    if (*p == '\'')
        return 1;
    if (end - p >= 3 && memcmp(p, "\xe2\x80\x99", 3) == 0) /* U+2019 */
        return 3;
    return *p == '\t' ? 0 : ceduo_utf8_blank(p, (size_t)(end - p));
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* True if groups of digits between `sign` are 1 to 3, 3, 3, … long up to `end`, which is no digit. */
static bool are_groups(const char *p, const char *end, char sign)
{
    size_t n = strspn(p, "0123456789");
    bool good = n >= 1 && n <= 3 && p[0] != '0';
    for (p += n; good && p < end; p += 4)
        good = *p == sign && strspn(p + 1, "0123456789") == 3;
    return good;
}

static void read_signs(struct numeral *numeral)
{
    const char *p = numeral->text + (numeral->text[0] == '-' || numeral->text[0] == '+');
    const char *end = p + strcspn(p, "eE"), *last = NULL;
    size_t dots = 0, commas = 0;
    for (const char *q = p; q < end; q++) {
        dots += *q == '.';
        commas += *q == ',';
        last = *q == '.' || *q == ',' ? q : last;
    }
    numeral->signs = SIGNS_NONE;
    if (!last)
        return;
    numeral->sign = *last;
    char other_sign = *last == '.' ? ',' : '.';
    size_t same = *last == '.' ? dots : commas, others_count = dots + commas - same;
    if (others_count > 0)
        numeral->signs = same == 1 && are_groups(p, last, other_sign) ? SIGNS_GROUPS_DECIMAL : SIGNS_DECIMAL;
    else if (same > 1)
        numeral->signs = are_groups(p, end, *last) ? SIGNS_GROUPS : SIGNS_DECIMAL;
    else
        numeral->signs = are_groups(p, end, *last) && !*end ? SIGNS_TWO_WAYS : SIGNS_DECIMAL;
}

/* Split a cell into sign, digits, decimal signs and thousands separators. */
static enum csv_numeral split_number(struct csv_cell cell, struct numeral *numeral)
{
    const char *p = cell.p, *end = p + cell.n;
    size_t n = 0, group = 0; /* digits since the last spacer */
    bool spaced = false, mantissa = true, wrong_group = false;
    if (end - p >= 3 && memcmp(p, "\xe2\x88\x92", 3) == 0) { /* U+2212 */
        numeral->text[n++] = '-';
        p += 3;
    }
    for (; p < end; p++) {
        size_t gap = n > 0 && is_digit(numeral->text[n - 1]) && mantissa ? measure_spacer(p, end) : 0;
        if (gap > 0 && p + gap < end && is_digit(p[gap])) {
            wrong_group |= spaced ? group != 3 : group > 3;
            spaced = true;
            group = 0;
            p += gap - 1;
            continue;
        }
        if (!strchr("+-.,eE0123456789", *p) || n + 1 >= sizeof numeral->text)
            return CSV_NUMERAL_NONE;
        if (spaced && mantissa && !is_digit(*p) && group != 3)
            wrong_group = true;
        mantissa &= is_digit(*p) || n == 0;
        group += is_digit(*p);
        numeral->text[n++] = *p;
    }
    numeral->text[n] = '\0';
    if (spaced && mantissa && group != 3)
        wrong_group = true;
    if (wrong_group)
        return CSV_NUMERAL_TWO_NUMBERS;
    read_signs(numeral);
    return n > 0 ? CSV_NUMERAL_GOOD : CSV_NUMERAL_NONE;
}

/* Return the decimal sign of a number; '\0': undecided. */
static char get_decimal(const struct numeral *numeral)
{
    switch (numeral->signs) { /* untaken: table */
    case SIGNS_DECIMAL:
    case SIGNS_GROUPS_DECIMAL:
        return numeral->sign;
    case SIGNS_GROUPS:
        return numeral->sign == '.' ? ',' : '.';
    case SIGNS_NONE:
    case SIGNS_TWO_WAYS:
        break;
    }
    return '\0';
}

enum csv_numeral ceduo_csv_normalize_number(const struct csv *csv, struct csv_cell cell, char to[CSV_NUMERAL_CAPACITY])
{
    struct numeral numeral;
    double value;
    enum csv_numeral good = split_number(cell, &numeral);
    if (good != CSV_NUMERAL_GOOD)
        return good;
    char shown = get_decimal(&numeral), decimal = csv->decimal;
    if (shown && decimal && shown != decimal)
        return CSV_NUMERAL_OTHER_SIGN;
    decimal = decimal ? decimal : shown;
    bool usual =
        (numeral.sign == ',') == (csv->separator == ';'); /* decimal comma with semicolons, dot with other separators */
    if (numeral.signs == SIGNS_TWO_WAYS && !decimal && usual)
        decimal = numeral.sign;
    if (numeral.signs == SIGNS_TWO_WAYS && (!decimal || (numeral.sign != decimal && !csv->grouped)))
        return CSV_NUMERAL_TWO_WAYS;
    size_t n = 0;
    for (const char *p = numeral.text; *p; p++)
        if (*p != '.' && *p != ',')
            to[n++] = *p;
        else if (*p == decimal)
            to[n++] = '.';
    to[n] = '\0';
    return ceduo_number_read(to, &value) == CEDUO_NUMBER_NONE ? CSV_NUMERAL_NONE : CSV_NUMERAL_GOOD;
}

bool ceduo_csv_split_unit(struct csv_cell *cell, const char *units)
{
    size_t n = cell->n;
    for (int k = 0; k < 2 && units; k++) { /* cm, then m2, which ends in a digit */
        while (n > 0 && !is_digit(cell->p[n - 1]))
            n--;
        if (n > 0 && n < cell->n && ceduo_csv_matches(cell->p + n, cell->n - n, units)) {
            cell->n = n;
            return true;
        }
        while (n > 0 && is_digit(cell->p[n - 1]))
            n--;
    }
    return false;
}

/* Find the first invisible character, or control of writing direction, in a cell, which is valid UTF-8. 0: none. */
static uint32_t find_hidden(struct csv_cell cell)
{
    uint32_t code;
    for (size_t i = 0, n; i < cell.n; i += n) {
        n = ceduo_utf8_decode(cell.p + i, cell.n - i, &code);
        if (ceduo_utf8_is_space(code) || uc_is_general_category_withtable(code, UC_CATEGORY_MASK_C))
            return code;
    }
    return 0;
}

bool ceduo_csv_report_number(const struct csv *csv, struct csv_cell cell, enum csv_numeral reason)
{
    struct numeral n;
    char word[CSV_NUMERAL_CAPACITY];
    uint32_t hidden = find_hidden(cell);
    bool fits = cell.n < sizeof word;
    snprintf(word, sizeof word, "%.*s", fits ? (int)cell.n : 0, cell.p);
    if (!fits)
        ceduo_csv_error(csv, cell, _("'%s' is not a number"), "\xe2\x80\xa6");
    else if (hidden && reason != CSV_NUMERAL_OTHER_SIGN)
        ceduo_csv_error(csv, cell, _("the number contains the invisible character U+%04X; remove it"), (unsigned)hidden);
    else if (reason == CSV_NUMERAL_TWO_WAYS) {
        split_number(cell, &n);
        ceduo_csv_error(csv, cell, _("'%s' can be read in two ways: write '%.*s%s' or '%.*s%c%s'"), word,
                        (int)strcspn(n.text, ".,"), n.text, strpbrk(n.text, ".,") + 1, (int)strcspn(n.text, ".,"), n.text,
                        csv->decimal    ? csv->decimal
                        : n.sign == '.' ? ','
                                        : '.',
                        strpbrk(n.text, ".,") + 1);
    } else if (reason == CSV_NUMERAL_TWO_NUMBERS)
        ceduo_csv_error(csv, cell, _("'%s': two numbers in one cell; keep one"), word);
    else if (reason == CSV_NUMERAL_OTHER_SIGN)
        ceduo_csv_error(csv, cell, _("the decimal sign of '%s' is not the %s of line %zu; use one sign in the whole table"),
                        word, csv->decimal == ',' ? _("comma") : _("dot"), csv->decimal_line);
    else
        ceduo_csv_error(csv, cell, _("'%s' is not a number"), word);
    return false;
}

bool ceduo_csv_value(const struct csv *csv, struct csv_cell cell, double *value)
{
    char text[CSV_NUMERAL_CAPACITY];
    return ceduo_csv_normalize_number(csv, cell, text) == CSV_NUMERAL_GOOD &&
           ceduo_number_read(text, value) == CEDUO_NUMBER_GOOD;
}

bool ceduo_csv_number(const struct csv *csv, struct csv_cell cell, double lo, double hi, const char *unit, double *value)
{
    char text[CSV_NUMERAL_CAPACITY];
    if (cell.n == 0)
        return ceduo_csv_error(csv, cell, _("a value is missing; remove the line"));
    struct csv_cell bare = cell;
    ceduo_csv_split_unit(&bare, unit);
    enum csv_numeral numeral = ceduo_csv_normalize_number(csv, bare, text);
    if (numeral != CSV_NUMERAL_GOOD)
        return ceduo_csv_report_number(csv, numeral == CSV_NUMERAL_TWO_WAYS ? bare : cell, numeral);
    bool large = ceduo_number_read(text, value) == CEDUO_NUMBER_TOO_LARGE;
    if (!large && *value >= lo && *value <= hi)
        return true;
    return ceduo_csv_error(csv, cell, _("%s is outside the range %g to %g %s"), text, lo, hi, unit);
}

void ceduo_csv_note_decimal(struct csv *csv)
{
    for (size_t i = 0; i < csv->cells_count && i < csv->heads_count; i++) {
        struct numeral numeral;
        if (!csv->heads[i].numeric || split_number(csv->cells[i], &numeral) != CSV_NUMERAL_GOOD)
            continue;
        char shown = get_decimal(&numeral);
        csv->grouped |= numeral.signs >= SIGNS_GROUPS;
        if (shown && !csv->decimal) {
            csv->decimal = shown;
            csv->decimal_line = ceduo_csv_line(csv, csv->cells[i]);
        }
    }
}
