/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "changes.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

/* What people call a value: its label without the unit. */
static const struct field *put_name(struct changes *c, struct text *text, const char *map, const char *key)
{
    const struct field *f = ceduo_schema_at(ceduo_arena_format(&c->d->file.arena, "%s.%s", map, key));
    const char *label = f ? _(f->shown.label) : key;
    ceduo_text_put(text, text->length ? ", " : "");
    ceduo_text_add(text, label, strcspn(label, ","));
    return f;
}

/* Takes an entry of a mapping out, if it is there. */
static void take_out(struct changes *c, const char *map, const char *key)
{
    if (!ceduo_node_get(ceduo_document_node(c->d, map), key))
        return;
    ceduo_changes_add(c, "%s.%s", map, key);
    put_name(c, &c->taken, map, key);
}

static void fill_in(struct changes *c, const char *key, const char *value)
{
    ceduo_changes_add(c, "rock.%s=%s", key, value);
    const struct field *f = put_name(c, &c->filled, "rock", key);
    ceduo_text_format(&c->filled, " %s %s", value, f ? f->unit : "");
}

/* ---- another shape ---- */

/* Another shape of the same volume. Ellipsoid and block have the same sizes: then there is nothing to do. */
static void change_shape(struct changes *c, enum ceduo_shape shape)
{
    static const double full[] = {[CEDUO_SPHERE] = 6, [CEDUO_CYLINDER] = 4, [CEDUO_ELLIPSOID] = 6};
    const struct ceduo_rock_def *def = &c->d->file.scene.rock;
    bool cylinder = def->shape == CEDUO_CYLINDER, round = cylinder || def->shape == CEDUO_SPHERE;
    bool axes_then = shape == CEDUO_ELLIPSOID || shape == CEDUO_BLOCK, mass = !isnan(def->mass.mean);
    struct ceduo_rock rock;
    if (shape == def->shape || (!round && axes_then) || ceduo_rock_of_means(def, &rock) != CEDUO_OK)
        return;
    if (axes_then)
        take_out(c, "rock", "diameter_m");
    take_out(c, "rock", "volume_m3");
    if (shape != CEDUO_CYLINDER)
        take_out(c, "rock", "height_m");
    if (!axes_then)
        take_out(c, "rock", "axes_m");
    double s[3]; /* length, width, height: a volume is that of a box of these times a number of the shape */
    for (int i = 0; i < 3; i++)
        s[i] = !round ? def->axes[i].mean : cylinder ? def->diameter.mean : rock.mean_diameter;
    s[2] = cylinder ? def->height.mean : s[2];
    double box = shape == CEDUO_BLOCK ? rock.volume : rock.volume * full[shape] / M_PI;
    double scale = cbrt(box / (s[0] * s[1] * s[2]));
    if (shape == CEDUO_SPHERE) {
        fill_in(c, "diameter_m", ceduo_changes_rounded(c, cbrt(box), 3));
    } else if (shape == CEDUO_CYLINDER) {
        fill_in(c, "diameter_m", ceduo_changes_rounded(c, scale * sqrt(s[0] * s[1]), 3));
        fill_in(c, "height_m", ceduo_changes_rounded(c, scale * s[2], 3));
    } else {
        fill_in(c, "axes_m",
                ceduo_arena_format(&c->d->file.arena, "[%s, %s, %s]", ceduo_changes_rounded(c, scale * s[0], 3),
                                   ceduo_changes_rounded(c, scale * s[1], 3), ceduo_changes_rounded(c, scale * s[2], 3)));
    }
    if (shape == CEDUO_SPHERE && mass) { /* where it would be a size */
        take_out(c, "rock", "mass_kg");
        fill_in(c, "density_kg_m3", ceduo_changes_rounded(c, rock.mass / rock.volume, 4));
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

/* Takes out what would say the same as a value: of the rock the other sizes, or what says its mass otherwise. */
static void keep_one_of_all(struct changes *c, const char *path)
{
    static const char *const of_rock[2][3] = {{"mass_kg", "density_kg_m3"}, {"diameter_m", "volume_m3", "mass_kg"}};
    bool sphere = c->d->file.scene.rock.shape == CEDUO_SPHERE, is_one = false; /* whose mass is a size */
    const char *dot = strrchr(path, '.'), *key = dot ? dot + 1 : path;
    const char *map = ceduo_arena_copy(&c->d->file.arena, path, dot ? (size_t)(dot - path) : 0);
    const struct field *holder = ceduo_schema_row(map), *f = ceduo_schema_at(path);
    const char *other = holder && holder->object && f ? ceduo_schema_other(holder->object, key) : NULL;
    if (other && !ceduo_schema_unit(holder->object, f))
        take_out(c, map, other);
    for (size_t i = 0; strcmp(map, "rock") == 0 && i < 3 && of_rock[sphere][i]; i++)
        is_one |= strcmp(of_rock[sphere][i], key) == 0;
    for (size_t i = 0; is_one && i < 3 && of_rock[sphere][i]; i++)
        if (strcmp(of_rock[sphere][i], key) != 0)
            take_out(c, map, of_rock[sphere][i]);
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
