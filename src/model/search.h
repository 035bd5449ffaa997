/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEARCH_H
#define CEDUO_SEARCH_H

#include "ceduo/assess.h"
#include "ceduo/find.h"
#include "ceduo/yield.h"
#include "io/scene_file.h"
#include "study/goal.h"

/* The value of one parameter of a scene for which one option reaches a goal at its worst control: reserves per ha, a
 * rotation, the length of a belt … Every value is tried with the same rocks, so that the answer is the same each
 * time. */

struct search {
    struct scene_file *file; /* as it was read; the search leaves it at its last value */
    struct ceduo_search def;
    unsigned threads;
    const atomic_bool *cancel; /* may be NULL */
    struct ceduo_sure sure;
    struct ceduo_yield yield; /* of the option at the value that was found, or else comes nearest: without fellings; NaN
                                * where it is not known */
    bool yield_depends;       /* on the value: otherwise it is the same at both ends of the range */
    /* while it is under way */
    struct problems *problems;
    double passes;           /* the largest goal that is reached */
    const struct node *root; /* of the scene as it was read */
    struct ceduo_pool *pool; /* runs kept from value to value */
};

/* Looks for it; with `sure` then for the value that reaches the goal in so much of what may be true. At each value the doubt is
 * that of the scene with it, at the same points and with the same rocks, but for the value itself: who sets it knows it. A wrong path or range is reported in `problems`. CEDUO_OK also where nothing is found. */
enum ceduo_status ceduo_search(struct search *search, struct ceduo_found *found, struct problems *problems);

/* What a search came to. */
struct search_answer {
    enum ceduo_status status;
    double target;            /* the one looked for */
    bool rotation;            /* over one whole rotation */
    struct ceduo_yield yield; /* at that value */
    struct ceduo_found found;
    struct ceduo_sure sure; /* and under doubt */
    struct problems problems;
};

/* What a change would do to the lights, without making it: the scene with the change, and a few rocks through it. */

#define PREVIEW_ROCKS 1024 /* one block: some milliseconds, and a share to 3 in 100 */

struct preview {
    bool known;               /* false: that is no scene */
    struct ceduo_index index; /* of the last control, its lights among them */
    double reach, exceed;     /* shares of the released; NaN: not known */
};

/* `set`: PATH=VALUE as for --set. The file stays as it is; it may be read by others meanwhile. CEDUO_CANCELLED,
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_preview(const struct scene_file *file, const char *set, size_t option, unsigned threads,
                                const atomic_bool *cancel, struct preview *preview);

/* Whether a value may stand at a path: the scene with it is a scene. */
bool ceduo_preview_fits(const struct scene_file *file, const char *path, const char *value);

#endif
