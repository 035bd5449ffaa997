/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "outlook.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- ways ---- */

#define TRAIL_POINTS_MOST  20000 /* of a rock that hops on and on: what comes later is left out */
#define FLIGHT_POINTS_MOST 64
#define RESOLUTION         2000 /* parts of the slope's length that a picture may show */

struct tracer {
    struct ceduo_trail *trail;
    size_t room;
    double gravity, step;
    bool failed;
};

static bool make_room(struct tracer *t)
{
    struct ceduo_trail *trail = t->trail;
    if (trail->n < t->room)
        return true;
    size_t room = t->room > 0 ? 2 * t->room : 64;
    double *x = realloc(trail->x, room * sizeof *x);
    trail->x = x ? x : trail->x;
    double *z = x ? realloc(trail->z, room * sizeof *z) : NULL;
    trail->z = z ? z : trail->z;
    t->failed |= !x || !z;
    t->room = t->failed ? t->room : room;
    return !t->failed;
}

/* Leaves out what no picture could tell from the point before. */
static void add_point(struct tracer *t, double x, double z, bool always)
{
    struct ceduo_trail *trail = t->trail;
    bool near =
        trail->n > 0 && fabs(x - trail->x[trail->n - 1]) < t->step && fabs(z - trail->z[trail->n - 1]) < t->step;
    if ((near || trail->n >= TRAIL_POINTS_MOST) && !always)
        return;
    if (t->failed || !make_room(t))
        return;
    trail->x[trail->n] = x;
    trail->z[trail->n++] = z;
}

/* A flight in chords from which the parabola departs by less than a step: it departs by g t2/8 from one over t. */
static void trace_piece(void *context, const struct ceduo_piece *p)
{
    struct tracer *t = context;
    if (t->trail->n == 0)
        add_point(t, p->x, p->z, true);
    double sag = t->gravity * p->seconds * p->seconds / 8;
    int n = p->rolls ? 1 : (int)fmin(ceil(sqrt(sag / t->step)), FLIGHT_POINTS_MOST);
    for (int i = 1; i < n; i++) {
        double s = p->seconds * i / n;
        add_point(t, p->x + p->vx * s, p->z + (p->vz - 0.5 * t->gravity * s) * s, false);
    }
    add_point(t, p->x1, p->z1, false);
}

static enum ceduo_status trace(const struct ceduo_follower *follower, const struct ceduo_scene *scene, uint64_t rock,
                               struct ceduo_trail *trail)
{
    const struct ceduo_slope *slope = &scene->slope;
    *trail = (struct ceduo_trail){0};
    struct tracer tracer = {.trail = trail,
                            .gravity = scene->simulation.gravity,
                            .step = (slope->x[slope->vertices - 1] - slope->x[0]) / RESOLUTION};
    struct ceduo_way way;
    enum ceduo_status status = ceduo_follower_follow(follower, rock, trace_piece, &tracer, &way, NULL);
    if (status == CEDUO_OK)
        add_point(&tracer, way.x, way.z, true);
    return tracer.failed ? CEDUO_NO_MEMORY : status;
}

enum ceduo_status ceduo_trail_follow(const struct ceduo_scene *scene, uint64_t rock, struct ceduo_trail *trail)
{
    *trail = (struct ceduo_trail){0};
    struct ceduo_follower *follower = ceduo_follower_create(scene);
    enum ceduo_status status = follower ? trace(follower, scene, rock, trail) : CEDUO_NO_MEMORY;
    ceduo_follower_free(follower);
    return status;
}

void ceduo_trail_free(struct ceduo_trail *trail)
{
    free(trail->x);
    free(trail->z);
    *trail = (struct ceduo_trail){0};
}

static enum ceduo_status follow_trails(const struct ceduo_scene *scene, size_t trails, struct ceduo_outlook *o)
{
    trails = trails < o->rocks ? trails : (size_t)o->rocks;
    o->trails = calloc(trails + 1, sizeof *o->trails);
    struct ceduo_follower *follower = o->trails ? ceduo_follower_create(scene) : NULL;
    enum ceduo_status status = follower ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < trails && status == CEDUO_OK; i++)
        status = trace(follower, scene, i, &o->trails[o->trails_count++]);
    ceduo_follower_free(follower);
    return status;
}

/* ---- places ---- */

size_t ceduo_outlook_places(const struct ceduo_scene *scene, double *x)
{
    double from = ceduo_number_highest(scene->release.x), to = scene->slope.x[scene->slope.vertices - 1];
    if (!(to > from))
        return 0;
    for (size_t i = 0; i < CEDUO_OUTLOOK_CELLS; i++)
        x[i] = from + (to - from) * ((double)i + 0.5) / CEDUO_OUTLOOK_CELLS;
    return CEDUO_OUTLOOK_CELLS;
}

