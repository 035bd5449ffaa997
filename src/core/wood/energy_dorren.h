/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENERGY_DORREN_H
#define CEDUO_ENERGY_DORREN_H

#include "ceduo/adc.h"

/* Dorren et al. 2006: FE·38.7·dbh_cm^2.31 J for a hit in the middle of the stem, less for one beside it. */
struct energy_dorren {
    double fracture_ratio, dbh; /* FE; m, of the mean stem */
    double whole;               /* J, of that stem hit in its middle: most hits are of stems that are all alike */
};

#define DORREN_DBH_LEAST 0.1 /* m: thinner stems lie outside the data */

/* The share of that at eccentricity u, not yet cut: LOW + SPAN/(1 + 10^(STEEPNESS (u - CENTRE))), by a power of e, for one
 * or many. */
#define DORREN_LOW             (-0.046)
#define DORREN_SPAN            1.026
#define DORREN_CENTRE          0.58
#define DORREN_STEEPNESS       8.007
#define LN10                   2.302585092994046
#define DORREN_EXPONENT(u)     (LN10 * ((DORREN_CENTRE - (u)) * -DORREN_STEEPNESS))
#define DORREN_SHARE_OF(power) (DORREN_LOW + DORREN_SPAN / (1.0 + (power)))

static inline struct energy_dorren energy_dorren(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    double ratio = ceduo_stand_fracture_ratio(stand);
    return (struct energy_dorren){ratio, stems->dbh, ceduo_dorren_energy(stems->dbh, ratio)};
}

static inline double dorren_mean(const struct energy_dorren *e)
{
    return ceduo_dorren_mean_share() * e->whole;
}

static inline double dorren_hit(const struct energy_dorren *e, double dbh, double share)
{
    double whole = dbh == e->dbh ? e->whole : ceduo_dorren_energy(dbh, e->fracture_ratio);
    return share * whole;
}

static inline double dorren_mean_share(const struct energy_dorren *e, double mass)
{
    (void)e, (void)mass;
    return 0;
}

static inline double dorren_share(const struct energy_dorren *e, double mass, double dbh, double eccentricity)
{
    (void)e, (void)mass, (void)dbh, (void)eccentricity;
    return 1;
}

static inline bool dorren_by_eccentricity(const struct energy_dorren *e)
{
    (void)e;
    return true;
}

static inline unsigned dorren_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    size_t count;
    bool known = stand->species >= 0 && !isnan(ceduo_species_list(&count)[stand->species].fracture_ratio);
    return (stems->dbh < DORREN_DBH_LEAST ? CEDUO_WARN_DORREN_THIN : 0u) |
           (isnan(stand->fracture_ratio) && !known ? CEDUO_WARN_RATIO_ASSUMED : 0u);
}

#endif
