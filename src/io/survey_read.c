/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the rows of a survey. The values of a plot may be in its first row only. A row without a stem is a plot without stems.
 * Another row has one stem, or several of one size. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "base/oom.h"
#include "file.h"
#include "study/naslund.h"
#include "study/plots.h"
#include "survey_reader.h"

#define PLOTS_MAX      1000
#define SLOPE_MAX      76   /* degrees, 400 %: a larger number is a slip (assumed) */
#define SLOPE_BARE_MAX 1e4  /* degrees or percent: a steeper slope is an error in any unit */
#define SLOPE_BARE     45   /* degrees or percent: a steeper slope needs a unit (assumed) */
#define AREA_BARE      10   /* m2: a smaller plot needs a unit (assumed) */
#define STUMP_MAX      20   /* m of height, as in a stand */
#define DBH_MAX        300  /* cm: a larger diameter is in mm (assumed) */
#define SAME_DBH       1.05 /* largest ratio of two equal diameters, one measured, one from the circumference (assumed) */

/* Words for unnamed species; labels of a row of totals or means. */
#define OTHER_SPECIES "other|others|altro|altra|altri|altre|altre latifoglie|altra specie|altre specie|sonstige"
#define TOTALS        "total|totals|totale|totali|tot|sum|somma|mean|average|media|medie|summe|gesamt|mittel|mittelwert"

/* A cell in a message, shortened, for "%.*s". */
#define SHOWN(cell) ((cell).n < 100 ? (int)(cell).n : 100), (cell).p

/* ---- numbers ---- */

/* Read a slope in degrees. `own`: the unit in the cell. */
static bool read_slope(struct survey_reader *r, struct csv_cell cell, enum csv_unit own, double *value)
{
    const enum csv_unit unit = own ? own : r->units[SLOPE];
    bool percent = unit == CSV_UNIT_OTHER;
    double hi = percent ? 100 * tan(SLOPE_MAX * M_PI / 180) : SLOPE_MAX;
    if (!ceduo_csv_number(&r->csv, cell, 0, unit ? hi : SLOPE_BARE_MAX, percent ? "%" : _("degrees"), value))
        return false;
    if (!unit && *value > SLOPE_BARE) {
        r->answers->asked[SURVEY_SLOPES] = true;
        return ceduo_csv_error(
            &r->csv, cell, _("a slope of %g has no unit; name the column 'slope_deg' for degrees, 'slope (%%)' for percent"),
            *value);
    }
    r->marked_slopes |= own != CSV_UNIT_NONE;
    r->bare_slopes |= !unit && *value > 0;
    if (r->marked_slopes && r->bare_slopes)
        return ceduo_csv_error(&r->csv, cell, _("some slopes have a unit and others have none; write it in each cell"));
    *value = percent ? atan(*value / 100) * 180 / M_PI : *value;
    return true;
}

/* Read a number and convert it to the unit of the manual; NaN: not given. The unit may be in the head or in the cell. Report a
 * wrong unit and return false. */
static bool read_number(struct survey_reader *r, enum column c, double *value)
{
    struct csv_cell cell = r->fields[c];
    *value = NAN;
    if (cell.n == 0)
        return true;
    const struct csv_head *head = &ceduo_survey_heads[c];
    const enum csv_unit own = ceduo_csv_split_unit(&cell, head->other_units) ? CSV_UNIT_OTHER
                              : ceduo_csv_split_unit(&cell, head->units)     ? CSV_UNIT_USUAL
                                                                             : CSV_UNIT_NONE;
    if (own && r->units[c] && own != r->units[c])
        return ceduo_csv_error(&r->csv, cell, _("the head of this column gives another unit; write it without a unit"));
    if (c == SLOPE)
        return read_slope(r, cell, own, value);
    bool mm = (own ? own : r->units[c]) == CSV_UNIT_OTHER;
    double scale = mm ? 10 : 1;
    const char *unit = mm ? _("mm") : head->other_units ? _("cm") : _(head->unit);
    if (!ceduo_csv_number(&r->csv, cell, head->lo * scale, head->hi * scale, unit, value))
        return false;
    *value /= scale;
    return true;
}

