/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_H
#define CEDUO_H

/* All of libceduo: scenes and their files, rockfall on a slope, and the energy that a coppice absorbs. C++ programs include
 * this header, not its parts.
 *
 * Calls may run concurrently. A scene must not change while a call reads it. One thread at a time uses a pool, run or tracer.
 * The only global state is the error handler of GSL, whose default ends the program. During a call, errors of GSL in its
 * threads become the status of the call; errors in other threads go to the handler that was set before. The call restores that
 * handler. Do not set one during a call. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#include <atomic> /* scene.h needs it: a template cannot have C linkage */
extern "C" {
#endif

#include "calibrate.h"
#include "handle.h"
#include "scene.h"
#include "simulate.h"
#include "survey.h"
#include "uncertainty.h"
#include "years.h"

#ifdef __cplusplus
}
#endif

#endif
