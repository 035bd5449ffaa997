/* SPDX-License-Identifier: GPL-3.0-or-later */
/* View 5: the silvicultural options side by side. */
#include <math.h>
#include <stdio.h>

#include "base/intl.h"
#include "io/emit.h"
#include "popup.h"
#include "popups.h"
#include "study/compare.h"

static void build(struct app *app, struct form *form)
{
    static const char *const columns[] = {"name", NULL};
    const struct field *options = ceduo_schema_field(ceduo_schema_scene(), "options");
    if (ceduo_node_get(app->document.file.root, "options"))
        ceduo_form_table(form, &app->document, options->object, "options", columns, "");
    else
        ceduo_form_note(form, _("One way to treat this wood. a adds another from a preset, y a copy of this one."));
    form->row = app->option + 1; /* below the names of the columns */
}

#define FIGURES 43 /* columns of the figures and the lights */

/* What is compared; by the index what the stems take and what is left, otherwise what comes through the forest. */
enum column { ADC, FREE_RUN, TAKEN, LEFT, INDEX_COLUMNS, SHARE = TAKEN, DIFFERENCE = LEFT };
#define COLUMNS INDEX_COLUMNS

static bool wooded(const struct app *app)
{
    return app->figures.result->wooded;
}

static double share_of(const struct app *app, size_t i)
{
    double half;
    return 1000 * ceduo_compare_share(app->figures.result, i, &half);
}

static double difference_of(const struct app *app, size_t i, double *half)
{
    double difference = 1000 * ceduo_compare_difference(app->figures.result, i, half);
    *half *= 1000;
    return difference;
}

static double figure(const struct app *app, size_t i, enum column column)
{
    const struct ceduo_result *r = app->figures.result;
    const struct ceduo_index *s = ceduo_result_last_index(r, i);
    double half;
    switch (column) {
    case ADC:
        return s->worst_adc;
    case FREE_RUN:
        return s->worst_free_run;
    case TAKEN:
        return wooded(app) ? share_of(app, i) : s->per_100m * KILO;
    default:
        return wooded(app) ? difference_of(app, i, &half) : s->residual * KILO;
    }
}

/* '*' for the best of a column, '!' for the worst. Figures of the stand itself have no error: where they differ, they
 * differ. Shares of rocks differ where they are more than two standard errors apart. */
static char mark_of(const struct app *app, size_t i, enum column column)
{
    size_t n = app->figures.result->options_count, best = i, worst = i;
    if (isnan(figure(app, i, column)) || (wooded(app) && column == DIFFERENCE))
        return ' ';
    bool more_is_better = column == TAKEN && !wooded(app);
    for (size_t k = 0; k < n; k++) {
        double value = figure(app, k, column);
        if (isnan(value))
            return ' ';
        if (more_is_better ? value > figure(app, best, column) : value < figure(app, best, column))
            best = k;
        if (more_is_better ? value < figure(app, worst, column) : value > figure(app, worst, column))
            worst = k;
    }
    double lowest = figure(app, best, column), highest = figure(app, worst, column), here = figure(app, i, column);
    bool apart = wooded(app) && column == SHARE ? ceduo_compare_worse(app->figures.result, worst, best) : lowest != highest;
    return !apart ? ' ' : here == lowest ? '*' : here == highest ? '!' : ' ';
}

/* Columns of the names, and lines that an option takes: where there is no room beside the figures, its name stands above
 * them. */
static int name_columns(struct ceduo_area area)
{
    if (area.width < FIGURES + 8)
        return 2;
    return area.width - FIGURES >= 20 ? area.width - FIGURES : 8;
}

/* In a very narrow window two of the figures have to do. */
static bool has_room(struct ceduo_area area, int column)
{
    return area.width >= FIGURES + 2 || column == ADC || column == LEFT;
}

static int lines_of(struct ceduo_area area)
{
    return area.width - FIGURES >= 20 ? 1 : 2;
}

static void draw_name(struct app *app, struct ceduo_area area, int y, size_t i)
{
    enum ceduo_role role = i == app->option ? CEDUO_ROLE_CURSOR : CEDUO_ROLE_TEXT;
    int width = lines_of(area) == 1 ? name_columns(area) - 1 : area.width;
    struct text safe = {0};
    ceduo_text_safe(&safe, app->figures.result->scene->options[i].name);
    for (int x = 0; role == CEDUO_ROLE_CURSOR && x < width; x++)
        ceduo_cells_label(app->cells, area.left + x, y, role, " ");
    ceduo_canvas_put(&app->cells->canvas, area.left, y, width, role, ceduo_text_string(&safe));
    ceduo_text_free(&safe);
}

