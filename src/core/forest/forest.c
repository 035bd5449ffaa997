/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preparation of an option's forest for drawing stems. Each belt has strata with a rate of encounters per metre: stools,
 * classes of trees, stumps and logs. The forest owns all kinds, strata and rings; belts only point to them. The key of a forest
 * is hashed from the same kinds and strata. */
#include "forest.h"
#include "core/stand/adc.h"
#include "scene/stand.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "core/stand/strata.h"

/* ---- kinds ---- */

/* Return an upper bound of the diameter, exceeded with probability below exp(-37) = 1e-16, which draws of 53 bits cannot
 * resolve. P(X > shape scale (1 + t)) <= exp(-shape (t - log(1 + t))) (Chernoff 1952). */
static double find_dbh_max(double shape, double scale)
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

/* A smaller spread does not change a double; the shape of its gamma distribution would overflow. */
#define SPREAD_MIN 1e-9 /* of the diameter */

static struct forest_kind make_kind(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    struct forest_kind k = {.dbh = stems->dbh,
                            .dbh_max = stems->dbh,
                            .height = stems->height,
                            .hit_below = stand->hit_below > 0 ? stand->hit_below : INFINITY,
                            .energy = NAN,
                            .hit_energy = ceduo_stem_energy(stand, stems)};
    if (stems->dbh_sd > SPREAD_MIN * stems->dbh) {
        double ratio = stems->dbh / stems->dbh_sd;
        k.shape = ratio * ratio;
        k.scale = stems->dbh_sd / ratio;
        k.dbh_max = find_dbh_max(k.shape, k.scale);
    } else if (!ceduo_stem_energy_by_eccentricity(&k.hit_energy)) {
        k.energy = ceduo_stem_energy_mean(&k.hit_energy);
    }
    return k;
}

static struct forest_stratum plain_stratum(double per_ha, double width, const struct forest_kind *kind)
{
    double per_m2 = per_ha / HECTARE;
    return (struct forest_stratum){per_m2 * width, per_m2, kind, 0, 0};
}

/* Return the number of kinds of a stand. */
static size_t count_kinds(const struct ceduo_stand *stand)
{
    return stand->shoots_count + stand->trees_count + (stand->stumps.per_ha > 0) + (stand->logs.per_ha > 0);
}

/* Make kind i of a stand, and return its stratum. */
static struct forest_stratum make_stratum(const struct ceduo_stand *stand, size_t i, struct forest_kind *kind)
{
    size_t shoots = stand->shoots_count, stumps = shoots + stand->trees_count;
    if (i < shoots) { /* cohorts share the stratum of the stools */
        double sum = 0;
        *kind = make_kind(stand, &stand->shoots[i]);
        for (size_t k = 0; k <= i; k++)
            sum += stand->shoots[k].per_ha;
        kind->share_to = i + 1 < shoots ? sum / ceduo_stand_shoots(stand) : 1;
        return (struct forest_stratum){.kind = kind};
    }
    if (i < stumps) {
        const struct ceduo_stems *trees = &stand->trees[i - shoots];
        *kind = make_kind(stand, trees);
        if (!ceduo_stems_are_grouped(trees))
            return plain_stratum(trees->per_ha, kind->dbh, kind);
        /* the stratum of a group counts its centre, in a strip within reach of its trees */
        double per_m2 = trees->per_ha / HECTARE / trees->group, width = 2 * trees->group_radius + kind->dbh_max;
        return (struct forest_stratum){per_m2 * width, per_m2, kind, trees->group, trees->group_radius};
    }
    /* stumps and logs have their own energy, whatever the law of the stems */
    const struct ceduo_stumps *t = &stand->stumps;
    const struct ceduo_logs *l = &stand->logs;
    if (i == stumps && t->per_ha > 0) {
        *kind = (struct forest_kind){
            .dbh = t->diameter, .dbh_max = t->diameter, .height = t->height, .hit_below = INFINITY, .energy = t->energy};
        return plain_stratum(t->per_ha, t->diameter, kind);
    }
    /* a log lies across the path: dbh NaN, because it has no eccentricity */
    *kind = (struct forest_kind){.dbh = NAN, .height = l->diameter, .hit_below = INFINITY, .energy = l->energy};
    return plain_stratum(l->per_ha, ceduo_log_width(l->length), kind);
}

