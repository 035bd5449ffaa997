/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEARCH_H
#define CEDUO_SEARCH_H

#include "ceduo/assess.h"
#include "ceduo/find.h"
#include "ceduo/yield.h"
#include "io/scene_file.h"
#include "study/goal.h"

/* Search the value for which an option reaches a goal at its worst control. Every value is tried with the same rocks. */

/* What a search came to. */
struct search_answer {
    enum ceduo_status status; /* as it was returned */
    double target;            /* the one looked for */
    bool rotation;            /* over one whole rotation */
    struct ceduo_found found;
    struct ceduo_reliability sure; /* and under uncertainty */
    struct ceduo_yield yield; /* of the option at the value that was found, or is nearest, without fellings; NaN: not known */
    bool yield_depends;       /* on the value: otherwise it is the same at both ends of the range */
    struct problems problems;
};

/* Search the value; with `sure` then the one that reaches the goal in that share of plausible cases. Leaves the scene at the last
 * value. The caller frees answer->problems. CEDUO_OK also if nothing is found. `cancel` may be NULL. */
enum ceduo_status ceduo_search(struct scene_file *file, const struct ceduo_search *search, unsigned threads,
                               const atomic_bool *cancel, struct search_answer *answer);

#define PREVIEW_ROCKS 1024 /* one block: some milliseconds, and a share to 3 in 100 */

/* What a change would do to the lights, without making it. */
struct preview {
    bool known;               /* false: that is no scene */
    struct ceduo_index index; /* of the last control, its lights among them */
    double reach, exceed;     /* shares of the released; NaN: not known */
};

/* `value` is YAML. The file stays as it is; another thread may read it. CEDUO_CANCELLED, CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_preview(const struct scene_file *file, const char *path, const char *value, size_t option,
                                unsigned threads, const atomic_bool *cancel, struct preview *preview);

/* The row of the number at a path; of one in a list that of the list, as of one number, in the arena. NULL: there is none. */
const struct field *ceduo_search_field(struct arena *arena, const char *path);

/* True if a value may stand at a path: the scene with it is a scene. */
bool ceduo_preview_fits(const struct scene_file *file, const char *path, const char *value);

#endif
