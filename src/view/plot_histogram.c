/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/must.h"
#include "plot_parts.h"

/* Energies at a control as horizontal bars. */

struct bins {
    double first, width; /* kJ: edge of the first, width of all */
    int count;
    bool over; /* the last one holds all that is larger */
};

/* Bins from the least to the largest energy, at most `most`; a long tail goes into the last one. */
static struct bins bins_for(double least, double p99, double largest, int most)
{
    struct bins b = {.over = largest > 1.5 * p99 && p99 > least};
    double top = b.over ? p99 : largest;
    int room = most - b.over > 1 ? most - b.over : 1;
    double range = top - least > 1e-6 * fabs(top) ? top - least : fmax(fabs(top) / 10, 1e-3);
    for (b.width = ceduo_plot_round(range / room, true);; b.width = ceduo_plot_round(1.5 * b.width, true)) {
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
    const struct ceduo_arrivals *arrivals, *bare; /* bare NULL: there is nothing to be held against */
    double accepted;                              /* kJ */
    struct bins bins;
    int top, label, bar, numbers, marks; /* row of the first bar; columns they take */
    int digits, bare_digits;             /* of the largest numbers of 1000 */
    bool heads;                          /* a row above the bars */
    size_t n, *counts, bare_n, *bare_counts;
};

/* ---- what stands in a row ---- */

static void write_bin(const struct histogram *h, int i, struct text *text)
{
    char lo[CEDUO_TICK_LABEL_SIZE], hi[CEDUO_TICK_LABEL_SIZE];
    double from = h->bins.first + i * h->bins.width;
    ceduo_tick_label(from, h->bins.width, sizeof lo, lo);
    ceduo_tick_label(from + h->bins.width, h->bins.width, sizeof hi, hi);
    if (h->bins.over && i == h->bins.count - 1)
        ceduo_text_format(text, "\xe2\x89\xa5 %s kJ", lo);
    else
        ceduo_text_format(text, "%s\xe2\x80\x93%s kJ", lo, hi);
}

/* Of 1000 released, those in bin i: bare or not. */
static double per_1000(const struct histogram *h, bool bare, int i)
{
    const struct ceduo_arrivals *a = bare ? h->bare : h->arrivals;
    const size_t *counts = bare ? h->bare_counts : h->counts, n = bare ? h->bare_n : h->n;
    return n > 0 ? 1000 * a->reach_probability * (double)counts[i] / (double)n : 0;
}

static void write_numbers(const struct histogram *h, int i, struct text *text)
{
    if (h->bare)
        ceduo_text_format(text, "%*.0f (%*.0f)", h->digits, per_1000(h, false, i), h->bare_digits, per_1000(h, true, i));
    else
        ceduo_text_format(text, "%zu %5.1f %%", h->counts[i], 100.0 * (double)h->counts[i] / (double)h->n);
}

#define WORD_LEAST 60 /* columns that leave room for a word in a mark */

static void add_mark(const struct histogram *h, int i, double kj, const char *name, struct text *text)
{
    if (!isnan(kj) && bin_of(&h->bins, kj) == i)
        ceduo_text_format(text, "%s%s%s%.3g", text->length > 0 ? ", " : "\xe2\x97\x80 ", name, name[0] == '>' ? "" : " ", kj);
}

static void write_marks(const struct histogram *h, int i, struct text *text)
{
    const struct ceduo_distribution *e = &h->arrivals->energy;
    double end = h->bins.first + h->bins.count * h->bins.width;
    if (h->accepted >= h->bins.first && (h->accepted < end || h->bins.over))
        add_mark(h, i, h->accepted, h->area->width < WORD_LEAST ? ">" : _("withstands"), text);
    add_mark(h, i, e->p50 * J_TO_KJ, "p50", text);
    add_mark(h, i, e->p95 * J_TO_KJ, "p95", text);
}

static enum ceduo_role role_of(const struct histogram *h, int i)
{
    double from = h->bins.first + i * h->bins.width;
    return isnan(h->accepted)                    ? CEDUO_ROLE_MEAN
           : from >= h->accepted                 ? CEDUO_ROLE_BAD
           : from + h->bins.width <= h->accepted ? CEDUO_ROLE_GOOD
                                                 : CEDUO_ROLE_WARN;
}

/* How many columns the widest of a kind of text takes. */
static int widest(const struct histogram *h, void (*write)(const struct histogram *h, int i, struct text *text))
{
    int width = 0;
    for (int i = 0; i < h->bins.count; i++) {
        LOCAL_TEXT(text);
        write(h, i, &text);
        int w = ceduo_canvas_label_width(h->canvas, ceduo_text_string(&text));
        width = w > width ? w : width;
    }
    return width;
}

/* What the bars are drawn to: counts, or with two runs those of 1000 released. */
static double length_of(const struct histogram *h, int i)
{
    return h->bare ? per_1000(h, false, i) : (double)h->counts[i];
}

static void draw_row(const struct histogram *h, int i, double most)
{
    int row = h->top + i, column = h->area->left + h->label + 1;
    struct text label = {0}, number = {0}, marks = {0};
    write_bin(h, i, &label);
    write_numbers(h, i, &number);
    write_marks(h, i, &marks);
    ceduo_plot_put_right(h->canvas, column - 2, row, h->label, CEDUO_ROLE_AXIS, &label);
    ceduo_canvas_bar(h->canvas, column, row, h->bar, length_of(h, i) / most, role_of(h, i));
    if (h->bare && h->bare_counts[i] > 0) {
        int at = column + (int)fmin(floor(per_1000(h, true, i) / most * h->bar), h->bar - 1);
        ceduo_canvas_label(h->canvas, at, row, CEDUO_ROLE_BARE, "\xe2\x94\x82");
    }
    column += h->bar + 1;
    ceduo_plot_put_right(h->canvas, column + h->numbers - 1, row, h->numbers, CEDUO_ROLE_TEXT, &number);
    ceduo_plot_put_fitting(h->canvas, column + h->numbers + 1, row, h->marks, CEDUO_ROLE_TITLE, 1, &marks);
}

/* Returns NULL, or why there is no bar. */
static const char *draw_rows(struct histogram *h)
{
    double most = 0, most_bare = 0;
    for (int i = 0; i < h->bins.count; i++) {
        most = fmax(most, length_of(h, i));
        most_bare = fmax(most_bare, h->bare ? per_1000(h, true, i) : 0);
    }
    h->digits = snprintf(NULL, 0, "%.0f", most);
    h->bare_digits = snprintf(NULL, 0, "%.0f", most_bare);
    h->label = widest(h, write_bin);
    h->numbers = widest(h, write_numbers);
    h->marks = widest(h, write_marks);
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
        return _("too narrow");
    int end = h->label + 1 + h->bar + 1 + h->numbers;
    if (h->heads && h->bare && h->numbers > 0)
        ceduo_plot_say_right(h->canvas, h->area->left + end - 1, h->top - 1, end, CEDUO_ROLE_AXIS, "%s", _("wood (bare)"));
    for (int i = 0; i < h->bins.count; i++)
        draw_row(h, i, fmax(most, most_bare));
    return NULL;
}

/* ---- the head ---- */

#define HEADS 4 /* the longest first; the first one has a remark as well */

/* With the forest and (without). */
static void write_wooded_heads(const struct histogram *h, struct text *heads)
{
    double reach = h->arrivals->reach_probability * 1000, bare_reach = h->bare->reach_probability * 1000;
    double exceed = h->arrivals->exceed_probability * 1000, bare_exceed = h->bare->exceed_probability * 1000;
    ceduo_text_format(&heads[1], _("of 1000 released %.0f arrive (\xe2\x94\x82 bare %.0f)"), reach, bare_reach);
    ceduo_text_format(&heads[2], _("of 1000: %.0f arrive (\xe2\x94\x82 bare %.0f)"), reach, bare_reach);
    ceduo_text_format(&heads[3], _("of 1000: %.0f (\xe2\x94\x82 bare %.0f)"), reach, bare_reach);
    for (int i = 1; i < HEADS && !isnan(exceed); i++)
        ceduo_text_then(&heads[i], ", ", i == 1 ? _("%.0f (%.0f) with more than %g kJ") : "%.0f (%.0f) > %g kJ", exceed,
                        bare_exceed, h->accepted);
}

static void write_bare_heads(const struct histogram *h, struct text *heads)
{
    unsigned long long reached = h->arrivals->reached, released = h->arrivals->released;
    double exceed = h->arrivals->exceed_probability * 1000;
    ceduo_text_format(&heads[1], _("n = %llu of %llu rocks arrive"), reached, released);
    ceduo_text_format(&heads[2], _("n = %llu of %llu"), reached, released);
    ceduo_text_format(&heads[3], _("n = %llu"), reached);
    for (int i = 1; i < HEADS && !isnan(exceed); i++)
        ceduo_text_then(&heads[i], "; ", i == 1 ? _("of 1000 released, %.0f with more than %g kJ") : _("of 1000: %.0f > %g kJ"),
                        exceed, h->accepted);
}

static void put_head(const struct histogram *h)
{
    struct text heads[HEADS] = {{0}};
    if (h->bare)
        write_wooded_heads(h, heads);
    else
        write_bare_heads(h, heads);
    ceduo_text_put(&heads[0], ceduo_text_string(&heads[1]));
    if (h->n < h->arrivals->reached || (h->bare && h->bare_n < h->bare->reached))
        ceduo_text_then(&heads[0], "; ", _("drawn: the first %zu"), h->n > h->bare_n ? h->n : h->bare_n);
    ceduo_plot_put_fitting(h->canvas, h->area->left, h->area->top, h->area->width, CEDUO_ROLE_TEXT, HEADS, heads);
}

/* ---- the picture ---- */

static size_t *count_in(const struct bins *bins, const struct ceduo_energies *e)
{
    size_t *counts = ceduo_must(calloc((size_t)bins->count, sizeof *counts));
    for (size_t i = 0; i < e->n; i++)
        counts[bin_of(bins, e->values[i] * J_TO_KJ)]++;
    return counts;
}

/* Puts the energies into bins that both kinds of rocks share. */
static void count(struct histogram *h, const struct ceduo_energies *e, const struct ceduo_energies *bare, int rows)
{
    size_t n = e->n + (bare ? bare->n : 0);
    double *all = ceduo_must(malloc((n + 1) * sizeof *all)), least, most;
    if (e->n > 0)
        memcpy(all, e->values, e->n * sizeof *all);
    if (bare && bare->n > 0)
        memcpy(all + e->n, bare->values, bare->n * sizeof *all);
    gsl_stats_minmax(&least, &most, all, 1, n);
    double p99 = gsl_stats_select(all, 1, n, ceduo_quantile_rank(n, 0.99) - 1);
    h->bins = bins_for(least * J_TO_KJ, p99 * J_TO_KJ, most * J_TO_KJ, rows);
    free(all);
    h->n = e->n;
    h->counts = count_in(&h->bins, e);
    h->bare_n = bare ? bare->n : 0;
    h->bare_counts = bare ? count_in(&h->bins, bare) : NULL;
}

const char *ceduo_plot_histogram(struct ceduo_canvas *canvas, const struct ceduo_area *area,
                                 const struct ceduo_picture *picture)
{
    size_t c = picture->control;
    const struct ceduo_run_snapshot *sight = ceduo_plot_sight(picture), *bare = ceduo_plot_bare(picture);
    bool wooded = ceduo_plot_wooded(picture), head = area->height >= 4;
    struct histogram h = {.canvas = canvas,
                          .area = area,
                          .control = ceduo_plot_control(picture),
                          .arrivals = ceduo_plot_arrivals(picture, c),
                          .bare = wooded ? ceduo_plot_bare_arrivals(picture, c) : NULL,
                          .heads = area->height >= 10};
    int rows = area->height - head - h.heads;
    if (!h.control)
        return _("no control");
    if (!h.arrivals || (wooded && !h.bare))
        return _("not computed yet");
    if (sight->energies[c].n == 0 && bare->energies[c].n == 0)
        return _("no rock arrives");
    if (rows < 1)
        return NULL;
    h.accepted = h.control->accepted * J_TO_KJ;
    h.top = area->top + head + h.heads;
    count(&h, &sight->energies[c], wooded ? &bare->energies[c] : NULL, rows);
    if (head)
        put_head(&h);
    const char *why = draw_rows(&h);
    free(h.counts);
    free(h.bare_counts);
    return why;
}
