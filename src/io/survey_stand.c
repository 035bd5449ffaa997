/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the stand of a survey as YAML: first the findings in comments, then the stand. Comments and texts of sources are in
 * the user's language. The rest is equal in all languages. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/language.h"
#include "base/text.h"
#include "node.h"
#include "scene/schema.h"
#include "scene/stand.h"
#include "scene/volume.h"
#include "study/naslund.h"
#include "study/plots.h"
#include "survey_file.h"

struct writer {
    const struct survey_file *file;
    const struct ceduo_survey_result *answer;
    struct text *out;
    double area;   /* of all plots, m2 on the map */
    bool one_plot; /* there are no standard errors */
    bool stumps;   /* height and energy of stumps are known, so the stand has them */
};

static const char *const kinds[] = {N_("shoots"), N_("standards"), N_("trees"), N_("stumps")};

/* Round to six digits; no survey is more precise. */
static double rounded(double value)
{
    char buffer[32];
    ceduo_decimal_format(buffer, sizeof buffer, "%.6g", value);
    return ceduo_decimal_read(buffer);
}

#define ROUNDED(value) ROUNDTRIP(rounded(value))

/* `end`: text after the source. */
static void print_source(struct text *out, bool assumed, const char *origin, const char *end)
{
    ceduo_text_format(out, "source: {kind: %s, text: ", assumed ? "assumed" : "measured");
    ceduo_emit_scalar(out, origin, true);
    ceduo_text_format(out, "}%s", end);
}

/* ---- comments ---- */

static void print_estimate_comment(struct text *out, const char *name, const struct ceduo_estimate *e)
{
    if (!(e->mean > 0))
        return;
    ceduo_text_format(out, "# %-10s %8.0f", name, e->mean);
    if (!isnan(e->se))
        ceduo_text_format(out, _(" %8.0f    %.0f to %.0f"), e->se, fmax(e->lo, 0), e->hi);
    ceduo_text_append_char(out, '\n');
}

static void print_heights_comment(struct text *out, const char *name, const struct ceduo_survey_heights *h)
{
    if (h->missing == 0)
        return;
    if (h->from <= CEDUO_SURVEY_HEIGHTS_CURVE)
        ceduo_text_format(out,
                          _("# heights of %s: %zu measured; %zu by Näslund's curve, h = 1.3 + d2/(%.4g + %.4g d)2, d in cm, "
                            "residual %.2g m"),
                          name, h->given, h->missing, h->curve.a, h->curve.b, h->curve.rmse);
    else if (h->from == CEDUO_SURVEY_HEIGHTS_MEAN)
        ceduo_text_format(out, _("# heights of %s: %zu measured; %zu are the mean of these, %.3g m: assumed"), name, h->given,
                          h->missing, h->mean);
    else if (h->from == CEDUO_SURVEY_HEIGHTS_SHOOTS)
        ceduo_text_format(out, _("# heights of %s: none measured; %zu by the curve of the shoots: assumed"), name, h->missing);
    else
        ceduo_text_format(out,
                          _("# heights of %s: none measured; %zu as usual, h = 1.3 + d2/(%.4g + %.4g d)2, d in cm: assumed"),
                          name, h->missing, h->curve.a, h->curve.b);
    if (h->beyond > 0)
        ceduo_text_format(out, _("; thicker than any of the measured: %zu"), h->beyond);
    ceduo_text_append_char(out, '\n');
}

