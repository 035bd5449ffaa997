/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new item of a list: what it must and may have, field by field as the table of the scene has them. */
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "popup.h"
#include "popups.h"
#include "view/typed.h"

/* The popup's path is that of the list, a '#' and the group. */
static const struct object *object_of(const struct popup *p, const char **group)
{
    char list[64];
    const char *mark = strchr(p->path, '#');
    snprintf(list, sizeof list, "%.*s", (int)(mark - p->path), p->path);
    const struct object *object = ceduo_schema_field(ceduo_schema_scene(), list)->object;
    *group = mark + 1;
    return **group ? ceduo_schema_field(object, *group)->object : object;
}

/* Those that are typed: files of values are named in the scene's file. */
static const struct field *field_of(const struct object *object, size_t i)
{
    for (size_t k = 0; k < object->n; k++) {
        enum field_type type = object->fields[k].type;
        bool typed = type == FIELD_NUMBER || type == FIELD_NUMBERS || type == FIELD_COUNT || type == FIELD_SPREAD;
        if (typed && i-- == 0)
            return &object->fields[k];
    }
    return NULL;
}

/* What is typed as the file has it; false where it is none, which is said. */
static bool read_field(struct app *app, const struct field *f, const char *typed, struct text *value)
{
    LOCAL_TEXT(why);
    double number;
    bool list = f->type == FIELD_NUMBERS, good = ceduo_typed_in_range(f, typed, &why);
    if (!good)
        ceduo_app_warn(app, "%s", ceduo_text_string(&why));
    if (good && !typed[0] && f->flags & FIELD_REQUIRED) {
        ceduo_app_warn(app, _("%s: it is needed; %s"), _(f->shown.label), _(f->meaning));
        return false;
    }
    if (typed[0])
        ceduo_typed_value(f, typed, value);
    const char *written = ceduo_text_string(value);
    bool plain =
        !typed[0] || (list ? written[0] == '[' : written[0] == '{' || ceduo_number_read(written, &number) == CEDUO_NUMBER_GOOD);
    if (good && !plain)
        ceduo_app_warn(app, list ? _("%s: numbers with blanks between them, not '%s'") : _("%s: '%s' is not a number"),
                       _(f->shown.label), typed);
    return good && plain;
}

static bool check_field(struct app *app, struct popup *p, size_t i)
{
    const char *group;
    LOCAL_TEXT(value);
    return read_field(app, field_of(object_of(p, &group), i), p->fields[i].text, &value);
}

static bool filled_item(struct app *app, struct popup *p)
{
    const char *group;
    const struct object *object = object_of(p, &group);
    const char *list = ceduo_app_format(app, "%.*s", (int)strcspn(p->path, "#"), p->path);
    LOCAL_TEXT(item);
    ceduo_text_put(&item, "{");
    for (size_t i = 0; i < p->fields_count; i++) {
        const struct field *f = field_of(object, i);
        LOCAL_TEXT(value);
        if (!read_field(app, f, p->fields[i].text, &value))
            return false;
        if (value.length > 0)
            ceduo_text_format(&item, "%s%s: %s", item.length > 1 ? ", " : "", f->key, value.bytes);
    }
    ceduo_text_put(&item, "}");
    const char *yaml =
        group[0] ? ceduo_app_format(app, "{%s: %s}", group, item.bytes) : ceduo_app_format(app, "%s", item.bytes);
    const struct node *now = ceduo_document_node(&app->document, list);
    size_t n = now && now->kind == NODE_LIST ? now->n : 0;
    if (!ceduo_app_edited(app, ceduo_document_insert(&app->document, list, n, yaml, &app->problems))) {
        const char *said = ceduo_app_format(app, "%s", app->message), *colon = strstr(said, ": ");
        if (colon && strncmp(said, list, strlen(list)) == 0) /* a path of what is not there */
            ceduo_app_warn(app, "%s", colon + 2);
        return false;
    }
    ceduo_form_go(ceduo_app_form(app), list, n);
    ceduo_app_say(app, "%s", _("added; u takes it back"));
    return true;
}

void ceduo_popup_item_of(struct app *app, const char *list, const char *group, const char *const *offered, size_t n)
{
    const struct field *of = ceduo_schema_field(ceduo_schema_scene(), list);
    if (group)
        of = ceduo_schema_field(of->object, group);
    const char *path = ceduo_app_format(app, "%s#%s", list, group ? group : "");
    struct popup *p = ceduo_popup_fields(app, _(of->meaning), filled_item);
    snprintf(p->path, sizeof p->path, "%s", path);
    p->check = check_field;
    ceduo_text_put(&p->text, _("Several numbers with blanks between them, decimals with a dot or a comma: 41 44.5 52."));
    for (size_t i = 0; field_of(of->object, i); i++) {
        const struct field *f = field_of(of->object, i);
        ceduo_text_format(&p->text, "\n%s: %s", _(f->shown.label), _(f->meaning));
        ceduo_popup_field(p, _(f->shown.label), i < n ? offered[i] : "");
    }
}
