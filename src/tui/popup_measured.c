/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A measured stand: from counts on a sample plot, or from a survey in a CSV file. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "core/stand/rotation.h"
#include "io/file.h"
#include "io/survey_file.h"
#include "popup.h"

/* ==== a sample plot ==== */

enum { AREA, ANGLE, STOOLS, SHOOTS, SHOOT_DBH, SHOOT_HEIGHT, TREES, TREE_DBH, TREE_HEIGHT, COUNTS };
_Static_assert(COUNTS <= POPUP_FIELDS_MAX, "one popup asks for all counts");

static const struct {
    const char *label;
    size_t count;     /* row of the count of these stems; ignored without a count */
    const char *path; /* path of a value with its range; NULL: the members below */
    double max;
    unsigned flags;
    const char *meaning;
} count_rows[COUNTS] = {
    [AREA] = {N_("size of the plot, m2"), COUNTS, NULL, 1e6, FIELD_REQUIRED | FIELD_ABOVE,
              N_("the area on which stems were counted")},
    [ANGLE] = {N_("angle of the slope, degrees"), COUNTS, NULL, 90, FIELD_REQUIRED | FIELD_UNDER, N_("0 on level ground")},
    [STOOLS] = {N_("stools counted"), COUNTS, NULL, 1e6, 0, NULL},
    [SHOOTS] = {N_("shoots counted on them"), COUNTS, NULL, 1e6, 0, NULL},
    [SHOOT_DBH] = {N_("their mean diameter, cm"), SHOOTS, "forest[0].stand.shoots[0].dbh_m", 0, 0, NULL},
    [SHOOT_HEIGHT] = {N_("their mean height, m"), SHOOTS, "forest[0].stand.shoots[0].height_m", 0, 0, NULL},
    [TREES] = {N_("single trees counted"), COUNTS, NULL, 1e6, 0, NULL},
    [TREE_DBH] = {N_("their mean diameter, cm"), TREES, "forest[0].stand.trees[0].dbh_m", 0, 0, NULL},
    [TREE_HEIGHT] = {N_("their mean height, m"), TREES, "forest[0].stand.trees[0].height_m", 0, 0, NULL}};

/* Read the values in units of files. Return false and report if one is invalid. */
static bool read_plot(struct app *app, struct popup *p, double v[COUNTS])
{
    const char *wrong = NULL;
    for (size_t i = 0; i < COUNTS; i++) {
        bool sized = count_rows[i].count != COUNTS;
        v[i] = 0;
        if (sized && !(v[count_rows[i].count] > 0))
            continue;
        if (!ceduo_popup_number(app, p, i, &v[i]))
            return false;
        if (sized && v[i] == 0)
            wrong =
                ceduo_app_format(app, _("%s: required; %s"), _(count_rows[i].label), _(count_rows[count_rows[i].count].label));
    }
    if (v[SHOOTS] > 0 && v[SHOOTS] < v[STOOLS])
        wrong = _("fewer shoots than stools: each stool has at least one shoot");
    else if ((v[SHOOTS] > 0) != (v[STOOLS] > 0))
        wrong = _("stools and shoots belong together: count both");
    if (wrong)
        ceduo_app_warn(app, "%s", wrong);
    return !wrong;
}

#define SPACING 0.35 /* m; for a stand without stools: assumed as in the presets */

static bool submit_counts(struct app *app, struct popup *p)
{
    double v[COUNTS];
    struct changes changes = {.document = &app->document}, *c = &changes;
    if (!read_plot(app, p, v))
        return false;
    double area = v[AREA] * cos(v[ANGLE] * M_PI / 180), per = 10000 / area; /* m2, horizontal */
    const struct ceduo_stand *current = &ceduo_app_belt(app)->stand;
    const char *stools = ceduo_app_format(app, "%s.stools", p->target);
    if (v[STOOLS] > 0)
        ceduo_changes_set(c, stools, "{per_ha: %.6g, spacing_m: %.10g}", v[STOOLS] * per,
                          current->stools_per_ha > 0 ? current->spacing : SPACING);
    else
        ceduo_changes_add(c, CHANGE_DELETE, stools, NULL);
    for (int i = 0; i < 2; i++) { /* replace all stems by one class, or remove them */
        const double *stems = &v[i == 0 ? SHOOTS : TREES];
        const char *list = ceduo_app_format(app, "%s.%s", p->target, i == 0 ? "shoots" : "trees");
        if (stems[0] > 0)
            ceduo_changes_set(c, list, "[{per_ha: %.6g, dbh_m: %.10g, height_m: %.10g}]", stems[0] * per, stems[1], stems[2]);
        else
            ceduo_changes_add(c, CHANGE_DELETE, list, NULL);
    }
    if (current->system == CEDUO_SYSTEM_BARE)
        ceduo_changes_add(c, CHANGE_DELETE, ceduo_app_format(app, "%s.system", p->target), NULL);
    ceduo_changes_set(c, ceduo_app_format(app, "%s.name", p->target), "%s", ceduo_app_scalar(app, _("sample plot")));
    bool good = ceduo_app_finish_edit(app, ceduo_changes_apply(c, _("counts of a plot")));
    if (good)
        ceduo_app_show_message(app, _("plot of %.4g m2 (horizontal): each counted stem is %.4g per ha"), area, per);
    return good;
}

