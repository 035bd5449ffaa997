/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Posterior predictive checks. For each posterior draw new samples of the observed size are drawn, with the sampling error
 * of the simulated rocks. The p-value is the share of samples that deviate at least as much as the observation. Other rocks
 * than those of the fit are simulated, because the fit prefers values whose rocks match the observations by chance. */
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "base/random.h"
#include "check_study.h"
#include "core/runs/statistics.h"
#include "fitting.h"
#include "predict.h"
#include "sequence.h"

#define SAMPLES     20   /* per draw, at most CEDUO_SAMPLE_VALUES */
#define SINGLE_MIN  400  /* values that a 95 % interval of single rocks requires */
#define SAMPLES_ONE 2000 /* if there is no fit */

static int simulate_draw(void *context, size_t i, size_t worker)
{
    struct fitting *f = context;
    struct ceduo_observation_fit *to = f->drawn + i * f->all_count;
    enum ceduo_status status = ceduo_fitting_simulate(f, worker, f->draws + i * f->def->parameters_count, true, to);
    return (int)(status == CEDUO_OK || status == CEDUO_CANCELLED ? status : CEDUO_NO_MEMORY);
}

/* ---- samples ---- */

/* Draw a count: its share from the beta posterior of the simulated rocks, the count from the binomial of the released rocks.
 * Return its deviance. */
static double draw_count(const struct ceduo_observation_fit *c, gsl_rng *random, double *value)
{
    double share = gsl_ran_beta(random, c->count[0] + 0.5, c->count[1] + 0.5), n = c->observed[0] + c->observed[1];
    double passed = gsl_ran_binomial(random, share, (unsigned)n), observed[2] = {passed, n - passed};
    *value = passed;
    return ceduo_classes_deviance(observed, c->count, 2);
}

/* Draw the true shares of classes whose bounds lie halfway between two values of the sample itself. The gaps between uniform
 * values are exponential variates over their sum. `n`: values in each class. */
static void draw_shares(const double *n, size_t classes, gsl_rng *random, double *share)
{
    double sum = 0, half = 0;
    for (size_t i = 0; i < classes; i++) {
        bool inner = i > 0 && i + 1 < classes;
        double gaps = n[i] - (inner ? 1 : 0);
        share[i] = half + (gaps > 0 ? gsl_ran_gamma(random, gaps, 1) : 0);
        half = i + 1 < classes ? gsl_ran_exponential(random, 1) / 2 : 0;
        share[i] += half;
        sum += share[i];
    }
    for (size_t i = 0; i < classes; i++)
        share[i] /= sum;
}

/* Draw a list and return its deviance, binned at its own quantiles like the observation. This deviance is smaller than that
 * of fixed classes. It has the observed number of values. If the number released is given (`rest`), that number is binomial. */
static double draw_list(const struct ceduo_observation_fit *c, bool rest, gsl_rng *random)
{
    size_t value_classes = c->classes - rest;
    double observed[CEDUO_CLASSES_MAX], share[CEDUO_CLASSES_MAX], simulated[CEDUO_CLASSES_MAX], rocks = 0, n = 0,
                                                                                                valued_share = 1;
    unsigned count[CEDUO_CLASSES_MAX];
    for (size_t i = 0; i < c->classes; i++) {
        rocks += c->count[i];
        n += c->observed[i];
        observed[i] = c->observed[i];
    }
    if (rest) {
        double missing = c->count[value_classes], observed_valued = n - c->observed[value_classes], before = 0, up_to = 0,
               valued;
        valued_share = gsl_ran_beta(random, rocks - missing + 0.5, missing + 0.5);
        valued = gsl_ran_binomial(random, valued_share, (unsigned)n);
        for (size_t i = 0; i < value_classes; i++, before = up_to) {
            up_to += c->observed[i];
            observed[i] = round(up_to * valued / observed_valued) - round(before * valued / observed_valued);
        }
        observed[value_classes] = n - valued;
        share[value_classes] = 1 - valued_share;
    }
    draw_shares(observed, value_classes, random, share);
    for (size_t i = 0; i < value_classes; i++)
        share[i] *= valued_share;
    gsl_ran_multinomial(random, c->classes, (unsigned)fmax(rocks, CEDUO_CLASS_ROCKS_MIN * (double)c->classes), share, count);
    for (size_t i = 0; i < c->classes; i++)
        simulated[i] = count[i];
    return ceduo_classes_deviance(observed, simulated, c->classes);
}

