/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the rows of a survey. What belongs to a plot may stand in its first row alone; a row of a plot without a stem
 * says that there is none. */
#include "survey_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "bind.h"
#include "csv.h"

#define PLOTS_MOST 1000
#define STEMS_MOST 200000
#define SLOPE_MOST 85  /* degrees */
#define STUMP_MOST 20  /* m of height, as in a stand */
#define DBH_MOST   300 /* cm: beyond it a diameter is in mm rather than of such a tree (assumed) */

enum column { PLOT, AREA, RADIUS, SLOPE, SPECIES, KIND, STOOL, DBH, HEIGHT, SPACING, ENERGY, COLUMNS };

/* Names of a column, the first one is that of the manual; in other languages as their spreadsheets have them. */
static const char *const names[COLUMNS][5] = {
    [PLOT] = {"plot", "saggio", "area_di_saggio", "probefläche"},
    [AREA] = {"area_m2", "superficie_m2", "fläche_m2"},
    [RADIUS] = {"radius_m", "raggio_m"},
    [SLOPE] = {"slope_deg", "pendenza_gradi", "neigung_grad"},
    [SPECIES] = {"species", "specie", "baumart"},
    [KIND] = {"kind", "tipo", "typ"},
    [STOOL] = {"stool", "ceppaia", "stock"},
    [DBH] = {"dbh_cm", "diametro_cm", "bhd_cm"},
    [HEIGHT] = {"height_m", "altezza_m", "höhe_m"},
    [SPACING] = {"spacing_m", "distanza_m", "abstand_m"},
    [ENERGY] = {"energy_kJ", "energia_kJ", "energie_kJ"},
};

static const struct {
    double lo, hi;
    const char *unit;
} ranges[COLUMNS] = {[AREA] = {1, 1e6, "m2"},  [RADIUS] = {0.5, 500, "m"}, [SLOPE] = {0, SLOPE_MOST, "degrees"},
                     [DBH] = {0.1, 1e6, "cm"}, [HEIGHT] = {0, 150, "m"},   [SPACING] = {0.01, 20, "m"},
                     [ENERGY] = {0, 1e6, "kJ"}};

/* Words of a kind of stem, the first one is that of the manual. */
static const char *const kinds[CEDUO_SURVEY_KINDS_COUNT][4] = {[CEDUO_SURVEY_SHOOT] = {"shoot", "pollone"},
                                                               [CEDUO_SURVEY_STANDARD] = {"standard", "matricina"},
                                                               [CEDUO_SURVEY_TREE] = {"tree", "albero", "allievo"},
                                                               [CEDUO_SURVEY_STUMP] = {"stump", "ceppo"}};

struct plot {
    struct csv_span name;
    size_t line;          /* where it comes first */
    double of[SLOPE + 1]; /* AREA, RADIUS, SLOPE; NaN: not said */
};

/* The stool of a shoot by its name, before stools are numbered. */
struct stool {
    size_t plot, stem;
    struct csv_span name;
};

struct reader {
    struct csv csv;
    struct problems *problems;
    size_t columns[COLUMNS];
    struct csv_span fields[COLUMNS]; /* of the present row */
    struct plot *plots;
    size_t plots_count;
    struct ceduo_survey_stem *stems;
    size_t stems_count, shoots_count;
    struct stool *stools; /* of each shoot */
};

/* ---- header ---- */

