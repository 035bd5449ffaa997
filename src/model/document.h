/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOCUMENT_H
#define CEDUO_DOCUMENT_H

#include <sys/types.h>
#include <time.h>

#include "io/scene_file.h"

/* A copy of unsaved work, which survives a crash. */
struct recovery_copy {
    char *path; /* NULL: no copy can be kept */
    int file;   /* descriptor, open and locked while the copy exists; -1: none */
};

/* The document that a user edits: a scene, its history and its state on disk. */

#define DOCUMENT_HISTORY_BYTES ((size_t)64 * 1024 * 1024)

/* One state of the document. Trees share common nodes. */
struct document_state {
    const struct node *root;
    const char *edit_name; /* the edit that made this state, for the undo message */
};

struct document {
    struct scene_file file; /* the current scene; always valid */
    const struct node *raw; /* tree on disk, with unresolved references; NULL: new scene */
    struct document_state *states;
    size_t count, capacity, current; /* number of states; index of the current one */
    size_t trimmed;                  /* bytes in the arena at the last trim of the history */
    size_t saved;                    /* index of the state on disk; >= count: none */
    char *path;                      /* path of the file; NULL: never saved */
    bool shipped;                    /* file of the program: never written */
    struct timespec modified;        /* modification time at the last read or write */
    off_t size;
    struct recovery_copy recovery;
    struct problems problems; /* reason why the last edit was refused, or why opening failed */
};

/* Open a scene with n changes PATH=VALUE (as ceduo_scene_load()), or a new one from text. Return false with the reason in
 * document->problems. The caller closes the document in any case. */
bool ceduo_document_open(struct document *document, const char *path, const char *const *sets, size_t n);
bool ceduo_document_new(struct document *document, const char *text);
void ceduo_document_close(struct document *document);

/* Each edit adds a state, or changes nothing and puts the reason into document->problems. Paths are written as in --set,
 * values in YAML. A missing list is created. */
bool ceduo_document_set(struct document *document, const char *path, const char *value);
bool ceduo_document_delete(struct document *document, const char *path);
bool ceduo_document_insert(struct document *document, const char *list, size_t index, const char *item);
bool ceduo_document_move(struct document *document, const char *list, size_t from, size_t to);

/* Changes that are made as one edit, in order. Initialize `document` only. */
struct changes {
    struct document *document;
    size_t n, capacity;
    struct change {
        enum change_kind { CHANGE_SET, CHANGE_KEEP_SOURCE, CHANGE_DELETE } kind;
        const char *path, *value;
    } * items; /* in the document's arena */
};

/* Append a change. SET writes the value at the path. KEEP_SOURCE writes a scalar and keeps its source, because it only
 * follows another value. DELETE removes an entry or item if it exists; `value` is NULL. */
