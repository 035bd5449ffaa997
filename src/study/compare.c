/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "compare.h"

#include <math.h>

double ceduo_compare_share_of(const struct ceduo_arrivals *arrivals)
{
    return isnan(arrivals->exceed_probability) ? arrivals->reach_probability : arrivals->exceed_probability;
}

double ceduo_compare_share(const struct ceduo_result *result, size_t option, double *half)
{
    const struct ceduo_arrivals *a = ceduo_result_wooded(result, option, result->last_control);
    *half = NAN;
    if (!a)
        return NAN;
    double share = ceduo_compare_share_of(a);
    *half = ceduo_half_width_of_share(share, sqrt(share * (1 - share) / (double)a->released), a->released);
    return share;
}

double ceduo_compare_difference(const struct ceduo_result *result, size_t option, double *half)
{
    const struct ceduo_difference *d = &result->options[option].differences[result->last_control];
    struct ceduo_paired found = isnan(d->exceed_probability.mean) ? d->reach_probability : d->exceed_probability;
    const struct ceduo_arrivals *a = ceduo_result_wooded(result, option, result->last_control);
    double room, share = ceduo_compare_share(result, option, &room), first = ceduo_compare_share(result, 0, &room);
    *half = !a               ? NAN
            : share == first ? ceduo_half_width_of_share(share, found.se, a->released)
                             : CEDUO_Z95 * found.se;
    return found.mean;
}

/* The figure of an option by energy, its standard error, and that of its difference to the first option. */
static double by_energy(const struct ceduo_result *result, size_t option, double *se)
{
    size_t c = result->last_control;
    const struct ceduo_arrivals *a = ceduo_result_wooded(result, option, c);
    const struct ceduo_difference *d = &result->options[option].differences[c];
    *se = NAN;
    if (!a)
        return NAN;
    bool shares = !isnan(a->exceed_probability);
    *se = option == 0 ? 0 : shares ? d->exceed_probability.se : d->energy_per_released.se;
    return shares ? a->exceed_probability : a->energy_per_released;
}

static size_t best_by_energy(const struct ceduo_result *result)
{
    size_t best = 0;
    double se;
    for (size_t i = 1; i < result->options_count; i++)
        if (by_energy(result, i, &se) < by_energy(result, best, &se))
            best = i;
    return best;
}

/* The error of a difference of two options from those of their differences to the first: rather too large. */
bool ceduo_compare_worse(const struct ceduo_result *result, size_t option, size_t than)
{
    double se, than_se, value = by_energy(result, option, &se), other = by_energy(result, than, &than_se);
    return value - other > 2 * hypot(se, than_se);
}

/* Positive where option i is better by contact than option k, 0 where contact does not tell them apart. */
static int better_by_contact(const struct ceduo_result *result, size_t i, size_t k)
{
    const struct ceduo_index *here = ceduo_result_last_index(result, i);
    const struct ceduo_index *there = ceduo_result_last_index(result, k);
    int passes = here->contact == CEDUO_PASS, passed = there->contact == CEDUO_PASS;
    return passes != passed ? passes - passed : (here->worst_adc < there->worst_adc) - (here->worst_adc > there->worst_adc);
}

/* Of options that contact does not tell apart the one that is best by energy. */
static size_t best_by_contact(const struct ceduo_result *result)
{
    size_t best = 0;
    double se;
    for (size_t i = 1; i < result->options_count; i++) {
        int better = better_by_contact(result, i, best);
        if (better > 0 || (better == 0 && by_energy(result, i, &se) < by_energy(result, best, &se)))
            best = i;
    }
    return best;
}

struct ceduo_best ceduo_compare_best(const struct ceduo_result *result)
{
    size_t n = result->options_count, worse = 0, behind = 0;
    struct ceduo_best best = {.known = false};
    if (n < 2 || !result->wooded || result->scene->controls_count == 0)
        return best;
    for (size_t i = 0; i < n; i++)
        if (!ceduo_result_wooded(result, i, result->last_control))
            return best;
    best.known = true;
    best.contact = best_by_contact(result);
    best.energy = best_by_energy(result);
    for (size_t i = 0; i < n; i++) {
        worse += ceduo_compare_worse(result, i, best.energy);
        behind += better_by_contact(result, best.contact, i) > 0;
    }
    best.apart = behind > 0;
    best.before_some = worse > 0;
    best.before_all = worse == n - 1;
    return best;
}
