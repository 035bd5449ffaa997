/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "plot_parts.h"

/* ---- the scale ---- */

#define RARE       0.2  /* share of the passed dots that so few trajectories pass that they are left out */
#define LEAST_USED 0.45 /* share of the area that the slope should take at true scale */

struct range {
    double x_lo, x_hi, y_lo, y_hi;
};

static void widen(struct range *r, double z)
{
    r->y_lo = fmin(r->y_lo, z);
    r->y_hi = fmax(r->y_hi, z);
}

static void widen_by_line(struct range *r, const struct ceduo_polyline *t)
{
    for (size_t i = 0; i < t->n; i++)
        if (t->x[i] >= r->x_lo && t->x[i] <= r->x_hi)
            widen(r, t->z[i]);
}

static bool is_stretch(const struct ceduo_picture *p)
{
    return p->to > p->from;
}

/* All that is to be seen: ground, release, trajectories, stems; of a stretch stems may reach beyond the top. */
static struct range range_of(const struct ceduo_picture *p)
{
    const struct ceduo_slope *slope = &p->scene->slope;
    struct range r = {.y_lo = INFINITY, .y_hi = -INFINITY};
    ceduo_plot_stretch(p, &r.x_lo, &r.x_hi);
    widen(&r, ceduo_slope_height(slope, r.x_lo));
    widen(&r, ceduo_slope_height(slope, r.x_hi));
    for (size_t i = 0; i < slope->vertices; i++)
        if (slope->x[i] > r.x_lo && slope->x[i] < r.x_hi)
            widen(&r, slope->z[i]);
    double x = p->scene->release.x.mean;
    if (x >= r.x_lo && x <= r.x_hi)
        widen(&r, ceduo_slope_height(slope, x) + p->scene->release.height.mean);
    const struct ceduo_run_snapshot *sight = ceduo_plot_sight(p);
    for (size_t i = 0; sight && i < sight->trajectories_count; i++)
        widen_by_line(&r, &sight->trajectories[i]);
    if (p->selected)
        widen_by_line(&r, p->selected);
    const struct ceduo_option *option = ceduo_plot_option(p);
    for (size_t i = 0; option && !is_stretch(p) && i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        double from = fmax(belt->from, r.x_lo), to = fmin(belt->to, r.x_hi), tallest = ceduo_plot_tallest(&belt->stand);
        if (!(to > from))
            continue;
        widen(&r, ceduo_slope_height(slope, from) + tallest);
        widen(&r, ceduo_slope_height(slope, to) + tallest);
        for (size_t k = 0; k < slope->vertices; k++)
            if (slope->x[k] > from && slope->x[k] < to)
                widen(&r, slope->z[k] + tallest);
    }
    return r;
}

/* Sets the frame's ranges with heights drawn `factor` times as long as lengths. */
static bool fit(struct ceduo_frame *f, const struct ceduo_canvas *canvas, const struct range *r, double factor)
{
    if (!ceduo_frame_true_scale(f, canvas, r->x_lo, r->x_hi, factor * r->y_lo, factor * r->y_hi))
        return false;
    f->y0 /= factor;
    f->y1 /= factor;
    return true;
}

/* 1 where true scale makes use of the area, otherwise a round factor with which the slope does. */
static double height_factor(const struct ceduo_frame *frame, const struct ceduo_canvas *canvas, const struct range *r)
{
    static const double round[] = {0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10};
    const int one = 9, n = sizeof round / sizeof round[0];
    struct ceduo_frame f = *frame;
    if (!fit(&f, canvas, r, 1))
        return 1;
    double across = (r->x_hi - r->x_lo) / (f.x1 - f.x0), up = (r->y_hi - r->y_lo) / (f.y1 - f.y0);
    int i = one;
    if (up < LEAST_USED)
        while (i + 1 < n && round[i + 1] * up <= 1)
            i++;
    else if (across < LEAST_USED)
        while (i > 0 && across / round[i] < LEAST_USED)
            i--;
    return round[i];
}

/* Fits the ranges, the ground at the bottom, the slope's start at the left; gives up columns without slope. A stretch is
 * always true to scale. Returns the factor of heights, NaN where nothing can be drawn. */
