/* SPDX-License-Identifier: GPL-3.0-or-later */

#include <math.h>

#include "adc.h"
#include "base/elementary.h"
#include "energy.h"
#include "scene/stand.h"
#include "strata.h"

/* ---- counted stems ---- */

static bool is_counted(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    return stems->per_ha > 0 && stems->dbh >= stand->counted_from;
}

struct stem_count {
    double per_ha, dbh; /* dbh: mean, m; 0 without stems */
};

static struct stem_count count_stems(const struct ceduo_stand *stand, bool with_trees)
{
    double count = 0, sum = 0;
    for (size_t i = 0; i < stand->shoots_count + (with_trees ? stand->trees_count : 0); i++) {
        const struct ceduo_stems *s = i < stand->shoots_count ? &stand->shoots[i] : &stand->trees[i - stand->shoots_count];
        if (!is_counted(stand, s))
            continue;
        count += s->per_ha;
        sum += s->per_ha * s->dbh;
    }
    return (struct stem_count){count, count > 0 ? sum / count : 0};
}

static double counted_shoots(const struct ceduo_stand *stand)
{
    return stand->stools_per_ha > 0 ? count_stems(stand, false).per_ha : 0;
}

/* A stool has at least one shoot. */
static double counted_stools(const struct ceduo_stand *stand)
{
    return fmin(stand->stools_per_ha, counted_shoots(stand));
}

/* ---- geometry ---- */

double ceduo_stool_radius(unsigned n, double s)
{
    if (n < 2)
        return 0;
    double angle = M_PI / n, sine, cosine;
    elementary_sincos(&angle, &sine, &cosine);
    return s / (2 * sine);
}

static double ring_perimeter(double n, double s)
{
    return n < 2 ? 0 : n * s;
}

double ceduo_stool_perimeter(double shoots_per_stool, double s)
{
    double integer = floor(shoots_per_stool), part = shoots_per_stool - integer;
    double p = ring_perimeter(integer, s);
    return part > 0 ? (1 - part) * p + part * ring_perimeter(integer + 1, s) : p;
}

/* ---- strata ---- */

/* One term of a form's denominator. A rock of diameter b has per_ha (b + width)/HECTARE contacts per metre with it. */
struct adc_term {
    double per_ha;
    double width;  /* m, in addition to the rock's diameter */
    double energy; /* J per contact */
};

/* Return the term of the stools, in a form that counts each stool as one. */
static struct adc_term make_stools_term(const struct ceduo_stand *stand, enum ceduo_rule rule)
{
    double count = 0, energy = 0, width = count_stems(stand, rule == CEDUO_RULE_GSTEIGER_STOOLS).dbh;
    for (size_t i = 0; i < stand->shoots_count; i++) {
        if (!is_counted(stand, &stand->shoots[i]))
            continue;
        count += stand->shoots[i].per_ha;
        energy += stand->shoots[i].per_ha * ceduo_contact_energy(stand, &stand->shoots[i]);
    }
    if (rule == CEDUO_RULE_INTERCEPTION)
        width += stand->spacing;
    else if (rule != CEDUO_RULE_GSTEIGER_STOOLS)
        width += ceduo_stool_perimeter(counted_shoots(stand) / counted_stools(stand), stand->spacing) / M_PI;
    return (struct adc_term){counted_stools(stand), width, energy / count};
}

/* Return the number of terms of the shoots. */
static size_t count_shoot_terms(const struct ceduo_stand *stand, enum ceduo_rule rule)
{
    return rule == CEDUO_RULE_GSTEIGER_STEMS ? stand->shoots_count : counted_shoots(stand) > 0;
}

/* Return the number of terms of a stand in a form of the ADC (not AUTO). These are the stools, or with gsteiger-stems each
 * cohort of shoots, then each class of trees, stumps and logs. */
static size_t count_terms(const struct ceduo_stand *stand, enum ceduo_rule rule)
{
    return count_shoot_terms(stand, rule) + stand->trees_count + (stand->stumps.per_ha > 0) + (stand->logs.per_ha > 0);
}

double ceduo_log_width(double length)
{
    return 2 * length / M_PI;
}

static struct adc_term make_term(const struct ceduo_stand *stand, enum ceduo_rule rule, size_t i)
{
    size_t n = count_shoot_terms(stand, rule);
    if (i < n && rule != CEDUO_RULE_GSTEIGER_STEMS)
        return make_stools_term(stand, rule);
    const struct ceduo_stumps *stumps = &stand->stumps; /* stumps if any, then logs */
    if (i == n + stand->trees_count && stumps->per_ha > 0)
        return (struct adc_term){stumps->per_ha, stumps->diameter, stumps->energy};
    if (i >= n + stand->trees_count)
        return (struct adc_term){stand->logs.per_ha, ceduo_log_width(stand->logs.length), stand->logs.energy};
    const struct ceduo_stems *s = i < n ? &stand->shoots[i] : &stand->trees[i - n];
    double width = rule == CEDUO_RULE_GSTEIGER_STOOLS ? count_stems(stand, true).dbh : s->dbh;
    return (struct adc_term){is_counted(stand, s) ? s->per_ha : 0, width, ceduo_contact_energy(stand, s)};
}

