/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SPECIES_H
#define CEDUO_SPECIES_H

#include "ceduo/scene.h"

/* Return the work of breaking (J/m3) for brauner: of the stand, else of its species, else of beech. */
double ceduo_stand_u(const struct ceduo_stand *stand);

/* Return the strength of the wood relative to silver fir for dorren: of the stand, else of its species, else 1 (assumed). */
double ceduo_stand_fracture_ratio(const struct ceduo_stand *stand);

#endif
