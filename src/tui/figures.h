/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FIGURES_H
#define CEDUO_FIGURES_H

#include "model/jobs.h"
#include "study/verdict.h"

/* The figures of the scene. After an edit they are assessed again at once; runs are asked for only where the edit changes
 * what the rocks meet. */
struct figures {
    struct jobs *jobs;
    struct ceduo_outlook *outlook;     /* newest; NULL before the first */
    struct ceduo_result *result;       /* the scene as it is now, by the newest outlook; NULL before the first */
    struct ceduo_other_energy *others; /* newest, as jobs_news has them; NULL before the first */
    size_t others_options, others_controls;
    struct doubted *doubted; /* newest; NULL before the first, and where it is not asked for */
    struct sighted *sighted; /* newest look at what was seen; likewise */
    struct fit *fit;         /* that is done, and nobody has taken or dropped; NULL: none */
    struct fit_wish wish;    /* that was asked for last */
    bool fitting;            /* it is under way, and has come so far: */
    struct ceduo_calibration_state fit_state;
    struct ceduo_years **years;   /* newest of each option, NULL: not computed */
    size_t years_count;           /* options that there is room for */
    struct ceduo_verdict verdict; /* of the result and of the years that fit the scene; n 0: none */
    size_t done, all;             /* of the step under way in the years: options; all 0: none */
    uint64_t rocks;               /* of that step */
    bool foresaw;                 /* what a change would do is known, until somebody takes it: */
    struct foreseen foreseen;
    struct sought *sought; /* what a search came to, until it is taken; NULL: nothing new */
    uint64_t asked, shown; /* keys of the runs that were asked for last, and of the outlook */
    bool busy;
    double seconds; /* from the edit to the outlook */
};

/* False where no thread can be started. */
bool ceduo_figures_create(struct figures *figures, unsigned threads);
void ceduo_figures_free(struct figures *figures);

/* Forgets all, and lets go of the memory of the scene they were of. False, and nothing changed, where no thread can be
 * started. */
bool ceduo_figures_restart(struct figures *figures);

/* The scene has changed. `years`: the years to come of the option as well. */
void ceduo_figures_follow(struct figures *figures, const struct ceduo_scene *scene, size_t option, bool years);

/* The doubt of the scene up to so many levels, see ceduo_jobs_doubt(). */
void ceduo_figures_doubt(struct figures *figures, const struct scene_file *file, size_t levels);

/* What is known of the doubt of this scene, NULL where that is nothing yet. */
const struct doubted *ceduo_figures_doubted(const struct figures *figures, const struct scene_file *file);

/* What the scene says of what was seen there, up to so many levels; a fit of another scene is forgotten. */
void ceduo_figures_look(struct figures *figures, const struct scene_file *file, size_t levels);
const struct sighted *ceduo_figures_sighted(const struct figures *figures, const struct scene_file *file);
void ceduo_figures_fit(struct figures *figures, const struct scene_file *file, const struct fit_wish *wish);
void ceduo_figures_drop_fit(struct figures *figures);

/* Takes the news of the jobs; true where something has changed. */
bool ceduo_figures_news(struct figures *figures, const struct ceduo_scene *scene);

/* What fits a scene: an edit may have added a control since it was asked for. NULL: none does. */
const struct ceduo_outlook *ceduo_figures_outlook(const struct figures *figures, const struct ceduo_scene *scene);
struct ceduo_years *ceduo_figures_years(const struct figures *figures, const struct ceduo_scene *scene, size_t option);

#endif
