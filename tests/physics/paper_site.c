/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "paper_site.h"
#include "ceduo/scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double paper_x[PAPER_VERTICES] = {0,     10,    13,    26.95,  42.8,   48.11,  56.36,
                                        70.69, 84.66, 97.43, 115.42, 134.59, 144.33, 152.68};
const double paper_y[PAPER_VERTICES] = {126, 106, 86, 76, 66, 61, 56, 46, 36, 26, 16, 6, 2, 0};

static const double first_theta[2] = {0.25, 0.001}, first_rn[2] = {0.31, 0.40}, first_rt[2] = {0.87, 0.90};

const struct ceduo_growth paper_growth = {
    .shoots = {.16, .022, 14, .035}, .trees = {.45, .014, 20, .03}, .shoots_young = 16, .shoots_old = 3, .sdi_max = 1000};

double paper_theta(size_t segment)
{
    return segment < 2 ? first_theta[segment] : 0.15;
}

void paper_plot_init(struct paper_plot *plot, int number)
{
    bool one = number == 1;
    double all = one ? 9076 : 4641, single = one ? 750 : 542;
    struct ceduo_stems mean = {.dbh = one ? 0.061 : 0.047, .height = one ? 6 : 4, .volume = one ? 0.0107 : 0.0059, .age = NAN};
    plot->shoots = plot->trees = mean;
    plot->shoots.per_ha = all - single;
    plot->trees.per_ha = single;
    plot->stand = (struct ceduo_stand){.system = CEDUO_SYSTEM_SIMPLE_COPPICE,
                                       .species = ceduo_species_find("ostrya-carpinifolia"),
                                       .stools_per_ha = one ? 3688 : 2807,
                                       .spacing = 0.5,
                                       .shoots_count = 1,
                                       .trees_count = 1,
                                       .shoots = &plot->shoots,
                                       .trees = &plot->trees,
                                       .energy = CEDUO_ENERGY_MODEL_BRAUNER,
                                       .u = PAPER_U,
                                       .fracture_ratio = 1};
}

struct ceduo_stems paper_stems(double per_ha, double dbh, double height)
{
    return (struct ceduo_stems){.per_ha = per_ha, .dbh = dbh, .height = height, .volume = NAN, .age = NAN};
}

struct ceduo_stand paper_coppice(struct ceduo_stems *shoots, struct ceduo_stems *trees, size_t trees_count, unsigned rotation,
                                 double *stay)
{
    return (struct ceduo_stand){.system = CEDUO_SYSTEM_SIMPLE_COPPICE,
                                .species = ceduo_species_find("ostrya-carpinifolia"),
                                .stools_per_ha = 2500,
                                .spacing = .35,
                                .shoots_count = 1,
                                .trees_count = trees_count,
                                .shoots = shoots,
                                .trees = trees,
                                .u = NAN,
                                .fracture_ratio = 1.5,
                                .growth = paper_growth,
                                .cutting = {rotation, 1, 2, stay}};
}

static void init_slope(struct paper_site *site)
{
    for (size_t i = 0; i < PAPER_VERTICES; i++) {
        site->x[i] = paper_x[i];
        site->z[i] = paper_y[i] - PAPER_TOP;
    }
    for (size_t j = 0; j < PAPER_SEGMENTS; j++)
        site->segments[j] = (struct ceduo_segment){.rn = ceduo_number(j < 2 ? first_rn[j] : 0.31),
                                                   .rt = ceduo_number(j < 2 ? first_rt[j] : 0.83),
                                                   .friction = ceduo_segment_default().friction};
    site->scene.slope = (struct ceduo_slope){.facets = CEDUO_FACETS_AGAINST,
                                             .vertices = PAPER_VERTICES,
                                             .x = site->x,
                                             .z = site->z,
                                             .segments = site->segments,
                                             .origin_z = PAPER_TOP};
    paper_site_read_theta(site, PAPER_ANGLE);
}

static void init_forest(struct paper_site *site)
{
    static char names[2][6] = {"ADS 1", "ADS 2"};
    for (int i = 0; i < 2; i++) {
        paper_plot_init(&site->plots[i], i + 1);
        double from = 67.5 * i, to = from + 67.5;
        site->belts[i] = (struct ceduo_belt){
            .from = from, .to = to, .from_given = from, .to_given = to, .name = names[i], .stand = site->plots[i].stand};
    }
    site->option = (struct ceduo_option){.belts_count = 2, .belts = site->belts};
}

void paper_site_init(struct paper_site *site)
{
    memset(site, 0, sizeof *site);
    struct ceduo_scene *scene = &site->scene;
    scene->size = sizeof *scene;
    scene->rock = ceduo_scene_default().rock;
    scene->rock.shape = CEDUO_SHAPE_CYLINDER;
    scene->rock.diameter = ceduo_number(0.56);
    scene->rock.height = ceduo_number(0.80);
    scene->release.vx = ceduo_number(0.3);
    scene->release.vz = ceduo_number(-0.3);
    init_slope(site);
    init_forest(site);
    site->control = (struct ceduo_control){.x = 135, .x_given = 135, .accepted = 50e3, .measured_speed = 15.6};
    scene->controls_count = 1;
    scene->controls = &site->control;
    scene->options_count = 1;
    scene->options = &site->option;
    scene->simulation = ceduo_scene_default().simulation;
    scene->simulation.law = CEDUO_LAW_LUMPED;
    /* The paper's figures belong to the published laws; the friction bound gives 150 kJ instead of 115. */
    scene->simulation.friction_bound = false;
}

void paper_site_read_theta(struct paper_site *site, enum paper_theta theta)
{
    for (size_t j = 0; j < PAPER_SEGMENTS; j++) {
        site->segments[j].roughness_rad = theta == PAPER_ANGLE ? paper_theta(j) : NAN;
        site->segments[j].roughness_m = theta == PAPER_HEIGHT ? paper_theta(j) : NAN;
    }
}

void paper_site_smooth(struct paper_site *site)
{
    for (size_t j = 0; j < PAPER_SEGMENTS; j++) {
        site->segments[j].roughness_rad = NAN;
        site->segments[j].roughness_m = 0;
    }
}

void paper_site_sphere(struct paper_site *site)
{
    site->scene.rock = ceduo_scene_default().rock;
    site->scene.rock.diameter = ceduo_number(PAPER_B);
}
