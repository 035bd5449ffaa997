/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lights with a figure exactly at its limit. An ADC equal to the threshold fails; a gap equal to the threshold, a share of
 * 0.05, and the accepted energy itself pass. All equalities are exact in doubles, and the next double decides otherwise. */
#include "core/runs/assess.h"
#include "core/runs/run.h"
#include "core/runs/statistics.h"
#include "expect.h"
#include "local.h"

#include <math.h>
#include <stdlib.h>

#include "bench/measure.h"
#include "line_scene.h"
#include "paper_site.h"
#include "runs.h"

/* ---- index ---- */

/* The paper's slope and control with a sphere of 3/4 m, and trees of 1/4 m in two belts: the ADC of N trees per hectare is
 * 10^4/N m in every form. */
static struct paper_site site;

static void plant_trees(double first_per_ha, double second_per_ha)
{
    paper_site_init(&site);
    site.scene.rock = ceduo_scene_default().rock;
    site.scene.rock.diameter = ceduo_number(.75);
    for (size_t i = 0; i < 2; i++) {
        site.belts[i].stand.shoots_count = 0;
        site.belts[i].stand.stools_per_ha = 0;
        site.plots[i].trees.dbh = .25;
        site.plots[i].trees.per_ha = i == 0 ? first_per_ha : second_per_ha;
    }
}

static struct ceduo_index assess(void)
{
    return ceduo_assess_index(&site.scene, &site.option, &site.control, NAN);
}

static double next_above(double value)
{
    return nextafter(value, INFINITY);
}

static double next_below(double value)
{
    return nextafter(value, -INFINITY);
}

TEST(an_adc_as_long_as_the_threshold_fails)
{
    for (size_t worst = 0; worst < 2; worst++) {
        plant_trees(worst == 0 ? 400 : 1000, worst == 0 ? 1000 : 400);
        site.scene.simulation.threshold = 25; /* 10^4/400 */
        struct ceduo_index at = assess();
        EXPECT_IS(at, (worst_adc, 25), (longest_gap, 0), (contact, CEDUO_LIGHT_FAIL));
        assert_false(ceduo_assess_stand(&site.scene, &site.belts[worst]).passes_threshold);
        assert_true(ceduo_assess_stand(&site.scene, &site.belts[1 - worst]).passes_threshold);
        site.scene.simulation.threshold = next_above(25);
        at = assess();
        EXPECT(at.contact, ==, CEDUO_LIGHT_PASS);
        assert_true(ceduo_assess_stand(&site.scene, &site.belts[worst]).passes_threshold);
    }
}

/* From the release at 0 to the control at 135 m with threshold 30 m: before, between and after the belts. */
TEST(a_gap_as_long_as_the_threshold_passes)
{
    static const double at_limit[][4] = {{30, 67.5, 67.5, 135}, {0, 50, 80, 135}, {0, 67.5, 67.5, 105}};
    const double beyond[][4] = {
        {next_above(30), 67.5, 67.5, 135}, {0, next_below(50), 80, 135}, {0, 67.5, 67.5, next_below(105)}};
    for (size_t i = 0; i < 3; i++)
        for (int longer = 0; longer < 2; longer++) {
            const double *ends = longer ? beyond[i] : at_limit[i];
            plant_trees(1000, 1000);
            EXPECT(site.scene.simulation.threshold, ==, 30);
            for (size_t b = 0; b < 2; b++) {
                site.belts[b].from = ends[2 * b];
                site.belts[b].to = ends[2 * b + 1];
            }
            struct ceduo_index found = assess();
            assert_true(longer ? found.longest_gap > 30 : found.longest_gap == 30);
            assert_int_equal(found.contact, longer ? CEDUO_LIGHT_FAIL : CEDUO_LIGHT_PASS);
            assert_int_equal(found.free_run,
                             longer ? CEDUO_LIGHT_FAIL : CEDUO_LIGHT_PASS); /* every rock runs that far without stems */
            EXPECT(found.worst_free_run, <, .1);
        }
}

