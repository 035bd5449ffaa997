/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Copies results of runs for pictures. The snapshot of a run holds arrivals, envelopes, some energies and some trajectories.
 * It is reference-counted: a snapshot shares unchanged runs with the last one. */
#include "snapshot.h"
#include "core/runs/key.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "scene/derived.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/parallel.h"

/* ---- trajectories ---- */

#define LINE_POINTS_MAX   20000 /* per rock; later points are left out */
#define FLIGHT_POINTS_MAX 64
#define RESOLUTION        2000 /* smallest distance shown is the slope's length over this */

/* The polyline of the current trajectory. */
struct tracer {
    const atomic_bool *cancel;
    double gravity, step;
    size_t n;
    double x[LINE_POINTS_MAX + 1], z[LINE_POINTS_MAX + 1]; /* + 1: the last point is always kept */
};

static bool is_cancelled(void *context)
{
    const struct tracer *t = context;
    return ceduo_cancelled(t->cancel);
}

/* Append a point, unless it is closer to the last one than the resolution of pictures. */
static void add_point(struct tracer *t, double x, double z, bool always)
{
    bool near = t->n > 0 && fabs(x - t->x[t->n - 1]) < t->step && fabs(z - t->z[t->n - 1]) < t->step;
    if ((near || t->n >= LINE_POINTS_MAX) && !always)
        return;
    t->x[t->n] = x;
    t->z[t->n++] = z;
}

/* Append a segment. A flight becomes chords that deviate from the parabola by at most a step; a chord over time t deviates by
 * g t2/8. */
static void trace_segment(void *context, const struct ceduo_trajectory_segment *p)
{
    struct tracer *t = context;
    if (t->n == 0)
        add_point(t, p->x, p->z, true);
    double sag = t->gravity * p->seconds * p->seconds / 8;
    int n = p->rolls ? 1 : (int)fmin(ceil(sqrt(sag / t->step)), FLIGHT_POINTS_MAX);
    for (int i = 1; i < n; i++) {
        double s = p->seconds * i / n;
        add_point(t, p->x + p->vx * s, p->z + (p->vz - 0.5 * t->gravity * s) * s, false);
    }
    add_point(t, p->x1, p->z1, false);
}

static enum ceduo_status trace(struct ceduo_tracer *follower, uint64_t rock, struct tracer *t, struct arena *memory,
                               struct ceduo_polyline *line)
{
    struct ceduo_trajectory trajectory;
    const struct ceduo_trajectory_callbacks callbacks = {.is_cancelled = is_cancelled, .segment = trace_segment, .context = t};
    t->n = 0;
    enum ceduo_status status = ceduo_tracer_run(follower, rock, &callbacks, &trajectory, NULL);
    if (status != CEDUO_OK)
        return status;
    add_point(t, trajectory.x, trajectory.z, true);
    double *x = ceduo_arena_alloc(memory, 2 * t->n * sizeof *x);
    if (!x) /* untaken: memory */
        return CEDUO_NO_MEMORY;
    *line = (struct ceduo_polyline){t->n, x, x + t->n};
    memcpy(line->x, t->x, t->n * sizeof *t->x);
    memcpy(line->z, t->z, t->n * sizeof *t->z);
    return CEDUO_OK;
}

/* ---- one run ---- */

static void place_cells(const struct ceduo_scene *scene, double *x)
{
    double from = ceduo_scene_release_last(scene), to = scene->slope.x[scene->slope.vertices - 1];
    for (size_t i = 0; i < CEDUO_SNAPSHOT_CELLS; i++)
        x[i] = from + (to - from) * ((double)i + 0.5) / CEDUO_SNAPSHOT_CELLS;
}

static enum ceduo_status read_energies(const struct ceduo_run *run, struct ceduo_run_snapshot *s)
{
    for (size_t c = 0; c < s->simulated.controls; c++) {
        struct ceduo_energies *e = &s->energies[c];
        uint64_t reached = s->simulated.arrivals[c].reached;
        size_t max = reached < CEDUO_SNAPSHOT_SAMPLE ? (size_t)reached : CEDUO_SNAPSHOT_SAMPLE;
        e->values = ceduo_arena_alloc(&s->memory, (max + 1) * sizeof *e->values);
        if (!e->values)
            return CEDUO_NO_MEMORY;
        e->n = ceduo_run_energies(run, c, e->values, max);
    }
    return CEDUO_OK;
}

