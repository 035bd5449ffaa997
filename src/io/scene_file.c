/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "ceduo/material.h"
#include "csv_slope.h"
#include "file.h"
#include "forms.h"
#include "base/intl.h"
#include "resolve.h"

/* Making a scene from its form: what is wrong is said at the node that it comes from. */
struct maker {
    struct scene_file *file;
    struct scene_form form;
    struct problems *problems;
    struct bad_values bad;
    bool profile; /* scene.slope has its vertices */
    double origin;
};

__attribute__((format(printf, 3, 4))) static void complain(struct maker *m, const char *path, const char *format, ...)
{
    struct text message = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&message, format, args);
    va_end(args);
    const char *within;
    size_t used;
    const struct node *node = ceduo_resolve_walk(m->file->root, path, &within, &used);
    ceduo_node_problem(m->problems, node, within, "%s", message.bytes ? message.bytes : "");
    ceduo_text_free(&message);
}

static void *take(struct maker *m, size_t n, size_t size)
{
    void *p = ceduo_arena_take(&m->file->arena, (n + 1) * size);
    if (!p)
        ceduo_problem_memory(m->problems);
    return p;
}

/* "forest[2].from_m" and the like, in the arena. */
__attribute__((format(printf, 2, 3))) static const char *path_of(struct maker *m, const char *format, ...)
{
    struct text text = {0};
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&text, format, args);
    va_end(args);
    const char *path = text.bytes ? ceduo_arena_string(&m->file->arena, text.bytes) : NULL;
    ceduo_text_free(&text);
    if (!path)
        ceduo_problem_memory(m->problems);
    return path ? path : "";
}

/* Whether `outer` is `path` or leads to it. */
static bool leads_to(const char *outer, const char *path)
{
    size_t n = strlen(outer);
    return n == 0 || (strncmp(path, outer, n) == 0 && (path[n] == '\0' || path[n] == '.' || path[n] == '['));
}

/* Whether nothing is wrong with a value or what it stands in; what is wrong within it does not count. */
__attribute__((format(printf, 2, 3))) static bool known(struct maker *m, const char *format, ...)
{
    struct text path = {0};
    va_list args;
    va_start(args, format);
    if (m->bad.n > 0)
        ceduo_text_vformat(&path, format, args);
    va_end(args);
    bool good = !path.failed;
    for (size_t i = 0; good && i < m->bad.n; i++)
        good = !leads_to(m->bad.paths[i], path.bytes);
    m->problems->memory |= path.failed;
    ceduo_text_free(&path);
    return good;
}

/* The same, and nothing within it. */
static bool sound(struct maker *m, const char *path)
{
    for (size_t i = 0; i < m->bad.n; i++)
        if (leads_to(path, m->bad.paths[i]))
            return false;
    return known(m, "%s", path);
}

/* Whether something stands there, though it may be wrong. */
static bool given(struct maker *m, const char *group, const char *key)
{
    return ceduo_node_get(ceduo_node_get(m->file->root, group), key) || !known(m, "%s.%s", group, key);
}

static const char *shown(double value, char room[CEDUO_NUMBER_ROOM])
{
    return ceduo_number_shortest(value, room);
}

/* What the program itself assumes is listed with what the files say they assume. */
static void assume(struct maker *m, const char *path, const char *text)
{
    struct source_note *note = ceduo_arena_take(&m->file->arena, sizeof *note);
    if (!note) {
        ceduo_problem_memory(m->problems);
        return;
    }
    *note = (struct source_note){
        .path = path, .kind = "assumed", .text = text, .before = m->file->notes, .made = true};
    m->file->notes = note;
}

/* ---- rock ---- */

static void want_only(struct maker *m, const char *shape, const char *const wanted[])
{
    static const char *const sizes[] = {"diameter_m", "height_m", "axes_m", "volume_m3"};
    const struct node *said = ceduo_node_get(ceduo_node_get(m->file->root, "rock"), "shape");
    bool set = said && said->source->is_option; /* nothing of the file can be taken out there */
    for (size_t i = 0; i < 4; i++) {
        bool belongs = false;
        for (size_t k = 0; wanted[k]; k++)
            belongs |= strcmp(wanted[k], sizes[i]) == 0;
        if (belongs || !ceduo_node_get(ceduo_node_get(m->file->root, "rock"), sizes[i]))
            continue;
        const char *path = path_of(m, "rock.%s", sizes[i]);
        if (set)
            complain(m, path, _("does not belong to the shape '%s'; give the whole rock: -s 'rock={shape: %s, %s}'"), shape,
                     shape, !wanted[1] ? "axes_m: [1, 1, 1]" : wanted[2] ? "diameter_m: 1" : "diameter_m: 1, height_m: 1");
        else
            complain(m, path, _("does not belong to the shape '%s'; take it out"), shape);
    }
}

