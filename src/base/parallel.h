/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PARALLEL_H
#define CEDUO_PARALLEL_H

#include <stdatomic.h>
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

#endif
