/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a tree as YAML: in brackets if that fits on a line, otherwise in blocks. In a changed document only the bytes of
 * changed values are replaced. If the result does not read back as the tree, the document is laid out again. */
#include "node.h"

#include <string.h>
#include <strings.h>

#include "base/utf8.h"

#define FLOW_MAX 100 /* columns of a line with a mapping or list in brackets */

/* ---- scalars ---- */

/* True if a text needs no quotes: no YAML reader parses it as a number, a date, a truth value or null. */
static bool is_plain(const char *s)
{
    static const char *const words[] = {"true", "false", "null", "yes", "no", "on", "off", "y", "n", ".nan", ".inf"};
    const char *first = s + (*s == '-' || *s == '+');
    size_t n = strlen(s);
    bool number = first > s || *s == '.' || (*s >= '0' && *s <= '9');
    number = number && s[strspn(s, "0123456789abcdefABCDEF_xo.+-")] == '\0'; /* 0x1F, 1_000, 1.2.3, 2024-01-31 */
    if (n == 0 || s[0] == ' ' || s[n - 1] == ' ' || number)
        return false;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (strcasecmp(first, words[i]) == 0)
            return false;
    for (size_t i = 0; i < n; i++) {
        char c = s[i];
        bool word = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (!word && !strchr("_./+ ", c) && c != '-')
            return false;
    }
    return !(s[0] == '-' && s[1] == ' ');
}

static void print_quoted(struct text *text, const char *s)
{
    ceduo_text_append_char(text, '"');
    for (size_t n = strlen(s), length; n > 0; s += length, n -= length) {
        uint32_t c = 0;
        size_t known = ceduo_utf8_decode(s, n, &c);
        length = known ? known : 1; /* untaken: table */
        if (c == '"' || c == '\\')
            ceduo_text_format(text, "\\%c", (int)c);
        else if (c == '\n')
            ceduo_text_append(text, "\\n");
        /* untaken: table */
        else if (known && (!ceduo_utf8_printable(c) || c == 0xfeff)) /* YAML allows no byte order mark */
            ceduo_text_format(text, c < 0x100 ? "\\x%02x" : c <= 0xffff ? "\\u%04x" : "\\U%08x", c);
        else
            ceduo_text_append_n(text, s, length);
    }
    ceduo_text_append_char(text, '"');
}

void ceduo_emit_scalar(struct text *text, const char *value, bool quoted)
{
    double number;
    bool typed = !quoted && (ceduo_number_read(value, &number) == CEDUO_NUMBER_GOOD || strcmp(value, "true") == 0 ||
                             strcmp(value, "false") == 0);
    if (typed || is_plain(value))
        ceduo_text_append(text, value);
    else
        print_quoted(text, value);
}

/* ---- trees ---- */

void ceduo_emit_flow(struct text *text, const struct node *node)
{
    if (node->kind == NODE_SCALAR) {
        ceduo_emit_scalar(text, node->text, node->quoted);
        return;
    }
    ceduo_text_append_char(text, node->kind == NODE_MAP ? '{' : '[');
    for (size_t i = 0; i < node->n; i++) {
        if (i > 0)
            ceduo_text_append(text, ", ");
        if (node->kind == NODE_MAP)
            ceduo_text_format(text, "%s: ", node->items[i]->key);
        ceduo_emit_flow(text, node->items[i]);
    }
    ceduo_text_append_char(text, node->kind == NODE_MAP ? '}' : ']');
}

static void print_block(struct text *text, const struct node *node, size_t indent)
{
    for (size_t i = 0; i < node->n; i++) {
        const struct node *item = node->items[i];
        bool map = node->kind == NODE_MAP;
        bool flow = item->kind == NODE_SCALAR || item->n == 0;
        LOCAL_TEXT(line);
        if (!flow) { /* try one line */
            ceduo_emit_flow(&line, item);
            flow = line.length + indent + (map ? 20 : 2) <= FLOW_MAX;
        }
        if (map)
            ceduo_text_format(text, "%*s%s:%c", (int)indent, "", item->key, flow ? ' ' : '\n');
        else if (flow)
            ceduo_text_format(text, "%*s- ", (int)indent, "");
        if (flow) {
            ceduo_emit_flow(text, item);
            ceduo_text_append_char(text, '\n');
            continue;
        }
        size_t begin = text->length; /* the first line of a list item follows the dash */
        print_block(text, item, indent + 2);
        if (!map && !text->failed)
            text->bytes[begin + indent] = '-';
    }
}

void ceduo_emit(struct text *text, const struct node *root)
{
    print_block(text, root, 0);
}

