/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: slow */
/* Files and documents without memory. */
#include "core/runs/key.h"
#include "local.h"
#include "memory/failing.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/oom.h"
#include "folder.h"
#include "io/file.h"
#include "io/scene_file.h"
#include "io/survey_file.h"

static const char scene[] =
    "# my comment\n"
    "ceduo: scene/1\n"
    "rock: {diameter_m: {mean: 0.5, spread: 0.1, source: {kind: assumed, text: a guess, except: [spread]}}}\n"
    "slope: slope.yaml\n"
    "controls: [{x_m: 90, name: road, accepted_kJ: 50, source: {kind: assumed, text: said}}]\n"
    "forest:\n"
    "  - {from_m: 10, to_m: 50, stand: stand.yaml}\n"
    "  - {from_m: 50, to_m: 80, stand: {base: stand.yaml, stools: {per_ha: 1500}, source: {text: said}}}\n";

static const char slope[] = "ceduo: slope/1\ncsv: profile.csv\n"
                            "materials: [{from_m: 0, to_m: 30, material: cliff}, {from_m: 30, to_m: 100, material: talus}]\n";

static const char stand[] =
    "ceduo: stand/1\nname: wood\nsource: {kind: assumed, text: a guess, text_it: a occhio}\n"
    "stools: {per_ha: 2000, spacing_m: 0.4}\n"
    "shoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\ntrees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}]\n";

static const char faulty[] = "ceduo: scene/1\nrock: {diameter_m: -1, size: 2}\nslope: {vertices_m: [[0, 1], 2]}\n"
                             "release: {x_m: [1]}\nsimulation: {law: lumpd, rocks: 1.5, seed: 'a'}\ncontrols: 1\n"
                             "forest: [{from_m: x}]\n";

static const char csv_scene[] = "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: profile.csv\ncontrols_m: [90]\n";

static const char observed[] =
    "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: profile.csv\ncontrols_m: [90]\nrelease: {height_m: 1}\n"
    "observed:\n"
    "  - {name: few, stops: {x_m: stops.csv, only: block=1, use: check}, release: {vx_m_s: 3}, rock: {diameter_m: 0.4}}\n"
    "  - {passed: {x_m: 30, count: 1, of: 2}, on_the_way: {from_m: 5, to_m: 9, height_m: {mean: 1, sd: 1, n: 4}}}\n"
    "uncertainty: {draws: draws.csv, rows: [{path: release.vx_m_s, lo: 1, hi: 3}]}\n";

static const char upward_scene[] =
    "ceduo: scene/1\nrock: {diameter_m: 0.5}\ncontrols_m: [90]\n"
    "slope: {reversed: true, vertices_m: [[0, 0], [60, 20], [100, 50]],"
    " materials: [{from_m: 0, to_m: 70, material: talus}, {from_m: 70, to_m: 100, material: cliff}]}\n";

static const char kinds_scene[] =
    "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: profile.csv\ncontrols_m: [90]\n"
    "observed: {speed: [{x_m: 30, values: [4, 5]}, {x_m: 40, mean: 3, sd: 1, n: 4}], scars: {from_m: "
    "2, to_m: 9, height_m: [1]}}\n";

static const char uncertain[] = "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: profile.csv\ncontrols_m: [90]\n"
                                "blocks: {per_year: 1, exponent: 0.7, volume_m3: [0.1, 2]}\n"
                                "rules: {name: here, standards: [{per_ha: 50, article: a, year: 2000, species: [acer]}]}\n"
                                "options:\n  - name: wood\n    forest: [{from_m: 10, to_m: 30, stand: uncertain.yaml}, "
                                "{from_m: 30, to_m: 50, stand: uncertain.yaml}]\n  - {name: bare}\n"
                                "uncertainty: [{path: 'options[*].forest[0].stand.energy.model', one_of: [brauner, dorren]}, "
                                "{path: 'slope.materials[talus].rn', lo: 0.2, hi: 0.3}]\n";

static const char uncertain_stand[] = "ceduo: stand/1\ntrees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}]\n"
                                      "uncertainty: [{path: 'trees[*].per_ha', lo: 50, hi: 70}]\n";

static const char survey[] =
    "plot,area_m2,kind,stool,species,dbh_cm,height_m,note\n1,100,shoot,1,beech,6,7,x\n1,100,shoot,1,,5,,\n"
    "2,120,standard,,quercus-cerris,20,13,\n2,,stump,,,30,0.2,\n";

static bool arenas_fail; /* fail each allocation from an arena, too */
static char scene_path[256], survey_path[256], link_path[256], linked_path[256];

