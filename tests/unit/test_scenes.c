/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of a scene: stands with a base, grounds of the library, sources of values. */
#include "local.h"
#include "table.h"

#include "folder.h"

#include <math.h>

#include "io/scene_file.h"

__attribute__((format(printf, 2, 3))) static void write_file(const char *name, const char *format, ...)
{
    LOCAL_TEXT(text);
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    folder_write(name, text.bytes);
}

/* Read scene.yaml; put its problems into `messages`. */
static bool read_scene(struct scene_file *file, char messages[4096])
{
    char path[256];
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    in_folder(path, "scene.yaml");
    bool good = ceduo_scene_load(file, path, NULL, 0, &problems);
    snprintf(messages, 4096, "%s", ceduo_problems_print(&problems));
    return good;
}

/* ---- bases ---- */

#define REST                                                                                                                   \
    "ceduo: scene/1\nrock: {diameter_m: 0.5}\ncontrols: [{x_m: 90}]\n"                                                         \
    "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"

/* Stands 0 to n, each with the next as its base, and one key of its own. */
static void write_chain(int n)
{
    for (int i = 0; i <= n; i++) {
        char name[16];
        snprintf(name, sizeof name, "%d.yaml", i);
        if (i < n)
            write_file(name, "ceduo: stand/1\nbase: %d.yaml\ntrees: [{per_ha: %d, dbh_m: 0.2, height_m: 9}]\n", i + 1, 100 + i);
        else
            write_file(name, "ceduo: stand/1\nname: last\nstools: {per_ha: 2000, spacing_m: 0.4}\n"
                             "shoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\n");
    }
}

/* Eight steps from a stand's file to the last base, and eight from a stand in the scene; a ninth is reported at its
 * reference. */
TEST_WITH(bases_go_eight_files_deep, folder_set_up, folder_tear_down)
{
    const char *const stands[] = {"0.yaml", "{base: 1.yaml, trees: [{per_ha: 100, dbh_m: 0.2, height_m: 9}]}",
                                  "{base: 1.yaml, name: own, trees: [{per_ha: 100, dbh_m: 0.2, height_m: 9}]}"};
    for (int n = 1; n <= 10; n++)
        for (size_t i = 0; i < LENGTH(stands); i++) {
            LOCAL_BY(ceduo_scene_release) struct scene_file file;
            char messages[4096], place[160];
            write_chain(n);
            write_file("scene.yaml", REST "forest: [{from_m: 10, to_m: 80, stand: %s}]\n", stands[i]);
            assert_int_equal(read_scene(&file, messages), n <= 8);
            if (n <= 8) {
                const struct ceduo_belt *belt = &file.scene.options[0].belts[0];
                assert_string_equal(belt->name, i == 2 ? "own" : i == 1 ? "last (changed)" : "last");
                EXPECT(belt->stand.stools_per_ha, ==, 2000);
                EXPECT(belt->stand.trees[0].per_ha, ==, 100);
            } else {
                snprintf(place, sizeof place,
                         "%s/8.yaml:2:7: base: more than 8 files in a chain of 'base'; do they form a loop?\n", folder);
                if (strstr(messages, place) != messages)
                    fail_msg("%s", messages);
            }
        }
}

/* ---- grounds ---- */

struct vertex {
    double x, z;
    const char *ground; /* segment that starts here */
};

/* Midpoints of the ranges used with CRSP 3.0. */
static void expect_ground(const struct ceduo_segment *s, const char *name)
{
    const struct {
        const char *name;
        double rn, rt;
    } rows[] = {{"cliff", (0.33 + 0.37) / 2, (0.83 + 0.87) / 2},
                {"talus", (0.30 + 0.33) / 2, (0.82 + 0.85) / 2},
                {"colluvium", (0.28 + 0.30) / 2, (0.78 + 0.83) / 2}};
    for (size_t i = 0; i < LENGTH(rows); i++)
        if (strcmp(rows[i].name, name) == 0) {
            EXPECT_NEAR(s->rn.mean, rows[i].rn, 1e-12);
            EXPECT_NEAR(s->rt.mean, rows[i].rt, 1e-12);
            return;
        }
    fail_msg("%s", name);
}

