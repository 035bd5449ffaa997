/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rock and its release, of the scene or of an observation; the block classes and the controls. */
#include <math.h>
#include <string.h>

#include "base/elementary.h"
#include "base/language.h"
#include "scene/derived.h"
#include "scene/rock.h"
#include "validator.h"

/* Keys and an example of each shape. A sphere has one of its keys, the other shapes have all. */
static const struct {
    const char *keys[4], *example;
} shapes[] = {[CEDUO_SHAPE_SPHERE] = {{"diameter_m", "volume_m3", "mass_kg"}, "diameter_m: 1"},
              [CEDUO_SHAPE_CYLINDER] = {{"diameter_m", "height_m"}, "diameter_m: 1, height_m: 1"},
              [CEDUO_SHAPE_ELLIPSOID] = {{"axes_m"}, "axes_m: [1, 1, 1]"},
              [CEDUO_SHAPE_BLOCK] = {{"axes_m"}, "axes_m: [1, 1, 1]"}};

static void check_rock(struct validator *v, const char *path, const struct ceduo_rock_def *def)
{
    struct ceduo_rock rock;
    if (ceduo_rock_from_means(def, &rock) != CEDUO_OK)
        ceduo_reject(v, path, "", _("the rock is too small or too large to compute"));
}

void ceduo_validate_rock(struct validator *v, const char *path, const struct ceduo_rock_def *def)
{
    static const char *const sizes[] = {"diameter_m", "height_m", "axes_m", "volume_m3"};
    const enum ceduo_shape shape = def->shape;
    const char *const *keys = shapes[shape].keys, *name = ceduo_shape_words.names[shape];
    const struct node *node = ceduo_resolve_at(v->root, path), *shape_node = ceduo_node_get(node, "shape");
    bool is_scene_rock = strcmp(path, "rock") == 0, blocks = is_scene_rock && ceduo_node_get(v->root, "blocks");
    bool by_mass = shape != CEDUO_SHAPE_SPHERE && ceduo_is_given(v, path, "mass_kg");
    size_t before = v->problems->met;
    int n = 0;
    if (!ceduo_is_valid(v, "%s.shape", path))
        return;
    for (size_t i = 0; i < 4; i++) {
        bool belongs = false;
        for (size_t k = 0; keys[k]; k++)
            belongs |= strcmp(keys[k], sizes[i]) == 0;
        if (belongs || !ceduo_node_get(node, sizes[i]))
            continue;
        if (shape_node && shape_node->source->is_option) /* --set cannot remove a key of the file */
            ceduo_reject(v, path, sizes[i],
                         _("does not belong to the shape '%s'; give the whole rock: -s 'rock={shape: %s, %s}'"), name, name,
                         shapes[shape].example);
        else
            ceduo_reject(v, path, sizes[i], _("does not belong to the shape '%s'; remove it"), name);
    }
    for (size_t i = 0; keys[i]; i++)
        n += ceduo_is_given(v, path, keys[i]);
    bool by_blocks = blocks && !by_mass && n == 0;
    for (size_t i = 0; keys[i] && shape != CEDUO_SHAPE_SPHERE && !by_blocks; i++)
        if (!ceduo_is_given(v, path, keys[i]))
            ceduo_reject(v, path, "", _("'%s' is missing; the shape '%s' needs it"), keys[i], name);
    if (shape == CEDUO_SHAPE_SPHERE && n != 1 && !by_blocks)
        ceduo_reject(v, path, "",
                     blocks
                         ? _("with 'blocks' a sphere needs at most one of diameter_m, volume_m3 and mass_kg; here %d are given")
                         : _("a sphere needs one of diameter_m, volume_m3 and mass_kg; here %d are given"),
                     n);
    if (shape != CEDUO_SHAPE_SPHERE && ceduo_node_get(node, "mass_kg") && ceduo_node_get(node, "density_kg_m3"))
        ceduo_reject(v, path, "density_kg_m3", _("%s already says this; keep one of the two"), "mass_kg");
    if (is_scene_rock && !ceduo_is_given(v, path, "density_kg_m3") && !by_mass)
        ceduo_assume(v, "rock.density_kg_m3",
                     ceduo_asprintf(v, _("density of limestone, %g kg/m3"), ceduo_scene_default().rock.density.mean));
    v->sized_by_blocks |= by_blocks && before == v->problems->met && ceduo_is_valid_below(v, path);
    if (before == v->problems->met && ceduo_is_valid_below(v, path) && !by_blocks)
        check_rock(v, path, def);
}

