/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Without memory: runs of blocks of all sizes, what was seen beside simulated rocks, fits, and surveys. */
#include "local.h"
#include "memory/failing.h"

#include <gsl/gsl_errno.h>
#include <math.h>

#include "ceduo/calibrate.h"
#include "ceduo/ceduo.h"
#include "ceduo/survey.h"
#include "study/chains.h"
#include "study/surrogate.h"
#include "unit/ground.h"

#define ROCKS 6

/* 200 m that fall 80 m, trees on the first half; a rock of 1 m. */
static struct {
    struct ground of;
    double volumes[2];
    struct ceduo_control control;
    struct ceduo_stems tree;
    struct ceduo_belt belt;
    struct ceduo_option options[2];
    struct ceduo_size_class blocks;
} ground;

static void make_ground(void)
{
    struct ceduo_scene *s = &ground.of.scene;
    memset(&ground, 0, sizeof ground);
    ground_make(&ground.of, 200, 80, 0, 5, 0);
    ground.of.segment = (struct ceduo_segment){
        .rn = ceduo_number(0.4), .rt = ceduo_number(0.9), .roughness_m = NAN, .roughness_rad = 0.2, .friction = 0.5, .mu = 0.5};
    s->release.height = ceduo_scene_default().release.height;
    ground.control = (struct ceduo_control){.x = 20, .x_given = 20, .accepted = 1e5, .measured_speed = NAN};
    s->controls = &ground.control;
    s->controls_count = 1;
    ground.tree = (struct ceduo_stems){.per_ha = 400, .dbh = 0.2, .height = 15, .volume = 0.2, .age = NAN};
    ground.belt = (struct ceduo_belt){.from = 1, .to = 100, .to_given = 100, .cut_year = NAN};
    ground.belt.stand =
        (struct ceduo_stand){.species = -1, .trees_count = 1, .trees = &ground.tree, .u = 1000, .fracture_ratio = NAN};
    ground.options[0] = (struct ceduo_option){.name = (char *)(uintptr_t) "wood", .belts_count = 1, .belts = &ground.belt};
    ground.options[1] = (struct ceduo_option){.name = (char *)(uintptr_t) "bare"};
    s->options = ground.options;
    s->options_count = 2;
    s->simulation.rocks = ROCKS;
}

/* ---- blocks of all sizes ---- */

static bool ask_of_blocks(void)
{
    make_ground();
    ground.volumes[0] = 0.1;
    ground.volumes[1] = 1;
    ground.blocks = (struct ceduo_size_class){.per_year = 0.5, .exponent = 1.1, .volumes_count = 2, .volumes = ground.volumes};
    ground.of.scene.blocks = &ground.blocks;
    ground.of.scene.blocks_count = 1;
    ground.of.scene.rocks_per_year = 0.5;
    struct ceduo_request q = ceduo_request_default(&ground.of.scene);
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    q.rocks = ROCKS;
    q.run.threads = 1;
    q.run.alternative_energy = true;
    q.years = true;
    q.window = (struct ceduo_window){.last = 1, .step = 1};
    enum ceduo_status status = ceduo_simulate_request(&q, NULL, &answer);
    if (status == CEDUO_OK) {
        const struct ceduo_arrivals *a = ceduo_result_wooded(answer.result, 0, 0);
        assert_true(a->reach.mean > 0);
        add(&a->hazard.reach, sizeof a->hazard.reach);
        add(&a->hazard.accepted, sizeof a->hazard.accepted);
        add(&a->reach.mean, sizeof a->reach.mean);
    }
    return is_done(status);
}

/* ---- what was seen ---- */

static double stops[3] = {60, 80, 120}, scars[3] = {0.4, 0.5, 0.6};

static struct ceduo_observation something(enum ceduo_observed_kind kind)
{
    return (struct ceduo_observation){
        .kind = kind, .x = 20, .from = 10, .to = 40, .n = 3, .mean = 5, .sd = 1, .share_seen = NAN};
}

static void see(struct ceduo_observation seen[4])
{
    seen[0] = something(CEDUO_OBSERVED_STOPS);
    seen[0].from = NAN;
    seen[0].values = stops;
    seen[1] = something(CEDUO_OBSERVED_PASSED);
    seen[1].count = 2;
    seen[1].released_count = 3;
    seen[2] = something(CEDUO_OBSERVED_SCARS);
    seen[2].values = scars;
    seen[2].released_count = 10;
    seen[3] = something(CEDUO_OBSERVED_ENERGY);
    seen[3].mean = 1e5;
    seen[3].sd = 1e4;
    seen[1].option = seen[3].option = 1;
}

