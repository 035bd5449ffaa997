/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The library in a foreign program: scenes read from files, defaults, texts, and GSL errors, whose default handler would
 * abort. */
#include "core/runs/key.h"
#include "expect.h"
#include "study/naslund.h"
#include "study/surface.h"

#include <gsl/gsl_errno.h>
#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/gsl_errors.h"
#include "base/text.h"
#include "ceduo/ceduo.h"
#include "folder.h"
#include "study/surrogate.h"

/* ---- allocations of GSL ---- */

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ /* these have their own */
#define FAILS 0
#else
#define FAILS 1
#endif
static _Thread_local long fail_at; /* 0: none */

#if FAILS
void *__libc_malloc(size_t n);
void *__libc_calloc(size_t n, size_t size);

/* Replaces the C library's malloc for GSL as well, which `--wrap` of the linker would not reach. */
void *malloc(size_t n)
{
    return fail_at > 0 && --fail_at == 0 ? NULL : __libc_malloc(n);
}

void *calloc(size_t n, size_t size)
{
    return fail_at > 0 && --fail_at == 0 ? NULL : __libc_calloc(n, size);
}
#endif

static int heard; /* errors passed to the caller's handler */

static void on_error(const char *reason, const char *file, int line, int error)
{
    (void)reason, (void)file, (void)line, (void)error;
    heard++;
}

static gsl_error_handler_t *handler(void)
{
    gsl_error_handler_t *now = gsl_set_error_handler(NULL);
    gsl_set_error_handler(now);
    return now;
}

static enum ceduo_status fit_heights(void)
{
    double dbh[] = {.05, .08, .12, .15, .2, .25, .3}, height[] = {5, 7, 9, 10.5, 12, 13.5, 14};
    struct ceduo_naslund curve;
    return ceduo_naslund_fit(LENGTH(dbh), dbh, height, &curve);
}

static enum ceduo_status lay_points(void)
{
    double u[64 * 3];
    return ceduo_surface_points(1, 64, 3, u);
}

static enum ceduo_status learn(void)
{
    enum { PLACES = 40 };
    double u[PLACES], values[PLACES];
    GSL_RETURNS_ERRORS;
    for (int i = 0; i < PLACES; i++) {
        u[i] = (i + .5) / PLACES;
        values[i] = -10 * (u[i] - .4) * (u[i] - .4);
    }
    struct surrogate g = ceduo_surrogate_begin(1);
    enum ceduo_status status = ceduo_surrogate_train(&g, u, values, PLACES, NULL);
    ceduo_surrogate_free(&g);
    return status;
}

static enum ceduo_status fit_surface(void)
{
    enum { POINTS = 16 };
    struct ceduo_input input = {.kind = CEDUO_INPUT_RANGE, .hi = 1};
    struct ceduo_surface_fit fit;
    struct ceduo_surface *surface;
    static struct ceduo_replicates y[POINTS];
    double u[POINTS];
    for (int p = 0; p < POINTS; p++) {
        u[p] = (p + .5) / POINTS;
        for (int g = 0; g < CEDUO_SURFACE_GROUPS; g++)
            y[p].value[g] = u[p] * u[p] + g;
    }
    enum ceduo_status status = ceduo_surface_open(&input, 1, u, POINTS, &surface);
    if (status != CEDUO_OK)
        return status;
    status = ceduo_surface_fit(surface, &(const struct ceduo_surface_figure){y, NULL, 0, 100, NAN}, &fit);
    ceduo_surface_free(surface);
    if (status == CEDUO_OK)
        ceduo_surface_release(&fit);
    return status;
}

/* Fail each allocation of a call in turn. */
static void call_without_memory(enum ceduo_status (*call)(void))
{
    long at = 1, failed = 0;
    gsl_set_error_handler(NULL); /* GSL's default, which aborts */
    for (bool all = false; FAILS && !all; at++) {
        fail_at = at;
        enum ceduo_status status = call();
        all = fail_at > 0; /* fewer allocations than that */
        fail_at = 0;
        assert_true(status == CEDUO_NO_MEMORY || status == CEDUO_OK);
        failed += status == CEDUO_NO_MEMORY;
        assert_true(handler() == NULL);
    }
    EXPECT(failed, >=, FAILS);
    EXPECT(call(), ==, CEDUO_OK);
}

