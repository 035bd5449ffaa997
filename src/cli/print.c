/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "print.h"

#include <stdlib.h>

#include "base/clock.h"
#include "base/language.h"
#include "interrupt.h"
#include "options.h"
#include "say.h"
#include "sensitivity.h"
#include "study/snapshot.h"
#include "view/figures.h"

/* ---- pages ---- */

/* Whether the whole page is wanted, not the short one. */
static bool is_whole(const struct arguments *a)
{
    return ceduo_option_given(a, "details");
}

#define BLOCK_ROCKS 512 /* of each other size at the most: their intervals stand beside them */

enum exit_status ceduo_finished(const struct ceduo_result *result)
{
    return ceduo_result_unfinished(result) * 1000 > ceduo_result_rocks(result) ? EXIT_RUN : EXIT_DONE;
}

#define YEARS_ROCKS 10000 /* of all years of an option: they give the mean to about 10 of 1000 */
#define YEARS_MOST  50    /* of each option; of a longer rotation some */

void ceduo_ask_years(struct ceduo_question *q)
{
    q->years = true;
    q->years_rocks = YEARS_ROCKS;
    q->year_rocks = YEARS_ROCKS; /* of a scene with blocks, whose years have the same ones */
    q->years_most = YEARS_MOST;
}

/* What a page does not print is not simulated. */
static struct ceduo_question ask_for(const struct arguments *a, const struct scene_file *file, struct progress *progress)
{
    struct ceduo_question q = ceduo_batch_question(a, file, progress);
    bool page = a->format == CEDUO_TABLE;
    if (a->stands && a->format == CEDUO_CSV) /* what is asked of the stands no rock answers */
        q.rocks = 0;
    if (page && !a->years) {
        ceduo_ask_years(&q);
        q.block_rocks = is_whole(a) ? BLOCK_ROCKS : 0;
    }
    q.run.other_energy = !page || is_whole(a);
    return q;
}

static void write_report(const struct arguments *a, const struct ceduo_report *report, struct text *out)
{
    if (a->format == CEDUO_JSON) {
        ceduo_figures_json(out, ceduo_result_figures, &(struct ceduo_place){.report = report}, report->details);
    } else if (a->format == CEDUO_CSV) {
        ceduo_text_put(out, ""); /* without stands no row, but the header */
        ceduo_csv_rows(out, ceduo_result_csv(a->stands, a->years), &(struct ceduo_place){.report = report});
    } else {
        LOCAL_TEXT(page);
        (is_whole(a) ? ceduo_report_table : ceduo_report_short)(&page, report, !ceduo_say_utf8());
        ceduo_say_plainly(&page);
        ceduo_text_put(out, ceduo_text_string(&page));
        ceduo_profiles_add(a->profiles, report, a->label);
    }
}

enum exit_status ceduo_print_report(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct progress progress = ceduo_progress_begin(a);
    struct ceduo_question q = ask_for(a, file, &progress);
    struct ceduo_answer answer;
    struct asked_doubt doubt = {0};
    struct ceduo_verdict verdict;
    enum ceduo_status status = ceduo_ask(&q, NULL, &answer);
    double seconds = ceduo_clock() - progress.start;
    if (status == CEDUO_OK)
        status = ceduo_verdict_make(answer.result, answer.years, &verdict);
    else
        verdict = (struct ceduo_verdict){0};
    if (status == CEDUO_OK && a->format == CEDUO_TABLE)
        status = ceduo_sensitivity_beside(a, file, &progress, &answer, false, &doubt);
    enum exit_status done = EXIT_DONE;
    if (status == CEDUO_OK) {
        bool flown = !a->stands || a->format != CEDUO_CSV;
        const struct ceduo_report report = {.file = file,
                                            .result = answer.result,
                                            .years = a->years ? answer.years : NULL,
                                            .verdict = &verdict,
                                            .doubt = doubt.report.file ? &doubt.report : NULL,
                                            .blocks = answer.blocks,
                                            .work = answer.work,
                                            .seconds = seconds,
                                            .details = is_whole(a),
                                            .rocks_asked = flown ? 0 : ceduo_batch_question(a, file, NULL).rocks,
                                            .remarks = {a->tolerance, answer.tolerance_met, file->ground_assumed}};
        write_report(a, &report, out);
        done = ceduo_finished(answer.result);
    }
    ceduo_sensitivity_release(&doubt);
    ceduo_verdict_release(&verdict);
    ceduo_answer_release(&answer);
    return status == CEDUO_OK ? done : ceduo_batch_failed(file, status);
}

/* ---- pictures ---- */

#define PLOT_WIDTH  80
#define PLOT_HEIGHT 24

