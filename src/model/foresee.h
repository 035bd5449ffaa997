/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FORESEE_H
#define CEDUO_FORESEE_H

#include <stdatomic.h>

#include "ceduo/assess.h"
#include "io/scene_file.h"

/* What a change would do to the lights, without making it: the scene with the change, and a few rocks through it. */

#define FORESEE_ROCKS 1024 /* one block: some milliseconds, and a share to 3 in 100 */

struct foreseen {
    bool known;               /* false: that is no scene */
    struct ceduo_index index; /* of the last control, its lights among them */
    double reach, exceed;     /* shares of the released; NaN: not known */
};

/* `set`: PATH=VALUE as for --set. The file stays as it is; it may be read by others meanwhile. CEDUO_CANCELLED,
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_foresee(const struct scene_file *file, const char *set, size_t option, unsigned threads,
                                const atomic_bool *cancel, struct foreseen *foreseen);

/* Whether a value may stand at a path: the scene with it is a scene. */
bool ceduo_foresee_fits(const struct scene_file *file, const char *path, const char *value);

#endif
