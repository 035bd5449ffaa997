/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a person types and sees, against what stands in files: centimetres, decimal commas, pairs, ranges, doubts. */
#include "expect.h"
#include "local.h"

#include <math.h>
#include <string.h>

#include "view/typed.h"

#define DBH "forest[0].stand.shoots[0].dbh_m"

static void typed_is(const char *path, const char *typed, const char *file)
{
    LOCAL_TEXT(text);
    const struct field *f = ceduo_schema_at(path);
    assert_non_null(f);
    ceduo_typed_value(f, typed, &text);
    assert_string_equal(ceduo_text_string(&text), file);
}

TEST(numbers_have_one_sign)
{
    static const struct {
        const char *typed;
        double value; /* NaN: none */
    } cases[] = {{"7.5", 7.5},     {"7,5", 7.5},     {" 7,5 ", 7.5}, {"-0,5", -0.5}, {",5", 0.5}, {"1e3", 1000}, {"9", 9},
                 {"1.000,5", NAN}, {"1,000,5", NAN}, {"7,", 7},      {"", NAN},      {"x", NAN},  {"0x10", NAN}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double value = NAN;
        bool good = ceduo_typed_number(cases[i].typed, &value) == CEDUO_NUMBER_GOOD;
        if (good != !isnan(cases[i].value) || (good && value != cases[i].value))
            fail_msg("'%s' is read as %g", cases[i].typed, value);
    }
}

TEST(files_keep_their_units)
{
    typed_is(DBH, "9", "0.09");
    typed_is(DBH, "7,5", "0.075");
    typed_is(DBH, "6.1", "0.061");
    typed_is(DBH, "0,7", "0.007");
    typed_is(DBH, "x", "x");
    typed_is("forest[0].stand.trees[1].height_m", "7,5", "7.5");
    typed_is("forest[0].stand.trees[1].height_m", "7.50", "7.50");
    typed_is("forest[0].stand.cutting.stay_per_ha", "30 12,5", "[30, 12.5]");
    typed_is("forest[0].stand.cutting.stay_per_ha", "[30, 30]", "[30, 30]");
    typed_is("rock.axes_m", "1 0,8 0,5", "[1, 0.8, 0.5]");
    typed_is("rock.density_kg_m3", "2600 \xc2\xb1 50", "{mean: 2600, spread: 50}");
    typed_is("rock.diameter_m", "0,6 +- 0,1 u", "{mean: 0.6, spread: 0.1, kind: uniform}");
    typed_is("slope.vertices_m", "60,5 35", "[60.5, 35]");
    typed_is("slope.vertices_m", "60, 35", "[60, 35]");
    typed_is("slope.vertices_m", "[0, 1]", "[0, 1]");
    typed_is("title", "a, b", "a, b");
}

static void shown_is(const char *path, const char *file, const char *shown)
{
    LOCAL_TEXT(text);
    ceduo_shown_value(ceduo_schema_at(path), file, &text);
    assert_string_equal(ceduo_text_string(&text), shown);
}

TEST(screens_have_words_and_centimetres)
{
    shown_is(DBH, "0.061", "6.1");
    shown_is(DBH, "0.07", "7");
    shown_is(DBH, "0.1145", "11.45");
    shown_is("forest[0].stand.trees[0].height_m", "0.80", "0.80");
    shown_is("forest[0].stand.species", "ostrya-carpinifolia", "hop hornbeam (Ostrya carpinifolia)");
    shown_is("forest[0].stand.species", "acer", "maple (Acer)");
    shown_is("forest[0].stand.system", "simple-coppice", "simple coppice");
}

TEST(every_diameter_reads_back)
{
    for (int i = 1; i < 20000; i++) {
        LOCAL_BY(ceduo_text_free) struct text shown = {0}, file = {0};
        char written[CEDUO_NUMBER_ROOM];
        ceduo_number_shortest(i / 10000.0, written);
        ceduo_shown_value(ceduo_schema_at(DBH), written, &shown);
        ceduo_typed_value(ceduo_schema_at(DBH), ceduo_text_string(&shown), &file);
        assert_string_equal(ceduo_text_string(&file), written);
    }
}

