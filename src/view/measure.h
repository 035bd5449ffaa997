/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MEASURE_H
#define CEDUO_MEASURE_H

#include "base/text.h"
#include "ceduo/surface.h"
#include "study/verdict.h"

/* A figure of an answer and what people call it: made here once, for pages, pictures, panes and the column. */

enum ceduo_measure_name {
    CEDUO_HEAD,       /* of a column that has room: "of 1000 > 50 kJ" */
    CEDUO_SHORT_HEAD, /* "> 50 kJ" */
    CEDUO_ROW,        /* before the figure: "above 50 kJ" */
    CEDUO_PHRASE,     /* in a sentence: "arrive with more than 50 kJ" */
    CEDUO_MEASURE_NAMES
};

struct ceduo_measure {
    double value, lo, hi;                   /* in the unit shown; NaN: not known, or no interval */
    double half;                            /* of a share: half the width of its interval, not rounded */
    double may_lo, may_hi;                  /* 90 % of what may be true; NaN: not known, see ceduo_measure_doubt() */
    int digits;                             /* significant; 0: a whole number */
    const char *names[CEDUO_MEASURE_NAMES]; /* marked for translation; %s in a name is the limit */
    double limit;
};

/* Of 1000 rocks released those that arrive, and those that a control is judged by: that arrive with more than it withstands, or
 * at all where that is not given. `arrivals` NULL: not known. */
struct ceduo_measure ceduo_arriving(const struct ceduo_arrivals *arrivals);
struct ceduo_measure ceduo_judged(const struct ceduo_control *control, const struct ceduo_arrivals *arrivals);

/* Such a share with half its interval, as that of years is known. */
struct ceduo_measure ceduo_share(struct ceduo_portion share);

/* Sets the 90 % range of a fit, `scale` being units shown; it holds the measure's value. */
void ceduo_measure_range(struct ceduo_measure *measure, const struct ceduo_surface_fit *fit, double scale);

/* Sets what doubt makes of such a share of an option at a control; of any but the last it is not known. `doubt` may be NULL. */
struct ceduo_doubt_report;
void ceduo_measure_doubt(struct ceduo_measure *measure, const struct ceduo_doubt_report *doubt, size_t option, size_t control);

/* The same of its mean over the years, which is known where that was asked for. */
void ceduo_measure_doubt_over(struct ceduo_measure *measure, const struct ceduo_doubt_report *doubt, size_t option);

/* The mean energy of the rocks that arrive, that below which 95 % of them stay, and that of all released, in kJ. */
struct ceduo_measure ceduo_mean_energy(const struct ceduo_arrivals *arrivals);
struct ceduo_measure ceduo_energy_p95(const struct ceduo_arrivals *arrivals);
struct ceduo_measure ceduo_energy_released(const struct ceduo_arrivals *arrivals);

/* Of 1000 those that end before the control in one way; the height under the rocks that 95 % of those that arrive stay below, m. */
struct ceduo_measure ceduo_missed(const struct ceduo_arrivals *arrivals, enum ceduo_end end);
struct ceduo_measure ceduo_height_p95(const struct ceduo_arrivals *arrivals);

/* Adds a name of a measure; its value, "-" where it is not known; "480 (453–501)"; an interval alone, "453–501". */
void ceduo_measure_name(struct text *text, const struct ceduo_measure *m, enum ceduo_measure_name name);
void ceduo_measure_value(struct text *text, const struct ceduo_measure *m);
void ceduo_measure_interval(struct text *text, const struct ceduo_measure *m);
/* The same, shorter, "480 ±27", or "480±27" with nothing between the two; of one rock, whose error is not known, "480". */
void ceduo_measure_error(struct text *text, const struct ceduo_measure *m, const char *between);
void ceduo_measure_span(struct text *text, const struct ceduo_measure *m, double lo, double hi);
/* By both errors: what may be true, and what the number of rocks leaves open, which doubt may be less than. */
void ceduo_measure_may_be(struct text *text, const struct ceduo_measure *m);

#endif
