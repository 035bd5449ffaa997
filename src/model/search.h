/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SEARCH_H
#define CEDUO_SEARCH_H

#include "io/scene_file.h"
#include "study/goal.h"

/* Search the value for which an option reaches a goal at its worst control. Every value is tried with the same rocks. */

/* Result of a search. */
struct search_answer {
    enum ceduo_status status; /* returned status */
    double target;            /* goal value, given or default */
    bool rotation;            /* over one whole rotation */
    struct ceduo_found found;
    struct ceduo_reliability sure; /* result under uncertainty */
    struct ceduo_yield yield;      /* yield at the value found or nearest, without fellings; NaN: unknown */
    bool yield_depends;            /* the yield differs between the ends of the range */
    struct problems problems;
};

/* Search the value; with `sure` also the value that reaches the goal in that share of plausible cases. The scene keeps the
 * last value tried. The caller frees answer->problems. Return CEDUO_OK even if nothing is found. `cancel` may be NULL. */
enum ceduo_status ceduo_search(struct scene_file *file, const struct ceduo_search *search, unsigned threads,
                               const atomic_bool *cancel, struct search_answer *answer);

#define PREVIEW_ROCKS 1024 /* one batch: some milliseconds, and a share to ± 3 % */

/* Effect of a change on the lights. */
struct preview {
    bool known;               /* false: the change is not valid */
    struct ceduo_index index; /* at the last control, with its lights */
    double reach, exceed;     /* shares of released rocks; NaN: unknown */
};

/* Preview a change without making it; `value` is YAML. Another thread may read the file. Return CEDUO_CANCELLED,
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_preview(const struct scene_file *file, const char *path, const char *value, size_t option,
                                unsigned threads, const atomic_bool *cancel, struct preview *preview);

/* Return the field of the number at a path, or the field of its list as a single number, in the arena. NULL: none. */
const struct field *ceduo_search_field(struct arena *arena, const char *path);

/* True if the scene is valid with this value. */
bool ceduo_preview_fits(const struct scene_file *file, const char *path, const char *value);

#endif
