/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SIMULATE_H
#define CEDUO_SIMULATE_H

#include <math.h>

#include "scene.h"

/* ---- figures with their sampling error ---- */

/* Count, mean and sum of squares about the mean, added one by one (Welford 1962) and merged (Chan et al. 1979). */
struct ceduo_moments {
    uint64_t n;
    double mean, m2, max;
};

/* A value with its sampling error. */
struct ceduo_estimate {
    double mean;   /* NaN: unknown */
    double se;     /* standard error; NaN: unknown */
    double lo, hi; /* 95 % interval; NaN: unknown */
};
#define CEDUO_NO_ESTIMATE ((struct ceduo_estimate){NAN, NAN, NAN, NAN})

/* Figures of a distribution; NaN if one does not exist. */
struct ceduo_distribution {
    double mean, se, sd, p50, p95, p95_lo, p95_hi, p99, max;
    double p50_lo, p50_hi, p99_lo, p99_hi;
};

/* ---- fences ---- */

/* Rocks at a net fence (struct ceduo_fence): the shares that defeat it, the fence that would be enough, and design values. */

/* Classes of ETAG 027 by the energy (MEL) of the tested kit, J. The last has no upper limit: infinite. */
#define CEDUO_FENCE_CLASSES 9

/* Heights of a planned fence: 2, 3 … 8 m. */
#define CEDUO_FENCE_HEIGHTS 7
#define CEDUO_FENCE_LOWEST  2 /* m */

/* Shares of the released that would defeat a fence, by its height and class. */
struct ceduo_fence_grid {
    struct ceduo_estimate defeated[CEDUO_FENCE_HEIGHTS][CEDUO_FENCE_CLASSES];
    double energy[CEDUO_FENCE_HEIGHTS]; /* J: largest energy of a rock that does not pass above; 0: none */
};

/* The smallest class of a height that is enough. */
struct ceduo_fence_choice {
    unsigned height; /* m */
    int class_index; /* CEDUO_FENCE_CLASSES: no class is enough */
    double energy;   /* J: energy of the class, or for the last class the largest energy of a rock; NaN: no class is enough */
    double defeated; /* share of the released rocks; for the last class if no class is enough */
    bool decided;    /* the sampling error does not change the class */
};

/* 95th percentiles; 0 if fewer rocks arrive. */
struct ceduo_fence_load {
    double speed, energy; /* m/s; J, of translation */
    double top, middle;   /* m, perpendicular to the ground */
};

/* Rocks at a fence. Shares are of the released. */
struct ceduo_fence_arrivals {
    struct ceduo_estimate above, through, both, defeated; /* NaN: no fence, and all members but the loads are invalid */
    struct ceduo_estimate worn;           /* held with more than a third of its energy: the service energy level (SEL) */
    double by_class[CEDUO_FENCE_CLASSES]; /* defeated fences of this height */
    struct ceduo_fence_grid grid;
    struct ceduo_fence_choice enough[CEDUO_FENCE_HEIGHTS];
    double per_year, in_life; /* rocks that defeat the fence: per year; probability in its life; NaN: no blocks */
    /* `arriving`: rocks that arrive. `system`: rocks that arrive without forest; a rock that the forest stops counts as 0. NaN:
     * design values are not requested, or no rock arrives. */
    struct ceduo_fence_load arriving, system;
};

/* ---- distance between contacts ---- */

/* Distance between contacts in each form, m, over stems from stand->counted_from on; infinite without such stems. A stool
 * counts with its counted shoots. */
struct ceduo_adc {
    double gsteiger_stools, gsteiger_stems, interception, crofton;
};

