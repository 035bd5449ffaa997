/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_KEEP_FIT_H
#define CEDUO_KEEP_FIT_H

#include "ceduo/doubt.h"
#include "document.h"

/* What was fitted goes into a document: the best values, where they come from, and the draws as its doubt. */
struct fit_values {
    size_t n;
    const struct ceduo_input *inputs; /* places in the document's scene; those without are left out */
    const struct field *const *fields;
    const double *best;
    const char *source; /* what the fit rests on */
    const char *draws;  /* path of the table of draws, as the document is to name it; NULL: none */
};

/* One edit, which undo takes back. A ground from materials is written out as segments. False with the reason in `problems`. */
bool ceduo_keep_fit(struct document *document, const struct fit_values *fit, struct problems *problems);

#endif
