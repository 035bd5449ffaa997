/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Columns of a survey and the words of its cells. */

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "base/utf8.h"
#include "survey_reader.h"

#define FOLDED_MAX 128 /* bytes of a head that are compared */
#define WORD_MAX   64  /* bytes of a cell that are compared */

#define AREA_UNITS "m2|m²|mq|qm|m q|metri quadrati"
#define DEGREES    "deg|degrees|°|gradi|gradi sessagesimali|grad"
#define PERCENT    "%|percent|percento|perc|percentuale|prozent|proz"

/* Units that no column accepts at the end of its head. */
#define FOREIGN_UNITS "mm|cm|dm|m|km|in|inch|inches|ft|feet|ha|ar|are|acre|acres|J|MJ|gon|zoll"

/* Ambiguous heads. */
#define VAGUE "h|d|n|nr|num|numero|alt|r"

const struct csv_head ceduo_survey_heads[COLUMNS] = {
    [PLOT] = {N_("plot"),
              .also =
                  "saggio|n saggio|num saggio|numero saggio|area di saggio|n area di saggio|numero area di saggio|ads|n ads|"
                  "id saggio|plot id|plot no|plot number|id plot|probefläche|probekreis|parzelle"},
    [AREA] = {N_("area_m2"),
              "plot area|area saggio|area del saggio|area ads|superficie saggio|superficie del saggio|superficie ads|"
              "sup saggio|probeflächengröße|area|superficie|sup|fläche",
              AREA_UNITS, .unit = N_("m2"), .lo = 1, .hi = 1e6},
    [RADIUS] = {N_("radius_m"), "radius|plot radius|raggio|raggio saggio|r", "m", .unit = N_("m"), .lo = 0.5, .hi = 500},
    [SLOPE] = {N_("slope_deg"), "slope|pendenza|pend|pendenza media|inclinazione|neigung|hangneigung", DEGREES "|" PERCENT,
               .other_units = PERCENT, .unit = N_("degrees or %")},
    [STOOLS] = {N_("stools"),
                "ceppaie|n ceppaie|num ceppaie|numero ceppaie|n di ceppaie|stool count|number of stools|no of stools|"
                "anzahl stöcke|stöcke",
                .unit = N_("stools"), .hi = STEMS_MAX},
    [SPECIES] = {N_("species"), .also = "specie|essenza|spp|baumart|holzart"},
    [GENUS] = {N_("genus"), .also = "genere|gattung"},
    [KIND] = {N_("kind"), .also = "stem type|tipo fusto|tipo di fusto|tipo|origine|p/m|typ"},
    [STOOL] =
        {N_("stool"),
         .also =
             "ceppaia|n ceppaia|num ceppaia|numero ceppaia|ceppaia n|id ceppaia|stool id|stool no|stool number|stock|stock nr"},
    [DBH] = {N_("dbh_cm"),
             "dbh|dap|diametro|diam|diametro a 1,30 m|diametro a 1,30|diam a 1,30|diam a 1,30 m|diam 1,30|d130|"
             "diametro medio|diam medio|d medio|classe diam|classe diametrica|classe di diametro|diameter|mean dbh|"
             "mean diameter|dbh class|diameter class|bhd|brusthöhendurchmesser|mitteldurchmesser|durchmesser|Ø|⌀|d",
             "cm|mm", .other_units = "mm", .unit = N_("cm or mm"), .lo = 0.1, .hi = 3000},
    [CIRCUMFERENCE] = {N_("circumference_cm"),
                       "circumference|circonferenza|circonferenza a 1,30|circonferenza a 1,30 m|circ|circ a 1,30|c130|girth|"
                       "gbh|cbh|umfang|brusthöhenumfang",
                       "cm|mm", .other_units = "mm", .unit = N_("cm or mm"), .lo = 0.3, .hi = 1e4},
    [HEIGHT] =
        {N_("height_m"),
         "height|total height|altezza|altezza totale|altezza media|mean height|h tot|ht|h media|h medio|höhe|baumhöhe|h|alt",
         "m|mt|metri", .unit = N_("m"), .hi = 150},
    [SPACING] = {N_("spacing_m"), "spacing|distanza|distanza polloni|abstand", "m|mt|metri", .unit = N_("m"), .lo = 0.01,
                 .hi = 20},
    [ENERGY] = {N_("energy_kJ"), "energy|energia|energie", "kJ", .unit = N_("kJ"), .hi = 1e6},
    [COUNT] = {N_("count"),
               "n fusti|num fusti|numero fusti|numero di fusti|n piante|num piante|numero piante|n stems|no of stems|"
               "number of stems|stems|stem count|tree count|freq|frequenza|frequency|conteggio|anzahl|stammzahl|n|num|numero|"
               "nr",
               .unit = N_("stems"), .hi = STEMS_MAX},
    [SHOOTS] = {N_("shoots"),
                "polloni|n polloni|num polloni|numero polloni|n di polloni|number of shoots|no of shoots|n shoots|"
                "stockausschläge|loden",
                .unit = N_("stems"), .hi = STEMS_MAX},
    [STANDARDS] = {N_("standards"),
                   "matricine|n matricine|num matricine|numero matricine|number of standards|no of standards|n standards|"
                   "überhälter|lassreitel",
                   .unit = N_("stems"), .hi = STEMS_MAX},
    [TREES] = {N_("trees"), "alberi|n alberi|num alberi|numero alberi|number of trees|no of trees|n trees|bäume",
               .unit = N_("stems"), .hi = STEMS_MAX},
    [STATUS] = {N_("status"), .also =
                                  "vitalità|vitalita|stato|condizione|condizioni|condition|health|statuscd|status cd|live/dead|"
                                  "vivo/morto|v/m|zustand|vitalität"},
    [ID] = {N_("id"), .also =
                          "n pianta|num pianta|numero pianta|pianta|id pianta|id pollone|n pollone|id fusto|n fusto|n albero|"
                          "id albero|tree|tree id|tree no|tree number|stem id|baum nr|baumnummer"},
    [YEAR] = {N_("year"), .also = "anno|anno rilievo|survey year|measurement year|invyr|jahr|aufnahmejahr"},
    [SITE] = {N_("site"), .also = "sito|località|localita|locality|location|standort|ort"},
    [SITE + 1] = {N_("stand"), .also = "popolamento|soprassuolo|bestand"},
    [SITE + 2] = {.name = N_("compresa")},
    [SITE + 3] = {N_("compartment"), .also = "particella|particella forestale|part for|abteilung"},
    [SITE + 4] = {N_("subcompartment"), .also = "sottoparticella|sub|unterabteilung"},
    [SITE + 5] = {N_("stratum"), .also = "strato|strata"},
    [SITE + 6] = {N_("county"), .also = "countycd|county cd"},
};

