/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>
#include <string.h>

#include "derived.h"
#include "rock.h"
#include "schema.h"
#include "slope.h"
#include "stand.h"

#define SPEED_MAX 1e12 /* m, m/s, rad/s: of a release; above it the numbers of a flight overflow */

/* True if existing stems, stumps and logs have valid sizes. */
static bool has_sizes(const struct ceduo_stand *s)
{
    bool good = true;
    for (size_t i = 0; good && i < s->shoots_count + s->trees_count; i++) {
        const struct ceduo_stems *stems = i < s->shoots_count ? &s->shoots[i] : &s->trees[i - s->shoots_count];
        good = stems->per_ha >= 0 && (stems->per_ha == 0 || (stems->dbh > 0 && stems->height > 0));
    }
    const struct ceduo_stumps *stumps = &s->stumps;
    const struct ceduo_logs *logs = &s->logs;
    return good && (stumps->per_ha == 0 || (stumps->diameter > 0 && stumps->height > 0 && stumps->energy >= 0)) &&
           (logs->per_ha == 0 || (logs->diameter > 0 && logs->length > 0 && logs->energy >= 0)) && s->counted_from >= 0;
}

static enum ceduo_status check_options(const struct ceduo_scene *scene)
{
    double end = scene->slope.x[scene->slope.vertices - 1];
    for (size_t i = 0; i < scene->options_count; i++) {
        double end_of_stems = 0; /* end of the last belt with stems */
        for (size_t k = 0; k < scene->options[i].belts_count; k++) {
            const struct ceduo_belt *b = &scene->options[i].belts[k];
            if (!ceduo_schema_holds(ceduo_schema_belt(), b))
                return ceduo_schema_holds(ceduo_schema_stand(), &b->stand) ? CEDUO_BAD_NUMBER : CEDUO_BAD_STAND;
            if (!has_sizes(&b->stand))
                return CEDUO_BAD_STAND;
            if (ceduo_stand_is_bare(&b->stand))
                continue;
            if (!(b->from >= end_of_stems) || !(b->to > b->from) || !(b->to <= end))
                return CEDUO_BAD_BELT;
            end_of_stems = b->to;
        }
    }
    return CEDUO_OK;
}

enum ceduo_status ceduo_check_stands(const struct ceduo_option *option)
{
    bool good = option->belts || option->belts_count == 0;
    for (size_t i = 0; good && i < option->belts_count; i++)
        if (!ceduo_schema_holds(ceduo_schema_stand(), &option->belts[i].stand))
            return CEDUO_BAD_STAND;
    return good ? CEDUO_OK : CEDUO_BAD_ARGUMENT;
}

bool ceduo_option_has_lists(const struct ceduo_option *option)
{
    bool good = !option || option->belts || option->belts_count == 0;
    for (size_t i = 0; good && option && i < option->belts_count; i++) {
        const struct ceduo_stand *s = &option->belts[i].stand;
        good = (s->shoots || s->shoots_count == 0) && (s->trees || s->trees_count == 0);
    }
    return good;
}

static enum ceduo_status check_release(const struct ceduo_release *r, double end)
{
    const struct ceduo_number speeds[] = {r->height, r->vx, r->vz, r->spin};
    if (!(ceduo_number_min(r->x) >= 0) || !(ceduo_number_max(r->x) < end))
        return CEDUO_RELEASE_OFF_SLOPE;
    if (!(ceduo_number_min(r->height) >= 0))
        return CEDUO_RELEASE_BELOW;
    for (size_t i = 0; i < sizeof speeds / sizeof speeds[0]; i++)
        if (!(fabs(ceduo_number_min(speeds[i])) < SPEED_MAX) || !(fabs(ceduo_number_max(speeds[i])) < SPEED_MAX))
            return CEDUO_BAD_NUMBER;
    return CEDUO_OK;
}

const struct ceduo_release *ceduo_scene_releases(const struct ceduo_scene *scene, size_t *n)
{
    *n = scene->releases_count > 0 ? scene->releases_count : 1;
    return scene->releases_count > 0 ? scene->releases : &scene->release;
}

double ceduo_scene_release_last(const struct ceduo_scene *scene)
{
    size_t n;
    const struct ceduo_release *r = ceduo_scene_releases(scene, &n);
    double last = -INFINITY;
    for (size_t i = 0; i < n; i++)
        last = fmax(last, ceduo_number_max(r[i].x));
    return last;
}

