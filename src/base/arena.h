/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ARENA_H
#define CEDUO_ARENA_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

/* Memory that is freed all at once. Starts zeroed: `struct arena a = {0}`. */
struct arena_page;
struct arena {
    struct arena_page *page;
    size_t bytes;                 /* allocated so far */
    bool failed;                  /* some call returned NULL */
    const struct source *sources; /* files that were read into it, newest first; see io/file.h */
};

/* Return `size` zeroed bytes, aligned for any type; NULL on failure. */
void *ceduo_arena_take(struct arena *arena, size_t size);

/* Grow a list of n items of `size` bytes to hold `more` additional items. *capacity is its capacity. Returns the list, which
 * may have moved. NULL on failure: the list is unchanged. */
void *ceduo_arena_more(struct arena *arena, void *items, size_t n, size_t more, size_t *capacity, size_t size);

/* Copy n bytes to a string; copy a string. NULL on failure. */
char *ceduo_arena_copy(struct arena *arena, const char *bytes, size_t n);
char *ceduo_arena_string(struct arena *arena, const char *string);

/* Format a string as printf(). NULL on failure. */
char *ceduo_arena_format(struct arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));
char *ceduo_arena_vformat(struct arena *arena, const char *format, va_list args) __attribute__((format(printf, 2, 0)));

void ceduo_arena_free(struct arena *arena);

/* An arena that is freed at the end of its block. */
#define LOCAL_ARENA(name) __attribute__((cleanup(ceduo_arena_free))) struct arena name = {0}

#endif
