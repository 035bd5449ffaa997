/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "scene/schema.h"
#include "scene/value.h"
#include "study/inputs.h"
#include "study/reliability.h"

#define SURE_MAX       128  /* values evaluated under uncertainty */
#define ERROR_STEP     0.05 /* first step for the slope at the value found, as a share of the range */
#define ERROR_STEPS    3
#define SURE_TOLERANCE 1e-3 /* as a share of the range; n points resolve no finer */

/* A running search. */
struct search {
    struct scene_file *file;
    struct ceduo_search def;
    unsigned threads;
    const atomic_bool *cancel;
    struct search_answer *answer;
    struct problems *problems;   /* the answer's, or a scratch list */
    double passes;               /* largest goal value that passes */
    const struct node *original; /* root of the original scene */
    struct ceduo_pool *pool;     /* runs kept between values */
    bool whole;                  /* the value is a whole number */
    size_t evaluations_count;    /* evaluated values, under uncertainty */
    struct evaluation {
        double value;
        struct reliability_result answer;
    } evaluations[SURE_MAX];
};

/* ---- the type of the value ---- */

const struct field *ceduo_search_field(struct arena *arena, const char *path)
{
    const char *bracket = strrchr(path, '[');
    const struct field *field = ceduo_schema_at(path), *list = NULL;
    if (!field && bracket)
        list = ceduo_schema_at(ceduo_arena_copy(arena, path, (size_t)(bracket - path)));
    if (!list || list->type != FIELD_NUMBERS)
        return field;
    struct field *one = ceduo_arena_alloc(arena, sizeof *one);
    *one = *list;
    one->type = FIELD_NUMBER;
    return one;
}

/* ---- one value ---- */

/* Set the parameter in the scene. */
static bool set_value(struct search *s, double value)
{
    LOCAL_TEXT(set);
    ceduo_text_format(&set, "%s=%s", s->def.path, ROUNDTRIP(value));
    s->file->root = s->original;
    return ceduo_scene_set(s->file, "--find", set.bytes, s->problems) && ceduo_scene_bind(s->file, s->problems);
}

static enum ceduo_status evaluate_goal(void *context, double value, double *goal)
{
    struct search *s = context;
    if (!set_value(s, value))
        return CEDUO_BAD_SLOPE; /* reported in problems */
    struct ceduo_request q = ceduo_request_default(&s->file->scene);
    struct ceduo_results answer;
    q.rocks = ceduo_goals[s->def.goal].needs_rocks ? s->def.rocks : 0;
    q.only = s->def.option;
    q.run.rocks_max = s->def.rocks;
    q.run.threads = s->threads;
    q.run.cancel = s->cancel;
    q.run.arrivals_only = true;
    q.years = s->def.rotation;
    enum ceduo_status status = ceduo_simulate_request(&q, &s->pool, &answer);
    if (status == CEDUO_OK)
        *goal =
            ceduo_goal_reached(s->def.goal, answer.result, s->def.option, s->def.rotation ? answer.years[s->def.option] : NULL);
    ceduo_results_release(&answer);
    return status;
}

/* ---- one value, under uncertainty ---- */

/* Remove the places of the searched value from an input. False: nothing is left for the option. */
static bool exclude_searched(struct search *s, const struct value *searched, struct ceduo_input *input)
{
    struct arena *arena = &s->file->arena;
    const char **places = ceduo_arena_alloc(arena, input->places_count * sizeof *places);
    const double **draws = ceduo_arena_alloc(arena, input->places_count * sizeof *draws);
    size_t n = 0;
    for (size_t i = 0; i < input->places_count; i++) {
        struct value place;
        if (searched->member && ceduo_value_find(&s->file->scene, input->places[i], &place) && place.member == searched->member)
            continue;
        places[n] = input->places[i];
        draws[n++] = input->draws ? input->draws[i] : NULL;
    }
    input->places = places;
    input->draws = input->draws ? draws : NULL;
    input->places_count = n;
    bool wanted = s->def.rotation || !ceduo_input_is_future(input);
    return n > 0 && wanted && ceduo_input_affects(input, s->def.option);
}

