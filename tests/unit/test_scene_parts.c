/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Blocks, uncertainty and observations in a scene: the places they refer to, their sources, and merged problems. */
#include "local.h"
#include "scene/stand.h"
#include "table.h"

#include <math.h>

#include "base/text.h"
#include "folder.h"
#include "io/scene_file.h"
#include "scene/schema.h"

/* Complete `lines` to a valid scene. */
static struct text scene_with(const char *lines)
{
    static const char *const plain[] = {
        "ceduo: scene/1\n", "rock: {diameter_m: 0.5, density_kg_m3: 2600}\n",
        "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], segments: [{rn: 0.3, rt: 0.8}, {rn: 0.3, rt: 0.8}]}\n",
        "controls: [{x_m: 90}]\n", "simulation: {rocks: 10}\n"};
    struct text text = {0};
    for (size_t i = 0; i < LENGTH(plain); i++) {
        char key[32];
        snprintf(key, sizeof key, "\n%.*s", (int)strcspn(plain[i], ":"), plain[i]);
        bool other = strncmp(lines, key + 1, strlen(key) - 1) == 0 || strstr(lines, key);
        ceduo_text_append(&text, other ? "" : plain[i]);
    }
    ceduo_text_format(&text, "%s\n", lines);
    return text;
}

/* Read a scene from the folder with its `sets`; fail unless it reports exactly the expected problem (NULL: none). */
static void read_scene(struct scene_file *file, const char *lines, const char *const *sets, size_t n, const char *reported)
{
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    LOCAL_BY(ceduo_text_free) struct text text = scene_with(lines);
    char path[256];
    folder_write("scene.yaml", text.bytes);
    in_folder(path, "scene.yaml");
    bool good = ceduo_scene_load(file, path, sets, n, &problems);
    if (good != !reported || problems.wrong.count != !good || (reported && !strstr(ceduo_problems_print(&problems), reported)))
        fail_msg("%s\n%s\nis not told '%s' alone but:\n%s", text.bytes, n ? sets[0] : "", reported ? reported : "nothing",
                 ceduo_problems_print(&problems));
}

#define SHOOTS     "stools: {per_ha: 2000, spacing_m: 0.4}, shoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]"
#define BELT       "from_m: 10, to_m: 80, stand: {" SHOOTS
#define GROUND_ROW "uncertainty: [{path: 'slope.materials[talus].rn', lo: 0.2, hi: 0.4}]"
#define CLIFF_AND_TALUS                                                                                                        \
    "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], materials: [{from_m: 0, to_m: 40, material: cliff}, "                  \
    "{from_m: 40, to_m: 100, material: talus}]}"
#define TREE   "dbh_m: 0.2, height_m: 9"
#define GROUPS "groups: {stems: 5, radius_m: 2}"

/* More rows than the limit. */
TEST_WITH(rows_of_uncertainty_are_reported, folder_set_up, folder_tear_down)
{
    LOCAL_TEXT(many);
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    ceduo_text_append(&many, "uncertainty: [");
    for (int i = 0; i <= CEDUO_ITEMS_MAX; i++)
        ceduo_text_append(&many, "{path: rock.density_kg_m3, lo: 1, hi: 2},");
    ceduo_text_append(&many, "]");
    read_scene(&file, many.bytes, NULL, 0, "uncertainty: 1001 items; at most 1000 can be computed");
}

/* Expect the input of one row of uncertainty to have these places, separated by commas. */
static void expect_places(const char *lines, const char *places)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_TEXT(found);
    read_scene(&file, lines, NULL, 0, NULL);
    assert_int_equal(file.inputs_count, places[0] ? 1 : 0);
    for (size_t i = 0; places[0] && i < file.inputs[0].places_count; i++)
        ceduo_text_format(&found, "%s%s", i > 0 ? "," : "", file.inputs[0].places[i]);
    assert_string_equal(ceduo_text_string(&found), places);
}

