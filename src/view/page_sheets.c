/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How many sheets of A4 a page of HTML fills, by the sizes of its style: near enough to tell whether something must be left
 * out. Lengths are in mm. */
#include <math.h>
#include <string.h>

#include "base/utf8.h"
#include "page_html.h"
#include "svg.h"

#define SHEET   273.0 /* between the margins */
#define WIDTH   172.0
#define COLUMNS 2.0 /* of code */

/* How text of a kind is set: characters and height of a line, what stands around it. */
static const struct {
    double characters, line, around;
} set[] = {[CEDUO_PAGE_TITLE] = {55, 7.2, 4},    [CEDUO_PAGE_SECTION] = {85, 4.9, 5},    [CEDUO_PAGE_PLACE] = {95, 4.8, 4},
           [CEDUO_PAGE_CAPTION] = {125, 3.5, 1}, [CEDUO_PAGE_SENTENCE] = {118, 4.13, 1}, [CEDUO_PAGE_DETAIL] = {118, 3.9, 1},
           [CEDUO_PAGE_NOTE] = {118, 4.13, 1},   [CEDUO_PAGE_ITEM] = {112, 4.13, 0.2},   [CEDUO_PAGE_WARNING] = {110, 4.13, 1},
           [CEDUO_PAGE_QUESTION] = {76, 5.5, 3}, [CEDUO_PAGE_ANSWER] = {90, 4.8, 3},     [CEDUO_PAGE_FACT] = {95, 4.13, 0.5}};

static double of_text(const struct ceduo_page_block *b)
{
    double width = (double)ceduo_utf8_width(ceduo_text_string(&b->text));
    return width > 0 ? ceil(width / set[b->kind].characters) * set[b->kind].line + set[b->kind].around : 0;
}

static double of_code(const struct ceduo_page_block *b)
{
    const double characters = 58, line = 2.9;
    double lines = 0;
    for (const char *at = ceduo_text_string(&b->text), *end; *at; at = *end ? end + 1 : end) {
        end = at + strcspn(at, "\n");
        lines += ceil((double)(end - at) / characters + 1e-9);
    }
    return 6 + (lines > 2 ? lines / COLUMNS : lines) * line;
}

static double of_table(const struct ceduo_page_block *b)
{
    const double row = 4.62, around = 3.2;
    return b->columns_count > 0 ? (double)(b->cells_count / b->columns_count) * row + around : 0;
}

static double of_picture(const struct ceduo_page_block *b)
{
    const double title = 8.5;
    return (WIDTH * ceduo_svg_aspect(b->svg) + title) / (b->half ? 4 : 1);
}

static double height(const struct ceduo_page_block *b)
{
    switch (b->kind) {
    case CEDUO_PAGE_TABLE:
        return of_table(b);
    case CEDUO_PAGE_PICTURE:
        return of_picture(b);
    case CEDUO_PAGE_CODE:
        return of_code(b);
    case CEDUO_PAGE_GAP:
        return 0;
    default:
        return of_text(b);
    }
}

double ceduo_page_sheets(const struct ceduo_page *page)
{
    double all = 0;
    for (const struct ceduo_page_block *b = page->first; b; b = b->next)
        all += height(b);
    return all / SHEET;
}
