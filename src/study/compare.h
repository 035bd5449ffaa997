/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_COMPARE_H
#define CEDUO_COMPARE_H

#include "ceduo/result.h"

/* Which option of a result is best at the last control. */

/* Of the rocks released the share that arrives with too much energy, or that arrives where no accepted energy is said. */
double ceduo_compare_share_of(const struct ceduo_arrivals *arrivals);

/* What is compared: the share of the released with too much energy, or where that is not said that arrives, and its
 * difference to the first option's; with half the width of their 95 % intervals. NaN where it was not simulated. */
double ceduo_compare_share(const struct ceduo_result *result, size_t option, double *half);
double ceduo_compare_difference(const struct ceduo_result *result, size_t option, double *half);

/* Whether an option is worse than another by energy, beyond two standard errors: by the share of the released with too
 * much energy, or where no energy is said by the energy per released. */
bool ceduo_compare_worse(const struct ceduo_result *result, size_t option, size_t than);

struct ceduo_best {
    bool known;                   /* otherwise too few options were simulated */
    size_t contact, energy;       /* the best by each */
    bool apart;                   /* contact tells the options apart */
    bool before_some, before_all; /* options that are worse than the best by energy */
};
struct ceduo_best ceduo_compare_best(const struct ceduo_result *result);

#endif
