/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Runs with block sizes, observations, fits and surveys, without memory. */
#include "local.h"
#include "memory/failing.h"
#include "study/observe.h"
#include "study/predict.h"

#include <gsl/gsl_errno.h>
#include <math.h>

#include "ceduo/ceduo.h"
#include "study/chains.h"
#include "study/surrogate.h"
#include "unit/ground.h"

#define ROCKS 6

/* Slope of 200 m that falls 80 m, with trees on the first half; a rock of 1 m. */
static struct {
    struct ground base;
    double volumes[2];
    struct ceduo_control control;
    struct ceduo_stems tree;
    struct ceduo_belt belt;
    struct ceduo_option options[2];
    struct ceduo_size_class blocks;
} ground;

static void make_ground(void)
{
    struct ceduo_scene *s = &ground.base.scene;
    memset(&ground, 0, sizeof ground);
    ground_make(&ground.base, 200, 80, 0, 5, 0);
    ground.base.segment = (struct ceduo_segment){
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

/* ---- block sizes ---- */

static bool simulate_sizes(void)
{
    make_ground();
    ground.volumes[0] = 0.1;
    ground.volumes[1] = 1;
    ground.blocks = (struct ceduo_size_class){.per_year = 0.5, .exponent = 1.1, .volumes_count = 2, .volumes = ground.volumes};
    ground.base.scene.blocks = &ground.blocks;
    ground.base.scene.blocks_count = 1;
    ground.base.scene.rocks_per_year = 0.5;
    struct ceduo_request q = ceduo_request_default(&ground.base.scene);
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

/* ---- observations ---- */

static double stops[3] = {60, 80, 120}, scars[3] = {0.4, 0.5, 0.6};

static struct ceduo_observation make_observation(enum ceduo_observed_kind kind)
{
    return (struct ceduo_observation){
        .kind = kind, .x = 20, .from = 10, .to = 40, .n = 3, .mean = 5, .sd = 1, .share_seen = NAN};
}

static void make_observations(struct ceduo_observation observed[4])
{
    observed[0] = make_observation(CEDUO_OBSERVED_STOPS);
    observed[0].from = NAN;
    observed[0].values = stops;
    observed[1] = make_observation(CEDUO_OBSERVED_PASSED);
    observed[1].count = 2;
    observed[1].released_count = 3;
    observed[2] = make_observation(CEDUO_OBSERVED_SCARS);
    observed[2].values = scars;
    observed[2].released_count = 10;
    observed[3] = make_observation(CEDUO_OBSERVED_ENERGY);
    observed[3].mean = 1e5;
    observed[3].sd = 1e4;
    observed[1].option = observed[3].option = 1;
}

static bool simulate_observations(void)
{
    struct ceduo_observation observed[4];
    struct ceduo_observer *observer;
    struct ceduo_observation_fit results[4];
    make_ground();
    make_observations(observed);
    enum ceduo_status status = ceduo_observer_create(observed, 4, &observer);
    if (!is_done(status)) {
        assert_null(observer);
        return false;
    }
    status = ceduo_observer_simulate(observer, &ground.base.scene, ROCKS, NULL, results);
    for (size_t i = 0; i < 4 && status == CEDUO_OK; i++)
        add(&results[i].log_likelihood, sizeof results[i].log_likelihood);
    for (size_t i = 1; i < 3 && status == CEDUO_OK; i++) {
        LOCAL_BYTES double *values;
        size_t n;
        status = ceduo_observer_values(observer, &ground.base.scene, i, ROCKS, &values, &n);
        add(values, status == CEDUO_OK ? n * sizeof *values : 0);
    }
    ceduo_observer_free(observer);
    return is_done(status);
}

static bool compare_without_fit(void)
{
    struct ceduo_observation observed[4];
    struct ceduo_predicted results[4];
    make_ground();
    make_observations(observed);
    const struct ceduo_calibration_scene scene = {
        .scene = &ground.base.scene, .observations_count = 4, .observations = observed};
    enum ceduo_status status = ceduo_compare_with_observations(&scene, ROCKS, NULL, results);
    for (size_t i = 0; i < 4 && status == CEDUO_OK; i++)
        add(&results[i].p_value, sizeof results[i].p_value);
    return is_done(status);
}

/* ---- fits ---- */

static enum ceduo_calibration_stage counted_stage; /* progress calls of this stage are counted */

static void count_stage(void *context, const struct ceduo_calibration_state *state)
{
    (void)context;
    count_progress_call(state->stage == counted_stage);
}

#define SPEEDS 200

/* Fit one value to SPEEDS equal observations of a speed at x through the second option, in each scene. Chains end after one
 * round. */
static enum ceduo_status fit_speed(const struct ceduo_input *input, double x, struct ceduo_calibration_def def)
{
    struct ceduo_observation observed[SPEEDS];
    make_ground();
    for (size_t i = 0; i < SPEEDS; i++) {
        observed[i] = make_observation(CEDUO_OBSERVED_SPEED);
        observed[i].x = x;
        observed[i].option = 1;
    }
    const struct ceduo_calibration_scene scene = {&ground.base.scene, input, SPEEDS, observed}, scenes[2] = {scene, scene};
    struct ceduo_calibration a;
    def.scenes = scenes;
    def.parameters_count = def.seed = def.steps_max = 1;
    enum ceduo_status status = ceduo_calibrate(&def, &a);
    if (status == CEDUO_OK) {
        add(&a.parameters[0].best, sizeof a.parameters[0].best);
        add(&a.predicted[0].at_best.deviance, sizeof a.predicted[0].at_best.deviance);
        ceduo_calibration_release(&a);
    }
    return status;
}

/* Fit the release speed to speeds of one rock. Chains end after one round. */
static enum ceduo_status fit_one_round(unsigned threads, uint64_t rocks, void (*callback)(void),
                                       enum ceduo_calibration_stage stage, int at)
{
    static const char *const place = "release.vx_m_s";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 9, .places_count = 1, .places = &place};
    counted_stage = stage;
    begin_progress(callback, at);
    return fit_speed(&input, 1,
                     (struct ceduo_calibration_def){.size = sizeof(struct ceduo_calibration_def),
                                                    .scenes_count = 1,
                                                    .rocks = rocks,
                                                    .threads = threads,
                                                    .progress = count_stage});
}

/* Fit one value to two scenes. Nearly all releases lie beyond the observed place, and take no time. */
static bool fit_two_scenes(void)
{
    static const char *const place = "release.x_m";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 2561, .places_count = 1, .places = &place};
    return is_done(fit_speed(&input, 20,
                             (struct ceduo_calibration_def){
                                 .size = sizeof(struct ceduo_calibration_def), .scenes_count = 2, .rocks = 1, .threads = 1}));
}

static bool fit_on_many_threads(void)
{
    static const char *const place = "release.x_m";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 2561, .places_count = 1, .places = &place};
    return is_done(fit_speed(
        &input, 20,
        (struct ceduo_calibration_def){
            .size = sizeof(struct ceduo_calibration_def), .scenes_count = 1, .rocks = 1, .threads = CEDUO_THREADS_MAX}));
}

