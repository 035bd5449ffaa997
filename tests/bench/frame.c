/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "frame.h"
#include "ceduo/simulate.h"
#include "core/runs/run.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

void fail(const char *why)
{
    fprintf(stderr, "%s: %s\n", program_invocation_short_name, why);
    exit(1);
}

uint64_t argument(char **argv, int i, uint64_t usual, uint64_t min, uint64_t max)
{
    for (int k = 0; k <= i; k++)
        if (!argv[k])
            return usual;
    char *end;
    unsigned long long value = strtoull(argv[i], &end, 10);
    if (*end != '\0' || value < min || value > max) {
        fprintf(stderr, "%s: argument %d is a whole number from %llu to %llu\n", program_invocation_short_name, i,
                (unsigned long long)min, (unsigned long long)max);
        exit(2);
    }
    return value;
}

double processor_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void timing_begin(struct timing *t)
{
    t->start = ceduo_clock();
    t->start_busy = processor_s();
}

void timing_end(struct timing *t, size_t repeat)
{
    t->seconds[repeat] = ceduo_clock() - t->start;
    t->busy[repeat] = processor_s() - t->start_busy;
}

void read_scene(struct scene_file *file, const char *path)
{
    struct problems problems = {0};
    if (!ceduo_scene_load(file, path, NULL, 0, &problems))
        fail(ceduo_problems_print(&problems));
    ceduo_problems_free(&problems);
}

struct ceduo_run *simulate_run(const struct ceduo_run_def *def, uint64_t rocks)
{
    struct ceduo_run *run;
    if (ceduo_run_create(def, &run) != CEDUO_OK || ceduo_run_extend(run, rocks) != CEDUO_OK)
        fail("the run failed");
    return run;
}

/* ---- slopes ---- */

#define WAVES 40

void roughen_slope(struct ceduo_slope *s, double steepness)
{
    struct line_random r = {.state = 2};
    double end = s->x[s->vertices - 1], longest = 40, shortest = 2 * end / (double)(s->vertices - 1);
    for (size_t w = 0; w < WAVES; w++) {
        double length = longest * pow(shortest / longest, (double)w / (WAVES - 1));
        double phase = line_uniform(&r, 0, 6.283), k = 6.283 / length;
        for (size_t i = 1; i + 1 < s->vertices; i++)
            s->z[i] += steepness / k * sin(k * s->x[i] + phase);
    }
}

struct ceduo_slope fine_slope(const struct ceduo_segment *ground, double metres, size_t vertices)
{
    struct ceduo_slope s = slope_new(vertices);
    for (size_t i = 0; i < vertices; i++) {
        double rest = 1 - (double)i / (double)(vertices - 1);
        s.x[i] = metres * (1 - rest);
        s.z[i] = metres * rest * (0.75 + 0.1 * rest);
        if (i + 1 < vertices)
            s.segments[i] = *ground;
    }
    roughen_slope(&s, 0.03);
    return s;
}
