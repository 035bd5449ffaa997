/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/material.h"

#define CRSP3 "ranges in use with CRSP 3.0 (Pfeiffer et al. 1993)"
#define CRSP4 "after CRSP 4.0 (Jones et al. 2000), from memory: check before use"

/* Sources give ranges; the middle is taken. Roughness is in no source. */
static const struct ceduo_material materials[] = {
    {"cliff", 0.35, 0.33, 0.37, 0.85, 0.83, 0.87, 0.05, true, CRSP3},
    {"pavement", 0.35, 0.33, 0.37, 0.85, 0.83, 0.87, 0.01, true, CRSP3},
    {"talus", 0.315, 0.30, 0.33, 0.835, 0.82, 0.85, 0.15, true, CRSP3},
    {"thin-colluvium", 0.315, 0.30, 0.33, 0.835, 0.80, 0.85, 0.15, true, CRSP3},
    {"colluvium", 0.29, 0.28, 0.30, 0.805, 0.78, 0.83, 0.15, true, CRSP3},
    {"bedrock-v4", 0.225, 0.15, 0.30, 0.85, 0.75, 0.95, 0.05, false, CRSP4},
    {"talus-v4", 0.16, 0.12, 0.20, 0.80, 0.65, 0.95, 0.15, false, CRSP4},
    {"soft-soil-v4", 0.15, 0.10, 0.20, 0.65, 0.50, 0.80, 0.10, false, CRSP4},
    {"pavement-v4", 0.80, 0.60, 1.00, 0.95, 0.90, 1.00, 0.01, false, CRSP4},
};

const struct ceduo_material *ceduo_materials(size_t *count)
{
    *count = sizeof materials / sizeof materials[0];
    return materials;
}
