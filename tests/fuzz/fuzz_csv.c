/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fuzz CSV files: a profile that is read has increasing x, and a refused one has a message. A survey that is read makes a valid
 * stand. The length of the input selects the layer of a profile and the answers to the questions of a survey. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "fuzz.h"
#include "io/bind.h"
#include "io/csv.h"
#include "io/survey_file.h"
#include "scene/stand.h"

/* Check that a scene can use the stand of a survey. */
static void check_stand(struct arena *arena, const struct survey_file *survey, struct problems *problems)
{
    struct text yaml = {0};
    if (ceduo_survey_print_stand(survey, &yaml, problems)) {
        struct ceduo_belt belt;
        struct invalid_values invalid = {0};
        const struct source_note *notes = NULL;
        const struct source source = {.name = "stand", .bytes = yaml.bytes, .length = yaml.length};
        const struct node *root = ceduo_yaml_read(arena, &source, problems);
        ceduo_schema_init(ceduo_schema_stand(), &belt.stand);
        if (root)
            ceduo_bind(&(struct binding){.arena = arena, .problems = problems, .notes = &notes, .invalid = &invalid},
                       ceduo_schema_stand(), root, &belt.stand);
        if (!root || problems->met > 0) {
            fprintf(stderr, "%s%s", ceduo_text_string(&problems->text), yaml.bytes);
            abort();
        }
        if (ceduo_stand_shoots(&belt.stand) < belt.stand.stools_per_ha)
            abort();
    } else if (problems->met == 0) {
        abort();
    }
    ceduo_text_free(&yaml);
}

static void check_survey(const char *path, int answer)
{
    struct survey_answers answers = {.given = {answer, answer, answer, answer}};
    struct arena arena = {0};
    struct problems problems = {0};
    struct survey_file survey;
    if (ceduo_survey_read(&survey, &arena, path, &answers, &problems))
        check_stand(&arena, &survey, &problems);
    else if (problems.met == 0)
        abort();
    ceduo_problems_free(&problems);
    ceduo_arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char path[FUZZ_PATH_SIZE];
    int fd = fuzz_make_file(data, size, path);
    struct arena arena = {0};
    struct problems problems = {0};
    struct points points = {0};
    if (ceduo_csv_slope_read(&arena, path, size % 4 == 1 ? "1" : NULL, &points, &problems)) {
        for (size_t i = 0; i < points.n; i++)
            if (!isfinite(points.x[i]) || !isfinite(points.z[i]) || (i > 0 && !(points.x[i] > points.x[i - 1])))
                abort();
    } else if (problems.met == 0) {
        abort();
    }
    ceduo_problems_free(&problems);
    ceduo_arena_free(&arena);
    check_survey(path, (int)(size % 3)); /* 0: none */
    close(fd);
    return 0;
}
