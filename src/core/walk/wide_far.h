/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search for landings on a long slope, of flights along +x: what land_far() of landing.h finds. The lanes take turns,
 * so that one works while what another needs is fetched, and each looks at all vertices of a block at once, or at all
 * blocks of the next larger one. Those that look at blocks of one size follow each other, so that no branch depends on it. */
#ifndef CEDUO_WIDE_FAR_H
#define CEDUO_WIDE_FAR_H

#include "wide_contact.h"

#define GROUP_LAST ((1 << GROUND_BITS) - 1)

/* A flight in one lane, and the last vertex (from 0) which it is known to clear. The vertices from there on are looked
 * at in blocks of a level. */
struct quest {
    double x, z, vz, inv;
    uint64_t vertex;
};

LANE double above_one(const struct wide *k, const struct quest *f, double x, double z)
{
    double t = (x - f->x) * f->inv;
    return (f->z + (f->vz - k->g->half_g * t) * t) - z;
}

LANE part_reals above_part(const struct wide *k, const struct quest *f, part_reals x, part_reals z)
{
    part_reals t = (x - PART_ALL(f->x)) * PART_ALL(f->inv);
    return (PART_ALL(f->z) + (PART_ALL(f->vz) - PART_ALL(k->g->half_g) * t) * t) - z;
}

/* At which of the next vertices the flight would be under the ground; bit 0 is the one at `to`. */
LANE unsigned vertices_under(const struct wide *k, const struct quest *f, const double (*to)[2])
{
    unsigned under = 0;
    for (unsigned at = 0; at < GROUND_GROUP; at += PART) {
        part_reals x, z;
        part_of_pairs(to + at, &x, &z);
        under |= PART_NONE_BUT(PART_AT_LEAST(above_part(k, f, x, z), PART_ALL(0))) << at;
    }
    return under;
}

/* Which blocks from `b` on the flight may touch. */
LANE unsigned blocks_under(const struct wide *k, const struct quest *f, const struct ground_block *b)
{
    unsigned under = 0;
    for (unsigned at = 0; at < GROUND_GROUP; at += PART, b += PART) {
        part_reals x, z, m, rise;
        part_of_fours(&b->x, &x, &z, &m, &rise);
        part_reals here = above_part(k, f, x, z);
        part_reals next = part_shifted(here, above_one(k, f, b[PART].x, b[PART].z));
        under |= PART_NONE_BUT(PART_BOTH(PART_AT_LEAST(here, rise), PART_AT_LEAST(next, rise))) << at;
    }
    return under;
}

/* Looks at the vertices up to the end of their block; whether the flight lands before one. */
LANE bool quest_vertices(const struct wide *k, struct quest *f)
{
    unsigned count = (GROUP_LAST + 1) - (f->vertex & GROUP_LAST);
    unsigned under = vertices_under(k, f, k->ground->place.pairs + f->vertex + 2) & ((1u << count) - 1);
    f->vertex += under ? (unsigned)__builtin_ctz(under) : count;
    return under;
}

/* Looks at the blocks up to the end of the larger one which they are part of; the level to go on at. */
LANE int quest_blocks(const struct wide *k, struct quest *f, int level)
{
    int shift = GROUND_BITS * level;
    uint64_t i = f->vertex >> shift, there = (k->g->n >> shift) - i, count = (GROUP_LAST + 1) - (i & GROUP_LAST);
    count = count < there ? count : there;
    unsigned under = blocks_under(k, f, k->g->levels[level] + i) & ((1u << count) - 1);
    uint64_t clear = under ? (unsigned)__builtin_ctz(under) : count;
    bool larger = !under && count > 0 && ((i + count) & GROUP_LAST) == 0 && level < k->g->top;
    bool down = under || count == there;
    f->vertex = (i + clear) << shift;
    return level + (larger ? 1 : down ? -1 : 0);
}

/* What the flight looks at when it is its turn again, and a little more of vertices. */
LANE void fetch_for(const struct wide *k, const struct quest *f, int level)
{
    const char *from = level == 0 ? (const char *)(k->ground->place.pairs + f->vertex + 2)
                                  : (const char *)(k->g->levels[level] + (f->vertex >> GROUND_BITS * level));
    for (size_t line = 0; line < sizeof(struct ground_block[8]) / 64; line++)
        __builtin_prefetch(from + 64 * line);
}

/* One look of each flight that is at a level; at[l]: those of level l. Returns those that have come to where they land. */
LANE unsigned look_at_level(const struct wide *k, struct quest *quests, int level, unsigned at[GROUND_LEVELS])
{
    unsigned left = at[level], landed = 0;
    at[level] = 0;
    for (; left; left &= left - 1) {
        size_t i = (size_t)__builtin_ctz(left);
        struct quest *f = &quests[i];
        if (level == 0 && quest_vertices(k, f)) {
            landed |= 1u << i;
            __builtin_prefetch(&k->g->segments[f->vertex]); /* where it lands */
            continue;
        }
        int next = level == 0 ? 1 : quest_blocks(k, f, level);
        at[next] |= 1u << i;
        fetch_for(k, f, next);
    }
    return landed;
}

/* Follows those of `lanes`, each from vertex p (from 1) that it clears, to the last that it clears: up to larger blocks
 * and down again, all flights of a level at a time. */
static __attribute__((noinline)) void search_far(const struct wide *k, unsigned lanes, struct quest *quests)
{
    unsigned at[GROUND_LEVELS] = {lanes};
    while (lanes) {
        for (int level = 0; level <= k->g->top; level++)
            lanes &= ~look_at_level(k, quests, level, at);
        for (int level = k->g->top; level >= 0; level--)
            lanes &= ~look_at_level(k, quests, level, at);
    }
}

/* The same for flights in their lanes; p: the vertex, from 1. */
LANE ints search_far_lanes(const struct wide *k, const struct rocks *r, reals inv, unsigned lanes, ints p)
{
    _Alignas(64) double x[LANES], z[LANES], vz[LANES], inverse[LANES];
    _Alignas(64) uint64_t vertex[LANES];
    struct quest quests[LANES];
    store(x, r->x);
    store(z, r->z);
    store(vz, r->vz);
    store(inverse, inv);
    store_ints(vertex, p);
    for (size_t i = 0; i < LANES; i++) {
        quests[i] = (struct quest){x[i], z[i], vz[i], inverse[i], vertex[i] - 1};
        if (lanes >> i & 1)
            fetch_for(k, &quests[i], 0);
    }
    search_far(k, lanes, quests);
    for (size_t i = 0; i < LANES; i++)
        vertex[i] = quests[i].vertex + 1;
    return load_ints(vertex);
}

#endif
