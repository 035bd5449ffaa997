/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "line_scene.h"
#include "ceduo/simulate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"

void line_scene_init(struct line_scene *s, size_t vertices, const double *x, const double *z, struct line_ground ground,
                     double radius, enum ceduo_law law)
{
    memset(s, 0, sizeof *s);
    memcpy(s->x, x, vertices * sizeof *x);
    memcpy(s->z, z, vertices * sizeof *z);
    for (size_t j = 0; j + 1 < vertices; j++)
        s->segments[j] = (struct ceduo_segment){.rn = ceduo_number(ground.rn),
                                                .rt = ceduo_number(ground.rt),
                                                .roughness_m = 0,
                                                .roughness_rad = NAN,
                                                .friction = ground.friction};
    struct ceduo_scene *scene = &s->scene;
    scene->size = sizeof *scene;
    scene->rock = ceduo_scene_default().rock;
    scene->rock.diameter = ceduo_number(2 * radius);
    scene->slope = (struct ceduo_slope){
        .facets = CEDUO_FACETS_AGAINST, .vertices = vertices, .x = s->x, .z = s->z, .segments = s->segments};
    scene->controls = &s->control;
    scene->options = &s->option;
    scene->options_count = 1;
    scene->simulation = ceduo_scene_default().simulation;
    scene->simulation.law = law;
}

void line_scene_release(struct line_scene *s, double x, double height, double vx, double vz, double spin)
{
    s->scene.release = (struct ceduo_release){.x = ceduo_number(x),
                                              .height = ceduo_number(height),
                                              .vx = ceduo_number(vx),
                                              .vz = ceduo_number(vz),
                                              .spin = ceduo_number(spin)};
}

void line_scene_drop(struct line_scene *s, double radius, double accepted)
{
    static const double x[] = {0, 100}, z[] = {0, 0};
    line_scene_init(s, 2, x, z, (struct line_ground){.3, .8, .5}, radius, CEDUO_LAW_LUMPED);
    line_scene_release(s, 1, 50, 3, 0, 0);
    s->scene.simulation.gravity = 4;
    s->control = (struct ceduo_control){.x = 4, .x_given = 4, .accepted = accepted, .measured_speed = NAN};
    s->scene.controls_count = 1;
}

/* ---- slopes ---- */

struct ceduo_slope slope_new(size_t vertices)
{
    struct ceduo_slope s = {.facets = CEDUO_FACETS_AGAINST, .vertices = vertices};
    s.x = malloc(vertices * sizeof *s.x);
    s.z = malloc(vertices * sizeof *s.z);
    s.segments = malloc(vertices * sizeof *s.segments);
    if (!s.x || !s.z || !s.segments)
        abort();
    return s;
}

void slope_free(struct ceduo_slope *s)
{
    free(s->x);
    free(s->z);
    free(s->segments);
}

struct ceduo_slope slope_cut(const struct ceduo_slope *from, size_t vertices)
{
    struct ceduo_slope to = slope_new(vertices);
    double end = from->x[from->vertices - 1];
    size_t i = 0;
    for (size_t j = 0; j + 1 < from->vertices; j++) {
        size_t last = (size_t)(from->x[j + 1] / end * (double)(vertices - 1) + 0.5), first = i;
        for (; i < last; i++) {
            double share = (double)(i - first) / (double)(last - first);
            to.x[i] = from->x[j] + share * (from->x[j + 1] - from->x[j]);
            to.z[i] = from->z[j] + share * (from->z[j + 1] - from->z[j]);
            to.segments[i] = from->segments[j];
        }
    }
    to.x[i] = end;
    to.z[i] = from->z[from->vertices - 1];
    return to;
}

/* ---- random scenes ---- */

static uint64_t next(struct line_random *r)
{
    uint64_t v = r->state += 0x9e3779b97f4a7c15U;
    v = (v ^ v >> 30) * 0xbf58476d1ce4e5b9U;
    v = (v ^ v >> 27) * 0x94d049bb133111ebU;
    return v ^ v >> 31;
}

double line_uniform(struct line_random *r, double lo, double hi)
{
    return lo + (double)(next(r) >> 11) * 0x1p-53 * (hi - lo);
}

double line_log_uniform(struct line_random *r, double lo, double hi)
{
    return exp(line_uniform(r, log(lo), log(hi)));
}

bool line_chance(struct line_random *r, double p)
{
    return line_uniform(r, 0, 1) < p;
}

