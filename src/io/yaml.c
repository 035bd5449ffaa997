/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the events of libyaml into nodes, by recursion. Refuses aliases, tags and deep nesting, which no scene needs. Stops at
 * the first problem. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "base/language.h"
#include "base/oom.h"
#include "base/utf8.h"
#include "node.h"

#define DEPTH_MAX  16
#define KEYS_MAX   64     /* of one mapping; several times the largest number in use */
#define VALUES_MAX 250000 /* of one file: 80000 vertices. Each value needs some 160 bytes. */
#define TEXT_MAX   65536  /* bytes of one value */

/* An escape of two halves that was joined. From this column of its line on, as libyaml counts, columns in the file are larger
 * by JOINED_SHORTER. */
struct joined {
    size_t line, column;
};
#define JOINED_SHORTER 2 /* \ud83d\ude00 becomes \U0001f600 */

struct reader {
    struct arena *arena;
    const struct source *source;
    struct problems *problems;
    yaml_parser_t parser;
    const char *bytes; /* input of libyaml: the source after `skip` bytes, halves joined */
    size_t length;
    size_t skip, skip_column; /* bytes before the input of libyaml; their characters in its first line */
    struct joined *joined;    /* sorted by position */
    size_t joined_count, joined_capacity;
    size_t values;
    bool stopped;
};

static size_t find_line(yaml_mark_t mark)
{
    return mark.line + 1;
}

static size_t find_column(const struct reader *r, yaml_mark_t mark)
{
    size_t column = mark.column + 1 + (mark.line == 0 ? r->skip_column : 0), lo = 0, hi = r->joined_count;
    while (lo < hi) { /* find the first of the line */
        size_t mid = (lo + hi) / 2;
        if (r->joined[mid].line < mark.line)
            lo = mid + 1;
        else
            hi = mid;
    }
    for (; lo < r->joined_count && r->joined[lo].line == mark.line && r->joined[lo].column <= mark.column; lo++)
        column += JOINED_SHORTER;
    return column;
}

static void *stop(struct reader *r)
{
    r->stopped = true;
    return NULL;
}

/* Report an error and stop; NULL. The message quotes nothing from the file. */
#define STOP(r, mark, ...)                                                                                                     \
    (ceduo_problem_at(                                                                                                         \
         (r)->problems,                                                                                                        \
         (struct problem_place){.source = (r)->source, .line = find_line(mark), .column = find_column(r, mark), .own = true},  \
         __VA_ARGS__),                                                                                                         \
     stop(r))

/* Find the place of byte `offset`. libyaml gives no mark for invalid UTF-8. */
static yaml_mark_t find_mark(const char *bytes, size_t offset)
{
    yaml_mark_t mark = {offset, 0, 0};
    for (size_t i = 0; i < offset; i++) {
        if (bytes[i] == '\n') {
            mark.line++;
            mark.column = 0;
        } else if (!ceduo_utf8_is_continuation(bytes[i])) {
            mark.column++;
        }
    }
    return mark;
}

