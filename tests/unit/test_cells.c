/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"
#include "table.h"
#include "unit/grid.h"

/* ---- The cells ---- */

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
    expect_text(cells, "\n\n");
    expect_roles(cells, "\n\n");
    assert_int_equal(ceduo_cells_glyph(cells, 0, 0), ' ');
    assert_int_equal(ceduo_cells_glyph(cells, -1, 7), ' ');
    assert_int_equal(ceduo_cells_role(cells, 4, 0), CEDUO_ROLE_BLANK);
}

TEST(each_dot_has_its_glyph)
{
    static const struct {
        enum ceduo_charset charset;
        const char *glyphs[4][2]; /* row from the top, column */
    } sets[] = {
        {BRAILLE, {{"⠁\n", "⠈\n"}, {"⠂\n", "⠐\n"}, {"⠄\n", "⠠\n"}, {"⡀\n", "⢀\n"}}},
        {BLOCK, {{"▘\n", "▝\n"}, {"▖\n", "▗\n"}}},
        {ASCII, {{"'\n"}, {".\n"}}},
    };
    for (size_t i = 0; i < 3; ++i) {
        LOCAL(ceduo_cells, cells) = cells_in(2, 1, sets[i].charset);
        struct ceduo_frame frame = dots_of(cells);
        for (int y = 0; y < cells->canvas.dots_y; ++y) {
            for (int x = 0; x < cells->canvas.dots_x; ++x) {
                draw_point(cells, &frame, CEDUO_ROLE_WAY, x, frame.y1 - y);
                expect_and_clear(cells, sets[i].glyphs[y][x]);
            }
        }
    }
}

TEST(all_quadrants)
{
    LOCAL(ceduo_cells, cells) = cells_in(16, 1, BLOCK);
    struct ceduo_frame frame = dots_of(cells);
    for (int mask = 0; mask < 16; ++mask) {
        for (int bit = 0; bit < 4; ++bit) {
            if (mask >> bit & 1) {
                draw_point(cells, &frame, CEDUO_ROLE_WAY, 2 * mask + bit % 2, 1 - bit / 2);
            }
        }
    }
    expect_text(cells, " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█\n");
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

/* ---- Roles ---- */

TEST(rank_decides_the_role_whoever_draws_first)
{
    static const enum ceduo_role falling[] = {
        CEDUO_ROLE_CURSOR, CEDUO_ROLE_WAY,    CEDUO_ROLE_CONTROL, CEDUO_ROLE_MEAN, CEDUO_ROLE_ENVELOPE, CEDUO_ROLE_STEM,
        CEDUO_ROLE_STOOL,  CEDUO_ROLE_GROUND, CEDUO_ROLE_CLOUD,   CEDUO_ROLE_AXIS, CEDUO_ROLE_DIM,
    };
    LOCAL(ceduo_cells, cells) = cells_in(2, 1, BRAILLE);
    struct ceduo_frame frame = dots_of(cells);
    for (size_t i = 1; i < sizeof falling / sizeof falling[0]; ++i) {
        ceduo_cells_clear(cells);
        draw_point(cells, &frame, falling[i - 1], 0, 0);
        draw_point(cells, &frame, falling[i], 1, 0);
        draw_point(cells, &frame, falling[i], 2, 0);
        draw_point(cells, &frame, falling[i - 1], 3, 0);
        assert_int_equal(ceduo_cells_role(cells, 0, 0), falling[i - 1]);
        assert_int_equal(ceduo_cells_role(cells, 1, 0), falling[i - 1]);
        expect_text(cells, "⣀⣀\n"); /* the dots of both are seen */
    }
}

TEST(text_hides_dots)
{
    LOCAL(ceduo_cells, cells) = cells_in(5, 1, ASCII);
    struct ceduo_frame frame = dots_of(cells);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 0, 4, 0);
    ceduo_cells_label(cells, 1, 0, CEDUO_ROLE_DIM, "a b");
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_CURSOR, 0, 1, 4, 1);
    expect_text(cells, ":a b:\n");
    expect_roles(cells, "xdddx\n");
    ceduo_cells_label(cells, 1, 0, CEDUO_ROLE_BAD, "c");
    expect_text(cells, ":c b:\n");
    expect_roles(cells, "xBddx\n");
}

