/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fits values of scenes to observations, in two steps: Sobol' points over the bounds, on all threads; chains from the best of
 * them. A place is a row u of numbers in 0…1, one for each parameter. Chains walk in y = log(u/(1 - u)), so that they cross no
 * bound. Each worker has its own copies of the scenes. At the end draws of the chains are computed once more, to predict all
 * observations (predict.c). */
#include "ceduo/calibrate.h"

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "ceduo/statistics.h"
#include "chains.h"
#include "check_study.h"
#include "fitting.h"

#define POINTS     256
#define FIRST_STEP 0.3 /* of a chain */
/* times the guess: its tails are to reach farther than those of the density, or chains get stuck there */
#define FLATTER    0.7
#define STEPS_MIN  250
#define STEPS_MAX  8000
#define NEAR_BOUND 0.02 /* of the bounds: a best value there lies at a bound, */
#define HALF_THERE 0.05 /* or where half of the draws do */

#define PARAMETERS CEDUO_CALIBRATION_MAX
#define CHAINS     CEDUO_CALIBRATION_CHAINS

/* ---- places ---- */

static double unit(double y)
{
    return 1 / (1 + exp(-y));
}

/* Of two places that are as good the smaller one is better, so that it does not matter which was looked at first. */
static void note_best(struct fitting *f, const double *u, double log_likelihood)
{
    size_t i = 0, n = f->def->parameters_count;
    pthread_mutex_lock(&f->lock);
    f->evaluations++;
    while (i < n && u[i] == f->best[i])
        i++;
    if (log_likelihood > f->most || (log_likelihood == f->most && i < n && u[i] < f->best[i]))
        memcpy(f->best, u, n * sizeof *u), f->most = log_likelihood;
    pthread_mutex_unlock(&f->lock);
}

static double value_of(const struct fitting *f, size_t parameter, double u)
{
    const struct ceduo_input *input = &f->def->scenes[0].inputs[parameter];
    return input->lo + u * (input->hi - input->lo);
}

static void tell(struct fitting *f, enum ceduo_calibration_stage stage, double rhat, double effective_size)
{
    if (!f->def->progress || !ceduo_talk_begin(&f->talk))
        return;
    struct ceduo_calibration_state state = {.stage = stage, .rhat = rhat, .effective_size = effective_size};
    pthread_mutex_lock(&f->lock);
    state.evaluations = f->evaluations;
    state.log_likelihood = f->most;
    for (size_t i = 0; i < f->def->parameters_count; i++)
        state.best[i] = value_of(f, i, f->best[i]);
    pthread_mutex_unlock(&f->lock);
    f->def->progress(f->def->context, &state);
    ceduo_talk_end(&f->talk);
}

/* ---- one evaluation ---- */

enum ceduo_status ceduo_fitting_look(struct fitting *f, size_t worker, const double *u, bool all,
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

/* The likelihood of a place; a scene that does not fit together cannot be what was. */
static enum ceduo_status evaluate(struct fitting *f, size_t worker, const double *u, double *log_likelihood)
{
    struct ceduo_observation_fit *to = f->workers[worker].counterparts;
    enum ceduo_status status = ceduo_fitting_look(f, worker, u, false, to);
    *log_likelihood = status == CEDUO_OK ? 0 : -INFINITY;
    if (status == CEDUO_NO_MEMORY || status == CEDUO_CANCELLED)
        return status;
    for (size_t i = 0; i < f->fit_count && status == CEDUO_OK; i++)
        *log_likelihood += to[i].log_likelihood;
    note_best(f, u, *log_likelihood);
    return CEDUO_OK;
}

/* ---- search ---- */

static int look_at_point(void *context, size_t i, size_t worker)
{
    struct fitting *f = context;
    enum ceduo_status status = evaluate(f, worker, f->known + i * f->def->parameters_count, &f->known_values[i]);
    tell(f, CEDUO_SEARCH, NAN, NAN);
    return (int)status;
}

/* Chains start from the best points, of equal ones from the first. */
static enum ceduo_status search(struct fitting *f)
{
    size_t d = f->def->parameters_count, best[CHAINS];
    enum ceduo_status status = ceduo_surface_points(f->def->seed, POINTS, d, f->known);
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){POINTS, f->def->threads, look_at_point, f});
    gsl_sort_largest_index(best, CHAINS, f->known_values, 1, POINTS);
    for (size_t k = 0; k < CHAINS * d; k++) {
        double u = f->known[best[k / d] * d + k % d];
        f->starts[k] = log(u / (1 - u));
    }
    return status;
}

/* ---- chains ---- */

/* The place u of y, and the logarithm of its density before: every value within the bounds is as likely, which in y is
 * u(1 - u). */
static double prior_at(const struct fitting *f, const double *y, double *u)
{
    double prior = 0;
    for (size_t i = 0; i < f->def->parameters_count; i++) {
        u[i] = unit(y[i]);
        prior += log(u[i]) + log1p(-u[i]);
    }
    return prior;
}

