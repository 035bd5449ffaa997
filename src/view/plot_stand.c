/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "core/stand/adc.h"
#include "plot.h"
#include "scene/stand.h"

/* A stand from above, or a rock's trajectory through it. Stems are spread evenly without randomness, each kind on its own.
 * If a number changes, the remaining stems do not move. */

#define PATCH_M     20.0 /* along the fall line */
#define STEMS_MAX   8000 /* per kind and patch */
#define SHOOTS_MAX  200  /* per stool */
#define JOINED_DOTS 6    /* shoots closer than this are connected */

#define GOLDEN  0.61803398874989485 /* multiples fill a circle evenly */
#define PLASTIC 1.32471795724474603 /* multiples of 1 / PLASTIC and 1 / PLASTIC² fill a square evenly (Roberts 2018) */

enum { STOOLS, STUMPS, LOGS, TREES }; /* kinds; each class of trees is one */

struct spot {
    double x, y; /* m */
};

struct plan {
    struct ceduo_drawing *d;
    const struct ceduo_stand *stand;
    double width, height, strip; /* m; the patch, and the rock's strip in its middle */
    double dot;                  /* size of a dot, m */
    size_t met;                  /* stools and trees in the rock's path */
};

/* Return the number of stems in the patch. */
static size_t count_stems(const struct plan *p, double per_ha)
{
    double n = per_ha * p->width * p->height / 1e4;
    return n < STEMS_MAX ? (size_t)lround(n) : STEMS_MAX;
}

/* Return the position of stem i of a kind. */
static struct spot place_stem(const struct plan *p, size_t kind, size_t i)
{
    double part = (double)i + 1, start = (double)kind;
    return (struct spot){fmod(start * M_SQRT2 + part / PLASTIC, 1) * p->width,
                         fmod(start * M_E + part / (PLASTIC * PLASTIC), 1) * p->height};
}

/* Return the role of a stem; count those in the rock's path. */
static enum ceduo_role count_role(struct plan *p, double y, double radius, enum ceduo_role otherwise)
{
    bool met = fabs(y - p->height / 2) < p->strip / 2 + radius;
    p->met += met;
    return met ? CEDUO_ROLE_TRAJECTORY : otherwise;
}

/* ---- stand ---- */

/* Draw stool i as a ring of shoots. Integer shoots per stool are dithered to the mean. Neighbours are connected if the ring
 * would become single dots. */
static void draw_stool(struct plan *p, size_t i)
{
    const struct ceduo_stand *s = p->stand;
    const struct spot spot = place_stem(p, STOOLS, i);
    double all = ceduo_stand_shoots(s), mean = all / s->stools_per_ha, thickest = 0;
    double first = floor(mean * (double)i);
    int n = (int)fmin(floor(mean * ((double)i + 1)) - first, SHOOTS_MAX);
    double ring = n > 1 ? ceduo_stool_radius((unsigned)n, s->spacing) : 0;
    for (size_t k = 0; k < s->shoots_count; k++)
        thickest = fmax(thickest, s->shoots[k].dbh);
    enum ceduo_role role = n > 0 ? count_role(p, spot.y, ring + thickest / 2, CEDUO_ROLE_STOOL) : CEDUO_ROLE_STOOL;
    for (int j = 0; j < n; j++) {
        double angle = 2 * M_PI * ((double)i * GOLDEN + (double)j / n), next = angle + 2 * M_PI / n;
        double x = spot.x + ring * cos(angle), y = spot.y + ring * sin(angle);
        double rank = fmod((first + j) * GOLDEN, 1) * all; /* index over all shoots, cohort by cohort */
        size_t k = 0;
        while (k + 1 < s->shoots_count && rank >= s->shoots[k].per_ha)
            rank -= s->shoots[k++].per_ha;
        ceduo_canvas_disc(p->d->canvas, &p->d->frame, role, x, y, s->shoots[k].dbh / 2);
        if (s->spacing < JOINED_DOTS * p->dot)
            ceduo_canvas_line(p->d->canvas, &p->d->frame, role, x, y, spot.x + ring * cos(next), spot.y + ring * sin(next));
    }
}

/* Draw tree i of class k; trees of a group are spread evenly around its centre. */
static void draw_tree(struct plan *p, size_t k, size_t i)
{
    const struct ceduo_stems *stems = &p->stand->trees[k];
    size_t group = ceduo_stems_are_grouped(stems) ? (size_t)fmax(stems->group, 1) : 1;
    struct spot spot = place_stem(p, TREES + k, i / group);
    if (group > 1) {
        double out = stems->group_radius * sqrt(((double)(i % group) + 0.5) / (double)group),
               angle = 2 * M_PI * GOLDEN * (double)i;
        spot = (struct spot){spot.x + out * cos(angle), spot.y + out * sin(angle)};
    }
    enum ceduo_role role = count_role(p, spot.y, stems->dbh / 2, CEDUO_ROLE_STEM);
    ceduo_canvas_disc(p->d->canvas, &p->d->frame, role, spot.x, spot.y, stems->dbh / 2);
}

