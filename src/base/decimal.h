/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers with a dot, in whatever locale the host program has set. printf() and strtod() of the C library follow LC_NUMERIC: in
 * Italian or German strtod() reads "9.81" as 9. Each function switches the locale of its thread and switches it back. None
 * allocates memory. */
#ifndef CEDUO_DECIMAL_H
#define CEDUO_DECIMAL_H

#include <stdarg.h>
#include <stddef.h>

/* As vsnprintf(). */
int ceduo_decimal_vformat(char *room, size_t size, const char *format, va_list args) __attribute__((format(printf, 3, 0)));
/* As snprintf(). */
int ceduo_decimal_format(char *room, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* As strtod() without its second argument. */
double ceduo_decimal_read(const char *string);

#endif
