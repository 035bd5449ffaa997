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

/* Puts a landing at time t on segment j. Steeper than 45 degrees z is kept and x follows, elsewhere the other way. */
HOT struct landing land_at(const struct ground *g, const struct flight *f, size_t j, double t)
{
    const struct ground_segment *s = &g->segments[j];
    struct landing l = {.t = t, .segment = j, .left = false};
    if (s->steep) {
        l.z = clamp(f->z + (f->vz - g->half_g * t) * t, g->z[j], g->z[j + 1]);
        l.x = l.z == g->z[j + 1] ? g->x[j + 1] : clamp(g->x[j] + (l.z - g->z[j]) / s->m, g->x[j], g->x[j + 1]);
    } else {
        l.x = clamp(f->x + f->vx * t, g->x[j], g->x[j + 1]);
        l.z = ground_height(g, j, l.x);
    }
    return l;
}

/* The contact with segment j, which the flight meets before time t_most. */
HOT struct landing land_on(const struct ground *g, const struct flight *f, size_t j, double t_most)
{
    const struct ground_segment *s = &g->segments[j];
    double c = f->on_ground && j == f->segment ? 0 : f->z - (g->z[j] + s->m * (f->x - g->x[j]));
    double t = later_root(c, f->vz - s->m * f->vx, g->gravity);
    return land_at(g, f, j, t > t_most ? t_most : t); /* t_most may be NaN where vx is hardly more than 0 */
}

/* A flight without horizontal speed comes down where it went up. */
HOT struct landing land_straight(const struct ground *g, const struct flight *f)
{
    double z = ground_height(g, f->segment, f->x);
    double c = f->on_ground ? 0 : f->z - z;
    double t = later_root(c, f->vz, g->gravity);
    return (struct landing){.t = t, .x = f->x, .z = f->on_ground ? f->z : z, .segment = f->segment, .left = false};
}

/* Index of the block of `span` segments that begins at vertex p in direction dir; false where none does. */
HOT bool block_at(const struct ground *g, size_t p, int dir, size_t span, size_t *block)
{
    if (p % span != 0)
        return false;
    if (dir > 0) {
        *block = p / span;
        return p + span <= g->n;
    }
    *block = p / span - 1;
    return p >= span;
}

/* Follows the flight from vertex p, which it clears by h, towards dir: the first segment at whose far vertex it would be
 * under the ground. The parabola less a straight line is concave: where it is above both ends of a segment it touches
 * nothing between, and where it is higher above both ends of a block than the block rises over its chord, no segment of
 * the block. NaN is contact. */
HOT struct landing land_beyond(const struct ground *g, const struct flight *f, size_t p, double h, int dir, double inv)
{
    int level = 0;
    size_t span = 1, block;
    for (;;) {
        if (p == (dir > 0 ? g->n : 0)) {
            double t = (g->x[p] - f->x) * inv;
            return (struct landing){.t = t,
                                    .x = g->x[p],
                                    .z = f->z + (f->vz - g->half_g * t) * t,
                                    .segment = dir > 0 ? p - 1 : p,
                                    .left = true};
        }
        while (level < g->top && block_at(g, p, dir, span * GROUND_BLOCK, &block) &&
               h >= g->levels[level + 1][block]) {
            level++;
            span *= GROUND_BLOCK;
        }
        for (;;) {
            if (level > 0 && (!block_at(g, p, dir, span, &block) || !(h >= g->levels[level][block]))) {
                level--;
                span /= GROUND_BLOCK;
                continue;
            }
            size_t q = dir > 0 ? p + span : p - span;
            double t = (g->x[q] - f->x) * inv;
            double above = (f->z + (f->vz - g->half_g * t) * t) - g->z[q];
            if (above >= (level > 0 ? g->levels[level][block] : 0)) {
                p = q;
                h = above;
                break;
            }
            if (level == 0)
                return land_on(g, f, dir > 0 ? p : q, t);
            level--;
            span /= GROUND_BLOCK;
        }
    }
}

HOT struct landing land_towards(const struct ground *g, const struct flight *f, int dir)
{
    double inv = 1 / f->vx;
    size_t j = f->segment, q = dir > 0 ? j + 1 : j;
    double t = (g->x[q] - f->x) * inv;
    double h = (f->z + (f->vz - g->half_g * t) * t) - g->z[q];
    if (f->on_ground) { /* c is exactly 0 here: compare slopes, not heights */
        if (!(f->vz - g->segments[j].m * f->vx >= g->half_g * t))
            return land_on(g, f, j, t);
    } else if (!(h >= 0)) {
        return land_on(g, f, j, t);
    }
    return land_beyond(g, f, q, h, dir, inv);
}

/* The next contact of a flight with the ground. */
HOT struct landing next_landing(const struct ground *g, const struct flight *f)
{
    if (f->vx > 0)
        return land_towards(g, f, 1);
    if (f->vx < 0)
        return land_towards(g, f, -1);
    return land_straight(g, f);
}

#endif
