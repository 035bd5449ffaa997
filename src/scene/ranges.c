/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ranges.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

#define ASSUMED N_("assumed")

#define STEMS "forest[0].stand.trees[0]."

static const struct range ranges[] = {
    {"rock.density_kg_m3",
     CEDUO_INPUT_RANGE,
     2400,
     2750,
     {0},
     N_("limestones and dolomites; assumed"),
     N_("a piece of the rock, weighed")},
    {"slope.segments[0].rn", CEDUO_INPUT_FACTOR, 0.9, 1.1, {0}, ASSUMED, N_("stops of past rocks")},
    {"slope.segments[0].rt", CEDUO_INPUT_FACTOR, 0.95, 1.05, {0}, ASSUMED, N_("stops of past rocks")},
    {"slope.segments[0].roughness_rad", CEDUO_INPUT_FACTOR, 0.5, 1.5, {0}, ASSUMED, N_("stops of past rocks")},
    {"slope.segments[0].roughness_m", CEDUO_INPUT_FACTOR, 0.5, 1.5, {0}, ASSUMED, N_("heights of the stones on the slope")},
    {"slope.segments[0].friction", CEDUO_INPUT_RANGE, 0.3, 0.8, {0}, ASSUMED, N_("stops of past rocks")},
    {"slope.segments[0].mu", CEDUO_INPUT_RANGE, 0.4, 0.9, {0}, ASSUMED, N_("stops of past rocks")},
    {"forest[0].stand.stools.per_ha",
     CEDUO_INPUT_FACTOR,
     0.85,
     1.15,
     {0},
     N_("error of a few sample plots; assumed"),
     N_("more sample plots")},
    {"forest[0].stand.shoots[0].per_stool",
     CEDUO_INPUT_FACTOR,
     0.85,
     1.15,
     {0},
     N_("error of a few sample plots; assumed"),
     N_("more sample plots")},
    {STEMS "per_ha", CEDUO_INPUT_FACTOR, 0.85, 1.15, {0}, N_("error of a few sample plots; assumed"), N_("more sample plots")},
    {STEMS "dbh_m", CEDUO_INPUT_FACTOR, 0.9, 1.1, {0}, N_("error of a few sample plots; assumed"), N_("dbh on more plots")},
    {STEMS "volume_m3",
     CEDUO_INPUT_FACTOR,
     0.75,
     1.25,
     {0},
     N_("volume tables of single stems; assumed"),
     N_("some stems, felled and measured")},
    {"forest[0].stand.energy.u_J_m3",
     CEDUO_INPUT_FACTOR,
     0.8,
     1.2,
     {0},
     ASSUMED,
     N_("pulling tests on stems of this species and size")},
    {"forest[0].stand.energy.fracture_ratio",
     CEDUO_INPUT_FACTOR,
     0.8,
     1.2,
     {0},
     ASSUMED,
     N_("pulling tests on stems of this species and size")},
    {"forest[0].stand.stumps.energy_kJ", CEDUO_INPUT_FACTOR, 0.5, 2, {0}, ASSUMED, N_("pulling tests on stumps")},
    {"forest[0].stand.logs.energy_kJ", CEDUO_INPUT_FACTOR, 0.5, 2, {0}, ASSUMED, N_("pulling tests on lying logs")},
    {"forest[0].stand.growth.trees_sdi_most",
     CEDUO_INPUT_FACTOR,
     0.5,
     2,
     {0},
     ASSUMED,
     N_("plots of full woods of these standards")},
    {"forest[0].stand.energy.model",
     CEDUO_INPUT_WORDS,
     NAN,
     NAN,
     {"brauner", "dorren"},
     N_("two published laws (Brauner et al. 2005; Dorren et al. 2006)"),
     NULL},
};

const struct range *ceduo_ranges(size_t *n)
{
    *n = sizeof ranges / sizeof ranges[0];
    return ranges;
}

/* Rows of shoots and trees are the same twice. */
static bool is_row(const struct field *a, const struct field *b)
{
    return a == b || (strcmp(a->key, b->key) == 0 && strcmp(a->meaning, b->meaning) == 0);
}

const struct range *ceduo_range_of(const struct field *field)
{
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++)
        if (is_row(ceduo_schema_at(ranges[i].path), field))
            return &ranges[i];
    return NULL;
}

struct range ceduo_range_of_material(const struct ceduo_material *m, const char *key)
{
    if (strcmp(key, "rn") == 0)
        return (struct range){NULL, CEDUO_INPUT_RANGE, m->rn_lo, m->rn_hi, {0}, m->source, NULL};
    if (strcmp(key, "rt") == 0)
        return (struct range){NULL, CEDUO_INPUT_RANGE, m->rt_lo, m->rt_hi, {0}, m->source, NULL};
    bool rough = strcmp(key, "roughness_rad") == 0;
    struct range r = *ceduo_range_of(ceduo_schema_field(ceduo_schema_segment(), key));
    if (rough) {
        r.lo *= m->roughness_rad;
        r.hi *= m->roughness_rad;
        r.kind = CEDUO_INPUT_RANGE;
    }
    return r;
}
