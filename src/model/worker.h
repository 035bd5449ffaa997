/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_WORKER_H
#define CEDUO_WORKER_H

#include <stdbool.h>
#include <stdint.h>

#include "ceduo/years.h"
#include "study/outlook.h"

/* One thread in the background that flies rocks over a snapshot of the scene: coarse first, then finer by itself until
 * the errors are small. A new request cancels what it makes stale; one that asks for the same run changes nothing. */
struct worker;

#define WORKER_FIRST_ROCKS 1024    /* shown first */
#define WORKER_PICTURE_ROCKS 10240 /* enough for envelopes */
#define WORKER_YEAR_ROCKS 10240    /* of each year */
#define WORKER_ROCKS_MOST 102400   /* refined up to this: each forest of the scene flies as many */
#define WORKER_TOLERANCE 0.004     /* or until mean energies are known to this (95 %) */

/* NULL where no thread can be started. */
struct worker *ceduo_worker_create(unsigned threads);
void ceduo_worker_free(struct worker *worker);
unsigned ceduo_worker_threads(const struct worker *worker);

/* A number for all that decides the runs of a scene: two scenes of one number have the same figures. */
uint64_t ceduo_worker_key(const struct ceduo_scene *scene);
/* The same with the years to come of option `shown`. */
uint64_t ceduo_worker_years_key(const struct ceduo_scene *scene, size_t shown);

/* Asks for the runs of a scene, those of option `shown` and without forest first. Runs of forests that have not changed
 * since the last request are kept. `years`: the years to come of that option as well. What the scene points to must stay until the worker is freed (an arena that is never
 * emptied); the struct itself is copied. */
void ceduo_worker_request(struct worker *worker, const struct ceduo_scene *scene, size_t shown, bool years);

/* A file descriptor that becomes readable when there is news; read by ceduo_worker_news(). */
int ceduo_worker_fd(const struct worker *worker);

struct worker_news {
    struct ceduo_outlook *outlook; /* newest, NULL where none is new; the caller's from now on */
    uint64_t key;                  /* of its scene: ceduo_worker_key() */
    bool busy;                     /* still refining */
    struct ceduo_years *years;     /* newest, NULL where none are new; the caller's from now on */
    size_t years_option;           /* which option they are of */
    uint64_t rocks;                /* of the newest */
    double seconds;                /* since the request */
    bool failed;                   /* out of memory */
};
struct worker_news ceduo_worker_news(struct worker *worker);

/* Waits until nothing is under way. */
void ceduo_worker_wait(struct worker *worker);

#endif