/* Evaluate the scene under uncertainty at a value, once for each value. */
static enum ceduo_status evaluate_once(struct search *s, double value, struct reliability_result *answer)
{
    struct scene_inputs inputs;
    struct value searched;
    size_t n = 0;
    for (size_t i = 0; i < s->evaluations_count; i++)
        if (s->evaluations[i].value == value) {
            *answer = s->evaluations[i].answer;
            return CEDUO_OK;
        }
    if (!set_value(s, value))
        return CEDUO_BAD_SLOPE; /* reported in problems */
    if (!ceduo_inputs_collect(s->file, &inputs))
        return CEDUO_NO_MEMORY;
    if (!ceduo_value_find(&s->file->scene, s->def.path, &searched))
        searched.member = NULL;
    for (size_t i = 0; i < inputs.n; i++)
        if (exclude_searched(s, &searched, &inputs.items[i]))
            inputs.items[n++] = inputs.items[i];
    s->answer->sure.inputs = n;
    struct reliability_def def = {.goal = s->def.goal, .target = s->passes, .sure = s->def.sure};
    def.uncertainty = (struct ceduo_uncertainty_def){
        .size = sizeof(struct ceduo_uncertainty_def), .scene = &s->file->scene, .inputs_count = n, .inputs = inputs.items};
    def.uncertainty.option = s->def.option;
    def.uncertainty.rotation = s->def.rotation;
    def.uncertainty.points = s->answer->sure.points;
    def.uncertainty.rocks = s->answer->sure.rocks;
    def.uncertainty.threads = s->threads;
    def.uncertainty.cancel = s->cancel;
    enum ceduo_status status = ceduo_reliability_compute(&def, answer);
    if (status == CEDUO_OK && s->evaluations_count < SURE_MAX)
        s->evaluations[s->evaluations_count++] = (struct evaluation){value, *answer};
    return status;
}

static enum ceduo_status evaluate_margin(void *context, double value, double *above)
{
    struct search *s = context;
    struct reliability_result answer;
    enum ceduo_status status = evaluate_once(s, value, &answer);
    *above = status == CEDUO_OK ? answer.above : NAN;
    return status;
}

/* Set the sampling error of the value found: error of the goal divided by its slope. NaN if the slope has the wrong sign. */
static enum ceduo_status read_error(struct search *s, const struct ceduo_find_def *def, struct ceduo_reliability *sure)
{
    const struct ceduo_found *f = &sure->found;
    struct reliability_result middle, lo, hi;
    double sign = f->side == CEDUO_SIDE_SMALLEST ? -1 : 1, width = def->hi - def->lo, half = ERROR_STEP * width;
    enum ceduo_status status = evaluate_once(s, f->value, &middle);
    for (int i = 0; i < ERROR_STEPS && status == CEDUO_OK; i++) {
        double from = fmax(def->lo, f->value - half), to = fmin(def->hi, f->value + half);
        from = s->whole ? floor(from) : from, to = s->whole ? ceil(to) : to;
        status = evaluate_once(s, from, &lo);
        if (status == CEDUO_OK)
            status = evaluate_once(s, to, &hi);
        double slope = sign * (hi.above - lo.above) / (to - from), before = half;
        if (status != CEDUO_OK || !(slope > 0))
            return status;
        double above = (middle.above_hi - middle.above) / slope, below = (middle.above - middle.above_lo) / slope;
        sure->lo = fmax(def->lo, f->value - (sign < 0 ? below : above));
        sure->hi = fmin(def->hi, f->value + (sign < 0 ? above : below));
        half = fmin(width / 2, fmax((above + below) / 2, SURE_TOLERANCE * width));
        if (half < 2 * before && before < 2 * half)
            break;
    }
    if (s->whole)
        sure->lo = floor(sure->lo), sure->hi = ceil(sure->hi);
    return status;
}

