/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "problem.h"

#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"

#define LINE_MAX    100  /* columns shown of a source line */
#define MESSAGE_MAX 1000 /* bytes; a list of keys takes some hundred */
#define TAIL        200
#define COUNTED     1000

bool ceduo_source_next(const struct source *s, size_t *position, size_t *from, size_t *to)
{
    if (*position >= s->length)
        return false;
    const char *end = memchr(s->bytes + *position, '\n', s->length - *position);
    *from = *position;
    *to = end ? (size_t)(end - s->bytes) : s->length;
    *position = *to + 1;
    if (*to > *from && s->bytes[*to - 1] == '\r')
        --*to;
    return true;
}

/* Find line `line`, from 1. Return false if the source has fewer lines. */
static bool find_line(const struct source *s, size_t line, size_t *from, size_t *to)
{
    size_t position = 0, i = 0;
    while (i < line && ceduo_source_next(s, &position, from, to))
        i++;
    return i == line;
}

size_t ceduo_source_byte(const struct source *s, size_t line, size_t column)
{
    size_t position, end;
    if (!find_line(s, line, &position, &end))
        return s->length;
    position += line == 1 ? ceduo_source_mark(s) : 0;
    for (size_t c = 1; c < column && position < s->length; c++)
        do
            position++;
        while (position < s->length && ceduo_utf8_is_continuation(s->bytes[position]));
    return position;
}

/* Print a part of the line, with a caret below the column if it is within. Print only the start of a foreign line. */
static void print_line(struct text *out, const struct source *s, size_t line, size_t column)
{
    size_t from, to, max = s->foreign ? CEDUO_FOREIGN_MAX : LINE_MAX;
    if (!find_line(s, line, &from, &to) || to == from)
        return;
    size_t first = column > max && !s->foreign ? column - max / 2 : 1;
    max = s->foreign && line > 1 ? 0 : max;
    size_t mark = from == 0 ? ceduo_source_mark(s) : 0;
    size_t position = from + mark, c = 1;
    for (; c < first && position < to; c++)
        position += ceduo_utf8_step(s->bytes + position);
    LOCAL_TEXT(caret);
    ceduo_text_append(out, "  ");
    ceduo_text_append_escaped_n(out, s->bytes, first == 1 ? mark : 0);
    ceduo_text_append(&caret, "  ");
    for (; position < to && c < first + max; c++) {
        size_t before = out->length, n = ceduo_utf8_step(s->bytes + position);
        if (s->bytes[position] == '\t')
            ceduo_text_append_char(out, ' ');
        else
            ceduo_text_append_escaped_n(out, s->bytes + position, n);
        for (size_t w = c < column && out->bytes ? ceduo_utf8_width(out->bytes + before) : 0; w > 0; w--)
            ceduo_text_append_char(&caret, ' ');
        position += n;
    }
    if (s->foreign && position < to)
        ceduo_text_format(out, "\xe2\x80\xa6 %s", _("(nothing says that this file is one of ceduo's: no more of it is shown)"));
    ceduo_text_append_char(out, '\n');
    ceduo_text_append(&caret, "^\n");
    if (!s->foreign || (line == 1 && column <= c))
        ceduo_text_append(out, ceduo_text_string(&caret));
}

/* Print the words of a format (without %%), with dots for the values. */
static void print_words(struct text *out, const char *format)
{
    for (; *format; format++) {
        ceduo_text_append(out, *format == '%' ? "\xe2\x80\xa6" : (char[2]){*format});
        format += *format == '%' ? strcspn(format, "cdefgsuxX") : 0;
    }
}

/* Print a message. Cut a very long quotation in the middle, so that the remedy at the end stays. */
static void print_cut(struct text *out, const char *string)
{
    size_t n = strlen(string), head = MESSAGE_MAX - TAIL, tail = n - TAIL;
    if (n <= MESSAGE_MAX) {
        ceduo_text_append_escaped_n(out, string, n);
        return;
    }
    while (head > 0 && ceduo_utf8_is_continuation(string[head]))
        head--;
    while (ceduo_utf8_is_continuation(string[tail]))
        tail++;
    ceduo_text_append_escaped_n(out, string, head);
    ceduo_text_append(out, "\xe2\x80\xa6");
    ceduo_text_append_escaped_n(out, string + tail, n - tail);
}

/* Hash the kind of a problem. Indices of items and numbers in the words do not count. */
static uint64_t hash_kind(const struct source *source, const char *path, const char *words)
{
    uint64_t hash = source ? hash_bytes(source->name, strlen(source->name)) : HASH_START;
    for (const char *p = path; *p; p++) {
        bool inside = *p == '[';
        hash_count(&hash, (unsigned char)*p);
        while (inside && p[1] && p[1] != ']') /* the key of a foreign file may have no closing bracket */
            p++;
    }
    for (const char *p = words; *p; p++)
        if (*p < '0' || *p > '9')
            hash_count(&hash, (unsigned char)*p);
    return hash;
}

