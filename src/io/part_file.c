/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A part as a line of JSON with its data in base64 and a sum at the end. A line is decoded in place: a part points
 * into the text that its file was read into. The inputs are packed by base/bytes.h, and so is what the key is the
 * hash of. */
#include "part_file.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/bytes.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/utf8.h"
#include "ceduo/doubt.h"
#include "ceduo/key.h"
#include "ceduo/version.h"

/* ---- base64 ---- */

static const char letters[65] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

static void put_base64(struct text *out, const unsigned char *bytes, size_t n)
{
    char four[4096];
    size_t filled = 0;
    for (size_t i = 0; i < n; i += 3) {
        uint32_t group = (uint32_t)bytes[i] << 16;
        group |= i + 1 < n ? (uint32_t)bytes[i + 1] << 8 : 0;
        group |= i + 2 < n ? bytes[i + 2] : 0;
        four[filled++] = letters[group >> 18];
        four[filled++] = letters[group >> 12 & 63];
        four[filled++] = i + 1 < n ? letters[group >> 6 & 63] : '=';
        four[filled++] = i + 2 < n ? letters[group & 63] : '=';
        if (filled == sizeof four || i + 3 >= n) {
            ceduo_text_add(out, four, filled);
            filled = 0;
        }
    }
}

/* In place; false where it is none. */
static bool take_base64(char *text, size_t n, size_t *length)
{
    static const char pad = '=';
    unsigned char value[256];
    memset(value, 64, sizeof value);
    for (unsigned i = 0; i < 64; i++)
        value[(unsigned char)letters[i]] = (unsigned char)i;
    *length = 0;
    if (n % 4 != 0)
        return false;
    size_t last = n > 0 ? (size_t)(text[n - 1] == pad) + (size_t)(text[n - 1] == pad && text[n - 2] == pad) : 0;
    unsigned char *to = (unsigned char *)text;
    for (size_t i = 0; i < n; i += 4) {
        size_t missing = i + 4 == n ? last : 0;
        uint32_t group = 0;
        for (size_t k = 0; k < 4 - missing; k++) {
            unsigned char v = value[(unsigned char)text[i + k]];
            if (v > 63)
                return false;
            group |= (uint32_t)v << (18 - 6 * k);
        }
        for (size_t k = 0; k < 3 - missing; k++)
            to[(*length)++] = (unsigned char)(group >> (16 - 8 * k));
    }
    return true;
}

/* ---- the line ---- */

#define START      "{\"format\": \"ceduo-part-"
#define FORMAT     "1"
#define SUM        ", \"sum\": \""
#define SUM_LENGTH (sizeof SUM - 1 + 16 + 2) /* with 16 digits, a quote and a brace */

void ceduo_part_write(struct text *out, const struct part *part)
{
    struct json json = {.text = out}, *j = &json;
    size_t start = out->length;
    char key[17];
    snprintf(key, sizeof key, "%016" PRIx64, part->key);
    ceduo_json_open(j, NULL, '{');
    ceduo_json_string(j, "format", "ceduo-part-" FORMAT);
    ceduo_json_string(j, "version", CEDUO_VERSION);
    ceduo_json_string(j, "scene", part->scene);
    ceduo_json_count(j, "place", part->place);
    ceduo_json_count(j, "shard", part->shard);
    ceduo_json_count(j, "shards", part->shards);
    ceduo_json_count(j, "rocks", part->rocks);
    if (part->points > 0)
        ceduo_json_count(j, "points", part->points);
    ceduo_json_number(j, "seconds", part->seconds);
    ceduo_json_string(j, "hash", key);
    ceduo_text_put(out, ", \"inputs\": \"");
    put_base64(out, part->inputs, part->inputs_length);
    ceduo_text_put(out, "\", \"runs\": \"");
    put_base64(out, part->runs, part->runs_length);
    ceduo_text_char(out, '"');
    if (out->failed)
        return;
    uint64_t sum = hash_bytes(out->bytes + start, out->length - start);
    ceduo_text_format(out, SUM "%016" PRIx64 "\"}\n", sum);
}

/* What is still to be read of a line. */
struct cursor {
    char *at, *end;
};

