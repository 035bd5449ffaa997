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

#endif
