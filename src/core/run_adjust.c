/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means and shares at a control, adjusted by what chance did to the variates of the rocks (variates.h). Where that is not
 * sound, they stay as they are. */
#include <math.h>

#include "run_state.h"

#define ADJUST_ROCKS   200 /* so many rocks for ten variates, */
#define ADJUST_REACHED 100 /* of which so many arrive, make a regression of use */

static double total(const struct sums *s, enum varied varied)
{
    static const int quantity[VARIED_ENDED] = {
        [VARIED_SPEED] = SPEED, [VARIED_HEIGHT] = HEIGHT, [VARIED_ENERGY] = ENERGY, [VARIED_TRANSLATION] = TRANSLATION};
    if (varied == VARIED_REACHED)
        return (double)s->of[SPEED].n;
    if (varied == VARIED_EXCEEDED)
        return (double)s->exceeded;
    if (varied >= VARIED_ENDED)
        return (double)s->ended[varied - VARIED_ENDED];
    return s->of[quantity[varied]].mean * (double)s->of[quantity[varied]].n;
}

/* Weights below 0, which few rocks may make, would show. */
static bool are_shares(const struct adjusted *a)
{
    for (int e = 0; e < CEDUO_ENDS; e++)
        if (!(ceduo_run_adjusted_share(a, (enum varied)(VARIED_ENDED + e)) >= 0))
            return false;
    double reach = ceduo_run_adjusted_share(a, VARIED_REACHED), exceed = ceduo_run_adjusted_share(a, VARIED_EXCEEDED);
    return reach > 0 && reach <= 1 && exceed >= 0 && exceed <= reach;
}

bool ceduo_run_adjust(const struct ceduo_run *run, const struct sums *s, struct adjusted *a)
{
    double n = (double)run->rocks;
    if (run->def.plain || run->sized || run->rocks < ADJUST_ROCKS || s->of[SPEED].n < ADJUST_REACHED)
        return false;
    struct variate_sums variates = run->whole.variates;
    ceduo_variates_merge(&variates, &run->tail.variates);
    if (!ceduo_variates_fit(&variates, n, &a->fit))
        return false;
    for (enum varied k = 0; k < VARIED; k++)
        a->sums[k] = ceduo_variates_sum(&a->fit, &s->varied, k, total(s, k));
    return are_shares(a);
}

/* Of none and of all it is that exactly. */
double ceduo_run_adjusted_share(const struct adjusted *a, enum varied which)
{
    double count = a->sums[which].y;
    return count == 0 ? 0 : count == a->fit.n ? 1 : ceduo_varied_mean(&a->fit, &a->sums[which]);
}

double ceduo_run_adjusted_share_se(const struct adjusted *a, enum varied which)
{
    double count = a->sums[which].y;
    return sqrt(ceduo_varied_variance(&a->fit, &a->sums[which], count * (1 - count / a->fit.n)));
}

/* The ratio of two adjusted means; its error is that of what each rock brings beyond it. */
struct ceduo_paired ceduo_run_adjusted_mean(const struct adjusted *a, enum varied which, const struct ceduo_moments *m)
{
    const struct varied_sum *all = &a->sums[VARIED_REACHED];
    double reach = ceduo_run_adjusted_share(a, VARIED_REACHED), n = (double)m->n;
    double mean = fmin(m->max, ceduo_varied_mean(&a->fit, &a->sums[which]) / reach);
    struct varied_sum beyond = ceduo_varied_less(a->sums[which], mean, *all);
    double off = m->mean - mean, square = m->m2 + n * (off * off) * (1 - n / a->fit.n);
    return (struct ceduo_paired){mean, sqrt(ceduo_varied_variance(&a->fit, &beyond, square)) / reach};
}

struct ceduo_paired ceduo_run_adjusted_per_released(const struct adjusted *a, const struct ceduo_moments *energy)
{
    const struct varied_sum *sum = &a->sums[VARIED_ENERGY];
    double n = (double)energy->n, square = energy->m2 + energy->mean * energy->mean * n * (1 - n / a->fit.n);
    return (struct ceduo_paired){ceduo_varied_mean(&a->fit, sum), sqrt(ceduo_varied_variance(&a->fit, sum, square))};
}
