/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slope: vertices from the scene or a CSV file, relative to the first; then the ground of each segment, given directly, by
 * materials, or talus. A slope is reused if its nodes are unchanged. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "base/oom.h"
#include "csv.h"
#include "scene/ranges.h"
#include "scene/slope.h"
#include "scene_file.h"
#include "validator.h"

#define TOLERANCE "slope.tolerance_m"

/* ---- the profile ---- */

/* Read the table that a slope names; `path`: of the file, or NULL. */
static bool read_table(struct validator *v, const char *path, struct points *p, struct problems *problems)
{
    const char *layer = ceduo_node_text(ceduo_node_get(v->root, "slope"), "layer");
    return path && ceduo_csv_slope_read(v->arena, path, layer, p, problems);
}

static bool read_vertices(struct validator *v, struct points *p)
{
    const struct ceduo_slope *s = &v->draft.scene.slope;
    bool csv = ceduo_is_given(v, "slope", "csv"), list = ceduo_is_given(v, "slope", "vertices_m");
    if (!csv && !list)
        return ceduo_reject(v, "slope", "", _("'vertices_m' is missing; give the profile, or a table in 'csv'"));
    *p = (struct points){.x = s->x, .z = s->z, .n = s->vertices};
    if (list || !ceduo_is_valid(v, "slope.csv"))
        return list && ceduo_is_valid(v, "slope.vertices_m");
    const struct node *node = ceduo_node_get(ceduo_node_get(v->root, "slope"), "csv");
    const char *path = ceduo_resolve_path(v->arena, node, "slopes");
    if (!path)
        ceduo_reject(v, "slope.csv", "", _("cannot find '%s' next to this file or among the profiles (ceduo --list-profiles)"),
                     node->text);
    bool good = read_table(v, path, p, v->problems);
    if (good && p->understood)
        ceduo_add_table_note(v, "slope.csv", p->understood);
    return good;
}

/* Check the profile: x must rise and z must fall. The end points show whether a profile was drawn uphill. */
static bool check_vertices(struct validator *v, const struct points *p)
{
    bool csv = !ceduo_is_given(v, "slope", "vertices_m"), reversed = v->draft.scene.slope.reversed, rising = true;
    const char *path = csv ? "slope.csv" : "slope.vertices_m";
    if (p->n < 2)
        return ceduo_reject(v, path, "", _("a profile needs two points or more"));
    for (size_t i = 1; i < p->n; i++)
        if (p->x[i] <= p->x[i - 1]) {
            ceduo_reject(v, ceduo_asprintf(v, "slope.vertices_m[%zu]", i), "",
                         _("x must rise, but %s follows %s; give a wall a small run, such as 0.01 m"), ROUNDTRIP(p->x[i]),
                         ROUNDTRIP(p->x[i - 1]));
            rising = false;
        }
    if (!rising || (!csv && !ceduo_is_valid_below(v, "slope.vertices_m")))
        return false;
    double first = p->z[0], last = p->z[p->n - 1];
    if (last > first && !reversed)
        ceduo_reject(v, path, "",
                     _("the profile rises from %s to %s m, but rocks move along x; if it was drawn uphill, mirror it with "
                       "'reversed: true' in slope"),
                     ROUNDTRIP(first), ROUNDTRIP(last));
    else if (last < first && reversed)
        ceduo_reject(v, "slope.reversed", "", _("the profile already falls from %s to %s m; remove 'reversed'"),
                     ROUNDTRIP(first), ROUNDTRIP(last));
    return reversed ? last >= first : last <= first;
}

/* Set the vertices, relative to the first. Allocate capacity for `extra` more. */
static bool make_vertices(struct validator *v, const struct points *p, size_t extra)
{
    struct ceduo_slope *s = &v->draft.scene.slope;
    size_t last = p->n - 1;
    s->x = ceduo_alloc(v, p->n + extra, sizeof(double));
    s->z = ceduo_alloc(v, p->n + extra, sizeof(double));
    if (!s->x || !s->z)
        return false;
    s->vertices = s->points = p->n;
    s->points_x = s->x;
    s->points_z = s->z;
    s->origin_x = p->x[0];
    s->origin_z = s->reversed ? p->z[last] : p->z[0];
    for (size_t i = 0; i < p->n; i++) {
        s->x[i] = s->reversed ? p->x[last] - p->x[last - i] : p->x[i] - s->origin_x;
        s->z[i] = p->z[s->reversed ? last - i : i] - s->origin_z;
    }
    v->origin = s->origin_x;
    v->has_profile = true;
    return true;
}

/* ---- the ground ---- */

