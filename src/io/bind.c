/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the nodes of a document by the table of keys. Each row gives the type of its value and the member that holds it.
 * The binder keeps the path of the current value for messages. It marks an invalid value by its path and continues.
 * Lists and texts are in the caller's arena. */
#include "bind.h"
#include "scene/rock.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/text.h"
#include "scene/fields.h"

#define KEYS_MAX 32 /* keys in a message */
#define KEYS_FEW 4  /* at most this many: list them all, unless the nearest has the same first letter */

struct binder {
    const struct binding *to;
    struct text path;
    size_t file_start; /* bytes of `path` that lead to the root of the current file */
    bool partial;      /* the current mapping has an unreadable base */
    double end;        /* x of the profile's end, m; NaN: not computed yet, or unknown */
};

/* ---- reporting ---- */

static const char *path_here(const struct binder *b)
{
    const char *path = ceduo_text_string(&b->path) + (b->path.bytes ? b->file_start : 0);
    return path[0] == '.' ? path + 1 : path;
}

/* Mark the value at the current path as invalid, so that later checks skip it. */
static void mark_invalid(struct binder *b)
{
    struct invalid_values *invalid = b->to->invalid;
    bool full = invalid->n >= CEDUO_INVALID_MAX;
    const char *path = full ? NULL : ceduo_arena_string(b->to->arena, ceduo_text_string(&b->path));
    if (path)
        invalid->paths[invalid->n] = path;
    invalid->n += path || full;
}

/* Report an error at a value. Return false. */
__attribute__((format(printf, 3, 4))) static bool report(struct binder *b, const struct node *node, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(b->to->problems, ceduo_node_place(node, path_here(b)), format, args);
    va_end(args);
    mark_invalid(b);
    return false;
}

/* ---- the path ---- */

static size_t enter_key(struct binder *b, const char *key)
{
    size_t before = b->path.length;
    if (before > 0)
        ceduo_text_append_char(&b->path, '.');
    ceduo_text_append(&b->path, key);
    return before;
}

static size_t enter_item(struct binder *b, size_t i)
{
    size_t before = b->path.length;
    ceduo_text_format(&b->path, "[%zu]", i);
    return before;
}

static void leave_path(struct binder *b, size_t before)
{
    ceduo_text_cut(&b->path, before);
}

static const struct object source_object;

const char *ceduo_bind_unknown_key(const struct object *object, const char *key, struct text *message)
{
    const char *words[KEYS_MAX + 1]; /* + 1: source */
    size_t n = 0;
    for (size_t i = 0; i < object->n && n < KEYS_MAX; i++) /* untaken: large */
        if (n == 0 || strcmp(words[n - 1], object->fields[i].key) != 0)
            words[n++] = object->fields[i].key;
    if (object != &source_object) /* every mapping may have a source */
        words[n++] = "source";
    const char *near = ceduo_text_nearest(key, words, n);
    LOCAL_TEXT(list);
    ceduo_text_join(&list, words, n, ", ");
    if (near && n <= KEYS_FEW && near[0] != key[0])
        near = NULL;
    ceduo_text_format(message, near ? _("unknown key; did you mean '%s'?") : _("unknown key; known here: %s"),
                      near ? near : ceduo_text_string(&list));
    return near;
}

static void report_unknown_key(struct binder *b, const struct object *object, const struct node *entry)
{
    LOCAL_TEXT(message);
    const char *removed = ceduo_removed_hint(entry->key), *near = ceduo_bind_unknown_key(object, entry->key, &message);
    struct problem_place place = ceduo_node_place(entry, NULL);
    if (entry->key_line) {
        place.line = entry->key_line;
        place.column = entry->key_column;
    }
    size_t before = enter_key(b, entry->key);
    if (entry->source->foreign && !removed) { /* do not echo keys of an unrecognized file */
        ceduo_problem_at(b->to->problems, place, _("unknown key"));
    } else {
        place.path = path_here(b);
        place.own = true;
        ceduo_problem_at(b->to->problems, place, "%s", removed ? _(removed) : ceduo_text_string(&message));
    }
    leave_path(b, before);
    if (near) { /* counts as present, so it is not reported as missing */
        before = enter_key(b, near);
        mark_invalid(b);
        leave_path(b, before);
    }
}

