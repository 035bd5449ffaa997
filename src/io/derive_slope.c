/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The slope: vertices from the scene or a CSV file, made relative to the first; then the ground of each segment, given
 * directly, by materials, or talus. A slope whose nodes are those of the last time is taken over whole. */
#include "derive.h"

#include <math.h>
#include <string.h>

#include "base/language.h"
#include "resolve.h"

static bool read_vertices(struct deriver *d, struct points *p)
{
    bool csv = ceduo_derive_given(d, "slope", "csv"), list = ceduo_derive_given(d, "slope", "vertices_m");
    if (csv == list) {
        ceduo_derive_complain(d, "slope",
                              csv ? _("vertices_m and csv together; keep one") : _("'vertices_m' is missing: the profile"));
        return false;
    }
    if (!csv) {
        const struct ceduo_slope *s = &d->draft.scene.slope;
        *p = (struct points){.x = s->x, .z = s->z, .n = s->vertices};
        return ceduo_derive_known(d, "slope.vertices_m");
    }
    if (!ceduo_derive_known(d, "slope.csv"))
        return false;
    const struct node *node = ceduo_node_get(ceduo_node_get(d->root, "slope"), "csv");
    const char *path = ceduo_resolve_path(d->arena, node, "slopes");
    if (!path && d->arena->failed)
        ceduo_problem_memory(d->problems);
    else if (!path)
        ceduo_derive_complain(d, "slope.csv", _("cannot find '%s' beside this file"), node->text);
    if (!path)
        return false;
    bool good = ceduo_csv_slope_read(d->arena, path, p, d->problems);
    if (good && p->commas)
        ceduo_derive_assume(d, "slope.csv", _("commas in the file of the profile stand for decimals: 12,5 is 12.5"));
    return good;
}

static bool check_vertices(struct deriver *d, const struct points *p)
{
    bool csv = ceduo_derive_given(d, "slope", "csv"), rising = true;
    if (p->n < 2) {
        ceduo_derive_complain(d, csv ? "slope.csv" : "slope.vertices_m", _("a profile needs two vertices or more"));
        return false;
    }
    for (size_t i = 1; i < p->n; i++)
        if (p->x[i] <= p->x[i - 1]) {
            ceduo_derive_refuse(d, ceduo_derive_text(d, "slope.vertices_m[%zu]", i), "",
                                _("x %s does not lie beyond %s; x must rise: write a wall with a small run, such as 0.01 m"),
                                p->x[i], p->x[i - 1]);
            rising = false;
        }
    return rising && (csv || ceduo_derive_sound(d, "slope.vertices_m"));
}

/* Rocks go along x, so it must be downward; one that was drawn from below is known by its ends. */
static bool check_downward(struct deriver *d, const struct points *p)
{
    const char *path = ceduo_derive_given(d, "slope", "csv") ? "slope.csv" : "slope.vertices_m";
    bool reversed = d->draft.scene.slope.reversed;
    double first = p->z[0], last = p->z[p->n - 1];
    if (last > first && !reversed)
        ceduo_derive_refuse(d, path, "",
                            _("the profile rises, from %s to %s m, and rocks go along x: if it was drawn upward, write "
                              "'reversed: true' in slope, which mirrors it with its ground"),
                            first, last);
    else if (last < first && reversed)
        ceduo_derive_refuse(d, "slope.reversed", "", _("the profile falls already, from %s to %s m; leave 'reversed' out"),
                            first, last);
    return reversed ? last >= first : last <= first;
}

/* Vertices relative to the first. What is so close that this makes it one is refused. */
static bool make_vertices(struct deriver *d, const struct points *p, size_t extra)
{
    struct ceduo_slope *s = &d->draft.scene.slope;
    size_t last = p->n - 1;
    s->x = ceduo_bind_take(d->arena, p->n + extra, sizeof(double), d->problems);
    s->z = ceduo_bind_take(d->arena, p->n + extra, sizeof(double), d->problems);
    if (!s->x || !s->z)
        return false;
    s->vertices = p->n;
    s->origin_x = p->x[0];
    s->origin_z = s->reversed ? p->z[last] : p->z[0];
    for (size_t i = 0; i < p->n; i++) {
        s->x[i] = s->reversed ? p->x[last] - p->x[last - i] : p->x[i] - s->origin_x;
        s->z[i] = p->z[s->reversed ? last - i : i] - s->origin_z;
    }
    d->origin = s->origin_x;
    d->profile = true;
    return true;
}

