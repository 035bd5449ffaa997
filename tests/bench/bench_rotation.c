/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure the time of a rotation: grow, simulate and assess each of 25 years for every option of a scene. CSV on stdout,
 * medians. */
#include <inttypes.h>
#include <stdio.h>

#include "core/runs/pool.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/runs/year_runs.h"
#include "frame.h"

#define FIRST        1 /* years, from just after the cut to the end of the rotation */
#define LAST         25
#define GOAL_SECONDS 2 /* with 10 000 rocks on two cores */

/* Simulate all options and years from a parsed scene; the amount of work goes to *work. */
static void simulate(const struct ceduo_scene *scene, unsigned threads, uint64_t rocks, struct ceduo_work *work)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = threads;
    def.rocks_max = rocks;
    struct ceduo_pool *pool;
    struct ceduo_run *run;
    struct ceduo_simulated bare;
    if (ceduo_pool_create(&def, &pool) != CEDUO_OK || ceduo_pool_run(pool, NULL, &run) != CEDUO_OK ||
        ceduo_run_extend(run, rocks) != CEDUO_OK || ceduo_simulated_read(run, scene, NULL, &bare) != CEDUO_OK)
        fail("the rotation failed");
    for (size_t i = 0; i < scene->options_count; i++) {
        struct ceduo_years *years;
        if (ceduo_years_create(scene, &scene->options[i], (struct ceduo_window){.first = FIRST, .last = LAST, .step = 1},
                               &years) != CEDUO_OK ||
            ceduo_years_simulate(years, pool, &bare, rocks) != CEDUO_OK)
            fail("the rotation failed");
        ceduo_years_free(years);
    }
    *work = ceduo_pool_work(pool);
    ceduo_simulated_release(&bare);
    ceduo_pool_free(pool);
}

static void measure(const char *path, size_t repeats, uint64_t rocks, unsigned threads)
{
    struct scene_file file;
    read_scene(&file, path);
    struct ceduo_work work = {0};
    struct timing t;
    for (size_t r = 0; r < repeats; r++) {
        timing_begin(&t);
        simulate(&file.scene, threads, rocks, &work);
        timing_end(&t, r);
    }
    printf("%s,%zu,%d,%" PRIu64 ",%u,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%.3f,%.3f,%d\n", path, file.scene.options_count,
           LAST - FIRST + 1, rocks, threads, work.runs, work.rocks, work.stems.drawn, median(t.seconds, repeats),
           median(t.busy, repeats), GOAL_SECONDS);
    ceduo_scene_release(&file);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 3, 1, REPEATS_MAX);
    uint64_t rocks = argument(argv, 2, 10000, 1, UINT64_MAX);
    unsigned threads = (unsigned)argument(argv, 3, 2, 1, 1024);
    puts("scene,options,years,rocks,threads,runs,rocks_flown,stems_drawn,seconds_median,cpu_seconds_median,goal_seconds");
    measure("profiles/scenes/rotation.yaml", repeats, rocks, threads);
    return 0;
}