static bool look(void)
{
    struct ceduo_observation seen[4];
    struct ceduo_observer *observer;
    struct ceduo_observation_fit to[4];
    make_ground();
    see(seen);
    enum ceduo_status status = ceduo_observer_create(seen, 4, &observer);
    if (!is_done(status)) {
        assert_null(observer);
        return false;
    }
    status = ceduo_observer_simulate(observer, &ground.of.scene, ROCKS, NULL, to);
    for (size_t i = 0; i < 4 && status == CEDUO_OK; i++)
        add(&to[i].log_likelihood, sizeof to[i].log_likelihood);
    for (size_t i = 1; i < 3 && status == CEDUO_OK; i++) {
        LOCAL_BYTES double *values;
        size_t n;
        status = ceduo_observer_values(observer, &ground.of.scene, i, ROCKS, &values, &n);
        add(values, status == CEDUO_OK ? n * sizeof *values : 0);
    }
    ceduo_observer_free(observer);
    return is_done(status);
}

static bool look_without_a_fit(void)
{
    struct ceduo_observation seen[4];
    struct ceduo_predicted to[4];
    make_ground();
    see(seen);
    const struct ceduo_calibration_scene scene = {.scene = &ground.of.scene, .observations_count = 4, .observations = seen};
    enum ceduo_status status = ceduo_compare_with_observations(&scene, ROCKS, NULL, to);
    for (size_t i = 0; i < 4 && status == CEDUO_OK; i++)
        add(&to[i].p_value, sizeof to[i].p_value);
    return is_done(status);
}

/* ---- a fit that goes on ---- */

static enum ceduo_calibration_stage counted_stage; /* stage of a fit, of which it is counted how often it is told */

static void tell(void *context, const struct ceduo_calibration_state *state)
{
    (void)context;
    note_told(state->stage == counted_stage);
}

#define SEEN 200 /* times */

/* Of one value, to a speed that was seen at x through the second option, so often in each scene; chains of one round. */
static enum ceduo_status fit_of(const struct ceduo_input *input, double x, struct ceduo_calibration_def def)
{
    struct ceduo_observation seen[SEEN];
    make_ground();
    for (size_t i = 0; i < SEEN; i++) {
        seen[i] = something(CEDUO_OBSERVED_SPEED);
        seen[i].x = x;
        seen[i].option = 1;
    }
    const struct ceduo_calibration_scene scene = {&ground.of.scene, input, SEEN, seen}, scenes[2] = {scene, scene};
    struct ceduo_calibration a;
    def.scenes = scenes;
    def.parameters_count = def.seed = def.steps_max = 1;
    enum ceduo_status status = ceduo_calibrate(&def, &a);
    if (status == CEDUO_OK) {
        add(&a.parameters[0].best, sizeof a.parameters[0].best);
        add(&a.predicted[0].at_best.deviance, sizeof a.predicted[0].at_best.deviance);
        ceduo_calibration_free(&a);
    }
    return status;
}

/* A fit of a speed to what was seen of one rock, its chains of one round. */
static enum ceduo_status fit_of_one_round(unsigned threads, uint64_t rocks, void (*meanwhile)(void),
                                          enum ceduo_calibration_stage stage, int at)
{
    static const char *const place = "release.vx_m_s";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 9, .places_count = 1, .places = &place};
    counted_stage = stage;
    begin_to_tell(meanwhile, at);
    return fit_of(&input, 1,
                  (struct ceduo_calibration_def){.scenes_count = 1, .rocks = rocks, .threads = threads, .progress = tell});
}

/* A fit of one value to two scenes. Nearly all that it tries lies beyond where something was seen, and takes no time. */
static bool fit(void)
{
    static const char *const place = "release.x_m";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 2561, .places_count = 1, .places = &place};
    return is_done(fit_of(&input, 20, (struct ceduo_calibration_def){.scenes_count = 2, .rocks = 1, .threads = 1}));
}

static bool fit_on_many_threads(void)
{
    static const char *const place = "release.x_m";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 2561, .places_count = 1, .places = &place};
    return is_done(
        fit_of(&input, 20, (struct ceduo_calibration_def){.scenes_count = 1, .rocks = 1, .threads = CEDUO_THREADS_MAX}));
}

/* What so many workers need takes room of its own. */
TEST(workers_of_a_fit)
{
    for (unsigned long at = 1; at <= 4; at++)
        assert_false(begin(fit_on_many_threads, at, false));
}

/* Who is told how far it is holds up nobody, and is not told meanwhile. So many rocks that the others are not at the end
 * before it looks up again. */
TEST(one_is_told_at_a_time)
{
    assert_int_equal(fit_of_one_round(2, 1000, others_go_on, CEDUO_SEARCH, 1), CEDUO_OK);
    assert_int_equal(told.most_inside, 1);
    assert_true(told.times > 1);
}

