/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 1: the slope with trajectories, height and energy; its ground, belts and controls to edit. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "popup.h"
#include "scene/slope.h"
#include "view/plot.h"

/* ---- the form ---- */

#define LISTED_MAX 200 /* max. points to edit */

/* Add the fence of each control. */
static void build_fences(struct app *app, struct form *form)
{
    const struct node *controls = ceduo_document_node(&app->document, "controls");
    if (!controls)
        return;
    ceduo_form_heading(form, _("Net fence"));
    for (size_t i = 0; i < app->document.file.scene.controls_count; i++) {
        if (controls->n > 1)
            ceduo_form_note(form, ceduo_app_format(app, _("at %s m"), LOCALIZED(app->document.file.scene.controls[i].x_given)));
        ceduo_form_fields(form, ceduo_app_format(app, "controls[%zu].fence.", i), "energy_kJ height_m life_y");
    }
}

static void build_slope(struct app *app, struct form *form)
{
    const struct document *d = &app->document;
    const struct node *segments = ceduo_document_node(d, "slope.segments");
    const struct node *vertices = ceduo_document_node(d, "slope.vertices_m");
    ceduo_form_heading(form, _("Belts of forest"));
    ceduo_form_table(form, ceduo_app_forest(app), NULL, "from_m to_m stand");
    ceduo_form_heading(form, _("Controls"));
    if (ceduo_document_node(d, "controls"))
        ceduo_form_table(form, "controls", NULL,
                         ceduo_document_node(d, "blocks") ? "x_m name accepted_kJ accepted_return_y measured_speed_m_s"
                                                          : "x_m name accepted_kJ measured_speed_m_s");
    else
        ceduo_form_field(form, "controls_m", NULL);
    ceduo_form_heading(form, _("Ground"));
    ceduo_form_field(form, "slope.facets", NULL);
    if (d->file.scene.slope.reversed)
        ceduo_form_note(form, _("the profile is drawn upward: below, x of ground and points starts at its lower end"));
    if (!segments && !ceduo_document_node(d, "slope.materials"))
        ceduo_form_note(form, _("talus is assumed everywhere"));
    if (segments) {
        bool by_height = segments->n > 0 && ceduo_node_get(segments->items[0], "roughness_m");
        bool arm = d->file.scene.simulation.law == CEDUO_LAW_ARM; /* the arm law uses mu, the others Rt */
        ceduo_form_table(
            form, "slope.segments", NULL,
            ceduo_app_format(app, "rn %s %s friction", arm ? "mu" : "rt", by_height ? "roughness_m" : "roughness_rad"));
    } else {
        ceduo_form_table(form, "slope.materials", NULL, "from_m to_m material");
        ceduo_form_field(form, "slope.tolerance_m", NULL);
        LOCAL_TEXT(points);
        ceduo_words_points(&points, &d->file.scene.slope);
        ceduo_form_note(form, ceduo_app_format(app, _("o: %s"), ceduo_text_string(&points)));
    }
    build_fences(app, form);
    if (!vertices) {
        ceduo_form_heading(form, _("Profile: from a CSV file"));
        ceduo_form_field(form, "slope.csv", NULL);
    } else if (vertices->n > LISTED_MAX) {
        ceduo_form_note(form, _("The profile has too many vertices to list; edit its file."));
    } else {
        ceduo_form_heading(form, _("Profile: points x z, m"));
        ceduo_form_points(form, "slope.vertices_m");
    }
}

#define ZOOM_MAX   7
#define STEPS      100   /* steps of the cursor over the part shown */
#define NEAR_SHARE 0.015 /* a point or control this close is at the cursor, as a share of the part shown */

/* ---- the cursor along the slope ---- */

struct slope_cursor {
    double x;               /* m, relative */
    int zoom;               /* magnification 2^zoom */
    bool is_set;            /* x was set by a move */
    struct ceduo_span span; /* columns of the last picture */
};

