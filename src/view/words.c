/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "words.h"
#include "core/runs/assess.h"
#include "core/stand/adc.h"
#include "core/stand/rotation.h"
#include "scene/species.h"
#include "scene/stand.h"
#include "scene/volume.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"

const char *const ceduo_words_unjudged = N_("No accepted energy is set (accepted_kJ): energy is not judged.");
const char *const ceduo_words_by_index =
    N_("With contact_model: index no rocks are simulated through the forest, so arrivals do not separate the options. The "
       "index is the energy that stems could absorb, not the loss of a rock.");
const char *const ceduo_light_names[] = {N_("contact"), N_("free run"), N_("energy")};

const char *ceduo_words_light(enum ceduo_light light)
{
    static const char *const words[] = {"unknown", "pass", "fail"};
    return words[light];
}

double ceduo_words_accepted(const struct ceduo_control *control)
{
    return control->accepted / 1000;
}

const char *ceduo_words_sig(double value, int digits, char buffer[CEDUO_NUMBER_SIZE])
{
    double size = fabs(value);
    int decimals = size > 0 && isfinite(size) ? digits - (int)floor(log10(size)) - 1 : 0;
    if (isnan(value))
        snprintf(buffer, CEDUO_NUMBER_SIZE, "-");
    else if (isinf(value))
        snprintf(buffer, CEDUO_NUMBER_SIZE, "%s", P_("number", "none"));
    else if (size > 0 && (decimals > 6 || size >= 1e8))
        snprintf(buffer, CEDUO_NUMBER_SIZE, "%.*g", digits, value);
    else
        snprintf(buffer, CEDUO_NUMBER_SIZE, "%.*f", decimals > 0 ? decimals : 0, size > 0 ? value : 0);
    return ceduo_number_localize(buffer);
}

const char *ceduo_words_law(const char *word)
{
    static const char *const laws[] = {N_("lumped"),          N_("crsp"),           N_("arm"),
                                       N_("brauner"),         N_("dorren"),         N_("interception"),
                                       N_("gsteiger-stools"), N_("gsteiger-stems"), N_("crofton")};
    for (size_t k = 0; k < sizeof laws / sizeof laws[0]; k++)
        if (strcmp(word, laws[k]) == 0)
            return _(laws[k]);
    return word;
}

const char *ceduo_words_sig_trimmed(double value, int digits, char buffer[CEDUO_NUMBER_SIZE])
{
    snprintf(buffer, CEDUO_NUMBER_SIZE, "%.*g", digits, value);
    return ceduo_number_localize(buffer);
}

/* Return the digits, or decimals, needed to keep a value on its side of the limit. */
static int digits_vs_limit(double value, double limit, int digits, bool decimals)
{
    char buffer[CEDUO_NUMBER_SIZE];
    for (; digits < 9; digits++) {
        snprintf(buffer, sizeof buffer, decimals ? "%.*f" : "%.*g", digits, value);
        double shown = strtod(buffer, NULL);
        if ((shown < limit) == (value < limit) && (shown > limit) == (value > limit))
            break;
    }
    return digits;
}

const char *ceduo_words_against_limit(double value, int digits, double limit, char buffer[CEDUO_NUMBER_SIZE])
{
    return ceduo_words_sig(value, digits_vs_limit(value, limit, digits, false), buffer);
}

const char *ceduo_words_percent(double share, double limit, char buffer[CEDUO_NUMBER_SIZE])
{
    snprintf(buffer, CEDUO_NUMBER_SIZE, "%.*f", digits_vs_limit(100 * share, 100 * limit, 1, true), 100 * share);
    return ceduo_number_localize(buffer);
}

void ceduo_words_number(struct text *text, double value, int digits)
{
    ceduo_text_append(text, SIG(value, digits));
}

void ceduo_words_place(struct text *text, const struct ceduo_control *control)
{
    if (control->name)
        ceduo_text_format(text, _("%s (%s m)"), NAME_OF(control), LOCALIZED(control->x_given));
    else
        ceduo_text_format(text, _("%s m"), LOCALIZED(control->x_given));
}

void ceduo_text_append_with(struct text *text, const char *sentence, const char *string)
{
    const char *mark = strstr(sentence, "%s");
    size_t n = mark ? (size_t)(mark - sentence) : strlen(sentence);
    ceduo_text_append_n(text, sentence, n);
    if (!mark)
        return;
    ceduo_text_append(text, string);
    ceduo_text_append(text, mark + 2);
}

