/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hazard.h"
#include "run.h"
#include "run_state.h"
#include "scene/derived.h"
#include "scene/rock.h"

/* ---- rocks with weights ---- */

struct weight_totals ceduo_run_weight_totals(const struct ceduo_run *run, double missing)
{
    struct weight_totals totals = {.n = (double)run->rocks, .per_year = run->prepared.sizes.per_year, .missing = missing};
    for (uint64_t r = 0; r < run->rocks; r++) {
        double w = run->weights[r];
        totals.w += w;
        totals.ww += w * w;
    }
    return totals;
}

/* Compute upper bounds of the energies of all rocks: energy of the release, plus a fall to the lowest ground. */
static void bound_energies(const struct ceduo_run *run, struct weighted *max_energies)
{
    const struct ceduo_scene *scene = &run->prepared.scene;
    double squares[3] = {0, 0, 0}, lowest = INFINITY, drop = 0;
    size_t n;
    const struct ceduo_release *releases = ceduo_scene_releases(scene, &n);
    for (size_t i = 0; i < scene->slope.vertices; i++)
        lowest = fmin(lowest, scene->slope.z[i]);
    for (const struct ceduo_release *start = releases; start < releases + n; start++) {
        const struct ceduo_number speeds[] = {start->vx, start->vz, start->spin};
        for (size_t i = 0; i < 3; i++) {
            double fastest = fmax(fabs(ceduo_number_min(speeds[i])), fabs(ceduo_number_max(speeds[i])));
            squares[i] = fmax(squares[i], fastest * fastest);
        }
        drop = fmax(drop, fmax(ceduo_slope_height(&scene->slope, ceduo_number_min(start->x)),
                               ceduo_slope_height(&scene->slope, ceduo_number_max(start->x))) +
                              ceduo_number_max(start->height) - lowest);
    }
    for (uint64_t r = 0; r < run->rocks; r++) {
        struct ceduo_rock rock = {0};
        ceduo_prepared_rock(&run->prepared, r, &rock);
        double mass_energy = scene->simulation.gravity * drop + 0.5 * (squares[0] + squares[1]);
        max_energies[r] = (struct weighted){rock.mass * mass_energy + 0.5 * rock.moment * squares[2], run->weights[r]};
    }
    ceduo_weighted_bound(max_energies, (size_t)run->rocks);
}

/* Gather the values of a column that are not NaN, with the weights of their rocks. */
static size_t gather_weighted(const struct ceduo_run *run, const double *column, struct weighted *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = (struct weighted){column[r], get_weight(run, r)};
    return n;
}

