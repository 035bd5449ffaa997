/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eq. 3 of Ciabocco et al. 2009, after Brauner et al. 2005: W = V·U, the volume of the stem times the work of breaking, at any
 * eccentricity; or reduced off the centre by the share of Dorren et al. 2006. */
#include "ceduo/simulate.h"
#include "energy.h"
#include "scene/species.h"

enum { U /* J/m3 */, OFFSET /* 1: by eccentricity */ };

static void prepare(struct stem_energy *to, const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    to->volume = make_stem_volume(stand, stems);
    to->values[U] = ceduo_stand_u(stand);
    to->values[OFFSET] = stand->offset == CEDUO_ENERGY_OFFSET_BY_ECCENTRICITY;
}

static bool by_eccentricity(const struct stem_energy *e)
{
    return e->values[OFFSET] > 0;
}

static double mean(const struct stem_energy *e)
{
    double centred = stem_volume_mean(&e->volume, NULL) * e->values[U];
    return by_eccentricity(e) ? ceduo_dorren_mean_share() * centred : centred;
}

static double hit(const struct stem_energy *e, double dbh, double share)
{
    double centred = stem_volume_one(&e->volume, dbh) * e->values[U];
    return by_eccentricity(e) ? share * centred : centred;
}

static unsigned warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    size_t count;
    bool is_known = stand->species >= 0 && ceduo_species_list(&count)[stand->species].u_literature;
    return ceduo_volume_warning(stand, stems) | (isnan(stand->u) && !is_known ? CEDUO_WARNING_U_ASSUMED : 0u);
}

const struct energy_law ceduo_energy_brauner = {
    .prepare = prepare, .mean = mean, .hit = hit, .by_eccentricity = by_eccentricity, .warnings = warnings};
