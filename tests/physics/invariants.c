/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "invariants.h"
#include "ceduo/simulate.h"
#include "scene/rock.h"
#include "scene/slope.h"

#include <math.h>
#include <string.h>

#include "test.h"

#define ENERGY     1e-12
#define UNDER      1e-9  /* m below ground, or */
#define UNDER_SIZE 1e-13 /* this share of the trajectory's largest coordinate */

struct checker {
    const struct line_scene *scene;
    struct ceduo_rock rock;
    double k; /* 0: no spin */
    bool smooth;
    struct ceduo_trajectory_segment last;
    uint64_t pieces, flights, impacts;
    uint64_t in_crack;                               /* segments from wall to wall of a crack */
    double size, under, energy_off, gain, crsp_gain; /* maxima */
    double over_bound, roll_off;                     /* maxima with the friction bound, as a share of the speed */
    bool bad;                                        /* NaN, or a gap between segments */
};

static double kinetic(const struct checker *w, double vx, double vz, double spin)
{
    double rim = spin * w->rock.radius;
    return (vx * vx + vz * vz + w->k * (rim * rim)) / 2;
}

static double spin_at_end(const struct checker *w, const struct ceduo_trajectory_segment *p)
{
    if (!p->rolls || !(w->k > 0))
        return p->spin;
    return (p->vx1 < 0 ? -1 : 1) * hypot(p->vx1, p->vz1) / w->rock.radius;
}

/* Height of a flight's parabola at x, computed from the nearer end. */
static double height_of_flight(const struct ceduo_trajectory_segment *p, double g, double x)
{
    if (fabs(x - p->x) < fabs(x - p->x1)) {
        double t = (x - p->x) / p->vx;
        return p->z + (p->vz - g / 2 * t) * t;
    }
    double t = (x - p->x1) / p->vx1;
    return p->z1 + (p->vz1 - g / 2 * t) * t;
}

static double depth_below(const struct ceduo_slope *s, size_t j, double x, double z)
{
    double dx = s->x[j + 1] - s->x[j], dz = s->z[j + 1] - s->z[j];
    return ((x - s->x[j]) * dz - (z - s->z[j]) * dx) / hypot(dx, dz);
}

static void check_depth(struct checker *w, size_t j, double x, double z)
{
    w->under = fmax(w->under, depth_below(&w->scene->scene.slope, j, x, z));
}

/* The same at an end of a roll. The x of a place on a wall may round to that of the wall's end: then it is on the wall. */
static void check_roll_depth(struct checker *w, size_t j, double x, double z)
{
    const struct ceduo_slope *s = &w->scene->scene.slope;
    double depth = depth_below(s, j, x, z);
    if (j > 0 && x == s->x[j])
        depth = fmin(depth, depth_below(s, j - 1, x, z));
    w->under = fmax(w->under, depth);
}

/* Over a straight segment the flight is concave: it is lowest over the ends of the segment or at its own ends. A vertex at
 * either end belongs to the segment towards the rest of the flight. */
static void check_flight_depth(struct checker *w, const struct ceduo_trajectory_segment *p)
{
    const struct ceduo_slope *s = &w->scene->scene.slope;
    double lo = fmin(p->x, p->x1), hi = fmax(p->x, p->x1), g = w->scene->scene.simulation.gravity;
    size_t j = ceduo_slope_segment(s, lo);
    double x_lo = lo, z_lo = p->x <= p->x1 ? p->z : p->z1, z_hi = p->x <= p->x1 ? p->z1 : p->z;
    for (;; j++) {
        check_depth(w, j, x_lo, z_lo);
        if (j + 2 == s->vertices || s->x[j + 1] >= hi)
            break;
        x_lo = s->x[j + 1];
        z_lo = height_of_flight(p, g, x_lo);
        check_depth(w, j, x_lo, z_lo);
    }
    check_depth(w, j, hi, z_hi);
}

/* Return the size of the coordinates from which a place on the ground is computed. Those of the ends of its segment may be far
 * larger than its own. */
