/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact law `crsp` follows Pfeiffer & Higgins (1990) and the CRSP 3.0 manual. Rolling in steps of one radius is CRSP's,
 * too, measured along the ground, so that a finer slope gives the same trajectory. With `friction_bound` an impact takes at
 * most friction times its normal impulse along the ground, and a rock that continues rolling loses energy only to friction.
 * Both are assumptions of ceduo 0.5. */
#include "slow_walk.h"

#include <tgmath.h>

/* Scales of CRSP: 20, 30 and 250 ft/s. */
static const slow_real friction_speed = (slow_real)6.096L, normal_speed = (slow_real)9.144L, scaling_speed = (slow_real)76.2L;

/* Next step of the rock. */
enum todo { TODO_CONTACT, TODO_FLIGHT, TODO_ROLL, TODO_STAND, TODO_NOTHING };

/* The next contact of a flight with the ground. */
struct touch {
    const struct slow_segment *segment; /* NULL: it leaves the profile */
    slow_real time, x;
};

struct walker {
    const struct slow_def *def;
    struct slow_trajectory *trajectory;
    size_t stems_passed;
    const struct slow_segment *segment; /* current segment, or the one under the release */
    bool on_ground;
    bool rolled; /* true if it reached this contact rolling */
    slow_real x, z, vx, vz, spin;
    struct touch touch; /* end of the next flight */
};

/* A roll of one radius: squared speed, remaining length, and direction in x. */
struct roll {
    slow_real u2, left;
    int direction;
};

static slow_real square(slow_real v)
{
    return v * v;
}

/* Clamp v to [lo, hi]; lo for NaN. */
static slow_real clamp(slow_real v, slow_real lo, slow_real hi)
{
    return !(v > lo) ? lo : v < hi ? v : hi;
}

static slow_real not_below_0(slow_real v)
{
    return v > 0 ? v : 0;
}

/* ---- ground ---- */

static struct slow_turn facet_turn(slow_real angle)
{
    return (struct slow_turn){cos(angle), sin(angle)};
}

struct slow_segment slow_segment_between(double x0, double z0, double x1, double z1)
{
    struct slow_segment s = {.x0 = x0, .z0 = z0, .x1 = x1, .z1 = z1};
    s.slope = (s.z1 - s.z0) / (s.x1 - s.x0);
    s.angle = atan2(s.z1 - s.z0, s.x1 - s.x0);
    s.turn = facet_turn(s.angle);
    return s;
}

/* Return the height at x; exactly the vertex's at either end, so that a point on a vertex lies on both segments. */
static slow_real ground(const struct slow_segment *s, slow_real x)
{
    return x == s->x1 ? s->z1 : s->z0 + s->slope * (x - s->x0);
}

/* Return the segment below x: the right-hand one at a vertex, the last one at the end of the profile. */
static const struct slow_segment *find_segment(const struct slow_def *def, slow_real x)
{
    const struct slow_segment *s = def->segments;
    while (s < def->segments + def->count - 1 && x >= s->x1)
        s++;
    return s;
}

/* Return the end of a segment for a rock moving in `direction`. */
static slow_real exit_x(const struct slow_segment *s, int direction)
{
    return direction > 0 ? s->x1 : s->x0;
}

static slow_real exit_z(const struct slow_segment *s, int direction)
{
    return direction > 0 ? s->z1 : s->z0;
}

static bool is_last(const struct slow_def *def, const struct slow_segment *s, int direction)
{
    return s == (direction > 0 ? def->segments + def->count - 1 : def->segments);
}

/* Return the length along the ground between two abscissae, across any vertices. */
static slow_real ground_length(const struct slow_def *def, slow_real from, slow_real to)
{
    slow_real x = from < to ? from : to, high = from < to ? to : from, sum = 0;
    const struct slow_segment *s = find_segment(def, x);
    for (; high > s->x1 && !is_last(def, s, 1); x = s++->x1)
        sum += (s->x1 - x) / s->turn.cosine;
    return sum + (high - x) / s->turn.cosine;
}

/* ---- rock ---- */

/* Return k; 0 for the lumped law, which has no rotation, not even in rolling. */
static slow_real inertia(const struct slow_def *def)
{
    return def->law == SLOW_CRSP ? (slow_real)def->k : 0;
}

