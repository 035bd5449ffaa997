/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measure how the error falls with run time, on the paper's site.
 *
 *   bench_error [REPEATS]        default 40 for 1000 rocks, fewer for more rocks
 *
 * First the core, without forest and with its stems, 10^2 to 10^6 rocks: the root mean square error of each figure over repeats
 * with different seeds, and the standard error that the program prints. Then other random numbers in the plain walk: antithetic
 * pairs (u and 1 - u) for the starts or for all draws, and GSL's Sobol points with a random shift (first 40 draws of a rock).
 * Their gain is (error2 x time) of plain numbers over (error2 x time). CSV on stdout. The truth comes from runs with many more
 * rocks. Errors below twice the truth's own error are not printed. */
#include <gsl/gsl_qrng.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "frame.h"

enum { MEAN, P95, REACH, EXCEED, QUANTITIES };
static const char *const quantity_names[QUANTITIES] = {"mean_energy_kJ", "p95_energy_kJ", "reach", "exceed"};

#define ACCEPTED         100e3   /* J; about half of the rocks exceed it */
#define TRUE_ROCKS       1000000 /* in each run of the truth */
#define TRUE_RUNS        8
#define TRUE_RUNS_STEMS  1
#define PLAIN_TRUE_ROCKS 4000000
#define SOBOL_MAX        40
#define STARTS           4 /* draws of a start */

/* Sums over the repeats of one row. */
struct row {
    double seconds, error2[QUANTITIES], se[QUANTITIES];
    size_t repeats;
};

static size_t choose_repeats(size_t asked, uint64_t rocks)
{
    double n = (double)asked * 1000 / (double)rocks * 10;
    return n > 4.0 * (double)asked ? 4 * asked : n < 10 ? 10 : (size_t)n;
}

/* ---- core ---- */

static double run_core(struct paper_site *site, bool stems, uint64_t rocks, uint64_t seed, double value[QUANTITIES],
                       double se[QUANTITIES])
{
    site->scene.simulation.seed = seed;
    site->scene.simulation.rocks = rocks;
    double start = ceduo_clock();
    struct ceduo_run_def def = ceduo_run_def_default(&site->scene);
    def.option = stems ? &site->option : NULL;
    struct ceduo_run *run = simulate_run(&def, rocks);
    struct ceduo_arrivals a;
    if (ceduo_run_arrivals(run, 0, &a) != CEDUO_OK)
        fail("no memory");
    double seconds = ceduo_clock() - start, n = (double)rocks;
    ceduo_run_free(run);
    value[MEAN] = a.energy.mean * 1e-3;
    value[P95] = a.energy.p95 * 1e-3;
    value[REACH] = a.reach.mean;
    value[EXCEED] = a.exceed.mean;
    se[MEAN] = a.energy.se * 1e-3;
    se[P95] = (a.energy.p95_hi - a.energy.p95_lo) * 1e-3 / (2 * CEDUO_Z95);
    se[REACH] = sqrt(a.reach.mean * (1 - a.reach.mean) / n);
    se[EXCEED] = sqrt(a.exceed.mean * (1 - a.exceed.mean) / n);
    return seconds;
}

/* The truth: the means of runs with different seeds, and their standard errors. */
static void find_truth(struct paper_site *site, bool stems, double truth[QUANTITIES], double se[QUANTITIES])
{
    const unsigned runs = stems ? TRUE_RUNS_STEMS : TRUE_RUNS;
    for (unsigned i = 0; i < runs; i++) {
        double value[QUANTITIES], value_se[QUANTITIES];
        run_core(site, stems, TRUE_ROCKS, (1u << 20) + i, value, value_se);
        for (int q = 0; q < QUANTITIES; q++) {
            truth[q] = (i > 0 ? truth[q] : 0) + value[q] / runs;
            se[q] = value_se[q] / sqrt(runs);
        }
    }
}

static void print_row(const char *label, const char *numbers, uint64_t rocks, const struct row *row,
                      const double true_se[QUANTITIES], const struct row *plain)
{
    for (int q = 0; q < QUANTITIES; q++) {
        double rms = sqrt(row->error2[q] / (double)row->repeats);
        if (!(rms >= 2 * true_se[q]))
            continue;
        printf("%s,%s,%" PRIu64 ",%zu,%.3g,%s,%.4g,", label, numbers, rocks, row->repeats, row->seconds / (double)row->repeats,
               quantity_names[q], rms);
        if (!isnan(row->se[q]))
            printf("%.4g", row->se[q] / (double)row->repeats);
        putchar(',');
        if (plain)
            printf("%.3f", plain->error2[q] / (double)plain->repeats * (plain->seconds / (double)plain->repeats) /
                               (rms * rms * (row->seconds / (double)row->repeats)));
        putchar('\n');
    }
    fflush(stdout);
}

static void measure_core(const char *label, bool stems, size_t asked, uint64_t max)
{
    struct paper_site site;
    paper_site_init(&site);
    site.control.accepted = ACCEPTED;
    double truth[QUANTITIES], true_se[QUANTITIES];
    find_truth(&site, stems, truth, true_se);
    for (uint64_t rocks = 100; rocks <= max; rocks *= 10) {
        struct row row = {.repeats = choose_repeats(asked, rocks)};
        for (size_t i = 0; i < row.repeats; i++) {
            double value[QUANTITIES], se[QUANTITIES];
            row.seconds += run_core(&site, stems, rocks, i + 1, value, se);
            for (int q = 0; q < QUANTITIES; q++) {
                row.error2[q] += (value[q] - truth[q]) * (value[q] - truth[q]);
                row.se[q] += se[q];
            }
        }
        print_row(label, "core", rocks, &row, true_se, NULL);
    }
}

/* ---- other random numbers ---- */

