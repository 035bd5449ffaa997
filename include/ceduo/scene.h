/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENE_H
#define CEDUO_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* ---- flag ---- */

/* A flag that another thread sets to end a call soon. It has the same layout in C and in C++. */
#ifdef __cplusplus
#include <atomic>
typedef std::atomic<bool> ceduo_flag;
#else
#include <stdatomic.h>
typedef atomic_bool ceduo_flag;
#endif

/* ---- status ---- */

/* Results of a call, each with its ceduo_status_text(). The text does not name the file, field or item: the caller knows it. */
#define CEDUO_STATUSES(X)                                                                                                      \
    X(OK, "done")                                                                                                              \
    X(NO_MEMORY, "out of memory")                                                                                              \
    X(CANCELLED, "cancelled") /* by the caller's flag; the run keeps the finished rocks */                                     \
    X(BAD_ROCK, "a size, mass or density of the rock is missing, not finite or not above 0")                                   \
    X(BAD_SLOPE, "the slope has fewer than two vertices, its x does not rise, or a coefficient is outside its range")          \
    X(RELEASE_OFF_SLOPE, "the release, or a part of its spread, lies beyond the slope")                                        \
    X(RELEASE_BELOW, "the release, or a part of its spread, lies below the ground")                                            \
    X(CONTROL_OFF_SLOPE, "a control lies beyond the slope")                                                                    \
    X(CONTROL_BEHIND, "a control does not lie beyond the release")                                                             \
    X(NO_FIT, "no curve goes through these pairs")                                                                             \
    X(BAD_NUMBER, "a number or word is outside its range, or a list is missing")                                               \
    X(BAD_BELT, "a belt overlaps another, ends before it begins, or lies beyond the slope")                                    \
    X(BAD_STAND, "a number or word of a stand is outside its range, or stems have no size")                                    \
    X(BAD_FILE, "a scene could not be read; its messages say why")                                                             \
    X(BAD_ARGUMENT, "a pointer is missing, or a count, an index or a window of years is outside its range")                    \
    X(BAD_PLACE, "an input names a place that the scene does not have")

enum ceduo_status {
#define X(NAME, text) CEDUO_##NAME,
    CEDUO_STATUSES(X)
#undef X
};

/* Return a sentence in English without a full stop; never NULL. */
const char *ceduo_status_text(enum ceduo_status status);

#define CEDUO_VERSION "0.5.0"

/* Return the version of the running library. Before 1.0 structs may change: programs must compare it with their
 * CEDUO_VERSION. */
const char *ceduo_version(void);

/* ---- rock ---- */

#define CEDUO_SPREAD_KINDS(X)                                                                                                  \
    X(NORMAL, "normal")                                                                                                        \
    X(UNIFORM, "uniform")

enum ceduo_spread_kind {
#define X(NAME, word) CEDUO_SPREAD_##NAME,
    CEDUO_SPREAD_KINDS(X)
#undef X
};

/* A number that may vary from rock to rock. `spread` is the standard deviation of a normal distribution, truncated at three
 * standard deviations, or the half-width of a uniform one. If it is 0, every rock has `mean`. */
struct ceduo_number {
    double mean;
    double spread;
    enum ceduo_spread_kind kind;
};

/* Return a number without spread. */
struct ceduo_number ceduo_number(double mean);

#define CEDUO_SHAPES(X)                                                                                                        \
    X(SPHERE, "sphere")                                                                                                        \
    X(CYLINDER, "cylinder")                                                                                                    \
    X(ELLIPSOID, "ellipsoid")                                                                                                  \
    X(BLOCK, "block")

enum ceduo_shape {
#define X(NAME, word) CEDUO_SHAPE_##NAME,
    CEDUO_SHAPES(X)
#undef X
};

/* A rock as a user describes it. Sizes that are not given have mean NaN. A sphere needs one of diameter, volume or mass (with
 * density), a cylinder diameter and height, an ellipsoid or a block three axes. A given mass replaces volume × density. */
struct ceduo_rock_def {
    enum ceduo_shape shape;
    struct ceduo_number diameter; /* m, > 0 */
    struct ceduo_number height;   /* m, > 0 */
    struct ceduo_number volume;   /* m3, > 0 */
    struct ceduo_number mass;     /* kg, > 0 */
    struct ceduo_number density;  /* kg/m3, > 0 */
    struct ceduo_number axes[3];  /* m, > 0 */
};

