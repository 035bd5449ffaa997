/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_EMIT_H
#define CEDUO_EMIT_H

#include "node.h"

/* A tree as YAML text: a mapping or list that is not empty. */
void ceduo_emit(struct text *text, const struct node *root);

/* The tree as it is to be written to the scene's own file: what came from another file and is unchanged is its path
 * again, a changed stand starts from its file by `base`, a changed slope is written out. For the
 * program, where no arena fails. */
const struct node *ceduo_emit_unresolve(struct arena *arena, const struct node *root);

/* Writes `root` (unresolved) as the text of `source`, whose tree is `old`, with the changed values alone put in place, so
 * that comments and layout stay. False where more than values has changed: then nothing is added. For the program, where no text
 * fails for want of memory. */
bool ceduo_emit_patched(struct text *text, const struct source *source, const struct node *old, const struct node *root);

/* Adds any tree on one line. */
void ceduo_emit_flow(struct text *text, const struct node *node);

/* One scalar as it is written in YAML. */
void ceduo_emit_scalar(struct text *text, const char *value, bool quoted);

#endif
