/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare the observed stops of 80 rocks of three shapes at Tschamut (profiles/scenes/tschamut-arm.yaml) with each contact law.
 *
 *   bench_tschamut [POINTS [ROCKS]]        default 4096, 500
 *
 * Fits four values of the ground: Rn, roughness and friction, with Rt or, for arm, mu. Evaluates POINTS grounds of a Sobol
 * sequence, then starts simplexes from the best three. Prints CSV, one line for each law and question:
 *   block1   ground that fits block 1 best, and its prediction of the other two
 *   all      ground that fits all three blocks best
 *   share    grounds not refuted by block 1; number of them that predict block 2, the plate, and both
 * Distances are Kolmogorov-Smirnov distances, with 10 times the rocks and another seed. A block is predicted if its distance is
 * below the 95 % point of a sample of its size. arm-round is arm with each block a sphere of its mean diameter. */
#include <gsl/gsl_multimin.h>
#include <gsl/gsl_qrng.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "frame.h"
#include "physics/stops.h"
#include "study/observe.h"

#define BLOCKS     3
#define VALUES     4
#define POINTS_MAX 4096
#define STARTS     3
#define STEPS      60

static const double lower_bounds[VALUES] = {0.02, 0, 0.1, 0}, upper_bounds[VALUES] = {0.95, 0.8, 1.2, 0};

struct site {
    struct scene_file file;
    struct ceduo_observer *observer;
    const struct ceduo_observation *observed;
    double critical[BLOCKS];
    uint64_t rocks;
    double lo[VALUES], hi[VALUES];
    size_t blocks; /* fitted: the first ones */
};

struct fit {
    double values[VALUES], distance[BLOCKS], mean[BLOCKS], misfit;
};

/* ---- one ground ---- */

static void set_ground(struct ceduo_scene *scene, const double values[VALUES])
{
    for (size_t j = 0; j + 1 < scene->slope.vertices; j++) {
        struct ceduo_segment *s = &scene->slope.segments[j];
        s->rn = ceduo_number(values[0]);
        s->roughness_rad = values[1];
        s->friction = values[2];
        if (scene->simulation.law == CEDUO_LAW_ARM)
            s->mu = values[3];
        else
            s->rt = ceduo_number(values[3]);
    }
}

static void evaluate(struct site *site, struct fit *f, size_t from, size_t to, uint64_t rocks)
{
    set_ground(&site->file.scene, f->values);
    for (size_t b = from; b < to; b++) {
        double *values;
        size_t n;
        if (ceduo_observer_values(site->observer, &site->file.scene, b, rocks, &values, &n) != CEDUO_OK)
            fail("the run failed");
        f->distance[b] = stops_distance(&site->observed[b], values, n, &f->mean[b]);
        if (isnan(f->distance[b]))
            fail("no memory");
        free(values);
    }
    f->misfit = 0;
    for (size_t b = 0; b < to; b++)
        f->misfit = fmax(f->misfit, f->distance[b] / site->critical[b]);
}

static double misfit_of_vector(const gsl_vector *v, void *context)
{
    struct site *site = context;
    struct fit f;
    for (size_t i = 0; i < VALUES; i++) {
        f.values[i] = gsl_vector_get(v, i);
        if (!(f.values[i] >= site->lo[i] && f.values[i] <= site->hi[i]))
            return 10;
    }
    evaluate(site, &f, 0, site->blocks, site->rocks);
    return f.misfit;
}

/* Minimize the misfit from a start. */
static void descend(struct site *site, struct fit *f)
{
    gsl_vector *start = gsl_vector_alloc(VALUES), *step = gsl_vector_alloc(VALUES);
    gsl_multimin_fminimizer *m = gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, VALUES);
    gsl_multimin_function function = {.f = misfit_of_vector, .n = VALUES, .params = site};
    for (size_t i = 0; i < VALUES; i++) {
        double width = site->hi[i] - site->lo[i];
        gsl_vector_set(start, i, f->values[i]);
        gsl_vector_set(step, i, f->values[i] + width / 10 > site->hi[i] ? -width / 10 : width / 10);
    }
    gsl_multimin_fminimizer_set(m, &function, start, step);
    for (int i = 0; i < STEPS && gsl_multimin_fminimizer_iterate(m) == GSL_SUCCESS; i++)
        continue;
    for (size_t i = 0; i < VALUES; i++)
        f->values[i] = gsl_vector_get(m->x, i);
    f->misfit = m->fval;
    gsl_multimin_fminimizer_free(m);
    gsl_vector_free(step);
    gsl_vector_free(start);
}

static int by_misfit(const void *a, const void *b)
{
    const struct fit *f = a, *g = b;
    return (f->misfit > g->misfit) - (f->misfit < g->misfit);
}

/* Return the best fit of simplexes from the best STARTS points. */
static struct fit find_best_fit(struct site *site, struct fit *points, size_t n, size_t blocks)
{
    site->blocks = blocks;
    qsort(points, n, sizeof *points, by_misfit);
    struct fit best = points[0];
    for (size_t i = 0; i < STARTS && i < n; i++) {
        struct fit f = points[i];
        descend(site, &f);
        if (f.misfit < best.misfit)
            best = f;
    }
    return best;
}

/* ---- one law ---- */

