/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the answer of one scene: page, JSON or CSV; uncertainty; search; pictures; chapter of --report. */
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "batch.h"
#include "messages.h"
#include "model/search.h"
#include "scene/derived.h"
#include "study/verdict.h"
#include "view/figures.h"
#include "view/page.h"
#include "view/svg.h"

#define BLOCK_ROCKS 512 /* at most, of each other size; the page prints their intervals */

/* Append an answer as JSON, or its rows as CSV. Return false if the format is a page. */
static bool print_figures(const struct arguments *a, const struct ceduo_figure *figures, const struct ceduo_csv *csv,
                          const void *object, struct text *out)
{
    if (a->format == CEDUO_JSON) {
        ceduo_figures_json(out, figures, object, a->details);
    } else if (ceduo_format_has_columns(a->format)) {
        ceduo_text_append(out, ""); /* so that an answer without rows prints the header */
        ceduo_csv_rows(out, csv, object);
    }
    return a->format != CEDUO_TABLE;
}

/* ---- pages ---- */

/* True unless --columns has no column of this group. */
static bool has_column(const struct arguments *a, const char *group)
{
    return !a->columns || strstr(a->columns, group);
}

/* True unless --columns has no column that depends on future years. */
static bool judges_years(const struct arguments *a)
{
    return !a->columns || ceduo_figures_need_years(a->columns);
}

enum exit_status ceduo_print_report(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct query q;
    bool page = a->format == CEDUO_TABLE, stands = a->stands && !page;
    ceduo_query_begin(&q, a, file);
    uint64_t rocks = q.request.rocks;
    if (stands) /* --rows stands needs no simulation */
        q.request.rocks = 0;
    if (!a->years && !stands && judges_years(a))
        ceduo_verdict_add_years(&q.request);
    if (page && !a->years) { /* simulate only what the page prints */
        q.request.rotations = a->details;
        q.request.block_rocks = a->details ? BLOCK_ROCKS : 0;
    }
    q.request.run.alternative_energy = page ? a->details : has_column(a, "other_energy.");
    enum ceduo_status status = ceduo_query_run(&q);
    if (status == CEDUO_OK && (page || (a->columns && strstr(a->columns, "uncertainty."))))
        status = ceduo_query_add_uncertainty(&q, a, file);
    if (status == CEDUO_OK) {
        const struct ceduo_report report = {.file = file,
                                            .result = q.results.result,
                                            .years = a->years ? q.results.years : NULL,
                                            .verdict = &q.verdict,
                                            .uncertainty = q.uncertainty.file ? &q.uncertainty : NULL,
                                            .blocks = q.results.blocks,
                                            .work = q.results.work,
                                            .seconds = q.seconds,
                                            .details = a->details,
                                            .rocks_asked = stands ? rocks : 0,
                                            .remarks = {a->tolerance, q.results.tolerance_met, file->ground_assumed}};
        if (!print_figures(a, ceduo_result_figures, ceduo_result_csv(a->stands, a->years),
                           &(struct ceduo_place){.report = &report}, out)) {
            ceduo_report_page(out, &report, a->details, !ceduo_is_utf8());
            ceduo_fit_charset(out);
            ceduo_profiles_add(a->profiles, &report, a->label);
        }
    }
    return ceduo_query_end(&q, file, status);
}

enum exit_status ceduo_print_uncertainty(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct query q;
    ceduo_batch_warn(a, file, false);
    ceduo_query_begin(&q, a, file);
    enum ceduo_status status = ceduo_query_uncertainty(&q, a, file);
    const struct ceduo_place place = {.uncertainty = &q.uncertainty};
    if (status == CEDUO_OK && !print_figures(a, ceduo_uncertainty_figures, &ceduo_uncertainty_csv, &place, out)) {
        ceduo_uncertainty_page(out, &q.uncertainty, !ceduo_is_utf8());
        ceduo_fit_charset(out);
    }
    return ceduo_query_end(&q, file, status);
}

/* ---- searches ---- */

/* Find the option of a search: the only option, or that of --option. */
static enum exit_status find_single_option(const struct arguments *a, const struct scene_file *file, size_t *option)
{
    bool several = a->options.n == 0 && file->scene.options_count > 1;
    *option = 0;
    for (size_t i = 0; i < a->options.n; i++) {
        size_t k;
        if (ceduo_find_option(file, a->options.items[i], &k) != EXIT_DONE)
            return EXIT_USAGE;
        several |= i > 0 && k != *option;
        *option = k;
    }
    if (several)
        ceduo_print_message("ceduo", _("--find: the scene has several options; name one with --option"));
    return several ? EXIT_USAGE : EXIT_DONE;
}

