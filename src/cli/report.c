/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --report: a page to hand in, a chapter for each scene. */
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/must.h"
#include "batch.h"
#include "interrupt.h"
#include "options.h"
#include "output.h"
#include "print.h"
#include "say.h"
#include "sensitivity.h"
#include "study/snapshot.h"
#include "view/html.h"
#include "view/page.h"
#include "view/report.h"

/* Rocks and points are moderate: a page shows no more digits. */
#define YEAR_ROCKS  1024
#define BLOCK_ROCKS 512
#define WAYS        80 /* more are no denser to the eye, and make the page large */

/* ---- the command ---- */

static void append_word(struct text *text, const char *before, const char *word)
{
    static const char *const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+%@";
    ceduo_text_put(text, before);
    if (*word && strspn(word, plain) == strlen(word))
        ceduo_text_put(text, word);
    else
        ceduo_text_quoted(text, word);
}

/* All that decides about the page, and nothing else: not its own name, nor the threads. */
static void append_command(struct text *text, const struct arguments *a)
{
    ceduo_text_put(text, "ceduo --report report.html");
    if (strcmp(_("en"), "en") != 0)
        append_word(text, " --language ", _("en"));
    if (a->rocks > 0)
        ceduo_text_format(text, " -n %llu", (unsigned long long)a->rocks);
    if (a->tolerance > 0)
        append_word(text, " -e ", ceduo_number_shortest(a->tolerance, (char[CEDUO_NUMBER_ROOM]){0}));
    for (size_t i = 0; i < a->sets.n; i++)
        append_word(text, " -s ", a->sets.items[i]);
    for (size_t i = 0; i < a->options.n; i++)
        append_word(text, " --option ", a->options.items[i]);
    if (a->years && a->window.step > 0)
        ceduo_text_format(text, " --years=%u:%u:%u", a->window.first, a->window.last, a->window.step);
    if (ceduo_option_given(a, "sensitivity"))
        ceduo_text_format(text, " --sensitivity=%zu", a->points);
    for (size_t i = 0; i < a->scenes_count; i++)
        append_word(text, " ", a->scenes[i]);
}

/* ---- one scene ---- */

static enum ceduo_status ask_runs(const struct arguments *a, const struct scene_file *file, struct progress *progress,
                                  struct answered *c)
{
    struct ceduo_question q = ceduo_batch_question(a, file, progress);
    if (a->window.step > 0)
        q.year_rocks = YEAR_ROCKS;
    else
        ceduo_ask_years(&q);
    q.block_rocks = file->scene.options_count == 1 ? BLOCK_ROCKS : 0;
    return ceduo_ask_pictures(&q, true, WAYS, c);
}

static void write_chapter(const struct arguments *a, const struct scene_file *file, const struct answered *c,
                          const struct ceduo_doubt_report *doubt, size_t number, struct ceduo_html *html,
                          struct ceduo_profiles *profiles)
{
    LOCAL_TEXT(command);
    struct ceduo_page page = {.width = CEDUO_PAGE_REPORT_WIDTH};
    const struct ceduo_report report = {.file = file,
                                        .result = c->answer.result,
                                        .verdict = &c->verdict,
                                        .blocks = c->answer.blocks,
                                        .remarks = {a->tolerance, c->answer.tolerance_met, file->ground_assumed}};
    append_command(&command, a);
    const struct ceduo_chapter chapter = {&report, c->snapshot, c->answer.years, doubt, ceduo_text_string(&command), true};
    ceduo_page_chapter(&page, &chapter);
    ceduo_page_html(html, &page, number);
    struct ceduo_report judged = report;
    judged.doubt = doubt->file ? doubt : NULL;
    ceduo_profiles_add(profiles, &judged, NULL);
    ceduo_page_free(&page);
}

static enum exit_status add_chapter(const struct arguments *a, struct scene_file *file, size_t number, struct ceduo_html *html,
                                    struct ceduo_profiles *profiles)
{
    struct progress progress = ceduo_progress_begin(a);
    struct answered c;
    struct asked_doubt doubt = {0};
    enum exit_status done = EXIT_DONE;
    enum ceduo_status status = ask_runs(a, file, &progress, &c);
    if (status == CEDUO_OK)
        status = ceduo_sensitivity_beside(a, file, &progress, &c.answer, true, &doubt);
    doubt.report.years = &c.verdict;
    if (status == CEDUO_OK) {
        write_chapter(a, file, &c, &doubt.report, number, html, profiles);
        done = ceduo_finished(c.answer.result);
    }
    ceduo_sensitivity_release(&doubt);
    ceduo_answered_release(&c);
    return status == CEDUO_OK ? done : ceduo_batch_failed(file, status);
}

/* ---- the file ---- */

/* A chapter for each scene that can be read, the worst first, behind what is said of all. */
enum exit_status ceduo_batch_report(const struct arguments *a)
{
    LOCAL_TEXT(all);
    LOCAL_TEXT(title);
    struct ceduo_html page = {.text = &all};
    struct ceduo_profiles profiles = {0};
    struct text *chapters = ceduo_must(calloc(a->scenes_count, sizeof *chapters));
    size_t *order = ceduo_must(calloc(a->scenes_count, sizeof *order));
    enum exit_status status = EXIT_DONE;
    for (size_t i = 0; i < a->scenes_count && !atomic_load(ceduo_interrupt_flag()); i++) {
        struct scene_file file;
        enum exit_status done = ceduo_batch_read(a, a->scenes[i], &file);
        if (done == EXIT_DONE) {
            size_t number = profiles.count;
            ceduo_interrupt_catch();
            done = add_chapter(a, &file, number + 1, &(struct ceduo_html){.text = &chapters[number]}, &profiles);
            ceduo_interrupt_release();
            if (number == 0 && profiles.count > 0)
                ceduo_text_put(&title, ceduo_in_language(file.scene.title, file.scene.title_it));
        }
        ceduo_scene_release(&file);
        status = done > status ? done : status;
    }
    ceduo_page_html_begin(&page, ceduo_text_string(&title));
    ceduo_profiles_sort(&profiles, order);
    if (profiles.count > 1) {
        struct ceduo_page verdicts = {.width = CEDUO_PAGE_REPORT_WIDTH};
        ceduo_page_say(&verdicts, CEDUO_PAGE_TITLE, _("%zu scenes, the worst first"), profiles.count);
        ceduo_profiles_page(&verdicts, &profiles);
        ceduo_page_html(&page, &verdicts, profiles.count + 1);
        ceduo_page_free(&verdicts);
    }
    for (size_t i = 0; i < profiles.count; i++)
        ceduo_text_add(&all, ceduo_text_string(&chapters[order[i]]), chapters[order[i]].length);
    ceduo_page_html_end(&page);
    if (profiles.count > 0 && status != EXIT_OUTPUT && !atomic_load(ceduo_interrupt_flag())) {
        enum exit_status written = ceduo_output_write(a, &all);
        status = written > status ? written : status;
    }
    for (size_t i = 0; i < a->scenes_count; i++)
        ceduo_text_free(&chapters[i]);
    free(chapters);
    free(order);
    ceduo_profiles_free(&profiles);
    return status;
}