/* ---- values ---- */

/* True if a value is of a kind; otherwise reports what was expected. */
static bool expect_kind(struct binder *b, const struct node *node, enum node_kind kind, const char *expected)
{
    if (node->kind == kind)
        return true;
    const char *found = node->kind == NODE_MAP ? _("a mapping") : node->kind == NODE_LIST ? _("a list") : _("a single value");
    struct problem_place place = ceduo_node_place(node, path_here(b));
    place.own = true;
    ceduo_problem_at(b->to->problems, place, _("expected %s, not %s"), expected, found);
    mark_invalid(b);
    return false;
}

/* Read a place from the end of the profile: "end", "end-10". Return false if the value is not such a place, or on error. */
static bool read_place(struct binder *b, const struct field *f, const struct node *node, double *value)
{
    double back;
    const char *text = node->text;
    if (!ceduo_schema_is_place(f) || node->kind != NODE_SCALAR || strncmp(text, "end", 3) != 0)
        return false;
    if (!ceduo_schema_place_read(text, &back))
        return report(b, node, _("'%s': write end, or end-10 for 10 m before the end of the profile"), text);
    if (isnan(b->end))
        b->end = b->to->end(b->to->context);
    if (isnan(b->end))
        mark_invalid(b); /* the check of the profile reports the cause */
    *value = b->end - back;
    return !isnan(b->end);
}

#define DECIMAL_COMMA _("decimal comma: write %.*s.%s")

static bool read_number(struct binder *b, const struct node *node, double *value)
{
    if (!expect_kind(b, node, NODE_SCALAR, _("a number")))
        return false;
    if (node->quoted)
        return report(b, node, _("'%s' is in quotes; write the number without them"), node->text);
    enum ceduo_number_reading reading = ceduo_number_read(node->text, value);
    if (reading == CEDUO_NUMBER_GOOD)
        return true;
    if (reading != CEDUO_NUMBER_NONE)
        return report(b, node, _("the number is too large"));
    const char *text = node->text, *comma = strchr(text, ',');
    size_t whole = strspn(text, "+-0123456789"), rest = comma ? strspn(comma + 1, "0123456789") : 0;
    bool thousands = rest == 3 && ceduo_decimal_read(text) != 0;
    LOCAL_TEXT(part);
    ceduo_text_append_n(&part, text, strcspn(text, "%"));
    if (comma == text + whole && rest > 0 && !comma[1 + rest] && !thousands)
        return report(b, node, DECIMAL_COMMA, (int)whole, text, comma + 1);
    if (comma)
        return report(b, node, _("'%s' is not a number; write a dot for the decimals and nothing between thousands"), text);
    if (strcmp(text + part.length, "%") == 0 && ceduo_number_read(ceduo_text_string(&part), value) == CEDUO_NUMBER_GOOD)
        return report(b, node, _("'%s' is not a number; write %s"), text, ROUNDTRIP(*value / 100));
    const size_t length = strspn(text, "+-.0123456789"), blanks = strspn(text + length, " ");
    ceduo_text_cut(&part, 0);
    ceduo_text_append_n(&part, text, length);
    if (ceduo_number_read(ceduo_text_string(&part), value) == CEDUO_NUMBER_GOOD &&
        isalpha((unsigned char)text[length + blanks]) && (blanks > 0 || !strpbrk(text + length, "0123456789")))
        return report(b, node, _("'%s' is not a number; write it without its unit, in the unit of the key"), text);
    return report(b, node, _("'%s' is not a number"), text);
}

