/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options side by side, a row and three bars each: the ADC; by the index what the stems take and what is left, through the
 * forest the share that the control is judged by and the mean energy of the rocks that arrive. */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "plot.h"
#include "report.h"

enum { ADC, SHARE, ENERGY, BARS };

struct bar {
    double value; /* m; of 1000, or kJ per 100 m; kJ; NaN: there is none */
    enum ceduo_role role;
    enum ceduo_light light;
    const char *instead; /* of the number; NULL: nothing */
};

struct scale {
    double lo, hi, limit; /* lo: 0: not logarithmic; limit: NaN: none */
    const char *head;
};

static enum ceduo_role role_of(enum ceduo_light light)
{
    return light == CEDUO_UNKNOWN ? CEDUO_ROLE_WOOD : ceduo_plot_light_role(light);
}

/* `bare`: J, the mean of the rocks that arrive without forest. */
static void read_option(const struct ceduo_drawing *d, size_t i, double bare, struct bar bars[BARS])
{
    struct ceduo_index index = ceduo_assess_index(d->scene, &d->scene->options[i], d->control, bare);
    bool nothing = d->bare_arrivals && ceduo_too_few_arrivals(d->bare_arrivals); /* then no light is on */
    enum ceduo_light contact = nothing ? CEDUO_UNKNOWN : index.contact;
    bars[ADC] = (struct bar){index.worst_adc, role_of(contact), contact, NULL};
    if (d->wooded) {
        const struct ceduo_run_snapshot *run = ceduo_snapshot_find(d->picture->snapshot, d->scene, i);
        const struct ceduo_arrivals *a = ceduo_plot_arrivals(run, d->picture->control);
        enum ceduo_light energy = nothing ? CEDUO_UNKNOWN : ceduo_energy_light(a);
        const char *awaited = a ? NULL : "\xe2\x80\xa6";
        bars[SHARE] = (struct bar){ceduo_measure_exceeding(d->control, a).value, role_of(energy), energy, awaited};
        bars[ENERGY] = (struct bar){ceduo_mean_energy(a).value, CEDUO_ROLE_WOOD, CEDUO_UNKNOWN, awaited};
    } else {
        bars[SHARE] = (struct bar){index.per_100m * J_TO_KJ, CEDUO_ROLE_WOOD, CEDUO_UNKNOWN, NULL};
        bars[ENERGY] =
            (struct bar){index.residual * J_TO_KJ, CEDUO_ROLE_BARE, CEDUO_UNKNOWN, index.exhausted ? _("used up") : NULL};
        if (!isnan(d->control->accepted))
            bars[ENERGY].role = index.residual <= d->control->accepted ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD;
    }
}

static void add_option(struct ceduo_page *page, const struct ceduo_drawing *d, size_t i, const struct scale scales[BARS],
                       const struct bar bars[BARS])
{
    ceduo_page_cell_role(page, i == d->picture->option ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT, d->scene->options[i].name);
    for (size_t k = 0; k < BARS; k++) {
        const struct bar *b = &bars[k];
        const struct scale *s = &scales[k];
        ceduo_page_bar(page, b->value, b->role)->limit = s->limit;
        ceduo_page_cell_format(page, "%s",
                               b->instead      ? b->instead
                               : b->value == 0 ? "0"
                               : k == ADC      ? BESIDE(b->value, 3, s->limit)
                                               : WRITTEN(b->value, 3));
        if (k == ADC || (k == SHARE && d->wooded))
            ceduo_page_light(page, b->light);
        else if (k == SHARE)
            ceduo_page_cell_format(page, "%s", "");
    }
}