/* `p`: the profile; n = 0: unknown. */
static void check_materials(struct validator *v, const struct points *p)
{
    const struct material_belt *rows = v->draft.materials;
    size_t n = v->draft.materials_count, before = v->problems->met;
    if (n == 0)
        ceduo_reject(v, "slope.materials", "", _("the list is empty"));
    for (size_t i = 0; i < n; i++) {
        double begin = i > 0 ? rows[i - 1].to : p->n > 0 ? p->x[0] : NAN;
        const char *path = ceduo_asprintf(v, "slope.materials[%zu]", i);
        if (ceduo_check_order(v, path, rows[i].from, rows[i].to) && (rows[i].from > begin || (i > 0 && rows[i].from < begin)))
            ceduo_reject(v, path, "from_m", _("%s leaves a gap or an overlap; begin at %s"), ROUNDTRIP(rows[i].from),
                         ROUNDTRIP(begin));
    }
    if (v->problems->met == before && p->n > 0 && rows[n - 1].to < p->x[p->n - 1])
        ceduo_reject(v, ceduo_asprintf(v, "slope.materials[%zu]", n - 1), "to_m",
                     _("%s is before the end of the profile, %s; extend the last row"), ROUNDTRIP(rows[n - 1].to),
                     ROUNDTRIP(p->x[p->n - 1]));
}

/* Add the assumption of mu, which no file gives. Only the law arm uses it. */
static void assume_mu(struct validator *v, const char *path)
{
    if (v->draft.scene.simulation.law == CEDUO_LAW_ARM)
        ceduo_assume(v, path, ceduo_asprintf(v, _("friction mu %g where a rock strikes"), ceduo_segment_default().mu));
}

/* Return the path of the first segment without `key`; NULL: none. */
static const char *find_segment_without(struct validator *v, const char *key)
{
    const struct node *nodes = ceduo_node_get(ceduo_node_get(v->root, "slope"), "segments");
    for (size_t i = 0; i < nodes->n; i++)
        if (!ceduo_node_get(nodes->items[i], key))
            return ceduo_asprintf(v, "slope.segments[%zu]", i);
    return NULL;
}

static void make_segments(struct validator *v)
{
    struct ceduo_slope *s = &v->draft.scene.slope;
    const char *friction = find_segment_without(v, "friction"), *mu = find_segment_without(v, "mu");
    if (friction)
        ceduo_assume(v, friction, ceduo_asprintf(v, _("friction %g of a rolling rock"), ceduo_segment_default().friction));
    if (mu)
        assume_mu(v, mu);
    for (size_t i = 0, k = s->segments_given - 1; s->reversed && i < k; i++, k--) {
        const struct ceduo_segment swap = s->segments[i];
        s->segments[i] = s->segments[k];
        s->segments[k] = swap;
    }
    if (s->segments_given != 1)
        return;
    const struct ceduo_segment all = s->segments[0];
    s->segments = ceduo_alloc(v, s->vertices - 1, sizeof *s->segments);
    for (size_t i = 0; s->segments && i + 1 < s->vertices; i++)
        s->segments[i] = all;
}

/* Make a segment from a ground of the library. Values of the belt replace those of the library. */
static struct ceduo_segment make_segment(const struct ceduo_material *row, const struct material_belt *belt)
{
    struct ceduo_segment segment = ceduo_segment_default();
    segment.rn = ceduo_number(isnan(belt->rn) ? row->rn : belt->rn);
    segment.rt = ceduo_number(isnan(belt->rt) ? row->rt : belt->rt);
    segment.roughness_m = isnan(belt->roughness) ? row->roughness : belt->roughness;
    segment.roughness_rad = NAN;
    segment.friction = isnan(belt->friction) ? row->friction : belt->friction;
    segment.mu = isnan(belt->mu) ? row->mu : belt->mu;
    return segment;
}

/* Add a vertex if the ground changes within a segment. It lies on the line, so the shape is unchanged. */
static void split_at(struct ceduo_slope *s, double x)
{
    size_t j = ceduo_slope_segment(s, x);
    if (!(x > s->x[j]) || !(x < s->x[j + 1]))
        return;
    double z = ceduo_slope_height(s, x);
    memmove(s->x + j + 2, s->x + j + 1, (s->vertices - j - 1) * sizeof *s->x);
    memmove(s->z + j + 2, s->z + j + 1, (s->vertices - j - 1) * sizeof *s->z);
    s->x[j + 1] = x;
    s->z[j + 1] = z;
    s->vertices++;
}

