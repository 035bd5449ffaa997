/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A new item of a list: what it must and may have, field by field as the table of the scene has them. */
#include <string.h>

#include "base/language.h"
#include "io/emit.h"
#include "popup.h"

/* Adds an item at the end of a list. Blocks that are one power law become the first class; the first blocks take the place of their
 * number a year. */
static bool append_item(struct app *app, const char *list, const struct node *now, const char *yaml)
{
    struct changes c = {.document = &app->document};
    LOCAL_TEXT(first);
    if (now && now->kind == NODE_LIST)
        return ceduo_document_insert(&app->document, list, now->n, yaml, &app->problems);
    if (now)
        ceduo_emit_flow(&first, now);
    ceduo_text_put(&first, now ? ", " : "");
    if (strcmp(list, "blocks") == 0)
        ceduo_changes_add(&c, CHANGE_DELETE, "rocks_per_year", NULL);
    ceduo_changes_set(&c, list, "[%s%s]", ceduo_text_string(&first), yaml);
    return ceduo_changes_make(&c, list, &app->problems);
}

/* The path is that of the list; a group is kept. */
static bool filled_item(struct app *app, struct popup *p)
{
    const char *list = p->path;
    LOCAL_TEXT(item);
    ceduo_text_put(&item, "{");
    for (size_t i = 0; i < p->fields_count; i++) {
        const struct field *f = p->fields[i].value;
        LOCAL_TEXT(value);
        if (!ceduo_popup_read(app, f, &p->fields[i].line, &value))
            return false;
        if (value.length > 0)
            ceduo_text_format(&item, "%s%s: %s", item.length > 1 ? ", " : "", f->key, value.bytes);
    }
    ceduo_text_put(&item, "}");
    bool counted = strcmp(list, "blocks") == 0 && ceduo_document_node(&app->document, "rocks_per_year");
    const char *yaml =
        p->kept ? ceduo_app_format(app, "{%s: %s}", p->kept, item.bytes) : ceduo_app_format(app, "%s", item.bytes);
    const struct node *now = ceduo_document_node(&app->document, list);
    size_t n = !now ? 0 : now->kind == NODE_LIST ? now->n : 1;
    if (!ceduo_app_edited(app, append_item(app, list, now, yaml))) {
        const char *said = ceduo_app_format(app, "%s", app->message), *colon = strstr(said, ": ");
        if (colon && strncmp(said, list, strlen(list)) == 0) /* a path of what is not there */
            ceduo_app_warn(app, "%s", colon + 2);
        return false;
    }
    ceduo_form_go(ceduo_app_form(app), list, n);
    ceduo_app_say(
        app, "%s",
        counted ? _("taken over; blocks say how many rocks a year come down, so rocks_per_year is removed; u takes it back")
                : _("taken over; u takes it back"));
    return true;
}

void ceduo_popup_item_of(struct app *app, const char *list, const char *group, const char *const *offered, size_t n)
{
    const struct field *of = ceduo_schema_row(list);
    of = group ? ceduo_schema_field(of->object, group) : of;
    struct popup *p = ceduo_popup_fields(app, _(of->meaning), list, filled_item);
    p->kept = group ? of->key : NULL;
    ceduo_text_put(&p->text, _("Several numbers with blanks between them, decimals with a dot or a comma: 41 44.5 52."));
    for (const struct field *f = of->object->fields; f < of->object->fields + of->object->n; f++) {
        if (f->type != FIELD_NUMBER && f->type != FIELD_NUMBERS && f->type != FIELD_COUNT && f->type != FIELD_SPREAD)
            continue; /* files of values are named in the scene's file */
        ceduo_text_format(&p->text, "\n%s: %s", _(f->shown.label), _(f->meaning));
        ceduo_popup_value(p, _(f->shown.label), p->fields_count < n ? offered[p->fields_count] : "", f);
    }
}
