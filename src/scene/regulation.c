/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>

#include "regulation.h"
#include "stand.h"

/* Return the first rule that applies to the stand. */
static const struct ceduo_regulation_item *find_item(const struct ceduo_regulation_item *items, size_t n,
                                                     const struct ceduo_stand *stand)
{
    for (size_t i = 0; stand->species >= 0 && i < n; i++) {
        bool species = items[i].species_count == 0;
        for (size_t k = 0; k < items[i].species_count; k++)
            species |= ceduo_species_find(items[i].species[k]) == stand->species;
        if (species && (items[i].system < 0 || items[i].system == (int)stand->system))
            return &items[i];
    }
    return NULL;
}

static bool meets(const struct ceduo_regulation_item *item, double value)
{
    return item && value >= item->min && !(value > item->max);
}

struct ceduo_compliance ceduo_regulation_check(const struct ceduo_regulation *r, const struct ceduo_stand *stand)
{
    double standards = stand->cutting.retained_count > 0 ? ceduo_stand_retained_per_ha(stand) : ceduo_stand_trees(stand);
    struct ceduo_compliance c = {.standards = standards, .turn = NAN};
    if (!r->name || stand->system == CEDUO_SYSTEM_HIGH_FOREST || stand->system == CEDUO_SYSTEM_BARE)
        return c;
    if (stand->cutting.rotation > 0)
        c.turn = (double)stand->cutting.rotation * (stand->cutting.cohorts > 1 ? stand->cutting.cohorts : 1);
    c.regulation = r;
    c.standards_item = find_item(r->standards, r->standards_count, stand);
    c.turn_item = find_item(r->turns, r->turns_count, stand);
    c.standards_met = meets(c.standards_item, c.standards);
    c.turn_met = meets(c.turn_item, c.turn);
    return c;
}
