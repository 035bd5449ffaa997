/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare the error of a sensitivity analysis per processor time: the surface through Sobol' points (study/surface.h) and the
 * usual design, which redraws one input at a time (Saltelli et al. 2010, totals estimated as by Jansen 1999). The truth comes
 * from the usual design with many points and rocks.
 *
 *   bench_uncertainty_error [SEEDS [POINTS]]
 *
 * Prints CSV: root mean squares over the seeds for both ends of the 90 % band and for the total shares of all inputs. For the
 * surface also how often the truth lies within 1.96 of its reported errors. */
#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics_double.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>

#include "core/runs/statistics.h"
#include "frame.h"
#include "io/scene_file.h"
#include "scene/derived.h"
#include "study/points.h"
#include "study/surface.h"

#define INPUTS_MAX      20 /* twice the columns, at most the 40 of a point */
#define THREADS         2
#define TRUE_ROCKS      4000
#define TRUE_BAND_ROCKS 10000 /* shared rocks at all points move the whole band */
#define FIRST_SEED      1000  /* seeds that the truth does not use */
#define CONTROL(of)     ceduo_scene_last_control(of)

/* Band and shares by one method. */
struct found {
    double band[2], totals[INPUTS_MAX], band_se[2], totals_se[INPUTS_MAX], seconds;
    uint64_t evaluations;
};

static struct scene_file file;
static struct scene_inputs inputs;

/* ---- surface ---- */

static void measure_surface(size_t points, uint64_t rocks, uint64_t seed, struct found *found)
{
    const struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                              .scene = &file.scene,
                                              .inputs_count = inputs.n,
                                              .inputs = inputs.items,
                                              .points = points,
                                              .points_max = points,
                                              .rocks = rocks,
                                              .threads = THREADS};
    struct ceduo_uncertainty_result answer;
    file.scene.simulation.seed = seed;
    double start = processor_s();
    if (ceduo_uncertainty_compute(&def, &answer) != CEDUO_OK)
        fail("the sensitivity failed");
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(&answer, 0, CEDUO_UNCERTAINTY_EXCEED, false);
    *found = (struct found){.band = {f->fit.p5, f->fit.p95},
                            .band_se = {f->fit.p5_se, f->fit.p95_se},
                            .seconds = processor_s() - start,
                            .evaluations = answer.evaluations};
    for (size_t i = 0; i < inputs.n; i++) {
        found->totals[i] = f->fit.total[i].value;
        found->totals_se[i] = f->fit.total[i].se;
    }
    ceduo_uncertainty_release(&answer);
}

/* ---- usual design ---- */

/* Store a value; all designs have whole groups of equal size. */
static void read_value(void *context, const struct point *point, const struct control_means *at)
{
    double sum = 0;
    for (size_t g = 0; g < CEDUO_SURFACE_GROUPS; g++)
        sum += at[CONTROL(point->scene)].group[g].exceed_probability;
    ((double *)context)[point->row] = sum / CEDUO_SURFACE_GROUPS;
}

/* Fill rows of two independent samples A and B, then for each input A with that column of B. */
static void fill_rows(size_t n, uint64_t seed, double *u)
{
    size_t d = inputs.n;
    double *both = malloc(n * 2 * d * sizeof *both);
    if (!both || ceduo_surface_points(seed, n, 2 * d, both) != CEDUO_OK)
        fail("no memory");
    for (size_t row = 0; row < n * (d + 2); row++)
        for (size_t i = 0; i < d; i++) {
            size_t sample = row / n; /* 0: A, 1: B, 2 + k: A with column k of B */
            u[row * d + i] = both[row % n * 2 * d + i + (sample == 1 || sample == 2 + i ? d : 0)];
        }
    free(both);
}

static void run_rows(const double *u, size_t rows, uint64_t rocks, uint64_t seed, double *y)
{
    file.scene.simulation.seed = seed;
    const struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                              .scene = &file.scene,
                                              .inputs = inputs.items,
                                              .inputs_count = inputs.n,
                                              .rocks = rocks,
                                              .threads = THREADS};
    const struct points points = {.def = &def, .u = u, .today = true, .read = read_value, .context = y};
    if (ceduo_points_run(&points, 0, rows, 0) != CEDUO_OK)
        fail("the sensitivity failed");
}

