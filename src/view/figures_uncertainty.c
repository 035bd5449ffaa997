/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of an uncertainty report and of a calibration. */
#include "figures_parts.h"
#include "scene/derived.h"

#include <string.h>

/* ---- uncertainty ---- */

static const struct ceduo_uncertainty_figure *get_figure(const struct ceduo_place *p)
{
    return &p->uncertainty->answer->figures[p->figure];
}

static const struct ceduo_scene *get_uncertain_scene(const struct ceduo_place *p)
{
    return &p->uncertainty->file->scene;
}

/* Convert energies to kJ. */
static double to_display_unit(const struct ceduo_place *p, double value)
{
    return get_figure(p)->kind == CEDUO_UNCERTAINTY_ENERGY ? value * J_TO_KJ : value;
}

static const struct ceduo_uncertainty_order *get_order(const struct ceduo_place *p)
{
    return &p->uncertainty->answer->orders[p->item];
}

static bool enter_figure(struct ceduo_place *p, size_t i)
{
    const struct ceduo_uncertainty_result *a = p->uncertainty->answer;
    for (p->figure = 0; a && p->figure < a->figures_count; p->figure++)
        if (a->figures[p->figure].kind < CEDUO_UNCERTAINTY_SHOWN && a->figures[p->figure].fit.values && i-- == 0)
            return true;
    return false;
}

/* Select an input, sorted by the width that remains if it is known, smallest first. */
static bool enter_input(struct ceduo_place *p, size_t i)
{
    p->input = i < get_figure(p)->uses ? get_figure(p)->order[i] : 0;
    return i < get_figure(p)->uses;
}

/* Select an input to measure first, for the figure of the advice. */
static bool enter_first(struct ceduo_place *p, size_t i)
{
    const struct ceduo_uncertainty_result *a = p->uncertainty->answer;
    if (!a)
        return false;
    const struct ceduo_uncertainty_figure *f =
        ceduo_uncertainty_find_figure(a, ceduo_uncertainty_advised_option(p->uncertainty), a->main, false);
    size_t input = ceduo_uncertainty_advised_input(p->uncertainty, f, i);
    p->figure = (size_t)(f - a->figures);
    p->input = input == SIZE_MAX ? 0 : input;
    return input != SIZE_MAX;
}

ENTER(enter_order, item, p->uncertainty->answer ? p->uncertainty->answer->orders_count : 0)

static struct ceduo_value read_input_end(const struct ceduo_place *p, int end)
{
    const char *word;
    double value = ceduo_uncertainty_input_value(p->uncertainty, p->input, end, &word);
    return word ? WORD(word) : NUMBER(value);
}

/* Return the key of a figure. The rotation's figure is the judged share. */
static const char *figure_key(const struct ceduo_place *p)
{
    static const char *const keys[CEDUO_UNCERTAINTY_SHOWN] = {
        [CEDUO_UNCERTAINTY_REACH] = "reach_probability",
        [CEDUO_UNCERTAINTY_EXCEED] = "exceed_probability",
        [CEDUO_UNCERTAINTY_ENERGY] = "energy_per_released_kJ",
        [CEDUO_UNCERTAINTY_MEAN] = "rotation.exceed_probability",
        [CEDUO_UNCERTAINTY_FAILING] = "rotation.unprotected_energy",
        [CEDUO_UNCERTAINTY_DEFEATED] = "fence.defeated",
    };
    enum ceduo_uncertainty_kind kind = get_figure(p)->kind;
    bool reaches = kind == CEDUO_UNCERTAINTY_MEAN && p->uncertainty->answer->main == CEDUO_UNCERTAINTY_ENERGY;
    return reaches ? "rotation.reach_probability" : keys[kind];
}

OBJECT(uncertain_scene_object, place, get_uncertain_scene(o))
OBJECT(uncertain_figure_object, place, get_figure(o))
OBJECT(get_input, place, &o->uncertainty->inputs->items[o->input])
OBJECT(get_first_share, place, &get_figure(o)->fit.first[o->input])
OBJECT(get_total_share, place, &get_figure(o)->fit.total[o->input])
OBJECT(ranked, place, get_order(o))

