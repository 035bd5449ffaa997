/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All keys, and the field under the cursor. */
#include "base/language.h"
#include "popup.h"

/* The first action of each group, in the order of the table, and its heading. */
static const struct {
    enum action first;
    const char *heading;
} groups[] = {{ACTION_UP, N_("Moving")},        {ACTION_EDIT, N_("Changing")},
              {ACTION_VIEW_SLOPE, N_("Views")}, {ACTION_FIND, N_("Looking further")},
              {ACTION_NEW, N_("Files")},        {ACTION_CHARSET, N_("Screen")}};

/* What words of the column on the right mean; those of fields are explained at the field. */
static const struct {
    const char *word, *meaning;
} glossary[] = {
    {N_("ADC"), N_("mean distance between stem hits along the fall line; less than 30 m passes")},
    {N_("free run"), N_("chance that a rock meets no stem over 30 m of forest")},
    {N_("two signs"), N_("of a test: today, and in the worst of the years ahead")},
    {N_("index"), N_("the paper's way: so many contacts, each takes one mean stem's energy")},
    {N_("p95"), N_("of 100 rocks 95 stay below it")},
    {N_("doubt"), N_("what is not known, such as the ground; more rocks do not cure it")},
};

void ceduo_popup_help(struct app *app)
{
    struct popup *p = ceduo_popup_text(app, _("Keys"));
    LOCAL_TEXT(field);
    if (ceduo_app_state(app)->pane == 0)
        ceduo_form_explain(ceduo_app_form(app), &field);
    if (field.bytes) {
        ceduo_text_safe(&p->text, field.bytes);
        ceduo_text_put(&p->text, "\n \n");
    }
    ceduo_text_put(&p->text, _("Every edit is live: figures and pictures follow at once.\n \n"));
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_info *a = &ceduo_actions[i];
        for (size_t k = 0; k < sizeof groups / sizeof groups[0]; k++)
            if ((int)groups[k].first == i)
                ceduo_text_format(&p->text, "%s%s\n", k > 0 ? " \n" : "", _(groups[k].heading));
        const char *keys = ceduo_app_format(app, "%s%s%s", a->word, a->word2[0] ? "  " : "", a->word2);
        ceduo_text_format(&p->text, "  %-16s%s\n", keys, ceduo_translate_in(a->help));
    }
    ceduo_text_put(&p->text, " \n");
    ceduo_text_put(&p->text, _("A star marks what is assumed and not measured. Dim values are defaults.\n"
                               "A number is typed with a comma or a dot, a diameter in cm; one with a spread as "
                               "0.6 +- 0.1, with a u behind it where all between is alike. A point is x z with a blank "
                               "between.\n"
                               "In a list, type to search: the best match stands first. a and y split a ground, a belt "
                               "or a point of the profile; its neighbours follow where a border is moved.\n"
                               "The column on the right: of 1000 rocks released, without forest; the three lights; what "
                               "the index (Eq. 4 and 5 of Ciabocco et al. 2009) takes and leaves; how sure it is.\n"
                               "With the mouse: click a field or a view's name; the wheel moves; with Shift held the "
                               "terminal itself selects text.\n"));
    ceduo_text_format(&p->text, " \n%s\n", _("Words"));
    for (size_t i = 0; i < sizeof glossary / sizeof glossary[0]; i++)
        ceduo_text_format(&p->text, "  %s: %s\n", _(glossary[i].word), _(glossary[i].meaning));
}