static double scale(struct ceduo_frame *f, const struct ceduo_canvas *canvas, const struct range *r, bool stretch)
{
    double factor = stretch ? 1 : height_factor(f, canvas, r);
    if (!fit(f, canvas, r, factor))
        return NAN;
    int needed = (int)ceil(f->width * (r->x_hi - r->x_lo) / (f->x1 - f->x0));
    if (needed < f->width && needed >= 2) {
        f->width = needed;
        fit(f, canvas, r, factor);
    }
    f->x1 = r->x_lo + (f->x1 - f->x0);
    f->x0 = r->x_lo;
    f->y1 = r->y_lo + (f->y1 - f->y0);
    f->y0 = r->y_lo;
    return factor;
}

/* ---- what stands on the slope ---- */

struct profile {
    struct ceduo_canvas *canvas;
    const struct ceduo_area *area;
    const struct ceduo_picture *picture;
    struct ceduo_frame frame;
    double factor;
    bool names, belts; /* rows for them */
};

/* A row of stems at their mean distance in the stand, but no closer than can be told apart. */
static void draw_stems(const struct profile *p, const struct ceduo_belt *belt, const struct ceduo_stems *stems,
                       enum ceduo_role role)
{
    const struct ceduo_slope *slope = &p->picture->scene->slope;
    double dot = (p->frame.x1 - p->frame.x0) / (p->frame.width * p->canvas->dots_x - 1);
    double step = fmax(sqrt(1e4 / stems->per_ha), 4 * dot);
    double from = fmax(belt->from, p->frame.x0), to = fmin(belt->to, fmin(p->frame.x1, slope->x[slope->vertices - 1]));
    double first = ceil((from - belt->from) / step - 0.5);
    for (double i = fmax(first, 0); belt->from + (i + 0.5) * step < to; i++) {
        double x = belt->from + (i + 0.5) * step, z = ceduo_slope_height(slope, x);
        ceduo_canvas_line(p->canvas, &p->frame, role, x, z, x, z + stems->height);
    }
}

/* The stems that the selected rock came to, where they stand, or those of the belts. */
static void draw_forest(const struct profile *p)
{
    const struct ceduo_slope *slope = &p->picture->scene->slope;
    const struct ceduo_option *option = ceduo_plot_option(p->picture);
    for (size_t i = 0; i < p->picture->stems_count; i++) {
        const struct ceduo_stem_passed *stem = &p->picture->stems[i];
        double height = stem->height;
        if (!(stem->x >= slope->x[0] && stem->x <= slope->x[slope->vertices - 1]))
            continue;
        for (size_t k = 0; option && k < option->belts_count && !isfinite(height);
             k++) /* those of the model poisson have none */
            if (stem->x >= option->belts[k].from && stem->x <= option->belts[k].to)
                height = ceduo_plot_tallest(&option->belts[k].stand);
        double z = ceduo_slope_height(slope, stem->x);
        ceduo_canvas_line(p->canvas, &p->frame, stem->hit ? CEDUO_ROLE_STEM : CEDUO_ROLE_DIM, stem->x, z, stem->x,
                          z + (isfinite(height) ? height : 0));
    }
    for (size_t i = 0; p->picture->stems_count == 0 && option && i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        for (size_t k = 0; k < belt->stand.shoots_count; k++)
            draw_stems(p, belt, &belt->stand.shoots[k], CEDUO_ROLE_STOOL);
        for (size_t k = 0; k < belt->stand.trees_count; k++)
            draw_stems(p, belt, &belt->stand.trees[k], CEDUO_ROLE_STEM);
    }
}

/* ---- names ---- */

static int area_end(const struct ceduo_area *area)
{
    return area->left + area->width;
}

/* Cells from..to and one on either side are blank. */
static bool is_free(const struct profile *p, int row, int from, int to)
{
    for (int column = from - 1; column <= to; column++)
        if (!ceduo_canvas_is_blank(p->canvas, column, row))
            return false;
    return from >= p->area->left && to <= area_end(p->area);
}

#define NAME_ROWS 4

