/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options side by side, a row and three bars each: the ADC; by the index what the stems take and what is left, through the
 * forest the share that the control is judged by and the mean energy of the rocks that arrive. */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "measure.h"
#include "plot_parts.h"

/* NaN: there is none. */
struct figures {
    double adc, middle, last; /* m; kJ per 100 m or of 1000; kJ */
    bool exhausted;
    bool awaited; /* what comes through the forest is not known yet */
    enum ceduo_light contact, energy;
};

struct comparison {
    const struct ceduo_drawing *d;
    double bare;                /* J, the mean of the rocks that arrive without forest */
    double accepted, threshold; /* kJ, m */
    double adc_lo, adc_hi, middle_most, last_most;
};

static struct figures figures_of(const struct comparison *c, size_t i)
{
    const struct ceduo_drawing *d = c->d;
    struct ceduo_index index = ceduo_assess_index(d->scene, &d->scene->options[i], d->control, c->bare);
    bool nothing = d->bare_arrivals && ceduo_says_nothing(d->bare_arrivals); /* then no light is on */
    struct figures f = {.adc = index.worst_adc,
                        .middle = index.per_100m * J_TO_KJ,
                        .last = index.residual * J_TO_KJ,
                        .contact = nothing ? CEDUO_UNKNOWN : index.contact,
                        .exhausted = index.exhausted};
    if (!d->wooded)
        return f;
    const struct ceduo_run_snapshot *run = ceduo_snapshot_of(d->picture->snapshot, d->scene, i);
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(run, d->picture->control);
    f.exhausted = false;
    f.awaited = !a;
    f.middle = ceduo_judged(d->control, a).value;
    f.last = a ? a->energy.mean * J_TO_KJ : NAN;
    f.energy = nothing ? CEDUO_UNKNOWN : ceduo_energy_light(a);
    return f;
}

static double adc_share(const struct comparison *c, double adc)
{
    return isfinite(adc) ? log(adc / c->adc_lo) / log(c->adc_hi / c->adc_lo) : 1;
}

static enum ceduo_role role_of(enum ceduo_light light)
{
    return light == CEDUO_UNKNOWN ? CEDUO_ROLE_WOOD : ceduo_plot_light_role(light);
}

#define SHOWN(number) ((number) == 0 ? "0" : WRITTEN(number, 3))

static void add_option(struct ceduo_page *page, const struct comparison *c, size_t i)
{
    struct figures f = figures_of(c, i);
    const char *awaited = f.awaited ? "\xe2\x80\xa6" : NULL; /* a number that is not known yet becomes three dots */
    bool limited = c->d->wooded && !isnan(c->accepted);
    ceduo_page_mark(page, i == c->d->picture->option ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT, c->d->scene->options[i].name);
    ceduo_page_bar(page, adc_share(c, f.adc), role_of(f.contact))->limit = adc_share(c, c->threshold);
    ceduo_page_write(page, "%s", f.adc == 0 ? "0" : BESIDE(f.adc, 3, c->threshold));
    ceduo_page_light(page, f.contact);
    ceduo_page_bar(page, f.middle / c->middle_most, role_of(f.energy))->limit =
        limited ? 1000 * CEDUO_EXCEED_MOST / c->middle_most : NAN;
    ceduo_page_write(page, "%s", awaited ? awaited : SHOWN(f.middle));
    if (c->d->wooded)
        ceduo_page_light(page, f.energy);
    else
        ceduo_page_write(page, "%s", "");
    ceduo_page_bar(page, f.last / c->last_most,
                   c->d->wooded            ? CEDUO_ROLE_WOOD
                   : isnan(c->accepted)    ? CEDUO_ROLE_BARE
                   : f.last <= c->accepted ? CEDUO_ROLE_GOOD
                                           : CEDUO_ROLE_BAD)
        ->limit = c->accepted / c->last_most;
    ceduo_page_write(page, "%s", f.exhausted ? _("used up") : awaited ? awaited : SHOWN(f.last));
}

/* A limit stands above its bars, what they are above their numbers. */
static void add_heads(struct ceduo_page *page, const struct comparison *c)
{
    struct ceduo_page_cell *heads = page->last->cells;
    struct ceduo_measure judged = ceduo_judged(c->d->control, NULL);
    ceduo_text_format(&heads[1].text, "\xe2\x94\x82 %s", SHORTEST(c->threshold));
    ceduo_text_put(&heads[2].text, _("ADC m"));
    if (c->d->wooded)
        ceduo_measure_name(&heads[5].text, &judged, CEDUO_SHORT_HEAD);
    else
        ceduo_text_put(&heads[5].text, _("kJ/100 m"));
    if (c->d->wooded && !isnan(c->accepted))
        ceduo_text_format(&heads[4].text, "\xe2\x94\x82 %g", 1000 * CEDUO_EXCEED_MOST);
    if (!isnan(c->accepted))
        ceduo_text_format(&heads[7].text, "\xe2\x94\x82 %s", SHORTEST(c->accepted));
    ceduo_text_put(&heads[8].text, c->d->wooded ? _("mean kJ") : P_("head", "left kJ"));
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
    struct comparison c = {.d = d,
                           .threshold = scene->simulation.threshold,
                           .bare = arrivals && arrivals->reached > 0 ? arrivals->energy.mean : NAN};
    struct ceduo_page *page = d->page;
    size_t room = d->height > 3 ? (size_t)d->height - 2 : 1, n = scene->options_count <= room ? scene->options_count : room - 1;
    if (!d->control)
        return _("no control");
    c.accepted = d->control->accepted * J_TO_KJ;
    c.adc_lo = c.threshold / 10;
    c.adc_hi = c.threshold * 2;
    c.last_most = c.bare * J_TO_KJ;
    c.middle_most = d->wooded ? 1000 : 0;
    for (size_t i = 0; i < scene->options_count; i++) {
        struct figures f = figures_of(&c, i);
        if (isfinite(f.adc) && f.adc > 0) {
            c.adc_lo = fmin(c.adc_lo, f.adc / 1.5);
            c.adc_hi = fmax(c.adc_hi, f.adc * 1.1);
        }
        c.middle_most = fmax(c.middle_most, f.middle);
        c.last_most = fmax(c.last_most, f.last);
    }
    if (c.accepted <= 2 * c.last_most)
        c.last_most = fmax(c.last_most, c.accepted);
    CEDUO_PAGE_TABLE_OF(page, columns);
    add_heads(page, &c);
    for (size_t i = 0; i < n; i++)
        add_option(page, &c, i);
    if (n < scene->options_count)
        ceduo_page_say(page, CEDUO_PAGE_NOTE, _("and %d more options"), (int)(scene->options_count - n));
    /* what is to be held against them */
    const struct ceduo_measure judged = ceduo_judged(d->control, arrivals);
    const char *mean = WRITTEN(c.bare * J_TO_KJ, 4);
    LOCAL_TEXT(head);
    ceduo_measure_name(&head, &judged, CEDUO_HEAD);
    if (!arrivals)
        ceduo_page_line(page, CEDUO_ROLE_DIM, "%s", _("not computed yet"));
    else if (isnan(c.bare))
        ceduo_page_line(page, CEDUO_ROLE_DIM, "%s", _("no rock arrives"));
    else if (!d->wooded)
        ceduo_page_line(page, CEDUO_ROLE_DIM, _("left of %s kJ (mean, without forest), by the index"), mean);
    else
        ceduo_page_line(page, CEDUO_ROLE_DIM, _("without forest: %.0f %s, mean %s kJ"), judged.value, ceduo_text_string(&head),
                        mean);
    return NULL;
}
