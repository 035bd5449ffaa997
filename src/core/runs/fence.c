/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>

#include "fence.h"

const double ceduo_fence_class_energy[CEDUO_FENCE_CLASSES] = {100e3,  250e3,  500e3,  1000e3,  1500e3,
                                                              2000e3, 3000e3, 4500e3, INFINITY};

int ceduo_fence_class(double energy)
{
    int i = 0;
    while (i < CEDUO_FENCE_CLASSES && !(energy <= ceduo_fence_class_energy[i]))
        i++;
    return i < CEDUO_FENCE_CLASSES ? i : -1;
}

struct ceduo_fence_arrivals ceduo_fence_none(void)
{
    const struct ceduo_fence_load none = {NAN, NAN, NAN, NAN};
    return (struct ceduo_fence_arrivals){.above = CEDUO_NO_ESTIMATE,
                                         .through = CEDUO_NO_ESTIMATE,
                                         .both = CEDUO_NO_ESTIMATE,
                                         .defeated = CEDUO_NO_ESTIMATE,
                                         .worn = CEDUO_NO_ESTIMATE,
                                         .per_year = NAN,
                                         .in_life = NAN,
                                         .arriving = none,
                                         .system = none};
}

void ceduo_fence_choose(const struct ceduo_fence_grid *grid, double limit,
                        struct ceduo_fence_choice choices[CEDUO_FENCE_HEIGHTS])
{
    for (unsigned h = 0; h < CEDUO_FENCE_HEIGHTS; h++) {
        const struct ceduo_estimate *defeated = grid->defeated[h];
        int i = 0, last = CEDUO_FENCE_CLASSES - 1;
        while (i <= last && !(defeated[i].mean <= limit))
            i++;
        bool undecided = (i <= last && defeated[i].hi > limit) || (i > 0 && defeated[i - 1].lo <= limit);
        choices[h] = (struct ceduo_fence_choice){.height = CEDUO_FENCE_LOWEST + h,
                                                 .class_index = i,
                                                 .energy = i < last    ? ceduo_fence_class_energy[i]
                                                           : i == last ? grid->energy[h]
                                                                       : NAN,
                                                 .defeated = defeated[i <= last ? i : last].mean,
                                                 .decided = !undecided};
    }
}

const struct ceduo_fence_choice *ceduo_fence_smallest(const struct ceduo_fence_choice choices[CEDUO_FENCE_HEIGHTS])
{
    const struct ceduo_fence_choice *best = choices;
    for (size_t h = 1; h < CEDUO_FENCE_HEIGHTS; h++)
        if (choices[h].class_index < best->class_index)
            best = &choices[h];
    return best->class_index < CEDUO_FENCE_CLASSES ? best : NULL;
}

struct ceduo_fence_design ceduo_fence_design(const struct ceduo_fence_load *load, const struct ceduo_fence_factors *f)
{
    double speed = f->survey * f->model, energy = f->blocks * speed * speed * load->energy;
    bool loaded = load->energy > 0; /* false for NaN */
    return (struct ceduo_fence_design){.speed = speed * load->speed,
                                       .energy = energy,
                                       .height = loaded ? fmax(load->middle + CEDUO_FENCE_FREE, load->top) : 0 * load->top,
                                       .class_index = loaded ? ceduo_fence_class(energy) : -1,
                                       .class_factored = loaded ? ceduo_fence_class(f->energy * energy) : -1};
}