static double size_of_coordinates(const struct ceduo_slope *s, double x, double z)
{
    size_t j = ceduo_slope_segment(s, x);
    double size = fabs(x) + fabs(z);
    for (size_t i = j > 0 && x == s->x[j] ? j - 1 : j; i <= j + 1; i++)
        size = fmax(size, fabs(s->x[i]) + fabs(s->z[i]));
    return size;
}

static void check_flight(struct checker *w, const struct ceduo_trajectory_segment *p)
{
    const struct ceduo_slope *s = &w->scene->scene.slope;
    double g = w->scene->scene.simulation.gravity;
    double v2 = (p->vx * p->vx + p->vz * p->vz) / 2, v2_end = (p->vx1 * p->vx1 + p->vz1 * p->vz1) / 2;
    double scale = v2 + g * size_of_coordinates(s, p->x, p->z);
    double scale_end = v2_end + g * size_of_coordinates(s, p->x1, p->z1);
    double error = fabs((v2 + g * p->z) - (v2_end + g * p->z1));
    if (error > 0)
        w->energy_off = fmax(w->energy_off, error / fmax(scale, scale_end));
    check_flight_depth(w, p);
    w->flights++;
}

/* True for a flight shorter than a micrometre, or a hundredth of the radius, between two facing walls. A rock, a point here,
 * sinks into such a crack in very many contacts, perhaps more than the limit. */
static bool is_in_crack(const struct ceduo_slope *s, double radius, const struct ceduo_trajectory_segment *p)
{
    size_t j = ceduo_slope_segment(s, fmin(p->x, p->x1)), k = ceduo_slope_segment(s, fmax(p->x, p->x1));
    if (j > 0 && fmin(p->x, p->x1) == s->x[j]) /* on the bottom vertex: the wall is the previous segment */
        j--;
    double gradient = (s->z[j + 1] - s->z[j]) / (s->x[j + 1] - s->x[j]);
    double right = (s->z[k + 1] - s->z[k]) / (s->x[k + 1] - s->x[k]);
    return !p->rolls && fabs(p->x1 - p->x) < fmax(1e-6, 1e-2 * radius) && gradient < -1e3 && right > 1e3;
}

/* On the ground a rock gains at most its drop. */
static void check_roll(struct checker *w, const struct ceduo_trajectory_segment *p)
{
    const struct ceduo_slope *s = &w->scene->scene.slope;
    double g = w->scene->scene.simulation.gravity, share = (1 + w->k) / 2;
    double before = share * (p->vx * p->vx + p->vz * p->vz), after = share * (p->vx1 * p->vx1 + p->vz1 * p->vz1);
    double gained = (after + g * p->z1) - (before + g * p->z);
    double scale = fmax(before + g * size_of_coordinates(s, p->x, p->z), after + g * size_of_coordinates(s, p->x1, p->z1));
    if (gained > 0)
        w->energy_off = fmax(w->energy_off, gained / scale);
    /* the middle may round to the far end, and so to the next segment */
    size_t j = ceduo_slope_segment(s, fmin(p->x, p->x1));
    check_roll_depth(w, j, p->x, p->z);
    check_roll_depth(w, j, p->x1, p->z1);
}

