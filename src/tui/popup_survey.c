/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stand from a survey: a file is chosen, and a form asks what its table leaves open. */
#include <string.h>

#include "base/language.h"
#include "io/emit.h"
#include "io/file.h"
#include "io/survey_file.h"
#include "popup.h"

/* Questions of the form, and their answers. */
static const struct {
    const char *label, *answers[2];
} questions[SURVEY_QUESTIONS] = {
    [SURVEY_SLOPES] = {N_("slopes are in"), {N_("degrees"), N_("percent")}},
    [SURVEY_DIAMETERS] = {N_("diameters or circumferences are in"), {N_("cm"), N_("mm")}},
    [SURVEY_AREAS] = {N_("areas of plots are in m2"), {N_("yes"), NULL}},
    [SURVEY_HEIGHTS] = {N_("heights are"), {N_("heights of stems, m"), N_("altitudes")}},
};

/* ---- reading ---- */

/* A survey that is read: its stand on one line, as a change takes it, and how its table was understood. */
struct reading {
    struct survey_answers answers;
    struct text value, understood;
};

static bool read_survey(const char *path, struct reading *reading, struct problems *problems)
{
    LOCAL_ARENA(arena);
    struct survey_file file;
    LOCAL_TEXT(yaml);
    const struct node *root = NULL;
    if (ceduo_survey_read(&file, &arena, path, &reading->answers, problems) && ceduo_survey_stand(&file, &yaml, problems)) {
        const struct source source = {.name = path, .bytes = yaml.bytes, .length = yaml.length};
        root = ceduo_yaml_read(&arena, &source, problems);
    }
    if (root) {
        ceduo_emit_flow(&reading->value, root);
        ceduo_text_put(&reading->understood, file.understood);
    }
    return root != NULL;
}

static bool is_asked(const struct survey_answers *answers)
{
    bool asked = false;
    for (int q = 0; q < SURVEY_QUESTIONS; q++)
        asked |= answers->asked[q];
    return asked;
}

static void take_stand(struct app *app, const char *path, const struct reading *reading)
{
    const char *understood = ceduo_text_string(&reading->understood);
    app->message[0] = '\0';
    if (!ceduo_popup_replace_stand(app, path, ceduo_text_string(&reading->value)))
        return;
    if (app->message[0])
        ceduo_app_say(app, "%s; %s", ceduo_app_format(app, "%s", app->message), understood);
    else
        ceduo_app_say(app,
                      ceduo_stand_grows(&ceduo_app_option(app)->belts[app->belt].stand)
                          ? _("the stand of the survey; its growth and cutting are assumed: check them; %s")
                          : _("the stand of the survey; it has no growth and cutting; %s"),
                      understood);
}

static void open_form(struct app *app, const char *path, const char *survey, const struct survey_answers *answers);

/* Read a survey and take its stand, or ask what its table leaves open, or say why it is refused. */
static void try_survey(struct app *app, const char *path, const char *survey, const struct survey_answers *answers)
{
    struct reading reading = {.answers = *answers};
    if (read_survey(survey, &reading, &app->problems)) {
        take_stand(app, path, &reading);
    } else if (is_asked(&reading.answers)) {
        open_form(app, path, survey, &reading.answers);
    } else {
        ceduo_app_edited(app, false);
    }
    ceduo_text_free(&reading.value);
    ceduo_text_free(&reading.understood);
}

/* ---- the form ---- */

/* Question of a field; SURVEY_QUESTIONS: none. */
static int question_of(const struct popup_field *field)
{
    int q = 0;
    while (q < SURVEY_QUESTIONS && strncmp(field->label, _(questions[q].label), sizeof field->label - 1) != 0)
        q++;
    return q;
}

static void offer_answers(struct app *app, struct popup *p)
{
    (void)app;
    int q = question_of(&p->fields[p->at]);
    for (int i = 0; q < SURVEY_QUESTIONS && i < 2 && questions[q].answers[i]; i++)
        ceduo_popup_item(p, _(questions[q].answers[i]), _(questions[q].answers[i]));
}

static bool filled_form(struct app *app, struct popup *p)
{
    struct survey_answers answers = {0};
    for (size_t k = 0; k < p->fields_count; k++) {
        int q = question_of(&p->fields[k]);
        for (int i = 0; q < SURVEY_QUESTIONS && i < 2 && questions[q].answers[i]; i++)
            if (strcmp(p->fields[k].line.text, _(questions[q].answers[i])) == 0)
                answers.given[q] = i + 1;
        if (q < SURVEY_QUESTIONS && answers.given[q] == 0) {
            ceduo_app_warn(app, _("%s: choose an answer, or Esc and name the column with its unit"), p->fields[k].label);
            return false;
        }
    }
    const char *path = ceduo_app_format(app, "%s", p->path), *survey = ceduo_app_format(app, "%s", p->kept);
    try_survey(app, path, survey, &answers);
    return true;
}

static void open_form(struct app *app, const char *path, const char *survey, const struct survey_answers *answers)
{
    const char *why = ceduo_app_format(app, "%.*s", (int)strcspn(ceduo_text_string(&app->problems.text), "\n"),
                                       ceduo_text_string(&app->problems.text));
    struct popup *p = ceduo_popup_fields(app, _("How is the survey to be read?"), path, filled_form);
    p->kept = ceduo_arena_string(&p->arena, survey);
    ceduo_text_put(&p->text, why);
    ceduo_problems_free(&app->problems);
    for (int q = 0; q < SURVEY_QUESTIONS; q++)
        if (answers->asked[q] || answers->given[q])
            ceduo_popup_choice(p, _(questions[q].label),
                               answers->given[q] ? _(questions[q].answers[answers->given[q] - 1]) : "", offer_answers);
}

/* ---- the file ---- */

static void offer_surveys(struct app *app, struct popup *p)
{
    const char *shipped = ceduo_file_find(&p->arena, "surveys/six-plots.csv", NULL, "surveys");
    ceduo_popup_offer_files(app, p);
    if (shipped && !ceduo_picker_has(&p->picker, shipped))
        ceduo_popup_item(p, _("six-plots.csv: an example, made up"), shipped);
}

static void chose_survey(struct app *app, struct popup *p)
{
    try_survey(app, p->path, p->value, &(struct survey_answers){0});
}

void ceduo_popup_survey(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("A survey: a CSV file with a row for each stem, or for each class"),
                                       ceduo_app_stand(app), chose_survey);
    ceduo_text_put(&p->text,
                   _("Columns: plot, area_m2 or radius_m, slope_deg, species, kind, stool, dbh_cm, height_m, count, status; "
                     "see ceduo-stand(5)."));
    p->fields[0].offer = offer_surveys;
    p->endings = ".csv .txt";
}
