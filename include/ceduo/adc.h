/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ADC_H
#define CEDUO_ADC_H

#include "scene.h"

/* Distance between contacts in each form, m, over stems from stand->counted_from on; infinite without such stems. A stool
 * counts with its counted shoots. */
struct ceduo_adc {
    double gsteiger_stools, gsteiger_stems, interception, crofton;
};

/* Return all four for a rock of mean diameter b (m, > 0). */
struct ceduo_adc ceduo_adc(const struct ceduo_stand *stand, double b);

/* Return the rule that AUTO selects; any other rule is returned unchanged. */
enum ceduo_rule ceduo_adc_rule(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

/* Return the value of one form (not AUTO). */
double ceduo_adc_value(const struct ceduo_adc *adc, enum ceduo_rule rule);

/* Return the radius (m) of the ring of n shoots at spacing s: s/(2 sin(pi/n)); 0 for one shoot. */
double ceduo_stool_radius(unsigned n, double s);

/* Return the mean perimeter P (m) of the hull of a stool's shoots on a ring at spacing s: 0, 2s, 3s, 4s … for 1, 2, 3, 4 …
 * shoots. A fractional number is a mixture of the two nearest integers. */
double ceduo_stool_perimeter(double shoots_per_stool, double s);

/* Return the mean energy (J) taken per horizontal metre by the chosen form (Eq. 2 to 4). Each stratum adds its share of the
 * form's denominator times its energy per contact. */
double ceduo_energy_per_metre(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

/* Warnings about a stand and a rock, as a bit set. */
enum ceduo_stand_warning {
    CEDUO_WARN_BELOW_FREE_PATH = 1 << 0, /* interception < gsteiger-stems: s > (n - 1)(B + d), impossible for any path */
    CEDUO_WARN_NEAR_JUMP = 1 << 1,       /* B within 10 % of s, at which rule auto jumps */
    CEDUO_WARN_DORREN_THIN = 1 << 2,     /* dorren below 10 cm: outside its data */
    CEDUO_WARN_FORM_FACTOR = 1 << 3,     /* a volume by form factor, outside the species' equation */
    CEDUO_WARN_RATIO_ASSUMED = 1 << 5,   /* fracture ratio 1 assumed for a species without one */
    CEDUO_WARN_U_ASSUMED = 1 << 4,       /* U of beech assumed for another species */
    CEDUO_WARN_WIDE_SPACING = 1 << 6,    /* s > B + d: the rock can pass between two shoots; crofton is not exact */
    CEDUO_WARN_LOW = 1 << 7,             /* stumps or logs: contacts, but no stems that count */
    CEDUO_WARN_BASAL_AREA = 1 << 8,      /* implausible, probably a typing error: above CEDUO_BASAL_AREA_MAX */
    CEDUO_WARN_MANY_SHOOTS = 1 << 9,     /* likewise, above CEDUO_SHOOTS_MAX */
    CEDUO_WARN_SLENDER = 1 << 10,        /* likewise, above CEDUO_SLENDERNESS_MAX */
    CEDUO_WARN_STOUT = 1 << 11,          /* likewise, below CEDUO_SLENDERNESS_MIN */
    CEDUO_WARN_THICK = 1 << 12,          /* thicker than any stem measured for the volume equation of its species */
    CEDUO_WARN_IMPLAUSIBLE = 31 << 8     /* any of the last five */
};

/* Limits beyond which a stand is implausible (assumed). */
#define CEDUO_BASAL_AREA_MAX  60  /* m2/ha */
#define CEDUO_SHOOTS_MAX      15  /* per stool, all cohorts together */
#define CEDUO_SLENDERNESS_MAX 150 /* height over dbh */
#define CEDUO_SLENDERNESS_MIN 25

/* Return which of SLENDER, STOUT and THICK apply to one kind of stem. */
unsigned ceduo_stem_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

unsigned ceduo_stand_warnings(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

#endif
