/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new scene from a few questions. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "io/csv.h"
#include "io/file.h"
#include "popup.h"
#include "scene/choices.h"
#include "scene/material.h"
#include "scene/slope.h"
#include "view/plot.h"
#include "view/value_text.h"

enum { NEW_TITLE, NEW_PROFILE, NEW_RELEASE, NEW_FACE, NEW_MATERIAL, NEW_ROCK, NEW_CONTROL, NEW_ACCEPTED, NEW_STAND };

/* Answers of the fields. An empty place is the first or the last x. */
struct answers {
    struct text slope;         /* profile as YAML: "vertices_m: …", "csv: …" */
    struct scene_file profile; /* a scene with the profile only; reversed if it was drawn upward */
    const char *understood;    /* one line about the table of the profile; NULL: typed points */
    double first, last;        /* x of the profile */
    double release;            /* x where rocks start */
    double face;               /* end of the face; the first x without one */
    double rock, control, accepted;
};

static void free_answers(struct answers *a)
{
    ceduo_scene_release(&a->profile);
    ceduo_text_free(&a->slope);
}

static void append_scalar(struct text *yaml, const char *before, const char *value)
{
    ceduo_text_append(yaml, before);
    ceduo_emit_scalar(yaml, value, true);
}

/* ---- the profile ---- */

/* Build the profile as a separate scene; `extra_keys`: extra keys of the slope. */
static bool make_profile(struct answers *a, const char *extra_keys)
{
    LOCAL_TEXT(yaml);
    LOCAL_PROBLEMS(problems);
    ceduo_text_format(
        &yaml, "ceduo: scene/1\nrock: {diameter_m: 1}\ncontrols_m: [%.17g]\nslope:\n  %s\n  segments: [{rn: 0.3, rt: 0.8}]\n%s",
        a->last, a->slope.bytes, extra_keys);
    ceduo_scene_release(&a->profile);
    return ceduo_scene_load_text(&a->profile, "", yaml.bytes, &problems);
}

/* Read a CSV file or typed points. Reverse a profile that was drawn upward. */
static bool read_profile(struct app *app, struct popup *p, struct answers *a)
{
    const char *typed = p->fields[NEW_PROFILE].line.text, *wrong = NULL;
    LOCAL_PROBLEMS(problems);
    struct points points = {0};
    const char *mark = ceduo_picker_is_file(typed, p->endings) ? NULL : strrchr(typed, '#'); /* FILE.csv#LINE */
    const char *path = mark ? ceduo_check_memory(ceduo_arena_copy(&p->arena, typed, (size_t)(mark - typed))) : typed;
    if (ceduo_picker_is_file(path, p->endings)) {
        bool good = ceduo_csv_slope_read(&p->arena, path, mark ? mark + 1 : NULL, &points, &problems) && points.n > 1;
        const struct problem *first = problems.wrong.items;
        if (!good)
            wrong = points.lines           ? ceduo_arena_format(&p->arena, _("several lines: %s; add one to the name: %s#%.*s"),
                                                                points.lines, path, (int)strcspn(points.lines, ","), points.lines)
                    : problems.wrong.n > 0 ? ceduo_arena_format(&p->arena, "%s: %s", first->place, first->message)
                                           : _("a profile needs two points or more");
        a->understood = points.understood;
        a->first = good ? points.x[0] : 0;
        a->last = good ? points.x[points.n - 1] : 0;
        append_scalar(&a->slope, "csv: ", path);
        if (mark)
            append_scalar(&a->slope, "\n  layer: ", mark + 1);
    } else {
        ceduo_text_append(&a->slope, "vertices_m: ");
        if (!ceduo_input_parse_points(typed, &a->slope, &a->first, &a->last))
            wrong = _("the profile is a .csv file or points x z, x z, … with increasing x");
    }
    if (!wrong && !make_profile(a, "") && !make_profile(a, "  reversed: true\n"))
        wrong = _("two points of the profile are too close together");
    if (wrong)
        ceduo_app_warn(app, "%s", wrong);
    return !wrong;
}

/* Set a place, rounded to cm. */
static void set_place(struct popup *p, size_t field, double x)
{
    char buf[CEDUO_NUMBER_SIZE];
    ceduo_line_set(&p->fields[field].line, ceduo_format_number(NULL, round(x * 100) / 100, buf));
}