/* ---- back to files ---- */

/* Return the entries of `now` that differ from `base`; NULL if one was removed. */
static const struct node *difference(struct arena *arena, const struct node *base, const struct node *now)
{
    const struct node *out = ceduo_node_empty(arena, NODE_MAP, NULL);
    for (size_t i = 0; i < base->n; i++)
        if (!ceduo_node_get(now, base->items[i]->key))
            return NULL;
    for (size_t i = 0; i < now->n; i++) {
        const struct node *entry = now->items[i], *old = ceduo_node_get(base, entry->key);
        if (old && ceduo_node_equal(old, entry))
            continue;
        if (old && old->kind == NODE_MAP) /* then `entry` is a mapping, too */
            entry = difference(arena, old, entry);
        out = ceduo_node_with(arena, out, now->items[i]->key, entry);
    }
    return out;
}

const struct node *ceduo_emit_restore_references(struct arena *arena, const struct node *node)
{
    if (node->written) {
        const struct node *original = node->followed;
        bool unchanged = original->n == node->n;
        for (size_t i = 0; unchanged && i < original->n; i++)
            unchanged = ceduo_node_equal(original->items[i], node->items[i]);
        if (unchanged)
            return ceduo_node_renamed(arena, node->written, node->key);
        /* a stand becomes its base and its changes, unless a key was removed */
        const struct node *changes = strcmp(node->key, "stand") == 0 ? difference(arena, original, node) : NULL;
        const struct node *start = node->written;
        if (changes && start->kind == NODE_SCALAR)
            start = ceduo_node_with(arena, ceduo_node_empty(arena, NODE_MAP, NULL), "base", start);
        for (size_t i = 0; changes && i < changes->n; i++)
            start = ceduo_node_with(arena, start, changes->items[i]->key, ceduo_node_get(node, changes->items[i]->key));
        if (changes)
            return ceduo_node_renamed(arena, start, node->key);
    }
    if (node->kind == NODE_SCALAR)
        return node;
    const struct node *out = node;
    for (size_t i = 0; i < node->n; i++) {
        const struct node *item = ceduo_emit_restore_references(arena, node->items[i]);
        if (item != node->items[i])
            out = ceduo_node_replaced(arena, out, i, item);
    }
    return out;
}

/* ---- patching ---- */

struct patcher {
    struct text *text;
    const struct source *source;
    size_t done; /* bytes of the source that were copied or replaced */
};

/* Replace the bytes between the marks of `old` by `now`. Return false if the marks are out of order. */
static bool patch_span(struct patcher *p, const struct node *old, const struct node *now)
{
    size_t from = ceduo_source_byte(p->source, old->line, old->column);
    size_t to = ceduo_source_byte(p->source, old->end_line, old->end_column);
    if (from < p->done)
        return false;
    ceduo_text_append_n(p->text, p->source->bytes + p->done, from - p->done);
    ceduo_emit_flow(p->text, now);
    p->done = to;
    return true;
}

static bool patch(struct patcher *p, const struct node *old, const struct node *now)
{
    if (old == now || (old->kind == NODE_SCALAR && now->kind == NODE_SCALAR && strcmp(old->text, now->text) == 0))
        return true;
    if (old->kind == NODE_SCALAR)
        return patch_span(p, old, now);
    bool unchanged = old->kind == now->kind && old->n == now->n;
    for (size_t i = 0; unchanged && old->kind == NODE_MAP && i < old->n; i++)
        unchanged = strcmp(old->items[i]->key, now->items[i]->key) == 0;
    if (!unchanged)
        return old->flow && patch_span(p, old, now);
    for (size_t i = 0; i < old->n; i++)
        if (!patch(p, old->items[i], now->items[i]))
            return false;
    return true;
}

bool ceduo_emit_patched(struct text *text, const struct source *source, const struct node *old, const struct node *root)
{
    LOCAL_TEXT(out);
    struct patcher p = {&out, source, 0};
    bool good = patch(&p, old, root);
    if (good) { /* read the text back */
        struct arena arena = {0};
        struct problems problems = {0};
        ceduo_text_append_n(&out, source->bytes + p.done, source->length - p.done);
        const struct source whole = {.name = "", .bytes = out.bytes, .length = out.length};
        const struct node *again = ceduo_yaml_read(&arena, &whole, &problems);
        good = again && ceduo_node_equal(again, root);
        ceduo_problems_free(&problems);
        ceduo_arena_free(&arena);
    }
    if (good)
        ceduo_text_append_n(text, out.bytes, out.length);
    return good;
}
