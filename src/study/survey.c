/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes a stand from sample plots. Counts become densities per plot; their mean has a standard error over the plots. */

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/gsl_errors.h"
#include "check_study.h"
#include "naslund.h"
#include "plots.h"
#include "scene/stand.h"
#include "scene/volume.h"

#define HECTARE     10000
#define CLASSES_MAX 1000 /* classes of dbh; thicker stems share the last */

struct surveyor {
    const struct ceduo_survey *survey;
    struct ceduo_survey_result *answer;
    struct arena memory;
    double *counts;     /* for each plot */
    double *heights;    /* m, for each stem: measured or estimated */
    double *pairs;      /* buffer for dbh and height of the measured stems */
    double measured;    /* m, largest dbh with a height */
    bool shoots_fitted; /* the shoots have a fitted curve */
};

double ceduo_survey_horizontal(double area, double slope_rad)
{
    return area * cos(slope_rad);
}

/* Return mean, standard error and 95 % interval of n >= 1 values. */
static struct ceduo_estimate estimate_mean(const double *values, size_t n)
{
    double mean = gsl_stats_mean(values, 1, n), se = n > 1 ? gsl_stats_sd_m(values, 1, n, mean) / sqrt((double)n) : NAN;
    double half = n > 1 ? gsl_cdf_tdist_Pinv(0.975, (double)n - 1) * se : NAN;
    return (struct ceduo_estimate){mean, se, mean - half, mean + half};
}

/* ---- densities ---- */

/* Return the density per hectare from the counts of the plots, and reset the counts. */
static struct ceduo_estimate read_density(struct surveyor *s)
{
    for (size_t i = 0; i < s->survey->plots_count; i++)
        s->counts[i] *= HECTARE / s->survey->areas[i];
    const struct ceduo_estimate density = estimate_mean(s->counts, s->survey->plots_count);
    memset(s->counts, 0, s->survey->plots_count * sizeof *s->counts);
    return density;
}

/* Count the stools, and set the mean spacing over the measured ones. Return false on failure of memory. */
static bool count_stools(struct surveyor *s)
{
    const struct ceduo_survey *survey = s->survey;
    struct {
        double spacing;
        size_t measured;
        bool counted;
    } *stools = ceduo_arena_alloc(&s->memory, (survey->stools_count + 1) * sizeof *stools);
    double *spacings = ceduo_arena_alloc(&s->memory, (survey->stools_count + 1) * sizeof *spacings);
    size_t n = 0;
    if (!stools || !spacings)
        return false;
    for (size_t i = 0; i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        if (stem->kind != CEDUO_SURVEY_SHOOT)
            continue;
        s->counts[stem->plot] += stools[stem->stool].counted ? 0 : 1;
        stools[stem->stool].counted = true;
        stools[stem->stool].measured += isnan(stem->spacing) ? 0 : 1;
        stools[stem->stool].spacing += isnan(stem->spacing) ? 0 : stem->spacing;
    }
    for (size_t i = 0; i < survey->stools_count; i++)
        if (stools[i].measured > 0)
            spacings[n++] = stools[i].spacing / (double)stools[i].measured;
    s->answer->stools = read_density(s);
    s->answer->stools_measured = n;
    s->answer->spacing = n > 0 ? estimate_mean(spacings, n) : (struct ceduo_estimate){NAN, NAN, NAN, NAN};
    return true;
}

/* ---- species ---- */

double ceduo_survey_basal_area(const struct ceduo_survey *survey, int species)
{
    double sum = 0;
    for (size_t i = 0; i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        if ((stem->species == species || species == CEDUO_SURVEY_ALL) && stem->kind != CEDUO_SURVEY_STUMP)
            sum += stem->dbh * stem->dbh / survey->areas[stem->plot];
    }
    return sum;
}

static int find_main_species(const struct ceduo_survey *survey)
{
    size_t count;
    ceduo_species_list(&count);
    int best = -1;
    double area_max = 0;
    for (int k = 0; k < (int)count; k++) {
        double area = ceduo_survey_basal_area(survey, k);
        best = area > area_max ? k : best;
        area_max = fmax(area, area_max);
    }
    return best;
}

/* ---- heights ---- */

