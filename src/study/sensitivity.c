/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol' indices. Points come from GSL's Sobol' sequence, in blocks that are each shifted at random (Cranley and Patterson
 * 1976). Indices are sums over base points. Points of one block are spread more evenly than random ones, but the blocks are
 * independent of each other: so the bootstrap draws blocks again, not points, and sums the same terms. */
#include "ceduo/sensitivity.h"

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "base/hash.h"

#define BLOCKS 32 /* with fewer their own spread is not well known */

/* ---- the design ---- */

static size_t blocks_of(const struct ceduo_design *d)
{
    return d->points < BLOCKS ? d->points : BLOCKS;
}

/* First row of a block; of the block after the last: the number of rows. */
static size_t block_start(const struct ceduo_design *d, size_t block)
{
    return block * d->points / blocks_of(d);
}

static size_t group_of(const struct ceduo_design *d, size_t input)
{
    return d->group ? d->group[input] : input;
}

size_t ceduo_design_evaluations(const struct ceduo_design *d)
{
    return d->points * (d->groups + 2);
}

/* Uniform in [0, 1), by seed, row and column. */
static double hashed(uint64_t seed, uint64_t row, uint64_t column)
{
    uint64_t hash = HASH_START;
    hash_count(&hash, seed);
    hash_count(&hash, row);
    hash_count(&hash, column);
    hash_count(&hash, column); /* once more: the last one mixed in reaches the high bits only */
    return (double)(hash >> 11) * 0x1p-53;
}

static double shifted(const struct ceduo_design *d, double x, size_t block, size_t column)
{
    x += hashed(d->seed, UINT64_MAX - block, column);
    return x - floor(x);
}

/* Row `row` of A and of B. The first input of a group has a coordinate of the Sobol' points, the others are drawn. */
static void fill_row(const struct ceduo_design *d, const double *sobol, size_t block, size_t row, double *a, double *b)
{
    bool taken[CEDUO_SENSITIVITY_GROUPS] = {false};
    for (size_t i = 0; i < d->inputs; i++) {
        size_t g = group_of(d, i);
        if (taken[g]) {
            a[i] = hashed(d->seed, row, 2 * (d->groups + i));
            b[i] = hashed(d->seed, row, 2 * (d->groups + i) + 1);
            continue;
        }
        taken[g] = true;
        a[i] = shifted(d, sobol[g], block, g);
        b[i] = shifted(d, sobol[d->groups + g], block, d->groups + g);
    }
}

enum ceduo_status ceduo_design_fill(const struct ceduo_design *d, double *u)
{
    double sobol[2 * CEDUO_SENSITIVITY_GROUPS];
    gsl_qrng *sequence = gsl_qrng_alloc(gsl_qrng_sobol, (unsigned)(2 * d->groups));
    if (!sequence) /* untaken: gsl */
        return CEDUO_NO_MEMORY;
    for (size_t row = 0, block = 0; row < d->points; row++) {
        double *a = u + row * (d->groups + 2) * d->inputs, *b = a + d->inputs;
        block += row == block_start(d, block + 1);
        gsl_qrng_get(sequence, sobol);
        fill_row(d, sobol, block, row, a, b);
        for (size_t g = 0; g < d->groups; g++) {
            double *mixed = b + (g + 1) * d->inputs;
            for (size_t i = 0; i < d->inputs; i++)
                mixed[i] = group_of(d, i) == g ? b[i] : a[i];
        }
    }
    gsl_qrng_free(sequence);
    return CEDUO_OK;
}

/* ---- the indices ---- */

/* Sums over base points. */
struct sums {
    double mean[2], variance, noise; /* mean: of each half */
    double first[CEDUO_SENSITIVITY_GROUPS], total[CEDUO_SENSITIVITY_GROUPS];
};

/* The terms of base point `row`, as deviations from `middle`. A half is of the same rocks at every point, so that the halves' means
 * differ by a constant, which is no noise: each is taken off by itself. */
static void add_point(const struct ceduo_design *d, const struct ceduo_halves *values, size_t row, struct ceduo_halves middle,
                      struct sums *s)
{
    const struct ceduo_halves *a = values + row * (d->groups + 2), *b = a + 1, *mixed = a + 2;
    for (int k = 0; k < 2; k++) { /* both rows are samples of the figure */
        double one = a[k].half[0] - middle.half[0], other = a[k].half[1] - middle.half[1];
        s->mean[0] += one / 2;
        s->mean[1] += other / 2;
        s->variance += one * other / 2;
        s->noise += (one - other) * (one - other) / 8;
    }
    for (size_t g = 0; g < d->groups; g++) {
        double change[2];
        for (int h = 0; h < 2; h++)
            change[h] = mixed[g].half[h] - a->half[h];
        s->first[g] += ((b->half[0] - middle.half[0]) * change[1] + (b->half[1] - middle.half[1]) * change[0]) / 2;
        s->total[g] += change[0] * change[1] / 2;
    }
}

