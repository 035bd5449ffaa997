/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_DERIVE_H
#define CEDUO_DERIVE_H

#include "bind.h"
#include "ceduo/doubt.h"
#include "ceduo/material.h"
#include "ceduo/observe.h"

/* What follows from the values of a scene once they are read into its draft: places relative to the slope's first vertex,
 * ground from materials, controls from controls_m, options from forest, and whether the parts fit together. What is wrong
 * is reported at the node that it comes from. */
struct deriver {
    struct arena *arena;
    const struct node *root; /* the scene, with what it refers to in place */
    struct problems *problems;
    const struct derived *last;
    struct scene_draft draft; /* its scene is what is made */
    const struct source_note *notes;
    struct bad_values bad;
    bool profile;        /* the slope has its vertices */
    bool ground_assumed; /* the slope's file says no ground: talus was taken */
    size_t inputs_count; /* what the scene says is not known, then what its stands say */
    size_t inputs_of_scene;
    struct ceduo_input *inputs;
    const struct node *draws; /* of doubt: a table of values that a calibration left open; NULL: none */
    size_t observations_count;
    struct ceduo_observation *observations;
    double origin; /* what was taken off every x */
};

/* What was made of a slope before: where its part of the document is still the same it is taken over. */
struct derived {
    const struct node *slope_node; /* NULL: none */
    struct ceduo_slope slope;
    const struct source_note *notes;
    bool ground_assumed;
    enum ceduo_law law;
};

/* False where there is so much wrong, or no memory, that there is nothing to go on with. */
bool ceduo_derive(struct deriver *d);

/* ---- its steps ---- */

/* A profile as its files give it. */
struct points {
    double *x, *z;
    size_t n;
    bool commas; /* for the decimals, as spreadsheets write them in Italian or German */
};

/* A profile from a CSV file as QGIS writes it: a header with the columns distance and elevation (x and z will do),
 * separated by comma, semicolon or tab. Where they are not separated by commas, commas may stand for the decimals.
 * False where that fails. */
bool ceduo_csv_slope_read(struct arena *arena, const char *path, struct points *points, struct problems *problems);

void ceduo_derive_blocks(struct deriver *d);
void ceduo_derive_slope(struct deriver *d);
void ceduo_derive_rock(struct deriver *d, const char *path, const struct node *node, const struct ceduo_rock_def *def);
void ceduo_derive_release(struct deriver *d, const char *path, struct ceduo_release *release);
void ceduo_derive_controls(struct deriver *d);
void ceduo_derive_options(struct deriver *d);
void ceduo_derive_doubts(struct deriver *d);
void ceduo_derive_observed(struct deriver *d);

/* What a calibration left open, from d->draws, as one input. False where there is none. */
bool ceduo_derive_draws(struct deriver *d, struct ceduo_input *input);

/* All places of a path, [*] and grounds unfolded, to input->places; NULL where it is no number of a scene. */
const struct field *ceduo_derive_find(struct deriver *d, const char *path, bool talus, struct ceduo_input *input);

/* What was seen may be written in several forms: brings them into the one that the table of keys has. */
void ceduo_observed_arrange(struct deriver *d);

/* ---- for its steps ---- */

void ceduo_derive_complain(struct deriver *d, const char *path, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The same at a path and what it goes on with. In the format %s stands for x, a second one for y. */
void ceduo_derive_refuse(struct deriver *d, const char *path, const char *within, const char *format, double x, double y);

/* A text in the arena, such as the path of an item. */
const char *ceduo_derive_text(struct deriver *d, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Whether nothing is wrong with a value or what it stands in; what is wrong within it does not count. */
bool ceduo_derive_known(struct deriver *d, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The same, and nothing within it. */
bool ceduo_derive_sound(struct deriver *d, const char *path);

/* Whether something stands there, though it may be wrong. */
bool ceduo_derive_given(struct deriver *d, const char *group, const char *key);

/* Adds an assumption of the program itself to those of the files. */
void ceduo_derive_assume(struct deriver *d, const char *path, const char *text);

/* Reports a list that is longer than anybody reads. */
bool ceduo_derive_too_many(struct deriver *d, const char *path, size_t n);

#endif
