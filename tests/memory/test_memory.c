/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Runs and results built on them, without memory. */
#include "core/runs/pool.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "core/runs/year_runs.h"
#include "local.h"
#include "memory/failing.h"
#include "study/surface.h"

#include <math.h>

#include "physics/paper_site.h"
#include "study/inputs.h"
#include "study/reliability.h"
#include "study/snapshot.h"
#include "study/verdict.h"

/* ---- runs ---- */

static struct paper_site site;

static void init(enum ceduo_contact_model model, enum ceduo_law law)
{
    paper_site_init(&site);
    site.scene.simulation.contact_model = model;
    site.scene.simulation.law = law;
    site.scene.simulation.rocks = 1500;
    site.scene.release.x.mean = 118; /* short trajectories: each is simulated some thousand times */
    site.scene.release.vx.mean = 14;
    site.scene.release.vz.mean = -5;
    site.control.accepted = 50e3;
    site.plots[1].trees.group = 5;
    site.plots[1].trees.group_radius = 3;
}

/* Retry until success; return CEDUO_OK. A failed call has no effect and can be repeated. */
static enum ceduo_status extend(struct ceduo_run *run, uint64_t rocks)
{
    uint64_t before = ceduo_run_rocks(run);
    enum ceduo_status status = ceduo_run_extend(run, rocks);
    if (status == CEDUO_OK)
        return status;
    assert_int_equal(status, CEDUO_NO_MEMORY);
    relieve();
    assert_int_equal(ceduo_run_rocks(run), before);
    return ceduo_run_extend(run, rocks);
}

/* Add the results of control 0 and the stops of the rocks. */
static bool add_run(const struct ceduo_run *run)
{
    struct ceduo_arrivals a;
    struct ceduo_ends e;
    enum ceduo_status status = ceduo_run_arrivals(run, 0, &a);
    if (status == CEDUO_OK)
        status = ceduo_run_ends(run, &e);
    if (!is_done(status))
        return false;
    assert_true(a.reached > 0 && e.stop_x.n > 0);
    add(&a, sizeof a);
    add(&e, sizeof e);
    uint64_t contacts = ceduo_run_contacts(run);
    add(&contacts, sizeof contacts);
    return true;
}

static bool simulate(struct ceduo_run_def def)
{
    struct ceduo_run *run;
    if (!is_done(ceduo_run_create(&def, &run))) {
        assert_null(run);
        return false;
    }
    assert_int_equal(extend(run, 40), CEDUO_OK);
    assert_int_equal(extend(run, 1500), CEDUO_OK);
    bool good = add_run(run);
    struct ceduo_difference d = ceduo_run_difference(run, run, 0);
    add(&d, sizeof d);
    ceduo_run_free(run);
    return good;
}

static struct ceduo_run_def make_def(bool wood)
{
    struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
    def.option = wood ? &site.option : NULL;
    def.threads = 2;
    return def;
}

static bool simulate_bare(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    return simulate(make_def(false));
}

static bool simulate_scalar_forest(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_CRSP);
    site.plots[0].shoots.dbh_sd = 0.02;
    return simulate(make_def(true));
}

/* Blocks of all sizes on ground whose roughness is a height; the profile is simplified. */
static double volumes[] = {0.05, 1};
static struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
static bool simulate_blocks(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    paper_site_read_theta(&site, PAPER_HEIGHT);
    site.scene.slope.tolerance = 0.5;
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    return simulate(make_def(false));
}

/* A profile with enough vertices to group its segments into blocks. */
enum { VERTICES_MAX = 2600 };
static bool simulate_profile(size_t vertices)
{
    static double x[VERTICES_MAX], z[VERTICES_MAX];
    static struct ceduo_segment segments[VERTICES_MAX - 1];
    double metres = 156 / (double)(vertices - 1);
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    for (size_t i = 0; i < vertices; i++) {
        x[i] = metres * (double)i;
        z[i] = metres * (-0.75 * (double)i + 0.25 * (double)(i % 2));
        if (i > 0)
            segments[i - 1] = site.segments[2];
    }
    site.scene.slope = (struct ceduo_slope){.vertices = vertices, .x = x, .z = z, .segments = segments};
    site.scene.simulation.rocks = 50;
    site.scene.release.x.mean = 20;
    site.scene.release.vx.mean = 3;
    struct ceduo_run_def def = make_def(false);
    struct ceduo_run *run;
    if (ceduo_run_create(&def, &run) != CEDUO_OK)
        return false;
    assert_int_equal(extend(run, 50), CEDUO_OK);
    uint64_t contacts = ceduo_run_contacts(run);
    assert_true(contacts > 50);
    add(&contacts, sizeof contacts);
    ceduo_run_free(run);
    return true;
}

