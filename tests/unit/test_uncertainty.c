/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Uncertainty with a known law, inputs that decide a light, and inputs at the ends of their ranges. */
#include "expect.h"
#include "study/dominant_inputs.h"
#include "study/surface.h"

#include <stdlib.h>

#include "io/scene_file.h"
#include "study/effort.h"
#include "study/inputs.h"
#include "study/points.h"
#include "study/reliability.h"

/* Uncertainty of a density with a large error: within 1 % of its mean; a uniform law truncated at 0 was 17 and 37 % above. */
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
        EXPECT_NEAR(sqrt(squares - sum * sum), 50 * ratio, .05 * 50 * ratio); /* truncated part */
    }
}

/* ---- plausible cases ---- */

/* Two classes of trees, of 0.2 m, and a rock of 0.8 m: the contacts per metre of a belt, 1/ADC, equal its trees per square
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
    bool good = ceduo_scene_load_text(&file, "wood", wood, &problems);
    ceduo_scene_bind(&file, &problems);
    if (!good || problems.met > 0)
        fail_msg("%s", ceduo_problems_print(&problems));
}

/* Return an input uniform between lo and hi, at one place. */
static struct ceduo_input make_range(const char *const *place, double lo, double hi)
{
    return (struct ceduo_input){
        .path = *place, .kind = CEDUO_INPUT_RANGE, .lo = lo, .hi = hi, .places_count = 1, .places = place};
}

/* Contacts per metre of 1000 to 2000 trees per ha in each class: 0.1·(2 + U + V), a triangular law with p5 at sqrt(0.1), p50 at
 * 1 and p95 at 2 - sqrt(0.1) of U + V. If one were known the other's 0.9 would remain; an input without effect leaves all. */
TEST(uncertainty_of_a_known_law)
{
    static const char *const places[] = {"forest[0].stand.trees[0].per_ha", "forest[0].stand.trees[1].per_ha",
                                         "rock.density_kg_m3"};
    const struct ceduo_input inputs[] = {make_range(&places[2], 2400, 2700), make_range(&places[0], 1000, 2000),
                                         make_range(&places[1], 1000, 2000)};
    struct ceduo_uncertainty_result a;
    open_wood();
    const struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                              .scene = &file.scene,
                                              .inputs_count = 3,
                                              .inputs = inputs,
                                              .points = 1024,
                                              .rocks = 2,
                                              .threads = 2};
    EXPECT(ceduo_uncertainty_compute(&def, &a), ==, CEDUO_OK);
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(&a, 0, CEDUO_UNCERTAINTY_CONTACT, false);
    double root = sqrt(.1);
    EXPECT_NEAR(f->fit.p5, .2 + .1 * root, .002);
    EXPECT_NEAR(f->fit.p50, .3, .002);
    EXPECT_NEAR(f->fit.p95, .4 - .1 * root, .002);
    EXPECT_NEAR(f->fit.width_if_known[0], .1 * (2 - 2 * root), .002);
    EXPECT_NEAR(f->fit.width_if_known[1], .09, .001);
    EXPECT_NEAR(f->fit.width_if_known[2], .09, .001);
    EXPECT_NEAR(f->fit.total[1].value, .5, 1e-6);
    EXPECT_NEAR(f->at_ends[1][0], .2, 1e-12);
    EXPECT_NEAR(f->at_ends[1][1], .3, 1e-12);
    EXPECT(f->order[2], ==, 0);
    size_t decisive[2];
    assert_null(ceduo_uncertainty_find_figure(&a, 1, CEDUO_UNCERTAINTY_CONTACT, false)); /* there is one option */
    assert_null(ceduo_uncertainty_find_figure(&a, 0, CEDUO_UNCERTAINTY_KINDS, false));
    assert_null(ceduo_uncertainty_find_figure(&a, 0, CEDUO_UNCERTAINTY_CONTACT, true));
    EXPECT(ceduo_uncertainty_dominant_inputs(&file.scene, &a, 1, CEDUO_UNCERTAINTY_CONTACT, decisive), ==, 0);
    ceduo_uncertainty_release(&a);
    ceduo_scene_release(&file);
}

