/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Saving, and questions about unsaved work of this and earlier processes. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/language.h"
#include "io/file.h"
#include "popup.h"

#define ENDING ".yaml"

/* ---- saving ---- */

/* Save, and report. Return false with errno set. */
static bool save_to(struct app *app, const char *path)
{
    bool reformatted;
    const char *old = app->document.path; /* name of the old file if it is another */
    old = old && strcmp(old, path) != 0 ? ceduo_app_format(app, "%s", ceduo_file_name(old)) : NULL;
    if (ceduo_document_is_shipped(path)) {
        ceduo_app_warn(app, "%s", _("This scene is part of the program and cannot be changed; save your own copy."));
        return false;
    }
    if (!ceduo_document_save(&app->document, path, &reformatted)) {
        int reason = errno;
        ceduo_app_warn(app, "%s: %s", path, ceduo_error_text(reason));
        errno = reason;
        return false;
    }
    if (reformatted)
        ceduo_app_show_message(app,
                               old ? _("saved %s; reformatted, without the comments of %s")
                                   : _("saved %s; reformatted, the old file is %s.bak"),
                               path, old ? old : path);
    else
        ceduo_app_show_message(app, _("saved %s"), path);
    if (app->after_save)
        app->after_save(app);
    app->after_save = NULL;
    return true;
}

/* Append .yaml to a name without an ending, unless the file exists. */
static void append_ending(struct line *line)
{
    const char *name = ceduo_file_name(line->text);
    size_t n = strlen(line->text);
    if (name[0] == '\0' || strchr(name + 1, '.') || access(line->text, F_OK) == 0 || n + sizeof ENDING > sizeof line->text)
        return;
    memcpy(line->text + n, ENDING, sizeof ENDING);
    line->cursor = strlen(line->text);
}

static bool submit_save(struct app *app, struct popup *p)
{
    append_ending(&p->fields[0].line);
    const char *path = p->fields[0].line.text;
    bool own = app->document.path && strcmp(app->document.path, path) == 0 && !ceduo_document_changed_on_disk(&app->document);
    if (path[0] == '\0') {
        ceduo_app_warn(app, "%s", _("a name is needed"));
        return false;
    }
    return (own || ceduo_popup_confirm_overwrite(app, p, true)) && save_to(app, path);
}

void ceduo_popup_offer_files(struct app *app, struct popup *p)
{
    (void)app;
    ceduo_picker_add_files(&p->picker, p->fields[p->current].line.text, p->endings);
}

/* ---- a name for a changed stand ---- */

static bool submit_stand_name(struct app *app, struct popup *p)
{
    const char *name = p->fields[0].line.text;
    if (name[0] == '\0')
        ceduo_app_warn(app, "%s", _("a name is needed"));
    if (name[0] == '\0' ||
        !ceduo_app_finish_edit(app, ceduo_document_set(&app->document, p->target, ceduo_app_scalar(app, name))))
        return false;
    p->on_done(app);
    return true;
}

/* Ask for the name of the first changed stand, then call `next`. Return false if there is none. */
static bool ask_stand_name(struct app *app, void (*next)(struct app *app))
{
    const struct ceduo_scene *scene = &app->document.file.scene;
    bool options = ceduo_node_get(app->document.file.root, "options");
    for (size_t o = 0; o < scene->options_count; o++)
        for (size_t b = 0; b < scene->options[o].belts_count; b++) {
            const struct ceduo_belt *belt = &scene->options[o].belts[b];
            if (!belt->changed)
                continue;
            const char *option = options ? ceduo_app_format(app, "options[%zu].", o) : "";
            const char *path = ceduo_app_format(app, "%sforest[%zu].stand.name", option, b);
            struct popup *p = ceduo_popup_fields(app, _("Name of the changed stand"), path, submit_stand_name);
            ceduo_text_format(&p->text, _("The stand from %g to %g m in '%s' no longer matches its name."), belt->from_given,
                              belt->to_given, scene->options[o].name);
            p->on_done = next;
            ceduo_popup_add_field(p, _("name"), belt->name);
            return true;
        }
    return false;
}

/* ---- the file ---- */

