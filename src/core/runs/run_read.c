/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

/* Of n rocks; the upper end of its interval counts the unfinished in. */
static struct ceduo_estimate share_of(uint64_t hits, uint64_t unfinished, uint64_t n)
{
    return ceduo_wilson((double)hits / (double)n, (double)(hits + unfinished) / (double)n, (double)n);
}

/* ---- rocks with weights ---- */

static struct released released_of(const struct ceduo_run *run, double missing)
{
    struct released all = {.n = (double)run->rocks, .per_year = run->prepared.sizes.per_year, .missing = missing};
    for (uint64_t r = 0; r < run->rocks; r++) {
        double w = run->weights[r];
        all.w += w;
        all.ww += w * w;
    }
    return all;
}

/* The largest energies that the rocks could have: of how they are released, and of falling to the lowest ground. */
static void bound_energies(const struct ceduo_run *run, struct weighted *could)
{
    const struct ceduo_scene *scene = &run->prepared.scene;
    const struct ceduo_release *start = &scene->release;
    const struct ceduo_number moves[] = {start->vx, start->vz, start->spin};
    double squares[3], low = INFINITY;
    for (size_t i = 0; i < 3; i++) {
        double fastest = fmax(fabs(ceduo_number_lowest(moves[i])), fabs(ceduo_number_highest(moves[i])));
        squares[i] = fastest * fastest;
    }
    for (size_t i = 0; i < scene->slope.vertices; i++)
        low = fmin(low, scene->slope.z[i]);
    double drop = fmax(ceduo_slope_height(&scene->slope, ceduo_number_lowest(start->x)),
                       ceduo_slope_height(&scene->slope, ceduo_number_highest(start->x))) +
                  ceduo_number_highest(start->height) - low;
    for (uint64_t r = 0; r < run->rocks; r++) {
        struct ceduo_rock rock = {0};
        ceduo_prepared_rock(&run->prepared, r, &rock);
        double mass_energy = scene->simulation.gravity * drop + 0.5 * (squares[0] + squares[1]);
        could[r] = (struct weighted){rock.mass * mass_energy + 0.5 * rock.moment * squares[2], run->weights[r]};
    }
    ceduo_weighted_bound(could, (size_t)run->rocks);
}

static double weight_of(const struct ceduo_run *run, uint64_t rock)
{
    return run->sized ? run->weights[rock] : 1;
}

/* Gather the values of a column that are not NaN, with the weights of their rocks. */
static size_t gather_weighted(const struct ceduo_run *run, const double *column, struct weighted *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = (struct weighted){column[r], weight_of(run, r)};
    return n;
}

/* Return the height of the top of a rock. The rock was drawn for the run, so it can be drawn again. */
static double top_of(const struct ceduo_run *run, uint64_t number, double height)
{
    struct ceduo_rock rock = {0};
    ceduo_prepared_rock(&run->prepared, number, &rock);
    return height + rock.mean_diameter;
}

/* Return the 95th percentile of the heights of the tops of the rocks that arrive; NaN without design values. */
static double top_p95(const struct ceduo_run *run, size_t control, double height_p95, struct weighted *scratch)
{
    const struct ceduo_scene *scene = &run->prepared.scene;
    const double *height = samples_of(run, control, HEIGHT);
    size_t n = 0;
    if (scene->design.survey < 0 || (scene->design.blocks < 0 && !run->sized))
        return NAN;
    if (!run->sized && !ceduo_scene_rock_varies(scene))
        return height_p95 + run->prepared.mean.mean_diameter;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(height[r]))
            scratch[n++] = (struct weighted){top_of(run, r, height[r]), weight_of(run, r)};
    ceduo_weighted_sort(scratch, n);
    return ceduo_weighted_quantile(scratch, n, 0.95);
}

