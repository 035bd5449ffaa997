/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/oom.h"
#include "core/runs/statistics.h"
#include "plot.h"
#include "report.h"

/* Histogram of energies at a control. */

#define MARKS_WIDTH 60 /* columns needed for words in marks */

struct bins {
    double first, width; /* kJ: start of the first bin, width of each */
    int count;
    bool open_end; /* the last bin is open-ended */
};

/* Return at most `max` bins over the range; a long tail goes to the last one. */
static struct bins divide_range(double min, double p99, double largest, int max)
{
    struct bins b = {.open_end = largest > 1.5 * p99 && p99 > min};
    double top = b.open_end ? p99 : largest;
    int max_bins = max - b.open_end > 1 ? max - b.open_end : 1;
    double range = top - min > 1e-6 * fabs(top) ? top - min : fmax(fabs(top) / 10, 1e-3);
    for (b.width = ceduo_plot_round(range / max_bins, true);; b.width = ceduo_plot_round(1.5 * b.width, true)) {
        b.first = floor(min / b.width + 1e-9) * b.width;
        b.count = (int)floor((top - b.first) / b.width + 1e-9) + 1 + b.open_end;
        if (b.count <= max_bins + b.open_end || b.width > top)
            return b;
    }
}

static int find_bin(const struct bins *b, double kj)
{
    double i = floor((kj - b->first) / b->width + 1e-9);
    return i < 0 ? 0 : i < b->count ? (int)i : b->count - 1;
}

/* Arriving rocks, in bins. */
struct binned {
    const struct ceduo_arrivals *arrivals;
    size_t n, *counts;
};

struct histogram {
    struct binned rocks, bare; /* bare.arrivals NULL: no comparison */
    double accepted;           /* kJ */
    struct bins bins;
};

/* ---- rows ---- */

/* Return the rocks in bin i per 1000 released. */
static double per_1000(const struct binned *c, int i)
{
    return c->n > 0 ? ceduo_measure_arriving(c->arrivals).value * (double)c->counts[i] / (double)c->n : 0;
}

static void add_mark(const struct histogram *h, int i, double kj, const char *name, struct text *text)
{
    if (!isnan(kj) && find_bin(&h->bins, kj) == i)
        ceduo_text_format(text, "%s%s%s%s", text->length > 0 ? ", " : "\xe2\x97\x80 ", name, name[0] == '>' ? "" : " ",
                          SIG_TRIMMED(kj, 3));
}

static void add_bin_row(struct ceduo_page *page, const struct histogram *h, int i)
{
    char lo[CEDUO_TICK_LABEL_SIZE], hi[CEDUO_TICK_LABEL_SIZE];
    const struct bins *b = &h->bins;
    const struct ceduo_distribution *e = ceduo_arrival_distribution(CEDUO_ARRIVAL_ENERGY, h->rocks.arrivals);
    double from = b->first + i * b->width, end = b->first + b->count * b->width, share = per_1000(&h->rocks, i);
    enum ceduo_role role = isnan(h->accepted)               ? CEDUO_ROLE_MEAN
                           : from >= h->accepted            ? CEDUO_ROLE_BAD
                           : from + b->width <= h->accepted ? CEDUO_ROLE_GOOD
                                                            : CEDUO_ROLE_WARN;
    ceduo_tick_label(from, b->width, lo);
    ceduo_tick_label(from + b->width, b->width, hi);
    if (b->open_end && i == b->count - 1)
        ceduo_page_cell_format(page, "\xe2\x89\xa5 %s kJ", lo);
    else
        ceduo_page_cell_format(page, "%s\xe2\x80\x93%s kJ", lo, hi);
    struct ceduo_page_bar *bar = ceduo_page_bar(page, share, role);
    if (h->bare.arrivals && h->bare.counts[i] > 0)
        bar->limit = per_1000(&h->bare, i);
    bar->limit_role = CEDUO_ROLE_BARE;
    ceduo_page_cell_format(page, "%.0f", share);
    if (h->bare.arrivals)
        ceduo_page_cell_format(page, "%.0f", per_1000(&h->bare, i));
    else
        ceduo_page_cell_format(page, "%s", "");
    struct ceduo_page_cell *marks = ceduo_page_cell(page);
    marks->role = CEDUO_ROLE_TITLE;
    if (h->accepted >= b->first && (h->accepted < end || b->open_end))
        add_mark(h, i, h->accepted, page->width >= MARKS_WIDTH ? _("limit") : ">", &marks->text);
    add_mark(h, i, e->p50 * J_TO_KJ, "p50", &marks->text);
    add_mark(h, i, e->p95 * J_TO_KJ, "p95", &marks->text);
}

/* Append "500 (│ 800) arrive": a share, and that without forest. */
static void append_share(struct text *text, const struct histogram *h, const struct ceduo_measure *m,
                         const struct ceduo_measure *bare)
{
    ceduo_text_format(text, h->bare.arrivals ? "%.0f (\xe2\x94\x82 %.0f) " : "%.0f ", m->value, bare->value);
    ceduo_text_append(text, MEASURE_NAME(*m, CEDUO_SHORT_HEAD));
}

