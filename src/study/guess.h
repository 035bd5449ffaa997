/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GUESS_H
#define CEDUO_GUESS_H

#include <stdatomic.h>
#include <stddef.h>

#include "ceduo/calibrate.h"

/* A cheap guess of a log-likelihood over the unit cube: a quadratic through all that is known, by weighted least
 * squares; what is far below the best counts little. */
struct guess {
    size_t dimensions, terms;
    double center[CEDUO_CALIBRATION_MAX]; /* the best place */
    double *coefficients;                 /* NULL: nothing is known yet */
};

struct guess ceduo_guess_begin(size_t dimensions);
void ceduo_guess_release(struct guess *guess);

/* Learns from n places, `u` in rows; what is not finite is left out. With too few it knows nothing. CEDUO_NO_MEMORY, or
 * CEDUO_CANCELLED where `cancel` is set (NULL: it never is); then it knows what it knew. */
enum ceduo_status ceduo_guess_learn(struct guess *guess, const double *u, const double *values, size_t n,
                                    const atomic_bool *cancel);

/* 0 where nothing is known. */
double ceduo_guess_at(const struct guess *guess, const double *u);

#endif