/* ---- stools ---- */

static bool make_stools(struct forest *w, size_t belt, const struct ceduo_stand *stand, const struct forest_kind *kinds)
{
    struct forest_stools *s = &w->stools[belt];
    double per_stool = ceduo_stand_shoots(stand) / stand->stools_per_ha;
    s->n = (unsigned)floor(per_stool);
    s->extra_chance = per_stool - floor(per_stool);
    s->cohorts = stand->shoots_count;
    s->kinds = kinds;
    s->ring_capacity = ((size_t)s->n / FOREST_RING_STEP + 1) * FOREST_RING_STEP;
    for (unsigned i = 0; i < (s->extra_chance > 0 ? 2 : 1); i++) {
        double *ring = w->rings[2 * belt + i] = calloc(2 * s->ring_capacity, sizeof *ring);
        if (!ring)
            return false;
        for (unsigned k = 0; k < s->n + i; k++)
            ceduo_sincos_turn(k, s->n + i, &ring[k], &ring[s->ring_capacity + k]);
        s->ring[i] = ring;
        s->radius[i] = ceduo_stool_radius(s->n + i, stand->spacing);
        s->turn[i] = s->n + i > 1 ? 2 * M_PI / (s->n + i) : 0;
    }
    s->reach = fmax(s->radius[0], s->radius[1]);
    for (size_t i = 0; i < s->cohorts; i++) {
        s->dbh_max = fmax(s->dbh_max, kinds[i].dbh_max);
        s->dbh_varies |= kinds[i].shape > 0;
        w->tallest = fmax(w->tallest, kinds[i].height);
    }
    w->reach = fmax(w->reach, s->reach);
    return true;
}

/* ---- belts ---- */