/* Return the form's denominator for a rock of diameter b, m per ha: A/ADC; with `energies` each term times its energy. */
static double denominator_per_ha(const struct ceduo_stand *stand, double b, enum ceduo_rule rule, bool energies)
{
    double sum = 0;
    for (size_t i = 0, n = count_terms(stand, rule); i < n; i++) {
        struct adc_term s = make_term(stand, rule, i);
        sum += s.per_ha * (b + s.width) * (energies ? s.energy : 1);
    }
    return sum;
}

struct ceduo_adc ceduo_adc(const struct ceduo_stand *stand, double b)
{
    return (struct ceduo_adc){.gsteiger_stools = HECTARE / denominator_per_ha(stand, b, CEDUO_RULE_GSTEIGER_STOOLS, false),
                              .gsteiger_stems = HECTARE / denominator_per_ha(stand, b, CEDUO_RULE_GSTEIGER_STEMS, false),
                              .interception = HECTARE / denominator_per_ha(stand, b, CEDUO_RULE_INTERCEPTION, false),
                              .crofton = HECTARE / denominator_per_ha(stand, b, CEDUO_RULE_CROFTON, false)};
}

enum ceduo_rule ceduo_adc_rule(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    if (rule != CEDUO_RULE_AUTO)
        return rule;
    return !(counted_shoots(stand) > 0) || b < stand->spacing ? CEDUO_RULE_GSTEIGER_STEMS : CEDUO_RULE_INTERCEPTION;
}

double ceduo_adc_value(const struct ceduo_adc *adc, enum ceduo_rule rule)
{
    const double forms[] = {[CEDUO_RULE_GSTEIGER_STOOLS] = adc->gsteiger_stools,
                            [CEDUO_RULE_GSTEIGER_STEMS] = adc->gsteiger_stems,
                            [CEDUO_RULE_INTERCEPTION] = adc->interception,
                            [CEDUO_RULE_CROFTON] = adc->crofton};
    return forms[rule];
}

double ceduo_energy_per_metre(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    return denominator_per_ha(stand, b, ceduo_adc_rule(stand, b, rule), true) / HECTARE;
}

#define ABOVE(value, limit) ((value) > (limit) * (1 + 1e-9)) /* a value typed as the limit is not above it */

unsigned ceduo_stem_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    size_t n;
    double slender = stems->height / stems->dbh;
    double dbh_max = stand->species >= 0 ? ceduo_species_list(&n)[stand->species].d_hi / 100 : INFINITY;
    if (!(stems->per_ha > 0))
        return 0;
    return (ABOVE(slender, CEDUO_SLENDERNESS_MAX) ? CEDUO_WARNING_SLENDER : 0u) |
           (ABOVE(CEDUO_SLENDERNESS_MIN, slender) ? CEDUO_WARNING_STOUT : 0u) |
           (ABOVE(stems->dbh, dbh_max) ? CEDUO_WARNING_THICK : 0u);
}

unsigned ceduo_stand_warnings(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    if (ceduo_stand_is_bare(stand))
        return 0;
    unsigned warnings =
        (stand->stumps.per_ha > 0 || stand->logs.per_ha > 0 ? CEDUO_WARNING_LOW : 0u) |
        (ABOVE(ceduo_stand_basal_area(stand), CEDUO_BASAL_AREA_MAX) ? CEDUO_WARNING_BASAL_AREA : 0u) |
        (ABOVE(ceduo_stand_shoots(stand), CEDUO_SHOOTS_MAX * stand->stools_per_ha) ? CEDUO_WARNING_MANY_SHOOTS : 0u);
    for (size_t i = 0; i < stand->shoots_count + stand->trees_count; i++) {
        const struct ceduo_stems *s = i < stand->shoots_count ? &stand->shoots[i] : &stand->trees[i - stand->shoots_count];
        warnings |= ceduo_stem_warnings(stand, s) | (s->per_ha > 0 ? ceduo_stem_energy_warnings(stand, s) : 0);
    }
    if (!(counted_shoots(stand) > 0))
        return warnings;
    struct ceduo_adc adc = ceduo_adc(stand, b);
    if (adc.interception < adc.gsteiger_stems)
        warnings |= CEDUO_WARNING_BELOW_FREE_PATH;
    if (rule == CEDUO_RULE_AUTO && fabs(b - stand->spacing) < 0.1 * stand->spacing)
        warnings |= CEDUO_WARNING_NEAR_JUMP;
    if (stand->spacing > b + count_stems(stand, false).dbh)
        warnings |= CEDUO_WARNING_WIDE_SPACING;
    return warnings;
}
