/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOCUMENT_H
#define CEDUO_DOCUMENT_H

#include <sys/types.h>
#include <time.h>

#include "io/scene_file.h"

/* A copy of unsaved work, which survives a crash. */
struct recovery_copy {
    char *path; /* NULL: no copy can be kept */
    int file;   /* open and locked as long as the copy exists; -1: there is none */
};

/* The document that a person edits: a scene, every state that it was in, and what is on disk. */

#define DOCUMENT_HISTORY_BYTES ((size_t)64 * 1024 * 1024)

/* One state of the document. Trees share what they have in common. */
struct document_state {
    const struct node *root;
    const char *what; /* the edit that led here, for the undo line */
};

struct document {
    struct scene_file file; /* as it is now; always a scene that can be computed */
    const struct node *raw; /* the tree on disk, before references are followed; NULL for a new scene */
    struct document_state *states;
    size_t count, room, at;   /* states; the one shown */
    size_t trimmed;           /* what the arena held when the oldest were last forgotten */
    size_t saved;             /* the one on disk; count + 1: none */
    char *path;               /* where it is saved; NULL: nowhere yet */
    bool shipped;             /* the file belongs to the program: never written */
    struct timespec modified; /* of the file when it was read */
    off_t size;
    struct recovery_copy recovery;
    struct problems problems; /* why the last edit was refused, or the document could not be opened */
};

/* Open a scene, with n changes PATH=VALUE (as ceduo_scene_load()), or a new one from text that was never on disk. False with the
 * reason in document->problems; close it in any case. */
bool ceduo_document_open(struct document *document, const char *path, const char *const *sets, size_t n);
bool ceduo_document_new(struct document *document, const char *text);
void ceduo_document_close(struct document *document);

/* Each edit makes a new state, or leaves the document as it was with the reason in document->problems. Paths as in --set, values
 * in YAML. A list is made if there is none. */
bool ceduo_document_set(struct document *document, const char *path, const char *value);
bool ceduo_document_delete(struct document *document, const char *path);
bool ceduo_document_insert(struct document *document, const char *list, size_t index, const char *item);
bool ceduo_document_move(struct document *document, const char *list, size_t from, size_t to);

/* Changes that are made as one edit, in their order. Starts with the document alone. */
struct changes {
    struct document *document;
    size_t n, capacity;
    struct change {
        enum change_kind { CHANGE_SET, CHANGE_KEEP_SOURCE, CHANGE_DELETE } kind;
        const char *path, *value;
    } * items; /* in the document's arena */
};

/* Append a change. SET: the value stands at the path. KEEP_SOURCE: a scalar keeps the source around it, because it follows a value
 * that a person changes. DELETE: an entry or item is removed if it is there; `value` is NULL. */
