/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The value of the field under the cursor. */
#include "edit.h"

#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "io/emit.h"
#include "popups.h"
#include "view/typed.h"

/* A refusal begins with the field's label, not with its key or path. */
static void name_field(struct app *app, const struct field *field)
{
    size_t n = strcspn(app->message, " ");
    bool key = n > 1 && app->message[n - 1] == ':' &&
               ((size_t)strcspn(app->message, "_.[") < n || strncmp(app->message, field->key, n - 1) == 0);
    if (!key || !app->message[n])
        return;
    ceduo_app_warn(app, "%s: %s", _(field->shown.label), ceduo_app_format(app, "%s", app->message + n + 1));
}

static bool set_value(struct app *app, const struct form_cell *cell, const char *value)
{
    const char *path = ceduo_app_format(app, "%s", cell->path); /* the form is made anew below */
    if (value[0] == '\0')                                       /* nothing: back to the default */
        return ceduo_app_edited(app, ceduo_document_delete(&app->document, path, &app->problems));
    struct text written = {0};
    if (cell->field && cell->field->type == FIELD_TEXT)
        ceduo_emit_scalar(&written, value, true);
    else if (cell->field)
        ceduo_typed_value(cell->field, value, &written);
    const struct field *field = cell->field;
    bool good = ceduo_app_set(app, path, field ? ceduo_text_string(&written) : value);
    if (!good && field)
        name_field(app, field);
    ceduo_text_free(&written);
    return good;
}

/* What was typed may be refused or asked back; the same once more is taken. */
static bool is_meant(struct app *app, const struct form_cell *cell, const char *typed)
{
    struct text why = {0};
    bool good = !cell->field || ceduo_typed_in_range(cell->field, typed, &why);
    bool sure = !good || app->line.asked || !cell->field || !ceduo_typed_unusual(cell->field, typed, &why);
    if (!good || !sure)
        ceduo_app_warn(app, "%s", ceduo_text_string(&why));
    app->line.asked = good && !sure;
    ceduo_text_free(&why);
    return good && sure;
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
    ceduo_text_free(&text);
    app->editing = true;
}

void ceduo_edit_key(struct app *app, int key)
{
    struct form_cell *cell = ceduo_form_cell(ceduo_app_form(app));
    if (key == K_ESCAPE || !cell) {
        app->editing = false;
    } else if (key == K_ENTER || key == K_TAB) {
        if (is_meant(app, cell, app->line.text) && set_value(app, cell, app->line.text)) {
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
