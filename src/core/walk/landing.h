/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_LANDING_H
#define CEDUO_LANDING_H

#include "flight.h"
#include "ground.h"

FORCE_INLINE struct axes axes_of(const struct ground *g, size_t j)
{
    return (struct axes){g->segments[j].c, g->segments[j].s, g->segments[j].length};
}

/* Return a landing on segment j. */
FORCE_INLINE struct landing landing_at(const struct ground *g, size_t j, struct motion m, double t)
{
    const struct ground_vertex place = ground_place(g, j, m.q);
    return (struct landing){.t = t, .x = place.x, .z = place.z, .contact = {j, m.q, m.along, m.off}};
}

/* Return the contact with segment j, which the flight reaches before time t_max. */
FORCE_INLINE struct landing land_on(const struct ground *g, const struct flight *f, size_t j, double t_max)
{
    const struct axes axes = axes_of(g, j);
    double t, dx = f->x - g->vertices[j].x, dz = f->z - g->vertices[j].z;
    const struct motion m = come_down_on(&axes, g->gravity, dx, dz, f->vx, f->vz, t_max, &t);
    return landing_at(g, j, m, t);
}

/* Return the end of a flight beyond the end of the profile. */
FORCE_INLINE struct landing land_off_slope(const struct ground *g, const struct flight *f, int dir, double inv)
{
    size_t p = dir > 0 ? g->n : 0;
    double t = (g->vertices[p].x - f->x) * inv;
    return (struct landing){.t = t,
                            .x = g->vertices[p].x,
                            .z = height_at_time(f->z, f->vz, g->half_g, t),
                            .contact.segment = dir > 0 ? p - 1 : p,
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
            return land_on(g, f, dir > 0 ? p : q, t);
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
                return land_on(g, f, i, t);
            barrier = q;
            max = --level;
        }
    }
    return land_off_slope(g, f, dir, inv);
}

/* Return the next contact of a flight, which moves towards dir. `clears`: it clears the end of its segment. `chunks`: the ground
 * has chunks. The walk passes a constant, because an unneeded call would cost registers. */
FORCE_INLINE struct landing land_towards(const struct ground *g, const struct flight *f, int dir, bool clears, bool chunks)
{
    size_t q = dir > 0 ? f->segment + 1 : f->segment;
    double inv = 1 / f->vx, t = (g->vertices[q].x - f->x) * inv;
    double h = height_at_time(f->z, f->vz, g->half_g, t) - g->vertices[q].z;
    if (!clears && !(h >= 0))
        return land_on(g, f, f->segment, t);
    return chunks ? land_from_vertex_chunked(g, f, q, h, dir, inv) : land_from_vertex(g, f, q, dir, inv);
}

/* Return the next contact of a flight above the ground. */
FORCE_INLINE struct landing next_landing(const struct ground *g, const struct flight *f)
{
    if (f->vx == 0)
        return land_on(g, f, f->segment, INFINITY);
    return land_towards(g, f, f->vx > 0 ? 1 : -1, false, g->top > 0);
}

/* Return the flight that begins at a contact. */
FORCE_INLINE struct flight begin_flight(const struct ground *g, const struct contact *contact)
{
    const struct ground_segment *s = &g->segments[contact->segment];
    const struct ground_vertex place = ground_place(g, contact->segment, contact->q);
    return (struct flight){.x = place.x,
                           .z = place.z,
                           .vx = contact->along * s->c - contact->off * s->s,
                           .vz = contact->along * s->s + contact->off * s->c,
                           .segment = contact->segment};
}

/* Return the contact after this one, at the end of the flight `f` that begins here. */
FORCE_INLINE struct landing next_contact(const struct ground *g, const struct contact *contact, const struct flight *f,
                                         bool chunks)
{
    const struct axes axes = axes_of(g, contact->segment);
    double t;
    bool leaves;
    struct motion m = hop(&axes, g->gravity, (struct motion){contact->q, contact->along, contact->off}, &t, &leaves);
    if (!leaves)
        return landing_at(g, contact->segment, m, t);
    return f->vx > 0 ? land_towards(g, f, 1, true, chunks) : land_towards(g, f, -1, true, chunks);
}

#endif
