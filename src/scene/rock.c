/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/rock.h"

#include <math.h>
#include <stddef.h>

#include "base/elementary.h"

/* The sizes of one rock, all drawn: the numbers of a def, in its order. */
union sizes {
    struct {
        double diameter, height, volume, mass, density, axes[3];
    };
    double all[8];
};

static const struct ceduo_number *number_of(const struct ceduo_rock_def *def, size_t i)
{
    const struct ceduo_number *const numbers[] = {&def->diameter, &def->height,  &def->volume,  &def->mass,
                                                  &def->density,  &def->axes[0], &def->axes[1], &def->axes[2]};
    return numbers[i];
}

static void set_axes(struct ceduo_rock *rock, double a, double b, double c)
{
    rock->axes[0] = a;
    rock->axes[1] = b;
    rock->axes[2] = c;
}

static void complete_sphere(union sizes *s, struct ceduo_rock *rock)
{
    if (isnan(s->diameter)) {
        double volume = isnan(s->volume) ? s->mass / s->density : s->volume;
        s->diameter = ceduo_cbrt(6 * volume / M_PI);
    }
    rock->volume = M_PI / 6 * s->diameter * s->diameter * s->diameter;
    rock->mean_diameter = s->diameter;
    set_axes(rock, s->diameter, s->diameter, s->diameter);
    rock->k = 2.0 / 5;
}

static void complete_block(const union sizes *s, struct ceduo_rock *rock)
{
    const double *a = s->axes;
    double longest = fmax(a[0], fmax(a[1], a[2]));
    double squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2] - longest * longest;
    set_axes(rock, a[0], a[1], a[2]);
    rock->volume = a[0] * a[1] * a[2];
    rock->mean_diameter = (a[0] + a[1] + a[2]) / 3;
    double radius = rock->mean_diameter / 2;
    rock->k = squares / (12 * radius * radius);
}

/* What is given is above 0, what the shape needs is given. */
static bool good_sizes(enum ceduo_shape shape, const union sizes *s)
{
    for (size_t i = 0; i < 8; i++)
        if (s->all[i] <= 0 || isinf(s->all[i]))
            return false;
    if (shape == CEDUO_SPHERE)
        return !isnan(s->diameter) || !isnan(s->volume) || !isnan(s->mass);
    if (shape == CEDUO_CYLINDER)
        return !isnan(s->diameter) && !isnan(s->height);
    return !isnan(s->axes[0]) && !isnan(s->axes[1]) && !isnan(s->axes[2]);
}

static enum ceduo_status rock_from_sizes(enum ceduo_shape shape, union sizes *s, struct ceduo_rock *rock)
{
    if (!good_sizes(shape, s))
        return CEDUO_BAD_ROCK;
    switch (shape) { /* untaken: table */
    case CEDUO_SPHERE:
        complete_sphere(s, rock);
        break;
    case CEDUO_CYLINDER:
        rock->volume = M_PI / 4 * s->diameter * s->diameter * s->height;
        rock->mean_diameter = (s->diameter + s->height) / 2;
        set_axes(rock, s->diameter, s->diameter, s->height);
        rock->k = 1.0 / 2;
        break;
    case CEDUO_ELLIPSOID:
        set_axes(rock, s->axes[0], s->axes[1], s->axes[2]);
        rock->volume = M_PI / 6 * s->axes[0] * s->axes[1] * s->axes[2];
        rock->mean_diameter = (s->axes[0] + s->axes[1] + s->axes[2]) / 3;
        rock->k = 2.0 / 5;
        break;
    case CEDUO_BLOCK:
        complete_block(s, rock);
        break;
    }
    rock->mass = isnan(s->mass) ? rock->volume * s->density : s->mass;
    rock->radius = rock->mean_diameter / 2;
    rock->moment = rock->k * rock->mass * rock->radius * rock->radius;
    bool good = rock->moment > 0 && isfinite(rock->moment); /* mass and radius are, too, then */
    return good ? CEDUO_OK : CEDUO_BAD_ROCK;
}

enum ceduo_status ceduo_rock_of_means(const struct ceduo_rock_def *def, struct ceduo_rock *rock)
{
    union sizes s;
    for (size_t i = 0; i < 8; i++)
        s.all[i] = number_of(def, i)->mean;
    return rock_from_sizes(def->shape, &s, rock);
}

struct ceduo_rock ceduo_rock_mean(const struct ceduo_rock_def *def)
{
    struct ceduo_rock rock;
    return ceduo_rock_of_means(def, &rock) == CEDUO_OK ? rock
                                                       : (struct ceduo_rock){NAN, NAN, NAN, NAN, NAN, NAN, {NAN, NAN, NAN}};
}

bool ceduo_rock_varies(const struct ceduo_rock_def *def)
{
    for (size_t i = 0; i < 8; i++)
        if (number_of(def, i)->spread > 0)
            return true;
    return false;
}

enum ceduo_status ceduo_rock_draw(const struct ceduo_rock_def *def, const double u[8], struct ceduo_rock *rock)
{
    union sizes s;
    for (size_t i = 0; i < 8; i++)
        s.all[i] = ceduo_number_draw(*number_of(def, i), u[i], 0, INFINITY);
    return rock_from_sizes(def->shape, &s, rock);
}
