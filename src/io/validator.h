/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VALIDATOR_H
#define CEDUO_VALIDATOR_H

#include "bind.h"

/* Validation of a scene. Each subject has a file, validate_*.c. */

struct scene_file;
struct validator {
    struct scene_file *file;          /* receives notes, inputs and observations */
    struct arena *arena;              /* of `file` */
    const struct source_note **notes; /* of `file` */
    const struct node *root;          /* of the scene, references resolved */
    struct problems *problems;
    bool warns;                        /* report valid numbers that are unusual */
    const struct scene_file *previous; /* last state of the scene: its slope is reused if the document's slope is unchanged */
    struct scene_draft draft;          /* contains the resulting scene */
    struct invalid_values invalid;
    bool sized_by_blocks; /* the scene's rock has no size of its own */
    bool has_profile;     /* the slope has its vertices */
    double origin;        /* first x of the slope, m; subtracted from every x */
    size_t inputs_capacity, rows_capacity;
    const char **rows;        /* path of the row of each input; NULL: from a table of draws */
    const struct node *draws; /* table of calibration draws, named in `uncertainty`; NULL: none */
};

/* Build a scene from the values of its files and check it. Places become relative to the first vertex of the slope. Materials
 * become ground, controls_m becomes controls, a forest becomes an option. Return false if the errors, or missing memory,
 * prevent further checks. */
bool ceduo_validate(struct validator *v);

/* Checks by subject, in the order in which the scene is built. */

void ceduo_validate_rock(struct validator *v, const char *path, const struct ceduo_rock_def *def);
void ceduo_validate_blocks(struct validator *v);
void ceduo_validate_slope(struct validator *v);
void ceduo_simplify_slope(struct validator *v);    /* requires the release, which stays a vertex */
double ceduo_validate_end(void *validator);        /* last x of the profile, m, before it is validated; NaN: unknown */
void ceduo_validate_releases(struct validator *v); /* all releases of the scene */
/* Return the path of the places of all releases. */
static inline const char *ceduo_release_places(const struct validator *v)
{
    return v->draft.scene.releases_count > 0 ? "release" : "release.x_m";
}
void ceduo_validate_release(struct validator *v, const char *path, struct ceduo_release *release);
void ceduo_validate_controls(struct validator *v);
void ceduo_validate_options(struct validator *v);
void ceduo_validate_uncertainty(struct validator *v);
void ceduo_validate_ends(struct validator *v); /* requires a valid scene and valid rows of uncertainty */
void ceduo_validate_observed(struct validator *v);

/* Convert the forms in which observations may be written to the form of the table of keys. */
void ceduo_arrange_observed(struct validator *v);

/* ---- tools ---- */

/* Return the place of the deepest node on the way to a path, or to a key ("": none) of the mapping there. */
struct problem_place ceduo_find_place(struct validator *v, const char *path, const char *key);

/* Report an error at a path, or at a key ("": none) of the mapping there, with the line and column of the deepest node. If the
 * file is not recognized, the message quotes no value of it. Return false. */
bool ceduo_reject(struct validator *v, const char *path, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Report a warning at such a place; the scene stays valid. */
void ceduo_warn(struct validator *v, const char *path, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Print to a string in the arena, such as the path of an item. Return "" without memory. */
const char *ceduo_asprintf(struct validator *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Return the words of a choice, separated by commas; the range of a field as text. */
const char *ceduo_list_choices(struct validator *v, const struct choices *choices);
const char *ceduo_describe_range(struct validator *v, const struct field *field);

/* Allocate n + 1 items in the arena. NULL on failure. */
void *ceduo_alloc(struct validator *v, size_t n, size_t size);

/* True if a value and the mappings and lists around it are valid. Values within it are not considered. */
bool ceduo_is_valid(struct validator *v, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* True if, in addition, every value within it is valid. */
bool ceduo_is_valid_below(struct validator *v, const char *path);

/* True if the mapping at `path` has the key, valid or not. */
bool ceduo_is_given(struct validator *v, const char *path, const char *key);

/* Add an assumption of the program to those of the files. */
void ceduo_assume(struct validator *v, const char *path, const char *text);

/* Add a note of one line on how a table was read. */
void ceduo_add_table_note(struct validator *v, const char *path, const char *line);

/* Report a list of more than CEDUO_ITEMS_MAX items. Return true if it is too long. */
bool ceduo_is_too_long(struct validator *v, const char *path, size_t n);

/* True if x, in the coordinates of the file, lies on the profile, or if the profile is unknown; otherwise reports it. */
bool ceduo_check_on_slope(struct validator *v, const char *path, const char *key, double x);

/* Check a stretch, from_m to to_m of the mapping at `path`: it lies on the profile and ends after it begins; only the
 * latter. */
bool ceduo_check_stretch(struct validator *v, const char *path, double from, double to);
bool ceduo_check_order(struct validator *v, const char *path, double from, double to);

/* Report that item i of a list has the name of an earlier item. */
void ceduo_check_name(struct validator *v, const char *list, size_t i, const char *name, const char *earlier);

#endif
