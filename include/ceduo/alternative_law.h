/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ALTERNATIVE_LAW_H
#define CEDUO_ALTERNATIVE_LAW_H

#include "assess.h"

/* The same rocks under the other energy law of stems. Two published laws disagree about thin stems (Brauner et al. 2005; Dorren
 * et al. 2006). Neither has been validated there, so results are shown for both. */

/* Few rocks show the effect of the other law: the first ones of the scene, in whole batches. */
#define CEDUO_ALT_LAW_ROCKS ((uint64_t)10 * CEDUO_BATCH_ROCKS)

/* Results of an option at one control under the other law. */
struct ceduo_alternative_energy {
    bool known;
    bool stems; /* the option has stems; otherwise no law has an effect */
    enum ceduo_energy_model model;
    struct ceduo_arrivals arrivals;   /* valid if known; of at most CEDUO_ALT_LAW_ROCKS rocks */
    enum ceduo_judgement judgement;   /* of the control by this law; CEDUO_DEPENDS: the two laws contradict */
    struct ceduo_difference to_first; /* to the first option under its other law; NaN: unknown */
};

/* Return the other law of an option: brauner if all its stems follow dorren, otherwise dorren. */
enum ceduo_energy_model ceduo_alternative_law(const struct ceduo_option *option);

/* Copy a scene with the other law in every stand. `alternative` owns its belts and shares all else with `scene`. False without
 * memory. Caller releases `alternative` in any case. */
bool ceduo_alternative_scene(const struct ceduo_scene *scene, struct ceduo_scene *alternative);
void ceduo_alternative_scene_release(struct ceduo_scene *alternative);

/* Read a control from the run of option `index` under its other law. `first` is this run of the first option. Both may be NULL.
 * The scene may differ from that of the runs in accepted return periods. Return CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_alternative_read(const struct ceduo_scene *scene, size_t index, const struct ceduo_run *run,
                                         const struct ceduo_run *first, size_t control,
                                         struct ceduo_alternative_energy *alternative);

#endif
