/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ROTATION_H
#define CEDUO_ROTATION_H

#include <limits.h>

#include "stand.h"
#include "status.h"

/* A stand in the years to come. Every year is computed by itself, in closed form: nothing is accumulated.
 *
 * Year 0 is the stand as filed, the inventory; until its first cut it grows. Each of its cohorts and classes has an
 * age: its own where that is given and above 0, otherwise the age at which its curve has its dbh; one that is as
 * thick as the curve ever gets, or thicker, grows no more. After t years, from the age a:
 *     dbh and its deviation × d(a + t)/d(a), height × h(a + t)/h(a), a given volume with dbh2 × height,
 *     shoots × n(a + t)/n(a), all by one factor more where less than one a stool would be left; trees stay as many.
 * From the first cut on the ages are those that the cuts leave, t years after the last one:
 *     trees of class j (1, 2 …): cutting.stay_per_ha[j - 1], j·rotation + t years old;
 *     shoots of K cohorts: t, rotation + t … (K - 1)·rotation + t years old, n(age)/K of each on a stool.
 * In the year of a cut itself the youngest shoots are not there yet: with one cohort no stool stands. Their volume
 * is that of species, dbh and height; all of a cohort are alike. Nothing but these trees and shoots comes up, so a
 * stand without stools has none after a cut either.
 *     d(t) = D(1 - exp(-kt)), h(t) = H(1 - exp(-mt)), n(t) = n_old + (n_young - n_old)exp(-t/5)
 * are assumed, as are all their constants.
 *
 * An inventory that has one cohort of shoots less than its stools have after a cut was cut just before year 0: from
 * year 1 on its new shoots are there, n(t)/K on each stool.
 *
 * Stumps are there for growth.stump_years after a cut (0: never); before the first cut counted from the age of the youngest
 * shoots. Logs stay. Trees that a cut leaves stand in groups as the first class of the inventory that does.
 *
 * Trees and shoots share the growing space (assumed): in computed years (all but year 0 as filed) the shoots, and only
 * they, are thinned by one factor to growth.sdi_most·(1 - ceduo_growing_space_used()). If less than one a stool is left, stools die:
 * as many stand as there are shoots, with one shoot each. As every year is computed by itself, a cut finds all stools of the
 * inventory again. */

#define CEDUO_YEAR_MAX 100000 /* the last year of a window */

/* Year of a cut that never comes. */
#define CEDUO_NEVER UINT_MAX

/* The stand of one year. It has a growth and a cutting no more: it is not to be grown again. */
struct ceduo_grown_stand {
    struct ceduo_stand stand;
    struct ceduo_stems *stems; /* its shoots, then its trees: owned; shoots and trees from young to old after a cut */
};

/* Makes the stand of `year` in *out, which ceduo_grown_stand_release() frees. What out was before does not matter.
 * `first_cut`: as in ceduo_first_cut(). A stratum whose curve is unknown stays as it is, and with both unknown, or in
 * year 0 if no cut falls in it, so does all: bit for bit. The year of a cut is the stand after it.
 * CEDUO_NO_MEMORY, with nothing to free, or CEDUO_OK. */
enum ceduo_status ceduo_stand_at(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                 struct ceduo_grown_stand *out);
void ceduo_grown_stand_release(struct ceduo_grown_stand *grown);

/* What stands at the end of a year of a cut before it is felled; after the first cut a stand that is a whole rotation
 * old. As ceduo_stand_at(). */
enum ceduo_status ceduo_stand_before_cut(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                         struct ceduo_grown_stand *out);

/* Height (m) of a stem of `dbh` m on its curve; NaN where the curve is unknown or never gets so thick. */
double ceduo_curve_height(const struct ceduo_curve *curve, double dbh);

/* Kind i of the stems of the inventory, shoots first, beside its own curve: its age (years), its basal area and that of as many
 * stems on the curve at that age (m2/ha). The age is its own; for the only kind of shoots it is otherwise the years since a cut
 * before year 0. by_curve is NaN if the age or the curve is unknown. */
struct ceduo_beside_curve {
    double age, basal_area, by_curve;
};
struct ceduo_beside_curve ceduo_stems_beside_curve(const struct ceduo_stand *stand, double first_cut, size_t i);

/* Share by which the basal area may differ from the curve's before a page warns (assumed). */
#define CEDUO_OFF_CURVE 0.2

/* Whether its stools were cut just before year 0, and whether anything in it changes but by cuts. */
bool ceduo_stand_sprouts(const struct ceduo_stand *stand);
bool ceduo_stand_grows(const struct ceduo_stand *stand);

/* The year, from 0 on, of the first cut that the inventory sees, CEDUO_NEVER where there is none: without a
 * rotation, or where the growth of what comes after a cut (shoots if there are stools, trees if any stay) is
 * unknown. `first_cut`: a year in which a cut falls; of a fraction the next whole year. Cuts follow each other by
 * the rotation, and where it is negative only its rhythm matters: -5 with 25 years is 20, the inventory being what
 * that cut left. INFINITY: never. NaN: when the oldest shoots reach the age of cutting, rotation × cohorts; without
 * shoots when the oldest trees do, rotation × (rotations that the oldest to stay have seen + 1); in year 1 where
 * they are older, so that year 0 is the stand as filed; never where no age is known. */
unsigned ceduo_first_cut(const struct ceduo_stand *stand, double first_cut);

/* Whether a cut falls in `year`: the first one or one that is whole rotations later. */
bool ceduo_is_cut_year(const struct ceduo_stand *stand, double first_cut, unsigned year);

/* Stand density index of n kinds of stems, N(dq/25.4)^1.605, N per ha, dq the quadratic mean dbh in cm (Reineke 1933); 0
 * without stems. */
double ceduo_stems_sdi(const struct ceduo_stems *stems, size_t n);

/* The share of the growing space that the trees of a grown stand take: their density index over growth.trees_sdi_most. Above
 * 1 they are more than the ground bears; 0 without sdi_most. */
double ceduo_growing_space_used(const struct ceduo_growth *growth, const struct ceduo_stand *grown);

#endif
