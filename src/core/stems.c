/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stems that a rock can hit, drawn as it reaches them. In each direction every stratum is a stream of exponential gaps.
 * The next stem is the nearest of all streams. A stool is drawn whole and its shoots wait, sorted, because they stand around
 * its centre. Work is counted as effort, and drawing pauses now and then, so that a caller can cancel. */
#include "stems.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "random.h"

/* What costs little is counted as a part of a stem: steps over others in a list, belts and strata that are passed over. */
#define STEPS_OF_A_STEM 4
#define PAUSE_STEMS 4096 /* effort between two looks at whether the rock is still waited for */

/* The number of an event, never 0: which stratum, which side, the how-manieth. The side is its last bit. */
static uint64_t event_of(size_t stratum, int side, uint64_t n)
{
    return (uint64_t)stratum << 41 | (n + 1) << 1 | (uint64_t)side;
}

/* What belongs to shoot i of a stool. */
static uint64_t kind_of_shoot(enum random_kind kind, unsigned i)
{
    return (uint64_t)kind | (uint64_t)i << 8;
}

/* ---- diameters ---- */

/* A diameter by the gamma law, after Marsaglia and Tsang 2000. `extra` 1: weighted by the diameter itself, as thick stems
 * are met more often. */
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

/* ---- one stratum along the strip ---- */

/* Moves a stream to its next place: gaps are exponential in the rate summed along the strip, across belts. */
static void advance(struct stems *s, int side, size_t stratum)
{
    struct stream *stream = &s->side[side].streams[stratum];
    const struct wood_belt *belts = s->wood->along[side];
    size_t first = stream->belt;
    uint64_t event = event_of(stratum, side, stream->drawn++);
    struct random_four four = random_four(s->seed, s->number, event, RANDOM_STEM);
    double left = -ceduo_log(four.first + 0x1p-54), at = stream->at;
    stream->offset = four.rest[0] + 0x1p-26;
    stream->turn = four.rest[1] + 0x1p-26;
    stream->number = four.rest[2] + 0x1p-26;
    for (; stream->belt < s->wood->belts; stream->belt++) {
        const struct wood_belt *belt = &belts[stream->belt];
        if (stratum >= belt->strata_count)
            continue;
        double rate = belt->strata[stratum].still + belt->strata[stratum].per_b * s->b;
        double from = at > belt->from ? at : belt->from;
        if (!(from < belt->to))
            continue;
        double room = (belt->to - from) * rate;
        if (left < room) {
            at = from + left / rate;
            stream->at = at < belt->to ? at : belt->to;
            s->effort += (stream->belt - first) / STEPS_OF_A_STEM;
            return;
        }
        left -= room;
    }
    stream->at = INFINITY;
    s->effort += (stream->belt - first) / STEPS_OF_A_STEM;
}

/* ---- stools ---- */

/* Room for `more` stems behind those that wait. */
static bool make_room(struct stems *s, struct stems_side *side, size_t more)
{
    if (side->end + more <= side->room)
        return true;
    size_t count = side->end - side->first;
    if (count > 0)
        memmove(side->waiting, side->waiting + side->first, count * sizeof *side->waiting);
    side->first = 0;
    side->end = count;
    if (2 * (count + more) <= side->room)
        return true;
    size_t room = 4 * (count + more) + 64;
    struct stem *waiting = realloc(side->waiting, room * sizeof *waiting);
    s->no_memory |= !waiting;
    if (!waiting)
        return false;
    side->waiting = waiting;
    side->room = room;
    return true;
}

/* Puts a stem among those waiting, for which there is room, in the order they are come to. */
static inline void put_in(struct stems *s, struct stems_side *side, const struct stem *stem)
{
    size_t end = side->end++, i = end;
    for (; i > side->first && side->waiting[i - 1].along > stem->along; i--)
        side->waiting[i] = side->waiting[i - 1];
    side->waiting[i] = *stem;
    s->effort += (end - i) / STEPS_OF_A_STEM;
}

