/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>

#include "assess.h"
#include "core/stand/adc.h"
#include "core/stand/strata.h"
#include "scene/regulation.h"
#include "scene/stand.h"

/* ---- counted stems ---- */

static struct ceduo_stand count_from_dbh(const struct ceduo_stand *stand, double dbh)
{
    struct ceduo_stand counted = *stand;
    counted.counted_from = dbh;
    return counted;
}

/* The lights do not count stumps and logs, because rocks fly over them. */
static struct ceduo_stand count_standing_from(const struct ceduo_stand *stand, double dbh)
{
    struct ceduo_stand counted = count_from_dbh(stand, dbh);
    counted.stumps.per_ha = counted.logs.per_ha = 0;
    return counted;
}

/* Return the correction of the exponent for groups: trees of a group are met together, so a path without contacts is likelier
 * than by crofton, which assumes independent trees. `finite`: no tree on `length` m; otherwise no group with its centre
 * there. */
static double group_correction(const struct ceduo_stand *stand, double b, double length, bool finite)
{
    double correction = 0;
    for (size_t i = 0; i < stand->trees_count; i++) {
        const struct ceduo_stems *t = &stand->trees[i];
        if (!ceduo_stems_are_grouped(t) || !(t->dbh >= stand->counted_from))
            continue;
        struct group_shape shape = {.n = t->group, .radius = t->group_radius, .width = b + t->dbh};
        double groups_met = finite ? ceduo_groups_met_within(&shape, length) : ceduo_groups_met_along(&shape, length);
        correction += t->per_ha / HECTARE * (length * shape.width - groups_met / t->group);
    }
    return correction;
}

static double no_contact_probability(double contacts, double correction)
{
    return exp(fmin(0, correction - contacts));
}

/* ADC (m) and probability of a free run of the counted stems. */
struct contact_frequency {
    double adc, free_run;
};

static struct contact_frequency assess_counted(const struct ceduo_scene *scene, const struct ceduo_stand *counted)
{
    double b = ceduo_rock_mean(&scene->rock).mean_diameter, threshold = scene->simulation.threshold;
    struct ceduo_adc adc = ceduo_adc(counted, b);
    if (isinf(adc.crofton))
        return (struct contact_frequency){INFINITY, 1};
    return (struct contact_frequency){
        ceduo_adc_value(&adc, ceduo_adc_rule(counted, b, scene->simulation.rule)),
        no_contact_probability(threshold / adc.crofton, group_correction(counted, b, threshold, true))};
}

/* Counting fewer stems must not shorten the ADC, although forms with the mean diameter can. */
static struct contact_frequency assess_contacts(const struct ceduo_scene *scene, const struct ceduo_stand *stand, double dbh)
{
    const struct ceduo_stand all = count_standing_from(stand, scene->simulation.contact_dbh),
                             thick = count_standing_from(stand, dbh);
    struct contact_frequency frequency = assess_counted(scene, &all), fewer = assess_counted(scene, &thick);
    return (struct contact_frequency){fmax(frequency.adc, fewer.adc), fmax(frequency.free_run, fewer.free_run)};
}

static void add_belt_check(const struct ceduo_scene *scene, const struct ceduo_stand *stand, double dbh,
                           struct ceduo_contact_check *meeting)
{
    struct contact_frequency frequency = assess_contacts(scene, stand, dbh);
    meeting->worst_adc = fmax(meeting->worst_adc, frequency.adc);
    meeting->worst_free_run = fmax(meeting->worst_free_run, frequency.free_run);
    if (!(frequency.adc < scene->simulation.threshold)) /* true for NaN */
        meeting->contact = CEDUO_LIGHT_FAIL;
}

static void finish_check(const struct ceduo_scene *scene, bool forest, double longest_gap, struct ceduo_contact_check *meeting)
{
    if (!forest)
        *meeting = (struct ceduo_contact_check){.worst_adc = INFINITY, .worst_free_run = 1};
    double threshold = scene->simulation.threshold;
    if (!forest || longest_gap > threshold)
        meeting->contact = CEDUO_LIGHT_FAIL;
    bool rare = meeting->worst_free_run <= CEDUO_FREE_RUN_MAX && !(longest_gap > threshold);
    meeting->free_run = rare ? CEDUO_LIGHT_PASS : CEDUO_LIGHT_FAIL;
}

