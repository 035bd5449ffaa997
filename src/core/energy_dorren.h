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

static inline struct energy_dorren energy_dorren(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    double ratio = ceduo_stand_fracture_ratio(stand);
    return (struct energy_dorren){ratio, stems->dbh, ceduo_dorren_energy(stems->dbh, ratio)};
}

static inline double dorren_mean(const struct energy_dorren *e)
{
    return ceduo_dorren_mean_share() * e->whole;
}

static inline double dorren_hit(const struct energy_dorren *e, double dbh, double eccentricity)
{
    double whole = dbh == e->dbh ? e->whole : ceduo_dorren_energy(dbh, e->fracture_ratio);
    return ceduo_dorren_share(eccentricity) * whole;
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

static inline bool dorren_alike(const struct energy_dorren *e)
{
    (void)e;
    return false;
}

static inline unsigned dorren_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    size_t count;
    bool known = stand->species >= 0 && !isnan(ceduo_species_list(&count)[stand->species].fracture_ratio);
    return (stems->dbh < DORREN_DBH_LEAST ? CEDUO_WARN_DORREN_THIN : 0u) |
           (isnan(stand->fracture_ratio) && !known ? CEDUO_WARN_RATIO_ASSUMED : 0u);
}

#endif