static const struct wood_kind *draw_cohort(const struct stems *s, const struct wood_stools *stools, uint64_t event,
                                           unsigned i)
{
    const struct wood_kind *k = stools->kinds;
    if (stools->cohorts == 1)
        return k;
    double u = random_pair(s->seed, s->number, event, kind_of_shoot(RANDOM_SHOOT, i)).u[0];
    while (u >= k->share_to)
        k++;
    return k;
}

/* A shoot that stands behind the start of the strip ahead belongs to the strip behind, whose own stools begin beyond
 * those that reach over the start. */
static __attribute__((noinline)) void turn_behind(struct stems *s, struct stem stem)
{
    stem.along = -stem.along;
    if (make_room(s, &s->side[1], 1))
        put_in(s, &s->side[1], &stem);
}

/* The kind and diameter of shoot i of a stool whose shoots differ. */
static __attribute__((noinline)) const struct wood_kind *draw_shoot(const struct stems *s,
                                                                   const struct wood_stools *stools, uint64_t event,
                                                                   unsigned i, double *dbh)
{
    const struct wood_kind *k = draw_cohort(s, stools, event, i);
    *dbh = k->shape > 0 ? draw_dbh(s, k, event, kind_of_shoot(RANDOM_DBH, i), 0) : k->dbh;
    return k;
}

/* The shoots of the stool that the stream of side `side` has come to, as far as the rock can hit them. */
static void draw_stool(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    const struct stream *stream = &side->streams[0];
    const struct wood_stools *stools = s->wood->along[i_side][stream->belt].stools;
    uint64_t event = event_of(0, i_side, stream->drawn - 1);
    double centre = (stream->offset - 0.5) * (2 * stools->reach + stools->most + s->b);
    unsigned more = stream->number < stools->more, n = stools->n + more;
    if (!make_room(s, side, n))
        return;
    s->drawn += n;
    s->effort += 1 + n;
    double r = stools->radius[more], sine, cosine;
    const double *ring = stools->ring[more];
    wood_direction(s->wood, (stream->turn - 0.5) * stools->turn[more], &cosine, &sine);
    sine *= r;
    cosine *= r;
    for (unsigned i = 0; i < n; i++) {
        double y = centre + (ring[2 * i] * sine + ring[2 * i + 1] * cosine);
        if (fabs(y) > (s->b + stools->most) / 2)
            continue;
        struct stem stem = {.along = stream->at + (ring[2 * i] * cosine - ring[2 * i + 1] * sine),
                            .y = y,
                            .dbh = stools->kinds->dbh,
                            .kind = stools->kinds,
                            .shoot = true,
                            .stool = event};
        if (stools->varied) {
            stem.kind = draw_shoot(s, stools, event, i, &stem.dbh);
            if (fabs(y) > (s->b + stem.dbh) / 2)
                continue;
        }
        if (i_side == 0 && stem.along < s->start)
            turn_behind(s, stem);
        else
            put_in(s, side, &stem);
    }
}

/* Whether it is time to let the caller look up. */
static bool pauses(const struct stems *s)
{
    return s->no_memory || s->effort >= s->pause || ceduo_stems_too_many(s);
}

/* Draws the stools that have a centre up to `to` along a side; false where it stopped before. */
static bool draw_stools_to(struct stems *s, int side, double to)
{
    struct stream *stream = &s->side[side].streams[0];
    while (stream->at <= to && stream->at < INFINITY) {
        if (pauses(s))
            return false;
        draw_stool(s, side);
        advance(s, side, 0);
    }
    return true;
}

/* ---- what comes next ---- */

/* The nearest of all streams but the stools'. */
static void find_single(struct stems *s, struct stems_side *side)
{
    side->single_at = INFINITY;
    s->effort += s->wood->strata / STEPS_OF_A_STEM;
    for (size_t k = s->poisson ? 0 : 1; k < s->wood->strata; k++)
        if (side->streams[k].at < side->single_at) {
            side->single_at = side->streams[k].at;
            side->single = k;
        }
}

