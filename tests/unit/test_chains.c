/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chains on densities with known moments, and their statistics. */
#include "expect.h"
#include "local.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

#include "physics/line_scene.h"
#include "study/chains.h"
#include "study/guess.h"

/* A normal law at (1, -2) with standard deviations 2 and 0.5 and correlation 0.9. */
#define RHO 0.9

static double log_normal(const double *x)
{
    double a = (x[0] - 1) / 2, b = (x[1] + 2) / 0.5;
    return -(a * a - 2 * RHO * a * b + b * b) / (2 * (1 - RHO * RHO));
}

static enum ceduo_status normal(void *context, size_t chain, const double *x, double *log_density)
{
    (void)chain;
    (void)context;
    *log_density = log_normal(x);
    return CEDUO_OK;
}

/* A wrong surrogate: too narrow and off centre. */
static double wrong_surrogate(void *context, const double *x)
{
    (void)context;
    double moved[2] = {1 + 1.3 * (x[0] - 1.3), -2 + 1.3 * (x[1] + 1.9)};
    return log_normal(moved);
}

static enum ceduo_status learn_nothing(void *context, const double *x, const double *densities, size_t n)
{
    (void)context, (void)x, (void)densities, (void)n;
    return CEDUO_OK;
}

static const double starts[8] = {5, 0, -5, 0, 1, -4, 3, -2};

static struct chains_def two_dimensions(void)
{
    return (struct chains_def){.dimensions = 2,
                               .chains = 4,
                               .starts = starts,
                               .first_step = 1,
                               .seed = 3,
                               .threads = 1,
                               .steps_least = 500,
                               .steps_most = 40000,
                               .rhat_most = 1.01,
                               .effective_least = 4000,
                               .density = normal};
}

static double compute_mean(const struct chains *c, size_t i)
{
    double sum = 0;
    size_t n = ceduo_chains_draws(c);
    for (size_t k = 0; k < n; k++)
        sum += ceduo_chains_draw(c, k)[i] / (double)n;
    return sum;
}

static double compute_covariance(const struct chains *c, size_t i, size_t k)
{
    double sum = 0, mean_i = compute_mean(c, i), mean_k = compute_mean(c, k);
    size_t n = ceduo_chains_draws(c);
    for (size_t s = 0; s < n; s++)
        sum += (ceduo_chains_draw(c, s)[i] - mean_i) * (ceduo_chains_draw(c, s)[k] - mean_k) / (double)n;
    return sum;
}

/* Expect the moments within four standard errors of 4000 independent draws. */
static void expect_normal(const struct chains_def *def)
{
    LOCAL_BY(ceduo_chains_release) struct chains c;
    EXPECT(ceduo_chains_run(def, &c), ==, CEDUO_OK);
    assert_true(c.settled);
    EXPECT(c.effective_size, >=, 4000);
    EXPECT_NEAR(compute_mean(&c, 0), 1, 4 * 2 / sqrt(4000));
    EXPECT_NEAR(compute_mean(&c, 1), -2, 4 * 0.5 / sqrt(4000));
    EXPECT_NEAR(compute_covariance(&c, 0, 0) / 4, 1, 4 * sqrt(2. / 4000));
    EXPECT_NEAR(compute_covariance(&c, 1, 1) / 0.25, 1, 4 * sqrt(2. / 4000));
    EXPECT_NEAR(compute_covariance(&c, 0, 1), RHO, 4 * sqrt((1 + RHO * RHO) / 4000));
}

TEST(a_normal_law_is_sampled)
{
    struct chains_def def = two_dimensions();
    expect_normal(&def);
}

/* The first evaluation of each chain is at its start. */
static enum ceduo_status check_start(void *context, size_t chain, const double *x, double *log_density)
{
    bool *begun = context;
    if (!begun[chain])
        assert_memory_equal(x, starts + 2 * chain, 2 * sizeof *x);
    begun[chain] = true;
    *log_density = log_normal(x);
    return CEDUO_OK;
}

TEST(chains_begin_at_their_starts)
{
    struct chains_def def = two_dimensions();
    bool begun[4] = {false};
    LOCAL_BY(ceduo_chains_release) struct chains c;
    def.density = check_start;
    def.context = begun;
    def.steps_most = 500;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    for (size_t k = 0; k < 4; k++)
        assert_true(begun[k]);
}

/* For any surrogate the draws follow the density. */
TEST(a_wrong_surrogate_changes_nothing)
{
    struct chains_def def = two_dimensions();
    def.guess = wrong_surrogate;
    def.learn = learn_nothing;
    expect_normal(&def);
}

