/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "edit.h"
#include "popup.h"
#include "view/plot_parts.h"

#define ZOOM_MOST 7
#define STEPS     100   /* of the cursor, over what is shown */
#define NEAR      0.015 /* of what is shown: so near a point or a control is where the cursor is */

/* ---- where it is ---- */

static double length_of(const struct app *app)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    return s->x[s->vertices - 1];
}

double ceduo_place_x(const struct app *app)
{
    double length = length_of(app);
    return app->place.put ? fmin(app->place.x, length) : length / 2;
}

void ceduo_place_stretch(const struct app *app, double *from, double *to)
{
    double length = length_of(app), shown = ldexp(length, -app->place.zoom);
    *from = fmin(fmax(0, ceduo_place_x(app) - shown / 2), length - shown);
    *to = *from + shown;
}

static void put(struct app *app, double x)
{
    app->place.x = fmin(fmax(0, x), length_of(app));
    app->place.put = true;
}

void ceduo_place_move(struct app *app, int by)
{
    double origin = app->document.file.scene.slope.origin_x;
    double step = ceduo_plot_round(ldexp(length_of(app), -app->place.zoom) / STEPS * 2, false);
    double at = (ceduo_place_x(app) + origin) / step;
    put(app, (by > 0 ? floor(at + 1e-9) + by : ceil(at - 1e-9) + by) * step - origin);
}

/* Takes in a place if it lies on that side of the cursor and nearer than the best so far. */
static void nearer(double here, int side, double x, double *best)
{
    bool beyond = side > 0 ? x > here + 1e-9 : x < here - 1e-9;
    if (beyond && (isnan(*best) || fabs(x - here) < fabs(*best - here)))
        *best = x;
}

void ceduo_place_jump(struct app *app, int by)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct ceduo_option *option = ceduo_app_option(app);
    double here = ceduo_place_x(app), best = NAN;
    nearer(here, by, scene->release.x.mean, &best);
    for (size_t i = 0; i < scene->slope.vertices; i++)
        nearer(here, by, scene->slope.x[i], &best);
    for (size_t i = 0; i < scene->controls_count; i++)
        nearer(here, by, scene->controls[i].x, &best);
    for (size_t i = 0; i < option->belts_count; i++) {
        nearer(here, by, option->belts[i].from, &best);
        nearer(here, by, option->belts[i].to, &best);
    }
    if (!isnan(best))
        put(app, best);
}

void ceduo_place_zoom(struct app *app, int by)
{
    int zoom = app->place.zoom + by;
    if (zoom < 0)
        ceduo_app_say(app, "%s", _("this is the whole slope"));
    else if (zoom > ZOOM_MOST)
        ceduo_app_say(app, "%s", _("this is as near as it gets"));
    else
        app->place.zoom = zoom;
}

/* ---- what is there ---- */

/* The belt that it stands in; belts_count where it stands in none. */
static size_t belt_at(const struct app *app, double x)
{
    const struct ceduo_option *o = ceduo_app_option(app);
    size_t i = 0;
    while (i < o->belts_count && !(x >= o->belts[i].from && x <= o->belts[i].to))
        i++;
    return i;
}

/* The envelope of the cell that is nearest; NULL where none is near, or no rock passes. */
static const struct ceduo_envelope *passing(const struct ceduo_outlook *o, const struct ceduo_sight *sight, double x)
{
    size_t best = 0;
    if (!o || !sight || !sight->envelopes || o->cells < 2)
        return NULL;
    for (size_t i = 1; i < o->cells; i++)
        best = fabs(o->cell_x[i] - x) < fabs(o->cell_x[best] - x) ? i : best;
    bool near = fabs(o->cell_x[best] - x) <= fabs(o->cell_x[1] - o->cell_x[0]);
    return near && sight->envelopes[best].passed > 0 ? &sight->envelopes[best] : NULL;
}

void ceduo_place_say(struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct ceduo_outlook *o = ceduo_live_outlook(&app->live, scene);
    double x = ceduo_place_x(app);
    size_t belt = belt_at(app, x);
    const struct ceduo_envelope *e = passing(o, ceduo_outlook_sight(o, scene, app->option), x);
    struct text text = {0};
    ceduo_text_format(&text, _("%.1f m: %.0f\xc2\xb0 steep, %s"), x + scene->slope.origin_x,
                      atan(ceduo_slope_fall(&scene->slope, x)) * 180 / M_PI,
                      belt < ceduo_app_option(app)->belts_count ? ceduo_app_option(app)->belts[belt].name : _("no forest"));
    if (e) {
        struct text height = {0}, energy = {0};
        ceduo_words_number(&height, e->height.p95, 2);
        ceduo_words_number(&energy, e->mean_energy * J_TO_KJ, 3);
        ceduo_text_then(&text, "; ", _("of 100 rocks that pass the underside of 95 is below %s m; %s kJ on average"),
                        ceduo_text_string(&height), ceduo_text_string(&energy));
        ceduo_text_free(&height);
        ceduo_text_free(&energy);
    }
    ceduo_app_say(app, "%s", ceduo_text_string(&text));
    ceduo_text_free(&text);
}

/* ---- what can be done there ---- */

