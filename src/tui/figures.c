/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "figures.h"

#include <math.h>
#include <stdlib.h>

bool ceduo_figures_create(struct figures *f, unsigned threads)
{
    *f = (struct figures){.jobs = ceduo_jobs_create(threads)};
    return f->jobs != NULL;
}

void ceduo_figures_free(struct figures *f)
{
    ceduo_jobs_free(f->jobs);
    ceduo_result_free(f->result);
    ceduo_outlook_free(f->outlook);
    ceduo_years_free(f->years);
    ceduo_sought_free(f->sought);
    *f = (struct figures){0};
}

bool ceduo_figures_restart(struct figures *f)
{
    struct figures next;
    if (!ceduo_figures_create(&next, ceduo_jobs_threads(f->jobs)))
        return false;
    ceduo_figures_free(f);
    *f = next;
    return true;
}

const struct ceduo_outlook *ceduo_figures_outlook(const struct figures *f, const struct ceduo_scene *scene)
{
    return f->outlook && f->outlook->controls == scene->controls_count ? f->outlook : NULL;
}

static bool years_fit(const struct figures *f, const struct ceduo_scene *scene)
{
    return f->years && f->years->scene.controls_count == scene->controls_count;
}

const struct ceduo_years *ceduo_figures_years(const struct figures *f, const struct ceduo_scene *scene, size_t option)
{
    return years_fit(f, scene) && f->years_option == option ? f->years : NULL;
}

/* Assesses the scene by what was flown through the forests of each option. */
static void assess(struct figures *f, const struct ceduo_scene *scene, const struct ceduo_outlook *o)
{
    size_t n = scene->options_count, controls = scene->controls_count;
    const struct ceduo_flown **wooded = calloc(n + 1, sizeof *wooded);
    struct ceduo_difference *differences = calloc(n * controls + 1, sizeof *differences);
    bool in_order = o->options == n;
    for (size_t i = 0; wooded && i < n; i++) {
        const struct ceduo_sight *sight = ceduo_outlook_sight(o, scene, i);
        wooded[i] = sight ? &sight->flown : NULL;
        in_order = in_order && sight == o->wooded[i];
    }
    const struct ceduo_paired unknown = {NAN, NAN};
    for (size_t i = 0; differences && i < n * controls; i++)
        differences[i] = in_order ? o->differences[i] : (struct ceduo_difference){unknown, unknown, unknown};
    if (!wooded || !differences ||
        ceduo_result_assess(scene, &o->bare->flown, wooded, differences, &f->result) != CEDUO_OK)
        f->result = NULL;
    free(differences);
    free(wooded);
}

static void refresh(struct figures *f, const struct ceduo_scene *scene)
{
    const struct ceduo_outlook *o = ceduo_figures_outlook(f, scene);
    ceduo_result_free(f->result);
    f->result = NULL;
    if (!o || !o->bare)
        return;
    assess(f, scene, o);
    if (years_fit(f, scene))
        ceduo_years_assess(f->years, scene, &o->bare->flown);
}

void ceduo_figures_follow(struct figures *f, const struct ceduo_scene *scene, size_t option, bool years)
{
    f->asked = ceduo_jobs_key(scene);
    f->busy |= ceduo_jobs_show(f->jobs, scene, f->asked, option, years);
    refresh(f, scene);
}

bool ceduo_figures_news(struct figures *f, const struct ceduo_scene *scene, bool *failed)
{
    struct jobs_news news = ceduo_jobs_news(f->jobs);
    bool changed = news.busy != f->busy || news.outlook || news.years || news.sought || news.foresaw || news.failed;
    f->busy = news.busy;
    *failed = news.failed;
    if (news.outlook) {
        ceduo_outlook_free(f->outlook);
        f->outlook = news.outlook;
        f->shown = news.key;
        f->seconds = news.seconds;
    }
    if (news.years) {
        ceduo_years_free(f->years);
        f->years = news.years;
        f->years_option = news.years_option;
    }
    if (news.foresaw) {
        f->foresaw = true;
        f->foreseen = news.foreseen;
    }
    if (news.sought) {
        ceduo_sought_free(f->sought);
        f->sought = news.sought;
    }
    if (news.outlook || news.years)
        refresh(f, scene);
    return changed;
}
