/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "view/cells.h"

#define BRAILLE CEDUO_CHARSET_BRAILLE
#define BLOCK   CEDUO_CHARSET_BLOCK
#define ASCII   CEDUO_CHARSET_ASCII

/* The last character set; for loops over all of them. */
#define LAST_CHARSET CEDUO_CHARSET_ASCII

static struct ceduo_cells *cells_in(int width, int height, enum ceduo_charset charset)
{
    struct ceduo_cells *cells = ceduo_cells_create(width, height, charset);
    assert_non_null(cells);
    return cells;
}

/* A frame over the whole cells in which x and y are dots, counted from the lower left. */
static struct ceduo_frame dots_of(const struct ceduo_cells *cells)
{
    return (struct ceduo_frame){
        .width = cells->width,
        .height = cells->height,
        .x1 = cells->width * cells->canvas.dots_x - 1,
        .y1 = cells->height * cells->canvas.dots_y - 1,
    };
}

/* A cells of such cells as frames see it. */
static const struct ceduo_canvas *kind_of(enum ceduo_charset charset)
{
    static struct ceduo_canvas canvas;
    canvas = (struct ceduo_canvas){.dots_x = charset == ASCII ? 1 : 2, .dots_y = charset == BRAILLE ? 4 : 2};
    return &canvas;
}

static void draw_point(struct ceduo_cells *cells, const struct ceduo_frame *frame, enum ceduo_role role, double x,
                       double y)
{
    ceduo_canvas_line(&cells->canvas, frame, role, x, y, x, y);
}

/* A way of one straight part. */
static void count_line(struct ceduo_cells *cells, const struct ceduo_frame *frame, double ax, double ay, double bx,
                       double by)
{
    ceduo_canvas_cloud_add(&cells->canvas, frame, 2, (double[]){ax, bx}, (double[]){ay, by});
}

static void expect_text(const struct ceduo_cells *cells, const char *expected)
{
    char *text = ceduo_cells_dump(cells);
    assert_non_null(text);
    assert_string_equal(text, expected);
    free(text);
}

static void expect_roles(const struct ceduo_cells *cells, const char *expected)
{
    char *roles = ceduo_cells_roles(cells);
    assert_non_null(roles);
    assert_string_equal(roles, expected);
    free(roles);
}

/* Compares and blanks the cells for the next picture. */
static void expect_and_clear(struct ceduo_cells *cells, const char *expected)
{
    expect_text(cells, expected);
    ceduo_cells_clear(cells);
}

/* ---- The cells ---- */

static void sizes_are_limited(void **state)
{
    (void)state;
    assert_null(ceduo_cells_create(0, 10, BRAILLE));
    assert_null(ceduo_cells_create(10, 0, BRAILLE));
    assert_null(ceduo_cells_create(-1, -1, BRAILLE));
    assert_null(ceduo_cells_create(1001, 10, BRAILLE));
    assert_null(ceduo_cells_create(10, 501, BRAILLE));
    ceduo_cells_free(cells_in(1000, 500, BRAILLE));
    ceduo_cells_free(NULL);
}

static void blank_canvas_is_empty_rows(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(4, 2, BRAILLE);
    expect_text(cells, "\n\n");
    expect_roles(cells, "\n\n");
    assert_int_equal(ceduo_cells_glyph(cells, 0, 0), ' ');
    assert_int_equal(ceduo_cells_glyph(cells, -1, 7), ' ');
    assert_int_equal(ceduo_cells_role(cells, 4, 0), CEDUO_ROLE_BLANK);
    ceduo_cells_free(cells);
}

static void each_dot_has_its_glyph(void **state)
{
    (void)state;
    static const struct {
        enum ceduo_charset charset;
        const char *glyphs[4][2]; /* row from the top, column */
    } sets[] = {
        {BRAILLE, {{"⠁\n", "⠈\n"}, {"⠂\n", "⠐\n"}, {"⠄\n", "⠠\n"}, {"⡀\n", "⢀\n"}}},
        {BLOCK, {{"▘\n", "▝\n"}, {"▖\n", "▗\n"}}},
        {ASCII, {{"'\n"}, {".\n"}}},
    };
    for (size_t i = 0; i < 3; ++i) {
        struct ceduo_cells *cells = cells_in(2, 1, sets[i].charset);
        struct ceduo_frame frame = dots_of(cells);
        for (int y = 0; y < cells->canvas.dots_y; ++y) {
            for (int x = 0; x < cells->canvas.dots_x; ++x) {
                draw_point(cells, &frame, CEDUO_ROLE_WAY, x, frame.y1 - y);
                expect_and_clear(cells, sets[i].glyphs[y][x]);
            }
        }
        ceduo_cells_free(cells);
    }
}

static void all_quadrants(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(16, 1, BLOCK);
    struct ceduo_frame frame = dots_of(cells);
    for (int mask = 0; mask < 16; ++mask) {
        for (int bit = 0; bit < 4; ++bit) {
            if (mask >> bit & 1) {
                draw_point(cells, &frame, CEDUO_ROLE_WAY, 2 * mask + bit % 2, 1 - bit / 2);
            }
        }
    }
    expect_text(cells, " ▘▝▀▖▌▞▛▗▚▐▜▄▙▟█\n");
    ceduo_cells_free(cells);
}