static int set_up(void **state)
{
    (void)state;
    arenas_fail = true;
    folder_make();
    setenv("XDG_STATE_HOME", folder, 1);
    setenv("XDG_DATA_HOME", folder, 1);
    make_folder("ceduo");
    make_folder("ceduo/scenes");
    make_folder("elsewhere");
    in_folder(scene_path, "scene.yaml");
    in_folder(survey_path, "survey.csv");
    in_folder(link_path, "link");
    in_folder(linked_path, "linked");
    assert_int_equal(symlink("linked", link_path), 0);
    folder_write("scene.yaml", scene);
    folder_write("slope.yaml", slope);
    folder_write("stand.yaml", stand);
    folder_write("faulty.yaml", faulty);
    folder_write("csv.yaml", csv_scene);
    folder_write("observed.yaml", observed);
    folder_write("upward.yaml", upward_scene);
    folder_write("kinds.yaml", kinds_scene);
    folder_write("uncertain_scene.yaml", uncertain);
    folder_write("uncertain.yaml", uncertain_stand);
    folder_write("survey.csv", survey);
    folder_write("stops.csv", "block,x_m\n1,40\n2,50\n1,60\n");
    folder_write("draws.csv", "rock.density_kg_m3\n2600\n2550\n");
    folder_write("ceduo/scenes/mill.yaml", csv_scene);
    folder_write("profile.csv", "distance,elevation\n0,50\n40,20\n100,0\n");
    return 0;
}

static int tear_down(void **state)
{
    arenas_fail = false;
    return folder_tear_down(state);
}

static void add_text(const struct text *text)
{
    add(text->bytes, text->length);
}

/* Skip fsync(): it would be called thousands of times, and no test depends on it. */
int __wrap_fsync(int fd);

int __wrap_fsync(int fd)
{
    (void)fd;
    return 0;
}

/* An arena allocates few pages; these let each allocation from it fail. */
void *__real_ceduo_arena_alloc(struct arena *arena, size_t size);
void *__real_ceduo_arena_grow(struct arena *arena, void *items, size_t n, size_t more, size_t *capacity, size_t size);
char *__real_ceduo_arena_copy(struct arena *arena, const char *bytes, size_t n);
char *__real_ceduo_arena_string(struct arena *arena, const char *string);
char *__real_ceduo_arena_vformat(struct arena *arena, const char *format, va_list args);
void *__wrap_ceduo_arena_alloc(struct arena *arena, size_t size);
void *__wrap_ceduo_arena_grow(struct arena *arena, void *items, size_t n, size_t more, size_t *capacity, size_t size);
char *__wrap_ceduo_arena_copy(struct arena *arena, const char *bytes, size_t n);
char *__wrap_ceduo_arena_string(struct arena *arena, const char *string);
__attribute__((format(printf, 2, 0))) char *__wrap_ceduo_arena_vformat(struct arena *arena, const char *format, va_list args);

static bool arena_fails(struct arena *arena)
{
    bool failed = arenas_fail && fails();
    arena->failed |= failed;
    if (failed)
        ceduo_oom_set_flag();
    return failed;
}

void *__wrap_ceduo_arena_alloc(struct arena *arena, size_t size)
{
    return arena_fails(arena) ? NULL : __real_ceduo_arena_alloc(arena, size);
}

void *__wrap_ceduo_arena_grow(struct arena *arena, void *items, size_t n, size_t more, size_t *capacity, size_t size)
{
    return arena_fails(arena) ? NULL : __real_ceduo_arena_grow(arena, items, n, more, capacity, size);
}

char *__wrap_ceduo_arena_copy(struct arena *arena, const char *bytes, size_t n)
{
    return arena_fails(arena) ? NULL : __real_ceduo_arena_copy(arena, bytes, n);
}

char *__wrap_ceduo_arena_string(struct arena *arena, const char *string)
{
    return arena_fails(arena) ? NULL : __real_ceduo_arena_string(arena, string);
}

char *__wrap_ceduo_arena_vformat(struct arena *arena, const char *format, va_list args)
{
    return arena_fails(arena) ? NULL : __real_ceduo_arena_vformat(arena, format, args);
}

__attribute__((format(printf, 2, 3))) static const char *format_into(struct arena *arena, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const char *text = ceduo_arena_vformat(arena, format, args);
    va_end(args);
    return text;
}

/* Format into an empty arena. */
static bool format_text(void)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    const char *text = format_into(&arena, "%s[%d]", "forest", 7);
    bool done = text;
    assert_int_equal(arena.failed, !done);
    if (done)
        assert_string_equal(text, "forest[7]");
    return done;
}

/* ---- reading ---- */

/* Input to read: a file of the folder, or NULL for a text; its changes. `wrong`: it is refused, with all problems or with a
 * note that some are missing. The causes are faults of a file, an unknown name, valid changes with one that contradicts the
 * rest, and a path that matches two belts. */
