/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rocks simulated one by one (trajectory.c), with all segments of their trajectories. Within a segment all integrals have
 * closed forms: a flight is a parabola over straight ground, and along a roll the squared speed is linear in x. */

#include <math.h>
#include <stdlib.h>

#include "base/oom.h"
#include "base/parallel.h"
#include "base/real.h"
#include "ceduo/simulate.h"
#include "scene/schema.h"
#include "scene/slope.h"

/* Integrals along a stretch, divided by its length at the end. */
struct stretch_sums {
    double length, speed, height, speed2; /* integrals over x */
    double spin2, roll2; /* of squared spin in flight; of squared speed in a roll, proportional to squared spin */
};

struct recorder {
    const struct ceduo_record_def *def;
    struct ceduo_record *record;
    struct ceduo_rock_record *rock;
    struct stretch_sums *sums; /* [stretch] */
    size_t blows_capacity;
    bool no_memory;
};

static double square(double x)
{
    return x * x;
}

/* ---- the height of a flight above the ground ---- */

/* Set the times t[0] and t[1] of a flight above segment j between `from` and `to`. False if there are none. */
static bool part_above(const struct ceduo_slope *s, const struct ceduo_trajectory_segment *p, size_t j, double from, double to,
                       double t[2])
{
    double lo = max(s->x[j], from), hi = fmin(s->x[j + 1], to);
    double first = p->vx > 0 ? lo : hi, last = p->vx > 0 ? hi : lo;
    t[0] = fmax(0, (first - p->x) / p->vx);
    t[1] = fmin(p->seconds, (last - p->x) / p->vx);
    return hi > lo && t[1] > t[0]; /* untaken: rounding */
}

static double height_in(const struct ceduo_slope *s, const struct ceduo_trajectory_segment *p, double gravity, size_t j,
                        double t)
{
    double m = (s->z[j + 1] - s->z[j]) / (s->x[j + 1] - s->x[j]), x = p->x + p->vx * t;
    return p->z + t * (p->vz - gravity / 2 * t) - (s->z[j] + m * (x - s->x[j]));
}

/* Return the maximum height of a flight. Over one segment it is at an end, or where the flight is parallel to the ground. */
static double largest_height(const struct ceduo_scene *scene, const struct ceduo_trajectory_segment *p)
{
    const struct ceduo_slope *s = &scene->slope;
    double t[2], gravity = scene->simulation.gravity;
    double highest = p->z - ceduo_slope_height(s, p->x), lo = fmin(p->x, p->x1), hi = max(p->x, p->x1);
    size_t last = ceduo_slope_segment(s, hi);
    for (size_t j = ceduo_slope_segment(s, lo); hi > lo && j <= last; j++) {
        if (!part_above(s, p, j, lo, hi, t))
            continue;
        double top = (p->vz - (s->z[j + 1] - s->z[j]) / (s->x[j + 1] - s->x[j]) * p->vx) / gravity;
        highest = max(highest, max(height_in(s, p, gravity, j, t[0]), height_in(s, p, gravity, j, t[1])));
        if (top > t[0] && top < t[1])
            highest = max(highest, height_in(s, p, gravity, j, top));
    }
    return highest;
}

/* ---- means along a stretch ---- */

/* Return the integral of sqrt(vx2 + s2) over the vertical speed s, from 0. */
static double speed_integral(double vx, double s)
{
    return (s * sqrt(vx * vx + s * s) + vx * vx * asinh(s / fabs(vx))) / 2;
}