static bool simulate_long_profile(void)
{
    return simulate_profile(40);
}

/* Its vertices are closer than a rock's radius, so that rocks roll over whole blocks. */
static bool simulate_fine_profile(void)
{
    return simulate_profile(VERTICES_MAX);
}

/* ---- results built on runs ---- */

/* Make the second option clearly worse, and clearly better under the other energy law. */
static void reverse_order(struct ceduo_result *r)
{
    const struct ceduo_estimate worse = {0.5, 0.1, NAN, NAN}, better = {-0.5, 0.1, NAN, NAN};
    r->options[1].differences[0].exceed = worse;
    for (size_t i = 0; i < 2; i++)
        r->options[i].alternatives[0] = (struct ceduo_alternative_energy){.known = true};
    r->options[1].alternatives[0].to_first.exceed = better;
}

/* Add arrivals without the address of their fence. */
static void add_arrivals(const struct ceduo_arrivals *arrivals)
{
    struct ceduo_arrivals a = *arrivals;
    a.fence = NULL;
    add(&a, sizeof a);
}

/* Two options, one cut in the second of the years, and blocks of several sizes. */
static bool answer_options(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_option options[2] = {site.option, {.name = NULL}};
    site.scene.options = options;
    site.scene.options_count = 2;
    struct ceduo_stand *stand = &site.belts[0].stand;
    stand->growth = paper_growth;
    static double stay = 50;
    stand->cutting = (struct ceduo_cutting){.rotation = 20, .retained_count = 1, .stay_per_ha = &stay};
    site.belts[0].cut_year = 2;
    struct ceduo_request q = ceduo_request_default(&site.scene);
    LOCAL(ceduo_pool, pool) = NULL;
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    q.run = make_def(false);
    q.rocks = 30;
    q.tolerance = 1;
    q.years = true;
    q.window = (struct ceduo_window){.last = 4, .step = 2};
    q.block_rocks = 20;
    enum ceduo_status status = ceduo_simulate_request(&q, &pool, &answer);
    LOCAL_BY(ceduo_verdict_release) struct ceduo_verdict verdict = {0};
    if (status == CEDUO_OK)
        reverse_order(answer.result);
    if (status == CEDUO_OK)
        status = ceduo_compare_options(answer.result, answer.years, NULL, &verdict);
    if (status == CEDUO_OK) {
        struct ceduo_years_summary s = ceduo_years_summarize(answer.years[0], 0);
        assert_int_equal(verdict.reversals_count, 1);
        add(&verdict.choices[0].yield.volume_today, sizeof verdict.choices[0].yield.volume_today);
        add_arrivals(ceduo_result_wooded(answer.result, 0, 0));
        add(&s.reach, sizeof s.reach);
        add(&s.worst, sizeof s.worst);
        for (size_t i = 0; i < 2 * CEDUO_SIZES; i++) {
            add(&answer.blocks[i].arrivals.reached, sizeof answer.blocks[i].arrivals.reached);
            add(&answer.blocks[i].arrivals.exceed.hi, sizeof answer.blocks[i].arrivals.exceed.hi);
        }
    }
    return is_done(status);
}

/* Years simulated twice, with the weights of blocks and a fence. */
static bool answer_block_years(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    site.control.fence = (struct ceduo_fence){.height = 2, .energy = 100e3};
    site.scene.blocks = &blocks;
    site.scene.blocks_count = 1;
    struct ceduo_run_def def = make_def(false);
    LOCAL(ceduo_pool, pool) = NULL;
    LOCAL(ceduo_years, years) = NULL;
    LOCAL_BY(ceduo_simulated_release) struct ceduo_simulated bare = {0};
    struct ceduo_run *run;
    enum ceduo_status status = ceduo_pool_create(&def, &pool);
    if (status == CEDUO_OK)
        status = ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.step = 1}, &years);
    if (status == CEDUO_OK)
        status = ceduo_pool_simulate(pool, NULL, 40, &run);
    if (status == CEDUO_OK)
        status = ceduo_simulated_read(run, &site.scene, NULL, &bare);
    for (uint64_t rocks = 30; rocks <= 40 && status == CEDUO_OK; rocks += 10)
        status = ceduo_years_simulate(years, pool, &bare, rocks);
    if (status == CEDUO_OK) {
        struct ceduo_years_summary s = ceduo_years_summarize(years, 0);
        assert_true(s.exceed.se > 0);
        add(&s.exceed, sizeof s.exceed);
        const struct ceduo_fence_years f = ceduo_years_fence(years, 0, &years->years[0].wooded.arrivals[0]);
        assert_true(f.mean.mean == f.worst.mean); /* one year */
        add(&f.mean.mean, sizeof f.mean.mean);
    }
    return is_done(status);
}

