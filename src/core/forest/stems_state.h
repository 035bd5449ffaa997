/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_STEMS_STATE_H
#define CEDUO_STEMS_STATE_H

#include <stddef.h>
#include <stdint.h>

#include "forest.h"

/* State of the stems in the path of one rock, for stems.c and stems_fill.h. */

struct stem {
    double along;   /* m: place along the strip */
    double energy;  /* J that it takes from this rock, if the rock has as much */
    double height;  /* m, of its kind */
    uint64_t stool; /* number of the stool or tree; the lowest bit is the side of drawing */
    const struct forest_kind *kind;
    double y;   /* m: offset from the centre line of the strip */
    double dbh; /* m; NaN: a log */
    bool shoot;
    bool stool_hit; /* queued behind the release, and another shoot of its stool was hit ahead */
};

/* Streams of places along a side: stools; single trees, stumps and logs; groups of trees, if any. */
enum stem_stream { STREAM_STOOLS, STREAM_SINGLE, STREAM_GROUPS, STREAMS };

/* The next places of a stream, drawn many at a time. */
#define POINTS           16
#define POINTS_CAPACITY  (POINTS + 8) /* whole registers are read from any place on */
#define POINTS_SPARSE    8            /* of singles and groups */
#define COHORT_GROUPS    4            /* groups of four shoots with cohorts drawn together */
#define SHOOTS_MAX       64           /* sorted at once; more than SHOOTS_ENOUGH plus the shoots of a last stool */
#define SHOOTS_ENOUGH    24
#define PLAIN_SHOOTS_MAX (SHOOTS_MAX - SHOOTS_ENOUGH)
struct points {
    double along[POINTS_CAPACITY];  /* m along the strip */
    double offset[POINTS_CAPACITY]; /* uniform in (-1/2, 1/2): offset from the centre line, in widths */
    double mark[POINTS_CAPACITY];   /* uniform in (0, 1): selects the stratum */
    double turn[POINTS_CAPACITY];   /* uniform in (-1/2, 1/2): rotation of the ring */
    /* of a stool: offset of its centre from the centre line, and first point of its ring from its centre */
    double centre[POINTS_CAPACITY], sine[POINTS_CAPACITY], cosine[POINTS_CAPACITY]; /* m */
    uint64_t extra[POINTS_CAPACITY];                                                /* 1: one extra shoot */
    uint64_t cohorts[COHORT_GROUPS][2][POINTS_CAPACITY];                            /* random bits of the first shoots */
    size_t belt[POINTS];
    unsigned next, count; /* count is `size`, or fewer at the end of the forest */
    unsigned size;
    uint64_t drawn; /* places drawn in the whole stream */
    double end;     /* m: where drawing continues */
    size_t end_belt;
};

struct stems_side {
    struct points streams[STREAM_GROUPS];
    struct points *groups; /* the third stream; NULL: no groups */
    double unequal_to;     /* m along the strip: beyond, the queue has only shoots of equal diameter per kind */
    struct stem single;    /* next single tree; `along` infinite: none */
    /* drawn shoots and grouped trees that the rock can hit, from `first` to before `end`, sorted; end < capacity */
    struct stem *queue;
    size_t first, end, capacity;
    double certain_to; /* m along the strip: up to here only queued stems stand */
    double next;       /* m along the strip: no stem stands before */
    bool next_known;   /* a stem stands at `next`; false: stools or groups up to `next` are not drawn yet */
    bool next_queued;  /* it is queued; false: it is `single` */
};

/* The next stool of a stream: its place, and its ring. */
struct stool {
    double along, centre, sine, cosine;
    const struct forest_stools *stools;
    const double *ring, *sines; /* cosines and sines of the ring */
    unsigned n;
    uint64_t event;
};

/* Rate of places in a belt for a rock of diameter b, 1/m, and its inverse. */
struct belt_rates {
    double b, rate[STREAMS], metres[STREAMS];
};

struct stems {
    const struct forest *forest;
    const struct kernel *kernel; /* core/forest/kernel.h */
    uint64_t seed, number;       /* of the rock */
    double b;                    /* m: mean diameter of the rock */
    double start;                /* x of the release */
    struct belt_rates *rates;    /* of the belts of forest->sides[0] */
    struct stems_side side[2];
    bool behind_ready;
    /* hash table of hit stools, by the lowest bits of their numbers; it is much larger than the number of stools in reach */
    uint64_t *hit_stools;
    bool no_memory;          /* the trajectory is invalid */
    uint64_t drawn;          /* stems drawn */
    uint64_t effort;         /* work in stems: drawn stems, and steps of sorting */
    char cache_padding[320]; /* so that the structs of different lanes do not share cache sets */
    uint64_t pause;          /* effort at which drawing pauses, to check for cancellation */
};

/* Return the maximum clearance of a rock that hits a stem of this kind: the height of the stem, or the clearance at which the
 * rock's centre is at hit_below. */
static inline double get_hit_height(const struct stems *s, const struct forest_kind *kind)
{
    double below = kind->hit_below - 0.5 * s->b;
    return kind->height < below ? kind->height : below;
}

static inline struct points *get_points(struct stems_side *side, enum stem_stream stream)
{
    return stream == STREAM_GROUPS ? side->groups : &side->streams[stream];
}

static inline enum stem_stream get_stream(const struct forest_stratum *stratum)
{
    return !stratum->kind ? STREAM_STOOLS : stratum->group > 0 ? STREAM_GROUPS : STREAM_SINGLE;
}

#endif
