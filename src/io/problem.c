/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "problem.h"

#include <string.h>

#include "base/hash.h"
#include "base/language.h"
#include "base/must.h"
#include "base/utf8.h"

#define LINE_MAX    100  /* columns of the source line that are shown */
#define MESSAGE_MAX 1000 /* bytes: known keys take some hundred */
#define TAIL        200
#define COUNTED     1000

bool ceduo_source_next(const struct source *s, size_t *at, size_t *from, size_t *to)
{
    if (*at >= s->length)
        return false;
    const char *end = memchr(s->bytes + *at, '\n', s->length - *at);
    *from = *at;
    *to = end ? (size_t)(end - s->bytes) : s->length;
    *at = *to + 1;
    if (*to > *from && s->bytes[*to - 1] == '\r')
        --*to;
    return true;
}

/* Line number `line`, from 1; false where the source has fewer. */
static bool find_line(const struct source *s, size_t line, size_t *from, size_t *to)
{
    size_t at = 0, i = 0;
    while (i < line && ceduo_source_next(s, &at, from, to))
        i++;
    return i == line;
}

size_t ceduo_source_byte(const struct source *s, size_t line, size_t column)
{
    size_t at, end;
    if (!find_line(s, line, &at, &end))
        return s->length;
    at += line == 1 ? ceduo_source_mark(s) : 0;
    for (size_t c = 1; c < column && at < s->length; c++)
        do
            at++;
        while (at < s->length && ceduo_utf8_inside(s->bytes[at]));
    return at;
}

/* A part of the line, and a caret below the column where that is in it; of a foreign source only what begins it. */
static void print_line(struct text *out, const struct source *s, size_t line, size_t column)
{
    size_t from, to, max = s->foreign ? CEDUO_FOREIGN_MAX : LINE_MAX;
    if (!find_line(s, line, &from, &to) || to == from)
        return;
    size_t first = column > max && !s->foreign ? column - max / 2 : 1;
    max = s->foreign && line > 1 ? 0 : max;
    size_t mark = from == 0 ? ceduo_source_mark(s) : 0;
    size_t at = from + mark, c = 1;
    for (; c < first && at < to; c++)
        at += ceduo_utf8_step(s->bytes + at);
    LOCAL_TEXT(caret);
    ceduo_text_append(out, "  ");
    ceduo_text_append_escaped_n(out, s->bytes, first == 1 ? mark : 0);
    ceduo_text_append(&caret, "  ");
    for (; at < to && c < first + max; c++) {
        size_t before = out->length, n = ceduo_utf8_step(s->bytes + at);
        if (s->bytes[at] == '\t')
            ceduo_text_char(out, ' ');
        else
            ceduo_text_append_escaped_n(out, s->bytes + at, n);
        for (size_t w = c < column && out->bytes ? ceduo_utf8_width(out->bytes + before) : 0; w > 0; w--)
            ceduo_text_char(&caret, ' ');
        at += n;
    }
    if (s->foreign && at < to)
        ceduo_text_format(out, "\xe2\x80\xa6 %s", _("(nothing says that this file is one of ceduo's: no more of it is shown)"));
    ceduo_text_char(out, '\n');
    ceduo_text_append(&caret, "^\n");
    if (!s->foreign || (line == 1 && column <= c))
        ceduo_text_append(out, ceduo_text_string(&caret));
}

/* The words of a format, which has no %%, with dots in place of the values. */
static void print_words(struct text *out, const char *format)
{
    for (; *format; format++) {
        ceduo_text_append(out, *format == '%' ? "\xe2\x80\xa6" : (char[2]){*format});
        format += *format == '%' ? strcspn(format, "cdefgsuxX") : 0;
    }
}

/* A message may quote a word of a megabyte: its middle is left out, so that the mend at its end stays. */
static void print_message(struct text *out, const char *message)
{
    size_t n = strlen(message), head = MESSAGE_MAX - TAIL, tail = n - TAIL;
    if (n <= MESSAGE_MAX) {
        ceduo_text_append_escaped_n(out, message, n);
        return;
    }
    while (head > 0 && ceduo_utf8_inside(message[head]))
        head--;
    while (ceduo_utf8_inside(message[tail]))
        tail++;
    ceduo_text_append_escaped_n(out, message, head);
    ceduo_text_append(out, "\xe2\x80\xa6");
    ceduo_text_append_escaped_n(out, message + tail, n - tail);
}

/* The same for all items of a list and whatever numbers the words hold. */
static uint64_t kind_of(const struct source *source, const char *path, const char *words)
{
    uint64_t hash = source ? hash_bytes(source->name, strlen(source->name)) : HASH_START;
    for (const char *p = path; *p; p++) {
        bool inside = *p == '[';
        hash_count(&hash, (unsigned char)*p);
        while (inside && p[1] && p[1] != ']') /* one that is never closed may stand in the key of a foreign file */
            p++;
    }
    for (const char *p = words; *p; p++)
        if (*p < '0' || *p > '9')
            hash_count(&hash, (unsigned char)*p);
    return hash;
}

