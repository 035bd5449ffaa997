/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "parallel.h"

#include <pthread.h>
#include <stdlib.h>

#include "gsl_errors.h"

struct shared_state {
    const struct parallel *work;
    atomic_size_t next, workers;
    atomic_int status;
};

static void *run_items(void *context)
{
    GSL_RETURNS_ERRORS;
    struct shared_state *c = context;
    size_t worker = atomic_fetch_add(&c->workers, 1);
    for (size_t i; atomic_load(&c->status) == 0 && (i = atomic_fetch_add(&c->next, 1)) < c->work->n;) {
        int good = 0, status = c->work->item(c->work->context, i, worker);
        if (status != 0)
            atomic_compare_exchange_strong(&c->status, &good, status);
    }
    return NULL;
}

int ceduo_parallel(const struct parallel *work)
{
    struct shared_state shared_state = {.work = work};
    size_t n = work->threads < work->n ? work->threads : work->n, started = 0;
    pthread_t *threads = n > 1 ? malloc((n - 1) * sizeof *threads) : NULL;
    while (threads && started + 1 < n && pthread_create(&threads[started], NULL, run_items, &shared_state) == 0)
        started++;
    run_items(&shared_state);
    while (started > 0)
        pthread_join(threads[--started], NULL);
    free(threads);
    return atomic_load(&shared_state.status);
}
