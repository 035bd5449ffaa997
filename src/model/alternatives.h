/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ALTERNATIVES_H
#define CEDUO_ALTERNATIVES_H

#include "document.h"

/* As ceduo_document_set(), but what would then be said twice is taken out in the same state: a sphere has one of three
 * sizes, a rock a mass or a density, the ground a roughness in m or rad, shoots a number per ha or per stool. Another
 * shape takes the sizes out that do not belong to it and gets its own, of the same volume. Neighbours follow a border,
 * assumed heights their diameter (changes.h). What was done beside the change is put into `said`. */
bool ceduo_document_set_alone(struct document *document, const char *path, const char *value, struct text *said,
                              struct problems *problems);

#endif
