/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENERGY_INERTIA_H
#define CEDUO_ENERGY_INERTIA_H

#include "ceduo/adc.h"
#include "scene/volume.h"

/* A plastic collision with the part of the stem that is set moving: of its energy E a rock of mass M loses
 * e(u)·E·m/(M + m), m = 33/140 of the stem's mass (the mass at its end that a cantilever moves with), e(u) the share of
 * Dorren et al. 2006. An assumption: every other law takes an amount that does not depend on the speed, this one a share.
 */
struct energy_inertia {
    double density; /* kg/m3 of green wood */
    double moved;   /* kg: of a contact that has no diameter */
    struct stem_volume volume;
};

#define INERTIA_MOVED (33.0 / 140)

static inline struct energy_inertia energy_inertia(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    return (struct energy_inertia){.density = stand->green_density, .volume = stem_volume_of(stand, stems)};
}

/* No amount is its own: it takes all of the share. */
static inline double inertia_mean(const struct energy_inertia *e)
{
    (void)e;
    return NAN;
}

static inline double inertia_hit(const struct energy_inertia *e, double dbh, double share)
{
    (void)e, (void)dbh, (void)share;
    return INFINITY;
}

static inline double inertia_mean_share(const struct energy_inertia *e, double mass)
{
    double moved = INERTIA_MOVED * e->density * stem_volume_mean(&e->volume, NULL);
    return ceduo_dorren_mean_share() * (moved / (mass + moved));
}

static inline double inertia_share(const struct energy_inertia *e, double mass, double dbh, double eccentricity)
{
    bool contact = isnan(dbh);
    double moved = contact ? e->moved : INERTIA_MOVED * e->density * stem_volume_one(&e->volume, dbh);
    return (contact ? ceduo_dorren_mean_share() : ceduo_dorren_share(eccentricity)) * (moved / (mass + moved));
}

/* That of a contact of which a rock of mass `mass` loses the share `share` on average. */
static inline struct energy_inertia inertia_of_contact(double share, double mass)
{
    double part = share / ceduo_dorren_mean_share();
    return (struct energy_inertia){.moved = mass * part / (1 - part)};
}

static inline bool inertia_by_eccentricity(const struct energy_inertia *e)
{
    (void)e;
    return false;
}

static inline unsigned inertia_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    enum ceduo_volume_from from;
    ceduo_stem_volume(stand, stems, &from);
    return CEDUO_WARN_INERTIA | (from == CEDUO_VOLUME_FORM_FACTOR ? CEDUO_WARN_FORM_FACTOR : 0u);
}

#endif