static enum ceduo_status density(void *context, size_t chain, const double *y, double *log_density)
{
    struct fitting *f = context;
    double u[PARAMETERS] = {0}, prior = prior_at(f, y, u);
    *log_density = -INFINITY;
    if (!isfinite(prior))
        return CEDUO_OK;
    enum ceduo_status status = evaluate(f, chain, u, log_density);
    *log_density += prior;
    return status;
}

static double guess_at(void *context, const double *y)
{
    const struct fitting *f = context;
    double u[PARAMETERS] = {0}, prior = prior_at(f, y, u);
    return isfinite(prior) ? FLATTER * ceduo_guess_at(&f->guess, u) + prior : -INFINITY;
}

/* What the chains have tried since is added to what is known. */
static enum ceduo_status learn(void *context, const double *y, const double *log_densities, size_t n)
{
    struct fitting *f = context;
    size_t d = f->def->parameters_count, known = f->known_count, more = POINTS + n - known, room = f->known_room;
    f->known = ceduo_arena_grow(&f->memory, f->known, known, more, &room, d * sizeof *f->known);
    f->known_values = ceduo_arena_grow(&f->memory, f->known_values, known, more, &f->known_room, sizeof *f->known_values);
    if (f->memory.failed)
        return CEDUO_NO_MEMORY;
    for (size_t i = known - POINTS; i < n; i++) {
        double prior = prior_at(f, y + i * d, f->known + (POINTS + i) * d);
        f->known_values[POINTS + i] = log_densities[i] - prior;
    }
    f->known_count = POINTS + n;
    return ceduo_guess_learn(&f->guess, f->known, f->known_values, POINTS + n, f->def->cancel);
}

static bool on_round(void *context, size_t steps, double rhat, double effective_size)
{
    (void)steps;
    tell(context, CEDUO_CHAINS, rhat, effective_size);
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
                             .steps_least = STEPS_MIN,
                             .steps_most = f->def->steps_most > 0 ? f->def->steps_most : STEPS_MAX,
                             .rhat_most = CEDUO_RHAT_MAX,
                             .effective_least = CEDUO_EFFECTIVE_MIN,
                             .hopeless = f->def->steps_most == 0,
                             .density = density,
                             .guess = guess_at,
                             .learn = learn,
                             .cancel = f->def->cancel,
                             .round = on_round,
                             .context = f};
    return ceduo_chains_run(&def, chains);
}

/* ---- reading ---- */

static void read_parameter(const struct fitting *f, const struct ceduo_calibration *a, double *sorted, size_t i,
                           struct ceduo_fitted *p)
{
    const struct ceduo_input *input = &f->def->scenes[0].inputs[i];
    double width = input->hi - input->lo, u = f->best[i];
    size_t n = a->draws_count;
    *p = (struct ceduo_fitted){input->lo, input->hi, value_of(f, i, u), NAN, NAN, NAN, false, false};
    if (n == 0)
        return;
    for (size_t k = 0; k < n; k++)
        sorted[k] = a->draws[k * a->parameters_count + i];
    gsl_sort(sorted, 1, n);
    p->p2_5 = ceduo_quantile(sorted, n, 0.025);
    p->p50 = ceduo_quantile(sorted, n, 0.5);
    p->p97_5 = ceduo_quantile(sorted, n, 0.975);
    p->determined = p->p97_5 - p->p2_5 <= CEDUO_NOT_DETERMINED * width;
    double middle = (p->p50 - input->lo) / width;
    p->at_bound = p->determined && (fmin(u, 1 - u) < NEAR_BOUND || fmin(middle, 1 - middle) < HALF_THERE);
}

static bool read_draws(const struct fitting *f, const struct chains *chains, struct ceduo_calibration *a)
{
    size_t d = a->parameters_count, n = chains->steps > 2 * CEDUO_CHAINS_ROUND ? ceduo_chains_draws(chains) : 0;
    double *sorted = malloc((n + 1) * sizeof *sorted);
    a->draws = malloc((n * d + 1) * sizeof *a->draws);
    a->draws_count = a->draws ? n : 0;
    for (size_t k = 0; k < a->draws_count; k++)
        for (size_t i = 0; i < d; i++)
            a->draws[k * d + i] = value_of(f, i, unit(ceduo_chains_draw(chains, k)[i]));
    for (size_t i = 0; i < d && sorted; i++)
        read_parameter(f, a, sorted, i, &a->parameters[i]);
    for (size_t i = 0; i < d; i++)
        for (size_t k = 0; k < d; k++)
            a->correlation[i][k] = i == k                ? 1
                                   : a->draws_count == 0 ? NAN
                                                         : gsl_stats_correlation(a->draws + i, d, a->draws + k, d, n);
    bool good = sorted && a->draws;
    free(sorted);
    return good;
}

/* ---- what the observations do not hold ---- */

#define TOGETHER 0.9 /* correlation of two values of which only both are known, not each */