bool ceduo_index_depends_on_thin_stems(const struct ceduo_index *index)
{
    return index->contact != index->thick.contact || index->free_run != index->thick.free_run;
}

/* ---- belts ---- */

struct ceduo_stand_result ceduo_assess_stand(const struct ceduo_scene *scene, const struct ceduo_belt *belt)
{
    const struct ceduo_stand *stand = &belt->stand;
    double length = belt->to - belt->from;
    double b = ceduo_rock_mean(&scene->rock).mean_diameter;
    const struct ceduo_stand counted = count_from_dbh(stand, scene->simulation.contact_dbh);
    enum ceduo_rule rule = ceduo_adc_rule(&counted, b, scene->simulation.rule);
    struct ceduo_adc adc = ceduo_adc(&counted, b);
    double adc_m = ceduo_adc_value(&adc, rule);
    struct contact_frequency frequency = assess_contacts(scene, stand, scene->simulation.contact_dbh);
    double trees = ceduo_stand_trees(stand);
    struct ceduo_stand_result r = {.length = length,
                                   .stems_per_ha = ceduo_stand_shoots(stand) + trees,
                                   .stools_per_ha = ceduo_stand_has_shoots(stand) ? stand->stools_per_ha : 0,
                                   .trees_per_ha = trees,
                                   .basal_area = ceduo_stand_basal_area(stand),
                                   .bare = ceduo_stand_is_bare(stand),
                                   .felled = belt->felled,
                                   .rule = rule,
                                   .adc = adc,
                                   .adc_m = adc_m};
    r.passes_threshold = frequency.adc < scene->simulation.threshold;
    r.free_run_probability = frequency.free_run;
    r.contacts = length / r.adc_m;
    r.dissipated = isinf(adc_m) ? 0 : length * ceduo_energy_per_metre(&counted, b, rule);
    r.per_100m = r.dissipated / length * 100;
    r.energy_per_contact = isinf(adc_m) ? NAN : ceduo_energy_per_metre(&counted, b, rule) * adc_m;
    r.rules = ceduo_regulation_check(&scene->rules, stand);
    r.warnings = ceduo_stand_warnings(&counted, b, scene->simulation.rule);
    for (size_t i = 0; i < stand->trees_count; i++)
        r.grouped_per_ha += ceduo_stems_are_grouped(&stand->trees[i]) ? stand->trees[i].per_ha : 0;
    r.stumps_per_ha = stand->stumps.per_ha;
    r.logs_per_ha = stand->logs.per_ha;
    return r;
}

enum ceduo_light ceduo_energy_light(const struct ceduo_arrivals *a)
{
    if (!a || isnan(a->exceed.mean))
        return CEDUO_LIGHT_UNKNOWN;
    if (!(a->exceed.mean <= a->limit))
        return CEDUO_LIGHT_FAIL;
    double unfinished = (double)a->unfinished / (double)a->released;
    return a->exceed.mean + unfinished <= a->limit ? CEDUO_LIGHT_PASS : CEDUO_LIGHT_UNKNOWN;
}

/* ---- judgement ---- */

#define DEGREES (180 / M_PI)

enum ceduo_terrain ceduo_terrain(const struct ceduo_arrivals *bare)
{
    const struct ceduo_topography *t = &bare->topography;
    double all = (double)bare->released, may_arrive = (double)(bare->reached + bare->unfinished);
    bool steep = t->reach * DEGREES > CEDUO_REACH_STEEP || t->shadow * DEGREES > CEDUO_SHADOW_STEEP;
    if (bare->released > 0 && steep && may_arrive < CEDUO_ARRIVE_FEW * all)
        return t->bench >= CEDUO_BENCH_LENGTH ? CEDUO_TERRAIN_BENCH : CEDUO_TERRAIN_CONTRADICTS;
    bool many = (double)bare->reached > CEDUO_ARRIVE_MANY * all;
    bool beyond = t->reach < M_PI_4; /* not directly below the face */
    return many && beyond && t->shadow * DEGREES < CEDUO_SHADOW_FLAT ? CEDUO_TERRAIN_FAR : CEDUO_TERRAIN_AGREES;
}

