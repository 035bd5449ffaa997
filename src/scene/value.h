/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALUE_H
#define CEDUO_VALUE_H

#include "schema.h"

/* Numbers of a scene by their paths: a path is looked up once, then its number is read and set in place, without text and
 * without memory: some 50 ns, where looking up the path takes some 600. For whoever tries many values: searches, steps, sensitivity, calibration. */

enum value_part { VALUE_WHOLE, VALUE_SPREAD };

struct value {
    const struct field *field; /* unit, range, meaning */
    enum value_part part;      /* of a number with a spread: its mean, or the spread */
    void *at;                  /* where it stands in the scene; */
    size_t n, stride;          /* n times, so many bytes apart: a segment may be for all stretches */
    double origin;             /* what is taken off it (SI) to be relative to the slope's first vertex: */
    double *relative;          /* here, and `at` holds it as given; NULL: `at` itself is relative */
    double *other;             /* what says the same in another way, and is no longer given once this is put; NULL: none */
};

/* Looks up the number at a path as --set has it: forest[0].stand.trees[0].per_ha, rock.density_kg_m3.spread. False where
 * there is none: an unknown path, a text or a flag, what the scene does not hold as its files do (materials). A word of a
 * choice is a number too: its index in field->choices. Ground from materials has one of slope.segments[] for each stretch.
 * The value points into the scene, and is good for as long as the scene and its lists are. */
bool ceduo_value_find(struct ceduo_scene *scene, const char *path, struct value *value);

/* The number in the file's unit; NaN where it is not given. */
double ceduo_value_get(const struct value *value);

/* Sets it, in the file's unit. False where it lies outside its range: nothing is changed. Whether it fits the rest of the
 * scene ceduo_scene_check() says; a scene that somebody else reads meanwhile must not be set. */
bool ceduo_value_put(const struct value *value, double number);

/* Makes it one that is not given, where it need not be. */
void ceduo_value_forget(const struct value *value);

#endif
