/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_HTML_H
#define CEDUO_HTML_H

#include "base/text.h"

/* Writes HTML and SVG. All that comes from outside goes through here and nowhere else: text and values of attributes
 * are escaped, control characters and bytes that are no UTF-8 become visible. Names of elements and attributes are the
 * program's own. */

#define CEDUO_HTML_DEEPEST 24

struct ceduo_html {
    struct text *text;
    const char *open[CEDUO_HTML_DEEPEST]; /* elements not yet closed; constant strings */
    size_t depth;
};

/* Opens an element with attributes, name and value in turn, then NULL. An attribute whose value is NULL is left out. */
void ceduo_html_open(struct ceduo_html *html, const char *name, ...) __attribute__((sentinel));
void ceduo_html_close(struct ceduo_html *html); /* the one opened last */

/* An element with nothing in it, and one with a text alone, attributes as above. */
void ceduo_html_empty(struct ceduo_html *html, const char *name, ...) __attribute__((sentinel));
void ceduo_html_leaf(struct ceduo_html *html, const char *name, const char *text, ...) __attribute__((sentinel));

#endif
