/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <stddef.h>

#include "base/elementary.h"
#include "rock.h"

#define TRUNCATION_SD   3.0                   /* standard deviations at which a normal distribution is truncated */
#define TRUNCATED_SHARE 0.0013498980316300946 /* probability below -TRUNCATION_SD */

struct ceduo_number ceduo_number(double mean)
{
    return (struct ceduo_number){.mean = mean, .spread = 0, .kind = CEDUO_SPREAD_NORMAL};
}

static double half_range(struct ceduo_number n)
{
    return n.kind == CEDUO_SPREAD_NORMAL ? TRUNCATION_SD * n.spread : n.spread;
}

double ceduo_number_min(struct ceduo_number n)
{
    return n.mean - half_range(n);
}

double ceduo_number_max(struct ceduo_number n)
{
    return n.mean + half_range(n);
}

double ceduo_number_draw(struct ceduo_number n, double u, double lo, double hi)
{
    if (!(n.spread > 0))
        return n.mean;
    double lowest = ceduo_number_min(n), highest = ceduo_number_max(n);
    lo = fmax(lo, lowest);
    hi = fmin(hi, highest);
    if (n.kind == CEDUO_SPREAD_UNIFORM)
        return lo + u * (hi - lo);
    double p_lo = lo == lowest ? TRUNCATED_SHARE : ceduo_normal_cdf((lo - n.mean) / n.spread);
    double p_hi = hi == highest ? 1 - TRUNCATED_SHARE : ceduo_normal_cdf((hi - n.mean) / n.spread);
    double x = n.mean + n.spread * ceduo_normal_quantile(p_lo + u * (p_hi - p_lo));
    return fmin(fmax(x, lo), hi);
}

/* ---- rocks ---- */

/* Sizes of one rock after drawing, in the order of ceduo_rock_def. */
union sizes {
    struct {
        double diameter, height, volume, mass, density, axes[3];
    };
    double values[8];
};

static const struct ceduo_number *size_number(const struct ceduo_rock_def *def, size_t i)
{
    const struct ceduo_number *const numbers[] = {&def->diameter, &def->height,  &def->volume,  &def->mass,
                                                  &def->density,  &def->axes[0], &def->axes[1], &def->axes[2]};
    return numbers[i];
}

/* CEDUO_BAD_ROCK unless all given sizes are > 0, and the sizes that the shape needs are given. */
static enum ceduo_status rock_from_sizes(enum ceduo_shape shape, const union sizes *s, struct ceduo_rock *rock)
{
    bool good = true;
    double d = s->diameter, h = s->height, a[3] = {s->axes[0], s->axes[1], s->axes[2]}, longest, squares;
    for (size_t i = 0; i < 8; i++)
        good = good && !(s->values[i] <= 0) && !isinf(s->values[i]);
    switch (shape) {
    case CEDUO_SHAPE_SPHERE:
        if (isnan(d))
            d = ceduo_cbrt(6 * (isnan(s->volume) ? s->mass / s->density : s->volume) / M_PI);
        good = good && !(isnan(s->diameter) && isnan(s->volume) && isnan(s->mass));
        rock->volume = M_PI / 6 * d * d * d;
        rock->mean_diameter = a[0] = a[1] = a[2] = d;
        rock->k = 2.0 / 5;
        break;
    case CEDUO_SHAPE_CYLINDER:
        rock->volume = M_PI / 4 * d * d * h;
        rock->mean_diameter = (d + h) / 2;
        a[0] = a[1] = d;
        a[2] = h;
        rock->k = 1.0 / 2;
        break;
    case CEDUO_SHAPE_ELLIPSOID:
        rock->volume = M_PI / 6 * a[0] * a[1] * a[2];
        rock->mean_diameter = (a[0] + a[1] + a[2]) / 3;
        rock->k = 2.0 / 5;
        break;
    case CEDUO_SHAPE_BLOCK:
        longest = fmax(a[0], fmax(a[1], a[2]));
        squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2] - longest * longest;
        rock->volume = a[0] * a[1] * a[2];
        rock->mean_diameter = (a[0] + a[1] + a[2]) / 3;
        rock->k = squares / (12 * (rock->mean_diameter / 2) * (rock->mean_diameter / 2));
        break;
    }
    for (int i = 0; i < 3; i++) {
        rock->axes[i] = a[i];
        good = good && !isnan(a[i]);
    }
    rock->mass = isnan(s->mass) ? rock->volume * s->density : s->mass;
    rock->radius = rock->mean_diameter / 2;
    rock->moment = rock->k * rock->mass * rock->radius * rock->radius;
    good = good && rock->moment > 0 && isfinite(rock->moment); /* implies mass and radius > 0 */
    return good ? CEDUO_OK : CEDUO_BAD_ROCK;
}

enum ceduo_status ceduo_rock_from_means(const struct ceduo_rock_def *def, struct ceduo_rock *rock)
{
    union sizes s;
    for (size_t i = 0; i < 8; i++)
        s.values[i] = size_number(def, i)->mean;
    return rock_from_sizes(def->shape, &s, rock);
}

struct ceduo_rock ceduo_rock_mean(const struct ceduo_rock_def *def)
{
    struct ceduo_rock rock;
    return ceduo_rock_from_means(def, &rock) == CEDUO_OK ? rock
                                                         : (struct ceduo_rock){NAN, NAN, NAN, NAN, NAN, NAN, {NAN, NAN, NAN}};
}

bool ceduo_rock_varies(const struct ceduo_rock_def *def)
{
    for (size_t i = 0; i < 8; i++)
        if (size_number(def, i)->spread > 0)
            return true;
    return false;
}

enum ceduo_status ceduo_rock_draw(const struct ceduo_rock_def *def, const double u[8], struct ceduo_rock *rock)
{
    union sizes s;
    for (size_t i = 0; i < 8; i++)
        s.values[i] = ceduo_number_draw(*size_number(def, i), u[i], 0, INFINITY);
    return rock_from_sizes(def->shape, &s, rock);
}
