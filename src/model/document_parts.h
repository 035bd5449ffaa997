/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOCUMENT_PARTS_H
#define CEDUO_DOCUMENT_PARTS_H

#include <stdbool.h>

struct document;
struct node;
struct problems;

/* Shared by the files that implement document.h. */

/* Makes `root` the scene and adds it as a new state. Returns false and changes nothing if `root` is not a valid scene, or
 * is NULL: then an edit failed, for want of memory unless there is a problem already. */
bool ceduo_document_commit(struct document *document, const struct node *root, const char *what,
                           struct problems *problems);

/* Parses YAML that was typed or read; `name` appears in messages. NULL with the reason in `problems`. */
const struct node *ceduo_document_parse(struct document *document, const char *name, const char *text,
                                        struct problems *problems);

/* Notes size and time of the file on disk, to see later whether it has changed. */
void ceduo_document_note_disk(struct document *document);

/* Removes what a killed save may have left beside the file. */
void ceduo_document_tidy(const char *path);

#endif
