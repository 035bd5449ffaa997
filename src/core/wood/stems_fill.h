/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The next places of streams of stools or trees, and the shoots of the next stools, many at once: see stems.h. This is
 * compiled for each kind of registers. */
#ifndef CEDUO_STEMS_FILL_H
#define CEDUO_STEMS_FILL_H

#include "base/elementary.h"
#include "base/random.h"
#include "base/real.h"
#include "stems_state.h"

/* What costs little is counted as a part of a stem: steps over others in a list, belts that are passed over. */
#define STEPS_OF_A_STEM 4

_Static_assert(POINTS % REAL_LANES == 0, "places are drawn in whole vectors");
_Static_assert(POINTS_ROOM >= POINTS + REAL_LANES - 1, "they are read in whole vectors from any place on");

/* The number of an event, never 0: which stream, which side, the how-manieth. The side is its last bit. */
static inline uint64_t stem_event(enum stem_stream stream, int side, uint64_t n)
{
    return (uint64_t)stream << 41 | (n + 1) << 1 | (uint64_t)side;
}

/* That of place k of those at hand. */
static inline uint64_t event_of(const struct points *p, enum stem_stream stream, int side, unsigned k)
{
    return stem_event(stream, side, p->drawn - p->count + k);
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
    const uint64_t key = RANDOM_KEY(s->seed, s->number);
    ints first[POINTS / REAL_LANES], second[POINTS / REAL_LANES];
    for (unsigned i = 0; i < to->size / REAL_LANES; i++) { /* by itself: the processor has more of them under way at once */
        ints x = count_from(event + 2 * i * REAL_LANES, 2), y = splat_ints(RANDOM_STEM);
        RANDOM_BITS(x, y, s->seed, s->number, key);
        first[i] = x;
        second[i] = y;
    }
    for (unsigned i = 0; i < to->size; i += REAL_LANES) {
        ints p = first[i / REAL_LANES], q = second[i / REAL_LANES];
        real u = to_real_small(p >> 24) * 0x1p-40 + 0x1p-41, log;
        lanes_log(&u, &log);
        store(&gaps[i], -log);
        store(&to->mark[i], to_real_small((p & 0xffffff) << 14 | q >> 50) * 0x1p-38 + 0x1p-39);
        store(&to->offset[i], to_real_small(q & 0x1ffffff) * 0x1p-25 + (0x1p-26 - 0.5));
        store(&to->turn[i], to_real_small(q >> 25 & 0x1ffffff) * 0x1p-25 + (0x1p-26 - 0.5));
    }
}

