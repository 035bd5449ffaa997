/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plain_loop.h"

#include <math.h>

/* Pfeiffer & Higgins 1990: 20, 30 and 250 ft/s. */
static const double FRICTION_SPEED = 6.096, NORMAL_SPEED = 9.144, SCALING_SPEED = 76.2;

static const double SOON = 1e-9; /* s: an earlier root is the contact that the rock is leaving */
static const uint64_t CONTACTS_MOST = 1000000;

struct generator {
    uint64_t a, b;
};

struct rock {
    double x, z, vx, vz, spin;
    size_t segment;
    bool on_ground, passed;
    uint64_t contacts;
};

struct hit {
    double t;
    size_t segment;
    bool found;
};

enum then { FLIES, TOUCHES, ROLLS, STANDS, ENDS };

/* ---- random numbers ---- */

/* splitmix64 (Steele, Lea & Flood 2014): spreads a seed over the generator's state. */
static uint64_t split_mix(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
}

/* xorshift128+ (Vigna 2017), uniform in [0, 1). */
static double uniform(struct generator *g)
{
    uint64_t s = g->a, t = g->b, sum = s + t;
    s ^= s << 23;
    g->a = t;
    g->b = s ^ t ^ (s >> 18) ^ (t >> 5);
    return (double)(sum >> 11) * 0x1p-53;
}

/* ---- flight ---- */

struct plain_segment plain_segment_between(double x0, double z0, double x1, double z1)
{
    double angle = atan2(z1 - z0, x1 - x0);
    return (struct plain_segment){.x0 = x0,
                                  .z0 = z0,
                                  .x1 = x1,
                                  .z1 = z1,
                                  .slope = (z1 - z0) / (x1 - x0),
                                  .angle = angle,
                                  .cosine = cos(angle),
                                  .sine = sin(angle)};
}

static double ground(const struct plain_segment *s, double x)
{
    return s->z0 + s->slope * (x - s->x0);
}

static struct hit next_hit(const struct plain_def *def, const struct rock *r)
{
    struct hit hit = {.t = INFINITY};
    for (size_t j = 0; j < def->count; j++) {
        const struct plain_segment *s = &def->segments[j];
        bool leaves = r->on_ground && j == r->segment;
        double b = r->vz - s->slope * r->vx, c = leaves ? 0 : r->z - ground(s, r->x);
        double d = b * b + 2 * def->gravity * c;
        if (d < 0)
            continue;
        double root = sqrt(d), times[2] = {(b - root) / def->gravity, (b + root) / def->gravity};
        if (leaves && times[1] <= SOON) /* it does not leave the ground at all */
            return (struct hit){.t = 0, .segment = j, .found = true};
        for (int i = 0; i < 2; i++) {
            if (times[i] <= SOON || times[i] >= hit.t)
                continue;
            double x = r->x + r->vx * times[i];
            if (x >= s->x0 && x <= s->x1)
                hit = (struct hit){.t = times[i], .segment = j, .found = true};
        }
    }
    return hit;
}

static void note(const struct plain_def *def, struct rock *r, struct plain_sums *sums, double speed, double spin)
{
    double moment = def->k * def->mass * def->radius * def->radius;
    double energy = 0.5 * def->mass * speed * speed + 0.5 * moment * spin * spin;
    r->passed = true;
    sums->passed++;
    sums->speed += speed;
    sums->speed2 += speed * speed;
    sums->energy += energy;
    sums->energy2 += energy * energy;
    if (def->source)
        def->source->passes(def->source->context, energy);
}

/* Flies to the hit; false where there is none and the rock leaves the slope. */
static bool fly(const struct plain_def *def, struct rock *r, const struct hit *hit, struct plain_sums *sums)
{
    double x = hit->found ? r->x + r->vx * hit->t : copysign(INFINITY, r->vx);
    if (!r->passed && r->x < def->control && x >= def->control && def->control <= def->segments[def->count - 1].x1) {
        double vz = r->vz - def->gravity * (def->control - r->x) / r->vx;
        note(def, r, sums, hypot(r->vx, vz), r->spin);
    }
    if (!hit->found)
        return false;
    r->x = x;
    r->z = ground(&def->segments[hit->segment], x);
    r->vz -= def->gravity * hit->t;
    r->segment = hit->segment;
    r->on_ground = true;
    return true;
}

/* ---- contact ---- */

static double square(double v)
{
    return v * v;
}

