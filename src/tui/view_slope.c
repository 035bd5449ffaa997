/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 1: the slope, trajectories over it, height and energy along it; its ground, belts and controls to edit. */

#include "app.h"
#include "base/language.h"
#include "place.h"

static void build_ground(struct app *app, struct form *form)
{
    static const char *const materials[] = {"from_m", "to_m", "material", NULL};
    const struct document *d = &app->document;
    const struct object *slope = ceduo_schema_slope();
    const struct node *segments = ceduo_document_node(d, "slope.segments");
    ceduo_form_heading(form, _("Ground"));
    ceduo_form_field(form, d, slope, "slope", "facets", NULL);
    if (d->file.scene.slope.reversed)
        ceduo_form_note(form, _("the profile is drawn upward: below, x of ground and points counts from its lower end"));
    if (!segments && !ceduo_document_node(d, "slope.materials"))
        ceduo_form_note(form, _("talus is assumed everywhere"));
    if (!segments)
        ceduo_form_table(form, d, ceduo_schema_field(slope, "materials")->object, "slope.materials", materials, "");
    if (segments) {
        bool by_height = segments->n > 0 && ceduo_node_get(segments->items[0], "roughness_m");
        bool arm = d->file.scene.simulation.law == CEDUO_LAW_ARM; /* which knows mu, the others Rt */
        const char *const ground[] = {"rn", arm ? "mu" : "rt", by_height ? "roughness_m" : "roughness_rad", "friction", NULL};
        ceduo_form_table(form, d, ceduo_schema_field(slope, "segments")->object, "slope.segments", ground, "");
    }
}

static void build_vertices(struct app *app, struct form *form)
{
    const struct document *d = &app->document;
    const struct node *vertices = ceduo_document_node(d, "slope.vertices_m");
    if (!vertices) {
        ceduo_form_heading(form, _("Profile: from a CSV file"));
        ceduo_form_field(form, d, ceduo_schema_slope(), "slope", "csv", NULL);
        return;
    }
    if (vertices->n > 200) { /* a list too long to be edited by hand */
        ceduo_form_note(form, _("The profile has too many vertices to list; edit its file."));
        return;
    }
    ceduo_form_heading(form, _("Profile: points x z, m"));
    ceduo_form_points(form, d, ceduo_schema_field(ceduo_schema_slope(), "vertices_m"), "slope.vertices_m");
}

static void build(struct app *app, struct form *form)
{
    static const char *const belt_columns[] = {"from_m", "to_m", "stand", NULL};
    static const char *const control_columns[] = {"x_m", "name", "accepted_kJ", "measured_speed_m_s", NULL};
    const struct object *scene = ceduo_schema_scene();
    char forest[64];
    ceduo_app_forest(app, forest, sizeof forest);
    ceduo_form_heading(form, _("Belts of forest"));
    ceduo_form_table(form, &app->document, ceduo_schema_field(scene, "forest")->object, forest, belt_columns, "");
    ceduo_form_heading(form, _("Controls"));
    if (ceduo_document_node(&app->document, "controls"))
        ceduo_form_table(form, &app->document, ceduo_schema_field(scene, "controls")->object, "controls", control_columns, "");
    else
        ceduo_form_field(form, &app->document, scene, "", "controls_m", NULL);
    build_ground(app, form);
    build_vertices(app, form);
}

enum { PANE_FORM, PANE_ROCKS, PANE_PLACE, PANES };

static void say_how(struct app *app)
{
    if (ceduo_app_state(app)->pane == PANE_ROCKS)
        ceduo_app_say(app, "%s", _("left, right: another rock; down, up: along its way; Tab: along the slope"));
    else
        ceduo_place_say(app);
}

