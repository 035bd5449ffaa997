/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stand of a survey as YAML. What was found stands first, in comments for people; then the stand. These are the same
 * bytes in every language. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "emit.h"
#include "scene/schema.h"
#include "survey_file.h"

struct writer {
    const struct survey_file *file;
    const struct ceduo_survey_answer *answer;
    struct text *out;
    bool one_plot;
};

static const char *const kinds[] = {"shoots", "standards", "trees", "stumps"};

/* Six digits are more than a survey knows. */
static double rounded(double value)
{
    char room[32];
    snprintf(room, sizeof room, "%.6g", value);
    return strtod(room, NULL);
}

static void put_number(struct text *out, const char *before, double value)
{
    char room[CEDUO_NUMBER_ROOM];
    ceduo_text_format(out, "%s%s", before, ceduo_number_shortest(rounded(value), room));
}

static void put_source(struct text *out, bool assumed, struct text *what)
{
    ceduo_text_format(out, "source: {kind: %s, text: ", assumed ? "assumed" : "measured");
    ceduo_emit_scalar(out, ceduo_text_string(what), true);
    ceduo_text_put(out, "}");
    out->failed |= what->failed;
    ceduo_text_free(what);
}

static double map_area(const struct ceduo_survey *survey)
{
    double sum = 0;
    for (size_t i = 0; i < survey->plots_count; i++)
        sum += survey->areas[i];
    return sum;
}

/* ---- what was found ---- */

static void remark_estimate(struct text *out, const char *name, const struct ceduo_estimate *e)
{
    if (!(e->mean > 0))
        return;
    ceduo_text_format(out, "# %-10s %8.0f", name, e->mean);
    if (!isnan(e->se))
        ceduo_text_format(out, " %8.0f    %.0f to %.0f", e->se, fmax(e->lo, 0), e->hi);
    ceduo_text_char(out, '\n');
}

static void remark_densities(struct writer *w)
{
    const struct ceduo_survey_answer *a = w->answer;
    ceduo_text_format(w->out, "# %-10s %8s %8s    %s\n", "", "per ha", w->one_plot ? "" : "s.e.",
                      w->one_plot ? "" : "95 % interval");
    remark_estimate(w->out, "stools", &a->stools);
    for (int k = 0; k < CEDUO_SURVEY_KINDS_COUNT; k++)
        remark_estimate(w->out, kinds[k], &a->per_ha[k]);
    if (a->stools.mean > 0)
        ceduo_text_format(w->out, "# shoots on a stool: %.2f\n", a->per_ha[CEDUO_SURVEY_SHOOT].mean / a->stools.mean);
    if (w->one_plot)
        ceduo_text_put(w->out, "# One plot has no standard error: the densities are marked as assumed.\n");
}

static void remark_heights(struct writer *w, const char *name, const struct ceduo_survey_heights *h)
{
    if (h->missing == 0)
        return;
    ceduo_text_format(w->out, "# heights of %s: %zu measured; %zu ", name, h->given, h->missing);
    if (h->from == CEDUO_HEIGHTS_CURVE)
        ceduo_text_format(w->out, "by Näslund's curve, h = 1.3 + d2/(%.4g + %.4g d)2, d in cm, residual %.2g m", h->curve.a,
                          h->curve.b, h->curve.rmse);
    else
        ceduo_text_format(w->out, "are the mean of these, %.3g m: assumed", h->mean);
    if (h->beyond > 0)
        ceduo_text_format(w->out, "; thicker than any of the measured: %zu", h->beyond);
    ceduo_text_char(w->out, '\n');
}

static void remark_volumes(struct writer *w)
{
    for (size_t i = 0; i < w->answer->classes_count; i++) {
        const struct ceduo_survey_class *c = &w->answer->classes[i];
        if (c->form_factor > 0)
            ceduo_text_format(w->out,
                              "# volume: %zu of %zu %s of %.0f to %.0f cm lie outside the equation of their species; "
                              "its form factor at the nearest size, or %g without one, assumed\n",
                              c->form_factor, c->stems, kinds[c->kind], c->from * 100, (c->from + CEDUO_SURVEY_CLASS) * 100,
                              CEDUO_FORM_FACTOR);
    }
}

