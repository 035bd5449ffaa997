/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new scene from a few fields. */
#include <stdio.h>
#include <string.h>

#include "base/intl.h"
#include "ceduo/material.h"
#include "io/emit.h"
#include "io/file.h"
#include "popup.h"
#include "popups.h"

enum { NEW_TITLE, NEW_PROFILE, NEW_MATERIAL, NEW_ROCK, NEW_CONTROL, NEW_ACCEPTED, NEW_STAND };

/* "0 120, 30 100, 60 95" as a list of vertices; false where it is none. */
static bool typed_vertices(const char *text, struct text *yaml, double *first, double *last)
{
    size_t n = 0;
    ceduo_text_put(yaml, "vertices_m: [");
    while (*text) {
        double x, z;
        int used = 0;
        if (sscanf(text, " %lf %lf%n", &x, &z, &used) != 2)
            return false;
        *first = n == 0 ? x : *first;
        *last = x;
        ceduo_text_format(yaml, "%s[%.10g, %.10g]", n++ ? ", " : "", x, z);
        text += used;
        text += strspn(text, " ,;");
    }
    ceduo_text_put(yaml, "]");
    return n >= 2;
}

static bool ends_in_csv(const char *name)
{
    size_t n = strlen(name);
    return n > 4 && strcmp(name + n - 4, ".csv") == 0;
}

/* What is typed into a field is that field's value alone: a number where one is wanted, otherwise a text. */
static bool numbers_typed(struct app *app, const struct popup *p)
{
    static const int numbers[] = {NEW_ROCK, NEW_CONTROL, NEW_ACCEPTED};
    double value;
    for (size_t i = 0; i < 3; i++) {
        const char *text = p->fields[numbers[i]].text;
        bool may_be_empty = numbers[i] == NEW_ACCEPTED && text[0] == '\0';
        if (!may_be_empty && ceduo_number_read(text, &value) != CEDUO_NUMBER_GOOD) {
            ceduo_app_warn(app, _("%s: '%s' is not a number; write a dot for the decimals"), p->labels[numbers[i]], text);
            return false;
        }
    }
    return true;
}

static bool stand_typed(struct app *app, struct popup *p)
{
    const char *stand = p->fields[NEW_STAND].text;
    if (stand[0] == '\0' || ceduo_file_find(&p->arena, stand, NULL, "stands"))
        return true;
    ceduo_app_warn(app, _("no stand '%s': a file, or a name such as simple-coppice; may be left empty"), stand);
    return false;
}

static bool filled_new(struct app *app, struct popup *p)
{
    struct text yaml = {0}, title = {0}, csv = {0}, material = {0}, stand = {0};
    const char *profile = p->fields[NEW_PROFILE].text;
    if (!numbers_typed(app, p) || !stand_typed(app, p))
        return false;
    ceduo_emit_scalar(&material, p->fields[NEW_MATERIAL].text, true);
    ceduo_emit_scalar(&stand, p->fields[NEW_STAND].text, true);
    ceduo_emit_scalar(&title, p->fields[NEW_TITLE].text, true);
    ceduo_emit_scalar(&csv, profile, true);
    ceduo_text_format(&yaml, "ceduo: scene/1\ntitle: %s\nrock: {diameter_m: %s}\nslope: {", title.bytes ? title.bytes : "x",
                      p->fields[NEW_ROCK].text);
    bool good = true;
    double first = -1e6, last = 1e6; /* of a file that is not read yet: wide enough */
    if (ends_in_csv(profile))
        ceduo_text_format(&yaml, "csv: %s", ceduo_text_string(&csv));
    else
        good = typed_vertices(profile, &yaml, &first, &last);
    ceduo_text_format(&yaml, ", materials: [{from_m: %.10g, to_m: %.10g, material: %s}]}\n", first, last,
                      material.bytes ? material.bytes : ceduo_material_talus()->name);
    ceduo_text_format(&yaml, "controls: [{x_m: %s", p->fields[NEW_CONTROL].text);
    if (p->fields[NEW_ACCEPTED].text[0])
        ceduo_text_format(&yaml, ", accepted_kJ: %s", p->fields[NEW_ACCEPTED].text);
    ceduo_text_put(&yaml, "}]\n");
    if (!good) {
        ceduo_app_warn(app, "%s", _("the profile: a file that ends in .csv, or points x z, x z, … with x rising"));
    } else {
        good = ceduo_app_open_text(app, ceduo_text_string(&yaml));
        char set[FORM_PATH + 64];
        const struct ceduo_slope *s = &app->document.file.scene.slope;
        if (good && p->fields[NEW_STAND].text[0]) {
            snprintf(set, sizeof set, "forest=[{from_m: %.10g, to_m: %.10g, stand: %.100s}]", s->origin_x,
                     app->document.file.scene.controls[0].x_given, stand.bytes ? stand.bytes : "bare");
            const char *const sets[] = {set};
            ceduo_app_edited(app, ceduo_document_set_all(&app->document, sets, 1, "forest", &app->problems));
        }
    }
    ceduo_text_free(&yaml);
    ceduo_text_free(&title);
    ceduo_text_free(&csv);
    ceduo_text_free(&material);
    ceduo_text_free(&stand);
    return good;
}

void ceduo_popup_new(struct app *app)
{
    if (ceduo_popup_unsaved(app))
        return;
    struct popup *p = ceduo_popup_fields(app, _("New scene"), filled_new);
    if (!p)
        return;
    ceduo_text_put(&p->text, _("The profile: a CSV file with distance and elevation, as QGIS writes it, or points typed as "
                               "x z, x z, … Everything can be changed later."));
    ceduo_popup_field(p, _("title"), _("My slope"));
    ceduo_popup_field(p, _("profile (CSV file or points)"), "0 60, 20 35, 60 20, 100 12");
    ceduo_popup_field(p, _("ground: talus, colluvium, cliff"), ceduo_material_talus()->name);
    ceduo_popup_field(p, _("rock: diameter, m"), "0.6");
    ceduo_popup_field(p, _("counted at x, m"), "90");
    ceduo_popup_field(p, _("that bears, kJ (may be empty)"), "50");
    ceduo_popup_field(p, _("stand on the whole way"), "simple-coppice");
}