/* Propose the edge of the first face and its lower end, once for each profile. */
static void guess_face(struct popup *p, const struct answers *a)
{
    const struct ceduo_slope *s = &a->profile.scene.slope;
    const char *profile = p->fields[NEW_PROFILE].line.text;
    double edge = ceduo_slope_face(s);
    size_t end = isnan(edge) ? 0 : ceduo_slope_segment(s, edge);
    if (p->context && strcmp(p->context, profile) == 0) /* done for this profile */
        return;
    p->context = ceduo_arena_string(&p->arena, profile);
    while (end + 1 < s->vertices && ceduo_slope_fall(s, s->x[end]) > CEDUO_FACE_FALL)
        end++;
    set_place(p, NEW_RELEASE, isnan(edge) ? a->first : edge + s->origin_x);
    ceduo_line_set(&p->fields[NEW_FACE].line, "");
    if (!isnan(edge))
        set_place(p, NEW_FACE, s->x[end] + s->origin_x);
}

/* Return the steepest segment. */
static size_t find_steepest(const struct ceduo_slope *s)
{
    size_t steepest = 0;
    for (size_t j = 1; j + 1 < s->vertices; j++)
        if (ceduo_slope_fall(s, s->x[j]) > ceduo_slope_fall(s, s->x[steepest]))
            steepest = j;
    return steepest;
}

static double slope_degrees(const struct ceduo_slope *s, double x)
{
    return atan(ceduo_slope_fall(s, x)) * 180 / M_PI;
}

/* Describe the profile in the note over the fields. */
static void describe_profile(struct popup *p, const struct answers *a)
{
    const struct ceduo_slope *s = &a->profile.scene.slope;
    double x = s->x[find_steepest(s)];
    ceduo_text_free(&p->text);
    if (a->understood)
        ceduo_text_format(&p->text, "%s.", a->understood);
    else
        ceduo_text_format(&p->text, _("The profile is %.4g m long and falls by %.4g m."), s->x[s->vertices - 1],
                          -s->z[s->vertices - 1]);
    ceduo_text_append_joined(&p->text, " ", _("Steepest at %.4g m, %.0f\xc2\xb0."), x + s->origin_x, slope_degrees(s, x));
    if (s->reversed)
        ceduo_text_append_joined(&p->text, " ", "%s", _("Reversed."));
    if (a->release >= a->first && a->release < a->last)
        ceduo_text_append_joined(&p->text, " ", _("Rocks start at %.4g m, on %.0f\xc2\xb0."), a->release,
                                 slope_degrees(s, a->release - s->origin_x));
}

/* ---- reading ---- */

/* Read one field, or report an error. The fields before it are read. */
static bool read_field(struct app *app, struct popup *p, size_t field, struct answers *a)
{
    const char *typed = p->fields[field].line.text;
    double *const numbers[NEW_STAND + 1] = {[NEW_RELEASE] = &a->release,
                                            [NEW_FACE] = &a->face,
                                            [NEW_ROCK] = &a->rock,
                                            [NEW_CONTROL] = &a->control,
                                            [NEW_ACCEPTED] = &a->accepted};
    if (numbers[field]) {
        *numbers[field] = field == NEW_CONTROL ? a->last : field == NEW_ACCEPTED ? NAN : a->first;
        bool good = ceduo_popup_number(app, p, field, numbers[field]);
        if (good && field == NEW_FACE)
            p->fields[NEW_CONTROL].value->lo = fmax(a->release, a->face);
        return good;
    }
    static const size_t places[] = {NEW_RELEASE, NEW_FACE, NEW_CONTROL}; /* limited to the profile */
    if (field == NEW_PROFILE && !read_profile(app, p, a))
        return false;
    for (size_t i = 0; i < 3 && field == NEW_PROFILE; i++) {
        p->fields[places[i]].value->lo = a->first;
        p->fields[places[i]].value->hi = a->last;
    }
    bool ground = field != NEW_MATERIAL || ceduo_choice_find(&ceduo_material_words, typed) >= 0;
    bool stand =
        field != NEW_STAND || !typed[0] || ceduo_popup_is_measured(typed) || ceduo_file_find(&p->arena, typed, NULL, "stands");
    if (!ground || !stand)
        ceduo_app_warn(app,
                       stand ? _("no ground '%s' in the library")
                             : _("no stand '%s'; enter a file, a name such as simple-coppice, or nothing"),
                       typed);
    return ground && stand;
}

