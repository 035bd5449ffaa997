/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENERGY_H
#define CEDUO_ENERGY_H

#include <stdint.h>

#include "ceduo/adc.h"
#include "scene/volume.h"

/* What a hit takes from a rock, made ready for many hits of stems of one kind: doubles that decide about it, which are
 * hashed. */
struct stem_energy {
    enum ceduo_energy_model model;
    struct stem_volume volume; /* of laws that need it */
    double of[3];              /* the law's own */
};

/* A law, of CEDUO_ENERGY_MODELS: an energy_NAME.c defines ceduo_energy_NAME. No function is NULL. */
struct energy_law {
    /* Sets `volume` and `of`. */
    void (*prepare)(struct stem_energy *to, const struct ceduo_stand *stand, const struct ceduo_stems *stems);
    /* J that the mean stem takes, over all places where it can be hit. */
    double (*mean)(const struct stem_energy *e);
    /* J that a stem of `dbh` m takes, of which `share` is ceduo_dorren_share() of where it is hit. */
    double (*hit)(const struct stem_energy *e, double dbh, double share);
    /* Whether that depends on `share`. */
    bool (*by_eccentricity)(const struct stem_energy *e);
    /* Bits of enum ceduo_stand_warning. */
    unsigned (*warnings)(const struct ceduo_stand *stand, const struct ceduo_stems *stems);
};

struct stem_energy ceduo_stem_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems);
/* Mixes in all that a hit depends on. */
void ceduo_stem_energy_hash(uint64_t *hash, const struct stem_energy *e);

/* What the law says. */
double ceduo_stem_energy_mean(const struct stem_energy *e);
double ceduo_stem_energy_hit(const struct stem_energy *e, double dbh, double share);
bool ceduo_stem_energy_by_eccentricity(const struct stem_energy *e);
unsigned ceduo_stem_energy_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

/* The share of Dorren et al. 2006 at eccentricity u, not yet cut: LOW + SPAN/(1 + 10^(STEEPNESS (u - CENTRE))), by a power
 * of e, for one or for many. */
#define LN10                   2.302585092994046
#define DORREN_LOW             (-0.046)
#define DORREN_SPAN            1.026
#define DORREN_CENTRE          0.58
#define DORREN_STEEPNESS       8.007
#define DORREN_EXPONENT(u)     (LN10 * ((DORREN_CENTRE - (u)) * -DORREN_STEEPNESS))
#define DORREN_SHARE_OF(power) (DORREN_LOW + DORREN_SPAN / (1.0 + (power)))

/* A volume by the form factor where it came from that. */
unsigned ceduo_volume_warning(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

#endif
