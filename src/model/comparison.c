/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "jobs.h"

#include <gsl/gsl_sort.h>
#include <math.h>

#include "base/must.h"

static const uint64_t levels[COMPARISON_LEVELS] = {200, 2000};

enum ceduo_status ceduo_comparison_make(const struct scene_file *file, size_t level, const atomic_bool *cancel,
                                        struct comparison *c)
{
    *c = (struct comparison){.file = *file, .rocks = levels[level]};
    c->predicted = ceduo_must(calloc(file->observations_count + 1, sizeof *c->predicted));
    c->stops = ceduo_must(calloc(file->observations_count + 1, sizeof *c->stops));
    const struct ceduo_calibration_scene scene = {
        .scene = &c->file.scene, .observations_count = file->observations_count, .observations = file->observations};
    enum ceduo_status status = ceduo_calibration_as_it_is(&scene, c->rocks, cancel, c->predicted);
    const struct ceduo_observation *o = c->file.observations;
    struct ceduo_observer *observer = NULL;
    if (status == CEDUO_OK)
        status = ceduo_observer_create(o, c->file.observations_count, &observer);
    for (size_t i = 0; i < c->file.observations_count && status == CEDUO_OK; i++) {
        double *values = NULL;
        size_t rocks, n = 0;
        if (o[i].kind != CEDUO_OBSERVED_STOPS || !o[i].values)
            continue;
        status = atomic_load(cancel) ? CEDUO_CANCELLED
                                     : ceduo_observer_values(observer, &c->file.scene, i, c->rocks, &values, &rocks);
        if (status != CEDUO_OK)
            break;
        for (size_t k = 0; k < rocks; k++)
            if (!isnan(values[k]))
                values[n++] = values[k];
        gsl_sort(values, 1, n);
        if (n > 0)
            ceduo_seen_stops_of(&o[i], values, n, rocks, &c->stops[i]);
        free(values);
    }
    ceduo_observer_free(observer);
    return status;
}

void ceduo_comparison_free(void *comparison)
{
    struct comparison *c = comparison;
    free(c->predicted);
    free(c->stops);
    ceduo_arena_free(&c->file.arena);
    free(c);
}
