/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STAND_H
#define CEDUO_STAND_H

#include "ceduo/scene.h"

/* Sums over a stand, per hectare. */
double ceduo_stand_shoots(const struct ceduo_stand *stand);
double ceduo_stand_trees(const struct ceduo_stand *stand);
double ceduo_stand_retained_per_ha(const struct ceduo_stand *stand); /* single trees retained by a cut */
double ceduo_stand_basal_area(const struct ceduo_stand *stand);      /* m2/ha: sum of N pi d2/4 */
bool ceduo_stand_has_shoots(const struct ceduo_stand *stand);
bool ceduo_stand_has_stems(const struct ceduo_stand *stand); /* shoots or trees */
bool ceduo_stand_is_bare(const struct ceduo_stand *stand);   /* no stems, stumps or logs */
bool ceduo_stems_are_grouped(const struct ceduo_stems *stems);

#endif
