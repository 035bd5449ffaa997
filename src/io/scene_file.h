/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENE_FILE_H
#define CEDUO_SCENE_FILE_H

#include "bind.h"
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

#endif
