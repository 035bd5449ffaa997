/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENE_H
#define CEDUO_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "adc.h"
#include "contact.h"
#include "number.h"
#include "regulation.h"
#include "rock.h"
#include "slope.h"
#include "stand.h"

#define CEDUO_GRAVITY     9.81
#define CEDUO_THRESHOLD_M 30      /* Bozzolo 1987 as cited by Ciabocco et al. 2009 */
#define CEDUO_ROCKS_MOST  1048576 /* in a run, which keeps each: the standard error of a share is at most .0005 */

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
struct ceduo_block_class {
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

/* Everything that a run depends on. */
struct ceduo_scene {
    char *title;
    char *title_it; /* in Italian; NULL: not said */
    struct ceduo_report_head page;
    struct ceduo_rock_def rock;
    size_t blocks_count;              /* classes that do not overlap; 0: every rock is `rock` */
    struct ceduo_block_class *blocks; /* sizes that `rock` has, scaled; figures of one rock, such as the ADC, are of `rock` */
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
 * (may be NULL) is set to the index of the offending control. */
enum ceduo_status ceduo_scene_check(const struct ceduo_scene *scene, size_t *where);

/* Whether rocks differ in size, mass or shape. */
bool ceduo_scene_rock_varies(const struct ceduo_scene *scene);

/* The control farthest along x; 0 where there is none. */
size_t ceduo_scene_last_control(const struct ceduo_scene *scene);

/* Where the first of its belts that are not bare begins (m, relative to the slope's first vertex); infinite: nothing stands. */
double ceduo_option_stems_from(const struct ceduo_option *option);

#endif
