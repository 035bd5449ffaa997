/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "ceduo/assess.h"
#include "plot_parts.h"
#include "scene/choices.h"

/* Draws the rules of the ADC as bars on a log scale. */

#define RULES (CEDUO_CROFTON - CEDUO_GSTEIGER_STOOLS + 1)
#define VALUE 9      /* columns of "12.3 m" and blanks */
#define LEAST 1e-300 /* m; the numbers below it stand too far apart for the next mark to be another */

struct adc_picture {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    double threshold, lo, hi; /* m */
    int name, bar, word;      /* columns */
    int row, end;             /* the row to draw, the one below the area */
};

static int bar_left(const struct adc_picture *p)
{
    return p->area->left + p->name + 1;
}

static double share_of(const struct adc_picture *p, double metres)
{
    return isfinite(metres) ? fmax(0, log(metres / p->lo) / log(p->hi / p->lo)) : 1;
}

static int column_of(const struct adc_picture *p, double metres)
{
    return bar_left(p) + (int)lround(share_of(p, metres) * p->bar);
}

/* ---- the scale ---- */

static void find_scale(struct adc_picture *p, const struct ceduo_option *option)
{
    double least = p->threshold, most = p->threshold;
    for (size_t i = 0; i < option->belts_count; i++) {
        struct ceduo_stand_result r = ceduo_assess_stand(p->picture->scene, &option->belts[i]);
        for (int f = 0; f < RULES; f++) {
            double v = ceduo_adc_value(&r.adc, (enum ceduo_rule)(CEDUO_GSTEIGER_STOOLS + f));
            if (!isfinite(v) || !(v > 0))
                continue;
            least = fmin(least, v);
            most = fmax(most, v);
        }
    }
    p->lo = ceduo_plot_round(fmax(least / 1.5, LEAST), false);
    p->hi = ceduo_plot_round(1.5 * most, true);
}

/* Marks of the scale below the bars, as many as stand clear of each other. */
static void draw_scale(const struct adc_picture *p, int row)
{
    int free_from = bar_left(p), end = bar_left(p) + p->bar;
    LOCAL_TEXT(threshold);
    ceduo_text_format(&threshold, _("%g m"), p->threshold);
    const char *limit = ceduo_text_string(&threshold);
    int at = column_of(p, p->threshold), limit_end = at + ceduo_canvas_label_width(p->canvas, limit);
    ceduo_canvas_label(p->canvas, at, row, CEDUO_ROLE_CONTROL, limit);
    for (double v = p->lo; v <= p->hi * (1 + 1e-9); v = ceduo_plot_round(1.5 * v, true)) {
        char text[CEDUO_TICK_LABEL_SIZE];
        int column = column_of(p, v), width = (int)ceduo_tick_label(v, v, sizeof text, text);
        bool hidden = column + width + 1 > at && column < limit_end + 1;
        if (column < free_from || column + width > end + 2 || hidden)
            continue;
        ceduo_canvas_label(p->canvas, column, row, CEDUO_ROLE_AXIS, text);
        free_from = column + width + 2;
    }
    ceduo_plot_say(p->canvas, end + 4, row, p->area->left + p->area->width - end - 4, CEDUO_ROLE_AXIS, "%s", _("logarithmic"));
    if (row + 2 < p->end)
        ceduo_plot_say(p->canvas, p->area->left, row + 2, p->area->width, CEDUO_ROLE_DIM,
                       _("\xe2\x94\x82 %g m: in this distance without a contact a rock reaches its full speed."), p->threshold);
}

/* ---- rows ---- */

static void draw_bar(const struct adc_picture *p, double metres, enum ceduo_role role)
{
    int at = column_of(p, p->threshold);
    if (isfinite(metres))
        ceduo_canvas_bar(p->canvas, bar_left(p), p->row, p->bar, share_of(p, metres), role);
    if (ceduo_canvas_is_blank(p->canvas, at, p->row))
        ceduo_canvas_label(p->canvas, at, p->row, CEDUO_ROLE_CONTROL, "\xe2\x94\x82");
    ceduo_plot_say_right(p->canvas, bar_left(p) + p->bar + VALUE - 1, p->row, VALUE - 1, CEDUO_ROLE_TEXT,
                         isfinite(metres) ? _("%s m") : "%s", WRITTEN(metres, 3));
}