VALUE(uncertainty_format, place, TEXT, WORD("ceduo-sensitivity-1"))
VALUE(uncertainty_scene, place, TEXT, WORD(o->uncertainty->file->name))
VALUE(uncertainty_rocks, place, COUNT, COUNT(o->uncertainty->rocks))
VALUE(uncertainty_points, place, COUNT, COUNT(o->uncertainty->answer ? o->uncertainty->answer->points : o->uncertainty->points))
VALUE(uncertainty_evaluations, place, COUNT, COUNT(o->uncertainty->answer ? o->uncertainty->answer->evaluations : 0))
VALUE(uncertainty_option, place, TEXT, WORD(get_uncertain_scene(o)->options[get_figure(o)->option].name_given))
VALUE(uncertainty_against, place, TEXT, WORD(get_figure(o)->difference ? get_uncertain_scene(o)->options[0].name_given : NULL))
VALUE(uncertainty_x, place, NUMBER,
      NUMBER(get_uncertain_scene(o)->controls[ceduo_scene_last_control(get_uncertain_scene(o))].x_given))
VALUE(uncertainty_figure, place, TEXT, WORD(figure_key(o)))
VALUE(figure_number, place, NUMBER, NUMBER(to_display_unit(o, *(const double *)get_member(f, get_figure(o)))))
#define FIGURE(member) .value = figure_number, .offset = offsetof(struct ceduo_uncertainty_figure, member)
/* Report the paths that set the input: its own, or those of all its places if no single path selects them. */
static void report_paths(const struct ceduo_place *p, ceduo_sentence_sink *sink, void *context)
{
    const struct ceduo_input *input = &p->uncertainty->inputs->items[p->input];
    bool own = input->places_count == 1 || strchr(input->path, '*') || strncmp(input->path, "slope.materials[", 16) == 0;
    size_t n;
    for (const char *rest = input->path, *path; own && (path = ceduo_paths_next(&rest, &n));) {
        LOCAL_TEXT(one);
        ceduo_text_append_n(&one, path, n);
        sink(context, ceduo_text_string(&one));
    }
    for (size_t i = 0; !own && i < input->places_count; i++)
        sink(context, ceduo_input_path(p->uncertainty->file, input->places[i]));
}

VALUE(input_measured, place, TEXT, WORD(ceduo_uncertainty_measured_by(o->uncertainty, o->input)))
VALUE(input_lo, place, ANY, read_input_end(o, 0))
VALUE(input_hi, place, ANY, read_input_end(o, 1))
VALUE(input_at_lo, place, NUMBER, NUMBER(to_display_unit(o, get_figure(o)->at_ends[o->input][0])))
VALUE(input_at_hi, place, NUMBER, NUMBER(to_display_unit(o, get_figure(o)->at_ends[o->input][1])))
VALUE(input_known_width, place, NUMBER, NUMBER(to_display_unit(o, get_figure(o)->fit.width_if_known[o->input])))
VALUE(order_better, place, TEXT, WORD(get_uncertain_scene(o)->options[get_order(o)->better].name_given))
VALUE(order_than, place, TEXT, WORD(get_uncertain_scene(o)->options[get_order(o)->than].name_given))
VALUE(order_period, place, TEXT, WORD(o->uncertainty->answer->rotation ? "rotation" : "today"))

#define NO_BAND    NO_LIMIT ", or there are fewer than 20 points"
#define FEW_POINTS "there are too few points, or nothing varies"

static const struct ceduo_figure uncertainty_scene_rows[] = {
    {"scene", "", "path of the file", .value = uncertainty_scene},
    {"title", "", "title of the scene", .from = uncertain_scene_object, MEMBER(scene, title)},
    {"seed", "", "seed of the random numbers", .from = uncertain_scene_object, MEMBER(scene, simulation.seed)},
    {"rocks", "", "rocks of each scene computed", .value = uncertainty_rocks},
    {"points", "", "plausible cases computed", .value = uncertainty_points},
    END};

static const struct ceduo_figure band_rows[] = {
    {"p5", "", "5th percentile of the plausible cases, or the value if that is lower", FIGURE(fit.p5), .null = NO_BAND},
    {"p50", "", "median of the plausible cases", FIGURE(fit.p50), .null = NO_BAND},
    {"p95", "", "95th percentile of the plausible cases, or the value if that is higher", FIGURE(fit.p95), .null = NO_BAND},
    {"p5_se", "", "standard error of p5, by the points and by the rocks", FIGURE(fit.p5_se), .null = NO_BAND},
    {"p95_se", "", "standard error of p95", FIGURE(fit.p95_se), .null = NO_BAND},
    END};

