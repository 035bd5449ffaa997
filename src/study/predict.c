/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a fit says of all that was seen. For draws from what is not refuted, new samples as large as those seen are drawn, with
 * the error of the simulated rocks; how often they lie as far from the simulated rocks as what was seen, is p. The rocks are
 * others than those of the fit: it prefers values whose rocks happen to do what was seen. */
#include <gsl/gsl_randist.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdlib.h>

#include "base/gsl_errors.h"
#include "base/parallel.h"
#include "base/random.h"
#include "ceduo/statistics.h"
#include "check_study.h"
#include "fitting.h"
#include "sequence.h"

#define SAMPLES     20   /* for each draw; not more than CEDUO_SOME_VALUES */
#define SINGLE_MIN  400  /* values that tell 95 % of them */
#define SAMPLES_ONE 2000 /* of a scene as it is */

static int look_at_draw(void *context, size_t i, size_t worker)
{
    struct fitting *f = context;
    struct ceduo_observation_fit *to = f->drawn + i * f->all_count;
    enum ceduo_status status = ceduo_fitting_simulate(f, worker, f->draws + i * f->def->parameters_count, true, to);
    return (int)(status == CEDUO_OK || status == CEDUO_CANCELLED ? status : CEDUO_NO_MEMORY);
}

/* ---- samples ---- */

/* A new count: the share as the simulated rocks leave it open (a beta law), then as many as were released. Returns its deviance. */
static double sample_count(const struct ceduo_observation_fit *c, gsl_rng *random, double *value)
{
    double share = gsl_ran_beta(random, c->count[0] + 0.5, c->count[1] + 0.5), n = c->observed[0] + c->observed[1];
    double passed = gsl_ran_binomial(random, share, (unsigned)n), seen[2] = {passed, n - passed};
    *value = passed;
    return ceduo_classes_deviance(seen, c->count, 2);
}

/* Shares of the true law between bounds that a sample's own values make, halfway between two of them: gaps of uniform values are
 * exponential ones over their sum. `n`: values in each class. */
static void share_by_gaps(const double *n, size_t classes, gsl_rng *random, double *share)
{
    double sum = 0, half = 0;
    for (size_t i = 0; i < classes; i++) {
        bool inner = i > 0 && i + 1 < classes;
        double whole = n[i] - (inner ? 1 : 0);
        share[i] = half + (whole > 0 ? gsl_ran_gamma(random, whole, 1) : 0);
        half = i + 1 < classes ? gsl_ran_exponential(random, 1) / 2 : 0;
        share[i] += half;
        sum += share[i];
    }
    for (size_t i = 0; i < classes; i++)
        share[i] /= sum;
}

/* The deviance of a new list, as those who saw it compare it: its classes are between its own quantiles, and as many simulated
 * rocks fall into them. Its values are so many as those seen; where it is known how many were released, the simulated rocks say
 * how many of them have one. Bounds that follow from the sample make its deviance smaller than that of fixed classes. */
static double sample_list(const struct ceduo_observation_fit *c, bool rest, gsl_rng *random)
{
    size_t lists = c->classes - rest;
    double seen[CEDUO_CLASSES_MAX], share[CEDUO_CLASSES_MAX], simulated[CEDUO_CLASSES_MAX], rocks = 0, n = 0, have = 1;
    unsigned count[CEDUO_CLASSES_MAX];
    for (size_t i = 0; i < c->classes; i++) {
        rocks += c->count[i];
        n += c->observed[i];
        seen[i] = c->observed[i];
    }
    if (rest) {
        double missing = c->count[lists], without = n - c->observed[lists], before = 0, up_to = 0, with;
        have = gsl_ran_beta(random, rocks - missing + 0.5, missing + 0.5);
        with = gsl_ran_binomial(random, have, (unsigned)n);
        for (size_t i = 0; i < lists; i++, before = up_to) {
            up_to += c->observed[i];
            seen[i] = round(up_to * with / without) - round(before * with / without);
        }
        seen[lists] = n - with;
        share[lists] = 1 - have;
    }
    share_by_gaps(seen, lists, random, share);
    for (size_t i = 0; i < lists; i++)
        share[i] *= have;
    gsl_ran_multinomial(random, c->classes, (unsigned)fmax(rocks, CEDUO_CLASS_ROCKS_MIN * (double)c->classes), share, count);
    for (size_t i = 0; i < c->classes; i++)
        simulated[i] = count[i];
    return ceduo_classes_deviance(seen, simulated, c->classes);
}

static double sample_normal(double mean, double variance, gsl_rng *random, double *value)
{
    double z = gsl_ran_ugaussian(random);
    *value = mean + sqrt(variance) * z;
    return z * z;
}

/* A new sample; its deviance, and what its mean or count would be. */
static double sample(const struct ceduo_observation *o, const struct ceduo_observation_fit *c, gsl_rng *random, double *value)
{
    double ignored, deviance;
    bool rest = o->kind == CEDUO_OBSERVED_STOPS && o->released > 0;
    double spread = c->sd * c->sd * (1 / (double)(o->n > 0 ? o->n : 1) + 1 / (double)c->rocks);
    if (o->kind == CEDUO_OBSERVED_PASSED)
        return sample_count(c, random, value);
    if (c->classes > 0) {
        deviance = sample_list(c, rest, random);
        sample_normal(c->mean, spread, random, value);
    } else {
        deviance = sample_normal(c->mean, c->variance, random, value);
    }
    return isnan(c->scars) ? deviance : deviance + sample_normal(0, 1, random, &ignored);
}

