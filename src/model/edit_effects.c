/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Side effects of an edit: neighbours follow a border, assumed heights their diameter; conflicting values are removed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "core/stand/rotation.h"
#include "document.h"
#include "scene/rock.h"

/* A changed value and its side effects. */
struct follow {
    struct document *d;
    struct arena *arena; /* arena of the document */
    const char *path, *value;
    const char *list, *key; /* "forest" and "to_m" for "forest[1].to_m"; "": not in a list */
    size_t index;
    struct changes changes;
    struct text removed, filled, followed;
    struct text refused; /* reason; "": not refused */
};

/* Return a number with n digits as text, in the arena of the document. */
static const char *rounded(struct follow *f, double value, int digits)
{
    char buf[CEDUO_NUMBER_SIZE];
    snprintf(buf, sizeof buf, "%.*g", digits, value);
    return ceduo_arena_string(f->arena, ceduo_number_shortest(strtod(buf, NULL), buf));
}

/* ---- borders ---- */

static bool ends_in(const char *text, const char *end)
{
    size_t n = strlen(text), length = strlen(end);
    return n >= length && strcmp(text + n - length, end) == 0;
}

static void split_path(struct follow *f)
{
    const char *open = strrchr(f->path, '[');
    char *end = NULL;
    f->list = f->key = "";
    f->index = open ? strtoul(open + 1, &end, 10) : 0;
    if (!open || end == open + 1 || *end != ']')
        return;
    f->list = ceduo_arena_copy(f->arena, f->path, (size_t)(open - f->path));
    f->key = end[1] == '.' ? end + 2 : "";
}

/* Move the border of the neighbour with this border. */
static void follow_border(struct follow *f)
{
    double now = ceduo_document_read_place(f->d, f->value), old = ceduo_document_get_place(f->d, f->path);
    bool to = strcmp(f->key, "to_m") == 0;
    if (isnan(now) || !(ends_in(f->list, "forest") || ends_in(f->list, "slope.materials")) ||
        !(to || (strcmp(f->key, "from_m") == 0 && f->index > 0)))
        return;
    size_t neighbour = to ? f->index + 1 : f->index - 1;
    const char *border = ceduo_arena_format(f->arena, "%s[%zu].%s", f->list, neighbour, to ? "from_m" : "to_m");
    double neighbour_border = ceduo_document_get_place(f->d, border),
           end = ceduo_document_get_place(f->d, ceduo_arena_format(f->arena, "%s[%zu].%s", f->list, neighbour, f->key));
    bool overlaps = to ? neighbour_border < now : neighbour_border > now;
    if (isnan(neighbour_border) || (neighbour_border != old && !overlaps))
        return;
    if (to ? end <= now : end >= now)
        ceduo_text_format(&f->refused,
                          to ? _("the next item ends at %g m; delete it first")
                             : _("the previous item begins at %g m; delete it first"),
                          end);
    ceduo_changes_set(&f->changes, border, "%s",
                      f->value[0] == 'e' ? f->value : ROUNDTRIP(now)); /* keep the unit: distance from the end */
    ceduo_text_format(&f->followed, to ? _("the next item now begins at %s m") : _("the previous item now ends at %s m"),
                      ceduo_number_localize(ROUNDTRIP(now)));
}

/* Extend the ground to the end of the profile. */
static void extend_ground(struct follow *f)
{
    double now;
    const struct node *materials = ceduo_document_node(f->d, "slope.materials");
    const struct node *vertices = ceduo_document_node(f->d, "slope.vertices_m");
    if (!materials || materials->kind != NODE_LIST || materials->n == 0 || strcmp(f->list, "slope.vertices_m") != 0 ||
        sscanf(f->value, "[%lf", &now) != 1)
        return;
    if (f->index == 0)
        ceduo_changes_set(&f->changes, "slope.materials[0].from_m", "%s", ROUNDTRIP(now));
    else if (vertices && f->index + 1 == vertices->n)
        ceduo_changes_set(&f->changes, ceduo_arena_format(f->arena, "slope.materials[%zu].to_m", materials->n - 1), "%s",
                          ROUNDTRIP(now));
}

/* ---- stands ---- */

