/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz the text of a scene. A valid scene can be started; written and read again it is the same scene. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/runs/pool.h"
#include "core/runs/run.h"
#include "fuzz.h"
#include "io/scene_file.h"

#define NAME "profiles/scenes/fuzz.yaml" /* no such file; references are relative to it */

static void fail(const char *label, const char *text)
{
    fprintf(stderr, "%s:\n%s\n", label, text);
    abort();
}

/* Check that the emitted text gives the same tree. */
static void check_emitted(struct scene_file *file)
{
    const struct node *plain = ceduo_emit_restore_references(&file->arena, file->root);
    struct text text = {0};
    if (!plain)
        abort();
    ceduo_emit(&text, plain);
    struct scene_file again;
    struct problems problems = {0};
    if (!ceduo_scene_load_text(&again, NAME, text.bytes, &problems))
        fail(ceduo_problems_print(&problems), text.bytes);
    if (!ceduo_node_equal(file->root, again.root))
        fail("written out it is another scene", text.bytes);
    ceduo_scene_release(&again);
    ceduo_problems_free(&problems);
    ceduo_text_free(&text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = malloc(size + 1);
    if (!text)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    struct scene_file file;
    struct problems problems = {0};
    if (ceduo_scene_load_text(&file, NAME, text, &problems)) {
        struct scene_inputs inputs;
        ceduo_inputs_collect(&file, &inputs);
        struct ceduo_run_def def = ceduo_run_def_default(&file.scene);
        struct ceduo_pool *pool;
        if (ceduo_pool_create(&def, &pool) != CEDUO_OK)
            fail("checked, but it cannot be computed", text);
        ceduo_pool_free(pool);
        check_emitted(&file);
    } else if (problems.met == 0) {
        fail("refused without a word", text);
    }
    ceduo_problems_print(&problems);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
    free(text);
    return 0;
}