TEST_WITH(rows_of_uncertainty_mean_places, folder_set_up, folder_tear_down)
{
    expect_places("uncertainty: [{path: 'forest[0].stand.cutting.rotation_years', lo: 10, hi: 20}]\n"
                  "forest: [{" BELT ", cutting: {rotation_years: 15}}}]",
                  "forest[0].stand.cutting.rotation_years");
    expect_places("uncertainty: [{path: 'controls[*].x_m', lo: 50, hi: 60}]\ncontrols: [{x_m: 90}, {x_m: 95}]",
                  "controls[0].x_m,controls[1].x_m");
    expect_places("uncertainty: [{path: 'options[*].forest[*].to_m', lo: 50, hi: 60}]", ""); /* there are no options */
    /* an option without a forest is skipped, the others are not */
    expect_places("uncertainty: [{path: 'options[*].forest[*].to_m', lo: 50, hi: 60}]\n"
                  "options: [{name: bare}, {name: wood, forest: [{" BELT "}}]}, {name: cut}]",
                  "options[1].forest[0].to_m");
    /* one stand has uncertainty, the other none */
    expect_places("forest: [{" BELT ", uncertainty: none}}, {from_m: 80, to_m: 90, stand: {trees: [{per_ha: 10, " TREE "}], "
                  "uncertainty: [{path: 'trees[0].per_ha', lo: 1, hi: 90}]}}]",
                  "forest[1].stand.trees[0].per_ha");
    expect_places(CLIFF_AND_TALUS "\n" GROUND_ROW, "slope.segments[1].rn");
}

/* A place has one path: with its number, even if a row gives its name. */
TEST_WITH(places_by_name, folder_set_up, folder_tear_down)
{
    static const char place[] = "options[1].forest[0].stand.trees[0].per_ha";
    static const char *const more[] = {"uncertainty: [{path: 'trees[0].per_ha', lo: 40, hi: 120}]", "source: {kind: assumed}"};
    for (size_t i = 0; i < LENGTH(more); i++) { /* the scene's row has precedence */
        struct text lines = {0};
        struct scene_file file;
        struct scene_inputs inputs;
        size_t found = 0;
        ceduo_text_format(&lines,
                          "uncertainty: [{path: 'options[wood].forest[trees].stand.trees[0].per_ha', lo: 70, hi: 90}]\n"
                          "options: [{name: bare}, {name: wood, forest: [{from_m: 10, to_m: 80, stand: {name: trees, "
                          "trees: [{per_ha: 80, " TREE "}], energy: {model: brauner, u_J_m3: 1e5}, %s}}]}]",
                          more[i]);
        read_scene(&file, lines.bytes, NULL, 0, NULL);
        assert_true(ceduo_inputs_collect(&file, &inputs));
        for (size_t k = 0; k < inputs.n; k++)
            for (size_t n = 0; n < inputs.items[k].places_count; n++)
                found += strcmp(inputs.items[k].places[n], place) == 0;
        assert_int_equal(found, 1);
        EXPECT(inputs.items[0].hi, ==, 90);
        assert_string_equal(inputs.items[0].places[0], place);
        ceduo_scene_release(&file);
        ceduo_text_free(&lines);
    }
    expect_places("uncertainty: [{path: 'forest[wood].to_m', lo: 50, hi: 60}]", "");
    expect_places("uncertainty: [{path: 'options[wood].forest[0].to_m', lo: 50, hi: 60}]\nforest: [{" BELT "}}]", "");
    expect_places("uncertainty: [{path: 'forest[wood].to_m', lo: 50, hi: 60}]\nforest: [{" BELT "}}]", "");
}

/* More places than the rows of any list. */
TEST_WITH(all_places_count, folder_set_up, folder_tear_down)
{
    LOCAL_TEXT(lines);
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    ceduo_text_append(&lines, "uncertainty: [{path: 'options[*].forest[*].stand.energy.u_J_m3', lo: 80000, hi: 120000}]\n"
                              "options:\n");
    for (int i = 0; i < 4; i++) {
        ceduo_text_format(&lines, "  - name: n%d\n    forest: [", i);
        for (int k = 0; k < 400; k++)
            ceduo_text_format(&lines, "{from_m: %g, to_m: %g, stand: {}},", k * 0.125, (k + 1) * 0.125);
        ceduo_text_append(&lines, "]\n");
    }
    read_scene(&file, lines.bytes, NULL, 0, NULL);
    assert_int_equal(file.inputs_count, 1);
    assert_int_equal(file.inputs[0].places_count, 1600);
    assert_string_equal(file.inputs[0].places[1599], "options[3].forest[399].stand.energy.u_J_m3");
}

