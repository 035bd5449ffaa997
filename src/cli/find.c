/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --find: the value of one parameter for which a goal is reached. */
#include "base/language.h"
#include "batch.h"
#include "interrupt.h"
#include "model/search.h"
#include "say.h"
#include "view/figures.h"

static void put(struct text *out, const struct arguments *a, const struct ceduo_find_report *report)
{
    if (a->format == CEDUO_JSON) {
        ceduo_figures_json(out, ceduo_find_figures, report, false);
        return;
    }
    if (a->format == CEDUO_CSV) {
        ceduo_csv_rows(out, &ceduo_find_csv, report);
        return;
    }
    if (a->scenes_count > 1) {
        ceduo_text_safe(out, report->file->path);
        ceduo_text_put(out, ":\n");
    }
    ceduo_find_page(out, report);
}

/* The one option to look at. */
static enum exit_status choose(const struct arguments *a, const struct scene_file *file, size_t *option)
{
    bool several = a->options.n == 0 && file->scene.options_count > 1;
    *option = 0;
    for (size_t i = 0; i < a->options.n; i++) {
        size_t k;
        if (ceduo_batch_option(file, a->options.items[i], &k) != EXIT_DONE)
            return EXIT_USAGE;
        several |= i > 0 && k != *option;
        *option = k;
    }
    if (several)
        ceduo_say_why("ceduo", _("--find: the scene has several options; name one with --option"));
    return several ? EXIT_USAGE : EXIT_DONE;
}

/* Looks for the value in one scene. */
static enum exit_status look(const struct arguments *a, struct scene_file *file, size_t option, struct text *out)
{
    struct search search = {.file = file,
                            .def = {.path = a->find,
                                    .option = option,
                                    .goal = a->goal,
                                    .target = a->goal_value,
                                    .lo = a->find_lo,
                                    .hi = a->find_hi,
                                    .rotation = a->years,
                                    .sure = a->sure,
                                    .sure_rocks = a->rocks,
                                    .rocks = a->rocks > 0 ? a->rocks : file->scene.simulation.rocks},
                            .threads = a->threads,
                            .cancel = ceduo_interrupt_flag()};
    struct ceduo_found found;
    struct problems problems = {0};
    enum ceduo_status status = ceduo_search(&search, &found, &problems);
    ceduo_problems_close(&problems);
    ceduo_say(&problems.text);
    if (status == CEDUO_OK)
        put(out, a, &(struct ceduo_find_report){file, &search.def, &found, &search.yield, search.yield_depends, &search.sure});
    bool usage = problems.count > 0;
    ceduo_problems_free(&problems);
    return status == CEDUO_OK ? EXIT_DONE : usage ? EXIT_USAGE : EXIT_RUN;
}

static enum exit_status find_in(const struct arguments *a, struct scene_file *file, struct text *out)
{
    size_t option = 0;
    enum exit_status status = choose(a, file, &option);
    if (status == EXIT_DONE)
        ceduo_batch_warn(a, file);
    return status == EXIT_DONE ? look(a, file, option, out) : status;
}

enum exit_status ceduo_batch_find(const struct arguments *a)
{
    return ceduo_batch_each(a, &ceduo_find_csv, find_in);
}