static double slope_length(const struct app *app)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    return s->x[s->vertices - 1];
}

/* Return x, m relative: the middle of the slope until the cursor is moved. */
static double cursor_x(const struct app *app)
{
    const struct slope_cursor *p = ceduo_app_private_state(app);
    return p->is_set ? fmin(p->x, slope_length(app)) : slope_length(app) / 2;
}

static void set_cursor(struct app *app, double x)
{
    struct slope_cursor *p = ceduo_app_private_state(app);
    p->x = fmin(fmax(0, x), slope_length(app));
    p->is_set = true;
}

/* Return the length of the part shown, m. */
static double shown_length(const struct app *app)
{
    return ldexp(slope_length(app), -((const struct slope_cursor *)ceduo_app_private_state(app))->zoom);
}

/* Return the interval of round numbers at which the cursor stops, m. */
static double cursor_grid(const struct app *app)
{
    return ceduo_plot_round(shown_length(app) / STEPS * 2, false);
}

/* Move by a hundredth of the part shown, to a round number. */
static void move_cursor(struct app *app, int step)
{
    double origin = app->document.file.scene.slope.origin_x, grid = cursor_grid(app);
    double steps = (cursor_x(app) + origin) / grid;
    set_cursor(app, (step > 0 ? floor(steps + 1e-9) + step : ceil(steps - 1e-9) + step) * grid - origin);
}

/* Set `*best` to x if x is on this side of `from` and nearer than `*best`. */
static void keep_nearest(double from, int side, double x, double *best)
{
    bool beyond = side > 0 ? x > from + 1e-9 : x < from - 1e-9;
    if (beyond && (isnan(*best) || fabs(x - from) < fabs(*best - from)))
        *best = x;
}

/* Move to the next point, border or control. */
static void jump_to_next(struct app *app, int step)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct ceduo_option *option = ceduo_app_option(app);
    double from = cursor_x(app), best = NAN;
    keep_nearest(from, step, scene->release.x.mean, &best);
    for (size_t i = 0; i < scene->slope.vertices; i++)
        keep_nearest(from, step, scene->slope.x[i], &best);
    for (size_t i = 0; i < scene->controls_count; i++)
        keep_nearest(from, step, scene->controls[i].x, &best);
    for (size_t i = 0; i < option->belts_count; i++) {
        keep_nearest(from, step, option->belts[i].from, &best);
        keep_nearest(from, step, option->belts[i].to, &best);
    }
    if (!isnan(best))
        set_cursor(app, best);
}

/* ---- text at the cursor ---- */

/* Return the belt at x; belts_count: none. */
static size_t find_belt(const struct app *app, double x)
{
    const struct ceduo_option *o = ceduo_app_option(app);
    size_t i = 0;
    while (i < o->belts_count && !(x >= o->belts[i].from && x <= o->belts[i].to))
        i++;
    return i;
}

static void hint_cursor(struct app *app)
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    const struct ceduo_snapshot *o = ceduo_live_snapshot(&app->live, scene);
    const struct ceduo_run_snapshot *run = ceduo_snapshot_find(o, scene, app->option);
    double x = cursor_x(app);
    size_t belt = find_belt(app, x), cell = 0;
    LOCAL_TEXT(text);
    ceduo_text_format(&text, _("%.1f m: %.0f\xc2\xb0 steep, %s"), x + scene->slope.origin_x,
                      atan(ceduo_slope_fall(&scene->slope, x)) * 180 / M_PI,
                      belt < ceduo_app_option(app)->belts_count ? ceduo_app_option(app)->belts[belt].name : _("no forest"));
    for (size_t i = 1; o && i < o->cells; i++) /* nearest cell */
        cell = fabs(o->cell_x[i] - x) < fabs(o->cell_x[cell] - x) ? i : cell;
    bool is_near = o && o->cells > 1 && fabs(o->cell_x[cell] - x) <= fabs(o->cell_x[1] - o->cell_x[0]);
    const struct ceduo_envelope *e = is_near && run && run->envelopes ? &run->envelopes[cell] : NULL;
    if (e && e->passed > 0)
        ceduo_text_append_joined(&text, "; ", _("underside p95 %s m, mean energy %s kJ"), SIG(e->height.p95, 2),
                                 SIG(e->mean_energy * J_TO_KJ, 3));
    ceduo_app_show_hint(app, text.bytes);
}

