/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PAGE_HTML_H
#define CEDUO_PAGE_HTML_H

#include "html.h"
#include "page.h"

/* Pages as one HTML file: no script, no network, no fonts of its own; printed on A4. */

/* All up to the first chapter; what is open is closed by the end. */
void ceduo_page_html_begin(struct ceduo_html *html, const char *title);
void ceduo_page_html_end(struct ceduo_html *html);

/* A page as a chapter. `number`, from 1, makes what it is called within the file unique. */
void ceduo_page_html(struct ceduo_html *html, const struct ceduo_page *page, size_t number);

#endif
