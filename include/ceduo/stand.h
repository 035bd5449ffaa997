/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STAND_H
#define CEDUO_STAND_H

#include <stdbool.h>
#include <stddef.h>

/* Silvicultural systems. */
#define CEDUO_SYSTEMS(X)                                                                                                       \
    X(SIMPLE_COPPICE, "simple-coppice")                                                                                        \
    X(COPPICE_WITH_STANDARDS, "coppice-with-standards")                                                                        \
    X(SELECTION_COPPICE, "selection-coppice")                                                                                  \
    X(LARGE_RESERVES, "large-reserves")                                                                                        \
    X(HIGH_FOREST, "high-forest")                                                                                              \
    X(BARE, "bare")

enum ceduo_system {
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_SYSTEMS(X)
#undef X
};

/* Laws of the energy that a stem takes from a rock. To add one, write a file like src/core/stand/energy_dorren.c, and list
 * it. */
#define CEDUO_ENERGY_MODELS(X)                                                                                                 \
    X(BRAUNER, brauner)                                                                                                        \
    X(DORREN, dorren)

enum ceduo_energy_model {
#define X(NAME, name) CEDUO_##NAME,
    CEDUO_ENERGY_MODELS(X)
#undef X
};

/* Energy that brauner takes if a stem is hit off its centre. */
#define CEDUO_ENERGY_OFFSETS(X)                                                                                                \
    X(WHOLE, "whole")            /* the same as in the centre: Ciabocco et al. 2009 */                                         \
    X(BY_ECCENTRICITY, "dorren") /* the share of Dorren et al. 2006, ceduo_dorren_share() */

enum ceduo_energy_offset {
#define X(NAME, word) CEDUO_OFFSET_##NAME,
    CEDUO_ENERGY_OFFSETS(X)
#undef X
};

/* Stems of one kind: shoots of one age on the stools, or trees of one class. Densities are per horizontal hectare. */
struct ceduo_stems {
    double per_ha;       /* >= 0; 0: empty, and the other members are ignored */
    double dbh;          /* m, > 0 */
    double height;       /* m, > 0 */
    double volume;       /* m3 per stem; NaN: computed from species, dbh and height */
    double dbh_sd;       /* m; 0: all equal */
    double age;          /* years; NaN: unknown */
    unsigned group;      /* single trees per group; 0 or 1: not grouped */
    double group_radius; /* m, >= 0: radius of the disc of a group; NaN: not given */
    double per_stool;    /* shoots per stool, if given instead of per_ha; NaN or 0: not given */
};

/* Stumps that a cut leaves. Rocks meet them as trees of this height; a hit takes `energy` (J). per_ha 0: none. */
struct ceduo_stumps {
    double per_ha, diameter, height, energy;
};

/* Logs lying at random angles. A rock meets one if its underside is below the diameter. per_ha 0: none. */
struct ceduo_logs {
    double per_ha, length, diameter, energy;
};

/* Growth of a stem: dbh D(1 - exp(-k age)), height H(1 - exp(-m age)). All 0: unknown. */
struct ceduo_curve {
    double dbh_max, dbh_rate;       /* D, m, > 0; k, 1/year, > 0 */
    double height_max, height_rate; /* H, m, > 0; m, 1/year, > 0 */
};

/* How a stand grows from year to year (assumed, see rotation.h). All 0: unknown, the stand does not change. */
struct ceduo_growth {
    struct ceduo_curve shoots, trees;
    double shoots_young, shoots_old; /* shoots per stool just after a cut, and in old age; shoots_young >= shoots_old >= 1 */
    double sdi_max;                  /* maximum stand density index, > 0: shoots are thinned to it; 0: not thinned */
    double trees_sdi_max;            /* density index of trees that take all growing space; 0: CEDUO_TREES_SPACE of sdi_max */
    unsigned stump_years;            /* years that stumps persist after a cut */
};

/* Trees with free crowns occupy a site fully from about 35 % of the maximum density on (Long 1985). Assumed for standards,
 * too. */
#define CEDUO_TREES_SPACE 0.35

