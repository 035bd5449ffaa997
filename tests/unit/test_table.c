/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of the scene covers every member, every row affects its subject, defaults are in range, and paths read and set
 * numbers in place. */
#include "core/runs/key.h"
#include "core/runs/run.h"
#include "expect.h"
#include "local.h"

#include <malloc.h>
#include <math.h>

#include "io/scene_file.h"
#include "scene/value.h"
#include "unit/every_key.h"

/* ---- every byte ---- */

/* Members computed from others. */
struct derived_member {
    const struct object *object;
    size_t offset, size;
};

#define DERIVED(object, type, member)                                                                                          \
    {                                                                                                                          \
        object, offsetof(struct type, member), sizeof((struct type *)0)->member                                                \
    }

static void mark(bool *is_member, size_t from, size_t n)
{
    for (size_t i = 0; i < n; i++)
        is_member[from + i] = true;
}

static void mark_rows(bool *is_member, const struct object *object, size_t size)
{
    for (size_t i = 0; i < object->n; i++) {
        const struct field *f = &object->fields[i];
        bool counted = f->type == FIELD_LIST || f->type == FIELD_NUMBERS || f->type == FIELD_POINTS;
        if (f->type == FIELD_GROUP && f->size == 0)
            mark_rows(is_member, f->object, size);
        if (f->flags & FIELD_NO_MEMBER || f->offset >= size) /* or only in a draft */
            continue;
        mark(is_member, f->offset, f->size);
        if (counted)
            mark(is_member, f->companion_offset, sizeof(size_t));
        if (f->type == FIELD_NUMBER && f->flags & FIELD_PLACE)
            mark(is_member, f->companion_offset, sizeof(double));
    }
}

/* Bytes outside all members. If the compiler cannot list them, at most as many as the smallest member has. */
#ifdef __has_builtin
#if __has_builtin(__builtin_clear_padding)
#define PADDING_IS_KNOWN 1
#endif
#endif
#ifdef PADDING_IS_KNOWN
#define SHORTEST_GAP 1
#define MARK_PADDING(is_member, type)                                                                                          \
    do {                                                                                                                       \
        type whole;                                                                                                            \
        memset(&whole, 0xff, sizeof whole);                                                                                    \
        __builtin_clear_padding(&whole);                                                                                       \
        for (size_t i = 0; i < sizeof whole; i++)                                                                              \
            is_member[i] |= ((unsigned char *)&whole)[i] == 0;                                                                 \
    } while (0)
#else
#define SHORTEST_GAP                  sizeof(double)
#define MARK_PADDING(is_member, type) (void)0
#endif

static void expect_whole(const char *name, const struct object *object, bool *is_member, size_t size)
{
    const struct object *scene = ceduo_schema_scene(), *belt = ceduo_schema_belt(), *slope = ceduo_schema_slope();
    const struct derived_member derived[] = {
        DERIVED(scene, ceduo_scene, size),
        DERIVED(slope, ceduo_slope, origin_x),
        DERIVED(slope, ceduo_slope, origin_z),
        DERIVED(slope, ceduo_slope, simplified_to),
        DERIVED(slope, ceduo_slope, simplified_at),
        DERIVED(slope, ceduo_slope, points),
        DERIVED(slope, ceduo_slope, points_x),
        DERIVED(slope, ceduo_slope, points_z),
        DERIVED(ceduo_schema_field(scene, "release")->object, ceduo_release, x_assumed),
        DERIVED(ceduo_schema_field(scene, "release")->object, ceduo_release, share), /* exists in a list */
        DERIVED(ceduo_schema_stand(), ceduo_stand, counted_from),
        DERIVED(ceduo_schema_field(ceduo_schema_stand(), "trees")->object, ceduo_stems, per_stool), /* exists for shoots */
        DERIVED(belt, ceduo_belt, name),
        DERIVED(belt, ceduo_belt, name_given),
        DERIVED(belt, ceduo_belt, assumed),
        DERIVED(belt, ceduo_belt, changed),
        DERIVED(belt, ceduo_belt, felled),
    };
    mark_rows(is_member, object, size);
    for (size_t i = 0; i < LENGTH(derived); i++)
        if (derived[i].object == object)
            mark(is_member, derived[i].offset, derived[i].size);
    for (size_t k = 0, unseen = 0; k < size; k++) {
        unseen = is_member[k] ? 0 : unseen + 1;
        if (unseen >= SHORTEST_GAP)
            fail_msg("%s: byte %zu of the structure belongs to no row", name, k);
    }
}

