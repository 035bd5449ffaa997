/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stems that a rock can hit, drawn as it reaches them. In each direction stools are one Poisson process along x,
 * all single trees, stumps and logs another, groups of trees a third, each drawn some places ahead
 * (stems_fill.h). A stool or group is made whole when the rock comes near, and its stems wait, sorted, because they stand
 * around its centre. Work is counted as effort,
 * and drawing pauses now and then, so that a caller can cancel. */
#include "stems.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/random.h"
#include "kernel.h"
#define REAL_LANES 2
#include "stems_fill.h"

#define PAUSE_STEMS 4096 /* effort between two looks at whether the rock is still waited for */

const struct kernel ceduo_kernel_scalar = {NULL, fill_points, make_stools};

/* ---- diameters ---- */

/* A diameter by the gamma law, after Marsaglia and Tsang 2000. `extra` 1: weighted by the diameter itself, as thick
 * stems are met more often. */
static double draw_dbh(const struct stems *s, const struct wood_kind *k, uint64_t event, uint64_t kind, int extra)
{
    double shape = k->shape + extra, scale = k->scale;
    if (shape < 1) { /* theirs is for 1 and more */
        double u = random_pair(s->seed, s->number, event, kind | (uint64_t)UINT32_MAX << 32).u[0] + 0x1p-54;
        scale *= ceduo_pow(u, 1 / shape);
        shape += 1;
    }
    double d = shape - 1.0 / 3, c = 1 / (3 * sqrt(d));
    for (uint64_t used = 0;; used++) {
        struct random_pair u = random_pair(s->seed, s->number, event, kind | used << 32);
        double z = ceduo_normal_quantile(u.u[0] + 0x1p-54), v = 1 + c * z;
        if (!(v > 0))
            continue;
        v = v * v * v;
        if (ceduo_log(u.u[1] + 0x1p-54) < 0.5 * (z * z) + d * (1 - v + ceduo_log(v)))
            return fmin(d * v * scale, k->most);
    }
}

/* What a stem of this kind, diameter and offset takes of this rock, and how tall it is. */
static void set_hit(const struct stems *s, struct stem *stem)
{
    const struct wood_kind *kind = stem->kind;
    double share = kind->by_eccentricity ? ceduo_dorren_share(ceduo_stem_eccentricity(stem, s->b)) : 1;
    stem->energy = kind->shape > 0 ? ceduo_stem_energy_hit(&kind->by_hit, stem->dbh, share) : share * kind->whole;
    stem->height = height_hit(s, kind);
}

/* ---- stools ---- */

/* Room for `greater_ints` stems behind those that wait. */
static bool make_room(struct stems *s, struct stems_side *side, size_t more)
{
    if (side->first == side->end)
        side->first = side->end = 0;
    if (side->end + more < side->room)
        return true;
    size_t count = side->end - side->first;
    if (count > 0)
        memmove(side->waiting, side->waiting + side->first, count * sizeof *side->waiting);
    side->first = 0;
    side->end = count;
    if (2 * (count + more) <= side->room)
        return true;
    size_t room = 3 * (count + more) + 5; /* for those of lanes, no whole pages */
    struct stem *waiting = realloc(side->waiting, room * sizeof *waiting);
    s->no_memory |= !waiting;
    if (!waiting)
        return false;
    side->waiting = waiting;
    side->room = room;
    return true;
}

/* Puts a stem among those waiting, for which there is room, in the order they are come to. */
static inline void insert_stem(struct stems *s, struct stems_side *side, const struct stem *stem)
{
    size_t end = side->end++, i = end;
    for (; i > side->first && side->waiting[i - 1].along > stem->along; i--)
        side->waiting[i] = side->waiting[i - 1];
    side->waiting[i] = *stem;
    s->effort += (end - i) / STEPS_OF_A_STEM;
}

/* Puts a stem that was drawn for a side among those waiting, for which there is room. One that stands behind the start of the
 * strip ahead belongs to the strip behind, whose own stools and groups begin beyond those that reach over the start. */
static void let_wait(struct stems *s, int i_side, struct stem *stem)
{
    set_hit(s, stem);
    bool behind = i_side == 0 && stem->along < s->start;
    struct stems_side *to = &s->side[behind ? 1 : i_side];
    stem->along = behind ? -stem->along : stem->along;
    if (!stem->shoot || stem->kind->shape > 0)
        to->other_to = fmax(to->other_to, stem->along);
    if (!behind || make_room(s, to, 1))
        insert_stem(s, to, stem);
}

