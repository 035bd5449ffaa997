/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "io/intl.h"
#include "plot_parts.h"

/* Energies at a control as horizontal bars. */

struct bins {
    double first, width; /* kJ: edge of the first, width of all */
    int count;
    bool over; /* the last one holds all that is larger */
};

/* The least of 1, 2, 5 times a power of ten that is not below `width`. */
static double round_width(double width)
{
    static const double round[] = {1, 2, 5, 10};
    double power = pow(10, floor(log10(width)));
    for (int i = 0; i < 4; i++)
        if (round[i] * power >= width * (1 - 1e-9))
            return round[i] * power;
    return 10 * power;
}

/* Bins from the least to the largest energy, at most `most`; a long tail goes into the last one. */
static struct bins bins_for(double least, double p99, double largest, int most)
{
    struct bins b = {.over = largest > 1.5 * p99 && p99 > least};
    double top = b.over ? p99 : largest;
    int room = most - b.over > 1 ? most - b.over : 1;
    double range = top - least > 1e-6 * fabs(top) ? top - least : fmax(fabs(top) / 10, 1e-3);
    for (b.width = round_width(range / room);; b.width = round_width(1.5 * b.width)) {
        b.first = floor(least / b.width + 1e-9) * b.width;
        b.count = (int)floor((top - b.first) / b.width + 1e-9) + 1 + b.over;
        if (b.count <= room + b.over || b.width > top)
            return b;
    }
}

static int bin_of(const struct bins *b, double kj)
{
    double i = floor((kj - b->first) / b->width + 1e-9);
    return i < 0 ? 0 : i < b->count ? (int)i : b->count - 1;
}

struct histogram {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_control *control;
    const struct ceduo_arrivals *arrivals;
    struct bins bins;
    int top, label, bar, numbers, marks; /* row of the first bar; columns they take */
    size_t n, *counts;
};

static void bin_label(const struct histogram *h, int i, struct text *text)
{
    char lo[PLOT_NUMBER_ROOM], hi[PLOT_NUMBER_ROOM];
    double from = h->bins.first + i * h->bins.width;
    ceduo_tick_label(from, h->bins.width, sizeof lo, lo);
    ceduo_tick_label(from + h->bins.width, h->bins.width, sizeof hi, hi);
    if (h->bins.over && i == h->bins.count - 1)
        ceduo_text_format(text, "\xe2\x89\xa5 %s kJ", lo);
    else
        ceduo_text_format(text, "%s\xe2\x80\x93%s kJ", lo, hi);
}

/* ---- marks ---- */

static void add_mark(const struct histogram *h, int i, double value, const char *name, struct text *text)
{
    if (!isnan(value) && bin_of(&h->bins, value * KILO) == i)
        ceduo_text_format(text, "%s%s %.3g", text->length > 0 ? ", " : "\xe2\x97\x80 ", name, value * KILO);
}

static void marks_of(const struct histogram *h, int i, struct text *text)
{
    const struct ceduo_distribution *e = &h->arrivals->energy;
    double kj = h->control->accepted * KILO, end = h->bins.first + h->bins.count * h->bins.width;
    if (kj >= h->bins.first && (kj < end || h->bins.over))
        add_mark(h, i, h->control->accepted, _("bears"), text);
    add_mark(h, i, e->p50, "p50", text);
    add_mark(h, i, e->p95, "p95", text);
}

static enum ceduo_role role_of(const struct histogram *h, int i)
{
    double kj = h->control->accepted * KILO, from = h->bins.first + i * h->bins.width;
    if (isnan(kj))
        return CEDUO_ROLE_MEAN;
    return from >= kj ? CEDUO_ROLE_BAD : from + h->bins.width <= kj ? CEDUO_ROLE_GOOD : CEDUO_ROLE_WARN;
}

/* ---- rows ---- */

static void number_of(const struct histogram *h, int i, struct text *text)
{
    ceduo_text_format(text, "%zu  %.1f %%", h->counts[i], 100.0 * (double)h->counts[i] / (double)h->n);
}

/* How many columns the widest of a kind of text takes. */
static int widest(const struct histogram *h, void (*write)(const struct histogram *h, int i, struct text *text))
{
    int width = 0;
    for (int i = 0; i < h->bins.count; i++) {
        struct text text = {0};
        write(h, i, &text);
        int w = text.bytes ? ceduo_canvas_label_width(h->canvas->charset, text.bytes) : 0;
        width = w > width ? w : width;
        ceduo_text_free(&text);
    }
    return width;
}

