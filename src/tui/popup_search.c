/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/intl.h"
#include "popup.h"
#include "popups.h"

static bool filled_search(struct app *app, struct popup *p)
{
    snprintf(app->search, sizeof app->search, "%.*s", (int)sizeof app->search - 1, p->fields[0].text);
    ceduo_app_search(app);
    return true;
}

void ceduo_popup_search(struct app *app)
{
    struct popup *p = ceduo_popup_fields(app, _("Search in this view"), filled_search);
    if (p)
        ceduo_popup_field(p, _("word"), app->search);
}