const char *ceduo_plot_compare(struct ceduo_drawing *d)
{
    /* a name, and thrice a bar, its value and, but for the last, a light */
    static const struct ceduo_page_column columns[] = {{"", 8, 0, CEDUO_FILLS}, {"", 6, 1, CEDUO_FILLS | CEDUO_DROPPED(2)},
                                                       {"", -5, 1, CEDUO_FITS}, {"", 1, 1, 0},
                                                       {"", 6, 1, CEDUO_FILLS}, {"", -5, 1, CEDUO_FITS},
                                                       {"", 1, 1, 0},           {"", 6, 1, CEDUO_FILLS | CEDUO_DROPPED(1)},
                                                       {"", -5, 1, CEDUO_FITS}};
    const struct ceduo_scene *scene = d->scene;
    const struct ceduo_arrivals *arrivals = d->bare_arrivals;
    struct ceduo_page *page = d->page;
    struct bar bars[BARS];
    size_t room = d->height > 3 ? (size_t)d->height - 2 : 1, n = scene->options_count <= room ? scene->options_count : room - 1;
    if (!d->control)
        return _("no control");
    const struct ceduo_measure judged = ceduo_measure_exceeding(d->control, arrivals);
    double threshold = scene->simulation.threshold, accepted = ceduo_words_accepted(d->control);
    double bare = arrivals && arrivals->reached > 0 ? arrivals->energy.mean : NAN;
    struct scale scales[BARS] = {[ADC] = {threshold / 10, threshold * 2, threshold, _("ADC m")},
                                 [SHARE] = {0, d->wooded ? 1000 : 0,
                                            d->wooded && !isnan(accepted) ? 1000 * ceduo_exceed_limit(scene, d->control) : NAN,
                                            d->wooded ? NAMED(judged, CEDUO_SHORT_HEAD) : _("kJ/100 m")},
                                 [ENERGY] = {0, bare * J_TO_KJ, accepted, d->wooded ? _("mean kJ") : P_("head", "left kJ")}};
    CEDUO_PAGE_TABLE_OF(page, columns);
    for (size_t k = 0; k < BARS; k++) { /* a limit stands above its bars, what they are above their numbers */
        struct ceduo_page_cell *heads = &page->last->cells[3 * k + 1];
        if (!isnan(scales[k].limit))
            ceduo_text_format(&heads[0].text, "\xe2\x94\x82 %s", ROUNDED(scales[k].limit, k == SHARE ? 3 : 6));
        ceduo_text_append(&heads[1].text, scales[k].head);
    }
    for (size_t i = 0; i < scene->options_count; i++) {
        read_option(d, i, bare, bars);
        if (i < n)
            add_option(page, d, i, scales, bars);
        if (isfinite(bars[ADC].value) && bars[ADC].value > 0) {
            scales[ADC].lo = fmin(scales[ADC].lo, bars[ADC].value / 1.5);
            scales[ADC].hi = fmax(scales[ADC].hi, bars[ADC].value * 1.1);
        }
        for (size_t k = SHARE; k < BARS; k++)
            scales[k].hi = fmax(scales[k].hi, bars[k].value);
    }
    if (accepted <= 2 * scales[ENERGY].hi)
        scales[ENERGY].hi = fmax(scales[ENERGY].hi, accepted);
    for (size_t k = 0; k < BARS; k++)
        ceduo_page_scale(page, 3 * k + 1, scales[k].lo, scales[k].hi);
    if (n < scene->options_count)
        ceduo_page_para(page, CEDUO_PAGE_NOTE, _("and %d more options"), (int)(scene->options_count - n));
    /* what is to be held against them */
    const char *mean = WRITTEN(bare * J_TO_KJ, 4);
    if (!arrivals)
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", _("not computed yet"));
    else if (isnan(bare))
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, "%s", _("no rock arrives"));
    else if (!d->wooded)
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, _("left of %s kJ (mean, without forest), by the index"), mean);
    else
        ceduo_page_para_role(page, CEDUO_ROLE_DIM, _("without forest: %.0f %s, mean %s kJ"), judged.value,
                             NAMED(judged, CEDUO_HEAD), mean);
    return NULL;
}
