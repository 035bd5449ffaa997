/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An option's forest, prepared for drawing stems. Every belt becomes strata, each with a rate of encounters per metre:
 * stools, classes of trees, stumps and logs. The forest owns all kinds, strata and rings; belts only point to them. The key of a forest is hashed from the same kinds and strata. */
#include "wood.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "ceduo/trajectory.h"
#include "core/stand/strata.h"

/* ---- kinds ---- */

/* A diameter that a gamma law of this shape and scale goes beyond with a chance of less than exp(-37) = 1e-16, which no
 * number of 53 bits can tell from never: P(X > shape scale (1 + t)) <= exp(-shape (t - log(1 + t))) (Chernoff 1952). */
static double thickest(double shape, double scale)
{
    double lo = 0, hi = 1;
    while (shape * (hi - ceduo_log1p(hi)) < 37)
        hi *= 2;
    for (int i = 0; i < 60; i++) {
        double mid = lo + (hi - lo) / 2;
        if (shape * (mid - ceduo_log1p(mid)) < 37)
            lo = mid;
        else
            hi = mid;
    }
    return shape * scale * (1 + hi);
}

/* A smaller spread changes no digit of a diameter; its gamma law would be beyond what doubles can hold. */
#define LEAST_SPREAD 1e-9 /* of the diameter */

static struct wood_kind kind_of(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    struct wood_kind k = {.dbh = stems->dbh,
                          .most = stems->dbh,
                          .height = stems->height,
                          .below = stand->hit_below > 0 ? stand->hit_below : INFINITY,
                          .energy = NAN,
                          .by_hit = ceduo_stem_energy(stand, stems)};
    if (stems->dbh_sd > LEAST_SPREAD * stems->dbh) {
        double ratio = stems->dbh / stems->dbh_sd;
        k.shape = ratio * ratio;
        k.scale = stems->dbh_sd / ratio;
        k.most = thickest(k.shape, k.scale);
    } else if (!ceduo_stem_energy_by_eccentricity(&k.by_hit)) {
        k.energy = ceduo_stem_energy_mean(&k.by_hit);
    }
    return k;
}

static struct wood_stratum plain_stratum(double per_ha, double width, const struct wood_kind *kind)
{
    double per_m2 = per_ha / HECTARE;
    return (struct wood_stratum){per_m2 * width, per_m2, kind, 0, 0};
}

/* Kinds that are met. */
static size_t count_kinds(const struct ceduo_stand *stand)
{
    return stand->shoots_count + stand->trees_count + (stand->stumps.per_ha > 0) + (stand->logs.per_ha > 0);
}

/* Kind i of those, with its stratum. */
static struct wood_stratum stratum_of(const struct ceduo_stand *stand, size_t i, struct wood_kind *kind)
{
    size_t shoots = stand->shoots_count, low = shoots + stand->trees_count;
    if (i < shoots) { /* a cohort has no stratum of its own: all stools are one */
        double upto = 0;
        *kind = kind_of(stand, &stand->shoots[i]);
        for (size_t k = 0; k <= i; k++)
            upto += stand->shoots[k].per_ha;
        kind->share_to = i + 1 < shoots ? upto / ceduo_stand_shoots(stand) : 1;
        return (struct wood_stratum){.kind = kind};
    }
    if (i < low) {
        const struct ceduo_stems *trees = &stand->trees[i - shoots];
        *kind = kind_of(stand, trees);
        if (!ceduo_stems_are_grouped(trees))
            return plain_stratum(trees->per_ha, kind->dbh, kind);
        /* of groups their centres, as far off as any of their trees can be met */
        double per_m2 = trees->per_ha / HECTARE / trees->group, width = 2 * trees->group_radius + kind->most;
        return (struct wood_stratum){per_m2 * width, per_m2, kind, trees->group, trees->group_radius};
    }
    /* what lies low takes what is said of it, whatever the law of the stems */
    const struct ceduo_stumps *t = &stand->stumps;
    const struct ceduo_logs *l = &stand->logs;
    if (i == low && t->per_ha > 0) {
        *kind = (struct wood_kind){
            .dbh = t->diameter, .most = t->diameter, .height = t->height, .below = INFINITY, .energy = t->energy};
        return plain_stratum(t->per_ha, t->diameter, kind);
    }
    /* a log lies across the way: it has no diameter that it could be grazed beside */
    *kind = (struct wood_kind){.dbh = NAN, .height = l->diameter, .below = INFINITY, .energy = l->energy};
    return plain_stratum(l->per_ha, ceduo_log_width(l->length), kind);
}

