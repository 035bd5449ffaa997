/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* The library with any struct that its headers allow: each number at, within or beyond its bounds, NaN or infinite, each word
 * beyond its list. It computes or refuses, and always ends. */
#include "core/runs/blocks.h"
#include "core/runs/result.h"
#include "core/runs/year_runs.h"
#include "expect.h"
#include "full.h"
#include "local.h"

#include <float.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "ceduo/ceduo.h"
#include "physics/paper_site.h"
#include "scene/schema.h"
#include "study/check_study.h"

#define ASKED   FULL_OR(100000, 6000)
#define SECONDS 20 /* per question; longer means it hangs */

static struct paper_site site;
static struct ceduo_stems shoots[2], trees[2];
static double stay[2][2];
static uint64_t state = 1;

static uint64_t draw(uint64_t n)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (state >> 33) % n;
}

static double any_number(const struct field *f)
{
    double lo = isfinite(f->lo) ? f->lo : -1e9, hi = isfinite(f->hi) ? f->hi : 1e9;
    const double numbers[] = {lo,     hi,    lo - 1, hi * 2 + 1, (lo + hi) / 2, lo + (hi - lo) * 1e-3, 0, -0., -1, 1,
                              1e-300, 1e300, NAN,    INFINITY,   -INFINITY};
    return numbers[draw(LENGTH(numbers))] * f->scale;
}

static void change_field(const struct field *f, char *item);

/* Change a member of an item, or of its content. */
static void change(const struct object *object, char *item)
{
    change_field(&object->fields[draw(object->n)], item);
}

static void change_field(const struct field *f, char *item)
{
    char *at = item + f->offset, *items;
    size_t n;
    uint64_t count;
    if (f->flags & (FIELD_NO_MEMBER | FIELD_FILE_ONLY))
        return;
    double number = any_number(f);
    struct ceduo_number spread = {number, draw(2) ? 0 : any_number(f), (enum ceduo_spread_kind)(draw(8) ? draw(2) : 77)};
    int word = f->choices ? (int)draw(f->choices->n + 3) - 2 : 0;
    switch (f->type) {
    case FIELD_NUMBER:
        memcpy(f->flags & FIELD_PLACE ? item + f->companion_offset : at, &number, sizeof number);
        break;
    case FIELD_SPREAD:
        memcpy(at, &spread, sizeof spread);
        break;
    case FIELD_COUNT:
        count = strcmp(f->key, "rocks") == 0 ? draw(50) : draw(2) ? draw(600) : UINT64_MAX;
        memcpy(at, f->size == sizeof(unsigned) ? (void *)&(unsigned){(unsigned)count} : &count, f->size);
        break;
    case FIELD_CHOICE:
        word = draw(8) ? word : 999;
        memcpy(at, &word, sizeof word);
        break;
    case FIELD_GROUP:
        change(f->object, at);
        break;
    case FIELD_NUMBERS:
    case FIELD_LIST:
        memcpy(&items, at, sizeof items);
        memcpy(&n, item + f->companion_offset, sizeof n);
        if (n > 0 && f->type == FIELD_LIST)
            change(f->object, items + draw(n) * f->object->size);
        else if (n > 0)
            memcpy(items + draw(n) * sizeof number, &number, sizeof number);
        break;
    default:
        break;
    }
}

static void open_site(void)
{
    memset(&site, 0, sizeof site);
    paper_site_init(&site);
    for (size_t i = 0; i < 2; i++) {
        shoots[i] = paper_stems(4000, .06, 7);
        trees[i] = paper_stems(100, .2, 14);
        stay[i][0] = stay[i][1] = 60;
        site.belts[i].stand = paper_coppice(&shoots[i], &trees[i], 1, 20, stay[i]);
    }
}

TEST(any_struct_is_refused_or_computed)
{
    uint64_t computed = 0, asked = (uint64_t)ASKED;
    for (uint64_t i = 0; i < asked; i++) {
        struct ceduo_request q;
        struct ceduo_results a;
        open_site();
        for (uint64_t k = 1 + draw(3); k > 0; k--)
            change(ceduo_schema_scene(), (char *)&site.scene);
        q = ceduo_request_default(&site.scene);
        q.rocks = 1 + draw(10);
        q.run.threads = 1;
        q.years = draw(4) == 0;
        q.year_rocks = 2;
        q.years_max = 5;
        alarm(SECONDS); /* ends the test */
        enum ceduo_status status = ceduo_simulate_request(&q, NULL, &a);
        alarm(0);
        if (status == CEDUO_OK) {
            double share = a.result->bare.arrivals[0].reach.mean;
            assert_true(isnan(share) || (share >= 0 && share <= 1));
            computed++;
        }
        EXPECT(status, !=, CEDUO_NO_MEMORY);
        ceduo_results_release(&a);
    }
    EXPECT(computed, >, asked / 4); /* and not all are refused */
    EXPECT(computed, <, asked * 9 / 10);
}

