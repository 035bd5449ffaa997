/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "seek.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ceduo/key.h"
#include "ceduo/result.h"
#include "base/intl.h"
#include "scene/schema.h"

/* One search under way. */
struct search {
    struct seek *seek;
    struct problems *problems;
    const struct node *root; /* of the scene as it was read */
    struct ceduo_pool *pool; /* of the scene last flown */
    uint64_t scene_key;
};

/* ---- what kind of number it is ---- */

struct kind {
    char path[512]; /* with empty brackets */
    const struct field *field;
};

/* "forest[0].stand.trees[oak].per_ha" → "forest[].stand.trees[].per_ha" */
static void strip_path(const char *path, char *to, size_t size)
{
    size_t n = 0;
    bool inside = false;
    for (; *path && n + 2 < size; path++) {
        if (*path == ']')
            inside = false;
        if (!inside)
            to[n++] = *path;
        if (*path == '[')
            inside = true;
    }
    to[n] = '\0';
}

static void look_at_field(void *context, const char *path, const struct field *field)
{
    struct kind *k = context;
    size_t n = strlen(path), m = strlen(k->path);
    /* belts of an option hold what those of the forest do */
    if ((m >= n && strcmp(k->path + (m - n), path) == 0 && (m == n || k->path[m - n - 1] == '.')))
        k->field = field;
}

static const struct field *field_at(const char *path)
{
    struct kind k = {.field = NULL};
    strip_path(path, k.path, sizeof k.path);
    ceduo_schema_visit(ceduo_schema_scene(), "", look_at_field, &k);
    return k.field;
}

/* Counts and years are whole numbers; so are densities, which a forester counts. */
static bool is_whole(const struct field *field)
{
    return field && (field->type == FIELD_COUNT || strcmp(field->unit, "1/ha") == 0 || strcmp(field->unit, "y") == 0 ||
                     field->type == FIELD_NUMBERS);
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

static enum ceduo_status ready_pool(struct search *s)
{
    const struct ceduo_scene *scene = &s->seek->file->scene;
    uint64_t key = ceduo_scene_key(scene);
    if (s->pool && key == s->scene_key) {
        ceduo_pool_turn(s->pool, scene);
        return CEDUO_OK;
    }
    ceduo_pool_free(s->pool);
    s->pool = NULL;
    s->scene_key = key;
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = s->seek->threads;
    def.rocks_most = s->seek->search.rocks;
    def.cancel = s->seek->cancel;
    def.arrivals_only = true;
    return ceduo_pool_create(&def, &s->pool);
}

/* What a goal of the rocks is at one control: the mean wooded energy, by the index what is left, or the share that
 * exceeds. Where no rock arrives all is well. */
static double goal_of_rocks(const struct search *s, const struct ceduo_option *option, const struct ceduo_run *bare,
                            const struct ceduo_run *wooded, size_t c, enum ceduo_status *status)
{
    const struct ceduo_scene *scene = &s->seek->file->scene;
    struct ceduo_arrivals a;
    *status = ceduo_run_arrivals(wooded ? wooded : bare, c, &a);
    if (*status != CEDUO_OK)
        return NAN;
    if (s->seek->search.goal == CEDUO_GOAL_EXCEED)
        return a.exceed_probability;
    if (a.reached == 0)
        return 0;
    if (wooded)
        return a.energy.mean * 1e-3;
    return ceduo_assess_index(scene, option, &scene->controls[c], a.energy.mean).residual * 1e-3;
}

static enum ceduo_status fly(struct search *s, const struct ceduo_option *option, double *worst)
{
    const struct ceduo_scene *scene = &s->seek->file->scene;
    bool flies = scene->simulation.contact_model != CEDUO_INDEX;
    struct ceduo_run *run = NULL;
    enum ceduo_status status = ready_pool(s);
    if (status == CEDUO_OK)
        status = ceduo_pool_run(s->pool, flies ? option : NULL, &run);
    if (status == CEDUO_OK)
        status = ceduo_run_extend(run, s->seek->search.rocks);
    for (size_t c = 0; c < scene->controls_count && status == CEDUO_OK; c++) {
        double goal = goal_of_rocks(s, option, run, flies ? run : NULL, c, &status);
        *worst = isnan(goal) || goal > *worst ? goal : *worst;
    }
    return status;
}

static enum ceduo_status goal_at(void *context, double value, double *goal)
{
    struct search *s = context;
    if (!set_value(s, value))
        return CEDUO_BAD_SLOPE; /* told in problems */
    const struct ceduo_scene *scene = &s->seek->file->scene;
    const struct ceduo_option *option = &scene->options[s->seek->search.option];
    *goal = -INFINITY;
    if (s->seek->search.goal == CEDUO_GOAL_ENERGY || s->seek->search.goal == CEDUO_GOAL_EXCEED)
        return fly(s, option, goal);
    for (size_t c = 0; c < scene->controls_count; c++) {
        struct ceduo_index index = ceduo_assess_index(scene, option, &scene->controls[c], NAN);
        *goal = fmax(*goal, s->seek->search.goal == CEDUO_GOAL_ADC ? index.worst_adc : index.worst_free_run);
    }
    return CEDUO_OK;
}

/* ---- the search ---- */

static const struct source goal_source = {.name = "--goal", .is_option = true};

static const struct source path_source = {.name = "--find", .is_option = true};

/* What the goal needs of the scene. */
static bool is_askable(const struct seek *s, struct problems *problems)
{
    if (is_text(field_at(s->search.path))) {
        ceduo_problem(problems, &path_source, 0, 0, _("%s is no number"), s->search.path);
        return false;
    }
    bool needs_accepted = s->search.goal == CEDUO_GOAL_EXCEED;
    for (size_t c = 0; needs_accepted && c < s->file->scene.controls_count; c++)
        if (isnan(s->file->scene.controls[c].accepted)) {
            ceduo_problem(problems, &goal_source, 0, 0, _("exceed: controls[%zu] does not say what it bears; add accepted_kJ"),
                          c);
            return false;
        }
    if (needs_accepted && s->file->scene.simulation.contact_model == CEDUO_INDEX) {
        ceduo_problem(problems, &goal_source, 0, 0, _("exceed: the contact model index flies no rock through the wood"));
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
    seek->file->root = s.root;
    struct problems none = {0};
    ceduo_scene_bind(seek->file, &none);
    ceduo_problems_free(&none);
    return status;
}
