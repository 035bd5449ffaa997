/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "text.h"

#include <float.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "language.h"
#include "oom.h"
#include "utf8.h"

static bool reserve(struct text *text, size_t more)
{
    if (text->failed)
        return false;
    if (more < text->capacity - text->length)
        return true;
    size_t capacity = text->capacity ? text->capacity : 64;
    while (capacity < text->length + more + 1)
        capacity *= 2;
    char *bytes = realloc(text->bytes, capacity);
    if (!bytes) {
        ceduo_oom_set_flag();
        text->failed = true;
        return false;
    }
    text->bytes = bytes;
    text->capacity = capacity;
    return true;
}

void ceduo_text_append_n(struct text *text, const char *bytes, size_t n)
{
    if (!reserve(text, n))
        return;
    if (n > 0)
        memcpy(text->bytes + text->length, bytes, n);
    text->length += n;
    text->bytes[text->length] = '\0';
}

void ceduo_text_append(struct text *text, const char *string)
{
    ceduo_text_append_n(text, string, strlen(string));
}

void ceduo_text_cut(struct text *text, size_t length)
{
    text->length = length;
    if (text->bytes)
        text->bytes[length] = '\0';
}

void ceduo_text_append_quoted(struct text *text, const char *string)
{
    ceduo_text_append_char(text, '\'');
    for (const char *c = string; *c; c++)
        ceduo_text_append_n(text, *c == '\'' ? "'\\''" : c, *c == '\'' ? 4 : 1);
    ceduo_text_append_char(text, '\'');
}

void ceduo_text_append_char(struct text *text, char c)
{
    ceduo_text_append_n(text, &c, 1);
}

/* ---- numbers with a dot ---- */

static locale_t dot_locale; /* of the process; never freed */
static pthread_once_t dotted_once = PTHREAD_ONCE_INIT;

