/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict.h"

#include <math.h>
#include <stdlib.h>

#include "base/grow.h"
#include "ceduo/key.h"

double ceduo_share_of(const struct ceduo_arrivals *arrivals)
{
    return isnan(arrivals->exceed_probability) ? arrivals->reach_probability : arrivals->exceed_probability;
}

struct ceduo_portion ceduo_share_at(const struct ceduo_arrivals *a)
{
    if (!a)
        return (struct ceduo_portion){NAN, NAN};
    double share = ceduo_share_of(a);
    double half = ceduo_half_width_of_share(share, ceduo_share_se(share, (double)a->released), a->released);
    if (!isnan(a->hazard.per_year)) /* rocks have weights */
        half = (isnan(a->exceed_probability) ? a->reach_hi - a->reach_lo : a->exceed_hi - a->exceed_lo) / 2;
    return (struct ceduo_portion){share, half};
}

/* The difference of what is compared. */
static struct ceduo_paired compared(const struct ceduo_result *r, const struct ceduo_difference *d)
{
    return isnan(r->scene->controls[r->last_control].accepted) ? d->reach_probability : d->exceed_probability;
}

struct ceduo_paired ceduo_share_to_first(const struct ceduo_result *r, size_t option)
{
    return compared(r, &r->options[option].differences[r->last_control]);
}

/* ---- which is best ---- */

/* A figure of one option less that of another, with its standard error. */
typedef struct ceduo_paired difference_of(const void *context, size_t option, size_t less);

static bool is_clearly_worse(difference_of *difference, const void *context, size_t option, size_t than)
{
    struct ceduo_paired d = difference(context, option, than);
    return d.mean > CEDUO_CLEAR * d.se;
}

static void find_best(difference_of *difference, const void *context, size_t n, struct ceduo_leader *leader)
{
    leader->best = leader->rivals = 0;
    for (size_t i = 1; i < n; i++)
        if (difference(context, i, leader->best).mean < 0)
            leader->best = i;
    for (size_t i = 0; i < n; i++) {
        leader->rival[i] = i != leader->best && !is_clearly_worse(difference, context, i, leader->best);
        leader->rivals += leader->rival[i];
    }
}

/* One difference to the first option less another. Where no pair differs the error is not known: it is as good as 0. */
static struct ceduo_paired beside_first(struct ceduo_paired a, struct ceduo_paired b)
{
    return (struct ceduo_paired){a.mean - b.mean, hypot(a.below > 0 ? 0 : a.se, b.below > 0 ? 0 : b.se), 0};
}

/* From the differences to the first option: the error of a difference of two of them is rather too large. */
static struct ceduo_paired difference_today(const void *context, size_t option, size_t less)
{
    struct ceduo_paired a = ceduo_share_to_first(context, option), b = ceduo_share_to_first(context, less);
    return beside_first(a, b);
}

static struct ceduo_paired difference_by_other_law(const void *context, size_t option, size_t less)
{
    const struct ceduo_result *r = context;
    const struct ceduo_other_energy *one = &r->options[option].others[r->last_control];
    const struct ceduo_other_energy *two = &r->options[less].others[r->last_control];
    bool alike = one->known && two->known && (one->model == two->model || !one->stems || !two->stems);
    if (!alike)
        return CEDUO_NOT_PAIRED;
    return beside_first(compared(r, &one->to_first), compared(r, &two->to_first));
}

static struct ceduo_paired difference_over_years(const void *context, size_t option, size_t less)
{
    struct ceduo_years *const *years = context;
    return ceduo_years_difference(years[option], years[less]);
}

/* ---- one option ---- */

static void read_years(const struct ceduo_years *years, struct ceduo_choice *c)
{
    const struct ceduo_years_summary s = c->over = ceduo_years_sum(years, years->last_control);
    c->rocks = years->rocks;
    c->energy_known &= !s.nothing;
    c->worst.mean = s.worst; /* by the index an ADC: it has no error */
    for (size_t i = 0; i < years->count; i++)
        if (years->years[i].year == s.worst_year && years->years[i].wooded.rocks > 0)
            c->worst = ceduo_share_at(&years->years[i].wooded.arrivals[years->last_control]);
    struct ceduo_paired mean = isnan(s.exceed.mean) ? s.reach : s.exceed;
    c->mean = (struct ceduo_portion){mean.mean, ceduo_half_width_of_share(mean.mean, mean.se, years->rocks)};
}

static enum ceduo_status read_choice(const struct ceduo_result *r, const struct ceduo_years *years, size_t option,
                                     struct ceduo_choice *c)
{
    const struct ceduo_portion unknown = {NAN, NAN};
    const struct ceduo_option *o = &r->scene->options[option];
    struct ceduo_window rotation = ceduo_window_of(o);
    *c = (struct ceduo_choice){.today = unknown, .worst = unknown, .mean = unknown};
    c->window = years ? years->window : ceduo_window_in(r->scene, o);
    if (r->scene->controls_count > 0) {
        c->today = ceduo_share_at(ceduo_result_wooded(r, option, r->last_control));
        c->energy_known = r->wooded && !isnan(r->scene->controls[r->last_control].accepted);
        if (years)
            read_years(years, c);
    }
    unsigned end = rotation.last + 1, most = end + CEDUO_PERIOD_MOST;
    unsigned last = c->window.last < end ? end : c->window.last < most ? c->window.last : most;
    return ceduo_yield_of(o, last, &c->yield);
}