static void add_flight(const struct ceduo_scene *scene, const struct ceduo_trajectory_segment *p, double lo, double hi,
                       struct stretch_sums *a)
{
    double gravity = scene->simulation.gravity, v = fabs(p->vx);
    double first = ((p->vx > 0 ? lo : hi) - p->x) / p->vx, last = ((p->vx > 0 ? hi : lo) - p->x) / p->vx;
    double s0 = p->vz - gravity * first, s1 = p->vz - gravity * last;
    a->speed += v / gravity * (speed_integral(p->vx, s0) - speed_integral(p->vx, s1));
    a->speed2 += v * (v * v * (last - first) + (s0 * s0 * s0 - s1 * s1 * s1) / (3 * gravity));
    a->spin2 += square(p->spin) * (hi - lo);
    const struct ceduo_slope *s = &scene->slope;
    double height = 0, t[2]; /* integral over time, summed over the segments of ground */
    size_t end = ceduo_slope_segment(s, hi);
    for (size_t j = ceduo_slope_segment(s, lo); j <= end; j++)
        if (part_above(s, p, j, lo, hi, t)) /* Simpson's rule is exact for a parabola */
            height += (t[1] - t[0]) / 6 *
                      (height_in(s, p, gravity, j, t[0]) + 4 * height_in(s, p, gravity, j, (t[0] + t[1]) / 2) +
                       height_in(s, p, gravity, j, t[1]));
    a->height += v * height;
}

static void add_roll(const struct ceduo_trajectory_segment *p, double lo, double hi, struct stretch_sums *a)
{
    double start = square(p->vx) + square(p->vz), rate = (square(p->vx1) + square(p->vz1) - start) / (p->x1 - p->x);
    double a2 = fmax(0, start + rate * (lo - p->x)), b2 = fmax(0, start + rate * (hi - p->x));
    double sum = sqrt(a2) + sqrt(b2);
    a->speed += sum > 0 ? (hi - lo) * 2 / 3 * (a2 + sqrt(a2 * b2) + b2) / sum : 0; /* untaken: rounding */
    a->speed2 += (hi - lo) * (a2 + b2) / 2;
    a->roll2 += (hi - lo) * (a2 + b2) / 2;
}

/* ---- one rock ---- */

static void on_piece(void *context, const struct ceduo_trajectory_segment *p)
{
    struct recorder *r = context;
    const struct ceduo_record_def *def = r->def;
    double speed = sqrt(max(square(p->vx) + square(p->vz), square(p->vx1) + square(p->vz1)));
    r->rock->largest_speed = max(r->rock->largest_speed, speed);
    if (!p->rolls)
        r->rock->largest_height = max(r->rock->largest_height, largest_height(def->scene, p));
    for (size_t i = 0; i < def->stretches_count; i++) {
        double lo = max(fmin(p->x, p->x1), def->stretches[i].from), hi = fmin(max(p->x, p->x1), def->stretches[i].to);
        r->sums[i].length += hi > lo ? hi - lo : 0;
        if (hi > lo && p->rolls)
            add_roll(p, lo, hi, &r->sums[i]);
        else if (hi > lo)
            add_flight(def->scene, p, lo, hi, &r->sums[i]);
    }
}

static void on_stem(void *context, const struct ceduo_stem_encounter *stem)
{
    struct recorder *r = context;
    struct ceduo_record *record = r->record;
    if (!stem->hit)
        return;
    struct ceduo_stem_impact *grown = ceduo_grow(record->blows, record->blows_count, &r->blows_capacity, sizeof *grown);
    if (!grown) {
        r->no_memory = true;
        return;
    }
    record->blows = grown;
    record->blows[record->blows_count++] =
        (struct ceduo_stem_impact){(uint64_t)(r->rock - record->rocks), stem->x, stem->clearance};
}

static bool is_cancelled(void *context)
{
    const struct recorder *r = context;
    return r->no_memory || ceduo_cancelled(r->def->cancel);
}

