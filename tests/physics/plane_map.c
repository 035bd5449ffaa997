/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plane_map.h"
#include "ceduo/scene.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>

struct map {
    const struct ceduo_stand *stand;
    double from, to; /* planted stretch */
    double b, start;
    gsl_rng *rng;
    uint64_t numbers; /* stools and trees planted */
    struct map_stem *stems;
    size_t count, max;
};

double printed_share(double u)
{
    double e = -.046 + (.98 + .046) / (1 + pow(10, (.58 - u) * -8.007));
    return e < 0 ? 0 : e > 1 ? 1 : e;
}

double printed_energy(const struct ceduo_stand *stand, const struct ceduo_stems *kind, double b, double y)
{
    double eccentricity = 2 * fabs(y) / (b + kind->dbh);
    return kind->volume * stand->u * (stand->offset == CEDUO_ENERGY_OFFSET_WHOLE ? 1 : printed_share(eccentricity));
}

static double mean_sum(const struct ceduo_stems *kinds, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += kinds[i].per_ha;
    return sum;
}

static double ring_radius(unsigned n, double spacing)
{
    return n > 1 ? spacing / 2 / sin(M_PI / n) : 0;
}

static void check_stem(struct map *m, double x, double y, const struct ceduo_stems *kind, bool shoot)
{
    if (x < m->start || fabs(y) > m->b / 2 + kind->dbh / 2)
        return;
    if (m->count < m->max)
        m->stems[m->count] =
            (struct map_stem){x, y, kind->dbh, shoot, m->numbers, kind->height, printed_energy(m->stand, kind, m->b, y)};
    m->count++;
}

/* Draw a Poisson number of places within `half_width` of the trajectory. */
static unsigned draw_number(const struct map *m, double per_ha, double half_width)
{
    return gsl_ran_poisson(m->rng, per_ha / 1e4 * (m->to - m->from) * 2 * half_width);
}

static void draw_place(const struct map *m, double half_width, double *x, double *y)
{
    *x = gsl_ran_flat(m->rng, m->from, m->to);
    *y = gsl_ran_flat(m->rng, -half_width, half_width);
}

static const struct ceduo_stems *draw_cohort(const struct map *m, double shoots)
{
    const struct ceduo_stems *k = m->stand->shoots;
    double u = gsl_ran_flat(m->rng, 0, shoots);
    for (size_t i = 0; i + 1 < m->stand->shoots_count && u >= k->per_ha; i++)
        u -= k++->per_ha;
    return k;
}

static void plant_stools(struct map *m)
{
    double shoots = mean_sum(m->stand->shoots, m->stand->shoots_count), mean = shoots / m->stand->stools_per_ha;
    double min = floor(mean), spacing = m->stand->spacing, thickest = 0;
    const double radii[2] = {ring_radius((unsigned)min, spacing), ring_radius((unsigned)min + 1, spacing)};
    for (size_t i = 0; i < m->stand->shoots_count; i++)
        thickest = fmax(thickest, m->stand->shoots[i].dbh);
    double half_width = radii[mean > min] + (m->b + thickest) / 2;
    for (unsigned rest = draw_number(m, m->stand->stools_per_ha, half_width); rest > 0; rest--) {
        double x, y;
        draw_place(m, half_width, &x, &y);
        bool extra = gsl_rng_uniform(m->rng) < mean - min;
        unsigned n = (unsigned)min + extra;
        double turn = gsl_ran_flat(m->rng, 0, 2 * M_PI), r = radii[extra];
        m->numbers++;
        for (unsigned i = 0; i < n; i++) {
            double angle = turn + 2 * M_PI * i / n;
            check_stem(m, x + r * cos(angle), y + r * sin(angle), draw_cohort(m, shoots), true);
        }
    }
}

static void plant_trees(struct map *m, const struct ceduo_stems *kind)
{
    double half_width = (m->b + kind->dbh) / 2;
    for (unsigned rest = draw_number(m, kind->per_ha, half_width); rest > 0; rest--) {
        double x, y;
        draw_place(m, half_width, &x, &y);
        m->numbers++;
        check_stem(m, x, y, kind, false);
    }
}

static int compare_x(const void *a, const void *b)
{
    const struct map_stem *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

size_t plane_map_sweep(const struct ceduo_option *option, double b, double start, gsl_rng *rng, struct map_stem *stems,
                       size_t max)
{
    struct map m = {.b = b, .start = start, .rng = rng, .stems = stems, .max = max};
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        m.stand = &belt->stand;
        m.from = belt->from;
        m.to = belt->to;
        if (m.stand->shoots_count > 0)
            plant_stools(&m);
        for (size_t k = 0; k < m.stand->trees_count; k++)
            plant_trees(&m, &m.stand->trees[k]);
    }
    if (m.count <= max)
        qsort(stems, m.count, sizeof *stems, compare_x);
    return m.count;
}