static bool take(struct cursor *c, const char *word)
{
    size_t n = strlen(word);
    if ((size_t)(c->end - c->at) < n || memcmp(c->at, word, n) != 0)
        return false;
    c->at += n;
    return true;
}

static bool take_hex(struct cursor *c, size_t digits, uint64_t *value)
{
    *value = 0;
    for (size_t i = 0; i < digits; i++, c->at++) {
        const char *hex = "0123456789abcdef", *p = c->at < c->end && *c->at ? strchr(hex, *c->at) : NULL;
        if (!p)
            return false;
        *value = *value << 4 | (uint64_t)(p - hex);
    }
    return true;
}

static bool take_count(struct cursor *c, const char *name, double lo, double hi, uint64_t *value)
{
    char digits[24];
    size_t n = 0;
    if (!take(c, name))
        return false;
    while (c->at < c->end && *c->at >= '0' && *c->at <= '9' && n + 1 < sizeof digits)
        digits[n++] = *c->at++;
    digits[n] = '\0';
    return n > 0 && ceduo_count_read(digits, lo, hi, value) == CEDUO_NUMBER_GOOD;
}

/* Parts of runs have none. */
static bool take_points(struct cursor *c, uint64_t *value)
{
    static const char name[] = ", \"points\": ";
    bool there = (size_t)(c->end - c->at) > sizeof name && memcmp(c->at, name, sizeof name - 1) == 0;
    *value = 0;
    return !there || take_count(c, name, 2, CEDUO_DOUBT_POINTS_MOST, value);
}

static bool take_seconds(struct cursor *c, double *value)
{
    char digits[CEDUO_NUMBER_ROOM];
    size_t n = 0;
    while (c->at < c->end && *c->at != ',' && *c->at && n + 1 < sizeof digits)
        digits[n++] = *c->at++;
    digits[n] = '\0';
    return ceduo_number_read(digits, value) == CEDUO_NUMBER_GOOD && *value >= 0;
}

/* The character of an escape, as json.c writes it, after its u; 0 where it is none. */
static uint32_t take_escape(struct cursor *c)
{
    uint64_t code, low;
    if (!take_hex(c, 4, &code))
        return 0;
    if (code >> 10 != 0xd800 >> 10)
        return (uint32_t)code;
    return take(c, "\\u") && take_hex(c, 4, &low) ? (uint32_t)(((code - 0xd7c0) << 10) + (low & 0x3ff)) : 0;
}

/* A string after its quote. */
static char *take_string(struct arena *arena, struct cursor *c)
{
    struct text text = {0};
    bool good = true;
    while (good && c->at < c->end && *c->at != '"') {
        if (*c->at != '\\') {
            ceduo_text_char(&text, *c->at++);
            continue;
        }
        c->at++;
        if (take(c, "u")) {
            char bytes[4];
            uint32_t code = take_escape(c);
            size_t n = code > 0 ? ceduo_utf8_encode(code, bytes) : 0;
            good = n > 0;
            ceduo_text_add(&text, bytes, n);
        } else if (c->at < c->end) {
            ceduo_text_char(&text, *c->at++);
        }
    }
    good = good && take(c, "\"") && !text.failed;
    arena->failed |= text.failed; /* no memory, and nothing wrong with the string */
    char *string = good ? ceduo_arena_string(arena, ceduo_text_string(&text)) : NULL;
    ceduo_text_free(&text);
    return string;
}

static bool take_data(struct cursor *c, const char *name, const unsigned char **bytes, size_t *n)
{
    if (!take(c, name))
        return false;
    char *from = c->at, *quote = memchr(from, '"', (size_t)(c->end - from));
    if (!quote)
        return false;
    c->at = quote + 1;
    *bytes = (const unsigned char *)from;
    return take_base64(from, (size_t)(quote - from), n);
}

/* Whether the line ends in the sum of what stands before. Sets its end to before the sum. */
static enum part_fault check_sum(struct cursor *c)
{
    size_t n = (size_t)(c->end - c->at);
    if (n < SUM_LENGTH || memcmp(c->end - 2, "\"}", 2) != 0)
        return PART_CUT;
    struct cursor tail = {c->end - SUM_LENGTH, c->end};
    uint64_t sum;
    if (!take(&tail, SUM) || !take_hex(&tail, 16, &sum) || sum != hash_bytes(c->at, n - SUM_LENGTH))
        return PART_CHANGED;
    c->end -= SUM_LENGTH;
    return PART_GOOD;
}

