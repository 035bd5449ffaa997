/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_READ_H
#define CEDUO_READ_H

#include "observe.h"
#include "uncertainty.h"

/* A scene read from files. Its memory belongs to this struct. The caller may change numbers in place, and may set pointers to
 * memory of its own, which is not freed. */
struct ceduo_scene_file {
    struct ceduo_scene scene;
    size_t inputs_count; /* uncertain inputs, for ceduo_uncertainty_compute() */
    const struct ceduo_input *inputs;
    size_t observations_count; /* for ceduo_calibrate() */
    const struct ceduo_observation *observations;
    const char *messages; /* errors, or warnings about a valid scene, as `ceduo --check` prints them, in English; "": none */
    void *memory;
};

/* Read a scene from a file: a path, the name of a shipped scene, or "-" for standard input. `sets` is a NULL-terminated list of
 * changes PATH=VALUE (--set), applied in order; may be NULL. Return CEDUO_OK, CEDUO_BAD_FILE (see messages) or CEDUO_NO_MEMORY.
 * The caller releases *file in each case. */
enum ceduo_status ceduo_scene_read(const char *path, const char *const *sets, struct ceduo_scene_file *file);

/* Read a scene from text. Messages call it `name`. Other files are searched relative to the folder of `name`. */
enum ceduo_status ceduo_scene_read_text(const char *name, const char *text, struct ceduo_scene_file *file);

/* Release the memory. A second call has no effect. */
void ceduo_scene_file_release(struct ceduo_scene_file *file);

#endif
