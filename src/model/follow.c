/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes along with a value that a person changes. Borders: where a belt, or a ground, ends and the next one begins
 * in the same place, moving one moves the other; where a border is moved over the next, that one gives way. Stands: a height
 * that is assumed goes along with its diameter. What would say the same in another way is taken out. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/must.h"
#include "ceduo/rotation.h"
#include "changes.h"
#include "io/scene_file.h"

void ceduo_changes_add(struct changes *c, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    c->sets = ceduo_grow(c->sets, c->n, &c->room, sizeof *c->sets);
    c->sets[c->n++] = ceduo_arena_vformat(&c->d->file.arena, format, args);
    va_end(args);
}

void ceduo_changes_remove(struct changes *c, const char *path)
{
    if (ceduo_document_node(c->d, path))
        ceduo_changes_add(c, "%s", path);
}

bool ceduo_changes_make(struct changes *c, const char *what, struct problems *problems)
{
    bool good = ceduo_document_set_all(c->d, c->sets, c->n, what, problems);
    ceduo_changes_free(c);
    return good;
}

void ceduo_changes_free(struct changes *c)
{
    ceduo_text_free(&c->taken);
    ceduo_text_free(&c->filled);
    ceduo_text_free(&c->followed);
    ceduo_text_free(&c->refused);
    free(c->sets);
    *c = (struct changes){.d = c->d};
}

/* A number of so many digits as text, in the arena of the document. */
static const char *rounded(struct changes *c, double value, int digits)
{
    char room[CEDUO_NUMBER_ROOM];
    snprintf(room, sizeof room, "%.*g", digits, value);
    return ceduo_arena_string(&c->d->file.arena, ceduo_number_shortest(strtod(room, NULL), room));
}

/* The place at a path; NaN where there is none. */
static double place_at(const struct document *d, const char *path)
{
    const struct node *node = ceduo_document_node(d, path);
    return node && node->kind == NODE_SCALAR ? ceduo_document_place(d, node->text) : NAN;
}

/* ---- borders ---- */

static bool ends_in(const char *text, const char *end)
{
    size_t n = strlen(text), length = strlen(end);
    return n >= length && strcmp(text + n - length, end) == 0;
}

/* An item of a list, "forest[1]" of "forest[1].to_m", and the key in it; "": there is none. */
struct place {
    const char *list, *key;
    size_t index;
};

static struct place find_place(struct changes *c, const char *path)
{
    const char *open = strrchr(path, '[');
    char *end = NULL;
    size_t index = open ? strtoul(open + 1, &end, 10) : 0;
    if (!open || end == open + 1 || *end != ']')
        return (struct place){"", "", 0};
    return (struct place){ceduo_arena_copy(&c->d->file.arena, path, (size_t)(open - path)), end[1] == '.' ? end + 2 : "",
                          index};
}

/* Of a border that moves the neighbour there moves, too. */
static void follow_border(struct changes *c, const char *path, const char *value)
{
    struct arena *arena = &c->d->file.arena;
    struct place place = find_place(c, path);
    double now = ceduo_document_place(c->d, value), old = place_at(c->d, path);
    bool to = strcmp(place.key, "to_m") == 0;
    if (isnan(now) || !(ends_in(place.list, "forest") || ends_in(place.list, "slope.materials")) ||
        !(to || (strcmp(place.key, "from_m") == 0 && place.index > 0)))
        return;
    size_t other = to ? place.index + 1 : place.index - 1;
    const char *border = ceduo_arena_format(arena, "%s[%zu].%s", place.list, other, to ? "from_m" : "to_m");
    double there = place_at(c->d, border);
    double end = place_at(c->d, ceduo_arena_format(arena, "%s[%zu].%s", place.list, other, to ? "to_m" : "from_m"));
    bool overlaps = to ? there < now : there > now;
    if (isnan(there) || (there != old && !overlaps))
        return;
    if (to ? end <= now : end >= now)
        ceduo_text_format(&c->refused,
                          to ? _("what comes next ends at %g m already; delete that first")
                             : _("what comes before begins at %g m only; delete that first"),
                          end);
    ceduo_changes_add(c, "%s=%s", border, value[0] == 'e' ? value : NUMERAL(now)); /* from the end, as this one is */
    ceduo_text_format(&c->followed, to ? _("what comes next begins at %s m now") : _("what comes before ends at %s m now"),
                      ceduo_number_spoken(NUMERAL(now)));
}