static void release_run_snapshot(struct ceduo_run_snapshot *s)
{
    if (!s || atomic_fetch_sub(&s->references, 1) != 1)
        return;
    ceduo_simulated_release(&s->simulated);
    ceduo_arena_free(&s->memory);
    free(s);
}

static struct ceduo_run_snapshot *find_run_snapshot(const struct ceduo_snapshot *o, uint64_t key)
{
    for (size_t i = 0; o && i <= o->options; i++) {
        struct ceduo_run_snapshot *s = i == 0 ? o->bare : o->wooded[i - 1];
        if (s && s->key == key)
            return s;
    }
    return NULL;
}

/* Set the envelopes. Copies those of the last snapshot if their number of rocks is unchanged. */
static enum ceduo_status read_envelopes(const struct ceduo_snapshot_def *def, const struct ceduo_snapshot *o,
                                        const struct ceduo_option *option, struct ceduo_run_snapshot *s)
{
    const struct ceduo_run_snapshot *last = find_run_snapshot(def->last, s->key);
    if (o->cells == 0)
        return CEDUO_OK;
    s->envelope_rocks = s->simulated.rocks < def->envelope_rocks ? s->simulated.rocks : def->envelope_rocks;
    if (last && last->envelope_rocks == s->envelope_rocks) {
        memcpy(s->envelopes, last->envelopes, o->cells * sizeof *s->envelopes);
        return CEDUO_OK;
    }
    const struct ceduo_envelopes_def envelopes = {.scene = def->scene,
                                                  .option = option,
                                                  .rocks = s->envelope_rocks,
                                                  .places = o->cells,
                                                  .x = o->cell_x,
                                                  .cancel = def->cancel};
    return ceduo_envelopes(&envelopes, s->envelopes);
}

static enum ceduo_status read_run_snapshot(const struct ceduo_snapshot_def *def, const struct ceduo_snapshot *o,
                                           const struct ceduo_option *option, const struct ceduo_run *run,
                                           struct ceduo_run_snapshot *s)
{
    const struct ceduo_slope *slope = &def->scene->slope;
    size_t controls = def->scene->controls_count;
    enum ceduo_status status = ceduo_simulated_read(run, def->scene, o->bare ? &o->bare->simulated : NULL, &s->simulated);
    if (status != CEDUO_OK)
        return status;
    size_t trajectories = def->trajectories < s->simulated.rocks ? def->trajectories : (size_t)s->simulated.rocks;
    s->energies = ceduo_arena_alloc(&s->memory, (controls + 1) * sizeof *s->energies);
    s->envelopes = ceduo_arena_alloc(&s->memory, (o->cells + 1) * sizeof *s->envelopes);
    s->trajectories = ceduo_arena_alloc(&s->memory, (trajectories + 1) * sizeof *s->trajectories);
    struct ceduo_tracer *follower = ceduo_tracer_create(def->scene, option);
    struct tracer *tracer = malloc(sizeof *tracer);
    status = !s->memory.failed && follower && tracer ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (tracer) {
        tracer->cancel = def->cancel;
        tracer->gravity = def->scene->simulation.gravity;
        tracer->step = (slope->x[slope->vertices - 1] - slope->x[0]) / RESOLUTION;
    }
    if (status == CEDUO_OK)
        status = read_envelopes(def, o, option, s);
    if (status == CEDUO_OK)
        status = read_energies(run, s);
    for (size_t i = 0; i < trajectories && status == CEDUO_OK; i++)
        status = trace(follower, i, tracer, &s->memory, &s->trajectories[s->trajectories_count++]);
    free(tracer);
    ceduo_tracer_free(follower);
    return status;
}

/* ---- all runs ---- */

/* Return the run of a forest; NULL: no rocks yet. */
static const struct ceduo_run *find_run(const struct ceduo_snapshot_def *def, const struct ceduo_option *option)
{
    const struct ceduo_run *run = ceduo_pool_find(def->runs, option);
    return run && ceduo_run_rocks(run) > 0 ? run : NULL;
}