static void print_comments(const struct writer *w)
{
    const struct ceduo_survey_result *a = w->answer;
    struct text *out = w->out;
    /* untaken: memory */
    ceduo_text_format(out, "# %s\n", w->file->understood ? w->file->understood : w->file->name);
    ceduo_text_format(out, "# %-10s %8s %8s    %s\n", "", _("per ha"), w->one_plot ? "" : _("s.e."),
                      w->one_plot ? "" : _("95 % interval"));
    print_estimate_comment(out, _("stools"), &a->stools);
    for (int k = 0; k < CEDUO_SURVEY_KINDS_COUNT; k++)
        print_estimate_comment(out, _(kinds[k]), &a->per_ha[k]);
    if (a->stools.mean > 0)
        ceduo_text_format(out, _("# shoots on a stool: %.2f\n"), a->per_ha[CEDUO_SURVEY_SHOOT].mean / a->stools.mean);
    if (w->one_plot)
        ceduo_text_append(out, _("# One plot has no standard error: the densities are marked as assumed.\n"));
    print_heights_comment(out, _("shoots"), &a->shoots);
    print_heights_comment(out, _("standards and trees"), &a->trees);
    for (size_t i = 0; i < a->classes_count; i++) {
        const struct ceduo_survey_class *c = &a->classes[i];
        if (c->form_factor > 0)
            ceduo_text_format(out,
                              _("# volume: %zu of %zu %s of %.0f to %.0f cm lie outside the equation of their species; "
                                "its form factor at the nearest size, or %g without one, assumed\n"),
                              c->form_factor, c->stems, _(kinds[c->kind]), c->from * 100, (c->from + CEDUO_SURVEY_CLASS) * 100,
                              CEDUO_FORM_FACTOR);
    }
    const struct ceduo_survey *s = &w->file->survey;
    size_t n, printed = 0;
    const struct ceduo_species *list = ceduo_species_list(&n);
    double all = ceduo_survey_basal_area(s, CEDUO_SURVEY_ALL), own;
    for (int k = -1; k < (int)n; k++)
        if ((own = ceduo_survey_basal_area(s, k)) > 0)
            ceduo_text_format(out, "%s%s %.0f %%", printed++ ? ", " : _("# basal area: "),
                              k < 0 ? _("not given") : _(list[k].common), 100 * own / all);
    ceduo_text_append(out, printed ? "\n" : "");
    if (!(a->per_ha[CEDUO_SURVEY_STUMP].mean > 0) || w->stumps)
        return;
    ceduo_text_append(
        out, /* the energy of a stump has no default: the user must give it */
        _("# The stumps are not in the stand. They need height_m and energy_kJ, the energy that one absorbs from a "
          "rock,\n# in at least one row of the survey, or here:\n"));
    ceduo_text_format(out, "# stumps: {per_ha: %s, diameter_m: %s, height_m: %s, energy_kJ: ?}\n",
                      ROUNDED(a->per_ha[CEDUO_SURVEY_STUMP].mean), ROUNDED(a->stump_diameter),
                      isnan(a->stump_height) ? "?" : ROUNDED(a->stump_height));
}

/* ---- the stand ---- */

/* True if the volume of a class must be written, because the program would not compute the same volume. The program computes it
 * if all stems outside the equation are of the main species and the form factor is the usual one. */
static bool needs_volume(const struct writer *w, const struct ceduo_survey_class *c)
{
    enum ceduo_volume_from from;
    const struct ceduo_stand stand = {.species = w->answer->species};
    const struct ceduo_stems stems = {.dbh = c->dbh, .height = c->height, .volume = NAN};
    ceduo_stem_volume(&stand, &stems, &from);
    bool usual = c->form_factor == c->stems && from == CEDUO_VOLUME_FORM_FACTOR;
    return c->form_factor == 0 || (c->form_factor_main < c->form_factor && !usual);
}

static bool is_tree(enum ceduo_survey_kind kind)
{
    return kind == CEDUO_SURVEY_STANDARD || kind == CEDUO_SURVEY_TREE;
}

static void print_classes(const struct writer *w, const char *key, bool trees)
{
    const struct ceduo_survey_heights *h = trees ? &w->answer->trees : &w->answer->shoots;
    for (size_t i = 0, n = 0; i < w->answer->classes_count; i++) {
        const struct ceduo_survey_class *c = &w->answer->classes[i];
        if (trees ? !is_tree(c->kind) : c->kind != CEDUO_SURVEY_SHOOT)
            continue;
        LOCAL_TEXT(origin);
        bool given = needs_volume(w, c);
        ceduo_text_format(w->out, "%s  - {per_ha: %s, dbh_m: %s", n++ ? "" : key, ROUNDED(c->per_ha.mean), ROUNDED(c->dbh));
        if (c->dbh_sd > 0) /* a stand accepts at most dbh_m; two thin stems may have more */
            ceduo_text_format(w->out, ", dbh_sd_m: %s", ROUNDED(fmin(c->dbh_sd, c->dbh)));
        ceduo_text_format(w->out, ", height_m: %s", ROUNDED(c->height));
        if (given)
            ceduo_text_format(w->out, ", volume_m3: %s", ROUNDED(c->volume));
        ceduo_text_format(&origin, _("%s of %.0f to %.0f cm, n = %zu"), _(kinds[c->kind]), c->from * 100,
                          (c->from + CEDUO_SURVEY_CLASS) * 100, c->stems);
        if (w->one_plot)
            ceduo_text_append(&origin, _("; one plot, no standard error"));
        if (h->missing > 0) /* the comments above describe the estimated heights */
            ceduo_text_format(&origin, _("; heights measured: %zu of %zu"), h->given, h->given + h->missing);
        if (c->form_factor > 0)
            ceduo_text_format(&origin, _("; volume of %zu by form factor"), c->form_factor);
        ceduo_text_append(w->out, ",\n     ");
        print_source(w->out, w->one_plot || h->from >= CEDUO_SURVEY_HEIGHTS_MEAN || (given && c->form_factor > 0),
                     ceduo_text_string(&origin), "}\n");
    }
}

