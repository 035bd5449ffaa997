/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the rows of a survey. What belongs to a plot may stand in its first row alone; a row of a plot without a stem
 * says that there is none. */
#include "survey_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "base/must.h"
#include "csv.h"
#include "scene/choices.h"

#define PLOTS_MOST 1000
#define STEMS_MOST 200000
#define SLOPE_MOST 85  /* degrees */
#define STUMP_MOST 20  /* m of height, as in a stand */
#define DBH_MOST   300 /* cm: beyond it a diameter is in mm rather than of such a tree (assumed) */

enum column { PLOT, AREA, RADIUS, SLOPE, SPECIES, KIND, STOOL, DBH, HEIGHT, SPACING, ENERGY, COLUMNS };

/* Names of a column, the first one is that of the manual and of messages; in other languages as their spreadsheets have them. */
static const struct csv_head heads[COLUMNS] = {
    [PLOT] = {{N_("plot"), "saggio", "area di saggio", "n saggio", "ads", "probefläche"}, NULL},
    [AREA] = {{N_("area_m2"), "area", "superficie", "sup", "fläche"}, "m2|m²|mq"},
    [RADIUS] = {{N_("radius_m"), "radius", "raggio", "r"}, "m"},
    [SLOPE] = {{N_("slope_deg"), "slope", "pendenza", "pend", "neigung"}, "deg|degrees|°|gradi|grad"},
    [SPECIES] = {{N_("species"), "specie", "baumart"}, NULL},
    [KIND] = {{N_("kind"), "tipo", "tipo fusto", "origine", "p/m", "typ"}, NULL},
    [STOOL] = {{N_("stool"), "ceppaia", "n ceppaia", "ceppaia n", "stock"}, NULL},
    [DBH] = {{N_("dbh_cm"), "dbh", "diametro", "diam", "d", "d130", "diametro a 1,30 m", "diametro a 1,30", "bhd"}, "cm"},
    [HEIGHT] = {{N_("height_m"), "height", "altezza", "alt", "h", "höhe"}, "m"},
    [SPACING] = {{N_("spacing_m"), "spacing", "distanza", "abstand"}, "m"},
    [ENERGY] = {{N_("energy_kJ"), "energy", "energia", "energie"}, "kJ"},
};

#define PERCENT "%|percent|percento|perc" /* of a slope */

static const struct {
    double lo, hi;
    const char *unit;
} ranges[COLUMNS] = {[AREA] = {1, 1e6, "m2"},  [RADIUS] = {0.5, 500, "m"}, [SLOPE] = {0, SLOPE_MOST, N_("degrees")},
                     [DBH] = {0.1, 1e6, "cm"}, [HEIGHT] = {0, 150, "m"},   [SPACING] = {0.01, 20, "m"},
                     [ENERGY] = {0, 1e6, "kJ"}};

/* Words of a kind of stem, the first one is that of the manual. */
#define X(NAME, word) word,
static const char *const kind_names[] = {CEDUO_SURVEY_KINDS(X)};
#undef X
static const char *const kinds_also[] = {"shoot|shoots|pollone|polloni|p", "standard|standards|matricina|matricine|m",
                                         "tree|trees|albero|alberi|allievo|allievi", "stump|stumps|ceppo|ceppi"};
static const struct choices kind_words = {kind_names, CEDUO_SURVEY_KINDS_COUNT, kinds_also};

/* Species of which nothing more is said, and rows that are no stems. */
static const char *const others[] = {"other|others|altro|altra|altri|altre|altre latifoglie|altra specie"};
static const char *const totals[] = {"total|totals|totale|totali|sum|somma|mean|average|media|medie"};
static const struct choices other_words = {others, 1, others}, total_words = {totals, 1, totals};

struct plot {
    struct csv_cell name;
    size_t line;          /* where it comes first */
    double of[SLOPE + 1]; /* AREA, RADIUS, SLOPE; NaN: not said */
};

/* The stool of a shoot by its name, before stools are numbered. */
struct stool {
    size_t plot, stem;
    struct csv_cell name;
};