/* Search the value that reaches the goal in the wanted share of cases. */
static enum ceduo_status search_sure(struct search *s, const struct ceduo_find_def *plain, const struct ceduo_found *found)
{
    struct ceduo_find_def def = *plain;
    struct reliability_result answer;
    struct ceduo_found *to = &s->answer->sure.found;
    s->answer->sure = (struct ceduo_reliability){.sure = s->def.sure,
                                                 .points = CEDUO_UNCERTAINTY_POINTS,
                                                 .rocks = s->def.sure_rocks > 0 ? s->def.sure_rocks : CEDUO_UNCERTAINTY_ROCKS,
                                                 .lo = NAN,
                                                 .hi = NAN};
    double value = found->found ? found->value : isnan(found->nearest) ? plain->hi : found->nearest;
    enum ceduo_status status = evaluate_once(s, value, &answer);
    if (status != CEDUO_OK || s->answer->sure.inputs == 0)
        return status;
    def.tolerance = SURE_TOLERANCE;
    def.goal = evaluate_margin;
    def.target = 0;
    status = ceduo_find(&def, to);
    value = to->found ? to->value : to->nearest;
    if (status == CEDUO_OK && !isnan(value))
        status = evaluate_once(s, value, &answer);
    s->answer->sure.share = answer.share;
    if (status == CEDUO_OK && to->found && !to->whole_range)
        status = read_error(s, &def, &s->answer->sure);
    to->evaluations = (unsigned)s->evaluations_count;
    return status;
}

/* Compute the yield of the option at a value. */
static struct ceduo_yield compute_yield(struct search *s, double value)
{
    struct ceduo_yield yield = {0};
    bool known = !isnan(value) && set_value(s, value) &&
                 ceduo_yield_compute(&s->file->scene.options[s->def.option], 0, &yield) == CEDUO_OK;
    free(yield.fellings);
    yield.fellings = NULL;
    if (!known)
        yield.cut_per_year = yield.died_per_year = yield.standing = yield.volume_today = NAN;
    return yield;
}

/* True if the difference exceeds rounding. */
static bool is_different(double a, double b)
{
    return fabs(a - b) > 1e-9 * fabs(a);
}

/* ---- the search ---- */

static const struct source goal_source = {.name = "--goal", .is_option = true};
static const struct source sure_source = {.name = "--sure", .is_option = true};
static const struct source path_source = {.name = "--find", .is_option = true};

/* True if the scene has what the goal needs; otherwise report. */
static bool has_requirements(const struct search *s)
{
    const struct ceduo_scene *scene = &s->file->scene;
    const struct field *field = ceduo_schema_at(s->def.path);
    if (field && (field->type <= FIELD_FILE || field->type == FIELD_CHOICE || field->type == FIELD_FLAG))
        return ceduo_problem(s->problems, &path_source, 0, 0, _("%s is not a number"), s->def.path);
    bool needs_accepted = ceduo_goal_needs_accepted(s->def.goal);
    for (size_t c = 0; needs_accepted && c < scene->controls_count; c++)
        if (isnan(scene->controls[c].accepted))
            return ceduo_problem(s->problems, &goal_source, 0, 0, _("exceed: control %zu has no limit (accepted_kJ); add it"),
                                 c + 1);
    if (needs_accepted && s->file->scene.simulation.contact_model == CEDUO_CONTACT_MODEL_INDEX)
        return ceduo_problem(s->problems, &goal_source, 0, 0,
                             _("exceed: with contact_model index no rock is simulated in the forest"));
    if (s->def.sure > 0 && s->def.rotation && s->def.goal == CEDUO_GOAL_ENERGY)
        return ceduo_problem(s->problems, &sure_source, 0, 0,
                             _("over a rotation the mean energy has no uncertainty; use the goal exceed or arrive"));
    return true;
}

/* True if both ends of a range are valid in the scene. Report if only one is. */
static bool check_ends(struct search *s, double lo, double hi)
{
    struct problems *problems = s->problems;
    LOCAL_PROBLEMS(scratch);
    if (lo > hi) /* no whole number in between */
        return true;
    bool first = set_value(s, lo);
    s->problems = first ? problems : &scratch; /* report problems of both ends once */
    bool last = set_value(s, hi);
    s->problems = problems;
    if (first != last)
        ceduo_problem(problems, &path_source, 0, 0, _("the other end of the range, %s, is possible"),
                      ROUNDTRIP(first ? lo : hi));
    return first && last;
}

