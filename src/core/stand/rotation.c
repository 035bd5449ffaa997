/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stands of future years, see rotation.h. Before the first cut the inventory grows along its curves. After it the stand depends
 * only on the years since the last cut. A grown stand owns one array, shoots first, then trees. */

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/elementary.h"
#include "rotation.h"
#include "scene/stand.h"

#define SHOOTS_FALL 5.0  /* years in which the surplus of shoots decays to 1/e; assumed */
#define GROWTH_MAX  1e9  /* growth factor above which the age counts as 0 */
#define AGE_GRAIN   1e-6 /* years: precision of an age from a curve */

/* ---- curves ---- */

static bool is_known(const struct ceduo_curve *c)
{
    return c->dbh_max > 0 && c->dbh_rate > 0 && c->height_max > 0 && c->height_rate > 0;
}

/* Return the share of its limit that a curve has at an age. */
static double curve_share(double rate, double age)
{
    return -ceduo_expm1(-rate * age);
}

double ceduo_curve_height(const struct ceduo_curve *curve, double dbh)
{
    double share = dbh / curve->dbh_max;
    bool reaches = is_known(curve) && share < 1;
    return reaches ? curve->height_max * curve_share(curve->height_rate, -ceduo_log1p(-share) / curve->dbh_rate) : NAN;
}

struct ceduo_curve_comparison ceduo_stems_compare_to_curve(const struct ceduo_stand *stand, double first_cut, size_t i)
{
    bool shoots = i < stand->shoots_count;
    const struct ceduo_stems *stems = shoots ? &stand->shoots[i] : &stand->trees[i - stand->shoots_count];
    const struct ceduo_curve *curve = shoots ? &stand->growth.shoots : &stand->growth.trees;
    double since = first_cut < 0 ? fmod(-first_cut, stand->cutting.rotation) : 0; /* NaN without a rotation */
    double age = stems->age > 0 ? stems->age : shoots && stand->shoots_count == 1 ? since : 0;
    double dbh = curve->dbh_max * curve_share(curve->dbh_rate, age);
    return (struct ceduo_curve_comparison){
        .age = age,
        .basal_area = stems->per_ha * (M_PI / 4) * (stems->dbh * stems->dbh + stems->dbh_sd * stems->dbh_sd),
        .by_curve = age > 0 && is_known(curve) ? stems->per_ha * (M_PI / 4) * dbh * dbh : NAN};
}

/* Return the age of a stem, years; infinite if it no longer grows, NaN if unknown. */
static double find_age(const struct ceduo_stems *stems, const struct ceduo_curve *curve)
{
    if (stems->age > 0)
        return stems->age;
    if (!is_known(curve))
        return NAN;
    double share = stems->dbh / curve->dbh_max;
    return share < 1 ? -ceduo_log1p(-share) / curve->dbh_rate : INFINITY;
}

/* Never exactly 0, so that raise_shoots() can scale up to one shoot per stool. */
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
    if (!(growth->sdi_max > 0))
        return 0;
    double full_sdi = growth->trees_sdi_max > 0 ? growth->trees_sdi_max : growth->sdi_max * CEDUO_TREES_SPACE;
    return ceduo_stems_sdi(grown->trees, grown->trees_count) / full_sdi;
}

static void multiply_shoots(struct ceduo_stand *stand, double factor)
{
    for (size_t i = 0; i < stand->shoots_count; i++)
        stand->shoots[i].per_ha *= factor;
}

/* Scale the shoots up to at least `min` in total. Repeats only because of rounding or tiny sums. */
static void raise_shoots(struct ceduo_stand *stand, double min)
{
    for (double sum; (sum = ceduo_stand_shoots(stand)) > 0 && sum < min;)
        multiply_shoots(stand, fmin(min / sum * (1 + DBL_EPSILON), DBL_MAX));
}

/* Thin the shoots to the growing space that the trees leave. Stools without shoots die. */
static void share_space(struct ceduo_stand *stand, const struct ceduo_growth *growth)
{
    double max = growth->sdi_max * fmax(0, 1 - ceduo_growing_space_used(growth, stand));
    double sdi = ceduo_stems_sdi(stand->shoots, stand->shoots_count);
    if (growth->sdi_max > 0 && sdi > max) /* the index is proportional to their number */
        multiply_shoots(stand, max / sdi);
    double shoots = ceduo_stand_shoots(stand);
    stand->stools_per_ha = fmin(stand->stools_per_ha, shoots);
    if (!(shoots > 0))
        stand->shoots_count = 0;
}

/* ---- cuts ---- */

static unsigned cohort_count(const struct ceduo_stand *stand)
{
    return stand->cutting.cohorts > 1 ? stand->cutting.cohorts : 1;
}

/* Return the age of the oldest retained trees, in rotations; 0 if none are retained. */
static size_t oldest_retained(const struct ceduo_cutting *cutting)
{
    size_t n = cutting->retained_count;
    while (n > 0 && !(cutting->stay_per_ha[n - 1] > 0))
        n--;
    return n;
}

