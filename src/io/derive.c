/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "derive.h"

#include <math.h>
#include <string.h>

#include "base/language.h"
#include "resolve.h"

void ceduo_derive_complain(struct deriver *d, const char *path, const char *format, ...)
{
    const char *within;
    size_t used;
    const struct node *node = ceduo_resolve_walk(d->root, path, &within, &used);
    va_list args;
    va_start(args, format);
    ceduo_problem_v(d->problems, node->source, node->line, node->column, within, format, args);
    va_end(args);
}

void ceduo_derive_refuse(struct deriver *d, const char *path, const char *within, const char *format, double x, double y)
{
    char room[CEDUO_NUMBER_ROOM];
    struct text message = {0};
    const char *in;
    size_t used;
    const struct node *node = ceduo_resolve_walk(d->root, ceduo_derive_text(d, "%s%s", path, within), &in, &used);
    for (; *format; format++)
        if (strncmp(format, "%s", 2) != 0) {
            ceduo_text_char(&message, *format);
        } else {
            ceduo_text_put(&message, node->source->foreign ? "\xe2\x80\xa6" : ceduo_number_shortest(x, room));
            x = y;
            format++;
        }
    ceduo_problem_own(d->problems, node->source, node->line, node->column, in, "%s", ceduo_text_string(&message));
    d->problems->memory |= message.failed;
    ceduo_text_free(&message);
}

const char *ceduo_derive_text(struct deriver *d, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const char *text = ceduo_arena_vformat(d->arena, format, args);
    va_end(args);
    if (!text)
        ceduo_problem_memory(d->problems);
    return text ? text : "";
}

bool ceduo_derive_known(struct deriver *d, const char *format, ...)
{
    struct text path = {0};
    va_list args;
    va_start(args, format);
    if (d->bad.n > 0)
        ceduo_text_vformat(&path, format, args);
    va_end(args);
    bool good = !path.failed;
    for (size_t i = 0; good && i < d->bad.n; i++)
        good = !ceduo_path_leads_to(d->bad.paths[i], path.bytes);
    d->problems->memory |= path.failed;
    ceduo_text_free(&path);
    return good;
}

bool ceduo_derive_sound(struct deriver *d, const char *path)
{
    for (size_t i = 0; i < d->bad.n; i++)
        if (ceduo_path_leads_to(path, d->bad.paths[i]))
            return false;
    return ceduo_derive_known(d, "%s", path);
}

bool ceduo_derive_given(struct deriver *d, const char *group, const char *key)
{
    return ceduo_node_get(ceduo_node_get(d->root, group), key) || !ceduo_derive_known(d, "%s.%s", group, key);
}

void ceduo_derive_assume(struct deriver *d, const char *path, const char *text)
{
    struct source_note *note = ceduo_arena_take(d->arena, sizeof *note);
    if (!note) {
        ceduo_problem_memory(d->problems);
        return;
    }
    *note = (struct source_note){.path = path, .kind = "assumed", .text = text, .before = d->notes, .made = true};
    d->notes = note;
}

bool ceduo_derive_too_many(struct deriver *d, const char *path, size_t n)
{
    if (n > CEDUO_ITEMS_MOST)
        ceduo_derive_complain(d, path, _("%zu items; at most %d can be computed"), n, CEDUO_ITEMS_MOST);
    return n > CEDUO_ITEMS_MOST;
}

/* ---- rock ---- */

/* What each shape is given by, and how that is written. A sphere has one of its keys, the others have all. */
static const struct {
    const char *keys[4], *example;
} shapes[] = {[CEDUO_SPHERE] = {{"diameter_m", "volume_m3", "mass_kg"}, "diameter_m: 1"},
              [CEDUO_CYLINDER] = {{"diameter_m", "height_m"}, "diameter_m: 1, height_m: 1"},
              [CEDUO_ELLIPSOID] = {{"axes_m"}, "axes_m: [1, 1, 1]"},
              [CEDUO_BLOCK] = {{"axes_m"}, "axes_m: [1, 1, 1]"}};

static bool belongs_to(enum ceduo_shape shape, const char *key)
{
    for (size_t i = 0; shapes[shape].keys[i]; i++)
        if (strcmp(shapes[shape].keys[i], key) == 0)
            return true;
    return false;
}

/* A rock and where it stands: the scene's, or that of something seen. */
struct rock_place {
    const char *path;
    const struct node *node;
};

static bool is_given(struct deriver *d, const struct rock_place *rock, const char *key)
{
    return ceduo_node_get(rock->node, key) || !ceduo_derive_known(d, "%s.%s", rock->path, key);
}

static void refuse_other_sizes(struct deriver *d, const struct rock_place *rock, enum ceduo_shape shape)
{
    static const char *const sizes[] = {"diameter_m", "height_m", "axes_m", "volume_m3"};
    const struct node *said = ceduo_node_get(rock->node, "shape");
    const char *name = ceduo_shape_words.names[shape];
    for (size_t i = 0; i < 4; i++) {
        if (belongs_to(shape, sizes[i]) || !ceduo_node_get(rock->node, sizes[i]))
            continue;
        const char *path = ceduo_derive_text(d, "%s.%s", rock->path, sizes[i]);
        if (said && said->source->is_option) /* nothing of the file can be taken out there */
            ceduo_derive_complain(d, path,
                                  _("does not belong to the shape '%s'; give the whole rock: -s 'rock={shape: %s, %s}'"), name,
                                  name, shapes[shape].example);
        else
            ceduo_derive_complain(d, path, _("does not belong to the shape '%s'; remove it"), name);
    }
}

