/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of the options, and a setter for each kind of value. What is set points into the arguments of main(). */
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/language.h"
#include "ceduo/calibrate.h"
#include "ceduo/years.h"
#include "localize.h"
#include "say.h"

#define WIDTH_LEAST  20
#define HEIGHT_LEAST 6

/* ---- setters that several options share ---- */

static enum exit_status set_text(struct arguments *a, const struct option_row *row, char *value)
{
    memcpy((char *)a + row->at, &value, sizeof value);
    return EXIT_DONE;
}

/* One of the words of row->value, to an enum or a count. */
static enum exit_status set_word(struct arguments *a, const struct option_row *row, char *value)
{
    int i = 0;
    size_t length = strlen(value);
    LOCAL_TEXT(all);
    for (const char *word = row->value; *word; i++) {
        size_t n = strcspn(word, "|");
        if (n == length && strncmp(word, value, n) == 0) {
            memcpy((char *)a + row->at, &i, sizeof i);
            return EXIT_DONE;
        }
        ceduo_text_format(&all, "%s%.*s", i > 0 ? ", " : "", (int)n, word);
        word += n + (word[n] == '|');
    }
    return ceduo_usage(row->name, _("'%s' is unknown; one of: %s"), value, all.bytes);
}

/* At once: what is wrong with a later option is said in this language. */
static enum exit_status set_language(struct arguments *a, const struct option_row *row, char *value)
{
    enum exit_status status = set_word(a, row, value);
    if (status == EXIT_DONE)
        ceduo_language_set(value);
    return status;
}

static enum exit_status add_word(struct arguments *a, const struct option_row *row, char *value)
{
    struct word_list *words = (void *)((char *)a + row->at);
    words->items[words->n++] = value;
    return EXIT_DONE;
}

/* ---- setters of one option ---- */

static enum exit_status set_flag(struct arguments *a, const struct option_row *row, char *value)
{
    (void)value;
    *(bool *)((char *)a + row->at) = true;
    return EXIT_DONE;
}

static enum exit_status read_count(const char *name, const char *value, double lo, double hi, uint64_t *to)
{
    switch (ceduo_count_read(value, lo, hi, to)) {
    case CEDUO_NUMBER_GOOD:
        return EXIT_DONE;
    case CEDUO_NUMBER_TOO_LARGE:
        return ceduo_usage(name, _("%s is outside %.0f to %.0f"), value, lo, hi);
    default:
        return ceduo_usage(name, _("'%s' is not a whole number"), value);
    }
}

static enum exit_status set_rocks(struct arguments *a, const struct option_row *row, char *value)
{
    return read_count(row->name, value, 1, CEDUO_ROCKS_MOST, &a->rocks);
}

static enum exit_status set_threads(struct arguments *a, const struct option_row *row, char *value)
{
    uint64_t n = a->threads;
    enum exit_status status = read_count(row->name, value, 1, THREADS_MOST, &n);
    a->threads = (unsigned)n;
    return status;
}

/* What is no number may be a share in percent. */
static enum exit_status no_number(const struct option_row *row, const char *value)
{
    char part[64];
    double number;
    size_t length = strlen(value);
    snprintf(part, sizeof part, "%.*s", (int)(length < sizeof part ? length - (length > 0) : 0), value);
    if (length > 0 && value[length - 1] == '%' && ceduo_number_read(part, &number) == CEDUO_NUMBER_GOOD)
        return ceduo_usage(row->name, _("'%s' is not a number; write %s"), value, SHORTEST(number / 100));
    return ceduo_usage(row->name, _("'%s' is not a number"), value);
}

static enum exit_status set_tolerance(struct arguments *a, const struct option_row *row, char *value)
{
    double number;
    if (ceduo_number_read(value, &number) != CEDUO_NUMBER_GOOD)
        return no_number(row, value);
    if (!(number > 0) || !(number < 1))
        return ceduo_usage(row->name, _("%s must lie above 0 and below 1"), value);
    a->tolerance = number;
    return EXIT_DONE;
}

static enum exit_status set_sure(struct arguments *a, const struct option_row *row, char *value)
{
    if (ceduo_number_read(value, &a->sure) != CEDUO_NUMBER_GOOD)
        return no_number(row, value);
    if (!(a->sure > 0) || !(a->sure <= 1))
        return ceduo_usage(row->name, _("%s is not a share; write 0.9 for nine of ten cases"), value);
    return EXIT_DONE;
}

