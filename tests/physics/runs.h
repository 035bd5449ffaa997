/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs and what is read of them; a test fails where that does not go well. */
#ifndef RUNS_H
#define RUNS_H

#include "ceduo/ceduo.h"

struct ceduo_run *run_of(const struct ceduo_run_def *def, uint64_t rocks);
struct ceduo_run *run_option(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks,
                             unsigned threads, size_t exact_bytes);
struct ceduo_arrivals arrivals_of(const struct ceduo_run *run, size_t control);
struct ceduo_ends ends_of(const struct ceduo_run *run);

#endif