TEST(threads_change_no_bit)
{
    struct chains_def def = two_dimensions();
    LOCAL_BY(ceduo_chains_release) struct chains one, four;
    def.guess = wrong_surrogate;
    def.learn = learn_nothing;
    def.steps_most = 600;
    EXPECT(ceduo_chains_run(&def, &one), ==, CEDUO_OK);
    def.threads = 4;
    EXPECT(ceduo_chains_run(&def, &four), ==, CEDUO_OK);
    EXPECT(one.steps, ==, four.steps);
    for (size_t i = 0; i < ceduo_chains_draws(&one); i++)
        assert_memory_equal(ceduo_chains_draw(&one, i), ceduo_chains_draw(&four, i), 2 * sizeof(double));
}

/* ---- diagnosis ---- */

#define STEPS 4000

/* Four chains of independent normal draws, chain k with mean k·apart; or each draw is phi times the previous one plus a new
 * one. */
static struct chains make_chains(double distance, double phi)
{
    struct chains c = {.dimensions = 1, .chains = 4, .steps = STEPS, .room = STEPS};
    struct line_random random = {.state = 5};
    c.x = malloc(4 * STEPS * sizeof *c.x);
    assert_non_null(c.x);
    for (size_t k = 0; k < 4; k++)
        for (size_t i = 0; i < STEPS; i++) {
            double before = i > 0 ? c.x[4 * (i - 1) + k] - distance * (double)k : 0;
            c.x[4 * i + k] = phi * before + sqrt(1 - phi * phi) * line_normal(&random) + distance * (double)k;
        }
    return c;
}

/* R-hat² is 1 + the variance of the means: 5/3 for halves of four chains, 10/7 for these eight. */
TEST(chains_apart_do_not_agree)
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

/* Draws with lag-1 correlation phi count (1 - phi)/(1 + phi). */
TEST(correlated_draws_count_less)
{
    double rhat, size;
    LOCAL_BY(ceduo_chains_release) struct chains c = make_chains(0, 0.8);
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    EXPECT_NEAR(size / (4 * STEPS / 2), 1. / 9, 0.02);
}

/* Two chains of eight steps, the first four dropped: by hand, with the n - 1 of Gelman et al. 2013, 11.4. Halves of two draws:
 * means 4, 2, 9, 2 and variances 8, 2, 0, 8, so that W = 4.5, B/n = 131/12 and R-hat² = (W/2 + B/n)/W. */
TEST(short_chains_by_hand)
{
    double rhat, size, x[] = {100, 100, 100, 100, 100, 100, 100, 100, 1, 0, 3, 4, 2, 9, 6, 9};
    const struct chains c = {.dimensions = 1, .chains = 2, .steps = 8, .room = 8, .x = x};
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    EXPECT_NEAR(rhat, sqrt((4.5 / 2 + 131. / 12) / 4.5), 1e-12);
}

/* Effective size of a chain that is `run` times at 1, then at -1, and so on: 64 steps, 32 of them used, in two halves. */
static double compute_effective(size_t run)
{
    double rhat, size, x[64];
    const struct chains c = {.dimensions = 1, .chains = 1, .steps = 64, .room = 64, .x = x};
    for (size_t i = 0; i < 64; i++)
        x[i] = i / run % 2 == 0 ? 1 : -1;
    ceduo_chains_diagnose(&c, 0, &rhat, &size);
    return size;
}

/* Draws on alternating sides of the mean count at most as independent ones. With runs of four, in 16 draws 3 of 15 pairs at lag
 * 1 and 6 of 14 at lag 2 differ, by 2, and the variance is 1: correlations of 1 - 2·3/15 and 1 - 2·6/14. Higher lags sum to
 * less than 0 and are dropped. */
TEST(draws_that_alternate)
{
    EXPECT_NEAR(compute_effective(1), 32, 1e-12);
    EXPECT_NEAR(compute_effective(4), 32 / (1 + 2 * (1 - 6. / 15 + 1 - 12. / 14)), 1e-9);
}

/* ---- surrogate ---- */

