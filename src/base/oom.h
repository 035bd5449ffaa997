/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OOM_H
#define CEDUO_OOM_H

#include <stdbool.h>
#include <stdlib.h>

/* Handling of out-of-memory. The library returns an error. The program sets a hook that restores the terminal, prints a message
 * and ends the program, so that text, arenas and ceduo_grow() never fail and need no check. */

/* Called by any thread; must not return. NULL: functions return an error. */
extern void (*ceduo_oom_hook)(void);

/* Set the out-of-memory flag of this thread, and call the hook if there is one. */
void ceduo_oom_set_flag(void);

/* Return and clear the out-of-memory flag of this thread. Check it once after many small allocations. */
bool ceduo_memory_failed(void);

/* Return `allocated`; end the program if it is NULL. */
static inline void *ceduo_check_memory(void *allocated)
{
    if (!allocated) { /* untaken: end */
        ceduo_oom_set_flag();
        abort();
    }
    return allocated;
}

/* Grow an array of n items of `size` bytes to hold one more. *capacity is its capacity. Returns the array, which may have
 * moved. NULL on failure: the array is unchanged. */
static inline void *ceduo_grow(void *items, size_t n, size_t *capacity, size_t size)
{
    if (n < *capacity)
        return items;
    size_t more = *capacity > 0 ? 2 * *capacity : 32;
    void *grown = realloc(items, more * size);
    if (!grown)
        ceduo_oom_set_flag();
    *capacity = grown ? more : *capacity;
    return grown;
}

#endif
