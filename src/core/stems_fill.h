/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The next places of streams of stools or trees, and the shoots of the next stools, many at once: see stems.h. This is
 * compiled for each kind of registers. */
#ifndef CEDUO_STEMS_FILL_H
#define CEDUO_STEMS_FILL_H

#include "many.h"
#include "random.h"
#include "stems_state.h"

/* What costs little is counted as a part of a stem: steps over others in a list, belts that are passed over. */
#define STEPS_OF_A_STEM 4

_Static_assert(POINTS % MANY == 0, "places are drawn in whole vectors");

/* The number of an event, never 0: which stream, which side, the how-manieth. The side is its last bit. */
static inline uint64_t stem_event(enum stem_stream stream, int side, uint64_t n)
{
    return (uint64_t)stream << 41 | (n + 1) << 1 | (uint64_t)side;
}

/* What belongs to shoot i of a stool, or to its i-th draw. */
static inline uint64_t shoot_draw(enum random_kind kind, unsigned i)
{
    return (uint64_t)kind | (uint64_t)i << 8;
}

/* What is drawn of each place: of the gap before it 40 bits, of the mark 38, of offset and turn 25 each. Gaps are in
 * units of their mean. */
static inline void draw_points(const struct stems *s, uint64_t event, struct points *to, double gaps[POINTS])
{
    for (unsigned i = 0; i < to->size; i += MANY) {
        many_bits p, q, low;
        many_reals u, log;
        many_from(event + 2 * i, 2, &p);
        many_from(RANDOM_STEM, 0, &q);
        many_threefry(s->seed, s->number, &p, &q);
        low = p >> 24;
        many_of_integers(&low, &u);
        u = u * 0x1p-40 + 0x1p-41;
        many_log(&u, &log);
        log = -log;
        memcpy(&gaps[i], &log, sizeof log);
        low = (p & 0xffffff) << 14 | q >> 50;
        many_of_integers(&low, &u);
        u = u * 0x1p-38 + 0x1p-39;
        memcpy(&to->mark[i], &u, sizeof u);
        low = q & 0x1ffffff;
        many_of_integers(&low, &u);
        u = u * 0x1p-25 + (0x1p-26 - 0.5);
        memcpy(&to->offset[i], &u, sizeof u);
        low = q >> 25 & 0x1ffffff;
        many_of_integers(&low, &u);
        u = u * 0x1p-25 + (0x1p-26 - 0.5);
        memcpy(&to->turn[i], &u, sizeof u);
    }
}

static inline const struct belt_rates *rates_in(struct stems *s, int side, size_t belt)
{
    struct belt_rates *r = &s->rates[side == 0 ? belt : s->wood->belts - 1 - belt];
    if (r->b != s->b) {
        const struct wood_belt *from = &s->wood->along[side][belt];
        *r = (struct belt_rates){.b = s->b};
        for (size_t k = 0; k < from->strata_count; k++)
            r->rate[stream_of(&from->strata[k])] +=
                from->strata[k].still + from->strata[k].per_b * s->b;
        for (int k = 0; k < STREAMS; k++)
            r->metres[k] = 1 / r->rate[k];
    }
    return r;
}

/* Where the places stand: gaps are exponential in the rate summed along the strip, across belts. */
static inline void place_points(struct stems *s, int side, enum stem_stream stream, const double gaps[POINTS])
{
    struct points *p = points_of(&s->side[side], stream);
    double at = p->end;
    size_t j = p->end_belt, first = j;
    unsigned i = 0;
    double left = gaps[0];
    while (i < p->size && j < s->wood->belts) {
        const struct wood_belt *belt = &s->wood->along[side][j];
        const struct belt_rates *r = rates_in(s, side, j);
        double rate = r->rate[stream], metres = r->metres[stream];
        at = at > belt->from ? at : belt->from;
        double room = at < belt->to ? (belt->to - at) * rate : 0;
        for (; left < room; room = (belt->to - at) * rate) {
            at += left * metres;
            at = at < belt->to ? at : belt->to;
            p->at[i] = at;
            p->belt[i] = j;
            if (++i == p->size)
                break;
            left = gaps[i];
        }
        if (i == p->size)
            break;
        left -= room;
        j++;
    }
    s->effort += (j - first) / STEPS_OF_A_STEM;
    p->next = 0;
    p->count = i;
    p->end = at;
    p->end_belt = j;
}

