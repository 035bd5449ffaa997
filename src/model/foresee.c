/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "foresee.h"

#include <math.h>

#include "ceduo/question.h"
#include "io/resolve.h"

/* The scene with the change, in an arena of its own; it shares the nodes and the slope of the other. Release it by its
 * arena alone. */
static bool make(const struct scene_file *from, const char *set, struct scene_file *file)
{
    struct problems problems = {0};
    *file = *from;
    file->arena = (struct arena){.shelf = from->arena.shelf};
    bool good = ceduo_scene_set(file, "preview", set, &problems);
    const struct node *root = good ? ceduo_resolve_scene(&file->arena, file->root, &problems) : NULL;
    file->root = root;
    good = root && problems.count == 0 && ceduo_scene_bind(file, &problems);
    ceduo_problems_free(&problems);
    return good;
}

static void read_result(const struct ceduo_result *r, size_t option, struct foreseen *to)
{
    const struct ceduo_arrivals *a = ceduo_result_wooded(r, option, r->last_control);
    *to = (struct foreseen){.known = true,
                            .index = *ceduo_result_last_index(r, option),
                            .reach = a ? a->reach_probability : NAN,
                            .exceed = a ? a->exceed_probability : NAN};
}

enum ceduo_status ceduo_foresee(const struct scene_file *from, const char *set, size_t option, unsigned threads,
                                const atomic_bool *cancel, struct foreseen *foreseen)
{
    struct scene_file file;
    enum ceduo_status status = CEDUO_OK;
    *foreseen = (struct foreseen){.known = false};
    if (make(from, set, &file) && option < file.scene.options_count) {
        struct ceduo_question q = ceduo_question_default(&file.scene);
        struct ceduo_answer answer;
        q.rocks = q.run.rocks_most = FORESEE_ROCKS;
        q.only = option;
        q.run.threads = threads;
        q.run.arrivals_only = true;
        q.run.cancel = cancel;
        status = ceduo_ask(&q, NULL, &answer);
        if (status == CEDUO_OK)
            read_result(answer.result, option, foreseen);
        ceduo_answer_release(&answer);
    }
    ceduo_arena_free(&file.arena);
    return status == CEDUO_CANCELLED || status == CEDUO_NO_MEMORY ? status : CEDUO_OK;
}

bool ceduo_foresee_fits(const struct scene_file *from, const char *path, const char *value)
{
    struct scene_file file;
    struct text set = {0};
    ceduo_text_format(&set, "%s=%s", path, value);
    bool good = set.bytes && !set.failed;
    if (good) {
        good = make(from, set.bytes, &file);
        ceduo_arena_free(&file.arena);
    }
    ceduo_text_free(&set);
    return good;
}
