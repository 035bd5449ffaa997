/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/must.h"
#include "plot.h"
#include "report.h"

/* Energies at a control as horizontal bars. */

#define MARKS_WIDTH 60 /* columns that leave room for a word in a mark */

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

/* The rocks that arrive, in bins. */
struct counted {
    const struct ceduo_arrivals *arrivals;
    size_t n, *counts;
};

struct histogram {
    struct counted rocks, bare; /* of bare no arrivals: there is nothing to be held against */
    double accepted;            /* kJ */
    struct bins bins;
};

/* ---- what stands in a row ---- */

/* Of 1000 released, those in bin i. */
static double per_1000(const struct counted *c, int i)
{
    return c->n > 0 ? ceduo_measure_arriving(c->arrivals).value * (double)c->counts[i] / (double)c->n : 0;
}

static void add_mark(const struct histogram *h, int i, double kj, const char *name, struct text *text)
{
    if (!isnan(kj) && bin_of(&h->bins, kj) == i)
        ceduo_text_format(text, "%s%s%s%s", text->length > 0 ? ", " : "\xe2\x97\x80 ", name, name[0] == '>' ? "" : " ",
                          ROUNDED(kj, 3));
}

static void add_row(struct ceduo_page *page, const struct histogram *h, int i)
{
    char lo[CEDUO_TICK_LABEL_SIZE], hi[CEDUO_TICK_LABEL_SIZE];
    const struct bins *b = &h->bins;
    const struct ceduo_distribution *e = ceduo_spread(CEDUO_SPREAD_ENERGY, h->rocks.arrivals);
    double from = b->first + i * b->width, end = b->first + b->count * b->width, share = per_1000(&h->rocks, i);
    enum ceduo_role role = isnan(h->accepted)               ? CEDUO_ROLE_MEAN
                           : from >= h->accepted            ? CEDUO_ROLE_BAD
                           : from + b->width <= h->accepted ? CEDUO_ROLE_GOOD
                                                            : CEDUO_ROLE_WARN;
    ceduo_tick_label(from, b->width, lo);
    ceduo_tick_label(from + b->width, b->width, hi);
    if (b->over && i == b->count - 1)
        ceduo_page_cell_format(page, "\xe2\x89\xa5 %s kJ", lo);
    else
        ceduo_page_cell_format(page, "%s\xe2\x80\x93%s kJ", lo, hi);
    struct ceduo_page_bar *bar = ceduo_page_bar(page, share, role);
    if (h->bare.arrivals && h->bare.counts[i] > 0)
        bar->limit = per_1000(&h->bare, i);
    bar->own = CEDUO_ROLE_BARE;
    ceduo_page_cell_format(page, "%.0f", share);
    if (h->bare.arrivals)
        ceduo_page_cell_format(page, "%.0f", per_1000(&h->bare, i));
    else
        ceduo_page_cell_format(page, "%s", "");
    struct ceduo_page_cell *marks = ceduo_page_cell(page);
    marks->role = CEDUO_ROLE_TITLE;
    if (h->accepted >= b->first && (h->accepted < end || b->over))
        add_mark(h, i, h->accepted, page->width >= MARKS_WIDTH ? _("withstands") : ">", &marks->text);
    add_mark(h, i, e->p50 * J_TO_KJ, "p50", &marks->text);
    add_mark(h, i, e->p95 * J_TO_KJ, "p95", &marks->text);
}

/* "500 (│ 800) arrive": a share of the rocks, and that without forest. */
static void say_share(struct text *text, const struct histogram *h, const struct ceduo_measure *m,
                      const struct ceduo_measure *bare)
{
    ceduo_text_format(text, h->bare.arrivals ? "%.0f (\xe2\x94\x82 %.0f) " : "%.0f ", m->value, bare->value);
    ceduo_text_append(text, NAMED(*m, CEDUO_SHORT_HEAD));
}