/* Return the stools per hectare, limited to the shoots per hectare, also after rounding. */
static double count_stools(const struct writer *w)
{
    double shoots = 0;
    for (size_t i = 0; i < w->answer->classes_count; i++)
        if (w->answer->classes[i].kind == CEDUO_SURVEY_SHOOT)
            shoots += rounded(w->answer->classes[i].per_ha.mean);
    double stools = rounded(w->answer->stools.mean);
    return stools <= shoots ? stools : rounded(stools * (1 - 1e-5)); /* untaken: rounding */
}

/* ---- future years ---- */

/* With fewer standards the stand is a simple coppice, with less basal area of standards a coppice with standards, otherwise
 * large reserves (assumed; the limits lie between the shipped stands). A selection coppice is not recognized, because diameters
 * do not show the age of shoots. */
#define STANDARDS_MIN     90  /* 1/ha */
#define RESERVES_AREA_MIN 9.3 /* m2/ha */

/* Species of the shipped stands, and the prefix of their file names. */
static const struct {
    const char *species, *prefix;
} shipped[] = {{"ostrya-carpinifolia", ""},      {"fagus-sylvatica", "beech-"},       {"castanea-sativa", "chestnut-"},
               {"fraxinus-ornus", "manna-ash-"}, {"quercus-pubescens", "oak-downy-"}, {"quercus-cerris", "oak-turkey-"}};

/* Standards and trees of the survey. */
struct standards {
    double per_ha, area; /* 1/ha, m2/ha */
};

static struct standards count_standards(const struct ceduo_survey_result *a)
{
    struct standards sum = {0};
    for (size_t i = 0; i < a->classes_count; i++)
        if (is_tree(a->classes[i].kind)) {
            const struct ceduo_survey_class *c = &a->classes[i];
            sum.per_ha += c->per_ha.mean;
            sum.area += c->per_ha.mean * (M_PI / 4) * (c->dbh * c->dbh + c->dbh_sd * c->dbh_sd);
        }
    return sum;
}

static const char *choose_system(struct standards standards)
{
    return standards.per_ha < STANDARDS_MIN     ? "simple-coppice"
           : standards.area < RESERVES_AREA_MIN ? "coppice-with-standards"
                                                : "large-reserves";
}

/* Return the shipped stand for the species and system, resolved in the arena; NULL: none. Append its name to `name`. */
static const struct node *find_shipped(struct arena *arena, const struct ceduo_survey_result *a, struct text *name)
{
    LOCAL_PROBLEMS(problems);
    LOCAL_TEXT(yaml);
    const char *species = a->species >= 0 ? ceduo_species_words.names[a->species] : "";
    for (size_t i = 0; i < sizeof shipped / sizeof shipped[0]; i++)
        if (strcmp(shipped[i].species, species) == 0)
            ceduo_text_format(name, "%s%s", shipped[i].prefix, choose_system(count_standards(a)));
    ceduo_text_format(&yaml, "{forest: [{stand: %s}]}", ceduo_text_string(name));
    const struct source source = {.name = "", .bytes = ceduo_text_string(&yaml), .length = yaml.length};
    const struct node *root = name->length > 0 ? ceduo_yaml_read(arena, &source, &problems) : NULL;
    root = root ? ceduo_resolve_scene(arena, root, &problems) : NULL;
    return ceduo_resolve_at(root, "forest[0].stand");
}

/* Print the numbers of a list, scaled to `sum` and rounded; unchanged if `sum` is 0. */
static void print_scaled(struct text *out, const struct node *list, double sum)
{
    double all = 0;
    for (size_t i = 0; i < list->n; i++)
        all += ceduo_node_item_number(list, i);
    for (size_t i = 0; i < list->n; i++) {
        double number = ceduo_node_item_number(list, i);
        ceduo_text_format(out, "%s%s", i > 0 ? ", " : "[", ROUNDED(sum > 0 ? round(number * sum / all) : number));
    }
    ceduo_text_append(out, "]\n");
}