/* Read arrivals from the samples, in the order of the rocks, and from the sums of weights per end. */
static enum ceduo_status read_weighted(const struct ceduo_run *run, size_t control, const struct sums *s,
                                       struct ceduo_arrivals *a, struct ceduo_hazard_curve *curve)
{
    struct weight_totals totals = ceduo_run_weight_totals(run, s->end_weights[CEDUO_END_UNFINISHED]);
    const double accepted = run->prepared.scene.controls[control].accepted;
    struct ceduo_distribution *const to[QUANTITIES] = {
        [SPEED] = &a->speed, [HEIGHT] = &a->height, [ENERGY] = &a->energy, [TRANSLATION] = &a->translation};
    struct weighted_sum reach = {0}, exceed = {0}, energy = {0};
    struct weighted *values = malloc(2 * ((size_t)run->rocks + 1) * sizeof *values);
    if (!values)
        return CEDUO_NO_MEMORY;
    struct weighted *max_energies = values + run->rocks + 1;
    bound_energies(run, max_energies);
    totals.max_energies = max_energies;
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = s->end_weights[e] / totals.w;
    for (int q = 0; q < QUANTITIES; q++)
        *to[q] = ceduo_weighted_distribution(&totals, values, gather_weighted(run, get_samples(run, control, q), values));
    size_t n = gather_weighted(run, get_samples(run, control, ENERGY), values);
    bool good = ceduo_hazard_read(&totals, values, n, accepted, &a->hazard, curve); /* sorts `values` */
    for (size_t i = 0; i < n; i++) {
        weighted_sum_add(&reach, values[i].weight, 1);
        weighted_sum_add(&exceed, values[i].weight, values[i].value > accepted);
        weighted_sum_add(&energy, values[i].weight, values[i].value);
    }
    a->reach = ceduo_weighted_share(&totals, &reach, -1);
    if (!isnan(accepted))
        a->exceed = ceduo_weighted_share(&totals, &exceed, accepted);
    a->energy_per_released = (struct ceduo_estimate){energy.t / totals.w, ceduo_weighted_se(&totals, &energy), NAN, NAN};
    if (!run->prepared.forest.bare && n > 0) { /* stems hit have sums, but no samples */
        double mean = s->hits.t / reach.t;
        struct weighted_sum deviations = {.tt = s->hits.tt - mean * (2 * s->hits.tw - mean * reach.tt),
                                          .tw = s->hits.tw - mean * reach.tt};
        double se = n > 1 ? ceduo_weighted_se(&totals, &deviations) * totals.w / reach.t : NAN;
        a->contacts = (struct ceduo_estimate){mean, se, NAN, NAN};
    }
    free(values);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

/* ---- rocks without weights ---- */

/* Gather the values of a column that are not NaN, in the order of the rocks. */
static size_t gather(const struct ceduo_run *run, const double *column, double *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = column[r];
    return n;
}

static struct ceduo_distribution distribution(const struct ceduo_run *run, size_t control, int q, const struct sums *s,
                                              double *scratch)
{
    return ceduo_distribution_exact(scratch, gather(run, get_samples(run, control, q), scratch), &s->moments[q]);
}

/* ---- arrivals ---- */

double ceduo_exceed_limit(const struct ceduo_scene *scene, const struct ceduo_control *control)
{
    double per_year = 0;
    for (size_t i = 0; i < scene->blocks_count; i++)
        per_year += scene->blocks[i].per_year;
    return scene->blocks_count > 0 ? 1 / (ceduo_accepted_return(control) * per_year) : CEDUO_EXCEED_MAX;
}

void ceduo_arrivals_set_limit(struct ceduo_arrivals *a, const struct ceduo_scene *scene, size_t control)
{
    const struct ceduo_control *c = &scene->controls[control];
    a->limit = ceduo_exceed_limit(scene, c);
    a->hazard.accepted_return = isnan(a->hazard.per_year) || isnan(c->accepted) ? NAN : ceduo_accepted_return(c);
}

/* Read all but the limits. */
static enum ceduo_status read_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a,
                                       struct ceduo_hazard_curve *curve)
{
    struct sums s = ceduo_run_sums_at(run, control);
    *a = (struct ceduo_arrivals){.released = run->rocks,
                                 .reached = s.moments[SPEED].n,
                                 .exceeded = s.exceeded,
                                 .unfinished = s.end_counts[CEDUO_END_UNFINISHED],
                                 .exceed = CEDUO_NO_ESTIMATE,
                                 .contacts = CEDUO_NO_ESTIMATE,
                                 .hazard = ceduo_hazard_none(),
                                 .topography = ceduo_prepared_topography(&run->prepared, control)};
    memcpy(a->ended, s.end_counts, sizeof a->ended);
    if (run->weighted)
        return read_weighted(run, control, &s, a, curve);
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = (double)s.end_counts[e] / (double)run->rocks;
    a->reach = ceduo_run_share(a->reached, a->unfinished, run->rocks);
    if (!isnan(run->prepared.scene.controls[control].accepted))
        a->exceed = ceduo_run_share(a->exceeded, a->unfinished, run->rocks);
    const struct ceduo_moments *energy = &s.moments[ENERGY]; /* over all released rocks; rocks that do not arrive count as 0 */
    double n = (double)run->rocks, arrived = (double)energy->n / n;
    double m2 = energy->m2 + energy->mean * energy->mean * (double)energy->n * (1 - arrived);
    a->energy_per_released = (struct ceduo_estimate){energy->mean * arrived, n < 2 ? NAN : sqrt(m2 / (n - 1) / n), NAN, NAN};
    if (!run->prepared.forest.bare && s.contacts.n > 0)
        a->contacts = (struct ceduo_estimate){s.contacts.mean, ceduo_moments_se(&s.contacts), NAN, NAN};
    struct weighted *scratch = malloc(((size_t)run->rocks + 1) * sizeof *scratch);
    double *values = (double *)scratch;
    if (!scratch)
        return CEDUO_NO_MEMORY;
    a->speed = distribution(run, control, SPEED, &s, values);
    a->height = distribution(run, control, HEIGHT, &s, values);
    if (run->quantities == QUANTITIES) {
        a->energy = distribution(run, control, ENERGY, &s, values);
        a->translation = distribution(run, control, TRANSLATION, &s, values);
    } else {
        /* with one mass and no spin, energy follows from speed */
        struct ceduo_distribution d = a->speed;
        for (size_t k = 0; k < PERCENTILES; k++) {
            struct percentile percentile = ceduo_percentile_compute(&d, k);
            double *const values_of[] = {percentile.value, percentile.lo, percentile.hi};
            for (size_t i = 0; i < 3; i++)
                *values_of[i] = 0.5 * run->prepared.mean.mass * (*values_of[i] * *values_of[i]);
        }
        d.se = ceduo_moments_se(energy);
        d.sd = ceduo_moments_sd(energy);
        d.mean = energy->n > 0 ? energy->mean : NAN;
        d.max = energy->n > 0 ? energy->max : NAN;
        a->energy = a->translation = d;
    }
    free(scratch);
    return CEDUO_OK;
}

