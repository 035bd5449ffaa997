/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_H
#define CEDUO_PAGE_H

#include "base/text.h"
#include "cells.h"

/* A page is a list of blocks. page_result.c and its neighbours build it from a result. page_text.c prints it at a width, or draws
 * it into a pane of the terminal program or a picture; page_html.c writes it as HTML. Another sink is one more file that walks
 * the same blocks. */

struct ceduo_svg;

enum ceduo_page_kind {
    CEDUO_PAGE_TITLE,
    CEDUO_PAGE_FACT,     /* what it is, after its label */
    CEDUO_PAGE_SECTION,  /* heading of an option, of a comparison */
    CEDUO_PAGE_PLACE,    /* heading of a control in it */
    CEDUO_PAGE_CAPTION,  /* of the table that follows */
    CEDUO_PAGE_TABLE,    /* heads that are all empty are not shown */
    CEDUO_PAGE_SENTENCE, /* of a place */
    CEDUO_PAGE_DETAIL,   /* of what stands before */
    CEDUO_PAGE_NOTE,     /* of a section */
    CEDUO_PAGE_ITEM,     /* of a list in a section */
    CEDUO_PAGE_WARNING,
    CEDUO_PAGE_GAP,
    CEDUO_PAGE_QUESTION, /* what the page answers */
    CEDUO_PAGE_ANSWER,   /* a sentence of the answer */
    CEDUO_PAGE_POINT,    /* after its label */
    CEDUO_PAGE_PICTURE,  /* only sinks that draw show it; its text is its title */
    CEDUO_PAGE_CODE,     /* lines as they are in a file */
    CEDUO_PAGE_HEAD      /* of a report: what it is, after its label; nothing: a line to write on */
};

struct ceduo_page_column {
    const char *head; /* marked for translation, "short|written out"; NULL: the page's own, see ceduo_page_head() */
    int width;        /* in characters; negative: set to the right; 0: the last, as wide as it comes */
    int gap;          /* blanks before it */
    unsigned flags;   /* and CEDUO_DROPPED() */
};

enum ceduo_page_flag {
    CEDUO_WHOLE = 1 << 1, /* never cut: the row goes on in a line below */
    CEDUO_FITS = 1 << 2,  /* as wide as its widest cell, and no less than its width */
    CEDUO_FILLS = 1 << 3, /* at least its width, and what the others leave: a text that is longer loses its middle, as names
                           * often differ at their ends; a bar is so long */
};

/* Columns without room are left out, the highest rank first: from CEDUO_MINOR on, at most 9, before names are cut. */
#define CEDUO_DROPPED(rank) ((unsigned)(rank) << 8)
#define CEDUO_MINOR         7

enum ceduo_page_cell_kind { CEDUO_CELL_TEXT, CEDUO_CELL_NUMBER, CEDUO_CELL_BAR };

/* A bar in shares of its column, see ceduo_page_scale(); only sinks that draw show it. NaN: not there. */
struct ceduo_page_bar {
    double from, to;     /* the bar; from 0 it ends at a part of a character */
    double least, most;  /* a line with ends around it */
    double limit;        /* a mark across it … */
    enum ceduo_role own; /* … in this role */
};

struct ceduo_page_cell {
    enum ceduo_page_cell_kind kind;
    enum ceduo_role role;      /* of its text in a pane, or of its bar; BLANK: as the others */
    struct text text, shorter; /* shorter: where there is no room for the other; may be empty */
    struct text written;       /* of a head: written out, on pages that have room; may be empty */
    double value;              /* a number */
    int digits;                /* of the number, where there is room for them */
    struct ceduo_page_bar bar;
};

struct ceduo_page_block {
    enum ceduo_page_kind kind;
    enum ceduo_role role; /* in a pane; BLANK: that of its kind */
    struct text text; /* UTF-8 with the signs – − ± as they should be; sinks make it safe to print; a label ends in a tab */
    struct ceduo_page_column *columns;
    size_t columns_count;
    size_t cells_count, cells_room; /* row by row, the heads first */
    struct ceduo_page_cell *cells;
    struct ceduo_svg *svg;   /* of a picture; the page's own */
    bool half;               /* two such pictures stand side by side */
    struct text description; /* of a picture, for who does not see it */
    struct ceduo_page_block *next;
};

/* From so many columns on heads are written out where they have room; on pages of HTML always. */
#define CEDUO_PAGE_WIDE 120

/* Columns of what is printed. A page narrower than this says in sentences what it would show as a table. */
#define CEDUO_PAGE_WIDTH 80

