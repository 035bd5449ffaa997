/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALUE_H
#define CEDUO_VALUE_H

#include "schema.h"

/* Numbers of a scene by their paths. A path is looked up once (600 ns); then its number is read and set in place (50 ns), without
 * text and memory. For searches, sensitivity and calibration, which set many values. */

enum value_part { VALUE_WHOLE, VALUE_SPREAD };

struct value {
    const struct field *field; /* unit, range, meaning */
    enum value_part part;      /* of a number with a spread: its mean, or the spread */
    void *at;                  /* in the scene */
    size_t n, stride;          /* n copies, `stride` bytes apart: a segment may be for all stretches */
    double origin;             /* SI: subtracted to be relative to the slope's first vertex */
    double *relative;          /* the relative number, while `at` holds the given one; NULL: `at` is relative */
    double *other;             /* the same value by another key, which a put makes not given; NULL: none */
};

/* Look up the number at a path of --set, such as forest[0].stand.trees[0].per_ha or rock.density_kg_m3.spread. A word of a choice is
 * its index in field->choices. Ground from materials has one of slope.segments[] for each stretch. False if the path is unknown, of a
 * text or flag, or of a value that the scene does not hold as its files do (materials). The value points into the scene. */
bool ceduo_value_find(struct ceduo_scene *scene, const char *path, struct value *value);

/* Return the number in the file's unit; NaN if it is not given. */
double ceduo_value_get(const struct value *value);

/* Set the number, in the file's unit. False if it lies outside its range: nothing changes. ceduo_scene_check() checks the rest of the
 * scene. No other thread may read the scene meanwhile. */
bool ceduo_value_set(const struct value *value, double number);

/* Make an optional number one that is not given. */
void ceduo_value_forget(const struct value *value);

#endif