/* ---- counts ---- */

#define PICK(...) ((const uint64_t[]){__VA_ARGS__})[draw(sizeof((const uint64_t[]){__VA_ARGS__}) / sizeof(uint64_t))]

static const uint64_t beyond[] = {0, 1, 2, 3, 7, 1025, CEDUO_ROCKS_MAX + 1, 2000000000, UINT32_MAX, SIZE_MAX - 1, UINT64_MAX};

/* A small number, or in one of eight calls any larger one. */
static uint64_t any_count(uint64_t small)
{
    return draw(8) ? draw(small + 1) : beyond[draw(LENGTH(beyond))];
}

static unsigned any_threads(void)
{
    return draw(8) ? (unsigned)draw(4) : (unsigned)PICK(CEDUO_THREADS_MAX + 1, UINT32_MAX);
}

static struct ceduo_window any_window(void)
{
    struct ceduo_window w = {CEDUO_WINDOW_GIVEN, 1, 1, (unsigned)draw(3)};
    w.first = (unsigned)any_count(9);
    w.last = draw(8) ? w.first + (unsigned)draw(4) : (unsigned)any_count(9);
    return w;
}

/* Make lists shorter, or NULL with a count. */
static void change_counts(void)
{
    struct ceduo_scene *s = &site.scene;
    struct ceduo_stand *stand = &site.belts[draw(2)].stand;
    void *const lists[] = {&s->controls,   &s->options,   &s->options->belts,
                           &stand->shoots, &stand->trees, &stand->cutting.stay_per_ha};
    size_t *const counts[] = {&s->controls_count,   &s->options_count,   &s->options->belts_count,
                              &stand->shoots_count, &stand->trees_count, &stand->cutting.retained_count,
                              &s->blocks_count};
    size_t *count = counts[draw(LENGTH(counts))];
    void *missing = NULL;
    *count = *count > 0 && draw(2) ? draw(*count) : *count;
    if (draw(8) == 0)
        memcpy(lists[draw(LENGTH(lists))], &missing, sizeof missing);
    if (stand->trees && draw(8) == 0)
        stand->trees->per_ha = draw(2) ? DBL_MAX : 1e11;
}

static const char *places[] = {"rock.diameter_m", "simulation.threshold_m", "no.such",
                               "options[0].forest[0].stand.stools.per_ha"};

static struct ceduo_input any_input(void)
{
    static const int words[] = {0, 1};
    static const double row[] = {.5, .6, .7};
    static const double *const draws[] = {row, NULL};
    const double numbers[] = {.5, 1, 2, 0, -1, NAN, INFINITY, DBL_MAX};
    struct ceduo_input in = ceduo_input_default();
    in.kind = (enum ceduo_input_kind)(draw(12) ? draw(CEDUO_INPUT_DRAWS + 1) : 77);
    in.lo = numbers[draw(draw(4) ? 3 : LENGTH(numbers))];
    in.hi = numbers[draw(draw(4) ? 3 : LENGTH(numbers))];
    in.mean = numbers[draw(draw(4) ? 3 : LENGTH(numbers))];
    in.sd = numbers[draw(draw(4) ? 3 : LENGTH(numbers))];
    in.words_count = draw(4) ? 2 : 0;
    in.words = draw(8) ? words : NULL;
    in.draws_count = draw(4) ? 3 : 0;
    in.draws = draw(8) ? draws : NULL;
    in.places_count = draw(8) ? 1 : draw(2) ? 2 : 0;
    in.places = draw(16) ? &places[draw(16) ? 0 : draw(2) ? 1 : 2] : NULL;
    return in;
}

