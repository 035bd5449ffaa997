/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ENERGY_H
#define CEDUO_ENERGY_H

#include <stdint.h>

#include "scene/volume.h"

/* Energy law of one kind of stems, prepared for many hits. Its numbers are hashed. */
struct stem_energy {
    enum ceduo_energy_model model;
    struct stem_volume volume; /* for laws that need it */
    double values[3];          /* parameters of the law */
};

/* An energy law of CEDUO_ENERGY_MODELS; energy_NAME.c defines ceduo_energy_NAME. No function may be NULL. */
struct energy_law {
    /* Sets `volume` and `values`. */
    void (*prepare)(struct stem_energy *to, const struct ceduo_stand *stand, const struct ceduo_stems *stems);
    /* Returns the mean energy (J) of the mean stem, over all eccentricities. */
    double (*mean)(const struct stem_energy *e);
    /* Returns the energy (J) of a stem of `dbh` m; `share` is the ceduo_dorren_share() of the hit. */
    double (*hit)(const struct stem_energy *e, double dbh, double share);
    /* True if hit() depends on `share`. */
    bool (*by_eccentricity)(const struct stem_energy *e);
    /* Returns bits of enum ceduo_warning. */
    unsigned (*warnings)(const struct ceduo_stand *stand, const struct ceduo_stems *stems);
};

struct stem_energy ceduo_stem_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems);
/* Mix all inputs of a hit into a hash. */
void ceduo_stem_energy_hash(uint64_t *hash, const struct stem_energy *e);

/* Call the function of the law. */
double ceduo_stem_energy_mean(const struct stem_energy *e);
double ceduo_stem_energy_hit(const struct stem_energy *e, double dbh, double share);
bool ceduo_stem_energy_by_eccentricity(const struct stem_energy *e);
unsigned ceduo_stem_energy_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

/* Share of Dorren et al. 2006 at eccentricity u, not clamped: LOW + SPAN/(1 + 10^(STEEPNESS (u - CENTRE))), by a power of e. */
#define LN10                   2.302585092994046
#define DORREN_LOW             (-0.046)
#define DORREN_SPAN            1.026
#define DORREN_CENTRE          0.58
#define DORREN_STEEPNESS       8.007
#define DORREN_EXPONENT(u)     (LN10 * ((DORREN_CENTRE - (u)) * -DORREN_STEEPNESS))
#define DORREN_SHARE_OF(power) (DORREN_LOW + DORREN_SPAN / (1.0 + (power)))

/* Return CEDUO_WARNING_FORM_FACTOR if a volume is by the form factor. */
unsigned ceduo_volume_warning(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

/* Return the energy (J) that a contact with one of `stems` takes. brauner: V·U (Eq. 3 of Ciabocco et al. 2009). dorren: mean
 * over all eccentricities (0.558) of E = FE·38.7·dbh_cm^2.31 (Dorren et al. 2006). */
double ceduo_contact_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

/* dorren: maximum energy (J) of a stem of `dbh` m, and the share of it at eccentricity u = |offset|/((B + d)/2), 0…1, clamped
 * (Dorren et al. 2006). */
double ceduo_dorren_energy(double dbh, double fracture_ratio);
double ceduo_dorren_share(double u);

/* Return the mean of ceduo_dorren_share() over u uniform in 0…1. */
double ceduo_dorren_mean_share(void);

#endif