void ceduo_changes_add(struct changes *changes, enum change_kind kind, const char *path, const char *value);
void ceduo_changes_set(struct changes *changes, const char *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool ceduo_changes_make(const struct changes *changes, const char *what);

/* Copy item `list[index]` after it, an option under a name of its own; then make the changes (may be NULL). */
bool ceduo_document_duplicate(struct document *document, const char *list, size_t index, const struct changes *changes);

/* Append the belts of the first option as YAML, each with this stand; without belts one down to the first control. */
void ceduo_document_belts(const struct document *document, const char *stand, struct text *yaml);

/* Append an option with those belts, or a copy of option `index`; a number follows a name that is taken. A scene with a forest
 * alone first gets options, "current" the first of them. The paths of the changes begin at the option: "forest[0].cut_year". */
bool ceduo_document_add_option(struct document *document, const char *stand, const char *name);
bool ceduo_document_vary_option(struct document *document, size_t index, const char *name, const struct changes *changes);

/* Rename an option; observations through its forest and rows of uncertainty about it follow. */
bool ceduo_document_rename_option(struct document *document, size_t index, const char *name);

/* As ceduo_document_set(), but removes what would then be given twice: a size or the mass of the rock, a roughness, a number of
 * shoots. Another shape gets sizes of the same volume. Neighbours follow a border, assumed heights their diameter. Appends to
 * `said` what else was changed. */
bool ceduo_document_set_alone(struct document *document, const char *path, const char *value, struct text *said);

/* Insert a vertex ([x, z]) within segment `index`, both parts of the same ground. `apart`: one ground of all segments becomes one
 * for each. Or remove a vertex, and the ground of one of the segments beside it. */
bool ceduo_document_split_segment(struct document *document, size_t index, const char *vertex, bool apart);
bool ceduo_document_remove_vertex(struct document *document, size_t vertex, size_t segment);

/* Undo an edit (-1), or make it again (1). False if there is none. */
bool ceduo_document_undo_or_redo(struct document *document, int by);
bool ceduo_document_unsaved(const struct document *document);

/* Write the scene to `path`, with the comments of the file if only values changed. Otherwise `*laid_out_anew` is true, and the
 * scene's own old file is kept as PATH.bak. False with errno set. */
bool ceduo_document_save(struct document *document, const char *path, bool *laid_out_anew);

/* Print the document as YAML, as it would be saved to `path`; NULL: to its own. */
void ceduo_document_text(struct document *document, const char *path, struct text *text);

/* True if a path leads to a file of the program's own, which is never written; if the file is no longer the one that was read. */
bool ceduo_document_is_shipped(const char *path);
bool ceduo_document_changed_on_disk(const struct document *document);

/* Keep a copy of unsaved work; make the text of one that was left behind a state, which can be undone. */
void ceduo_document_keep(struct document *document);
bool ceduo_document_recover(struct document *document, const char *text);

/* Node at a path; NULL: there is none. */
const struct node *ceduo_document_node(const struct document *document, const char *path);

/* Read a place along the slope, "10" or "end-10": m, as given; NaN if it is none, or NULL. Or the place at a path. */
double ceduo_document_place(const struct document *document, const char *written);
double ceduo_document_place_at(const struct document *document, const char *path);

/* ---- recovery ---- */

/* Copies of unsaved work lie in $XDG_STATE_HOME/ceduo or ~/.local/state/ceduo, one for each scene and program. The program
 * locks its copy with flock(): an unlocked copy is left behind, also if two machines share the folder. */

/* Name the copy of a scene (NULL: without a file), and write nothing yet. The path is NULL if there is no folder. */
struct recovery_copy ceduo_recovery_begin(const char *path);

/* Write and lock the copy, for its owner alone, with the scene's path in its first line. False: the copy of before stays. */
bool ceduo_recovery_write(struct recovery_copy *copy, const char *path, const char *bytes, size_t n);

void ceduo_recovery_delete(struct recovery_copy *copy); /* it may be written again */
void ceduo_recovery_end(struct recovery_copy *copy);    /* frees the memory; a copy that was written is left behind, unlocked */

/* A copy that was left behind. */
struct recovery {
    const char *file;  /* where it lies */
    const char *scene; /* whose work it is; NULL: a scene that was never saved */
    const char *title; /* of the scene, or "" */
    time_t when;       /* of the last edit */
};

/* All n copies that no program locks, the newest first, in the arena. */
struct recovery *ceduo_recovery_list(struct arena *arena, size_t *n);

char *ceduo_recovery_text(const char *file); /* NULL on failure; caller frees */

/* ---- for the files that implement it ---- */

/* Makes `root` the scene and adds it as a new state. Returns false and changes nothing if `root` is not a valid scene. */
bool ceduo_document_commit(struct document *document, const struct node *root, const char *what);

/* Parses YAML that was typed or read; `name` appears in messages. NULL with the reason in document->problems. */
const struct node *ceduo_document_parse(struct document *document, const char *name, const char *text);

/* Notes size and time of the file on disk, to see later whether it has changed. */
void ceduo_document_note_disk(struct document *document);

#endif
