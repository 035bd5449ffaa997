/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Write a page as HTML. Consecutive blocks of a list kind form one list. A caption is moved into the table after it. */
#include <assert.h>
#include <stdio.h>
#include <string.h>

#include "base/language.h"
#include "page.h"
#include "svg.h"

/* ---- elements ---- */

/* Escape for HTML. Newlines and tabs stay; other control characters become \xHH. */
static void append_html(struct text *to, const char *string)
{
    static const char signs[] = "&<>\"'", *const names[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    for (size_t n; *string; string += n + (string[n] != '\0')) {
        n = strcspn(string, "&<>\"'\n\t");
        ceduo_text_append_escaped_n(to, string, n);
        const char *sign = string[n] ? strchr(signs, string[n]) : NULL;
        if (sign)
            ceduo_text_append(to, names[sign - signs]);
        else if (string[n])
            ceduo_text_append_char(to, string[n]);
    }
}

static void begin_tag(struct ceduo_html *html, const char *name, va_list args)
{
    ceduo_text_format(html->text, "<%s", name);
    for (const char *key; (key = va_arg(args, const char *)) != NULL;) {
        const char *value = va_arg(args, const char *);
        if (!value)
            continue;
        ceduo_text_format(html->text, " %s=\"", key);
        append_html(html->text, value);
        ceduo_text_append_char(html->text, '"');
    }
}

void ceduo_html_open(struct ceduo_html *html, const char *name, ...)
{
    va_list args;
    assert(html->depth < CEDUO_HTML_DEPTH_MAX);
    html->open[html->depth++] = name;
    va_start(args, name);
    begin_tag(html, name, args);
    va_end(args);
    ceduo_text_append_char(html->text, '>');
}

void ceduo_html_close(struct ceduo_html *html)
{
    assert(html->depth > 0);
    ceduo_text_format(html->text, "</%s>\n", html->open[--html->depth]);
}

void ceduo_html_empty(struct ceduo_html *html, const char *name, ...)
{
    va_list args;
    va_start(args, name);
    begin_tag(html, name, args);
    va_end(args);
    ceduo_text_append(html->text, "/>\n");
}

void ceduo_html_leaf(struct ceduo_html *html, const char *name, const char *text, ...)
{
    va_list args;
    va_start(args, text);
    begin_tag(html, name, args);
    va_end(args);
    ceduo_text_append_char(html->text, '>');
    append_html(html->text, text);
    ceduo_text_format(html->text, "</%s>\n", name);
}

/* ---- file ---- */

/* Text has a contrast of at least 4.5 to its background. Blocks that belong together are not split between pages in print. */
static const char style[] =
    "@page{size:A4;margin:10mm 13mm}\n"
    "*{box-sizing:border-box}\n"
    "html{background:#fff;color:#1c1c1c;font:9pt/1.24 'Liberation "
    "Sans',Arial,Helvetica,sans-serif;-webkit-print-color-adjust:exact;"
    "print-color-adjust:exact}\n"
    "body{max-width:184mm;margin:0 auto}\n"
    "h1{font-size:17pt;line-height:1.2;margin:2mm 0 2mm;overflow-wrap:anywhere}\n"
    "h2{font-size:11.5pt;line-height:1.2;margin:2mm 0 1mm;padding-bottom:.5mm;border-bottom:.3mm solid "
    "#14532d;color:#14532d;"
    "overflow-wrap:anywhere}\n"
    "h3{font-size:10.5pt;margin:3mm 0 1mm;overflow-wrap:anywhere}\n"
    "h1,h2,h3,caption,.detail:has(+figure){break-after:avoid}\n"
    "tr,li,.answer,.warning,.head,.pair{break-inside:avoid}\n"
    "thead{display:table-header-group}\n"
    "p,li,dd{overflow-wrap:anywhere}\n"
    "p{margin:1mm 0}\n"
    ".question{font-size:12pt;font-weight:bold;margin:2mm 0 1.5mm}\n"
    ".answer{border:.3mm solid #4a4a4a;border-left-width:2mm;background:#f3f3f3;padding:1.5mm 4mm;margin:0 0 2.5mm}\n"
    ".answer.yes{border-color:#1f5c99;background:#e6f0fa}\n"
    ".answer.no{border-color:#b04a00;background:#fdeee0;border-style:double;border-width:1mm 1mm 1mm 2mm}\n"
    ".answer.depends{border-color:#4a4a4a;border-style:dashed;border-width:.5mm .5mm .5mm 2mm}\n"
    ".answer p{font-size:10pt;margin:1mm 0}\n"
    ".answer p:first-child{font-size:12pt;font-weight:bold}\n"
    ".detail{color:#4a4a4a;font-size:8.5pt}\n"
    ".warning{border-left:1mm solid #7a4a00;padding-left:2.5mm;color:#5c3800}\n"
    "dl{display:grid;grid-template-columns:max-content 1fr;gap:.5mm 4mm;margin:1mm 0}\n"
    "dt{color:#4a4a4a}\n"
    "dd{margin:0}\n"
    ".head{grid-template-columns:max-content 1fr max-content 1fr;gap:1mm 4mm;padding:1.5mm 0;border:solid #4a4a4a;"
    "border-width:.2mm 0}\n"
    ".line{border-bottom:.3mm solid #1c1c1c;min-height:5.5mm}\n"
    "ul{margin:1mm 0;padding-left:5mm;font-size:8.25pt;line-height:1.18}\n"
    "table{border-collapse:collapse;width:100%;margin:1.2mm 0 2mm;font-size:8.25pt;line-height:1.18;"
    "font-variant-numeric:tabular-nums;break-inside:avoid}\n"
    "caption{text-align:left;padding-bottom:1mm;font-size:9pt;font-weight:bold}\n"
    "th,td{padding:.5mm 1.2mm;text-align:left;vertical-align:top;border-bottom:.2mm solid "
    "#c9cfc4;overflow-wrap:break-word}\n"
    "thead th,thead td{border-bottom:.35mm solid #4a4a4a;vertical-align:bottom;font-weight:bold}\n"
    "tbody th{font-weight:normal;min-width:45mm}\n"
    ".best th{font-weight:bold}\n"
    ".best th,.best td{background:#e6f0fa}\n"
    ".n,.w{white-space:nowrap}\n"
    ".n{text-align:right}\n"
    "thead .n{white-space:normal}\n"
    "figure{margin:2mm 0;break-inside:avoid}\n"
    ".half{display:inline-block;width:49%;vertical-align:top}\n"
    "figcaption{font-size:9pt;font-weight:bold;margin-bottom:1mm}\n"
    "svg{display:block;width:100%;height:auto}\n"
    "pre{font:6pt/1.15 monospace;white-space:pre-wrap;overflow-wrap:anywhere;margin:1mm 0;padding:2mm "
    "3mm;background:#f5f5f2;"
    "columns:2;column-gap:5mm}\n"
    "pre.line{columns:1;break-inside:avoid}\n"
    "section+section{break-before:page}\n"
    "@media screen{body{padding:0 6mm 10mm}}\n";

void ceduo_page_html_begin(struct ceduo_html *html, const char *title)
{
    ceduo_text_append(html->text, "<!DOCTYPE html>\n");
    /* Translators: the language code in HTML. */
    ceduo_html_open(html, "html", "lang", _("en"), NULL);
    ceduo_text_append_char(html->text, '\n');
    ceduo_html_open(html, "head", NULL);
    ceduo_html_empty(html, "meta", "charset", "utf-8", NULL);
    ceduo_html_empty(html, "meta", "name", "viewport", "content", "width=device-width, initial-scale=1", NULL);
    ceduo_html_leaf(html, "title", title, NULL);
    ceduo_text_append(html->text, "<style>\n");
    ceduo_text_append(html->text, style);
    ceduo_text_append(html->text, "</style>\n");
    ceduo_html_close(html);
    ceduo_html_open(html, "body", NULL);
    ceduo_html_open(html, "main", NULL);
    ceduo_text_append_char(html->text, '\n');
}

void ceduo_page_html_end(struct ceduo_html *html)
{
    while (html->depth > 0)
        ceduo_html_close(html);
}

/* ---- tables ---- */

#define CELL_WIDTH 60 /* characters; fits all digits */

/* Write a table; nothing if it has only heads. */
static void write_table(struct ceduo_html *html, const struct ceduo_page_block *table, const struct ceduo_page_block *caption)
{
    size_t n = table->columns_count;
    if (table->cells_count < 2 * n)
        return;
    ceduo_html_open(html, "table", NULL);
    if (caption)
        ceduo_html_leaf(html, "caption", ceduo_text_string(&caption->text), NULL);
    for (size_t row = 0; row + n <= table->cells_count; row += n) {
        if (row <= n)
            ceduo_html_open(html, row == 0 ? "thead" : "tbody", NULL);
        bool best = row > 0 && table->cells[row].role == CEDUO_ROLE_CURSOR;
        ceduo_html_open(html, "tr", "class", best ? "best" : NULL, NULL);
        for (size_t i = 0; i < n; i++) {
            LOCAL_TEXT(text);
            if (best && i == 0)
                ceduo_text_append(&text, "\xe2\x96\xb8 ");
            if (row == 0 && table->cells[i].long_text.length > 0)
                ceduo_page_powers(&text, table->cells[i].long_text.bytes);
            else
                ceduo_page_write_cell(&text, &table->cells[row + i], CELL_WIDTH, false);
            const char *name = (row == 0 || i == 0) && text.length > 0 ? "th" : "td";
            const char *scope = name[1] != 'h' ? NULL : row == 0 ? "col" : "row";
            /* numbers, and words of narrow columns, which do not wrap */
            const struct ceduo_page_column *column = &table->columns[i];
            bool word = row > 0 && i > 0 && column->width > 0 && !(column->flags & (COL_WRAP | COL_GROW));
            ceduo_html_leaf(html, name, ceduo_text_string(&text), "scope", scope, "class",
                            column->width < 0 ? "n"
                            : word            ? "w"
                                              : NULL,
                            NULL);
        }
        ceduo_html_close(html);
        if (row == 0)
            ceduo_html_close(html);
    }
    ceduo_html_close(html);
    ceduo_html_close(html);
}

/* ---- other blocks ---- */

/* Element and class of each kind; NULL: not written here. */
static const struct {
    const char *element, *class;
} elements[] = {
    [CEDUO_PAGE_TITLE] = {"h1", NULL},         [CEDUO_PAGE_SECTION] = {"h2", NULL}, [CEDUO_PAGE_PLACE] = {"h3", NULL},
    [CEDUO_PAGE_CAPTION] = {"p", "detail"},    [CEDUO_PAGE_SENTENCE] = {"p", NULL}, [CEDUO_PAGE_DETAIL] = {"p", "detail"},
    [CEDUO_PAGE_NOTE] = {"p", NULL},           [CEDUO_PAGE_ITEM] = {"li", NULL},    [CEDUO_PAGE_WARNING] = {"p", "warning"},
    [CEDUO_PAGE_QUESTION] = {"p", "question"}, [CEDUO_PAGE_ANSWER] = {"p", NULL},   [CEDUO_PAGE_CODE] = {"pre", NULL}};

static void write_block(struct ceduo_html *html, const struct ceduo_page_block *block)
{
    LOCAL_TEXT(shown);
    ceduo_page_powers(&shown, ceduo_text_string(&block->text));
    /* code stays verbatim, so that a reader can parse it */
    const char *text = ceduo_text_string(block->kind == CEDUO_PAGE_CODE ? &block->text : &shown);
    if (block->kind == CEDUO_PAGE_CODE) {
        const char *line = strchr(text, '\n');
        ceduo_html_leaf(html, "pre", text, "class", line && line[1] ? NULL : "line", NULL);
    } else if (block->kind == CEDUO_PAGE_FACT || block->kind == CEDUO_PAGE_POINT || block->kind == CEDUO_PAGE_HEAD) {
        LOCAL_TEXT(label);
        ceduo_text_append_n(&label, text, strcspn(text, "\t"));
        text += label.length + 1;
        ceduo_html_leaf(html, "dt", ceduo_text_string(&label), NULL);
        ceduo_html_leaf(html, "dd", text, "class", text[0] ? NULL : "line", NULL);
    } else if (block->kind != CEDUO_PAGE_GAP && text[0]) {
        ceduo_html_leaf(html, elements[block->kind].element, text, "class", elements[block->kind].class, NULL);
    }
}

void ceduo_page_html(struct ceduo_html *html, const struct ceduo_page *page, size_t number)
{
    /* element around consecutive blocks of a kind */
    static const struct {
        const char *element, *class;
    } lists[CEDUO_PAGE_HEAD + 1] = {[CEDUO_PAGE_ITEM] = {"ul", NULL},
                                    [CEDUO_PAGE_FACT] = {"dl", NULL},
                                    [CEDUO_PAGE_POINT] = {"dl", NULL},
                                    [CEDUO_PAGE_HEAD] = {"dl", "head"},
                                    [CEDUO_PAGE_ANSWER] = {"div", "answer"}};
    /* class of an answer; the borders differ, too, for prints in grey */
    static const char *const answers[CEDUO_ROLE_COUNT] = {
        [CEDUO_ROLE_GOOD] = "answer yes", [CEDUO_ROLE_BAD] = "answer no", [CEDUO_ROLE_WARN] = "answer depends"};
    size_t pictures = 0;
    ceduo_html_open(html, "section", NULL);
    ceduo_text_append_char(html->text, '\n');
    for (const struct ceduo_page_block *b = page->first, *last = NULL; b; last = b, b = b->next) {
        const char *list = lists[b->kind].element;
        bool follows = last && last->kind == b->kind, continues = b->next && b->next->kind == b->kind;
        if (list && !follows)
            ceduo_html_open(html, list, "class",
                            b->kind == CEDUO_PAGE_ANSWER && answers[b->role] ? answers[b->role] : lists[b->kind].class, NULL);
        /* consecutive tables are halves of one table */
        if (b->kind == CEDUO_PAGE_TABLE && !follows && continues)
            ceduo_html_open(html, "div", "class", "pair", NULL);
        if (b->kind == CEDUO_PAGE_TABLE)
            write_table(html, b, last && last->kind == CEDUO_PAGE_CAPTION ? last : NULL);
        else if (b->kind == CEDUO_PAGE_PICTURE) {
            char id[48];
            snprintf(id, sizeof id, "c%zu-p%zu", number, ++pictures);
            ceduo_html_open(html, "figure", "class", b->side_by_side ? "half" : NULL, NULL);
            ceduo_html_leaf(html, "figcaption", ceduo_text_string(&b->text), NULL);
            ceduo_svg_write(html, b->svg, id, ceduo_text_string(&b->text), ceduo_text_string(&b->description));
            ceduo_html_close(html);
        } else if (b->kind != CEDUO_PAGE_CAPTION || !b->next || b->next->kind != CEDUO_PAGE_TABLE)
            write_block(html, b);
        if ((list || (b->kind == CEDUO_PAGE_TABLE && follows)) && !continues)
            ceduo_html_close(html);
    }
    ceduo_html_close(html);
}