static void print_fit(struct site *site, const char *question, const char *law, struct fit f)
{
    uint64_t seed = site->file.scene.simulation.seed;
    site->file.scene.simulation.seed = seed + 1;
    evaluate(site, &f, 0, BLOCKS, 10 * site->rocks);
    site->file.scene.simulation.seed = seed;
    printf("%s,%s,%.3f,%.3f,%.3f,%.3f", question, law, f.values[0], f.values[1], f.values[2], f.values[3]);
    for (size_t b = 0; b < BLOCKS; b++)
        printf(",%.3f", f.distance[b]);
    for (size_t b = 0; b < BLOCKS; b++)
        printf(",%.1f", f.mean[b]);
    puts(",,,,");
    fflush(stdout);
}

/* Print the number of points that block 1 does not refute, and how many also predict block 2, the plate, and both. */
static void print_shares(const struct site *site, const char *law, const struct fit *points, size_t n)
{
    size_t good = 0, second = 0, plate = 0, both = 0;
    for (size_t i = 0; i < n; i++) {
        bool predicts[BLOCKS];
        for (size_t b = 0; b < BLOCKS; b++)
            predicts[b] = points[i].distance[b] <= site->critical[b];
        good += predicts[0];
        second += predicts[0] && predicts[1];
        plate += predicts[0] && predicts[2];
        both += predicts[0] && predicts[1] && predicts[2];
    }
    printf("share,%s,,,,,,,,,,,%zu,%zu,%zu,%zu\n", law, good, second, plate, both);
    fflush(stdout);
}

static void measure_law(struct site *site, enum ceduo_law law, const char *name, size_t n)
{
    static struct fit points[POINTS_MAX];
    gsl_qrng *sobol = gsl_qrng_alloc(gsl_qrng_sobol, VALUES);
    bool arm = law == CEDUO_LAW_ARM;
    site->file.scene.simulation.law = law;
    for (size_t i = 0; i < VALUES; i++) {
        site->lo[i] = i == 3 ? (arm ? 0.2 : 0.3) : lower_bounds[i];
        site->hi[i] = i == 3 ? (arm ? 1.5 : 0.98) : upper_bounds[i];
    }
    for (size_t p = 0; p < n; p++) {
        double u[VALUES];
        gsl_qrng_get(sobol, u);
        for (size_t i = 0; i < VALUES; i++)
            points[p].values[i] = site->lo[i] + u[i] * (site->hi[i] - site->lo[i]);
        evaluate(site, &points[p], 0, 1, site->rocks);
    }
    gsl_qrng_free(sobol);
    print_fit(site, "block1", name, find_best_fit(site, points, n, 1));
    for (size_t p = 0; p < n; p++)
        if (points[p].distance[0] <= 2 * site->critical[0])
            evaluate(site, &points[p], 1, BLOCKS, site->rocks);
        else
            points[p].distance[1] = points[p].distance[2] = points[p].misfit = INFINITY;
    print_shares(site, name, points, n);
    print_fit(site, "all", name, find_best_fit(site, points, n, BLOCKS));
}

/* ---- the site ---- */

static void read_site(struct site *site)
{
    read_scene(&site->file, "profiles/scenes/tschamut-arm.yaml");
    if (site->file.observations_count != BLOCKS)
        fail("there are other blocks");
    site->observed = site->file.observations;
    if (ceduo_observer_create(site->observed, BLOCKS, &site->observer) != CEDUO_OK)
        fail("no memory");
    for (size_t b = 0; b < BLOCKS; b++)
        site->critical[b] = stops_critical_distance(site->observed[b].n);
}

/* Replace each block by a sphere of the same mean diameter. */
static void make_round(struct site *site)
{
    static struct ceduo_observation round[BLOCKS];
    static struct ceduo_rock_def rocks[BLOCKS];
    for (size_t b = 0; b < BLOCKS; b++) {
        round[b] = site->observed[b];
        const struct ceduo_rock_def *rock = round[b].rock ? round[b].rock : &site->file.scene.rock;
        rocks[b] = ceduo_scene_default().rock;
        rocks[b].diameter = ceduo_number(ceduo_rock_mean(rock).mean_diameter);
        round[b].rock = &rocks[b];
    }
    ceduo_observer_free(site->observer);
    if (ceduo_observer_create(round, BLOCKS, &site->observer) != CEDUO_OK)
        fail("no memory");
    site->observed = round;
}

int main(int argc, char **argv)
{
    static struct site site;
    (void)argc;
    size_t points = argument(argv, 1, 4096, STARTS, POINTS_MAX);
    site.rocks = argument(argv, 2, 500, 1, UINT64_MAX);
    read_site(&site);
    puts("what,law,rn,roughness_rad,friction,rt_or_mu,ks_block1,ks_block2,ks_plate,mean_block1_m,mean_block2_m,mean_plate_m,"
         "not_refuted,predict_block2,predict_plate,predict_both");
    printf("band,,,,,,%.3f,%.3f,%.3f,,,,,,,\n", site.critical[0], site.critical[1], site.critical[2]);
    measure_law(&site, CEDUO_LAW_LUMPED, "lumped", points);
    measure_law(&site, CEDUO_LAW_CRSP, "crsp", points);
    measure_law(&site, CEDUO_LAW_ARM, "arm", points);
    make_round(&site);
    measure_law(&site, CEDUO_LAW_ARM, "arm-round", points);
    ceduo_observer_free(site.observer);
    ceduo_scene_release(&site.file);
    return 0;
}
