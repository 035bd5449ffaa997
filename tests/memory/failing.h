/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failing memory: run a task with each of its allocations failing once, then with all later ones failing, too. If one call path
 * allocates many times, only its first two and its last allocation fail; with FULL=1 each, unless there are many (a fit makes
 * 63 000). The task then reports the failure and frees its memory. If the library promises that it can continue, the result is
 * the same as with memory. A task may also manage without that memory and give its result at once. The linker redirects the C
 * library's calls to these functions (--wrap). */
#ifndef FAILING_H
#define FAILING_H

#include "test.h"

#include <stdatomic.h>
#include <stdbool.h>

#include "ceduo/ceduo.h"

/* Perform the work and add its results; false if memory failed. */
typedef bool task(void);

/* Run a task with each failure. */
void without_memory(task *work);

/* Run a task with the failure of call `index` (0: none), and of all later calls if `all_later`. */
bool run_task(task *work, unsigned long index, bool all_later);

/* Add bytes to the results of the task. */
void add(const void *bytes, size_t n);

/* True if the current allocation fails. */
bool fails(void);

extern atomic_long grow_at; /* index of the failing call of realloc, counted down; 0: none */

/* Stop failing: the task has reported the failure and continues. */
void relieve(void);

/* True if done, false if memory failed; any other status fails the test. */
bool is_done(enum ceduo_status status);

/* Let all other threads fail once, and wait until they have reported it. */
void fail_others(void);

/* Wait until other threads have allocated many times. */
void wait_for_other_threads(void);

/* Progress calls of a task on several threads; `callback` is called at call number `index` (may be NULL). */
extern struct progress_calls {
    void (*callback)(void);
    int index;
    atomic_int inside, inside_max, times;
} progress_calls;

/* `counts`: count this call. */
void count_progress_call(bool counts);
void begin_progress(void (*callback)(void), int index);

#endif