static void row_text_is_cut_at_a_character(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(5, 2, BRAILLE);
    char buffer[16];
    ceduo_cells_label(cells, 0, 0, CEDUO_ROLE_TEXT, "a±b  ");
    assert_int_equal(ceduo_cells_text(cells, 0, sizeof buffer, buffer), 4);
    assert_string_equal(buffer, "a±b");
    assert_int_equal(ceduo_cells_text(cells, 0, 4, buffer), 4);
    assert_string_equal(buffer, "a±");
    assert_int_equal(ceduo_cells_text(cells, 0, 3, buffer), 4);
    assert_string_equal(buffer, "a"); /* half of ± would fit, and so would the b behind it */
    assert_int_equal(ceduo_cells_text(cells, 0, 1, buffer), 4);
    assert_string_equal(buffer, "");
    assert_int_equal(ceduo_cells_text(cells, 0, 0, NULL), 4);
    assert_int_equal(ceduo_cells_text(cells, 2, sizeof buffer, buffer), 0);
    assert_string_equal(buffer, "");
    ceduo_cells_free(cells);
}

/* ---- Roles ---- */

static void rank_decides_the_role_whoever_draws_first(void **state)
{
    (void)state;
    static const enum ceduo_role falling[] = {
        CEDUO_ROLE_CURSOR, CEDUO_ROLE_WAY,    CEDUO_ROLE_CONTROL, CEDUO_ROLE_MEAN, CEDUO_ROLE_ENVELOPE, CEDUO_ROLE_STEM,
        CEDUO_ROLE_STOOL,  CEDUO_ROLE_GROUND, CEDUO_ROLE_CLOUD,   CEDUO_ROLE_AXIS, CEDUO_ROLE_DIM,
    };
    struct ceduo_cells *cells = cells_in(2, 1, BRAILLE);
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
    ceduo_cells_free(cells);
}

static void text_hides_dots(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(5, 1, ASCII);
    struct ceduo_frame frame = dots_of(cells);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 0, 4, 0);
    ceduo_cells_label(cells, 1, 0, CEDUO_ROLE_DIM, "a b");
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_CURSOR, 0, 1, 4, 1);
    expect_text(cells, ":a b:\n");
    expect_roles(cells, "xdddx\n");
    ceduo_cells_label(cells, 1, 0, CEDUO_ROLE_BAD, "c");
    expect_text(cells, ":c b:\n");
    expect_roles(cells, "xBddx\n");
    ceduo_cells_free(cells);
}

static void every_role_has_its_letter(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(CEDUO_ROLE_COUNT, 1, ASCII);
    for (int role = 0; role < CEDUO_ROLE_COUNT; ++role) {
        ceduo_cells_label(cells, role, 0, (enum ceduo_role)role, "#");
    }
    expect_text(cells, " ###################\n");
    expect_roles(cells, " tdTagcemwsSbCGBWrox\n");
    ceduo_cells_free(cells);
}

/* ---- Lines ---- */

static void lines_in_each_charset(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "⠑⢄\n  ⠑⢄\n",
        "▚\n ▚\n",
        "'.\n  '.\n",
    };
    static const int length[] = {8, 4, 4};
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        struct ceduo_cells *cells = cells_in(4, 2, (enum ceduo_charset)i);
        struct ceduo_frame frame = dots_of(cells);
        int to = length[i] - 1;
        ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, frame.y1, to, frame.y1 - to);
        expect_and_clear(cells, expected[i]);
        ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, to, frame.y1 - to, 0, frame.y1);
        expect_text(cells, expected[i]);
        ceduo_cells_free(cells);
    }
}

static void steep_and_flat_lines_have_no_gaps(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(3, 2, BRAILLE);
    struct ceduo_frame frame = dots_of(cells);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 0, 1, 7);
    expect_and_clear(cells, "⢸\n⡇\n");
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 0, 5, 1);
    expect_and_clear(cells, "\n⣀⡠⠤\n");
    ceduo_cells_free(cells);
}

static void what_lies_outside_is_clipped(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(4, 2, BLOCK);
    struct ceduo_frame frame = dots_of(cells);
    frame.left = 1;
    frame.width = 2;
    frame.x1 = 3;
    /* Both ends outside, across the frame: level, upright, slanting; and far, far away. */
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, -50, 3, 90, 3);
    expect_and_clear(cells, " ▀▀\n\n");
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 1e6, 0, -1e6);
    expect_and_clear(cells, " ▌\n ▌\n");
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, -10, 13, 20, -17);
    expect_and_clear(cells, " ▚\n  ▚\n");
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, -1e9, -1e9, 1e9, 1e9);
    expect_and_clear(cells, "  ▞\n ▞\n");
    /* Nothing of these is inside: beside, above, past a corner, and a point just beyond the half dot. */
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, -5, 0, -1, 3);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, -5, 4, 5, 9);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 3, 6, 6, 3);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 3.6, 1);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 1, -0.6);
    expect_and_clear(cells, "\n\n");
    /* The nearest dot is inside. */
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 3.4, 3.4);
    expect_and_clear(cells, "  ▝\n\n");
    ceduo_cells_free(cells);
}

static void frame_may_hang_over_the_canvas(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(3, 1, ASCII);
    struct ceduo_frame frame = {.left = -2, .top = -1, .width = 7, .height = 3, .x1 = 6, .y1 = 5};
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 3, 6, 3);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 3, 0, 3, 5);
    expect_text(cells, "':'\n");
    ceduo_cells_free(cells);
}

