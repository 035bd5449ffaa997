/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "ceduo/stand.h"

/* Table 4 of Ciabocco et al. 2009, after Brauner et al. 2005. */
#define U_BEECH 102800
#define U_SPRUCE 92213

/* Volumes: Tabacchi, Di Cosmo, Gasparini, Morelli 2011, with the height and diameter of the sampled trees. */
static const struct ceduo_species species[] = {
    {"ostrya-carpinifolia", "hop hornbeam", true, -1.4983, 0.038828, 0, 5, 30, 5, 35, U_BEECH, false},
    {"carpinus-betulus", "hornbeam", true, -1.4983, 0.038828, 0, 5, 30, 5, 35, U_BEECH, false},
    {"fraxinus-ornus", "manna ash", true, -0.11137, 0.039108, 0, 5, 26, 5, 35, U_BEECH, false},
    {"quercus-cerris", "Turkey oak", true, -0.043221, 0.038079, 0, 5, 30, 5, 55, U_BEECH, false},
    {"quercus-pubescens", "downy oak", true, 0.51025, 0.045184, -0.36026, 5, 26, 5, 55, U_BEECH, false},
    {"quercus-ilex", "holm oak", true, -2.2219, 0.039685, 0.62762, 7, 22, 6, 55, U_BEECH, false},
    {"fagus-sylvatica", "beech", true, 0.81151, 0.038965, 0, 5, 34, 5, 65, U_BEECH, true},
    {"castanea-sativa", "chestnut", true, -2.001, 0.036524, 0.74466, 5, 30, 6, 60, U_BEECH, false},
    {"acer", "maple", true, 1.6905, 0.037082, 0, 5, 24, 5, 40, U_BEECH, false},
    {"robinia-pseudoacacia", "robinia", true, -2.1214, 0.037123, 0.14296, 5, 28, 5, 45, U_BEECH, false},
    {"picea-abies", "spruce", true, -9.1298, 0.034866, 1.4633, 5, 40, 6, 70, U_SPRUCE, true},
};

#define SPECIES (sizeof species / sizeof species[0])

const struct ceduo_species *ceduo_species_list(size_t *count)
{
    *count = SPECIES;
    return species;
}

int ceduo_species_find(const char *name)
{
    for (size_t i = 0; i < SPECIES; i++)
        if (strcmp(species[i].name, name) == 0)
            return (int)i;
    return -1;
}

double ceduo_stand_u(const struct ceduo_stand *stand)
{
    if (!isnan(stand->u))
        return stand->u;
    return stand->species >= 0 ? species[stand->species].u : U_BEECH;
}
