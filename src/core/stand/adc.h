/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_ADC_H
#define CEDUO_ADC_H

#include "ceduo/simulate.h"

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

/* Return which of SLENDER, STOUT and THICK apply to one kind of stem. */
unsigned ceduo_stem_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems);

unsigned ceduo_stand_warnings(const struct ceduo_stand *stand, double b, enum ceduo_rule rule);

#endif
