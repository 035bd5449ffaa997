/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sentences about the profile and the ground: its points, how a control lies below the release, and what is unusual about the rocks
 * that arrive there. */
#include <math.h>

#include "base/language.h"
#include "measure.h"
#include "plot_parts.h"
#include "words.h"

#define DEGREES (180 / M_PI)

void ceduo_words_points(struct text *text, const struct ceduo_slope *slope)
{
    size_t given = slope->points > 0 ? slope->points : slope->vertices;
    ceduo_text_format(text, ngettext("%zu point", "%zu points", given), given);
    if (slope->simplified_to > 0)
        ceduo_text_format(text, _(", %zu after simplifying to %g m"), slope->vertices, slope->simplified_to);
}

void ceduo_words_topography(struct text *text, const struct ceduo_topography *t, bool brief)
{
    ceduo_text_then(text, text->length > 0 ? ", " : "", brief ? _("reach %.0f\xc2\xb0") : _("reach angle %.0f\xc2\xb0"),
                    t->reach * DEGREES);
    if (!isnan(t->shadow))
        ceduo_text_then(text, ", ", brief ? _("shadow %.0f\xc2\xb0") : _("shadow angle %.0f\xc2\xb0"), t->shadow * DEGREES);
}

void ceduo_words_contradiction(struct text *text, const struct ceduo_arrivals *bare)
{
    double reach = bare->topography.reach * DEGREES, shadow = bare->topography.shadow * DEGREES;
    if (shadow > CEDUO_SHADOW_STEEP)
        ceduo_text_then(
            text, " ",
            _("But it lies under a shadow angle of %.1f\xc2\xb0 (from the foot of the face), and rocks usually reach "
              "places under more than %.0f\xc2\xb0."),
            shadow, CEDUO_SHADOW_STEEP);
    else
        ceduo_text_then(text, " ",
                        _("But it lies under a reach angle of %.1f\xc2\xb0 (from the release), and rocks usually reach places "
                          "under more than %.0f\xc2\xb0."),
                        reach, CEDUO_REACH_STEEP);
    ceduo_text_then(text, " ", "%s", _("Check roughness and friction of the ground, the law of impact and the profile."));
}

/* A control where more or fewer rocks arrive than its place suggests. */
static void say_terrain(struct text *text, const char *where, const struct ceduo_arrivals *bare)
{
    const struct ceduo_topography *t = &bare->topography;
    enum ceduo_terrain terrain = ceduo_terrain(bare);
    if (terrain == CEDUO_TERRAIN_BENCH)
        ceduo_text_format(
            text,
            _("%s: few rocks arrive without forest, though it lies under a reach angle of %.0f\xc2\xb0. A bench of "
              "%.0f m may hold them: check on the ground that it does."),
            where, t->reach * DEGREES, t->bench);
    if (terrain == CEDUO_TERRAIN_FAR)
        ceduo_text_format(text,
                          _("%s: %.0f of 1000 rocks arrive without forest, though it lies under a shadow angle of only "
                            "%.0f\xc2\xb0. Evans and Hungr (1993) suggest 27.5\xc2\xb0 as the smallest: check the friction of "
                            "the ground."),
                          where, bare->reach.mean * 1000, t->shadow * DEGREES);
}

/* Speeds that rocks on slopes do not have. */
static void say_fast(struct text *text, const char *where, const struct ceduo_arrivals *bare, enum ceduo_law law)
{
    if (bare->speed.mean > CEDUO_SPEED_USUAL)
        ceduo_text_format(text,
                          law == CEDUO_LAW_LUMPED
                              ? _("%s: the mean speed without forest is %.0f m/s, and more than %.0f is unusual. The law "
                                  "lumped has no limit of speed on long slopes: use crsp.")
                              : _("%s: the mean speed without forest is %.0f m/s, and more than %.0f is unusual. Check "
                                  "roughness and friction of the ground."),
                          where, bare->speed.mean, CEDUO_SPEED_USUAL);
}

static void say_high(struct text *text, const char *where, const struct ceduo_arrivals *bare)
{
    if (bare->height.p95 > CEDUO_HEIGHT_USUAL)
        ceduo_text_format(
            text,
            _("%s: 1 rock in 20 passes more than %.0f m above the ground without forest, and more than %.0f m is unusual. "
              "Check roughness and restitution of the ground, and the profile."),
            where, bare->height.p95, CEDUO_HEIGHT_USUAL);
}

void ceduo_words_ground(const struct ceduo_result *r, ceduo_words_say *say, void *context)
{
    for (size_t c = 0; c < r->scene->controls_count; c++) {
        const struct ceduo_arrivals *bare = &r->bare.arrivals[c];
        LOCAL_TEXT(name);
        ceduo_plot_control_name(&name, &r->scene->controls[c]);
        const char *where = ceduo_text_string(&name);
        for (int i = 0; i < 3; i++) {
            LOCAL_TEXT(sentence);
            if (i == 0)
                say_terrain(&sentence, where, bare);
            else if (i == 1)
                say_fast(&sentence, where, bare, r->scene->simulation.law);
            else
                say_high(&sentence, where, bare);
            if (sentence.length > 0)
                say(context, sentence.bytes);
        }
    }
}
