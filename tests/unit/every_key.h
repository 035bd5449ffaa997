/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes that together contain every key, and the place of a parameter in them. */
#ifndef EVERY_KEY_H
#define EVERY_KEY_H

#include "scene/schema.h"

static const char *const scenes[] = {"tests/unit/every_key/cylinder.yaml", "tests/unit/every_key/options.yaml",
                                     "tests/unit/every_key/grounds.yaml",  "tests/unit/every_key/profile.yaml",
                                     "tests/unit/every_key/block.yaml",    "tests/unit/every_key/low.yaml",
                                     "tests/unit/every_key/blocks.yaml",   "tests/unit/every_key/releases.yaml"};

/* Write the path of a parameter in the first item of each list; `point`: its index in a list of points. */
static inline void first_place(const char *path, const struct field *f, const char *point, struct text *to)
{
    for (; *path; path++) {
        ceduo_text_append_char(to, *path);
        if (*path == '[')
            ceduo_text_append_char(to, '0');
    }
    ceduo_text_append(to, f->type == FIELD_POINTS ? point : f->type == FIELD_NUMBERS || f->type == FIELD_SPREADS ? "[0]" : "");
}

#endif
