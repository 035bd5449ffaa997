/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_NODE_H
#define CEDUO_NODE_H

#include <stdint.h>

#include "base/arena.h"
#include "problem.h"

enum node_kind { NODE_SCALAR, NODE_MAP, NODE_LIST };

/* A value of a YAML file. Nodes are immutable: an edit copies the nodes from the root to the changed one and shares the rest.
 * Earlier states of a document therefore stay valid. */
struct node {
    enum node_kind kind;
    bool quoted;                   /* a scalar in quotes: text, never a number */
    bool flow;                     /* a mapping or list in brackets */
    bool broken;                   /* unreadable reference, or mapping based on one; already reported */
    uint32_t line, column;         /* of the value, from 1 */
    uint32_t end_line, end_column; /* after a scalar, or after a mapping or list in brackets */
    uint32_t key_line, key_column; /* of its key; 0: none */
    const struct source *source;
    const char *key;                 /* in a mapping */
    const char *text;                /* of a scalar */
    const struct node *const *items; /* of a mapping or list */
    size_t n;
    const struct node *written;  /* of a resolved reference: the path, or the mapping with `base`; else NULL */
    const struct node *followed; /* its content before any edit */
};

/* Read one YAML document. Return NULL on error. Aliases, anchors, tags, duplicate keys, a second document and more than 16
 * levels are errors. */
const struct node *ceduo_yaml_read(struct arena *arena, const struct source *source, struct problems *problems);

/* Read one value that begins `skip` bytes into the source. */
const struct node *ceduo_yaml_read_value(struct arena *arena, const struct source *source, size_t skip,
                                         struct problems *problems);

/* Return the entry of a mapping; NULL: none, or `node` is no mapping. `node` may be NULL. */
const struct node *ceduo_node_get(const struct node *node, const char *key);

/* Return the text of a scalar entry; NULL: none. */
const char *ceduo_node_text(const struct node *node, const char *key);

/* Return the number of a scalar entry; NaN: none. */
double ceduo_node_number(const struct node *node, const char *key);

/* Return the number in item i of a list; NaN: none. */
double ceduo_node_item_number(const struct node *list, size_t i);

/* Return a mapping with an entry replaced or appended; a mapping without an entry. NULL on failure, or if `map` is NULL. */
const struct node *ceduo_node_with(struct arena *arena, const struct node *map, const char *key, const struct node *value);
const struct node *ceduo_node_without(struct arena *arena, const struct node *map, const char *key);

/* Return a list or mapping with item i replaced; with an item inserted before i (i = n: appended); without item i. */
const struct node *ceduo_node_replaced(struct arena *arena, const struct node *node, size_t i, const struct node *value);
const struct node *ceduo_node_inserted(struct arena *arena, const struct node *node, size_t i, const struct node *value);
const struct node *ceduo_node_removed(struct arena *arena, const struct node *node, size_t i);

/* Return a value under another key (NULL: none). */
const struct node *ceduo_node_renamed(struct arena *arena, const struct node *value, const char *key);

/* Mark a new node as an edit of `from`, which may be a resolved reference. */
void ceduo_node_keep_text(const struct node *made, const struct node *from);

/* Make an empty mapping or list; make a scalar. NULL on failure. */
const struct node *ceduo_node_empty(struct arena *arena, enum node_kind kind, const struct source *source);
const struct node *ceduo_node_scalar(struct arena *arena, const struct source *source, const char *text, bool quoted);

/* Return the place of a problem with a node. `path`: of the value within its file. */
struct problem_place ceduo_node_place(const struct node *node, const char *path);

/* True if two values are equal, apart from their place in a file. */
bool ceduo_node_equal(const struct node *a, const struct node *b);

/* ---- references and paths (resolve.c) ---- */

/* Replace each reference of a scene by the content of its file, and merge stands into their bases. NULL on failure. */
const struct node *ceduo_resolve_scene(struct arena *arena, const struct node *root, struct problems *problems);

/* Find the file that a node names; NULL: none. A path of a file is relative to that file. A path of an option is relative to
 * the scene, then to the current folder. */
const char *ceduo_resolve_path(struct arena *arena, const struct node *node, const char *folder);

/* Set the value at a path below root, through references. `set`: the whole PATH=VALUE, for messages. */
const struct node *ceduo_resolve_set(struct arena *arena, const struct node *root, const struct source *set, size_t path_length,
                                     const struct node *value, struct problems *problems);

struct path_step;

/* Find the item of a list for a step in brackets: by index, or the first with this name. Return false if there is none. */
bool ceduo_resolve_item(const struct node *list, const struct path_step *step, size_t *index);

/* Return the deepest existing node along `path`. Set *file_path to the part of the path below the root of its file, and *used
 * to the number of bytes of the path that lead to the node. */
const struct node *ceduo_resolve_walk(const struct node *root, const char *path, const char **file_path, size_t *used);

/* Return the node at a path; NULL: none. `root` may be NULL. */
const struct node *ceduo_resolve_at(const struct node *root, const char *path);

/* ---- writing (emit.c) ---- */

/* Append a tree as YAML. It must be a mapping or list that is not empty. */
void ceduo_emit(struct text *text, const struct node *root);

/* Return the tree for the scene's own file. Unchanged content of another file becomes its path again. A changed stand becomes
 * `base` and its changes. A changed slope is written out. For the program only: its arenas do not fail. */
const struct node *ceduo_emit_restore_references(struct arena *arena, const struct node *root);

/* Append the text of `source`, whose tree is `old`, with the values of `root` (unresolved), so that comments and layout stay.
 * Return false, and append nothing, if more than values has changed. For the program only: its texts do not fail. */
bool ceduo_emit_patched(struct text *text, const struct source *source, const struct node *old, const struct node *root);

/* Append a tree on one line. */
void ceduo_emit_flow(struct text *text, const struct node *node);

/* Append a scalar as YAML. */
void ceduo_emit_scalar(struct text *text, const char *value, bool quoted);

#endif