/* Read a whole number. */
static bool read_count(struct survey_reader *r, enum column c, size_t *count)
{
    double value;
    *count = 0;
    if (!read_number(r, c, &value))
        return false;
    if (!isnan(value) && value != floor(value))
        return ceduo_csv_error(&r->csv, r->fields[c], _("'%s' must be a whole number"), HEAD(c));
    *count = isnan(value) ? 0 : (size_t)value;
    return true;
}

/* Read a diameter. Refuse a class such as 10-15 and suggest its middle. */
static bool read_diameter(struct survey_reader *r, enum column c, double *value)
{
    const struct csv_cell cell = r->fields[c];
    int lo, hi, n = -1;
    char text[CSV_NUMERAL_CAPACITY] = "";
    if (cell.n < sizeof text)
        memcpy(text, cell.p, cell.n);
    if (sscanf(text, "%d - %d%n", &lo, &hi, &n) == 2 && n == (int)cell.n && hi > lo && lo >= 0)
        return ceduo_csv_error(&r->csv, cell, _("'%s' is a class; write its middle, %g"), text, (lo + hi) / 2.0);
    return read_number(r, c, value);
}

/* ---- plots ---- */

static bool are_same_sites(const struct csv_cell *a, const struct csv_cell *b)
{
    for (size_t i = 0; i < SITES; i++)
        if (ceduo_csv_compare(a[i], b[i]) != 0)
            return false;
    return true;
}

/* Return a name as a whole number, which may begin with zeros; NaN: another name. 1.1 and 1.10 are two plots. */
static double read_whole(const struct csv *csv, struct csv_cell name)
{
    double number;
    for (; name.n > 1 && name.p[0] == '0' && name.p[1] >= '0' && name.p[1] <= '9'; name.n--)
        name.p++;
    return ceduo_csv_value(csv, name, &number) && number == floor(number) ? number : NAN;
}

/* Find the plot of a row, or add it. With merged cells, only the first row has the name. */
static bool find_plot(struct survey_reader *r, bool has_stem, size_t *plot)
{
    const bool first = r->plots_count == 0;
    const struct survey_plot *above = first ? NULL : &r->plots[r->plot];
    struct csv_cell *sites = &r->fields[SITE], *name = &r->fields[PLOT];
    for (size_t i = 0; above && i < SITES; i++)
        if (sites[i].n == 0)
            sites[i] = above->sites[i];
    if (name->n == 0 && has_stem && above && are_same_sites(sites, above->sites)) {
        *name = above->name;
        r->filled++;
    }
    if (name->n == 0)
        return ceduo_csv_error(&r->csv, *name, _("'%s' is missing; give it in each row"), HEAD(PLOT));
    size_t i = r->plots_count;
    while (i > 0 && !(ceduo_csv_compare(r->plots[i - 1].name, *name) == 0 && are_same_sites(r->plots[i - 1].sites, sites)))
        i--; /* usually the last plot */
    if (i == 0 && r->plots_count == PLOTS_MAX)
        return ceduo_csv_error(&r->csv, *name, _("more than %d plots"), PLOTS_MAX);
    if (i == 0) {
        r->plots[r->plots_count] =
            (struct survey_plot){.name = *name,
                                 .number = read_whole(&r->csv, *name),
                                 .line = r->csv.place.line,
                                 .values = {[AREA] = NAN, [RADIUS] = NAN, [SLOPE] = NAN, [STOOLS] = NAN}};
        memcpy(r->plots[r->plots_count].sites, sites, SITES * sizeof *sites);
        i = ++r->plots_count;
    } else if (i - 1 != r->plot && r->plots[i - 1].returned == 0) {
        r->plots[i - 1].returned = r->csv.place.line;
    }
    *plot = r->plot = i - 1;
    return true;
}

/* Refuse a small plot unless the head has a unit. */
static bool check_area(struct survey_reader *r, enum column c, double value)
{
    double area = c == RADIUS ? M_PI * value * value : value;
    if ((c != AREA && c != RADIUS) || !(area < AREA_BARE) || r->units[c])
        return true;
    r->answers->asked[SURVEY_AREAS] = true;
    return ceduo_csv_error(&r->csv, r->fields[c], _("a plot of %.3g m2 is very small; if it is right, name the column '%s'"),
                           area, HEAD(c));
}

