/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "changes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"

/* What people call a value: its label without the unit. */
static const struct field *put_name(struct text *text, const char *map, const char *key)
{
    char path[512];
    snprintf(path, sizeof path, "%.400s.%.60s", map, key);
    const struct field *f = ceduo_schema_at(path);
    const char *label = f ? _(f->shown.label) : key;
    ceduo_text_add(text, label, strcspn(label, ","));
    return f;
}

/* Takes an entry of a mapping out, if it is there. */
static void take_out(struct changes *c, const char *map, const char *key)
{
    if (!ceduo_node_get(ceduo_document_node(c->d, map), key))
        return;
    ceduo_changes_add(c, "%s.%s", map, key);
    ceduo_text_put(&c->taken, c->taken.length ? ", " : "");
    put_name(&c->taken, map, key);
}

static void fill_in(struct changes *c, const char *key, const char *value)
{
    ceduo_changes_add(c, "rock.%s=%s", key, value);
    ceduo_text_put(&c->filled, c->filled.length ? ", " : "");
    const struct field *f = put_name(&c->filled, "rock", key);
    ceduo_text_format(&c->filled, " %s %s", value, f ? f->unit : "");
}

/* ---- another shape ---- */

static void fill_sizes(struct changes *c, enum ceduo_shape shape, const struct ceduo_rock *rock)
{
    static const double full[] = {[CEDUO_SPHERE] = 6, [CEDUO_CYLINDER] = 4, [CEDUO_ELLIPSOID] = 6};
    const struct ceduo_rock_def *def = &c->d->file.scene.rock;
    bool cylinder = def->shape == CEDUO_CYLINDER, round = cylinder || def->shape == CEDUO_SPHERE;
    double s[3]; /* length, width, height: a volume is that of a box of these times a number of the shape */
    char a[CEDUO_NUMBER_ROOM], b[CEDUO_NUMBER_ROOM], third[CEDUO_NUMBER_ROOM], all[3 * CEDUO_NUMBER_ROOM + 8];
    for (int i = 0; i < 3; i++)
        s[i] = !round ? def->axes[i].mean : cylinder ? def->diameter.mean : rock->mean_diameter;
    s[2] = cylinder ? def->height.mean : s[2];
    double box = shape == CEDUO_BLOCK ? rock->volume : rock->volume * full[shape] / M_PI;
    double scale = cbrt(box / (s[0] * s[1] * s[2]));
    if (shape == CEDUO_SPHERE) {
        fill_in(c, "diameter_m", ceduo_changes_rounded(cbrt(box), 3, a));
    } else if (shape == CEDUO_CYLINDER) {
        fill_in(c, "diameter_m", ceduo_changes_rounded(scale * sqrt(s[0] * s[1]), 3, a));
        fill_in(c, "height_m", ceduo_changes_rounded(scale * s[2], 3, b));
    } else {
        snprintf(all, sizeof all, "[%s, %s, %s]", ceduo_changes_rounded(scale * s[0], 3, a),
                 ceduo_changes_rounded(scale * s[1], 3, b), ceduo_changes_rounded(scale * s[2], 3, third));
        fill_in(c, "axes_m", all);
    }
}

