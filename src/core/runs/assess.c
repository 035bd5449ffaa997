/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/assess.h"

#include <math.h>

#include "core/stand/strata.h"

/* ---- stems that count ---- */

static struct ceduo_stand from_dbh(const struct ceduo_stand *stand, double dbh)
{
    struct ceduo_stand counted = *stand;
    counted.counted_from = dbh;
    return counted;
}

/* For the lights, what lies low does not count: a rock flies over it. */
static struct ceduo_stand standing(const struct ceduo_stand *stand, double dbh)
{
    struct ceduo_stand counted = from_dbh(stand, dbh);
    counted.stumps.per_ha = counted.logs.per_ha = 0;
    return counted;
}

/* Trees of a group are met together, so that a way without any is likelier than by crofton, which has them one by one: by
 * this in the exponent. `within`: no tree stands on `length` m; otherwise none of the groups that have their centre there is met. */
static double less_by_groups(const struct ceduo_stand *stand, double b, double length, bool within)
{
    double more = 0;
    for (size_t i = 0; i < stand->trees_count; i++) {
        const struct ceduo_stems *t = &stand->trees[i];
        if (!ceduo_stems_are_grouped(t) || !(t->dbh >= stand->counted_from))
            continue;
        struct group_shape shape = {.n = t->group, .radius = t->group_radius, .width = b + t->dbh};
        double met = within ? ceduo_groups_met_within(&shape, length) : ceduo_groups_met_along(&shape, length);
        more += t->per_ha / HECTARE * (length * shape.width - met / t->group);
    }
    return more;
}

static double chance_of_none(double contacts, double less)
{
    return exp(fmin(0, less - contacts));
}

/* How often a rock meets the stems that count. */
struct met {
    double adc, free_run;
};

static struct met meet_counted(const struct ceduo_scene *scene, const struct ceduo_stand *counted)
{
    double b = ceduo_rock_mean(&scene->rock).mean_diameter, threshold = scene->simulation.threshold;
    struct ceduo_adc adc = ceduo_adc(counted, b);
    if (isinf(adc.crofton))
        return (struct met){INFINITY, 1};
    return (struct met){ceduo_adc_value(&adc, ceduo_adc_rule(counted, b, scene->simulation.rule)),
                        chance_of_none(threshold / adc.crofton, less_by_groups(counted, b, threshold, true))};
}

/* Fewer stems are not met more often, though their mean diameter may make a form say so. */
static struct met meet(const struct ceduo_scene *scene, const struct ceduo_stand *stand, double dbh)
{
    const struct ceduo_stand all = standing(stand, scene->simulation.contact_dbh), thick = standing(stand, dbh);
    struct met met = meet_counted(scene, &all), fewer = meet_counted(scene, &thick);
    return (struct met){fmax(met.adc, fewer.adc), fmax(met.free_run, fewer.free_run)};
}

static void add_meeting(const struct ceduo_scene *scene, const struct ceduo_stand *stand, double dbh,
                        struct ceduo_contact_check *meeting)
{
    struct met met = meet(scene, stand, dbh);
    meeting->worst_adc = fmax(meeting->worst_adc, met.adc);
    meeting->worst_free_run = fmax(meeting->worst_free_run, met.free_run);
    if (!(met.adc < scene->simulation.threshold)) /* NaN is none */
        meeting->contact = CEDUO_FAIL;
}

static void judge_meeting(const struct ceduo_scene *scene, bool forest, double longest_gap, struct ceduo_contact_check *meeting)
{
    if (!forest)
        *meeting = (struct ceduo_contact_check){.worst_adc = INFINITY, .worst_free_run = 1};
    double threshold = scene->simulation.threshold;
    if (!forest || longest_gap > threshold)
        meeting->contact = CEDUO_FAIL;
    bool rare = meeting->worst_free_run <= CEDUO_FREE_RUN_MAX && !(longest_gap > threshold);
    meeting->free_run = rare ? CEDUO_PASS : CEDUO_FAIL;
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
    const struct ceduo_stand counted = from_dbh(stand, scene->simulation.contact_dbh);
    enum ceduo_rule rule = ceduo_adc_rule(&counted, b, scene->simulation.rule);
    struct ceduo_adc adc = ceduo_adc(&counted, b);
    double adc_m = ceduo_adc_value(&adc, rule);
    struct met met = meet(scene, stand, scene->simulation.contact_dbh);
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
    r.passes_threshold = met.adc < scene->simulation.threshold;
    r.free_run_probability = met.free_run;
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
        return CEDUO_UNKNOWN;
    if (!(a->exceed.mean <= a->limit))
        return CEDUO_FAIL;
    double unfinished = (double)a->unfinished / (double)a->released;
    return a->exceed.mean + unfinished <= a->limit ? CEDUO_PASS : CEDUO_UNKNOWN;
}

