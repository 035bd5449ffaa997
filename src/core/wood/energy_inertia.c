/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plastic collision with the part of the stem that is set moving: of its energy E a rock of mass M loses
 * e(u)·E·m/(M + m), m = 33/140 of the stem's mass (the mass at its end that a cantilever moves with), e(u) the share of
 * Dorren et al. 2006. An assumption: every other law takes an amount that does not depend on the speed, this one a share. */
#include "energy.h"

#define MOVED_SHARE (33.0 / 140)

enum { DENSITY /* kg/m3 of green wood */, MOVED /* kg: of a contact that has no diameter */ };

static void prepare(struct stem_energy *to, const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    to->volume = stem_volume_of(stand, stems);
    to->of[DENSITY] = stand->green_density;
}

static void prepare_contact(struct stem_energy *to, double share, double mass)
{
    double part = share / ceduo_dorren_mean_share();
    to->of[MOVED] = mass * part / (1 - part);
}

static double mean_share(const struct stem_energy *e, double mass)
{
    double moved = MOVED_SHARE * e->of[DENSITY] * stem_volume_mean(&e->volume, NULL);
    return ceduo_dorren_mean_share() * (moved / (mass + moved));
}

static double share(const struct stem_energy *e, double mass, double dbh, double eccentricity)
{
    bool contact = isnan(dbh);
    double moved = contact ? e->of[MOVED] : MOVED_SHARE * e->of[DENSITY] * stem_volume_one(&e->volume, dbh);
    return (contact ? ceduo_dorren_mean_share() : ceduo_dorren_share(eccentricity)) * (moved / (mass + moved));
}

static unsigned warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    return CEDUO_WARN_INERTIA | ceduo_volume_warning(stand, stems);
}

const struct energy_law ceduo_energy_inertia = {
    .prepare = prepare, .prepare_contact = prepare_contact, .mean_share = mean_share, .share = share, .warnings = warnings};