/* The ground reaches as far as the profile does. */
static void follow_end(struct changes *c, const char *path, const char *value)
{
    struct place place = find_place(c, path);
    double now;
    const struct node *materials = ceduo_document_node(c->d, "slope.materials");
    const struct node *vertices = ceduo_document_node(c->d, "slope.vertices_m");
    if (!materials || materials->kind != NODE_LIST || materials->n == 0 || strcmp(place.list, "slope.vertices_m") != 0 ||
        sscanf(value, "[%lf", &now) != 1)
        return;
    if (place.index == 0)
        ceduo_changes_add(c, "slope.materials[0].from_m=%s", NUMERAL(now));
    else if (vertices && place.index + 1 == vertices->n)
        ceduo_changes_add(c, "slope.materials[%zu].to_m=%s", materials->n - 1, NUMERAL(now));
}

/* ---- stands ---- */

/* A height that is only assumed goes along with its diameter, as both do while stems grow. */
static void follow_diameter(struct changes *c, const char *path, const struct ceduo_curve *curve,
                            const struct ceduo_stems *stems, double dbh)
{
    const char *height = ceduo_arena_format(&c->d->file.arena, "%.*sheight_m", (int)(strrchr(path, '.') + 1 - path), path);
    if (!ceduo_scene_assumes_value(&c->d->file, height) || dbh == stems->dbh)
        return;
    double taller = ceduo_curve_height(curve, dbh) / ceduo_curve_height(curve, stems->dbh);
    const char *written = rounded(c, taller > 0 ? stems->height * taller : stems->height, 3);
    if (taller > 0)
        ceduo_changes_add(c, "%s:=%s", height, written);
    ceduo_text_format(&c->followed,
                      taller > 0 ? _("its height, assumed, goes along by the growth curve: %s m")
                                 : _("its height, %s m, is assumed and stays: no growth curve has this diameter"),
                      ceduo_number_spoken(ceduo_arena_string(&c->d->file.arena, written)));
}

static void follow_stand(struct changes *c, const char *path, double now)
{
    const struct ceduo_belt *belt = ceduo_input_belt(&c->d->file.scene, path);
    const char *stand = strstr(path, "].stand."), *bracket = strrchr(path, '[');
    const struct ceduo_stand *s = belt && stand ? &belt->stand : NULL;
    const char *key = stand ? stand + strlen("].stand.") : ""; /* trees[1].per_ha of forest[0].stand.trees[1].per_ha */
    size_t i = bracket > stand ? strtoul(bracket + 1, NULL, 10) : 0;
    bool shoot = s && strncmp(key, "shoots[", 7) == 0 && i < s->shoots_count;
    bool tree = s && strncmp(key, "trees[", 6) == 0 && i < s->trees_count;
    if ((shoot || tree) && (ends_in(key, "].dbh_m") || ends_in(key, "].dbh_cm")))
        follow_diameter(c, path, shoot ? &s->growth.shoots : &s->growth.trees, shoot ? &s->shoots[i] : &s->trees[i],
                        ends_in(key, "_cm") ? now / 100 : now);
}

/* Both surveys are judged or none: the other one is taken as poor, which asks for more. */
static void follow_design(struct changes *c, const char *path)
{
    static const char *const both[2] = {"design.survey", "design.blocks"};
    for (int i = 0; i < 2; i++)
        if (strcmp(path, both[i]) == 0 && !ceduo_document_node(c->d, "design")) {
            ceduo_changes_add(c, "%s=poor", both[1 - i]);
            ceduo_text_put(&c->followed, _("the other survey is taken as poor"));
        }
}

