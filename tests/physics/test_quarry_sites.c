/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Calibrations of twenty small sites with known ground. All bounds follow from the binomial law: a correct calibration would
 * leave them once in ten thousand runs, and the sites never change. bench_calibration does this for many sites with usual
 * numbers of rocks. */
#include "ceduo/calibrate.h"
#include "expect.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sort.h>
#include <math.h>

#include "full.h"
#include "quarry_site.h"

#define SITES       20
#define VALUES      2
#define FALSE_ALARM 1e-4
#define TRUE_SITES  FULL_OR(400u, 200u)

/* Return how many of n successes to require if each has probability p. */
static unsigned required_successes(unsigned n, double p)
{
    unsigned k = 0;
    while (gsl_cdf_binomial_P(k, p, n) < FALSE_ALARM)
        k++;
    return k;
}

TEST(ranges_hold_the_truth)
{
    unsigned held = 0, narrow = 0, likely = 0, fits = 0;
    for (size_t i = 0; i < SITES; i++) {
        struct ceduo_calibration a;
        double truth[QUARRY_VALUES_MAX];
        struct quarry_trial trial = {.number = i, .values = VALUES, .kinds = 2, .observed = 30, .rocks = 200, .steps_max = 300};
        if (!quarry_fit(&trial, truth, &a))
            continue;
        for (size_t k = 0; k < VALUES; k++) {
            const struct ceduo_fitted *p = &a.parameters[k];
            held += truth[k] >= p->p2_5 && truth[k] <= p->p97_5;
            narrow += p->p97_5 - p->p2_5 < (p->hi - p->lo) / 2;
        }
        for (size_t k = 0; k < 2; k++)
            likely += a.predicted[k].p_value >= CEDUO_MISFIT;
        fits++;
        ceduo_calibration_release(&a);
    }
    ROWS(EXPECT, (fits, >=, SITES - 2), (held, >=, required_successes(VALUES * fits, 0.95)),
         (likely, >=, required_successes(2 * fits, 0.95)));
    EXPECT(narrow, >=, fits); /* 30 rocks do identify Rt; ranges as wide as the bounds would contain everything */
}

TEST(observations_by_another_law_are_detected)
{
    unsigned flagged = 0, fits = 0;
    for (size_t i = 0; i < SITES / 2; i++) {
        struct ceduo_calibration a;
        double truth[QUARRY_VALUES_MAX];
        struct quarry_trial trial = {.number = i,
                                     .values = VALUES,
                                     .kinds = QUARRY_KINDS,
                                     .made_by = CEDUO_LAW_CRSP,
                                     .observed = 200,
                                     .rocks = 200,
                                     .steps_max = 110};
        if (!quarry_fit(&trial, truth, &a))
            continue;
        flagged += a.misfit;
        fits++;
        ceduo_calibration_release(&a);
    }
    EXPECT(fits, >=, SITES / 2 - 2);
    EXPECT(flagged, >=, required_successes(fits, 0.9));
}

/* Kolmogorov's distance from the uniform law times the root of n: above 2.23 with probability 1e-4. */
static double uniform_distance(double *p, size_t n)
{
    double max = 0;
    gsl_sort(p, 1, n);
    for (size_t i = 0; i < n; i++)
        max = fmax(max, fmax((double)(i + 1) / (double)n - p[i], p[i] - (double)i / (double)n));
    return max * sqrt((double)n);
}

/* On the true ground, p of its observations is uniform. */
TEST(on_the_true_ground_p_is_uniform)
{
    double p[QUARRY_KINDS][400], one[QUARRY_KINDS];
    size_t n = 0;
    for (size_t i = 0; i < TRUE_SITES; i++) {
        struct quarry_trial trial = {.number = i, .values = VALUES, .kinds = QUARRY_KINDS, .observed = 50, .rocks = 1000};
        if (!quarry_compare(&trial, one))
            continue;
        for (size_t k = 0; k < QUARRY_KINDS; k++)
            p[k][n] = one[k];
        n++;
    }
    EXPECT(n, >=, TRUE_SITES / 2);
    for (size_t k = 0; k < QUARRY_KINDS; k++)
        EXPECT(uniform_distance(p[k], n), <, 2.23);
}
