/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits scene values to observations. Sobol' points over the bounds are evaluated on all threads. Chains start at the best
 * points. A point is a row u of numbers in (0, 1), one for each parameter. Chains move in y = log(u/(1 - u)), so they cannot
 * cross a bound. Each worker has its own copies of the scenes. At the end predict.c predicts all observations from draws of
 * the chains. */

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "chains.h"
#include "check_study.h"
#include "core/runs/statistics.h"
#include "fitting.h"
#include "predict.h"
#include "surface.h"

#define POINTS            256
#define FIRST_STEP        0.3 /* standard deviation of the first steps, in y */
#define TEMPERING         0.7 /* factor of the surrogate: heavier tails, so that chains do not get stuck in them */
#define STEPS_MIN         250
#define STEPS_MAX         8000
#define BEST_NEAR_BOUND   0.02 /* share of the bounds: a value is at a bound if its best is this close, */
#define MEDIAN_NEAR_BOUND 0.05 /* or its median this close */

#define PARAMETERS CEDUO_CALIBRATION_MAX
#define CHAINS     CEDUO_CALIBRATION_CHAINS

/* ---- points ---- */

static double inverse_logit(double y)
{
    return 1 / (1 + exp(-y));
}

/* Keep the best point; on a tie the lexicographically smaller one, so that the order of evaluation does not matter. */
static void update_best(struct fitting *f, const double *u, double log_likelihood)
{
    size_t i = 0, n = f->def->parameters_count;
    pthread_mutex_lock(&f->lock);
    f->evaluations++;
    while (i < n && u[i] == f->best[i])
        i++;
    if (log_likelihood > f->best_log_likelihood || (log_likelihood == f->best_log_likelihood && i < n && u[i] < f->best[i]))
        memcpy(f->best, u, n * sizeof *u), f->best_log_likelihood = log_likelihood;
    pthread_mutex_unlock(&f->lock);
}

static double parameter_value(const struct fitting *f, size_t parameter, double u)
{
    const struct ceduo_input *input = &f->def->scenes[0].inputs[parameter];
    return input->lo + u * (input->hi - input->lo);
}

static void report_progress(struct fitting *f, enum ceduo_calibration_stage stage, double rhat, double effective_size)
{
    if (!f->def->progress || !ceduo_guard_try_enter(&f->talk))
        return;
    struct ceduo_calibration_state state = {.stage = stage, .rhat = rhat, .effective_size = effective_size};
    pthread_mutex_lock(&f->lock);
    state.evaluations = f->evaluations;
    state.log_likelihood = f->best_log_likelihood;
    for (size_t i = 0; i < f->def->parameters_count; i++)
        state.best[i] = parameter_value(f, i, f->best[i]);
    pthread_mutex_unlock(&f->lock);
    f->def->progress(f->def->context, &state);
    ceduo_guard_leave(&f->talk);
}

/* ---- one evaluation ---- */

enum ceduo_status ceduo_fitting_simulate(struct fitting *f, size_t worker, const double *u, bool all,
                                         struct ceduo_observation_fit *to)
{
    enum ceduo_status status = CEDUO_OK;
    for (size_t s = 0; s < f->def->scenes_count && status == CEDUO_OK; s++) {
        struct input_scene *copy = &f->workers[worker].copies[s];
        const struct ceduo_observer *observer = all ? f->scenes[s].all : f->scenes[s].fit;
        ceduo_inputs_set(copy, u);
        status = ceduo_observer_simulate(observer, &copy->scene, f->def->rocks, f->def->cancel, to);
        to += all ? f->def->scenes[s].observations_count : f->scenes[s].fit_count;
    }
    return status;
}

/* Set the log-likelihood of a point; -INFINITY if its scene is invalid. */
static enum ceduo_status evaluate(struct fitting *f, size_t worker, const double *u, double *log_likelihood)
{
    struct ceduo_observation_fit *to = f->workers[worker].fits;
    enum ceduo_status status = ceduo_fitting_simulate(f, worker, u, false, to);
    *log_likelihood = status == CEDUO_OK ? 0 : -INFINITY;
    if (status == CEDUO_NO_MEMORY || status == CEDUO_CANCELLED)
        return status;
    for (size_t i = 0; i < f->fit_count && status == CEDUO_OK; i++)
        *log_likelihood += to[i].log_likelihood;
    update_best(f, u, *log_likelihood);
    return CEDUO_OK;
}

/* ---- search ---- */

static int evaluate_point(void *context, size_t i, size_t worker)
{
    struct fitting *f = context;
    enum ceduo_status status = evaluate(f, worker, f->training + i * f->def->parameters_count, &f->training_values[i]);
    report_progress(f, CEDUO_CALIBRATION_STAGE_SEARCH, NAN, NAN);
    return (int)status;
}

