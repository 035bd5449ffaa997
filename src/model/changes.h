/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_CHANGES_H
#define CEDUO_CHANGES_H

#include "ceduo/calibrate.h"
#include "document.h"

/* What is to be changed as one edit, and how that is said. Starts with the document alone. */
struct changes {
    struct document *d;
    const char **sets; /* as of ceduo_document_set_all() */
    size_t n, room;
    struct text taken, filled, followed;
    struct text refused; /* why it cannot be; "": it can, as far as is known */
};

void ceduo_changes_add(struct changes *changes, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds that an entry is taken out, if it is there. */
void ceduo_changes_remove(struct changes *changes, const char *path);

/* Makes the edit, and frees the changes. */
bool ceduo_changes_make(struct changes *changes, const char *what, struct problems *problems);
void ceduo_changes_free(struct changes *changes);

/* As ceduo_document_set(), but what would then be said twice is taken out in the same state: a sphere has one of three
 * sizes, a rock a mass or a density, the ground a roughness in m or rad, shoots a number per ha or per stool. Another
 * shape takes the sizes out that do not belong to it and gets its own, of the same volume. Neighbours follow a border,
 * assumed heights their diameter. What was done beside the change is added to `said`. */
bool ceduo_document_set_alone(struct document *document, const char *path, const char *value, struct text *said,
                              struct problems *problems);

/* What was fitted goes into a document: the best values, where they come from, and the draws as its doubt. */
struct fit_values {
    const struct ceduo_calibration *answer;
    const struct ceduo_input *inputs; /* places in the document's scene; those without are left out */
    const char *source;               /* what the fit rests on */
    const char *draws;                /* path of the table of draws, as the document is to name it; NULL: none */
};

/* One edit, which undo takes back. A ground from materials is written out as segments. False with the reason in `problems`. */
bool ceduo_keep_fit(struct document *document, const struct fit_values *fit, struct problems *problems);

#endif
