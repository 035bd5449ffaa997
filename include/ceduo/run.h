/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_H
#define CEDUO_RUN_H

#include <stdint.h>

#include "fence.h"
#include "flag.h"
#include "hazard.h"
#include "scene.h"
#include "statistics.h"
#include "trajectory.h"

/* A run: many rocks of one scene, without forest or through the forest of one option. It can be extended and read. */
struct ceduo_run;

#define CEDUO_BATCH_ROCKS 1024 /* rocks per batch */
#define CEDUO_THREADS_MAX 1024

/* Implementation: one rock at a time, or 32 in the lanes of wide registers. All give the same bits. Without such registers
 * rocks are simulated one at a time. */
enum ceduo_kernel { CEDUO_KERNEL_BEST, CEDUO_KERNEL_SCALAR, CEDUO_KERNEL_AVX2, CEDUO_KERNEL_AVX512 };

struct ceduo_run_def {
    const struct ceduo_scene *scene;   /* checked; everything that it points to must outlive the run */
    const struct ceduo_option *option; /* its forest is simulated; must outlive the run; NULL: without forest */
    unsigned threads;                  /* at most CEDUO_THREADS_MAX; 0: one; the results do not depend on it */
    enum ceduo_kernel kernel;          /* the results do not depend on it */
    uint64_t rocks_max;                /* upper limit of ceduo_run_extend(); at most CEDUO_ROCKS_MAX */
    bool arrivals_only;                /* trajectories stop after the last control; their ends are unknown */
    bool alternative_energy;  /* for a pool: simulate each forest also under the other energy law, see alternative_law.h */
    const ceduo_flag *cancel; /* may be NULL; if another thread sets it, the call returns soon */
    void (*progress)(void *context, uint64_t rocks); /* may be NULL; called from time to time, by one worker at a time */
    void *context;
};

/* Return the default: without forest, one thread, the scene's number of rocks. */
struct ceduo_run_def ceduo_run_def_default(const struct ceduo_scene *scene);

/* Create a run without rocks. Return CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or a status of ceduo_scene_check(). */
enum ceduo_status ceduo_run_create(const struct ceduo_run_def *def, struct ceduo_run **run);
void ceduo_run_free(struct ceduo_run *run);

/* Simulate rocks until `rocks` are done. The result does not depend on the number of threads and of steps. On CEDUO_CANCELLED
 * or CEDUO_NO_MEMORY the run keeps the finished rocks, and can be read and extended. */
enum ceduo_status ceduo_run_extend(struct ceduo_run *run, uint64_t rocks);

uint64_t ceduo_run_rocks(const struct ceduo_run *run);
size_t ceduo_run_sample_bytes(const struct ceduo_run *run); /* memory of the values of single rocks */
uint64_t ceduo_run_contacts(const struct ceduo_run *run);   /* ground contacts of all rocks */

/* Stems along all trajectories. */
struct ceduo_stem_counts {
    uint64_t drawn; /* drawn */
    uint64_t hit;   /* stems hit */
    uint64_t met;   /* stools and single trees with a stem hit */
};
struct ceduo_stem_counts ceduo_run_stems(const struct ceduo_run *run);

/* Rocks that arrive at a control. Means and percentiles are over the rocks that reach it. With blocks, counts refer to the
 * simulated rocks; shares, means and percentiles refer to the blocks that come down. */
struct ceduo_arrivals {
    uint64_t released, reached, exceeded, unfinished; /* unfinished: before this control */
    uint64_t ended[CEDUO_ENDS];   /* rocks that did not reach it, by their end; with `reached` they sum to `released` */
    double missed[CEDUO_ENDS];    /* shares of `ended` */
    struct ceduo_estimate reach;  /* share of the released; hi counts the unfinished as reached */
    struct ceduo_estimate exceed; /* likewise, above the accepted energy; NaN if none is given */
    double limit;                 /* of exceed: ceduo_exceed_limit() */
    struct ceduo_distribution speed, energy, translation, height; /* m/s, J, J, m */
    struct ceduo_estimate energy_per_released;                    /* J; no interval */
    struct ceduo_estimate contacts;           /* with stems, of rocks that arrive; no interval; NaN: without forest */
    struct ceduo_hazard hazard;               /* if the scene has blocks */
    const struct ceduo_fence_arrivals *fence; /* owned by struct ceduo_simulated; NULL: neither a fence nor design values */
    struct ceduo_topography topography;       /* of the control */
};

