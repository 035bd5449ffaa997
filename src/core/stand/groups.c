/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A group with centre at offset c has no tree in the strip with probability (1 - p)^n, p the share of its disc in the strip.
 * Integrals between kinks of p use the 21-point Gauss-Kronrod rule. Points are closer near the kinks, at which p has a power of
 * 3/2. */
#include "strata.h"

#include <gsl/gsl_integration.h>
#include <math.h>

/* ---- the share of a disc ---- */

/* Return the area of a disc of radius 1 left of t. */
static double area_left_of(double t)
{
    t = fmin(1, fmax(-1, t));
    return t * sqrt(1 - t * t) + asin(t) + M_PI_2;
}

/* Return its area left of a and below b. */
static double area_corner(double a, double b)
{
    if (a <= -1 || b <= -1)
        return 0;
    if (a * a + b * b < 1)
        return (area_left_of(a) + area_left_of(b)) / 2 - M_PI_4 + a * b;
    if (a < 0 || b < 0)
        return a < 0 && b < 0 ? 0 : area_left_of(fmin(a, b));
    return area_left_of(a) + area_left_of(b) - M_PI;
}

/* ---- integrals ---- */

struct interval {
    gsl_function f;
    double from, to;
};

/* Substitution x = from + (to - from) s2(3 - 2s). */
static double substituted(double s, void *context)
{
    const struct interval *t = context;
    double span = t->to - t->from, x = t->from + span * (s * s * (3 - 2 * s));
    return t->f.function(x, t->f.params) * (span * 6 * s * (1 - s));
}

/* Integrate a smooth function between two kinks. The infinite tolerance fixes the rule at 21 points. */
static double integral(double (*f)(double x, void *context), void *context, double from, double to)
{
    struct interval t = {{f, context}, from, to};
    gsl_function function = {substituted, &t};
    double result = 0, error;
    size_t evaluations;
    gsl_integration_qng(&function, 0, 1, HUGE_VAL, 0, &result, &error, &evaluations);
    return result;
}

struct strip {
    const struct group_shape *shape;
    double length, x;
};

static double hit_chance(double y, void *context)
{
    const struct strip *a = context;
    double r = a->shape->radius, half = a->shape->width / 2;
    double a0 = -a->x / r, a1 = (a->length - a->x) / r, b0 = (-half - y) / r, b1 = (half - y) / r;
    double area = area_corner(a1, b1) - area_corner(a0, b1) - area_corner(a1, b0) + area_corner(a0, b0);
    return 1 - pow(1 - fmin(1, fmax(0, area / M_PI)), a->shape->n);
}

/* Integrate over all offsets, for centres at x. */
static double hit_chance_at_x(double x, void *context)
{
    struct strip a = *(const struct strip *)context;
    double half = a.shape->width / 2, r = a.shape->radius, kink = fabs(half - r);
    a.x = x;
    return 2 * (integral(hit_chance, &a, 0, kink) + integral(hit_chance, &a, kink, half + r));
}

double ceduo_groups_met_along(const struct group_shape *shape, double length)
{
    struct strip a = {.shape = shape, .length = 4 * shape->radius};
    return length * (shape->radius > 0 ? hit_chance_at_x(2 * shape->radius, &a) : shape->width);
}

/* Both ends are symmetric: twice the integral up to the middle. */
double ceduo_groups_met_within(const struct group_shape *shape, double length)
{
    double r = shape->radius, middle = length / 2;
    struct strip a = {.shape = shape, .length = length};
    if (!(r > 0))
        return length * shape->width;
    if (length < 2 * r) /* both ends cut a central disc */
        return 2 * (integral(hit_chance_at_x, &a, -r, length - r) + integral(hit_chance_at_x, &a, length - r, middle));
    return 2 * integral(hit_chance_at_x, &a, -r, r) + (middle - r) * 2 * hit_chance_at_x(middle, &a);
}
