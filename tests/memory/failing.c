/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "memory/failing.h"
#include "ceduo/scene.h"

#include <errno.h>
#include <execinfo.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "full.h"

/* ---- call paths ---- */

#define PATHS_MAX   ((unsigned long)1 << 20) /* calls recorded per task */
#define PATH_FRAMES 16

static bool recording;
static uint64_t paths[PATHS_MAX];

/* Return a hash of the functions on the call stack. */
static uint64_t hash_call_path(void)
{
    void *frames[PATH_FRAMES];
    uint64_t path = 0xcbf29ce484222325u;
    int n = backtrace(frames, PATH_FRAMES);
    for (int i = 0; i < n; i++)
        path = (path ^ (uintptr_t)frames[i]) * 0x100000001b3u;
    return path;
}

/* Count the calls first…end - 1 with the same path as `call`, at most 2. */
static int count_same_paths(unsigned long call, unsigned long first, unsigned long end)
{
    int n = 0;
    for (unsigned long i = first; i < end && n < 2; i++)
        n += paths[i] == paths[call];
    return n;
}

/* ---- failing calls ---- */

static atomic_ulong calls;
static atomic_long live;
static atomic_ulong fail_at; /* 0: none */
static atomic_bool fail_on;  /* fail all later calls, too */
atomic_long grow_at;

bool fails(void)
{
    unsigned long n = atomic_fetch_add(&calls, 1) + 1;
    if (recording && n < PATHS_MAX)
        paths[n] = hash_call_path();
    if (fail_at == 0 || !(fail_on ? n >= fail_at : n == fail_at))
        return false;
    errno = ENOMEM;
    return true;
}

static void *counted(void *p)
{
    live += p != NULL;
    return p;
}

void *__real_malloc(size_t n);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *p, size_t n);
void *__real_aligned_alloc(size_t align, size_t n);
char *__real_strdup(const char *s);
char *__real_realpath(const char *path, char *to);
void __real_free(void *p);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument);

void *__wrap_malloc(size_t n);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *p, size_t n);
void *__wrap_aligned_alloc(size_t align, size_t n);
char *__wrap_strdup(const char *s);
char *__wrap_realpath(const char *path, char *to);
void __wrap_free(void *p);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument);

void *__wrap_malloc(size_t n)
{
    return fails() ? NULL : counted(__real_malloc(n));
}

void *__wrap_calloc(size_t n, size_t size)
{
    return fails() ? NULL : counted(__real_calloc(n, size));
}

void *__wrap_realloc(void *p, size_t n)
{
    if (fails() || (grow_at > 0 && --grow_at == 0))
        return NULL;
    void *to = __real_realloc(p, n);
    return p ? to : counted(to);
}

void *__wrap_aligned_alloc(size_t align, size_t n)
{
    return fails() ? NULL : counted(__real_aligned_alloc(align, n));
}

char *__wrap_strdup(const char *s)
{
    return fails() ? NULL : counted(__real_strdup(s));
}

char *__wrap_realpath(const char *path, char *to)
{
    return fails() ? NULL : to ? __real_realpath(path, to) : counted(__real_realpath(path, to));
}

void __wrap_free(void *p)
{
    live -= p != NULL;
    __real_free(p);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument)
{
    return fails() ? EAGAIN : __real_pthread_create(thread, attributes, start, argument);
}

/* ---- a task and its result ---- */

static uint64_t found;

void add(const void *bytes, size_t n)
{
    const unsigned char *p = bytes;
    for (size_t i = 0; i < n; i++)
        found = (found ^ p[i]) * 0x100000001b3u;
}

void relieve(void)
{
    fail_at = 0;
}

bool is_done(enum ceduo_status status)
{
    assert_true(status == CEDUO_OK || status == CEDUO_NO_MEMORY);
    return status == CEDUO_OK;
}

/* ---- failure in one of several threads ---- */

#define PATIENCE 10000 /* ms */

static void sleep_ms(long ms)
{
    nanosleep(&(struct timespec){0, ms * 1000000}, NULL);
}

/* Wait until other threads have allocated n times. */
static void wait_for_others(unsigned long n)
{
    const unsigned long calls_wanted = calls + n;
    for (int i = 0; calls < calls_wanted && i < PATIENCE; i++)
        sleep_ms(1);
}

void fail_others(void)
{
    fail_on = true;
    fail_at = 1;
    wait_for_others(1);
    sleep_ms(20);
    relieve();
}

struct progress_calls progress_calls;

void count_progress_call(bool counts)
{
    int inside = atomic_fetch_add(&progress_calls.inside, 1) + 1;
    progress_calls.inside_max = inside > progress_calls.inside_max ? inside : progress_calls.inside_max;
    if (counts && ++progress_calls.times == progress_calls.index && progress_calls.callback)
        progress_calls.callback();
    progress_calls.inside--;
}

void begin_progress(void (*callback)(void), int index)
{
    progress_calls.callback = callback;
    progress_calls.index = index;
    progress_calls.inside_max = progress_calls.times = 0;
}

void wait_for_other_threads(void)
{
    wait_for_others(500);
}

bool run_task(task *work, unsigned long at, bool all_later)
{
    found = 0xcbf29ce484222325u;
    calls = 0;
    live = 0;
    fail_at = at;
    fail_on = all_later;
    bool done = work();
    fail_at = 0;
    if (live != 0)
        fail_msg("allocation %lu%s: %ld are not freed", at, all_later ? " and all that follow" : "", (long)live);
    return done;
}

enum { CALLS_FEW = 1000 };

void without_memory(task *work)
{
    assert_true(run_task(work, 0, false));
    const uint64_t wanted = found, all = calls;
    assert_true(all < PATHS_MAX);
    hash_call_path(); /* its first use allocates memory */
    recording = true;
    assert_true(run_task(work, 0, false));
    recording = false;
    assert_int_equal(found, wanted);
    unsigned long failed = 0, tried = 0;
    bool each = FULL_OR(all < CALLS_FEW, false);
    for (unsigned long at = 1; at <= all; at++)
        for (int all_later = 0;
             all_later < 2 && (each || count_same_paths(at, 1, at) < 2 || count_same_paths(at, at + 1, all + 1) == 0);
             all_later++) {
            bool done = run_task(work, at, all_later);
            failed += !done;
            tried++;
            if (done && found != wanted)
                fail_msg("allocation %lu%s: another result", at, all_later ? " and all that follow" : "");
        }
    print_message("# %lu calls, %lu of %lu times the task ended without memory\n", (unsigned long)all, failed, tried);
}
