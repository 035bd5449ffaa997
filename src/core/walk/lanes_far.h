/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The search for landings on a long slope, of flights along +x: what land_far() of landing.h finds. The lanes take turns,
 * so that one works while what another needs is fetched, and each looks at all vertices of a block at once, or at all
 * blocks of the next larger one. Those that look at blocks of one size follow each other, so that no branch depends on it. */
#ifndef CEDUO_LANES_FAR_H
#define CEDUO_LANES_FAR_H

#include "lanes_contact.h"

#define GROUP_LAST ((1 << GROUND_BITS) - 1)

/* A flight in one lane, and the last vertex (from 0) which it is known to clear. The vertices from there on are looked
 * at in blocks of a level. */
struct far_search {
    double x, z, vz, inv;
    uint64_t vertex;
};

/* How high it is above points. */
FORCE_INLINE real above_all(const struct lanes *k, const struct far_search *f, real x, real z)
{
    real t = (x - f->x) * f->inv;
    return height_after(splat(f->z), splat(f->vz), k->g->half_g, t) - z;
}

/* Which blocks from `b` on the flight may touch. */
FORCE_INLINE unsigned blocks_under(const struct lanes *k, const struct far_search *f, const struct ground_block *b)
{
    unsigned under = 0;
    for (unsigned at = 0; at < GROUND_GROUP; at += REAL_LANES, b += REAL_LANES) {
        real x, z, m, rise;
        load_fours((const double(*)[2]) & b->x, &x, &z, &m, &rise);
        real here = above_all(k, f, x, z);
        double t = (b[REAL_LANES].x - f->x) * f->inv;
        real next = shift_in(here, (f->z + (f->vz - k->g->half_g * t) * t) - b[REAL_LANES].z);
        under |= (REGISTER & ~lane_bits(at_least(here, rise) & at_least(next, rise))) << at;
    }
    return under;
}

/* Looks at the vertices up to the end of their block; whether the flight lands before one. */
FORCE_INLINE bool search_vertices(const struct lanes *k, struct far_search *f)
{
    const double(*to)[2] = k->ground->place.pairs + f->vertex + 2;
    unsigned count = (GROUP_LAST + 1) - (f->vertex & GROUP_LAST), under = 0; /* bit 0 is the vertex at `to` */
    for (unsigned at = 0; at < GROUND_GROUP; at += REAL_LANES) {
        real x, z;
        load_pairs(to + at, &x, &z);
        under |= (REGISTER & ~lane_bits(at_least(above_all(k, f, x, z), splat(0)))) << at;
    }
    under &= (1u << count) - 1;
    f->vertex += under ? (unsigned)__builtin_ctz(under) : count;
    return under;
}

/* Looks at the blocks up to the end of the larger one which they are part of; the level to go on at. */
FORCE_INLINE int search_blocks(const struct lanes *k, struct far_search *f, int level)
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
FORCE_INLINE void fetch_for(const struct lanes *k, const struct far_search *f, int level)
{
    const char *from = level == 0 ? (const char *)(k->ground->place.pairs + f->vertex + 2)
                                  : (const char *)(k->g->levels[level] + (f->vertex >> GROUND_BITS * level));
    for (size_t line = 0; line < sizeof(struct ground_block[8]) / 64; line++)
        __builtin_prefetch(from + 64 * line);
}

/* One look of each flight that is at a level; at[l]: those of level l. Returns those that have come to where they land. */
FORCE_INLINE unsigned look_at_level(const struct lanes *k, struct far_search *searches, int level, unsigned at[GROUND_LEVELS])
{
    unsigned left = at[level], landed = 0;
    at[level] = 0;
    for (; left; left &= left - 1) {
        size_t i = (size_t)__builtin_ctz(left);
        struct far_search *f = &searches[i];
        if (level == 0 && search_vertices(k, f)) {
            landed |= 1u << i;
            __builtin_prefetch(&k->g->segments[f->vertex]); /* where it lands */
            continue;
        }
        int next = level == 0 ? 1 : search_blocks(k, f, level);
        at[next] |= 1u << i;
        fetch_for(k, f, next);
    }
    return landed;
}

/* Follows those of `lanes`, each from its vertex, which it clears, to the last that it clears: up to larger blocks and down
 * again, all flights of a level at a time. */
NOINLINE void search_far(struct lanes *k, unsigned lanes)
{
    struct far_search searches[LANES];
    unsigned at[GROUND_LEVELS] = {lanes};
    for (size_t i = 0; i < LANES; i++) {
        searches[i] = (struct far_search){k->x[i], k->z[i], k->vz[i], k->inv[i], k->vertex[i] - 1};
        if (lanes >> i & 1)
            fetch_for(k, &searches[i], 0);
    }
    for (unsigned left = lanes; left;) {
        for (int level = 0; level <= k->g->top; level++)
            left &= ~look_at_level(k, searches, level, at);
        for (int level = k->g->top; level >= 0; level--)
            left &= ~look_at_level(k, searches, level, at);
    }
    for (; lanes; lanes &= lanes - 1) {
        size_t i = (size_t)__builtin_ctz(lanes);
        k->vertex[i] = searches[i].vertex + 1;
    }
}

#endif