/* Append the totals of all rows. */
static void add_totals(struct ceduo_page *page, const struct histogram *h, const struct ceduo_control *c)
{
    const struct ceduo_arrivals *a = h->rocks.arrivals, *bare = h->bare.arrivals;
    const struct ceduo_measure all = ceduo_measure_arriving(a), all_bare = ceduo_measure_arriving(bare);
    const struct ceduo_measure judged = ceduo_measure_exceeding(c, a), judged_bare = ceduo_measure_exceeding(c, bare);
    struct text *head = ceduo_page_add(page, CEDUO_PAGE_NOTE);
    ceduo_text_format(head, "%s: ", _("of 1000"));
    append_share(head, h, &all, &all_bare);
    if (!isnan(c->accepted)) {
        ceduo_text_append(head, ", ");
        append_share(head, h, &judged, &judged_bare);
    }
    if (h->rocks.n < ceduo_rocks_reached(a) || h->bare.n < ceduo_rocks_reached(bare))
        ceduo_text_append_joined(head, "; ", _("drawn: the first %zu"), h->rocks.n > h->bare.n ? h->rocks.n : h->bare.n);
}

/* ---- the picture ---- */

static void fill_bins(struct binned *c, const struct bins *bins, const struct ceduo_energies *e)
{
    c->n = e->n;
    c->counts = ceduo_check_memory(calloc((size_t)bins->count, sizeof *c->counts));
    for (size_t i = 0; i < e->n; i++)
        c->counts[find_bin(bins, e->values[i] * J_TO_KJ)]++;
}

/* Return bins for both runs. */
static struct bins make_bins(const struct ceduo_energies *e, const struct ceduo_energies *bare, int rows)
{
    size_t n = e->n + bare->n;
    double *all = ceduo_check_memory(malloc((n + 1) * sizeof *all)), min, max;
    for (size_t i = 0; i < n; i++)
        all[i] = i < e->n ? e->values[i] : bare->values[i - e->n];
    gsl_stats_minmax(&min, &max, all, 1, n);
    double p99 = gsl_stats_select(all, 1, n, ceduo_quantile_rank(n, 0.99) - 1);
    free(all);
    return divide_range(min * J_TO_KJ, p99 * J_TO_KJ, max * J_TO_KJ, rows);
}

#define TOTALS_HEIGHT 6 /* min lines for totals above the rows */

const char *ceduo_plot_histogram(struct ceduo_drawing *d)
{
    static const struct ceduo_page_column columns[] = {{"", -6, 0, COL_SHRINK},
                                                       {"", 4, 1, COL_GROW},
                                                       {"", -4, 1, COL_SHRINK | COL_PRIORITY(1)},
                                                       {"", -5, 1, COL_SHRINK | COL_PRIORITY(1)},
                                                       {"", 1, 1, COL_SHRINK | COL_PRIORITY(2)}};
    size_t c = d->picture->control;
    bool wooded = d->wooded, show_totals = d->height >= TOTALS_HEIGHT && !d->page->first;
    int rows = d->height - show_totals - wooded;
    double max = 0;
    if (!d->control)
        return _("no control");
    if (!d->arrivals || (wooded && !d->bare_arrivals))
        return _("not computed yet");
    const struct ceduo_energies *e = &d->run->energies[c], *bare = wooded ? &d->bare->energies[c] : &(struct ceduo_energies){0};
    if (e->n == 0 && bare->n == 0)
        return _("no rock arrives");
    struct histogram h = {.accepted = d->control->accepted * J_TO_KJ,
                          .bins = make_bins(e, bare, rows > 1 ? rows : 1),
                          .rocks.arrivals = d->arrivals,
                          .bare.arrivals = wooded ? d->bare_arrivals : NULL};
    fill_bins(&h.rocks, &h.bins, e);
    fill_bins(&h.bare, &h.bins, bare);
    if (show_totals)
        add_totals(d->page, &h, d->control);
    CEDUO_PAGE_TABLE_OF(d->page, columns);
    if (wooded) {
        struct ceduo_page_cell *heads = d->page->last->cells;
        ceduo_text_append(&heads[1].text, _("\xe2\x94\x82 without forest"));
        ceduo_text_append(&heads[1].shorter, _("\xe2\x94\x82 without"));
        ceduo_text_append(&heads[2].text, _("forest"));
        ceduo_text_append(&heads[3].text, _("without"));
    }
    for (int i = 0; i < h.bins.count; i++) {
        add_bin_row(d->page, &h, i);
        max = fmax(max, fmax(per_1000(&h.rocks, i), per_1000(&h.bare, i)));
    }
    ceduo_page_scale(d->page, 1, 0, max);
    free(h.rocks.counts);
    free(h.bare.counts);
    return NULL;
}
