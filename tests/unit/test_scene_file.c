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
