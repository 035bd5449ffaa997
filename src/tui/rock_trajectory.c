/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The trajectory of one rock, in segments. */
#include <math.h>
#include <stdlib.h>

#include "app.h"
#include "base/clock.h"
#include "base/hash.h"
#include "base/language.h"
#include "base/oom.h"

#define FLIGHT_POINTS 24 /* points of a parabola: enough for any screen */
#define SEGMENTS_MAX  20000
#define SECONDS_MAX   0.05 /* time limit for one key */

static bool has_timed_out(void *context)
{
    const struct rock_trajectory *s = context;
    return ceduo_clock() - s->start_time > SECONDS_MAX;
}

static void add_segment(void *context, const struct ceduo_trajectory_segment *segment)
{
    struct rock_trajectory *s = context;
    if (s->n == SEGMENTS_MAX)
        return;
    s->segments = ceduo_grow(s->segments, s->n, &s->capacity, sizeof *s->segments);
    s->segments[s->n++] = (struct rock_segment){*segment, s->stems_count};
}

static void add_stem(void *context, const struct ceduo_stem_encounter *stem)
{
    struct rock_trajectory *s = context;
    if (s->n >= SEGMENTS_MAX)
        return;
    s->stems = ceduo_grow(s->stems, s->stems_count, &s->stems_capacity, sizeof *s->stems);
    s->stems[s->stems_count++] = *stem;
    if (stem->hit && s->n > 0) /* flown over: part of the current segment */
        s->segments[s->n - 1].stems = s->stems_count;
}

bool ceduo_app_trace_rock(struct app *app)
{
    struct rock_trajectory *s = &app->trajectory;
    const struct ceduo_scene *scene = &app->document.file.scene;
    uint64_t key = app->live.requested_key;
    hash_count(&key, app->option);
    bool known = s->n > 0 && s->key == key && s->rock == app->rock;
    if (!known) {
        s->n = s->shown = s->stems_count = 0;
        s->key = key, s->rock = app->rock;
        s->start_time = ceduo_clock();
        const struct ceduo_trajectory_callbacks callbacks = {
            .is_cancelled = has_timed_out, .segment = add_segment, .stem = add_stem, .context = s};
        enum ceduo_status status = ceduo_trajectory_run(scene, ceduo_app_option(app), s->rock, &callbacks, &s->whole, NULL);
        s->cut_short = status == CEDUO_CANCELLED;
        if (status != CEDUO_OK && !s->cut_short) {
            ceduo_rock_trajectory_free(s);
            return false;
        }
    }
    /* polyline of the segments shown */
    size_t count = s->shown > 0 ? s->shown : s->n, capacity = count * FLIGHT_POINTS + 1;
    struct ceduo_polyline *line = &s->line;
    free(line->x);
    line->x = ceduo_check_memory(malloc(2 * capacity * sizeof(double)));
    line->z = line->x + capacity;
    line->x[0] = s->whole.x0;
    line->z[0] = s->whole.z0;
    line->n = 1;
    for (size_t k = 0; k < count; k++) {
        const struct ceduo_trajectory_segment *p = &s->segments[k].segment;
        for (int i = 1; i < FLIGHT_POINTS && !p->rolls; i++) {
            double time = p->seconds * i / FLIGHT_POINTS;
            line->x[line->n] = p->x + p->vx * time;
            line->z[line->n++] = p->z + (p->vz - scene->simulation.gravity / 2 * time) * time;
        }
        line->x[line->n] = p->x1;
        line->z[line->n++] = p->z1;
    }
    return true;
}

size_t ceduo_rock_trajectory_stems(const struct rock_trajectory *s)
{
    return s->shown > 0 ? s->segments[s->shown - 1].stems : s->stems_count;
}

/* Describe the last segment shown, or the end of the trajectory. */
static void describe_rock(const struct rock_trajectory *s, const struct ceduo_scene *scene, struct text *text)
{
    static const char *const ends[CEDUO_ENDS] = {N_("comes to rest"), N_("leaves the slope"), N_("is still moving"),
                                                 N_("is stopped by stems")};
    double origin = scene->slope.origin_x, gravity = scene->simulation.gravity;
    if (s->shown == 0 || s->shown > s->n) {
        ceduo_text_format(text, _("rock %llu: %s at %.1f m after %llu contacts"), (unsigned long long)s->rock,
                          s->cut_short ? _("is not shown further") : _(ends[s->whole.end]), s->whole.x + origin,
                          (unsigned long long)s->whole.contacts);
        if (s->whole.stems_drawn > 0)
            ceduo_text_append_joined(text, ", ", _("%llu stems hit"), (unsigned long long)s->whole.stems_hit);
        return;
    }
    const struct ceduo_trajectory_segment *p = &s->segments[s->shown - 1].segment;
    double up = p->vz > 0 && !p->rolls ? fmin(p->vz / gravity, p->seconds) : 0;
    double x = p->x + p->vx * up, z = p->z + (p->vz - gravity / 2 * up) * up;
    ceduo_text_format(text, _("rock %llu, segment %zu of %zu"), (unsigned long long)s->rock, s->shown, s->n);
    if (p->rolls)
        ceduo_text_append_joined(text, ": ", _("rolls from %.2f to %.2f m, %.1f to %.1f m/s"), p->x + origin, p->x1 + origin,
                                 hypot(p->vx, p->vz), hypot(p->vx1, p->vz1));
    else
        ceduo_text_append_joined(text, ": ", _("flies from %.2f to %.2f m, %.1f m/s, top %.1f m above the ground"),
                                 p->x + origin, p->x1 + origin, hypot(p->vx1, p->vz1),
                                 fmax(0, z - ceduo_slope_height(&scene->slope, x)));
    for (size_t i = s->shown > 1 ? s->segments[s->shown - 2].stems : 0; i < s->segments[s->shown - 1].stems; i++) {
        const struct ceduo_stem_encounter *stem = &s->stems[i];
        if (!stem->hit) /* flown over, at its end */
            continue;
        if (isnan(stem->dbh))
            ceduo_text_append_joined(text, "; ", _("hits a log: %.2g of %.3g kJ"), stem->taken / 1e3, stem->before / 1e3);
        else
            ceduo_text_append_joined(text, "; ",
                                     stem->shoot ? _("hits a shoot of %.2g cm: %.2g of %.3g kJ")
                                                 : _("hits a tree of %.2g cm: %.2g of %.3g kJ"),
                                     stem->dbh * 100, stem->taken / 1e3, stem->before / 1e3);
    }
}

void ceduo_app_step_rock(struct app *app, int step)
{
    struct rock_trajectory *s = &app->trajectory;
    LOCAL_TEXT(text);
    if (step != 0) /* 0: all segments */
        s->shown = step > 0 ? (s->shown < s->n ? s->shown + 1 : s->n) : s->shown > 0 ? s->shown - 1 : s->n;
    describe_rock(s, &app->document.file.scene, &text);
    ceduo_app_show_message(app, "%s", text.bytes);
}

void ceduo_app_next_rock(struct app *app, int step)
{
    app->rock = step > 0 || app->rock > 0 ? app->rock + (uint64_t)step : 0;
    if (ceduo_app_trace_rock(app))
        ceduo_app_step_rock(app, 0);
}

void ceduo_rock_trajectory_free(struct rock_trajectory *s)
{
    free(s->segments);
    free(s->stems);
    free(s->line.x);
    *s = (struct rock_trajectory){0};
}
