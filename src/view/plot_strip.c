/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_statistics_double.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/oom.h"
#include "plot.h"

/* Strips along the slope: curves of height or energy of the passing rocks. */

#define CURVES_MAX 4

/* Curve; each pair is for heights and energies. */
struct curve {
    const char *names[2]; /* NULL: none */
    enum ceduo_role role;
    enum ceduo_stroke stroke;
    bool bare;         /* without forest */
    size_t offsets[2]; /* offsets of the value in an envelope */
};

struct content {
    const char *captions[2];
    struct curve curves[CURVES_MAX];
};

struct strip {
    struct ceduo_drawing *d;
    bool energy;
    double from, to; /* part of the slope */
    size_t n;        /* cells along the slope, … */
    const double *x; /* … and their positions, m */
    int count;
    const struct curve *curves[CURVES_MAX];
    double *y[CURVES_MAX + 2]; /* per curve, then the ends of the band, m or kJ; NaN: no rock passes */
    bool has_band;
    double peak, peak_x;   /* largest value, its position … */
    const char *peak_name; /* … and its curve */
};

#define OFFSETS(heights, energies) offsetof(struct ceduo_envelope, heights), offsetof(struct ceduo_envelope, energies)

/* Curves without forest only; both; both in a small area; both on paper. Curves with forest are strokes, those without are dots, so that
 * they differ without colour. */
static const struct content contents[4] = {
    {{N_("underside above the ground, m"), N_("energy, kJ")},
     {{{N_("max"), N_("p50")}, CEDUO_ROLE_BARE, CEDUO_STROKE_FEW, false, {OFFSETS(height.max, energy.p50)}},
      {{N_("p95"), N_("p95")}, CEDUO_ROLE_ENVELOPE, CEDUO_STROKE_DOTS, false, {OFFSETS(height.p95, energy.p95)}},
      {{N_("p50"), N_("mean")}, CEDUO_ROLE_MEAN, CEDUO_STROKE_PLAIN, false, {OFFSETS(height.p50, mean_energy)}},
      {{NULL, N_("p5")}, CEDUO_ROLE_ENVELOPE, CEDUO_STROKE_DOTS, false, {OFFSETS(height.p50, energy.p5)}}}},
    {{N_("underside, m up"), N_("energy, kJ")},
     {{{N_("without p95"), N_("without p95")}, CEDUO_ROLE_BARE, CEDUO_STROKE_FEW, true, {OFFSETS(height.p95, energy.p95)}},
      {{N_("forest p95"), N_("forest p95")}, CEDUO_ROLE_FOREST, CEDUO_STROKE_DASHES, false, {OFFSETS(height.p95, energy.p95)}},
      {{N_("without p50"), N_("without mean")}, CEDUO_ROLE_BARE, CEDUO_STROKE_DOTS, true, {OFFSETS(height.p50, mean_energy)}},
      {{N_("forest p50"), N_("forest mean")},
       CEDUO_ROLE_FOREST,
       CEDUO_STROKE_PLAIN,
       false,
       {OFFSETS(height.p50, mean_energy)}}}},
    {{N_("underside p95, m"), N_("mean energy, kJ")},
     {{{N_("without"), N_("without")}, CEDUO_ROLE_BARE, CEDUO_STROKE_DOTS, true, {OFFSETS(height.p95, mean_energy)}},
      {{N_("forest"), N_("forest")}, CEDUO_ROLE_FOREST, CEDUO_STROKE_PLAIN, false, {OFFSETS(height.p95, mean_energy)}}}},
    {{N_("95 % fly below, m"), N_("mean energy, kJ")},
     {{{N_("without"), N_("without")}, CEDUO_ROLE_BARE, CEDUO_STROKE_DOTS, true, {OFFSETS(height.p95, mean_energy)}},
      {{N_("forest"), N_("forest")}, CEDUO_ROLE_FOREST, CEDUO_STROKE_PLAIN, false, {OFFSETS(height.p95, mean_energy)}}}}};

/* Lower and upper end of the band with forest. */
static const struct curve band[2] = {{{"", ""}, CEDUO_ROLE_DIM, CEDUO_STROKE_RULE, false, {OFFSETS(height.p50, mean_energy)}},
                                     {{"", ""}, CEDUO_ROLE_DIM, CEDUO_STROKE_RULE, false, {OFFSETS(height.p95, energy.p95)}}};