static void check_sphere(struct maker *m)
{
    static const char *const ways[] = {"diameter_m", "volume_m3", "mass_kg", NULL};
    want_only(m, "sphere", ways);
    int n = given(m, "rock", "diameter_m") + given(m, "rock", "volume_m3") + given(m, "rock", "mass_kg");
    if (n != 1)
        complain(m, "rock", _("a sphere is given by one of diameter_m, volume_m3 and mass_kg, here %d are given"), n);
}

static void check_rock(struct maker *m)
{
    static const char *const cylinder[] = {"diameter_m", "height_m", NULL}, *const axes[] = {"axes_m", NULL};
    size_t before = m->problems->met;
    enum ceduo_shape shape = (enum ceduo_shape)m->form.rock.shape;
    const char *name = ceduo_shape_words.names[shape];
    const char *const *wanted = shape == CEDUO_CYLINDER ? cylinder : axes;
    if (!known(m, "rock.shape"))
        return;
    if (shape == CEDUO_SPHERE) {
        check_sphere(m);
    } else {
        want_only(m, name, wanted);
        for (size_t i = 0; wanted[i]; i++)
            if (!given(m, "rock", wanted[i]))
                complain(m, "rock", _("'%s' is missing: the shape '%s' needs it"), wanted[i], name);
        const struct node *rock = ceduo_node_get(m->file->root, "rock");
        if (ceduo_node_get(rock, "mass_kg") && ceduo_node_get(rock, "density_kg_m3"))
            complain(m, "rock.density_kg_m3", _("mass_kg says it already; keep one of the two"));
    }
    const struct rock_form *f = &m->form.rock;
    m->file->scene.rock = (struct ceduo_rock_def){.shape = shape,
                                                  .diameter = f->diameter,
                                                  .height = f->height,
                                                  .volume = f->volume,
                                                  .mass = f->mass,
                                                  .density = f->density,
                                                  .axes = {f->axes[0], f->axes[1], f->axes[2]}};
    bool by_mass = shape != CEDUO_SPHERE && given(m, "rock", "mass_kg");
    if (!given(m, "rock", "density_kg_m3") && !by_mass)
        assume(m, "rock.density_kg_m3", _("density of limestone, 2600 kg/m3"));
    struct ceduo_rock rock;
    if (before == m->problems->met && sound(m, "rock") && ceduo_rock_of_means(&m->file->scene.rock, &rock) != CEDUO_OK)
        complain(m, "rock", _("too small or too large a rock to compute with"));
}

/* ---- slope ---- */

static bool read_vertices(struct maker *m, struct points *p)
{
    bool csv = given(m, "slope", "csv"), list = given(m, "slope", "vertices_m");
    if (csv == list) {
        complain(m, "slope", csv ? _("vertices_m and csv together; keep one") : _("'vertices_m' is missing: the profile"));
        return false;
    }
    if (!csv) {
        *p = m->form.slope.vertices;
        return known(m, "slope.vertices_m");
    }
    if (!known(m, "slope.csv"))
        return false;
    const struct node *node = ceduo_node_get(ceduo_node_get(m->file->root, "slope"), "csv");
    const char *path = ceduo_resolve_path(&m->file->arena, node, "slopes");
    if (!path && m->file->arena.failed)
        ceduo_problem_memory(m->problems);
    else if (!path)
        complain(m, "slope.csv", _("cannot find '%s' beside this file"), m->form.slope.csv);
    if (!path)
        return false;
    return ceduo_csv_slope_read(&m->file->arena, path, p, m->problems);
}

static bool check_vertices(struct maker *m, const struct points *p)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    if (p->n < 2) {
        complain(m, m->form.slope.csv ? "slope.csv" : "slope.vertices_m", _("a profile needs two vertices or more"));
        return false;
    }
    bool rising = true;
    for (size_t i = 1; i < p->n; i++)
        if (p->x[i] <= p->x[i - 1]) {
            complain(m, path_of(m, "slope.vertices_m[%zu]", i),
                     _("x %s does not lie beyond %s; x must rise: write a wall with a small run, such as 0.01 m"),
                     shown(p->x[i], a), shown(p->x[i - 1], b));
            rising = false;
        }
    return rising && (m->form.slope.csv || sound(m, "slope.vertices_m"));
}

/* Vertices relative to the first. What is so close that this makes it one is refused. */
static bool make_vertices(struct maker *m, const struct points *p, size_t extra)
{
    struct ceduo_slope *s = &m->file->scene.slope;
    s->x = take(m, p->n + extra, sizeof(double));
    s->z = take(m, p->n + extra, sizeof(double));
    if (!s->x || !s->z)
        return false;
    s->vertices = p->n;
    s->origin_x = p->x[0];
    s->origin_z = p->z[0];
    for (size_t i = 0; i < p->n; i++) {
        s->x[i] = p->x[i] - s->origin_x;
        s->z[i] = p->z[i] - s->origin_z;
    }
    m->origin = m->file->origin_x = s->origin_x;
    m->profile = true;
    return true;
}

