/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rolls over many vertices of a fine profile. u^2 changes along a segment by a multiple of 2g/(1+k) and at a concave
 * vertex by a factor, so that over any number of them it is one affine map; and the bounds of u^2 between which the rock
 * neither stands nor takes off on the way follow from those of each vertex. */
#include "ground.h"

#include <math.h>
#include <stdlib.h>

#ifndef ROLL_MARGIN
#define ROLL_MARGIN 1e-6 /* of a bound: what is nearer to it is looked at more closely; only speed depends on it */
#endif
#define ROLL_SLOW 1e-9 /* of the reach: likewise, a rock with this little energy height */
#define ROLL_KEPT 1e-3 /* a block that leaves less of u^2 on the way is not passed as a whole */

/* ---- vertices ---- */

/* Below which u^2/g a rock that comes to vertex v along `dir` surely rolls on: it rises less than the reach above the next
 * segment, and would be under the ground at vertex `far`, which lies less than the reach away. */
static double surely_below(const struct ground *g, int dir, size_t v, size_t far)
{
    const struct ground_segment *left = &g->segments[v - 1], *right = &g->segments[v];
    const struct ground_segment *a = dir > 0 ? left : right, *b = dir > 0 ? right : left;
    double turn = left->c * right->s - left->s * right->c;
    if (!(turn < 0))
        return INFINITY;
    if (!(fabs(g->along[far] - g->along[v]) > g->reach / 4))
        return -1;
    double dx = fabs(g->at[far].x - g->at[v].x), over = dir * a->s * dx - a->c * (g->at[far].z - g->at[v].z);
    double low = 2 * g->reach * b->c / (turn * turn), under = over > 0 ? dx * dx / (2 * a->c * over) : INFINITY;
    return (low < under ? low : under) * (1 - ROLL_MARGIN);
}

/* The profile's ends are passed by no block. */
static void set_corners(struct ground *g)
{
    size_t n = g->n, far = 0;
    g->corners[0] = (struct ground_corner){.kept = 1, .friction = g->segments[0].friction, .surely = {-1, -1}};
    g->corners[n] = (struct ground_corner){.kept = 1, .surely = {-1, -1}};
    for (size_t v = 1; v < n; v++) {
        while (far < n && g->along[far + 1] - g->along[v] < g->reach)
            far++;
        const struct ground_segment *a = &g->segments[v - 1], *b = &g->segments[v];
        double turn = a->c * b->s - a->s * b->c, cosine = a->c * b->c + a->s * b->s;
        g->corners[v] = (struct ground_corner){.kept = turn > 0 ? (cosine > 0 ? cosine * cosine : 0) : 1,
                                               .friction = g->segments[v].friction,
                                               .surely[0] = surely_below(g, 1, v, far)};
    }
    for (size_t v = n - 1; v > 0; v--) {
        while (far > 0 && g->along[v] - g->along[far - 1] < g->reach)
            far--;
        g->corners[v].surely[1] = surely_below(g, -1, v, far);
    }
}

/* ---- blocks ---- */

/* Segment j with the vertex at its end. */
static struct ground_roll over_one(const struct ground *g, int side, size_t j)
{
    const struct ground_corner *c = &g->corners[side == 0 ? j + 1 : j];
    double falls = g->at[j].z - g->at[j + 1].z, drag = g->corners[j].friction * (g->at[j + 1].x - g->at[j].x);
    double gained = (side == 0 ? falls : -falls) - drag;
    return (struct ground_roll){.kept = c->kept,
                                .gained = c->kept * gained,
                                .above = max(-gained, 0) * (1 + ROLL_MARGIN) + ROLL_SLOW * g->reach,
                                .below = c->surely[side] - 2 * max(gained, 0)};
}

/* One after the other. What k is does not matter for `below`: at 0 a rock gains the most. */
static struct ground_roll then(const struct ground_roll *p, const struct ground_roll *q)
{
    struct ground_roll both = {.kept = p->kept * q->kept, .gained = q->kept * p->gained + q->gained, .below = -1};
    if (!(p->kept > ROLL_KEPT))
        return both;
    double over = 1 / p->kept;
    both.above = max(p->above, (q->above - p->gained) * over);
    both.below = min(p->below, (q->below - 2 * max(p->gained, 0)) * over);
    return both;
}

bool ceduo_ground_prepare_rolls(struct ground *g, double radius, bool radius_varies)
{
    double each = g->along[g->n] / (double)g->n;
    if (g->top == 0 || !(each < radius))
        return true;
    g->reach = radius * (radius_varies ? 0.5 : 1 - ROLL_MARGIN);
    g->corners = malloc((g->n + 1) * sizeof *g->corners);
    if (!g->corners)
        return false;
    set_corners(g);
    for (int level = 1; level < GROUND_LEVELS && g->n >> (ROLL_BITS * level) > 0; level++) { /* untaken: large */
        each *= (double)(1 << ROLL_BITS);
        if (!(each < radius))
            break;
        for (int side = 0; side < 2; side++) {
            g->rolls[side][level] = malloc((g->n >> (ROLL_BITS * level)) * sizeof *g->rolls[side][level]);
            if (!g->rolls[side][level])
                return false;
            for (size_t i = 0; i < g->n >> (ROLL_BITS * level); i++) {
                const size_t many = (size_t)1 << ROLL_BITS;
                struct ground_roll sum = {.kept = 1, .below = INFINITY};
                for (size_t k = 0; k < many; k++) {
                    size_t j = i * many + (side == 0 ? k : many - 1 - k);
                    struct ground_roll next = level == 1 ? over_one(g, side, j) : g->rolls[side][level - 1][j];
                    sum = then(&sum, &next);
                }
                g->rolls[side][level][i] = sum;
            }
        }
        g->roll_top = level;
    }
    return true;
}