static const struct ceduo_figure uncertainty_figure_rows[] = {
    {"option", "", "name of the option", .value = uncertainty_option},
    {"against", "", "of a difference: the first option", .value = uncertainty_against, .null = "the figure is no difference"},
    {"x_m", "m", "the last control", .value = uncertainty_x},
    {"figure", "",
     "reach_probability, exceed_probability or energy_per_released_kJ; with --years also rotation.exceed_probability (without "
     "an accepted energy rotation.reach_probability), the mean of the years, and rotation.unprotected_energy, the years in "
     "which more exceed than are allowed",
     .value = uncertainty_figure},
    {"value", "", "in the scene as it is", FIGURE(value), .null = NO_LIMIT},
    {"sampling_lo", "", "lower end of its 95 % interval, by the rocks", FIGURE(sampling_lo), .null = NO_LIMIT},
    {"sampling_hi", "", "upper end of its 95 % interval", FIGURE(sampling_hi), .null = NO_LIMIT},
    {"uncertainty", "", "by the uncertain inputs", .table = band_rows},
    {"within", "", "share of plausible cases in which no more exceed than are allowed", FIGURE(fit.share_below.value),
     .null = "the figure is not the share that exceeds, today or in the mean of the years"},
    {"within_se", "", "its standard error", FIGURE(fit.share_below.se),
     .null = "the figure is not the share that exceeds, today or in the mean of the years"},
    {"q2", "", "share of the variance that the surface predicts, leaving out each point in turn",
     .from = uncertain_figure_object, MEMBER(uncertainty_figure, fit.q2), .null = FEW_POINTS},
    {"unexplained", "", "share of the variance that neither single inputs nor pairs explain", .from = uncertain_figure_object,
     MEMBER(uncertainty_figure, fit.unexplained.value), .null = FEW_POINTS},
    END};

static const struct ceduo_figure input_range_rows[] = {
    {"lo", "", "lower end of its range, or its first word", .value = input_lo, .null = "it has no one range"},
    {"hi", "", "upper end of its range, or its last word", .value = input_hi, .null = "it has no one range"},
    {"first", "", "share of the variance that it causes alone", .from = get_first_share, MEMBER(share, value),
     .null = FEW_POINTS},
    {"first_se", "", "its standard error", .from = get_first_share, MEMBER(share, se), .null = FEW_POINTS},
    {"total", "", "share that it causes alone or with others", .from = get_total_share, MEMBER(share, value),
     .null = FEW_POINTS},
    {"total_se", "", "its standard error", .from = get_total_share, MEMBER(share, se), .null = FEW_POINTS},
    {"at_lo", "", "the figure with this input at its lower end, all others as they are", .value = input_at_lo,
     .null = NO_LIMIT ", or the figure is of years"},
    {"at_hi", "", "the same at its upper end", .value = input_at_hi, .null = NO_LIMIT ", or the figure is of years"},
    {"width_if_known", "", "expected width of the 90 % range if this input were known", .value = input_known_width,
     .null = FEW_POINTS},
    END};

static const struct ceduo_figure input_rows[] = {
    {"path", "", "path of the input", .from = get_input, MEMBER(input, path)},
    {"paths", "", "paths for --set, with the same --option: all of them at one value are the input at that value",
     .sentences = report_paths},
    {"places", "", "number of values of the scene that change with it", .from = get_input, MEMBER(input, places_count)},
    {"source", "", "source of its range", .from = get_input, MEMBER(input, source)},
    {"measured_by", "", "measurement that would reduce its range", .value = input_measured, .null = "nothing that is known"},
    {.table = input_range_rows},
    END};

static const struct ceduo_figure first_rows[] = {
    {"path", "", "path of the input", .from = get_input, MEMBER(input, path)},
    {"measured_by", "", "measurement that would reduce its range", .value = input_measured},
    {"option", "", "its option: the one that lets least pass in the mean of plausible cases", .value = uncertainty_option},
    {"width_if_known", "", "expected width of the 90 % range of its figure if this input were known",
     .value = input_known_width, .null = FEW_POINTS},
    END};

static const struct ceduo_figure uncertainty_figure_object[] = {
    {.table = uncertainty_figure_rows},
    {"inputs", "", "an object for each input, the heaviest first", .table = input_rows, .enter = enter_input},
    END};

