/* SPDX-License-Identifier: GPL-3.0-or-later */
/* GSL has one error handler for all threads, and its default handler aborts. While calls of the library run, on_error() is
 * installed. It ignores errors of their threads and passes errors of other threads to the saved handler. The last call to end
 * restores the saved handler. */
#include "gsl_errors.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stddef.h>

#include "oom.h"

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static size_t active_calls;                /* library calls that are running */
static gsl_error_handler_t *saved_handler; /* the caller's; NULL: GSL's default */
static _Thread_local bool in_library;      /* this thread is in a library call */
static _Thread_local jmp_buf *oom_jump;

static void on_error(const char *reason, const char *file, int line, int error)
{
    if (in_library) {
        if (error == GSL_ENOMEM)
            ceduo_oom_set_flag();
        if (error == GSL_ENOMEM && oom_jump)
            longjmp(*oom_jump, 1);
        return;
    }
    pthread_mutex_lock(&lock);
    gsl_error_handler_t *callers_handler = saved_handler;
    pthread_mutex_unlock(&lock);
    if (callers_handler) { /* untaken: end */
        callers_handler(reason, file, line, error);
    } else { /* the default handler prints the error and aborts */
        gsl_set_error_handler(NULL);
        gsl_error(reason, file, line, error);
    }
}

bool ceduo_gsl_enter(void)
{
    bool was_in_library = in_library;
    in_library = true;
    pthread_mutex_lock(&lock);
    if (active_calls++ == 0)
        saved_handler = gsl_set_error_handler(on_error);
    pthread_mutex_unlock(&lock);
    return was_in_library;
}

void ceduo_gsl_leave(const bool *was_in_library)
{
    pthread_mutex_lock(&lock);
    if (--active_calls == 0) {
        gsl_error_handler_t *current_handler = gsl_set_error_handler(saved_handler);
        if (current_handler != on_error) /* the caller has set another handler in the meantime */
            gsl_set_error_handler(current_handler);
    }
    pthread_mutex_unlock(&lock);
    in_library = *was_in_library;
}

int ceduo_gsl_try(int (*call)(void *context), void *context)
{
    GSL_RETURNS_ERRORS;
    jmp_buf jump;
    volatile int status = GSL_ENOMEM;
    oom_jump = &jump;
    if (setjmp(jump) == 0) /* untaken: twice */
        status = call(context);
    oom_jump = NULL;
    return status;
}