/* Return a sphere of limestone without a size; the caller sets it. */
struct ceduo_rock_def ceduo_rock_def_default(void);

/* One rock. */
struct ceduo_rock {
    double mass;          /* M, kg */
    double mean_diameter; /* B, m: mean of the axes, as in Ciabocco et al. 2009 (0.68 m there) */
    double radius;        /* R = B/2, m */
    double moment;        /* I, kg m2: sphere and ellipsoid 2/5 MR2, cylinder 1/2 MR2, block M(b2 + c2)/12 */
    double k;             /* I/(MR2) */
    double volume;        /* m3 */
    double axes[3];       /* m; sphere: d, d, d; cylinder: d, d, h */
};

/* Return the rock of mean sizes; every member is NaN if the sizes are not valid. */
struct ceduo_rock ceduo_rock_mean(const struct ceduo_rock_def *def);

/* ---- slope ---- */

/* Orientation of the ground's facets: always against the rock, or to both sides. */
#define CEDUO_FACETS(X)                                                                                                        \
    X(AGAINST, "against")                                                                                                      \
    X(BOTH, "both")

enum ceduo_facets {
#define X(NAME, word) CEDUO_FACETS_##NAME,
    CEDUO_FACETS(X)
#undef X
};

/* The ground of one segment. */
struct ceduo_segment {
    struct ceduo_number rn; /* normal restitution, 0…1 */
    struct ceduo_number rt; /* tangential restitution, 0…1 */
    double roughness_m;     /* a height S >= 0: largest facet angle atan(S/R) (CRSP); NaN if given as an angle */
    double roughness_rad;   /* largest facet angle, 0…<pi/2; NaN if given as a height */
    double friction;        /* tan of the angle of rolling friction, >= 0 */
    double mu;              /* Coulomb friction at the point of contact, >= 0; for the arm law only */
};

/* A polyline with its ground. Coordinates are relative to the first vertex, so that survey coordinates keep all digits.
 * `origin_x`, `origin_z` are the subtracted offsets. */
struct ceduo_slope {
    enum ceduo_facets facets;
    size_t vertices;                /* >= 2; of the simulated profile */
    double *x, *z;                  /* m, x strictly increasing */
    struct ceduo_segment *segments; /* vertices - 1 */
    double tolerance;               /* m, >= 0: points this near to the simplified profile are left out; 0: none */
    double simplified_to;           /* m: tolerance of x, z; 0: not simplified */
    double simplified_at;           /* m: place of the release, kept as a vertex */
    size_t points;                  /* of the original profile; 0: same as x, z */
    double *points_x, *points_z;    /* points of the original profile, relative like x, z */
    size_t segments_given;          /* number in the files; 1: one for all; 0: derived from other input */
    bool reversed;                  /* the file lists it uphill: profile and ground were mirrored when read */
    double origin_x, origin_z;
};

/* Simplify a profile to slope->tolerance (Douglas and Peucker 1973, perpendicular distance). Keeps both ends, the vertices
 * between different grounds, and `release_x`. `to` becomes a copy with its own x, z and segments. Its x is NULL if the profile
 * is already simplified: use `slope` then. The caller releases `to` in any case. Return
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_slope_simplify(const struct ceduo_slope *slope, double release_x, struct ceduo_slope *to);

/* Release a simplified profile. A second call has no effect. */
void ceduo_slope_simplified_release(struct ceduo_slope *slope);

/* Return a segment with the default friction; restitution and roughness are NaN. */
struct ceduo_segment ceduo_segment_default(void);

/* Return the height of the polyline at x (m, relative). x must lie on the slope. */
double ceduo_slope_height(const struct ceduo_slope *slope, double x);

#define CEDUO_FACE_FALL 1.0 /* metres down per metre along, 45 degrees: steeper than any scree; assumed */

/* Position of a place below the release. Angles are inclinations of straight lines, rad, > 0 if the place lies lower. */
struct ceduo_topography {
    double reach;  /* from the release */
    double shadow; /* from the foot of the face; NaN: no face between */
    double foot;   /* m, relative; NaN likewise */
    double bench;  /* m: longest stretch of at most CEDUO_BENCH_INCLINATION between foot (or release) and place; 0: none */
};
#define CEDUO_FACE_LENGTH       5.0   /* m along the ground: minimum length of a face, all steeper than CEDUO_FACE_FALL */
#define CEDUO_BENCH_INCLINATION 0.268 /* metres down per metre along, 15 degrees; rising ground counts as flat */

/* ---- stand ---- */