enum numbers { PLAIN, ANTITHETIC_STARTS, ANTITHETIC, SOBOL, NUMBERS };
static const char *const numbers_names[NUMBERS] = {"plain", "antithetic-starts", "antithetic", "sobol"};

struct stream {
    enum numbers kind;
    bool spread; /* starts differ */
    uint64_t seed;
    struct line_random random;
    bool mirrored; /* second rock of a pair */
    gsl_qrng *sobol;
    double point[SOBOL_MAX], shift[SOBOL_MAX];
    double *energies;
    size_t n;
};

static double number(struct stream *s, unsigned dimension, bool start)
{
    double u = line_uniform(&s->random, 0, 1);
    if (s->kind == SOBOL && dimension < SOBOL_MAX)
        return fmod(s->point[dimension] + s->shift[dimension], 1);
    return s->mirrored && (s->kind == ANTITHETIC || start) ? 1 - u : u;
}

static void begin(struct stream *s, uint64_t rock, struct slow_def *start)
{
    bool pairs = s->kind == ANTITHETIC || s->kind == ANTITHETIC_STARTS;
    s->mirrored = pairs && rock % 2 == 1;
    s->random.state = s->seed + 0x5851f42d4c957f2d * (pairs ? rock / 2 : rock);
    if (s->kind == SOBOL)
        gsl_qrng_get(s->sobol, s->point);
    if (s->spread) {
        start->vx0 = 0.1 + 2.9 * number(s, 0, true);
        start->vz0 = -2 * number(s, 1, true);
        start->z0 = 3 * number(s, 2, true);
        start->x0 = 9 * number(s, 3, true);
    }
    if (s->kind == ANTITHETIC_STARTS) /* plain numbers from here on */
        s->random.state = s->seed + 0x5851f42d4c957f2d * (2 * rock + 1) + 77;
}

static double draw(void *context, uint64_t contact)
{
    return number(context, STARTS + (unsigned)(contact < SOBOL_MAX ? contact : SOBOL_MAX), false);
}

static double run_plain(struct slow_def def, struct stream *s, uint64_t rocks, uint64_t seed, double value[QUANTITIES])
{
    double sum = 0;
    def.uniform = draw;
    def.context = s;
    s->seed = seed * 0x9e3779b97f4a7c15;
    s->n = 0;
    s->energies = malloc(rocks * sizeof *s->energies);
    if (!s->energies)
        fail("no memory");
    struct line_random random = {.state = s->seed};
    for (int i = 0; i < SOBOL_MAX; i++)
        s->shift[i] = line_uniform(&random, 0, 1);
    if (s->kind == SOBOL)
        gsl_qrng_init(s->sobol);
    double start = ceduo_clock();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        begin(s, rock, &def);
        const struct slow_trajectory trajectory = slow_walk(&def);
        if (trajectory.crossing.reached)
            sum += s->energies[s->n++] = slow_energy(&def, &trajectory.crossing);
    }
    double seconds = ceduo_clock() - start;
    size_t exceeded = 0;
    for (size_t i = 0; i < s->n; i++)
        exceeded += s->energies[i] > ACCEPTED;
    qsort(s->energies, s->n, sizeof *s->energies, by_value);
    value[MEAN] = sum / (double)s->n * 1e-3;
    value[P95] = s->energies[ceduo_quantile_rank(s->n, 0.95) - 1] * 1e-3;
    value[REACH] = (double)s->n / (double)rocks;
    value[EXCEED] = (double)exceeded / (double)rocks;
    free(s->energies);
    return seconds;
}

static void measure_numbers(const char *label, bool spread, size_t asked)
{
    struct paper_site site;
    struct slow_segment segments[PAPER_SEGMENTS];
    paper_site_init(&site);
    const struct slow_def def = slow_scene(&site.scene, segments);
    struct stream source = {.spread = spread, .sobol = gsl_qrng_alloc(gsl_qrng_sobol, SOBOL_MAX)};
    if (!source.sobol)
        fail("no memory");
    double truth[QUANTITIES], true_se[QUANTITIES];
    run_plain(def, &source, PLAIN_TRUE_ROCKS, 1u << 20, truth);
    for (int q = 0; q < QUANTITIES; q++) /* half width for shares; about that of the others */
        true_se[q] = (q == MEAN || q == P95 ? truth[q] * 0.3 : 0.5) / sqrt(PLAIN_TRUE_ROCKS);
    for (uint64_t rocks = 100; rocks <= 100000; rocks *= 10) {
        struct row rows[NUMBERS] = {{0}};
        size_t repeats = choose_repeats(asked, rocks);
        for (size_t i = 0; i < repeats; i++)
            for (int k = 0; k < NUMBERS; k++) { /* by turns, so that other load slows all equally */
                double value[QUANTITIES];
                source.kind = (enum numbers)k;
                rows[k].seconds += run_plain(def, &source, rocks, i + 1, value);
                rows[k].repeats++;
                for (int q = 0; q < QUANTITIES; q++) {
                    rows[k].error2[q] += (value[q] - truth[q]) * (value[q] - truth[q]);
                    rows[k].se[q] = NAN;
                }
            }
        for (int k = 0; k < NUMBERS; k++)
            print_row(label, numbers_names[k], rocks, &rows[k], true_se, &rows[PLAIN]);
    }
    gsl_qrng_free(source.sobol);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t repeats = argument(argv, 1, 40, 1, 1000);
    puts("what,numbers,rocks,repeats,seconds,quantity,rms_error,printed_se,gain");
    measure_core("paper-bare", false, repeats, 1000000);
    measure_core("paper-stems", true, repeats, 100000);
    measure_numbers("one-start", false, repeats);
    measure_numbers("spread-starts", true, repeats);
    return 0;
}
