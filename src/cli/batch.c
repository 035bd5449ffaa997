/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scene by scene: --batch, --plot and --check; and what other modes share of that. */
#include "batch.h"

#include <stdlib.h>

#include "base/must.h"
#include "interrupt.h"
#include "output.h"
#include "print.h"
#include "say.h"
#include "sensitivity.h"
#include "view/figures.h"
#include "view/page.h"

static enum exit_status worse(enum exit_status a, enum exit_status b)
{
    return a > b ? a : b;
}

/* Pages of several scenes come behind a table of their verdicts, in its order. `starts`: where each begins, and the end. */
static void put_verdicts(struct text *text, struct ceduo_profiles *profiles, const size_t *starts)
{
    struct text pages = *text;
    struct ceduo_page verdicts = {.width = CEDUO_PAGE_WIDTH};
    size_t *order = ceduo_must(calloc(profiles->count, sizeof *order)), n = ceduo_profiles_sort(profiles, order);
    *text = (struct text){0};
    ceduo_profiles_page(&verdicts, profiles);
    ceduo_page_print(text, &verdicts, !ceduo_say_utf8());
    ceduo_page_free(&verdicts);
    ceduo_say_plainly(text);
    for (size_t i = 0; i < n; i++) {
        ceduo_text_char(text, '\n');
        ceduo_text_add(text, pages.bytes + starts[order[i]], starts[order[i] + 1] - starts[order[i]]);
    }
    free(order);
    ceduo_text_free(&pages);
}

/* Prints the answer of each scene, under one head of CSV. */
static enum exit_status answer_all(const struct arguments *given, const struct text *header, ceduo_batch_answer *answer)
{
    struct ceduo_profiles profiles = {0};
    struct arguments arguments = *given, *a = &arguments;
    struct output out = {.arguments = a};
    struct each each;
    a->profiles = &profiles;
    enum exit_status status = ceduo_each_open(&each, a, header), written = status;
    struct progress progress = ceduo_progress_begin(a);
    size_t computed = 0, *starts = ceduo_must(calloc(each.count + 2, sizeof *starts));
    bool first = true;
    while (written == EXIT_DONE && ceduo_each_next(&each)) {
        LOCAL_TEXT(one);
        ceduo_progress_scenes(&progress, computed++, each.at - 1, each.count);
        struct scene_file file;
        enum exit_status result = ceduo_batch_read(&each.arguments, each.path, &file);
        if (result == EXIT_DONE) {
            ceduo_interrupt_catch();
            result = answer(&each.arguments, &file, &one);
        }
        ceduo_scene_release(&file);
        status = worse(status, result);
        if (result > EXIT_RUN ||
            (result == EXIT_RUN && !one.bytes)) /* what is printed has not failed, unfinished as it may be */
            ceduo_each_fail(&each);
        if (result == EXIT_OUTPUT) /* nothing is written over what was read */
            break;
        if (result <= EXIT_RUN && one.bytes && !atomic_load(ceduo_interrupt_flag())) {
            if (first)
                ceduo_each_header(&each, header, &out.text);
            else if (a->format == CEDUO_TABLE && profiles.count == 0)
                ceduo_text_char(&out.text, '\n');
            ceduo_each_add(&each, &one, &out.text);
            starts[profiles.count] = out.text.length;
            first = false;
        }
        written = profiles.count > 0 ? EXIT_DONE : ceduo_output_next(&out);
        status = worse(status, written);
        if (written == EXIT_DONE)
            ceduo_interrupt_release();
    }
    if (profiles.count > 1)
        put_verdicts(&out.text, &profiles, starts);
    free(starts);
    if (profiles.count > 0)
        status = worse(status, ceduo_output_next(&out));
    status = worse(status, each.bad_rows ? EXIT_INPUT : EXIT_DONE);
    ceduo_each_close(&each);
    ceduo_profiles_free(&profiles);
    return worse(status, ceduo_output_end(&out, status != EXIT_OUTPUT && !first));
}

enum exit_status ceduo_batch_each(const struct arguments *a, const struct ceduo_csv *csv, ceduo_batch_answer *answer)
{
    LOCAL_TEXT(head);
    if (a->format == CEDUO_CSV)
        ceduo_csv_head(&head, csv);
    return answer_all(a, &head, answer);
}

enum exit_status ceduo_batch_run(const struct arguments *a)
{
    return ceduo_batch_each(a, ceduo_result_csv(a->stands, a->years),
                            a->plot != CEDUO_PLOT_NONE ? ceduo_print_plots : ceduo_print_report);
}

static enum exit_status check(const struct arguments *a, struct scene_file *file, struct text *out)
{
    (void)out;
    ceduo_batch_warn(a, file);
    return EXIT_DONE;
}

enum exit_status ceduo_batch_check(const struct arguments *a)
{
    return answer_all(a, &(struct text){0}, check);
}

enum exit_status ceduo_batch_sensitivity(const struct arguments *a)
{
    return a->plot != CEDUO_PLOT_NONE ? ceduo_batch_run(a) : ceduo_batch_each(a, &ceduo_doubt_csv, ceduo_sensitivity_add);
}
