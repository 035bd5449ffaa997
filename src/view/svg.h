/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SVG_H
#define CEDUO_SVG_H

#include "canvas.h"

/* HTML and SVG writer. Every untrusted string is escaped here: text and attribute values; control characters and invalid
 * UTF-8 become visible. Names of elements and attributes are constants of the program. */

#define CEDUO_HTML_DEPTH_MAX 24

struct ceduo_html {
    struct text *text;
    const char *open[CEDUO_HTML_DEPTH_MAX]; /* open elements; constant strings */
    size_t depth;
};

/* Open an element. Attributes are pairs of name and value, then NULL. A value of NULL omits the attribute. */
void ceduo_html_open(struct ceduo_html *html, const char *name, ...) __attribute__((sentinel));
void ceduo_html_close(struct ceduo_html *html); /* closes the last element */

/* Write an empty element; an element with text only. */
void ceduo_html_empty(struct ceduo_html *html, const char *name, ...) __attribute__((sentinel));
void ceduo_html_leaf(struct ceduo_html *html, const char *name, const char *text, ...) __attribute__((sentinel));

/* Vector surface of the canvas. Layout is in cells, as in a terminal. Lines, axes, bars and discs keep their exact
 * positions. Text is monospace, each word as wide as its cells. A grid of cells holds text and occupied cells. Colours have
 * a contrast of at least 4.5 to white, and differ in lightness and stroke for grey prints. */

struct ceduo_svg;

/* Create a picture; size in cells as in ceduo_cells_create(). */
struct ceduo_svg *ceduo_svg_create(int width, int height);
void ceduo_svg_free(struct ceduo_svg *svg); /* may be NULL */

/* Return the canvas. */
struct ceduo_canvas *ceduo_svg_canvas(struct ceduo_svg *svg);

/* Write the picture as an element, with title and description. `id` is unique in the page. Call at most once. */
void ceduo_svg_write(struct ceduo_html *html, struct ceduo_svg *svg, const char *id, const char *title,
                     const char *description);

/* Write a screen of the terminal program as an SVG file in the colours of a dark terminal. */
void ceduo_svg_screen(struct text *text, const struct ceduo_cells *cells, const char *title);

#endif
