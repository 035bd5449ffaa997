/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact law `crsp` is that of Pfeiffer & Higgins (1990) and of the CRSP 3.0 manual; rolling in steps of one
 * radius is CRSP's too, measured along the ground so that a slope cut more finely gives the same way. */
#include "slow_walk.h"

#include <math.h>

/* CRSP's scales, 20, 30 and 250 ft/s. */
static const long double friction_speed = 6.096L;
static const long double normal_speed = 9.144L;
static const long double scaling_speed = 76.2L;

/* What the rock does next. */
enum todo { TODO_CONTACT, TODO_FLIGHT, TODO_ROLL, TODO_STAND, TODO_NOTHING };

struct walker {
    const struct slow_def *def;
    struct slow_way *way;
    struct slow_crossing *crossings;
    long double x, z, vx, vz, spin; /* x and z relative to the first vertex */
    size_t segment;                 /* the one it is on, or the one under it at its release */
    bool on_ground;
    uint64_t contacts;
};

/* Where a flight meets the ground. */
struct touch {
    bool touches; /* false: it leaves the profile */
    size_t segment;
    long double time, x, z;
};

/* A roll of one radius: the square of the speed, the direction in x and the length still to go. */
struct roll {
    long double u2;
    int direction;
    long double left;
};

/* ---- the ground ---- */

/* Survey coordinates would cost digits, so everything is measured from the first vertex. */
static long double vertex_x(const struct slow_def *def, size_t i)
{
    return (long double)def->x[i] - (long double)def->x[0];
}

static long double vertex_z(const struct slow_def *def, size_t i)
{
    return (long double)def->z[i] - (long double)def->z[0];
}

static size_t last_segment(const struct slow_def *def)
{
    return def->vertices - 2;
}

static long double run(const struct slow_def *def, size_t j)
{
    return vertex_x(def, j + 1) - vertex_x(def, j);
}

static long double rise(const struct slow_def *def, size_t j)
{
    return vertex_z(def, j + 1) - vertex_z(def, j);
}

static long double slope(const struct slow_def *def, size_t j)
{
    return rise(def, j) / run(def, j);
}

/* Signed angle of a segment, positive where it rises with x. */
static long double angle(const struct slow_def *def, size_t j)
{
    return atan2l(rise(def, j), run(def, j));
}

/* Length along the ground for one metre of x. */
static long double length_per_x(const struct slow_def *def, size_t j)
{
    return 1.0L / cosl(angle(def, j));
}

/* Height of segment j at x; exactly that of the vertex at either end, so that what is put on a vertex is on both of
 * its segments. */
static long double segment_z(const struct slow_def *def, size_t j, long double x)
{
    if (x == vertex_x(def, j + 1)) {
        return vertex_z(def, j + 1);
    }
    return vertex_z(def, j) + slope(def, j) * (x - vertex_x(def, j));
}

/* The segment over which x lies: the right-hand one at a vertex, the last one at the end of the profile. */
static size_t segment_at(const struct slow_def *def, long double x)
{
    size_t j = 0;
    for (size_t i = 1; i <= last_segment(def); i++) {
        if (x >= vertex_x(def, i)) {
            j = i;
        }
    }
    return j;
}

/* The vertex that ends segment j for a rock going in `direction`. */
static size_t exit_vertex(size_t j, int direction)
{
    return direction > 0 ? j + 1 : j;
}

static bool is_end_of_profile(const struct slow_def *def, size_t vertex)
{
    return vertex == 0 || vertex == def->vertices - 1;
}

static size_t segment_ahead(size_t j, int direction)
{
    return direction > 0 ? j + 1 : j - 1;
}

/* Length along the ground between two abscissae, across any vertices. */
static long double ground_length(const struct slow_def *def, long double from, long double to)
{
    const long double low = fminl(from, to);
    const long double high = fmaxl(from, to);
    long double sum = 0;
    for (size_t j = 0; j <= last_segment(def); j++) {
        const long double a = fmaxl(low, vertex_x(def, j));
        const long double b = fminl(high, vertex_x(def, j + 1));
        if (b > a) {
            sum += (b - a) * length_per_x(def, j);
        }
    }
    return sum;
}

/* ---- the rock ---- */

