/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PRINT_H
#define CEDUO_PRINT_H

#include "scenes.h"
#include "study/snapshot.h"

/* Asks for a scene, and adds the answer as --format says. */
enum exit_status ceduo_print_report(const struct arguments *arguments, struct scene_file *file, struct text *out);

/* Asks for one rotation of each option as well, with as few rocks as tell its mean: where --years is not given. */
void ceduo_ask_years(struct ceduo_question *question);

/* What is asked once for pages and pictures. */
struct answered {
    struct ceduo_pool *pool;
    struct ceduo_answer answer;
    struct ceduo_snapshot *snapshot;
    struct ceduo_verdict verdict;
};
/* Asks for runs; with envelopes along the slope (`cells`), and so many trajectories. Release it in any case. */
enum ceduo_status ceduo_ask_pictures(struct ceduo_question *question, bool cells, size_t trajectories,
                                     struct answered *answered);
void ceduo_answered_release(struct answered *answered);

/* EXIT_RUN where more than one rock of 1000 is unfinished. */
enum exit_status ceduo_finished(const struct ceduo_result *result);

/* Adds the pictures of a scene, from runs where they need any. */
enum exit_status ceduo_print_plots(const struct arguments *arguments, struct scene_file *file, struct text *out);

#endif
