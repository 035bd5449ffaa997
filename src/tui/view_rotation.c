/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 6: the years of a rotation: protection in each year, growth and cutting of the stands. */
#include <math.h>

#include "app.h"
#include "base/language.h"
#include "scene/stand.h"

static void build_rotation(struct app *app, struct form *form)
{
    ceduo_form_table(form, ceduo_app_forest(app), NULL, "from_m to_m cut_year stand");
    if (ceduo_app_belt(app)) {
        const char *stand = ceduo_app_stand(app);
        ceduo_form_heading(form,
                           ceduo_app_format(app, _("Stand of belt %zu: %.60s"), app->belt + 1, ceduo_app_belt(app)->name));
        ceduo_form_fields(form, ceduo_app_format(app, "%s.", stand), "cutting.stay_per_ha cutting.rotation_years");
        ceduo_form_rest(form, ceduo_app_format(app, "%s.cutting", stand));
        ceduo_form_rest(form, ceduo_app_format(app, "%s.growth", stand));
        ceduo_form_heading(form, _("Shoots on the stools"));
        ceduo_form_rest(form, ceduo_app_format(app, "%s.growth.shoots", stand));
        ceduo_form_heading(form, _("Single trees: standards, reserves"));
        ceduo_form_rest(form, ceduo_app_format(app, "%s.growth.trees", stand));
    }
    ceduo_form_heading(form, _("Years shown (empty: the years ahead)"));
    ceduo_form_fields(form, "years.", "first last");
    ceduo_form_heading(form, _("Rockfall frequency and standards"));
    ceduo_form_fields(form, "", "rocks_per_year minimum.reserves_per_ha rules");
    ceduo_form_rest(form, "minimum");
}

/* Append the fellings and stands of a year. The right column has its figures. */
static void append_year(struct app *app, const struct ceduo_years *years, struct text *text)
{
    const struct ceduo_year *y = &years->years[app->year < years->count ? app->year : 0];
    const struct ceduo_verdict *v = &app->live.verdict;
    const struct ceduo_yield *yield = app->option < v->n ? &v->choices[app->option].yield : NULL;
    for (size_t i = 0; yield && i < yield->fellings_count; i++)
        if (yield->fellings[i].year == y->year) {
            ceduo_text_format(text, _("Felled: %.0f m\xc2\xb3 per ha, %.0f stems."), yield->fellings[i].volume,
                              yield->fellings[i].stems_per_ha);
            ceduo_text_append_char(text, ' ');
        }
    for (const struct ceduo_belt *belt = y->option.belts; belt < y->option.belts + y->option.belts_count; belt++) {
        const struct ceduo_stand *s = &belt->stand;
        ceduo_text_format(text, "%s\xe2\x80\x93%s m: ", LOCALIZED(belt->from_given), LOCALIZED(belt->to_given));
        if (ceduo_stand_is_bare(s))
            ceduo_text_append(text, _("no stems"));
        if (s->shoots_count > 0)
            ceduo_text_format(text, _("%.0f stools"), s->stools_per_ha);
        for (size_t i = 0; i < s->shoots_count; i++)
            ceduo_text_append_joined(text, ", ", _("%.0f shoots of %.1f cm, %.1f m"), s->shoots[i].per_ha,
                                     s->shoots[i].dbh * 100, s->shoots[i].height);
        for (size_t i = 0; i < s->trees_count; i++)
            ceduo_text_append_joined(text, s->shoots_count + i > 0 ? ", " : "", _("%.0f trees of %.0f cm, %.0f m"),
                                     s->trees[i].per_ha, s->trees[i].dbh * 100, s->trees[i].height);
        ceduo_text_append(text, ". ");
    }
}