/* `n`: stretches of the profile; 0: not known */
static void check_segments(struct maker *m, size_t n)
{
    const struct list *given_segments = &m->form.slope.segments;
    if (n > 0 && given_segments->n != 1 && given_segments->n != n)
        complain(m, "slope.segments", _("%zu segments for %zu stretches between vertices; give one for each, or one for all"),
                 given_segments->n, n);
    for (size_t i = 0; i < given_segments->n; i++) {
        struct ceduo_segment *g = (struct ceduo_segment *)given_segments->items + i;
        if (!isnan(g->roughness_m) && !isnan(g->roughness_rad))
            complain(m, path_of(m, "slope.segments[%zu].roughness_m", i), _("roughness_rad says it already; keep one"));
        if (isnan(g->roughness_m) && isnan(g->roughness_rad))
            g->roughness_rad = 0;
    }
}

static void make_segments(struct maker *m)
{
    struct ceduo_slope *s = &m->file->scene.slope;
    const struct list *given_segments = &m->form.slope.segments;
    size_t n = s->vertices - 1;
    s->segments = take(m, n, sizeof *s->segments);
    if (!s->segments)
        return;
    const struct node *nodes = ceduo_node_get(ceduo_node_get(m->file->root, "slope"), "segments");
    for (size_t i = 0; i < nodes->n; i++)
        if (!ceduo_node_get(nodes->items[i], "friction")) {
            assume(m, path_of(m, "slope.segments[%zu]", i), _("friction 0.5 of a rolling rock"));
            break;
        }
    for (size_t i = 0; i < n; i++)
        s->segments[i] = ((struct ceduo_segment *)given_segments->items)[given_segments->n == 1 ? 0 : i];
}

static struct ceduo_segment segment_of(const struct ceduo_material *row)
{
    return (struct ceduo_segment){.rn = ceduo_number(row->rn),
                                  .rt = ceduo_number(row->rt),
                                  .roughness_m = NAN,
                                  .roughness_rad = row->roughness_rad,
                                  .friction = CEDUO_FRICTION_DEFAULT};
}

/* `p`: the profile, as far as it is known */
static void check_materials(struct maker *m, const struct points *p)
{
    const struct material_form *rows = m->form.slope.materials.items;
    size_t n = m->form.slope.materials.n, before = m->problems->met;
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    if (n == 0) {
        complain(m, "slope.materials", _("the list is empty"));
        return;
    }
    for (size_t i = 0; i < n; i++) {
        double wanted = i > 0 ? rows[i - 1].to : p->n > 0 ? p->x[0] : NAN;
        if (rows[i].to <= rows[i].from)
            complain(m, path_of(m, "slope.materials[%zu].to_m", i), _("%s does not lie beyond from_m, %s"),
                     shown(rows[i].to, a), shown(rows[i].from, b));
        else if (i == 0 ? rows[i].from > wanted : rows[i].from < wanted || rows[i].from > wanted)
            complain(m, path_of(m, "slope.materials[%zu].from_m", i),
                     _("%s leaves a gap or overlaps; it must begin at %s"), shown(rows[i].from, a), shown(wanted, b));
    }
    if (m->problems->met == before && p->n > 0 && rows[n - 1].to < p->x[p->n - 1])
        complain(m, path_of(m, "slope.materials[%zu].to_m", n - 1), _("%s ends before the profile, at %s"),
                 shown(rows[n - 1].to, a), shown(p->x[p->n - 1], b));
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

static void make_materials(struct maker *m)
{
    struct ceduo_slope *s = &m->file->scene.slope;
    const struct material_form *rows = m->form.slope.materials.items;
    size_t n = m->form.slope.materials.n, count;
    const struct ceduo_material *library = ceduo_materials(&count);
    for (size_t i = 1; i < n; i++)
        split_at(s, rows[i].from - m->origin);
    s->segments = take(m, s->vertices - 1, sizeof *s->segments);
    if (!s->segments)
        return;
    assume(m, "slope.materials", _("roughness and friction of the library's grounds, and all of its rows -v4"));
    for (size_t j = 0, row = 0; j + 1 < s->vertices; j++) {
        while (row + 1 < n && s->x[j] >= rows[row + 1].from - m->origin)
            row++;
        s->segments[j] = segment_of(&library[rows[row].material]);
    }
}

static void make_talus(struct maker *m)
{
    struct ceduo_slope *s = &m->file->scene.slope;
    m->file->ground_assumed = true;
    assume(m, "slope", _("talus everywhere, its roughness and friction too"));
    s->segments = take(m, s->vertices - 1, sizeof *s->segments);
    for (size_t j = 0; s->segments && j + 1 < s->vertices; j++)
        s->segments[j] = segment_of(ceduo_material_talus());
}

/* The slope as it was made before, where its part of the document is the same one: an edit elsewhere costs nothing,
 * however long the profile. */
static bool reuse_slope(struct maker *m, const struct scene_file *before)
{
    const struct node *node = ceduo_node_get(m->file->root, "slope");
    if (!node || node != before->slope_node)
        return false;
    m->file->scene.slope = before->scene.slope;
    m->origin = before->origin_x;
    m->profile = true;
    m->file->ground_assumed = before->ground_assumed;
    for (const struct source_note *n = before->notes; n; n = n->before)
        if (strcmp(n->kind, "assumed") == 0 && strncmp(n->path, "slope", 5) == 0 && n->made)
            assume(m, n->path, n->text);
    return true;
}

/* The ground, as far as the files say it. False where it cannot be made. */
static bool check_ground(struct maker *m, const struct points *p, bool segments, bool materials)
{
    size_t before = m->problems->met;
    if (segments && materials)
        complain(m, "slope.materials", _("segments say the ground already; keep one of the two"));
    if (!segments && !materials && !given(m, "slope", "csv"))
        complain(m, "slope", _("'segments' or 'materials' is missing: the ground"));
    if (segments && known(m, "slope.segments"))
        check_segments(m, p->n > 0 ? p->n - 1 : 0);
    if (materials && !segments && known(m, "slope.materials"))
        check_materials(m, p);
    return m->profile && m->problems->met == before && sound(m, "slope");
}

static void make_slope(struct maker *m)
{
    struct points p = {0};
    if (!known(m, "slope"))
        return;
    bool profile = read_vertices(m, &p) && check_vertices(m, &p);
    m->file->scene.slope.facets = (enum ceduo_facets)m->form.slope.facets;
    bool segments = given(m, "slope", "segments"), materials = given(m, "slope", "materials");
    if (profile && !make_vertices(m, &p, m->form.slope.materials.n))
        return;
    if (!check_ground(m, &p, segments, materials))
        return;
    if (segments)
        make_segments(m);
    else if (materials)
        make_materials(m);
    else
        make_talus(m);
    if (!m->problems->memory && ceduo_slope_check(&m->file->scene.slope) != CEDUO_OK)
        complain(m, "slope", _("two vertices lie too close together for their distance from the first"));
}

/* ---- release and controls ---- */

static void make_release(struct maker *m)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM], c[CEDUO_NUMBER_ROOM];
    struct ceduo_scene *scene = &m->file->scene;
    scene->release = m->form.release;
    bool own_x = !isnan(scene->release.x.mean);
    scene->release.x.mean = own_x ? scene->release.x.mean - m->origin : 0;
    if (!m->profile || !sound(m, "release.x_m"))
        return;
    double end = scene->slope.x[scene->slope.vertices - 1];
    double first = ceduo_number_lowest(scene->release.x), last = ceduo_number_highest(scene->release.x);
    if (!(first >= 0) || !(last < end))
        complain(m, "release.x_m", _("%s lies beyond the slope, which has room for a release from %s to before %s m"),
                 shown((first >= 0 ? last : first) + m->origin, a), shown(m->origin, b), shown(end + m->origin, c));
}

