/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BATCH_H
#define CEDUO_BATCH_H

#include "arguments.h"
#include "ceduo/question.h"
#include "study/snapshot.h"

/* ---- commands: each prints to standard output or to --output and returns the exit status ---- */

enum exit_status ceduo_batch_run(const struct arguments *arguments);
enum exit_status ceduo_batch_calibrate(const struct arguments *arguments);
enum exit_status ceduo_batch_parameters(const struct arguments *arguments);
enum exit_status ceduo_batch_profiles(const struct arguments *arguments);
enum exit_status ceduo_batch_columns(const struct arguments *arguments);
enum exit_status ceduo_batch_schema(const struct arguments *arguments);
enum exit_status ceduo_batch_survey(const struct arguments *arguments);

/* ---- answers of one scene, which they add: the modes of ceduo_batch_run() ---- */

typedef enum exit_status ceduo_batch_answer(const struct arguments *arguments, struct scene_file *file, struct text *out);
ceduo_batch_answer ceduo_print_report, ceduo_print_plots, ceduo_print_find, ceduo_print_doubt, ceduo_print_chapter;

/* ---- reading ---- */

/* Reads a scene with the changes and the options of the command line (with --find all of its options); what is wrong with
 * it goes to standard error. EXIT_OUTPUT where --output is one of the files that it was read from. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct scene_file *file);

/* The option of a name. EXIT_USAGE where there is none, once that is told. */
enum exit_status ceduo_batch_option(const struct scene_file *file, const char *name, size_t *index);

/* Print a warning to standard error if hardly a rock arrives even without forest, so that the scene has no answer. Simulates at
 * most LOOK_ROCKS rocks. `stands`: warn of unusual stands, too. */
void ceduo_batch_warn(const struct arguments *arguments, const struct scene_file *file, bool stands);

/* Says why there is no answer; an interruption says nothing. EXIT_RUN. */
enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status);

/* ---- progress: on standard error, once a second is over ---- */

struct progress {
    double start, shown;
    bool wanted;
};
struct progress ceduo_progress_begin(const struct arguments *arguments);
/* Whether it is time to show how far it is; `*seconds`: since the start. */
bool ceduo_progress_due(struct progress *progress, double *seconds);
/* How many of all scenes are done, some of them now, and for how long the others may take. */
void ceduo_progress_scenes(struct progress *progress, size_t computed, size_t done, size_t all);

/* ---- asking ---- */

/* What is asked of one scene, and the answer. */
struct asked {
    struct ceduo_question question;
    bool pictures, envelopes; /* with what they need; with envelopes along the slope as well, */
    size_t trajectories;      /* and so many of these */
    struct progress progress;
    struct ceduo_answer answer;
    double seconds; /* that the runs took */
    struct ceduo_snapshot *snapshot;
    struct ceduo_verdict verdict;
    struct scene_inputs inputs; /* that are in doubt */
    struct ceduo_doubt_answer doubt_answer;
    struct ceduo_doubt_report doubt; /* its answer is NULL where nothing is in doubt, its file where that is not asked */
};

/* Begins with what the command line asks of a scene: rocks as -n, -e or the scene says, threads, years. */
void ceduo_ask_begin(struct asked *asked, const struct arguments *arguments, const struct scene_file *file);

/* Asks for one rotation of each option as well, with as few rocks as tell its mean: where --years is not given. */
void ceduo_ask_years(struct ceduo_question *question);

/* Simulates what the question asks for. */
enum ceduo_status ceduo_ask_runs(struct asked *asked);

/* Asks what doubt does to the scene, with the points and rocks of the command line. */
enum ceduo_status ceduo_ask_doubt(struct asked *asked, const struct arguments *arguments, struct scene_file *file);

/* The same beside the answer, with no more rocks than that has, and over the rotation of each option if there is one.
 * Nothing is computed where rocks among stems are not simulated, where nothing can be said, or where it would take far
 * longer than most scenes. */
enum ceduo_status ceduo_ask_doubt_beside(struct asked *asked, const struct arguments *arguments, struct scene_file *file);

/* Releases all, and says where it failed. Otherwise EXIT_DONE, or EXIT_RUN where more than one rock of 1000 is unfinished. */
enum exit_status ceduo_ask_end(struct asked *asked, const struct scene_file *file, enum ceduo_status status);

#endif
