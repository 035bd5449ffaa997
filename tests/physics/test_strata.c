/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What else rocks meet in a stand: stems that take a share (inertia). */
#include "expect.h"

#include <math.h>

#include "stems_scene.h"

/* ---- inertia ---- */

#define GREEN 1000.0 /* kg/m3 */
#define MASS  512.3058

/* The share at the offset u as Dorren et al. 2006 print it, cut to 0…1, and its mean over u by Simpson's rule. */
static double printed_share(double u)
{
    double e = -.046 + (.98 + .046) / (1 + pow(10, (.58 - u) * -8.007));
    return fmin(1, fmax(0, e));
}

static double mean_printed_share(void)
{
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; i++)
        sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * printed_share((double)i / n);
    return sum / (3 * n);
}

/* By hand: of ½ M v² the share m/(M + m), m = 33/140 ρ V, over V U, U = 102 800 J/m3 of the paper, is
 * ½ 33/140 1000 v²/102 800 M/(M + m): of the ADS 1 stems of 10.7 l (m = 2.52 kg) .114 at 10 m/s, .503 at 21, .959 at 29. */
static void inertia_beside_brauner(void **state)
{
    (void)state;
    static const struct {
        double speed, ratio;
    } rows[] = {{10, .114}, {21, .503}, {29, .959}};
    struct paper_plot plot;
    paper_plot_init(&plot, 1);
    plot.stand.offset = CEDUO_OFFSET_BY_ECCENTRICITY; /* both by e(u) */
    double amount = ceduo_contact_energy(&plot.stand, &plot.shoots);
    EXPECT(ceduo_contact_share(&plot.stand, &plot.shoots, MASS), ==, 0);
    assert_false(ceduo_stand_takes_share(&plot.stand));
    plot.stand.energy = CEDUO_INERTIA;
    plot.stand.green_density = GREEN;
    assert_true(ceduo_stand_takes_share(&plot.stand));
    assert_true(isnan(ceduo_contact_energy(&plot.stand, &plot.shoots)));
    double share = ceduo_contact_share(&plot.stand, &plot.shoots, MASS), m = 33. / 140 * GREEN * .0107;
    EXPECT_NEAR(share, mean_printed_share() * m / (MASS + m), 1e-9);
    for (size_t i = 0; i < LENGTH(rows); i++) {
        double energy = .5 * MASS * rows[i].speed * rows[i].speed;
        EXPECT_NEAR(share * energy / amount, rows[i].ratio, 5e-4);
    }
    assert_false(ceduo_stand_glances(&plot.stand)); /* not unless the stand says so */
    EXPECT(ceduo_stand_warnings(&plot.stand, B, CEDUO_RULE_AUTO) & CEDUO_WARN_INERTIA, !=, 0);
}

static struct ceduo_belt *plant_inert(double from, double to)
{
    struct ceduo_belt *belt = plant_belt(from, to, 800, .4);
    plant_trees(belt, 1500, .3)->volume = .02;
    plant_shoots(belt, 3200, .12)->volume = .005;
    belt->stand.energy = CEDUO_INERTIA;
    belt->stand.green_density = GREEN;
    belt->stand.glancing = -1;
    return belt;
}

/* e(u) E m/(M + m), however fast the rock is; with `glancing` no more than 1 - u2 of E. */
static void hits_take_their_share(void **state)
{
    (void)state;
    struct ceduo_rock rock;
    uint64_t hits = 0, cut = 0;
    for (int glancing = 0; glancing < 2; glancing++) {
        clear_plane(520);
        ceduo_rock_of_means(&plane.line.scene.rock, &rock);
        struct ceduo_belt *belt = plant_inert(10, 510);
        if (glancing) { /* stems so heavy that they could stop it */
            belt->stand.glancing = 1;
            belt->stand.trees[0].volume = belt->stand.shoots[0].volume = 1e3;
            belt->to = 14;
        }
        sweep_begin();
        for (uint64_t number = 0; number < 500; number++) {
            sweep_rock(number);
            EXPECT(sweep.way.end, !=, CEDUO_STOPPED_BY_STEMS);
            for (size_t i = 0; i < sweep.count; i++) {
                const struct ceduo_stem_passed *s = &sweep.stems[i];
                double volume = glancing ? 1e3 : s->shoot ? .005 : .02, m = 33. / 140 * GREEN * volume;
                double u = fabs(s->y) / ((B + s->dbh) / 2), share = printed_share(u) * m / (rock.mass + m);
                cut += glancing && share > 1 - u * u;
                double wanted = glancing ? fmin(share, 1 - u * u) : share;
                if (s->hit && !(fabs(s->taken / s->before - wanted) <= 1e-10))
                    fail_msg("u = %.17g takes %.17g of %.17g", u, s->taken, s->before);
                hits += s->hit;
            }
        }
        sweep_end();
    }
    EXPECT(hits, >, 10000);
    EXPECT(cut, >, 100);
}