enum part_fault ceduo_part_read(struct arena *arena, struct part *part, char *line, size_t n)
{
    struct cursor c = {line, line + n};
    if (!take(&c, START)) /* a beginning of it alone is a part that was cut */
        return n > 0 && n < sizeof START - 1 && memcmp(line, START, n) == 0 ? PART_CUT : PART_NONE;
    if (c.at < c.end && !take(&c, FORMAT "\", \"version\": \""))
        return (size_t)(c.end - c.at) > 1 && memcmp(c.at, FORMAT "\"", 2) != 0 ? PART_FORMAT : PART_CUT;
    struct cursor whole = {line, line + n};
    enum part_fault fault = check_sum(&whole);
    if (fault != PART_GOOD)
        return fault;
    c.end = whole.end;
    char *version = take_string(arena, &c);
    if (!version)
        return arena->failed ? PART_MEMORY : PART_CHANGED;
    part->scene = version;
    if (strcmp(version, CEDUO_VERSION) != 0)
        return PART_VERSION;
    part->scene = take(&c, ", \"scene\": \"") ? take_string(arena, &c) : NULL;
    if (!part->scene)
        return arena->failed ? PART_MEMORY : PART_CHANGED;
    bool good = take_count(&c, ", \"place\": ", 1, 1e9, &part->place) &&
                take_count(&c, ", \"shard\": ", 1, SHARDS_MOST, &part->shard) &&
                take_count(&c, ", \"shards\": ", (double)part->shard, SHARDS_MOST, &part->shards) &&
                take_count(&c, ", \"rocks\": ", 1, CEDUO_ROCKS_MOST, &part->rocks) && take_points(&c, &part->points) &&
                take(&c, ", \"seconds\": ") && take_seconds(&c, &part->seconds) && take(&c, ", \"hash\": \"") &&
                take_hex(&c, 16, &part->key) && take_data(&c, "\", \"inputs\": \"", &part->inputs, &part->inputs_length) &&
                take_data(&c, ", \"runs\": \"", &part->runs, &part->runs_length) && c.at == c.end;
    return good ? PART_GOOD : PART_CHANGED;
}

/* ---- bytes ---- */

static void pack_count(struct bytes *b, uint64_t value)
{
    ceduo_bytes_count(b, &value);
}

static void pack_string(struct bytes *b, const char *string, size_t n)
{
    pack_count(b, string ? n : UINT64_MAX);
    unsigned char *to = string ? ceduo_bytes_write(b, n) : NULL;
    if (to)
        memcpy(to, string, n);
}

static void pack_word(struct bytes *b, const char *word)
{
    pack_string(b, word, word ? strlen(word) : 0);
}

static void pack_words(struct bytes *b, const char *const *words, size_t n)
{
    pack_count(b, n);
    for (size_t i = 0; i < n; i++)
        pack_word(b, words[i]);
}

/* ---- the key ---- */

static void pack_node(struct bytes *b, const struct node *node)
{
    pack_count(b, (uint64_t)node->kind << 1 | node->quoted);
    pack_word(b, node->key);
    pack_word(b, node->text);
    pack_count(b, node->n);
    for (size_t i = 0; i < node->n; i++)
        pack_node(b, node->items[i]);
}

uint64_t ceduo_part_key(const struct scene_file *file, uint64_t rocks, uint64_t points)
{
    const struct ceduo_scene *scene = &file->scene;
    double x = scene->slope.origin_x, z = scene->slope.origin_z;
    struct bytes b = {0};
    pack_count(&b, rocks);
    pack_count(&b, points);
    pack_word(&b, scene->title);
    ceduo_bytes_number(&b, &x);
    ceduo_bytes_number(&b, &z);
    pack_count(&b, ceduo_scene_key(scene));
    for (size_t i = 0; i < scene->options_count; i++)
        pack_count(&b, ceduo_option_key(scene, &scene->options[i]));
    pack_node(&b, file->root);
    uint64_t key = b.no_memory ? 0 : hash_bytes(b.to, b.length);
    free(b.to);
    return key;
}

