/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "energy.h"
#include "ceduo/simulate.h"
#include "scene/volume.h"

#include <math.h>

#include "base/elementary.h"
#include "base/hash.h"

#define X(NAME, name) extern const struct energy_law ceduo_energy_##name;
CEDUO_ENERGY_MODELS(X)
#undef X

static const struct energy_law *const laws[] = {
#define X(NAME, name) &ceduo_energy_##name,
    CEDUO_ENERGY_MODELS(X)
#undef X
};

/* ---- laws ---- */

struct stem_energy ceduo_stem_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    struct stem_energy e = {.model = stand->energy};
    laws[e.model]->prepare(&e, stand, stems);
    return e;
}

static void hash_volume(uint64_t *hash, const struct stem_volume *v)
{
    size_t count;
    hash_each(hash, v->given, v->squares, v->dbh, v->height);
    _Static_assert(offsetof(struct stem_volume, species) == 4 * sizeof(double), "all numbers are hashed");
    hash_count(hash, v->species ? (uint64_t)(v->species - ceduo_species_list(&count)) + 1 : 0);
}

void ceduo_stem_energy_hash(uint64_t *hash, const struct stem_energy *e)
{
    hash_count(hash, (uint64_t)e->model);
    hash_volume(hash, &e->volume);
    hash_array(hash, e->values);
}

double ceduo_stem_energy_mean(const struct stem_energy *e)
{
    return laws[e->model]->mean(e);
}

double ceduo_stem_energy_hit(const struct stem_energy *e, double dbh, double share)
{
    return laws[e->model]->hit(e, dbh, share);
}

bool ceduo_stem_energy_by_eccentricity(const struct stem_energy *e)
{
    return laws[e->model]->by_eccentricity(e);
}

unsigned ceduo_stem_energy_warnings(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    return laws[stand->energy]->warnings(stand, stems);
}

double ceduo_contact_energy(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    const struct stem_energy energy = ceduo_stem_energy(stand, stems);
    return ceduo_stem_energy_mean(&energy);
}

/* ---- common to laws ---- */

double ceduo_dorren_energy(double dbh, double fracture_ratio)
{
    return fracture_ratio * 38.7 * ceduo_pow(dbh * 100, 2.31);
}

double ceduo_dorren_share(double u)
{
    double share = DORREN_SHARE_OF(ceduo_exp(DORREN_EXPONENT(u)));
    return 0.5 * (share + fabs(share)); /* max(0, share) without a branch: a quarter of all hits, unpredictable */
}

/* Return the integral of the clamped share over 0…1. With y = 10^(8.007(u - 0.58)) the share is -0.046 + 1.026/(1 + y), whose
 * antiderivative is elementary; it is 0 from u0 on, where y = 1.026/0.046 - 1. */
double ceduo_dorren_mean_share(void)
{
    const double rate = DORREN_STEEPNESS * LN10, centre = DORREN_CENTRE;
    double u0 = centre + ceduo_log(DORREN_SPAN / -DORREN_LOW - 1) / rate;
    double end = fmin(1, u0);
    double inner = (ceduo_log1p(ceduo_exp(-rate * (0 - centre))) - ceduo_log1p(ceduo_exp(-rate * (end - centre)))) / rate;
    return DORREN_LOW * end + DORREN_SPAN * inner;
}

unsigned ceduo_volume_warning(const struct ceduo_stand *stand, const struct ceduo_stems *stems)
{
    enum ceduo_volume_from from;
    ceduo_stem_volume(stand, stems, &from);
    return from == CEDUO_VOLUME_FORM_FACTOR ? CEDUO_WARNING_FORM_FACTOR : 0u;
}
