/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUN_H
#define CEDUO_RUN_H

#include <stdint.h>

#include "flag.h"
#include "hazard.h"
#include "scene.h"
#include "statistics.h"
#include "trajectory.h"

/* A run: many rocks of one scene over its slope, without forest or through that of one option. It can be made longer,
 * and read at any time between. */
struct ceduo_run;

#define CEDUO_BATCH_ROCKS 1024 /* rocks summed as one */
#define CEDUO_THREADS_MAX 1024

/* How rocks are simulated: one by one, or 32 at once in the lanes of wide registers. All give the same bits.
 * Where the machine lacks such registers, rocks are simulated one by one. */
enum ceduo_kernel { CEDUO_KERNEL_BEST, CEDUO_KERNEL_SCALAR, CEDUO_KERNEL_AVX2, CEDUO_KERNEL_AVX512 };

struct ceduo_run_def {
    const struct ceduo_scene *scene;   /* checked; what it points to must outlive the run */
    const struct ceduo_option *option; /* whose forest the rocks go through; NULL: none. It must outlive the run */
    unsigned threads;                  /* at most CEDUO_THREADS_MAX; 0: one; the results do not depend on it */
    enum ceduo_kernel kernel;          /* nor on this */
    uint64_t rocks_most;               /* no longer than this will it be made; at most CEDUO_ROCKS_MAX */
    bool arrivals_only;                /* trajectories stop behind the last control: their ends are not known */
    bool other_energy;                 /* of a pool: each forest under the other energy law as well, see other.h */
    const ceduo_flag *cancel;          /* may be NULL; raised by another thread: the call returns soon */
    void (*progress)(void *context, uint64_t rocks); /* may be NULL; called now and then by a worker, one at a time */
    void *context;
};

/* No forest, one thread, the scene's rocks. */
struct ceduo_run_def ceduo_run_def_default(const struct ceduo_scene *scene);

/* A run without rocks yet. CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or what ceduo_scene_check() says. */
enum ceduo_status ceduo_run_create(const struct ceduo_run_def *def, struct ceduo_run **run);
void ceduo_run_free(struct ceduo_run *run);

/* Simulates rocks until `rocks` are done. The result is the same for any number of threads and of steps.
 * CEDUO_CANCELLED, CEDUO_NO_MEMORY: the run holds the rocks that were finished before; it can be read and extended. */
enum ceduo_status ceduo_run_extend(struct ceduo_run *run, uint64_t rocks);

uint64_t ceduo_run_rocks(const struct ceduo_run *run);
size_t ceduo_run_sample_bytes(const struct ceduo_run *run); /* taken by what is kept of single rocks */
uint64_t ceduo_run_contacts(const struct ceduo_run *run);   /* ground contacts of all rocks */

/* Stems along all trajectories. */
struct ceduo_stem_counts {
    uint64_t drawn; /* along the trajectories */
    uint64_t hit;   /* stems */
    uint64_t met;   /* stools and single trees of which a stem was hit */
};
struct ceduo_stem_counts ceduo_run_stems(const struct ceduo_run *run);

/* What arrives at a control. Means and percentiles are over the rocks that reached it. Where the scene has blocks, counts are
 * of the rocks that were drawn; shares, means and percentiles are of the blocks that come down. */
struct ceduo_arrivals {
    uint64_t released, reached, exceeded, unfinished; /* unfinished: before this control */
    uint64_t ended[CEDUO_ENDS];                       /* that did not reach it, by how they ended: with those that
                                                       * reached it, all released */
    double missed[CEDUO_ENDS];                        /* shares of the same */
    struct ceduo_estimate reach;                      /* share of the released; hi counts the unfinished as reached */
    struct ceduo_estimate exceed;                     /* likewise, with more than is accepted; NaN if that is not given */
    double limit;                                     /* of exceed: ceduo_exceed_limit() */
    struct ceduo_distribution speed, energy, translation, height; /* m/s, J, J, m */
    struct ceduo_estimate energy_per_released;                    /* J; no interval */
    double top_p95; /* m: 95th percentile of the height of the rocks' tops above the ground, their underside's and their mean
                     * diameter; NaN where the scene asks for no design values, or no rock arrives */
    struct ceduo_estimate contacts;     /* with stems, of rocks that reach; no interval; NaN: bare run */
    struct ceduo_hazard hazard;         /* where the scene has blocks */
    struct ceduo_topography topography; /* of the control */
};

