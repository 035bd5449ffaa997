/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sobol' indices of functions whose indices are known in closed form, doubt of a known law, and inputs at the ends of their ranges. */
#include "expect.h"

#include <stdlib.h>

#include "ceduo/doubt.h"
#include "io/scene_file.h"
#include "study/inputs.h"

#define POINTS 1024

typedef double function(const double *u, size_t n);

/* Ishigami and Homma 1990 with a = 7, b = 0.1, over -pi…pi. */
static double ishigami(const double *u, size_t n)
{
    (void)n;
    double x[3];
    for (int i = 0; i < 3; i++)
        x[i] = (2 * u[i] - 1) * M_PI;
    return sin(x[0]) + 7 * sin(x[1]) * sin(x[1]) + 0.1 * pow(x[2], 4) * sin(x[0]);
}

static const double g_weights[] = {0, 1, 4.5, 9, 99, 99, 99, 99};

/* Sobol's g function (Saltelli and Sobol' 1995). */
static double sobol_g(const double *u, size_t n)
{
    double product = 1;
    for (size_t i = 0; i < n; i++)
        product *= (fabs(4 * u[i] - 2) + g_weights[i]) / (1 + g_weights[i]);
    return product;
}

static double linear(const double *u, size_t n)
{
    double sum = 5;
    for (size_t i = 0; i < n; i++)
        sum += (double)(i + 1) * u[i];
    return sum;
}

/* A small generator of the test's own, for noise: splitmix64. */
static double normal(uint64_t *state)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        uint64_t z = *state += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        sum += (double)((z ^ z >> 31) >> 11) * 0x1p-53;
    }
    return sum;
}

static struct ceduo_indices indices_of(function *f, struct ceduo_design d, double noise)
{
    size_t evaluations = ceduo_design_evaluations(&d);
    double *u = malloc(evaluations * d.inputs * sizeof *u);
    struct ceduo_halves *y = malloc(evaluations * sizeof *y);
    struct ceduo_indices indices;
    uint64_t state = d.seed;
    assert_non_null(u);
    assert_non_null(y);
    EXPECT(ceduo_design_fill(&d, u), ==, CEDUO_OK);
    for (size_t e = 0; e < evaluations; e++)
        for (int h = 0; h < 2; h++)
            y[e].half[h] = f(u + e * d.inputs, d.inputs) + (noise > 0 ? noise * normal(&state) : 0);
    EXPECT(ceduo_design_read(&d, y, &indices), ==, CEDUO_OK);
    free(u);
    free(y);
    return indices;
}

static void expect_shares(const struct ceduo_share *found, const double *known, size_t n)
{
    for (size_t i = 0; i < n; i++)
        EXPECT_NEAR(found[i].value, known[i], 3 * found[i].se);
}

/* ---- closed forms ---- */

TEST(ishigami_has_its_indices)
{
    const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
    struct ceduo_indices found = indices_of(ishigami, (struct ceduo_design){3, POINTS, 1, 3, NULL}, 0);
    expect_shares(found.first, first, 3);
    expect_shares(found.total, total, 3);
    double variance = 49.0 / 8 + 0.1 * pow(M_PI, 4) / 5 + 0.01 * pow(M_PI, 8) / 18 + 0.5; /* a²/8 + bπ⁴/5 + b²π⁸/18 + 1/2 */
    EXPECT_NEAR(found.mean, 3.5, 3 * sqrt(variance / (2 * POINTS)));                      /* a/2 */
    EXPECT_NEAR(found.variance, variance, 3 * variance * sqrt(2.5 / (2 * POINTS)));       /* kurtosis 3.5 */
}

TEST(g_function_has_its_indices)
{
    const double first[] = {0.7165, 0.1791, 0.0237, 0.0072, 0.0001, 0.0001, 0.0001, 0.0001};
    struct ceduo_indices found = indices_of(sobol_g, (struct ceduo_design){8, POINTS, 2, 8, NULL}, 0);
    for (size_t i = 0; i < 8; i++)
        EXPECT_NEAR(found.first[i].value, first[i], 3 * found.first[i].se + 5e-5); /* the figures have four decimals */
}

TEST(linear_function_has_shares_of_variance)
{
    struct ceduo_indices found = indices_of(linear, (struct ceduo_design){4, POINTS, 3, 4, NULL}, 0);
    const double known[] = {1 / 30.0, 4 / 30.0, 9 / 30.0, 16 / 30.0};
    expect_shares(found.first, known, 4);
    expect_shares(found.total, known, 4);
    EXPECT_NEAR(found.variance, 30 / 12.0, 3 * 30 / 12.0 * sqrt(2.0 / (2 * POINTS)));
}

