/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact of all lanes: strike.h for each register. */
#ifndef CEDUO_LANES_CONTACT_H
#define CEDUO_LANES_CONTACT_H

#include "lanes_state.h"
#include "strike.h"

/* ---- random numbers ---- */

FORCE_INLINE real unit(ints p)
{
    return to_real(p >> 11) * 0x1p-53;
}

/* Draws two contacts ahead for every lane, in every second step. A lane at an odd contact has its next draw already. */
FORCE_INLINE void draw_ahead(struct lanes *k, enum random_kind kind, double draws[3][LANES])
{
    const uint64_t seed = k->seed;
    EACH_REGISTER(i) {
        ints contacts = load_ints(&k->contacts[i]), rock = load_ints(&k->number[i]);
        ints event = (contacts + 1) >> 1, y = splat_ints(kind);
        const ints key = RANDOM_KEY(seed, rock);
        RANDOM_BITS(event, y, seed, rock, key);
        real first = load(&draws[0][i]), u0 = unit(event), u1 = unit(y);
        mask even = equal_ints(contacts & 1, splat_ints(0));
        store(&draws[0][i], blend(even, u0, first));
        store(&draws[1][i], blend(even, u1, u0));
        store(&draws[2][i], u1);
    }
}

/* The next draw of each lane; those in the air keep theirs. */
FORCE_INLINE real next_draw(struct form form, const struct lanes *k, double draws[3][LANES], size_t i)
{
    real u = load(&draws[0][i]), v = load(&draws[1][i]), w = load(&draws[2][i]);
    if (in_the_air(form, k)) {
        mask air = lane_mask(in_the_air(form, k) >> i);
        w = blend(air, v, w);
        v = blend(air, u, v);
    }
    store(&draws[0][i], v);
    store(&draws[1][i], w);
    return u;
}

/* ---- one contact in every lane ---- */

/* Those that the scalar walk brings to the next contact. Of the others: which pass a mark, which leave the slope. */
FORCE_INLINE unsigned disturbed(struct form form, const struct lanes *k, unsigned *pass, unsigned *leave)
{
    unsigned mark = 0, stem = 0, many = 0;
    EACH_REGISTER(i) {
        real x = load(&k->to_x[i]);
        mark |= lane_bits(at_least(x, load(&k->next_x[i])) & less(splat(0), load(&k->vx[i]))) << i;
        stem |= lane_bits(at_least(x, load(&k->stem_ahead[i])) | at_least(load(&k->stem_behind[i]), x)) << i;
        many |= (REGISTER & ~lane_bits(greater_ints(load_ints(&k->pause[i]), load_ints(&k->contacts[i])))) << i;
    }
    unsigned lands = k->live & ~in_the_air(form, k), flies = lands & ~k->there;
    unsigned alone = (stem & flies) | (many & lands);
    *pass = mark & flies & ~alone;
    *leave = k->left & lands & ~alone;
    return alone;
}

/* The ground that each rock strikes, where that varies from rock to rock. */
NOINLINE void ground_alone(struct form form, struct lanes *k)
{
    for (size_t i = 0; i < LANES; i++)
        if ((k->live & ~in_the_air(form, k)) >> i & 1)
            ceduo_walk_ground(&k->job->walkers[i], k->to[i] - 1, &k->rn[i], &k->rt[i], &k->theta[i]);
}

/* The largest facet angle where only that varies, with the rock's radius. */
FORCE_INLINE void theta_alone(struct lanes *k)
{
    const unsigned char *rough = k->g->rough;
    for (size_t i = 0; i < LANES; i++)
        if (k->to[i] - 1 < k->g->n)
            k->theta[i] = k->job->walkers[i].theta[rough[k->to[i] - 1]];
}

