/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a plot's counts to hectares. */
#include <math.h>
#include <string.h>

#include "base/intl.h"
#include "popup.h"
#include "popups.h"

enum { COUNT_AREA, COUNT_SLOPE, COUNT_ANGLE, COUNT_STOOLS, COUNT_SHOOTS, COUNT_TREES };

static bool counts_of(struct app *app, struct popup *p, double values[6], bool *on_slope)
{
    for (size_t i = 0; i < 6; i++) {
        if (i == COUNT_SLOPE)
            continue;
        bool good = ceduo_number_read(p->fields[i].text, &values[i]) == CEDUO_NUMBER_GOOD && values[i] >= 0;
        if (!good) {
            ceduo_app_warn(app, _("%s: '%s' is not a number"), p->labels[i], p->fields[i].text);
            return false;
        }
    }
    const char *how = p->fields[COUNT_SLOPE].text;
    *on_slope = strcmp(how, _("slope")) == 0;
    if (!*on_slope && strcmp(how, _("horizontal")) != 0) {
        ceduo_app_warn(app, _("'%s': slope or horizontal is wanted"), how);
        return false;
    }
    if (!(values[COUNT_AREA] > 0) || values[COUNT_ANGLE] >= 90) {
        ceduo_app_warn(app, "%s", _("the size must be above 0, the angle below 90"));
        return false;
    }
    return true;
}

static bool filled_counts(struct app *app, struct popup *p)
{
    double v[6];
    bool on_slope;
    if (!counts_of(app, p, v, &on_slope))
        return false;
    double area = on_slope ? v[COUNT_AREA] * cos(v[COUNT_ANGLE] * M_PI / 180) : v[COUNT_AREA];
    double per = 10000 / area;
    const struct ceduo_stand *stand = &ceduo_app_option(app)->belts[app->belt].stand;
    char sets[3][FORM_PATH + 64];
    if (stand->shoots_count != 1 || stand->trees_count != 1) {
        ceduo_app_warn(app, _("the stand must have one cohort of shoots and one class of trees, not %zu and %zu"),
                       stand->shoots_count, stand->trees_count);
        return false;
    }
    snprintf(sets[0], sizeof sets[0], "%.160s.stools.per_ha=%.6g", p->path, v[COUNT_STOOLS] * per);
    snprintf(sets[1], sizeof sets[1], "%.160s.shoots[0].per_ha=%.6g", p->path, v[COUNT_SHOOTS] * per);
    snprintf(sets[2], sizeof sets[2], "%.160s.trees[0].per_ha=%.6g", p->path, v[COUNT_TREES] * per);
    const char *const list[] = {sets[0], sets[1], sets[2]};
    bool good = ceduo_document_set_all(&app->document, list, 3, _("counts of a plot"), &app->problems);
    if (ceduo_app_edited(app, good))
        ceduo_app_say(app, _("a plot of %.4g m2, horizontal: each stem counted stands for %.4g per ha"), area, per);
    return good;
}

void ceduo_popup_counts(struct app *app)
{
    if (ceduo_app_option(app)->belts_count == 0) {
        ceduo_app_say(app, "%s", _("there is no belt yet: a adds one in view 1"));
        return;
    }
    struct popup *p = ceduo_popup_fields(app, _("Stand from the counts of a sample plot"), filled_counts);
    if (!p)
        return;
    ceduo_app_stand(app, p->path, sizeof p->path);
    ceduo_text_put(&p->text, _("Densities are per horizontal hectare. A plot that was measured along the slope is smaller "
                               "than it seems: 400 m2 at 40 degrees are 306 m2."));
    ceduo_popup_field(p, _("size of the plot, m2"), "400");
    ceduo_popup_field(p, _("measured: slope or horizontal"), _("slope"));
    ceduo_popup_field(p, _("angle of the slope, degrees"), "35");
    ceduo_popup_field(p, _("stools counted"), "");
    ceduo_popup_field(p, _("shoots counted"), "");
    ceduo_popup_field(p, _("single trees counted"), "");
}
