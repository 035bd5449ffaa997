/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURVEY_FILE_H
#define CEDUO_SURVEY_FILE_H

#include "base/arena.h"
#include "base/text.h"
#include "ceduo/survey.h"
#include "problem.h"

/* A survey from a CSV file: a row for each stem, with the plot that it stands on. */
struct survey_file {
    const char *name;   /* of the file, without its folder and .csv */
    const char *unused; /* columns that say nothing to the program, with a comma between them; "": none */
    size_t totals;      /* rows of totals, which are no stems */
    size_t filled;      /* rows without a plot: it stands above */
    struct ceduo_survey survey;
};

/* Reads and checks a survey; what it holds lies in the arena. False where something is wrong, which is reported. */
bool ceduo_survey_read(struct survey_file *file, struct arena *arena, const char *path, struct problems *problems);

/* Adds the stand as a YAML file: what the survey says, with its standard errors as `doubt`, and what had to be assumed. False
 * where there is none: densities that no forest has, which is reported, or no memory. */
bool ceduo_survey_stand(const struct survey_file *file, struct text *yaml, struct problems *problems);

/* Adds an empty sheet as a CSV file in the user's language, with two rows as examples. */
void ceduo_survey_template(struct text *sheet);

#endif