/* Print a mapping with a source of its own. A cut retains the counted number of standards. */
static void print_assumed(const struct writer *w, const char *key, const struct node *map, const char *origin)
{
    ceduo_text_format(w->out, "%s:\n", key);
    for (size_t i = 0; i < map->n; i++) {
        const struct node *item = map->items[i];
        if (strcmp(item->key, "source") == 0)
            continue;
        ceduo_text_format(w->out, "  %s: ", item->key);
        if (strcmp(item->key, "stay_per_ha") == 0) {
            print_scaled(w->out, item, count_standards(w->answer).per_ha);
            continue;
        }
        ceduo_emit_flow(w->out, item);
        ceduo_text_append_char(w->out, '\n');
    }
    ceduo_text_append(w->out, "  ");
    print_source(w->out, true, origin, "\n");
}

/* Print growth and cutting, which a single survey cannot show. */
static void print_future(const struct writer *w)
{
    LOCAL_ARENA(arena);
    LOCAL_TEXT(name);
    LOCAL_TEXT(origin);
    const struct node *stand = find_shipped(&arena, w->answer, &name);
    const struct node *growth = ceduo_node_get(stand, "growth"), *cutting = ceduo_node_get(stand, "cutting");
    if (!growth || !cutting) { /* untaken: table */
        ceduo_text_append(w->out, _("# ceduo has no stand of this species. Add growth and cutting for future years.\n"));
        return;
    }
    ceduo_text_format(w->out,
                      _("# Growth and cutting are assumed, as in the shipped stand '%s'.\n# A cut leaves the counted number of "
                        "standards. Check rotation_years and stay_per_ha; a selection coppice has cohorts: 3.\n"),
                      ceduo_text_string(&name));
    ceduo_text_format(&origin, _("as in the shipped stand '%s', not from this survey"), ceduo_text_string(&name));
    print_assumed(w, "growth", growth, ceduo_text_string(&origin));
    print_assumed(w, "cutting", cutting, ceduo_text_string(&origin));
}

/* ---- uncertainty ---- */

/* Print a row: a path and two numbers, lo and hi, or mean and sd. */
static void print_row(const struct writer *w, size_t *n, const char *path, const char *keys[2], double a, double b)
{
    ceduo_text_append(w->out, (*n)++ == 0 ? "uncertainty:\n  - {path: " : "  - {path: ");
    ceduo_emit_scalar(w->out, path, true);
    ceduo_text_format(w->out, ", %s: %s, %s: %s}\n", keys[0], ROUNDED(a), keys[1], ROUNDED(b));
}

/* Print a row with a mean and its standard error, unless that is 0. */
static void print_uncertainty(const struct writer *w, size_t *n, const char *path, const struct ceduo_estimate *e, double mean)
{
    if (e->se > 0)
        print_row(w, n, path, (const char *[]){"mean", "sd"}, mean, e->se);
}

static void print_uncertainties(const struct writer *w)
{
    const struct ceduo_survey_result *a = w->answer;
    size_t n = 0, indices[2] = {0};
    print_uncertainty(w, &n, "stools.per_ha", &a->stools, count_stools(w));
    print_uncertainty(w, &n, "stools.spacing_m", &a->spacing, a->spacing.mean);
    if (w->stumps)
        print_uncertainty(w, &n, "stumps.per_ha", &a->per_ha[CEDUO_SURVEY_STUMP], a->per_ha[CEDUO_SURVEY_STUMP].mean);
    for (size_t i = 0; i < a->classes_count; i++) {
        char path[64];
        const struct ceduo_survey_class *c = &a->classes[i];
        if (c->kind == CEDUO_SURVEY_STUMP)
            continue;
        bool tree = is_tree(c->kind);
        const char *list = tree ? "trees" : "shoots";
        snprintf(path, sizeof path, "%s[%zu].per_ha", list, indices[tree]++);
        print_uncertainty(w, &n, path, &c->per_ha, c->per_ha.mean);
        if ((tree ? a->trees : a->shoots).from < CEDUO_SURVEY_HEIGHTS_SHOOTS)
            continue;
        bool given = needs_volume(w, c); /* otherwise the program computes the volume from the height */
        double size = given ? c->volume : c->height, range = CEDUO_SURVEY_HEIGHT_UNCERTAINTY * size;
        snprintf(path, sizeof path, "%s[%zu].%s", list, indices[tree] - 1, given ? "volume_m3" : "height_m");
        print_row(w, &n, path, (const char *[]){"lo", "hi"}, size - range, size + range);
    }
}

/* ---- stand ---- */