/* The one that is known worse of two that are known only together; all of those kept: SIZE_MAX. */
static size_t worse_of_a_pair(const struct ceduo_calibration *a, const bool *loose)
{
    size_t worse = SIZE_MAX;
    double most = TOGETHER;
    for (size_t i = 0; i < a->parameters_count; i++)
        for (size_t k = 0; k < i; k++)
            if (!loose[i] && !loose[k] && fabs(a->correlation[i][k]) > most) {
                const struct ceduo_fitted *p = &a->parameters[i], *q = &a->parameters[k];
                most = fabs(a->correlation[i][k]);
                worse = (p->p97_5 - p->p2_5) / (p->hi - p->lo) > (q->p97_5 - q->p2_5) / (q->hi - q->lo) ? i : k;
            }
    return worse;
}

size_t ceduo_calibration_unidentified(const struct ceduo_calibration *a, bool loose[CEDUO_CALIBRATION_MAX])
{
    size_t most = a->parameters_count - 1, n = 0;
    for (size_t i = 0; i <= most; i++) {
        loose[i] = n < most && a->draws_count > 0 && !a->parameters[i].determined;
        n += loose[i];
    }
    for (size_t i; (i = worse_of_a_pair(a, loose)) != SIZE_MAX; n++) /* one of them stays */
        loose[i] = true;
    return n;
}

#define SHAPES_ALIKE 0.1 /* of the mean axis: rocks whose axes differ by no more are of one shape; assumed */

/* A shape is the rock's axes over their mean, the shortest first. */
bool ceduo_calibration_identifies_mu(const struct ceduo_calibration_scene *scenes, size_t n)
{
    double first[3];
    bool known = false;
    for (size_t s = 0; s < n; s++)
        for (size_t i = 0; i < scenes[s].observations_count; i++) {
            const struct ceduo_observation *seen = &scenes[s].observations[i];
            if (seen->use != CEDUO_OBSERVED_FIT || scenes[s].scene->simulation.law != CEDUO_LAW_ARM)
                continue;
            const struct ceduo_rock rock = ceduo_rock_mean(seen->rock ? seen->rock : &scenes[s].scene->rock);
            const double *a = rock.axes, sum = a[0] + a[1] + a[2];
            double least = fmin(a[0], fmin(a[1], a[2])), most = fmax(a[0], fmax(a[1], a[2]));
            const double shape[3] = {3 * least / sum, 3 * (sum - least - most) / sum, 3 * most / sum};
            for (size_t k = 0; known && k < 3; k++)
                if (fabs(first[k] - shape[k]) > SHAPES_ALIKE)
                    return true;
            if (!known)
                memcpy(first, shape, sizeof first);
            known = true;
        }
    return false;
}

/* ---- all of it ---- */

static enum ceduo_status open_fitting(struct fitting *f, const struct ceduo_calibration_def *def)
{
    enum ceduo_status status = CEDUO_OK;
    size_t n = def->parameters_count;
    *f = (struct fitting){.def = def, .most = -INFINITY, .guess = ceduo_guess_begin(n)};
    f->workers_count = def->threads > CHAINS ? def->threads : CHAINS;
    pthread_mutex_init(&f->lock, NULL);
    f->known = ceduo_arena_alloc(&f->memory, POINTS * n * sizeof *f->known);
    f->known_values = ceduo_arena_alloc(&f->memory, POINTS * sizeof *f->known_values);
    f->known_count = f->known_room = POINTS;
    f->scenes = ceduo_arena_alloc(&f->memory, def->scenes_count * sizeof *f->scenes);
    f->workers = ceduo_arena_alloc(&f->memory, f->workers_count * sizeof *f->workers);
    for (size_t s = 0; s < def->scenes_count && !f->memory.failed && status == CEDUO_OK; s++) {
        const struct ceduo_calibration_scene *from = &def->scenes[s];
        struct fitting_scene *to = &f->scenes[s];
        struct ceduo_observation *fitted = ceduo_arena_alloc(&f->memory, (from->observations_count + 1) * sizeof *fitted);
        for (size_t i = 0; fitted && i < from->observations_count; i++)
            if (from->observations[i].use == CEDUO_OBSERVED_FIT)
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
        to->counterparts = ceduo_arena_alloc(&f->memory, (f->all_count + 1) * sizeof *to->counterparts);
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
    ceduo_guess_release(&f->guess);
    ceduo_arena_free(&f->memory);
    pthread_mutex_destroy(&f->lock);
}

struct ceduo_calibration_def ceduo_calibration_def_default(void)
{
    return (struct ceduo_calibration_def){.rocks = CEDUO_CALIBRATION_ROCKS, .seed = 1, .threads = 1};
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
    a->settled = chains.settled;
    ceduo_chains_release(&chains);
    close_fitting(&f);
    if (status != CEDUO_OK)
        ceduo_calibration_free(a);
    return status;
}

void ceduo_calibration_free(struct ceduo_calibration *a)
{
    free(a->predicted);
    free(a->draws);
    *a = (struct ceduo_calibration){0};
}
