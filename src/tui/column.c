/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The column that stands still in every view: what passes, whether it protects, how sure that is. */
#include "screen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/intl.h"

struct pen {
    struct app *app;
    struct ceduo_area area;
    int y;
};

__attribute__((format(printf, 3, 4))) static void line(struct pen *pen, enum ceduo_role role, const char *format, ...)
{
    struct text text = {0}, safe = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    ceduo_text_safe(&safe, ceduo_text_string(&text));
    if (pen->y < pen->area.top + pen->area.height && safe.bytes)
        ceduo_canvas_put(&pen->app->cells->canvas, pen->area.left, pen->y, pen->area.width, role, safe.bytes);
    pen->y++;
    ceduo_text_free(&text);
    ceduo_text_free(&safe);
}

static void put_scene(struct pen *pen)
{
    const struct ceduo_scene *s = &pen->app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(pen->app);
    struct ceduo_rock rock = ceduo_rock_mean(&s->rock);
    if (!isnan(rock.mass))
        line(pen, CEDUO_ROLE_TEXT, _("Rock  %.3g m  %.4g kg%s"), rock.mean_diameter, rock.mass,
             ceduo_notes_assume(pen->app->document.file.notes, "rock") ? "*" : "");
    line(pen, CEDUO_ROLE_TEXT, _("Wood  %s%s"), s->options_count > 1 ? o->name : o->belts_count ? o->belts[0].name : _("none"),
         o->belts_count > 1 && s->options_count < 2 ? " \xc2\xb7 \xe2\x80\xa6" : "");
}

/* Of 1000: "832 (831-834)" where there is room, otherwise "832±2"; without an interval where lo = hi. */
static void share(char *to, size_t size, double p, double lo, double hi, bool wide)
{
    if (isnan(p))
        snprintf(to, size, "-");
    else if (wide)
        snprintf(to, size, "%.0f (%.0f-%.0f)", p * 1000, floor(lo * 1000), ceil(hi * 1000));
    else if (hi > lo)
        snprintf(to, size, "%.0f\xc2\xb1%.0f", p * 1000, ceil(fmax(hi - p, p - lo) * 1000));
    else
        snprintf(to, size, "%.0f", p * 1000);
}

static void figure(char *to, size_t size, double value)
{
    snprintf(to, size, isnan(value) ? "-" : "%.3g", value);
}

/* A line of the figures, those of the forest first: the column of the bare slope stands beside it. */
static void put_pair(struct pen *pen, enum ceduo_role role, const char *name, const char *wood, const char *bare)
{
    int column = pen->area.width >= 34 ? 15 : 8;
    int wider = strstr(wood, "\xc2\xb1") ? 1 : 0; /* a byte more than columns */
    line(pen, role, "%-9s%*s %*s", name, column + wider, wood, 6, bare);
}

static void put_figures(struct pen *pen, const char *name, double wood, double bare)
{
    char a[32], b[32];
    figure(a, sizeof a, wood);
    figure(b, sizeof b, bare);
    put_pair(pen, CEDUO_ROLE_TEXT, name, a, b);
}

/* What arrives through the forest beside what arrives without it; `wood` NULL: not known yet, or never (index). */
static void put_arrivals(struct pen *pen, const struct ceduo_control *c, const struct ceduo_arrivals *wood,
                         const struct ceduo_arrivals *bare)
{
    bool wide = pen->area.width >= 34;
    const struct ceduo_distribution none = ceduo_distribution_none();
    const struct ceduo_arrivals nothing = {.reach_probability = NAN, .exceed_probability = NAN, .energy = none,
                                           .height = none};
    wood = wood ? wood : &nothing;
    char a[32], b[32], limit[32];
    line(pen, CEDUO_ROLE_TITLE, _("At %g m%s%s"), c->x_given, c->name ? ", " : "", c->name ? c->name : "");
    put_pair(pen, CEDUO_ROLE_DIM, _("of 1000"), _("wood"), _("bare"));
    share(a, sizeof a, wood->reach_probability, wood->reach_lo, wood->reach_hi, wide);
    share(b, sizeof b, bare->reach_probability, 0, 0, false);
    put_pair(pen, CEDUO_ROLE_TEXT, _(" arrive"), a, b);
    if (!isnan(c->accepted)) {
        share(a, sizeof a, wood->exceed_probability, wood->exceed_lo, wood->exceed_hi, wide);
        share(b, sizeof b, bare->exceed_probability, 0, 0, false);
        snprintf(limit, sizeof limit, _(" >%.4g kJ"), c->accepted * KILO);
        put_pair(pen, CEDUO_ROLE_TEXT, limit, a, b);
    }
    put_figures(pen, _(" kJ mean"), wood->energy.mean * KILO, bare->energy.mean * KILO);
    put_figures(pen, _(" kJ 95 %"), wood->energy.p95 * KILO, bare->energy.p95 * KILO);
    put_figures(pen, _(" m  95 %"), wood->height.p95, bare->height.p95);
}

static void put_light(struct pen *pen, const char *name, const char *what, enum ceduo_light light)
{
    line(pen, ceduo_plot_light_role(light), "%s %-8s %s %s", ceduo_plot_light_mark(light), name,
         ceduo_words_verdict(light), what);
}

