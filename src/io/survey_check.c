/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks a whole survey for values in a wrong unit. Then makes the line for the user. */
#include <math.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "study/plots.h"
#include "survey_reader.h"

/* Limits beyond which a column needs a unit (assumed). */
#define BASAL_BARE      80   /* m2/ha */
#define BASAL_MAX       300  /* m2/ha: an error even if the heads give units */
#define DBH_BARE        0.40 /* m, mean diameter, */
#define SLENDERNESS_MIN 25   /* if the mean height is less than 25 diameters */
#define HEIGHT_BARE     45   /* m, mean height */

/* Sizes of stems. */
struct sizes {
    double lo, hi, dbh;           /* m, diameters of stems without stumps; dbh: mean */
    double height, height_of_dbh; /* m, mean height of stems with a height, mean diameter of these stems */
    size_t n, heights;            /* stems without stumps; of these, stems with a height */
};

static struct sizes measure_sizes(const struct ceduo_survey *survey)
{
    struct sizes s = {.lo = INFINITY};
    for (size_t i = 0; i < survey->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &survey->stems[i];
        if (stem->kind == CEDUO_SURVEY_STUMP)
            continue;
        s.n++;
        s.dbh += stem->dbh;
        s.lo = fmin(s.lo, stem->dbh);
        s.hi = fmax(s.hi, stem->dbh);
        if (isnan(stem->height))
            continue;
        s.heights++;
        s.height += stem->height;
        s.height_of_dbh += stem->dbh;
    }
    s.dbh /= (double)s.n;
    s.height /= (double)s.heights;
    s.height_of_dbh /= (double)s.heights;
    return s;
}

/* Return the mean basal area over the plots, m2/ha. */
static double mean_basal_area(const struct ceduo_survey *survey)
{
    return ceduo_survey_basal_area(survey, CEDUO_SURVEY_ALL) * (M_PI / 4) * 10000 / (double)survey->plots_count;
}

static bool has_column(const struct survey_reader *r, enum column c)
{
    return r->columns[c] < CEDUO_CSV_DUPLICATE;
}

/* True if the heads of two columns, if present, have units. */
static bool have_units(const struct survey_reader *r, enum column a, enum column b)
{
    return (!has_column(r, a) || r->units[a]) && (!has_column(r, b) || r->units[b]);
}

/* Return the head of a column as the place of an error. */
static struct csv_cell get_head(const struct survey_reader *r, enum column c)
{
    return (struct csv_cell){.begin = r->csv.heads[r->columns[c]].begin};
}

static enum column size_column(const struct survey_reader *r)
{
    return has_column(r, DBH) ? DBH : CIRCUMFERENCE;
}

static bool check_sizes(struct survey_reader *r, const struct ceduo_survey *survey)
{
    const struct sizes s = measure_sizes(survey);
    const double basal = mean_basal_area(survey);
    const enum column size = size_column(r), area = has_column(r, AREA) ? AREA : RADIUS;
    const bool sized = have_units(r, DBH, CIRCUMFERENCE), laid = have_units(r, AREA, RADIUS);
    const struct csv_cell head = get_head(r, size);
    const struct csv_cell height = has_column(r, HEIGHT) ? r->csv.heads[r->columns[HEIGHT]] : (struct csv_cell){.p = ""};
    const bool may_be_altitude =
        has_column(r, HEIGHT) && (!r->units[HEIGHT] || ceduo_csv_matches(height.p, height.n, "alt|alt m|alt mt|alt metri"));
    bool *asked = r->answers->asked;
    if (may_be_altitude && s.height > HEIGHT_BARE && !r->answers->given[SURVEY_HEIGHTS]) {
        asked[SURVEY_HEIGHTS] = true;
        return ceduo_csv_error(
            &r->csv, get_head(r, HEIGHT),
            _("the mean height is %.0f m; name the column 'height_m' for heights in metres, 'altitude' for altitudes"),
            s.height);
    }
    if (!sized && s.dbh > DBH_BARE && s.height < SLENDERNESS_MIN * s.height_of_dbh) {
        asked[SURVEY_DIAMETERS] = true;
        return ceduo_csv_error(&r->csv, head,
                               size == DBH ? _("the mean diameter is %.0f cm, the mean height %.3g m; name the column 'dbh_mm' "
                                               "for millimetres, 'dbh_cm' for centimetres")
                                           : _("the mean diameter is %.0f cm, the mean height %.3g m; name the column "
                                               "'circumference_mm' for millimetres, 'circumference_cm' for centimetres"),
                               s.dbh * 100, s.height);
    }
    if (basal > BASAL_MAX)
        return ceduo_csv_error(
            &r->csv, get_head(r, area),
            _("the basal area is %.0f m2/ha, more than any forest has; check that areas are in m2 and diameters in cm"), basal);
    if (basal <= BASAL_BARE || (sized && laid))
        return true;
    asked[SURVEY_AREAS] = !laid;
    asked[SURVEY_DIAMETERS] = !sized;
    return ceduo_csv_error(&r->csv, sized ? get_head(r, area) : head,
                           size == DBH
                               ? _("the basal area is very high, %.0f m2/ha; name the columns '%s' and 'dbh_cm' if it is "
                                   "right, 'dbh_mm' if the diameters are in millimetres")
                               : _("the basal area is very high, %.0f m2/ha; name the columns '%s' and 'circumference_cm' if "
                                   "it is right, 'circumference_mm' if the circumferences are in millimetres"),
                           basal, HEAD(area));
}

