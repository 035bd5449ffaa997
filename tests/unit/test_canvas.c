/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"
#include "unit/grid.h"

/* A way of one straight part. */
static void count_line(struct ceduo_cells *cells, const struct ceduo_frame *frame, double ax, double ay, double bx, double by)
{
    ceduo_canvas_polyline(&cells->canvas, frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_WAY, 2, (double[]){ax, bx}, (double[]){ay, by});
}

static void draw_line(struct ceduo_cells *cells, const struct ceduo_frame *frame, double ax, double ay, double bx, double by)
{
    ceduo_canvas_line(&cells->canvas, frame, CEDUO_ROLE_WAY, ax, ay, bx, by);
}

/* ---- Lines ---- */

TEST(lines_in_each_charset)
{
    static const char *const expected[] = {
        "⠑⢄\n  ⠑⢄\n",
        "▚\n ▚\n",
        "'.\n  '.\n",
    };
    static const int length[] = {8, 4, 4};
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        LOCAL(ceduo_cells, cells) = cells_in(4, 2, (enum ceduo_charset)i);
        struct ceduo_frame frame = dots_of(cells);
        int to = length[i] - 1;
        draw_line(cells, &frame, 0, frame.y1, to, frame.y1 - to);
        expect_and_clear(cells, expected[i]);
        draw_line(cells, &frame, to, frame.y1 - to, 0, frame.y1);
        expect_text(cells, expected[i]);
    }
}

TEST(steep_and_flat_lines_have_no_gaps)
{
    LOCAL(ceduo_cells, cells) = cells_in(3, 2, BRAILLE);
    struct ceduo_frame frame = dots_of(cells);
    draw_line(cells, &frame, 0, 0, 1, 7);
    expect_and_clear(cells, "⢸\n⡇\n");
    draw_line(cells, &frame, 0, 0, 5, 1);
    expect_and_clear(cells, "\n⣀⡠⠤\n");
}

TEST(what_lies_outside_is_clipped)
{
    LOCAL(ceduo_cells, cells) = cells_in(4, 2, BLOCK);
    struct ceduo_frame frame = dots_of(cells);
    frame.left = 1;
    frame.width = 2;
    frame.x1 = 3;
    /* Both ends outside, across the frame: level, upright, slanting; and far, far away. */
    draw_line(cells, &frame, -50, 3, 90, 3);
    expect_and_clear(cells, " ▀▀\n\n");
    draw_line(cells, &frame, 0, 1e6, 0, -1e6);
    expect_and_clear(cells, " ▌\n ▌\n");
    draw_line(cells, &frame, -10, 13, 20, -17);
    expect_and_clear(cells, " ▚\n  ▚\n");
    draw_line(cells, &frame, -1e9, -1e9, 1e9, 1e9);
    expect_and_clear(cells, "  ▞\n ▞\n");
    /* Nothing of these is inside: beside, above, past a corner, and a point just beyond the half dot. */
    draw_line(cells, &frame, -5, 0, -1, 3);
    draw_line(cells, &frame, -5, 4, 5, 9);
    draw_line(cells, &frame, 3, 6, 6, 3);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 3.6, 1);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 1, -0.6);
    expect_and_clear(cells, "\n\n");
    /* The nearest dot is inside. */
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 3.4, 3.4);
    expect_and_clear(cells, "  ▝\n\n");
}

TEST(frame_may_hang_over_the_canvas)
{
    LOCAL(ceduo_cells, cells) = cells_in(3, 1, ASCII);
    struct ceduo_frame frame = {.left = -2, .top = -1, .width = 7, .height = 3, .x1 = 6, .y1 = 5};
    draw_line(cells, &frame, 0, 3, 6, 3);
    draw_line(cells, &frame, 3, 0, 3, 5);
    expect_text(cells, "':'\n");
}

TEST(what_is_not_finite_is_never_drawn)
{
    const double nan = NAN, inf = INFINITY;
    LOCAL(ceduo_cells, cells) = cells_in(7, 1, ASCII);
    struct ceduo_frame frame = dots_of(cells);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, nan, 0);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 0, inf);
    draw_line(cells, &frame, 0, 0, inf, 0);
    draw_line(cells, &frame, nan, 0, 3, 0);
    draw_line(cells, &frame, -1e308, 0, 1e308, 0); /* too long to clip */
    ceduo_canvas_rule_x(&cells->canvas, &frame, CEDUO_ROLE_WAY, nan);
    ceduo_canvas_rule_y(&cells->canvas, &frame, CEDUO_ROLE_WAY, -inf);
    ceduo_canvas_bar(&cells->canvas, 0, 0, 7, nan, CEDUO_ROLE_WAY);
    expect_and_clear(cells, "\n");
    const double x[] = {0, 1, 2, 3, 4, 5, 6}, y[] = {0, 0, nan, 0, inf, 0, 0};
    ceduo_canvas_polyline(&cells->canvas, &frame, CEDUO_ROLE_WAY, CEDUO_STROKE_PLAIN, 7, x, y);
    expect_and_clear(cells, ".. . ..\n");
    ceduo_canvas_stairs(&cells->canvas, &frame, CEDUO_ROLE_WAY, 7, x, y);
    expect_and_clear(cells, ".. . ..\n");
}

