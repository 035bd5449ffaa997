/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A small site with invented results; its rocks can also be simulated. */
#ifndef SITE_H
#define SITE_H

#include "core/runs/statistics.h"
#include "test.h"

#include <math.h>
#include <string.h>

#include "study/snapshot.h"

#define CELLS         10
#define ENERGIES      8
#define WOOD_ENERGIES 5

/* A slope of 100 m that falls 60 m, a path at 40 m and a road at 80 m, a coppice with standards between. Round numbers let a
 * reader check a picture by eye. Contains pointers into itself: never copy it. */
struct site {
    struct ceduo_scene scene;
    double x[3], z[3];
    struct ceduo_segment segments[2];
    struct ceduo_control controls[2];
    struct ceduo_option options[2];
    struct ceduo_belt belts[2];
    struct ceduo_stems shoots, trees;
    struct ceduo_snapshot snapshot;
    struct ceduo_run_snapshot bare, wood;
    struct ceduo_run_snapshot *wooded[2];
    struct ceduo_arrivals arrivals[2], wood_arrivals[2];
    struct ceduo_energies energies[2], wood_energies[2];
    struct ceduo_polyline line, wood_trail;
    double cell_x[CELLS], values[ENERGIES], wood_values[WOOD_ENERGIES];
    double trail_x[5], trail_z[5], wood_trail_x[3], wood_trail_z[3];
    struct ceduo_envelope envelopes[CELLS], wood_envelopes[CELLS];
};

static void set_ground(struct site *s)
{
    const double x[3] = {0, 50, 100}, z[3] = {0, -40, -60};
    memcpy(s->x, x, sizeof x);
    memcpy(s->z, z, sizeof z);
    for (int i = 0; i < 2; i++)
        s->segments[i] = (struct ceduo_segment){
            .rn = ceduo_number(0.4), .rt = ceduo_number(0.9), .roughness_m = NAN, .roughness_rad = 0.1, .friction = 0.3};
    s->scene.slope = (struct ceduo_slope){
        .facets = CEDUO_FACETS_AGAINST, .vertices = 3, .x = s->x, .z = s->z, .segments = s->segments, .origin_z = 60};
}

static void set_forest(struct site *s)
{
    s->shoots = (struct ceduo_stems){.per_ha = 2000, .dbh = 0.08, .height = 8, .volume = 0.02, .age = NAN};
    s->trees = (struct ceduo_stems){.per_ha = 100, .dbh = 0.3, .height = 20, .volume = 0.6, .age = NAN};
    s->belts[0] = (struct ceduo_belt){.from = 20,
                                      .to = 70,
                                      .from_given = 20,
                                      .to_given = 70,
                                      .name = "coppice",
                                      .assumed = true,
                                      .stand = {.system = CEDUO_SYSTEM_COPPICE_WITH_STANDARDS,
                                                .species = -1,
                                                .stools_per_ha = 800,
                                                .spacing = 0.5,
                                                .shoots_count = 1,
                                                .trees_count = 1,
                                                .shoots = &s->shoots,
                                                .trees = &s->trees,
                                                .u = 102800}};
    s->belts[1] = s->belts[0];
    s->belts[1].name = "cut";
    s->belts[1].assumed = false;
    s->belts[1].stand = (struct ceduo_stand){.system = CEDUO_SYSTEM_BARE, .species = -1, .u = NAN};
    s->options[0] = (struct ceduo_option){.name = "kept", .belts_count = 1, .belts = &s->belts[0]};
    s->options[1] = (struct ceduo_option){.name = "felled", .belts_count = 1, .belts = &s->belts[1]};
}

static const struct ceduo_envelope no_rock = {
    .mean_energy = NAN, .height = {NAN, NAN, NAN, NAN}, .energy = {NAN, NAN, NAN, NAN}};

/* Set heights of 1, 2, 3 m and energies that rise by 10 kJ per cell; eight rocks in ten reach the path. */
static void set_bare(struct site *s)
{
    static const double kj[ENERGIES] = {12, 21, 25, 33, 34, 38, 47, 55};
    static const double x[5] = {0, 20, 40, 60, 80}, z[5] = {0, -10, -30, -42, -52};
    for (int i = 0; i < CELLS; i++) {
        double e = 10e3 * (i + 1);
        s->cell_x[i] = 10 * i + 5;
        s->envelopes[i] = (struct ceduo_envelope){
            .passed = 8, .mean_energy = e, .height = {0.5, 1, 2, 3}, .energy = {0.5 * e, 0.9 * e, 1.5 * e, 2 * e}};
    }
    for (int i = 0; i < ENERGIES; i++)
        s->values[i] = 1e3 * kj[i];
    memcpy(s->trail_x, x, sizeof x);
    memcpy(s->trail_z, z, sizeof z);
    s->line = (struct ceduo_polyline){5, s->trail_x, s->trail_z};
    s->arrivals[0] =
        (struct ceduo_arrivals){.released = 10, .reached = 8, .exceeded = 2, .reach.mean = 0.8, .exceed.mean = 0.2};
    s->arrivals[0].limit = CEDUO_EXCEED_MAX;
    s->arrivals[0].energy = (struct ceduo_distribution){.mean = 33125, .p50 = 33e3, .p95 = 55e3, .max = 55e3};
    s->arrivals[1] = (struct ceduo_arrivals){.released = 10, .exceed.mean = NAN};
    s->arrivals[1].energy = ceduo_distribution_none();
    s->energies[0] = (struct ceduo_energies){ENERGIES, s->values};
    s->energies[1] = (struct ceduo_energies){0, s->values};
    s->bare = (struct ceduo_run_snapshot){.references = 1,
                                          .simulated = {.rocks = 10, .controls = 2, .arrivals = s->arrivals},
                                          .envelope_rocks = 10,
                                          .envelopes = s->envelopes,
                                          .energies = s->energies,
                                          .trajectories_count = 1,
                                          .trajectories = &s->line};
}

