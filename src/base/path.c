/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "path.h"

#include <string.h>

bool ceduo_path_next(const char *path, size_t length, size_t *at, struct path_step *step)
{
    size_t i = *at;
    if (i >= length)
        return false;
    if (path[i] == '[') {
        const char *end = memchr(path + i, ']', length - i);
        if (!end || end == path + i + 1)
            return false;
        *step = (struct path_step){path + i + 1, (size_t)(end - path) - i - 1, true};
        *at = (size_t)(end - path) + 1;
        return true;
    }
    if (i > 0) {
        if (path[i] != '.')
            return false;
        i++;
    }
    size_t from = i;
    while (i < length && path[i] != '.' && path[i] != '[')
        i++;
    if (i == from)
        return false;
    *step = (struct path_step){path + from, i - from, false};
    *at = i;
    return true;
}

bool ceduo_path_is(const struct path_step *step, const char *word)
{
    return word && strlen(word) == step->n && memcmp(step->p, word, step->n) == 0;
}

bool ceduo_path_index(const struct path_step *step, size_t *index)
{
    *index = 0;
    for (size_t i = 0; i < step->n; i++) {
        if (step->p[i] < '0' || step->p[i] > '9' || i > 8)
            return false;
        *index = *index * 10 + (size_t)(step->p[i] - '0');
    }
    return true;
}