/* Answer a request for 30 rocks. */
static bool answer_request(struct ceduo_request q)
{
    LOCAL_BY(ceduo_results_release) struct ceduo_results answer;
    q.rocks = 30;
    enum ceduo_status status = ceduo_simulate_request(&q, NULL, &answer);
    assert_int_equal(answer.result != NULL, status == CEDUO_OK);
    if (is_done(status)) {
        const struct ceduo_option_result *option = &answer.result->options[0];
        assert_int_equal(option->wooded.rocks, 30);
        add_arrivals(&option->wooded.arrivals[0]);
        add(&option->controls[0].residual, sizeof option->controls[0].residual);
    }
    return status == CEDUO_OK;
}

/* Each year with independent rocks. */
static bool answer_independent_years(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_request q = ceduo_request_default(&site.scene);
    q.years = true;
    q.window = (struct ceduo_window){.last = 2, .step = 1};
    q.years_independent = true;
    q.year_rocks = 20;
    return answer_request(q);
}

/* Under both energy laws. */
static bool answer_both_laws(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_control controls[2] = {site.control, site.control}; /* both at one place */
    site.scene.controls = controls;
    site.scene.controls_count = 2;
    struct ceduo_request q = ceduo_request_default(&site.scene);
    q.run.alternative_energy = true;
    return answer_request(q);
}

static const char *const density = "rock.density_kg_m3", *const speed = "release.vx_m_s";
static const struct ceduo_input inputs[2] = {
    {"rock.density_kg_m3", CEDUO_INPUT_RANGE, 2400, 2750, .places_count = 1, .places = &density},
    {"release.vx_m_s", CEDUO_INPUT_RANGE, 0.5, 5, .places_count = 1, .places = &speed}};

/* Uncertain inputs of the site, with n points and rocks. */
static struct ceduo_uncertainty_def uncertainty_def(size_t points, uint64_t rocks)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    return (struct ceduo_uncertainty_def){.size = sizeof(struct ceduo_uncertainty_def),
                                          .scene = &site.scene,
                                          .inputs_count = 2,
                                          .inputs = inputs,
                                          .points = points,
                                          .rocks = rocks,
                                          .threads = 2};
}

static enum ceduo_status ask_uncertainty(struct ceduo_uncertainty_def def)
{
    struct ceduo_uncertainty_result answer;
    enum ceduo_status status = ceduo_uncertainty_compute(&def, &answer);
    if (status == CEDUO_OK) {
        add(&answer.figures[CEDUO_UNCERTAINTY_ENERGY].fit.p50, sizeof answer.figures[CEDUO_UNCERTAINTY_ENERGY].fit.p50);
        add(answer.orders, answer.orders_count * sizeof answer.orders[0]);
        ceduo_uncertainty_release(&answer);
    }
    return status;
}

/* With a second option, without trees. */
static bool uncertainty(void)
{
    struct ceduo_uncertainty_def def = uncertainty_def(16, 16);
    struct ceduo_option options[2] = {site.option, {.name = NULL}};
    site.scene.options = options;
    site.scene.options_count = 2;
    return is_done(ask_uncertainty(def));
}

static bool uncertainty_over_years(void)
{
    struct ceduo_uncertainty_def def = uncertainty_def(8, 16);
    def.rotation = true;
    def.window = (struct ceduo_window){.first = 1, .last = 2, .step = 1};
    return is_done(ask_uncertainty(def));
}

static bool sure(void)
{
    struct reliability_result answer = {.above = 0};
    const struct reliability_def def = {
        .uncertainty = uncertainty_def(8, 16), .goal = CEDUO_GOAL_ARRIVE, .target = .5, .sure = .9};
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    enum ceduo_status status = ceduo_reliability_compute(&def, &answer);
    if (status == CEDUO_OK)
        add(&answer.above, sizeof answer.above);
    return is_done(status);
}

