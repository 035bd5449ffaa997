/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The walk of lanes (lanes.h) and the drawing of stems for wide registers: whoever includes it has said how many numbers one
 * holds (REAL_LANES) and what the kernel is called (KERNEL). The rest of the program is for any machine: this file alone sets the
 * target. What is computed here and in lanes_*.h is computed by walk.c for one rock: the same operations in the same order, where
 * it is not the same text. Each stage is done for one register after the other: short enough that the processor begins one before
 * the other is done, and small enough to stay in its registers. */
#include "core/wood/kernel.h"

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

#include "core/wood/stems_fill.h"
#include "lanes_stems.h"

/* ---- all contacts ---- */

FORCE_INLINE void step_lanes(struct form form, struct lanes *k, bool even)
{
    unsigned pass, leave, alone = form.wood ? pass_stems(form, k) : 0;
    alone |= disturbed(form, k, &pass, &leave);
    pass &= ~alone;
    leave &= ~alone;
    for (; pass; pass &= pass - 1)
        pass_marks_alone(k, (size_t)__builtin_ctz(pass));
    for (; leave; leave &= leave - 1) {
        size_t i = (size_t)__builtin_ctz(leave);
        end_alone(k, i, k->to_x[i], k->to_z[i], CEDUO_LEFT_SLOPE);
    }
    for (; alone; alone &= alone - 1)
        come_down_alone(k, (size_t)__builtin_ctz(alone));
    if (even) {
        draw_ahead(k, RANDOM_FACET, k->draw);
        if (form.law->sections)
            draw_ahead(k, RANDOM_TURN, k->turn);
    } else {
        for (; k->fresh; k->fresh &= k->fresh - 1)
            load_draws(k, (size_t)__builtin_ctz(k->fresh));
    }
    k->fresh = 0;
    if (k->varies)
        ground_alone(form, k);
    else if (k->sized)
        theta_alone(k);
    EACH_REGISTER(i)
        turn_lanes(form, k, i);
    k->rolled = k->friction_bound ? k->rolls : 0;
    EACH_REGISTER(i)
        strike_lanes(form, k, i);
    unsigned far = k->far ? find_segments_far(form, k) : find_segments(form, k);
    unsigned waits = form.wood ? k->waits : 0, left = 0, near = 0;
    EACH_REGISTER(i)
        left |= land_lanes(form, k, i, &near);
    k->left = (left & k->live & ~waits) | (k->left & waits);
    far &= ~waits;
    alone = far;
    near &= k->live & ~far & ~in_the_air(form, k);
    k->rolls = 0;
    if (near)
        EACH_REGISTER(i)
            if (near >> i & REGISTER)
                k->rolls |= roll_lanes(form, k, i, near, &alone);
    k->there = k->rolls;
    alone &= ~k->rolls;
    unsigned still_aloft = form.wood ? alone & k->aloft : 0;
    alone &= ~still_aloft;
    k->aloft = still_aloft;
    for (; still_aloft; still_aloft &= still_aloft - 1) /* untaken: rounding */
        come_down_alone(k, (size_t)__builtin_ctz(still_aloft));
    for (; alone; alone &= alone - 1) {
        size_t i = (size_t)__builtin_ctz(alone);
        go_off_alone(k, i, !(far >> i & 1));
    }
}

/* Few are left: one after the other to its end. */
static void finish_alone(struct lanes *k)
{
    for (; k->live; k->live &= k->live - 1) {
        size_t i = (size_t)__builtin_ctz(k->live);
        struct walker *w = &k->job->walkers[i];
        struct course c = course_of(k, i);
        if (!c.flies && !(k->rolls >> i & 1)) { /* a rock that has just begun */
            const struct ground_segment *s = &k->g->segments[c.at.segment];
            c.along = c.at.vx * s->c + c.at.vz * s->s;
            c.off = c.at.vz * s->c - c.at.vx * s->s;
        }
        enum ceduo_end end;
        if (!c.aloft || ceduo_walk_come_down(w, &c, &end))
            end = ceduo_walk_on(w, &c, k->job->law);
        k->job->ended(k->job->context, i, end);
    }
}

FORCE_INLINE void walk_lanes(struct form form, struct lanes *k)
{
    for (uint64_t step = 0;; step++) {
        if (k->empty && __builtin_popcount(k->live) <= LANES / 4)
            break;
        step_lanes(form, k, step % 2 == 0);
    }
    finish_alone(k);
}

/* With what is known of the ground and the law compiled in. */
#define WALK(law, small, wood) walk_lanes((struct form){&(law), small, wood}, k)
#define X(NAME, name)                                                                                                          \
    static void walk_##name(struct lanes *k, bool small, bool wood)                                                            \
    {                                                                                                                          \
        if (wood)                                                                                                              \
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
        refill(&k, i);
    }
    if (!k.live)
        return;
    k.g = w->g;
    k.seed = w->seed;
    bool small = job->ground->small;
    k.far = k.g->top > 0;
    k.varies = k.g->rn_varies || k.g->rt_varies || (k.g->theta_varies && !k.g->rough);
    k.sized = k.g->theta_varies;
    k.against = k.g->facets == CEDUO_AGAINST;
    k.scale_rn = w->scale_rn;
    k.friction_bound = w->friction_bound;
    k.tallest = w->stems ? w->stems->wood->tallest + 1e-6 : 0; /* more than rounding can make of a height */
    k.steep = job->ground->steep;
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
