/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The value of the field under the cursor. */
#include <string.h>

#include "base/language.h"
#include "io/emit.h"
#include "popup.h"
#include "view/typed.h"

static bool set_value(struct app *app, const struct form_cell *cell, const char *value)
{
    const struct field *field = cell->field;
    const char *path = ceduo_app_format(app, "%s", cell->path); /* the form is made anew below */
    LOCAL_TEXT(written);
    if (value[0] == '\0') /* nothing: back to the default */
        return ceduo_app_edited(app, ceduo_document_delete(&app->document, path, &app->problems));
    if (field->type == FIELD_TEXT || field->type == FIELD_FILE)
        ceduo_emit_scalar(&written, value, true);
    else
        ceduo_typed_value(field, value, &written);
    if (ceduo_app_set(app, path, ceduo_text_string(&written)))
        return true;
    size_t n = strcspn(app->message, " "); /* the refusal begins with the field's label, not with its key or path */
    if (n > 1 && app->message[n] && app->message[n - 1] == ':' &&
        (strcspn(app->message, "_.[") < n || strncmp(app->message, field->key, n - 1) == 0))
        ceduo_app_warn(app, "%s: %s", _(field->shown.label), ceduo_app_format(app, "%s", app->message + n + 1));
    return false;
}

/* The whole value as it is typed: what is shown may be cut or put in other words. */
void ceduo_edit_start(struct app *app)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    if (!cell)
        return;
    if (cell->field->type == FIELD_CHOICE || (cell->field->flags & FIELD_FOLLOWS)) {
        ceduo_popup_choices(app, cell);
        return;
    }
    const struct node *node = ceduo_document_node(&app->document, cell->path);
    LOCAL_TEXT(text);
    bool plain = node && node->kind == NODE_LIST && strlen(cell->text) + 1 < sizeof cell->text; /* shown whole: with blanks */
    for (size_t i = 0; plain && i < node->n; i++)
        plain = node->items[i]->kind == NODE_SCALAR;
    if (node && node->kind == NODE_SCALAR)
        ceduo_shown_value(cell->field, node->text, &text);
    else if (node && cell->field->type != FIELD_SPREAD && !plain)
        ceduo_emit_flow(&text, node);
    else
        ceduo_text_put(&text, cell->text);
    ceduo_line_set(&app->line, ceduo_text_string(&text));
    app->editing = true;
}

void ceduo_edit_key(struct app *app, int key)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    if (key == K_ESCAPE || !cell) {
        app->editing = false;
    } else if (key == K_ENTER || key == K_TAB) {
        if (!ceduo_popup_is_meant(app, cell->field, &app->line) || !set_value(app, cell, app->line.text))
            return;
        app->editing = false;
        if (key == K_TAB)
            ceduo_form_move(ceduo_app_form(app), 0, 1);
    } else {
        ceduo_line_key(&app->line, key);
    }
}

void ceduo_edit_step(struct app *app, int direction)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    LOCAL_TEXT(value);
    if (!ceduo_form_step(ceduo_app_form(app), direction, &value) || !value.bytes)
        ceduo_app_say(app, "%s", _("this field has no steps; Enter edits it"));
    else if (strcmp(value.bytes, cell->text) == 0)
        ceduo_app_say(app, "%s", _("the limit of its range"));
    else
        set_value(app, cell, value.bytes);
}
