/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How long a sensitivity takes: the paper's site with its twelve inputs, so many base points and rocks. CSV on stdout,
 * medians. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "ceduo/doubt.h"
#include "io/inputs.h"
#include "measure.h"

#define REPEATS_MOST 101
#define GOAL_SECONDS 30 /* with 256 base points and 2000 rocks on two cores */

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void measure(const char *path, size_t repeats, size_t points, uint64_t rocks, unsigned threads)
{
    struct scene_file file;
    struct problems problems = {0};
    struct scene_inputs inputs;
    if (!ceduo_scene_read(&file, path, NULL, 0, &problems) || !ceduo_inputs_of(&file, &inputs)) {
        fputs(ceduo_text_string(&problems.text), stderr);
        exit(1);
    }
    const struct ceduo_doubt_def def = {.scene = &file.scene,
                                        .inputs_count = inputs.n,
                                        .inputs = inputs.items,
                                        .points = points,
                                        .rocks = rocks,
                                        .threads = threads};
    double seconds[REPEATS_MOST], busy[REPEATS_MOST];
    uint64_t evaluations = 0;
    for (size_t r = 0; r < repeats; r++) {
        struct ceduo_doubt_answer answer;
        double start = seconds_of(CLOCK_MONOTONIC), start_busy = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        if (ceduo_doubt_ask(&def, &answer) != CEDUO_OK)
            exit(1);
        seconds[r] = seconds_of(CLOCK_MONOTONIC) - start;
        busy[r] = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start_busy;
        evaluations = answer.evaluations;
        ceduo_doubt_free(&answer);
    }
    qsort(seconds, repeats, sizeof *seconds, by_value);
    qsort(busy, repeats, sizeof *busy, by_value);
    printf("%s,%zu,%zu,%" PRIu64 ",%u,%" PRIu64 ",%.3f,%.3f,%d\n", path, inputs.n, points, rocks, threads, evaluations,
           seconds[repeats / 2], busy[repeats / 2], GOAL_SECONDS);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

int main(int argc, char **argv)
{
    size_t repeats = argc > 1 ? strtoul(argv[1], NULL, 10) : 1;
    size_t points = argc > 2 ? strtoul(argv[2], NULL, 10) : CEDUO_DOUBT_POINTS;
    uint64_t rocks = argc > 3 ? strtoull(argv[3], NULL, 10) : 2000;
    unsigned threads = argc > 4 ? (unsigned)strtoul(argv[4], NULL, 10) : 2;
    if (repeats < 1 || repeats > REPEATS_MOST || points < 2 || rocks < 2 || threads < 1) {
        fputs("usage: bench_doubt [REPEATS [POINTS [ROCKS [THREADS]]]]\n", stderr);
        return 2;
    }
    puts("scene,inputs,points,rocks,threads,evaluations,seconds_median,cpu_seconds_median,goal_seconds");
    measure("profiles/scenes/paper-site.yaml", repeats, points, rocks, threads);
    return 0;
}