/* A belt that begins at the control has no effect. */
TEST(a_belt_after_the_control_has_no_effect)
{
    plant_trees(1000, 1000);
    site.belts[0].to = 130;
    site.belts[1].from = site.control.x;
    site.belts[1].to = site.control.x + 10;
    struct ceduo_index at = assess();
    EXPECT_IS(at, (longest_gap, 5), (length, 130), (contact, CEDUO_LIGHT_PASS));
    site.belts[1].stand.trees[0].per_ha = 1; /* too thin if a part lay before the control */
    EXPECT(assess().contact, ==, CEDUO_LIGHT_PASS);
    site.option.belts++;
    site.option.belts_count = 1;
    at = assess();
    EXPECT_IS(at, (longest_gap, site.control.x), (contact, CEDUO_LIGHT_FAIL), (worst_adc, INFINITY), (worst_free_run, 1));
}

/* exp(-x) of a double x is never exactly the double 0.1: take the two nearest probabilities, 2e-17 below and above. */
TEST(a_free_run_probability_of_a_tenth_is_the_maximum_that_passes)
{
    plant_trees(400, 1000);
    double threshold = 25 * log(10) * (1 - 1e-15), fails = 0, passes = 0; /* over an ADC of 25 m */
    for (enum ceduo_light light = CEDUO_LIGHT_FAIL; light != CEDUO_LIGHT_PASS; threshold = next_above(threshold)) {
        site.scene.simulation.threshold = threshold;
        struct ceduo_index at = assess();
        light = at.free_run;
        *(light == CEDUO_LIGHT_PASS ? &passes : &fails) = at.worst_free_run;
        EXPECT_NEAR(at.worst_free_run, .1, 5e-16);
    }
    EXPECT(fails, >, .1);
    EXPECT(passes, <, .1);
    EXPECT_NEAR(fails, .1, 3e-17);
    EXPECT_NEAR(passes, .1, 3e-17);
    EXPECT(site.scene.simulation.threshold, >, 25 * log(10) * (1 - 5e-16));
}

/* If the stems can take exactly the rock's energy, nothing is left, but nothing was cut off either. */
TEST(energy_that_is_just_used_up_is_not_exhausted)
{
    paper_site_init(&site);
    double taken = assess().dissipated;
    struct ceduo_index at = ceduo_assess_index(&site.scene, &site.option, &site.control, taken);
    EXPECT(at.residual, ==, 0);
    assert_false(at.exhausted);
    at = ceduo_assess_index(&site.scene, &site.option, &site.control, next_below(taken));
    EXPECT(at.residual, ==, 0);
    assert_true(at.exhausted);
    at = ceduo_assess_index(&site.scene, &site.option, &site.control, next_above(taken));
    EXPECT(at.residual, >, 0);
    assert_false(at.exhausted);
}

/* ---- rocks ---- */

static enum ceduo_light judge_share(double exceed, uint64_t unfinished)
{
    const struct ceduo_arrivals a = {
        .released = 20, .exceed.mean = exceed, .limit = CEDUO_EXCEED_MAX, .unfinished = unfinished};
    return ceduo_energy_light(&a);
}

TEST(a_share_of_a_twentieth_passes)
{
    assert_int_equal(judge_share(.05, 0), CEDUO_LIGHT_PASS);
    assert_int_equal(judge_share(next_above(.05), 0), CEDUO_LIGHT_FAIL);
    assert_int_equal(judge_share(0, 1), CEDUO_LIGHT_PASS); /* 1 in 20 in either case */
    assert_int_equal(judge_share(1e-16, 1), CEDUO_LIGHT_UNKNOWN);
    assert_int_equal(judge_share(.05, 1), CEDUO_LIGHT_UNKNOWN);
}

/* Rocks of 2 kg; at 5 m/s they have 25 J. */
static struct line_scene flat;

static void drop(double accepted)
{
    line_scene_drop(&flat, .25, accepted);
    flat.scene.rock.mass = ceduo_number(2);
    flat.scene.simulation.rocks = 20;
}