static bool check_control(struct maker *m, const char *path, const struct ceduo_control *c, size_t i)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    const struct ceduo_scene *scene = &m->file->scene;
    double end = m->profile ? scene->slope.x[scene->slope.vertices - 1] : INFINITY;
    bool starts = m->profile && sound(m, "release.x_m");
    double last = starts ? ceduo_number_highest(scene->release.x) : -INFINITY;
    if (c->x > end) {
        complain(m, path, _("%s lies beyond the slope, which ends at %s m"), shown(c->x_given, a),
                 shown(end + m->origin, b));
        return false;
    }
    if (c->x <= last) {
        complain(m, path, _("%s does not lie beyond the release, %s m"), shown(c->x_given, a),
                 shown(last + m->origin, b));
        return false;
    }
    for (size_t k = 0; k < i; k++)
        if (scene->controls[k].x == c->x) {
            complain(m, path, _("%s is given twice"), shown(c->x_given, a));
            return false;
        }
    return true;
}

/* Says so where a list is longer than anybody reads. */
static bool too_many(struct maker *m, const char *path, size_t n)
{
    if (n > CEDUO_ITEMS_MOST)
        complain(m, path, _("%zu are more than the %d that can be computed at once"), n, CEDUO_ITEMS_MOST);
    return n > CEDUO_ITEMS_MOST;
}

static void make_controls(struct maker *m)
{
    struct ceduo_scene *scene = &m->file->scene;
    bool listed = m->form.controls.n > 0;
    size_t n = listed ? m->form.controls.n : m->form.controls_m.n;
    if (ceduo_node_get(m->file->root, "controls") && ceduo_node_get(m->file->root, "controls_m")) {
        complain(m, "controls_m", _("controls say it already; keep one of the two"));
        return;
    }
    if (!known(m, "controls") || !known(m, "controls_m"))
        return;
    if (n == 0) {
        complain(m, "", _("'controls' is missing: at least one place where the rocks that pass are counted"));
        return;
    }
    if (too_many(m, listed ? "controls" : "controls_m", n) ||
        !(scene->controls = take(m, n, sizeof *scene->controls)))
        return;
    for (size_t i = 0; i < n; i++) {
        const struct control_form *f = listed ? (struct control_form *)m->form.controls.items + i : NULL;
        double x = f ? f->x : m->form.controls_m.values[i];
        scene->controls[i] = (struct ceduo_control){.x = x - m->origin,
                                                    .x_given = x,
                                                    .name = f && f->name ? (char *)(uintptr_t)f->name : NULL,
                                                    .accepted = f ? f->accepted : NAN,
                                                    .measured_speed = f ? f->measured_speed : NAN};
        check_control(m, listed ? path_of(m, "controls[%zu].x_m", i) : path_of(m, "controls_m[%zu]", i),
                      &scene->controls[i], i);
        scene->controls_count = i + 1;
    }
}

