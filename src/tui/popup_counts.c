/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stand from what a sample plot counts and measures. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "model/changes.h"
#include "popup.h"
#include "popups.h"
#include "view/typed.h"

/* Numbers but for COUNT_HOW. */
enum {
    COUNT_AREA,
    COUNT_HOW,
    COUNT_ANGLE,
    COUNT_STOOLS,
    COUNT_SHOOTS,
    COUNT_SHOOT_DBH,
    COUNT_SHOOT_HEIGHT,
    COUNT_TREES,
    COUNT_TREE_DBH,
    COUNT_TREE_HEIGHT,
    COUNTS
};

#define ALONG_SLOPE "slope"
#define ON_MAP      "map"

struct plot {
    double values[COUNTS]; /* as typed */
    double area, per;      /* m2, horizontal; per ha for each one that was counted */
};

/* ---- reading ---- */

/* Sizes of what was not counted need not be said. */
static bool is_needed(const struct plot *plot, size_t field)
{
    if (field == COUNT_SHOOT_DBH || field == COUNT_SHOOT_HEIGHT)
        return plot->values[COUNT_SHOOTS] > 0;
    if (field == COUNT_TREE_DBH || field == COUNT_TREE_HEIGHT)
        return plot->values[COUNT_TREES] > 0;
    return true;
}

static bool read_number(struct app *app, const struct popup *p, struct plot *plot, size_t field)
{
    bool count = field == COUNT_STOOLS || field == COUNT_SHOOTS || field == COUNT_TREES;
    bool empty = p->fields[field].text[0] == '\0';
    plot->values[field] = 0;
    if ((count && empty) || !is_needed(plot, field))
        return true;
    if (!ceduo_popup_number(app, p, field, &plot->values[field]))
        return false;
    double value = plot->values[field];
    bool good = count || field == COUNT_ANGLE ? value >= 0 : value > 0;
    if (!good)
        ceduo_app_warn(app, count || field == COUNT_ANGLE ? _("%s: %s is below 0") : _("%s: %s is not above 0"),
                       p->labels[field], p->fields[field].text);
    return good;
}

/* What is so unusual that it is asked back; the same once more is taken. */
static bool is_usual(struct app *app, struct popup *p, const struct plot *plot)
{
    static const struct {
        size_t field;
        const char *path;
    } sizes[] = {{COUNT_SHOOT_DBH, "forest[0].stand.shoots[0].dbh_m"},
                 {COUNT_SHOOT_HEIGHT, "forest[0].stand.shoots[0].height_m"},
                 {COUNT_TREE_DBH, "forest[0].stand.trees[0].dbh_m"},
                 {COUNT_TREE_HEIGHT, "forest[0].stand.trees[0].height_m"}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        struct text why = {0};
        struct line *line = &p->fields[sizes[i].field];
        const struct field *f = ceduo_schema_at(sizes[i].path);
        bool needed = is_needed(plot, sizes[i].field), good = !needed || ceduo_typed_in_range(f, line->text, &why);
        bool asked = good && needed && !line->asked && ceduo_typed_unusual(f, line->text, &why);
        line->asked |= asked;
        if (why.bytes)
            ceduo_app_warn(app, "%s", why.bytes);
        ceduo_text_free(&why);
        if (!good || asked)
            return false;
    }
    return true;
}

static bool read_plot(struct app *app, struct popup *p, struct plot *plot)
{
    for (size_t i = 0; i < COUNTS; i++)
        if (i != COUNT_HOW && !read_number(app, p, plot, i))
            return false;
    const char *how = p->fields[COUNT_HOW].text;
    bool along = strcmp(how, ALONG_SLOPE) == 0;
    const double *v = plot->values;
    if (!along && strcmp(how, ON_MAP) != 0)
        ceduo_app_warn(app, _("'%s': slope or map is wanted"), how);
    else if (v[COUNT_ANGLE] >= 90)
        ceduo_app_warn(app, "%s", _("the angle must be below 90 degrees"));
    else if (v[COUNT_SHOOTS] > 0 && v[COUNT_SHOOTS] < v[COUNT_STOOLS])
        ceduo_app_warn(app, "%s", _("fewer shoots than stools: a stool has one shoot at least"));
    else if ((v[COUNT_SHOOTS] > 0) != (v[COUNT_STOOLS] > 0))
        ceduo_app_warn(app, "%s", _("stools and shoots belong together: count both"));
    else {
        plot->area = along ? v[COUNT_AREA] * cos(v[COUNT_ANGLE] * M_PI / 180) : v[COUNT_AREA];
        plot->per = 10000 / plot->area;
        return is_usual(app, p, plot);
    }
    return false;
}

