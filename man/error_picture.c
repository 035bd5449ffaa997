/* SPDX-License-Identifier: GPL-3.0-or-later */
/* error_picture CSV SVG: draws what bench_error found, the error of the mean energy against run time, with the
 * program's own vectors. Both axes are logarithmic. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "view/svg.h"

#define COLUMNS     92
#define ROWS        24
#define POINTS_MOST 16

static const struct series {
    const char *what, *numbers, *name;
    enum ceduo_role role;
} all_series[] = {{"paper-bare", "core", "ceduo, without forest", CEDUO_ROLE_WOOD},
                  {"paper-stems", "core", "ceduo, through the stems", CEDUO_ROLE_STEM},
                  {"spread-starts", "plain", "plain C loop, without forest", CEDUO_ROLE_BARE},
                  {"spread-starts", "antithetic", "the loop, antithetic numbers", CEDUO_ROLE_WAY},
                  {"spread-starts", "sobol", "the loop, Sobol numbers", CEDUO_ROLE_ENVELOPE}};
#define SERIES (sizeof all_series / sizeof all_series[0])

struct points {
    size_t n;
    double x[POINTS_MOST], y[POINTS_MOST]; /* powers of ten: s, kJ */
};

static void add_row(struct points *points, const char *line)
{
    char what[32], numbers[32], quantity[32];
    double seconds, error;
    if (sscanf(line, "%31[^,],%31[^,],%*[^,],%*[^,],%lf,%31[^,],%lf", what, numbers, &seconds, quantity, &error) != 5 ||
        strcmp(quantity, "mean_energy_kJ") != 0)
        return;
    for (size_t i = 0; i < SERIES; i++)
        if (strcmp(what, all_series[i].what) == 0 && strcmp(numbers, all_series[i].numbers) == 0 && points[i].n < POINTS_MOST) {
            points[i].x[points[i].n] = log10(seconds);
            points[i].y[points[i].n++] = log10(error);
        }
}

/* Ticks at the powers of ten from lo to hi. */
static int decades(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, bool down, int lo, int hi,
                   struct ceduo_tick *ticks)
{
    int n = 0;
    for (int i = lo; i <= hi; i++) {
        double across, deep;
        int column, row;
        if (!ceduo_frame_place(frame, canvas, down ? frame->x0 : i, down ? i : frame->y0, &across, &deep) ||
            !ceduo_frame_cell(frame, canvas, down ? frame->x0 : i, down ? i : frame->y0, &column, &row))
            continue;
        struct ceduo_tick *tick = &ticks[n++];
        *tick = (struct ceduo_tick){.cell = down ? row : column, .at = down ? deep : across};
        snprintf(tick->label, sizeof tick->label, "%g", pow(10, i));
        int length = (int)strlen(tick->label);
        tick->start = down ? frame->left - 1 - length : column - (length - 1) / 2;
    }
    return n;
}

static void draw_series(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, size_t i, const struct points *p)
{
    const struct series *s = &all_series[i];
    int row = 2 + (int)i, column, y;
    char number[2] = {(char)('1' + i), '\0'};
    ceduo_canvas_polyline(canvas, frame, s->role, p->n, p->x, p->y);
    for (size_t k = 0; k < p->n; k++) {
        ceduo_canvas_disc(canvas, frame, s->role, p->x[k], p->y[k], 0.03);
        if (k + 1 == p->n && ceduo_frame_cell(frame, canvas, p->x[k], p->y[k], &column, &y))
            ceduo_canvas_label(canvas, column + 2, y, s->role, number);
    }
    ceduo_canvas_label(canvas, COLUMNS - 32, row, s->role, number);
    ceduo_canvas_label(canvas, COLUMNS - 30, row, s->role, s->name);
}

static void draw(struct ceduo_canvas *canvas, const struct points *points)
{
    struct ceduo_frame frame = {
        .left = 7, .top = 2, .width = COLUMNS - 9, .height = ROWS - 5, .x0 = -4, .x1 = 1, .y0 = -2, .y1 = 1};
    struct ceduo_tick ticks[8];
    int n = decades(&frame, canvas, true, -2, 1, ticks);
    ceduo_canvas_label(canvas, 0, 0, CEDUO_ROLE_TITLE,
                       "error of the mean energy, kJ (of 115), against the time that the run takes");
    canvas->surface->axis_left(canvas->to, &frame, n, ticks);
    n = decades(&frame, canvas, false, -4, 1, ticks);
    canvas->surface->axis_bottom(canvas->to, &frame, n, ticks);
    canvas->surface->axis_unit(canvas->to, frame.left + frame.width - 8, frame.top + frame.height + 1, "s");
    for (size_t i = 0; i < SERIES; i++)
        draw_series(canvas, &frame, i, &points[i]);
}

int main(int argc, char **argv)
{
    struct points points[SERIES] = {{0}};
    struct text text = {0};
    struct ceduo_html html = {.text = &text};
    char line[512];
    FILE *in = argc == 3 ? fopen(argv[1], "r") : NULL;
    struct ceduo_svg *svg = ceduo_svg_create(COLUMNS, ROWS);
    if (!in || !svg) {
        fprintf(stderr, "usage: error_picture CSV SVG\n");
        return 2;
    }
    while (fgets(line, sizeof line, in))
        add_row(points, line);
    fclose(in);
    draw(ceduo_svg_canvas(svg), points);
    ceduo_svg_write(&html, svg,
                    &(struct ceduo_svg_words){.title = "Error of the mean energy against run time",
                                              .description = "Five falling lines on logarithmic axes: ten times the time "
                                                             "leaves a third of the error; ceduo needs the least time."});
    ceduo_svg_free(svg);
    FILE *out = text.failed ? NULL : fopen(argv[2], "w");
    bool good = out && fwrite(text.bytes, 1, text.length, out) == text.length;
    good = out && fclose(out) == 0 && good;
    ceduo_text_free(&text);
    return good ? 0 : 1;
}
