/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ROTATION_H
#define CEDUO_ROTATION_H

#include <limits.h>

#include "stand.h"
#include "status.h"

/* A stand in future years. Each year is computed on its own in closed form; nothing is accumulated.
 *
 * Year 0 is the inventory, the stand as filed. It grows until its first cut. The age of a cohort or class is its own if given
 * and above 0, otherwise the age at which its curve has its dbh. If its dbh reaches or exceeds the limit of the curve, it no
 * longer grows. After t years, from the age a:
 *     dbh and its deviation × d(a + t)/d(a), height × h(a + t)/h(a), a given volume with dbh2 × height,
 *     shoots × n(a + t)/n(a), all scaled up if less than one per stool would be left; trees keep their number.
 * From the first cut on the cuts set the ages. At t years after the last cut:
 *     trees of class j (1, 2 …): cutting.stay_per_ha[j - 1], j·rotation + t years old;
 *     shoots of K cohorts: t, rotation + t … (K - 1)·rotation + t years old, n(age)/K of each per stool.
 * In the year of a cut the youngest shoots do not exist yet: with one cohort there are no stools. The volume of a shoot follows
 * from species, dbh and height; all shoots of a cohort are equal. No other trees or shoots grow, so a stand without stools has
 * no stools after a cut.
 *     d(t) = D(1 - exp(-kt)), h(t) = H(1 - exp(-mt)), n(t) = n_old + (n_young - n_old)exp(-t/5)
 * are assumed, with all their constants.
 *
 * If an inventory has one cohort of shoots less than its stools have after a cut, it was cut just before year 0. From year 1 on
 * it has new shoots, n(t)/K per stool.
 *
 * Stumps persist for growth.stump_years after a cut (0: none); before the first cut, counted from the age of the youngest
 * shoots. Logs persist. Trees that a cut leaves are grouped like the first grouped class of the inventory.
 *
 * Trees and shoots share the growing space (assumed). In computed years, that is all but year 0 as filed, only the shoots are
 * thinned, by one factor to growth.sdi_max·(1 - ceduo_growing_space_used()). If less than one per stool is left, stools die,
 * and each remaining stool has one shoot. As years are independent, a cut starts again from all stools of the inventory. */

#define CEDUO_YEAR_MAX 100000 /* the last year of a window */

/* Year of a cut that never comes. */
#define CEDUO_NEVER UINT_MAX

/* The stand of one year. It has no growth and cutting, so it cannot be grown again. */
struct ceduo_grown_stand {
    struct ceduo_stand stand;
    struct ceduo_stems *stems; /* owned; shoots, then trees; after a cut each from young to old */
};

/* Compute the stand of `year` in *out; caller frees it by ceduo_grown_stand_release(). `first_cut`: as in ceduo_first_cut(). A
 * stratum without a growth curve is copied unchanged. Without any curve, or in year 0 without a cut, so is the whole stand, bit
 * for bit. In the year of a cut it is the stand after the cut. Return CEDUO_NO_MEMORY, with nothing to free, or CEDUO_OK. */
enum ceduo_status ceduo_stand_at(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                 struct ceduo_grown_stand *out);
void ceduo_grown_stand_release(struct ceduo_grown_stand *grown);

/* Compute the stand at the end of a year of a cut before it is felled. After the first cut it is a whole rotation old.
 * Otherwise as ceduo_stand_at(). */
enum ceduo_status ceduo_stand_before_cut(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                         struct ceduo_grown_stand *out);

/* Return the height (m) of a stem of `dbh` m on its curve; NaN if the curve is unknown or does not reach this dbh. */
double ceduo_curve_height(const struct ceduo_curve *curve, double dbh);

/* Comparison of one kind of stems of the inventory with its growth curve: age (years), basal area, and basal area of the same
 * number of stems on the curve at this age (m2/ha). by_curve is NaN if the age or the curve is unknown. */
struct ceduo_curve_comparison {
    double age, basal_area, by_curve;
};
/* Compare kind i of the stems, shoots first, with its curve. A single kind of shoots without age has the years since a cut
 * before year 0. */
struct ceduo_curve_comparison ceduo_stems_compare_to_curve(const struct ceduo_stand *stand, double first_cut, size_t i);

/* Maximum relative difference of the basal areas; above it a page warns (assumed). */
#define CEDUO_CURVE_DEVIATION_MAX 0.2

/* True if the stools were cut just before year 0; true if anything changes apart from cuts. */
bool ceduo_stand_sprouts(const struct ceduo_stand *stand);
bool ceduo_stand_grows(const struct ceduo_stand *stand);

/* Return the year >= 0 of the first cut of the inventory, or CEDUO_NEVER. There is no cut without a rotation, or if the growth
 * after a cut is unknown (of shoots if there are stools, of trees if any are retained). `first_cut` is a year of a cut; a
 * fraction is rounded up. Cuts repeat by the rotation. A negative year only sets the rhythm: -5 with a rotation of 25 years
 * gives 20, and the inventory is what the cut in year -5 left. INFINITY: never. NaN: cut when the oldest shoots reach the age
 * of cutting, rotation × cohorts. Without shoots the oldest trees decide, at rotation × (rotations survived by the oldest
 * retained trees + 1). If they are older, the cut is in year 1, so that year 0 is the stand as filed. Unknown age: never. */
unsigned ceduo_first_cut(const struct ceduo_stand *stand, double first_cut);

/* True if `year` is the year of the first cut or any number of whole rotations later. */
bool ceduo_stand_is_cut_year(const struct ceduo_stand *stand, double first_cut, unsigned year);

/* Return the stand density index of n kinds of stems, N(dq/25.4)^1.605, N per ha, dq the quadratic mean dbh in cm (Reineke
 * 1933); 0 without stems. */
double ceduo_stems_sdi(const struct ceduo_stems *stems, size_t n);

/* Return the share of the growing space that the trees of a grown stand take: their density index over growth.trees_sdi_max.
 * Above 1 the site cannot carry them; 0 without sdi_max. */
double ceduo_growing_space_used(const struct ceduo_growth *growth, const struct ceduo_stand *grown);

#endif