static bool check_range(struct binder *b, const struct field *f, const struct node *node, double value)
{
    const char *number = ROUNDTRIP(value), *gap = f->unit[0] ? " " : "", *unit = f->unit;
    if (value < f->lo)
        return report(b, node, _("%s is below %s%s%s"), number, ROUNDTRIP(f->lo), gap, unit);
    if (f->flags & FIELD_ABOVE && !(value > f->lo))
        return report(b, node, _("%s is not above %s%s%s"), number, ROUNDTRIP(f->lo), gap, unit);
    if (value > f->hi)
        return report(b, node, _("%s is above %s%s%s"), number, ROUNDTRIP(f->hi), gap, unit);
    if (f->flags & FIELD_UNDER && !(value < f->hi))
        return report(b, node, _("%s is not below %s%s%s"), number, ROUNDTRIP(f->hi), gap, unit);
    return true;
}

void ceduo_warn_unusual(struct problems *problems, struct problem_place place, const struct field *f, double value)
{
    const char *gap = f->unit[0] ? " " : "", *unit = f->unit;
    place.unusual = true;
    if (!ceduo_schema_is_usual(f, value))
        ceduo_problem_at(problems, place, _("%s%s%s is unusual (usual: %s to %s%s%s); check the number and its unit"),
                         ROUNDTRIP(value), gap, unit, ROUNDTRIP(f->shown.usual_min), ROUNDTRIP(f->shown.usual_max), gap, unit);
}

static void warn_unusual(struct binder *b, const struct field *f, const struct node *node, double value)
{
    if (b->to->warns)
        ceduo_warn_unusual(b->to->problems, ceduo_node_place(node, path_here(b)), f, value);
}

static bool bind_number(struct binder *b, const struct field *f, const struct node *node, double *to)
{
    double value = 0;
    size_t before = b->to->invalid->n;
    if (!read_place(b, f, node, &value) && (b->to->invalid->n > before || !read_number(b, node, &value)))
        return false;
    if (!check_range(b, f, node, value))
        return false;
    warn_unusual(b, f, node, value);
    *to = value * f->scale;
    return true;
}

static void bind_count(struct binder *b, const struct field *f, const struct node *node, void *to)
{
    double value = 0;
    uint64_t count;
    if (!read_number(b, node, &value))
        return;
    if (value != floor(value))
        report(b, node, _("'%s' is not a whole number"), node->text);
    else if (!check_range(b, f, node, value))
        return;
    else if (ceduo_count_read(node->text, f->lo, f->hi, &count) != CEDUO_NUMBER_GOOD)
        report(b, node, _("%s is above %s%s%s"), node->text, ROUNDTRIP(f->hi), "", ""); /* the seed, which has no unit */
    else {
        warn_unusual(b, f, node, value);
        ceduo_schema_set_count(f, to, count);
    }
}

/* `to`: an int or an enum */
static void bind_choice(struct binder *b, const struct choices *choices, const struct node *node, void *to)
{
    if (!expect_kind(b, node, NODE_SCALAR, _("a word")))
        return;
    int found = ceduo_choice_find(choices, node->text);
    if (found >= 0) {
        memcpy(to, &found, sizeof found);
        return;
    }
    const char *removed = ceduo_removed_hint(node->text);
    if (removed) {
        report(b, node, "%s", _(removed));
        return;
    }
    struct text list = {0};
    ceduo_text_join(&list, choices->names, choices->n, ", ");
    const char *near = ceduo_text_nearest(node->text, choices->names, choices->n);
    if (near)
        report(b, node, _("'%s' is unknown; did you mean '%s'? (%s)"), node->text, near, ceduo_text_string(&list));
    else
        report(b, node, _("'%s' is unknown; one of: %s"), node->text, ceduo_text_string(&list));
    ceduo_text_free(&list);
}

/* `to`: a char *; may be NULL */
static void bind_text(struct binder *b, const struct node *node, void *to)
{
    if (expect_kind(b, node, NODE_SCALAR, _("a text")) && to)
        memcpy(to, &node->text, sizeof node->text);
}

