/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "choices.h"
#include "species.h"

/* Table 4 of Ciabocco et al. 2009, after Brauner et al. 2005. */
#define U_BEECH  102800
#define U_SPRUCE 92213

/* Volumes: Tabacchi, Di Cosmo, Gasparini, Morelli 2011, with the heights and diameters of the sampled trees. The last number is
 * the fracture ratio of Dorren and Berger 2006, from the list in RockforNET. After the name: accepted Italian and German words.
 * All maples are one species. */
#define SPECIES(X)                                                                                                             \
    X("ostrya-carpinifolia", "carpino nero|hopfenbuche", N_("hop hornbeam"), -1.4983, 0.038828, 0, 5, 30, 5, 35, U_BEECH,      \
      false, NAN)                                                                                                              \
    X("carpinus-betulus", "carpino bianco|hainbuche", N_("hornbeam"), -1.4983, 0.038828, 0, 5, 30, 5, 35, U_BEECH, false, NAN) \
    X("fraxinus-ornus", "orniello|manna-esche|mannaesche|blumenesche", N_("manna ash"), -0.11137, 0.039108, 0, 5, 26, 5, 35,   \
      U_BEECH, false, NAN)                                                                                                     \
    X("quercus-cerris", "cerro|zerreiche", N_("Turkey oak"), -0.043221, 0.038079, 0, 5, 30, 5, 55, U_BEECH, false, 2.2)        \
    X("quercus-pubescens", "roverella|flaumeiche", N_("downy oak"), 0.51025, 0.045184, -0.36026, 5, 26, 5, 55, U_BEECH, false, \
      2.2)                                                                                                                     \
    X("quercus-ilex", "leccio|steineiche", N_("holm oak"), -2.2219, 0.039685, 0.62762, 7, 22, 6, 55, U_BEECH, false, 2.2)      \
    X("fagus-sylvatica", "faggio|buche|rotbuche", N_("beech"), 0.81151, 0.038965, 0, 5, 34, 5, 65, U_BEECH, true, 1.5)         \
    X("castanea-sativa", "castagno|kastanie|edelkastanie", N_("chestnut"), -2.001, 0.036524, 0.74466, 5, 30, 6, 60, U_BEECH,   \
      false, NAN)                                                                                                              \
    X("acer", "acero|acero campestre|acero opalo|acero montano|ahorn|feldahorn|bergahorn", N_("maple"), 1.6905, 0.037082, 0,   \
      5, 24, 5, 40, U_BEECH, false, 1.1)                                                                                       \
    X("robinia-pseudoacacia", "robinia|acacia|robinie", N_("robinia"), -2.1214, 0.037123, 0.14296, 5, 28, 5, 45, U_BEECH,      \
      false, 2.7)                                                                                                              \
    X("picea-abies", "abete rosso|peccio|fichte", N_("spruce"), -9.1298, 0.034866, 1.4633, 5, 40, 6, 70, U_SPRUCE, true, 0.9)

#define ALL_WORDS(name, synonyms, common, ...) name "|" synonyms "|" common,
LIBRARY(species, SPECIES, ALL_WORDS);

const struct ceduo_species *ceduo_species_list(size_t *count)
{
    *count = ceduo_species_words.n;
    return species_rows;
}

int ceduo_species_find(const char *name)
{
    return ceduo_choice_find(&ceduo_species_words, name);
}

double ceduo_stand_u(const struct ceduo_stand *stand)
{
    if (!isnan(stand->u))
        return stand->u;
    return stand->species >= 0 ? species_rows[stand->species].u : U_BEECH;
}

double ceduo_stand_fracture_ratio(const struct ceduo_stand *stand)
{
    double ratio = stand->fracture_ratio;
    if (isnan(ratio) && stand->species >= 0)
        ratio = species_rows[stand->species].fracture_ratio;
    return isnan(ratio) ? 1 : ratio;
}
