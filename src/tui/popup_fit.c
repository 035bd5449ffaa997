/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which values are fitted to what was observed, and between which bounds? */
#include <string.h>

#include "base/language.h"
#include "popup.h"
#include "popups.h"
#include "view/report_calibration.h"
#include "view/typed.h"

#define FILLED 4 /* values that are offered with their range; to fit more at once takes long, and is for who wants it */

/* ---- bounds ---- */

static void append_bounds(struct text *text, const struct fit_request *w, size_t i)
{
    char lo[CEDUO_NUMBER_ROOM], hi[CEDUO_NUMBER_ROOM];
    ceduo_text_format(text, "%s:%s", ceduo_shown_number(w->fields[i], w->lo[i], lo),
                      ceduo_shown_number(w->fields[i], w->hi[i], hi));
}

/* Both ends in the unit that is shown; false where they are none, which is said. */
static bool read_bounds(struct app *app, const char *typed, const struct field *field, double ends[2])
{
    const char *colon = strchr(typed, ':');
    struct line line;
    for (int i = 0; i < 2; i++) {
        LOCAL_TEXT(end);
        ends[i] = NAN;
        ceduo_line_set(&line, i == 0 ? ceduo_app_format(app, "%.*s", (int)strcspn(typed, ":"), typed) : colon ? colon + 1 : "");
        line.asked = true; /* no bound is unusual */
        if (!ceduo_popup_read(app, field, &line, &end))
            return false;
        ceduo_number_read(ceduo_text_string(&end), &ends[i]);
    }
    if (!(ends[0] < ends[1]))
        ceduo_app_warn(app, "%s", _("from and to are numbers, the smaller first"));
    return ends[0] < ends[1];
}

/* ---- the popup ---- */

/* Values that follow are moved into the place of those that are not fitted. */
static bool filled_fit(struct app *app, struct popup *p)
{
    struct fit_request all;
    ceduo_fit_offer(&app->document.file, &all);
    struct fit_request w = {.rocks = all.rocks};
    for (size_t i = 0; i < all.n; i++) {
        double ends[2];
        if (p->fields[i].line.text[0] == '\0')
            continue;
        if (!read_bounds(app, p->fields[i].line.text, all.fields[i], ends))
            return false;
        w.lo[w.n] = ends[0];
        w.hi[w.n] = ends[1];
        snprintf(w.paths[w.n], sizeof w.paths[w.n], "%s", all.paths[i]);
        w.fields[w.n++] = all.fields[i];
    }
    if (w.n == 0)
        ceduo_app_warn(app, "%s", _("nothing is to be fitted: give one value its bounds, as 0.3:0.4"));
    else
        ceduo_live_fit(&app->live, &app->document.file, &w);
    return w.n > 0;
}

/* Whether a value is among those that are fitted at present, and what was seen holds it; its bounds are those. */
static bool is_held(const struct fit *now, const char *path, double *lo, double *hi)
{
    for (size_t i = 0; i < now->request.n; i++)
        if (strcmp(now->request.paths[i], path) == 0 && !now->loose.loose[i]) {
            *lo = now->request.lo[i];
            *hi = now->request.hi[i];
            return true;
        }
    return false;
}

void ceduo_popup_fit(struct app *app)
{
    struct fit_request request;
    const struct fit *now = app->live.fitting ? app->live.results.fit : NULL;
    ceduo_fit_offer(&app->document.file, &request);
    struct popup *p = ceduo_popup_fields(app, _("What is fitted to what was seen?"), "", filled_fit);
    ceduo_text_format(
        &p->text, _("Each value between its bounds; an empty field is not fitted. Every scene that is tried has %llu rocks."),
        (unsigned long long)request.rocks);
    for (size_t i = FILLED; i < request.n; i++) {
        if (i == FILLED)
            ceduo_text_format(&p->text, " %s ", _("Usual bounds of the others:"));
        ceduo_text_put(&p->text, i == FILLED ? "" : "; ");
        ceduo_calibration_name(&p->text, request.paths[i], request.fields[i]);
        ceduo_text_char(&p->text, ' ');
        append_bounds(&p->text, &request, i);
    }
    for (size_t i = 0; i < request.n; i++) {
        struct text label = {0}, bounds = {0};
        ceduo_calibration_name(&label, request.paths[i], request.fields[i]);
        if (now && now->loose.n > 0 ? is_held(now, request.paths[i], &request.lo[i], &request.hi[i]) : i < FILLED)
            append_bounds(&bounds, &request, i);
        ceduo_popup_field(p, ceduo_app_kept(app, &label), ceduo_app_kept(app, &bounds));
    }
}
