/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "problem.h"

#include <string.h>

#include "base/hash.h"
#include "base/language.h"
#include "base/utf8.h"

#define LINE_MOST    100  /* columns of the source line that are shown */
#define MESSAGE_MOST 1000 /* bytes: known keys take some hundred */
#define TAIL         200
#define COUNTED      1000

bool ceduo_source_line(const struct source *s, size_t line, size_t *from, size_t *to)
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
static size_t character_length(const char *p, size_t n)
{
    uint32_t code;
    size_t length = ceduo_utf8_decode(p, n, &code);
    return length ? length : 1;
}

/* A part of the line, and a caret below the column where that is in it; of a foreign source only what begins it. */
static void show_line(struct text *out, const struct source *s, size_t line, size_t column)
{
    size_t from, to, most = s->foreign ? CEDUO_FOREIGN_MOST : LINE_MOST;
    if (!ceduo_source_line(s, line, &from, &to) || to == from)
        return;
    size_t first = column > most && !s->foreign ? column - most / 2 : 1;
    most = s->foreign && line > 1 ? 0 : most;
    size_t mark = from == 0 ? ceduo_source_mark(s) : 0;
    size_t at = from + mark, c = 1;
    for (; c < first && at < to; c++)
        at += character_length(s->bytes + at, to - at);
    struct text caret = {0};
    ceduo_text_put(out, "  ");
    ceduo_text_safe_n(out, s->bytes, first == 1 ? mark : 0);
    ceduo_text_put(&caret, "  ");
    for (; at < to && c < first + most; c++) {
        size_t before = out->length, n = character_length(s->bytes + at, to - at);
        if (s->bytes[at] == '\t')
            ceduo_text_char(out, ' ');
        else
            ceduo_text_safe_n(out, s->bytes + at, n);
        for (size_t w = c < column && out->bytes ? ceduo_utf8_width(out->bytes + before) : 0; w > 0; w--)
            ceduo_text_char(&caret, ' ');
        at += n;
    }
    if (s->foreign && at < to)
        ceduo_text_format(out, "\xe2\x80\xa6 %s", _("(nothing says that this file is one of ceduo's: no more of it is shown)"));
    ceduo_text_char(out, '\n');
    ceduo_text_put(&caret, "^\n");
    if (!s->foreign || (line == 1 && column <= c))
        ceduo_text_put(out, ceduo_text_string(&caret));
    ceduo_text_free(&caret);
}

void ceduo_problem_words(struct text *out, const char *format)
{
    for (; *format; format++) {
        ceduo_text_put(out, *format == '%' ? "\xe2\x80\xa6" : (char[2]){*format});
        format += *format == '%' ? strcspn(format, "cdefgsuxX") : 0;
    }
}

/* A message may quote a word of a megabyte: its middle is left out, so that the mend at its end stays. */
static void put_message(struct text *out, const char *message)
{
    size_t n = strlen(message), head = MESSAGE_MOST - TAIL, tail = n - TAIL;
    if (n <= MESSAGE_MOST) {
        ceduo_text_safe_n(out, message, n);
        return;
    }
    while (head > 0 && ceduo_utf8_inside(message[head]))
        head--;
    while (ceduo_utf8_inside(message[tail]))
        tail++;
    ceduo_text_safe_n(out, message, head);
    ceduo_text_put(out, "\xe2\x80\xa6");
    ceduo_text_safe_n(out, message + tail, n - tail);
}

/* By place and message. A file that is used in two places has its faults once. */
static bool is_known(const struct problems *problems, uint64_t hash)
{
    for (size_t i = 0; i < problems->count && i < CEDUO_PROBLEMS_MOST; i++)
        if (problems->shown[i] == hash)
            return true;
    return false;
}

static void add(struct problems *problems, struct problem_place place, const struct text *message)
{
    const struct source *source = place.source;
    size_t line = place.line, column = place.column;
    struct text one = {0};
    if (source) {
        ceduo_text_safe(&one, source->name);
        if (line > 0)
            ceduo_text_format(&one, ":%zu:%zu", line, column);
        ceduo_text_put(&one, ": ");
    }
    put_message(&one, ceduo_text_string(message));
    ceduo_text_char(&one, '\n');
    uint64_t hash = hash_bytes(ceduo_text_string(&one), one.length);
    if (!is_known(problems, hash)) {
        if (problems->count < CEDUO_PROBLEMS_MOST) { /* of a million only these look for their line */
            if (source && line > 0)
                show_line(&one, source, line, column);
            problems->shown[problems->count] = hash;
            ceduo_text_put(&problems->text, ceduo_text_string(&one));
        }
        problems->count++;
    }
    problems->memory |= message->failed || one.failed || problems->text.failed;
    ceduo_text_free(&one);
}

/* Whether it is to be told in words. Beyond a number, whether it is known matters no more: a million of them take no time. */
static bool counts(struct problems *problems, const struct source *source)
{
    bool words = problems->count < COUNTED;
    problems->usage |= source && source->is_option;
    problems->met++;
    problems->count += !words;
    return words;
}

static void put_path(struct text *out, const char *path)
{
    if (path && path[0])
        ceduo_text_format(out, "%s: ", path);
}

void ceduo_problem_v(struct problems *problems, struct problem_place place, const char *format, va_list args)
{
    struct text message = {0};
    if (!counts(problems, place.source))
        return;
    if (place.source && place.source->foreign) {
        ceduo_problem_words(&message, format);
    } else {
        put_path(&message, place.path);
        ceduo_text_vformat(&message, format, args);
    }
    add(problems, place, &message);
    ceduo_text_free(&message);
}

void ceduo_problem(struct problems *problems, const struct source *source, size_t line, size_t column, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(problems, (struct problem_place){source, line, column, NULL}, format, args);
    va_end(args);
}

void ceduo_problem_own(struct problems *problems, struct problem_place place, const char *format, ...)
{
    struct text message = {0};
    va_list args;
    if (!counts(problems, place.source))
        return;
    put_path(&message, place.path);
    va_start(args, format);
    ceduo_text_vformat(&message, format, args);
    va_end(args);
    add(problems, place, &message);
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