/* Draws the next places of a stream, of which none are left; the first of them, infinite where there is none. */
static __attribute__((noinline)) double draw_places(struct stems *s, int i_side, enum stem_stream stream)
{
    struct points *p = points_of(&s->side[i_side], stream);
    if (p->end_belt == s->wood->belts)
        return INFINITY;
    s->kernel->fill(s, i_side, stream);
    return p->count > 0 ? p->at[0] : INFINITY;
}

/* The next place of a stream, drawn if need be; infinite where there is none. */
static inline double next_place(struct stems *s, int i_side, enum stem_stream stream)
{
    const struct points *p = points_of(&s->side[i_side], stream);
    return p->next < p->count ? p->at[p->next] : draw_places(s, i_side, stream);
}

/* Makes a stool whose shoots spread in diameter, or stand on both sides of the release, one by one. */
static __attribute__((noinline)) void make_other_stool(struct stems *s, int i_side)
{
    struct stool t = next_stool(s, i_side);
    for (unsigned i = 0; i < t.n; i++) {
        struct stem stem = {.shoot = true, .stool = t.event};
        place_shoot(&t, i, &stem.along, &stem.y);
        if (fabs(stem.y) > (s->b + t.stools->most) / 2)
            continue;
        stem.kind = t.stools->kinds;
        if (t.stools->cohorts > 1) {
            uint64_t bits[2];
            random_bits(s->seed, s->number, t.event, shoot_draw(RANDOM_SHOOT, i / 4), bits);
            double u = ((double)(uint32_t)(bits[i / 2 % 2] >> i % 2 * 32) + 0.5) * 0x1p-32;
            for (size_t c = 0; c + 1 < t.stools->cohorts; c++)
                stem.kind += u >= t.stools->kinds[c].share_to;
        }
        bool spreads = stem.kind->shape > 0;
        stem.dbh = spreads ? draw_dbh(s, stem.kind, t.event, shoot_draw(RANDOM_DBH, i), 0) : stem.kind->dbh;
        if (fabs(stem.y) > (s->b + stem.dbh) / 2)
            continue;
        let_wait(s, i_side, &stem);
    }
}

/* Makes the next stool of a side, and perhaps some of those behind it. */
static void make_stool(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    const struct points *p = &side->streams[STREAM_STOOLS];
    bool others = side->first < side->end && side->other_to >= side->waiting[side->first].along;
    bool plain = is_plain_stool(s, i_side) && side->end - side->first < STOP_SHOOTS && !others;
    size_t n = plain ? SHOOTS_AT_ONCE : s->wood->along[i_side][p->belt[p->next]].stools->n + 1;
    if (!make_room(s, side, n))
        return;
    if (plain)
        s->kernel->make_stools(s, i_side);
    else
        make_other_stool(s, i_side);
}

/* The stratum that a place of a merged stream belongs to; *u: uniform in [0, 1) within it. */
static const struct wood_stratum *stratum_at(struct stems *s, int side, const struct wood_belt *belt, size_t j,
                                             enum stem_stream stream, double mark, double *u)
{
    double left = mark * rates_in(s, side, j)->rate[stream], rate = 0;
    const struct wood_stratum *found = NULL;
    for (size_t k = 0; k < belt->strata_count; k++) {
        const struct wood_stratum *stratum = &belt->strata[k];
        if (stream_of(stratum) != stream)
            continue;
        found = stratum;
        rate = stratum->still + stratum->per_b * s->b;
        if (left < rate)
            break;
        left -= rate;
    }
    s->effort += belt->strata_count / STEPS_OF_A_STEM;
    *u = left / rate;
    return found;
}

/* ---- groups of trees ---- */