/* Return the maximum share of the released rocks that may exceed the accepted energy: CEDUO_EXCEED_MAX. With blocks it is the
 * share that gives one such rock per accepted return period; above 1 if fewer blocks come down. */
#define CEDUO_EXCEED_MAX 0.05
double ceduo_exceed_limit(const struct ceduo_scene *scene, const struct ceduo_control *control);

/* Return the share by which a control is judged: exceed, or reach without an accepted energy. */
static inline struct ceduo_estimate ceduo_judged_share(const struct ceduo_arrivals *arrivals)
{
    return isnan(arrivals->exceed.mean) ? arrivals->reach : arrivals->exceed;
}

/* Read the arrivals at a control, an index in the scene's order. Return CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. */
enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *arrivals);

/* As ceduo_run_arrivals(). For a run with blocks also fill `curve`, to which the arrivals then point. */
enum ceduo_status ceduo_run_hazard(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *arrivals,
                                   struct ceduo_hazard_curve *curve);

/* Read the rocks at the fence of a control. `scene` may differ from that of the run in its fences and design values. `bare`:
 * arrivals at this control without forest; NULL: the run is without forest. ceduo_fence_none() if the scene has neither a fence
 * there nor design values. Return CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. */
enum ceduo_status ceduo_run_fence(const struct ceduo_run *run, const struct ceduo_scene *scene, size_t control,
                                  const struct ceduo_arrivals *bare, struct ceduo_fence_arrivals *fence);

/* Return the mean energy (J) of the rocks that reach a control, without interval, and set how many do. It is cheap. */
struct ceduo_estimate ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached);

/* Shares and means for `groups` consecutive groups of nearly equal size. Cheap, too. Requires at least `groups` rocks. */
struct ceduo_group_means {
    double reach_probability, exceed_probability; /* of the released; exceed: NaN without an accepted energy */
    double defeated_probability;                  /* share of the released; NaN without a fence */
    double energy;                                /* mean of the rocks that reach, J; NaN if none does */
    double energy_per_released;                   /* J */
};
void ceduo_run_group_means(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_group_means *briefs);

/* Difference of the arrivals of two runs at a control, paired by rock number; over all released rocks. */
struct ceduo_difference {
    struct ceduo_estimate reach, exceed;       /* shares */
    struct ceduo_estimate energy_per_released; /* J */
};

/* Return `run` less `baseline`, two runs of one scene; all NaN if one is NULL. If one is longer, only rocks that both have
 * count. Both simulate the same rocks. The error of the difference is small if the forests are similar. */
struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control);

/* Return the difference of a run to itself: 0 without error. `exceed` is NaN if `accepted` is. */
struct ceduo_difference ceduo_difference_zero(double accepted);

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

/* Read the ends. In a run with arrivals_only all counts are 0 and all places NaN. */
enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends);

/* Values of single rocks, in the order of the rocks. Speed (m/s), height (m) and energy (J) are NaN if a rock does not reach
 * the control. The place of its stop (m) is NaN if it does not stop; the weight is NULL if the scene has no blocks. */
enum ceduo_sample { CEDUO_SAMPLE_SPEED, CEDUO_SAMPLE_HEIGHT, CEDUO_SAMPLE_ENERGY, CEDUO_SAMPLE_STOP, CEDUO_SAMPLE_WEIGHT };

/* Return one value for each rock, or NULL if there is none. It is valid until the run is extended or freed. `control` is not
 * used for stops and weights. */
const double *ceduo_run_samples(const struct ceduo_run *run, size_t control, enum ceduo_sample quantity);

/* Write the energies (J) of the first `max` rocks that reach a control, for a histogram. With blocks an energy is repeated in
 * proportion to its weight. Return the number written. */
size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t max);

#endif
