/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --sensitivity: what doubt does to the figures of a scene. */
#include "sensitivity.h"

#include "interrupt.h"
#include "io/doubt_inputs.h"
#include "model/uncertainty.h"
#include "options.h"
#include "say.h"
#include "study/points.h"
#include "view/figures.h"

enum ceduo_status ceduo_sensitivity_ask(const struct arguments *a, struct scene_file *file, struct progress *progress,
                                        struct ceduo_doubt_def *def, const struct ceduo_result *finer, struct asked_doubt *d)
{
    *d = (struct asked_doubt){0};
    if (!ceduo_inputs_of(file, &d->inputs))
        return CEDUO_NO_MEMORY;
    def->scene = &file->scene;
    def->inputs_count = d->inputs.n;
    def->inputs = d->inputs.items;
    def->threads = a->threads;
    def->rotation |= a->years;
    def->window = a->window;
    def->cancel = ceduo_interrupt_flag();
    def->progress = ceduo_progress_steps;
    def->context = progress;
    d->report = (struct ceduo_doubt_report){
        .file = file, .inputs = &d->inputs, .points = def->points, .rocks = def->rocks, .finer = finer};
    if (d->inputs.n == 0 || (finer && (def->rocks < 2 || file->scene.controls_count == 0)))
        return CEDUO_OK;
    enum ceduo_status status = ceduo_doubt_ask(def, &d->answer);
    d->report.answer = status == CEDUO_OK ? &d->answer : NULL;
    return status;
}

enum ceduo_status ceduo_sensitivity_of(const struct arguments *a, struct scene_file *file, struct asked_doubt *d)
{
    struct progress progress = ceduo_progress_begin(a);
    struct ceduo_doubt_def def = {.points = a->points > 0 ? a->points : CEDUO_DOUBT_POINTS,
                                  .rocks = a->rocks > 0 ? a->rocks : CEDUO_DOUBT_ROCKS,
                                  .own_rocks = a->rocks > 0 ? a->rocks : file->scene.simulation.rocks};
    enum ceduo_status status = ceduo_sensitivity_ask(a, file, &progress, &def, NULL, d);
    return status;
}

#define EFFORT_MAX 3e8 /* contacts and stems of all points: some ten seconds of a processor */

enum ceduo_status ceduo_sensitivity_beside(const struct arguments *a, struct scene_file *file, struct progress *progress,
                                           const struct ceduo_answer *answer, bool rotation, struct asked_doubt *d)
{
    const struct ceduo_scene *scene = &file->scene;
    const struct ceduo_work *work = &answer->work;
    uint64_t rocks = ceduo_result_rocks(answer->result);
    size_t points = ceduo_option_given(a, "sensitivity") ? a->points : CEDUO_DOUBT_POINTS, years = 0;
    struct ceduo_doubt_def def = {
        .points = points, .points_max = points, .rocks = rocks < CEDUO_DOUBT_ROCKS ? rocks : CEDUO_DOUBT_ROCKS};
    double each = (double)(work->contacts + work->stems.drawn) / (double)(work->rocks > 0 ? work->rocks : 1) * (double)points;
    double effort = each * (double)def.rocks * (double)scene->options_count;
    for (size_t i = 0; i < scene->options_count; i++)
        years += ceduo_points_years(scene, &scene->options[i], a->window, CEDUO_DOUBT_YEARS_MAX);
    def.rotation = rotation && !ceduo_uncertainty_no_rotation(scene) &&
                   effort + each * CEDUO_DOUBT_YEAR_ROCKS * (double)years <= EFFORT_MAX;
    if (effort > EFFORT_MAX || !answer->result->wooded || ceduo_page_says_nothing(answer->result))
        def.rocks = 0;
    return ceduo_sensitivity_ask(a, file, progress, &def, answer->result, d);
}

void ceduo_sensitivity_release(struct asked_doubt *d)
{
    if (d->report.answer)
        ceduo_doubt_free(&d->answer);
}

enum exit_status ceduo_sensitivity_add(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct asked_doubt d;
    ceduo_batch_warn(a, file);
    enum ceduo_status status = ceduo_sensitivity_of(a, file, &d);
    if (status != CEDUO_OK)
        return ceduo_batch_failed(file, status);
    LOCAL_TEXT(page);
    if (a->format == CEDUO_JSON)
        ceduo_figures_json(&page, ceduo_doubt_figures, &(struct ceduo_place){.doubt = &d.report}, false);
    else if (a->format == CEDUO_CSV)
        ceduo_csv_rows(&page, &ceduo_doubt_csv, &(struct ceduo_place){.doubt = &d.report});
    else
        ceduo_doubt_page(&page, &d.report, !ceduo_say_utf8());
    if (a->format == CEDUO_TABLE)
        ceduo_say_plainly(&page);
    ceduo_text_put(out, ceduo_text_string(&page));
    ceduo_sensitivity_release(&d);
    return EXIT_DONE;
}
