/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk of lanes (lanes.h) and the drawing of stems for wide registers. The including file defines REAL_LANES, the numbers
 * per register, and KERNEL, the name of the kernel. Only this file sets a target; the rest of the program runs on any machine.
 * This file and lanes_*.h use the same operations in the same order as walk.c for one rock, unless they share its code. Each
 * stage processes one register after the other. A stage is so short that the processor overlaps the registers, and so small
 * that it needs no spills. */
#include "core/forest/kernel.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#if defined(__clang__) && REAL_LANES == 8
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq"))), apply_to = function)
#elif defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#elif REAL_LANES == 8
#pragma GCC target("avx512f,avx512dq")
#else
#pragma GCC target("avx2")
#endif

#include "core/forest/stems_fill.h"
#include "lanes_stems.h"

/* ---- all contacts ---- */

FORCE_INLINE void step_lanes(struct kernel_params params, struct lanes *k, bool even)
{
    unsigned pass, leave, scalar = params.stems ? pass_stems(params, k) : 0;
    scalar |= find_scalar_lanes(params, k, &pass, &leave);
    pass &= ~scalar;
    leave &= ~scalar;
    for (; pass; pass &= pass - 1)
        pass_marks_scalar(k, (size_t)__builtin_ctz(pass));
    for (; leave; leave &= leave - 1) {
        size_t i = (size_t)__builtin_ctz(leave);
        end_lane(k, i, k->to_x[i], k->t[i], CEDUO_END_LEFT_SLOPE);
    }
    for (; scalar; scalar &= scalar - 1)
        land_scalar(k, (size_t)__builtin_ctz(scalar));
    if (even) {
        draw_two_contacts(k, RANDOM_FACET, k->draw);
        if (params.law->sections)
            draw_two_contacts(k, RANDOM_TURN, k->turn);
    } else {
        for (; k->need_draws; k->need_draws &= k->need_draws - 1)
            load_draws(k, (size_t)__builtin_ctz(k->need_draws));
    }
    k->need_draws = 0;
    if (k->ground_varies)
        load_ground_scalar(params, k);
    else if (k->theta_varies)
        load_theta(k);
    EACH_REGISTER(i)
        draw_facets(params, k, i);
    k->rolled = k->friction_bound ? k->rolling : 0;
    EACH_REGISTER(i)
        strike_lanes(params, k, i);
    unsigned listed = 0;
    scalar = k->rolling = k->leaving.n = 0;
    k->off_slope &= in_the_air(params, k);
    EACH_REGISTER(i)
        listed |= hop_lanes(params, k, i, &scalar);
    k->at_contact = k->rolling;
    scalar |= land_lanes(params, k, listed);
    k->after_hit = 0;
    k->off_slope &= ~scalar;
    for (scalar &= k->live; scalar; scalar &= scalar - 1)
        depart_scalar(k, (size_t)__builtin_ctz(scalar));
}

/* Finish the few remaining rocks, one after the other. */
static void finish_scalar(struct lanes *k)
{
    for (; k->live; k->live &= k->live - 1) {
        size_t i = (size_t)__builtin_ctz(k->live);
        struct walker *w = &k->job->walkers[i];
        struct rock_state c = save_lane(k, i);
        enum ceduo_end end;
        if (!c.landing_unknown || ceduo_walk_land(w, &c, &end))
            end = ceduo_walk_continue(w, &c, k->job->law);
        k->job->ended(k->job->context, i, end);
    }
}

FORCE_INLINE void walk_lanes(struct kernel_params params, struct lanes *k)
{
    for (uint64_t step = 0;; step++) {
        if (k->exhausted && __builtin_popcount(k->live) <= LANES / 4)
            break;
        step_lanes(params, k, step % 2 == 0);
    }
    finish_scalar(k);
}

/* Instantiate the walk for a law and its compile-time parameters. */
#define WALK(law, small, forest) walk_lanes((struct kernel_params){&(law), small, forest}, k)
#define X(NAME, name)                                                                                                          \
    static void walk_##name(struct lanes *k, bool small, bool forest)                                                          \
    {                                                                                                                          \
        if (forest)                                                                                                            \
            small ? WALK(law_##name, true, true) : WALK(law_##name, false, true);                                              \
        else                                                                                                                   \
            small ? WALK(law_##name, true, false) : WALK(law_##name, false, false);                                            \
    }
CEDUO_LAWS(X)
#undef X

static void walk_job(const struct lanes_job *job)
{
    const struct walker *w = &job->walkers[0];
    struct lanes k = {.job = job, .ground = job->ground, .live = ALL_LANES};
    for (size_t i = 0; i < LANES; i++) {
        k.radius[i] = 1;
        refill(&k, i, false);
    }
    if (!k.live)
        return;
    k.g = w->g;
    k.seed = w->seed;
    bool small = job->ground->small;
    k.has_chunks = k.g->top > 0;
    k.ground_varies = k.g->rn_varies || k.g->rt_varies || (k.g->theta_varies && !k.g->roughness_index);
    k.theta_varies = k.g->theta_varies;
    k.small_facets = job->ground->small_facets && !k.theta_varies;
    k.against = k.g->facets == CEDUO_FACETS_AGAINST;
    k.scale_rn = w->scale_rn;
    k.friction_bound = w->friction_bound;
    k.tallest = w->stems ? w->stems->forest->tallest + 1e-6 : 0; /* margin above rounding of heights */
    static void (*const walks[])(struct lanes *, bool, bool) = {
#define X(NAME, name) walk_##name,
        CEDUO_LAWS(X)
#undef X
    };
    walks[job->law](&k, small, w->stems);
}

const struct kernel KERNEL = {walk_job, fill_points, make_stools};

#ifdef __clang__
#pragma clang attribute pop
#endif

#endif
