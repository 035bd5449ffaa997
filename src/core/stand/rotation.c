/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A stand in the years to come, as rotation.h describes: before the first cut the inventory grows along its curves, after
 * it the stand follows from the years since the last cut alone. A grown stand owns one array, its shoots and then its
 * trees. */
#include "ceduo/rotation.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/elementary.h"

#define SHOOTS_FALL 5.0  /* years in which the surplus of shoots falls to 1/e; assumed */
#define GROWS_MAX   1e9  /* times as wide or as high: beyond that an age is as good as 0 */
#define AGE_GRAIN   1e-6 /* years: an age that comes from a curve is no better known */

/* ---- curves ---- */

static bool known(const struct ceduo_curve *c)
{
    return c->dbh_most > 0 && c->dbh_rate > 0 && c->height_most > 0 && c->height_rate > 0;
}

/* Share of its end that a curve has reached. */
static double reached(double rate, double age)
{
    return -ceduo_expm1(-rate * age);
}

double ceduo_curve_height(const struct ceduo_curve *curve, double dbh)
{
    double share = dbh / curve->dbh_most;
    bool reaches = known(curve) && share < 1;
    return reaches ? curve->height_most * reached(curve->height_rate, -ceduo_log1p(-share) / curve->dbh_rate) : NAN;
}

struct ceduo_beside_curve ceduo_stems_beside_curve(const struct ceduo_stand *stand, double first_cut, size_t i)
{
    bool shoots = i < stand->shoots_count;
    const struct ceduo_stems *stems = shoots ? &stand->shoots[i] : &stand->trees[i - stand->shoots_count];
    const struct ceduo_curve *curve = shoots ? &stand->growth.shoots : &stand->growth.trees;
    double since = first_cut < 0 ? fmod(-first_cut, stand->cutting.rotation) : 0; /* NaN without a rotation */
    double age = stems->age > 0 ? stems->age : shoots && stand->shoots_count == 1 ? since : 0;
    double dbh = curve->dbh_most * reached(curve->dbh_rate, age);
    return (struct ceduo_beside_curve){.age = age,
                                       .basal_area = stems->per_ha * (M_PI / 4) *
                                                     (stems->dbh * stems->dbh + stems->dbh_sd * stems->dbh_sd),
                                       .by_curve = age > 0 && known(curve) ? stems->per_ha * (M_PI / 4) * dbh * dbh : NAN};
}

/* Infinite where the stem grows no more; NaN where nothing tells it. */
static double age_of(const struct ceduo_stems *stems, const struct ceduo_curve *curve)
{
    if (stems->age > 0)
        return stems->age;
    if (!known(curve))
        return NAN;
    double share = stems->dbh / curve->dbh_most;
    return share < 1 ? -ceduo_log1p(-share) / curve->dbh_rate : INFINITY;
}

/* Where in the end there are none, next to none: some are left of which keep_shoots() can make one a stool. */
static double shoots_on_stool(const struct ceduo_growth *growth, double age)
{
    double surplus = fmax(0, growth->shoots_young - growth->shoots_old);
    return fmax(DBL_MIN, growth->shoots_old + surplus * ceduo_exp(-age / SHOOTS_FALL));
}

/* ---- density ---- */

double ceduo_stems_sdi(const struct ceduo_stems *stems, size_t n)
{
    double per_ha = 0, squares = 0;
    for (size_t i = 0; i < n; i++) {
        per_ha += stems[i].per_ha;
        squares += stems[i].per_ha * (stems[i].dbh * stems[i].dbh + stems[i].dbh_sd * stems[i].dbh_sd);
    }
    return per_ha > 0 ? per_ha * ceduo_pow(100 * sqrt(squares / per_ha) / 25.4, 1.605) : 0;
}

double ceduo_growing_space_used(const struct ceduo_growth *growth, const struct ceduo_stand *grown)
{
    if (!(growth->sdi_most > 0))
        return 0;
    double all = growth->trees_sdi_most > 0 ? growth->trees_sdi_most : growth->sdi_most * CEDUO_TREES_SPACE;
    return ceduo_stems_sdi(grown->trees, grown->trees_count) / all;
}

