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
#define CEDUO_ROCKS_MAX   1048576 /* in a run, which keeps each: the standard error of a share is at most .0005 */

/* The laws of an impact on the ground. A new law is a file like src/core/walk/law_crsp.h, named in strike.h, and a line here. */
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

/* How a rock starts. Each number may have a spread. */
struct ceduo_release {
    struct ceduo_number x;      /* m, relative to the slope's first vertex */
    struct ceduo_number height; /* m above the ground, >= 0 */
    struct ceduo_number vx, vz; /* m/s, z upward */
    struct ceduo_number spin;   /* rad/s, positive where it rolls forward in +x */
    bool x_assumed;             /* x is not given: the first vertex */
};

/* A place where the rocks that pass are counted. */
struct ceduo_control {
    double x;              /* m, relative to the slope's first vertex */
    double x_given;        /* as the user wrote it */
    char *name;            /* as it is shown; NULL: none */
    char *name_given;      /* as the user wrote it, where a name in another language is shown */
    double accepted;       /* J that the thing at risk bears; NaN: not said */
    double measured_speed; /* m/s of a real rock seen here; NaN: none */
    /* Years, > 0: with blocks, accepted from one rock with more than `accepted` to the next. NaN or 0: not given; use
     * ceduo_accepted_return(). */
    double accepted_return;
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
    char *name, *name_given;     /* of the stand: as it is shown, and as the user wrote it */
    bool assumed;                /* some value of the stand is an assumption */
    bool changed;                /* numbers of a stand from a file were changed, and no name of its own was given */
    bool felled;                 /* of a year: a cut of this year left this stand */
    double cut_year;             /* a year in which it is cut, as in ceduo_first_cut(); NaN: when it is old enough */
    struct ceduo_stand stand;
};

/* A silvicultural option: belts that rise along x and do not overlap. */
struct ceduo_option {
    char *name, *name_given; /* as it is shown, and as the user wrote it */
    size_t belts_count;
    struct ceduo_belt *belts;
};

/* What becomes of a rock among stems. */
#define CEDUO_CONTACT_MODELS(X)                                                                                                \
    X(INDEX, "index") /* nothing: only Eq. 5 of Ciabocco et al. 2009 is computed */                                            \
    X(STEMS, "stems") /* stools and trees stand at random in the plane; each stem in a rock's path is hit by itself */

enum ceduo_contact_model {
#define X(NAME, word) CEDUO_##NAME,
    CEDUO_CONTACT_MODELS(X)
#undef X
};

/* The forms of the Average Distance between Contacts. AUTO is the rule of Ciabocco et al. 2009: rock smaller than the
 * spacing of the shoots → gsteiger-stems, otherwise interception; without stools gsteiger-stems. */
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
    bool friction_bound; /* friction limits what impacts and rolling lose along the ground; false: the published laws */
};

/* Blocks of some sizes that come down. Number above a volume v goes with v^-exponent, cut at the largest; 0: as many in
 * every range of equal ratio. */
struct ceduo_size_class {
    double per_year;      /* > 0 */
    double exponent;      /* >= 0 */
    size_t volumes_count; /* 2 */
    double *volumes;      /* m3: the smallest and the largest */
};

/* How good a survey is: of the ground, of the blocks. */
#define CEDUO_QUALITIES(X)                                                                                                     \
    X(GOOD, "good")                                                                                                            \
    X(POOR, "poor")

enum ceduo_quality {
#define X(NAME, word) CEDUO_SURVEY_##NAME,
    CEDUO_QUALITIES(X)
#undef X
};

/* What design values are asked for; -1: none. */
struct ceduo_design_values {
    int survey, blocks; /* enum ceduo_quality */
};

/* What an office writes at the head of a report; NULL: not said. */
struct ceduo_report_head {
    char *place, *owner, *parcel, *author, *date, *note;
};

/* Requirements of the forest regulation of a region for a coppice. */
struct ceduo_regulation_item {
    size_t species_count; /* 0: all others */
    char **species;       /* by their names in ceduo_species_list() */
    int system;           /* of this system alone; -1: of any */
    double least, most;   /* standards per ha, or years; NaN: no maximum */
    char *article;        /* and the act that it is of */
    unsigned year;        /* of the act */
};

struct ceduo_regulation {
    char *name;           /* of the region; NULL: there is none */
    char *note, *note_it; /* NULL: none; in Italian, NULL: not said */
    size_t standards_count, turns_count;
    struct ceduo_regulation_item *standards, *turns; /* the first that is about a stand counts */
};

/* How a coppice stands to it. */
struct ceduo_compliance {
    const struct ceduo_regulation *of;                              /* NULL: there is none, or the stand is no coppice */
    const struct ceduo_regulation_item *standards_item, *turn_item; /* NULL: it says nothing of this species */
    double standards;             /* per ha: those that a cut leaves; where the stand does not say, its trees */
    double turn;                  /* years: age of the oldest shoots at a cut; NaN: the stand is never cut */
    bool standards_met, turn_met; /* where there is an item, and a turn */
};