/* Cannot fail: glibc returns a constant for "C". */
static void create_dot_locale(void)
{
    dot_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

static locale_t get_dot_locale(void)
{
    pthread_once(&dotted_once, create_dot_locale);
    return dot_locale;
}

/* As vsnprintf(), with a decimal point in every locale. Allocates no memory. */
static __attribute__((format(printf, 3, 0))) int format_with_dot(char *to, size_t size, const char *format, va_list args)
{
    locale_t before = uselocale(get_dot_locale());
    int n = vsnprintf(to, size, format, args);
    uselocale(before);
    return n;
}

int ceduo_decimal_format(char *to, size_t size, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = format_with_dot(to, size, format, args);
    va_end(args);
    return n;
}

double ceduo_decimal_read(const char *string)
{
    return strtod_l(string, NULL, get_dot_locale());
}

char *ceduo_number_localize(char *number)
{
    for (char *dot = number; (dot = strchr(dot, '.'));)
        *dot++ = P_("decimal", ".")[0];
    return number;
}

__attribute__((format(printf, 2, 0))) static void format_plain(struct text *text, const char *format, va_list args)
{
    va_list args_copy;
    va_copy(args_copy, args);
    int n = format_with_dot(NULL, 0, format, args);
    if (n >= 0 && reserve(text, (size_t)n)) { /* untaken: system */
        format_with_dot(text->bytes + text->length, (size_t)n + 1, format, args_copy);
        text->length += (size_t)n;
    }
    va_end(args_copy);
}

/* Return the length of a format like %'.1f without the %, or 0 if there is none. Only in translations: ISO C has no such
 * flag. */
static size_t localized_length(const char *format)
{
    size_t n = strncmp(format, "%'", 2) == 0 ? 2 + strspn(format + 2, "-+ #.*0123456789") : 0;
    return n > 0 && memchr("efg", format[n], 3) ? n : 0;
}

/* Print each number of a %' format between two marks, and then replace the dots between marks. */
static void format_localized(struct text *text, const char *format, va_list args)
{
    LOCAL_TEXT(marked);
    LOCAL_TEXT(printed);
    for (const char *c = format; *c; c++) {
        size_t n = localized_length(c);
        if (n > 0) {
            ceduo_text_format(&marked, "\1%%%.*s\2", (int)n - 1, c + 2);
            c += n;
        } else {
            ceduo_text_append_char(&marked, *c);
            if (c[0] == '%' && c[1] == '%')
                ceduo_text_append_char(&marked, *c++);
        }
    }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral" /* the arguments match the original format */
    format_plain(&printed, ceduo_text_string(&marked), args);
#pragma GCC diagnostic pop
    bool number = false;
    for (const char *c = ceduo_text_string(&printed); *c; c++)
        if (*c == '\1' || *c == '\2')
            number = *c == '\1';
        else
            ceduo_text_append_char(text, number && *c == '.' ? P_("decimal", ".")[0] : *c);
}

void ceduo_text_vformat(struct text *text, const char *format, va_list args)
{
    if (strstr(format, "%'"))
        format_localized(text, format, args);
    else
        format_plain(text, format, args);
}

void ceduo_text_format(struct text *text, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(text, format, args);
    va_end(args);
}

void ceduo_text_append_joined(struct text *text, const char *between, const char *format, ...)
{
    va_list args;
    ceduo_text_append(text, between);
    va_start(args, format);
    ceduo_text_vformat(text, format, args);
    va_end(args);
}

void ceduo_text_join(struct text *text, const char *const *words, size_t n, const char *separator)
{
    for (size_t i = 0; i < n; i++)
        ceduo_text_format(text, "%s%s", i > 0 ? separator : "", words[i]);
}

void ceduo_text_free(struct text *text)
{
    free(text->bytes);
    *text = (struct text){0};
}

void ceduo_text_append_escaped_n(struct text *text, const char *string, size_t n)
{
    for (size_t i = 0; i < n;) {
        uint32_t c = 0;
        size_t length = ceduo_utf8_decode(string + i, n - i, &c);
        bool printable = length > 0 && ceduo_utf8_printable(c);
        length += length == 0;
        if (printable)
            ceduo_text_append_n(text, string + i, length);
        for (size_t k = 0; k < length && !printable; k++)
            ceduo_text_format(text, "\\x%02x", (unsigned char)string[i + k]);
        i += length;
    }
}

void ceduo_text_append_escaped(struct text *text, const char *string)
{
    ceduo_text_append_escaped_n(text, string, strlen(string));
}

char *ceduo_number_shortest(double value, char buffer[CEDUO_NUMBER_SIZE])
{
    if (!isfinite(value))
        return strcpy(buffer, "null");
    if (value == 0)
        return strcpy(buffer, "0"); /* also for -0 */
    /* Begin with 15 digits: %g drops trailing zeros. Subnormal numbers begin with 1. 17 digits always suffice. */
    int digits = fabs(value) < DBL_MIN ? 1 : 15;
    while (ceduo_decimal_format(buffer, CEDUO_NUMBER_SIZE, "%.*g", digits, value), ceduo_decimal_read(buffer) != value)
        digits++;
    return buffer;
}

#define DIGITS "0123456789"

enum ceduo_number_reading ceduo_number_read(const char *string, double *value)
{
    const char *p = string + (*string == '-' || *string == '+');
    size_t digits = strspn(p, DIGITS), more;
    if (digits > 1 && *p == '0')
        return CEDUO_NUMBER_NONE;
    p += digits;
    if (*p == '.') {
        more = strspn(++p, DIGITS);
        digits += more;
        p += more;
    }
    if (digits > 0 && (*p == 'e' || *p == 'E')) {
        p += p[1] == '-' || p[1] == '+' ? 2 : 1;
        more = strspn(p, DIGITS);
        digits = more; /* of the exponent: at least one is required */
        p += more;
    }
    if (digits == 0 || *p)
        return CEDUO_NUMBER_NONE;
    *value = ceduo_decimal_read(string);
    return isfinite(*value) ? CEDUO_NUMBER_GOOD : CEDUO_NUMBER_TOO_LARGE;
}

enum ceduo_number_reading ceduo_count_read(const char *string, double lo, double hi, uint64_t *value)
{
    double number;
    enum ceduo_number_reading reading = ceduo_number_read(string, &number);
    if (reading != CEDUO_NUMBER_GOOD)
        return reading;
    if (number != floor(number))
        return CEDUO_NUMBER_NONE;
    if (number < lo || number > hi)
        return CEDUO_NUMBER_TOO_LARGE;
    *value = (uint64_t)number;
    if (string[strspn(string, DIGITS)] == '\0') { /* more digits than a double can hold */
        *value = strtoull(string, NULL, 10);
        if (*value > (uint64_t)hi)
            return CEDUO_NUMBER_TOO_LARGE;
    }
    return CEDUO_NUMBER_GOOD;
}

void ceduo_text_append_csv(struct text *text, const char *value)
{
    LOCAL_TEXT(safe);
    double number;
    bool negative = *value == '-' && value[1] && ceduo_number_read(value, &number) == CEDUO_NUMBER_NONE;
    bool formula = *value && (strchr("=+@\t", *value) || negative);
    ceduo_text_append(&safe, formula ? "'" : ""); /* an apostrophe prevents a spreadsheet from computing it */
    ceduo_text_append_escaped(&safe, value);
    const char *bytes = ceduo_text_string(&safe);
    if (!strpbrk(bytes, ",\"")) {
        ceduo_text_append(text, bytes);
    } else {
        ceduo_text_append_char(text, '"');
        for (; *bytes; bytes++)
            ceduo_text_append_n(text, *bytes == '"' ? "\"\"" : bytes, *bytes == '"' ? 2 : 1);
        ceduo_text_append_char(text, '"');
    }
    text->failed |= safe.failed; /* NOLINT(clang-analyzer-unix.Malloc): false positive: `safe` is freed here */
}

/* Levenshtein distance of short words. */
static size_t distance(const char *a, const char *b)
{
    size_t row[64], n = strlen(b);
    if (n >= 64 || strlen(a) >= 64)
        return 64;
    for (size_t j = 0; j <= n; j++)
        row[j] = j;
    for (size_t i = 1; a[i - 1]; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= n; j++) {
            size_t change = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            size_t add = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            row[j] = change < add ? change : add;
        }
    }
    return row[n];
}

