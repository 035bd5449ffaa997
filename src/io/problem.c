/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "problem.h"

#include <string.h>

#include "intl.h"

#define LINE_MOST 100 /* columns of the source line that are shown */

/* Byte range of line number `line` (from 1). */
static bool find_line(const struct source *s, size_t line, size_t *from, size_t *to)
{
    size_t at = 0;
    for (size_t i = 1; i < line; i++) {
        const char *end = memchr(s->bytes + at, '\n', s->length - at);
        if (!end)
            return false;
        at = (size_t)(end - s->bytes) + 1;
    }
    const char *end = memchr(s->bytes + at, '\n', s->length - at);
    *from = at;
    *to = end ? (size_t)(end - s->bytes) : s->length;
    if (*to > *from && s->bytes[*to - 1] == '\r')
        --*to;
    return true;
}

/* Bytes of one character, even of one that is no UTF-8. */
static size_t step(const char *p, size_t n)
{
    uint32_t code;
    size_t length = ceduo_utf8_decode(p, n, &code);
    return length ? length : 1;
}

static void show_line(struct text *out, const struct source *s, size_t line, size_t column)
{
    size_t from, to;
    if (!s->bytes || !find_line(s, line, &from, &to) || to == from)
        return;
    size_t first = column > LINE_MOST ? column - LINE_MOST / 2 : 1;
    size_t at = from, c = 1;
    for (; c < first && at < to; c++)
        at += step(s->bytes + at, to - at);
    struct text caret = {0};
    ceduo_text_put(out, "  ");
    ceduo_text_put(&caret, "  ");
    for (; at < to && c < first + LINE_MOST; c++) {
        size_t before = out->length, n = step(s->bytes + at, to - at);
        if (s->bytes[at] == '\t')
            ceduo_text_char(out, ' ');
        else
            ceduo_text_safe_n(out, s->bytes + at, n);
        for (size_t w = c < column && out->bytes ? ceduo_text_columns(out->bytes + before) : 0; w > 0; w--)
            ceduo_text_char(&caret, ' ');
        at += n;
    }
    ceduo_text_char(out, '\n');
    ceduo_text_put(&caret, "^\n");
    if (caret.bytes)
        ceduo_text_put(out, caret.bytes);
    ceduo_text_free(&caret);
}

void ceduo_problem(struct problems *problems, const struct source *source, size_t line, size_t column,
                   const char *format, ...)
{
    problems->usage |= source && source->is_option;
    struct text message = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&message, format, args);
    va_end(args);
    struct text one = {0}, *out = &one;
    if (source) {
        ceduo_text_safe(out, source->name);
        if (line > 0)
            ceduo_text_format(out, ":%zu:%zu", line, column);
        ceduo_text_put(out, ": ");
    }
    if (message.bytes)
        ceduo_text_safe(out, message.bytes);
    ceduo_text_char(out, '\n');
    if (source && line > 0)
        show_line(out, source, line, column);
    /* a file that is used in two places has its faults once */
    bool known = one.bytes && problems->text.bytes && strstr(problems->text.bytes, one.bytes);
    if (!known && problems->count++ < CEDUO_PROBLEMS_MOST && one.bytes)
        ceduo_text_add(&problems->text, one.bytes, one.length);
    problems->memory |= message.failed || one.failed || problems->text.failed;
    ceduo_text_free(&one);
    ceduo_text_free(&message);
}

void ceduo_problem_memory(struct problems *problems)
{
    problems->memory = true;
}

void ceduo_problems_close(struct problems *problems)
{
    if (problems->count > CEDUO_PROBLEMS_MOST) {
        size_t rest = problems->count - CEDUO_PROBLEMS_MOST;
        ceduo_text_format(&problems->text, ngettext("%zu more problem\n", "%zu more problems\n", rest), rest);
        problems->count = CEDUO_PROBLEMS_MOST;
    }
    if (problems->memory)
        ceduo_text_put(&problems->text, _("out of memory\n"));
}

void ceduo_problems_free(struct problems *problems)
{
    ceduo_text_free(&problems->text);
    *problems = (struct problems){0};
}
