/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The blocks that come down: whether their sizes fit together, and how many they are in all. */
#include <math.h>

#include "base/language.h"
#include "derive.h"

static bool is_single(const struct deriver *d)
{
    return ceduo_node_get(d->root, "blocks")->kind == NODE_MAP;
}

static const char *path_of(struct deriver *d, size_t i, const char *key)
{
    return is_single(d) ? ceduo_derive_text(d, "blocks.%s", key) : ceduo_derive_text(d, "blocks[%zu].%s", i, key);
}

static bool check_volumes(struct deriver *d, const struct ceduo_block_class *b, size_t i)
{
    const char *path = path_of(d, i, "volume_m3");
    if (b->volumes_count != 2) {
        ceduo_derive_complain(d, path, _("expected two volumes, the smallest and the largest: [lo, hi]"));
        return false;
    }
    if (!(b->volumes[0] < b->volumes[1])) {
        ceduo_derive_refuse(d, path, "", _("%s m3 is not below %s m3; write the smaller volume first"), b->volumes[0],
                            b->volumes[1]);
        return false;
    }
    return true;
}

/* Of those before it none may hold the same sizes. */
static void check_overlap(struct deriver *d, size_t i)
{
    const struct ceduo_block_class *b = d->draft.scene.blocks;
    for (size_t k = 0; k < i; k++)
        if (b[i].volumes[0] < b[k].volumes[1] && b[k].volumes[0] < b[i].volumes[1]) {
            ceduo_derive_refuse(d, path_of(d, i, "volume_m3"), "",
                                _("the class overlaps one before it, from %s to %s m3; let them touch at most"),
                                b[k].volumes[0], b[k].volumes[1]);
            return;
        }
}

/* A sphere has no other proportions: a spread of its size would change nothing. */
static void check_rock(struct deriver *d)
{
    const struct ceduo_rock_def *r = &d->draft.scene.rock;
    bool spreads = r->diameter.spread > 0 || r->volume.spread > 0 || r->mass.spread > 0;
    if (r->shape == CEDUO_SPHERE && spreads && ceduo_derive_sound(d, "rock"))
        ceduo_derive_complain(d, "rock", _("blocks say how large the rocks are; give the size without a spread"));
}

static void check_others(struct deriver *d)
{
    if (ceduo_node_get(d->root, "rocks_per_year"))
        ceduo_derive_complain(d, "rocks_per_year", _("blocks already say this; keep one of the two"));
    if (is_single(d) && !ceduo_derive_given(d, "blocks", "exponent"))
        ceduo_derive_complain(d, "blocks",
                              _("'exponent' is missing: the number of blocks above a volume v goes with v^-exponent"));
    if (d->draft.scene.simulation.rocks > CEDUO_SIZED_ROCKS_MOST)
        ceduo_derive_refuse(d, "simulation.rocks", "", _("with blocks each rock is kept: at most %s rocks"),
                            CEDUO_SIZED_ROCKS_MOST, 0);
}

void ceduo_derive_blocks(struct deriver *d)
{
    struct ceduo_scene *scene = &d->draft.scene;
    size_t n = scene->blocks_count;
    if (!ceduo_node_get(d->root, "blocks"))
        return;
    if (n == 0 && ceduo_derive_known(d, "blocks"))
        ceduo_derive_complain(d, "blocks", _("name at least one class of blocks, or remove the key"));
    check_others(d);
    check_rock(d);
    if (ceduo_derive_too_many(d, "blocks", n) || !ceduo_derive_sound(d, "blocks"))
        return;
    bool good = true;
    for (size_t i = 0; i < n; i++)
        good &= check_volumes(d, &scene->blocks[i], i);
    scene->rocks_per_year = n > 0 ? 0 : NAN;
    for (size_t i = 0; i < n; i++) {
        if (good)
            check_overlap(d, i);
        scene->rocks_per_year += scene->blocks[i].per_year;
    }
}