/* Ranges and their sources are not inputs of the simulation. */
TEST_WITH(sources_of_ranges_are_no_notes, folder_set_up, folder_tear_down)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    read_scene(&file,
               "uncertainty: [{path: 'rock.density_kg_m3', lo: 2000, hi: 3000, source: {kind: assumed, text: mine}}]\n"
               "forest: [{" BELT ", uncertainty: [{path: stools.per_ha, lo: 1, hi: 9000, "
               "source: {kind: assumed, text: mine}}]}}]",
               NULL, 0, NULL);
    assert_int_equal(file.inputs_count, 2);
    for (const struct source_note *n = file.notes; n; n = n->before)
        assert_string_not_equal(n->text, "mine");
}

/* The number of an entry; NaN for a missing entry, for one that is not a number, and beyond the range of numbers. */
TEST_WITH(entries_have_numbers, folder_set_up, folder_tear_down)
{
    struct scene_file file;
    const char *const missing[] = {"1e999", "x"};
    for (size_t i = 0; i < LENGTH(missing); i++) {
        char title[32];
        snprintf(title, sizeof title, "title: %s", missing[i]);
        read_scene(&file, title, NULL, 0, NULL);
        const struct node *rock = ceduo_node_get(file.root, "rock");
        EXPECT(ceduo_node_number(rock, "diameter_m"), ==, 0.5);
        assert_true(isnan(ceduo_node_number(rock, "shape")));
        assert_true(isnan(ceduo_node_number(file.root, "title")));
        assert_true(isnan(ceduo_node_number(file.root, "rock")));
        ceduo_scene_release(&file);
    }
}

/* ---- draws ---- */

/* If the slope's file gives no ground, talus and segments mean those of all stretches; one column may set many. */
TEST_WITH(draws_of_an_assumed_ground, folder_set_up, folder_tear_down)
{
    static const char lines[] = "slope: {csv: profile.csv, tolerance_m: 0}\nuncertainty: {draws: draws.csv}";
    static const char *const places[] = {"rock.density_kg_m3", "slope.segments[0].rn", "slope.segments[0].rt", /* by name */
                                         "slope.segments[1].rn", "slope.segments[1].rt"};
    static const double values[] = {0.75, 0.25, 0.75, 0.25, 0.75};
    struct scene_file file;
    folder_write("profile.csv", "x,z\n0,50\n40,20\n100,0\n");
    folder_write("draws.csv", "slope.materials[talus].rn,slope.segments[*].rt rock.density_kg_m3\n0.5,0.5\n0.25,0.75\n");
    read_scene(&file, lines, NULL, 0, NULL);
    assert_int_equal(file.inputs[0].places_count, LENGTH(places));
    assert_int_equal(file.inputs[0].draws_count, 2);
    for (size_t i = 0; i < LENGTH(places); i++) {
        assert_string_equal(file.inputs[0].places[i], places[i]);
        EXPECT(file.inputs[0].draws[i][1], ==, values[i]);
    }
    ceduo_scene_release(&file);
    folder_write("draws.csv", "slope.materials[talus].rn\n0.25\n"); /* otherwise its place is in the file */
    read_scene(&file, "uncertainty: {draws: draws.csv}\n" CLIFF_AND_TALUS, NULL, 0, NULL);
    assert_int_equal(file.inputs[0].places_count, 1);
    assert_string_equal(file.inputs[0].places[0], "slope.segments[1].rn");
    ceduo_scene_release(&file);
}

/* A table with very many columns: all are read. */
TEST_WITH(draws_of_many_columns, folder_set_up, folder_tear_down)
{
    LOCAL_BY(ceduo_text_free) struct text profile = {0}, heads = {0}, draws = {0};
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    ceduo_text_append(&profile, "x,z\n");
    for (int i = 0; i <= 3000; i++)
        ceduo_text_format(&profile, "%d,%d\n", i, 3000 - i);
    for (int c = 0; c < 6000; c++) {
        ceduo_text_format(&heads, "%sslope.segments[%d].r%c", c > 0 ? "," : "", c / 2, "nt"[c % 2]);
        ceduo_text_format(&draws, "%s0.%04d", c > 0 ? "," : "\n", c);
    }
    ceduo_text_append(&heads, draws.bytes);
    folder_write("profile.csv", profile.bytes);
    folder_write("draws.csv", heads.bytes);
    read_scene(&file, "slope: {csv: profile.csv, tolerance_m: 0}\nuncertainty: {draws: draws.csv}", NULL, 0, NULL);
    assert_int_equal(file.inputs[0].places_count, 6000);
    for (size_t i = 0; i < 6000; i++) {
        int segment;
        char key;
        assert_int_equal(sscanf(file.inputs[0].places[i], "slope.segments[%d].r%c", &segment, &key), 2);
        EXPECT_NEAR(file.inputs[0].draws[i][0], (2 * segment + (key == 't')) / 1e4, 1e-12);
    }
}