static void what_is_not_finite_is_never_drawn(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double inf = (double)INFINITY;
    struct ceduo_cells *cells = cells_in(7, 1, ASCII);
    struct ceduo_frame frame = dots_of(cells);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, nan, 0);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 0, inf);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 0, 0, inf, 0);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, nan, 0, 3, 0);
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, -1e308, 0, 1e308, 0); /* too long to clip */
    ceduo_canvas_rule_x(&cells->canvas, &frame, CEDUO_ROLE_WAY, nan);
    ceduo_canvas_rule_y(&cells->canvas, &frame, CEDUO_ROLE_WAY, -inf);
    ceduo_canvas_bar(&cells->canvas, 0, 0, 7, nan, CEDUO_ROLE_WAY);
    expect_and_clear(cells, "\n");
    const double x[] = {0, 1, 2, 3, 4, 5, 6};
    const double y[] = {0, 0, nan, 0, inf, 0, 0};
    ceduo_canvas_polyline(&cells->canvas, &frame, CEDUO_ROLE_WAY, 7, x, y);
    expect_and_clear(cells, ".. . ..\n");
    ceduo_canvas_stairs(&cells->canvas, &frame, CEDUO_ROLE_WAY, 7, x, y);
    expect_and_clear(cells, ".. . ..\n");
    ceduo_cells_free(cells);
}

static void useless_frames_draw_nothing(void **state)
{
    (void)state;
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
    struct ceduo_cells *cells = cells_in(4, 2, BRAILLE);
    assert_true(ceduo_canvas_cloud_start(&cells->canvas));
    for (size_t i = 0; i < sizeof frames / sizeof frames[0]; ++i) {
        const struct ceduo_frame *frame = &frames[i];
        int column;
        int row;
        draw_point(cells, frame, CEDUO_ROLE_WAY, 0, 0);
        ceduo_canvas_polyline(&cells->canvas, frame, CEDUO_ROLE_WAY, 2, x, x);
        ceduo_canvas_stairs(&cells->canvas, frame, CEDUO_ROLE_WAY, 2, x, x);
        ceduo_canvas_rule_x(&cells->canvas, frame, CEDUO_ROLE_WAY, 0);
        ceduo_canvas_rule_y(&cells->canvas, frame, CEDUO_ROLE_WAY, 0);
        ceduo_canvas_cloud_add(&cells->canvas, frame, 2, x, x);
        ceduo_canvas_axis_left(&cells->canvas, frame);
        ceduo_canvas_axis_bottom(&cells->canvas, frame, "m");
        assert_false(ceduo_frame_cell(frame, kind_of(BRAILLE), 0, 0, &column, &row));
    }
    ceduo_canvas_cloud_show(&cells->canvas, 0);
    expect_text(cells, "\n\n");
    ceduo_cells_free(cells);
}

static void axes_may_be_turned_round(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(3, 2, ASCII);
    struct ceduo_frame frame = {.width = 3, .height = 2, .x0 = 2, .x1 = 0, .y0 = 3, .y1 = 0};
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 0, 3);
    draw_point(cells, &frame, CEDUO_ROLE_WAY, 2, 0);
    expect_text(cells, "'\n  .\n");
    ceduo_cells_free(cells);
}

static void stairs_hold_the_value_before(void **state)
{
    (void)state;
    const double x[] = {0, 3, 5};
    const double y[] = {3, 1, 0};
    struct ceduo_cells *cells = cells_in(6, 2, ASCII);
    struct ceduo_frame frame = dots_of(cells);
    ceduo_canvas_stairs(&cells->canvas, &frame, CEDUO_ROLE_WOOD, 3, x, y);
    expect_and_clear(cells, "''':\n   '':\n");
    ceduo_canvas_stairs(&cells->canvas, &frame, CEDUO_ROLE_WOOD, 1, x, y);
    expect_and_clear(cells, "'\n\n");
    ceduo_cells_free(cells);
}

static void rules_are_dotted(void **state)
{
    (void)state;
    static const char *const across[] = {"\n⡀⡀⡀⡀\n", "\n▖▖▖▖\n", "\n. .\n"};
    static const char *const up[] = {"⠅\n⠅\n", "▘\n▘\n", "'\n'\n"};
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        struct ceduo_cells *cells = cells_in(4, 2, (enum ceduo_charset)i);
        struct ceduo_frame frame = dots_of(cells);
        ceduo_canvas_rule_y(&cells->canvas, &frame, CEDUO_ROLE_AXIS, 0);
        expect_and_clear(cells, across[i]);
        ceduo_canvas_rule_x(&cells->canvas, &frame, CEDUO_ROLE_AXIS, 0);
        expect_and_clear(cells, up[i]);
        ceduo_canvas_rule_x(&cells->canvas, &frame, CEDUO_ROLE_AXIS, -1);
        ceduo_canvas_rule_y(&cells->canvas, &frame, CEDUO_ROLE_AXIS, frame.y1 + 1);
        expect_and_clear(cells, "\n\n");
        ceduo_cells_free(cells);
    }
}

