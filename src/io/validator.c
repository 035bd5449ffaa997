/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "validator.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

struct problem_place ceduo_find_place(struct validator *v, const char *path, const char *key)
{
    const char *file_path;
    size_t used;
    const struct node *node =
        ceduo_resolve_walk(v->root, key[0] ? ceduo_asprintf(v, "%s.%s", path, key) : path, &file_path, &used);
    return ceduo_node_place(node, file_path);
}

bool ceduo_reject(struct validator *v, const char *path, const char *key, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    ceduo_problem_v(v->problems, ceduo_find_place(v, path, key), format, args);
    va_end(args);
    return false;
}

void ceduo_warn(struct validator *v, const char *path, const char *key, const char *format, ...)
{
    struct problem_place place = ceduo_find_place(v, path, key);
    place.unusual = true;
    va_list args;
    va_start(args, format);
    ceduo_problem_v(v->problems, place, format, args);
    va_end(args);
}

const char *ceduo_asprintf(struct validator *v, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const char *text = ceduo_arena_vformat(v->arena, format, args);
    va_end(args);
    return text ? text : "";
}

const char *ceduo_list_choices(struct validator *v, const struct choices *choices)
{
    LOCAL_TEXT(words);
    ceduo_text_join(&words, choices->names, choices->n, ", ");
    return ceduo_asprintf(v, "%s", ceduo_text_string(&words));
}

const char *ceduo_describe_range(struct validator *v, const struct field *field)
{
    LOCAL_TEXT(range);
    ceduo_schema_range_text(field, &range);
    return ceduo_asprintf(v, "%s", ceduo_text_string(&range));
}

void *ceduo_alloc(struct validator *v, size_t n, size_t size)
{
    return ceduo_arena_alloc(v->arena, (n + 1) * size);
}

bool ceduo_is_valid(struct validator *v, const char *format, ...)
{
    LOCAL_TEXT(path);
    va_list args;
    va_start(args, format);
    if (v->invalid.n > 0)
        ceduo_text_vformat(&path, format, args);
    va_end(args);
    bool good = true;
    for (size_t i = 0; good && i < v->invalid.n; i++)
        good = !ceduo_path_leads_to(v->invalid.paths[i], ceduo_text_string(&path));
    return good;
}

bool ceduo_is_valid_below(struct validator *v, const char *path)
{
    for (size_t i = 0; i < v->invalid.n; i++)
        if (ceduo_path_leads_to(path, v->invalid.paths[i]))
            return false;
    return ceduo_is_valid(v, "%s", path);
}

bool ceduo_is_given(struct validator *v, const char *path, const char *key)
{
    const char *child = ceduo_asprintf(v, "%s.%s", path, key);
    return ceduo_resolve_at(v->root, child) || !ceduo_is_valid(v, "%s", child);
}

static void add_note(struct validator *v, const char *path, const char *kind, const char *text)
{
    struct source_note *added = ceduo_alloc(v, 0, sizeof *added);
    if (!added)
        return;
    *added = (struct source_note){.path = path, .kind = kind, .text = text, .before = *v->notes, .made = true};
    *v->notes = added;
}

void ceduo_assume(struct validator *v, const char *path, const char *text)
{
    add_note(v, path, "assumed", text);
}

void ceduo_add_table_note(struct validator *v, const char *path, const char *line)
{
    add_note(v, path, CEDUO_NOTE_TABLE, ceduo_asprintf(v, "%s", line));
}

bool ceduo_is_too_long(struct validator *v, const char *path, size_t n)
{
    if (n > CEDUO_ITEMS_MAX)
        ceduo_reject(v, path, "", _("%zu items; at most %d can be computed"), n, CEDUO_ITEMS_MAX);
    return n > CEDUO_ITEMS_MAX;
}

void ceduo_check_name(struct validator *v, const char *list, size_t i, const char *name, const char *earlier)
{
    if (name && earlier && strcmp(name, earlier) == 0)
        ceduo_reject(v, ceduo_asprintf(v, "%s[%zu]", list, i), "name", _("'%s' is given twice"), name);
}

