/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "frame.h"
#include "ceduo/simulate.h"
#include "core/runs/run.h"
#include "scene/rock.h"

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

/* ---- the plain walk ---- */

struct ceduo_rock plain_rock(const struct paper_site *site)
{
    struct ceduo_rock rock;
    if (ceduo_rock_from_means(&site->scene.rock, &rock) != CEDUO_OK)
        fail("bad rock");
    return rock;
}

static double draw(void *random, uint64_t contact)
{
    (void)contact;
    return line_uniform(random, 0, 1);
}

struct slow_def plain_site(const struct paper_site *site, struct slow_segment segments[PAPER_SEGMENTS])
{
    const struct ceduo_rock rock = plain_rock(site);
    for (size_t j = 0; j < PAPER_SEGMENTS; j++) {
        const struct ceduo_segment *s = &site->segments[j];
        segments[j] = slow_segment_between(site->x[j], site->z[j], site->x[j + 1], site->z[j + 1]);
        segments[j].rn = s->rn.mean;
        segments[j].rt = s->rt.mean;
        segments[j].friction = s->friction;
        segments[j].theta_max = isnan(s->roughness_m) ? s->roughness_rad : atan(s->roughness_m / rock.radius);
    }
    return (struct slow_def){.count = PAPER_SEGMENTS,
                             .segments = segments,
                             .law = site->scene.simulation.law == CEDUO_LAW_CRSP ? SLOW_CRSP : SLOW_LUMPED,
                             .gravity = CEDUO_GRAVITY,
                             .radius = rock.radius,
                             .k = rock.k,
                             .vx0 = site->scene.release.vx.mean,
                             .vz0 = site->scene.release.vz.mean,
                             .uniform = draw,
                             .max_contacts = CEDUO_CONTACTS_MAX,
                             .control = site->control.x};
}

double plain_energy(const struct ceduo_rock *rock, const struct slow_crossing *c)
{
    double rim = c->spin * rock->radius;
    return rock->mass / 2 * (c->vx * c->vx + c->vz * c->vz + rock->k * rim * rim);
}