static slow_real rolling_spin(const struct slow_def *def, slow_real u)
{
    return def->law == SLOW_CRSP ? u / (slow_real)def->radius : 0;
}

static int find_direction(slow_real v)
{
    return (v > 0) - (v < 0);
}

static int downhill(const struct slow_segment *s)
{
    return s->z1 > s->z0 ? -1 : 1;
}

static bool steeper_than_friction(const struct slow_segment *s)
{
    return fabs(s->slope) > s->friction;
}

static slow_real along(const struct walker *w, struct slow_turn a)
{
    return w->vx * a.cosine + w->vz * a.sine;
}

static slow_real outward(const struct walker *w, struct slow_turn a)
{
    return w->vz * a.cosine - w->vx * a.sine;
}

static void set_velocity(struct walker *w, struct slow_turn a, slow_real tangential, slow_real normal)
{
    w->vx = tangential * a.cosine - normal * a.sine;
    w->vz = tangential * a.sine + normal * a.cosine;
}

static enum todo end(struct walker *w, enum slow_end how)
{
    w->trajectory->end = how;
    return TODO_NOTHING;
}

/* ---- control ---- */

/* True if the control lies in (x, to] and has not been crossed. A trajectory back has to < x and crosses nothing. */
static bool crosses(const struct walker *w, slow_real to)
{
    return !w->trajectory->crossing.reached && w->def->control > w->x && w->def->control <= to;
}

static void record(struct walker *w, slow_real vx, slow_real vz, slow_real spin, slow_real height)
{
    w->trajectory->crossing = (struct slow_crossing){true, (double)vx, (double)vz, (double)spin, (double)height};
}

static void record_flight(struct walker *w, slow_real to)
{
    if (!crosses(w, to))
        return;
    const slow_real g = w->def->gravity, c = w->def->control, t = (c - w->x) / w->vx;
    record(w, w->vx, w->vz - g * t, w->spin, w->z + t * (w->vz - g * t / 2) - ground(find_segment(w->def, c), c));
}

/* Return the gain of u^2 over dx: the drop minus friction, shared with the rotation. It is positive downhill exactly if the
 * segment is steeper than its friction. */
static slow_real roll_gain(const struct walker *w, slow_real dx)
{
    const slow_real net = (dx > 0 ? -w->segment->slope : w->segment->slope) - w->segment->friction;
    return 2 * (slow_real)w->def->gravity * net * fabs(dx) / (1 + inertia(w->def));
}

static void record_roll(struct walker *w, const struct roll *roll, slow_real to)
{
    if (!crosses(w, to))
        return;
    const slow_real u2 = roll->u2 + roll_gain(w, w->def->control - w->x);
    const slow_real u = sqrt(not_below_0(u2)); /* rounding if the rock stops right at the control */
    record(w, u * w->segment->turn.cosine, u * w->segment->turn.sine, rolling_spin(w->def, u), 0);
}

/* ---- stems ---- */

/* Return the next stem, if it stands before `to`. A trajectory back has to < x and meets none. */
static const struct slow_stem *stem_before(const struct walker *w, slow_real to)
{
    const size_t i = w->stems_passed;
    return i < w->def->stems_count && w->def->stems[i].x <= to ? &w->def->stems[i] : NULL;
}

/* Take the energy of a hit. All speeds decrease by one factor. False if the stem stops the rock. */
static bool hit_stem(struct walker *w, const struct slow_stem *stem)
{
    const slow_real rim = w->spin * (slow_real)w->def->radius;
    const slow_real energy = (slow_real)w->def->mass / 2 * (square(w->vx) + square(w->vz) + inertia(w->def) * square(rim));
    const slow_real left = energy > stem->energy ? 1 - stem->energy / energy : 0;
    w->trajectory->hits++;
    w->vx *= sqrt(left);
    w->vz *= sqrt(left);
    w->spin *= sqrt(left);
    return left > 0;
}

/* ---- flight ---- */

/* Return the later root of c + b t - g t^2 / 2, without cancellation. A concave function falls through 0 only at its later
 * root; at the earlier one the rock would leave the ground. */