static enum exit_status set_plot(struct arguments *a, const struct option_row *row, char *value)
{
    a->plot = ceduo_plot_find(value);
    if (a->plot == CEDUO_PLOT_NONE)
        return ceduo_usage(row->name, _("'%s' is unknown; one of: %s"), value, ceduo_plot_names);
    return EXIT_DONE;
}

/* Numbers with a separator between them, `least` to `most`; those that are missing stay as they were. */
static bool read_numbers(const char *text, const char *separator, int least, int most, double *numbers)
{
    for (int n = 1; n <= most; n++) {
        char part[256];
        size_t length = strcspn(text, separator);
        snprintf(part, sizeof part, "%.*s", (int)(length < sizeof part ? length : 0), text);
        if (ceduo_number_read(part, &numbers[n - 1]) != CEDUO_NUMBER_GOOD)
            return false;
        if (!text[length])
            return n >= least;
        text += length + 1;
    }
    return false;
}

static bool is_whole(double number)
{
    return number == floor(number);
}

static enum exit_status set_size(struct arguments *a, const struct option_row *row, char *value)
{
    double n[2];
    if (!read_numbers(value, "x", 2, 2, n) || !is_whole(n[0]) || !is_whole(n[1]))
        return ceduo_usage(row->name, _("'%s' is not a size; write COLUMNSxLINES, such as 80x24"), value);
    if (n[0] < WIDTH_LEAST || n[0] > CEDUO_CANVAS_MAX_WIDTH || n[1] < HEIGHT_LEAST || n[1] > CEDUO_CANVAS_MAX_HEIGHT)
        return ceduo_usage(row->name, _("%s is outside %dx%d to %dx%d"), value, WIDTH_LEAST, HEIGHT_LEAST,
                           CEDUO_CANVAS_MAX_WIDTH, CEDUO_CANVAS_MAX_HEIGHT);
    a->plot_width = (int)n[0];
    a->plot_height = (int)n[1];
    return EXIT_DONE;
}

static enum exit_status set_seed(struct arguments *a, const struct option_row *row, char *value)
{
    uint64_t seed;
    enum exit_status status = read_count(row->name, value, 0, 9007199254740992.0, &seed);
    if (status != EXIT_DONE)
        return status;
    snprintf(a->seed, sizeof a->seed, "simulation.seed=%llu", (unsigned long long)seed);
    a->sets.items[a->sets.n++] = a->seed;
    return EXIT_DONE;
}

/* "A:B" or "A:B:STEP", whole years; without a value one whole rotation of each option. */
static enum exit_status set_years(struct arguments *a, const struct option_row *row, char *value)
{
    a->years = true;
    if (!value)
        return EXIT_DONE;
    double parts[3] = {0, 0, 1};
    bool good = read_numbers(value, ":", 2, 3, parts) && is_whole(parts[0]) && is_whole(parts[1]) && is_whole(parts[2]);
    if (!good)
        return ceduo_usage(row->name, _("'%s' is not a range of years; write A:B or A:B:STEP, such as 0:25"), value);
    if (parts[0] < 0)
        return ceduo_usage(row->name, _("%s begins before year 0, which is the stand as filed"), value);
    if (parts[1] < parts[0] || parts[1] > 100000 || parts[2] < 1)
        return ceduo_usage(row->name, _("%s ends before it begins, or after year 100000"), value);
    if ((parts[1] - parts[0]) / parts[2] >= CEDUO_YEARS_MOST)
        return ceduo_usage(row->name, _("%s is more than %d years"), value, CEDUO_YEARS_MOST);
    a->window = (struct ceduo_window){
        .first = (unsigned)parts[0], .last = (unsigned)parts[1], .step = parts[2] > 100000 ? 100000 : (unsigned)parts[2]};
    return EXIT_DONE;
}

/* "PATH=LO:HI"; the path is kept without the rest. */
static enum exit_status set_find(struct arguments *a, const struct option_row *row, char *value)
{
    char *equals = strrchr(value, '=');
    double range[2];
    bool good = equals && equals > value && read_numbers(equals + 1, ":", 2, 2, range);
    if (!good)
        return ceduo_usage(row->name, _("'%s' is not PATH=LO:HI, such as 'forest[0].stand.trees[0].per_ha=1:1000'"), value);
    if (!(range[0] <= range[1]))
        return ceduo_usage(row->name, _("the range %s ends before it begins"), equals + 1);
    *equals = '\0';
    a->find = value;
    a->find_lo = range[0];
    a->find_hi = range[1];
    return EXIT_DONE;
}