static void check_sizes(struct deriver *d, const struct rock_place *rock, enum ceduo_shape shape)
{
    int n = 0;
    refuse_other_sizes(d, rock, shape);
    for (size_t i = 0; shapes[shape].keys[i]; i++) {
        bool given = is_given(d, rock, shapes[shape].keys[i]);
        n += given;
        if (!given && shape != CEDUO_SPHERE)
            ceduo_derive_complain(d, rock->path, _("'%s' is missing: the shape '%s' needs it"), shapes[shape].keys[i],
                                  ceduo_shape_words.names[shape]);
    }
    if (shape == CEDUO_SPHERE && n != 1)
        ceduo_derive_complain(d, rock->path,
                              _("a sphere is given by one of diameter_m, volume_m3 and mass_kg, here %d are given"), n);
    if (shape != CEDUO_SPHERE && ceduo_node_get(rock->node, "mass_kg") && ceduo_node_get(rock->node, "density_kg_m3"))
        ceduo_derive_complain(d, ceduo_derive_text(d, "%s.density_kg_m3", rock->path),
                              _("mass_kg already says this; keep one of the two"));
}

void ceduo_derive_rock(struct deriver *d, const char *path, const struct node *node, const struct ceduo_rock_def *def)
{
    size_t before = d->problems->met;
    const struct rock_place place = {path, node};
    if (!ceduo_derive_known(d, "%s.shape", path))
        return;
    check_sizes(d, &place, def->shape);
    bool by_mass = def->shape != CEDUO_SPHERE && is_given(d, &place, "mass_kg");
    bool of_scene = strcmp(path, "rock") == 0;
    if (of_scene && !is_given(d, &place, "density_kg_m3") && !by_mass)
        ceduo_derive_assume(d, "rock.density_kg_m3",
                            ceduo_derive_text(d, _("density of limestone, %g kg/m3"), ceduo_scene_default().rock.density.mean));
    struct ceduo_rock rock;
    if (before == d->problems->met && ceduo_derive_sound(d, path) && ceduo_rock_of_means(def, &rock) != CEDUO_OK)
        ceduo_derive_complain(d, path, _("the rock is too small or too large to compute"));
}

/* ---- rules ---- */

static void check_item(struct deriver *d, const char *list, size_t i, const struct ceduo_regulation_item *item)
{
    const char *at = ceduo_derive_text(d, "rules.%s[%zu]", list, i);
    struct text all = {0};
    if (!ceduo_derive_sound(d, at))
        return;
    if (item->most < item->least)
        ceduo_derive_complain(d, at, _("what is asked for at most is less than what is asked for at least"));
    ceduo_text_words(&all, ceduo_species_words.names, ceduo_species_words.n, ", ");
    for (size_t k = 0; k < item->species_count; k++)
        if (ceduo_species_find(item->species[k]) < 0)
            ceduo_derive_complain(d, ceduo_derive_text(d, "%s.species[%zu]", at, k), _("'%s' is unknown; one of: %s"),
                                  item->species[k], ceduo_text_string(&all));
    d->problems->memory |= all.failed;
    ceduo_text_free(&all);
}

static void derive_rules(struct deriver *d)
{
    const struct ceduo_regulation *r = &d->draft.scene.rules;
    for (size_t i = 0; i < r->standards_count; i++)
        check_item(d, "standards", i, &r->standards[i]);
    for (size_t i = 0; i < r->turns_count; i++)
        check_item(d, "turns", i, &r->turns[i]);
}

/* From which diameter on stems count is assumed where a forest is asked about and nobody says it. */
static void assume_counted(struct deriver *d)
{
    const struct ceduo_scene *scene = &d->draft.scene;
    bool forest = false;
    for (size_t i = 0; i < scene->options_count; i++)
        forest |= scene->options[i].belts_count > 0;
    if (forest && !ceduo_node_get(ceduo_node_get(d->root, "simulation"), "contact_dbh_m"))
        ceduo_derive_assume(d, "simulation.contact_dbh_m",
                            ceduo_derive_text(d, _("stems count from %g cm on, at which coppice is callipered"),
                                              scene->simulation.contact_dbh * 100));
}

bool ceduo_derive(struct deriver *d)
{
    ceduo_schema_init(ceduo_schema_scene(), &d->draft);
    ceduo_observed_arrange(d);
    ceduo_bind(d->arena, ceduo_schema_scene(), d->root, &d->draft, d->problems, &d->notes, &d->bad);
    if (d->bad.n > CEDUO_BAD_MOST || d->problems->memory)
        return false;
    ceduo_derive_rock(d, "rock", ceduo_node_get(d->root, "rock"), &d->draft.scene.rock);
    ceduo_derive_blocks(d);
    ceduo_derive_slope(d);
    ceduo_derive_release(d, "release", &d->draft.scene.release);
    ceduo_derive_controls(d);
    ceduo_derive_options(d);
    assume_counted(d);
    derive_rules(d);
    ceduo_derive_doubts(d);
    ceduo_derive_observed(d);
    return true;
}
