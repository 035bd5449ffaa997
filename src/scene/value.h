/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALUE_H
#define CEDUO_VALUE_H

#include "schema.h"

/* Access to numbers of a scene by path. A path is looked up once (600 ns); then its number is read and set in place (50 ns),
 * without parsing and allocation. For searches, sensitivity and calibration, which set many values. */

enum value_part { VALUE_WHOLE, VALUE_SPREAD };

struct value {
    const struct field *field; /* unit, range, meaning */
    enum value_part part;      /* mean or spread of a number with a spread */
    void *member;              /* in the scene */
    size_t n, stride;          /* n copies, `stride` bytes apart, if a segment applies to the whole slope */
    double origin;             /* SI: subtracted to be relative to the slope's first vertex */
    double *relative;          /* the relative place; `member` holds the given one; NULL: `member` is relative */
    double *alternative;       /* the value by its alternative key, set to NaN by ceduo_value_set(); NULL: none */
};

/* Look up the number at a path of --set, such as forest[0].stand.trees[0].per_ha or rock.density_kg_m3.spread. A word of a
 * choice is its index in field->choices. Ground from materials has one slope.segments[] per stretch. False if the path is
 * unknown, is a text or flag, or is stored in another form than in the file (materials). The value points into the scene. */
bool ceduo_value_find(struct ceduo_scene *scene, const char *path, struct value *value);

/* Return the number in the file's unit; NaN if it is not given. */
double ceduo_value_get(const struct value *value);

/* Set the number, in the file's unit. False if it is outside its range; nothing changes then. ceduo_scene_check() checks the
 * rest of the scene. No other thread may read the scene during the call. */
bool ceduo_value_set(const struct value *value, double number);

/* Set an optional number to not given. */
void ceduo_value_forget(const struct value *value);

#endif
