/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Saving: references are written as given, other values as a patch of the old text if possible. */
#include "document.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"

/* ---- the file on disk ---- */

/* True for the user's own folder of profiles. */
static bool is_user_folder(const char *folder)
{
    const char *data = getenv("XDG_DATA_HOME"), *home = getenv("HOME");
    return (data && data[0] == '/' && strncmp(folder, data, strlen(data)) == 0) ||
           (home && strstr(folder, "/.local/share/ceduo") && strncmp(folder, home, strlen(home)) == 0);
}

bool ceduo_document_is_shipped(const char *path)
{
    LOCAL_ARENA(arena);
    const char *const *folders = ceduo_file_folders(&arena);
    char *real = realpath(path, NULL);
    bool shipped = false;
    for (size_t i = 0; real && folders && folders[i] && !shipped; i++) {
        char *folder = realpath(folders[i], NULL);
        size_t n = folder ? strlen(folder) : 0;
        shipped = folder && !is_user_folder(folders[i]) && strncmp(real, folder, n) == 0 && real[n] == '/';
        free(folder);
    }
    free(real);
    return shipped;
}

void ceduo_document_record_disk_state(struct document *d)
{
    struct stat st;
    if (d->path && stat(d->path, &st) == 0) {
        d->modified = st.st_mtim;
        d->size = st.st_size;
    }
}

bool ceduo_document_changed_on_disk(const struct document *d)
{
    struct stat st;
    if (!d->path || d->modified.tv_sec == 0)
        return false;
    if (stat(d->path, &st) != 0)
        return errno == ENOENT;
    return st.st_size != d->size || st.st_mtim.tv_sec != d->modified.tv_sec || st.st_mtim.tv_nsec != d->modified.tv_nsec;
}

/* ---- saving ---- */

/* Return a path for a scene at `to`: unchanged if it leads to the same file, the name of a table of draws, or in full. */
static const struct node *reference_from(struct document *d, const struct node *node, const char *folder, const char *to)
{
    const struct source *s = node->source;
    const char *slash = strcmp(node->key, "draws") == 0 ? strrchr(node->text, '/') : NULL;
    if (!slash && s && !s->is_option && strcmp(s->name, to) == 0)
        return node;
    LOCAL_ARENA(found);
    struct arena *arena = &d->file.arena;
    const char *now = ceduo_resolve_path(&found, node, folder), *written = NULL;
    const char *const names[] = {slash ? slash + 1 : node->text, node->text};
    for (int i = 0; now && !written && i < 2; i++) {
        const char *target = ceduo_file_find(&found, names[i], to, folder);
        written = target && ceduo_file_is_same(now, target) ? names[i] : NULL;
    }
    if (!now || written == node->text)
        return node;
    char *full = ceduo_check_memory(realpath(now, NULL));
    node = ceduo_node_renamed(arena, ceduo_node_scalar(arena, s, written ? written : full, false), node->key);
    free(full);
    return node;
}

/* Adjust all paths of an unresolved tree for a scene at `to`. */
static const struct node *references_from(struct document *d, const struct node *node, const char *to)
{
    static const char *const keys[][2] = {{"slope", "slopes"},  {"stand", "stands"},   {"base", "stands"},
                                          {"csv", "slopes"},    {"draws", "scenes"},   {"x_m", "scenes"},
                                          {"values", "scenes"}, {"height_m", "scenes"}};
    double number; /* the last three may name a table of observed values */
    bool path = node->kind == NODE_SCALAR && node->key && ceduo_number_read(node->text, &number) == CEDUO_NUMBER_NONE;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0] && path; i++)
        if (strcmp(node->key, keys[i][0]) == 0)
            return reference_from(d, node, keys[i][1], to);
    const struct node *out = node;
    for (size_t i = 0; node->kind != NODE_SCALAR && i < node->n; i++) {
        const struct node *item = references_from(d, node->items[i], to);
        if (item != node->items[i])
            out = ceduo_node_replaced(&d->file.arena, out, i, item);
    }
    return out;
}

/* Append the text for a scene at `to` (NULL: never saved). Return true if the layout of the file is lost. */
static bool fill_text(struct document *d, const char *to, struct text *text)
{
    const struct node *root = ceduo_emit_restore_references(&d->file.arena, d->file.root);
    root = to ? references_from(d, root, to) : root;
    if (d->raw && ceduo_emit_patched(text, d->raw->source, d->raw, root))
        return false;
    ceduo_emit(text, root);
    if (!d->raw)
        return false;
    LOCAL_TEXT(before); /* if the file has the program's layout, nothing is lost */
    const struct source *source = d->raw->source;
    ceduo_emit(&before, d->raw);
    return before.length != source->length || memcmp(before.bytes, source->bytes, before.length) != 0;
}

void ceduo_document_append_yaml(struct document *d, const char *path, struct text *text)
{
    fill_text(d, path ? path : d->path ? d->path : d->recovery.path, text);
}

bool ceduo_document_save(struct document *d, const char *path, bool *reformatted)
{
    LOCAL_TEXT(text);
    LOCAL_TEXT(backup);
    bool same = d->path && strcmp(path, d->path) == 0;
    *reformatted = fill_text(d, path, &text);
    ceduo_text_format(&backup, "%s.bak", path);
    if (*reformatted && same && !ceduo_file_write(backup.bytes, d->raw->source->bytes, d->raw->source->length))
        return false;
    if (!ceduo_file_write(path, text.bytes, text.length))
        return false;
    char *copy = ceduo_check_memory(strdup(path)); /* `path` may be the document's own */
    free(d->path);
    d->path = copy;
    d->raw = ceduo_document_parse(d, copy, text.bytes);
    d->shipped = false;
    d->saved = d->current;
    ceduo_document_record_disk_state(d);
    ceduo_recovery_delete(&d->recovery);
    if (d->recovery.path && !same) { /* unsaved work now belongs to this file */
        ceduo_recovery_end(&d->recovery);
        d->recovery = ceduo_recovery_begin(d->path);
    }
    return true;
}

/* ---- recovery ---- */

void ceduo_document_write_recovery(struct document *d)
{
    LOCAL_TEXT(text);
    if (!d->recovery.path)
        return;
    ceduo_document_append_yaml(d, NULL, &text);
    ceduo_recovery_write(&d->recovery, d->path, ceduo_text_string(&text), text.length);
}

bool ceduo_document_recover(struct document *d, const char *text)
{
    ceduo_problems_free(&d->problems);
    const struct node *root = ceduo_document_parse(d, d->path ? d->path : "recovered", text);
    return root && ceduo_document_commit(d, root, _("recovered work"));
}