static double draw_normal(double mean, double variance, gsl_rng *random, double *value)
{
    double z = gsl_ran_ugaussian(random);
    *value = mean + sqrt(variance) * z;
    return z * z;
}

/* Draw a sample. Sets its mean or count, and returns its deviance. */
static double draw_sample(const struct ceduo_observation *o, const struct ceduo_observation_fit *c, gsl_rng *random,
                          double *value)
{
    double ignored, deviance;
    bool rest = o->kind == CEDUO_OBSERVED_STOPS && o->released_count > 0;
    double spread = c->sd * c->sd * (1 / (double)(o->n > 0 ? o->n : 1) + 1 / (double)c->rocks);
    if (o->kind == CEDUO_OBSERVED_PASSED)
        return draw_count(c, random, value);
    if (c->classes > 0) {
        deviance = draw_list(c, rest, random);
        draw_normal(c->mean, spread, random, value);
    } else {
        deviance = draw_normal(c->mean, c->variance, random, value);
    }
    return isnan(c->scars) ? deviance : deviance + draw_normal(0, 1, random, &ignored);
}

/* ---- reading ---- */

/* One observation as simulated with each draw. */
struct drawn {
    const struct ceduo_observation_fit *first;
    size_t stride, draws, samples; /* samples: per draw */
};

/* `values`: buffer for all samples. */
static void predict_one(const struct drawn *d, const struct ceduo_observation *o, gsl_rng *random, double *values,
                        struct ceduo_predicted *to)
{
    size_t n = 0;
    double as_extreme = 0;
    to->observed = o->kind == CEDUO_OBSERVED_PASSED ? (double)o->count : to->at_best.observed_mean;
    to->p_value = to->lo = to->hi = NAN;
    for (size_t i = 0; i < d->draws; i++) {
        const struct ceduo_observation_fit *c = &d->first[i * d->stride];
        for (size_t k = 0; k < d->samples; k++) {
            double value, deviance = draw_sample(o, c, random, &value);
            as_extreme += deviance >= c->deviance;
            if (!isnan(value))
                values[n++] = value;
        }
    }
    if (d->draws == 0 || n == 0)
        return;
    gsl_sort(values, 1, n);
    to->p_value = as_extreme / (double)(d->draws * d->samples);
    to->lo = ceduo_quantile(values, n, 0.025);
    to->hi = ceduo_quantile(values, n, 0.975);
    to->inside = to->observed >= to->lo && to->observed <= to->hi;
}

/* Set the interval of single rocks, pooled over all draws: parameter uncertainty and variability of rocks. `values`: buffer
 * for the samples of all draws. */
static void predict_single(const struct drawn *d, const struct ceduo_observation *o, double *values, struct ceduo_predicted *to)
{
    size_t n = 0;
    to->one_lo = to->one_hi = NAN;
    to->one_inside = 0;
    for (size_t i = 0; i < d->draws && o->kind != CEDUO_OBSERVED_PASSED; i++) {
        const struct ceduo_observation_fit *c = &d->first[i * d->stride];
        for (size_t k = 0; k < c->sample_count; k++)
            values[n++] = c->sample[k];
    }
    if (n < SINGLE_MIN)
        return;
    gsl_sort(values, 1, n);
    to->one_lo = ceduo_quantile(values, n, 0.025);
    to->one_hi = ceduo_quantile(values, n, 0.975);
    for (size_t i = 0; i < o->n && o->values; i++)
        to->one_inside += o->values[i] >= to->one_lo && o->values[i] <= to->one_hi;
}