static void read_band(double *y, size_t n, struct found *found)
{
    gsl_sort(y, 1, n);
    found->band[0] = ceduo_quantile(y, n, .05);
    found->band[1] = ceduo_quantile(y, n, .95);
}

/* `more_rocks`: evaluate the band again with this many rocks. */
static void redraw_inputs(size_t n, uint64_t rocks, uint64_t more_rocks, uint64_t seed, struct found *found)
{
    size_t rows = n * (inputs.n + 2);
    double *u = malloc(rows * inputs.n * sizeof *u), *y = malloc(rows * sizeof *y), start = processor_s();
    if (!u || !y)
        fail("no memory");
    fill_rows(n, seed, u);
    run_rows(u, rows, rocks, seed, y);
    double variance = gsl_stats_variance(y, 1, 2 * n);
    for (size_t i = 0; i < inputs.n; i++) {
        double squares = 0;
        for (size_t p = 0; p < n; p++)
            squares += pow(y[p] - y[(2 + i) * n + p], 2) / (double)n;
        found->totals[i] = squares / 2 / variance;
    }
    if (more_rocks > 0)
        run_rows(u, 2 * n, more_rocks, seed, y);
    read_band(y, 2 * n, found);
    found->evaluations = rows;
    found->seconds = processor_s() - start;
    free(u);
    free(y);
}

static void measure_redraws(size_t points, uint64_t rocks, uint64_t seed, struct found *found)
{
    redraw_inputs(points, rocks, 0, seed, found);
}

/* ---- errors ---- */

static const struct design {
    const char *name;
    void (*by)(size_t points, uint64_t rocks, uint64_t seed, struct found *found);
    size_t points;
    uint64_t rocks;
    size_t times; /* factor for the number of seeds */
} designs[] = {{"surface", measure_surface, 64, 400, 20},    {"surface", measure_surface, 256, 400, 20},
               {"surface", measure_surface, 1024, 400, 1},   {"surface", measure_surface, 256, 1600, 1},
               {"drawn anew", measure_redraws, 16, 400, 1},  {"drawn anew", measure_redraws, 64, 400, 1},
               {"drawn anew", measure_redraws, 256, 400, 1}, {"drawn anew", measure_redraws, 64, 1600, 1}};

/* Sums of squared errors, and counts of errors within 1.96 of the reported one. */
struct errors {
    double squares, held, n;
};

static void add_errors(struct errors *e, size_t n, const double *found, const double *se, const double *truth)
{
    for (size_t i = 0; i < n; i++) {
        e->squares += pow(found[i] - truth[i], 2);
        e->held += fabs(found[i] - truth[i]) <= CEDUO_Z95 * se[i];
    }
    e->n += (double)n;
}

static void measure(const struct design *d, size_t seeds, const struct found *truth)
{
    double seconds = 0;
    struct errors band = {0}, shares = {0};
    struct found found = {0};
    for (size_t s = 0; s < seeds * d->times; s++) {
        d->by(d->points, d->rocks, FIRST_SEED + s, &found);
        add_errors(&band, 2, found.band, found.band_se, truth->band);
        add_errors(&shares, inputs.n, found.totals, found.totals_se, truth->totals);
        seconds += found.seconds;
    }
    printf("%s,%zu,%" PRIu64 ",%" PRIu64 ",%.3f,%.2f,%.2f,", d->name, d->points, d->rocks, found.evaluations,
           seconds / (double)(seeds * d->times), 1000 * sqrt(band.squares / band.n), 100 * sqrt(shares.squares / shares.n));
    printf(d->by == measure_surface ? "%.1f,%.1f\n" : ",\n", 100 * band.held / band.n, 100 * shares.held / shares.n);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t seeds = argument(argv, 1, 10, 1, 1000), true_points = argument(argv, 2, 4096, 2, 1 << 20);
    struct found truth;
    read_scene(&file, "profiles/scenes/paper-site.yaml");
    if (!ceduo_inputs_collect(&file, &inputs) || inputs.n > INPUTS_MAX)
        fail("the inputs cannot be read");
    redraw_inputs(true_points, TRUE_ROCKS, TRUE_BAND_ROCKS, 1, &truth);
    puts("design,points,rocks,scenes,cpu_seconds,band_of_1000,shares_percent,band_held_percent,shares_held_percent");
    for (size_t i = 0; i < sizeof designs / sizeof designs[0]; i++)
        measure(&designs[i], seeds, &truth);
    ceduo_scene_release(&file);
    return 0;
}
