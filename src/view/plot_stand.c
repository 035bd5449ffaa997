/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/language.h"
#include "base/must.h"
#include "plot_parts.h"

/* A stand from above, or a rock's trajectory through it. Places of a stand are drawn from a generator of its
 * own with a fixed seed, one stream for each kind of stem: when a number changes, the stems that stay do not move. */

#define PATCH_M     20.0 /* along the fall */
#define STEMS_MOST  8000 /* of one kind in a patch */
#define JOINED_DOTS 6    /* shoots closer than this are joined */
#define CROWD       2000 /* beyond this one place is as good as any other */
#define TRIES       20   /* to find a place clear of the others */
#define WORDS       4    /* ways to say what is met, the longest first */

struct generator {
    uint64_t state;
};

/* splitmix64 (Steele, Lea and Flood 2014), uniform in [0, 1). */
static double uniform(struct generator *g)
{
    uint64_t z = (g->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/* What stands somewhere, as a circle. */
struct foot {
    double x, y, radius; /* m */
};

struct plan {
    struct ceduo_canvas *canvas;
    struct ceduo_frame frame;
    const struct ceduo_stand *stand;
    double width, height, strip; /* m: the patch, and the rock's strip in its middle */
    double dot;                  /* m */
    struct foot *feet;
    size_t feet_count, met; /* stools and trees in the way of the rock */
};

/* How many of `per_ha` stand in the patch. */
static size_t count_in(const struct plan *p, double per_ha)
{
    double n = per_ha * p->width * p->height / 1e4;
    return n < STEMS_MOST ? (size_t)lround(n) : STEMS_MOST;
}

static bool in_strip(const struct plan *p, double y, double radius)
{
    return fabs(y - p->height / 2) < p->strip / 2 + radius;
}

/* ---- places ---- */

static bool clear_of_others(const struct plan *p, const struct foot *f)
{
    for (size_t i = 0; i < p->feet_count; i++)
        if (hypot(f->x - p->feet[i].x, f->y - p->feet[i].y) < f->radius + p->feet[i].radius)
            return false;
    return true;
}

/* A place for a circle, anywhere or in a disc; the last of the tries where none is clear. */
static struct foot find_place(struct plan *p, struct generator *g, double radius, const struct foot *disc)
{
    struct foot f = {.radius = radius};
    for (int i = 0; i < TRIES; i++) {
        double u = uniform(g), v = uniform(g);
        f.x = disc ? disc->x + disc->radius * sqrt(u) * cos(2 * M_PI * v) : u * p->width;
        f.y = disc ? disc->y + disc->radius * sqrt(u) * sin(2 * M_PI * v) : v * p->height;
        if (p->feet_count > CROWD || clear_of_others(p, &f))
            break;
    }
    p->feet[p->feet_count++] = f;
    return f;
}

/* Where shoot i of n stands on a ring. */
static struct foot on_ring(const struct foot *stool, double ring, double turn, int i, int n)
{
    double angle = 2 * M_PI * (turn + (double)i / n);
    return (struct foot){stool->x + ring * cos(angle), stool->y + ring * sin(angle), 0};
}

/* A stool: a ring of whole shoots, now one more, now one less, so that the mean comes out. Where the picture is so
 * small that the ring would fall apart into dots, neighbours are joined. */
static void draw_stool(struct plan *p, uint64_t number)
{
    struct generator g = {number};
    double mean = ceduo_stand_shoots(p->stand) / p->stand->stools_per_ha, u = uniform(&g), turn = uniform(&g);
    int n = (int)fmin(floor(mean) + (u < mean - floor(mean)), 200);
    double ring = n > 1 ? ceduo_stool_radius((unsigned)n, p->stand->spacing) : 0;
    double thickest = 0;
    for (size_t i = 0; i < p->stand->shoots_count; i++)
        thickest = fmax(thickest, p->stand->shoots[i].dbh);
    struct foot f = find_place(p, &g, ring + thickest / 2, NULL);
    bool met = n > 0 && in_strip(p, f.y, f.radius);
    enum ceduo_role role = met ? CEDUO_ROLE_WAY : CEDUO_ROLE_STOOL;
    p->met += met;
    for (int i = 0; i < n; i++) {
        struct foot a = on_ring(&f, ring, turn, i, n), b = on_ring(&f, ring, turn, i + 1, n);
        double rank = uniform(&g) * ceduo_stand_shoots(p->stand); /* among all shoots, cohort by cohort */
        size_t k = 0;
        while (k + 1 < p->stand->shoots_count && rank >= p->stand->shoots[k].per_ha)
            rank -= p->stand->shoots[k++].per_ha;
        ceduo_canvas_disc(p->canvas, &p->frame, role, a.x, a.y, p->stand->shoots[k].dbh / 2);
        if (p->stand->spacing < JOINED_DOTS * p->dot)
            ceduo_canvas_line(p->canvas, &p->frame, role, a.x, a.y, b.x, b.y);
    }
}

/* Tree i of class k; those of a group around a place of their own. */
static void draw_tree(struct plan *p, size_t k, size_t i)
{
    const struct ceduo_stems *stems = &p->stand->trees[k];
    bool grouped = ceduo_stems_are_grouped(stems);
    struct generator g = {((uint64_t)(k + 1) << 32) + i};
    struct generator around = {((uint64_t)(k + 1) << 48) + (grouped ? i / stems->group : i)};
    struct foot disc = {.radius = stems->group_radius};
    disc.x = uniform(&around) * p->width;
    disc.y = uniform(&around) * p->height;
    struct foot f = find_place(p, &g, stems->dbh / 2, grouped ? &disc : NULL);
    bool met = in_strip(p, f.y, f.radius);
    p->met += met;
    ceduo_canvas_disc(p->canvas, &p->frame, met ? CEDUO_ROLE_WAY : CEDUO_ROLE_STEM, f.x, f.y, f.radius);
}

/* Stumps and logs: under what stands. */
static void draw_low(struct plan *p)
{
    const struct ceduo_stumps *s = &p->stand->stumps;
    const struct ceduo_logs *l = &p->stand->logs;
    struct generator g = {(uint64_t)1 << 60};
    for (size_t i = 0, n = count_in(p, s->per_ha); i < n; i++) {
        double x = uniform(&g) * p->width, y = uniform(&g) * p->height;
        ceduo_canvas_disc(p->canvas, &p->frame, CEDUO_ROLE_DIM, x, y, s->diameter / 2);
    }
    g.state = (uint64_t)1 << 61;
    for (size_t i = 0, n = count_in(p, l->per_ha); i < n; i++) {
        double x = uniform(&g) * p->width, y = uniform(&g) * p->height, angle = M_PI * uniform(&g);
        double dx = l->length / 2 * cos(angle), dy = l->length / 2 * sin(angle);
        ceduo_canvas_line(p->canvas, &p->frame, CEDUO_ROLE_DIM, x - dx, y - dy, x + dx, y + dy);
    }
}

static void draw_stems(struct plan *p)
{
    const struct ceduo_stand *s = p->stand;
    size_t stools = ceduo_stand_has_shoots(s) ? count_in(p, s->stools_per_ha) : 0, all = stools;
    for (size_t k = 0; k < s->trees_count; k++)
        all += count_in(p, s->trees[k].per_ha);
    p->feet = ceduo_must(malloc((all + 1) * sizeof *p->feet));
    for (size_t k = 0; k < s->trees_count; k++)
        for (size_t i = 0, n = count_in(p, s->trees[k].per_ha); i < n; i++)
            draw_tree(p, k, i);
    for (size_t i = 0; i < stools; i++)
        draw_stool(p, i);
    free(p->feet);
}

/* ---- the trajectory of the selected rock ---- */

/* A stem of the belt whose place in the plane is known. */
static bool is_in(const struct ceduo_belt *belt, const struct ceduo_stem_passed *stem)
{
    return stem->x >= belt->from && stem->x <= belt->to && isfinite(stem->y);
}

/* Where the patch starts that shows the trajectory: around the last stem if that stands in the belt, otherwise at the
 * first one in it. False where there is none. */
static bool find_patch(const struct ceduo_picture *picture, const struct ceduo_belt *belt, double *from)
{
    const struct ceduo_stem_passed *stems = picture->stems;
    size_t n = picture->stems_count, first = 0;
    while (first < n && !is_in(belt, &stems[first]))
        first++;
    if (first == n)
        return false;
    *from = is_in(belt, &stems[n - 1]) ? stems[n - 1].x - PATCH_M / 2 : stems[first].x;
    *from = fmax(fmin(*from, belt->to - PATCH_M), belt->from);
    return true;
}

static bool is_shown(const struct plan *p, const struct ceduo_belt *belt, double from, const struct ceduo_stem_passed *stem)
{
    return is_in(belt, stem) && stem->x >= from && stem->x <= from + p->width;
}

/* A strip less than a metre wide would be a line on 20 m: it fills the height, and offsets are stretched. Returns the
 * factor. */
static double stretch_across(struct plan *p, const struct ceduo_picture *picture, double from)
{
    const struct ceduo_belt *belt = ceduo_plot_belt(picture);
    double half = 0.7 * p->strip, true_height = p->height;
    for (size_t i = 0; i < picture->stems_count; i++)
        if (is_shown(p, belt, from, &picture->stems[i]))
            half = fmax(half, 1.1 * (fabs(picture->stems[i].y) + picture->stems[i].dbh / 2));
    p->height = p->frame.y1 = 2 * half;
    p->dot *= p->height / true_height;
    return true_height / p->height;
}

/* The stems that the rock came to from `from` on, at their places along and beside its trajectory. */
static void draw_way(struct plan *p, const struct ceduo_picture *picture, double from, struct text words[WORDS])
{
    const struct ceduo_belt *belt = ceduo_plot_belt(picture);
    double metres = fmin(p->width, belt->to - from), factor = stretch_across(p, picture, from);
    size_t hit = 0, flown_over = 0;
    for (size_t i = 0; i < picture->stems_count; i++) {
        const struct ceduo_stem_passed *stem = &picture->stems[i];
        if (!is_shown(p, belt, from, stem))
            continue;
        *(stem->hit ? &hit : &flown_over) += 1;
        ceduo_canvas_disc(p->canvas, &p->frame, stem->hit ? CEDUO_ROLE_WAY : CEDUO_ROLE_DIM, stem->x - from,
                          p->height / 2 + stem->y, stem->dbh / 2);
    }
    struct ceduo_frame given = ceduo_plot_given(&p->frame, from + picture->scene->slope.origin_x, 0);
    ceduo_canvas_axis_bottom(p->canvas, &given, _("m"));
    ceduo_text_format(&words[3], ngettext("This rock: %zu hit in %.3g m", "This rock: %zu hits in %.3g m", hit), hit, metres);
    for (int i = 0; i < 3; i++)
        ceduo_text_format(
            &words[i],
            ngettext("The way of this rock: %zu stem hit in %.3g m", "The way of this rock: %zu stems hit in %.3g m", hit), hit,
            metres);
    if (flown_over > 0)
        ceduo_text_then(&words[0], ", ", _("%zu flown over"), flown_over);
    for (int i = 0; i < 2; i++)
        ceduo_text_then(&words[i], "; ", _("across \xc3\x97%.2g"), factor);
}

/* ---- the picture ---- */

const char *ceduo_plot_stand(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture)
{
    const struct ceduo_belt *belt = ceduo_plot_belt(picture);
    if (!belt || area->width < 4 || area->height < 4)
        return _("no forest");
    bool has_words = area->height >= 7;
    double from;
    struct plan p = {
        .canvas = canvas,
        .stand = &belt->stand,
        .strip = ceduo_rock_mean(&picture->scene->rock).mean_diameter,
        .frame = {.left = area->left, .top = area->top, .width = area->width, .height = area->height - 2 - has_words}};
    if (!ceduo_frame_true_scale(&p.frame, canvas, 0, PATCH_M, 0, 0))
        return NULL;
    p.width = PATCH_M;
    p.height = p.frame.y1 - p.frame.y0;
    p.frame.y1 = p.height;
    p.frame.y0 = 0;
    p.dot = p.height / (p.frame.height * canvas->dots_y - 1);
    struct text words[WORDS] = {{0}};
    if (find_patch(picture, belt, &from)) {
        draw_way(&p, picture, from, words);
    } else {
        draw_low(&p);
        draw_stems(&p);
        ceduo_canvas_axis_bottom(canvas, &p.frame, _("m"));
        bool none = !ceduo_stand_has_stems(p.stand);
        ceduo_text_format(&words[0], _("One pattern of many. The rock (%s m wide) meets %zu stools or trees in %g m."),
                          WRITTEN(p.strip, 2), p.met, PATCH_M);
        ceduo_text_format(&words[1], _("One pattern of many: %zu stools or trees are met"), p.met);
        for (int i = 2; i < WORDS; i++)
            ceduo_text_format(&words[i], _("One pattern of many: %zu met"), p.met);
        for (int i = 0; i < WORDS && none; i++) {
            ceduo_text_free(&words[i]);
            ceduo_text_put(&words[i], _("No stems: nothing stands in a rock's way."));
        }
    }
    ceduo_canvas_rule_y(canvas, &p.frame, CEDUO_ROLE_AXIS, (p.height - p.strip) / 2);
    ceduo_canvas_rule_y(canvas, &p.frame, CEDUO_ROLE_AXIS, (p.height + p.strip) / 2);
    ceduo_plot_put_fitting(canvas, area->left, area->top + area->height - 1, has_words ? area->width : 0, CEDUO_ROLE_TEXT,
                           WORDS, words);
    return NULL;
}
