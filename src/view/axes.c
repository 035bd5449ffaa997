/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ticks at round numbers, and axes whose labels never touch. */
#include "canvas.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

/* ---- Ticks ---- */

/* A multiple of the k-th round interval: …, 0.5, 1 (0), 2 (1), 5 (2), 10, … 3 / 10 is 0.3, but 3 * 0.1 is not. */
static double tick_value(double index, int k)
{
    static const int mantissas[] = {1, 2, 5};
    int exponent = (int)floor(k / 3.0);
    double tens = index * mantissas[k - 3 * exponent];
    return exponent < 0 ? tens / pow(10.0, -exponent) : tens * pow(10.0, exponent);
}

/* The first multiple of the interval in lo..hi; returns how many there are. */
static double multiples(double lo, double hi, int k, double *first)
{
    const double slack = 1e-9; /* of an interval: 0.3 belongs to 0..3 * 0.1 */
    double size = tick_value(1.0, k);
    *first = ceil(lo / size - slack);
    return floor(hi / size + slack) - *first + 1.0;
}

int ceduo_ticks(double lo, double hi, int max_count, double *out, double *interval)
{
    double from = fmin(lo, hi), to = fmax(lo, hi), range = to - from, first;
    *interval = 0.0;
    if (max_count < 1 || !isfinite(lo) || !isfinite(hi) || range > 1e300)
        return 0;
    if (range < 1e-300 || range < 1e-12 * fmax(fabs(from), fabs(to))) {
        *out = lo == 0.0 ? 0.0 : lo; /* never -0 */
        return 1;
    }
    max_count = max_count < CEDUO_TICKS_MAX ? max_count : CEDUO_TICKS_MAX;
    int k = 3 * (int)floor(log10(range / max_count));
    /* 6..8 has no multiple of 5; a tick at 6 alone is better than none */
    while (multiples(from, to, k, &first) > max_count && multiples(from, to, k + 1, &first) >= 1.0)
        k++;
    int n = (int)fmin(multiples(from, to, k, &first), max_count);
    for (int i = 0; i < n; ++i)
        out[i] = tick_value(first + i, k); /* ceil may have made first -0; -0 + 0 is 0 */
    *interval = tick_value(1.0, k);
    return n;
}

void ceduo_tick_label(double value, double interval, char label[CEDUO_TICK_LABEL_SIZE])
{
    double place = interval > 0.0 ? floor(log10(interval) + 1e-9) : 0.0; /* of the last digit */
    double digits = value == 0.0 ? 1.0 : floor(log10(fabs(value)) + 1e-9) - place + 1.0;
    if (!(interval > 0.0))
        snprintf(label, CEDUO_TICK_LABEL_SIZE, "%.6g", value);
    else if (place >= -6 && fabs(value) < 1e7)
        snprintf(label, CEDUO_TICK_LABEL_SIZE, "%.*f", place < 0 ? (int)-place : 0, value);
    else
        snprintf(label, CEDUO_TICK_LABEL_SIZE, "%.*g", (int)fmin(fmax(digits, 1.0), 17.0), value);
    char *exponent = strchr(label, 'e');
    if (exponent) { /* 2e+11 and 5e-09 as 2e11 and 5e-9 */
        char *to = exponent + 1 + (exponent[1] == '-'), *from = to + strspn(to, "+0");
        memmove(to, from, strlen(from) + 1);
    }
    if (*label == '-' && strpbrk(label, "123456789") == NULL) /* rounded to "-0.0" */
        memmove(label, label + 1, strlen(label));
    ceduo_number_spoken(label);
}

/* ---- Axes ---- */

/* The labels of an axis. */
struct scale {
    int count;
    double interval;
    struct ceduo_tick tick[CEDUO_TICKS_MAX + 1]; /* and the unit */
};

/* At most n ticks, but for where their labels begin. False where one lies outside. */
static bool set_ticks(struct scale *scale, const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, bool bottom,
                      int n)
{
    double value[CEDUO_TICKS_MAX];
    scale->count = bottom ? ceduo_ticks(frame->x0, frame->x1, n, value, &scale->interval)
                          : ceduo_ticks(frame->y0, frame->y1, n, value, &scale->interval);
    for (int i = 0; i < scale->count; ++i) {
        struct ceduo_tick *t = &scale->tick[i];
        double x = bottom ? value[i] : frame->x0, y = bottom ? frame->y0 : value[i], across, down;
        int column, row;
        if (!ceduo_frame_cell(frame, canvas, x, y, &column, &row))
            return false;
        ceduo_frame_place(frame, canvas, x, y, &across, &down);
        t->cell = bottom ? column : row;
        t->at = bottom ? across : down;
        ceduo_tick_label(value[i], scale->interval, t->label);
    }
    return true;
}