/* ---- words ---- */

#define X(NAME, word) word,
static const char *const kind_names[] = {CEDUO_SURVEY_KINDS(X)};
#undef X
static const char *const kinds_also[] = {
    "shoot|shoots|coppice shoot|sprout|pollone|polloni|poll|p|agamica|agamico|stockausschlag|lode|loden",
    ("standard|standards|matricina|matricine|matr|m|matr 1t|matr 2t|matr 3t|matricina 1t|matricina 2t|matricina 3t|m1t|m2t|m3t|"
     "riserva|überhälter|lassreitel"),
    "tree|trees|high forest|albero|alberi|allievo|allievi|fustaia|alto fusto|gamica|gamico|da seme|baum|bäume|kernwuchs",
    "stump|stumps|ceppo|ceppi|stubben|baumstumpf"};
const struct choices ceduo_survey_kind_words = {kind_names, CEDUO_SURVEY_KINDS_COUNT, kinds_also};

static const char *const statuses[] = {"live", "dead", "cut"};
static const char *const statuses_also[] = {
    "live|alive|living|li|l|vivo|viva|vivi|vive|v|vivente|sano|sana|healthy|lebend|lebendig",
    "dead|ds|standing dead|dead standing|d|morto|morta|morti|morte|m|secco|secca|morto in piedi|tot|abgestorben",
    "cut|felled|removed|tagliato|tagliata|tagliati|tagliate|t|abbattuto|abbattuta|gefällt|entnommen"};