void ceduo_validate_release(struct validator *v, const char *path, struct ceduo_release *release)
{
    const struct ceduo_slope *slope = &v->draft.scene.slope;
    struct ceduo_number *x = &release->x;
    path = ceduo_asprintf(v, "%s.x_m", path);
    release->x_assumed = isnan(x->mean);
    x->mean = release->x_assumed ? 0 : x->mean - v->origin;
    if (!v->has_profile || !ceduo_is_valid_below(v, path))
        return;
    double end = slope->x[slope->vertices - 1], first = ceduo_number_min(*x), last = ceduo_number_max(*x);
    if (!(first >= 0) || !(last < end))
        ceduo_reject(v, path, "", _("%s lies outside the slope; a release must be at least %s and less than %s m"),
                     ROUNDTRIP((first >= 0 ? last : first) + v->origin), ROUNDTRIP(v->origin), ROUNDTRIP(end + v->origin));
}

/* Shares that differ from 1 by less are rounded: .333 for each of three. */
#define SHARES_ROUNDING 0.005

void ceduo_validate_releases(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    const struct node *node = ceduo_node_get(v->root, "release");
    size_t n = scene->releases_count;
    double shares = 0;
    if (!node || node->kind != NODE_LIST) {
        ceduo_validate_release(v, "release", &scene->release);
        return;
    }
    scene->release.x.mean = 0;
    if (n == 0 && ceduo_is_valid(v, "release"))
        ceduo_reject(v, "release", "", _("the list is empty"));
    if (ceduo_is_too_long(v, "release", n))
        n = scene->releases_count = 0;
    for (size_t i = 0; i < n; i++) {
        ceduo_validate_release(v, ceduo_asprintf(v, "release[%zu]", i), &scene->releases[i]);
        shares += scene->releases[i].share;
    }
    if (n == 0 || !ceduo_is_valid_below(v, "release"))
        return;
    if (fabs(shares - 1) > SHARES_ROUNDING)
        ceduo_reject(v, "release", "", _("the shares add up to %s, not to 1; correct them"), ROUNDTRIP(shares));
    ceduo_scene_average_releases(scene);
}

/* ---- blocks ---- */

/* Integral of e^(a u) over u from 0 to `length`. */
static double integral(double a, double length)
{
    return a == 0 ? length : ceduo_expm1(a * length) / a;
}

/* Return the mean volume of the blocks, m3, weighted by their frequency. */
static double mean_volume(const struct ceduo_scene *scene)
{
    double volume = 0, per_year = 0;
    for (size_t i = 0; i < scene->blocks_count; i++) {
        const struct ceduo_size_class *b = &scene->blocks[i];
        double length = ceduo_log(b->volumes[1] / b->volumes[0]); /* density of ln v: proportional to e^(-exponent ln v) */
        volume += b->per_year * b->volumes[0] * integral(1 - b->exponent, length) / integral(-b->exponent, length);
        per_year += b->per_year;
    }
    return volume / per_year;
}

/* Set the size of a rock without one to the mean block, all dimensions equal. Figures of a single rock, such as the ADC, use
 * it. */
static void size_by_blocks(struct validator *v)
{
    struct ceduo_rock_def *rock = &v->draft.scene.rock;
    const double volume = mean_volume(&v->draft.scene);
    const double box = rock->shape == CEDUO_SHAPE_CYLINDER ? 4 / M_PI : rock->shape == CEDUO_SHAPE_ELLIPSOID ? 6 / M_PI : 1;
    const struct ceduo_number edge = ceduo_number(ceduo_cbrt(volume * box));
    if (rock->shape == CEDUO_SHAPE_SPHERE)
        rock->volume = ceduo_number(volume);
    else if (rock->shape == CEDUO_SHAPE_CYLINDER)
        rock->diameter = rock->height = edge;
    else
        rock->axes[0] = rock->axes[1] = rock->axes[2] = edge;
    if (rock->shape != CEDUO_SHAPE_SPHERE)
        ceduo_assume(v, "rock.shape", _("all dimensions of a block are equal"));
    check_rock(v, "blocks", rock);
}

