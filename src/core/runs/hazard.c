/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rates follow from the energies of the arriving rocks, sorted, with cumulative sums of weights from the largest on. The energy
 * of a return period is the first at which the curve, or a limit of its interval, reaches the rate. */

#include <math.h>
#include <stdlib.h>

#include "hazard.h"
#include "weighted.h"

const double ceduo_intensity_from[CEDUO_INTENSITIES + 1] = {0, 30e3, 300e3, INFINITY};
const unsigned ceduo_return_years[CEDUO_RETURNS] = {10, 30, 100, 300};

int ceduo_intensity_find(double energy)
{
    for (int i = 0; i < CEDUO_INTENSITIES; i++)
        if (energy < ceduo_intensity_from[i + 1])
            return i;
    return -1;
}

double ceduo_hazard_energy(size_t i)
{
    static const double steps[] = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8};
    double decade = 100;
    for (size_t k = 0; k < i / 10; k++)
        decade *= 10;
    return steps[i % 10] * decade;
}

struct ceduo_hazard ceduo_hazard_none(void)
{
    static const char *const words[CEDUO_INTENSITIES] = {"weak", "medium", "strong"};
    struct ceduo_hazard h = {
        .per_year = NAN, .effective = NAN, .reach = CEDUO_NO_ESTIMATE, .accepted = CEDUO_NO_ESTIMATE, .remaining_share = NAN};
    for (size_t i = 0; i < CEDUO_RETURNS; i++)
        h.returns[i] = (struct ceduo_return){ceduo_return_years[i], CEDUO_NO_ESTIMATE};
    for (size_t i = 0; i < CEDUO_INTENSITIES; i++)
        h.intensity[i] = (struct ceduo_intensity){.word = words[i],
                                                  .from = ceduo_intensity_from[i],
                                                  .to = ceduo_intensity_from[i + 1],
                                                  .rate = CEDUO_NO_ESTIMATE,
                                                  .remaining_share = NAN};
    return h;
}

struct ceduo_estimate ceduo_hazard_judged_rate(const struct ceduo_hazard *h)
{
    return isnan(h->accepted.mean) ? h->reach : h->accepted;
}

static double rate_ratio(struct ceduo_estimate rate, struct ceduo_estimate bare)
{
    return bare.mean > 0 ? rate.mean / bare.mean : NAN;
}

void ceduo_hazard_compare(struct ceduo_hazard *h, const struct ceduo_hazard *bare)
{
    h->remaining_share = rate_ratio(ceduo_hazard_judged_rate(h), ceduo_hazard_judged_rate(bare));
    for (size_t i = 0; i < CEDUO_INTENSITIES; i++)
        h->intensity[i].remaining_share = rate_ratio(h->intensity[i].rate, bare->intensity[i].rate);
}

/* ---- the curve ---- */

struct curve {
    const struct weight_totals *totals;
    const struct weighted *energies; /* increasing */
    const struct weighted_sum *sums; /* [k]: over the k largest */
    size_t n;
};

/* Return the number of rocks above an energy. */
static size_t count_above(const struct curve *c, double energy)
{
    return c->n - ceduo_weighted_upto(c->energies, c->n, energy);
}

/* Return the rate of `ones`, rocks above an energy. */
static struct ceduo_estimate make_rate(const struct curve *c, const struct weighted_sum *ones, double energy)
{
    struct ceduo_estimate p = ceduo_weighted_share(c->totals, ones, energy);
    return (struct ceduo_estimate){p.mean * c->totals->per_year, NAN, p.lo * c->totals->per_year, p.hi * c->totals->per_year};
}

static struct ceduo_estimate make_exceedance(const struct curve *c, double energy)
{
    return make_rate(c, &c->sums[count_above(c, energy)], energy);
}

static void set_curve(const struct curve *c, struct ceduo_hazard_curve *to)
{
    for (size_t i = 0; i < CEDUO_HAZARD_ENERGIES; i++) {
        double energy = ceduo_hazard_energy(i);
        to->points[i] = (struct ceduo_hazard_point){energy, make_exceedance(c, energy)};
        to->count = i + 1;
        if (!(to->points[i].rate.mean > 0))
            break;
    }
}

static void read_curve(const struct curve *c, double accepted, struct ceduo_hazard *h)
{
    h->reach = make_rate(c, &c->sums[c->n], -1);
    if (!isnan(accepted))
        h->accepted = make_exceedance(c, accepted);
    for (size_t i = 0; i < CEDUO_RETURNS; i++) {
        struct ceduo_estimate *to = &h->returns[i].energy;
        double target = 1.0 / h->returns[i].years;
        bool bounded = c->n > 0 && make_exceedance(c, c->energies[c->n - 1].value).hi < target;
        for (size_t k = 1; k <= c->n && isnan(to->lo);
             k++) { /* from the largest rock down, until each limit reaches the rate */
            double energy = c->energies[c->n - k].value;
            struct ceduo_estimate rate = make_rate(c, &c->sums[k], nextafter(energy, 0));
            to->mean = rate.mean >= target && isnan(to->mean) ? energy : to->mean;
            to->lo = rate.lo >= target ? energy : to->lo;
            to->hi = bounded && rate.hi >= target && isnan(to->hi) ? energy : to->hi;
        }
    }
    for (size_t i = 0; i < CEDUO_INTENSITIES; i++) {
        double from = ceduo_intensity_from[i], to = ceduo_intensity_from[i + 1]; /* from <= energy < to */
        const struct weighted_sum *a = &c->sums[from > 0 ? count_above(c, nextafter(from, 0)) : c->n];
        const struct weighted_sum *b = &c->sums[count_above(c, nextafter(to, 0))];
        h->intensity[i].rate = make_rate(c, &(struct weighted_sum){a->t - b->t, a->tt - b->tt, a->tw - b->tw}, from);
        for (size_t r = 0; r < CEDUO_RETURNS; r++)
            h->intensity[i].of_return[r] = ceduo_intensity_find(h->returns[r].energy.mean) == (int)i;
    }
}

bool ceduo_hazard_read(const struct weight_totals *totals, struct weighted *energies, size_t n, double accepted,
                       struct ceduo_hazard *h, struct ceduo_hazard_curve *to)
{
    struct weighted_sum *sums = malloc((n + 1) * sizeof *sums);
    *h = ceduo_hazard_none();
    if (!sums)
        return false;
    ceduo_weighted_sort(energies, n);
    sums[0] = (struct weighted_sum){0};
    for (size_t k = 0; k < n; k++) {
        sums[k + 1] = sums[k];
        weighted_sum_add(&sums[k + 1], energies[n - 1 - k].weight, 1);
    }
    h->per_year = totals->per_year;
    h->effective = totals->w * totals->w / totals->ww;
    const struct curve curve = {totals, energies, sums, n};
    read_curve(&curve, accepted, h);
    if (to)
        set_curve(&curve, to);
    h->curve = to;
    ceduo_hazard_compare(h, h);
    free(sums);
    return true;
}