static void multiply_shoots(struct ceduo_stand *stand, double factor)
{
    for (size_t i = 0; i < stand->shoots_count; i++)
        stand->shoots[i].per_ha *= factor;
}

/* At least so many shoots in all; more than once only where rounding asks for it, or next to none are left. */
static void keep_shoots(struct ceduo_stand *stand, double min)
{
    for (double sum; (sum = ceduo_stand_shoots(stand)) > 0 && sum < min;)
        multiply_shoots(stand, fmin(min / sum * (1 + DBL_EPSILON), DBL_MAX));
}

/* The shoots are thinned to the growing space that the trees leave. Stools on which none is left die. */
static void share_space(struct ceduo_stand *stand, const struct ceduo_growth *growth)
{
    double max = growth->sdi_most * fmax(0, 1 - ceduo_growing_space_used(growth, stand));
    double sdi = ceduo_stems_sdi(stand->shoots, stand->shoots_count);
    if (growth->sdi_most > 0 && sdi > max) /* the index goes with their number */
        multiply_shoots(stand, max / sdi);
    double shoots = ceduo_stand_shoots(stand);
    stand->stools_per_ha = fmin(stand->stools_per_ha, shoots);
    if (!(shoots > 0))
        stand->shoots_count = 0;
}

/* ---- cuts ---- */

static unsigned cohorts(const struct ceduo_stand *stand)
{
    return stand->cutting.cohorts > 1 ? stand->cutting.cohorts : 1;
}

/* Rotations that the oldest trees that stay have seen; 0: none stay. */
static size_t oldest_to_stay(const struct ceduo_cutting *cutting)
{
    size_t n = cutting->stay_count;
    while (n > 0 && !(cutting->stay_per_ha[n - 1] > 0))
        n--;
    return n;
}

bool ceduo_stand_sprouts(const struct ceduo_stand *stand)
{
    return stand->stools_per_ha > 0 && stand->shoots_count + 1 == cohorts(stand) && known(&stand->growth.shoots) &&
           stand->growth.shoots_old > 0;
}

bool ceduo_stand_grows(const struct ceduo_stand *stand)
{
    return (stand->shoots_count > 0 && known(&stand->growth.shoots)) || ceduo_stand_sprouts(stand) ||
           (stand->trees_count > 0 && known(&stand->growth.trees));
}

/* NaN where no age is known. */
static double oldest(const struct ceduo_stems *stems, size_t n, const struct ceduo_curve *curve)
{
    double age = NAN;
    for (size_t i = 0; i < n; i++)
        age = fmax(age, age_of(&stems[i], curve));
    return age;
}

unsigned ceduo_first_cut(const struct ceduo_stand *stand, double first_cut)
{
    const struct ceduo_growth *g = &stand->growth;
    double rotation = stand->cutting.rotation;
    bool shoots_known = !(stand->stools_per_ha > 0) || (known(&g->shoots) && g->shoots_old > 0);
    bool trees_known = oldest_to_stay(&stand->cutting) == 0 || known(&g->trees);
    if (!(rotation > 0) || !shoots_known || !trees_known) /* what comes after a cut is not known */
        return CEDUO_NEVER;
    if (isnan(first_cut)) { /* at the end of the rotation, by the age of the oldest */
        bool sprouts = ceduo_stand_sprouts(stand), coppice = ceduo_stand_has_shoots(stand) || sprouts;
        double age = coppice ? oldest(stand->shoots, stand->shoots_count, &g->shoots)
                             : oldest(stand->trees, stand->trees_count, &g->trees);
        if (sprouts)
            age = fmax(age, (cohorts(stand) - 1) * rotation); /* it was cut when the oldest were as old as that */
        double rotations = coppice ? cohorts(stand) : 1 + (double)oldest_to_stay(&stand->cutting);
        first_cut = isnan(age) ? INFINITY : fmax(1, rotation * rotations - age - AGE_GRAIN);
    }
    double year = ceil(first_cut);
    if (year < 0) {
        double since = fmod(-year, rotation);
        year = since > 0 ? rotation - since : 0;
    }
    return year < CEDUO_NEVER ? (unsigned)year : CEDUO_NEVER;
}