static void tell(void *context, uint64_t done, uint64_t all)
{
    (void)context, (void)done, (void)all;
    count_progress_call(true);
}

static enum ceduo_status uncertainty_on_two_threads(uint64_t rocks, void (*meanwhile)(void))
{
    struct ceduo_uncertainty_def def = uncertainty_def(100, rocks);
    def.progress = tell;
    begin_progress(meanwhile, 1);
    return ask_uncertainty(def);
}

/* The progress callback blocks no other thread and is not called twice at a time. Enough rocks that other threads are still
 * running at its next call. */
TEST(progress_calls_never_overlap)
{
    assert_int_equal(uncertainty_on_two_threads(1000, wait_for_other_threads), CEDUO_OK);
    assert_int_equal(progress_calls.inside_max, 1);
    assert_true(progress_calls.times > 1);
}

/* A thread without memory stops the others: only a few of 404 evaluations are made. */
TEST(one_failure_stops_all_threads)
{
    assert_int_equal(uncertainty_on_two_threads(8, fail_others), CEDUO_NO_MEMORY);
    assert_true(progress_calls.times < 100);
}

/* An uncertain input must exist in the scene. */
TEST(a_missing_place)
{
    static const char *const colour = "rock.colour";
    const struct ceduo_input input = {"rock.colour", CEDUO_INPUT_RANGE, 0, 1, .places_count = 1, .places = &colour};
    struct ceduo_uncertainty_def def = uncertainty_def(2, 8);
    def.inputs = &input;
    def.inputs_count = 1;
    assert_int_equal(ask_uncertainty(def), CEDUO_BAD_PLACE);
}

/* Enough points for all terms, but not for all products, so that inputs are ranked. The terms explain little, so that fewer are
 * tried. One input consists of calibration rows. */