/* Where one thread has no memory the other ends, too: of 256 points few are looked at then. */
TEST(one_thread_ends_all)
{
    assert_int_equal(fit_of_one_round(2, 1, fail_others, CEDUO_SEARCH, 1), CEDUO_NO_MEMORY);
    assert_true(told.times < 100);
}

static long growth;

static void fail_to_grow(void)
{
    grow_at = growth;
}

static bool fit_that_cannot_grow(void)
{
    return is_done(fit_of_one_round(1, 1, fail_to_grow, CEDUO_SEARCH, 256));
}

/* What chains have tried, and what is learned of it and of all points before, has no room. */
TEST(chains_of_a_fit)
{
    for (growth = 1; growth <= 30; growth++) {
        assert_false(begin(fit_that_cannot_grow, 0, false));
        assert_int_equal(grow_at, 0);
    }
}

/* ---- many that were seen ---- */

/* Each of a rock of its own, which takes room of its own. */
static bool see_many(void)
{
    enum { MANY = 64 };
    static struct ceduo_rock_def rocks[MANY];
    struct ceduo_observation seen[MANY];
    LOCAL(ceduo_observer, observer);
    for (size_t i = 0; i < MANY; i++) {
        seen[i] = something(CEDUO_OBSERVED_SPEED);
        seen[i].rock = &rocks[i];
    }
    enum ceduo_status status = ceduo_observer_create(seen, MANY, &observer);
    return is_done(status);
}

/* ---- chains ---- */

static enum ceduo_status normal(void *context, size_t chain, const double *x, double *log_density)
{
    (void)context, (void)chain;
    *log_density = -x[0] * x[0] / 2;
    return CEDUO_OK;
}

static double guess_at(void *context, const double *x)
{
    return ceduo_surrogate_evaluate(context, x);
}

static enum ceduo_status learn(void *context, const double *x, const double *log_densities, size_t n)
{
    return ceduo_surrogate_train(context, x, log_densities, n, NULL);
}

static bool draw(void)
{
    static const double starts[2] = {-1, 1};
    LOCAL_BY(ceduo_surrogate_free) struct surrogate guess = ceduo_surrogate_begin(1);
    const struct chains_def def = {.dimensions = 1,
                                   .chains = 2,
                                   .starts = starts,
                                   .first_step = 1,
                                   .seed = 1,
                                   .threads = 2,
                                   .steps_max = 201,
                                   .rhat_max = 1.01,
                                   .effective_min = 1e9,
                                   .density = normal,
                                   .surrogate = guess_at,
                                   .train = learn,
                                   .context = &guess};
    LOCAL_BY(ceduo_chains_release) struct chains chains;
    enum ceduo_status status = ceduo_chains_run(&def, &chains);
    if (status == CEDUO_OK)
        add(ceduo_chains_draw(&chains, 0), sizeof(double));
    return is_done(status);
}

/* ---- surveys ---- */

static bool survey(void)
{
    struct ceduo_survey_stem stems[8];
    const double area = 100;
    for (size_t i = 0; i < 8; i++)
        stems[i] = (struct ceduo_survey_stem){.kind = i < 7 ? CEDUO_SURVEY_SHOOT : CEDUO_SURVEY_TREE,
                                              .dbh = 0.05 + 0.01 * (double)i,
                                              .height = i == 6 ? NAN : 5 + sqrt((double)i),
                                              .spacing = 0.3,
                                              .energy = NAN};
    const struct ceduo_survey s = {.plots_count = 1, .areas = &area, .stools_count = 1, .stems_count = 8, .stems = stems};
    LOCAL_BY(ceduo_survey_free) struct ceduo_survey_result answer;
    enum ceduo_status status = ceduo_survey_compute(&s, &answer);
    if (status == CEDUO_OK) {
        assert_int_equal(answer.shoots.from, CEDUO_HEIGHTS_CURVE);
        for (size_t i = 0; i < answer.classes_count; i++)
            add(&answer.classes[i].height, sizeof answer.classes[i].height);
    } else {
        assert_null(answer.classes);
    }
    return is_done(status);
}

TEST(blocks_come_down)
{
    without_memory(ask_of_blocks);
}

TEST(what_was_seen)
{
    without_memory(look);
    without_memory(look_without_a_fit);
    without_memory(see_many);
}

TEST(fits)
{
    without_memory(fit);
    without_memory(draw);
}

TEST(surveys)
{
    without_memory(survey);
}

static int set_up(void **state)
{
    (void)state;
    gsl_set_error_handler_off();
    return 0;
}

AROUND_TESTS(set_up, NULL);