static enum ceduo_status ask_any(void)
{
    struct ceduo_request q = ceduo_request_default(&site.scene);
    struct ceduo_results a;
    q.run.scene = draw(64) ? &site.scene : NULL;
    q.rocks = any_count(8);
    q.run.rocks_max = any_count(8);
    q.run.threads = any_threads();
    q.run.kernel = (enum ceduo_kernel)any_count(3);
    q.run.arrivals_only = draw(2);
    q.only = draw(2) ? CEDUO_ALL_OPTIONS : any_count(1);
    q.window = any_window();
    q.years = draw(3) == 0;
    q.rotations = draw(6) == 0;
    q.years_independent = draw(2);
    q.years_max = draw(2) ? 3 : (unsigned)any_count(4);
    q.year_rocks = 1 + draw(2);
    q.block_rocks = draw(4) ? 0 : any_count(5);
    q.tolerance = draw(4) ? 0 : .5;
    enum ceduo_status status = ceduo_simulate_request(&q, NULL, &a);
    for (size_t i = 0; status == CEDUO_OK && i < 2; i++) /* indices out of range */
        ceduo_result_wooded(a.result, any_count(1), any_count(1));
    ceduo_results_release(&a);
    return status;
}

static enum ceduo_status ask_any_uncertainty(void)
{
    struct ceduo_input inputs[2] = {any_input(), any_input()};
    struct ceduo_uncertainty_def def =
        draw(8) ? ceduo_uncertainty_def_default(&site.scene)
                : (struct ceduo_uncertainty_def){.size = sizeof(struct ceduo_uncertainty_def), .scene = &site.scene};
    struct ceduo_uncertainty_result a;
    def.inputs = draw(32) ? inputs : NULL;
    def.inputs_count = draw(16) ? 1 + draw(2) : 0;
    def.points = draw(8) ? 2 + draw(4) : any_count(4);
    def.points_max = draw(8) ? def.points : any_count(4);
    def.rocks = any_count(20);
    def.own_rocks = any_count(20);
    def.threads = any_threads();
    def.rotation = draw(4) == 0;
    def.years_max = draw(4) ? 2 : any_count(3);
    def.window = any_window();
    def.brief = draw(2);
    def.one_option = draw(3) == 0;
    def.option = any_count(1);
    enum ceduo_status status = ceduo_uncertainty_compute(&def, &a);
    if (status == CEDUO_OK)
        ceduo_uncertainty_release(&a);
    return status;
}

static enum ceduo_status ask_any_other(void)
{
    struct ceduo_size_result blocks[CEDUO_SIZES];
    struct ceduo_record record;
    struct ceduo_yield yield;
    struct ceduo_years *years = NULL;
    struct ceduo_survey survey = {.plots_count = any_count(1), .areas = draw(8) ? (const double[]){100, NAN} : NULL};
    struct ceduo_survey_stem stem = {.plot = any_count(1),
                                     .species = (int)draw(4) - 2,
                                     .stool = any_count(1),
                                     .dbh = .2,
                                     .height = NAN,
                                     .spacing = NAN,
                                     .energy = NAN,
                                     .kind = (enum ceduo_survey_kind)any_count(3)};
    struct ceduo_survey_result answer;
    enum ceduo_status status = CEDUO_OK;
    struct ceduo_sizes_def sizes = ceduo_sizes_def_default(&site.scene);
    struct ceduo_record_def followed = ceduo_record_def_default(&site.scene);
    switch (draw(5)) {
    case 0:
        sizes.control = any_count(1);
        sizes.rocks = any_count(8);
        sizes.threads = any_threads();
        return ceduo_sizes_simulate(&sizes, blocks);
    case 1:
        followed.rocks = any_count(8);
        followed.stretches_count = draw(4) ? 0 : any_count(2);
        status = ceduo_record(&followed, &record);
        ceduo_record_release(&record);
        return status;
    case 2:
        status = ceduo_yield_compute(&site.option, (unsigned)any_count(50), &yield);
        ceduo_yield_release(&yield);
        return status;
    case 3:
        status = ceduo_years_create(&site.scene, &site.option, any_window(), &years);
        if (status == CEDUO_OK)
            ceduo_years_summarize(years, any_count(1));
        ceduo_years_free(years);
        return status;
    default:
        survey.stools_count = any_count(1);
        survey.stems_count = draw(4) ? 1 : 0;
        survey.stems = draw(8) ? &stem : NULL;
        status = ceduo_survey_compute(&survey, &answer);
        if (status == CEDUO_OK)
            ceduo_survey_release(&answer);
        return status;
    }
}