/* ---- all options ---- */

static bool is_beaten(struct ceduo_years *const *years, const struct ceduo_verdict *v, size_t option)
{
    double yield = v->choices[option].yield.cut_per_year;
    for (size_t i = 0; i < v->n; i++) {
        double other = v->choices[i].yield.cut_per_year;
        bool clear = is_clearly_worse(difference_over_years, years, option, i);
        if (i != option && other >= yield && (clear || (other > yield && difference_over_years(years, option, i).mean >= 0)))
            return true;
    }
    return false;
}

/* How many standard errors worse than `better` an option is. */
static double errors_worse(difference_of *difference, const void *context, size_t option, size_t better)
{
    struct ceduo_paired d = difference(context, option, better);
    return d.mean / d.se;
}

/* Pairs of which under one law the order is clear, and under the other it is the other way round by more than chance makes likely.
 * False without memory. */
static bool find_turned(const struct ceduo_result *r, struct ceduo_verdict *v)
{
    size_t room = 0;
    for (size_t i = 0; i < v->n; i++)
        for (size_t k = 0; k < v->n; k++) {
            double now = errors_worse(difference_today, r, k, i), other = errors_worse(difference_by_other_law, r, i, k);
            if (i == k || !(fmin(now, other) > 1 && fmax(now, other) > CEDUO_CLEAR))
                continue;
            struct ceduo_turned *grown = ceduo_grow(v->turned, v->turned_count, &room, sizeof *grown);
            if (!grown)
                return false;
            v->turned = grown;
            v->turned[v->turned_count++] = (struct ceduo_turned){i, k};
        }
    return true;
}

static uint64_t rocks_of(const struct ceduo_result *r, struct ceduo_years *const *years, size_t option)
{
    return years ? years[option]->rocks : r->options[option].wooded.rocks;
}

/* `years` NULL: today. */
static void find_leader(const struct ceduo_result *r, struct ceduo_years *const *years, const struct ceduo_verdict *v,
                        struct ceduo_leader *leader)
{
    leader->known = v->n > 1;
    for (size_t i = 0; i < v->n && leader->known; i++)
        leader->known = !isnan(years ? v->choices[i].mean.mean : v->choices[i].today.mean);
    for (size_t i = 0; i < v->n && leader->known; i++) {
        leader->known = years || !isnan(difference_today(r, i, 0).mean);
        leader->uneven |= rocks_of(r, years, i) != rocks_of(r, years, 0);
    }
    if (!leader->known)
        return;
    difference_of *difference = years ? difference_over_years : difference_today;
    const void *context = years ? (const void *)years : r;
    find_best(difference, context, v->n, leader);
    leader->equal = leader->rivals > 0;
    for (size_t i = 0; i < v->n; i++) { /* the same forests, today or year by year */
        const struct ceduo_option *one = &r->scene->options[i], *best = &r->scene->options[leader->best];
        bool same = years ? ceduo_years_key(one) == ceduo_years_key(best)
                          : ceduo_option_key(r->scene, one) == ceduo_option_key(r->scene, best);
        leader->equal &= !leader->rival[i] || (same && difference(context, i, leader->best).mean == 0);
    }
}

enum ceduo_status ceduo_verdict_make(const struct ceduo_result *r, struct ceduo_years *const *years, struct ceduo_verdict *v)
{
    size_t n = r->options_count;
    *v = (struct ceduo_verdict){
        .wooded = r->wooded && r->scene->controls_count > 0,
        .accepted = r->scene->controls_count > 0 && !isnan(r->scene->controls[r->last_control].accepted),
        .nothing = r->scene->controls_count > 0 && ceduo_says_nothing(&r->bare.arrivals[r->last_control]),
        .choices = calloc(n + 1, sizeof *v->choices)};
    v->today.rival = calloc(n + 1, sizeof *v->today.rival);
    v->rotation.rival = calloc(n + 1, sizeof *v->rotation.rival);
    enum ceduo_status status = v->choices && v->today.rival && v->rotation.rival ? CEDUO_OK : CEDUO_NO_MEMORY;
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        status = read_choice(r, years ? years[i] : NULL, i, &v->choices[i]);
        v->n = i + (status == CEDUO_OK);
    }
    if (status == CEDUO_OK && !v->nothing) {
        find_leader(r, NULL, v, &v->today);
        if (years)
            find_leader(r, years, v, &v->rotation);
        for (size_t i = 0; i < n && v->rotation.known; i++)
            v->choices[i].beaten = is_beaten(years, v, i);
        status = !v->wooded || find_turned(r, v) ? CEDUO_OK : CEDUO_NO_MEMORY;
    }
    if (status != CEDUO_OK)
        ceduo_verdict_release(v);
    return status;
}

void ceduo_verdict_release(struct ceduo_verdict *v)
{
    for (size_t i = 0; i < v->n; i++)
        ceduo_yield_release(&v->choices[i].yield);
    free(v->choices);
    free(v->today.rival);
    free(v->rotation.rival);
    free(v->turned);
    *v = (struct ceduo_verdict){0};
}
