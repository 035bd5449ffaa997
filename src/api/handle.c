/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of ceduo/handle.h. Open scenes are a list; a handle is a number that is never used twice, so that a wrong one
 * is found to be wrong. */
#include "ceduo/handle.h"

#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "io/scene_file.h"
#include "scene/value.h"
#include "study/verdict.h"
#include "view/figures.h"

/* A change PATH=VALUE. */
struct change {
    struct change *next;
    size_t path_length;
    char text[];
};

/* Memory of an earlier scene, to which runs of the pool may refer. */
struct old_scene {
    struct old_scene *next;
    struct arena arena;
};

#define OLD_SCENES_MAX ((size_t)16 << 20) /* bytes */

struct open_scene {
    struct open_scene *next;
    ceduo_handle handle;
    pthread_mutex_t in_use;
    char *path;
    struct scene_file given;   /* as read */
    struct scene_file changed; /* with the changes up to the last refresh(); shares the nodes of `given` */
    struct change *changes;    /* in the order of their application; one for each path */
    bool current;              /* `changed` has all changes */
    struct ceduo_pool *pool;   /* keeps runs from one simulation to the next */
    struct old_scene *old;     /* freed with the pool */
    size_t old_bytes;
    struct ceduo_results results;
    struct ceduo_verdict verdict;
    uint64_t rocks;       /* simulated last */
    unsigned threads;     /* likewise */
    bool simulated;       /* `results` belong to `changed` */
    bool years_simulated; /* `verdict` knows the years */
};

static pthread_mutex_t list_mutex = PTHREAD_MUTEX_INITIALIZER;
static struct open_scene *open_scenes;
static ceduo_handle last_handle;

/* ---- errors ---- */

static _Thread_local struct {
    ceduo_handle handle;
    char text[4096];
} last_error;

static void clear_error(ceduo_handle handle)
{
    last_error.handle = handle;
    last_error.text[0] = '\0';
}

static enum ceduo_status fail(enum ceduo_status status, const char *format, ...) __attribute__((format(printf, 2, 3)));
static enum ceduo_status fail(enum ceduo_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(last_error.text, sizeof last_error.text, format, args);
    va_end(args);
    return status;
}

static enum ceduo_status fail_by_status(enum ceduo_status status)
{
    return status == CEDUO_OK ? status : fail(status, "%s", ceduo_status_text(status));
}

/* Describe the problems of the input. */
static enum ceduo_status fail_by_problems(struct problems *problems)
{
    if (problems->memory)
        return fail_by_status(CEDUO_NO_MEMORY);
    const char *text = ceduo_problems_print(problems);
    size_t length = strlen(text);
    while (length > 0 && text[length - 1] == '\n')
        length--;
    return fail(CEDUO_BAD_FILE, "%.*s", (int)length, text);
}

const char *ceduo_error(ceduo_handle handle)
{
    return handle == last_error.handle ? last_error.text : "";
}

/* ---- handles ---- */

/* Return the place of a handle in the list; its end: not open. The caller holds the mutex. */
static struct open_scene **find_handle(ceduo_handle handle)
{
    struct open_scene **scene = &open_scenes;
    while (*scene && (*scene)->handle != handle)
        scene = &(*scene)->next;
    return scene;
}

/* Begin a call: return the scene, which no other thread uses until end_call(); NULL on failure. `remove`: take it from the
 * list. */
static struct open_scene *begin_call(ceduo_handle handle, bool remove)
{
    clear_error(handle);
    pthread_mutex_lock(&list_mutex);
    struct open_scene **place = find_handle(handle), *scene = *place;
    bool busy = scene && pthread_mutex_trylock(&scene->in_use) != 0;
    if (scene && !busy && remove)
        *place = scene->next;
    pthread_mutex_unlock(&list_mutex);
    if (!scene)
        fail(CEDUO_BAD_ARGUMENT, "handle %" PRIu64 " is not open", handle);
    else if (busy)
        fail(CEDUO_BAD_ARGUMENT, "another thread uses handle %" PRIu64, handle);
    else
        ceduo_language_set_data(true);
    return busy ? NULL : scene;
}

static enum ceduo_status end_call(struct open_scene *scene, enum ceduo_status status)
{
    ceduo_language_set_data(false);
    pthread_mutex_unlock(&scene->in_use);
    return status;
}