/* Which way the rings of stools are turned. */
static inline void turn_points(const struct stems *s, int side, struct points *p)
{
    _Alignas(64) double angle[POINTS];
    for (unsigned i = 0; i < p->size; i++) {
        const struct wood_stools *stools = i < p->count ? s->wood->along[side][p->belt[i]].stools : NULL;
        angle[i] = stools ? p->turn[i] * stools->turn[p->mark[i] < stools->more] : 0;
    }
    for (unsigned i = 0; i < p->size; i += MANY) {
        many_reals a, sine, cosine;
        memcpy(&a, &angle[i], sizeof a);
        many_sincos(&a, &sine, &cosine);
        memcpy(&p->sine[i], &sine, sizeof sine);
        memcpy(&p->cosine[i], &cosine, sizeof cosine);
    }
}

/* 32 bits for each shoot of those stools that have cohorts: four from one draw. */
static inline void draw_cohorts(const struct stems *s, int side, struct points *p, uint64_t event)
{
    unsigned most = 0;
    for (unsigned i = 0; i < p->count; i++) {
        const struct wood_stools *stools = s->wood->along[side][p->belt[i]].stools;
        if (stools->cohorts > 1 && stools->n + 1 > most)
            most = stools->n + 1;
    }
    for (unsigned group = 0; group < COHORT_GROUPS && 4 * group < most; group++)
        for (unsigned i = 0; i < p->size; i += MANY) {
            many_bits a, b;
            many_from(event + 2 * i, 2, &a);
            many_from(shoot_draw(RANDOM_SHOOT, group), 0, &b);
            many_threefry(s->seed, s->number, &a, &b);
            memcpy(&p->cohorts[group][0][i], &a, sizeof a);
            memcpy(&p->cohorts[group][1][i], &b, sizeof b);
        }
}

static void fill_points(struct stems *s, int side, enum stem_stream stream)
{
    struct points *p = points_of(&s->side[side], stream);
    _Alignas(64) double gaps[POINTS];
    uint64_t event = stem_event(stream, side, p->drawn);
    draw_points(s, event, p, gaps);
    place_points(s, side, stream, gaps);
    p->drawn += p->count;
    if (stream == STREAM_STOOLS) {
        turn_points(s, side, p);
        draw_cohorts(s, side, p, event);
    }
}

/* ---- stools ---- */

/* Takes the next stool of a side from its stream, with its shoots yet to be made. */
static inline struct stool next_stool(struct stems *s, int side)
{
    struct points *p = &s->side[side].streams[STREAM_STOOLS];
    unsigned k = p->next++;
    const struct wood_stools *stools = s->wood->along[side][p->belt[k]].stools;
    unsigned more = p->mark[k] < stools->more, n = stools->n + more;
    const double *ring = stools->ring[more];
    s->drawn += n;
    s->effort += 1 + n;
    return (struct stool){.at = p->at[k],
                          .centre = p->offset[k] * (2 * stools->reach + stools->most + s->b),
                          .sine = p->sine[k] * stools->radius[more],
                          .cosine = p->cosine[k] * stools->radius[more],
                          .stools = stools,
                          .ring = ring,
                          .sines = ring + stools->ring_room,
                          .n = n,
                          .place = k,
                          .cohorts = p->cohorts,
                          .event = stem_event(STREAM_STOOLS, side, p->drawn - p->count + k)};
}

/* Where shoot i of a stool stands. */
static inline void place_shoot(const struct stool *t, unsigned i, double *along, double *y)
{
    double c = t->ring[i], s = t->sines[i];
    *along = t->at + (c * t->cosine - s * t->sine);
    *y = t->centre + (c * t->sine + s * t->cosine);
}

/* Whether make_stools() can make the next stool. */
static inline bool is_plain_stool(const struct stems *s, int side)
{
    const struct points *p = &s->side[side].streams[STREAM_STOOLS];
    const struct wood_stools *stools = s->wood->along[side][p->belt[p->next]].stools;
    unsigned most = stools->cohorts > 1 ? 4 * COHORT_GROUPS : SHOOTS_FEW;
    return !stools->spread && stools->n + 1 < most &&
           (side == 1 || p->at[p->next] >= s->start + s->wood->reach);
}

/* Shoots to be put in order: the last bits of `along` tell them apart. */
struct shoots {
    _Alignas(64) double along[SHOOTS_AT_ONCE + MANY];
    double y[SHOOTS_AT_ONCE + MANY];
    uint64_t kind[SHOOTS_AT_ONCE + MANY]; /* of the forest's */
    uint64_t stool[SHOOTS_AT_ONCE + MANY];
    bool met[SHOOTS_AT_ONCE];
    unsigned n;
};

/* The kind of a shoot by its 32 bits. */
static inline const struct wood_kind *cohort_at(const struct wood_stools *stools, uint64_t bits)
{
    double u = ((double)(uint32_t)bits + 0.5) * 0x1p-32;
    size_t found = 0;
    for (size_t k = 0; k + 1 < stools->cohorts; k++)
        found += u >= stools->kinds[k].share_to;
    return &stools->kinds[found];
}

