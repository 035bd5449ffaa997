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
    line->asked = false;
}

static void cut(struct line *line, size_t from, size_t to)
{
    memmove(line->text + from, line->text + to, strlen(line->text + to) + 1);
    line->at = from;
}

bool ceduo_line_key(struct line *line, int key)
{
    bool fresh = line->fresh;
    line->fresh = line->asked = false;
    if (fresh && ((key >= ' ' && key < K_SPECIAL) || key == K_BACKSPACE))
        cut(line, 0, strlen(line->text));
    char bytes[4], *at = line->text + line->at;
    size_t before = (size_t)(ceduo_utf8_back(line->text, at) - line->text);
    size_t after = line->at + (*at ? ceduo_utf8_step(at) : 0);
    if (key == K_LEFT)
        line->at = before;
    else if (key == K_RIGHT)
        line->at = after;
    else if (key == K_HOME)
        line->at = 0;
    else if (key == K_END)
        line->at = strlen(line->text);
    else if (key == K_BACKSPACE)
        cut(line, before, line->at);
    else if (key == K_DELETE)
        cut(line, line->at, after);
    else if (key == K_CTRL_U)
        cut(line, 0, line->at);
    else if (key < K_SPECIAL && ceduo_utf8_printable((uint32_t)key)) {
        size_t n = ceduo_utf8_encode((uint32_t)key, bytes), rest = strlen(at) + 1;
        if (line->at + rest + n > sizeof line->text)
            return true; /* full */
        memmove(at + n, at, rest);
        memcpy(at, bytes, n);
        line->at += n;
    } else
        return false;
    return true;
}

bool ceduo_line_paste(struct line *line, const char *text)
{
    size_t n = strlen(text), kept = line->fresh ? 0 : strlen(line->text);
    bool begun = false, gap = false;
    if (kept + n >= sizeof line->text)
        return false;
    for (size_t i = 0, step; i < n; i += step) {
        uint32_t code = 0;
        step = ceduo_utf8_decode(text + i, n - i, &code);
        step = step > 0 ? step : 1;
        gap |= code == '\n' || code == '\r' || code == '\t';
        if (!ceduo_utf8_printable(code))
            continue;
        if (begun && gap)
            ceduo_line_key(line, ' ');
        ceduo_line_key(line, (int)code);
        begun = true;
        gap = false;
    }
    return true;
}