static const struct object *find_object(const struct object *object, const char *key)
{
    return ceduo_schema_field(object, key)->object;
}

#define EXPECT_WHOLE(object, type)                                                                                             \
    do {                                                                                                                       \
        bool is_member[sizeof(struct type)] = {false};                                                                         \
        MARK_PADDING(is_member, struct type);                                                                                  \
        expect_whole(#type, object, is_member, sizeof is_member);                                                              \
    } while (0)

TEST(every_member_has_a_row)
{
    const struct object *scene = ceduo_schema_scene(), *stand = ceduo_schema_stand();
    EXPECT_WHOLE(scene, ceduo_scene);
    EXPECT_WHOLE(find_object(scene, "rock"), ceduo_rock_def);
    EXPECT_WHOLE(find_object(scene, "release"), ceduo_release);
    EXPECT_WHOLE(find_object(scene, "simulation"), ceduo_simulation);
    EXPECT_WHOLE(find_object(scene, "controls"), ceduo_control);
    EXPECT_WHOLE(find_object(scene, "options"), ceduo_option);
    EXPECT_WHOLE(ceduo_schema_slope(), ceduo_slope);
    EXPECT_WHOLE(ceduo_schema_segment(), ceduo_segment);
    EXPECT_WHOLE(ceduo_schema_belt(), ceduo_belt);
    EXPECT_WHOLE(stand, ceduo_stand);
    EXPECT_WHOLE(find_object(stand, "trees"), ceduo_stems);
    EXPECT_WHOLE(find_object(stand, "stumps"), ceduo_stumps);
    EXPECT_WHOLE(find_object(stand, "logs"), ceduo_logs);
    EXPECT_WHOLE(find_object(stand, "growth"), ceduo_growth);
    EXPECT_WHOLE(find_object(find_object(stand, "growth"), "shoots"), ceduo_curve);
}

/* ---- defaults ---- */

static size_t defaults;

static void check_default(void *context, const char *path, const struct field *f)
{
    (void)context;
    double value;
    if (!f->value || f->type == FIELD_TAG)
        return;
    defaults++;
    if (f->type == FIELD_CHOICE && ceduo_choice_find(f->choices, f->value) < 0)
        fail_msg("%s: '%s' is none of its words", path, f->value);
    if (f->type == FIELD_FLAG)
        assert_true(strcmp(f->value, "true") == 0 || strcmp(f->value, "false") == 0);
    if (f->type == FIELD_CHOICE || f->type == FIELD_FLAG)
        return;
    if (ceduo_number_read(f->value, &value) != CEDUO_NUMBER_GOOD || !ceduo_schema_in_range(f, value))
        fail_msg("%s: its default, %s, is not in its range", path, f->value);
    EXPECT(ceduo_schema_default(f), ==, value * f->scale);
    assert_false(f->flags & FIELD_REQUIRED);
}

TEST(every_default_lies_in_its_range)
{
    defaults = 0;
    ceduo_schema_visit(ceduo_schema_scene(), "", check_default, NULL);
    EXPECT(defaults, >, 20);
    struct ceduo_scene scene = ceduo_scene_default();
    EXPECT(scene.rock.density.mean, ==, 2600);
    assert_true(isnan(scene.rock.diameter.mean));
    EXPECT(scene.simulation.rocks, ==, 1000);
    EXPECT(scene.simulation.threshold, ==, 30);
    EXPECT(scene.simulation.gravity, ==, 9.81);
    assert_true(isnan(scene.rocks_per_year));
    assert_int_equal(scene.simulation.contact_model, CEDUO_CONTACT_MODEL_STEMS);
    EXPECT(ceduo_segment_default().friction, ==, .5);
    EXPECT(ceduo_segment_default().mu, ==, .6);
    assert_true(isnan(ceduo_segment_default().rn.mean));
}

/* A flag is true only if its row sets it. */
TEST(flags_have_their_default)
{
    struct flags {
        bool raised, lowered, unsaid;
    } flags;
    const struct field fields[] = {
        {.key = "raised", .type = FIELD_FLAG, .offset = offsetof(struct flags, raised), .value = "true"},
        {.key = "lowered", .type = FIELD_FLAG, .offset = offsetof(struct flags, lowered), .value = "false"},
        {.key = "unsaid", .type = FIELD_FLAG, .offset = offsetof(struct flags, unsaid)}};
    ceduo_schema_init(&(struct object){fields, LENGTH(fields), sizeof flags, NULL}, &flags);
    assert_true(flags.raised);
    assert_false(flags.lowered || flags.unsaid);
}

/* ---- rows by their paths ---- */

TEST(paths_of_rows)
{
    const struct {
        const char *path, *key;
    } rows[] = {{"title", "title"},
                {"rock.diameter_m", "diameter_m"},
                {"slope.vertices_m", "vertices_m"},
                {"forest[0].stand.trees[oak].per_ha", "per_ha"},
                {"options[a].forest[2].from_m", "from_m"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct field *f = ceduo_schema_at(rows[i].path);
        assert_non_null(f);
        assert_string_equal(f->key, rows[i].key);
    }
    assert_null(ceduo_schema_at(""));
    const char *none = ".|title.|title.text|title[0]|rock|rock.|rock.size|rock[0].diameter_m|rock.diameter_m.mean|forest|"
                       "forest[0]|forest[0|forest[0][1]|forest.to_m|forest.a.to_m|slope.vertices_m[0][0]";
    for (char path[64]; next_word(&none, path);)
        if (ceduo_schema_at(path))
            fail_msg("'%s' has a row", path);
}

/* ---- effect of a row ---- */

/* Keys that a row can affect. */
struct keys {
    uint64_t flight, years;
};

static struct keys compute_keys(const struct ceduo_scene *scene)
{
    struct keys k = {ceduo_scene_key(scene), 0};
    for (size_t i = 0; i < scene->options_count; i++) {
        k.flight = k.flight * 31 + ceduo_option_key(scene, &scene->options[i]);
        k.years = k.years * 31 + ceduo_years_key(&scene->options[i]);
    }
    return k;
}

static void read_scene(struct scene_file *file, const char *path)
{
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    if (!ceduo_scene_load(file, path, NULL, 0, &problems))
        fail_msg("%s", ceduo_problems_print(&problems));
}

/* True if the scene is valid with a value; sets its keys. */
static bool keys_with(const char *scene, const char *path, const char *value, struct keys *k)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file = {0};
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    LOCAL_TEXT(set);
    ceduo_text_format(&set, "%s=%s", path, value);
    const char *const sets[] = {set.bytes};
    bool good = ceduo_scene_load(&file, scene, sets, 1, &problems);
    if (good)
        *k = compute_keys(&file.scene);
    return good;
}

/* List values to try; most are invalid in some rows. */
static size_t other_values(const struct field *f, const char **to)
{
    static const char *const numbers[] = {"0.55", "1.5",  "15",  "150", "350",  "2",   "3",
                                          "0.2",  "0.05", "115", "185", "3000", "2010"};
    static const char *const flags[] = {"true", "false"}, *const texts[] = {"other"}, *const words[] = {"[quercus-ilex]"},
                             *const files[] = {"a.csv", "b.csv", "a.yaml", "b.yaml"};
    const char *const *from = f->type == FIELD_CHOICE  ? f->choices->names
                              : f->type == FIELD_FLAG  ? flags
                              : f->type == FIELD_TEXT  ? texts
                              : f->type == FIELD_WORDS ? words
                              : f->type == FIELD_FILE  ? files
                                                       : numbers;
    size_t n = f->type == FIELD_CHOICE  ? f->choices->n
               : f->type == FIELD_FLAG  ? LENGTH(flags)
               : f->type == FIELD_TEXT  ? LENGTH(texts)
               : f->type == FIELD_WORDS ? LENGTH(words)
               : f->type == FIELD_FILE  ? LENGTH(files)
                                        : LENGTH(numbers);
    memcpy(to, from, n * sizeof *to);
    return n;
}

static void check_row(void *context, const char *path, const struct field *f)
{
    const struct keys *before = context;
    struct text place = {0};
    bool taken = false, flight = false, years = false;
    if (f->type == FIELD_TAG || (strncmp(path, "slope.materials[]", 17) == 0 && f->type == FIELD_NUMBER) ||
        strcmp(f->key, "base") == 0 || strcmp(path, "slope.reversed") == 0 || strstr(path, "uncertainty[]") ||
        strncmp(path, "observed[]", 10) == 0 || strncmp(path, "options[].forest[].", 19) == 0)
        return; /* grounds must meet, so one end cannot change alone; a base is followed before it is set; options hold the
                 * forest; a profile decides if it is reversed; no member of uncertainty can change alone; test_observed.py
                 * tests observations */
    first_place(path, f, "[1][1]", &place);
    for (size_t i = 0; i < LENGTH(scenes); i++) {
        const char *values[64];
        size_t n = other_values(f, values);
        for (size_t v = 0; v < n; v++) {
            struct keys k;
            if (!keys_with(scenes[i], place.bytes, values[v], &k))
                continue;
            taken = true;
            flight |= k.flight != before[i].flight;
            years |= k.years != before[i].years;
        }
    }
    if (!taken)
        fail_msg("%s: no value is taken anywhere", path);
    if (f->flags & FIELD_NO_RUN && (flight || years))
        fail_msg("%s is said to decide about no rock, but it makes another key", path);
    if (f->flags & FIELD_YEARS && !years)
        fail_msg("%s is said to decide about the years to come, but it leaves their key as it is", path);
    if (!(f->flags & (FIELD_NO_RUN | FIELD_YEARS)) && !flight)
        fail_msg("%s: no value of it makes another key", path);
    ceduo_text_free(&place);
}

TEST(every_row_affects_its_subject)
{
    struct keys before[LENGTH(scenes)];
    for (size_t i = 0; i < LENGTH(scenes); i++) {
        LOCAL_BY(ceduo_scene_release) struct scene_file file = {0};
        read_scene(&file, scenes[i]);
        before[i] = compute_keys(&file.scene);
    }
    ceduo_schema_visit(ceduo_schema_scene(), "", check_row, before);
    struct keys moved;
    assert_true(keys_with(scenes[2], "slope.materials",
                          "[{from_m: 100, to_m: 140, material: cliff}, {from_m: 140, to_m: 300, material: talus}]", &moved));
    EXPECT(moved.flight, !=, before[2].flight);
    assert_true(keys_with(scenes[2], "forest[0].stand", "{base: b.yaml}", &moved));
    EXPECT(moved.flight, !=, before[2].flight);
}

/* ---- typed access ---- */

/* Expect a typed set to report and do the same as --set. */
static void check_set(void *context, const char *path, const struct field *f)
{
    (void)context;
    struct text place = {0};
    first_place(path, f, "[1][1]", &place);
    for (size_t i = 0; i < LENGTH(scenes); i++) {
        const char *values[64];
        struct scene_file file = {0};
        struct value v;
        size_t n = other_values(f, values);
        read_scene(&file, scenes[i]);
        if (!ceduo_value_find(&file.scene, place.bytes, &v)) {
            ceduo_scene_release(&file);
            continue;
        }
        assert_ptr_equal(v.field, f);
        for (size_t k = 0; k < n; k++) {
            struct keys set;
            double number, was = ceduo_value_get(&v);
            if (f->type == FIELD_CHOICE)
                number = ceduo_choice_find(f->choices, values[k]);
            else
                assert_int_equal(ceduo_number_read(values[k], &number), CEDUO_NUMBER_GOOD);
            bool good = ceduo_value_set(&v, number);
            if (!good)
                assert_true(ceduo_value_get(&v) == was || isnan(was));
            else
                EXPECT_NEAR(ceduo_value_get(&v), number, 1e-12 * number);
            if (!keys_with(scenes[i], place.bytes, values[k], &set))
                continue;
            if (strcmp(f->key, "per_stool") == 0)
                ceduo_stand_update_shoot_density(&file.scene.options[0].belts[0].stand);
            struct keys now = compute_keys(&file.scene);
            if (!good || now.flight != set.flight || now.years != set.years)
                fail_msg("%s=%s: set is another scene than put", place.bytes, values[k]);
        }
        ceduo_scene_release(&file);
    }
    ceduo_text_free(&place);
}

TEST(typed_set_equals_text_set)
{
    ceduo_schema_visit(ceduo_schema_scene(), "", check_set, NULL);
}

static void expect_none(struct ceduo_scene *scene, const char *paths)
{
    struct value v;
    for (char path[64]; next_word(&paths, path);)
        if (ceduo_value_find(scene, path, &v))
            fail_msg("'%s' is found", path);
}

/* Find a number and check its value. */
static struct value find_number(struct ceduo_scene *scene, const char *path, double number)
{
    struct value v;
    assert_true(ceduo_value_find(scene, path, &v));
    EXPECT(ceduo_value_get(&v), ==, number);
    return v;
}

/* Find a number and set it. */
static struct value set_number(struct ceduo_scene *scene, const char *path, double number)
{
    struct value v;
    assert_true(ceduo_value_find(scene, path, &v));
    assert_true(ceduo_value_set(&v, number));
    return v;
}

TEST(paths_of_numbers)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file = {0};
    struct value v;
    read_scene(&file, scenes[1]);
    struct ceduo_scene *s = &file.scene;
    v = find_number(s, "options[a].forest[wood].stand.trees[0].per_ha", 80);
    v = find_number(s, "controls[road].accepted_kJ", 80);
    assert_true(ceduo_value_set(&v, 90));
    EXPECT(s->controls[0].accepted, ==, 90e3);
    v = set_number(s, "controls[0].x_m", 185);
    EXPECT(s->controls[0].x_given, ==, 185);
    EXPECT(s->controls[0].x, ==, 85);
    v = find_number(s, "release.x_m", 101);
    assert_true(ceduo_value_set(&v, 102));
    EXPECT(s->release.x.mean, ==, 2);
    v = set_number(s, "release.vx_m_s.spread", .25);
    EXPECT(s->release.vx.spread, ==, .25);
    v = set_number(s, "release.vx_m_s.mean", 2);
    EXPECT(s->release.vx.mean, ==, 2);
    assert_true(ceduo_value_find(s, "release.height_m.spread", &v));
    assert_false(ceduo_value_set(&v, 5)); /* its range would reach below 0 */
    EXPECT(s->release.height.spread, ==, 0);
    v = set_number(s, "slope.segments[0].rn", .25); /* set for all segments */
    for (size_t j = 0; j < 3; j++)
        EXPECT(s->slope.segments[j].rn.mean, ==, .25);
    v = set_number(s, "simulation.seed", 7);
    EXPECT(s->simulation.seed, ==, 7);
    assert_false(ceduo_value_set(&v, 7.5) || ceduo_value_set(&v, -1) || ceduo_value_set(&v, NAN) || ceduo_value_set(&v, 1e17));
    assert_false(ceduo_value_find(s, "", &v));
    expect_none(s, "rock|rock.|rock.size|title|slope.segments[1].rn|slope.vertices_m[0][0]|slope.vertices_m[1]|"
                   "slope.vertices_m[1][2]|controls[1].x_m|controls.x_m|options[c].forest[0].from_m|forest[0].from_m|"
                   "release.vx_m_s.kind|release.vx_m_s[0]|rock.axes_m[3]|rock.axes_m|slope.materials[0].from_m|"
                   "rock.diameter_m.mean.mean|rock[0]|controls_m[0]|slope.csv");
}