/* The state of CEDUO_THREADS_MAX workers is an allocation of its own. */
TEST(workers_of_a_fit)
{
    for (unsigned long at = 1; at <= 4; at++)
        assert_false(run_task(fit_on_many_threads, at, false));
}

/* A progress callback blocks no other thread, and does not run twice at a time. With 1000 rocks the other threads are still
 * busy while it waits. */
TEST(one_progress_call_at_a_time)
{
    assert_int_equal(fit_one_round(2, 1000, wait_for_other_threads, CEDUO_CALIBRATION_STAGE_SEARCH, 1), CEDUO_OK);
    assert_int_equal(progress_calls.inside_max, 1);
    assert_true(progress_calls.times > 1);
}

/* If memory fails in one thread, the other one ends, too: few of 256 points are evaluated. */
TEST(one_thread_ends_all)
{
    assert_int_equal(fit_one_round(2, 1, fail_others, CEDUO_CALIBRATION_STAGE_SEARCH, 1), CEDUO_NO_MEMORY);
    assert_true(progress_calls.times < 100);
}

static long growth;

static void fail_to_grow(void)
{
    grow_at = growth;
}

static bool fit_that_cannot_grow(void)
{
    return is_done(fit_one_round(1, 1, fail_to_grow, CEDUO_CALIBRATION_STAGE_SEARCH, 256));
}