/* Silvicultural systems. */
#define CEDUO_SYSTEMS(X)                                                                                                       \
    X(SIMPLE_COPPICE, "simple-coppice")                                                                                        \
    X(COPPICE_WITH_STANDARDS, "coppice-with-standards")                                                                        \
    X(SELECTION_COPPICE, "selection-coppice")                                                                                  \
    X(LARGE_RESERVES, "large-reserves")                                                                                        \
    X(HIGH_FOREST, "high-forest")                                                                                              \
    X(BARE, "bare")

enum ceduo_system {
#define X(NAME, word) CEDUO_SYSTEM_##NAME,
    CEDUO_SYSTEMS(X)
#undef X
};

/* Laws of the energy that a stem takes from a rock. To add one, write a file like src/core/stand/energy_dorren.c, and list
 * it. */
#define CEDUO_ENERGY_MODELS(X)                                                                                                 \
    X(BRAUNER, brauner)                                                                                                        \
    X(DORREN, dorren)

enum ceduo_energy_model {
#define X(NAME, name) CEDUO_ENERGY_MODEL_##NAME,
    CEDUO_ENERGY_MODELS(X)
#undef X
};

/* Energy that brauner takes if a stem is hit off its centre. */
#define CEDUO_ENERGY_OFFSETS(X)                                                                                                \
    X(WHOLE, "whole")            /* the same as in the centre: Ciabocco et al. 2009 */                                         \
    X(BY_ECCENTRICITY, "dorren") /* the share of Dorren et al. 2006 at this eccentricity */

enum ceduo_energy_offset {
#define X(NAME, word) CEDUO_ENERGY_OFFSET_##NAME,
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

/* How a stand grows from year to year (assumed, see years.h). All 0: unknown, the stand does not change. */
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
    double counted_from;             /* m: minimum dbh of stems counted in the ADC (struct ceduo_adc); rocks meet all stems */
    struct ceduo_growth growth;
    struct ceduo_cutting cutting;
};

/* Set per_ha of shoots that are given per stool. Call it after reading or changing a stand; all other code reads per_ha. */
void ceduo_stand_update_shoot_density(struct ceduo_stand *stand);

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

/* Return all species: *count static rows. */
const struct ceduo_species *ceduo_species_list(size_t *count);

/* Return the index of a species by name, or -1. */
int ceduo_species_find(const char *name);

/* ---- scene ---- */

#define CEDUO_GRAVITY     9.81
#define CEDUO_THRESHOLD_M 30      /* Bozzolo 1987 as cited by Ciabocco et al. 2009 */
#define CEDUO_ROCKS_MAX   1048576 /* in a run, which stores each: the standard error of a share is at most 0.0005 */

/* Laws of impact on the ground. To add one, write a file like src/core/walk/law_crsp.h, include it in strike.h, and list it. */
#define CEDUO_LAWS(X)                                                                                                          \
    X(LUMPED, lumped)                                                                                                          \
    X(CRSP, crsp)                                                                                                              \
    X(ARM, arm)

enum ceduo_law {
#define X(NAME, name) CEDUO_LAW_##NAME,
    CEDUO_LAWS(X)
#undef X
        CEDUO_LAW_COUNT
};

/* Release of a rock. Each number may have a spread. */
struct ceduo_release {
    struct ceduo_number x;      /* m, relative to the slope's first vertex */
    struct ceduo_number height; /* m above the ground, >= 0 */
    struct ceduo_number vx, vz; /* m/s, z upward */
    struct ceduo_number spin;   /* rad/s, positive if it rolls forward in +x */
    bool x_assumed;             /* x is not given: the first vertex */
    double share;               /* share of all rocks, > 0, if there are several releases; they need not add up to 1 */
};

/* A net fence at a control. It changes no trajectory: the passing rocks are compared with it. A rock defeats the fence if its
 * top passes above the fence, or if its energy of translation is above the energy of the fence; an equal value is held. */
struct ceduo_fence {
    double height; /* m, nominal, perpendicular to the ground; NaN or 0: no fence */
    double energy; /* J that it holds (maximum energy level, MEL) */
    double life;   /* years; NaN or 0: CEDUO_FENCE_LIFE */
};

#define CEDUO_FENCE_LIFE 50 /* years; assumed */

