/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Count how often the printed 95 % intervals contain the truth, on the paper's site.
 *
 *   bench_coverage [REPEATS [ROCKS]]        default 1000 repeats of 1000 rocks, each with its own seed
 *
 * Three scenes: without forest, with the stems, and the difference between that forest and one with half its stems. The truth
 * comes from runs of many more rocks. CSV on stdout; `scatter` is the standard deviation of the figure over the repeats. Exit 1
 * if an interval of a mean, a probability or a difference contains the truth in fewer than 93 % or more than 97 % of at least
 * 1000 repeats. An interval of whole numbers, for a percentile or a share near 1, contains it slightly more often. */
#include <math.h>
#include <stdio.h>

#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "frame.h"

#define ACCEPTED   100e3
#define TRUE_ROCKS 1000000 /* in each run of the truth */
#define TRUE_RUNS  2

enum {
    BARE_MEAN,
    BARE_P95,
    BARE_REACH,
    BARE_EXCEED,
    BARE_RELEASED,
    WOOD_MEAN,
    WOOD_P95,
    WOOD_REACH,
    WOOD_EXCEED,
    WOOD_RELEASED,
    WOOD_CONTACTS,
    LESS_REACH,
    LESS_EXCEED,
    LESS_RELEASED,
    FIGURES
};
static const char *const names[FIGURES] = {"bare mean energy",
                                           "bare 95 % energy",
                                           "bare reach",
                                           "bare exceed",
                                           "bare energy per released",
                                           "wooded mean energy",
                                           "wooded 95 % energy",
                                           "wooded reach",
                                           "wooded exceed",
                                           "wooded energy per released",
                                           "wooded contacts",
                                           "difference of reach",
                                           "difference of exceed",
                                           "difference of energy per released"};

struct figure {
    double value, lo, hi;
};

struct woods {
    struct paper_site site, half;
};

static struct figure precision(double value, double se)
{
    return (struct figure){value, value - CEDUO_Z95 * se, value + CEDUO_Z95 * se};
}

static struct ceduo_run *simulate(const struct paper_site *site, const struct ceduo_option *option, uint64_t rocks)
{
    struct ceduo_run_def def = ceduo_run_def_default(&site->scene);
    def.option = option;
    def.rocks_max = rocks;
    return simulate_run(&def, rocks);
}

static void read_run(const struct ceduo_run *run, struct figure *to)
{
    struct ceduo_arrivals a;
    if (ceduo_run_arrivals(run, 0, &a) != CEDUO_OK)
        fail("no memory");
    to[0] = precision(a.energy.mean, a.energy.se);
    to[1] = (struct figure){a.energy.p95, a.energy.p95_lo, a.energy.p95_hi};
    to[2] = (struct figure){a.reach.mean, a.reach.lo, a.reach.hi};
    to[3] = (struct figure){a.exceed.mean, a.exceed.lo, a.exceed.hi};
    to[4] = precision(a.energy_per_released.mean, a.energy_per_released.se);
    if (!isnan(a.contacts.mean))
        to[5] = precision(a.contacts.mean, a.contacts.se);
}

static void simulate_all(struct woods *w, uint64_t seed, uint64_t rocks, struct figure figures[FIGURES])
{
    w->site.scene.simulation.seed = seed;
    struct ceduo_run *bare = simulate(&w->site, NULL, rocks), *wood = simulate(&w->site, &w->site.option, rocks),
                     *half = simulate(&w->site, &w->half.option, rocks);
    read_run(bare, &figures[BARE_MEAN]);
    read_run(wood, &figures[WOOD_MEAN]);
    struct ceduo_difference d = ceduo_run_difference(half, wood, 0);
    figures[LESS_REACH] = precision(d.reach.mean, d.reach.se);
    figures[LESS_EXCEED] = precision(d.exceed.mean, d.exceed.se);
    figures[LESS_RELEASED] = precision(d.energy_per_released.mean, d.energy_per_released.se);
    ceduo_run_free(bare);
    ceduo_run_free(wood);
    ceduo_run_free(half);
}

static void init(struct woods *w)
{
    paper_site_init(&w->site);
    paper_site_init(&w->half);
    w->site.control.accepted = ACCEPTED;
    for (int i = 0; i < 2; i++) {
        struct paper_plot *plot = &w->half.plots[i];
        plot->shoots.per_ha /= 2;
        plot->trees.per_ha /= 2;
        plot->stand.stools_per_ha /= 2;
        w->half.belts[i].stand = plot->stand;
    }
}

/* Sums over the repeats of one figure. */
struct found {
    double held, width;
    struct ceduo_moments value;
};

static void note(struct found *f, const struct figure *result, double truth)
{
    f->held += result->lo <= truth && truth <= result->hi;
    f->width += (result->hi - result->lo) / 2;
    ceduo_moments_add(&f->value, result->value);
}

static bool print(int k, const struct found *f, double truth, uint64_t rocks)
{
    double repeats = (double)f->value.n, percent = 100 * f->held / repeats;
    bool whole = k == BARE_P95 || k == WOOD_P95 || k == BARE_REACH;
    printf("%s,%.6g,%.6g,%.3g,%.3g,%.0f,%llu,%.1f\n", names[k], truth, f->value.mean, ceduo_moments_sd(&f->value),
           f->width / repeats, repeats, (unsigned long long)rocks, percent);
    return repeats < 1000 || whole || (percent >= 93 && percent <= 97);
}

int main(int argc, char **argv)
{
    (void)argc;
    uint64_t repeats = argument(argv, 1, 1000, 1, UINT64_MAX), rocks = argument(argv, 2, 1000, 2, TRUE_ROCKS);
    static struct woods w;
    init(&w);
    struct figure figures[FIGURES];
    double truth[FIGURES] = {0};
    static struct found found[FIGURES];
    for (unsigned i = 0; i < TRUE_RUNS; i++) {
        simulate_all(&w, (1u << 20) + i, TRUE_ROCKS, figures);
        for (int k = 0; k < FIGURES; k++)
            truth[k] += figures[k].value / TRUE_RUNS;
    }
    for (uint64_t i = 0; i < repeats; i++) {
        simulate_all(&w, i + 1, rocks, figures);
        for (int k = 0; k < FIGURES; k++)
            note(&found[k], &figures[k], truth[k]);
    }
    bool good = true;
    puts("figure,true_value,mean_value,scatter,mean_half_width,repeats,rocks,held_percent");
    for (int k = 0; k < FIGURES; k++)
        good &= print(k, &found[k], truth[k], rocks);
    return good ? 0 : 1;
}