/* Evaluate the points, and start the chains at the best; ties go to the first. */
static enum ceduo_status search(struct fitting *f)
{
    size_t d = f->def->parameters_count, best[CHAINS];
    enum ceduo_status status = ceduo_surface_points(f->def->seed, POINTS, d, f->training);
    if (status == CEDUO_OK) /* untaken: memory */
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){POINTS, f->def->threads, evaluate_point, f});
    gsl_sort_largest_index(best, CHAINS, f->training_values, 1, POINTS);
    for (size_t k = 0; k < CHAINS * d; k++) {
        double u = f->training[best[k / d] * d + k % d];
        f->starts[k] = log(u / (1 - u));
    }
    return status;
}

/* ---- chains ---- */

/* Set the point u of y. Return the log-prior in y: uniform within the bounds has the density u(1 - u) there. */
static double set_point(const struct fitting *f, const double *y, double *u)
{
    double prior = 0;
    for (size_t i = 0; i < f->def->parameters_count; i++) {
        u[i] = inverse_logit(y[i]);
        prior += log(u[i]) + log1p(-u[i]);
    }
    return prior;
}

static enum ceduo_status log_posterior(void *context, size_t chain, const double *y, double *log_density)
{
    struct fitting *f = context;
    double u[PARAMETERS] = {0}, prior = set_point(f, y, u);
    *log_density = -INFINITY;
    if (!isfinite(prior))
        return CEDUO_OK;
    enum ceduo_status status = evaluate(f, chain, u, log_density);
    *log_density += prior;
    return status;
}

static double tempered_surrogate(void *context, const double *y)
{
    const struct fitting *f = context;
    double u[PARAMETERS] = {0}, prior = set_point(f, y, u);
    return isfinite(prior) ? TEMPERING * ceduo_surrogate_evaluate(&f->surrogate, u) + prior : -INFINITY;
}

/* Add the new proposals of the chains to the training points, and retrain the surrogate. */
static enum ceduo_status train_surrogate(void *context, const double *y, const double *log_densities, size_t n)
{
    struct fitting *f = context;
    size_t d = f->def->parameters_count, count = f->training_count, added = POINTS + n - count, capacity = f->training_capacity;
    f->training = ceduo_arena_grow(&f->memory, f->training, count, added, &capacity, d * sizeof *f->training);
    f->training_values =
        ceduo_arena_grow(&f->memory, f->training_values, count, added, &f->training_capacity, sizeof *f->training_values);
    if (f->memory.failed)
        return CEDUO_NO_MEMORY;
    for (size_t i = count - POINTS; i < n; i++) {
        double prior = set_point(f, y + i * d, f->training + (POINTS + i) * d);
        f->training_values[POINTS + i] = log_densities[i] - prior;
    }
    f->training_count = POINTS + n;
    return ceduo_surrogate_train(&f->surrogate, f->training, f->training_values, POINTS + n, f->def->cancel);
}

static bool report_round(void *context, size_t steps, double rhat, double effective_size)
{
    (void)steps;
    report_progress(context, CEDUO_CALIBRATION_STAGE_CHAINS, rhat, effective_size);
    return true;
}

static enum ceduo_status run_chains(struct fitting *f, struct chains *chains)
{
    struct chains_def def = {.dimensions = f->def->parameters_count,
                             .chains = CHAINS,
                             .starts = f->starts,
                             .first_step = FIRST_STEP,
                             .seed = f->def->seed,
                             .threads = f->def->threads,
                             .steps_min = STEPS_MIN,
                             .steps_max = f->def->steps_max > 0 ? f->def->steps_max : STEPS_MAX,
                             .rhat_max = CEDUO_RHAT_MAX,
                             .effective_min = CEDUO_EFFECTIVE_MIN,
                             .stop_early = f->def->steps_max == 0,
                             .density = log_posterior,
                             .surrogate = tempered_surrogate,
                             .train = train_surrogate,
                             .cancel = f->def->cancel,
                             .round = report_round,
                             .context = f};
    return ceduo_chains_run(&def, chains);
}

/* ---- reading ---- */

static void summarize_parameter(const struct fitting *f, const struct ceduo_calibration *a, double *sorted, size_t i,
                                struct ceduo_fitted *p)
{
    const struct ceduo_input *input = &f->def->scenes[0].inputs[i];
    double width = input->hi - input->lo, u = f->best[i];
    size_t n = a->draws_count;
    *p = (struct ceduo_fitted){input->lo, input->hi, parameter_value(f, i, u), NAN, NAN, NAN, false, false};
    if (n == 0)
        return;
    for (size_t k = 0; k < n; k++)
        sorted[k] = a->draws[k * a->parameters_count + i];
    gsl_sort(sorted, 1, n);
    p->p2_5 = ceduo_quantile(sorted, n, 0.025);
    p->p50 = ceduo_quantile(sorted, n, 0.5);
    p->p97_5 = ceduo_quantile(sorted, n, 0.975);
    p->identified = p->p97_5 - p->p2_5 <= CEDUO_IDENTIFIED_WIDTH_MAX * width;
    double median = (p->p50 - input->lo) / width;
    p->at_bound = p->identified && (fmin(u, 1 - u) < BEST_NEAR_BOUND || fmin(median, 1 - median) < MEDIAN_NEAR_BOUND);
}

