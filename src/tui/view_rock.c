/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 3: the rock, how it starts, and how it is computed. */
#include <math.h>

#include "app.h"
#include "base/language.h"

static void add(struct app *app, struct form *form, const char *group, const char *key)
{
    const struct field *f = ceduo_schema_field(ceduo_schema_scene(), group);
    ceduo_form_field(form, &app->document, f->object, group, key, NULL);
}

/* What comes down: a power law, or a list of classes. */
static void build_blocks(struct app *app, struct form *form)
{
    static const char *const columns[] = {"per_year", "volume_m3", "exponent", NULL};
    const struct document *d = &app->document;
    const struct node *blocks = ceduo_document_node(d, "blocks");
    const struct object *object = ceduo_schema_field(ceduo_schema_scene(), "blocks")->object;
    ceduo_form_heading(form, _("Blocks that come down"));
    if (blocks && blocks->kind == NODE_MAP)
        for (size_t i = 0; columns[i]; i++)
            ceduo_form_field(form, d, object, "blocks", columns[i], NULL);
    else
        ceduo_form_table(form, d, object, "blocks", columns, "");
    add(app, form, "design", "survey");
    add(app, form, "design", "blocks");
}

static void build(struct app *app, struct form *form)
{
    enum ceduo_shape shape = app->document.file.scene.rock.shape;
    bool round = shape == CEDUO_SPHERE || shape == CEDUO_CYLINDER;
    ceduo_form_heading(form, _("Rock"));
    add(app, form, "rock", "shape");
    if (round)
        add(app, form, "rock", "diameter_m");
    if (shape == CEDUO_CYLINDER)
        add(app, form, "rock", "height_m");
    if (!round)
        add(app, form, "rock", "axes_m");
    if (shape == CEDUO_SPHERE)
        add(app, form, "rock", "volume_m3");
    add(app, form, "rock", "mass_kg");
    add(app, form, "rock", "density_kg_m3");
    ceduo_form_heading(form, _("Release"));
    add(app, form, "release", "x_m");
    add(app, form, "release", "height_m");
    add(app, form, "release", "vx_m_s");
    add(app, form, "release", "vz_m_s");
    add(app, form, "release", "spin_rad_s");
    ceduo_form_rest(form, &app->document, ceduo_schema_scene(), "", "release");
    ceduo_form_heading(form, _("Simulation"));
    add(app, form, "simulation", "law");
    add(app, form, "simulation", "contact_model");
    add(app, form, "simulation", "rule");
    add(app, form, "simulation", "threshold_m");
    add(app, form, "simulation", "scale_rn");
    add(app, form, "simulation", "gravity_m_s2");
    add(app, form, "simulation", "seed");
    add(app, form, "simulation", "rocks");
    ceduo_form_rest(form, &app->document, ceduo_schema_scene(), "", "simulation");
    build_blocks(app, form);
    ceduo_form_field(form, &app->document, ceduo_schema_scene(), "", "title", NULL);
}

#define WIDE 70 /* columns that leave room for a remark */

static void draw(struct app *app, struct ceduo_area area)
{
    struct ceduo_rock rock = ceduo_rock_mean(&app->document.file.scene.rock);
    struct text text = {0};
    if (isnan(rock.mass)) {
        ceduo_app_draw_form(app, area, true);
        return;
    }
    ceduo_text_format(&text, _("%.4g kg, %.3g m3, mean diameter B %.3g m, moment %.3g kg m2."), rock.mass, rock.volume,
                      rock.mean_diameter, rock.moment);
    if (area.width >= WIDE && app->document.file.scene.simulation.law == CEDUO_LAW_LUMPED)
        ceduo_text_then(&text, " ", "%s",
                        _("The lumped law knows neither mass nor shape: on the ground they scale the "
                          "energy alone."));
    int lines = ceduo_app_text_lines(app, ceduo_text_string(&text), area.width);
    ceduo_app_draw_form(app, (struct ceduo_area){area.left, area.top, area.width, area.height - lines - 1}, true);
    struct ceduo_area foot = {area.left, area.top + area.height - lines, area.width, lines};
    ceduo_app_put(app, foot, CEDUO_ROLE_DIM, &text);
}

const struct view ceduo_view_rock = {
    .title = NP_("view", "rock"),
    .panes = 1,
    .build = build,
    .draw = draw,
    .bar = {{ACTION_EDIT, N_("edit")}, {ACTION_MORE, N_("more")}, {ACTION_LESS, N_("less")}, {ACTION_PRESETS, N_("presets")}}};