const struct choices ceduo_survey_status_words = {statuses, 3, statuses_also};

int ceduo_survey_find_word(const struct choices *words, struct csv_cell cell)
{
    char word[WORD_MAX] = "";
    if (cell.n < sizeof word)
        memcpy(word, cell.p, cell.n);
    return ceduo_choice_find(words, word);
}

/* Find the species with the first n letters of a genus, and an epithet; -1: none, or several. */
static int find_abbreviated(const char *genus, size_t n, const char *epithet)
{
    int found = -1, count = 0;
    for (size_t i = 0; i < ceduo_species_words.n; i++) {
        const char *name = ceduo_species_words.names[i], *dash = strchr(name, '-');
        if (dash && strncasecmp(name, genus, n) == 0 && strcasecmp(dash + 1, epithet) == 0) {
            found = (int)i;
            count++;
        }
    }
    return count == 1 ? found : -1;
}

/* Find a genus that the program does not divide into species; -1: none. */
static int find_genus(const char *word)
{
    for (size_t i = 0; i < ceduo_species_words.n; i++)
        if (!strchr(ceduo_species_words.names[i], '-') && strcasecmp(ceduo_species_words.names[i], word) == 0)
            return (int)i;
    return -1;
}

/* Find a species by its Latin name, with an author, or with another name in brackets. */
static int find_latin(char *word)
{
    char *bracket = strchr(word, '('), *first = word, *second, *third, *rest;
    if (bracket > word && bracket[-1] == ' ') {
        *bracket = '\0';
        int known = ceduo_choice_find(&ceduo_species_words, word);
        *bracket = '(';
        if (known >= 0)
            return known;
    }
    size_t letters = 0;
    while (isalpha((unsigned char)word[letters]))
        letters++;
    bool abbreviated = letters > 0 && letters <= 4 && word[letters] == '.';
    if (abbreviated)
        word[letters] = ' ';
    first = strtok_r(word, " ", &rest);
    second = first ? strtok_r(NULL, " ", &rest) : NULL;
    third = second ? strtok_r(NULL, " ", &rest) : NULL;
    if (!second || (third && !isupper((unsigned char)third[0]) && third[0] != '('))
        return first ? find_genus(first) : -1;
    if (abbreviated)
        return find_abbreviated(first, letters, second);
    char both[WORD_MAX + 2];
    snprintf(both, sizeof both, "%s %s", first, second);
    int known = ceduo_choice_find(&ceduo_species_words, both);
    return known >= 0 ? known : find_genus(first);
}

int ceduo_survey_find_species(struct csv_cell cell, struct csv_cell genus)
{
    char word[WORD_MAX] = "";
    int known = ceduo_survey_find_word(&ceduo_species_words, cell);
    if (known >= 0)
        return known;
    if (genus.n > 0 && genus.n + cell.n + 1 < sizeof word)
        snprintf(word, sizeof word, "%.*s%s%.*s", (int)genus.n, genus.p, cell.n > 0 ? " " : "", (int)cell.n, cell.p);
    else if (cell.n < sizeof word)
        memcpy(word, cell.p, cell.n);
    known = ceduo_choice_find(&ceduo_species_words, word);
    return known >= 0 ? known : find_latin(word);
}

/* ---- heads ---- */

