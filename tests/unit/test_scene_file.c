/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes as they are read: every fault is told once, where it is, and changes are put into them. */
#include "expect.h"
#include "local.h"

#include "folder.h"

#include <math.h>

#include "io/emit.h"
#include "io/scene_file.h"
#include "scene/schema.h"

/* A scene that is good, and one line of it in the place of another. */
static char *scene_with(const char *line)
{
    static const char *const lines[] = {
        "ceduo: scene/1\n",
        "rock: {diameter_m: 0.5, density_kg_m3: 2600}\n",
        "release: {vx_m_s: 1}\n",
        "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], segments: [{rn: 0.3, rt: 0.8, friction: 0.5}]}\n",
        "controls: [{x_m: 90}]\n",
        "simulation: {rocks: 10}\n",
        ("forest: [{from_m: 10, to_m: 80, stand: {stools: {per_ha: 2000, spacing_m: 0.4}, shoots: [{per_ha: 6000, dbh_m: "
         "0.06, height_m: 6}]}}]\n")};
    struct text text = {0};
    for (size_t i = 0; i < LENGTH(lines); i++) {
        size_t key = strcspn(lines[i], ":") + 1;
        bool other = strncmp(line, lines[i], key) == 0;
        ceduo_text_put(&text, other ? line : lines[i]);
        if (other)
            ceduo_text_char(&text, '\n');
    }
    return text.bytes;
}

/* A file where a stand should be; a base that is an option's; a slope of which there is nothing. */
TEST_WITH(files_that_are_followed, folder_set_up_profiles, folder_tear_down)
{
    static const char rest[] = "ceduo: scene/1\nrock: {diameter_m: 0.5}\ncontrols: [{x_m: 90}]\n";
    static const char slope[] = "slope: {vertices_m: [[0, 50], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n";
    static const char *const with_base[] = {"forest[0].stand={base: stand.yaml, stools: {per_ha: 1234}}"};
    const struct {
        const char *line, *told;
        const char *const *set;
    } rows[] = {
        {"forest: [{from_m: 10, to_m: 80, stand: five.yaml}]", "expected a mapping, not a single value", NULL},
        {"forest: [{from_m: 10, to_m: 80, stand: list.yaml}]", "expected a mapping, not a list", NULL},
        {"forest: [{from_m: 10, to_m: 80, stand: {base: five.yaml, name: x}}]", "expected a mapping, not a single value", NULL},
        {"forest: [{from_m: 10, to_m: 80, stand: {}}]", NULL, with_base}};
    put("five.yaml", "5\n");
    put("list.yaml", "- 5\n");
    put("stand.yaml",
        "ceduo: stand/1\nstools: {per_ha: 2000, spacing_m: 0.4}\nshoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\n");
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_BY(ceduo_scene_release) struct scene_file file;
        LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
        LOCAL_TEXT(text);
        char path[256];
        ceduo_text_format(&text, "%s%s%s\n", rest, slope, rows[i].line);
        put("scene.yaml", text.bytes);
        in_folder(path, "scene.yaml");
        bool good = ceduo_scene_load(&file, path, rows[i].set, rows[i].set != NULL, &problems);
        if (good != !rows[i].told || (!good && !strstr(problems.text.bytes, rows[i].told)))
            fail_msg("%s: %s", rows[i].line, problems.text.bytes);
        if (good) {
            const struct ceduo_stand *s = &file.scene.options[0].belts[0].stand;
            EXPECT(s->stools_per_ha, ==, 1234);
            EXPECT(s->spacing, ==, 0.4);
            EXPECT(s->shoots_count, ==, 1);
            EXPECT(s->shoots[0].per_ha, ==, 6000);
        }
    }
    char path[256];
    struct scene_file file;
    struct problems problems = {0};
    const char *const facets[] = {"slope.facets=both"};
    put("scene.yaml", rest);
    in_folder(path, "scene.yaml");
    assert_false(ceduo_scene_load(&file, path, facets, 1, &problems));
    assert_non_null(strstr(problems.text.bytes, "'vertices_m' is missing: the profile"));
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
}

/* A change takes its value out of the source around it: where that is no such thing as should be there, it stays and is
 * told. A key that a change makes has no place in the file. */
