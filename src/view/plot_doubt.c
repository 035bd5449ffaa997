/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How sure the answer is: for each option the range of what may be true, in it the error of the rocks; below, what the
 * option of the picture depends on, as bars of the share of each input, with the width of the doubt if it were known. */
#include <math.h>

#include "base/language.h"
#include "plot_parts.h"
#include "report_doubt.h"

#define SHOWN_LEAST  0.005 /* of the share of an input */
#define WIDTH_LEAST  40
#define HEIGHT_LEAST 4
#define INPUTS_LEAST 2 /* lines: a head and one input */
#define NAME_MOST    34
#define VALUES       24 /* columns of "1000  1000–1000" and the like … */
#define VALUES_LEAST 19 /* … and where there are few */
#define FEW          60

struct sure {
    struct ceduo_canvas *canvas;
    const struct ceduo_doubt_report *report;
    size_t option;
    int left, width, name, bars, values; /* columns: bars begin after the name, values end on the right */
    int y, end;
    double scale, most; /* of the figures shown; where the axis ends */
};

static const struct ceduo_doubt_figure *main_of(const struct sure *s, size_t option)
{
    return ceduo_doubt_figure_of(s->report->answer, option, s->report->answer->main, false);
}

static int column_of(const struct sure *s, double value)
{
    double share = fmin(1, fmax(0, value * s->scale / s->most));
    return s->left + s->name + 1 + (int)(share * (s->bars - 1));
}

/* The ends of a line are always there, and what the rocks leave open at least one cell. */
static void draw_range(const struct sure *s, size_t option)
{
    const struct ceduo_doubt_figure *f = main_of(s, option);
    struct ceduo_doubt_now now = ceduo_doubt_now_of(s->report, option);
    int from = column_of(s, f->fit.p5), to = column_of(s, f->fit.p95);
    for (int x = from; x <= to; x++)
        ceduo_canvas_label(s->canvas, x, s->y, CEDUO_ROLE_MEAN,
                           x == from ? "\xe2\x94\x9c"
                           : x == to ? "\xe2\x94\xa4"
                                     : "\xe2\x94\x80");
    for (int x = column_of(s, now.lo); x <= column_of(s, now.hi); x++)
        ceduo_canvas_bar(s->canvas, x, s->y, 1, 1, CEDUO_ROLE_TITLE);
}

static void draw_option(struct sure *s, size_t i)
{
    struct text values = {0};
    ceduo_plot_put_ends(s->canvas, s->left, s->y, s->name, i == s->option ? CEDUO_ROLE_TITLE : CEDUO_ROLE_TEXT,
                        s->report->file->scene.options[i].name);
    draw_range(s, i);
    ceduo_doubt_range(&values, s->report, i);
    ceduo_plot_put_right(s->canvas, s->left + s->width - 1, s->y, s->values, CEDUO_ROLE_TEXT, &values);
    s->y++;
}

static void put_caption(const struct sure *s, const struct ceduo_control *control)
{
    struct text words[2] = {{0}, {0}};
    bool share = s->report->answer->main == CEDUO_DOUBT_EXCEED;
    double accepted = ceduo_words_accepted(control);
    if (share) {
        ceduo_text_format(&words[0], _("of 1000 rocks those with more than %g kJ, 0 to 1000"), accepted);
        ceduo_text_format(&words[1], _("of 1000 more than %g kJ"), accepted);
    } else {
        ceduo_text_format(&words[0], _("kJ per released rock, 0 to %.4g"), s->most);
        ceduo_text_put(&words[1], _("kJ per rock"));
    }
    ceduo_plot_put_fitting(s->canvas, s->left, s->y, s->width - s->values - 1, CEDUO_ROLE_AXIS, 2, words);
}

/* Of so many lines: all options, where that leaves INPUTS_LEAST; otherwise two thirds of the lines, one of them to say so. */
static size_t options_room(size_t options, size_t lines)
{
    size_t most = lines * 2 / 3;
    return options + INPUTS_LEAST <= lines ? options : most > 1 ? most - 1 : 1;
}