/* The variance that shares are of: without noise, unless noise hides it. */
static double whole_of(const struct sums *s, bool hidden)
{
    return hidden ? s->variance + s->noise : s->variance;
}

static void finish_sums(const struct ceduo_design *d, size_t points, struct sums *s)
{
    double n = (double)points;
    s->mean[0] /= n;
    s->mean[1] /= n;
    s->variance = s->variance / n - s->mean[0] * s->mean[1];
    s->noise /= n;
    for (size_t g = 0; g < d->groups; g++) {
        s->first[g] /= n;
        s->total[g] /= n;
    }
}

static void add_sums(struct sums *to, const struct sums *from)
{
    double *x = to->mean;
    const double *y = from->mean;
    for (size_t i = 0; i < sizeof *to / sizeof *x; i++)
        x[i] += y[i];
}

/* Sums over blocks drawn again: the bootstrap's. */
static void resample(const struct ceduo_design *d, const struct sums *blocks, uint64_t repeat, struct sums *s)
{
    size_t n = blocks_of(d), points = 0;
    *s = (struct sums){0};
    for (size_t k = 0; k < n; k++) {
        size_t b = (size_t)(hashed(~d->seed, repeat, k) * (double)n);
        add_sums(s, &blocks[b]);
        points += block_start(d, b + 1) - block_start(d, b);
    }
    finish_sums(d, points, s);
}

/* Standard deviation of x[0], x[stride], …: drawing n blocks of n again spreads by sqrt(1 - 1/n) too little. */
static double deviation(const struct ceduo_design *d, const double *x, size_t n, size_t stride)
{
    double blocks = (double)blocks_of(d);
    return gsl_stats_sd(x, stride, n) * sqrt(blocks / (blocks - 1));
}

static struct ceduo_halves middle_of(const struct ceduo_design *d, const struct ceduo_halves *values)
{
    struct ceduo_halves middle = {{0, 0}};
    for (size_t row = 0; row < d->points; row++)
        for (size_t k = 0; k < 2; k++)
            for (int h = 0; h < 2; h++)
                middle.half[h] += values[row * (d->groups + 2) + k].half[h] / (2 * (double)d->points);
    return middle;
}

#define RESAMPLES 200
#define STRIDE    (sizeof(struct sums) / sizeof(double))

/* One share: of all points, and the error by the resamples, whose sums it divides by their whole. */
static struct ceduo_share share_of(const struct ceduo_design *d, double all, double whole, double *resampled,
                                   const double *wholes)
{
    if (!(whole > 0))
        return (struct ceduo_share){NAN, NAN};
    for (size_t i = 0; i < RESAMPLES; i++)
        resampled[i * STRIDE] = wholes[i] > 0 ? resampled[i * STRIDE] / wholes[i] : 0;
    return (struct ceduo_share){all / whole, deviation(d, resampled, RESAMPLES, STRIDE)};
}

enum ceduo_status ceduo_design_read(const struct ceduo_design *d, const struct ceduo_halves *values,
                                    struct ceduo_indices *indices)
{
    double wholes[RESAMPLES];
    struct ceduo_halves middle = middle_of(d, values);
    struct sums all = {0}, blocks[BLOCKS] = {0}, *resamples = malloc(RESAMPLES * sizeof *resamples);
    if (!resamples)
        return CEDUO_NO_MEMORY;
    for (size_t b = 0; b < blocks_of(d); b++) {
        for (size_t row = block_start(d, b); row < block_start(d, b + 1); row++)
            add_point(d, values, row, middle, &blocks[b]);
        add_sums(&all, &blocks[b]);
    }
    finish_sums(d, d->points, &all);
    for (uint64_t i = 0; i < RESAMPLES; i++)
        resample(d, blocks, i, &resamples[i]);
    bool hidden = !(all.variance > 2 * deviation(d, &resamples->variance, RESAMPLES, STRIDE));
    for (size_t i = 0; i < RESAMPLES; i++)
        wholes[i] = whole_of(&resamples[i], hidden);
    double whole = whole_of(&all, hidden);
    *indices = (struct ceduo_indices){
        .mean = (middle.half[0] + middle.half[1]) / 2, .variance = fmax(0, all.variance), .noise = all.noise};
    for (size_t g = 0; g < d->groups; g++) {
        indices->first[g] = share_of(d, all.first[g], whole, &resamples->first[g], wholes);
        indices->total[g] = share_of(d, all.total[g], whole, &resamples->total[g], wholes);
    }
    free(resamples);
    return CEDUO_OK;
}
