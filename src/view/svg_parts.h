/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SVG_PARTS_H
#define CEDUO_SVG_PARTS_H

#include "cells.h"
#include "html.h"

/* What the vector surface and the vector screen share. A cell is CELL units wide and twice as high. */

enum { SVG_CELL = 8, SVG_DRAWN = 0xE000 /* code of a cell whose content is drawn otherwise */ };

struct ceduo_svg_look {
    const char *colour;
    double width;       /* of lines, units */
    const char *weight; /* of text; NULL: normal */
};

struct ceduo_svg_theme {
    const char *paper; /* behind all; NULL: nothing */
    const char *font;
    bool spaced; /* text is set to the width of its cells */
    bool dots;   /* cells show their dots */
    struct ceduo_svg_look looks[CEDUO_ROLE_COUNT];
};

/* Adds a number with one decimal at most. */
void ceduo_svg_number(struct text *text, double value);

/* Adds all text of the cells, and characters that are pictures as pictures. */
void ceduo_svg_cells(struct ceduo_html *html, const struct ceduo_cells *cells, const struct ceduo_svg_theme *theme);

/* Adds a path of a role's colour; `extra`: one more attribute and its value, or NULL. */
void ceduo_svg_stroke(struct ceduo_html *html, const struct ceduo_svg_look *look, const struct text *path, const char *extra,
                      const char *value);

#endif