static inline const struct belt_rates *rates_in(struct stems *s, int side, size_t belt)
{
    struct belt_rates *r = &s->rates[side == 0 ? belt : s->wood->belts - 1 - belt];
    if (r->b != s->b) {
        const struct wood_belt *from = &s->wood->along[side][belt];
        *r = (struct belt_rates){.b = s->b};
        for (size_t k = 0; k < from->strata_count; k++)
            r->rate[stream_of(&from->strata[k])] += from->strata[k].still + from->strata[k].per_b * s->b;
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
    while (j < s->wood->belts) {
        const struct wood_belt *belt = &s->wood->along[side][j];
        const struct belt_rates *r = rates_in(s, side, j);
        double rate = r->rate[stream], metres = r->metres[stream];
        at = at > belt->from ? at : belt->from;
        double room = at < belt->to ? (belt->to - at) * rate : 0;
        for (; left < room; room = (belt->to - at) * rate) {
            at += left * metres;
            at = at < belt->to ? at : belt->to; /* untaken: rounding */
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

/* Stools of one belt, from the first up to `end`; some behind it are gone over, too. */
static inline void place_stools(const struct stems *s, const struct wood_stools *t, struct points *p, unsigned first,
                                unsigned end)
{
    double width = 2 * t->reach + t->most + s->b;
    for (unsigned i = first; i < end; i += REAL_LANES) {
        real sine, cosine;
        mask more = less(load(&p->mark[i]), splat(t->more));
        real radius = blend(more, splat(t->radius[1]), splat(t->radius[0]));
        real angle = load(&p->turn[i]) * blend(more, splat(t->turn[1]), splat(t->turn[0]));
        lanes_sincos(&angle, &sine, &cosine);
        store(&p->centre[i], load(&p->offset[i]) * width);
        store(&p->sine[i], sine * radius);
        store(&p->cosine[i], cosine * radius);
        store_ints(&p->more[i], blend_ints(more, splat_ints(1), splat_ints(0)));
    }
}

/* The first place behind place i that lies in another belt. */
static inline unsigned end_of_belt(const struct points *p, unsigned i)
{
    unsigned end = p->count;
    if (p->belt[end - 1] != p->belt[i])
        for (end = i + 1; p->belt[end] == p->belt[i];)
            end++;
    return end;
}

/* 32 bits for each shoot of those stools that have cohorts: four from one draw. */
static inline void draw_cohorts(const struct stems *s, int side, struct points *p, uint64_t event)
{
    const uint64_t key = RANDOM_KEY(s->seed, s->number);
    unsigned most = 0;
    for (unsigned i = 0; i < p->count; i++) {
        const struct wood_stools *stools = s->wood->along[side][p->belt[i]].stools;
        if (stools->cohorts > 1 && stools->n + 1 > most)
            most = stools->n + 1;
    }
    for (unsigned group = 0; group < COHORT_GROUPS && 4 * group < most; group++)
        for (unsigned i = 0; i < p->size; i += REAL_LANES) {
            ints x = count_from(event + 2 * i, 2), y = splat_ints(shoot_draw(RANDOM_SHOOT, group));
            RANDOM_BITS(x, y, s->seed, s->number, key);
            store_ints(&p->cohorts[group][0][i], x);
            store_ints(&p->cohorts[group][1][i], y);
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
        for (unsigned i = 0, end; i < p->count; i = end) {
            end = end_of_belt(p, i);
            place_stools(s, s->wood->along[side][p->belt[i]].stools, p, i, end);
        }
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
    unsigned n = stools->n + (unsigned)p->more[k];
    const double *ring = stools->ring[p->more[k]];
    s->drawn += n;
    s->effort += 1 + n;
    return (struct stool){.at = p->at[k],
                          .centre = p->centre[k],
                          .sine = p->sine[k],
                          .cosine = p->cosine[k],
                          .stools = stools,
                          .ring = ring,
                          .sines = ring + stools->ring_room,
                          .n = n,
                          .event = event_of(p, STREAM_STOOLS, side, k)};
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
    return !stools->spread && stools->n + 1 < most && (side == 1 || p->at[p->next] >= s->start + s->wood->reach);
}

#define ROW_SHOOTS 6 /* of so many a stool is made by itself; only speed depends on it */

/* Shoots to be put in order. */
struct shoots {
    _Alignas(64) double along[SHOOTS_AT_ONCE + REAL_LANES];
    double y[SHOOTS_AT_ONCE + REAL_LANES];
    uint64_t kind[SHOOTS_AT_ONCE + REAL_LANES]; /* of the forest's */
    uint64_t stool[SHOOTS_AT_ONCE + REAL_LANES];
    bool met[SHOOTS_AT_ONCE];
    unsigned n;
};

/* Adds those shoots that `can` be hit, of one kind and stool in each lane; there is room for a register. */
static inline void add_shoots(struct shoots *to, mask can, real along, real y, ints kind, ints stool)
{
    compress(can, as_ints(along), &to->along[to->n]);
    compress(can, as_ints(y), &to->y[to->n]);
    compress(can, kind, &to->kind[to->n]);
    compress(can, stool, &to->stool[to->n]);
    to->n += (unsigned)__builtin_popcount(lane_bits(can));
}

static inline uint64_t kind_number(const struct stems *s, const struct wood_kind *kind)
{
    return (uint64_t)(kind - s->wood->kinds);
}

/* The shoots of a stool of one kind that the rock can hit: for stools of many. */
static inline void add_row(const struct stems *s, const struct stool *t, struct shoots *to)
{
    const struct wood_kind *kind = t->stools->kinds;
    double most = (s->b + kind->dbh) / 2;
    for (unsigned i = 0; i < t->n; i += REAL_LANES) {
        real c = load(&t->ring[i]), q = load(&t->sines[i]);
        real along = t->at + (c * t->cosine - q * t->sine), y = t->centre + (c * t->sine + q * t->cosine);
        mask can = at_least(splat(most), vabs(y)) & greater_ints(splat_ints(t->n), count_from(i, 1));
        add_shoots(to, can, along, y, splat_ints(kind_number(s, kind)), splat_ints(t->event));
    }
}

/* The kinds of shoot i of stools from place k on. */
static inline void choose_kinds(const struct points *p, const struct wood_stools *t, unsigned i, unsigned k, ints *kind,
                                real *dbh)
{
    ints bits = load_ints(&p->cohorts[i / 4][i / 2 % 2][k]);
    real u = (to_real_small(bits >> i % 2 * 32 & UINT32_MAX) + 0.5) * 0x1p-32;
    for (size_t j = 0; j + 1 < t->cohorts; j++) {
        mask beyond = at_least(u, splat(t->kinds[j].share_to));
        *kind = blend_ints(beyond, *kind + 1, *kind);
        *dbh = blend(beyond, splat(t->kinds[j + 1].dbh), *dbh);
    }
}

/* The shoots of the stools from place k on to before the next, as many as a register holds at the most and all of one belt, by
 * their number on the ring. */
static inline void add_columns(const struct stems *s, const struct points *p, unsigned k, const struct wood_stools *t,
                               uint64_t event, struct shoots *to)
{
    const double *ring = t->ring[0], *other = t->ring[t->more > 0];
    real at = load(&p->at[k]), centre = load(&p->centre[k]), sine = load(&p->sine[k]), cosine = load(&p->cosine[k]);
    ints is_more = load_ints(&p->more[k]), events = count_from(event, 2);
    mask longer = greater_ints(is_more, splat_ints(0)), there = greater_ints(splat_ints(p->next), count_from(k, 1));
    ints n = blend_ints(there, is_more + t->n, splat_ints(0));
    for (unsigned i = 0; i < t->n + (t->more > 0); i++) {
        real c = blend(longer, splat(other[i]), splat(ring[i]));
        real q = blend(longer, splat(other[t->ring_room + i]), splat(ring[t->ring_room + i]));
        real along = at + (c * cosine - q * sine), y = centre + (c * sine + q * cosine), dbh = splat(t->kinds->dbh);
        ints kind = splat_ints(kind_number(s, t->kinds));
        if (t->cohorts > 1)
            choose_kinds(p, t, i, k, &kind, &dbh);
        mask can = at_least((s->b + dbh) / 2, vabs(y)) & greater_ints(n, splat_ints(i));
        add_shoots(to, can, along, y, kind, events);
    }
}

#define STOOLS_AT_ONCE 8 /* at the most */

/* The shoots of the next stools, all of one belt: about so many that there are enough shoots, if the rock can hit half of them. */
static inline void make_columns(struct stems *s, int side, const struct wood_stools *t, struct shoots *to)
{
    struct points *p = &s->side[side].streams[STREAM_STOOLS];
    unsigned k = p->next, count = end_of_belt(p, k) - k, each = t->n + (t->more > 0);
    unsigned wanted = 2 * (STOP_SHOOTS - to->n) / each + 1, room = (SHOOTS_AT_ONCE - to->n) / each;
    count = count < STOOLS_AT_ONCE ? count : STOOLS_AT_ONCE;
    count = count < wanted ? count : wanted;
    count = count < room ? count : room;
    uint64_t drawn = 0;
    p->next = k + count;
    for (unsigned i = k; i < p->next; i++)
        drawn += t->n + p->more[i];
    s->drawn += drawn;
    s->effort += drawn + count;
    for (; k < p->next; k += REAL_LANES)
        add_columns(s, p, k, t, event_of(p, STREAM_STOOLS, side, k), to);
}

/* The place of each among all; `equal`: some may stand at one place, and of those the stool that was drawn first comes first,
 * and its first shoot. Returns the sum of the places. */
static inline uint64_t rank_among(const struct shoots *t, bool equal, uint64_t rank[SHOOTS_AT_ONCE])
{
    ints sums = splat_ints(0);
    for (unsigned i = 0; i < t->n; i += REAL_LANES) {
        real along = load(&t->along[i]);
        ints before = splat_ints(0), stool = load_ints(&t->stool[i]), own = count_from(i, 1); /* true is -1 */
        for (unsigned j = 0; j < t->n; j++) {
            before -= (ints)(along > t->along[j]);
            if (equal)
                before -= (ints)(along == t->along[j]) &
                          ((ints)(stool > t->stool[j]) | ((ints)(stool == t->stool[j]) & (ints)(own > j)));
        }
        store_ints(&rank[i], before);
        sums += before;
    }
    uint64_t sum = 0;
    EACH_LANE(i)
        sum += sums[i];
    return sum;
}

/* What those shoots take of which it depends on the eccentricity, with ceduo_dorren_share() of many at once. */
NOINLINE void set_energies(const struct stems *s, struct shoots *t, const uint64_t *rank, struct stem *waiting)
{
    double dbh[SHOOTS_AT_ONCE + REAL_LANES], share[SHOOTS_AT_ONCE + REAL_LANES];
    store(&t->y[t->n], splat(0)); /* those behind the last are of no stem */
    for (unsigned i = 0; i < t->n + REAL_LANES; i++)
        dbh[i] = s->wood->kinds[i < t->n ? t->kind[i] : t->kind[0]].dbh;
    for (unsigned i = 0; i < t->n; i += REAL_LANES) {
        real power, exponent = DORREN_EXPONENT(2 * vabs(load(&t->y[i])) / (s->b + load(&dbh[i])));
        lanes_exp(&exponent, &power);
        real of = DORREN_SHARE_OF(power);
        store(&share[i], 0.5 * (of + vabs(of)));
    }
    for (unsigned i = 0; i < t->n; i++) {
        const struct wood_kind *kind = &s->wood->kinds[t->kind[i]];
        waiting[rank[i]].energy = kind->by_eccentricity ? share[i] * kind->whole : kind->whole;
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
    for (size_t i = side->first; i < side->end; i++) { /* those that wait already are put in order once more */
        const struct stem *stem = &side->waiting[i];
        t.along[t.n] = stem->along;
        t.y[t.n] = stem->y;
        t.kind[t.n] = kind_number(s, stem->kind);
        t.stool[t.n] = stem->stool;
        t.met[t.n++] = stem->met;
    }
    do {
        const struct wood_stools *stools = s->wood->along[i_side][p->belt[p->next]].stools;
        if (stools->cohorts > 1 || stools->n < ROW_SHOOTS) {
            make_columns(s, i_side, stools, &t);
        } else {
            struct stool stool = next_stool(s, i_side);
            add_row(s, &stool, &t);
        }
    } while (t.n < STOP_SHOOTS && p->next < p->count && is_plain_stool(s, i_side));
    store(&t.along[t.n], splat(-INFINITY)); /* of place 0 */
    if (rank_among(&t, false, rank) != (uint64_t)t.n * (t.n - 1) / 2)
        rank_among(&t, true, rank);
    for (unsigned i = 0; i < t.n; i++) {
        const struct wood_kind *kind = &s->wood->kinds[t.kind[i]];
        side->waiting[rank[i]] = (struct stem){.along = t.along[i],
                                               .energy = kind->whole,
                                               .height = height_hit(s, kind),
                                               .y = t.y[i],
                                               .dbh = kind->dbh,
                                               .kind = kind,
                                               .stool = t.stool[i],
                                               .shoot = true,
                                               .met = t.met[i]};
    }
    if (s->wood->by_eccentricity && t.n > 0)
        set_energies(s, &t, rank, side->waiting);
    side->first = 0;
    side->end = t.n;
}

#endif
