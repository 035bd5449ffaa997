/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz a CSV table that a scene refers to: observed values, all rows or some, and draws of a calibration. Values that are read
 * are finite and in order; a refused table has a message. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "fuzz.h"
#include "io/scene_file.h"

#define SCENE                                                                                                                  \
    "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: {vertices_m: [[0, 50], [60, 20], [100, 0]], materials: [{from_m: 0, "     \
    "to_m: 100, material: talus}]}\ncontrols_m: [90]\nforest: [{from_m: 10, to_m: 80, stand: {trees: [{per_ha: 300, "          \
    "dbh_m: 0.2, height_m: 12}]}}]\n"

static const char *const uses[] = {
    "observed: [{stops: %s}]\n",
    "observed: {stops: {csv: %s, column: x_m, only: block=1, seen_from_m: 20, of: 9}}\n",
    "observed: [{energy: {x_m: 50, csv: %s}}, {scars: {from_m: 10, to_m: 60, height_m: %s, share_seen: 0.5}}]\n",
    "observed: [{on_the_way: {from_m: 10, to_m: 60, height_m: {csv: %s}}}, {largest: {speed_m_s: {csv: %s}}}]\n",
    "uncertainty: {draws: %s}\n",
};

static void fail(const char *label, const char *text)
{
    fprintf(stderr, "%s: %s\n", label, text);
    abort();
}

/* Check that values are ascending, as the comparison with simulated rocks requires. */
static void check_observed(const struct scene_file *file, const char *use)
{
    if (strncmp(use, "observed", 8) == 0 && file->observations_count == 0)
        fail("read without what was seen", use);
    for (size_t i = 0; i < file->observations_count; i++) {
        const struct ceduo_observation *o = &file->observations[i];
        for (size_t k = 0; k < o->n; k++)
            if (!isfinite(o->values[k]) || (k > 0 && o->values[k] < o->values[k - 1]))
                fail("a value that is none, or out of order", use);
    }
}

static void check_draws(struct scene_file *file, const char *use)
{
    struct scene_inputs inputs;
    bool wanted = strncmp(use, "uncertainty", 11) == 0, found = false;
    if (!ceduo_inputs_collect(file, &inputs))
        fail("no inputs", use);
    for (size_t i = 0; i < inputs.n; i++) {
        const struct ceduo_input *input = &inputs.items[i];
        for (size_t k = 0; input->kind == CEDUO_INPUT_DRAWS && k < input->places_count; k++)
            for (size_t r = 0; r < input->draws_count; r++)
                if (!input->places[k] || !isfinite(input->draws[k][r]))
                    fail("a draw that is none", use);
        found |= input->kind == CEDUO_INPUT_DRAWS && input->places_count > 0 && input->draws_count > 0;
    }
    if (wanted && !found)
        fail("read without draws", use);
}

static void check_use(const char *use, const char *path)
{
    struct text text = {0};
    struct scene_file file;
    struct problems problems = {0};
    ceduo_text_append(&text, SCENE);
    for (const char *at; (at = strstr(use, "%s")); use = at + 2)
        ceduo_text_format(&text, "%.*s%s", (int)(at - use), use, path);
    ceduo_text_append(&text, use);
    if (ceduo_scene_load_text(&file, "profiles/scenes/fuzz.yaml", ceduo_text_string(&text), &problems)) {
        const char *last = strstr(ceduo_text_string(&text), "stand:");
        last = strchr(last, '\n') + 1;
        check_observed(&file, last);
        check_draws(&file, last);
    } else if (problems.met == 0) {
        fail("refused without a word", ceduo_text_string(&text));
    }
    ceduo_problems_print(&problems);
    ceduo_problems_free(&problems);
    ceduo_scene_release(&file);
    ceduo_text_free(&text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    int fd = fuzz_make_file(data, size, path);
    for (size_t i = 0; i < sizeof uses / sizeof uses[0]; i++)
        check_use(uses[i], path);
    close(fd);
    return 0;
}
