/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory that fails: allocations of a task once each, and from each on all. Of those that one way of calls makes many times it
 * is the first two and the last; with FULL=1 each, where they are few: one fit makes 63 000. The task then says so, frees what
 * it had, and where the library promises that one can go on gives the result that it gives with memory; or it gets along
 * without and gives that at once. The linker puts what stands here in the place of the C library's calls (--wrap). */
#ifndef FAILING_H
#define FAILING_H

#include "test.h"

#include <stdatomic.h>
#include <stdbool.h>

#include "ceduo/ceduo.h"

/* Does all, and adds what it found; false where there was no memory. */
typedef bool task(void);

/* Runs a task with each failure. */
void without_memory(task *todo);

/* Runs a task with one: that of call `at` (0: none), or also of all that follow. */
bool begin(task *todo, unsigned long at, bool on);

/* Adds bytes to what the task found. */
void add(const void *bytes, size_t n);

/* True if a call that takes memory fails now. */
bool fails(void);

extern atomic_long grow_at; /* the call of realloc that fails, counted down; 0: none */

/* From here on there is memory again: the task was told that there was none, and goes on. */
void relieve(void);

/* Done, or without memory: nothing else goes wrong. */
bool is_done(enum ceduo_status status);

/* The others find no memory for once, and have had time to say so. */
void fail_others(void);
void others_go_on(void);

/* What was told of a task on several threads; when it is told so often something happens meanwhile (NULL: nothing). */
extern struct told {
    void (*meanwhile)(void);
    int at;
    atomic_int inside, most_inside, times;
} told;

/* `counts`: this is one of those that are counted. */
void note_told(bool counts);
void begin_to_tell(void (*meanwhile)(void), int at);

#endif
