/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "run_state.h"

#define SHARE_LEAST 50 /* rocks */

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

static struct ceduo_distribution distribution(const struct ceduo_run *run, size_t control, int q,
                                              const struct ceduo_moments *m, double *scratch)
{
    if (!run->exact)
        return ceduo_distribution_binned(bins_of(run->bins, run, control, q), m);
    size_t n = run->room > 0 ? gather(run, samples_of(run, control, q), scratch) : 0;
    return ceduo_distribution_exact(scratch, n, m);
}

/* Energy where one mass and no spin make it follow from speed. */
static struct ceduo_distribution energy_from_speed(const struct ceduo_distribution *speed, double mass,
                                                   const struct ceduo_moments *m)
{
    struct ceduo_distribution d = {.mean = speed->mean, .se = ceduo_moments_se(m), .sd = ceduo_moments_sd(m)};
    const double from[] = {speed->p50,    speed->p50_lo, speed->p50_hi, speed->p95,   speed->p95_lo,
                           speed->p95_hi, speed->p99,    speed->p99_lo, speed->p99_hi};
    double *const to[] = {&d.p50, &d.p50_lo, &d.p50_hi, &d.p95, &d.p95_lo, &d.p95_hi, &d.p99, &d.p99_lo, &d.p99_hi};
    for (size_t i = 0; i < sizeof to / sizeof to[0]; i++)
        *to[i] = 0.5 * mass * (from[i] * from[i]);
    d.mean = m->n > 0 ? m->mean : NAN;
    d.max = m->n > 0 ? m->max : NAN;
    return d;
}

/* A share of n rocks with its 95 % interval, whose upper end counts the unfinished in. */
static double share(uint64_t hits, uint64_t unfinished, uint64_t n, double *lo, double *hi)
{
    double unused;
    ceduo_wilson(hits, n, lo, &unused);
    ceduo_wilson(hits + unfinished, n, &unused, hi);
    return (double)hits / (double)n;
}

/* Mean and standard error over all released, of whom those that do not arrive bring nothing. */
static void per_released(const struct ceduo_moments *m, uint64_t released, double *mean, double *se)
{
    double n = (double)released, share = (double)m->n / n;
    *mean = m->mean * share;
    double m2 = m->m2 + m->mean * m->mean * (double)m->n * (1 - share);
    *se = released < 2 ? NAN : sqrt(m2 / (n - 1) / n);
}

/* ---- adjusted means ---- */

/* The 95 % interval of an adjusted share: Wilson's, of as many rocks as would give its error. Of few that count, or few that
 * do not, the error is not known well enough: then it is that of the rocks there are. */
static void adjusted_interval(const struct adjusted *a, double share, double se, double count, double unfinished,
                              double *lo, double *hi)
{
    double unused, n = a->fit.n;
    bool knows_error = fmin(count, n - count) >= SHARE_LEAST && se > 0;
    double rocks = knows_error ? share * (1 - share) / (se * se) : n;
    double from = knows_error ? share : count / n;
    ceduo_wilson_share(from, rocks, lo, &unused);
    ceduo_wilson_share(fmin(1, from + unfinished / n), rocks, &unused, hi);
    *lo = fmin(*lo, share);
    *hi = fmax(*hi, share);
}

static void adjust_mean(const struct adjusted *a, enum varied which, const struct ceduo_moments *m,
                        struct ceduo_distribution *d)
{
    struct ceduo_paired mean = ceduo_run_adjusted_mean(a, which, m);
    d->mean = mean.mean;
    d->se = mean.se;
}

