/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_REPORT_H
#define CEDUO_REPORT_H

#include "base/arena.h"
#include "ceduo/blocks.h"
#include "ceduo/find.h"
#include "ceduo/years.h"
#include "io/scene_file.h"
#include "measure.h"
#include "report_doubt.h"
#include "study/goal.h"
#include "study/snapshot.h"
#include "study/verdict.h"
#include "words.h"

enum ceduo_format { CEDUO_TABLE, CEDUO_CSV, CEDUO_JSON };

/* The answer for one scene: all that pages, panes and figures are made from. */
struct ceduo_report {
    const struct scene_file *file;
    const struct ceduo_result *result;      /* NULL: nothing is computed yet */
    const struct ceduo_verdict *verdict;    /* of all options; NULL: not known */
    const struct ceduo_doubt_report *doubt; /* NULL: not computed; in the terminal program perhaps of one option alone */
    struct ceduo_years *const *years;       /* one for each option; NULL: not asked for */
    struct ceduo_years *const *ahead;       /* likewise, for pictures; NULL, or NULL of an option: not known */
    const struct ceduo_snapshot *snapshot;  /* for pictures; NULL: there are none */
    const struct ceduo_block *blocks;       /* CEDUO_BLOCKS for each option; NULL: none to show */
    struct ceduo_run_remarks remarks;
    struct ceduo_work work;
    double seconds;       /* that the runs took */
    uint64_t rocks_asked; /* where rows of stands are wanted and none is flown; otherwise 0 */
    const char *command;  /* of a page to hand in: gives the same page, */
    bool same;            /* to the last byte */
    bool details;         /* JSON has the lists that are long */
    bool busy;            /* finer figures are on their way */
};

/* Judge an option at a control, by what the report knows; see ceduo_outcome_of(). */
struct ceduo_outcome ceduo_report_outcome(const struct ceduo_report *report, size_t option, size_t control);

/* An option over the years ahead; NULL if they are not known, or are all as today. */
static inline const struct ceduo_choice *ceduo_report_ahead(const struct ceduo_report *report, size_t option)
{
    const struct ceduo_verdict *v = report->verdict;
    const struct ceduo_choice *c = v && option < v->n ? &v->choices[option] : NULL;
    return c && c->over.years > 0 && c->window.kind != CEDUO_WINDOW_ALIKE ? c : NULL;
}

/* Whether no place is asked for, or nothing can be said of the last one. */
bool ceduo_page_says_nothing(const struct ceduo_result *result);

/* The page that a forester reads first, and the whole one with every figure; 80 columns. `plain`: ASCII alone. */
void ceduo_report_short(struct text *text, const struct ceduo_report *report, bool plain);
void ceduo_report_table(struct text *text, const struct ceduo_report *report, bool plain);

/* A page to hand in: the question and its answer first, then what it rests on, and how to compute it again. */

struct ceduo_page;
#define CEDUO_PAGE_REPORT_WIDTH 120 /* of a page that chapters are added to: tables, not sentences, and nothing shortened */

/* Adds a chapter for one scene. */
void ceduo_page_chapter(struct ceduo_page *page, const struct ceduo_report *report);

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
