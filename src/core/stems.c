/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stems.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "random.h"
#include "sincos.h"

static const double PI = 3.14159265358979323846;

/* The number of an event: which stratum, which side, the how-manieth. */
static uint64_t event_of(size_t stratum, int side, uint64_t n)
{
    return ((uint64_t)stratum * 2 + (uint64_t)side) << 40 | n;
}

/* What belongs to shoot i of a stool. */
static uint64_t kind_of_shoot(enum random_kind kind, unsigned i)
{
    return (uint64_t)kind | (uint64_t)i << 8;
}

/* ---- diameters ---- */

/* Our random numbers as a source for GSL's distributions: those of one stem, one after the other. */
struct source {
    uint64_t seed, rock, event, kind;
    uint64_t used;
};

static void source_set(void *state, unsigned long seed)
{
    (void)state;
    (void)seed;
}

static double source_double(void *state)
{
    struct source *s = state;
    return random_pair(s->seed, s->rock, s->event, s->kind | s->used++ << 32).u[0];
}

static unsigned long source_get(void *state)
{
    return (unsigned long)(source_double(state) * 0x1p32);
}

static const gsl_rng_type source_type = {"threefry", 0xffffffffu, 0, sizeof(struct source), source_set, source_get,
                                         source_double};

/* A diameter by the gamma law; `extra` 1: weighted by the diameter itself, as thick stems are met more often. */
static double draw_dbh(const struct stems *s, const struct wood_kind *k, uint64_t event, uint64_t kind, int extra)
{
    struct source source = {s->seed, s->number, event, kind, 0};
    gsl_rng rng = {&source_type, &source};
    return fmin(gsl_ran_gamma(&rng, k->shape + extra, k->scale), k->most);
}

/* ---- one stratum along the way ---- */

/* Moves a stream to its next place: gaps are exponential in the rate summed along the way, across belts. */
static void advance(struct stems *s, int side, size_t stratum)
{
    struct stream *stream = &s->side[side].streams[stratum];
    const struct wood_belt *belts = s->wood->along[side];
    struct random_pair pair = random_pair(s->seed, s->number, event_of(stratum, side, stream->drawn++), RANDOM_STEM);
    double left = -log(pair.u[0] + 0x1p-54), at = stream->at;
    stream->offset = pair.u[1];
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
            return;
        }
        left -= room;
    }
    stream->at = INFINITY;
}

/* ---- stools ---- */

static bool make_room(struct stems *s, struct stems_side *side)
{
    if (side->count < side->room)
        return true;
    size_t room = side->room > 0 ? 2 * side->room : 32;
    struct stem *waiting = realloc(side->waiting, room * sizeof *waiting);
    s->no_memory |= !waiting;
    if (!waiting)
        return false;
    side->waiting = waiting;
    side->room = room;
    return true;
}