/* Read the values of a plot. A value must be equal in all rows. */
static bool read_plot(struct survey_reader *r, struct survey_plot *plot)
{
    bool good = true;
    for (enum column c = AREA; c <= STOOLS; c++) {
        double now, *known = &plot->values[c];
        bool read = read_number(r, c, &now) && check_area(r, c, now),
             differs = read && !isnan(now) && !isnan(*known) && now != *known;
        if (differs && (c == AREA || c == RADIUS))
            ceduo_csv_error(&r->csv, r->fields[c],
                            _("'%s' is %g in another row of this plot, here %g; if thin stems were measured on a smaller area, "
                              "make a survey of each area and merge the stands"),
                            HEAD(c), *known, now);
        else if (differs && c == STOOLS)
            ceduo_csv_error(
                &r->csv, r->fields[c],
                _("'%s' is %g in another row of this plot, here %g; if it numbers the stools, name the column '%s'"), HEAD(c),
                *known, now, HEAD(STOOL));
        else if (differs)
            ceduo_csv_error(&r->csv, r->fields[c], _("'%s' is %g in another row of this plot, here %g; correct one"), HEAD(c),
                            *known, now);
        if (read && c == STOOLS && now != floor(now) && !isnan(now))
            read = ceduo_csv_error(&r->csv, r->fields[c], _("'%s' must be a whole number"), HEAD(c));
        good = good && read && !differs;
        *known = read && isnan(*known) ? now : *known;
    }
    const struct csv_cell year = r->fields[YEAR];
    plot->year = plot->year.n == 0 ? year : plot->year;
    if (year.n > 0 && ceduo_csv_compare(year, plot->year) != 0)
        return ceduo_csv_error(&r->csv, year,
                               _("this plot was surveyed in the years %.*s and %.*s; keep the rows of one year, or rename the "
                                 "column if it is not the year of the survey"),
                               plot->year.n < 20 ? (int)plot->year.n : 20, plot->year.p, year.n < 20 ? (int)year.n : 20,
                               year.p);
    if (r->fields[AREA].n > 0 && r->fields[RADIUS].n > 0)
        return ceduo_csv_error(&r->csv, r->fields[RADIUS], _("%s already says this; keep one of the two"), HEAD(AREA));
    return good;
}

/* ---- stems of a row ---- */

/* Read the species of a row; -1: not given. */
static bool read_species(struct survey_reader *r, int *found)
{
    const struct csv_cell species = r->fields[SPECIES], genus = r->fields[GENUS], cell = species.n > 0 ? species : genus;
    *found = ceduo_survey_find_species(species, genus);
    if (*found >= 0 || cell.n == 0 || ceduo_csv_matches(cell.p, cell.n, OTHER_SPECIES))
        return true;
    LOCAL_TEXT(all);
    for (size_t i = 0, n; i < ceduo_species_words.n; i++)
        ceduo_text_format(&all, "%s%s", i > 0 ? ", " : "", _(ceduo_species_list(&n)[i].common));
    return ceduo_csv_error(&r->csv, cell, _("'%.*s' is an unknown species; leave it empty, or one of: %s"), SHOWN(cell),
                           ceduo_text_string(&all));
}

/* Read the number of stems of each kind: of the kind that the row names, or from a column for each kind. */
static bool read_counts(struct survey_reader *r, size_t counts[CEDUO_SURVEY_KINDS_COUNT])
{
    const struct csv_cell kind = r->fields[KIND], count = r->fields[COUNT];
    const bool tally = r->columns[KIND] == CEDUO_CSV_NOT_FOUND;
    size_t sum = 0, given;
    bool good = true;
    int found = ceduo_survey_find_word(&ceduo_survey_kind_words, kind);
    if (!tally && found < 0)
        return ceduo_csv_error(&r->csv, kind, _("'%.*s' is not a kind of stem; write shoot, standard, tree or stump"),
                               SHOWN(kind));
    for (enum column c = SHOOTS; c <= TREES; c++) {
        good = read_count(r, c, &counts[c - SHOOTS]) && good;
        sum += counts[c - SHOOTS];
    }
    if (!good || !read_count(r, COUNT, &given))
        return false;
    for (int k = 0; !tally && k < CEDUO_SURVEY_STUMP; k++)
        if (k != found && counts[k] > 0)
            return ceduo_csv_error(&r->csv, r->fields[SHOOTS + k],
                                   _("this row has another kind of stem; leave '%s' empty here"), HEAD(SHOOTS + k));
    bool own = !tally && found < CEDUO_SURVEY_STUMP && r->fields[SHOOTS + found].n > 0;
    if (count.n > 0 && (tally || own) && given != sum)
        return ceduo_csv_error(&r->csv, count,
                               _("'%s' is %zu, but '%s', '%s' and '%s' add up to %zu; correct one, or leave it empty"),
                               HEAD(COUNT), given, HEAD(SHOOTS), HEAD(STANDARDS), HEAD(TREES), sum);
    if (tally || own)
        return true;
    if (count.n == 0 && r->columns[COUNT] != CEDUO_CSV_NOT_FOUND)
        return ceduo_csv_error(&r->csv, count, _("'%s' is missing; write the number of stems, 0 for none"), HEAD(COUNT));
    counts[found] = r->columns[COUNT] == CEDUO_CSV_NOT_FOUND ? 1 : given;
    return true;
}