/* ---- stands, belts, options ---- */

#define SHOOTS_MOST 10000 /* on a stool */

static enum ceduo_system system_of(const struct stand_form *f)
{
    if (f->system >= 0)
        return (enum ceduo_system)f->system;
    return f->shoots.n > 0 ? CEDUO_SIMPLE_COPPICE : f->trees.n > 0 ? CEDUO_HIGH_FOREST : CEDUO_BARE;
}

/* Wider spreads are no diameters of one cohort or class: nearly all of its stems would be hair, and few very thick. */
static void check_spreads(struct maker *m, const char *path, const char *list, const struct ceduo_stems *stems, size_t n)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    for (size_t i = 0; i < n; i++)
        if (stems[i].dbh_sd > stems[i].dbh && known(m, "%s.%s[%zu].dbh_m", path, list, i) &&
            known(m, "%s.%s[%zu].dbh_sd_m", path, list, i))
            complain(m, path_of(m, "%s.%s[%zu].dbh_sd_m", path, list, i),
                     _("%s m is more than the diameter itself, %s m: make two entries of stems so different"),
                     shown(stems[i].dbh_sd, a), shown(stems[i].dbh, b));
}

static void make_stand(struct maker *m, const char *path, const struct stand_form *f, struct ceduo_stand *stand)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    *stand = (struct ceduo_stand){.system = system_of(f),
                                  .species = f->species,
                                  .stools_per_ha = f->stools_per_ha,
                                  .spacing = f->spacing,
                                  .shoots_count = f->shoots.n,
                                  .trees_count = f->trees.n,
                                  .shoots = f->shoots.items,
                                  .trees = f->trees.items,
                                  .energy = (enum ceduo_energy_model)f->energy,
                                  .u = f->u,
                                  .fracture_ratio = f->fracture_ratio,
                                  .growth = f->growth,
                                  .cutting = {.rotation = (unsigned)f->rotation,
                                              .cohorts = (unsigned)f->cohorts,
                                              .stay_count = f->stay.n,
                                              .stay_per_ha = f->stay.values}};
    if (!known(m, "%s", path)) /* what it starts from is not there */
        return;
    if (f->growth.shoots_young < f->growth.shoots_old && known(m, "%s.growth.shoots_young", path))
        complain(m, path_of(m, "%s.growth.shoots_young", path), _("%s is below shoots_old, %s: shoots only become fewer"),
                 shown(f->growth.shoots_young, a), shown(f->growth.shoots_old, b));
    if (f->system == CEDUO_BARE && (f->shoots.n > 0 || f->trees.n > 0))
        complain(m, path_of(m, "%s.system", path), _("'bare', but there are stems; name the system or take them out"));
    check_spreads(m, path, "shoots", f->shoots.items, f->shoots.n);
    check_spreads(m, path, "trees", f->trees.items, f->trees.n);
    if (!known(m, "%s.stools.per_ha", path) || !known(m, "%s.shoots", path))
        return;
    if (f->stools_per_ha > 0 && ceduo_stand_shoots(stand) / f->stools_per_ha > SHOOTS_MOST)
        complain(m, path_of(m, "%s.shoots", path), _("%s shoots on each stool are more than the %d that can be drawn"),
                 shown(ceduo_stand_shoots(stand) / f->stools_per_ha, a), SHOOTS_MOST);
    if (f->shoots.n > 0 && !(f->stools_per_ha > 0))
        complain(m, path_of(m, "%s.shoots", path), _("shoots without stools; add 'stools: {per_ha: …, spacing_m: …}'"));
    else if (f->shoots.n == 0 && f->stools_per_ha > 0)
        complain(m, path_of(m, "%s.stools", path), _("stools without shoots; add 'shoots', or take the stools out"));
    else if (f->shoots.n > 0 && ceduo_stand_shoots(stand) < f->stools_per_ha)
        complain(m, path_of(m, "%s.stools.per_ha", path), _("%s shoots on %s stools: a stool has one shoot at least"),
                 shown(ceduo_stand_shoots(stand), a), shown(f->stools_per_ha, b));
}