static void bind_map(struct binder *b, const struct object *object, const struct node *node, void *item);

/* Bind a number, or {mean: …, spread: …, kind: …}. The rows of these keys are made from the row of the number. */
static void bind_spread(struct binder *b, const struct field *f, const struct node *node, struct ceduo_number *to)
{
    struct field rows[] = {
        *f, *f, WORD("kind", .shown = NAMED(NULL), MEMBER(ceduo_number, kind), .meaning = "", .choices = &ceduo_spread_words)};
    const struct object parts = OBJECT(ceduo_number, rows, NULL);
    *to = ceduo_number(to->mean);
    if (node->kind != NODE_MAP) {
        bind_number(b, f, node, &to->mean);
        return;
    }
    rows[0].key = "mean";
    rows[0].offset = offsetof(struct ceduo_number, mean);
    rows[0].flags |= isnan(to->mean) && !(f->flags & FIELD_MEANLESS) ? FIELD_REQUIRED : 0;
    rows[1].key = "spread";
    rows[1].offset = offsetof(struct ceduo_number, spread);
    rows[1].flags = 0;
    rows[1].lo = rows[1].shown.usual_min = 0;
    rows[1].hi = rows[1].shown.usual_max = INFINITY;
    rows[0].type = rows[1].type = FIELD_NUMBER;
    bind_map(b, &parts, node, to);
    if (!ceduo_schema_spread_fits(f, *to))
        report(b, node, _("with this spread the values reach from %.6g to %.6g %s; reduce it to stay within the range"),
               ceduo_number_min(*to) / f->scale, ceduo_number_max(*to) / f->scale, f->unit);
}

/* Bind a list: allocate its items, set the member that points to them, and bind each item. */
static void bind_list(struct binder *b, const struct field *f, const struct node *node, void *item)
{
    const struct object *object = f->object;
    bool points = f->type == FIELD_POINTS, words = f->type == FIELD_WORDS;
    bool one = f->flags & FIELD_SCALAR_OK && node->kind == NODE_MAP; /* one item instead of a list */
    size_t n = one ? 1 : node->n, size = object ? object->size : words ? sizeof(char *) : sizeof(double);
    if (f->flags & FIELD_OR_NONE && node->kind == NODE_SCALAR && strcmp(node->text, "none") == 0)
        return;
    if (!one && !expect_kind(b, node, NODE_LIST, _("a list")))
        return;
    void *items[2] = {ceduo_arena_alloc(b->to->arena, (n + 1) * size),
                      points ? ceduo_arena_alloc(b->to->arena, (n + 1) * size) : NULL}; /* x and z of points */
    if (!items[0] || (points && !items[1]))
        return;
    if (!(f->flags & FIELD_NO_MEMBER)) {
        memcpy((char *)item + f->offset, items, points ? sizeof items : sizeof items[0]);
        memcpy((char *)item + f->companion_offset, &n, sizeof n);
    }
    for (size_t i = 0; i < n; i++) {
        const struct node *entry = one ? node : node->items[i];
        char *value = (char *)items[0] + i * size;
        double *x = (double *)items[0] + i, *z = points ? (double *)items[1] + i : NULL;
        size_t before = one ? b->path.length : enter_item(b, i);
        if (object) {
            ceduo_schema_init(object, value);
            bind_map(b, object, entry, value);
        } else if (words) {
            *(const char **)(void *)value = "";
            bind_text(b, entry, value);
        } else if (points) {
            *x = *z = NAN;
            if (entry->kind != NODE_LIST || entry->n != 2)
                report(b, entry, _("expected %s"), "[x, z]");
            else if (bind_number(b, f, entry->items[0], x))
                bind_number(b, f, entry->items[1], z);
        } else {
            *x = NAN;
            bind_number(b, f, entry, x);
        }
        leave_path(b, before);
    }
}