static const struct reading {
    const char *name, *sets[6];
    bool wrong;
} readings[] = {
    {"scene.yaml",
     {"forest[1].stand.stools.spacing_m=0.5", "rock.density_kg_m3.spread=10", "rock.diameter_m.mean=0.6",
      "release.vx_m_s={mean: 2, spread: 0.5}", "controls[0].accepted_kJ=60"},
     false},
    {NULL, {NULL}, false},
    {"csv.yaml", {NULL}, false},
    {"observed.yaml", {NULL}, false}, /* with observations and uncertain inputs */
    {"upward.yaml", {NULL}, false},
    {"kinds.yaml", {NULL}, false},
    {"uncertain_scene.yaml", {NULL}, false},
    {"faulty.yaml", {NULL}, true},
    {"mil", {NULL}, true},
    {"scene.yaml", {"rock.density_kg_m3=2500", "release.x_m=92", "simulation.seed=5"}, true},
    {"scene.yaml", {"forest[wood].to_m=45"}, true},
};
static const struct reading *reading;

static bool read_scene(void)
{
    static const char scene_text[] = "ceduo: scene/1\nrock: {diameter_m: 1}\ncontrols_m: [5]\n"
                                     "slope: {vertices_m: [[0, 9], [9, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n";
    char path[256];
    in_folder(path, reading->name ? reading->name : "");
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    LOCAL_TEXT(text);
    struct scene_inputs inputs = {0};
    size_t n = 0;
    while (reading->sets[n])
        n++;
    bool done = !reading->name
                    ? ceduo_scene_load_text(&file, "scene", scene_text, &problems)
                    : ceduo_scene_load(&file, strchr(reading->name, '.') ? path : reading->name, reading->sets, n, &problems);
    ceduo_problems_print(&problems);
    assert_true(reading->wrong ? !done : done || problems.memory);
    if (reading->wrong && !problems.memory)
        add_text(&problems.text);
    if (reading->wrong)
        return !problems.memory && !ceduo_memory_failed();
    done = done && ceduo_inputs_collect(&file, &inputs);
    if (!done)
        return false;
    uint64_t key = ceduo_scene_key(&file.scene);
    add(&key, sizeof key);
    ceduo_emit(&text, file.root);
    if (!text.failed)
        add_text(&text);
    for (size_t i = 0; i < inputs.n; i++)
        add(inputs.items[i].path, strlen(inputs.items[i].path));
    for (size_t i = 0; i < file.observations_count; i++) {
        const struct ceduo_observation *o = &file.observations[i];
        add(o->name, strlen(o->name));
        add(o->values ? o->values : &o->mean, sizeof(double));
    }
    return !ceduo_memory_failed();
}

/* Read by the library's public function. */
static bool read_by_library(void)
{
    char path[256];
    LOCAL_BY(ceduo_scene_file_release) struct ceduo_scene_file read;
    in_folder(path, "observed.yaml");
    bool done = is_done(ceduo_scene_read(path, NULL, &read));
    for (size_t i = 0; i < read.inputs_count; i++)
        add(read.inputs[i].path, strlen(read.inputs[i].path));
    assert_int_equal(read.observations_count > 0, done);
    assert_true(!done || read.messages[0] == '\0');
    return done;
}

static bool read_survey(void)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    struct survey_file file;
    LOCAL_TEXT(yaml);
    bool done =
        ceduo_survey_read(&file, &arena, survey_path, NULL, &problems) && ceduo_survey_print_stand(&file, &yaml, &problems);
    ceduo_problems_print(&problems);
    assert_true(done || problems.memory);
    if (done)
        add_text(&yaml);
    return done && !ceduo_memory_failed();
}

/* ---- folders ---- */

/* Write through a link to a missing file. */
static bool write_link(void)
{
    unlink(linked_path);
    bool done = ceduo_file_write(link_path, "text", 4);
    assert_true(done || errno == ENOMEM);
    assert_int_equal(access(linked_path, F_OK) == 0, done);
    return done;
}

/* Write a temporary file and replace the old one. */
static bool replace_file(void)
{
    bool done = ceduo_file_write(survey_path, survey, sizeof survey - 1);
    assert_true(done || errno == ENOMEM);
    return done;
}

/* Check for permission to replace the file. */
static bool check_writable(void)
{
    bool done = ceduo_file_can_write(scene_path);
    assert_true(done || errno == ENOMEM);
    return done;
}

static bool list_profiles(void)
{
    LOCAL_BY(ceduo_arena_free) struct arena arena = {0};
    size_t n = 0;
    const char *const *names = ceduo_file_list(&arena, "profiles", "stands", &n);
    bool done = !arena.failed;
    if (done) {
        assert_true(n > 4);
        for (size_t i = 0; i < n; i++)
            add(names[i], strlen(names[i]));
    }
    return done;
}

TEST_WITH(scenes_are_read, set_up, tear_down)
{
    without_memory(format_text);
    for (reading = readings; reading < readings + sizeof readings / sizeof readings[0]; reading++)
        without_memory(read_scene);
    without_memory(read_by_library);
    without_memory(read_survey);
}

TEST_WITH(files_are_written_and_listed, set_up, tear_down)
{
    without_memory(list_profiles);
    without_memory(write_link);
    without_memory(replace_file);
    without_memory(check_writable);
}
