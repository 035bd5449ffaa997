/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and what is read of them; a test fails where that does not go well. */
#ifndef RUNS_H
#define RUNS_H

#include "ceduo/ceduo.h"

struct ceduo_run *run_of(const struct ceduo_run_def *def, uint64_t rocks);
struct ceduo_run *run_option(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks,
                             unsigned threads);
struct ceduo_arrivals arrivals_of(const struct ceduo_run *run, size_t control);
struct ceduo_ends ends_of(const struct ceduo_run *run);

/* The same bits of control 0, the ends and stems. */
void expect_same_run(const struct ceduo_run *a, const struct ceduo_run *b);
/* The same bits on 2, 5 and 16 threads and in steps as on one thread at once. */
void expect_same_however(struct ceduo_run_def def, uint64_t rocks);
/* A run of these rocks says of control 0 what they do when they are followed one by one. Returns how many arrive and how many
 * cannot be drawn. */
struct followed {
    uint64_t reached, bad;
};
struct followed expect_as_followed(struct ceduo_run_def def, uint64_t rocks);

#endif