bool ceduo_is_cut_year(const struct ceduo_stand *stand, double first_cut, unsigned year)
{
    unsigned first = ceduo_first_cut(stand, first_cut);
    return first != CEDUO_NEVER && year >= first && (year - first) % stand->cutting.rotation == 0;
}

/* ---- the stand of a year ---- */

static enum ceduo_status make(const struct ceduo_stand *stand, size_t shoots, size_t trees, struct ceduo_grown_stand *out)
{
    *out = (struct ceduo_grown_stand){.stems = NULL};
    if (shoots + trees > 0 && !(out->stems = calloc(shoots + trees, sizeof *out->stems)))
        return CEDUO_NO_MEMORY;
    out->stand = *stand;
    out->stand.growth = (struct ceduo_growth){.sdi_most = 0};
    out->stand.cutting = (struct ceduo_cutting){.rotation = 0};
    out->stand.shoots_count = shoots;
    out->stand.trees_count = trees;
    out->stand.shoots = shoots > 0 ? out->stems : NULL;
    out->stand.trees = trees > 0 ? out->stems + shoots : NULL;
    return CEDUO_OK;
}

void ceduo_grown_stand_release(struct ceduo_grown_stand *grown)
{
    free(grown->stems);
    *grown = (struct ceduo_grown_stand){.stems = NULL};
}

/* Stumps are those of the last cut, `years` ago. */
static void keep_stumps(const struct ceduo_stand *stand, double years, struct ceduo_stand *out)
{
    if (!(years < stand->growth.stump_years))
        out->stumps.per_ha = 0;
}

static struct ceduo_stems stems_of_age(const struct ceduo_curve *curve, double per_ha, double age)
{
    return (struct ceduo_stems){.per_ha = per_ha,
                                .dbh = curve->dbh_most * reached(curve->dbh_rate, age),
                                .height = curve->height_most * reached(curve->height_rate, age),
                                .volume = NAN,
                                .age = age};
}

static void grow_stems(struct ceduo_stems *stems, const struct ceduo_curve *curve, double age, double years)
{
    if (isinf(age))
        return;
    double wider = reached(curve->dbh_rate, age + years) / reached(curve->dbh_rate, age);
    double taller = reached(curve->height_rate, age + years) / reached(curve->height_rate, age);
    if (!(fmax(wider, taller) <= GROWS_MAX)) { /* so young that its sizes tell nothing: as a new one */
        *stems = stems_of_age(curve, stems->per_ha, age + years);
        return;
    }
    stems->dbh *= wider;
    stems->dbh_sd *= wider;
    stems->height *= taller;
    stems->volume *= wider * wider * taller;
    stems->age = age + years;
}

/* `young`: the first cohort came up after a cut just before year 0; otherwise 0. */
static void grow_shoots(struct ceduo_stand *stand, const struct ceduo_growth *growth, double years, size_t young)
{
    if (young > 0) /* as many cohorts as each stool has */
        stand->shoots[0] = stems_of_age(
            &growth->shoots, stand->stools_per_ha * shoots_on_stool(growth, years) / (double)stand->shoots_count, years);
    double min = fmin(stand->stools_per_ha, ceduo_stand_shoots(stand));
    for (size_t i = young; i < stand->shoots_count; i++) {
        struct ceduo_stems *s = &stand->shoots[i];
        double age = age_of(s, &growth->shoots);
        s->per_ha *= fmin(1, shoots_on_stool(growth, age + years) / shoots_on_stool(growth, age));
        grow_stems(s, &growth->shoots, age, years);
    }
    keep_shoots(stand, min);
    share_space(stand, growth);
}

