/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENERGY_H
#define CEDUO_ENERGY_H

#include "base/hash.h"
#include "energy_brauner.h"
#include "energy_dorren.h"
#include "energy_inertia.h"

/* What a hit takes from a rock, by one of CEDUO_ENERGY_MODELS, made ready for many hits of stems of one kind. A law is a
 * header energy_NAME.h with
 *     struct energy_NAME                            what it keeps of stand and stems: doubles alone, which are hashed
 *     energy_NAME(stand, stems)                     makes that
 *     NAME_mean(energy)                             J: the mean stem, over all places where it can be hit
 *     NAME_hit(energy, dbh, share)                  J: a stem of diameter dbh (m), hit |offset|/((B + dbh)/2) off its middle,
 *                                                   of which ceduo_dorren_share() is `share`
 *     NAME_mean_share(energy, mass)                 the share of its energy that a rock of `mass` kg loses: as _mean; 0: of a
 *                                                   law that takes an amount
 *     NAME_share(energy, mass, dbh, eccentricity)   of its energy the share that is lost at the most
 *     NAME_by_eccentricity(energy)                  whether _hit depends on `share`
 *     NAME_warnings(stand, stems)                   bits of enum ceduo_warning */
struct stem_energy {
    enum ceduo_energy_model model;
    union {
#define X(NAME, name) struct energy_##name name;
        CEDUO_ENERGY_MODELS(X)
#undef X
    } by;
};

static inline struct stem_energy stem_energy_of(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    struct stem_energy e = {.model = stand->energy};
    switch (stand->energy) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        e.by.name = energy_##name(stand, stems);                                                                               \
        break;
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return e;
}

/* Mixes in all that a hit depends on. */
static inline void stem_energy_hash(uint64_t *hash, const struct stem_energy *e)
{
    hash_count(hash, (uint64_t)e->model);
    switch (e->model) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        hash_doubles(hash, &e->by.name, sizeof e->by.name / sizeof(double));                                                   \
        break;
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
}

static inline double stem_energy_mean(const struct stem_energy *e)
{
    switch (e->model) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return name##_mean(&e->by.name);
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return 0;
}

static inline double stem_energy_hit(const struct stem_energy *e, double dbh, double share)
{
    switch (e->model) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return name##_hit(&e->by.name, dbh, share);
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return 0;
}

static inline bool stem_energy_by_eccentricity(const struct stem_energy *e)
{
    switch (e->model) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return name##_by_eccentricity(&e->by.name);
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return false;
}

static inline double stem_energy_mean_share(const struct stem_energy *e, double mass)
{
    switch (e->model) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return name##_mean_share(&e->by.name, mass);
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return 0;
}

/* The share of the energy of a rock of `mass` kg that a hit takes at the most. */
static inline double stem_energy_share(const struct stem_energy *e, double mass, double dbh, double eccentricity)
{
    switch (e->model) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return name##_share(&e->by.name, mass, dbh, eccentricity);
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return 1;
}

static inline unsigned stem_energy_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    switch (stand->energy) { /* untaken: table */
#define X(NAME, name)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return name##_warnings(stand, stems);
        CEDUO_ENERGY_MODELS(X)
#undef X
    }
    return 0;
}

#endif