/* Ellipsoid and block have the same sizes: then there is nothing to do. */
static void change_shape(struct changes *c, enum ceduo_shape shape)
{
    static const char *const sizes[] = {"diameter_m", "volume_m3", "height_m", "axes_m"};
    const struct ceduo_rock_def *def = &c->d->file.scene.rock;
    bool axes_now = def->shape == CEDUO_ELLIPSOID || def->shape == CEDUO_BLOCK;
    bool axes_then = shape == CEDUO_ELLIPSOID || shape == CEDUO_BLOCK;
    struct ceduo_rock rock;
    char room[CEDUO_NUMBER_ROOM];
    if (shape == def->shape || (axes_now && axes_then) || ceduo_rock_of_means(def, &rock) != CEDUO_OK)
        return;
    bool mass = !isnan(def->mass.mean);
    for (size_t i = 0; i < 4; i++) {
        bool stays = (strcmp(sizes[i], "diameter_m") == 0 && !axes_then) ||
                     (strcmp(sizes[i], "height_m") == 0 && shape == CEDUO_CYLINDER) ||
                     (strcmp(sizes[i], "axes_m") == 0 && axes_then);
        if (!stays)
            take_out(c, "rock", sizes[i]);
    }
    fill_sizes(c, shape, &rock);
    if (shape == CEDUO_SPHERE && mass) { /* where it would be a size */
        take_out(c, "rock", "mass_kg");
        fill_in(c, "density_kg_m3", ceduo_changes_rounded(rock.mass / rock.volume, 4, room));
    } else if (mass) {
        take_out(c, "rock", "density_kg_m3");
    }
    bool spread = def->diameter.spread > 0 || def->height.spread > 0 || def->volume.spread > 0;
    for (int i = 0; i < 3; i++)
        spread |= def->axes[i].spread > 0;
    if (spread)
        ceduo_text_then(&c->filled, " ", _("(means, without spread)"));
}

/* ---- one of several ---- */

/* Takes the others out where `key` is one of a group. */
static void keep_one(struct changes *c, const char *map, const char *key, const char *const *group)
{
    bool is_one = false;
    for (size_t i = 0; group[i]; i++)
        is_one |= strcmp(group[i], key) == 0;
    for (size_t i = 0; is_one && group[i]; i++)
        if (strcmp(group[i], key) != 0)
            take_out(c, map, group[i]);
}

static void keep_one_of_all(struct changes *c, const char *path)
{
    static const char *const sphere[] = {"diameter_m", "volume_m3", "mass_kg", NULL};
    static const char *const weight[] = {"mass_kg", "density_kg_m3", NULL};
    static const char *const shoots[] = {"per_ha", "per_stool", NULL};
    static const char *const roughness[] = {"roughness_m", "roughness_rad", NULL};
    const char *dot = strrchr(path, '.');
    char map[256];
    if (!dot || (size_t)(dot - path) >= sizeof map)
        return;
    snprintf(map, sizeof map, "%.*s", (int)(dot - path), path);
    if (strcmp(map, "rock") == 0)
        keep_one(c, map, dot + 1, c->d->file.scene.rock.shape == CEDUO_SPHERE ? sphere : weight);
    else if (strncmp(map, "slope.segments[", 15) == 0)
        keep_one(c, map, dot + 1, roughness);
    else if (strstr(map, ".shoots["))
        keep_one(c, map, dot + 1, shoots);
}

bool ceduo_document_set_alone(struct document *d, const char *path, const char *value, struct text *said,
                              struct problems *problems)
{
    struct changes c = {.d = d};
    int shape = strcmp(path, "rock.shape") == 0 ? ceduo_choice_find(&ceduo_shape_words, value) : -1;
    if (shape >= 0)
        change_shape(&c, (enum ceduo_shape)shape);
    else
        keep_one_of_all(&c, path);
    ceduo_changes_follow(&c, path, value);
    ceduo_changes_add(&c, "%s=%s", path, value);
    if (c.filled.length)
        ceduo_text_format(said, _("filled in for the same volume: %s"), c.filled.bytes);
    if (c.taken.length)
        ceduo_text_format(said, _("%sremoved: %s"), said->length ? "; " : "", c.taken.bytes);
    if (c.followed.length)
        ceduo_text_format(said, "%s%s", said->length ? "; " : "", c.followed.bytes);
    bool refused = c.refused.length > 0;
    if (refused) {
        ceduo_problem(problems, &(struct source){.name = path, .is_option = true}, 0, 0, "%s", c.refused.bytes);
        c.n = 0;
    }
    return ceduo_changes_make(&c, path, problems) && !refused;
}