static void draw_row(const struct histogram *h, int i, size_t most)
{
    int row = h->top + i, column = h->area->left + h->label + 1;
    struct text label = {0}, number = {0}, marks = {0};
    bin_label(h, i, &label);
    number_of(h, i, &number);
    marks_of(h, i, &marks);
    ceduo_plot_put_right(h->canvas, column - 2, row, h->label, CEDUO_ROLE_AXIS, label.bytes ? label.bytes : "");
    ceduo_canvas_bar(h->canvas, column, row, h->bar, (double)h->counts[i] / (double)most, role_of(h, i));
    column += h->bar + 1;
    ceduo_plot_put_right(h->canvas, column + h->numbers - 1, row, h->numbers, CEDUO_ROLE_TEXT,
                         number.bytes ? number.bytes : "");
    ceduo_plot_put(h->canvas, column + h->numbers + 1, row, h->marks, CEDUO_ROLE_TITLE, marks.bytes ? marks.bytes : "");
    ceduo_text_free(&label);
    ceduo_text_free(&number);
    ceduo_text_free(&marks);
}

static void draw_rows(struct histogram *h)
{
    size_t most = 1;
    for (int i = 0; i < h->bins.count; i++)
        most = h->counts[i] > most ? h->counts[i] : most;
    h->label = widest(h, bin_label);
    h->numbers = widest(h, number_of);
    h->marks = widest(h, marks_of);
    h->bar = h->area->width - h->label - h->numbers - h->marks - 3;
    if (h->bar < 4) { /* rather bars without words than no bars */
        h->bar += h->marks;
        h->marks = 0;
    }
    if (h->bar < 4) {
        h->bar += h->numbers;
        h->numbers = 0;
    }
    if (h->bar < 1)
        ceduo_plot_words(h->canvas, h->area, _("too narrow"));
    for (int i = 0; i < h->bins.count && h->bar >= 1; i++)
        draw_row(h, i, most);
}

/* ---- the picture ---- */

static void put_head(const struct histogram *h)
{
    const struct ceduo_arrivals *a = h->arrivals;
    struct text text = {0};
    ceduo_text_format(&text, _("n = %llu of %llu rocks arrive"), (unsigned long long)a->reached,
                      (unsigned long long)a->released);
    if (!isnan(a->exceed_probability))
        ceduo_text_format(&text, _("; of 1000 released, %.0f with more than %g kJ"), a->exceed_probability * 1000,
                          h->control->accepted * KILO);
    if (h->n < a->reached)
        ceduo_text_format(&text, _("; drawn: the first %zu"), h->n);
    ceduo_plot_put(h->canvas, h->area->left, h->area->top, h->area->width, CEDUO_ROLE_TEXT,
                   text.bytes ? text.bytes : "");
    ceduo_text_free(&text);
}

static int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Puts the energies into bins; false without memory. */
static bool count(struct histogram *h, const struct ceduo_energies *e, int rows)
{
    double *sorted = malloc(e->n * sizeof *sorted);
    if (!sorted)
        return false;
    memcpy(sorted, e->values, e->n * sizeof *sorted);
    qsort(sorted, e->n, sizeof *sorted, by_value);
    double p99 = sorted[ceduo_quantile_rank(e->n, 0.99) - 1];
    h->bins = bins_for(sorted[0] * KILO, p99 * KILO, sorted[e->n - 1] * KILO, rows);
    free(sorted);
    h->n = e->n;
    h->counts = calloc((size_t)h->bins.count, sizeof *h->counts);
    for (size_t i = 0; h->counts && i < e->n; i++)
        h->counts[bin_of(&h->bins, e->values[i] * KILO)]++;
    return h->counts != NULL;
}

void ceduo_plot_histogram(struct ceduo_canvas *canvas, const struct ceduo_area *area,
                          const struct ceduo_picture *picture)
{
    struct histogram h = {.canvas = canvas,
                          .area = area,
                          .control = ceduo_plot_control(picture),
                          .arrivals = ceduo_plot_arrivals(picture, picture->control)};
    bool head = area->height >= 4;
    int rows = area->height - head - (area->height >= 10);
    if (!h.control) {
        ceduo_plot_words(canvas, area, _("no control"));
    } else if (!h.arrivals) {
        ceduo_plot_words(canvas, area, _("not computed yet"));
    } else if (picture->outlook->energies[picture->control].n == 0) {
        ceduo_plot_words(canvas, area, _("no rock arrives"));
    } else if (rows >= 1 && count(&h, &picture->outlook->energies[picture->control], rows)) {
        h.top = area->top + head + (area->height >= 10);
        if (head)
            put_head(&h);
        draw_rows(&h);
    }
    free(h.counts);
}