static void draw_figure(struct app *app, int x, int y, size_t i, enum column column)
{
    const struct ceduo_result *r = app->figures.result;
    struct text text = {0};
    double half, value = figure(app, i, column);
    if (column == FREE_RUN)
        ceduo_text_format(&text, "%.1f %%", value * 100);
    else if (wooded(app) && column == SHARE)
        ceduo_text_format(&text, isnan(value) ? "\xe2\x80\xa6" : "%.0f", value);
    else if (wooded(app) && column == DIFFERENCE && i == 0)
        ceduo_text_put(&text, _("first"));
    else if (wooded(app) && column == DIFFERENCE && !isnan(difference_of(app, i, &half)))
        ceduo_text_format(&text, "%+.0f\xc2\xb1%.0f", value, ceil(half));
    else if (wooded(app) && column == DIFFERENCE)
        ceduo_text_put(&text, "\xe2\x80\xa6");
    else if (column == LEFT && ceduo_result_last_index(r, i)->exhausted)
        ceduo_text_put(&text, _("used up"));
    else
        ceduo_words_number(&text, value, 3);
    if (text.bytes)
        ceduo_canvas_label_right(&app->cells->canvas, x + 7, y, CEDUO_ROLE_TEXT, text.bytes);
    char mark[2] = {mark_of(app, i, column), '\0'};
    ceduo_cells_label(app->cells, x + 8, y, mark[0] == '!' ? CEDUO_ROLE_BAD : CEDUO_ROLE_GOOD, mark);
    ceduo_text_free(&text);
}

static void draw_row(struct app *app, struct ceduo_area area, int y, size_t i)
{
    const struct ceduo_index *s = ceduo_result_last_index(app->figures.result, i);
    draw_name(app, area, y, i);
    y += lines_of(area) - 1;
    int x = area.left + name_columns(area);
    for (int c = 0; c < COLUMNS; c++)
        if (has_room(area, c)) {
            draw_figure(app, x, y, i, (enum column)c);
            x += 9;
        }
    const enum ceduo_light lights[3] = {s->contact, s->free_run, s->energy};
    for (int k = 0; k < 3; k++)
        ceduo_cells_label(app->cells, x + 1 + k, y, ceduo_plot_light_role(lights[k]), ceduo_plot_light_mark(lights[k]));
}

static void draw_head(struct app *app, struct ceduo_area area)
{
    static const char *const by_index[COLUMNS] = {N_("ADC m"), N_("free run"), N_("kJ/100m"), N_("left kJ")};
    static const char *const simulated[COLUMNS] = {N_("ADC m"), N_("free run"), N_("too much"), N_("to first")};
    static const char *const arriving[COLUMNS] = {N_("ADC m"), N_("free run"), N_("arrive"), N_("to first")};
    const struct ceduo_result *r = app->figures.result;
    const char *const *words = !wooded(app)                                           ? by_index
                               : isnan(r->scene->controls[r->last_control].accepted) ? arriving
                                                                                      : simulated;
    int x = area.left + name_columns(area);
    if (lines_of(area) == 1 || area.width >= FIGURES + 8)
        ceduo_canvas_put(&app->cells->canvas, area.left, area.top, name_columns(area), CEDUO_ROLE_TITLE, _("option"));
    for (int c = 0; c < COLUMNS; c++)
        if (has_room(area, c)) {
            ceduo_canvas_label_right(&app->cells->canvas, x + 7, area.top, CEDUO_ROLE_TITLE, _(words[c]));
            x += 9;
        }
    ceduo_cells_label(app->cells, x + 1, area.top, CEDUO_ROLE_TITLE, "CFE");
}

static void put_foot(const struct app *app, size_t options, struct text *words)
{
    const struct ceduo_result *r = app->figures.result;
    if (options < 2) {
        ceduo_text_put(words, _("One way to treat this wood so far. a adds another from a preset, y a copy of this one."));
        return;
    }
    ceduo_text_put(words, _("* best, ! worst; C contact, F free run, E energy. "));
    size_t before = words->length;
    ceduo_words_best(words, r);
    if (words->length > before)
        ceduo_text_char(words, ' ');
    double accepted = r->scene->controls_count > 0 ? r->scene->controls[r->last_control].accepted * KILO : NAN;
    if (r->wooded && !isnan(accepted))
        ceduo_text_format(words, _("Too much: of 1000 released, through the wood, with more than %g kJ; \xc2\xb1 95 %%. "),
                          accepted);
    else if (!r->wooded)
        ceduo_text_put(words, _("Without forest every option sees the same rocks; the index says what stems could take, "
                                "not what a rock loses. "));
    ceduo_text_put(words, _("a adds from a preset, y copies, Enter "
                            "renames, d deletes, < > reorder, p and 2 its stand."));
}

