/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RESULT_H
#define CEDUO_RESULT_H

#include "assess.h"
#include "run.h"

/* What is found for one option. */
struct ceduo_option_result {
    struct ceduo_stand_result *stands; /* one for each belt */
    struct ceduo_index *controls;      /* one for each control, in the scene's order */
};

/* All that is found for a scene: plain columns, to be shown or written. */
struct ceduo_result {
    const struct ceduo_scene *scene;
    struct ceduo_rock rock; /* of the means */
    uint64_t rocks, contacts;
    struct ceduo_arrivals *bare; /* one for each control: without forest, the same for all options */
    struct ceduo_ends ends;
    size_t last_control;         /* the one farthest along x */
    size_t options_count;
    struct ceduo_option_result *options;
};

/* Reads a run and assesses every option. The scene and the run must outlive the call, the scene the result.
 * CEDUO_NO_MEMORY or CEDUO_OK. */
enum ceduo_status ceduo_result_create(const struct ceduo_scene *scene, const struct ceduo_run *run,
                                      struct ceduo_result **result);

/* The same from figures that were read from a run before: `bare` has one entry for each control of the scene. */
enum ceduo_status ceduo_result_assess(const struct ceduo_scene *scene, uint64_t rocks, uint64_t contacts,
                                      const struct ceduo_arrivals *bare, const struct ceduo_ends *ends,
                                      struct ceduo_result **result);
void ceduo_result_free(struct ceduo_result *result);

#define CEDUO_FEW_ROCKS 100 /* arrivals below which a mean is not waited for */

/* Makes a run longer, doubling it from one block on, until the 95 % half-width of the mean energy at every control that
 * at least CEDUO_FEW_ROCKS rocks reach is below `tolerance` of it, or `most` rocks are done. `*met`: whether it is. */
enum ceduo_status ceduo_run_until(struct ceduo_run *run, size_t controls, double tolerance, uint64_t most, bool *met);

#endif