/* ---- what would say the same ---- */

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
    char *spoken = ceduo_arena_string(&c->d->file.arena, value), *end = spoken;
    for (const char *from = value; *from; from++) /* a list as forms show it: its commas would be taken for decimal ones */
        if (!strchr("[],", *from))
            *end++ = *from;
    *end = '\0';
    ceduo_text_format(&c->filled, " %s %s", ceduo_number_spoken(spoken), f ? f->unit : "");
}

/* ---- another shape ---- */

/* Another shape of the same volume. Ellipsoid and block have the same sizes: then there is nothing to do. */
static void change_shape(struct changes *c, enum ceduo_shape shape)
{
    static const double full[] = {[CEDUO_SPHERE] = 6, [CEDUO_CYLINDER] = 4, [CEDUO_ELLIPSOID] = 6};
    const struct ceduo_rock_def *def = &c->d->file.scene.rock;
    bool cylinder = def->shape == CEDUO_CYLINDER, round = cylinder || def->shape == CEDUO_SPHERE;
    bool axes_then = shape == CEDUO_ELLIPSOID || shape == CEDUO_BLOCK, mass = !isnan(def->mass.mean);
    bool sized = false; /* blocks may say it instead */
    static const char *const sizes[] = {"rock.diameter_m", "rock.height_m", "rock.volume_m3", "rock.mass_kg", "rock.axes_m"};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        sized |= ceduo_document_node(c->d, sizes[i]) != NULL;
    struct ceduo_rock rock;
    if (!sized || shape == def->shape || (!round && axes_then) || ceduo_rock_of_means(def, &rock) != CEDUO_OK)
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
        fill_in(c, "diameter_m", rounded(c, cbrt(box), 3));
    } else if (shape == CEDUO_CYLINDER) {
        fill_in(c, "diameter_m", rounded(c, scale * sqrt(s[0] * s[1]), 3));
        fill_in(c, "height_m", rounded(c, scale * s[2], 3));
    } else {
        fill_in(c, "axes_m",
                ceduo_arena_format(&c->d->file.arena, "[%s, %s, %s]", rounded(c, scale * s[0], 3), rounded(c, scale * s[1], 3),
                                   rounded(c, scale * s[2], 3)));
    }
    if (shape == CEDUO_SPHERE && mass) { /* where it would be a size */
        take_out(c, "rock", "mass_kg");
        fill_in(c, "density_kg_m3", rounded(c, rock.mass / rock.volume, 4));
    } else if (mass) {
        take_out(c, "rock", "density_kg_m3");
    }
    bool spread = def->diameter.spread > 0 || def->height.spread > 0 || def->volume.spread > 0;
    for (int i = 0; i < 3; i++)
        spread |= def->axes[i].spread > 0;
    if (spread)
        ceduo_text_then(&c->filled, " ", _("(means, without spread)"));
}

/* The first dimension of a cylinder, whose size blocks said before, brings the other along: both are given or none. */
static void follow_cylinder(struct changes *c, const char *path, const char *value)
{
    static const char *const keys[] = {"rock.diameter_m", "rock.height_m"};
    for (int i = 0; c->d->file.scene.rock.shape == CEDUO_CYLINDER && i < 2; i++)
        if (strcmp(path, keys[i]) == 0 && !ceduo_document_node(c->d, keys[1 - i])) {
            ceduo_changes_add(c, "%s=%s", keys[1 - i], value);
            ceduo_text_put(&c->followed, _("diameter and height are equal now"));
        }
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
    double now;
    int shape = strcmp(path, "rock.shape") == 0 ? ceduo_choice_find(&ceduo_shape_words, value) : -1;
    if (shape >= 0)
        change_shape(&c, (enum ceduo_shape)shape);
    else
        keep_one_of_all(&c, path);
    follow_end(&c, path, value);
    follow_design(&c, path);
    follow_cylinder(&c, path, value);
    follow_border(&c, path, value);
    follow_stand(&c, path, ceduo_number_read(value, &now) == CEDUO_NUMBER_GOOD ? now : NAN);
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
