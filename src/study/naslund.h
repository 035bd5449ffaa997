/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_NASLUND_H
#define CEDUO_NASLUND_H

#include "ceduo/survey.h"

#define CEDUO_BREAST_HEIGHT 1.3 /* m */
#define CEDUO_NASLUND_MIN   5   /* heights that a fit requires */

/* Fit the curve to n pairs of dbh (m) and height (m, above 1.3) by least squares of the heights. Return CEDUO_OK,
 * CEDUO_NO_MEMORY, or CEDUO_NO_FIT if no rising, finite curve fits: too few pairs, equal dbh, falling heights. */
enum ceduo_status ceduo_naslund_fit(size_t n, const double *dbh, const double *height, struct ceduo_naslund *curve);

/* Return the height (m) at a dbh (m). */
double ceduo_naslund_height(const struct ceduo_naslund *curve, double dbh);

#endif