static void bind_field(struct binder *b, const struct field *f, const struct node *node, void *item)
{
    void *to = (char *)item + f->offset;
    if (node->broken)
        mark_invalid(b);
    if (node->broken && node->kind != NODE_MAP)
        return;
    switch (f->type) { /* untaken: table */
    case FIELD_TAG:
        if (expect_kind(b, node, NODE_SCALAR, f->value) && strcmp(node->text, f->value) != 0)
            report(b, node, _("'%s': expected %s"), node->text, f->value);
        break;
    case FIELD_TEXT:
    case FIELD_FILE:
        bind_text(b, node, f->flags & FIELD_NO_MEMBER ? NULL : to);
        break;
    case FIELD_NUMBER:
        bind_number(b, f, node, to);
        break;
    case FIELD_SPREAD:
        bind_spread(b, f, node, to);
        break;
    case FIELD_SPREADS:
        if (node->kind != NODE_LIST || node->n != 3)
            report(b, node, _("expected %s"), "[a, b, c]");
        for (size_t i = 0; node->kind == NODE_LIST && node->n == 3 && i < 3; i++) {
            size_t before = enter_item(b, i);
            bind_spread(b, f, node->items[i], (struct ceduo_number *)to + i);
            leave_path(b, before);
        }
        break;
    case FIELD_COUNT:
        bind_count(b, f, node, to);
        break;
    case FIELD_CHOICE:
        bind_choice(b, f->choices, node, to);
        break;
    case FIELD_FLAG:
        if (!expect_kind(b, node, NODE_SCALAR, _("true or false")))
            break;
        *(bool *)to = strcmp(node->text, "true") == 0;
        if (node->quoted || (!*(bool *)to && strcmp(node->text, "false") != 0))
            report(b, node, _("'%s': expected %s"), node->text, _("true or false"));
        break;
    case FIELD_GROUP:
        bind_map(b, f->object, node, to);
        break;
    case FIELD_NUMBERS:
    case FIELD_WORDS:
    case FIELD_POINTS:
    case FIELD_LIST:
        bind_list(b, f, node, item);
        break;
    }
}

/* `text_it` may be NULL. */
static void add_note(struct binder *b, const char *kind, const char *text, const char *text_it)
{
    const char *path = ceduo_text_string(&b->path);
    bool is_range = ceduo_path_leads_to("uncertainty", path) || strstr(path, ".stand.uncertainty[");
    if (is_range || ceduo_path_leads_to("observed", path)) /* not an input of the simulation */
        return;
    struct source_note *note = ceduo_arena_alloc(b->to->arena, sizeof *note);
    if (!note)
        return;
    *note = (struct source_note){.path = ceduo_arena_string(b->to->arena, path),
                                 .kind = kind,
                                 .text = ceduo_arena_string(b->to->arena, text),
                                 .text_it = text_it ? ceduo_arena_string(b->to->arena, text_it) : NULL,
                                 .before = *b->to->notes};
    if (note->path && note->text)
        *b->to->notes = note;
}

/* source: {kind: measured|literature|assumed|calibrated, text: …, text_it: …, except: […]}, allowed in every mapping. */
struct source_value {
    int kind;
    char *text, *text_it, **except; /* except: values with another source */
    size_t except_count;
};

#define UNLABELLED NAMED(NULL)
static const char *const source_kinds[] = {N_("measured"), N_("literature"), N_("assumed"), N_("calibrated")};
static const struct choices source_words = {.names = source_kinds, .n = 4};
static const struct field source_fields[] = {
    WORD("kind", .shown = UNLABELLED, MEMBER(source_value, kind), .flags = REQUIRED,
         .meaning = N_("measured, literature, assumed or calibrated"), .choices = &source_words),
    TEXT("text", UNLABELLED, MEMBER(source_value, text), NO_RUN, ""),
    TEXT("text_it", UNLABELLED, MEMBER(source_value, text_it), NO_RUN, ""),
    WORD_LIST("except", UNLABELLED, LIST(source_value, except, except_count), NO_RUN, ""),
};
static const struct object source_object = OBJECT(source_value, source_fields, NULL);

