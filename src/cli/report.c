/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --report: a page to hand in, a chapter for each scene. */
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "batch.h"
#include "interrupt.h"
#include "io/inputs.h"
#include "options.h"
#include "output.h"
#include "say.h"
#include "study/outlook.h"
#include "view/page_html.h"
#include "view/page_report.h"

/* Rocks and base points are moderate: a page shows no more digits. */
#define DOUBT_POINTS 64
#define DOUBT_ROCKS  500
#define YEAR_ROCKS   1024
#define YEARS_MOST   50
#define BLOCK_ROCKS  512
#define WAYS         80 /* more are no denser to the eye, and make the page large */

/* ---- the command ---- */

static void put_word(struct text *text, const char *before, const char *word)
{
    ceduo_text_put(text, before);
    if (*word && strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+%@") == strlen(word)) {
        ceduo_text_put(text, word);
        return;
    }
    ceduo_text_char(text, '\'');
    for (; *word; word++)
        ceduo_text_add(text, *word == '\'' ? "'\\''" : word, *word == '\'' ? 4 : 1);
    ceduo_text_char(text, '\'');
}

/* All that decides about the page, and nothing else: not its own name, nor the threads. */
static void put_command(struct text *text, const struct arguments *a)
{
    char number[CEDUO_NUMBER_ROOM];
    ceduo_text_put(text, "ceduo --report report.html");
    if (strcmp(_("en"), "en") != 0)
        put_word(text, " --language ", _("en"));
    if (a->rocks > 0)
        ceduo_text_format(text, " -n %llu", (unsigned long long)a->rocks);
    if (a->tolerance > 0)
        put_word(text, " -e ", ceduo_number_shortest(a->tolerance, number));
    for (size_t i = 0; i < a->sets.n; i++)
        put_word(text, " -s ", a->sets.items[i]);
    for (size_t i = 0; i < a->options.n; i++)
        put_word(text, " --option ", a->options.items[i]);
    if (a->years && a->window.step > 0)
        ceduo_text_format(text, " --years=%u:%u:%u", a->window.first, a->window.last, a->window.step);
    if (ceduo_option_given(a, "sensitivity"))
        ceduo_text_format(text, " --sensitivity=%zu", a->points);
    for (size_t i = 0; i < a->scenes_count; i++)
        put_word(text, " ", a->scenes[i]);
}

/* ---- one scene ---- */

/* All that a chapter is made of. */
struct chapter {
    struct ceduo_pool *pool;
    struct ceduo_answer answer;
    struct ceduo_outlook *outlook;
    struct ceduo_verdict verdict;
    struct scene_inputs inputs;
    struct ceduo_doubt_answer doubt;
    struct ceduo_doubt_report told;
};

static void release(struct chapter *c)
{
    if (c->told.answer)
        ceduo_doubt_free(&c->doubt);
    ceduo_verdict_release(&c->verdict);
    ceduo_outlook_free(c->outlook);
    ceduo_answer_release(&c->answer);
    ceduo_pool_free(c->pool);
}

static enum ceduo_status ask_runs(const struct arguments *a, const struct scene_file *file, struct progress *progress,
                                  struct chapter *c)
{
    double cell_x[CEDUO_OUTLOOK_CELLS];
    struct ceduo_question q = ceduo_batch_question(a, file, progress);
    q.run.cells = ceduo_outlook_places(&file->scene, cell_x);
    q.run.cell_x = cell_x;
    q.years = true;
    q.year_rocks = YEAR_ROCKS;
    q.years_most = a->window.step > 0 ? 0 : YEARS_MOST;
    q.block_rocks = file->scene.options_count == 1 ? BLOCK_ROCKS : 0;
    enum ceduo_status status = ceduo_ask(&q, &c->pool, &c->answer);
    const struct ceduo_outlook_def def = {.scene = &file->scene,
                                          .figures = c->pool,
                                          .pictures = c->pool,
                                          .cells = q.run.cells,
                                          .cell_x = cell_x,
                                          .trajectories = WAYS,
                                          .cancel = q.run.cancel};
    if (status == CEDUO_OK)
        status = ceduo_outlook_create(&def, &c->outlook);
    if (status == CEDUO_OK)
        status = ceduo_verdict_make(c->answer.result, c->answer.years, &c->verdict);
    return status;
}