static void *report_syntax(struct reader *r)
{
    const yaml_parser_t *p = &r->parser;
    const char *bytes = r->bytes, *message = p->problem;
    size_t length = r->length, from = 0, n;
    if (p->error == YAML_MEMORY_ERROR) {
        ceduo_oom_set_flag();
        return stop(r);
    }
    if (p->error == YAML_READER_ERROR) {
        uint32_t code;
        while (from < p->problem_offset && (n = ceduo_utf8_decode(bytes + from, length - from, &code)) > 0)
            from += n; /* libyaml may name a byte within the character */
        yaml_mark_t place = find_mark(bytes, from);
        if (p->problem_value >= 0 && strstr(message, "control"))
            return STOP(r, place, _("a control character (\\x%02x); remove it"), (unsigned)p->problem_value);
        return STOP(r, place, _("not UTF-8; save the file as UTF-8"));
    }
    /* untaken: table */
    while (length > 0 && (bytes[length - 1] == '\n' || bytes[length - 1] == '\r' || bytes[length - 1] == ' '))
        length--;
    yaml_mark_t place = p->problem_mark, end = find_mark(bytes, length); /* end: of the last line that is not blank */
    place = place.line > end.line ? end : place;
    size_t byte = ceduo_source_byte(r->source, find_line(place), find_column(r, place));
    if (strstr(message, "tab") || (byte < r->source->length && r->source->bytes[byte] == '\t'))
        return STOP(r, place, _("a tab; indent with spaces"));
    if (strstr(message, "cannot start any token"))
        return STOP(r, place, _("malformed YAML: no value can start with this character; put the text in quotes"));
    if (strstr(message, "mapping values are not allowed"))
        return STOP(r, place,
                    _("malformed YAML: no key can stand here; put a text with ': ' in quotes, or indent the line equally"));
    if (p->context)
        return STOP(r, place, _("malformed YAML: %s %s; check brackets, quotes and indentation"), message, p->context);
    return STOP(r, place, _("malformed YAML: %s"), message);
}

static bool next_event(struct reader *r, yaml_event_t *event)
{
    return yaml_parser_parse(&r->parser, event) || report_syntax(r); /* untaken: complaint */
}

static struct node *new_node(struct reader *r, enum node_kind kind, yaml_mark_t mark)
{
    struct node *node = ceduo_arena_alloc(r->arena, sizeof *node);
    if (!node)
        return stop(r);
    *node = (struct node){
        .kind = kind, .source = r->source, .line = (uint32_t)find_line(mark), .column = (uint32_t)find_column(r, mark)};
    return node;
}

/* Record the end of a value, so that it can be replaced in the file. */
static void note_end(const struct reader *r, struct node *node, const yaml_event_t *event)
{
    node->end_line = (uint32_t)find_line(event->end_mark);
    node->end_column = (uint32_t)find_column(r, event->end_mark);
}

static struct node *read_scalar(struct reader *r, const yaml_event_t *event)
{
    struct node *node = new_node(r, NODE_SCALAR, event->start_mark);
    if (!node)
        return NULL;
    const char *value = (const char *)event->data.scalar.value;
    size_t length = event->data.scalar.length;
    if (memchr(value, '\0', length))
        return STOP(r, event->start_mark, _("a control character (\\x%02x); remove it"), 0u);
    if (length > TEXT_MAX)
        return STOP(r, event->start_mark, _("a value of more than %d bytes; look for a missing quote"), TEXT_MAX);
    note_end(r, node, event);
    node->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
    node->text = ceduo_arena_copy(r->arena, value, length);
    return node->text ? node : stop(r);
}

static struct node *read_value(struct reader *r, const yaml_event_t *event, int depth);

/* Read one entry of a mapping. `event`: its key; `map`: the entries before it. */
static struct node *read_entry(struct reader *r, const yaml_event_t *event, const struct node *map, int depth)
{
    const char *key = (const char *)event->data.scalar.value;
    yaml_event_t value;
    if (event->type != YAML_SCALAR_EVENT || strlen(key) != event->data.scalar.length)
        return STOP(r, event->start_mark, _("a key must be a plain word"));
    if (map->n >= KEYS_MAX)
        return STOP(r, event->start_mark, _("more than %d keys in one mapping"), KEYS_MAX);
    for (size_t i = 0; i < map->n; i++)
        if (strcmp(map->items[i]->key, key) == 0) {
            ceduo_problem(r->problems, r->source, find_line(event->start_mark), find_column(r, event->start_mark),
                          _("%s: given twice, first on line %u; keep one"), key, (unsigned)map->items[i]->key_line);
            return stop(r);
        }
    if (!next_event(r, &value))
        return NULL;
    struct node *node = read_value(r, &value, depth);
    yaml_event_delete(&value);
    if (!node)
        return NULL;
    node->key = ceduo_arena_string(r->arena, key);
    node->key_line = (uint32_t)find_line(event->start_mark);
    node->key_column = (uint32_t)find_column(r, event->start_mark);
    return node->key ? node : stop(r);
}

