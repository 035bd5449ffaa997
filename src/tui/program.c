/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "program.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/language.h"
#include "edit.h"
#include "popup.h"
#include "popups.h"
#include "screen.h"
#include "view/typed.h"

static void undo_or_redo(struct app *app, bool redo)
{
    struct document *d = &app->document;
    const char *what = redo ? (d->at + 1 < d->count ? d->states[d->at + 1].what : "") : d->states[d->at].what;
    char line[200];
    struct text words = {0};
    ceduo_shown_path(what, &words);
    snprintf(line, sizeof line, "%.199s", ceduo_text_string(&words));
    ceduo_text_free(&words);
    if (!(redo ? ceduo_document_redo(d) : ceduo_document_undo(d))) {
        ceduo_app_say(app, "%s", redo ? _("nothing to redo") : _("nothing to undo"));
        return;
    }
    ceduo_app_refresh(app);
    if (redo)
        ceduo_app_say(app, _("again: %s"), line);
    else
        ceduo_app_say(app, _("undone: %s"), line);
}

static void next_option(struct app *app, int by)
{
    size_t n = app->document.file.scene.options_count;
    ceduo_app_show_option(app, (app->option + (by > 0 ? 1 : n - 1)) % n);
    ceduo_app_say(app, _("option %zu of %zu: %s"), app->option + 1, n, ceduo_app_option(app)->name);
}

static void next_pane(struct app *app, int by)
{
    int panes = ceduo_views[app->view]->panes;
    ceduo_app_state(app)->pane = (ceduo_app_state(app)->pane + panes + by) % panes;
}

static void move_cursor(struct app *app, int lines, int columns)
{
    struct view_state *state = ceduo_app_state(app);
    if (state->pane == 0 && state->form.n > 0)
        ceduo_form_move(&state->form, lines, columns);
    else
        state->scroll = state->scroll + lines > 0 ? state->scroll + lines : 0;
}

static bool filled_search(struct app *app, struct popup *p)
{
    snprintf(app->search, sizeof app->search, "%.*s", (int)sizeof app->search - 1, p->fields[0].text);
    ceduo_app_search(app);
    return true;
}

static void ask_for_word(struct app *app)
{
    struct popup *p = ceduo_popup_fields(app, _("Search in this view"), filled_search);
    if (p)
        ceduo_popup_field(p, _("word"), app->search);
}

static void next_charset(struct app *app)
{
    app->charset = (enum ceduo_charset)((app->charset + 1) % 3);
    ceduo_app_resize(app, app->width, app->height);
}

/* ---- commands by name ---- */

static void chose_command(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    ceduo_program_key(app, ceduo_actions[atoi(value)].key);
}

static void list_commands(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("Commands"), chose_command);
    for (int i = 0; p && i < ACTION_COUNT; i++) {
        char line[160], value[16];
        if (i == ACTION_COMMANDS)
            continue;
        snprintf(line, sizeof line, "%-10s %s", ceduo_actions[i].word, _(ceduo_actions[i].help));
        snprintf(value, sizeof value, "%d", i);
        ceduo_popup_item(p, line, value);
    }
}

