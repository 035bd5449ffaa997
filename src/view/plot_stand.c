/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "plot.h"

/* A stand from above, or a rock's trajectory through it. The stems of a stand are spread evenly and without chance, each kind
 * for itself: when a number changes, the stems that stay do not move. */

#define PATCH_M     20.0 /* along the fall */
#define STEMS_MAX   8000 /* of one kind in a patch */
#define SHOOTS_MAX  200  /* of a stool */
#define JOINED_DOTS 6    /* shoots closer than this are joined */

#define GOLDEN  0.61803398874989485 /* its multiples fill a circle evenly */
#define PLASTIC 1.32471795724474603 /* those of 1 / it and 1 / its square a square (Roberts 2018) */

enum { STOOLS, STUMPS, LOGS, TREES }; /* kinds; of trees each class is one */

struct spot {
    double x, y; /* m */
};

struct plan {
    struct ceduo_drawing *d;
    const struct ceduo_stand *stand;
    double width, height, strip; /* m: the patch, and the rock's strip in its middle */
    double dot;                  /* m */
    size_t met;                  /* stools and trees in the way of the rock */
};

/* How many of `per_ha` stand in the patch. */
static size_t count_in(const struct plan *p, double per_ha)
{
    double n = per_ha * p->width * p->height / 1e4;
    return n < STEMS_MAX ? (size_t)lround(n) : STEMS_MAX;
}

/* The place of the i-th of a kind. */
static struct spot spot_of(const struct plan *p, size_t kind, size_t i)
{
    double part = (double)i + 1, start = (double)kind;
    return (struct spot){fmod(start * M_SQRT2 + part / PLASTIC, 1) * p->width,
                         fmod(start * M_E + part / (PLASTIC * PLASTIC), 1) * p->height};
}

/* Counts what stands in the way of the rock; returns its role. */
static enum ceduo_role role_at(struct plan *p, double y, double radius, enum ceduo_role otherwise)
{
    bool met = fabs(y - p->height / 2) < p->strip / 2 + radius;
    p->met += met;
    return met ? CEDUO_ROLE_WAY : otherwise;
}

/* ---- a stand ---- */

/* Stool i: a ring of whole shoots, now one more, now one less, so that the mean comes out. Where the picture is so small that
 * the ring would fall apart into dots, neighbours are joined. */
static void draw_stool(struct plan *p, size_t i)
{
    const struct ceduo_stand *s = p->stand;
    const struct spot at = spot_of(p, STOOLS, i);
    double all = ceduo_stand_shoots(s), mean = all / s->stools_per_ha, thickest = 0;
    double first = floor(mean * (double)i);
    int n = (int)fmin(floor(mean * ((double)i + 1)) - first, SHOOTS_MAX);
    double ring = n > 1 ? ceduo_stool_radius((unsigned)n, s->spacing) : 0;
    for (size_t k = 0; k < s->shoots_count; k++)
        thickest = fmax(thickest, s->shoots[k].dbh);
    enum ceduo_role role = n > 0 ? role_at(p, at.y, ring + thickest / 2, CEDUO_ROLE_STOOL) : CEDUO_ROLE_STOOL;
    for (int j = 0; j < n; j++) {
        double angle = 2 * M_PI * ((double)i * GOLDEN + (double)j / n), next = angle + 2 * M_PI / n;
        double x = at.x + ring * cos(angle), y = at.y + ring * sin(angle);
        double rank = fmod((first + j) * GOLDEN, 1) * all; /* among all shoots, cohort by cohort */
        size_t k = 0;
        while (k + 1 < s->shoots_count && rank >= s->shoots[k].per_ha)
            rank -= s->shoots[k++].per_ha;
        ceduo_canvas_disc(p->d->canvas, &p->d->frame, role, x, y, s->shoots[k].dbh / 2);
        if (s->spacing < JOINED_DOTS * p->dot)
            ceduo_canvas_line(p->d->canvas, &p->d->frame, role, x, y, at.x + ring * cos(next), at.y + ring * sin(next));
    }
}

/* Tree i of class k; those of a group stand evenly around a place of their own. */
static void draw_tree(struct plan *p, size_t k, size_t i)
{
    const struct ceduo_stems *stems = &p->stand->trees[k];
    size_t group = ceduo_stems_are_grouped(stems) ? (size_t)fmax(stems->group, 1) : 1;
    struct spot at = spot_of(p, TREES + k, i / group);
    if (group > 1) {
        double out = stems->group_radius * sqrt(((double)(i % group) + 0.5) / (double)group),
               angle = 2 * M_PI * GOLDEN * (double)i;
        at = (struct spot){at.x + out * cos(angle), at.y + out * sin(angle)};
    }
    enum ceduo_role role = role_at(p, at.y, stems->dbh / 2, CEDUO_ROLE_STEM);
    ceduo_canvas_disc(p->d->canvas, &p->d->frame, role, at.x, at.y, stems->dbh / 2);
}

