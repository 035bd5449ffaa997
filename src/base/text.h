/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_TEXT_H
#define CEDUO_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A string that grows. Starts zeroed; `bytes` is NULL or ends in NUL. Once memory fails, `failed` stays set and nothing
 * more is added: who makes it checks it once at the end, or asks ceduo_memory_lost(). In the program it never fails (must.h). */
struct text {
    char *bytes;
    size_t length, room;
    bool failed;
};

void ceduo_text_add(struct text *text, const char *bytes, size_t n);
void ceduo_text_put(struct text *text, const char *string);
/* Takes off what follows the first `length` bytes. */
void ceduo_text_cut(struct text *text, size_t length);
/* In quotes, as a shell reads it. */
void ceduo_text_quoted(struct text *text, const char *string);
void ceduo_text_char(struct text *text, char c);
void ceduo_text_format(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* With %'g, as translations write it for people (%'.1f, %'.3g): the decimal sign of the language. */
void ceduo_text_vformat(struct text *text, const char *format, va_list args) __attribute__((format(printf, 2, 0)));
/* A clause or sentence after what comes between it and the one before: "; ", ", " or " ". */
void ceduo_text_then(struct text *text, const char *between, const char *format, ...) __attribute__((format(printf, 3, 4)));
void ceduo_text_free(struct text *text);

/* A text that is freed where its block ends. */
#define LOCAL_TEXT(name) __attribute__((cleanup(ceduo_text_free))) struct text name = {0}

/* The words with a separator between them. */
void ceduo_text_words(struct text *text, const char *const *words, size_t n, const char *separator);

/* Its string, "" if it has none. */
static inline const char *ceduo_text_string(const struct text *text)
{
    return text->bytes ? text->bytes : "";
}

/* A string that is safe to print: control characters and bytes that are no UTF-8 are written as \xHH. */
void ceduo_text_safe(struct text *text, const char *string);
void ceduo_text_safe_n(struct text *text, const char *string, size_t n);

/* The shortest decimal that reads back as the same number; "null" where it is not finite. */
#define CEDUO_NUMBER_ROOM 32
char *ceduo_number_shortest(double value, char room[CEDUO_NUMBER_ROOM]);
/* The same in the memory of a block. */
#define NUMERAL(value) ceduo_number_shortest(value, (char[CEDUO_NUMBER_ROOM]){0})

/* Numbers as people of the language read them: with its decimal sign in place of each dot. */
char *ceduo_number_spoken(char *number);

/* As snprintf(), vsnprintf() and strtod() without its second argument, but with a dot in whatever locale the host program has set: in
 * Italian or German strtod() reads "9.81" as 9. */
int ceduo_decimal_vformat(char *to, size_t size, const char *format, va_list args) __attribute__((format(printf, 3, 0)));
int ceduo_decimal_format(char *to, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
double ceduo_decimal_read(const char *string);

enum ceduo_number_reading { CEDUO_NUMBER_GOOD, CEDUO_NUMBER_NONE, CEDUO_NUMBER_TOO_LARGE };

/* Reads a decimal number with a dot: 12, -0.5, .5, 1e-3. Not: 1,5 1_000 0x10 010 inf nan, or anything after it. */
enum ceduo_number_reading ceduo_number_read(const char *string, double *value);

/* Reads a whole number from lo to hi, exactly: CEDUO_NUMBER_TOO_LARGE where it lies outside. */
enum ceduo_number_reading ceduo_count_read(const char *string, double lo, double hi, uint64_t *value);

/* A field of CSV, in quotes where it needs them; behind an apostrophe where a spreadsheet would read a formula. */
void ceduo_text_csv(struct text *text, const char *value);

/* The nearest of some words, NULL where none is near. */
const char *ceduo_text_nearest(const char *word, const char *const *words, size_t n);

/* How well a text matches what was typed: the letters typed must stand in it in their order, in whatever case. -1:
 * they do not. Better where words begin with them and where they stand together; best where the text begins with all
 * of them. */
int ceduo_fuzzy_match(const char *typed, const char *text);

#endif
