/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One rock from its release to its end. It flies to its next contact (flying.h), then bounces or rolls (rolling.h), until it
 * rests, leaves the slope, is stopped by a stem, or exceeds a limit. The walk of lanes (kernel_text.h) does the same for many
 * rocks and passes rare events to this one. */
#include "walk.h"
#include "scene/derived.h"

#include "rolling.h"

/* ---- release ---- */

/* Return the release of a rock. Shares need not add up to 1. */
static const struct ceduo_release *choose_release(const struct walker *w, const struct ceduo_scene *scene)
{
    size_t n, i = 0;
    const struct ceduo_release *releases = ceduo_scene_releases(scene, &n);
    double all = 0;
    for (size_t k = 0; k < n && n > 1; k++)
        all += releases[k].share;
    double remaining = n > 1 ? all * random_open(w->seed, w->number, 5, RANDOM_RELEASE) : 0;
    while (i + 1 < n && (remaining -= releases[i].share) > 0)
        i++;
    return &releases[i];
}

static double draw_release(const struct walker *w, struct ceduo_number n, uint64_t event)
{
    if (!(n.spread > 0))
        return n.mean;
    return ceduo_number_draw(n, random_open(w->seed, w->number, event, RANDOM_RELEASE), -INFINITY, INFINITY);
}

/* Draw the section. Under the arm law it determines the rock's inertia. */
static void draw_section(struct walker *w)
{
    double u = random_pair(w->seed, w->number, 0, RANDOM_SECTION).u[0];
    w->section = make_section(&w->rock, (int)(3 * u));
    w->k = 1 / (w->section.reach * w->section.reach);
    w->rock.k = w->k;
    w->rock.moment = w->k * w->rock.mass * w->rock.radius * w->rock.radius;
}

enum ceduo_status ceduo_walk_release(struct walker *w, const struct prepared_scene *prepared, uint64_t number)
{
    const struct ceduo_scene *scene = &prepared->scene;
    const struct ground *g = w->g = &prepared->ground;
    w->marks = &prepared->marks;
    w->seed = scene->simulation.seed;
    w->number = number;
    w->scale_rn = scene->simulation.scale_rn;
    w->friction_bound = scene->simulation.friction_bound;
    enum ceduo_status status = ceduo_prepared_rock(prepared, number, &w->rock);
    if (status != CEDUO_OK)
        return status;
    w->rn_u = g->rn_varies ? random_open(w->seed, number, 0, RANDOM_GROUND) : 0;
    w->rt_u = g->rt_varies ? random_open(w->seed, number, 1, RANDOM_GROUND) : 0;
    for (size_t i = 0; i < g->roughness_count; i++)
        w->theta[i] = roughness_angle(g->roughness[i], w->rock.radius);
    const struct ceduo_release *release = w->release = choose_release(w, scene);
    double x = draw_release(w, release->x, 0), height = draw_release(w, release->height, 1);
    const struct contact_law *law = contact_laws[scene->simulation.law];
    w->k = law->spins ? w->rock.k : 0;
    w->has_section = law->sections;
    if (w->has_section)
        draw_section(w);
    w->spin = law->spins ? draw_release(w, release->spin, 4) : 0;
    size_t segment = ceduo_ground_segment(g, x);
    w->flight = (struct flight){.x = x,
                                .z = ground_height(g, segment, x) + height,
                                .vx = draw_release(w, release->vx, 2),
                                .vz = draw_release(w, release->vz, 3),
                                .segment = segment};
    w->on_ground = !(height > 0);
    w->contacts = 0;
    w->pause = next_pause(w);
    w->stems_pause = PAUSE;
    w->cancelled = w->aborted = false;
    w->facets.index = w->turns.index = UINT64_MAX;
    w->next_mark = 0; /* all marks are below the release */
    set_next_x(w);
    w->stems_hit = w->stools_met = 0;
    w->stem_ahead = INFINITY;
    w->stem_behind = -INFINITY;
    if (w->stems) {
        ceduo_stems_begin(w->stems, w->seed, number, w->rock.mean_diameter, x);
        set_next_stems(w);
    }
    return CEDUO_OK;
}