/* x1 and x3 act together; as one input they have what x2 leaves. */
TEST(inputs_of_a_group_move_together)
{
    const size_t group[] = {0, 1, 0};
    const double known[] = {0.5576, 0.4424};
    struct ceduo_indices found = indices_of(ishigami, (struct ceduo_design){3, POINTS, 4, 2, group}, 0);
    expect_shares(found.first, known, 2);
    expect_shares(found.total, known, 2);
}

/* ---- errors ---- */

/* Of 200 seeds, 95 % intervals hold the truth in 90 to 98 %. */
TEST(errors_cover)
{
    const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
    double inside[2] = {0};
    for (uint64_t seed = 0; seed < 200; seed++) {
        struct ceduo_indices f = indices_of(ishigami, (struct ceduo_design){3, POINTS, seed, 3, NULL}, 0);
        for (int i = 0; i < 3; i++) {
            inside[0] += (fabs(f.first[i].value - first[i]) <= 1.96 * f.first[i].se) / 600.0;
            inside[1] += (fabs(f.total[i].value - total[i]) <= 1.96 * f.total[i].se) / 600.0;
        }
    }
    for (int k = 0; k < 2; k++) {
        EXPECT(inside[k], >=, 0.90);
        EXPECT(inside[k], <=, 0.98);
    }
}

static double constant(const double *u, size_t n)
{
    (void)u, (void)n;
    return 7;
}

/* The halves are of the same rocks at every point: a constant between them is neither noise nor variance. */
TEST(halves_may_differ_by_a_constant)
{
    const double slopes[] = {2, 1}, known[] = {.8, .2};
    for (uint64_t seed = 1; seed <= 10; seed++) {
        struct ceduo_design d = {.inputs = 2, .points = 256, .seed = seed, .groups = 2};
        double u[256 * 4 * 2];
        struct ceduo_halves y[256 * 4];
        struct ceduo_indices found;
        EXPECT(ceduo_design_fill(&d, u), ==, CEDUO_OK);
        for (size_t e = 0; e < 256 * 4; e++)
            for (int h = 0; h < 2; h++)
                y[e].half[h] = 100 + slopes[0] * u[2 * e] + slopes[1] * u[2 * e + 1] + (h ? .9 : -.9);
        EXPECT(ceduo_design_read(&d, y, &found), ==, CEDUO_OK);
        EXPECT_NEAR(found.variance, 5. / 12, .03);
        EXPECT_NEAR(found.noise, 0, 1e-12);
        expect_shares(found.total, known, 2);
        expect_shares(found.first, known, 2);
    }
}

/* Noise of the rocks is not taken for an effect: not of a figure that depends on nothing, nor beside real effects. */
TEST(noise_is_taken_off)
{
    const double total[] = {0.5576, 0.4424, 0.2437};
    double near = 0;
    for (uint64_t seed = 0; seed < 50; seed++) {
        struct ceduo_indices nothing = indices_of(constant, (struct ceduo_design){3, 256, seed, 3, NULL}, 2);
        for (int i = 0; i < 3; i++)
            near += (fabs(nothing.total[i].value) <= 2 * nothing.total[i].se) / 150.0;
    }
    EXPECT(near, >=, 0.88); /* 95 %, less 3 standard errors */
    struct ceduo_indices found = indices_of(ishigami, (struct ceduo_design){3, POINTS, 5, 3, NULL}, 2);
    expect_shares(found.total, total, 3);
    EXPECT_NEAR(found.noise, 2, 0.2); /* of the mean of two halves of variance 4 */
}

/* The doubt of a density with a large error: within 1 % of its mean, where a uniform law cut at 0 was 17 and 37 % above. */
TEST(gamma_laws_keep_the_mean)
{
    for (double ratio = .34; ratio <= 1; ratio += .06) {
        const struct ceduo_input input = {.kind = CEDUO_INPUT_GAMMA, .mean = 50, .sd = 50 * ratio};
        double sum = 0, squares = 0;
        for (int i = 0; i < 2000; i++) {
            double x = ceduo_input_quantile(&input, (i + .5) / 2000);
            EXPECT(x, >, 0);
            sum += x / 2000;
            squares += x * x / 2000;
        }
        EXPECT_NEAR(sum, 50, .5);
        EXPECT_NEAR(sqrt(squares - sum * sum), 50 * ratio, .05 * 50 * ratio); /* what is cut off */
    }
}

/* A figure without noise that depends on nothing has no indices. */
TEST(nothing_varies)
{
    struct ceduo_indices found = indices_of(constant, (struct ceduo_design){3, 64, 1, 3, NULL}, 0);
    assert_true(isnan(found.first[0].value) && isnan(found.total[2].se));
    EXPECT(found.mean, ==, 7);
    EXPECT(found.variance, ==, 0);
}

