/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plane_map.h"
#include "ceduo/scene.h"

#include <gsl/gsl_randist.h>
#include <math.h>
#include <stdlib.h>

struct map {
    const struct ceduo_stand *stand;
    double from, to, half_width; /* planted rectangle */
    double b, start;
    gsl_rng *rng;
    uint64_t numbers; /* stools and trees planted */
    struct map_stem *stems;
    size_t count, max;
};

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

static void check_stem(struct map *m, double x, double y, double dbh, bool shoot)
{
    if (x < m->start || fabs(y) > m->b / 2 + dbh / 2)
        return;
    if (m->count < m->max)
        m->stems[m->count] = (struct map_stem){x, y, dbh, shoot, m->numbers};
    m->count++;
}

/* Draw a uniform draw_place for each of a Poisson number of draw_centres. */
static unsigned draw_centres(const struct map *m, double per_ha)
{
    return gsl_ran_poisson(m->rng, per_ha / 1e4 * (m->to - m->from) * 2 * m->half_width);
}

static void draw_place(const struct map *m, double *x, double *y)
{
    *x = gsl_ran_flat(m->rng, m->from, m->to);
    *y = gsl_ran_flat(m->rng, -m->half_width, m->half_width);
}

static double dbh_of_shoot(const struct map *m, double shoots)
{
    const struct ceduo_stems *k = m->stand->shoots;
    double u = gsl_ran_flat(m->rng, 0, shoots);
    for (size_t i = 0; i + 1 < m->stand->shoots_count && u >= k->per_ha; i++)
        u -= k++->per_ha;
    return k->dbh;
}

static void plant_stools(struct map *m)
{
    double shoots = mean_sum(m->stand->shoots, m->stand->shoots_count), mean = shoots / m->stand->stools_per_ha;
    for (unsigned rest = draw_centres(m, m->stand->stools_per_ha); rest > 0; rest--) {
        double x, y;
        draw_place(m, &x, &y);
        unsigned n = (unsigned)floor(mean) + (gsl_rng_uniform(m->rng) < mean - floor(mean));
        double turn = gsl_ran_flat(m->rng, 0, 2 * M_PI), r = ring_radius(n, m->stand->spacing);
        m->numbers++;
        for (unsigned i = 0; i < n; i++) {
            double angle = turn + 2 * M_PI * i / n;
            check_stem(m, x + r * cos(angle), y + r * sin(angle), dbh_of_shoot(m, shoots), true);
        }
    }
}

static void plant_trees(struct map *m, const struct ceduo_stems *kind)
{
    for (unsigned rest = draw_centres(m, kind->per_ha); rest > 0; rest--) {
        double x, y;
        draw_place(m, &x, &y);
        m->numbers++;
        check_stem(m, x, y, kind->dbh, false);
    }
}

/* Half the width of the planted strip: draw_centres farther away never matter. Has a metre to spare. */
static double planted_half_width(const struct ceduo_stand *stand, double b)
{
    double thickest = 0, r = 0;
    for (size_t i = 0; i < stand->shoots_count; i++)
        thickest = fmax(thickest, stand->shoots[i].dbh);
    for (size_t i = 0; i < stand->trees_count; i++)
        thickest = fmax(thickest, stand->trees[i].dbh);
    if (stand->shoots_count > 0)
        r = ring_radius((unsigned)ceil(mean_sum(stand->shoots, stand->shoots_count) / stand->stools_per_ha), stand->spacing);
    return r + (b + thickest) / 2 + 1;
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
        m.half_width = planted_half_width(m.stand, b);
        if (m.stand->shoots_count > 0)
            plant_stools(&m);
        for (size_t k = 0; k < m.stand->trees_count; k++)
            plant_trees(&m, &m.stand->trees[k]);
    }
    if (m.count <= max)
        qsort(stems, m.count, sizeof *stems, compare_x);
    return m.count;
}
