/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_RANGES_H
#define CEDUO_RANGES_H

#include "material.h"
#include "schema.h"

/* Default uncertainty range of an assumed value. */
struct range {
    const char *path; /* example path of the value */
    enum ceduo_input_kind kind;
    double lo, hi;        /* as in struct ceduo_input; unused for words */
    const char *words[3]; /* CEDUO_INPUT_WORDS; NULL after the last */
    const char *source;   /* of the range; marked for translation */
    const char *measured; /* how to measure the value; marked for translation; NULL: impossible */
    bool research;        /* true: only research measures it, so that no page advises it */
};

/* Return all rows, for the manual. */
const struct range *ceduo_ranges(size_t *n);

/* Return the range of a row of the table of keys; NULL if the value is not varied. */
const struct range *ceduo_range_find(const struct field *field);

/* Return the range of rn, rt, roughness_m, friction or mu of a ground of the library. */
struct range ceduo_range_find_material(const struct ceduo_material *material, const char *key);

#endif