static void put_verdict(const struct adc_picture *p, const struct ceduo_stand_result *r, bool in_words)
{
    int column = bar_left(p) + p->bar + VALUE + 1;
    ceduo_plot_say(p->canvas, column, p->row, p->area->left + p->area->width - column,
                   r->passes_threshold ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD, in_words ? _("applied: %s") : "%s",
                   r->passes_threshold ? _("passes") : _("NO"));
}

/* Draws a belt in five rows: its name and its four rules. */
static void draw_belt(struct adc_picture *p, const struct ceduo_belt *belt, const struct ceduo_stand_result *r)
{
    struct text name = {0};
    ceduo_plot_belt_name(&name, belt);
    ceduo_text_then(&name, ", ", "%s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
    if (r->bare)
        ceduo_text_then(&name, ": ", _("no stems, nothing to meet: NO"));
    ceduo_plot_put_fitting(p->canvas, p->area->left, p->row++, p->area->width, CEDUO_ROLE_BELT, 1, &name);
    for (int f = 0; f < RULES && !r->bare; f++, p->row++) {
        enum ceduo_rule rule = (enum ceduo_rule)(CEDUO_GSTEIGER_STOOLS + f);
        double value = ceduo_adc_value(&r->adc, rule);
        bool applied = rule == r->rule;
        enum ceduo_role role = value < p->threshold ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD;
        ceduo_plot_say(p->canvas, p->area->left, p->row, p->name, applied ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT, "%s%s",
                       applied ? "\xe2\x96\xb6 " : "  ", ceduo_rule_words.names[rule]);
        draw_bar(p, value, applied ? role : CEDUO_ROLE_DIM);
        if (applied)
            put_verdict(p, r, p->word >= 16);
    }
}

/* Draws a belt in one row, with the applied rule alone. */
static void draw_belt_briefly(struct adc_picture *p, const struct ceduo_belt *belt, const struct ceduo_stand_result *r)
{
    struct text name = {0};
    ceduo_plot_belt_name(&name, belt);
    ceduo_plot_put_fitting(p->canvas, p->area->left, p->row, p->name, CEDUO_ROLE_BELT, 1, &name);
    draw_bar(p, r->adc_m, r->passes_threshold ? CEDUO_ROLE_GOOD : CEDUO_ROLE_BAD);
    put_verdict(p, r, false);
    p->row++;
}

/* Rows of all belts in full. */
static int full_rows(const struct ceduo_option *option)
{
    int rows = 0;
    for (size_t i = 0; i < option->belts_count; i++)
        rows += ceduo_stand_is_bare(&option->belts[i].stand) ? 1 : 1 + RULES;
    return rows;
}

static void draw_belts(struct adc_picture *p, const struct ceduo_option *option)
{
    const struct ceduo_area *a = p->area;
    int last = a->top + a->height - 2; /* the scale stands below */
    int rows = full_rows(option), gaps = (int)option->belts_count - 1;
    bool full = rows <= a->height - 1, spaced = rows + gaps <= a->height - 1;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        struct ceduo_stand_result r = ceduo_assess_stand(p->picture->scene, belt);
        size_t left = option->belts_count - i;
        if (!full && p->row >= last && left > 1) {
            ceduo_plot_say(p->canvas, a->left, p->row++, a->width, CEDUO_ROLE_WARN, _("and %zu more belts"), left);
            break;
        }
        p->row += full && spaced && i > 0;
        if (full)
            draw_belt(p, belt, &r);
        else
            draw_belt_briefly(p, belt, &r);
    }
    draw_scale(p, p->row);
}

const char *ceduo_plot_adc(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_option *option = ceduo_plot_option(picture);
    if (!option || option->belts_count == 0)
        return _("no forest: nothing to meet");
    struct adc_picture p = {.canvas = canvas,
                            .area = area,
                            .picture = picture,
                            .threshold = picture->scene->simulation.threshold,
                            .name = 18,
                            .word = area->width >= 60 ? 16 : 7,
                            .row = area->top,
                            .end = area->top + area->height};
    p.bar = area->width - p.name - 1 - VALUE - 1 - p.word;
    if (p.bar < 6 || area->height < 2)
        return _("too narrow");
    find_scale(&p, option);
    draw_belts(&p, option);
    return NULL;
}