/* The second of two options alone: contacts per metre are uniform between .2 and .3. */
TEST(one_option_is_evaluated)
{
    static const char *const place = "options[1].forest[0].stand.trees[0].per_ha";
    const struct ceduo_input input = make_range(&place, 1000, 2000);
    struct ceduo_uncertainty_result a;
    open_wood();
    struct ceduo_option options[2] = {file.scene.options[0], file.scene.options[0]}, *was = file.scene.options;
    file.scene.options = options;
    file.scene.options_count = 2;
    const struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                              .scene = &file.scene,
                                              .inputs_count = 1,
                                              .inputs = &input,
                                              .points = CEDUO_UNCERTAINTY_POINTS,
                                              .rocks = CEDUO_SURFACE_GROUPS,
                                              .one_option = true,
                                              .option = 1,
                                              .threads = 1};
    EXPECT(ceduo_uncertainty_compute(&def, &a), ==, CEDUO_OK);
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(&a, 1, CEDUO_UNCERTAINTY_CONTACT, false);
    EXPECT_NEAR(f->fit.p5, .205, .001);
    EXPECT_NEAR(f->fit.p95, .295, .001);
    EXPECT_NAN(ceduo_uncertainty_find_figure(&a, 0, CEDUO_UNCERTAINTY_CONTACT, false)->fit.p5);
    EXPECT(a.orders_count, ==, 0);
    ceduo_uncertainty_release(&a);
    file.scene.options = was;
    file.scene.options_count = 1;
    ceduo_scene_release(&file);
}

/* For sixty inputs 256 points are fewer than the terms: their number is doubled, and energy follows density. */
TEST(more_points_where_inputs_are_many)
{
    enum { MANY = 60 };
    static const char *const places[] = {"rock.density_kg_m3", "forest[0].stand.trees[0].height_m"};
    struct ceduo_input inputs[MANY];
    struct ceduo_uncertainty_result a;
    for (size_t i = 0; i < MANY; i++)
        inputs[i] = i == 0 ? make_range(&places[0], 2400, 2700) : make_range(&places[1], 11, 13);
    open_wood();
    file.scene.controls[0].accepted = NAN;
    const struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                              .scene = &file.scene,
                                              .inputs_count = MANY,
                                              .inputs = inputs,
                                              .points = CEDUO_UNCERTAINTY_POINTS,
                                              .rocks = CEDUO_SURFACE_GROUPS,
                                              .threads = 2};
    EXPECT(ceduo_uncertainty_compute(&def, &a), ==, CEDUO_OK);
    EXPECT(a.points, ==, 2 * CEDUO_UNCERTAINTY_POINTS);
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(&a, 0, CEDUO_UNCERTAINTY_ENERGY, false);
    assert_true(f->fit.enough_points);
    EXPECT_NEAR(f->fit.total[0].value, 1, 1e-6);
    EXPECT_NEAR(f->fit.p5 / f->fit.p95, 2415. / 2685, .002);
    ceduo_uncertainty_release(&a);
    ceduo_scene_release(&file);
}

/* Points are aborted at the same work limit with any number of threads. */
TEST(too_much_work_is_aborted)
{
    static const char *const place = "slope.segments[0].rn";
    const struct ceduo_input input = make_range(&place, .2, .6);
    struct ceduo_uncertainty_result a;
    open_wood();
    struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                        .scene = &file.scene,
                                        .inputs_count = 1,
                                        .inputs = &input,
                                        .points = 64,
                                        .points_max = 64,
                                        .rocks = 8,
                                        .threads = 1};
    uint64_t few = 1, enough = 1 << 20; /* contacts */
    while (enough - few > 1) {
        def.effort_max = (few + enough) / 2;
        *(ceduo_uncertainty_compute(&def, &a) == CEDUO_OK ? &enough : &few) = def.effort_max;
        ceduo_uncertainty_release(&a);
    }
    EXPECT(enough, >, 64 * 8); /* each rock touches the ground at least once */
    EXPECT(enough, <, 1 << 20);
    def.threads = 2;
    for (int i = 0; i < 20; i++) {
        def.effort_max = enough - (uint64_t)i % 2;
        EXPECT(ceduo_uncertainty_compute(&def, &a), ==, (i % 2 == 0 ? CEDUO_OK : CEDUO_CANCELLED));
        ceduo_uncertainty_release(&a);
    }
    ceduo_scene_release(&file);
}