const char *ceduo_text_nearest(const char *word, const char *const *words, size_t n)
{
    const char *best = NULL;
    size_t length = strlen(word), min = length < 3 ? length : length / 2 + 2; /* at least one letter must be equal */
    for (size_t i = 0; i < n; i++) {
        size_t d = distance(word, words[i]);
        bool longer = length > 0 && strncmp(words[i], word, length) == 0; /* dbh for dbh_m */
        if (d < min || (longer && !best)) {
            min = d < min ? d : min;
            best = words[i];
        }
    }
    return best;
}

#define LETTERS_MAX 64

enum { MATCH = 1, ADJACENT = 9, WORD_START = 8, TEXT_START = 4 };

/* Dynamic programming over the bytes of the text. best[k] is the highest score of the first k letters so far; ending[k] is the
 * highest score with letter k at the previous byte. */
int ceduo_fuzzy_match(const char *typed, const char *text)
{
    int best[LETTERS_MAX + 1], ending[LETTERS_MAX + 1];
    size_t n = strlen(typed);
    n = n < LETTERS_MAX ? n : LETTERS_MAX;
    for (size_t k = 0; k <= n; k++)
        best[k] = ending[k] = k == 0 ? 0 : -1;
    for (size_t i = 0; text[i]; i++) {
        for (size_t k = n; k > 0; k--) {
            bool same = strncasecmp(text + i, typed + k - 1, 1) == 0;
            int gain = MATCH + (i == 0 || strchr(" -_/.(,", text[i - 1]) ? WORD_START : 0) + (i == 0 ? TEXT_START : 0),
                best_here = -1;
            if (same && best[k - 1] >= 0)
                best_here = best[k - 1] + gain;
            if (same && k > 1 && ending[k - 1] >= 0 && ending[k - 1] + ADJACENT + gain > best_here)
                best_here = ending[k - 1] + ADJACENT + gain;
            ending[k] = best_here;
            best[k] = best_here > best[k] ? best_here : best[k];
        }
        ending[0] = -1;
    }
    return best[n];
}
