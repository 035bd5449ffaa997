/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENERGY_BRAUNER_H
#define CEDUO_ENERGY_BRAUNER_H

#include "ceduo/adc.h"
#include "scene/volume.h"

/* Eq. 3 of Ciabocco et al. 2009, after Brauner et al. 2005: W = V·U, the volume of the stem times the work of breaking,
 * wherever the stem is hit; or the share of it that Dorren et al. 2006 found beside the middle. */
struct energy_brauner {
    double by_eccentricity; /* 0 or 1 */
    double u;               /* J/m3 */
    struct stem_volume volume;
};

static inline struct energy_brauner energy_brauner(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    return (struct energy_brauner){.by_eccentricity = stand->offset == CEDUO_OFFSET_BY_ECCENTRICITY,
                                   .u = ceduo_stand_u(stand),
                                   .volume = stem_volume_of(stand, stems)};
}

static inline double brauner_mean(const struct energy_brauner *e)
{
    double whole = stem_volume_mean(&e->volume, NULL) * e->u;
    return e->by_eccentricity > 0 ? ceduo_dorren_mean_share() * whole : whole;
}

static inline double brauner_hit(const struct energy_brauner *e, double dbh, double share)
{
    double whole = stem_volume_one(&e->volume, dbh) * e->u;
    return e->by_eccentricity > 0 ? share * whole : whole;
}

static inline double brauner_mean_share(const struct energy_brauner *e, double mass)
{
    (void)e, (void)mass;
    return 0;
}

static inline double brauner_share(const struct energy_brauner *e, double mass, double dbh, double eccentricity)
{
    (void)e, (void)mass, (void)dbh, (void)eccentricity;
    return 1;
}

static inline bool brauner_by_eccentricity(const struct energy_brauner *e)
{
    return e->by_eccentricity > 0;
}

static inline unsigned brauner_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    enum ceduo_volume_from from;
    size_t count;
    bool known = stand->species >= 0 && ceduo_species_list(&count)[stand->species].u_literature;
    ceduo_stem_volume(stand, stems, &from);
    return (from == CEDUO_VOLUME_FORM_FACTOR ? CEDUO_WARN_FORM_FACTOR : 0u) |
           (isnan(stand->u) && !known ? CEDUO_WARN_U_ASSUMED : 0u);
}

#endif