/* Read a mapping or list. */
static struct node *read_entries(struct reader *r, const yaml_event_t *start, int depth)
{
    bool list = start->type == YAML_SEQUENCE_START_EVENT;
    yaml_event_type_t last = list ? YAML_SEQUENCE_END_EVENT : YAML_MAPPING_END_EVENT;
    struct node *node = new_node(r, list ? NODE_LIST : NODE_MAP, start->start_mark);
    size_t capacity = 0;
    const struct node **items = NULL;
    if (!node)
        return NULL;
    node->flow = list ? start->data.sequence_start.style == YAML_FLOW_SEQUENCE_STYLE
                      : start->data.mapping_start.style == YAML_FLOW_MAPPING_STYLE;
    for (bool end = false; !end && !r->stopped;) {
        yaml_event_t event;
        if (!next_event(r, &event))
            break;
        end = event.type == last;
        if (end)
            note_end(r, node, &event);
        const struct node *item = end ? NULL : list ? read_value(r, &event, depth) : read_entry(r, &event, node, depth);
        yaml_event_delete(&event);
        if (!item)
            continue;
        node->items = items = ceduo_arena_grow(r->arena, items, node->n, 1, &capacity, sizeof *items);
        if (!items)
            return stop(r);
        items[node->n++] = item;
    }
    return r->stopped ? NULL : node;
}

static struct node *read_value(struct reader *r, const yaml_event_t *event, int depth)
{
    if (depth >= DEPTH_MAX)
        return STOP(r, event->start_mark, _("more than %d levels deep"), DEPTH_MAX);
    if (++r->values > VALUES_MAX)
        return STOP(r, event->start_mark, _("more than %d values in one file; write a long profile as CSV"), VALUES_MAX);
    if (event->type == YAML_ALIAS_EVENT || event->data.scalar.anchor ||
        event->data.scalar.tag) /* members of all value events */
        return STOP(r, event->start_mark, _("an alias, an anchor or a tag; write the value out without it"));
    return event->type == YAML_SCALAR_EVENT ? read_scalar(r, event) : read_entries(r, event, depth + 1);
}

/* ---- escapes of JSON ---- */

/* Return the surrogate that a JSON escape at `p` encodes if it lies in `lo` to `lo` + 0x3ff; otherwise 0. */
static unsigned half_at(const char *p, size_t n, unsigned lo)
{
    char digits[5] = {0};
    if (n < 6 || p[0] != '\\' || p[1] != 'u')
        return 0;
    memcpy(digits, p + 2, 4);
    unsigned long code = digits[strspn(digits, "0123456789abcdefABCDEF")] ? 0 : strtoul(digits, NULL, 16);
    return code >= lo && code <= lo + 0x3ff ? (unsigned)code : 0;
}

static void note_joined(struct reader *r, size_t line, size_t column)
{
    struct joined *all = ceduo_arena_grow(r->arena, r->joined, r->joined_count, 1, &r->joined_capacity, sizeof *all);
    if (!all) { /* untaken: memory */
        stop(r);
        return;
    }
    r->joined = all;
    r->joined[r->joined_count++] = (struct joined){line, column};
}

/* Join the two escapes of a character above U+FFFF to one escape of YAML. JSON writes UTF-16 surrogates, which libyaml refuses.
 * Escapes exist in double quotes only; a quote opens a string only at the begin of a value. */
