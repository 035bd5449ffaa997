/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact of all lanes: strike.h for each register. */
#ifndef CEDUO_LANES_CONTACT_H
#define CEDUO_LANES_CONTACT_H

#include "lanes_state.h"
#include "strike.h"

/* ---- random numbers ---- */

FORCE_INLINE real to_unit(ints p)
{
    return to_real(p >> 11) * 0x1p-53;
}

/* Draw the next two contacts of every lane, in every second step. A lane at an odd contact already has its next draw. */
FORCE_INLINE void draw_two_contacts(struct lanes *k, enum random_kind kind, double draws[3][LANES])
{
    const uint64_t seed = k->seed;
    EACH_REGISTER(i) {
        ints contacts = load_ints(&k->contacts[i]), rock = load_ints(&k->number[i]);
        ints event = (contacts + 1) >> 1, y = splat_ints(kind);
        const ints key = RANDOM_KEY(seed, rock);
        RANDOM_BITS(event, y, seed, rock, key);
        real first = load(&draws[0][i]), u0 = to_unit(event), u1 = to_unit(y);
        mask even = equal_ints(contacts & 1, splat_ints(0));
        store(&draws[0][i], blend(even, u0, first));
        store(&draws[1][i], blend(even, u1, u0));
        store(&draws[2][i], u1);
    }
}

/* Return the next draw of each lane. Lanes in the air keep their draws. */
FORCE_INLINE real next_draw(struct kernel_params params, const struct lanes *k, double draws[3][LANES], size_t i)
{
    real u = load(&draws[0][i]), v = load(&draws[1][i]), w = load(&draws[2][i]);
    if (in_the_air(params, k)) {
        mask in_air = lane_mask(in_the_air(params, k) >> i);
        w = blend(in_air, v, w);
        v = blend(in_air, u, v);
    }
    store(&draws[0][i], v);
    store(&draws[1][i], w);
    return u;
}

/* ---- one contact in every lane ---- */

/* Return the lanes that the scalar walk must bring to the next contact. Of the others, set which pass a mark or leave the
 * slope. */
FORCE_INLINE unsigned find_scalar_lanes(struct kernel_params params, const struct lanes *k, unsigned *pass, unsigned *leave)
{
    unsigned mark = 0, stem = 0, pausing = 0;
    EACH_REGISTER(i) {
        real x = load(&k->to_x[i]);
        mark |= lane_bits(greater_equal(x, load(&k->next_x[i]))) << i;
        if (params.stems)
            stem |= lane_bits(greater_equal(x, load(&k->stem_ahead[i])) | greater_equal(load(&k->stem_behind[i]), x)) << i;
        pausing |= (REGISTER & ~lane_bits(greater_ints(load_ints(&k->pause[i]), load_ints(&k->contacts[i])))) << i;
    }
    unsigned lands = k->live & ~in_the_air(params, k), flies = lands & ~k->at_contact;
    unsigned scalar = (stem & flies) | (pausing & lands);
    *pass = mark & flies & ~scalar;
    *leave = k->off_slope & lands & ~scalar;
    return scalar;
}

/* Load the ground under each rock, if it varies between rocks. */
NOINLINE void load_ground_scalar(struct kernel_params params, struct lanes *k)
{
    for (size_t i = 0; i < LANES; i++)
        if ((k->live & ~in_the_air(params, k)) >> i & 1)
            ceduo_walk_ground(&k->job->walkers[i], k->segment[i] - 1, &k->rn[i], &k->rt[i], &k->theta[i]);
}

/* Load the largest facet angles, if only these vary, with the rock's radius. */
FORCE_INLINE void load_theta(struct lanes *k)
{
    const unsigned char *rough = k->g->roughness_index;
    for (size_t i = 0; i < LANES; i++)
        if (k->segment[i] - 1 < k->g->n)
            k->theta[i] = k->job->walkers[i].theta[rough[k->segment[i] - 1]];
}

/* Draw the orientation of facets and sections, for the lanes from i on. */
FORCE_INLINE void draw_facets(struct kernel_params params, struct lanes *k, size_t i)
{
    real sine, cosine, length, largest;
    lookup_segments(&k->ground->lengths, &k->segment[i], params.small, &length, &largest);
    store(&k->length[i], length);
    if (k->ground_varies || k->theta_varies)
        largest = load(&k->theta[i]);
    real angle = facet_angle(k->against, largest, next_draw(params, k, k->draw, i));
    angle = blend(less(splat(0), largest), angle, splat(0));
    if (k->small_facets)
        lanes_sincos_small(&angle, &sine, &cosine);
    else
        lanes_sincos(&angle, &sine, &cosine);
    store(&k->facet.sine[i], sine);
    store(&k->facet.cosine[i], cosine);
    if (params.law->sections) {
        angle = (next_draw(params, k, k->turn, i) - 0.5) * HALF_TURN;
        lanes_sincos(&angle, &sine, &cosine);
        store(&k->section_turn.sine[i], sine);
        store(&k->section_turn.cosine[i], cosine);
    }
}

/* Return the parameters of the law for the lanes from i on. */
FORCE_INLINE struct ground_point load_ground_points(struct kernel_params params, struct lanes *k, size_t i)
{
    struct ground_point point = {.radius = load(&k->radius[i]), .k = load(&k->k[i]), .scale_rn = k->scale_rn};
    point.bound = k->friction_bound;
    if (k->ground_varies) {
        point.rn = load(&k->rn[i]);
        point.rt = load(&k->rt[i]);
    } else {
        lookup_segments(&k->ground->restitutions, &k->segment[i], params.small, &point.rn, &point.rt);
    }
    lookup_segments(&k->ground->frictions, &k->segment[i], params.small, &point.mu, &point.friction);
    if (params.law->sections) {
        point.sine = load(&k->section_turn.sine[i]);
        point.cosine = load(&k->section_turn.cosine[i]);
        point.section.wide = load(&k->section.wide[i]);
        point.section.high = load(&k->section.high[i]);
        point.section.reach = load(&k->section.reach[i]);
        point.section.gyration = load(&k->section.gyration[i]);
    }
    return point;
}

/* Strike the ground with the lanes from i on, except those in the air. */
FORCE_INLINE void strike_lanes(struct kernel_params params, struct lanes *k, size_t i)
{
    real c, s, sine = load(&k->facet.sine[i]), cosine = load(&k->facet.cosine[i]), spin = load(&k->spin[i]);
    lookup_segments(&k->ground->tangents, &k->segment[i], params.small, &c, &s);
    const struct ground_point point = load_ground_points(params, k, i);
    struct velocity v = {load(&k->to.along[i]), load(&k->to.off[i])};
    store(&k->c[i], c);
    store(&k->s[i], s);
    store(&k->friction[i], point.friction);
    facet_struck(k->against, v, &sine, &cosine);
    if (k->friction_bound) {
        store(&k->before_contact.along[i], v.along);
        store(&k->before_contact.spin[i], spin);
    }
    v = strike(params.law, &point, sine, cosine, v, &spin);
    ints contacts = load_ints(&k->contacts[i]), next = contacts + 1;
    if (in_the_air(params, k)) {
        mask in_air = lane_mask(in_the_air(params, k) >> i);
        spin = blend(in_air, load(&k->spin[i]), spin);
        next = blend_ints(in_air, contacts, next);
    }
    store(&k->after.along[i], v.along);
    store(&k->after.off[i], v.off);
    store(&k->spin[i], spin);
    store_ints(&k->contacts[i], next);
}

#endif
