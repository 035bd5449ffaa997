/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How long a rotation takes: every option of a scene in each of 25 years, so many rocks in each, grown, flown and assessed.
 * CSV on stdout, medians. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "ceduo/years.h"
#include "io/scene_file.h"
#include "measure.h"

#define REPEATS_MOST 101
#define FIRST        1 /* just cut, to the end of the rotation */
#define LAST         25
#define GOAL_SECONDS 2 /* with 10 000 rocks on two cores */

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* All of it once, from a scene that was read; what was done goes to *work. */
static void fly(const struct ceduo_scene *scene, unsigned threads, uint64_t rocks, struct ceduo_work *work)
{
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = threads;
    def.rocks_most = rocks;
    struct ceduo_pool *pool;
    struct ceduo_run *run;
    struct ceduo_simulated bare;
    if (ceduo_pool_create(&def, &pool) != CEDUO_OK || ceduo_pool_run(pool, NULL, &run) != CEDUO_OK ||
        ceduo_run_extend(run, rocks) != CEDUO_OK || ceduo_simulated_read(run, scene->controls_count, &bare) != CEDUO_OK)
        exit(1);
    for (size_t i = 0; i < scene->options_count; i++) {
        struct ceduo_years *years;
        if (ceduo_years_create(scene, &scene->options[i], (struct ceduo_window){.first = FIRST, .last = LAST, .step = 1},
                               &years) != CEDUO_OK ||
            ceduo_years_simulate(years, pool, &bare, rocks) != CEDUO_OK)
            exit(1);
        ceduo_years_free(years);
    }
    *work = ceduo_pool_work(pool);
    ceduo_simulated_free(&bare);
    ceduo_pool_free(pool);
}

static void measure(const char *path, size_t repeats, uint64_t rocks, unsigned threads)
{
    struct scene_file file;
    struct problems problems = {0};
    if (!ceduo_scene_read(&file, path, NULL, 0, &problems)) {
        fputs(ceduo_text_string(&problems.text), stderr);
        exit(1);
    }
    struct ceduo_work work = {0};
    double seconds[REPEATS_MOST], busy[REPEATS_MOST];
    for (size_t r = 0; r < repeats; r++) {
        double start = seconds_of(CLOCK_MONOTONIC), start_busy = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        fly(&file.scene, threads, rocks, &work);
        seconds[r] = seconds_of(CLOCK_MONOTONIC) - start;
        busy[r] = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start_busy;
    }
    qsort(seconds, repeats, sizeof *seconds, by_value);
    qsort(busy, repeats, sizeof *busy, by_value);
    printf("%s,%zu,%d,%" PRIu64 ",%u,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%.3f,%.3f,%d\n", path, file.scene.options_count,
           LAST - FIRST + 1, rocks, threads, work.runs, work.rocks, work.stems.drawn, seconds[repeats / 2], busy[repeats / 2],
           GOAL_SECONDS);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

int main(int argc, char **argv)
{
    size_t repeats = argc > 1 ? strtoul(argv[1], NULL, 10) : 3;
    uint64_t rocks = argc > 2 ? strtoull(argv[2], NULL, 10) : 10000;
    unsigned threads = argc > 3 ? (unsigned)strtoul(argv[3], NULL, 10) : 2;
    if (repeats < 1 || repeats > REPEATS_MOST || rocks < 1 || threads < 1) {
        fputs("usage: bench_rotation [REPEATS [ROCKS [THREADS]]]\n", stderr);
        return 2;
    }
    puts("scene,options,years,rocks,threads,runs,rocks_flown,stems_drawn,seconds_median,cpu_seconds_median,goal_seconds");
    measure("profiles/scenes/rotation.yaml", repeats, rocks, threads);
    return 0;
}