static struct ceduo_run *simulate(const struct ceduo_option *option)
{
    return run_option(&flat.scene, option, 20, 1);
}

static struct ceduo_arrivals read_share(double accepted)
{
    drop(accepted);
    struct ceduo_run *run = simulate(NULL);
    struct ceduo_arrivals a = read_arrivals(run, 0);
    EXPECT(a.reached, ==, 20);
    EXPECT_IS(a.energy, (mean, 25), (max, 25));
    ceduo_run_free(run);
    return a;
}

TEST(a_rock_with_the_accepted_energy_does_not_exceed_it)
{
    struct ceduo_arrivals a = read_share(25);
    EXPECT_IS(a, (exceeded, 0), (exceed.mean, 0));
    assert_int_equal(ceduo_energy_light(&a), CEDUO_LIGHT_PASS);
    a = read_share(next_below(25));
    EXPECT_IS(a, (exceeded, 20), (exceed.mean, 1));
    assert_int_equal(ceduo_energy_light(&a), CEDUO_LIGHT_FAIL);
}

/* Return the difference at the control made by trees between two places, for rocks with 25 J there. */
static struct ceduo_difference compare_trees(double from, double to, double accepted)
{
    struct ceduo_stems trees = {.per_ha = 2000, .dbh = .25, .height = 90, .volume = 1, .age = NAN};
    struct ceduo_belt belt = {.from = from, .to = to, .stand = {.species = -1, .trees_count = 1, .trees = &trees, .u = 1e5}};
    struct ceduo_option wood = {.belts_count = 1, .belts = &belt};
    drop(accepted);
    LOCAL(ceduo_run, through) = simulate(&wood);
    LOCAL(ceduo_run, bare) = simulate(NULL);
    return ceduo_run_difference(through, bare, 0);
}

/* The same in a difference: trees stop some rocks, and none exceeds, with or without the forest. */
TEST(a_difference_counts_no_rock_with_the_accepted_energy)
{
    struct ceduo_difference d = compare_trees(1, 4, 25);
    ROWS(EXPECT, (d.reach.mean, <, 0), (d.reach.se, >, 0), (d.exceed.mean, ==, 0));
    assert_true(isnan(d.exceed.se)); /* because no pair differs */
    assert_true(ceduo_pairs_are_equal(&d.exceed));
}

/* Stems after the control make no difference to it: this is exact, not estimated. */
TEST(a_difference_by_stems_from_the_control_on_is_none)
{
    struct ceduo_difference d = compare_trees(4, 8, 20);
    EXPECT(flat.control.x, ==, 4);
    const struct ceduo_estimate estimates[] = {d.reach, d.exceed, d.energy_per_released};
    for (size_t i = 0; i < 3; i++)
        EXPECT_IS(estimates[i], (mean, 0), (se, 0), (lo, 0), (hi, 0));
}

/* One in 20 rocks on the paper's site exceeds the energy of the second fastest: this passes, and two in 20 do not. */
TEST(one_rock_of_twenty_may_exceed)
{
    double energies[20];
    paper_site_init(&site);
    for (int law = 0; law < CEDUO_LAW_COUNT; law++)
        for (int more = 0; more < 2; more++) {
            site.scene.simulation.law = (enum ceduo_law)law;
            site.control.x = 40; /* all rocks reach it */
            site.control.accepted = 0;
            LOCAL(ceduo_run, all) = run_option(&site.scene, NULL, 20, 1);
            assert_int_equal(ceduo_run_energies(all, 0, energies, 20), 20);
            qsort(energies, 20, sizeof *energies, by_value);
            EXPECT(energies[17], <, energies[18]);
            EXPECT(energies[18], <, energies[19]);
            site.control.accepted = more ? next_below(energies[18]) : energies[18];
            LOCAL(ceduo_run, run) = run_option(&site.scene, NULL, 20, 1);
            struct ceduo_arrivals a = read_arrivals(run, 0);
            assert_int_equal(a.exceeded, more ? 2 : 1);
            assert_int_equal(ceduo_energy_light(&a), more ? CEDUO_LIGHT_FAIL : CEDUO_LIGHT_PASS);
        }
}

