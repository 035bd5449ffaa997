/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_INTERRUPT_H
#define CEDUO_INTERRUPT_H

#include <stdatomic.h>

/* From here on SIGINT, SIGTERM and SIGHUP raise a flag instead of ending the program; a second one ends it. */
void ceduo_interrupt_catch(void);

/* The flag, for a run to look at. */
const atomic_bool *ceduo_interrupt_flag(void);

/* Lets signals act again, and ends the program by the one that was caught, if one was. */
void ceduo_interrupt_release(void);

#endif
