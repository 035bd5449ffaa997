/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_KEY_H
#define CEDUO_RUN_KEY_H

#include <stdint.h>

#include "ceduo/scene.h"

/* A number for all of a scene that decides the run without forest: rock, release, slope, controls, law, seed, gravity.
 * Two scenes of the same number fly the same rocks. FNV-1a over the numbers themselves. */
uint64_t ceduo_run_key(const struct ceduo_scene *scene);

#endif