TEST(useless_frames_draw_nothing)
{
    static const struct ceduo_frame frames[] = {
        {.width = 4, .height = 2, .x1 = 0, .y1 = 1},
        {.width = 4, .height = 2, .x1 = 1, .y1 = 0},
        {.width = 4, .height = 2, .x0 = (double)NAN, .x1 = 1, .y1 = 1},
        {.width = 4, .height = 2, .x1 = (double)INFINITY, .y1 = 1},
        {.width = 4, .height = 2, .x0 = -1.7e308, .x1 = 1.7e308, .y1 = 1},
        {.width = 1, .height = 2, .x1 = 1, .y1 = 1},
        {.width = 4, .height = 0, .x1 = 1, .y1 = 1},
        {.width = 1001, .height = 2, .x1 = 1, .y1 = 1},
        {.left = 2000000000, .width = 4, .height = 2, .x1 = 1, .y1 = 1},
    };
    const double x[] = {0, 1};
    LOCAL(ceduo_cells, cells) = cells_in(4, 2, BRAILLE);
    ceduo_canvas_cloud_start(&cells->canvas);
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; ++i) {
        const struct ceduo_frame *frame = &frames[i];
        int column, row;
        draw_point(cells, frame, CEDUO_ROLE_WAY, 0, 0);
        ceduo_canvas_polyline(&cells->canvas, frame, CEDUO_ROLE_WAY, CEDUO_STROKE_PLAIN, 2, x, x);
        ceduo_canvas_stairs(&cells->canvas, frame, CEDUO_ROLE_WAY, 2, x, x);
        ceduo_canvas_rule_x(&cells->canvas, frame, CEDUO_ROLE_WAY, 0);
        ceduo_canvas_rule_y(&cells->canvas, frame, CEDUO_ROLE_WAY, 0);
        ceduo_canvas_polyline(&cells->canvas, frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_WAY, 2, x, x);
        ceduo_canvas_axis_left(&cells->canvas, frame);
        ceduo_canvas_axis_bottom(&cells->canvas, frame, "m");
        assert_false(ceduo_frame_cell(frame, kind_of(BRAILLE), 0, 0, &column, &row));
    }
    ceduo_canvas_cloud_show(&cells->canvas, 0);
    expect_text(cells, "\n\n");
}

TEST(axes_may_be_turned_round)
{
    LOCAL(ceduo_cells, cells) = cells_in(3, 2, ASCII);
    struct ceduo_frame frame = {.width = 3, .height = 2, .x0 = 2, .x1 = 0, .y0 = 3, .y1 = 0};
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 0, 3);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 2, 0);
    expect_text(cells, "'\n  .\n");
}

TEST(stairs_hold_the_value_before)
{
    const double x[] = {0, 3, 5}, y[] = {3, 1, 0};
    LOCAL(ceduo_cells, cells) = cells_in(6, 2, ASCII);
    struct ceduo_frame frame = dots_of(cells);
    ceduo_canvas_stairs(&cells->canvas, &frame, CEDUO_ROLE_WOOD, 3, x, y);
    expect_and_clear(cells, "''':\n   '':\n");
    ceduo_canvas_stairs(&cells->canvas, &frame, CEDUO_ROLE_WOOD, 1, x, y);
    expect_and_clear(cells, "'\n\n");
}

TEST(rules_are_dotted)
{
    static const char *const across[] = {"\n⡀⡀⡀⡀\n", "\n▖▖▖▖\n", "\n. .\n"};
    static const char *const up[] = {"⠅\n⠅\n", "▘\n▘\n", "'\n'\n"};
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        LOCAL(ceduo_cells, cells) = cells_in(4, 2, (enum ceduo_charset)i);
        struct ceduo_frame frame = dots_of(cells);
        ceduo_canvas_rule_y(&cells->canvas, &frame, CEDUO_ROLE_AXIS, 0);
        expect_and_clear(cells, across[i]);
        ceduo_canvas_rule_x(&cells->canvas, &frame, CEDUO_ROLE_AXIS, 0);
        expect_and_clear(cells, up[i]);
        ceduo_canvas_rule_x(&cells->canvas, &frame, CEDUO_ROLE_AXIS, -1);
        ceduo_canvas_rule_y(&cells->canvas, &frame, CEDUO_ROLE_AXIS, frame.y1 + 1);
        expect_and_clear(cells, "\n\n");
    }
}

