/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new scene from a few questions. */
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "ceduo/material.h"
#include "io/derive.h"
#include "io/emit.h"
#include "io/file.h"
#include "popup.h"
#include "popups.h"
#include "scene/words.h"
#include "view/typed.h"

enum { NEW_TITLE, NEW_PROFILE, NEW_FACE, NEW_MATERIAL, NEW_ROCK, NEW_CONTROL, NEW_ACCEPTED, NEW_STAND };

/* What the fields say, numbers read. */
struct answers {
    struct text slope;        /* the profile as YAML: "vertices_m: …", "csv: …" */
    double first, last;       /* x of the profile */
    double face;              /* where the face ends; the first x without one */
    double rock, control, accepted;
    bool has_accepted, counted;
};

/* ---- reading ---- */

static bool ends_in_csv(const char *name)
{
    size_t n = strlen(name);
    return n > 4 && strcmp(name + n - 4, ".csv") == 0;
}

static bool read_csv(struct app *app, struct popup *p, const char *path, struct answers *a)
{
    struct problems problems = {0};
    struct points points = {0};
    bool good = ceduo_csv_slope_read(&p->arena, path, &points, &problems) && points.n > 1;
    if (good) {
        a->first = points.x[0];
        a->last = points.x[points.n - 1];
        ceduo_text_put(&a->slope, "csv: ");
        ceduo_emit_scalar(&a->slope, path, true);
    } else {
        const char *why = problems.text.bytes ? problems.text.bytes : _("a profile needs two points or more");
        ceduo_app_warn(app, "%.*s", (int)strcspn(why, "\n"), why);
    }
    ceduo_problems_free(&problems);
    return good;
}

static bool read_profile(struct app *app, struct popup *p, struct answers *a)
{
    const char *typed = p->fields[NEW_PROFILE].text;
    if (ends_in_csv(typed))
        return read_csv(app, p, typed, a);
    ceduo_text_put(&a->slope, "vertices_m: ");
    if (ceduo_typed_points(typed, &a->slope, &a->first, &a->last))
        return true;
    ceduo_app_warn(app, "%s", _("the profile: a file that ends in .csv, or points x z, x z, … with x rising"));
    return false;
}

/* A number, or `otherwise` where the field is empty. */
static bool read_number(struct app *app, const struct popup *p, size_t field, double otherwise, double *value)
{
    *value = otherwise;
    return p->fields[field].text[0] == '\0' || ceduo_popup_number(app, p, field, value);
}

static bool read_stand(struct app *app, struct popup *p, struct answers *a)
{
    const char *stand = p->fields[NEW_STAND].text;
    a->counted = strcmp(stand, STAND_COUNTED) == 0;
    if (a->counted || stand[0] == '\0' || ceduo_file_find(&p->arena, stand, NULL, "stands"))
        return true;
    ceduo_app_warn(app, _("no stand '%s': a file, or a name such as simple-coppice; may be left empty"), stand);
    return false;
}

static bool read_face(struct app *app, const struct popup *p, struct answers *a)
{
    if (!read_number(app, p, NEW_FACE, a->first, &a->face))
        return false;
    if (a->face >= a->first && a->face < a->last)
        return true;
    ceduo_app_warn(app, _("the face ends at %g m, outside the profile from %g to %g m"), a->face, a->first, a->last);
    return false;
}

static bool read_control(struct app *app, const struct popup *p, struct answers *a)
{
    if (!read_number(app, p, NEW_CONTROL, a->last, &a->control))
        return false;
    if (a->control > a->first && a->control > a->face && a->control <= a->last)
        return true;
    ceduo_app_warn(app, _("counted at %g m, outside the slope below the face, %g to %g m"), a->control, a->face,
                   a->last);
    return false;
}

static bool read_rock(struct app *app, const struct popup *p, struct answers *a)
{
    struct text why = {0};
    bool good = ceduo_popup_number(app, p, NEW_ROCK, &a->rock);
    if (good && !ceduo_typed_in_range(ceduo_schema_at("rock.diameter_m"), p->fields[NEW_ROCK].text, &why)) {
        ceduo_app_warn(app, "%s", ceduo_text_string(&why));
        good = false;
    }
    ceduo_text_free(&why);
    return good;
}

static bool read_material(struct app *app, const struct popup *p)
{
    const char *ground = p->fields[NEW_MATERIAL].text;
    if (ceduo_choice_find(&ceduo_material_words, ground) >= 0)
        return true;
    ceduo_app_warn(app, _("no ground '%s' in the library"), ground);
    return false;
}

