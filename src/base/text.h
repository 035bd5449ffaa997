/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TEXT_H
#define CEDUO_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A growing string. Starts zeroed; `bytes` is NULL or ends in NUL. If memory runs out, `failed` stays set and nothing more is
 * appended: check it once at the end, or call ceduo_memory_failed(). In the program memory never fails (oom.h). */
struct text {
    char *bytes;
    size_t length, capacity;
    bool failed;
};

void ceduo_text_append_n(struct text *text, const char *bytes, size_t n);
void ceduo_text_append(struct text *text, const char *string);
/* Remove all but the first `length` bytes. */
void ceduo_text_cut(struct text *text, size_t length);
/* Append a string in shell quotes. */
void ceduo_text_append_quoted(struct text *text, const char *string);
void ceduo_text_append_char(struct text *text, char c);
void ceduo_text_format(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* In translations, %'.1f and similar formats print the decimal sign of the language. */
void ceduo_text_vformat(struct text *text, const char *format, va_list args) __attribute__((format(printf, 2, 0)));
/* Append `between`, such as "; ", then the formatted text. */
void ceduo_text_append_joined(struct text *text, const char *between, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void ceduo_text_free(struct text *text);

/* Declare a text that is freed at the end of its block. */
#define LOCAL_TEXT(name) __attribute__((cleanup(ceduo_text_free))) struct text name = {0}

/* Append n words with a separator between them. */
void ceduo_text_join(struct text *text, const char *const *words, size_t n, const char *separator);

/* Return the string; "" if there is none. */
static inline const char *ceduo_text_string(const struct text *text)
{
    return text->bytes ? text->bytes : "";
}

/* Append a string that is safe to print: control characters and invalid UTF-8 become \xHH. */
void ceduo_text_append_escaped(struct text *text, const char *string);
void ceduo_text_append_escaped_n(struct text *text, const char *string, size_t n);

/* Print the shortest decimal that reads back as the same number; "null" if it is not finite. Returns `buffer`. */
#define CEDUO_NUMBER_SIZE 32
char *ceduo_number_shortest(double value, char buffer[CEDUO_NUMBER_SIZE]);
/* As ceduo_number_shortest(), into memory of the enclosing block. */
#define ROUNDTRIP(value) ceduo_number_shortest(value, (char[CEDUO_NUMBER_SIZE]){0})

/* Replace each dot by the decimal sign of the language. Returns `number`. */
char *ceduo_number_localize(char *number);

/* As snprintf(), and strtod() without its second argument, but with a decimal point in every locale. In an Italian or German
 * locale strtod() reads "9.81" as 9. */
int ceduo_decimal_format(char *to, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
double ceduo_decimal_read(const char *string);

enum ceduo_number_reading { CEDUO_NUMBER_GOOD, CEDUO_NUMBER_NONE, CEDUO_NUMBER_TOO_LARGE };

/* Parse a decimal number with a point: 12, -0.5, .5, 1e-3. Not: 1,5 1_000 0x10 010 inf nan, or text after it. */
enum ceduo_number_reading ceduo_number_read(const char *string, double *value);

/* Parse an integer exactly. CEDUO_NUMBER_TOO_LARGE if it is outside lo…hi. */
enum ceduo_number_reading ceduo_count_read(const char *string, double lo, double hi, uint64_t *value);

/* Append a CSV field, in quotes if necessary, after an apostrophe if a spreadsheet would read a formula. */
void ceduo_text_append_csv(struct text *text, const char *value);

/* Return the most similar of n words; NULL if none is similar. */
const char *ceduo_text_nearest(const char *word, const char *const *words, size_t n);

/* Return a score of how well a text matches typed letters; -1 if it does not contain them in their order, in any case. Letters
 * that begin words or are adjacent score more; a text that begins with all of them scores most. */
int ceduo_fuzzy_match(const char *typed, const char *text);

#endif