/* The surrogate learns a quadratic exactly; places without a value are ignored. */
TEST(a_surrogate_learns_a_quadratic)
{
    LOCAL_BY(ceduo_guess_release) struct guess g = ceduo_guess_begin(2);
    double u[64 * 2], values[64], at[2] = {0.3, 0.9};
    EXPECT(ceduo_guess_at(&g, at), ==, 0);
    for (int i = 0; i < 64; i++) {
        u[2 * i] = i % 8 / 8.;
        u[2 * i + 1] = i / 8 / 8.;
        values[i] = 3 + u[2 * i] - 2 * u[2 * i] * u[2 * i + 1] + 5 * u[2 * i + 1] * u[2 * i + 1];
    }
    EXPECT(ceduo_guess_learn(&g, u, values, 5, NULL), ==, CEDUO_OK);
    EXPECT(ceduo_guess_at(&g, at), ==, 0);
    values[7] = -INFINITY;
    EXPECT(ceduo_guess_learn(&g, u, values, 64, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_guess_at(&g, at), 3 + 0.3 - 2 * 0.27 + 5 * 0.81, 1e-9);
    for (int i = 0; i < 64; i++)
        values[i] = i < 60 ? -INFINITY : 0; /* too few values */
    EXPECT(ceduo_guess_learn(&g, u, values, 64, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_guess_at(&g, at), 3 + 0.3 - 2 * 0.27 + 5 * 0.81, 1e-9);
    for (int i = 0; i < 16; i++) { /* less than three times the six terms: each counts */
        u[2 * i] = i % 4 / 4.;
        u[2 * i + 1] = i / 4 / 4.;
        values[i] = 1 - u[2 * i];
    }
    EXPECT(ceduo_guess_learn(&g, u, values, 16, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_guess_at(&g, (double[2]){0.5, 0.1}), 0.5, 1e-9);
}

/* The same if all places without a value come last, after a whole number of blocks. */
TEST(a_surrogate_without_values)
{
    enum { KNOWN = 512, N = KNOWN + 5 };
    static double u[N], values[N];
    LOCAL_BY(ceduo_guess_release) struct guess g = ceduo_guess_begin(1);
    for (int i = 0; i < N; i++) {
        u[i] = (double)i / N;
        values[i] = i < KNOWN ? 1 + u[i] - 2 * u[i] * u[i] : -INFINITY;
    }
    EXPECT(ceduo_guess_learn(&g, u, values, N, NULL), ==, CEDUO_OK);
    EXPECT_NEAR(ceduo_guess_at(&g, (double[1]){0.3}), 1 + 0.3 - 0.18, 1e-9);
}

/* Residuals of weighted least squares are orthogonal to every term for any number of places: here of a quartic, with weights
 * that decrease below the best value. */
TEST(a_surrogate_weights_its_values)
{
    enum { N = 3000, NEAR = 9 /* three times the terms */ };
    static double u[N], values[N], sorted[NEAR + 1];
    LOCAL_BY(ceduo_guess_release) struct guess g = ceduo_guess_begin(1);
    struct line_random random = {.state = 1};
    double left[3] = {0}, size[3] = {0};
    for (int i = 0; i < N; i++) {
        u[i] = line_uniform(&random, 0, 1);
        values[i] = -600 * pow(u[i] - 0.4, 4) - 90 * pow(u[i] - 0.4, 2);
    }
    for (int i = 0; i <= NEAR; i++) { /* the best places */
        sorted[i] = -INFINITY;
        for (int k = 0; k < N; k++)
            if (values[k] > sorted[i] && (i == 0 || values[k] < sorted[i - 1]))
                sorted[i] = values[k];
    }
    double reach = fmax(2, (sorted[0] - sorted[NEAR]) / 2);
    EXPECT(ceduo_guess_learn(&g, u, values, N, NULL), ==, CEDUO_OK);
    for (int i = 0; i < N; i++) {
        double weight = exp((values[i] - sorted[0]) / reach), miss = values[i] - ceduo_guess_at(&g, &u[i]);
        for (int k = 0; k < 3; k++) {
            left[k] += weight * miss * pow(u[i] - 0.5, k);
            size[k] += fabs(weight * miss * pow(u[i] - 0.5, k));
        }
    }
    for (int k = 0; k < 3; k++)
        EXPECT_NEAR(left[k] / size[k], 0, 1e-9);
}

static atomic_bool ended;

static void on_time(int number)
{
    (void)number;
    atomic_store(&ended, true);
}

static double processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Twelve values have 91 terms. Stopped after a tenth of the time for 25 000 places, training ends in less than half of it and
 * keeps the old surrogate. */
TEST(surrogate_training_can_be_stopped)
{
    enum { N = 25000, D = 12 };
    double *u = malloc(N * D * sizeof *u), *values = malloc(N * sizeof *values), start, all;
    LOCAL_BY(ceduo_guess_release) struct guess g = ceduo_guess_begin(D);
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
    EXPECT(ceduo_guess_learn(&g, u, values, N, &ended), ==, CEDUO_OK);
    all = processor_seconds() - start;
    double knew = ceduo_guess_at(&g, u);
    for (int i = 0; i < N; i++)
        values[i] *= 2;
    struct itimerval timer = {.it_value = {(time_t)(all / 10), (suseconds_t)(fmod(all / 10, 1) * 1e6) + 1}};
    signal(SIGPROF, on_time);
    setitimer(ITIMER_PROF, &timer, NULL); /* processor time */
    start = processor_seconds();
    EXPECT(ceduo_guess_learn(&g, u, values, N, &ended), ==, CEDUO_CANCELLED);
    EXPECT(processor_seconds() - start, <, all / 2);
    EXPECT(ceduo_guess_at(&g, u), ==, knew);
    free(u);
    free(values);
}

/* A density that stops the chains after `left` more evaluations. */
struct ending {
    int left;
    enum ceduo_status status;
};

static enum ceduo_status stop_after(void *context, size_t chain, const double *x, double *log_density)
{
    struct ending *e = context;
    (void)chain;
    *log_density = log_normal(x);
    return e->left-- > 0 ? CEDUO_OK : e->status;
}

static bool stop(void *context, size_t steps, double rhat, double effective_size)
{
    (void)context, (void)rhat, (void)effective_size;
    return steps < 2 * CEDUO_CHAINS_ROUND;
}

/* Earlier draws are kept. */
TEST(chains_can_be_stopped)
{
    struct chains c;
    struct chains_def def = two_dimensions();
    const int left[] = {0, 3, 4, 150, 4 + 4 * CEDUO_CHAINS_ROUND};
    const size_t steps[] = {1, 1, 1, 1, 1 + CEDUO_CHAINS_ROUND};
    def.density = stop_after;
    for (int i = 0; i < 5; i++) {
        struct ending e = {left[i], CEDUO_CANCELLED};
        def.context = &e;
        EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_CANCELLED);
        EXPECT(c.steps, ==, steps[i]);
        assert_false(c.settled);
        ceduo_chains_release(&c);
    }
    def = two_dimensions();
    def.round = stop;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    EXPECT(c.steps, ==, 1 + 2 * CEDUO_CHAINS_ROUND);
    assert_false(c.settled);
    ceduo_chains_release(&c);
}

/* Chains that were stopped are not checked for convergence, which takes long with many draws. */
TEST(chain_diagnosis_can_be_stopped)
{
    LOCAL_BY(ceduo_chains_release) struct chains c;
    struct chains_def def = two_dimensions();
    const atomic_bool cancel = true;
    def.steps_most = 4 * CEDUO_CHAINS_ROUND;
    def.cancel = &cancel;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    EXPECT(c.effective_size, ==, INFINITY);
}

/* A density that fails in the second thread. The first one, in its own chain, waits until that thread has ended. */
struct failure {
    pthread_t first;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool ended;
    atomic_int started, after;
};

static pthread_key_t failing; /* its destructor runs when the thread ends */

static void note_end(void *context)
{
    struct failure *f = context;
    pthread_mutex_lock(&f->lock);
    f->ended = true;
    pthread_cond_broadcast(&f->changed);
    pthread_mutex_unlock(&f->lock);
}

static enum ceduo_status fails_in_one(void *context, size_t chain, const double *x, double *log_density)
{
    struct failure *f = context;
    (void)chain;
    *log_density = log_normal(x);
    if (f->started++ < 4) /* the starts of the chains */
        return CEDUO_OK;
    if (!pthread_equal(pthread_self(), f->first)) {
        pthread_setspecific(failing, f);
        return CEDUO_NO_MEMORY;
    }
    pthread_mutex_lock(&f->lock);
    while (!f->ended)
        pthread_cond_wait(&f->changed, &f->lock);
    pthread_mutex_unlock(&f->lock);
    f->after++;
    return CEDUO_OK;
}

/* If one chain fails no other starts: the first thread ends its round of at most 50 steps, or has none. */
TEST(one_failure_stops_all_chains)
{
    LOCAL_BY(ceduo_chains_release) struct chains c;
    struct failure f = {.first = pthread_self(), .lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    struct chains_def def = two_dimensions();
    assert_int_equal(pthread_key_create(&failing, note_end), 0);
    def.density = fails_in_one;
    def.context = &f;
    def.threads = 2;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_NO_MEMORY);
    EXPECT(f.after, <=, CEDUO_CHAINS_ROUND);
    pthread_key_delete(failing);
}

static enum ceduo_status one_place(void *context, size_t chain, const double *x, double *log_density)
{
    (void)context, (void)chain;
    *log_density = x[0] == 0 && x[1] == 0 ? 0 : -INFINITY;
    return CEDUO_OK;
}

/* Chains that never move have no convergence statistic. */
TEST(chains_that_never_move)
{
    static const double nowhere[8];
    LOCAL_BY(ceduo_chains_release) struct chains c;
    struct chains_def def = two_dimensions();
    def.density = one_place;
    def.starts = nowhere;
    def.steps_most = 5 * CEDUO_CHAINS_ROUND;
    EXPECT(ceduo_chains_run(&def, &c), ==, CEDUO_OK);
    assert_true(isnan(c.rhat));
    assert_false(c.settled);
    EXPECT(ceduo_chains_draw(&c, 0)[0], ==, 0);
}
