/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "changes.h"

#include <math.h>
#include <string.h>

#include "base/language.h"
#include "io/scene_file.h"
#include "scene/value.h"

#define SEGMENTS "slope.segments["

/* ---- ground that stands in no list of segments ---- */

static void put_number(struct text *t, const char *before, double value)
{
    ceduo_text_format(t, "%s%s", before, NUMERAL(value));
}

/* True for a row of doubt about ground or points that the written scene no longer has. */
static bool is_of_library(const struct node *row)
{
    const char *path = ceduo_node_text(row, "path");
    return path && (strcmp(path, "slope.tolerance_m") == 0 || strncmp(path, "slope.materials[", 16) == 0);
}

/* Rows of doubt, NULL if there is no list; `list`: its path. */
static const struct node *doubt_rows(const struct document *d, const char **list)
{
    const struct node *doubt = ceduo_node_get(d->file.root, "doubt");
    bool map = doubt && doubt->kind == NODE_MAP;
    const struct node *rows = map ? ceduo_node_get(doubt, "rows") : doubt;
    *list = map ? "doubt.rows" : "doubt";
    return rows && rows->kind == NODE_LIST ? rows : NULL;
}

static void add_ground(struct changes *c, const struct document *d)
{
    const char *list;
    const struct node *rows = doubt_rows(d, &list);
    for (size_t i = rows ? rows->n : 0; i-- > 0;)
        if (is_of_library(rows->items[i]))
            ceduo_changes_add(c, "%s[%zu]", list, i);
    static const char *const keys[] = {"materials", "csv", "reversed",
                                       "tolerance_m"}; /* vertices are written as they are simulated */
    const struct ceduo_slope *s = &d->file.scene.slope;
    LOCAL_TEXT(vertices);
    LOCAL_TEXT(segments);
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (ceduo_node_get(ceduo_node_get(d->file.root, "slope"), keys[i]))
            ceduo_changes_add(c, "slope.%s", keys[i]);
    for (size_t i = 0; i < s->vertices; i++) {
        put_number(&vertices, i == 0 ? "slope.vertices_m=[[" : ", [", s->x[i] + s->origin_x);
        put_number(&vertices, ", ", s->z[i] + s->origin_z);
        ceduo_text_put(&vertices, "]");
    }
    ceduo_text_put(&vertices, "]");
    ceduo_changes_add(c, "%s", vertices.bytes);
    for (size_t i = 0; i + 1 < s->vertices; i++) {
        const struct ceduo_segment *g = &s->segments[i];
        bool angle = isnan(g->roughness_m);
        put_number(&segments, i == 0 ? "slope.segments=[{rn: " : ", {rn: ", g->rn.mean);
        put_number(&segments, ", rt: ", g->rt.mean);
        put_number(&segments, angle ? ", roughness_rad: " : ", roughness_m: ", angle ? g->roughness_rad : g->roughness_m);
        put_number(&segments, ", friction: ", g->friction);
        ceduo_text_put(&segments, "}");
    }
    ceduo_text_put(&segments, "]");
    ceduo_changes_add(c, "%s", segments.bytes);
}

/* ---- values ---- */

static void add_source(struct changes *c, const char *place, const char *source)
{
    const char *dot = strrchr(place, '.'); /* without one the value stands in the scene itself */
    LOCAL_TEXT(t);
    bool known = false;
    if (!dot)
        return;
    ceduo_text_format(&t, "%.*s.source={kind: calibrated, text: ", (int)(dot - place), place);
    ceduo_emit_scalar(&t, source, true);
    ceduo_text_put(&t, "}");
    for (size_t i = 0; i < c->n; i++)
        known |= strcmp(c->sets[i], t.bytes) == 0;
    if (!known)
        ceduo_changes_add(c, "%s", t.bytes);
}

/* Whether a row of doubt is about a fitted value. */
static bool is_fitted(const struct document *d, const struct fit_values *fit, const struct node *row)
{
    const char *path = ceduo_node_text(row, "path");
    for (size_t i = 0; path && i < d->file.inputs_of_scene; i++)
        for (size_t k = 0; strcmp(d->file.inputs[i].path, path) == 0 && k < fit->answer->parameters_count; k++)
            if (ceduo_input_shares(&d->file.inputs[i], &fit->inputs[k]))
                return true;
    return false;
}

/* The table of draws beside the rows of doubt that there are; what they say of fitted values no longer holds. */
static void add_draws(struct changes *c, const struct document *d, const struct fit_values *fit, bool of_library)
{
    const char *list;
    const struct node *rows = doubt_rows(d, &list);
    LOCAL_TEXT(t);
    bool some = false;
    ceduo_text_put(&t, "doubt={draws: ");
    ceduo_emit_scalar(&t, fit->draws, true);
    for (size_t i = 0; rows && i < rows->n; i++) {
        if (is_fitted(d, fit, rows->items[i]) || (of_library && is_of_library(rows->items[i])))
            continue;
        ceduo_text_put(&t, some ? ", " : ", rows: [");
        ceduo_emit_flow(&t, rows->items[i]);
        some = true;
    }
    ceduo_text_put(&t, some ? "]}" : "}");
    ceduo_changes_add(c, "%s", t.bytes);
}

bool ceduo_keep_fit(struct document *d, const struct fit_values *fit, struct problems *problems)
{
    struct changes c = {.d = d};
    bool of_segments = false;
    for (size_t i = 0; i < fit->answer->parameters_count; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            of_segments |= strncmp(fit->inputs[i].places[k], SEGMENTS, sizeof SEGMENTS - 1) == 0;
    bool of_library = of_segments && d->file.scene.slope.segments_given == 0;
    if (of_library)
        add_ground(&c, d);
    for (size_t i = 0; i < fit->answer->parameters_count; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++) {
            const char *place = fit->inputs[i].places[k];
            struct value v;
            bool spread = ceduo_value_find(&d->file.scene, place, &v) && v.field->type == FIELD_SPREAD &&
                          ((const struct ceduo_number *)v.at)->spread > 0;
            ceduo_changes_add(&c, "%s%s=%s", place, spread ? ".mean" : "", NUMERAL(fit->answer->parameters[i].best));
        }
    for (size_t i = 0; i < fit->answer->parameters_count; i++)
        for (size_t k = 0; k < fit->inputs[i].places_count; k++)
            add_source(&c, fit->inputs[i].places[k], fit->source);
    if (fit->draws)
        add_draws(&c, d, fit, of_library);
    return ceduo_changes_make(&c, _("fitted values"), problems);
}