static void adjust(const struct ceduo_run *run, const struct sums *s, struct ceduo_arrivals *to)
{
    struct adjusted a;
    to->adjusted = ceduo_run_adjust(run, s, &a);
    if (!to->adjusted)
        return;
    double unfinished = (double)to->unfinished;
    to->reach_probability = ceduo_run_adjusted_share(&a, VARIED_REACHED);
    to->reach_se = ceduo_run_adjusted_share_se(&a, VARIED_REACHED);
    adjusted_interval(&a, to->reach_probability, to->reach_se, (double)to->reached, unfinished, &to->reach_lo,
                      &to->reach_hi);
    if (!isnan(to->exceed_probability)) {
        to->exceed_probability = ceduo_run_adjusted_share(&a, VARIED_EXCEEDED);
        to->exceed_se = ceduo_run_adjusted_share_se(&a, VARIED_EXCEEDED);
        adjusted_interval(&a, to->exceed_probability, to->exceed_se, (double)to->exceeded, unfinished, &to->exceed_lo,
                          &to->exceed_hi);
        to->exceed_lo = fmin(to->exceed_lo, to->reach_lo); /* none exceeds that does not arrive */
        to->exceed_hi = fmin(to->exceed_hi, to->reach_hi);
    }
    for (int e = 0; e < CEDUO_ENDS; e++)
        to->missed[e] = ceduo_run_adjusted_share(&a, (enum varied)(VARIED_ENDED + e));
    struct ceduo_paired released = ceduo_run_adjusted_per_released(&a, &s->of[ENERGY]);
    to->energy_per_released = released.mean;
    to->energy_per_released_se = released.se;
    adjust_mean(&a, VARIED_SPEED, &s->of[SPEED], &to->speed);
    adjust_mean(&a, VARIED_HEIGHT, &s->of[HEIGHT], &to->height);
    adjust_mean(&a, VARIED_ENERGY, &s->of[ENERGY], &to->energy);
    adjust_mean(&a, VARIED_TRANSLATION, &s->of[TRANSLATION], &to->translation);
}

/* ---- what is read ---- */

static double share_se(double share, uint64_t n)
{
    return sqrt(share * (1 - share) / (double)n);
}

enum ceduo_status ceduo_run_arrivals(const struct ceduo_run *run, size_t control, struct ceduo_arrivals *a)
{
    if (run->sized)
        return ceduo_run_sized_arrivals(run, control, a);
    struct sums s = ceduo_run_sums_at(run, control);
    *a = (struct ceduo_arrivals){.released = run->rocks,
                                 .reached = s.of[SPEED].n,
                                 .exceeded = s.exceeded,
                                 .unfinished = s.ended[CEDUO_UNFINISHED],
                                 .hazard = ceduo_hazard_none(),
                                 .exact = run->exact};
    memcpy(a->ended, s.ended, sizeof a->ended);
    for (int e = 0; e < CEDUO_ENDS; e++)
        a->missed[e] = (double)s.ended[e] / (double)run->rocks;
    a->reach_probability = share(a->reached, a->unfinished, run->rocks, &a->reach_lo, &a->reach_hi);
    a->exceed_probability = a->exceed_lo = a->exceed_hi = NAN;
    if (!isnan(run->ready.scene.controls[control].accepted))
        a->exceed_probability = share(a->exceeded, a->unfinished, run->rocks, &a->exceed_lo, &a->exceed_hi);
    a->reach_se = share_se(a->reach_probability, run->rocks);
    a->exceed_se = share_se(a->exceed_probability, run->rocks);
    per_released(&s.of[ENERGY], run->rocks, &a->energy_per_released, &a->energy_per_released_se);
    a->contacts = !run->ready.wood.bare && s.contacts.n > 0 ? s.contacts.mean : NAN;
    a->contacts_se = run->ready.wood.bare ? NAN : ceduo_moments_se(&s.contacts);
    double *scratch = malloc(((size_t)run->rocks + 1) * sizeof(double));
    if (!scratch)
        return CEDUO_NO_MEMORY;
    a->speed = distribution(run, control, SPEED, &s.of[SPEED], scratch);
    a->height = distribution(run, control, HEIGHT, &s.of[HEIGHT], scratch);
    if (run->kept == QUANTITIES) {
        a->energy = distribution(run, control, ENERGY, &s.of[ENERGY], scratch);
        a->translation = distribution(run, control, TRANSLATION, &s.of[TRANSLATION], scratch);
    } else {
        a->energy = a->translation = energy_from_speed(&a->speed, run->ready.mean.mass, &s.of[ENERGY]);
    }
    free(scratch);
    adjust(run, &s, a);
    return CEDUO_OK;
}