/* What all rows add up to. */
static void say_all(struct ceduo_page *page, const struct histogram *h, const struct ceduo_control *c)
{
    const struct ceduo_arrivals *a = h->rocks.arrivals, *bare = h->bare.arrivals;
    const struct ceduo_measure all = ceduo_measure_arriving(a), all_bare = ceduo_measure_arriving(bare);
    const struct ceduo_measure judged = ceduo_measure_exceeding(c, a), judged_bare = ceduo_measure_exceeding(c, bare);
    struct text *head = ceduo_page_add(page, CEDUO_PAGE_NOTE);
    ceduo_text_format(head, "%s: ", _("of 1000"));
    say_share(head, h, &all, &all_bare);
    if (!isnan(c->accepted)) {
        ceduo_text_append(head, ", ");
        say_share(head, h, &judged, &judged_bare);
    }
    if (h->rocks.n < ceduo_reached(a) || h->bare.n < ceduo_reached(bare))
        ceduo_text_append_joined(head, "; ", _("drawn: the first %zu"), h->rocks.n > h->bare.n ? h->rocks.n : h->bare.n);
}

/* ---- the picture ---- */

static void count(struct counted *c, const struct bins *bins, const struct ceduo_energies *e)
{
    c->n = e->n;
    c->counts = ceduo_check_memory(calloc((size_t)bins->count, sizeof *c->counts));
    for (size_t i = 0; i < e->n; i++)
        c->counts[bin_of(bins, e->values[i] * J_TO_KJ)]++;
}

/* Bins that both kinds of rocks share. */
static struct bins bins_of(const struct ceduo_energies *e, const struct ceduo_energies *bare, int rows)
{
    size_t n = e->n + bare->n;
    double *all = ceduo_check_memory(malloc((n + 1) * sizeof *all)), least, most;
    for (size_t i = 0; i < n; i++)
        all[i] = i < e->n ? e->values[i] : bare->values[i - e->n];
    gsl_stats_minmax(&least, &most, all, 1, n);
    double p99 = gsl_stats_select(all, 1, n, ceduo_quantile_rank(n, 0.99) - 1);
    free(all);
    return bins_for(least * J_TO_KJ, p99 * J_TO_KJ, most * J_TO_KJ, rows);
}

#define SAID_HEIGHT 6 /* lines that leave room for a line above the rows; what stands before them says it, too */

const char *ceduo_plot_histogram(struct ceduo_drawing *d)
{
    static const struct ceduo_page_column columns[] = {{"", -6, 0, CEDUO_FITS},
                                                       {"", 4, 1, CEDUO_FILLS},
                                                       {"", -4, 1, CEDUO_FITS | CEDUO_DROPPED(1)},
                                                       {"", -5, 1, CEDUO_FITS | CEDUO_DROPPED(1)},
                                                       {"", 1, 1, CEDUO_FITS | CEDUO_DROPPED(2)}};
    size_t c = d->picture->control;
    bool wooded = d->wooded, said = d->height >= SAID_HEIGHT && !d->page->first;
    int rows = d->height - said - wooded;
    double most = 0;
    if (!d->control)
        return _("no control");
    if (!d->arrivals || (wooded && !d->bare_arrivals))
        return _("not computed yet");
    const struct ceduo_energies *e = &d->sight->energies[c],
                                *bare = wooded ? &d->bare->energies[c] : &(struct ceduo_energies){0};
    if (e->n == 0 && bare->n == 0)
        return _("no rock arrives");
    struct histogram h = {.accepted = d->control->accepted * J_TO_KJ,
                          .bins = bins_of(e, bare, rows > 1 ? rows : 1),
                          .rocks.arrivals = d->arrivals,
                          .bare.arrivals = wooded ? d->bare_arrivals : NULL};
    count(&h.rocks, &h.bins, e);
    count(&h.bare, &h.bins, bare);
    if (said)
        say_all(d->page, &h, d->control);
    CEDUO_PAGE_TABLE_OF(d->page, columns);
    if (wooded) {
        struct ceduo_page_cell *heads = d->page->last->cells;
        ceduo_text_append(&heads[1].text, _("\xe2\x94\x82 without forest"));
        ceduo_text_append(&heads[1].shorter, _("\xe2\x94\x82 bare"));
        ceduo_text_append(&heads[2].text, _("forest"));
        ceduo_text_append(&heads[3].text, _("bare"));
    }
    for (int i = 0; i < h.bins.count; i++) {
        add_row(d->page, &h, i);
        most = fmax(most, fmax(per_1000(&h.rocks, i), per_1000(&h.bare, i)));
    }
    ceduo_page_scale(d->page, 1, 0, most);
    free(h.rocks.counts);
    free(h.bare.counts);
    return NULL;
}
