/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "seek.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "ceduo/question.h"
#include "scene/schema.h"

/* One search under way. */
struct search {
    struct seek *seek;
    struct problems *problems;
    const struct node *root; /* of the scene as it was read */
    struct ceduo_pool *pool; /* runs kept from value to value */
};

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

/* Counts and years are whole numbers; so are densities, which a forester counts. */
static bool is_whole(const struct field *field)
{
    return field && (field->type == FIELD_COUNT || strcmp(field->unit, "1/ha") == 0 || strcmp(field->unit, "y") == 0);
}

/* Text, a flag, a choice: no number, though one may stand there. */
static bool is_text(const struct field *field)
{
    return field && (field->type <= FIELD_FILE || field->type == FIELD_CHOICE || field->type == FIELD_FLAG);
}

/* ---- one value ---- */

/* The scene with the parameter at a value. */
static bool set_value(struct search *s, double value)
{
    struct text set = {0};
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(&set, "%s=%s", s->seek->search.path, ceduo_number_shortest(value, room));
    s->seek->file->root = s->root;
    bool good = set.bytes && ceduo_scene_set(s->seek->file, "--find", set.bytes, s->problems) &&
                ceduo_scene_bind(s->seek->file, s->problems);
    ceduo_text_free(&set);
    return good;
}

static enum ceduo_status goal_at(void *context, double value, double *goal)
{
    struct search *s = context;
    if (!set_value(s, value))
        return CEDUO_BAD_SLOPE; /* told in problems */
    const struct ceduo_search *search = &s->seek->search;
    struct ceduo_question q = ceduo_question_default(&s->seek->file->scene);
    struct ceduo_answer answer;
    q.rocks = ceduo_goals[search->goal].flies ? search->rocks : 0;
    q.only = search->option;
    q.run.rocks_most = search->rocks;
    q.run.threads = s->seek->threads;
    q.run.cancel = s->seek->cancel;
    q.run.arrivals_only = true;
    q.years = search->rotation;
    enum ceduo_status status = ceduo_ask(&q, &s->pool, &answer);
    if (status == CEDUO_OK)
        *goal = !search->rotation ? ceduo_goal_reached(search->goal, answer.result, search->option)
                                  : ceduo_goal_over_years(search->goal, answer.years[search->option], &answer.result->bare);
    ceduo_answer_release(&answer);
    return status;
}

/* What the option yields at a value. */
static void read_yield(struct search *s, double value, enum ceduo_status status)
{
    struct ceduo_yield *yield = &s->seek->yield;
    bool known = status == CEDUO_OK && !isnan(value) && set_value(s, value) &&
                 ceduo_yield_of(&s->seek->file->scene.options[s->seek->search.option], 0, yield) == CEDUO_OK;
    if (!known)
        *yield = (struct ceduo_yield){.cut_per_year = NAN, .died_per_year = NAN, .standing = NAN, .volume_today = NAN};
    free(yield->fellings);
    yield->fellings = NULL;
}

/* Whether a parameter decides about the years to come alone: then the answer is one of a whole rotation. */
static bool is_of_years(const struct field *field)
{
    return field && field->flags & FIELD_YEARS;
}

/* ---- the search ---- */

static const struct source goal_source = {.name = "--goal", .is_option = true};

static const struct source path_source = {.name = "--find", .is_option = true};

/* What the goal needs of the scene. */
static bool is_askable(const struct seek *s, struct problems *problems)
{
    if (is_text(ceduo_schema_at(s->search.path))) {
        ceduo_problem(problems, &path_source, 0, 0, _("%s is not a number"), s->search.path);
        return false;
    }
    bool needs_accepted = s->search.goal == CEDUO_GOAL_EXCEED;
    for (size_t c = 0; needs_accepted && c < s->file->scene.controls_count; c++)
        if (isnan(s->file->scene.controls[c].accepted)) {
            ceduo_problem(problems, &goal_source, 0, 0, _("exceed: controls[%zu] has no accepted_kJ; add it"), c);
            return false;
        }
    if (needs_accepted && s->file->scene.simulation.contact_model == CEDUO_INDEX) {
        ceduo_problem(problems, &goal_source, 0, 0, _("exceed: with contact_model index no rock is simulated in the forest"));
        return false;
    }
    return true;
}

enum ceduo_status ceduo_seek(struct seek *seek, struct ceduo_found *found, struct problems *problems)
{
    struct search s = {.seek = seek, .problems = problems, .root = seek->file->root};
    struct ceduo_search *search = &seek->search;
    if (isnan(search->target))
        search->target = ceduo_goal_limit(search->goal, &seek->file->scene.simulation);
    search->rotation |= is_of_years(field_at(search->path));
    if (!is_askable(seek, problems))
        return CEDUO_BAD_SLOPE;
    struct ceduo_find_def def = {.lo = search->lo,
                                 .hi = search->hi,
                                 .whole = is_whole(field_at(search->path)),
                                 .target = ceduo_goals[search->goal].below ? nextafter(search->target, 0) : search->target,
                                 .goal = goal_at,
                                 .context = &s,
                                 .tolerance = 1e-4,
                                 .cancel = seek->cancel};
    enum ceduo_status status = ceduo_find(&def, found);
    ceduo_pool_free(s.pool);
    read_yield(&s, found->found ? found->value : found->nearest, status);
    return status;
}