/* Adds a message, once. Beyond a number, whether it is known matters no more: a million of them take no time. */
void ceduo_problem_v(struct problems *problems, struct problem_place place, const char *format, va_list args)
{
    const struct source *source = place.source;
    const char *path = place.path ? place.path : "";
    LOCAL_TEXT(message);
    LOCAL_TEXT(whole);
    LOCAL_TEXT(one);
    size_t k = 0;
    problems->usage |= source && source->is_option;
    problems->cell |= source && source->is_cell;
    problems->met++;
    if (problems->count >= COUNTED) {
        problems->count++;
        return;
    }
    if (source && source->foreign && !place.own)
        print_words(&message, format);
    else
        ceduo_text_vformat(&message, format, args);
    ceduo_text_format(&whole, "%s%s%s", path, path[0] ? ": " : "", ceduo_text_string(&message));
    if (source) {
        ceduo_text_append_escaped(&one, source->name);
        if (place.line > 0 && !source->is_cell)
            ceduo_text_format(&one, ":%zu:%zu", place.line, place.column);
        ceduo_text_append(&one, ": ");
    }
    print_message(&one, ceduo_text_string(&whole));
    ceduo_text_char(&one, '\n');
    uint64_t hash = kind_of(source, path, ceduo_text_string(&message));
    uint64_t place_and_words =
        hash_bytes(ceduo_text_string(&one), one.length); /* a file used in two places has its faults once */
    bool known = false;
    for (size_t i = 0; i + sizeof hash <= problems->known.length && !known; i += sizeof hash)
        known = memcmp(problems->known.bytes + i, &place_and_words, sizeof hash) == 0;
    if (!known)
        ceduo_text_add(&problems->known, (const char *)&place_and_words, sizeof hash);
    while (k < problems->kinds_count && problems->kinds[k].hash != hash)
        k++;
    struct problem_kind *kind = &problems->kinds[k];
    problems->count += !known;
    if (!known && k < problems->kinds_count) {
        if (kind->more < CEDUO_PROBLEMS_LINES)
            kind->lines[kind->more] = place.line;
        kind->more++;
    } else if (!known && k < CEDUO_PROBLEMS_MAX) { /* of a million only these look for their line */
        if (source && place.line > 0)
            print_line(&one, source, place.line, place.column);
        ceduo_text_append(&problems->text, ceduo_text_string(&one));
        *kind = (struct problem_kind){.hash = hash, .end = problems->text.length};
        problems->kinds_count++;
    }
}

bool ceduo_problem_at(struct problems *problems, struct problem_place place, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(problems, place, format, args);
    va_end(args);
    return false;
}

bool ceduo_problem(struct problems *problems, const struct source *source, size_t line, size_t column, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(problems, (struct problem_place){.source = source, .line = line, .column = column}, format, args);
    va_end(args);
    return false;
}

void ceduo_problems_prepend(struct problems *problems, struct problems *head)
{
    for (size_t k = 0; k < problems->kinds_count; k++)
        problems->kinds[k].end += head->text.length;
    ceduo_text_add(&head->text, ceduo_text_string(&problems->text), problems->text.length);
    ceduo_text_free(&problems->text);
    if (head->text.failed) /* what is cut short has no kinds */
        problems->kinds_count = 0;
    problems->text = head->text;
    head->text = (struct text){0};
    ceduo_problems_free(head);
}

bool ceduo_problems_check_memory(struct problems *problems)
{
    problems->memory |= ceduo_memory_failed();
    return !problems->memory;
}

void ceduo_problems_finish(struct problems *problems)
{
    struct text all = {0};
    size_t from = 0, rest = problems->kinds_count > 0 ? problems->count : 0;
    for (size_t k = 0; k < problems->kinds_count; k++) {
        const struct problem_kind *kind = &problems->kinds[k];
        rest -= 1 + kind->more;
        ceduo_text_add(&all, problems->text.bytes + from, kind->end - from);
        if (kind->more > 0) { /* how many others there are, and where */
            ceduo_text_append(&all, "  ");
            ceduo_text_format(&all, ngettext("and %zu more of this kind", "and %zu more of this kind", kind->more), kind->more);
            for (size_t i = 0; i < kind->more && i < CEDUO_PROBLEMS_LINES; i++)
                if (kind->lines[i] > 0 && (i == 0 || kind->lines[i] != kind->lines[i - 1]))
                    ceduo_text_format(&all, i == 0 ? _(", on line %zu") : ", %zu", kind->lines[i]);
            ceduo_text_append(&all, kind->more > CEDUO_PROBLEMS_LINES && kind->lines[0] > 0 ? " \xe2\x80\xa6\n" : "\n");
        }
        from = kind->end;
    }
    if (problems->kinds_count > 0) { /* it is not closed yet */
        ceduo_text_free(&problems->text);
        problems->text = all;
    }
    if (rest > 0)
        ceduo_text_format(&problems->text, ngettext("%zu more problem\n", "%zu more problems\n", rest), rest);
    problems->kinds_count = 0;
    problems->count = problems->count > 0;
    if (problems->count == 0)
        ceduo_text_append(&problems->text, ceduo_text_string(&problems->warnings));
    ceduo_text_free(&problems->warnings);
    if (!ceduo_problems_check_memory(problems))
        ceduo_text_format(&problems->text, "%s\n", _("out of memory"));
}

void ceduo_problems_free(struct problems *problems)
{
    ceduo_text_free(&problems->text);
    ceduo_text_free(&problems->known);
    ceduo_text_free(&problems->warnings);
    *problems = (struct problems){0};
}