/* Cut the profile (0, 50), (40, 20), (100, 0) at `x`, `z` between its grounds: on the line, with each side's own ground. */
static void expect_cut(double x, double z, const char *materials, const struct vertex *wanted, bool csv)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    char messages[4096];
    write_file("line.csv", "distance,elevation\n%.17g,%.17g\n%.17g,%.17g\n%.17g,%.17g\n", x, z + 50, x + 40, z + 20, x + 100,
               z);
    LOCAL_TEXT(profile);
    if (csv)
        ceduo_text_append(&profile, "csv: line.csv");
    else
        ceduo_text_format(&profile, "vertices_m: [[%.17g, %.17g], [%.17g, %.17g], [%.17g, %.17g]]", x, z + 50, x + 40, z + 20,
                          x + 100, z);
    write_file("scene.yaml",
               "ceduo: scene/1\nrock: {diameter_m: 0.5}\ncontrols: [{x_m: %.17g}]\nslope: {%s, materials: [%s]}\n", x + 90,
               profile.bytes, materials);
    if (!read_scene(&file, messages))
        fail_msg("%s", messages);
    const struct ceduo_slope *s = &file.scene.slope;
    size_t n = 0;
    for (; wanted[n].ground; n++) {
        EXPECT(n, <, s->vertices);
        if (!(s->x[n] == wanted[n].x) || !(fabs(s->z[n] - (wanted[n].z - 50)) < 1e-9))
            fail_msg("vertex %zu at %.17g, %.17g", n, s->x[n], s->z[n]);
        expect_ground(&s->segments[n], wanted[n].ground);
    }
    assert_int_equal(s->vertices, n + 1);
    EXPECT(s->x[n], ==, 100);
    EXPECT(s->origin_x, ==, x);
    EXPECT(s->origin_z, ==, z + 50);
}

TEST_WITH(grounds_meet_anywhere, folder_set_up, folder_tear_down)
{
    const struct {
        double borders[4]; /* from the profile's start; NAN: its end */
        const char *grounds[3];
        struct vertex wanted[6];
    } rows[] = {{{0, 10, 70, 100},
                 {"cliff", "talus", "colluvium"},
                 {{0, 50, "cliff"}, {10, 42.5, "talus"}, {40, 20, "talus"}, {70, 10, "colluvium"}}},
                {{0, 10, 20, 100},
                 {"cliff", "talus", "cliff"}, /* two in one segment */
                 {{0, 50, "cliff"}, {10, 42.5, "talus"}, {20, 35, "cliff"}, {40, 20, "cliff"}}},
                {{0, 55, 85, 100},
                 {"talus", "colluvium", "talus"}, /* in the last one */
                 {{0, 50, "talus"}, {40, 20, "talus"}, {55, 15, "colluvium"}, {85, 5, "talus"}}},
                {{0, 40, 70, 100},
                 {"cliff", "talus", "colluvium"}, /* at a vertex */
                 {{0, 50, "cliff"}, {40, 20, "talus"}, {70, 10, "colluvium"}}},
                {{-30, 10, 70, 400},
                 {"cliff", "talus", "colluvium"}, /* beyond both ends */
                 {{0, 50, "cliff"}, {10, 42.5, "talus"}, {40, 20, "talus"}, {70, 10, "colluvium"}}},
                {{-30, -10, 100, 400},
                 {"cliff", "talus", "colluvium"}, /* outside: no segment */
                 {{0, 50, "talus"}, {40, 20, "talus"}}},
                {{0, 0.25, 99.75, 100},
                 {"cliff", "talus", "cliff"}, /* close to the ends */
                 {{0, 50, "cliff"}, {0.25, 49.8125, "talus"}, {40, 20, "talus"}, {99.75, 1. / 12, "cliff"}}}};
    const double places[][2] = {{0, 0}, {480000, 0}, {480000.5, 4321.25}, {-120.25, -3000}, {500000000, 8000}};
    for (size_t i = 0; i < LENGTH(rows); i++)
        for (size_t k = 0; k < LENGTH(places); k++) {
            LOCAL_TEXT(materials);
            for (size_t j = 0; j < 3; j++)
                ceduo_text_format(&materials, "%s{from_m: %.17g, to_m: %.17g, material: %s}", j ? ", " : "",
                                  places[k][0] + rows[i].borders[j], places[k][0] + rows[i].borders[j + 1], rows[i].grounds[j]);
            expect_cut(places[k][0], places[k][1], materials.bytes, rows[i].wanted, false);
            expect_cut(places[k][0], places[k][1], materials.bytes, rows[i].wanted, true);
        }
}

/* ---- sources ---- */