static const struct ceduo_figure ranking_rows[] = {
    {"better", "", "name of the better option", .value = order_better},
    {"than", "", "name of the next one", .value = order_than},
    {"x_m", "m", "the last control", .value = uncertainty_x},
    {"over", "", "today, or rotation: by the mean of the years", .value = order_period},
    {"probability", "", "share of plausible cases in which it is better", .from = ranked,
     MEMBER(uncertainty_order, probability)},
    {"equal", "", "in which they differ by at most 5 of 1000, or of energies by 0.5 % of the mean without forest",
     .from = ranked, MEMBER(uncertainty_order, equal)},
    {"worse", "", "in which it is worse", .from = ranked, MEMBER(uncertainty_order, worse)},
    END};

const struct ceduo_figure ceduo_uncertainty_figures[] = {
    {"format", "", "always ceduo-sensitivity-1", .value = uncertainty_format},
    VERSION,
    {.table = uncertainty_scene_rows},
    {"figures", "", "an object for each figure and option", .table = uncertainty_figure_object, .enter = enter_figure},
    {"ranking", "", "an object for each two neighbours in rank", .table = ranking_rows, .enter = enter_order},
    {"measure_first", "", "an object for each input to be measured, the first one first: only those that a reader can measure",
     .table = first_rows, .enter = enter_first},
    {"evaluations", "", "scenes computed", .value = uncertainty_evaluations},
    END};

static const struct ceduo_figure uncertainty_columns[] = {{.table = uncertainty_scene_rows},
                                                          {.table = uncertainty_figure_rows},
                                                          {"path", "", "", .from = get_input, MEMBER(input, path)},
                                                          {"measured_by", "", "", .value = input_measured},
                                                          {.table = input_range_rows},
                                                          END};

const struct ceduo_csv ceduo_uncertainty_csv = {uncertainty_columns, {enter_figure, enter_input}};

/* ---- calibration ---- */

static const struct ceduo_calibration *get_calibration(const struct ceduo_place *p)
{
    return p->calibration->answer;
}

static const struct ceduo_predicted *get_prediction(const struct ceduo_place *p)
{
    return &get_calibration(p)->predicted[p->item];
}

static const struct ceduo_observation *get_observation(const struct ceduo_place *p)
{
    return ceduo_observed_find(p->calibration, get_prediction(p));
}

static const struct scene_file *get_file(const struct ceduo_place *p)
{
    return &p->calibration->files[get_prediction(p)->scene];
}

OBJECT(calibration_object, place, get_calibration(o))
OBJECT(get_fitted, place, &get_calibration(o)->parameters[o->item])
OBJECT(prediction_object, place, get_prediction(o))
ENTER(enter_fitted, item, get_calibration(p)->parameters_count)
ENTER(enter_column, column, get_calibration(p)->parameters_count)
ENTER(enter_predicted, item, get_calibration(p)->predicted_count)

static void report_scenes(const struct ceduo_place *p, ceduo_sentence_sink *sink, void *context)
{
    for (size_t i = 0; i < p->calibration->scenes_count; i++)
        sink(context, p->calibration->files[i].name);
}

VALUE(calibration_format, place, TEXT, WORD("ceduo-calibration-1"))
VALUE(calibration_seed, place, COUNT, COUNT(o->calibration->files[0].scene.simulation.seed))
VALUE(calibration_rocks, place, COUNT, COUNT(o->calibration->rocks))
VALUE(first_scene, place, TEXT, WORD(o->calibration->files[0].name))
VALUE(fitted_path, place, TEXT, WORD(o->calibration->inputs[o->item].path))
VALUE(correlation, place, NUMBER, NUMBER(get_calibration(o)->correlation[o->item][o->column]))
VALUE(observed_what, place, TEXT, WORD(get_observation(o)->name_given))
VALUE(observed_scene, place, TEXT, WORD(get_file(o)->name))
VALUE(observed_option, place, TEXT, WORD(get_file(o)->scene.options[get_observation(o)->option].name_given))
VALUE(observed_use, place, TEXT, WORD(get_observation(o)->use == CEDUO_OBSERVED_USE_FIT ? "fit" : "check"))
VALUE(observed_n, place, COUNT, COUNT(ceduo_observed_number(get_observation(o))))
VALUE(observed_number, place, NUMBER,
      NUMBER(ceduo_observed_shown(get_file(o), get_prediction(o), *(const double *)get_member(f, get_prediction(o)))))
#define OBSERVED(member) .value = observed_number, .offset = offsetof(struct ceduo_predicted, member)
VALUE(single_inside, place, COUNT,
      get_observation(o)->values && !isnan(get_prediction(o)->one_lo) ? COUNT(get_prediction(o)->one_inside) : NO_VALUE)

#define NO_RANGE "the draws do not determine it"