static enum exit_status set_goal(struct arguments *a, const struct option_row *row, char *value)
{
    enum ceduo_goal_reading reading = ceduo_goal_read(value, &a->goal, &a->goal_value);
    const char *number = value + strlen(value) + 1;
    LOCAL_TEXT(words);
    switch (reading) {
    case CEDUO_GOAL_UNKNOWN:
        ceduo_goal_words(&words);
        return ceduo_usage(row->name, _("'%s' is unknown; one of: %s"), value, ceduo_text_string(&words));
    case CEDUO_GOAL_NO_NUMBER:
        return no_number(row, number);
    case CEDUO_GOAL_NEGATIVE:
        return ceduo_usage(row->name, _("%s is below 0"), number);
    case CEDUO_GOAL_NO_SHARE:
        return ceduo_usage(row->name, _("%s is not a share; write 0 to 1, such as 0.05 for 5 %%"), number);
    default:
        return EXIT_DONE;
    }
}

static enum exit_status set_sensitivity(struct arguments *a, const struct option_row *row, char *value)
{
    uint64_t n = CEDUO_DOUBT_POINTS;
    enum exit_status status = value ? read_count(row->name, value, 2, CEDUO_DOUBT_POINTS_MAX, &n) : EXIT_DONE;
    a->points = (size_t)n;
    return status;
}

/* The file is the output; standard output is where it goes without one. Where it was forgotten, the first scene stands in its
 * place, and must not be written over. */
static enum exit_status set_report(struct arguments *a, const struct option_row *row, char *value)
{
    const char *dot = strrchr(value, '.');
    bool standard = strcmp(value, "-") == 0;
    if (!standard && !(dot && (strcasecmp(dot, ".html") == 0 || strcasecmp(dot, ".htm") == 0)))
        return ceduo_usage(row->name,
                           _("'%s' does not end in .html or .htm; name the page, or - for standard output, then the "
                             "scenes: --report page.html scene.yaml"),
                           value);
    a->output = standard ? NULL : value;
    return EXIT_DONE;
}

/* "PATH=LO:HI"; it is kept as it is. */
static enum exit_status add_calibrate(struct arguments *a, const struct option_row *row, char *value)
{
    double range[2];
    const char *equals = strrchr(value, '=');
    if (!equals || equals == value || !read_numbers(equals + 1, ":", 2, 2, range))
        return ceduo_usage(row->name, _("'%s' is not PATH=LO:HI, such as 'slope.materials[talus].rn=0.2:0.5'"), value);
    if (!(range[0] < range[1]))
        return ceduo_usage(row->name, _("the range %s is empty; HI must be above LO"), equals + 1);
    if (a->calibrates.n == CEDUO_CALIBRATION_MOST)
        return ceduo_usage(row->name, _("at most %d values can be fitted at once"), CEDUO_CALIBRATION_MOST);
    a->calibrates.items[a->calibrates.n++] = value;
    return EXIT_DONE;
}

/* ---- the table ---- */

#define AT(member) offsetof(struct arguments, member)

/* Modes with which an option does not go. */
enum {
    CHECK = 1u << MODE_CHECK,
    FIND = 1u << MODE_FIND,
    DOUBT = 1u << MODE_SENSITIVITY,
    FIT = 1u << MODE_CALIBRATE,
    PAGE = 1u << MODE_REPORT,
    SURVEY = 1u << MODE_SURVEY,
    LISTS = 1u << MODE_PARAMETERS | 1u << MODE_PROFILES | 1u << MODE_COLUMNS | 1u << MODE_SCHEMA,
    SCREEN = 1u << MODE_TERMINAL
};

