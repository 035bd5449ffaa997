/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "ceduo/assess.h"
#include "io/intl.h"
#include "plot_parts.h"

/* The options side by side. */

/* What is shown of an option: by the index what the stems take and what is left, through the wood how many of 1000
 * arrive with too much energy (or at all, where that is not said) and the mean energy of those that arrive. */
struct measures {
    double adc, middle, last; /* m; kJ per 100 m or of 1000; kJ. NaN: there is none */
    bool passes, exhausted;
    enum ceduo_light energy;
};

struct comparison {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    const struct ceduo_control *control;
    double bare; /* J, the mean that arrives without forest */
    bool wooded;
    double adc_lo, adc_hi, middle_most, last_most;
    int columns;        /* how many of the three have room */
    int name, bar, gap; /* cells */
    bool two_rows;      /* a name above its bars */
};

#define BAR_LEAST 3
#define VALUE     10 /* columns beside a bar: "59.4 kJ" and words */

static struct measures measures_of(const struct comparison *c, size_t i)
{
    const struct ceduo_scene *scene = c->picture->scene;
    struct ceduo_index index = ceduo_assess_index(scene, &scene->options[i], c->control, c->bare);
    struct measures m = {.adc = index.worst_adc,
                         .middle = index.length > 0 ? index.dissipated / index.length * 100 * KILO : 0,
                         .last = index.residual * KILO,
                         .passes = index.contact == CEDUO_PASS,
                         .exhausted = index.exhausted};
    if (!c->wooded)
        return m;
    struct ceduo_picture picture = *c->picture;
    picture.option = i;
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(&picture, picture.control);
    m.exhausted = false;
    m.middle = a ? 1000 * (isnan(a->exceed_probability) ? a->reach_probability : a->exceed_probability) : NAN;
    m.last = a ? a->energy.mean * KILO : NAN;
    if (a && !isnan(a->exceed_probability))
        m.energy = a->exceed_probability <= CEDUO_EXCEED_MOST ? CEDUO_PASS : CEDUO_FAIL;
    return m;
}

static void find_scales(struct comparison *c)
{
    const struct ceduo_scene *scene = c->picture->scene;
    double threshold = scene->simulation.threshold;
    c->adc_lo = threshold / 10;
    c->adc_hi = threshold * 2;
    c->last_most = c->bare * KILO;
    c->middle_most = c->wooded ? 1000 : 0;
    for (size_t i = 0; i < scene->options_count; i++) {
        struct measures m = measures_of(c, i);
        if (isfinite(m.adc) && m.adc > 0) {
            c->adc_lo = fmin(c->adc_lo, m.adc / 1.5);
            c->adc_hi = fmax(c->adc_hi, m.adc * 1.1);
        }
        c->middle_most = fmax(c->middle_most, m.middle);
        c->last_most = fmax(c->last_most, m.last);
    }
}

/* ---- columns ---- */

static int column_left(const struct comparison *c, int i)
{
    int first = c->area->left + (c->two_rows ? 2 : c->name + c->gap);
    return first + i * (c->bar + 1 + VALUE + c->gap);
}

static void draw_value(const struct comparison *c, int i, int row, double fraction, enum ceduo_role role,
                       const char *value, const char *word)
{
    int left = column_left(c, i);
    if (i >= c->columns)
        return;
    ceduo_canvas_bar(c->canvas, left, row, c->bar, fraction, role);
    int used = ceduo_plot_put(c->canvas, left + c->bar + 1, row, VALUE, CEDUO_ROLE_TEXT, value);
    ceduo_plot_put(c->canvas, left + c->bar + 2 + used, row, VALUE - used - 1, role, word);
}

static double adc_share(const struct comparison *c, double adc)
{
    return isfinite(adc) ? log(adc / c->adc_lo) / log(c->adc_hi / c->adc_lo) : 1;
}

static enum ceduo_role role_of(enum ceduo_light light)
{
    return light == CEDUO_PASS ? CEDUO_ROLE_GOOD : light == CEDUO_FAIL ? CEDUO_ROLE_BAD : CEDUO_ROLE_WOOD;
}

static void draw_option(const struct comparison *c, size_t i, int row)
{
    char room[PLOT_NUMBER_ROOM];
    const struct ceduo_option *o = &c->picture->scene->options[i];
    struct measures m = measures_of(c, i);
    int limit = column_left(c, 0) + (int)lround(adc_share(c, c->picture->scene->simulation.threshold) * c->bar);
    ceduo_plot_put(c->canvas, c->area->left, row, c->name, CEDUO_ROLE_TEXT, o->name ? o->name : "");
    row += c->two_rows;
    draw_value(c, 0, row, adc_share(c, m.adc), m.passes ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD,
               ceduo_plot_number(m.adc, 3, room), m.passes ? _("pass") : _("NO"));
    if (c->bar > 2 && ceduo_canvas_glyph(c->canvas, limit, row) == ' ')
        ceduo_canvas_label(c->canvas, limit, row, CEDUO_ROLE_CONTROL, "\xe2\x94\x82");
    const char *word = m.energy == CEDUO_PASS ? _("pass") : m.energy == CEDUO_FAIL ? _("NO") : "";
    draw_value(c, 1, row, m.middle / c->middle_most, role_of(m.energy),
               m.middle == 0 ? "0" : ceduo_plot_number(m.middle, 3, room), word);
    bool borne = m.last <= c->control->accepted * KILO;
    draw_value(c, 2, row, m.last / c->last_most,
               isnan(c->control->accepted) ? CEDUO_ROLE_BARE
               : borne                     ? CEDUO_ROLE_GOOD
                                           : CEDUO_ROLE_BAD,
               m.exhausted ? _("used up") : ceduo_plot_number(m.last, 3, room), "");
}

