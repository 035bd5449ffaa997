/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DOCUMENT_PARTS_H
#define CEDUO_DOCUMENT_PARTS_H

#include "document.h"

/* What the files of the document share. */

/* Makes `root` the scene and a new state of the document. NULL: an edit failed, for want of memory where there is no
 * problem yet. False, and everything as it was, where it is no scene. */
bool ceduo_document_commit(struct document *document, const struct node *root, const char *what,
                           struct problems *problems);

/* Reads a text that was typed, or is the whole file; `name` stands in messages. NULL with the reason in `problems`. */
const struct node *ceduo_document_parse(struct document *document, const char *name, const char *text,
                                        struct problems *problems);

/* Takes note of the file on disk as it is now. */
void ceduo_document_note_disk(struct document *document);

/* What a save that was killed may have left beside the file is removed. */
void ceduo_document_tidy(const char *path);

#endif
