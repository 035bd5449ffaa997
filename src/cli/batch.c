/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes scenes one by one: --batch, --plot, --find, --sensitivity, --report and --check; with --each, once for each row. */
#include "batch.h"

#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"
#include "each.h"
#include "messages.h"
#include "resume.h"
#include "view/figures.h"
#include "view/page.h"
#include "view/svg.h"

/* All scenes and their output. */
struct batch {
    struct arguments arguments;
    struct each each;
    struct columns columns;
    struct resume resume;
    struct output output;
    struct text header; /* of the result in CSV */
    struct text head;   /* head of the output in CSV */
    struct text out;    /* not written yet */
    bool first;         /* no answer was printed yet */
};

/* Append the answer of the current scene. */
static void append_answer(struct batch *b, const struct text *answer)
{
    const struct arguments *a = &b->arguments;
    bool row = b->each.rows;
    if (a->format == CEDUO_CSV) {
        if (b->first && !a->resume)
            ceduo_text_append_n(&b->out, b->head.bytes, b->head.length);
        ceduo_columns_lines(&b->columns, answer, &b->out);
    } else if (a->format == CEDUO_JSON && row) {
        struct json json = {.text = &b->out};
        ceduo_json_open(&json, NULL, '{');
        ceduo_each_json(&b->each, &json);
        ceduo_text_append(&b->out, ", ");
        ceduo_text_append(&b->out, ceduo_text_string(answer) + 1);
    } else {
        if (!b->first && a->format == CEDUO_TABLE && a->profiles->count == 0 && a->mode != MODE_CHECK)
            ceduo_text_append_char(&b->out, '\n');
        if (row)
            ceduo_each_page(&b->each, &b->out);
        ceduo_text_append_n(&b->out, answer->bytes, answer->length);
    }
    b->first = false;
}

static enum exit_status worse(enum exit_status a, enum exit_status b)
{
    return a > b ? a : b;
}

/* Put a table of verdicts before the pages of several scenes, and sort the pages, the worst first. `starts`: begin of each page,
 * and the end of the last. A report gets head and end of HTML, too. */
static void add_verdicts(struct text *text, const struct arguments *a, const size_t *starts)
{
    struct text pages = *text;
    bool html = a->mode == MODE_REPORT;
    struct ceduo_html to = {.text = text};
    LOCAL_PAGE(verdicts, html ? CEDUO_PAGE_REPORT_WIDTH : CEDUO_PAGE_WIDTH);
    size_t *order = ceduo_check_memory(calloc(a->profiles->count + 1, sizeof *order)),
           n = ceduo_profiles_sort(a->profiles, order);
    *text = (struct text){0};
    if (html)
        ceduo_page_html_begin(&to, ceduo_text_string(a->title));
    if (html && n > 1)
        ceduo_page_para(&verdicts, CEDUO_PAGE_TITLE, _("%zu scenes, the worst first"), n);
    if (n > 1)
        ceduo_profiles_page(&verdicts, a->profiles);
    if (html && n > 1) {
        ceduo_page_html(&to, &verdicts, n + 1);
    } else if (!html) {
        ceduo_page_print(text, &verdicts, !ceduo_is_utf8());
        ceduo_fit_charset(text);
    }
    for (size_t i = 0; i < n; i++) {
        if (!html)
            ceduo_text_append_char(text, '\n');
        ceduo_text_append_n(text, pages.bytes + starts[order[i]], starts[order[i] + 1] - starts[order[i]]);
    }
    if (html)
        ceduo_page_html_end(&to);
    free(order);
    ceduo_text_free(&pages);
}

static void add_line(void *out, const char *line)
{
    ceduo_text_format(out, "%s\n", line);
}

static enum exit_status check_scene(const struct arguments *a, struct scene_file *file, struct text *out)
{
    if (!a->quiet)
        ceduo_notes_each(file->notes, CEDUO_NOTE_TABLE, add_line, out);
    ceduo_batch_warn(a, file, true);
    return EXIT_DONE;
}

static const struct ceduo_csv *choose_csv(const struct arguments *a)
{
    return a->mode == MODE_FIND          ? &ceduo_find_csv
           : a->mode == MODE_SENSITIVITY ? &ceduo_uncertainty_csv
                                         : ceduo_result_csv(a->stands, a->years);
}

/* Read the table of --each and, with --resume, the output. */
static enum exit_status open_batch(struct batch *b, const struct arguments *given)
{
    const struct arguments *a = &b->arguments;
    enum exit_status status = ceduo_each_open(&b->each, given);
    if (a->format == CEDUO_CSV)
        ceduo_csv_head(&b->header, choose_csv(a));
    if (status == EXIT_DONE)
        status = ceduo_columns_open(&b->columns, &b->each, &b->header);
    if (status == EXIT_DONE && a->format == CEDUO_CSV)
        ceduo_columns_head(&b->columns, &b->header, &b->head);
    return status == EXIT_DONE && a->resume ? ceduo_resume_open(&b->resume, &b->each, &b->head) : status;
}