static void bars_go_by_eighths(void **state)
{
    (void)state;
    static const struct {
        double fraction;
        const char *utf8, *ascii;
    } bars[] = {
        {-1, "\n", "\n"},           {0, "\n", "\n"},
        {1e-9, "▏\n", "#\n"},       {1. / 16, "▏\n", "#\n"},
        {2. / 16, "▎\n", "#\n"},    {3. / 16, "▍\n", "#\n"},
        {4. / 16, "▌\n", "#\n"},    {5. / 16, "▋\n", "#\n"},
        {6. / 16, "▊\n", "#\n"},    {7. / 16, "▉\n", "#\n"},
        {8. / 16, "█\n", "#\n"},    {9. / 16, "█▏\n", "#\n"},
        {15. / 16, "█▉\n", "##\n"}, {1, "██\n", "##\n"},
        {7, "██\n", "##\n"},        {(double)INFINITY, "██\n", "##\n"},
    };
    struct ceduo_cells *utf8 = cells_in(4, 1, BRAILLE);
    struct ceduo_cells *ascii = cells_in(4, 1, ASCII);
    for (size_t i = 0; i < sizeof bars / sizeof bars[0]; ++i) {
        ceduo_canvas_bar(&utf8->canvas, 0, 0, 2, bars[i].fraction, CEDUO_ROLE_WOOD);
        ceduo_canvas_bar(&ascii->canvas, 0, 0, 2, bars[i].fraction, CEDUO_ROLE_WOOD);
        expect_and_clear(utf8, bars[i].utf8);
        expect_and_clear(ascii, bars[i].ascii);
    }
    ceduo_canvas_bar(&utf8->canvas, 2, 0, 4, 1, CEDUO_ROLE_WOOD);
    expect_text(utf8, "  ██\n");
    expect_roles(utf8, "  oo\n");
    ceduo_cells_free(utf8);
    ceduo_cells_free(ascii);
}

/* ---- Density ---- */

static void density_shows_the_most_travelled_dots(void **state)
{
    (void)state;
    static const struct {
        double quantile;
        const char *text;
    } shown[] = {{1, ".\n"}, {0.75, "..\n"}, {0.5, "...\n"}, {0, "....\n"}, {9, ".\n"}, {(double)NAN, "....\n"}};
    for (size_t k = 0; k < sizeof shown / sizeof shown[0]; ++k) {
        struct ceduo_cells *cells = cells_in(4, 1, ASCII);
        struct ceduo_frame frame = dots_of(cells);
        count_line(cells, &frame, 0, 0, 3, 0); /* not started */
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        expect_text(cells, "\n");
        assert_true(ceduo_canvas_cloud_start(&cells->canvas));
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        for (int i = 0; i < 4; ++i)
            count_line(cells, &frame, 0, 0, i, 0); /* passed 4, 3, 2, 1 times */
        expect_text(cells, "\n"); /* counting draws nothing */
        ceduo_canvas_cloud_show(&cells->canvas, shown[k].quantile);
        expect_text(cells, shown[k].text);
        assert_int_equal(ceduo_cells_role(cells, 0, 0), CEDUO_ROLE_CLOUD);
        ceduo_cells_clear(cells);
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        expect_text(cells, "\n");
        ceduo_cells_free(cells);
    }
}

static void a_way_counts_once_where_its_parts_meet(void **state)
{
    (void)state;
    const double x[] = {-9, 0, 0.2, 0.4, 1, 2, 2, 99};
    const double y[] = {0, 0, 0, 0, 0, 0, 0, 0};
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        struct ceduo_cells *cells = cells_in(4, 1, (enum ceduo_charset)i);
        struct ceduo_frame frame = dots_of(cells);
        assert_true(ceduo_canvas_cloud_start(&cells->canvas));
        ceduo_canvas_cloud_add(&cells->canvas, &frame, 8, x, y);
        ceduo_canvas_cloud_show(&cells->canvas, 1);
        ceduo_canvas_cloud_add(&cells->canvas, &frame, 8, x, y);
        ceduo_canvas_cloud_show(&cells->canvas, 0);
        ceduo_cells_free(cells);
    }
}

static void density_counts_only_within_the_canvas(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(2, 1, BRAILLE);
    struct ceduo_frame frame = {.left = -3, .top = -3, .width = 12, .height = 9, .x1 = 1, .y1 = 1};
    assert_true(ceduo_canvas_cloud_start(&cells->canvas));
    count_line(cells, &frame, 0, 0, 1, 1);
    count_line(cells, &frame, 0, 1, 1, 0);
    count_line(cells, &frame, 0, 0.65, 1, 0.65);
    ceduo_canvas_cloud_show(&cells->canvas, 0);
    expect_roles(cells, "cc\n");
    ceduo_cells_free(cells);
}

/* ---- True scale ---- */

static void forty_five_degrees_are_forty_five_degrees(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "      ⡠⠊\n    ⡠⠊\n  ⡠⠊\n⡠⠊\n",
        "      ▄▀\n    ▄▀\n  ▄▀\n▗▀\n",
        "      .'\n    .'\n  .'\n.'\n",
    };
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        enum ceduo_charset charset = (enum ceduo_charset)i;
        struct ceduo_cells *cells = cells_in(8, 4, charset);
        struct ceduo_frame frame = {.width = 8, .height = 4};
        /* A slope of 100 m down 100 m, in a picture that just holds it. */
        assert_true(ceduo_frame_true_scale(&frame, kind_of(charset), 200, 300, 1000, 1100));
        ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, 200, 1000, 300, 1100);
        expect_text(cells, expected[i]);
        ceduo_cells_free(cells);
    }
}