/* Scale an assumed height with its diameter, as both grow. */
static void follow_diameter(struct follow *f, const struct ceduo_curve *curve, const struct ceduo_stems *stems, double dbh)
{
    const char *height = ceduo_arena_format(f->arena, "%s[%zu].height_m", f->list, f->index);
    if (!ceduo_scene_assumes_value(&f->d->file, height) || dbh == stems->dbh)
        return;
    double taller = ceduo_curve_height(curve, dbh) / ceduo_curve_height(curve, stems->dbh);
    const char *written = rounded(f, taller > 0 ? stems->height * taller : stems->height, 3);
    if (taller > 0)
        ceduo_changes_add(&f->changes, CHANGE_KEEP_SOURCE, height, written);
    ceduo_text_format(&f->followed,
                      taller > 0 ? _("assumed height adjusted by the growth curve: %s m")
                                 : _("assumed height unchanged at %s m: the growth curve does not reach this diameter"),
                      ceduo_number_localize(ceduo_arena_string(f->arena, written)));
}

static void follow_stand(struct follow *f)
{
    double now;
    const struct ceduo_belt *belt = ceduo_input_belt(&f->d->file.scene, f->path);
    const struct ceduo_stand *s = belt ? &belt->stand : NULL;
    bool shoot = s && ends_in(f->list, "].stand.shoots") && f->index < s->shoots_count;
    bool tree = s && ends_in(f->list, "].stand.trees") && f->index < s->trees_count, cm = strcmp(f->key, "dbh_cm") == 0;
    if (ceduo_number_read(f->value, &now) != CEDUO_NUMBER_GOOD)
        now = NAN;
    if ((shoot || tree) && (cm || strcmp(f->key, "dbh_m") == 0))
        follow_diameter(f, shoot ? &s->growth.shoots : &s->growth.trees, shoot ? &s->shoots[f->index] : &s->trees[f->index],
                        cm ? now / 100 : now);
}

/* Surveys are assessed together or not at all: a missing one is assumed poor, which asks for more. */
static void follow_design(struct follow *f)
{
    static const char *const both[2] = {"design.survey", "design.blocks"};
    bool factor = strcmp(f->path, "design.gamma_e") == 0 && !ceduo_document_node(f->d, "design");
    for (int i = 0; i < 2; i++)
        if (factor || (strcmp(f->path, both[i]) == 0 && !ceduo_document_node(f->d, "design"))) {
            ceduo_changes_set(&f->changes, both[1 - i], "poor");
            ceduo_text_append(&f->followed, factor && i == 0 ? "" : _("the other survey is assumed to be poor"));
        }
}

/* A fence needs an energy and a height: the other one is assumed. */
static void follow_fence(struct follow *f)
{
    static const char *const keys[2] = {"fence.energy_kJ", "fence.height_m"}, *const values[2] = {"500", "4"};
    for (int i = 0; i < 2 && strcmp(f->list, "controls") == 0 && strncmp(f->key, "fence.", 6) == 0; i++) {
        const char *path = ceduo_arena_format(f->arena, "controls[%zu].%s", f->index, keys[i]);
        if (strcmp(f->key, keys[i]) == 0 || ceduo_document_node(f->d, path))
            continue;
        ceduo_changes_set(&f->changes, path, "%s", values[i]);
        ceduo_text_format(&f->followed,
                          i == 0 ? _("assumed energy of the fence: %s kJ") : _("assumed height of the fence: %s m"), values[i]);
    }
}

/* ---- conflicting values ---- */

/* Append the label of a value without its unit. */
static const struct field *append_label(struct text *text, const char *path)
{
    const struct field *field = ceduo_schema_at(path);
    const char *label = field ? _(field->shown.label) : strrchr(path, '.') + 1;
    ceduo_text_append(text, text->length ? ", " : "");
    ceduo_text_append_n(text, label, strcspn(label, ","));
    return field;
}

/* Remove an entry of a mapping if it exists. */
static void drop_entry(struct follow *f, const char *map, const char *key)
{
    const char *path = ceduo_arena_format(f->arena, "%s.%s", map, key);
    if (!ceduo_node_get(ceduo_document_node(f->d, map), key))
        return;
    ceduo_changes_add(&f->changes, CHANGE_DELETE, path, NULL);
    append_label(&f->removed, path);
}

static void fill_in(struct follow *f, const char *path, const char *value)
{
    ceduo_changes_set(&f->changes, path, "%s", value);
    const struct field *field = append_label(&f->filled, path);
    char *spoken = ceduo_arena_string(f->arena, value), *end = spoken;
    for (const char *from = value; *from; from++) /* show a list without commas, which look like decimal commas */
        if (!strchr("[],", *from))
            *end++ = *from;
    *end = '\0';
    ceduo_text_format(&f->filled, " %s %s", ceduo_number_localize(spoken), field ? field->unit : "");
}