static void print_stand(const struct writer *w)
{
    const struct ceduo_survey_result *a = w->answer;
    LOCAL_TEXT(origin);
    print_comments(w);
    bool stems = a->stools.mean > 0 || a->per_ha[CEDUO_SURVEY_STANDARD].mean + a->per_ha[CEDUO_SURVEY_TREE].mean > 0;
    ceduo_text_append(w->out, "ceduo: stand/1\nname: ");
    ceduo_emit_scalar(w->out, w->file->name, true);
    ceduo_text_append(w->out, stems || w->stumps ? "\n" : "\nsystem: bare\n");
    if (a->species >= 0)
        ceduo_text_format(w->out, "species: %s\n", ceduo_species_words.names[a->species]);
    if (a->stools.mean > 0) {
        bool measured = !isnan(a->spacing.mean);
        LOCAL_TEXT(stools_text);
        ceduo_text_format(w->out, "stools: {per_ha: %s, spacing_m: %s,\n  ", ROUNDED(count_stools(w)),
                          ROUNDED(measured ? a->spacing.mean : CEDUO_SURVEY_SPACING));
        ceduo_text_format(&stools_text, "n = %zu", w->file->survey.stools_count);
        if (measured)
            ceduo_text_format(&stools_text, _("; spacing on %zu of them"), a->stools_measured);
        else
            ceduo_text_append(&stools_text, _("; the spacing of the shoots was not measured"));
        if (w->one_plot)
            ceduo_text_append(&stools_text, _("; one plot, no standard error"));
        print_source(w->out, w->one_plot || !measured, ceduo_text_string(&stools_text), "}\n");
    }
    print_classes(w, "shoots:\n", false);
    print_classes(w, "trees:\n", true);
    if (w->stumps) {
        ceduo_text_format(w->out, "stumps: {per_ha: %s, diameter_m: %s, height_m: %s, energy_kJ: %s,\n  ",
                          ROUNDED(a->per_ha[CEDUO_SURVEY_STUMP].mean), ROUNDED(a->stump_diameter), ROUNDED(a->stump_height),
                          ROUNDED(a->stump_energy / 1000));
        print_source(w->out, true, _("counted; the energy that one absorbs is not measured"), "}\n");
    }
    if (a->stools.mean > 0)
        print_future(w);
    ceduo_text_format(&origin, _("survey of %zu plots, %.0f m2 of the map"), w->file->survey.plots_count, w->area);
    print_source(w->out, false, ceduo_text_string(&origin), "\n");
    print_uncertainties(w);
}

/* Report a density beyond the range of a stand, which means a wrong area, and an implausible extrapolation of the height
 * curve. */
static bool check(const struct writer *w, struct problems *problems)
{
    const struct ceduo_survey_result *a = w->answer;
    const struct ceduo_survey_heights *const heights[] = {&a->shoots, &a->trees};
    const struct source source = {.name = w->file->name};
    double densest = ceduo_schema_at("forest[0].stand.trees[0].per_ha")->hi;
    double highest = ceduo_schema_at("forest[0].stand.trees[0].height_m")->hi;
    for (size_t i = 0; i < a->classes_count; i++)
        if (a->classes[i].per_ha.mean > densest)
            return ceduo_problem(
                problems, &source, 0, 0,
                _("%.0f stems per hectare of one class exceed the limit of %.0f; check that the areas are in m2"),
                a->classes[i].per_ha.mean, densest);
    for (size_t i = 0; i < 2; i++) {
        const struct ceduo_survey_heights *h = heights[i];
        double tallest = h->from == CEDUO_SURVEY_HEIGHTS_CURVE || h->from == CEDUO_SURVEY_HEIGHTS_SHOOTS
                             ? ceduo_naslund_height(&h->curve, h->thickest)
                             : 0;
        if (tallest > highest)
            return ceduo_problem(
                problems, &source, 0, 0,
                _("by Näslund's curve a stem of %.4g cm is %.0f m tall, more than %.0f m; measure heights of thick stems, too"),
                h->thickest * 100, tallest, highest);
    }
    return true;
}

bool ceduo_survey_print_stand(const struct survey_file *file, struct text *yaml, struct problems *problems)
{
    struct ceduo_survey_result answer;
    struct writer w = {.file = file, .answer = &answer, .out = yaml, .one_plot = file->survey.plots_count == 1};
    if (ceduo_survey_compute(&file->survey, &answer) != CEDUO_OK) {
        problems->memory = true;
        return false;
    }
    for (size_t i = 0; i < file->survey.plots_count; i++)
        w.area += file->survey.areas[i];
    w.stumps = !isnan(answer.stump_height) && !isnan(answer.stump_energy);
    bool good = check(&w, problems);
    if (good)
        print_stand(&w);
    ceduo_survey_release(&answer);
    return good && ceduo_problems_check_memory(problems);
}