/* ---- actions at the cursor ---- */

/* Return x as in the file of the slope. */
static double x_in_file(const struct app *app, double x)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    return ceduo_slope_mirrored(s, x + s->origin_x);
}

/* Add an item. "list#index": edit; "+list#index": add at the cursor. */
static void add_place_item(struct app *app, const char *line, const char *sign, const char *list, size_t index)
{
    ceduo_popup_add_item(app->popup, line, ceduo_app_format(app, "%s%s#%zu", sign, list, index));
}

static void select_place(struct app *app, struct popup *p)
{
    bool add = p->value[0] == '+';
    char *list = ceduo_app_format(app, "%s", p->value + add), *mark = strrchr(list, '#');
    *mark = '\0';
    size_t index = strtoul(mark + 1, NULL, 10);
    ceduo_app_state(app)->pane = 0;
    if (add)
        ceduo_items_add_at(app, list, index,
                           strncmp(list, "slope.", 6) == 0 ? x_in_file(app, cursor_x(app))
                                                           : cursor_x(app) + app->document.file.scene.slope.origin_x);
    else
        ceduo_form_go_to_item(ceduo_app_form(app), list, index);
}

static void add_ground_items(struct app *app, double x)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    const struct node *segments = ceduo_document_node(&app->document, "slope.segments");
    const struct node *vertices = ceduo_document_node(&app->document, "slope.vertices_m");
    double file_x = x_in_file(app, x);
    const struct node *materials = ceduo_document_node(&app->document, "slope.materials");
    size_t j = ceduo_items_find_segment(app, file_x), n = materials ? materials->n : 0, material = 0;
    while (material < n &&
           !(file_x >= ceduo_document_read_place(&app->document, ceduo_node_text(materials->items[material], "from_m")) &&
             file_x <= ceduo_document_read_place(&app->document, ceduo_node_text(materials->items[material], "to_m"))))
        material++;
    bool by_segment = segments && segments->n > 0;
    size_t i = !by_segment ? material : segments->n == 1 ? 0 : j;
    const char *list = by_segment ? "slope.segments" : "slope.materials";
    if (by_segment || material < n)
        add_place_item(app, ceduo_app_format(app, _("edit the ground here: number %zu"), i + 1), "", list, i);
    if (by_segment ? vertices != NULL : material < n)
        add_place_item(app, _("new ground from here on"), "+", list, i);
    if (vertices && vertices->n <= LISTED_MAX) {
        double a = ceduo_node_item_number(vertices->items[j], 0), b = ceduo_node_item_number(vertices->items[j + 1], 0);
        bool first = file_x - a < b - file_x;
        add_place_item(app,
                       ceduo_app_format(app, _("edit the nearest point of the profile: number %zu, at %.4g m"),
                                        j + (first ? 1 : 2), ceduo_slope_mirrored(s, first ? a : b)),
                       "", "slope.vertices_m", j + (first ? 0 : 1));
        add_place_item(app, _("new point of the profile here"), "+", "slope.vertices_m", j);
    }
}