static void put_lights(struct pen *pen, const struct ceduo_index *index, const struct ceduo_arrivals *wood,
                       double threshold)
{
    char what[64];
    bool wide = pen->area.width >= 30;
    if (index->length > 0 && index->longest_gap > threshold) /* the reason in the page, too */
        snprintf(what, sizeof what, wide ? _("gap %.3g m (>%g)") : _("gap %.3g m"), index->longest_gap, threshold);
    else if (isinf(index->worst_adc))
        snprintf(what, sizeof what, "%s", _("no forest"));
    else
        snprintf(what, sizeof what, wide ? "%.3g m (<%g)" : "%.3g m", index->worst_adc, threshold);
    put_light(pen, _("Contact"), what, index->contact);
    snprintf(what, sizeof what, wide ? "%.1f %% (\xe2\x89\xa4" "10)" : "%.1f %%", index->worst_free_run * 100);
    put_light(pen, _("Free run"), what, index->free_run);
    what[0] = '\0';
    if (index->energy != CEDUO_UNKNOWN && wood)
        snprintf(what, sizeof what, wide ? "%.1f %% (\xe2\x89\xa4" "5)" : "%.1f %%", wood->exceed_probability * 100);
    put_light(pen, _("Energy"), what, index->energy);
}

/* How the rocks end in the forest. */
static void put_ends(struct pen *pen, const struct ceduo_flown *f)
{
    double n = (double)f->rocks;
    if (f->rocks == 0)
        return;
    line(pen, CEDUO_ROLE_TEXT, _("stopped by stems %3.0f"), (double)f->ends.count[CEDUO_STOPPED_BY_STEMS] / n * 1000);
    line(pen, CEDUO_ROLE_TEXT, _("at rest          %3.0f"), (double)f->ends.count[CEDUO_AT_REST] / n * 1000);
}

static void put_index(struct pen *pen, const struct ceduo_index *index)
{
    if (isnan(index->residual))
        line(pen, CEDUO_ROLE_DIM, _("index: takes %.3g kJ"), index->dissipated * KILO);
    else if (index->exhausted)
        line(pen, CEDUO_ROLE_DIM, _("index: %.3g kJ, used up"), index->dissipated * KILO);
    else
        line(pen, CEDUO_ROLE_DIM, _("index: %s%.3g, left %.3g kJ"), index->dissipated > 0 ? "-" : "",
             index->dissipated * KILO, index->residual * KILO);
    if (!isnan(index->measured))
        line(pen, CEDUO_ROLE_DIM, _("seen: %.3g kJ (one rock)"), index->measured * KILO);
}

static void add_warning(void *context, const char *sentence)
{
    ceduo_text_format(context, "! %s\n", sentence);
}

static void put_warnings(struct pen *pen)
{
    struct app *app = pen->app;
    struct text w = {0};
    const struct ceduo_option *o = ceduo_app_option(app);
    const struct ceduo_option_result *found = ceduo_app_found(app);
    struct ceduo_run_remarks remarks = {.ground_assumed = app->document.file.ground_assumed};
    ceduo_words_run_warnings(app->figures.result, &remarks, add_warning, &w);
    for (size_t i = 0; i < o->belts_count; i++)
        ceduo_words_stand_warnings(app->figures.result->scene, &o->belts[i], &found->stands[i], add_warning, &w);
    struct ceduo_area rest = {pen->area.left, pen->y, pen->area.width, pen->area.top + pen->area.height - pen->y};
    ceduo_app_put(app, rest, CEDUO_ROLE_WARN, &w);
}

/* How sure the figures are, and whether they are still being refined. */
static void put_mark(struct pen *pen, const struct ceduo_arrivals *a)
{
    struct app *app = pen->app;
    struct text text = {0};
    ceduo_text_format(&text, "%s ", app->figures.busy ? "\xe2\x80\xa6" : "=");
    if (a->reached > 0)
        ceduo_text_format(&text, "\xc2\xb1%.2g %% ", a->energy.se * CEDUO_Z95 / a->energy.mean * 100);
    ceduo_text_format(&text, _("%llu rocks"), (unsigned long long)a->released);
    line(pen, CEDUO_ROLE_DIM, "%s", ceduo_text_string(&text));
    ceduo_text_free(&text);
}

void ceduo_column_draw(struct app *app, struct ceduo_area area)
{
    struct pen pen = {app, area, area.top};
    put_scene(&pen);
    if (!app->figures.result) {
        line(&pen, CEDUO_ROLE_DIM, "%s", _("the first rocks are falling \xe2\x80\xa6"));
        return;
    }
    const struct ceduo_result *r = app->figures.result;
    size_t c = r->last_control;
    const struct ceduo_option_result *found = ceduo_app_found(app);
    const struct ceduo_arrivals *wood = ceduo_result_wooded(r, app->option, c), *bare = &r->bare.arrivals[c];
    put_arrivals(&pen, &r->scene->controls[c], wood, bare);
    put_lights(&pen, &found->controls[c], wood, r->scene->simulation.threshold);
    if (wood)
        put_ends(&pen, &found->wooded);
    put_index(&pen, &found->controls[c]);
    put_mark(&pen, ceduo_app_shown(app));
    put_warnings(&pen);
}
