/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIT_H
#define CEDUO_FIT_H

#include "ceduo/calibrate.h"
#include "document.h"

/* Values of the scene of the live program, fitted to what was observed there. */

#define FIT_PATH_ROOM 160

/* What is to be fitted. */
struct fit_request {
    size_t n;
    struct fit_value {
        char path[FIT_PATH_ROOM];
        double lo, hi; /* in the unit of the file */
    } values[CEDUO_CALIBRATION_MAX];
    uint64_t rocks; /* of each evaluation */
};

/* Values that the observations do not hold, by a short first fit: a fit without them is quicker and as informative. */
struct fit_loose {
    size_t n;
    bool loose[CEDUO_CALIBRATION_MAX]; /* of the request */
};

struct fit {
    struct fit_request request;
    struct fit_loose loose;
    bool done;                            /* false: under way, and has come so far: */
    struct ceduo_calibration_state state; /* nothing below is known yet */
    struct scene_file file;               /* as it was; its nodes are the document's */
    struct ceduo_input inputs[CEDUO_CALIBRATION_MAX];
    struct ceduo_calibration answer;
};

/* What may be fitted: values with a range of the scene, otherwise rn, rt, roughness and friction with ranges of the library. */
void ceduo_fit_offer(const struct scene_file *file, struct fit_request *offer);

/* Whether something was observed that a fit may rest on. */
bool ceduo_fit_has_observations(const struct scene_file *file);

/* Fit with the threads and progress of `how`; `*loose` is set before the fit itself begins. The caller frees the fit anyway. */
enum ceduo_status ceduo_fit_make(const struct scene_file *file, const struct fit_request *request,
                                 const struct ceduo_calibration_def *how, struct fit_loose *loose, struct fit *fit);
void ceduo_fit_free(void *fit);

/* What was fitted goes into a document: the best values, where they come from, and the draws as its uncertainty. */
struct fit_values {
    const struct ceduo_calibration *answer;
    const struct ceduo_input *inputs; /* places in the document's scene; those without are left out */
    const char *source;               /* what the fit rests on */
    const char *draws;                /* path of the table of draws, as the document is to name it; NULL: none */
};

/* One edit, which undo takes back. A ground from materials is written out as segments. False with the reason in document->problems. */
bool ceduo_apply_fit(struct document *document, const struct fit_values *fit);

#endif