/* A place at which passing rocks are counted. */
struct ceduo_control {
    double x;               /* m, relative to the slope's first vertex */
    double x_given;         /* as the user wrote it */
    char *name;             /* as displayed; NULL: none */
    char *name_given;       /* as the user wrote it, if a name in another language is displayed */
    double accepted;        /* J that the object at risk withstands; NaN: not given */
    double measured_speed;  /* m/s of a real rock observed here; NaN: none */
    double accepted_return; /* years, > 0: return period of rocks with more than `accepted`; NaN or 0: CEDUO_ACCEPTED_RETURN */
    struct ceduo_fence fence;
};

#define CEDUO_ACCEPTED_RETURN 100 /* years; assumed */

/* A stretch of forest. */
struct ceduo_belt {
    double from, to;             /* m, relative to the slope's first vertex */
    double from_given, to_given; /* as the user wrote them */
    char *name, *name_given;     /* of the stand: as displayed, and as the user wrote it */
    bool assumed;                /* some value of the stand is an assumption */
    bool changed;                /* numbers of a stand from a file were changed, and it has no name of its own */
    bool felled;                 /* in a year of ceduo_years: this stand was left by a cut in this year */
    double cut_year;             /* year of a cut, as `first_cut` of ceduo_stand_at(); NaN: cut when old enough */
    struct ceduo_stand stand;
};

/* A silvicultural option. Its belts are sorted by x and do not overlap. */
struct ceduo_option {
    char *name, *name_given; /* as displayed, and as the user wrote it */
    size_t belts_count;
    struct ceduo_belt *belts;
};

/* Models of contacts with stems. */
#define CEDUO_CONTACT_MODELS(X)                                                                                                \
    X(INDEX, "index") /* no contacts: only Eq. 5 of Ciabocco et al. 2009 is computed */                                        \
    X(STEMS, "stems") /* stools and trees stand at random; a rock hits each stem in its path on its own */

enum ceduo_contact_model {
#define X(NAME, word) CEDUO_CONTACT_MODEL_##NAME,
    CEDUO_CONTACT_MODELS(X)
#undef X
};

/* Forms of the Average Distance between Contacts. AUTO is the rule of Ciabocco et al. 2009: gsteiger-stems if the rock is
 * smaller than the spacing of the shoots or if there are no stools, otherwise interception. */
#define CEDUO_RULES(X)                                                                                                         \
    X(AUTO, "auto")                                                                                                            \
    X(GSTEIGER_STOOLS, "gsteiger-stools") /* Eq. 1 as the paper computed it: A/[(Nc + Ns)(B + mean d)] */                      \
    X(GSTEIGER_STEMS, "gsteiger-stems")   /* Eq. 1 with every stem: A/[sum N(B + d)], the mean free path */                    \
    X(INTERCEPTION, "interception")       /* Eq. 6: A/[(Nc + Ns)B + Nc(mean shoot d + s) + sum N d of trees] */                \
    X(CROFTON, "crofton") /* A/[Nc(B + mean shoot d + P/pi) + sum N(B + d) of trees]: stools met (Cauchy, Crofton) */

enum ceduo_rule {
#define X(NAME, word) CEDUO_RULE_##NAME,
    CEDUO_RULES(X)
#undef X
};

struct ceduo_simulation {
    enum ceduo_law law;
    uint64_t rocks; /* 1…10^7 */
    uint64_t seed;  /* 0…2^53 */
    enum ceduo_contact_model contact_model;
    enum ceduo_rule rule;
    double threshold;    /* m */
    double contact_dbh;  /* m: ADC, free run and index count stems from this dbh on */
    double gravity;      /* m/s2 */
    bool scale_rn;       /* lumped: Rn divided by 1 + (Vn/9.144 m/s)2 */
    bool friction_bound; /* friction limits the tangential loss of impacts and rolling; false: the published laws */
};

/* A class of blocks that come down. The number above a volume v is proportional to v^-exponent, truncated at the largest
 * volume. With exponent 0, ranges of equal ratio have equal numbers. */
struct ceduo_size_class {
    double per_year;      /* > 0 */
    double exponent;      /* >= 0 */
    size_t volumes_count; /* 2 */
    double *volumes;      /* m3: the smallest and the largest */
};

/* Quality of a survey of the ground or of the blocks. */
#define CEDUO_QUALITIES(X)                                                                                                     \
    X(GOOD, "good")                                                                                                            \
    X(POOR, "poor")

enum ceduo_quality {
#define X(NAME, word) CEDUO_QUALITY_##NAME,
    CEDUO_QUALITIES(X)
#undef X
};