double line_normal(struct line_random *r)
{
    double sum = -6;
    for (int i = 0; i < 12; i++)
        sum += line_uniform(r, 0, 1);
    return sum;
}

static size_t random_profile(struct line_scene *s, struct line_random *r)
{
    size_t n = (size_t)line_log_uniform(r, 1, LINE_SEGMENTS_MAX + 0.999);
    int style = (int)line_uniform(r, 0, 4);
    double spacing = line_log_uniform(r, 0.05, 5), fall = line_uniform(r, -0.3, 1.5);
    double noise = spacing * line_log_uniform(r, 0.01, 1);
    bool survey = line_chance(r, 0.3);
    double x = 0, z = 0;
    for (size_t i = 0; i <= n; i++) {
        double given = survey ? (480000 + x) - 480000 : x;
        s->x[i] = i > 0 && !(given > s->x[i - 1]) ? nextafter(s->x[i - 1], INFINITY) : given;
        s->z[i] = i > 0 && style == 0 ? z + noise * line_uniform(r, -1, 1) : z;
        x = s->x[i];
        double dx, dz;
        if (style == 0) { /* noise about a slope */
            dx = spacing * line_uniform(r, 0.5, 1.5);
            dz = -fall * dx;
        } else if (style == 1) { /* long slopes */
            dx = line_uniform(r, 1, 30);
            dz = dx * line_uniform(r, -2, 1);
        } else if (style == 2) { /* walls and slivers */
            bool sliver = line_chance(r, 0.2);
            dx = sliver ? line_log_uniform(r, 1e-9, 1e-3) : line_log_uniform(r, 0.01, 10);
            dz = sliver ? line_uniform(r, -5, 2) : dx * line_uniform(r, -1.5, 0.7);
            if (sliver && line_chance(r, 0.3))
                dz = dx * line_uniform(r, -1, 1);
        } else { /* level steps on a grid that loses no bit */
            dx = 0.25 * floor(line_uniform(r, 1, 9));
            dz = line_chance(r, 0.4) ? 0 : 0.125 * floor(line_uniform(r, -9, 4));
        }
        x += dx;
        z += dz;
    }
    return n + 1;
}

static double random_share(struct line_random *r, double lo, double hi)
{
    return line_chance(r, 0.04) ? 0 : line_uniform(r, lo, hi);
}

static void random_segment(struct ceduo_segment *to, struct line_random *r, double radius, double rough)
{
    bool angle = line_chance(r, 0.5);
    double largest = line_uniform(r, 0, rough);
    *to = (struct ceduo_segment){.rn = ceduo_number(random_share(r, 0.02, 0.95)),
                                 .rt = ceduo_number(random_share(r, 0.3, 0.98)),
                                 .roughness_m = angle ? NAN : radius * tan(largest),
                                 .roughness_rad = angle ? largest : NAN,
                                 .friction = line_chance(r, 0.15) ? 0 : line_uniform(r, 0.01, 1.2)};
}

static void random_ground(struct line_scene *s, struct line_random *r, double radius, bool lasting)
{
    double rough = line_chance(r, 0.4) ? 0 : line_chance(r, 0.1) ? 1.5 : 0.5;
    bool equal = line_chance(r, 0.5), ones = line_chance(r, 0.05);
    for (size_t j = 0; j + 1 < s->scene.slope.vertices; j++) {
        struct ceduo_segment *to = &s->segments[j];
        if (equal && j > 0)
            *to = s->segments[0];
        else
            random_segment(to, r, radius, rough);
        /* Rt or Rn is 1, but another value still brakes */
        if (ones && s->scene.simulation.law == CEDUO_LAW_CRSP)
            to->rn.mean = 1;
        else if (ones && to->friction > 0.05)
            to->rt.mean = 1;
        if (lasting && line_chance(r, 0.7))
            to->rt.mean = 1;
        if (lasting && line_chance(r, 0.5))
            to->rn.mean = 1;
        if (lasting && line_chance(r, 0.5))
            to->friction = 0;
    }
}

static double random_speed(struct line_random *r)
{
    return line_chance(r, 0.25) ? 0 : line_uniform(r, -10, 15);
}

double line_facet_draw(uint64_t seed, uint64_t rock, uint64_t contact)
{
    return random_pair(seed, rock, contact >> 1, RANDOM_FACET).u[contact & 1];
}