static void apply_crsp(const struct plain_def *def, const struct plain_segment *s, double *vn, double *vt, double *spin)
{
    double rim = *spin * def->radius, k = def->k;
    double friction = s->rt + (1 - s->rt) / (square((*vt - rim) / FRICTION_SPEED) + 1.2);
    double scaling = s->rt / (square(*vn / (SCALING_SPEED * s->rn)) + 1);
    double out = sqrt((k * rim * rim + *vt * *vt) * friction * scaling / (1 + k));
    *vt = copysign(out, *vt != 0 ? *vt : *spin);
    *vn = s->rn * *vn / (1 + square(*vn / NORMAL_SPEED));
    *spin = *vt / def->radius;
}

/* The angle of the facet that the rock strikes: turned against it, or the segment's where it would be leaving it. */
static double facet(const struct plain_def *def, const struct rock *r, double heading, struct generator *random)
{
    const struct plain_segment *s = &def->segments[r->segment];
    double most = def->roughness_is_height ? atan(s->roughness / def->radius) : s->roughness;
    double turn = most * (def->source ? def->source->draw(def->source->context, r->contacts) : uniform(random));
    double angle = r->vx * s->cosine + r->vz * s->sine >= 0 ? s->angle + turn : s->angle - turn;
    return sin(heading - angle) > 0 ? s->angle : angle;
}

static void strike(const struct plain_def *def, struct rock *r, struct generator *random)
{
    const struct plain_segment *s = &def->segments[r->segment];
    double speed = hypot(r->vx, r->vz), heading = atan2(r->vz, r->vx);
    double angle = facet(def, r, heading, random);
    double vt = speed * cos(heading - angle), vn = fmax(0, -speed * sin(heading - angle));
    if (def->law == PLAIN_CRSP) {
        apply_crsp(def, s, &vn, &vt, &r->spin);
    } else {
        vn *= s->rn;
        vt *= s->rt;
    }
    r->vx = vt * cos(angle) - vn * sin(angle);
    r->vz = vt * sin(angle) + vn * cos(angle);
    double out = r->vz * s->cosine - r->vx * s->sine;
    if (out < 0) {
        r->vx += out * s->sine;
        r->vz -= out * s->cosine;
    }
    r->contacts++;
}

/* ---- rolling ---- */

static double ground_between(const struct plain_def *def, size_t j, double x, size_t k, double x1)
{
    if (j > k)
        return ground_between(def, k, x1, j, x);
    double length = 0;
    for (; j < k; x = def->segments[j++].x1)
        length += (def->segments[j].x1 - x) / def->segments[j].cosine;
    return length + fabs(x1 - x) / def->segments[k].cosine;
}

/* Whether the flight to `hit` stays less than a radius long and high. */
static bool is_roll(const struct plain_def *def, const struct rock *r, const struct hit *hit)
{
    const struct plain_segment *s = &def->segments[r->segment];
    double x = r->x + r->vx * hit->t;
    if (!hit->found || fabs(x - r->x) >= def->radius)
        return false;
    double vn = r->vz * s->cosine - r->vx * s->sine;
    return vn * vn / (2 * def->gravity * s->cosine) < def->radius &&
           ground_between(def, r->segment, r->x, hit->segment, x) < def->radius;
}

static double inertia(const struct plain_def *def)
{
    return def->law == PLAIN_CRSP ? def->k : 0;
}

static void set_rolling(const struct plain_def *def, struct rock *r, double u)
{
    const struct plain_segment *s = &def->segments[r->segment];
    r->vx = u * s->cosine;
    r->vz = u * s->sine;
    r->spin = def->law == PLAIN_CRSP ? u / def->radius : 0;
}

/* Moves along the segment to x, the square of the speed going from u2 to u2_end. */
static void roll_to(const struct plain_def *def, struct rock *r, double x, double u2, double u2_end, struct plain_sums *sums)
{
    if (!r->passed && r->x < def->control && x >= def->control) {
        double u = sqrt(u2 + (u2_end - u2) * (def->control - r->x) / (x - r->x));
        note(def, r, sums, u, def->law == PLAIN_CRSP ? u / def->radius : 0);
    }
    r->x = x;
    r->z = ground(&def->segments[r->segment], x);
}

