/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "plot_parts.h"
#include "study/verdict.h"

/* The options side by side. */

/* What is shown of an option: by the index what the stems take and what is left, through the forest how many of 1000
 * arrive with too much energy (or at all, where that is not said) and the mean energy of those that arrive. */
struct measures {
    double adc, middle, last; /* m; kJ per 100 m or of 1000; kJ. NaN: there is none */
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
    bool wooded;
    double adc_lo, adc_hi, middle_most, last_most;
    int columns;        /* how many of the three have room */
    int name, bar, gap; /* cells */
    bool two_rows;      /* a name above its bars */
};

#define BAR_LEAST 3
#define NUMBER    5  /* columns of a number */
#define VALUE     10 /* columns beside a bar: a number and a word */

static struct measures measures_of(const struct comparison *c, size_t i)
{
    const struct ceduo_scene *scene = c->picture->scene;
    struct ceduo_index index = ceduo_assess_index(scene, &scene->options[i], c->control, c->bare);
    const struct ceduo_arrivals *bare = ceduo_plot_bare_arrivals(c->picture, c->picture->control);
    bool nothing = bare && ceduo_says_nothing(bare); /* then no light is on */
    struct measures m = {.adc = index.worst_adc,
                         .middle = index.per_100m * J_TO_KJ,
                         .last = index.residual * J_TO_KJ,
                         .contact = nothing ? CEDUO_UNKNOWN : index.contact,
                         .exhausted = index.exhausted};
    if (!c->wooded)
        return m;
    struct ceduo_picture picture = *c->picture;
    picture.option = i;
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(&picture, picture.control);
    m.exhausted = false;
    m.awaited = !a;
    m.middle = a ? 1000 * ceduo_share_of(a) : NAN;
    m.last = a ? a->energy.mean * J_TO_KJ : NAN;
    m.energy = nothing ? CEDUO_UNKNOWN : ceduo_energy_light(a);
    return m;
}

static void find_scales(struct comparison *c)
{
    const struct ceduo_scene *scene = c->picture->scene;
    double threshold = scene->simulation.threshold;
    c->adc_lo = threshold / 10;
    c->adc_hi = threshold * 2;
    c->last_most = c->bare * J_TO_KJ;
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
    double accepted = c->control->accepted * J_TO_KJ;
    if (accepted <= 2 * c->last_most)
        c->last_most = fmax(c->last_most, accepted);
}

/* ---- columns ---- */

static int column_left(const struct comparison *c, int i)
{
    int first = c->area->left + (c->two_rows ? 2 : c->name + c->gap);
    return first + i * (c->bar + 1 + VALUE + c->gap);
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
    int used = indent + ceduo_canvas_put(c->canvas, beside + indent, row, VALUE - indent, CEDUO_ROLE_TEXT, v->number);
    ceduo_canvas_put(c->canvas, beside + used + 1, row, VALUE - used - 1, v->role, v->word);
}

static double adc_share(const struct comparison *c, double adc)
{
    return isfinite(adc) ? log(adc / c->adc_lo) / log(c->adc_hi / c->adc_lo) : 1;
}

static enum ceduo_role role_of(enum ceduo_light light)
{
    return light == CEDUO_PASS ? CEDUO_ROLE_GOOD : light == CEDUO_FAIL ? CEDUO_ROLE_BAD : CEDUO_ROLE_WOOD;
}

static const char *word_of(enum ceduo_light light)
{
    return light == CEDUO_PASS ? _("pass") : light == CEDUO_FAIL ? _("NO") : "";
}

static void draw_adc(const struct comparison *c, const struct measures *m, int row)
{
    char room[PLOT_NUMBER_ROOM];
    enum ceduo_light light = m->contact;
    const struct value v = {.share = adc_share(c, m->adc),
                            .limit = adc_share(c, c->picture->scene->simulation.threshold),
                            .role = role_of(light),
                            .number = ceduo_plot_number(m->adc, 3, room),
                            .word = word_of(light)};
    draw_value(c, 0, row, &v);
}

/* A number that is not known yet becomes three dots. */
static const char *number_of(const struct measures *m, double number, char room[PLOT_NUMBER_ROOM])
{
    return m->awaited ? "\xe2\x80\xa6" : number == 0 ? "0" : ceduo_plot_number(number, 3, room);
}

static void draw_middle(const struct comparison *c, const struct measures *m, int row)
{
    char room[PLOT_NUMBER_ROOM];
    bool limited = c->wooded && !isnan(c->control->accepted);
    const struct value v = {.share = m->middle / c->middle_most,
                            .limit = limited ? 1000 * CEDUO_EXCEED_MOST / c->middle_most : NAN,
                            .role = role_of(m->energy),
                            .number = number_of(m, m->middle, room),
                            .word = word_of(m->energy)};
    draw_value(c, 1, row, &v);
}

static void draw_last(const struct comparison *c, const struct measures *m, int row)
{
    char room[PLOT_NUMBER_ROOM];
    double accepted = c->control->accepted * J_TO_KJ;
    const struct value v = {.share = m->last / c->last_most,
                            .limit = accepted / c->last_most,
                            .role = c->wooded             ? CEDUO_ROLE_WOOD
                                    : isnan(accepted)     ? CEDUO_ROLE_BARE
                                    : m->last <= accepted ? CEDUO_ROLE_GOOD
                                                          : CEDUO_ROLE_BAD,
                            .number = m->exhausted ? _("used up") : number_of(m, m->last, room),
                            .word = ""};
    draw_value(c, 2, row, &v);
}