struct ceduo_compliance ceduo_regulation_check(const struct ceduo_regulation *regulation, const struct ceduo_stand *stand);

/* Everything that a run depends on. */
struct ceduo_scene {
    char *title;
    char *title_it; /* in Italian; NULL: not said */
    struct ceduo_report_head page;
    struct ceduo_rock_def rock;
    size_t blocks_count;             /* classes that do not overlap; 0: every rock is `rock` */
    struct ceduo_size_class *blocks; /* sizes that `rock` has, scaled; figures of one rock, such as the ADC, are of `rock` */
    struct ceduo_release release;
    struct ceduo_slope slope;
    size_t controls_count;
    struct ceduo_control *controls; /* in the user's order */
    size_t options_count;           /* >= 1 */
    struct ceduo_option *options;   /* the first is the baseline */
    struct ceduo_simulation simulation;
    struct ceduo_design_values design;
    double rocks_per_year;         /* that come down; NaN: not said */
    double year_first, year_last;  /* of the years to come that are looked at; NaN: one whole rotation of each option */
    double reserves_minimum;       /* single trees per ha that a forest must keep; NaN: not said */
    struct ceduo_regulation rules; /* of the region */
};

/* Whatever has a default has it; there is no slope, control or option yet. */
struct ceduo_scene ceduo_scene_default(void);

/* The same for its parts. What has no default is NaN, 0 or NULL, as its member says; -1 for system and species. */
struct ceduo_option ceduo_option_default(void);
struct ceduo_belt ceduo_belt_default(void);
struct ceduo_stand ceduo_stand_default(void);
struct ceduo_stems ceduo_stems_default(void);
struct ceduo_control ceduo_control_default(void);

/* Checks that the parts fit together: rock, slope, release on it, controls beyond the release and on the slope. `where`
 * (may be NULL) is set to the index of the offending control. CEDUO_BAD_ARGUMENT for NULL. */
enum ceduo_status ceduo_scene_check(const struct ceduo_scene *scene, size_t *where);

/* Whether rocks differ in size, mass or shape. */
bool ceduo_scene_rock_varies(const struct ceduo_scene *scene);

/* The control farthest along x; 0 where there is none. */
size_t ceduo_scene_last_control(const struct ceduo_scene *scene);

/* Where the first of its belts that are not bare begins (m, relative to the slope's first vertex); infinite: nothing stands. */
double ceduo_option_stems_from(const struct ceduo_option *option);

/* ---- what a scene says of real rocks and of uncertain values ---- */

#define CEDUO_OBSERVED_USES(X)                                                                                                 \
    X(FIT, "fit")                                                                                                              \
    X(CHECK, "check") /* only predicted, to see whether the fit holds */

enum ceduo_observed_use {
#define X(NAME, word) CEDUO_OBSERVED_##NAME,
    CEDUO_OBSERVED_USES(X)
#undef X
};

/* Where something is observed, and so which keys it has and which simulated values are compared with it. */
enum ceduo_where {
    CEDUO_WHERE_AT_REST,  /* where a rock came to rest or was stopped */
    CEDUO_WHERE_AT_PLACE, /* on rocks that pass a place */
    CEDUO_WHERE_LARGEST,  /* the largest of each rock on its way */
    CEDUO_WHERE_ALONG,    /* each rock's mean along a stretch, metre by metre, of rocks that enter it */
    CEDUO_WHERE_ON_STEMS  /* where rocks strike stems along a stretch: their centre */
};

/* Quantity that is observed; its row has the unit. Heights are of the underside above the ground, on stems of the centre. */
enum ceduo_quantity {
    CEDUO_QUANTITY_PLACE,
    CEDUO_QUANTITY_COUNT,
    CEDUO_QUANTITY_SPEED,
    CEDUO_QUANTITY_HEIGHT,
    CEDUO_QUANTITY_ENERGY
};

/* The kinds: name, path in a row of the file, the key of a list of values (NULL: it has none), where and what. A new one is a row
 * here, and its keys in scene/fields_observed.c. */
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
    CEDUO_INPUT_FACTOR, /* its value in the scene times a factor, uniform between lo and hi */
    CEDUO_INPUT_NORMAL, /* normal, cut at three standard deviations: lo and hi */
    /* gamma, cut where a normal one would be: of what cannot be below 0 and has an error above a third of it */
    CEDUO_INPUT_GAMMA,
    CEDUO_INPUT_WORDS, /* one of several words, each as likely */
    CEDUO_INPUT_DRAWS  /* one of several rows, each with a value for each place: what a calibration left open */
};

#endif