/* Remove dead and cut stems from the numbers of a row and count them. Stumps need no status. */
static bool read_status(struct survey_reader *r, size_t counts[CEDUO_SURVEY_KINDS_COUNT])
{
    const struct csv_cell status = r->fields[STATUS];
    size_t sum = counts[CEDUO_SURVEY_SHOOT] + counts[CEDUO_SURVEY_STANDARD] + counts[CEDUO_SURVEY_TREE];
    int found = ceduo_survey_find_word(&ceduo_survey_status_words, status);
    if (r->columns[STATUS] == CEDUO_CSV_NOT_FOUND)
        return true;
    if (status.n > 0 && found < 0)
        return ceduo_csv_error(&r->csv, status, _("'%.*s' is not a status; write live, dead or cut, or rename the column"),
                               SHOWN(status));
    r->unmarked += status.n == 0 ? sum : 0;
    if (found <= SURVEY_LIVE)
        return true;
    *(found == SURVEY_DEAD ? &r->dead : &r->cut) += sum;
    counts[CEDUO_SURVEY_SHOOT] = counts[CEDUO_SURVEY_STANDARD] = counts[CEDUO_SURVEY_TREE] = 0;
    return true;
}

/* Read the diameter of a stem, m, measured or from its circumference. */
static bool read_dbh(struct survey_reader *r, double *dbh)
{
    const struct csv *csv = &r->csv;
    const struct csv_cell *fields = r->fields;
    const enum column c = fields[DBH].n > 0 || r->columns[CIRCUMFERENCE] == CEDUO_CSV_NOT_FOUND ? DBH : CIRCUMFERENCE;
    double girth;
    bool good = read_diameter(r, DBH, dbh);
    if (!read_number(r, CIRCUMFERENCE, &girth) || !good)
        return false;
    double ratio = *dbh / (girth / M_PI); /* NaN: one of them is missing */
    if (ratio > SAME_DBH || ratio < 1 / SAME_DBH)
        return ceduo_csv_error(csv, fields[CIRCUMFERENCE],
                               _("a circumference of %g cm is a diameter of %.3g cm, not %g; leave one empty"), girth,
                               girth / M_PI, *dbh);
    *dbh = isnan(*dbh) ? girth / M_PI : *dbh;
    const enum column missing = r->columns[DBH] == CEDUO_CSV_NOT_FOUND ? CIRCUMFERENCE : DBH;
    if (isnan(*dbh))
        return ceduo_csv_error(csv, fields[missing], _("'%s' is missing; give it in each row"), HEAD(missing));
    if (*dbh > DBH_MAX && r->units[c] == CSV_UNIT_OTHER)
        return ceduo_csv_error(csv, fields[c], _("%g cm is more than %d cm; correct it"), *dbh, DBH_MAX);
    if (*dbh > DBH_MAX)
        return ceduo_csv_error(
            csv, fields[c],
            c == DBH ? _("%g cm is more than %d cm; name the column 'dbh_mm' if it is in mm")
                     : _("a diameter of %g cm is more than %d cm; name the column 'circumference_mm' if it is in mm"),
            *dbh, DBH_MAX);
    *dbh /= 100;
    return true;
}

