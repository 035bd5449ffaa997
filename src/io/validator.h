/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALIDATOR_H
#define CEDUO_VALIDATOR_H

#include "bind.h"
#include "ceduo/doubt.h"
#include "ceduo/observe.h"
#include "ceduo/slope.h"

/* A scene that is being checked, and what every check needs: each subject has a file of its own, validate_*.c. */

struct scene_file;
struct validator {
    struct scene_file *file; /* notes, inputs and observations go there as they are found */
    struct arena *arena;     /* its own, and its notes: */
    const struct source_note **notes;
    const struct node *root; /* the scene, with what it refers to in place */
    struct problems *problems;
    bool warns;                        /* of numbers that are good, but unusual */
    const struct scene_file *previous; /* as it was: a slope is taken over where its part of the document is the same */
    struct scene_draft draft;          /* its scene is the result */
    struct bad_values bad;
    bool sized_by_blocks; /* the scene's rock has no size of its own */
    bool profile;         /* the slope has its vertices */
    double origin;        /* the slope's first x, which is taken off every x */
    size_t inputs_room, rows_room;
    const char **rows;        /* of each input where it is written; NULL: in a table of draws */
    const struct node *draws; /* of doubt: a table of values that a calibration left open; NULL: none */
};

/* Makes a scene of the values in its files, and checks it: places become relative to the slope's first vertex, materials
 * become ground, controls_m controls, a forest an option. What is wrong is reported at the node that it comes from. False where
 * there is so much wrong, or no memory, that there is nothing to go on with. */
bool ceduo_validate(struct validator *v);

/* Its checks by subject, in the order in which the scene is built. */

void ceduo_validate_rock(struct validator *v, const char *path, const struct ceduo_rock_def *def);
void ceduo_validate_blocks(struct validator *v);
void ceduo_validate_slope(struct validator *v);
void ceduo_simplify_slope(struct validator *v); /* requires the release, which stays a vertex */
double ceduo_validate_end(void *validator);     /* the last x of the profile, before it is validated; NaN: not known */
void ceduo_validate_release(struct validator *v, const char *path, struct ceduo_release *release);
void ceduo_validate_controls(struct validator *v);
void ceduo_validate_options(struct validator *v);
void ceduo_validate_doubt(struct validator *v);
void ceduo_validate_ends(struct validator *v); /* requires a scene and rows of doubt that are good */
void ceduo_validate_observed(struct validator *v);

/* What was observed may be written in several forms: brings them into the one that the table of keys has. */
void ceduo_arrange_observed(struct validator *v);

/* ---- what they need ---- */

/* Reports a problem at a path, or at a key ("": none) of the mapping there, with the line and column of the deepest node. Of a
 * file that may be none of ceduo's, the message is without its values. False, so that a check can end with it. */
bool ceduo_complain(struct validator *v, const char *path, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A string in the arena as printf() makes it, such as the path of an item; "" without memory. */
const char *ceduo_format(struct validator *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The words of a choice with a comma between them, and the range of a field. */
const char *ceduo_words(struct validator *v, const struct choices *choices);
const char *ceduo_range(struct validator *v, const struct field *field);

/* Room for n + 1 items in the arena. NULL without memory. */
void *ceduo_room(struct validator *v, size_t n, size_t size);

/* Whether nothing is wrong with a value or what it stands in; what is wrong within it does not count. */
bool ceduo_is_known(struct validator *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same, and nothing is wrong within it. */
bool ceduo_is_sound(struct validator *v, const char *path);

/* Whether something stands at a key of the mapping at `path`, though it may be wrong. */
bool ceduo_is_given(struct validator *v, const char *path, const char *key);

/* Adds an assumption of the program itself to those of the files. */
void ceduo_assume(struct validator *v, const char *path, const char *text);

/* Note what was understood of a table, in one line. */
void ceduo_understand(struct validator *v, const char *path, const char *line);

/* Reports a list that is longer than anybody reads. */
bool ceduo_is_too_long(struct validator *v, const char *path, size_t n);

/* Whether x, in the slope's coordinates, lies on the profile (or that is not known); otherwise it is reported. */
bool ceduo_check_on_slope(struct validator *v, const char *path, const char *key, double x);

/* The same of a stretch, from_m to to_m of the mapping at `path`, which ends behind its begin. */
bool ceduo_check_stretch(struct validator *v, const char *path, double from, double to);
bool ceduo_check_ends_behind(struct validator *v, const char *path, double from, double to);

/* Reports a name that one of the first i - 1 items of a list has, too. */
void ceduo_check_name(struct validator *v, const char *list, size_t i, const char *name, const char *other);

#endif
