/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --sensitivity: what doubt does to the figures of a scene. */
#include "sensitivity.h"

#include <stdlib.h>

#include "interrupt.h"
#include "io/inputs.h"
#include "say.h"
#include "view/report_doubt.h"

#define ROCKS_USUAL 2000 /* of each evaluation */

static void put(struct text *out, const struct arguments *a, const struct ceduo_doubt_report *report)
{
    struct text page = {0};
    if (a->format == CEDUO_JSON) {
        ceduo_doubt_json(out, report);
        return;
    }
    if (a->format == CEDUO_CSV) {
        ceduo_doubt_csv(out, report);
        return;
    }
    bool plain = !ceduo_say_utf8();
    ceduo_doubt_page(&page, report, plain);
    if (plain)
        ceduo_say_plainly(&page);
    ceduo_text_put(out, ceduo_text_string(&page));
    out->failed |= page.failed;
    ceduo_text_free(&page);
}

static struct ceduo_doubt_def def_of(const struct arguments *a, const struct scene_file *file,
                                     const struct scene_inputs *inputs, struct progress *progress)
{
    return (struct ceduo_doubt_def){.scene = &file->scene,
                                    .inputs_count = inputs->n,
                                    .inputs = inputs->items,
                                    .points = a->points > 0 ? a->points : CEDUO_DOUBT_POINTS,
                                    .rocks = a->rocks > 0 ? a->rocks : ROCKS_USUAL,
                                    .threads = a->threads,
                                    .cancel = ceduo_interrupt_flag(),
                                    .progress = ceduo_progress_steps,
                                    .context = progress};
}

enum ceduo_status ceduo_sensitivity_ask(const struct arguments *a, struct scene_file *file, struct asked_doubt *d)
{
    struct progress progress = ceduo_progress_begin(a);
    *d = (struct asked_doubt){0};
    if (!ceduo_inputs_of(file, &d->inputs))
        return CEDUO_NO_MEMORY;
    struct ceduo_doubt_def def = def_of(a, file, &d->inputs, &progress);
    d->report = (struct ceduo_doubt_report){.file = file, .inputs = &d->inputs, .points = def.points, .rocks = def.rocks};
    if (d->inputs.n == 0)
        return CEDUO_OK;
    enum ceduo_status status = ceduo_doubt_ask(&def, &d->answer);
    ceduo_progress_end(&progress);
    d->report.answer = status == CEDUO_OK ? &d->answer : NULL;
    return status;
}

enum exit_status ceduo_sensitivity_whole(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct asked_doubt d;
    ceduo_batch_warn(a, file);
    enum ceduo_status status = ceduo_sensitivity_ask(a, file, &d);
    if (status != CEDUO_OK)
        return ceduo_batch_failed(file, status);
    if (a->format == CEDUO_TABLE && out->length > 0)
        ceduo_text_char(out, '\n');
    put(out, a, &d.report);
    if (d.report.answer)
        ceduo_doubt_free(&d.answer);
    return EXIT_DONE;
}
