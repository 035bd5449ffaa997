/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>

#include "stand.h"
#include "volume.h"

void ceduo_stand_update_shoot_density(struct ceduo_stand *stand)
{
    for (size_t i = 0; i < stand->shoots_count; i++)
        if (stand->shoots[i].per_stool > 0)
            stand->shoots[i].per_ha = stand->shoots[i].per_stool * stand->stools_per_ha;
}

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

double ceduo_stand_retained_per_ha(const struct ceduo_stand *stand)
{
    double sum = 0;
    for (size_t i = 0; i < stand->cutting.retained_count; i++)
        sum += stand->cutting.stay_per_ha[i];
    return sum;
}

static double basal_area(const struct ceduo_stems *stems, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) /* the mean of d2 is d2 + sd2 */
        sum += stems[i].per_ha * M_PI / 4 * (stems[i].dbh * stems[i].dbh + stems[i].dbh_sd * stems[i].dbh_sd);
    return sum;
}

double ceduo_stand_basal_area(const struct ceduo_stand *stand)
{
    return basal_area(stand->shoots, stand->shoots_count) + basal_area(stand->trees, stand->trees_count);
}

bool ceduo_stand_has_shoots(const struct ceduo_stand *stand)
{
    return ceduo_stand_shoots(stand) > 0;
}

bool ceduo_stand_has_stems(const struct ceduo_stand *stand)
{
    return ceduo_stand_has_shoots(stand) || ceduo_stand_trees(stand) > 0;
}

bool ceduo_stand_is_bare(const struct ceduo_stand *stand)
{
    return !ceduo_stand_has_stems(stand) && !(stand->stumps.per_ha > 0) && !(stand->logs.per_ha > 0);
}

bool ceduo_stems_are_grouped(const struct ceduo_stems *stems)
{
    return stems->group > 1 && stems->per_ha > 0;
}

double ceduo_stem_volume(const struct ceduo_stand *stand, const struct ceduo_stems *stems, enum ceduo_volume_from *from)
{
    const struct stem_volume volume = make_stem_volume(stand, stems);
    return stem_volume_mean(&volume, from);
}