/* ---- another shape ---- */

/* Replace the sizes so that the new shape keeps the volume. Ellipsoid and block have the same sizes. */
static void change_shape(struct follow *f, enum ceduo_shape shape)
{
    static const double full[] = {[CEDUO_SHAPE_SPHERE] = 6, [CEDUO_SHAPE_CYLINDER] = 4, [CEDUO_SHAPE_ELLIPSOID] = 6};
    const struct ceduo_rock_def *def = &f->d->file.scene.rock;
    bool cylinder = def->shape == CEDUO_SHAPE_CYLINDER, round = cylinder || def->shape == CEDUO_SHAPE_SPHERE;
    bool new_axes = shape == CEDUO_SHAPE_ELLIPSOID || shape == CEDUO_SHAPE_BLOCK, mass = !isnan(def->mass.mean);
    bool sized = false; /* blocks may give the size instead */
    static const char *const sizes[] = {"rock.diameter_m", "rock.height_m", "rock.volume_m3", "rock.mass_kg", "rock.axes_m"};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        sized |= ceduo_document_node(f->d, sizes[i]) != NULL;
    struct ceduo_rock rock;
    if (!sized || shape == def->shape || (!round && new_axes) || ceduo_rock_from_means(def, &rock) != CEDUO_OK)
        return;
    if (new_axes)
        drop_entry(f, "rock", "diameter_m");
    drop_entry(f, "rock", "volume_m3");
    if (shape != CEDUO_SHAPE_CYLINDER)
        drop_entry(f, "rock", "height_m");
    if (!new_axes)
        drop_entry(f, "rock", "axes_m");
    double s[3]; /* length, width, height: volume = their product times a factor of the shape */
    for (int i = 0; i < 3; i++)
        s[i] = !round ? def->axes[i].mean : !cylinder ? rock.mean_diameter : i < 2 ? def->diameter.mean : def->height.mean;
    double box = shape == CEDUO_SHAPE_BLOCK ? rock.volume : rock.volume * full[shape] / M_PI;
    double scale = cbrt(box / (s[0] * s[1] * s[2]));
    if (shape == CEDUO_SHAPE_SPHERE) {
        fill_in(f, "rock.diameter_m", rounded(f, cbrt(box), 3));
    } else if (shape == CEDUO_SHAPE_CYLINDER) {
        fill_in(f, "rock.diameter_m", rounded(f, scale * sqrt(s[0] * s[1]), 3));
        fill_in(f, "rock.height_m", rounded(f, scale * s[2], 3));
    } else {
        fill_in(f, "rock.axes_m",
                ceduo_arena_format(f->arena, "[%s, %s, %s]", rounded(f, scale * s[0], 3), rounded(f, scale * s[1], 3),
                                   rounded(f, scale * s[2], 3)));
    }
    if (shape == CEDUO_SHAPE_SPHERE && mass) { /* a sphere takes mass as a size */
        drop_entry(f, "rock", "mass_kg");
        fill_in(f, "rock.density_kg_m3", rounded(f, rock.mass / rock.volume, 4));
    } else if (mass) {
        drop_entry(f, "rock", "density_kg_m3");
    }
    if (fmax(def->diameter.spread, fmax(def->height.spread, def->volume.spread)) > 0 ||
        fmax(def->axes[0].spread, fmax(def->axes[1].spread, def->axes[2].spread)) > 0)
        ceduo_text_append_joined(&f->filled, " ", _("(means, without spread)"));
}

/* A cylinder that had its size from blocks needs both dimensions: copy the first one. */
static void follow_cylinder(struct follow *f)
{
    static const char *const keys[] = {"rock.diameter_m", "rock.height_m"};
    for (int i = 0; f->d->file.scene.rock.shape == CEDUO_SHAPE_CYLINDER && i < 2; i++)
        if (strcmp(f->path, keys[i]) == 0 && !ceduo_document_node(f->d, keys[1 - i])) {
            ceduo_changes_set(&f->changes, keys[1 - i], "%s", f->value);
            ceduo_text_append(&f->followed, _("diameter and height are now equal"));
        }
}

