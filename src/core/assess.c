/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/assess.h"

#include <math.h>

/* The figures that need only stand and rock; per metre of belt. */
static struct ceduo_stand_result assess_per_length(const struct ceduo_scene *scene, const struct ceduo_stand *stand,
                                                   double length)
{
    double b = ceduo_rock_mean(&scene->rock).mean_diameter;
    bool bare = ceduo_stand_is_bare(stand);
    enum ceduo_rule rule = ceduo_adc_rule(stand, b, scene->simulation.rule);
    struct ceduo_adc adc = bare ? (struct ceduo_adc){INFINITY, INFINITY, INFINITY, INFINITY} : ceduo_adc(stand, b);
    double trees = ceduo_stand_trees(stand);
    struct ceduo_stand_result r = {.length = length,
                                   .stems_per_ha = ceduo_stand_shoots(stand) + trees,
                                   .stools_per_ha = ceduo_stand_has_shoots(stand) ? stand->stools_per_ha : 0,
                                   .trees_per_ha = trees,
                                   .basal_area = ceduo_stand_basal_area(stand),
                                   .bare = bare,
                                   .rule = rule,
                                   .adc = adc,
                                   .adc_m = bare ? INFINITY : ceduo_adc_value(&adc, rule)};
    r.passes_threshold = r.adc_m < scene->simulation.threshold;
    r.free_run_probability = exp(-scene->simulation.threshold / adc.crofton);
    r.contacts = length / r.adc_m;
    r.dissipated = bare ? 0 : length * ceduo_energy_per_metre(stand, b, rule);
    r.per_100m = r.dissipated / length * 100;
    r.energy_per_contact = bare ? NAN : ceduo_energy_per_metre(stand, b, rule) * r.adc_m;
    r.warnings = ceduo_stand_warnings(stand, b, scene->simulation.rule);
    return r;
}

enum ceduo_light ceduo_energy_light(const struct ceduo_arrivals *a)
{
    if (!a || isnan(a->exceed_probability))
        return CEDUO_UNKNOWN;
    if (!(a->exceed_probability <= CEDUO_EXCEED_MOST))
        return CEDUO_FAIL;
    double unfinished = (double)a->unfinished / (double)a->released;
    return a->exceed_probability + unfinished <= CEDUO_EXCEED_MOST ? CEDUO_PASS : CEDUO_UNKNOWN;
}

struct ceduo_stand_result ceduo_assess_stand(const struct ceduo_scene *scene, const struct ceduo_belt *belt)
{
    struct ceduo_stand_result r = assess_per_length(scene, &belt->stand, belt->to - belt->from);
    r.felled = belt->felled;
    return r;
}

/* Adds the part of a belt between a and b to an index. */
static void add_belt(const struct ceduo_scene *scene, const struct ceduo_belt *belt, double a, double b,
                     struct ceduo_index *index)
{
    struct ceduo_stand_result r = assess_per_length(scene, &belt->stand, b - a);
    index->length += r.bare ? 0 : b - a;
    index->worst_adc = fmax(index->worst_adc, r.adc_m);
    index->contacts += r.contacts;
    index->dissipated += r.dissipated;
    index->meet_nothing_probability *= exp(-(b - a) / r.adc.crofton);
    index->worst_free_run = fmax(index->worst_free_run, r.free_run_probability);
    index->contact_passes &= r.passes_threshold;
}

struct ceduo_index ceduo_assess_index(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      const struct ceduo_control *control, double bare_mean)
{
    double start = scene->release.x.mean, at = start;
    struct ceduo_index index = {.meet_nothing_probability = 1, .contact_passes = true};
    size_t belts = 0;
    for (size_t i = 0; i < option->belts_count; i++) {
        const struct ceduo_belt *belt = &option->belts[i];
        double a = fmax(belt->from, start), b = fmin(belt->to, control->x);
        if (!(b > a))
            continue;
        add_belt(scene, belt, a, b, &index);
        belts++;
        if (ceduo_stand_is_bare(&belt->stand))
            continue;
        index.longest_gap = fmax(index.longest_gap, a - at);
        at = b;
    }
    index.longest_gap = fmax(index.longest_gap, control->x - at);
    if (belts == 0) {
        index.contact_passes = false;
        index.worst_free_run = 1;
        index.worst_adc = INFINITY;
    }
    index.per_100m = index.length > 0 ? index.dissipated / index.length * 100 : 0;
    index.contact_passes &= !(index.longest_gap > scene->simulation.threshold);
    index.contact = index.contact_passes ? CEDUO_PASS : CEDUO_FAIL;
    index.free_run = index.worst_free_run <= CEDUO_FREE_RUN_MOST ? CEDUO_PASS : CEDUO_FAIL;
    index.energy = CEDUO_UNKNOWN;
    index.exhausted = bare_mean < index.dissipated;
    index.residual = isnan(bare_mean) ? NAN : fmax(0, bare_mean - index.dissipated);
    index.measured =
        0.5 * ceduo_rock_mean(&scene->rock).mass * control->measured_speed * control->measured_speed;
    return index;
}
