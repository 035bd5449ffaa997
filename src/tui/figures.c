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
    free(f->others);
    ceduo_doubted_free(f->doubted);
    ceduo_sighted_free(f->sighted);
    ceduo_fit_free(f->fit);
    ceduo_jobs_free_years(f->years, f->years_count);
    ceduo_verdict_release(&f->verdict);
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

struct ceduo_years *ceduo_figures_years(const struct figures *f, const struct ceduo_scene *scene, size_t option)
{
    struct ceduo_years *years = option < f->years_count ? f->years[option] : NULL;
    return years && years->scene.controls_count == scene->controls_count ? years : NULL;
}

/* The other energy law as far as it fits: what was seen before an edit stays until better is known, but for that of
 * another law. */
static const struct ceduo_other_energy *fitting_others(struct figures *f, const struct ceduo_scene *scene)
{
    if (f->others_options != scene->options_count || f->others_controls != scene->controls_count)
        return NULL;
    for (size_t i = 0; f->others && i < f->others_options * f->others_controls; i++)
        f->others[i].known &= f->others[i].model == ceduo_other_law(&scene->options[i / f->others_controls]);
    return f->others;
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
    for (size_t i = 0; differences && i < n * controls; i++)
        differences[i] =
            in_order ? o->differences[i] : (struct ceduo_difference){CEDUO_NOT_PAIRED, CEDUO_NOT_PAIRED, CEDUO_NOT_PAIRED};
    if (!wooded || !differences ||
        ceduo_result_assess(scene, &o->bare->flown, wooded, differences, fitting_others(f, scene), &f->result) != CEDUO_OK)
        f->result = NULL;
    free(differences);
    free(wooded);
}

/* Judges by the years of the scene as it is now: those of an earlier one do not count. */
static void judge(struct figures *f, const struct ceduo_scene *scene)
{
    struct ceduo_years **fit = calloc(scene->options_count + 1, sizeof *fit);
    for (size_t i = 0; fit && i < scene->options_count; i++) {
        struct ceduo_years *years = ceduo_figures_years(f, scene, i);
        fit[i] = years && years->key == ceduo_flights_years_key(scene, i) ? years : NULL;
    }
    if (!fit || ceduo_verdict_make(f->result, fit, &f->verdict) != CEDUO_OK)
        f->verdict = (struct ceduo_verdict){0};
    free(fit);
}

static void refresh(struct figures *f, const struct ceduo_scene *scene)
{
    const struct ceduo_outlook *o = ceduo_figures_outlook(f, scene);
    ceduo_result_free(f->result);
    f->result = NULL;
    ceduo_verdict_release(&f->verdict);
    if (!o || !o->bare)
        return;
    assess(f, scene, o);
    for (size_t i = 0; i < scene->options_count; i++) {
        struct ceduo_years *years = ceduo_figures_years(f, scene, i);
        if (years)
            ceduo_years_assess(years, scene, &o->bare->flown);
    }
    if (f->result)
        judge(f, scene);
}

/* Takes what is new; the years of other options stay. */
static void take_years(struct figures *f, struct jobs_news *news)
{
    if (f->years_count != news->years_count) {
        ceduo_jobs_free_years(f->years, f->years_count);
        f->years = news->years;
        f->years_count = news->years_count;
        return;
    }
    for (size_t i = 0; i < news->years_count; i++)
        if (news->years[i]) {
            ceduo_years_free(f->years[i]);
            f->years[i] = news->years[i];
        }
    free(news->years);
}

void ceduo_figures_follow(struct figures *f, const struct ceduo_scene *scene, size_t option, bool years)
{
    f->asked = ceduo_jobs_key(scene);
    f->busy |= ceduo_jobs_show(f->jobs, scene, f->asked, option, years);
    refresh(f, scene);
}

void ceduo_figures_doubt(struct figures *f, const struct scene_file *file, size_t levels)
{
    f->busy |= ceduo_jobs_doubt(f->jobs, file, levels);
}

const struct doubted *ceduo_figures_doubted(const struct figures *f, const struct scene_file *file)
{
    return f->doubted && f->doubted->file.root == file->root ? f->doubted : NULL;
}

void ceduo_figures_look(struct figures *f, const struct scene_file *file, size_t levels)
{
    if (f->fit && f->fit->file.root != file->root)
        ceduo_figures_drop_fit(f);
    f->busy |= ceduo_jobs_look(f->jobs, file, levels);
}

const struct sighted *ceduo_figures_sighted(const struct figures *f, const struct scene_file *file)
{
    return f->sighted && f->sighted->file.root == file->root ? f->sighted : NULL;
}

void ceduo_figures_fit(struct figures *f, const struct scene_file *file, const struct fit_wish *wish)
{
    ceduo_figures_drop_fit(f);
    f->wish = *wish;
    ceduo_jobs_fit(f->jobs, file, wish);
    f->busy = f->fitting = true;
}

void ceduo_figures_drop_fit(struct figures *f)
{
    ceduo_jobs_stop_fit(f->jobs);
    ceduo_fit_free(f->fit);
    f->fit = NULL;
    f->fitting = false;
    f->fit_state = (struct ceduo_calibration_state){0};
}

bool ceduo_figures_news(struct figures *f, const struct ceduo_scene *scene)
{
    struct jobs_news news = ceduo_jobs_news(f->jobs);
    bool changed = news.busy != f->busy || news.outlook || news.years || news.others || news.doubted || news.sighted ||
                   news.fit || news.fit_state.evaluations != f->fit_state.evaluations || news.sought || news.foresaw;
    f->busy = news.busy;
    if (news.outlook) {
        ceduo_outlook_free(f->outlook);
        f->outlook = news.outlook;
        f->shown = news.key;
        f->seconds = news.seconds;
    }
    f->done = news.done;
    f->all = news.all;
    f->rocks = news.rocks;
    bool years = news.years != NULL;
    if (years)
        take_years(f, &news);
    if (news.doubted) {
        ceduo_doubted_free(f->doubted);
        f->doubted = news.doubted;
    }
    if (news.sighted) {
        ceduo_sighted_free(f->sighted);
        f->sighted = news.sighted;
    }
    if (news.fit) {
        ceduo_fit_free(f->fit);
        f->fit = news.fit;
    }
    f->fitting = news.fitting;
    f->fit_state = news.fit_state;
    bool others = news.others != NULL;
    if (others) {
        free(f->others);
        f->others = news.others;
        f->others_options = news.others_options;
        f->others_controls = news.others_controls;
    }
    if (news.foresaw) {
        f->foresaw = true;
        f->foreseen = news.foreseen;
    }
    if (news.sought) {
        ceduo_sought_free(f->sought);
        f->sought = news.sought;
    }
    if (news.outlook || years || others)
        refresh(f, scene);
    return changed;
}