/* Read all fields up to `last`. */
static bool read_answers(struct app *app, struct popup *p, size_t last, struct answers *a)
{
    bool good = true;
    for (size_t i = NEW_TITLE; good && i <= last; i++)
        good = read_field(app, p, i, a);
    return good;
}

/* Check a field when leaving it, not after the last one. */
static bool validate_new(struct app *app, struct popup *p)
{
    struct answers a = {.release = NAN};
    bool good = read_answers(app, p, p->current, &a);
    if (good && p->current == NEW_PROFILE) {
        guess_face(p, &a);
        good = read_field(app, p, NEW_RELEASE, &a);
    }
    if (good && (p->current == NEW_PROFILE || p->current == NEW_RELEASE))
        describe_profile(p, &a);
    free_answers(&a);
    return good;
}

/* ---- the scene ---- */

/* Append a stretch of ground; for a reversed profile in the coordinates of its file. */
static void append_material(struct text *yaml, const struct ceduo_slope *s, double from, double to, const char *material)
{
    double a = ceduo_slope_mirrored(s, from), b = ceduo_slope_mirrored(s, to);
    ceduo_text_format(yaml, "    - {from_m: %.10g, to_m: %.10g", fmin(a, b), fmax(a, b));
    append_scalar(yaml, ", material: ", material);
    ceduo_text_append(yaml, "}\n");
}

static void append_scene(struct popup *p, const struct answers *a, struct text *yaml)
{
    const struct ceduo_slope *s = &a->profile.scene.slope;
    const char *stand = p->fields[NEW_STAND].line.text;
    bool face = a->face > a->first;
    append_scalar(yaml, "ceduo: scene/1\ntitle: ", p->fields[NEW_TITLE].line.text);
    ceduo_text_format(yaml, "\nrock: {diameter_m: %.10g}\nrelease: {x_m: %.10g}\nslope:\n  %s\n%s  materials:\n", a->rock,
                      a->release, a->slope.bytes, s->reversed ? "  reversed: true\n" : "");
    if (face && !s->reversed)
        append_material(yaml, s, a->first, a->face, "cliff");
    append_material(yaml, s, a->face, a->last,
                    ceduo_material_words.names[ceduo_choice_find(&ceduo_material_words, p->fields[NEW_MATERIAL].line.text)]);
    if (face && s->reversed)
        append_material(yaml, s, a->first, a->face, "cliff");
    ceduo_text_format(yaml, "controls:\n  - {x_m: %.10g", a->control);
    if (!isnan(a->accepted))
        ceduo_text_format(yaml, ", accepted_kJ: %.10g", a->accepted);
    ceduo_text_append(yaml, "}\n");
    if (stand[0]) {
        ceduo_text_format(yaml, "forest:\n  - {from_m: %.10g, to_m: %.10g", a->face, a->control);
        append_scalar(yaml, ", stand: ", ceduo_popup_is_measured(stand) ? "simple-coppice" : stand);
        ceduo_text_append(yaml, "}\n");
    }
}

static bool submit_new(struct app *app, struct popup *p)
{
    struct answers a = {.release = NAN};
    LOCAL_TEXT(yaml);
    bool good = read_answers(app, p, NEW_STAND, &a);
    if (good) {
        append_scene(p, &a, &yaml);
        good = ceduo_app_open(app, NULL, yaml.bytes);
    }
    free_answers(&a);
    if (good)
        ceduo_popup_ask_measured(app, p->fields[NEW_STAND].line.text);
    return good;
}

