/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/stand.h"

#include <math.h>

#include "energy.h"

static const double PI = 3.14159265358979323846;

static double sum_per_ha(const struct ceduo_stems *stems, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += stems[i].per_ha;
    return sum;
}

double ceduo_stand_shoots(const struct ceduo_stand *stand)
{
    return sum_per_ha(stand->shoots, stand->shoots_count);
}

double ceduo_stand_trees(const struct ceduo_stand *stand)
{
    return sum_per_ha(stand->trees, stand->trees_count);
}

static double basal_area(const struct ceduo_stems *stems, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) /* the mean of d2 is d2 + sd2 */
        sum += stems[i].per_ha * PI / 4 * (stems[i].dbh * stems[i].dbh + stems[i].dbh_sd * stems[i].dbh_sd);
    return sum;
}

double ceduo_stand_basal_area(const struct ceduo_stand *stand)
{
    return basal_area(stand->shoots, stand->shoots_count) + basal_area(stand->trees, stand->trees_count);
}

bool ceduo_stand_is_bare(const struct ceduo_stand *stand)
{
    return stand->shoots_count == 0 && stand->trees_count == 0;
}

double ceduo_stem_volume(const struct ceduo_stand *stand, const struct ceduo_stems *stems, enum ceduo_volume_from *from)
{
    const struct stem_volume volume = stem_volume_of(stand, stems);
    return stem_volume_mean(&volume, from);
}

double ceduo_dorren_energy(double dbh, double fracture_ratio)
{
    return fracture_ratio * 38.7 * pow(dbh * 100, 2.31);
}

double ceduo_dorren_share(double u)
{
    double share = -0.046 + 1.026 / (1 + pow(10, (0.58 - u) * -8.007));
    return fmin(1, fmax(0, share));
}

/* The integral of the cut share over 0…1. With y = 10^(8.007(u - 0.58)) the share is -0.046 + 1.026/(1 + y), whose
 * antiderivative is elementary; it is 0 from u0 on, where y = 1.026/0.046 - 1. */
double ceduo_dorren_mean_share(void)
{
    const double rate = 8.007 * log(10), low = -0.046, span = 1.026, centre = 0.58;
    double u0 = centre + log(span / -low - 1) / rate;
    double end = fmin(1, u0);
    double inner = (log1p(exp(-rate * (0 - centre))) - log1p(exp(-rate * (end - centre)))) / rate;
    return low * end + span * inner;
}

double ceduo_contact_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    const struct stem_energy energy = stem_energy_of(stand, stems);
    return stem_energy_mean(&energy);
}
