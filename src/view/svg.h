/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SVG_H
#define CEDUO_SVG_H

#include "canvas.h"

/* Writes HTML and SVG. All that comes from outside goes through here and nowhere else: text and values of attributes
 * are escaped, control characters and bytes that are no UTF-8 become visible. Names of elements and attributes are the
 * program's own. */

#define CEDUO_HTML_DEPTH_MAX 24

struct ceduo_html {
    struct text *text;
    const char *open[CEDUO_HTML_DEPTH_MAX]; /* elements not yet closed; constant strings */
    size_t depth;
};

/* Opens an element with attributes, name and value in turn, then NULL. An attribute whose value is NULL is left out. */
void ceduo_html_open(struct ceduo_html *html, const char *name, ...) __attribute__((sentinel));
void ceduo_html_close(struct ceduo_html *html); /* the one opened last */

/* An element with nothing in it, and one with a text alone, attributes as above. */
void ceduo_html_empty(struct ceduo_html *html, const char *name, ...) __attribute__((sentinel));
void ceduo_html_leaf(struct ceduo_html *html, const char *name, const char *text, ...) __attribute__((sentinel));

/*
 * The second surface of the canvas: vectors for a page. A picture is laid out in the same cells as in a terminal;
 * lines, axes, bars and discs are drawn where they are and not at the nearest dot; text is in the reader's monospace
 * font, each word as wide as its cells. A grid of cells goes along that holds the text and knows which cells are taken.
 *
 * Colours have a contrast of 4.5 to white at least, and differ in lightness and stroke, too, so that a grey print can
 * be read.
 */

struct ceduo_svg;

/* Its size in cells, as that of ceduo_cells_create(). */
struct ceduo_svg *ceduo_svg_create(int width, int height);
void ceduo_svg_free(struct ceduo_svg *svg); /* NULL is allowed */

/* To draw on. */
struct ceduo_canvas *ceduo_svg_canvas(struct ceduo_svg *svg);

/* Adds the picture as an element of a page, with what is told of it beside what is drawn. `id` is unlike that of every other
 * picture of the page. May be called once. */
void ceduo_svg_write(struct ceduo_html *html, struct ceduo_svg *svg, const char *id, const char *title,
                     const char *description);

/* A screen of the terminal program as a file of its own, in the colours of a dark terminal. */
void ceduo_svg_screen(struct text *text, const struct ceduo_cells *cells, const char *title);

#endif