/* Survey qualities for the design values; -1: none requested. */
struct ceduo_design_values {
    int survey, blocks;  /* enum ceduo_quality */
    double fence_factor; /* factor of the energy of a fence, >= 1; NaN or 0: not given */
};

/* Head of a report, as an office writes it; NULL: not given. */
struct ceduo_report_head {
    char *place, *owner, *parcel, *author, *date, *note;
};

/* Requirements of the forest regulation of a region for a coppice. */
struct ceduo_regulation_item {
    size_t species_count; /* 0: all species without an item of their own */
    char **species;       /* names in ceduo_species_list() */
    int system;           /* only for this system; -1: any */
    double min, max;      /* standards per ha, or years; NaN: no maximum */
    char *article;        /* and the act that contains it */
    unsigned year;        /* of the act */
};

struct ceduo_regulation {
    char *name;           /* of the region; NULL: no regulation */
    char *note, *note_it; /* NULL: none; in Italian; NULL: not given */
    size_t standards_count, turns_count;
    struct ceduo_regulation_item *standards, *turns; /* the first item that applies to a stand counts */
};

/* Compliance of a coppice with its regulation. */
struct ceduo_compliance {
    const struct ceduo_regulation *regulation;                      /* NULL: no regulation, or no coppice */
    const struct ceduo_regulation_item *standards_item, *turn_item; /* NULL: no item for this species */
    double standards;             /* per ha, left by a cut; all trees if the stand does not specify them */
    double turn;                  /* years: age of the oldest shoots at a cut; NaN: the stand is never cut */
    bool standards_met, turn_met; /* valid if there is an item, and a turn */
};

/* All inputs of a run. */
struct ceduo_scene {
    size_t size; /* sizeof this struct, set by the default; another value: CEDUO_BAD_ARGUMENT */
    char *title;
    char *title_it; /* in Italian; NULL: not given */
    struct ceduo_report_head page;
    struct ceduo_rock_def rock;
    size_t blocks_count;             /* classes that do not overlap; 0: every rock is `rock` */
    struct ceduo_size_class *blocks; /* volumes of `rock`, scaled; results for one rock, such as the ADC, use `rock` */
    struct ceduo_release release;    /* with `releases`, their mean: results for one rock, such as the index, use it */
    size_t releases_count;           /* 0: every rock starts at `release` */
    struct ceduo_release *releases;  /* each rock draws one of them */
    struct ceduo_slope slope;
    size_t controls_count;
    struct ceduo_control *controls; /* in the user's order */
    size_t options_count;           /* >= 1 */
    struct ceduo_option *options;   /* the first is the baseline */
    struct ceduo_simulation simulation;
    struct ceduo_design_values design;
    double rocks_per_year;         /* released per year; NaN: not given */
    double year_first, year_last;  /* of the simulated years; NaN: one whole rotation of each option */
    double reserves_minimum;       /* single trees per ha that a forest must keep; NaN: not given */
    struct ceduo_regulation rules; /* of the region */
};

/* Return a scene with all defaults, but without slope, control and option. */
struct ceduo_scene ceduo_scene_default(void);

/* Return the defaults of a part. A member without default is NaN, 0 or NULL, see its comment; system and species are -1. */
struct ceduo_option ceduo_option_default(void);
struct ceduo_belt ceduo_belt_default(void);
struct ceduo_stand ceduo_stand_default(void);
struct ceduo_stems ceduo_stems_default(void);
struct ceduo_control ceduo_control_default(void);

/* Check that the parts are consistent: rock, slope, release on the slope, controls on the slope beyond the release. Sets
 * `bad_control` (may be NULL) to the index of the offending control. CEDUO_BAD_ARGUMENT if `scene` is NULL. */
enum ceduo_status ceduo_scene_check(const struct ceduo_scene *scene, size_t *bad_control);

/* ---- observations of real rocks, and uncertain values ---- */

#define CEDUO_OBSERVED_USES(X)                                                                                                 \
    X(FIT, "fit")                                                                                                              \
    X(CHECK, "check") /* only predicted, to check the fit */

enum ceduo_observed_use {
#define X(NAME, word) CEDUO_OBSERVED_USE_##NAME,
    CEDUO_OBSERVED_USES(X)
#undef X
};

/* Place of an observation. It determines the keys, and the simulated values to compare. */
enum ceduo_location {
    CEDUO_LOCATION_AT_REST,  /* end point of a rock that came to rest or was stopped */
    CEDUO_LOCATION_AT_PLACE, /* rocks that pass a place */
    CEDUO_LOCATION_LARGEST,  /* maximum of each rock along its trajectory */
    CEDUO_LOCATION_ALONG,    /* mean over the metres of a stretch, for each rock that enters it */
    CEDUO_LOCATION_ON_STEMS  /* impacts on stems along a stretch: centre of the rock */
};

