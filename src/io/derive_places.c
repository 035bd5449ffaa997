/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The places of a scene: release, controls, belts and their stands, relative to the first vertex of the slope, and
 * whether they fit together. Lists that are made here lie in the arena of the deriver. */
#include "ceduo/rotation.h"
#include "derive.h"

#include <math.h>
#include <string.h>

#include "base/language.h"
#include "resolve.h"

/* ---- release and controls ---- */

void ceduo_derive_release(struct deriver *d, const char *path, struct ceduo_release *release)
{
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM], c[CEDUO_NUMBER_ROOM];
    const struct ceduo_scene *scene = &d->draft.scene;
    struct ceduo_number *x = &release->x;
    path = ceduo_derive_text(d, "%s.x_m", path);
    release->x_assumed = isnan(x->mean);
    x->mean = release->x_assumed ? 0 : x->mean - d->origin;
    if (!d->profile || !ceduo_derive_sound(d, path))
        return;
    double end = scene->slope.x[scene->slope.vertices - 1];
    double first = ceduo_number_lowest(*x), last = ceduo_number_highest(*x);
    if (!(first >= 0) || !(last < end))
        ceduo_derive_complain(d, path, _("%s lies beyond the slope; a release may be anywhere from %s to before %s m"),
                              ceduo_number_shortest((first >= 0 ? last : first) + d->origin, a),
                              ceduo_number_shortest(d->origin, b), ceduo_number_shortest(end + d->origin, c));
}

static void check_control(struct deriver *d, const char *path, const struct ceduo_control *c, size_t i)
{
    const struct ceduo_scene *scene = &d->draft.scene;
    double end = d->profile ? scene->slope.x[scene->slope.vertices - 1] : INFINITY;
    bool starts = d->profile && ceduo_derive_sound(d, "release.x_m");
    double last = starts ? ceduo_number_highest(scene->release.x) : -INFINITY;
    if (c->x > end) {
        ceduo_derive_refuse(d, path, "", _("%s lies beyond the slope, which ends at %s m"), c->x_given, end + d->origin);
        return;
    }
    if (c->x <= last) {
        ceduo_derive_refuse(d, path, "", _("%s does not lie beyond the release, %s m"), c->x_given, last + d->origin);
        return;
    }
    for (size_t k = 0; k < i; k++)
        if (scene->controls[k].x == c->x) {
            ceduo_derive_refuse(d, path, "", _("%s is given twice"), c->x_given, 0);
            return;
        }
}

/* Controls as they are listed by their x alone. */
static bool list_controls(struct deriver *d, size_t n)
{
    struct ceduo_scene *scene = &d->draft.scene;
    const struct object *object = ceduo_schema_field(ceduo_schema_scene(), "controls")->object;
    if (!(scene->controls = ceduo_bind_take(d->arena, n, sizeof *scene->controls, d->problems)))
        return false;
    for (size_t i = 0; i < n; i++) {
        ceduo_schema_init(object, &scene->controls[i]);
        scene->controls[i].x_given = d->draft.controls_m[i];
    }
    return true;
}

void ceduo_derive_controls(struct deriver *d)
{
    struct ceduo_scene *scene = &d->draft.scene;
    bool listed = scene->controls_count > 0;
    size_t n = listed ? scene->controls_count : d->draft.controls_m_count;
    const char *path = listed ? "controls" : "controls_m";
    scene->controls_count = 0;
    if (ceduo_node_get(d->root, "controls") && ceduo_node_get(d->root, "controls_m")) {
        ceduo_derive_complain(d, "controls_m", _("controls already say this; keep one of the two"));
        return;
    }
    if (!ceduo_derive_known(d, "controls") || !ceduo_derive_known(d, "controls_m"))
        return;
    if (n == 0) {
        ceduo_derive_complain(d, "", _("'controls' is missing: name at least one place where passing rocks are counted"));
        return;
    }
    if (ceduo_derive_too_many(d, path, n) || (!listed && !list_controls(d, n)))
        return;
    for (size_t i = 0; i < n; i++) {
        struct ceduo_control *c = &scene->controls[i];
        c->x = c->x_given - d->origin;
        check_control(d, ceduo_derive_text(d, listed ? "%s[%zu].x_m" : "%s[%zu]", path, i), c, i);
    }
    scene->controls_count = n;
}