static void join_halves(struct reader *r)
{
    const char *from = r->bytes;
    size_t n = r->length, line = 0, column = 0, length = 0;
    char quote = 0, before = 0; /* before: last character that is not a blank; 0: at the start of a line */
    char *to = NULL;
    for (size_t i = 0, used; i < n && !r->stopped; i += used) { /* untaken: memory */
        unsigned high = quote == '"' ? half_at(from + i, n - i, 0xd800) : 0;
        unsigned low = high ? half_at(from + i + 6, n - i - 6, 0xdc00) : 0;
        char c = from[i], escape[16];
        used = low ? 12 : quote == '"' && c == '\\' && i + 1 < n && from[i + 1] != '\n' ? 2 : 1;
        if (low && !to) {
            to = ceduo_arena_alloc(r->arena, n + 1);
            if (!to) { /* untaken: memory */
                stop(r);
                return;
            }
            memcpy(to, from, i);
        }
        size_t written = used;
        if (low) {
            written = (size_t)snprintf(escape, sizeof escape, "\\U%08x", 0x10000 + ((high - 0xd800) << 10) + (low - 0xdc00));
            note_joined(r, line, column + written);
        }
        if (to)
            memcpy(to + length, low ? escape : from + i, written);
        length += written;
        for (size_t k = 0; k < (low ? 0 : used); k++)
            column += !ceduo_utf8_is_continuation(from[i + k]);
        column += low ? written : 0;
        bool may_begin = !before || strchr("[{,:-?", before);
        if (used > 1)
            continue;
        if (quote)
            quote = c != quote ? quote : c == '\'' && i + 1 < n && from[i + 1] == '\'' ? quote : 0;
        else if ((c == '"' || c == '\'') && may_begin)
            quote = c;
        else if (c == '#' && (i == 0 || strchr(" \t\n", from[i - 1])))
            while (i + used < n && from[i + used] != '\n') { /* a comment needs no columns */
                if (to)
                    to[length] = from[i + used];
                length++;
                used++;
            }
        if (c == '\n')
            line++, column = 0, before = 0;
        else if (c != ' ' && c != '\t' && c != '\r')
            before = c;
    }
    if (to)
        r->bytes = to, r->length = length;
}

/* Read the only document of the stream. */
static struct node *read_document(struct reader *r)
{
    struct node *root = NULL;
    while (!r->stopped) {
        yaml_event_t event;
        if (!next_event(r, &event))
            break;
        yaml_event_type_t type = event.type;
        if (type == YAML_DOCUMENT_START_EVENT && root)
            STOP(r, event.start_mark, _("a second document; a file must have only one"));
        else if (type != YAML_STREAM_START_EVENT && type != YAML_DOCUMENT_START_EVENT && type != YAML_DOCUMENT_END_EVENT &&
                 type != YAML_STREAM_END_EVENT)
            root = read_value(r, &event, 0);
        if (type == YAML_STREAM_END_EVENT && !root)
            ceduo_problem(r->problems, r->source, r->source->is_option, r->skip_column + 1, _("there is no value"));
        yaml_event_delete(&event);
        if (type == YAML_STREAM_END_EVENT)
            break;
    }
    return r->stopped ? NULL : root;
}

const struct node *ceduo_yaml_read_value(struct arena *arena, const struct source *source, size_t skip,
                                         struct problems *problems)
{
    struct reader r = {.arena = arena, .source = source, .problems = problems, .skip = skip};
    for (size_t i = source->is_option ? 0 : skip; i < skip; i++) /* a byte order mark has no column */
        r.skip_column += !ceduo_utf8_is_continuation(source->bytes[i]);
    if (!yaml_parser_initialize(&r.parser)) {
        ceduo_oom_set_flag();
        return NULL;
    }
    yaml_parser_set_encoding(&r.parser, YAML_UTF8_ENCODING);
    r.bytes = source->bytes + skip;
    r.length = source->length - skip;
    join_halves(&r);
    yaml_parser_set_input_string(&r.parser, (const unsigned char *)r.bytes, r.length);
    const struct node *root = read_document(&r);
    yaml_parser_delete(&r.parser);
    return root;
}

const struct node *ceduo_yaml_read(struct arena *arena, const struct source *source, struct problems *problems)
{
    return ceduo_yaml_read_value(arena, source, ceduo_source_mark(source), problems);
}