static bool read_draws(const struct fitting *f, const struct chains *chains, struct ceduo_calibration *a)
{
    size_t d = a->parameters_count, n = chains->steps > 2 * CEDUO_CHAINS_ROUND ? ceduo_chains_draws(chains) : 0;
    double *sorted = malloc((n + 1) * sizeof *sorted);
    a->draws = malloc((n * d + 1) * sizeof *a->draws);
    a->draws_count = a->draws ? n : 0;
    for (size_t k = 0; k < a->draws_count; k++)
        for (size_t i = 0; i < d; i++)
            a->draws[k * d + i] = parameter_value(f, i, inverse_logit(ceduo_chains_draw(chains, k)[i]));
    for (size_t i = 0; i < d && sorted; i++)
        summarize_parameter(f, a, sorted, i, &a->parameters[i]);
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k < d; k++)
            a->correlation[i][k] = i == k                ? 1
                                   : a->draws_count == 0 ? NAN
                                                         : gsl_stats_correlation(a->draws + i, d, a->draws + k, d, n);
    bool good = sorted && a->draws;
    free(sorted);
    return good;
}

/* ---- identifiability ---- */

#define COLLINEAR 0.9 /* correlation above which the observations identify only a combination of two values */

static double relative_width(const struct ceduo_fitted *p)
{
    return (p->p97_5 - p->p2_5) / (p->hi - p->lo);
}

/* Return the parameter with the wider range in the most correlated pair that is not selected; SIZE_MAX: no collinear pair. */
static size_t find_collinear(const struct ceduo_calibration *a, const bool *selected)
{
    size_t worse = SIZE_MAX;
    double max = COLLINEAR;
    for (size_t i = 0; i < a->parameters_count; i++)
        for (size_t k = 0; k < i; k++)
            if (!selected[i] && !selected[k] && fabs(a->correlation[i][k]) > max) {
                max = fabs(a->correlation[i][k]);
                worse = relative_width(&a->parameters[i]) > relative_width(&a->parameters[k]) ? i : k;
            }
    return worse;
}

size_t ceduo_calibration_unidentified(const struct ceduo_calibration *a, bool selected[CEDUO_CALIBRATION_MAX])
{
    size_t max = a->parameters_count - 1, n = 0;
    for (size_t i = 0; i <= max; i++) {
        selected[i] = n < max && a->draws_count > 0 && !a->parameters[i].identified;
        n += selected[i];
    }
    for (size_t i; (i = find_collinear(a, selected)) != SIZE_MAX; n++) /* the other one of the pair stays */
        selected[i] = true;
    if (n > 0 || max == 0 || a->converged || a->draws_count == 0)
        return n;
    size_t widest = 0; /* the chains have not converged: select the value with the widest range within its bounds */
    for (size_t i = 1; i <= max; i++)
        widest = relative_width(&a->parameters[i]) > relative_width(&a->parameters[widest]) ? i : widest;
    selected[widest] = true;
    return 1;
}

#define SHAPE_TOLERANCE 0.1 /* share of the mean axis; rocks whose axes differ by less have one shape; assumed */

/* A shape is the axes over their mean, the shortest first. */
bool ceduo_calibration_identifies_mu(const struct ceduo_calibration_scene *scenes, size_t n)
{
    double first[3];
    bool has_first = false;
    for (size_t s = 0; s < n; s++)
        for (size_t i = 0; i < scenes[s].observations_count; i++) {
            const struct ceduo_observation *observation = &scenes[s].observations[i];
            if (observation->use != CEDUO_OBSERVED_USE_FIT || scenes[s].scene->simulation.law != CEDUO_LAW_ARM)
                continue;
            const struct ceduo_rock rock = ceduo_rock_mean(observation->rock ? observation->rock : &scenes[s].scene->rock);
            const double *a = rock.axes, sum = a[0] + a[1] + a[2];
            double min = fmin(a[0], fmin(a[1], a[2])), max = fmax(a[0], fmax(a[1], a[2]));
            const double shape[3] = {3 * min / sum, 3 * (sum - min - max) / sum, 3 * max / sum};
            for (size_t k = 0; has_first && k < 3; k++)
                if (fabs(first[k] - shape[k]) > SHAPE_TOLERANCE)
                    return true;
            if (!has_first)
                memcpy(first, shape, sizeof first);
            has_first = true;
        }
    return false;
}

