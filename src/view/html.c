/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "html.h"

#include <assert.h>
#include <string.h>

/* Line ends and tabs stay; other control characters are written as \xHH. */
static void put_escaped(struct text *to, const char *string)
{
    static const char signs[] = "&<>\"'", *const names[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    for (size_t n; *string; string += n + (string[n] != '\0')) {
        n = strcspn(string, "&<>\"'\n\t");
        ceduo_text_safe_n(to, string, n);
        const char *sign = string[n] ? strchr(signs, string[n]) : NULL;
        if (sign)
            ceduo_text_put(to, names[sign - signs]);
        else if (string[n])
            ceduo_text_char(to, string[n]);
    }
}

static void begin(struct ceduo_html *html, const char *name, va_list args)
{
    ceduo_text_format(html->text, "<%s", name);
    for (const char *key; (key = va_arg(args, const char *)) != NULL;) {
        const char *value = va_arg(args, const char *);
        if (!value)
            continue;
        ceduo_text_format(html->text, " %s=\"", key);
        put_escaped(html->text, value);
        ceduo_text_char(html->text, '"');
    }
}

void ceduo_html_open(struct ceduo_html *html, const char *name, ...)
{
    va_list args;
    assert(html->depth < CEDUO_HTML_DEEPEST);
    html->open[html->depth++] = name;
    va_start(args, name);
    begin(html, name, args);
    va_end(args);
    ceduo_text_char(html->text, '>');
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
    begin(html, name, args);
    va_end(args);
    ceduo_text_put(html->text, "/>\n");
}

void ceduo_html_leaf(struct ceduo_html *html, const char *name, const char *text, ...)
{
    va_list args;
    va_start(args, text);
    begin(html, name, args);
    va_end(args);
    ceduo_text_char(html->text, '>');
    put_escaped(html->text, text);
    ceduo_text_format(html->text, "</%s>\n", name);
}