/* True if a head ends with a unit. */
static bool has_unit(struct csv_cell head, const char *units)
{
    char given[FOLDED_MAX], unit[FOLDED_MAX];
    size_t length = strlen(ceduo_utf8_fold(head.p, head.n, given, sizeof given));
    for (size_t n; *units; units += n, units += *units == '|') {
        n = strcspn(units, "|");
        size_t m = strlen(ceduo_utf8_fold(units, n, unit, sizeof unit));
        if (m < length && strcmp(given + length - m, unit) == 0)
            return true;
    }
    return false;
}

bool ceduo_survey_is_vague(const struct csv *csv, size_t column)
{
    struct csv_cell head = csv->heads[column];
    return ceduo_csv_matches(head.p, head.n, VAGUE);
}

/* Refuse a column with a known name and an unknown unit. */
static bool check_unit(const struct csv *csv, enum column c)
{
    const struct csv_head *head = &ceduo_survey_heads[c];
    size_t found = ceduo_csv_column(csv, head, NULL);
    found = found == CEDUO_CSV_NOT_FOUND ? ceduo_csv_column(csv, head, FOREIGN_UNITS) : found;
    if (found >= CEDUO_CSV_DUPLICATE)
        return true;
    const struct csv_cell cell = csv->heads[found];
    size_t n = 0;
    while (n < cell.n && !strchr(" ([_.", cell.p[n]))
        n++;
    if (ceduo_csv_matches(cell.p, n, VAGUE))
        return true; /* h (hours) */
    return ceduo_csv_error(csv, cell, _("this column must be in %s; convert it and name it '%s'"), _(head->unit),
                           _(head->name));
}

/* Report a missing column, and the columns of the table unless it is foreign. */
static bool refuse_head(const struct csv *csv, const char *missing)
{
    const struct problem_place place = {.source = csv->source, .line = csv->head_place.line, .column = 1, .own = true};
    LOCAL_TEXT(names);
    ceduo_csv_append_heads(csv, &names);
    if (csv->source->foreign)
        return ceduo_problem_at(csv->problems, place, _("the line of heads must name the column %s"), missing);
    return ceduo_problem_at(csv->problems, place, _("the line of heads must name the column %s; it has: %s"), missing,
                            ceduo_text_string(&names));
}

bool ceduo_survey_find_columns(struct csv *csv, size_t columns[COLUMNS], enum csv_unit units[COLUMNS])
{
    size_t before = csv->problems->met;
    ceduo_csv_find_head(csv, ceduo_survey_heads, COLUMNS, columns);
    bool none[COLUMNS];
    for (int c = 0; c < COLUMNS; c++)
        none[c] = columns[c] == CEDUO_CSV_NOT_FOUND;
    bool sized = !none[DBH] || !none[CIRCUMFERENCE], laid = !none[AREA] || !none[RADIUS];
    for (int c = 0; c < COLUMNS; c++) {
        const char *usual = ceduo_survey_heads[c].units, *rare = ceduo_survey_heads[c].other_units;
        units[c] = CSV_UNIT_NONE;
        bool needed = c == DBH || c == CIRCUMFERENCE ? !sized : c == AREA || c == RADIUS ? !laid : true;
        if (usual && none[c] && needed)
            check_unit(csv, (enum column)c);
        if (!usual || columns[c] >= CEDUO_CSV_DUPLICATE)
            continue;
        const struct csv_cell head = csv->heads[columns[c]];
        units[c] = rare && has_unit(head, rare) ? CSV_UNIT_OTHER : has_unit(head, usual) ? CSV_UNIT_USUAL : CSV_UNIT_NONE;
    }
    if (csv->problems->met > before)
        return false;
    if (none[PLOT])
        refuse_head(csv, _("'plot'"));
    if (none[KIND] && none[SHOOTS] && none[STANDARDS] && none[TREES])
        refuse_head(csv, _("'kind', or columns 'shoots', 'standards', 'trees' with numbers of stems"));
    if (!sized)
        refuse_head(csv, _("'dbh_cm' or 'circumference_cm'"));
    if (!laid)
        refuse_head(csv, _("'area_m2' or 'radius_m'"));
    return csv->problems->met == before;
}