static void draw_options(struct sure *s)
{
    const struct ceduo_scene *scene = &s->report->file->scene;
    size_t n = scene->options_count, room = options_room(n, (size_t)(s->end - s->y - 1)), first = 0;
    if (s->option >= room)
        first = s->option - room + 1;
    ceduo_plot_say_right(s->canvas, s->left + s->width - 1, s->y, s->values, CEDUO_ROLE_AXIS, "%s", _("now (doubt, 90 %)"));
    put_caption(s, &scene->controls[ceduo_scene_last_control(scene)]);
    s->y++;
    for (size_t i = first; i < n && i < first + room; i++)
        draw_option(s, i);
    if (n > room) {
        ceduo_plot_say(s->canvas, s->left, s->y, s->width, CEDUO_ROLE_AXIS,
                       ngettext("%zu more option has no room here", "%zu more options have no room here", n - room), n - room);
        s->y++;
    }
}

static void draw_input(struct sure *s, size_t g)
{
    const struct ceduo_doubt_figure *f = main_of(s, s->option);
    double share = ceduo_doubt_share(f, g);
    struct text name = {0}, left = {0};
    ceduo_doubt_input_name(&name, s->report, g);
    ceduo_plot_say(s->canvas, s->left, s->y, s->name, CEDUO_ROLE_TEXT, "%s", ceduo_text_string(&name));
    ceduo_text_free(&name);
    ceduo_canvas_bar(s->canvas, s->left + s->name + 1, s->y, s->bars, share, CEDUO_ROLE_MEAN);
    ceduo_text_format(&left, "%.0f %%", share * 100);
    ceduo_text_then(&left, "  ", _("leaves %.3g"), f->fit.left[g] * s->scale);
    ceduo_plot_put_right(s->canvas, s->left + s->width - 1, s->y, s->values, CEDUO_ROLE_TEXT, &left);
    s->y++;
}

static void draw_inputs(struct sure *s)
{
    const struct ceduo_doubt_figure *f = main_of(s, s->option);
    if (s->y + 1 >= s->end)
        return;
    ceduo_plot_say(s->canvas, s->left, s->y, s->width - s->values - 1, CEDUO_ROLE_AXIS, _("%s depends on"),
                   s->report->file->scene.options[s->option].name);
    ceduo_plot_say_right(s->canvas, s->left + s->width - 1, s->y, s->values, CEDUO_ROLE_AXIS, _("of %.3g wide"),
                         (f->fit.p95 - f->fit.p5) * s->scale);
    s->y++;
    for (size_t i = 0; f->fit.enough && i < f->uses && s->y < s->end; i++)
        if (f->fit.total[f->order[i]].value >= SHOWN_LEAST)
            draw_input(s, f->order[i]);
}

const char *ceduo_plot_doubt(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_doubt_report *r = picture->doubt;
    if (!r)
        return _("not computed yet");
    if (!r->answer)
        return ceduo_doubt_is_off(r) ? _("not computed: the scene says 'doubt: none'")
                                     : _("nothing is marked as assumed or named by 'doubt'");
    if (area->width < WIDTH_LEAST || area->height < HEIGHT_LEAST)
        return _("too narrow");
    int values = area->width < FEW ? VALUES_LEAST : VALUES, rest = area->width - values;
    int name = rest * 3 / 5 < NAME_MOST ? rest * 3 / 5 : NAME_MOST;
    struct sure s = {.canvas = canvas,
                     .report = r,
                     .option = picture->option,
                     .left = area->left,
                     .width = area->width,
                     .name = name,
                     .values = values,
                     .bars = rest - name - 2,
                     .y = area->top,
                     .end = area->top + area->height,
                     .scale = r->answer->main == CEDUO_DOUBT_ENERGY ? J_TO_KJ : 1000};
    for (size_t i = 0; i < r->file->scene.options_count; i++)
        s.most = fmax(s.most, fmax(main_of(&s, i)->fit.p95, ceduo_doubt_now_of(r, i).hi) * s.scale);
    s.most = s.most > 0 ? s.scale > 1 ? 1000 : ceduo_plot_round(s.most, true) : 1;
    draw_options(&s);
    draw_inputs(&s);
    return NULL;
}
