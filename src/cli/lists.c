/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <string.h>

#include "batch.h"
#include "output.h"
#include "say.h"
#include "io/file.h"
#include "base/intl.h"
#include "base/utf8.h"
#include "io/node.h"
#include "scene/schema.h"

/* ---- parameters ---- */

static const char *type_name(const struct field *f)
{
    switch (f->type) {
    case FIELD_NUMBER:
        return "number";
    case FIELD_SPREAD:
        return "number~";
    case FIELD_SPREADS:
        return "3 numbers~";
    case FIELD_COUNT:
        return "count";
    case FIELD_CHOICE:
        return "word";
    case FIELD_FLAG:
        return "flag";
    case FIELD_NUMBERS:
        return "numbers";
    case FIELD_POINTS:
        return "points";
    case FIELD_FILE:
        return "file";
    default:
        return "text";
    }
}

static void put_words(struct text *text, const struct choices *choices)
{
    for (size_t i = 0; i < choices->n; i++)
        ceduo_text_format(text, "%s%s", i ? "|" : "", choices->names[i]);
}

static void put_parameter(void *context, const char *path, const struct field *f)
{
    struct text *text = context;
    struct text words = {0};
    if (f->type == FIELD_TAG || strncmp(path, "options[].forest[].", 19) == 0)
        return; /* as forest[] */
    if (f->choices)
        put_words(&words, f->choices);
    else if (!ceduo_schema_range_text(f, &words))
        ceduo_text_char(&words, '-');
    ceduo_text_format(text, "%s\t%s\t%s\t%s\t%s\t%s\n", path, type_name(f), f->unit[0] ? f->unit : "-",
                      ceduo_text_string(&words), f->value ? f->value : "-", _(f->meaning));
    ceduo_text_free(&words);
}

#define WIDTH_MOST 44 /* of a column; what is wider sticks out */

/* Columns of a tab-separated table set below one another; the last is left as it is. */
static void align(struct text *to, const char *rows)
{
    size_t widths[8] = {0}, column = 0, n;
    for (int puts = 0; puts < 2; puts++)
        for (const char *p = rows; *p; p += n + 1) {
            n = strcspn(p, "\t\n");
            size_t width = ceduo_utf8_width_of(p, n);
            bool last = p[n] == '\n';
            if (!puts && !last && width > widths[column])
                widths[column] = width > WIDTH_MOST ? WIDTH_MOST : width;
            if (puts) {
                ceduo_text_add(to, p, n);
                ceduo_text_format(to, "%*s", last ? 0 : width > widths[column] ? 1 : (int)(widths[column] + 2 - width), "");
                ceduo_text_put(to, last ? "\n" : "");
            }
            column = last ? 0 : column + 1;
        }
}

enum exit_status ceduo_batch_parameters(const struct arguments *a)
{
    struct text rows = {0}, table = {0};
    ceduo_text_format(&rows, "%s\t%s\t%s\t%s\t%s\t%s\n", _("path"), _("type"), _("unit"), _("range"), _("default"),
                      _("meaning"));
    ceduo_schema_visit(ceduo_schema_scene(), "", put_parameter, &rows);
    if (rows.bytes)
        align(&table, rows.bytes);
    ceduo_text_put(&table, _("\nnumber~: also {mean: ..., spread: ..., kind: normal|uniform}, drawn for each rock\n"
                             "options[].forest[] holds what forest[] holds; any mapping may hold source: {kind, text}\n"));
    ceduo_say_plainly(&table);
    enum exit_status status = ceduo_output_write(a, &table);
    ceduo_text_free(&rows);
    ceduo_text_free(&table);
    return status;
}

/* ---- profiles ---- */

static const char *title_of(struct arena *arena, const char *path)
{
    struct problems problems = {0};
    const struct source *source = ceduo_file_read(arena, path, YAML_BYTES_MOST, &problems);
    const struct node *root = source ? ceduo_yaml_read(arena, source, &problems) : NULL;
    const char *title = ceduo_node_text(root, "title");
    if (!title)
        title = ceduo_node_text(root, "name");
    ceduo_problems_free(&problems);
    return title ? title : root ? "" : _("(cannot be read)");
}

static void put_profile(struct arena *arena, struct text *rows, const char *folder, const char *kind, const char *name)
{
    struct text path = {0};
    ceduo_text_format(&path, "%s/%s/%s", folder, kind, name);
    if (path.bytes) {
        ceduo_text_safe(rows, path.bytes);
        ceduo_text_format(rows, "\t%.*s\t", (int)(strlen(kind) - 1), kind);
        ceduo_text_safe(rows, title_of(arena, path.bytes));
        ceduo_text_char(rows, '\n');
    }
    ceduo_text_free(&path);
}

static void list_shelf(struct arena *arena, struct text *rows, const char *folder, const char *kind)
{
    size_t n;
    const char *const *names = ceduo_file_list(arena, folder, kind, &n);
    for (size_t i = 0; i < n; i++)
        put_profile(arena, rows, folder, kind, names[i]);
}

enum exit_status ceduo_batch_profiles(const struct arguments *a)
{
    static const char *const kinds[] = {"scenes", "slopes", "stands"};
    struct arena arena = {0};
    struct text rows = {0}, table = {0};
    const char *const *folders = ceduo_file_folders(&arena);
    ceduo_text_format(&rows, "%s\t%s\t%s\n", _("file"), _("kind"), _("title"));
    for (size_t k = 0; k < 3; k++)
        for (size_t i = 0; folders && folders[i]; i++)
            list_shelf(&arena, &rows, folders[i], kinds[k]);
    if (rows.bytes)
        align(&table, rows.bytes);
    ceduo_say_plainly(&table);
    enum exit_status status = ceduo_output_write(a, &table);
    ceduo_text_free(&rows);
    ceduo_text_free(&table);
    ceduo_arena_free(&arena);
    return status;
}