/* List the items at the cursor to edit, and those that can be added. */
static void list_at_cursor(struct app *app)
{
    const struct ceduo_scene *s = &app->document.file.scene;
    const struct ceduo_option *o = ceduo_app_option(app);
    const char *forest = ceduo_app_forest(app);
    const char *controls = ceduo_document_node(&app->document, "controls_m") ? "controls_m" : "controls";
    double x = cursor_x(app), tolerance = NEAR_SHARE * shown_length(app);
    size_t belt = find_belt(app, x);
    ceduo_popup_list(app, ceduo_app_format(app, _("At %.4g m"), x + s->slope.origin_x), "", select_place);
    if (belt < o->belts_count) {
        add_place_item(app, ceduo_app_format(app, _("edit the belt here: %.100s"), o->belts[belt].name), "", forest, belt);
        add_place_item(app, _("split the belt here"), "+", forest, belt);
    }
    add_ground_items(app, x);
    for (size_t i = 0; i < s->controls_count; i++)
        if (fabs(s->controls[i].x - x) <= tolerance)
            add_place_item(app, ceduo_app_format(app, _("edit the control at %.4g m"), s->controls[i].x_given), "", controls,
                           i);
    add_place_item(app, _("new control here"), "+", controls, s->controls_count);
}

/* ---- the pictures ---- */

enum { PANE_FORM, PANE_ROCKS, PANE_PLACE, PANES };

/* Show the belt under the cursor of the form or of the slope. Without a belt there, keep the one shown. */
static void sync_shown_belt(struct app *app)
{
    size_t belt = find_belt(app, cursor_x(app));
    if (ceduo_app_state(app)->pane == PANE_PLACE && belt < ceduo_app_option(app)->belts_count)
        ceduo_app_show_belt(app, belt);
    else if (ceduo_app_state(app)->pane == PANE_FORM)
        ceduo_app_sync_belt(app);
}

/* Put the cursor on the slope below the pointer. */
static void click_slope(struct app *app, int column, int row)
{
    const struct ceduo_span *span = &((const struct slope_cursor *)ceduo_app_private_state(app))->span;
    double origin = app->document.file.scene.slope.origin_x, grid = cursor_grid(app);
    (void)row;
    ceduo_app_state(app)->pane = PANE_PLACE;
    set_cursor(app, round((span->x0 + column * (span->x1 - span->x0) / (span->width - 1) + origin) / grid) * grid - origin);
}

/* Let the mouse act on the columns of the slope. A click on the cursor opens its list. */
static void add_slope_hits(struct app *app, struct ceduo_area area)
{
    const struct ceduo_span *span = &((const struct slope_cursor *)ceduo_app_private_state(app))->span;
    if (span->width < 2 || !(span->x1 > span->x0))
        return;
    area.left = span->left;
    area.width = span->width;
    ceduo_app_add_hit(app, (struct hit){.area = area, .click = click_slope});
    if (ceduo_app_state(app)->pane != PANE_PLACE)
        return;
    area.left += (int)lround((cursor_x(app) - span->x0) / (span->x1 - span->x0) * (span->width - 1)) - 1;
    area.width = 3;
    ceduo_app_add_hit(app, (struct hit){.area = area, .key = K_ENTER});
}

/* Layout of the view: the picture of the slope with strips below it on the same axis, and the form below or next to them. */
struct layout {
    struct ceduo_area form; /* no height: not shown */
    int slope;              /* lines of the slope */
    int strips, strip;      /* number of strips; lines of each */
    int columns;            /* columns of the pictures */
};

#define AXES             4  /* columns of the left axis, and lines of names, of the bottom axis and of belts */
#define NAMES            14 /* columns for the names of curves, on the right of strips */
#define SHORT_NAMES      6  /* the same by the index */
#define FORM_COLUMNS_MIN 40 /* columns of the form next to the pictures */
#define BESIDE_LINES     24 /* min. lines for the form next to the pictures */
#define BAND_LINES       7  /* min. lines of a strip with a band */
#define STRIP_SHARE      5  /* share of the lines for each strip next to the form */

/* Return the dots of a metre in a picture of the slope at true scale. */
static double slope_scale(const struct app *app, int columns, int lines)
{
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    double drop = s->z[0] - s->z[s->vertices - 1];
    return fmin(2 * (columns - AXES) / slope_length(app), 4 * (lines - AXES) / fmax(drop, 1));
}