/* Draw all stems; stumps and logs first. */
static void draw_patch(struct plan *p, struct text *words)
{
    const struct ceduo_stand *s = p->stand;
    for (size_t i = 0, n = count_stems(p, s->stumps.per_ha); i < n; i++) {
        struct spot spot = place_stem(p, STUMPS, i);
        ceduo_canvas_disc(p->d->canvas, &p->d->frame, CEDUO_ROLE_DIM, spot.x, spot.y, s->stumps.diameter / 2);
    }
    for (size_t i = 0, n = count_stems(p, s->logs.per_ha); i < n; i++) {
        struct spot spot = place_stem(p, LOGS, i);
        double angle = M_PI * GOLDEN * (double)i, dx = s->logs.length / 2 * cos(angle), dy = s->logs.length / 2 * sin(angle);
        ceduo_canvas_line(p->d->canvas, &p->d->frame, CEDUO_ROLE_DIM, spot.x - dx, spot.y - dy, spot.x + dx, spot.y + dy);
    }
    for (size_t k = 0; k < s->trees_count; k++)
        for (size_t i = 0, n = count_stems(p, s->trees[k].per_ha); i < n; i++)
            draw_tree(p, k, i);
    for (size_t i = 0, n = ceduo_stand_has_shoots(s) ? count_stems(p, s->stools_per_ha) : 0; i < n; i++)
        draw_stool(p, i);
    ceduo_canvas_axis_bottom(p->d->canvas, &p->d->frame, _("m"));
    if (!ceduo_stand_has_stems(s)) {
        ceduo_text_append(words, _("No stems."));
        return;
    }
    ceduo_text_format(words, _("One pattern of many: %zu met"), p->met);
}

/* ---- trajectory of the selected rock ---- */

/* True if the stem is in the belt and its lateral position is known. */
static bool is_in_belt(const struct ceduo_belt *belt, const struct ceduo_stem_encounter *stem)
{
    return stem->x >= belt->from && stem->x <= belt->to && isfinite(stem->y);
}

/* Find the start of the patch that shows the trajectory: around the last stem if it is in the belt, otherwise at the first
 * one in it. False if there is none. */
static bool find_patch(const struct ceduo_drawing *d, double *from)
{
    const struct ceduo_stem_encounter *stems = d->picture->stems;
    const struct ceduo_belt *belt = d->belt;
    size_t n = d->picture->stems_count, first = 0;
    while (first < n && !is_in_belt(belt, &stems[first]))
        first++;
    if (first == n)
        return false;
    *from = is_in_belt(belt, &stems[n - 1]) ? stems[n - 1].x - PATCH_M / 2 : stems[first].x;
    *from = fmax(fmin(*from, belt->to - PATCH_M), belt->from);
    return true;
}

static bool is_in_patch(const struct plan *p, double from, const struct ceduo_stem_encounter *stem)
{
    return is_in_belt(p->d->belt, stem) && stem->x >= from && stem->x <= from + p->width;
}

/* Stretch a narrow strip to the full height. Return the factor of offsets. */
static double stretch_across(struct plan *p, double from)
{
    const struct ceduo_picture *picture = p->d->picture;
    double half_height = 0.7 * p->strip, true_height = p->height;
    for (size_t i = 0; i < picture->stems_count; i++)
        if (is_in_patch(p, from, &picture->stems[i]))
            half_height = fmax(half_height, 1.1 * (fabs(picture->stems[i].y) + picture->stems[i].dbh / 2));
    p->height = p->d->frame.y1 = 2 * half_height;
    p->dot *= p->height / true_height;
    return true_height / p->height;
}

/* Draw the stems that the rock encountered from `from` on, at their positions along and across its trajectory. */
static void draw_trajectory(struct plan *p, double from, struct text *words)
{
    const struct ceduo_picture *picture = p->d->picture;
    double metres = fmin(p->width, p->d->belt->to - from), factor = stretch_across(p, from);
    size_t hit = 0, flown_over = 0;
    for (size_t i = 0; i < picture->stems_count; i++) {
        const struct ceduo_stem_encounter *stem = &picture->stems[i];
        if (!is_in_patch(p, from, stem))
            continue;
        *(stem->hit ? &hit : &flown_over) += 1;
        ceduo_canvas_disc(p->d->canvas, &p->d->frame, stem->hit ? CEDUO_ROLE_TRAJECTORY : CEDUO_ROLE_DIM, stem->x - from,
                          p->height / 2 + stem->y, stem->dbh / 2);
    }
    struct ceduo_frame given = ceduo_plot_user_frame(&p->d->frame, from + p->d->scene->slope.origin_x, 0);
    ceduo_canvas_axis_bottom(p->d->canvas, &given, _("m"));
    ceduo_text_format(words,
                      ngettext("This trajectory: %zu stem hit in %.3g m", "This trajectory: %zu stems hit in %.3g m", hit), hit,
                      metres);
    ceduo_text_append_joined(words, "; ", _("across \xc3\x97%.2g"), factor);
    if (flown_over > 0)
        ceduo_text_append_joined(words, "; ", _("%zu flown over"), flown_over);
}

/* ---- picture ---- */

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
        draw_trajectory(&p, from, &words);
    else
        draw_patch(&p, &words);
    ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, (p.height - p.strip) / 2);
    ceduo_canvas_rule_y(d->canvas, &d->frame, CEDUO_ROLE_AXIS, (p.height + p.strip) / 2);
    ceduo_plot_print(d->canvas, area->left, area->top + area->height - 1, has_words ? area->width : 0, CEDUO_ROLE_TEXT, "%s",
                     words.bytes);
    return NULL;
}
