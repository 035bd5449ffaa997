/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a run whose rocks have weights. All of it comes from the samples, in the order of the rocks, and from the sums of
 * the weights by the ways that rocks end: so parts that are joined give what one run gives. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run_state.h"
#include "weighted.h"

static struct released released_of(const struct ceduo_run *run, double missing)
{
    struct released all = {.n = (double)run->rocks, .per_year = run->ready.sizes.per_year, .missing = missing};
    for (uint64_t r = 0; r < run->rocks; r++) {
        double w = run->weights[r];
        all.w += w;
        all.ww += w * w;
        all.most = w > all.most ? w : all.most;
    }
    return all;
}

/* The values of a column that are there, with the weights of their rocks. */
static size_t gather(const struct ceduo_run *run, const double *column, struct weighted *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = (struct weighted){column[r], run->weights[r]};
    return n;
}

void ceduo_run_sized_energy(const struct ceduo_run *run, size_t control, uint64_t *reached, double *mean, double *se)
{
    const struct released all = released_of(run, 0);
    const double *energy = samples_of(run, control, ENERGY);
    struct weighted_sum ones = {0}, sum = {0}, about = {0};
    *reached = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(energy[r])) {
            weighted_sum_add(&ones, run->weights[r], 1);
            weighted_sum_add(&sum, run->weights[r], energy[r]);
            ++*reached;
        }
    *mean = *reached > 0 ? sum.t / ones.t : NAN;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(energy[r]))
            weighted_sum_add(&about, run->weights[r], energy[r] - *mean);
    *se = *reached > 1 ? ceduo_weighted_se(&all, &about) * all.w / ones.t : NAN;
}

/* ---- arrivals ---- */