static bool is_of_group(const struct ceduo_survey_stem *stem, bool shoots)
{
    return stem->kind != CEDUO_SURVEY_STUMP && (stem->kind == CEDUO_SURVEY_SHOOT) == shoots;
}

/* Default height curves (assumed), fitted to the stands that come with the program. */
static const struct ceduo_naslund default_trees = {.a = 2.4, .b = 0.186}, default_shoots = {.a = 1.2, .b = 0.22};

static bool complete_heights(struct surveyor *s, bool shoots, struct ceduo_survey_heights *h)
{
    const struct ceduo_survey *survey = s->survey;
    double *dbh = s->pairs, *height = s->pairs + survey->stems_count, sum = 0, measured = 0;
    *h = (struct ceduo_survey_heights){0};
    for (size_t i = 0; i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        if (!is_of_group(stem, shoots))
            continue;
        if (isnan(stem->height)) {
            h->missing++;
            continue;
        }
        measured = fmax(measured, stem->dbh);
        dbh[h->given] = stem->dbh;
        height[h->given++] = stem->height;
        sum += stem->height;
    }
    h->mean = h->given > 0 ? sum / (double)h->given : NAN;
    s->measured = h->given > 0 ? measured : s->measured;
    enum ceduo_status fitted = ceduo_naslund_fit(h->given, dbh, height, &h->curve);
    if (shoots)
        s->shoots_fitted = fitted == CEDUO_OK;
    if (h->missing == 0)
        h->from = CEDUO_SURVEY_HEIGHTS_MEASURED;
    else if (h->given > 0)
        h->from = fitted == CEDUO_OK ? CEDUO_SURVEY_HEIGHTS_CURVE : CEDUO_SURVEY_HEIGHTS_MEAN;
    else
        h->from = !shoots && s->shoots_fitted ? CEDUO_SURVEY_HEIGHTS_SHOOTS : CEDUO_SURVEY_HEIGHTS_USUAL;
    if (h->from == CEDUO_SURVEY_HEIGHTS_SHOOTS)
        h->curve = s->answer->shoots.curve;
    else if (h->from == CEDUO_SURVEY_HEIGHTS_USUAL)
        h->curve = shoots ? default_shoots : default_trees;
    for (size_t i = 0; i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        if (!is_of_group(stem, shoots))
            continue;
        if (!isnan(stem->height) || h->from == CEDUO_SURVEY_HEIGHTS_MEAN) {
            s->heights[i] = isnan(stem->height) ? h->mean : stem->height;
            continue;
        }
        s->heights[i] = ceduo_naslund_height(&h->curve, stem->dbh);
        h->beyond += h->from != CEDUO_SURVEY_HEIGHTS_USUAL && stem->dbh > s->measured;
        h->thickest = fmax(h->thickest, stem->dbh);
    }
    return fitted != CEDUO_NO_MEMORY;
}

/* Return the mean of a member over the stumps that have it; NaN: none has. */
static double stump_mean(const struct ceduo_survey *survey, size_t offset)
{
    double sum = 0, n = 0;
    for (size_t i = 0; i < survey->stems_count; i++) {
        double value;
        memcpy(&value, (const char *)&survey->stems[i] + offset, sizeof value);
        if (survey->stems[i].kind == CEDUO_SURVEY_STUMP && !isnan(value)) {
            sum += value;
            n++;
        }
    }
    return n > 0 ? sum / n : NAN;
}

/* ---- classes ---- */

static size_t find_class(const struct ceduo_survey_stem *stem)
{
    double k = floor(stem->dbh / CEDUO_SURVEY_CLASS + 1e-9); /* a dbh of 0.15 m belongs to the class from 0.15 m */
    return k < CLASSES_MAX ? (size_t)k : CLASSES_MAX - 1;
}

static void add_volume(struct ceduo_survey_class *c, const struct ceduo_survey_stem *stem, double height, int main_species)
{
    enum ceduo_volume_from from;
    const struct ceduo_stand stand = {.species = stem->species};
    const struct ceduo_stems one = {.dbh = stem->dbh, .height = height, .volume = NAN};
    c->volume += ceduo_stem_volume(&stand, &one, &from);
    c->form_factor += from == CEDUO_VOLUME_FORM_FACTOR;
    c->form_factor_main += from == CEDUO_VOLUME_FORM_FACTOR && stem->species == main_species && main_species >= 0;
}