static void draw_option(const struct comparison *c, size_t i, int row)
{
    const struct ceduo_option *o = &c->picture->scene->options[i];
    struct measures m = measures_of(c, i);
    ceduo_canvas_put(c->canvas, c->area->left, row, c->name, CEDUO_ROLE_TEXT, o->name ? o->name : "");
    row += c->two_rows;
    draw_adc(c, &m, row);
    draw_middle(c, &m, row);
    draw_last(c, &m, row);
}

/* ---- words ---- */

#define HEADS 2 /* a long one and a short one */

static void write_middle_head(const struct comparison *c, struct text *heads)
{
    double accepted = c->control->accepted * J_TO_KJ;
    if (!c->wooded) {
        ceduo_text_put(&heads[0], _("taken, kJ/100 m"));
        ceduo_text_put(&heads[1], _("taken"));
    } else if (isnan(accepted)) {
        ceduo_text_put(&heads[0], _("of 1000 arrive"));
        ceduo_text_put(&heads[1], _("arrive"));
    } else {
        ceduo_text_format(&heads[0], _("of 1000 > %g kJ (\xe2\x94\x82 %g)"), accepted, 1000 * CEDUO_EXCEED_MOST);
        ceduo_text_format(&heads[1], _("of 1000 > %g kJ"), accepted);
    }
}

static void write_last_head(const struct comparison *c, struct text *heads)
{
    double accepted = c->control->accepted * J_TO_KJ;
    for (int i = 0; i < HEADS; i++)
        ceduo_text_put(&heads[i], c->wooded ? _("mean, kJ") : _("left, kJ"));
    if (!isnan(accepted)) {
        ceduo_text_then(&heads[0], " ", _("(\xe2\x94\x82 withstands %g)"), accepted);
        ceduo_text_then(&heads[1], " ", "(\xe2\x94\x82 %g)", accepted);
    }
}

static void put_heads(const struct comparison *c, int row)
{
    struct text heads[3][HEADS] = {{{0}}};
    ceduo_text_format(&heads[0][0], _("ADC, m, logarithmic (\xe2\x94\x82 %g)"), c->picture->scene->simulation.threshold);
    ceduo_text_format(&heads[0][1], _("ADC, m, log (\xe2\x94\x82 %g)"), c->picture->scene->simulation.threshold);
    write_middle_head(c, heads[1]);
    write_last_head(c, heads[2]);
    for (int i = 0; i < 3; i++)
        ceduo_plot_put_fitting(c->canvas, column_left(c, i), row, i < c->columns ? c->bar + 1 + VALUE : 0, CEDUO_ROLE_TITLE,
                               HEADS, heads[i]);
}

/* What is to be held against the options. */
static void write_bare(const struct comparison *c, struct text *feet)
{
    char room[PLOT_NUMBER_ROOM];
    const struct ceduo_arrivals *a = c->arrivals;
    const char *mean = ceduo_plot_number(c->bare * J_TO_KJ, 4, room);
    if (!a || isnan(c->bare)) {
        ceduo_text_put(&feet[0], a ? _("Without forest no rock arrives: nothing is left to compare.")
                                   : _("Energies are not computed yet."));
    } else if (!c->wooded) {
        ceduo_text_format(&feet[0], _("left = %s kJ (mean, without forest) less what the stems could take (index)"), mean);
        ceduo_text_format(&feet[1], _("left of %s kJ (mean, without forest), by the index"), mean);
    } else if (isnan(a->exceed_probability)) {
        ceduo_text_format(&feet[1], _("without forest: %.0f of 1000, mean %s kJ"), 1000 * a->reach_probability, mean);
    } else {
        ceduo_text_format(&feet[1], _("without forest: %.0f of 1000 > %g kJ, mean %s kJ"), 1000 * a->exceed_probability,
                          c->control->accepted * J_TO_KJ, mean);
    }
    if (!feet[0].bytes && feet[1].bytes)
        ceduo_text_format(&feet[0], _("%s; mean: of those that arrive"), feet[1].bytes);
}

static void put_foot(const struct comparison *c, int first_free)
{
    int row = c->area->top + c->area->height - 1;
    double threshold = c->picture->scene->simulation.threshold;
    struct text rule[HEADS] = {{0}}, bare[HEADS] = {{0}};
    ceduo_text_format(&rule[0], _("ADC of the worst belt; pass: every belt below %g m and no gap longer than that"), threshold);
    ceduo_text_format(&rule[1], _("pass: ADC of every belt and every gap below %g m"), threshold);
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
    int longest = 6;
    for (size_t i = 0; i < scene->options_count; i++) {
        int width = ceduo_canvas_label_width(c->canvas, scene->options[i].name ? scene->options[i].name : "");
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

const char *ceduo_plot_compare(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_scene *scene = picture->scene;
    const struct ceduo_arrivals *arrivals = ceduo_plot_bare_arrivals(picture, picture->control);
    struct comparison c = {.canvas = canvas,
                           .area = area,
                           .picture = picture,
                           .control = ceduo_plot_control(picture),
                           .wooded = ceduo_plot_wooded(picture),
                           .arrivals = arrivals,
                           .bare = arrivals && arrivals->reached > 0 ? arrivals->energy.mean : NAN};
    if (!c.control)
        return _("no control");
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
