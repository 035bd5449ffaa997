/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"
#include "table.h"
#include "unit/grid.h"

/* ---- cells ---- */

TEST(sizes_are_limited)
{
    assert_null(ceduo_cells_create(0, 10, BRAILLE));
    assert_null(ceduo_cells_create(10, 0, BRAILLE));
    assert_null(ceduo_cells_create(-1, -1, BRAILLE));
    assert_null(ceduo_cells_create(1001, 10, BRAILLE));
    assert_null(ceduo_cells_create(10, 501, BRAILLE));
    ceduo_cells_free(cells_in(1000, 500, BRAILLE));
    ceduo_cells_free(NULL);
}

TEST(blank_canvas_is_empty_rows)
{
    LOCAL(ceduo_cells, cells) = cells_in(4, 2, BRAILLE);
    assert_int_equal(ceduo_cells_glyph(cells, 0, 0), ' ');
    assert_int_equal(ceduo_cells_glyph(cells, -1, 7), ' ');
    assert_int_equal(ceduo_cells_role(cells, 4, 0), CEDUO_ROLE_BLANK);
}

TEST(text_of_a_row_ends_at_its_last_character)
{
    LOCAL(ceduo_cells, cells) = cells_in(5, 2, BRAILLE);
    LOCAL_TEXT(text);
    ceduo_cells_label(cells, 0, 0, CEDUO_ROLE_TEXT, "a±b  ");
    ceduo_cells_text(cells, 0, &text);
    ceduo_cells_text(cells, 2, &text);
    assert_string_equal(text.bytes, "a±b");
}

/* ---- roles ---- */

TEST(rank_decides_the_role_in_any_order)
{
    static const enum ceduo_role falling[] = {
        CEDUO_ROLE_CURSOR, CEDUO_ROLE_TRAJECTORY, CEDUO_ROLE_CONTROL, CEDUO_ROLE_MEAN, CEDUO_ROLE_ENVELOPE, CEDUO_ROLE_STEM,
        CEDUO_ROLE_STOOL,  CEDUO_ROLE_GROUND,     CEDUO_ROLE_CLOUD,   CEDUO_ROLE_AXIS, CEDUO_ROLE_DIM,
    };
    LOCAL(ceduo_cells, cells) = cells_in(2, 1, BRAILLE);
    struct ceduo_frame frame = frame_in_dots(cells);
    for (size_t i = 1; i < sizeof falling / sizeof falling[0]; ++i) {
        ceduo_cells_clear(cells);
        draw_point(cells, &frame, falling[i - 1], 0, 0);
        draw_point(cells, &frame, falling[i], 1, 0);
        draw_point(cells, &frame, falling[i], 2, 0);
        draw_point(cells, &frame, falling[i - 1], 3, 0);
        assert_int_equal(ceduo_cells_role(cells, 0, 0), falling[i - 1]);
        assert_int_equal(ceduo_cells_role(cells, 1, 0), falling[i - 1]);
        expect_text(cells, "⣀⣀\n"); /* the dots of both are visible */
    }
}

/* ---- text ---- */

TEST(odd_characters_become_question_marks)
{
    LOCAL(ceduo_cells, utf8) = cells_in(12, 1, BRAILLE);
    LOCAL(ceduo_cells, ascii) = cells_in(12, 1, ASCII);
    for (TABLE(row, "unit/texts.txt", "characters of a picture")) {
        ceduo_cells_label(utf8, 0, 0, CEDUO_ROLE_TEXT, row.at[0]);
        ceduo_cells_label(ascii, 0, 0, CEDUO_ROLE_TEXT, row.at[0]);
        expect_and_clear(utf8, row.at[1]);
        expect_and_clear(ascii, row.at[2]);
    }
}

TEST(ascii_has_near_equivalents)
{
    LOCAL(ceduo_cells, ascii) = cells_in(12, 1, ASCII);
    LOCAL(ceduo_cells, block) = cells_in(12, 1, BLOCK);
    for (TABLE(row, "unit/texts.txt", "near equivalents")) {
        LOCAL_TEXT(text);
        LOCAL_TEXT(other);
        ceduo_cells_label(ascii, 0, 0, CEDUO_ROLE_TEXT, row.at[0]);
        ceduo_cells_text(ascii, 0, &text);
        assert_string_equal(text.bytes, row.at[1]);
        ceduo_cells_label(block, 0, 0, CEDUO_ROLE_TEXT, row.at[0]);
        ceduo_cells_text(block, 0, &other);
        assert_string_equal(other.bytes, row.at[0]);
        ceduo_cells_clear(ascii);
        ceduo_cells_clear(block);
    }
    assert_int_equal(ceduo_cells_label_width(ASCII, "±0.3…"), 8);
    assert_int_equal(ceduo_cells_label_width(BRAILLE, "±0.3…"), 5);
    assert_int_equal(ceduo_cells_label_width(BRAILLE, ""), 0);
}