/* Beside its rule, to the right or the left, in the highest row that has room; nowhere where none has. */
static void name_control(const struct profile *p, const struct ceduo_control *control)
{
    int column, row;
    if (!ceduo_frame_cell(&p->frame, p->canvas, control->x, p->frame.y0, &column, &row))
        return;
    LOCAL_TEXT(name);
    ceduo_plot_control_name(&name, control);
    const char *bytes = ceduo_text_string(&name);
    int width = ceduo_canvas_label_width(p->canvas, bytes);
    for (int i = 0; i < NAME_ROWS && i < p->area->height; i++) {
        int to_right = column + 2, to_left = column - 1 - width, y = p->area->top + i;
        int start = is_free(p, y, to_right, to_right + width) ? to_right : to_left;
        if (!is_free(p, y, start, start + width))
            continue;
        ceduo_canvas_label(p->canvas, start, y, CEDUO_ROLE_CONTROL, bytes);
        if (i == 0 && ceduo_canvas_is_blank(p->canvas, column, y)) /* another word may stand there */
            ceduo_canvas_label(p->canvas, column, y, CEDUO_ROLE_CONTROL, "\xe2\x96\xbc");
        break;
    }
}

#define FOREST_LEAST 12 /* columns that make its name worth while */

/* Writes whose forest the trajectories go through at the right end of the highest row that has most room. */
static void name_forest(const struct profile *p)
{
    const struct ceduo_option *option = ceduo_plot_option(p->picture);
    if (!ceduo_plot_wooded(p->picture) || !ceduo_plot_sight(p->picture) || !option || !option->name)
        return;
    LOCAL_TEXT(name);
    ceduo_text_format(&name, _("ways: %s"), option->name);
    const char *bytes = ceduo_text_string(&name);
    int width = ceduo_canvas_label_width(p->canvas, bytes), most = 0, row = 0;
    for (int i = 0; i < NAME_ROWS && i < p->area->height; i++) {
        int column = area_end(p->area); /* where the blank columns at the right end begin, but for one */
        while (column > p->area->left && ceduo_canvas_is_blank(p->canvas, column - 1, p->area->top + i))
            column--;
        int room = area_end(p->area) - column - 1;
        room = room < width ? room : width;
        row = room > most ? i : row;
        most = room > most ? room : most;
    }
    if (most == width || most >= FOREST_LEAST)
        ceduo_plot_say_right(p->canvas, area_end(p->area) - 1, p->area->top + row, most, CEDUO_ROLE_CLOUD, "%s", bytes);
}

/* ├── ADS 1 ──┤ below the axis. */
static void draw_belts(const struct profile *p)
{
    const struct ceduo_option *option = ceduo_plot_option(p->picture);
    const struct ceduo_frame *f = &p->frame;
    double per_metre = f->width / (f->x1 - f->x0);
    int row = p->area->top + p->area->height - 1;
    if (option && option->belts_count == 0)
        ceduo_canvas_put(p->canvas, f->left, row, area_end(p->area) - f->left, CEDUO_ROLE_BELT, _("no forest"));
    for (size_t i = 0; option && i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        int from = f->left + (int)lround((fmax(belt->from, f->x0) - f->x0) * per_metre);
        int to = f->left + (int)lround((fmin(belt->to, f->x1) - f->x0) * per_metre);
        LOCAL_TEXT(name);
        if (to <= from)
            continue;
        for (int column = from; column < to; column++)
            ceduo_canvas_label(p->canvas, column, row, CEDUO_ROLE_BELT,
                               to - from == 1     ? "\xe2\x94\x82"
                               : column == from   ? "\xe2\x94\x9c"
                               : column == to - 1 ? "\xe2\x94\xa4"
                                                  : "\xe2\x94\x80");
        ceduo_text_char(&name, ' ');
        ceduo_plot_belt_name(&name, belt);
        ceduo_text_char(&name, ' ');
        int width = ceduo_canvas_label_width(p->canvas, ceduo_text_string(&name)), room = to - from - 2;
        int start = width < room ? from + 1 + (room - width) / 2 : from + 1;
        ceduo_canvas_put(p->canvas, start, row, room, CEDUO_ROLE_BELT, ceduo_text_string(&name));
    }
}

/* ---- the words beside it ---- */

#define SIDE_LEAST 24 /* columns that make a paragraph worth while */

struct notes {
    struct ceduo_canvas *canvas;
    const struct ceduo_picture *picture;
    int left, width, row, end;
    int in; /* blanks before a line under a heading */
};

