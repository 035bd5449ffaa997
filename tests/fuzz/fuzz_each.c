/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz a CSV table of --each, with and without a key and a geometry. A refused row has a reason, as has a refused scene; a good
 * row has a geometry. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli/batch.h"
#include "cli/each.h"
#include "fuzz.h"

#define ROWS_MAX 3 /* that change the scene */

static void check_row(struct each *each)
{
    const struct arguments *a = &each->arguments;
    const struct scene_sets sets = {a->sets.items, a->sets.n, a->cells, a->called};
    struct text text = {0};
    struct json json = {.text = &text};
    struct scene_file file;
    struct problems problems = {0};
    ceduo_each_reason(each, &text);
    if (each->row->bad != (text.length > 0))
        abort();
    if (!each->row->bad) {
        if (!ceduo_scene_load_row(&file, each->path, &sets, &problems) && problems.met == 0)
            abort();
        ceduo_scene_release(&file);
        if (a->format == CEDUO_GEOJSON && !ceduo_geometry_print(each, &text))
            abort();
        ceduo_each_json(each, &json);
    }
    ceduo_problems_free(&problems);
    ceduo_text_free(&text);
}

static void check_table(const char *path, const char *key, enum ceduo_format format)
{
    static char *scenes[] = {"profiles/scenes/paper-site.yaml"};
    const char *sets[] = {"simulation.seed=1"};
    const struct arguments arguments = {
        .mode = MODE_BATCH, .format = format, .each = path, .key = key, .sets = {sets, 1}, .scenes = scenes, .scenes_count = 1};
    struct each each;
    if (ceduo_each_open(&each, &arguments) == EXIT_DONE)
        for (size_t i = 0; i < ROWS_MAX && ceduo_each_next(&each); i++)
            check_row(&each);
    ceduo_each_close(&each);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static FILE *none;
    if (!none) /* discard messages */
        stderr = none = fopen("/dev/null", "w");
    char path[FUZZ_PATH_SIZE];
    int fd = fuzz_make_file(data, size, path);
    check_table(path, NULL, CEDUO_JSON);
    check_table(path, "id", CEDUO_GEOJSON);
    close(fd);
    return 0;
}