/* Warnings about a stand and a rock, as a bit set. */
enum ceduo_warning {
    CEDUO_WARNING_BELOW_FREE_PATH = 1 << 0, /* interception < gsteiger-stems: s > (n - 1)(B + d), impossible for any path */
    CEDUO_WARNING_NEAR_JUMP = 1 << 1,       /* B within 10 % of s, at which rule auto jumps */
    CEDUO_WARNING_DORREN_THIN = 1 << 2,     /* dorren below 10 cm: outside its data */
    CEDUO_WARNING_FORM_FACTOR = 1 << 3,     /* a volume by form factor, outside the species' equation */
    CEDUO_WARNING_RATIO_ASSUMED = 1 << 5,   /* fracture ratio 1 assumed for a species without one */
    CEDUO_WARNING_U_ASSUMED = 1 << 4,       /* U of beech assumed for another species */
    CEDUO_WARNING_WIDE_SPACING = 1 << 6,    /* s > B + d: the rock can pass between two shoots; crofton is not exact */
    CEDUO_WARNING_LOW = 1 << 7,             /* stumps or logs: contacts, but no stems that count */
    CEDUO_WARNING_BASAL_AREA = 1 << 8,      /* implausible, probably a typing error: above CEDUO_BASAL_AREA_MAX */
    CEDUO_WARNING_MANY_SHOOTS = 1 << 9,     /* likewise, above CEDUO_SHOOTS_MAX */
    CEDUO_WARNING_SLENDER = 1 << 10,        /* likewise, above CEDUO_SLENDERNESS_MAX */
    CEDUO_WARNING_STOUT = 1 << 11,          /* likewise, below CEDUO_SLENDERNESS_MIN */
    CEDUO_WARNING_THICK = 1 << 12,          /* thicker than any stem measured for the volume equation of its species */
    CEDUO_WARNING_IMPLAUSIBLE = 31 << 8     /* any of the last five */
};

/* Limits beyond which a stand is implausible (assumed). */
#define CEDUO_BASAL_AREA_MAX  60  /* m2/ha */
#define CEDUO_SHOOTS_MAX      15  /* per stool, all cohorts together */
#define CEDUO_SLENDERNESS_MAX 150 /* height over dbh */
#define CEDUO_SLENDERNESS_MIN 25

/* ---- hazard ---- */

/* Annual frequency and energy of rocks at a control, for scenes with `blocks`. Energies in J, rates per year, with 95 %
 * intervals. */

/* Energy that is reached or exceeded once in `years`; NaN if the sample does not reach this return period. */
struct ceduo_return {
    unsigned years;
    struct ceduo_estimate energy; /* se: NaN */
};

/* Classes of intensity and of return period in Swiss practice: limits 30 and 300 kJ (BAFU 2016); 30, 100 and 300 years. */
#define CEDUO_INTENSITIES 3
#define CEDUO_RETURNS     4 /* and 10 years */

struct ceduo_intensity {
    const char *word;              /* weak, medium, strong */
    double from, to;               /* J; `to` of the last is infinite */
    struct ceduo_estimate rate;    /* rocks of this intensity per year */
    double remaining_share;        /* share of the rate without forest; NaN: no such rocks without forest */
    bool of_return[CEDUO_RETURNS]; /* true if the energy of the return period has this intensity */
};

/* Energies of the curve of rates: ten per decade, 0.1 kJ to 10^6 kJ. */
#define CEDUO_HAZARD_ENERGIES 71

/* Rocks that arrive with more than an energy. */
struct ceduo_hazard_point {
    double energy;
    struct ceduo_estimate rate;
};

/* Exceedance rates, up to the first energy that no rock exceeds. */
struct ceduo_hazard_curve {
    size_t count;
    struct ceduo_hazard_point points[CEDUO_HAZARD_ENERGIES];
};

struct ceduo_hazard {
    double per_year;  /* blocks that come down per year; NaN: not given, and all other members are invalid */
    double effective; /* effective sample size (Kish): (sum w)^2/sum w^2 */
    const struct ceduo_hazard_curve *curve; /* owned by struct ceduo_simulated; NULL: not read */
    struct ceduo_return returns[CEDUO_RETURNS];
    struct ceduo_estimate reach;    /* rocks that arrive */
    struct ceduo_estimate accepted; /* rocks that arrive with more than the accepted energy; NaN: none is given */
    double accepted_return;         /* years: accepted return period of the control */
    double
        remaining_share; /* `accepted`, or `reach` if that is NaN, over its value without forest; NaN: that is 0 or unknown */
    struct ceduo_intensity intensity[CEDUO_INTENSITIES];
};