/* ---- inputs ---- */

unsigned char *ceduo_part_inputs(const struct part_inputs *in, size_t *n)
{
    struct bytes b = {0};
    uint64_t finds = 0, files = 0;
    pack_word(&b, in->path);
    pack_words(&b, in->sets.items, in->sets.n);
    pack_words(&b, in->options.items, in->options.n);
    for (const struct shelf_find *f = in->shelf.finds; f; f = f->before)
        finds++;
    pack_count(&b, finds);
    for (const struct shelf_find *f = in->shelf.finds; f; f = f->before) {
        const char *const words[] = {f->name, f->beside, f->folder, f->path};
        pack_words(&b, words, 4);
    }
    for (const struct shelf_file *f = in->shelf.files; f; f = f->before)
        files++;
    pack_count(&b, files);
    for (const struct shelf_file *f = in->shelf.files; f; f = f->before) {
        pack_word(&b, f->path);
        pack_string(&b, f->bytes, f->length);
    }
    *n = b.length;
    if (!b.no_memory)
        return b.to;
    free(b.to);
    return NULL;
}

/* NULL: none was written, or it is not there (b->bad). The bytes of a word have no NUL. */
static const char *unpack_word(struct arena *arena, struct bytes *b)
{
    uint64_t length;
    ceduo_bytes_count(b, &length);
    if (length == UINT64_MAX || b->bad)
        return NULL;
    const unsigned char *from = ceduo_bytes_read(b, (size_t)length);
    b->bad |= from && memchr(from, '\0', (size_t)length) != NULL;
    return b->bad ? NULL : ceduo_arena_copy(arena, (const char *)from, (size_t)length);
}

/* Words that must all be there. */
static struct part_words unpack_words(struct arena *arena, struct bytes *b)
{
    uint64_t count;
    ceduo_bytes_count(b, &count);
    b->bad |= count > ceduo_bytes_left(b) / 8;
    const char **words = b->bad ? NULL : ceduo_arena_take(arena, ((size_t)count + 1) * sizeof *words);
    b->bad |= !words;
    for (uint64_t i = 0; i < count && !b->bad; i++) {
        words[i] = unpack_word(arena, b);
        b->bad |= !words[i];
    }
    return (struct part_words){words, b->bad ? 0 : (size_t)count};
}

static void unpack_find(struct arena *arena, struct bytes *b, struct shelf *shelf)
{
    uint64_t four;
    ceduo_bytes_count(b, &four);
    b->bad |= four != 4;
    const char *words[4];
    for (size_t i = 0; i < 4; i++)
        words[i] = unpack_word(arena, b);
    b->bad |= !words[0] || !words[3] || !ceduo_shelf_find(arena, shelf, words[0], words[1], words[2], words[3]);
}

static void unpack_file(struct arena *arena, struct bytes *b, struct shelf *shelf)
{
    const char *path = unpack_word(arena, b);
    uint64_t length;
    ceduo_bytes_count(b, &length);
    b->bad |= !path;
    const unsigned char *from = ceduo_bytes_read(b, (size_t)length);
    /* readers of text want a NUL behind it */
    const char *copy = from ? ceduo_arena_copy(arena, (const char *)from, (size_t)length) : NULL;
    b->bad |= !copy || !ceduo_shelf_file(arena, shelf, path, copy, (size_t)length);
}

bool ceduo_part_inputs_read(struct arena *arena, struct part_inputs *in, const unsigned char *bytes, size_t n)
{
    struct bytes b = {.reads = true, .from = bytes, .length = n};
    uint64_t count;
    *in = (struct part_inputs){.path = unpack_word(arena, &b)};
    in->sets = unpack_words(arena, &b);
    in->options = unpack_words(arena, &b);
    ceduo_bytes_count(&b, &count);
    for (uint64_t i = 0; i < count && !b.bad; i++)
        unpack_find(arena, &b, &in->shelf);
    ceduo_bytes_count(&b, &count);
    for (uint64_t i = 0; i < count && !b.bad; i++)
        unpack_file(arena, &b, &in->shelf);
    in->shelf.closed = true;
    return in->path && !b.bad && ceduo_bytes_left(&b) == 0; /* what has no memory is bad, too */
}
