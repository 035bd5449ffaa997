/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stems that a rock can hit, drawn as it reaches them. In each direction stools are one Poisson process along x, single trees,
 * stumps and logs a second, groups of trees a third. Each is drawn some places ahead (stems_fill.h). All stems of a stool or
 * group are made when the rock comes near. They stand around its centre, so they wait in a sorted queue. Work is counted as
 * effort. Drawing pauses regularly, so that the caller can cancel. */
#include "stems.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/random.h"
#include "kernel.h"
#define REAL_LANES 2
#include "stems_fill.h"

#define PAUSE_EFFORT 4096 /* effort between two checks for cancellation */

const struct kernel ceduo_kernel_scalar = {NULL, fill_points, make_stools};

/* ---- diameters ---- */

/* Draw a diameter from the gamma distribution, after Marsaglia and Tsang 2000. `extra` 1: weighted by the diameter, because
 * thick stems are met more often. */
static double draw_dbh(const struct stems *s, const struct forest_kind *k, uint64_t event, uint64_t kind, int extra)
{
    double shape = k->shape + extra, scale = k->scale;
    if (shape < 1) { /* their method needs shape >= 1 */
        double u = random_pair(s->seed, s->number, event, kind | (uint64_t)UINT32_MAX << 32).u[0] + 0x1p-54;
        scale *= ceduo_pow(u, 1 / shape);
        shape += 1;
    }
    double d = shape - 1.0 / 3, c = 1 / (3 * sqrt(d));
    for (uint64_t attempt = 0;; attempt++) {
        struct random_pair u = random_pair(s->seed, s->number, event, kind | attempt << 32);
        double z = ceduo_normal_quantile(u.u[0] + 0x1p-54), v = 1 + c * z;
        if (!(v > 0))
            continue;
        v = v * v * v;
        if (ceduo_log(u.u[1] + 0x1p-54) < 0.5 * (z * z) + d * (1 - v + ceduo_log(v)))
            return fmin(d * v * scale, k->dbh_max);
    }
}

/* Set energy and height of a stem, from its kind, diameter and offset. */
static void set_hit(const struct stems *s, struct stem *stem)
{
    const struct forest_kind *kind = stem->kind;
    double share = kind->by_eccentricity ? ceduo_dorren_share(ceduo_stem_eccentricity(stem, s->b)) : 1;
    stem->energy = kind->shape > 0 ? ceduo_stem_energy_hit(&kind->hit_energy, stem->dbh, share) : share * kind->full_energy;
    stem->height = get_hit_height(s, kind);
}

/* ---- stools ---- */

/* Reserve capacity for n more stems in the queue. */
static bool reserve_queue(struct stems *s, struct stems_side *side, size_t more)
{
    if (side->first == side->end)
        side->first = side->end = 0;
    if (side->end + more < side->capacity)
        return true;
    size_t count = side->end - side->first;
    if (count > 0)
        memmove(side->queue, side->queue + side->first, count * sizeof *side->queue);
    side->first = 0;
    side->end = count;
    if (2 * (count + more) <= side->capacity)
        return true;
    size_t capacity = 3 * (count + more) + 5; /* not whole pages, so that queues of lanes do not share cache sets */
    struct stem *queue = realloc(side->queue, capacity * sizeof *queue);
    s->no_memory |= !queue;
    if (!queue)
        return false;
    side->queue = queue;
    side->capacity = capacity;
    return true;
}

/* Insert a stem into the queue, sorted by distance. Requires capacity. */
static inline void insert_stem(struct stems *s, struct stems_side *side, const struct stem *stem)
{
    size_t end = side->end++, i = end;
    for (; i > side->first && side->queue[i - 1].along > stem->along; i--)
        side->queue[i] = side->queue[i - 1];
    side->queue[i] = *stem;
    s->effort += (end - i) / STEPS_PER_STEM;
}

/* Queue a stem that was drawn for a side. Requires capacity. A stem behind the start of the strip ahead goes to the queue of
 * the other side, whose own stools and groups begin beyond those that overlap the start. */