/* Makes the next group of a side; each of its trees is one by itself. */
static __attribute__((noinline)) void make_group(struct stems *s, int i_side)
{
    struct points *p = points_of(&s->side[i_side], STREAM_GROUPS);
    unsigned k = p->next;
    uint64_t event = event_of(p, STREAM_GROUPS, i_side, k);
    double u;
    const struct wood_belt *belt = &s->wood->along[i_side][p->belt[k]];
    const struct wood_stratum *t = stratum_at(s, i_side, belt, p->belt[k], STREAM_GROUPS, p->mark[k], &u);
    if (!make_room(s, &s->side[i_side], t->group))
        return;
    p->next++;
    s->drawn += t->group;
    s->effort += 1 + t->group;
    double centre = p->offset[k] * (2 * t->radius + t->kind->most + s->b);
    for (unsigned i = 0; i < t->group; i++) {
        struct stem stem = {.kind = t->kind, .stool = event | (uint64_t)(i + 1) << 44};
        struct random_pair draw = random_pair(s->seed, s->number, event, shoot_draw(RANDOM_GROUP, i));
        double angle = 2 * M_PI * (draw.u[1] - 0.5), off = t->radius * sqrt(draw.u[0]), sine, cosine;
        elementary_sincos(&angle, &sine, &cosine);
        stem.along = p->at[k] + off * cosine;
        stem.y = centre + off * sine;
        /* beyond the end of its belt it stands as far before it instead, so that the belt is as dense there as elsewhere */
        if (!(stem.along >= belt->from && stem.along <= belt->to)) {
            double span = belt->to - belt->from, past = fabs(fmod(stem.along - belt->from, 2 * span));
            stem.along = belt->from + (past <= span ? past : 2 * span - past);
        }
        if (fabs(stem.y) > (s->b + t->kind->most) / 2)
            continue;
        bool spreads = t->kind->shape > 0;
        stem.dbh = spreads ? draw_dbh(s, t->kind, event, shoot_draw(RANDOM_DBH, i), 0) : t->kind->dbh;
        if (fabs(stem.y) <= (s->b + stem.dbh) / 2)
            let_wait(s, i_side, &stem);
    }
}

/* ---- single trees ---- */

/* Makes the next single tree of a side. */
static void make_single(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    struct points *p = &side->streams[STREAM_SINGLE];
    side->single.along = next_place(s, i_side, STREAM_SINGLE);
    if (!(side->single.along < INFINITY))
        return;
    unsigned k = p->next;
    uint64_t event = event_of(p, STREAM_SINGLE, i_side, k);
    double u;
    const struct wood_belt *belt = &s->wood->along[i_side][p->belt[k]];
    const struct wood_kind *kind = stratum_at(s, i_side, belt, p->belt[k], STREAM_SINGLE, p->mark[k], &u)->kind;
    double d = kind->dbh;
    if (kind->shape > 0) /* met with a chance that goes with b + d */
        d = draw_dbh(s, kind, event, RANDOM_DBH, u * (s->b + d) >= s->b);
    side->single = (struct stem){.along = p->at[k], .y = p->offset[k] * (s->b + d), .dbh = d, .kind = kind, .stool = event};
    set_hit(s, &side->single);
    p->next++;
}

/* ---- what comes next ---- */

/* Whether it is time to let the caller look up. */
static bool pauses(const struct stems *s)
{
    return s->no_memory || s->effort >= s->pause || ceduo_stems_too_many(s);
}

/* Makes the stools or groups that have a centre up to `to` along a side; false where it stopped before. */
static bool make_to(struct stems *s, int side, enum stem_stream stream, double to)
{
    for (double at; (at = next_place(s, side, stream)) <= to && at < INFINITY;) { /* untaken: rounding */
        if (pauses(s))
            return false;
        if (stream == STREAM_GROUPS)
            make_group(s, side);
        else
            make_stool(s, side);
    }
    return true;
}

static void find_next(struct stems *s, int i)
{
    struct stems_side *side = &s->side[i];
    for (;;) {
        bool any = side->first < side->end, group = false;
        double waits = any ? side->waiting[side->first].along : INFINITY, single = side->single.along;
        side->next_waits = any && waits <= single;
        side->next = side->next_waits ? waits : single;
        side->next_known = true;
        /* where stems may stand that are not drawn yet: of the next stool, or group */
        double reach = next_place(s, i, STREAM_STOOLS) - s->wood->reach;
        if (s->wood->grouped) {
            double groups = next_place(s, i, STREAM_GROUPS) - s->wood->group_reach;
            group = groups < reach;
            reach = group ? groups : reach;
        }
        side->sure = reach < single ? reach : single;
        if (!(reach <= side->next) || reach == INFINITY)
            return;
        if (pauses(s)) {
            side->next = reach;
            side->next_known = false;
            return;
        }
        if (group)
            make_group(s, i);
        else
            make_stool(s, i);
    }
}