/* All fields up to one. */
static bool read_answers(struct app *app, struct popup *p, size_t upto, struct answers *a)
{
    a->has_accepted = p->fields[NEW_ACCEPTED].text[0] != '\0';
    return (upto < NEW_PROFILE || read_profile(app, p, a)) && (upto < NEW_FACE || read_face(app, p, a)) &&
           (upto < NEW_MATERIAL || read_material(app, p)) && (upto < NEW_ROCK || read_rock(app, p, a)) &&
           (upto < NEW_CONTROL || read_control(app, p, a)) &&
           (upto < NEW_ACCEPTED || read_number(app, p, NEW_ACCEPTED, 0, &a->accepted)) &&
           (upto < NEW_STAND || read_stand(app, p, a));
}

/* What is wrong is said at its question, not after the last one. */
static bool check_new(struct app *app, struct popup *p, size_t field)
{
    struct answers a = {.slope = {0}};
    bool good = read_answers(app, p, field, &a);
    ceduo_text_free(&a.slope);
    return good;
}

/* ---- the scene ---- */

static void put_quoted(struct text *yaml, const char *before, const char *value)
{
    ceduo_text_put(yaml, before);
    ceduo_emit_scalar(yaml, value, true);
}

static void put_scene(struct popup *p, const struct answers *a, struct text *yaml)
{
    put_quoted(yaml, "ceduo: scene/1\ntitle: ", p->fields[NEW_TITLE].text);
    ceduo_text_format(yaml, "\nrock: {diameter_m: %.10g}\nslope:\n  %s\n  materials:\n", a->rock,
                      ceduo_text_string(&a->slope));
    if (a->face > a->first)
        ceduo_text_format(yaml, "    - {from_m: %.10g, to_m: %.10g, material: cliff}\n", a->first, a->face);
    ceduo_text_format(yaml, "    - {from_m: %.10g, to_m: %.10g", a->face, a->last);
    put_quoted(yaml, ", material: ", p->fields[NEW_MATERIAL].text);
    ceduo_text_format(yaml, "}\ncontrols:\n  - {x_m: %.10g", a->control);
    if (a->has_accepted)
        ceduo_text_format(yaml, ", accepted_kJ: %.10g", a->accepted);
    ceduo_text_put(yaml, "}\n");
    const char *stand = a->counted ? "simple-coppice" : p->fields[NEW_STAND].text;
    if (!stand[0])
        return;
    ceduo_text_format(yaml, "forest:\n  - {from_m: %.10g, to_m: %.10g", a->face, a->control);
    put_quoted(yaml, ", stand: ", stand);
    ceduo_text_put(yaml, "}\n");
}

static bool filled_new(struct app *app, struct popup *p)
{
    struct answers a = {.slope = {0}};
    struct text yaml = {0};
    bool good = read_answers(app, p, NEW_STAND, &a);
    if (good) {
        put_scene(p, &a, &yaml);
        good = ceduo_app_open_text(app, ceduo_text_string(&yaml));
    }
    ceduo_text_free(&yaml);
    ceduo_text_free(&a.slope);
    if (good && a.counted)
        ceduo_popup_counts(app);
    return good;
}

static void offer_profiles(struct app *app, struct popup *p, const char *typed)
{
    (void)app;
    ceduo_picker_add_files(&p->picker, typed, ".csv");
}

static void ask(struct app *app)
{
    struct popup *p = ceduo_popup_fields(app, _("New scene"), filled_new);
    if (!p)
        return;
    ceduo_text_put(&p->text, _("The profile: a CSV file (distance, elevation), or points typed as x z, x z, … What is "
                               "left empty is not there; rocks are then counted at the end. All can be changed later."));
    p->endings = ".csv";
    p->check = check_new;
    ceduo_popup_field(p, _("title"), _("My slope"));
    ceduo_popup_choice(p, _("profile (CSV file or points)"), "0 60, 20 35, 60 20, 100 12", offer_profiles);
    ceduo_popup_field(p, _("face from the top to x, m"), "");
    ceduo_popup_choice(p, _("ground below it"), ceduo_material_talus()->name, ceduo_popup_offer_grounds);
    ceduo_popup_field(p, _("rock: diameter, m"), "0.6");
    ceduo_popup_field(p, _("counted at x, m"), "");
    ceduo_popup_field(p, _("the place withstands, kJ"), "50");
    ceduo_popup_choice(p, _("stand on the way"), "simple-coppice", ceduo_popup_offer_stands);
}

void ceduo_popup_new(struct app *app)
{
    ceduo_popup_once_saved(app, ask);
}
