/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

/* ---- arrivals ---- */

/* The values of a column that are there, in the order of the rocks. */
static size_t gather(const struct ceduo_run *run, const double *column, double *to)
{
    size_t n = 0;
    for (uint64_t r = 0; r < run->rocks; r++)
        if (!isnan(column[r]))
            to[n++] = column[r];
    return n;
}

static struct ceduo_distribution distribution(const struct ceduo_run *run, size_t control, int q, const struct ceduo_moments *m,
                                              double *scratch)
{
    if (!run->exact)
        return ceduo_distribution_binned(bins_of(run->bins, run, control, q), m);
    size_t n = run->room > 0 ? gather(run, samples_of(run, control, q), scratch) : 0;
    return ceduo_distribution_exact(scratch, n, m);
}

/* Energy where one mass and no spin make it follow from speed. */
static struct ceduo_distribution energy_from_speed(struct ceduo_distribution d, double mass, const struct ceduo_moments *m)
{
    double *const quantiles[] = {&d.p50, &d.p50_lo, &d.p50_hi, &d.p95, &d.p95_lo, &d.p95_hi, &d.p99, &d.p99_lo, &d.p99_hi};
    for (size_t i = 0; i < sizeof quantiles / sizeof quantiles[0]; i++)
        *quantiles[i] = 0.5 * mass * (*quantiles[i] * *quantiles[i]);
    d.se = ceduo_moments_se(m);
    d.sd = ceduo_moments_sd(m);
    d.mean = m->n > 0 ? m->mean : NAN;
    d.max = m->n > 0 ? m->max : NAN;
    return d;
}

/* A share of n rocks with its 95 % interval, whose upper end counts the unfinished in. */
static double share(uint64_t hits, uint64_t unfinished, uint64_t n, double *lo, double *hi)
{
    struct ceduo_rate r = ceduo_wilson((double)hits / (double)n, (double)(hits + unfinished) / (double)n, (double)n);
    *lo = r.lo;
    *hi = r.hi;
    return r.rate;
}

/* Mean and standard error over all released rocks; a rock that does not arrive counts as 0. */
static void per_released(const struct ceduo_moments *m, uint64_t released, double *mean, double *se)
{
    double n = (double)released, share = (double)m->n / n;
    *mean = m->mean * share;
    double m2 = m->m2 + m->mean * m->mean * (double)m->n * (1 - share);
    *se = released < 2 ? NAN : sqrt(m2 / (n - 1) / n);
}

/* ---- what is read ---- */

/* The 95th percentile of the heights of the tops of the rocks that arrive, where each is as large as it was drawn. */
static double top_of(const struct ceduo_run *run, size_t control, double height_p95, double *scratch)
{
    const struct ceduo_scene *scene = &run->ready.scene;
    const double *height = samples_of(run, control, HEIGHT);
    struct ceduo_moments m = {0};
    size_t n = 0;
    if (scene->design.survey < 0 || scene->design.blocks < 0)
        return NAN;
    if (!ceduo_scene_rock_varies(scene))
        return height_p95 + run->ready.mean.mean_diameter;
    for (uint64_t r = 0; run->exact && run->room > 0 && r < run->rocks; r++) {
        struct ceduo_rock rock;
        if (isnan(height[r]) || ceduo_prepared_rock(&run->ready, r, &rock) != CEDUO_OK)
            continue;
        scratch[n] = height[r] + rock.mean_diameter;
        ceduo_moments_add(&m, scratch[n++]);
    }
    return n > 0 ? ceduo_distribution_exact(scratch, n, &m).p95 : NAN;
}

enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a)
{
    struct sums s = ceduo_run_sums_at(run, control);
    *a = (struct ceduo_arrivals){.released = run->rocks,
                                 .reached = s.of[SPEED].n,
                                 .exceeded = s.exceeded,
                                 .unfinished = s.ended[CEDUO_UNFINISHED],
                                 .exceed_probability = NAN,
                                 .exceed_lo = NAN,
                                 .exceed_hi = NAN,
                                 .contacts = NAN,
                                 .contacts_se = NAN,
                                 .hazard = ceduo_hazard_none(),
                                 .exact = run->exact};
    memcpy(a->ended, s.ended, sizeof a->ended);
    if (run->sized)
        return ceduo_run_sized_arrivals(run, control, &s, a);
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = (double)s.ended[e] / (double)run->rocks;
    a->reach_probability = share(a->reached, a->unfinished, run->rocks, &a->reach_lo, &a->reach_hi);
    if (!isnan(run->ready.scene.controls[control].accepted))
        a->exceed_probability = share(a->exceeded, a->unfinished, run->rocks, &a->exceed_lo, &a->exceed_hi);
    per_released(&s.of[ENERGY], run->rocks, &a->energy_per_released, &a->energy_per_released_se);
    if (!run->ready.wood.bare && s.contacts.n > 0) {
        a->contacts = s.contacts.mean;
        a->contacts_se = ceduo_moments_se(&s.contacts);
    }
    double *scratch = malloc(((size_t)run->rocks + 1) * sizeof(double));
    if (!scratch)
        return CEDUO_NO_MEMORY;
    a->speed = distribution(run, control, SPEED, &s.of[SPEED], scratch);
    a->height = distribution(run, control, HEIGHT, &s.of[HEIGHT], scratch);
    if (run->kept == QUANTITIES) {
        a->energy = distribution(run, control, ENERGY, &s.of[ENERGY], scratch);
        a->translation = distribution(run, control, TRANSLATION, &s.of[TRANSLATION], scratch);
    } else {
        a->energy = a->translation = energy_from_speed(a->speed, run->ready.mean.mass, &s.of[ENERGY]);
    }
    a->top_p95 = top_of(run, control, a->height.p95, scratch);
    free(scratch);
    return CEDUO_OK;
}