enum ceduo_status ceduo_run_hazard(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a,
                                   struct ceduo_hazard_curve *curve)
{
    *a = (struct ceduo_arrivals){0};
    if (control >= run->controls)
        return CEDUO_BAD_ARGUMENT;
    enum ceduo_status status = read_arrivals(run, control, a, curve);
    if (status == CEDUO_OK)
        ceduo_arrivals_set_limit(a, &run->prepared.scene, control);
    return status;
}

enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a)
{
    return ceduo_run_hazard(run, control, a, NULL);
}

void ceduo_run_group_means(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_group_means *briefs)
{
    const double *energies = ceduo_run_samples(run, control, CEDUO_SAMPLE_ENERGY);
    double accepted = energies ? run->prepared.scene.controls[control].accepted : NAN;
    for (size_t g = 0; g < groups; g++) {
        double total = 0, reached = 0, exceeded = 0, sum = 0;
        for (uint64_t r = run->rocks * g / groups; energies && r < run->rocks * (g + 1) / groups; r++) {
            double w = get_weight(run, r);
            total += w;
            reached += isnan(energies[r]) ? 0 : w;
            exceeded += energies[r] > accepted ? w : 0;
            sum += isnan(energies[r]) ? 0 : w * energies[r];
        }
        briefs[g] = (struct ceduo_group_means){.reach_probability = reached / total,
                                               .exceed_probability = isnan(accepted) ? NAN : exceeded / total,
                                               .defeated_probability = NAN,
                                               .energy = reached > 0 ? sum / reached : NAN,
                                               .energy_per_released = sum / total};
    }
    if (energies && ceduo_fence_stands(&run->prepared.scene.controls[control].fence))
        ceduo_run_group_defeats(run, control, groups, briefs);
}

