/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 1: the slope, trajectories over it, height and energy along it; its ground, belts and controls to edit. */
#include "app.h"
#include "base/language.h"

/* ---- the form ---- */

#define LISTED_MAX 200 /* points that are edited by hand */

static void build(struct app *app, struct form *form)
{
    const struct document *d = &app->document;
    const struct node *segments = ceduo_document_node(d, "slope.segments");
    const struct node *vertices = ceduo_document_node(d, "slope.vertices_m");
    ceduo_form_heading(form, _("Belts of forest"));
    ceduo_form_table(form, ceduo_app_forest(app), NULL, "from_m to_m stand");
    ceduo_form_heading(form, _("Controls"));
    if (ceduo_document_node(d, "controls"))
        ceduo_form_table(form, "controls", NULL, "x_m name accepted_kJ measured_speed_m_s");
    else
        ceduo_form_field(form, "controls_m", NULL);
    ceduo_form_heading(form, _("Ground"));
    ceduo_form_field(form, "slope.facets", NULL);
    if (d->file.scene.slope.reversed)
        ceduo_form_note(form, _("the profile is drawn upward: below, x of ground and points counts from its lower end"));
    if (!segments && !ceduo_document_node(d, "slope.materials"))
        ceduo_form_note(form, _("talus is assumed everywhere"));
    if (segments) {
        bool by_height = segments->n > 0 && ceduo_node_get(segments->items[0], "roughness_m");
        bool arm = d->file.scene.simulation.law == CEDUO_LAW_ARM; /* which knows mu, the others Rt */
        ceduo_form_table(
            form, "slope.segments", NULL,
            ceduo_app_format(app, "rn %s %s friction", arm ? "mu" : "rt", by_height ? "roughness_m" : "roughness_rad"));
    } else {
        ceduo_form_table(form, "slope.materials", NULL, "from_m to_m material");
    }
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

/* ---- the pictures ---- */

enum { PANE_FORM, PANE_ROCKS, PANES };

/* The picture alone where it has the focus, otherwise with the form below it. */
static void draw(struct app *app, struct ceduo_area area)
{
    ceduo_app_follow_rock(app);
    struct ceduo_span span;
    struct ceduo_picture picture = ceduo_app_picture(app);
    picture.span = &span;
    bool alone = ceduo_app_state(app)->pane != PANE_FORM;
    int form_height = alone ? 0 : area.height / 3;
    int room = area.height - form_height;
    int strips = room >= 24 ? 2 : room >= 13 ? 1 : 0;
    int strip = room >= 24 ? room / 4 : 5;
    if (alone)
        ceduo_app_hint(app, _("left, right: another rock; down, up: along its way; Tab: back to the form"));
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
    ceduo_app_draw_form(app, below);
}

/* In the picture left and right go from rock to rock, up and down along its trajectory. */
static const struct act rock_acts[] = {{ACTION_RIGHT, .function = ceduo_app_next_rock, .by = 1},
                                       {ACTION_LEFT, .function = ceduo_app_next_rock, .by = -1},
                                       {ACTION_DOWN, .function = ceduo_app_step_rock, .by = 1},
                                       {ACTION_UP, .function = ceduo_app_step_rock, .by = -1},
                                       {0}};

const struct view ceduo_view_slope = {.panes = PANES,
                                      .build = build,
                                      .draw = draw,
                                      .acts = {NULL, rock_acts},
                                      .bar = {{ACTION_EDIT, N_("edit")},
                                              {ACTION_ADD, N_("add")},
                                              {ACTION_DELETE, N_("delete")},
                                              {ACTION_NEXT_PANE, N_("picture")},
                                              {ACTION_NEXT_ROCK, N_("a rock")}}};
