/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANDING_H
#define CEDUO_LANDING_H

#include "flight.h"
#include "ground.h"

/* The slope of segment j. On a long profile the segment is seldom at hand, while its vertices just were: the same bits
 * from those. */
FORCE_INLINE double slope_of(const struct ground *g, size_t j, bool blocks)
{
    return blocks ? (g->at[j + 1].z - g->at[j].z) / (g->at[j + 1].x - g->at[j].x) : g->segments[j].m;
}

FORCE_INLINE struct chord chord_at(const struct ground *g, size_t j, double m)
{
    return (struct chord){.x0 = g->at[j].x, .z0 = g->at[j].z, .x1 = g->at[j + 1].x, .z1 = g->at[j + 1].z, .m = m};
}

/* The contact with segment j, which the flight meets before time t_max. */
FORCE_INLINE struct landing land_on(const struct ground *g, const struct flight *f, size_t j, double t_max, bool blocks)
{
    if (blocks)
        __builtin_prefetch(&g->segments[j]);
    const struct chord on = chord_at(g, j, slope_of(g, j, blocks));
    double c = f->on_ground && j == f->segment ? 0 : f->z - (on.z0 + on.m * (f->x - on.x0));
    double t = min(t_max, later_root(c, f->vz - on.m * f->vx, g->gravity)); /* it may be NaN where vx is hardly more than 0 */
    struct landing l = {.t = t, .x = f->x + f->vx * t, .z = height_after(f->z, f->vz, g->half_g, t), .segment = j};
    onto_chord(&on, is_steep(on.m), is_steep(on.m), true, &l.x, &l.z);
    return l;
}

/* A flight without horizontal speed comes down where it went up. */
FORCE_INLINE struct landing land_straight(const struct ground *g, const struct flight *f)
{
    double z = ground_height(g, f->segment, f->x);
    double c = f->on_ground ? 0 : f->z - z;
    double t = later_root(c, f->vz, g->gravity);
    return (struct landing){.t = t, .x = f->x, .z = f->on_ground ? f->z : z, .segment = f->segment, .left = false};
}

/* Beyond the end of the profile. */
FORCE_INLINE struct landing land_nowhere(const struct ground *g, const struct flight *f, int dir, double inv)
{
    size_t p = dir > 0 ? g->n : 0;
    double t = (g->at[p].x - f->x) * inv;
    return (struct landing){
        .t = t, .x = g->at[p].x, .z = height_after(f->z, f->vz, g->half_g, t), .segment = dir > 0 ? p - 1 : p, .left = true};
}

/* Follows the flight from vertex p, which it clears, towards dir: the first segment at whose far vertex it would be
 * under the ground. The parabola less a straight line is concave: where it is above both ends of a segment it touches
 * nothing between. NaN is contact. */
FORCE_INLINE struct landing land_beyond(const struct ground *g, const struct flight *f, size_t p, int dir, double inv)
{
    size_t last = dir > 0 ? g->n : 0;
    while (p != last) {
        size_t q = dir > 0 ? p + 1 : p - 1;
        double t = (g->at[q].x - f->x) * inv;
        if (!(height_after(f->z, f->vz, g->half_g, t) - g->at[q].z >= 0))
            return land_on(g, f, dir > 0 ? p : q, t, false);
        p = q;
    }
    return land_nowhere(g, f, dir, inv);
}

/* The same on a long profile, p being cleared by h. Blocks are passed as wholes where the flight is high enough above
 * their chord: from where it is, be it within the block, to the block's end. */
NOINLINE __attribute__((unused)) struct landing land_far(const struct ground *g, const struct flight *f, size_t p, double h,
                                                         int dir, double inv)
{
    size_t last = dir > 0 ? g->n : 0, barrier = SIZE_MAX; /* end of the block that may not be passed as a whole */
    int level = 0, max = g->top;
    double xp = g->at[p].x, zp = g->at[p].z; /* kept, for a vertex far away is not at hand */
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
                const struct ground_block *b = &g->levels[level][i];
                if ((i + 1) << shift > g->n || !(h + (zp - (b->z + b->m * (xp - b->x))) >= b->rise)) {
                    level--;
                    continue;
                }
                clear = b->rise;
                x = b[dir > 0].x;
                z = b[dir > 0].z;
            } else {
                x = g->at[q].x;
                z = g->at[q].z;
            }
            double t = (x - f->x) * inv;
            double above = height_after(f->z, f->vz, g->half_g, t) - z;
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
    return land_nowhere(g, f, dir, inv);
}

FORCE_INLINE struct landing land_towards(const struct ground *g, const struct flight *f, int dir, bool blocks)
{
    double inv = 1 / f->vx;
    size_t j = f->segment, q = dir > 0 ? j + 1 : j;
    double t = (g->at[q].x - f->x) * inv;
    /* c is exactly 0 on the ground: compare slopes, not heights, which may be beyond all numbers where vx is next to
     * none */
    if (f->on_ground && !(f->vz - g->segments[j].m * f->vx >= g->half_g * t))
        return land_on(g, f, j, t, blocks);
    double h = height_after(f->z, f->vz, g->half_g, t) - g->at[q].z;
    if (!f->on_ground && !(h >= 0))
        return land_on(g, f, j, t, blocks);
    return blocks ? land_far(g, f, q, h, dir, inv) : land_beyond(g, f, q, dir, inv);
}

/* The next contact of a flight with the ground; `blocks`: whether it has any. The walk says so where it knows it as it
 * is compiled, as a call to what it does not need would cost it registers. */
FORCE_INLINE struct landing next_landing_over(const struct ground *g, const struct flight *f, bool blocks)
{
    if (f->vx > 0)
        return land_towards(g, f, 1, blocks);
    if (f->vx < 0)
        return land_towards(g, f, -1, blocks);
    return land_straight(g, f);
}

FORCE_INLINE struct landing next_landing(const struct ground *g, const struct flight *f)
{
    return next_landing_over(g, f, g->top > 0);
}

#endif