/* ---- what may be true ---- */

/* Two classes of trees, of 0.2 m, before a rock of 0.8 m: a belt's contacts per metre, one over its ADC, are the trees of a square
 * metre. */
static const char wood[] =
    "ceduo: scene/1\nrelease: {vx_m_s: 1}\nrock: {diameter_m: 0.8}\ncontrols: [{x_m: 19, accepted_kJ: 50}]\n"
    "slope: {vertices_m: [[0, 20], [20, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
    "simulation: {contact_model: index, rule: gsteiger-stems, contact_dbh_m: 0.1}\n"
    "forest: [{from_m: 1, to_m: 18, stand: {stools: {per_ha: 600, spacing_m: 0.4}, shoots: [{per_ha: 2000, dbh_m: 0.02, "
    "height_m: 3}],\n"
    "  trees: [{per_ha: 1000, dbh_m: 0.2, height_m: 12}, {per_ha: 1000, dbh_m: 0.2, height_m: 12}]}}]\n";

static struct scene_file file;

static void open_wood(void)
{
    struct problems problems = {0};
    bool good = ceduo_scene_read_text(&file, "wood", wood, &problems);
    ceduo_scene_bind(&file, &problems);
    if (!good || problems.count > 0)
        fail_msg("%s", ceduo_text_string(&problems.text));
}

/* Uniform between lo and hi, at one place. */
static struct ceduo_input range_of(const char *const *place, double lo, double hi)
{
    return (struct ceduo_input){
        .path = *place, .kind = CEDUO_INPUT_RANGE, .lo = lo, .hi = hi, .places_count = 1, .places = place};
}

/* Contacts per metre of 1000 to 2000 trees per ha of either class: 0.1·(2 + U + V), a triangular law with p5 at sqrt(0.1), p50 at 1
 * and p95 at 2 - sqrt(0.1) of U + V. Were one known the other's 0.9 were left; in eight classes of it 1.125 - 2·sqrt(0.1/8). What
 * does not act leaves all. */
TEST(doubt_of_a_known_law)
{
    static const char *const places[] = {"forest[0].stand.trees[0].per_ha", "forest[0].stand.trees[1].per_ha",
                                         "rock.density_kg_m3"};
    const struct ceduo_input inputs[] = {range_of(&places[2], 2400, 2700), range_of(&places[0], 1000, 2000),
                                         range_of(&places[1], 1000, 2000)};
    struct ceduo_doubt_answer a;
    size_t order[CEDUO_SENSITIVITY_GROUPS];
    open_wood();
    const struct ceduo_doubt_def def = {
        .scene = &file.scene, .inputs_count = 3, .inputs = inputs, .points = 2048, .rocks = 2, .threads = 2};
    EXPECT(ceduo_doubt_ask(&def, &a), ==, CEDUO_OK);
    const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(&a, 0, CEDUO_DOUBT_CONTACT, false);
    double root = sqrt(.1);
    EXPECT_NEAR(f->p5, .2 + .1 * root, .002);
    EXPECT_NEAR(f->p50, .3, .002);
    EXPECT_NEAR(f->p95, .4 - .1 * root, .002);
    EXPECT_NEAR(f->left[0], .1 * (2 - 2 * root), .002);
    EXPECT_NEAR(f->left[1], .1 * (1.125 - 2 * root * sqrt(.125)), .002);
    EXPECT_NEAR(f->left[2], .1 * (1.125 - 2 * root * sqrt(.125)), .002);
    EXPECT_NEAR(f->at[1][0], .2, 1e-12);
    EXPECT_NEAR(f->at[1][1], .3, 1e-12);
    ceduo_doubt_order_of(&a, f, order);
    EXPECT(order[2], ==, 0);
    ceduo_doubt_free(&a);
    ceduo_scene_release(&file);
}

/* A light changes where its limit lies from p5 on and below p95; a second input is named from half of the first one's share on. */
TEST(what_a_light_depends_on)
{
    static const struct {
        double p5, p95, second;
        size_t named;
    } cases[] = {{.01, .2, .3, 2}, {.01, .2, .299, 1}, {.05, .2, .6, 2}, {.01, .05, .6, 0}, {.051, .2, .6, 0}};
    struct ceduo_doubt_figure figures[CEDUO_DOUBT_KINDS] = {0}, *f = &figures[CEDUO_DOUBT_EXCEED];
    const struct ceduo_doubt_answer a = {.groups = 3, .figures_count = CEDUO_DOUBT_KINDS, .figures = figures};
    size_t groups[2];
    open_wood();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        f->p5 = cases[i].p5, f->p95 = cases[i].p95;
        f->indices.total[0].value = .1, f->indices.total[1].value = cases[i].second, f->indices.total[2].value = .6;
        EXPECT(ceduo_doubt_depends(&file.scene, &a, 0, CEDUO_DOUBT_EXCEED, groups), ==, cases[i].named);
        if (cases[i].named > 0 && cases[i].second < .6)
            EXPECT(groups[0], ==, 2);
        if (cases[i].named > 1 && cases[i].second < .6)
            EXPECT(groups[1], ==, 1);
    }
    ceduo_scene_release(&file);
}

