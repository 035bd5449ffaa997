/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CLI_SENSITIVITY_H
#define CEDUO_CLI_SENSITIVITY_H

#include "scenes.h"
#include "view/report.h"

/* Computes all, and adds the answer. */
enum exit_status ceduo_sensitivity_add(const struct arguments *arguments, struct scene_file *file, struct text *out);

/* What doubt does to the scene, as a report; its answer is NULL where nothing is in doubt. */
struct asked_doubt {
    struct scene_inputs inputs;
    struct ceduo_doubt_answer answer;
    struct ceduo_doubt_report report;
};

/* Asks for it with the points and rocks of `def`, of which the rest is set here, or with those of the command line. `finer`: what
 * is known of the scene as it is from more rocks; may be NULL. Release it in any case. */
enum ceduo_status ceduo_sensitivity_ask(const struct arguments *arguments, struct scene_file *file, struct progress *progress,
                                        struct ceduo_doubt_def *def, const struct ceduo_result *finer,
                                        struct asked_doubt *doubt);
enum ceduo_status ceduo_sensitivity_of(const struct arguments *arguments, struct scene_file *file, struct asked_doubt *doubt);
/* The same beside an answer, with no more rocks than that has; `rotation`: over the rotation of each option as well, where there is
 * one. Nothing is computed where rocks among stems are not simulated, where nothing can be said, or where it would take far longer
 * than most scenes. */
enum ceduo_status ceduo_sensitivity_beside(const struct arguments *arguments, struct scene_file *file,
                                           struct progress *progress, const struct ceduo_answer *answer, bool rotation,
                                           struct asked_doubt *doubt);
void ceduo_sensitivity_release(struct asked_doubt *doubt);

#endif