void ceduo_validate_blocks(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    const struct node *blocks = ceduo_node_get(v->root, "blocks");
    size_t n = scene->blocks_count;
    if (!blocks)
        return;
    if (n == 0 && ceduo_is_valid(v, "blocks"))
        ceduo_reject(v, "blocks", "", _("the list is empty"));
    const struct ceduo_rock_def *r = &scene->rock;
    bool spreads = r->diameter.spread > 0 || r->volume.spread > 0 || r->mass.spread > 0;
    if (ceduo_node_get(v->root, "rocks_per_year"))
        ceduo_reject(v, "rocks_per_year", "", _("%s already says this; keep one of the two"), "blocks");
    if (blocks->kind == NODE_MAP && !ceduo_is_given(v, "blocks", "exponent"))
        ceduo_reject(v, "blocks", "",
                     _("'exponent' is missing; the number of blocks above a volume v is proportional to v^-exponent"));
    if (r->shape == CEDUO_SHAPE_SPHERE && spreads && ceduo_is_valid_below(v, "rock")) /* a sphere has no proportions */
        ceduo_reject(v, "rock", "", _("'blocks' gives the sizes of rocks; remove the size here, or its spread"));
    if (ceduo_is_too_long(v, "blocks", n) || !ceduo_is_valid_below(v, "blocks"))
        return;
    bool good = true, single = blocks->kind == NODE_MAP;
    scene->rocks_per_year = n > 0 ? 0 : NAN;
    for (size_t i = 0; i < n; i++) {
        const struct ceduo_size_class *b = &scene->blocks[i];
        const char *path = single ? "blocks.volume_m3" : ceduo_asprintf(v, "blocks[%zu].volume_m3", i);
        bool two = b->volumes_count == 2, rise = two && b->volumes[0] < b->volumes[1];
        scene->rocks_per_year += b->per_year;
        if (!two)
            ceduo_reject(v, path, "", _("expected %s"), "[lo, hi]");
        else if (!rise)
            ceduo_reject(v, path, "", _("%s m3 is not below %s m3; write the smaller volume first"), ROUNDTRIP(b->volumes[0]),
                         ROUNDTRIP(b->volumes[1]));
        good &= rise;
    }
    for (size_t i = 0; i < n && good; i++) { /* classes must not overlap */
        const struct ceduo_size_class *b = scene->blocks;
        size_t k = 0;
        while (k < i && !(b[i].volumes[0] < b[k].volumes[1] && b[k].volumes[0] < b[i].volumes[1]))
            k++;
        if (k < i)
            ceduo_reject(v, ceduo_asprintf(v, "blocks[%zu].volume_m3", i), "",
                         _("this class overlaps an earlier one, from %s to %s m3; classes may only touch"),
                         ROUNDTRIP(b[k].volumes[0]), ROUNDTRIP(b[k].volumes[1]));
    }
    if (v->sized_by_blocks && good && n > 0)
        size_by_blocks(v);
}

/* ---- controls ---- */

/* Check accepted_return_y, which requires blocks; otherwise add its default as an assumption. */
static void check_return(struct validator *v, size_t i, const struct ceduo_control *c)
{
    const char *path = ceduo_asprintf(v, "controls[%zu].accepted_return_y", i);
    bool given = ceduo_resolve_at(v->root, path), blocks = ceduo_node_get(v->root, "blocks");
    if (given && !blocks && ceduo_is_valid(v, "%s", path))
        ceduo_reject(v, path, "", _("the frequency of rocks is not given; add 'blocks', or remove this"));
    else if (!given && blocks && !isnan(c->accepted))
        ceduo_assume(
            v, path,
            ceduo_asprintf(v,
                           ngettext("a rock above the accepted energy may come once in %d year",
                                    "a rock above the accepted energy may come once in %d years", CEDUO_ACCEPTED_RETURN),
                           CEDUO_ACCEPTED_RETURN));
}

void ceduo_validate_controls(struct validator *v)
{
    struct ceduo_scene *scene = &v->draft.scene;
    bool has_list = scene->controls_count > 0;
    size_t n = has_list ? scene->controls_count : v->draft.controls_m_count;
    const char *path = has_list ? "controls" : "controls_m";
    scene->controls_count = 0;
    if (!ceduo_is_valid(v, "controls") || !ceduo_is_valid(v, "controls_m"))
        return;
    if (n == 0) {
        ceduo_reject(v, "", "", _("'controls' is missing; give at least one place at which passing rocks are counted"));
        return;
    }
    if (ceduo_is_too_long(v, path, n) || (!has_list && !(scene->controls = ceduo_alloc(v, n, sizeof *scene->controls))))
        return;
    bool has_release = v->has_profile && ceduo_is_valid_below(v, ceduo_release_places(v));
    double last = has_release ? ceduo_scene_release_last(scene) : -INFINITY;
    for (size_t i = 0; i < n; i++) {
        struct ceduo_control *c = &scene->controls[i];
        const char *item = ceduo_asprintf(v, has_list ? "%s[%zu].x_m" : "%s[%zu]", path, i);
        size_t k = 0;
        if (!has_list) {
            ceduo_schema_init(ceduo_schema_field(ceduo_schema_scene(), "controls")->object, c);
            c->x_given = v->draft.controls_m[i];
        }
        c->name = (char *)(uintptr_t)ceduo_in_language(c->name_given, c->name);
        c->x = c->x_given - v->origin;
        const char *x = ROUNDTRIP(c->x_given);
        while (k < i && scene->controls[k].x != c->x)
            k++;
        check_return(v, i, c);
        if (!ceduo_check_on_slope(v, item, "", c->x_given))
            continue;
        if (c->x <= last)
            ceduo_reject(v, item, "", _("%s must lie beyond the release (%s m)"), x, ROUNDTRIP(last + v->origin));
        else if (k < i)
            ceduo_reject(v, item, "", _("'%s' is given twice"), x);
    }
    scene->controls_count = n;
}