/* Set lower and slower rocks, at most to 70 m; five in ten reach the path. */
static void set_wood(struct site *s)
{
    static const double kj[WOOD_ENERGIES] = {8, 15, 21, 25, 41};
    static const double x[3] = {0, 20, 40}, z[3] = {0, -12, -32};
    for (int i = 0; i < CELLS; i++) {
        double e = i < 4 ? 8e3 * (i + 1) : 32e3 - 8e3 * (i - 3);
        s->wood_envelopes[i] = (struct ceduo_envelope){
            .passed = 5, .mean_energy = e, .height = {0.3, 0.6, 1.5, 2}, .energy = {0.5 * e, 0.9 * e, 1.5 * e, 2 * e}};
        if (i >= 7)
            s->wood_envelopes[i] = no_rock;
    }
    for (int i = 0; i < WOOD_ENERGIES; i++)
        s->wood_values[i] = 1e3 * kj[i];
    memcpy(s->wood_trail_x, x, sizeof x);
    memcpy(s->wood_trail_z, z, sizeof z);
    s->wood_trail = (struct ceduo_polyline){3, s->wood_trail_x, s->wood_trail_z};
    s->wood_arrivals[0] =
        (struct ceduo_arrivals){.released = 10, .reached = 5, .exceeded = 1, .reach.mean = 0.5, .exceed.mean = 0.1};
    s->wood_arrivals[0].limit = CEDUO_EXCEED_MAX;
    s->wood_arrivals[0].energy = (struct ceduo_distribution){.mean = 22e3, .p50 = 21e3, .p95 = 41e3, .max = 41e3};
    s->wood_arrivals[1] = s->arrivals[1];
    s->wood_energies[0] = (struct ceduo_energies){WOOD_ENERGIES, s->wood_values};
    s->wood_energies[1] = (struct ceduo_energies){0, s->wood_values};
    s->wood = (struct ceduo_run_snapshot){.references = 1,
                                          .key = 1,
                                          .simulated = {.rocks = 10, .controls = 2, .arrivals = s->wood_arrivals},
                                          .envelope_rocks = 10,
                                          .envelopes = s->wood_envelopes,
                                          .energies = s->wood_energies,
                                          .trajectories_count = 1,
                                          .trajectories = &s->wood_trail};
}

static void site_init(struct site *s)
{
    *s = (struct site){.scene = {.size = sizeof(struct ceduo_scene),
                                 .title = "small",
                                 .rock = ceduo_scene_default().rock,
                                 .simulation = ceduo_scene_default().simulation,
                                 .controls_count = 2,
                                 .controls = s->controls,
                                 .options_count = 2,
                                 .options = s->options}};
    s->scene.rock.diameter = ceduo_number(0.8);
    s->scene.release.vx = ceduo_number(1);
    s->controls[0] = (struct ceduo_control){40, 40, .name = "path", .accepted = 40e3, .measured_speed = NAN};
    s->controls[1] = (struct ceduo_control){80, 80, .accepted = NAN, .measured_speed = NAN};
    set_ground(s);
    set_forest(s);
    set_bare(s);
    set_wood(s);
    s->snapshot = (struct ceduo_snapshot){
        .cells = CELLS, .controls = 2, .options = 2, .cell_x = s->cell_x, .bare = &s->bare, .wooded = s->wooded};
    s->scene.simulation.contact_model = CEDUO_CONTACT_MODEL_INDEX;
    assert_int_equal(ceduo_scene_check(&s->scene, NULL), CEDUO_OK);
}

/* The same site with rocks among stems. An area without stems has the results without forest. */
static void wooded_site_init(struct site *s)
{
    site_init(s);
    s->scene.simulation.contact_model = CEDUO_CONTACT_MODEL_STEMS;
    s->wooded[0] = &s->wood;
    s->wooded[1] = &s->bare;
}

#endif
