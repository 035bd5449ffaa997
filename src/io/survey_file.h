/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_SURVEY_FILE_H
#define CEDUO_SURVEY_FILE_H

#include "base/arena.h"
#include "base/text.h"
#include "ceduo/survey.h"
#include "problem.h"

/* A survey from a table: a row for each stem, or for several of one size, with the plot that it stands on. */
struct survey_file {
    const char *name;       /* of the file, without its folder and .csv */
    const char *understood; /* one line for the user: how the table was read */
    struct ceduo_survey survey;
};

/* Questions that a table may leave open, and their answers. */
enum survey_question {
    SURVEY_SLOPES,    /* degrees, percent */
    SURVEY_DIAMETERS, /* of stems: cm, mm */
    SURVEY_AREAS,     /* in m2 */
    SURVEY_HEIGHTS,   /* of stems, altitudes */
    SURVEY_QUESTIONS
};

/* Which answer, from 1, the user gave to each question; 0: none. The reader sets asked[q] if it refuses the table without the
 * answer. */
struct survey_answers {
    int given[SURVEY_QUESTIONS];
    bool asked[SURVEY_QUESTIONS];
};

/* Read and check a survey. Its memory is the arena's. Report what is wrong and return false.
 * `answers` may be NULL: the heads alone settle what is asked. */
bool ceduo_survey_read(struct survey_file *file, struct arena *arena, const char *path, struct survey_answers *answers,
                       struct problems *problems);

/* Adds the stand as a YAML file: what the survey says, with its standard errors as `uncertainty`, and what had to be assumed. False
 * where there is none: densities that no forest has, which is reported, or no memory. */
bool ceduo_survey_stand(const struct survey_file *file, struct text *yaml, struct problems *problems);

/* Adds an empty sheet as a CSV file in the user's language, with two rows as examples. */
void ceduo_survey_template(struct text *sheet);

#endif