TEST(sources_of_changes)
{
    const struct {
        const char *source, *set, *told;
    } rows[] = {{"{kind: measured, except: [volume_m3]}", "rock.diameter_m=0.6", NULL},
                {"{kind: measured, except: {a: b}}", "rock.diameter_m=0.6", "source.except: expected a list of keys"},
                {"by hand", "rock.diameter_m=0.6", "source: expected a mapping {kind, text}"},
                {"{kind: measured, except: volume_m3}", "rock.diameter_m=0.6", "source.except: expected a list of keys"},
                {"{kind: measured, except: [[volume_m3]]}", "rock.diameter_m=0.6", "source.except: expected a key, not a list"},
                {"{kind: measured}", "rock.source.wide=1",
                 "--set:1:18: rock.source.wide: unknown key; known here: kind, text, text_it, except"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_BY(ceduo_scene_release) struct scene_file file;
        struct problems problems = {0};
        LOCAL_BY(ceduo_text_free) struct text line = {0}, rock = {0};
        ceduo_text_format(&line, "rock: {diameter_m: 0.5, density_kg_m3: 2600, source: %s}", rows[i].source);
        LOCAL_BYTES char *text = scene_with(line.bytes);
        bool good = ceduo_scene_load_text(&file, "scene", text, &problems);
        ceduo_problems_free(&problems);
        assert_int_equal(good, i == 0 || i == 5);
        const struct node *before = ceduo_node_get(ceduo_node_get(file.root, "rock"), "source");
        assert_true(ceduo_scene_set(&file, "--set", rows[i].set, &problems));
        const struct node *now = ceduo_node_get(ceduo_node_get(file.root, "rock"), "source");
        assert_int_equal(now == before, i > 0 && i < 4); /* a list is added to, whatever is in it */
        assert_int_equal(ceduo_scene_bind(&file, &problems), !rows[i].told);
        if (rows[i].told && !strstr(problems.text.bytes, rows[i].told))
            fail_msg("%s: %s", rows[i].set, problems.text.bytes);
        if (!rows[i].told) {
            ceduo_emit_flow(&rock, ceduo_node_get(file.root, "rock"));
            assert_string_equal(rock.bytes,
                                "{diameter_m: 0.6, density_kg_m3: 2600, source: {kind: measured, except: [volume_m3, "
                                "diameter_m]}}");
        }
        ceduo_problems_free(&problems);
    }
}

/* A shape that a change sets does not go with the sizes of the file: what is proposed instead does. */
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
        LOCAL_BYTES char *text = scene_with(rows[i].rock);
        assert_true(ceduo_scene_load_text(&file, "scene", text, &problems));
        assert_true(ceduo_scene_set(&file, "--set", rows[i].set, &problems));
        assert_false(ceduo_scene_bind(&file, &problems));
        char *proposed = strstr(problems.text.bytes, "give the whole rock: -s '");
        assert_non_null(proposed);
        proposed += strlen("give the whole rock: -s '");
        *strchr(proposed, '\'') = '\0';
        struct problems none = {0};
        if (!ceduo_scene_set(&file, "--set", proposed, &none) || !ceduo_scene_bind(&file, &none))
            fail_msg("%s: %s: %s", rows[i].rock, proposed, none.text.bytes);
    }
}

/* Grounds that end where a vertex is, or behind the profile, split no segment; one that ends within does. */
TEST(grounds_split_segments)
{
    const struct {
        const char *materials;
        size_t vertices;
    } rows[] = {{"{from_m: 0, to_m: 100, material: cliff}", 3},
                {"{from_m: 0, to_m: 40, material: cliff}, {from_m: 40, to_m: 100, material: talus}", 3},
                {"{from_m: 0, to_m: 50, material: cliff}, {from_m: 50, to_m: 100, material: talus}", 4},
                {"{from_m: 0, to_m: 100, material: cliff}, {from_m: 100, to_m: 120, material: talus}", 3},
                {"{from_m: 0, to_m: 10, material: cliff}, {from_m: 10, to_m: 30, material: talus}, {from_m: 30, to_m: 120, "
                 "material: colluvium}",
                 5}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_BY(ceduo_scene_release) struct scene_file file;
        LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
        LOCAL_TEXT(line);
        ceduo_text_format(&line, "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], materials: [%s]}", rows[i].materials);
        LOCAL_BYTES char *text = scene_with(line.bytes);
        assert_true(ceduo_scene_load_text(&file, "scene", text, &problems));
        const struct ceduo_slope *s = &file.scene.slope;
        assert_int_equal(s->vertices, rows[i].vertices);
        for (size_t v = 0; v < s->vertices; v++) {
            double x = s->x[v], z = x < 40 ? 50 - x * 30 / 40 : 20 - (x - 40) * 20 / 60;
            EXPECT(fabs(s->z[v] + s->origin_z - z), <, 1e-12);
        }
        assert_true(ceduo_scene_assumes_value(&file, "slope.materials[0].material"));
        assert_false(ceduo_scene_assumes_value(&file, "slope.vertices_m[0]"));
    }
}

