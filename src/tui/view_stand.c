/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 2: the stand of one belt: stools, cohorts of shoots, classes of trees, and a plan to scale. */
#include <math.h>

#include <stdio.h>

#include "app.h"
#include "base/language.h"
#include "core/runs/assess.h"
#include "scene/choices.h"
#include "scene/stand.h"
#include "view/words.h"

#define FIGURES 3 /* lines */

/* Add the fields of a group, with the number last: once it is set, the others are required. */
static void build_low(struct app *app, struct form *form, const char *group)
{
    const struct object *fields = ceduo_schema_row(group)->object;
    for (size_t i = 0; i < fields->n; i++)
        ceduo_form_field(form, ceduo_app_format(app, "%s.%s", group, fields->fields[(i + 1) % fields->n].key), NULL);
}

#define STEMS "dbh_m height_m volume_m3 dbh_sd_m"

static void build_stand(struct app *app, struct form *form)
{
    ceduo_form_table(form, ceduo_app_forest(app), NULL, "from_m to_m stand");
    const struct ceduo_belt *belt = ceduo_app_belt(app);
    if (!belt)
        return;
    const struct ceduo_stand *s = &belt->stand;
    const char *path = ceduo_app_stand(app), *prefix = ceduo_app_format(app, "%s.", path);
    ceduo_form_heading(form, ceduo_app_format(app, _("Stand of belt %zu: %.60s"), app->belt + 1, belt->name));
    ceduo_form_fields(form, prefix, "system species stools.per_ha");
    if (ceduo_stand_has_shoots(s) && (s->shoots_count > 1 || !(s->shoots[0].per_stool > 0))) /* no single field has it */
        ceduo_form_note(form, ceduo_app_format(app, _("%.4g shoots per stool"), ceduo_stand_shoots(s) / s->stools_per_ha));
    ceduo_form_fields(form, prefix, "stools.spacing_m");
    ceduo_form_rest(form, ceduo_app_format(app, "%s.stools", path));
    ceduo_form_heading(form, _("Shoots on the stools"));
    size_t per_stool_count = 0; /* cohorts with shoots per stool, per hectare, or both */
    for (size_t i = 0; i < s->shoots_count; i++)
        per_stool_count += s->shoots[i].per_stool > 0;
    ceduo_form_table(form, ceduo_app_format(app, "%s.shoots", path), NULL,
                     ceduo_app_format(app, "%s%s" STEMS, per_stool_count > 0 ? "per_stool " : "",
                                      per_stool_count == 0 || per_stool_count < s->shoots_count ? "per_ha " : ""));
    ceduo_form_heading(form, _("Single trees: standards, reserves"));
    ceduo_form_table(form, ceduo_app_format(app, "%s.trees", path), NULL, "per_ha " STEMS);
    double today = ceduo_stand_trees(s), stay = ceduo_stand_retained_per_ha(s);
    if (s->cutting.rotation > 0) /* apart from the trees of today: independent values */
        ceduo_form_fields(form, prefix, "cutting.stay_per_ha");
    if (s->cutting.rotation > 0 && fabs(today - stay) > 0.5)
        ceduo_form_note(form, ceduo_app_format(app, _("! today %g, after a cut %g"), today, stay));
    for (size_t i = 0; i < s->trees_count; i++) { /* radius first: a group requires it */
        const char *item = ceduo_app_format(app, "%s.trees[%zu].groups", path, i);
        ceduo_form_field(form, ceduo_app_format(app, "%s.radius_m", item),
                         ceduo_app_format(app, _("trees %zu: radius of a group, m"), i + 1));
        ceduo_form_field(form, ceduo_app_format(app, "%s.stems", item),
                         ceduo_app_format(app, _("trees %zu: stems per group"), i + 1));
    }
    ceduo_form_heading(form, _("Energy of a contact"));
    ceduo_form_fields(form, prefix, "energy.model energy.u_J_m3 energy.fracture_ratio energy.offset energy.hit_below_m");
    ceduo_form_rest(form, ceduo_app_format(app, "%s.energy", path));
    ceduo_form_heading(form, _("Stumps"));
    build_low(app, form, ceduo_app_format(app, "%s.stumps", path));
    ceduo_form_heading(form, _("Lying logs"));
    build_low(app, form, ceduo_app_format(app, "%s.logs", path));
    ceduo_form_fields(form, prefix, "name");
}