__attribute__((format(printf, 3, 4))) static void note(struct notes *n, enum ceduo_role role, const char *format, ...)
{
    struct text line = {0};
    va_list args;
    bool room = n->row < n->end;
    va_start(args, format);
    ceduo_text_format(&line, "%*s", n->in, "");
    ceduo_text_vformat(&line, format, args);
    va_end(args);
    ceduo_plot_put_fitting(n->canvas, n->left, n->row, room ? n->width : 0, role, 1, &line);
    n->row += room;
}

static void note_ways(struct notes *n)
{
    const struct ceduo_picture *p = n->picture;
    const struct ceduo_run_snapshot *s = ceduo_plot_sight(p);
    const struct ceduo_option *option = ceduo_plot_option(p);
    bool wooded = ceduo_plot_wooded(p) && option && ceduo_plot_has_stems(option);
    if (!s)
        note(n, CEDUO_ROLE_DIM, _("ways not computed yet"));
    if (s && s->trajectories_count > 0) {
        note(n, CEDUO_ROLE_CLOUD, wooded ? _("%zu ways of %llu through") : _("%zu ways of %llu"), s->trajectories_count,
             (unsigned long long)s->flown.rocks);
        n->in = wooded;
        note(n, CEDUO_ROLE_CLOUD, "%s", !wooded ? _("without forest") : option->name ? option->name : _("the forest"));
        n->in = 0;
    }
    if (p->stems_count > 0)
        note(n, CEDUO_ROLE_STEM, _("stems this rock came to"));
}

