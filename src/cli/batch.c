/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes scenes one by one: --batch, --plot, --find, --sensitivity, --report and --check; with --each, once for each row. */
#include "batch.h"

#include <inttypes.h>
#include <stdio.h>
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
    struct text head; /* head of the output in CSV */
    struct text out;  /* not written yet */
    bool first;       /* no answer was printed yet */
    uint64_t runs;    /* hash of all inputs */
};

/* Append the answer of the current scene, or the reason of its failure. */
static void append_answer(struct batch *b, const struct text *answer, const struct ceduo_row_state *state)
{
    const struct arguments *a = &b->arguments;
    bool row = b->each.rows;
    if (a->region) { /* its page is printed at the end */
    } else if (a->format == CEDUO_CSV) {
        if (b->first && !a->resume)
            ceduo_text_append_n(&b->out, b->head.bytes, b->head.length);
        ceduo_columns_visit(&b->columns, answer, state, ceduo_columns_print, &b->out);
    } else if (a->format == CEDUO_GEOJSON) {
        if (b->first)
            ceduo_text_append(&b->out, "{\"type\": \"FeatureCollection\", \"features\": [\n");
        else
            ceduo_text_append(&b->out, ",\n");
        ceduo_columns_visit(&b->columns, answer, state, ceduo_geojson_print, &b->out);
        ceduo_text_cut(&b->out, b->out.length - 2); /* the last comma */
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

/* Put a table of verdicts before the pages of several scenes, and sort the pages, the worst first. `starts`: begin of each
 * page, and the end of the last. A report gets head and end of HTML, too. */
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
    if (status == EXIT_DONE)
        status = ceduo_columns_open(&b->columns, &b->each, ceduo_format_has_columns(a->format) ? choose_csv(a)->columns : NULL);
    if (status == EXIT_DONE && a->format == CEDUO_CSV)
        ceduo_columns_head(&b->columns, &b->head);
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

/* Append the reason of a failure, in English if it is data. */
static void append_reason(struct each *each, struct text *reason)
{
    bool data = each->given->format != CEDUO_TABLE;
    const struct arguments *a = &each->arguments;
    struct scene_sets sets = {a->sets.items, a->sets.n, a->cells, a->called};
    LOCAL_PROBLEMS(problems);
    problems.brief = true;
    struct scene_file file;
    ceduo_each_reason(each, reason);
    if (reason->length > 0)
        return;
    ceduo_language_set_data(data);
    ceduo_scene_load_row(&file, each->path, &sets, &problems);
    ceduo_language_set_data(false);
    ceduo_scene_release(&file);
    bool announces = problems.wrong.n > 1 && strchr(problems.wrong.items[0].message, ':') ==
                                                 problems.wrong.items[0].message + strlen(problems.wrong.items[0].message) - 1;
    struct problem first = problems.wrong.items[announces]; /* "valid without this change, but not with it:" */
    if (problems.wrong.n == 0) {
        ceduo_text_append(reason, data ? N_("not computed; see the messages of the run")
                                       : _("not computed; see the messages of the run"));
        return;
    }
    if (strcmp(first.place, a->called) == 0)
        first.place = "";
    ceduo_problem_line(&first, reason);
}

/* Write a row that failed. It is one of the answers if these are lines of data. */
static enum exit_status write_failed(struct batch *b, uint64_t key, const char *run, enum exit_status result)
{
    LOCAL_TEXT(reason);
    LOCAL_TEXT(answer);
    enum exit_status known;
    const struct arguments *a = &b->arguments;
    if (!b->each.rows || (a->format == CEDUO_TABLE && !a->region))
        return EXIT_DONE;
    append_reason(&b->each, &reason);
    if (a->region) {
        const struct arguments *row = &b->each.arguments;
        ceduo_region_add_failed(a->region, row->label ? row->label : b->each.name, row->number, ceduo_text_string(&reason));
        b->first = false;
        return EXIT_DONE;
    }
    hash_count(&key, hash_bytes(ceduo_text_string(&reason), reason.length));
    if (a->resume && ceduo_resume_has(&b->resume, key, &known))
        return EXIT_DONE;
    const struct ceduo_row_state state = {ceduo_text_string(&reason), run};
    if (a->format == CEDUO_JSON)
        ceduo_figures_json(&answer, ceduo_failed_figures, &state, false);
    append_answer(b, &answer, &state);
    return write_next(b, key, result);
}

/* Compute the current scene unless the output has it. */
static enum exit_status compute(struct batch *b, ceduo_batch_answer *answer, enum exit_status *output_status)
{
    struct each *each = &b->each;
    struct scene_file file = {.path = NULL};
    bool resume = b->arguments.resume, bad = each->row && each->row->bad;
    uint64_t key = ceduo_each_hash(each);
    enum exit_status result;
    char run[17] = "";
    LOCAL_TEXT(answer_text);
    if (resume && !bad && !each->names_files && ceduo_resume_has(&b->resume, key, &result))
        return result;
    result = bad ? EXIT_INPUT : ceduo_batch_read(&each->arguments, each->path, &file);
    if (each->names_files)
        hash_count(&key, ceduo_resume_files(&file));
    bool done = resume && result == EXIT_DONE && each->names_files && ceduo_resume_has(&b->resume, key, &result);
    if (b->arguments.region)
        hash_count(&b->runs, ceduo_resume_run(&each->arguments, &file));
    if (b->columns.run_wanted)
        snprintf(run, sizeof run, "%016" PRIx64, ceduo_resume_run(&each->arguments, &file));
    if (result == EXIT_DONE && !done) {
        ceduo_interrupt_catch();
        result = answer(&each->arguments, &file, &answer_text);
    }
    if (!bad)
        ceduo_scene_release(&file);
    bool failed = result > EXIT_RUN || (result == EXIT_RUN && !answer_text.bytes); /* an unfinished answer is printed */
    if (done || atomic_load(ceduo_interrupt_flag()))
        return result;
    if (failed)
        ceduo_each_note_failed(each);
    if (failed && result != EXIT_OUTPUT)
        *output_status = write_failed(b, key, run, result);
    if (failed || !answer_text.bytes)
        return result;
    append_answer(b, &answer_text, &(struct ceduo_row_state){.run = run});
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

/* Append the chapters of the worst lines to `text`. */
static enum exit_status add_chapters(struct batch *b, size_t n, struct text *text)
{
    enum exit_status status = EXIT_DONE;
    struct each *each = &b->each;
    for (size_t i = 0; i < n && !atomic_load(ceduo_interrupt_flag()); i++) {
        struct scene_file file;
        const char *name;
        each->current = ceduo_region_scene(b->arguments.region, i, &name);
        ceduo_each_next(each);
        enum exit_status result = ceduo_batch_read(&each->arguments, each->path, &file);
        const char *title = ceduo_in_language(file.scene.title, file.scene.title_it);
        file.scene.title_it = NULL;
        file.scene.title = ceduo_arena_format(&file.arena, "%zu. %s: %s", i + 1, title ? title : "", name);
        if (result == EXIT_DONE)
            result = ceduo_print_chapter(&each->arguments, &file, text);
        ceduo_scene_release(&file);
        status = worse(status, result);
    }
    return status;
}

/* Write the page of a region. */
static enum exit_status write_region(struct batch *b)
{
    struct arguments *a = &b->arguments;
    const struct source *table = b->each.table.source;
    LOCAL_TEXT(command);
    LOCAL_TEXT(chapters);
    LOCAL_PAGE(page, CEDUO_PAGE_REPORT_WIDTH);
    struct ceduo_html html = {.text = &b->out};
    size_t judged = ceduo_region_sort(a->region), n = a->chapters < judged ? (size_t)a->chapters : judged;
    enum exit_status status = add_chapters(b, n, &chapters);
    ceduo_print_command(&command, a);
    const struct ceduo_region_origin origin = {.table = table->name,
                                               .table_hash = hash_bytes(table->bytes, table->length),
                                               .run = b->runs,
                                               .command = ceduo_text_string(&command),
                                               .chapters = n};
    ceduo_region_page(&page, a->region, &origin);
    ceduo_page_html_begin(&html, a->region->title ? a->region->title : "ceduo");
    ceduo_page_html(&html, &page, n + 1);
    ceduo_text_append_n(&b->out, ceduo_text_string(&chapters), chapters.length);
    ceduo_page_html_end(&html);
    return a->output ? status : worse(status, ceduo_output_write(a, &b->out));
}

static enum exit_status end_features(struct batch *b)
{
    ceduo_text_append(&b->out, "\n]}\n");
    return b->arguments.output ? EXIT_DONE : ceduo_output_next(&b->output, &b->arguments, &b->out);
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
    struct ceduo_region region = {0};
    struct batch b = {.arguments = *given, .resume = {.file = -1, .side = -1}, .first = true};
    struct arguments *a = &b.arguments;
    a->profiles = &profiles;
    a->title = &title;
    a->region = a->mode == MODE_REPORT && a->each ? &region : NULL;
    enum exit_status status = open_batch(&b, a);
    bool opened = status == EXIT_DONE;
    size_t *starts = ceduo_check_memory(calloc(b.each.count + 2, sizeof *starts));
    if (opened)
        status = compute_all(&b,
                             given->plot != CEDUO_PLOT_NONE ? ceduo_print_plots
                             : a->region                    ? ceduo_print_line
                                                            : answers[given->mode],
                             starts);
    if (a->region && opened && status != EXIT_OUTPUT && !atomic_load(ceduo_interrupt_flag()))
        status = worse(status, write_region(&b));
    else if (profiles.count > (a->mode == MODE_REPORT ? 0u : 1u))
        add_verdicts(&b.out, a, starts);
    free(starts);
    if (profiles.count > 0 && !a->output && !a->region)
        status = worse(status, ceduo_output_write(a, &b.out));
    bool failed = status == EXIT_OUTPUT;
    if (a->format == CEDUO_GEOJSON && !b.first && !failed)
        status = worse(status, end_features(&b));
    if (a->resume)
        status = worse(status, ceduo_resume_close(&b.resume, opened && !failed));
    else
        status = worse(status, ceduo_output_end(&b.output, a, &b.out, !b.first && !failed));
    status = worse(status, b.each.bad_rows ? EXIT_INPUT : EXIT_DONE);
    ceduo_each_close(&b.each);
    ceduo_profiles_free(&profiles);
    ceduo_region_free(&region);
    ceduo_columns_close(&b.columns);
    ceduo_text_free(&b.head);
    ceduo_text_free(&b.out);
    return status;
}
