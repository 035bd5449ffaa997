/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The column that stands still in every view: what passes, whether it protects, how sure that is. */
#include "now.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/intl.h"

#define KILO 1e-3

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
    ceduo_text_safe(&safe, text.bytes ? text.bytes : "");
    if (pen->y < pen->area.top + pen->area.height && safe.bytes) {
        ceduo_form_cut(pen->app->canvas, pen->area.left, pen->y, pen->area.width, role, safe.bytes);
    }
    pen->y++;
    ceduo_text_free(&text);
    ceduo_text_free(&safe);
}

static void put_scene(struct pen *pen)
{
    const struct ceduo_scene *s = &pen->app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(pen->app);
    struct ceduo_rock rock;
    if (ceduo_rock_of_means(&s->rock, &rock) == CEDUO_OK)
        line(pen, CEDUO_ROLE_TEXT, _("Rock  %.3g m  %.4g kg%s"), rock.mean_diameter, rock.mass,
             ceduo_scene_assumes(&pen->app->document.file, "rock") ? "*" : "");
    line(pen, CEDUO_ROLE_TEXT, _("Wood  %s%s"), s->options_count > 1 ? o->name : o->belts_count ? o->belts[0].name : _("none"),
         o->belts_count > 1 && s->options_count < 2 ? " \xc2\xb7 \xe2\x80\xa6" : "");
}

/* "991 of 1000 (984-995)" */
static void put_arrivals(struct pen *pen, const struct ceduo_control *c, const struct ceduo_arrivals *a)
{
    line(pen, CEDUO_ROLE_TITLE, _("At %g m%s%s"), c->x_given, c->name ? ", " : "", c->name ? c->name : "");
    line(pen, CEDUO_ROLE_DIM, "%s", _("without forest, of 1000:"));
    line(pen, CEDUO_ROLE_TEXT, _(" pass    %4.0f (%.0f-%.0f)"), a->reach_probability * 1000, floor(a->reach_lo * 1000),
         ceil(a->reach_hi * 1000));
    if (!isnan(a->exceed_probability))
        line(pen, CEDUO_ROLE_TEXT, _(" >%g kJ %4.0f (%.0f-%.0f)"), c->accepted * KILO, a->exceed_probability * 1000,
             floor(a->exceed_lo * 1000), ceil(a->exceed_hi * 1000));
    if (a->reached == 0) {
        line(pen, CEDUO_ROLE_DIM, "%s", _(" no rock arrives"));
        return;
    }
    line(pen, CEDUO_ROLE_TEXT, _(" energy %.4g kJ \xc2\xb1%.2g"), a->energy.mean * KILO, a->energy.se * CEDUO_Z95 * KILO);
    line(pen, CEDUO_ROLE_TEXT, _("    95 %% %.3g kJ"), a->energy.p95 * KILO);
    line(pen, CEDUO_ROLE_TEXT, _(" height %.2g m (95 %%)"), a->height.p95);
}

static void put_light(struct pen *pen, const char *name, const char *what, enum ceduo_light light)
{
    const char *mark = light == CEDUO_PASS ? "\xe2\x9c\x94" : light == CEDUO_FAIL ? "\xe2\x9c\x98" : "?";
    const char *word = light == CEDUO_PASS ? _("passes") : light == CEDUO_FAIL ? _("FAILS") : _("unknown");
    enum ceduo_role role = light == CEDUO_PASS ? CEDUO_ROLE_GOOD : light == CEDUO_FAIL ? CEDUO_ROLE_BAD : CEDUO_ROLE_DIM;
    line(pen, role, "%s %-8s %s %s", mark, name, word, what);
}

