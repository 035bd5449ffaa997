/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The vector surface: positions of lines, axes, bars, discs and text on a page; and the writer of HTML. A cell is 8 units wide
 * and 16 high, so that positions can be computed by hand. */
#include "expect.h"
#include "local.h"

#include "unit/grid.h"

#include <stdio.h>

#include "view/svg.h"

/* Return a picture as the text of its file; caller frees. */
static char *read_picture(struct ceduo_svg *svg)
{
    struct text text = {0};
    struct ceduo_html html = {.text = &text};
    ceduo_svg_write(&html, svg, "p", "Title <1>", "What \"it\" shows");
    ceduo_svg_free(svg);
    assert_false(text.failed);
    assert_int_equal(html.depth, 0);
    return text.bytes;
}

static void expect_has(const char *whole, const char *part)
{
    if (!strstr(whole, part))
        fail_msg("'%s' is missing in:\n%s", part, whole);
}

/* Dots have a centre: the first column of dots of a frame at cell 2 is at 2 * 8 + 2 units. */
static struct ceduo_frame make_frame(int width, int height)
{
    return (struct ceduo_frame){
        .left = 2, .top = 1, .width = width, .height = height, .x1 = 2 * width - 1, .y1 = 4 * height - 1};
}

TEST(lines_have_exact_coordinates)
{
    struct ceduo_svg *svg = ceduo_svg_create(20, 10);
    struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
    struct ceduo_frame frame = make_frame(10, 5);
    double x[] = {0, 1.25, 2.5, 10}, y[] = {0, 0, 0, 5.5};
    ceduo_canvas_polyline(canvas, &frame, CEDUO_ROLE_FOREST, CEDUO_STROKE_PLAIN, 4, x, y);
    ceduo_canvas_rule_x(canvas, &frame, CEDUO_ROLE_CONTROL, 4);
    assert_false(ceduo_canvas_is_blank(canvas, 2, 5));
    assert_true(ceduo_canvas_is_blank(canvas, 15, 8));
    LOCAL_BYTES char *picture = read_picture(svg);
    expect_has(picture, "d=\"M18 94L28 94L58 72\""); /* the middle point of the straight part is dropped */
    expect_has(picture, "stroke-dasharray=\"4 4\"");
    expect_has(picture, "d=\"M34 18L34 94\"");
}

/* Half a circle of many points becomes far fewer points within 0.3 units, drawn from either end. */
TEST(curves_need_few_points)
{
    enum { N = 1000 };
    static double x[N], y[N];
    for (int side = -1; side <= 1; side += 2) {
        struct ceduo_svg *svg = ceduo_svg_create(60, 20);
        struct ceduo_frame frame = {.width = 60, .height = 20, .x1 = 119, .y1 = 79};
        for (int i = 0; i < N; i++) {
            x[i] = 60 + side * 50 * cos(M_PI * i / (N - 1));
            y[i] = 10 + 50 * sin(M_PI * i / (N - 1));
        }
        ceduo_canvas_polyline(ceduo_svg_canvas(svg), &frame, CEDUO_ROLE_MEAN, CEDUO_STROKE_PLAIN, N, x, y);
        char *picture = read_picture(svg), *at = strstr(picture, "d=\"M") + 4;
        double px, py, qx, qy;
        int points = 1, used;
        assert_int_equal(sscanf(at, "%lf %lf%n", &px, &py, &used), 2);
        for (at += used; *at == 'L'; at += used, points++, px = qx, py = qy) {
            assert_int_equal(sscanf(at, "L%lf %lf%n", &qx, &qy, &used), 2);
            /* the centre of a chord is within its height above a circle of 200 units around (242, 278) */
            double error = fabs(hypot((px + qx) / 2 - 242, (py + qy) / 2 - 278) - 200);
            if (error > 0.7)
                fail_msg("off by %g units after %d points", error, points);
        }
        EXPECT(points, <=, 80);
        free(picture);
    }
}

/* A line to the left, at angle pi or -pi, is one line if its points lie within 0.3 units of it; if they are 0.4 off to either
 * side, it bends. */