/* ---- stands, belts, options ---- */

#define SHOOTS_MOST 10000 /* on a stool */

static enum ceduo_system system_of(const struct ceduo_stand *stand)
{
    return ceduo_stand_has_shoots(stand) ? CEDUO_SIMPLE_COPPICE : ceduo_stand_has_stems(stand) ? CEDUO_HIGH_FOREST : CEDUO_BARE;
}

/* Wider spreads are no diameters of one cohort or class: nearly all of its stems would be hair, and few very thick. */
static void check_spreads(struct deriver *d, const char *path, const char *list, const struct ceduo_stems *stems, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (stems[i].dbh_sd > stems[i].dbh) /* not where one of them could not be read: NaN, and 0 */
            ceduo_derive_refuse(d, ceduo_derive_text(d, "%s.%s[%zu].dbh_sd_m", path, list, i), "",
                                _("%s m is more than the diameter itself, %s m: make two entries of stems so different"),
                                stems[i].dbh_sd, stems[i].dbh);
}

/* Whether a value that is needed is not there; one that could not be read is told already. */
static bool lacks(struct deriver *d, double value, const char *path, const char *key)
{
    return isnan(value) && ceduo_derive_known(d, "%s%s", path, key);
}

/* Whether something is written at a path. */
static bool is_written(struct deriver *d, const char *path)
{
    const char *within;
    size_t used;
    ceduo_resolve_walk(d->root, path, &within, &used);
    return path[used] == '\0';
}

/* Shoots are given per hectare or per stool. */
static void check_densities(struct deriver *d, const char *path, const struct ceduo_stand *s)
{
    for (size_t i = 0; i < s->shoots_count; i++) {
        const struct ceduo_stems *stems = &s->shoots[i];
        const char *here = ceduo_derive_text(d, "%s.shoots[%zu]", path, i);
        bool each = is_written(d, ceduo_derive_text(d, "%s.per_stool", here));
        if (each && is_written(d, ceduo_derive_text(d, "%s.per_ha", here)))
            ceduo_derive_refuse(d, here, ".per_stool", _("per_ha already says this; keep one of the two"), 0, 0);
        else if (!each && lacks(d, stems->per_ha, here, ".per_ha") && ceduo_derive_known(d, "%s.per_stool", here))
            ceduo_derive_refuse(d, here, "", _("'per_ha' or 'per_stool' is missing: how many shoots there are"), 0, 0);
        else if (each && !is_written(d, ceduo_derive_text(d, "%s.stools.per_ha", path)) &&
                 ceduo_derive_known(d, "%s.stools.per_ha", path))
            ceduo_derive_refuse(d, path, ".shoots", _("shoots without stools; add 'stools: {per_ha: …, spacing_m: …}'"), 0, 0);
    }
}

/* Of what is in the way besides stems no figure is assumed. */
static void check_low(struct deriver *d, const char *path, const struct ceduo_stand *s)
{
    const struct ceduo_stumps *t = &s->stumps;
    const struct ceduo_logs *l = &s->logs;
    if (t->per_ha > 0 && (lacks(d, t->diameter, path, ".stumps.diameter_m") || lacks(d, t->height, path, ".stumps.height_m") ||
                          lacks(d, t->energy, path, ".stumps.energy_kJ")))
        ceduo_derive_refuse(d, path, ".stumps", _("stumps need diameter_m, height_m and energy_kJ; nothing is assumed here"), 0,
                            0);
    if (l->per_ha > 0 && (lacks(d, l->length, path, ".logs.length_m") || lacks(d, l->diameter, path, ".logs.diameter_m") ||
                          lacks(d, l->energy, path, ".logs.energy_kJ")))
        ceduo_derive_refuse(d, path, ".logs", _("logs need length_m, diameter_m and energy_kJ; nothing is assumed here"), 0, 0);
    for (size_t i = 0; i < s->trees_count; i++) {
        const char *groups = ceduo_derive_text(d, "%s.trees[%zu].groups", path, i);
        if (s->trees[i].group > 1 && lacks(d, s->trees[i].group_radius, groups, ".radius_m"))
            ceduo_derive_refuse(d, groups, "",
                                _("groups of %s trees need radius_m, the radius of the disc in which they stand"),
                                s->trees[i].group, 0);
    }
}