static void queue_stem(struct stems *s, int i_side, struct stem *stem)
{
    set_hit(s, stem);
    bool is_behind = i_side == 0 && stem->along < s->start;
    struct stems_side *to = &s->side[is_behind ? 1 : i_side];
    stem->along = is_behind ? -stem->along : stem->along;
    if (!stem->shoot || stem->kind->shape > 0)
        to->unequal_to = fmax(to->unequal_to, stem->along);
    if (!is_behind || reserve_queue(s, to, 1))
        insert_stem(s, to, stem);
}

/* Draw the next places of an exhausted stream. Return the first, or infinity. */
static __attribute__((noinline)) double draw_places(struct stems *s, int i_side, enum stem_stream stream)
{
    struct points *p = get_points(&s->side[i_side], stream);
    if (p->end_belt == s->forest->belts)
        return INFINITY;
    s->kernel->fill(s, i_side, stream);
    return p->count > 0 ? p->along[0] : INFINITY;
}

/* Return the next place of a stream, drawn if necessary; infinite if there is none. */
static inline double next_place(struct stems *s, int i_side, enum stem_stream stream)
{
    const struct points *p = get_points(&s->side[i_side], stream);
    return p->next < p->count ? p->along[p->next] : draw_places(s, i_side, stream);
}

/* Make a stool shoot by shoot: diameters vary, or shoots stand on both sides of the release. */
static __attribute__((noinline)) void make_uneven_stool(struct stems *s, int i_side)
{
    struct stool t = next_stool(s, i_side);
    for (unsigned i = 0; i < t.n; i++) {
        struct stem stem = {.shoot = true, .stool = t.event};
        place_shoot(&t, i, &stem.along, &stem.y);
        if (fabs(stem.y) > (s->b + t.stools->dbh_max) / 2)
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
        queue_stem(s, i_side, &stem);
    }
}

/* Make the next stool of a side, and possibly some after it. */
static void make_stool(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    const struct points *p = &side->streams[STREAM_STOOLS];
    bool unequal = side->first < side->end && side->unequal_to >= side->queue[side->first].along;
    bool plain = is_plain_stool(s, i_side) && side->end - side->first < SHOOTS_ENOUGH && !unequal;
    size_t n = plain ? SHOOTS_MAX : s->forest->sides[i_side][p->belt[p->next]].stools->n + 1;
    if (!reserve_queue(s, side, n))
        return;
    if (plain)
        s->kernel->make_stools(s, i_side);
    else
        make_uneven_stool(s, i_side);
}

/* Return the stratum of a place in a merged stream; sets *u, uniform in [0, 1) within it. */
static const struct forest_stratum *pick_stratum(struct stems *s, int side, const struct forest_belt *belt, size_t j,
                                                 enum stem_stream stream, double mark, double *u)
{
    double remaining = mark * rates_in(s, side, j)->rate[stream], rate = 0;
    const struct forest_stratum *found = NULL;
    for (size_t k = 0; k < belt->strata_count; k++) { /* untaken: rounding */
        const struct forest_stratum *stratum = &belt->strata[k];
        if (get_stream(stratum) != stream)
            continue;
        found = stratum;
        rate = stratum->base_rate + stratum->rate_per_b * s->b;
        if (remaining < rate)
            break;
        remaining -= rate;
    }
    s->effort += belt->strata_count / STEPS_PER_STEM;
    *u = remaining / rate;
    return found;
}

/* ---- groups of trees ---- */