struct ceduo_estimate ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached)
{
    *reached = 0;
    if (control >= run->controls)
        return CEDUO_NO_ESTIMATE;
    const struct sums s = ceduo_run_sums_at(run, control);
    const struct ceduo_moments *m = &s.moments[ENERGY];
    *reached = m->n;
    struct ceduo_estimate energy = {m->n > 0 ? m->mean : NAN, ceduo_moments_se(m), NAN, NAN};
    if (!run->weighted || m->n == 0)
        return energy;
    const struct weight_totals totals = ceduo_run_weight_totals(run, 0);
    const double *energies = get_samples(run, control, ENERGY);
    struct weighted_sum ones = {0}, sum = {0}, deviations = {0};
    for (uint64_t r = 0; r < run->rocks; r++) {
        weighted_sum_add(&ones, run->weights[r], !isnan(energies[r]));
        weighted_sum_add(&sum, run->weights[r], isnan(energies[r]) ? 0 : energies[r]);
    }
    energy.mean = sum.t / ones.t;
    for (uint64_t r = 0; r < run->rocks; r++)
        weighted_sum_add(&deviations, run->weights[r], isnan(energies[r]) ? 0 : energies[r] - energy.mean);
    energy.se = m->n > 1 ? ceduo_weighted_se(&totals, &deviations) * totals.w / ones.t : NAN;
    return energy;
}

/* ---- differences ---- */

struct ceduo_difference ceduo_difference_zero(double accepted)
{
    const struct ceduo_estimate none = {0};
    return (struct ceduo_difference){none, isnan(accepted) ? CEDUO_NO_ESTIMATE : none, none};
}

/* Set the differences of means over all rocks of two runs of equal length. */
static void set_means(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control, double means[3])
{
    const struct sums s = ceduo_run_sums_at(run, control), t = ceduo_run_sums_at(baseline, control);
    const struct ceduo_moments *e = &s.moments[ENERGY], *f = &t.moments[ENERGY];
    double n = (double)run->rocks;
    means[0] = ((double)e->n - (double)f->n) / n;
    means[1] = ((double)s.exceeded - (double)t.exceeded) / n;
    means[2] = (e->mean * (double)e->n - f->mean * (double)f->n) / n;
}

struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control)
{
    if (!run || !baseline || run->rocks == 0 || baseline->rocks == 0 || control >= run->controls ||
        control >= baseline->controls)
        return (struct ceduo_difference){CEDUO_NO_ESTIMATE, CEDUO_NO_ESTIMATE, CEDUO_NO_ESTIMATE};
    const struct ceduo_control *place = &run->prepared.scene.controls[control];
    bool equal_length = run->rocks == baseline->rocks;
    if (equal_length && (run == baseline || (run->stems_from >= place->x && baseline->stems_from >= place->x)))
        return ceduo_difference_zero(place->accepted);
    const struct ceduo_run *shorter = run->rocks < baseline->rocks ? run : baseline;
    const double *a = get_samples(run, control, ENERGY), *b = get_samples(baseline, control, ENERGY);
    struct ceduo_moments moments[3] = {0}; /* of reach, exceed and energy, without weights */
    struct weighted_sum sums[3] = {0};     /* likewise, with weights */
    for (uint64_t r = 0; r < shorter->rocks; r++) {
        const double differences[3] = {(double)!isnan(a[r]) - (double)!isnan(b[r]),
                                       (double)(a[r] > place->accepted) - (double)(b[r] > place->accepted),
                                       (isnan(a[r]) ? 0 : a[r]) - (isnan(b[r]) ? 0 : b[r])};
        for (size_t k = 0; k < 3; k++)
            if (run->weighted)
                weighted_sum_add(&sums[k], run->weights[r], differences[k]);
            else
                ceduo_moments_add(&moments[k], differences[k]);
    }
    const struct weight_totals totals = run->weighted ? ceduo_run_weight_totals(shorter, 0) : (struct weight_totals){0};
    double means[3] = {moments[0].mean, moments[1].mean, moments[2].mean};
    if (equal_length && !run->weighted)
        set_means(run, baseline, control, means);
    struct ceduo_estimate estimates[3];
    for (size_t k = 0; k < 3; k++)
        estimates[k] = run->weighted ? ceduo_weighted_paired(&totals, &sums[k])
                                     : ceduo_estimate_from_pairs(means[k], &moments[k], shorter->rocks);
    return (struct ceduo_difference){estimates[0], isnan(place->accepted) ? CEDUO_NO_ESTIMATE : estimates[1], estimates[2]};
}

