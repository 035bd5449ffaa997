/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The value of the field under the cursor. */
#include "edit.h"

#include <stdio.h>
#include <string.h>

#include "base/intl.h"
#include "io/emit.h"
#include "popups.h"

static bool set_value(struct app *app, const struct form_cell *cell, const char *value)
{
    char path[FORM_PATH];
    snprintf(path, sizeof path, "%s", cell->path); /* the form is made anew below */
    if (value[0] == '\0') /* nothing: back to the default */
        return ceduo_app_edited(app, ceduo_document_delete(&app->document, path, &app->problems));
    struct text quoted = {0};
    if (cell->field && cell->field->type == FIELD_TEXT)
        ceduo_emit_scalar(&quoted, value, true);
    bool good = ceduo_app_set(app, path, quoted.bytes ? quoted.bytes : value);
    ceduo_text_free(&quoted);
    return good;
}

/* The whole value as it is typed: what is shown may be cut or put in other words. */
void ceduo_edit_start(struct app *app)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    if (!cell || !cell->field)
        return;
    if (cell->field->type == FIELD_CHOICE || (cell->field->flags & FIELD_FOLLOWS)) {
        ceduo_popup_choices(app, cell);
        return;
    }
    const struct node *node = ceduo_document_node(&app->document, cell->path);
    struct text text = {0};
    if (node && node->kind == NODE_SCALAR)
        ceduo_text_put(&text, node->text);
    else if (node)
        ceduo_emit_flow(&text, node);
    else
        ceduo_text_put(&text, cell->text);
    ceduo_line_set(&app->line, ceduo_text_string(&text));
    ceduo_text_free(&text);
    app->editing = true;
}

void ceduo_edit_key(struct app *app, int key)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    if (key == K_ESCAPE || !cell) {
        app->editing = false;
    } else if (key == K_ENTER || key == K_TAB) {
        if (set_value(app, cell, app->line.text)) {
            app->editing = false;
            if (key == K_TAB)
                ceduo_form_move(ceduo_app_form(app), 0, 1);
        }
    } else {
        ceduo_line_key(&app->line, key);
    }
}

void ceduo_edit_step(struct app *app, int direction)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    struct text value = {0};
    if (!cell || !ceduo_form_step(&app->document, cell, direction, &value) || !value.bytes)
        ceduo_app_say(app, "%s", _("this field has no steps; Enter edits it"));
    else if (strcmp(value.bytes, cell->text) == 0)
        ceduo_app_say(app, "%s", _("the limit of its range"));
    else
        set_value(app, cell, value.bytes);
    ceduo_text_free(&value);
}