/* `n`: stretches of the profile; 0: not known */
static void check_segments(struct deriver *d, size_t n)
{
    struct ceduo_slope *s = &d->draft.scene.slope;
    size_t given = s->segments_given;
    double smooth = ceduo_schema_default(ceduo_schema_field(ceduo_schema_segment(), "roughness_rad"));
    if (n > 0 && given != 1 && given != n)
        ceduo_derive_complain(d, "slope.segments",
                              _("%zu segments for %zu stretches between vertices; give one for each, or one for all"), given,
                              n);
    for (size_t i = 0; i < given; i++) {
        struct ceduo_segment *g = &s->segments[i];
        if (!isnan(g->roughness_m) && !isnan(g->roughness_rad))
            ceduo_derive_complain(d, ceduo_derive_text(d, "slope.segments[%zu].roughness_m", i),
                                  _("roughness_rad already says this; keep one"));
        if (isnan(g->roughness_m) && isnan(g->roughness_rad))
            g->roughness_rad = smooth;
    }
}

static bool uses_mu(const struct deriver *d)
{
    return d->draft.scene.simulation.law == CEDUO_LAW_ARM;
}

static const char *text_of_mu(struct deriver *d)
{
    return ceduo_derive_text(d, _("friction mu %g where a rock strikes"), ceduo_segment_default().mu);
}

/* The first segment that does not say `key`. */
static void note_missing(struct deriver *d, const char *key, const char *text)
{
    const struct node *nodes = ceduo_node_get(ceduo_node_get(d->root, "slope"), "segments");
    size_t i = 0;
    while (i < nodes->n && ceduo_node_get(nodes->items[i], key))
        i++;
    if (i < nodes->n)
        ceduo_derive_assume(d, ceduo_derive_text(d, "slope.segments[%zu]", i), text);
}

static void make_segments(struct deriver *d)
{
    struct ceduo_slope *s = &d->draft.scene.slope;
    note_missing(d, "friction", ceduo_derive_text(d, _("friction %g of a rolling rock"), ceduo_segment_default().friction));
    if (uses_mu(d))
        note_missing(d, "mu", text_of_mu(d));
    for (size_t i = 0, k = s->segments_given - 1; s->reversed && i < k; i++, k--) {
        const struct ceduo_segment swap = s->segments[i];
        s->segments[i] = s->segments[k];
        s->segments[k] = swap;
    }
    if (s->segments_given != 1)
        return;
    const struct ceduo_segment all = s->segments[0];
    s->segments = ceduo_bind_take(d->arena, s->vertices - 1, sizeof *s->segments, d->problems);
    for (size_t i = 0; s->segments && i + 1 < s->vertices; i++)
        s->segments[i] = all;
}

static struct ceduo_segment segment_of(const struct ceduo_material *row)
{
    struct ceduo_segment segment = ceduo_segment_default();
    segment.rn = ceduo_number(row->rn);
    segment.rt = ceduo_number(row->rt);
    segment.roughness_rad = row->roughness_rad;
    segment.mu = row->mu;
    return segment;
}

/* `p`: the profile, as far as it is known */
static void check_materials(struct deriver *d, const struct points *p)
{
    const struct material_belt *rows = d->draft.materials;
    size_t n = d->draft.materials_count, before = d->problems->met;
    if (n == 0) {
        ceduo_derive_complain(d, "slope.materials", _("the list is empty"));
        return;
    }
    for (size_t i = 0; i < n; i++) {
        double wanted = i > 0 ? rows[i - 1].to : p->n > 0 ? p->x[0] : NAN;
        if (rows[i].to <= rows[i].from)
            ceduo_derive_refuse(d, ceduo_derive_text(d, "slope.materials[%zu].to_m", i), "",
                                _("%s does not lie beyond from_m, %s"), rows[i].to, rows[i].from);
        else if (i == 0 ? rows[i].from > wanted : rows[i].from < wanted || rows[i].from > wanted)
            ceduo_derive_refuse(d, ceduo_derive_text(d, "slope.materials[%zu].from_m", i), "",
                                _("%s leaves a gap or overlaps; it must begin at %s"), rows[i].from, wanted);
    }
    if (d->problems->met == before && p->n > 0 && rows[n - 1].to < p->x[p->n - 1])
        ceduo_derive_refuse(d, ceduo_derive_text(d, "slope.materials[%zu].to_m", n - 1), "",
                            _("%s ends before the profile, at %s"), rows[n - 1].to, p->x[p->n - 1]);
}

/* A vertex where the ground changes within a segment; on the line, so that it changes nothing else. */
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

