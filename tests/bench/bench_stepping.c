/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compare an exact solution of a flight with time steps: errors and cost.
 *
 *   bench_stepping [FLIGHTS]        default 2000
 *
 * Flights leave random places of the paper's slope with random speeds. The core solves a quadratic for the segment that is hit.
 * The alternatives: a fixed step with the exact parabola between steps (the contact lies on the straight line between the last
 * two points), a fixed step by Euler's rule (speed first), and GSL's Runge-Kutta-Fehlberg 4(5) driver with bounded local error,
 * which bisects the last step. The error is the distance along the ground to the exact contact. A step can also pass through a
 * corner and land elsewhere: contacts more than 1 m away are counted separately. CSV on stdout. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/walk/landing.h"
#include "frame.h"
#include "scene/slope.h"

#define STEPS_MAX 100000000
#define MISSED    1.0 /* m */

struct launch {
    struct contact contact;
    struct flight from;
    double x; /* exact contact */
};

/* Return the height above ground; the first and last segment extend beyond the ends. */
static double height(const struct ground *g, double x, double z, size_t *segment)
{
    size_t j = *segment;
    while (j + 1 < g->n && x >= g->vertices[j + 1].x)
        j++;
    while (j > 0 && x < g->vertices[j].x)
        j--;
    *segment = j;
    return z - (g->vertices[j].z + ground_slope(g, j) * (x - g->vertices[j].x));
}

static double solve_quadratic(const struct ground *g, const struct launch *l, double step)
{
    (void)step;
    return next_contact(g, &l->contact, &l->from, false).x;
}

/* Return x of the intersection of the line from (x0, h0 >= 0) to (x1, h1 < 0) with the ground. */
static double intersect_ground(double x0, double h0, double x1, double h1)
{
    return x0 + (x1 - x0) * h0 / (h0 - h1);
}

static double step_parabola(const struct ground *g, const struct launch *l, double step)
{
    const struct flight *f = &l->from;
    size_t segment = f->segment;
    double x0 = f->x, h0 = 0;
    for (long i = 1; i < STEPS_MAX; i++) {
        double t = (double)i * step, x = f->x + f->vx * t, z = f->z + (f->vz - g->half_g * t) * t;
        double h = height(g, x, z, &segment);
        if (h < 0)
            return intersect_ground(x0, h0, x, h);
        x0 = x;
        h0 = h;
    }
    return NAN;
}

static double step_euler(const struct ground *g, const struct launch *l, double step)
{
    double x = l->from.x, z = l->from.z, vz = l->from.vz, h0 = 0;
    size_t segment = l->from.segment;
    for (long i = 1; i < STEPS_MAX; i++) {
        double x0 = x;
        vz -= g->gravity * step;
        x += l->from.vx * step;
        z += vz * step;
        double h = height(g, x, z, &segment);
        if (h < 0)
            return intersect_ground(x0, h0, x, h);
        h0 = h;
    }
    return NAN;
}

static int falling(double t, const double y[], double dydt[], void *params)
{
    (void)t;
    dydt[0] = y[2];
    dydt[1] = y[3];
    dydt[2] = 0;
    dydt[3] = -*(const double *)params;
    return GSL_SUCCESS;
}

/* Integrate with GSL's driver. A step is at most a tenth of a second: longer steps pass over corners. */
static double step_gsl(const struct ground *g, const struct launch *l, double tolerance)
{
    double gravity = g->gravity, t = 0, result = NAN;
    gsl_odeiv2_system system = {falling, NULL, 4, &gravity};
    gsl_odeiv2_driver *d = gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rkf45, 1e-3, tolerance, 0);
    double y[4] = {l->from.x, l->from.z, l->from.vx, l->from.vz}, step = 0.1;
    size_t segment = l->from.segment;
    double h0 = 0;
    for (long i = 0; d && i < STEPS_MAX; i++) {
        double before[4] = {y[0], y[1], y[2], y[3]}, t0 = t;
        if (gsl_odeiv2_driver_apply(d, &t, t0 + step, y) != GSL_SUCCESS)
            break;
        double h = height(g, y[0], y[1], &segment);
        if (h >= 0) {
            h0 = h;
            continue;
        }
        if (step <= tolerance || step < 1e-12) {
            result = intersect_ground(before[0], h0, y[0], h);
            break;
        }
        for (int k = 0; k < 4; k++) /* step back, then halve */
            y[k] = before[k];
        t = t0;
        step /= 2;
        gsl_odeiv2_driver_reset(d);
    }
    gsl_odeiv2_driver_free(d);
    return result;
}

static void measure(const struct ground *g, const struct launch *launches, size_t n, const char *label, double step,
                    double (*contact)(const struct ground *, const struct launch *, double))
{
    double sum2 = 0, max = 0, start = processor_s();
    size_t missed = 0, close = 0;
    for (size_t i = 0; i < n; i++) {
        double off = fabs(contact(g, &launches[i], step) - launches[i].x);
        if (!(off <= MISSED)) {
            missed++;
            continue;
        }
        close++;
        sum2 += off * off;
        max = fmax(max, off);
    }
    double seconds = processor_s() - start;
    printf("%s,%g,%zu,%.3g,%.3g,%.3g,%zu\n", label, step, n, seconds / (double)n * 1e9, sqrt(sum2 / (double)close), max,
           missed);
    fflush(stdout);
}

int main(int argc, char **argv)
{
    (void)argc;
    size_t n = argument(argv, 1, 2000, 1, SIZE_MAX - 1);
    static struct paper_site site;
    paper_site_init(&site);
    struct ground g;
    struct launch *launches = calloc(n + 1, sizeof *launches);
    if (!launches || !ceduo_ground_init(&g, &site.scene.slope, CEDUO_GRAVITY, 0.34, false))
        return 1;
    struct line_random random = {.state = 7};
    for (size_t i = 0; i < n;) {
        double x = line_uniform(&random, 0, 150), along = line_uniform(&random, 0, 20), off = line_uniform(&random, 0.2, 6.2);
        size_t j = ceduo_slope_segment(&site.scene.slope, x);
        struct contact contact = {j, ground_along(&g, j, x), along, off};
        struct flight f = begin_flight(&g, &contact);
        struct landing l = next_contact(&g, &contact, &f, false);
        if (!l.off_slope)
            launches[i++] = (struct launch){contact, f, l.x};
    }
    puts("what,step_s_or_tolerance,flights,ns_per_flight,rms_error_m,largest_error_m,beyond_1_m");
    for (int repeat = 0; repeat < 200; repeat++) /* warm, and long enough to time */
        solve_quadratic(&g, &launches[(size_t)repeat % n], 0);
    measure(&g, launches, n, "exact", 0, solve_quadratic);
    for (double step = 1e-1; step > 0.9e-5; step /= 10) {
        measure(&g, launches, n, "parabola-steps", step, step_parabola);
        measure(&g, launches, n, "euler-steps", step, step_euler);
        measure(&g, launches, n, "gsl-rkf45", step, step_gsl);
    }
    free(launches);
    ceduo_ground_release(&g);
    return 0;
}