static void wait_for(struct stems *s, int to, const struct stem *stem)
{
    struct stems_side *side = &s->side[to];
    if (!make_room(s, side))
        return;
    size_t i = side->count++;
    for (; i > 0 && side->waiting[i - 1].along < stem->along; i--)
        side->waiting[i] = side->waiting[i - 1];
    side->waiting[i] = *stem;
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

/* A shoot at `along`, `y`, if it stands in the rock's way. Those before the start belong to the other side. */
static void add_shoot(struct stems *s, int side, const struct wood_stools *stools, uint64_t event, unsigned i,
                      double along, double y)
{
    if (fabs(y) > (s->b + stools->most) / 2)
        return;
    const struct wood_kind *k = draw_cohort(s, stools, event, i);
    struct stem stem = {.along = along, .y = y, .kind = k, .height = k->height, .shoot = true, .stool = event};
    stem.dbh = k->shape > 0 ? draw_dbh(s, k, event, kind_of_shoot(RANDOM_DBH, i), 0) : k->dbh;
    if (fabs(y) > (s->b + stem.dbh) / 2)
        return;
    double start = side == 0 ? s->start : -s->start;
    if (along < start) {
        stem.along = -along;
        if (side == 0)
            wait_for(s, 1, &stem);
        return; /* side 1 begins beyond the stools that reach over the start */
    }
    wait_for(s, side, &stem);
}

/* The shoots of the stool that the stream of side `side` has come to. */
static void draw_stool(struct stems *s, int side)
{
    const struct stream *stream = &s->side[side].streams[0];
    const struct wood_stools *stools = s->wood->along[side][stream->belt].stools;
    uint64_t event = event_of(0, side, stream->drawn - 1);
    double y = (stream->offset - 0.5) * (2 * stools->reach + stools->most + s->b);
    unsigned n = stools->n;
    struct random_pair pair = {{0, 0}};
    if (stools->more > 0 || n > 1) {
        pair = random_pair(s->seed, s->number, event, RANDOM_STOOL);
        n += pair.u[0] < stools->more;
    }
    s->drawn += n;
    if (n == 1) {
        add_shoot(s, side, stools, event, 0, stream->at, y);
        return;
    }
    double r = stools->radius[n - stools->n], sine, cosine;
    const double *ring = stools->ring[n - stools->n];
    sincos_quarter((pair.u[1] - 0.5) * (2 * PI) / n, &sine, &cosine);
    sine *= r;
    cosine *= r;
    for (unsigned i = 0; i < n; i++)
        add_shoot(s, side, stools, event, i, stream->at + (ring[2 * i] * cosine - ring[2 * i + 1] * sine),
                  y + (ring[2 * i] * sine + ring[2 * i + 1] * cosine));
}

/* Draws the stools that have a centre up to `to` along a side. */
static void draw_stools_to(struct stems *s, int side, double to)
{
    struct stream *stream = &s->side[side].streams[0];
    while (stream->at <= to && stream->at < INFINITY && !s->no_memory) {
        draw_stool(s, side);
        advance(s, side, 0);
    }
}

/* ---- what comes next ---- */

static void find_next(struct stems *s, int i)
{
    struct stems_side *side = &s->side[i];
    size_t first = s->poisson ? 0 : 1;
    side->next = INFINITY;
    side->from = SIZE_MAX;
    for (size_t k = first; k < s->wood->strata; k++)
        if (side->streams[k].at < side->next) {
            side->next = side->streams[k].at;
            side->from = k;
        }
    for (;;) {
        if (side->count > 0 && side->waiting[side->count - 1].along <= side->next) {
            side->next = side->waiting[side->count - 1].along;
            side->from = SIZE_MAX;
        }
        /* a stool reaches ahead of its centre */
        if (first == 0 || !(side->streams[0].at < INFINITY) || s->no_memory ||
            side->streams[0].at - s->wood->reach > side->next)
            return;
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
}

void ceduo_stems_begin(struct stems *s, uint64_t seed, uint64_t number, double b, double x)
{
    s->seed = seed;
    s->number = number;
    s->b = b;
    s->start = x;
    s->behind_ready = false;
    s->drawn = 0;
    s->side[0].count = s->side[1].count = 0;
    start_side(s, 0, x, x - s->wood->reach);
    find_next(s, 0);
    bool any = s->wood->belts > 0 && s->wood->along[0][0].from < x + s->wood->reach;
    s->side[1].next = any ? -x : INFINITY;
}

/* The way behind the release is drawn only when a rock goes there. The stools around the release are those of the way
 * ahead. */
static void prepare_behind(struct stems *s)
{
    s->behind_ready = true;
    if (!s->poisson)
        draw_stools_to(s, 0, s->start + s->wood->reach);
    find_next(s, 0);
    start_side(s, 1, -s->start, -s->start + s->wood->reach);
    find_next(s, 1);
}

bool ceduo_stems_take(struct stems *s, int i, struct stem *stem)
{
    struct stems_side *side = &s->side[i];
    if (i == 1 && !s->behind_ready) {
        prepare_behind(s);
        return false;
    }
    if (side->from == SIZE_MAX) {
        *stem = side->waiting[--side->count];
    } else {
        const struct stream *stream = &side->streams[side->from];
        const struct wood_kind *k = s->wood->along[i][stream->belt].strata[side->from].kind;
        uint64_t event = event_of(side->from, i, stream->drawn - 1);
        double d = k->dbh;
        if (k->shape > 0) { /* met with a chance that goes with b + d */
            double u = random_pair(s->seed, s->number, event, RANDOM_STOOL).u[0];
            d = draw_dbh(s, k, event, RANDOM_DBH, u * (s->b + d) >= s->b);
        }
        *stem = (struct stem){.along = stream->at, .dbh = d, .height = k->height, .kind = k, .stool = event};
        stem->y = s->poisson ? NAN : (stream->offset - 0.5) * (s->b + d);
        s->drawn++;
        advance(s, i, side->from);
    }
    find_next(s, i);
    return true;
}

void ceduo_stems_note_hit(struct stems *s, const struct stem *stem)
{
    for (int i = 0; i < 2 && stem->shoot; i++)
        for (size_t j = 0; j < s->side[i].count; j++)
            s->side[i].waiting[j].met |= s->side[i].waiting[j].stool == stem->stool;
}

double ceduo_stem_energy(const struct stem *stem, double b)
{
    const struct wood_kind *k = stem->kind;
    if (!isnan(k->energy))
        return k->energy;
    if (k->stand->energy == CEDUO_DORREN)
        return ceduo_dorren_share(2 * fabs(stem->y) / (b + stem->dbh)) *
               ceduo_dorren_energy(stem->dbh, k->stand->fracture_ratio);
    struct ceduo_stems one = *k->stems;
    one.dbh = stem->dbh;
    if (!isnan(one.volume)) /* the mean of all, which goes with the square of the diameter */
        one.volume *= stem->dbh * stem->dbh / (k->dbh * k->dbh + k->stems->dbh_sd * k->stems->dbh_sd);
    return ceduo_contact_energy(k->stand, &one);
}

/* ---- making and freeing ---- */

bool ceduo_stems_init(struct stems *stems, const struct wood *wood, bool poisson)
{
    *stems = (struct stems){.wood = wood, .poisson = poisson};
    for (int i = 0; i < 2; i++)
        stems->side[i].streams = calloc(wood->strata + 1, sizeof *stems->side[i].streams);
    if (stems->side[0].streams && stems->side[1].streams)
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
    *stems = (struct stems){0};
}