/* Scale the other shares of the releases so that all add up to 1. */
static void follow_share(struct follow *f)
{
    const struct ceduo_scene *scene = &f->d->file.scene;
    double now, remaining = 0;
    if (strcmp(f->list, "release") != 0 || strcmp(f->key, "share") != 0 || f->index >= scene->releases_count ||
        ceduo_number_read(f->value, &now) != CEDUO_NUMBER_GOOD || !(now > 0 && now < 1))
        return;
    for (size_t i = 0; i < scene->releases_count; i++)
        remaining += i == f->index ? 0 : scene->releases[i].share;
    for (size_t i = 0; i < scene->releases_count; i++)
        if (i != f->index)
            ceduo_changes_set(&f->changes, ceduo_arena_format(f->arena, "release[%zu].share", i), "%s",
                              rounded(f, scene->releases[i].share / remaining * (1 - now), 4));
    if (scene->releases_count > 1)
        ceduo_text_append(&f->followed, _("the other shares follow, so that all add up to 1"));
}

/* ---- alternatives ---- */

/* Remove the alternatives of a value: other sizes of the rock, or mass and density. */
static void keep_one_of_all(struct follow *f)
{
    static const char *const rock_keys[2][3] = {{"mass_kg", "density_kg_m3"}, {"diameter_m", "volume_m3", "mass_kg"}};
    bool sphere = f->d->file.scene.rock.shape == CEDUO_SHAPE_SPHERE, is_one = false; /* for a sphere, mass is a size */
    const char *dot = strrchr(f->path, '.'), *key = dot ? dot + 1 : f->path;
    const char *map = ceduo_arena_copy(f->arena, f->path, dot ? (size_t)(dot - f->path) : 0);
    const struct field *holder = ceduo_schema_row(map), *field = ceduo_schema_at(f->path);
    const char *alternative = holder && holder->object && field ? ceduo_schema_alternative(holder->object, key) : NULL;
    if (alternative && !ceduo_schema_unit(holder->object, field))
        drop_entry(f, map, alternative);
    for (size_t i = 0; strcmp(map, "rock") == 0 && i < 3 && rock_keys[sphere][i]; i++)
        is_one |= strcmp(rock_keys[sphere][i], key) == 0;
    for (size_t i = 0; is_one && i < 3 && rock_keys[sphere][i]; i++)
        if (strcmp(rock_keys[sphere][i], key) != 0)
            drop_entry(f, map, rock_keys[sphere][i]);
}

/* Remove the cut year of a belt whose stand is replaced. Return false if there is none. */
static bool drop_cut_year(struct follow *f)
{
    bool stand = strcmp(f->key, "stand") == 0 && ends_in(f->list, "forest");
    if (stand)
        drop_entry(f, ceduo_arena_format(f->arena, "%s[%zu]", f->list, f->index), "cut_year");
    return stand && f->removed.length > 0;
}

bool ceduo_document_set_and_follow(struct document *d, const char *path, const char *value, struct text *notes)
{
    struct follow f = {.d = d, .arena = &d->file.arena, .path = path, .value = value, .changes = {.document = d}};
    int shape = strcmp(path, "rock.shape") == 0 ? ceduo_choice_find(&ceduo_shape_words, value) : -1;
    ceduo_problems_free(&d->problems);
    split_path(&f);
    if (shape >= 0)
        change_shape(&f, (enum ceduo_shape)shape);
    else
        keep_one_of_all(&f);
    extend_ground(&f);
    follow_design(&f);
    follow_fence(&f);
    follow_cylinder(&f);
    follow_share(&f);
    follow_border(&f);
    follow_stand(&f);
    ceduo_changes_set(&f.changes, path, "%s", value);
    bool good = f.refused.length == 0 && ceduo_changes_apply(&f.changes, path);
    if (!good && f.refused.length == 0 && drop_cut_year(&f)) /* the new stand may have no cutting */
        good = ceduo_changes_apply(&f.changes, path);
    if (f.filled.length)
        ceduo_text_format(notes, _("set for the same volume: %s"), f.filled.bytes);
    if (f.removed.length)
        ceduo_text_format(notes, _("%sremoved: %s"), notes->length ? "; " : "", f.removed.bytes);
    if (f.followed.length)
        ceduo_text_format(notes, "%s%s", notes->length ? "; " : "", f.followed.bytes);
    if (f.refused.length > 0)
        ceduo_problem(&d->problems, &(struct source){.name = path, .is_option = true}, 0, 0, "%s", f.refused.bytes);
    ceduo_text_free(&f.filled);
    ceduo_text_free(&f.removed);
    ceduo_text_free(&f.followed);
    ceduo_text_free(&f.refused);
    return good;
}
