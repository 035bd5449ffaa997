/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PARALLEL_H
#define CEDUO_PARALLEL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Items 0…n - 1 on several threads, including the caller's. Each idle thread runs the next item. If no thread can be started,
 * the caller runs all. The result of an item must not depend on the thread or on the order. */
struct parallel {
    size_t n;
    unsigned threads;
    /* `worker`, 0…threads - 1, indexes per-thread state. 0: continue; anything else stops the loop. */
    int (*item)(void *context, size_t item, size_t worker);
    void *context;
};

/* Return 0 after all items, otherwise the first status that is not 0. No item begins after it. */
int ceduo_parallel(const struct parallel *work);

/* True if the caller has set its flag. `cancel` may be NULL. */
static inline bool ceduo_cancelled(const atomic_bool *cancel)
{
    return cancel && atomic_load_explicit(cancel, memory_order_relaxed);
}

/* Guard for a callback that one thread at a time may call. If it is busy, a thread skips the call. Starts zeroed. */
struct talk {
    atomic_flag busy;
};
static inline bool ceduo_guard_try_enter(struct talk *talk)
{
    return !atomic_flag_test_and_set(&talk->busy);
}
static inline void ceduo_guard_leave(struct talk *talk)
{
    atomic_flag_clear(&talk->busy);
}

#endif
