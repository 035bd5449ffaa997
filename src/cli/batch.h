/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_BATCH_H
#define CEDUO_BATCH_H

#include "arguments.h"
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
ceduo_batch_answer ceduo_print_report, ceduo_print_plots, ceduo_print_find, ceduo_print_uncertainty, ceduo_print_chapter,
    ceduo_print_line;

/* Append the command line that reproduces a page. */
void ceduo_print_command(struct text *text, const struct arguments *arguments);

/* ---- reading ---- */

/* Read a scene with the changes of the command line and the options of --option; with --find, all options. Reports errors.
 * Return EXIT_OUTPUT if --output is one of its files. */
enum exit_status ceduo_batch_read(const struct arguments *arguments, const char *path, struct scene_file *file);

/* Find an option by its name. Otherwise report it and return EXIT_USAGE. */
enum exit_status ceduo_find_option(const struct scene_file *file, const char *name, size_t *index);

/* Warn if the scene has no answer because too few rocks arrive even without forest. Simulates at most CHECK_ROCKS rocks.
 * `stands`: warn of unusual stands, too. */
void ceduo_batch_warn(const struct arguments *arguments, const struct scene_file *file, bool stands);

/* Report a failed simulation, unless it was interrupted. Return EXIT_RUN. */
enum exit_status ceduo_batch_failed(const struct scene_file *file, enum ceduo_status status);

/* ---- progress: on standard error, after a second ---- */

struct progress {
    double start, shown;
    bool wanted;
};
struct progress ceduo_progress_begin(const struct arguments *arguments);
/* True if it is time to show progress. Sets *seconds to the time since the start. */
bool ceduo_progress_due(struct progress *progress, double *seconds);
/* Show the number of finished scenes and the time for the rest. `computed`: scenes computed in this run. */
void ceduo_progress_scenes(struct progress *progress, size_t computed, size_t done, size_t all);

/* ---- queries ---- */

/* A request to simulate one scene, and its results. */
struct query {
    struct ceduo_request request;
    bool pictures, envelopes; /* keep the data of pictures; of envelopes along the slope */
    size_t trajectories;      /* number of trajectories to keep */
    struct progress progress;
    struct ceduo_results results;
    double seconds; /* of the runs */
    struct ceduo_snapshot *snapshot;
    struct ceduo_verdict verdict;
    struct scene_inputs inputs; /* uncertain inputs */
    struct ceduo_uncertainty_result uncertainty_answer;
    struct ceduo_uncertainty_report uncertainty; /* answer NULL: nothing is uncertain; file NULL: not computed */
};

/* Set the question from the command line: rocks by -n, -e or the scene; threads, years. */
void ceduo_query_begin(struct query *query, const struct arguments *arguments, const struct scene_file *file);

/* Simulate the runs of the question. */
enum ceduo_status ceduo_query_run(struct query *query);

/* Compute the uncertainty of the scene, with the points and rocks of the command line. */
enum ceduo_status ceduo_query_uncertainty(struct query *query, const struct arguments *arguments, struct scene_file *file);

/* Compute the uncertainty in addition to the answer, with at most its rocks, and over the rotation of each option if there is
 * one. Computes nothing if rocks among stems are not simulated, if there is no answer, or if the work is far above that of most
 * scenes. */
enum ceduo_status ceduo_query_add_uncertainty(struct query *query, const struct arguments *arguments, struct scene_file *file);

/* Free all, and report a failure. Return EXIT_RUN on failure, or if more than 1 of 1000 rocks is unfinished; otherwise
 * EXIT_DONE. */
enum exit_status ceduo_query_end(struct query *query, const struct scene_file *file, enum ceduo_status status);

#endif