static void free_results(struct open_scene *scene)
{
    ceduo_verdict_release(&scene->verdict);
    ceduo_results_release(&scene->results);
    scene->simulated = scene->years_simulated = false;
}

static void free_pool(struct open_scene *scene)
{
    ceduo_pool_free(scene->pool);
    scene->pool = NULL;
    for (struct old_scene *old = scene->old, *next; old; old = next) {
        next = old->next;
        ceduo_arena_free(&old->arena);
        free(old);
    }
    scene->old = NULL;
    scene->old_bytes = 0;
}

static void free_scene(struct open_scene *scene)
{
    free_results(scene);
    free_pool(scene);
    ceduo_arena_free(&scene->changed.arena);
    ceduo_scene_release(&scene->given);
    for (struct change *c = scene->changes, *next; c; c = next) {
        next = c->next;
        free(c);
    }
    pthread_mutex_destroy(&scene->in_use);
    free(scene->path);
    free(scene);
}

ceduo_handle ceduo_open(const char *path)
{
    clear_error(0);
    if (!path) {
        fail(CEDUO_BAD_ARGUMENT, "the path is missing");
        return 0;
    }
    struct open_scene *scene = calloc(1, sizeof *scene);
    char *copy = strdup(path);
    if (!scene || !copy) {
        free(scene);
        free(copy);
        fail_by_status(CEDUO_NO_MEMORY);
        return 0;
    }
    scene->path = copy;
    pthread_mutex_init(&scene->in_use, NULL);
    LOCAL_PROBLEMS(problems);
    ceduo_language_set_data(true);
    bool good = ceduo_scene_load(&scene->given, scene->path, NULL, 0, &problems);
    if (!good)
        fail_by_problems(&problems);
    ceduo_language_set_data(false);
    if (!good) {
        free_scene(scene);
        return 0;
    }
    scene->changed = scene->given;
    scene->changed.arena = (struct arena){0};
    scene->current = true;
    pthread_mutex_lock(&list_mutex);
    scene->handle = ++last_handle;
    scene->next = open_scenes;
    open_scenes = scene;
    pthread_mutex_unlock(&list_mutex);
    return scene->handle;
}

enum ceduo_status ceduo_close(ceduo_handle handle)
{
    struct open_scene *scene = begin_call(handle, true);
    if (!scene)
        return CEDUO_BAD_ARGUMENT;
    end_call(scene, CEDUO_OK);
    free_scene(scene);
    return CEDUO_OK;
}

/* ---- changes ---- */

/* Apply a change to the tree of a scene. */
static bool apply(struct scene_file *file, const struct change *change, struct problems *problems)
{
    return ceduo_scene_set(file, "ceduo_set()", change->text, problems);
}

/* Replace the scene by a new one. The old one stays while runs may refer to it. */
static enum ceduo_status replace_scene(struct open_scene *scene, const struct scene_file *fresh)
{
    struct old_scene *old = calloc(1, sizeof *old);
    if (!old)
        return fail_by_status(CEDUO_NO_MEMORY);
    free_results(scene);
    *old = (struct old_scene){scene->old, scene->changed.arena};
    scene->old = old;
    scene->old_bytes += old->arena.bytes;
    scene->changed = *fresh;
    scene->current = true;
    if (!scene->pool || scene->old_bytes > OLD_SCENES_MAX)
        free_pool(scene);
    return CEDUO_OK;
}

/* Make the scene with all changes, if it is not current. It does not change on failure. */
static enum ceduo_status refresh(struct open_scene *scene)
{
    if (scene->current)
        return CEDUO_OK;
    LOCAL_PROBLEMS(problems);
    struct scene_file fresh = scene->given;
    fresh.arena = (struct arena){0};
    bool good = true;
    for (const struct change *c = scene->changes; good && c; c = c->next)
        good = apply(&fresh, c, &problems);
    const struct node *root = good ? ceduo_resolve_scene(&fresh.arena, fresh.root, &problems) : NULL;
    fresh.root = root;
    good = root && problems.met == 0 && ceduo_scene_bind(&fresh, &problems) && ceduo_problems_check_memory(&problems);
    enum ceduo_status status = good ? replace_scene(scene, &fresh) : fail_by_problems(&problems);
    if (status != CEDUO_OK)
        ceduo_arena_free(&fresh.arena);
    return status;
}

