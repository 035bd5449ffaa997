/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "energy.h"

#include <math.h>

#include "base/elementary.h"

double ceduo_dorren_energy(double dbh, double fracture_ratio)
{
    return fracture_ratio * 38.7 * ceduo_pow(dbh * 100, 2.31);
}

double ceduo_dorren_share(double u)
{
    double share = DORREN_SHARE_OF(ceduo_exp(DORREN_EXPONENT(u)));
    return 0.5 * (share + fabs(share)); /* 0 where it is negative: a quarter of all hits, which no processor guesses */
}

/* The integral of the cut share over 0…1. With y = 10^(8.007(u - 0.58)) the share is -0.046 + 1.026/(1 + y), whose
 * antiderivative is elementary; it is 0 from u0 on, where y = 1.026/0.046 - 1. */
double ceduo_dorren_mean_share(void)
{
    const double rate = DORREN_STEEPNESS * LN10, centre = DORREN_CENTRE;
    double u0 = centre + ceduo_log(DORREN_SPAN / -DORREN_LOW - 1) / rate;
    double end = fmin(1, u0);
    double inner = (ceduo_log1p(ceduo_exp(-rate * (0 - centre))) - ceduo_log1p(ceduo_exp(-rate * (end - centre)))) / rate;
    return DORREN_LOW * end + DORREN_SPAN * inner;
}

double ceduo_contact_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    const struct stem_energy energy = stem_energy_of(stand, stems);
    return stem_energy_mean(&energy);
}

bool ceduo_stand_takes_share(const struct ceduo_stand *stand)
{
    return stand->energy == CEDUO_INERTIA;
}

double ceduo_contact_share(const struct ceduo_stand *stand, const struct ceduo_stems *stems, double mass)
{
    const struct stem_energy energy = stem_energy_of(stand, stems);
    return stem_energy_mean_share(&energy, mass);
}