bool ceduo_stand_sprouts(const struct ceduo_stand *stand)
{
    return stand->stools_per_ha > 0 && stand->shoots_count + 1 == cohort_count(stand) && is_known(&stand->growth.shoots) &&
           stand->growth.shoots_old > 0;
}

bool ceduo_stand_grows(const struct ceduo_stand *stand)
{
    return (stand->shoots_count > 0 && is_known(&stand->growth.shoots)) || ceduo_stand_sprouts(stand) ||
           (stand->trees_count > 0 && is_known(&stand->growth.trees));
}

/* Return the maximum age; NaN if no age is known. */
static double oldest_age(const struct ceduo_stems *stems, size_t n, const struct ceduo_curve *curve)
{
    double age = NAN;
    for (size_t i = 0; i < n; i++)
        age = fmax(age, find_age(&stems[i], curve));
    return age;
}

enum cut_lack ceduo_cut_lack(const struct ceduo_stand *stand, double first_cut)
{
    const struct ceduo_growth *g = &stand->growth;
    bool stools = stand->stools_per_ha > 0;
    if (!(stand->cutting.rotation > 0))
        return CUT_LACKS_CUTTING;
    if (stools && !(is_known(&g->shoots) && g->shoots_old > 0)) /* the growth after a cut is unknown */
        return CUT_LACKS_SHOOTS;
    if (oldest_retained(&stand->cutting) > 0 && !is_known(&g->trees))
        return CUT_LACKS_TREES;
    if (isnan(first_cut) && !stools && stand->trees_count > 0 && isnan(oldest_age(stand->trees, stand->trees_count, &g->trees)))
        return CUT_LACKS_AGE;
    return CUT_LACKS_NOTHING;
}

unsigned ceduo_first_cut(const struct ceduo_stand *stand, double first_cut)
{
    const struct ceduo_growth *g = &stand->growth;
    double rotation = stand->cutting.rotation;
    if (ceduo_cut_lack(stand, first_cut) != CUT_LACKS_NOTHING)
        return CEDUO_NEVER;
    if (isnan(first_cut)) { /* at the end of the rotation, by the maximum age */
        bool sprouts = ceduo_stand_sprouts(stand), coppice = ceduo_stand_has_shoots(stand) || sprouts;
        double age = coppice ? oldest_age(stand->shoots, stand->shoots_count, &g->shoots)
                             : oldest_age(stand->trees, stand->trees_count, &g->trees);
        if (sprouts)
            age = fmax(age, (cohort_count(stand) - 1) * rotation); /* at the last cut the oldest had this age */
        double rotations = coppice ? cohort_count(stand) : 1 + (double)oldest_retained(&stand->cutting);
        first_cut = isnan(age) ? INFINITY : fmax(1, rotation * rotations - age - AGE_GRAIN);
    }
    double year = ceil(first_cut);
    if (year < 0) {
        double since = fmod(-year, rotation);
        year = since > 0 ? rotation - since : 0;
    }
    return year < CEDUO_NEVER ? (unsigned)year : CEDUO_NEVER;
}

bool ceduo_stand_is_cut_year(const struct ceduo_stand *stand, double first_cut, unsigned year)
{
    unsigned first = ceduo_first_cut(stand, first_cut);
    return first != CEDUO_NEVER && year >= first && (year - first) % stand->cutting.rotation == 0;
}

/* ---- the stand of a year ---- */

