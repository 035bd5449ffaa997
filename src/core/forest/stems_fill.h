/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draw the next places of streams of stools or trees, and the shoots of the next stools, many at once (see stems.h). Compiled
 * for each kind of registers. */
#ifndef CEDUO_STEMS_FILL_H
#define CEDUO_STEMS_FILL_H

#include "base/elementary.h"
#include "base/random.h"
#include "base/real.h"
#include "stems_state.h"

/* Small steps of work per unit of effort: moves in a queue, skipped belts. */
#define STEPS_PER_STEM 4

_Static_assert(POINTS % REAL_LANES == 0, "places are drawn in whole vectors");
_Static_assert(POINTS_CAPACITY >= POINTS + REAL_LANES - 1, "they are read in whole vectors from any place on");

/* Return the event number, never 0: stream, index in the stream, and side in the lowest bit. */
static inline uint64_t stem_event(enum stem_stream stream, int side, uint64_t n)
{
    return (uint64_t)stream << 41 | (n + 1) << 1 | (uint64_t)side;
}

/* Return the event number of place k of the drawn places. */
static inline uint64_t get_event(const struct points *p, enum stem_stream stream, int side, unsigned k)
{
    return stem_event(stream, side, p->drawn - p->count + k);
}

/* Return the kind of random numbers for shoot i of a stool, or for its i-th draw. */
static inline uint64_t shoot_draw(enum random_kind kind, unsigned i)
{
    return (uint64_t)kind | (uint64_t)i << 8;
}