/* Add the note of a source. Values under `except` get a note of kind "changed", and the text of the source names them. */
static void bind_source(struct binder *b, const struct node *node)
{
    struct source_value source;
    LOCAL_TEXT(changed);
    size_t before = enter_key(b, "source");
    ceduo_schema_init(&source_object, &source);
    bind_map(b, &source_object, node, &source);
    leave_path(b, before);
    if (source.kind < 0)
        return;
    for (size_t i = 0; i < source.except_count; i++) {
        ceduo_text_format(&changed, i == 0 ? _("changed since: %s") : ", %s", source.except[i]);
        before = enter_key(b, source.except[i]);
        add_note(b, N_("changed"), _("the source of the other values does not apply"), NULL);
        leave_path(b, before);
    }
    const char *const texts[2] = {source.text, source.text_it};
    struct text whole[2] = {{0}, {0}};
    for (int i = 0; i < 2; i++) {
        ceduo_text_append(&whole[i], texts[i] ? texts[i] : "");
        if (changed.length > 0)
            ceduo_text_append_joined(&whole[i], "; ", "%s", ceduo_text_string(&changed));
    }
    add_note(b, source_kinds[source.kind], ceduo_text_string(&whole[0]), texts[1] ? ceduo_text_string(&whole[1]) : NULL);
    ceduo_text_free(&whole[0]);
    ceduo_text_free(&whole[1]);
}

static void report_missing(struct binder *b, const struct object *object, const struct node *node)
{
    for (size_t i = 0; i < object->n; i++) {
        const struct field *f = &object->fields[i];
        bool tag = f->type == FIELD_TAG && node->key; /* only required at the root of a file */
        const struct field *alias = ceduo_schema_unit(object, f);
        if (!(f->flags & FIELD_REQUIRED) || tag || ceduo_node_get(node, f->key) || (alias && ceduo_node_get(node, alias->key)))
            continue;
        size_t before = enter_key(b, f->key);
        bool reported = false;
        for (size_t k = 0; k < b->to->invalid->n && k < CEDUO_INVALID_MAX; k++)
            reported |= strcmp(b->to->invalid->paths[k], ceduo_text_string(&b->path)) == 0;
        mark_invalid(b);
        leave_path(b, before);
        struct problem_place place = ceduo_node_place(node, path_here(b));
        place.own = true;
        if (!reported)
            ceduo_problem_at(b->to->problems, place, _("'%s' is missing: %s"), f->key,
                             f->type == FIELD_TAG ? f->value : _(f->meaning));
    }
}

static bool is_digits(const char *text)
{
    return text[0] && !text[strspn(text, "0123456789")];
}

/* In brackets a decimal comma splits a number into two entries: {spacing_m: 0,35} is 'spacing_m: 0' and '35'. */
static bool report_decimal_comma(struct binder *b, const struct node *map, size_t i)
{
    const struct node *whole = map->items[i], *rest = i + 1 < map->n ? map->items[i + 1] : NULL;
    bool two = map->flow && rest && whole->kind == NODE_SCALAR && rest->kind == NODE_SCALAR && !whole->quoted &&
               !rest->quoted && !rest->text[0] && is_digits(rest->key) && is_digits(whole->text + strspn(whole->text, "+-"));
    if (!two || rest->key_line != whole->end_line || rest->key_column != whole->end_column + 1)
        return false;
    size_t before = enter_key(b, whole->key);
    report(b, whole, DECIMAL_COMMA, (int)strlen(whole->text), whole->text, rest->key);
    leave_path(b, before);
    return true;
}