TEST(gsl_without_memory_does_not_abort)
{
    ROWS(call_without_memory, (fit_heights), (lay_points), (learn), (fit_surface));
}

static void *err(void *unused)
{
    gsl_error("test", __FILE__, __LINE__, GSL_EFAILED);
    return unused;
}

/* A handler set during a call stays after it. */
TEST(a_handler_set_during_a_call_stays)
{
    gsl_set_error_handler(NULL);
    bool before = ceduo_gsl_enter();
    gsl_set_error_handler(on_error);
    ceduo_gsl_leave(&before);
    assert_true(handler() == on_error);
}

static int without_memory(void *unused)
{
    (void)unused;
    gsl_error("test", __FILE__, __LINE__, GSL_ENOMEM);
    return GSL_SUCCESS;
}

TEST(a_gsl_call_without_memory_returns)
{
    assert_int_equal(ceduo_gsl_try(without_memory, NULL), GSL_ENOMEM);
}

/* In a thread outside the library, while another is inside. */
TEST(errors_of_the_caller_reach_its_handler)
{
    pthread_t thread;
    gsl_set_error_handler(on_error);
    heard = 0;
    bool before = ceduo_gsl_enter(), inner = ceduo_gsl_enter();
    err(NULL);
    EXPECT(heard, ==, 0);
    assert_int_equal(pthread_create(&thread, NULL, err, NULL), 0);
    pthread_join(thread, NULL);
    EXPECT(heard, ==, 1);
    ceduo_gsl_leave(&inner);
    err(NULL);
    EXPECT(heard, ==, 1);
    ceduo_gsl_leave(&before);
    assert_true(handler() == on_error);
    err(NULL);
    EXPECT(heard, ==, 2);
}