/* ---- asking ---- */

void ceduo_popup_ask_counts(struct app *app)
{
    const struct ceduo_belt *belt = ceduo_app_belt(app);
    if (!belt) {
        ceduo_app_show_message(app, "%s", _("there is no belt yet: a adds one in view 1"));
        return;
    }
    const struct ceduo_stand *stand = &belt->stand;
    const struct ceduo_slope *s = &app->document.file.scene.slope;
    double fall = ceduo_slope_height(s, belt->from) - ceduo_slope_height(s, belt->to);
    struct popup *p = ceduo_popup_fields(app, _("Stand from a sample plot"), ceduo_app_stand(app), submit_counts);
    ceduo_text_format(&p->text,
                      _("Densities are per horizontal hectare: 400 m2 measured along a slope of 40 degrees are 306 m2. For an "
                        "area from a map enter 0 degrees. An empty count is 0. Species, growth and cutting of %s are kept."),
                      belt->name);
    const double offered[COUNTS] = {
        [AREA] = 400,
        [ANGLE] = round(atan2(fabs(fall), belt->to - belt->from) * 180 / M_PI),
        [SHOOT_DBH] = stand->shoots_count ? stand->shoots[0].dbh * 100 : 0,
        [SHOOT_HEIGHT] = stand->shoots_count ? stand->shoots[0].height : 0,
        [TREE_DBH] = stand->trees_count ? stand->trees[0].dbh * 100 : 0,
        [TREE_HEIGHT] = stand->trees_count ? stand->trees[0].height : 0,
    };
    for (size_t i = 0; i < COUNTS; i++) {
        const char *value = offered[i] > 0 ? ceduo_number_localize(ceduo_app_format(app, "%.4g", offered[i])) : "";
        struct field *own = ceduo_popup_add_value(
            p, _(count_rows[i].label), value, count_rows[i].path ? ceduo_schema_at(count_rows[i].path) : &ceduo_popup_amount);
        own->flags = count_rows[i].path ? own->flags & ~(unsigned)FIELD_REQUIRED : count_rows[i].flags;
        own->hi = count_rows[i].path ? own->hi : count_rows[i].max;
        own->meaning = count_rows[i].meaning;
    }
}

/* ==== a survey ==== */

/* Questions of the form, with answers. */
static const struct {
    const char *label, *answers[2];
} questions[SURVEY_QUESTIONS] = {
    [SURVEY_SLOPES] = {N_("slopes are in"), {N_("degrees"), N_("percent")}},
    [SURVEY_DIAMETERS] = {N_("diameters or circumferences are in"), {N_("cm"), N_("mm")}},
    [SURVEY_AREAS] = {N_("areas of plots are in m2"), {N_("yes"), NULL}},
    [SURVEY_HEIGHTS] = {N_("heights are"), {N_("heights of stems, m"), N_("altitudes")}},
};

/* ---- reading ---- */

/* Read a survey: its stand on one line, and how its table was understood. */
static bool read_survey(const char *path, struct survey_answers *answers, struct text *value, struct text *understood,
                        struct problems *problems)
{
    LOCAL_ARENA(arena);
    struct survey_file file;
    LOCAL_TEXT(yaml);
    if (!ceduo_survey_read(&file, &arena, path, answers, problems) || !ceduo_survey_print_stand(&file, &yaml, problems))
        return false;
    const struct source source = {.name = path, .bytes = yaml.bytes, .length = yaml.length};
    const struct node *root = ceduo_yaml_read(&arena, &source, problems);
    if (root) {
        ceduo_emit_flow(value, root);
        ceduo_text_append(understood, file.understood);
    }
    return root != NULL;
}

static void set_surveyed_stand(struct app *app, const char *path, const char *value, const char *understood)
{
    app->message[0] = '\0';
    if (ceduo_popup_replace_stand(app, path, value) && app->message[0])
        ceduo_app_show_message(app, "%s; %s", ceduo_app_format(app, "%s", app->message), understood);
    else if (!app->message[0])
        ceduo_app_show_message(app,
                               ceduo_stand_grows(&ceduo_app_belt(app)->stand)
                                   ? _("stand set from the survey; growth and cutting are assumed: check them; %s")
                                   : _("stand set from the survey, without growth and cutting; %s"),
                               understood);
}

static void ask_survey_units(struct app *app, const char *path, const char *survey, const struct survey_answers *answers);

/* Read a survey and set its stand. Ask for missing units, or report why it is refused. */
static void apply_survey(struct app *app, const char *path, const char *survey, struct survey_answers *answers)
{
    LOCAL_TEXT(value);
    LOCAL_TEXT(understood);
    bool must_ask = false;
    ceduo_problems_free(&app->document.problems);
    if (read_survey(survey, answers, &value, &understood, &app->document.problems)) {
        set_surveyed_stand(app, path, ceduo_text_string(&value), ceduo_text_string(&understood));
        return;
    }
    for (int q = 0; q < SURVEY_QUESTIONS; q++)
        must_ask |= answers->asked[q];
    if (must_ask)
        ask_survey_units(app, path, survey, answers);
    else
        ceduo_app_finish_edit(app, false);
}

