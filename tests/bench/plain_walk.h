/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plain walk in double and its scenes, the reference for the core's speed. */
#ifndef PLAIN_WALK_H
#define PLAIN_WALK_H

#define SLOW_REAL double
#include "physics/slow_scene.h"

#endif