/* ---- reading ---- */

/* What simulated rocks say of one observation, draw by draw. */
struct drawn {
    const struct ceduo_observation_fit *first;
    size_t stride, draws, samples; /* samples: of each draw */
};

/* `values`: room for all samples. */
static void read_one(const struct drawn *d, const struct ceduo_observation *o, gsl_rng *random, double *values,
                     struct ceduo_predicted *to)
{
    size_t n = 0;
    double farther = 0;
    to->observed = o->kind == CEDUO_OBSERVED_PASSED ? (double)o->count : to->at_best.observed_mean;
    to->p_value = to->lo = to->hi = NAN;
    for (size_t i = 0; i < d->draws; i++) {
        const struct ceduo_observation_fit *c = &d->first[i * d->stride];
        for (size_t k = 0; k < d->samples; k++) {
            double value, deviance = sample(o, c, random, &value);
            farther += deviance >= c->deviance;
            if (!isnan(value))
                values[n++] = value;
        }
    }
    if (d->draws == 0 || n == 0)
        return;
    gsl_sort(values, 1, n);
    to->p_value = farther / (double)(d->draws * d->samples);
    to->lo = ceduo_quantile(values, n, 0.025);
    to->hi = ceduo_quantile(values, n, 0.975);
    to->inside = to->observed >= to->lo && to->observed <= to->hi;
}

/* The range of single values, of all draws alike: what is not known of the ground and how rocks differ, together. `values`:
 * room for those of all draws. */
static void read_single(const struct drawn *d, const struct ceduo_observation *o, double *values, struct ceduo_predicted *to)
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

static void read_all(struct fitting *f, size_t draws, gsl_rng *random, double *values, struct ceduo_calibration *a)
{
    size_t which = 0;
    for (size_t s = 0; s < f->def->scenes_count; s++)
        /* untaken: race */
        for (size_t i = 0; i < f->def->scenes[s].observations_count && !ceduo_cancelled(f->def->cancel); i++, which++) {
            const struct ceduo_observation *o = &f->def->scenes[s].observations[i];
            struct ceduo_predicted *to = &a->predicted[which];
            to->scene = s;
            to->observation = i;
            to->at_best = f->drawn[draws * f->all_count + which];
            struct drawn drawn = {f->drawn + which, f->all_count, draws, SAMPLES};
            read_one(&drawn, o, random, values, to);
            read_single(&drawn, o, values, to);
            bool misfit = to->p_value < CEDUO_MISFIT;
            a->misfit |= misfit && o->use == CEDUO_OBSERVED_FIT;
            a->check_failed |= misfit && o->use == CEDUO_OBSERVED_CHECK;
        }
}

enum ceduo_status ceduo_fitting_predict(struct fitting *f, struct ceduo_calibration *a)
{
    size_t d = a->parameters_count, most = CEDUO_CALIBRATION_DRAWS;
    size_t draws = a->draws_count < most ? a->draws_count : most;
    double *places = calloc((draws + 1) * d, sizeof *places), *values = calloc(draws * CEDUO_SOME_VALUES + 1, sizeof *values);
    struct sequence sequence;
    gsl_rng random = ceduo_sequence(&sequence, f->def->seed, CEDUO_CALIBRATION_CHAINS);
    f->drawn = calloc((draws + 1) * f->all_count + 1, sizeof *f->drawn);
    a->predicted = calloc(f->all_count + 1, sizeof *a->predicted);
    a->predicted_count = f->all_count;
    enum ceduo_status status = places && values && f->drawn && a->predicted ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t k = 0; k <= draws && status == CEDUO_OK; k++)
        for (size_t i = 0; i < d; i++) {
            const struct ceduo_input *input = &f->def->scenes[0].inputs[i];
            double value = k < draws ? a->draws[k * a->draws_count / draws * d + i] : 0;
            places[k * d + i] = k < draws ? (value - input->lo) / (input->hi - input->lo) : f->best[i];
        }
    f->draws = places;
    for (size_t w = 0; w < f->workers_count; w++)
        for (size_t s = 0; s < f->def->scenes_count; s++) {
            uint64_t *seed = &f->workers[w].copies[s].scene.simulation.seed;
            *seed = random_seed(*seed, VARIANT_PREDICTION, 0);
        }
    if (status == CEDUO_OK)
        status = (enum ceduo_status)ceduo_parallel(&(struct parallel){draws + 1, f->def->threads, look_at_draw, f});
    if (status == CEDUO_OK)
        read_all(f, draws, &random, values, a);
    free(places);
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
    struct ceduo_observation_fit *found = calloc(n + 1, sizeof *found);
    double *values = calloc(SAMPLES_ONE, sizeof *values);
    struct sequence sequence;
    gsl_rng random = ceduo_sequence(&sequence, scene->scene->simulation.seed, CEDUO_CALIBRATION_CHAINS);
    status = found && values ? CEDUO_OK : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = ceduo_observer_create(scene->observations, n, &observer);
    if (status == CEDUO_OK)
        status = ceduo_observer_simulate(observer, scene->scene, rocks, cancel, found);
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        to[i] = (struct ceduo_predicted){.observation = i, .at_best = found[i], .one_lo = NAN, .one_hi = NAN};
        read_one(&(struct drawn){&found[i], 0, 1, SAMPLES_ONE}, &scene->observations[i], &random, values, &to[i]);
    }
    ceduo_observer_free(observer);
    free(values);
    free(found);
    return status;
}
