/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "program.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/utf8.h"
#include "popup.h"

static void undo_or_redo(struct app *app, int step)
{
    struct document *d = &app->document;
    bool redo = step > 0;
    if (!ceduo_document_undo_or_redo(d, step)) {
        ceduo_app_show_message(app, "%s", redo ? _("nothing to redo") : _("nothing to undo"));
        return;
    }
    ceduo_app_refresh(app);
    ceduo_app_show_message(app, redo ? _("redone: %s") : _("undone: %s"),
                           ceduo_app_path(app, d->states[d->current + !redo].edit_name));
}

static void show_option(struct app *app, int step)
{
    size_t n = app->document.file.scene.options_count;
    ceduo_app_show_option(app, (app->option + (step > 0 ? 1 : n - 1)) % n);
    ceduo_app_show_message(app, _("option %zu of %zu: %s"), app->option + 1, n, ceduo_app_option(app)->name);
}

static void show_pane(struct app *app, int step)
{
    int panes = ceduo_views[app->view]->panes;
    ceduo_app_state(app)->pane = (ceduo_app_state(app)->pane + panes + step) % panes;
}

static void move_lines(struct app *app, int lines)
{
    if (ceduo_app_state(app)->pane == 0 && ceduo_app_form(app)->n > 0)
        ceduo_form_move(ceduo_app_form(app), lines, 0);
    else
        ceduo_app_scroll_text(app, lines);
}

static void move_page(struct app *app, int step)
{
    move_lines(app, step * (app->height > 12 ? app->height / 2 : 5));
}

static void move_column(struct app *app, int step)
{
    if (ceduo_app_state(app)->pane == 0)
        ceduo_form_move(ceduo_app_form(app), 0, step);
}

/* Move the cursor to the next line that contains the search text. */
static void search_next(struct app *app)
{
    bool found = ceduo_form_search(ceduo_app_form(app), app->search);
    ceduo_app_state(app)->pane *= !found;
    if (!found)
        ceduo_app_show_message(app, _("'%s' not found in this view"), app->search);
}

static bool submit_search_text(struct app *app, struct popup *p)
{
    ceduo_app_set_search(app, p->fields[0].line.text);
    search_next(app);
    return true;
}

static void ask_search_text(struct app *app)
{
    ceduo_popup_add_field(ceduo_popup_fields(app, _("Search in this view"), "", submit_search_text), _("word"), app->search);
}

static void change_charset(struct app *app)
{
    app->charset = (enum ceduo_charset)((app->charset + 1) % 3);
    ceduo_app_resize(app, app->cells->width, app->cells->height);
}

/* ---- commands by name ---- */

static void select_command(struct app *app, struct popup *p)
{
    ceduo_program_key(app, ceduo_actions[atoi(p->value)].key);
}

static void list_commands(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Commands"), "", select_command);
    for (int i = 0; i < ACTION_COUNT; i++)
        if (i != ACTION_COMMANDS)
            ceduo_popup_add_item(
                p, ceduo_app_format(app, "%-10s %s", ceduo_actions[i].word, ceduo_translate_in(ceduo_actions[i].help)),
                ceduo_app_format(app, "%d", i));
}

/* ---- help: the keys of the view, the field under the cursor, all keys ---- */

/* Headings of the help, each with its first action. */
static const struct {
    enum action first;
    const char *heading;
} help_groups[] = {{ACTION_UP, N_("Moving")},      {ACTION_EDIT, N_("Changing")}, {ACTION_VIEW_SLOPE, N_("Views")},
                   {ACTION_FIND, N_("Exploring")}, {ACTION_NEW, N_("Files")},     {ACTION_CHARSET, N_("Screen")}};

/* Terms of the right column. Fields are explained at the cursor. */
static const struct {
    const char *word, *meaning;
} glossary[] = {
    {N_("ADC"), N_("mean distance between stem hits along the fall line; less than 30 m passes")},
    {N_("free run"), N_("probability that a rock meets no stem over 30 m of forest")},
    {N_("two signs"), N_("of a light: today, and in the worst year ahead")},
    {N_("index"), N_("method of the paper: each contact takes the energy of one mean stem")},
    {N_("p95"), N_("95 of 100 rocks stay below it")},
    {N_("uncertainty"), N_("effect of uncertain inputs, such as the ground; more rocks do not reduce it")},
};

/* Add a key with its words. */
static void add_key(struct popup *p, const struct app *app, enum action action, const char *words)
{
    const struct action_info *a = &ceduo_actions[action];
    const char *keys = ceduo_app_format(app, "%s%s%s", a->word, a->word2[0] ? "  " : "", a->word2);
    ceduo_text_format(&p->text, "  %-16s%s\n", keys, words);
}

