/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANDING_H
#define CEDUO_LANDING_H

#include <math.h>

#include "ground.h"

/* A flight in the vertical plane. On the ground it starts on segment `segment` itself. */
struct flight {
    double x, z, vx, vz;
    size_t segment;
    bool on_ground;
};

/* Where a flight ends: on the ground, or beyond an end of the profile. */
struct landing {
    double t, x, z; /* s after the start; the point, on the ground or above the profile's end */
    size_t segment;
    bool left;
};

/* The later root of c + b t - g/2 t2, in the form that does not cancel; c >= 0 but for rounding. */
HOT double later_root(double c, double b, double g)
{
    double d = b * b + 2 * g * c;
    double root = d > 0 ? sqrt(d) : 0;
    if (b >= 0)
        return (b + root) / g;
    return c > 0 ? 2 * c / (root - b) : 0;
}

HOT double clamp(double v, double a, double b)
{
    double lo = a < b ? a : b, hi = a < b ? b : a;
    return v < lo ? lo : v > hi ? hi : v;
}

/* The slope of segment j. On a long profile the segment is seldom at hand, while its vertices just were: the same bits
 * from those. */
HOT double slope_of(const struct ground *g, size_t j, bool blocks)
{
    return blocks ? (g->at[j + 1].z - g->at[j].z) / (g->at[j + 1].x - g->at[j].x) : g->segments[j].m;
}

/* Puts a landing at time t on segment j of slope m. Steeper than 45 degrees z is kept and x follows, elsewhere the
 * other way. */
HOT struct landing land_at(const struct ground *g, const struct flight *f, size_t j, double m, double t)
{
    struct landing l = {.t = t, .segment = j, .left = false};
    if (fabs(m) > 1) {
        l.z = clamp(f->z + (f->vz - g->half_g * t) * t, g->at[j].z, g->at[j + 1].z);
        l.x = l.z == g->at[j + 1].z ? g->at[j + 1].x : clamp(g->at[j].x + (l.z - g->at[j].z) / m, g->at[j].x, g->at[j + 1].x);
    } else {
        l.x = clamp(f->x + f->vx * t, g->at[j].x, g->at[j + 1].x);
        l.z = l.x >= g->at[j + 1].x ? g->at[j + 1].z : g->at[j].z + m * (l.x - g->at[j].x);
    }
    return l;
}

/* The contact with segment j, which the flight meets before time t_most. */
HOT struct landing land_on(const struct ground *g, const struct flight *f, size_t j, double t_most, bool blocks)
{
    if (blocks)
        __builtin_prefetch(&g->segments[j]);
    double m = slope_of(g, j, blocks);
    double c = f->on_ground && j == f->segment ? 0 : f->z - (g->at[j].z + m * (f->x - g->at[j].x));
    double t = later_root(c, f->vz - m * f->vx, g->gravity);
    /* untaken: rounding */
    return land_at(g, f, j, m, t > t_most ? t_most : t); /* t_most may be NaN where vx is hardly more than 0 */
}

/* A flight without horizontal speed comes down where it went up. */
HOT struct landing land_straight(const struct ground *g, const struct flight *f)
{
    double z = ground_height(g, f->segment, f->x);
    double c = f->on_ground ? 0 : f->z - z;
    double t = later_root(c, f->vz, g->gravity);
    return (struct landing){.t = t, .x = f->x, .z = f->on_ground ? f->z : z, .segment = f->segment, .left = false};
}

/* Beyond the end of the profile. */
HOT struct landing land_nowhere(const struct ground *g, const struct flight *f, int dir, double inv)
{
    size_t p = dir > 0 ? g->n : 0;
    double t = (g->at[p].x - f->x) * inv;
    return (struct landing){
        .t = t, .x = g->at[p].x, .z = f->z + (f->vz - g->half_g * t) * t, .segment = dir > 0 ? p - 1 : p, .left = true};
}

/* Follows the flight from vertex p, which it clears, towards dir: the first segment at whose far vertex it would be
 * under the ground. The parabola less a straight line is concave: where it is above both ends of a segment it touches
 * nothing between. NaN is contact. */
HOT struct landing land_beyond(const struct ground *g, const struct flight *f, size_t p, int dir, double inv)
{
    size_t last = dir > 0 ? g->n : 0;
    while (p != last) {
        size_t q = dir > 0 ? p + 1 : p - 1;
        double t = (g->at[q].x - f->x) * inv;
        if (!((f->z + (f->vz - g->half_g * t) * t) - g->at[q].z >= 0))
            return land_on(g, f, dir > 0 ? p : q, t, false);
        p = q;
    }
    return land_nowhere(g, f, dir, inv);
}

/* The same on a long profile, p being cleared by h. Blocks are passed as wholes where the flight is high enough above
 * their chord: from where it is, be it within the block, to the block's end. */
SELDOM __attribute__((unused)) struct landing land_far(const struct ground *g, const struct flight *f, size_t p, double h,
                                                       int dir, double inv)
{
    size_t last = dir > 0 ? g->n : 0, barrier = SIZE_MAX; /* end of the block that may not be passed as a whole */
    int level = 0, most = g->top;
    double xp = g->at[p].x, zp = g->at[p].z; /* kept, for a vertex far away is not at hand */
    while (p != last) {
        if (p == barrier)
            most = g->top;
        level = level < most ? level + 1 : most;
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
            double above = (f->z + (f->vz - g->half_g * t) * t) - z;
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
            most = --level;
        }
    }
    return land_nowhere(g, f, dir, inv);
}

HOT struct landing land_towards(const struct ground *g, const struct flight *f, int dir, bool blocks)
{
    double inv = 1 / f->vx;
    size_t j = f->segment, q = dir > 0 ? j + 1 : j;
    double t = (g->at[q].x - f->x) * inv;
    /* c is exactly 0 on the ground: compare slopes, not heights, which may be beyond all numbers where vx is next to
     * none */
    if (f->on_ground && !(f->vz - g->segments[j].m * f->vx >= g->half_g * t))
        return land_on(g, f, j, t, blocks);
    double h = (f->z + (f->vz - g->half_g * t) * t) - g->at[q].z;
    if (!f->on_ground && !(h >= 0))
        return land_on(g, f, j, t, blocks);
    return blocks ? land_far(g, f, q, h, dir, inv) : land_beyond(g, f, q, dir, inv);
}

/* The next contact of a flight with the ground; `blocks`: whether it has any. The walk says so where it knows it as it
 * is compiled, as a call to what it does not need would cost it registers. */
HOT struct landing next_landing_over(const struct ground *g, const struct flight *f, bool blocks)
{
    if (f->vx > 0)
        return land_towards(g, f, 1, blocks);
    if (f->vx < 0)
        return land_towards(g, f, -1, blocks);
    return land_straight(g, f);
}

HOT struct landing next_landing(const struct ground *g, const struct flight *f)
{
    return next_landing_over(g, f, g->top > 0);
}

#endif