/* ---- inputs ---- */

/* Return the belt of a place; a place that is not in a belt has none. */
TEST_WITH(places_have_belts, folder_set_up, folder_tear_down)
{
    struct scene_file file;
    read_scene(&file, "options: [{name: bare}, {name: wood, forest: [{" BELT "}}]}]", NULL, 0, NULL);
    const struct ceduo_scene *s = &file.scene;
    assert_ptr_equal(ceduo_input_belt(s, "options[1].forest[0].stand.stools.per_ha"), &s->options[1].belts[0]);
    const char *const missing[] = {"options[0].forest[0].to_m", "options[1].forest[1].to_m",
                                   "options[4000000000].forest[0].to_m", "forest[0].to_m", "rock.density_kg_m3"};
    for (size_t i = 0; i < LENGTH(missing); i++)
        assert_null(ceduo_input_belt(s, missing[i]));
    ceduo_scene_release(&file);
    read_scene(&file, "forest: [{" BELT "}}]", NULL, 0, NULL);
    assert_ptr_equal(ceduo_input_belt(&file.scene, "forest[0].to_m"), &file.scene.options[0].belts[0]);
    assert_null(ceduo_input_belt(&file.scene, "forest[1].to_m"));
    assert_null(ceduo_input_belt(&file.scene, "rock.density_kg_m3"));
    ceduo_scene_release(&file);
}

/* The wood strength of one species is one input wherever it occurs; another species is another input. */
TEST_WITH(strength_is_of_a_species, folder_set_up, folder_tear_down)
{
    static const char wood[] = "trees: [{per_ha: 10, " TREE "}], energy: {model: dorren, "
                               "fracture_ratio: 1.5, source: {kind: assumed}}";
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    struct scene_inputs inputs;
    LOCAL_TEXT(lines);
    ceduo_text_append(&lines, "rock: {diameter_m: 0.5, density_kg_m3: 2600, "
                              "source: {kind: assumed, except: [diameter_m]}}\noptions:\n");
    for (int i = 0; i < 2; i++)
        ceduo_text_format(&lines,
                          "  - {name: n%d, forest: [{from_m: 10, to_m: 20, stand: {species: acer, %s}}, "
                          "{from_m: 30, to_m: 40, stand: {species: fagus-sylvatica, %s}}]}\n",
                          i, wood, wood);
    read_scene(&file, lines.bytes, NULL, 0, NULL);
    assert_true(ceduo_inputs_collect(&file, &inputs));
    size_t strengths = 0;
    for (size_t i = 0; i < inputs.n; i++)
        if (strstr(inputs.items[i].path, "fracture_ratio")) {
            assert_int_equal(inputs.items[i].places_count, 2);
            strengths++;
        }
    assert_int_equal(strengths, 2);
    assert_string_equal(inputs.items[0].path, "rock.density_kg_m3");
}

/* Groups consist of trees: without trees, or with single ones, there are no groups. */
TEST_WITH(groups_are_of_trees, folder_set_up, folder_tear_down)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    read_scene(&file,
               "forest: [{from_m: 10, to_m: 80, stand: {trees: [{per_ha: 0, " TREE ", " GROUPS "}, "
               "{per_ha: 10, " TREE ", " GROUPS "}, {per_ha: 10, " TREE "}]}}]",
               NULL, 0, NULL);
    const struct ceduo_stems *trees = file.scene.options[0].belts[0].stand.trees;
    assert_false(ceduo_stems_are_grouped(&trees[0]));
    assert_true(ceduo_stems_are_grouped(&trees[1]));
    assert_false(ceduo_stems_are_grouped(&trees[2]));
}

/* ---- changes ---- */

/* A stand file without a name may get one; the stand is still the same. */
TEST_WITH(a_stand_may_get_a_name, folder_set_up, folder_tear_down)
{
    static const char *const sets[] = {"forest[0].stand.name=mine", "forest[0].stand.stools.per_ha=1500"};
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    folder_write("stand.yaml", "{ceduo: stand/1, " SHOOTS "}\n");
    read_scene(&file, "forest: [{from_m: 10, to_m: 80, stand: stand.yaml}]", sets, 2, NULL);
    assert_string_equal(file.scene.options[0].belts[0].name, "mine");
    assert_false(file.scene.options[0].belts[0].changed);
    EXPECT(file.scene.options[0].belts[0].stand.stools_per_ha, ==, 1500);
}