/* Return the columns for names of curves, with a blank on either side. */
static int name_columns(const struct ceduo_canvas *canvas, const struct content *content, bool energy)
{
    int widest = 4;
    for (int i = 0; i < CURVES_MAX; i++) {
        const char *name = content->curves[i].names[energy];
        int width = name ? ceduo_canvas_label_width(canvas, _(name)) : 0;
        widest = width > widest ? width : widest;
    }
    return widest + 2;
}

/* ---- curves ---- */

static bool is_in_part(const struct strip *s, size_t cell)
{
    return s->x[cell] >= s->from && s->x[cell] <= s->to;
}

/* Read a curve to s->y[to]; return the 85th percentile of its cells, NaN if no rock passes. */
static double read_curve(struct strip *s, const struct curve *curve, int to)
{
    const struct ceduo_envelope *cells = (curve->bare ? s->d->bare : s->d->run)->envelopes;
    double *y = s->y[to] = ceduo_check_memory(malloc((s->n + 1) * sizeof *y)), usual = NAN;
    double *values = ceduo_check_memory(malloc((s->n + 1) * sizeof *values));
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        double value = *(const double *)(const void *)((const char *)&cells[i] + curve->offsets[s->energy]);
        y[i] = cells[i].passed > 0 ? value * (s->energy ? J_TO_KJ : 1) : NAN;
        if (isnan(y[i]) || !is_in_part(s, i))
            continue;
        if (y[i] > s->peak && to < CURVES_MAX) {
            s->peak = y[i];
            s->peak_x = s->x[i];
            s->peak_name = curve->names[s->energy];
        }
        values[n++] = y[i];
    }
    if (n > 0)
        usual = gsl_stats_select(values, 1, n, (n - 1) * 85 / 100);
    free(values);
    return usual;
}

/* Read all curves; return the largest 85th percentile, NaN if no rock passes. */
static double read_curves(struct strip *s, const struct content *content)
{
    double usual = NAN;
    for (int i = 0; i < CURVES_MAX; i++)
        if (content->curves[i].names[s->energy]) {
            s->curves[s->count] = &content->curves[i];
            usual = fmax(usual, read_curve(s, &content->curves[i], s->count));
            s->count++;
        }
    for (int end = 0; s->has_band && end < 2; end++)
        usual = fmax(usual, read_curve(s, &band[end], CURVES_MAX + end));
    return usual;
}

static void free_curves(struct strip *s)
{
    for (int i = 0; i < CURVES_MAX + 2; i++)
        free(s->y[i]);
}

/* Read the curves of the compared option; return the largest 85th percentile, and write the largest value. */
static double read_compared(const struct strip *s, const struct content *content, double *peak)
{
    const size_t *compared = s->d->picture->compared;
    struct ceduo_drawing drawing = *s->d;
    struct strip strip = *s;
    strip.d = &drawing;
    drawing.run = compared ? ceduo_snapshot_find(s->d->picture->snapshot, s->d->scene, *compared) : NULL;
    double usual = drawing.run ? read_curves(&strip, content) : NAN;
    *peak = strip.peak;
    free_curves(&strip);
    return usual;
}

/* Read all curves and set the scale: to the 85th percentile, so that single peaks do not flatten the curves. False if no
 * rock passes. */
static bool set_strip_scale(struct strip *s, const struct content *content)
{
    double peak, usual = read_compared(s, content, &peak);
    usual = fmax(usual, read_curves(s, content));
    peak = fmax(peak, s->peak);
    bool cut = peak > 1.5 * 1.15 * usual && usual > 0;
    double top = cut ? 1.15 * usual : 1.05 * (s->has_band ? fmax(peak, usual) : peak);
    double max_accepted = s->energy ? 2 * top : 0; /* include accepted energies up to twice the top */
    for (size_t c = 0; c < s->d->scene->controls_count; c++) {
        double accepted = s->d->scene->controls[c].accepted * J_TO_KJ;
        top = accepted <= max_accepted ? fmax(top, 1.1 * accepted) : top;
    }
    s->d->frame.y1 = top > 0 ? top : 1;
    return !isnan(usual);
}

/* Draw trajectories as heights above the ground. */
static void draw_trajectories(const struct ceduo_drawing *d)
{
    ceduo_canvas_cloud_start(d->canvas);
    for (size_t i = 0; i < d->run->trajectories_count; i++) {
        const struct ceduo_polyline *t = &d->run->trajectories[i];
        double *heights = ceduo_check_memory(malloc((t->n + 1) * sizeof *heights));
        for (size_t k = 0; k < t->n; k++)
            heights[k] = fmax(t->z[k] - ceduo_slope_height(&d->scene->slope, t->x[k]), 0);
        ceduo_canvas_polyline(d->canvas, &d->frame, CEDUO_ROLE_CLOUD, CEDUO_STROKE_TRAJECTORY, t->n, t->x, heights);
        free(heights);
    }
    ceduo_canvas_cloud_show(d->canvas, 0);
}