enum ceduo_status ceduo_search(struct scene_file *file, const struct ceduo_search *request, unsigned threads,
                               const atomic_bool *cancel, struct search_answer *answer)
{
    struct search search = {file, *request, threads, cancel, answer, &answer->problems, .original = file->root}, *s = &search;
    const struct field *field = ceduo_search_field(&file->arena, request->path);
    if (isnan(s->def.target))
        s->def.target = ceduo_goal_limit(s->def.goal, &file->scene);
    s->def.rotation |= (field && field->flags & FIELD_YEARS) || ceduo_goal_is_worst(s->def.goal);
    *answer = (struct search_answer){.target = s->def.target, .rotation = s->def.rotation};
    if (!has_requirements(s))
        return CEDUO_BAD_SLOPE;
    bool counted = field && (field->type == FIELD_COUNT || strcmp(field->unit, "1/ha") == 0); /* as foresters count */
    bool whole = s->whole = counted || (field && strcmp(field->unit, "y") == 0);
    struct ceduo_find_def def = {.size = sizeof def,
                                 .lo = whole ? ceil(s->def.lo) : s->def.lo,
                                 .hi = whole ? floor(s->def.hi) : s->def.hi,
                                 .whole = whole,
                                 .target = ceduo_goals[s->def.goal].below ? nextafter(s->def.target, 0) : s->def.target,
                                 .goal = evaluate_goal,
                                 .context = s,
                                 .tolerance = 1e-4,
                                 .cancel = cancel};
    s->passes = def.target;
    if (!check_ends(s, def.lo, def.hi))
        return CEDUO_BAD_SLOPE;
    struct ceduo_found *found = &answer->found;
    enum ceduo_status status = ceduo_find(&def, found);
    ceduo_pool_free(s->pool);
    if (status == CEDUO_OK && s->def.sure > 0)
        status = search_sure(s, &def, found);
    if (status == CEDUO_OK) {
        struct ceduo_yield lo = compute_yield(s, def.lo), hi = compute_yield(s, def.hi);
        answer->yield = compute_yield(s, found->found ? found->value : found->nearest);
        answer->yield_depends = is_different(lo.cut_per_year, hi.cut_per_year) || is_different(lo.standing, hi.standing) ||
                                is_different(lo.died_per_year, hi.died_per_year);
    }
    return status;
}

/* ---- the preview of a change ---- */

/* Make a scene with the change. It shares nodes and slope with `from`; free only its arena. */
static bool change_scene(const struct scene_file *from, const char *path, const char *value, struct scene_file *file)
{
    LOCAL_PROBLEMS(problems);
    LOCAL_TEXT(set);
    *file = *from;
    file->arena = (struct arena){0};
    ceduo_text_format(&set, "%s=%s", path, value);
    bool good = ceduo_scene_set(file, "preview", set.bytes, &problems);
    const struct node *root = good ? ceduo_resolve_scene(&file->arena, file->root, &problems) : NULL;
    file->root = root;
    return root && problems.met == 0 && ceduo_scene_bind(file, &problems);
}

enum ceduo_status ceduo_preview(const struct scene_file *from, const char *path, const char *value, size_t option,
                                unsigned threads, const atomic_bool *cancel, struct preview *preview)
{
    struct scene_file file;
    enum ceduo_status status = CEDUO_OK;
    *preview = (struct preview){.known = false};
    if (change_scene(from, path, value, &file) && option < file.scene.options_count) {
        struct ceduo_request q = ceduo_request_default(&file.scene);
        struct ceduo_results answer;
        q.rocks = q.run.rocks_max = PREVIEW_ROCKS;
        q.only = option;
        q.run.threads = threads;
        q.run.arrivals_only = true;
        q.run.cancel = cancel;
        status = ceduo_simulate_request(&q, NULL, &answer);
        if (status == CEDUO_OK) {
            const struct ceduo_result *r = answer.result;
            const struct ceduo_arrivals *a = ceduo_result_wooded(r, option, r->last_control);
            *preview = (struct preview){.known = true,
                                        .index = *ceduo_result_last_index(r, option),
                                        .reach = a ? a->reach.mean : NAN,
                                        .exceed = a ? a->exceed.mean : NAN};
        }
        ceduo_results_release(&answer);
    }
    ceduo_arena_free(&file.arena);
    return status == CEDUO_CANCELLED || status == CEDUO_NO_MEMORY ? status : CEDUO_OK;
}

bool ceduo_preview_fits(const struct scene_file *from, const char *path, const char *value)
{
    struct scene_file file;
    bool good = change_scene(from, path, value, &file);
    ceduo_arena_free(&file.arena);
    return good;
}