/* ---- calibration ---- */

static enum ceduo_status open_fitting(struct fitting *f, const struct ceduo_calibration_def *def)
{
    enum ceduo_status status = CEDUO_OK;
    size_t n = def->parameters_count;
    *f = (struct fitting){.def = def, .best_log_likelihood = -INFINITY, .surrogate = ceduo_surrogate_begin(n)};
    f->workers_count = def->threads > CHAINS ? def->threads : CHAINS;
    pthread_mutex_init(&f->lock, NULL);
    f->training = ceduo_arena_alloc(&f->memory, POINTS * n * sizeof *f->training);
    f->training_values = ceduo_arena_alloc(&f->memory, POINTS * sizeof *f->training_values);
    f->training_count = f->training_capacity = POINTS;
    f->scenes = ceduo_arena_alloc(&f->memory, def->scenes_count * sizeof *f->scenes);
    f->workers = ceduo_arena_alloc(&f->memory, f->workers_count * sizeof *f->workers);
    for (size_t s = 0; s < def->scenes_count && !f->memory.failed && status == CEDUO_OK; s++) {
        const struct ceduo_calibration_scene *from = &def->scenes[s];
        struct fitting_scene *to = &f->scenes[s];
        struct ceduo_observation *fitted = ceduo_arena_alloc(&f->memory, (from->observations_count + 1) * sizeof *fitted);
        for (size_t i = 0; fitted && i < from->observations_count; i++)
            if (from->observations[i].use == CEDUO_OBSERVED_USE_FIT)
                fitted[to->fit_count++] = from->observations[i];
        f->fit_count += to->fit_count;
        f->all_count += from->observations_count;
        status = ceduo_observer_create(fitted, to->fit_count, &to->fit);
        if (status == CEDUO_OK)
            status = ceduo_observer_create(from->observations, from->observations_count, &to->all);
    }
    for (size_t w = 0; w < f->workers_count && !f->memory.failed && status == CEDUO_OK; w++) {
        struct fitting_worker *to = &f->workers[w];
        to->copies = ceduo_arena_alloc(&f->memory, def->scenes_count * sizeof *to->copies);
        to->fits = ceduo_arena_alloc(&f->memory, (f->all_count + 1) * sizeof *to->fits);
        for (size_t s = 0; s < def->scenes_count && !f->memory.failed && status == CEDUO_OK; s++)
            status = ceduo_inputs_open(&to->copies[s], def->scenes[s].scene, def->scenes[s].inputs, n);
    }
    return f->memory.failed ? CEDUO_NO_MEMORY : status;
}

static void close_fitting(struct fitting *f)
{
    for (size_t s = 0; f->scenes && s < f->def->scenes_count; s++) {
        ceduo_observer_free(f->scenes[s].fit);
        ceduo_observer_free(f->scenes[s].all);
        for (size_t w = 0; f->workers && w < f->workers_count && f->workers[w].copies; w++)
            ceduo_inputs_release(&f->workers[w].copies[s]);
    }
    ceduo_surrogate_free(&f->surrogate);
    ceduo_arena_free(&f->memory);
    pthread_mutex_destroy(&f->lock);
}

struct ceduo_calibration_def ceduo_calibration_def_default(void)
{
    return (struct ceduo_calibration_def){
        .size = sizeof(struct ceduo_calibration_def), .rocks = CEDUO_CALIBRATION_ROCKS, .seed = 1, .threads = 1};
}

enum ceduo_status ceduo_calibrate(const struct ceduo_calibration_def *def, struct ceduo_calibration *a)
{
    GSL_RETURNS_ERRORS;
    struct fitting f;
    struct chains chains = {.rhat = NAN, .effective_size = NAN};
    *a = (struct ceduo_calibration){0};
    enum ceduo_status status = ceduo_check_calibration_def(def);
    if (status != CEDUO_OK)
        return status;
    a->parameters_count = def->parameters_count;
    status = open_fitting(&f, def);
    status = status == CEDUO_OK ? search(&f) : status;
    status = status == CEDUO_OK ? run_chains(&f, &chains) : status;
    if (status == CEDUO_OK && !read_draws(&f, &chains, a))
        status = CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = ceduo_fitting_predict(&f, a);
    if (status == CEDUO_OK && ceduo_cancelled(def->cancel)) /* untaken: race */
        status = CEDUO_CANCELLED;
    a->evaluations = f.evaluations;
    a->rhat = chains.rhat;
    a->effective_size = chains.effective_size;
    a->converged = chains.converged;
    ceduo_chains_release(&chains);
    close_fitting(&f);
    if (status != CEDUO_OK)
        ceduo_calibration_release(a);
    return status;
}

void ceduo_calibration_release(struct ceduo_calibration *a)
{
    free(a->predicted);
    free(a->draws);
    *a = (struct ceduo_calibration){0};
}