static void act(struct app *app, enum action action)
{
    int page = app->height > 12 ? app->height / 2 : 5;
    switch (action) {
    case ACTION_UP:
        move_cursor(app, -1, 0);
        break;
    case ACTION_DOWN:
        move_cursor(app, 1, 0);
        break;
    case ACTION_LEFT:
        move_cursor(app, 0, -1);
        break;
    case ACTION_RIGHT:
        move_cursor(app, 0, 1);
        break;
    case ACTION_TOP:
        move_cursor(app, -100000, 0);
        break;
    case ACTION_BOTTOM:
        move_cursor(app, ceduo_app_state(app)->pane == 0 ? 100000 : 50, 0);
        break;
    case ACTION_PAGE_UP:
        move_cursor(app, -page, 0);
        break;
    case ACTION_PAGE_DOWN:
        move_cursor(app, page, 0);
        break;
    case ACTION_EDIT:
        ceduo_edit_start(app);
        break;
    case ACTION_MORE:
        ceduo_edit_step(app, 1);
        break;
    case ACTION_LESS:
        ceduo_edit_step(app, -1);
        break;
    case ACTION_ADD:
        ceduo_items_add(app);
        break;
    case ACTION_DELETE:
        ceduo_items_delete(app);
        break;
    case ACTION_DUPLICATE:
        ceduo_items_duplicate(app);
        break;
    case ACTION_EARLIER:
        ceduo_items_move(app, -1);
        break;
    case ACTION_LATER:
        ceduo_items_move(app, 1);
        break;
    case ACTION_UNDO:
        undo_or_redo(app, false);
        break;
    case ACTION_REDO:
        undo_or_redo(app, true);
        break;
    case ACTION_PRESETS:
        ceduo_popup_presets(app);
        break;
    case ACTION_COUNTS:
        ceduo_popup_counts(app);
        break;
    case ACTION_NEXT_PANE:
        next_pane(app, 1);
        break;
    case ACTION_LAST_PANE:
        next_pane(app, -1);
        break;
#define V(NAME, name, key, word, help)                                                                                         \
    case ACTION_VIEW_##NAME:                                                                                                   \
        ceduo_app_show(app, VIEW_##NAME);                                                                                      \
        break;
        VIEWS(V)
#undef V
    case ACTION_FIND:
        ceduo_popup_find(app);
        break;
    case ACTION_NEXT_OPTION:
        next_option(app, 1);
        break;
    case ACTION_LAST_OPTION:
        next_option(app, -1);
        break;
    case ACTION_NEXT_ROCK:
        ceduo_app_next_rock(app, 1);
        break;
    case ACTION_LAST_ROCK:
        ceduo_app_next_rock(app, -1);
        break;
    case ACTION_SEARCH:
        ask_for_word(app);
        break;
    case ACTION_AGAIN:
        ceduo_app_search(app);
        break;
    case ACTION_COMMANDS:
        list_commands(app);
        break;
    case ACTION_NEW:
        ceduo_popup_new(app);
        break;
    case ACTION_OPEN:
        ceduo_popup_open(app);
        break;
    case ACTION_SAVE:
        ceduo_popup_save(app);
        break;
    case ACTION_SAVE_AS:
        ceduo_popup_save_as(app);
        break;
    case ACTION_EXPORT:
        ceduo_popup_export(app);
        break;
    case ACTION_CHARSET:
        next_charset(app);
        break;
    case ACTION_THEME:
        app->theme = (app->theme + 1) % 3;
        break;
    case ACTION_REDRAW:
        app->redraw = true;
        break;
    case ACTION_HELP:
        ceduo_popup_help(app);
        break;
    case ACTION_QUIT:
        ceduo_popup_quit(app);
        break;
    default:
        break;
    }
}

/* What a key or a choice has led to. */
static void settle(struct app *app)
{
    if (app->opened && !app->no_recovery)
        ceduo_popup_recover(app);
    app->opened = false;
    if (app->popup)
        ceduo_popup_look(app);
    if (!app->quit && ceduo_views[app->view]->follow)
        ceduo_views[app->view]->follow(app);
}

void ceduo_program_key(struct app *app, int key)
{
    const struct view *view = ceduo_views[app->view];
    enum action action = ceduo_action_of(key);
    if (app->popup) {
        ceduo_popup_key(app, key);
    } else if (app->editing) {
        app->message[0] = '\0';
        ceduo_edit_key(app, key);
    } else {
        app->message[0] = '\0';
        app->once_saved = NULL;
        if (action != ACTION_NONE && !(view->act && view->act(app, action)))
            act(app, action);
    }
    settle(app);
}

void ceduo_program_paste(struct app *app, const char *text)
{
    app->message[0] = '\0';
    if (app->popup ? !ceduo_popup_paste(app, text) : !app->editing)
        ceduo_app_say(app, "%s", _("what was pasted goes nowhere: no field is open"));
    else if (!app->popup && !ceduo_line_paste(&app->line, text))
        ceduo_app_warn(app, "%s", _(CEDUO_LINE_FULL));
    settle(app);
}

void ceduo_program_click(struct app *app, int x, int y)
{
    struct view_state *state = ceduo_app_state(app);
    size_t row, column;
    if (app->popup || app->editing)
        return;
    if (y == 0) {
        enum view_number view = ceduo_screen_view_at(app, x);
        if (view < VIEW_COUNT)
            ceduo_app_show(app, view);
    } else if (ceduo_form_hit(&state->form, state->form_area, x, y, &row, &column)) {
        bool again = state->form.row == row && state->form.column == column && state->pane == 0;
        state->form.row = row;
        state->form.column = column;
        state->pane = 0;
        ceduo_form_settle(&state->form);
        if (again)
            ceduo_edit_start(app);
    }
}

void ceduo_program_wheel(struct app *app, int lines)
{
    if (app->popup) {
        ceduo_popup_key(app, lines < 0 ? K_UP : K_DOWN);
        settle(app);
    } else if (!app->editing)
        move_cursor(app, lines, 0);
}

bool ceduo_program_create(struct app *app, const char *path, enum ceduo_charset charset, unsigned threads, bool no_recovery,
                          struct problems *problems)
{
    if (!ceduo_app_create(app, path, charset, threads, no_recovery, problems))
        return false;
    settle(app);
    return true;
}

void ceduo_program_free(struct app *app)
{
    ceduo_popup_close(app);
    ceduo_app_free(app);
}

bool ceduo_program_news(struct app *app)
{
    bool changed = ceduo_app_news(app);
    union results *results = &app->live.results;
    if (results->preview)
        ceduo_popup_previewed(app, results->preview);
    if (results->search)
        ceduo_popup_found(app, results->search);
    ceduo_results_drop(results, JOB_PREVIEW);
    ceduo_results_drop(results, JOB_SEARCH);
    return changed;
}