/* The lumped law knows no rotation: k = 0 there, rolling included. */
static long double inertia(const struct slow_def *def)
{
    return def->law == SLOW_CRSP ? (long double)def->k : 0.0L;
}

static long double rolling_spin(const struct slow_def *def, long double u)
{
    return def->law == SLOW_CRSP ? u / (long double)def->radius : 0.0L;
}

static int direction_of(long double v)
{
    return (v > 0) - (v < 0);
}

static int downhill(const struct slow_def *def, size_t j)
{
    return rise(def, j) > 0 ? -1 : 1;
}

static bool steeper_than_friction(const struct slow_def *def, size_t j)
{
    return fabsl(slope(def, j)) > (long double)def->friction[j];
}

/* ---- controls ---- */

static void record(struct walker *w, size_t i, long double vx, long double vz, long double spin, long double height)
{
    struct slow_crossing *c = &w->crossings[i];
    c->reached = true;
    c->vx = (double)vx;
    c->vz = (double)vz;
    c->spin = (double)spin;
    c->height = (double)height;
}

static long double control_x(const struct slow_def *def, size_t i)
{
    return (long double)def->control_x[i] - (long double)def->x[0];
}

/* Whether control i lies in (from, to] and waits for its first crossing. A way back has to < from, so nothing does. */
static bool crosses(const struct walker *w, size_t i, long double from, long double to)
{
    const long double c = control_x(w->def, i);
    return !w->crossings[i].reached && c > from && c <= to;
}

static void record_flight(struct walker *w, long double to)
{
    const long double g = w->def->gravity;
    for (size_t i = 0; i < w->def->controls; i++) {
        if (crosses(w, i, w->x, to)) {
            const long double c = control_x(w->def, i);
            const long double t = (c - w->x) / w->vx;
            const long double z = w->z + t * (w->vz - g * t / 2);
            record(w, i, w->vx, w->vz - g * t, w->spin, z - segment_z(w->def, segment_at(w->def, c), c));
        }
    }
}

/* What u^2 gains over dx of segment j: the drop less the friction, shared with the rotation. Written so that it is
 * positive going down exactly where the segment is steeper than its friction. */
static long double roll_gain(const struct slow_def *def, size_t j, long double dx)
{
    const long double fall = dx > 0 ? -slope(def, j) : slope(def, j);
    const long double net = fall - (long double)def->friction[j];
    return 2 * (long double)def->gravity * net * fabsl(dx) / (1 + inertia(def));
}

static void record_roll(struct walker *w, const struct roll *roll, long double to)
{
    const long double a = angle(w->def, w->segment);
    for (size_t i = 0; i < w->def->controls; i++) {
        if (crosses(w, i, w->x, to)) {
            const long double u2 = roll->u2 + roll_gain(w->def, w->segment, control_x(w->def, i) - w->x);
            const long double u = sqrtl(fmaxl(0, u2)); /* rounding where it stands still right at the control */
            record(w, i, u * cosl(a), u * sinl(a), rolling_spin(w->def, u), 0);
        }
    }
}

/* ---- flight ---- */

/* Height of the flight above segment j is c + b t - g t^2 / 2. On the segment that it starts from, c is 0 by
 * definition: rounding must not bury the rock. */
static long double height_c(const struct walker *w, size_t j)
{
    if (w->on_ground && j == w->segment) {
        return 0;
    }
    return w->z - segment_z(w->def, j, w->x);
}

static long double height_b(const struct walker *w, size_t j)
{
    return w->vz - slope(w->def, j) * w->vx;
}

/* Above the vertex that ends segment j at time t, in the form of that segment where the rock starts on it (it is then
 * exact for however short a flight), otherwise straight from the vertex. */
static long double height_at_exit(const struct walker *w, size_t j, size_t vertex, long double t)
{
    const long double g = w->def->gravity;
    if (w->on_ground && j == w->segment) {
        return t * (height_b(w, j) - g * t / 2);
    }
    return w->z + t * (w->vz - g * t / 2) - vertex_z(w->def, vertex);
}

/* The later root of c + b t - g t^2 / 2. A concave function comes down through 0 at its later root only; at the
 * earlier one it would come up out of the ground. The square root is taken without cancellation. */
static long double later_root(long double c, long double b, long double g)
{
    const long double root = sqrtl(fmaxl(0, b * b + 2 * g * c));
    const long double q = b < 0 ? b - root : b + root;
    const long double one = q / g;
    const long double other = q == 0 ? 0 : -2 * c / q;
    return fmaxl(one, other);
}