enum exit_status ceduo_print_find(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct ceduo_search search = {.path = a->find.path,
                                  .goal = a->goal,
                                  .target = a->goal_value,
                                  .lo = a->find.lo,
                                  .hi = a->find.hi,
                                  .rotation = a->years,
                                  .sure = a->sure,
                                  .sure_rocks = a->rocks,
                                  .rocks = a->rocks > 0 ? a->rocks : file->scene.simulation.rocks};
    struct search_answer answer;
    if (find_single_option(a, file, &search.option) != EXIT_DONE)
        return EXIT_USAGE;
    ceduo_batch_warn(a, file, false);
    enum ceduo_status status = ceduo_search(file, &search, (unsigned)a->threads, ceduo_interrupt_flag(), &answer);
    bool usage = answer.problems.met > 0;
    ceduo_print_problems(&answer.problems);
    search.target = answer.target;
    search.rotation = answer.rotation;
    const struct ceduo_find_report report = {file, &search, &answer.found, &answer.yield, answer.yield_depends, &answer.sure};
    if (status == CEDUO_OK && !print_figures(a, ceduo_find_figures, &ceduo_find_csv, &report, out)) {
        if (a->scenes_count > 1)
            ceduo_text_append_escaped(out, file->path);
        ceduo_text_append(out, a->scenes_count > 1 ? ":\n" : "");
        ceduo_page_find(out, &report);
    }
    return status == CEDUO_OK ? EXIT_DONE : usage ? EXIT_USAGE : EXIT_RUN;
}

/* ---- pictures ---- */

/* Append a picture, after a blank line unless it is the first. `start`: begin of the scene's pictures. */
static void print_plot(const struct arguments *a, const struct ceduo_picture *picture, size_t start, struct text *out)
{
    struct ceduo_cells *cells = ceduo_cells_create(a->plot_width, a->plot_height, a->charset);
    struct ceduo_area area = {.top = 1, .width = a->plot_width, .height = a->plot_height - 1};
    LOCAL_TEXT(title);
    ceduo_plot_title(&title, a->plot, picture);
    ceduo_plot_draw(a->plot, &cells->canvas, &area, picture);
    ceduo_cells_label(cells, 0, 0, CEDUO_ROLE_TITLE, ceduo_text_string(&title));
    char *rows = ceduo_cells_dump(cells);
    if (out->length > start)
        ceduo_text_append_char(out, '\n');
    ceduo_text_append(out, rows);
    free(rows);
    ceduo_cells_free(cells);
}

/* Append a picture for each option, belt or control that it depends on. */
static void print_plots(const struct arguments *a, const struct ceduo_scene *scene, const struct query *q, struct text *out)
{
    struct ceduo_years *const *years = q->results.years;
    struct ceduo_picture picture = {.scene = scene,
                                    .snapshot = q->snapshot,
                                    .verdict = q->snapshot ? &q->verdict : NULL,
                                    .uncertainty = q->uncertainty.file ? &q->uncertainty : NULL,
                                    .years_of_options = years,
                                    .control = ceduo_scene_last_control(scene)};
    size_t start = out->length;
    size_t options = ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_ALL_OPTIONS ? 1 : scene->options_count;
    for (size_t o = 0; o < options; o++) {
        size_t belts = a->plot == CEDUO_PLOT_STAND ? scene->options[o].belts_count : 0;
        size_t controls = a->plot == CEDUO_PLOT_HISTOGRAM ? scene->controls_count : 0;
        picture.option = o;
        picture.years = years ? years[o] : NULL;
        picture.year = SIZE_MAX;
        for (size_t k = 0; k == 0 || k < belts || k < controls; k++) {
            picture.belt = k;
            picture.control = controls > 0 ? k : picture.control;
            print_plot(a, &picture, start, out);
        }
    }
}

enum exit_status ceduo_print_plots(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct query q;
    enum ceduo_status status = CEDUO_OK;
    ceduo_query_begin(&q, a, file);
    if (a->plot == CEDUO_PLOT_UNCERTAINTY) {
        status = ceduo_query_uncertainty(&q, a, file);
    } else if (ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_RUN) {
        ceduo_batch_warn(a, file, false);
        q.pictures = true;
        q.envelopes = ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_CELLS;
        q.trajectories = a->plot == CEDUO_PLOT_PROFILE ? CEDUO_SNAPSHOT_TRAJECTORIES : 0;
        q.request.run.alternative_energy = false;
        q.request.years |= (ceduo_plot_kinds[a->plot].flags & CEDUO_PICTURE_YEARS) != 0;
        status = ceduo_query_run(&q);
    }
    if (status == CEDUO_OK)
        print_plots(a, &file->scene, &q, out);
    return ceduo_query_end(&q, file, status);
}