/* Shade the band with a dotted line in each column. */
static void draw_band(const struct strip *s)
{
    const double *lo = s->y[CURVES_MAX], *hi = s->y[CURVES_MAX + 1];
    int last = -1, column, row;
    for (size_t i = 0; i < s->n; i++) {
        const double x[2] = {s->x[i], s->x[i]}, y[2] = {lo[i], fmin(hi[i], s->d->frame.y1)};
        if (!is_in_part(s, i) || isnan(lo[i]) ||
            !ceduo_frame_cell(&s->d->frame, s->d->canvas, x[0], s->d->frame.y0, &column, &row))
            continue;
        if (column != last)
            ceduo_canvas_polyline(s->d->canvas, &s->d->frame, CEDUO_ROLE_DIM, CEDUO_STROKE_RULE, 2, x, y);
        last = column;
    }
}

/* Return the last value of a curve, clipped at the top; NaN if no rock passes or it is below the frame. */
static double find_curve_end(const struct strip *s, int curve)
{
    int column, row;
    size_t i = s->n;
    while (i > 0 && (!is_in_part(s, i - 1) || isnan(s->y[curve][i - 1])))
        i--;
    double y = i > 0 ? fmin(s->y[curve][i - 1], s->d->frame.y1) : NAN;
    return i > 0 && ceduo_frame_cell(&s->d->frame, s->d->canvas, s->x[i - 1], y, &column, &row) ? y : NAN;
}

/* Write the name of each curve to the right of its end, the highest first, each in its own row. */
static void label_curves(const struct strip *s)
{
    const struct ceduo_frame *f = &s->d->frame;
    double ends[CURVES_MAX];
    int left = f->left + f->width + 1, space = s->d->area.left + s->d->area.width - left, n = 0;
    if (space < 4 || f->height < s->count)
        return;
    for (int i = 0; i < s->count; i++)
        n += !isnan(ends[i] = find_curve_end(s, i));
    for (int next = f->top; n > 0; n--, next++) {
        int best = 0, lowest = f->top + f->height - n, column, row;
        for (int i = 1; i < s->count; i++)
            best = isnan(ends[best]) || ends[i] > ends[best] ? i : best;
        ceduo_frame_cell(f, s->d->canvas, f->x0, ends[best], &column, &row);
        next = row < next ? next : row > lowest ? lowest : row;
        ceduo_canvas_draw_text(s->d->canvas, left, next, space, s->curves[best]->role, _(s->curves[best]->names[s->energy]));
        ends[best] = NAN;
    }
}

/* ---- strip ---- */

static void set_strip_frame(struct strip *s, const struct content *content)
{
    struct ceduo_frame *f = &s->d->frame;
    const struct ceduo_area *a = &s->d->area;
    const struct ceduo_span *span = s->d->picture->span;
    bool axis = !s->d->picture->no_x_axis;
    int caption = a->height - 2 * axis >= 4;
    f->top = a->top + caption;
    f->height = a->height - caption - 2 * axis;
    int labels = ceduo_frame_axis_width(f, s->d->canvas),
        names = a->width >= 40 ? name_columns(s->d->canvas, content, s->energy) : 0;
    f->left = span ? span->left : a->left + labels;
    f->width = span ? span->width : a->width - labels - names;
    f->x0 = s->from;
    f->x1 = s->to;
}