/* Read the sizes of the stems of a row. */
static bool read_sizes(struct survey_reader *r, struct ceduo_survey_stem *stem)
{
    const struct csv *csv = &r->csv;
    const struct csv_cell *fields = r->fields;
    bool good = read_dbh(r, &stem->dbh), stump = stem->kind == CEDUO_SURVEY_STUMP;
    good = read_number(r, HEIGHT, &stem->height) && good;
    good = read_number(r, SPACING, &stem->spacing) && good;
    good = read_number(r, ENERGY, &stem->energy) && good;
    if (!good)
        return false;
    double lo = stump ? 0 : CEDUO_BREAST_HEIGHT, hi = stump ? STUMP_MAX : ceduo_survey_heads[HEIGHT].hi;
    if (stem->height <= lo || stem->height > hi)
        return ceduo_csv_error(csv, fields[HEIGHT],
                               _("%g m is outside the range of heights here (above %g, at most %g m); leave the cell empty if "
                                 "it was not measured"),
                               stem->height, lo, hi);
    enum column extra = stem->kind != CEDUO_SURVEY_SHOOT && !isnan(stem->spacing) ? SPACING
                        : !stump && !isnan(stem->energy)                          ? ENERGY
                                                                                  : PLOT;
    if (extra != PLOT)
        return ceduo_csv_error(csv, fields[extra], _("a stem of this kind has no '%s'; leave it empty here"), HEAD(extra));
    if (!isnan(stem->spacing) && fields[STOOL].n == 0)
        return ceduo_csv_error(csv, fields[SPACING], _("a shoot without a stool has no '%s'; leave it empty here"),
                               HEAD(SPACING));
    stem->energy *= 1000;
    return true;
}

/* ---- rows ---- */

/* Add n equal stems. */
static bool add_stems(struct survey_reader *r, struct ceduo_survey_stem stem, size_t n)
{
    bool shoot = stem.kind == CEDUO_SURVEY_SHOOT, loose = shoot && r->fields[STOOL].n == 0;
    struct survey_plot *plot = &r->plots[stem.plot];
    if (r->stems_count + n > STEMS_MAX)
        return ceduo_csv_error(&r->csv, r->fields[COUNT], _("more than %d stems"), STEMS_MAX);
    struct ceduo_survey_stem *stems =
        ceduo_arena_grow(r->arena, r->stems, r->stems_count, n, &r->stems_capacity, sizeof *stems);
    struct survey_shoot *shoots =
        ceduo_arena_grow(r->arena, r->shoots, r->shoots_count, shoot ? n : 0, &r->shoots_capacity, sizeof *shoots);
    r->stems = stems ? stems : r->stems;
    r->shoots = shoots ? shoots : r->shoots;
    if (!stems || (shoot && !shoots))
        return false;
    if (loose && !plot->has_loose) {
        plot->has_loose = true;
        plot->loose = r->csv.place;
    }
    for (size_t i = 0; i < n; i++) {
        if (shoot)
            r->shoots[r->shoots_count++] = (struct survey_shoot){stem.plot, r->stems_count, r->fields[STOOL]};
        r->stems[r->stems_count++] = stem;
    }
    return true;
}

static void add_id(struct survey_reader *r, const struct ceduo_survey_stem *stem)
{
    struct survey_id *ids = ceduo_arena_grow(r->arena, r->ids, r->ids_count, 1, &r->ids_capacity, sizeof *ids);
    if (!ids || r->fields[ID].n == 0)
        return;
    r->ids = ids;
    r->ids[r->ids_count++] =
        (struct survey_id){stem->plot, r->csv.place.line, (int)stem->kind, r->fields[STOOL], r->fields[ID]};
}

/* Read the cells of a row. Return false if a name has a quote or a line break, which is an error. */
static bool read_fields(struct survey_reader *r)
{
    bool good = true;
    for (int c = 0; c < COLUMNS; c++) {
        struct csv_cell *cell = &r->fields[c];
        *cell = ceduo_csv_next_cell(&r->csv, r->columns[c]);
        if (ceduo_csv_is_empty(*cell))
            cell->n = 0;
        bool name = c == PLOT || c == SPECIES || c == GENUS || c == KIND || c == STOOL || c == STATUS || c >= SITE;
        if (name && memchr(cell->p, '"', cell->n))
            good = ceduo_csv_error(&r->csv, *cell, _("a stray quote in this cell; remove it"));
        else if (name && memchr(cell->p, '\n', cell->n))
            good = ceduo_csv_error(&r->csv, *cell, _("a line break in a name; remove it and the quotes around it"));
    }
    return good;
}

static bool is_total(struct csv_cell cell)
{
    return cell.n > 0 && ceduo_csv_matches(cell.p, cell.n, TOTALS);
}

