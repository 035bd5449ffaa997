/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FORESEE_H
#define CEDUO_FORESEE_H

#include "ceduo/assess.h"
#include "document.h"

/* What a change would do to the lights, without making it: the scene with the change, and a few rocks through it. */

#define FORESEE_ROCKS 1024 /* one block: some milliseconds, and a share to 3 in 100 */

struct foreseen {
    struct ceduo_index index; /* of the last control, its lights among them */
    double reach, exceed;     /* shares of the released; NaN: not known */
};

/* `sets`: PATH=VALUE each, as for --set. False where that is no scene, or without memory. The document stays as it is. */
bool ceduo_foresee(const struct document *document, const char *const *sets, size_t n, size_t option, unsigned threads,
                   struct foreseen *foreseen);

/* Whether a value may stand at a path: the scene with it is a scene. */
bool ceduo_foresee_fits(const struct document *document, const char *path, const char *value);

#endif