/* Past the end of the segment: the rest of the roll goes on at u2, or the rock flies or is off the slope. */
static enum then pass_vertex(const struct plain_def *def, struct rock *r, int dir, double *u2)
{
    const struct plain_segment *s = &def->segments[r->segment];
    set_rolling(def, r, dir * sqrt(*u2));
    if (dir > 0 ? r->segment + 1 == def->count : r->segment == 0)
        return ENDS;
    r->segment = dir > 0 ? r->segment + 1 : r->segment - 1;
    double turn = dir * (def->segments[r->segment].angle - s->angle);
    if (turn > 0)
        *u2 *= square(fmax(0, cos(turn)));
    if (turn < 0) {
        struct hit hit = next_hit(def, r);
        if (!is_roll(def, r, &hit))
            return FLIES;
    }
    return ROLLS;
}

/* Rolls a radius along the ground from speed u, downhill from 0. */
static enum then roll(const struct plain_def *def, struct rock *r, double u, struct plain_sums *sums)
{
    double left = def->radius, u2 = u * u;
    int dir = u > 0 ? 1 : u < 0 ? -1 : def->segments[r->segment].slope > 0 ? -1 : 1;
    for (;;) {
        const struct plain_segment *s = &def->segments[r->segment];
        double end = dir > 0 ? s->x1 : s->x0, to_end = fabs(end - r->x) / s->cosine, ds = fmin(left, to_end);
        double rate = 2 * def->gravity * (-dir * s->sine - s->friction * s->cosine) / (1 + inertia(def));
        double u2_end = u2 + rate * ds;
        if (ds > 0 && rate <= 0 && u2_end <= 0) {
            double stop = rate < 0 ? fmin(ds, -u2 / rate) : 0;
            roll_to(def, r, r->x + dir * stop * s->cosine, u2, 0, sums);
            return STANDS;
        }
        roll_to(def, r, ds < to_end ? r->x + dir * ds * s->cosine : end, u2, u2_end, sums);
        u2 = u2_end;
        left -= ds;
        if (left <= 0) {
            set_rolling(def, r, dir * sqrt(u2));
            return TOUCHES;
        }
        enum then then = pass_vertex(def, r, dir, &u2);
        if (then != ROLLS)
            return then;
    }
}

static bool rests(const struct plain_def *def, const struct rock *r)
{
    const struct plain_segment *s = &def->segments[r->segment];
    return fabs(s->slope) <= s->friction;
}

static enum then roll_on(const struct plain_def *def, struct rock *r, struct plain_sums *sums)
{
    const struct plain_segment *s = &def->segments[r->segment];
    double k = inertia(def);
    double u = (r->vx * s->cosine + r->vz * s->sine + k * r->spin * def->radius) / (1 + k);
    if (u == 0 && rests(def, r))
        return ENDS;
    enum then then = roll(def, r, u, sums);
    while (then == STANDS && r->contacts < CONTACTS_MOST) {
        if (rests(def, r))
            return ENDS;
        r->contacts++;
        then = roll(def, r, 0, sums);
    }
    return then;
}

/* ---- rocks ---- */

static void release(const struct plain_def *def, uint64_t number, struct rock *r)
{
    struct plain_start start = {.x = def->x, .z = def->z, .vx = def->vx, .vz = def->vz};
    if (def->source)
        def->source->begin(def->source->context, number, &start);
    *r = (struct rock){.x = start.x, .z = start.z, .vx = start.vx, .vz = start.vz};
    while (r->segment + 1 < def->count && r->x >= def->segments[r->segment].x1)
        r->segment++;
    r->on_ground = r->z <= ground(&def->segments[r->segment], r->x);
}

static void follow(const struct plain_def *def, struct rock *r, struct generator *random, struct plain_sums *sums)
{
    const struct plain_segment *s = &def->segments[r->segment];
    enum then then = r->on_ground && r->vz * s->cosine - r->vx * s->sine <= 0 ? TOUCHES : FLIES;
    while (then != ENDS && r->contacts < CONTACTS_MOST) {
        if (then == TOUCHES)
            strike(def, r, random);
        struct hit hit = next_hit(def, r);
        if (then == TOUCHES && is_roll(def, r, &hit))
            then = roll_on(def, r, sums);
        else
            then = fly(def, r, &hit, sums) ? TOUCHES : ENDS;
    }
}

void plain_loop(const struct plain_def *def, uint64_t rocks, struct plain_sums *sums)
{
    uint64_t seed = def->seed;
    struct generator random;
    random.a = split_mix(&seed);
    random.b = split_mix(&seed);
    for (uint64_t i = 0; i < rocks; i++) {
        struct rock r;
        release(def, i, &r);
        follow(def, &r, &random, sums);
        sums->rocks++;
        sums->contacts += r.contacts;
        sums->contacts2 += square((double)r.contacts);
    }
}