static void add_warning(void *text, const char *sentence)
{
    ceduo_text_format(text, "! %s\n", sentence);
}

/* Draw the figures of the stand below the form, with warnings above. Return the lines of the warnings. */
static int draw_figures(struct app *app, struct ceduo_area area)
{
    const struct ceduo_belt *belt = ceduo_app_belt(app);
    struct text text = {0}, unlikely = {0};
    if (!belt)
        return 0;
    struct ceduo_stand_result r = ceduo_assess_stand(&app->document.file.scene, belt);
    ceduo_words_implausible(belt, &r, add_warning, &unlikely);
    ceduo_words_thick_stems(belt, add_warning, &unlikely);
    int lines = unlikely.length > 0 ? ceduo_app_count_lines(app, unlikely.bytes, area.width) : 0;
    lines = lines > area.height / 3 ? area.height / 3 : lines;
    struct ceduo_area figures = cut_bottom(&area, FIGURES);
    ceduo_app_draw_text(app, cut_bottom(&area, lines), CEDUO_ROLE_WARN, &unlikely);
    ceduo_text_format(&text, _("%.0f stems/ha, basal area %.1f m2/ha."), r.stems_per_ha, r.basal_area);
    ceduo_text_append_char(&text, ' ');
    if (!r.bare)
        ceduo_text_format(&text, _("ADC %.3g m by %s (stools %.3g, stems %.3g, Eq. 6 %.3g, crofton %.3g)"), r.adc_m,
                          ceduo_words_law(ceduo_rule_words.names[r.rule]), r.adc.gsteiger_stools, r.adc.gsteiger_stems,
                          r.adc.interception, r.adc.crofton);
    if (!r.bare && !isnan(r.per_100m))
        ceduo_text_append_joined(&text, "; ", _("%.3g kJ per 100 m"), r.per_100m * J_TO_KJ);
    ceduo_app_draw_text(app, figures, CEDUO_ROLE_DIM, &text);
    return lines;
}

#define BOTH_MIN 18 /* lines for both the plan and the path of the rock */

/* Draw the stand from above, to scale. Below it, draw the stems that the rock met if there is space for both. */
static void draw_plan(struct app *app, struct ceduo_area area)
{
    struct ceduo_picture picture = ceduo_app_picture(app), pattern = picture;
    if (!ceduo_app_belt(app))
        return;
    if (picture.stems_count > 0 && area.height >= BOTH_MIN) {
        struct ceduo_area top = cut_top(&area, area.height * 3 / 5);
        pattern.stems = NULL;
        pattern.stems_count = 0;
        ceduo_plot_draw(CEDUO_PLOT_STAND, &app->cells->canvas, &top, &pattern);
        cut_top(&area, 1);
    }
    ceduo_plot_draw(CEDUO_PLOT_STAND, &app->cells->canvas, &area, &picture);
}

#define WIDE     80 /* columns for form and plan side by side */
#define WIDER    110
#define PLAN_MIN 32

static void draw_stand(struct app *app, struct ceduo_area area)
{
    ceduo_app_trace_rock(app);
    area.height -= draw_figures(app, area);
    bool wide = area.width >= WIDE;
    int plan = !wide ? 0 : area.width < WIDER ? PLAN_MIN : area.width / 2 - 1;
    struct ceduo_area form = {area.left, area.top, area.width - plan - wide, area.height - FIGURES};
    struct ceduo_area picture = {area.left + area.width - plan, area.top, plan, area.height - 4};
    if (!wide && area.height >= 30) { /* the plan below the form */
        form.height = area.height * 3 / 5;
        picture = (struct ceduo_area){area.left, area.top + form.height, area.width, area.height - form.height - 4};
    }
    ceduo_app_draw_form(app, form);
    if (picture.width > 0)
        draw_plan(app, picture);
}

const struct view ceduo_view_stand = {.panes = 1,
                                      .build = build_stand,
                                      .draw = draw_stand,
                                      .after_key = ceduo_app_sync_belt,
                                      .bar = {KEY(EDIT, N_("edit")), KEY(PRESETS, N_("stands")), KEY(COUNTS, N_("sample plot")),
                                              KEY(ADD, N_("add")), KEY(DELETE, N_("delete"))}};