/* Profile points are relative to the first one; a number with a spread has separate parts; a list of numbers has places. */
TEST(paths_of_numbers_in_lists)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file = {0};
    struct value v;
    read_scene(&file, scenes[4]);
    struct ceduo_scene *s = &file.scene;
    v = find_number(s, "slope.vertices_m[1][0]", 130);
    assert_true(ceduo_value_set(&v, 140));
    EXPECT(s->slope.x[1], ==, 40);
    v = find_number(s, "slope.vertices_m[1][1]", 30);
    assert_true(ceduo_value_set(&v, 35));
    EXPECT(s->slope.z[1], ==, -25);
    v = set_number(s, "rock.axes_m[1].spread", .125);
    assert_false(ceduo_value_set(&v, -.125) || ceduo_value_set(&v, INFINITY) || ceduo_value_set(&v, NAN));
    EXPECT(ceduo_value_get(&v), ==, .125);
    EXPECT(s->rock.axes[1].mean, ==, .5);
    EXPECT(s->rock.axes[1].spread, ==, .125);
    assert_true(ceduo_value_find(s, "slope.segments[0].rn.spread", &v));
    assert_false(ceduo_value_set(&v, INFINITY)); /* although draws are clamped to 0 and 1 */
    assert_true(ceduo_value_set(&v, 2));
    v = find_number(s, "forest[0].stand.cutting.stay_per_ha[1]", 20);
    expect_none(s, "slope.vertices_m[4][1]|slope.vertices_m[a][1]|slope.vertices_m.1[1]|slope.vertices_m[1][1].x|"
                   "rock.axes_m[1].kind|forest[0].stand.cutting.stay_per_ha[2]|forest[0].stand.cutting.stay_per_ha[1].x|"
                   "forest[0].stand.trees[oak].per_ha|controls|controls."); /* stems have no names */
    /* its vertices are not the points of the file */
    s->slope.simplified_to = .5;
    expect_none(s, "slope.vertices_m[1][0]|slope.vertices_m[1][1]");
}

