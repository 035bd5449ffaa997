/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "measure.h"
#include "plot_parts.h"

/* The options side by side, three bars each: the ADC; by the index what the stems take and what is left, through the forest the
 * share that the control is judged by and the mean energy of the rocks that arrive. */

#define BARS      3
#define BAR_LEAST 3
#define NUMBER    5  /* columns of a number */
#define BESIDE    10 /* columns beside a bar: a number and a word */

/* NaN: there is none. */
struct figures {
    double adc, middle, last; /* m; kJ per 100 m or of 1000; kJ */
    bool exhausted;
    bool awaited; /* what comes through the forest is not known yet */
    enum ceduo_light contact, energy;
};

struct comparison {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    const struct ceduo_control *control;
    const struct ceduo_arrivals *arrivals; /* without forest; NULL: not known yet */
    double bare;                           /* J, the mean of those */
    double accepted, threshold;            /* kJ, m */
    bool wooded;
    double adc_lo, adc_hi, middle_most, last_most;
    int columns;        /* how many of the three have room */
    int name, bar, gap; /* cells */
    bool two_rows;      /* a name above its bars */
};

static struct figures figures_of(const struct comparison *c, size_t i)
{
    const struct ceduo_scene *scene = c->picture->scene;
    struct ceduo_index index = ceduo_assess_index(scene, &scene->options[i], c->control, c->bare);
    bool nothing = c->arrivals && ceduo_says_nothing(c->arrivals); /* then no light is on */
    struct figures f = {.adc = index.worst_adc,
                        .middle = index.per_100m * J_TO_KJ,
                        .last = index.residual * J_TO_KJ,
                        .contact = nothing ? CEDUO_UNKNOWN : index.contact,
                        .exhausted = index.exhausted};
    if (!c->wooded)
        return f;
    struct ceduo_picture picture = *c->picture;
    picture.option = i;
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(&picture, picture.control);
    f.exhausted = false;
    f.awaited = !a;
    f.middle = ceduo_judged(c->control, a).value;
    f.last = a ? a->energy.mean * J_TO_KJ : NAN;
    f.energy = nothing ? CEDUO_UNKNOWN : ceduo_energy_light(a);
    return f;
}

static void find_scales(struct comparison *c)
{
    c->adc_lo = c->threshold / 10;
    c->adc_hi = c->threshold * 2;
    c->last_most = c->bare * J_TO_KJ;
    c->middle_most = c->wooded ? 1000 : 0;
    for (size_t i = 0; i < c->picture->scene->options_count; i++) {
        struct figures f = figures_of(c, i);
        if (isfinite(f.adc) && f.adc > 0) {
            c->adc_lo = fmin(c->adc_lo, f.adc / 1.5);
            c->adc_hi = fmax(c->adc_hi, f.adc * 1.1);
        }
        c->middle_most = fmax(c->middle_most, f.middle);
        c->last_most = fmax(c->last_most, f.last);
    }
    if (c->accepted <= 2 * c->last_most)
        c->last_most = fmax(c->last_most, c->accepted);
}

/* ---- bars ---- */

static int column_left(const struct comparison *c, int i)
{
    int first = c->area->left + (c->two_rows ? 2 : c->name + c->gap);
    return first + i * (c->bar + 1 + BESIDE + c->gap);
}

/* A bar, the limit that it is held against (a share of the bar; NaN: none), a number and a word. */
struct value {
    double share, limit;
    enum ceduo_role role;
    const char *number, *word;
};

static void draw_value(const struct comparison *c, int i, int row, const struct value *v)
{
    int left = column_left(c, i), beside = left + c->bar + 1;
    if (i >= c->columns)
        return;
    ceduo_canvas_bar(c->canvas, left, row, c->bar, v->share, v->role);
    int limit = (int)fmin(round(v->limit * c->bar), c->bar - 1);
    if (v->limit >= 0 && v->limit <= 1 && c->bar > 2)
        ceduo_canvas_label(c->canvas, left + limit, row, CEDUO_ROLE_CONTROL, "\xe2\x94\x82");
    int indent = NUMBER - ceduo_canvas_label_width(c->canvas, v->number);
    indent = indent > 0 ? indent : 0;
    int used = indent + ceduo_canvas_put(c->canvas, beside + indent, row, BESIDE - indent, CEDUO_ROLE_TEXT, v->number);
    ceduo_canvas_put(c->canvas, beside + used + 1, row, BESIDE - used - 1, v->role, v->word);
}

