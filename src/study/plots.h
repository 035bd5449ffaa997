/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_PLOTS_H
#define CEDUO_PLOTS_H

#include "ceduo/survey.h"

/* Return the horizontal area (m2) of a plot of `area` m2 measured along a slope. */
double ceduo_survey_horizontal(double area, double slope_rad);

#define CEDUO_SURVEY_ALL (-2)

/* Return the basal area of a species (-1: not given) or of CEDUO_SURVEY_ALL, summed over the plots, without stumps. For shares
 * only: squared diameters (m2) per m2. */
double ceduo_survey_basal_area(const struct ceduo_survey *survey, int species);

#define CEDUO_SURVEY_CLASS   0.05 /* m of dbh: the width of a class */
#define CEDUO_SURVEY_SPACING 0.35 /* m between the shoots of a stool if not measured; assumed, as in the presets */

/* Relative uncertainty of heights if none was measured (assumed). */
#define CEDUO_SURVEY_HEIGHT_UNCERTAINTY 0.3

#endif