/* Each of two words, and each of two rows, has half of the range; its ends are of it. */
TEST(words_and_rows_share_the_range)
{
    static const char *const places[] = {"simulation.rule", "rock.density_kg_m3"};
    const int words[] = {CEDUO_INTERCEPTION, CEDUO_CROFTON};
    const double rows[] = {2500, 2700}, *const draws[] = {rows};
    const struct ceduo_input inputs[] = {{.path = places[0],
                                          .kind = CEDUO_INPUT_WORDS,
                                          .words_count = 2,
                                          .words = words,
                                          .places_count = 1,
                                          .places = &places[0]},
                                         {.path = places[1],
                                          .kind = CEDUO_INPUT_DRAWS,
                                          .draws_count = 2,
                                          .draws = draws,
                                          .places_count = 1,
                                          .places = &places[1]}};
    const double u[] = {0, .4999, .5, 1};
    struct input_scene copy;
    open_wood();
    EXPECT(ceduo_inputs_open(&copy, &file.scene, inputs, 2), ==, CEDUO_OK);
    for (int i = 0; i < 4; i++) {
        ceduo_inputs_set(&copy, (double[]){u[i], u[i]});
        EXPECT((int)copy.scene.simulation.rule, ==, words[i / 2]);
        EXPECT_NEAR(copy.scene.rock.density.mean, rows[i / 2], 1e-9);
    }
    ceduo_inputs_release(&copy);
    ceduo_scene_release(&file);
}

/* A normal input is cut at three standard deviations, its mean is in the middle, and a quarter of what the cut leaves lies below the
 * quartile: Φ(z) = Φ(-3) + (1 - 2Φ(-3))/4 at z = -0.6719. */
TEST(a_normal_input_at_its_ends)
{
    const struct ceduo_input input = {.kind = CEDUO_INPUT_NORMAL, .mean = 50, .sd = 4};
    EXPECT_NEAR(ceduo_input_quantile(&input, 0), 38, 1e-9);
    EXPECT_NEAR(ceduo_input_quantile(&input, .5), 50, 1e-9);
    EXPECT_NEAR(ceduo_input_quantile(&input, 1), 62, 1e-9);
    double z = (ceduo_input_quantile(&input, .25) - 50) / 4, least = erfc(3 / sqrt(2)) / 2;
    EXPECT_NEAR(erfc(-z / sqrt(2)) / 2, least + (1 - 2 * least) / 4, 1e-12);
}

/* Stools in doubt above their shoots are as many as these; the next look begins with those of the scene. */
TEST(stools_are_not_more_than_their_shoots)
{
    static const char *const places[] = {"forest[0].stand.stools.per_ha", "forest[0].stand.shoots[0].per_ha"};
    const struct ceduo_input inputs[] = {range_of(&places[0], 600, 3000), range_of(&places[1], 500, 2500)};
    static const double cases[][4] = {
        {1, NAN, 2000, 2000}, {0, NAN, 600, 2000}, {1, 0, 500, 500}, {NAN, 0, 500, 500}, {NAN, NAN, 600, 2000}};
    struct input_scene copy;
    open_wood();
    EXPECT(ceduo_inputs_open(&copy, &file.scene, inputs, 2), ==, CEDUO_OK);
    const struct ceduo_stand *stand = &copy.scene.options[0].belts[0].stand;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ceduo_inputs_set(&copy, cases[i]);
        EXPECT_NEAR(stand->stools_per_ha, cases[i][2], 1e-9);
        EXPECT_NEAR(stand->shoots[0].per_ha, cases[i][3], 1e-9);
    }
    ceduo_inputs_release(&copy);
    EXPECT(ceduo_inputs_open(&copy, &file.scene, &inputs[1], 1), ==, CEDUO_OK); /* the shoots alone: 500, then 2500 */
    stand = &copy.scene.options[0].belts[0].stand;
    for (int i = 0; i < 2; i++) {
        ceduo_inputs_set(&copy, (double[]){i});
        EXPECT_NEAR(stand->stools_per_ha, i == 0 ? 500 : 600, 1e-9);
    }
    ceduo_inputs_release(&copy);
    ceduo_scene_release(&file);
}
