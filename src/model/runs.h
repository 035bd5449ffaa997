/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RUNS_H
#define CEDUO_RUNS_H

#include "ceduo/years.h"
#include "study/snapshot.h"

/* Runs kept by the live program, simulated in steps from coarse to fine. Runs of years keep only arrivals. */
struct runs;

#define RUNS_FIRST     1024   /* rocks of the first level; each further one simulates ten times more */
#define RUNS_SKETCH    256    /* rocks for the envelopes of the first level */
#define RUNS_LEVELS    3      /* levels of a forest; years and the other energy law have one less */
#define RUNS_MAX       102400 /* limit of rocks per forest */
#define RUNS_MIN       10240  /* enough once mean energies are known to RUNS_TOLERANCE (95 %) */
#define RUNS_TOLERANCE 0.004

struct runs *ceduo_runs_create(unsigned threads, const atomic_bool *cancel);
void ceduo_runs_free(struct runs *runs);

/* One step of the figures: n rocks without forest and with every option, option `shown` first. */
struct runs_step {
    const struct ceduo_scene *scene;
    size_t shown;
    uint64_t rocks;
    void (*publish)(void *context, struct ceduo_snapshot *snapshot); /* takes ownership */
    void *context;
    bool enough; /* set on return: no finer step is needed */
};

/* CEDUO_CANCELLED: the next call continues. */
enum ceduo_status ceduo_runs_figures(struct runs *runs, struct runs_step *step);

/* One step of the other energy law: n rocks through every option. Set one item for each control of each option. */
enum ceduo_status ceduo_runs_alternative_energies(struct runs *runs, const struct ceduo_scene *scene, uint64_t rocks,
                                                  struct ceduo_alternative_energy *energies);

/* Return a key of everything that affects the years of an option. */
uint64_t ceduo_runs_years_key(const struct ceduo_scene *scene, size_t option);

/* One step of the years of an option; sets their key. Requires a step of the figures. */
enum ceduo_status ceduo_runs_years(struct runs *runs, const struct ceduo_scene *scene, size_t option, uint64_t rocks,
                                   struct ceduo_years **years);

#endif
