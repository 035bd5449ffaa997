/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ALTERNATIVE_LAW_H
#define CEDUO_ALTERNATIVE_LAW_H

#include "ceduo/simulate.h"

/* The same rocks under the other energy law of stems. Two published laws disagree about thin stems (Brauner et al. 2005; Dorren
 * et al. 2006). Neither has been validated there, so results are shown for both. */

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