static void find_next(struct stems *s, int i)
{
    struct stems_side *side = &s->side[i];
    for (;;) {
        bool any = side->first < side->end;
        double waits = any ? side->waiting[side->first].along : INFINITY;
        side->next_waits = any && waits <= side->single_at;
        side->next = side->next_waits ? waits : side->single_at;
        side->next_known = true;
        if (s->poisson || !(side->streams[0].at < INFINITY))
            return;
        double reach = side->streams[0].at - s->wood->reach; /* a stool reaches ahead of its centre */
        if (reach > side->next)
            return;
        if (pauses(s)) {
            side->next = reach;
            side->next_known = false;
            return;
        }
        draw_stool(s, i);
        advance(s, i, 0);
    }
}

static void start_side(struct stems *s, int i, double from, double stools_from)
{
    struct stems_side *side = &s->side[i];
    for (size_t k = 0; k < s->wood->strata; k++) {
        side->streams[k] = (struct stream){.at = k == 0 && !s->poisson ? stools_from : from};
        advance(s, i, k);
    }
    find_single(s, side);
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
    for (int i = 0; i < 2; i++)
        s->side[i].first = s->side[i].end = 0;
    memset(s->met, 0, (s->wood->places + 1) * sizeof *s->met);
    start_side(s, 0, x, x - s->wood->reach);
    find_next(s, 0);
    bool any = s->wood->belts > 0 && s->wood->along[0][0].from < x + s->wood->reach;
    s->side[1].next = any ? -x : INFINITY;
}

/* The strip behind the release is drawn only when a rock goes there. The stools around the release are those of the strip
 * ahead. */
static void prepare_behind(struct stems *s)
{
    if (!s->poisson && !draw_stools_to(s, 0, s->start + s->wood->reach))
        return;
    s->behind_ready = true;
    find_next(s, 0);
    start_side(s, 1, -s->start, -s->start + s->wood->reach);
    find_next(s, 1);
}

bool ceduo_stems_take(struct stems *s, int i, struct stem *stem)
{
    struct stems_side *side = &s->side[i];
    s->pause = s->effort + PAUSE_STEMS;
    if (i == 1 && !s->behind_ready) {
        prepare_behind(s);
        return false;
    }
    if (!side->next_known) {
        find_next(s, i);
        return false;
    }
    if (side->next_waits) {
        *stem = side->waiting[side->first++];
    } else {
        const struct stream *stream = &side->streams[side->single];
        const struct wood_kind *k = s->wood->along[i][stream->belt].strata[side->single].kind;
        uint64_t event = event_of(side->single, i, stream->drawn - 1);
        double d = k->dbh;
        if (k->shape > 0) { /* met with a chance that goes with b + d */
            d = draw_dbh(s, k, event, RANDOM_DBH, stream->number * (s->b + d) >= s->b);
        }
        *stem = (struct stem){.along = stream->at, .dbh = d, .kind = k, .stool = event};
        stem->y = s->poisson ? NAN : (stream->offset - 0.5) * (s->b + d);
        s->drawn++;
        s->effort++;
        advance(s, i, side->single);
        find_single(s, side);
    }
    find_next(s, i);
    return true;
}

void ceduo_stems_meet_behind(struct stems *s, uint64_t stool)
{
    const struct stems_side *behind = &s->side[1];
    for (size_t i = behind->first; i < behind->end; i++)
        behind->waiting[i].met |= behind->waiting[i].stool == stool;
}

/* ---- making and freeing ---- */

bool ceduo_stems_init(struct stems *stems, const struct wood *wood, bool poisson)
{
    *stems = (struct stems){.wood = wood, .poisson = poisson};
    for (int i = 0; i < 2; i++)
        stems->side[i].streams = calloc(wood->strata + 1, sizeof *stems->side[i].streams);
    stems->met = calloc(wood->places + 1, sizeof *stems->met);
    if (stems->side[0].streams && stems->side[1].streams && stems->met)
        return true;
    ceduo_stems_release(stems);
    return false;
}

void ceduo_stems_release(struct stems *stems)
{
    for (int i = 0; i < 2; i++) {
        free(stems->side[i].streams);
        free(stems->side[i].waiting);
    }
    free(stems->met);
    *stems = (struct stems){0};
}