/* Fill a class that has at least one stem. */
static void fill_class(struct surveyor *s, struct ceduo_survey_class *c, enum ceduo_survey_kind kind, size_t k)
{
    const struct ceduo_survey *survey = s->survey;
    double squares = 0;
    *c = (struct ceduo_survey_class){.kind = kind, .from = (double)k * CEDUO_SURVEY_CLASS};
    for (size_t i = 0; i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        if (stem->kind != kind || find_class(stem) != k)
            continue;
        s->counts[stem->plot]++;
        double step = stem->dbh - c->dbh; /* Welford's mean and sum of squares */
        c->dbh += step / (double)++c->stems;
        squares += step * (stem->dbh - c->dbh);
        c->height += kind == CEDUO_SURVEY_STUMP ? 0 : s->heights[i];
        if (kind != CEDUO_SURVEY_STUMP)
            add_volume(c, stem, s->heights[i], s->answer->species);
    }
    double n = (double)c->stems;
    c->per_ha = read_density(s);
    c->dbh_sd = c->stems > 1 ? sqrt(squares / (n - 1)) : 0;
    c->height = kind == CEDUO_SURVEY_STUMP ? s->answer->stump_height : c->height / n;
    c->volume = kind == CEDUO_SURVEY_STUMP ? NAN : c->volume / n;
}

static bool make_classes(struct surveyor *s)
{
    const struct ceduo_survey *survey = s->survey;
    bool *present = ceduo_arena_alloc(&s->memory, CEDUO_SURVEY_KINDS_COUNT * CLASSES_MAX * sizeof *present);
    size_t n = 0;
    for (size_t i = 0; present && i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        bool *entry = &present[(size_t)stem->kind * CLASSES_MAX + find_class(stem)];
        n += !*entry;
        *entry = true;
    }
    struct ceduo_survey_class *classes = s->answer->classes = present ? calloc(n + 1, sizeof *classes) : NULL;
    for (size_t k = 0; classes && k < CEDUO_SURVEY_KINDS_COUNT * CLASSES_MAX; k++)
        if (present[k])
            fill_class(s, &classes[s->answer->classes_count++], (enum ceduo_survey_kind)(k / CLASSES_MAX), k % CLASSES_MAX);
    return classes;
}

/* ---- stand ---- */

enum ceduo_status ceduo_survey_compute(const struct ceduo_survey *survey, struct ceduo_survey_result *a)
{
    GSL_RETURNS_ERRORS;
    struct surveyor s = {.survey = survey, .answer = a};
    *a = (struct ceduo_survey_result){0};
    if (ceduo_check_survey(survey) != CEDUO_OK)
        return CEDUO_BAD_ARGUMENT;
    s.counts = ceduo_arena_alloc(&s.memory, (survey->plots_count + 1) * sizeof *s.counts);
    s.heights = ceduo_arena_alloc(&s.memory, (survey->stems_count + 1) * sizeof *s.heights);
    s.pairs = ceduo_arena_alloc(&s.memory, (2 * survey->stems_count + 1) * sizeof *s.pairs);
    bool good = !s.memory.failed;
    for (int kind = 0; good && kind < CEDUO_SURVEY_KINDS_COUNT; kind++) {
        for (size_t i = 0; i < survey->stems_count; i++)
            s.counts[survey->stems[i].plot] += survey->stems[i].kind == (enum ceduo_survey_kind)kind ? 1 : 0;
        a->per_ha[kind] = read_density(&s);
    }
    a->species = find_main_species(survey);
    a->stump_diameter = stump_mean(survey, offsetof(struct ceduo_survey_stem, dbh));
    a->stump_height = stump_mean(survey, offsetof(struct ceduo_survey_stem, height));
    a->stump_energy = stump_mean(survey, offsetof(struct ceduo_survey_stem, energy));
    /* untaken 2: memory */
    good = good && count_stools(&s) && complete_heights(&s, true, &a->shoots) && complete_heights(&s, false, &a->trees) &&
           make_classes(&s);
    ceduo_arena_free(&s.memory);
    if (!good)
        ceduo_survey_release(a);
    return good ? CEDUO_OK : CEDUO_NO_MEMORY;
}

void ceduo_survey_release(struct ceduo_survey_result *answer)
{
    free(answer->classes);
    *answer = (struct ceduo_survey_result){0};
}
