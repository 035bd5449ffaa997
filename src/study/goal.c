/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "goal.h"
#include "core/runs/run.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

const struct ceduo_goal_row ceduo_goals[CEDUO_GOALS] = {
    [CEDUO_GOAL_ADC] = {"adc", N_("ADC"), "m", true, false, "the ADC of the worst belt", "the threshold of the scene"},
    [CEDUO_GOAL_FREE_RUN] = {"free-run", N_("chance of a free run"), "%", false, false,
                             "the chance of a free run in the worst belt", "0.1"},
    [CEDUO_GOAL_ENERGY] = {"energy", N_("mean energy"), "kJ", false, true,
                           "the mean energy of the rocks that arrive through the forest (with contact_model: index "
                           "the energy left by the index)",
                           NULL},
    [CEDUO_GOAL_EXCEED] = {"exceed", N_("share with too much energy"), "%", false, true,
                           "the share of released rocks that arrive through the forest with more than accepted_kJ",
                           "0.05, or with blocks one rock in accepted_return_y"},
    [CEDUO_GOAL_ARRIVE] = {"arrive", N_("share that arrives"), "%", false, true,
                           "the share of released rocks that arrive through the forest (with contact_model: index "
                           "without forest)",
                           NULL},
    [CEDUO_GOAL_WORST_EXCEED] = {"worst-exceed", N_("share with too much energy in the worst year"), "%", false, true,
                                 "exceed in the worst of the years ahead, with or without --years",
                                 "0.05, or with blocks one rock in accepted_return_y"},
    [CEDUO_GOAL_WORST_ARRIVE] = {"worst-arrive", N_("share that arrives in the worst year"), "%", false, true,
                                 "arrive in the worst of the years ahead, with or without --years", NULL}};

bool ceduo_goal_is_share(enum ceduo_goal goal)
{
    return ceduo_goals[goal].unit[0] == '%';
}

bool ceduo_goal_is_worst(enum ceduo_goal goal)
{
    return goal == CEDUO_GOAL_WORST_EXCEED || goal == CEDUO_GOAL_WORST_ARRIVE;
}

bool ceduo_goal_needs_accepted(enum ceduo_goal goal)
{
    return goal == CEDUO_GOAL_EXCEED || goal == CEDUO_GOAL_WORST_EXCEED;
}

void ceduo_goal_words(struct text *text)
{
    for (size_t i = 0; i < CEDUO_GOALS; i++)
        ceduo_text_format(text, "%s%s", i > 0 ? ", " : "", ceduo_goals[i].word);
}

double ceduo_goal_limit(enum ceduo_goal goal, const struct ceduo_scene *scene)
{
    double exceed = 1; /* at the control with the strictest limit */
    for (size_t c = 0; c < scene->controls_count; c++)
        exceed = fmin(exceed, ceduo_exceed_limit(scene, &scene->controls[c]));
    const double limits[CEDUO_GOALS] = {scene->simulation.threshold, CEDUO_FREE_RUN_MAX, NAN, exceed, NAN, exceed, NAN};
    return limits[goal];
}

/* Return the goal at one control. `wooded` may be NULL (not simulated). */
static double goal_at_control(enum ceduo_goal goal, const struct ceduo_index *index, const struct ceduo_arrivals *wooded,
                              const struct ceduo_arrivals *bare)
{
    const struct ceduo_arrivals *arrivals = wooded ? wooded : bare;
    return goal == CEDUO_GOAL_ADC            ? index->worst_adc
           : goal == CEDUO_GOAL_FREE_RUN     ? index->worst_free_run
           : ceduo_goal_needs_accepted(goal) ? arrivals->exceed.mean
           : ceduo_goal_is_share(goal)       ? arrivals->reach.mean
           : arrivals->reached == 0          ? 0 /* no rock arrives */
                                             : (wooded ? arrivals->energy.mean : index->residual) * 1e-3;
}

static double nan_max(double a, double b)
{
    return isnan(b) || b > a ? b : a;
}

bool ceduo_goal_is_mean(enum ceduo_goal goal)
{
    return goal == CEDUO_GOAL_EXCEED || goal == CEDUO_GOAL_ARRIVE;
}

double ceduo_goal_reached(enum ceduo_goal goal, const struct ceduo_result *result, size_t option,
                          const struct ceduo_years *years)
{
    double worst = -INFINITY;
    size_t n = years ? years->count : 1; /* today is one year */
    for (size_t c = 0; c < result->scene->controls_count; c++) {
        double worst_year = -INFINITY, sum = 0;
        for (size_t i = 0; i < n; i++) {
            const struct ceduo_year *y = years ? &years->years[i] : NULL;
            const struct ceduo_arrivals *wooded = !y                    ? ceduo_result_wooded(result, option, c)
                                                  : y->wooded.rocks > 0 ? &y->wooded.arrivals[c]
                                                                        : NULL;
            const struct ceduo_index *controls = y ? y->controls : result->options[option].controls;
            double value = goal_at_control(goal, &controls[c], wooded, &result->bare.arrivals[c]);
            worst_year = nan_max(worst_year, value);
            sum += value;
        }
        worst = nan_max(worst, ceduo_goal_is_mean(goal) ? sum / (double)n : worst_year);
    }
    return worst;
}

enum ceduo_goal_reading ceduo_goal_read(char *text, enum ceduo_goal *goal, double *value)
{
    char *equals = strchr(text, '=');
    if (equals)
        *equals++ = '\0';
    int i = 0;
    while (i < CEDUO_GOALS && strcmp(text, ceduo_goals[i].word) != 0)
        i++;
    if (i == CEDUO_GOALS)
        return CEDUO_GOAL_UNKNOWN;
    *goal = (enum ceduo_goal)i;
    *value = NAN;
    if (equals && ceduo_number_read(equals, value) != CEDUO_NUMBER_GOOD)
        return CEDUO_GOAL_NO_NUMBER;
    if (*value < 0)
        return CEDUO_GOAL_NEGATIVE;
    return ceduo_goal_is_share(*goal) && *value > 1 ? CEDUO_GOAL_NO_SHARE : CEDUO_GOAL_GOOD;
}
