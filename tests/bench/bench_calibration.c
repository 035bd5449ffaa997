/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whether a calibration may be trusted, on sites whose ground is known because ceduo made what was seen on them: values are
 * drawn in their bounds, some rocks are released and seen to stop and to pass a place, and the values are fitted again. The 95 %
 * ranges must hold the truth in 95 % of the sites, p must be uniform, and what another law made must be found out.
 *
 *     bench_calibration [SITES [ROCKS]]
 *
 * prints CSV: what, sites, seen, value. */
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/calibrate.h"
#include "base/clock.h"

#define VALUES  3
#define KINDS   3
#define PLACE   60 /* m, where rocks were seen to pass */
#define VERTICES 6

static const double bounds[VALUES][2] = {{0.25, 0.5}, {0.75, 0.95}, {0.05, 0.4}};
static const char *const names[VALUES] = {"rn", "rt", "roughness_rad"};

/* A quarry face, its scree and the level ground below. */
struct site {
    struct ceduo_scene scene;
    double x[VERTICES], z[VERTICES];
    struct ceduo_segment segments[VERTICES - 1];
    struct ceduo_option option;
    char paths[VALUES][VERTICES - 1][40];
    const char *places[VALUES][VERTICES - 1];
    struct ceduo_input inputs[VALUES];
};

static void make_site(struct site *s, enum ceduo_law law, const double *truth, uint64_t seed)
{
    static const double x[VERTICES] = {0, 15, 40, 60, 90, 300}, z[VERTICES] = {60, 42, 20, 8, 2, 0};
    *s = (struct site){.scene = ceduo_scene_default(), .option = {.name = (char *)(uintptr_t) "bare"}};
    memcpy(s->x, x, sizeof x);
    memcpy(s->z, z, sizeof z);
    for (size_t j = 0; j + 1 < VERTICES; j++)
        s->segments[j] = (struct ceduo_segment){.rn = ceduo_number(truth[0]),
                                                .rt = ceduo_number(truth[1]),
                                                .roughness_m = NAN,
                                                .roughness_rad = truth[2],
                                                .friction = 0.5};
    s->scene.slope = (struct ceduo_slope){
        .vertices = VERTICES, .x = s->x, .z = s->z, .segments = s->segments, .segments_given = VERTICES - 1};
    s->scene.rock.shape = CEDUO_SPHERE;
    s->scene.rock.diameter = ceduo_number(0.8);
    s->scene.rock.density = ceduo_number(2600);
    s->scene.release.height = ceduo_number(2);
    s->scene.release.vx = ceduo_number(0.5);
    s->scene.options = &s->option;
    s->scene.options_count = 1;
    s->scene.simulation.law = law;
    s->scene.simulation.seed = seed;
    for (size_t i = 0; i < VALUES; i++) {
        for (size_t j = 0; j + 1 < VERTICES; j++) {
            snprintf(s->paths[i][j], sizeof s->paths[i][j], "slope.segments[%zu].%s", j, names[i]);
            s->places[i][j] = s->paths[i][j];
        }
        s->inputs[i] = (struct ceduo_input){.path = names[i],
                                            .kind = CEDUO_INPUT_RANGE,
                                            .lo = bounds[i][0],
                                            .hi = bounds[i][1],
                                            .places_count = VERTICES - 1,
                                            .places = s->places[i]};
    }
}

/* What is seen of `rocks` rocks: where they stop, and speed and height at a place. False where too few pass or stop. */
static bool see(const struct site *s, uint64_t rocks, double **values, struct ceduo_observation *seen)
{
    static const enum ceduo_observed_kind kinds[KINDS] = {CEDUO_OBSERVED_STOPS, CEDUO_OBSERVED_SPEED, CEDUO_OBSERVED_HEIGHT};
    struct ceduo_observer *observer = NULL;
    bool good = true;
    for (size_t k = 0; k < KINDS; k++)
        seen[k] = (struct ceduo_observation){.kind = kinds[k], .name = "", .x = PLACE, .from = NAN, .to = NAN, .share_seen = NAN};
    if (ceduo_observer_create(seen, KINDS, &observer) != CEDUO_OK)
        return false;
    for (size_t k = 0; k < KINDS && good; k++) {
        size_t n, m = 0;
        good = ceduo_observer_values(observer, &s->scene, k, rocks, &values[k], &n) == CEDUO_OK;
        for (size_t i = 0; good && i < n; i++)
            if (!isnan(values[k][i]))
                values[k][m++] = values[k][i];
        gsl_sort(values[k], 1, m);
        seen[k].values = values[k];
        seen[k].n = m;
        seen[k].of = k == 0 ? rocks : 0;
        good = good && m >= 5;
    }
    ceduo_observer_free(observer);
    return good;
}