void ceduo_changes_add(struct changes *changes, enum change_kind kind, const char *path, const char *value);
void ceduo_changes_set(struct changes *changes, const char *path, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
bool ceduo_changes_apply(const struct changes *changes, const char *edit_name);

/* Duplicate item `list[index]`; an option gets a new name. Then make the changes (may be NULL). */
bool ceduo_document_duplicate(struct document *document, const char *list, size_t index, const struct changes *changes);

/* Append the belts of the first option as YAML, all with this stand. Without belts, append one down to the first control.
 * `cut_years`: with their cut years. */
void ceduo_document_append_belts(const struct document *document, const char *stand, bool cut_years, struct text *yaml);

/* Append an option with those belts, without cut years if the stand has no cutting, or a copy of option `index`; a duplicate
 * name gets a number. A scene without options first gets the option "current". The paths of the changes are relative to the
 * option: "forest[0].cut_year". */
bool ceduo_document_add_option(struct document *document, const char *stand, const char *name);
bool ceduo_document_vary_option(struct document *document, size_t index, const char *name, const struct changes *changes);

/* Rename an option, also in observations and rows of uncertainty. */
bool ceduo_document_rename_option(struct document *document, size_t index, const char *name);

/* As ceduo_document_set(), but remove conflicting values: another size or mass of the rock, roughness or number of shoots. A
 * new shape keeps the volume. A belt with a new stand loses a cut year that this stand cannot have. Neighbours follow a border,
 * assumed heights their diameter. Append these to `notes`. */
bool ceduo_document_set_and_follow(struct document *document, const char *path, const char *value, struct text *notes);

/* Insert a vertex ([x, z]) into segment `index`; both parts keep its ground. `split_ground`: give each segment its own
 * ground. Remove a vertex and the ground of one adjacent segment. */
bool ceduo_document_split_segment(struct document *document, size_t index, const char *vertex, bool split_ground);
bool ceduo_document_remove_vertex(struct document *document, size_t vertex, size_t segment);

/* Undo (-1) or redo (1) an edit. Return false if there is none. */
bool ceduo_document_undo_or_redo(struct document *document, int step);
bool ceduo_document_unsaved(const struct document *document);

/* Write the scene to `path`. Keep the comments of the file if only values changed. Otherwise set `*reformatted`, and keep
 * the scene's old file as PATH.bak. Return false with errno set. */
bool ceduo_document_save(struct document *document, const char *path, bool *reformatted);

/* Append the document as YAML, as saved to `path`; NULL: to its own path. */
void ceduo_document_append_yaml(struct document *document, const char *path, struct text *text);

/* True if a path leads to a file of the program, never written. True if the file on disk was changed by others. */
bool ceduo_document_is_shipped(const char *path);
bool ceduo_document_changed_on_disk(const struct document *document);

/* Write the recovery copy. Make the text of a recovery copy a new state. */
void ceduo_document_write_recovery(struct document *document);
bool ceduo_document_recover(struct document *document, const char *text);

/* Return the node at a path; NULL: none. */
const struct node *ceduo_document_node(const struct document *document, const char *path);

/* Read a place along the slope, "10" or "end-10", or the place at a path: m, as in the file. NaN if it is invalid or NULL. */
double ceduo_document_read_place(const struct document *document, const char *written);
double ceduo_document_get_place(const struct document *document, const char *path);

/* ---- recovery ---- */

/* Copies of unsaved work are kept in $XDG_STATE_HOME/ceduo or ~/.local/state/ceduo, one for each scene and process. The
 * process locks its copy with flock(). An unlocked copy is abandoned, also if two machines share the folder. */

/* Name the copy of a scene (NULL: no file) without writing it. The path is NULL if no folder can be made. */
struct recovery_copy ceduo_recovery_begin(const char *path);

/* Write and lock the copy, readable by its owner, with the scene's path in the first line. False: the old copy stays. */
bool ceduo_recovery_write(struct recovery_copy *copy, const char *path, const char *bytes, size_t n);

void ceduo_recovery_delete(struct recovery_copy *copy); /* the copy can be written again */
void ceduo_recovery_end(struct recovery_copy *copy);    /* free the memory; unlock a written copy, but leave it on disk */

/* An abandoned copy. */
struct recovery {
    const char *file;  /* path of the copy */
    const char *scene; /* path of the scene; NULL: never saved */
    const char *title; /* title of the scene; "": none */
    time_t when;       /* time of the last edit */
};

/* Return the n copies that are not locked, newest first, in the arena. */
struct recovery *ceduo_recovery_list(struct arena *arena, size_t *n);

char *ceduo_recovery_text(const char *file); /* NULL on failure; caller frees */

/* ---- for the files that implement the document ---- */

/* Make `root` the scene and add it as a state. Return false and change nothing if `root` is not a valid scene. */
bool ceduo_document_commit(struct document *document, const struct node *root, const char *edit_name);

/* Parse YAML that was typed or read; `name` appears in messages. NULL on failure, with the reason in document->problems. */
const struct node *ceduo_document_parse(struct document *document, const char *name, const char *text);

/* Record size and time of the file on disk, to detect changes later. */
void ceduo_document_record_disk_state(struct document *document);

#endif