void ceduo_words_format(ceduo_sentence_sink *sink, void *context, const char *format, ...)
{
    LOCAL_TEXT(sentence);
    va_list args;
    va_start(args, format);
    ceduo_text_vformat(&sentence, format, args);
    va_end(args);
    sink(context, sentence.bytes);
}

/* Return shoots, then trees; NULL after the last. */
static const struct ceduo_stems *get_stems(const struct ceduo_stand *s, size_t i)
{
    return i < s->shoots_count ? &s->shoots[i] : i < s->shoots_count + s->trees_count ? &s->trees[i - s->shoots_count] : NULL;
}

static const struct ceduo_stems *find_implausible(const struct ceduo_stand *s, unsigned warning)
{
    size_t i = 0;
    while (get_stems(s, i) && !(ceduo_stem_warnings(s, get_stems(s, i)) & warning))
        i++;
    return get_stems(s, i);
}

void ceduo_words_implausible(const struct ceduo_belt *belt, const struct ceduo_stand_result *r, ceduo_sentence_sink *sink,
                             void *context)
{
    const struct ceduo_stand *s = &belt->stand;
    const struct ceduo_stems *const odd[] = {find_implausible(s, CEDUO_WARNING_SLENDER),
                                             find_implausible(s, CEDUO_WARNING_STOUT)};
    if (r->warnings & CEDUO_WARNING_BASAL_AREA)
        ceduo_words_format(sink, context,
                           _("%s: %.1f m2/ha of basal area are more than %d: check the stems per ha and their diameters."),
                           NAME_OF(belt), r->basal_area, CEDUO_BASAL_AREA_MAX);
    if (r->warnings & CEDUO_WARNING_MANY_SHOOTS)
        ceduo_words_format(sink, context, _("%s: %.1f shoots a stool are more than %d: check stools and shoots."),
                           NAME_OF(belt), ceduo_stand_shoots(s) / s->stools_per_ha, CEDUO_SHOOTS_MAX);
    for (size_t i = 0; i < 2; i++)
        if (odd[i])
            ceduo_words_format(
                sink, context,
                _("%s: %.3g cm stems, %.3g m tall: unusual height/diameter ratio (usual %d\xe2\x80\x93%d). Check both."),
                NAME_OF(belt), odd[i]->dbh * 100, odd[i]->height, CEDUO_SLENDERNESS_MIN, CEDUO_SLENDERNESS_MAX);
    for (size_t i = 0; get_stems(s, i); i++) {
        const struct ceduo_curve_comparison curve = ceduo_stems_compare_to_curve(s, belt->cut_year, i);
        if (fabs(curve.basal_area - curve.by_curve) > CEDUO_CURVE_DEVIATION_MAX * curve.by_curve)
            ceduo_words_format(sink, context,
                               i < s->shoots_count
                                   ? _("%s: the shoots of %g years have %.1f m2/ha of basal area. The stand's own growth "
                                       "gives %.1f at that age: check diameter, age and growth.")
                                   : _("%s: the trees of %g years have %.1f m2/ha of basal area. The stand's own growth "
                                       "gives %.1f at that age: check diameter, age and growth."),
                               NAME_OF(belt), curve.age, curve.basal_area, curve.by_curve);
    }
}

void ceduo_words_thick_stems(const struct ceduo_belt *belt, ceduo_sentence_sink *sink, void *context)
{
    const struct ceduo_stand *s = &belt->stand;
    const struct ceduo_stems *thick = find_implausible(s, CEDUO_WARNING_THICK);
    size_t n;
    if (thick)
        ceduo_words_format(sink, context,
                           _("%s: %.3g cm stems are thicker than the volume tables of their species, %g cm: check them."),
                           NAME_OF(belt), thick->dbh * 100, ceduo_species_list(&n)[s->species].d_hi);
}

