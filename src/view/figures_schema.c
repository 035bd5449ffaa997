/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON Schema and CSV columns of an output, derived from its tables. */
#include "base/json.h"
#include "figures.h"

static const char *const types[] = {[CEDUO_VALUE_NUMBER] = "number",
                                    [CEDUO_VALUE_COUNT] = "integer",
                                    [CEDUO_VALUE_FLAG] = "boolean",
                                    [CEDUO_VALUE_TEXT] = "string",
                                    [CEDUO_VALUE_ANY] = "number or text"};

/* ---- JSON Schema ---- */

/* Write "type", with null if allowed. */
static void write_type(struct json *j, enum ceduo_value_kind kind, bool null)
{
    if (kind != CEDUO_VALUE_ANY && !null) {
        ceduo_json_string(j, "type", types[kind]);
        return;
    }
    ceduo_json_open(j, "type", '[');
    if (kind == CEDUO_VALUE_ANY)
        ceduo_json_string(j, NULL, types[CEDUO_VALUE_NUMBER]);
    ceduo_json_string(j, NULL, types[kind == CEDUO_VALUE_ANY ? CEDUO_VALUE_TEXT : kind]);
    if (null)
        ceduo_json_string(j, NULL, "null");
    ceduo_json_close(j, ']');
}

static void write_properties(struct json *j, const struct ceduo_figure *f);

static void write_required(struct json *j, const struct ceduo_figure *f)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (f->key)
            ceduo_json_string(j, NULL, f->key);
        else
            write_required(j, f->table);
    }
}

static void write_container(struct json *j, const char *type, bool null)
{
    ceduo_json_open(j, "type", '[');
    ceduo_json_string(j, NULL, type);
    if (null)
        ceduo_json_string(j, NULL, "null");
    ceduo_json_close(j, ']');
}

/* Write the object of cells that --each copies. */
static void write_each_row(struct json *j)
{
    ceduo_json_open(j, "row", '{');
    ceduo_json_string(j, "description",
                      "with --each: the copied cells of the row, by the heads of their columns; null if empty");
    ceduo_json_string(j, "type", "object");
    ceduo_json_open(j, "additionalProperties", '{');
    write_type(j, CEDUO_VALUE_ANY, true);
    ceduo_json_close(j, '}');
    ceduo_json_close(j, '}');
}

/* `row`: the object includes the cells that --each copies. */
static void write_schema_object(struct json *j, const struct ceduo_figure *table, bool null, bool row)
{
    write_container(j, "object", null);
    ceduo_json_open(j, "properties", '{');
    if (row)
        write_each_row(j);
    write_properties(j, table);
    ceduo_json_close(j, '}');
    ceduo_json_open(j, "required", '[');
    write_required(j, table);
    ceduo_json_close(j, ']');
}

static void write_items(struct json *j, const struct ceduo_figure *f)
{
    write_container(j, "array", f->null);
    ceduo_json_open(j, "items", '{');
    if (f->sentences)
        ceduo_json_string(j, "type", "string");
    else if (!f->plain)
        write_schema_object(j, f->table, false, false);
    else if (f->table->value)
        write_type(j, f->table->value->kind, f->table->null != NULL);
    else
        write_items(j, f->table);
    ceduo_json_close(j, '}');
}

static void write_properties(struct json *j, const struct ceduo_figure *f)
{
    for (; !ceduo_figure_is_end(f); f++) {
        if (!f->key) {
            write_properties(j, f->table);
            continue;
        }
        ceduo_json_open(j, f->key, '{');
        ceduo_json_string(j, "description", f->meaning);
        if (f->unit[0])
            ceduo_json_string(j, "unit", f->unit);
        if (f->value)
            write_type(j, f->value->kind, f->null != NULL);
        else if (f->enter || f->item || (f->sentences && !f->single))
            write_items(j, f);
        else if (f->sentences)
            write_type(j, CEDUO_VALUE_TEXT, f->null != NULL);
        else
            write_schema_object(j, f->table, f->null != NULL, false);
        ceduo_json_close(j, '}');
    }
}

void ceduo_figures_schema(struct text *text, const char *format, const struct ceduo_figure *figures, bool row)
{
    struct json j = {.text = text};
    LOCAL_TEXT(id);
    ceduo_text_format(&id, "urn:%s", format);
    ceduo_json_open(&j, NULL, '{');
    ceduo_json_string(&j, "$schema", "https://json-schema.org/draft/2020-12/schema");
    ceduo_json_string(&j, "$id", ceduo_text_string(&id));
    write_schema_object(&j, figures, false, row);
    ceduo_json_close(&j, '}');
    ceduo_text_append_char(text, '\n');
}

/* ---- columns ---- */

struct group {
    const struct group *before;
    const char *key, *unit, *null; /* unit: of the group's members; "": each has its own */
};

static void append_path(struct text *text, const struct group *group)
{
    if (!group)
        return;
    append_path(text, group->before);
    ceduo_text_format(text, "%s.", group->key);
}

static void add_columns(struct text *rows, const struct ceduo_figure *f, const struct group *group, bool heads)
{
    for (; !ceduo_figure_is_end(f); f++) {
        const char *unit = f->unit && f->unit[0] ? f->unit : group ? group->unit : "";
        const char *null = f->null ? f->null : group ? group->null : NULL;
        const struct group nested = {group, f->key, unit, null};
        if (f->item) {
            for (size_t i = 0; i < f->columns; i++) {
                LOCAL_TEXT(item);
                ceduo_text_format(&item, "%s[%zu]", f->key, i);
                add_columns(rows, f->table, &(struct group){group, ceduo_text_string(&item), unit, null}, heads);
            }
        } else if (f->table) {
            add_columns(rows, f->table, f->key ? &nested : group, heads);
        } else {
            append_path(rows, group);
            ceduo_text_append(rows, f->key);
            if (heads)
                ceduo_text_append_char(rows, ',');
            else
                ceduo_text_format(rows, "\t%s\t%s\t%s\t%s\n", types[f->value ? f->value->kind : CEDUO_VALUE_TEXT],
                                  unit[0] ? unit : "-", null ? null : "-", f->meaning);
        }
    }
}

void ceduo_figures_columns(struct text *rows, const struct ceduo_figure *columns, bool heads)
{
    add_columns(rows, columns, NULL, heads);
}