TEST(every_role_has_its_letter)
{
    LOCAL(ceduo_cells, cells) = cells_in(CEDUO_ROLE_COUNT, 1, ASCII);
    for (int role = 0; role < CEDUO_ROLE_COUNT; ++role) {
        ceduo_cells_label(cells, role, 0, (enum ceduo_role)role, "#");
    }
    expect_text(cells, " ###################\n");
    expect_roles(cells, " tdTagcemwsSbCGBWrox\n");
}

/* ---- Text ---- */

TEST(labels_are_cut_at_the_canvas)
{
    LOCAL(ceduo_cells, cells) = cells_in(4, 1, BRAILLE);
    assert_int_equal(ceduo_cells_label(cells, 2, 0, CEDUO_ROLE_TITLE, "stool"), 5);
    assert_int_equal(ceduo_cells_label(cells, -3, 0, CEDUO_ROLE_TEXT, "Ø m²"), 4);
    expect_text(cells, "² st\n");
    expect_roles(cells, "t TT\n");
    ceduo_cells_clear(cells);
    assert_int_equal(ceduo_canvas_label_right(&cells->canvas, 2, 0, CEDUO_ROLE_TEXT, "±1"), 2);
    expect_and_clear(cells, " ±1\n");
    ceduo_cells_label(cells, 0, 1, CEDUO_ROLE_TEXT, "below");
    ceduo_cells_label(cells, 0, -1, CEDUO_ROLE_TEXT, "above");
    ceduo_cells_label(cells, 9, 0, CEDUO_ROLE_TEXT, "right");
    expect_and_clear(cells, "\n");
}

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
    ceduo_canvas_label_right(&ascii->canvas, 11, 0, CEDUO_ROLE_TEXT, "±0.3…");
    expect_text(ascii, "    +-0.3...\n");
    assert_int_equal(ceduo_cells_label_width(ASCII, "±0.3…"), 8);
    assert_int_equal(ceduo_cells_label_width(BRAILLE, "±0.3…"), 5);
    assert_int_equal(ceduo_cells_label_width(BRAILLE, ""), 0);
}

TEST(texts_are_cut_at_either_end)
{
    struct ceduo_cells *cells = cells_in(8, 1, BRAILLE);
    assert_int_equal(ceduo_canvas_put(&cells->canvas, 0, 0, 5, CEDUO_ROLE_TEXT, "coppice"), 5);
    expect_and_clear(cells, "copp…\n");
    assert_int_equal(ceduo_canvas_put(&cells->canvas, 0, 0, 7, CEDUO_ROLE_TEXT, "coppice"), 7);
    expect_and_clear(cells, "coppice\n");
    assert_int_equal(ceduo_canvas_put(&cells->canvas, 0, 0, 0, CEDUO_ROLE_TEXT, "coppice"), 0);
    expect_and_clear(cells, "\n");
    /* cells count, not columns: a mark and a wide character are a '?' each; a sign stands where something was cut */
    assert_int_equal(ceduo_cells_put_end(cells, 0, 0, 4, CEDUO_ROLE_TEXT, "ae\u0301ber"), 4);
    expect_and_clear(cells, "…ber\n");
    assert_int_equal(ceduo_cells_put_end(cells, 0, 0, 4, CEDUO_ROLE_TEXT, "日本x"), 3);
    expect_and_clear(cells, "??x\n");
    assert_int_equal(ceduo_cells_put_end(cells, 0, 0, 0, CEDUO_ROLE_TEXT, "x"), 0);
    ceduo_cells_free(cells);
    cells = cells_in(8, 1, ASCII);
    assert_int_equal(ceduo_canvas_put(&cells->canvas, 0, 0, 4, CEDUO_ROLE_TEXT, "35 … 40"), 4);
    expect_text(cells, "35 ~\n");
    ceduo_cells_free(cells);
}
