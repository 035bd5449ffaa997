/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ROTATION_H
#define CEDUO_ROTATION_H

#include <limits.h>

#include "ceduo/years.h"

/* Year of a cut that never comes. */
#define CEDUO_NEVER UINT_MAX

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

/* First datum without which the cuts of a stand cannot be computed. SHOOTS: growth.shoots with growth.shoots_old. AGE: growth
 * of the trees, their age or a cut year. */
enum cut_lack { CUT_LACKS_NOTHING, CUT_LACKS_CUTTING, CUT_LACKS_SHOOTS, CUT_LACKS_TREES, CUT_LACKS_AGE };
enum cut_lack ceduo_cut_lack(const struct ceduo_stand *stand, double first_cut);

/* Return the year >= 0 of the first cut of the inventory, or CEDUO_NEVER. `first_cut`: as in ceduo_stand_at(). */
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