void ceduo_scene_average_releases(struct ceduo_scene *scene)
{
    struct ceduo_release *mean = &scene->release;
    double shares = 0;
    if (scene->releases_count == 0)
        return;
    *mean = (struct ceduo_release){.share = 1};
    for (size_t i = 0; i < scene->releases_count; i++) {
        const struct ceduo_release *r = &scene->releases[i];
        shares += r->share;
        mean->x.mean += r->share * r->x.mean;
        mean->height.mean += r->share * r->height.mean;
        mean->vx.mean += r->share * r->vx.mean;
        mean->vz.mean += r->share * r->vz.mean;
        mean->spin.mean += r->share * r->spin.mean;
    }
    struct ceduo_number *const means[] = {&mean->x, &mean->height, &mean->vx, &mean->vz, &mean->spin};
    for (size_t i = 0; i < sizeof means / sizeof means[0]; i++)
        means[i]->mean /= shares;
}

enum ceduo_status ceduo_scene_check(const struct ceduo_scene *scene, size_t *bad_control)
{
    if (!scene || scene->size != sizeof *scene)
        return CEDUO_BAD_ARGUMENT;
    struct ceduo_rock rock;
    enum ceduo_status status = ceduo_rock_from_means(&scene->rock, &rock);
    /* counted lists exist; ceduo_schema_holds() checks the other lists */
    bool lists = (scene->blocks || scene->blocks_count == 0) && (scene->releases || scene->releases_count == 0) &&
                 (scene->controls || scene->controls_count == 0) && (scene->options || scene->options_count == 0);
    for (size_t i = 0; lists && i < scene->options_count; i++)
        lists = scene->options[i].belts || scene->options[i].belts_count == 0;
    if (status == CEDUO_OK && !lists)
        status = CEDUO_BAD_NUMBER;
    for (size_t i = 0; i < scene->blocks_count && status == CEDUO_OK; i++) {
        const struct ceduo_size_class *b = &scene->blocks[i];
        bool volumes = b->volumes_count == 2 && b->volumes && b->volumes[0] > 0 && b->volumes[1] > b->volumes[0];
        status = volumes && b->per_year > 0 && b->exponent >= 0 ? CEDUO_OK : CEDUO_BAD_ROCK;
    }
    if (status == CEDUO_OK)
        status = ceduo_slope_check(&scene->slope);
    if (status != CEDUO_OK)
        return status;
    double end = scene->slope.x[scene->slope.vertices - 1];
    size_t releases;
    const struct ceduo_release *release = ceduo_scene_releases(scene, &releases);
    for (size_t i = 0; i < releases && status == CEDUO_OK; i++)
        status = scene->releases_count > 0 && !(release[i].share > 0) ? CEDUO_BAD_NUMBER : check_release(&release[i], end);
    if (status != CEDUO_OK)
        return status;
    double last = ceduo_scene_release_last(scene);
    for (size_t i = 0; i < scene->controls_count; i++) {
        if (bad_control)
            *bad_control = i;
        if (!(scene->controls[i].x <= end))
            return CEDUO_CONTROL_OFF_SLOPE;
        if (!(scene->controls[i].x > last))
            return CEDUO_CONTROL_BEHIND;
    }
    if (scene->year_last < scene->year_first) /* NaN: not given */
        return CEDUO_BAD_ARGUMENT;
    status = check_options(scene);
    const struct object *root = ceduo_schema_scene();
    for (size_t i = 0; i < root->n && status == CEDUO_OK; i++) {
        const char *key = root->fields[i].key;
        bool checked = strcmp(key, "rock") == 0 || strcmp(key, "release") == 0 || strcmp(key, "options") == 0;
        if (!checked && !ceduo_schema_field_holds(&root->fields[i], scene))
            status = CEDUO_BAD_NUMBER;
    }
    return status;
}

bool ceduo_scene_rock_varies(const struct ceduo_scene *scene)
{
    return scene->blocks_count > 0 || ceduo_rock_varies(&scene->rock);
}

double ceduo_option_forest_begin(const struct ceduo_option *option)
{
    double from = INFINITY;
    for (size_t i = 0; i < option->belts_count; i++)
        if (option->belts[i].from < from && !ceduo_stand_is_bare(&option->belts[i].stand))
            from = option->belts[i].from;
    return from;
}

size_t ceduo_scene_last_control(const struct ceduo_scene *scene)
{
    size_t last = 0;
    for (size_t c = 1; c < scene->controls_count; c++)
        if (scene->controls[c].x > scene->controls[last].x)
            last = c;
    return last;
}

const char *ceduo_status_text(enum ceduo_status status)
{
    switch (status) {
#define X(NAME, text)                                                                                                          \
    case CEDUO_##NAME:                                                                                                         \
        return text;
        CEDUO_STATUSES(X)
#undef X
    }
    return "unknown status";
}

const char *ceduo_version(void)
{
    return CEDUO_VERSION;
}
