/* SPDX-License-Identifier: GPL-3.0-or-later */

#include "material.h"
#include "base/language.h"
#include "choices.h"

#define CRSP3 "ranges in use with CRSP 3.0 (Pfeiffer et al. 1993)"
#define CRSP4 "after CRSP 4.0 (Jones et al. 2000), from memory: check before use"

#define MU 0.6

/* Roughness and friction per kind of ground: best value and range. Assumed. */
#define ROCK  0.10, 0.03, 0.20, 0.45, 0.30, 0.65, MU
#define TALUS 0.20, 0.10, 0.40, 0.45, 0.25, 0.65, MU
#define THIN  0.10, 0.04, 0.25, 0.35, 0.20, 0.55, MU
#define SOIL  0.05, 0.02, 0.15, 0.30, 0.15, 0.50, MU
#define PAVED 0.01, 0.00, 0.03, 0.30, 0.20, 0.50, MU

/* Sources give ranges of Rn and Rt; the value is the middle. The descriptions are not from the sources; those after CRSP 4.0
 * follow its kinds of slope. After the name: accepted Italian words. */
#define MATERIALS(X)                                                                                                           \
    X(N_("cliff"), "parete|parete rocciosa|roccia", N_("a face of bare rock"), 0.35, 0.33, 0.37, 0.85, 0.83, 0.87, ROCK, true, \
      CRSP3)                                                                                                                   \
    X(N_("pavement"), "asfalto|strada asfaltata", N_("a road, paved"), 0.35, 0.33, 0.37, 0.85, 0.83, 0.87, PAVED, true, CRSP3) \
    X(N_("talus"), "detrito|falda detritica|ghiaione", N_("loose blocks below a face, little soil"), 0.315, 0.30, 0.33, 0.835, \
      0.82, 0.85, TALUS, true, CRSP3)                                                                                          \
    X(N_("thin-colluvium"), "colluvio sottile|coltre sottile", N_("a thin cover of soil and stones on rock"), 0.315, 0.30,     \
      0.33, 0.835, 0.80, 0.85, THIN, true, CRSP3)                                                                              \
    X(N_("colluvium"), "colluvio|coltre profonda|prato", N_("a deep cover of soil and stones, meadow"), 0.29, 0.28, 0.30,      \
      0.805, 0.78, 0.83, SOIL, true, CRSP3)                                                                                    \
    X(N_("bedrock-v4"), "roccia-v4", N_("bedrock and fields of boulders"), 0.225, 0.15, 0.30, 0.85, 0.75, 0.95, ROCK, false,   \
      CRSP4)                                                                                                                   \
    X(N_("talus-v4"), "detrito-v4|falda detritica-v4", N_("talus and firm soil"), 0.16, 0.12, 0.20, 0.80, 0.65, 0.95, TALUS,   \
      false, CRSP4)                                                                                                            \
    X(N_("soft-soil-v4"), "suolo soffice-v4", N_("soft soil"), 0.15, 0.10, 0.20, 0.65, 0.50, 0.80, SOIL, false, CRSP4)         \
    X(N_("pavement-v4"), "asfalto-v4", N_("smooth hard surfaces and paving"), 0.80, 0.60, 1.00, 0.95, 0.90, 1.00, PAVED,       \
      false, CRSP4)

#define ALL_WORDS(name, synonyms, ...) name "|" synonyms,
LIBRARY(material, MATERIALS, ALL_WORDS);

const struct ceduo_material *ceduo_materials(size_t *count)
{
    *count = ceduo_material_words.n;
    return material_rows;
}

const struct ceduo_material *ceduo_material_talus(void)
{
    return &material_rows[ceduo_choice_find(&ceduo_material_words, "talus")];
}