#define A "source: {kind: assumed, text: a}"
#define M "source: {kind: measured, text: m}"
static const char sourced[] = "ceduo: scene/1\n" M "\n"
                              "rock: {diameter_m: {mean: 0.5, spread: 0.01, " A "}, density_kg_m3: 2600, " M "}\n"
                              "release: {vx_m_s: 1, " A "}\n"
                              "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
                              "controls: [{x_m: 90, accepted_kJ: 50, " A "}, {x_m: 80}]\n"
                              "forest:\n"
                              "  - {from_m: 10, to_m: 40, stand: stand.yaml}\n"
                              "  - {from_m: 40, to_m: 70, stand: {base: stand.yaml, " A "}}\n";
static const char stand[] = "ceduo: stand/1\n" M "\nstools: {per_ha: 2000, spacing_m: 0.4}\n"
                            "shoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\n"
                            "trees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}, {per_ha: 6, dbh_m: 0.4, height_m: 15, " A "}]\n";

/* Expect the source of a mapping as written; "" if none. */
static void expect_source(const struct scene_file *file, const char *map, const char *wanted, const char *set)
{
    const char *within;
    size_t used;
    LOCAL_TEXT(text);
    const struct node *node = ceduo_resolve_walk(file->root, map, &within, &used);
    assert_int_equal(used, strlen(map));
    node = ceduo_node_get(node, "source");
    if (node)
        ceduo_emit_flow(&text, node);
    if (strcmp(ceduo_text_string(&text), wanted) != 0)
        fail_msg("after %s the source of '%s' is %s, not %s", set, map, text.bytes, wanted);
}

/* After a change the innermost source no longer covers the value; other sources stay. */
TEST_WITH(changed_values_leave_their_source, folder_set_up, folder_tear_down)
{
    static const char *const maps[][2] = {{"", "m"},
                                          {"rock", "m"},
                                          {"rock.diameter_m", "a"},
                                          {"release", "a"},
                                          {"controls[0]", "a"},
                                          {"controls[1]", NULL},
                                          {"forest[0]", NULL},
                                          {"forest[0].stand", "m"},
                                          {"forest[0].stand.trees[0]", NULL},
                                          {"forest[0].stand.trees[1]", "a"},
                                          {"forest[1].stand", "a"}};
    write_file("stand.yaml", "%s", stand);
    write_file("scene.yaml", "%s", sourced);
    for (TABLE(row, "unit/sources.txt", "sources")) {
        LOCAL_BY(ceduo_scene_release) struct scene_file file;
        LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
        char messages[4096], plain[64], sets[256], *change, *rest = sets;
        if (!read_scene(&file, messages))
            fail_msg("%s", messages);
        snprintf(sets, sizeof sets, "%s", row.at[0]);
        while ((change = strsep(&rest, ";")))
            assert_true(ceduo_scene_set(&file, "--set", change + strspn(change, " "), &problems));
        for (size_t k = 0; k < LENGTH(maps); k++) {
            const char *text = maps[k][1];
            snprintf(plain, sizeof plain, "{kind: %s, text: %s}", text && *text == 'm' ? "measured" : "assumed",
                     text ? text : "");
            bool here = strcmp(row.at[1], maps[k][0]) == 0;
            expect_source(&file, maps[k][0], here ? row.at[2] : text ? plain : "", row.at[0]);
        }
        if (!ceduo_scene_bind(&file, &problems))
            fail_msg("%s", ceduo_problems_print(&problems));
    }
}

/* A new mapping does not inherit the source of the old one, nor the outer source. */
TEST_WITH(a_new_mapping_does_not_inherit_a_source, folder_set_up, folder_tear_down)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    char messages[4096];
    write_file("stand.yaml", "%s", stand);
    write_file("scene.yaml", "%s", sourced);
    assert_true(read_scene(&file, messages));
    assert_true(ceduo_scene_set(&file, "--set", "rock.diameter_m=0.6", &problems));
    expect_source(&file, "rock", "{kind: measured, text: m, except: [diameter_m]}", "rock.diameter_m");
    assert_true(ceduo_scene_set(&file, "--set", "release={vx_m_s: 2}", &problems));
    expect_source(&file, "release", "", "release");
    expect_source(&file, "", "{kind: measured, text: m, except: [release]}", "release");
    assert_true(ceduo_scene_set(&file, "--set", "forest[0].stand=stand.yaml", &problems));
    assert_true(ceduo_scene_set(&file, "--set", "forest[1].stand={base: stand.yaml}", &problems));
    expect_source(&file, "", "{kind: measured, text: m, except: [release, forest]}", "forest");
    assert_true(ceduo_scene_set(&file, "--set", "controls=[{x_m: 85}]", &problems));
    expect_source(&file, "controls[0]", "", "controls");
    expect_source(&file, "", "{kind: measured, text: m, except: [release, forest, controls]}", "controls");
}