static bool are_equal_words(struct csv_cell a, struct csv_cell b)
{
    return a.n == b.n && strncasecmp(a.p, b.p, a.n) == 0;
}

/* True if two plots have equal sites, ignoring case. */
static bool are_equal_sites(const struct survey_plot *a, const struct survey_plot *b)
{
    bool same = true;
    for (size_t i = 0; i < SITES && same; i++)
        same = are_equal_words(a->sites[i], b->sites[i]);
    return same;
}

/* Check two plots with one number at different sites. Rows that alternate between sites suggest that the column is not a
 * site. */
static bool check_sites(const struct survey_reader *r, const struct survey_plot *a, const struct survey_plot *b)
{
    size_t line = a->returned ? a->returned : b->returned, site = 0;
    if (line == 0)
        return true;
    while (site + 1 < SITES && /* untaken: bound */
           ceduo_csv_compare(a->sites[site], b->sites[site]) == 0)
        site++;
    LOCAL_TEXT(name);
    const struct csv_cell head = r->csv.heads[r->columns[SITE + site]];
    ceduo_text_append_escaped_n(&name, head.p, head.n);
    return ceduo_problem(r->problems, r->csv.source, line, 1,
                         _("the rows of plot '%.*s' alternate between values of '%s'; sort the rows by this column if it is "
                           "the site of the plot, otherwise rename it"),
                         a->name.n < 100 ? (int)a->name.n : 100, a->name.p, ceduo_text_string(&name));
}

/* Compare the names of plots. Stops at the first error. */
static bool check_plots(struct survey_reader *r)
{
    bool good = true;
    for (size_t i = 0; i < r->plots_count && good; i++)
        for (size_t k = 0; k < i && good; k++) {
            const struct survey_plot *a = &r->plots[k], *b = &r->plots[i];
            const bool same = are_equal_sites(a, b);
            if (same && are_equal_words(a->name, b->name))
                good = ceduo_problem(
                    r->problems, r->csv.source, b->line, 1,
                    _("the names of this plot and of the plot on line %zu differ only in case; make them equal, or rename one"),
                    a->line);
            else if (same && a->number == b->number)
                good = ceduo_problem(
                    r->problems, r->csv.source, b->line, 1,
                    _("the names of this plot and of the plot on line %zu are one number; make them equal, or rename one"),
                    a->line);
            else if (ceduo_csv_compare(a->name, b->name) == 0) {
                r->split = true;
                good = check_sites(r, a, b);
            }
        }
    return good;
}

bool ceduo_survey_check(struct survey_reader *r, const struct ceduo_survey *survey)
{
    bool good = check_plots(r);
    return check_sizes(r, survey) && good;
}

/* ---- the line for the user ---- */

static void describe_plots(const struct survey_reader *r, struct text *line)
{
    double lo = INFINITY, hi = 0;
    for (size_t i = 0; i < r->plots_count; i++) {
        const double area = ceduo_survey_area(&r->plots[i]);
        lo = fmin(lo, area);
        hi = fmax(hi, area);
    }
    ceduo_text_format(line, ngettext("%zu plot", "%zu plots", r->plots_count), r->plots_count);
    if (lo == hi)
        ceduo_text_format(line, _(" of %.4g m2"), lo);
    else
        ceduo_text_format(line, _(" of %.4g to %.4g m2"), lo, hi);
    for (int c = SITE; r->split && c <= SITE_LAST; c++)
        if (has_column(r, (enum column)c)) {
            const struct csv_cell head = r->csv.heads[r->columns[c]];
            LOCAL_TEXT(name);
            ceduo_text_append_escaped_n(&name, head.p, head.n);
            ceduo_text_format(line, _(", distinguished by %s"), ceduo_text_string(&name));
        }
}

static void describe_slopes(const struct survey_reader *r, struct text *line)
{
    double lo = INFINITY, hi = -INFINITY;
    for (size_t i = 0; i < r->plots_count; i++) {
        const double slope = r->plots[i].values[SLOPE];
        lo = isnan(slope) ? lo : fmin(lo, slope);
        hi = isnan(slope) ? hi : fmax(hi, slope);
    }
    if (lo < hi)
        ceduo_text_format(line, _("; slopes %.0f to %.0f degrees"), lo, hi);
    else if (lo == hi)
        ceduo_text_format(line, _("; slope %.0f degrees"), lo);
    if (lo <= hi && r->units[SLOPE] == CSV_UNIT_OTHER)
        ceduo_text_append(line, _(", given in percent"));
}

