/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURVEY_FILE_H
#define CEDUO_SURVEY_FILE_H

#include "base/arena.h"
#include "base/text.h"
#include "ceduo/survey.h"
#include "problem.h"

/* A survey from a table with a row for each stem, or for several stems of one size, and its plot. */
struct survey_file {
    const char *name;       /* of the file, without its folder and .csv */
    const char *understood; /* one line for the user: how the table was read */
    struct ceduo_survey survey;
};

/* Questions that an ambiguous table raises, and their answers. */
enum survey_question {
    SURVEY_SLOPES,    /* degrees, percent */
    SURVEY_DIAMETERS, /* of stems: cm, mm */
    SURVEY_AREAS,     /* in m2 */
    SURVEY_HEIGHTS,   /* of stems, altitudes */
    SURVEY_QUESTIONS
};

struct survey_answers {
    int given[SURVEY_QUESTIONS];  /* answer of the user, from 1; 0: none */
    bool asked[SURVEY_QUESTIONS]; /* set by the reader: it refused the table without this answer */
};

/* Read and check a survey. Its memory is in the arena. Report errors and return false. `answers` may be NULL. */
bool ceduo_survey_read(struct survey_file *file, struct arena *arena, const char *path, struct survey_answers *answers,
                       struct problems *problems);

/* Append the stand of a survey as a YAML file, with standard errors as `uncertainty`, and with assumptions. Report impossible
 * densities and return false; return false on failure, too. */
bool ceduo_survey_print_stand(const struct survey_file *file, struct text *yaml, struct problems *problems);

/* Append an empty sheet as CSV in the user's language, with two example rows. */
void ceduo_survey_print_template(struct text *sheet);

#endif
