/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_VOLUME_H
#define CEDUO_VOLUME_H

#include <math.h>

#include "ceduo/scene.h"

#define CEDUO_FORM_FACTOR 0.5

enum ceduo_volume_from { CEDUO_VOLUME_GIVEN, CEDUO_VOLUME_EQUATION, CEDUO_VOLUME_FORM_FACTOR };

/* Volume of a stem by its diameter, prepared for many stems of one kind. It is the given volume, or follows from the equation
 * of the species inside its rectangle of dbh and height. Outside, the form factor at the nearest point applies, so that the
 * volume is continuous (assumed). Without a species: form factor × basal area × height. */
struct stem_volume {
    double given;                        /* m3 of the mean stem; NaN: not given */
    double squares;                      /* m2: mean of dbh2 */
    double dbh;                          /* m, of the mean stem */
    double height;                       /* m */
    const struct ceduo_species *species; /* NULL: not given */
};

static inline struct stem_volume make_stem_volume(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    struct stem_volume v = {.given = stems->volume,
                            .squares = stems->dbh * stems->dbh + stems->dbh_sd * stems->dbh_sd,
                            .dbh = stems->dbh,
                            .height = stems->height};
    size_t count;
    if (stand->species >= 0)
        v.species = &ceduo_species_list(&count)[stand->species];
    return v;
}

/* Return the computed volume (m3) of a stem of diameter dbh. `from` may be NULL. */
static inline double stem_volume_computed(const struct stem_volume *v, double dbh, enum ceduo_volume_from *from)
{
    const struct ceduo_species *s = v->species;
    if (from)
        *from = CEDUO_VOLUME_FORM_FACTOR;
    if (!s)
        return CEDUO_FORM_FACTOR * M_PI / 4 * dbh * dbh * v->height;
    double cm = dbh * 100, d = fmin(fmax(cm, s->d_lo), s->d_hi), h = fmin(fmax(v->height, s->h_lo), s->h_hi);
    double equation = (s->b0 + s->b1 * d * d * h + s->b2 * d) / 1000;
    if (d == cm && h == v->height) {
        if (from)
            *from = CEDUO_VOLUME_EQUATION;
        return equation;
    }
    return equation * (cm * cm * v->height / (d * d * h));
}

/* Return the volume (m3) of the mean stem. `from` may be NULL. */
static inline double stem_volume_mean(const struct stem_volume *v, enum ceduo_volume_from *from)
{
    if (isnan(v->given))
        return stem_volume_computed(v, v->dbh, from);
    if (from)
        *from = CEDUO_VOLUME_GIVEN;
    return v->given;
}

/* Return the volume (m3) of one stem. A given volume is the mean of all stems, and scales with the squared diameter. */
static inline double stem_volume_one(const struct stem_volume *v, double dbh)
{
    return isnan(v->given) ? stem_volume_computed(v, dbh, NULL) : v->given * (dbh * dbh / v->squares);
}

/* Return the volume (m3) of one of `stems`, and set its source. A given volume comes first, then the equation of the species
 * inside its rectangle of dbh and height. Outside, the form factor at the nearest point of the rectangle applies (assumed).
 * Without a species the volume is form factor 0.5 × basal area × height. */
double ceduo_stem_volume(const struct ceduo_stand *stand, const struct ceduo_stems *stems, enum ceduo_volume_from *from);

#endif
