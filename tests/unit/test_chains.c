/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains on densities with known moments, and their diagnostics. */
#include "expect.h"
#include "local.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

#include "base/gsl_errors.h"
#include "physics/line_scene.h"
#include "study/chains.h"
#include "study/surrogate.h"

/* Normal distribution around (1, -2) with standard deviations 2 and 0.5 and correlation 0.9. */
#define RHO 0.9

static double log_normal(const double *x)
{
    double a = (x[0] - 1) / 2, b = (x[1] + 2) / 0.5;
    return -(a * a - 2 * RHO * a * b + b * b) / (2 * (1 - RHO * RHO));
}

static enum ceduo_status normal_density(void *context, size_t chain, const double *x, double *log_density)
{
    (void)chain;
    (void)context;
    *log_density = log_normal(x);
    return CEDUO_OK;
}

/* A wrong surrogate: too narrow, and shifted. */
static double wrong_surrogate(void *context, const double *x)
{
    (void)context;
    double moved[2] = {1 + 1.3 * (x[0] - 1.3), -2 + 1.3 * (x[1] + 1.9)};
    return log_normal(moved);
}

static enum ceduo_status train_nothing(void *context, const double *x, const double *densities, size_t n)
{
    (void)context, (void)x, (void)densities, (void)n;
    return CEDUO_OK;
}

static const double starts[8] = {5, 0, -5, 0, 1, -4, 3, -2};

static struct chains_def make_chains_def(void)
{
    return (struct chains_def){.dimensions = 2,
                               .chains = 4,
                               .starts = starts,
                               .first_step = 1,
                               .seed = 3,
                               .threads = 1,
                               .steps_min = 500,
                               .steps_max = 40000,
                               .rhat_max = 1.01,
                               .effective_min = 4000,
                               .density = normal_density};
}

static double chain_mean(const struct chains *c, size_t i)
{
    double sum = 0;
    size_t n = ceduo_chains_draws(c);
    for (size_t k = 0; k < n; k++)
        sum += ceduo_chains_draw(c, k)[i] / (double)n;
    return sum;
}

static double chain_covariance(const struct chains *c, size_t i, size_t k)
{
    double sum = 0, mean_i = chain_mean(c, i), mean_k = chain_mean(c, k);
    size_t n = ceduo_chains_draws(c);
    for (size_t s = 0; s < n; s++)
        sum += (ceduo_chains_draw(c, s)[i] - mean_i) * (ceduo_chains_draw(c, s)[k] - mean_k) / (double)n;
    return sum;
}

/* Within four standard errors of 4000 independent draws. */
static void expect_normal(const struct chains_def *def)
{
    LOCAL_BY(ceduo_chains_release) struct chains c;
    EXPECT(ceduo_chains_run(def, &c), ==, CEDUO_OK);
    assert_true(c.converged);
    EXPECT(c.effective_size, >=, 4000);
    EXPECT_NEAR(chain_mean(&c, 0), 1, 4 * 2 / sqrt(4000));
    EXPECT_NEAR(chain_mean(&c, 1), -2, 4 * 0.5 / sqrt(4000));
    EXPECT_NEAR(chain_covariance(&c, 0, 0) / 4, 1, 4 * sqrt(2. / 4000));
    EXPECT_NEAR(chain_covariance(&c, 1, 1) / 0.25, 1, 4 * sqrt(2. / 4000));
    EXPECT_NEAR(chain_covariance(&c, 0, 1), RHO, 4 * sqrt((1 + RHO * RHO) / 4000));
}

TEST(a_normal_distribution_is_sampled)
{
    struct chains_def def = make_chains_def();
    expect_normal(&def);
}

/* Check that each chain evaluates its start first. */
static enum ceduo_status density_at_start(void *context, size_t chain, const double *x, double *log_density)
{
    bool *started = context;
    if (!started[chain])
        assert_memory_equal(x, starts + 2 * chain, 2 * sizeof *x);
    started[chain] = true;
    *log_density = log_normal(x);
    return CEDUO_OK;
}

