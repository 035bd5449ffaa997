/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A centre at the offset c meets none of its n trees with the chance (1 - p)^n, p the share of its disc that lies in the
 * strip. Integrals go from kink to kink of p by the rule of Gauss and Kronrod with 21 points; towards the kinks, where p goes
 * with a power of 3/2, the points are closer. */
#include "strata.h"

#include <gsl/gsl_integration.h>
#include <math.h>

/* ---- the share of a disc ---- */

/* Of a disc of radius 1 the area left of t. */
static double area_left(double t)
{
    t = fmin(1, fmax(-1, t));
    return t * sqrt(1 - t * t) + asin(t) + M_PI_2;
}

/* And the area left of a and below b. */
static double area_corner(double a, double b)
{
    if (a <= -1 || b <= -1)
        return 0;
    if (a * a + b * b < 1)
        return (area_left(a) + area_left(b)) / 2 - M_PI_4 + a * b;
    if (a < 0 || b < 0)
        return a < 0 && b < 0 ? 0 : area_left(fmin(a, b));
    return area_left(a) + area_left(b) - M_PI;
}

/* ---- integrals ---- */

struct stretch {
    gsl_function of;
    double from, to;
};

/* x = from + (to - from) s2(3 - 2s). */
static double eased(double s, void *context)
{
    const struct stretch *t = context;
    double span = t->to - t->from, x = t->from + span * (s * s * (3 - 2 * s));
    return t->of.function(x, t->of.params) * (span * 6 * s * (1 - s));
}

/* Of a smooth function between two kinks. The bound asks nothing of the rule: more points would not be taken. */
static double integral(double (*of)(double x, void *context), void *context, double from, double to)
{
    struct stretch t = {{of, context}, from, to};
    gsl_function function = {eased, &t};
    double result = 0, error;
    size_t evaluations;
    gsl_integration_qng(&function, 0, 1, HUGE_VAL, 0, &result, &error, &evaluations);
    return result;
}

struct across {
    const struct group_shape *shape;
    double length, x;
};

static double met_at(double y, void *context)
{
    const struct across *a = context;
    double r = a->shape->radius, half = a->shape->width / 2;
    double a0 = -a->x / r, a1 = (a->length - a->x) / r, b0 = (-half - y) / r, b1 = (half - y) / r;
    double area = area_corner(a1, b1) - area_corner(a0, b1) - area_corner(a1, b0) + area_corner(a0, b0);
    return 1 - pow(1 - fmin(1, fmax(0, area / M_PI)), a->shape->n);
}

/* Over all offsets, of centres at x. */
static double met_across(double x, void *context)
{
    struct across a = *(const struct across *)context;
    double half = a.shape->width / 2, r = a.shape->radius, kink = fabs(half - r);
    a.x = x;
    return 2 * (integral(met_at, &a, 0, kink) + integral(met_at, &a, kink, half + r));
}

double ceduo_groups_met_along(const struct group_shape *g, double length)
{
    struct across a = {.shape = g, .length = 4 * g->radius};
    return length * (g->radius > 0 ? met_across(2 * g->radius, &a) : g->width);
}

/* Both ends are alike: twice what is met up to the middle. */
double ceduo_groups_met_within(const struct group_shape *g, double length)
{
    double r = g->radius, middle = length / 2;
    struct across a = {.shape = g, .length = length};
    if (!(r > 0))
        return length * g->width;
    if (length < 2 * r) /* both ends cut a disc in the middle */
        return 2 * (integral(met_across, &a, -r, length - r) + integral(met_across, &a, length - r, middle));
    return 2 * integral(met_across, &a, -r, r) + (middle - r) * 2 * met_across(middle, &a);
}
