/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VOLUME_H
#define CEDUO_VOLUME_H

#include <math.h>

#include "ceduo/stand.h"

/* The volume of a stem by its diameter, made ready for many stems of one kind: as given, by the equation of the species
 * inside its rectangle of dbh and height, otherwise form factor × basal area × height. */
struct stem_volume {
    double given;      /* m3, of the mean stem; NaN: not given */
    double squares;    /* m2: the mean of dbh2 */
    double dbh;        /* m, of the mean stem */
    double height;     /* m */
    double b0, b1, b2; /* of the equation, which holds for d (cm) from d_lo to d_hi; none: from infinity on */
    double d_lo, d_hi;
};

static inline struct stem_volume stem_volume_of(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    struct stem_volume v = {.given = stems->volume,
                            .squares = stems->dbh * stems->dbh + stems->dbh_sd * stems->dbh_sd,
                            .dbh = stems->dbh,
                            .height = stems->height,
                            .d_lo = INFINITY};
    size_t count;
    const struct ceduo_species *s = stand->species >= 0 ? &ceduo_species_list(&count)[stand->species] : NULL;
    if (s && v.height >= s->h_lo && v.height <= s->h_hi) {
        v.b0 = s->b0;
        v.b1 = s->b1;
        v.b2 = s->b2;
        v.d_lo = s->d_lo;
        v.d_hi = s->d_hi;
    }
    return v;
}

/* m3 of a stem of diameter dbh whose volume is not given. `from` may be NULL. */
static inline double stem_volume_computed(const struct stem_volume *v, double dbh, enum ceduo_volume_from *from)
{
    double d = dbh * 100;
    double equation = d >= v->d_lo && d <= v->d_hi ? (v->b0 + v->b1 * d * d * v->height + v->b2 * d) / 1000 : 0;
    if (from)
        *from = equation > 0 ? CEDUO_VOLUME_EQUATION : CEDUO_VOLUME_FORM_FACTOR;
    return equation > 0 ? equation : CEDUO_FORM_FACTOR * M_PI / 4 * dbh * dbh * v->height;
}

/* m3 of the mean stem. `from` may be NULL. */
static inline double stem_volume_mean(const struct stem_volume *v, enum ceduo_volume_from *from)
{
    if (isnan(v->given))
        return stem_volume_computed(v, v->dbh, from);
    if (from)
        *from = CEDUO_VOLUME_GIVEN;
    return v->given;
}

/* m3 of one stem: a given volume is the mean of all stems, and goes with the square of the diameter. */
static inline double stem_volume_one(const struct stem_volume *v, double dbh)
{
    return isnan(v->given) ? stem_volume_computed(v, dbh, NULL) : v->given * (dbh * dbh / v->squares);
}

#endif
