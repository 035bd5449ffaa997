/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"
#include "table.h"

#include "unit/grid.h"

/* ---- ticks ---- */

/* Compare the tick labels of a range, joined by blanks. */
static void expect_ticks(double lo, double hi, int max_count, const char *expected)
{
    double ticks[CEDUO_TICKS_MAX], step;
    char all[1024] = "";
    int count = ceduo_ticks(lo, hi, max_count, ticks, &step);
    assert_true(count <= max_count || count == 0);
    for (int i = 0; i < count; ++i) {
        char label[CEDUO_TICK_LABEL_SIZE];
        assert_false(ticks[i] == 0.0 && signbit(ticks[i]));
        ceduo_tick_label(ticks[i], step, label);
        strcat(all, i > 0 ? " " : "");
        strcat(all, label);
    }
    assert_string_equal(all, expected);
}

TEST(ticks_are_round)
{
    for (TABLE(row, "unit/ticks.txt", "ticks"))
        expect_ticks(strtod(row.at[0], NULL), strtod(row.at[1], NULL), atoi(row.at[2]), row.at[3]);
    double tenths[4], step;
    assert_int_equal(ceduo_ticks(0, 0.3, 4, tenths, &step), 4);
    EXPECT(tenths[3], ==, 0.3); /* the double nearest to 0.3, not 3 * 0.1 */
}

TEST(ticks_are_evenly_spaced_and_limited)
{
    double ticks[CEDUO_TICKS_MAX], step;
    for (int k = -12; k <= 12; ++k) {
        double size = pow(10, k);
        for (int i = 1; i < 60; ++i) {
            double lo = (i * 37 % 23 - 11) * 0.31 * size;
            double hi = lo + i * 0.17 * size;
            int max_count = 1 + i % 12;
            int count = ceduo_ticks(lo, hi, max_count, ticks, &step);
            assert_in_range(count, 1, max_count);
            for (int j = 0; j < count; ++j) {
                EXPECT(ticks[j], >=, lo - 1e-6 * step);
                EXPECT(ticks[j], <=, hi + 1e-6 * step);
                assert_true(j == 0 || fabs(ticks[j] - ticks[j - 1] - step) < 1e-6 * step);
            }
        }
    }
    assert_int_equal(ceduo_ticks(0, 60, 100000, ticks, &step), 61);
    assert_in_range(ceduo_ticks(0, 99, 100000, ticks, &step), 1, CEDUO_TICKS_MAX);
}

TEST(tick_labels_have_no_negative_zero)
{
    static const struct {
        double value, step;
        const char *label;
    } rows[] = {{-0.0, 1, "0"}, {-1e-9, 0.1, "0.0"}, {-0.1, 0.1, "-0.1"}, {-2e10, 1e10, "-2e10"}, {-1e-10, 1e-10, "-1e-10"}};
    char label[CEDUO_TICK_LABEL_SIZE];
    for (size_t i = 0; i < LENGTH(rows); i++) {
        ceduo_tick_label(rows[i].value, rows[i].step, label);
        assert_string_equal(label, rows[i].label);
    }
}

/* ---- axes ---- */

/* Count the texts in a row that are at least two blanks apart. */
static int count_texts(const char *row)
{
    int words = 0, blanks = 2;
    for (; *row != '\0'; ++row) {
        words += *row != ' ' && blanks >= 2;
        blanks = *row == ' ' ? blanks + 1 : 0;
    }
    return words;
}

TEST(bottom_labels_never_touch)
{
    for (int width = 4; width < 90; ++width) {
        LOCAL(ceduo_cells, cells) = cells_in(width + 3, 4, ASCII);
        for (int k = -9; k < 12; ++k) {
            struct ceduo_frame frame = {.left = 2, .width = width, .height = 2, .y1 = 1};
            frame.x0 = -0.37 * pow(10, k);
            frame.x1 = 1.13 * pow(10, k) * (1 + width % 5);
            ceduo_cells_clear(cells);
            ceduo_canvas_axis_bottom(&cells->canvas, &frame, NULL);
            LOCAL_TEXT(line);
            LOCAL_TEXT(labels);
            ceduo_cells_text(cells, 2, &line);
            ceduo_cells_text(cells, 3, &labels);
            int ticks = 0;
            for (const char *c = ceduo_text_string(&line); *c != '\0'; ++c)
                ticks += *c == '+';
            assert_int_equal(count_texts(ceduo_text_string(&labels)), ticks);
            EXPECT(strlen(ceduo_text_string(&labels)), <=, (size_t)width + 2);
        }
    }
}

TEST(axis_width_holds_every_label)
{
    for (int height = 1; height < 40; ++height) {
        struct ceduo_frame frame = {.width = 4, .height = height, .x1 = 1, .y0 = -12.5, .y1 = 3.3 * height};
        frame.left = ceduo_frame_axis_width(&frame, find_canvas(BRAILLE));
        LOCAL(ceduo_cells, cells) = cells_in(frame.left + 4, height, BRAILLE);
        ceduo_canvas_axis_left(&cells->canvas, &frame);
        int widest = 0, last_tick = -2;
        for (int row = 0; row < height; ++row) {
            bool tick = ceduo_cells_glyph(cells, frame.left - 1, row) == 0x2524;
            bool label = frame.left > 1 && ceduo_cells_glyph(cells, frame.left - 2, row) != ' ';
            assert_int_equal(tick, label);
            assert_false(tick && height > 3 && row == last_tick + 1); /* one row between two labels */
            last_tick = tick ? row : last_tick;
            widest = ceduo_cells_glyph(cells, 0, row) != ' ' ? 1 : widest;
        }
        assert_int_equal(widest, 1); /* no column is wasted */
    }
    struct ceduo_frame bad = {.width = 4, .height = 0, .x1 = 1, .y1 = 1};
    assert_int_equal(ceduo_frame_axis_width(&bad, find_canvas(BRAILLE)), 0);
}
