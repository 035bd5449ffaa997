/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENE_H
#define CEDUO_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "rock.h"
#include "slope.h"
#include "stand.h"

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

/* True if there is a fence. */
static inline bool ceduo_fence_stands(const struct ceduo_fence *fence)
{
    return fence->height > 0;
}

/* Return its life, years. */
static inline double ceduo_fence_life(const struct ceduo_fence *fence)
{
    return fence->life > 0 ? fence->life : CEDUO_FENCE_LIFE;
}

/* A place at which passing rocks are counted. */
struct ceduo_control {
    double x;              /* m, relative to the slope's first vertex */
    double x_given;        /* as the user wrote it */
    char *name;            /* as displayed; NULL: none */
    char *name_given;      /* as the user wrote it, if a name in another language is displayed */
    double accepted;       /* J that the object at risk withstands; NaN: not given */
    double measured_speed; /* m/s of a real rock observed here; NaN: none */
    /* Years, > 0: accepted return period of rocks with more than `accepted`. NaN or 0: not given; see
     * ceduo_accepted_return(). */
    double accepted_return;
    struct ceduo_fence fence; /* that stands here */
};

#define CEDUO_ACCEPTED_RETURN 100 /* years; assumed */

/* Return the accepted return period of a control, years. */
static inline double ceduo_accepted_return(const struct ceduo_control *control)
{
    return control->accepted_return > 0 ? control->accepted_return : CEDUO_ACCEPTED_RETURN;
}

/* A stretch of forest. */
struct ceduo_belt {
    double from, to;             /* m, relative to the slope's first vertex */
    double from_given, to_given; /* as the user wrote them */
    char *name, *name_given;     /* of the stand: as displayed, and as the user wrote it */
    bool assumed;                /* some value of the stand is an assumption */
    bool changed;                /* numbers of a stand from a file were changed, and it has no name of its own */
    bool felled;                 /* in a year of ceduo_years: this stand was left by a cut in this year */
    double cut_year;             /* year of a cut, see ceduo_first_cut(); NaN: cut when old enough */
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
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_CONTACT_MODELS(X)
#undef X
};

/* Forms of the Average Distance between Contacts. AUTO is the rule of Ciabocco et al. 2009: gsteiger-stems if the rock is
 * smaller than the spacing of the shoots or if there are no stools, otherwise interception. */
#define CEDUO_RULES(X)                                                                                                         \
    X(RULE_AUTO, "auto")                                                                                                       \
    X(GSTEIGER_STOOLS, "gsteiger-stools") /* Eq. 1 as the paper computed it: A/[(Nc + Ns)(B + mean d)] */                      \
    X(GSTEIGER_STEMS, "gsteiger-stems")   /* Eq. 1 with every stem: A/[sum N(B + d)], the mean free path */                    \
    X(INTERCEPTION, "interception")       /* Eq. 6: A/[(Nc + Ns)B + Nc(mean shoot d + s) + sum N d of trees] */                \
    X(CROFTON, "crofton") /* A/[Nc(B + mean shoot d + P/pi) + sum N(B + d) of trees]: stools met (Cauchy, Crofton) */

enum ceduo_rule {
#define X(NAME, word) CEDUO_##NAME,
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
#define X(NAME, word) CEDUO_SURVEY_##NAME,
    CEDUO_QUALITIES(X)
#undef X
};

/* Survey qualities for the design values; -1: none requested. */
struct ceduo_design_values {
    int survey, blocks;  /* enum ceduo_quality */
    double fence_factor; /* factor of the energy of a fence, >= 1; NaN or 0: not given */
};

/* True if design values are requested. */
static inline bool ceduo_design_is_requested(const struct ceduo_design_values *design)
{
    return design->survey >= 0 && design->blocks >= 0;
}

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

struct ceduo_compliance ceduo_regulation_check(const struct ceduo_regulation *regulation, const struct ceduo_stand *stand);

/* All inputs of a run. */
struct ceduo_scene {
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

/* True if rocks differ in size, mass or shape. */
bool ceduo_scene_rock_varies(const struct ceduo_scene *scene);

/* Set `release` to the mean of several releases, weighted by their shares. Call it after a change of them. */
void ceduo_scene_average_releases(struct ceduo_scene *scene);

/* Return the releases, and their number n: `releases`, or `release` alone. */
const struct ceduo_release *ceduo_scene_releases(const struct ceduo_scene *scene, size_t *n);

/* Return the largest x at which a rock can start (m, relative to the slope's first vertex). */
double ceduo_scene_release_last(const struct ceduo_scene *scene);

/* Return the index of the control farthest along x, or 0 if there is none. */
size_t ceduo_scene_last_control(const struct ceduo_scene *scene);

/* Return the start of the first belt that is not bare (m, relative to the slope's first vertex); infinite if all are bare. */
double ceduo_option_forest_begin(const struct ceduo_option *option);

/* ---- observations of real rocks, and uncertain values ---- */

#define CEDUO_OBSERVED_USES(X)                                                                                                 \
    X(FIT, "fit")                                                                                                              \
    X(CHECK, "check") /* only predicted, to check the fit */

enum ceduo_observed_use {
#define X(NAME, word) CEDUO_OBSERVED_##NAME,
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

#endif