static void derive_stand(struct deriver *d, const char *path, struct ceduo_stand *s)
{
    ceduo_stand_count_shoots(s);
    if ((int)s->system < 0)
        s->system = system_of(s);
    if (!ceduo_derive_known(d, "%s", path)) /* what it starts from is not there */
        return;
    if (s->growth.shoots_young < s->growth.shoots_old && ceduo_derive_known(d, "%s.growth.shoots_young", path))
        ceduo_derive_refuse(d, path, ".growth.shoots_young", _("%s is below shoots_old, %s: shoots only become fewer"),
                            s->growth.shoots_young, s->growth.shoots_old);
    if (s->system == CEDUO_BARE && ceduo_stand_has_stems(s))
        ceduo_derive_refuse(d, path, ".system", _("'bare', but there are stems; name the system or remove them"), 0, 0);
    check_densities(d, path, s);
    check_spreads(d, path, "shoots", s->shoots, s->shoots_count);
    check_spreads(d, path, "trees", s->trees, s->trees_count);
    check_low(d, path, s);
    if (!ceduo_derive_known(d, "%s.stools.per_ha", path) || !ceduo_derive_known(d, "%s.shoots", path))
        return;
    if (s->stools_per_ha > 0 && ceduo_stand_shoots(s) / s->stools_per_ha > SHOOTS_MOST)
        ceduo_derive_refuse(d, path, ".shoots", _("%s shoots on each stool are more than the %s that can be drawn"),
                            ceduo_stand_shoots(s) / s->stools_per_ha, SHOOTS_MOST);
    if (ceduo_stand_has_shoots(s) && !(s->stools_per_ha > 0))
        ceduo_derive_refuse(d, path, ".shoots", _("shoots without stools; add 'stools: {per_ha: …, spacing_m: …}'"), 0, 0);
    else if (s->shoots_count == 0 && s->stools_per_ha > 0 && !ceduo_stand_sprouts(s))
        ceduo_derive_refuse(d, path, ".stools",
                            _("stools without shoots; add 'shoots', or 'growth' if they were just cut, or remove the "
                              "stools"),
                            0, 0);
    else if (ceduo_stand_has_shoots(s) && ceduo_stand_shoots(s) < s->stools_per_ha * (1 - 1e-12)) /* .4 and .6 per stool */
        ceduo_derive_refuse(d, path, ".stools.per_ha", _("%s shoots on %s stools: a stool has one shoot at least"),
                            ceduo_stand_shoots(s), s->stools_per_ha);
}

static void check_belt(struct deriver *d, const char *path, const struct ceduo_belt *f, const struct ceduo_belt *before)
{
    const struct ceduo_slope *s = &d->draft.scene.slope;
    double begin = d->profile ? d->origin : -INFINITY, end = d->profile ? s->x[s->vertices - 1] + d->origin : INFINITY;
    if (f->to_given <= f->from_given) {
        ceduo_derive_refuse(d, path, ".to_m", _("%s does not lie beyond from_m, %s"), f->to_given, f->from_given);
        return;
    }
    if (before && f->from_given < before->to_given)
        ceduo_derive_refuse(d, path, ".from_m", _("%s lies before the end of the belt before it, %s; belts must not overlap"),
                            f->from_given, before->to_given);
    else if (f->from_given < begin)
        ceduo_derive_refuse(d, path, ".from_m", _("%s lies before the slope, which begins at %s m"), f->from_given, begin);
    if (f->to_given > end)
        ceduo_derive_refuse(d, path, ".to_m", _("%s lies beyond the slope, which ends at %s m"), f->to_given, end);
}

/* Whether two stands say the same but for name and source. */
static bool says_the_same(struct deriver *d, const struct node *a, const struct node *b)
{
    static const char *const beside[] = {"name", "source"};
    for (size_t i = 0; a && b && i < 2; i++) {
        a = ceduo_node_get(a, beside[i]) ? ceduo_node_without(d->arena, a, beside[i]) : a;
        b = ceduo_node_get(b, beside[i]) ? ceduo_node_without(d->arena, b, beside[i]) : b;
    }
    if (!a || !b)
        ceduo_problem_memory(d->problems);
    return a && b && ceduo_node_equal(a, b);
}