/* Draw places: 40 bits for the gap before, 38 for the mark, 25 each for offset and turn. Gaps are in units of their mean. */
static inline void draw_points(const struct stems *s, uint64_t event, struct points *to, double gaps[POINTS])
{
    const uint64_t key = RANDOM_KEY(s->seed, s->number);
    ints first[POINTS / REAL_LANES], second[POINTS / REAL_LANES];
    for (unsigned i = 0; i < to->size / REAL_LANES; i++) { /* separate loop, so that the processor overlaps more iterations */
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
    struct belt_rates *r = &s->rates[side == 0 ? belt : s->forest->belts - 1 - belt];
    if (r->b != s->b) {
        const struct forest_belt *from = &s->forest->sides[side][belt];
        *r = (struct belt_rates){.b = s->b};
        for (size_t k = 0; k < from->strata_count; k++)
            r->rate[get_stream(&from->strata[k])] += from->strata[k].base_rate + from->strata[k].rate_per_b * s->b;
        for (int k = 0; k < STREAMS; k++)
            r->metres[k] = 1 / r->rate[k];
    }
    return r;
}

/* Set the places: gaps are exponential in the rate integrated along the strip, across belts. */
static inline void place_points(struct stems *s, int side, enum stem_stream stream, const double gaps[POINTS])
{
    struct points *p = get_points(&s->side[side], stream);
    double along = p->end;
    size_t j = p->end_belt, first = j;
    unsigned i = 0;
    double remaining = gaps[0];
    while (j < s->forest->belts) {
        const struct forest_belt *belt = &s->forest->sides[side][j];
        const struct belt_rates *r = rates_in(s, side, j);
        double rate = r->rate[stream], metres = r->metres[stream];
        along = along > belt->from ? along : belt->from;
        double available = along < belt->to ? (belt->to - along) * rate : 0;
        for (; remaining < available; available = (belt->to - along) * rate) {
            along += remaining * metres;
            along = along < belt->to ? along : belt->to; /* untaken: rounding */
            p->along[i] = along;
            p->belt[i] = j;
            if (++i == p->size)
                break;
            remaining = gaps[i];
        }
        if (i == p->size)
            break;
        remaining -= available;
        j++;
    }
    s->effort += (j - first) / STEPS_PER_STEM;
    p->next = 0;
    p->count = i;
    p->end = along;
    p->end_belt = j;
}

/* Place stools of one belt, from `first` to before `end`; some beyond `end` are overwritten, too. */
static inline void place_stools(const struct stems *s, const struct forest_stools *t, struct points *p, unsigned first,
                                unsigned end)
{
    double width = 2 * t->reach + t->dbh_max + s->b;
    for (unsigned i = first; i < end; i += REAL_LANES) {
        real sine, cosine;
        mask has_extra = less(load(&p->mark[i]), splat(t->extra_chance));
        real radius = blend(has_extra, splat(t->radius[1]), splat(t->radius[0]));
        real angle = load(&p->turn[i]) * blend(has_extra, splat(t->turn[1]), splat(t->turn[0]));
        lanes_sincos(&angle, &sine, &cosine);
        store(&p->centre[i], load(&p->offset[i]) * width);
        store(&p->sine[i], sine * radius);
        store(&p->cosine[i], cosine * radius);
        store_ints(&p->extra[i], blend_ints(has_extra, splat_ints(1), splat_ints(0)));
    }
}

/* Return the first place after place i in another belt. */
static inline unsigned find_belt_end(const struct points *p, unsigned i)
{
    unsigned end = p->count;
    if (p->belt[end - 1] != p->belt[i])
        for (end = i + 1; p->belt[end] == p->belt[i];)
            end++;
    return end;
}

/* Draw 32 bits per shoot of stools with cohorts; one draw serves four shoots. */
static inline void draw_cohorts(const struct stems *s, int side, struct points *p, uint64_t event)
{
    const uint64_t key = RANDOM_KEY(s->seed, s->number);
    unsigned limit = 0;
    for (unsigned i = 0; i < p->count; i++) {
        const struct forest_stools *stools = s->forest->sides[side][p->belt[i]].stools;
        if (stools->cohorts > 1 && stools->n + 1 > limit)
            limit = stools->n + 1;
    }
    for (unsigned group = 0; group < COHORT_GROUPS && 4 * group < limit; group++)
        for (unsigned i = 0; i < p->size; i += REAL_LANES) {
            ints x = count_from(event + 2 * i, 2), y = splat_ints(shoot_draw(RANDOM_SHOOT, group));
            RANDOM_BITS(x, y, s->seed, s->number, key);
            store_ints(&p->cohorts[group][0][i], x);
            store_ints(&p->cohorts[group][1][i], y);
        }
}

static void fill_points(struct stems *s, int side, enum stem_stream stream)
{
    struct points *p = get_points(&s->side[side], stream);
    _Alignas(64) double gaps[POINTS];
    uint64_t event = stem_event(stream, side, p->drawn);
    draw_points(s, event, p, gaps);
    place_points(s, side, stream, gaps);
    p->drawn += p->count;
    if (stream == STREAM_STOOLS) {
        for (unsigned i = 0, end; i < p->count; i = end) {
            end = find_belt_end(p, i);
            place_stools(s, s->forest->sides[side][p->belt[i]].stools, p, i, end);
        }
        draw_cohorts(s, side, p, event);
    }
}

/* ---- stools ---- */

/* Consume the next stool of a side. Its shoots are not made yet. */
static inline struct stool next_stool(struct stems *s, int side)
{
    struct points *p = &s->side[side].streams[STREAM_STOOLS];
    unsigned k = p->next++;
    const struct forest_stools *stools = s->forest->sides[side][p->belt[k]].stools;
    unsigned n = stools->n + (unsigned)p->extra[k];
    const double *ring = stools->ring[p->extra[k]];
    s->drawn += n;
    s->effort += 1 + n;
    return (struct stool){.along = p->along[k],
                          .centre = p->centre[k],
                          .sine = p->sine[k],
                          .cosine = p->cosine[k],
                          .stools = stools,
                          .ring = ring,
                          .sines = ring + stools->ring_capacity,
                          .n = n,
                          .event = get_event(p, STREAM_STOOLS, side, k)};
}

/* Set the place of shoot i of a stool. */
static inline void place_shoot(const struct stool *t, unsigned i, double *along, double *y)
{
    double c = t->ring[i], s = t->sines[i];
    *along = t->along + (c * t->cosine - s * t->sine);
    *y = t->centre + (c * t->sine + s * t->cosine);
}

/* True if make_stools() can make the next stool. */
static inline bool is_plain_stool(const struct stems *s, int side)
{
    const struct points *p = &s->side[side].streams[STREAM_STOOLS];
    const struct forest_stools *stools = s->forest->sides[side][p->belt[p->next]].stools;
    unsigned limit = stools->cohorts > 1 ? 4 * COHORT_GROUPS : PLAIN_SHOOTS_MAX;
    return !stools->dbh_varies && stools->n + 1 < limit && (side == 1 || p->along[p->next] >= s->start + s->forest->reach);
}

#define ROW_SHOOTS 6 /* from this number of shoots on a stool is made on its own; affects only speed */

/* Shoots to be sorted. */
struct shoots {
    _Alignas(64) double along[SHOOTS_MAX + REAL_LANES];
    double y[SHOOTS_MAX + REAL_LANES];
    uint64_t kind[SHOOTS_MAX + REAL_LANES]; /* index of the kind in the forest */
    uint64_t stool[SHOOTS_MAX + REAL_LANES];
    bool stool_hit[SHOOTS_MAX];
    unsigned n;
};

/* Append the lanes `hittable`, one shoot per lane. Requires capacity for a register. */
static inline void add_shoots(struct shoots *to, mask hittable, real along, real y, ints kind, ints stool)
{
    compress(hittable, as_ints(along), &to->along[to->n]);
    compress(hittable, as_ints(y), &to->y[to->n]);
    compress(hittable, kind, &to->kind[to->n]);
    compress(hittable, stool, &to->stool[to->n]);
    to->n += (unsigned)__builtin_popcount(lane_bits(hittable));
}

static inline uint64_t kind_number(const struct stems *s, const struct forest_kind *kind)
{
    return (uint64_t)(kind - s->forest->kinds);
}

/* Append the shoots of one stool that the rock can hit. For stools of one kind with many shoots. */
static inline void add_row(const struct stems *s, const struct stool *t, struct shoots *to)
{
    const struct forest_kind *kind = t->stools->kinds;
    double limit = (s->b + kind->dbh) / 2;
    for (unsigned i = 0; i < t->n; i += REAL_LANES) {
        real c = load(&t->ring[i]), q = load(&t->sines[i]);
        real along = t->along + (c * t->cosine - q * t->sine), y = t->centre + (c * t->sine + q * t->cosine);
        mask hittable = greater_equal(splat(limit), vabs(y)) & greater_ints(splat_ints(t->n), count_from(i, 1));
        add_shoots(to, hittable, along, y, splat_ints(kind_number(s, kind)), splat_ints(t->event));
    }
}

/* Choose the kinds of shoot i of the stools from place k on. */
static inline void choose_kinds(const struct points *p, const struct forest_stools *t, unsigned i, unsigned k, ints *kind,
                                real *dbh)
{
    ints bits = load_ints(&p->cohorts[i / 4][i / 2 % 2][k]);
    real u = (to_real_small(bits >> i % 2 * 32 & UINT32_MAX) + 0.5) * 0x1p-32;
    for (size_t j = 0; j + 1 < t->cohorts; j++) {
        mask beyond = greater_equal(u, splat(t->kinds[j].share_to));
        *kind = blend_ints(beyond, *kind + 1, *kind);
        *dbh = blend(beyond, splat(t->kinds[j + 1].dbh), *dbh);
    }
}

/* Append the shoots of the stools from place k to before p->next, at most one register of them, all in one belt. */
static inline void add_columns(const struct stems *s, const struct points *p, unsigned k, const struct forest_stools *t,
                               uint64_t event, struct shoots *to)
{
    const double *ring = t->ring[0], *longer_ring = t->ring[t->extra_chance > 0];
    real place = load(&p->along[k]), centre = load(&p->centre[k]), sine = load(&p->sine[k]), cosine = load(&p->cosine[k]);
    ints is_more = load_ints(&p->extra[k]), events = count_from(event, 2);
    mask has_extra = greater_ints(is_more, splat_ints(0)), exists = greater_ints(splat_ints(p->next), count_from(k, 1));
    ints n = blend_ints(exists, is_more + t->n, splat_ints(0));
    for (unsigned i = 0; i < t->n + (t->extra_chance > 0); i++) {
        real c = blend(has_extra, splat(longer_ring[i]), splat(ring[i]));
        real q = blend(has_extra, splat(longer_ring[t->ring_capacity + i]), splat(ring[t->ring_capacity + i]));
        real along = place + (c * cosine - q * sine), y = centre + (c * sine + q * cosine), dbh = splat(t->kinds->dbh);
        ints kind = splat_ints(kind_number(s, t->kinds));
        if (t->cohorts > 1)
            choose_kinds(p, t, i, k, &kind, &dbh);
        mask hittable = greater_equal((s->b + dbh) / 2, vabs(y)) & greater_ints(n, splat_ints(i));
        add_shoots(to, hittable, along, y, kind, events);
    }
}

#define STOOLS_MAX 8 /* stools made at once */

/* Append the shoots of the next stools, all in one belt, until there are enough shoots if the rock can hit half of them. */
static inline void make_columns(struct stems *s, int side, const struct forest_stools *t, struct shoots *to)
{
    struct points *p = &s->side[side].streams[STREAM_STOOLS];
    unsigned k = p->next, count = find_belt_end(p, k) - k, per_stool = t->n + (t->extra_chance > 0);
    unsigned wanted = 2 * (SHOOTS_ENOUGH - to->n) / per_stool + 1, capacity = (SHOOTS_MAX - to->n) / per_stool;
    count = count < STOOLS_MAX ? count : STOOLS_MAX;
    count = count < wanted ? count : wanted;
    count = count < capacity ? count : capacity;
    uint64_t drawn = 0;
    p->next = k + count;
    for (unsigned i = k; i < p->next; i++)
        drawn += t->n + p->extra[i];
    s->drawn += drawn;
    s->effort += drawn + count;
    for (; k < p->next; k += REAL_LANES)
        add_columns(s, p, k, t, get_event(p, STREAM_STOOLS, side, k), to);
}

/* Compute the rank of each shoot by distance. `equal`: break ties by the order of drawing of stools, then of shoots. Return the
 * sum. */
static inline uint64_t rank_shoots(const struct shoots *t, bool equal, uint64_t rank[SHOOTS_MAX])
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

/* Set the energies of shoots that depend on eccentricity, by ceduo_dorren_share() of many at once. */
NOINLINE void set_energies(const struct stems *s, struct shoots *t, const uint64_t *rank, struct stem *waiting)
{
    double dbh[SHOOTS_MAX + REAL_LANES], share[SHOOTS_MAX + REAL_LANES];
    store(&t->y[t->n], splat(0)); /* padding after the last shoot */
    for (unsigned i = 0; i < t->n + REAL_LANES; i++)
        dbh[i] = s->forest->kinds[i < t->n ? t->kind[i] : t->kind[0]].dbh;
    for (unsigned i = 0; i < t->n; i += REAL_LANES) {
        real power, exponent = DORREN_EXPONENT(2 * vabs(load(&t->y[i])) / (s->b + load(&dbh[i])));
        lanes_exp(&exponent, &power);
        real share_raw = DORREN_SHARE_OF(power);
        store(&share[i], 0.5 * (share_raw + vabs(share_raw)));
    }
    for (unsigned i = 0; i < t->n; i++) {
        const struct forest_kind *kind = &s->forest->kinds[t->kind[i]];
        waiting[rank[i]].energy = kind->by_eccentricity ? share[i] * kind->full_energy : kind->full_energy;
    }
}

static void make_stools(struct stems *s, int i_side)
{
    struct stems_side *side = &s->side[i_side];
    struct points *p = &side->streams[STREAM_STOOLS];
    struct shoots t; /* 2.5 kB: initialise only used members */
    t.n = 0;
    memset(t.stool_hit, 0, sizeof t.stool_hit);
    _Alignas(64) uint64_t rank[SHOOTS_MAX];
    for (size_t i = side->first; i < side->end; i++) { /* sort the queued shoots again */
        const struct stem *stem = &side->queue[i];
        t.along[t.n] = stem->along;
        t.y[t.n] = stem->y;
        t.kind[t.n] = kind_number(s, stem->kind);
        t.stool[t.n] = stem->stool;
        t.stool_hit[t.n++] = stem->stool_hit;
    }
    do {
        const struct forest_stools *stools = s->forest->sides[i_side][p->belt[p->next]].stools;
        if (stools->cohorts > 1 || stools->n < ROW_SHOOTS) {
            make_columns(s, i_side, stools, &t);
        } else {
            struct stool stool = next_stool(s, i_side);
            add_row(s, &stool, &t);
        }
    } while (t.n < SHOOTS_ENOUGH && p->next < p->count && is_plain_stool(s, i_side));
    store(&t.along[t.n], splat(-INFINITY)); /* padding of rank 0 */
    if (rank_shoots(&t, false, rank) != (uint64_t)t.n * (t.n - 1) / 2)
        rank_shoots(&t, true, rank);
    for (unsigned i = 0; i < t.n; i++) {
        const struct forest_kind *kind = &s->forest->kinds[t.kind[i]];
        side->queue[rank[i]] = (struct stem){.along = t.along[i],
                                             .energy = kind->full_energy,
                                             .height = get_hit_height(s, kind),
                                             .y = t.y[i],
                                             .dbh = kind->dbh,
                                             .kind = kind,
                                             .stool = t.stool[i],
                                             .shoot = true,
                                             .stool_hit = t.stool_hit[i]};
    }
    if (s->forest->by_eccentricity && t.n > 0)
        set_energies(s, &t, rank, side->queue);
    side->first = 0;
    side->end = t.n;
}

#endif
