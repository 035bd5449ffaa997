/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "arena.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "oom.h"
#include "text.h"

#define PAGE ((size_t)16 * 1024)

struct arena_page {
    struct arena_page *prev;
    size_t size, used;
    max_align_t bytes[];
};

void *ceduo_arena_alloc(struct arena *arena, size_t size)
{
    size_t align = alignof(max_align_t);
    bool out_of_memory = size > SIZE_MAX / 2;
    size = out_of_memory ? size : (size + align - 1) / align * align;
    if (!out_of_memory && (!arena->page || arena->page->size - arena->page->used < size)) {
        size_t capacity = size > PAGE ? size : PAGE;
        struct arena_page *page = calloc(1, sizeof *page + capacity);
        if (page) {
            page->size = capacity;
            page->prev = arena->page;
            arena->page = page;
        }
        out_of_memory = !page;
    }
    if (out_of_memory) {
        ceduo_oom_set_flag();
        arena->failed = true;
        return NULL;
    }
    void *p = (char *)arena->page->bytes + arena->page->used;
    arena->page->used += size;
    arena->bytes += size;
    return p;
}

void *ceduo_arena_grow(struct arena *arena, void *items, size_t n, size_t more, size_t *capacity, size_t size)
{
    if (n + more <= *capacity)
        return items;
    size_t new_capacity = 2 * n + more;
    void *grown = ceduo_arena_alloc(arena, new_capacity * size);
    if (grown && n > 0)
        memcpy(grown, items, n * size);
    *capacity = grown ? new_capacity : *capacity;
    return grown;
}

char *ceduo_arena_copy(struct arena *arena, const char *bytes, size_t n)
{
    char *p = ceduo_arena_alloc(arena, n + 1);
    if (p && n > 0)
        memcpy(p, bytes, n);
    return p;
}

char *ceduo_arena_string(struct arena *arena, const char *string)
{
    return ceduo_arena_copy(arena, string, strlen(string));
}

char *ceduo_arena_vformat(struct arena *arena, const char *format, va_list args)
{
    LOCAL_TEXT(text);
    ceduo_text_vformat(&text, format, args);
    arena->failed |= text.failed;
    return text.failed ? NULL : ceduo_arena_string(arena, ceduo_text_string(&text));
}

char *ceduo_arena_format(struct arena *arena, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    char *p = ceduo_arena_vformat(arena, format, args);
    va_end(args);
    return p;
}

void ceduo_arena_free(struct arena *arena)
{
    while (arena->page) {
        struct arena_page *prev = arena->page->prev;
        free(arena->page);
        arena->page = prev;
    }
    *arena = (struct arena){0};
}
