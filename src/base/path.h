/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PATH_H
#define CEDUO_PATH_H

#include <stdbool.h>
#include <stddef.h>

/* Paths of values: keys joined by '.', items of lists as [0] or [name]: forest[0].stand.trees[oak].per_ha */

/* One step of a path: a key, or what stands in brackets. */
struct path_step {
    const char *p;
    size_t n;
    bool bracket;
};

/* The step at *at, which then is behind it; false at the end or where the path is malformed (then *at stays). */
bool ceduo_path_next(const char *path, size_t length, size_t *at, struct path_step *step);

bool ceduo_path_is(const struct path_step *step, const char *word);

/* Whether a step is a place in a list. */
bool ceduo_path_index(const struct path_step *step, size_t *index);

#endif