/* Return the lines of the form up to the last control, which is always shown if there is space. */
static int count_form_lines(const struct form *form)
{
    int lines = 0;
    for (size_t i = 0; i < form->n; i++)
        if (strncmp(form->rows[i].list, "controls", 8) == 0)
            lines = (int)i + 1;
    return lines;
}

/* Put the form below the pictures if the form has the focus. */
static struct layout stack_layout(struct ceduo_area area, int pane, int form_lines)
{
    int third = area.height > 45 ? 4 * area.height / 9 : area.height / 3 + 1, half = area.height / 2;
    form_lines = form_lines < half ? form_lines : half;
    form_lines = pane != PANE_FORM ? 0 : form_lines > third ? form_lines : third;
    int rows = area.height - form_lines + (pane == PANE_FORM);
    struct layout l = {.columns = area.width};
    l.strips = pane == PANE_PLACE ? 0 : rows >= 24 ? 2 : rows >= 12 ? 1 : 0; /* along the slope: all lines at true scale */
    l.strip = rows >= 24 ? rows / 4 : 5;
    l.slope = rows - l.strip * l.strips - (pane == PANE_FORM);
    l.form = cut_bottom(&area, form_lines);
    return l;
}

/* Put the form next to the pictures. Along the slope, leave the strips out if the slope then is larger. */
static struct layout place_beside(const struct app *app, struct ceduo_area area, int pane)
{
    struct layout l = {.strips = 2, .strip = area.height / STRIP_SHARE, .columns = area.width - FORM_COLUMNS_MIN - 2};
    l.slope = area.height - 2 * (area.height / STRIP_SHARE) - 2;
    if (pane == PANE_PLACE && slope_scale(app, l.columns, area.height) > slope_scale(app, l.columns, l.slope))
        l = (struct layout){.slope = area.height, .columns = l.columns};
    int needed = (int)ceil(slope_length(app) * slope_scale(app, l.columns, l.slope) / 2) + AXES + (l.strips > 0 ? NAMES : 1);
    l.columns = needed < l.columns ? needed : l.columns;
    l.form = (struct ceduo_area){area.left + l.columns + 2, area.top, area.width - l.columns - 2, area.height};
    return l;
}

/* Choose the layout with the larger slope. */
static struct layout choose_layout(struct app *app, struct ceduo_area area)
{
    int pane = ceduo_app_state(app)->pane, wide = area.width - FORM_COLUMNS_MIN - 2;
    struct layout below = stack_layout(area, PANE_FORM, 0);
    bool wide_enough = wide >= FORM_COLUMNS_MIN && area.height >= BESIDE_LINES &&
                       slope_scale(app, wide, area.height - 2 * (area.height / STRIP_SHARE) - 2) >
                           slope_scale(app, below.columns, below.slope);
    return wide_enough ? place_beside(app, area, pane) : stack_layout(area, pane, count_form_lines(ceduo_app_form(app)));
}