void ceduo_run_briefs(const struct ceduo_run *run, size_t control, size_t groups, struct ceduo_brief *briefs)
{
    double accepted = run->ready.scene.controls[control].accepted;
    for (size_t g = 0; g < groups; g++) {
        double all = 0, reached = 0, exceeded = 0, sum = 0;
        for (uint64_t r = run->rocks * g / groups; r < run->rocks * (g + 1) / groups; r++) {
            double energy = ceduo_run_sample_energy(run, control, r), w = run->sized ? run->weights[r] : 1;
            all += w;
            reached += isnan(energy) ? 0 : w;
            exceeded += energy > accepted ? w : 0;
            sum += isnan(energy) ? 0 : w * energy;
        }
        briefs[g] = (struct ceduo_brief){.reach_probability = reached / all,
                                         .exceed_probability = isnan(accepted) ? NAN : exceeded / all,
                                         .energy = reached > 0 ? sum / reached : NAN,
                                         .energy_per_released = sum / all};
    }
}

struct ceduo_brief ceduo_run_brief(const struct ceduo_run *run, size_t control)
{
    struct ceduo_brief brief;
    if (run->sized) {
        ceduo_run_briefs(run, control, 1, &brief);
        return brief;
    }
    struct sums s = ceduo_run_sums_at(run, control);
    const struct ceduo_moments *energy = &s.of[ENERGY];
    bool accepts = !isnan(run->ready.scene.controls[control].accepted);
    double n = (double)run->rocks, per_rock, se;
    per_released(energy, run->rocks, &per_rock, &se);
    return (struct ceduo_brief){.reach_probability = (double)energy->n / n,
                                .exceed_probability = accepts ? (double)s.exceeded / n : NAN,
                                .energy = energy->n > 0 ? energy->mean : NAN,
                                .energy_per_released = per_rock};
}

void ceduo_run_energy(const struct ceduo_run *run, size_t control, uint64_t *reached, double *mean, double *se)
{
    if (run->sized) {
        ceduo_run_sized_energy(run, control, reached, mean, se);
        return;
    }
    struct sums s = ceduo_run_sums_at(run, control);
    *reached = s.of[ENERGY].n;
    *mean = *reached > 0 ? s.of[ENERGY].mean : NAN;
    *se = ceduo_moments_se(&s.of[ENERGY]);
}

/* ---- differences ---- */

/* Of the rocks whose energies are known. */
static uint64_t paired_rocks(const struct ceduo_run *run)
{
    return run->exact || run->rocks < run->pairs_room ? run->rocks : run->pairs_room;
}

static double paired_energy(const struct ceduo_run *run, size_t control, uint64_t rock)
{
    return run->exact ? ceduo_run_sample_energy(run, control, rock) : run->pairs[control * run->pairs_room + rock];
}

struct ceduo_difference ceduo_no_difference(double accepted)
{
    const struct ceduo_paired none = {0, 0, 0};
    return (struct ceduo_difference){none, isnan(accepted) ? CEDUO_NOT_PAIRED : none, none};
}

struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control)
{
    bool alike = run && baseline && run->rocks == baseline->rocks;
    if (!run || !baseline || run->rocks == 0 || baseline->rocks == 0 || (!alike && !(run->exact && baseline->exact)))
        return (struct ceduo_difference){CEDUO_NOT_PAIRED, CEDUO_NOT_PAIRED, CEDUO_NOT_PAIRED};
    const struct ceduo_control *at = &run->ready.scene.controls[control];
    if (alike && (run == baseline || (run->stems_from >= at->x && baseline->stems_from >= at->x)))
        return ceduo_no_difference(at->accepted);
    if (run->sized)
        return ceduo_run_sized_difference(run, baseline, control);
    uint64_t a = paired_rocks(run), b = paired_rocks(baseline), paired = a < b ? a : b; /* rocks that both have */
    struct ceduo_moments reach = {0}, exceed = {0}, energy = {0};                       /* of their differences */
    for (uint64_t r = 0; r < paired; r++) {
        double e = paired_energy(run, control, r), f = paired_energy(baseline, control, r);
        ceduo_moments_add(&reach, (double)!isnan(e) - (double)!isnan(f));
        ceduo_moments_add(&exceed, (double)(e > at->accepted) - (double)(f > at->accepted));
        ceduo_moments_add(&energy, (isnan(e) ? 0 : e) - (isnan(f) ? 0 : f));
    }
    uint64_t rocks = alike ? run->rocks : paired;
    struct ceduo_difference d = {ceduo_paired_of(reach.mean, &reach, rocks), ceduo_paired_of(exceed.mean, &exceed, rocks),
                                 ceduo_paired_of(energy.mean, &energy, rocks)};
    if (alike) { /* the means of all rocks, where only the first are paired */
        struct sums s = ceduo_run_sums_at(run, control), t = ceduo_run_sums_at(baseline, control);
        const struct ceduo_moments *e = &s.of[ENERGY], *f = &t.of[ENERGY];
        double n = (double)run->rocks;
        d.reach_probability.mean = ((double)e->n - (double)f->n) / n;
        d.exceed_probability.mean = ((double)s.exceeded - (double)t.exceeded) / n;
        d.energy_per_released.mean = (e->mean * (double)e->n - f->mean * (double)f->n) / n;
    }
    if (isnan(at->accepted))
        d.exceed_probability = CEDUO_NOT_PAIRED;
    return d;
}