static void remark_species(struct writer *w)
{
    size_t n, said = 0;
    const struct ceduo_species *list = ceduo_species_list(&n);
    const struct ceduo_survey *s = &w->file->survey;
    double all = 0;
    for (size_t i = 0; i < s->stems_count; i++)
        all += s->stems[i].kind == CEDUO_SURVEY_STUMP ? 0 : s->stems[i].dbh * s->stems[i].dbh / s->areas[s->stems[i].plot];
    for (int k = -1; k < (int)n; k++) {
        double own = 0;
        for (size_t i = 0; i < s->stems_count; i++)
            if (s->stems[i].species == k && s->stems[i].kind != CEDUO_SURVEY_STUMP)
                own += s->stems[i].dbh * s->stems[i].dbh / s->areas[s->stems[i].plot];
        if (own > 0)
            ceduo_text_format(w->out, "%s%s %.0f %%", said++ ? ", " : "# basal area: ", k < 0 ? "not said" : list[k].name,
                              100 * own / all);
    }
    ceduo_text_put(w->out, said ? "\n" : "");
}

static bool has_stumps(const struct writer *w)
{
    return !isnan(w->answer->stump_height) && !isnan(w->answer->stump_energy);
}

/* What a stump takes from a rock has no default: it is asked for, not made up. */
static void remark_stumps(struct writer *w)
{
    const struct ceduo_survey_answer *a = w->answer;
    if (!(a->per_ha[CEDUO_SURVEY_STUMP].mean > 0) || has_stumps(w))
        return;
    ceduo_text_put(w->out,
                   "# The stumps are not in the stand: they need a height_m, and the energy_kJ that one takes from a rock,\n"
                   "# in at least one row of the survey, or here:\n");
    put_number(w->out, "# stumps: {per_ha: ", a->per_ha[CEDUO_SURVEY_STUMP].mean);
    put_number(w->out, ", diameter_m: ", a->stump_diameter);
    if (!isnan(a->stump_height))
        put_number(w->out, ", height_m: ", a->stump_height);
    ceduo_text_put(w->out, isnan(a->stump_height) ? ", height_m: ?, energy_kJ: ?}\n" : ", energy_kJ: ?}\n");
}

static void remark(struct writer *w)
{
    ceduo_text_put(w->out, "# From the survey '");
    ceduo_text_safe(w->out, w->file->name);
    ceduo_text_format(w->out, "': plots %zu, stems %zu, %.0f m2 of the map.\n", w->file->survey.plots_count,
                      w->file->survey.stems_count, map_area(&w->file->survey));
    remark_densities(w);
    remark_heights(w, "shoots", &w->answer->shoots);
    remark_heights(w, "standards and trees", &w->answer->trees);
    remark_volumes(w);
    remark_species(w);
    if (w->file->unused[0])
        ceduo_text_format(w->out, "# columns that were not used: %s\n", w->file->unused);
    remark_stumps(w);
}

/* ---- the stand ---- */

static const struct ceduo_survey_heights *heights_of(const struct writer *w, const struct ceduo_survey_class *c)
{
    return c->kind == CEDUO_SURVEY_SHOOT ? &w->answer->shoots : &w->answer->trees;
}

/* Whether the form factor is what the program takes anyway for such a class: then it says so itself. */
static bool is_usual_volume(const struct writer *w, const struct ceduo_survey_class *c)
{
    enum ceduo_volume_from from;
    const struct ceduo_stand stand = {.species = w->answer->species};
    const struct ceduo_stems stems = {.dbh = c->dbh, .height = c->height, .volume = NAN};
    ceduo_stem_volume(&stand, &stems, &from);
    return c->form_factor == c->stems && from == CEDUO_VOLUME_FORM_FACTOR;
}

/* Where all that lies outside its equation is of the main species, the program has these volumes itself. */
static bool is_given_volume(const struct writer *w, const struct ceduo_survey_class *c)
{
    return c->form_factor == 0 || (c->form_factor_main < c->form_factor && !is_usual_volume(w, c));
}

static bool is_assumed(const struct writer *w, const struct ceduo_survey_class *c)
{
    return w->one_plot || heights_of(w, c)->from == CEDUO_HEIGHTS_MEAN || (is_given_volume(w, c) && c->form_factor > 0);
}

static void put_class_source(struct writer *w, const struct ceduo_survey_class *c)
{
    struct text what = {0};
    const struct ceduo_survey_heights *h = heights_of(w, c);
    ceduo_text_format(&what, "%s of %.0f to %.0f cm, n = %zu", kinds[c->kind], c->from * 100,
                      (c->from + CEDUO_SURVEY_CLASS) * 100, c->stems);
    if (w->one_plot)
        ceduo_text_put(&what, "; one plot, no standard error");
    if (h->from == CEDUO_HEIGHTS_MEAN)
        ceduo_text_format(&what, "; missing heights: the mean of %zu", h->given);
    else if (h->from == CEDUO_HEIGHTS_CURVE)
        ceduo_text_put(&what, "; missing heights by Näslund's curve");
    if (c->form_factor > 0)
        ceduo_text_format(&what, "; volume of %zu by form factor", c->form_factor);
    put_source(w->out, is_assumed(w, c), &what);
}

