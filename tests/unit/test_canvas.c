/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "local.h"
#include "table.h"
#include "unit/grid.h"

/* ---- drawings ---- */

#define NUMBERS 20

struct drawing {
    struct ceduo_cells *cells;
    struct ceduo_frame frame;
    enum ceduo_role role;
    int cells_written; /* cells written by texts */
};

/* Draw a line through n points. */
static void draw_points(struct drawing *d, const char *name, size_t n, const double *numbers)
{
    double x[NUMBERS / 2], y[NUMBERS / 2];
    for (size_t i = 0; i < n; i++) {
        x[i] = numbers[2 * i];
        y[i] = numbers[2 * i + 1];
    }
    if (strcmp(name, "stairs") == 0)
        ceduo_canvas_stairs(&d->cells->canvas, &d->frame, d->role, n, x, y);
    else if (strcmp(name, "poly") == 0)
        ceduo_canvas_polyline(&d->cells->canvas, &d->frame, d->role, CEDUO_STROKE_PLAIN, n, x, y);
    else
        ceduo_canvas_polyline(&d->cells->canvas, &d->frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_TRAJECTORY, n, x, y);
}

/* Run one command of a row of unit/drawings.txt. */
static void run_command(struct drawing *d, char *command)
{
    static const char roles[] = " tdTagcemwsSbCGBWrox";
    struct ceduo_canvas *c = &d->cells->canvas;
    char name[16], *text;
    int length = 0, ints[4] = {0};
    double numbers[NUMBERS] = {0};
    size_t n = 0;
    sscanf(command, " %15s%n", name, &length);
    for (char *from = command + length; n < NUMBERS; from = text, n++) {
        numbers[n] = strtod(from, &text);
        if (text == from)
            break;
        if (n < 4 && fabs(numbers[n]) < 3e9)
            ints[n] = (int)numbers[n];
    }
    text += strspn(text, " ");
    text = *text == '\'' ? text + 1 : NULL;
#define IS(word) (strcmp(name, word) == 0)
    if (IS("frame"))
        d->frame =
            (struct ceduo_frame){ints[0], ints[1], ints[2], ints[3], numbers[4], numbers[5], false, numbers[6], numbers[7]};
    else if (IS("scale"))
        assert_true(ceduo_frame_true_scale(&d->frame, c, numbers[0], numbers[1], numbers[2], numbers[3]));
    else if (IS("widen"))
        d->frame.left = ceduo_frame_axis_width(&d->frame, c);
    else if (IS("integers"))
        d->frame.x_integer = true;
    else if (IS("no-cell"))
        assert_false(ceduo_frame_cell(&d->frame, c, numbers[0], numbers[1], &ints[0], &ints[1]));
    else if (IS("number") || IS("role"))
        d->role = (enum ceduo_role)(IS("role") ? (int)(strchr(roles, text[0]) - roles) : ints[0]);
    else if (IS("line"))
        ceduo_canvas_line(c, &d->frame, d->role, numbers[0], numbers[1], numbers[2], numbers[3]);
    else if (IS("rule-x"))
        ceduo_canvas_rule_x(c, &d->frame, d->role, numbers[0]);
    else if (IS("rule-y"))
        ceduo_canvas_rule_y(c, &d->frame, d->role, numbers[0]);
    else if (IS("bar"))
        ceduo_canvas_bar(c, ints[0], ints[1], ints[2], numbers[3], d->role);
    else if (IS("poly") || IS("stairs") || IS("trajectory"))
        draw_points(d, name, n / 2, numbers);
    else if (IS("start"))
        ceduo_canvas_cloud_start(c);
    else if (IS("show"))
        ceduo_canvas_cloud_show(c, numbers[0]);
    else if (IS("clear"))
        ceduo_cells_clear(d->cells);
    else if (IS("left"))
        ceduo_canvas_axis_left(c, &d->frame);
    else if (IS("bottom"))
        ceduo_canvas_axis_bottom(c, &d->frame, text);
    else if (IS("label"))
        d->cells_written += ceduo_cells_label(d->cells, ints[0], ints[1], d->role, text);
    else if (IS("right"))
        d->cells_written += ceduo_canvas_label_right(c, ints[0], ints[1], d->role, text);
    else if (IS("text"))
        d->cells_written += ceduo_canvas_draw_text(c, ints[0], ints[1], ints[2], d->role, text);
    else if (IS("end"))
        d->cells_written += ceduo_cells_label_end(d->cells, ints[0], ints[1], ints[2], d->role, text);
    else
        fail_msg("unknown command '%s'", command);
}

