/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --sensitivity: what doubt does to the figures of a scene. */
#include "batch.h"
#include "interrupt.h"
#include "io/inputs.h"
#include "say.h"
#include "view/report_doubt.h"

#define ROCKS_USUAL 2000 /* of each evaluation */

static void put(struct text *out, const struct arguments *a, const struct ceduo_doubt_report *report)
{
    if (a->format == CEDUO_TABLE && out->length > 0)
        ceduo_text_char(out, '\n');
    if (a->format == CEDUO_JSON)
        ceduo_doubt_json(out, report);
    else if (a->format == CEDUO_CSV)
        ceduo_doubt_csv(out, report);
    else
        ceduo_doubt_page(out, report, !ceduo_say_utf8());
}

static enum exit_status compute(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct scene_inputs inputs;
    struct ceduo_doubt_answer answer;
    struct progress progress = ceduo_progress_begin(a);
    if (!ceduo_inputs_of(file, &inputs))
        return ceduo_batch_failed(file, CEDUO_NO_MEMORY);
    struct ceduo_doubt_def def = {.scene = &file->scene,
                                  .inputs_count = inputs.n,
                                  .inputs = inputs.items,
                                  .points = a->points,
                                  .rocks = a->rocks > 0 ? a->rocks : ROCKS_USUAL,
                                  .threads = a->threads,
                                  .cancel = ceduo_interrupt_flag(),
                                  .progress = ceduo_progress_steps,
                                  .context = &progress};
    struct ceduo_doubt_report report = {
        .file = file, .inputs = &inputs, .points = a->points, .rocks = def.rocks, .answer = &answer};
    if (inputs.n == 0) {
        report.answer = NULL;
        put(out, a, &report);
        return EXIT_DONE;
    }
    enum ceduo_status status = ceduo_doubt_ask(&def, &answer);
    ceduo_progress_end(&progress);
    if (status != CEDUO_OK)
        return ceduo_batch_failed(file, status);
    put(out, a, &report);
    ceduo_doubt_free(&answer);
    return EXIT_DONE;
}

enum exit_status ceduo_batch_sensitivity(const struct arguments *a)
{
    return ceduo_batch_each(a, ceduo_doubt_csv_header, compute);
}