#define LONG 120 /* years: two per year of a point */

static struct ceduo_uncertainty_def set_long_years(const struct ceduo_input *input)
{
    return (struct ceduo_uncertainty_def){.size = sizeof(struct ceduo_uncertainty_def),
                                          .scene = &file.scene,
                                          .inputs_count = 1,
                                          .inputs = input,
                                          .points = 2,
                                          .points_max = 2,
                                          .rocks = CEDUO_SURFACE_GROUPS,
                                          .rotation = true,
                                          .window = {CEDUO_WINDOW_GIVEN, 1, LONG, 1},
                                          .threads = 1};
}

/* All rocks arrive in every year, all above the accepted energy: 120 years fail, although a point has 60. */
TEST(a_year_of_a_point_represents_several)
{
    static const char *const place = "rocks_per_year";
    const struct ceduo_input input = make_range(&place, 1, 2);
    struct ceduo_uncertainty_result a;
    open_wood();
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    file.scene.options[0].belts_count = 0;
    file.scene.controls[0].accepted = 1;
    const struct ceduo_uncertainty_def def = set_long_years(&input);
    EXPECT(ceduo_uncertainty_compute(&def, &a), ==, CEDUO_OK);
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_find_figure(&a, 0, CEDUO_UNCERTAINTY_FAILING, false);
    EXPECT(f->value, ==, LONG);
    for (int p = 0; p < 2; p++)
        EXPECT_NEAR(f->fit.values[p], LONG, 1e-9);
    ceduo_uncertainty_release(&a);
    ceduo_scene_release(&file);
}

#define TREE_MAX .5 /* m: a tree of 0.2 m grows by 0.01 per year of the remaining diameter */

static void read_year(void *context, const struct point *point, const struct control_means *at)
{
    double *years = context;
    (void)at;
    double left = 1 - point->forest->belts[0].stand.trees[0].dbh / TREE_MAX;
    years[point->slot] = log((1 - .2 / TREE_MAX) / left) / .01;
}

/* The diameter of the trees gives their age: slot n is one of the two years 2n - 1 and 2n. */
TEST(slots_of_a_point_cover_all_years)
{
    static const char *const place = "rocks_per_year";
    const struct ceduo_input input = make_range(&place, 1, 2);
    const double u[2] = {.25, .75};
    double years[1 + CEDUO_UNCERTAINTY_YEARS_MAX] = {0};
    open_wood();
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    struct ceduo_stand *stand = &file.scene.options[0].belts[0].stand;
    stand->growth.trees = (struct ceduo_curve){.dbh_max = TREE_MAX, .dbh_rate = .01, .height_max = 20, .height_rate = .01};
    const struct ceduo_uncertainty_def def = set_long_years(&input);
    const struct points points = {.def = &def, .u = u, .read = read_year, .context = years};
    EXPECT(ceduo_points_years(&def), ==, CEDUO_UNCERTAINTY_YEARS_MAX);
    EXPECT(ceduo_points_run(&points, 0, 1, 0), ==, CEDUO_OK);
    for (int slot = 1; slot <= CEDUO_UNCERTAINTY_YEARS_MAX; slot++)
        EXPECT_NEAR(years[slot], 2 * slot - .5, .5 + 1e-6);
    ceduo_scene_release(&file);
}

static void read_nothing(void *context, const struct point *point, const struct control_means *at)
{
    (void)context, (void)point, (void)at;
}

/* Return the work for all points of a definition, for one option today. */
static double measure_effort(const struct ceduo_uncertainty_def *def)
{
    uint64_t met = 0;
    double *u = malloc(def->points * def->inputs_count * sizeof *u);
    EXPECT(ceduo_surface_points(1, def->points, def->inputs_count, u), ==, CEDUO_OK);
    const struct points points = {.def = def, .u = u, .today = true, .read = read_nothing, .effort = &met};
    EXPECT(ceduo_points_run(&points, 0, def->points, 0), ==, CEDUO_OK);
    free(u);
    return ceduo_effort_compute(def->scene,
                                &(struct ceduo_work){.rocks = def->points * def->rocks, .contacts = met, .runs = def->points});
}

/* The work for a page's uncertainty stays within 30 times that of its scene, or a guaranteed minimum, and below the upper
 * limit, for any slope. The points do not depend on the threads. A quick scene has all points. */
