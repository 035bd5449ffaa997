/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STEMS_H
#define CEDUO_STEMS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "ceduo/rock.h"
#include "ceduo/trajectory.h"
#include "wood.h"

/* The stems in one rock's path, drawn as it reaches them. Stools and trees are Poisson processes in the plane, of which
 * the rock sweeps a strip as wide as itself: what stands beside the strip is never drawn, and what is drawn is distributed as
 * on a full map. Ahead of the release (side 0, along +x) and behind it (side 1) there is one such strip each; places along
 * side 1 are -x. Ground is covered once: a stem that was passed is gone. */

struct stem {
    double along, y;  /* m: place along the strip, offset from its middle */
    double dbh;       /* m; NaN where contacts have no diameter */
    const struct wood_kind *kind;
    uint64_t stool; /* which stool or tree it is, or belongs to; the last bit is the side that it was drawn for */
    bool shoot;
    bool met;       /* it waits behind the release, and another shoot of its stool was hit ahead */
};

/* The next of one stratum. */
struct stream {
    double at; /* m along the strip, infinite behind the last */
    size_t belt;
    uint64_t drawn;
    double offset;        /* uniform in [0, 1): how far from the middle of the strip */
    double number, turn;  /* likewise: of a stool, what decides how many shoots it has and how its ring is turned */
};

struct stems_side {
    struct stream *streams; /* one for each stratum; the first of `stems` is the stools */
    struct stem *waiting;   /* shoots of drawn stools that the rock can hit, from `first` to before `end`, the nearest first */
    size_t first, end, room;
    double next;            /* m along the strip: no stem before */
    bool next_known;        /* a stem stands there; otherwise stools up to there have not been drawn yet */
    bool next_waits;        /* it is one of those waiting; otherwise the next of `single` */
    size_t single;          /* the stream whose next is the nearest, but for stools */
    double single_at;
};

struct stems {
    const struct wood *wood;
    bool poisson;
    uint64_t seed, number; /* of the rock */
    double b;              /* its mean diameter, m */
    double start;          /* x of its release */
    struct stems_side side[2];
    bool behind_ready;
    uint64_t *met;         /* stools that were hit, each at the place of its number's last bits: those that the way is among
                            * at a time are far fewer than the places */
    bool no_memory;        /* the trajectory is not to be used */
    uint64_t drawn;        /* stems drawn */
    uint64_t effort;       /* the same, and what is done to keep them in order, in units of one stem */
    uint64_t pause;        /* effort at which the drawing stops for a moment: the rock may be waited for no longer */
};

/* Whether a rock has met too many stems to be followed further. */
static inline bool ceduo_stems_too_many(const struct stems *stems)
{
    return stems->effort > CEDUO_STEMS_MOST;
}

/* False without memory. */
bool ceduo_stems_init(struct stems *stems, const struct wood *wood, bool poisson);
void ceduo_stems_release(struct stems *stems);

/* Begins the trajectory of rock `number`, of mean diameter b, released at x. */
void ceduo_stems_begin(struct stems *stems, uint64_t seed, uint64_t number, double b, double x);

/* Takes the next stem of a side and looks for the one after it. False: no stem is taken, because what stands at
 * side[].next was not known yet; side[].next has moved on. Each call does a bounded amount of work. */
bool ceduo_stems_take(struct stems *stems, int side, struct stem *stem);

/* A stool astride of the release was hit: its shoots that wait behind know of it, however late the rock comes to them. */
void ceduo_stems_meet_behind(struct stems *stems, uint64_t stool);

/* Notes that a stem was hit; whether its stool or tree was not hit before. */
static inline bool ceduo_stems_meet(struct stems *stems, const struct stem *stem)
{
    if (!stem->shoot)
        return true;
    uint64_t *place = &stems->met[stem->stool & stems->wood->places];
    bool first = *place != stem->stool && !stem->met;
    *place = stem->stool;
    if (first && !(stem->stool & 1) && stem->along <= stems->start + 2 * stems->wood->reach)
        ceduo_stems_meet_behind(stems, stem->stool);
    return first;
}

/* Energy (J) that a hit of this stem takes from a rock of diameter b. */
static inline double ceduo_stem_energy(const struct stem *stem, double b)
{
    const struct wood_kind *k = stem->kind;
    return k->energy >= 0 ? k->energy : stem_energy_hit(&k->by_hit, stem->dbh, 2 * fabs(stem->y) / (b + stem->dbh));
}

#endif