/* ---- single rocks ---- */

/* End of a trajectory. */
enum ceduo_end { CEDUO_END_AT_REST, CEDUO_END_LEFT_SLOPE, CEDUO_END_UNFINISHED, CEDUO_END_STOPPED_BY_STEMS, CEDUO_ENDS };

/* A rock with more ground contacts or more drawn stems counts as unfinished. */
#define CEDUO_CONTACTS_MAX 1000000
#define CEDUO_STEMS_MAX    1000000

/* A segment of a trajectory from (x, z) to (x1, z1). In flight it is a parabola that starts with (vx, vz). In a roll it is a
 * straight line along the ground, with speeds (vx, vz) at its start and (vx1, vz1) at its end. */
struct ceduo_trajectory_segment {
    bool rolls;
    double x, z, vx, vz;
    double x1, z1, vx1, vz1;
    double spin;       /* rad/s; constant in flight, at the start in a roll */
    double seconds;    /* of a flight; 0 in a roll */
    uint64_t contacts; /* ground contacts before it */
};

/* A stem that a rock reached. Coordinates relative to the slope's first vertex. */
struct ceduo_stem_encounter {
    double x, y;          /* m: place along the trajectory, lateral offset; y NaN: a log */
    double dbh, height;   /* m; dbh NaN: a log */
    bool shoot;           /* shoot of a stool; false: single tree */
    uint64_t stool;       /* number of the stool, equal for all its shoots */
    bool hit;             /* false: the rock flew over it */
    double clearance;     /* m: clearance of the rock's underside above the ground */
    double before, taken; /* J: energy of the rock before the hit, and energy taken by the stem; 0 if not hit */
};

/* Callbacks for a trajectory; any may be NULL. */
struct ceduo_trajectory_callbacks {
    bool (*is_cancelled)(void *context); /* called every few milliseconds; true cancels: CEDUO_CANCELLED */
    void (*segment)(void *context, const struct ceduo_trajectory_segment *segment); /* each segment, in order */
    void (*stem)(void *context, const struct ceduo_stem_encounter *stem); /* each stem, after the segment that leads to it */
    void *context;
};

/* State of a rock as it passes a control. Coordinates relative to the slope's first vertex. */
struct ceduo_crossing {
    bool reached;
    double vx, vz, spin; /* m/s, rad/s; on arrival */
    double height;       /* m, clearance of the underside above the ground */
    uint64_t stems_hit;  /* before it */
};

struct ceduo_trajectory {
    struct ceduo_rock rock;
    double x0, z0, vx0, vz0, spin0; /* as released */
    enum ceduo_end end;
    double x, z;       /* end point */
    uint64_t contacts; /* with the ground */
    uint64_t stems_hit;
    uint64_t stools_met; /* stools and single trees with a stem hit */
    uint64_t stems_drawn;
};

/* Simulate rock number `rock` of a scene through the forest of `option` (NULL: without forest), as a run does. `callbacks` may
 * be NULL. `crossings` (may be NULL) has one entry per control, in their order. Requires a scene that has passed
 * ceduo_scene_check(). Return CEDUO_OK, CEDUO_NO_MEMORY, CEDUO_CANCELLED (`trajectory` ends early) or CEDUO_BAD_ROCK. */
enum ceduo_status ceduo_trajectory_run(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rock,
                                       const struct ceduo_trajectory_callbacks *callbacks, struct ceduo_trajectory *trajectory,
                                       struct ceduo_crossing *crossings);

/* Simulates many rocks, one at a time, of a scene that is prepared once. */
struct ceduo_tracer;

/* Prepare a scene with the forest of `option` (NULL: without forest); both must outlive the tracer, which the caller frees.
 * Requires a scene that has passed ceduo_scene_check(). Return NULL without memory, or for a rock without a size. */
struct ceduo_tracer *ceduo_tracer_create(const struct ceduo_scene *scene, const struct ceduo_option *option);