/* From the samples, in the order of the rocks, and from sums of the weights by the ways that rocks end. */
static enum ceduo_status read_weighted(const struct ceduo_run *run, size_t control, const struct sums *s,
                                       struct ceduo_arrivals *a, struct ceduo_hazard_curve *curve)
{
    struct released all = released_of(run, s->missed[CEDUO_UNFINISHED]);
    const double accepted = run->prepared.scene.controls[control].accepted;
    struct ceduo_distribution *const to[QUANTITIES] = {
        [SPEED] = &a->speed, [HEIGHT] = &a->height, [ENERGY] = &a->energy, [TRANSLATION] = &a->translation};
    struct weighted_sum reach = {0}, exceed = {0}, energy = {0};
    struct weighted *values = malloc(2 * ((size_t)run->rocks + 1) * sizeof *values);
    if (!values)
        return CEDUO_NO_MEMORY;
    struct weighted *could = values + run->rocks + 1;
    bound_energies(run, could);
    all.could = could;
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = s->missed[e] / all.w;
    for (int q = 0; q < QUANTITIES; q++)
        *to[q] = ceduo_weighted_distribution(&all, values, gather_weighted(run, samples_of(run, control, q), values));
    a->top_p95 = top_p95(run, control, a->height.p95, values);
    size_t n = gather_weighted(run, samples_of(run, control, ENERGY), values);
    bool good = ceduo_hazard_read(&all, values, n, accepted, &a->hazard, curve); /* which sorts them */
    a->hazard.accepted_return = isnan(accepted) ? NAN : ceduo_accepted_return(&run->prepared.scene.controls[control]);
    for (size_t i = 0; i < n; i++) {
        weighted_sum_add(&reach, values[i].weight, 1);
        weighted_sum_add(&exceed, values[i].weight, values[i].value > accepted);
        weighted_sum_add(&energy, values[i].weight, values[i].value);
    }
    a->reach = ceduo_weighted_share(&all, &reach, -1);
    if (!isnan(accepted))
        a->exceed = ceduo_weighted_share(&all, &exceed, accepted);
    a->energy_per_released = (struct ceduo_estimate){energy.t / all.w, ceduo_weighted_se(&all, &energy), NAN, NAN};
    if (!run->prepared.wood.bare && n > 0) { /* no sample is kept of stems hit, but sums */
        double mean = s->hits.t / reach.t;
        struct weighted_sum about = {.tt = s->hits.tt - mean * (2 * s->hits.tw - mean * reach.tt),
                                     .tw = s->hits.tw - mean * reach.tt};
        double se = n > 1 ? ceduo_weighted_se(&all, &about) * all.w / reach.t : NAN;
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
    return ceduo_distribution_exact(scratch, gather(run, samples_of(run, control, q), scratch), &s->of[q]);
}

/* ---- arrivals ---- */

double ceduo_exceed_limit(const struct ceduo_scene *scene, const struct ceduo_control *control)
{
    double per_year = 0;
    for (size_t i = 0; i < scene->blocks_count; i++)
        per_year += scene->blocks[i].per_year;
    return scene->blocks_count > 0 ? 1 / (ceduo_accepted_return(control) * per_year) : CEDUO_EXCEED_MOST;
}

enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a)
{
    return ceduo_run_hazard(run, control, a, NULL);
}

enum ceduo_status ceduo_run_hazard(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a,
                                   struct ceduo_hazard_curve *curve)
{
    *a = (struct ceduo_arrivals){0};
    if (control >= run->controls)
        return CEDUO_BAD_ARGUMENT;
    struct sums s = ceduo_run_sums_at(run, control);
    *a = (struct ceduo_arrivals){.released = run->rocks,
                                 .reached = s.of[SPEED].n,
                                 .exceeded = s.exceeded,
                                 .unfinished = s.ended[CEDUO_UNFINISHED],
                                 .exceed = CEDUO_NO_ESTIMATE,
                                 .limit = ceduo_exceed_limit(&run->prepared.scene, &run->prepared.scene.controls[control]),
                                 .contacts = CEDUO_NO_ESTIMATE,
                                 .hazard = ceduo_hazard_none(),
                                 .topography = ceduo_prepared_topography(&run->prepared, control)};
    memcpy(a->ended, s.ended, sizeof a->ended);
    if (run->sized)
        return read_weighted(run, control, &s, a, curve);
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = (double)s.ended[e] / (double)run->rocks;
    a->reach = share_of(a->reached, a->unfinished, run->rocks);
    if (!isnan(run->prepared.scene.controls[control].accepted))
        a->exceed = share_of(a->exceeded, a->unfinished, run->rocks);
    const struct ceduo_moments *energy = &s.of[ENERGY]; /* of all released rocks; a rock that does not arrive counts as 0 */
    double n = (double)run->rocks, arrived = (double)energy->n / n;
    double m2 = energy->m2 + energy->mean * energy->mean * (double)energy->n * (1 - arrived);
    a->energy_per_released = (struct ceduo_estimate){energy->mean * arrived, n < 2 ? NAN : sqrt(m2 / (n - 1) / n), NAN, NAN};
    if (!run->prepared.wood.bare && s.contacts.n > 0)
        a->contacts = (struct ceduo_estimate){s.contacts.mean, ceduo_moments_se(&s.contacts), NAN, NAN};
    struct weighted *scratch = malloc(((size_t)run->rocks + 1) * sizeof *scratch);
    double *values = (double *)scratch;
    if (!scratch)
        return CEDUO_NO_MEMORY;
    a->speed = distribution(run, control, SPEED, &s, values);
    a->height = distribution(run, control, HEIGHT, &s, values);
    if (run->kept == QUANTITIES) {
        a->energy = distribution(run, control, ENERGY, &s, values);
        a->translation = distribution(run, control, TRANSLATION, &s, values);
    } else {
        /* one mass and no spin make energy follow from speed */
        struct ceduo_distribution d = a->speed;
        for (size_t k = 0; k < PERCENTILES; k++) {
            struct percentile at = ceduo_percentile_of(&d, k);
            double *const values_of[] = {at.value, at.lo, at.hi};
            for (size_t i = 0; i < 3; i++)
                *values_of[i] = 0.5 * run->prepared.mean.mass * (*values_of[i] * *values_of[i]);
        }
        d.se = ceduo_moments_se(energy);
        d.sd = ceduo_moments_sd(energy);
        d.mean = energy->n > 0 ? energy->mean : NAN;
        d.max = energy->n > 0 ? energy->max : NAN;
        a->energy = a->translation = d;
    }
    a->top_p95 = top_p95(run, control, a->height.p95, scratch);
    free(scratch);
    return CEDUO_OK;
}