/* The same fault once; of a message without end the beginning and the end, whole characters; none beyond so many. */
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
        problems.text.bytes,
        "file:1:2: a\n  one\n   ^\nfile:2:3: b\n   two\n    ^\nfile:3:1: empty\n"
        "file:9:1: beyond\nfile:4:90: behind\n  four\n      ^\nfile:4:300: far behind\n  \n  ^\nfile: whole\nnowhere\n");
    assert_int_equal(problems.count, 8);
    assert_int_equal(problems.met, 9);
    ceduo_problems_free(&problems);
    for (int shift = 0; shift < 3; shift++) {
        LOCAL_TEXT(word);
        for (int i = 0; i < shift; i++)
            ceduo_text_char(&word, 'x');
        for (int i = 0; i < 600; i++)
            ceduo_text_put(&word, "\xe2\x80\xa6");
        ceduo_problem(&problems, NULL, 0, 0, "%s end", word.bytes);
        assert_null(strstr(problems.text.bytes, "\\x"));
        assert_non_null(strstr(problems.text.bytes, "\xe2\x80\xa6 end\n"));
        EXPECT(problems.text.length, >, 900);
        EXPECT(problems.text.length, <, 1100);
        ceduo_problems_free(&problems);
    }
    char ends[1301] = {0}; /* of nothing but ends of characters neither beginning nor end is left */
    memset(ends, '\x80', sizeof ends - 1);
    ceduo_problem(&problems, NULL, 0, 0, "%s", ends);
    assert_string_equal(problems.text.bytes, "\xe2\x80\xa6\n");
    ceduo_problems_free(&problems);
    for (int i = 0; i < 5000; i++)
        ceduo_problem(&problems, NULL, 0, 0, "kind %c%c%c", 'a' + i / 676, 'a' + i / 26 % 26, 'a' + i % 26);
    ceduo_problems_close(&problems);
    assert_non_null(strstr(problems.text.bytes, "kind aat\n"));
    assert_null(strstr(problems.text.bytes, "kind aau\n"));
    assert_non_null(strstr(problems.text.bytes, "4980 more problems\n"));
    ceduo_problems_free(&problems);
}

/* Where a value comes from is said by the innermost mapping on the way to it. */
TEST(notes_are_found)
{
    LOCAL_BY(ceduo_scene_release) struct scene_file file;
    LOCAL_BY(ceduo_problems_free) struct problems problems = {0};
    LOCAL_BYTES char *text = scene_with(
        "forest: [{from_m: 10, to_m: 80, source: {kind: assumed, text: belt}, stand: {source: {kind: measured, text: stand}, "
        "stools: {per_ha: 2000, spacing_m: 0.4, source: {kind: assumed, text: stools}}, shoots: [{per_ha: 6000, dbh_m: 0.06, "
        "height_m: 6}]}}, "
        /* its own source goes before one that is not of it, whichever is given first */
        "{from_m: 80, to_m: 84, stand: {source: {kind: measured, except: [energy]}, energy: {source: {kind: assumed, text: "
        "own}}}}, "
        "{from_m: 84, to_m: 90, stand: {energy: {source: {kind: assumed, text: own}}, source: {kind: measured, except: "
        "[energy]}}}]");
    if (!ceduo_scene_load_text(&file, "scene", text, &problems))
        fail_msg("%s", problems.text.bytes);
    const struct {
        const char *path, *note;
        bool assumed;
    } rows[] = {{"forest[0].to_m", "belt", true},
                {"forest[0]", "belt", true},
                {"forest[0].stand", "stand", false},
                {"forest[0].stand.name", "stand", false},
                {"forest[0].standing", "belt", true},
                {"forest[0].stand.stools.per_ha", "stools", true},
                {"forest[0].stand.shoots[0].dbh_m", "stand", false},
                {"forest[1].to_m", NULL, false},
                {"forest[1].stand.energy.model", "own", true},
                {"forest[2].stand.energy.model", "own", true},
                {"release", NULL, false}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        const struct source_note *note = ceduo_notes_find(file.notes, rows[i].path);
        assert_int_equal(note != NULL, rows[i].note != NULL);
        if (note)
            assert_string_equal(note->text, rows[i].note);
        assert_int_equal(ceduo_scene_assumes_value(&file, rows[i].path), rows[i].assumed);
    }
    assert_true(ceduo_notes_assume(file.notes, "forest[0].stand"));
    assert_true(ceduo_notes_assume(file.notes, "forest"));
    assert_false(ceduo_notes_assume(file.notes, "forest[0].stand.shoots") || ceduo_notes_assume(file.notes, "forest[0].sta"));
}

/* ---- the table of parameters ---- */

TEST(ranges_are_told)
{
    const struct {
        double lo, hi;
        unsigned flags;
        const char *text;
    } rows[] = {{-INFINITY, INFINITY, 0, ""},
                {0, INFINITY, 0, ">= 0"},
                {0, INFINITY, FIELD_ABOVE, "> 0"},
                {0, 1, 0, "0…1"},
                {0, 1, FIELD_ABOVE | FIELD_UNDER, ">0\xe2\x80\xa6<1"},
                {-INFINITY, 5, 0, "…5"},
                {-1e9, 1e9, 0, "-1e+09…1e+09"},
                {0, 9007199254740992.0, 0, "0…9007199254740992"}};
    for (size_t i = 0; i < LENGTH(rows); i++) {
        LOCAL_TEXT(text);
        const struct field f = {.lo = rows[i].lo, .hi = rows[i].hi, .flags = rows[i].flags};
        assert_int_equal(ceduo_schema_range_text(&f, &text), rows[i].text[0] != '\0');
        assert_string_equal(ceduo_text_string(&text), rows[i].text);
    }
}
