/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options, their belts and stands: checks that they fit together and lie on the slope. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "core/stand/rotation.h"
#include "scene/stand.h"
#include "validator.h"

#define SHOOTS_MAX 10000 /* on a stool */

/* Check that no spread exceeds its diameter: a wider spread is not one size class. */
static void check_spreads(struct validator *v, const char *path, const char *list, const struct ceduo_stems *stems, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (stems[i].dbh_sd > stems[i].dbh) /* false for unreadable values: NaN and 0 */
            ceduo_reject(v, ceduo_asprintf(v, "%s.%s[%zu]", path, list, i), "dbh_sd_m",
                         _("the spread, %s m, exceeds the diameter, %s m; split these stems into two entries"),
                         ROUNDTRIP(stems[i].dbh_sd), ROUNDTRIP(stems[i].dbh));
}

/* True if a required value is missing. An unreadable value is already reported. */
static bool is_missing(struct validator *v, double value, const char *path, const char *key)
{
    return isnan(value) && ceduo_is_valid(v, "%s%s", path, key);
}

/* Require every number of a mapping; there are no defaults. */
static void check_given(struct validator *v, const char *path, const struct field *group, const void *item)
{
    const struct object *object = group->object;
    for (const struct field *f = object->fields; f < object->fields + object->n; f++)
        if (f->type == FIELD_NUMBER && is_missing(v, *(const double *)(const void *)((const char *)item + f->offset), path,
                                                  ceduo_asprintf(v, ".%s.%s", group->key, f->key)))
            ceduo_reject(v, path, group->key, _("'%s' is missing; it has no default"), f->key);
}

/* True if a mapping has a key. */
static bool is_written(struct validator *v, const char *path, const char *key)
{
    return ceduo_resolve_at(v->root, ceduo_asprintf(v, "%s.%s", path, key)) != NULL;
}

/* Warn if a mapping has no `key`, the number without which its other values have no effect. */
static void warn_unused(struct validator *v, const char *path, const char *group, const char *key)
{
    if (is_written(v, path, group) && !is_written(v, ceduo_asprintf(v, "%s.%s", path, group), key))
        ceduo_warn(v, path, group, _("'%s' is missing, so the other values here have no effect; add it"), key);
}

/* Check stumps, logs and groups of trees, which have no defaults. */
static void check_low(struct validator *v, const char *path, const struct ceduo_stand *s)
{
    const struct object *stand = ceduo_schema_stand(), *trees = ceduo_schema_field(stand, "trees")->object;
    if (s->stumps.per_ha > 0)
        check_given(v, path, ceduo_schema_field(stand, "stumps"), &s->stumps);
    if (s->logs.per_ha > 0)
        check_given(v, path, ceduo_schema_field(stand, "logs"), &s->logs);
    warn_unused(v, path, "stumps", "per_ha");
    warn_unused(v, path, "logs", "per_ha");
    for (size_t i = 0; i < s->trees_count; i++) {
        const char *item_path = ceduo_asprintf(v, "%s.trees[%zu]", path, i);
        if (s->trees[i].group > 1)
            check_given(v, item_path, ceduo_schema_field(trees, "groups"), &s->trees[i]);
        warn_unused(v, item_path, "groups", "stems");
    }
}

/* Check the numbers of shoots on a growing stool: given if shoots grow, and not rising. */
static void check_sprouting(struct validator *v, const char *path, const struct ceduo_stand *s)
{
    const char *growth = ceduo_asprintf(v, "%s.growth", path);
    bool shoots_grow = s->stools_per_ha > 0 && is_written(v, growth, "shoots"), old = is_written(v, growth, "shoots_old");
    bool young = is_written(v, growth, "shoots_young");
    if (!young && (shoots_grow || old))
        ceduo_reject(v, path, "growth", _("'%s' is missing; it has no default"), "shoots_young");
    if (!old && shoots_grow)
        ceduo_reject(v, path, "growth", _("'%s' is missing; it has no default"), "shoots_old");
    if (young && s->growth.shoots_young < s->growth.shoots_old && ceduo_is_valid(v, "%s.shoots_young", growth))
        ceduo_reject(v, path, "growth.shoots_young", _("%s is below the number of old shoots, %s; shoots can only decrease"),
                     ROUNDTRIP(s->growth.shoots_young), ROUNDTRIP(s->growth.shoots_old));
}

/* True if all that decides about the cuts of a valid stand was read without an error. */
static bool is_cutting_read(struct validator *v, const char *belt, const char *stand, const struct ceduo_stand *s)
{
    static const char *const keys[] = {"growth", "cutting", "stools", "shoots", "trees"};
    bool good = ceduo_is_valid(v, "%s.cut_year", belt) && ceduo_is_valid(v, "%s", stand);
    for (size_t i = 0; good && i < sizeof keys / sizeof keys[0]; i++)
        good = ceduo_is_valid_below(v, ceduo_asprintf(v, "%s.%s", stand, keys[i]));
    bool counts = s->growth.shoots_old > 0 || !is_written(v, stand, "growth.shoots"); /* otherwise reported */
    return good && (counts || !(s->stools_per_ha > 0));
}