/* Few by default; 10^5 with FULL. */
TEST(any_question_is_refused_or_computed)
{
    uint64_t asked = (uint64_t)FULL_OR(100000, 2000), computed = 0, refused = 0;
    for (uint64_t i = 0; i < asked; i++) {
        open_site();
        if (draw(3) == 0)
            change(ceduo_schema_scene(), (char *)&site.scene);
        if (draw(2))
            change_counts();
        alarm(SECONDS);
        enum ceduo_status status = draw(8) == 0 ? ask_any_uncertainty() : draw(3) == 0 ? ask_any_other() : ask_any();
        alarm(0);
        EXPECT(status, !=, CEDUO_NO_MEMORY);
        EXPECT(status, !=, CEDUO_CANCELLED);
        computed += status == CEDUO_OK;
        refused += status == CEDUO_BAD_ARGUMENT;
    }
    EXPECT(computed, >, asked / 10);
    EXPECT(refused, >, asked / 10);
}

/* Change one argument of a valid question at a time. */
TEST(each_bad_argument_is_refused)
{
    open_site();
    struct ceduo_request q = ceduo_request_default(&site.scene);
    q.rocks = q.run.rocks_max = 10;
    struct ceduo_results a;
#define REFUSED(member, value)                                                                                                 \
    do {                                                                                                                       \
        struct ceduo_request bad = q;                                                                                          \
        bad.member = value;                                                                                                    \
        EXPECT(ceduo_simulate_request(&bad, NULL, &a), ==, CEDUO_BAD_ARGUMENT);                                                \
    } while (0)
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    ceduo_results_release(&a);
    REFUSED(only, site.scene.options_count);
    REFUSED(rocks, CEDUO_ROCKS_MAX + 1);
    REFUSED(run.rocks_max, UINT64_MAX);
    REFUSED(run.scene, NULL);
    REFUSED(run.threads, UINT32_MAX);
    REFUSED(run.kernel, (enum ceduo_kernel)9);
    REFUSED(window, ((struct ceduo_window){CEDUO_WINDOW_GIVEN, 1, 2000000000, 1}));
    REFUSED(window, ((struct ceduo_window){CEDUO_WINDOW_GIVEN, 2, 1, 1}));
    REFUSED(window, ((struct ceduo_window){CEDUO_WINDOW_GIVEN, 1, 1 + CEDUO_YEARS_MAX, 1}));
    site.belts[0].stand.trees->per_ha = DBL_MAX;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_BAD_STAND);
    open_site();
    site.belts[0].stand.cutting.stay_per_ha = NULL;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_BAD_STAND);
    struct ceduo_years *years;
    EXPECT(ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.last = 5, .step = 1}, &years), ==,
           CEDUO_BAD_STAND);
    open_site();
    EXPECT(ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.last = 5}, &years), ==, CEDUO_BAD_ARGUMENT);
    struct ceduo_input input = ceduo_input_default();
    const char *place = "rock.diameter_m";
    input.lo = .5;
    input.places = &place;
    input.places_count = 1;
    struct ceduo_uncertainty_def def = ceduo_uncertainty_def_default(&site.scene), bad;
    struct ceduo_uncertainty_result uncertainty;
    def.inputs = &input;
    def.inputs_count = 1;
    def.points = def.points_max = 4;
    def.rocks = 20;
    def.threads = 0; /* means 1 */
    EXPECT(ceduo_uncertainty_compute(&def, &uncertainty), ==, CEDUO_OK);
    EXPECT(uncertainty.points, ==, 4);
    ceduo_uncertainty_release(&uncertainty);
    bad = def, bad.one_option = true, bad.option = 9;
    EXPECT(ceduo_uncertainty_compute(&bad, &uncertainty), ==, CEDUO_BAD_ARGUMENT);
    bad = def, bad.years_max = 1000;
    EXPECT(ceduo_uncertainty_compute(&bad, &uncertainty), ==, CEDUO_BAD_ARGUMENT);
    place = "controls[3].accepted_kJ";
    EXPECT(ceduo_uncertainty_compute(&def, &uncertainty), ==, CEDUO_BAD_PLACE);
    input.kind = CEDUO_INPUT_WORDS;
    EXPECT(ceduo_uncertainty_compute(&def, &uncertainty), ==, CEDUO_BAD_ARGUMENT);
    input.kind = CEDUO_INPUT_DRAWS;
    EXPECT(ceduo_uncertainty_compute(&def, &uncertainty), ==, CEDUO_BAD_ARGUMENT);
    struct ceduo_calibration fit;
    struct ceduo_calibration_def how = ceduo_calibration_def_default();
    struct ceduo_calibration_scene fitted = {.scene = &site.scene, .inputs = &input};
    EXPECT(ceduo_calibrate(&how, &fit), ==, CEDUO_BAD_ARGUMENT);
    how.scenes = &fitted;
    how.scenes_count = 1;
    how.parameters_count = CEDUO_CALIBRATION_MAX + 1;
    EXPECT(ceduo_calibrate(&how, &fit), ==, CEDUO_BAD_ARGUMENT);
    struct ceduo_sizes_def sizes = ceduo_sizes_def_default(&site.scene);
    struct ceduo_size_result blocks[CEDUO_SIZES];
    sizes.control = 7;
    EXPECT(ceduo_sizes_simulate(&sizes, blocks), ==, CEDUO_BAD_ARGUMENT);
    struct ceduo_found found;
    const struct ceduo_find_def search = ceduo_find_def_default(); /* without a goal */
    EXPECT(ceduo_find(&search, &found), ==, CEDUO_BAD_ARGUMENT);
    EXPECT(ceduo_rock_def_default().density.mean, >, 0);
    assert_true(isnan(ceduo_observation_default().x) && isnan(ceduo_rock_def_default().diameter.mean));
}

