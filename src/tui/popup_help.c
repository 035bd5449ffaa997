/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All keys, and the field under the cursor. */
#include "base/language.h"
#include "popup.h"
#include "popups.h"

void ceduo_popup_help(struct app *app)
{
    struct popup *p = ceduo_popup_text(app, _("Keys"));
    if (!p)
        return;
    const struct form_cell *cell = ceduo_app_state(app)->pane == 0 ? ceduo_form_cell(ceduo_app_form(app)) : NULL;
    struct text field = {0};
    if (cell)
        ceduo_form_explain(&app->document, cell, &field);
    if (field.bytes) {
        ceduo_text_safe(&p->text, field.bytes);
        ceduo_text_put(&p->text, "\n \n");
    }
    ceduo_text_free(&field);
    ceduo_text_put(&p->text, _("Every edit is live: figures and pictures follow at once.\n \n"));
    for (int i = 0; i < ACTION_COUNT; i++) {
        const struct action_info *a = &ceduo_actions[i];
        char keys[32];
        snprintf(keys, sizeof keys, "%s%s%s", a->word, a->word2[0] ? "  " : "", a->word2);
        ceduo_text_format(&p->text, "%-18s%s\n", keys, _(a->help));
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
}