static enum ceduo_status record_rock(struct recorder *r, struct ceduo_tracer *follower, uint64_t rock)
{
    const struct ceduo_record_def *def = r->def;
    const struct ceduo_trajectory_callbacks callbacks = {
        .is_cancelled = is_cancelled, .segment = on_piece, .stem = def->blows ? on_stem : NULL, .context = r};
    struct ceduo_trajectory trajectory;
    size_t first = r->record->blows_count;
    if (is_cancelled(r))
        return CEDUO_CANCELLED;
    r->rock = &r->record->rocks[rock];
    *r->rock = (struct ceduo_rock_record){.stop_x = NAN};
    for (size_t i = 0; i < def->stretches_count; i++)
        r->sums[i] = (struct stretch_sums){0};
    enum ceduo_status status =
        ceduo_tracer_run(follower, rock, &callbacks, &trajectory, &r->record->crossings[rock * def->scene->controls_count]);
    if (status != CEDUO_OK || r->no_memory)
        return r->no_memory ? CEDUO_NO_MEMORY : status;
    r->rock->mass = trajectory.rock.mass;
    r->rock->moment = trajectory.rock.moment;
    r->rock->stop_x = trajectory.end == CEDUO_END_AT_REST || trajectory.end == CEDUO_END_STOPPED_BY_STEMS ? trajectory.x : NAN;
    for (size_t i = 0; i < def->stretches_count; i++) {
        const struct stretch_sums *a = &r->sums[i]; /* rocks do not spin by the lumped law */
        bool spins = def->scene->simulation.law != CEDUO_LAW_LUMPED;
        double spin2 = spins ? a->spin2 + a->roll2 / square(trajectory.rock.radius) : 0;
        double length = a->length > 0 ? a->length : NAN;
        double energy = (trajectory.rock.mass * a->speed2 + trajectory.rock.moment * spin2) / 2;
        r->record->means[rock * def->stretches_count + i] =
            (struct ceduo_stretch_means){a->length, a->speed / length, a->height / length, energy / length};
    }
    for (size_t i = first; i < r->record->blows_count; i++)
        r->record->blows[i].height += trajectory.rock.radius;
    return CEDUO_OK;
}

struct ceduo_record_def ceduo_record_def_default(const struct ceduo_scene *scene)
{
    return (struct ceduo_record_def){.size = sizeof(struct ceduo_record_def), .scene = scene, .rocks = scene->simulation.rocks};
}

enum ceduo_status ceduo_record(const struct ceduo_record_def *def, struct ceduo_record *record)
{
    struct recorder r = {.def = def, .record = record};
    *record = (struct ceduo_record){0};
    enum ceduo_status status = def->size == sizeof *def ? ceduo_scene_check(def->scene, NULL) : CEDUO_BAD_ARGUMENT;
    bool good = def->rocks <= CEDUO_ROCKS_MAX && (def->stretches || def->stretches_count == 0);
    if (status == CEDUO_OK && !(good && ceduo_option_has_lists(def->option)))
        status = CEDUO_BAD_ARGUMENT;
    if (status != CEDUO_OK)
        return status;
    struct ceduo_tracer *follower = ceduo_tracer_create(def->scene, def->option);
    size_t n = (size_t)def->rocks;
    *record = (struct ceduo_record){.rocks_count = def->rocks};
    record->rocks = calloc(n + 1, sizeof *record->rocks);
    record->crossings = calloc(n * def->scene->controls_count + 1, sizeof *record->crossings);
    record->means = calloc(n * def->stretches_count + 1, sizeof *record->means);
    r.sums = calloc(def->stretches_count + 1, sizeof *r.sums);
    bool ready = follower && record->rocks && record->crossings && record->means && r.sums;
    status = ready ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (uint64_t i = 0; status == CEDUO_OK && i < def->rocks; i++)
        status = record_rock(&r, follower, i);
    free(r.sums);
    ceduo_tracer_free(follower);
    if (status != CEDUO_OK)
        ceduo_record_release(record);
    return status;
}

void ceduo_record_release(struct ceduo_record *record)
{
    free(record->rocks);
    free(record->crossings);
    free(record->means);
    free(record->blows);
    *record = (struct ceduo_record){0};
}