/* Make the strata of a belt; the first is for stools. */
static bool make_belt(struct forest *w, size_t belt, const struct ceduo_stand *stand, struct forest_kind *kinds,
                      struct forest_stratum *strata)
{
    struct forest_belt *to = &w->sides[0][belt];
    size_t n = 1;
    for (size_t i = 0; i < count_kinds(stand); i++) {
        strata[n] = make_stratum(stand, i, &kinds[i]);
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
    const struct forest_stools *s = to->stools = &w->stools[belt];
    double per_m2 = stand->stools_per_ha / HECTARE;
    strata[0] = (struct forest_stratum){per_m2 * (2 * s->reach + s->dbh_max), per_m2, NULL, 0, 0};
    return true;
}

static bool allocate(struct forest *w, const struct ceduo_option *option)
{
    size_t kinds = 0;
    for (size_t i = 0; i < option->belts_count; i++)
        kinds += option->belts[i].stand.shoots_count + option->belts[i].stand.trees_count + 3; /* stumps, logs, and stools */
    w->kinds = calloc(kinds + 1, sizeof *w->kinds);
    w->strata_buffer = calloc(kinds + 1, sizeof *w->strata_buffer);
    w->stools = calloc(option->belts_count + 1, sizeof *w->stools);
    w->rings = calloc(2 * option->belts_count + 1, sizeof *w->rings);
    w->sides[0] = calloc(option->belts_count + 1, sizeof *w->sides[0]);
    w->sides[1] = calloc(option->belts_count + 1, sizeof *w->sides[1]);
    w->belts = option->belts_count;
    return w->kinds && w->strata_buffer && w->stools && w->rings && w->sides[0] && w->sides[1];
}

#define MET_MAX ((size_t)1 << 20)
_Static_assert(MET_MAX > CEDUO_STEMS_MAX, "a rock that is among more stools is not followed further");

/* Return the mask of a hash table for all stools within reach of a rock, on either side; far above the random maximum. */
static size_t choose_met_mask(const struct forest *w, double b)
{
    double rate_max = 0;
    for (size_t i = 0; i < w->belts; i++)
        if (w->sides[0][i].strata_count > 0)
            rate_max = fmax(rate_max, w->sides[0][i].strata[0].base_rate + w->sides[0][i].strata[0].rate_per_b * b);
    double wanted = 64 + 16 * rate_max * 2 * w->reach;
    size_t places = 64;
    while ((double)places < wanted && places < MET_MAX)
        places *= 2;
    return places - 1;
}

bool ceduo_forest_init(struct forest *forest, const struct ceduo_simulation *simulation, const struct ceduo_option *option,
                       const struct ceduo_rock *mean)
{
    *forest = (struct forest){.bare = true};
    if (!option || simulation->contact_model == CEDUO_CONTACT_MODEL_INDEX)
        return true;
    if (!allocate(forest, option))
        goto fail;
    size_t kinds_used = 0;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        struct forest_belt *to = &forest->sides[0][i];
        *to = (struct forest_belt){.from = belt->from, .to = belt->to, .strata = &forest->strata_buffer[kinds_used]};
        if (ceduo_stand_is_bare(&belt->stand))
            continue;
        forest->bare = false;
        if (!make_belt(forest, i, &belt->stand, &forest->kinds[kinds_used], &forest->strata_buffer[kinds_used]))
            goto fail;
        kinds_used += count_kinds(&belt->stand) + 1;
    }
    for (size_t i = 0; i < forest->belts; i++) {
        const struct forest_belt *forward_belt = &forest->sides[0][forest->belts - 1 - i];
        forest->sides[1][i] = *forward_belt;
        forest->sides[1][i].from = -forward_belt->to;
        forest->sides[1][i].to = -forward_belt->from;
    }
    forest->met_mask = choose_met_mask(forest, mean->mean_diameter);
    for (struct forest_kind *k = forest->kinds; k < forest->kinds + kinds_used; k++) {
        bool depends = isnan(k->energy);
        k->full_energy = depends ? ceduo_stem_energy_hit(&k->hit_energy, k->dbh, 1) : k->energy;
        k->by_eccentricity = depends && ceduo_stem_energy_by_eccentricity(&k->hit_energy);
        forest->by_eccentricity |= k->by_eccentricity;
    }
    return true;
fail:
    ceduo_forest_release(forest);
    return false;
}

void ceduo_forest_release(struct forest *forest)
{
    for (size_t i = 0; forest->rings && i < 2 * forest->belts; i++)
        free(forest->rings[i]);
    free(forest->rings);
    free(forest->stools);
    free(forest->strata_buffer);
    free(forest->kinds);
    free(forest->sides[0]);
    free(forest->sides[1]);
    *forest = (struct forest){.bare = true};
}

/* ---- hashing ---- */

/* Uses the kinds and strata of the prepared forest, but allocates no memory and cannot fail. */

bool ceduo_forest_hash(uint64_t *hash, const struct ceduo_simulation *simulation, const struct ceduo_option *option)
{
    bool bare = true;
    if (!option || simulation->contact_model == CEDUO_CONTACT_MODEL_INDEX)
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
            struct forest_kind kind;
            const struct forest_stratum stratum = make_stratum(stand, k, &kind);
            hash_each(hash, stratum.base_rate, stratum.rate_per_b);
            _Static_assert(offsetof(struct forest_stratum, kind) == 2 * sizeof(double), "all numbers before it are hashed");
            hash_each(hash, kind.dbh, kind.height, kind.hit_below, kind.energy, kind.shape, kind.scale, kind.share_to);
            _Static_assert(offsetof(struct forest_kind, dbh_max) == 7 * sizeof(double), "all numbers before it are hashed");
            if (isnan(kind.energy))
                ceduo_stem_energy_hash(hash, &kind.hit_energy);
            hash_count(hash, stratum.group);
            hash_double(hash, stratum.radius);
        }
    }
    return !bare;
}