TEST(the_effort_of_a_page_is_bounded)
{
    static const char *const place = "slope.segments[0].rn";
    static const struct {
        double per_ha, diameter;
        uint64_t own;
        size_t min, max; /* points */
    } cases[] = {{1000, .8, 1000, CEDUO_UNCERTAINTY_POINTS, CEDUO_UNCERTAINTY_POINTS},
                 {1000, .8, 16, CEDUO_UNCERTAINTY_POINTS, CEDUO_UNCERTAINTY_POINTS},
                 {1e5, 1, 400, CEDUO_UNCERTAINTY_MIN, CEDUO_UNCERTAINTY_POINTS - 1},
                 {4e5, 60, 100, 0, 0}};
    const struct ceduo_input input = make_range(&place, .25, .35);
    open_wood();
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    for (int k = 0; k < 2; k++) /* trees stop no rock */
        file.scene.options[0].belts[0].stand.trees[k].volume = 1e-9;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct ceduo_results own;
        size_t points = 0;
        file.scene.options[0].belts[0].stand.trees[0].per_ha = cases[i].per_ha;
        file.scene.rock.diameter = ceduo_number(cases[i].diameter);
        struct ceduo_request q = ceduo_request_default(&file.scene);
        q.rocks = q.run.rocks_max = cases[i].own;
        EXPECT(ceduo_simulate_request(&q, NULL, &own), ==, CEDUO_OK);
        for (unsigned threads = 1; threads <= 2; threads++) {
            struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                                .scene = &file.scene,
                                                .inputs_count = 1,
                                                .inputs = &input,
                                                .points = CEDUO_UNCERTAINTY_POINTS,
                                                .rocks = cases[i].own < CEDUO_UNCERTAINTY_ROCKS ? cases[i].own
                                                                                                : CEDUO_UNCERTAINTY_ROCKS,
                                                .brief = true,
                                                .threads = threads};
            EXPECT(ceduo_effort_bound(&def, &own.work), ==, CEDUO_OK);
            EXPECT(def.points, >=, cases[i].min);
            EXPECT(def.points, <=, cases[i].max);
            if (def.points > 0) {
                EXPECT(measure_effort(&def), <=, CEDUO_EFFORT_MAX);
                EXPECT(measure_effort(&def), <=,
                       fmax(CEDUO_EFFORT_MIN, CEDUO_EFFORT_TIMES * ceduo_effort_compute(&file.scene, &own.work)));
            }
            assert_true(threads == 1 || def.points == points);
            points = def.points;
        }
        ceduo_results_release(&own);
    }
    ceduo_scene_release(&file);
}

/* Each point of the profile in the file costs 0.7 per run, and 4e7 are planned: with 1e6 points the rotation is dropped, with
 * 1e8 nothing is simulated. A cancelled pilot ends the estimate. */
TEST(a_rotation_is_dropped_before_all_points)
{
    static const char *const place = "slope.segments[0].rn";
    static const struct {
        size_t profile, min, max; /* points of the profile, and of the analysis */
    } cases[] = {{1000000, CEDUO_UNCERTAINTY_MIN, 57}, {100000000, 0, 0}};
    const struct ceduo_input input = make_range(&place, .25, .35);
    const struct ceduo_work own = {.rocks = 0};
    open_wood();
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    const struct ceduo_uncertainty_def asked = {.size = sizeof(struct ceduo_uncertainty_def),
                                                .scene = &file.scene,
                                                .inputs_count = 1,
                                                .inputs = &input,
                                                .points = CEDUO_UNCERTAINTY_POINTS,
                                                .rocks = CEDUO_SURFACE_GROUPS,
                                                .rotation = true,
                                                .window = {CEDUO_WINDOW_GIVEN, 1, 25, 1},
                                                .brief = true};
    for (size_t i = 0; i < LENGTH(cases); i++) {
        struct ceduo_uncertainty_def def = asked;
        file.scene.slope.points = cases[i].profile;
        EXPECT(ceduo_effort_bound(&def, &own), ==, CEDUO_OK);
        assert_false(def.rotation);
        EXPECT(def.points, >=, cases[i].min);
        EXPECT(def.points, <=, cases[i].max);
    }
    const atomic_bool cancelled = true;
    struct ceduo_uncertainty_def def = asked;
    def.cancel = &cancelled;
    EXPECT(ceduo_effort_bound(&def, &own), ==, CEDUO_CANCELLED);
    ceduo_scene_release(&file);
}