#define REFUSED_BY(call, place, value)                                                                                         \
    do {                                                                                                                       \
        __typeof__(place) was = place;                                                                                         \
        place = value;                                                                                                         \
        EXPECT(call, ==, CEDUO_BAD_ARGUMENT);                                                                                  \
        place = was;                                                                                                           \
    } while (0)

/* Change one member of a valid calibration at a time, in its scene, its input and its observation. */
TEST(each_bad_member_of_a_calibration_is_refused)
{
    open_site();
    const char *place = "rock.diameter_m";
    double values[] = {1, 2};
    struct ceduo_input input = {
        .path = place, .kind = CEDUO_INPUT_RANGE, .lo = .5, .hi = 1, .places_count = 1, .places = &place};
    struct ceduo_observation observed = ceduo_observation_default();
    struct ceduo_calibration_scene fitted = {&site.scene, &input, 1, &observed};
    struct ceduo_calibration_def def = ceduo_calibration_def_default();
    struct ceduo_calibration fit;
    input.mean = input.sd = .5; /* valid for any distribution */
    observed.n = 2;
    observed.values = values;
    def.scenes = &fitted;
    def.scenes_count = def.parameters_count = 1;
#define REFUSED_FIT(place, value) REFUSED_BY(ceduo_calibrate(&def, &fit), place, value)
    EXPECT(ceduo_check_calibration_def(&def), ==, CEDUO_OK);
    REFUSED_FIT(def.scenes_count, 0);
    REFUSED_FIT(def.parameters_count, 0);
    REFUSED_FIT(def.rocks, 0);
    REFUSED_FIT(def.rocks, CEDUO_ROCKS_MAX + 1);
    REFUSED_FIT(def.threads, CEDUO_THREADS_MAX + 1);
    REFUSED_FIT(def.steps_max, CEDUO_CALIBRATION_STEPS + 1);
    REFUSED_FIT(fitted.inputs, NULL);
    REFUSED_FIT(fitted.observations, NULL);
    REFUSED_FIT(site.scene.options_count, 0);
    REFUSED_FIT(input.kind, CEDUO_INPUT_GAMMA);
    REFUSED_FIT(input.hi, input.lo);
    REFUSED_FIT(input.hi, NAN);
    REFUSED_FIT(observed.kind, CEDUO_OBSERVED_KINDS);
    REFUSED_FIT(observed.option, 1);
    REFUSED_FIT(observed.n, 0);
    REFUSED_FIT(values[0], NAN);
    observed.kind = CEDUO_OBSERVED_PASSED;
    REFUSED_FIT(observed.count, 1); /* none was released */
    site.scene.slope.vertices = 1;
    EXPECT(ceduo_calibrate(&def, &fit), ==, CEDUO_BAD_SLOPE);
}

