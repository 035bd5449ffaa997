/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Dorren et al. 2006: FE·38.7·dbh_cm^2.31 J for a centred hit, less off the centre. */
#include "ceduo/simulate.h"
#include "energy.h"
#include "scene/species.h"

#define DBH_MIN 0.1 /* m: thinner stems are outside the data */

enum { RATIO /* FE */, DBH /* m, of the mean stem */, CENTRED /* J, mean stem hit centrally: most hits reuse it */ };

static void prepare(struct stem_energy *to, const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    to->values[RATIO] = ceduo_stand_fracture_ratio(stand);
    to->values[DBH] = stems->dbh;
    to->values[CENTRED] = ceduo_dorren_energy(stems->dbh, to->values[RATIO]);
}

static double mean(const struct stem_energy *e)
{
    return ceduo_dorren_mean_share() * e->values[CENTRED];
}

static double hit(const struct stem_energy *e, double dbh, double share)
{
    return share * (dbh == e->values[DBH] ? e->values[CENTRED] : ceduo_dorren_energy(dbh, e->values[RATIO]));
}

static bool by_eccentricity(const struct stem_energy *e)
{
    (void)e;
    return true;
}

static unsigned warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    size_t count;
    bool is_known = stand->species >= 0 && !isnan(ceduo_species_list(&count)[stand->species].fracture_ratio);
    return (stems->dbh < DBH_MIN ? CEDUO_WARNING_DORREN_THIN : 0u) |
           (isnan(stand->fracture_ratio) && !is_known ? CEDUO_WARNING_RATIO_ASSUMED : 0u);
}

const struct energy_law ceduo_energy_dorren = {
    .prepare = prepare, .mean = mean, .hit = hit, .by_eccentricity = by_eccentricity, .warnings = warnings};