/* How the facets and sections of the lanes from i on are turned. */
FORCE_INLINE void turn_lanes(struct form form, struct lanes *k, size_t i)
{
    real sine, cosine, largest = load(&k->theta[i]);
    real angle = facet_angle(k->against, largest, next_draw(form, k, k->draw, i));
    angle = blend(less(splat(0), largest), angle, splat(0));
    lanes_sincos(&angle, &sine, &cosine);
    store(&k->facet.sine[i], sine);
    store(&k->facet.cosine[i], cosine);
    if (form.law->sections) {
        angle = (next_draw(form, k, k->turn, i) - 0.5) * HALF_TURN;
        lanes_sincos(&angle, &sine, &cosine);
        store(&k->turned.sine[i], sine);
        store(&k->turned.cosine[i], cosine);
    }
}

/* What a law needs to know of the lanes from i on. */
FORCE_INLINE struct ground_point ground_points(struct form form, struct lanes *k, size_t i, ints segment)
{
    struct ground_point at = {.radius = load(&k->radius[i]), .k = load(&k->k[i]), .scale_rn = k->scale_rn};
    at.bound = k->friction_bound;
    if (k->varies) {
        at.rn = load(&k->rn[i]);
        at.rt = load(&k->rt[i]);
    } else {
        look_up(&k->ground->share, segment, form.small, &at.rn, &at.rt);
    }
    if (form.law->sections || k->friction_bound)
        look_up(&k->ground->grip, segment, form.small, &at.mu, &at.friction);
    if (form.law->sections) {
        at.sine = load(&k->turned.sine[i]);
        at.cosine = load(&k->turned.cosine[i]);
        at.section.wide = load(&k->section.wide[i]);
        at.section.high = load(&k->section.high[i]);
        at.section.reach = load(&k->section.reach[i]);
        at.section.gyration = load(&k->section.gyration[i]);
    }
    return at;
}

/* The lanes from i on come down and are struck, but for those in the air. */
FORCE_INLINE void strike_lanes(struct form form, struct lanes *k, size_t i)
{
    real c, s, sine, cosine, vx = load(&k->vx[i]), vz = load(&k->vz[i]) - k->g->gravity * load(&k->t[i]);
    ints segment = load_ints(&k->to[i]);
    look_up(&k->ground->tilt, segment, form.small, &c, &s);
    struct velocity v = velocity_on(c, s, vx, vz);
    if (k->rolls) {
        mask rolls = lane_mask(k->rolls >> i);
        v.along = blend(rolls, load(&k->along[i]), v.along);
        v.off = blend(rolls, splat(0), v.off);
    }
    sine = load(&k->facet.sine[i]);
    cosine = load(&k->facet.cosine[i]);
    facet_struck(k->against, v, &sine, &cosine);
    const struct ground_point at = ground_points(form, k, i, segment);
    real spin = load(&k->spin[i]), x = load(&k->to_x[i]), z = load(&k->to_z[i]);
    store(&k->before.along[i], v.along);
    store(&k->before.spin[i], spin);
    v = strike(form.law, &at, sine, cosine, v, &spin);
    vx = v.along * c - v.off * s;
    vz = v.along * s + v.off * c;
    ints contacts = load_ints(&k->contacts[i]);
    if (in_the_air(form, k)) {
        mask air = lane_mask(in_the_air(form, k) >> i), waits = lane_mask(k->waits >> i);
        vx = blend(air, load(&k->vx[i]), vx);
        vz = blend(air, load(&k->vz[i]), vz);
        spin = blend(air, load(&k->spin[i]), spin);
        x = blend(waits, load(&k->x[i]), x);
        z = blend(waits, load(&k->z[i]), z);
        segment = blend_ints(waits, load_ints(&k->segment[i]), segment);
        contacts = blend_ints(air, contacts, contacts + 1);
    } else {
        contacts += 1;
    }
    store_ints(&k->contacts[i], contacts);
    store(&k->spin[i], spin);
    store(&k->vx[i], vx);
    store(&k->vz[i], vz);
    store(&k->x[i], x);
    store(&k->z[i], z);
    store_ints(&k->segment[i], segment);
    store(&k->along[i], v.along);
    store(&k->off[i], v.off);
}

#endif