static bool fit_surface(void)
{
    enum { INPUTS = 9, POINTS = 128, ROWS = 200, FIGURES = 2 };
    static double rows[ROWS], u[POINTS * INPUTS], values[FIGURES * POINTS];
    static struct ceduo_replicates y[FIGURES * POINTS], changes[FIGURES * POINTS];
    const double *const draws[] = {rows};
    struct ceduo_input surface_inputs[INPUTS] = {
        {.kind = CEDUO_INPUT_DRAWS, .places_count = 1, .draws_count = ROWS, .draws = draws}};
    for (size_t i = 1; i < INPUTS; i++)
        surface_inputs[i] = (struct ceduo_input){.kind = CEDUO_INPUT_RANGE, .hi = 1};
    for (size_t i = 0; i < ROWS; i++)
        rows[i] = (double)i;
    LOCAL(ceduo_surface, surface) = NULL;
    LOCAL_BY(ceduo_surface_release) struct ceduo_surface_fit fit = {0};
    enum ceduo_status status = ceduo_surface_points(1, POINTS, INPUTS, u);
    for (size_t i = 0; i < FIGURES * POINTS && status == CEDUO_OK; i++)
        for (size_t g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[i].value[g] = sin(40 * u[i % POINTS * INPUTS + i / POINTS]) + .1 * sin((double)(i * CEDUO_SURFACE_GROUPS + g));
    const struct ceduo_surface_figure figure = {.y = y, .lo = -INFINITY, .hi = INFINITY, .limit = NAN};
    if (status == CEDUO_OK)
        status = ceduo_surface_open(surface_inputs, INPUTS, u, POINTS, &surface);
    if (status == CEDUO_OK)
        status = ceduo_surface_fit(surface, &figure, &fit);
    if (status == CEDUO_OK)
        add(fit.values, POINTS * sizeof *fit.values);
    if (status == CEDUO_OK)
        status = ceduo_surface_values(surface, &figure, FIGURES, values, changes);
    if (status == CEDUO_OK)
        add(values, sizeof values);
    return is_done(status);
}

/* Copy a scene with uncertain shoots and with more belts than fit the arena's first page. */
static bool copy_belts(void)
{
    enum { MANY = 300 };
    static struct ceduo_belt belts[MANY];
    LOCAL_BY(ceduo_inputs_release) struct input_scene copy;
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    for (size_t i = 0; i < MANY; i++)
        belts[i] = site.belts[0];
    site.option.belts = belts;
    site.option.belts_count = MANY;
    static const char *const shoots = "forest[0].stand.shoots[0].per_ha";
    const struct ceduo_input of_shoots = {shoots, CEDUO_INPUT_FACTOR, .9, 1.1, .places_count = 1, .places = &shoots};
    enum ceduo_status status = ceduo_inputs_open(&copy, &site.scene, &of_shoots, 1);
    if (status == CEDUO_OK) {
        assert_ptr_not_equal(copy.scene.options[0].belts[MANY - 1].stand.shoots, belts[0].stand.shoots);
        add(&copy.scene.options[0].belts[MANY - 1].to, sizeof belts[0].to);
    }
    return is_done(status);
}

static bool answer_by_index(void)
{
    init(CEDUO_CONTACT_MODEL_INDEX, CEDUO_LAW_LUMPED);
    return answer_request(ceduo_request_default(&site.scene));
}

static bool answer_one_option(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_request q = ceduo_request_default(&site.scene);
    q.only = 0;
    return answer_request(q);
}

/* Assess the scene that was read. */
static bool assess(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    static struct ceduo_arrivals bare = {.released = 10, .reached = 10}, wooded = {.released = 10, .reached = 4};
    const struct ceduo_simulated flown[2] = {{.rocks = 10, .controls = 1, .arrivals = &bare},
                                             {.rocks = 10, .controls = 1, .arrivals = &wooded}};
    const struct ceduo_difference difference = {.reach = {-.6, .1, NAN, NAN}};
    LOCAL(ceduo_result, result);
    enum ceduo_status status = ceduo_result_assess(&site.scene, &flown[0], &(const struct ceduo_simulated *){&flown[1]},
                                                   &difference, &(const struct ceduo_alternative_energy){0}, &result);
    assert_int_equal(result != NULL, status == CEDUO_OK);
    if (is_done(status)) {
        assert_int_equal(result->bare.arrivals[0].reached, 10);
        assert_int_equal(ceduo_result_wooded(result, 0, 0)->reached, 4);
        add(&result->options[0].stands[0].adc_m, sizeof(double));
    }
    return status == CEDUO_OK;
}

/* Assess it by the index alone, without rocks among stems. */
static bool assess_index(void)
{
    init(CEDUO_CONTACT_MODEL_INDEX, CEDUO_LAW_LUMPED);
    static struct ceduo_arrivals bare = {.released = 10, .reached = 10};
    const struct ceduo_simulated flown = {.rocks = 10, .controls = 1, .arrivals = &bare};
    LOCAL(ceduo_result, result);
    enum ceduo_status status = ceduo_result_assess(&site.scene, &flown, NULL, NULL, NULL, &result);
    if (is_done(status)) {
        assert_null(ceduo_result_wooded(result, 0, 0));
        add(&result->options[0].controls[0].dissipated, sizeof(double));
    }
    return status == CEDUO_OK;
}

/* A rock rolls from stools of one shoot to stools of many, so that the buffer of shoots grows during the roll. */
static void make_roll(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    site.scene.slope.vertices = 2;
    site.x[1] = 160;
    site.z[1] = site.z[0] - 80;
    site.segments[0] = (struct ceduo_segment){ceduo_number(0), ceduo_number(1), NAN, 0, .1, .6};
    site.scene.release = (struct ceduo_release){.x = ceduo_number(1), .vx = ceduo_number(2), .vz = ceduo_number(-1)};
    for (int i = 0; i < 2; i++) {
        struct ceduo_stand *stand = &site.belts[i].stand;
        stand->stools_per_ha = 300;
        stand->shoots[0].per_ha = i == 0 ? 300 : 300 * 200;
        stand->trees_count = 0;
        stand->u = 1e-3; /* they take hardly any energy */
    }
}

static bool follow_seventh(struct ceduo_trajectory *trajectory)
{
    enum ceduo_status status = ceduo_trajectory_run(&site.scene, &site.option, 7, NULL, trajectory, NULL);
    if (status == CEDUO_OK)
        add(&trajectory->x, sizeof trajectory->x);
    return is_done(status);
}

static bool follow_roll(void)
{
    make_roll();
    struct ceduo_trajectory trajectory;
    bool done = follow_seventh(&trajectory);
    if (done) {
        assert_true(trajectory.end == CEDUO_END_LEFT_SLOPE && trajectory.stems_hit > 100);
        add(&trajectory.stems_hit, sizeof trajectory.stems_hit);
    }
    return done;
}

/* The same roll, recording all impacts. */
static bool record_roll(void)
{
    make_roll();
    LOCAL_BY(ceduo_record_release) struct ceduo_record record;
    enum ceduo_status status = ceduo_record(
        &(struct ceduo_record_def){
            .size = sizeof(struct ceduo_record_def), .scene = &site.scene, .option = &site.option, .rocks = 1, .blows = true},
        &record);
    if (is_done(status)) {
        assert_true(record.blows_count > 100);
        add(&record.blows_count, sizeof record.blows_count);
    }
    return status == CEDUO_OK;
}

static bool follow_one(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    struct ceduo_trajectory trajectory;
    return follow_seventh(&trajectory);
}

static bool follow(void)
{
    init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
    LOCAL(ceduo_tracer, f) = ceduo_tracer_create(&site.scene, &site.option);
    bool good = f;
    for (uint64_t rock = 0; rock < 3 && good; rock++) {
        struct ceduo_trajectory trajectory;
        struct ceduo_crossing crossing;
        good = is_done(ceduo_tracer_run(f, rock, NULL, &trajectory, &crossing));
        if (good)
            add(&trajectory.x, sizeof trajectory.x);
    }
    return good;
}

/* A pool, and the views of its runs; neither changes it. */
static struct ceduo_pool *viewed;

static bool see(void)
{
    const struct ceduo_snapshot_def def = {.scene = &site.scene, .runs = viewed, .envelope_rocks = 20, .trajectories = 3};
    LOCAL(ceduo_snapshot, o);
    if (!is_done(ceduo_snapshot_create(&def, &o))) {
        assert_null(o);
        return false;
    }
    const struct ceduo_run_snapshot *view = ceduo_snapshot_find(o, &site.scene, 0);
    add(view->energies[0].values, view->energies[0].n * sizeof(double));
    add(view->envelopes, o->cells * sizeof *view->envelopes);
    for (size_t i = 0; i < view->trajectories_count; i++)
        add(view->trajectories[i].x, view->trajectories[i].n * sizeof(double));
    return true;
}

TEST(views_of_runs)
{
    for (size_t sizes = 0; sizes < 2; sizes++) { /* one size, then all sizes */
        init(CEDUO_CONTACT_MODEL_STEMS, CEDUO_LAW_LUMPED);
        site.scene.blocks = &blocks;
        site.scene.blocks_count = sizes;
        struct ceduo_run_def def = ceduo_run_def_default(&site.scene);
        def.rocks_max = 40;
        assert_int_equal(ceduo_pool_create(&def, &viewed), CEDUO_OK);
        assert_int_equal(ceduo_pool_fill(viewed), CEDUO_OK);
        assert_int_equal(ceduo_pool_extend(viewed, 40), CEDUO_OK);
        without_memory(see);
        ceduo_pool_free(viewed);
    }
}

static enum ceduo_status falls(void *context, double value, double *goal)
{
    (void)context;
    *goal = 1 / value;
    return CEDUO_OK;
}

static bool find(void)
{
    const struct ceduo_find_def def = {.size = sizeof(struct ceduo_find_def), .lo = 1, .hi = 9, .target = 0.3, .goal = falls};
    struct ceduo_found f;
    bool done = is_done(ceduo_find(&def, &f));
    if (done)
        add(&f.value, sizeof f.value);
    assert_true(done || !f.found);
    return done;
}

TEST(runs_go_on)
{
    task *const tasks[] = {simulate_bare, simulate_blocks, simulate_long_profile, simulate_fine_profile,
                           simulate_scalar_forest};
    for (size_t i = 0; i < sizeof tasks / sizeof tasks[0]; i++)
        without_memory(tasks[i]);
}

TEST(results_built_on_runs)
{
    task *const tasks[] = {answer_options,
                           answer_block_years,
                           answer_by_index,
                           answer_both_laws,
                           uncertainty,
                           uncertainty_over_years,
                           sure,
                           copy_belts,
                           answer_one_option,
                           answer_independent_years,
                           assess,
                           assess_index,
                           follow,
                           follow_one,
                           follow_roll,
                           record_roll,
                           find,
                           fit_surface};
    for (size_t i = 0; i < sizeof tasks / sizeof tasks[0]; i++)
        without_memory(tasks[i]);
}