/* Trees that no rock can break or miss, cut in the second of two years: no rock arrives in the first, all in the second. Their
 * share is 1 in the worst year, and 1/2 in the mean. */
TEST(the_worst_year_of_plausible_cases)
{
    static const struct {
        enum ceduo_goal goal;
        double share;
    } cases[] = {{CEDUO_GOAL_WORST_ARRIVE, 1}, {CEDUO_GOAL_WORST_EXCEED, 1}, {CEDUO_GOAL_ARRIVE, .5}, {CEDUO_GOAL_EXCEED, .5}};
    static const char *const place = "rocks_per_year";
    const struct ceduo_input input = make_range(&place, 1, 2);
    open_wood();
    file.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    file.scene.controls[0].accepted = 1;
    struct ceduo_belt *belt = &file.scene.options[0].belts[0];
    belt->cut_year = 2;
    belt->stand.cutting.rotation = 10;
    belt->stand.stools_per_ha = 0;
    belt->stand.shoots_count = 0;
    belt->stand.u = 1e7;
    for (int k = 0; k < 2; k++) {
        belt->stand.trees[k].per_ha = 1e5;
        belt->stand.trees[k].volume = 10;
    }
    struct ceduo_uncertainty_def def = set_long_years(&input);
    def.window.last = 2;
    def.points = 20;
    for (size_t i = 0; i < LENGTH(cases); i++) {
        struct reliability_result answer;
        const struct reliability_def asked = {.uncertainty = def, .goal = cases[i].goal, .target = .25, .sure = .5};
        EXPECT(ceduo_reliability_compute(&asked, &answer), ==, CEDUO_OK);
        EXPECT_NEAR(answer.above, cases[i].share - .25, 1e-9);
        EXPECT(answer.share.value, ==, 0);
    }
    ceduo_scene_release(&file);
}

/* An input concerns future years alone if today's forest does not depend on it. */
TEST(inputs_of_future_years)
{
    static const struct {
        const char *place;
        bool future;
    } cases[] = {{"forest[0].stand.growth.trees.dbh_rate_1_y", true},
                 {"forest[0].stand.trees[0].dbh_m", false},
                 {"forest[0].stand.species", false},
                 {"no.such", false}};
    for (size_t i = 0; i < LENGTH(cases); i++) {
        const struct ceduo_input input = make_range(&cases[i].place, 1, 2);
        EXPECT(ceduo_input_is_future(&input), ==, cases[i].future);
    }
}

/* Without arrivals there is no energy, by the index and among stems. */
TEST(no_rock_brings_no_energy)
{
    const enum ceduo_contact_model models[] = {CEDUO_CONTACT_MODEL_INDEX, CEDUO_CONTACT_MODEL_STEMS};
    open_wood();
    file.scene.slope.segments[0].rt = ceduo_number(0);
    file.scene.slope.segments[0].friction = 100;
    for (int i = 0; i < 2; i++) { /* with 0 threads, which means one, and with one */
        struct reliability_result answer;
        const struct reliability_def def = {
            .uncertainty = {.scene = &file.scene, .points = 2, .rocks = 16, .threads = (unsigned)i},
            .goal = CEDUO_GOAL_ENERGY,
            .target = 5};
        file.scene.simulation.contact_model = models[i];
        EXPECT(ceduo_reliability_compute(&def, &answer), ==, CEDUO_OK);
        EXPECT(answer.above, ==, -5);
        EXPECT(answer.share.value, ==, 1);
    }
    ceduo_scene_release(&file);
}

/* A light changes if its limit lies from p5 on and below p95. A second input is named from half of the first one's share on.
 * With too few points no input is named. */
