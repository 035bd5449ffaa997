/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_H
#define CEDUO_H

/* All of libceduo: rockfall over a slope, and what a coppice takes from it. From C++ include this header, not its parts. Calls on
 * different objects may run side by side; what a call reads, no other may change meanwhile. */
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
#include "contact.h"
#include "doubt.h"
#include "find.h"
#include "hazard.h"
#include "key.h"
#include "material.h"
#include "naslund.h"
#include "number.h"
#include "observe.h"
#include "other.h"
#include "pool.h"
#include "question.h"
#include "record.h"
#include "regulation.h"
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
#include "variants.h"
#include "version.h"
#include "years.h"
#include "yield.h"

#ifdef __cplusplus
}
#endif

#endif
