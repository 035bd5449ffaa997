/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_H
#define CEDUO_H

/* All of libceduo: scenes and their files, rockfall over a slope, and what a coppice takes from it. From C++ include this header,
 * not its parts.
 *
 * There is no global state but GSL's handler of errors, and calls may run side by side in several threads: what one of them reads,
 * such as a scene, no other may change meanwhile, and a pool, run, surface or observer that a call changes is its alone.
 * GSL's own handler ends the program. While a call runs, errors of GSL in its threads are what the call returns; those of other
 * threads go to the handler that was set before, which stands again after the call. Set none while a call runs. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "flag.h"

#ifdef __cplusplus
extern "C" {
#endif

#include "adc.h"
#include "assess.h"
#include "blocks.h"
#include "calibrate.h"
#include "find.h"
#include "hazard.h"
#include "key.h"
#include "naslund.h"
#include "observe.h"
#include "other.h"
#include "pool.h"
#include "question.h"
#include "read.h"
#include "record.h"
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
