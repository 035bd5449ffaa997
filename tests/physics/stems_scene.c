/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stems_scene.h"
#include "ceduo/simulate.h"

#include "expect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct plane plane;
struct sweep sweep;

void clear_ground(size_t vertices, const double *x, const double *z, double rn, double friction)
{
    line_scene_init(&plane.line, vertices, x, z, (struct line_ground){rn, 1, friction}, B / 2, CEDUO_LAW_LUMPED);
    memset(plane.belts, 0, sizeof plane.belts);
    plane.line.option.belts = plane.belts;
}

void clear_plane(double length)
{
    clear_ground(2, (double[]){0, length}, (double[]){0, 0}, .5, 0);
    line_scene_release(&plane.line, 0, 1, 10 * length, 0, 0);
}

struct ceduo_belt *plant_belt(double from, double to, double stools, double spacing)
{
    size_t i = plane.line.option.belts_count++;
    plane.belts[i] = (struct ceduo_belt){.from = from,
                                         .to = to,
                                         .stand = {.species = -1,
                                                   .stools_per_ha = stools,
                                                   .spacing = spacing,
                                                   .shoots = plane.shoots[i],
                                                   .trees = plane.trees[i],
                                                   .energy = CEDUO_ENERGY_MODEL_BRAUNER,
                                                   .u = 1,
                                                   .fracture_ratio = 1}};
    return &plane.belts[i];
}

static struct ceduo_stems light(double per_ha, double dbh)
{
    return (struct ceduo_stems){.per_ha = per_ha, .dbh = dbh, .height = 150, .volume = 1e-12, .age = NAN};
}

struct ceduo_stems *plant_shoots(struct ceduo_belt *belt, double per_ha, double dbh)
{
    struct ceduo_stems *s = &belt->stand.shoots[belt->stand.shoots_count++];
    *s = light(per_ha, dbh);
    return s;
}

struct ceduo_stems *plant_trees(struct ceduo_belt *belt, double per_ha, double dbh)
{
    struct ceduo_stems *s = &belt->stand.trees[belt->stand.trees_count++];
    *s = light(per_ha, dbh);
    return s;
}

void plant_plot(int number, double from, double to)
{
    struct paper_plot plot;
    paper_plot_init(&plot, number);
    struct ceduo_belt *belt = plant_belt(from, to, plot.stand.stools_per_ha, plot.stand.spacing);
    plant_shoots(belt, plot.shoots.per_ha, plot.shoots.dbh);
    plant_trees(belt, plot.trees.per_ha, plot.trees.dbh);
}

double per_metre(double per_ha, double width)
{
    return per_ha * width / 1e4;
}

void note_stem(void *context, const struct ceduo_stem_encounter *stem)
{
    struct sweep *s = context;
    if (s->count == STEMS_MAX)
        fail_msg("more than %d stems", STEMS_MAX);
    s->stems[s->count++] = *stem;
}

void sweep_begin(void)
{
    assert_int_equal(ceduo_scene_check(&plane.line.scene, NULL), CEDUO_OK);
    sweep.follower = ceduo_tracer_create(&plane.line.scene, &plane.line.option);
    assert_non_null(sweep.follower);
}

void sweep_end(void)
{
    ceduo_tracer_free(sweep.follower);
    sweep.follower = NULL;
}

void sweep_watched(uint64_t rock, const struct ceduo_trajectory_callbacks *watch)
{
    sweep.count = 0;
    assert_int_equal(ceduo_tracer_run(sweep.follower, rock, watch, &sweep.trajectory, NULL), CEDUO_OK);
}

void sweep_rock(uint64_t rock)
{
    sweep_watched(rock, &(struct ceduo_trajectory_callbacks){.stem = note_stem, .context = &sweep});
}

void sweep_one(uint64_t rock)
{
    sweep_begin();
    sweep_rock(rock);
    sweep_end();
}

bool sweep_next(uint64_t rock, uint64_t rocks)
{
    if (rock < rocks)
        sweep_rock(rock);
    else
        sweep_end();
    return rock < rocks;
}

static int by_number(const void *a, const void *b)
{
    const uint64_t *p = a, *q = b;
    return (*p > *q) - (*p < *q);
}

size_t count_different(bool shoots_only)
{
    static uint64_t numbers[STEMS_MAX];
    size_t n = 0, found = 0;
    for (size_t i = 0; i < sweep.count; i++)
        if (sweep.stems[i].hit && (sweep.stems[i].shoot || !shoots_only))
            numbers[n++] = sweep.stems[i].stool;
    qsort(numbers, n, sizeof *numbers, by_number);
    for (size_t i = 0; i < n; i++)
        found += i == 0 || numbers[i] != numbers[i - 1];
    return found;
}

struct met meet(uint64_t rocks, double metres)
{
    struct met m = {0};
    for (SWEEP(rock, rocks)) {
        size_t both = count_different(false);
        if (sweep.trajectory.stems_hit != sweep.count || sweep.trajectory.stools_met != both ||
            sweep.trajectory.end != CEDUO_END_LEFT_SLOPE || sweep.trajectory.stems_drawn < sweep.count)
            fail_msg("rock %ju: counts of the trajectory differ from its stems", (uintmax_t)rock);
        spread_add(&m.stems, (double)sweep.count / metres);
        spread_add(&m.both, (double)both / metres);
        double stools = (double)count_different(true) / metres;
        spread_add(&m.stools, stools);
        spread_add(&m.sum, (double)sweep.count / metres + stools);
    }
    return m;
}

double mean_printed_share(void)
{
    const int n = 20000;
    double sum = 0;
    for (int i = 0; i <= n; i++)
        sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * printed_share((double)i / n);
    return sum / (3 * n);
}
