/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The blocks that come down: whether their sizes fit together, and how many they are in all. */
#include <math.h>

#include "base/language.h"
#include "validate.h"

static void check_others(struct validator *v, const struct node *blocks)
{
    const struct ceduo_rock_def *r = &v->draft.scene.rock;
    bool spreads = r->diameter.spread > 0 || r->volume.spread > 0 || r->mass.spread > 0;
    if (ceduo_node_get(v->root, "rocks_per_year"))
        ceduo_complain(v, "rocks_per_year", "", _("blocks already say this; keep one of the two"));
    if (blocks->kind == NODE_MAP && !ceduo_is_given(v, "blocks", blocks, "exponent"))
        ceduo_complain(v, "blocks", "",
                       _("'exponent' is missing: the number of blocks above a volume v goes with v^-exponent"));
    if (v->draft.scene.simulation.rocks > CEDUO_SIZED_ROCKS_MOST)
        ceduo_complain(v, "simulation.rocks", "", _("with blocks each rock is kept: at most %s rocks"),
                       ceduo_decimal(v, CEDUO_SIZED_ROCKS_MOST));
    if (r->shape == CEDUO_SPHERE && spreads && ceduo_is_sound(v, "rock")) /* whose proportions are always the same */
        ceduo_complain(v, "rock", "", _("blocks say how large the rocks are; give the size without a spread"));
}

void ceduo_validate_blocks(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    const struct node *blocks = ceduo_node_get(v->root, "blocks");
    size_t n = scene->blocks_count;
    if (!blocks)
        return;
    if (n == 0 && ceduo_is_known(v, "blocks"))
        ceduo_complain(v, "blocks", "", _("name at least one class of blocks, or remove the key"));
    check_others(v, blocks);
    if (ceduo_is_too_long(v, "blocks", n) || !ceduo_is_sound(v, "blocks"))
        return;
    bool good = true, single = blocks->kind == NODE_MAP;
    scene->rocks_per_year = n > 0 ? 0 : NAN;
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_block_class *b = &scene->blocks[i];
        const char *path = single ? "blocks.volume_m3" : ceduo_format(v, "blocks[%zu].volume_m3", i);
        bool two = b->volumes_count == 2, rise = two && b->volumes[0] < b->volumes[1];
        scene->rocks_per_year += b->per_year;
        if (!two)
            ceduo_complain(v, path, "", _("expected two volumes, the smallest and the largest: [lo, hi]"));
        else if (!rise)
            ceduo_complain(v, path, "", _("%s m3 is not below %s m3; write the smaller volume first"),
                           ceduo_decimal(v, b->volumes[0]), ceduo_decimal(v, b->volumes[1]));
        good &= rise;
    }
    for (size_t i = 0; i < n && good; i++) { /* of those before it none may hold the same sizes */
        const struct ceduo_block_class *b = scene->blocks;
        size_t k = 0;
        while (k < i && !(b[i].volumes[0] < b[k].volumes[1] && b[k].volumes[0] < b[i].volumes[1]))
            k++;
        if (k < i)
            ceduo_complain(v, ceduo_format(v, "blocks[%zu].volume_m3", i), "",
                           _("the class overlaps one before it, from %s to %s m3; let them touch at most"),
                           ceduo_decimal(v, b[k].volumes[0]), ceduo_decimal(v, b[k].volumes[1]));
    }
}
