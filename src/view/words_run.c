/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings about a whole run: unusual, lost or unfinished rocks, and tests too close to call. */
#include <math.h>

#include "base/language.h"
#include "core/runs/assess.h"
#include "core/runs/pool.h"
#include "core/runs/result.h"
#include "core/runs/run.h"
#include "report.h"
#include "scene/derived.h"
#include "words.h"

/* Warn about rocks that leave over the upper end of the slope, and about stems that stop rocks just below the release, in
 * the worst option. */
static void warn_lost(const struct ceduo_result *result, ceduo_sentence_sink *sink, void *context)
{
    const struct ceduo_simulated *uphill = &result->bare;
    double max = 0;
    size_t option = 0;
    for (size_t i = 0; result->wooded && i < result->scene->options_count; i++) {
        const struct ceduo_simulated *f = &result->options[i].wooded;
        double share = f->rocks > 0 ? (double)f->ends.early / (double)f->rocks : 0;
        uphill = f->ends.uphill > uphill->ends.uphill ? f : uphill;
        option = share > max ? i : option;
        max = share > max ? share : max;
    }
    if (uphill->ends.uphill > 0)
        ceduo_words_format(
            sink, context,
            _("Of %llu rocks %llu bounce over the upper end of the profile and count as gone: extend the profile upward."),
            (unsigned long long)uphill->rocks, (unsigned long long)uphill->ends.uphill);
    if (max * 1000 >= 0.5)
        ceduo_words_format(sink, context,
                           _("%s: stems stop %.0f of 1000 rocks within %g m of the release, where they are slow."),
                           NAME_OF(&result->scene->options[option]), max * 1000, CEDUO_EARLY_M);
}

/* Warn about controls with unusual rocks: more or fewer than the terrain suggests, faster or higher than usual. */
static void warn_ground(const struct ceduo_result *r, ceduo_sentence_sink *sink, void *context)
{
    for (size_t c = 0; c < r->scene->controls_count; c++) {
        const struct ceduo_arrivals *bare = &r->bare.arrivals[c];
        double speed = ceduo_measure_figure(CEDUO_SPEED, bare).value,
               height = ceduo_measure_figure(CEDUO_P95_HEIGHT, bare).value;
        const struct ceduo_topography *t = ceduo_topography_find(bare);
        enum ceduo_terrain terrain = ceduo_terrain(bare);
        LOCAL_TEXT(name);
        ceduo_words_place(&name, &r->scene->controls[c]);
        const char *control_name = ceduo_text_string(&name);
        if (terrain == CEDUO_TERRAIN_BENCH)
            ceduo_words_format(
                sink, context,
                _("%s: few rocks arrive without forest, though it lies under a reach angle of %.0f\xc2\xb0. A bench of "
                  "%.0f m may hold them: check on the ground that it does."),
                control_name, t->reach * DEGREES, t->bench);
        if (terrain == CEDUO_TERRAIN_FAR)
            ceduo_words_format(
                sink, context,
                _("%s: %.0f of 1000 rocks arrive without forest, though it lies under a shadow angle of only "
                  "%.0f\xc2\xb0. Evans and Hungr (1993) suggest 27.5\xc2\xb0 as the smallest: check the friction of "
                  "the ground."),
                control_name, ceduo_measure_arriving(bare).value, t->shadow * DEGREES);
        if (speed > CEDUO_SPEED_USUAL)
            ceduo_words_format(sink, context,
                               r->scene->simulation.law == CEDUO_LAW_LUMPED
                                   ? _("%s: the mean speed without forest is %.0f m/s, and more than %.0f is unusual. The law "
                                       "lumped has no limit of speed on long slopes: use crsp.")
                                   : _("%s: the mean speed without forest is %.0f m/s, and more than %.0f is unusual. Check "
                                       "roughness and friction of the ground."),
                               control_name, speed, CEDUO_SPEED_USUAL);
        if (height > CEDUO_HEIGHT_USUAL)
            ceduo_words_format(
                sink, context,
                _("%s: 1 rock in 20 passes more than %.0f m above the ground without forest, and more than %.0f m is unusual. "
                  "Check roughness and restitution of the ground, and the profile."),
                control_name, height, CEDUO_HEIGHT_USUAL);
    }
}

void ceduo_words_run_warnings(const struct ceduo_result *result, const struct ceduo_run_remarks *remarks,
                              ceduo_sentence_sink *sink, void *context)
{
    if (remarks->tolerance > 0 && !remarks->tolerance_met)
        ceduo_words_format(sink, context, _("The tolerance of %g was not met with %llu rocks."), remarks->tolerance,
                           (unsigned long long)ceduo_result_rocks(result));
    for (size_t i = 0; remarks->tolerance > 0 && i < result->scene->controls_count; i++) {
        uint64_t fewest = ceduo_rocks_reached(&result->bare.arrivals[i]);
        for (size_t k = 0; k < result->options_count; k++) {
            const struct ceduo_arrivals *a = ceduo_result_wooded(result, k, i);
            fewest = a && ceduo_rocks_reached(a) < fewest ? ceduo_rocks_reached(a) : fewest;
        }
        if (fewest < CEDUO_ARRIVALS_MIN)
            ceduo_words_format(sink, context,
                               _("At %g m only %llu rocks arrive: the mean energy there was left out of the tolerance."),
                               result->scene->controls[i].x_given, (unsigned long long)fewest);
    }
    warn_ground(result, sink, context);
    uint64_t unfinished = ceduo_result_unfinished(result);
    if (unfinished > 0 && result->bare.ends.count[CEDUO_END_UNFINISHED] == 0)
        ceduo_words_format(sink, context,
                           ngettext("%llu rock had more than %d contacts or stems in the forest and counts as unfinished: "
                                    "check the rock's size and the stems per hectare.",
                                    "%llu rocks had more than %d contacts or stems in the forest and count as unfinished: "
                                    "check the rock's size and the stems per hectare.",
                                    (unsigned long)unfinished),
                           (unsigned long long)unfinished, CEDUO_STEMS_MAX);
    else if (unfinished > 0)
        ceduo_words_format(
            sink, context,
            ngettext(
                "%llu rock was still moving after %d contacts and counts as unfinished: check that the ground absorbs energy.",
                "%llu rocks were still moving after %d contacts and count as unfinished: check that the ground absorbs energy.",
                (unsigned long)unfinished),
            (unsigned long long)unfinished, CEDUO_CONTACTS_MAX);
    for (size_t i = 0; i < result->options_count; i++)
        for (size_t c = 0; c < result->scene->controls_count; c++) {
            const struct ceduo_arrivals *a = ceduo_result_wooded(result, i, c);
            const struct ceduo_control *control = &result->scene->controls[c];
            if (!ceduo_is_close_call(a))
                continue;
            if (result->scene->blocks_count > 0)
                ceduo_words_format(
                    sink, context, _("%s, %g m: too close to the limit of one rock in %g years today; simulate more rocks."),
                    NAME_OF(&result->scene->options[i]), result->scene->controls[c].x_given, ceduo_accepted_return(control));
            else
                ceduo_words_format(
                    sink, context,
                    _("%s, %g m: too close to the limit of %.0f of 1000 rocks with too much energy; simulate more rocks."),
                    NAME_OF(&result->scene->options[i]), control->x_given, ceduo_exceed_limit(result->scene, control) * 1000);
        }
    warn_lost(result, sink, context);
    if (remarks->ground_assumed)
        ceduo_words_format(sink, context, _("The slope file gives no ground: talus is assumed everywhere."));
}
