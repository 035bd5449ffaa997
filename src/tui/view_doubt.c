/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 7: how sure the answer is, what it depends on, whether the options separate, and the ranges that the scene names. */
#include <stdio.h>

#include "app.h"
#include "base/language.h"

static void build(struct app *app, struct form *form)
{
    static const char *const all[] = {"path", "lo", "hi", "mean", "sd", NULL}, *const few[] = {"path", "lo", "hi", NULL};
    const struct field *doubt = ceduo_schema_field(ceduo_schema_scene(), "doubt");
    const struct node *rows = ceduo_node_get(app->document.file.root, "doubt");
    size_t n = rows && rows->kind == NODE_LIST ? rows->n : 0;
    bool means = false;
    for (size_t i = 0; i < n; i++)
        means |= ceduo_node_get(rows->items[i], "mean") != NULL;
    if (n > 0)
        ceduo_form_table(form, &app->document, doubt->object, "doubt", means ? all : few, "");
    else
        ceduo_form_note(form, _("a: name a range in the scene, to edit it"));
}

/* ---- what it says ---- */

/* Ends a line that was added since, if there is one. */
static void end_line(struct text *words, size_t *before)
{
    if (words->length > *before)
        ceduo_text_char(words, '\n');
    *before = words->length;
}

static void say_all(const struct app *app, const struct uncertainty *u, const struct ceduo_doubt_report *r, struct text *words)
{
    static const enum ceduo_doubt_kind lights[] = {CEDUO_DOUBT_CONTACT, CEDUO_DOUBT_FREE_RUN, CEDUO_DOUBT_EXCEED};
    size_t before = words->length;
    ceduo_doubt_both(words, r, app->option);
    end_line(words, &before);
    ceduo_doubt_advice(words, r, app->option, 0);
    end_line(words, &before);
    const struct ceduo_doubt_ranking *ranking = ceduo_doubt_verdict(r->answer);
    for (size_t i = 0; i < ranking->count; i++) {
        const struct ceduo_doubt_order *o = &ranking->orders[i];
        if (o->better == app->option || o->than == app->option)
            ceduo_doubt_order_words(words, r, i);
        end_line(words, &before);
    }
    for (size_t i = 0; i < 3; i++) {
        ceduo_doubt_light_words(words, r, app->option, lights[i]);
        end_line(words, &before);
    }
    ceduo_text_format(words,
                      ceduo_app_doubt_is_rough(app) ? _("Rough so far: %llu scenes of %llu rocks; being refined.\n")
                                                    : _("%llu scenes of %llu rocks.\n"),
                      (unsigned long long)u->answer.evaluations, (unsigned long long)u->rocks);
}

/* ---- drawing ---- */

#define OPTIONS_MIN 6 /* in a picture that shares its room with words, if there are so many */

static void draw(struct app *app, struct ceduo_area area)
{
    const struct uncertainty *u = ceduo_live_uncertainty(&app->live, &app->document.file);
    struct text words = {0};
    int form = ceduo_app_form(app)->n > 1 ? area.height / 4 : 1;
    struct ceduo_area below = {area.left, area.top + area.height - form, area.width, form};
    area.height -= form + 1;
    struct ceduo_picture picture = ceduo_app_picture(app);
    struct ceduo_doubt_report r;
    int said = 0;
    if (ceduo_app_doubt(app, &r))
        picture.doubt = &r;
    if (u && r.answer) {
        say_all(app, u, &r, &words);
        said = ceduo_app_text_lines(app, ceduo_text_string(&words), area.width);
        /* lines that the picture keeps: options, an input, a line above each, and one between it and the words; and those
         * that it fills: options, inputs, a line above each */
        size_t options = r.file->scene.options_count, inputs = r.inputs->n < 12 ? r.inputs->n : 12;
        int max = area.height - (int)(options < OPTIONS_MIN ? options : OPTIONS_MIN) - 4, lines = (int)(options + inputs + 2);
        said = said > max ? max : said;
        if (lines < area.height - said - 1)
            area.height = lines + said + 1;
    }
    struct ceduo_area top = {area.left, area.top, area.width, area.height - said - (said > 0)};
    struct ceduo_area text = {area.left, area.top + area.height - said, area.width, said};
    ceduo_plot_draw(CEDUO_PLOT_DOUBT, &app->cells->canvas, &top, &picture);
    ceduo_app_put(app, text, CEDUO_ROLE_TEXT, &words);
    ceduo_app_draw_form(app, below, true);
}

/* ---- a range of one's own ---- */

static bool is_named(const struct node *rows, const char *path)
{
    for (size_t i = 0; rows && rows->kind == NODE_LIST && i < rows->n; i++) {
        const char *own = ceduo_node_text(rows->items[i], "path");
        if (own && strcmp(own, path) == 0)
            return true;
    }
    return false;
}

/* Names the most important input that the scene does not name yet, with the range that it has now. */
static void add(struct app *app, int unused)
{
    (void)unused;
    const struct uncertainty *u = ceduo_live_uncertainty(&app->live, &app->document.file);
    const struct node *rows = ceduo_node_get(app->document.file.root, "doubt");
    if (!u || u->inputs.n == 0 || (rows && rows->kind != NODE_LIST)) {
        ceduo_app_say(app, "%s", u ? _("nothing here has a range") : _("not computed yet"));
        return;
    }
    const struct ceduo_doubt_figure *f = ceduo_doubt_figure_of(&u->answer, app->option, u->answer.main, false);
    struct ceduo_doubt_report r;
    ceduo_app_doubt(app, &r);
    for (size_t i = 0; i < f->uses; i++) {
        const struct ceduo_input *input = &u->inputs.items[f->order[i]];
        if (input->kind == CEDUO_INPUT_WORDS || input->places_count != 1 || is_named(rows, input->places[0]))
            continue;
        struct text row = {0};
        ceduo_text_format(&row, "{path: '%s', lo: ", input->places[0]);
        ceduo_doubt_input_end(&row, &r, f->order[i], 0);
        ceduo_text_put(&row, ", hi: ");
        ceduo_doubt_input_end(&row, &r, f->order[i], 1);
        ceduo_text_char(&row, '}');
        size_t n = rows ? rows->n : 0;
        const char *item = ceduo_app_kept(app, &row);
        if (ceduo_app_edited(app, ceduo_document_insert(&app->document, "doubt", n, item, &app->problems)))
            ceduo_form_go(ceduo_app_form(app), "doubt", n);
        return;
    }
    ceduo_app_say(app, "%s", _("every single value in doubt has a range of the scene already"));
}

static const struct act acts[] = {{ACTION_ADD, add, 0}, {0}};

const struct view ceduo_view_doubt = {.title = NP_("view", "doubt"),
                                      .panes = 1,
                                      .uncertainty = true,
                                      .build = build,
                                      .draw = draw,
                                      .acts = {acts},
                                      .bar = {{ACTION_EDIT, N_("edit")},
                                              {ACTION_ADD, N_("a range")},
                                              {ACTION_DELETE, N_("delete")},
                                              {ACTION_NEXT_OPTION, N_("next option")}}};