/* Observed quantity; its row has the unit. Heights above the ground refer to the underside, on stems to the centre. */
enum ceduo_quantity {
    CEDUO_QUANTITY_PLACE,
    CEDUO_QUANTITY_COUNT,
    CEDUO_QUANTITY_SPEED,
    CEDUO_QUANTITY_HEIGHT,
    CEDUO_QUANTITY_ENERGY
};

/* Kinds of observations: name, path in a row of the file, key of a list of values (NULL: none), place and quantity. To add one,
 * add a row here, and its keys in scene/fields_observed.c. */
#define CEDUO_OBSERVED_LIST(X)                                                                                                 \
    X(STOPS, "stops", "x_m", AT_REST, PLACE)                                                                                   \
    X(PASSED, "passed", NULL, AT_PLACE, COUNT)                                                                                 \
    X(SPEED, "speed", "values", AT_PLACE, SPEED)                                                                               \
    X(HEIGHT, "height", "values", AT_PLACE, HEIGHT)                                                                            \
    X(ENERGY, "energy", "values", AT_PLACE, ENERGY)                                                                            \
    X(LARGEST_SPEED, "largest.speed_m_s", "values", LARGEST, SPEED)                                                            \
    X(LARGEST_HEIGHT, "largest.height_m", "values", LARGEST, HEIGHT)                                                           \
    X(WAY_SPEED, "on_the_way.speed_m_s", "values", ALONG, SPEED)                                                               \
    X(WAY_HEIGHT, "on_the_way.height_m", "values", ALONG, HEIGHT)                                                              \
    X(WAY_ENERGY, "on_the_way.energy_kJ", "values", ALONG, ENERGY)                                                             \
    X(SCARS, "scars", "height_m", ON_STEMS, HEIGHT)

enum ceduo_observed_kind {
#define X(NAME, path, list, where, quantity) CEDUO_OBSERVED_##NAME,
    CEDUO_OBSERVED_LIST(X)
#undef X
        CEDUO_OBSERVED_KINDS
};

/* Kinds of uncertain values. */
enum ceduo_input_kind {
    CEDUO_INPUT_RANGE,  /* uniform between lo and hi */
    CEDUO_INPUT_FACTOR, /* value in the scene times a factor, uniform between lo and hi */
    CEDUO_INPUT_NORMAL, /* normal, truncated at three standard deviations: lo and hi */
    /* gamma, truncated like a normal one; for positive values with an error above a third of the value */
    CEDUO_INPUT_GAMMA,
    CEDUO_INPUT_WORDS, /* one of several words with equal probability */
    CEDUO_INPUT_DRAWS  /* one of several rows, each with a value for each place: posterior draws of a calibration */
};

/* ---- files ---- */

struct ceduo_input;       /* uncertainty.h */
struct ceduo_observation; /* calibrate.h */

/* A scene read from files. Its memory belongs to this struct. The caller may change numbers in place, and may set pointers to
 * memory of its own, which is not freed. */
struct ceduo_scene_file {
    struct ceduo_scene scene;
    size_t inputs_count; /* uncertain inputs, for ceduo_uncertainty_compute() */
    const struct ceduo_input *inputs;
    size_t observations_count; /* for ceduo_calibrate() */
    const struct ceduo_observation *observations;
    const char *messages; /* errors, or warnings about a valid scene, as `ceduo --check` prints them, in English; "": none */
    void *memory;
};

/* Read a scene from a file: a path, the name of a shipped scene, or "-" for standard input. `sets` is a NULL-terminated list of
 * changes PATH=VALUE (--set), applied in order; may be NULL. Return CEDUO_OK, CEDUO_BAD_FILE (see messages) or CEDUO_NO_MEMORY.
 * The caller releases *file in each case. */
enum ceduo_status ceduo_scene_read(const char *path, const char *const *sets, struct ceduo_scene_file *file);

/* Read a scene from text. Messages call it `name`. Other files are searched relative to the folder of `name`. */
enum ceduo_status ceduo_scene_read_text(const char *name, const char *text, struct ceduo_scene_file *file);

/* Release the memory. A second call has no effect. */
void ceduo_scene_file_release(struct ceduo_scene_file *file);

#endif
