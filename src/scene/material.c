/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/material.h"

#include "base/language.h"
#include "choices.h"

#define CRSP3 "ranges in use with CRSP 3.0 (Pfeiffer et al. 1993)"
#define CRSP4 "after CRSP 4.0 (Jones et al. 2000), from memory: check before use"

#define MU 0.6

/* Sources give ranges; the middle is taken. Roughness and mu are in no source. What a ground is, is said in our words; of v4
 * after the kinds of slope that CRSP tells apart. After the name: Italian words that files may have for it. */
#define MATERIALS(X)                                                                                                           \
    X(N_("cliff"), "parete|parete rocciosa|roccia", N_("a face of bare rock"), 0.35, 0.33, 0.37, 0.85, 0.83, 0.87, 0.05, MU,   \
      true, CRSP3)                                                                                                             \
    X(N_("pavement"), "asfalto|strada asfaltata", N_("a road, paved"), 0.35, 0.33, 0.37, 0.85, 0.83, 0.87, 0.01, MU, true,     \
      CRSP3)                                                                                                                   \
    X(N_("talus"), "detrito|falda detritica|ghiaione", N_("loose blocks below a face, little soil"), 0.315, 0.30, 0.33, 0.835, \
      0.82, 0.85, 0.15, MU, true, CRSP3)                                                                                       \
    X(N_("thin-colluvium"), "colluvio sottile|coltre sottile", N_("a thin cover of soil and stones on rock"), 0.315, 0.30,     \
      0.33, 0.835, 0.80, 0.85, 0.15, MU, true, CRSP3)                                                                          \
    X(N_("colluvium"), "colluvio|coltre profonda", N_("a deep cover of soil and stones"), 0.29, 0.28, 0.30, 0.805, 0.78, 0.83, \
      0.15, MU, true, CRSP3)                                                                                                   \
    X(N_("bedrock-v4"), "roccia-v4", N_("bedrock and fields of boulders"), 0.225, 0.15, 0.30, 0.85, 0.75, 0.95, 0.05, MU,      \
      false, CRSP4)                                                                                                            \
    X(N_("talus-v4"), "detrito-v4|falda detritica-v4", N_("talus and firm soil"), 0.16, 0.12, 0.20, 0.80, 0.65, 0.95, 0.15,    \
      MU, false, CRSP4)                                                                                                        \
    X(N_("soft-soil-v4"), "suolo soffice-v4", N_("soft soil"), 0.15, 0.10, 0.20, 0.65, 0.50, 0.80, 0.10, MU, false, CRSP4)     \
    X(N_("pavement-v4"), "asfalto-v4", N_("smooth hard surfaces and paving"), 0.80, 0.60, 1.00, 0.95, 0.90, 1.00, 0.01, MU,    \
      false, CRSP4)

static const struct ceduo_material materials[] = {
#define X(name, also, ...) {name, __VA_ARGS__},
    MATERIALS(X)
#undef X
};

static const char *const names[] = {
#define X(name, ...) name,
    MATERIALS(X)
#undef X
};

static const char *const also[] = {
#define X(name, also, ...) name "|" also,
    MATERIALS(X)
#undef X
};

const struct choices ceduo_material_words = {names, sizeof names / sizeof names[0], also};

const struct ceduo_material *ceduo_materials(size_t *count)
{
    *count = ceduo_material_words.n;
    return materials;
}

const struct ceduo_material *ceduo_material_talus(void)
{
    return &materials[ceduo_choice_find(&ceduo_material_words, "talus")];
}