struct ceduo_brief ceduo_run_brief(const struct ceduo_run *run, size_t control)
{
    if (run->sized)
        return ceduo_run_sized_brief(run, control);
    struct sums s = ceduo_run_sums_at(run, control);
    const struct ceduo_moments *energy = &s.of[ENERGY];
    bool accepts = !isnan(run->ready.scene.controls[control].accepted);
    double n = (double)run->rocks, per_rock, se;
    per_released(energy, run->rocks, &per_rock, &se);
    struct adjusted a;
    if (ceduo_run_adjust(run, &s, &a))
        return (struct ceduo_brief){
            .reach_probability = ceduo_run_adjusted_share(&a, VARIED_REACHED),
            .exceed_probability = accepts ? ceduo_run_adjusted_share(&a, VARIED_EXCEEDED) : NAN,
            .energy = ceduo_run_adjusted_mean(&a, VARIED_ENERGY, energy).mean,
            .energy_per_released = ceduo_run_adjusted_per_released(&a, energy).mean};
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
    struct adjusted a;
    if (!ceduo_run_adjust(run, &s, &a))
        return;
    struct ceduo_paired adjusted = ceduo_run_adjusted_mean(&a, VARIED_ENERGY, &s.of[ENERGY]);
    *mean = adjusted.mean;
    *se = adjusted.se;
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

/* A mean of all rocks with the spread of those that are paired. */
static struct ceduo_paired paired(double mean, const struct ceduo_moments *m, uint64_t rocks)
{
    return (struct ceduo_paired){mean, ceduo_moments_sd(m) / sqrt((double)rocks)};
}

/* The rocks that both runs have, moments of their differences. */
struct pairs {
    uint64_t rocks;
    struct ceduo_moments reach, exceed, energy;
};

/* `same`: they do not differ up to the control. */
static struct pairs pair(const struct ceduo_run *run, const struct ceduo_run *baseline, size_t control, bool same)
{
    double accepted = run->ready.scene.controls[control].accepted;
    uint64_t a = paired_rocks(run), b = paired_rocks(baseline);
    struct pairs p = {.rocks = a < b ? a : b};
    if (same)
        p.reach = p.exceed = p.energy = (struct ceduo_moments){.n = p.rocks};
    for (uint64_t r = 0; r < p.rocks && !same; r++) {
        double e = paired_energy(run, control, r), f = paired_energy(baseline, control, r);
        ceduo_moments_add(&p.reach, (double)!isnan(e) - (double)!isnan(f));
        ceduo_moments_add(&p.exceed, (double)(e > accepted) - (double)(f > accepted));
        ceduo_moments_add(&p.energy, (isnan(e) ? 0 : e) - (isnan(f) ? 0 : f));
    }
    return p;
}

/* One run of a difference: its adjusted shares and mean, and what its rocks' variates tell of them; nothing where they are
 * as counted. */
enum { PAIRED_REACH, PAIRED_EXCEED, PAIRED_ENERGY, PAIRED };
struct paired_run {
    double mean[PAIRED], slopes[PAIRED][VARIATES];
    double used, chance; /* of its fit: variates, and by how much more its errors are */
};

static struct paired_run read_paired(const struct ceduo_run *run, const struct sums *s, bool *adjusted)
{
    const enum varied which[PAIRED] = {VARIED_REACHED, VARIED_EXCEEDED, VARIED_ENERGY};
    const struct ceduo_moments *energy = &s->of[ENERGY];
    double n = (double)run->rocks;
    struct paired_run p = {.mean = {(double)energy->n / n, (double)s->exceeded / n, energy->mean * (double)energy->n / n}};
    struct adjusted a;
    if (!ceduo_run_adjust(run, s, &a))
        return p;
    *adjusted = true;
    p.used = a.fit.used;
    p.chance = n * a.fit.chance_square;
    for (int k = 0; k < PAIRED; k++)
        ceduo_varied_slopes(&a.fit, &a.sums[which[k]], p.slopes[k]);
    p.mean[PAIRED_REACH] = ceduo_run_adjusted_share(&a, VARIED_REACHED);
    p.mean[PAIRED_EXCEED] = ceduo_run_adjusted_share(&a, VARIED_EXCEEDED);
    p.mean[PAIRED_ENERGY] = ceduo_varied_mean(&a.fit, &a.sums[VARIED_ENERGY]);
    return p;
}

/* What a rock brings beyond what its variates tell. */
static void beyond_variates(const struct ceduo_run *run, const struct paired_run *p, size_t control, uint64_t rock,
                            double to[PAIRED])
{
    double e = paired_energy(run, control, rock);
    const float *x = varied_of(run, rock);
    to[PAIRED_REACH] = !isnan(e);
    to[PAIRED_EXCEED] = e > run->ready.scene.controls[control].accepted;
    to[PAIRED_ENERGY] = isnan(e) ? 0 : e;
    for (int k = 0; k < PAIRED; k++)
        for (size_t v = 0; v < VARIATES; v++)
            to[k] -= p->slopes[k][v] * (double)x[v];
}

/* Moments of the differences of what rocks bring beyond their variates, of the first rocks. */
static void pair_beyond(const struct ceduo_run *run, const struct paired_run *a, const struct ceduo_run *baseline,
                        const struct paired_run *b, size_t control, uint64_t rocks, struct ceduo_moments m[PAIRED])
{
    for (uint64_t r = 0; r < rocks; r++) {
        double one[PAIRED], other[PAIRED];
        beyond_variates(run, a, control, r, one);
        beyond_variates(baseline, b, control, r, other);
        for (int k = 0; k < PAIRED; k++)
            ceduo_moments_add(&m[k], one[k] - other[k]);
    }
}

/* Makes it the difference of adjusted figures, unless both are as counted. Where no variates of single rocks are kept, its error
 * stays that of the difference as counted, which is larger. */
static void adjust_difference(const struct ceduo_run *run, const struct sums *s, const struct ceduo_run *baseline,
                              const struct sums *t, size_t control, struct ceduo_difference *d)
{
    bool adjusted = false;
    struct paired_run a = read_paired(run, s, &adjusted), b = read_paired(baseline, t, &adjusted);
    uint64_t rocks = paired_rocks(run), others = paired_rocks(baseline);
    rocks = varied_rocks(run, rocks < others ? rocks : others);
    if (!adjusted)
        return;
    struct ceduo_moments m[PAIRED] = {{0}};
    pair_beyond(run, &a, baseline, &b, control, rocks, m);
    double n = (double)run->rocks, used = fmax(a.used, b.used);
    double more = (n - 1) / (n - 1 - used) * (1 + fmax(a.chance, b.chance));
    struct ceduo_paired *to[PAIRED] = {&d->reach_probability, &d->exceed_probability, &d->energy_per_released};
    for (int k = 0; k < PAIRED; k++) {
        struct ceduo_paired found = paired(a.mean[k] - b.mean[k], &m[k], run->rocks);
        to[k]->mean = found.mean;
        if (rocks >= 2)
            to[k]->se = found.se * sqrt(more);
    }
}

struct ceduo_difference ceduo_run_difference(const struct ceduo_run *run, const struct ceduo_run *baseline,
                                             size_t control)
{
    const struct ceduo_paired unknown = {NAN, NAN};
    bool alike = run && baseline && run->rocks == baseline->rocks;
    if (!alike && !(run && baseline && run->exact && baseline->exact && run->rocks > 0 && baseline->rocks > 0))
        return (struct ceduo_difference){unknown, unknown, unknown};
    if (run->sized)
        return ceduo_run_sized_difference(run, baseline, control);
    double n = (double)run->rocks, x = run->ready.scene.controls[control].x;
    bool same = alike && (run == baseline || (run->stems_from >= x && baseline->stems_from >= x));
    struct pairs p = pair(run, baseline, control, same);
    struct sums s = ceduo_run_sums_at(run, control), t = ceduo_run_sums_at(baseline, control);
    const struct ceduo_moments *e = &s.of[ENERGY], *f = &t.of[ENERGY];
    struct ceduo_difference d = {.reach_probability = paired(p.reach.mean, &p.reach, p.rocks),
                                 .exceed_probability = paired(p.exceed.mean, &p.exceed, p.rocks),
                                 .energy_per_released = paired(p.energy.mean, &p.energy, p.rocks)};
    if (alike)
        d = (struct ceduo_difference){
            .reach_probability = paired(((double)e->n - (double)f->n) / n, &p.reach, run->rocks),
            .exceed_probability = paired(((double)s.exceeded - (double)t.exceeded) / n, &p.exceed, run->rocks),
            .energy_per_released = paired((e->mean * (double)e->n - f->mean * (double)f->n) / n, &p.energy, run->rocks)};
    if (alike && !same)
        adjust_difference(run, &s, baseline, &t, control, &d);
    if (isnan(run->ready.scene.controls[control].accepted))
        d.exceed_probability = unknown;
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

/* Shares of the whole profile that agree with those at the last control: of the rocks that arrive there, as many end in each way
 * as were counted. */
static void adjust_ends(const struct ceduo_run *run, double share[CEDUO_ENDS], const uint64_t count[CEDUO_ENDS])
{
    if (run->controls == 0 || run->rocks == 0)
        return;
    struct adjusted a;
    struct sums s = ceduo_run_sums_at(run, run->last_control);
    if (!ceduo_run_adjust(run, &s, &a))
        return;
    double each = ceduo_run_adjusted_share(&a, VARIED_REACHED) / (double)s.of[SPEED].n;
    for (int e = 0; e < CEDUO_ENDS; e++)
        share[e] = ceduo_run_adjusted_share(&a, (enum varied)(VARIED_ENDED + e)) + each * (double)(count[e] - s.ended[e]);
}

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
    adjust_ends(run, ends->share, ends->count);
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