/* Results of the scene as given must cover each option, and its years unless the contact model has none. */
TEST(own_results_cover_all_options)
{
    open_site();
    struct ceduo_input input = ceduo_input_default(); /* without places */
    struct ceduo_uncertainty_def def = ceduo_uncertainty_def_default(&site.scene);
    struct ceduo_uncertainty_result a;
    struct ceduo_years *years = NULL;
    struct ceduo_result result = {.options_count = site.scene.options_count};
    struct ceduo_results own = {.result = &result, .years_count = result.options_count};
    site.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    def.inputs = &input;
    def.inputs_count = 1;
    def.own = &own;
    def.brief = true;
#define REFUSED_OWN(place, value) REFUSED_BY(ceduo_uncertainty_compute(&def, &a), place, value)
    EXPECT(ceduo_check_uncertainty_def(&def), ==, CEDUO_OK);
    REFUSED_OWN(def.brief, false);
    REFUSED_OWN(own.result, NULL);
    REFUSED_OWN(result.options_count, result.options_count + 1);
    REFUSED_OWN(def.rotation, true);
    def.rotation = true;
    site.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    EXPECT(ceduo_check_uncertainty_def(&def), ==, CEDUO_OK);
    site.scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    own.years = &years;
    EXPECT(ceduo_uncertainty_compute(&def, &a), ==, CEDUO_BAD_ARGUMENT);
    EXPECT(ceduo_years_create(&site.scene, &site.option, (struct ceduo_window){.last = 1, .step = 1}, &years), ==, CEDUO_OK);
    EXPECT(ceduo_check_uncertainty_def(&def), ==, CEDUO_OK);
    REFUSED_OWN(own.years_count, 0);
    REFUSED_OWN(result.options_count, 0);
    ceduo_years_free(years);
    EXPECT(ceduo_check_inputs(NULL, 0, true), ==, CEDUO_OK);
    EXPECT(ceduo_check_inputs(NULL, 1, true), ==, CEDUO_BAD_ARGUMENT);
}

/* NULL lists with a count. */
TEST(missing_lists_are_refused)
{
    open_site();
    double volumes[] = {1, 2};
    struct ceduo_size_class blocks = {.per_year = 1, .exponent = 1, .volumes_count = 2, .volumes = volumes};
    struct ceduo_scene *s = &site.scene;
    s->blocks = &blocks;
    s->blocks_count = 1;
    assert_int_equal(ceduo_scene_check(s, NULL), CEDUO_OK);
    struct ceduo_release releases[] = {s->release};
    releases[0].share = 1;
    s->releases = releases;
    s->releases_count = 1;
    struct ceduo_stand *stand = &site.belts[0].stand;
    void *const pointers[] = {&blocks.volumes,      &s->blocks,     &s->releases,  &s->controls,
                              &s->options,          &s->slope.x,    &s->slope.z,   &s->slope.segments,
                              &s->options[0].belts, &stand->shoots, &stand->trees, &stand->cutting.stay_per_ha};
    for (size_t i = 0; i < LENGTH(pointers); i++) {
        void *was, *missing = NULL;
        memcpy(&was, pointers[i], sizeof was);
        memcpy(pointers[i], &missing, sizeof missing);
        EXPECT(ceduo_scene_check(s, NULL), !=, CEDUO_OK);
        memcpy(pointers[i], &was, sizeof was);
        EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_OK);
    }
    s->year_first = 24;
    s->year_last = NAN; /* not given */
    EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_OK);
    s->year_last = 4; /* before the first */
    EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_BAD_ARGUMENT);
    s->year_last = 24;
    EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_OK);
    blocks.volumes = NULL;
    EXPECT(ceduo_scene_check(s, NULL), ==, CEDUO_BAD_ROCK);
}

TEST(the_requested_number_of_rocks)
{
    open_site();
    struct ceduo_request q = ceduo_request_default(&site.scene);
    struct ceduo_results a;
    q.rocks = 5000;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    EXPECT(ceduo_result_rocks(a.result), ==, 5000);
    EXPECT(ceduo_result_last_index(a.result, 0)->contacts, >, 0);
    assert_null(ceduo_result_last_index(a.result, 1)); /* the scene has one option */
    ceduo_results_release(&a);
    site.scene.controls_count = 0;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    assert_null(ceduo_result_last_index(a.result, 0));
    ceduo_results_release(&a);
}
