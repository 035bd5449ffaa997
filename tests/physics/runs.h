/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and their results; any failure fails the test. */
#ifndef RUNS_H
#define RUNS_H

#include "ceduo/ceduo.h"

struct ceduo_run *make_run(const struct ceduo_run_def *def, uint64_t rocks);
struct ceduo_run *run_option(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks,
                             unsigned threads);
struct ceduo_arrivals read_arrivals(const struct ceduo_run *run, size_t control);
struct ceduo_ends read_ends(const struct ceduo_run *run);

/* Compare control 0, the ends and the stems bit by bit. */
void expect_same_run(const struct ceduo_run *a, const struct ceduo_run *b);
/* Compare runs on 2, 5 and 16 threads and in steps with one thread at once, bit by bit. */
void expect_same_however(struct ceduo_run_def def, uint64_t rocks);
/* Compare control 0 of a run with the same rocks simulated one by one. Returns how many arrive and how many cannot be drawn. */
struct followed {
    uint64_t reached, bad;
};
struct followed expect_as_followed(struct ceduo_run_def def, uint64_t rocks);

#endif