static double adc_share(const struct comparison *c, double adc)
{
    return isfinite(adc) ? log(adc / c->adc_lo) / log(c->adc_hi / c->adc_lo) : 1;
}

static enum ceduo_role role_of(enum ceduo_light light)
{
    return light == CEDUO_UNKNOWN ? CEDUO_ROLE_WOOD : ceduo_plot_light_role(light);
}

static const char *word_of(enum ceduo_light light)
{
    return light == CEDUO_PASS ? _("pass") : light == CEDUO_FAIL ? _("NO") : "";
}

/* A number that is not known yet becomes three dots. */
#define SHOWN(f, number) ((f)->awaited ? "\xe2\x80\xa6" : (number) == 0 ? "0" : WRITTEN(number, 3))

static void draw_option(const struct comparison *c, size_t i, int row)
{
    const char *name = c->picture->scene->options[i].name;
    struct figures f = figures_of(c, i);
    bool limited = c->wooded && !isnan(c->accepted);
    const struct value values[BARS] = {
        {adc_share(c, f.adc), adc_share(c, c->threshold), role_of(f.contact), WRITTEN(f.adc, 3), word_of(f.contact)},
        {f.middle / c->middle_most, limited ? 1000 * CEDUO_EXCEED_MOST / c->middle_most : NAN, role_of(f.energy),
         SHOWN(&f, f.middle), word_of(f.energy)},
        {f.last / c->last_most, c->accepted / c->last_most,
         c->wooded               ? CEDUO_ROLE_WOOD
         : isnan(c->accepted)    ? CEDUO_ROLE_BARE
         : f.last <= c->accepted ? CEDUO_ROLE_GOOD
                                 : CEDUO_ROLE_BAD,
         f.exhausted ? _("used up") : SHOWN(&f, f.last), ""}};
    ceduo_canvas_put(c->canvas, c->area->left, row, c->name, CEDUO_ROLE_TEXT, name ? name : "");
    for (int k = 0; k < BARS; k++)
        draw_value(c, k, row + c->two_rows, &values[k]);
}

/* ---- words ---- */

#define HEADS 2 /* a long one and a short one */

static void put_heads(const struct comparison *c, int row)
{
    const struct ceduo_measure judged = ceduo_judged(c->control, NULL);
    struct text heads[BARS][HEADS] = {{{0}}};
    ceduo_text_format(&heads[0][0], _("ADC, m, logarithmic (\xe2\x94\x82 %g)"), c->threshold);
    ceduo_text_format(&heads[0][1], _("ADC, m, log (\xe2\x94\x82 %g)"), c->threshold);
    for (int i = 0; i < HEADS; i++)
        ceduo_text_put(&heads[2][i], c->wooded ? _("mean, kJ") : _("left, kJ"));
    if (!c->wooded) {
        ceduo_text_put(&heads[1][0], _("taken, kJ/100 m"));
        ceduo_text_put(&heads[1][1], _("taken"));
    } else {
        ceduo_measure_name(&heads[1][0], &judged, CEDUO_HEAD);
        ceduo_measure_name(&heads[1][1], &judged, isnan(c->accepted) ? CEDUO_SHORT_HEAD : CEDUO_HEAD);
    }
    if (c->wooded && !isnan(c->accepted))
        ceduo_text_then(&heads[1][0], " ", "(\xe2\x94\x82 %g)", 1000 * CEDUO_EXCEED_MOST);
    if (!isnan(c->accepted)) {
        ceduo_text_then(&heads[2][0], " ", _("(\xe2\x94\x82 withstands %g)"), c->accepted);
        ceduo_text_then(&heads[2][1], " ", "(\xe2\x94\x82 %g)", c->accepted);
    }
    for (int i = 0; i < BARS; i++)
        ceduo_plot_put_fitting(c->canvas, column_left(c, i), row, i < c->columns ? c->bar + 1 + BESIDE : 0, CEDUO_ROLE_TITLE,
                               HEADS, heads[i]);
}

