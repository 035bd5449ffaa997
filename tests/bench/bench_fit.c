/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure the cost of a calibration: 4 values fitted to 48 stops with 2000 rocks per run, on quarries with known ground
 * (quarry_site.h).
 *
 *   bench_fit [SITES [FIRST]]
 *
 * Prints CSV. processor_s is the sum over all threads; two idle cores need half of it. */
#include <stdio.h>

#include "ceduo/calibrate.h"
#include "frame.h"
#include "physics/quarry_site.h"

int main(int argc, char **argv)
{
    (void)argc;
    size_t sites = argument(argv, 1, 5, 0, SIZE_MAX), first = argument(argv, 2, 0, 0, SIZE_MAX);
    printf("site,values,stops,rocks,evaluations,settled,effective_size,processor_s,seconds\n");
    for (size_t i = first; i < first + sites; i++) {
        struct ceduo_calibration a;
        double truth[QUARRY_VALUES_MAX], start = ceduo_clock(), processor = processor_s();
        struct quarry_trial trial = {
            .number = i, .values = 4, .kinds = 1, .observed = 48, .rocks = CEDUO_CALIBRATION_ROCKS, .threads = 2};
        if (!quarry_fit(&trial, truth, &a))
            continue;
        printf("%zu,%zu,%llu,%llu,%llu,%d,%.0f,%.1f,%.1f\n", i, trial.values, (unsigned long long)trial.observed,
               (unsigned long long)trial.rocks, (unsigned long long)a.evaluations, a.converged, a.effective_size,
               processor_s() - processor, ceduo_clock() - start);
        fflush(stdout);
        ceduo_calibration_release(&a);
    }
    return 0;
}