/* Its rows as they lie on a profile that was mirrored. */
static const struct material_belt *mirrored(struct deriver *d)
{
    const struct ceduo_slope *s = &d->draft.scene.slope;
    size_t n = d->draft.materials_count;
    struct material_belt *rows = ceduo_bind_take(d->arena, n, sizeof *rows, d->problems);
    for (size_t i = 0; rows && i < n; i++) {
        rows[i] = d->draft.materials[n - 1 - i];
        double from = rows[i].from;
        rows[i].from = ceduo_slope_mirrored(s, rows[i].to);
        rows[i].to = ceduo_slope_mirrored(s, from);
    }
    return rows;
}

static void make_materials(struct deriver *d)
{
    struct ceduo_slope *s = &d->draft.scene.slope;
    size_t n = d->draft.materials_count, count;
    const struct ceduo_material *library = ceduo_materials(&count);
    const struct material_belt *rows = s->reversed ? mirrored(d) : d->draft.materials;
    if (!rows)
        return;
    for (size_t i = 1; i < n; i++)
        split_at(s, rows[i].from - d->origin);
    s->segments = ceduo_bind_take(d->arena, s->vertices - 1, sizeof *s->segments, d->problems);
    if (!s->segments)
        return;
    ceduo_derive_assume(d, "slope.materials", _("roughness and friction of the library's grounds, and all of its rows -v4"));
    if (uses_mu(d))
        ceduo_derive_assume(d, "slope.materials", text_of_mu(d));
    for (size_t j = 0, row = 0; j + 1 < s->vertices; j++) {
        while (row + 1 < n && s->x[j] >= rows[row + 1].from - d->origin)
            row++;
        s->segments[j] = segment_of(&library[rows[row].material]);
    }
}

static void make_talus(struct deriver *d)
{
    struct ceduo_slope *s = &d->draft.scene.slope;
    d->ground_assumed = true;
    ceduo_derive_assume(d, "slope", _("talus everywhere, its roughness and friction too"));
    if (uses_mu(d))
        ceduo_derive_assume(d, "slope", text_of_mu(d));
    s->segments = ceduo_bind_take(d->arena, s->vertices - 1, sizeof *s->segments, d->problems);
    for (size_t j = 0; s->segments && j + 1 < s->vertices; j++)
        s->segments[j] = segment_of(ceduo_material_talus());
}

/* The slope as it was made before, where its part of the document is the same one: an edit elsewhere costs nothing,
 * however long the profile. */
static bool reuse_slope(struct deriver *d)
{
    const struct node *node = ceduo_node_get(d->root, "slope");
    bool same_law = d->last->law == d->draft.scene.simulation.law; /* which decides what is assumed */
    if (!node || node != d->last->slope_node || !same_law)
        return false;
    d->draft.scene.slope = d->last->slope;
    d->origin = d->last->slope.origin_x;
    d->profile = true;
    d->ground_assumed = d->last->ground_assumed;
    for (const struct source_note *n = d->last->notes; n; n = n->before)
        if (strcmp(n->kind, "assumed") == 0 && strncmp(n->path, "slope", 5) == 0 && n->made)
            ceduo_derive_assume(d, n->path, n->text);
    return true;
}

/* The ground, as far as the files say it. False where it cannot be made. */
static bool check_ground(struct deriver *d, const struct points *p, bool segments, bool materials)
{
    size_t before = d->problems->met;
    if (segments && materials)
        ceduo_derive_complain(d, "slope.materials", _("segments already give the ground; keep one of the two"));
    if (!segments && !materials && !ceduo_derive_given(d, "slope", "csv"))
        ceduo_derive_complain(d, "slope", _("'segments' or 'materials' is missing: the ground"));
    if (segments && ceduo_derive_known(d, "slope.segments"))
        check_segments(d, p->n > 0 ? p->n - 1 : 0);
    if (materials && !segments && ceduo_derive_known(d, "slope.materials"))
        check_materials(d, p);
    return d->profile && d->problems->met == before && ceduo_derive_sound(d, "slope");
}

void ceduo_derive_slope(struct deriver *d)
{
    struct points p = {0};
    if (reuse_slope(d) || !ceduo_derive_known(d, "slope"))
        return;
    bool profile = read_vertices(d, &p) && check_vertices(d, &p) && check_downward(d, &p);
    bool segments = ceduo_derive_given(d, "slope", "segments"), materials = ceduo_derive_given(d, "slope", "materials");
    if (profile && !make_vertices(d, &p, d->draft.materials_count))
        return;
    if (!check_ground(d, &p, segments, materials))
        return;
    if (segments)
        make_segments(d);
    else if (materials)
        make_materials(d);
    else
        make_talus(d);
    if (!d->problems->memory && ceduo_slope_check(&d->draft.scene.slope) != CEDUO_OK)
        ceduo_derive_complain(d, "slope", _("two vertices lie too close together for their distance from the first"));
}