/* Mark a stretch of the slope in the lowest line of its picture, with its name. */
static void draw_stretch(struct app *app, const struct ceduo_area *area, const struct ceduo_span *span, double from, double to,
                         const char *name)
{
    int y = area->top + area->height - 1, right = span->left + span->width - 1;
    int a = span->left + (int)((from - span->x0) / (span->x1 - span->x0) * (span->width - 1));
    int b = span->left + (int)((to - span->x0) / (span->x1 - span->x0) * (span->width - 1));
    ceduo_cells_clear_area(app->cells, (struct ceduo_area){area->left, y, area->width, 1});
    for (int x = a; x <= b; x++)
        ceduo_app_draw_label(app, x, y, CEDUO_ROLE_AXIS, "%s",
                             x == a   ? "\xe2\x94\x9c"
                             : x == b ? "\xe2\x94\xa4"
                                      : "\xe2\x94\x80");
    int n = ceduo_cells_label_width(app->charset, name), x = b + 2 + n <= right ? b + 2 : a - 1 - n;
    ceduo_app_draw_label(app, x > area->left ? x : area->left, y, CEDUO_ROLE_AXIS, "%s", name);
}

#define PROFILE_MIN 6 /* lines */

/* Draw the profile as read: release, end of the face, control, and the steepest stretch below. */
static void draw_profile(struct app *app, struct popup *p, struct ceduo_area area)
{
    struct answers a = {.release = NAN};
    bool good = area.height >= PROFILE_MIN && p->current >= NEW_PROFILE &&
                read_answers(app, p, p->current == NEW_PROFILE ? NEW_PROFILE : NEW_RELEASE, &a);
    bool release_read = good && p->current > NEW_PROFILE;
    double face = release_read && read_field(app, p, NEW_FACE, &a) ? a.face - a.first : NAN;
    if (release_read && read_field(app, p, NEW_CONTROL, &a)) {
        a.profile.scene.controls[0].x = a.control - a.first;
        a.profile.scene.controls[0].x_given = a.control;
    }
    app->message[0] = '\0';
    if (good) {
        const struct ceduo_slope *s = &a.profile.scene.slope;
        size_t j = find_steepest(s);
        struct ceduo_span span = {0};
        if (!isnan(a.release))
            a.profile.scene.release.x.mean = a.release - a.first;
        ceduo_plot_draw(CEDUO_PLOT_PROFILE, &app->cells->canvas, &area,
                        &(struct ceduo_picture){.scene = &a.profile.scene, .mark = face > 0 ? &face : NULL, .span = &span});
        if (span.width > 0)
            draw_stretch(app, &area, &span, s->x[j], s->x[j + 1],
                         ceduo_app_format(app, _("steepest, %.0f\xc2\xb0"), slope_degrees(s, s->x[j])));
    }
    free_answers(&a);
}

static void ask_new_scene(struct app *app)
{
    char buf[CEDUO_NUMBER_SIZE];
    struct popup *p = ceduo_popup_fields(app, _("New scene"), "", submit_new);
    ceduo_text_append(&p->text, _("Profile: a CSV file (distance, elevation) or points x z, x z, … Empty fields are omitted; "
                                  "without a control rocks are counted at the end. Everything can be changed later."));
    p->endings = ".csv .txt";
    p->validate = validate_new;
    p->picture = draw_profile;
    ceduo_popup_add_field(p, _("title"), _("My slope"));
    ceduo_popup_add_choice(p, _("profile (CSV file or points)"), "0 90, 10 65, 60 30, 120 0", ceduo_popup_offer_files);
    ceduo_popup_add_value(p, _("rocks start at x, m"), "", ceduo_schema_at("release.x_m"))->flags = FIELD_UNDER;
    ceduo_popup_add_value(p, _("face from the top to x, m"), "", ceduo_schema_at("release.x_m"))->flags = FIELD_UNDER;
    ceduo_popup_add_choice(p, _("ground below it"), _(ceduo_material_talus()->name), ceduo_popup_offer_grounds);
    ceduo_popup_add_value(p, _("rock: diameter, m"), ceduo_format_number(NULL, 0.6, buf), ceduo_schema_at("rock.diameter_m"));
    ceduo_popup_add_value(p, _("control at x, m"), "", ceduo_schema_at("controls[0].x_m"))->flags = FIELD_ABOVE;
    ceduo_popup_add_value(p, _("limit, kJ"), "50", ceduo_schema_at("controls[0].accepted_kJ"));
    ceduo_popup_add_choice(p, _("stand"), "simple-coppice", ceduo_popup_offer_stands);
}

void ceduo_popup_new(struct app *app)
{
    ceduo_popup_confirm_unsaved(app, ask_new_scene);
}
