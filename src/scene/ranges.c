/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ranges.h"

#include <math.h>
#include <string.h>

#include "base/language.h"

#define ASSUMED N_("assumed")

#define PLOTS  N_("error of a few sample plots; assumed")
#define AGED   N_("dbh of stems of known age")
#define TALL   N_("heights of stems of known age")
#define COUNTS N_("shoots counted on stools of known age")
#define PULLED N_("pulling tests on stems of this species and size")

#define SEGMENT "slope.segments[0]."
#define STAND   "forest[0].stand."
#define STEMS   "forest[0].stand.trees[0]."
#define GROWTH  STAND "growth."
#define CURVE   GROWTH "shoots." /* trees have the same keys */

#define ROW(row_kind, row_path, row_lo, row_hi, row_source, how)                                                               \
    {                                                                                                                          \
        .path = row_path, .kind = CEDUO_INPUT_##row_kind, .lo = row_lo, .hi = row_hi, .source = row_source, .measured = how    \
    }

/* `word` or dorren; only research can decide. */
#define ROW_WORDS(row_path, word, row_source)                                                                                  \
    {                                                                                                                          \
        .path = row_path, .kind = CEDUO_INPUT_WORDS, .lo = NAN, .hi = NAN, .words = {word, "dorren"}, .source = row_source,    \
        .measured = N_("full-scale tests on such stems"), .research = true                                                     \
    }

static const struct range ranges[] = {
    ROW(RANGE, "rock.density_kg_m3", 2400, 2750, N_("limestones and dolomites; assumed"), N_("a piece of the rock, weighed")),
    ROW(FACTOR, SEGMENT "rn", 0.9, 1.1, ASSUMED, N_("stops of past rocks")),
    ROW(FACTOR, SEGMENT "rt", 0.95, 1.05, ASSUMED, N_("stops of past rocks")),
    ROW(FACTOR, SEGMENT "roughness_rad", 0.5, 1.5, ASSUMED, N_("stops of past rocks")),
    ROW(FACTOR, SEGMENT "roughness_m", 0.5, 1.5, ASSUMED, N_("heights of the stones on the slope")),
    ROW(RANGE, SEGMENT "friction", 0.3, 0.8, ASSUMED, N_("stops of past rocks")),
    ROW(RANGE, SEGMENT "mu", 0.4, 0.9, ASSUMED, N_("stops of past rocks")),
    ROW(RANGE, "slope.tolerance_m", 0.25, 1, ASSUMED, NULL),
    ROW(FACTOR, STAND "stools.per_ha", 0.85, 1.15, PLOTS, N_("more sample plots")),
    ROW(FACTOR, STAND "shoots[0].per_stool", 0.85, 1.15, PLOTS, N_("more sample plots")),
    ROW(FACTOR, STEMS "per_ha", 0.85, 1.15, PLOTS, N_("more sample plots")),
    ROW(FACTOR, STEMS "dbh_m", 0.9, 1.1, PLOTS, N_("dbh on more plots")),
    ROW(FACTOR, STEMS "volume_m3", 0.75, 1.25, N_("volume tables of single stems; assumed"),
        N_("some stems, felled and measured")),
    ROW(FACTOR, STAND "energy.u_J_m3", 0.8, 1.2, ASSUMED, PULLED),
    ROW(FACTOR, STAND "energy.fracture_ratio", 0.8, 1.2, ASSUMED, PULLED),
    ROW(FACTOR, STAND "stumps.energy_kJ", 0.5, 2, ASSUMED, N_("pulling tests on stumps")),
    ROW(FACTOR, STAND "logs.energy_kJ", 0.5, 2, ASSUMED, N_("pulling tests on lying logs")),
    ROW(FACTOR, CURVE "dbh_most_m", 0.85, 1.15, ASSUMED, AGED),
    ROW(FACTOR, CURVE "dbh_rate_1_y", 0.8, 1.2, ASSUMED, AGED),
    ROW(FACTOR, CURVE "height_most_m", 0.85, 1.15, ASSUMED, TALL),
    ROW(FACTOR, CURVE "height_rate_1_y", 0.8, 1.2, ASSUMED, TALL),
    ROW(FACTOR, GROWTH "shoots_young", 0.75, 1.25, ASSUMED, COUNTS),
    ROW(FACTOR, GROWTH "shoots_old", 0.75, 1.25, ASSUMED, COUNTS),
    ROW(FACTOR, GROWTH "sdi_most", 0.8, 1.2, ASSUMED, N_("plots of full coppices of this species")),
    ROW(FACTOR, GROWTH "trees_sdi_most", 0.5, 2, ASSUMED, N_("plots of full forests of these standards")),
    ROW_WORDS(STAND "energy.model", "brauner", N_("two published laws (Brauner et al. 2005; Dorren et al. 2006)")),
    ROW_WORDS(STAND "energy.offset", "whole", N_("two published choices (Ciabocco et al. 2009; Dorren et al. 2006)")),
};

const struct range *ceduo_ranges(size_t *n)
{
    *n = sizeof ranges / sizeof ranges[0];
    return ranges;
}

const struct range *ceduo_range_find(const struct field *field)
{
    for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; i++) {
        const struct field *row = ceduo_schema_at(ranges[i].path); /* shoots and trees have equal rows */
        if (row == field || (strcmp(row->key, field->key) == 0 && strcmp(row->meaning, field->meaning) == 0))
            return &ranges[i];
    }
    return NULL;
}

struct range ceduo_range_find_material(const struct ceduo_material *m, const char *key)
{
    const struct {
        const char *key, *source;
        double lo, hi;
    } material_ranges[] = {{"rn", m->source, m->rn_lo, m->rn_hi},
                           {"rt", m->source, m->rt_lo, m->rt_hi},
                           {"roughness_m", ASSUMED, m->roughness_lo, m->roughness_hi},
                           {"friction", ASSUMED, m->friction_lo, m->friction_hi}};
    const struct range *r = ceduo_range_find(ceduo_schema_field(ceduo_schema_segment(), key));
    for (size_t i = 0; i < sizeof material_ranges / sizeof material_ranges[0]; i++)
        if (strcmp(key, material_ranges[i].key) == 0)
            return (struct range){.kind = CEDUO_INPUT_RANGE,
                                  .lo = material_ranges[i].lo,
                                  .hi = material_ranges[i].hi,
                                  .source = material_ranges[i].source,
                                  .measured = r->measured};
    return *r;
}
