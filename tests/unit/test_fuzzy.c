/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Filtering a list by typed text: its letters in order, matches at word starts first. */
#include "table.h"

#include "base/text.h"
#include "tui/picker.h"

TEST(letters_match_in_order)
{
    for (TABLE(row, "unit/words.txt", "letters in their order"))
        assert_string_equal(ceduo_fuzzy_match(row.at[0], row.at[1]) >= 0 ? "matches" : "not", row.at[2]);
}

TEST(word_starts_and_runs_match_better)
{
    for (TABLE(row, "unit/words.txt", "better and worse"))
        EXPECT(ceduo_fuzzy_match(row.at[0], row.at[1]), >, ceduo_fuzzy_match(row.at[0], row.at[2]));
}

TEST(the_best_match_comes_first)
{
    struct picker p = {0};
    ceduo_picker_add(&p, "beech-large-reserves", "beech-large-reserves", "1", false);
    ceduo_picker_add(&p, "large-reserves", "large-reserves", "2", true);
    ceduo_picker_add(&p, "large-reserves-cut", "large-reserves-cut", "3", false);
    ceduo_picker_add(&p, "bare", "bare", "4", false);
    ceduo_picker_filter(&p, "");
    assert_string_equal(ceduo_picker_selected(&p)->value, "2"); /* the current value */
    ceduo_picker_filter(&p, "large");
    assert_int_equal(p.matches, 3);
    assert_string_equal(ceduo_picker_selected(&p)->value, "2"); /* first of two equal matches */
    viewport_move(&p.lines, 100);
    assert_string_equal(ceduo_picker_selected(&p)->value, "1");
    ceduo_picker_filter(&p, "zzz");
    assert_null(ceduo_picker_selected(&p));
    ceduo_picker_filter(&p, "");
    assert_int_equal(p.matches, 4);
    assert_string_equal(ceduo_picker_selected(&p)->value, "2");
    ceduo_picker_clear(&p);
}

TEST(paths_are_completed)
{
    struct picker p = {0};
    struct line line = {.text = ""};
    ceduo_picker_add(&p, "maps/north.csv", "maps/north.csv", "maps/north.csv", false);
    ceduo_picker_add(&p, "maps/northwest.csv", "maps/northwest.csv", "maps/northwest.csv", false);
    ceduo_picker_add(&p, "other/", "other/", "other/", false);
    assert_false(ceduo_picker_complete(&p, &line)); /* nothing in common */
    ceduo_line_set(&line, "ma");
    assert_true(ceduo_picker_complete(&p, &line));
    assert_string_equal(line.text, "maps/north");
    assert_false(ceduo_picker_complete(&p, &line));
    ceduo_line_set(&line, "maps/northw");
    assert_true(ceduo_picker_complete(&p, &line));
    assert_string_equal(line.text, "maps/northwest.csv");
    ceduo_line_set(&line, "none");
    assert_false(ceduo_picker_complete(&p, &line));
    ceduo_picker_clear(&p);
}