static void read_header(struct reader *r, struct text *unused)
{
    struct csv_span field;
    const char *missing[COLUMNS];
    size_t n = 0;
    for (int c = 0; c < COLUMNS; c++) {
        r->columns[c] = ceduo_csv_column(&r->csv, names[c], "");
        r->csv.source->foreign &= r->columns[c] == CEDUO_CSV_NONE;
        if (r->columns[c] == CEDUO_CSV_TWICE)
            ceduo_problem(r->problems, r->csv.source, 1, 1, _("the column '%s' is there twice; rename all but one"),
                          names[c][0]);
        else if (r->columns[c] == CEDUO_CSV_NONE)
            missing[n++] = names[c][0];
    }
    for (size_t i = 0; ceduo_csv_field(&r->csv, i, &field); i++) {
        bool used = field.n == 0;
        for (int c = 0; c < COLUMNS; c++)
            used |= r->columns[c] == i;
        if (used)
            continue;
        char word[64] = "";
        if (field.n < sizeof word)
            memcpy(word, field.p, field.n);
        const char *near = ceduo_text_nearest(word, missing, n); /* near to one that is missing: a slip */
        if (near)
            ceduo_csv_complain(&r->csv, field, _("'%s': unknown column; did you mean '%s'?"), word, near);
        ceduo_text_put(unused, unused->length > 0 ? ", " : "");
        ceduo_text_safe_n(unused, field.p, field.n);
    }
    static const enum column needed[] = {PLOT, KIND, DBH};
    for (size_t i = 0; i < sizeof needed / sizeof needed[0]; i++)
        if (r->columns[needed[i]] == CEDUO_CSV_NONE)
            ceduo_problem_own(r->problems, (struct problem_place){r->csv.source, 1, 1, NULL},
                              _("the first line must name the column '%s'"), names[needed[i]][0]);
    if (r->columns[AREA] == CEDUO_CSV_NONE && r->columns[RADIUS] == CEDUO_CSV_NONE)
        ceduo_problem(r->problems, r->csv.source, 1, 1, _("the first line must name the column 'area_m2' or 'radius_m'"));
}

/* ---- rows ---- */

/* A number that may be left empty: NaN then. False if it is wrong, which is reported. */
static bool read_number(struct reader *r, enum column c, double *value)
{
    *value = NAN;
    return r->fields[c].n == 0 || ceduo_csv_number(&r->csv, r->fields[c], ranges[c].lo, ranges[c].hi, ranges[c].unit, value);
}

static bool read_plot(struct reader *r, size_t *plot)
{
    struct csv_span name = r->fields[PLOT];
    size_t i = r->plots_count;
    bool good = true;
    if (name.n == 0)
        return ceduo_csv_complain(&r->csv, name, _("the plot is missing"));
    while (i > 0 && !(r->plots[i - 1].name.n == name.n && memcmp(r->plots[i - 1].name.p, name.p, name.n) == 0))
        i--; /* mostly the last */
    if (i == 0 && r->plots_count == PLOTS_MOST)
        return ceduo_csv_complain(&r->csv, name, _("more than %d plots"), PLOTS_MOST);
    if (i == 0) {
        r->plots[r->plots_count] = (struct plot){name, r->csv.number, {NAN, NAN, NAN, NAN}};
        i = ++r->plots_count;
    }
    *plot = i - 1;
    for (enum column c = AREA; c <= SLOPE; c++) { /* what is said of a plot again must be the same */
        double now, *known = &r->plots[*plot].of[c];
        bool read = read_number(r, c, &now), differs = !isnan(now) && !isnan(*known) && now != *known;
        if (read && differs)
            ceduo_csv_complain(&r->csv, r->fields[c], _("'%s' is %g elsewhere for this plot, here %g"), names[c][0], *known,
                               now);
        good = good && read && !differs;
        *known = read && isnan(*known) ? now : *known;
    }
    if (r->fields[AREA].n > 0 && r->fields[RADIUS].n > 0)
        return ceduo_csv_complain(&r->csv, r->fields[RADIUS], _("area_m2 already says this; leave one of the two empty"));
    return good;
}

static bool read_kind(struct reader *r, enum ceduo_survey_kind *kind)
{
    struct csv_span f = r->fields[KIND];
    for (int k = 0; k < CEDUO_SURVEY_KINDS_COUNT; k++)
        for (int i = 0; kinds[k][i]; i++)
            if (ceduo_csv_is(f, kinds[k][i])) {
                *kind = (enum ceduo_survey_kind)k;
                return true;
            }
    if (f.n == 0)
        return ceduo_csv_complain(&r->csv, f, _("the kind is missing: shoot, standard, tree or stump"));
    return ceduo_csv_complain(&r->csv, f, _("'%.*s' is no kind of stem: shoot, standard, tree or stump"),
                              f.n < 100 ? (int)f.n : 100, f.p);
}

