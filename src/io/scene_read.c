/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public functions that read a scene. */

#include <stdlib.h>

#include "base/language.h"
#include "scene_file.h"

struct memory {
    struct scene_file file;
    struct problems problems;
};

/* `text` may be NULL: then `name` is a file. */
static enum ceduo_status read_scene(const char *name, const char *text, const char *const *sets,
                                    struct ceduo_scene_file *reading)
{
    *reading = (struct ceduo_scene_file){.messages = ""};
    struct memory *m = calloc(1, sizeof *m);
    if (!m)
        return CEDUO_NO_MEMORY;
    reading->memory = m;
    size_t n = 0;
    while (sets && sets[n])
        n++;
    ceduo_language_set_data(true); /* the caller has its own message domain */
    bool good = text ? ceduo_scene_load_text(&m->file, name, text, &m->problems)
                     : ceduo_scene_load(&m->file, name, sets, n, &m->problems);
    struct scene_inputs inputs = {0};
    good = good && ceduo_inputs_collect(&m->file, &inputs) && ceduo_problems_check_memory(&m->problems);
    reading->messages = ceduo_problems_print(&m->problems);
    ceduo_language_set_data(false);
    if (good)
        *reading = (struct ceduo_scene_file){.scene = m->file.scene,
                                             .inputs_count = inputs.n,
                                             .inputs = inputs.items,
                                             .observations_count = m->file.observations_count,
                                             .observations = m->file.observations,
                                             .messages = reading->messages,
                                             .memory = m};
    return good ? CEDUO_OK : m->problems.memory ? CEDUO_NO_MEMORY : CEDUO_BAD_FILE;
}

enum ceduo_status ceduo_scene_read(const char *path, const char *const *sets, struct ceduo_scene_file *reading)
{
    return read_scene(path, NULL, sets, reading);
}

enum ceduo_status ceduo_scene_read_text(const char *name, const char *text, struct ceduo_scene_file *reading)
{
    return read_scene(name, text, NULL, reading);
}

void ceduo_scene_file_release(struct ceduo_scene_file *reading)
{
    struct memory *m = reading->memory;
    if (m) {
        ceduo_scene_release(&m->file);
        ceduo_problems_free(&m->problems);
        free(m);
    }
    *reading = (struct ceduo_scene_file){.messages = ""};
}