/* Time at which the rock going in `direction` is over vertex i; none for what lies behind it. */
static long double time_at(const struct walker *w, size_t i)
{
    return fmaxl(0, (vertex_x(w->def, i) - w->x) / w->vx);
}

/* Whether the flight goes into the ground between the two ends of segment j, and when. Exactly through the vertex is
 * still clear, so that the segment ahead takes it; a NaN is not clear. */
static bool meets(const struct walker *w, size_t j, int direction, long double *time)
{
    const size_t out = exit_vertex(j, direction);
    const size_t in = direction > 0 ? j : j + 1;
    const long double t_in = time_at(w, in);
    const long double t_out = time_at(w, out);
    if (height_at_exit(w, j, out, t_out) >= 0) {
        return false;
    }
    const long double t = later_root(height_c(w, j), height_b(w, j), (long double)w->def->gravity);
    *time = fminl(fmaxl(t, t_in), t_out);
    return true;
}

static void put_touch(const struct walker *w, struct touch *touch, size_t j, long double t)
{
    const long double x = w->x + w->vx * t;
    touch->touches = true;
    touch->segment = j;
    touch->time = t;
    touch->x = fminl(fmaxl(x, vertex_x(w->def, j)), vertex_x(w->def, j + 1));
    touch->z = segment_z(w->def, j, touch->x);
}

/* Straight up and down, over the segment it is on. */
static struct touch vertical_touch(const struct walker *w)
{
    struct touch touch = {.touches = true, .segment = w->segment, .x = w->x};
    touch.z = segment_z(w->def, w->segment, w->x);
    const long double c = fmaxl(0, height_c(w, w->segment));
    touch.time = fmaxl(0, later_root(c, w->vz, (long double)w->def->gravity));
    return touch;
}

/* The next contact: every segment from here to the end of the profile is tried, the earliest wins. */
static struct touch next_touch(const struct walker *w)
{
    const int direction = direction_of(w->vx);
    if (direction == 0) {
        return vertical_touch(w);
    }
    struct touch best = {.touches = false};
    for (size_t j = w->segment;; j = segment_ahead(j, direction)) {
        long double t = 0;
        if (meets(w, j, direction, &t) && (!best.touches || t < best.time)) {
            put_touch(w, &best, j, t);
        }
        if (is_end_of_profile(w->def, exit_vertex(j, direction))) {
            return best;
        }
    }
}

static enum todo leave(struct walker *w)
{
    w->way->end = SLOW_LEFT;
    return TODO_NOTHING;
}

static enum todo fly_off(struct walker *w)
{
    const size_t end = w->vx > 0 ? w->def->vertices - 1 : 0;
    const long double t = time_at(w, end);
    const long double g = w->def->gravity;
    record_flight(w, vertex_x(w->def, end));
    w->x = vertex_x(w->def, end);
    w->z += t * (w->vz - g * t / 2);
    w->vz -= g * t;
    return leave(w);
}

static enum todo fly(struct walker *w)
{
    const struct touch touch = next_touch(w);
    if (!touch.touches) {
        return fly_off(w);
    }
    record_flight(w, touch.x);
    w->x = touch.x;
    w->z = touch.z;
    w->vz -= (long double)w->def->gravity * touch.time;
    w->segment = touch.segment;
    w->on_ground = true;
    return TODO_CONTACT;
}

/* ---- contact ---- */

static long double along(const struct walker *w, long double a)
{
    return w->vx * cosl(a) + w->vz * sinl(a);
}

static long double outward(const struct walker *w, long double a)
{
    return w->vz * cosl(a) - w->vx * sinl(a);
}

static void set_velocity(struct walker *w, long double a, long double tangential, long double normal)
{
    w->vx = tangential * cosl(a) - normal * sinl(a);
    w->vz = tangential * sinl(a) + normal * cosl(a);
}

/* Angle of the facet that is met. */
static long double facet(const struct walker *w)
{
    const struct slow_def *def = w->def;
    const long double a = angle(def, w->segment);
    const long double most = def->theta_max_rad[w->segment];
    const long double u = def->uniform(def->context, w->contacts);
    long double turn = most * (2 * u - 1);
    if (def->facets == SLOW_AGAINST) {
        turn = along(w, a) >= 0 ? most * u : -most * u;
    }
    /* A rock cannot hit a face that it is moving away from. */
    return outward(w, a + turn) > 0 ? a : a + turn;
}