bool ceduo_walk_is_identical(const struct prepared_scene *prepared)
{
    const struct ground *g = &prepared->ground;
    size_t n;
    const struct ceduo_release *r = ceduo_scene_releases(&prepared->scene, &n);
    return prepared->scene.releases_count <= 1 && !ceduo_scene_rock_varies(&prepared->scene) && !g->rn_varies &&
           !g->rt_varies && !(r->x.spread > 0) && !(r->height.spread > 0) && !(r->vx.spread > 0) && !(r->vz.spread > 0) &&
           !(r->spin.spread > 0);
}

void ceduo_walk_release_identical(struct walker *w, const struct walker *first, uint64_t number)
{
    w->number = number;
    w->release = first->release;
    w->spin = first->spin;
    w->flight = first->flight;
    w->on_ground = first->on_ground;
    w->contacts = 0;
    w->pause = first->pause;
    w->cancelled = false;
    w->facets.index = w->turns.index = UINT64_MAX;
    w->next_mark = first->next_mark;
    w->next_x = first->next_x;
    if (w->has_section)
        draw_section(w);
}

/* ---- the whole trajectory ---- */

/* True if the trajectory must end: too many contacts, or cancelled. */
NOINLINE bool must_stop(struct walker *w)
{
    if (w->arrivals_only && is_behind_marks(w))
        return true;
    w->pause = next_pause(w);
    w->cancelled = is_cancelled(w);
    return w->cancelled || w->contacts >= CEDUO_CONTACTS_MAX;
}

/* Fly past the stems to the landing `l`, which may be unknown. False if the trajectory ends. */
FORCE_INLINE bool come_down(struct walker *w, struct flight *flight, struct landing *l, bool landing_known, enum ceduo_end *end)
{
    if ((!landing_known || stem_before(w, l->x)) && fly_past_stems(w, flight, l, landing_known)) {
        w->flight = *flight;
        *end = w->aborted ? CEDUO_END_UNFINISHED : CEDUO_END_STOPPED_BY_STEMS;
        return false;
    }
    fly(w, flight, l);
    if (l->off_slope) {
        w->flight = *flight;
        *end = CEDUO_END_LEFT_SLOPE;
        return false;
    }
    return true;
}

/* A rock that stands still rolls again until it rests, leaves or reaches a limit. */
bool ceduo_walk_roll(struct walker *w, struct rock_state *c, const struct rolling *before, enum ceduo_end *end)
{
    bool stops = false;
    w->contact = c->contact;
    if (before)
        w->spin = before->spin;
    double u = rolling_speed(before ? before->along : c->contact.along, w->k, w->spin, w->rock.radius);
    enum roll_outcome outcome = u == 0 && rests(w) ? STANDS : roll_on(w, u, &c->l);
    while (outcome == STANDS && !rests(w) && !(stops = w->contacts >= w->pause && must_stop(w))) {
        w->contacts++;
        outcome = roll_on(w, 0, &c->l);
    }
    *end = outcome == STANDS && !stops         ? CEDUO_END_AT_REST
           : outcome == ROLLED_OUT             ? CEDUO_END_LEFT_SLOPE
           : outcome == STOPPED && !w->aborted ? CEDUO_END_STOPPED_BY_STEMS
                                               : CEDUO_END_UNFINISHED;
    c->flies = outcome == LIFTED_OFF;
    c->rolled = outcome == ROLLED;
    if (!c->flies)
        w->contact.off = 0;
    c->contact = w->contact;
    w->flight = c->flight = begin_flight(w->g, &w->contact);
    return c->flies || c->rolled;
}

FORCE_INLINE void start(const struct walker *w, struct rock_state *c)
{
    const struct flight *f = &w->flight;
    const struct ground_segment *s = &w->g->segments[f->segment];
    double off = (f->vz - ground_slope(w->g, f->segment) * f->vx) * s->c; /* exactly 0 if parallel to the ground */
    c->contact = (struct contact){f->segment, ground_along(w->g, f->segment, f->x), f->vx * s->c + f->vz * s->s, off};
    c->flies = !w->on_ground || off > 0;
    bool from_ground = w->on_ground && f->vx != 0; /* a vertical flight stays at its x */
    c->flight = from_ground ? begin_flight(w->g, &c->contact) : *f;
    if (c->flies)
        c->l = from_ground ? next_contact(w->g, &c->contact, &c->flight, w->g->top > 0) : next_landing(w->g, f);
}