/* ---- the form: the row of a field is its question ---- */

static void complete_answers(struct app *app, struct popup *p)
{
    (void)app;
    const char *const *answers = questions[p->fields[p->current].row].answers;
    for (int i = 0; i < 2 && answers[i]; i++)
        ceduo_popup_add_item(p, _(answers[i]), _(answers[i]));
}

/* Show how the survey is understood with these answers, once. Return true if it is shown. */
static bool show_understood(struct app *app, struct popup *p, struct survey_answers *answers)
{
    struct line *last = &p->fields[p->fields_count - 1].line;
    LOCAL_TEXT(value);
    LOCAL_TEXT(understood);
    LOCAL_PROBLEMS(problems);
    if (last->confirmed || !read_survey(p->context, answers, &value, &understood, &problems))
        return false;
    ceduo_text_free(&p->text);
    ceduo_text_append_escaped(&p->text, ceduo_text_string(&understood));
    last->confirmed = true;
    ceduo_app_show_message(app, "%s", _("Enter again takes this stand"));
    return true;
}

static bool submit_survey_form(struct app *app, struct popup *p)
{
    struct survey_answers answers = {0};
    for (const struct popup_field *f = p->fields; f < p->fields + p->fields_count; f++) {
        for (int i = 0; i < 2 && questions[f->row].answers[i]; i++)
            if (strcmp(f->line.text, _(questions[f->row].answers[i])) == 0)
                answers.given[f->row] = i + 1;
        if (answers.given[f->row] == 0) {
            ceduo_app_warn(app, _("%s: choose an answer, or press Esc and add the unit to the column name"), f->label);
            return false;
        }
    }
    if (show_understood(app, p, &answers))
        return false;
    apply_survey(app, p->target, p->context, &answers);
    return true;
}

static void ask_survey_units(struct app *app, const char *path, const char *survey, const struct survey_answers *answers)
{
    struct popup *p = ceduo_popup_fields(app, _("How to read the survey"), path, submit_survey_form);
    p->context = ceduo_arena_string(&p->arena, survey);
    ceduo_problem_line(app->document.problems.wrong.items, &p->text);
    for (int q = 0; q < SURVEY_QUESTIONS; q++)
        if (answers->asked[q] || answers->given[q])
            ceduo_popup_add_choice(p, _(questions[q].label),
                                   answers->given[q] ? _(questions[q].answers[answers->given[q] - 1]) : "", complete_answers)
                ->row = q;
}

/* ---- the file ---- */

static void complete_surveys(struct app *app, struct popup *p)
{
    const char *shipped = ceduo_file_find(&p->arena, "surveys/six-plots.csv", NULL, "surveys");
    ceduo_popup_offer_files(app, p);
    if (shipped && !ceduo_picker_has(&p->picker, shipped))
        ceduo_popup_add_item(p, _("six-plots.csv: an invented example"), shipped);
}

static void select_survey(struct app *app, struct popup *p)
{
    apply_survey(app, p->target, p->value, &(struct survey_answers){0});
}

/* Show how the table under the cursor is understood, or why it is refused; over a folder the columns of a survey. */
static void note_survey(struct app *app, struct popup *p)
{
    (void)app;
    LOCAL_TEXT(value);
    LOCAL_TEXT(note);
    LOCAL_PROBLEMS(problems);
    if (!ceduo_picker_is_file(p->value, p->endings))
        ceduo_text_append(&note,
                          _("Columns: plot, area_m2 or radius_m, slope_deg, species, kind, stool, dbh_cm, height_m, count, "
                            "status; see ceduo-stand(5)."));
    else if (!read_survey(p->value, &(struct survey_answers){0}, &value, &note, &problems) && problems.wrong.n > 0)
        ceduo_problem_line(problems.wrong.items, &note);
    ceduo_text_append_escaped(&p->text, ceduo_text_string(&note));
}

static void ask_survey_file(struct app *app)
{
    struct popup *p =
        ceduo_popup_list(app, _("Survey: a CSV file with one row per stem or class"), ceduo_app_stand(app), select_survey);
    p->update_note = note_survey;
    p->fields[0].complete = complete_surveys;
    p->endings = ".csv .txt";
}

bool ceduo_popup_is_measured(const char *stand)
{
    return strcmp(stand, STAND_COUNTED) == 0 || strcmp(stand, STAND_SURVEY) == 0;
}

bool ceduo_popup_ask_measured(struct app *app, const char *stand)
{
    if (ceduo_popup_is_measured(stand))
        (strcmp(stand, STAND_COUNTED) == 0 ? ceduo_popup_ask_counts : ask_survey_file)(app);
    return ceduo_popup_is_measured(stand);
}