/* Simulate a rock, as ceduo_trajectory_run(). One thread at a time may use a tracer. */
enum ceduo_status ceduo_tracer_run(struct ceduo_tracer *tracer, uint64_t rock,
                                   const struct ceduo_trajectory_callbacks *callbacks, struct ceduo_trajectory *trajectory,
                                   struct ceduo_crossing *crossings);

/* Free a tracer. `tracer` may be NULL. */
void ceduo_tracer_free(struct ceduo_tracer *tracer);

/* ---- runs ---- */

/* A run: many rocks of one scene, without forest or through the forest of one option. It can be extended and read. */
struct ceduo_run;

#define CEDUO_BATCH_ROCKS 1024 /* rocks per batch */
#define CEDUO_THREADS_MAX 1024

/* Implementation: one rock at a time, or 32 in the lanes of wide registers. All give the same bits. Without such registers
 * rocks are simulated one at a time. */
enum ceduo_kernel { CEDUO_KERNEL_BEST, CEDUO_KERNEL_SCALAR, CEDUO_KERNEL_AVX2, CEDUO_KERNEL_AVX512 };

struct ceduo_run_def {
    const struct ceduo_scene *scene;                 /* checked; everything that it points to must outlive the run */
    const struct ceduo_option *option;               /* its forest is simulated; must outlive the run; NULL: without forest */
    unsigned threads;                                /* at most CEDUO_THREADS_MAX; 0: one; the results do not depend on it */
    enum ceduo_kernel kernel;                        /* the results do not depend on it */
    uint64_t rocks_max;                              /* upper limit of the rocks; at most CEDUO_ROCKS_MAX */
    bool arrivals_only;                              /* trajectories stop after the last control; their ends are unknown */
    bool alternative_energy;                         /* for a pool: simulate each forest also under the other energy law */
    const ceduo_flag *cancel;                        /* may be NULL; if another thread sets it, the call returns soon */
    void (*progress)(void *context, uint64_t rocks); /* may be NULL; called from time to time, by one worker at a time */
    void *context;
};

/* Return the number of simulated rocks. */
uint64_t ceduo_run_rocks(const struct ceduo_run *run);

/* Stems along all trajectories. */
struct ceduo_stem_counts {
    uint64_t drawn; /* drawn */
    uint64_t hit;   /* stems hit */
    uint64_t met;   /* stools and single trees with a stem hit */
};

/* Rocks that arrive at a control. Means and percentiles are over the rocks that reach it. With blocks, counts refer to the
 * simulated rocks; shares, means and percentiles refer to the blocks that come down. */
struct ceduo_arrivals {
    uint64_t released, reached, exceeded, unfinished; /* unfinished: before this control */
    uint64_t ended[CEDUO_ENDS];   /* rocks that did not reach it, by their end; with `reached` they sum to `released` */
    double missed[CEDUO_ENDS];    /* shares of `ended` */
    struct ceduo_estimate reach;  /* share of the released; hi counts the unfinished as reached */
    struct ceduo_estimate exceed; /* likewise, above the accepted energy; NaN if none is given */
    double limit; /* of exceed: CEDUO_EXCEED_MAX, or with blocks the share that gives one such rock per return period */
    struct ceduo_distribution speed, energy, translation, height; /* m/s, J, J, m */
    struct ceduo_estimate energy_per_released;                    /* J; no interval */
    struct ceduo_estimate contacts;           /* with stems, of rocks that arrive; no interval; NaN: without forest */
    struct ceduo_hazard hazard;               /* if the scene has blocks */
    const struct ceduo_fence_arrivals *fence; /* owned by struct ceduo_simulated; NULL: neither a fence nor design values */
    struct ceduo_topography topography;       /* of the control */
};

#define CEDUO_EXCEED_MAX 0.05 /* maximum share of the released rocks that may exceed the accepted energy */

/* Difference of the arrivals of two runs at a control, paired by rock number; over all released rocks. */
struct ceduo_difference {
    struct ceduo_estimate reach, exceed;       /* shares */
    struct ceduo_estimate energy_per_released; /* J */
};

