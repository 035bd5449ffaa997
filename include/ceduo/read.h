/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_READ_H
#define CEDUO_READ_H

#include "observe.h"
#include "uncertainty.h"

/* A scene as its files have it. What it points to belongs to the reading: numbers may be changed in place, and pointers may be
 * set to memory of the caller, which is not freed. */
struct ceduo_scene_file {
    struct ceduo_scene scene;
    size_t inputs_count; /* what is not known of it, as of --sensitivity: for ceduo_uncertainty_compute() */
    const struct ceduo_input *inputs;
    size_t observations_count; /* what was observed there: for ceduo_calibrate() */
    const struct ceduo_observation *observations;
    const char *
        messages; /* what is wrong or, of a good scene, unusual, as `ceduo --check` prints it, but always in English; "": nothing */
    void *memory;
};

/* Reads a scene from a file: a path, the name of a scene that comes with the program, or "-" for standard input. `sets`
 * (may be NULL) is a list that ends in NULL of changes PATH=VALUE, as of --set, made from first to last. CEDUO_BAD_FILE,
 * with messages; CEDUO_NO_MEMORY. Release it in any case. */
enum ceduo_status ceduo_scene_read(const char *path, const char *const *sets, struct ceduo_scene_file *reading);

/* The same from text. Messages call it `name`, and other files that it names are looked for beside a file of that name. */
enum ceduo_status ceduo_scene_read_text(const char *name, const char *text, struct ceduo_scene_file *reading);

/* Frees it; a second time does nothing. */
void ceduo_scene_file_release(struct ceduo_scene_file *reading);

#endif