TEST(bars_go_by_eighths)
{
    static const struct {
        double fraction;
        const char *utf8, *ascii;
    } bars[] = {
        {-1, "\n", "\n"},           {0, "\n", "\n"},         {1e-9, "▏\n", "#\n"},    {1. / 16, "▏\n", "#\n"},
        {2. / 16, "▎\n", "#\n"},    {3. / 16, "▍\n", "#\n"}, {4. / 16, "▌\n", "#\n"}, {5. / 16, "▋\n", "#\n"},
        {6. / 16, "▊\n", "#\n"},    {7. / 16, "▉\n", "#\n"}, {8. / 16, "█\n", "#\n"}, {9. / 16, "█▏\n", "#\n"},
        {15. / 16, "█▉\n", "##\n"}, {1, "██\n", "##\n"},     {7, "██\n", "##\n"},     {(double)INFINITY, "██\n", "##\n"},
    };
    LOCAL(ceduo_cells, utf8) = cells_in(4, 1, BRAILLE);
    LOCAL(ceduo_cells, ascii) = cells_in(4, 1, ASCII);
    for (size_t i = 0; i < sizeof bars / sizeof bars[0]; ++i) {
        ceduo_canvas_bar(&utf8->canvas, 0, 0, 2, bars[i].fraction, CEDUO_ROLE_WOOD);
        ceduo_canvas_bar(&ascii->canvas, 0, 0, 2, bars[i].fraction, CEDUO_ROLE_WOOD);
        expect_and_clear(utf8, bars[i].utf8);
        expect_and_clear(ascii, bars[i].ascii);
    }
    ceduo_canvas_bar(&utf8->canvas, 2, 0, 4, 1, CEDUO_ROLE_WOOD);
    expect_text(utf8, "  ██\n");
    expect_roles(utf8, "  oo\n");
}

/* ---- Density ---- */

TEST(density_shows_the_most_travelled_dots)
{
    static const struct {
        double quantile;
        const char *text;
    } shown[] = {{1, ".\n"}, {0.75, "..\n"}, {0.5, "...\n"}, {0, "....\n"}, {9, ".\n"}, {(double)NAN, "....\n"}};
    for (size_t k = 0; k < sizeof shown / sizeof shown[0]; ++k) {
        LOCAL(ceduo_cells, cells) = cells_in(4, 1, ASCII);
        struct ceduo_frame frame = dots_of(cells);
        count_line(cells, &frame, 0, 0, 3, 0); /* not started */
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        expect_text(cells, "\n");
        ceduo_canvas_cloud_start(&cells->canvas);
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        for (int i = 0; i < 4; ++i)
            count_line(cells, &frame, 0, 0, i, 0); /* passed 4, 3, 2, 1 times */
        expect_text(cells, "\n");                  /* counting draws nothing */
        ceduo_canvas_cloud_show(&cells->canvas, shown[k].quantile);
        expect_text(cells, shown[k].text);
        assert_int_equal(ceduo_cells_role(cells, 0, 0), CEDUO_ROLE_CLOUD);
        ceduo_cells_clear(cells);
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        expect_text(cells, "\n");
    }
}

TEST(a_way_counts_once_where_its_parts_meet)
{
    const double x[] = {-9, 0, 0.2, 0.4, 1, 2, 2, 99}, y[] = {0, 0, 0, 0, 0, 0, 0, 0};
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        LOCAL(ceduo_cells, cells) = cells_in(4, 1, (enum ceduo_charset)i);
        struct ceduo_frame frame = dots_of(cells);
        ceduo_canvas_cloud_start(&cells->canvas);
        ceduo_canvas_polyline(&cells->canvas, &frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_WAY, 8, x, y);
        ceduo_canvas_cloud_show(&cells->canvas, 1);
        ceduo_canvas_polyline(&cells->canvas, &frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_WAY, 8, x, y);
        ceduo_canvas_cloud_show(&cells->canvas, 0);
    }
}