static const struct option_row rows[] = {
    {"batch", 'b', NULL, NULL, 0, MODE_BATCH, SURVEY, N_("compute the scenes and print the result, without a terminal")},
    {"format", 'f', "table|csv|json", set_word, AT(format), MODE_TERMINAL, CHECK | PAGE | SURVEY | LISTS | SCREEN,
     N_("format of the output (table)")},
    {"details", 0, NULL, NULL, 0, MODE_BATCH, CHECK | FIND | DOUBT | FIT | PAGE | SURVEY,
     N_("print the whole page, with every figure, not the answer alone")},
    {"output", 'o', "FILE", set_text, AT(output), MODE_TERMINAL, CHECK | PAGE | SCREEN,
     N_("write to FILE; a regular file is written completely or not at all")},
    {"set", 's', "PATH=VALUE", add_word, AT(sets), MODE_TERMINAL, SURVEY | SCREEN,
     N_("change a parameter of the scene; may be repeated")},
    {"rocks", 'n', "N", set_rocks, 0, MODE_TERMINAL, CHECK | SURVEY | SCREEN,
     N_("number of rocks; with --tolerance the maximum")},
    {"tolerance", 'e', "REL", set_tolerance, 0, MODE_TERMINAL, CHECK | FIND | DOUBT | FIT | SURVEY | SCREEN,
     N_("simulate until the 95 % error of each mean energy is below REL of it")},
    {"rows", 0, "controls|stands", set_word, AT(stands), MODE_TERMINAL, CHECK | DOUBT | FIT | PAGE | SURVEY | SCREEN,
     N_("what each row of CSV describes (controls)")},
    {"each", 0, "ROWS.csv", set_text, AT(each), MODE_TERMINAL, FIT | PAGE | SURVEY | SCREEN,
     N_("compute the scenes once for each row of a table: columns named as a path of --set change them, the others are "
        "copied")},
    {"columns", 0, "LIST", set_text, AT(columns), MODE_TERMINAL, CHECK | FIT | PAGE | SURVEY | SCREEN,
     N_("print these columns of CSV, with commas between their names")},
    {"resume", 0, NULL, set_flag, AT(resume), MODE_TERMINAL, CHECK | FIT | PAGE | SURVEY | SCREEN,
     N_("with --each and -o: rows that stand in FILE are not computed again; FILE grows row by row")},
    {"seed", 0, "N", set_seed, 0, MODE_TERMINAL, SURVEY | SCREEN, N_("seed of the random numbers, 0 to 2^53")},
    {"threads", 'j', "N", set_threads, 0, MODE_TERMINAL, SURVEY,
     N_("number of threads; it does not change the result (all cores)")},
    {"option", 0, "NAME", add_word, AT(options), MODE_TERMINAL, FIT | SURVEY | SCREEN,
     N_("compute only this option of the scene; may be repeated")},
    {"years", 0, "[A:B[:STEP]]", set_years, 0, MODE_BATCH, CHECK | FIT | SURVEY,
     N_("compute every option year by year: one whole rotation after its first cut, or the years A to B; the stands as "
        "filed are year 0")},
    {"find", 0, "PATH=LO:HI", set_find, 0, MODE_FIND, CHECK | PAGE | SURVEY,
     N_("find the value of a parameter that reaches --goal at the worst control")},
    {"goal", 0, "GOAL[=VALUE]", set_goal, 0, MODE_TERMINAL, CHECK | SURVEY,
     N_("adc, free-run (at most the light's limit), energy (mean kJ) or exceed (share, 0.05)")},
    {"sure", 0, "SHARE", set_sure, 0, MODE_TERMINAL, CHECK | SURVEY,
     N_("with --find: also the value that reaches the goal in this share of what may be true, such as 0.9")},
    {"sensitivity", 0, "[N]", set_sensitivity, 0, MODE_SENSITIVITY, CHECK | SURVEY,
     N_("show how sure the result is, and what that depends on; N points (256)")},
    {"report", 0, "FILE", set_report, 0, MODE_REPORT, CHECK | SURVEY,
     N_("write a page to hand in as HTML, with pictures; several scenes give chapters; - is standard output")},
    {"calibrate", 0, "PATH=LO:HI", add_calibrate, 0, MODE_CALIBRATE, CHECK | PAGE | SURVEY,
     N_("fit this value to what was observed, between LO and HI; may be repeated; -o FILE.yaml writes the first scene with "
        "what was found")},
    {"plot", 0, "WHAT", set_plot, 0, MODE_BATCH, CHECK | FIND | FIT | PAGE | SURVEY,
     N_("print a picture: profile, energy, height, histogram, adc, rotation, stand, compare, tradeoff, doubt or hazard")},
    {"size", 0, "WxH", set_size, 0, MODE_TERMINAL, CHECK | SURVEY, N_("size of a picture in columns and lines (80x24)")},
    {"charset", 0, "braille|block|ascii", set_word, AT(charset), MODE_TERMINAL, CHECK | SURVEY,
     N_("characters that pictures are made of (from the locale)")},
    {"language", 0, "it|en", set_language, AT(language), MODE_TERMINAL, 0,
     N_("language of tables, screens and messages (from the locale)")},
    {"script", 0, "FILE", set_text, AT(script), MODE_TERMINAL, CHECK | SURVEY,
     N_("feed keys and commands to the terminal program; needs no terminal")},
    {"check", 0, NULL, NULL, 0, MODE_CHECK, SURVEY, N_("check the scenes and print every problem; compute nothing")},
    {"list-parameters", 0, NULL, NULL, 0, MODE_PARAMETERS, SURVEY,
     N_("list path, type, unit, range, default and meaning of each parameter")},
    {"list-profiles", 0, NULL, NULL, 0, MODE_PROFILES, SURVEY,
     N_("list the scenes, slopes, stands and rules that can be named")},
    {"list-columns", 0, NULL, NULL, 0, MODE_COLUMNS, SURVEY,
     N_("list path, type, unit and meaning of each column of CSV, also with --rows stands or --years")},
    {"schema", 0, "result|find|sensitivity|calibration", set_word, AT(schema), MODE_SCHEMA, SURVEY,
     N_("print the JSON Schema of this output")},
    {"survey", 0, "FILE.csv", set_text, AT(survey), MODE_SURVEY, CHECK,
     N_("write the stand of a survey: a CSV file with a row for each stem on sample plots; --survey --template writes an empty "
        "one")},
    {"quiet", 'q', NULL, set_flag, AT(quiet), MODE_TERMINAL, 0, N_("print no progress")},
    {"help", 'h', NULL, NULL, 0, MODE_HELP, 0, N_("print this help")},
    {"version", 'V', NULL, NULL, 0, MODE_VERSION, 0, N_("print the version")},
};

