/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plain walk in double, to measure the core's speed against. */
#ifndef PLAIN_WALK_H
#define PLAIN_WALK_H

#define SLOW_REAL double
#include "physics/slow_walk.h"

#endif
