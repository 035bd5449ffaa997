/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YIELD_H
#define CEDUO_YIELD_H

#include "rotation.h"
#include "scene.h"

/* What a forest yields, from the volumes of its stems, their growth and their cuts (rotation.h). All is stem wood
 * in m3 per hectare of forest: the mean over the belts, each weighted by its length.
 *
 * A cut takes what stands before it less what stands after it: trees that stay were shoots before. Stems that die
 * between two cuts, by the falling number of shoots or thinned by the density, are no yield: each counts with its
 * volume of the year before. Hence over a rotation that repeats itself the volume felled is what grew less what
 * died. */
struct ceduo_felling {
    unsigned year;
    size_t belt;
    double stems_per_ha, volume; /* m3/ha of that belt; 0 where an inventory is poorer than what its cuts leave */
};

struct ceduo_yield {
    double cut_per_year;  /* m3/ha and year, over a whole rotation of each belt; NaN where growth or cuts are not
                               * known */
    double died_per_year; /* likewise */
    double standing;      /* m3/ha: the mean of that rotation's years */
    double volume_today;  /* m3/ha as filed; NaN without a forest */
    double space;         /* the largest share of the growing space that trees take before a cut; above 1 the ground
                               * does not bear so many: their growth, and so the yield, is not known */
    size_t fellings_count;
    struct ceduo_felling *fellings; /* by year, then by belt */
};

/* The yield of an option. Fellings are those from year 0 to `last`, at most CEDUO_YEAR_MAX. CEDUO_NO_MEMORY,
 * CEDUO_BAD_STAND or CEDUO_BAD_ARGUMENT, with nothing to free, or CEDUO_OK. */
enum ceduo_status ceduo_yield_compute(const struct ceduo_option *option, unsigned last, struct ceduo_yield *yield);
void ceduo_yield_release(struct ceduo_yield *yield);

/* Stem volume of a stand, m3/ha. */
double ceduo_stand_volume(const struct ceduo_stand *stand);

#endif
