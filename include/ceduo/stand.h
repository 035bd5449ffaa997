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

/* The laws of what a contact with a stem takes from a rock. A new law is a file like src/core/stand/energy_dorren.c and a line
 * here. */
#define CEDUO_ENERGY_MODELS(X)                                                                                                 \
    X(BRAUNER, brauner)                                                                                                        \
    X(DORREN, dorren)

enum ceduo_energy_model {
#define X(NAME, name) CEDUO_##NAME,
    CEDUO_ENERGY_MODELS(X)
#undef X
};

/* What brauner takes where a stem is hit beside its middle. */
#define CEDUO_ENERGY_OFFSETS(X)                                                                                                \
    X(WHOLE, "whole")            /* as much as in its middle: Ciabocco et al. 2009 */                                          \
    X(BY_ECCENTRICITY, "dorren") /* the share of Dorren et al. 2006, ceduo_dorren_share() */

enum ceduo_energy_offset {
#define X(NAME, word) CEDUO_OFFSET_##NAME,
    CEDUO_ENERGY_OFFSETS(X)
#undef X
};

/* Stems of one kind: shoots of one age on the stools, or trees of one class. Densities are per horizontal hectare. */
struct ceduo_stems {
    double per_ha;       /* >= 0; of 0 there is nothing, whatever else is said */
    double dbh;          /* m, > 0 */
    double height;       /* m, > 0 */
    double volume;       /* m3 of a stem; NaN: from species, dbh and height */
    double dbh_sd;       /* m; 0: all alike */
    double age;          /* years; NaN: unknown */
    unsigned group;      /* of single trees: so many stand in a group; 0 or 1: each by itself */
    double group_radius; /* m, >= 0: of the disc in which they stand; NaN: not said */
    double per_stool;    /* of shoots: so many on each stool, where that was given instead of per_ha; NaN or 0: it was not */
};

/* What a cut leaves: stumps are met as trees of that height are, but take `energy` (J). per_ha 0: none. */
struct ceduo_stumps {
    double per_ha, diameter, height, energy;
};

/* Stems that lie about at random angles: met where the rock's underside is below their diameter. per_ha 0: none. */
struct ceduo_logs {
    double per_ha, length, diameter, energy;
};

/* Growth of a stem: dbh D(1 - exp(-k age)), height H(1 - exp(-m age)). All 0: unknown. */
struct ceduo_curve {
    double dbh_most, dbh_rate;       /* D, m, > 0; k, 1/year, > 0 */
    double height_most, height_rate; /* H, m, > 0; m, 1/year, > 0 */
};

/* How a stand grows from year to year (assumed, see rotation.h). All 0: unknown, the stand stays as it is. */
struct ceduo_growth {
    struct ceduo_curve shoots, trees;
    double shoots_young, shoots_old; /* shoots on a stool just after a cut, and in the end: >= shoots_old >= 1 */
    double sdi_most;                 /* stand density index that the shoots are thinned to, > 0; 0: they are not */
    double trees_sdi_most; /* that of the trees at which they take all growing space; 0: CEDUO_TREES_SPACE of sdi_most */
    unsigned stump_years;  /* so long the stumps stay after a cut */
};

/* Trees whose crowns grow in the open occupy a site fully from about 35 % of the greatest density on (Long 1985); that this
 * holds for standards above a coppice is assumed. */
#define CEDUO_TREES_SPACE 0.35

/* How it is cut. */
struct ceduo_cutting {
    unsigned rotation;   /* years between two cuts; 0: never cut */
    unsigned cohorts;    /* of shoots on a stool, of which each cut takes the oldest; 0 or 1: each cut takes all */
    size_t stay_count;   /* ages of trees that stand after a cut */
    double *stay_per_ha; /* how many, >= 0: those that are 1, 2, 3 … rotations old */
};