TEST(angles_go_round)
{
    for (int bent = 0; bent < 2; bent++) {
        struct ceduo_svg *svg = ceduo_svg_create(60, 20);
        struct ceduo_frame frame = {.width = 60, .height = 20, .x1 = 119, .y1 = 79};
        double x[11], y[11];
        for (int i = 0; i < 11; i++) {
            x[i] = 110 - 10 * i;
            y[i] = 39 + (i == 0 ? 0 : (bent ? 0.1 : 0.0125) * (i % 2 ? 1 : -1)); /* dots of 4 units */
        }
        y[10] = 39;
        ceduo_canvas_polyline(ceduo_svg_canvas(svg), &frame, CEDUO_ROLE_MEAN, CEDUO_STROKE_PLAIN, 11, x, y);
        char *picture = read_picture(svg), *path = strstr(picture, "d=\"M");
        int points = 0;
        for (char *at = path; *at != '/'; at++)
            points += *at == 'L';
        if (!bent)
            expect_has(picture, "d=\"M442 162L42 162\"");
        else
            EXPECT(points, >=, 9);
        free(picture);
    }
}

/* The smallest disc has a radius of one unit; cells under a disc are occupied, the neighbours are not. */
TEST(discs)
{
    struct ceduo_svg *svg = ceduo_svg_create(30, 10);
    struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
    struct ceduo_frame frame = {.width = 30, .height = 10, .x1 = 59, .y1 = 39};
    ceduo_canvas_disc(canvas, &frame, CEDUO_ROLE_STEM, 10, 20, 0.01);
    ceduo_canvas_disc(canvas, &frame, CEDUO_ROLE_STEM, 40, 20, 8); /* 32 units around (162, 78) */
    for (int column = 0; column < 30; column++)
        for (int row = 0; row < 10; row++) {
            double x = 8 * column + 4, y = 16 * row + 8; /* centre of the cell */
            bool far = fabs(x - 162) > 32 + 8 || fabs(y - 78) > 32 + 12, near = fabs(x - 162) < 32 - 4 && fabs(y - 78) < 32 - 8;
            bool other = fabs(x - 42) < 8 && fabs(y - 78) < 12;
            if (near || (far && !other))
                EXPECT(ceduo_canvas_is_blank(canvas, column, row), ==, !near);
        }
    LOCAL_BYTES char *picture = read_picture(svg);
    expect_has(picture, "M41 78A1 1 0 0 0 43 78A1 1 0 0 0 41 78");
    expect_has(picture, "M130 78A32 32 0 0 0 194 78A32 32 0 0 0 130 78");
}

/* A rock that bounces in a pit for ever draws only the visible part; one that leaves is drawn to its end. */
TEST(a_rock_bouncing_in_a_pit_draws_little)
{
    enum { N = 20000 };
    static double x[N], y[N];
    size_t length[2];
    for (int leaves = 0; leaves < 2; leaves++) {
        struct ceduo_svg *svg = ceduo_svg_create(100, 20);
        struct ceduo_frame frame = {.width = 100, .height = 20, .x1 = 199, .y1 = 79};
        int n = leaves ? 1000 : N;
        for (int i = 0; i < n; i++) {
            x[i] = leaves ? 199.0 * i / (n - 1) : 20 + 10 * sin(i);
            y[i] = 40 + 30 * sin(1.7 * i);
        }
        struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
        ceduo_canvas_cloud_start(canvas);
        ceduo_canvas_polyline(canvas, &frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_TRAJECTORY, (size_t)n, x, y);
        ceduo_canvas_cloud_show(canvas, 0);
        LOCAL_BYTES char *picture = read_picture(svg);
        length[leaves] = strlen(picture);
        if (leaves)
            expect_has(picture, "L798 "); /* the last point: 199 dots of 4 units, from the centre of the first */
    }
    assert_true(length[0] < 10000);
    assert_true(length[1] > 8000);
}