/* Cutting of a stand. */
struct ceduo_cutting {
    unsigned rotation;     /* years between two cuts; 0: never cut */
    unsigned cohorts;      /* cohorts of shoots on a stool; each cut takes the oldest; 0 or 1: each cut takes all shoots */
    size_t retained_count; /* number of age classes of trees that a cut leaves */
    double *stay_per_ha;   /* trees per ha, >= 0, that are 1, 2, 3 … rotations old */
};

/* A stand. Without members it is no forest. Shoots stand on stools; stools without shoots are ignored. */
struct ceduo_stand {
    enum ceduo_system system;
    int species;          /* index into ceduo_species_list(); -1: not given */
    double stools_per_ha; /* Nc; 0: none */
    double spacing;       /* s, m: between neighbouring shoots of a stool (dbh_int of Ciabocco et al. 2009) */
    size_t shoots_count, trees_count;
    struct ceduo_stems *shoots; /* cohorts on the stools */
    struct ceduo_stems *trees;  /* classes of single trees: standards, reserves, maidens */
    struct ceduo_stumps stumps;
    struct ceduo_logs logs;
    enum ceduo_energy_model energy;
    double u;                        /* J/m3, brauner; NaN: value of the species */
    double fracture_ratio;           /* dorren; NaN: value of the species */
    enum ceduo_energy_offset offset; /* brauner */
    double hit_below;                /* m: a hit takes no energy if the rock's centre is higher above the ground; 0: no limit */
    double counted_from;             /* m: minimum dbh of stems counted in the ADC (adc.h); rocks meet all stems */
    struct ceduo_growth growth;
    struct ceduo_cutting cutting;
};

/* Set per_ha of shoots that are given per stool. Call it after reading or changing a stand; all other code reads per_ha. */
void ceduo_stand_update_shoot_density(struct ceduo_stand *stand);

/* Sums over a stand, per hectare. */
double ceduo_stand_shoots(const struct ceduo_stand *stand);
double ceduo_stand_trees(const struct ceduo_stand *stand);
double ceduo_stand_retained_per_ha(const struct ceduo_stand *stand); /* single trees retained by a cut */
double ceduo_stand_basal_area(const struct ceduo_stand *stand);      /* m2/ha: sum of N pi d2/4 */
bool ceduo_stand_has_shoots(const struct ceduo_stand *stand);
bool ceduo_stand_has_stems(const struct ceduo_stand *stand); /* shoots or trees */
bool ceduo_stand_is_bare(const struct ceduo_stand *stand);   /* no stems, stumps or logs */
bool ceduo_stems_are_grouped(const struct ceduo_stems *stems);

/* Data of a species. Volume (m3) = (b0 + b1 d2 h + b2 d)/1000, d in cm, h in m (Tabacchi et al. 2011), inside its rectangle. */
struct ceduo_species {
    const char *name;   /* in files: ostrya-carpinifolia */
    const char *common; /* common name: hop hornbeam */
    double b0, b1, b2;
    double h_lo, h_hi, d_lo, d_hi; /* m, cm */
    double u;                      /* J/m3: Table 4 of Ciabocco et al. 2009, or its beech value */
    bool u_literature;             /* false: the value of beech, assumed for this species */
    double fracture_ratio;         /* from the list of Dorren and Berger; NaN: not listed */
};

const struct ceduo_species *ceduo_species_list(size_t *count);

/* Return the index of a species by name, or -1. */
int ceduo_species_find(const char *name);

#define CEDUO_FORM_FACTOR 0.5

enum ceduo_volume_from { CEDUO_VOLUME_GIVEN, CEDUO_VOLUME_EQUATION, CEDUO_VOLUME_FORM_FACTOR };

/* Return the volume (m3) of one of `stems`, and set its source. A given volume comes first, then the equation of the species
 * inside its rectangle of dbh and height. Outside, the form factor at the nearest point of the rectangle applies (assumed).
 * Without a species the volume is form factor 0.5 × basal area × height. */
double ceduo_stem_volume(const struct ceduo_stand *stand, const struct ceduo_stems *stems, enum ceduo_volume_from *from);

/* Return the work of breaking (J/m3) for brauner: of the stand, else of its species, else of beech. */
double ceduo_stand_u(const struct ceduo_stand *stand);

/* Return the strength of the wood relative to silver fir for dorren: of the stand, else of its species, else 1 (assumed). */
double ceduo_stand_fracture_ratio(const struct ceduo_stand *stand);

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