enum ceduo_status ceduo_run_sized_arrivals(const struct ceduo_run *run, size_t control, const struct sums *s,
                                           struct ceduo_arrivals *a)
{
    const struct released all = released_of(run, s->missed[CEDUO_UNFINISHED]);
    const double accepted = run->ready.scene.controls[control].accepted, *height = samples_of(run, control, HEIGHT);
    struct ceduo_distribution *const to[QUANTITIES] = {
        [SPEED] = &a->speed, [HEIGHT] = &a->height, [ENERGY] = &a->energy, [TRANSLATION] = &a->translation};
    struct weighted_sum reach = {0}, exceed = {0}, energy = {0};
    struct weighted *values = malloc(((size_t)run->rocks + 1) * sizeof *values);
    size_t n = 0;
    if (!values)
        return CEDUO_NO_MEMORY;
    a->exact = true;
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = s->missed[e] / all.w;
    for (int q = 0; q < QUANTITIES; q++)
        *to[q] = ceduo_weighted_distribution(&all, values, gather(run, samples_of(run, control, q), values));
    for (uint64_t r = 0; r < run->rocks && run->ready.scene.design.survey >= 0; r++) {
        struct ceduo_rock rock;
        if (!isnan(height[r]) && ceduo_prepared_rock(&run->ready, r, &rock) == CEDUO_OK)
            values[n++] = (struct weighted){height[r] + rock.mean_diameter, run->weights[r]};
    }
    ceduo_weighted_sort(values, n);
    a->top_p95 = ceduo_weighted_quantile(values, n, 0.95);
    n = gather(run, samples_of(run, control, ENERGY), values);
    bool good = ceduo_hazard_read(&all, values, n, accepted, &a->hazard); /* which sorts them */
    for (size_t i = 0; i < n; i++) {
        weighted_sum_add(&reach, values[i].weight, 1);
        weighted_sum_add(&exceed, values[i].weight, values[i].value > accepted);
        weighted_sum_add(&energy, values[i].weight, values[i].value);
    }
    struct ceduo_rate share = ceduo_weighted_share(&all, &reach, all.most);
    a->reach_probability = share.rate;
    a->reach_lo = share.lo;
    a->reach_hi = share.hi;
    if (!isnan(accepted)) {
        share = ceduo_weighted_share(&all, &exceed, n > 0 ? values[n - 1].weight : all.most);
        a->exceed_probability = share.rate;
        a->exceed_lo = share.lo;
        a->exceed_hi = share.hi;
    }
    a->energy_per_released = energy.t / all.w;
    a->energy_per_released_se = ceduo_weighted_se(&all, &energy);
    if (!run->ready.wood.bare && n > 0) { /* no sample is kept of stems hit, but sums */
        double mean = a->contacts = s->hits.t / reach.t;
        struct weighted_sum about = {.tt = s->hits.tt - mean * (2 * s->hits.tw - mean * reach.tt),
                                     .tw = s->hits.tw - mean * reach.tt};
        a->contacts_se = n > 1 ? ceduo_weighted_se(&all, &about) * all.w / reach.t : NAN;
    }
    free(values);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

/* At even steps of the sum of their weights: light rocks are left out, heavy ones taken several times. */
size_t ceduo_run_sized_energies(const struct ceduo_run *run, size_t control, double *to, size_t most)
{
    const double *energy = samples_of(run, control, ENERGY);
    double all = 0, before = 0;
    size_t reached = 0, n = 0;
    for (uint64_t r = 0; run->room > 0 && r < run->rocks; r++)
        if (!isnan(energy[r])) {
            all += run->weights[r];
            reached++;
        }
    most = reached < most ? reached : most;
    for (uint64_t r = 0; n < most && r < run->rocks; r++) /* untaken: rounding */
        if (!isnan(energy[r]))
            for (before += run->weights[r]; n < most && ((double)n + 0.5) * all <= before * (double)most; n++)
                to[n] = energy[r];
    return n;
}

/* ---- differences ---- */

struct ceduo_difference ceduo_run_sized_difference(const struct ceduo_run *run, const struct ceduo_run *baseline,
                                                   size_t control)
{
    const struct ceduo_run *shorter = run->rocks < baseline->rocks ? run : baseline;
    const struct released all = released_of(shorter, 0);
    const double *a = samples_of(run, control, ENERGY), *b = samples_of(baseline, control, ENERGY);
    double accepted = run->ready.scene.controls[control].accepted;
    struct weighted_sum reach = {0}, exceed = {0}, energy = {0};
    for (uint64_t r = 0; r < shorter->rocks; r++) {
        double w = run->weights[r];
        weighted_sum_add(&reach, w, (double)!isnan(a[r]) - (double)!isnan(b[r]));
        weighted_sum_add(&exceed, w, (double)(a[r] > accepted) - (double)(b[r] > accepted));
        weighted_sum_add(&energy, w, (isnan(a[r]) ? 0 : a[r]) - (isnan(b[r]) ? 0 : b[r]));
    }
    struct ceduo_difference d = {ceduo_weighted_paired(&all, &reach), ceduo_weighted_paired(&all, &exceed),
                                 ceduo_weighted_paired(&all, &energy)};
    if (isnan(accepted))
        d.exceed_probability = CEDUO_NOT_PAIRED;
    return d;
}

/* ---- ends ---- */

enum ceduo_status ceduo_run_sized_ends(const struct ceduo_run *run, struct ceduo_ends *ends)
{
    const struct released all = released_of(run, 0);
    struct weighted *stops = malloc(((size_t)run->rocks + 1) * sizeof *stops);
    if (!stops)
        return CEDUO_NO_MEMORY;
    for (int e = 0; e < CEDUO_ENDS; e++)
        ends->share[e] = (run->whole.ended[e] + run->tail.ended[e]) / all.w;
    size_t n = gather(run, stops_of(run), stops);
    ceduo_weighted_sort(stops, n);
    ends->stop_p50 = ceduo_weighted_quantile(stops, n, 0.5);
    ends->stop_p95 = ceduo_weighted_quantile(stops, n, 0.95);
    free(stops);
    return CEDUO_OK;
}
