/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the benches share: arguments, clocks, medians, scenes, runs. Whatever goes wrong ends the program with a word on stderr. */
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

/* The i-th argument, a whole number from `least` to `most`; `usual` where there are fewer. */
uint64_t argument(char **argv, int i, uint64_t usual, uint64_t least, uint64_t most);

/* Of all threads: other work on the machine does not count. */
double processor_s(void);

struct timing {
    double seconds[REPEATS_MAX], busy[REPEATS_MAX]; /* by the clock on the wall, of the processor */
    double start, start_busy;
};
void timing_begin(struct timing *t);
void timing_end(struct timing *t, size_t repeat);

void read_scene(struct scene_file *file, const char *path);
struct ceduo_run *fly_run(const struct ceduo_run_def *def, uint64_t rocks);

/* Lay waves of all lengths over a slope, from 40 m to its two finest segments, each of this steepness. */
void roughen_slope(struct ceduo_slope *s, double steepness);

/* A slope of one ground, `metres` long, steep above and gentle below, with such waves. The caller frees it by slope_free(). */
struct ceduo_slope fine_slope(const struct ceduo_segment *ground, double metres, size_t vertices);

/* The paper's site for the plain walk, the means of its rock, and what energy it crosses the control with. Facets are drawn one after
 * another from one generator, the context. */
struct slow_def plain_site(const struct paper_site *site, struct slow_segment segments[PAPER_SEGMENTS]);
struct ceduo_rock plain_rock(const struct paper_site *site);
double plain_energy(const struct ceduo_rock *rock, const struct slow_crossing *c);

#endif