/* Set a new reference to the snapshot of a forest's run; NULL: not simulated yet. */
static enum ceduo_status reference_run_snapshot(const struct ceduo_snapshot_def *def, const struct ceduo_snapshot *o,
                                                const struct ceduo_option *option, struct ceduo_run_snapshot **found)
{
    const struct ceduo_run *run = find_run(def, option);
    *found = NULL;
    if (!run)
        return CEDUO_OK;
    uint64_t key = ceduo_option_key(def->scene, option), rocks = ceduo_run_rocks(run);
    struct ceduo_run_snapshot *s = find_run_snapshot(o, key);
    s = s ? s : find_run_snapshot(def->last, key);
    if (s && s->simulated.rocks == rocks && s->fence_key == ceduo_controls_key(def->scene)) {
        atomic_fetch_add(&s->references, 1);
        *found = s;
        return CEDUO_OK;
    }
    s = calloc(1, sizeof *s);
    if (!s)
        return CEDUO_NO_MEMORY;
    atomic_init(&s->references, 1);
    s->key = key;
    s->fence_key = ceduo_controls_key(def->scene);
    enum ceduo_status status = read_run_snapshot(def, o, option, run, s);
    if (status == CEDUO_OK)
        *found = s;
    else
        release_run_snapshot(s);
    return status;
}

enum ceduo_status ceduo_snapshot_create(const struct ceduo_snapshot_def *def, struct ceduo_snapshot **snapshot)
{
    const struct ceduo_scene *scene = def->scene;
    struct ceduo_snapshot *o = *snapshot = calloc(1, sizeof *o);
    if (!o)
        return CEDUO_NO_MEMORY;
    o->controls = scene->controls_count;
    o->cell_x = ceduo_arena_alloc(&o->memory, CEDUO_SNAPSHOT_CELLS * sizeof *o->cell_x);
    o->wooded = ceduo_arena_alloc(&o->memory, (scene->options_count + 1) * sizeof *o->wooded);
    o->differences = ceduo_arena_alloc(&o->memory, (scene->options_count * o->controls + 1) * sizeof *o->differences);
    enum ceduo_status status = o->memory.failed ? CEDUO_NO_MEMORY : CEDUO_OK;
    if (status == CEDUO_OK) {
        o->cells = def->envelope_rocks > 0 ? CEDUO_SNAPSHOT_CELLS : 0;
        place_cells(scene, o->cell_x);
        o->options = scene->options_count;
        status = reference_run_snapshot(def, o, NULL, &o->bare);
    }
    bool flies = scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    for (size_t i = 0; flies && i < o->options && status == CEDUO_OK; i++) {
        const struct ceduo_run *run = find_run(def, &scene->options[i]), *first = find_run(def, &scene->options[0]);
        status = reference_run_snapshot(def, o, &scene->options[i], &o->wooded[i]);
        for (size_t c = 0; c < o->controls; c++)
            o->differences[i * o->controls + c] = ceduo_run_difference(run, first, c);
    }
    if (status != CEDUO_OK) {
        ceduo_snapshot_free(o);
        *snapshot = NULL;
    }
    return status;
}

void ceduo_snapshot_free(struct ceduo_snapshot *o)
{
    if (!o)
        return;
    release_run_snapshot(o->bare);
    for (size_t i = 0; i < o->options; i++)
        release_run_snapshot(o->wooded[i]);
    ceduo_arena_free(&o->memory);
    free(o);
}

const struct ceduo_run_snapshot *ceduo_snapshot_find(const struct ceduo_snapshot *o, const struct ceduo_scene *scene,
                                                     size_t option)
{
    if (!o || scene->simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX)
        return o ? o->bare : NULL;
    if (option >= scene->options_count)
        return NULL;
    const struct ceduo_run_snapshot *found = find_run_snapshot(o, ceduo_option_key(scene, &scene->options[option]));
    if (found)
        return found;
    const struct ceduo_run_snapshot *last = option < o->options ? o->wooded[option] : NULL;
    for (size_t i = 0; last && i < scene->options_count; i++)
        if (ceduo_option_key(scene, &scene->options[i]) == last->key)
            return NULL; /* it belongs to another option now */
    return last;
}