/* Check that the cuts of a belt can be computed. Only a stand that does not change at all may lack what they need. */
static void check_cuts(struct validator *v, const char *path, const char *stand, const struct ceduo_belt *belt)
{
    enum cut_lack lack = ceduo_cut_lack(&belt->stand, belt->cut_year);
    bool year = !isnan(belt->cut_year), growth = is_written(v, stand, "growth");
    bool stems = ceduo_stand_has_stems(&belt->stand) || belt->stand.stools_per_ha > 0;
    if (lack == CUT_LACKS_NOTHING || (lack == CUT_LACKS_CUTTING && !year) || !stems) /* a gap has nothing to cut */
        return;
    if (!is_cutting_read(v, path, stand, &belt->stand))
        return;
    if (lack == CUT_LACKS_CUTTING)
        ceduo_reject(v, path, "cut_year", _("the cut needs '%s' of the stand; add it, or remove '%s'"), "cutting", "cut_year");
    else if (!growth && year)
        ceduo_reject(v, path, "cut_year", _("the cut needs '%s' of the stand; add it, or remove '%s'"), "growth", "cut_year");
    else if (!growth)
        ceduo_warn(v, stand, "cutting", _("the stand is never cut, because it has no '%s'; add it for future years"), "growth");
    else if (lack == CUT_LACKS_AGE)
        ceduo_reject(v, stand, "cutting", _("the year of the first cut is unknown; give '%s', '%s' of the trees, or '%s'"),
                     "cut_year", "age_y", "growth.trees");
    else
        ceduo_reject(v, stand, "cutting", _("the cut needs '%s' of the stand; add it, or remove '%s'"),
                     lack == CUT_LACKS_SHOOTS ? "growth.shoots" : "growth.trees", "cutting");
}

static void check_stand(struct validator *v, const char *path, struct ceduo_stand *s)
{
    ceduo_stand_update_shoot_density(s);
    if ((int)s->system < 0)
        s->system = ceduo_stand_has_shoots(s)  ? CEDUO_SYSTEM_SIMPLE_COPPICE
                    : ceduo_stand_has_stems(s) ? CEDUO_SYSTEM_HIGH_FOREST
                                               : CEDUO_SYSTEM_BARE;
    if (!ceduo_is_valid(v, "%s", path)) /* its base is unreadable */
        return;
    check_sprouting(v, path, s);
    if (s->system == CEDUO_SYSTEM_BARE && ceduo_stand_has_stems(s))
        ceduo_reject(v, path, "system", _("'bare' has no stems; name the system, or remove the stems"));
    for (size_t i = 0; i < s->shoots_count; i++) { /* per_ha or per_stool is required */
        const char *item_path = ceduo_asprintf(v, "%s.shoots[%zu]", path, i);
        bool each = is_written(v, item_path, "per_stool");
        if (!each && is_missing(v, s->shoots[i].per_ha, item_path, ".per_ha") && ceduo_is_valid(v, "%s.per_stool", item_path))
            ceduo_reject(v, item_path, "", _("'per_ha' or 'per_stool' is missing; give the number of shoots"));
        else if (each && !is_written(v, path, "stools.per_ha") && ceduo_is_valid(v, "%s.stools.per_ha", path))
            ceduo_reject(v, path, "shoots", _("shoots without stools; add 'stools: {per_ha: …, spacing_m: …}'"));
    }
    check_spreads(v, path, "shoots", s->shoots, s->shoots_count);
    check_spreads(v, path, "trees", s->trees, s->trees_count);
    check_low(v, path, s);
    if (!ceduo_is_valid(v, "%s.stools.per_ha", path) || !ceduo_is_valid(v, "%s.shoots", path))
        return;
    if (s->stools_per_ha > 0 && ceduo_stand_shoots(s) / s->stools_per_ha > SHOOTS_MAX)
        ceduo_reject(v, path, "shoots", _("%s shoots on each stool are too many; the limit is %s"),
                     ROUNDTRIP(ceduo_stand_shoots(s) / s->stools_per_ha), ROUNDTRIP(SHOOTS_MAX));
    if (ceduo_stand_has_shoots(s) && !(s->stools_per_ha > 0))
        ceduo_reject(v, path, "shoots", _("shoots without stools; add 'stools: {per_ha: …, spacing_m: …}'"));
    else if (s->shoots_count == 0 && s->stools_per_ha > 0 && !ceduo_stand_sprouts(s))
        ceduo_reject(v, path, "stools",
                     _("stools without shoots; add 'shoots', or 'growth' if they were just cut, or remove the "
                       "stools"));
    else if (ceduo_stand_has_shoots(s) && ceduo_stand_shoots(s) < s->stools_per_ha * (1 - 1e-12)) /* .4 and .6 per stool */
        ceduo_reject(v, path, "stools.per_ha", _("%.6g shoots are too few for %.6g stools; each stool needs one"),
                     ceduo_stand_shoots(s), s->stools_per_ha);
}