/* ---- stools ---- */

static bool make_stools(struct wood *w, size_t belt, const struct ceduo_stand *stand, const struct wood_kind *kinds)
{
    struct wood_stools *s = &w->stools[belt];
    double per_stool = ceduo_stand_shoots(stand) / stand->stools_per_ha;
    s->n = (unsigned)floor(per_stool);
    s->more = per_stool - floor(per_stool);
    s->cohorts = stand->shoots_count;
    s->kinds = kinds;
    s->ring_room = ((size_t)s->n / WOOD_RING_STEP + 1) * WOOD_RING_STEP;
    for (unsigned i = 0; i < (s->more > 0 ? 2 : 1); i++) {
        double *ring = w->rings[2 * belt + i] = calloc(2 * s->ring_room, sizeof *ring);
        if (!ring)
            return false;
        for (unsigned k = 0; k < s->n + i; k++)
            ceduo_sincos_turn(k, s->n + i, &ring[k], &ring[s->ring_room + k]);
        s->ring[i] = ring;
        s->radius[i] = ceduo_stool_radius(s->n + i, stand->spacing);
        s->turn[i] = s->n + i > 1 ? 2 * M_PI / (s->n + i) : 0;
    }
    s->reach = fmax(s->radius[0], s->radius[1]);
    for (size_t i = 0; i < s->cohorts; i++) {
        s->most = fmax(s->most, kinds[i].most);
        s->spread |= kinds[i].shape > 0;
        w->tallest = fmax(w->tallest, kinds[i].height);
    }
    w->reach = fmax(w->reach, s->reach);
    return true;
}

/* ---- belts ---- */

/* The strata of a belt: the first is that of the stools. */
static bool make_belt(struct wood *w, size_t belt, const struct ceduo_stand *stand, struct wood_kind *kinds,
                      struct wood_stratum *strata)
{
    struct wood_belt *to = &w->along[0][belt];
    size_t n = 1;
    for (size_t i = 0; i < count_kinds(stand); i++) {
        strata[n] = stratum_of(stand, i, &kinds[i]);
        w->group_reach = fmax(w->group_reach, strata[n].radius);
        if (strata[n].group > 0) {
            w->grouped = true;
            w->tallest = fmax(w->tallest, kinds[i].height);
        }
        n += i >= stand->shoots_count;
    }
    to->strata_count = n;
    if (!ceduo_stand_has_shoots(stand))
        return true;
    if (!make_stools(w, belt, stand, kinds))
        return false;
    const struct wood_stools *s = to->stools = &w->stools[belt];
    double per_m2 = stand->stools_per_ha / HECTARE;
    strata[0] = (struct wood_stratum){per_m2 * (2 * s->reach + s->most), per_m2, NULL, 0, 0};
    return true;
}

static bool allocate(struct wood *w, const struct ceduo_option *option)
{
    size_t kinds = 0;
    for (size_t i = 0; i < option->belts_count; i++)
        kinds += option->belts[i].stand.shoots_count + option->belts[i].stand.trees_count + 3; /* stumps, logs, and stools */
    w->kinds = calloc(kinds + 1, sizeof *w->kinds);
    w->strata_room = calloc(kinds + 1, sizeof *w->strata_room);
    w->stools = calloc(option->belts_count + 1, sizeof *w->stools);
    w->rings = calloc(2 * option->belts_count + 1, sizeof *w->rings);
    w->along[0] = calloc(option->belts_count + 1, sizeof *w->along[0]);
    w->along[1] = calloc(option->belts_count + 1, sizeof *w->along[1]);
    w->belts = option->belts_count;
    return w->kinds && w->strata_room && w->stools && w->rings && w->along[0] && w->along[1];
}

#define PLACES_MAX ((size_t)1 << 20)
_Static_assert(PLACES_MAX > CEDUO_STEMS_MAX, "a rock that is among more stools is not followed further");

/* Stools whose shoots a rock can be among: those with a centre within the reach of the largest ring, of either side; by
 * far the most that chance will bring. */
