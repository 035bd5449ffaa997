/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Saving, and all questions about unsaved work. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/intl.h"
#include "popup.h"
#include "model/recovery.h"
#include "popups.h"

/* ---- saving ---- */

/* False with errno set, and said. */
static bool save_to(struct app *app, const char *path)
{
    bool anew;
    if (ceduo_document_is_shipped(path)) {
        ceduo_app_warn(app, _("%s belongs to the program and is never written over; choose another name"), path);
        return false;
    }
    char from[256] = ""; /* the file of before, where it is another */
    const char *old = app->document.path, *slash = old ? strrchr(old, '/') : NULL;
    if (old && strcmp(old, path) != 0)
        snprintf(from, sizeof from, "%s", slash ? slash + 1 : old);
    if (!ceduo_document_save(&app->document, path, &anew)) {
        int why = errno;
        ceduo_app_warn(app, "%s: %s", path, strerror(why));
        errno = why;
        return false;
    }
    if (anew && from[0])
        ceduo_app_say(app, _("saved %s; laid out anew, without the comments of %s"), path, from);
    else if (anew)
        ceduo_app_say(app, _("saved %s; laid out anew, the old file is %s.bak"), path, path);
    else
        ceduo_app_say(app, _("saved %s"), path);
    app->quit |= app->quit_once_saved;
    return true;
}

static bool filled_save(struct app *app, struct popup *p)
{
    const char *path = p->fields[0].text;
    bool own = app->document.path && strcmp(app->document.path, path) == 0 &&
               !ceduo_document_changed_on_disk(&app->document);
    if (path[0] == '\0') {
        ceduo_app_warn(app, "%s", _("a name is needed"));
        return false;
    }
    return (own || ceduo_popup_may_write(app, p)) && save_to(app, path);
}

/* `why` the last attempt failed; NULL: none did. */
static void ask_for_name(struct app *app, const char *why)
{
    struct popup *p = ceduo_popup_fields(app, _("Save as"), filled_save);
    if (!p)
        return;
    const struct document *d = &app->document;
    if (why)
        ceduo_text_format(&p->text, _("It could not be saved: %s. Give another name, or one in another folder."), why);
    else if (d->shipped)
        ceduo_text_put(&p->text, _("This scene belongs to the program and is never written over; save your own copy."));
    const char *slash = d->path && d->shipped ? strrchr(d->path, '/') : NULL;
    ceduo_popup_field(p, _("file"), slash ? slash + 1 : d->path ? d->path : "scene.yaml");
}

void ceduo_popup_save_as(struct app *app)
{
    ask_for_name(app, NULL);
}

/* Writes where the scene came from. */
static void write_back(struct app *app)
{
    char *path = strdup(app->document.path); /* saving makes the document's own anew */
    bool good = path && save_to(app, path);
    int why = errno;
    if (!path)
        ceduo_app_warn(app, "%s: %s", app->document.path, strerror(why));
    free(path);
    if (!good)
        ask_for_name(app, strerror(why));
}

static void chose_disk(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    if (strcmp(value, "write") == 0)
        write_back(app);
    else if (strcmp(value, "as") == 0)
        ask_for_name(app, NULL);
}

static void ask_which(struct app *app)
{
    struct popup *p = ceduo_popup_list(app, _("The file has changed on disk since it was read"), chose_disk);
    ceduo_popup_item(p, _("never mind: do not save now"), "");
    ceduo_popup_item(p, _("save under another name"), "as");
    ceduo_popup_item(p, _("write over what is there"), "write");
}

void ceduo_popup_save(struct app *app)
{
    if (!app->document.path || app->document.shipped)
        ask_for_name(app, NULL);
    else if (ceduo_document_changed_on_disk(&app->document))
        ask_which(app);
    else
        write_back(app);
}

/* ---- unsaved work ---- */

bool ceduo_popup_unsaved(struct app *app)
{
    if (!ceduo_document_unsaved(&app->document))
        return false;
    ceduo_app_warn(app, "%s", _("unsaved work: s saves it, or u back to what is saved, before another scene is opened"));
    return true;
}

static void chose_quit(struct app *app, struct popup *p, const char *value)
{
    (void)p;
    if (strcmp(value, "save") == 0) {
        app->quit_once_saved = true; /* once a name is given, where one is asked for */
        ceduo_popup_save(app);
    } else if (strcmp(value, "drop") == 0) {
        ceduo_document_forget(&app->document);
        app->quit = true;
    }
}

void ceduo_popup_quit(struct app *app)
{
    app->quit = !ceduo_document_unsaved(&app->document);
    if (app->quit)
        return;
    struct popup *p = ceduo_popup_list(app, _("There is unsaved work"), chose_quit);
    ceduo_popup_item(p, _("stay"), "");
    ceduo_popup_item(p, _("save and quit"), "save");
    ceduo_popup_item(p, _("quit and lose it"), "drop");
}

static void chose_recover(struct app *app, struct popup *p, const char *value)
{
    bool without_file = value[0] == 'o';
    if (strcmp(value, "forget") == 0) {
        unlink(p->path);
    } else if (without_file ? ceduo_app_open_text(app, p->kept)
                            : ceduo_app_edited(app, ceduo_document_recover(&app->document, p->kept, &app->problems))) {
        unlink(p->path); /* this program keeps a copy of its own now */
        ceduo_app_say(app, "%s", _("your work is back; s saves it, u shows what was before"));
    }
}

void ceduo_popup_recover(struct app *app)
{
    char *file = NULL, *text = ceduo_recovery_find(app->document.path, &file);
    bool without_file = !text && app->document.path;
    if (without_file)
        text = ceduo_recovery_find(NULL, &file);
    if (!text)
        return;
    struct popup *p = ceduo_popup_list(app, without_file ? _("A new scene that was never saved was left behind")
                                                         : _("Unsaved work on this scene was left behind"),
                                       chose_recover);
    if (p && strlen(file) < sizeof p->path) {
        snprintf(p->path, sizeof p->path, "%s", file);
        p->kept = text;
        text = NULL;
        ceduo_popup_item(p, _("take it up again"), without_file ? "open" : "take");
        ceduo_popup_item(p, _("forget it"), "forget");
    } else {
        ceduo_popup_close(app);
    }
    free(text);
    free(file);
}
