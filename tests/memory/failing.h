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
void without_memory(task *todo);

/* Run a task with the failure of call `at` (0: none), and of all later calls if `on`. */
bool begin(task *todo, unsigned long at, bool on);

/* Append bytes to the results of the task. */
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
void others_go_on(void);

/* Progress calls of a task on several threads; `meanwhile` is called at call number `at` (may be NULL). */
extern struct told {
    void (*meanwhile)(void);
    int at;
    atomic_int inside, most_inside, times;
} told;

/* `counts`: count this call. */
void note_told(bool counts);
void begin_to_tell(void (*meanwhile)(void), int at);

#endif