static enum ceduo_status before_cut(const struct ceduo_stand *stand, unsigned year, struct ceduo_grown_stand *out)
{
    size_t young = year > 0 && ceduo_stand_sprouts(stand);
    enum ceduo_status status = make(stand, young + stand->shoots_count, stand->trees_count, out);
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < stand->shoots_count; i++)
        out->stand.shoots[young + i] = stand->shoots[i];
    for (size_t i = 0; i < stand->trees_count; i++)
        out->stand.trees[i] = stand->trees[i];
    if (year == 0)
        return CEDUO_OK;
    const struct ceduo_growth *g = &stand->growth;
    double since = NAN; /* years from the last cut to year 0: the age of the youngest shoots; 0 where it is not known */
    for (size_t i = 0; i < stand->shoots_count && !ceduo_stand_sprouts(stand); i++)
        since = fmin(since, age_of(&stand->shoots[i], &g->shoots));
    if (ceduo_stand_grows(stand))
        keep_stumps(stand, (isnan(since) ? 0 : since) + year, &out->stand);
    for (size_t i = 0; i < stand->trees_count && known(&g->trees); i++)
        grow_stems(&out->stand.trees[i], &g->trees, age_of(&stand->trees[i], &g->trees), year);
    if (known(&g->shoots)) /* after the trees: the shoots make room for them */
        grow_shoots(&out->stand, g, year, young);
    return CEDUO_OK;
}

/* `since` years after a cut. */
static enum ceduo_status after_cut(const struct ceduo_stand *stand, unsigned since, struct ceduo_grown_stand *out)
{
    const struct ceduo_growth *g = &stand->growth;
    const struct ceduo_cutting *cutting = &stand->cutting;
    double rotation = cutting->rotation, all = cohorts(stand);
    size_t youngest = since == 0, count = stand->stools_per_ha > 0 ? cohorts(stand) - youngest : 0, stay = 0;
    size_t grouped = 0; /* the first class of the inventory that stands in groups: those that stay do so, too */
    while (grouped < stand->trees_count && !(stand->trees[grouped].group > 1))
        grouped++;
    for (size_t j = 0; j < cutting->stay_count; j++)
        stay += cutting->stay_per_ha[j] > 0;
    enum ceduo_status status = make(stand, count, stay, out);
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < count; i++) {
        double age = (double)(youngest + i) * rotation + since;
        double per_ha = stand->stools_per_ha * shoots_on_stool(g, age) / all;
        out->stand.shoots[i] = stems_of_age(&g->shoots, per_ha, age);
    }
    for (size_t j = 0, i = 0; j < cutting->stay_count; j++)
        if (cutting->stay_per_ha[j] > 0) {
            struct ceduo_stems *trees = &out->stand.trees[i++];
            *trees = stems_of_age(&g->trees, cutting->stay_per_ha[j], (double)(j + 1) * rotation + since);
            trees->group = grouped < stand->trees_count ? stand->trees[grouped].group : 0;
            trees->group_radius = grouped < stand->trees_count ? stand->trees[grouped].group_radius : 0;
        }
    keep_stumps(stand, since, &out->stand);
    if (count == 0)
        out->stand.stools_per_ha = 0;
    keep_shoots(&out->stand, out->stand.stools_per_ha);
    share_space(&out->stand, g);
    return CEDUO_OK;
}

enum ceduo_status ceduo_stand_before_cut(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                         struct ceduo_grown_stand *out)
{
    if (year == ceduo_first_cut(stand, first_cut))
        return before_cut(stand, year, out);
    return after_cut(stand, stand->cutting.rotation, out);
}

enum ceduo_status ceduo_stand_at(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                 struct ceduo_grown_stand *out)
{
    unsigned first = ceduo_first_cut(stand, first_cut);
    if (first != CEDUO_NEVER && year >= first)
        return after_cut(stand, (year - first) % stand->cutting.rotation, out);
    return before_cut(stand, year, out);
}
