/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rock and its release, whether they are the scene's or those of something observed. */
#include <math.h>
#include <string.h>

#include "base/language.h"
#include "validate.h"

/* What each shape is given by, and how that is written. A sphere has one of its keys, the others have all. */
static const struct {
    const char *keys[4], *example;
} shapes[] = {[CEDUO_SPHERE] = {{"diameter_m", "volume_m3", "mass_kg"}, "diameter_m: 1"},
              [CEDUO_CYLINDER] = {{"diameter_m", "height_m"}, "diameter_m: 1, height_m: 1"},
              [CEDUO_ELLIPSOID] = {{"axes_m"}, "axes_m: [1, 1, 1]"},
              [CEDUO_BLOCK] = {{"axes_m"}, "axes_m: [1, 1, 1]"}};

static void check_sizes(struct validator *v, const char *rock, const struct node *node, enum ceduo_shape shape)
{
    static const char *const sizes[] = {"diameter_m", "height_m", "axes_m", "volume_m3"};
    const struct node *said = ceduo_node_get(node, "shape");
    const char *name = ceduo_shape_words.names[shape];
    int n = 0;
    for (size_t i = 0; i < 4; i++) {
        bool belongs = false;
        for (size_t k = 0; shapes[shape].keys[k]; k++)
            belongs |= strcmp(shapes[shape].keys[k], sizes[i]) == 0;
        if (belongs || !ceduo_node_get(node, sizes[i]))
            continue;
        const char *path = ceduo_format(v, "%s.%s", rock, sizes[i]);
        if (said && said->source->is_option) /* nothing of the file can be taken out there */
            ceduo_complain(v, path, "", _("does not belong to the shape '%s'; give the whole rock: -s 'rock={shape: %s, %s}'"),
                           name, name, shapes[shape].example);
        else
            ceduo_complain(v, path, "", _("does not belong to the shape '%s'; remove it"), name);
    }
    for (size_t i = 0; shapes[shape].keys[i]; i++) {
        bool given = ceduo_is_given(v, rock, node, shapes[shape].keys[i]);
        n += given;
        if (!given && shape != CEDUO_SPHERE)
            ceduo_complain(v, rock, "", _("'%s' is missing: the shape '%s' needs it"), shapes[shape].keys[i], name);
    }
    if (shape == CEDUO_SPHERE && n != 1)
        ceduo_complain(v, rock, "", _("a sphere is given by one of diameter_m, volume_m3 and mass_kg, here %d are given"), n);
    if (shape != CEDUO_SPHERE && ceduo_node_get(node, "mass_kg") && ceduo_node_get(node, "density_kg_m3"))
        ceduo_complain(v, ceduo_format(v, "%s.density_kg_m3", rock), "", _("mass_kg already says this; keep one of the two"));
}

void ceduo_validate_rock(struct validator *v, const char *path, const struct node *node, const struct ceduo_rock_def *def)
{
    size_t before = v->problems->met;
    if (!ceduo_is_known(v, "%s.shape", path))
        return;
    check_sizes(v, path, node, def->shape);
    bool by_mass = def->shape != CEDUO_SPHERE && ceduo_is_given(v, path, node, "mass_kg");
    bool of_scene = strcmp(path, "rock") == 0;
    if (of_scene && !ceduo_is_given(v, path, node, "density_kg_m3") && !by_mass)
        ceduo_assume(v, "rock.density_kg_m3",
                     ceduo_format(v, _("density of limestone, %g kg/m3"), ceduo_scene_default().rock.density.mean));
    struct ceduo_rock rock;
    if (before == v->problems->met && ceduo_is_sound(v, path) && ceduo_rock_of_means(def, &rock) != CEDUO_OK)
        ceduo_complain(v, path, "", _("the rock is too small or too large to compute"));
}

void ceduo_validate_release(struct validator *v, const char *path, struct ceduo_release *release)
{
    const struct ceduo_slope *slope = &v->draft.scene.slope;
    struct ceduo_number *x = &release->x;
    path = ceduo_format(v, "%s.x_m", path);
    release->x_assumed = isnan(x->mean);
    x->mean = release->x_assumed ? 0 : x->mean - v->origin;
    if (!v->profile || !ceduo_is_sound(v, path))
        return;
    double end = slope->x[slope->vertices - 1], first = ceduo_number_lowest(*x), last = ceduo_number_highest(*x);
    if (!(first >= 0) || !(last < end))
        ceduo_complain(v, path, "", _("%s lies beyond the slope; a release may be anywhere from %s to before %s m"),
                       ceduo_decimal(v, (first >= 0 ? last : first) + v->origin), ceduo_decimal(v, v->origin),
                       ceduo_decimal(v, end + v->origin));
}
