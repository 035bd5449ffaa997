/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_OTHER_H
#define CEDUO_OTHER_H

#include "assess.h"

/* The same rocks under the other energy law of stems. Two published laws disagree about thin stems (Brauner et al. 2005;
 * Dorren et al. 2006), and nobody knows yet which of them holds there; so what follows from both is shown. */

/* What another law would change is seen with few rocks: the first of the scene's, whole blocks of them. */
#define CEDUO_OTHER_ROCKS ((uint64_t)10 * CEDUO_BATCH_ROCKS)

/* What another law makes of an option at one control. */
struct ceduo_alternative_energy {
    bool known;
    bool stems; /* there are any; otherwise no law changes anything */
    enum ceduo_energy_model model;
    struct ceduo_arrivals arrivals;   /* where it is known; of a pool of at most CEDUO_OTHER_ROCKS */
    enum ceduo_judgement judgement;   /* of the control by this law; CEDUO_DEPENDS: one law says yes, the other no */
    struct ceduo_difference to_first; /* to the first option under its other law; NaN: not known */
};

/* The other law of an option: brauner where all its stems follow dorren, otherwise dorren. */
enum ceduo_energy_model ceduo_alternative_law(const struct ceduo_option *option);

/* The scene with that law in every stand of its options. Their belts are its own, all else is shared with `scene`. False without
 * memory. Release it in any case. */
bool ceduo_alternative_scene(const struct ceduo_scene *scene, struct ceduo_scene *other);
void ceduo_alternative_scene_release(struct ceduo_scene *other);

/* Reads a control of the run of an option under its other law. `first`: that of the first option. Both may be missing.
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_alternative_read(const struct ceduo_option *option, const struct ceduo_run *run,
                                         const struct ceduo_run *first, size_t control, struct ceduo_alternative_energy *other);

#endif
