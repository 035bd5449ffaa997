/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quarry_site.h"
#include "study/observe.h"
#include "study/predict.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "line_scene.h"

#define PASSAGE_X  60 /* m */
#define VALUES_MIN 5  /* per kind of observation */

static const double bounds[QUARRY_VALUES_MAX][2] = {{0.25, 0.5}, {0.75, 0.95}, {0.05, 0.4}, {0.3, 0.7}};
const char *const quarry_names[QUARRY_VALUES_MAX] = {"rn", "rt", "roughness_rad", "friction"};

static void make_inputs(struct quarry_site *s)
{
    for (size_t i = 0; i < QUARRY_VALUES_MAX; i++) {
        for (size_t j = 0; j + 1 < QUARRY_VERTICES; j++) {
            snprintf(s->paths[i][j], sizeof s->paths[i][j], "slope.segments[%zu].%s", j, quarry_names[i]);
            s->places[i][j] = s->paths[i][j];
        }
        s->inputs[i] = (struct ceduo_input){.path = quarry_names[i],
                                            .kind = CEDUO_INPUT_RANGE,
                                            .lo = bounds[i][0],
                                            .hi = bounds[i][1],
                                            .places_count = QUARRY_VERTICES - 1,
                                            .places = s->places[i]};
    }
}

static void make_site(struct quarry_site *s, enum ceduo_law law, const double *truth, uint64_t seed)
{
    static const double x[QUARRY_VERTICES] = {0, 15, 40, 60, 90, 300}, z[QUARRY_VERTICES] = {60, 42, 20, 8, 2, 0};
    *s = (struct quarry_site){.scene = ceduo_scene_default(), .option = {.name = (char *)(uintptr_t) "bare"}};
    memcpy(s->x, x, sizeof x);
    memcpy(s->z, z, sizeof z);
    for (size_t j = 0; j + 1 < QUARRY_VERTICES; j++)
        s->segments[j] = (struct ceduo_segment){.rn = ceduo_number(truth[0]),
                                                .rt = ceduo_number(truth[1]),
                                                .roughness_m = NAN,
                                                .roughness_rad = truth[2],
                                                .friction = truth[3]};
    s->scene.slope = (struct ceduo_slope){
        .vertices = QUARRY_VERTICES, .x = s->x, .z = s->z, .segments = s->segments, .segments_given = QUARRY_VERTICES - 1};
    s->scene.rock.shape = CEDUO_SHAPE_SPHERE;
    s->scene.rock.diameter = ceduo_number(0.8);
    s->scene.rock.density = ceduo_number(2600);
    s->scene.release.height = ceduo_number(2);
    s->scene.release.vx = ceduo_number(0.5);
    s->scene.options = &s->option;
    s->scene.options_count = 1;
    s->scene.simulation.law = law;
    s->scene.simulation.seed = seed;
    make_inputs(s);
}

/* Simulate rocks and set their stops, and their speeds and heights at PASSAGE_X. Return false if a kind has too few values. */
static bool observe(const struct quarry_site *s, const struct quarry_trial *trial, double **values,
                    struct ceduo_observation *observed)
{
    static const enum ceduo_observed_kind kinds[] = {CEDUO_OBSERVED_STOPS, CEDUO_OBSERVED_SPEED, CEDUO_OBSERVED_HEIGHT};
    struct ceduo_observer *observer = NULL;
    bool good = true;
    for (size_t k = 0; k < trial->kinds; k++)
        observed[k] =
            (struct ceduo_observation){.kind = kinds[k], .name = "", .x = PASSAGE_X, .from = NAN, .to = NAN, .share_seen = NAN};
    if (ceduo_observer_create(observed, trial->kinds, &observer) != CEDUO_OK)
        return false;
    for (size_t k = 0; k < trial->kinds && good; k++) {
        size_t n, m = 0;
        good = ceduo_observer_values(observer, &s->scene, k, trial->observed, &values[k], &n) == CEDUO_OK;
        for (size_t i = 0; good && i < n; i++)
            if (!isnan(values[k][i]))
                values[k][m++] = values[k][i];
        gsl_sort(values[k], 1, m);
        observed[k].values = values[k];
        observed[k].n = m;
        observed[k].released_count = k == 0 ? trial->observed : 0;
        good = good && m >= VALUES_MIN;
    }
    ceduo_observer_free(observer);
    return good;
}

static bool fit(struct quarry_site *s, const struct ceduo_observation *observed, const struct quarry_trial *trial,
                struct ceduo_calibration *answer)
{
    struct ceduo_calibration_scene scene = {&s->scene, s->inputs, trial->kinds, observed};
    struct ceduo_calibration_def def = {.size = sizeof def,
                                        .scenes_count = 1,
                                        .scenes = &scene,
                                        .parameters_count = trial->values,
                                        .rocks = trial->rocks,
                                        .seed = s->scene.simulation.seed,
                                        .threads = trial->threads > 0 ? trial->threads : 1,
                                        .steps_max = trial->steps_max};
    return ceduo_calibrate(&def, answer) == CEDUO_OK;
}

/* Draw the truth and observe rocks on it. */
static bool make_trial(const struct quarry_trial *trial, double truth[QUARRY_VALUES_MAX], struct quarry_site *fitted,
                       double **values, struct ceduo_observation *observed)
{
    struct quarry_site true_site;
    struct line_random random = {1000 * trial->number + 77 * trial->made_by};
    for (size_t i = 0; i < QUARRY_VALUES_MAX; i++)
        truth[i] = i < trial->values || i < 3 ? line_uniform(&random, bounds[i][0], bounds[i][1]) : 0.5;
    make_site(&true_site, trial->made_by, truth, 100000 + trial->number);
    make_site(fitted, CEDUO_LAW_LUMPED, truth, 1 + trial->number);
    return observe(&true_site, trial, values, observed);
}

static void free_values(double **values)
{
    for (size_t k = 0; k < QUARRY_KINDS; k++)
        free(values[k]);
}

bool quarry_fit(const struct quarry_trial *trial, double truth[QUARRY_VALUES_MAX], struct ceduo_calibration *answer)
{
    struct quarry_site site;
    struct ceduo_observation observed[QUARRY_KINDS];
    double *values[QUARRY_KINDS] = {0};
    bool good = make_trial(trial, truth, &site, values, observed) && fit(&site, observed, trial, answer);
    free_values(values);
    return good;
}

bool quarry_compare(const struct quarry_trial *trial, double p[QUARRY_KINDS])
{
    struct quarry_site site;
    struct ceduo_observation observed[QUARRY_KINDS];
    struct ceduo_predicted found[QUARRY_KINDS];
    double *values[QUARRY_KINDS] = {0}, truth[QUARRY_VALUES_MAX];
    bool good = make_trial(trial, truth, &site, values, observed);
    struct ceduo_calibration_scene scene = {&site.scene, site.inputs, trial->kinds, observed};
    good = good && ceduo_compare_with_observations(&scene, trial->rocks, NULL, found) == CEDUO_OK;
    for (size_t k = 0; good && k < trial->kinds; k++)
        p[k] = found[k].p_value;
    free_values(values);
    return good;
}
