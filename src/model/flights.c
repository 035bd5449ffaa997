/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flights.h"

#include <stdlib.h>

#include "ceduo/key.h"

struct flights {
    unsigned threads;
    const atomic_bool *cancel;
    uint64_t scene_key;
    struct ceduo_pool *pictures, *figures, *years, *others;
    struct ceduo_scene other; /* that the pool of the others is turned to */
    double cells[CEDUO_OUTLOOK_CELLS];
    size_t cells_count;
    struct ceduo_outlook *last; /* what was last made of the runs */
};

struct flights *ceduo_flights_create(unsigned threads, const atomic_bool *cancel)
{
    struct flights *f = calloc(1, sizeof *f);
    if (f)
        *f = (struct flights){.threads = threads, .cancel = cancel};
    return f;
}

void ceduo_flights_free(struct flights *f)
{
    if (!f)
        return;
    ceduo_outlook_free(f->last);
    ceduo_pool_free(f->figures);
    ceduo_pool_free(f->years);
    ceduo_pool_free(f->others);
    ceduo_pool_free(f->pictures);
    ceduo_other_scene_release(&f->other);
    free(f);
}

/* Turns all to a scene. What was made of the runs of another one is of no use. */
static enum ceduo_status turn(struct flights *f, const struct ceduo_scene *scene)
{
    uint64_t key = ceduo_scene_key(scene);
    if (f->last && key != f->scene_key) {
        ceduo_outlook_free(f->last);
        f->last = NULL;
    }
    f->scene_key = key;
    struct ceduo_run_def def = ceduo_run_def_default(scene);
    def.threads = f->threads;
    def.rocks_most = FLIGHTS_MOST;
    def.cancel = f->cancel;
    enum ceduo_status status = ceduo_pool_for(&def, &f->figures);
    def.arrivals_only = true;
    if (status == CEDUO_OK)
        status = ceduo_pool_for(&def, &f->years);
    def.arrivals_only = false;
    def.cells = f->cells_count = ceduo_outlook_places(scene, f->cells);
    def.cell_x = f->cells;
    return status == CEDUO_OK ? ceduo_pool_for(&def, &f->pictures) : status;
}

/* ---- figures ---- */

static bool is_precise(const struct ceduo_sight *s)
{
    for (size_t i = 0; s && i < s->flown.controls; i++) {
        const struct ceduo_arrivals *a = &s->flown.arrivals[i];
        if (!ceduo_mean_is_precise(a->reached, a->energy.mean, a->energy.se, FLIGHTS_TOLERANCE))
            return false;
    }
    return true;
}

static bool precise(const struct ceduo_outlook *o)
{
    bool good = is_precise(o->bare);
    for (size_t i = 0; i < o->options; i++)
        good = good && is_precise(o->wooded[i]);
    return good;
}

/* Hands over what is known so far; what has not changed is shared with what is kept. */
static enum ceduo_status hand_over(struct flights *f, const struct ceduo_scene *scene, flights_publish *publish, void *context)
{
    struct ceduo_outlook *mine, *theirs;
    struct ceduo_outlook_def def = {.scene = scene,
                                    .figures = f->figures,
                                    .pictures = f->pictures,
                                    .cells = f->cells_count,
                                    .cell_x = f->cells,
                                    .trajectories = CEDUO_OUTLOOK_TRAJECTORIES,
                                    .cancel = f->cancel,
                                    .last = f->last};
    enum ceduo_status status = ceduo_outlook_create(&def, &mine);
    if (status != CEDUO_OK)
        return status;
    ceduo_outlook_free(f->last);
    def.last = f->last = mine;
    status = ceduo_outlook_create(&def, &theirs);
    if (status == CEDUO_OK)
        publish(context, theirs);
    return status;
}

/* Makes the run of one forest as long as `rocks`. */
static enum ceduo_status fly_forest(struct flights *f, const struct ceduo_option *option, uint64_t rocks)
{
    struct ceduo_pool *pool = rocks <= FLIGHTS_PICTURE ? f->pictures : f->figures;
    struct ceduo_run *run;
    enum ceduo_status status = ceduo_pool_run(f->pictures, option, &run);
    return status == CEDUO_OK ? ceduo_pool_fly(pool, option, rocks, &run) : status;
}

