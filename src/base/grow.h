/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GROW_H
#define CEDUO_GROW_H

#include <stdlib.h>

#include "must.h"

/* Makes room for one more item in an array of n items of `size` bytes; `*room` is how many it can hold. Returns the array,
 * which may have moved; NULL without memory, and the array stays as it was. */
static inline void *ceduo_grow(void *items, size_t n, size_t *room, size_t size)
{
    if (n < *room)
        return items;
    size_t more = *room > 0 ? 2 * *room : 32;
    void *grown = realloc(items, more * size);
    if (!grown)
        ceduo_no_memory();
    *room = grown ? more : *room;
    return grown;
}

#endif