static void check_belt(struct maker *m, const char *path, const struct belt_form *f, const struct belt_form *before)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM];
    const struct ceduo_slope *s = &m->file->scene.slope;
    double begin = m->profile ? m->origin : -INFINITY, end = m->profile ? s->x[s->vertices - 1] + m->origin : INFINITY;
    if (f->to <= f->from) {
        complain(m, path_of(m, "%s.to_m", path), _("%s does not lie beyond from_m, %s"), shown(f->to, a),
                 shown(f->from, b));
        return;
    }
    if (before && f->from < before->to)
        complain(m, path_of(m, "%s.from_m", path), _("%s lies before the end of the belt before it, %s; belts must not overlap"),
                 shown(f->from, a), shown(before->to, b));
    else if (f->from < begin)
        complain(m, path_of(m, "%s.from_m", path), _("%s lies before the slope, which begins at %s m"), shown(f->from, a),
                 shown(begin, b));
    if (f->to > end)
        complain(m, path_of(m, "%s.to_m", path), _("%s lies beyond the slope, which ends at %s m"), shown(f->to, a),
                 shown(end, b));
}

static const char *stand_name(struct maker *m, const char *path, const struct stand_form *f)
{
    if (f->name)
        return f->name;
    const char *within;
    size_t used;
    const struct node *node = ceduo_resolve_walk(m->file->root, path, &within, &used);
    if (node->written && node->written->kind == NODE_SCALAR)
        return node->written->text;
    return f->shoots.n + f->trees.n > 0 ? _("stand") : _("bare");
}

static void make_belts(struct maker *m, const char *path, const struct list *forms, struct ceduo_option *option)
{
    if (!(option->belts = take(m, forms->n, sizeof *option->belts)))
        return;
    for (size_t i = 0; i < forms->n; i++) {
        const struct belt_form *f = (struct belt_form *)forms->items + i;
        struct ceduo_belt *belt = &option->belts[i];
        const char *here = path_of(m, "%s[%zu]", path, i), *stand = path_of(m, "%s.stand", here);
        check_belt(m, here, f, i > 0 ? f - 1 : NULL);
        *belt = (struct ceduo_belt){.from = f->from - m->origin,
                                    .to = f->to - m->origin,
                                    .from_given = f->from,
                                    .to_given = f->to,
                                    .name = (char *)(uintptr_t)stand_name(m, stand, &f->stand),
                                    .cut_year = f->cut_year,
                                    .assumed = ceduo_scene_assumes(m->file, stand)};
        make_stand(m, stand, &f->stand, &belt->stand);
        option->belts_count = i + 1;
    }
}

static void make_options(struct maker *m)
{
    struct ceduo_scene *scene = &m->file->scene;
    bool many = ceduo_node_get(m->file->root, "options") != NULL;
    if (many && ceduo_node_get(m->file->root, "forest")) {
        complain(m, "forest", _("options say it already; keep one of the two"));
        return;
    }
    if (!known(m, "options"))
        return;
    if (many && m->form.options.n == 0) {
        complain(m, "options", _("the list is empty"));
        return;
    }
    size_t n = many ? m->form.options.n : 1;
    if (too_many(m, "options", n) || !(scene->options = take(m, n, sizeof *scene->options)))
        return;
    for (size_t i = 0; i < n; i++) {
        const struct option_form *f = many ? (struct option_form *)m->form.options.items + i : NULL;
        struct ceduo_option *option = &scene->options[i];
        scene->options_count = i + 1;
        option->name = (char *)(uintptr_t)(f ? f->name : "current");
        for (size_t k = 0; f && f->name && k < i; k++)
            if (scene->options[k].name && strcmp(scene->options[k].name, f->name) == 0)
                complain(m, path_of(m, "options[%zu].name", i), _("'%s' is given twice; names must differ"), f->name);
        make_belts(m, f ? path_of(m, "options[%zu].forest", i) : "forest", f ? &f->forest : &m->form.forest, option);
    }
}

/* ---- all together ---- */

static void make_simulation(struct maker *m)
{
    const struct simulation_form *f = &m->form.simulation;
    m->file->scene.simulation =
        (struct ceduo_simulation){.law = (enum ceduo_law)f->law,
                                  .rocks = f->rocks,
                                  .seed = f->seed,
                                  .contact_model = (enum ceduo_contact_model)f->contact_model,
                                  .rule = (enum ceduo_rule)f->rule,
                                  .threshold = f->threshold,
                                  .gravity = f->gravity,
                                  .scale_rn = f->scale_rn};
}

static const char *title_of(struct scene_file *file, const char *title)
{
    if (title)
        return title;
    const char *slash = strrchr(file->path, '/');
    return slash ? slash + 1 : file->path;
}