/* Without a handler of its own GSL aborts, as without the library. */
TEST(without_a_handler_gsl_aborts_the_caller)
{
    pid_t child = fork();
    if (child == 0) {
        pthread_t thread;
        close(STDERR_FILENO);
        gsl_set_error_handler(NULL);
        ceduo_gsl_enter();
        if (pthread_create(&thread, NULL, err, NULL) == 0)
            pthread_join(thread, NULL);
        _exit(0);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
}

/* ---- reading ---- */

static const char scene[] = "ceduo: scene/1\ntitle: mill\nrock: {shape: sphere, diameter_m: 1}\n"
                            "slope: {vertices_m: [[0, 100], [100, 20]], segments: [{rn: 0.3, rt: 0.8, roughness_rad: 0.1}]}\n"
                            "controls_m: [90]\nforest: []\n";

TEST(a_scene_is_read)
{
    struct ceduo_scene_file r;
    EXPECT(ceduo_scene_read("profiles/scenes/paper-site.yaml", NULL, &r), ==, CEDUO_OK);
    assert_string_equal(r.messages, "");
    EXPECT(r.scene.controls[0].x, ==, 135);
    EXPECT(r.scene.options[0].belts[0].stand.stools_per_ha, ==, 3688); /* Ciabocco et al. 2009, ADS 1 */
    EXPECT(ceduo_scene_check(&r.scene, NULL), ==, CEDUO_OK);
    ceduo_scene_file_release(&r);
    ceduo_scene_file_release(&r);
    const char *const sets[] = {"rock.diameter_m=1", "rock.diameter_m=2", NULL};
    EXPECT(ceduo_scene_read("profiles/scenes/paper-site.yaml", sets, &r), ==, CEDUO_OK);
    EXPECT(r.scene.rock.diameter.mean, ==, 2);
    ceduo_scene_file_release(&r);
    EXPECT(ceduo_scene_read_text("mill.yaml", scene, &r), ==, CEDUO_OK);
    assert_string_equal(r.scene.title, "mill");
    EXPECT(r.scene.slope.z[1], ==, -80);
    ceduo_scene_file_release(&r);
}

/* JSON writes characters above U+FFFF as surrogate pairs. Later positions are those of the file. */
static void expect_title(const char *text, const char *title)
{
    struct ceduo_scene_file r;
    char whole[600];
    const char *const rest = "rock: {shape: sphere, diameter_m: 1}\nslope: {vertices_m: [[0, 100], [100, 20]], segments: "
                             "[{rn: 0.3, rt: 0.8, roughness_rad: 0.1}]}\ncontrols_m: [90]\nforest: []\n";
    snprintf(whole, sizeof whole, "ceduo: scene/1\ntitle: %s\n%s", text, rest);
    EXPECT(ceduo_scene_read_text("mill.yaml", whole, &r), ==, title ? CEDUO_OK : CEDUO_BAD_FILE);
    if (title)
        assert_string_equal(r.scene.title, title);
    ceduo_scene_file_release(&r);
}

TEST(halves_of_a_character_are_joined)
{
    struct ceduo_scene_file r;
    expect_title("\"a \\ud83d\\ude00 b\"", "a \xf0\x9f\x98\x80 b");
    expect_title("\"\\uD83D\\uDE00\\ud83d\\ude01\"", "\xf0\x9f\x98\x80\xf0\x9f\x98\x81");
    expect_title("\"\\u00e0 \\U0001f600\" # it's \"x", "\xc3\xa0 \xf0\x9f\x98\x80");
    expect_title("\"\\ud83d\\ude00\" # it's \"x", "\xf0\x9f\x98\x80");
    expect_title("'\\ud83d\\ude00'", "\\ud83d\\ude00");
    expect_title("'it''s \"\\ud83d\\ude00'", "it's \"\\ud83d\\ude00");
    expect_title("it's \\ud83d\\ude00", "it's \\ud83d\\ude00");
    expect_title("\"\\\\ud83d\\\\ude00\"", "\\ud83d\\ude00");
    expect_title("\"\\ud83d x\"", NULL);
    expect_title("\"\\ude00\\ud83d\"", NULL);
    const char json[] = "{\"ceduo\":\"scene/1\",\"title\":\"\\ud83d\\ude00\\ud83d\\ude00\",\"rock\":{\"diameter_m\":-1}}";
    char place[64];
    snprintf(place, sizeof place, "mill.json:1:%d: rock.diameter_m: -1", (int)(strstr(json, "-1") - json) + 1);
    EXPECT(ceduo_scene_read_text("mill.json", json, &r), ==, CEDUO_BAD_FILE);
    assert_non_null(strstr(r.messages, place));
    ceduo_scene_file_release(&r);
}

TEST(errors_are_reported)
{
    struct ceduo_scene_file r;
    EXPECT(ceduo_scene_read_text("mill.yaml", "ceduo: scene/1\nrock: {shape: sphere, diameter_m: -1}\n", &r), ==,
           CEDUO_BAD_FILE);
    assert_ptr_equal(strstr(r.messages, "mill.yaml:2:35: rock.diameter_m: -1 is "), r.messages);
    assert_non_null(strstr(r.messages, "\n  rock: {shape: sphere, diameter_m: -1}\n"));
    assert_null(r.scene.slope.x);
    ceduo_scene_file_release(&r);
    EXPECT(ceduo_scene_read("no/such.yaml", NULL, &r), ==, CEDUO_BAD_FILE);
    assert_non_null(strstr(r.messages, "no/such.yaml"));
    ceduo_scene_file_release(&r);
    const char *const sets[] = {"rock.colour=red", NULL};
    EXPECT(ceduo_scene_read("profiles/scenes/paper-site.yaml", sets, &r), ==, CEDUO_BAD_FILE);
    assert_non_null(strstr(r.messages, "--set"));
    ceduo_scene_file_release(&r);
}

static enum ceduo_status read_in_folder(void)
{
    char path[256];
    struct ceduo_scene_file r;
    in_folder(path, "scene.yaml");
    enum ceduo_status status = ceduo_scene_read(path, NULL, &r);
    if (status == CEDUO_OK)
        EXPECT(r.scene.slope.z[1], ==, -90);
    else if (status != CEDUO_NO_MEMORY)
        fail_msg("%s", r.messages);
    ceduo_scene_file_release(&r);
    return status;
}

/* In any library, including the one that decodes old spreadsheets. */
TEST_WITH(a_scene_is_read_without_memory, folder_set_up, folder_tear_down)
{
    char line[18000]; /* longer than an arena page */
    snprintf(line, sizeof line, "Profil%17000s\nEntfernung;H\xf6he\n0;90\n100;0\n", "");
    folder_write("line.csv", line);
    folder_write("scene.yaml", "ceduo: scene/1\nrock: {diameter_m: 1}\nslope: line.csv\ncontrols_m: [90]\n");
    call_without_memory(read_in_folder);
}

/* ---- locale of the host program ---- */

/* Set a locale with a decimal comma; compile it in the test's folder if it is missing. */
static bool set_comma(const char *name)
{
    char command[256], full[32];
    snprintf(full, sizeof full, "%s.UTF-8", name);
    if (!setlocale(LC_ALL, full)) {
        snprintf(command, sizeof command, "localedef -i %s -f UTF-8 %s/%s >/dev/null 2>&1", name, folder, full);
        if (system(command) != 0) /* NOLINT(cert-env33-c): a fixed command */
            return false;
        setenv("LOCPATH", folder, 1);
        bool set = setlocale(LC_ALL, full);
        unsetenv("LOCPATH");
        if (!set)
            return false;
    }
    return localeconv()->decimal_point[0] == ',';
}

/* Results of a scene with numbers from a table, from YAML, from a change and from defaults, of its run, and the printed
 * text. */
struct figures {
    double gravity, friction, rn, rt, diameter, z, control, default_gravity, default_friction;
    double reach, energy, speed;
    uint64_t key;
    char message[512], number[32], text[32];
};

static struct figures read_figures(void)
{
    struct ceduo_scene_file r;
    struct ceduo_results a;
    char path[256];
    const char *const sets[] = {"rock.diameter_m=0.75", NULL};
    in_folder(path, "scene.yaml");
    EXPECT(ceduo_scene_read(path, sets, &r), ==, CEDUO_OK);
    const struct ceduo_scene *s = &r.scene;
    struct figures f = {.gravity = s->simulation.gravity,
                        .friction = s->slope.segments[0].friction,
                        .rn = s->slope.segments[0].rn.mean,
                        .rt = s->slope.segments[0].rt.mean,
                        .diameter = s->rock.diameter.mean,
                        .z = s->slope.z[1],
                        .control = s->controls[0].x,
                        .default_gravity = ceduo_scene_default().simulation.gravity,
                        .default_friction = ceduo_segment_default().friction,
                        .key = ceduo_scene_key(s)};
    struct ceduo_request q = ceduo_request_default(s);
    q.rocks = 300;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    f.reach = a.result->bare.arrivals[0].reach.mean;
    f.energy = a.result->bare.arrivals[0].energy.mean;
    f.speed = a.result->bare.arrivals[0].speed.p95;
    ceduo_results_release(&a);
    ceduo_scene_file_release(&r);
    EXPECT(ceduo_scene_read_text("mill.yaml", "ceduo: scene/1\nrock: {diameter_m: -1.5}\n", &r), ==, CEDUO_BAD_FILE);
    snprintf(f.message, sizeof f.message, "%s", r.messages);
    ceduo_scene_file_release(&r);
    ceduo_number_shortest(0.1, f.number);
    LOCAL_TEXT(text);
    ceduo_text_format(&text, "%.2f %g", 1.5, 2.25);
    snprintf(f.text, sizeof f.text, "%s", ceduo_text_string(&text));
    return f;
}

static void compare_figures(const struct figures *was, const char *locale)
{
    if (!set_comma(locale)) {
        setlocale(LC_ALL, "C");
        print_message("no locale %s, and localedef cannot make it\n", locale);
        skip();
    }
    struct figures after = read_figures();
    assert_string_equal(setlocale(LC_NUMERIC, NULL) + 5, ".UTF-8"); /* unchanged */
    double comma = strtod("1,5", NULL);
    setlocale(LC_ALL, "C");
    EXPECT(comma, ==, 1.5);
    EXPECT_SAME(after, *was, gravity, friction, rn, rt, diameter, z, control, default_gravity, default_friction);
    EXPECT_SAME(after, *was, reach, energy, speed, key);
    assert_string_equal(after.message, was->message);
    assert_string_equal(after.number, was->number);
    assert_string_equal(after.text, was->text);
}

TEST_WITH(numbers_have_a_dot_in_every_locale, folder_set_up, folder_tear_down)
{
    folder_write("line.csv", "x_m,z_m\n0,90.5\n60.25,40.5\n100,0\n");
    folder_write("scene.yaml", "ceduo: scene/1\nrock: {diameter_m: 1}\ncontrols_m: [90.5]\n"
                               "slope: {csv: line.csv, segments: [{rn: 0.35, rt: 0.85, roughness_rad: 0.1}]}\n");
    const struct figures was = read_figures();
    ROWS(EXPECT, (was.gravity, ==, 9.81), (was.rn, ==, .35), (was.diameter, ==, .75), (was.z, ==, -50),
         (was.control, ==, 90.5));
    EXPECT(was.default_friction, >, 0);
    assert_string_equal(was.number, "0.1");
    assert_string_equal(was.text, "1.50 2.25");
    compare_figures(&was, "it_IT");
    compare_figures(&was, "de_DE");
}

/* ---- callbacks and random numbers ---- */

static atomic_int inside, most_inside, calls;

static void enter_callback(void)
{
    int now = atomic_fetch_add(&inside, 1) + 1;
    if (now > atomic_load(&most_inside))
        atomic_store(&most_inside, now);
    atomic_fetch_add(&calls, 1);
    usleep(2000); /* so that another thread would interfere */
    atomic_fetch_sub(&inside, 1);
}

static void on_rocks(void *unused, uint64_t rocks)
{
    (void)unused, (void)rocks;
    enter_callback();
}

static void on_points(void *unused, uint64_t done, uint64_t all)
{
    (void)unused, (void)done, (void)all;
    enter_callback();
}

static void on_fit(void *unused, const struct ceduo_calibration_state *state)
{
    (void)unused, (void)state;
    enter_callback();
}

static void expect_alone(void)
{
    int called = atomic_exchange(&calls, 0), threads = atomic_exchange(&most_inside, 0);
    EXPECT(called, >, 0);
    EXPECT(threads, ==, 1);
}

TEST(one_thread_at_a_time_calls_the_caller)
{
    struct ceduo_scene_file r;
    struct ceduo_results a;
    struct ceduo_uncertainty_result uncertainty;
    struct ceduo_calibration fit;
    EXPECT(ceduo_scene_read("profiles/scenes/rotation.yaml", NULL, &r), ==, CEDUO_OK);
    struct ceduo_request q = ceduo_request_default(&r.scene);
    q.rocks = 100;
    q.run.threads = 4;
    q.run.progress = on_rocks;
    q.years = q.rotations = q.years_independent = true;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    ceduo_results_release(&a);
    expect_alone();
    struct ceduo_uncertainty_def def = {.size = sizeof(struct ceduo_uncertainty_def),
                                        .scene = &r.scene,
                                        .inputs_count = r.inputs_count,
                                        .inputs = r.inputs,
                                        .points = 30,
                                        .points_max = 30,
                                        .rocks = 20,
                                        .rotation = true,
                                        .years_max = 3,
                                        .threads = 4,
                                        .progress = on_points};
    EXPECT(ceduo_uncertainty_compute(&def, &uncertainty), ==, CEDUO_OK);
    ceduo_uncertainty_release(&uncertainty);
    expect_alone();
    ceduo_scene_file_release(&r);
    EXPECT(ceduo_scene_read("profiles/scenes/vaujany.yaml", NULL, &r), ==, CEDUO_OK);
    const char *const place = "rock.density_kg_m3";
    struct ceduo_input input = {
        .path = place, .kind = CEDUO_INPUT_RANGE, .lo = 2300, .hi = 2900, .places_count = 1, .places = &place};
    struct ceduo_calibration_scene fitted = {&r.scene, &input, r.observations_count, r.observations};
    struct ceduo_calibration_def how = {.size = sizeof(struct ceduo_calibration_def),
                                        .scenes_count = 1,
                                        .scenes = &fitted,
                                        .parameters_count = 1,
                                        .rocks = 20,
                                        .threads = 4,
                                        .steps_max = 250,
                                        .progress = on_fit};
    EXPECT(ceduo_calibrate(&how, &fit), ==, CEDUO_OK);
    ceduo_calibration_release(&fit);
    expect_alone();
    ceduo_scene_file_release(&r);
}

enum { YEARS = 20 };

/* Get the energies that arrive in the years of the first option, each with independent rocks. */
static void read_years(const char *seed, double *energies)
{
    struct ceduo_scene_file r;
    struct ceduo_results a;
    const char *const sets[] = {seed, NULL};
    EXPECT(ceduo_scene_read("profiles/scenes/rotation.yaml", sets, &r), ==, CEDUO_OK);
    struct ceduo_request q = ceduo_request_default(&r.scene);
    q.rocks = 50;
    q.years = q.years_independent = true;
    q.window = (struct ceduo_window){CEDUO_WINDOW_GIVEN, 1, YEARS, 1};
    for (size_t i = 0; i < r.scene.options_count; i++) /* with a forest no two years are equal */
        r.scene.options[i].belts_count = 0;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    EXPECT(a.years[0]->count, ==, YEARS);
    for (size_t i = 0; i < YEARS; i++)
        energies[i] = a.years[0]->years[i].wooded.arrivals[0].energy_per_released.mean;
    ceduo_results_release(&a);
    ceduo_scene_file_release(&r);
}

TEST(no_seed_has_the_rocks_of_another_one_in_another_year)
{
    double low[YEARS], high[YEARS];
    read_years("simulation.seed=0", low);
    read_years("simulation.seed=9007199254740992", high);
    for (size_t i = 0; i < YEARS; i++)
        for (size_t k = 0; k < YEARS; k++)
            EXPECT(low[i], !=, high[k]);
}

/* ---- sizes and releases ---- */

static enum ceduo_status goal_of_zero(void *context, double value, double *goal)
{
    (void)context, (void)value;
    *goal = 0;
    return CEDUO_OK;
}

TEST(structs_of_another_size_are_refused)
{
    struct ceduo_scene_file r;
    EXPECT(ceduo_scene_read("profiles/scenes/vaujany.yaml", NULL, &r), ==, CEDUO_OK);
    struct ceduo_request q = ceduo_request_default(&r.scene);
    struct ceduo_record_def record_def = ceduo_record_def_default(&r.scene);
    struct ceduo_uncertainty_def uncertainty_def = ceduo_uncertainty_def_default(&r.scene);
    struct ceduo_calibration_def calibration_def = ceduo_calibration_def_default();
    struct ceduo_find_def find_def = ceduo_find_def_default();
    struct ceduo_results results;
    struct ceduo_record record;
    struct ceduo_uncertainty_result uncertainty;
    struct ceduo_calibration fit;
    struct ceduo_found found;
    /* all else is valid */
    const char *const place = "rock.density_kg_m3";
    struct ceduo_input input = {
        .path = place, .kind = CEDUO_INPUT_RANGE, .lo = 2300, .hi = 2900, .places_count = 1, .places = &place};
    const struct ceduo_calibration_scene fitted = {&r.scene, &input, r.observations_count, r.observations};
    calibration_def.scenes = &fitted;
    calibration_def.scenes_count = calibration_def.parameters_count = uncertainty_def.inputs_count = 1;
    uncertainty_def.inputs = &input;
    find_def.goal = goal_of_zero;
    q.rocks = record_def.rocks = 1;
    EXPECT(ceduo_simulate_request(&q, NULL, &results), ==, CEDUO_OK);
    ceduo_results_release(&results);
    EXPECT(ceduo_record(&record_def, &record), ==, CEDUO_OK);
    ceduo_record_release(&record);
    EXPECT(ceduo_find(&find_def, &found), ==, CEDUO_OK);
    for (size_t i = 0; i < 2; i++) { /* releases may always be called, and more than once */
        q.size = record_def.size = uncertainty_def.size = calibration_def.size = find_def.size = i * 8;
        EXPECT(ceduo_simulate_request(&q, NULL, &results), ==, CEDUO_BAD_ARGUMENT);
        EXPECT(ceduo_record(&record_def, &record), ==, CEDUO_BAD_ARGUMENT);
        EXPECT(ceduo_uncertainty_compute(&uncertainty_def, &uncertainty), ==, CEDUO_BAD_ARGUMENT);
        EXPECT(ceduo_calibrate(&calibration_def, &fit), ==, CEDUO_BAD_ARGUMENT);
        EXPECT(ceduo_find(&find_def, &found), ==, CEDUO_BAD_ARGUMENT);
        ceduo_results_release(&results);
        ceduo_results_release(&results);
        ceduo_record_release(&record);
        ceduo_uncertainty_release(&uncertainty);
        ceduo_calibration_release(&fit);
    }
    ceduo_pool_free(NULL);
    ceduo_tracer_free(NULL);
    r.scene.size--;
    EXPECT(ceduo_scene_check(&r.scene, NULL), ==, CEDUO_BAD_ARGUMENT);
    ceduo_scene_file_release(&r);
    ceduo_scene_file_release(&r);
}

/* ---- defaults and texts ---- */

TEST(defaults_fill_all_optional_values)
{
    struct ceduo_scene_file r;
    assert_int_equal(ceduo_scene_read_text("mill.yaml", scene, &r), CEDUO_OK);
    struct ceduo_stems stems = ceduo_stems_default();
    struct ceduo_stand stand = ceduo_stand_default();
    struct ceduo_belt belt = ceduo_belt_default();
    struct ceduo_option option = ceduo_option_default();
    struct ceduo_control control = ceduo_control_default();
    assert_true(isnan(stems.volume) && isnan(stems.age) && isnan(stand.u) && isnan(belt.cut_year) && isnan(control.accepted));
    EXPECT(stand.species, ==, -1);
    EXPECT(stand.energy, ==, CEDUO_ENERGY_MODEL_BRAUNER);
    EXPECT(stand.counted_from, ==, 0);
    stems.per_ha = 900;
    stems.dbh = .2;
    stems.height = 15;
    stand.trees = &stems;
    stand.trees_count = 1;
    belt.from = 10;
    belt.to = 60;
    belt.stand = stand;
    option.belts = &belt;
    option.belts_count = 1;
    control.x = 80;
    r.scene.options = &option;
    r.scene.controls = &control;
    EXPECT(ceduo_scene_check(&r.scene, NULL), ==, CEDUO_OK);
    struct ceduo_request q = ceduo_request_default(&r.scene);
    struct ceduo_results a;
    EXPECT(ceduo_simulate_request(&q, NULL, &a), ==, CEDUO_OK);
    EXPECT(a.result->options[0].stands[0].contacts, >, 0);
    ceduo_results_release(&a);
    ceduo_scene_file_release(&r);
}

TEST(each_status_has_a_text)
{
    for (int s = CEDUO_OK; s <= CEDUO_BAD_PLACE; s++)
        for (int t = CEDUO_OK; t < s; t++)
            assert_string_not_equal(ceduo_status_text((enum ceduo_status)s), ceduo_status_text((enum ceduo_status)t));
    assert_string_equal(ceduo_status_text((enum ceduo_status)99), "unknown status");
    assert_string_equal(ceduo_version(), CEDUO_VERSION);
}