/* True if a change can be applied to the scene as it is now. */
static bool is_possible(const struct open_scene *scene, const struct change *change, struct problems *problems)
{
    struct scene_file trial = scene->changed;
    trial.arena = (struct arena){0};
    bool good = apply(&trial, change, problems);
    ceduo_arena_free(&trial.arena);
    return good;
}

/* Append a change, and remove an earlier one of the same path. */
static void add_change(struct open_scene *scene, struct change *change)
{
    struct change **place = &scene->changes;
    while (*place) {
        struct change *c = *place;
        if (c->path_length == change->path_length && memcmp(c->text, change->text, c->path_length) == 0) {
            *place = c->next;
            free(c);
        } else {
            place = &c->next;
        }
    }
    *place = change;
    scene->current = false;
}

static enum ceduo_status set_value(struct open_scene *scene, const char *path, const char *text)
{
    size_t length = strlen(path), text_length = strlen(text);
    struct change *change = calloc(1, sizeof *change + length + text_length + 2);
    if (!change)
        return fail_by_status(CEDUO_NO_MEMORY);
    change->path_length = length;
    *stpcpy(change->text, path) = '=';
    memcpy(change->text + length + 1, text, text_length + 1);
    LOCAL_PROBLEMS(problems);
    LOCAL_PROBLEMS(again);
    bool good = is_possible(scene, change, &problems);
    if (!good && !scene->current) /* an earlier change may have made the place */
        good = refresh(scene) == CEDUO_OK && is_possible(scene, change, &again);
    clear_error(scene->handle);
    if (good) {
        add_change(scene, change);
        return CEDUO_OK;
    }
    free(change);
    return fail_by_problems(&problems);
}

enum ceduo_status ceduo_set(ceduo_handle handle, const char *path, const char *text)
{
    struct open_scene *scene = begin_call(handle, false);
    if (!scene)
        return CEDUO_BAD_ARGUMENT;
    return end_call(scene, path && text && *path ? set_value(scene, path, text)
                                                 : fail(CEDUO_BAD_ARGUMENT, "the path or the text is missing"));
}

/* ---- results ---- */

/* Simulate and compare the options. `years`: also the years by which they are judged. */
static enum ceduo_status simulate(struct open_scene *scene, bool years)
{
    struct ceduo_request request = ceduo_request_default(&scene->changed.scene);
    request.rocks = request.run.rocks_max = scene->rocks;
    request.run.threads = scene->threads;
    request.run.alternative_energy = true;
    if (years)
        ceduo_verdict_add_years(&request);
    free_results(scene);
    enum ceduo_status status = ceduo_simulate_request(&request, &scene->pool, &scene->results);
    if (status == CEDUO_OK)
        status = ceduo_compare_options(scene->results.result, scene->results.years, NULL, &scene->verdict);
    scene->simulated = status == CEDUO_OK;
    scene->years_simulated = scene->simulated && years;
    return fail_by_status(status);
}

enum ceduo_status ceduo_simulate(ceduo_handle handle, uint64_t rocks, unsigned threads)
{
    struct open_scene *scene = begin_call(handle, false);
    if (!scene)
        return CEDUO_BAD_ARGUMENT;
    enum ceduo_status status = refresh(scene);
    rocks = rocks > 0 ? rocks : scene->changed.scene.simulation.rocks;
    if (rocks < scene->rocks) /* runs of the pool never get shorter */
        free_pool(scene);
    scene->rocks = rocks;
    scene->threads = threads > 0 ? threads : 1;
    return end_call(scene, status == CEDUO_OK ? simulate(scene, false) : status);
}

/* Read a value of the scene. Return false if the path is none. */
static bool get_parameter(struct open_scene *scene, const char *path, double value[3])
{
    struct value parameter;
    bool found = ceduo_value_find(&scene->changed.scene, path, &parameter);
    if (found)
        memcpy(value, (double[]){ceduo_value_get(&parameter), NAN, NAN}, 3 * sizeof *value);
    return found;
}

/* Read a figure of the results. Without results, only find out whether there is such a figure. */
static enum ceduo_figure_found get_figure(const struct open_scene *scene, const char *path, double value[3])
{
    const struct ceduo_report report = {
        .file = &scene->changed, .result = scene->results.result, .verdict = &scene->verdict, .work = scene->results.work};
    const struct ceduo_place place = {.report = &report};
    return ceduo_figures_get(ceduo_result_figures, scene->simulated ? &place : NULL, path, value);
}

