/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MATERIAL_H
#define CEDUO_MATERIAL_H

#include <stdbool.h>
#include <stddef.h>

/* A row of the library of grounds: the means of published ranges. Friction is not part of the sources: assumed. */
struct ceduo_material {
    const char *name;
    const char *what; /* it is, marked for translation */
    double rn, rn_lo, rn_hi;
    double rt, rt_lo, rt_hi;
    double roughness_rad; /* assumed: the sources give none */
    double mu;            /* likewise, for the law arm */
    bool literature;      /* false: an assumption of ours */
    const char *source;
};

/* The library: `*count` rows, static. */
const struct ceduo_material *ceduo_materials(size_t *count);

/* The row that is taken where nothing is said of the ground. */
const struct ceduo_material *ceduo_material_talus(void);

#endif