#define CEDUO_ANSWER_INDENT 2 /* columns before an answer */

/* Starts zeroed but for its width. */
struct ceduo_page {
    size_t width; /* columns of the paper or pane */
    struct ceduo_page_block *first, *last;
};

/* A page that is freed where its block ends. */
#define LOCAL_PAGE(name, columns) __attribute__((cleanup(ceduo_page_free))) struct ceduo_page name = {.width = (columns)}

#define CEDUO_PAGE_FORMAT(n) __attribute__((format(printf, n, (n) + 1)))

/* Adds a block and returns its text, which the caller fills; or fills it. */
struct text *ceduo_page_add(struct ceduo_page *page, enum ceduo_page_kind kind);
void ceduo_page_para(struct ceduo_page *page, enum ceduo_page_kind kind, const char *format, ...) CEDUO_PAGE_FORMAT(3);
void ceduo_page_para_role(struct ceduo_page *page, enum ceduo_role role, const char *format, ...)
    CEDUO_PAGE_FORMAT(3);                                                                            /* a note */
struct text *ceduo_page_item(struct ceduo_page *page, enum ceduo_page_kind kind, const char *label); /* fact, point, head */

/* Adds a table with its heads; then its cells, row by row, to the block added last. */
void ceduo_page_table(struct ceduo_page *page, const struct ceduo_page_column *columns, size_t n);
#define CEDUO_PAGE_TABLE_OF(page, columns) ceduo_page_table(page, columns, sizeof(columns) / sizeof(columns)[0])
struct ceduo_page_cell *ceduo_page_head(struct ceduo_page *page); /* of the column whose head is NULL */
struct ceduo_page_cell *ceduo_page_cell(struct ceduo_page *page);
struct text *ceduo_page_text(struct ceduo_page *page);                                              /* of a new cell */
void ceduo_page_cell_format(struct ceduo_page *page, const char *format, ...) CEDUO_PAGE_FORMAT(2); /* a new cell */
void ceduo_page_number(struct ceduo_page *page, double value, int digits);
/* A new cell with a bar up to a value, to which the caller adds a limit or a line around it. */
struct ceduo_page_bar *ceduo_page_bar(struct ceduo_page *page, double value, enum ceduo_role role);
/* Removes the columns of the last table that are empty, unknown or "-" in every row. */
void ceduo_page_trim(struct ceduo_page *page);
/* Makes shares of the values of all bars of a column: even ones from 0 on, or logarithmic ones from `lo` on. */
void ceduo_page_scale(struct ceduo_page *page, size_t column, double lo, double hi);
/* A new cell in a role. */
void ceduo_page_cell_role(struct ceduo_page *page, enum ceduo_role role, const char *string);

/* Adds a picture, which is the page's from then on; its title (`text`) and description are for the caller to fill. */
struct ceduo_page_block *ceduo_page_picture(struct ceduo_page *page, struct ceduo_svg *svg, bool half);

/* Takes the last block away. */
void ceduo_page_drop(struct ceduo_page *page);
void ceduo_page_free(struct ceduo_page *page);

/* Lines of what is printed of it. */
size_t ceduo_page_lines(const struct ceduo_page *page);

/* What a cell says, with as many digits as its column has room for. `plain`: its signs in ASCII. */
void ceduo_page_write_cell(struct text *text, const struct ceduo_page_cell *cell, size_t width, bool plain);

/* Adds a text with the powers of metres as signs, "m³", "m²/ha": not those within a word, a key or a number. */
void ceduo_page_powers(struct text *text, const char *string);

/* Prints the page, `page->width` columns wide. `plain`: its signs in ASCII. */
void ceduo_page_print(struct text *text, const struct ceduo_page *page, bool plain);

/* Writes it as a chapter of an HTML file: no script, no network, no fonts of its own; printed on A4. `number`, from 1, makes what it
 * is called within the file unique. Begin writes all up to the first chapter, end closes what is open. */
struct ceduo_html;
void ceduo_page_html_begin(struct ceduo_html *html, const char *title);
void ceduo_page_html(struct ceduo_html *html, const struct ceduo_page *page, size_t number);
void ceduo_page_html_end(struct ceduo_html *html);

/* Draws the page into an area that is as wide as the page, from its line `first` on: headings, warnings and verdicts in roles of
 * their own. Returns how many lines the page has; an area of height 0 shows nothing. */
int ceduo_page_draw(const struct ceduo_page *page, struct ceduo_canvas *canvas, struct ceduo_area area, int first);

#endif