/* Ask for a file name. `reason`: the last attempt failed; may be NULL. */
static void ask_file_name(struct app *app, const char *reason)
{
    struct popup *p = ceduo_popup_fields(app, _("Save as"), "", submit_save);
    const struct document *d = &app->document;
    if (reason)
        ceduo_text_format(&p->text, _("Saving failed: %s. Choose another name or folder."), reason);
    else if (d->shipped)
        ceduo_text_append(&p->text, _("This scene is part of the program and cannot be changed; save your own copy."));
    p->endings = ENDING;
    p->keep_input = true;
    ceduo_popup_add_choice(p, _("file"),
                           !d->path     ? "scene.yaml"
                           : d->shipped ? ceduo_file_name(d->path)
                                        : d->path,
                           ceduo_popup_offer_files);
}

void ceduo_popup_save_as(struct app *app)
{
    if (!ask_stand_name(app, ceduo_popup_save_as))
        ask_file_name(app, NULL);
}

/* Save to the file of the scene. */
static void save_to_own_file(struct app *app)
{
    const char *path = ceduo_app_format(app, "%s", app->document.path); /* copy: saving frees the document's path */
    if (!save_to(app, path))
        ask_file_name(app, ceduo_error_text(errno));
}

static void select_disk_action(struct app *app, struct popup *p)
{
    if (strcmp(p->value, "write") == 0)
        save_to_own_file(app);
    else if (strcmp(p->value, "as") == 0)
        ask_file_name(app, NULL);
}

void ceduo_popup_save(struct app *app)
{
    const struct document *d = &app->document;
    if (ask_stand_name(app, ceduo_popup_save))
        return;
    if (!d->path || d->shipped) {
        ask_file_name(app, NULL);
    } else if (!ceduo_document_changed_on_disk(d)) {
        save_to_own_file(app);
    } else {
        bool missing = access(d->path, F_OK) != 0;
        struct popup *p = ceduo_popup_list(
            app, missing ? _("The file no longer exists") : _("The file has changed on disk since it was read"), "",
            select_disk_action);
        ceduo_popup_add_menu_item(p, 'n', _("no: do not save now"), "");
        ceduo_popup_add_menu_item(p, 'a', _("save under another name"), "as");
        ceduo_popup_add_menu_item(p, 'w', missing ? _("write it again") : _("overwrite it"), "write");
    }
}

/* ---- unsaved work ---- */

static void select_unsaved_action(struct app *app, struct popup *p)
{
    if (strcmp(p->value, "save") == 0) {
        app->after_save = p->on_done; /* after a name is given, if needed */
        ceduo_popup_save(app);
    } else if (strcmp(p->value, "discard") == 0) {
        p->on_done(app);
    }
}

void ceduo_popup_confirm_unsaved(struct app *app, void (*next)(struct app *app))
{
    if (!ceduo_document_unsaved(&app->document)) {
        next(app);
        return;
    }
    struct popup *p = ceduo_popup_list(app, _("There are unsaved changes"), "", select_unsaved_action);
    p->on_done = next;
    ceduo_popup_add_menu_item(p, 'n', _("no: stay here"), "");
    ceduo_popup_add_menu_item(p, 's', _("save them"), "save");
    ceduo_popup_add_menu_item(p, 'd', _("discard them"), "discard");
}

static void quit_program(struct app *app)
{
    ceduo_recovery_delete(&app->document.recovery);
    app->quit = true;
}

void ceduo_popup_quit(struct app *app)
{
    ceduo_popup_confirm_unsaved(app, quit_program);
}

/* ---- abandoned work ---- */

#define RECOVERY "recover:" /* prefix of the path of a copy */
#define DELETE   "delete"
#define ALL      "all"

/* Return the age of a copy in words. */
static const char *describe_age(const struct app *app, time_t when)
{
    double minutes = fmax(difftime(time(NULL), when) / 60, 0), hours = minutes / 60, days = hours / 24;
    return hours < 1  ? ceduo_app_format(app, _("%.0f min ago"), floor(minutes))
           : days < 2 ? ceduo_app_format(app, _("%.0f h ago"), floor(hours))
                      : ceduo_app_format(app, _("%.0f days ago"), floor(days));
}

/* Add a copy to the list. `key`: chooses it; 0: found by typing. */
static void add_recovery(const struct app *app, struct popup *p, const struct recovery *r, char key)
{
    char date[32] = "";
    struct tm tm;
    if (localtime_r(&r->when, &tm))
        strftime(date, sizeof date, "%Y-%m-%d %H:%M", &tm);
    const char *words =
        ceduo_app_format(app, "%s, %s: %s, %s", date, describe_age(app, r->when),
                         r->scene ? ceduo_file_name(r->scene) : _("never saved"), r->title[0] ? r->title : _("no title"));
    const char *value = ceduo_app_format(app, RECOVERY "%s", r->file);
    if (key)
        ceduo_popup_add_menu_item(p, key, words, value);
    else
        ceduo_popup_add_item(p, ceduo_app_format(app, _("unsaved changes of %s"), words), value);
}

