/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ASSESS_H
#define CEDUO_ASSESS_H

#include "adc.h"
#include "run.h"
#include "scene.h"

enum ceduo_light { CEDUO_UNKNOWN, CEDUO_PASS, CEDUO_FAIL };

#define CEDUO_FREE_RUN_MAX 0.1  /* chance of a free run that a belt may leave */
#define CEDUO_ARRIVE_MIN   1000 /* of so many released one must arrive without forest */

/* One belt of an option, as the index sees it. */
struct ceduo_stand_result {
    double length; /* m */
    double stems_per_ha, stools_per_ha, trees_per_ha, basal_area;
    bool bare;
    bool felled;                 /* of a year: it is what a cut of this year left */
    enum ceduo_rule rule;        /* the one that was applied; without meaning where bare */
    struct ceduo_adc adc;        /* infinite where bare */
    double adc_m;                /* of that rule */
    bool passes_threshold;       /* counting stems from simulation.contact_dbh on */
    double free_run_probability; /* no contact over the threshold: exp(-T/crofton); counting likewise */
    double contacts;             /* L/ADC (Eq. 2) */
    double energy_per_contact;   /* J; NaN where bare */
    double dissipated;           /* J over the belt (Eq. 4) */
    double per_100m;             /* J: of that */
    unsigned warnings;           /* enum ceduo_stand_warning */
    struct ceduo_compliance rules;
    double grouped_per_ha; /* of the trees */
    double stumps_per_ha, logs_per_ha;
};

#define CEDUO_THICK_DBH 0.08 /* m: thinner shoots are met, but hardly stop anything; assumed */

/* What the lights of contact and free run say where stems count from some dbh on. Contact passes where every belt
 * is under the threshold, free run where every belt leaves few of them; neither does where a gap is longer than the threshold. */
struct ceduo_contact_check {
    double worst_adc;      /* m, the largest of the belts; infinite where no belt is, or one without stems that count */
    double worst_free_run; /* the largest of the belts; 1 where no belt is */
    enum ceduo_light contact, free_run;
};

/* The belts between the release and one control, as the index sees them. */
struct ceduo_index {
    double length;      /* wooded metres */
    double longest_gap; /* m without forest, from the release to the control */
    double contacts, meet_nothing_probability;
    double dissipated;                /* J (Eq. 4) */
    double per_100m;                  /* J: of that, over what is wooded; 0 without forest */
    double residual;                  /* Eq. 5: max(0, bare mean - dissipated); NaN if no rock arrives */
    bool exhausted;                   /* it was cut at 0 */
    double measured;                  /* J: half M v2 of the measured speed; NaN without one */
    double worst_adc, worst_free_run; /* as in struct ceduo_contact_check, of stems from simulation.contact_dbh on */
    enum ceduo_light contact, free_run, energy;
    struct ceduo_contact_check thick; /* of stems from CEDUO_THICK_DBH on, or from contact_dbh if that is more */
};

/* Whether the lights of contact and free run would say anything else of the thick stems alone. */
bool ceduo_index_depends_on_thin_stems(const struct ceduo_index *index);

/* Pass if the share of the released that exceeds the accepted energy is at most the limit of the control. Unknown for NULL,
 * without an accepted energy, and if rocks that never came to an end decide it. */
enum ceduo_light ceduo_energy_light(const struct ceduo_arrivals *arrivals);

/* Beyond these a warning asks to check the ground: mean speed (m/s) and 95th percentile of the height (m) at a control. Assumed. */
#define CEDUO_SPEED_USUAL  35.0
#define CEDUO_HEIGHT_USUAL 10.0

/* Whether nothing can be said of a forest: even without it no rock arrives, or fewer than one of CEDUO_ARRIVE_MIN released
 * if at least that many were simulated, or the ground contradicts the terrain (CEDUO_TERRAIN_CONTRADICTS). Unfinished rocks count
 * as arriving. False if no rock was simulated. */
bool ceduo_too_few_arrivals(const struct ceduo_arrivals *bare);

/* Compare the rocks that arrive without forest with the terrain. Rocks usually reach places under a steep reach or shadow angle, and
 * rarely places under a flat one. Evans and Hungr (1993) suggest 27.5 degrees as the smallest shadow angle. The limits are
 * assumed. */
#define CEDUO_REACH_STEEP  35.0 /* degrees */
#define CEDUO_SHADOW_STEEP 32.0
#define CEDUO_SHADOW_FLAT  24.0
#define CEDUO_ARRIVE_FEW   0.01 /* share of the released that is few at a steep place, */
#define CEDUO_ARRIVE_MANY  0.1  /* and many at a flat one */
#define CEDUO_BENCH_LENGTH 10.0 /* m: a bench or ditch of this length may well hold rocks */
enum ceduo_terrain { CEDUO_TERRAIN_AGREES, CEDUO_TERRAIN_CONTRADICTS, CEDUO_TERRAIN_BENCH, CEDUO_TERRAIN_FAR };
/* AGREES: nothing is unusual, or no rock was simulated. CONTRADICTS: few arrive at a steep place. BENCH: likewise, but a bench lies
 * before it. FAR: many arrive at a flat place. */
enum ceduo_terrain ceduo_terrain(const struct ceduo_arrivals *bare);

/* Judge whether the share of the released that exceeds the accepted energy is at most the limit of the control. Uses one energy law
 * and the sampling error alone. `wooded` may be NULL (not simulated). Return CEDUO_UNANSWERED without an accepted energy, or if
 * `wooded` is NULL and the slope without forest does not meet the limit. */
enum ceduo_judgement { CEDUO_UNANSWERED, CEDUO_YES, CEDUO_NO, CEDUO_NOT_DECIDED, CEDUO_DEPENDS, CEDUO_NOTHING };
enum ceduo_judgement ceduo_judge_control(const struct ceduo_arrivals *bare, const struct ceduo_arrivals *wooded);

/* Judge whether a share is at most a limit; CEDUO_NOT_DECIDED if its interval holds the limit. */
enum ceduo_judgement ceduo_judge_share(struct ceduo_estimate share, double limit);

/* A belt by itself. */
struct ceduo_stand_result ceduo_assess_stand(const struct ceduo_scene *scene, const struct ceduo_belt *belt);

/* The belts of `option` between the mean release and the place x. `bare_mean` is the mean energy (J) of the rocks that
 * reach x without forest, NaN where none does. */
struct ceduo_index ceduo_assess_index(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      const struct ceduo_control *control, double bare_mean);

#endif
