/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "ceduo/adc.h"

#include <math.h>

static const double PI = 3.14159265358979323846;

#define HECTARE 1e4 /* m2 */

/* Sums over stems: how many, of how much diameter, and their share of energy. */
struct stratum {
    double n, n_d, n_w; /* per ha: count, count × dbh, count × energy of a contact */
};

static struct stratum add_up(const struct ceduo_stand *stand, const struct ceduo_stems *stems, size_t n)
{
    struct stratum s = {0, 0, 0};
    for (size_t i = 0; i < n; i++) {
        s.n += stems[i].per_ha;
        s.n_d += stems[i].per_ha * stems[i].dbh;
        s.n_w += stems[i].per_ha * ceduo_contact_energy(stand, &stems[i]);
    }
    return s;
}

static double mean_shoot_dbh(const struct ceduo_stand *stand)
{
    struct stratum s = add_up(stand, stand->shoots, stand->shoots_count);
    return s.n > 0 ? s.n_d / s.n : 0;
}

static double mean_dbh(const struct ceduo_stand *stand)
{
    struct stratum c = add_up(stand, stand->shoots, stand->shoots_count);
    struct stratum t = add_up(stand, stand->trees, stand->trees_count);
    return c.n + t.n > 0 ? (c.n_d + t.n_d) / (c.n + t.n) : 0;
}

double ceduo_stool_radius(unsigned n, double s)
{
    return n < 2 ? 0 : s / (2 * sin(PI / n));
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

/* Width in metres that a stool offers to a rock of diameter b, in one of the forms. */
static double stool_width(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    double d = mean_shoot_dbh(stand), n = ceduo_stand_shoots(stand) / stand->stools_per_ha;
    switch (rule) {
    case CEDUO_GSTEIGER_STOOLS:
        return b + mean_dbh(stand);
    case CEDUO_GSTEIGER_STEMS:
        return n * (b + d);
    case CEDUO_INTERCEPTION:
        return b + d + stand->spacing;
    default:
        return b + d + ceduo_stool_perimeter(n, stand->spacing) / PI;
    }
}

static double tree_width(const struct ceduo_stand *stand, const struct ceduo_stems *tree, double b, enum ceduo_rule rule)
{
    return b + (rule == CEDUO_GSTEIGER_STOOLS ? mean_dbh(stand) : tree->dbh);
}

/* The form's denominator, m per ha: A/ADC. */
static double width_per_ha(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    double sum = stand->shoots_count > 0 ? stand->stools_per_ha * stool_width(stand, b, rule) : 0;
    for (size_t i = 0; i < stand->trees_count; i++)
        sum += stand->trees[i].per_ha * tree_width(stand, &stand->trees[i], b, rule);
    return sum;
}

struct ceduo_adc ceduo_adc(const struct ceduo_stand *stand, double b)
{
    return (struct ceduo_adc){.gsteiger_stools = HECTARE / width_per_ha(stand, b, CEDUO_GSTEIGER_STOOLS),
                              .gsteiger_stems = HECTARE / width_per_ha(stand, b, CEDUO_GSTEIGER_STEMS),
                              .interception = HECTARE / width_per_ha(stand, b, CEDUO_INTERCEPTION),
                              .crofton = HECTARE / width_per_ha(stand, b, CEDUO_CROFTON)};
}

enum ceduo_rule ceduo_adc_rule(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    if (rule != CEDUO_RULE_AUTO)
        return rule;
    return stand->shoots_count == 0 || b < stand->spacing ? CEDUO_GSTEIGER_STEMS : CEDUO_INTERCEPTION;
}

double ceduo_adc_value(const struct ceduo_adc *adc, enum ceduo_rule rule)
{
    switch (rule) {
    case CEDUO_GSTEIGER_STOOLS:
        return adc->gsteiger_stools;
    case CEDUO_GSTEIGER_STEMS:
        return adc->gsteiger_stems;
    case CEDUO_INTERCEPTION:
        return adc->interception;
    default:
        return adc->crofton;
    }
}

double ceduo_energy_per_metre(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    rule = ceduo_adc_rule(stand, b, rule);
    double sum = 0;
    if (stand->shoots_count > 0 && rule == CEDUO_GSTEIGER_STEMS) {
        for (size_t i = 0; i < stand->shoots_count; i++) /* each cohort is its own stratum */
            sum += stand->shoots[i].per_ha * (b + stand->shoots[i].dbh) * ceduo_contact_energy(stand, &stand->shoots[i]);
    } else if (stand->shoots_count > 0) {
        struct stratum s = add_up(stand, stand->shoots, stand->shoots_count);
        sum += stand->stools_per_ha * stool_width(stand, b, rule) * (s.n_w / s.n);
    }
    for (size_t i = 0; i < stand->trees_count; i++) {
        const struct ceduo_stems *t = &stand->trees[i];
        sum += t->per_ha * tree_width(stand, t, b, rule) * ceduo_contact_energy(stand, t);
    }
    return sum / HECTARE;
}

static unsigned stems_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems, size_t n)
{
    unsigned warnings = 0;
    for (size_t i = 0; i < n; i++) {
        enum ceduo_volume_from from;
        ceduo_stem_volume(stand, &stems[i], &from);
        if (stand->energy == CEDUO_DORREN && stems[i].dbh < 0.1)
            warnings |= CEDUO_WARN_DORREN_THIN;
        if (stand->energy == CEDUO_BRAUNER && from == CEDUO_VOLUME_FORM_FACTOR)
            warnings |= CEDUO_WARN_FORM_FACTOR;
    }
    return warnings;
}

unsigned ceduo_stand_warnings(const struct ceduo_stand *stand, double b, enum ceduo_rule rule)
{
    if (ceduo_stand_is_bare(stand))
        return 0;
    unsigned warnings = stems_warnings(stand, stand->shoots, stand->shoots_count) |
                        stems_warnings(stand, stand->trees, stand->trees_count);
    size_t count;
    bool known = stand->species >= 0 && ceduo_species_list(&count)[stand->species].u_literature;
    if (stand->energy == CEDUO_BRAUNER && isnan(stand->u) && !known)
        warnings |= CEDUO_WARN_U_ASSUMED;
    if (stand->shoots_count == 0)
        return warnings;
    struct ceduo_adc adc = ceduo_adc(stand, b);
    if (adc.interception < adc.gsteiger_stems)
        warnings |= CEDUO_WARN_BELOW_FREE_PATH;
    if (rule == CEDUO_RULE_AUTO && fabs(b - stand->spacing) < 0.1 * b)
        warnings |= CEDUO_WARN_NEAR_JUMP;
    if (stand->spacing > b + mean_shoot_dbh(stand))
        warnings |= CEDUO_WARN_WIDE_SPACING;
    return warnings;
}