static long double square(long double v)
{
    return v * v;
}

/* CRSP's scaling of the tangential energy with the normal speed, with its limit where Rn = 0. */
static long double scaling(long double vn, long double rn, long double rt)
{
    if (rn > 0) {
        return rt / (square(vn / (scaling_speed * rn)) + 1);
    }
    return vn > 0 ? 0 : rt;
}

/* The energy of translation along the facet and of rotation is reduced by f and SF; the rock leaves without slip. */
static long double crsp_tangential(const struct walker *w, long double vn, long double vt)
{
    const long double rn = w->def->rn[w->segment];
    const long double rt = w->def->rt[w->segment];
    const long double k = inertia(w->def);
    const long double rim = w->spin * (long double)w->def->radius;
    const long double f = rt + (1 - rt) / (square((vt - rim) / friction_speed) + 1.2L);
    const long double speed = sqrtl((k * square(rim) + square(vt)) * f * scaling(vn, rn, rt) / (1 + k));
    return vt < 0 || (vt == 0 && w->spin < 0) ? -speed : speed;
}

static void apply_law(struct walker *w, long double a)
{
    const struct slow_def *def = w->def;
    const long double vn = fmaxl(0, -outward(w, a));
    const long double vt = along(w, a);
    const long double reduced = 1 + square(vn / normal_speed);
    const long double rebound = (long double)def->rn[w->segment] * vn;
    if (def->law == SLOW_CRSP) {
        const long double vt_out = crsp_tangential(w, vn, vt);
        set_velocity(w, a, vt_out, rebound / reduced);
        w->spin = rolling_spin(def, vt_out);
    } else {
        set_velocity(w, a, (long double)def->rt[w->segment] * vt, def->scale_rn ? rebound / reduced : rebound);
        w->spin = 0;
    }
}

/* A facet turned away from the segment may send the rock into it. */
static void keep_out_of_segment(struct walker *w)
{
    const long double a = angle(w->def, w->segment);
    if (outward(w, a) < 0) {
        set_velocity(w, a, along(w, a), 0);
    }
}

/* A flight that stays within one radius, both along the ground and above the segment, is rolling. */
static bool flight_is_rolling(const struct walker *w)
{
    const long double radius = w->def->radius;
    const long double a = angle(w->def, w->segment);
    const long double height = square(outward(w, a)) / (2 * (long double)w->def->gravity * cosl(a));
    const struct touch touch = next_touch(w);
    return touch.touches && ground_length(w->def, w->x, touch.x) < radius && height < radius;
}

static void tell_contact(const struct walker *w)
{
    const struct slow_def *def = w->def;
    if (def->on_contact != NULL) {
        def->on_contact(def->context, (double)(w->x + (long double)def->x[0]), (double)(w->z + (long double)def->z[0]),
                        (double)w->vx, (double)w->vz, (double)w->spin);
    }
}

static enum todo unfinished(struct walker *w)
{
    w->way->end = SLOW_UNFINISHED;
    return TODO_NOTHING;
}

static enum todo contact(struct walker *w)
{
    if (w->contacts >= w->def->max_contacts) {
        return unfinished(w);
    }
    apply_law(w, facet(w));
    keep_out_of_segment(w);
    w->contacts++;
    tell_contact(w);
    return flight_is_rolling(w) ? TODO_ROLL : TODO_FLIGHT;
}

/* ---- rolling ---- */

/* The speed without slip that keeps the angular momentum about the point of contact. */
static struct roll roll_of(const struct walker *w)
{
    const struct slow_def *def = w->def;
    const long double k = inertia(def);
    const long double v = along(w, angle(def, w->segment));
    const long double u = (v + k * w->spin * (long double)def->radius) / (1 + k);
    const int direction = direction_of(u);
    return (struct roll){
        .u2 = u * u,
        .direction = direction != 0 ? direction : downhill(def, w->segment),
        .left = def->radius,
    };
}

static void set_rolling_velocity(struct walker *w, const struct roll *roll)
{
    const long double u = roll->direction > 0 ? sqrtl(roll->u2) : -sqrtl(roll->u2);
    set_velocity(w, angle(w->def, w->segment), u, 0);
    w->spin = rolling_spin(w->def, u);
}