#define CEDUO_EARLY_M 10.0

/* Ends of the trajectories, and places of the rocks that came to rest or were stopped by stems. */
struct ceduo_ends {
    uint64_t count[CEDUO_ENDS];
    double share[CEDUO_ENDS]; /* of all released */
    uint64_t uphill;          /* rocks that left the slope over its upper end */
    /* rocks stopped by stems within CEDUO_EARLY_M of the mean release, while still slow */
    uint64_t early;
    struct ceduo_moments stop_x;
    double stop_p50, stop_p95, stop_max; /* m, relative; NaN if none stopped */
};

/* Values of single rocks, in the order of the rocks. Speed (m/s), height (m) and energy (J) are NaN if a rock does not reach
 * the control. The place of its stop (m) is NaN if it does not stop; the weight is NULL if the scene has no blocks. */
enum ceduo_sample { CEDUO_SAMPLE_SPEED, CEDUO_SAMPLE_HEIGHT, CEDUO_SAMPLE_ENERGY, CEDUO_SAMPLE_STOP, CEDUO_SAMPLE_WEIGHT };

/* Return one value for each rock; NULL: no such value, or no such control. The values are valid until the run is extended or
 * freed. `control` is not used for stops and weights. */
const double *ceduo_run_samples(const struct ceduo_run *run, size_t control, enum ceduo_sample quantity);

/* ---- assessment ---- */

enum ceduo_light { CEDUO_LIGHT_UNKNOWN, CEDUO_LIGHT_PASS, CEDUO_LIGHT_FAIL };

#define CEDUO_FREE_RUN_MAX 0.1  /* maximum probability of a free run through a belt */
#define CEDUO_ARRIVE_MIN   1000 /* one in this many rocks must arrive without forest; otherwise the forest is not judged */

/* Index of one belt of an option. */
struct ceduo_stand_result {
    double length; /* m */
    double stems_per_ha, stools_per_ha, trees_per_ha, basal_area;
    bool bare;
    bool felled;                 /* in a year of ceduo_years: left by a cut in this year */
    enum ceduo_rule rule;        /* applied rule; not valid if bare */
    struct ceduo_adc adc;        /* infinite if bare */
    double adc_m;                /* m, by `rule` */
    bool passes_threshold;       /* counting stems from simulation.contact_dbh on */
    double free_run_probability; /* probability of no contact over the threshold: exp(-T/crofton), for the same stems */
    double contacts;             /* L/ADC (Eq. 2) */
    double energy_per_contact;   /* J; NaN if bare */
    double dissipated;           /* J over the belt (Eq. 4) */
    double per_100m;             /* J dissipated per 100 m */
    unsigned warnings;           /* enum ceduo_warning */
    struct ceduo_compliance rules;
    double grouped_per_ha; /* trees in groups */
    double stumps_per_ha, logs_per_ha;
};

#define CEDUO_THICK_DBH 0.08 /* m: rocks meet thinner shoots, which hardly stop any; assumed */

/* Lights of contact and free run, counting stems from a minimum dbh on. Contact passes if the ADC of each belt is below the
 * threshold, free run if each belt leaves few free runs. Both fail if a gap is longer than the threshold. */
struct ceduo_contact_check {
    double worst_adc;      /* m, maximum over the belts; infinite without a belt, or if a belt has no counted stems */
    double worst_free_run; /* maximum over the belts; 1 without a belt */
    enum ceduo_light contact, free_run;
};

/* Index of the belts between the release and one control. */
struct ceduo_index {
    double length;      /* wooded metres */
    double longest_gap; /* m without forest, from the release to the control */
    double contacts, meet_nothing_probability;
    double dissipated;                /* J (Eq. 4) */
    double per_100m;                  /* J dissipated per 100 wooded metres; 0 without forest */
    double residual;                  /* Eq. 5: max(0, bare mean - dissipated); NaN if no rock arrives */
    bool exhausted;                   /* residual was clamped to 0 */
    double measured;                  /* J: M v2/2 of the measured speed; NaN if none was measured */
    double worst_adc, worst_free_run; /* as in struct ceduo_contact_check, for stems from simulation.contact_dbh on */
    enum ceduo_light contact, free_run, energy;
    struct ceduo_contact_check thick; /* for stems from CEDUO_THICK_DBH on, or from contact_dbh if that is larger */
};