static void make_materials(struct validator *v)
{
    struct ceduo_slope *s = &v->draft.scene.slope;
    size_t n = v->draft.materials_count, count;
    const struct ceduo_material *library = ceduo_materials(&count);
    struct material_belt *rows = v->draft.materials;
    if (s->reversed && (rows = ceduo_alloc(v, n, sizeof *rows))) /* mirrored like the profile */
        for (size_t i = 0; i < n; i++) {
            const struct material_belt *row = &v->draft.materials[n - 1 - i];
            rows[i] = *row;
            rows[i].from = ceduo_slope_mirrored(s, row->to);
            rows[i].to = ceduo_slope_mirrored(s, row->from);
        }
    if (n > 1) { /* keep the points of the file apart from the borders between grounds */
        s->points_x = ceduo_alloc(v, s->points, sizeof(double));
        s->points_z = ceduo_alloc(v, s->points, sizeof(double));
        if (!s->points_x || !s->points_z)
            return;
        memcpy(s->points_x, s->x, s->points * sizeof(double));
        memcpy(s->points_z, s->z, s->points * sizeof(double));
    }
    for (size_t i = 1; rows && i < n; i++)
        split_at(s, rows[i].from - v->origin);
    s->segments = rows ? ceduo_alloc(v, s->vertices - 1, sizeof *s->segments) : NULL;
    if (!s->segments)
        return;
    ceduo_assume(v, "slope.materials", _("roughness and friction of the library's grounds, and all of its rows -v4"));
    assume_mu(v, "slope.materials");
    for (size_t j = 0, row = 0; j + 1 < s->vertices; j++) {
        while (row + 1 < n && s->x[j] >= rows[row + 1].from - v->origin)
            row++;
        s->segments[j] = make_segment(&library[rows[row].material], &rows[row]);
    }
}

/* Reuse the last slope if its part of the document is unchanged: an edit elsewhere then costs nothing. */
static bool reuse_slope(struct validator *v)
{
    const struct scene_file *previous = v->previous;
    const struct node *node = ceduo_node_get(v->root, "slope");
    bool same_law = previous->scene.simulation.law == v->draft.scene.simulation.law; /* the law decides about assumptions */
    if (!node || node != previous->slope_node || !same_law)
        return false;
    v->draft.scene.slope = previous->scene.slope;
    v->origin = previous->scene.slope.origin_x;
    v->has_profile = true;
    v->file->ground_assumed = previous->ground_assumed;
    for (const struct source_note *n = previous->notes; n; n = n->before)
        if (strncmp(n->path, "slope", 5) != 0 || !n->made || strcmp(n->path, TOLERANCE) == 0)
            continue;
        else if (strcmp(n->kind, "assumed") == 0)
            ceduo_assume(v, n->path, n->text);
        else
            ceduo_add_table_note(v, n->path, n->text);
    return true;
}

double ceduo_validate_end(void *validator)
{
    struct validator *v = validator;
    const struct node *slope = ceduo_node_get(v->root, "slope"), *csv = ceduo_node_get(slope, "csv");
    const struct node *list = ceduo_node_get(slope, "vertices_m");
    const struct ceduo_slope *before = slope && v->previous->slope_node == slope ? &v->previous->scene.slope : NULL;
    LOCAL_PROBLEMS(problems); /* ignored: ceduo_validate_slope() reports them */
    struct points p = {0};
    double end = NAN;
    if (before)
        return before->origin_x + before->x[before->vertices - 1];
    if (csv && csv->kind == NODE_SCALAR) {
        if (read_table(v, ceduo_resolve_path(v->arena, csv, "slopes"), &p, &problems) && p.n > 1)
            end = p.x[p.n - 1];
    } else if (list && list->n > 1) {
        const struct node *last = list->items[list->n - 1];
        end = last->n == 2 ? ceduo_node_item_number(last, 0) : NAN;
    }
    return ceduo_schema_in_range(ceduo_schema_at("slope.vertices_m"), end) ? end : NAN;
}