bool ceduo_scene_bind(struct scene_file *file, struct problems *problems)
{
    struct maker m = {.file = file, .problems = problems};
    const struct scene_file last = *file;
    size_t before = problems->count;
    file->notes = NULL;
    file->ground_assumed = false;
    file->scene = (struct ceduo_scene){0};
    file->slope_node = NULL;
    ceduo_scene_form_init(&m.form);
    ceduo_schema_bind(&file->arena, ceduo_schema_scene(), file->root, &m.form, problems, &file->notes, &m.bad);
    if (m.bad.n > CEDUO_BAD_MOST || problems->memory)
        return false;
    file->scene.title = (char *)(uintptr_t)title_of(file, m.form.title);
    file->scene.rocks_per_year = m.form.rocks_per_year;
    file->scene.reserves_minimum = m.form.reserves_minimum;
    make_simulation(&m);
    check_rock(&m);
    if (!reuse_slope(&m, &last))
        make_slope(&m);
    make_release(&m);
    make_controls(&m);
    make_options(&m);
    bool good = problems->count == before && !problems->memory;
    file->slope_node = good ? ceduo_node_get(file->root, "slope") : NULL;
    return good;
}

/* The '=' that ends a path; one within brackets belongs to a name. */
static const char *equals_of(const char *set)
{
    bool inside = false;
    for (const char *p = set; *p; p++) {
        inside = *p == '[' || (inside && *p != ']');
        if (*p == '=' && !inside)
            return p;
    }
    return strchr(set, '='); /* a bracket that is never closed */
}

bool ceduo_scene_set(struct scene_file *file, const char *option, const char *set, struct problems *problems)
{
    struct source *source = ceduo_arena_take(&file->arena, sizeof *source);
    char *copy = ceduo_arena_string(&file->arena, set);
    if (!source || !copy) {
        ceduo_problem_memory(problems);
        return false;
    }
    *source = (struct source){
        .name = option, .bytes = copy, .length = strlen(copy), .is_option = true, .beside = file->path};
    const char *equals = equals_of(copy);
    if (!equals || equals == copy) {
        ceduo_problem(problems, source, 1, 1, _("PATH=VALUE is wanted"));
        return false;
    }
    size_t length = (size_t)(equals - copy);
    const struct node *value = ceduo_yaml_read_value(&file->arena, source, length + 1, problems);
    if (!value)
        return false;
    const struct node *root = ceduo_resolve_set(&file->arena, file->root, source, length, value, problems);
    if (root)
        file->root = root;
    return root != NULL;
}

/* A name that is neither a file nor a scene among the profiles: the nearest of these, and where they were looked for. */
static void complain_no_scene(struct scene_file *file, const char *path, struct problems *problems)
{
    struct text names = {0}, folders = {0};
    const char *near = NULL;
    char *plain = ceduo_arena_string(&file->arena, path);
    size_t length = plain ? strlen(plain) : 0;
    if (length > 5 && strcmp(plain + length - 5, ".yaml") == 0)
        plain[length - 5] = '\0';
    const char *const *all = plain ? ceduo_file_folders(&file->arena) : NULL;
    for (size_t i = 0; all && all[i]; i++) {
        size_t n;
        const char *const *list = ceduo_file_list(&file->arena, all[i], "scenes", &n);
        const char **words = ceduo_arena_take(&file->arena, (n + 1) * sizeof *words);
        for (size_t k = 0; words && k < n; k++)
            words[k] = ceduo_arena_copy(&file->arena, list[k], strlen(list[k]) - 5);
        near = near || !words || file->arena.failed ? near : ceduo_text_nearest(plain, words, n);
        ceduo_text_format(&folders, "%s%s/scenes", i > 0 ? ", " : "", all[i]);
    }
    if (near)
        ceduo_text_format(&names, _("; did you mean '%s'?"), near);
    if (folders.bytes)
        ceduo_text_format(&names, _(" (looked for here and in %s)"), folders.bytes);
    problems->memory |= names.failed || folders.failed || file->arena.failed;
    ceduo_problem(problems, &(struct source){.name = path}, 0, 0, _("cannot read it: %s%s"), strerror(ENOENT),
                  names.bytes ? names.bytes : "");
    ceduo_text_free(&names);
    ceduo_text_free(&folders);
}

/* The file's own name, or the shipped scene that the name means; NULL where it is neither, which is told. */
static const char *scene_path(struct scene_file *file, const char *path, struct problems *problems)
{
    const char *found = strcmp(path, "-") == 0 ? path : ceduo_file_find(&file->arena, path, NULL, "scenes");
    if (found || *path == '\0' || strchr(path, '/') || access(path, F_OK) == 0 || errno != ENOENT)
        return found ? found : path;
    complain_no_scene(file, path, problems);
    return NULL;
}

/* From the text of a scene to the scene. */
static bool make_scene(struct scene_file *file, const struct source *source, const char *const *sets,
                        size_t sets_count, struct problems *problems)
{
    size_t before = problems->count;
    file->path = source->name;
    file->raw = file->root = ceduo_yaml_read(&file->arena, source, problems);
    if (!file->root)
        return false;
    if (file->root->kind != NODE_MAP) {
        ceduo_node_problem(problems, file->root, NULL, _("a scene is a mapping that begins with 'ceduo: scene/1'"));
        return false;
    }
    for (size_t i = 0; i < sets_count; i++)
        if (!ceduo_scene_set(file, "--set", sets[i], problems))
            return false;
    const struct node *root = ceduo_resolve_scene(&file->arena, file->root, problems);
    if (!root)
        return false;
    file->root = root;
    return ceduo_scene_bind(file, problems) && problems->count == before;
}

