/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_UNCERTAINTY_H
#define CEDUO_UNCERTAINTY_H

#include "ceduo/doubt.h"
#include "io/doubt_inputs.h"

/* What doubt does to the scene of the live program, in levels: first of one option alone, as finely as it will be, so that nothing
 * is said that moves; then of all options; then over the rotation of each as well, which takes some seconds. */
#define UNCERTAINTY_LEVELS   2
#define UNCERTAINTY_ROTATION 3

struct uncertainty {
    struct scene_file file; /* as it was; its nodes are the document's */
    struct scene_inputs inputs;
    struct ceduo_doubt_answer answer; /* without inputs: empty */
    size_t level;                     /* that it has come to: of one option alone the first is the second */
    bool last;                        /* there is nothing more */
};

/* Computes one level, the first of this option. `file` must have an arena of its own, which is the answer's from then on. To be
 * freed in any case. */
enum ceduo_status ceduo_uncertainty_make(const struct scene_file *file, size_t option, size_t level, unsigned threads,
                                         const atomic_bool *cancel, struct uncertainty *uncertainty);

/* Why there is nothing over a rotation, marked for translation; NULL: there is. */
const char *ceduo_uncertainty_no_rotation(const struct ceduo_scene *scene);
void ceduo_uncertainty_free(void *uncertainty);

#endif