/* ---- chapters ---- */

static void append_word(struct text *text, const char *before, const char *word)
{
    static const char *const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+%@";
    ceduo_text_append(text, before);
    if (*word && strspn(word, plain) == strlen(word))
        ceduo_text_append(text, word);
    else
        ceduo_text_append_quoted(text, word);
}

/* Append the command line with all options that affect the page; not its file name or the threads. A chapter of a region has
 * the changes of its row. */
void ceduo_print_command(struct text *text, const struct arguments *a)
{
    ceduo_text_append(text, "ceduo --report report.html");
    if (a->each && !a->called)
        append_word(text, " --each ", a->each);
    if (a->key && !a->called)
        append_word(text, " --key ", a->key);
    if (a->chapters > 0 && !a->called)
        ceduo_text_format(text, " --chapters %llu", (unsigned long long)a->chapters);
    if (strcmp(_("en"), "en") != 0)
        append_word(text, " --language ", _("en"));
    if (a->rocks > 0)
        ceduo_text_format(text, " -n %llu", (unsigned long long)a->rocks);
    if (a->tolerance > 0)
        append_word(text, " -e ", ROUNDTRIP(a->tolerance));
    for (size_t i = 0; i < a->sets.n; i++)
        append_word(text, " -s ", a->sets.items[i]);
    for (size_t i = 0; i < a->options.n; i++)
        append_word(text, " --option ", a->options.items[i]);
    if (a->years && a->window.step > 0)
        ceduo_text_format(text, " --years=%u:%u:%u", a->window.first, a->window.last, a->window.step);
    if (ceduo_arguments_given(a, "sensitivity"))
        ceduo_text_format(text, " --sensitivity=%llu", (unsigned long long)a->points);
    for (size_t i = 0; i < a->scenes_count; i++)
        append_word(text, " ", a->scenes[i]);
}

enum exit_status ceduo_print_line(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct query q;
    ceduo_query_begin(&q, a, file);
    if (!a->years)
        ceduo_verdict_add_years(&q.request);
    q.request.run.alternative_energy = false;
    enum ceduo_status status = ceduo_query_run(&q);
    if (status == CEDUO_OK) {
        const struct ceduo_report report = {.file = file, .result = q.results.result, .verdict = &q.verdict};
        ceduo_region_add(a->region, &report, a->label ? a->label : a->called, a->number);
        ceduo_text_append(out, ""); /* an answer, although the page is printed later */
    }
    return ceduo_query_end(&q, file, status);
}

/* Moderate numbers: a page does not show more digits. */
#define YEAR_ROCKS   1024
#define TRAJECTORIES 80 /* more would not look denser, but make the page large */

enum exit_status ceduo_print_chapter(const struct arguments *a, struct scene_file *file, struct text *out)
{
    struct query q;
    ceduo_query_begin(&q, a, file);
    q.pictures = q.envelopes = true;
    q.trajectories = TRAJECTORIES;
    if (a->window.step > 0)
        q.request.year_rocks = YEAR_ROCKS;
    else
        ceduo_verdict_add_years(&q.request);
    q.request.block_rocks = file->scene.options_count == 1 ? BLOCK_ROCKS : 0;
    enum ceduo_status status = ceduo_query_run(&q);
    if (status == CEDUO_OK)
        status = ceduo_query_add_uncertainty(&q, a, file);
    if (status == CEDUO_OK) {
        LOCAL_TEXT(command);
        LOCAL_PAGE(page, CEDUO_PAGE_REPORT_WIDTH);
        ceduo_print_command(&command, a);
        struct ceduo_report report = {.file = file,
                                      .result = q.results.result,
                                      .verdict = &q.verdict,
                                      .blocks = q.results.blocks,
                                      .remarks = {a->tolerance, q.results.tolerance_met, file->ground_assumed},
                                      .uncertainty = &q.uncertainty,
                                      .years_ahead = q.results.years,
                                      .snapshot = q.snapshot,
                                      .command = ceduo_text_string(&command),
                                      .reproducible = true};
        q.uncertainty.years = &q.verdict;
        ceduo_page_chapter(&page, &report);
        ceduo_page_html(&(struct ceduo_html){.text = out}, &page, a->profiles->count + 1);
        if (a->profiles->count == 0)
            ceduo_text_append(a->title, ceduo_in_language(file->scene.title, file->scene.title_it));
        ceduo_profiles_add(a->profiles, &report, NULL);
    }
    return ceduo_query_end(&q, file, status);
}
