/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/adc.h"

#include <math.h>

#include "base/elementary.h"
#include "energy.h"
#include "strata.h"

/* ---- stems that count ---- */

static bool counts(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    return stems->per_ha > 0 && stems->dbh >= stand->counted_from;
}

struct count {
    double per_ha, dbh; /* dbh: their mean, 0 of none */
};

static struct count count_stems(const struct ceduo_stand *stand, bool trees_too)
{
    double count = 0, sum = 0;
    for (size_t i = 0; i < stand->shoots_count + (trees_too ? stand->trees_count : 0); i++) {
        const struct ceduo_stems *s = i < stand->shoots_count ? &stand->shoots[i] : &stand->trees[i - stand->shoots_count];
        if (!counts(stand, s))
            continue;
        count += s->per_ha;
        sum += s->per_ha * s->dbh;
    }
    return (struct count){count, count > 0 ? sum / count : 0};
}

static double shoots(const struct ceduo_stand *stand)
{
    return stand->stools_per_ha > 0 ? count_stems(stand, false).per_ha : 0;
}

/* A stool has one shoot at least. */
static double stools(const struct ceduo_stand *stand)
{
    return fmin(stand->stools_per_ha, shoots(stand));
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

static double perimeter_of(double n, double s)
{
    return n < 2 ? 0 : n * s;
}

double ceduo_stool_perimeter(double shoots_per_stool, double s)
{
    double whole = floor(shoots_per_stool), part = shoots_per_stool - whole;
    double p = perimeter_of(whole, s);
    return part > 0 ? (1 - part) * p + part * perimeter_of(whole + 1, s) : p;
}

/* ---- strata ---- */

/* One term of a form's denominator: what is met as one, how wide each stands beyond the rock's own diameter, and what a
 * contact with it takes. A rock of diameter b meets it per_ha (b + width)/HECTARE times a metre. */
struct stratum {
    double per_ha;
    double width;  /* m */
    double energy; /* J */
};

/* The stools, in one of the forms that take each as one. */
static struct stratum stools_as_one(const struct ceduo_stand *stand, enum ceduo_rule rule)
{
    double count = 0, energy = 0, width = count_stems(stand, rule == CEDUO_GSTEIGER_STOOLS).dbh;
    for (size_t i = 0; i < stand->shoots_count; i++) {
        if (!counts(stand, &stand->shoots[i]))
            continue;
        count += stand->shoots[i].per_ha;
        energy += stand->shoots[i].per_ha * ceduo_contact_energy(stand, &stand->shoots[i]);
    }
    if (rule == CEDUO_INTERCEPTION)
        width += stand->spacing;
    else if (rule != CEDUO_GSTEIGER_STOOLS)
        width += ceduo_stool_perimeter(shoots(stand) / stools(stand), stand->spacing) / M_PI;
    return (struct stratum){stools(stand), width, energy / count};
}

/* How many strata the shoots make. */
static size_t shoot_strata(const struct ceduo_stand *stand, enum ceduo_rule rule)
{
    return rule == CEDUO_GSTEIGER_STEMS ? stand->shoots_count : shoots(stand) > 0;
}

/* The strata of a stand by a form of the ADC (not AUTO): the stools, or with gsteiger-stems each cohort of shoots, then
 * each class of trees, stumps and logs. */
static size_t strata_count(const struct ceduo_stand *stand, enum ceduo_rule rule)
{
    return shoot_strata(stand, rule) + stand->trees_count + (stand->stumps.per_ha > 0) + (stand->logs.per_ha > 0);
}

double ceduo_log_width(double length)
{
    return 2 * length / M_PI;
}

static struct stratum stratum_of(const struct ceduo_stand *stand, enum ceduo_rule rule, size_t i)
{
    size_t n = shoot_strata(stand, rule);
    if (i < n && rule != CEDUO_GSTEIGER_STEMS)
        return stools_as_one(stand, rule);
    const struct ceduo_stumps *low = &stand->stumps; /* stumps if there are any, then logs */
    if (i == n + stand->trees_count && low->per_ha > 0)
        return (struct stratum){low->per_ha, low->diameter, low->energy};
    if (i >= n + stand->trees_count)
        return (struct stratum){stand->logs.per_ha, ceduo_log_width(stand->logs.length), stand->logs.energy};
    const struct ceduo_stems *s = i < n ? &stand->shoots[i] : &stand->trees[i - n];
    double width = rule == CEDUO_GSTEIGER_STOOLS ? count_stems(stand, true).dbh : s->dbh;
    return (struct stratum){counts(stand, s) ? s->per_ha : 0, width, ceduo_contact_energy(stand, s)};
}

/* The form's denominator for a rock of diameter b, m per ha: A/ADC; or the same with each term times its energy. */
static double width_per_ha(const struct ceduo_stand *stand, double b, enum ceduo_rule rule, bool energies)
{
    double sum = 0;
    for (size_t i = 0, n = strata_count(stand, rule); i < n; i++) {
        struct stratum s = stratum_of(stand, rule, i);
        sum += s.per_ha * (b + s.width) * (energies ? s.energy : 1);
    }
    return sum;
}

struct ceduo_adc ceduo_adc(const struct ceduo_stand *stand, double b)
{
    return (struct ceduo_adc){.gsteiger_stools = HECTARE / width_per_ha(stand, b, CEDUO_GSTEIGER_STOOLS, false),
                              .gsteiger_stems = HECTARE / width_per_ha(stand, b, CEDUO_GSTEIGER_STEMS, false),
                              .interception = HECTARE / width_per_ha(stand, b, CEDUO_INTERCEPTION, false),
                              .crofton = HECTARE / width_per_ha(stand, b, CEDUO_CROFTON, false)};
}

enum ceduo_rule ceduo_adc_rule(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    if (rule != CEDUO_RULE_AUTO)
        return rule;
    return !(shoots(stand) > 0) || b < stand->spacing ? CEDUO_GSTEIGER_STEMS : CEDUO_INTERCEPTION;
}

double ceduo_adc_value(const struct ceduo_adc *adc, enum ceduo_rule rule)
{
    const double forms[] = {[CEDUO_GSTEIGER_STOOLS] = adc->gsteiger_stools,
                            [CEDUO_GSTEIGER_STEMS] = adc->gsteiger_stems,
                            [CEDUO_INTERCEPTION] = adc->interception,
                            [CEDUO_CROFTON] = adc->crofton};
    return forms[rule];
}

double ceduo_energy_per_metre(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    return width_per_ha(stand, b, ceduo_adc_rule(stand, b, rule), true) / HECTARE;
}

#define ABOVE(value, most) ((value) > (most) * (1 + 1e-9)) /* what is typed as the limit itself is not beyond it */

unsigned ceduo_stem_unlikely(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    size_t n;
    double slender = stems->height / stems->dbh;
    double thickest = stand->species >= 0 ? ceduo_species_list(&n)[stand->species].d_hi / 100 : INFINITY;
    if (!(stems->per_ha > 0))
        return 0;
    return (ABOVE(slender, CEDUO_SLENDERNESS_MAX) ? CEDUO_WARN_SLENDER : 0u) |
           (ABOVE(CEDUO_SLENDERNESS_MIN, slender) ? CEDUO_WARN_STOUT : 0u) |
           (ABOVE(stems->dbh, thickest) ? CEDUO_WARN_THICK : 0u);
}

unsigned ceduo_stand_warnings(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    if (ceduo_stand_is_bare(stand))
        return 0;
    unsigned warnings =
        (stand->stumps.per_ha > 0 || stand->logs.per_ha > 0 ? CEDUO_WARN_LOW : 0u) |
        (ABOVE(ceduo_stand_basal_area(stand), CEDUO_BASAL_AREA_MAX) ? CEDUO_WARN_BASAL_AREA : 0u) |
        (ABOVE(ceduo_stand_shoots(stand), CEDUO_SHOOTS_MAX * stand->stools_per_ha) ? CEDUO_WARN_MANY_SHOOTS : 0u);
    for (size_t i = 0; i < stand->shoots_count + stand->trees_count; i++) {
        const struct ceduo_stems *s = i < stand->shoots_count ? &stand->shoots[i] : &stand->trees[i - stand->shoots_count];
        warnings |= ceduo_stem_unlikely(stand, s) | (s->per_ha > 0 ? ceduo_stem_energy_warnings(stand, s) : 0);
    }
    if (!(shoots(stand) > 0))
        return warnings;
    struct ceduo_adc adc = ceduo_adc(stand, b);
    if (adc.interception < adc.gsteiger_stems)
        warnings |= CEDUO_WARN_BELOW_FREE_PATH;
    if (rule == CEDUO_RULE_AUTO && fabs(b - stand->spacing) < 0.1 * stand->spacing)
        warnings |= CEDUO_WARN_NEAR_JUMP;
    if (stand->spacing > b + count_stems(stand, false).dbh)
        warnings |= CEDUO_WARN_WIDE_SPACING;
    return warnings;
}