static slow_real later_root(slow_real c, slow_real b, slow_real g)
{
    const slow_real root = sqrt(not_below_0(b * b + 2 * g * c));
    const slow_real q = b < 0 ? b - root : b + root;
    return q > 0 ? q / g : q < 0 ? -2 * c / q : 0;
}

/* Return the time at which the rock is over x; negative if x has been passed. */
static slow_real compute_time(const struct walker *w, slow_real x)
{
    return not_below_0((x - w->x) / w->vx);
}

/* True if the flight enters the ground between the two ends of a segment; *t is the time. Its height above the segment is c + b
 * t - g t^2 / 2. On the segment of its start c is 0 by definition: rounding must not bury the rock, and its height above the
 * end is exact for any flight length. A flight exactly through the vertex is clear, so that the next segment takes it; NaN is
 * not clear. */
static bool hits_segment(const struct walker *w, const struct slow_segment *s, int direction, slow_real *time)
{
    const slow_real g = w->def->gravity, b = w->vz - s->slope * w->vx;
    const slow_real t_out = compute_time(w, exit_x(s, direction));
    const bool starts = w->on_ground && s == w->segment;
    const slow_real height =
        starts ? t_out * (b - g * t_out / 2) : w->z + t_out * (w->vz - g * t_out / 2) - exit_z(s, direction);
    if (height >= 0)
        return false;
    *time = clamp(later_root(starts ? 0 : w->z - ground(s, w->x), b, g), compute_time(w, exit_x(s, -direction)), t_out);
    return true;
}

/* Return the earliest contact with all segments from here to the end of the profile. */
static struct touch next_touch(const struct walker *w)
{
    const int direction = find_direction(w->vx);
    if (direction == 0) { /* vertical flight */
        const slow_real c = w->on_ground ? 0 : not_below_0(w->z - ground(w->segment, w->x));
        return (struct touch){w->segment, not_below_0(later_root(c, w->vz, (slow_real)w->def->gravity)), w->x};
    }
    struct touch best = {.segment = NULL};
    for (const struct slow_segment *s = w->segment;; s += direction) {
        slow_real t = 0;
        if (hits_segment(w, s, direction, &t) && (!best.segment || t < best.time))
            best = (struct touch){s, t, clamp(w->x + w->vx * t, s->x0, s->x1)};
        if (is_last(w->def, s, direction))
            return best;
    }
}

/* Fly over the next stem, or hit it and begin another flight there. */
static enum todo fly_to_stem(struct walker *w, const struct slow_stem *stem)
{
    const slow_real g = w->def->gravity, x = stem->x, t = compute_time(w, x);
    const struct slow_segment *s = w->segment;
    while (x > s->x1 && !is_last(w->def, s, 1))
        s++;
    const slow_real under = ground(s, x), clearance = not_below_0(w->z + t * (w->vz - g * t / 2) - under);
    w->stems_passed++;
    if (!(clearance < stem->height))
        return TODO_FLIGHT;
    record_flight(w, x);
    w->x = x;
    w->z = under + clearance;
    w->vz -= g * t;
    w->segment = s;
    w->on_ground = false;
    if (!hit_stem(w, stem))
        return end(w, SLOW_STOPPED);
    w->touch = next_touch(w);
    return TODO_FLIGHT;
}

static enum todo fly(struct walker *w)
{
    const slow_real g = w->def->gravity;
    const slow_real to = w->touch.segment ? w->touch.x
                         : w->vx > 0      ? w->def->segments[w->def->count - 1].x1
                                          : w->def->segments[0].x0;
    const struct slow_stem *stem = stem_before(w, to);
    if (stem)
        return fly_to_stem(w, stem);
    if (!w->touch.segment) {
        const slow_real t = compute_time(w, to);
        record_flight(w, to);
        w->x = to;
        w->z += t * (w->vz - g * t / 2);
        return end(w, SLOW_LEFT);
    }
    record_flight(w, to);
    w->x = to;
    w->segment = w->touch.segment;
    w->z = ground(w->segment, w->x);
    w->vz -= g * w->touch.time;
    w->on_ground = true;
    w->rolled = false;
    return TODO_CONTACT;
}

/* ---- contact ---- */

