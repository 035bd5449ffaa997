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
    size_t bytes;                 /* asked for so far */
    bool failed;                  /* some call returned NULL */
    const struct source *sources; /* files that were read into it, the last first: see io/file.h */
};

/* Return `size` zeroed bytes, aligned for any type; NULL on failure. */
void *ceduo_arena_alloc(struct arena *arena, size_t size);

/* Grow a list of n items of `size` bytes so that it holds `more` items more; `*room` is the number that it holds. Returns the list,
 * which may have moved. NULL on failure: the list stays as it was. */
void *ceduo_arena_grow(struct arena *arena, void *items, size_t n, size_t more, size_t *room, size_t size);

/* Copy n bytes to a string; copy a string. NULL on failure. */
char *ceduo_arena_copy(struct arena *arena, const char *bytes, size_t n);
char *ceduo_arena_string(struct arena *arena, const char *string);

/* Make a string as printf() does. NULL on failure. */
char *ceduo_arena_format(struct arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));
char *ceduo_arena_vformat(struct arena *arena, const char *format, va_list args) __attribute__((format(printf, 2, 0)));

void ceduo_arena_free(struct arena *arena);

/* An arena that is freed at the end of its block. */
#define LOCAL_ARENA(name) __attribute__((cleanup(ceduo_arena_free))) struct arena name = {0}

#endif
