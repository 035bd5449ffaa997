/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_JOBS_H
#define CEDUO_JOBS_H

#include "ceduo/calibrate.h"
#include "ceduo/uncertainty.h"
#include "fit.h"
#include "runs.h"
#include "search.h"
#include "study/seen.h"

/* The queue of jobs: one thread computes on a snapshot of the scene. A job has levels from coarse to fine; the coarsest step of all
 * jobs is next. A new job replaces that of its kind, and interrupts the step under way, which is repeated later. */

/* The kinds, the first first where two steps are as coarse: name, slot, what it holds, by what that is freed. */
#define JOBS(X)                                                                                                                \
    X(SEARCH, search, struct search_answer, free_search)                                                                       \
    X(PREVIEW, preview, struct preview, free)                                                                                  \
    X(SNAPSHOT, snapshot, struct snapshot, free_snapshot)                                                                      \
    X(OTHERS, others, struct others, free)                                                                                     \
    X(COMPARISON, comparison, struct comparison, free_comparison)                                                              \
    X(FIT, fit, struct fit, ceduo_fit_free)                                                                                    \
    X(YEARS, years, struct years_known, free_years)                                                                            \
    X(UNCERTAINTY, uncertainty, struct uncertainty, free_uncertainty)

enum job_kind {
#define X(NAME, name, type, free) JOB_##NAME,
    JOBS(X)
#undef X
        JOB_KINDS
};

/* The newest result of each kind; NULL: none. */
union results {
    void *slots[JOB_KINDS];
    struct {
#define X(NAME, name, type, free) type *name;
        JOBS(X)
#undef X
    };
};

/* The figures of a scene. */
struct snapshot {
    struct ceduo_snapshot *snapshot;
    uint64_t key;   /* of the scene: ceduo_jobs_key() */
    double seconds; /* from the request to it */
};

/* The figures under the other energy law, one for each option and control, in rows by option. */
struct others {
    size_t options, controls;
    struct ceduo_alternative_energy items[];
};

/* The years of each option. */
struct years_known {
    size_t n, done; /* options; of them the newest step has done so many */
    uint64_t rocks; /* of each run of that step */
    struct ceduo_years *items[];
};

/* The scene of the live program, as it is, compared with what was observed there; in levels from coarse to fine. */
#define COMPARISON_LEVELS 2

struct comparison {
    struct scene_file file;             /* as it was; its nodes are the document's */
    uint64_t rocks;                     /* of each setting */
    struct ceduo_predicted *predicted;  /* one for each observation */
    struct ceduo_observed_stops *stops; /* likewise: empty for all that is no list of stops */
};

/* Uncertainty of the scene, of today and of the years ahead. Levels: one option alone, at full precision; then all options. */
#define UNCERTAINTY_LEVELS 2

struct uncertainty {
    struct scene_file file; /* as it was; its nodes are the document's */
    struct scene_inputs inputs;
    struct ceduo_uncertainty_result answer; /* without inputs: empty */
    size_t level;                           /* that it has come to: of one option alone the first is the second */
    size_t option;                          /* that level 0 is of */
    bool last;                              /* there is nothing more */
};

/* Why there is nothing over a rotation, marked for translation; NULL: there is. */
const char *ceduo_uncertainty_no_rotation(const struct ceduo_scene *scene);

/* NULL where no thread can be started. */
struct jobs;
struct jobs *ceduo_jobs_create(unsigned threads);
void ceduo_jobs_free(struct jobs *jobs);

/* A number for all that decides the runs of a scene: two scenes of one number have the same figures. */
uint64_t ceduo_jobs_key(const struct ceduo_scene *scene);

/* ---- requests: all copy the scene; what it points to stays until the jobs are freed. True if something is to be done ---- */

/* Ask for the figures of a scene, first of option `shown` and without forest, then of all options and their years. */
bool ceduo_jobs_show(struct jobs *jobs, const struct scene_file *file, size_t shown);

#define JOB_TEXT 1024

/* A request for another job. What its pointers lead to is copied. */
struct job_request {
    enum job_kind kind;
    const struct scene_file *file;
    size_t option;            /* shown: its uncertainty comes first; of a preview that which is judged */
    size_t levels;            /* of uncertainty and comparison, 0: stop; otherwise 1 */
    const char *path, *value; /* of a preview: what another value would do to the lights; each of less than JOB_TEXT bytes */
    const struct ceduo_search *search;
    const struct fit_request *fit; /* begins again if it is interrupted */
};

/* A scene with the same nodes is asked for its uncertainty or comparison once. Figures and years of as many rocks go first. */
bool ceduo_jobs_ask(struct jobs *jobs, const struct job_request *request);

/* Stops a search or a fit, and forgets its result. */
void ceduo_jobs_stop(struct jobs *jobs, enum job_kind kind);

/* ---- results ---- */

int ceduo_jobs_fd(const struct jobs *jobs); /* readable when there is news; read by ceduo_jobs_take() */

struct jobs_state {
    unsigned fresh; /* kinds with a new result: 1 << JOB_SEARCH … */
    bool busy;      /* some job is not done */
    bool fitting;
    double uncertainty; /* share (0…1) of its level that is computed; NaN: none is asked for, or all is done */
};

/* Puts the new results in the place of the older ones; of years the newest of each option stay. */
struct jobs_state ceduo_jobs_take(struct jobs *jobs, union results *results);

void ceduo_result_list_drop(union results *results, enum job_kind kind);
void ceduo_result_list_free(union results *results);

/* Wait until no search and no preview is left, or no job at `all`. True if there is a result of a search or a preview. */
bool ceduo_jobs_wait(struct jobs *jobs, bool all);

#endif