static enum ceduo_status ask_doubt(const struct arguments *a, struct scene_file *file, struct progress *progress,
                                   struct chapter *c)
{
    uint64_t rocks = ceduo_result_rocks(c->answer.result);
    if (!ceduo_inputs_of(file, &c->inputs))
        return CEDUO_NO_MEMORY;
    const struct ceduo_doubt_def def = {.scene = &file->scene,
                                        .inputs_count = c->inputs.n,
                                        .inputs = c->inputs.items,
                                        .points = ceduo_option_given(a, "sensitivity") ? a->points : DOUBT_POINTS,
                                        .rocks = rocks < DOUBT_ROCKS ? rocks : DOUBT_ROCKS,
                                        .threads = a->threads,
                                        .cancel = ceduo_interrupt_flag(),
                                        .progress = ceduo_progress_steps,
                                        .context = progress};
    c->told = (struct ceduo_doubt_report){
        .file = file, .inputs = &c->inputs, .points = def.points, .rocks = def.rocks, .finer = c->answer.result};
    if (c->inputs.n == 0 || rocks < 2 || file->scene.controls_count == 0)
        return CEDUO_OK;
    enum ceduo_status status = ceduo_doubt_ask(&def, &c->doubt);
    c->told.answer = status == CEDUO_OK ? &c->doubt : NULL;
    return status;
}

static void write_chapter(const struct arguments *a, const struct scene_file *file, const struct chapter *c, size_t number,
                          struct ceduo_html *html)
{
    struct text command = {0};
    struct ceduo_page page = {.width = CEDUO_PAGE_REPORT_WIDTH};
    const struct ceduo_report report = {.file = file,
                                        .result = c->answer.result,
                                        .verdict = &c->verdict,
                                        .blocks = c->answer.blocks,
                                        .remarks = {a->tolerance, c->answer.tolerance_met, file->ground_assumed}};
    put_command(&command, a);
    const struct ceduo_chapter chapter = {&report, c->outlook, c->answer.years, &c->told, ceduo_text_string(&command)};
    ceduo_page_chapter(&page, &chapter);
    ceduo_page_html(html, &page, number);
    html->text->failed |= command.failed;
    ceduo_page_free(&page);
    ceduo_text_free(&command);
}

static enum exit_status add_chapter(const struct arguments *a, struct scene_file *file, size_t number, struct ceduo_html *html)
{
    struct progress progress = ceduo_progress_begin(a);
    struct chapter c = {0};
    enum exit_status done = EXIT_DONE;
    enum ceduo_status status = ask_runs(a, file, &progress, &c);
    if (status == CEDUO_OK)
        status = ask_doubt(a, file, &progress, &c);
    ceduo_progress_end(&progress);
    if (status == CEDUO_OK) {
        write_chapter(a, file, &c, number, html);
        done = ceduo_result_unfinished(c.answer.result) * 1000 > ceduo_result_rocks(c.answer.result) ? EXIT_RUN : EXIT_DONE;
    }
    release(&c);
    return status == CEDUO_OK ? done : ceduo_batch_failed(file, status);
}

/* ---- the file ---- */

/* Adds the chapter of a scene that can be read; `*title`: of the first one. */
static enum exit_status read_and_add(const struct arguments *a, const char *path, struct text *title, size_t *chapters,
                                     struct ceduo_html *html)
{
    struct scene_file file;
    enum exit_status done = ceduo_batch_read(a, path, &file);
    if (done == EXIT_DONE) {
        size_t before = html->text->length;
        ceduo_interrupt_catch();
        done = add_chapter(a, &file, *chapters + 1, html);
        ceduo_interrupt_release();
        if (html->text->length > before && ++*chapters == 1)
            ceduo_text_put(title, ceduo_in_language(file.scene.title, file.scene.title_it));
    }
    ceduo_scene_release(&file);
    return done;
}

enum exit_status ceduo_batch_report(const struct arguments *a)
{
    struct text all = {0}, body = {0}, title = {0};
    struct ceduo_html html = {.text = &body}, page = {.text = &all};
    enum exit_status status = EXIT_DONE;
    size_t chapters = 0;
    for (size_t i = 0; i < a->scenes_count && !atomic_load(ceduo_interrupt_flag()); i++) {
        enum exit_status done = read_and_add(a, a->scenes[i], &title, &chapters, &html);
        status = done > status ? done : status;
    }
    ceduo_page_html_begin(&page, ceduo_text_string(&title));
    ceduo_text_add(&all, ceduo_text_string(&body), body.length);
    ceduo_page_html_end(&page);
    all.failed |= body.failed || title.failed;
    if (chapters > 0 && status != EXIT_OUTPUT && !atomic_load(ceduo_interrupt_flag())) {
        enum exit_status written = ceduo_output_write(a, &all);
        status = written > status ? written : status;
    }
    ceduo_text_free(&all);
    ceduo_text_free(&body);
    ceduo_text_free(&title);
    return status;
}
