/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_H
#define CEDUO_H

/* All of libceduo: scenes and their files, rockfall on a slope, and the energy that a coppice absorbs. C++ programs include this
 * header, not its parts.
 *
 * Calls may run concurrently. A scene must not change while a call reads it. One thread at a time uses a pool, run, surface or
 * observer. The only global state is the error handler of GSL, whose default ends the program. During a call, errors of GSL in
 * its threads become the status of the call; errors in other threads go to the handler that was set before. The call restores
 * that handler. Do not set one during a call. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "flag.h"

#ifdef __cplusplus
extern "C" {
#endif

#include "adc.h"
#include "alternative_law.h"
#include "assess.h"
#include "blocks.h"
#include "calibrate.h"
#include "fence.h"
#include "find.h"
#include "handle.h"
#include "hazard.h"
#include "key.h"
#include "naslund.h"
#include "observe.h"
#include "pool.h"
#include "read.h"
#include "record.h"
#include "request.h"
#include "result.h"
#include "rock.h"
#include "rotation.h"
#include "run.h"
#include "scene.h"
#include "slope.h"
#include "stand.h"
#include "statistics.h"
#include "status.h"
#include "surface.h"
#include "survey.h"
#include "trajectory.h"
#include "uncertainty.h"
#include "variants.h"
#include "years.h"
#include "yield.h"

#ifdef __cplusplus
}
#endif

#endif
