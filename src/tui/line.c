/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "line.h"

#include <stdint.h>
#include <string.h>

#include "base/utf8.h"
#include "keys.h"

void ceduo_line_set(struct line *line, const char *text)
{
    size_t n = strlen(text);
    if (n >= sizeof line->text)
        n = 0; /* too long to be edited in a line */
    memcpy(line->text, text, n);
    line->text[n] = '\0';
    line->at = n;
    line->fresh = true;
}

static size_t before(const struct line *line, size_t at)
{
    while (at > 0 && ((unsigned char)line->text[--at] & 0xc0) == 0x80)
        continue;
    return at;
}

static size_t after(const struct line *line, size_t at)
{
    do
        at++;
    while (((unsigned char)line->text[at] & 0xc0) == 0x80);
    return at;
}

static void cut(struct line *line, size_t from, size_t to)
{
    memmove(line->text + from, line->text + to, strlen(line->text + to) + 1);
    line->at = from;
}

/* UTF-8 of a code point. */
static size_t encode(uint32_t c, char out[4])
{
    if (c < 0x80) {
        out[0] = (char)c;
        return 1;
    }
    size_t n = c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    for (size_t i = n; i-- > 1; c >>= 6)
        out[i] = (char)(0x80 | (c & 0x3f));
    static const unsigned char lead[5] = {0, 0, 0xc0, 0xe0, 0xf0};
    out[0] = (char)(lead[n] | c);
    return n;
}

static bool insert(struct line *line, int key)
{
    char bytes[4];
    size_t n = encode((uint32_t)key, bytes), length = strlen(line->text);
    if (length + n + 1 > sizeof line->text)
        return true; /* full */
    memmove(line->text + line->at + n, line->text + line->at, length - line->at + 1);
    memcpy(line->text + line->at, bytes, n);
    line->at += n;
    return true;
}

bool ceduo_line_key(struct line *line, int key)
{
    bool fresh = line->fresh;
    line->fresh = false;
    if (fresh && ((key >= ' ' && key < K_SPECIAL) || key == K_BACKSPACE))
        cut(line, 0, strlen(line->text));
    switch (key) {
    case K_LEFT:
        line->at = line->at > 0 ? before(line, line->at) : 0;
        return true;
    case K_RIGHT:
        line->at = line->text[line->at] ? after(line, line->at) : line->at;
        return true;
    case K_HOME:
        line->at = 0;
        return true;
    case K_END:
        line->at = strlen(line->text);
        return true;
    case K_BACKSPACE:
        if (line->at > 0)
            cut(line, before(line, line->at), line->at);
        return true;
    case K_DELETE:
        if (line->text[line->at])
            cut(line, line->at, after(line, line->at));
        return true;
    case K_CTRL_U:
        cut(line, 0, line->at);
        return true;
    default:
        return key >= ' ' && key < K_SPECIAL && !(key >= 0x7f && key < 0xa0) && insert(line, key);
    }
}
