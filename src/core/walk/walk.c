/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One rock from its release to its end: it flies to its next contact (flying.h), is thrown off again or rolls
 * (rolling.h), until it rests, leaves the slope, is stopped by a stem, or takes too long. The walk of lanes (kernel_text.h) does
 * the same for many rocks and hands over to this one what is rare. */
#include "walk.h"

#include "rolling.h"

/* ---- release ---- */

static double draw_release(const struct walker *w, struct ceduo_number n, uint64_t event)
{
    if (!(n.spread > 0))
        return n.mean;
    return ceduo_number_draw(n, random_open(w->seed, w->number, event, RANDOM_RELEASE), -INFINITY, INFINITY);
}

/* Under the law arm the rock's inertia is that of the section which it got. */
static void draw_section(struct walker *w)
{
    double u = random_pair(w->seed, w->number, 0, RANDOM_SECTION).u[0];
    w->section = section_of(&w->rock, (int)(3 * u));
    w->k = 1 / (w->section.reach * w->section.reach);
    w->rock.k = w->k;
    w->rock.moment = w->k * w->rock.mass * w->rock.radius * w->rock.radius;
}

enum ceduo_status ceduo_walk_release(struct walker *w, const struct prepared *ready, uint64_t number)
{
    const struct ceduo_scene *scene = &ready->scene;
    const struct ground *g = w->g = &ready->ground;
    w->marks = &ready->marks;
    w->seed = scene->simulation.seed;
    w->number = number;
    w->scale_rn = scene->simulation.scale_rn;
    w->friction_bound = scene->simulation.friction_bound;
    enum ceduo_status status = ceduo_prepared_rock(ready, number, &w->rock);
    if (status != CEDUO_OK)
        return status;
    w->rn_u = g->rn_varies ? random_open(w->seed, number, 0, RANDOM_GROUND) : 0;
    w->rt_u = g->rt_varies ? random_open(w->seed, number, 1, RANDOM_GROUND) : 0;
    for (size_t i = 0; i < g->roughness_count; i++)
        w->theta[i] = roughness_angle(g->roughness[i], w->rock.radius);
    double x = draw_release(w, scene->release.x, 0), height = draw_release(w, scene->release.height, 1);
    const struct contact_law *law = contact_laws[scene->simulation.law];
    w->k = law->spins ? w->rock.k : 0;
    w->has_section = law->sections;
    if (w->has_section)
        draw_section(w);
    w->spin = law->spins ? draw_release(w, scene->release.spin, 4) : 0;
    size_t segment = ceduo_ground_segment(g, x);
    w->at = (struct flight){.x = x,
                            .z = ground_height(g, segment, x) + height,
                            .vx = draw_release(w, scene->release.vx, 2),
                            .vz = draw_release(w, scene->release.vz, 3),
                            .segment = segment,
                            .on_ground = !(height > 0)};
    w->contacts = 0;
    w->pause = next_pause(w);
    w->stems_pause = PAUSE;
    w->cancelled = w->gives_up = false;
    w->facets.of = w->turns.of = UINT64_MAX;
    w->next_mark = 0; /* all stand below each release */
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

bool ceduo_walk_alike(const struct prepared *ready)
{
    const struct ground *g = &ready->ground;
    const struct ceduo_release *r = &ready->scene.release;
    return !ceduo_scene_rock_varies(&ready->scene) && !g->rn_varies && !g->rt_varies && !(r->x.spread > 0) &&
           !(r->height.spread > 0) && !(r->vx.spread > 0) && !(r->vz.spread > 0) && !(r->spin.spread > 0);
}

void ceduo_walk_release_again(struct walker *w, const struct walker *first, uint64_t number)
{
    w->number = number;
    w->spin = first->spin;
    w->at = first->at;
    w->contacts = 0;
    w->pause = first->pause;
    w->cancelled = false;
    w->facets.of = w->turns.of = UINT64_MAX;
    w->next_mark = first->next_mark;
    w->next_x = first->next_x;
    if (w->has_section)
        draw_section(w);
}

/* ---- the whole trajectory ---- */

/* Whether a long trajectory is to end here: too many contacts, or nobody waits for it any more. */
NOINLINE bool has_enough(struct walker *w)
{
    if (w->arrivals_only && is_behind_marks(w))
        return true;
    w->pause = next_pause(w);
    w->cancelled = is_cancelled(w);
    return w->cancelled || w->contacts >= CEDUO_CONTACTS_MOST;
}

/* Lands at `l`, which may not be known yet, past the stems before it; false where that ends it. */
FORCE_INLINE bool come_down(struct walker *w, struct flight *at, struct landing *l, bool knows_landing, enum ceduo_end *end)
{
    if ((!knows_landing || stem_on_way(w, l->x)) && fly_past_stems(w, at, l, knows_landing)) {
        w->at = *at;
        *end = w->gives_up ? CEDUO_UNFINISHED : CEDUO_STOPPED_BY_STEMS;
        return false;
    }
    fly(w, at, l);
    if (l->left) {
        w->at = *at;
        *end = CEDUO_LEFT_SLOPE;
        return false;
    }
    return true;
}

/* The same for a rock that rolls after a contact, standing still where it does until it rests or rolls on. */
bool ceduo_walk_roll(struct walker *w, struct course *c, const struct rolling *before, enum ceduo_end *end)
{
    bool enough = false;
    w->at = c->at;
    if (before) {
        c->along = before->along;
        w->spin = before->spin;
    }
    double u = rolling_speed(c->along, w->k, w->spin, w->rock.radius);
    enum after_roll then = u == 0 && rests(w) ? STANDS : roll_on(w, u, &c->l);
    while (then == STANDS && !rests(w) && !(enough = w->contacts >= w->pause && has_enough(w))) {
        w->contacts++;
        then = roll_on(w, 0, &c->l);
    }
    *end = then == STANDS && !enough         ? CEDUO_AT_REST
           : then == ROLLED_OUT              ? CEDUO_LEFT_SLOPE
           : then == STOPPED && !w->gives_up ? CEDUO_STOPPED_BY_STEMS
                                             : CEDUO_UNFINISHED;
    c->at = w->at;
    c->along = w->along;
    c->off = 0;
    c->flies = then == TOOK_OFF;
    c->rolled = then == ROLLED;
    return then == TOOK_OFF || then == ROLLED;
}

FORCE_INLINE void set_velocity(const struct walker *w, struct course *c)
{
    struct velocity v = velocity_at(w, &c->at);
    c->along = v.along;
    c->off = v.off;
}

FORCE_INLINE void start(const struct walker *w, struct course *c)
{
    c->at = w->at;
    set_velocity(w, c);
    c->flies = !c->at.on_ground || c->off > 0;
    if (c->flies)
        c->l = next_landing(w->g, &c->at);
}

FORCE_INLINE enum ceduo_end walk_over(struct walker *w, struct course c, const struct contact_law *law, bool blocks)
{
    struct flight at = c.at; /* w->at is brought up to date for those who are called */
    struct velocity v = {c.along, c.off};
    struct facet facet = {.angle = 0, .sine = 0, .cosine = 1};
    struct landing l = c.l;
    bool flies = c.flies, rolled = c.rolled;
    enum ceduo_end end;
    for (;;) {
        if (flies) {
            if (!come_down(w, &at, &l, true, &end))
                return end;
            v = velocity_at(w, &at);
            rolled = false;
        }
        if (w->contacts >= w->pause && has_enough(w)) {
            w->at = at;
            return CEDUO_UNFINISHED;
        }
        const struct rolling before = {.along = v.along, .spin = w->spin};
        strike_ground(w, &at, &v, &facet, law);
        w->contacts++;
        turn_facet(w, at.segment, &facet);
        at.on_ground = true;
        l = next_landing_over(w->g, &at, blocks);
        flies = !is_roll(w, &at, v.off, &l);
        if (flies)
            continue;
        c.at = at;
        c.along = v.along;
        if (!ceduo_walk_roll(w, &c, rolled && w->friction_bound ? &before : NULL, &end))
            return end;
        at = c.at;
        v = (struct velocity){c.along, c.off};
        l = c.l;
        flies = c.flies;
        rolled = c.rolled;
    }
}

/* The walk of each law. */
#define X(NAME, name)                                                                                                          \
    static enum ceduo_end walk_##name(struct walker *w, const struct course *c)                                                \
    {                                                                                                                          \
        return w->g->top > 0 ? walk_over(w, *c, &law_##name, true) : walk_over(w, *c, &law_##name, false);                     \
    }
CEDUO_LAWS(X)
#undef X

enum ceduo_end ceduo_walk_on(struct walker *w, const struct course *c, enum ceduo_law law)
{
    static enum ceduo_end (*const walks[])(struct walker *, const struct course *) = {
#define X(NAME, name) walk_##name,
        CEDUO_LAWS(X)
#undef X
    };
    return walks[law](w, c);
}

enum ceduo_end ceduo_walk(struct walker *w, enum ceduo_law law)
{
    struct course c = {.flies = false};
    start(w, &c);
    return ceduo_walk_on(w, &c, law);
}

/* ---- the trajectory in pieces ---- */

bool ceduo_walk_take_stem(struct walker *w, bool hit, struct flight at, double t)
{
    const struct stem stem = *ceduo_stems_next(&w->stems->side[0]);
    go_to_next_stem(w, 0);
    if ((hit || w->gives_up) && w->next_x <= stem.along)
        ceduo_walk_pass_marks(w, at, stem.along, t);
    if (hit && !w->gives_up)
        count_hit(w, &stem);
    return !w->gives_up;
}

bool ceduo_walk_come_down(struct walker *w, struct course *c, enum ceduo_end *end)
{
    if (c->flies) {
        if (!come_down(w, &c->at, &c->l, !c->aloft, end))
            return false;
        set_velocity(w, c);
        c->flies = c->aloft = false;
    }
    if (w->contacts >= w->pause && has_enough(w)) {
        w->at = c->at;
        *end = CEDUO_UNFINISHED;
        return false;
    }
    return true;
}

bool ceduo_walk_start(struct walker *w, struct course *c, enum ceduo_end *end)
{
    start(w, c);
    return ceduo_walk_come_down(w, c, end);
}

bool ceduo_walk_rolls(const struct walker *w, struct course *c, bool knows_landing)
{
    if (!knows_landing)
        c->l = next_landing(w->g, &c->at);
    c->flies = !is_roll(w, &c->at, c->off, &c->l);
    return !c->flies;
}

void ceduo_walk_ground(const struct walker *w, size_t segment, double *rn, double *rt, double *largest_angle)
{
    struct ground_point p = ground_point(w, segment);
    *rn = p.rn;
    *rt = p.rt;
    *largest_angle = largest_facet(w, segment);
}
