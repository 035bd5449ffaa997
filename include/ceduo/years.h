/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef CEDUO_YEARS_H
#define CEDUO_YEARS_H

#include "simulate.h"

/* ---- stands of future years ---- */

/* A stand in future years. Each year is computed on its own in closed form; nothing is accumulated.
 *
 * Year 0 is the inventory, the stand as filed. It grows until its first cut. The age of a cohort or class is its own if given
 * and above 0, otherwise the age at which its curve has its dbh. If its dbh reaches or exceeds the limit of the curve, it no
 * longer grows. After t years, from the age a:
 *     dbh and its deviation × d(a + t)/d(a), height × h(a + t)/h(a), a given volume with dbh2 × height,
 *     shoots × n(a + t)/n(a), all scaled up if less than one per stool would be left; trees keep their number.
 * From the first cut on the cuts set the ages. At t years after the last cut:
 *     trees of class j (1, 2 …): cutting.stay_per_ha[j - 1], j·rotation + t years old;
 *     shoots of K cohorts: t, rotation + t … (K - 1)·rotation + t years old, n(age)/K of each per stool.
 * In the year of a cut the youngest shoots do not exist yet: with one cohort there are no stools. The volume of a shoot follows
 * from species, dbh and height; all shoots of a cohort are equal. No other trees or shoots grow, so a stand without stools has
 * no stools after a cut.
 *     d(t) = D(1 - exp(-kt)), h(t) = H(1 - exp(-mt)), n(t) = n_old + (n_young - n_old)exp(-t/5)
 * are assumed, with all their constants.
 *
 * If an inventory has one cohort of shoots less than its stools have after a cut, it was cut just before year 0. From year 1 on
 * it has new shoots, n(t)/K per stool.
 *
 * Stumps persist for growth.stump_years after a cut (0: none); before the first cut, counted from the age of the youngest
 * shoots. Logs persist. Trees that a cut leaves are grouped like the first grouped class of the inventory.
 *
 * Trees and shoots share the growing space (assumed). In computed years, that is all but year 0 as filed, only the shoots are
 * thinned, by one factor to growth.sdi_max·(1 - share of the growing space that the trees take). If less than one per stool is
 * left, stools die, and each remaining stool has one shoot. As years are independent, a cut starts again from all stools of the
 * inventory. */

/* The stand of one year. It has no growth and cutting, so it cannot be grown again. */
struct ceduo_grown_stand {
    struct ceduo_stand stand;
    struct ceduo_stems *stems; /* owned; shoots, then trees; after a cut each from young to old */
};

/* Compute the stand of `year` in *out. A stratum without a growth curve is
 * copied unchanged. Without any curve, or in year 0 without a cut, so is the whole stand, bit for bit. In the year of a cut it
 * is the stand after the cut. Return CEDUO_NO_MEMORY or CEDUO_OK. The caller releases *out in any case.
 *
 * `first_cut` is a year of a cut; a fraction is rounded up. Cuts repeat by the rotation. A negative year only sets the rhythm:
 * -5 with a rotation of 25 years gives 20, and the inventory is what the cut in year -5 left. INFINITY: never. NaN: cut when
 * the oldest shoots reach the age of cutting, rotation × cohorts. Without shoots the oldest trees decide, at rotation ×
 * (rotations survived by the oldest retained trees + 1). If they are older, the cut is in year 1, so that year 0 is the stand
 * as filed. Unknown age: never. There is no cut without a rotation, or if the growth after a cut is unknown (of shoots if there
 * are stools, of trees if any are retained). */
enum ceduo_status ceduo_stand_at(const struct ceduo_stand *stand, double first_cut, unsigned year,
                                 struct ceduo_grown_stand *out);

/* Release a stand. A second call has no effect. */
void ceduo_grown_stand_release(struct ceduo_grown_stand *grown);

/* ---- yield ---- */

/* Yield of a forest, from the volumes, growth and cuts of its stems. All volumes are stem wood in m3 per hectare
 * of forest: the mean over the belts, weighted by length.
 *
 * The yield of a cut is the stand before it less the stand after it; retained trees were shoots before. Stems that die between
 * two cuts, by self-thinning of shoots or by density, are no yield; each counts with its volume of the year before. So over a
 * periodic rotation the felled volume equals growth less mortality. */
struct ceduo_felling {
    unsigned year;
    size_t belt;
    double stems_per_ha, volume; /* m3/ha of the belt; 0 if the inventory has less than its cuts leave */
};

