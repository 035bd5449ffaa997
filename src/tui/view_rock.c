/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 3: the rock, how it starts, and how it is computed. */
#include <math.h>

#include "app.h"
#include "base/language.h"
#include "popups.h"

static void build(struct app *app, struct form *form)
{
    static const char *const sizes[][5] = {[CEDUO_SPHERE] = {"rock.shape", "rock.diameter_m", "rock.volume_m3"},
                                           [CEDUO_CYLINDER] = {"rock.shape", "rock.diameter_m", "rock.height_m"},
                                           [CEDUO_ELLIPSOID] = {"rock.shape", "rock.axes_m"},
                                           [CEDUO_BLOCK] = {"rock.shape", "rock.axes_m"}};
    static const char *const weight[] = {"rock.mass_kg", "rock.density_kg_m3", NULL};
    static const char *const release[] = {"release.x_m",    "release.height_m",   "release.vx_m_s",
                                          "release.vz_m_s", "release.spin_rad_s", NULL};
    static const char *const simulation[] = {"simulation.law",         "simulation.contact_model", "simulation.rule",
                                             "simulation.threshold_m", "simulation.scale_rn",      "simulation.gravity_m_s2",
                                             "simulation.seed",        "simulation.rocks",         NULL};
    static const char *const columns[] = {"per_year", "volume_m3", "exponent", NULL};
    static const char *const design[] = {"design.survey", "design.blocks", NULL};
    const struct document *d = &app->document;
    const struct object *scene = ceduo_schema_scene();
    ceduo_form_heading(form, _("Rock"));
    ceduo_form_fields(form, d, scene, "", sizes[d->file.scene.rock.shape]);
    ceduo_form_fields(form, d, scene, "", weight);
    ceduo_form_heading(form, _("Release"));
    ceduo_form_fields(form, d, scene, "", release);
    ceduo_form_rest(form, d, scene, "", "release");
    ceduo_form_heading(form, _("Simulation"));
    ceduo_form_fields(form, d, scene, "", simulation);
    ceduo_form_rest(form, d, scene, "", "simulation");
    const struct node *node = ceduo_document_node(d, "blocks"); /* a power law, or a list of classes */
    const struct object *blocks = ceduo_schema_field(scene, "blocks")->object;
    ceduo_form_heading(form, _("Blocks that come down"));
    if (node && node->kind == NODE_MAP)
        ceduo_form_fields(form, d, blocks, "blocks", columns);
    else
        ceduo_form_table(form, d, blocks, "blocks", columns, "");
    ceduo_form_fields(form, d, scene, "", design);
    ceduo_form_field(form, d, scene, "", "title", NULL);
    ceduo_form_heading(form, _("Head of the report"));
    ceduo_form_rest(form, d, scene, "", "page");
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

static const struct act acts[] = {{ACTION_PRESETS, ceduo_popup_starts, 0}, {0}};

const struct view ceduo_view_rock = {
    .title = NP_("view", "rock"),
    .panes = 1,
    .build = build,
    .draw = draw,
    .acts = {acts},
    .bar = {{ACTION_EDIT, N_("edit")}, {ACTION_MORE, N_("more")}, {ACTION_LESS, N_("less")}, {ACTION_PRESETS, N_("presets")}}};