/* crsp on a smooth segment: energy along the ground and of spin falls to at most Rt(Rt + (1 - Rt)/1.2) of it. */
static void check_crsp(struct checker *w, const struct ceduo_trajectory_segment *p)
{
    const struct ceduo_slope *s = &w->scene->scene.slope;
    const struct ceduo_simulation *simulation = &w->scene->scene.simulation;
    if (simulation->law != CEDUO_LAW_CRSP || simulation->friction_bound || !w->smooth || p->contacts != w->last.contacts + 1)
        return;
    size_t j = ceduo_slope_segment(s, p->x);
    if (p->x == s->x[j] || p->x == s->x[j + 1])
        return; /* on a vertex: its segment is unknown */
    double dx = s->x[j + 1] - s->x[j], dz = s->z[j + 1] - s->z[j], length = hypot(dx, dz);
    double before = (w->last.vx1 * dx + w->last.vz1 * dz) / length, after = (p->vx * dx + p->vz * dz) / length;
    double rim_before = spin_at_end(w, &w->last) * w->rock.radius, rim_after = p->spin * w->rock.radius;
    double rt = s->segments[j].rt.mean, max = rt * (rt + (1 - rt) / 1.2);
    double e0 = before * before + w->k * rim_before * rim_before, e1 = after * after + w->k * rim_after * rim_after;
    double rounding = 1e-15 * (w->last.vx1 * w->last.vx1 + w->last.vz1 * w->last.vz1 + p->vx * p->vx + p->vz * p->vz);
    if (e1 > max * e0 + rounding && e0 > 1e-280) /* smaller squares lose their bits */
        w->crsp_gain = fmax(w->crsp_gain, e0 > 0 ? e1 / (max * e0) - 1 : INFINITY);
    w->impacts++;
}

/* With the friction bound a rock that continues rolling keeps its speed. A rock that flies from a smooth segment has lost at
 * most friction times the normal impulse along it. */
static void check_bound(struct checker *w, const struct ceduo_trajectory_segment *p)
{
    const struct ceduo_simulation *simulation = &w->scene->scene.simulation;
    const struct ceduo_slope *s = &w->scene->scene.slope;
    if (simulation->law == CEDUO_LAW_ARM || !simulation->friction_bound || p->contacts != w->last.contacts + 1)
        return;
    double before = hypot(w->last.vx1, w->last.vz1), after = hypot(p->vx, p->vz);
    if (w->last.rolls && p->rolls) {
        w->roll_off = fmax(w->roll_off, before > 0 ? fabs(after - before) / before : after);
        w->impacts++;
        return;
    }
    size_t j = ceduo_slope_segment(s, p->x);
    if (p->rolls || !w->smooth || p->x == s->x[j] || p->x == s->x[j + 1])
        return; /* speed after the impact, or its segment, is unknown */
    double dx = s->x[j + 1] - s->x[j], dz = s->z[j + 1] - s->z[j], length = hypot(dx, dz);
    double vt = (w->last.vx1 * dx + w->last.vz1 * dz) / length, vt_out = (p->vx * dx + p->vz * dz) / length;
    double vn = (w->last.vz1 * dx - w->last.vx1 * dz) / length, vn_out = (p->vz * dx - p->vx * dz) / length;
    double max = s->segments[j].friction * (fmax(0, -vn) + vn_out);
    w->over_bound = fmax(w->over_bound, (fabs(vt) - fabs(vt_out) - max) / before);
    w->impacts++;
}

static void check_segment(void *context, const struct ceduo_trajectory_segment *p)
{
    struct checker *w = context;
    double sum = p->x + p->z + p->vx + p->vz + p->x1 + p->z1 + p->vx1 + p->vz1 + p->spin + p->seconds;
    w->bad |= !isfinite(sum) || p->seconds < 0;
    w->size = fmax(w->size, fmax(fmax(fabs(p->x), fabs(p->z)), fmax(fabs(p->x1), fabs(p->z1))));
    if (p->rolls)
        check_roll(w, p);
    else
        check_flight(w, p);
    w->in_crack += is_in_crack(&w->scene->scene.slope, w->rock.radius, p);
    if (w->pieces > 0) {
        w->bad |= p->x != w->last.x1 || p->z != w->last.z1 || p->contacts < w->last.contacts;
        double before = kinetic(w, w->last.vx1, w->last.vz1, spin_at_end(w, &w->last));
        double after = kinetic(w, p->vx, p->vz, p->spin);
        if (after > before && before > 1e-280)
            w->gain = fmax(w->gain, after / before - 1);
        check_crsp(w, p);
        check_bound(w, p);
    }
    w->last = *p;
    w->pieces++;
}

static bool is_smooth(const struct line_scene *s)
{
    for (size_t j = 0; j + 1 < s->scene.slope.vertices; j++)
        if (s->segments[j].roughness_m > 0 || s->segments[j].roughness_rad > 0)
            return false;
    return true;
}