static size_t notes_of_mu(const struct scene_file *file)
{
    size_t n = 0;
    for (const struct source_note *note = file->notes; note; note = note->before)
        n += strstr(note->text, "friction mu") != NULL;
    return n;
}

/* Assumptions about a ground follow the contact law, also on an unchanged slope. */
TEST_WITH(another_law_has_other_assumptions, folder_set_up, folder_tear_down)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    folder_write("profile.csv", "x,z\n0,50\n40,20\n100,0\n");
    read_scene(&file, "slope: profile.csv", NULL, 0, NULL);
    assert_int_equal(notes_of_mu(&file), 0);
    const char *const laws[] = {"arm", "arm", "lumped"};
    for (size_t i = 0; i < LENGTH(laws); i++) {
        char set[64];
        snprintf(set, sizeof set, "simulation.law=%s", laws[i]);
        assert_true(ceduo_scene_set(&file, "--set", set, &problems));
        assert_true(ceduo_scene_bind(&file, &problems));
        assert_int_equal(notes_of_mu(&file), i < 2 ? 1 : 0);
    }
}

/* ---- problems, notes and ranges ---- */

/* A shape set by a change does not fit the sizes in the file; the proposed fix does. */
TEST(shapes_of_changes)
{
    const struct {
        const char *rock, *set;
    } rows[] = {{"rock: {shape: cylinder, diameter_m: 1, height_m: 2}", "rock.shape=sphere"},
                {"rock: {shape: block, axes_m: [1, 2, 3]}", "rock.shape=cylinder"},
                {"rock: {volume_m3: 0.1}", "rock.shape=cylinder"},
                {"rock: {diameter_m: 1}", "rock.shape=block"},
                {"rock: {diameter_m: 1}", "rock.shape=ellipsoid"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_BY(ceduo_scene_release) struct scene_file file;
        LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
        LOCAL_BY(ceduo_text_free) struct text text = scene_with(rows[i].rock);
        assert_true(ceduo_scene_load_text(&file, "scene", text.bytes, &problems));
        assert_true(ceduo_scene_set(&file, "--set", rows[i].set, &problems));
        assert_false(ceduo_scene_bind(&file, &problems));
        ceduo_problems_print(&problems);
        char *proposed = strstr(problems.text.bytes, "give the whole rock: -s '");
        assert_non_null(proposed);
        proposed += strlen("give the whole rock: -s '");
        *strchr(proposed, '\'') = '\0';
        struct problems missing = {0};
        if (!ceduo_scene_set(&file, "--set", proposed, &missing) || !ceduo_scene_bind(&file, &missing))
            fail_msg("%s: %s: %s", rows[i].rock, proposed, ceduo_problems_print(&missing));
    }
}

/* Equal problems appear once; a very long message keeps its beginning and end in whole characters; the number is limited. */
TEST(problems_are_put_together)
{
    struct problems problems = {0};
    const struct source source = {.name = "file", .bytes = "one\r\n\ttwo\n\nfour", .length = 15};
    ceduo_problem(&problems, &source, 1, 2, "a");
    ceduo_problem(&problems, &source, 1, 2, "a");
    ceduo_problem(&problems, &source, 2, 3, "b");
    ceduo_problem(&problems, &source, 3, 1, "empty");
    ceduo_problem(&problems, &source, 9, 1, "beyond");
    ceduo_problem(&problems, &source, 4, 90, "behind");
    ceduo_problem(&problems, &source, 4, 300, "far behind");
    ceduo_problem(&problems, &source, 0, 0, "whole");
    ceduo_problem(&problems, NULL, 3, 3, "nowhere");
    assert_string_equal(
        ceduo_problems_print(&problems),
        "file:1:2: a\n  one\n   ^\nfile:2:3: b\n   two\n    ^\nfile:3:1: empty\n"
        "file:9:1: beyond\nfile:4:90: behind\n  four\n      ^\nfile:4:300: far behind\n  \n  ^\nfile: whole\nnowhere\n");
    assert_int_equal(problems.wrong.count, 8);
    assert_int_equal(problems.met, 9);
    ceduo_problems_free(&problems);
    for (int shift = 0; shift < 3; shift++) {
        LOCAL_TEXT(word);
        for (int i = 0; i < shift; i++)
            ceduo_text_append_char(&word, 'x');
        for (int i = 0; i < 600; i++)
            ceduo_text_append(&word, "\xe2\x80\xa6");
        ceduo_problem(&problems, NULL, 0, 0, "%s end", word.bytes);
        assert_null(strstr(ceduo_problems_print(&problems), "\\x"));
        assert_non_null(strstr(ceduo_problems_print(&problems), "\xe2\x80\xa6 end\n"));
        EXPECT(problems.text.length, >, 900);
        EXPECT(problems.text.length, <, 1100);
        ceduo_problems_free(&problems);
    }
    char ends[1301] = {0}; /* continuation bytes alone leave nothing */
    memset(ends, '\x80', sizeof ends - 1);
    ceduo_problem(&problems, NULL, 0, 0, "%s", ends);
    assert_string_equal(ceduo_problems_print(&problems), "\xe2\x80\xa6\n");
    ceduo_problems_free(&problems);
    for (int i = 0; i < 5000; i++)
        ceduo_problem(&problems, NULL, 0, 0, "kind %c%c%c", 'a' + i / 676, 'a' + i / 26 % 26, 'a' + i % 26);
    assert_non_null(strstr(ceduo_problems_print(&problems), "kind aat\n"));
    assert_null(strstr(ceduo_problems_print(&problems), "kind aau\n"));
    assert_non_null(strstr(ceduo_problems_print(&problems), "4980 more problems\n"));
    ceduo_problems_free(&problems);
    for (int i = 0; i < 8; i++) /* one kind, no line */
        ceduo_problem(&problems, NULL, 0, 0, "kind %d", i);
    assert_string_equal(ceduo_problems_print(&problems), "kind 0\n  and 7 more of this kind\n");
    ceduo_problems_free(&problems);
}

/* The innermost mapping on the path gives a value's source. */
TEST(notes_are_found)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    LOCAL_BY(ceduo_text_free)
    struct text text = scene_with(
        "forest: [{from_m: 10, to_m: 80, source: {kind: assumed, text: belt}, stand: {source: {kind: measured, text: stand}, "
        "stools: {per_ha: 2000, spacing_m: 0.4, source: {kind: assumed, text: stools}}, shoots: [{per_ha: 6000, dbh_m: 0.06, "
        "height_m: 6}]}}, "
        /* its own source takes precedence over an outer one, in either order */
        "{from_m: 80, to_m: 84, stand: {source: {kind: measured, except: [energy]}, energy: {source: {kind: assumed, text: "
        "own}}}}, "
        "{from_m: 84, to_m: 90, stand: {energy: {source: {kind: assumed, text: own}}, source: {kind: measured, except: "
        "[energy]}}}]");
    if (!ceduo_scene_load_text(&file, "scene", text.bytes, &problems))
        fail_msg("%s", ceduo_problems_print(&problems));
    for (TABLE(row, "unit/sources.txt", "notes")) {
        const struct source_note *note = ceduo_notes_find(file.notes, row.at[0]);
        assert_string_equal(note ? note->text : "none", row.at[1]);
        assert_int_equal(ceduo_scene_assumes_value(&file, row.at[0]), strcmp(row.at[2], "assumed") == 0);
    }
    assert_true(ceduo_notes_print(file.notes, "assumed", "forest[0].stand"));
    assert_true(ceduo_notes_print(file.notes, "assumed", "forest"));
    assert_false(ceduo_notes_print(file.notes, "assumed", "forest[0].stand.shoots") ||
                 ceduo_notes_print(file.notes, "assumed", "forest[0].sta"));
}

/* ---- table of parameters ---- */

TEST(ranges_are_reported)
{
    for (TABLE(row, "unit/texts.txt", "ranges")) {
        LOCAL_TEXT(text);
        unsigned flags = (strstr(row.at[2], "above") ? FIELD_ABOVE : 0u) | (strstr(row.at[2], "below") ? FIELD_UNDER : 0u);
        const struct field f = {.lo = strtod(row.at[0], NULL), .hi = strtod(row.at[1], NULL), .flags = flags};
        assert_int_equal(ceduo_schema_range_text(&f, &text), row.at[3][0] != '\0');
        assert_string_equal(ceduo_text_string(&text), row.at[3]);
    }
}