static enum ceduo_status get(struct open_scene *scene, const char *path, double value[3])
{
    enum ceduo_status status = refresh(scene);
    /* the years take most of the time, so they are simulated only for figures that need them */
    if (status == CEDUO_OK && scene->simulated && !scene->years_simulated && ceduo_figures_need_years(path))
        status = simulate(scene, true);
    if (status != CEDUO_OK)
        return status;
    enum ceduo_figure_found found = get_figure(scene, path, value);
    if ((found == CEDUO_FIGURE_FOUND && scene->simulated) || get_parameter(scene, path, value))
        return CEDUO_OK;
    return fail(CEDUO_BAD_ARGUMENT,
                found == CEDUO_NO_FIGURE      ? "'%s' is neither a figure of a result nor a number of the scene"
                : found == CEDUO_NOT_A_NUMBER ? "'%s' is not a number"
                : scene->simulated            ? "'%s': there is no such item"
                                              : "'%s': the scene is not simulated as it is now",
                path);
}

enum ceduo_status ceduo_get(ceduo_handle handle, const char *path, double value[3])
{
    struct open_scene *scene = begin_call(handle, false);
    if (!scene)
        return CEDUO_BAD_ARGUMENT;
    return end_call(scene,
                    path && value ? get(scene, path, value) : fail(CEDUO_BAD_ARGUMENT, "the path or the place is missing"));
}

/* ---- samples ---- */

static const struct quantity {
    const char *name;
    enum ceduo_sample sample;
    double scale;
} quantities[] = {{"energy_kJ", CEDUO_SAMPLE_ENERGY, 1e-3},
                  {"speed_m_s", CEDUO_SAMPLE_SPEED, 1},
                  {"height_m", CEDUO_SAMPLE_HEIGHT, 1},
                  {"stop_x_m", CEDUO_SAMPLE_STOP, 1},
                  {"weight", CEDUO_SAMPLE_WEIGHT, 1}};

static const struct quantity *find_quantity(const char *name)
{
    for (size_t i = 0; i < sizeof quantities / sizeof *quantities; i++)
        if (strcmp(quantities[i].name, name) == 0)
            return &quantities[i];
    return NULL;
}

/* Return the number of rocks; -1 on failure. */
static int64_t copy_samples(const struct open_scene *scene, int option, size_t control, const char *name, double *to, size_t n)
{
    const struct ceduo_scene *s = &scene->changed.scene;
    const struct quantity *q = find_quantity(name);
    if (!scene->current || !scene->simulated)
        fail(CEDUO_BAD_ARGUMENT, "the scene is not simulated as it is now");
    else if (!q)
        fail(CEDUO_BAD_ARGUMENT, "no quantity '%s': energy_kJ, speed_m_s, height_m, stop_x_m or weight", name);
    else if (option < -1 || (option >= 0 && (size_t)option >= s->options_count))
        fail(CEDUO_BAD_ARGUMENT, "there is no option %d; the scene has %zu", option, s->options_count);
    else if (control >= s->controls_count && q->sample <= CEDUO_SAMPLE_ENERGY)
        fail(CEDUO_BAD_ARGUMENT, "there is no control %zu; the scene has %zu", control, s->controls_count);
    if (last_error.text[0])
        return -1;
    const struct ceduo_run *run = ceduo_pool_find(scene->pool, option < 0 ? NULL : &s->options[option]);
    const double *values = run ? ceduo_run_samples(run, control, q->sample) : NULL;
    if (!values) {
        fail(CEDUO_BAD_ARGUMENT,
             run ? "the scene has no blocks, and so no weights" : "rocks of this option were not simulated");
        return -1;
    }
    uint64_t rocks = ceduo_run_rocks(run);
    for (uint64_t i = 0; i < rocks && i < n; i++)
        to[i] = values[i] * q->scale + (q->sample == CEDUO_SAMPLE_STOP ? s->slope.origin_x : 0);
    return (int64_t)rocks;
}

int64_t ceduo_samples(ceduo_handle handle, int option, size_t control, const char *quantity, double *to, size_t n)
{
    struct open_scene *scene = begin_call(handle, false);
    if (!scene)
        return -1;
    int64_t rocks = -1;
    if (!quantity || (!to && n > 0))
        fail(CEDUO_BAD_ARGUMENT, "the quantity or the place is missing");
    else
        rocks = copy_samples(scene, option, control, quantity, to, n);
    end_call(scene, CEDUO_OK);
    return rocks;
}
