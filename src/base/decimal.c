/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "decimal.h"

#include <locale.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

static locale_t dotted; /* of the process; never freed */
static pthread_once_t once = PTHREAD_ONCE_INIT;

/* glibc returns a constant for "C": this cannot fail. */
static void make_dotted(void)
{
    dotted = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

static locale_t dotted_locale(void)
{
    pthread_once(&once, make_dotted);
    return dotted;
}

int ceduo_decimal_vformat(char *room, size_t size, const char *format, va_list args)
{
    locale_t before = uselocale(dotted_locale());
    int n = vsnprintf(room, size, format, args);
    uselocale(before);
    return n;
}

int ceduo_decimal_format(char *room, size_t size, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int n = ceduo_decimal_vformat(room, size, format, args);
    va_end(args);
    return n;
}

double ceduo_decimal_read(const char *string)
{
    return strtod_l(string, NULL, dotted_locale());
}