static enum ceduo_status read_envelopes(const struct ceduo_run *run, size_t cells, const double *cell_x,
                                        struct ceduo_outlook *o)
{
    o->cell_x = malloc((cells + 1) * sizeof *o->cell_x);
    o->envelopes = calloc(cells + 1, sizeof *o->envelopes);
    if (!o->cell_x || !o->envelopes)
        return CEDUO_NO_MEMORY;
    o->cells = cells;
    for (size_t i = 0; i < cells; i++) {
        o->cell_x[i] = cell_x[i];
        ceduo_run_envelope(run, i, &o->envelopes[i]);
    }
    return CEDUO_OK;
}

/* ---- energies ---- */

#define FLOWN_MOST 4000 /* rocks flown once more where a run is too long to keep its samples */

static enum ceduo_status fly_energies(const struct ceduo_scene *scene, struct ceduo_outlook *o)
{
    uint64_t rocks = o->rocks < FLOWN_MOST ? o->rocks : FLOWN_MOST;
    struct ceduo_crossing *crossings = calloc(o->controls + 1, sizeof *crossings);
    struct ceduo_follower *follower = crossings ? ceduo_follower_create(scene) : NULL;
    enum ceduo_status status = follower ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (uint64_t rock = 0; rock < rocks && status == CEDUO_OK; rock++) {
        struct ceduo_way way;
        status = ceduo_follower_follow(follower, rock, NULL, NULL, &way, crossings);
        for (size_t c = 0; c < o->controls && status == CEDUO_OK; c++) {
            const struct ceduo_crossing *at = &crossings[c];
            double energy = 0.5 * way.rock.mass * (at->vx * at->vx + at->vz * at->vz) +
                            0.5 * way.rock.moment * (at->spin * at->spin);
            if (at->reached)
                o->energies[c].values[o->energies[c].n++] = energy;
        }
    }
    ceduo_follower_free(follower);
    free(crossings);
    return status;
}

static enum ceduo_status read_energies(const struct ceduo_scene *scene, const struct ceduo_run *run,
                                       struct ceduo_outlook *o)
{
    bool kept = true;
    for (size_t c = 0; c < o->controls; c++) {
        struct ceduo_energies *e = &o->energies[c];
        uint64_t reached = o->arrivals[c].reached;
        size_t most = reached < CEDUO_OUTLOOK_SAMPLE ? (size_t)reached : CEDUO_OUTLOOK_SAMPLE;
        e->values = malloc(((most > FLOWN_MOST ? most : FLOWN_MOST) + 1) * sizeof *e->values);
        if (!e->values)
            return CEDUO_NO_MEMORY;
        e->n = ceduo_run_energies(run, c, e->values, most);
        kept &= e->n > 0 || reached == 0;
    }
    for (size_t c = 0; c < o->controls && !kept; c++)
        o->energies[c].n = 0;
    return kept ? CEDUO_OK : fly_energies(scene, o);
}

static enum ceduo_status read_controls(const struct ceduo_scene *scene, const struct ceduo_run *run,
                                       struct ceduo_outlook *o)
{
    size_t n = scene->controls_count;
    o->arrivals = calloc(n + 1, sizeof *o->arrivals);
    o->energies = calloc(n + 1, sizeof *o->energies);
    if (!o->arrivals || !o->energies)
        return CEDUO_NO_MEMORY;
    o->controls = n;
    enum ceduo_status status = CEDUO_OK;
    for (size_t c = 0; c < n && status == CEDUO_OK; c++)
        status = ceduo_run_arrivals(run, c, &o->arrivals[c]);
    return status == CEDUO_OK ? read_energies(scene, run, o) : status;
}

enum ceduo_status ceduo_outlook_create(const struct ceduo_scene *scene, const struct ceduo_run *run,
                                       const struct ceduo_run *with_cells, size_t cells, const double *cell_x,
                                       size_t trails, struct ceduo_outlook **outlook)
{
    *outlook = NULL;
    struct ceduo_outlook *o = calloc(1, sizeof *o);
    if (!o)
        return CEDUO_NO_MEMORY;
    o->rocks = ceduo_run_rocks(run);
    o->contacts = ceduo_run_contacts(run);
    enum ceduo_status status = read_envelopes(with_cells ? with_cells : run, cells, cell_x, o);
    if (status == CEDUO_OK)
        status = read_controls(scene, run, o);
    if (status == CEDUO_OK)
        status = ceduo_run_ends(run, &o->ends);
    if (status == CEDUO_OK)
        status = follow_trails(scene, trails, o);
    if (status == CEDUO_OK)
        *outlook = o;
    else
        ceduo_outlook_free(o);
    return status;
}

void ceduo_outlook_free(struct ceduo_outlook *o)
{
    if (!o)
        return;
    free(o->cell_x);
    free(o->envelopes);
    free(o->arrivals);
    for (size_t c = 0; c < o->controls; c++)
        free(o->energies[c].values);
    free(o->energies);
    for (size_t i = 0; i < o->trails_count; i++)
        ceduo_trail_free(&o->trails[i]);
    free(o->trails);
    free(o);
}