static const struct ceduo_figure fitted_rows[] = {
    {"path", "", "path of the value", .value = fitted_path},
    {"lo", "", "lower bound that was given", .from = get_fitted, MEMBER(fitted, lo)},
    {"hi", "", "upper bound that was given", .from = get_fitted, MEMBER(fitted, hi)},
    {"best", "", "value that fits best", .from = get_fitted, MEMBER(fitted, best)},
    {"p2_5", "", "lower end of its 95 % interval", .from = get_fitted, MEMBER(fitted, p2_5), .null = NO_RANGE},
    {"p50", "", "its median", .from = get_fitted, MEMBER(fitted, p50), .null = NO_RANGE},
    {"p97_5", "", "its upper end", .from = get_fitted, MEMBER(fitted, p97_5), .null = NO_RANGE},
    {"determined", "", "true if the observations determine it", .from = get_fitted, MEMBER(fitted, identified)},
    {"at_bound", "", "true if it lies at a bound", .from = get_fitted, MEMBER(fitted, at_bound)},
    END};

static const struct ceduo_figure correlation_cell[] = {{NULL, "", "", .value = correlation}, END};
static const struct ceduo_figure correlation_row[] = {
    {NULL, "", "", .table = correlation_cell, .enter = enter_column, .plain = true}, END};

static const struct ceduo_figure observation_rows[] = {
    {"what", "", "name of the observation", .value = observed_what},
    {"scene", "", "path of its scene", .value = observed_scene},
    {"option", "", "name of its option", .value = observed_option},
    {"use", "", "fit or check", .value = observed_use},
    {"n", "", "number of observed rocks", .value = observed_n},
    {"deviance", "", "deviance at the best values", .from = prediction_object, MEMBER(predicted, at_best.deviance)},
    {"p_value", "", "probability that simulated rocks deviate as much", .from = prediction_object, MEMBER(predicted, p_value),
     .null = NO_RANGE},
    {"seen", "", "mean of what was observed", OBSERVED(observed)},
    {"predicted_lo", "", "lower end of what the fit predicts of that mean, 95 %", OBSERVED(lo), .null = NO_RANGE},
    {"predicted_hi", "", "its upper end", OBSERVED(hi), .null = NO_RANGE},
    {"inside", "", "true if the mean lies between the two", .from = prediction_object, MEMBER(predicted, inside)},
    {"single_lo", "", "lower end of what the fit predicts of single rocks, 95 %", OBSERVED(one_lo), .null = NO_RANGE},
    {"single_hi", "", "its upper end", OBSERVED(one_hi), .null = NO_RANGE},
    {"single_inside", "", "number of values between the two", .value = single_inside,
     .null = "it holds no single values, or " NO_RANGE},
    END};

const struct ceduo_figure ceduo_calibration_figures[] = {
    {"format", "", "always ceduo-calibration-1", .value = calibration_format},
    VERSION,
    {"scenes", "", "paths of the files", .sentences = report_scenes},
    {"seed", "", "seed of the random numbers", .value = calibration_seed},
    {"rocks", "", "rocks of each scene computed", .value = calibration_rocks},
    {"parameters", "", "an object for each fitted value", .table = fitted_rows, .enter = enter_fitted},
    {"correlation", "", "of these values, row by row", .table = correlation_row, .enter = enter_fitted, .plain = true},
    {"observations", "", "an object for each observation", .table = observation_rows, .enter = enter_predicted},
    {"misfit", "", "true if the model cannot reproduce an observation that it was fitted to", .from = calibration_object,
     MEMBER(calibration, misfit)},
    {"refuted", "", "true if the fit does not reproduce the observations held back to check it", .from = calibration_object,
     MEMBER(calibration, check_failed)},
    {"settled", "", "true if the chains agree", .from = calibration_object, MEMBER(calibration, converged)},
    {"evaluations", "", "scenes computed", .from = calibration_object, MEMBER(calibration, evaluations)},
    {"rhat", "", "largest potential scale reduction of the values", .from = calibration_object, MEMBER(calibration, rhat)},
    {"effective_size", "", "smallest effective size of the values", .from = calibration_object,
     MEMBER(calibration, effective_size)},
    END};

static const struct ceduo_figure calibration_columns[] = {
    {"scene", "", "", .value = first_scene},
    {.table = fitted_rows},
    {"misfit", "", "", .from = calibration_object, MEMBER(calibration, misfit)},
    END};

const struct ceduo_csv ceduo_calibration_csv = {calibration_columns, {enter_fitted}};
