/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check_study.h"

#include <math.h>

#include "core/runs/check.h"

static enum ceduo_status check_status(bool good)
{
    return good ? CEDUO_OK : CEDUO_BAD_ARGUMENT;
}

/* ---- inputs ---- */

static bool is_distribution_valid(const struct ceduo_input *in, bool has_places)
{
    bool finite = isfinite(in->mean) && isfinite(in->sd) && in->sd > 0, draws = in->draws && in->draws_count > 0;
    switch (in->kind) {
    case CEDUO_INPUT_RANGE:
    case CEDUO_INPUT_FACTOR:
        return isfinite(in->lo) && isfinite(in->hi) && in->lo <= in->hi;
    case CEDUO_INPUT_NORMAL:
        return finite;
    case CEDUO_INPUT_GAMMA:
        return finite && in->mean > 0 && in->sd <= CEDUO_GAMMA_MAX * in->mean;
    case CEDUO_INPUT_WORDS:
        return in->words_count > 0 && (in->words || !has_places);
    case CEDUO_INPUT_DRAWS:
        for (size_t k = 0; draws && k < in->places_count; k++)
            draws = in->draws[k];
        return draws && in->places_count > 0;
    }
    return false;
}

enum ceduo_status ceduo_check_inputs(const struct ceduo_input *inputs, size_t n, bool has_places)
{
    bool good = inputs || n == 0;
    for (size_t i = 0; good && i < n; i++) {
        good =
            is_distribution_valid(&inputs[i], has_places) && (!has_places || inputs[i].places || inputs[i].places_count == 0);
        for (size_t k = 0; good && has_places && k < inputs[i].places_count; k++)
            good = inputs[i].places[k];
    }
    return check_status(good);
}

/* ---- uncertainty ---- */

/* True if `own` is NULL, or covers all options, with their years if a rotation is requested. */
static bool is_own_valid(const struct ceduo_uncertainty_def *def)
{
    const struct ceduo_results *own = def->own;
    size_t options = def->scene->options_count;
    bool good = !own || (def->brief && own->result && own->result->options_count == options);
    bool years = own && def->rotation && def->scene->simulation.contact_model != CEDUO_CONTACT_MODEL_INDEX;
    if (good && years)
        good = own->years && own->years_count == options;
    for (size_t i = 0; good && years && i < options; i++)
        good = own->years[i];
    return good;
}

enum ceduo_status ceduo_check_uncertainty_def(const struct ceduo_uncertainty_def *def)
{
    enum ceduo_status status = def->size == sizeof *def ? ceduo_scene_check(def->scene, NULL) : CEDUO_BAD_ARGUMENT;
    if (status != CEDUO_OK)
        return status;
    size_t options = def->scene->options_count;
    bool counts = options > 0 && def->scene->controls_count > 0 && def->inputs_count > 0 && def->points >= 2 &&
                  def->points <= CEDUO_UNCERTAINTY_POINTS_MAX && def->points_max <= CEDUO_UNCERTAINTY_POINTS_MAX &&
                  def->years_max <= CEDUO_UNCERTAINTY_YEARS_MAX && def->rocks <= CEDUO_ROCKS_MAX &&
                  def->own_rocks <= CEDUO_ROCKS_MAX && def->threads <= CEDUO_THREADS_MAX;
    bool good = counts && (!def->one_option || def->option < options) && is_own_valid(def) &&
                (def->window.step == 0 || ceduo_check_window(def->window) == CEDUO_OK);
    return good ? ceduo_check_inputs(def->inputs, def->inputs_count, true) : CEDUO_BAD_ARGUMENT;
}

/* ---- fits ---- */

enum ceduo_status ceduo_check_observations(const struct ceduo_observation *observations, size_t n, size_t options)
{
    bool good = observations || n == 0;
    for (size_t i = 0; good && i < n; i++) {
        const struct ceduo_observation *o = &observations[i];
        good = (size_t)o->kind < CEDUO_OBSERVED_KINDS && (options == 0 || o->option < options) &&
               (o->kind != CEDUO_OBSERVED_PASSED || o->count <= o->released_count) && (!o->values || o->n > 0);
        for (size_t k = 0; good && o->values && k < o->n; k++)
            good = !isnan(o->values[k]);
    }
    return check_status(good);
}

static enum ceduo_status check_fitted_scene(const struct ceduo_calibration_scene *s, size_t parameters)
{
    enum ceduo_status status = ceduo_scene_check(s->scene, NULL);
    if (status == CEDUO_OK)
        status = check_status(s->scene->options_count > 0 && s->inputs);
    if (status == CEDUO_OK)
        status = ceduo_check_inputs(s->inputs, parameters, true);
    for (size_t i = 0; status == CEDUO_OK && i < parameters; i++)
        status = check_status(s->inputs[i].kind == CEDUO_INPUT_RANGE && s->inputs[i].lo < s->inputs[i].hi);
    return status == CEDUO_OK ? ceduo_check_observations(s->observations, s->observations_count, s->scene->options_count)
                              : status;
}

enum ceduo_status ceduo_check_calibration_def(const struct ceduo_calibration_def *def)
{
    enum ceduo_status status =
        check_status(def->size == sizeof *def && def->scenes && def->scenes_count > 0 && def->parameters_count > 0 &&
                     def->parameters_count <= CEDUO_CALIBRATION_MAX && def->rocks > 0 && def->rocks <= CEDUO_ROCKS_MAX &&
                     def->threads <= CEDUO_THREADS_MAX && def->steps_max <= CEDUO_CALIBRATION_STEPS);
    for (size_t i = 0; status == CEDUO_OK && i < def->scenes_count; i++)
        status = check_fitted_scene(&def->scenes[i], def->parameters_count);
    return status;
}

/* ---- searches and surveys ---- */

enum ceduo_status ceduo_check_find_def(const struct ceduo_find_def *def)
{
    return check_status(def->size == sizeof *def && def->goal && isfinite(def->lo) && isfinite(def->hi) &&
                        isfinite(def->hi - def->lo));
}

enum ceduo_status ceduo_check_survey(const struct ceduo_survey *s)
{
    size_t species;
    ceduo_species_list(&species);
    bool good = s->plots_count > 0 && s->areas && (s->stems || s->stems_count == 0) && s->stools_count <= CEDUO_SURVEY_STOOLS;
    for (size_t i = 0; good && i < s->plots_count; i++)
        good = s->areas[i] > 0 && isfinite(s->areas[i]);
    for (size_t i = 0; good && i < s->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &s->stems[i];
        good = stem->plot < s->plots_count && (size_t)stem->kind < CEDUO_SURVEY_KINDS_COUNT && stem->species >= -1 &&
               stem->species < (int)species && stem->dbh > 0 && isfinite(stem->dbh) &&
               (stem->kind != CEDUO_SURVEY_SHOOT || stem->stool < s->stools_count);
    }
    return check_status(good);
}