/* Whether the scene is good with the first n changes alone. */
static bool is_good_with(const struct source *source, const char *const *sets, size_t n, struct problems *problems)
{
    struct scene_file trial = {0};
    struct problems found = {0};
    bool good = make_scene(&trial, source, sets, n, &found);
    problems->memory |= found.memory;
    ceduo_problems_free(&found);
    ceduo_scene_release(&trial);
    return good;
}

/* A change that is right by itself may not fit the rest, and what is wrong is then found at a value of the file: the
 * change is named before that. It is the one after which the scene was never good again. */
static void name_change(struct arena *arena, const struct source *source, const char *const *sets, size_t n,
                        struct problems *problems)
{
    if (n == 0 || problems->usage || problems->memory || !is_good_with(source, sets, 0, problems))
        return;
    size_t last = n - 1;
    while (last > 0 && !problems->memory && !is_good_with(source, sets, last, problems))
        last--;
    struct source *set = ceduo_arena_take(arena, sizeof *set);
    if (!set) {
        ceduo_problem_memory(problems);
        return;
    }
    *set = (struct source){.name = "--set", .bytes = sets[last], .length = strlen(sets[last]), .is_option = true};
    struct problems head = {0};
    ceduo_problem(&head, set, 1, (size_t)(equals_of(sets[last]) - sets[last]) + 2,
                  _("the scene is good without this change, but not with it:"));
    ceduo_text_add(&head.text, problems->text.bytes, problems->text.length);
    ceduo_text_free(&problems->text);
    problems->text = head.text;
    problems->memory |= head.memory || head.text.failed;
    problems->usage = true;
}

static bool read_source(struct scene_file *file, const struct source *source, const char *const *sets,
                        size_t sets_count, struct problems *problems)
{
    if (make_scene(file, source, sets, sets_count, problems))
        return true;
    name_change(&file->arena, source, sets, sets_count, problems);
    return false;
}

bool ceduo_scene_read(struct scene_file *file, const char *path, const char *const *sets, size_t sets_count,
                      struct problems *problems)
{
    return ceduo_scene_read_by(file, NULL, path, sets, sets_count, problems);
}

bool ceduo_scene_read_by(struct scene_file *file, struct shelf *shelf, const char *path, const char *const *sets,
                         size_t sets_count, struct problems *problems)
{
    *file = (struct scene_file){.path = path, .arena = {.shelf = shelf}};
    const char *found = scene_path(file, path, problems);
    const struct source *source = found ? ceduo_file_read(&file->arena, found, YAML_BYTES_MOST, problems) : NULL;
    return source && read_source(file, source, sets, sets_count, problems);
}

bool ceduo_scene_read_text(struct scene_file *file, const char *name, const char *text, struct problems *problems)
{
    *file = (struct scene_file){.path = name};
    struct source *source = ceduo_arena_take(&file->arena, sizeof *source);
    char *own_name = ceduo_arena_string(&file->arena, name), *copy = ceduo_arena_string(&file->arena, text);
    if (!source || !own_name || !copy) {
        ceduo_problem_memory(problems);
        return false;
    }
    *source = (struct source){.name = own_name, .bytes = copy, .length = strlen(copy)};
    return read_source(file, source, NULL, 0, problems);
}

void ceduo_scene_release(struct scene_file *file)
{
    ceduo_arena_free(&file->arena);
    *file = (struct scene_file){0};
}

bool ceduo_note_of_years(const struct source_note *note)
{
    return strstr(note->path, ".growth") != NULL || strstr(note->path, ".cutting") != NULL;
}

bool ceduo_scene_assumes(const struct scene_file *file, const char *path)
{
    size_t n = strlen(path);
    for (const struct source_note *note = file->notes; note; note = note->before)
        if (strncmp(note->path, path, n) == 0 && (note->path[n] == '\0' || note->path[n] == '.' || note->path[n] == '[') &&
            strcmp(note->kind, "assumed") == 0 && !ceduo_note_of_years(note))
            return true;
    return false;
}

const struct source_note *ceduo_scene_note(const struct scene_file *file, const char *path)
{
    const struct source_note *best = NULL;
    for (const struct source_note *note = file->notes; note; note = note->before) {
        if (!leads_to(note->path, path))
            continue;
        size_t n = strlen(note->path), most = best ? strlen(best->path) : 0;
        if (!best || n > most || (n == most && strcmp(best->kind, "changed") == 0)) /* its own goes before what is around */
            best = note;
    }
    return best;
}

bool ceduo_scene_assumes_value(const struct scene_file *file, const char *path)
{
    const struct source_note *note = ceduo_scene_note(file, path);
    return note && strcmp(note->kind, "assumed") == 0;
}
