/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_H
#define CEDUO_PAGE_H

#include "base/text.h"
#include "cells.h"

/* A page is a list of blocks. page_result.c and its neighbours build it from a result. page_text.c prints it at a width, or
 * draws it on a canvas; page_html.c writes HTML. A new output format is one file that walks the blocks. */

struct ceduo_svg;

enum ceduo_page_kind {
    CEDUO_PAGE_TITLE,
    CEDUO_PAGE_FACT,     /* value after its label */
    CEDUO_PAGE_SECTION,  /* heading of an option or of a comparison */
    CEDUO_PAGE_PLACE,    /* heading of a control */
    CEDUO_PAGE_CAPTION,  /* caption of the next table */
    CEDUO_PAGE_TABLE,    /* a row of empty heads is not shown */
    CEDUO_PAGE_SENTENCE, /* about a control */
    CEDUO_PAGE_DETAIL,   /* detail of the previous block */
    CEDUO_PAGE_NOTE,     /* note of a section */
    CEDUO_PAGE_ITEM,     /* item of a list */
    CEDUO_PAGE_WARNING,
    CEDUO_PAGE_GAP,
    CEDUO_PAGE_QUESTION, /* question that the page answers */
    CEDUO_PAGE_ANSWER,   /* a sentence of the answer */
    CEDUO_PAGE_POINT,    /* point after its label */
    CEDUO_PAGE_PICTURE,  /* shown by drawing outputs only; text: its title */
    CEDUO_PAGE_CODE,     /* lines of a file, verbatim */
    CEDUO_PAGE_HEAD      /* head of a report: value after its label; empty: a line to fill in by hand */
};

struct ceduo_page_column {
    const char *head; /* marked for translation, "short|long"; NULL: set by ceduo_page_head() */
    int width;        /* characters; < 0: right-aligned; 0: last column, unlimited */
    int gap;          /* blanks before the column */
    unsigned flags;   /* enum ceduo_page_flag and COL_PRIORITY() */
};

enum ceduo_page_flag {
    COL_WRAP = 1 << 1,   /* never cut: wraps into the next line */
    COL_SHRINK = 1 << 2, /* as wide as its widest cell, at least `width` */
    COL_GROW = 1 << 3,   /* at least `width`, takes the remaining width; longer text loses what other cells have, too */
};

/* Columns that do not fit are dropped before names are cut, highest rank first (COL_MINOR to 9). */
#define COL_PRIORITY(rank) ((unsigned)(rank) << 8)
#define COL_MINOR          7

enum ceduo_page_cell_kind { CEDUO_CELL_TEXT, CEDUO_CELL_NUMBER, CEDUO_CELL_BAR };

/* A bar in shares of its column, see ceduo_page_scale(). Shown by drawing outputs only. NaN: not drawn. */
struct ceduo_page_bar {
    double from, to;            /* ends of the bar; from 0, `to` has sub-cell resolution */
    double error_lo, error_hi;  /* error line with end marks */
    double limit;               /* mark across the bar … */
    enum ceduo_role limit_role; /* … in this role */
};

struct ceduo_page_cell {
    enum ceduo_page_cell_kind kind;
    enum ceduo_role role;      /* role of text or bar; BLANK: default */
    struct text text, shorter; /* shorter: used if `text` does not fit; may be empty */
    struct text long_text;     /* long form of a head for wide pages; may be empty */
    double value;              /* value of a number cell */
    int digits;                /* significant digits, if they fit */
    struct ceduo_page_bar bar;
};

struct ceduo_page_block {
    enum ceduo_page_kind kind;
    enum ceduo_role role; /* in a pane; BLANK: default of its kind */
    struct text text;     /* UTF-8 with typographic – − ±; outputs make it safe to print. A label ends in a tab. */
    struct ceduo_page_column *columns;
    size_t columns_count;
    size_t cells_count, cells_capacity; /* row by row, heads first */
    struct ceduo_page_cell *cells;
    struct ceduo_svg *svg;   /* owned by the page */
    bool side_by_side;       /* two such pictures stand next to each other */
    struct text description; /* text alternative of a picture */
    struct ceduo_page_block *next;
};

/* Width from which heads are written out if they fit; in HTML always. */
#define CEDUO_PAGE_WIDE 120

/* Columns of printed pages. A narrower page uses sentences in place of tables. */
#define CEDUO_PAGE_WIDTH 80