/* Write the answer of a scene; with --resume, its lines and its key. */
static enum exit_status write_next(struct batch *b, uint64_t key, enum exit_status result)
{
    if (!b->arguments.resume)
        return b->arguments.profiles->count > 0 ? EXIT_DONE : ceduo_output_next(&b->output, &b->arguments, &b->out);
    enum exit_status status = ceduo_resume_add(&b->resume, key, &b->out, result);
    ceduo_text_cut(&b->out, 0);
    return status;
}

/* Compute the current scene unless the output has it. */
static enum exit_status compute(struct batch *b, ceduo_batch_answer *answer, enum exit_status *output_status)
{
    struct each *each = &b->each;
    struct scene_file file;
    bool resume = b->arguments.resume;
    uint64_t key = ceduo_each_hash(each);
    enum exit_status result;
    LOCAL_TEXT(answer_text);
    if (resume && !each->names_files && ceduo_resume_has(&b->resume, key, &result))
        return result;
    result = ceduo_batch_read(&each->arguments, each->path, &file);
    if (each->names_files)
        hash_count(&key, ceduo_resume_files(&file));
    bool done = resume && result == EXIT_DONE && each->names_files && ceduo_resume_has(&b->resume, key, &result);
    if (result == EXIT_DONE && !done) {
        ceduo_interrupt_catch();
        result = answer(&each->arguments, &file, &answer_text);
    }
    ceduo_scene_release(&file);
    if (done)
        return result;
    if (result > EXIT_RUN ||
        (result == EXIT_RUN && !answer_text.bytes)) /* an unfinished answer is printed and does not count as failed */
        ceduo_each_note_failed(each);
    if (result > EXIT_RUN || !answer_text.bytes || atomic_load(ceduo_interrupt_flag()))
        return result;
    append_answer(b, &answer_text);
    *output_status = write_next(b, key, result);
    return result;
}

/* Compute all scenes. starts[i]: begin of page i; after the last page, its end. */
static enum exit_status compute_all(struct batch *b, ceduo_batch_answer *answer, size_t *starts)
{
    struct progress progress = ceduo_progress_begin(&b->arguments);
    enum exit_status status = EXIT_DONE, output_status = EXIT_DONE, result = EXIT_DONE;
    size_t computed = 0;
    while (output_status == EXIT_DONE && result != EXIT_OUTPUT &&
           ceduo_each_next(&b->each)) { /* EXIT_OUTPUT: the output is an input */
        ceduo_progress_scenes(&progress, computed++, b->each.current - 1, b->each.count);
        result = compute(b, answer, &output_status);
        status = worse(status, worse(result, output_status));
        starts[b->arguments.profiles->count] = b->out.length;
        if (output_status == EXIT_DONE && !b->output.begun)
            ceduo_interrupt_release();
        if (atomic_load(ceduo_interrupt_flag()))
            break;
    }
    return status;
}

/* Print the answer of each scene; CSV has one head. */
enum exit_status ceduo_batch_run(const struct arguments *given)
{
    static ceduo_batch_answer *const answers[] = {[MODE_BATCH] = ceduo_print_report,
                                                  [MODE_FIND] = ceduo_print_find,
                                                  [MODE_SENSITIVITY] = ceduo_print_uncertainty,
                                                  [MODE_REPORT] = ceduo_print_chapter,
                                                  [MODE_CHECK] = check_scene};
    LOCAL_TEXT(title);
    struct ceduo_profiles profiles = {0};
    struct batch b = {.arguments = *given, .resume = {.file = -1, .side = -1}, .first = true};
    struct arguments *a = &b.arguments;
    a->profiles = &profiles;
    a->title = &title;
    enum exit_status status = open_batch(&b, a);
    bool opened = status == EXIT_DONE;
    size_t *starts = ceduo_check_memory(calloc(b.each.count + 2, sizeof *starts));
    if (opened)
        status = compute_all(&b, given->plot != CEDUO_PLOT_NONE ? ceduo_print_plots : answers[given->mode], starts);
    if (profiles.count > (a->mode == MODE_REPORT ? 0u : 1u))
        add_verdicts(&b.out, a, starts);
    free(starts);
    if (profiles.count > 0 && !a->output)
        status = worse(status, ceduo_output_write(a, &b.out));
    bool failed = status == EXIT_OUTPUT;
    if (a->resume)
        status = worse(status, ceduo_resume_close(&b.resume, opened && !failed));
    else
        status = worse(status, ceduo_output_end(&b.output, a, &b.out, !b.first && !failed));
    status = worse(status, b.each.bad_rows ? EXIT_INPUT : EXIT_DONE);
    ceduo_each_close(&b.each);
    ceduo_profiles_free(&profiles);
    ceduo_text_free(&b.header);
    ceduo_text_free(&b.head);
    ceduo_text_free(&b.out);
    return status;
}