void ceduo_run_briefs(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_brief *briefs)
{
    const double *energies = ceduo_run_samples(run, control, CEDUO_SAMPLE_ENERGY);
    double accepted = energies ? run->prepared.scene.controls[control].accepted : NAN;
    for (size_t g = 0; g < groups; g++) {
        double all = 0, reached = 0, exceeded = 0, sum = 0;
        for (uint64_t r = run->rocks * g / groups; energies && r < run->rocks * (g + 1) / groups; r++) {
            double w = weight_of(run, r);
            all += w;
            reached += isnan(energies[r]) ? 0 : w;
            exceeded += energies[r] > accepted ? w : 0;
            sum += isnan(energies[r]) ? 0 : w * energies[r];
        }
        briefs[g] = (struct ceduo_brief){.reach_probability = reached / all,
                                         .exceed_probability = isnan(accepted) ? NAN : exceeded / all,
                                         .energy = reached > 0 ? sum / reached : NAN,
                                         .energy_per_released = sum / all};
    }
}

struct ceduo_estimate ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached)
{
    *reached = 0;
    if (control >= run->controls)
        return CEDUO_NO_ESTIMATE;
    const struct sums s = ceduo_run_sums_at(run, control);
    const struct ceduo_moments *m = &s.of[ENERGY];
    *reached = m->n;
    struct ceduo_estimate energy = {m->n > 0 ? m->mean : NAN, ceduo_moments_se(m), NAN, NAN};
    if (!run->sized || m->n == 0)
        return energy;
    const struct released all = released_of(run, 0);
    const double *energies = samples_of(run, control, ENERGY);
    struct weighted_sum ones = {0}, sum = {0}, about = {0};
    for (uint64_t r = 0; r < run->rocks; r++) {
        weighted_sum_add(&ones, run->weights[r], !isnan(energies[r]));
        weighted_sum_add(&sum, run->weights[r], isnan(energies[r]) ? 0 : energies[r]);
    }
    energy.mean = sum.t / ones.t;
    for (uint64_t r = 0; r < run->rocks; r++)
        weighted_sum_add(&about, run->weights[r], isnan(energies[r]) ? 0 : energies[r] - energy.mean);
    energy.se = m->n > 1 ? ceduo_weighted_se(&all, &about) * all.w / ones.t : NAN;
    return energy;
}

/* ---- differences ---- */

struct ceduo_difference ceduo_no_difference(double accepted)
{
    const struct ceduo_estimate none = {0};
    return (struct ceduo_difference){none, isnan(accepted) ? CEDUO_NO_ESTIMATE : none, none};
}

