/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "interrupt.h"

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "say.h"

static atomic_bool raised;
static volatile sig_atomic_t which;
static const int signals[] = {SIGINT, SIGTERM, SIGHUP};

static void on_signal(int number)
{
    which = number;
    atomic_store(&raised, true);
}

static void set_handlers(void (*handler)(int))
{
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        struct sigaction now, new = {.sa_handler = handler, .sa_flags = handler == on_signal ? (int)SA_RESETHAND : 0};
        sigemptyset(&new.sa_mask);
        /* what the caller of the program has switched off (nohup) stays off */
        if (sigaction(signals[i], NULL, &now) == 0 && now.sa_handler != SIG_IGN)
            sigaction(signals[i], &new, NULL);
    }
}

void ceduo_interrupt_catch(void)
{
    set_handlers(on_signal);
}

const atomic_bool *ceduo_interrupt_flag(void)
{
    return &raised;
}

void ceduo_interrupt_release(void)
{
    set_handlers(SIG_DFL);
    if (atomic_load(&raised)) {
        ceduo_say_no_progress();
        raise(which);
    }
}