TEST(chains_begin_at_their_starts)
{
    struct chains_def def = make_chains_def();
    bool started[4] = {false};
    LOCAL_BY(ceduo_chains_release) struct chains c;
    def.density = density_at_start;
    def.context = started;
    def.steps_max = 500;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    for (size_t k = 0; k < 4; k++)
        assert_true(started[k]);
}

/* Draws follow the density, whatever the surrogate returns. */
TEST(a_wrong_surrogate_changes_no_distribution)
{
    struct chains_def def = make_chains_def();
    def.surrogate = wrong_surrogate;
    def.train = train_nothing;
    expect_normal(&def);
}

TEST(threads_change_no_bit)
{
    struct chains_def def = make_chains_def();
    LOCAL_BY(ceduo_chains_release) struct chains one, four;
    def.surrogate = wrong_surrogate;
    def.train = train_nothing;
    def.steps_max = 600;
    EXPECT(ceduo_chains_run(&def, &one), ==, CEDUO_OK);
    def.threads = 4;
    EXPECT(ceduo_chains_run(&def, &four), ==, CEDUO_OK);
    EXPECT(one.steps, ==, four.steps);
    for (size_t i = 0; i < ceduo_chains_draws(&one); i++)
        assert_memory_equal(ceduo_chains_draw(&one, i), ceduo_chains_draw(&four, i), 2 * sizeof(double));
}

/* ---- diagnosis ---- */

#define STEPS 4000

/* Make four chains of independent normal draws, chain k around k·apart; with phi, draws of an autoregressive process. */
static struct chains make_chains(double apart, double phi)
{
    struct chains c = {.dimensions = 1, .chains = 4, .steps = STEPS, .capacity = STEPS};
    struct line_random random = {.state = 5};
    c.x = malloc(4 * STEPS * sizeof *c.x);
    assert_non_null(c.x);
    for (size_t k = 0; k < 4; k++)
        for (size_t i = 0; i < STEPS; i++) {
            double before = i > 0 ? c.x[4 * (i - 1) + k] - apart * (double)k : 0;
            c.x[4 * i + k] = phi * before + sqrt(1 - phi * phi) * line_normal(&random) + apart * (double)k;
        }
    return c;
}

/* R-hat² is 1 + the variance of the means, here 5/3 for four chains: 10/7 for their eight halves. */
TEST(chains_apart_have_a_large_rhat)
{
    double rhat, size;
    struct chains c = make_chains(0, 0);
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    EXPECT_NEAR(rhat, 1, 0.003);
    EXPECT_NEAR(size / (4 * STEPS / 2), 1, 0.1);
    ceduo_chains_release(&c);
    c = make_chains(1, 0);
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    EXPECT_NEAR(rhat, sqrt(1 + 10. / 7), 0.02);
    ceduo_chains_release(&c);
}

/* With autocorrelation phi, the effective size is the share (1 - phi)/(1 + phi). */
TEST(autocorrelated_draws_count_less)
{
    double rhat, size;
    LOCAL_BY(ceduo_chains_release) struct chains c = make_chains(0, 0.8);
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    EXPECT_NEAR(size / (4 * STEPS / 2), 1. / 9, 0.02);
}

/* Two chains of eight steps; the first four are discarded. By hand, with n - 1 as in Gelman et al. 2013, 11.4: halves of two
 * draws have means 4, 2, 9, 2 and variances 8, 2, 0, 8. So W = 4.5, B/n = 131/12 and R-hat² = (W/2 + B/n)/W. */
TEST(short_chains_by_hand)
{
    double rhat, size, x[] = {100, 100, 100, 100, 100, 100, 100, 100, 1, 0, 3, 4, 2, 9, 6, 9};
    const struct chains c = {.dimensions = 1, .chains = 2, .steps = 8, .capacity = 8, .x = x};
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    EXPECT_NEAR(rhat, sqrt((4.5 / 2 + 131. / 12) / 4.5), 1e-12);
}

/* Return the effective size of a chain that is `run` times 1, then `run` times -1, and so on. It has 64 steps; 32 are used, in
 * two halves. */