/* Return the facet that is hit. */
static struct slow_turn facet(const struct walker *w)
{
    const slow_real u = w->def->uniform(w->def->context, w->trajectory->contacts), max = w->segment->theta_max;
    const slow_real angle = w->def->facets == SLOW_BOTH       ? max * (2 * u - 1)
                            : along(w, w->segment->turn) >= 0 ? max * u
                                                              : -max * u;
    const struct slow_turn turned = facet_turn(w->segment->angle + angle);
    return outward(w, turned) > 0 ? w->segment->turn : turned; /* a rock cannot hit a face from which it moves away */
}

/* CRSP's scaling of the tangential energy with the normal speed; its limit if Rn = 0. */
static slow_real scaling(slow_real vn, slow_real rn, slow_real rt)
{
    if (rn > 0)
        return rt / (square(vn / (scaling_speed * rn)) + 1);
    return vn > 0 ? 0 : rt;
}

/* Reduce the energy along the facet and of rotation by f and SF; the rock leaves without slip. */
static slow_real crsp_tangential(const struct walker *w, slow_real vn, slow_real vt)
{
    const slow_real rn = w->segment->rn, rt = w->segment->rt, k = inertia(w->def), rim = w->spin * (slow_real)w->def->radius;
    const slow_real f = rt + (1 - rt) / (square((vt - rim) / friction_speed) + (slow_real)1.2L);
    const slow_real speed = sqrt((k * square(rim) + square(vt)) * f * scaling(vn, rn, rt) / (1 + k));
    return vt < 0 || (vt == 0 && w->spin < 0) ? -speed : speed;
}

/* Speed along the facet and of the rim after an impact. */
struct tangential {
    slow_real speed, rim;
};

/* Limit the loss along the facet to `max`, the most that friction can take at this normal impulse. Mirror the impact first, so
 * that the rock arrives with positive speed. Friction then turns the spin forward while the rim is slower than the rock, and
 * backward otherwise, until the rock rolls. */
static struct tangential with_friction_bound(const struct walker *w, slow_real vt, struct tangential law, slow_real max)
{
    const slow_real mirror = vt < 0 ? -1 : 1, min = fabs(vt) - max;
    if (!(fabs(law.speed) < min))
        return law;
    if (w->def->law != SLOW_CRSP)
        return (struct tangential){mirror * min, 0};
    const slow_real rim = mirror * w->spin * (slow_real)w->def->radius, change = max / inertia(w->def);
    slow_real rolls = rim;
    if (rim < min)
        rolls = rim + change < min ? rim + change : min;
    else if (rim > min)
        rolls = rim - change > min ? rim - change : min;
    return (struct tangential){mirror * min, mirror * rolls};
}

static void apply_law(struct walker *w, struct slow_turn a)
{
    const struct slow_def *def = w->def;
    const bool crsp = def->law == SLOW_CRSP;
    const slow_real vn = not_below_0(-outward(w, a)), vt = along(w, a);
    slow_real rebound = w->segment->rn * vn;
    if (crsp || def->scale_rn)
        rebound /= 1 + square(vn / normal_speed);
    const slow_real speed = crsp ? crsp_tangential(w, vn, vt) : w->segment->rt * vt;
    struct tangential out = {speed, crsp ? speed : 0};
    if (def->friction_bound)
        out = with_friction_bound(w, vt, out, w->segment->friction * (vn + rebound));
    set_velocity(w, a, out.speed, rebound);
    w->spin = rolling_spin(def, out.rim);
}

/* A flight that stays within one radius, along the ground and above the segment, counts as rolling. */
static enum todo roll_or_fly(struct walker *w)
{
    const slow_real radius = w->def->radius, cosine = w->segment->turn.cosine;
    w->touch = next_touch(w);
    return w->touch.segment && square(outward(w, w->segment->turn)) / (2 * (slow_real)w->def->gravity * cosine) < radius &&
                   ground_length(w->def, w->x, w->touch.x) < radius
               ? TODO_ROLL
               : TODO_FLIGHT;
}