/* A word is the index of its choice, -1 if it is not given. */
TEST(words_are_set_by_their_index)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file = {0};
    struct value v;
    read_scene(&file, scenes[0]);
    assert_true(ceduo_value_find(&file.scene, "simulation.contact_model", &v));
    EXPECT(ceduo_value_get(&v), ==, CEDUO_CONTACT_MODEL_STEMS);
    assert_true(ceduo_value_set(&v, CEDUO_CONTACT_MODEL_INDEX));
    assert_int_equal(file.scene.simulation.contact_model, CEDUO_CONTACT_MODEL_INDEX);
    const double none[] = {-2, .5, (double)v.field->choices->n, NAN};
    for (size_t i = 0; i < LENGTH(none); i++)
        assert_false(ceduo_value_set(&v, none[i]));
    assert_int_equal(file.scene.simulation.contact_model, CEDUO_CONTACT_MODEL_INDEX);
}

/* Trying many values on one scene leaks no memory. */
TEST(setting_values_leaks_no_memory)
{
    struct scene_file file = {0};
    struct value per_ha, diameter;
    read_scene(&file, scenes[0]);
    assert_true(ceduo_value_find(&file.scene, "forest[0].stand.trees[0].per_ha", &per_ha));
    assert_true(ceduo_value_find(&file.scene, "rock.diameter_m", &diameter));
    struct ceduo_run_def def = ceduo_run_def_default(&file.scene);
    def.option = &file.scene.options[0];
    def.rocks_max = 10;
    size_t before = 0, arena = file.arena.bytes;
    for (int i = 0; i < 200000; i++) {
        assert_true(ceduo_value_set(&per_ha, 50 + i % 100));
        assert_true(ceduo_value_set(&diameter, .5 + 1e-6 * i));
        if (i % 100 != 0)
            continue;
        LOCAL(ceduo_run, run);
        assert_int_equal(ceduo_run_create(&def, &run), CEDUO_OK);
        assert_int_equal(ceduo_run_extend(run, 10), CEDUO_OK);
        before = i == 100000 ? mallinfo2().uordblks : before; /* from here on the C library caches its free blocks, */
        if (i >= 100000)
            EXPECT(mallinfo2().uordblks, <=, before + 4096); /* which it counts as used */
    }
    assert_int_equal(file.arena.bytes, arena);
    ceduo_scene_release(&file);
}
