/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scene and its history. States are trees that share nodes in the arena of the scene's file. */
#include "document.h"

#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "io/file.h"

/* ---- states ---- */

static void push_state(struct document *d, const struct node *root, const char *edit_name)
{
    if (d->current + 1 < d->count && d->saved > d->current && d->saved < d->count)
        d->saved = SIZE_MAX; /* redo can no longer reach the state on disk */
    if (d->count > 0)
        d->count = d->current + 1;
    d->states = ceduo_grow(d->states, d->count, &d->capacity, sizeof *d->states);
    d->states[d->count] = (struct document_state){root, edit_name};
    d->current = d->count++;
}

/* Drop the older half of the history once the arena has grown by DOCUMENT_HISTORY_BYTES. The arena is freed on close. */
static void trim_history(struct document *d)
{
    if (d->file.arena.bytes - d->trimmed < DOCUMENT_HISTORY_BYTES || d->count < 4)
        return;
    d->trimmed = d->file.arena.bytes;
    size_t dropped = d->current / 2;
    memmove(d->states, d->states + dropped, (d->count - dropped) * sizeof *d->states);
    d->count -= dropped;
    d->current -= dropped;
    d->saved = d->saved >= dropped && d->saved != SIZE_MAX ? d->saved - dropped : SIZE_MAX;
}

/* Make `root` the scene if it is valid; otherwise change nothing. */
static bool adopt(struct document *d, const struct node *root)
{
    struct scene_file before = d->file;
    const struct node *resolved = ceduo_resolve_scene(&d->file.arena, root, &d->problems);
    bool good = false;
    if (resolved && d->problems.met == 0) {
        d->file.root = resolved;
        good = ceduo_scene_bind(&d->file, &d->problems);
    }
    if (!good) {
        struct arena arena = d->file.arena; /* keep the arena: it has grown */
        d->file = before;
        d->file.arena = arena;
    }
    return good;
}

bool ceduo_document_commit(struct document *d, const struct node *root, const char *edit_name)
{
    const struct node *before = d->file.root;
    if (!adopt(d, root))
        return false;
    if (ceduo_node_equal(before, d->file.root)) { /* nothing has changed: add no state */
        d->file.root = before;
        return true;
    }
    push_state(d, d->file.root, ceduo_arena_string(&d->file.arena, edit_name));
    trim_history(d);
    ceduo_document_write_recovery(d);
    return true;
}

bool ceduo_document_undo_or_redo(struct document *d, int step)
{
    size_t state = d->current + (size_t)step; /* wraps around before the first state */
    ceduo_problems_free(&d->problems);
    if (state >= d->count || !adopt(d, d->states[state].root))
        return false;
    d->current = state;
    if (ceduo_document_unsaved(d))
        ceduo_document_write_recovery(d);
    else
        ceduo_recovery_delete(&d->recovery);
    return true;
}

bool ceduo_document_unsaved(const struct document *d)
{
    return d->count > 0 && d->current != d->saved;
}

/* ---- opening ---- */

const struct node *ceduo_document_parse(struct document *d, const char *name, const char *text)
{
    /* copy of the path: saving elsewhere must not change how typed paths are resolved */
    const struct source *source = ceduo_source_copy(
        &d->file.arena, (struct source){.name = name, .bytes = text, .is_option = true, .base_file = d->path});
    return ceduo_yaml_read(&d->file.arena, source, &d->problems);
}

bool ceduo_document_open(struct document *d, const char *path, const char *const *sets, size_t n)
{
    *d = (struct document){0};
    if (!ceduo_scene_load(&d->file, path, sets, n, &d->problems))
        return false;
    push_state(d, d->file.root, "");
    d->raw = d->file.raw;
    d->path = strcmp(path, "-") == 0 ? NULL : ceduo_check_memory(strdup(d->file.path));
    d->shipped = d->path && ceduo_document_is_shipped(d->path);
    ceduo_document_record_disk_state(d);
    d->recovery = ceduo_recovery_begin(d->path);
    return true;
}

bool ceduo_document_new(struct document *d, const char *text)
{
    *d = (struct document){.saved = SIZE_MAX};
    if (!ceduo_scene_load_text(&d->file, _("new scene"), text, &d->problems))
        return false;
    push_state(d, d->file.root, "");
    d->recovery = ceduo_recovery_begin(NULL);
    ceduo_document_write_recovery(d);
    return true;
}

void ceduo_document_close(struct document *d)
{
    ceduo_scene_release(&d->file);
    ceduo_problems_free(&d->problems);
    free(d->states);
    free(d->path);
    ceduo_recovery_end(&d->recovery);
    *d = (struct document){0};
}