FORCE_INLINE enum ceduo_end walk_over(struct walker *w, struct rock_state c, const struct contact_law *law, bool chunks)
{
    struct flight flight = c.flight; /* w->flight is updated before the end */
    struct contact contact = c.contact;
    struct facet facet = {.angle = 0, .sine = 0, .cosine = 1};
    struct landing l = c.l;
    bool flies = c.flies, rolled = c.rolled;
    enum ceduo_end end;
    for (;;) {
        if (flies) {
            if (!come_down(w, &flight, &l, true, &end))
                return end;
            contact = l.contact;
            rolled = false;
        }
        if (w->contacts >= w->pause && must_stop(w)) {
            w->flight = begin_flight(w->g, &contact);
            return CEDUO_END_UNFINISHED;
        }
        const struct rolling before = {.along = contact.along, .spin = w->spin};
        strike_ground(w, &contact, &facet, law);
        w->contacts++;
        turn_facet(w, contact.segment, &facet);
        flight = begin_flight(w->g, &contact);
        l = next_contact(w->g, &contact, &flight, chunks);
        flies = !is_roll(w, &contact, &flight, &l);
        if (flies)
            continue;
        c.contact = contact;
        if (!ceduo_walk_roll(w, &c, rolled && w->friction_bound ? &before : NULL, &end))
            return end;
        flight = c.flight;
        contact = c.contact;
        l = c.l;
        flies = c.flies;
        rolled = c.rolled;
    }
}

/* One walk per law. */
#define X(NAME, name)                                                                                                          \
    static enum ceduo_end walk_##name(struct walker *w, const struct rock_state *c)                                            \
    {                                                                                                                          \
        return w->g->top > 0 ? walk_over(w, *c, &law_##name, true) : walk_over(w, *c, &law_##name, false);                     \
    }
CEDUO_LAWS(X)
#undef X

enum ceduo_end ceduo_walk_continue(struct walker *w, const struct rock_state *c, enum ceduo_law law)
{
    static enum ceduo_end (*const walks[])(struct walker *, const struct rock_state *) = {
#define X(NAME, name) walk_##name,
        CEDUO_LAWS(X)
#undef X
    };
    return walks[law](w, c);
}

enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law)
{
    struct rock_state c = {.flies = false};
    start(w, &c);
    return ceduo_walk_continue(w, &c, law);
}

/* ---- steps of a trajectory ---- */

bool ceduo_walk_hit_stem(struct walker *w, bool hit, const struct flight *flight, double t)
{
    const struct stem stem = *ceduo_stems_next(&w->stems->side[0]);
    advance_stem(w, 0);
    if ((hit || w->aborted) && w->next_x <= stem.along)
        ceduo_walk_pass_marks(w, flight, stem.along, t);
    if (hit && !w->aborted)
        count_hit(w, &stem);
    return !w->aborted;
}

bool ceduo_walk_land(struct walker *w, struct rock_state *c, enum ceduo_end *end)
{
    if (c->flies) {
        if (!come_down(w, &c->flight, &c->l, !c->landing_unknown, end))
            return false;
        c->contact = c->l.contact;
        c->flies = c->landing_unknown = false;
    }
    if (w->contacts >= w->pause && must_stop(w)) {
        w->flight = begin_flight(w->g, &c->contact);
        *end = CEDUO_END_UNFINISHED;
        return false;
    }
    return true;
}

bool ceduo_walk_start(struct walker *w, struct rock_state *c, enum ceduo_end *end)
{
    start(w, c);
    return ceduo_walk_land(w, c, end);
}

bool ceduo_walk_rolls(const struct walker *w, struct rock_state *c)
{
    c->flight = begin_flight(w->g, &c->contact);
    c->l = next_contact(w->g, &c->contact, &c->flight, w->g->top > 0);
    c->flies = !is_roll(w, &c->contact, &c->flight, &c->l);
    return !c->flies;
}

void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle)
{
    struct ground_point p = ground_point(w, segment);
    *rn = p.rn;
    *rt = p.rt;
    *largest_angle = largest_facet(w, segment);
}