static bool read_species(struct reader *r, int *species)
{
    struct csv_span f = r->fields[SPECIES];
    size_t n;
    const struct ceduo_species *list = ceduo_species_list(&n);
    char word[64] = ""; /* blanks and underscores do for hyphens */
    for (size_t i = 0; i < f.n && f.n < sizeof word; i++)
        word[i] = f.p[i] == ' ' || f.p[i] == '_' ? '-' : f.p[i];
    *species = -1;
    for (size_t i = 0; i < n; i++)
        if (strcasecmp(word, list[i].name) == 0 || ceduo_csv_is(f, list[i].common))
            *species = (int)i;
    if (*species >= 0 || f.n == 0)
        return true;
    LOCAL_TEXT(all);
    ceduo_text_words(&all, ceduo_species_words.names, ceduo_species_words.n, ", ");
    return ceduo_csv_complain(&r->csv, f, _("'%.*s' is an unknown species; leave it empty, or one of: %s"),
                              f.n < 100 ? (int)f.n : 100, f.p, ceduo_text_string(&all));
}

/* The sizes of a stem. */
static bool read_sizes(struct reader *r, struct ceduo_survey_stem *stem)
{
    const struct csv *csv = &r->csv;
    const struct csv_span *fields = r->fields;
    bool good = read_number(r, DBH, &stem->dbh), stump = stem->kind == CEDUO_SURVEY_STUMP;
    good = read_number(r, HEIGHT, &stem->height) && good;
    good = read_number(r, SPACING, &stem->spacing) && good;
    good = read_number(r, ENERGY, &stem->energy) && good;
    if (!good)
        return false;
    if (isnan(stem->dbh))
        return ceduo_csv_complain(csv, fields[DBH], _("the diameter is missing"));
    if (stem->dbh > DBH_MOST)
        return ceduo_csv_complain(csv, fields[DBH], _("%g cm: more than %d cm; is it in mm?"), stem->dbh, DBH_MOST);
    if (!stump && stem->height <= CEDUO_BREAST_HEIGHT)
        return ceduo_csv_complain(csv, fields[HEIGHT], _("%g m: a stem with a diameter at breast height is higher than %g m"),
                                  stem->height, CEDUO_BREAST_HEIGHT);
    if (stump && !(isnan(stem->height) || (stem->height > 0 && stem->height <= STUMP_MOST)))
        return ceduo_csv_complain(csv, fields[HEIGHT], _("the height of a stump must be above 0 and at most %d m"), STUMP_MOST);
    if (stem->kind != CEDUO_SURVEY_SHOOT && !isnan(stem->spacing))
        return ceduo_csv_complain(csv, fields[SPACING],
                                  _("spacing_m is the distance between the shoots of a stool; leave it empty here"));
    if (!stump && !isnan(stem->energy))
        return ceduo_csv_complain(csv, fields[ENERGY], _("energy_kJ is what a stump takes from a rock; leave it empty here"));
    stem->dbh /= 100;
    stem->energy *= 1000;
    return true;
}

static void read_row(struct reader *r)
{
    struct ceduo_survey_stem stem = {0};
    bool any = false; /* there is a stem */
    for (int c = 0; c < COLUMNS; c++) {
        if (r->columns[c] >= CEDUO_CSV_TWICE || !ceduo_csv_field(&r->csv, r->columns[c], &r->fields[c]))
            r->fields[c] = (struct csv_span){r->csv.line.p + r->csv.line.n, 0};
        any |= c >= SPECIES && r->fields[c].n > 0;
    }
    if (!read_plot(r, &stem.plot) || !any)
        return;
    bool kind = read_kind(r, &stem.kind), species = read_species(r, &stem.species);
    if (!kind || !read_sizes(r, &stem) || !species)
        return;
    if (stem.kind == CEDUO_SURVEY_SHOOT && r->fields[STOOL].n == 0) {
        ceduo_csv_complain(&r->csv, r->fields[STOOL],
                           _("the stool of this shoot is missing; number the stools of a plot (column 'stool')"));
        return;
    }
    if (stem.kind == CEDUO_SURVEY_SHOOT)
        r->stools[r->shoots_count++] = (struct stool){stem.plot, r->stems_count, r->fields[STOOL]};
    r->stems[r->stems_count++] = stem;
}

/* ---- what the rows make ---- */