struct reader {
    struct csv csv;
    struct problems *problems;
    size_t columns[COLUMNS];
    bool percent;                    /* slopes */
    struct csv_cell fields[COLUMNS]; /* of the present row */
    struct plot *plots;
    size_t plots_count, plot; /* the present one */
    struct ceduo_survey_stem *stems;
    size_t stems_count, shoots_count;
    struct stool *stools; /* of each shoot */
};

/* ---- header ---- */

static void read_header(struct reader *r, struct text *unused)
{
    ceduo_csv_find(&r->csv, heads, COLUMNS, r->columns);
    const size_t line = r->csv.head_place.line;
    if (r->columns[SLOPE] == CEDUO_CSV_NONE) {
        r->columns[SLOPE] = ceduo_csv_column(&r->csv, heads[SLOPE].names, PERCENT);
        r->percent = r->columns[SLOPE] < CEDUO_CSV_TWICE;
    }
    ceduo_csv_unused(&r->csv, r->columns, COLUMNS, unused);
    for (int c = 0; c < COLUMNS; c++)
        if ((c == PLOT || c == KIND || c == DBH) && r->columns[c] == CEDUO_CSV_NONE)
            ceduo_problem_at(r->problems, (struct problem_place){r->csv.source, line, 1, NULL, true},
                             _("the first line must name the column '%s'"), _(heads[c].names[0]));
    if (r->columns[AREA] == CEDUO_CSV_NONE && r->columns[RADIUS] == CEDUO_CSV_NONE)
        ceduo_problem(r->problems, r->csv.source, line, 1, _("the first line must name the column 'area_m2' or 'radius_m'"));
}

/* ---- rows ---- */

/* A number that may be left empty: NaN then. False if it is wrong, which is reported. */
static bool read_number(struct reader *r, enum column c, double *value)
{
    bool percent = c == SLOPE && r->percent;
    double hi = percent ? 100 * tan(SLOPE_MOST * M_PI / 180) : ranges[c].hi;
    *value = NAN;
    if (r->fields[c].n > 0 &&
        !ceduo_csv_number(&r->csv, r->fields[c], ranges[c].lo, hi, percent ? "%" : _(ranges[c].unit), value))
        return false;
    *value = percent ? atan(*value / 100) * 180 / M_PI : *value;
    return true;
}

static bool read_plot(struct reader *r, size_t *plot)
{
    struct csv_cell name = r->fields[PLOT];
    size_t i = r->plots_count;
    bool good = true;
    if (name.n == 0)
        return ceduo_csv_complain(&r->csv, name, _("'%s' is missing: give it in each row"), _(heads[PLOT].names[0]));
    while (i > 0 && !(r->plots[i - 1].name.n == name.n && memcmp(r->plots[i - 1].name.p, name.p, name.n) == 0))
        i--; /* mostly the last */
    if (i == 0 && r->plots_count == PLOTS_MOST)
        return ceduo_csv_complain(&r->csv, name, _("more than %d plots"), PLOTS_MOST);
    if (i == 0) {
        r->plots[r->plots_count] = (struct plot){name, r->csv.place.line, {NAN, NAN, NAN, NAN}};
        i = ++r->plots_count;
    }
    *plot = i - 1;
    for (enum column c = AREA; c <= SLOPE; c++) { /* what is said of a plot again must be the same */
        double now, *known = &r->plots[*plot].of[c];
        bool read = read_number(r, c, &now), differs = !isnan(now) && !isnan(*known) && now != *known;
        if (read && differs)
            ceduo_csv_complain(&r->csv, r->fields[c], _("'%s' is %g elsewhere for this plot, here %g"), _(heads[c].names[0]),
                               *known, now);
        good = good && read && !differs;
        *known = read && isnan(*known) ? now : *known;
    }
    if (r->fields[AREA].n > 0 && r->fields[RADIUS].n > 0)
        return ceduo_csv_complain(&r->csv, r->fields[RADIUS], _("%s already says this; keep one of the two"),
                                  _(heads[AREA].names[0]));
    return good;
}

/* The value that a cell's word stands for; -1: it is none. */
static int find_word(const struct choices *words, struct csv_cell field)
{
    char word[64] = "";
    if (field.n < sizeof word)
        memcpy(word, field.p, field.n);
    return ceduo_choice_find(words, word);
}