/* Draw the caption, the legend of strokes, and the peak if it is clipped. */
static void draw_caption(const struct strip *s, const struct content *content)
{
    static const struct {
        enum ceduo_role role;
        const char *text;
    } parts[] = {{CEDUO_ROLE_FOREST, N_("\xe2\x94\x80\xe2\x94\x80 forest")}, {CEDUO_ROLE_BARE, N_("\xc2\xb7\xc2\xb7 without")}};
    struct ceduo_canvas *canvas = s->d->canvas;
    int row = s->d->area.top, column = s->d->frame.left, end = s->d->area.left + s->d->area.width;
    if (s->d->frame.top == row)
        return;
    column += ceduo_canvas_draw_text(canvas, column, row, end - column, CEDUO_ROLE_AXIS, _(content->captions[s->energy]));
    for (int i = 0; i < 2 && s->d->wooded; i++) {
        column += ceduo_canvas_draw_text(canvas, column, row, end - column, parts[i].role, "  ");
        column += ceduo_canvas_draw_text(canvas, column, row, end - column, parts[i].role, _(parts[i].text));
    }
    if (s->d->picture->bands && !s->d->wooded && column < end)
        column += ceduo_plot_print(canvas, column, row, end - column, CEDUO_ROLE_BARE, "  %s", _("without forest"));
    if (s->has_band && column < end)
        column += ceduo_canvas_draw_text(canvas, column, row, end - column, CEDUO_ROLE_DIM,
                                         s->energy ? _("  \xe2\x96\x92 mean to p95") : _("  \xe2\x96\x92 p50 to p95"));
    if (!(s->peak > s->d->frame.y1) || column >= end)
        return;
    LOCAL_TEXT(words);
    ceduo_text_append_joined(&words, "; ", _("%s up to %s %s, at %s m"), _(s->peak_name), SIG(s->peak, 3),
                             s->energy ? _("kJ") : _("m"), SIG(s->peak_x + s->d->scene->slope.origin_x, 3));
    if (!s->d->picture->paper || ceduo_canvas_label_width(canvas, words.bytes) <= end - column)
        ceduo_canvas_draw_text(canvas, column, row, end - column, CEDUO_ROLE_WARN, words.bytes);
}

#define LIMIT_COLUMNS 16 /* max columns of the limit */
#define FULL_ROWS     8  /* min rows for four curves */
#define FULL_WIDTH    56 /* min columns, next to the names */

static const char *draw_strip(struct ceduo_drawing *d, bool energy)
{
    const struct ceduo_span *span = d->picture->span;
    const struct ceduo_snapshot *snapshot = d->picture->snapshot;
    struct strip s = {.d = d, .energy = energy, .from = span ? span->x0 : d->from, .to = span ? span->x1 : d->to};
    int names = span ? d->area.left + d->area.width - span->left - span->width : INT_MAX;
    bool small = d->area.height - 1 - 2 * !d->picture->no_x_axis < FULL_ROWS || d->area.width < FULL_WIDTH ||
                 names < name_columns(d->canvas, &contents[1], energy) - 1;
    const struct content *content = &contents[!d->wooded ? 0 : d->picture->paper ? 3 : small ? 2 : 1];
    const char *reason = NULL;
    if (!d->run || !d->bare)
        return _("not computed yet");
    s.has_band = d->picture->bands && d->wooded;
    s.n = snapshot->cells;
    s.x = snapshot->cell_x;
    if (!set_strip_scale(&s, content))
        reason = _("no rock passes here");
    set_strip_frame(&s, content);
    if (!reason && (d->frame.width < 2 || d->frame.height < 1 || !(d->frame.x1 > d->frame.x0)))
        reason = _("too narrow");
    if (!reason) {
        draw_caption(&s, content);
        if (d->picture->trajectories && !energy)
            draw_trajectories(d);
        if (s.has_band)
            draw_band(&s);
        for (int i = 0; i < s.count; i++)
            ceduo_canvas_polyline(d->canvas, &d->frame, s.curves[i]->role, s.curves[i]->stroke, s.n, s.x, s.y[i]);
        for (size_t c = 0; c < d->scene->controls_count; c++) { /* rule with a mark at the accepted energy */
            double x = d->scene->controls[c].x, accepted = d->scene->controls[c].accepted * J_TO_KJ;
            double reach = 0.03 * (d->frame.x1 - d->frame.x0);
            ceduo_canvas_rule_x(d->canvas, &d->frame, CEDUO_ROLE_CONTROL, x);
            if (energy)
                ceduo_canvas_line(d->canvas, &d->frame, CEDUO_ROLE_BAD, x - reach, accepted, x + reach, accepted);
            int column, row;
            if (energy && d->picture->paper && ceduo_frame_cell(&d->frame, d->canvas, x - reach, accepted, &column, &row))
                ceduo_plot_print(d->canvas, column - 1, row, -LIMIT_COLUMNS, CEDUO_ROLE_BAD, _("limit %s kJ%s"),
                                 LOCALIZED(ceduo_words_accepted(&d->scene->controls[c])), "");
        }
        label_curves(&s);
        ceduo_plot_axes(d, d->scene->slope.origin_x, 0, d->picture->no_x_axis ? NULL : _("m"));
    }
    free_curves(&s);
    return reason;
}

const char *ceduo_plot_height(struct ceduo_drawing *d)
{
    return draw_strip(d, false);
}

const char *ceduo_plot_energy(struct ceduo_drawing *d)
{
    return draw_strip(d, true);
}