/* ---- words ---- */

static void put_heads(const struct comparison *c, int row)
{
    struct text limit = {0}, middle = {0}, left = {0};
    ceduo_text_format(&limit, _("ADC, m (\xe2\x94\x82 %g)"), c->picture->scene->simulation.threshold);
    double accepted = c->control->accepted * KILO;
    ceduo_text_put(&left, c->wooded ? _("mean, kJ") : _("left, kJ"));
    if (!isnan(accepted))
        ceduo_text_format(&left, _(" (bears %g)"), accepted);
    if (!c->wooded)
        ceduo_text_put(&middle, _("taken, kJ/100 m"));
    else if (isnan(accepted))
        ceduo_text_put(&middle, _("of 1000 arrive"));
    else
        ceduo_text_format(&middle, _("of 1000 > %g kJ"), accepted);
    const char *heads[] = {limit.bytes ? limit.bytes : "", middle.bytes ? middle.bytes : "",
                           left.bytes ? left.bytes : ""};
    for (int i = 0; i < c->columns; i++)
        ceduo_plot_put(c->canvas, column_left(c, i), row, c->bar + 1 + VALUE, CEDUO_ROLE_TITLE, heads[i]);
    ceduo_text_free(&limit);
    ceduo_text_free(&middle);
    ceduo_text_free(&left);
}

static void put_foot(const struct comparison *c, int first_free)
{
    char room[PLOT_NUMBER_ROOM];
    int row = c->area->top + c->area->height - 1;
    if (first_free < row)
        ceduo_plot_say(c->canvas, c->area->left, row - 1, c->area->width, CEDUO_ROLE_DIM,
                       _("ADC of the worst belt; pass: every belt below %g m and no gap longer than that"),
                       c->picture->scene->simulation.threshold);
    if (isnan(c->bare))
        ceduo_plot_put(c->canvas, c->area->left, row, c->area->width, CEDUO_ROLE_DIM,
                       c->picture->outlook ? _("Without forest no rock arrives: nothing is left to compare.")
                                           : _("Energies are not computed yet."));
    else if (c->wooded)
        ceduo_plot_say(c->canvas, c->area->left, row, c->area->width, CEDUO_ROLE_DIM,
                       _("through the wood, of all released and of those that arrive; without forest %s kJ (mean)"),
                       ceduo_plot_number(c->bare * KILO, 4, room));
    else
        ceduo_plot_say(c->canvas, c->area->left, row, c->area->width, CEDUO_ROLE_DIM,
                       _("left = %s kJ (mean, without forest) less what the stems could take (index)"),
                       ceduo_plot_number(c->bare * KILO, 4, room));
}

/* ---- the picture ---- */

/* Names get what the bars can spare. */
static void place_columns(struct comparison *c)
{
    const struct ceduo_scene *scene = c->picture->scene;
    int longest = 6;
    for (size_t i = 0; i < scene->options_count; i++) {
        int width = ceduo_canvas_label_width(c->canvas->charset, scene->options[i].name ? scene->options[i].name : "");
        longest = width > longest ? width : longest;
    }
    c->gap = c->area->width >= 100 ? 3 : 1;
    int most = c->area->width * 2 / 5;
    int count = (int)scene->options_count;
    c->two_rows = c->area->width < 110 && c->area->height >= 2 * count + 2;
    c->name = c->two_rows ? c->area->width : longest < most ? longest : most;
    int room = c->area->width - (c->two_rows ? 2 : c->name);
    for (c->columns = 3; c->columns > 0; c->columns--) {
        c->bar = room / c->columns - (c->gap + 1 + VALUE);
        if (c->bar >= BAR_LEAST)
            break;
    }
}

void ceduo_plot_compare(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_scene *scene = picture->scene;
    const struct ceduo_arrivals *arrivals = ceduo_plot_bare_arrivals(picture, picture->control);
    struct comparison c = {.canvas = canvas,
                           .area = area,
                           .picture = picture,
                           .control = ceduo_plot_control(picture),
                           .wooded = ceduo_plot_wooded(picture),
                           .bare = arrivals && arrivals->reached > 0 ? arrivals->energy.mean : NAN};
    if (!c.control) {
        ceduo_plot_words(canvas, area, _("no control"));
        return;
    }
    place_columns(&c);
    if (c.columns == 0 || area->height < 3 + c.two_rows) {
        ceduo_plot_words(canvas, area, _("too narrow"));
        return;
    }
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
}