/* Draw the pictures and the form. */
static void draw_slope(struct app *app, struct ceduo_area area)
{
    ceduo_app_trace_rock(app);
    struct slope_cursor *cursor = ceduo_app_private_state(app);
    struct ceduo_picture picture = ceduo_app_picture(app);
    const struct form_row *form_row = ceduo_form_row(ceduo_app_form(app));
    const struct ceduo_scene *scene = picture.scene;
    double mark = cursor_x(app);
    cursor->span = (struct ceduo_span){0};
    picture.span = &cursor->span;
    bool picture_only = ceduo_app_state(app)->pane != PANE_FORM, has_cursor = ceduo_app_state(app)->pane == PANE_PLACE;
    double shown = shown_length(app);
    if (shown < slope_length(app)) { /* stretch around the cursor */
        picture.from = fmin(fmax(0, mark - shown / 2), slope_length(app) - shown);
        picture.to = picture.from + shown;
    }
    struct layout layout = choose_layout(app, area);
    ceduo_app_draw_form(app, layout.form);
    area.width = layout.columns;
    struct ceduo_area whole = area;
    bool on_control =
        !picture_only && form_row && strcmp(form_row->list, "controls") == 0 && form_row->index < scene->controls_count;
    if (on_control)
        mark = scene->controls[form_row->index].x;
    if (has_cursor || on_control)
        picture.mark = &mark;
    picture.mark_belt = ceduo_app_option(app)->belts_count > 1;
    if (has_cursor)
        hint_cursor(app);
    else if (picture_only)
        ceduo_app_show_hint(app, _("left, right: another rock; down, up: along its trajectory; Tab: along the slope"));
    struct ceduo_area slope = cut_top(&area, layout.slope);
    if (layout.form.top == whole.top && scene->simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX)
        slope.width -= SHORT_NAMES;
    ceduo_app_draw_plot(app, CEDUO_PLOT_PROFILE, slope, &picture);
    picture.no_x_axis = true;
    picture.bands = layout.strip >= BAND_LINES;
    if (layout.strips > 1)
        ceduo_app_draw_plot(app, CEDUO_PLOT_HEIGHT, cut_top(&area, layout.strip), &picture);
    picture.no_x_axis = layout.strips < 2;
    if (layout.strips > 0)
        ceduo_app_draw_plot(app, CEDUO_PLOT_ENERGY, cut_top(&area, layout.strip + (layout.form.top == whole.top ? 2 : 0)),
                            &picture);
    add_slope_hits(app, whole);
}

static void change_zoom(struct app *app, int step)
{
    struct view_state *state = ceduo_app_state(app);
    state->pane = state->pane == PANE_FORM ? PANE_PLACE : state->pane;
    struct slope_cursor *p = ceduo_app_private_state(app);
    step += p->zoom;
    if (step < 0 || step > ZOOM_MAX)
        ceduo_app_show_message(app, "%s", step < 0 ? _("this is the whole slope") : _("maximum zoom"));
    else
        p->zoom = step;
}

#define ZOOM_BINDINGS KEY(ZOOM, .handler = change_zoom, .step = 1), KEY(UNZOOM, .handler = change_zoom, .step = -1)

static const struct key_binding form_bindings[] = {ZOOM_BINDINGS, {0}};

/* Bindings of the picture: left and right change the rock, up and down move along its trajectory. */
static const struct key_binding picture_bindings[] = {KEY(RIGHT, .handler = ceduo_app_next_rock, .step = 1),
                                                      KEY(LEFT, .handler = ceduo_app_next_rock, .step = -1),
                                                      KEY(DOWN, .handler = ceduo_app_step_rock, .step = 1),
                                                      KEY(UP, .handler = ceduo_app_step_rock, .step = -1),
                                                      ZOOM_BINDINGS,
                                                      {0}};

/* Bindings along the slope: left and right move by steps, up and down to the next point, border or control. */
static const struct key_binding cursor_bindings[] = {KEY(RIGHT, .handler = move_cursor, .step = 1),
                                                     KEY(LEFT, .handler = move_cursor, .step = -1),
                                                     KEY(DOWN, .handler = jump_to_next, .step = 1),
                                                     KEY(UP, .handler = jump_to_next, .step = -1),
                                                     KEY(EDIT, .plain = list_at_cursor),
                                                     KEY(ADD, .plain = list_at_cursor),
                                                     ZOOM_BINDINGS,
                                                     {0}};

const struct view ceduo_view_slope = {.panes = PANES,
                                      .private_size = sizeof(struct slope_cursor),
                                      .build = build_slope,
                                      .draw = draw_slope,
                                      .bindings = {form_bindings, picture_bindings, cursor_bindings},
                                      .after_key = sync_shown_belt,
                                      .bar = {KEY(EDIT, N_("edit")), KEY(ADD, N_("add")), KEY(DELETE, N_("delete")),
                                              KEY(NEXT_PANE, N_("picture")), KEY(ZOOM, N_("zoom in")),
                                              KEY(NEXT_ROCK, N_("next rock"))}};
