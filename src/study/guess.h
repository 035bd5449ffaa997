/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_GUESS_H
#define CEDUO_GUESS_H

#include <stdbool.h>
#include <stddef.h>

/* A cheap guess of a log-likelihood over the unit cube: a quadratic through all that is known, by weighted least squares; what
 * is far below the best counts little. */
struct guess {
    size_t dimensions, terms;
    double *coefficients; /* NULL: nothing is known yet */
};

struct guess ceduo_guess_begin(size_t dimensions);
void ceduo_guess_release(struct guess *guess);

/* Learns from n places, `u` in rows; what is not finite is left out. With too few it knows nothing. False without memory. */
bool ceduo_guess_learn(struct guess *guess, const double *u, const double *values, size_t n);

/* 0 where nothing is known. */
double ceduo_guess_at(const struct guess *guess, const double *u);

#endif