#define CEDUO_ANSWER_INDENT 2 /* columns before an answer */

/* Zero except for its width. */
struct ceduo_page {
    size_t width; /* columns of paper or pane */
    struct ceduo_page_block *first, *last;
};

/* Declare a page that is freed at the end of its scope. */
#define LOCAL_PAGE(name, columns) __attribute__((cleanup(ceduo_page_free))) struct ceduo_page name = {.width = (columns)}

#define CEDUO_PAGE_FORMAT(n) __attribute__((format(printf, n, (n) + 1)))

/* Append a block. Return its text for the caller to fill, or format it. */
struct text *ceduo_page_add(struct ceduo_page *page, enum ceduo_page_kind kind);
void ceduo_page_para(struct ceduo_page *page, enum ceduo_page_kind kind, const char *format, ...) CEDUO_PAGE_FORMAT(3);
void ceduo_page_para_role(struct ceduo_page *page, enum ceduo_role role, const char *format, ...)
    CEDUO_PAGE_FORMAT(3);                                                                            /* note */
struct text *ceduo_page_item(struct ceduo_page *page, enum ceduo_page_kind kind, const char *label); /* fact, point or head */

/* Append a table with its heads. Its cells follow row by row. */
void ceduo_page_table(struct ceduo_page *page, const struct ceduo_page_column *columns, size_t n);
#define CEDUO_PAGE_TABLE_OF(page, columns) ceduo_page_table(page, columns, sizeof(columns) / sizeof(columns)[0])
struct ceduo_page_cell *ceduo_page_head(struct ceduo_page *page); /* head of the column whose head is NULL */
struct ceduo_page_cell *ceduo_page_cell(struct ceduo_page *page);
struct text *ceduo_page_text(struct ceduo_page *page);                                              /* text of a new cell */
void ceduo_page_cell_format(struct ceduo_page *page, const char *format, ...) CEDUO_PAGE_FORMAT(2); /* a new cell */
void ceduo_page_number(struct ceduo_page *page, double value, int digits);
/* Append a cell with a bar up to `value`. The caller may add a limit or an error line. */
struct ceduo_page_bar *ceduo_page_bar(struct ceduo_page *page, double value, enum ceduo_role role);
/* Remove the columns of the last table that are empty, unknown or "-" in every row. */
void ceduo_page_trim(struct ceduo_page *page);
/* Convert the bars of a column to shares: linear from 0, or logarithmic if `lo` > 0. */
void ceduo_page_scale(struct ceduo_page *page, size_t column, double lo, double hi);
/* Append a cell in a role. */
void ceduo_page_cell_role(struct ceduo_page *page, enum ceduo_role role, const char *string);

/* Append a picture, owned by the page. The caller fills its title (`text`) and description. */
struct ceduo_page_block *ceduo_page_picture(struct ceduo_page *page, struct ceduo_svg *svg, bool side_by_side);

/* Remove the last block. */
void ceduo_page_drop(struct ceduo_page *page);
void ceduo_page_free(struct ceduo_page *page);

/* Return the number of printed lines. */
size_t ceduo_page_lines(const struct ceduo_page *page);

/* Append the text of a cell, with the digits that fit. `plain`: ASCII. */
void ceduo_page_write_cell(struct text *text, const struct ceduo_page_cell *cell, size_t width, bool plain);

/* Append a text with powers of metres as signs, "m³", "m²/ha"; not inside a word, key or number. */
void ceduo_page_powers(struct text *text, const char *string);

/* Print the page at its width. `plain`: ASCII. */
void ceduo_page_print(struct text *text, const struct ceduo_page *page, bool plain);

/* Write a chapter of an HTML file: no script, network or web font; A4 in print. `number`, from 1, makes ids unique. The
 * begin function writes the head of the file, the end function closes open elements. */
struct ceduo_html;
void ceduo_page_html_begin(struct ceduo_html *html, const char *title);
void ceduo_page_html(struct ceduo_html *html, const struct ceduo_page *page, size_t number);
void ceduo_page_html_end(struct ceduo_html *html);

/* Draw the page from line `first` on into an area of the same width. Return the number of lines of the page; an area of
 * height 0 draws nothing. */
int ceduo_page_draw(const struct ceduo_page *page, struct ceduo_canvas *canvas, struct ceduo_area area, int first);

#endif
