/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The next places of a stream of stools or trees, many at once: see stems.h. This is compiled for each kind of registers. */
#ifndef CEDUO_STEMS_FILL_H
#define CEDUO_STEMS_FILL_H

#include "many.h"
#include "random.h"
#include "stems.h"

/* What costs little is counted as a part of a stem: steps over others in a list, belts that are passed over. */
#define STEPS_OF_A_STEM 4

_Static_assert(POINTS % MANY == 0, "places are drawn in whole vectors");

/* The number of an event, never 0: which stream, which side, the how-manieth. The side is its last bit. */
static inline uint64_t stem_event(enum stem_stream stream, int side, uint64_t n)
{
    return (uint64_t)stream << 41 | (n + 1) << 1 | (uint64_t)side;
}

/* What is drawn of each place: of the gap before it 40 bits, of the mark 38, of offset and turn 25 each. Gaps are in units
 * of their mean. */
static inline void draw_points(const struct stems *s, uint64_t event, struct points *to, double gaps[POINTS])
{
    for (unsigned i = 0; i < to->size; i += MANY) {
        many_bits p, q, low;
        many_reals u, log;
        many_from(event + 2 * i, 2, &p);
        q = p - p + RANDOM_STEM;
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
            r->rate[from->strata[k].kind ? STREAM_SINGLE : STREAM_STOOLS] +=
                from->strata[k].still + from->strata[k].per_b * s->b;
        for (int k = 0; k < STREAMS; k++)
            r->metres[k] = 1 / r->rate[k];
    }
    return r;
}

/* Where the places stand: gaps are exponential in the rate summed along the strip, across belts. */
static inline void place_points(struct stems *s, int side, enum stem_stream stream, const double gaps[POINTS])
{
    struct points *p = &s->side[side].streams[stream];
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

static inline void fill_points(struct stems *s, int side, enum stem_stream stream)
{
    struct points *p = &s->side[side].streams[stream];
    _Alignas(64) double gaps[POINTS];
    draw_points(s, stem_event(stream, side, p->drawn), p, gaps);
    place_points(s, side, stream, gaps);
    p->drawn += p->count;
    if (stream == STREAM_STOOLS)
        turn_points(s, side, p);
}

#endif