/* True if a row holds totals: its first word, or its kind, species, stool or size is a label of totals. */
static bool is_total_row(const struct survey_reader *r)
{
    static const enum column columns[] = {KIND, SPECIES, STOOL, DBH, CIRCUMFERENCE};
    const bool sized = r->fields[DBH].n > 0 || r->fields[CIRCUMFERENCE].n > 0;
    size_t column = 0;
    while (column + 1 < r->csv.cells_count && ceduo_csv_next_cell(&r->csv, column).n == 0)
        column++;
    struct csv_cell first = ceduo_csv_next_cell(&r->csv, column), word = first; /* "Totale fusti" */
    for (size_t n = first.n; n > 0; n--)
        word.n = strchr(" :", first.p[n - 1]) ? n - 1 : word.n;
    bool begins = r->columns[KIND] == CEDUO_CSV_NOT_FOUND ? !sized : r->fields[KIND].n == 0;
    if (column != r->columns[STATUS] && (is_total(first) || (begins && is_total(word))))
        return true;
    for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
        if (is_total(r->fields[columns[i]]))
            return true;
    return false;
}

static bool has_stem(const struct survey_reader *r)
{
    for (int c = SPECIES; c <= TREES; c++)
        if (r->fields[c].n > 0 && !(c >= COUNT && ceduo_csv_equals(r->fields[c], "0")))
            return true;
    return false;
}

/* Read a row. Return false to stop reading. */
static bool read_row(struct survey_reader *r)
{
    struct ceduo_survey_stem stem = {0};
    size_t counts[CEDUO_SURVEY_KINDS_COUNT] = {0};
    if (!read_fields(r))
        return true;
    if (is_total_row(r)) {
        r->totals++;
        return true;
    }
    bool any = has_stem(r);
    if (!find_plot(r, any, &stem.plot) || !read_plot(r, &r->plots[stem.plot]) || !any)
        return true;
    bool good = read_species(r, &stem.species);
    if (!read_counts(r, counts) || !read_status(r, counts) || !good)
        return true;
    for (int k = 0; k < CEDUO_SURVEY_KINDS_COUNT; k++) {
        stem.kind = (enum ceduo_survey_kind)k;
        if (counts[k] == 0)
            continue;
        if (!read_sizes(r, &stem))
            return true;
        if (!add_stems(r, stem, counts[k]))
            return false;
        add_id(r, &stem);
    }
    return true;
}

/* Refuse a column 'n' or 'numero' that numbers the rows instead of counting stems. */
static bool check_numbering(struct survey_reader *r)
{
    struct csv_place begin = r->csv.next;
    size_t rises = 0, rows = 0;
    bool numbering = true;
    double value, last = 0;
    if (r->columns[COUNT] >= CEDUO_CSV_DUPLICATE || !ceduo_survey_is_vague(&r->csv, r->columns[COUNT]))
        return true;
    r->csv.problems = NULL;
    while (numbering && ceduo_csv_next_row(&r->csv)) {
        struct csv_cell cell = ceduo_csv_next_cell(&r->csv, r->columns[COUNT]);
        if (!ceduo_csv_value(&r->csv, cell, &value))
            continue;
        numbering = rows++ == 0 || value == last + 1 || value == 1;
        rises += rows > 1 && value == last + 1;
        last = value;
    }
    r->csv.problems = r->problems;
    r->csv.next = begin;
    return !numbering || rises < 2 ||
           /* untaken: complaint */
           ceduo_csv_error(&r->csv, r->csv.heads[r->columns[COUNT]],
                           _("this column goes 1, 2, 3; name it 'id' if it numbers the stems, 'count' if it counts them"));
}

/* ---- stools and areas ---- */

static int compare_counts(size_t a, size_t b)
{
    return (a > b) - (a < b);
}

static int compare_shoots(const void *a, const void *b)
{
    const struct survey_shoot *x = a, *y = b;
    int plots = compare_counts(x->plot, y->plot);
    return plots != 0 ? plots : ceduo_csv_compare(x->stool, y->stool);
}

static int compare_ids(const void *a, const void *b)
{
    const struct survey_id *x = a, *y = b;
    int order = compare_counts(x->plot, y->plot);
    order = order != 0 ? order : x->kind - y->kind;
    order = order != 0 ? order : ceduo_csv_compare(x->stool, y->stool);
    return order != 0 ? order : ceduo_csv_compare(x->id, y->id);
}