/* The picture alone where it has the focus, otherwise with the form below it. */
static void draw(struct app *app, struct ceduo_area area)
{
    ceduo_app_follow_rock(app);
    struct ceduo_span span;
    struct ceduo_picture picture = ceduo_app_picture(app);
    double mark = ceduo_place_x(app);
    picture.span = &span;
    bool alone = ceduo_app_state(app)->pane != PANE_FORM;
    if (app->place.zoom > 0)
        ceduo_place_stretch(app, &picture.from, &picture.to);
    int form_height = alone ? 0 : area.height / 3;
    bool place = ceduo_app_state(app)->pane == PANE_PLACE; /* no strips: all rows for the slope at true scale */
    int room = area.height - form_height;
    int strips = place ? 0 : room >= 24 ? 2 : room >= 13 ? 1 : 0;
    if (place)
        picture.mark = &mark;
    int strip = room >= 24 ? room / 4 : 5;
    if (alone && !app->message[0])
        say_how(app);
    struct ceduo_area profile = {area.left, area.top, area.width, room - strip * strips - (alone ? 0 : 1)};
    ceduo_plot_draw(CEDUO_PLOT_PROFILE, &app->cells->canvas, &profile, &picture);
    struct ceduo_area next = {area.left, area.top + profile.height, area.width, strip};
    if (strips > 1) {
        picture.no_x_axis = true;
        ceduo_plot_draw(CEDUO_PLOT_HEIGHT, &app->cells->canvas, &next, &picture);
        next.top += strip;
    }
    picture.no_x_axis = strips < 2;
    if (strips > 0)
        ceduo_plot_draw(CEDUO_PLOT_ENERGY, &app->cells->canvas, &next, &picture);
    struct ceduo_area below = {area.left, area.top + area.height - form_height, area.width, form_height};
    ceduo_app_draw_form(app, below, true);
}

/* Along the slope: left and right by steps, up and down from one point, border or control to the next. */
static bool act_on_place(struct app *app, enum action action)
{
    switch (action) {
    case ACTION_RIGHT:
        ceduo_place_move(app, 1);
        return true;
    case ACTION_LEFT:
        ceduo_place_move(app, -1);
        return true;
    case ACTION_DOWN:
        ceduo_place_jump(app, 1);
        return true;
    case ACTION_UP:
        ceduo_place_jump(app, -1);
        return true;
    case ACTION_EDIT:
    case ACTION_ADD:
        ceduo_place_choose(app);
        return true;
    default:
        return false;
    }
}

/* In the picture left and right go from rock to rock, up and down along its trajectory. */
static bool act_on_rocks(struct app *app, enum action action)
{
    switch (action) {
    case ACTION_RIGHT:
        ceduo_app_next_rock(app, 1);
        return true;
    case ACTION_LEFT:
        ceduo_app_next_rock(app, -1);
        return true;
    case ACTION_DOWN:
        ceduo_app_step_rock(app, 1);
        return true;
    case ACTION_UP:
        ceduo_app_step_rock(app, -1);
        return true;
    default:
        return false;
    }
}

static bool act(struct app *app, enum action action)
{
    int pane = ceduo_app_state(app)->pane;
    if (action == ACTION_ZOOM || action == ACTION_UNZOOM) {
        ceduo_app_state(app)->pane = pane == PANE_FORM ? PANE_PLACE : pane;
        ceduo_place_zoom(app, action == ACTION_ZOOM ? 1 : -1);
        return true;
    }
    return pane == PANE_PLACE ? act_on_place(app, action) : pane == PANE_ROCKS && act_on_rocks(app, action);
}

const struct view ceduo_view_slope = {.title = NP_("view", "slope"),
                                      .panes = PANES,
                                      .build = build,
                                      .draw = draw,
                                      .act = act,
                                      .bar = {{ACTION_EDIT, N_("edit")},
                                              {ACTION_ADD, N_("add")},
                                              {ACTION_DELETE, N_("delete")},
                                              {ACTION_NEXT_PANE, N_("picture")},
                                              {ACTION_ZOOM, N_("nearer")},
                                              {ACTION_NEXT_ROCK, N_("a rock")}}};