static void show_help(struct app *app)
{
    struct popup *p = ceduo_popup_text(app, _("Keys"));
    const struct view *view = ceduo_views[app->view];
    LOCAL_TEXT(field);
    ceduo_text_format(&p->text, _("In this view, %d %s"), app->view + 1,
                      ceduo_translate_in(ceduo_actions[ACTION_VIEW_SLOPE + app->view].help));
    ceduo_text_append_char(&p->text, '\n');
    for (int k = 0; view->bar[k].word; k++)
        add_key(p, app, view->bar[k].action, _(view->bar[k].word));
    ceduo_text_append(&p->text, " \n");
    if (ceduo_app_state(app)->pane == 0)
        ceduo_form_explain(ceduo_app_form(app), &field);
    if (field.bytes) {
        ceduo_text_append_escaped(&p->text, field.bytes);
        ceduo_text_append(&p->text, "\n \n");
    }
    ceduo_text_append(&p->text, _("Figures and pictures follow every edit at once.\n \n"));
    for (int i = 0; i < ACTION_COUNT; i++) {
        for (size_t k = 0; k < sizeof help_groups / sizeof help_groups[0]; k++)
            if ((int)help_groups[k].first == i)
                ceduo_text_format(&p->text, "%s%s\n", k > 0 ? " \n" : "", _(help_groups[k].heading));
        add_key(p, app, (enum action)i, ceduo_translate_in(ceduo_actions[i].help));
    }
    ceduo_text_append(&p->text, " \n");
    ceduo_text_append(
        &p->text, _("A star marks an assumed value. Dim values are defaults.\nType numbers with a comma or a dot, diameters in "
                    "cm, a spread as 0.6 +- 0.1 (u after it: uniform), a point as x z.\nIn a list, type to search: the best "
                    "match is first. a and y split a ground, a belt or a segment of the profile. Neighbours follow a moved "
                    "border.\nThe right column: arrivals per 1000 rocks released, without and with forest; the three lights; "
                    "energy absorbed and remaining by the index (Eq. 4 and 5 of Ciabocco et al. 2009); uncertainty.\nMouse: "
                    "click a view, a key, a field, an item, an option, a year or the slope; click again for Enter; the wheel "
                    "scrolls what is under it; hold Shift to select text in the terminal.\n"));
    ceduo_text_format(&p->text, " \n%s\n", _("Words"));
    for (size_t i = 0; i < sizeof glossary / sizeof glossary[0]; i++)
        ceduo_text_format(&p->text, "  %s: %s\n", _(glossary[i].word), _(glossary[i].meaning));
}

/* ---- actions of all views ---- */

const struct action_info ceduo_actions[ACTION_COUNT] = {
#define X(NAME, key, word, key2, word2, bar, help, binding) {key, key2, word, word2, bar, help},
    ACTIONS(X)
#undef X
};

enum action ceduo_action_find(int key)
{
    for (int i = 0; i < ACTION_COUNT; i++)
        if (key != K_NONE && (ceduo_actions[i].key == key || ceduo_actions[i].key2 == key))
            return (enum action)i;
    return ACTION_NONE;
}

int ceduo_key_find(const char *name)
{
    static const struct {
        const char *name;
        int key;
    } extra_keys[] = {{"Esc", K_ESCAPE}, {"Space", ' '}, {"Backspace", K_BACKSPACE},
                      {"F8", K_F(8)},    {"F9", K_F(9)}, {"Ctrl-U", K_CTRL_U}};
    uint32_t code;
    size_t n = strlen(name);
    if (n > 0 && ceduo_utf8_decode(name, n, &code) == n)
        return (int)code;
    for (int i = 0; i < ACTION_COUNT; i++) {
        if (strcmp(ceduo_actions[i].word, name) == 0)
            return ceduo_actions[i].key;
        if (strcmp(ceduo_actions[i].word2, name) == 0)
            return ceduo_actions[i].key2;
    }
    for (size_t i = 0; i < sizeof extra_keys / sizeof extra_keys[0]; i++)
        if (strcmp(extra_keys[i].name, name) == 0)
            return extra_keys[i].key;
    return K_NONE;
}

static void open_view(struct app *app, int view)
{
    ceduo_app_show(app, (enum view_number)view);
}

static void change_theme(struct app *app)
{
    app->theme = (app->theme + 1) % 3;
}

static void redraw(struct app *app)
{
    app->redraw = true;
}

/* Handlers of all views. */
#define RUN(f, n)                                           .handler = f, .step = n
#define DO(f)                                               .plain = f
#define X(NAME, key, word, key2, word2, bar, help, binding) [ACTION_##NAME] = {binding},
static const struct key_binding common_bindings[ACTION_COUNT] = {ACTIONS(X)};
#undef X

/* Call the handler of the view, or the common one. */
static void run_action(struct app *app, enum action action)
{
    const struct key_binding *a = ceduo_views[app->view]->bindings[ceduo_app_state(app)->pane];
    while (a && (a->handler || a->plain) && a->action != action)
        a++;
    a = a && (a->handler || a->plain) ? a : &common_bindings[action];
    if (a->handler)
        a->handler(app, a->step);
    else if (a->plain)
        a->plain(app);
}