static void put_lights(struct pen *pen, const struct ceduo_index *index, double threshold)
{
    char what[64];
    if (isinf(index->worst_adc))
        snprintf(what, sizeof what, "%s", _("no forest"));
    else if (pen->area.width < 30)
        snprintf(what, sizeof what, "%.3g m", index->worst_adc);
    else
        snprintf(what, sizeof what, "%.3g m (<%g)", index->worst_adc, threshold);
    put_light(pen, _("Contact"), what, index->contact);
    snprintf(what, sizeof what, pen->area.width < 30 ? "%.1f %%" : "%.1f %% (\xe2\x89\xa4" "10)",
             index->worst_free_run * 100);
    put_light(pen, _("Free run"), what, index->free_run);
    put_light(pen, _("Energy"), "", index->energy);
}

static void put_index(struct pen *pen, const struct ceduo_index *index)
{
    line(pen, CEDUO_ROLE_DIM, "%s", _("index (Eq. 4, 5):"));
    line(pen, CEDUO_ROLE_TEXT, _(" taken  %.3g kJ"), index->dissipated * KILO);
    if (isnan(index->residual))
        line(pen, CEDUO_ROLE_TEXT, "%s", _(" left   -"));
    else if (index->exhausted)
        line(pen, CEDUO_ROLE_TEXT, "%s", _(" left   used up on average"));
    else
        line(pen, CEDUO_ROLE_TEXT, _(" left   %.3g kJ"), index->residual * KILO);
    if (!isnan(index->measured))
        line(pen, CEDUO_ROLE_TEXT, _(" seen   %.3g kJ (one rock)"), index->measured * KILO);
}

struct warning_list {
    struct text text;
};

static void add_warning(void *context, const char *sentence)
{
    struct warning_list *w = context;
    ceduo_text_format(&w->text, "! %s\n", sentence);
}

static void put_warnings(struct pen *pen)
{
    struct app *app = pen->app;
    struct warning_list w = {{0}};
    const struct ceduo_option *o = ceduo_app_option(app);
    const struct ceduo_option_result *found = ceduo_app_found(app);
    struct ceduo_run_remarks remarks = {.ground_assumed = app->document.file.ground_assumed};
    ceduo_words_run_warnings(app->result, &remarks, add_warning, &w);
    for (size_t i = 0; i < o->belts_count; i++)
        ceduo_words_stand_warnings(app->result->scene, &o->belts[i], &found->stands[i], add_warning, &w);
    int room = pen->area.top + pen->area.height - pen->y;
    if (w.text.bytes && room > 0) {
        struct ceduo_area rest = {pen->area.left, pen->y, pen->area.width, room};
        ceduo_app_text(app, rest, CEDUO_ROLE_WARN, w.text.bytes, 0);
    }
    ceduo_text_free(&w.text);
}

/* How sure the figures are, and whether they are still being refined. */
static void put_mark(struct pen *pen, const struct ceduo_arrivals *a)
{
    struct app *app = pen->app;
    struct text text = {0};
    ceduo_text_format(&text, "%s ", app->busy ? "\xe2\x80\xa6" : "=");
    if (a->reached > 0)
        ceduo_text_format(&text, "\xc2\xb1%.2g %% ", a->energy.se * CEDUO_Z95 / a->energy.mean * 100);
    ceduo_text_format(&text, _("%llu rocks"), (unsigned long long)ceduo_result_rocks(app->result));
    line(pen, CEDUO_ROLE_DIM, "%s", text.bytes ? text.bytes : "");
    ceduo_text_free(&text);
}

void ceduo_now_draw(struct app *app, struct ceduo_area area)
{
    struct pen pen = {app, area, area.top};
    put_scene(&pen);
    if (!app->result) {
        line(&pen, CEDUO_ROLE_DIM, "%s", _("the first rocks are falling \xe2\x80\xa6"));
        return;
    }
    const struct ceduo_result *r = app->result;
    size_t c = r->last_control;
    const struct ceduo_option_result *found = ceduo_app_found(app);
    put_arrivals(&pen, &r->scene->controls[c], &r->bare.arrivals[c]);
    put_lights(&pen, &found->controls[c], r->scene->simulation.threshold);
    put_index(&pen, &found->controls[c]);
    put_mark(&pen, &r->bare.arrivals[c]);
    put_warnings(&pen);
}