void ceduo_words_stand_warnings(const struct ceduo_scene *scene, const struct ceduo_belt *belt,
                                const struct ceduo_stand_result *r, ceduo_sentence_sink *sink, void *context)
{
    const struct ceduo_stand *s = &belt->stand;
    if ((!r->bare || r->felled) && r->trees_per_ha < scene->reserves_minimum)
        ceduo_words_format(sink, context, _("%s: %g single trees a hectare are fewer than the %g that must stay."),
                           NAME_OF(belt), r->trees_per_ha, scene->reserves_minimum);
    ceduo_words_implausible(belt, r, sink, context);
    ceduo_words_thick_stems(belt, sink, context);
    double diameter = ceduo_rock_mean(&scene->rock).mean_diameter;
    if (r->warnings & CEDUO_WARNING_BELOW_FREE_PATH)
        ceduo_words_format(sink, context,
                           _("%s: Eq. 6 gives %.2f m between contacts, below the mean free path of %.2f m over all stems. This "
                             "is impossible: spacing %g m is too wide for %.1f shoots per stool."),
                           NAME_OF(belt), r->adc.interception, r->adc.gsteiger_stems, s->spacing,
                           ceduo_stand_shoots(s) / s->stools_per_ha);
    if (r->warnings & CEDUO_WARNING_NEAR_JUMP)
        ceduo_words_format(
            sink, context,
            _("%s: the rock (%.2f m) is within 10 %% of the shoots' spacing (%g m), where the paper's rule jumps "
              "between %.2f m (all stems) and %.2f m (Eq. 6)."),
            NAME_OF(belt), diameter, s->spacing, r->adc.gsteiger_stems, r->adc.interception);
    if (r->warnings & CEDUO_WARNING_WIDE_SPACING)
        ceduo_words_format(sink, context,
                           _("%s: the shoots of a stool stand so far apart (%g m) that the rock can pass between two of them."),
                           NAME_OF(belt), s->spacing);
    if (r->warnings & CEDUO_WARNING_DORREN_THIN)
        ceduo_words_format(
            sink, context,
            _("%s: the energy model dorren is used for stems below 10 cm, outside its data; it overestimates there."),
            NAME_OF(belt));
    if (r->warnings & CEDUO_WARNING_RATIO_ASSUMED)
        ceduo_words_format(sink, context, _("%s: no fracture ratio is published for this species; 1 is assumed."),
                           NAME_OF(belt));
    if (r->warnings & CEDUO_WARNING_LOW)
        ceduo_words_format(
            sink, context,
            _("%s: stumps and logs are among the contacts of the index, but the lights of contact and free run do "
              "not count them: a rock flies over them."),
            NAME_OF(belt));
    const struct ceduo_stems *first =
        NULL; /* first kind of stem with a volume by form factor; too thick ones are reported above */
    size_t n = 0;
    for (size_t i = 0; r->warnings & CEDUO_WARNING_FORM_FACTOR && get_stems(s, i); i++) {
        enum ceduo_volume_from from;
        ceduo_stem_volume(s, get_stems(s, i), &from);
        if (from == CEDUO_VOLUME_FORM_FACTOR && get_stems(s, i)->per_ha > 0 &&
            !(ceduo_stem_warnings(s, get_stems(s, i)) & CEDUO_WARNING_THICK))
            first = n++ == 0 ? get_stems(s, i) : first;
    }
    if (n > 0)
        ceduo_words_format(
            sink, context,
            s->species < 0
                ? ngettext("%s: no species is given, and no volume for %zu kind of stem (%.3g cm, %.3g m tall); form "
                           "factor 0.5 is assumed.",
                           "%s: no species is given, and no volume for %zu kinds of stem (the first %.3g cm, %.3g m "
                           "tall); form factor 0.5 is assumed.",
                           n)
                : ngettext("%s: %zu kind of stem (%.3g cm, %.3g m tall) lies outside the data of its species' volume equation; "
                           "the form factor of the nearest size is assumed.",
                           "%s: %zu kinds of stem (the first %.3g cm, %.3g m tall) lie outside the data of their "
                           "species' volume equation; the form factor of the nearest size is assumed.",
                           n),
            NAME_OF(belt), n, first->dbh * 100, first->height);
    if (r->warnings & CEDUO_WARNING_U_ASSUMED)
        ceduo_words_format(sink, context, _("%s: the work of breaking is that of beech, %g J/m3, assumed for this species."),
                           NAME_OF(belt), ceduo_stand_u(s));
}

/* ---- lights ---- */

const char *ceduo_words_verdict(enum ceduo_light light)
{
    return light == CEDUO_LIGHT_PASS ? _("passes") : light == CEDUO_LIGHT_FAIL ? _("FAILS") : _("unknown");
}

