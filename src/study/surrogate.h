/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURROGATE_H
#define CEDUO_SURROGATE_H

#include <stdatomic.h>
#include <stddef.h>

#include "ceduo/calibrate.h"

/* Quadratic surrogate of a log-likelihood over the unit cube, fitted by weighted least squares. The weight of a point decreases
 * exponentially with its distance below the best. */
struct surrogate {
    size_t dimensions, terms;
    double center[CEDUO_CALIBRATION_MAX]; /* the best point */
    double *coefficients;                 /* NULL: not trained */
};

struct surrogate ceduo_surrogate_begin(size_t dimensions);
void ceduo_surrogate_free(struct surrogate *surrogate);

/* Fit to n points, rows of `u`. Values that are not finite are left out. Keeps the old fit if there are too few points, and
 * unless it returns CEDUO_OK. Return CEDUO_OK, CEDUO_NO_MEMORY, or CEDUO_CANCELLED if `cancel` (may be NULL) is set. */
enum ceduo_status ceduo_surrogate_train(struct surrogate *surrogate, const double *u, const double *values, size_t n,
                                        const atomic_bool *cancel);

/* Return the value at u; 0 if not trained. */
double ceduo_surrogate_evaluate(const struct surrogate *surrogate, const double *u);

#endif