/* x as the file of the slope has it. */
static double written(const struct app *app, double x)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    return ceduo_slope_mirrored(s, x + s->origin_x);
}

/* "list#index": to edit; "+list#index": to add at the cursor. */
static void offer(struct popup *p, const char *line, const char *sign, const char *list, size_t index)
{
    char value[FORM_PATH + 32];
    snprintf(value, sizeof value, "%s%s#%zu", sign, list, index);
    ceduo_popup_item(p, line, value);
}

static void chose(struct app *app, struct popup *p, const char *value)
{
    char list[FORM_PATH + 32];
    (void)p;
    bool add = value[0] == '+';
    snprintf(list, sizeof list, "%s", value + add);
    char *mark = strrchr(list, '#');
    if (!mark)
        return;
    *mark = '\0';
    size_t index = strtoul(mark + 1, NULL, 10);
    ceduo_app_state(app)->pane = 0;
    app->message[0] = '\0'; /* it was about the cursor */
    if (add)
        ceduo_items_add_at(app, list, index,
                           strncmp(list, "slope.", 6) == 0 ? written(app, ceduo_place_x(app))
                                                           : ceduo_place_x(app) + app->document.file.scene.slope.origin_x);
    else
        ceduo_form_go(ceduo_app_form(app), list, index);
}

__attribute__((format(printf, 2, 3))) static const char *line_of(char room[160], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(room, 160, format, args);
    va_end(args);
    return room;
}

size_t ceduo_place_stretch_of(const struct app *app, double x_written)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    size_t j = ceduo_slope_segment(s, ceduo_slope_mirrored(s, x_written) - s->origin_x);
    if (!vertices) /* a CSV file */
        return s->reversed ? s->vertices - 2 - j : j;
    for (j = 0; j + 2 < vertices->n && x_written >= ceduo_node_item_number(vertices->items[j + 1], 0);)
        j++;
    return j;
}

/* The item of slope.materials that holds it, in metres of its file; SIZE_MAX: none. */
static size_t material_at(const struct app *app, double x)
{
    const struct node *list = ceduo_document_node(&app->document, "slope.materials");
    for (size_t i = 0; list && i < list->n; i++) {
        const struct node *item = list->items[i];
        if (x >= ceduo_node_number(item, "from_m") && x <= ceduo_node_number(item, "to_m"))
            return i;
    }
    return SIZE_MAX;
}

static void offer_ground(struct app *app, struct popup *p, double x)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    const struct node *segments = ceduo_document_node(&app->document, "slope.segments");
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    double there = written(app, x);
    size_t j = ceduo_place_stretch_of(app, there), material = material_at(app, there);
    char room[160];
    if (segments && segments->n > 0) {
        size_t i = segments->n == 1 ? 0 : j;
        offer(p, line_of(room, _("edit the ground here: number %zu"), i + 1), "", "slope.segments", i);
        if (vertices)
            offer(p, _("another ground from here on"), "+", "slope.segments", i);
    } else if (material != SIZE_MAX) {
        offer(p, line_of(room, _("edit the ground here: number %zu"), material + 1), "", "slope.materials", material);
        offer(p, _("another ground from here on"), "+", "slope.materials", material);
    }
    if (vertices && vertices->n <= 200) {
        double a = ceduo_node_item_number(vertices->items[j], 0), b = ceduo_node_item_number(vertices->items[j + 1], 0);
        bool first = there - a < b - there;
        offer(p,
              line_of(room, _("edit the nearest point of the profile: number %zu, at %.4g m"), j + (first ? 1 : 2),
                      ceduo_slope_mirrored(s, first ? a : b)),
              "", "slope.vertices_m", j + (first ? 0 : 1));
        offer(p, _("a new point of the profile here"), "+", "slope.vertices_m", j);
    }
}

static void offer_belt(struct app *app, struct popup *p, double x)
{
    const struct ceduo_option *o = ceduo_app_option(app);
    size_t belt = belt_at(app, x);
    char forest[64], room[160];
    if (belt == o->belts_count)
        return;
    ceduo_app_forest(app, forest, sizeof forest);
    offer(p, line_of(room, _("edit the belt here: %.100s"), o->belts[belt].name), "", forest, belt);
    offer(p, _("two belts: end this one here and begin another"), "+", forest, belt);
}

static void offer_control(struct app *app, struct popup *p, double x)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    const char *list = ceduo_document_node(&app->document, "controls_m") ? "controls_m" : "controls";
    char room[160];
    double near = NEAR * ldexp(length_of(app), -app->place.zoom);
    for (size_t i = 0; i < s->controls_count; i++)
        if (fabs(s->controls[i].x - x) <= near)
            offer(p, line_of(room, _("edit the control at %.4g m"), s->controls[i].x_given), "", list, i);
    offer(p, _("count rocks here too: a new control"), "+", list, s->controls_count);
}

void ceduo_place_choose(struct app *app)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    double x = ceduo_place_x(app);
    char title[96];
    snprintf(title, sizeof title, _("At %.4g m"), x + s->origin_x);
    struct popup *p = ceduo_popup_list(app, title, chose);
    offer_belt(app, p, x);
    offer_ground(app, p, x);
    offer_control(app, p, x);
}
