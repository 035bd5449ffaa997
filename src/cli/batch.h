/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BATCH_H
#define CEDUO_BATCH_H

#include "arguments.h"
#include "ceduo/question.h"
#include "study/snapshot.h"

/* ---- commands: print to standard output or --output, and return the exit status ---- */

enum exit_status ceduo_batch_run(const struct arguments *arguments);
enum exit_status ceduo_batch_calibrate(const struct arguments *arguments);
enum exit_status ceduo_batch_parameters(const struct arguments *arguments);
enum exit_status ceduo_batch_profiles(const struct arguments *arguments);
enum exit_status ceduo_batch_columns(const struct arguments *arguments);
enum exit_status ceduo_batch_schema(const struct arguments *arguments);
enum exit_status ceduo_batch_survey(const struct arguments *arguments);

/* ---- modes of ceduo_batch_run(): append the answer of one scene ---- */

typedef enum exit_status ceduo_batch_answer(const struct arguments *arguments, struct scene_file *file, struct text *out);
ceduo_batch_answer ceduo_print_report, ceduo_print_plots, ceduo_print_find, ceduo_print_uncertainty, ceduo_print_chapter;

/* ---- reading ---- */

/* Read a scene with the changes of the command line and its chosen options, with --find all options. Reports errors on standard
 * error. EXIT_OUTPUT if --output is one of its files. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct scene_file *file);

/* Find an option by its name. EXIT_USAGE if there is none, which is reported. */
enum exit_status ceduo_batch_option(const struct scene_file *file, const char *name, size_t *index);

/* Print a warning to standard error if hardly a rock arrives even without forest, so that the scene has no answer. Simulates at
 * most LOOK_ROCKS rocks. `stands`: warn of unusual stands, too. */
void ceduo_batch_warn(const struct arguments *arguments, const struct scene_file *file, bool stands);

/* Report the reason for no answer, unless it is an interruption. Returns EXIT_RUN. */
enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status);

/* ---- progress: on standard error, after a second ---- */

struct progress {
    double start, shown;
    bool wanted;
};
struct progress ceduo_progress_begin(const struct arguments *arguments);
/* True if it is time to show progress. Sets *seconds since the start. */
bool ceduo_progress_due(struct progress *progress, double *seconds);
/* Show the number of scenes that are done and the time for the rest. `computed`: scenes of this run. */
void ceduo_progress_scenes(struct progress *progress, size_t computed, size_t done, size_t all);

/* ---- asking ---- */

/* A question about one scene, and the answer. */
struct asked {
    struct ceduo_request question;
    bool pictures, envelopes; /* keep data of pictures, and of envelopes along the slope */
    size_t trajectories;      /* number of trajectories to keep */
    struct progress progress;
    struct ceduo_results answer;
    double seconds; /* of the runs */
    struct ceduo_snapshot *snapshot;
    struct ceduo_verdict verdict;
    struct scene_inputs inputs; /* that are uncertain */
    struct ceduo_uncertainty_result uncertainty_answer;
    struct ceduo_uncertainty_report uncertainty; /* answer NULL: nothing is uncertain; file NULL: not asked */
};

/* Set the question of the command line: rocks by -n, -e or the scene; threads, years. */
void ceduo_ask_begin(struct asked *asked, const struct arguments *arguments, const struct scene_file *file);

/* Ask for one rotation of each option as well, with few rocks, if --years is not given. */
void ceduo_ask_years(struct ceduo_request *question);

/* Simulate the runs of the question. */
enum ceduo_status ceduo_ask_runs(struct asked *asked);

/* Compute the uncertainty of the scene, with the points and rocks of the command line. */
enum ceduo_status ceduo_ask_uncertainty(struct asked *asked, const struct arguments *arguments, struct scene_file *file);

/* The same in addition to the answer, with at most its rocks, and over the rotation of each option if there is one. Nothing is
 * computed if rocks among stems are not simulated, if there is no answer, or if it would take far longer than for most scenes. */
enum ceduo_status ceduo_ask_uncertainty_beside(struct asked *asked, const struct arguments *arguments, struct scene_file *file);

/* Release all, and report a failure. Otherwise EXIT_DONE, or EXIT_RUN if more than one rock of 1000 is unfinished. */
enum exit_status ceduo_ask_end(struct asked *asked, const struct scene_file *file, enum ceduo_status status);

#endif