static void note_belt(struct notes *n, const struct ceduo_belt *belt)
{
    LOCAL_TEXT(name);
    ceduo_plot_belt_name(&name, belt);
    n->row += n->row + 3 < n->end;
    n->in = 0;
    note(n, CEDUO_ROLE_BELT, "%s", ceduo_text_string(&name));
    n->in = 1;
    note(n, CEDUO_ROLE_TEXT, "%s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
    double count = ceduo_stand_shoots(&belt->stand) + ceduo_stand_trees(&belt->stand);
    if (!(count > 0)) {
        note(n, CEDUO_ROLE_TEXT, "%s", _("no stems"));
        return;
    }
    note(n, CEDUO_ROLE_TEXT, _("%.*f stems/ha"), count < 10 ? 1 : 0, count);
    note(n, CEDUO_ROLE_TEXT, _("up to %g m high"), ceduo_plot_tallest(&belt->stand));
}

static void note_control(struct notes *n, size_t c)
{
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(n->picture, c);
    const struct ceduo_arrivals *bare = ceduo_plot_bare_arrivals(n->picture, c);
    const struct ceduo_control *control = &n->picture->scene->controls[c];
    bool wooded = ceduo_plot_wooded(n->picture);
    if (!a || !bare || n->row + 2 >= n->end)
        return;
    double limit = control->accepted * J_TO_KJ, reach = a->reach_probability * 1000, exceed = a->exceed_probability * 1000;
    n->row++;
    n->in = 0;
    note(n, CEDUO_ROLE_CONTROL, wooded ? _("At %s m, wood (bare)") : _("At %s m without forest"), SHORTEST(control->x_given));
    n->in = 1;
    if (wooded)
        note(n, CEDUO_ROLE_TEXT, _("%.0f (%.0f) of 1000"), reach, bare->reach_probability * 1000);
    else
        note(n, CEDUO_ROLE_TEXT, _("%.0f of 1000 arrive"), reach);
    if (!isnan(exceed) && wooded)
        note(n, CEDUO_ROLE_TEXT, _("%.0f (%.0f) > %g kJ"), exceed, bare->exceed_probability * 1000, limit);
    else if (!isnan(exceed))
        note(n, CEDUO_ROLE_TEXT, _("%.0f with > %g kJ"), exceed, limit);
}

/* What the profile is, in words: to the right of its frame where there is room, otherwise the factor alone in the top row. Returns
 * whether there was room. */
static bool put_notes(const struct profile *p)
{
    const struct ceduo_area *area = p->area;
    int end = area_end(area), left = p->frame.left + p->frame.width + 2;
    bool beside = end - left >= SIDE_LEAST, words = beside || area->width >= 30;
    LOCAL_TEXT(factor);
    if (p->factor > 1)
        ceduo_text_format(&factor, words ? _("heights drawn %g times") : "\xc3\x97%g", p->factor);
    else
        ceduo_text_format(&factor, words ? _("heights drawn at %g %%") : "%g %%", 100 * p->factor);
    if (!beside) {
        ceduo_plot_say_right(p->canvas, end - 1, area->top, p->factor == 1 ? 0 : area->width / 2, CEDUO_ROLE_WARN, " %s",
                             factor.bytes);
        return false;
    }
    struct notes n = {p->canvas, p->picture, left, end - left, area->top + 2, p->frame.top + p->frame.height, 0};
    const struct ceduo_option *option = ceduo_plot_option(p->picture);
    if (p->factor == 1)
        note(&n, CEDUO_ROLE_DIM, "%s", _("true to scale"));
    else
        note(&n, CEDUO_ROLE_WARN, "%s", factor.bytes);
    note_ways(&n);
    for (size_t c = 0; c < p->picture->scene->controls_count; c++)
        note_control(&n, c);
    for (size_t i = 0; option && i < option->belts_count; i++)
        note_belt(&n, &option->belts[i]);
    return true;
}

/* ---- the picture ---- */

static void place_frame(struct profile *p)
{
    const struct ceduo_area *a = p->area;
    const struct ceduo_slope *slope = &p->picture->scene->slope;
    struct range r = range_of(p->picture);
    int axis = 0, needed = 1;
    while (axis < needed) { /* the axis takes columns, and they decide its labels */
        axis = needed;
        p->frame = (struct ceduo_frame){.left = a->left + axis,
                                        .top = a->top + p->names,
                                        .width = a->width - axis,
                                        .height = a->height - p->names - p->belts - 2};
        p->factor = scale(&p->frame, p->canvas, &r, is_stretch(p->picture));
        if (isnan(p->factor))
            return;
        struct ceduo_frame given = ceduo_plot_given(&p->frame, slope->origin_x, slope->origin_z);
        needed = ceduo_frame_axis_width(&given, p->canvas);
    }
}

const char *ceduo_plot_profile(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    struct profile p = {
        .canvas = canvas, .area = area, .picture = picture, .names = area->height >= 8, .belts = area->height >= 6};
    const struct ceduo_slope *slope = &picture->scene->slope;
    place_frame(&p);
    if (picture->span)
        *picture->span = (struct ceduo_span){p.frame.left, p.frame.width, p.frame.x0, p.frame.x1};
    if (isnan(p.factor))
        return _("too narrow");
    draw_forest(&p);
    const struct ceduo_run_snapshot *sight = ceduo_plot_sight(picture);
    const struct ceduo_polyline *way = picture->selected;
    if (sight) {
        ceduo_canvas_cloud_start(canvas);
        for (size_t i = 0; i < sight->trajectories_count; i++)
            ceduo_canvas_cloud_add(canvas, &p.frame, sight->trajectories[i].n, sight->trajectories[i].x,
                                   sight->trajectories[i].z);
        ceduo_canvas_cloud_show(canvas, RARE);
    }
    if (way)
        ceduo_canvas_polyline(canvas, &p.frame, CEDUO_ROLE_WAY, way->n, way->x, way->z);
    ceduo_canvas_polyline(canvas, &p.frame, CEDUO_ROLE_GROUND, slope->vertices, slope->x, slope->z);
    const struct ceduo_release *release = &picture->scene->release;
    double z = ceduo_slope_height(slope, release->x.mean) + release->height.mean;
    int column, row;
    if (ceduo_frame_cell(&p.frame, canvas, release->x.mean, z, &column, &row) && row - 1 >= area->top)
        ceduo_canvas_put(canvas, column, row - 1, area_end(area) - column, CEDUO_ROLE_TEXT, _("\xe2\x96\xbc release"));
    if (picture->mark)
        ceduo_canvas_rule_x(canvas, &p.frame, CEDUO_ROLE_TITLE, *picture->mark);
    bool noted = put_notes(&p);
    for (size_t c = 0; p.names && c < picture->scene->controls_count; c++)
        name_control(&p, &picture->scene->controls[c]);
    for (size_t c = 0; c < picture->scene->controls_count; c++)
        ceduo_canvas_rule_x(canvas, &p.frame, CEDUO_ROLE_CONTROL, picture->scene->controls[c].x);
    if (p.names && !noted)
        name_forest(&p);
    ceduo_plot_axes(canvas, &p.frame, slope->origin_x, slope->origin_z, _("m"));
    if (p.belts)
        draw_belts(&p);
    return NULL;
}