static void put_class(struct writer *w, const struct ceduo_survey_class *c)
{
    put_number(w->out, "  - {per_ha: ", c->per_ha.mean);
    put_number(w->out, ", dbh_m: ", c->dbh);
    if (c->dbh_sd > 0) /* a stand takes none above dbh_m, which two thin stems may have */
        put_number(w->out, ", dbh_sd_m: ", fmin(c->dbh_sd, c->dbh));
    put_number(w->out, ", height_m: ", c->height);
    if (is_given_volume(w, c))
        put_number(w->out, ", volume_m3: ", c->volume);
    ceduo_text_put(w->out, ",\n     ");
    put_class_source(w, c);
    ceduo_text_put(w->out, "}\n");
}

static bool is_tree(enum ceduo_survey_kind kind)
{
    return kind == CEDUO_SURVEY_STANDARD || kind == CEDUO_SURVEY_TREE;
}

static void put_classes(struct writer *w, const char *key, bool trees)
{
    size_t n = 0;
    for (size_t i = 0; i < w->answer->classes_count; i++) {
        const struct ceduo_survey_class *c = &w->answer->classes[i];
        if (trees ? !is_tree(c->kind) : c->kind != CEDUO_SURVEY_SHOOT)
            continue;
        ceduo_text_format(w->out, "%s", n++ ? "" : key);
        put_class(w, c);
    }
}

/* Every stool has a shoot, also after rounding. */
static double stools_of(const struct writer *w)
{
    double shoots = 0;
    for (size_t i = 0; i < w->answer->classes_count; i++)
        if (w->answer->classes[i].kind == CEDUO_SURVEY_SHOOT)
            shoots += rounded(w->answer->classes[i].per_ha.mean);
    double stools = rounded(w->answer->stools.mean);
    return stools <= shoots ? stools : rounded(stools * (1 - 1e-5)); /* untaken: rounding */
}

static void put_stools(struct writer *w)
{
    const struct ceduo_estimate *spacing = &w->answer->spacing;
    struct text what = {0};
    if (!(w->answer->stools.mean > 0))
        return;
    bool measured = !isnan(spacing->mean);
    put_number(w->out, "stools: {per_ha: ", stools_of(w));
    put_number(w->out, ", spacing_m: ", measured ? spacing->mean : CEDUO_SURVEY_SPACING);
    ceduo_text_put(w->out, ",\n  ");
    ceduo_text_format(&what, "n = %zu", w->file->survey.stools_count);
    if (measured)
        ceduo_text_format(&what, "; spacing on %zu of them", w->answer->stools_measured);
    else
        ceduo_text_put(&what, "; the spacing of the shoots was not measured");
    if (w->one_plot)
        ceduo_text_put(&what, "; one plot, no standard error");
    put_source(w->out, w->one_plot || !measured, &what);
    ceduo_text_put(w->out, "}\n");
}

static void put_stumps(struct writer *w)
{
    const struct ceduo_survey_answer *a = w->answer;
    struct text what = {0};
    if (!has_stumps(w))
        return;
    put_number(w->out, "stumps: {per_ha: ", a->per_ha[CEDUO_SURVEY_STUMP].mean);
    put_number(w->out, ", diameter_m: ", a->stump_diameter);
    put_number(w->out, ", height_m: ", a->stump_height);
    put_number(w->out, ", energy_kJ: ", a->stump_energy / 1000);
    ceduo_text_put(w->out, ",\n  ");
    ceduo_text_put(&what, "counted; what one takes from a rock is not measured");
    put_source(w->out, true, &what);
    ceduo_text_put(w->out, "}\n");
}

/* ---- doubt ---- */

/* A mean and its standard error. */
static void put_doubt(struct writer *w, size_t *n, const char *path, const struct ceduo_estimate *e, double mean)
{
    if (!(e->se > 0))
        return;
    if ((*n)++ == 0)
        ceduo_text_put(w->out, "doubt:\n");
    ceduo_text_put(w->out, "  - {path: ");
    ceduo_emit_scalar(w->out, path, true);
    put_number(w->out, ", mean: ", mean);
    put_number(w->out, ", sd: ", e->se);
    ceduo_text_put(w->out, "}\n");
}

