/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <string.h>

#include "ceduo/calibrate.h"

#define ALIKE 0.1 /* of the mean axis: rocks whose axes differ by no more are of one shape; assumed */

/* A shape is the rock's axes over their mean, the shortest first. */
bool ceduo_calibration_tells_mu(const struct ceduo_calibration_scene *scenes, size_t n)
{
    double first[3];
    bool known = false;
    for (size_t s = 0; s < n; s++)
        for (size_t i = 0; i < scenes[s].observations_count; i++) {
            const struct ceduo_observation *seen = &scenes[s].observations[i];
            if (seen->use != CEDUO_OBSERVED_FIT || scenes[s].scene->simulation.law != CEDUO_LAW_ARM)
                continue;
            const struct ceduo_rock rock = ceduo_rock_mean(seen->rock ? seen->rock : &scenes[s].scene->rock);
            const double *a = rock.axes, sum = a[0] + a[1] + a[2];
            double least = fmin(a[0], fmin(a[1], a[2])), most = fmax(a[0], fmax(a[1], a[2]));
            const double shape[3] = {3 * least / sum, 3 * (sum - least - most) / sum, 3 * most / sum};
            for (size_t k = 0; known && k < 3; k++)
                if (fabs(first[k] - shape[k]) > ALIKE)
                    return true;
            if (!known)
                memcpy(first, shape, sizeof first);
            known = true;
        }
    return false;
}
