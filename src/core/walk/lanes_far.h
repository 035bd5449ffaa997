/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Search for landings on a long slope, for flights along +x; the result is that of land_from_vertex_chunked(). The lanes
 * alternate, so that one is computed while data of another are prefetched. Each step tests all vertices of a chunk at once, or
 * all chunks of the next larger one. Lanes at chunks of the same size follow each other, to avoid branches. */
#ifndef CEDUO_LANES_FAR_H
#define CEDUO_LANES_FAR_H

#include "lanes_contact.h"

#define GROUP_LAST ((1 << GROUND_BITS) - 1)

/* A flight in one lane, and the last vertex (from 0) that it is known to clear. The search continues from there. */
struct far_search {
    double x, z, vz, inv;
    uint64_t vertex;
};

/* Return the heights of the flight above points. */
FORCE_INLINE real heights_above(const struct lanes *k, const struct far_search *f, real x, real z)
{
    real t = (x - f->x) * f->inv;
    return height_at_time(splat(f->z), splat(f->vz), k->g->half_g, t) - z;
}

/* Return which chunks from `b` on the flight may touch. */
FORCE_INLINE unsigned chunks_touched(const struct lanes *k, const struct far_search *f, const struct ground_chunk *b)
{
    unsigned touched = 0;
    for (unsigned offset = 0; offset < GROUND_GROUP; offset += REAL_LANES, b += REAL_LANES) {
        real x, z, m, rise;
        load_fours((const double(*)[2]) & b->x, &x, &z, &m, &rise);
        real height = heights_above(k, f, x, z);
        double t = (b[REAL_LANES].x - f->x) * f->inv;
        real next_height = shift_in(height, (f->z + (f->vz - k->g->half_g * t) * t) - b[REAL_LANES].z);
        touched |= (REGISTER & ~lane_bits(greater_equal(height, rise) & greater_equal(next_height, rise))) << offset;
    }
    return touched;
}

/* Test the vertices up to the end of their chunk. True if the flight lands before one. */
FORCE_INLINE bool search_vertices(const struct lanes *k, struct far_search *f)
{
    const double(*to)[2] = k->ground->vertices.pairs + f->vertex + 2;
    unsigned count = (GROUP_LAST + 1) - (f->vertex & GROUP_LAST), touched = 0; /* bit 0 is the vertex at `to` */
    for (unsigned offset = 0; offset < GROUND_GROUP; offset += REAL_LANES) {
        real x, z;
        load_pairs(to + offset, &x, &z);
        touched |= (REGISTER & ~lane_bits(greater_equal(heights_above(k, f, x, z), splat(0)))) << offset;
    }
    touched &= (1u << count) - 1;
    f->vertex += touched ? (unsigned)__builtin_ctz(touched) : count;
    return touched;
}

/* Test the chunks up to the end of the enclosing larger chunk. Return the level to continue at. */
FORCE_INLINE int search_chunks(const struct lanes *k, struct far_search *f, int level)
{
    int shift = GROUND_BITS * level;
    uint64_t i = f->vertex >> shift, available = (k->g->n >> shift) - i, count = (GROUP_LAST + 1) - (i & GROUP_LAST);
    count = count < available ? count : available;
    unsigned touched = chunks_touched(k, f, k->g->levels[level] + i) & ((1u << count) - 1);
    uint64_t clear = touched ? (unsigned)__builtin_ctz(touched) : count;
    bool larger = !touched && count > 0 && ((i + count) & GROUP_LAST) == 0 && level < k->g->top;
    bool down = touched || count == available;
    f->vertex = (i + clear) << shift;
    return level + (larger ? 1 : down ? -1 : 0);
}

/* Prefetch what this search reads next, and a few more vertices. */
FORCE_INLINE void prefetch_search(const struct lanes *k, const struct far_search *f, int level)
{
    const char *from = level == 0 ? (const char *)(k->ground->vertices.pairs + f->vertex + 2)
                                  : (const char *)(k->g->levels[level] + (f->vertex >> GROUND_BITS * level));
    for (size_t line = 0; line < sizeof(struct ground_chunk[8]) / 64; line++)
        __builtin_prefetch(from + 64 * line);
}

/* Advance each search at a level by one step. lanes_at[l] are the lanes at level l. Return the finished lanes. */
FORCE_INLINE unsigned search_level(const struct lanes *k, struct far_search *searches, int level,
                                   unsigned lanes_at[GROUND_LEVELS])
{
    unsigned remaining = lanes_at[level], landed = 0;
    lanes_at[level] = 0;
    for (; remaining; remaining &= remaining - 1) {
        size_t i = (size_t)__builtin_ctz(remaining);
        struct far_search *f = &searches[i];
        if (level == 0 && search_vertices(k, f)) {
            landed |= 1u << i;
            __builtin_prefetch(&k->g->segments[f->vertex]); /* where it lands */
            continue;
        }
        int next_level = level == 0 ? 1 : search_chunks(k, f, level);
        lanes_at[next_level] |= 1u << i;
        prefetch_search(k, f, next_level);
    }
    return landed;
}

/* Advance each of `flights` to the segment of its landing. Passes go up to larger chunks and down again, all flights of a level
 * at a time. */
NOINLINE void search_far(struct lanes *k, unsigned flights)
{
    struct leaving *f = &k->leaving;
    struct far_search searches[LANES];
    unsigned at_level[GROUND_LEVELS] = {flights};
    for (unsigned rest = flights; rest; rest &= rest - 1) {
        size_t i = (size_t)__builtin_ctz(rest);
        searches[i] = (struct far_search){f->x[i], f->z[i], f->vz[i], f->inv[i], f->segment[i] - 1};
        prefetch_search(k, &searches[i], 0);
    }
    for (unsigned remaining = flights; remaining;) {
        for (int level = 0; level <= k->g->top; level++)
            remaining &= ~search_level(k, searches, level, at_level);
        for (int level = k->g->top; level >= 0; level--)
            remaining &= ~search_level(k, searches, level, at_level);
    }
    for (; flights; flights &= flights - 1) {
        size_t i = (size_t)__builtin_ctz(flights);
        f->segment[i] = searches[i].vertex + 1;
    }
}

#endif