static void true_scale_moves_one_dot_across_for_each_dot_up(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(30, 9, BRAILLE);
    struct ceduo_frame frame = {.width = 30, .height = 9};
    assert_true(ceduo_frame_true_scale(&frame, kind_of(BRAILLE), 0, 150, 0, 20));
    double dot = (frame.x1 - frame.x0) / 59;
    assert_float_equal((frame.y1 - frame.y0) / 35, dot, 1e-12);
    /* From the lower left dot on, each further dot to the right is one further up. */
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_WAY, frame.x0, frame.y0, frame.x0 + 7 * dot, frame.y0 + 7 * dot);
    expect_text(cells, "\n\n\n\n\n\n\n  ⡠⠊\n⡠⠊\n");
    ceduo_cells_free(cells);
}

static void true_scale_fits_and_centres(void **state)
{
    (void)state;
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

static void frame_cell_is_where_the_point_is_drawn(void **state)
{
    (void)state;
    for (int i = 0; i <= LAST_CHARSET; ++i) {
        enum ceduo_charset charset = (enum ceduo_charset)i;
        struct ceduo_cells *cells = cells_in(9, 6, charset);
        struct ceduo_frame frame = {
            .left = 2, .top = 1, .width = 5, .height = 3, .x0 = -3, .x1 = 7, .y0 = 10, .y1 = 12};
        for (double x = -3; x <= 7; x += 0.37) {
            int column = -1;
            int row = -1;
            double y = 11 + 0.1 * x;
            bool inside = ceduo_frame_cell(&frame, kind_of(charset), x, y, &column, &row);
            assert_int_equal(inside, y > 10 - 0.5);
            ceduo_cells_clear(cells);
            draw_point(cells, &frame, CEDUO_ROLE_WAY, x, y);
            assert_int_equal(ceduo_cells_role(cells, column, row), CEDUO_ROLE_WAY);
        }
        int column;
        int row;
        assert_false(ceduo_frame_cell(&frame, kind_of(charset), 9, 11, &column, &row));
        assert_false(ceduo_frame_cell(&frame, kind_of(charset), 0, 8, &column, &row));
        assert_false(ceduo_frame_cell(&frame, kind_of(charset), (double)NAN, 11, &column, &row));
        ceduo_cells_free(cells);
    }
}

/* ---- Text ---- */

static void labels_are_cut_at_the_canvas(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(4, 1, BRAILLE);
    assert_int_equal(ceduo_cells_label(cells, 2, 0, CEDUO_ROLE_TITLE, "stool"), 5);
    assert_int_equal(ceduo_cells_label(cells, -3, 0, CEDUO_ROLE_TEXT, "Ø m²"), 4);
    expect_text(cells, "² st\n");
    expect_roles(cells, "t TT\n");
    ceduo_cells_clear(cells);
    assert_int_equal(ceduo_cells_label_right(cells, 2, 0, CEDUO_ROLE_TEXT, "±1"), 2);
    expect_and_clear(cells, " ±1\n");
    ceduo_cells_label(cells, 0, 1, CEDUO_ROLE_TEXT, "below");
    ceduo_cells_label(cells, 0, -1, CEDUO_ROLE_TEXT, "above");
    ceduo_cells_label(cells, 9, 0, CEDUO_ROLE_TEXT, "right");
    expect_and_clear(cells, "\n");
    ceduo_cells_free(cells);
}

static void odd_characters_become_question_marks(void **state)
{
    (void)state;
    static const struct {
        const char *text, *utf8, *ascii;
    } cases[] = {
        {"a\tb\x7f", "a?b?\n", "a?b?\n"},
        {"\x80|\xC0\xAF|\xFF", "?|??|?\n", "?|??|?\n"}, /* lone, overlong, never valid */
        {"\xE2\x82|", "??|\n", "??|\n"},                /* broken off within */
        {"|\xF0\x9F", "|??\n", "|??\n"},                /* broken off at the end */
        {"\xED\xA0\x80", "???\n", "???\n"},             /* a surrogate */
        {"\xF4\x90\x80\x80", "????\n", "????\n"},       /* above U+10FFFF */
        {"\xE0\x80\x80\xF0\x80\x80\x80", "???????\n", "???????\n"},
        {"森x", "?x\n", "?x\n"}, /* two cells */
        {"🌲!", "?!\n", "?!\n"},
        {"e\xCC\x81", "e?\n", "e?\n"}, /* a combining accent */
        {"𝑥", "𝑥\n", "?\n"},           /* four bytes, one cell */
        {"⠿Ж", "⠿Ж\n", "??\n"},
    };
    struct ceduo_cells *utf8 = cells_in(12, 1, BRAILLE);
    struct ceduo_cells *ascii = cells_in(12, 1, ASCII);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        ceduo_cells_label(utf8, 0, 0, CEDUO_ROLE_TEXT, cases[i].text);
        ceduo_cells_label(ascii, 0, 0, CEDUO_ROLE_TEXT, cases[i].text);
        expect_and_clear(utf8, cases[i].utf8);
        expect_and_clear(ascii, cases[i].ascii);
    }
    ceduo_cells_free(utf8);
    ceduo_cells_free(ascii);
}