/* `start`: where this scene's pictures begin; a blank line stands between two. */
static void add_plot(const struct arguments *a, const struct ceduo_picture *picture, size_t start, struct text *out)
{
    int width = a->plot_width > 0 ? a->plot_width : PLOT_WIDTH;
    int height = a->plot_width > 0 ? a->plot_height : PLOT_HEIGHT;
    struct ceduo_cells *cells = ceduo_cells_create(width, height, ceduo_option_charset(a));
    struct ceduo_area area = {.top = 1, .width = width, .height = height - 1};
    LOCAL_TEXT(title);
    ceduo_plot_title(&title, a->plot, picture);
    ceduo_plot_draw(a->plot, &cells->canvas, &area, picture);
    ceduo_cells_label(cells, 0, 0, CEDUO_ROLE_TITLE, ceduo_text_string(&title));
    char *rows = ceduo_cells_dump(cells);
    if (out->length > start)
        ceduo_text_char(out, '\n');
    ceduo_text_put(out, rows);
    free(rows);
    ceduo_cells_free(cells);
}

/* One picture for each option, belt or control that it depends on. */
static void add_plots(const struct arguments *a, const struct ceduo_scene *scene, const struct ceduo_snapshot *snapshot,
                      struct ceduo_years *const *years, const struct ceduo_verdict *verdict, struct text *out)
{
    struct ceduo_picture picture = {
        .scene = scene, .snapshot = snapshot, .verdict = verdict, .control = ceduo_scene_last_control(scene)};
    size_t start = out->length;
    size_t options = ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_WHOLE ? 1 : scene->options_count;
    for (size_t o = 0; o < options; o++) {
        size_t belts = a->plot == CEDUO_PLOT_STAND ? scene->options[o].belts_count : 0;
        size_t controls = a->plot == CEDUO_PLOT_HISTOGRAM ? scene->controls_count : 0;
        picture.option = o;
        picture.years = years ? years[o] : NULL;
        picture.year = SIZE_MAX;
        for (size_t k = 0; k == 0 || k < belts || k < controls; k++) {
            picture.belt = k;
            picture.control = controls > 0 ? k : picture.control;
            add_plot(a, &picture, start, out);
        }
    }
}

enum ceduo_status ceduo_ask_pictures(struct ceduo_question *q, bool cells, size_t trajectories, struct answered *a)
{
    double cell_x[CEDUO_SNAPSHOT_CELLS];
    *a = (struct answered){0};
    q->run.cells = cells ? ceduo_snapshot_places(q->run.scene, cell_x) : 0;
    q->run.cell_x = cell_x;
    enum ceduo_status status = ceduo_ask(q, &a->pool, &a->answer);
    const struct ceduo_snapshot_def def = {.scene = q->run.scene,
                                           .figures = a->pool,
                                           .pictures = a->pool,
                                           .cells = q->run.cells,
                                           .cell_x = cell_x,
                                           .trajectories = trajectories,
                                           .cancel = q->run.cancel};
    if (status == CEDUO_OK)
        status = ceduo_snapshot_create(&def, &a->snapshot);
    return status == CEDUO_OK ? ceduo_verdict_make(a->answer.result, a->answer.years, &a->verdict) : status;
}

void ceduo_answered_release(struct answered *a)
{
    ceduo_verdict_release(&a->verdict);
    ceduo_snapshot_free(a->snapshot);
    ceduo_answer_release(&a->answer);
    ceduo_pool_free(a->pool);
}

static enum exit_status print_doubt(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct asked_doubt d;
    enum ceduo_status status = ceduo_sensitivity_of(a, file, &d);
    struct ceduo_picture picture = {
        .scene = &file->scene, .control = ceduo_scene_last_control(&file->scene), .doubt = &d.report};
    for (size_t start = out->length; status == CEDUO_OK && picture.option < file->scene.options_count; picture.option++)
        add_plot(a, &picture, start, out);
    ceduo_sensitivity_release(&d);
    return status == CEDUO_OK ? EXIT_DONE : ceduo_batch_failed(file, status);
}

enum exit_status ceduo_print_plots(const struct arguments *a, struct scene_file *file, struct text *out)
{
    if (a->plot == CEDUO_PLOT_DOUBT)
        return print_doubt(a, file, out);
    if (!(ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_RUN)) {
        add_plots(a, &file->scene, NULL, NULL, NULL, out);
        return EXIT_DONE;
    }
    ceduo_batch_warn(a, file);
    struct progress progress = ceduo_progress_begin(a);
    struct ceduo_question q = ceduo_batch_question(a, file, &progress);
    struct answered answered;
    enum exit_status done = EXIT_DONE;
    q.run.other_energy = false;
    q.years |= a->plot == CEDUO_PLOT_ROTATION || a->plot == CEDUO_PLOT_TRADEOFF;
    enum ceduo_status status = ceduo_ask_pictures(&q, ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_CELLS,
                                                  a->plot == CEDUO_PLOT_PROFILE ? CEDUO_SNAPSHOT_TRAJECTORIES : 0, &answered);
    if (status == CEDUO_OK) {
        add_plots(a, &file->scene, answered.snapshot, answered.answer.years, &answered.verdict, out);
        done = ceduo_finished(answered.answer.result);
    }
    ceduo_answered_release(&answered);
    return status == CEDUO_OK ? done : ceduo_batch_failed(file, status);
}