TEST(inputs_that_decide_a_light)
{
    static const struct {
        double p5, p95, second;
        bool enough;
        size_t named;
    } cases[] = {{.01, .2, .3, true, 2},  {.01, .2, .299, true, 1}, {.05, .2, .6, true, 2},
                 {.01, .05, .6, true, 0}, {.051, .2, .6, true, 0},  {.01, .2, .3, false, 0}};
    struct ceduo_uncertainty_figure figures[CEDUO_UNCERTAINTY_KINDS] = {0}, *f = &figures[CEDUO_UNCERTAINTY_EXCEED];
    const struct ceduo_uncertainty_result a = {.figures_count = CEDUO_UNCERTAINTY_KINDS, .figures = figures};
    struct ceduo_share total[3] = {{0}};
    size_t order[] = {0, 1, 2}, inputs[2];
    f->uses = 3, f->order = order, f->fit.total = total;
    open_wood();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        f->fit.p5 = cases[i].p5, f->fit.p95 = cases[i].p95, f->fit.enough_points = cases[i].enough;
        total[0].value = .1, total[1].value = cases[i].second, total[2].value = .6;
        EXPECT(ceduo_uncertainty_dominant_inputs(&file.scene, &a, 0, CEDUO_UNCERTAINTY_EXCEED, inputs), ==, cases[i].named);
        if (cases[i].named > 0 && cases[i].second < .6)
            EXPECT(inputs[0], ==, 2);
        if (cases[i].named > 1 && cases[i].second < .6)
            EXPECT(inputs[1], ==, 1);
    }
    ceduo_scene_release(&file);
}

/* Each of two words or rows has half of the range; its ends belong to it. A word may belong to one half only. */
TEST(words_and_rows_share_the_range)
{
    static const char *const places[] = {"simulation.rule", "rock.density_kg_m3", "rocks_per_year"};
    const int words[] = {CEDUO_RULE_INTERCEPTION, CEDUO_RULE_CROFTON};
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
                                          .places = &places[1]},
                                         make_range(&places[2], 1, 3)};
    const double u[] = {0, .4999, .5, 1};
    struct input_scene copy;
    open_wood();
    EXPECT(ceduo_inputs_open(&copy, &file.scene, inputs, 3), ==, CEDUO_OK);
    for (int i = 0; i < 4; i++) {
        ceduo_inputs_set(&copy, (double[]){u[i], u[i], u[i]});
        EXPECT((int)copy.scene.simulation.rule, ==, words[i / 2]);
        EXPECT_NEAR(copy.scene.rock.density.mean, rows[i / 2], 1e-9);
        EXPECT_NEAR(copy.scene.rocks_per_year, 1 + 2 * u[i], 1e-9);
    }
    ceduo_inputs_release(&copy);
    ceduo_scene_release(&file);
}

/* A normal input is truncated at three standard deviations with its mean in the centre, and a quarter of the rest lies below
 * the quartile: Φ(z) = Φ(-3) + (1 - 2Φ(-3))/4 at z = -0.6719. */
TEST(ends_of_a_normal_input)
{
    const struct ceduo_input input = {.kind = CEDUO_INPUT_NORMAL, .mean = 50, .sd = 4};
    EXPECT_NEAR(ceduo_input_quantile(&input, 0), 38, 1e-9);
    EXPECT_NEAR(ceduo_input_quantile(&input, .5), 50, 1e-9);
    EXPECT_NEAR(ceduo_input_quantile(&input, 1), 62, 1e-9);
    double z = (ceduo_input_quantile(&input, .25) - 50) / 4, min = erfc(3 / sqrt(2)) / 2;
    EXPECT_NEAR(erfc(-z / sqrt(2)) / 2, min + (1 - 2 * min) / 4, 1e-12);
}

/* Uncertain stools beyond their shoots are limited to the shoots; the next evaluation starts from the scene's values. */
TEST(stools_are_limited_to_their_shoots)
{
    static const char *const places[] = {"forest[0].stand.stools.per_ha", "forest[0].stand.shoots[0].per_ha"};
    const struct ceduo_input inputs[] = {make_range(&places[0], 600, 3000), make_range(&places[1], 500, 2500)};
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
    EXPECT(ceduo_inputs_open(&copy, &file.scene, &inputs[1], 1), ==, CEDUO_OK); /* only the shoots: 500, then 2500 */
    stand = &copy.scene.options[0].belts[0].stand;
    for (int i = 0; i < 2; i++) {
        ceduo_inputs_set(&copy, (double[]){i});
        EXPECT_NEAR(stand->stools_per_ha, i == 0 ? 500 : 600, 1e-9);
    }
    ceduo_inputs_release(&copy);
    ceduo_scene_release(&file);
}