/* True if a file is of another kind, such as a stand in place of a scene. Reports it; its keys are not read. */
static bool is_other_kind(struct binder *b, const struct object *object, const struct node *node)
{
    const struct field *f = ceduo_schema_field(object, "ceduo");
    const struct node *tag = f ? ceduo_node_get(node, "ceduo") : NULL;
    const char *slash = tag && tag->kind == NODE_SCALAR ? strchr(tag->text, '/') : NULL;
    bool wrong = slash && strncmp(tag->text, f->value, (size_t)(slash + 1 - tag->text)) != 0;
    if (wrong)
        report(b, tag, _("'%s': expected %s"), tag->text, f->value);
    return wrong;
}

static void bind_map(struct binder *b, const struct object *object, const struct node *node, void *item)
{
    if (!expect_kind(b, node, NODE_MAP, _("a mapping")) || is_other_kind(b, object, node))
        return;
    bool partial = b->partial;
    b->partial |= node->broken;
    size_t outer = b->file_start;
    if (node->written && node->written->kind == NODE_SCALAR)
        b->file_start = b->path.length; /* included file: paths in messages restart here */
    size_t own = b->file_start;
    for (size_t i = 0; i < node->n; i++) {
        const struct node *entry = node->items[i];
        const struct field *f = ceduo_schema_field(object, entry->key);
        bool from_base =
            node->written && entry->source != node->source && !entry->source->is_option && !node->source->is_option;
        b->file_start = from_base ? b->path.length : own;
        if (report_decimal_comma(b, node, i)) {
            i++;
        } else if (f) {
            size_t before = enter_key(b, entry->key);
            const char *rival = ceduo_schema_alternative(object, f->key);
            const struct field *list = ceduo_schema_list(object, f);
            if (rival && ceduo_schema_field(object, rival) < f && ceduo_node_get(node, rival))
                report(b, entry, _("%s already says this; keep one of the two"), rival);
            else
                bind_field(b, list && entry->kind == NODE_LIST ? list : f, entry, item);
            leave_path(b, before);
        } else if (strcmp(entry->key, "source") == 0 && object != &source_object) {
            bind_source(b, entry);
        } else {
            report_unknown_key(b, object, entry);
        }
    }
    b->file_start = own;
    if (!b->partial)
        report_missing(b, object, node);
    b->file_start = outer;
    b->partial = partial;
}

void ceduo_bind(const struct binding *to, const struct object *object, const struct node *node, void *item)
{
    struct binder b = {.to = to, .end = NAN};
    bind_map(&b, object, node, item);
    ceduo_text_free(&b.path);
}

/* ---- notes ---- */

void ceduo_notes_each(const struct source_note *notes, const char *kind, void (*print)(void *context, const char *text),
                      void *context)
{
    if (!notes)
        return;
    ceduo_notes_each(notes->before, kind, print, context); /* the list begins with the last */
    if (strcmp(notes->kind, kind) == 0)
        print(context, notes->text);
}

bool ceduo_path_leads_to(const char *outer, const char *path)
{
    size_t n = strlen(outer);
    return n == 0 || (strncmp(path, outer, n) == 0 && (path[n] == '\0' || path[n] == '.' || path[n] == '['));
}

bool ceduo_note_years(const struct source_note *note)
{
    return strstr(note->path, ".growth") != NULL || strstr(note->path, ".cutting") != NULL;
}

bool ceduo_notes_print(const struct source_note *notes, const char *kind, const char *path)
{
    while (notes && !(strcmp(notes->kind, kind) == 0 && ceduo_path_leads_to(path, notes->path) && !ceduo_note_years(notes)))
        notes = notes->before;
    return notes != NULL;
}

const struct source_note *ceduo_notes_find(const struct source_note *notes, const char *path)
{
    const struct source_note *best = NULL;
    for (const struct source_note *note = notes; note; note = note->before) {
        if (!ceduo_path_leads_to(note->path, path))
            continue;
        size_t n = strlen(note->path), max = best ? strlen(best->path) : 0;
        if (!best || n > max || (n == max && strcmp(best->kind, "changed") == 0)) /* the most specific note wins */
            best = note;
    }
    return best;
}
