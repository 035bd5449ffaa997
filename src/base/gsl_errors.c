/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL has one handler of errors for all threads, and its own aborts. While calls of the library run, ours stands there: it lets
 * the threads of these calls go on, and hands the errors of others to the handler that was there before. The last call that
 * ends puts that back. */
#include "gsl_errors.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stddef.h>

#include "must.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static size_t calls;                /* that run */
static gsl_error_handler_t *before; /* the caller's; NULL: GSL's own */
static _Thread_local bool within;   /* this thread is in such a call */
static _Thread_local jmp_buf *way_out;

static void on_error(const char *reason, const char *file, int line, int error)
{
    if (within) {
        if (error == GSL_ENOMEM)
            ceduo_no_memory();
        if (error == GSL_ENOMEM && way_out)
            longjmp(*way_out, 1);
        return;
    }
    pthread_mutex_lock(&lock);
    gsl_error_handler_t *theirs = before;
    pthread_mutex_unlock(&lock);
    if (theirs) { /* untaken: end */
        theirs(reason, file, line, error);
    } else { /* it prints what is wrong and aborts */
        gsl_set_error_handler(NULL);
        gsl_error(reason, file, line, error);
    }
}

bool ceduo_gsl_enter(void)
{
    bool was = within;
    within = true;
    pthread_mutex_lock(&lock);
    if (calls++ == 0)
        before = gsl_set_error_handler(on_error);
    pthread_mutex_unlock(&lock);
    return was;
}

void ceduo_gsl_leave(const bool *was)
{
    pthread_mutex_lock(&lock);
    if (--calls == 0) {
        gsl_error_handler_t *now = gsl_set_error_handler(before);
        if (now != on_error) /* the caller has set another meanwhile */
            gsl_set_error_handler(now);
    }
    pthread_mutex_unlock(&lock);
    within = *was;
}

int ceduo_gsl_try(int (*call)(void *context), void *context)
{
    GSL_RETURNS_ERRORS;
    jmp_buf out;
    volatile int status = GSL_ENOMEM;
    way_out = &out;
    if (setjmp(out) == 0) /* untaken: twice */
        status = call(context);
    way_out = NULL;
    return status;
}