/* Answer of a control. DEPENDS: the two energy laws contradict. CANNOT_JUDGE: too few rocks arrive even without forest. */
enum ceduo_judgement {
    CEDUO_JUDGEMENT_UNANSWERED,
    CEDUO_JUDGEMENT_YES,
    CEDUO_JUDGEMENT_NO,
    CEDUO_JUDGEMENT_NOT_DECIDED,
    CEDUO_JUDGEMENT_DEPENDS,
    CEDUO_JUDGEMENT_CANNOT_JUDGE
};

/* Judge whether the share of the released that exceeds the accepted energy is at most the limit of the control. Uses one energy
 * law and the sampling error alone. `wooded` may be NULL (not simulated). Return CEDUO_JUDGEMENT_UNANSWERED without an accepted
 * energy, or if `wooded` is NULL and the slope without forest does not meet the limit. */
enum ceduo_judgement ceduo_judge_control(const struct ceduo_arrivals *bare, const struct ceduo_arrivals *wooded);

/* ---- pool of runs ---- */

/* The runs of a scene: one without forest and one for each forest, each simulated once and then reused. All use equal rocks
 * with equal random numbers, so that their differences are caused by the forests. */
struct ceduo_pool;

/* Free a pool with all its runs. `pool` may be NULL. */
void ceduo_pool_free(struct ceduo_pool *pool);

/* Return the run through the forest of `option` (NULL: without forest), or NULL if the pool has none. The pool owns it. */
struct ceduo_run *ceduo_pool_find(const struct ceduo_pool *pool, const struct ceduo_option *option);

/* Work of all runs up to now. */
struct ceduo_work {
    uint64_t rocks, contacts; /* rocks simulated, contacts with the ground; all runs */
    struct ceduo_stem_counts stems;
    uint64_t runs, reused; /* runs created; requests served by an existing run */
};

/* ---- other sizes of the rock ---- */

/* A scene with blocks of other sizes. A forest that stops small blocks need not stop large ones. */
struct ceduo_size_result {
    double volume;                  /* m3 */
    double mass, diameter;          /* kg, m: of the mean rock */
    double adc;                     /* m, by the scene's rule: worst belt before the control; infinite without a belt */
    double contacts;                /* with stems up to the control, by the same rule (Eq. 2 of Ciabocco et al. 2009) */
    struct ceduo_arrivals arrivals; /* through the forest; released == 0: not simulated, or skipped as too expensive */
    bool own;                       /* the scene's own block */
};

/* Number of sizes: 0.05, 0.2, 1, 5 m3, and the scene's own. They are the limits of the rock classes of the Swiss guideline NaiS
 * (Frehner et al. 2005), with 1 m3 added. */
#define CEDUO_SIZES 5

/* ---- the other energy law ---- */

/* Few rocks show the effect of the other law: the first ones of the scene, in whole batches. */
#define CEDUO_ALT_LAW_ROCKS ((uint64_t)10 * CEDUO_BATCH_ROCKS)

/* Results of an option at one control under the other law. */
struct ceduo_alternative_energy {
    bool known;
    bool stems; /* the option has stems; otherwise no law has an effect */
    enum ceduo_energy_model model;
    struct ceduo_arrivals arrivals;   /* valid if known; of at most CEDUO_ALT_LAW_ROCKS rocks */
    enum ceduo_judgement judgement;   /* of the control by this law; CEDUO_JUDGEMENT_DEPENDS: the two laws contradict */
    struct ceduo_difference to_first; /* to the first option under its other law; NaN: unknown */
};

/* ---- results ---- */

