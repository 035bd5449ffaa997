/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "ceduo/calibrate.h"

#define ALIKE 0.1 /* of the mean axis: rocks whose axes differ by no more are of one shape; assumed */

/* The rock's axes over their mean, the shortest first. */
struct shape {
    double axes[3];
};

static struct shape shape_of(const struct ceduo_rock_def *def)
{
    const struct ceduo_rock rock = ceduo_rock_mean(def);
    const double *a = rock.axes, sum = a[0] + a[1] + a[2];
    double least = fmin(a[0], fmin(a[1], a[2])), most = fmax(a[0], fmax(a[1], a[2]));
    return (struct shape){{3 * least / sum, 3 * (sum - least - most) / sum, 3 * most / sum}};
}

static bool alike(const struct shape *a, const struct shape *b)
{
    for (size_t i = 0; i < 3; i++)
        if (fabs(a->axes[i] - b->axes[i]) > ALIKE)
            return false;
    return true;
}

bool ceduo_calibration_tells_mu(const struct ceduo_calibration_scene *scenes, size_t n)
{
    struct shape first;
    bool known = false;
    for (size_t s = 0; s < n; s++)
        for (size_t i = 0; i < scenes[s].observations_count; i++) {
            const struct ceduo_observation *seen = &scenes[s].observations[i];
            if (seen->use != CEDUO_OBSERVED_FIT || scenes[s].scene->simulation.law != CEDUO_LAW_ARM)
                continue;
            struct shape shape = shape_of(seen->rock ? seen->rock : &scenes[s].scene->rock);
            if (known && !alike(&first, &shape))
                return true;
            if (!known)
                first = shape;
            known = true;
        }
    return false;
}
