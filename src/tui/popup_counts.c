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

static const struct {
    const char *label;
    size_t count;     /* that it is the size of; of what was not counted none need be said */
    bool zero, empty; /* it may be that */
    const char *path; /* of a value of a file: what is unusual there is asked back */
} fields[COUNTS] = {
    [COUNT_AREA] = {N_("size of the plot, m2"), COUNTS, false, false, NULL},
    [COUNT_HOW] = {N_("measured along the slope or map"), COUNTS, true, true, NULL},
    [COUNT_ANGLE] = {N_("angle of the slope, degrees"), COUNTS, true, false, NULL},
    [COUNT_STOOLS] = {N_("stools counted"), COUNTS, true, true, NULL},
    [COUNT_SHOOTS] = {N_("shoots counted on them"), COUNTS, true, true, NULL},
    [COUNT_SHOOT_DBH] = {N_("their mean diameter, cm"), COUNT_SHOOTS, false, false, "forest[0].stand.shoots[0].dbh_m"},
    [COUNT_SHOOT_HEIGHT] = {N_("their mean height, m"), COUNT_SHOOTS, false, false, "forest[0].stand.shoots[0].height_m"},
    [COUNT_TREES] = {N_("single trees counted"), COUNTS, true, true, NULL},
    [COUNT_TREE_DBH] = {N_("their mean diameter, cm"), COUNT_TREES, false, false, "forest[0].stand.trees[0].dbh_m"},
    [COUNT_TREE_HEIGHT] = {N_("their mean height, m"), COUNT_TREES, false, false, "forest[0].stand.trees[0].height_m"}};

struct plot {
    double values[COUNTS]; /* as typed */
    double area, per;      /* m2, horizontal; per ha for each one that was counted */
};

/* ---- reading ---- */

static bool is_needed(const struct plot *plot, size_t i)
{
    return fields[i].count == COUNTS || plot->values[fields[i].count] > 0;
}

static bool read_plot(struct app *app, struct popup *p, struct plot *plot)
{
    double *v = plot->values;
    const char *how = p->fields[COUNT_HOW].text;
    bool along = strcmp(how, ALONG_SLOPE) == 0;
    for (size_t i = 0; i < COUNTS; i++) {
        const char *typed = p->fields[i].text;
        v[i] = 0;
        if (i == COUNT_HOW || (fields[i].empty && typed[0] == '\0') || !is_needed(plot, i))
            continue;
        if (!ceduo_popup_number(app, p, i, &v[i]))
            return false;
        if (!(v[i] > 0) && !(fields[i].zero && v[i] >= 0)) {
            ceduo_app_warn(app, fields[i].zero ? _("%s: %s is below 0") : _("%s: %s is not above 0"), p->labels[i], typed);
            return false;
        }
    }
    const char *wrong = v[COUNT_ANGLE] >= 90 ? _("the angle must be below 90 degrees")
                        : v[COUNT_SHOOTS] > 0 && v[COUNT_SHOOTS] < v[COUNT_STOOLS]
                            ? _("fewer shoots than stools: a stool has one shoot at least")
                        : (v[COUNT_SHOOTS] > 0) != (v[COUNT_STOOLS] > 0) ? _("stools and shoots belong together: count both")
                                                                         : NULL;
    if (!along && strcmp(how, ON_MAP) != 0)
        ceduo_app_warn(app, _("'%s': slope or map is wanted"), how);
    else if (wrong)
        ceduo_app_warn(app, "%s", wrong);
    else {
        plot->area = along ? v[COUNT_AREA] * cos(v[COUNT_ANGLE] * M_PI / 180) : v[COUNT_AREA];
        plot->per = 10000 / plot->area;
        return true;
    }
    return false;
}

/* What is so unusual that it is asked back; the same once more is taken. */
static bool is_usual(struct app *app, struct popup *p, const struct plot *plot)
{
    for (size_t i = 0; i < COUNTS; i++) {
        struct line *line = &p->fields[i];
        if (!fields[i].path || !is_needed(plot, i))
            continue;
        LOCAL_TEXT(why);
        const struct field *f = ceduo_schema_at(fields[i].path);
        bool good = ceduo_typed_in_range(f, line->text, &why);
        bool asked = good && !line->asked && ceduo_typed_unusual(f, line->text, &why);
        line->asked |= asked;
        if (why.bytes)
            ceduo_app_warn(app, "%s", why.bytes);
        if (!good || asked)
            return false;
    }
    return true;
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

static bool filled_counts(struct app *app, struct popup *p)
{
    struct plot plot;
    struct changes changes = {.d = &app->document}, *c = &changes;
    if (!read_plot(app, p, &plot) || !is_usual(app, p, &plot))
        return false;
    const struct ceduo_stand *now = &ceduo_app_option(app)->belts[app->belt].stand;
    const char *stools = ceduo_app_format(app, "%s.stools", p->path);
    if (plot.values[COUNT_STOOLS] > 0)
        ceduo_changes_add(c, "%s={per_ha: %.6g, spacing_m: %.10g}", stools, plot.values[COUNT_STOOLS] * plot.per,
                          now->stools_per_ha > 0 ? now->spacing : SPACING);
    else
        ceduo_changes_remove(c, stools);
    change_stems(c, ceduo_app_format(app, "%s.shoots", p->path), &plot, COUNT_SHOOTS);
    change_stems(c, ceduo_app_format(app, "%s.trees", p->path), &plot, COUNT_TREES);
    if (now->system == CEDUO_BARE)
        ceduo_changes_remove(c, ceduo_app_format(app, "%s.system", p->path));
    ceduo_changes_add(c, "%s.name=%s", p->path, _("sample plot"));
    bool good = ceduo_app_edited(app, ceduo_changes_make(c, _("counts of a plot"), &app->problems));
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
    const double offered[COUNTS] = {
        [COUNT_AREA] = 400,
        [COUNT_ANGLE] = round(atan2(fabs(fall), belt->to - belt->from) * 180 / M_PI),
        [COUNT_SHOOT_DBH] = stand->shoots_count ? stand->shoots[0].dbh * 100 : 0,
        [COUNT_SHOOT_HEIGHT] = stand->shoots_count ? stand->shoots[0].height : 0,
        [COUNT_TREE_DBH] = stand->trees_count ? stand->trees[0].dbh * 100 : 0,
        [COUNT_TREE_HEIGHT] = stand->trees_count ? stand->trees[0].height : 0,
    };
    for (size_t i = 0; i < COUNTS; i++)
        ceduo_popup_choice(p, _(fields[i].label),
                           i == COUNT_HOW   ? ALONG_SLOPE
                           : offered[i] > 0 ? ceduo_number_spoken(ceduo_app_format(app, "%.6g", offered[i]))
                                            : "",
                           i == COUNT_HOW ? offer_how : NULL);
}