static size_t places_for(const struct wood *w, double b)
{
    double most = 0;
    for (size_t i = 0; i < w->belts; i++)
        if (w->along[0][i].strata_count > 0)
            most = fmax(most, w->along[0][i].strata[0].still + w->along[0][i].strata[0].per_b * b);
    double wanted = 64 + 16 * most * 2 * w->reach;
    size_t places = 64;
    while ((double)places < wanted && places < PLACES_MAX)
        places *= 2;
    return places - 1;
}

bool ceduo_wood_init(struct wood *wood, const struct ceduo_simulation *simulation, const struct ceduo_option *option,
                     const struct ceduo_rock *mean)
{
    *wood = (struct wood){.bare = true};
    if (!option || simulation->contact_model == CEDUO_INDEX)
        return true;
    if (!allocate(wood, option))
        goto fail;
    size_t used = 0;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        struct wood_belt *to = &wood->along[0][i];
        *to = (struct wood_belt){.from = belt->from, .to = belt->to, .strata = &wood->strata_room[used]};
        if (ceduo_stand_is_bare(&belt->stand))
            continue;
        wood->bare = false;
        if (!make_belt(wood, i, &belt->stand, &wood->kinds[used], &wood->strata_room[used]))
            goto fail;
        used += count_kinds(&belt->stand) + 1;
    }
    for (size_t i = 0; i < wood->belts; i++) {
        const struct wood_belt *ahead = &wood->along[0][wood->belts - 1 - i];
        wood->along[1][i] = *ahead;
        wood->along[1][i].from = -ahead->to;
        wood->along[1][i].to = -ahead->from;
    }
    wood->places = places_for(wood, mean->mean_diameter);
    for (struct wood_kind *k = wood->kinds; k < wood->kinds + used; k++) {
        bool depends = isnan(k->energy);
        k->whole = depends ? ceduo_stem_energy_hit(&k->by_hit, k->dbh, 1) : k->energy;
        k->by_eccentricity = depends && ceduo_stem_energy_by_eccentricity(&k->by_hit);
        wood->by_eccentricity |= k->by_eccentricity;
    }
    return true;
fail:
    ceduo_wood_release(wood);
    return false;
}

void ceduo_wood_release(struct wood *wood)
{
    for (size_t i = 0; wood->rings && i < 2 * wood->belts; i++)
        free(wood->rings[i]);
    free(wood->rings);
    free(wood->stools);
    free(wood->strata_room);
    free(wood->kinds);
    free(wood->along[0]);
    free(wood->along[1]);
    *wood = (struct wood){.bare = true};
}

/* ---- hashing ---- */

/* Made of the same kinds and strata as the prepared forest, but without its memory: it cannot fail. */

bool ceduo_wood_hash(uint64_t *hash, const struct ceduo_simulation *simulation, const struct ceduo_option *option)
{
    bool bare = true;
    if (!option || simulation->contact_model == CEDUO_INDEX)
        return false;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        if (ceduo_stand_is_bare(&belt->stand))
            continue;
        bare = false;
        hash_double(hash, belt->from);
        hash_double(hash, belt->to);
        const struct ceduo_stand *stand = &belt->stand;
        size_t kinds = count_kinds(stand);
        hash_count(hash, kinds);
        if (ceduo_stand_has_shoots(stand)) {
            hash_count(hash, stand->shoots_count);
            hash_double(hash, stand->stools_per_ha);
            hash_double(hash, ceduo_stand_shoots(stand));
            hash_double(hash, stand->spacing);
        }
        for (size_t k = 0; k < kinds; k++) {
            struct wood_kind kind;
            const struct wood_stratum stratum = stratum_of(stand, k, &kind);
            hash_each(hash, stratum.still, stratum.per_b);
            _Static_assert(offsetof(struct wood_stratum, kind) == 2 * sizeof(double), "all numbers before it are hashed");
            hash_each(hash, kind.dbh, kind.height, kind.below, kind.energy, kind.shape, kind.scale, kind.share_to);
            _Static_assert(offsetof(struct wood_kind, most) == 7 * sizeof(double), "all numbers before it are hashed");
            if (isnan(kind.energy))
                ceduo_stem_energy_hash(hash, &kind.by_hit);
            hash_count(hash, stratum.group);
            hash_double(hash, stratum.radius);
        }
    }
    return !bare;
}