/* ---- ends, envelopes, energies ---- */

enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends)
{
    *ends = (struct ceduo_ends){.stop_p50 = NAN, .stop_p95 = NAN, .stop_max = NAN};
    if (run->def.arrivals_only)
        return CEDUO_OK;
    const struct weight_totals totals = run->weighted ? ceduo_run_weight_totals(run, 0) : (struct weight_totals){0};
    ends->stop_x = run->complete.stop_x;
    ends->uphill = run->complete.uphill + run->tail.uphill;
    ends->early = run->complete.early + run->tail.early;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        ends->count[e] = run->complete.ends[e] + run->tail.ends[e];
        ends->share[e] = (double)ends->count[e] / (double)run->rocks;
        if (run->weighted && run->rocks > 0)
            ends->share[e] = (run->complete.end_weights[e] + run->tail.end_weights[e]) / totals.w;
    }
    ceduo_moments_merge(&ends->stop_x, &run->tail.stop_x);
    size_t n = (size_t)ends->stop_x.n;
    if (n == 0)
        return CEDUO_OK;
    ends->stop_max = ends->stop_x.max;
    struct weighted *stops = malloc((n + 1) * sizeof *stops);
    double *scratch = (double *)stops;
    if (!stops)
        return CEDUO_NO_MEMORY;
    if (run->weighted) {
        n = gather_weighted(run, get_stops(run), stops);
        ceduo_weighted_sort(stops, n);
        ends->stop_p50 = ceduo_weighted_quantile(stops, n, 0.5);
        ends->stop_p95 = ceduo_weighted_quantile(stops, n, 0.95);
    } else {
        gather(run, get_stops(run), scratch);
        struct ceduo_distribution d = ceduo_distribution_exact(scratch, n, &ends->stop_x);
        ends->stop_p50 = d.p50;
        ends->stop_p95 = d.p95;
    }
    free(stops);
    return CEDUO_OK;
}

const double *ceduo_run_samples(const struct ceduo_run *run, size_t control, enum ceduo_sample quantity)
{
    static const int column[] = {[CEDUO_SAMPLE_SPEED] = SPEED, [CEDUO_SAMPLE_HEIGHT] = HEIGHT, [CEDUO_SAMPLE_ENERGY] = ENERGY};
    if (quantity == CEDUO_SAMPLE_WEIGHT)
        return run->weights;
    if (quantity == CEDUO_SAMPLE_STOP)
        return get_stops(run);
    return control < run->controls ? get_samples(run, control, column[quantity]) : NULL;
}

size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t max)
{
    const double *energies = ceduo_run_samples(run, control, CEDUO_SAMPLE_ENERGY);
    double total = 0, passed = 0;
    size_t reached = 0, n = 0;
    for (uint64_t r = 0; energies && r < run->rocks; r++)
        if (!isnan(energies[r])) {
            total += get_weight(run, r);
            reached++;
        }
    max = reached < max ? reached : max;
    for (uint64_t r = 0; n < max && r < run->rocks; r++) { /* untaken: rounding */
        if (isnan(energies[r]))
            continue;
        if (!run->weighted)
            to[n++] = energies[r];
        else /* at equal steps of the cumulative weight: light rocks are skipped, heavy ones repeated */
            for (passed += run->weights[r]; n < max && ((double)n + 0.5) * total <= passed * (double)max; n++)
                to[n] = energies[r];
    }
    return n;
}