/* Singles are drawn from `from` on, stools and groups from so far before it as they reach (`by` +1), or behind it. */
static void start_side(struct stems *s, int i, double from, double by)
{
    struct stems_side *side = &s->side[i];
    const double begin[STREAMS] = {[STREAM_STOOLS] = from - by * s->wood->reach,
                                   [STREAM_SINGLE] = from,
                                   [STREAM_GROUPS] = from - by * s->wood->group_reach};
    for (int k = 0; k < STREAMS; k++) {
        struct points *p = points_of(side, (enum stem_stream)k);
        if (!p)
            continue;
        p->next = p->count = 0;
        p->drawn = 0;
        p->end = begin[k];
        p->end_belt = 0;
    }
    make_single(s, i);
}

void ceduo_stems_begin(struct stems *s, uint64_t seed, uint64_t number, double b, double x)
{
    s->seed = seed;
    s->number = number;
    s->b = b;
    s->start = x;
    s->behind_ready = false;
    s->drawn = s->effort = 0;
    s->pause = PAUSE_STEMS;
    for (int i = 0; i < 2; i++) {
        s->side[i].first = s->side[i].end = 0;
        s->side[i].other_to = -INFINITY;
    }
    memset(s->met, 0, (s->wood->places + 1) * sizeof *s->met);
    start_side(s, 0, x, 1);
    find_next(s, 0);
    bool any = s->wood->along[0][0].from < x + fmax(s->wood->reach, s->wood->group_reach);
    s->side[1].next = any ? -x : INFINITY;
    s->side[1].next_known = false;
}

void ceduo_stems_look_on(struct stems *s, int i)
{
    struct stems_side *side = &s->side[i];
    s->pause = s->effort + PAUSE_STEMS;
    if (i == 1 && !s->behind_ready) {
        /* The strip behind the release is drawn only when a rock goes there. The stools and groups around the release are
         * those of the strip ahead. */
        if (!make_to(s, 0, STREAM_STOOLS, s->start + s->wood->reach))
            return;
        if (s->wood->grouped && !make_to(s, 0, STREAM_GROUPS, s->start + s->wood->group_reach))
            return;
        s->behind_ready = true;
        find_next(s, 0);
        start_side(s, 1, -s->start, -1);
        find_next(s, 1);
        return;
    }
    if (side->next_known && side->next_waits) {
        side->first++;
    } else if (side->next_known) {
        s->drawn++;
        s->effort++;
        make_single(s, i);
    }
    find_next(s, i);
}

void ceduo_stems_meet_behind(struct stems *s, uint64_t stool)
{
    const struct stems_side *behind = &s->side[1];
    for (size_t i = behind->first; i < behind->end; i++)
        behind->waiting[i].met |= behind->waiting[i].stool == stool;
}

/* ---- making and freeing ---- */

bool ceduo_stems_init(struct stems *stems, const struct wood *wood, enum ceduo_kernel kernel)
{
    stems->wood = wood;
    stems->kernel = ceduo_kernel(kernel);
    bool good = true;
    for (int i = 0; i < 2; i++) {
        struct stems_side *side = &stems->side[i];
        side->streams[STREAM_STOOLS].size = POINTS;
        side->streams[STREAM_SINGLE].size = POINTS_FEW;
        side->groups = wood->grouped ? calloc(1, sizeof *side->groups) : NULL;
        good &= !wood->grouped || side->groups;
        if (side->groups)
            side->groups->size = POINTS_FEW;
    }
    stems->met = calloc(wood->places + 1, sizeof *stems->met);
    stems->rates = calloc(wood->belts + 1, sizeof *stems->rates);
    if (good && stems->met && stems->rates)
        return true;
    ceduo_stems_release(stems);
    return false;
}

void ceduo_stems_release(struct stems *stems)
{
    for (int i = 0; i < 2; i++) {
        free(stems->side[i].waiting);
        free(stems->side[i].groups);
    }
    free(stems->met);
    free(stems->rates);
    *stems = (struct stems){0};
}