/* ---- inputs ---- */

/* Begin an input: clear the message of the last one. */
static void begin_input(struct app *app)
{
    ceduo_arena_free(app->scratch);
    app->drawn = false;
    if (!app->popup) {
        app->message[0] = '\0';
        app->after_save = NULL;
    }
}

/* End an input: offer unsaved work, update the popup's preview and the belt under the cursor. */
static void end_input(struct app *app)
{
    if (app->just_opened && !app->no_recovery)
        ceduo_popup_recover(app);
    app->just_opened = false;
    if (app->popup)
        ceduo_popup_update_note(app);
    if (!app->quit && ceduo_views[app->view]->after_key)
        ceduo_views[app->view]->after_key(app);
}

/* True if a key has an effect in a window that is too small: it ends the tour, or it quits without a question. */
static bool ends_unseen(const struct app *app, int key)
{
    return app->tour.step ? ceduo_tour_is_end(key)
                          : ceduo_action_find(key) == ACTION_QUIT && !ceduo_document_unsaved(&app->document);
}

void ceduo_program_key(struct app *app, int key)
{
    bool first = app->plain && !app->popup && !app->tour.step, too_small = ceduo_screen_is_too_small(app);
    if ((too_small && !ends_unseen(app, key)) || (app->tour.step && !ceduo_tour_accepts(app, key)))
        return;
    begin_input(app);
    app->plain &= !first;
    if (app->tour.step)
        key = ceduo_tour_key(app, key);
    enum action action = ceduo_action_find(key);
    if (first && action == ACTION_THEME)
        ceduo_tour_start(app, NULL);
    else if (app->popup && !too_small && key != K_NONE)
        ceduo_popup_key(app, key);
    else if (action != ACTION_NONE)
        run_action(app, action);
    end_input(app);
}

void ceduo_program_interrupt(struct app *app)
{
    ceduo_program_key(app, app->popup && !ceduo_screen_is_too_small(app) ? K_ESCAPE : 'q');
}

void ceduo_program_paste(struct app *app, const char *text)
{
    if (ceduo_screen_is_too_small(app))
        return;
    begin_input(app);
    app->message[0] = '\0'; /* also the message of a popup */
    if (app->tour.step)
        ceduo_app_show_message(app, "%s", _("nothing pasted: the tour types for you"));
    else if (!app->popup || !ceduo_popup_paste(app, text))
        ceduo_app_show_message(app, "%s", _("nothing pasted: no field is open"));
    end_input(app);
}

/* Find the area under the pointer, on the screen after all inputs and results. */
static struct hit find_hit(struct app *app, int x, int y)
{
    if (!app->drawn)
        ceduo_screen_draw(app);
    for (size_t i = app->hits_count; i-- > 0;) {
        const struct hit *hit = &app->hits[i];
        int column = x - hit->area.left, line = y - hit->area.top;
        if (column >= 0 && column < hit->area.width && line >= 0 && line < hit->area.height)
            return *hit;
    }
    return (struct hit){0};
}

void ceduo_program_click(struct app *app, int x, int y)
{
    struct hit hit = find_hit(app, x, y);
    if (hit.key != K_NONE) {
        ceduo_program_key(app, hit.key);
        return;
    }
    begin_input(app);
    if (hit.click && !app->tour.step)
        hit.click(app, x - hit.area.left, y - hit.area.top + hit.first);
    end_input(app);
}

void ceduo_program_wheel(struct app *app, int x, int y, int lines)
{
    struct hit hit = find_hit(app, x, y);
    begin_input(app);
    if (hit.wheel && !app->tour.step)
        hit.wheel(app, lines);
    end_input(app);
}

bool ceduo_program_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery)
{
    bool good = ceduo_app_create(app, path, charset, threads, no_recovery);
    app->plain = good && !path;
    if (app->plain)
        ceduo_app_show_message(app, "%s",
                               _("t shows the program in ten questions; n asks for your own slope; o opens a scene"));
    if (good)
        end_input(app);
    return good;
}

bool ceduo_program_poll(struct app *app)
{
    ceduo_arena_free(app->scratch);
    const struct ceduo_scene *scene = &app->document.file.scene;
    bool changed = ceduo_live_poll(&app->live, scene);
    app->drawn = false;
    const struct ceduo_years *years = ceduo_live_years(&app->live, scene, app->option);
    union results *results = &app->live.results;
    if (years && app->year >= years->count)
        app->year = 0;
    if (results->preview)
        ceduo_popup_on_preview(app, results->preview);
    if (results->search)
        ceduo_popup_on_found(app, results->search);
    ceduo_job_results_drop(results, JOB_PREVIEW);
    ceduo_job_results_drop(results, JOB_SEARCH);
    return changed;
}
