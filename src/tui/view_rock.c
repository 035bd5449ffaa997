/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 3: the rock, its release and the simulation. */
#include <math.h>
#include <string.h>

#include "app.h"
#include "base/language.h"

/* Add a power law or a list of classes. */
static void build_blocks(struct form *form, const struct node *blocks)
{
    static const char columns[] = "per_year volume_m3 exponent";
    ceduo_form_heading(form, _("Falling blocks"));
    if (blocks && blocks->kind == NODE_MAP)
        ceduo_form_fields(form, "blocks.", columns);
    else
        ceduo_form_table(form, "blocks", NULL, columns);
}

static void build_rock(struct app *app, struct form *form)
{
    static const char *const sizes[] = {[CEDUO_SHAPE_SPHERE] = "shape diameter_m volume_m3",
                                        [CEDUO_SHAPE_CYLINDER] = "shape diameter_m height_m",
                                        [CEDUO_SHAPE_ELLIPSOID] = "shape axes_m",
                                        [CEDUO_SHAPE_BLOCK] = "shape axes_m"};
    const struct node *blocks = ceduo_document_node(&app->document, "blocks");
    ceduo_form_heading(form, blocks ? _("Rock; sizes come from the blocks") : _("Rock"));
    ceduo_form_fields(form, "rock.", sizes[app->document.file.scene.rock.shape]);
    ceduo_form_fields(form, "rock.", "mass_kg density_kg_m3");
    if (blocks)
        build_blocks(form, blocks);
    const struct node *release = ceduo_document_node(&app->document, "release");
    ceduo_form_heading(form, _("Release"));
    if (release && release->kind == NODE_LIST) {
        ceduo_form_table(form, "release", NULL, "x_m share height_m vx_m_s vz_m_s spin_rad_s");
    } else {
        ceduo_form_fields(form, "release.", "x_m height_m vx_m_s vz_m_s spin_rad_s");
        ceduo_form_rest(form, "release");
    }
    ceduo_form_heading(form, _("Simulation"));
    ceduo_form_fields(form, "simulation.",
                      "law contact_model rule threshold_m scale_rn friction_bound gravity_m_s2 seed rocks");
    ceduo_form_rest(form, "simulation");
    if (!blocks)
        build_blocks(form, NULL);
    else
        ceduo_form_heading(form, _("Surveys and title"));
    ceduo_form_fields(form, "", "design.survey design.blocks design.gamma_e title");
    ceduo_form_heading(form, _("Head of the report"));
    ceduo_form_rest(form, "page");
}

#define WIDE       70 /* columns for a remark */
#define SLOPE_MIN  80 /* columns for the slope next to the form */
#define FORM_WIDTH 46

/* Draw the slope with the energies below it, next to the form, which gets the rest of the area. */
static void draw_trajectories(struct app *app, struct ceduo_area *area)
{
    struct ceduo_picture picture = ceduo_app_picture(app);
    struct ceduo_span span = {0};
    struct ceduo_area picture_area = {area->left + FORM_WIDTH + 2, area->top, area->width - FORM_WIDTH - 2, area->height};
    area->width = FORM_WIDTH;
    picture.span = &span;
    picture.bands = true;
    ceduo_app_draw_plot(app, CEDUO_PLOT_PROFILE, cut_top(&picture_area, picture_area.height * 3 / 5), &picture);
    ceduo_app_draw_plot(app, CEDUO_PLOT_ENERGY, picture_area, &picture);
}

static void draw_rock(struct app *app, struct ceduo_area area)
{
    struct ceduo_rock rock = ceduo_rock_mean(&app->document.file.scene.rock);
    struct text text = {0};
    if (isnan(rock.mass)) {
        ceduo_app_draw_form(app, area);
        return;
    }
    if (app->document.file.scene.blocks_count > 0)
        ceduo_text_format(&text, _("Sizes come from the blocks. ADC and index use one rock: %.4g kg, mean diameter B %.3g m."),
                          rock.mass, rock.mean_diameter);
    else
        ceduo_text_format(&text, _("%.4g kg, %.3g m3, mean diameter B %.3g m, moment %.3g kg m2."), rock.mass, rock.volume,
                          rock.mean_diameter, rock.moment);
    if (area.width >= WIDE && app->document.file.scene.simulation.law == CEDUO_LAW_LUMPED)
        ceduo_text_append_joined(&text, " ", "%s",
                                 _("The lumped law ignores mass and shape: on the ground they only scale the energy."));
    int lines = ceduo_app_count_lines(app, ceduo_text_string(&text), area.width);
    ceduo_app_draw_text(app, cut_bottom(&area, lines), CEDUO_ROLE_DIM, &text);
    cut_bottom(&area, 1);
    if (area.width >= SLOPE_MIN)
        draw_trajectories(app, &area);
    ceduo_app_draw_form(app, area);
}

/* Delete the class under the cursor, or the power law of all blocks. */
static void delete_blocks(struct app *app)
{
    const struct node *blocks = ceduo_document_node(&app->document, "blocks");
    const struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    if (!blocks || blocks->kind != NODE_MAP || !cell || strncmp(cell->path, "blocks.", 7) != 0)
        ceduo_items_delete(app);
    else if (ceduo_app_finish_edit(app, ceduo_document_delete(&app->document, "blocks")))
        ceduo_app_show_message(app, "%s", _("blocks deleted: all rocks are equal to the one above; u undoes"));
}

static const struct key_binding rock_view_bindings[] = {
    KEY(ADD, .plain = ceduo_items_add_blocks), KEY(DELETE, .plain = delete_blocks), {0}};

const struct view ceduo_view_rock = {
    .panes = 1,
    .build = build_rock,
    .draw = draw_rock,
    .bindings = {rock_view_bindings},
    .bar = {KEY(EDIT, N_("edit")), KEY(ADD, N_("blocks")), KEY(INCREASE, N_("increase")), KEY(DECREASE, N_("decrease"))}};