static void describe_stems(const struct survey_reader *r, const struct ceduo_survey *survey, struct text *line)
{
    size_t counts[CEDUO_SURVEY_KINDS_COUNT] = {0}, all = 0;
    for (size_t i = 0; i < survey->stems_count; i++)
        counts[survey->stems[i].kind]++;
    for (int k = 0; k < CEDUO_SURVEY_KINDS_COUNT; k++) {
        const size_t n = counts[k], stools = survey->stools_count;
        all += n;
        if (n == 0)
            continue;
        ceduo_text_append(line, ", ");
        if (k == CEDUO_SURVEY_SHOOT) {
            ceduo_text_format(line, ngettext("%zu shoot", "%zu shoots", n), n);
            ceduo_text_format(line, ngettext(" on %zu stool", " on %zu stools", stools), stools);
        } else if (k == CEDUO_SURVEY_STANDARD)
            ceduo_text_format(line, ngettext("%zu standard", "%zu standards", n), n);
        else if (k == CEDUO_SURVEY_TREE)
            ceduo_text_format(line, ngettext("%zu tree", "%zu trees", n), n);
        else
            ceduo_text_format(line, ngettext("%zu stump", "%zu stumps", n), n);
    }
    if (all == 0)
        ceduo_text_append(line, _(", no stems"));
    if (all == counts[CEDUO_SURVEY_STUMP])
        return;
    const struct sizes s = measure_sizes(survey);
    ceduo_text_format(line, s.lo < s.hi ? _("; dbh %.3g to %.3g cm") : _("; dbh %.3g cm"), s.lo * 100, s.hi * 100);
    if (r->units[size_column(r)] == CSV_UNIT_OTHER)
        ceduo_text_append(line, _(", given in mm"));
    if (!has_column(r, DBH))
        ceduo_text_append(line, _(", from circumferences"));
    ceduo_text_format(line, _("; basal area %.3g m2/ha"), mean_basal_area(survey));
}

static void describe_rows(const struct survey_reader *r, struct text *line)
{
    if (r->dead > 0 && r->cut > 0)
        ceduo_text_format(line, _("; %zu dead and %zu cut left out"), r->dead, r->cut);
    else if (r->dead > 0)
        ceduo_text_format(line, _("; %zu dead left out"), r->dead);
    else if (r->cut > 0)
        ceduo_text_format(line, _("; %zu cut left out"), r->cut);
    if (r->unmarked > 0)
        ceduo_text_format(
            line, ngettext("; %zu without a status counts as live", "; %zu without a status count as live", r->unmarked),
            r->unmarked);
    if (r->repeated > 0)
        ceduo_text_format(
            line,
            ngettext("; %zu stem occurs twice (line %zu)", "; %zu stems occur twice (the first on line %zu)", r->repeated),
            r->repeated, r->repeated_line);
    if (r->totals > 0)
        ceduo_text_format(line, ngettext("; %zu row of totals left out", "; %zu rows of totals left out", r->totals),
                          r->totals);
    if (r->filled > 0)
        ceduo_text_format(line,
                          ngettext("; %zu row without a plot belongs to the plot above",
                                   "; %zu rows without a plot belong to the plot above", r->filled),
                          r->filled);
}

/* List the ambiguous heads, with the meaning that the reader chose. */
static void describe_heads(const struct survey_reader *r, struct text *line)
{
    static const enum column columns[] = {RADIUS, DBH, HEIGHT, COUNT};
    size_t n = 0;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++) {
        const enum column c = columns[i];
        if (!has_column(r, c) || !ceduo_survey_is_vague(&r->csv, r->columns[c]))
            continue;
        const struct csv_cell head = r->csv.heads[r->columns[c]];
        ceduo_text_append(line, n++ == 0 ? _("; read as: ") : ", ");
        ceduo_text_append_escaped_n(line, head.p, head.n);
        ceduo_text_format(line, " = %s", HEAD(c));
    }
}

const char *ceduo_survey_describe(const struct survey_reader *r, const struct ceduo_survey *survey, const char *name)
{
    LOCAL_TEXT(line);
    LOCAL_TEXT(read_as);
    ceduo_text_append_escaped(&line, name);
    ceduo_text_append(&line, ": ");
    describe_plots(r, &line);
    describe_stems(r, survey, &line);
    describe_slopes(r, &line);
    describe_rows(r, &line);
    describe_heads(r, &read_as);
    ceduo_csv_describe(&r->csv, r->columns, COLUMNS, ceduo_text_string(&read_as), &line);
    return ceduo_arena_string(r->arena, ceduo_text_string(&line));
}