struct ceduo_yield {
    double cut_per_year;  /* m3/ha and year, over a whole rotation of each belt; NaN if growth or cuts are unknown */
    double died_per_year; /* likewise */
    double standing;      /* m3/ha: mean over the years of the rotation */
    double volume_today;  /* m3/ha as filed; NaN without a forest */
    /* maximum share of the growing space that trees take before a cut; above 1 growth and yield are unknown */
    double space;
    size_t fellings_count;
    struct ceduo_felling *fellings; /* by year, then by belt */
};

/* Compute the yield of an option, with the fellings from year 0 to `last`, at most CEDUO_YEAR_MAX. Return CEDUO_OK, or
 * CEDUO_NO_MEMORY, CEDUO_BAD_STAND or CEDUO_BAD_ARGUMENT. The caller releases *yield in any case. */
enum ceduo_status ceduo_yield_compute(const struct ceduo_option *option, unsigned last, struct ceduo_yield *yield);

/* Release a yield. A second call has no effect. */
void ceduo_yield_release(struct ceduo_yield *yield);

/* ---- years of an option ---- */

/* An option year by year. Its stands grow and are cut as their files and belts define. All years have the same rocks. */

struct ceduo_year {
    unsigned year;                     /* 0: the stands as filed */
    bool cut;                          /* some belt is cut in this year */
    struct ceduo_option option;        /* the forest of this year; empty belts are bare */
    struct ceduo_grown_stand *grown;   /* owned; stands of the belts */
    struct ceduo_stand_result *stands; /* one per belt */
    struct ceduo_index *controls;      /* one per control */
    struct ceduo_simulated wooded;     /* rocks == 0: not simulated; always with the contact model index */
};

/* Return one whole rotation of an option. After its first cut a forest is periodic, so that a rotation has each state once.
 * With several rotations the window is their common period. Without a cut it is the next CEDUO_YEARS_AHEAD_MIN years
 * (CEDUO_WINDOW_AHEAD), or CEDUO_WINDOW_CONSTANT. */
struct ceduo_window ceduo_window_compute(const struct ceduo_option *option);

/* Return the years by which all options of a scene are judged and compared. They reach from year 1 to the longest rotation of
 * any belt, at least CEDUO_YEARS_AHEAD_MIN and at most CEDUO_AHEAD_MAX years. If the scene gives the first or last year:
 * CEDUO_WINDOW_GIVEN, at most CEDUO_YEARS_MAX years. CEDUO_WINDOW_CONSTANT if no option has a stand that grows or is cut. */
struct ceduo_window ceduo_scene_window(const struct ceduo_scene *scene);

struct ceduo_years {
    struct ceduo_scene scene; /* everything that it points to must outlive the years */
    struct ceduo_window window;
    uint64_t key; /* for the caller, to identify the input; 0 at first */
    size_t count;
    struct ceduo_year *years; /* sorted by year */
    size_t last_control;      /* the one farthest along x */
    uint64_t rocks;           /* simulated in every year; 0: not all years are simulated yet */
    /* per rock: number of years in which it exceeds the accepted energy at the last control, or reaches it if none is given */
    uint16_t *marks;
    double *weights; /* per rock, if the scene has blocks; otherwise NULL */
};

/* Summary of the years at one control. Every figure is the mean over the computed years. If all years simulate the same rocks,
 * their errors are correlated. The standard error is then given by its upper bound, the mean of the standard errors. For the
 * marked share it is exact, from the mean of each rock over the years. NaN if a figure does not exist. */
struct ceduo_years_summary {
    size_t years, simulated;
    bool nothing; /* the forest cannot be judged: all lights are unknown */
    size_t unprotected_contact, unprotected_free_run, unprotected_energy; /* years in which this light fails */
    size_t thick_contact, thick_free_run;                                 /* likewise, counting stems from CEDUO_THICK_DBH on */
    size_t failing_lo, failing_hi;       /* years whose lower, or upper, 95 % limit of `exceed` is above the control's limit */
    struct ceduo_estimate rate;          /* with blocks: harmful rocks per year; the interval is an upper bound */
    struct ceduo_estimate reach, exceed; /* of the released */
    struct ceduo_estimate energy_per_released; /* J */
    /* year of the largest exceeding share, or arriving share without an accepted energy; with the index, of the largest ADC */
    unsigned worst_year;
    double worst;                             /* this share, or this ADC in m */
    double passes_per_year, exceeds_per_year; /* expected, if the scene gives rocks_per_year */
};

/* Return the summary at a control; `nothing` is true for a control that does not exist. */
struct ceduo_years_summary ceduo_years_summarize(const struct ceduo_years *years, size_t control);

/* Return the difference of the mean marked shares of two options, over the rocks that both have. NaN if unknown. */
struct ceduo_estimate ceduo_years_difference(const struct ceduo_years *years, const struct ceduo_years *less);

#endif
