/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The regression on control variates of which the means are known to be 0. All rocks have the same weights in every adjusted
 * mean, so that shares that make 1 before make 1 after. */
#include "variates.h"

#include <math.h>
#include <string.h>

#include "kernel.h"
#define MANY 2
#include "variates_add.h"

#define LEFT_LEAST 1e-10 /* a variate of which the others leave a smaller share tells nothing of its own */

/* Where row i begins. */
static size_t row(size_t i)
{
    return i * (i + 1) / 2;
}

const struct variates_kernel ceduo_variates_scalar = {add_variates, add_varied};

const struct variates_kernel *ceduo_variates_kernel(enum ceduo_kernel kernel)
{
#if defined(__x86_64__) && defined(__GNUC__)
    kernel = ceduo_kernel_here(kernel);
    if (kernel == CEDUO_KERNEL_AVX512)
        return &ceduo_variates_avx512;
    if (kernel == CEDUO_KERNEL_AVX2)
        return &ceduo_variates_avx2;
#else
    (void)kernel;
#endif
    return &ceduo_variates_scalar;
}

void ceduo_variates_add_ended(struct varied_sums *to, enum ceduo_end end, const struct variate_row *row)
{
    for (size_t i = 0; i < VARIATES; i++)
        to->ended[end][i] += row->x[i];
}

static void add_up(double *to, const double *from, size_t n)
{
    for (size_t i = 0; i < n; i++)
        to[i] += from[i];
}

void ceduo_variates_merge(struct variate_sums *into, const struct variate_sums *from)
{
    add_up(into->with[0][0], from->with[0][0], sizeof from->with / sizeof(double));
}

void ceduo_varied_merge(struct varied_sums *into, const struct varied_sums *from)
{
    add_up(into->with[0], from->with[0], sizeof from->with / sizeof(double));
    add_up(into->ended[0], from->ended[0], sizeof from->ended / sizeof(double));
}

/* Row i of the Cholesky factor; `square`: the diagonal. A variate without anything of its own gets a row that takes no
 * part. */
static bool factor_row(struct variate_fit *fit, size_t i, double square)
{
    double *own = &fit->root[row(i)], left = square;
    for (size_t j = 0; j < i; j++) {
        const double *other = &fit->root[row(j)];
        double sum = own[j];
        for (size_t k = 0; k < j; k++)
            sum -= own[k] * other[k];
        own[j] = isinf(other[j]) ? 0 : sum / other[j];
        left -= own[j] * own[j];
    }
    bool tells = left > LEFT_LEAST * square;
    own[i] = tells ? sqrt(left) : INFINITY;
    for (size_t j = 0; j < i && !tells; j++)
        own[j] = 0;
    fit->used += tells;
    return isfinite(square);
}

/* x of root x = y. */
static void solve(const struct variate_fit *fit, const double y[VARIATES], double x[VARIATES])
{
    for (size_t i = 0; i < VARIATES; i++) {
        const double *own = &fit->root[row(i)];
        double sum = y[i];
        for (size_t j = 0; j < i; j++)
            sum -= own[j] * x[j];
        x[i] = sum / own[i];
    }
}

bool ceduo_variates_fit(const struct variate_sums *of, double n, struct variate_fit *fit)
{
    struct variate_sums s = *of;
    *fit = (struct variate_fit){.n = n};
    double mean[VARIATES];
    bool good = n > 0;
    for (size_t i = 0; i < VARIATES; i++) {
        fit->sums[i] = *variate_sum(&s, i);
        mean[i] = fit->sums[i] / n;
        for (size_t j = 0; j < i; j++)
            fit->root[row(i) + j] = *variate_product(&s, i, j) - fit->sums[i] * mean[j];
        good = good && factor_row(fit, i, *variate_product(&s, i, i) - fit->sums[i] * mean[i]);
    }
    if (!good || fit->used == 0)
        return false;
    solve(fit, mean, fit->chance);
    for (size_t i = 0; i < VARIATES; i++)
        fit->chance_square += fit->chance[i] * fit->chance[i];
    return isfinite(fit->chance_square);
}

struct varied_sum ceduo_variates_sum(const struct variate_fit *fit, const struct varied_sums *s, enum varied which, double y)
{
    double centred[VARIATES];
    struct varied_sum sum = {.y = y};
    for (size_t i = 0; i < VARIATES; i++) {
        double with = which < VARIED_ENDED ? s->with[i][which] : s->ended[which - VARIED_ENDED][i];
        centred[i] = with - fit->sums[i] * (y / fit->n);
    }
    solve(fit, centred, sum.along);
    return sum;
}

struct varied_sum ceduo_varied_less(struct varied_sum a, double times, struct varied_sum b)
{
    a.y -= times * b.y;
    for (size_t i = 0; i < VARIATES; i++)
        a.along[i] -= times * b.along[i];
    return a;
}

double ceduo_varied_mean(const struct variate_fit *fit, const struct varied_sum *y)
{
    double mean = y->y / fit->n;
    for (size_t i = 0; i < VARIATES; i++)
        mean -= fit->chance[i] * y->along[i];
    return mean;
}

double ceduo_varied_variance(const struct variate_fit *fit, const struct varied_sum *y, double square)
{
    for (size_t i = 0; i < VARIATES; i++)
        square -= y->along[i] * y->along[i];
    return fmax(0, square) / (fit->n - 1 - fit->used) * (1 / fit->n + fit->chance_square);
}

void ceduo_varied_slopes(const struct variate_fit *fit, const struct varied_sum *y, double slopes[VARIATES])
{
    for (size_t i = VARIATES; i-- > 0;) {
        double sum = y->along[i];
        for (size_t j = i + 1; j < VARIATES; j++)
            sum -= fit->root[row(j) + i] * slopes[j];
        slopes[i] = sum / fit->root[row(i) + i];
    }
}
