/* SPDX-License-Identifier: GPL-3.0-or-later */
/* tags: brief */
/* Typed and displayed values compared with those in files: centimetres, decimal commas, pairs, ranges, uncertainties. */
#include "local.h"
#include "table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "view/value_text.h"

#define DBH "forest[0].stand.shoots[0].dbh_m"

TEST(numbers_have_one_sign)
{
    for (TABLE(row, "unit/typed.txt", "numbers")) {
        double value = NAN, wanted = strcmp(row.at[1], "none") == 0 ? NAN : atof(row.at[1]);
        bool good = ceduo_input_parse_number(row.at[0], &value) == CEDUO_NUMBER_GOOD;
        if (good != !isnan(wanted) || (good && value != wanted))
            fail_msg("'%s' is read as %g", row.at[0], value);
    }
}

TEST(files_keep_their_units)
{
    for (TABLE(row, "unit/typed.txt", "values")) {
        LOCAL_TEXT(text);
        const struct field *f = ceduo_schema_at(row.at[0]);
        assert_non_null(f);
        ceduo_input_parse_value(f, row.at[1], &text);
        assert_string_equal(ceduo_text_string(&text), row.at[2]);
    }
}

TEST(screens_have_words_and_centimetres)
{
    for (TABLE(row, "unit/typed.txt", "shown")) {
        LOCAL_TEXT(text);
        ceduo_format_value(ceduo_schema_at(row.at[0]), row.at[1], &text);
        assert_string_equal(ceduo_text_string(&text), row.at[2]);
    }
}

TEST(every_diameter_reads_back)
{
    for (int i = 1; i < 20000; i++) {
        LOCAL_BY(ceduo_text_free) struct text shown = {0}, file = {0};
        char written[CEDUO_NUMBER_SIZE];
        ceduo_number_shortest(i / 10000.0, written);
        ceduo_format_value(ceduo_schema_at(DBH), written, &shown);
        ceduo_input_parse_value(ceduo_schema_at(DBH), ceduo_text_string(&shown), &file);
        assert_string_equal(ceduo_text_string(&file), written);
    }
}

TEST(ranges_and_uncertainties)
{
    for (TABLE(row, "unit/typed.txt", "ranges")) {
        LOCAL_TEXT(why);
        const struct field *f = ceduo_schema_at(row.at[0]);
        bool in_range = ceduo_input_is_in_range(f, row.at[1], &why);
        bool unusual = in_range && ceduo_input_is_unusual(f, row.at[1], &why);
        assert_string_equal(!in_range ? "refused" : unusual ? "unusual" : "usual", row.at[2]);
        if (!strstr(ceduo_text_string(&why), row.at[3]))
            fail_msg("%s: '%s': '%s'", row.at[0], row.at[1], ceduo_text_string(&why));
    }
}

TEST(profiles_are_typed)
{
    for (TABLE(row, "unit/typed.txt", "profiles")) {
        LOCAL_TEXT(yaml);
        double first, last;
        bool good = ceduo_input_parse_points(row.at[0], &yaml, &first, &last);
        assert_string_equal(good ? ceduo_text_string(&yaml) : "none", row.at[1]);
    }
}

TEST(paths_in_words)
{
    for (TABLE(row, "unit/typed.txt", "paths")) {
        LOCAL_TEXT(text);
        ceduo_format_path(row.at[0], &text);
        assert_string_equal(ceduo_text_string(&text), row.at[1]);
    }
}

/* Kinds of the targets of --set and of the heads of a table, below values and mappings, too. */
TEST(targets_have_kinds)
{
    static const char *const kinds[] = {"unknown", "text", "file", "number", "word", "other"};
    for (TABLE(row, "unit/typed.txt", "targets")) {
        enum path_value kind = ceduo_schema_value(row.at[0]);
        if (strcmp(kinds[kind], row.at[1]) != 0)
            fail_msg("%s is %s", row.at[0], kinds[kind]);
    }
}

TEST(only_known_values_are_settled)
{
    assert_true(ceduo_schema_is_settled("simulation.rocks"));
    assert_false(ceduo_schema_is_settled("rock.diameter_m"));
    assert_false(ceduo_schema_is_settled("no.such.path"));
}

static void check_label(void *context, const char *path, const struct field *f)
{
    (void)context;
    if (!f->shown.label || !f->shown.label[0] || strchr(f->shown.label, '_') || !(f->shown.per > 0))
        fail_msg("%s has no label for people", path);
    if (f->shown.unit && f->shown.per == 1)
        fail_msg("%s: a unit of its own, but the number is the file's", path);
}

TEST(every_key_has_a_label)
{
    ceduo_schema_visit(ceduo_schema_scene(), "", check_label, NULL);
}
