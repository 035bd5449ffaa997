/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_NODE_H
#define CEDUO_NODE_H

#include <stdint.h>

#include "base/arena.h"
#include "problem.h"

enum node_kind { NODE_SCALAR, NODE_MAP, NODE_LIST };

/* A value of a YAML file. Nodes never change once made: an edit makes new ones from the root down to it and shares
 * the rest, so that every earlier state of a document stays whole. */
struct node {
    enum node_kind kind;
    bool quoted;                   /* a scalar in quotes: text, never a number */
    bool flow;                     /* a mapping or list in brackets */
    bool broken;                   /* a reference that leads nowhere, or a mapping that starts from one: reported already */
    uint32_t line, column;         /* of the value, from 1 */
    uint32_t end_line, end_column; /* of a scalar, or what is in brackets: just after it */
    uint32_t key_line, key_column; /* of its key; 0: none */
    const struct source *source;
    const char *key;                 /* in a mapping */
    const char *text;                /* of a scalar */
    const struct node *const *items; /* of a mapping or list */
    size_t n;
    const struct node *written;  /* what is written here where a file was followed: its path, or base and changes */
    const struct node *followed; /* and what that led to, before any edit */
};

/* Reads one YAML document. NULL where it is not well-formed; what is wrong is in `problems`. Aliases, anchors, tags,
 * duplicate keys, a second document, more than 16 levels are refused. */
const struct node *ceduo_yaml_read(struct arena *arena, const struct source *source, struct problems *problems);

/* As above for one value that begins `skip` bytes into the source. */
const struct node *ceduo_yaml_read_value(struct arena *arena, const struct source *source, size_t skip,
                                         struct problems *problems);

/* The entry of a mapping; NULL where there is none, or node is no mapping. */
const struct node *ceduo_node_get(const struct node *node, const char *key);

/* The text of a scalar entry; NULL where there is none. */
const char *ceduo_node_text(const struct node *node, const char *key);

/* The number of such an entry; NaN where there is none. */
double ceduo_node_number(const struct node *node, const char *key);

/* The number that item i of a list is; NaN where it is none. */
double ceduo_node_item_number(const struct node *list, size_t i);

/* A mapping with the entry put in place of one with its key, or added; without it. NULL without memory, and of NULL. */
const struct node *ceduo_node_with(struct arena *arena, const struct node *map, const char *key, const struct node *value);
const struct node *ceduo_node_without(struct arena *arena, const struct node *map, const char *key);

/* A list or mapping with item i replaced; with one put in before i (i = n: at the end); with item i taken out. */
const struct node *ceduo_node_replaced(struct arena *arena, const struct node *node, size_t i, const struct node *value);
const struct node *ceduo_node_inserted(struct arena *arena, const struct node *node, size_t i, const struct node *value);
const struct node *ceduo_node_removed(struct arena *arena, const struct node *node, size_t i);

/* The same value under another key (NULL: none). */
const struct node *ceduo_node_renamed(struct arena *arena, const struct node *value, const char *key);

/* Notes that a node made just now is an edit of `from`, which may have been followed from a file. */
void ceduo_node_keep_text(const struct node *made, const struct node *from);

/* A mapping or list without items, and a scalar, that stand nowhere yet. NULL without memory. */
const struct node *ceduo_node_empty(struct arena *arena, enum node_kind kind, const struct source *source);
const struct node *ceduo_node_scalar(struct arena *arena, const struct source *source, const char *text, bool quoted);

/* Where something is wrong with a node: `path` is that of the value within its file. */
struct problem_place ceduo_node_place(const struct node *node, const char *path);

/* Whether two values say the same, wherever they stand. */
bool ceduo_node_equal(const struct node *a, const struct node *b);

/* ---- references and paths (resolve.c) ---- */

/* Puts in place of each path that a scene refers to what its file holds, and merges stands into their bases. NULL where that
 * fails; what is wrong is in `problems`. */
const struct node *ceduo_resolve_scene(struct arena *arena, const struct node *root, struct problems *problems);

/* The file that a node names, in the arena; NULL where there is none. A path is looked for beside the file that it was read
 * from, what was set or typed beside the scene and then in the current folder. */
const char *ceduo_resolve_path(struct arena *arena, const struct node *node, const char *folder);

/* Puts `value` at `path` below root, through references. `set` is the whole PATH=VALUE, for messages. */
const struct node *ceduo_resolve_set(struct arena *arena, const struct node *root, const struct source *set, size_t path_length,
                                     const struct node *value, struct problems *problems);

struct path_step;

/* The item of a list that a bracket means: by its place, or the first of its name. False where there is none. */
bool ceduo_resolve_item(const struct node *list, const struct path_step *step, size_t *index);

/* The deepest node along `path` that exists; `*within` is the part of the path from its file's root on,
 * `*used` how many bytes of the path led to it. */
const struct node *ceduo_resolve_walk(const struct node *root, const char *path, const char **within, size_t *used);

/* The node at a path; NULL where there is none, or no root. */
const struct node *ceduo_resolve_at(const struct node *root, const char *path);

/* ---- writing (emit.c) ---- */

/* A tree as YAML text: a mapping or list that is not empty. */
void ceduo_emit(struct text *text, const struct node *root);

/* The tree as it is to be written to the scene's own file: what came from another file and is unchanged is its path
 * again, a changed stand starts from its file by `base`, a changed slope is written out. For the
 * program, where no arena fails. */
const struct node *ceduo_emit_restore_references(struct arena *arena, const struct node *root);

/* Writes `root` (unresolved) as the text of `source`, whose tree is `old`, with the changed values alone put in place, so
 * that comments and layout stay. False where more than values has changed: then nothing is added. For the program, where no text
 * fails for want of memory. */
bool ceduo_emit_patched(struct text *text, const struct source *source, const struct node *old, const struct node *root);

/* Adds any tree on one line. */
void ceduo_emit_flow(struct text *text, const struct node *node);

/* One scalar as it is written in YAML. */
void ceduo_emit_scalar(struct text *text, const char *value, bool quoted);

#endif
