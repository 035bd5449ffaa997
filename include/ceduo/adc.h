/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ADC_H
#define CEDUO_ADC_H

#include "scene.h"

/* Metres between contacts in each form, counting stems from stand->counted_from on; infinite where there are none. A stool
 * counts with its shoots that do. */
struct ceduo_adc {
    double gsteiger_stools, gsteiger_stems, interception, crofton;
};

/* All four for a rock of mean diameter b (m, > 0). */
struct ceduo_adc ceduo_adc(const struct ceduo_stand *stand, double b);

/* The rule that AUTO means here; any other rule is returned as it is. */
enum ceduo_rule ceduo_adc_rule(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

/* The value of one form (not AUTO). */
double ceduo_adc_value(const struct ceduo_adc *adc, enum ceduo_rule rule);

/* Radius (m) of the ring on which n shoots stand, neighbours s apart: s/(2 sin(pi/n)); 0 for one. */
double ceduo_stool_radius(unsigned n, double s);

/* Mean perimeter P (m) of the hull of a stool's shoots, neighbours s apart on a ring: 0, 2s, 3s, 4s … for 1, 2, 3, 4 …
 * shoots; a fraction is a mixture of the two whole numbers. */
double ceduo_stool_perimeter(double shoots_per_stool, double s);

/* Energy (J) taken per horizontal metre in the mean, by the chosen form, stratum by stratum (Eq. 2 to 4): each stratum's
 * own share of the form's denominator times its own energy per contact. */
double ceduo_energy_per_metre(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

/* What a reader should know of a stand and a rock. A set of bits. */
enum ceduo_stand_warning {
    CEDUO_WARN_BELOW_FREE_PATH = 1 << 0, /* interception < gsteiger-stems: s > (n - 1)(B + d): no path can have it */
    CEDUO_WARN_NEAR_JUMP = 1 << 1,       /* B within 10 % of s, where the rule auto jumps */
    CEDUO_WARN_DORREN_THIN = 1 << 2,     /* dorren below 10 cm: outside its data */
    CEDUO_WARN_FORM_FACTOR = 1 << 3,     /* a volume by form factor, outside the species' equation */
    CEDUO_WARN_RATIO_ASSUMED = 1 << 5,   /* fracture ratio 1 assumed for a species without one */
    CEDUO_WARN_U_ASSUMED = 1 << 4,       /* U of beech assumed for another species */
    CEDUO_WARN_WIDE_SPACING = 1 << 6,    /* s > B + d: the rock can pass between two shoots; crofton is not exact */
    CEDUO_WARN_LOW = 1 << 7,             /* stumps or logs: contacts, but no stems that count */
    CEDUO_WARN_BASAL_AREA = 1 << 8,      /* what hardly any stand has, so that it may be a mistake: more than these */
    CEDUO_WARN_MANY_SHOOTS = 1 << 9,
    CEDUO_WARN_SLENDER = 1 << 10,
    CEDUO_WARN_STOUT = 1 << 11,   /* or less than this */
    CEDUO_WARN_THICK = 1 << 12,   /* thicker than any stem that its species' volumes were measured on */
    CEDUO_WARN_UNLIKELY = 31 << 8 /* any of the last five */
};

/* Beyond these a stand is unlikely (assumed). */
#define CEDUO_BASAL_AREA_MAX  60  /* m2/ha */
#define CEDUO_SHOOTS_MAX      15  /* on a stool, all cohorts together */
#define CEDUO_SLENDERNESS_MAX 150 /* height over dbh */
#define CEDUO_SLENDERNESS_MIN 25

/* How one kind of stem is unlikely: of SLENDER, STOUT and THICK. */
unsigned ceduo_stem_unlikely(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

unsigned ceduo_stand_warnings(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

#endif
