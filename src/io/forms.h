/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_FORMS_H
#define CEDUO_FORMS_H

#include "ceduo/scene.h"
#include "schema.h"

/* What the files hold, field by field as they are written; ceduo_scene is made from it. */

struct material_form {
    double from, to;
    int material;
};

struct slope_form {
    const char *name;
    int facets;
    struct points vertices;
    struct list segments;  /* struct ceduo_segment */
    struct list materials; /* struct material_form */
    const char *csv;
};

struct stand_form {
    const char *name;
    const char *base; /* followed before the rest is read */
    int system, species; /* species: index into the list; -1: not said */
    double stools_per_ha, spacing;
    struct list shoots, trees; /* struct ceduo_stems */
    int energy;
    double u, fracture_ratio;
    struct ceduo_growth growth;
    uint64_t rotation, cohorts;
    struct numbers stay;
};

struct belt_form {
    double from, to;
    double cut_year;
    struct stand_form stand;
};

struct option_form {
    const char *name;
    struct list forest; /* struct belt_form */
};

struct control_form {
    double x;
    const char *name;
    double accepted, measured_speed;
};

struct rock_form {
    int shape;
    struct ceduo_number diameter, height, volume, mass, density, axes[3];
};

struct simulation_form {
    int law, contact_model, rule;
    uint64_t rocks, seed;
    double threshold, gravity;
    bool scale_rn;
};

struct scene_form {
    const char *title;
    struct rock_form rock;
    struct ceduo_release release;
    struct slope_form slope;
    struct list controls; /* struct control_form */
    struct numbers controls_m;
    struct list forest;  /* struct belt_form */
    struct list options; /* struct option_form */
    struct simulation_form simulation;
    double rocks_per_year, reserves_minimum;
};

/* The defaults of a scene. */
void ceduo_scene_form_init(void *form);

#endif
