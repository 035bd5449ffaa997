/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 7: uncertainty of the answer, its causes, the ranking of the options, and the ranges in the scene. */

#include "app.h"
#include "base/language.h"

static void build_ranges(struct app *app, struct form *form)
{
    const struct node *rows = ceduo_node_get(app->document.file.root, "uncertainty");
    size_t n = rows && rows->kind == NODE_LIST ? rows->n : 0;
    bool means = false;
    for (size_t i = 0; i < n; i++)
        means |= ceduo_node_get(rows->items[i], "mean") != NULL;
    if (n > 0)
        ceduo_form_table(form, "uncertainty", NULL, means ? "path lo hi mean sd" : "path lo hi");
    else
        ceduo_form_note(form, _("a adds a range to the scene"));
}

/* ---- drawing ---- */

#define WORDS_MIN 4 /* min. lines of the text below the picture */

#define AHEAD_MIN 12 /* min. lines of the curves */

/* Draw the picture and its text, which scroll together, and the ranges of the scene below, which get the rest of the lines.
 * Without ranges the curves of the years get it. */
static void draw_uncertainty(struct app *app, struct ceduo_area area)
{
    int width = area.width - 2, rows = (int)ceduo_app_form(app)->n, form = 1 + (rows > 1 ? area.height / 4 : 1);
    struct ceduo_page page = {.width = (size_t)width};
    struct ceduo_picture picture = ceduo_app_picture(app);
    struct ceduo_pane pane = ceduo_app_pane(app, area.height - form);
    const struct ceduo_uncertainty_report *r = pane.report->uncertainty;
    bool pending = app->rotation_mean && r && r->answer && !r->rotation_mean;
    picture.uncertainty = pending ? NULL : r;
    const char *reason = pending ? ceduo_uncertainty_no_rotation(&app->document.file.scene) : NULL;
    if (reason)
        ceduo_page_para(&page, CEDUO_PAGE_NOTE, "%s", _(reason));
    else if (ceduo_plot_add(CEDUO_PLOT_UNCERTAINTY, &page, &picture, pane.height - WORDS_MIN - 1))
        ceduo_page_add(&page, CEDUO_PAGE_GAP);
    if (!pending)
        ceduo_pane_uncertainty(&page, &pane);
    if (r && r->answer && !pending)
        ceduo_page_para(&page, CEDUO_PAGE_NOTE,
                        r->rotation_mean ? _("%llu scenes of %llu rocks in each year.") : _("%llu scenes of %llu rocks."),
                        (unsigned long long)r->answer->evaluations,
                        (unsigned long long)(r->rotation_mean ? CEDUO_UNCERTAINTY_YEAR_ROCKS : r->rocks));
    int rest = area.height - 1 - ceduo_page_draw(&page, &app->cells->canvas, (struct ceduo_area){0}, 0);
    form = rows > 1 && rest > form ? rest < rows + 1 ? rest : rows + 1 : form;
    ceduo_app_draw_form(app, cut_bottom(&area, form));
    rest -= form;
    if (app->live.result && rest > AHEAD_MIN)
        ceduo_app_draw_plot(app, CEDUO_PLOT_AHEAD, cut_bottom(&area, rest), &picture);
    area.width = width;
    area.height -= rest > AHEAD_MIN; /* the position of the text */
    ceduo_app_draw_page(app, area, &page);
}

static void toggle_rotation(struct app *app)
{
    app->rotation_mean = !app->rotation_mean;
    ceduo_app_state(app)->text.first = 0;
}

/* ---- a range in the scene ---- */

static bool is_named(const struct node *rows, const char *path)
{
    const char *own = NULL;
    for (size_t i = 0; rows && i < rows->n && !(own && strcmp(own, path) == 0); i++)
        own = ceduo_node_text(rows->items[i], "path");
    return own && strcmp(own, path) == 0;
}

/* Write the most important input without a range in the scene, with its current range. */
static void add_range(struct app *app)
{
    const struct node *rows = ceduo_node_get(app->document.file.root, "uncertainty");
    struct ceduo_uncertainty_report r;
    bool known = ceduo_app_uncertainty(app, &r) && (!r.answer || !isnan(ceduo_uncertainty_main(&r, app->option)->fit.p5));
    if (!known || !r.answer || (rows && rows->kind != NODE_LIST)) {
        ceduo_app_show_message(app, "%s", known ? _("no input has a range") : _("not computed yet"));
        return;
    }
    const struct ceduo_uncertainty_figure *f = ceduo_uncertainty_main(&r, app->option);
    for (size_t i = 0; i < f->uses; i++) {
        const struct ceduo_input *input = &r.inputs->items[f->order[i]];
        if (input->kind == CEDUO_INPUT_WORDS || input->places_count != 1 || is_named(rows, input->places[0]))
            continue;
        LOCAL_TEXT(row);
        ceduo_text_append(&row, "{path: ");
        ceduo_emit_scalar(&row, input->places[0], true);
        ceduo_text_append(&row, ", lo: ");
        ceduo_uncertainty_input_end(&row, &r, f->order[i], 0);
        ceduo_text_append(&row, ", hi: ");
        ceduo_uncertainty_input_end(&row, &r, f->order[i], 1);
        ceduo_text_append_char(&row, '}');
        size_t n = rows ? rows->n : 0;
        if (ceduo_app_finish_edit(app, ceduo_document_insert(&app->document, "uncertainty", n, row.bytes)))
            ceduo_form_go_to_item(ceduo_app_form(app), "uncertainty", n);
        return;
    }
    ceduo_app_show_message(app, "%s", _("all uncertain inputs already have a range in the scene"));
}

static const struct key_binding uncertainty_bindings[] = {KEY(ADD, .plain = add_range),
                                                          KEY(NEXT_PANE, .plain = toggle_rotation),
                                                          KEY(PREV_PANE, .plain = toggle_rotation),
                                                          KEY(PAGE_UP, .handler = ceduo_app_scroll_text, .step = -4),
                                                          KEY(PAGE_DOWN, .handler = ceduo_app_scroll_text, .step = 4),
                                                          {0}};

const struct view ceduo_view_uncertainty = {.panes = 1,
                                            .uncertainty = true,
                                            .build = build_ranges,
                                            .draw = draw_uncertainty,
                                            .bindings = {uncertainty_bindings},
                                            .bar = {KEY(EDIT, N_("edit")), KEY(ADD, N_("a range")), KEY(DELETE, N_("delete")),
                                                    KEY(NEXT_PANE, N_("today or years")), KEY(NEXT_OPTION, N_("next option")),
                                                    KEY(PAGE_DOWN, N_("scroll"))}};
