/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether a light of the last control changes within what may be true, and by what. */
#include <math.h>

#include "ceduo/assess.h"
#include "ceduo/doubt.h"

#define ALSO 0.5 /* a second input is named where its share is at least this of the first one's */

size_t ceduo_doubt_depends(const struct ceduo_scene *scene, const struct ceduo_doubt_answer *a, size_t option,
                           enum ceduo_doubt_kind light, size_t inputs[2])
{
    const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(a, option, light, false);
    double limit = light == CEDUO_DOUBT_EXCEED    ? CEDUO_EXCEED_MOST
                   : light == CEDUO_DOUBT_CONTACT ? 1 / scene->simulation.threshold
                                                  : CEDUO_FREE_RUN_MOST;
    const struct ceduo_control *control = &scene->controls[ceduo_scene_last_control(scene)];
    double gap = ceduo_assess_index(scene, &scene->options[option], control, NAN).longest_gap;
    bool decided = light != CEDUO_DOUBT_EXCEED && gap > scene->simulation.threshold; /* whatever the stands are */
    if (decided || !f->fit.enough || !(f->fit.p5 <= limit && f->fit.p95 > limit))
        return 0;
    const struct ceduo_share *total = f->fit.total;
    size_t first = f->order[0], second = SIZE_MAX;
    for (size_t i = 1; i < f->uses; i++)
        if (total[f->order[i]].value > total[first].value)
            first = f->order[i];
    for (size_t i = 0; i < f->uses; i++)
        if (f->order[i] != first && (second == SIZE_MAX || total[f->order[i]].value > total[second].value))
            second = f->order[i];
    inputs[0] = first;
    inputs[1] = second;
    return second != SIZE_MAX && total[second].value >= ALSO * total[first].value ? 2 : 1;
}
