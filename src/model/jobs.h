/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_JOBS_H
#define CEDUO_JOBS_H

#include "fit.h"
#include "runs.h"
#include "search.h"
#include "study/observed_stops.h"

/* The queue of jobs: one thread computes on a snapshot of the scene. A job has levels from coarse to fine; the thread takes
 * the coarsest step of all jobs. A new job replaces that kind and interrupts the running step. */

/* Kinds of jobs by priority if steps are equally coarse: name, slot, type of the result, function that frees it. */
#define JOBS(X)                                                                                                                \
    X(SEARCH, search, struct search_answer, free_search)                                                                       \
    X(PREVIEW, preview, struct preview, free)                                                                                  \
    X(SNAPSHOT, snapshot, struct snapshot, free_snapshot)                                                                      \
    X(ALTERNATIVES, alternatives, struct alternatives, free)                                                                   \
    X(COMPARISON, comparison, struct comparison, free_comparison)                                                              \
    X(FIT, fit, struct fit, ceduo_fit_free)                                                                                    \
    X(YEARS, years, struct option_years, free_years)                                                                           \
    X(UNCERTAINTY, uncertainty, struct uncertainty, free_uncertainty)

enum job_kind {
#define X(NAME, name, type, free) JOB_##NAME,
    JOBS(X)
#undef X
        JOB_KINDS
};

/* Newest result of each kind; NULL: none. */
union results {
    void *slots[JOB_KINDS];
    struct {
#define X(NAME, name, type, free) type *name;
        JOBS(X)
#undef X
    };
};

/* Figures of a scene. */
struct snapshot {
    struct ceduo_snapshot *snapshot;
    uint64_t key;   /* ceduo_jobs_key() of the scene */
    double seconds; /* s, from the request to the result */
};

/* Figures under the other energy law, one for each option and control, in rows by option. */
struct alternatives {
    size_t options, controls;
    struct ceduo_alternative_energy items[];
};

/* Years of each option. */
struct option_years {
    size_t n, done; /* options; number of them computed in the newest step */
    uint64_t rocks; /* rocks of each run in the newest step */
    struct ceduo_years *items[];
};

/* Comparison of the live scene with its observations, in levels from coarse to fine. */
#define COMPARISON_LEVELS 2

struct comparison {
    struct scene_file file;             /* scene at the start; its nodes are the document's */
    uint64_t rocks;                     /* rocks of each setting */
    struct ceduo_predicted *predicted;  /* one for each observation */
    struct ceduo_observed_stops *stops; /* one for each observation; empty unless it is a list of stops */
};

/* Uncertainty of the scene, today and in the years ahead. Levels: one option at full precision, then all options. */
#define UNCERTAINTY_LEVELS 2

struct uncertainty {
    struct scene_file file; /* scene at the start; its nodes are the document's */
    struct scene_inputs inputs;
    struct ceduo_uncertainty_result answer; /* empty without inputs */
    size_t level;                           /* level reached; with a single option, level 0 counts as 1 */
    size_t option;                          /* option of level 0 */
    bool last;                              /* no level follows */
};

/* Return why the rotation has no uncertainty, marked for translation; NULL: it has. */
const char *ceduo_uncertainty_no_rotation(const struct ceduo_scene *scene);

/* NULL if no thread can be started. */
struct jobs;
struct jobs *ceduo_jobs_create(unsigned threads);
void ceduo_jobs_free(struct jobs *jobs);

/* Return a key of everything that affects the runs of a scene. Scenes with equal keys have the same figures. */
uint64_t ceduo_jobs_key(const struct ceduo_scene *scene);

/* Return a key of a scene's nodes, except title and head of the report, which affect no figure. Trees with equal keys share all
 * other nodes. */
uint64_t ceduo_jobs_nodes_key(const struct node *root);

/* ---- requests: copy the scene, whose pointers stay valid until the jobs are freed; true if there is work ---- */

/* Request the figures of a scene: option `shown` and no forest first, then all options and their years. */
bool ceduo_jobs_request_figures(struct jobs *jobs, const struct scene_file *file, size_t shown);

#define JOB_TEXT 1024

/* A request for another job. The data of its pointers is copied. */
struct job_request {
    enum job_kind kind;
    const struct scene_file *file;
    size_t option;            /* option shown, whose uncertainty comes first; option judged by a preview */
    size_t levels;            /* levels of uncertainty and comparison, 0: stop; otherwise 1 */
    const char *path, *value; /* changed value of a preview; each shorter than JOB_TEXT */
    const struct ceduo_search *search;
    const struct fit_request *fit; /* restarts if it is interrupted */
};

/* A scene with the same nodes, by ceduo_jobs_nodes_key(), is computed once. Figures and years go first unless they need more
 * rocks. */
bool ceduo_jobs_request(struct jobs *jobs, const struct job_request *request);

/* Stop a search or fit and drop its result. */
void ceduo_jobs_stop(struct jobs *jobs, enum job_kind kind);

/* ---- results ---- */

int ceduo_jobs_fd(const struct jobs *jobs); /* readable if results are waiting; ceduo_jobs_collect() reads it */

struct jobs_state {
    unsigned new_kinds; /* kinds with a new result: 1 << JOB_SEARCH … */
    bool busy;          /* a job is not done */
    bool fitting;
    double uncertainty; /* share (0…1) computed of the running level; NaN: not requested, or done */
};

/* Replace older results with new ones. Keep the newest years of each option. */
struct jobs_state ceduo_jobs_collect(struct jobs *jobs, union results *results);

void ceduo_job_results_drop(union results *results, enum job_kind kind);
void ceduo_job_results_free(union results *results);

/* Wait until no search or preview is left; `all`: no job. Return true if a search or preview has a result. */
bool ceduo_jobs_wait(struct jobs *jobs, bool all);

#endif