void ceduo_popup_offer_recoveries(const struct app *app, struct popup *p)
{
    size_t n;
    struct recovery *list = ceduo_recovery_list(&p->arena, &n);
    for (size_t i = 0; i < n; i++)
        add_recovery(app, p, &list[i], 0);
}

/* True if a copy is of this scene, or of a scene without a file. */
static bool is_of_this_document(const struct app *app, const struct recovery *r)
{
    char *own_path = app->document.path ? realpath(app->document.path, NULL) : NULL;
    bool matches = !r->scene || (own_path && strcmp(own_path, r->scene) == 0);
    free(own_path);
    return matches;
}

bool ceduo_popup_open_recovery(struct app *app, const char *value)
{
    LOCAL_ARENA(arena);
    size_t n;
    if (strncmp(value, RECOVERY, strlen(RECOVERY)) != 0)
        return false;
    const struct recovery *list = ceduo_recovery_list(&arena, &n);
    for (size_t i = 0; i < n; i++) {
        if (strcmp(list[i].file, value + strlen(RECOVERY)) != 0)
            continue;
        char *text = ceduo_recovery_text(list[i].file);
        if (text && (list[i].scene ? (is_of_this_document(app, &list[i]) || ceduo_app_open(app, list[i].scene, NULL)) &&
                                         ceduo_app_finish_edit(app, ceduo_document_recover(&app->document, text))
                                   : ceduo_app_open(app, NULL, text))) {
            unlink(list[i].file); /* this process keeps its own copy now */
            app->just_opened = false;
            ceduo_app_show_message(app, "%s", _("changes recovered; s saves, u undoes"));
        }
        free(text);
    }
    return true;
}

/* List the copies as a menu, the newest first, or those of a named document first. The first nine have a digit. */
static struct popup *list_recoveries(struct app *app, const char *title, popup_call *on_select)
{
    struct popup *p = ceduo_popup_list(app, title, "", on_select);
    size_t n;
    const struct recovery *list = ceduo_recovery_list(&p->arena, &n);
    char key = '1';
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < n; i++)
            if ((app->plain || is_of_this_document(app, &list[i])) == !pass)
                add_recovery(app, p, &list[i], key <= '9' ? key++ : ' ');
    return p;
}

static void offer_recoveries(struct app *app);

/* Delete a copy, or all that were listed, and offer the others again. */
static void select_deleted(struct app *app, struct popup *p)
{
    LOCAL_ARENA(arena);
    size_t n;
    const struct recovery *list = ceduo_recovery_list(&arena, &n);
    for (size_t i = 0; i < n; i++) {
        const char *value = ceduo_app_format(app, RECOVERY "%s", list[i].file);
        if (strcmp(p->value, ALL) == 0 ? ceduo_picker_has(&p->picker, value) : strcmp(p->value, value) == 0)
            unlink(list[i].file);
    }
    ceduo_recovery_list(&arena, &n);
    if (n > 0)
        offer_recoveries(app);
}

static void select_recovery(struct app *app, struct popup *p)
{
    if (strcmp(p->value, DELETE) != 0) {
        ceduo_popup_open_recovery(app, p->value);
        return;
    }
    struct popup *deleted = list_recoveries(app, _("Delete which unsaved changes?"), select_deleted);
    ceduo_popup_add_menu_item(deleted, 'n', _("none"), "");
    ceduo_popup_add_menu_item(deleted, 'a', _("all of them"), ALL);
}

static void offer_recoveries(struct app *app)
{
    struct popup *p = list_recoveries(app, _("Unsaved changes were found: open which?"), select_recovery);
    ceduo_popup_add_menu_item(p, 'n', _("not now: o lists them, too"), "");
    ceduo_popup_add_menu_item(p, 'd', _("delete some"), DELETE);
}

void ceduo_popup_recover(struct app *app)
{
    LOCAL_ARENA(arena);
    size_t n;
    const struct recovery *list = ceduo_recovery_list(&arena, &n);
    bool offers = app->plain && n > 0;
    for (size_t i = 0; i < n; i++)
        offers |= is_of_this_document(app, &list[i]);
    if (offers)
        offer_recoveries(app);
}
