/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "jobs.h"

#include <gsl/gsl_sort.h>
#include <math.h>

#include "base/must.h"

static const uint64_t levels[COMPARISON_LEVELS] = {200, 2000};

static enum ceduo_status compare_stops(struct comparison *c, const struct ceduo_observer *observer, size_t which)
{
    double *values;
    size_t rocks, n = 0;
    enum ceduo_status status = ceduo_observer_values(observer, &c->file.scene, which, c->rocks, &values, &rocks);
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < rocks; i++)
        if (!isnan(values[i]))
            values[n++] = values[i];
    gsl_sort(values, 1, n);
    if (n > 0)
        ceduo_seen_stops_of(&c->file.observations[which], values, n, rocks, &c->stops[which]);
    free(values);
    return CEDUO_OK;
}

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
    for (size_t i = 0; i < c->file.observations_count && status == CEDUO_OK; i++)
        if (o[i].kind == CEDUO_OBSERVED_STOPS && o[i].values)
            status = atomic_load(cancel) ? CEDUO_CANCELLED : compare_stops(c, observer, i);
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
