/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PARALLEL_H
#define CEDUO_PARALLEL_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Items 0…n - 1 on several threads, of which the caller's is one; each thread takes the next item as soon as it is free. Where
 * no other thread can be started the caller does all. What an item finds must not depend on the thread or on the order. */
struct parallel {
    size_t n;
    unsigned threads;
    /* `worker`: 0…threads - 1, one thread at a time, for what a thread has for itself. 0: go on; anything else ends the work. */
    int (*item)(void *context, size_t item, size_t worker);
    void *context;
};

/* 0 once all items are done; otherwise the first status that is not 0: no item was begun after it was known. */
int ceduo_parallel(const struct parallel *work);

/* True if the caller has raised its flag. `cancel` may be NULL. */
static inline bool ceduo_cancelled(const atomic_bool *cancel)
{
    return cancel && atomic_load_explicit(cancel, memory_order_relaxed);
}

/* Calls a callback of the caller from one thread at a time. A thread that finds another one in it goes on without, so that none
 * waits: progress that is missed is soon reported again. Starts zeroed. */
struct talk {
    atomic_flag busy;
};
static inline bool ceduo_talk_begin(struct talk *talk)
{
    return !atomic_flag_test_and_set(&talk->busy);
}
static inline void ceduo_talk_end(struct talk *talk)
{
    atomic_flag_clear(&talk->busy);
}

#endif