/* ---- what can be said ---- */

#define DEGREES (180 / M_PI)

enum ceduo_terrain ceduo_terrain(const struct ceduo_arrivals *bare)
{
    const struct ceduo_topography *t = &bare->topography;
    double all = (double)bare->released, may_arrive = (double)(bare->reached + bare->unfinished);
    bool steep = t->reach * DEGREES > CEDUO_REACH_STEEP || t->shadow * DEGREES > CEDUO_SHADOW_STEEP;
    if (bare->released > 0 && steep && may_arrive < CEDUO_ARRIVE_FEW * all)
        return t->bench >= CEDUO_BENCH_LENGTH ? CEDUO_TERRAIN_BENCH : CEDUO_TERRAIN_CONTRADICTS;
    bool many = (double)bare->reached > CEDUO_ARRIVE_MANY * all;
    bool beyond = t->reach < M_PI_4; /* not right below the face */
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
        return CEDUO_UNANSWERED;
    if (share.lo <= limit && share.hi > limit)
        return CEDUO_NOT_DECIDED;
    return share.mean <= limit ? CEDUO_YES : CEDUO_NO;
}

static enum ceduo_judgement judge_arrivals(const struct ceduo_arrivals *a)
{
    return ceduo_judge_share(a->exceed, a->limit);
}

enum ceduo_judgement ceduo_judge_control(const struct ceduo_arrivals *bare, const struct ceduo_arrivals *wooded)
{
    if (ceduo_too_few_arrivals(bare))
        return CEDUO_NOTHING;
    if (wooded)
        return judge_arrivals(wooded);
    return judge_arrivals(bare) == CEDUO_YES ? CEDUO_YES : CEDUO_UNANSWERED;
}

struct ceduo_index ceduo_assess_index(const struct ceduo_scene *scene, const struct ceduo_option *option,
                                      const struct ceduo_control *control, double bare_mean)
{
    const struct ceduo_rock rock = ceduo_rock_mean(&scene->rock);
    double start = scene->release.x.mean, at = start, min = scene->simulation.contact_dbh;
    struct ceduo_index index = {.meet_nothing_probability = 1, .thick = {.contact = CEDUO_PASS}};
    struct ceduo_contact_check all = {.contact = CEDUO_PASS};
    bool forest = false;
    for (size_t i = 0; i < option->belts_count; i++) {
        struct ceduo_belt within = option->belts[i];
        const struct ceduo_stand *stand = &option->belts[i].stand;
        double a = within.from = fmax(within.from, start), b = within.to = fmin(within.to, control->x);
        if (!(b > a))
            continue;
        struct ceduo_stand_result r = ceduo_assess_stand(scene, &within);
        forest = true;
        index.length += r.bare ? 0 : b - a;
        index.contacts += r.contacts;
        index.dissipated += r.dissipated;
        /* the chance that the belt, of those whose centres lie there, has no stem that counts in the rock's way */
        const struct ceduo_stand counted = standing(stand, min);
        index.meet_nothing_probability *= chance_of_none((b - a) / ceduo_adc(&counted, rock.mean_diameter).crofton,
                                                         less_by_groups(&counted, rock.mean_diameter, b - a, false));
        add_meeting(scene, stand, min, &all);
        add_meeting(scene, stand, fmax(min, CEDUO_THICK_DBH), &index.thick);
        if (!ceduo_stand_has_stems(stand))
            continue;
        index.longest_gap = fmax(index.longest_gap, a - at);
        at = b;
    }
    index.longest_gap = fmax(index.longest_gap, control->x - at);
    judge_meeting(scene, forest, index.longest_gap, &all);
    judge_meeting(scene, forest, index.longest_gap, &index.thick);
    index.per_100m = index.length > 0 ? index.dissipated / index.length * 100 : 0;
    index.worst_adc = all.worst_adc;
    index.worst_free_run = all.worst_free_run;
    index.contact = all.contact;
    index.free_run = all.free_run;
    index.energy = CEDUO_UNKNOWN;
    index.exhausted = bare_mean < index.dissipated;
    index.residual = isnan(bare_mean) ? NAN : fmax(0, bare_mean - index.dissipated);
    index.measured = 0.5 * rock.mass * control->measured_speed * control->measured_speed;
    return index;
}