TEST(axes_and_bars)
{
    struct ceduo_svg *svg = ceduo_svg_create(30, 10);
    struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
    struct ceduo_frame frame = {.left = 4, .top = 1, .width = 20, .height = 5, .x1 = 39, .y1 = 19};
    ceduo_canvas_axis_left(canvas, &frame);
    ceduo_canvas_axis_bottom(canvas, &frame, "m");
    ceduo_canvas_bar(canvas, 2, 9, 10, 0.25, CEDUO_ROLE_GOOD);
    ceduo_canvas_disc(canvas, &frame, CEDUO_ROLE_STEM, 10, 10, 1);
    assert_false(ceduo_canvas_is_blank(canvas, 3, 3)); /* the axis itself */
    LOCAL_BYTES char *picture = read_picture(svg);
    expect_has(picture, "M29.5 16V96");    /* left of the frame, over its rows */
    expect_has(picture, "M29.5 98.5H192"); /* below it */
    expect_has(picture, "text-anchor=\"end\">10</text>");
    expect_has(picture, "x=\"34.5\""); /* 0 is at the centre of the first column of dots */
    expect_has(picture, ">m</text>");
    expect_has(picture, "M16 147h20v10h-20z");               /* a quarter of ten cells */
    expect_has(picture, "A4 4 0 0 0 78 54A4 4 0 0 0 70 54"); /* around (74, 54): 4 * (8 + 10.5), 4 * (4 + 9.5) */
}

TEST(text_and_signs)
{
    struct ceduo_svg *svg = ceduo_svg_create(40, 6);
    struct ceduo_canvas *canvas = ceduo_svg_canvas(svg);
    ceduo_canvas_label(canvas, 1, 0, CEDUO_ROLE_TEXT, "one two  <three>");
    ceduo_canvas_label(canvas, 1, 2, CEDUO_ROLE_BELT, "\xe2\x94\x9c\xe2\x94\x80 a \xe2\x94\xa4");
    LOCAL_BYTES char *picture = read_picture(svg);
    expect_has(picture, "<text x=\"8\" y=\"12\" textLength=\"56\" fill=\"#1c1c1c\">one two</text>");
    expect_has(picture,
               "<text x=\"80\" y=\"12\" textLength=\"56\" fill=\"#1c1c1c\">&lt;three&gt;</text>"); /* after two blanks */
    expect_has(picture,
               "<text x=\"8\" y=\"44\" textLength=\"48\" fill=\"#2f6b2f\">\xe2\x94\x9c\xe2\x94\x80 a \xe2\x94\xa4</text>");
    expect_has(picture, "aria-label=\"Title &lt;1&gt;\"");
    expect_has(picture, "<desc id=\"p-d\">What &quot;it&quot; shows</desc>");
}

TEST(screens)
{
    LOCAL(ceduo_cells, cells) = ceduo_cells_create(10, 2, CEDUO_CHARSET_BRAILLE);
    LOCAL_TEXT(text);
    ceduo_cells_label(cells, 0, 0, CEDUO_ROLE_CURSOR, " ok ");
    ceduo_cells_set_dot(cells, 0, 4, CEDUO_ROLE_TRAJECTORY);
    ceduo_cells_set_dot(cells, 3, 7, CEDUO_ROLE_TRAJECTORY);
    ceduo_cells_set_code(cells, 5, 1, CEDUO_ROLE_FOREST, 0x2584); /* lower half */
    ceduo_svg_screen(&text, cells, "t");
    expect_has(text.bytes, "xmlns=\"http://www.w3.org/2000/svg\" width=\"96\" height=\"48\"");
    expect_has(text.bytes, "x=\"0\" y=\"0\" width=\"32\" height=\"16\""); /* reversed under the word and its blanks */
    expect_has(text.bytes, "textLength=\"24\" fill=\"#15181c\"> ok</text>");
    expect_has(
        text.bytes,
        "<text x=\"0\" y=\"28\" textLength=\"16\" fill=\"#e08ce0\" font-weight=\"bold\">\xe2\xa0\x81\xe2\xa2\x80</text>");
    expect_has(text.bytes, "<text x=\"40\" y=\"28\" textLength=\"8\" fill=\"#7ec46b\">\xe2\x96\x84</text>");
}

TEST(html_is_escaped)
{
    LOCAL_TEXT(text);
    struct ceduo_html html = {.text = &text};
    ceduo_html_open(&html, "p", "class", "a\"b", "id", NULL, NULL);
    ceduo_html_leaf(&html, "b", "<&>'\"\a\n\xc3\xa8\xff", NULL);
    ceduo_html_close(&html);
    ceduo_html_empty(&html, "meta", "name", "x", NULL);
    ceduo_html_leaf(&html, "li", "1 < 2", NULL);
    assert_string_equal(text.bytes, "<p class=\"a&quot;b\"><b>&lt;&amp;&gt;&#39;&quot;\\x07\n\xc3\xa8\\xff</b>\n</p>\n"
                                    "<meta name=\"x\"/>\n<li>1 &lt; 2</li>\n");
}