/* Results of a run, one entry per control. */
struct ceduo_simulated {
    uint64_t rocks; /* 0: no result */
    size_t controls;
    struct ceduo_arrivals *arrivals;
    struct ceduo_hazard_curve *curves;   /* `curve` of the arrivals points here; NULL without blocks */
    struct ceduo_fence_arrivals *fences; /* likewise `fence`; NULL without fences and design values */
    struct ceduo_ends ends;
};

/* Results of one option. */
struct ceduo_option_result {
    struct ceduo_stand_result *stands;             /* one per belt */
    struct ceduo_index *controls;                  /* one per control, in the scene's order */
    struct ceduo_simulated wooded;                 /* through its forest; with the contact model index: without forest */
    struct ceduo_difference *differences;          /* of `wooded` to the first option; all NaN if unknown */
    struct ceduo_alternative_energy *alternatives; /* one per control: the same rocks under the other energy law */
};

/* All results of a scene. */
struct ceduo_result {
    const struct ceduo_scene *scene;
    struct ceduo_rock rock;      /* of the means */
    bool wooded;                 /* rocks were simulated through the forests; false: contact model index */
    struct ceduo_simulated bare; /* without forest, the same for all options */
    size_t last_control;         /* the one farthest along x */
    size_t options_count;
    struct ceduo_option_result *options;
};

/* Return the arrivals at a control through the forest of an option. NULL: contact model index, not simulated, or no such option
 * or control. */
const struct ceduo_arrivals *ceduo_result_wooded(const struct ceduo_result *result, size_t option, size_t control);

/* Return the index of an option at the last control; NULL: no such option, or no control. */
const struct ceduo_index *ceduo_result_last_index(const struct ceduo_result *result, size_t option);

/* ---- request ---- */

#define CEDUO_YEAR_MAX 100000 /* the last year of a window */

/* Origin of a window of years. */
enum ceduo_window_kind {
    CEDUO_WINDOW_GIVEN,    /* requested by the caller or the scene */
    CEDUO_WINDOW_AHEAD,    /* the next years from today, the same for all options */
    CEDUO_WINDOW_ROTATION, /* one whole rotation, after all belts with cuts have been cut once */
    CEDUO_WINDOW_CONSTANT  /* no growth and no cuts: year 0, today, represents all years */
};

/* The years first, first + step … last; step >= 1. */
struct ceduo_window {
    enum ceduo_window_kind kind;
    unsigned first, last, step;
};

#define CEDUO_YEARS_MAX       1000 /* per window */
#define CEDUO_YEARS_AHEAD_MIN 20   /* minimum years of CEDUO_WINDOW_AHEAD */
#define CEDUO_AHEAD_MAX       60   /* maximum */
#define CEDUO_PERIOD_MAX      120  /* years; if the common period of several rotations is longer, the longest rotation counts */

struct ceduo_years;

/* The only interface for runs: simulate a scene and read its results.
 *
 *     struct ceduo_request request = ceduo_request_default(&scene);
 *     struct ceduo_results results;
 *     request.rocks = request.run.rocks_max = 10000;
 *     if (ceduo_simulate_request(&request, NULL, &results) == CEDUO_OK)
 *         printf("%g\n", results.result->options[0].wooded.arrivals[0].reach.mean);
 *     ceduo_results_release(&results); */
struct ceduo_request {
    size_t size;              /* sizeof this struct, set by the default; another value: CEDUO_BAD_ARGUMENT */
    struct ceduo_run_def run; /* the scene, and how its rocks are simulated; its option is ignored */
    uint64_t rocks;           /* per run, at most CEDUO_ROCKS_MAX; 0: only stands and index are computed */
    double tolerance;         /* > 0: stop as soon as mean energies reach this relative precision */
    /* Simulate this option only: through its forest, with contact model index without forest. Results of all other runs are
     * unknown. CEDUO_ALL_OPTIONS: without forest and through each. */
    size_t only;
    bool years;                 /* also each option year by year */
    struct ceduo_window window; /* the years; step 0: ceduo_scene_window() */
    bool rotations;             /* also the whole rotation of each option: ceduo_window_compute() */
    uint64_t year_rocks;        /* rocks per year, at most `rocks`; 0: `rocks` */
    bool years_independent;     /* each year has rocks of its own, so that few suffice for the mean; not with blocks */
    unsigned years_max;         /* > 0: at most this many years, evenly spread */
    uint64_t block_rocks; /* > 0: at most n blocks of each other size, to the last control, for at most the work of the runs */
};
#define CEDUO_ALL_OPTIONS SIZE_MAX