/* Copy the part of a stand that its name describes: today's stems, without name, source, growth and cutting. */
static const struct node *copy_stems(struct validator *v, const struct node *stand)
{
    static const char *const ignored[] = {"name", "source", "growth", "cutting"};
    for (size_t i = 0; stand && i < sizeof ignored / sizeof ignored[0]; i++)
        stand = ceduo_node_without(v->arena, stand, ignored[i]);
    return stand;
}

/* False if a stand has the name of its file, but its stems differ from those of the file. */
static bool has_named_stand(struct validator *v, const struct node *stand)
{
    const struct node *written = stand->written, *followed = stand->followed; /* both NULL or both set */
    if (!written || stand->kind != NODE_MAP)
        return true;
    const char *name = ceduo_node_text(stand, "name"), *before = ceduo_node_text(followed, "name");
    if (!name || !before || strcmp(name, before) != 0 || ceduo_node_text(written, "name"))
        return true;
    const struct node *own = written->kind == NODE_MAP ? copy_stems(v, written) : NULL;
    if (own && own->n > 1) /* more than its base */
        return false;
    const struct node *a = copy_stems(v, stand), *b = copy_stems(v, followed);
    return !a || !b || ceduo_node_equal(a, b);
}

static void make_belts(struct validator *v, const char *path, struct ceduo_option *option)
{
    for (size_t i = 0; i < option->belts_count; i++) {
        struct ceduo_belt *belt = &option->belts[i];
        const char *item_path = ceduo_asprintf(v, "%s[%zu]", path, i), *stand = ceduo_asprintf(v, "%s.stand", item_path);
        const double from = belt->from_given, to = belt->to_given, before = i > 0 ? belt[-1].to_given : -INFINITY;
        if (ceduo_check_stretch(v, item_path, from, to) && from < before)
            ceduo_reject(v, item_path, "from_m",
                         _("belts must not overlap, but this one begins at %s and the previous one ends at %s"),
                         ROUNDTRIP(from), ROUNDTRIP(before));
        belt->from = belt->from_given - v->origin;
        belt->to = belt->to_given - v->origin;
        const struct node *node = ceduo_resolve_at(v->root, stand);
        const char *name = ceduo_node_text(node, "name"); /* otherwise the name of the file */
        if (!name && node && node->written && node->written->kind == NODE_SCALAR)
            name = node->written->text;
        belt->changed = name && !has_named_stand(v, node);
        const char *shown = ceduo_in_language(name, ceduo_node_text(node, "name_it")), *plain = N_("stand");
        if (!name)
            shown = _(name = ceduo_stand_is_bare(&belt->stand) ? N_("bare") : plain);
        belt->name_given = (char *)(uintptr_t)(belt->changed ? ceduo_asprintf(v, "%s (changed)", name) : name);
        belt->name = (char *)(uintptr_t)(belt->changed ? ceduo_asprintf(v, _("%s (changed)"), shown) : shown);
        belt->assumed = ceduo_notes_print(*v->notes, "assumed", stand);
        check_stand(v, stand, &belt->stand);
        check_cuts(v, item_path, stand, belt);
    }
}

void ceduo_validate_options(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    bool many = ceduo_node_get(v->root, "options") != NULL;
    size_t n = scene->options_count;
    scene->options_count = 0;
    if (!ceduo_is_valid(v, "options"))
        return;
    if (many && n == 0)
        ceduo_reject(v, "options", "", _("the list is empty"));
    if (!many && (scene->options = ceduo_alloc(v, 1, sizeof *scene->options))) { /* the forest becomes the only option */
        scene->options[0] = (struct ceduo_option){
            .name_given = (char *)(uintptr_t)N_("current"), .belts_count = v->draft.belts_count, .belts = v->draft.belts};
        scene->options[0].name = (char *)(uintptr_t)_(scene->options[0].name_given);
        scene->options_count = 1;
        make_belts(v, "forest", &scene->options[0]);
    }
    if (n == 0 || ceduo_is_too_long(v, "options", n))
        return;
    for (size_t i = 0; i < n; i++) {
        struct ceduo_option *o = &scene->options[i];
        for (size_t k = 0; k < i; k++)
            ceduo_check_name(v, "options", i, o->name_given, scene->options[k].name_given);
        o->name = (char *)(uintptr_t)ceduo_in_language(o->name_given, o->name);
        make_belts(v, ceduo_asprintf(v, "options[%zu].forest", i), &scene->options[i]);
    }
    scene->options_count = n;
}
