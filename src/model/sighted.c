/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sighted.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

static const uint64_t levels[SIGHT_LEVELS] = {200, 2000};

/* ---- stops along the slope ---- */

static enum ceduo_status look_at_stops(struct sighted *s, const struct ceduo_observer *observer, size_t which)
{
    double *values;
    size_t rocks, n = 0;
    enum ceduo_status status = ceduo_observer_values(observer, &s->file.scene, which, s->rocks, &values, &rocks);
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < rocks; i++)
        if (!isnan(values[i]))
            values[n++] = values[i];
    gsl_sort(values, 1, n);
    if (n > 0)
        ceduo_seen_stops_of(&s->file.observations[which], values, n, rocks, &s->stops[which]);
    free(values);
    return CEDUO_OK;
}

static enum ceduo_status look_at_all_stops(struct sighted *s, const atomic_bool *cancel)
{
    const struct ceduo_observation *o = s->file.observations;
    struct ceduo_observer *observer;
    enum ceduo_status status = ceduo_observer_create(o, s->file.observations_count, &observer);
    for (size_t i = 0; i < s->file.observations_count && status == CEDUO_OK; i++)
        if (o[i].kind == CEDUO_OBSERVED_STOPS && o[i].values)
            status = atomic_load(cancel) ? CEDUO_CANCELLED : look_at_stops(s, observer, i);
    ceduo_observer_free(observer);
    return status;
}

/* ---- all ---- */

enum ceduo_status ceduo_sighted_make(const struct scene_file *file, size_t level, const atomic_bool *cancel,
                                     struct sighted **sighted)
{
    struct sighted *s = *sighted = calloc(1, sizeof *s);
    if (!s) {
        struct arena arena = file->arena;
        ceduo_arena_free(&arena);
        return CEDUO_NO_MEMORY;
    }
    *s = (struct sighted){.file = *file, .rocks = levels[level]};
    s->predicted = calloc(file->observations_count + 1, sizeof *s->predicted);
    s->stops = calloc(file->observations_count + 1, sizeof *s->stops);
    const struct ceduo_calibration_scene scene = {
        .scene = &s->file.scene, .observations_count = file->observations_count, .observations = file->observations};
    enum ceduo_status status = s->predicted && s->stops ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = ceduo_calibration_as_it_is(&scene, s->rocks, cancel, s->predicted);
    if (status == CEDUO_OK)
        status = look_at_all_stops(s, cancel);
    if (status != CEDUO_OK) {
        ceduo_sighted_free(s);
        *sighted = NULL;
    }
    return status;
}

void ceduo_sighted_free(struct sighted *s)
{
    if (!s)
        return;
    free(s->predicted);
    free(s->stops);
    ceduo_arena_free(&s->file.arena);
    free(s);
}