/* Return the default: all options, the scene's number of rocks, no years, no other sizes. */
struct ceduo_request ceduo_request_default(const struct ceduo_scene *scene);

struct ceduo_results {
    struct ceduo_result *result;
    bool tolerance_met;
    size_t years_count;               /* options */
    struct ceduo_years **years;       /* one per option, NULL if excluded by `only`; NULL: not requested */
    struct ceduo_years **rotations;   /* likewise */
    struct ceduo_size_result *blocks; /* CEDUO_SIZES per option; NULL: not requested, or the rock has no other sizes */
    struct ceduo_work work;           /* of all runs of the pool; without blocks and years_independent */
};

/* Simulate and read a scene. `pool` (may be NULL) keeps the runs between calls if only the forests differ; otherwise it is
 * recreated. *pool is NULL at first; caller frees it. Everything that the scene points to must outlive results and pool. Return
 * CEDUO_CANCELLED, CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT (no such option, too many rocks or threads, an invalid window, a scene
 * without options) or a status of ceduo_scene_check(). The results are empty then. Caller releases them in any case. */
enum ceduo_status ceduo_simulate_request(const struct ceduo_request *request, struct ceduo_pool **pool,
                                         struct ceduo_results *results);

/* Release the results. A second call has no effect. */
void ceduo_results_release(struct ceduo_results *results);

/* ---- records of single rocks ---- */

/* Statistics of whole trajectories, for comparison with observed rocks. The rocks are those of a run, simulated one by one,
 * which takes several times as long. */

struct ceduo_stretch {
    double from, to; /* m, relative */
};

/* Means along a stretch, over the horizontal metres that a rock covers in it. */
struct ceduo_stretch_means {
    double length;                /* m covered, >= 0; 0: the rock did not enter, and the means are NaN */
    double speed, height, energy; /* m/s; clearance of the underside, m; J */
};

struct ceduo_stem_impact {
    uint64_t rock;
    double x;      /* m, relative */
    double height; /* m: of the rock's centre above the ground */
};

struct ceduo_record_def {
    size_t size;                       /* sizeof this struct, set by the default; another value: CEDUO_BAD_ARGUMENT */
    const struct ceduo_scene *scene;   /* checked */
    const struct ceduo_option *option; /* NULL: without forest */
    uint64_t rocks;
    size_t stretches_count;
    const struct ceduo_stretch *stretches;
    bool blows;               /* record impacts on stems */
    const ceduo_flag *cancel; /* may be NULL */
};

/* Return the default: without forest, the scene's number of rocks, no stretches, no blows. */
struct ceduo_record_def ceduo_record_def_default(const struct ceduo_scene *scene);

struct ceduo_rock_record {
    double mass, moment;
    double stop_x;                        /* m, relative; NaN: did not stop on the slope */
    double largest_speed, largest_height; /* m/s; clearance of the underside, m; maxima from the release on */
};

struct ceduo_record {
    uint64_t rocks_count;
    struct ceduo_rock_record *rocks;
    struct ceduo_crossing *crossings;  /* [rock][control] */
    struct ceduo_stretch_means *means; /* [rock][stretch] */
    size_t blows_count;
    struct ceduo_stem_impact *blows; /* sorted by rock */
};

/* Simulate and record. Return CEDUO_OK, or CEDUO_NO_MEMORY, CEDUO_CANCELLED, CEDUO_BAD_ARGUMENT or a status of
 * ceduo_scene_check(). The caller releases *record in any case. */
enum ceduo_status ceduo_record(const struct ceduo_record_def *def, struct ceduo_record *record);

/* Release a record. A second call has no effect. */
void ceduo_record_release(struct ceduo_record *record);

#endif