static enum todo contact(struct walker *w)
{
    const struct slow_def *def = w->def;
    if (w->trajectory->contacts >= def->max_contacts)
        return end(w, SLOW_UNFINISHED);
    const struct walker before = *w;
    apply_law(w, facet(w));
    if (outward(w, w->segment->turn) < 0) /* a facet turned away from the segment may send the rock into the ground */
        set_velocity(w, w->segment->turn, along(w, w->segment->turn), 0);
    const enum todo next = roll_or_fly(w);
    if (def->friction_bound && w->rolled && next == TODO_ROLL) { /* it continues rolling: there was no impact */
        w->vx = before.vx;
        w->vz = before.vz;
        w->spin = before.spin;
    }
    w->trajectory->contacts++;
    if (def->on_contact)
        def->on_contact(def->context, (double)w->x, (double)w->z, (double)w->vx, (double)w->vz, (double)w->spin);
    return next;
}

/* ---- rolling ---- */

/* Convert to the speed without slip that keeps the angular momentum about the contact point. */
static struct roll start_roll(const struct walker *w)
{
    const slow_real k = inertia(w->def), radius = w->def->radius;
    const slow_real u = (along(w, w->segment->turn) + k * w->spin * radius) / (1 + k);
    const int direction = find_direction(u);
    return (struct roll){u * u, radius, direction != 0 ? direction : downhill(w->segment)};
}

static void set_rolling_velocity(struct walker *w, const struct roll *roll)
{
    const slow_real u = roll->direction > 0 ? sqrt(roll->u2) : -sqrt(roll->u2);
    set_velocity(w, w->segment->turn, u, 0);
    w->spin = rolling_spin(w->def, u);
}

static void move_on_segment(struct walker *w, slow_real x)
{
    w->x = x;
    w->z = ground(w->segment, x);
}

/* Pass a vertex at the end of a step: leave the profile, lose the part of u into the ground, follow the ground over the edge,
 * or fly. */
static enum todo pass_vertex(struct walker *w, struct roll *roll)
{
    set_rolling_velocity(w, roll);
    if (is_last(w->def, w->segment, roll->direction))
        return end(w, SLOW_LEFT);
    const struct slow_segment *ahead = w->segment + roll->direction;
    const slow_real turn = (ahead->angle - w->segment->angle) * roll->direction; /* positive at a concave vertex */
    w->segment = ahead;
    if (turn < 0)
        return roll_or_fly(w);
    roll->u2 *= square(not_below_0(cos(turn)));
    return TODO_ROLL;
}

/* Roll to a stem and hit it. A rock that the stem does not stop continues its length. */
static enum todo roll_to_stem(struct walker *w, struct roll *roll, const struct slow_stem *stem)
{
    const slow_real x = stem->x;
    record_roll(w, roll, x);
    roll->u2 = not_below_0(roll->u2 + roll_gain(w, x - w->x)); /* rounding if the rock stops right at the stem */
    roll->left -= fabs(x - w->x) / w->segment->turn.cosine;
    move_on_segment(w, x);
    set_rolling_velocity(w, roll);
    w->stems_passed++;
    if (!hit_stem(w, stem))
        return end(w, SLOW_STOPPED);
    roll->u2 = square(w->vx) + square(w->vz);
    return TODO_ROLL;
}

/* Roll to the next stem, to the next vertex or to the end of the length. A rock on the vertex itself has no step before it in
 * which it could stop. */
static enum todo roll_piece(struct walker *w, struct roll *roll)
{
    const slow_real x_vertex = exit_x(w->segment, roll->direction), length = fabs(x_vertex - w->x) / w->segment->turn.cosine;
    const bool ends = roll->left <= length;
    slow_real to = roll->left < length ? w->x + roll->direction * roll->left * w->segment->turn.cosine : x_vertex;
    const slow_real u2_end = roll->u2 + roll_gain(w, to - w->x);
    const bool stands = to != w->x && !(u2_end > 0);
    if (stands) /* u^2 is linear in x, interpolate its zero */
        to = w->x + (to - w->x) * (roll->u2 > 0 ? roll->u2 / (roll->u2 - u2_end) : 0);
    const struct slow_stem *stem = stem_before(w, to);
    if (stem)
        return roll_to_stem(w, roll, stem);
    record_roll(w, roll, to);
    move_on_segment(w, to);
    if (stands) {
        w->vx = w->vz = w->spin = 0;
        return TODO_STAND;
    }
    roll->u2 = u2_end;
    roll->left -= length;
    if (!ends)
        return pass_vertex(w, roll);
    set_rolling_velocity(w, roll);
    w->rolled = true;
    return TODO_CONTACT;
}