static void draw(struct app *app, struct ceduo_area area)
{
    size_t n = app->figures.result->options_count;
    draw_head(app, area);
    int lines = lines_of(area), foot_lines = area.height >= 26 ? 6 : area.height - 1 - lines * (int)n;
    foot_lines = foot_lines < 2 ? 2 : foot_lines > 6 ? 6 : foot_lines;
    int room = (area.height - 1 - foot_lines) / lines;
    int top = (int)app->option >= room ? (int)app->option - room + 1 : 0;
    for (int i = 0; i < room && (size_t)(top + i) < n; i++)
        draw_row(app, area, area.top + 1 + lines * i, (size_t)(top + i));
    struct ceduo_area foot = {area.left, area.top + area.height - foot_lines, area.width, foot_lines};
    struct text words = {0};
    put_foot(app, n, &words);
    ceduo_app_put(app, foot, CEDUO_ROLE_DIM, &words);
}

static void choose(struct app *app, long i)
{
    long n = (long)app->document.file.scene.options_count;
    ceduo_app_show_option(app, (size_t)(i < 0 ? 0 : i >= n ? n - 1 : i));
}

static void copy_option(struct app *app)
{
    size_t at = app->option;
    if (ceduo_app_edited(app, ceduo_document_copy_option(&app->document, at, &app->problems)))
        choose(app, (long)at + 1);
}

static void delete_option(struct app *app)
{
    char path[64], name[200];
    if (app->document.file.scene.options_count < 2) {
        ceduo_app_say(app, "%s", _("the only option stays"));
        return;
    }
    snprintf(path, sizeof path, "options[%zu]", app->option);
    snprintf(name, sizeof name, "%s", ceduo_app_option(app)->name);
    if (ceduo_app_edited(app, ceduo_document_delete(&app->document, path, &app->problems)))
        ceduo_app_say(app, _("deleted '%s'; u brings it back"), name);
}

static void move_option(struct app *app, int by)
{
    long to = (long)app->option + by;
    if (to < 0 || to >= (long)app->document.file.scene.options_count)
        return;
    bool good = ceduo_document_move(&app->document, "options", app->option, (size_t)to, &app->problems);
    if (ceduo_app_edited(app, good))
        choose(app, to);
}

static bool filled_name(struct app *app, struct popup *p)
{
    struct text value = {0};
    char path[64];
    snprintf(path, sizeof path, "options[%zu].name", app->option);
    ceduo_emit_scalar(&value, p->fields[0].text, true);
    bool good = value.bytes && ceduo_document_set(&app->document, path, value.bytes, &app->problems);
    ceduo_text_free(&value);
    return ceduo_app_edited(app, good);
}

static void rename_option(struct app *app)
{
    struct popup *p = ceduo_popup_fields(app, _("Name of this option"), filled_name);
    if (p)
        ceduo_popup_field(p, _("name"), ceduo_app_option(app)->name);
}

static bool act(struct app *app, enum action action)
{
    switch (action) {
    case ACTION_UP: choose(app, (long)app->option - 1); return true;
    case ACTION_DOWN: choose(app, (long)app->option + 1); return true;
    case ACTION_TOP: choose(app, 0); return true;
    case ACTION_BOTTOM: choose(app, 1000000); return true;
    case ACTION_ADD: ceduo_popup_new_option(app); return true;
    case ACTION_DUPLICATE: copy_option(app); return true;
    case ACTION_DELETE: delete_option(app); return true;
    case ACTION_EARLIER: move_option(app, -1); return true;
    case ACTION_LATER: move_option(app, 1); return true;
    case ACTION_EDIT:
        if (ceduo_node_get(app->document.file.root, "options"))
            rename_option(app);
        return true;
    default: return false;
    }
}

const struct view ceduo_view_compare = {
    .title = N_("compare"), .panes = 1, .result = true, .build = build, .draw = draw, .act = act};
