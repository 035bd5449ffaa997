/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes along with a value that a person changes. Borders: where a belt, or a ground, ends and the next one begins
 * in the same place, moving one moves the other; where a border is moved over the next, that one gives way. Stools:
 * more of them have more shoots. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "changes.h"

void ceduo_changes_add(struct changes *c, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const char *kept = ceduo_arena_vformat(&c->d->file.arena, format, args);
    va_end(args);
    if (kept && c->n < CHANGES_MOST)
        c->sets[c->n++] = kept;
    else
        c->failed = true;
}

const char *ceduo_changes_rounded(double value, int digits, char room[CEDUO_NUMBER_ROOM])
{
    snprintf(room, CEDUO_NUMBER_ROOM, "%.*g", digits, value);
    return ceduo_number_shortest(strtod(room, NULL), room);
}

/* The number at a path; NaN where there is none. */
static double number_at(const struct document *d, const char *path)
{
    const struct node *node = ceduo_document_node(d, path);
    double value;
    bool good = node && node->kind == NODE_SCALAR && ceduo_number_read(node->text, &value) == CEDUO_NUMBER_GOOD;
    return good ? value : NAN;
}

/* ---- borders ---- */

/* An item of a list, "forest[1]" of "forest[1].to_m", and the key in it. */
struct place {
    char list[192];
    size_t index;
    const char *key;
};

static bool find_place(const char *path, struct place *place)
{
    const char *open = strrchr(path, '['), *end;
    if (!open || (size_t)(open - path) >= sizeof place->list)
        return false;
    snprintf(place->list, sizeof place->list, "%.*s", (int)(open - path), path);
    place->index = strtoul(open + 1, (char **)(uintptr_t)&end, 10);
    place->key = *end == ']' && end[1] == '.' ? end + 2 : "";
    return end > open + 1 && *end == ']';
}

static bool ends_in(const char *text, const char *end)
{
    size_t n = strlen(text), length = strlen(end);
    return n >= length && strcmp(text + n - length, end) == 0;
}

/* The neighbour at the border that was `old` and is to be `now`. */
static void move_neighbour(struct changes *c, const struct place *place, bool to, double old, double now)
{
    char path[256], room[CEDUO_NUMBER_ROOM];
    if (!to && place->index == 0)
        return;
    size_t other = to ? place->index + 1 : place->index - 1;
    snprintf(path, sizeof path, "%.190s[%zu].%s", place->list, other, to ? "from_m" : "to_m");
    double there = number_at(c->d, path);
    bool overlaps = to ? there < now : there > now;
    if (isnan(there) || (there != old && !overlaps))
        return;
    snprintf(path, sizeof path, "%.190s[%zu].%s", place->list, other, to ? "to_m" : "from_m");
    double end = number_at(c->d, path);
    if (to ? end <= now : end >= now)
        ceduo_text_format(&c->refused,
                          to ? _("what comes next ends at %g m already; delete that first")
                             : _("what comes before begins at %g m only; delete that first"),
                          end);
    snprintf(path, sizeof path, "%.190s[%zu].%s", place->list, other, to ? "from_m" : "to_m");
    ceduo_changes_add(c, "%s=%s", path, ceduo_number_shortest(now, room));
    ceduo_text_format(&c->followed,
                      to ? _("what comes next begins at %s m now") : _("what comes before ends at %s m now"), room);
}

static void follow_border(struct changes *c, const char *path, double now)
{
    struct place place;
    if (!find_place(path, &place) || !(ends_in(place.list, "forest") || ends_in(place.list, "slope.materials")))
        return;
    bool to = strcmp(place.key, "to_m") == 0;
    if (to || strcmp(place.key, "from_m") == 0)
        move_neighbour(c, &place, to, number_at(c->d, path), now);
}

/* The ground reaches as far as the profile does. */
static void follow_end(struct changes *c, const char *path, const char *value)
{
    struct place place;
    char border[64], room[CEDUO_NUMBER_ROOM];
    double now;
    const struct node *materials = ceduo_document_node(c->d, "slope.materials");
    const struct node *vertices = ceduo_document_node(c->d, "slope.vertices_m");
    if (!materials || materials->kind != NODE_LIST || materials->n == 0 || !find_place(path, &place) ||
        strcmp(place.list, "slope.vertices_m") != 0 || sscanf(value, "[%lf", &now) != 1)
        return;
    bool first = place.index == 0, last = vertices && place.index + 1 == vertices->n;
    if (!first && !last)
        return;
    snprintf(border, sizeof border, "slope.materials[%zu].%s", first ? 0 : materials->n - 1, first ? "from_m" : "to_m");
    ceduo_changes_add(c, "%s=%s", border, ceduo_number_shortest(now, room));
}

/* ---- stools ---- */

static double sum_of_shoots(const struct document *d, const char *stand, size_t *n)
{
    char path[256];
    double sum = 0;
    snprintf(path, sizeof path, "%.160s.shoots", stand);
    const struct node *shoots = ceduo_document_node(d, path);
    *n = shoots && shoots->kind == NODE_LIST ? shoots->n : 0;
    for (size_t i = 0; i < *n; i++) {
        snprintf(path, sizeof path, "%.160s.shoots[%zu].per_ha", stand, i);
        sum += number_at(d, path);
    }
    return sum;
}

static double stools_of(const struct document *d, const char *stand)
{
    char path[256];
    snprintf(path, sizeof path, "%.160s.stools.per_ha", stand);
    return number_at(d, path);
}

double ceduo_shoots_per_stool(const struct document *d, const char *stand)
{
    size_t n;
    double shoots = sum_of_shoots(d, stand, &n), stools = stools_of(d, stand);
    return n > 0 && stools > 0 ? shoots / stools : NAN;
}

static void multiply_shoots(struct changes *c, const char *stand, double factor)
{
    char path[256], room[CEDUO_NUMBER_ROOM];
    size_t n;
    sum_of_shoots(c->d, stand, &n);
    for (size_t i = 0; i < n; i++) {
        snprintf(path, sizeof path, "%.160s.shoots[%zu].per_ha", stand, i);
        ceduo_changes_add(c, "%s=%s", path, ceduo_changes_rounded(number_at(c->d, path) * factor, 6, room));
    }
}

/* The stand whose stools a path is about. */
static bool is_of_stools(const char *path, const char *key, char *stand, size_t size)
{
    if (!ends_in(path, key))
        return false;
    snprintf(stand, size, "%.*s", (int)(strlen(path) - strlen(key)), path);
    return true;
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

bool ceduo_changes_follow(struct changes *c, const char *path, const char *value)
{
    char stand[192], room[CEDUO_NUMBER_ROOM];
    double now;
    follow_end(c, path, value);
    follow_design(c, path);
    bool number = ceduo_number_read(value, &now) == CEDUO_NUMBER_GOOD;
    if (number)
        follow_border(c, path, now);
    if (is_of_stools(path, ".stools.per_stool", stand, sizeof stand)) {
        multiply_shoots(c, stand, number ? now / ceduo_shoots_per_stool(c->d, stand) : NAN);
        return false;
    }
    bool stools = number && now > 0 && is_of_stools(path, ".stools.per_ha", stand, sizeof stand);
    double each = stools ? ceduo_shoots_per_stool(c->d, stand) : NAN;
    if (!(each > 0))
        return true;
    multiply_shoots(c, stand, now / stools_of(c->d, stand));
    ceduo_text_format(&c->followed, _("%s shoots on each stool stay"), ceduo_changes_rounded(each, 3, room));
    return true;
}