/* Hands over after each forest: once something is known it is shown with its own error until better is known. */
enum ceduo_status ceduo_flights_figures(struct flights *f, const struct ceduo_scene *scene, size_t shown, uint64_t rocks,
                                        flights_publish *publish, void *context, bool *enough)
{
    bool wooded = scene->simulation.contact_model != CEDUO_INDEX;
    enum ceduo_status status = turn(f, scene);
    if (status == CEDUO_OK)
        status = fly_forest(f, NULL, rocks);
    for (size_t k = 0, n = scene->options_count; wooded && k < n && status == CEDUO_OK; k++) {
        status = fly_forest(f, &scene->options[(shown + k) % n], rocks);
        bool says = k + 1 < n && (k == 0 || rocks >= FLIGHTS_MOST);
        if (status == CEDUO_OK && says)
            status = hand_over(f, scene, publish, context);
    }
    if (status == CEDUO_OK)
        status = hand_over(f, scene, publish, context);
    if (status == CEDUO_OK)
        *enough = rocks * 10 > FLIGHTS_MOST || (rocks >= FLIGHTS_PICTURE && precise(f->last));
    return status;
}

/* ---- the other energy law ---- */

/* Turns its pool, and its pool alone. */
static enum ceduo_status turn_others(struct flights *f, const struct ceduo_scene *scene)
{
    struct ceduo_scene other;
    enum ceduo_status status = ceduo_other_scene(scene, &other) ? CEDUO_OK : CEDUO_NO_MEMORY;
    struct ceduo_run_def def = ceduo_run_def_default(&other);
    def.threads = f->threads;
    def.rocks_most = FLIGHTS_MOST;
    def.cancel = f->cancel;
    def.arrivals_only = true;
    if (status == CEDUO_OK)
        status = ceduo_pool_for(&def, &f->others);
    if (status != CEDUO_OK) {
        ceduo_other_scene_release(&other);
        return status;
    }
    ceduo_other_scene_release(&f->other);
    f->other = other;
    return CEDUO_OK;
}

enum ceduo_status ceduo_flights_others(struct flights *f, const struct ceduo_scene *scene, uint64_t rocks,
                                       struct ceduo_other_energy *others)
{
    enum ceduo_status status = turn_others(f, scene);
    size_t n = scene->options_count, controls = scene->controls_count;
    struct ceduo_run *first = NULL;
    for (size_t i = 0; i < n && status == CEDUO_OK; i++) {
        struct ceduo_run *run;
        status = ceduo_pool_fly(f->others, &f->other.options[i], rocks, &run);
        first = i == 0 ? run : first;
        for (size_t c = 0; c < controls && status == CEDUO_OK; c++)
            status = ceduo_other_read(&scene->options[i], run, first, c, &others[i * controls + c]);
    }
    return status;
}

/* ---- years ---- */

uint64_t ceduo_flights_years_key(const struct ceduo_scene *scene, size_t option)
{
    struct ceduo_window w = ceduo_window_in(scene, &scene->options[option]);
    uint64_t key = ceduo_scene_key(scene);
    const uint64_t more[] = {ceduo_years_key(&scene->options[option]), w.kind, w.first, w.last,
                             (uint64_t)scene->simulation.contact_model};
    for (size_t i = 0; i < sizeof more / sizeof more[0]; i++)
        key = key * 1099511628211u ^ more[i];
    return key;
}

enum ceduo_status ceduo_flights_years(struct flights *f, const struct ceduo_scene *scene, size_t option, uint64_t rocks,
                                      struct ceduo_years **years)
{
    *years = NULL;
    const struct ceduo_option *o = &scene->options[option];
    enum ceduo_status status = turn(f, scene);
    if (status == CEDUO_OK)
        status = f->last && f->last->bare ? ceduo_years_create(scene, o, ceduo_window_in(scene, o), years) : CEDUO_NO_MEMORY;
    if (status == CEDUO_OK)
        status = ceduo_years_fly(*years, f->years, &f->last->bare->flown, rocks);
    if (status == CEDUO_OK)
        (*years)->key = ceduo_flights_years_key(scene, option);
    if (status != CEDUO_OK) {
        ceduo_years_free(*years);
        *years = NULL;
    }
    return status;
}
