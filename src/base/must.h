/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MUST_H
#define CEDUO_MUST_H

#include <stdbool.h>
#include <stdlib.h>

/* Running out of memory. The library returns an error. The program sets a hook, which restores the terminal, prints a sentence and
 * ends the program: there text, arenas and ceduo_grow() never fail, and need no check. */

/* Does not return; any thread may call it. NULL: an error is returned. */
extern void (*ceduo_memory_hook)(void);

/* Note that memory ran out, and call the hook if there is one. */
void ceduo_no_memory(void);

/* True if memory ran out in this thread since the last call. Call it once after many small allocations. */
bool ceduo_memory_failed(void);

/* Return the allocated memory, never NULL. */
static inline void *ceduo_check_memory(void *allocated)
{
    if (!allocated) {
        ceduo_no_memory();
        abort();
    }
    return allocated;
}

/* Grow an array of n items of `size` bytes so that it holds one more; `*capacity` is the number that it holds. Returns the array, which
 * may have moved. NULL on failure: the array stays as it was. */
static inline void *ceduo_grow(void *items, size_t n, size_t *capacity, size_t size)
{
    if (n < *capacity)
        return items;
    size_t more = *capacity > 0 ? 2 * *capacity : 32;
    void *grown = realloc(items, more * size);
    if (!grown)
        ceduo_no_memory();
    *capacity = grown ? more : *capacity;
    return grown;
}

#endif