void ceduo_problem_line(const struct problem *p, struct text *text)
{
    ceduo_text_format(text, "%s%s%s%s%s", p->place, p->place[0] ? ": " : "", p->path, p->path[0] ? ": " : "", p->message);
}

/* Record a message. Return false if it was recorded before: a file used twice reports its errors once. */
static bool is_new(struct problems *problems, const struct problem *p)
{
    LOCAL_TEXT(line);
    ceduo_problem_line(p, &line);
    const uint64_t hash = hash_bytes(ceduo_text_string(&line), line.length);
    for (size_t i = 0; i + sizeof hash <= problems->known.length; i += sizeof hash)
        if (memcmp(problems->known.bytes + i, &hash, sizeof hash) == 0)
            return false;
    ceduo_text_append_n(&problems->known, (const char *)&hash, sizeof hash);
    return true;
}

/* Add a message once. After COUNTED messages duplicates are no longer searched, so that a million messages are fast. */
void ceduo_problem_v(struct problems *problems, struct problem_place place, const char *format, va_list args)
{
    const struct source *source = place.source;
    struct problem_list *list = place.unusual ? &problems->unusual : &problems->wrong;
    LOCAL_TEXT(words);
    LOCAL_TEXT(location);
    LOCAL_TEXT(path);
    LOCAL_TEXT(message);
    LOCAL_TEXT(hint);
    size_t k = 0;
    problems->usage |= source && source->is_option && !place.unusual;
    problems->cell |= source && source->is_cell && !place.unusual;
    problems->met += !place.unusual;
    if (list->count >= COUNTED) {
        list->count++;
        return;
    }
    if (source && source->foreign && !place.own)
        print_words(&words, format);
    else
        ceduo_text_vformat(&words, format, args);
    print_cut(&message, ceduo_text_string(&words));
    print_cut(&path, place.path ? place.path : "");
    if (source)
        ceduo_text_append_escaped(&location, source->name);
    if (source && place.line > 0 && !source->is_cell)
        ceduo_text_format(&location, ":%zu:%zu", place.line, place.column);
    struct problem p = {.place = ceduo_text_string(&location),
                        .path = ceduo_text_string(&path),
                        .message = ceduo_text_string(&message),
                        .kind = hash_kind(source, place.path ? place.path : "", ceduo_text_string(&words))};
    if (!is_new(problems, &p))
        return;
    list->count++;
    while (k < list->n && list->items[k].kind != p.kind)
        k++;
    struct problem *known = &list->items[k];
    if (k < list->n) {
        if (known->more < CEDUO_PROBLEMS_LINES)
            known->lines[known->more] = place.line;
        known->more++;
    } else if (k < CEDUO_PROBLEMS_MAX || place.first) { /* only listed problems search their line */
        if (source && place.line > 0 && !problems->brief)
            print_line(&hint, source, place.line, place.column);
        const char **const strings[] = {&p.place, &p.path, &p.message, &p.hint};
        p.hint = ceduo_text_string(&hint);
        for (size_t i = 0; i < 4; i++)
            if (!(*strings[i] = ceduo_arena_string(&problems->arena, *strings[i])))
                return;
        k = place.first ? 0 : k;
        memmove(list->items + k + 1, list->items + k, (list->n++ - k) * sizeof p);
        list->items[k] = p;
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

bool ceduo_problems_check_memory(struct problems *problems)
{
    problems->memory |= ceduo_memory_failed();
    return !problems->memory;
}

static void print_list(struct text *out, const struct problem_list *list)
{
    size_t rest = list->count;
    for (const struct problem *p = list->items; p < list->items + list->n; p++) {
        rest -= 1 + p->more;
        ceduo_problem_line(p, out);
        ceduo_text_format(out, "\n%s", p->hint);
        if (p->more == 0)
            continue;
        ceduo_text_append(out, "  ");
        ceduo_text_format(out, ngettext("and %zu more of this kind", "and %zu more of this kind", p->more), p->more);
        for (size_t i = 0; i < p->more && i < CEDUO_PROBLEMS_LINES; i++)
            if (p->lines[i] > 0 && (i == 0 || p->lines[i] != p->lines[i - 1]))
                ceduo_text_format(out, i == 0 ? _(", on line %zu") : ", %zu", p->lines[i]);
        ceduo_text_append(out, p->more > CEDUO_PROBLEMS_LINES && p->lines[0] > 0 ? " \xe2\x80\xa6\n" : "\n");
    }
    if (rest > 0)
        ceduo_text_format(out, ngettext("%zu more problem\n", "%zu more problems\n", rest), rest);
}

const char *ceduo_problems_print(struct problems *problems)
{
    ceduo_text_free(&problems->text);
    print_list(&problems->text, problems->wrong.count > 0 ? &problems->wrong : &problems->unusual);
    if (!ceduo_problems_check_memory(problems))
        ceduo_text_format(&problems->text, "%s\n", _("out of memory"));
    return ceduo_text_string(&problems->text);
}

void ceduo_problems_free(struct problems *problems)
{
    ceduo_arena_free(&problems->arena);
    ceduo_text_free(&problems->known);
    ceduo_text_free(&problems->text);
    *problems = (struct problems){0};
}