/* ---- the stand ---- */

#define SPACING 0.35 /* m, where the stand had no stools yet: assumed as in the presets */

/* One class of stems in the place of those that stand there, or none. */
static void change_stems(struct changes *c, const char *path, const struct plot *plot, size_t count)
{
    const double *v = &plot->values[count];
    if (v[0] > 0)
        ceduo_changes_add(c, "%s=[{per_ha: %.6g, dbh_m: %.10g, height_m: %.10g}]", path, v[0] * plot->per, v[1] / 100, v[2]);
    else
        ceduo_changes_remove(c, path);
}

static void change_stand(struct app *app, struct changes *c, const char *stand, const struct plot *plot)
{
    const struct ceduo_stand *now = &ceduo_app_option(app)->belts[app->belt].stand;
    const char *stools = ceduo_app_format(app, "%s.stools", stand);
    if (plot->values[COUNT_STOOLS] > 0)
        ceduo_changes_add(c, "%s={per_ha: %.6g, spacing_m: %.10g}", stools, plot->values[COUNT_STOOLS] * plot->per,
                          now->stools_per_ha > 0 ? now->spacing : SPACING);
    else
        ceduo_changes_remove(c, stools);
    change_stems(c, ceduo_app_format(app, "%s.shoots", stand), plot, COUNT_SHOOTS);
    change_stems(c, ceduo_app_format(app, "%s.trees", stand), plot, COUNT_TREES);
    if (now->system == CEDUO_BARE)
        ceduo_changes_remove(c, ceduo_app_format(app, "%s.system", stand));
    ceduo_changes_add(c, "%s.name=%s", stand, _("sample plot"));
}

static bool filled_counts(struct app *app, struct popup *p)
{
    struct plot plot;
    struct changes changes = {.d = &app->document};
    if (!read_plot(app, p, &plot))
        return false;
    change_stand(app, &changes, p->path, &plot);
    bool good = ceduo_app_edited(app, ceduo_changes_make(&changes, _("counts of a plot"), &app->problems));
    if (good)
        ceduo_app_say(app, _("a plot of %.4g m2, horizontal: each stem counted stands for %.4g per ha"), plot.area, plot.per);
    return good;
}

/* ---- asking ---- */

static void offer_how(struct app *app, struct popup *p, const char *typed)
{
    (void)app;
    (void)typed;
    ceduo_popup_item(p, _("slope: the tape lay on the ground"), ALONG_SLOPE);
    ceduo_popup_item(p, _("map: horizontal"), ON_MAP);
}

static void field_number(struct app *app, const char *label, double value)
{
    ceduo_popup_field(app->popup, label, value > 0 ? ceduo_app_format(app, "%.6g", value) : "");
}

void ceduo_popup_counts(struct app *app)
{
    if (ceduo_app_option(app)->belts_count == 0) {
        ceduo_app_say(app, "%s", _("there is no belt yet: a adds one in view 1"));
        return;
    }
    const struct ceduo_belt *belt = &ceduo_app_option(app)->belts[app->belt];
    const struct ceduo_stand *stand = &belt->stand;
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    double fall = ceduo_slope_height(s, belt->from) - ceduo_slope_height(s, belt->to);
    struct popup *p = ceduo_popup_fields(app, _("Stand from the counts of a sample plot"), filled_counts);
    snprintf(p->path, sizeof p->path, "%s", ceduo_app_stand(app));
    ceduo_text_format(&p->text,
                      _("Densities are per horizontal hectare: 400 m2 along a slope of 40 degrees are 306 m2. "
                        "Nothing counted is nothing there. Species, growth and cuts stay those of %s."),
                      belt->name);
    field_number(app, _("size of the plot, m2"), 400);
    ceduo_popup_choice(p, _("measured along the slope or map"), ALONG_SLOPE, offer_how);
    field_number(app, _("angle of the slope, degrees"), round(atan2(fabs(fall), belt->to - belt->from) * 180 / M_PI));
    ceduo_popup_field(p, _("stools counted"), "");
    ceduo_popup_field(p, _("shoots counted on them"), "");
    field_number(app, _("their mean diameter, cm"), stand->shoots_count ? stand->shoots[0].dbh * 100 : 0);
    field_number(app, _("their mean height, m"), stand->shoots_count ? stand->shoots[0].height : 0);
    ceduo_popup_field(p, _("single trees counted"), "");
    field_number(app, _("their mean diameter, cm"), stand->trees_count ? stand->trees[0].dbh * 100 : 0);
    field_number(app, _("their mean height, m"), stand->trees_count ? stand->trees[0].height : 0);
}
