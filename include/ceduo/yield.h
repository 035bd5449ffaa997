/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YIELD_H
#define CEDUO_YIELD_H

#include "rotation.h"
#include "scene.h"

/* Yield of a forest, from the volumes, growth and cuts of its stems (rotation.h). All volumes are stem wood in m3 per hectare
 * of forest: the mean over the belts, weighted by length.
 *
 * The yield of a cut is the stand before it less the stand after it; retained trees were shoots before. Stems that die between
 * two cuts, by self-thinning of shoots or by density, are no yield; each counts with its volume of the year before. So over a
 * periodic rotation the felled volume equals growth less mortality. */
struct ceduo_felling {
    unsigned year;
    size_t belt;
    double stems_per_ha, volume; /* m3/ha of the belt; 0 if the inventory has less than its cuts leave */
};

struct ceduo_yield {
    double cut_per_year;  /* m3/ha and year, over a whole rotation of each belt; NaN if growth or cuts are unknown */
    double died_per_year; /* likewise */
    double standing;      /* m3/ha: mean over the years of the rotation */
    double volume_today;  /* m3/ha as filed; NaN without a forest */
    /* maximum share of the growing space that trees take before a cut; above 1 growth and yield are unknown */
    double space;
    size_t fellings_count;
    struct ceduo_felling *fellings; /* by year, then by belt */
};

/* Compute the yield of an option, with the fellings from year 0 to `last`, at most CEDUO_YEAR_MAX. Return CEDUO_OK, or
 * CEDUO_NO_MEMORY, CEDUO_BAD_STAND or CEDUO_BAD_ARGUMENT with nothing to free. */
enum ceduo_status ceduo_yield_compute(const struct ceduo_option *option, unsigned last, struct ceduo_yield *yield);
void ceduo_yield_release(struct ceduo_yield *yield);

/* Return the stem volume of a stand, m3/ha. */
double ceduo_stand_volume(const struct ceduo_stand *stand);

#endif