static bool read_words(struct reader *r, struct ceduo_survey_stem *stem)
{
    const struct csv_cell kind = r->fields[KIND], species = r->fields[SPECIES];
    int found = find_word(&kind_words, kind);
    bool known = found >= 0;
    stem->kind = known ? (enum ceduo_survey_kind)found : CEDUO_SURVEY_TREE;
    stem->species = find_word(&ceduo_species_words, species);
    if (!known)
        ceduo_csv_complain(&r->csv, kind, _("'%.*s' is no kind of stem: shoot, standard, tree or stump"),
                           kind.n < 100 ? (int)kind.n : 100, kind.p);
    if (stem->species >= 0 || species.n == 0 || find_word(&other_words, species) >= 0)
        return known;
    LOCAL_TEXT(all);
    for (size_t i = 0, n; i < ceduo_species_words.n; i++)
        ceduo_text_format(&all, "%s%s", i > 0 ? ", " : "", _(ceduo_species_list(&n)[i].common));
    return ceduo_csv_complain(&r->csv, species, _("'%.*s' is an unknown species; leave it empty, or one of: %s"),
                              species.n < 100 ? (int)species.n : 100, species.p, ceduo_text_string(&all));
}

/* The sizes of a stem. */
static bool read_sizes(struct reader *r, struct ceduo_survey_stem *stem)
{
    const struct csv *csv = &r->csv;
    const struct csv_cell *fields = r->fields;
    bool good = read_number(r, DBH, &stem->dbh), stump = stem->kind == CEDUO_SURVEY_STUMP;
    good = read_number(r, HEIGHT, &stem->height) && good;
    good = read_number(r, SPACING, &stem->spacing) && good;
    good = read_number(r, ENERGY, &stem->energy) && good;
    if (!good)
        return false;
    if (isnan(stem->dbh))
        return ceduo_csv_complain(csv, fields[DBH], _("'%s' is missing: give it in each row"), _(heads[DBH].names[0]));
    if (stem->dbh > DBH_MOST)
        return ceduo_csv_complain(csv, fields[DBH], _("%g cm: more than %d cm; is it in mm?"), stem->dbh, DBH_MOST);
    double lo = stump ? 0 : CEDUO_BREAST_HEIGHT, hi = stump ? STUMP_MOST : ranges[HEIGHT].hi;
    if (stem->height <= lo || stem->height > hi)
        return ceduo_csv_complain(csv, fields[HEIGHT],
                                  _("%g m is no height of a stem of this kind: it must be above %g and at most %g m"),
                                  stem->height, lo, hi);
    enum column other = stem->kind != CEDUO_SURVEY_SHOOT && !isnan(stem->spacing) ? SPACING
                        : !stump && !isnan(stem->energy)                          ? ENERGY
                                                                                  : PLOT;
    if (other != PLOT)
        return ceduo_csv_complain(csv, fields[other], _("a stem of this kind has no '%s'; leave it empty here"),
                                  _(heads[other].names[0]));
    stem->dbh /= 100;
    stem->energy *= 1000;
    return true;
}