/* The shoots of a stool of one kind that the rock can hit. */
static inline void add_alike(const struct stems *s, const struct stool *t, struct shoots *to)
{
    const struct wood_kind *kind = t->stools->kinds;
    double most = (s->b + kind->dbh) / 2;
    many_bits kinds = (many_bits){0} + (uint64_t)(kind - s->wood->kinds), events = (many_bits){0} + t->event, shoot;
    unsigned n = to->n;
    for (unsigned i = 0; i < t->n; i += MANY) {
        many_reals c, q;
        memcpy(&c, &t->ring[i], sizeof c);
        memcpy(&q, &t->sines[i], sizeof q);
        many_reals along = t->at + (c * t->cosine - q * t->sine), y = t->centre + (c * t->sine + q * t->cosine);
        many_reals off = (many_reals)((many_bits)y & INT64_MAX);
        many_from(i, 1, &shoot);
        many_bits can = (many_bits)(off <= most) & (many_bits)(shoot < t->n);
        memcpy(&to->kind[n], &kinds, sizeof kinds);
        memcpy(&to->stool[n], &events, sizeof events);
        n += many_keep(&can, &along, &y, &to->along[n], &to->y[n]);
    }
    to->n = n;
}

/* The same of several cohorts; it is as likely as not for each, so that no branch depends on it, nor on whether it has
 * one shoot more. */
static inline void add_cohorts(const struct stems *s, const struct stool *t, struct shoots *to)
{
    unsigned n = to->n, most_shoots = t->stools->n + 1;
    for (unsigned i = 0; i < most_shoots; i++) {
        place_shoot(t, i, &to->along[n], &to->y[n]);
        const struct wood_kind *kind = cohort_at(t->stools, t->cohorts[i / 4][i / 2 % 2][t->place] >> i % 2 * 32);
        to->kind[n] = (uint64_t)(kind - s->wood->kinds);
        to->stool[n] = t->event;
        n += (fabs(to->y[n]) <= (s->b + kind->dbh) / 2) & (i < t->n);
    }
    to->n = n;
}

/* The place of each among all. */
static inline void rank_shoots(struct shoots *t, uint64_t rank[SHOOTS_AT_ONCE])
{
    for (unsigned i = 0; i < t->n; i++) {
        uint64_t bits = (elementary_bits(t->along[i]) & ~(uint64_t)(SHOOTS_AT_ONCE - 1)) | i;
        t->along[i] = elementary_real(bits);
    }
    for (unsigned i = 0; i < t->n; i += MANY) {
        many_reals along;
        many_bits before = {0};
        memcpy(&along, &t->along[i], sizeof along);
        for (unsigned j = 0; j < t->n; j++)
            before -= (many_bits)(along > t->along[j]);
        memcpy(&rank[i], &before, sizeof before);
    }
}

/* Those that wait already are put in order once more. */
static inline void add_waiting(const struct stems *s, const struct stems_side *side, struct shoots *to)
{
    for (size_t i = side->first; i < side->end; i++) {
        const struct stem *stem = &side->waiting[i];
        to->along[to->n] = stem->along;
        to->y[to->n] = stem->y;
        to->kind[to->n] = (uint64_t)(stem->kind - s->wood->kinds);
        to->stool[to->n] = stem->stool;
        to->met[to->n++] = stem->met;
    }
}

static void make_stools(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    struct points *p = &side->streams[STREAM_STOOLS];
    struct shoots t; /* 2.5 kB: only what is used is set */
    t.n = 0;
    memset(t.met, 0, sizeof t.met);
    _Alignas(64) uint64_t rank[SHOOTS_AT_ONCE];
    add_waiting(s, side, &t);
    do {
        struct stool stool = next_stool(s, i_side);
        if (stool.stools->cohorts > 1)
            add_cohorts(s, &stool, &t);
        else
            add_alike(s, &stool, &t);
    } while (t.n < STOP_SHOOTS && p->next < p->count && is_plain_stool(s, i_side));
    rank_shoots(&t, rank);
    for (unsigned i = 0; i < t.n; i++) {
        const struct wood_kind *kind = &s->wood->kinds[t.kind[i]];
        side->waiting[rank[i]] = (struct stem){.along = t.along[i],
                                               .y = t.y[i],
                                               .dbh = kind->dbh,
                                               .height = kind->height,
                                               .energy = kind->energy,
                                               .kind = kind,
                                               .stool = t.stool[i],
                                               .shoot = true,
                                               .met = t.met[i]};
    }
    side->first = 0;
    side->end = t.n;
}

#endif
