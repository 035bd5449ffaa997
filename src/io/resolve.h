/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RESOLVE_H
#define CEDUO_RESOLVE_H

#include "bind.h"

/* Puts in place of each path that a scene refers to what its file holds, and merges stands into their bases. NULL where that
 * fails; what is wrong is in `problems`. */
const struct node *ceduo_resolve_scene(struct arena *arena, const struct node *root, struct problems *problems);

/* The file that a node names, in the arena; NULL where there is none. A path is looked for beside the file that it was read
 * from, what was set or typed beside the scene and then in the current folder. */
const char *ceduo_resolve_path(struct arena *arena, const struct node *node, const char *folder);

/* Puts `value` at `path` below root, through references. `set` is the whole PATH=VALUE, for messages. */
const struct node *ceduo_resolve_set(struct arena *arena, const struct node *root, const struct source *set, size_t path_length,
                                     const struct node *value, struct problems *problems);

/* The item of a list that a bracket means: by its place, or the first of its name. False where there is none. */
bool ceduo_resolve_item(const struct node *list, const struct path_step *step, size_t *index);

/* The deepest node along `path` that exists; `*within` is the part of the path from its file's root on,
 * `*used` how many bytes of the path led to it. */
const struct node *ceduo_resolve_walk(const struct node *root, const char *path, const char **within, size_t *used);

/* The node at a path; NULL where there is none, or no root. */
const struct node *ceduo_resolve_at(const struct node *root, const char *path);

#endif