static int compare_ids_and_lines(const void *a, const void *b)
{
    const struct survey_id *x = a, *y = b;
    int order = compare_ids(x, y);
    return order != 0 ? order : compare_counts(x->line, y->line);
}

static void count_repeated(struct survey_reader *r)
{
    if (r->ids_count > 0)
        qsort(r->ids, r->ids_count, sizeof *r->ids, compare_ids_and_lines);
    for (size_t i = 1; i < r->ids_count; i++) {
        if (compare_ids(&r->ids[i - 1], &r->ids[i]) != 0)
            continue;
        size_t line = r->ids[i].line;
        r->repeated_line = r->repeated++ == 0 || line < r->repeated_line ? line : r->repeated_line;
    }
}

/* Report an error at the first shoot without a stool. Return false. */
static bool refuse_loose(struct survey_reader *r, const struct survey_plot *plot, const char *message)
{
    ceduo_csv_reread(&r->csv, plot->loose);
    return ceduo_csv_error(&r->csv, ceduo_csv_next_cell(&r->csv, r->columns[STOOL]), "%s", message);
}

/* Number the stools of a plot. Its n shoots are sorted by stool. Shoots without a stool are distributed evenly over the given
 * number of stools. */
static bool number_stools(struct survey_reader *r, const struct survey_plot *plot, const struct survey_shoot *shoots, size_t n)
{
    const double given = plot->values[STOOLS];
    size_t begin = r->stools_count, loose = 0;
    while (loose < n && shoots[loose].stool.n == 0)
        loose++;
    if (loose > 0 && isnan(given))
        return refuse_loose(
            r, plot,
            _("the stool of this shoot is missing; number the stools (column 'stool'), or give the number of stools "
              "of the plot (column 'stools')"));
    if (loose > 0 && loose < n)
        return refuse_loose(r, plot, _("the stool of this shoot is missing, but other shoots of the plot have one; add it"));
    if (given > (double)n || (loose > 0 && given == 0))
        return ceduo_problem(r->problems, r->csv.source, plot->line, 1,
                             _("%g stools do not match %zu live shoots; count the stools with live shoots"), given, n);
    if (loose > 0) {
        for (size_t i = 0; i < n; i++)
            r->stems[shoots[i].stem].stool = begin + i % (size_t)given;
        r->stools_count += (size_t)given;
        return true;
    }
    for (size_t i = 0; i < n; i++) {
        r->stools_count += i == 0 || compare_shoots(&shoots[i - 1], &shoots[i]) != 0;
        r->stems[shoots[i].stem].stool = r->stools_count - 1;
    }
    if (!isnan(given) && given != (double)(r->stools_count - begin))
        return ceduo_problem(r->problems, r->csv.source, plot->line, 1,
                             _("'%s' is %g, but the shoots of this plot have %zu stools; correct it, or remove the column"),
                             HEAD(STOOLS), given, r->stools_count - begin);
    return true;
}

/* Number the stools over all plots. */
static void number_all_stools(struct survey_reader *r)
{
    if (r->shoots_count > 0)
        qsort(r->shoots, r->shoots_count, sizeof *r->shoots, compare_shoots);
    for (size_t p = 0, begin = 0, end; p < r->plots_count; p++, begin = end) {
        for (end = begin; end < r->shoots_count && r->shoots[end].plot == p;)
            end++;
        number_stools(r, &r->plots[p], end > begin ? r->shoots + begin : NULL, end - begin);
    }
}

double ceduo_survey_area(const struct survey_plot *plot)
{
    const double area = plot->values[AREA], radius = plot->values[RADIUS];
    return isnan(area) ? M_PI * radius * radius : area;
}

/* Compute the areas of the plots on the map. Either all plots have a slope, or none. */
static void measure_plots(struct survey_reader *r, double *areas)
{
    bool any = false;
    for (size_t i = 0; i < r->plots_count; i++)
        any |= !isnan(r->plots[i].values[SLOPE]);
    for (size_t i = 0; i < r->plots_count; i++) {
        const double area = ceduo_survey_area(&r->plots[i]), slope = r->plots[i].values[SLOPE];
        areas[i] = ceduo_survey_horizontal(area, any ? slope * M_PI / 180 : 0);
        if (any && isnan(slope))
            ceduo_problem(r->problems, r->csv.source, r->plots[i].line, 1,
                          _("this plot has no slope, others have one; write it, 0 if the area is that of the map"));
        if (isnan(area))
            ceduo_problem(r->problems, r->csv.source, r->plots[i].line, 1,
                          _("this plot has no area_m2 and no radius_m; give one, or remove the row if it is not a plot"));
    }
}

