/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_H
#define CEDUO_H

/* All of libceduo: rockfall over a slope, and what a coppice takes from it. */
#include "adc.h"
#include "assess.h"
#include "blocks.h"
#include "contact.h"
#include "find.h"
#include "key.h"
#include "material.h"
#include "number.h"
#include "observe.h"
#include "other.h"
#include "pool.h"
#include "question.h"
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
#include "trajectory.h"
#include "variants.h"
#include "version.h"
#include "years.h"

#endif