static void put_doubts(struct writer *w)
{
    const struct ceduo_survey_answer *a = w->answer;
    size_t n = 0, at[2] = {0};
    put_doubt(w, &n, "stools.per_ha", &a->stools, stools_of(w));
    put_doubt(w, &n, "stools.spacing_m", &a->spacing, a->spacing.mean);
    if (has_stumps(w))
        put_doubt(w, &n, "stumps.per_ha", &a->per_ha[CEDUO_SURVEY_STUMP], a->per_ha[CEDUO_SURVEY_STUMP].mean);
    for (size_t i = 0; i < a->classes_count; i++) {
        char path[64];
        const struct ceduo_survey_class *c = &a->classes[i];
        if (c->kind == CEDUO_SURVEY_STUMP)
            continue;
        bool tree = is_tree(c->kind);
        snprintf(path, sizeof path, "%s[%zu].per_ha", tree ? "trees" : "shoots", at[tree]++);
        put_doubt(w, &n, path, &c->per_ha, c->per_ha.mean);
    }
}

/* ---- the whole ---- */

static void put_stand(struct writer *w)
{
    const struct ceduo_survey_answer *a = w->answer;
    struct text what = {0};
    bool stems = a->stools.mean > 0 || a->per_ha[CEDUO_SURVEY_STANDARD].mean + a->per_ha[CEDUO_SURVEY_TREE].mean > 0;
    ceduo_text_put(w->out, "ceduo: stand/1\nname: ");
    ceduo_emit_scalar(w->out, w->file->name, true);
    ceduo_text_put(w->out, stems || has_stumps(w) ? "\n" : "\nsystem: bare\n");
    if (a->species >= 0)
        ceduo_text_format(w->out, "species: %s\n", ceduo_species_words.names[a->species]);
    put_stools(w);
    put_classes(w, "shoots:\n", false);
    put_classes(w, "trees:\n", true);
    put_stumps(w);
    ceduo_text_format(&what, "survey of %zu plots, %.0f m2 of the map", w->file->survey.plots_count,
                      map_area(&w->file->survey));
    put_source(w->out, false, &what);
    ceduo_text_char(w->out, '\n');
    put_doubts(w);
}

/* A density that no stand may have comes of a wrong area. */
static bool check_densities(const struct writer *w, struct problems *problems)
{
    double most = ceduo_schema_at("forest[0].stand.trees[0].per_ha")->hi;
    for (size_t i = 0; i < w->answer->classes_count; i++) {
        const struct ceduo_survey_class *c = &w->answer->classes[i];
        if (c->per_ha.mean <= most)
            continue;
        ceduo_problem(problems, &(struct source){.name = w->file->name}, 0, 0,
                      _("%.0f stems of one class per hectare are more than %.0f; are the areas in m2?"), c->per_ha.mean, most);
        return false;
    }
    return true;
}

/* A curve that still rises steeply where the measured heights end goes to the sky beyond. */
static bool check_curve(const struct writer *w, const struct ceduo_survey_heights *h, struct problems *problems)
{
    double most = ceduo_schema_at("forest[0].stand.trees[0].height_m")->hi;
    double tallest = h->from == CEDUO_HEIGHTS_CURVE ? ceduo_naslund_height(&h->curve, h->thickest) : 0;
    if (tallest <= most)
        return true;
    ceduo_problem(
        problems, &(struct source){.name = w->file->name}, 0, 0,
        _("Näslund's curve makes a stem of %.4g cm %.0f m tall, more than %.0f; measure the heights of thick stems, too"),
        h->thickest * 100, tallest, most);
    return false;
}

bool ceduo_survey_stand(const struct survey_file *file, struct text *yaml, struct problems *problems)
{
    struct ceduo_survey_answer answer;
    struct writer w = {file, &answer, yaml, file->survey.plots_count == 1};
    if (ceduo_survey_ask(&file->survey, &answer) != CEDUO_OK) {
        ceduo_problem_memory(problems);
        return false;
    }
    bool good =
        check_densities(&w, problems) && check_curve(&w, &answer.shoots, problems) && check_curve(&w, &answer.trees, problems);
    if (good) {
        remark(&w);
        put_stand(&w);
    }
    ceduo_survey_free(&answer);
    if (yaml->failed)
        ceduo_problem_memory(problems);
    return good && !yaml->failed;
}
