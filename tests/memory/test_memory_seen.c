/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Runs of blocks of all sizes, observations and simulated rocks, fits, and surveys, without memory. */
#include "local.h"
#include "memory/failing.h"

#include <gsl/gsl_errno.h>
#include <math.h>

#include "ceduo/calibrate.h"
#include "ceduo/ceduo.h"
#include "ceduo/survey.h"
#include "study/chains.h"
#include "study/guess.h"
#include "unit/ground.h"

#define ROCKS 6

/* A slope of 200 m with a drop of 80 m, trees on the first half, a rock of 1 m. */
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

static bool answer_block_sizes(void)
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
    q.run.other_energy = true;
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

static void see(struct ceduo_observation observed[4])
{
    observed[0] = make_observation(CEDUO_OBSERVED_STOPS);
    observed[0].from = NAN;
    observed[0].values = stops;
    observed[1] = make_observation(CEDUO_OBSERVED_PASSED);
    observed[1].count = 2;
    observed[1].of = 3;
    observed[2] = make_observation(CEDUO_OBSERVED_SCARS);
    observed[2].values = scars;
    observed[2].of = 10;
    observed[3] = make_observation(CEDUO_OBSERVED_ENERGY);
    observed[3].mean = 1e5;
    observed[3].sd = 1e4;
    observed[1].option = observed[3].option = 1;
}

static bool compare(void)
{
    struct ceduo_observation observed[4];
    struct ceduo_observer *observer;
    struct ceduo_observation_fit to[4];
    make_ground();
    see(observed);
    enum ceduo_status status = ceduo_observer_create(observed, 4, &observer);
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

static bool compare_without_fit(void)
{
    struct ceduo_observation observed[4];
    struct ceduo_predicted to[4];
    make_ground();
    see(observed);
    const struct ceduo_calibration_scene scene = {.scene = &ground.of.scene, .observations_count = 4, .observations = observed};
    enum ceduo_status status = ceduo_compare_with_observations(&scene, ROCKS, NULL, to);
    for (size_t i = 0; i < 4 && status == CEDUO_OK; i++)
        add(&to[i].p_value, sizeof to[i].p_value);
    return is_done(status);
}

/* ---- a fit that is continued ---- */

static enum ceduo_calibration_stage counted_stage; /* stage of a fit whose progress calls are counted */

static void tell(void *context, const struct ceduo_calibration_state *state)
{
    (void)context;
    note_told(state->stage == counted_stage);
}

#define REPEATS 200 /* repeats of an observation */

/* Fit one value to a repeated observation of a speed at x with the second option; chains of one round. */
static enum ceduo_status run_fit(const struct ceduo_input *input, double x, struct ceduo_calibration_def def)
{
    struct ceduo_observation observed[REPEATS];
    make_ground();
    for (size_t i = 0; i < REPEATS; i++) {
        observed[i] = make_observation(CEDUO_OBSERVED_SPEED);
        observed[i].x = x;
        observed[i].option = 1;
    }
    const struct ceduo_calibration_scene scene = {&ground.of.scene, input, REPEATS, observed}, scenes[2] = {scene, scene};
    struct ceduo_calibration a;
    def.scenes = scenes;
    def.parameters_count = def.seed = def.steps_most = 1;
    enum ceduo_status status = ceduo_calibrate(&def, &a);
    if (status == CEDUO_OK) {
        add(&a.parameters[0].best, sizeof a.parameters[0].best);
        add(&a.predicted[0].at_best.deviance, sizeof a.predicted[0].at_best.deviance);
        ceduo_calibration_free(&a);
    }
    return status;
}

/* Fit to an observed speed of one rock, with chains of one round. */
static enum ceduo_status run_short_fit(unsigned threads, uint64_t rocks, void (*meanwhile)(void),
                                       enum ceduo_calibration_stage stage, int at)
{
    static const char *const place = "release.vx_m_s";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 9, .places_count = 1, .places = &place};
    counted_stage = stage;
    begin_to_tell(meanwhile, at);
    return run_fit(&input, 1,
                   (struct ceduo_calibration_def){.scenes_count = 1, .rocks = rocks, .threads = threads, .progress = tell});
}

/* Fit one value to two scenes. Nearly all its trials stop before the observations, and take no time. */
static bool fit(void)
{
    static const char *const place = "release.x_m";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 2561, .places_count = 1, .places = &place};
    return is_done(run_fit(&input, 20, (struct ceduo_calibration_def){.scenes_count = 2, .rocks = 1, .threads = 1}));
}

static bool fit_on_many_threads(void)
{
    static const char *const place = "release.x_m";
    const struct ceduo_input input = {place, CEDUO_INPUT_RANGE, 1, 2561, .places_count = 1, .places = &place};
    return is_done(
        run_fit(&input, 20, (struct ceduo_calibration_def){.scenes_count = 1, .rocks = 1, .threads = CEDUO_THREADS_MAX}));
}

/* Many workers need additional buffers. */
TEST(workers_of_a_fit)
{
    for (unsigned long at = 1; at <= 4; at++)
        assert_false(begin(fit_on_many_threads, at, false));
}

/* The progress callback blocks no other thread and is not called twice at a time. Enough rocks that other threads are still
 * running at its next call. */
TEST(progress_calls_never_overlap)
{
    assert_int_equal(run_short_fit(2, 1000, others_go_on, CEDUO_SEARCH, 1), CEDUO_OK);
    assert_int_equal(told.most_inside, 1);
    assert_true(told.times > 1);
}

/* A thread without memory stops the others: only a few of 256 points are evaluated. */
TEST(one_failure_stops_all_threads)
{
    assert_int_equal(run_short_fit(2, 1, fail_others, CEDUO_SEARCH, 1), CEDUO_NO_MEMORY);
    assert_true(told.times < 100);
}

static long growth;

static void fail_to_grow(void)
{
    grow_at = growth;
}

static bool fit_that_cannot_grow(void)
{
    return is_done(run_short_fit(1, 1, fail_to_grow, CEDUO_SEARCH, 256));
}

/* The chains cannot store their trials or train the surrogate. */
TEST(chains_of_a_fit)
{
    for (growth = 1; growth <= 30; growth++) {
        assert_false(begin(fit_that_cannot_grow, 0, false));
        assert_int_equal(grow_at, 0);
    }
}

/* ---- many observations ---- */

/* Each observation has its own rock and buffers. */
static bool compare_many(void)
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

static enum ceduo_status normal(void *context, size_t chain, const double *x, double *log_density)
{
    (void)context, (void)chain;
    *log_density = -x[0] * x[0] / 2;
    return CEDUO_OK;
}

static double predict_surrogate(void *context, const double *x)
{
    return ceduo_guess_at(context, x);
}

static enum ceduo_status learn(void *context, const double *x, const double *log_densities, size_t n)
{
    return ceduo_guess_learn(context, x, log_densities, n, NULL);
}

static bool draw(void)
{
    static const double starts[2] = {-1, 1};
    LOCAL_BY(ceduo_guess_release) struct guess guess = ceduo_guess_begin(1);
    const struct chains_def def = {.dimensions = 1,
                                   .chains = 2,
                                   .starts = starts,
                                   .first_step = 1,
                                   .seed = 1,
                                   .threads = 2,
                                   .steps_most = 201,
                                   .rhat_most = 1.01,
                                   .effective_least = 1e9,
                                   .density = normal,
                                   .guess = predict_surrogate,
                                   .learn = learn,
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
    without_memory(answer_block_sizes);
}

TEST(comparison_with_observations)
{
    without_memory(compare);
    without_memory(compare_without_fit);
    without_memory(compare_many);
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