/* Whether numbers of a stand from a file were changed, and it still has the name of that file. */
static bool has_name_of_another(struct deriver *d, const struct node *stand)
{
    const struct node *written = stand->written, *followed = stand->followed; /* there or not together */
    if (!written || stand->kind != NODE_MAP)
        return false;
    const char *name = ceduo_node_text(stand, "name"), *before = ceduo_node_text(followed, "name");
    bool renamed = !name || !before || strcmp(name, before) != 0 || ceduo_node_text(written, "name");
    if (renamed)
        return false;
    size_t changes = 0;
    for (size_t i = 0; written->kind == NODE_MAP && i < written->n; i++)
        changes += strcmp(written->items[i]->key, "base") != 0 && strcmp(written->items[i]->key, "source") != 0;
    return changes > 0 || !says_the_same(d, stand, followed);
}

/* What the stand calls itself, or else its file. `changed`: it is no longer what its name says. */
static const char *stand_name(struct deriver *d, const char *path, const struct ceduo_stand *stand, bool *changed)
{
    const char *within;
    size_t used;
    const struct node *node = ceduo_resolve_walk(d->root, path, &within, &used);
    const char *name = ceduo_node_text(node, "name");
    if (!name && node->written && node->written->kind == NODE_SCALAR)
        name = node->written->text;
    *changed = name && has_name_of_another(d, node);
    if (*changed)
        return ceduo_derive_text(d, "%s (changed)", name);
    return name ? name : ceduo_stand_is_bare(stand) ? "bare" : "stand";
}

static void derive_belts(struct deriver *d, const char *path, struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++) {
        struct ceduo_belt *belt = &option->belts[i];
        const char *here = ceduo_derive_text(d, "%s[%zu]", path, i), *stand = ceduo_derive_text(d, "%s.stand", here);
        check_belt(d, here, belt, i > 0 ? belt - 1 : NULL);
        belt->from = belt->from_given - d->origin;
        belt->to = belt->to_given - d->origin;
        belt->name = (char *)(uintptr_t)stand_name(d, stand, &belt->stand, &belt->changed);
        belt->assumed = ceduo_notes_assume(d->notes, stand);
        derive_stand(d, stand, &belt->stand);
    }
}

/* A scene without options has one, its forest. */
static void derive_forest(struct deriver *d)
{
    struct ceduo_scene *scene = &d->draft.scene;
    if (!(scene->options = ceduo_bind_take(d->arena, 1, sizeof *scene->options, d->problems)))
        return;
    scene->options[0] = (struct ceduo_option){
        .name = (char *)(uintptr_t) "current", .belts_count = d->draft.belts_count, .belts = d->draft.belts};
    scene->options_count = 1;
    derive_belts(d, "forest", &scene->options[0]);
}

void ceduo_derive_options(struct deriver *d)
{
    struct ceduo_scene *scene = &d->draft.scene;
    bool many = ceduo_node_get(d->root, "options") != NULL;
    size_t n = scene->options_count;
    scene->options_count = 0;
    if (many && ceduo_node_get(d->root, "forest")) {
        ceduo_derive_complain(d, "forest", _("options already say this; keep one of the two"));
        return;
    }
    if (!ceduo_derive_known(d, "options"))
        return;
    if (many && n == 0)
        ceduo_derive_complain(d, "options", _("the list is empty"));
    if (!many)
        derive_forest(d);
    if (n == 0 || ceduo_derive_too_many(d, "options", n))
        return;
    for (size_t i = 0; i < n; i++) {
        const char *name = scene->options[i].name;
        for (size_t k = 0; name && k < i; k++)
            if (scene->options[k].name && strcmp(scene->options[k].name, name) == 0)
                ceduo_derive_complain(d, ceduo_derive_text(d, "options[%zu].name", i),
                                      _("'%s' is given twice; names must differ"), name);
        derive_belts(d, ceduo_derive_text(d, "options[%zu].forest", i), &scene->options[i]);
    }
    scene->options_count = n;
}