static double compute_effective_size(size_t run)
{
    double rhat, size, x[64];
    const struct chains c = {.dimensions = 1, .chains = 1, .steps = 64, .capacity = 64, .x = x};
    for (size_t i = 0; i < 64; i++)
        x[i] = i / run % 2 == 0 ? 1 : -1;
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    return size;
}

/* Draws on alternating sides of the mean count like independent ones. With four draws on each side, 3 of 15 pairs at lag 1 and
 * 6 of 14 at lag 2 differ, by 2, and the variance is 1: the correlations are 1 - 2·3/15 and 1 - 2·6/14. The sum of correlations
 * at larger lags is below 0 and is left out. */
TEST(alternating_draws)
{
    EXPECT_NEAR(compute_effective_size(1), 32, 1e-12);
    EXPECT_NEAR(compute_effective_size(4), 32 / (1 + 2 * (1 - 6. / 15 + 1 - 12. / 14)), 1e-9);
}

/* ---- surrogate ---- */

/* A quadratic is learnt exactly; points without a value are left out. */
TEST(a_surrogate_learns_a_quadratic)
{
    GSL_RETURNS_ERRORS;
    LOCAL_BY(ceduo_surrogate_free) struct surrogate g = ceduo_surrogate_begin(2);
    double u[64 * 2], values[64], at[2] = {0.3, 0.9};
    EXPECT(ceduo_surrogate_evaluate(&g, at), ==, 0);
    for (int i = 0; i < 64; i++) {
        u[2 * i] = i % 8 / 8.;
        u[2 * i + 1] = i / 8 / 8.;
        values[i] = 3 + u[2 * i] - 2 * u[2 * i] * u[2 * i + 1] + 5 * u[2 * i + 1] * u[2 * i + 1];
    }
    EXPECT(ceduo_surrogate_train(&g, u, values, 5, NULL), ==, CEDUO_OK);
    EXPECT(ceduo_surrogate_evaluate(&g, at), ==, 0);
    values[7] = -INFINITY;
    EXPECT(ceduo_surrogate_train(&g, u, values, 64, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_surrogate_evaluate(&g, at), 3 + 0.3 - 2 * 0.27 + 5 * 0.81, 1e-9);
    for (int i = 0; i < 64; i++)
        values[i] = i < 60 ? -INFINITY : 0; /* too few points have a value */
    EXPECT(ceduo_surrogate_train(&g, u, values, 64, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_surrogate_evaluate(&g, at), 3 + 0.3 - 2 * 0.27 + 5 * 0.81, 1e-9);
    for (int i = 0; i < 16; i++) { /* less than three times the six terms: each counts */
        u[2 * i] = i % 4 / 4.;
        u[2 * i + 1] = i / 4 / 4.;
        values[i] = 1 - u[2 * i];
    }
    EXPECT(ceduo_surrogate_train(&g, u, values, 16, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_surrogate_evaluate(&g, (double[2]){0.5, 0.1}), 0.5, 1e-9);
    for (int i = 0; i < 16; i++)
        u[2 * i + 1] = 0.5; /* nothing is learnt about the second coordinate: the last surrogate stays */
    EXPECT(ceduo_surrogate_train(&g, u, values, 16, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_surrogate_evaluate(&g, (double[2]){0.5, 0.1}), 0.5, 1e-9);
}

/* The same with all points without a value at the end, after a whole number of blocks. */
TEST(a_surrogate_with_missing_values_at_the_end)
{
    enum { KNOWN = 512, N = KNOWN + 5 };
    static double u[N], values[N];
    LOCAL_BY(ceduo_surrogate_free) struct surrogate g = ceduo_surrogate_begin(1);
    for (int i = 0; i < N; i++) {
        u[i] = (double)i / N;
        values[i] = i < KNOWN ? 1 + u[i] - 2 * u[i] * u[i] : -INFINITY;
    }
    EXPECT(ceduo_surrogate_train(&g, u, values, N, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_surrogate_evaluate(&g, (double[1]){0.3}), 1 + 0.3 - 0.18, 1e-9);
}

/* Residuals of weighted least squares are orthogonal to every term, for any number of points. Here the function is a quartic,
 * and points count less the farther they are below the best. */
TEST(a_surrogate_weights_its_points)
{
    enum { N = 3000, NEAR = 9 /* three times the number of terms */ };
    static double u[N], values[N], sorted[NEAR + 1];
    LOCAL_BY(ceduo_surrogate_free) struct surrogate g = ceduo_surrogate_begin(1);
    struct line_random random = {.state = 1};
    double sums[3] = {0}, sizes[3] = {0};
    for (int i = 0; i < N; i++) {
        u[i] = line_uniform(&random, 0, 1);
        values[i] = -600 * pow(u[i] - 0.4, 4) - 90 * pow(u[i] - 0.4, 2);
    }
    for (int i = 0; i <= NEAR; i++) { /* the best points */
        sorted[i] = -INFINITY;
        for (int k = 0; k < N; k++)
            if (values[k] > sorted[i] && (i == 0 || values[k] < sorted[i - 1]))
                sorted[i] = values[k];
    }
    double reach = fmax(2, (sorted[0] - sorted[NEAR]) / 2);
    EXPECT(ceduo_surrogate_train(&g, u, values, N, NULL), ==, CEDUO_OK);
    for (int i = 0; i < N; i++) {
        double weight = exp((values[i] - sorted[0]) / reach), miss = values[i] - ceduo_surrogate_evaluate(&g, &u[i]);
        for (int k = 0; k < 3; k++) {
            sums[k] += weight * miss * pow(u[i] - 0.5, k);
            sizes[k] += fabs(weight * miss * pow(u[i] - 0.5, k));
        }
    }
    for (int k = 0; k < 3; k++)
        EXPECT_NEAR(sums[k] / sizes[k], 0, 1e-9);
}

static atomic_bool timer_fired;

static void cancel_on_timer(int number)
{
    (void)number;
    atomic_store(&timer_fired, true);
}

static double processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Twelve values have 91 terms. Training on 25 000 points is cancelled after a tenth of its time, ends in less than half of it,
 * and keeps the former surrogate. */
TEST(training_can_be_cancelled)
{
    enum { N = 25000, D = 12 };
    double *u = malloc(N * D * sizeof *u), *values = malloc(N * sizeof *values), start, full_time;
    LOCAL_BY(ceduo_surrogate_free) struct surrogate g = ceduo_surrogate_begin(D);
    struct line_random random = {.state = 1};
    assert_true(u && values);
    for (int i = 0; i < N; i++) {
        values[i] = 0;
        for (int k = 0; k < D; k++) {
            u[i * D + k] = line_uniform(&random, 0, 1);
            values[i] -= 40 * pow(u[i * D + k] - 0.3, 2);
        }
    }
    start = processor_seconds();
    EXPECT(ceduo_surrogate_train(&g, u, values, N, &timer_fired), ==, CEDUO_OK);
    full_time = processor_seconds() - start;
    double before = ceduo_surrogate_evaluate(&g, u);
    for (int i = 0; i < N; i++)
        values[i] *= 2;
    struct itimerval timer = {.it_value = {(time_t)(full_time / 10), (suseconds_t)(fmod(full_time / 10, 1) * 1e6) + 1}};
    signal(SIGPROF, cancel_on_timer);
    setitimer(ITIMER_PROF, &timer, NULL); /* processor time */
    start = processor_seconds();
    EXPECT(ceduo_surrogate_train(&g, u, values, N, &timer_fired), ==, CEDUO_CANCELLED);
    EXPECT(processor_seconds() - start, <, full_time / 2);
    EXPECT(ceduo_surrogate_evaluate(&g, u), ==, before);
    free(u);
    free(values);
}

/* A density that ends the chains after `remaining` more evaluations. */
struct countdown {
    int remaining;
    enum ceduo_status status;
};

static enum ceduo_status ending_density(void *context, size_t chain, const double *x, double *log_density)
{
    struct countdown *e = context;
    (void)chain;
    *log_density = log_normal(x);
    return e->remaining-- > 0 ? CEDUO_OK : e->status;
}

static bool stop_after_two_rounds(void *context, size_t steps, double rhat, double effective_size)
{
    (void)context, (void)rhat, (void)effective_size;
    return steps < 2 * CEDUO_CHAINS_ROUND;
}

/* Draws before the cancellation are kept. */
TEST(chains_can_be_cancelled)
{
    struct chains c;
    struct chains_def def = make_chains_def();
    const int remaining[] = {0, 3, 4, 150, 4 + 4 * CEDUO_CHAINS_ROUND};
    const size_t steps[] = {1, 1, 1, 1, 1 + CEDUO_CHAINS_ROUND};
    def.density = ending_density;
    for (int i = 0; i < 5; i++) {
        struct countdown e = {remaining[i], CEDUO_CANCELLED};
        def.context = &e;
        EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_CANCELLED);
        EXPECT(c.steps, ==, steps[i]);
        assert_false(c.converged);
        ceduo_chains_release(&c);
    }
    def = make_chains_def();
    def.round = stop_after_two_rounds;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    EXPECT(c.steps, ==, 1 + 2 * CEDUO_CHAINS_ROUND);
    assert_false(c.converged);
    ceduo_chains_release(&c);
}

/* A cancelled run does not diagnose its chains, because that takes long with many draws. */
TEST(diagnosis_can_be_cancelled)
{
    LOCAL_BY(ceduo_chains_release) struct chains c;
    struct chains_def def = make_chains_def();
    const atomic_bool cancel = true;
    def.steps_max = 4 * CEDUO_CHAINS_ROUND;
    def.cancel = &cancel;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    EXPECT(c.effective_size, ==, INFINITY);
}

/* A density that fails in the second thread. The first thread, in a chain of its own, waits until the second has ended. */
struct failing_thread {
    pthread_t first;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool ended;
    atomic_int started, after;
};

static pthread_key_t thread_end_key; /* its destructor runs when the thread ends */

static void note_thread_end(void *context)
{
    struct failing_thread *f = context;
    pthread_mutex_lock(&f->lock);
    f->ended = true;
    pthread_cond_broadcast(&f->changed);
    pthread_mutex_unlock(&f->lock);
}

static enum ceduo_status failing_density(void *context, size_t chain, const double *x, double *log_density)
{
    struct failing_thread *f = context;
    (void)chain;
    *log_density = log_normal(x);
    if (f->started++ < 4) /* evaluations of the starts */
        return CEDUO_OK;
    if (!pthread_equal(pthread_self(), f->first)) {
        pthread_setspecific(thread_end_key, f);
        return CEDUO_NO_MEMORY;
    }
    pthread_mutex_lock(&f->lock);
    while (!f->ended)
        pthread_cond_wait(&f->changed, &f->lock);
    pthread_mutex_unlock(&f->lock);
    f->after++;
    return CEDUO_OK;
}

/* If one chain fails, no other begins: the first thread ends its round of 50 steps at most. */
TEST(one_chain_ends_all)
{
    LOCAL_BY(ceduo_chains_release) struct chains c;
    struct failing_thread f = {.first = pthread_self(), .lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    struct chains_def def = make_chains_def();
    assert_int_equal(pthread_key_create(&thread_end_key, note_thread_end), 0);
    def.density = failing_density;
    def.context = &f;
    def.threads = 2;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_NO_MEMORY);
    EXPECT(f.after, <=, CEDUO_CHAINS_ROUND);
    pthread_key_delete(thread_end_key);
}

static enum ceduo_status point_density(void *context, size_t chain, const double *x, double *log_density)
{
    (void)context, (void)chain;
    *log_density = x[0] == 0 && x[1] == 0 ? 0 : -INFINITY;
    return CEDUO_OK;
}

/* Chains that never move have no R-hat. */
TEST(chains_that_never_move)
{
    static const double origin[8];
    LOCAL_BY(ceduo_chains_release) struct chains c;
    struct chains_def def = make_chains_def();
    def.density = point_density;
    def.starts = origin;
    def.steps_max = 5 * CEDUO_CHAINS_ROUND;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    assert_true(isnan(c.rhat));
    assert_false(c.converged);
    EXPECT(ceduo_chains_draw(&c, 0)[0], ==, 0);
}