/* A stand. Nothing in it: no forest. Shoots stand on stools; stools without shoots are as none. */
struct ceduo_stand {
    enum ceduo_system system;
    int species;          /* index into ceduo_species_list(); -1: not said */
    double stools_per_ha; /* Nc; 0: none */
    double spacing;       /* s, m: between neighbouring shoots of a stool (dbh_int of Ciabocco et al. 2009) */
    size_t shoots_count, trees_count;
    struct ceduo_stems *shoots; /* cohorts on the stools */
    struct ceduo_stems *trees;  /* classes of single trees: standards, reserves, maidens */
    struct ceduo_stumps stumps;
    struct ceduo_logs logs;
    enum ceduo_energy_model energy;
    double u;                        /* J/m3, brauner; NaN: the species' */
    double fracture_ratio;           /* dorren; NaN: the species' */
    enum ceduo_energy_offset offset; /* brauner */
    double hit_below;    /* m: a hit takes nothing where the rock's centre is higher above the ground; 0: every hit takes */
    double counted_from; /* m: the forms of the ADC count stems from this dbh on (adc.h); rocks meet all */
    struct ceduo_growth growth;
    struct ceduo_cutting cutting;
};

/* Sets per_ha of the shoots that are given per stool. What reads and changes stands does so; all else reads per_ha. */
void ceduo_stand_update_shoot_density(struct ceduo_stand *stand);

/* Sums over a stand, per hectare. */
double ceduo_stand_shoots(const struct ceduo_stand *stand);
double ceduo_stand_trees(const struct ceduo_stand *stand);
double ceduo_stand_retained_per_ha(const struct ceduo_stand *stand); /* single trees that a cut leaves */
double ceduo_stand_basal_area(const struct ceduo_stand *stand);      /* m2/ha: sum of N pi d2/4 */
bool ceduo_stand_has_shoots(const struct ceduo_stand *stand);
bool ceduo_stand_has_stems(const struct ceduo_stand *stand); /* that stand: shoots or trees */
bool ceduo_stand_is_bare(const struct ceduo_stand *stand);   /* neither stems nor stumps or logs */
bool ceduo_stems_are_grouped(const struct ceduo_stems *stems);

/* What is known of a species. Volume (m3) = (b0 + b1 d2 h + b2 d)/1000, d in cm, h in m (Tabacchi et al. 2011), inside
 * the rectangle of d and h only. */
struct ceduo_species {
    const char *name;   /* as files write it: ostrya-carpinifolia */
    const char *common; /* hop hornbeam */
    double b0, b1, b2;
    double h_lo, h_hi, d_lo, d_hi; /* m, cm */
    double u;                      /* J/m3: Table 4 of Ciabocco et al. 2009, or its beech value */
    bool u_literature;             /* false: the value of beech, assumed for this species */
    double fracture_ratio;         /* after the list of Dorren and Berger; NaN: it has none */
};

const struct ceduo_species *ceduo_species_list(size_t *count);

/* Index of a species by name, -1 where there is none. */
int ceduo_species_find(const char *name);

#define CEDUO_FORM_FACTOR 0.5

enum ceduo_volume_from { CEDUO_VOLUME_GIVEN, CEDUO_VOLUME_EQUATION, CEDUO_VOLUME_FORM_FACTOR };

/* Volume (m3) of one of `stems`, and where it comes from: as given; by the species' equation inside its rectangle of
 * dbh and height; beyond it with the form factor that the equation has at the nearest point of the rectangle (assumed);
 * without a species form factor 0.5 × basal area × height. */
double ceduo_stem_volume(const struct ceduo_stand *stand, const struct ceduo_stems *stems, enum ceduo_volume_from *from);

/* Work of breaking (J/m3) that brauner takes: the stand's own, else its species', else that of beech. */
double ceduo_stand_u(const struct ceduo_stand *stand);

/* Strength of the wood relative to silver fir that dorren takes: the stand's own, else its species', else 1 (assumed). */
double ceduo_stand_fracture_ratio(const struct ceduo_stand *stand);

/* Energy (J) that a contact with one of `stems` takes. brauner: V·U (Eq. 3 of Ciabocco et al. 2009). dorren: the mean
 * over all eccentricities (0.558) of E = FE·38.7·dbh_cm^2.31 (Dorren et al. 2006). */
double ceduo_contact_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

/* dorren: the largest energy (J) of a stem of `dbh` m, and the share of it at eccentricity u = |offset|/((B + d)/2),
 * 0…1 (Dorren et al. 2006), cut to 0…1. */
double ceduo_dorren_energy(double dbh, double fracture_ratio);
double ceduo_dorren_share(double u);

/* The mean of that share over u uniform in 0…1. */
double ceduo_dorren_mean_share(void);

#endif