/* Set the means over all rocks of two runs that are as long. */
static void set_means(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control, double means[3])
{
    const struct sums s = ceduo_run_sums_at(run, control), t = ceduo_run_sums_at(baseline, control);
    const struct ceduo_moments *e = &s.of[ENERGY], *f = &t.of[ENERGY];
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
    const struct ceduo_control *at = &run->prepared.scene.controls[control];
    bool as_long = run->rocks == baseline->rocks;
    if (as_long && (run == baseline || (run->stems_from >= at->x && baseline->stems_from >= at->x)))
        return ceduo_no_difference(at->accepted);
    const struct ceduo_run *shorter = run->rocks < baseline->rocks ? run : baseline;
    const double *a = samples_of(run, control, ENERGY), *b = samples_of(baseline, control, ENERGY);
    struct ceduo_moments moments[3] = {0}; /* of reach, exceed and energy, without weights */
    struct weighted_sum sums[3] = {0};     /* likewise with weights */
    for (uint64_t r = 0; r < shorter->rocks; r++) {
        const double differ[3] = {(double)!isnan(a[r]) - (double)!isnan(b[r]),
                                  (double)(a[r] > at->accepted) - (double)(b[r] > at->accepted),
                                  (isnan(a[r]) ? 0 : a[r]) - (isnan(b[r]) ? 0 : b[r])};
        for (size_t k = 0; k < 3; k++)
            if (run->sized)
                weighted_sum_add(&sums[k], run->weights[r], differ[k]);
            else
                ceduo_moments_add(&moments[k], differ[k]);
    }
    const struct released all = run->sized ? released_of(shorter, 0) : (struct released){0};
    double means[3] = {moments[0].mean, moments[1].mean, moments[2].mean};
    if (as_long && !run->sized)
        set_means(run, baseline, control, means);
    struct ceduo_estimate found[3];
    for (size_t k = 0; k < 3; k++)
        found[k] =
            run->sized ? ceduo_weighted_paired(&all, &sums[k]) : ceduo_estimate_of_pairs(means[k], &moments[k], shorter->rocks);
    return (struct ceduo_difference){found[0], isnan(at->accepted) ? CEDUO_NO_ESTIMATE : found[1], found[2]};
}

/* ---- ends, envelopes, energies ---- */

enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends)
{
    *ends = (struct ceduo_ends){.stop_p50 = NAN, .stop_p95 = NAN, .stop_max = NAN};
    if (run->def.arrivals_only)
        return CEDUO_OK;
    const struct released all = run->sized ? released_of(run, 0) : (struct released){0};
    ends->stop_x = run->whole.stop_x;
    ends->uphill = run->whole.uphill + run->tail.uphill;
    ends->early = run->whole.early + run->tail.early;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        ends->count[e] = run->whole.ends[e] + run->tail.ends[e];
        ends->share[e] = (double)ends->count[e] / (double)run->rocks;
        if (run->sized && run->rocks > 0)
            ends->share[e] = (run->whole.ended[e] + run->tail.ended[e]) / all.w;
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
    if (run->sized) {
        n = gather_weighted(run, stops_of(run), stops);
        ceduo_weighted_sort(stops, n);
        ends->stop_p50 = ceduo_weighted_quantile(stops, n, 0.5);
        ends->stop_p95 = ceduo_weighted_quantile(stops, n, 0.95);
    } else {
        gather(run, stops_of(run), scratch);
        struct ceduo_distribution d = ceduo_distribution_exact(scratch, n, &ends->stop_x);
        ends->stop_p50 = d.p50;
        ends->stop_p95 = d.p95;
    }
    free(stops);
    return CEDUO_OK;
}

const double *ceduo_run_samples(const struct ceduo_run *run, size_t control, enum ceduo_sample quantity)
{
    static const enum quantity column[] = {
        [CEDUO_SAMPLE_SPEED] = SPEED, [CEDUO_SAMPLE_HEIGHT] = HEIGHT, [CEDUO_SAMPLE_ENERGY] = ENERGY};
    if (quantity == CEDUO_SAMPLE_WEIGHT)
        return run->weights;
    if (quantity == CEDUO_SAMPLE_STOP)
        return stops_of(run);
    return control < run->controls ? samples_of(run, control, column[quantity]) : NULL;
}

size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t max)
{
    const double *energies = ceduo_run_samples(run, control, CEDUO_SAMPLE_ENERGY);
    double all = 0, before = 0;
    size_t reached = 0, n = 0;
    for (uint64_t r = 0; energies && r < run->rocks; r++)
        if (!isnan(energies[r])) {
            all += weight_of(run, r);
            reached++;
        }
    max = reached < max ? reached : max;
    for (uint64_t r = 0; n < max && r < run->rocks; r++) { /* untaken: rounding */
        if (isnan(energies[r]))
            continue;
        if (!run->sized)
            to[n++] = energies[r];
        else /* at even steps of the sum of their weights: light rocks are left out, heavy ones taken several times */
            for (before += run->weights[r]; n < max && ((double)n + 0.5) * all <= before * (double)max; n++)
                to[n] = energies[r];
    }
    return n;
}
