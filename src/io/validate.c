/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "validator.h"

#include "base/language.h"

static void check_rules(struct validator *v, const char *list, const struct ceduo_regulation_item *items, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const char *path = ceduo_format(v, "rules.%s[%zu]", list, i);
        if (!ceduo_is_sound(v, path))
            continue;
        if (items[i].most < items[i].least)
            ceduo_complain(v, path, "", _("what is asked for at most is less than what is asked for at least"));
        for (size_t k = 0; k < items[i].species_count; k++)
            if (ceduo_species_find(items[i].species[k]) < 0)
                ceduo_complain(v, ceduo_format(v, "%s.species[%zu]", path, k), "", _("'%s' is unknown; one of: %s"),
                               items[i].species[k], ceduo_words(v, &ceduo_species_words));
    }
}

bool ceduo_validate(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    size_t before = v->problems->met;
    ceduo_schema_init(ceduo_schema_scene(), &v->draft);
    ceduo_arrange_observed(v);
    const struct binding to = {v->arena, v->problems, v->unusual, v->notes, &v->bad, ceduo_validate_end, v};
    ceduo_bind(&to, ceduo_schema_scene(), v->root, &v->draft);
    if (v->bad.n > CEDUO_BAD_MOST || v->arena->failed)
        return false;
    ceduo_validate_rock(v, "rock", &scene->rock);
    ceduo_validate_blocks(v);
    ceduo_validate_slope(v);
    ceduo_validate_release(v, "release", &scene->release);
    ceduo_simplify_slope(v);
    ceduo_validate_controls(v);
    ceduo_validate_options(v);
    bool forest = false;
    for (size_t i = 0; i < scene->options_count; i++)
        forest |= scene->options[i].belts_count > 0;
    if (forest && !ceduo_node_get(ceduo_node_get(v->root, "simulation"), "contact_dbh_m"))
        ceduo_assume(v, "simulation.contact_dbh_m",
                     ceduo_format(v, _("stems count from %g cm on, at which coppice is callipered"),
                                  scene->simulation.contact_dbh * 100));
    check_rules(v, "standards", scene->rules.standards, scene->rules.standards_count);
    check_rules(v, "turns", scene->rules.turns, scene->rules.turns_count);
    ceduo_validate_doubt(v);
    if (v->problems->met == before && v->bad.n == 0)
        ceduo_validate_ends(v);
    ceduo_validate_observed(v);
    return true;
}