/* ---- standing still ---- */

/* Continue from *s while the ground does `falls` (falls: strictly down, else exactly level); *s becomes the first segment that
 * does not. False at the end of the profile. */
static bool follow(const struct slow_def *def, const struct slow_segment **s, int direction, bool falls)
{
    for (;; *s += direction) {
        const slow_real up = direction * ((*s)->z1 - (*s)->z0);
        if (!(falls ? up < 0 : up == 0))
            return true;
        if (is_last(def, *s, direction))
            return false;
    }
}

/* True if the ground from a segment on rises to z before it falls again. */
static bool rises_to_height(const struct slow_def *def, const struct slow_segment *s, int direction, slow_real z)
{
    for (;; s += direction) {
        if (direction * (s->z1 - s->z0) < 0)
            return false;
        if (exit_z(s, direction) >= z)
            return true;
        if (is_last(def, s, direction))
            return false;
    }
}

/* Without this a rock would swing in a pit for ever. The bottom is a concave vertex, or a level stretch shorter than the
 * radius. A rock held by friction on either side is not in a pit. */
static bool stands_in_pit(const struct walker *w)
{
    const struct slow_def *def = w->def;
    const int direction = downhill(w->segment);
    const slow_real radius = def->radius;
    const struct slow_segment *beyond = w->segment;
    if (!follow(def, &beyond, direction, true))
        return false;
    const struct slow_segment *before = beyond - direction;
    const slow_real bottom = exit_x(beyond, -direction);
    if (!follow(def, &beyond, direction, false))
        return false;
    return ground_length(def, bottom, exit_x(beyond, -direction)) < radius && ground_length(def, w->x, bottom) < radius &&
           steeper_than_friction(before) && steeper_than_friction(beyond) && rises_to_height(def, beyond, direction, w->z);
}

static bool is_at_rest(const struct walker *w)
{
    return !steeper_than_friction(w->segment) || stands_in_pit(w);
}

static enum todo stand(struct walker *w)
{
    if (is_at_rest(w))
        return end(w, SLOW_REST);
    if (w->trajectory->contacts >= w->def->max_contacts)
        return end(w, SLOW_UNFINISHED);
    w->trajectory->contacts++; /* the new roll from rest, so that no trajectory continues uncounted */
    return TODO_ROLL;
}

/* A rock without speed after a contact may rest at its place; otherwise it continues with the roll of that contact. */
static enum todo roll(struct walker *w)
{
    struct roll now = start_roll(w);
    if (now.u2 == 0 && is_at_rest(w))
        return end(w, SLOW_REST);
    enum todo next;
    do
        next = roll_piece(w, &now);
    while (next == TODO_ROLL);
    return next;
}

/* ---- trajectory ---- */

static enum todo release(struct walker *w)
{
    w->segment = find_segment(w->def, w->x);
    const slow_real under = ground(w->segment, w->x);
    w->on_ground = !(w->z > under) || (double)w->z == (double)under; /* the caller's heights are doubles */
    if (w->on_ground)
        w->z = under;
    if (w->on_ground && outward(w, w->segment->turn) <= 0)
        return TODO_CONTACT;
    w->touch = next_touch(w);
    return TODO_FLIGHT;
}

struct slow_trajectory slow_walk(const struct slow_def *def)
{
    static enum todo (*const steps[])(struct walker *) = {
        [TODO_CONTACT] = contact, [TODO_FLIGHT] = fly, [TODO_ROLL] = roll, [TODO_STAND] = stand};
    struct slow_trajectory trajectory = {.contacts = 0};
    struct walker w = {.def = def, .trajectory = &trajectory, .x = def->x0, .z = def->z0, .vx = def->vx0, .vz = def->vz0};
    w.spin = def->law == SLOW_CRSP ? (slow_real)def->spin0 : 0;
    enum todo todo = release(&w);
    while (todo != TODO_NOTHING)
        todo = steps[todo](&w);
    trajectory.x = (double)w.x;
    trajectory.z = (double)w.z;
    return trajectory;
}
