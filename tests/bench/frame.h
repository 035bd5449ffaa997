/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helpers of the benches: arguments, clocks, medians, scenes, runs. Any failure prints a message and ends the program. */
#ifndef FRAME_H
#define FRAME_H

#include "ceduo/ceduo.h"
#include "io/scene_file.h"
#include "measure.h"
#include "physics/line_scene.h"
#include "physics/paper_site.h"
#include "plain_walk.h"

#define REPEATS_MAX 101

_Noreturn void fail(const char *why);

/* Return the i-th argument, a whole number from `min` to `max`; `usual` if it is missing. */
uint64_t argument(char **argv, int i, uint64_t usual, uint64_t min, uint64_t max);

/* Processor time of all threads, in seconds; other load does not count. */
double processor_s(void);

struct timing {
    double seconds[REPEATS_MAX], busy[REPEATS_MAX]; /* wall clock; processor */
    double start, start_busy;
};
void timing_begin(struct timing *t);
void timing_end(struct timing *t, size_t repeat);

void read_scene(struct scene_file *file, const char *path);
struct ceduo_run *simulate_run(const struct ceduo_run_def *def, uint64_t rocks);

/* Add waves of all lengths to a slope, from 40 m to its two finest segments, each with this steepness. */
void roughen_slope(struct ceduo_slope *s, double steepness);

/* Return a slope of one ground, `metres` long, steep above and gentle below, with such waves. Caller frees with
 * slope_free(). */
struct ceduo_slope fine_slope(const struct ceduo_segment *ground, double metres, size_t vertices);

#endif
