/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANDING_H
#define CEDUO_LANDING_H

#include "flight.h"
#include "ground.h"

/* Return the slope of segment j. On long profiles the vertices are in cache but the segment is not: use them, with the same
 * bits. */
FORCE_INLINE double segment_slope(const struct ground *g, size_t j, bool chunks)
{
    return chunks ? (g->vertices[j + 1].z - g->vertices[j].z) / (g->vertices[j + 1].x - g->vertices[j].x) : g->segments[j].m;
}

FORCE_INLINE struct chord chord_at(const struct ground *g, size_t j, double m)
{
    return (struct chord){
        .x0 = g->vertices[j].x, .z0 = g->vertices[j].z, .x1 = g->vertices[j + 1].x, .z1 = g->vertices[j + 1].z, .m = m};
}

/* Return the contact with segment j, which the flight reaches before time t_max. */
FORCE_INLINE struct landing land_on(const struct ground *g, const struct flight *f, size_t j, double t_max, bool chunks)
{
    if (chunks)
        __builtin_prefetch(&g->segments[j]);
    const struct chord chord = chord_at(g, j, segment_slope(g, j, chunks));
    double c = f->on_ground && j == f->segment ? 0 : f->z - (chord.z0 + chord.m * (f->x - chord.x0));
    double t = min(t_max, later_root(c, f->vz - chord.m * f->vx, g->gravity)); /* NaN possible if vx is tiny */
    struct landing l = {.t = t, .x = f->x + f->vx * t, .z = height_at_time(f->z, f->vz, g->half_g, t), .segment = j};
    snap_to_chord(&chord, is_steep(chord.m), is_steep(chord.m), true, &l.x, &l.z);
    return l;
}

/* Return the landing of a vertical flight, at its start. */
FORCE_INLINE struct landing land_vertical(const struct ground *g, const struct flight *f)
{
    double z = ground_height(g, f->segment, f->x);
    double c = f->on_ground ? 0 : f->z - z;
    double t = later_root(c, f->vz, g->gravity);
    return (struct landing){.t = t, .x = f->x, .z = f->on_ground ? f->z : z, .segment = f->segment, .off_slope = false};
}

/* Return the end of a flight beyond the end of the profile. */
FORCE_INLINE struct landing land_off_slope(const struct ground *g, const struct flight *f, int dir, double inv)
{
    size_t p = dir > 0 ? g->n : 0;
    double t = (g->vertices[p].x - f->x) * inv;
    return (struct landing){.t = t,
                            .x = g->vertices[p].x,
                            .z = height_at_time(f->z, f->vz, g->half_g, t),
                            .segment = dir > 0 ? p - 1 : p,
                            .off_slope = true};
}

/* Search the landing from vertex p, which the flight clears, towards dir: the first segment at whose far vertex the flight is
 * below the ground. The parabola less a straight line is concave: above both ends of a segment it does not touch it between.
 * NaN counts as contact. */
FORCE_INLINE struct landing land_from_vertex(const struct ground *g, const struct flight *f, size_t p, int dir, double inv)
{
    size_t last = dir > 0 ? g->n : 0;
    while (p != last) {
        size_t q = dir > 0 ? p + 1 : p - 1;
        double t = (g->vertices[q].x - f->x) * inv;
        if (!(height_at_time(f->z, f->vz, g->half_g, t) - g->vertices[q].z >= 0))
            return land_on(g, f, dir > 0 ? p : q, t, false);
        p = q;
    }
    return land_off_slope(g, f, dir, inv);
}

/* As land_from_vertex(), on a long profile; the flight clears p by h. Skips a chunk if the flight is high enough above its
 * chord, from the current point, which may lie inside the chunk, to the end of the chunk. */
NOINLINE __attribute__((unused)) struct landing land_from_vertex_chunked(const struct ground *g, const struct flight *f,
                                                                         size_t p, double h, int dir, double inv)
{
    size_t last = dir > 0 ? g->n : 0, barrier = SIZE_MAX; /* end of the chunk that cannot be skipped */
    int level = 0, max = g->top;
    double xp = g->vertices[p].x, zp = g->vertices[p].z; /* copies, because a distant vertex is not in cache */
    while (p != last) {
        if (p == barrier)
            max = g->top;
        level = level < max ? level + 1 : max;
        for (;;) {
            int shift = GROUND_BITS * level;
            size_t i = (dir > 0 ? p : p - 1) >> shift;
            size_t q = (dir > 0 ? i + 1 : i) << shift;
            double clear = 0, z, x;
            if (level > 0) {
                const struct ground_chunk *b = &g->levels[level][i];
                if ((i + 1) << shift > g->n || !(h + (zp - (b->z + b->m * (xp - b->x))) >= b->rise)) {
                    level--;
                    continue;
                }
                clear = b->rise;
                x = b[dir > 0].x;
                z = b[dir > 0].z;
            } else {
                x = g->vertices[q].x;
                z = g->vertices[q].z;
            }
            double t = (x - f->x) * inv;
            double above = height_at_time(f->z, f->vz, g->half_g, t) - z;
            if (above >= clear) {
                p = q;
                xp = x;
                zp = z;
                h = above;
                break;
            }
            if (level == 0)
                return land_on(g, f, i, t, true);
            barrier = q;
            max = --level;
        }
    }
    return land_off_slope(g, f, dir, inv);
}

FORCE_INLINE struct landing land_towards(const struct ground *g, const struct flight *f, int dir, bool chunks)
{
    double inv = 1 / f->vx;
    size_t j = f->segment, q = dir > 0 ? j + 1 : j;
    double t = (g->vertices[q].x - f->x) * inv;
    /* c is exactly 0 on the ground: compare slopes, because heights may overflow if vx is tiny */
    if (f->on_ground && !(f->vz - g->segments[j].m * f->vx >= g->half_g * t))
        return land_on(g, f, j, t, chunks);
    double h = height_at_time(f->z, f->vz, g->half_g, t) - g->vertices[q].z;
    if (!f->on_ground && !(h >= 0))
        return land_on(g, f, j, t, chunks);
    return chunks ? land_from_vertex_chunked(g, f, q, h, dir, inv) : land_from_vertex(g, f, q, dir, inv);
}

/* Return the next contact of a flight with the ground. `chunks`: the ground has chunks. The walk passes a constant, because an
 * unneeded call would cost registers. */
FORCE_INLINE struct landing next_landing_over(const struct ground *g, const struct flight *f, bool chunks)
{
    if (f->vx > 0)
        return land_towards(g, f, 1, chunks);
    if (f->vx < 0)
        return land_towards(g, f, -1, chunks);
    return land_vertical(g, f);
}

FORCE_INLINE struct landing next_landing(const struct ground *g, const struct flight *f)
{
    return next_landing_over(g, f, g->top > 0);
}

#endif
