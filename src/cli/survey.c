/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --survey: the stand of a CSV file of sample plots; --survey --template: an empty one. */
#include <string.h>

#include "batch.h"
#include "io/file.h"
#include "io/survey_file.h"
#include "output.h"
#include "say.h"

enum exit_status ceduo_batch_survey(const struct arguments *a)
{
    struct arena arena = {0};
    struct problems problems = {0};
    struct survey_file file;
    struct text yaml = {0};
    bool standard = strcmp(a->survey, "-") == 0, sheet = strcmp(a->survey, "--template") == 0;
    const char *found = standard || sheet ? NULL : ceduo_file_find(&arena, a->survey, NULL, "surveys");
    if (sheet)
        ceduo_survey_template(&yaml);
    bool good = sheet || (ceduo_survey_read(&file, &arena, found ? found : a->survey, &problems) &&
                          ceduo_survey_stand(&file, &yaml, &problems));
    ceduo_problems_close(&problems);
    ceduo_say(&problems.text);
    enum exit_status status = good ? ceduo_output_write(a, &yaml) : EXIT_INPUT;
    ceduo_problems_free(&problems);
    ceduo_text_free(&yaml);
    ceduo_arena_free(&arena);
    return status;
}