/* Make the next group of a side. Its trees are independent. */
static __attribute__((noinline)) void make_group(struct stems *s, int i_side)
{
    struct points *p = get_points(&s->side[i_side], STREAM_GROUPS);
    unsigned k = p->next;
    uint64_t event = get_event(p, STREAM_GROUPS, i_side, k);
    double u;
    const struct forest_belt *belt = &s->forest->sides[i_side][p->belt[k]];
    const struct forest_stratum *t = pick_stratum(s, i_side, belt, p->belt[k], STREAM_GROUPS, p->mark[k], &u);
    if (!reserve_queue(s, &s->side[i_side], t->group))
        return;
    p->next++;
    s->drawn += t->group;
    s->effort += 1 + t->group;
    double centre = p->offset[k] * (2 * t->radius + t->kind->dbh_max + s->b);
    for (unsigned i = 0; i < t->group; i++) {
        struct stem stem = {.kind = t->kind, .stool = event | (uint64_t)(i + 1) << 44};
        struct random_pair draw = random_pair(s->seed, s->number, event, shoot_draw(RANDOM_GROUP, i));
        double angle = 2 * M_PI * (draw.u[1] - 0.5), distance = t->radius * sqrt(draw.u[0]), sine, cosine;
        elementary_sincos(&angle, &sine, &cosine);
        stem.along = p->along[k] + distance * cosine;
        stem.y = centre + distance * sine;
        /* reflect at the ends of the belt, so that the density is uniform */
        if (!(stem.along >= belt->from && stem.along <= belt->to)) {
            double span = belt->to - belt->from, past = fabs(fmod(stem.along - belt->from, 2 * span));
            stem.along = belt->from + (past <= span ? past : 2 * span - past);
        }
        if (fabs(stem.y) > (s->b + t->kind->dbh_max) / 2)
            continue;
        bool spreads = t->kind->shape > 0;
        stem.dbh = spreads ? draw_dbh(s, t->kind, event, shoot_draw(RANDOM_DBH, i), 0) : t->kind->dbh;
        if (fabs(stem.y) <= (s->b + stem.dbh) / 2)
            queue_stem(s, i_side, &stem);
    }
}

/* ---- single trees ---- */

/* Make the next single tree of a side. */
static void make_single(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    struct points *p = &side->streams[STREAM_SINGLE];
    side->single.along = next_place(s, i_side, STREAM_SINGLE);
    if (!(side->single.along < INFINITY))
        return;
    unsigned k = p->next;
    uint64_t event = get_event(p, STREAM_SINGLE, i_side, k);
    double u;
    const struct forest_belt *belt = &s->forest->sides[i_side][p->belt[k]];
    const struct forest_kind *kind = pick_stratum(s, i_side, belt, p->belt[k], STREAM_SINGLE, p->mark[k], &u)->kind;
    double d = kind->dbh;
    if (kind->shape > 0) /* probability of an encounter is proportional to b + d */
        d = draw_dbh(s, kind, event, RANDOM_DBH, u * (s->b + d) >= s->b);
    side->single = (struct stem){.along = p->along[k], .y = p->offset[k] * (s->b + d), .dbh = d, .kind = kind, .stool = event};
    set_hit(s, &side->single);
    p->next++;
}

/* ---- next stem ---- */

/* True if drawing must pause: check for cancellation, or a limit. */
static bool must_pause(const struct stems *s)
{
    return s->no_memory || s->effort >= s->pause || ceduo_stems_too_many(s);
}

