/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ASSESS_H
#define CEDUO_ASSESS_H

#include "adc.h"
#include "run.h"
#include "scene.h"

enum ceduo_light { CEDUO_UNKNOWN, CEDUO_PASS, CEDUO_FAIL };

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
    unsigned warnings;           /* enum ceduo_stand_warning */
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

/* True if the contact or free-run light would differ counting thick stems only. */
bool ceduo_index_depends_on_thin_stems(const struct ceduo_index *index);

/* Return CEDUO_PASS if the share of the released rocks that exceed the accepted energy is at most the limit of the control.
 * Unknown for NULL, without an accepted energy, or if unfinished rocks decide it. */
enum ceduo_light ceduo_energy_light(const struct ceduo_arrivals *arrivals);

/* Limits of the mean speed (m/s) and of the 95th percentile of the height (m) at a control. Above them a page warns.
 * Assumed. */
#define CEDUO_SPEED_USUAL  35.0
#define CEDUO_HEIGHT_USUAL 10.0

/* True if the forest cannot be judged. Either too few rocks arrive even without it: none, or fewer than one in
 * CEDUO_ARRIVE_MIN if at least that many were simulated. Or the ground contradicts the terrain (CEDUO_TERRAIN_CONTRADICTS).
 * Unfinished rocks count as arriving. False if no rock was simulated. */
bool ceduo_too_few_arrivals(const struct ceduo_arrivals *bare);

/* Compare the rocks that arrive without forest with the terrain. Rocks usually reach places under a steep reach or shadow
 * angle, and rarely reach places under a flat one. Evans and Hungr (1993) suggest 27.5 degrees as minimum shadow angle. Limits
 * assumed. */
#define CEDUO_REACH_STEEP  35.0 /* degrees */
#define CEDUO_SHADOW_STEEP 32.0
#define CEDUO_SHADOW_FLAT  24.0
#define CEDUO_ARRIVE_FEW   0.01 /* share of the released below which few arrive at a steep place */
#define CEDUO_ARRIVE_MANY  0.1  /* share above which many arrive at a flat place */
#define CEDUO_BENCH_LENGTH 10.0 /* m: a bench or ditch of this length may hold rocks */
enum ceduo_terrain { CEDUO_TERRAIN_AGREES, CEDUO_TERRAIN_CONTRADICTS, CEDUO_TERRAIN_BENCH, CEDUO_TERRAIN_FAR };
/* AGREES: nothing is unusual, or no rock was simulated. CONTRADICTS: few arrive at a steep place. BENCH: likewise, but a bench
 * lies before it. FAR: many arrive at a flat place. */
enum ceduo_terrain ceduo_terrain(const struct ceduo_arrivals *bare);

/* Judge whether the share of the released that exceeds the accepted energy is at most the limit of the control. Uses one energy
 * law and the sampling error alone. `wooded` may be NULL (not simulated). Return CEDUO_UNANSWERED without an accepted energy,
 * or if `wooded` is NULL and the slope without forest does not meet the limit. */
enum ceduo_judgement { CEDUO_UNANSWERED, CEDUO_YES, CEDUO_NO, CEDUO_NOT_DECIDED, CEDUO_DEPENDS, CEDUO_CANNOT_JUDGE };
enum ceduo_judgement ceduo_judge_control(const struct ceduo_arrivals *bare, const struct ceduo_arrivals *wooded);

/* Judge whether a share is at most a limit; CEDUO_NOT_DECIDED if its interval holds the limit. */
enum ceduo_judgement ceduo_judge_share(struct ceduo_estimate share, double limit);

/* Assess one belt. */
struct ceduo_stand_result ceduo_assess_stand(const struct ceduo_scene *scene, const struct ceduo_belt *belt);

/* Assess the belts of `option` between the mean release and the control. `bare_mean` is the mean energy (J) of the rocks that
 * reach the control without forest; NaN: none does. */
struct ceduo_index ceduo_assess_index(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      const struct ceduo_control *control, double bare_mean);

#endif