uint64_t ceduo_run_mark(const struct ceduo_run *run, size_t control, uint16_t *marks, uint64_t most)
{
    double accepted = run->ready.scene.controls[control].accepted;
    uint64_t rocks = paired_rocks(run);
    rocks = rocks < most ? rocks : most;
    for (uint64_t r = 0; r < rocks; r++) {
        double energy = paired_energy(run, control, r);
        marks[r] = (uint16_t)(marks[r] + (isnan(accepted) ? !isnan(energy) : energy > accepted));
    }
    return rocks;
}

/* ---- ends, envelopes, energies ---- */

enum ceduo_status ceduo_run_ends(const struct ceduo_run *run, struct ceduo_ends *ends)
{
    *ends = (struct ceduo_ends){.stop_p50 = NAN, .stop_p95 = NAN, .stop_max = NAN};
    if (run->def.arrivals_only)
        return CEDUO_OK;
    ends->stop_x = run->whole.stop_x;
    ends->uphill = run->whole.uphill + run->tail.uphill;
    ends->early = run->whole.early + run->tail.early;
    for (int e = 0; e < CEDUO_ENDS; e++) {
        ends->count[e] = run->whole.ends[e] + run->tail.ends[e];
        ends->share[e] = (double)ends->count[e] / (double)run->rocks;
    }
    if (run->sized && run->rocks > 0 && ceduo_run_sized_ends(run, ends) != CEDUO_OK)
        return CEDUO_NO_MEMORY;
    ceduo_moments_merge(&ends->stop_x, &run->tail.stop_x);
    if (ends->stop_x.n == 0)
        return CEDUO_OK;
    ends->stop_max = ends->stop_x.max;
    if (run->sized)
        return CEDUO_OK;
    size_t n = (size_t)ends->stop_x.n;
    size_t r50 = ceduo_quantile_rank(n, 0.5), r95 = ceduo_quantile_rank(n, 0.95);
    if (!run->exact) {
        const struct histogram *h = &run->bins[run->columns - 1];
        ends->stop_p50 = ceduo_histogram_value(h, r50);
        ends->stop_p95 = ceduo_histogram_value(h, r95);
        return CEDUO_OK;
    }
    double *scratch = malloc((n + 1) * sizeof(double));
    if (!scratch)
        return CEDUO_NO_MEMORY;
    gather(run, stops_of(run), scratch);
    struct ceduo_distribution d = ceduo_distribution_exact(scratch, n, &ends->stop_x);
    ends->stop_p50 = d.p50;
    ends->stop_p95 = d.p95;
    free(scratch);
    return CEDUO_OK;
}

void ceduo_run_envelope(const struct ceduo_run *run, size_t cell, struct ceduo_envelope *envelope)
{
    ceduo_envelope_read(&run->cells[cell], envelope);
}

const double *ceduo_run_weights(const struct ceduo_run *run)
{
    return run->weights;
}

size_t ceduo_run_energies(const struct ceduo_run *run, size_t control, double *to, size_t most)
{
    size_t n = 0;
    if (run->sized)
        return ceduo_run_sized_energies(run, control, to, most);
    for (uint64_t r = 0; run->room > 0 && r < run->rocks && n < most; r++) {
        double energy = ceduo_run_sample_energy(run, control, r);
        if (!isnan(energy))
            to[n++] = energy;
    }
    return n;
}

bool ceduo_run_values(const struct ceduo_run *run, size_t control, enum ceduo_sample what, double *to)
{
    if (!run->exact)
        return false;
    const double *kept = samples_of(run, control, what == CEDUO_SAMPLE_HEIGHT ? HEIGHT : SPEED);
    for (uint64_t r = 0; r < run->rocks; r++)
        to[r] = what == CEDUO_SAMPLE_ENERGY ? ceduo_run_sample_energy(run, control, r) : kept[r];
    return true;
}

bool ceduo_run_stops(const struct ceduo_run *run, double *to)
{
    const double *stops = stops_of(run);
    for (uint64_t r = 0; run->exact && r < run->rocks; r++)
        to[r] = stops[r];
    return run->exact;
}
