/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SECTION_H
#define CEDUO_SECTION_H

#include <math.h>

#include "ceduo/rock.h"

/* The section in which a rock meets the ground under the law arm: an ellipse whose half-axes are one of the three pairs of
 * the rock's, so scaled that their mean over the pairs is R. */
struct section {
    double wide, high; /* squares of the half-axes over that of the radius of gyration: together 5 */
    double reach;      /* R over the radius of gyration */
    double gyration;   /* m */
};

/* That of pair 0, 1 or 2. */
static inline struct section section_of(const struct ceduo_rock *rock, int pair)
{
    const double *axes = rock->axes;
    double a = axes[pair], b = axes[(pair + 1) % 3], longer = a < b ? b : a;
    double mean = (axes[0] + axes[1] + axes[2]) / 3, size = longer / mean * rock->radius;
    double a2 = (a / longer) * (a / longer), b2 = (b / longer) * (b / longer), sum = a2 + b2;
    double gyration = size * sqrt(sum / 5);
    return (struct section){.wide = 5 * a2 / sum, .high = 5 * b2 / sum, .reach = rock->radius / gyration, .gyration = gyration};
}

#endif