/* Stumps and logs lie under what stands. */
static void draw_stems(struct plan *p, struct text *words)
{
    const struct ceduo_stand *s = p->stand;
    for (size_t i = 0, n = count_in(p, s->stumps.per_ha); i < n; i++) {
        struct spot at = spot_of(p, STUMPS, i);
        ceduo_canvas_disc(p->d->canvas, &p->d->frame, CEDUO_ROLE_DIM, at.x, at.y, s->stumps.diameter / 2);
    }
    for (size_t i = 0, n = count_in(p, s->logs.per_ha); i < n; i++) {
        struct spot at = spot_of(p, LOGS, i);
        double angle = M_PI * GOLDEN * (double)i, dx = s->logs.length / 2 * cos(angle), dy = s->logs.length / 2 * sin(angle);
        ceduo_canvas_line(p->d->canvas, &p->d->frame, CEDUO_ROLE_DIM, at.x - dx, at.y - dy, at.x + dx, at.y + dy);
    }
    for (size_t k = 0; k < s->trees_count; k++)
        for (size_t i = 0, n = count_in(p, s->trees[k].per_ha); i < n; i++)
            draw_tree(p, k, i);
    for (size_t i = 0, n = ceduo_stand_has_shoots(s) ? count_in(p, s->stools_per_ha) : 0; i < n; i++)
        draw_stool(p, i);
    ceduo_canvas_axis_bottom(p->d->canvas, &p->d->frame, _("m"));
    if (!ceduo_stand_has_stems(s)) {
        ceduo_text_append(words, _("No stems."));
        return;
    }
    ceduo_text_format(words, _("One pattern of many: %zu met"), p->met);
}

/* ---- the trajectory of the selected rock ---- */

/* A stem of the belt whose place in the plane is known. */
static bool is_in(const struct ceduo_belt *belt, const struct ceduo_stem_encounter *stem)
{
    return stem->x >= belt->from && stem->x <= belt->to && isfinite(stem->y);
}

/* Where the patch starts that shows the trajectory: around the last stem if that stands in the belt, otherwise at the first one
 * in it. False where there is none. */
static bool find_patch(const struct ceduo_drawing *d, double *from)
{
    const struct ceduo_stem_encounter *stems = d->picture->stems;
    const struct ceduo_belt *belt = d->belt;
    size_t n = d->picture->stems_count, first = 0;
    while (first < n && !is_in(belt, &stems[first]))
        first++;
    if (first == n)
        return false;
    *from = is_in(belt, &stems[n - 1]) ? stems[n - 1].x - PATCH_M / 2 : stems[first].x;
    *from = fmax(fmin(*from, belt->to - PATCH_M), belt->from);
    return true;
}

static bool is_shown(const struct plan *p, double from, const struct ceduo_stem_encounter *stem)
{
    return is_in(p->d->belt, stem) && stem->x >= from && stem->x <= from + p->width;
}

/* A strip less than a metre wide would be a line on 20 m: it fills the height, and offsets are stretched. Returns the
 * factor. */
static double stretch_across(struct plan *p, double from)
{
    const struct ceduo_picture *picture = p->d->picture;
    double half = 0.7 * p->strip, true_height = p->height;
    for (size_t i = 0; i < picture->stems_count; i++)
        if (is_shown(p, from, &picture->stems[i]))
            half = fmax(half, 1.1 * (fabs(picture->stems[i].y) + picture->stems[i].dbh / 2));
    p->height = p->d->frame.y1 = 2 * half;
    p->dot *= p->height / true_height;
    return true_height / p->height;
}

/* The stems that the rock came to from `from` on, at their places along and beside its trajectory. */
static void draw_way(struct plan *p, double from, struct text *words)
{
    const struct ceduo_picture *picture = p->d->picture;
    double metres = fmin(p->width, p->d->belt->to - from), factor = stretch_across(p, from);
    size_t hit = 0, flown_over = 0;
    for (size_t i = 0; i < picture->stems_count; i++) {
        const struct ceduo_stem_encounter *stem = &picture->stems[i];
        if (!is_shown(p, from, stem))
            continue;
        *(stem->hit ? &hit : &flown_over) += 1;
        ceduo_canvas_disc(p->d->canvas, &p->d->frame, stem->hit ? CEDUO_ROLE_WAY : CEDUO_ROLE_DIM, stem->x - from,
                          p->height / 2 + stem->y, stem->dbh / 2);
    }
    struct ceduo_frame given = ceduo_plot_given(&p->d->frame, from + p->d->scene->slope.origin_x, 0);
    ceduo_canvas_axis_bottom(p->d->canvas, &given, _("m"));
    ceduo_text_format(words,
                      ngettext("This trajectory: %zu stem hit in %.3g m", "This trajectory: %zu stems hit in %.3g m", hit), hit,
                      metres);
    ceduo_text_append_joined(words, "; ", _("across \xc3\x97%.2g"), factor);
    if (flown_over > 0)
        ceduo_text_append_joined(words, "; ", _("%zu flown over"), flown_over);
}

/* ---- the picture ---- */

const char *ceduo_plot_stand(struct ceduo_drawing *d)
{
    const struct ceduo_area *area = &d->area;
    if (!d->belt || area->width < 4 || area->height < 4)
        return _("no forest");
    bool has_words = area->height >= 7;
    double from;
    d->frame = (struct ceduo_frame){
        .left = area->left, .top = area->top, .width = area->width, .height = area->height - 2 - has_words};
    if (!ceduo_frame_true_scale(&d->frame, d->canvas, 0, PATCH_M, 0, 0))
        return NULL;
    d->frame.y1 -= d->frame.y0;
    d->frame.y0 = 0;
    struct plan p = {.d = d,
                     .stand = &d->belt->stand,
                     .width = PATCH_M,
                     .height = d->frame.y1,
                     .strip = ceduo_rock_mean(&d->scene->rock).mean_diameter,
                     .dot = d->frame.y1 / (d->frame.height * d->canvas->dots_y - 1)};
    LOCAL_TEXT(words);
    if (find_patch(d, &from))
        draw_way(&p, from, &words);
    else
        draw_stems(&p, &words);
    ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, (p.height - p.strip) / 2);
    ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, (p.height + p.strip) / 2);
    ceduo_plot_say(d->canvas, area->left, area->top + area->height - 1, has_words ? area->width : 0, CEDUO_ROLE_TEXT, "%s",
                   words.bytes);
    return NULL;
}
