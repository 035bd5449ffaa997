/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SVG_H
#define CEDUO_SVG_H

#include "canvas.h"
#include "html.h"

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