bool ceduo_too_few_arrivals(const struct ceduo_arrivals *bare)
{
    uint64_t may_arrive = bare->reached + bare->unfinished;
    bool few = bare->released >= CEDUO_ARRIVE_MIN && may_arrive * CEDUO_ARRIVE_MIN < bare->released;
    return bare->released > 0 && (may_arrive == 0 || few || ceduo_terrain(bare) == CEDUO_TERRAIN_CONTRADICTS);
}

enum ceduo_judgement ceduo_judge_share(struct ceduo_estimate share, double limit)
{
    if (isnan(share.mean))
        return CEDUO_JUDGEMENT_UNANSWERED;
    if (share.lo <= limit && share.hi > limit)
        return CEDUO_JUDGEMENT_NOT_DECIDED;
    return share.mean <= limit ? CEDUO_JUDGEMENT_YES : CEDUO_JUDGEMENT_NO;
}

static enum ceduo_judgement judge_arrivals(const struct ceduo_arrivals *a)
{
    return ceduo_judge_share(a->exceed, a->limit);
}

enum ceduo_judgement ceduo_judge_control(const struct ceduo_arrivals *bare, const struct ceduo_arrivals *wooded)
{
    if (ceduo_too_few_arrivals(bare))
        return CEDUO_JUDGEMENT_CANNOT_JUDGE;
    if (wooded)
        return judge_arrivals(wooded);
    return judge_arrivals(bare) == CEDUO_JUDGEMENT_YES ? CEDUO_JUDGEMENT_YES : CEDUO_JUDGEMENT_UNANSWERED;
}

struct ceduo_index ceduo_assess_index(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      const struct ceduo_control *control, double bare_mean)
{
    const struct ceduo_rock rock = ceduo_rock_mean(&scene->rock);
    double start = scene->release.x.mean, stems_end = start, min = scene->simulation.contact_dbh;
    struct ceduo_index index = {.meet_nothing_probability = 1, .thick = {.contact = CEDUO_LIGHT_PASS}};
    struct ceduo_contact_check all = {.contact = CEDUO_LIGHT_PASS};
    bool forest = false;
    for (size_t i = 0; i < option->belts_count; i++) {
        struct ceduo_belt belt_part = option->belts[i];
        const struct ceduo_stand *stand = &option->belts[i].stand;
        double a = belt_part.from = fmax(belt_part.from, start), b = belt_part.to = fmin(belt_part.to, control->x);
        if (!(b > a))
            continue;
        struct ceduo_stand_result r = ceduo_assess_stand(scene, &belt_part);
        forest = true;
        index.length += r.bare ? 0 : b - a;
        index.contacts += r.contacts;
        index.dissipated += r.dissipated;
        /* probability that the belt, counting groups with centres inside, has no counted stem in the rock's path */
        const struct ceduo_stand counted = count_standing_from(stand, min);
        index.meet_nothing_probability *= no_contact_probability((b - a) / ceduo_adc(&counted, rock.mean_diameter).crofton,
                                                                 group_correction(&counted, rock.mean_diameter, b - a, false));
        add_belt_check(scene, stand, min, &all);
        add_belt_check(scene, stand, fmax(min, CEDUO_THICK_DBH), &index.thick);
        if (!ceduo_stand_has_stems(stand))
            continue;
        index.longest_gap = fmax(index.longest_gap, a - stems_end);
        stems_end = b;
    }
    index.longest_gap = fmax(index.longest_gap, control->x - stems_end);
    finish_check(scene, forest, index.longest_gap, &all);
    finish_check(scene, forest, index.longest_gap, &index.thick);
    index.per_100m = index.length > 0 ? index.dissipated / index.length * 100 : 0;
    index.worst_adc = all.worst_adc;
    index.worst_free_run = all.worst_free_run;
    index.contact = all.contact;
    index.free_run = all.free_run;
    index.energy = CEDUO_LIGHT_UNKNOWN;
    index.exhausted = bare_mean < index.dissipated;
    index.residual = isnan(bare_mean) ? NAN : fmax(0, bare_mean - index.dissipated);
    index.measured = 0.5 * rock.mass * control->measured_speed * control->measured_speed;
    return index;
}