static int compare_stools(const void *a, const void *b)
{
    const struct stool *one = a, *other = b;
    if (one->plot != other->plot)
        return one->plot < other->plot ? -1 : 1;
    if (one->name.n != other->name.n)
        return one->name.n < other->name.n ? -1 : 1;
    return memcmp(one->name.p, other->name.p, one->name.n);
}

/* Numbers the stools of all plots, and returns how many there are. */
static size_t number_stools(struct reader *r)
{
    size_t n = 0;
    qsort(r->stools, r->shoots_count, sizeof *r->stools, compare_stools);
    for (size_t i = 0; i < r->shoots_count; i++) {
        n += i == 0 || compare_stools(&r->stools[i - 1], &r->stools[i]) != 0;
        r->stems[r->stools[i].stem].stool = n - 1;
    }
    return n;
}

/* Without any height there is nothing to take for those that are missing. */
static void check_heights(struct reader *r, bool shoots)
{
    size_t n = 0, given = 0;
    for (size_t i = 0; i < r->stems_count; i++) {
        const struct ceduo_survey_stem *stem = &r->stems[i];
        bool counts = stem->kind != CEDUO_SURVEY_STUMP && (stem->kind == CEDUO_SURVEY_SHOOT) == shoots;
        n += counts;
        given += counts && !isnan(stem->height);
    }
    if (n > 0 && given == 0)
        ceduo_problem(r->problems, r->csv.source, 0, 0,
                      shoots ? _("no shoot has a height_m; measure some, five or more if you can")
                             : _("no standard and no tree has a height_m; measure some, five or more if you can"));
}

bool ceduo_survey_read(struct survey_file *file, struct arena *arena, const char *path, struct problems *problems)
{
    struct reader r = {.problems = problems};
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length = strlen(name), before = problems->met;
    length -= length > 4 && strcasecmp(name + length - 4, ".csv") == 0 ? 4 : 0;
    name = strcmp(name, "-") == 0 ? "survey" : ceduo_arena_copy(arena, name, length);
    *file = (struct survey_file){.name = name};
    if (!ceduo_csv_open(&r.csv, arena, path, problems))
        return false;
    size_t rows = ceduo_csv_lines(&r.csv);
    rows = rows < STEMS_MOST ? rows : STEMS_MOST;
    r.plots = ceduo_bind_take(arena, PLOTS_MOST, sizeof *r.plots, problems);
    r.stems = ceduo_bind_take(arena, rows, sizeof *r.stems, problems);
    r.stools = ceduo_bind_take(arena, rows, sizeof *r.stools, problems);
    double *areas = ceduo_bind_take(arena, PLOTS_MOST, sizeof *areas, problems);
    if (!r.plots || !r.stems || !r.stools || !areas)
        return false;
    LOCAL_TEXT(unused);
    read_header(&r, &unused);
    file->unused = ceduo_arena_string(arena, ceduo_text_string(&unused));
    if (problems->met > before)
        return false;
    for (size_t n = 0; ceduo_csv_next(&r.csv); n++) {
        if (n == STEMS_MOST)
            return ceduo_problem(problems, r.csv.source, r.csv.number, 1, _("more than %d rows"), STEMS_MOST);
        read_row(&r);
    }
    if (problems->met == before && r.plots_count == 0)
        ceduo_problem(problems, r.csv.source, 0, 0, _("there is no plot: no row under the first"));
    for (size_t i = 0; i < r.plots_count; i++) {
        const double *of = r.plots[i].of, area = isnan(of[AREA]) ? M_PI * of[RADIUS] * of[RADIUS] : of[AREA];
        areas[i] = ceduo_survey_horizontal(area, isnan(of[SLOPE]) ? 0 : of[SLOPE] * M_PI / 180);
        if (isnan(area))
            ceduo_problem(problems, r.csv.source, r.plots[i].line, 1, _("this plot has no area_m2 and no radius_m"));
    }
    if (problems->met == before) {
        check_heights(&r, true);
        check_heights(&r, false);
    }
    problems->memory |= !file->name || !file->unused || ceduo_text_lost();
    file->survey = (struct ceduo_survey){.plots_count = r.plots_count,
                                         .areas = areas,
                                         .stools_count = number_stools(&r),
                                         .stems_count = r.stems_count,
                                         .stems = r.stems};
    return problems->met == before && !problems->memory;
}