static void expect_number(uint64_t scene, const char *label, double value, double max)
{
    if (!(value <= max))
        fail_msg("scene %ju: %s %g, more than %g", (uintmax_t)scene, label, value, max);
}

static void expect_crossing(uint64_t number, const struct ceduo_crossing *c)
{
    if (c->reached && !(isfinite(c->vx + c->vz + c->spin + c->height) && c->vx >= 0 && c->height >= 0))
        fail_msg("scene %ju: a crossing with %g %g %g %g", (uintmax_t)number, c->vx, c->vz, c->spin, c->height);
}

/* True if a rock without friction rolls slowly to and fro on level ground, perhaps for ever. */
static bool is_creeping(const struct checker *w)
{
    const struct ceduo_slope *s = &w->scene->scene.slope;
    return w->last.rolls && s->segments[ceduo_slope_segment(s, w->last.x1)].friction == 0;
}

void invariants_expect(struct line_scene *s, uint64_t number, struct invariants_tally *tally)
{
    struct ceduo_trajectory trajectory;
    struct ceduo_crossing crossing = {0};
    struct checker w = {.scene = s, .smooth = is_smooth(s)};
    assert_int_equal(ceduo_scene_check(&s->scene, NULL), CEDUO_OK);
    assert_int_equal(ceduo_rock_from_means(&s->scene.rock, &w.rock), CEDUO_OK);
    if (s->scene.simulation.law == CEDUO_LAW_ARM) { /* the section is drawn */
        assert_int_equal(ceduo_trajectory_run(&s->scene, NULL, number % 11, NULL, &trajectory, NULL), CEDUO_OK);
        w.rock = trajectory.rock;
    }
    w.k = s->scene.simulation.law == CEDUO_LAW_LUMPED ? 0 : w.rock.k;
    assert_int_equal(ceduo_trajectory_run(&s->scene, NULL, number % 11,
                                          &(struct ceduo_trajectory_callbacks){.segment = check_segment, .context = &w},
                                          &trajectory, &crossing),
                     CEDUO_OK);
    if (w.bad || !isfinite(trajectory.x + trajectory.z) ||
        (w.pieces > 0 && (trajectory.x != w.last.x1 || trajectory.z != w.last.z1)))
        fail_msg("scene %ju: not a number, or a gap in the trajectory", (uintmax_t)number);
    expect_number(number, "energy of a flight changes by", w.energy_off, ENERGY);
    expect_number(number, "a contact gains", w.gain, ENERGY);
    expect_number(number, "a contact of crsp gains", w.crsp_gain, ENERGY);
    expect_number(number, "an impact takes more speed than friction can, by", w.over_bound, ENERGY);
    expect_number(number, "a rock that goes on rolling changes its speed by", w.roll_off, ENERGY);
    expect_number(number, "metres below the ground:", w.under, fmax(UNDER, UNDER_SIZE * w.size));
    expect_crossing(number, &crossing);
    double end = s->x[s->scene.slope.vertices - 1];
    if (trajectory.end == CEDUO_END_LEFT_SLOPE && trajectory.x != 0 && trajectory.x != end)
        fail_msg("scene %ju: left the slope at %g", (uintmax_t)number, trajectory.x);
    bool crack = trajectory.end == CEDUO_END_UNFINISHED && w.in_crack > CEDUO_CONTACTS_MAX / 2;
    if (trajectory.end == CEDUO_END_UNFINISHED && !line_scene_lasts(s) && !crack && !is_creeping(&w))
        fail_msg("scene %ju: unfinished", (uintmax_t)number);
    tally->last = trajectory;
    tally->ends[trajectory.end]++;
    tally->cracks += crack;
    tally->contacts += trajectory.contacts;
    tally->pieces += w.pieces;
    tally->flights += w.flights;
    tally->impacts += w.impacts;
    tally->lasting += line_scene_lasts(s);
    tally->crossed += crossing.reached;
}
