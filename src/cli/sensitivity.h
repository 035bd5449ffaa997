/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CLI_SENSITIVITY_H
#define CEDUO_CLI_SENSITIVITY_H

#include "scenes.h"
#include "view/report_doubt.h"

/* Computes all, and adds the answer. */
enum exit_status ceduo_sensitivity_whole(const struct arguments *arguments, struct scene_file *file, struct text *out);

/* What doubt does to the scene, as a report; its answer is NULL where nothing is in doubt, otherwise to be freed. */
struct asked_doubt {
    struct scene_inputs inputs;
    struct ceduo_doubt_answer answer;
    struct ceduo_doubt_report report;
};
enum ceduo_status ceduo_sensitivity_ask(const struct arguments *arguments, struct scene_file *file, struct asked_doubt *doubt);

/* Rocks of each evaluation. */
uint64_t ceduo_sensitivity_rocks(const struct arguments *arguments);

/* The bytes of a part, for the caller to free; none where nothing is in doubt. */
enum ceduo_status ceduo_sensitivity_part(const struct arguments *arguments, struct scene_file *file, struct progress *progress,
                                         unsigned char **bytes, size_t *n);

/* Adds the answer of all parts, in their order. `*bad`: one does not fit the others, and nothing is said. */
enum exit_status ceduo_sensitivity_join(const struct arguments *arguments, struct scene_file *file, const struct part *parts,
                                        size_t n, bool *bad, struct text *out);

#endif
