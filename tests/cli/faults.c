/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loaded before the C library by LD_PRELOAD: one call of a kind fails. The environment selects it:
 *   FAULT=memory  FAULT_AT=n  allocation n fails; with FAULT_ON=1 all later ones, too
 *   FAULT=ways                nothing fails; FAULT_WAYS names a file for the call path of each allocation
 *   FAULT=call    FAULT_AT=n  call n that opens, writes, syncs, closes, links, renames or removes fails with EIO
 *   FAULT=kill    FAULT_AT=n  SIGKILL just before that call; counts only the first thread: the order of others varies
 *   FAULT=short               every write takes one byte, or is interrupted
 *   FAULT=threads             no thread can be started
 * FAULT_FROM=name: count only calls of the first thread after a file of this name was renamed into place. FAULT_MARK names a
 * file that is created at the fault. After main nothing fails: gcc's --coverage then writes its counts, and cannot handle a
 * failure. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <unwind.h>

void *__libc_malloc(size_t n);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t n);

static enum fault { NOTHING, MEMORY, CALL, KILL, SHORT, THREADS, WAYS } fault;
static unsigned long fault_at;
static bool fault_on;
static const char *fault_from; /* NULL: count all calls */
static atomic_bool waits;
static atomic_ulong count;

__attribute__((constructor)) static void set_up(void)
{
    static const char *const names[] = {"", "memory", "call", "kill", "short", "threads", "ways"};
    const char *name = getenv("FAULT"), *at = getenv("FAULT_AT");
    for (int i = 1; name && i < 7; i++)
        if (strcmp(name, names[i]) == 0)
            fault = (enum fault)i;
    fault_at = at ? strtoul(at, NULL, 10) : 0;
    fault_on = getenv("FAULT_ON") != NULL;
    fault_from = getenv("FAULT_FROM");
    waits = fault_from != NULL;
}

static void mark(void)
{
    const char *path = getenv("FAULT_MARK");
    if (path)
        syscall(SYS_close, syscall(SYS_openat, AT_FDCWD, path, O_CREAT | O_WRONLY, 0600));
}

static bool record_fault(void)
{
    bool first_only = fault_from || fault == KILL;
    if (atomic_load(&waits) || (first_only && gettid() != getpid()))
        return false;
    unsigned long n = atomic_fetch_add(&count, 1) + 1;
    if (n == fault_at)
        mark();
    return n == fault_at || (fault_on && n > fault_at);
}

/* ---- call paths of allocations ---- */

#define PATHS_MAX   (1 << 20)
#define PATH_FRAMES 16

static unsigned long call_paths[PATHS_MAX];

struct call_path {
    unsigned long hash;
    int frames;
};

static _Unwind_Reason_Code add_frame(struct _Unwind_Context *context, void *to)
{
    struct call_path *call_path = to;
    call_path->hash = (call_path->hash ^ _Unwind_GetIP(context)) * 0x100000001b3u;
    return ++call_path->frames < PATH_FRAMES ? _URC_NO_REASON : _URC_END_OF_STACK;
}

static void record_call_path(void)
{
    static _Thread_local bool busy;
    if (busy)
        return;
    busy = true;
    record_fault();
    unsigned long n = atomic_load(&count);
    struct call_path call_path = {0xcbf29ce484222325u, 0};
    _Unwind_Backtrace(add_frame, &call_path);
    if (!atomic_load(&waits) && n < PATHS_MAX)
        call_paths[n] = call_path.hash;
    busy = false;
}

static void print_call_paths(void)
{
    FILE *file = fault == WAYS ? fopen(getenv("FAULT_WAYS"), "w") : NULL;
    unsigned long n = atomic_load(&count);
    fault = NOTHING;
    for (unsigned long i = 1; file && i <= n && i < PATHS_MAX; i++)
        fprintf(file, "%lx\n", call_paths[i]);
    if (file)
        fclose(file);
}

static bool no_memory(void)
{
    if (fault == WAYS)
        record_call_path();
    if (fault != MEMORY || !record_fault())
        return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t n)
{
    return no_memory() ? NULL : __libc_malloc(n);
}

void *calloc(size_t n, size_t size)
{
    return no_memory() ? NULL : __libc_calloc(n, size);
}

void *realloc(void *p, size_t n)
{
    return no_memory() ? NULL : __libc_realloc(p, n);
}

/* True if this call must fail. */
static bool fails(void)
{
    if ((fault != CALL && fault != KILL) || !record_fault())
        return false;
    if (fault == KILL)
        raise(SIGKILL);
    errno = EIO;
    return true;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

int open(const char *path, int flags, ...)
{
    va_list args;
    va_start(args, flags);
    int mode = va_arg(args, int);
    va_end(args);
    return fails() ? -1 : (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int mkostemp(char *name, int flags)
{
    return fails() ? -1 : NEXT(mkostemp)(name, flags);
}

int fchmod(int fd, mode_t mode)
{
    return fails() ? -1 : (int)syscall(SYS_fchmod, fd, mode);
}

ssize_t write(int fd, const void *bytes, size_t n)
{
    static atomic_uint turn;
    if (fault == SHORT && n > 1) {
        mark();
        if (atomic_fetch_add(&turn, 1) % 3 == 0) {
            errno = EINTR;
            return -1;
        }
        n = 1;
    }
    return fails() ? -1 : syscall(SYS_write, fd, bytes, n);
}

/* Tests without memory do not need the disk, and waiting for it would take most of the time. */
int fsync(int fd)
{
    if (fault == MEMORY)
        return 0;
    return fails() ? -1 : (int)syscall(SYS_fsync, fd);
}

int close(int fd)
{
    bool bad = fails();
    int done = (int)syscall(SYS_close, fd); /* closed even after a failure */
    return bad ? -1 : done;
}

int rename(const char *from, const char *to)
{
    if (fails())
        return -1;
    int done = (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
    const char *slash = strrchr(to, '/');
    if (fault_from && strcmp(slash ? slash + 1 : to, fault_from) == 0)
        atomic_store(&waits, false);
    return done;
}

int unlink(const char *path)
{
    return fails() ? -1 : (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*start)(void *), void *argument)
{
    if (fault == THREADS) {
        mark();
        return EAGAIN;
    }
    return NEXT(pthread_create)(thread, attributes, start, argument);
}

static void end_faults(void)
{
    print_call_paths();
    fault = NOTHING;
}

static int (*real_main)(int argc, char **argv, char **environment);

static int main_with_faults(int argc, char **argv, char **environment)
{
    atexit(end_faults); /* registered last, so that it runs before the exit handlers of the C library */
    return real_main(argc, argv, environment);
}

int __libc_start_main(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void), void (*)(void), void *);
int __libc_start_main(int (*program)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*end_of_linker)(void), void *stack_end)
{
    typedef int starter(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void), void (*)(void), void *);
    real_main = program;
    starter *start = (starter *)dlsym(RTLD_NEXT, "__libc_start_main");
    return start(main_with_faults, argc, argv, init, fini, end_of_linker, stack_end);
}
