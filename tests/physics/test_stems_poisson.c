/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The contact model poisson: hits of every rule come as a Poisson process, and each takes its stratum's work. */
#include "expect.h"

#include <math.h>
#include <string.h>

#include "stems_scene.h"

/* Four kinds of stem, each with a work of its own (J). */
enum { YOUNG, OLD, STANDARD, RESERVE, KINDS };
static const double kind_per_ha[KINDS] = {3000, 2400, 300, 120}, kind_dbh[KINDS] = {.05, .11, .15, .30},
                    kind_work[KINDS] = {1e-6, 3e-6, 7e-6, 20e-6};
#define STOOLS 1500.

static void plant_kinds(double from, double to, double spacing)
{
    struct ceduo_belt *belt = plant_belt(from, to, STOOLS, spacing);
    for (int k = 0; k < KINDS; k++) {
        struct ceduo_stems *s = (k < STANDARD ? plant_shoots : plant_trees)(belt, kind_per_ha[k], kind_dbh[k]);
        s->volume = kind_work[k];
        s->height = .01; /* does not matter */
    }
}

/* What is met as one: its rate per metre and its work. */
struct strata {
    size_t n;
    double rate[KINDS], work[KINDS];
};

static void add_stratum(struct strata *s, double rate, double work)
{
    s->rate[s->n] = rate;
    s->work[s->n++] = work;
}

static double mean_dbh(int kinds)
{
    double n = 0, sum = 0;
    for (int k = 0; k < kinds; k++) {
        n += kind_per_ha[k];
        sum += kind_per_ha[k] * kind_dbh[k];
    }
    return sum / n;
}

/* By the equations of the paper and Crofton's formula. */
static struct strata strata_of(enum ceduo_rule rule, double spacing)
{
    struct strata s = {0};
    const double *n = kind_per_ha, *d = kind_dbh, *w = kind_work;
    if (rule == CEDUO_GSTEIGER_STEMS) {
        for (int k = 0; k < KINDS; k++)
            add_stratum(&s, per_metre(n[k], B + d[k]), w[k]);
        return s;
    }
    double work = (n[YOUNG] * w[YOUNG] + n[OLD] * w[OLD]) / (n[YOUNG] + n[OLD]), width = B + mean_dbh(STANDARD);
    bool alike = rule == CEDUO_GSTEIGER_STOOLS; /* Eq. 1: all as thick as the mean of all stems */
    if (alike)
        width = B + mean_dbh(KINDS);
    else if (rule == CEDUO_INTERCEPTION) /* Eq. 6 */
        width += spacing;
    else
        width += spacing * (n[YOUNG] + n[OLD]) / STOOLS / M_PI;
    add_stratum(&s, per_metre(STOOLS, width), work);
    for (int k = STANDARD; k < KINDS; k++)
        add_stratum(&s, per_metre(n[k], B + (alike ? mean_dbh(KINDS) : d[k])), w[k]);
    return s;
}

static void count_strata(const struct strata *strata, double counts[KINDS], double *work)
{
    *work = 0;
    memset(counts, 0, KINDS * sizeof *counts);
    for (size_t i = 0; i < sweep.count; i++) {
        const struct ceduo_stem_passed *s = &sweep.stems[i];
        size_t k = 0;
        while (k < strata->n && !(fabs(s->taken / strata->work[k] - 1) < 1e-12))
            k++;
        if (k == strata->n || !s->hit || !isnan(s->y) || !isnan(s->dbh) || !isinf(s->height))
            fail_msg("a contact that takes %.15g J", s->taken);
        counts[k]++;
        *work += s->taken;
    }
}

static void expect_compound(const char *name, const struct strata *strata, double metres, uint64_t rocks)
{
    static uint64_t count[COUNTS_MOST];
    struct spread all = {0}, work = {0}, each[KINDS] = {0};
    memset(count, 0, sizeof count);
    sweep_begin();
    for (uint64_t rock = 0; rock < rocks; rock++) {
        double counts[KINDS], sum;
        sweep_rock(rock);
        count_strata(strata, counts, &sum);
        count[sweep.count]++;
        spread_add(&all, (double)sweep.count);
        spread_add(&work, sum);
        for (size_t k = 0; k < strata->n; k++)
            spread_add(&each[k], counts[k]);
    }
    sweep_end();
    double contacts = 0, mean = 0, variance = 0;
    for (size_t k = 0; k < strata->n; k++) {
        contacts += metres * strata->rate[k];
        mean += metres * strata->rate[k] * strata->work[k];
        variance += metres * strata->rate[k] * strata->work[k] * strata->work[k];
    }
    for (size_t k = 0; k < strata->n; k++) {
        expect_mean(named("%s, contacts of stratum %zu", name, k), &each[k], metres * strata->rate[k]);
    }
    expect_mean(named("%s, contacts", name), &all, contacts);
    expect_variance(named("%s, variance of contacts", name), &all, contacts);
    expect_poisson(named("%s, counts", name), count, contacts);
    expect_mean(named("%s, J taken", name), &work, mean);
    expect_variance(named("%s, variance of J taken", name), &work, variance);
}

TEST(contacts_of_every_rule_are_poisson_and_take_each_stratums_work)
{
    static const struct {
        const char *name;
        enum ceduo_rule rule, meant;
        double spacing;
    } rows[] = {{"gsteiger-stools", CEDUO_GSTEIGER_STOOLS, CEDUO_GSTEIGER_STOOLS, .4},
                {"gsteiger-stems", CEDUO_GSTEIGER_STEMS, CEDUO_GSTEIGER_STEMS, .4},
                {"interception", CEDUO_INTERCEPTION, CEDUO_INTERCEPTION, .4},
                {"crofton", CEDUO_CROFTON, CEDUO_CROFTON, .4},
                {"auto, B > s", CEDUO_RULE_AUTO, CEDUO_INTERCEPTION, .4},
                {"auto, B < s", CEDUO_RULE_AUTO, CEDUO_GSTEIGER_STEMS, .7}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        clear_plane(520);
        plane.line.scene.simulation.contact_model = CEDUO_POISSON;
        plane.line.scene.simulation.rule = rows[i].rule;
        plane.line.scene.simulation.seed = i + 1;
        plant_kinds(100, 300, rows[i].spacing);
        struct strata strata = strata_of(rows[i].meant, rows[i].spacing);
        double contacts = 0;
        for (size_t k = 0; k < strata.n; k++)
            contacts += 200 * strata.rate[k];
        expect_compound(rows[i].name, &strata, 200, (uint64_t)(1.02e6 / contacts));
    }
}