static void ascii_has_near_equivalents(void **state)
{
    (void)state;
    static const char *const pairs[][2] = {
        {"2×3", "2x3"},
        {"±0.3 %", "+-0.3 %"},
        {"0…2", "0...2"},
        {"ADS 1 · 2", "ADS 1 . 2"},
        {"≤ 10 ≥", "<= 10 >="},
        {"a — b–c", "a - b-c"},
        {"35°", "35"},
        {"✔ ✘", "+ x"},
        {"−1", "-1"},
        {"m²", "m2"},
        {"é", "e"},
        {"─│┌┤", "-|++"},
        {"█▏", "##"},
        {"→", "->"},
        {"Ø ∞", "O inf"},
        {"♣", "Y"},
    };
    struct ceduo_cells *ascii = cells_in(12, 1, ASCII);
    struct ceduo_cells *block = cells_in(12, 1, BLOCK);
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; ++i) {
        char text[64];
        ceduo_cells_label(ascii, 0, 0, CEDUO_ROLE_TEXT, pairs[i][0]);
        ceduo_cells_text(ascii, 0, sizeof text, text);
        assert_string_equal(text, pairs[i][1]);
        ceduo_cells_label(block, 0, 0, CEDUO_ROLE_TEXT, pairs[i][0]);
        ceduo_cells_text(block, 0, sizeof text, text);
        assert_string_equal(text, pairs[i][0]);
        ceduo_cells_clear(ascii);
        ceduo_cells_clear(block);
    }
    ceduo_cells_label_right(ascii, 11, 0, CEDUO_ROLE_TEXT, "±0.3…");
    expect_text(ascii, "    +-0.3...\n");
    assert_int_equal(ceduo_cells_label_width(ASCII, "±0.3…"), 8);
    assert_int_equal(ceduo_cells_label_width(BRAILLE, "±0.3…"), 5);
    assert_int_equal(ceduo_cells_label_width(BRAILLE, ""), 0);
    ceduo_cells_free(ascii);
    ceduo_cells_free(block);
}

/* ---- Ticks ---- */

/* The labels of the ticks of a range, with a blank between. */
static void expect_ticks(double lo, double hi, int max_count, const char *expected)
{
    double ticks[CEDUO_TICKS_MAX];
    double step;
    char all[1024] = "";
    int count = ceduo_ticks(lo, hi, max_count, ticks, &step);
    assert_true(count <= max_count || count == 0);
    for (int i = 0; i < count; ++i) {
        char label[CEDUO_TICK_LABEL_SIZE];
        assert_false(ticks[i] == 0.0 && signbit(ticks[i]));
        size_t length = ceduo_tick_label(ticks[i], step, sizeof label, label);
        assert_int_equal(length, strlen(label));
        strcat(all, i > 0 ? " " : "");
        strcat(all, label);
    }
    assert_string_equal(all, expected);
}

static void ticks_are_round(void **state)
{
    (void)state;
    expect_ticks(0, 150, 5, "0 50 100 150");
    expect_ticks(0, 150, 4, "0 50 100 150");
    expect_ticks(0, 150, 3, "0 100");
    expect_ticks(0, 150, 11, "0 20 40 60 80 100 120 140");
    expect_ticks(0, 0.3, 4, "0.0 0.1 0.2 0.3");
    expect_ticks(0, 1, 3, "0.0 0.5 1.0");
    expect_ticks(0.3, 0, 4, "0.0 0.1 0.2 0.3");
    expect_ticks(-1, 1, 5, "-1.0 -0.5 0.0 0.5 1.0");
    expect_ticks(-0.35, 0.35, 8, "-0.3 -0.2 -0.1 0.0 0.1 0.2 0.3");
    expect_ticks(-250, -120, 4, "-250 -200 -150");
    expect_ticks(1203, 1297, 5, "1220 1240 1260 1280");
    double tenths[4];
    assert_int_equal(ceduo_ticks(0, 0.3, 4, tenths, NULL), 4);
    assert_true(tenths[3] == 0.3); /* the nearest number there is, and not 3 * 0.1 */
}

static void ticks_of_awkward_ranges(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    expect_ticks(0, 0, 5, "0");
    expect_ticks(-0.0, -0.0, 5, "0");
    expect_ticks(7.25, 7.25, 5, "7.25");
    expect_ticks(-3, -3, 1, "-3");
    expect_ticks(0, 1e-9, 3, "0 5e-10 1e-9");
    expect_ticks(-1e-9, 1e-9, 3, "-1e-9 0 1e-9");
    expect_ticks(0, 1e12, 6, "0 2e11 4e11 6e11 8e11 1e12");
    expect_ticks(1e12, 1e12 + 10, 3, "1000000000000 1000000000005 1000000000010");
    expect_ticks(1e12, 1e12 + 1e-3, 3, "1e12");
    expect_ticks(0, 1e-305, 3, "0");
    expect_ticks(0, 1e299, 3, "0 5e298 1e299");
    expect_ticks(-1e308, 1e308, 3, "");
    expect_ticks(0, nan, 3, "");
    expect_ticks(-(double)INFINITY, 0, 3, "");
    expect_ticks(0, 1, 0, "");
    expect_ticks(0, 1, -4, "");
    /* Only one is allowed, and the next coarser step has none in the range. */
    expect_ticks(6, 8, 1, "6");
    expect_ticks(0, 1, 1, "0");
}

