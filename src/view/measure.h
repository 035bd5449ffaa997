/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_MEASURE_H
#define CEDUO_MEASURE_H

#include "base/text.h"
#include "ceduo/surface.h"
#include "words.h"

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

/* Strings of a measure, which live as long as the block that calls: a name; its value, "-" if it is not known; an interval, "453–501";
 * both, "480 (453–501)"; shorter, "480 ±27" or "480±27" with nothing `between`, and "480" of one rock, whose error is not known. MAY_BE:
 * the interval by both errors, as the uncertain inputs may leave less open than the number of rocks. */
const char *ceduo_measure_name(struct ceduo_measure m, enum ceduo_measure_name name, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_value(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_span(struct ceduo_measure m, double lo, double hi, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_interval(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_error(struct ceduo_measure m, const char *between, char room[CEDUO_WORDS_ROOM]);
const char *ceduo_measure_may_be(struct ceduo_measure m, char room[CEDUO_WORDS_ROOM]);
#define NAMED(m, name)         ceduo_measure_name(m, name, (char[CEDUO_WORDS_ROOM]){0})
#define VALUE_OF(m)            ceduo_measure_value(m, (char[CEDUO_WORDS_ROOM]){0})
#define SPAN(m, lo, hi)        ceduo_measure_span(m, lo, hi, (char[CEDUO_WORDS_ROOM]){0})
#define INTERVAL(m)            ceduo_measure_interval(m, (char[CEDUO_WORDS_ROOM]){0})
#define WITH_ERROR(m, between) ceduo_measure_error(m, between, (char[CEDUO_WORDS_ROOM]){0})
#define MAY_BE(m)              ceduo_measure_may_be(m, (char[CEDUO_WORDS_ROOM]){0})

/* An option at a control, with what a report knows of it. */
struct ceduo_report;
struct ceduo_subject {
    const struct ceduo_report *report;
    size_t option, control;
    const struct ceduo_control *place;
    const struct ceduo_arrivals *bare, *wooded; /* wooded: NULL: not known */
    const struct ceduo_index *index;
    const struct ceduo_choice *choice; /* NULL: not known */
    struct ceduo_outcome outcome;
    struct ceduo_measure today,
        mean;    /* share by which the place is judged, and its mean over the years; with what may be true */
    bool apart;  /* the caller shows mean, worst year and today elsewhere */
    bool so_far; /* the uncertainty is still being computed */
};
struct ceduo_subject ceduo_subject_of(const struct ceduo_report *report, size_t option, size_t control);

#endif