#define ROWS (sizeof rows / sizeof rows[0])
_Static_assert(ROWS <= OPTIONS_MOST, "a bit for each");

/* Options of earlier versions, and what to do instead. */
static const struct {
    const char *name, *instead;
} gone[] = {
    {"plain", N_("shares and means are always as counted; leave it out")},
    {"shard", N_("a scene is computed at once; give each machine scenes of its own, see man ceduo-workflows")},
    {"merge", N_("results of several scenes are printed together; see man ceduo-workflows")},
};

const char *ceduo_option_gone(const char *word)
{
    size_t length = strcspn(word, "=");
    for (size_t i = 0; i < sizeof gone / sizeof gone[0]; i++)
        if (length > 2 && strlen(gone[i].name) == length - 2 && strncmp(gone[i].name, word + 2, length - 2) == 0)
            return _(gone[i].instead);
    return NULL;
}

const struct option_row *ceduo_option_rows(size_t *n)
{
    *n = ROWS;
    return rows;
}

bool ceduo_option_given(const struct arguments *a, const char *name)
{
    for (size_t i = 0; i < ROWS; i++)
        if (strcmp(rows[i].name, name) == 0)
            return (a->given >> i & 1) != 0;
    return false;
}

enum ceduo_charset ceduo_option_charset(const struct arguments *a)
{
    if (ceduo_option_given(a, "charset"))
        return a->charset;
    return ceduo_say_utf8() ? CEDUO_CHARSET_BRAILLE : CEDUO_CHARSET_ASCII;
}

/* A list or a check goes before what is computed, help goes before all; of two alike the first one counts. */
static int weight(enum mode mode)
{
    return (int)(mode < MODE_CHECK ? mode : mode < MODE_HELP ? MODE_CHECK : MODE_HELP);
}

enum exit_status ceduo_option_set(struct arguments *a, const struct option_row *row, char *value)
{
    enum exit_status status = row->set ? row->set(a, row, value) : EXIT_DONE;
    a->given |= (uint64_t)1 << (row - rows);
    if (status == EXIT_DONE && weight(row->mode) > weight(a->mode))
        a->mode = row->mode;
    return status;
}
