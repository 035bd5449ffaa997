/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YIELD_H
#define CEDUO_YIELD_H

#include "ceduo/scene.h"

/* Return the stem volume of a stand, m3/ha. */
double ceduo_stand_volume(const struct ceduo_stand *stand);

#endif
