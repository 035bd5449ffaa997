/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENE_FILE_H
#define CEDUO_SCENE_FILE_H

#include "bind.h"
#include "ceduo/doubt.h"
#include "ceduo/scene.h"

/* A scene as read from its files. Everything that it points to lives in its arena. */
struct scene_file {
    struct arena arena;
    const char *path;        /* where it was found */
    const char *name;        /* as results call it: the path, or of a scene of the profiles what its file is called */
    const struct node *raw;  /* as it is written in its file */
    const struct node *root; /* the scene, with what it refers to in place */
    struct ceduo_scene scene;
    const struct source_note *notes; /* where values come from, last first */
    const struct node *slope_node;   /* that scene.slope was made from */
    size_t inputs_count;             /* what it says is not known, then what its stands say */
    size_t inputs_of_scene;
    struct ceduo_input *inputs;
    size_t observations_count; /* what was seen there */
    struct ceduo_observation *observations;
    size_t kept_count; /* options of the file that --option kept, by their numbers there; `kept` NULL: all */
    const size_t *kept;
    bool ground_assumed; /* the slope's file says no ground: talus was taken */
};

/* Reads a scene ("-": standard input; a name without a file: a shipped scene), applies `sets` (PATH=VALUE, from left to
 * right) and checks it. False where something is wrong: see `problems`. Release it in any case. */
bool ceduo_scene_load(struct scene_file *file, const char *path, const char *const *sets, size_t n, struct problems *problems);
/* The same where the last of the n sets are cells of `row`, which messages call so: "slopes.csv:17". */
struct scene_sets {
    const char *const *items;
    size_t n, cells;
    const char *row;
};
bool ceduo_scene_load_row(struct scene_file *file, const char *path, const struct scene_sets *sets, struct problems *problems);
/* The same from text in memory. */
bool ceduo_scene_load_text(struct scene_file *file, const char *name, const char *text, struct problems *problems);
void ceduo_scene_release(struct scene_file *file);

/* The scene of a document that was read before: sets `file->scene` from `file->root`. */
bool ceduo_scene_bind(struct scene_file *file, struct problems *problems);

/* Changes one value. `set` is PATH=VALUE; problems are reported as those of the option of the command line. */
bool ceduo_scene_set(struct scene_file *file, const char *option, const char *set, struct problems *problems);

/* True where the note of a value (ceduo_notes_find()) calls it an assumption. */
bool ceduo_scene_assumes_value(const struct scene_file *file, const char *path);

/* ---- inputs (doubt_inputs.c) ---- */

/* The inputs of a scene: what its `doubt` names, and every value that is marked as assumed and has a range (ranges.h).
 * Values that come from one line of one file are one input, as are all energy laws, and for each species the strength of its wood and its growth, as all stands grow on one slope. Inputs that
 * change today's figures come first. */
struct scene_inputs {
    size_t n;
    struct ceduo_input *items; /* in the arena of the scene's file */
};

/* False without memory. `doubt: none`: there are none. */
bool ceduo_inputs_of(struct scene_file *file, struct scene_inputs *inputs);

/* Removes the inputs that change years to come alone. */
void ceduo_inputs_keep_today(struct scene_inputs *inputs);

/* The places of a path that is to be fitted, to input->places: [*] stands for all items, slope.materials[NAME].KEY for a ground.
 * NULL where it is not a number of any scene; the scene may have no such place. */
const struct field *ceduo_input_find(struct scene_file *file, const char *path, struct ceduo_input *input);

/* Number of places of a path, which may have [*]; 0: not every item has such a value, so that it cannot be set. */
size_t ceduo_input_count_places(struct scene_file *file, const char *path);

/* Whether one of n inputs has a place, written either way. */
bool ceduo_inputs_have(const struct ceduo_input *inputs, size_t n, const char *place);

/* Whether some place is of both. */
bool ceduo_input_shares(const struct ceduo_input *a, const struct ceduo_input *b);

/* The belt that a place is in, forest[0].stand… or options[2].forest[0].stand…; NULL: it is in none. */
const struct ceduo_belt *ceduo_input_belt(const struct ceduo_scene *scene, const char *place);

/* Paths of the segments of a ground of the library, one for each stretch; returns how many. `root` NULL: talus was taken for all.
 * `assumed`: only stretches for which the scene does not say the value itself. */
size_t ceduo_input_ground(struct arena *arena, const struct node *root, const struct ceduo_scene *scene, const char *material,
                          const char *key, bool assumed, const char **places);

/* The path of a place of the scene as --set has it, which knows all options of the file. NULL without memory. */
const char *ceduo_input_path(struct scene_file *file, const char *place);

#endif