/* A contact of poisson takes the mean share of its stratum: of stools that of their shoots. */
static void contacts_take_the_mean_share(void **state)
{
    (void)state;
    struct ceduo_rock rock;
    clear_plane(520);
    ceduo_rock_of_means(&plane.line.scene.rock, &rock);
    struct ceduo_belt *belt = plant_inert(10, 510);
    plant_shoots(belt, 800, .2)->volume = .1;
    plane.line.scene.simulation.contact_model = CEDUO_POISSON;
    plane.line.scene.simulation.rule = CEDUO_CROFTON;
    double tree = 33. / 140 * GREEN * .02, thin = 33. / 140 * GREEN * .005, thick = 33. / 140 * GREEN * .1;
    double mean = mean_printed_share(), of_tree = mean * tree / (rock.mass + tree);
    double of_stool = mean * (.8 * thin / (rock.mass + thin) + .2 * thick / (rock.mass + thick));
    uint64_t found[2] = {0};
    sweep_begin();
    for (uint64_t number = 0; number < 300; number++) {
        sweep_rock(number);
        for (size_t i = 0; i < sweep.count; i++) {
            double share = sweep.stems[i].taken / sweep.stems[i].before;
            bool is_tree = fabs(share - of_tree) < 1e-9;
            if (sweep.stems[i].hit && !is_tree && fabs(share - of_stool) >= 1e-9)
                fail_msg("a contact takes %.17g, no %g or %g", share, of_tree, of_stool);
            found[is_tree]++;
        }
    }
    sweep_end();
    EXPECT(found[0], >, 1000);
    EXPECT(found[1], >, 1000);
}

/* The index: a product over the mean number of contacts, (1 - share)^n for each stratum, and no Eq. 4; before or behind
 * a belt of brauner, which takes an amount. */
static void the_index_multiplies_shares(void **state)
{
    (void)state;
    struct paper_site site;
    paper_site_init(&site);
    const double before = 112.319e3, amount = 67.5 / 2.6053723298516003 * 606.52; /* of ADS 2 */
    const double mean = mean_printed_share(), m = 33. / 140 * GREEN * .0107, share = mean * m / (MASS + m);
    const double left = pow(1 - share, 67.5 / 1.9483462242414016); /* ADS 1: all stems are alike */
    site.belts[0].stand.energy = CEDUO_INERTIA;
    site.belts[0].stand.green_density = GREEN;
    struct ceduo_index i = ceduo_assess_index(&site.scene, &site.option, &site.control, before);
    assert_true(isnan(i.dissipated));
    assert_false(i.exhausted);
    EXPECT_NEAR(i.residual, before * left - amount, 1e-3);
    struct ceduo_stand_result r = ceduo_assess_stand(&site.scene, &site.belts[0]);
    assert_true(isnan(r.dissipated));
    assert_true(isnan(r.energy_per_contact));
    EXPECT_NEAR(r.contacts, 67.5 / 1.9483462242414016, 1e-9);
    struct ceduo_belt first = site.belts[0];
    site.belts[0].stand = site.belts[1].stand;
    site.belts[1].stand = first.stand;
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, before);
    EXPECT_NEAR(i.residual, (before - amount) * left, 1e-3);
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, 1e3);
    assert_true(i.exhausted);
    EXPECT(i.residual, ==, 0);
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, NAN);
    assert_true(isnan(i.residual));
    site.belts[1].stand.trees_count = site.belts[1].stand.shoots_count = 0; /* nothing there takes anything */
    i = ceduo_assess_index(&site.scene, &site.option, &site.control, before);
    EXPECT_NEAR(i.residual, before - amount, 1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inertia_beside_brauner),
        cmocka_unit_test(hits_take_their_share),
        cmocka_unit_test(contacts_take_the_mean_share),
        cmocka_unit_test(the_index_multiplies_shares),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