static enum ceduo_status make_grown_stand(const struct ceduo_stand *stand, size_t shoots, size_t trees,
                                          struct ceduo_grown_stand *out)
{
    *out = (struct ceduo_grown_stand){.stems = NULL};
    if (shoots + trees > 0 && !(out->stems = calloc(shoots + trees, sizeof *out->stems)))
        return CEDUO_NO_MEMORY;
    out->stand = *stand;
    out->stand.growth = (struct ceduo_growth){.sdi_max = 0};
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

/* Remove stumps if the last cut, `years` ago, is too old. */
static void remove_old_stumps(const struct ceduo_stand *stand, double years, struct ceduo_stand *out)
{
    if (!(years < stand->growth.stump_years))
        out->stumps.per_ha = 0;
}

static struct ceduo_stems stems_of_age(const struct ceduo_curve *curve, double per_ha, double age)
{
    return (struct ceduo_stems){.per_ha = per_ha,
                                .dbh = curve->dbh_max * curve_share(curve->dbh_rate, age),
                                .height = curve->height_max * curve_share(curve->height_rate, age),
                                .volume = NAN,
                                .age = age};
}

static void grow_stems(struct ceduo_stems *stems, const struct ceduo_curve *curve, double age, double years)
{
    if (isinf(age))
        return;
    double wider = curve_share(curve->dbh_rate, age + years) / curve_share(curve->dbh_rate, age);
    double taller = curve_share(curve->height_rate, age + years) / curve_share(curve->height_rate, age);
    if (!(fmax(wider, taller) <= GROWTH_MAX)) { /* too young for its sizes to be used: replace it by a new stem */
        *stems = stems_of_age(curve, stems->per_ha, age + years);
        return;
    }
    stems->dbh *= wider;
    stems->dbh_sd *= wider;
    stems->height *= taller;
    stems->volume *= wider * wider * taller;
    stems->age = age + years;
}

/* `young` is 1 if the first cohort grew after a cut just before year 0, otherwise 0. */
static void grow_shoots(struct ceduo_stand *stand, const struct ceduo_growth *growth, double years, size_t young)
{
    if (young > 0) /* shoots_count is the number of cohorts per stool */
        stand->shoots[0] = stems_of_age(
            &growth->shoots, stand->stools_per_ha * shoots_on_stool(growth, years) / (double)stand->shoots_count, years);
    double min = fmin(stand->stools_per_ha, ceduo_stand_shoots(stand));
    for (size_t i = young; i < stand->shoots_count; i++) {
        struct ceduo_stems *s = &stand->shoots[i];
        double age = find_age(s, &growth->shoots);
        s->per_ha *= fmin(1, shoots_on_stool(growth, age + years) / shoots_on_stool(growth, age));
        grow_stems(s, &growth->shoots, age, years);
    }
    raise_shoots(stand, min);
    share_space(stand, growth);
}

static enum ceduo_status grow_inventory(const struct ceduo_stand *stand, unsigned year, struct ceduo_grown_stand *out)
{
    size_t young = year > 0 && ceduo_stand_sprouts(stand);
    enum ceduo_status status = make_grown_stand(stand, young + stand->shoots_count, stand->trees_count, out);
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < stand->shoots_count; i++)
        out->stand.shoots[young + i] = stand->shoots[i];
    for (size_t i = 0; i < stand->trees_count; i++)
        out->stand.trees[i] = stand->trees[i];
    if (year == 0)
        return CEDUO_OK;
    const struct ceduo_growth *g = &stand->growth;
    double since = NAN; /* years from the last cut to year 0: age of the youngest shoots; 0 if unknown */
    for (size_t i = 0; i < stand->shoots_count && !ceduo_stand_sprouts(stand); i++)
        since = fmin(since, find_age(&stand->shoots[i], &g->shoots));
    if (ceduo_stand_grows(stand))
        remove_old_stumps(stand, (isnan(since) ? 0 : since) + year, &out->stand);
    for (size_t i = 0; i < stand->trees_count && is_known(&g->trees); i++)
        grow_stems(&out->stand.trees[i], &g->trees, find_age(&stand->trees[i], &g->trees), year);
    if (is_known(&g->shoots)) /* after the trees, which take growing space from the shoots */
        grow_shoots(&out->stand, g, year, young);
    return CEDUO_OK;
}

/* Build the stand `since` years after a cut. */
static enum ceduo_status regrow(const struct ceduo_stand *stand, unsigned since, struct ceduo_grown_stand *out)
{
    const struct ceduo_growth *g = &stand->growth;
    const struct ceduo_cutting *cutting = &stand->cutting;
    double rotation = cutting->rotation, cohorts_total = cohort_count(stand);
    size_t youngest = since == 0, count = stand->stools_per_ha > 0 ? cohort_count(stand) - youngest : 0, retained = 0;
    size_t grouped = 0; /* first grouped class of the inventory: retained trees are grouped like it */
    while (grouped < stand->trees_count && !(stand->trees[grouped].group > 1))
        grouped++;
    for (size_t j = 0; j < cutting->retained_count; j++)
        retained += cutting->stay_per_ha[j] > 0;
    enum ceduo_status status = make_grown_stand(stand, count, retained, out);
    if (status != CEDUO_OK)
        return status;
    for (size_t i = 0; i < count; i++) {
        double age = (double)(youngest + i) * rotation + since;
        double per_ha = stand->stools_per_ha * shoots_on_stool(g, age) / cohorts_total;
        out->stand.shoots[i] = stems_of_age(&g->shoots, per_ha, age);
    }
    for (size_t j = 0, i = 0; j < cutting->retained_count; j++)
        if (cutting->stay_per_ha[j] > 0) {
            struct ceduo_stems *trees = &out->stand.trees[i++];
            *trees = stems_of_age(&g->trees, cutting->stay_per_ha[j], (double)(j + 1) * rotation + since);
            trees->group = grouped < stand->trees_count ? stand->trees[grouped].group : 0;
            trees->group_radius = grouped < stand->trees_count ? stand->trees[grouped].group_radius : 0;
        }
    remove_old_stumps(stand, since, &out->stand);
    if (count == 0)
        out->stand.stools_per_ha = 0;
    raise_shoots(&out->stand, out->stand.stools_per_ha);
    share_space(&out->stand, g);
    return CEDUO_OK;
}

enum ceduo_status ceduo_stand_before_cut(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                         struct ceduo_grown_stand *out)
{
    if (year == ceduo_first_cut(stand, first_cut))
        return grow_inventory(stand, year, out);
    return regrow(stand, stand->cutting.rotation, out);
}

enum ceduo_status ceduo_stand_at(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                 struct ceduo_grown_stand *out)
{
    unsigned first = ceduo_first_cut(stand, first_cut);
    if (first != CEDUO_NEVER && year >= first)
        return regrow(stand, (year - first) % stand->cutting.rotation, out);
    return grow_inventory(stand, year, out);
}