static void move_on_segment(struct walker *w, long double x)
{
    w->x = x;
    w->z = segment_z(w->def, w->segment, x);
}

/* u^2 is linear in x, so the place where it is used up is a matter of proportion. */
static enum todo stop_within(struct walker *w, const struct roll *roll, long double to, long double u2_end)
{
    const long double part = roll->u2 > 0 ? roll->u2 / (roll->u2 - u2_end) : 0;
    const long double x = w->x + (to - w->x) * part;
    record_roll(w, roll, x);
    move_on_segment(w, x);
    w->vx = 0;
    w->vz = 0;
    w->spin = 0;
    return TODO_STAND;
}

/* Signed break of the ground between two neighbouring segments: positive where the vertex between them is concave. */
static long double break_between(const struct slow_def *def, size_t one, size_t other)
{
    return one < other ? angle(def, other) - angle(def, one) : angle(def, one) - angle(def, other);
}

/* The end of a piece at a vertex: leave the profile, lose the part of u into the ground, go over the edge along the
 * ground, or fly from it. */
static enum todo pass_vertex(struct walker *w, struct roll *roll)
{
    const size_t vertex = exit_vertex(w->segment, roll->direction);
    set_rolling_velocity(w, roll);
    if (is_end_of_profile(w->def, vertex)) {
        return leave(w);
    }
    const size_t ahead = segment_ahead(w->segment, roll->direction);
    const long double turn = break_between(w->def, w->segment, ahead);
    w->segment = ahead;
    if (turn < 0) {
        return flight_is_rolling(w) ? TODO_ROLL : TODO_FLIGHT;
    }
    roll->u2 *= square(fmaxl(0, cosl(turn)));
    return TODO_ROLL;
}

/* One piece of a roll, as far as the vertex ahead or the end of its length. A rock on the vertex itself has no piece
 * before it in which it could stand still. */
static enum todo roll_piece(struct walker *w, struct roll *roll)
{
    const struct slow_def *def = w->def;
    const long double x_vertex = vertex_x(def, exit_vertex(w->segment, roll->direction));
    const long double per_x = length_per_x(def, w->segment);
    const long double length = fabsl(x_vertex - w->x) * per_x;
    const bool ends = roll->left <= length;
    const long double to = roll->left < length ? w->x + (long double)roll->direction * roll->left / per_x : x_vertex;
    const long double u2_end = roll->u2 + roll_gain(def, w->segment, to - w->x);
    if (to != w->x && !(u2_end > 0)) {
        return stop_within(w, roll, to, u2_end);
    }
    record_roll(w, roll, to);
    move_on_segment(w, to);
    roll->u2 = u2_end;
    roll->left -= length;
    if (ends) {
        set_rolling_velocity(w, roll);
        return TODO_CONTACT;
    }
    return pass_vertex(w, roll);
}

/* ---- standing still ---- */

/* Rise of segment j for a rock going in `direction`. */
static long double rise_towards(const struct slow_def *def, size_t j, int direction)
{
    return (long double)direction * rise(def, j);
}

/* Goes on from *j while the ground does `falls` (falls: strictly down, else exactly level); *j becomes the first
 * segment that does not. False where the profile ends before. */
static bool follow(const struct slow_def *def, size_t *j, int direction, bool falls)
{
    for (;;) {
        const long double up = rise_towards(def, *j, direction);
        if (!(falls ? up < 0 : up == 0)) {
            return true;
        }
        if (is_end_of_profile(def, exit_vertex(*j, direction))) {
            return false;
        }
        *j = segment_ahead(*j, direction);
    }
}

/* Whether the ground from segment j on rises to z before it falls again. */
static bool rises_to(const struct slow_def *def, size_t j, int direction, long double z)
{
    for (;;) {
        if (rise_towards(def, j, direction) < 0) {
            return false;
        }
        if (vertex_z(def, exit_vertex(j, direction)) >= z) {
            return true;
        }
        if (is_end_of_profile(def, exit_vertex(j, direction))) {
            return false;
        }
        j = segment_ahead(j, direction);
    }
}