/* ---- reading ---- */

static void scan_numbers(struct survey_reader *r)
{
    for (int c = 0; c < COLUMNS; c++)
        if ((c >= AREA && c <= STOOLS) || (c >= DBH && c <= TREES))
            ceduo_csv_mark_numeric(&r->csv, r->columns[c]);
    ceduo_csv_scan(&r->csv);
}

static void read_rows(struct survey_reader *r)
{
    for (size_t n = 0; ceduo_csv_next_row(&r->csv); n++) {
        if (n == STEMS_MAX) {
            ceduo_problem(r->problems, r->csv.source, r->csv.place.line, 1, _("more than %d rows"), STEMS_MAX);
            return;
        }
        if (!r->csv.bad && !read_row(r))
            return;
    }
    if (r->plots_count == 0)
        ceduo_problem(r->problems, r->csv.source, 0, 0, _("the table has no row"));
}

/* Set the units, or ignore the heights, as the user answered. */
static void apply_answers(struct survey_reader *r)
{
    const int *given = r->answers->given;
    memset(r->answers->asked, 0, sizeof r->answers->asked);
    if (given[SURVEY_SLOPES])
        r->units[SLOPE] = (enum csv_unit)given[SURVEY_SLOPES];
    if (given[SURVEY_DIAMETERS])
        r->units[DBH] = r->units[CIRCUMFERENCE] = (enum csv_unit)given[SURVEY_DIAMETERS];
    if (given[SURVEY_AREAS])
        r->units[AREA] = r->units[RADIUS] = CSV_UNIT_USUAL;
    if (given[SURVEY_HEIGHTS] == 2)
        r->columns[HEIGHT] = CEDUO_CSV_NOT_FOUND;
}

bool ceduo_survey_read(struct survey_file *file, struct arena *arena, const char *path, struct survey_answers *answers,
                       struct problems *problems)
{
    struct survey_answers none = {0};
    ceduo_memory_failed(); /* clear a stale flag */
    struct survey_reader *r = ceduo_arena_alloc(arena, sizeof *r);
    const char *name = ceduo_file_name(path);
    const bool standard = strcmp(name, "-") == 0;
    size_t length = strlen(name), before = problems->met;
    length -= length > 4 && strcasecmp(name + length - 4, ".csv") == 0 ? 4 : 0;
    *file = (struct survey_file){.name = standard ? "survey" : ceduo_arena_copy(arena, name, length)};
    if (!r)
        return false;
    *r = (struct survey_reader){.arena = arena, .problems = problems, .answers = answers ? answers : &none};
    if (!ceduo_csv_open(&r->csv, arena, path, problems))
        return false;
    r->plots = ceduo_arena_alloc(arena, PLOTS_MAX * sizeof *r->plots);
    double *areas = ceduo_arena_alloc(arena, PLOTS_MAX * sizeof *areas);
    if (!r->plots || !areas || !ceduo_survey_find_columns(&r->csv, r->columns, r->units))
        return false;
    apply_answers(r);
    scan_numbers(r);
    if (!check_numbering(r))
        return false;
    read_rows(r);
    if (problems->met > before)
        return false;
    number_all_stools(r);
    measure_plots(r, areas);
    count_repeated(r);
    file->survey = (struct ceduo_survey){.plots_count = r->plots_count,
                                         .areas = areas,
                                         .stools_count = r->stools_count,
                                         .stems_count = r->stems_count,
                                         .stems = r->stems};
    if (problems->met > before || !ceduo_survey_check(r, &file->survey))
        return false;
    file->understood = ceduo_survey_describe(r, &file->survey, standard ? file->name : name);
    return ceduo_problems_check_memory(problems);
}

void ceduo_survey_print_template(struct text *sheet)
{
    ceduo_text_append(sheet, _("plot,area_m2,slope_deg,species,kind,stool,dbh_cm,height_m,spacing_m\n"
                               "1,200,30,hop hornbeam,shoot,1,6.5,7.2,0.35\n"
                               "1,,,Turkey oak,standard,,24,13.5,\n"));
}
