/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REPORT_H
#define CEDUO_REPORT_H

#include "base/arena.h"
#include "ceduo/blocks.h"
#include "ceduo/find.h"
#include "ceduo/years.h"
#include "io/scene_file.h"
#include "report_doubt.h"
#include "study/goal.h"
#include "study/verdict.h"
#include "words.h"

enum ceduo_format { CEDUO_TABLE, CEDUO_CSV, CEDUO_JSON };

/* One scene's result, ready to be written. */
struct ceduo_report {
    const struct scene_file *file;
    const struct ceduo_result *result;
    struct ceduo_run_remarks remarks;
    struct ceduo_work work;
    const struct ceduo_block *blocks;       /* CEDUO_BLOCKS for each option; NULL: none to show */
    double seconds;                         /* that the runs took */
    bool details;                           /* JSON has the lists that are long */
    uint64_t rocks_asked;                   /* where rows of stands are wanted and none is flown; otherwise 0 */
    struct ceduo_years *const *years;       /* one for each option; NULL: not asked for */
    const struct ceduo_verdict *verdict;    /* of all options; NULL: not known */
    const struct ceduo_doubt_report *doubt; /* NULL: not computed */
};

/* Whether no place is asked for, or nothing can be said of the last one. */
bool ceduo_page_says_nothing(const struct ceduo_result *result);

/* The page that a forester reads first, and the whole one with every figure; 80 columns. `plain`: ASCII alone. */
void ceduo_report_short(struct text *text, const struct ceduo_report *report, bool plain);
void ceduo_report_table(struct text *text, const struct ceduo_report *report, bool plain);

/* A page to hand in: the question and its answer first, then what it rests on, and how to compute it again. */

struct ceduo_page;
struct ceduo_snapshot;
struct ceduo_chapter {
    const struct ceduo_report *report;
    const struct ceduo_snapshot *snapshot; /* for the pictures */
    struct ceduo_years *const *years;      /* one for each option; NULL, or NULL of an option: none */
    const char *command;                   /* that gives the same page, */
    bool same;                             /* to the last byte */
};

#define CEDUO_PAGE_REPORT_WIDTH 120 /* of a page that chapters are added to: tables, not sentences, and nothing shortened */

/* Adds a chapter for one scene. */
void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_chapter *chapter);

/* Several scenes, as profiles of one slope. Zeroed at first; to be freed in any case. */
struct ceduo_profiles {
    size_t count;
    struct ceduo_profile *items;
    struct arena arena; /* of what they hold */
};
/* `name`: NULL: the scene's title. */
void ceduo_profiles_add(struct ceduo_profiles *profiles, const struct ceduo_report *report, const char *name);
/* Puts the worst first. Their numbers as they were added, from 0, to `order`; how many. */
size_t ceduo_profiles_sort(struct ceduo_profiles *profiles, size_t *order);
/* Adds what is said of each option of each, and before it, where all are about one place, of that as a whole. */
void ceduo_profiles_page(struct ceduo_page *page, const struct ceduo_profiles *profiles);
void ceduo_profiles_free(struct ceduo_profiles *profiles);

/* What a search found. */
struct ceduo_find_report {
    const struct scene_file *file;
    const struct ceduo_search *search;
    const struct ceduo_found *found;
    const struct ceduo_yield *yield; /* at that value; NaN where it is not known; NULL: none */
    bool yield_depends;              /* on the value; otherwise it is the same over the whole range */
    const struct ceduo_sure *sure;
};
void ceduo_find_page(struct text *text, const struct ceduo_find_report *report);
/* Which values reach the goal, and if wanted which limit that is; the value that is sure. Both in the unit in which the field is
 * shown (NULL: that of the file). */
void ceduo_find_words(struct text *text, const struct ceduo_search *search, const struct ceduo_found *found,
                      const struct field *field, bool wanted);
void ceduo_find_sure(struct text *text, const struct ceduo_search *search, const struct ceduo_sure *sure,
                     const struct field *field);

#endif
