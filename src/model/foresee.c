/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "foresee.h"

#include <math.h>

#include "ceduo/question.h"
#include "io/resolve.h"

/* The scene with the changes, in an arena of its own; it shares the nodes and the slope of the document. Release it by its
 * arena alone. */
static bool make(const struct document *d, const char *const *sets, size_t n, struct scene_file *file)
{
    struct problems problems = {0};
    *file = d->file;
    file->arena = (struct arena){.shelf = d->file.arena.shelf};
    bool good = true;
    for (size_t i = 0; good && i < n; i++)
        good = ceduo_scene_set(file, "preview", sets[i], &problems);
    const struct node *root = good ? ceduo_resolve_scene(&file->arena, file->root, &problems) : NULL;
    file->root = root;
    good = root && problems.count == 0 && ceduo_scene_bind(file, &problems);
    ceduo_problems_free(&problems);
    return good;
}

static bool fly(const struct ceduo_scene *scene, size_t option, unsigned threads, struct foreseen *to)
{
    struct ceduo_question q = ceduo_question_default(scene);
    struct ceduo_answer answer;
    q.rocks = q.run.rocks_most = FORESEE_ROCKS;
    q.only = option;
    q.run.threads = threads;
    q.run.arrivals_only = true;
    bool good = option < scene->options_count && ceduo_ask(&q, NULL, &answer) == CEDUO_OK;
    if (!good)
        return false;
    const struct ceduo_result *r = answer.result;
    const struct ceduo_arrivals *a = ceduo_result_wooded(r, option, r->last_control);
    *to = (struct foreseen){.index = *ceduo_result_last_index(r, option),
                            .reach = a ? a->reach_probability : NAN,
                            .exceed = a ? a->exceed_probability : NAN};
    ceduo_answer_release(&answer);
    return true;
}

bool ceduo_foresee(const struct document *d, const char *const *sets, size_t n, size_t option, unsigned threads,
                   struct foreseen *foreseen)
{
    struct scene_file file;
    bool good = make(d, sets, n, &file) && fly(&file.scene, option, threads, foreseen);
    ceduo_arena_free(&file.arena);
    return good;
}

bool ceduo_foresee_fits(const struct document *d, const char *path, const char *value)
{
    struct scene_file file;
    struct text set = {0};
    ceduo_text_format(&set, "%s=%s", path, value);
    const char *const sets[] = {ceduo_text_string(&set)};
    bool good = !set.failed && make(d, sets, 1, &file);
    if (!set.failed)
        ceduo_arena_free(&file.arena);
    ceduo_text_free(&set);
    return good;
}