/* Make the stools or groups with a centre up to `to` along a side. False if it paused before. */
static bool make_centres_to(struct stems *s, int side, enum stem_stream stream, double to)
{
    for (double along; (along = next_place(s, side, stream)) <= to && along < INFINITY;) { /* untaken: rounding */
        if (must_pause(s))
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
        double queued = any ? side->queue[side->first].along : INFINITY, single = side->single.along;
        side->next_queued = any && queued <= single;
        side->next = side->next_queued ? queued : single;
        side->next_known = true;
        /* minimum place of stems that are not drawn yet, of the next stool or group */
        double reach = next_place(s, i, STREAM_STOOLS) - s->forest->reach;
        if (s->forest->grouped) {
            double groups = next_place(s, i, STREAM_GROUPS) - s->forest->group_reach;
            group = groups < reach;
            reach = group ? groups : reach;
        }
        side->certain_to = reach < single ? reach : single;
        if (!(reach <= side->next) || reach == INFINITY)
            return;
        if (must_pause(s)) {
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

/* Restart a side: singles from `from` on, stools and groups from their reach before it (`direction` 1) or after it (-1). */
static void reset_side(struct stems *s, int i, double from, double direction)
{
    struct stems_side *side = &s->side[i];
    const double starts[STREAMS] = {[STREAM_STOOLS] = from - direction * s->forest->reach,
                                    [STREAM_SINGLE] = from,
                                    [STREAM_GROUPS] = from - direction * s->forest->group_reach};
    for (int k = 0; k < STREAMS; k++) {
        struct points *p = get_points(side, (enum stem_stream)k);
        if (!p)
            continue;
        p->next = p->count = 0;
        p->drawn = 0;
        p->end = starts[k];
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
    if (s->drawn > 0) /* the last rock may have hit stools */
        memset(s->hit_stools, 0, (s->forest->met_mask + 1) * sizeof *s->hit_stools);
    s->drawn = s->effort = 0;
    s->pause = PAUSE_EFFORT;
    for (int i = 0; i < 2; i++) {
        s->side[i].first = s->side[i].end = 0;
        s->side[i].unequal_to = -INFINITY;
    }
    reset_side(s, 0, x, 1);
    find_next(s, 0);
    bool any = s->forest->sides[0][0].from < x + fmax(s->forest->reach, s->forest->group_reach);
    s->side[1].next = any ? -x : INFINITY;
    s->side[1].next_known = false;
}

void ceduo_stems_advance(struct stems *s, int i)
{
    struct stems_side *side = &s->side[i];
    s->pause = s->effort + PAUSE_EFFORT;
    if (i == 1 && !s->behind_ready) {
        /* The strip behind the release is drawn only when a rock enters it. Stools and groups around the release belong to side
         * 0. */
        if (!make_centres_to(s, 0, STREAM_STOOLS, s->start + s->forest->reach))
            return;
        if (s->forest->grouped && !make_centres_to(s, 0, STREAM_GROUPS, s->start + s->forest->group_reach))
            return;
        s->behind_ready = true;
        find_next(s, 0);
        reset_side(s, 1, -s->start, -1);
        find_next(s, 1);
        return;
    }
    if (side->next_known && side->next_queued) {
        side->first++;
    } else if (side->next_known) {
        s->drawn++;
        s->effort++;
        make_single(s, i);
    }
    find_next(s, i);
}

void ceduo_stems_mark_hit_behind(struct stems *s, uint64_t stool)
{
    const struct stems_side *side_behind = &s->side[1];
    for (size_t i = side_behind->first; i < side_behind->end; i++)
        side_behind->queue[i].stool_hit |= side_behind->queue[i].stool == stool;
}

/* ---- making and freeing ---- */

struct stems *ceduo_stems_create(const struct forest *forest, enum ceduo_kernel kernel)
{
    struct stems *stems = calloc(1, sizeof *stems);
    if (!stems)
        return NULL;
    stems->forest = forest;
    stems->kernel = ceduo_kernel(kernel);
    bool good = true;
    for (int i = 0; i < 2; i++) {
        struct stems_side *side = &stems->side[i];
        side->streams[STREAM_STOOLS].size = POINTS;
        side->streams[STREAM_SINGLE].size = POINTS_SPARSE;
        side->groups = forest->grouped ? calloc(1, sizeof *side->groups) : NULL;
        good &= !forest->grouped || side->groups;
        if (side->groups)
            side->groups->size = POINTS_SPARSE;
    }
    stems->hit_stools = calloc(forest->met_mask + 1, sizeof *stems->hit_stools);
    stems->rates = calloc(forest->belts + 1, sizeof *stems->rates);
    if (good && stems->hit_stools && stems->rates)
        return stems;
    ceduo_stems_free(stems);
    return NULL;
}

void ceduo_stems_free(struct stems *stems)
{
    if (!stems)
        return;
    for (int i = 0; i < 2; i++) {
        free(stems->side[i].queue);
        free(stems->side[i].groups);
    }
    free(stems->hit_stools);
    free(stems->rates);
    free(stems);
}
