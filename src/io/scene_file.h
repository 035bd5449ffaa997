/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SCENE_FILE_H
#define CEDUO_SCENE_FILE_H

#include "bind.h"
#include "ceduo/calibrate.h"

/* A scene as read from its files. Everything that it points to lives in its arena. */
struct scene_file {
    struct arena arena;
    const char *path;        /* of the file that was found */
    const char *name;        /* in results: the path, or the name of a scene of the profiles without .yaml */
    const struct node *raw;  /* tree of the file */
    const struct node *root; /* tree with changes applied and references resolved */
    struct ceduo_scene scene;
    const struct source_note *notes; /* sources of values, the last first */
    const struct node *slope_node;   /* node of scene.slope */
    size_t inputs_count;
    size_t inputs_of_scene; /* of these, inputs of the scene's own `uncertainty`, which come first; the rest: of its stands */
    struct ceduo_input *inputs; /* uncertain inputs */
    size_t observations_count;
    struct ceduo_observation *observations;
    size_t kept_count;
    const size_t *kept;  /* indices in the file of the options kept by --option; NULL: all */
    bool ground_assumed; /* the file gives no ground: talus is assumed */
    unsigned changed;    /* lists that --set changed, by ceduo_scene_list(): they may have lost items */
};

/* Read a scene ("-": standard input; a name without a file: a shipped scene), apply `sets` (PATH=VALUE, from left to right) and
 * check it. Return false on error. Always call ceduo_scene_release(). */
bool ceduo_scene_load(struct scene_file *file, const char *path, const char *const *sets, size_t n, struct problems *problems);
/* Changes of a scene. The last `cells` of n are cells of a row, which messages name `row`: "slopes.csv:17". */
struct scene_sets {
    const char *const *items;
    size_t n, cells;
    const char *row;
};
bool ceduo_scene_load_row(struct scene_file *file, const char *path, const struct scene_sets *sets, struct problems *problems);
/* Read a scene from text in memory. */
bool ceduo_scene_load_text(struct scene_file *file, const char *name, const char *text, struct problems *problems);
void ceduo_scene_release(struct scene_file *file);

/* Return a bit for the part of the scene that a path begins with: controls, release, slope, or forest and options. 0: another
 * part, which has no items. */
unsigned ceduo_scene_list(const char *path);

/* Set `file->scene` from `file->root`. */
bool ceduo_scene_bind(struct scene_file *file, struct problems *problems);

/* Change one value. `set`: PATH=VALUE. Problems are reported at `option`, an option of the command line. */
bool ceduo_scene_set(struct scene_file *file, const char *option, const char *set, struct problems *problems);

/* True if the note of a value (ceduo_notes_find()) marks it as assumed. */
bool ceduo_scene_assumes_value(const struct scene_file *file, const char *path);

/* ---- inputs (uncertainty_inputs.c) ---- */

/* Uncertain inputs of a scene: the rows of `uncertainty`, and every value that is marked as assumed and has a range (ranges.h).
 * One input has all values from one line of a file. All energy laws are one input, and so are wood strength and growth of each
 * species, because all stands grow on one slope. Inputs that change today's figures come first. */
struct scene_inputs {
    size_t n;
    struct ceduo_input *items; /* in the arena of the scene's file */
};

/* Find the uncertain inputs; none with `uncertainty: none`. Return false on failure. */
bool ceduo_inputs_collect(struct scene_file *file, struct scene_inputs *inputs);

/* Remove the inputs that change future years only. */
void ceduo_inputs_keep_today(struct scene_inputs *inputs);

/* Set input->places to the places of a fitted path. [*] selects all items, slope.materials[NAME].KEY a ground. Return the
 * field; NULL if no scene has such a number. The number of places may be 0. */
const struct field *ceduo_input_find(struct scene_file *file, const char *path, struct ceduo_input *input);

/* Count the places of a path, which may have [*]; 0: at least one item has no such value, so the path cannot be set. */
size_t ceduo_input_count_places(struct scene_file *file, const char *path);

/* True if one of n inputs has a place, in either notation. */
bool ceduo_inputs_have(const struct ceduo_input *inputs, size_t n, const char *place);

/* True if two inputs have a place in common. */
bool ceduo_input_overlaps(const struct ceduo_input *a, const struct ceduo_input *b);

/* True if an input is a ground of the library: the scene has rows of `materials`, or talus is assumed. */
bool ceduo_input_is_library_ground(const struct ceduo_scene *scene, const struct ceduo_input *input);

/* Return the belt of a place, forest[0].stand… or options[2].forest[0].stand…; NULL: none. */
const struct ceduo_belt *ceduo_input_belt(const struct ceduo_scene *scene, const char *place);

/* Set `places` to the paths of the segments of a ground of the library, one for each stretch; return their number. `root` NULL:
 * talus is assumed everywhere. `assumed`: only stretches without a value of their own. */
size_t ceduo_input_ground(struct arena *arena, const struct node *root, const struct ceduo_scene *scene, const char *material,
                          const char *key, bool assumed, const char **places);

/* Return the path of a place for --set, which numbers all options of the file. NULL on failure. */
const char *ceduo_input_path(struct scene_file *file, const char *place);

#endif
