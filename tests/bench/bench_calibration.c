/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Check calibrations on sites with known ground (quarry_site.h): 95 % ranges must contain the truth at 95 % of the sites, p
 * must be uniform, and a misfit must be reported for observations made by another law.
 *
 *     bench_calibration [SITES [FIRST [ROCKS]]]
 *
 * Prints CSV, one row after each fit: rows of an interrupted run are valid, and several runs can share the sites. If the law
 * crsp made the observations, chains stop at STEPS_MAX_CRSP steps: they rarely converge, and the misfit appears before. */
#include <stdio.h>

#include "ceduo/calibrate.h"
#include "frame.h"
#include "physics/quarry_site.h"

#define VALUES         3
#define STEPS_MAX_CRSP 250

static void fit_site(size_t number, enum ceduo_law made_by, uint64_t observed, uint64_t rocks)
{
    struct ceduo_calibration a;
    double truth[QUARRY_VALUES_MAX], start = processor_s();
    struct quarry_trial trial = {.number = number,
                                 .values = VALUES,
                                 .kinds = QUARRY_KINDS,
                                 .made_by = made_by,
                                 .observed = observed,
                                 .rocks = rocks,
                                 .steps_max = made_by == CEDUO_LAW_LUMPED ? 0 : STEPS_MAX_CRSP};
    if (!quarry_fit(&trial, truth, &a))
        return;
    printf("%zu,%s,%llu,%llu,%llu,%.1f,%d,%.0f", number, made_by == CEDUO_LAW_LUMPED ? "lumped" : "crsp",
           (unsigned long long)observed, (unsigned long long)rocks, (unsigned long long)a.evaluations, processor_s() - start,
           a.converged, a.effective_size);
    printf(",%d,%.4f,%.4f,%.4f", a.misfit, a.predicted[0].p_value, a.predicted[1].p_value, a.predicted[2].p_value);
    for (size_t i = 0; i < VALUES; i++)
        printf(",%.4f,%.4f,%.4f,%d", truth[i], a.parameters[i].p2_5, a.parameters[i].p97_5, a.parameters[i].identified);
    printf("\n");
    fflush(stdout);
    ceduo_calibration_release(&a);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t sites = argument(argv, 1, 40, 0, SIZE_MAX), first = argument(argv, 2, 0, 0, SIZE_MAX);
    uint64_t rocks = argument(argv, 3, CEDUO_CALIBRATION_ROCKS, 1, UINT64_MAX);
    printf("site,made_by,seen,rocks,evaluations,processor_s,settled,effective_size,misfit,p_stops,p_speeds,p_heights");
    for (size_t i = 0; i < VALUES; i++)
        printf(",%s,%s_lo,%s_hi,%s_determined", quarry_names[i], quarry_names[i], quarry_names[i], quarry_names[i]);
    printf("\n");
    for (size_t i = first; i < first + sites; i++) {
        fit_site(i, CEDUO_LAW_LUMPED, 50, rocks);
        fit_site(i, CEDUO_LAW_CRSP, 200, rocks);
    }
    return 0;
}
