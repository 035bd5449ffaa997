/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MUST_H
#define CEDUO_MUST_H

#include <stdbool.h>
#include <stdlib.h>

/* Running out of memory. The library returns an error, which its caller reports. The program sets a hook, which restores
 * the terminal, says one sentence and ends the program; then text, arenas and ceduo_grow() never fail, and what stands on
 * view, model, tui or cli needs no check. */

/* NULL: an error is returned. Otherwise it does not return; any thread may call it. */
extern void (*ceduo_memory_hook)(void);

/* Memory has run out: calls the hook if there is one, and notes it. */
void ceduo_no_memory(void);

/* Whether memory ran out in this thread since this was asked last. Who makes much of many small pieces asks once at its end, for
 * what was made without one of them must not pass for whole. */
bool ceduo_memory_lost(void);

/* Returns what was allocated, and never NULL. */
static inline void *ceduo_must(void *allocated)
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
