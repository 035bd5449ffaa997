/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "ceduo/question.h"
#include "io/resolve.h"
#include "scene/schema.h"

/* ---- what kind of number it is ---- */

/* The row of a parameter; of a number in a list that of the list. */
static const struct field *field_at(const char *path)
{
    const struct field *field = ceduo_schema_at(path);
    char list[512];
    const char *bracket = strrchr(path, '[');
    if (field || !bracket || (size_t)(bracket - path) >= sizeof list)
        return field;
    memcpy(list, path, (size_t)(bracket - path));
    list[bracket - path] = '\0';
    field = ceduo_schema_at(list);
    return field && field->type == FIELD_NUMBERS ? field : NULL;
}

/* ---- one value ---- */

/* The scene with the parameter at a value. */
static bool set_value(struct search *s, double value)
{
    struct text set = {0};
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(&set, "%s=%s", s->def.path, ceduo_number_shortest(value, room));
    s->file->root = s->root;
    bool good = ceduo_scene_set(s->file, "--find", set.bytes, s->problems) && ceduo_scene_bind(s->file, s->problems);
    ceduo_text_free(&set);
    return good;
}

static enum ceduo_status goal_at(void *context, double value, double *goal)
{
    struct search *s = context;
    if (!set_value(s, value))
        return CEDUO_BAD_SLOPE; /* reported in problems */
    struct ceduo_question q = ceduo_question_default(&s->file->scene);
    struct ceduo_answer answer;
    q.rocks = ceduo_goals[s->def.goal].flies ? s->def.rocks : 0;
    q.only = s->def.option;
    q.run.rocks_most = s->def.rocks;
    q.run.threads = s->threads;
    q.run.cancel = s->cancel;
    q.run.arrivals_only = true;
    q.years = s->def.rotation;
    enum ceduo_status status = ceduo_ask(&q, &s->pool, &answer);
    if (status == CEDUO_OK)
        *goal = !s->def.rotation ? ceduo_goal_reached(s->def.goal, answer.result, s->def.option)
                                 : ceduo_goal_over_years(s->def.goal, answer.years[s->def.option], &answer.result->bare);
    ceduo_answer_release(&answer);
    return status;
}

/* What the option yields at a value. */
static void read_yield(struct search *s, double value, enum ceduo_status status)
{
    struct ceduo_yield *yield = &s->yield;
    bool known = status == CEDUO_OK && !isnan(value) && set_value(s, value) &&
                 ceduo_yield_of(&s->file->scene.options[s->def.option], 0, yield) == CEDUO_OK;
    if (!known)
        *yield = (struct ceduo_yield){.cut_per_year = NAN, .died_per_year = NAN, .standing = NAN, .volume_today = NAN};
    free(yield->fellings);
    yield->fellings = NULL;
}

/* ---- the search ---- */

static const struct source goal_source = {.name = "--goal", .is_option = true};

static const struct source path_source = {.name = "--find", .is_option = true};

/* What the goal needs of the scene. */
static bool is_askable(const struct search *s)
{
    const struct field *field = ceduo_schema_at(s->def.path);
    if (field && (field->type <= FIELD_FILE || field->type == FIELD_CHOICE || field->type == FIELD_FLAG)) {
        ceduo_problem(s->problems, &path_source, 0, 0, _("%s is not a number"), s->def.path);
        return false;
    }
    bool needs_accepted = s->def.goal == CEDUO_GOAL_EXCEED;
    for (size_t c = 0; needs_accepted && c < s->file->scene.controls_count; c++)
        if (isnan(s->file->scene.controls[c].accepted)) {
            ceduo_problem(s->problems, &goal_source, 0, 0, _("exceed: controls[%zu] has no accepted_kJ; add it"), c);
            return false;
        }
    if (needs_accepted && s->file->scene.simulation.contact_model == CEDUO_INDEX) {
        ceduo_problem(s->problems, &goal_source, 0, 0,
                      _("exceed: with contact_model index no rock is simulated in the forest"));
        return false;
    }
    return true;
}

enum ceduo_status ceduo_search(struct search *s, struct ceduo_found *found, struct problems *problems)
{
    const struct field *field = field_at(s->def.path);
    s->problems = problems;
    s->root = s->file->root;
    s->pool = NULL;
    if (isnan(s->def.target))
        s->def.target = ceduo_goal_limit(s->def.goal, &s->file->scene.simulation);
    s->def.rotation |= field && field->flags & FIELD_YEARS; /* it decides about the years to come alone */
    if (!is_askable(s))
        return CEDUO_BAD_SLOPE;
    bool counted = field && (field->type == FIELD_COUNT || strcmp(field->unit, "1/ha") == 0); /* as a forester does */
    bool whole = counted || (field && strcmp(field->unit, "y") == 0);
    struct ceduo_find_def def = {.lo = s->def.lo,
                                 .hi = s->def.hi,
                                 .whole = whole,
                                 .target = ceduo_goals[s->def.goal].below ? nextafter(s->def.target, 0) : s->def.target,
                                 .goal = goal_at,
                                 .context = s,
                                 .tolerance = 1e-4,
                                 .cancel = s->cancel};
    enum ceduo_status status = ceduo_find(&def, found);
    ceduo_pool_free(s->pool);
    read_yield(s, found->found ? found->value : found->nearest, status);
    return status;
}

/* ---- the preview of a change ---- */

/* The scene with the change, in an arena of its own; it shares the nodes and the slope of the other. Release it by its
 * arena alone. */
static bool change_scene(const struct scene_file *from, const char *set, struct scene_file *file)
{
    struct problems problems = {0};
    *file = *from;
    file->arena = (struct arena){0};
    bool good = ceduo_scene_set(file, "preview", set, &problems);
    const struct node *root = good ? ceduo_resolve_scene(&file->arena, file->root, &problems) : NULL;
    file->root = root;
    good = root && problems.count == 0 && ceduo_scene_bind(file, &problems);
    ceduo_problems_free(&problems);
    return good;
}

enum ceduo_status ceduo_preview(const struct scene_file *from, const char *set, size_t option, unsigned threads,
                                const atomic_bool *cancel, struct preview *preview)
{
    struct scene_file file;
    enum ceduo_status status = CEDUO_OK;
    *preview = (struct preview){.known = false};
    if (change_scene(from, set, &file) && option < file.scene.options_count) {
        struct ceduo_question q = ceduo_question_default(&file.scene);
        struct ceduo_answer answer;
        q.rocks = q.run.rocks_most = PREVIEW_ROCKS;
        q.only = option;
        q.run.threads = threads;
        q.run.arrivals_only = true;
        q.run.cancel = cancel;
        status = ceduo_ask(&q, NULL, &answer);
        if (status == CEDUO_OK) {
            const struct ceduo_result *r = answer.result;
            const struct ceduo_arrivals *a = ceduo_result_wooded(r, option, r->last_control);
            *preview = (struct preview){.known = true,
                                        .index = *ceduo_result_last_index(r, option),
                                        .reach = a ? a->reach_probability : NAN,
                                        .exceed = a ? a->exceed_probability : NAN};
        }
        ceduo_answer_release(&answer);
    }
    ceduo_arena_free(&file.arena);
    return status == CEDUO_CANCELLED || status == CEDUO_NO_MEMORY ? status : CEDUO_OK;
}

bool ceduo_preview_fits(const struct scene_file *from, const char *path, const char *value)
{
    struct scene_file file;
    struct text set = {0};
    ceduo_text_format(&set, "%s=%s", path, value);
    bool good = change_scene(from, set.bytes, &file);
    ceduo_arena_free(&file.arena);
    ceduo_text_free(&set);
    return good;
}