TEST(density_counts_only_within_the_canvas)
{
    LOCAL(ceduo_cells, cells) = cells_in(2, 1, BRAILLE);
    struct ceduo_frame frame = {.left = -3, .top = -3, .width = 12, .height = 9, .x1 = 1, .y1 = 1};
    ceduo_canvas_cloud_start(&cells->canvas);
    count_line(cells, &frame, 0, 0, 1, 1);
    count_line(cells, &frame, 0, 1, 1, 0);
    count_line(cells, &frame, 0, 0.65, 1, 0.65);
    ceduo_canvas_cloud_show(&cells->canvas, 0);
    expect_roles(cells, "cc\n");
}

/* ---- True scale ---- */

TEST(forty_five_degrees_are_forty_five_degrees)
{
    static const char *const expected[] = {
        "      ⡠⠊\n    ⡠⠊\n  ⡠⠊\n⡠⠊\n",
        "      ▄▀\n    ▄▀\n  ▄▀\n▗▀\n",
        "      .'\n    .'\n  .'\n.'\n",
    };
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        enum ceduo_charset charset = (enum ceduo_charset)i;
        LOCAL(ceduo_cells, cells) = cells_in(8, 4, charset);
        struct ceduo_frame frame = {.width = 8, .height = 4};
        /* A slope of 100 m down 100 m, in a picture that just holds it. */
        assert_true(ceduo_frame_true_scale(&frame, kind_of(charset), 200, 300, 1000, 1100));
        draw_line(cells, &frame, 200, 1000, 300, 1100);
        expect_text(cells, expected[i]);
    }
}

TEST(true_scale_moves_one_dot_across_for_each_dot_up)
{
    LOCAL(ceduo_cells, cells) = cells_in(30, 9, BRAILLE);
    struct ceduo_frame frame = {.width = 30, .height = 9};
    assert_true(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 0, 150, 0, 20));
    double dot = (frame.x1 - frame.x0) / 59;
    assert_float_equal((frame.y1 - frame.y0) / 35, dot, 1e-12);
    /* From the lower left dot on, each further dot to the right is one further up. */
    draw_line(cells, &frame, frame.x0, frame.y0, frame.x0 + 7 * dot, frame.y0 + 7 * dot);
    expect_text(cells, "\n\n\n\n\n\n\n  ⡠⠊\n⡠⠊\n");
}

TEST(true_scale_fits_and_centres)
{
    struct ceduo_frame frame = {.width = 10, .height = 5}; /* 20 x 20 dots of braille */
    assert_true(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 0, 19, 4, 10));
    assert_float_equal(frame.x0, 0, 1e-12);
    assert_float_equal(frame.x1, 19, 1e-12);
    assert_float_equal(frame.y0, -2.5, 1e-12);
    assert_float_equal(frame.y1, 16.5, 1e-12);
    assert_true(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 10, 10, 0, 38)); /* a cliff */
    assert_float_equal(frame.x0, -9, 1e-12);
    assert_float_equal(frame.x1, 29, 1e-12);
    assert_float_equal(frame.y1, 38, 1e-12);
    struct ceduo_frame before = frame;
    assert_false(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 1, 1, 2, 2));
    assert_false(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 1, 0, 0, 2));
    assert_false(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 0, (double)NAN, 0, 2));
    assert_false(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 0, (double)INFINITY, 0, 2));
    assert_memory_equal(&frame, &before, sizeof frame);
    frame.width = 1;
    assert_false(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 0, 1, 0, 1));
}

TEST(frame_cell_is_where_the_point_is_drawn)
{
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        enum ceduo_charset charset = (enum ceduo_charset)i;
        LOCAL(ceduo_cells, cells) = cells_in(9, 6, charset);
        struct ceduo_frame frame = {.left = 2, .top = 1, .width = 5, .height = 3, .x0 = -3, .x1 = 7, .y0 = 10, .y1 = 12};
        for (double x = -3; x <= 7; x += 0.37) {
            int column = -1, row = -1;
            double y = 11 + 0.1 * x;
            bool inside = ceduo_frame_cell(&frame, kind_of(charset), x, y, &column, &row);
            assert_int_equal(inside, y > 10 - 0.5);
            ceduo_cells_clear(cells);
            draw_point(cells, &frame, CEDUO_ROLE_WAY, x, y);
            assert_int_equal(ceduo_cells_role(cells, column, row), CEDUO_ROLE_WAY);
        }
        int column, row;
        assert_false(ceduo_frame_cell(&frame, kind_of(charset), 9, 11, &column, &row));
        assert_false(ceduo_frame_cell(&frame, kind_of(charset), 0, 8, &column, &row));
        assert_false(ceduo_frame_cell(&frame, kind_of(charset), (double)NAN, 11, &column, &row));
    }
}
