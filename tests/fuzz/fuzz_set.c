/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz changes by --set, one per line, on shipped scenes: two with included files, one with options. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "io/scene_file.h"

#define SETS_MAX 8

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const scenes[] = {"profiles/scenes/paper-site.yaml", "profiles/scenes/rotation.yaml",
                                         "profiles/scenes/road-below.yaml"};
    char *text = malloc(size + 1);
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    const char *sets[SETS_MAX];
    size_t n = 0;
    for (char *save, *line = strtok_r(text, "\n", &save); line && n < SETS_MAX; line = strtok_r(NULL, "\n", &save))
        sets[n++] = line;
    struct scene_file file;
    struct problems problems = {0};
    if (!ceduo_scene_load(&file, scenes[size % 3], sets, n, &problems) && problems.met == 0)
        abort();
    ceduo_problems_print(&problems);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
    free(text);
    return 0;
}
