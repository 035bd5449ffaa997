/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MATERIAL_H
#define CEDUO_MATERIAL_H

#include <stdbool.h>
#include <stddef.h>

/* ---- library of grounds ---- */

/* A ground of the library. Restitutions are the means of published ranges. Roughness and friction are assumed, because no
 * source has them for a rock that keeps its motion while it rolls. They follow two bare field sites (ceduo-validation(7)). */
struct ceduo_material {
    const char *name;
    const char *what; /* description, marked for translation */
    double rn, rn_lo, rn_hi;
    double rt, rt_lo, rt_hi;
    double roughness, roughness_lo, roughness_hi; /* m: the height S of CRSP */
    double friction, friction_lo, friction_hi;    /* tan of the angle of friction */
    double mu;                                    /* Coulomb friction, for the arm law; assumed */
    bool literature;                              /* false: assumed */
    const char *source;
};

/* Return the library: `*count` static rows. */
const struct ceduo_material *ceduo_materials(size_t *count);

/* Return the ground that is assumed if none is given. */
const struct ceduo_material *ceduo_material_talus(void);

#endif