static void read_row(struct reader *r, struct survey_file *file)
{
    struct ceduo_survey_stem stem = {0};
    struct csv_cell first = ceduo_csv_cell(&r->csv, 0);
    bool any = false; /* there is a stem */
    for (size_t i = 1; first.n == 0 && i < r->csv.cells_count; i++)
        first = ceduo_csv_cell(&r->csv, i);
    for (int c = 0; c < COLUMNS; c++) {
        r->fields[c] = ceduo_csv_cell(&r->csv, r->columns[c]);
        if (ceduo_csv_is_empty(r->fields[c]))
            r->fields[c].n = 0;
        any |= c >= SPECIES && r->fields[c].n > 0;
    }
    struct csv_cell word = first; /* "Totale fusti" */
    for (size_t n = first.n; n > 0; n--)
        word.n = strchr(" :", first.p[n - 1]) ? n - 1 : word.n;
    if (find_word(&total_words, first) >= 0 || (r->fields[KIND].n == 0 && find_word(&total_words, word) >= 0)) {
        file->totals++;
        return;
    }
    if (r->fields[PLOT].n == 0 && any && r->plots_count > 0) { /* cells that were joined: it stands in the first alone */
        r->fields[PLOT] = r->plots[r->plot].name;
        file->filled++;
    }
    if (!read_plot(r, &stem.plot))
        return;
    r->plot = stem.plot;
    if (!any || !read_words(r, &stem) || !read_sizes(r, &stem))
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

bool ceduo_survey_read(struct survey_file *file, struct arena *arena, const char *path, struct problems *problems)
{
    struct reader r = {.problems = problems};
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length = strlen(name), before = problems->met;
    ceduo_memory_lost(); /* what was lost before is of others */
    length -= length > 4 && strcasecmp(name + length - 4, ".csv") == 0 ? 4 : 0;
    name = strcmp(name, "-") == 0 ? "survey" : ceduo_arena_copy(arena, name, length);
    *file = (struct survey_file){.name = name};
    if (!ceduo_csv_open(&r.csv, arena, path, problems))
        return false;
    size_t rows = ceduo_csv_lines(&r.csv);
    rows = rows < STEMS_MOST ? rows : STEMS_MOST;
    r.plots = ceduo_arena_take(arena, PLOTS_MOST * sizeof *r.plots);
    r.stems = ceduo_arena_take(arena, rows * sizeof *r.stems);
    r.stools = ceduo_arena_take(arena, rows * sizeof *r.stools);
    double *areas = ceduo_arena_take(arena, PLOTS_MOST * sizeof *areas);
    if (!r.plots || !r.stems || !r.stools || !areas)
        return false;
    LOCAL_TEXT(unused);
    read_header(&r, &unused);
    file->unused = ceduo_arena_string(arena, ceduo_text_string(&unused));
    if (problems->met > before)
        return false;
    bool *numeric = ceduo_arena_take(arena, (r.csv.heads_count + 1) * sizeof *numeric);
    for (int c = 0; numeric && c < COLUMNS; c++)
        if (r.columns[c] < CEDUO_CSV_TWICE && c != PLOT && c != SPECIES && c != KIND && c != STOOL)
            numeric[r.columns[c]] = true;
    ceduo_csv_scan(&r.csv, numeric);
    for (size_t n = 0; ceduo_csv_next(&r.csv); n++) {
        if (r.csv.bad)
            continue;
        if (n == STEMS_MOST)
            return ceduo_problem(problems, r.csv.source, r.csv.place.line, 1, _("more than %d rows"), STEMS_MOST);
        read_row(&r, file);
    }
    if (problems->met == before && r.plots_count == 0)
        ceduo_problem(problems, r.csv.source, 0, 0, _("there is no plot: no row under the first"));
    for (size_t i = 0; i < r.plots_count; i++) {
        const double *of = r.plots[i].of, area = isnan(of[AREA]) ? M_PI * of[RADIUS] * of[RADIUS] : of[AREA];
        areas[i] = ceduo_survey_horizontal(area, isnan(of[SLOPE]) ? 0 : of[SLOPE] * M_PI / 180);
        if (isnan(area))
            ceduo_problem(problems, r.csv.source, r.plots[i].line, 1, _("this plot has no area_m2 and no radius_m"));
    }
    size_t stools = 0; /* are numbered over all plots */
    qsort(r.stools, r.shoots_count, sizeof *r.stools, compare_stools);
    for (size_t i = 0; i < r.shoots_count; i++) {
        stools += i == 0 || compare_stools(&r.stools[i - 1], &r.stools[i]) != 0;
        r.stems[r.stools[i].stem].stool = stools - 1;
    }
    file->survey = (struct ceduo_survey){
        .plots_count = r.plots_count, .areas = areas, .stools_count = stools, .stems_count = r.stems_count, .stems = r.stems};
    return problems->met == before && ceduo_problems_settle(problems);
}

void ceduo_survey_template(struct text *sheet)
{
    ceduo_text_put(sheet, _("plot,area_m2,slope_deg,species,kind,stool,dbh_cm,height_m,spacing_m\n"
                            "1,200,30,hop hornbeam,shoot,1,6.5,7.2,0.35\n"
                            "1,,,Turkey oak,standard,,24,13.5,\n"));
}