static void ticks_are_evenly_spaced_and_never_too_many(void **state)
{
    (void)state;
    double ticks[CEDUO_TICKS_MAX];
    double step;
    for (int k = -12; k <= 12; ++k) {
        double size = pow(10, k);
        for (int i = 1; i < 60; ++i) {
            double lo = (i * 37 % 23 - 11) * 0.31 * size;
            double hi = lo + i * 0.17 * size;
            int max_count = 1 + i % 12;
            int count = ceduo_ticks(lo, hi, max_count, ticks, &step);
            assert_in_range(count, 1, max_count);
            for (int j = 0; j < count; ++j) {
                assert_true(ticks[j] >= lo - 1e-6 * step && ticks[j] <= hi + 1e-6 * step);
                assert_true(j == 0 || fabs(ticks[j] - ticks[j - 1] - step) < 1e-6 * step);
            }
        }
    }
    assert_int_equal(ceduo_ticks(0, 60, 100000, ticks, NULL), 61);
    assert_in_range(ceduo_ticks(0, 99, 100000, ticks, NULL), 1, CEDUO_TICKS_MAX);
}

static void tick_labels_have_no_minus_nought(void **state)
{
    (void)state;
    char label[CEDUO_TICK_LABEL_SIZE];
    ceduo_tick_label(-0.0, 1, sizeof label, label);
    assert_string_equal(label, "0");
    ceduo_tick_label(-1e-9, 0.1, sizeof label, label);
    assert_string_equal(label, "0.0");
    ceduo_tick_label(-0.1, 0.1, sizeof label, label);
    assert_string_equal(label, "-0.1");
    ceduo_tick_label(-2e10, 1e10, sizeof label, label);
    assert_string_equal(label, "-2e10");
    ceduo_tick_label(-1e-10, 1e-10, sizeof label, label);
    assert_string_equal(label, "-1e-10");
    assert_int_equal(ceduo_tick_label(1234, 1, 3, label), 2);
    assert_string_equal(label, "12");
    assert_int_equal(ceduo_tick_label(1234, 1, 0, NULL), 0);
}

/* ---- Axes ---- */

static void axes_in_unicode_and_ascii(void **state)
{
    (void)state;
    static const char *const expected[] = {
        "100┤\n"
        "   │\n"
        " 50┤\n"
        "   │\n"
        "  0┤\n"
        "   └┬───────────┬───────────┬──────────\n"
        "    0           50         100 m\n",
        "100+\n"
        "   |\n"
        " 50+\n"
        "   |\n"
        "  0+\n"
        "   ++-----------+-----------+----------\n"
        "    0           50         100 m\n",
    };
    for (int i = 0; i < 2; ++i) {
        enum ceduo_charset charset = i == 0 ? BRAILLE : ASCII;
        struct ceduo_cells *cells = cells_in(40, 7, charset);
        struct ceduo_frame frame = {.width = 35, .height = 5, .x1 = 140, .y1 = 100};
        frame.left = ceduo_frame_axis_width(&frame, kind_of(charset));
        assert_int_equal(frame.left, 4);
        ceduo_canvas_axis_left(&cells->canvas, &frame);
        ceduo_canvas_axis_bottom(&cells->canvas, &frame, "m");
        expect_text(cells, expected[i]);
        ceduo_cells_free(cells);
    }
}

static void axis_labels_leave_out_what_has_no_room(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(12, 5, ASCII);
    struct ceduo_frame frame = {.left = 3, .width = 9, .height = 3, .x1 = 100, .y0 = 0, .y1 = 1000};
    ceduo_canvas_axis_left(&cells->canvas, &frame); /* 1000 does not fit in two columns, 0 does */
    expect_and_clear(cells, "  +\n  |\n 0+\n\n\n");
    ceduo_canvas_axis_bottom(&cells->canvas, &frame, "m");
    expect_and_clear(cells, "\n\n\n   +-------+\n   0 m   100\n");
    ceduo_canvas_axis_bottom(&cells->canvas, &frame, "kilojoules");
    expect_and_clear(cells, "\n\n\n   +-------+\n   0     100\n");
    frame.x0 = 123456;
    frame.x1 = 123457;
    frame.width = 4;
    ceduo_canvas_axis_bottom(&cells->canvas, &frame, NULL);
    expect_and_clear(cells, "\n\n\n   ----\n\n");
    ceduo_cells_free(cells);
}

static void unit_without_room_after_the_last_number_follows_the_first(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(36, 3, ASCII);
    struct ceduo_frame frame = {.left = 1, .width = 35, .height = 1, .x1 = 120, .y1 = 1};
    ceduo_canvas_axis_bottom(&cells->canvas, &frame, "m");
    expect_text(cells, "\n +-----+----+-----+-----+----+-----+\n 0 m   20   40    60    80  100  120\n");
    ceduo_cells_free(cells);
}

static void strip_of_two_rows_has_two_labels(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(6, 2, BRAILLE);
    struct ceduo_frame frame = {.left = 2, .width = 4, .height = 2, .x1 = 1, .y1 = 2};
    ceduo_canvas_axis_left(&cells->canvas, &frame);
    expect_text(cells, "2┤\n0┤\n");
    ceduo_cells_free(cells);
}

static void turned_axis_has_its_unit_at_the_right(void **state)
{
    (void)state;
    struct ceduo_cells *cells = cells_in(20, 3, ASCII);
    struct ceduo_frame frame = {.left = 1, .width = 19, .height = 1, .x0 = 25, .x1 = -5, .y1 = 1};
    ceduo_canvas_axis_bottom(&cells->canvas, &frame, "y");
    expect_text(cells, "\n ---+-----+-----+---\n    20    10    0 y\n");
    ceduo_cells_free(cells);
}