/* Return the share of the released rocks that may arrive with more than the accepted energy: CEDUO_EXCEED_MAX. With blocks it is
 * the share that makes one such rock in the accepted return period; above 1 if fewer blocks come down. */
#define CEDUO_EXCEED_MAX 0.05
double ceduo_exceed_limit(const struct ceduo_scene *scene, const struct ceduo_control *control);

/* Return the share by which a control is judged: exceed, or reach without an accepted energy. */
static inline struct ceduo_estimate ceduo_judged_share(const struct ceduo_arrivals *arrivals)
{
    return isnan(arrivals->exceed.mean) ? arrivals->reach : arrivals->exceed;
}

/* CEDUO_NO_MEMORY, CEDUO_BAD_ARGUMENT or CEDUO_OK. `control` counts in the scene's order. */
enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *arrivals);

/* As ceduo_run_arrivals(), and of a run with blocks the curve of the hazard, to which the arrivals then point. */
enum ceduo_status ceduo_run_hazard(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *arrivals,
                                   struct ceduo_hazard_curve *curve);

/* Return the mean energy (J) of the rocks that reach a control, without interval, and set how many do. It is cheap. */
struct ceduo_estimate ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached);

/* As cheap: shares of all released, and means (J), of each of n groups of rocks, which are equal or one larger, in their order.
 * Requires at least n rocks. */
struct ceduo_group_means {
    double reach_probability, exceed_probability; /* exceed: NaN without an accepted energy */
    double energy;                                /* of those that reached; NaN where none did */
    double energy_per_released;
};
void ceduo_run_group_means(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_group_means *briefs);

/* What one run brings to a control less what another brings, rock by rock of the same numbers; over all released. */
struct ceduo_difference {
    struct ceduo_estimate reach, exceed;       /* shares */
    struct ceduo_estimate energy_per_released; /* J */
};

/* Return `run` less `baseline`, two runs of one scene; all NaN if one is NULL. If one is longer, only rocks that both have count.
 * Both simulate the same rocks. The error of the difference is small if the forests are similar. */
struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control);

/* Between two that are the same: 0, without an error. `accepted` NaN: what exceeds it is not known. */
struct ceduo_difference ceduo_no_difference(double accepted);

#define CEDUO_EARLY_M 10.0

/* How the trajectories ended, and where the rocks lie that came to rest or were stopped by stems. */
struct ceduo_ends {
    uint64_t count[CEDUO_ENDS];
    double share[CEDUO_ENDS]; /* of all released */
    uint64_t uphill;          /* rocks that left the slope over its upper end */
    /* rocks that stems stopped within CEDUO_EARLY_M of the mean release, where they have no speed yet */
    uint64_t early;
    struct ceduo_moments stop_x;
    double stop_p50, stop_p95, stop_max; /* m, relative; NaN where none stopped */
};

/* In a run of arrivals only all counts are 0 and all places NaN. */
enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends);

/* Values of single rocks, in the order of the rocks. Speed (m/s), height (m) and energy (J) are NaN if a rock does not reach the
 * control. The place of its stop (m) is NaN if it does not stop; the weight is NULL if the scene has no blocks. */
enum ceduo_sample { CEDUO_SAMPLE_SPEED, CEDUO_SAMPLE_HEIGHT, CEDUO_SAMPLE_ENERGY, CEDUO_SAMPLE_STOP, CEDUO_SAMPLE_WEIGHT };

/* Return one value for each rock, or NULL if there is none. It is valid until the run is extended or freed. `control` is not used
 * for stops and weights. */
const double *ceduo_run_samples(const struct ceduo_run *run, size_t control, enum ceduo_sample quantity);

/* Write energies (J) of the rocks that reach a control, in the order of the rocks, for a histogram: the first `max` of them. With
 * blocks an energy is written as often as its weight says. Return how many were written. */
size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t max);

#endif
