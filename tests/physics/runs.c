/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "runs.h"

#include "expect.h"

struct ceduo_run *run_of(const struct ceduo_run_def *def, uint64_t rocks)
{
    struct ceduo_run *run;
    assert_int_equal(ceduo_run_create(def, &run), CEDUO_OK);
    assert_int_equal(ceduo_run_extend(run, rocks), CEDUO_OK);
    assert_int_equal(ceduo_run_rocks(run), rocks);
    return run;
}

struct ceduo_run *run_option(const struct ceduo_scene *scene, const struct ceduo_option *option, uint64_t rocks,
                             unsigned threads, size_t exact_bytes)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.option = option;
    def.rocks_most = rocks;
    def.threads = threads;
    def.exact_bytes = exact_bytes;
    return run_of(&def, rocks);
}

struct ceduo_arrivals arrivals_of(const struct ceduo_run *run, size_t control)
{
    struct ceduo_arrivals a;
    assert_int_equal(ceduo_run_arrivals(run, control, &a), CEDUO_OK);
    return a;
}

struct ceduo_ends ends_of(const struct ceduo_run *run)
{
    struct ceduo_ends ends;
    assert_int_equal(ceduo_run_ends(run, &ends), CEDUO_OK);
    return ends;
}