static bool fit(struct site *s, const struct ceduo_observation *seen, uint64_t rocks, struct ceduo_calibration *a)
{
    struct ceduo_calibration_scene scene = {&s->scene, s->inputs, KINDS, seen};
    struct ceduo_calibration_def def = {.scenes_count = 1,
                                        .scenes = &scene,
                                        .parameters_count = VALUES,
                                        .rocks = rocks,
                                        .seed = s->scene.simulation.seed,
                                        .threads = 2};
    return ceduo_calibrate(&def, a) == CEDUO_OK;
}

/* One site: its truth is drawn, seen and fitted. */
static bool try_site(size_t number, enum ceduo_law made_by, uint64_t seen_rocks, uint64_t rocks, double *truth,
                     struct ceduo_calibration *a)
{
    struct site made, fitted;
    struct ceduo_observation seen[KINDS];
    double *values[KINDS] = {0};
    uint64_t state = 1000 * number + 77 * made_by;
    for (size_t i = 0; i < VALUES; i++) { /* splitmix64 */
        uint64_t z = state += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        truth[i] = bounds[i][0] + (bounds[i][1] - bounds[i][0]) * ((double)((z ^ z >> 31) >> 11) * 0x1p-53);
    }
    make_site(&made, made_by, truth, 100000 + number);
    make_site(&fitted, CEDUO_LAW_LUMPED, truth, 1 + number);
    bool good = see(&made, seen_rocks, values, seen) && fit(&fitted, seen, rocks, a);
    for (size_t k = 0; k < KINDS; k++)
        free(values[k]);
    return good;
}

/* Distance of n values to the uniform law. */
static double kolmogorov(double *p, size_t n)
{
    double most = 0;
    gsl_sort(p, 1, n);
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fmax(p[i] - (double)i / (double)n, (double)(i + 1) / (double)n - p[i]));
    return most;
}

static void cover(size_t sites, uint64_t seen_rocks, uint64_t rocks)
{
    double inside[VALUES] = {0}, flagged = 0, evaluations = 0;
    double *p = calloc(KINDS * sites, sizeof *p);
    size_t done = 0, undetermined = 0;
    for (size_t i = 0; i < sites && p; i++) {
        struct ceduo_calibration a;
        double truth[VALUES];
        if (!try_site(i, CEDUO_LAW_LUMPED, seen_rocks, rocks, truth, &a))
            continue;
        for (size_t k = 0; k < VALUES; k++) {
            inside[k] += truth[k] >= a.parameters[k].p2_5 && truth[k] <= a.parameters[k].p97_5;
            undetermined += !a.parameters[k].determined;
        }
        for (size_t k = 0; k < KINDS; k++)
            p[k * sites + done] = a.predicted[k].p_value;
        flagged += a.misfit;
        evaluations += (double)a.evaluations;
        done++;
        ceduo_calibration_free(&a);
    }
    double n = (double)done;
    for (size_t k = 0; k < VALUES; k++)
        printf("coverage of %s,%zu,%llu,%.3f\n", names[k], done, (unsigned long long)seen_rocks, inside[k] / n);
    printf("coverage of all,%zu,%llu,%.3f\n", done, (unsigned long long)seen_rocks, (inside[0] + inside[1] + inside[2]) / (VALUES * n));
    for (size_t k = 0; k < KINDS; k++)
        printf("KS distance of p %s,%zu,%llu,%.3f\n", k == 0 ? "of stops" : k == 1 ? "of speeds" : "of heights", done,
               (unsigned long long)seen_rocks, kolmogorov(p + k * sites, done));
    printf("flagged as misfit,%zu,%llu,%.3f\n", done, (unsigned long long)seen_rocks, flagged / n);
    printf("not determined,%zu,%llu,%.3f\n", done, (unsigned long long)seen_rocks, (double)undetermined / (VALUES * n));
    printf("evaluations of a fit,%zu,%llu,%.0f\n", done, (unsigned long long)seen_rocks, evaluations / n);
    free(p);
}

static void find_out(size_t sites, uint64_t seen_rocks, uint64_t rocks)
{
    size_t done = 0, flagged = 0;
    for (size_t i = 0; i < sites; i++) {
        struct ceduo_calibration a;
        double truth[VALUES];
        if (!try_site(i, CEDUO_LAW_CRSP, seen_rocks, rocks, truth, &a))
            continue;
        flagged += a.misfit;
        done++;
        ceduo_calibration_free(&a);
    }
    printf("flagged where crsp made it,%zu,%llu,%.3f\n", done, (unsigned long long)seen_rocks, (double)flagged / (double)done);
}

int main(int argc, char **argv)
{
    size_t sites = argc > 1 ? strtoul(argv[1], NULL, 10) : 40;
    uint64_t rocks = argc > 2 ? strtoul(argv[2], NULL, 10) : CEDUO_CALIBRATION_ROCKS;
    double start = ceduo_clock();
    printf("what,sites,seen,value\n");
    cover(sites, 50, rocks);
    find_out(sites, 200, rocks);
    fprintf(stderr, "%.0f s\n", ceduo_clock() - start);
    return 0;
}
