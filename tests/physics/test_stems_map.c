/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stems drawn lazily along a trajectory, compared with a full map in the plane. */
#include "ceduo/simulate.h"
#include "expect.h"

#include <stdlib.h>

#include "plane_map.h"
#include "stems_scene.h"

/* Compared statistics: positions along and across the trajectory, gaps, and counts. */
struct swept {
    struct sample per_trajectory, stools_per_trajectory, gap, per_stool, x, y, dbh;
};

static int by_stool(const void *a, const void *b)
{
    const struct map_stem *p = a, *q = b;
    return (p->stool > q->stool) - (p->stool < q->stool);
}

/* Add the stems of one trajectory, in order of x. */
static void swept_add(struct swept *s, struct map_stem *stems, size_t n)
{
    sample_add(&s->per_trajectory, (double)n);
    for (size_t i = 0; i < n; i++) {
        sample_add(&s->x, stems[i].x);
        sample_add(&s->y, stems[i].y);
        sample_add(&s->dbh, stems[i].dbh);
        if (i > 0)
            sample_add(&s->gap, stems[i].x - stems[i - 1].x);
    }
    qsort(stems, n, sizeof *stems, by_stool);
    double stools = 0;
    for (size_t i = 0, j; i < n; i = j) {
        for (j = i; j < n && stems[j].stool == stems[i].stool; j++)
            ;
        double size = (double)(j - i), square = size * size;
        stools++;
        s->x.squares += square;
        s->y.squares += square;
        s->dbh.squares += square;
        s->gap.squares += square;
        if (stems[i].shoot)
            sample_add(&s->per_stool, size);
    }
    sample_add(&s->stools_per_trajectory, stools);
}

static void swept_clear(struct swept *s)
{
    struct sample *all[] = {&s->per_trajectory, &s->stools_per_trajectory, &s->gap, &s->per_stool, &s->x, &s->y, &s->dbh};
    for (size_t i = 0; i < LENGTH(all); i++)
        sample_clear(all[i]);
}

static void sweep_trajectories(struct swept *to, uint64_t rocks)
{
    static struct map_stem stems[STEMS_MAX];
    for (SWEEP(rock, rocks)) {
        for (size_t i = 0; i < sweep.count; i++) {
            const struct ceduo_stem_encounter *p = &sweep.stems[i];
            stems[i] = (struct map_stem){p->x, p->y, p->dbh, p->shoot, p->stool, p->height, NAN};
            if (i > 0 && !(p->x >= p[-1].x))
                fail_msg("rock %ju comes to stems in the wrong order", (uintmax_t)rock);
        }
        swept_add(to, stems, sweep.count);
    }
}

static void sweep_maps(struct swept *to, uint64_t maps, unsigned long seed)
{
    static struct map_stem stems[STEMS_MAX];
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(rng, seed);
    for (uint64_t map = 0; map < maps; map++) {
        size_t n = plane_map_sweep(&plane.line.option, B, plane.line.scene.release.x.mean, rng, stems, STEMS_MAX);
        EXPECT(n, <=, STEMS_MAX);
        swept_add(to, stems, n);
    }
    gsl_rng_free(rng);
}

static void expect_same_as_map(const char *name, uint64_t trajectories, unsigned long seed)
{
    struct swept program = {0}, map = {0};
    sweep_trajectories(&program, trajectories);
    sweep_maps(&map, trajectories, seed);
    const struct {
        const char *label;
        struct sample *a, *b;
    } pairs[] = {{"hits per trajectory", &program.per_trajectory, &map.per_trajectory},
                 {"stools and trees per trajectory", &program.stools_per_trajectory, &map.stools_per_trajectory},
                 {"gaps", &program.gap, &map.gap},
                 {"hits per stool", &program.per_stool, &map.per_stool},
                 {"places", &program.x, &map.x},
                 {"offsets", &program.y, &map.y},
                 {"diameters", &program.dbh, &map.dbh}};
    for (size_t i = 0; i < LENGTH(pairs); i++) {
        if (pairs[i].a->n + pairs[i].b->n > 0)
            expect_same_law(named("%s, %s", name, pairs[i].label), pairs[i].a, pairs[i].b);
    }
    swept_clear(&program);
    swept_clear(&map);
}

TEST(stems_met_match_a_full_map)
{
    clear_plane(70);
    plant_plot(1, 10, 60);
    expect_same_as_map("ADS 1", 20000, 1);
}

TEST(stems_of_many_kinds_match_a_full_map)
{
    clear_plane(70);
    struct ceduo_belt *belt = plant_belt(10, 60, 1200, .45);
    plant_shoots(belt, 3500, .05);
    plant_shoots(belt, 1600, .25);
    plant_trees(belt, 700, .1);
    plant_trees(belt, 300, .6);
    expect_same_as_map("two cohorts, two classes", 20000, 2);
}

TEST(stems_next_to_a_gap_match_a_full_map)
{
    clear_plane(70);
    struct ceduo_belt *belt = plant_belt(10, 25, 900, 1.1); /* rings that reach far into the gap */
    plant_shoots(belt, 900 * 7.5, .08);
    plant_trees(belt, 400, .2);
    belt = plant_belt(28, 60, 1500, .3);
    plant_shoots(belt, 1500 * 1.6, .12);
    expect_same_as_map("two belts and a gap", 20000, 3);
}

TEST(stems_after_a_release_in_the_forest_match_a_full_map)
{
    clear_plane(70);
    struct ceduo_belt *belt = plant_belt(30, 60, 700, .4);
    plant_shoots(belt, 700 * 12, .07);
    plant_trees(belt, 300, .3);
    line_scene_release(&plane.line, 40, 1, 700, 0, 0);
    expect_same_as_map("released in a belt", 25000, 4);
}