static void predict_all(struct fitting *f, size_t draws, gsl_rng *random, double *values, struct ceduo_calibration *a)
{
    size_t index = 0;
    for (size_t s = 0; s < f->def->scenes_count; s++)
        /* untaken: race */
        for (size_t i = 0; i < f->def->scenes[s].observations_count && !ceduo_cancelled(f->def->cancel); i++, index++) {
            const struct ceduo_observation *o = &f->def->scenes[s].observations[i];
            struct ceduo_predicted *to = &a->predicted[index];
            to->scene = s;
            to->observation = i;
            to->at_best = f->drawn[draws * f->all_count + index];
            struct drawn drawn = {f->drawn + index, f->all_count, draws, SAMPLES};
            predict_one(&drawn, o, random, values, to);
            predict_single(&drawn, o, values, to);
            bool misfit = to->p_value < CEDUO_MISFIT;
            a->misfit |= misfit && o->use == CEDUO_OBSERVED_USE_FIT;
            a->check_failed |= misfit && o->use == CEDUO_OBSERVED_USE_CHECK;
        }
}

enum ceduo_status ceduo_fitting_predict(struct fitting *f, struct ceduo_calibration *a)
{
    size_t d = a->parameters_count, max = CEDUO_CALIBRATION_DRAWS;
    size_t draws = a->draws_count < max ? a->draws_count : max;
    double *points = calloc((draws + 1) * d, sizeof *points), *values = calloc(draws * CEDUO_SAMPLE_VALUES + 1, sizeof *values);
    struct sequence sequence;
    gsl_rng random = ceduo_sequence_begin(&sequence, f->def->seed, CEDUO_CALIBRATION_CHAINS);
    f->drawn = calloc((draws + 1) * f->all_count + 1, sizeof *f->drawn);
    a->predicted = calloc(f->all_count + 1, sizeof *a->predicted);
    a->predicted_count = f->all_count;
    enum ceduo_status status = points && values && f->drawn && a->predicted ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t k = 0; k <= draws && status == CEDUO_OK; k++)
        for (size_t i = 0; i < d; i++) {
            const struct ceduo_input *input = &f->def->scenes[0].inputs[i];
            double value = k < draws ? a->draws[k * a->draws_count / draws * d + i] : 0;
            points[k * d + i] = k < draws ? (value - input->lo) / (input->hi - input->lo) : f->best[i];
        }
    f->draws = points;
    for (size_t w = 0; w < f->workers_count; w++)
        for (size_t s = 0; s < f->def->scenes_count; s++) {
            uint64_t *seed = &f->workers[w].copies[s].scene.simulation.seed;
            *seed = random_seed(*seed, VARIANT_PREDICTION, 0);
        }
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){draws + 1, f->def->threads, simulate_draw, f});
    if (status == CEDUO_OK)
        predict_all(f, draws, &random, values, a);
    free(points);
    free(values);
    free(f->drawn);
    return status;
}

/* ---- without a fit ---- */

enum ceduo_status ceduo_compare_with_observations(const struct ceduo_calibration_scene *scene, uint64_t rocks,
                                                  const atomic_bool *cancel, struct ceduo_predicted *to)
{
    GSL_RETURNS_ERRORS;
    size_t n = scene->observations_count;
    enum ceduo_status status = ceduo_scene_check(scene->scene, NULL);
    if (status == CEDUO_OK)
        status = ceduo_check_observations(scene->observations, n, scene->scene->options_count);
    if (status == CEDUO_OK && (rocks == 0 || rocks > CEDUO_ROCKS_MAX || scene->scene->options_count == 0))
        status = CEDUO_BAD_ARGUMENT;
    if (status != CEDUO_OK)
        return status;
    struct ceduo_observer *observer = NULL;
    struct ceduo_observation_fit *fits = calloc(n + 1, sizeof *fits);
    double *values = calloc(SAMPLES_ONE, sizeof *values);
    struct sequence sequence;
    gsl_rng random = ceduo_sequence_begin(&sequence, scene->scene->simulation.seed, CEDUO_CALIBRATION_CHAINS);
    status = fits && values ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = ceduo_observer_create(scene->observations, n, &observer);
    if (status == CEDUO_OK)
        status = ceduo_observer_simulate(observer, scene->scene, rocks, cancel, fits);
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        to[i] = (struct ceduo_predicted){.observation = i, .at_best = fits[i], .one_lo = NAN, .one_hi = NAN};
        predict_one(&(struct drawn){&fits[i], 0, 1, SAMPLES_ONE}, &scene->observations[i], &random, values, &to[i]);
    }
    ceduo_observer_free(observer);
    free(values);
    free(fits);
    return status;
}