TEST(ranges_and_doubts)
{
    static const struct {
        const char *path, *typed;
        bool in_range, unusual;
        const char *words;
    } cases[] = {{DBH, "9", true, false, ""},
                 {DBH, "900", true, true, "900 cm? Usual is 1 to 200"},
                 {DBH, "0.09", true, true, "0.09 cm?"},
                 {DBH, "-9", false, true, "-9 is below 0 cm"},
                 {DBH, "0", false, false, "0 itself"},
                 {DBH, "1001", false, true, "1001 is above 1000 cm"},
                 {DBH, "many", true, false, ""},
                 {"forest[0].stand.trees[0].height_m", "120", true, true, "120 m? Usual is 0.5 to 50"},
                 {"rock.diameter_m", "60", true, true, "60 m?"},
                 {"rock.diameter_m", "0,6", true, false, ""}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        LOCAL_TEXT(why);
        const struct field *f = ceduo_schema_at(cases[i].path);
        bool in_range = ceduo_typed_in_range(f, cases[i].typed, &why);
        bool unusual = in_range && ceduo_typed_unusual(f, cases[i].typed, &why);
        if (in_range != cases[i].in_range || (in_range && unusual != cases[i].unusual) ||
            !strstr(ceduo_text_string(&why), cases[i].words))
            fail_msg("%s: '%s': %d, %d, '%s'", cases[i].path, cases[i].typed, in_range, unusual, ceduo_text_string(&why));
    }
}

TEST(profiles_are_typed)
{
    static const struct {
        const char *typed, *vertices; /* NULL: none */
    } cases[] = {{"0 60, 20 35, 100 12", "[[0, 60], [20, 35], [100, 12]]"},
                 {"0 60 20 35", "[[0, 60], [20, 35]]"},
                 {"0 60,20 35,40 20", "[[0, 60], [20, 35], [40, 20]]"},
                 {"0,5 60,2; 20,5 35", "[[0.5, 60.2], [20.5, 35]]"},
                 {"0,5 60,2 20,5 35,1", "[[0.5, 60.2], [20.5, 35.1]]"},
                 {"0 100, 40 60; 90 20", "[[0, 100], [40, 60], [90, 20]]"},
                 {"0 10", NULL},
                 {"0 10 20", NULL},
                 {"ten by ten", NULL},
                 {"", NULL},
                 {"0 60, 20 x", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        LOCAL_TEXT(yaml);
        double first, last;
        bool good = ceduo_typed_points(cases[i].typed, &yaml, &first, &last);
        if (good != (cases[i].vertices != NULL) || (good && strcmp(ceduo_text_string(&yaml), cases[i].vertices) != 0))
            fail_msg("'%s': '%s'", cases[i].typed, ceduo_text_string(&yaml));
    }
}

TEST(paths_in_words)
{
    static const char *const cases[][2] = {
        {"forest[1].stand.stools.per_ha", "stools per ha, belt 2"},
        {"options[standards].forest[0].stand.shoots[1].dbh_m", "diameter, cm, shoots 2, belt 1, option 'standards'"},
        {"forest[1].stand.shoots[0].per_stool", "shoots per stool, shoots 1, belt 2"},
        {"forest[1]", "belt 2"},
        {"rock.diameter_m", "diameter, m"},
        {"controls[0].accepted_kJ", "withstands, kJ, control 1"},
        {"no.such.path", "no.such.path"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        LOCAL_TEXT(text);
        ceduo_shown_path(cases[i][0], &text);
        assert_string_equal(ceduo_text_string(&text), cases[i][1]);
    }
}

static void look_at_label(void *context, const char *path, const struct field *f)
{
    (void)context;
    if (!f->shown.label || !f->shown.label[0] || strchr(f->shown.label, '_') || !(f->shown.per > 0))
        fail_msg("%s has no label for people", path);
    if (f->shown.unit && f->shown.per == 1)
        fail_msg("%s: a unit of its own, but the number is the file's", path);
}

TEST(every_key_has_a_label)
{
    ceduo_schema_visit(ceduo_schema_scene(), "", look_at_label, NULL);
}
