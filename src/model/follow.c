/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes along with a value that a person changes. Borders: where a belt, or a ground, ends and the next one begins
 * in the same place, moving one moves the other; where a border is moved over the next, that one gives way. Stands: a height
 * that is assumed goes along with its diameter. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/grow.h"
#include "base/language.h"
#include "ceduo/rotation.h"
#include "changes.h"
#include "io/doubt_inputs.h"

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
    ceduo_text_free(&c->taken);
    ceduo_text_free(&c->filled);
    ceduo_text_free(&c->followed);
    ceduo_text_free(&c->refused);
    free(c->sets);
    *c = (struct changes){.d = c->d};
    return good;
}

const char *ceduo_changes_rounded(struct changes *c, double value, int digits)
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
    char written[CEDUO_NUMBER_ROOM];
    ceduo_number_shortest(now, written);
    ceduo_changes_add(c, "%s=%s", border, value[0] == 'e' ? value : written); /* from the end, as this one is */
    ceduo_text_format(&c->followed, to ? _("what comes next begins at %s m now") : _("what comes before ends at %s m now"),
                      written);
}

/* The ground reaches as far as the profile does. */
static void follow_end(struct changes *c, const char *path, const char *value)
{
    struct place place = find_place(c, path);
    char room[CEDUO_NUMBER_ROOM];
    double now;
    const struct node *materials = ceduo_document_node(c->d, "slope.materials");
    const struct node *vertices = ceduo_document_node(c->d, "slope.vertices_m");
    if (!materials || materials->kind != NODE_LIST || materials->n == 0 || strcmp(place.list, "slope.vertices_m") != 0 ||
        sscanf(value, "[%lf", &now) != 1)
        return;
    if (place.index == 0)
        ceduo_changes_add(c, "slope.materials[0].from_m=%s", ceduo_number_shortest(now, room));
    else if (vertices && place.index + 1 == vertices->n)
        ceduo_changes_add(c, "slope.materials[%zu].to_m=%s", materials->n - 1, ceduo_number_shortest(now, room));
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
    const char *written = ceduo_changes_rounded(c, taller > 0 ? stems->height * taller : stems->height, 3);
    if (taller > 0)
        ceduo_changes_add(c, "%s:=%s", height, written);
    ceduo_text_format(&c->followed,
                      taller > 0 ? _("its height, assumed, goes along by the growth curve: %s m")
                                 : _("its height, %s m, is assumed and stays: no growth curve has this diameter"),
                      written);
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

void ceduo_changes_follow(struct changes *c, const char *path, const char *value)
{
    double now;
    follow_end(c, path, value);
    follow_design(c, path);
    follow_border(c, path, value);
    if (ceduo_number_read(value, &now) != CEDUO_NUMBER_GOOD)
        now = NAN;
    follow_stand(c, path, now);
}