/* An index depends on the thin stems if either light differs without them. */
TEST(an_index_can_depend_on_thin_stems)
{
    const enum ceduo_light lights[] = {CEDUO_LIGHT_PASS, CEDUO_LIGHT_FAIL};
    for (int i = 0; i < 16; i++) {
        struct ceduo_index index = {.contact = lights[i & 1], .free_run = lights[i >> 1 & 1]};
        index.thick.contact = lights[i >> 2 & 1];
        index.thick.free_run = lights[i >> 3];
        EXPECT(ceduo_index_depends_on_thin_stems(&index), ==, (i & 3) != i >> 2);
    }
}

/* ---- too few arrivals ---- */

static bool has_too_few(uint64_t released, uint64_t reached, uint64_t unfinished)
{
    const struct ceduo_arrivals a = {.released = released, .reached = reached, .unfinished = unfinished};
    return ceduo_too_few_arrivals(&a);
}

/* None, or fewer than one in a thousand of at least a thousand rocks. */
TEST(too_few_arrivals_give_no_answer)
{
    assert_false(has_too_few(0, 0, 0)); /* no rocks */
    assert_true(has_too_few(1, 0, 0));
    ROWS(assert_false, (has_too_few(1, 1, 0)), (has_too_few(999, 1, 0)), (has_too_few(1000, 1, 0)));
    assert_true(has_too_few(1001, 1, 0));
    assert_false(has_too_few(2000, 2, 0));
    assert_true(has_too_few(2001, 2, 0));
    assert_false(has_too_few(1001, 1, 1)); /* one may still read_share */
    assert_false(has_too_few(10, 0, 1));
}

/* The limit is a share of .05; the interval must lie on one side of it. */
TEST(a_share_is_judged_by_its_interval)
{
    const double limit = .05;
    ROWS(assert_int_equal, (ceduo_judge_share((struct ceduo_estimate){.04, NAN, .03, .05}, limit), CEDUO_JUDGEMENT_YES),
         (ceduo_judge_share((struct ceduo_estimate){.04, NAN, .03, next_above(.05)}, limit), CEDUO_JUDGEMENT_NOT_DECIDED),
         (ceduo_judge_share((struct ceduo_estimate){.06, NAN, next_above(.05), .07}, limit), CEDUO_JUDGEMENT_NO),
         (ceduo_judge_share((struct ceduo_estimate){.06, NAN, .05, .07}, limit), CEDUO_JUDGEMENT_NOT_DECIDED),
         (ceduo_judge_share((struct ceduo_estimate){NAN, NAN, NAN, NAN}, limit), CEDUO_JUDGEMENT_UNANSWERED));
}

TEST(a_safe_bare_slope_needs_no_forest)
{
    const struct ceduo_arrivals few = {.released = 1000, .reached = 100, .exceed.mean = .01, .exceed.hi = .02, .limit = .05};
    const struct ceduo_arrivals many = {
        .released = 1000, .reached = 900, .exceed.mean = .8, .exceed.lo = .77, .exceed.hi = .83, .limit = .05};
    const struct ceduo_arrivals none = {.released = 1000, .exceed.hi = .004, .limit = .05};
    assert_int_equal(ceduo_judge_control(&few, NULL),
                     CEDUO_JUDGEMENT_YES); /* by the index: a forest never increases arrivals */
    ROWS(assert_int_equal, (ceduo_judge_control(&many, NULL), CEDUO_JUDGEMENT_UNANSWERED),
         (ceduo_judge_control(&many, &few), CEDUO_JUDGEMENT_YES), (ceduo_judge_control(&many, &many), CEDUO_JUDGEMENT_NO));
    assert_int_equal(ceduo_judge_control(&many, &none), CEDUO_JUDGEMENT_YES); /* the forest stops all of them */
    assert_int_equal(ceduo_judge_control(&none, &none), CEDUO_JUDGEMENT_CANNOT_JUDGE);
}
