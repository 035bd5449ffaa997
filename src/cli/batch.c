/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scene by scene: --batch, --plot and --check; and what other modes share of that. */
#include "batch.h"

#include <stdlib.h>

#include "interrupt.h"
#include "output.h"
#include "print.h"
#include "say.h"
#include "sensitivity.h"
#include "view/report_doubt.h"

static enum exit_status worse(enum exit_status a, enum exit_status b)
{
    return a > b ? a : b;
}

static enum exit_status print_scene(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct ceduo_question question = ceduo_batch_question(a, file, NULL);
    if (a->plot != CEDUO_PLOT_NONE)
        return ceduo_print_plots(a, file, out);
    return ceduo_print_report(a, file, &question, NULL, -1, out);
}

static enum exit_status batch_scene(const struct arguments *a, size_t i, struct text *out)
{
    struct scene_file file;
    enum exit_status status = ceduo_batch_read(a, a->scenes[i], &file);
    if (status == EXIT_DONE) {
        ceduo_interrupt_catch();
        status = print_scene(a, &file, out);
    }
    ceduo_scene_release(&file);
    return status;
}

/* What stands before the result of a scene. */
static void begin_result(const struct arguments *a, bool first, struct text *out)
{
    if (first && a->format == CEDUO_CSV)
        ceduo_report_csv_header(out, a->stands, a->years);
    else if (!first && a->format == CEDUO_TABLE)
        ceduo_text_char(out, '\n');
}

enum exit_status ceduo_batch_run(const struct arguments *a)
{
    struct output out = {.arguments = a};
    enum exit_status status = EXIT_DONE, written = EXIT_DONE;
    bool first = true;
    for (size_t i = 0; i < a->scenes_count && written == EXIT_DONE; i++) {
        LOCAL_TEXT(one);
        enum exit_status result = batch_scene(a, i, &one);
        status = worse(status, result);
        if (result == EXIT_OUTPUT) /* nothing is written over what was read */
            break;
        if (result <= EXIT_RUN && one.bytes && !atomic_load(ceduo_interrupt_flag())) {
            begin_result(a, first, &out.text);
            ceduo_text_add(&out.text, one.bytes, one.length);
            first = false;
        }
        written = ceduo_output_next(&out);
        status = worse(status, written);
        if (written == EXIT_DONE)
            ceduo_interrupt_release();
    }
    return worse(status, ceduo_output_end(&out, status != EXIT_OUTPUT && !first));
}

enum exit_status ceduo_batch_each(const struct arguments *a, void (*header)(struct text *out),
                                  enum exit_status (*one)(const struct arguments *arguments, struct scene_file *file,
                                                          struct text *out))
{
    LOCAL_TEXT(out);
    enum exit_status status = EXIT_DONE;
    if (a->format == CEDUO_CSV)
        header(&out);
    for (size_t i = 0; i < a->scenes_count; i++) {
        struct scene_file file;
        enum exit_status done = ceduo_batch_read(a, a->scenes[i], &file);
        if (done == EXIT_DONE) {
            ceduo_interrupt_catch();
            done = one(a, &file, &out);
            ceduo_interrupt_release();
        }
        ceduo_scene_release(&file);
        status = worse(status, done);
    }
    ceduo_say_plainly(&out);
    if (status != EXIT_OUTPUT && out.length > 0 && !atomic_load(ceduo_interrupt_flag()))
        status = worse(status, ceduo_output_write(a, &out));
    return status;
}

enum exit_status ceduo_batch_check(const struct arguments *a)
{
    enum exit_status status = EXIT_DONE;
    for (size_t i = 0; i < a->scenes_count; i++) {
        struct scene_file file;
        enum exit_status one = ceduo_batch_read(a, a->scenes[i], &file);
        if (one == EXIT_DONE)
            ceduo_batch_warn(a, &file);
        ceduo_scene_release(&file);
        status = worse(status, one);
    }
    return status;
}

enum exit_status ceduo_batch_sensitivity(const struct arguments *a)
{
    return a->plot != CEDUO_PLOT_NONE ? ceduo_batch_run(a) : ceduo_batch_each(a, ceduo_doubt_csv_header, ceduo_sensitivity_add);
}
