/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIT_H
#define CEDUO_FIT_H

#include "document.h"

/* Fit of values of the live scene to its observations. */

#define FIT_PATH_MAX 160

/* The values to fit. */
struct fit_request {
    size_t n;
    struct fit_value {
        char path[FIT_PATH_MAX];
        double lo, hi; /* bounds, in the unit of the file */
    } values[CEDUO_CALIBRATION_MAX];
    uint64_t rocks; /* rocks of each evaluation */
};

struct fit {
    struct fit_request request;
    size_t undetermined_count;                /* set when done */
    bool undetermined[CEDUO_CALIBRATION_MAX]; /* values of the request that the observations do not determine */
    bool done;                                /* false: still running; only `state` is valid */
    struct ceduo_calibration_state state;     /* progress; the members below are set when done */
    struct scene_file file;                   /* scene at the start of the fit; its nodes are the document's */
    struct ceduo_input inputs[CEDUO_CALIBRATION_MAX];
    struct ceduo_calibration answer;
};

/* List the values to fit: those with a range in the scene, otherwise the ground with ranges of the library. */
void ceduo_fit_offer(const struct scene_file *file, struct fit_request *offer);

/* True if the scene has observations to fit. */
bool ceduo_fit_has_observations(const struct scene_file *file);

/* Fit with the threads and progress callback of `options`. Always free the fit. */
enum ceduo_status ceduo_fit_compute(const struct scene_file *file, const struct fit_request *request,
                                    const struct ceduo_calibration_def *options, struct fit *fit);
void ceduo_fit_free(void *fit);

/* Fitted values to write into a document: best values, their source, and the draws as uncertainty. */
struct fit_values {
    const struct ceduo_calibration *answer;
    const struct ceduo_input *inputs; /* places in the document's scene; inputs without places are skipped */
    const char *source;               /* source of the values, as text */
    const char *draws;                /* path of the table of draws, as the document names it; NULL: none */
};

/* True if the fit can be written without loss: `materials` have rows for its grounds, and no range or draws of another value would
 * be dropped. Otherwise append the reason. */
bool ceduo_fit_can_apply(const struct scene_file *file, const struct ceduo_input *inputs, size_t n, struct text *reason);

/* Apply the fit as one edit. Values of the library's grounds are written into their rows of `materials`. The source of the fit
 * excepts other values of its mapping; their assumed ranges become rows of uncertainty. Return false with the reason in
 * document->problems. */
bool ceduo_apply_fit(struct document *document, const struct fit_values *fit);

#endif
