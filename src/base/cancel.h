/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CANCEL_H
#define CEDUO_CANCEL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Whether nobody waits for the work any more. NULL: somebody always does. */
static inline bool ceduo_cancelled(const atomic_bool *cancel)
{
    return cancel && atomic_load_explicit(cancel, memory_order_relaxed);
}

#endif