static void append_summary(struct app *app, const struct ceduo_years *years, struct text *text)
{
    const struct ceduo_verdict *v = &app->live.verdict;
    ceduo_words_window(text, ceduo_app_option(app));
    ceduo_text_append(text, text->length > 0 ? " " : "");
    ceduo_words_years_summary(text, app->live.result, years);
    if (app->option < v->n && !isnan(v->choices[app->option].yield.cut_per_year))
        ceduo_text_append_joined(text, " ", _("Yield %.2g m\xc2\xb3 per ha and year."),
                                 v->choices[app->option].yield.cut_per_year);
    ceduo_text_append_char(text, ' ');
    ceduo_words_year_numbering(text, years->rocks);
}

static void step_year(struct app *app, int step)
{
    const struct ceduo_years *years = ceduo_live_years(&app->live, &app->document.file.scene, app->option);
    struct viewport v = {.selected = (int)app->year, .count = years ? (int)years->count : 0};
    viewport_move(&v, step);
    app->year = v.count > 0 ? (size_t)v.selected : app->year;
}

/* Select the year below the pointer. */
static void click_year(struct app *app, int column, int row)
{
    const struct ceduo_span *span = ceduo_app_private_state(app);
    (void)row;
    ceduo_app_state(app)->pane = 1;
    step_year(app, (int)lround(column * (span->x1 - span->x0) / (span->width - 1)) - (int)app->year);
}

#define PICTURE_MIN     7 /* min. lines of the picture with the form: only the curve */
#define PICTURE_ALONE   9 /* min. lines with the lights */
#define FORM_MIN        4 /* min. lines of the form; wanted lines: */
#define FORM_WANTED     9
#define HEIGHT_FOR_FORM 18

static void draw_rotation(struct app *app, struct ceduo_area area)
{
    struct ceduo_picture picture = ceduo_app_picture(app);
    struct ceduo_span *span = picture.span = ceduo_app_private_state(app);
    bool picture_only = ceduo_app_state(app)->pane == 1;
    struct text text = {0};
    if (picture.years && app->live.result && picture.years->count > 0) {
        append_summary(app, picture.years, &text);
        ceduo_text_append_char(&text, '\n');
        append_year(app, picture.years, &text);
    }
    int form_min = picture_only ? 0 : area.height >= HEIGHT_FOR_FORM ? FORM_WANTED : FORM_MIN;
    int max = area.height - form_min - (picture_only ? PICTURE_ALONE : PICTURE_MIN);
    ceduo_app_shorten(app, &text, area.width, max);
    int words = ceduo_app_count_lines(app, ceduo_text_string(&text), area.width);
    words = words > max ? max : words;
    int form = picture_only ? 0 : (area.height - words) / 3;
    form = form > form_min ? form : form_min;
    if (picture_only)
        ceduo_app_show_hint(app, _("left, right: another year; Tab: back to the form"));
    ceduo_app_draw_form(app, cut_bottom(&area, form));
    ceduo_app_draw_text(app, cut_bottom(&area, words), CEDUO_ROLE_TEXT, &text);
    *span = (struct ceduo_span){0};
    ceduo_plot_draw(CEDUO_PLOT_ROTATION, &app->cells->canvas, &area, &picture);
    if (span->width > 1)
        ceduo_app_add_hit(app, (struct hit){.area = {span->left, area.top, span->width, area.height}, .click = click_year});
}

static const struct key_binding rotation_bindings[] = {KEY(RIGHT, .handler = step_year, .step = 1),
                                                       KEY(LEFT, .handler = step_year, .step = -1),
                                                       KEY(TOP, .handler = step_year, .step = -ALL_LINES),
                                                       KEY(BOTTOM, .handler = step_year, .step = ALL_LINES),
                                                       {0}};

const struct view ceduo_view_rotation = {
    .panes = 2,
    .private_size = sizeof(struct ceduo_span),
    .build = build_rotation,
    .draw = draw_rotation,
    .bindings = {NULL, rotation_bindings},
    .after_key = ceduo_app_sync_belt,
    .bar = {KEY(EDIT, N_("edit")), KEY(NEXT_PANE, N_("years")), KEY(NEXT_OPTION, N_("next option"))}};
