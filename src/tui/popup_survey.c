/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stand from a survey: a CSV file of sample plots is chosen, and its stand takes the place of that of the belt. */
#include "base/language.h"
#include "io/emit.h"
#include "io/file.h"
#include "io/survey_file.h"
#include "popup.h"
#include "popups.h"

static void offer_surveys(struct app *app, struct popup *p)
{
    const char *shipped = ceduo_file_find(&p->arena, "surveys/six-plots.csv", NULL, "surveys");
    ceduo_popup_offer_files(app, p);
    if (shipped && !ceduo_picker_has(&p->picker, shipped))
        ceduo_popup_item(p, _("six-plots.csv: an example, made up"), shipped);
}

/* The stand of a survey on one line, as a change takes it. */
static bool read_stand(const char *path, struct text *value, struct problems *problems)
{
    struct arena arena = {0};
    struct survey_file file;
    LOCAL_TEXT(yaml);
    const struct node *root = NULL;
    if (ceduo_survey_read(&file, &arena, path, problems) && ceduo_survey_stand(&file, &yaml, problems)) {
        const struct source source = {.name = path, .bytes = yaml.bytes, .length = yaml.length};
        root = ceduo_yaml_read(&arena, &source, problems);
    }
    if (root)
        ceduo_emit_flow(value, root);
    ceduo_arena_free(&arena);
    return root != NULL;
}

static void chose_survey(struct app *app, struct popup *p)
{
    LOCAL_TEXT(value);
    if (!read_stand(p->value, &value, &app->problems))
        ceduo_app_edited(app, false);
    else if (ceduo_app_set(app, p->path, value.bytes))
        ceduo_app_say(app, _("the stand of the survey '%.100s'; it says nothing of growth and cutting"), p->value);
}

void ceduo_popup_survey(struct app *app)
{
    struct popup *p =
        ceduo_popup_list(app, _("A survey: a CSV file with a row for each stem"), ceduo_app_stand(app), chose_survey);
    ceduo_text_put(&p->text,
                   _("Columns: plot, area_m2 or radius_m, slope_deg, species, kind, stool, dbh_cm, height_m, spacing_m; "
                     "see ceduo-stand(5)."));
    p->fields[0].offer = offer_surveys;
    p->endings = ".csv";
}