/* Memory fails for the points of the chains, and for the surrogate trained on them and all points before. */
TEST(chains_of_a_fit)
{
    for (growth = 1; growth <= 30; growth++) {
        assert_false(run_task(fit_that_cannot_grow, 0, false));
        assert_int_equal(grow_at, 0);
    }
}

/* ---- many observations ---- */

/* Observe 64 rocks; each needs a simulation of its own. */
static bool observe_many(void)
{
    enum { MANY = 64 };
    static struct ceduo_rock_def rocks[MANY];
    struct ceduo_observation observed[MANY];
    LOCAL(ceduo_observer, observer);
    for (size_t i = 0; i < MANY; i++) {
        observed[i] = make_observation(CEDUO_OBSERVED_SPEED);
        observed[i].rock = &rocks[i];
    }
    enum ceduo_status status = ceduo_observer_create(observed, MANY, &observer);
    return is_done(status);
}

/* ---- chains ---- */

static enum ceduo_status normal_density(void *context, size_t chain, const double *x, double *log_density)
{
    (void)context, (void)chain;
    *log_density = -x[0] * x[0] / 2;
    return CEDUO_OK;
}

static double evaluate_surrogate(void *context, const double *x)
{
    return ceduo_surrogate_evaluate(context, x);
}

static enum ceduo_status train_surrogate(void *context, const double *x, const double *log_densities, size_t n)
{
    return ceduo_surrogate_train(context, x, log_densities, n, NULL);
}

static bool run_chains(void)
{
    static const double starts[2] = {-1, 1};
    LOCAL_BY(ceduo_surrogate_free) struct surrogate surrogate = ceduo_surrogate_begin(1);
    const struct chains_def def = {.dimensions = 1,
                                   .chains = 2,
                                   .starts = starts,
                                   .first_step = 1,
                                   .seed = 1,
                                   .threads = 2,
                                   .steps_max = 201,
                                   .rhat_max = 1.01,
                                   .effective_min = 1e9,
                                   .density = normal_density,
                                   .surrogate = evaluate_surrogate,
                                   .train = train_surrogate,
                                   .context = &surrogate};
    LOCAL_BY(ceduo_chains_release) struct chains chains;
    enum ceduo_status status = ceduo_chains_run(&def, &chains);
    if (status == CEDUO_OK)
        add(ceduo_chains_draw(&chains, 0), sizeof(double));
    return is_done(status);
}

/* ---- surveys ---- */

static bool compute_survey(void)
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
    LOCAL_BY(ceduo_survey_release) struct ceduo_survey_result answer;
    enum ceduo_status status = ceduo_survey_compute(&s, &answer);
    if (status == CEDUO_OK) {
        assert_int_equal(answer.shoots.from, CEDUO_SURVEY_HEIGHTS_CURVE);
        for (size_t i = 0; i < answer.classes_count; i++)
            add(&answer.classes[i].height, sizeof answer.classes[i].height);
    } else {
        assert_null(answer.classes);
    }
    return is_done(status);
}

TEST(sizes)
{
    without_memory(simulate_sizes);
}

TEST(observations)
{
    without_memory(simulate_observations);
    without_memory(compare_without_fit);
    without_memory(observe_many);
}

TEST(fits)
{
    without_memory(fit_two_scenes);
    without_memory(run_chains);
}

TEST(surveys)
{
    without_memory(compute_survey);
}

static int set_up(void **state)
{
    (void)state;
    gsl_set_error_handler_off();
    return 0;
}

AROUND_TESTS(set_up, NULL);