/* Append why contact or free run passes or fails. */
static void append_test_reason(struct text *text, const struct ceduo_index *s, double limit, bool contact)
{
    const char *adc = VS_LIMIT(s->worst_adc, 3, limit);
    if (contact && s->contact == CEDUO_LIGHT_PASS)
        ceduo_text_format(text, _("Every belt has an ADC below %g m (%s m at most) and no gap is longer."), limit, adc);
    else if (!(s->length > 0))
        ceduo_text_append(text, _("No stem stands on the path."));
    else if (s->longest_gap > limit)
        ceduo_text_format(text, _("A gap of %s m has no forest; a rock reaches full speed in %g m."),
                          SIG_TRIMMED(s->longest_gap, 6), limit);
    else if (!contact)
        ceduo_text_format(text, _("Chance of %g m without a contact at worst %s %% (10 %% is allowed)."), limit,
                          PERCENT_VS_LIMIT(s->worst_free_run, CEDUO_FREE_RUN_MAX));
    else if (isinf(s->worst_adc))
        ceduo_text_format(text, _("In a belt no stem counts; a rock reaches full speed in %g m."), limit);
    else
        ceduo_text_format(text, _("A belt has an ADC of %s m; a rock reaches full speed in %g m."), adc, limit);
}

void ceduo_words_test(struct text *text, const struct ceduo_result *result, size_t option, size_t control, size_t test)
{
    static const char *const sentences[] = {N_("Contact: %s."), N_("Free run: %s."), N_("Energy: %s.")};
    const struct ceduo_index *s = &result->options[option].controls[control];
    const enum ceduo_light lights[] = {s->contact, s->free_run, s->energy}, thick[] = {s->thick.contact, s->thick.free_run};
    double limit = result->scene->simulation.threshold, counted = result->scene->simulation.contact_dbh;
    ceduo_text_append_with(text, _(sentences[test]), ceduo_words_verdict(lights[test]));
    ceduo_text_append_char(text, ' ');
    if (test == 2) {
        ceduo_words_judgement_reason(text, result, control, ceduo_result_wooded(result, option, control));
        return;
    }
    append_test_reason(text, s, limit, test == 0);
    if (test == 0 && counted > 0)
        ceduo_text_append_joined(text, " ", _("Stems below %g cm do not count."), counted * 100);
    if (thick[test] == lights[test])
        return;
    bool stems = test == 1 || isfinite(s->thick.worst_adc);
    ceduo_text_append_joined(text, " ", _("It fails if only stems from %g cm on count: %s%s."),
                             fmax(counted, CEDUO_THICK_DBH) * 100,
                             !stems      ? _("no stems")
                             : test == 0 ? VS_LIMIT(s->thick.worst_adc, 3, limit)
                                         : PERCENT_VS_LIMIT(s->thick.worst_free_run, CEDUO_FREE_RUN_MAX),
                             !stems      ? ""
                             : test == 0 ? " m"
                                         : " %");
}

#define NAMED_MAX 2 /* more options are only counted */

void ceduo_words_thin_stems(const struct ceduo_result *r, ceduo_sentence_sink *sink, void *context)
{
    LOCAL_TEXT(options);
    size_t n = 0;
    for (size_t i = 0; r->scene->controls_count > 0 && i < r->options_count; i++)
        if (ceduo_index_depends_on_thin_stems(ceduo_result_last_index(r, i)))
            ceduo_text_format(&options, "%s'%s'", n++ > 0 ? ", " : ": ", NAME_OF(&r->scene->options[i]));
    if (n == 0)
        return;
    if (r->options_count == 1 || n > NAMED_MAX)
        ceduo_text_cut(&options, 0);
    if (n > NAMED_MAX)
        ceduo_text_format(&options, _(" in %zu of %zu options"), n, r->options_count);
    ceduo_words_format(sink, context, _("If only stems from %g cm on count, contact or free run fails today%s."),
                       CEDUO_THICK_DBH * 100, ceduo_text_string(&options));
}

/* ---- profile ---- */

void ceduo_words_points(struct text *text, const struct ceduo_slope *slope)
{
    size_t given = slope->points > 0 ? slope->points : slope->vertices;
    ceduo_text_format(text, ngettext("%zu point", "%zu points", given), given);
    if (slope->simplified_to > 0)
        ceduo_text_format(text, _(", %zu after simplifying to %g m"), slope->vertices, slope->simplified_to);
}

void ceduo_words_topography(struct text *text, const struct ceduo_topography *t, bool brief)
{
    ceduo_text_append_joined(text, text->length > 0 ? ", " : "",
                             brief ? _("reach %.0f\xc2\xb0") : _("reach angle %.0f\xc2\xb0"), t->reach * DEGREES);
    if (!isnan(t->shadow))
        ceduo_text_append_joined(text, ", ", brief ? _("shadow %.0f\xc2\xb0") : _("shadow angle %.0f\xc2\xb0"),
                                 t->shadow * DEGREES);
}