/* As many labels as stand clear of each other. */
static struct scale left_scale(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas)
{
    struct scale scale = {0};
    int apart = frame->height > 3 ? 2 : 1;
    for (int n = frame->height / 2 + 1; n > 0; --n) {
        bool fits = set_ticks(&scale, frame, canvas, false, n);
        for (int i = 1; i < scale.count && fits; ++i)
            fits = abs(scale.tick[i].cell - scale.tick[i - 1].cell) >= apart;
        if (fits)
            return scale;
    }
    return (struct scale){0};
}

int ceduo_frame_axis_width(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas)
{
    /* The columns are still to be found: any valid ones, and any x, give the same labels. */
    struct ceduo_frame rows = *frame;
    rows.left = 0;
    rows.width = 2;
    rows.x0 = 0.0;
    rows.x1 = 1.0;
    if (!ceduo_frame_valid(&rows))
        return 0;
    struct scale scale = left_scale(&rows, canvas);
    size_t widest = 0;
    for (int i = 0; i < scale.count; ++i) {
        size_t length = strlen(scale.tick[i].label);
        widest = length > widest ? length : widest;
    }
    return (int)widest + 1;
}

void ceduo_canvas_axis_left(struct ceduo_canvas *canvas, const struct ceduo_frame *frame)
{
    if (!ceduo_frame_valid(frame))
        return;
    struct scale scale = left_scale(frame, canvas);
    for (int i = 0; i < scale.count; ++i) {
        int length = (int)strlen(scale.tick[i].label);
        scale.tick[i].start = length < frame->left ? frame->left - 1 - length : -1;
    }
    canvas->surface->axis(canvas->to, frame, false, scale.count, scale.tick);
}

enum { LABEL_GAP = 2 }; /* blanks between labels */

static int end_of(const struct ceduo_tick *tick)
{
    return tick->start + (int)strlen(tick->label);
}

/* Sets where each label goes; false if two would collide or one leave the frame. */
static bool bottom_scale_fits(struct scale *scale, const struct ceduo_frame *frame)
{
    int least = frame->left > 0 ? frame->left - 1 : frame->left;
    int end = frame->left + frame->width;
    for (int i = 0; i < scale->count; ++i) {
        int length = (int)strlen(scale->tick[i].label), start = scale->tick[i].cell - (length - 1) / 2;
        start = start + length > end ? end - length : start;
        start = start < least && i == 0 ? least : start;
        if (start < least || start + length > end)
            return false;
        scale->tick[i].start = start;
        least = start + length + LABEL_GAP;
    }
    return true;
}

/* The most labels that leave room for the unit too, but two at least; the most of all if there is no such. */
static struct scale bottom_scale(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, const char *unit)
{
    struct scale most = {0};
    int width = ceduo_canvas_label_width(canvas, unit);
    for (int n = frame->width / 3 + 1; n > 0; --n) {
        struct scale scale = {0};
        bool inside = set_ticks(&scale, frame, canvas, true, n);
        bool between = frame->x_whole && scale.interval > 0 && scale.interval < 1;
        if (between || !inside || !bottom_scale_fits(&scale, frame) || (scale.count < 2 && most.count > 1))
            continue;
        most = most.count == 0 ? scale : most;
        /* the unit goes after the last number or else after the first, moving none */
        struct ceduo_tick at = {.cell = -1, .start = -1};
        if (scale.count > 0 && end_of(&scale.tick[scale.count - 1]) + 1 + width <= frame->left + frame->width)
            at.start = end_of(&scale.tick[scale.count - 1]) + 1;
        else if (scale.count > 1 && end_of(&scale.tick[0]) + 1 + width + LABEL_GAP <= scale.tick[1].start)
            at.start = end_of(&scale.tick[0]) + 1;
        snprintf(at.label, sizeof at.label, "%s", unit);
        if (width > 0 && at.start >= 0)
            scale.tick[scale.count++] = at;
        if (width == 0 || at.start >= 0)
            return scale;
    }
    return most;
}

void ceduo_canvas_axis_bottom(struct ceduo_canvas *canvas, const struct ceduo_frame *frame, const char *unit)
{
    if (!ceduo_frame_valid(frame))
        return;
    struct scale scale = bottom_scale(frame, canvas, unit ? unit : "");
    canvas->surface->axis(canvas->to, frame, true, scale.count, scale.tick);
}