void ceduo_validate_slope(struct validator *v)
{
    struct ceduo_slope *s = &v->draft.scene.slope;
    struct points p = {0};
    if (reuse_slope(v) || !ceduo_is_valid(v, "slope"))
        return;
    bool profile = read_vertices(v, &p) && check_vertices(v, &p);
    bool segments = ceduo_is_given(v, "slope", "segments"), materials = ceduo_is_given(v, "slope", "materials");
    if (profile && !make_vertices(v, &p, v->draft.materials_count))
        return;
    size_t before = v->problems->met;
    if (!segments && !materials && !ceduo_is_given(v, "slope", "csv"))
        ceduo_reject(v, "slope", "", _("'segments' or 'materials' is missing; give the ground"));
    const double smooth = ceduo_schema_default(ceduo_schema_field(ceduo_schema_segment(), "roughness_rad"));
    bool known = segments && ceduo_is_valid(v, "slope.segments");
    if (known && p.n > 1 && s->segments_given != 1 && s->segments_given != p.n - 1)
        ceduo_reject(v, "slope.segments", "",
                     _("%zu segments for %zu stretches between vertices; give one for each, or one for all"), s->segments_given,
                     p.n - 1);
    for (size_t i = 0; known && i < s->segments_given; i++)
        if (isnan(s->segments[i].roughness_m) && isnan(s->segments[i].roughness_rad))
            s->segments[i].roughness_rad = smooth;
    if (materials && !segments && ceduo_is_valid(v, "slope.materials"))
        check_materials(v, &p);
    if (!v->has_profile || v->problems->met > before || !ceduo_is_valid_below(v, "slope"))
        return;
    if (segments)
        make_segments(v);
    else if (materials)
        make_materials(v);
    else {
        v->file->ground_assumed = true;
        ceduo_assume(v, "slope", _("talus everywhere, its roughness and friction too"));
        assume_mu(v, "slope");
        s->segments = ceduo_alloc(v, s->vertices - 1, sizeof *s->segments);
        const struct material_belt none = {.rn = NAN, .rt = NAN, .roughness = NAN, .friction = NAN, .mu = NAN};
        for (size_t j = 0; s->segments && j + 1 < s->vertices; j++)
            s->segments[j] = make_segment(ceduo_material_talus(), &none);
    }
    if (s->segments && ceduo_slope_check(s) != CEDUO_OK)
        ceduo_reject(v, "slope", "", _("two vertices are too close together for their distance from the first; remove one"));
    bool given = ceduo_is_given(v, "slope", "tolerance_m");
    if (given && s->tolerance > 0 && s->segments_given > 1)
        ceduo_reject(v, TOLERANCE, "",
                     _("a profile with a ground for each segment is not simplified; remove 'tolerance_m', or give one ground "
                       "for all, or 'materials'"));
    if (!given && segments)
        s->tolerance = 0;
}

/* Count the points after simplification with a tolerance, m. */
static size_t count_points(const struct ceduo_slope *slope, double tolerance, double release_x)
{
    struct ceduo_slope copy = *slope, to;
    copy.tolerance = tolerance;
    if (ceduo_slope_simplify(&copy, release_x, &to) != CEDUO_OK)
        ceduo_oom_set_flag();
    size_t n = to.x ? to.vertices : slope->vertices;
    ceduo_slope_simplified_release(&to);
    return n;
}

/* Add the tolerance as an assumption, unless the file gives it or both ends of its range keep equally many points. A reused
 * slope keeps its last answer. */
static void assume_tolerance(struct validator *v, double release_x)
{
    const struct ceduo_slope *s = &v->draft.scene.slope;
    const struct range *range = ceduo_range_find(ceduo_schema_at(TOLERANCE));
    if (!(s->tolerance > 0) || ceduo_is_given(v, "slope", "tolerance_m"))
        return;
    bool reused = s->simplified_to == s->tolerance && s->simplified_at == release_x;
    if (reused ? ceduo_notes_print(v->previous->notes, "assumed", TOLERANCE)
               : count_points(s, range->lo, release_x) != count_points(s, range->hi, release_x))
        ceduo_assume(v, TOLERANCE, ceduo_asprintf(v, _("profile simplified to %g m"), s->tolerance));
}

void ceduo_simplify_slope(struct validator *v)
{
    struct ceduo_slope *s = &v->draft.scene.slope, to;
    if (!v->has_profile || !s->segments || !ceduo_is_valid_below(v, "slope") ||
        !ceduo_is_valid_below(v, ceduo_release_places(v)))
        return;
    assume_tolerance(v, v->draft.scene.release.x.mean);
    if (ceduo_slope_simplify(s, v->draft.scene.release.x.mean, &to) != CEDUO_OK)
        ceduo_oom_set_flag();
    if (!to.x)
        return;
    double *x = ceduo_alloc(v, to.vertices, sizeof *x), *z = ceduo_alloc(v, to.vertices, sizeof *z);
    struct ceduo_segment *segments = ceduo_alloc(v, to.vertices - 1, sizeof *segments);
    if (x && z && segments) {
        memcpy(x, to.x, to.vertices * sizeof *x);
        memcpy(z, to.z, to.vertices * sizeof *z);
        memcpy(segments, to.segments, (to.vertices - 1) * sizeof *segments);
        s->vertices = to.vertices;
        s->x = x;
        s->z = z;
        s->segments = segments;
        s->simplified_to = to.simplified_to;
        s->simplified_at = to.simplified_at;
    }
    ceduo_slope_simplified_release(&to);
}
