/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MUST_H
#define CEDUO_MUST_H

#include <stdlib.h>

/* Running out of memory. The library returns an error, which its caller reports. The program sets a hook, which restores
 * the terminal, says one sentence and ends the program; then text, arenas and ceduo_grow() never fail, and what stands on
 * view, model, tui or cli needs no check. */

/* NULL: an error is returned. Otherwise it does not return; any thread may call it. */
extern void (*ceduo_memory_hook)(void);

/* Memory has run out: calls the hook if there is one. */
void ceduo_no_memory(void);

/* Returns what was allocated, and never NULL. */
static inline void *ceduo_must(void *allocated)
{
    if (!allocated) {
        ceduo_no_memory();
        abort();
    }
    return allocated;
}

#endif