bool ceduo_check_on_slope(struct validator *v, const char *path, const char *key, double x)
{
    const struct ceduo_slope *s = &v->draft.scene.slope;
    double end = v->has_profile ? s->x[s->vertices - 1] + v->origin : INFINITY;
    return !v->has_profile || !(x < v->origin || x > end) ||
           /* untaken: complaint */
           ceduo_reject(v, path, key, _("%s lies outside the slope, which goes from %s to %s m"), ROUNDTRIP(x),
                        ROUNDTRIP(v->origin), ROUNDTRIP(end));
}

bool ceduo_check_order(struct validator *v, const char *path, double from, double to)
{
    return !(to <= from) ||
           /* untaken: complaint */
           ceduo_reject(v, path, "to_m", _("the end (%s) must lie beyond the start (%s)"), ROUNDTRIP(to), ROUNDTRIP(from));
}

bool ceduo_check_stretch(struct validator *v, const char *path, double from, double to)
{
    if (!ceduo_check_order(v, path, from, to))
        return false;
    bool begins = ceduo_check_on_slope(v, path, "from_m", from), ends = ceduo_check_on_slope(v, path, "to_m", to);
    return begins && ends; /* report both */
}

/* ---- the child ---- */

static void check_rules(struct validator *v, const char *list, const struct ceduo_regulation_item *items, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const char *path = ceduo_asprintf(v, "rules.%s[%zu]", list, i);
        if (!ceduo_is_valid_below(v, path))
            continue;
        if (items[i].max < items[i].min)
            ceduo_reject(v, path, "", _("the maximum is below the minimum; correct one"));
        for (size_t k = 0; k < items[i].species_count; k++)
            if (ceduo_species_find(items[i].species[k]) < 0)
                ceduo_reject(v, ceduo_asprintf(v, "%s.species[%zu]", path, k), "", _("'%s' is unknown; one of: %s"),
                             items[i].species[k], ceduo_list_choices(v, &ceduo_species_words));
    }
}

static void check_years(struct validator *v)
{
    double first = v->draft.scene.year_first, last = v->draft.scene.year_last; /* NaN: not given, or invalid */
    if (last < first)
        ceduo_reject(v, "years", "last", _("the last year, %s, is before the first, %s; correct one"), ROUNDTRIP(last),
                     ROUNDTRIP(first));
}

bool ceduo_validate(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    size_t before = v->problems->met;
    ceduo_schema_init(ceduo_schema_scene(), &v->draft);
    scene->size = sizeof *scene;
    ceduo_arrange_observed(v);
    const struct binding to = {v->arena, v->problems, v->warns, v->notes, &v->invalid, ceduo_validate_end, v};
    ceduo_bind(&to, ceduo_schema_scene(), v->root, &v->draft);
    if (v->invalid.n > CEDUO_INVALID_MAX || v->arena->failed)
        return false;
    ceduo_validate_rock(v, "rock", &scene->rock);
    ceduo_validate_blocks(v);
    ceduo_validate_slope(v);
    ceduo_validate_releases(v);
    ceduo_simplify_slope(v);
    ceduo_validate_controls(v);
    ceduo_validate_options(v);
    check_years(v);
    bool forest = false;
    for (size_t i = 0; i < scene->options_count; i++)
        forest |= scene->options[i].belts_count > 0;
    if (forest && !ceduo_node_get(ceduo_node_get(v->root, "simulation"), "contact_dbh_m"))
        ceduo_assume(v, "simulation.contact_dbh_m",
                     ceduo_asprintf(v, _("stems count from %g cm on, at which coppice is callipered"),
                                    scene->simulation.contact_dbh * 100));
    check_rules(v, "standards", scene->rules.standards, scene->rules.standards_count);
    check_rules(v, "turns", scene->rules.turns, scene->rules.turns_count);
    ceduo_validate_uncertainty(v);
    if (v->problems->met == before && v->invalid.n == 0)
        ceduo_validate_ends(v);
    ceduo_validate_observed(v);
    return true;
}
