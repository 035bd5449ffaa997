/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_JOBS_H
#define CEDUO_JOBS_H

#include "doubted.h"
#include "fit.h"
#include "flights.h"
#include "foresee.h"
#include "seek.h"
#include "sighted.h"

/* The queue of jobs of the live program: one thread in the background simulates rocks on a snapshot of the scene. A job goes
 * in steps from coarse to fine, and the coarsest step of all jobs is next. There is one job of a kind: a new one cancels
 * the one before, and any new one interrupts the step under way, which is continued later. */
struct jobs;

/* NULL where no thread can be started. */
struct jobs *ceduo_jobs_create(unsigned threads);
void ceduo_jobs_free(struct jobs *jobs);
unsigned ceduo_jobs_threads(const struct jobs *jobs);

/* A number for all that decides the runs of a scene: two scenes of one number have the same figures. */
uint64_t ceduo_jobs_key(const struct ceduo_scene *scene);

/* Asks for the figures of a scene, those of option `shown` and without forest first. `key`: its ceduo_jobs_key(). Runs of
 * forests that have not changed since the last request are kept; what asks for the same runs changes nothing. `years`: the
 * years of all options as well, those of `shown` first. What the scene points to must stay until the jobs are freed (an arena that is never
 * emptied); the struct itself is copied. True where something is to be done. */
bool ceduo_jobs_show(struct jobs *jobs, const struct ceduo_scene *scene, uint64_t key, size_t shown, bool years);

/* Asks for a search. Threads and cancel are set here; the path is copied, and the scene as it is now. */
void ceduo_jobs_seek(struct jobs *jobs, const struct seek *seek);
void ceduo_jobs_stop_seek(struct jobs *jobs);

/* Asks what a change (PATH=VALUE, shorter than 1024 bytes) would do to the lights of an option. The scene is copied as
 * it is now. */
void ceduo_jobs_foresee(struct jobs *jobs, const struct scene_file *file, const char *set, size_t option);

/* Asks what doubt does to a scene, up to so many levels (doubted.h); 0: nothing. A scene whose nodes are the same is asked for
 * once. Figures and years of as many rocks go before it. True where something is to be done. */
bool ceduo_jobs_doubt(struct jobs *jobs, const struct scene_file *file, size_t levels);

/* Asks what a scene says of what was seen there, up to so many levels (sighted.h); 0: nothing. True where something is to be done. A
 * fit of another scene is stopped, and forgotten. */
bool ceduo_jobs_look(struct jobs *jobs, const struct scene_file *file, size_t levels);

/* Asks for a fit of a scene to what was seen there. What interrupts it lets it begin again. */
void ceduo_jobs_fit(struct jobs *jobs, const struct scene_file *file, const struct fit_wish *wish);
void ceduo_jobs_stop_fit(struct jobs *jobs);

/* What a search came to. */
struct sought {
    enum ceduo_status status;
    double target;            /* that was looked for */
    bool rotation;            /* it looked at one whole rotation */
    struct ceduo_yield yield; /* at that value */
    struct ceduo_found found;
    struct problems problems;
};
void ceduo_sought_free(struct sought *sought);

/* A file descriptor that becomes readable when there is news; read by ceduo_jobs_news(). */
int ceduo_jobs_fd(const struct jobs *jobs);

struct jobs_news {
    struct ceduo_outlook *outlook;     /* newest, NULL where none is new; the caller's from now on */
    uint64_t key;                      /* of its scene: ceduo_jobs_key() */
    double seconds;                    /* from the request to it */
    struct ceduo_years **years;        /* newest of each option, as far as there are new ones; NULL: there are none. The
                                    * caller's from now on */
    size_t years_count;                /* options */
    struct ceduo_other_energy *others; /* newest under the other energy law, one for each option and control, in rows by
                                        * option; NULL: none are new. The caller's from now on */
    size_t others_options, others_controls;
    struct doubted *doubted; /* newest; NULL: none is new. The caller's from now on */
    struct sighted *sighted; /* likewise */
    struct fit *fit;         /* likewise: it is done */
    bool fitting;            /* a fit is under way, and has come so far: */
    struct ceduo_calibration_state fit_state;
    size_t done, all;      /* of the step under way in the years: options, of so many; all 0: none is */
    uint64_t rocks;        /* of each run of that step, or of the figures' */
    struct sought *sought; /* NULL: none is done; the caller's from now on */
    bool foresaw;          /* what a change would do is known: */
    struct foreseen foreseen;
    bool busy; /* some job is not done */
};
struct jobs_news ceduo_jobs_news(struct jobs *jobs);
void ceduo_jobs_free_years(struct ceduo_years **years, size_t n);

/* Waits until no job is left. */
void ceduo_jobs_wait(struct jobs *jobs);
/* Waits until no search and nothing to foresee is left; true where there is news of one. */
bool ceduo_jobs_wait_seek(struct jobs *jobs);

#endif