/* What is to be held against the options. */
static void write_bare(const struct comparison *c, struct text *feet)
{
    const struct ceduo_arrivals *a = c->arrivals;
    const char *mean = WRITTEN(c->bare * J_TO_KJ, 4);
    if (!a || isnan(c->bare)) {
        ceduo_text_put(&feet[0], a ? _("Without forest no rock arrives: nothing is left to compare.")
                                   : _("Energies are not computed yet."));
    } else if (!c->wooded) {
        ceduo_text_format(&feet[0], _("left = %s kJ (mean, without forest) less what the stems could take (index)"), mean);
        ceduo_text_format(&feet[1], _("left of %s kJ (mean, without forest), by the index"), mean);
    } else {
        const struct ceduo_measure judged = ceduo_judged(c->control, a);
        LOCAL_TEXT(head);
        ceduo_measure_name(&head, &judged, CEDUO_HEAD);
        ceduo_text_format(&feet[1], _("without forest: %.0f %s, mean %s kJ"), judged.value, ceduo_text_string(&head), mean);
        ceduo_text_format(&feet[0], _("%s; mean: of those that arrive"), feet[1].bytes);
    }
}

static void put_foot(const struct comparison *c, int first_free)
{
    int row = c->area->top + c->area->height - 1;
    struct text rule[HEADS] = {{0}}, bare[HEADS] = {{0}};
    ceduo_text_format(&rule[0], _("ADC of the worst belt; pass: every belt below %g m and no gap longer than that"),
                      c->threshold);
    ceduo_text_format(&rule[1], _("pass: ADC of every belt and every gap below %g m"), c->threshold);
    write_bare(c, bare);
    ceduo_plot_put_fitting(c->canvas, c->area->left, row - 1, first_free < row ? c->area->width : 0, CEDUO_ROLE_DIM, HEADS,
                           rule);
    ceduo_plot_put_fitting(c->canvas, c->area->left, row, c->area->width, CEDUO_ROLE_DIM, bare[1].bytes ? HEADS : 1, bare);
}

/* ---- the picture ---- */

/* Names get what the bars can spare. */
static void place_columns(struct comparison *c)
{
    const struct ceduo_scene *scene = c->picture->scene;
    int longest = 6, most = c->area->width * 2 / 5, count = (int)scene->options_count;
    for (size_t i = 0; i < scene->options_count; i++) {
        int width = ceduo_canvas_label_width(c->canvas, scene->options[i].name ? scene->options[i].name : "");
        longest = width > longest ? width : longest;
    }
    c->gap = c->area->width >= 100 ? 3 : 1;
    c->two_rows = c->area->width < 110 && c->area->height >= 2 * count + 2;
    c->name = c->two_rows ? c->area->width : longest < most ? longest : most;
    int room = c->area->width - (c->two_rows ? 2 : c->name);
    for (c->columns = BARS; c->columns > 0; c->columns--) {
        c->bar = room / c->columns - (c->gap + 1 + BESIDE);
        if (c->bar >= BAR_LEAST)
            break;
    }
}

const char *ceduo_plot_compare(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_scene *scene = picture->scene;
    const struct ceduo_arrivals *arrivals = ceduo_plot_bare_arrivals(picture, picture->control);
    struct comparison c = {.canvas = canvas,
                           .area = area,
                           .picture = picture,
                           .control = ceduo_plot_control(picture),
                           .wooded = ceduo_plot_wooded(picture),
                           .threshold = scene->simulation.threshold,
                           .arrivals = arrivals,
                           .bare = arrivals && arrivals->reached > 0 ? arrivals->energy.mean : NAN};
    if (!c.control)
        return _("no control");
    c.accepted = c.control->accepted * J_TO_KJ;
    place_columns(&c);
    if (c.columns == 0 || area->height < 3 + c.two_rows)
        return _("too narrow");
    find_scales(&c);
    int count = (int)scene->options_count, rows = 1 + c.two_rows, end = area->top + area->height - 1;
    int step = rows + (2 + (rows + 1) * count <= area->height), row = area->top + step - rows + 1;
    put_heads(&c, area->top);
    for (int i = 0; i < count; i++, row += step) {
        if (row + rows >= end && i + 1 < count) {
            ceduo_plot_say(canvas, area->left, row, area->width, CEDUO_ROLE_WARN, _("and %d more options"), count - i);
            break;
        }
        draw_option(&c, (size_t)i, row);
    }
    put_foot(&c, row);
    return NULL;
}