void line_scene_random(struct line_scene *s, uint64_t number, unsigned lasting_every)
{
    struct line_random random = {.state = number * 0xd1342543de82ef95U + 17}, *r = &random;
    bool lasting = lasting_every > 0 && number % lasting_every == lasting_every - 1;
    double radius = line_log_uniform(r, 0.005, 5);
    line_scene_init(s, 0, s->x, s->z, (struct line_ground){0}, radius, line_chance(r, 0.5) ? CEDUO_LAW_LUMPED : CEDUO_LAW_CRSP);
    struct ceduo_scene *scene = &s->scene;
    scene->slope.vertices = random_profile(s, r);
    scene->slope.facets = line_chance(r, 0.5) ? CEDUO_FACETS_AGAINST : CEDUO_FACETS_BOTH;
    scene->simulation.scale_rn = line_chance(r, 0.2);
    scene->simulation.seed = number;
    scene->simulation.gravity = line_chance(r, 0.8) ? CEDUO_GRAVITY : line_log_uniform(r, 1, 30);
    random_ground(s, r, radius, lasting);
    double end = s->x[scene->slope.vertices - 1];
    double at = end * (line_chance(r, 0.1) ? 0 : line_uniform(r, 0, 0.9));
    if (line_chance(r, 0.1)) /* on a vertex */
        at = s->x[(size_t)line_uniform(r, 0, (double)scene->slope.vertices - 1)];
    double spin = line_chance(r, 0.3) ? 0 : line_uniform(r, -20, 20);
    double vz = random_speed(r) - 2, vx = random_speed(r);
    line_scene_release(s, at, line_chance(r, 0.3) ? 0 : line_log_uniform(r, 1e-3, 20), vx, vz, spin);
    s->control =
        (struct ceduo_control){.x = at + (end - at) * line_uniform(r, 0.01, 1), .accepted = NAN, .measured_speed = NAN};
    scene->controls_count = 1;
    scene->simulation.friction_bound = line_chance(r, 0.5); /* drawn last, so that the other draws of a scene do not change */
}

void line_scene_arm(struct line_scene *s, uint64_t number)
{
    struct line_random random = {.state = number * 0x2545f4914f6cdd1dU + 3}, *r = &random;
    struct ceduo_rock_def *rock = &s->scene.rock;
    double size = rock->diameter.mean;
    s->scene.simulation.law = CEDUO_LAW_ARM;
    rock->shape = line_chance(r, 0.2) ? CEDUO_SHAPE_SPHERE : line_chance(r, 0.5) ? CEDUO_SHAPE_ELLIPSOID : CEDUO_SHAPE_CYLINDER;
    rock->height = ceduo_number(size * line_uniform(r, 0.3, 3));
    for (int i = 0; i < 3; i++)
        rock->axes[i] = ceduo_number(size * line_uniform(r, 0.4, 2));
    bool equal = line_chance(r, 0.5);
    for (size_t j = 0; j + 1 < s->scene.slope.vertices; j++)
        s->segments[j].mu = equal && j > 0 ? s->segments[0].mu : line_chance(r, 0.05) ? 0 : line_uniform(r, 0, 3);
}

bool line_scene_lasts(const struct line_scene *s)
{
    const struct ceduo_simulation *sim = &s->scene.simulation;
    for (size_t j = 0; j + 1 < s->scene.slope.vertices; j++) {
        const struct ceduo_segment *at = &s->segments[j];
        if (sim->law == CEDUO_LAW_ARM && (at->rn.mean == 1 || at->friction == 0))
            return true;
        bool bounces = at->rn.mean == 1 && sim->law == CEDUO_LAW_LUMPED && !sim->scale_rn;
        if (bounces || (at->rt.mean == 1 && at->friction == 0))
            return true;
    }
    return false;
}

/* ---- simulation ---- */

void line_keep_piece(void *context, const struct ceduo_trajectory_segment *piece)
{
    struct line_trace *to = context;
    if (to->count < LINE_PIECES_MAX)
        to->pieces[to->count++] = *piece;
}

enum ceduo_status line_scene_follow(const struct line_scene *s, struct line_trace *to)
{
    to->count = 0;
    return ceduo_trajectory_run(&s->scene, NULL, 0,
                                &(struct ceduo_trajectory_callbacks){.segment = line_keep_piece, .context = to},
                                &to->trajectory, &to->crossing);
}
