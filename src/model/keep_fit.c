/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "keep_fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "io/emit.h"
#include "io/inputs.h"
#include "scene/value.h"

#define SEGMENTS "slope.segments["

/* The changes of one edit. */
struct changes {
    struct arena arena;
    const char **items;
    size_t n, room;
};

static void add(struct changes *c, struct text *change)
{
    char *item = change->failed || c->n == c->room ? NULL : ceduo_arena_string(&c->arena, ceduo_text_string(change));
    ceduo_text_free(change);
    if (item)
        c->items[c->n++] = item;
    else
        c->arena.failed = true;
}

/* ---- ground that stands in no list of segments ---- */

static bool is_of_segments(const struct fit_values *fit)
{
    for (size_t i = 0; i < fit->n; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            if (strncmp(fit->inputs[i].places[k], SEGMENTS, sizeof SEGMENTS - 1) == 0)
                return true;
    return false;
}

static void put_number(struct text *t, const char *before, double value)
{
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(t, "%s%s", before, ceduo_number_shortest(value, room));
}

static void add_vertices(struct changes *c, const struct ceduo_slope *s)
{
    struct text t = {0};
    for (size_t i = 0; i < s->vertices; i++) {
        put_number(&t, i == 0 ? "slope.vertices_m=[[" : ", [", s->x[i] + s->origin_x);
        put_number(&t, ", ", s->z[i] + s->origin_z);
        ceduo_text_put(&t, "]");
    }
    ceduo_text_put(&t, "]");
    add(c, &t);
}

static void add_segments(struct changes *c, const struct ceduo_slope *s)
{
    struct text t = {0};
    for (size_t i = 0; i + 1 < s->vertices; i++) {
        const struct ceduo_segment *g = &s->segments[i];
        bool angle = isnan(g->roughness_m);
        put_number(&t, i == 0 ? "slope.segments=[{rn: " : ", {rn: ", g->rn.mean);
        put_number(&t, ", rt: ", g->rt.mean);
        put_number(&t, angle ? ", roughness_rad: " : ", roughness_m: ", angle ? g->roughness_rad : g->roughness_m);
        put_number(&t, ", friction: ", g->friction);
        ceduo_text_put(&t, "}");
    }
    ceduo_text_put(&t, "]");
    add(c, &t);
}

static void add_ground(struct changes *c, const struct document *d)
{
    struct text without = {0};
    const struct node *slope = ceduo_node_get(d->file.root, "slope");
    static const char *const keys[] = {"materials", "csv", "reversed"}; /* vertices are written as they lie now */
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (ceduo_node_get(slope, keys[i])) {
            ceduo_text_format(&without, "slope.%s", keys[i]);
            add(c, &without);
        }
    add_vertices(c, &d->file.scene.slope);
    add_segments(c, &d->file.scene.slope);
}

/* ---- values ---- */

/* The mapping that a value stands in; false where that is the scene itself. */
static bool holder_of(const char *place, struct text *holder)
{
    const char *dot = strrchr(place, '.');
    if (dot)
        ceduo_text_add(holder, place, (size_t)(dot - place));
    return dot != NULL;
}

static void add_value(struct changes *c, const struct ceduo_scene *scene, const char *place, double best)
{
    struct text t = {0};
    struct value v;
    bool spread = ceduo_value_find((struct ceduo_scene *)(uintptr_t)scene, place, &v) && v.field->type == FIELD_SPREAD &&
                  ((const struct ceduo_number *)v.at)->spread > 0;
    ceduo_text_format(&t, "%s%s", place, spread ? ".mean" : "");
    put_number(&t, "=", best);
    add(c, &t);
}

static void add_source(struct changes *c, const char *place, const char *source)
{
    struct text t = {0};
    if (!holder_of(place, &t)) {
        ceduo_text_free(&t);
        return;
    }
    ceduo_text_put(&t, ".source={kind: calibrated, text: ");
    ceduo_emit_scalar(&t, source, true);
    ceduo_text_put(&t, "}");
    for (size_t i = 0; i < c->n; i++)
        if (strcmp(c->items[i], ceduo_text_string(&t)) == 0) {
            ceduo_text_free(&t);
            return;
        }
    add(c, &t);
}

/* Whether a row of doubt is about a fitted value. */
static bool is_fitted(const struct document *d, const struct fit_values *fit, const struct node *row)
{
    const char *path = ceduo_node_text(row, "path");
    for (size_t i = 0; path && i < d->file.inputs_of_scene; i++)
        for (size_t k = 0; strcmp(d->file.inputs[i].path, path) == 0 && k < fit->n; k++)
            if (ceduo_input_shares(&d->file.inputs[i], &fit->inputs[k]))
                return true;
    return false;
}

/* The table of draws beside the rows of doubt that there are; what they say of fitted values no longer holds. */
static void add_draws(struct changes *c, const struct document *d, const struct fit_values *fit)
{
    const struct node *doubt = ceduo_node_get(d->file.root, "doubt");
    const struct node *rows = doubt && doubt->kind == NODE_MAP ? ceduo_node_get(doubt, "rows") : doubt;
    struct text t = {0};
    bool some = false;
    ceduo_text_put(&t, "doubt={draws: ");
    ceduo_emit_scalar(&t, fit->draws, true);
    for (size_t i = 0; rows && rows->kind == NODE_LIST && i < rows->n; i++) {
        if (is_fitted(d, fit, rows->items[i]))
            continue;
        ceduo_text_put(&t, some ? ", " : ", rows: [");
        ceduo_emit_flow(&t, rows->items[i]);
        some = true;
    }
    ceduo_text_put(&t, some ? "]}" : "}");
    add(c, &t);
}

bool ceduo_keep_fit(struct document *d, const struct fit_values *fit, struct problems *problems)
{
    struct changes c = {0};
    bool segments = is_of_segments(fit) && d->file.scene.slope.segments_given == 0;
    for (size_t i = 0; i < fit->n; i++)
        c.room += 2 * fit->inputs[i].places_count;
    c.room += 8;
    c.items = ceduo_arena_take(&c.arena, c.room * sizeof *c.items);
    if (c.items && segments)
        add_ground(&c, d);
    for (size_t i = 0; c.items && i < fit->n; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            add_value(&c, &d->file.scene, fit->inputs[i].places[k], fit->best[i]);
    for (size_t i = 0; c.items && i < fit->n; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            add_source(&c, fit->inputs[i].places[k], fit->source);
    if (c.items && fit->draws)
        add_draws(&c, d, fit);
    if (c.arena.failed)
        ceduo_problem_memory(problems);
    bool good = !c.arena.failed && ceduo_document_set_all(d, c.items, c.n, _("fitted values"), problems);
    ceduo_arena_free(&c.arena);
    return good;
}