TEST(drawings_are_as_expected)
{
    static const char *const sections[] = {"lines", "bars", "density", "true scale", "cells", "axes"};
    for (size_t i = 0; i < LENGTH(sections); i++)
        for (TABLE(row, "unit/drawings.txt", sections[i])) {
            int width, height;
            char charset[8], commands[1024], *rest = commands;
            assert_int_equal(sscanf(row.at[0], "%dx%d %7s", &width, &height, charset), 3);
            LOCAL(ceduo_cells, cells) = cells_in(width, height,
                                                 charset[0] == 'a'   ? ASCII
                                                 : charset[1] == 'r' ? BRAILLE
                                                                     : BLOCK);
            struct drawing d = {cells, frame_in_dots(cells), CEDUO_ROLE_TRAJECTORY, 0};
            snprintf(commands, sizeof commands, "%s", row.at[1]);
            for (char *command; (command = strsep(&rest, ";"));)
                run_command(&d, command);
            LOCAL_BYTES char *text = ceduo_cells_dump(cells), *letters = ceduo_cells_roles(cells);
            if ((row.at[2][0] && strcmp(text, row.at[2]) != 0) || (row.at[3][0] && strcmp(letters, row.at[3]) != 0) ||
                (row.at[4][0] && atoi(row.at[4]) != d.cells_written))
                fail_msg("%s: %s:\n%s%s%d cells, wanted\n%s%s%s", row.at[0], row.at[1], text, letters, d.cells_written,
                         row.at[2], row.at[3], row.at[4]);
        }
}

/* ---- true scale ---- */

TEST(a_diagonal_is_at_45_degrees_at_true_scale)
{
    LOCAL(ceduo_cells, cells) = cells_in(30, 9, BRAILLE);
    struct ceduo_frame frame = {.width = 30, .height = 9};
    assert_true(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 0, 150, 0, 20));
    double dot = (frame.x1 - frame.x0) / 59;
    assert_float_equal((frame.y1 - frame.y0) / 35, dot, 1e-12);
    /* Draw the diagonal from the lower left dot: one dot up for each dot to the right. */
    ceduo_canvas_line(&cells->canvas, &frame, CEDUO_ROLE_TRAJECTORY, frame.x0, frame.y0, frame.x0 + 7 * dot,
                      frame.y0 + 7 * dot);
    expect_text(cells, "\n\n\n\n\n\n\n  ⡠⠊\n⡠⠊\n");
}

TEST(true_scale_fits_and_centres)
{
    struct ceduo_frame frame = {.width = 10, .height = 5}; /* 20 x 20 dots of braille */
    assert_true(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 0, 19, 4, 10));
    assert_float_equal(frame.x0, 0, 1e-12);
    assert_float_equal(frame.x1, 19, 1e-12);
    assert_float_equal(frame.y0, -2.5, 1e-12);
    assert_float_equal(frame.y1, 16.5, 1e-12);
    assert_true(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 10, 10, 0, 38)); /* a cliff */
    assert_float_equal(frame.x0, -9, 1e-12);
    assert_float_equal(frame.x1, 29, 1e-12);
    assert_float_equal(frame.y1, 38, 1e-12);
    struct ceduo_frame before = frame;
    assert_false(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 1, 1, 2, 2));
    assert_false(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 1, 0, 0, 2));
    assert_false(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 0, (double)NAN, 0, 2));
    assert_false(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 0, (double)INFINITY, 0, 2));
    assert_memory_equal(&frame, &before, sizeof frame);
    frame.width = 1;
    assert_false(ceduo_frame_true_scale(&frame, find_canvas(BRAILLE), 0, 1, 0, 1));
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
            bool inside = ceduo_frame_cell(&frame, find_canvas(charset), x, y, &column, &row);
            assert_int_equal(inside, y > 10 - 0.5);
            ceduo_cells_clear(cells);
            draw_point(cells, &frame, CEDUO_ROLE_TRAJECTORY, x, y);
            assert_int_equal(ceduo_cells_role(cells, column, row), CEDUO_ROLE_TRAJECTORY);
        }
        int column, row;
        assert_false(ceduo_frame_cell(&frame, find_canvas(charset), 9, 11, &column, &row));
        assert_false(ceduo_frame_cell(&frame, find_canvas(charset), 0, 8, &column, &row));
        assert_false(ceduo_frame_cell(&frame, find_canvas(charset), (double)NAN, 11, &column, &row));
    }
}