/* Counts the runs of text in a row that are at least two blanks apart. */
static int words_in(const char *row)
{
    int words = 0;
    int blanks = 2;
    for (; *row != '\0'; ++row) {
        words += *row != ' ' && blanks >= 2;
        blanks = *row == ' ' ? blanks + 1 : 0;
    }
    return words;
}

static void bottom_labels_never_touch(void **state)
{
    (void)state;
    for (int width = 4; width < 90; ++width) {
        struct ceduo_cells *cells = cells_in(width + 3, 4, ASCII);
        for (int k = -9; k < 12; ++k) {
            struct ceduo_frame frame = {.left = 2, .width = width, .height = 2, .y1 = 1};
            frame.x0 = -0.37 * pow(10, k);
            frame.x1 = 1.13 * pow(10, k) * (1 + width % 5);
            ceduo_cells_clear(cells);
            ceduo_canvas_axis_bottom(&cells->canvas, &frame, NULL);
            char line[128];
            char labels[128];
            ceduo_cells_text(cells, 2, sizeof line, line);
            ceduo_cells_text(cells, 3, sizeof labels, labels);
            int ticks = 0;
            for (const char *c = line; *c != '\0'; ++c) {
                ticks += *c == '+';
            }
            assert_int_equal(words_in(labels), ticks);
            assert_true(strlen(labels) <= (size_t)width + 2);
        }
        ceduo_cells_free(cells);
    }
}

static void axis_width_holds_every_label(void **state)
{
    (void)state;
    for (int height = 1; height < 40; ++height) {
        struct ceduo_frame frame = {.width = 4, .height = height, .x1 = 1, .y0 = -12.5, .y1 = 3.3 * height};
        frame.left = ceduo_frame_axis_width(&frame, kind_of(BRAILLE));
        struct ceduo_cells *cells = cells_in(frame.left + 4, height, BRAILLE);
        ceduo_canvas_axis_left(&cells->canvas, &frame);
        int widest = 0;
        int last_tick = -2;
        for (int row = 0; row < height; ++row) {
            bool tick = ceduo_cells_glyph(cells, frame.left - 1, row) == 0x2524;
            bool label = frame.left > 1 && ceduo_cells_glyph(cells, frame.left - 2, row) != ' ';
            assert_int_equal(tick, label);
            assert_false(tick && height > 3 && row == last_tick + 1); /* a row between two labels */
            last_tick = tick ? row : last_tick;
            widest = ceduo_cells_glyph(cells, 0, row) != ' ' ? 1 : widest;
        }
        assert_int_equal(widest, 1); /* and wastes no column */
        ceduo_cells_free(cells);
    }
    struct ceduo_frame bad = {.width = 4, .height = 0, .x1 = 1, .y1 = 1};
    assert_int_equal(ceduo_frame_axis_width(&bad, kind_of(BRAILLE)), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_are_limited),
        cmocka_unit_test(blank_canvas_is_empty_rows),
        cmocka_unit_test(each_dot_has_its_glyph),
        cmocka_unit_test(all_quadrants),
        cmocka_unit_test(row_text_is_cut_at_a_character),
        cmocka_unit_test(rank_decides_the_role_whoever_draws_first),
        cmocka_unit_test(text_hides_dots),
        cmocka_unit_test(every_role_has_its_letter),
        cmocka_unit_test(lines_in_each_charset),
        cmocka_unit_test(steep_and_flat_lines_have_no_gaps),
        cmocka_unit_test(what_lies_outside_is_clipped),
        cmocka_unit_test(frame_may_hang_over_the_canvas),
        cmocka_unit_test(what_is_not_finite_is_never_drawn),
        cmocka_unit_test(useless_frames_draw_nothing),
        cmocka_unit_test(axes_may_be_turned_round),
        cmocka_unit_test(stairs_hold_the_value_before),
        cmocka_unit_test(rules_are_dotted),
        cmocka_unit_test(bars_go_by_eighths),
        cmocka_unit_test(density_shows_the_most_travelled_dots),
        cmocka_unit_test(a_way_counts_once_where_its_parts_meet),
        cmocka_unit_test(density_counts_only_within_the_canvas),
        cmocka_unit_test(forty_five_degrees_are_forty_five_degrees),
        cmocka_unit_test(true_scale_moves_one_dot_across_for_each_dot_up),
        cmocka_unit_test(true_scale_fits_and_centres),
        cmocka_unit_test(frame_cell_is_where_the_point_is_drawn),
        cmocka_unit_test(labels_are_cut_at_the_canvas),
        cmocka_unit_test(odd_characters_become_question_marks),
        cmocka_unit_test(ascii_has_near_equivalents),
        cmocka_unit_test(ticks_are_round),
        cmocka_unit_test(ticks_of_awkward_ranges),
        cmocka_unit_test(ticks_are_evenly_spaced_and_never_too_many),
        cmocka_unit_test(tick_labels_have_no_minus_nought),
        cmocka_unit_test(axes_in_unicode_and_ascii),
        cmocka_unit_test(axis_labels_leave_out_what_has_no_room),
        cmocka_unit_test(unit_without_room_after_the_last_number_follows_the_first),
        cmocka_unit_test(strip_of_two_rows_has_two_labels),
        cmocka_unit_test(turned_axis_has_its_unit_at_the_right),
        cmocka_unit_test(bottom_labels_never_touch),
        cmocka_unit_test(axis_width_holds_every_label),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
