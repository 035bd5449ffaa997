/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STEMS_STATE_H
#define CEDUO_STEMS_STATE_H

#include <stddef.h>
#include <stdint.h>

#include "wood.h"

/* What stems.c keeps of the stems in one rock's path, for it and for stems_fill.h. */

struct stem {
    double along;   /* m: place along the strip */
    double energy;  /* J that it takes of a rock as large as this one that has as much */
    double height;  /* m, of its kind */
    uint64_t stool; /* which stool or tree it is, or belongs to; the last bit is the side that it was drawn for */
    const struct wood_kind *kind;
    double y;   /* m: offset from the middle of the strip */
    double dbh; /* m; NaN where contacts have no diameter */
    bool shoot;
    bool met; /* it waits behind the release, and another shoot of its stool was hit ahead */
};

/* Streams of places along a side: of stools, of all that stands by itself, and of groups of trees where there are any. */
enum stem_stream { STREAM_STOOLS, STREAM_SINGLE, STREAM_GROUPS, STREAMS };

/* The next places of a stream, which are drawn many at a time. */
#define POINTS         16
#define POINTS_ROOM    (POINTS + 8) /* they may be read some at once from any of them on */
#define POINTS_FEW     8            /* of trees among stools */
#define COHORT_GROUPS  4            /* of four shoots: cohorts of so many are drawn together */
#define SHOOTS_AT_ONCE 64           /* so many are put in order at once, more than STOP_SHOOTS and those of a last stool */
#define STOP_SHOOTS    24
#define SHOOTS_FEW     (SHOOTS_AT_ONCE - STOP_SHOOTS)
struct points {
    double at[POINTS_ROOM];     /* m along the strip */
    double offset[POINTS_ROOM]; /* uniform in (-1/2, 1/2): how far from the middle of the strip */
    double mark[POINTS_ROOM];   /* uniform in (0, 1): which of those that the stream is made of */
    double turn[POINTS_ROOM];   /* likewise in (-1/2, 1/2) */
    /* of a stool: its middle from that of the strip, and the first place of its ring from there */
    double centre[POINTS_ROOM], sine[POINTS_ROOM], cosine[POINTS_ROOM]; /* m */
    uint64_t more[POINTS_ROOM];                                         /* 1: it has one shoot more than others */
    uint64_t cohorts[COHORT_GROUPS][2][POINTS_ROOM];                    /* of the first shoots of a stool */
    size_t belt[POINTS];
    unsigned next, count; /* of `size`, fewer only where the forest ends */
    unsigned size;
    uint64_t drawn; /* of the whole stream */
    double end;     /* m: where drawing goes on */
    size_t end_belt;
};

struct stems_side {
    struct points streams[STREAM_GROUPS];
    struct points *groups; /* the third stream; NULL: there are none */
    double other_to;       /* m along the strip: behind that none waits but shoots as thick as all of their kind */
    struct stem single;    /* the next of its stream; `along` infinite: none */
    /* shoots of drawn stools, and trees of drawn groups, that the rock can hit, from `first` to before `end`, the nearest first; room
     * for one more */
    struct stem *waiting;
    size_t first, end, room;
    double sure;     /* m along the strip: a waiting stem before that is next if it is the first of them */
    double next;     /* m along the strip: no stem before */
    bool next_known; /* a stem stands there; otherwise stools or groups up to there have not been drawn yet */
    bool next_waits; /* it is one of those waiting; otherwise `single` */
};

/* A stool that a stream has come to: where it stands, and its ring. */
struct stool {
    double at, centre, sine, cosine;
    const struct wood_stools *stools;
    const double *ring, *sines; /* of its ring */
    unsigned n;
    uint64_t event;
};

/* Places of a belt for a rock of diameter b: so many per metre, and its inverse. */
struct belt_rates {
    double b, rate[STREAMS], metres[STREAMS];
};

struct stems;

/* Functions of stems_fill.h, compiled for some kind of registers. */
struct stems_kernel {
    /* Draws the next places of a stream. */
    void (*fill)(struct stems *stems, int side, enum stem_stream stream);
    /* Makes some of the stools that come next on a side, of which the shoots are alike and stand ahead of the release;
     * there is room for SHOOTS_AT_ONCE. */
    void (*make_stools)(struct stems *stems, int side);
};

struct stems {
    const struct wood *wood;
    const struct stems_kernel *kernel;
    uint64_t seed, number;    /* of the rock */
    double b;                 /* its mean diameter, m */
    double start;             /* x of its release */
    struct belt_rates *rates; /* of the belts of wood->along[0] */
    struct stems_side side[2];
    bool behind_ready;
    uint64_t *met;   /* stools that were hit, each at the place of its number's last bits: those that the way is among
                            * at a time are far fewer than the places */
    bool no_memory;  /* the trajectory is not to be used */
    uint64_t drawn;  /* stems drawn */
    uint64_t effort; /* the same, and what is done to keep them in order, in units of one stem */
    char apart[320]; /* of those of other lanes: whole pages would put all on a few lines of the cache */
    uint64_t pause;  /* effort at which the drawing stops for a moment: the rock may be waited for no longer */
};

/* So high a stem can be hit by this rock: up to its top, or to where its underside is when its centre is too high. */
static inline double height_hit(const struct stems *s, const struct wood_kind *kind)
{
    double below = kind->below - 0.5 * s->b;
    return kind->height < below ? kind->height : below;
}

static inline struct points *points_of(struct stems_side *side, enum stem_stream stream)
{
    return stream == STREAM_GROUPS ? side->groups : &side->streams[stream];
}

static inline enum stem_stream stream_of(const struct wood_stratum *stratum)
{
    return !stratum->kind ? STREAM_STOOLS : stratum->group > 0 ? STREAM_GROUPS : STREAM_SINGLE;
}

#endif