/* Abscissa at which segment j begins for a rock going in `direction`. */
static long double entry_x(const struct slow_def *def, size_t j, int direction)
{
    return vertex_x(def, direction > 0 ? j : j + 1);
}

/* Without this a rock would rock in a pit for ever. The bottom is where the ground stops falling: a concave vertex, or
 * a level stretch shorter than the radius; a rock held by friction on either side is no business of the pit. */
static bool stands_in_pit(const struct walker *w)
{
    const struct slow_def *def = w->def;
    const int direction = downhill(def, w->segment);
    const long double radius = def->radius;
    size_t beyond = w->segment;
    if (!follow(def, &beyond, direction, true)) {
        return false;
    }
    const size_t before = segment_ahead(beyond, -direction);
    const long double bottom = entry_x(def, beyond, direction);
    if (!follow(def, &beyond, direction, false)) {
        return false;
    }
    const long double level = ground_length(def, bottom, entry_x(def, beyond, direction));
    return level < radius && ground_length(def, w->x, bottom) < radius && steeper_than_friction(def, before) &&
           steeper_than_friction(def, beyond) && rises_to(def, beyond, direction, w->z);
}

static bool rests(const struct walker *w)
{
    return !steeper_than_friction(w->def, w->segment) || stands_in_pit(w);
}

static enum todo rest(struct walker *w)
{
    w->vx = 0;
    w->vz = 0;
    w->spin = 0;
    w->way->end = SLOW_REST;
    return TODO_NOTHING;
}

static enum todo stand(struct walker *w)
{
    if (rests(w)) {
        return rest(w);
    }
    if (w->contacts >= w->def->max_contacts) {
        return unfinished(w);
    }
    w->contacts++; /* the new roll from rest, so that no way can go on without being counted */
    return TODO_ROLL;
}

/* A contact that leaves no speed at all leaves a rock that may rest where it is; if not, it goes on with the roll of
 * that contact. */
static enum todo roll(struct walker *w)
{
    struct roll now = roll_of(w);
    if (now.u2 == 0 && rests(w)) {
        return rest(w);
    }
    enum todo next;
    do {
        next = roll_piece(w, &now);
    } while (next == TODO_ROLL);
    return next;
}

/* ---- the way ---- */

/* A height that rounds to the ground's is on the ground: the caller has only doubles to say so. */
static bool released_on_ground(const struct walker *w)
{
    const long double ground = segment_z(w->def, w->segment, w->x);
    return !(w->z > ground) || (double)w->z == (double)ground;
}

static enum todo release(struct walker *w)
{
    const struct slow_def *def = w->def;
    w->x = (long double)def->x0 - (long double)def->x[0];
    w->z = (long double)def->z0 - (long double)def->z[0];
    w->vx = def->vx0;
    w->vz = def->vz0;
    w->spin = def->law == SLOW_CRSP ? (long double)def->spin0 : 0.0L;
    w->segment = segment_at(def, w->x);
    w->on_ground = released_on_ground(w);
    if (!w->on_ground) {
        return TODO_FLIGHT;
    }
    move_on_segment(w, w->x);
    return outward(w, angle(def, w->segment)) > 0 ? TODO_FLIGHT : TODO_CONTACT;
}

static enum todo step(struct walker *w, enum todo todo)
{
    switch (todo) {
    case TODO_CONTACT:
        return contact(w);
    case TODO_FLIGHT:
        return fly(w);
    case TODO_ROLL:
        return roll(w);
    case TODO_STAND:
        return stand(w);
    case TODO_NOTHING:
        break;
    }
    return TODO_NOTHING;
}

static void report(const struct walker *w)
{
    struct slow_way *way = w->way;
    way->x = (double)(w->x + (long double)w->def->x[0]);
    way->z = (double)(w->z + (long double)w->def->z[0]);
    way->contacts = w->contacts;
    way->vx = (double)w->vx;
    way->vz = (double)w->vz;
    way->spin = (double)w->spin;
}

void slow_walk(const struct slow_def *def, struct slow_way *way, struct slow_crossing *crossings)
{
    struct walker w = {.def = def, .way = way, .crossings = crossings};
    for (size_t i = 0; i < def->controls; i++) {
        crossings[i] = (struct slow_crossing){.reached = false};
    }
    enum todo todo = release(&w);
    while (todo != TODO_NOTHING) {
        todo = step(&w, todo);
    }
    report(&w);
}
